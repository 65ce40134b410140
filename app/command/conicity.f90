!> `faststrip conicity`: equivalent conicity from a rolling radius difference.
module faststrip_command_conicity
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, status_word, &
                                     st_out_of_range, st_not_increasing
    use faststrip_base_text, only: integer_text, parse_real, trim_blanks, set_place_status
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, column_numbers, &
                                   cell_text, column_index, open_csv, put_comment, put_header, &
                                   put_cell, end_row, close_csv
    use faststrip_geometry_conicity, only: find_equilibrium, klingel_conicity, &
                                           regression_conicity, largest_amplitude
    use faststrip_command_console, only: fail, fail_on_error, usage_error, put_origin, &
                                         exit_bad_input
    use faststrip_command_options, only: command_t, option_t, parse_command, given, option_text, &
                                         option_number, option_word
    implicit none
    private

    public :: run_conicity

    ! Given: EN 15302:2008+A1:2010, Annex E: the least amplitude and the step, mm.
    real(wp), parameter :: first_amplitude = 1.0_wp, amplitude_step = 0.1_wp
    ! A step counts to the last amplitude if it misses it by less than this part of a step.
    ! Tuned [1]. Origin: chosen; rounding of decimals.
    real(wp), parameter :: step_slack = 1.0e-9_wp
    ! More amplitudes than this are a slip of the step.
    integer, parameter :: most_amplitudes = 1000000

contains

    !> Run the subcommand from the command line.
    subroutine run_conicity()
        type(command_t) :: command
        type(csv_table_t) :: table
        type(status_t) :: status
        character(len=:), allocatable :: method, path
        real(wp), allocatable :: y(:), delta_r(:), amplitudes(:)
        real(wp) :: y_equilibrium, largest

        command%name = 'conicity'
        command%usage = ''
        command%about = &
            'Equivalent conicity of a wheelset by EN 15302:2008+A1:2010 from its rolling radius' &
            // new_line('a') // 'difference: on the side to which y points less that on the other' &
            // new_line('a') // 'side. CSV: amplitude_mm,tan_gamma_e,y_min_mm,y_max_mm,method,' &
            // 'status.' // new_line('a')
        command%options = [ &
            option_t('--delta-r', 'FILE.csv', 'columns y_mm (rising),delta_r_mm', reads=.true.), &
            option_t('--amplitudes', 'LIST', 'amplitudes, mm, as 1,2.5,3'), &
            option_t('--from', 'NUMBER', 'or the least amplitude, mm (default 1)'), &
            option_t('--to', 'NUMBER', 'the largest, mm (default: all that the table holds)'), &
            option_t('--step', 'NUMBER', 'and their step, mm (default 0.1)'), &
            option_t('--method', 'NAME', 'klingel (default; Annex B) or regression (Annex C)'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 0)
        method = option_word(command, '--method', 'klingel', &
                             [character(len=10) :: 'klingel', 'regression'])
        if (.not. given(command, '--delta-r')) &
            call usage_error('--delta-r is needed', command%name)
        if (given(command, '--amplitudes') .and. (given(command, '--from') .or. &
                                                  given(command, '--to') .or. &
                                                  given(command, '--step'))) &
            call usage_error('--amplitudes must not be given with --from, --to and --step', &
                             command%name)
        if (given(command, '--amplitudes')) &
            call take_list(command, option_text(command, '--amplitudes', ''), amplitudes)

        path = option_text(command, '--delta-r', '')
        call read_csv(path, table, status)
        call fail_on_error(status)
        call column_numbers(table, 'y_mm', y, status)
        call fail_on_error(status)
        call column_numbers(table, 'delta_r_mm', delta_r, status)
        call fail_on_error(status)
        call check_order(table, y)
        call find_equilibrium(y, delta_r, y_equilibrium, status)
        call fail_on_error(status, path)
        largest = largest_amplitude(y, delta_r, y_equilibrium)
        if (.not. allocated(amplitudes)) call take_steps(command, path, largest, amplitudes)
        call write_values(option_text(command, '-o', '-'), path, method, y, delta_r, &
                          y_equilibrium, largest, amplitudes)
    end subroutine run_conicity

    subroutine take_list(command, text, amplitudes)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: text
        real(wp), allocatable, intent(out) :: amplitudes(:)

        integer :: start, comma
        real(wp) :: value
        logical :: valid

        allocate (amplitudes(0))
        start = 1
        do
            comma = index(text(start:), ',') + start - 1
            if (comma < start) comma = len(text) + 1
            call parse_real(trim_blanks(text(start:comma - 1)), value, valid)
            if (.not. valid .or. .not. value > 0.0_wp) &
                call usage_error("--amplitudes must be numbers above 0, got '" &
                                 // text(start:comma - 1) // "'", command%name)
            amplitudes = [amplitudes, value]
            if (comma > len(text)) exit
            start = comma + 1
        end do
    end subroutine take_list

    subroutine take_steps(command, path, largest, amplitudes)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: path
        real(wp), intent(in) :: largest
        real(wp), allocatable, intent(out) :: amplitudes(:)

        real(wp) :: from, to, step
        integer :: i

        from = option_number(command, '--from', first_amplitude, above=0)
        to = option_number(command, '--to', largest, above=0)
        step = option_number(command, '--step', amplitude_step, above=0)
        if (from > to .and. given(command, '--to')) &
            call usage_error('--to must be at least --from, got ' // trim(number_text(to)) &
                             // ' and ' // trim(number_text(from)), command%name)
        if (from > to*(1.0_wp + step_slack)) &
            call fail(exit_bad_input, 'the table ends before the amplitude, got ' &
                      // trim(number_text(from)) // ', at most ' // trim(number_text(largest)) &
                      // ' mm (' // path // ')')
        if ((to - from)/step > most_amplitudes) &
            call usage_error('--step must leave at most ' // integer_text(most_amplitudes) &
                             // ' amplitudes, got ' // trim(number_text(step)), command%name)
        amplitudes = [(from + i*step, i=0, int((to - from)/step + step_slack))]
    end subroutine take_steps

    subroutine check_order(table, y)
        type(csv_table_t), intent(in) :: table
        real(wp), intent(in) :: y(:)

        type(status_t) :: status
        integer :: row

        do row = 2, size(y)
            if (y(row) > y(row - 1)) cycle
            call set_place_status(status, st_not_increasing, 'y_mm must rise from row to row', &
                                  cell_text(table, row, column_index(table, 'y_mm')), &
                                  table%file, table%line(row))
            call fail_on_error(status)
        end do
    end subroutine check_order

    subroutine write_values(output, path, method, y, delta_r, y_equilibrium, largest, amplitudes)
        character(len=*), intent(in) :: output, path, method
        real(wp), intent(in) :: y(:), delta_r(:), y_equilibrium, largest, amplitudes(:)

        type(csv_writer_t) :: writer
        type(status_t) :: status
        type(status_t), allocatable :: states(:)
        real(wp), allocatable :: tan_gamma_e(:), turns(:, :)
        integer :: i

        allocate (states(size(amplitudes)), tan_gamma_e(size(amplitudes)))
        allocate (turns(2, size(amplitudes)))
        do i = 1, size(amplitudes)
            call klingel_conicity(y, delta_r, y_equilibrium, amplitudes(i), tan_gamma_e(i), &
                                  turns(1, i), turns(2, i), states(i))
            if (method == 'regression' .and. .not. is_error(states(i))) &
                call regression_conicity(y, delta_r, turns(1, i), turns(2, i), tan_gamma_e(i), &
                                         states(i))
            ! Within the table an amplitude without a motion is a result, and the others stand.
            if (states(i)%code /= st_out_of_range .or. amplitudes(i) > largest) &
                call fail_on_error(states(i), path)
        end do

        call open_csv(writer, output, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, 'equivalent conicity, EN 15302:2008+A1:2010')
        call put_header(writer, [character(len=12) :: 'amplitude_mm', 'tan_gamma_e', 'y_min_mm', &
                                 'y_max_mm', 'method', 'status'])
        do i = 1, size(amplitudes)
            call put_cell(writer, amplitudes(i))
            if (is_error(states(i))) then
                call put_cell(writer, '')
                call put_cell(writer, '')
                call put_cell(writer, '')
            else
                call put_cell(writer, tan_gamma_e(i))
                call put_cell(writer, turns(1, i))
                call put_cell(writer, turns(2, i))
            end if
            call put_cell(writer, method)
            call put_cell(writer, trim(status_word(states(i)%code)))
            call end_row(writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine write_values
end module faststrip_command_conicity
