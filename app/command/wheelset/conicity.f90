!> `faststrip conicity`: equivalent conicity from profiles or from a rolling radius difference.
module faststrip_command_wheelset_conicity
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding, most_points
    use faststrip_base_status, only: status_t, is_error, number_text, status_word, &
                                     st_out_of_range, st_not_increasing, st_no_wave
    use faststrip_base_text, only: integer_text, parse_real, trim_blanks, set_place_status
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, column_numbers, &
                                   cell_text, column_index, put_comment, put_header, put_cell, &
                                   end_row
    use faststrip_geometry_conicity, only: conicity_t, find_conicity, find_equilibrium, &
                                           largest_amplitude
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, put_origin, &
                                                 tell_held, exit_bad_input
    use faststrip_command_settings_case_file, only: read_bodies_of
    use faststrip_command_settings_profiles, only: bodies_t
    use faststrip_command_wheelset_contact_functions, only: tabulate_functions, write_functions, &
                                                            put_wheelset
    use faststrip_geometry_contact_functions, only: contact_functions_t
    use faststrip_command_program_people, only: open_result, close_result
    use faststrip_command_program_plot, only: plot_option, prepare_plot, plot_file, draw_plot
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number, option_word
    implicit none
    private

    public :: run_conicity

    ! Given: EN 15302:2008+A1:2010, Annex E: the least amplitude and the step, mm.
    real(wp), parameter :: first_amplitude = 1.0_wp, amplitude_step = 0.1_wp
    ! Far enough for amplitudes of 7.5 mm and unequal radii, mm.
    ! Tuned [mm]. Origin: chosen.
    real(wp), parameter :: standard_y_max = 10.0_wp

    !> What people are shown.
    character(len=*), parameter :: shown(*) = [character(len=19) :: &
        'amplitude_mm', 'tan_gamma_e', 'nonlinearity_per_mm', 'status']

    !> What was found of the amplitudes.
    type :: values_t
        real(wp) :: y_equilibrium = 0.0_wp            ! mm
        logical :: falls = .false.                    ! does delta r fall there?
        real(wp) :: largest = 0.0_wp                  ! amplitude that the table holds, mm
        type(conicity_t), allocatable :: found(:)
        type(status_t), allocatable :: states(:)
    end type values_t

contains

    !> Run the subcommand from the command line.
    subroutine run_conicity()
        type(command_t) :: command
        type(bodies_t) :: case
        type(contact_functions_t), allocatable :: functions(:)
        character(len=:), allocatable :: method, path
        real(wp), allocatable :: y(:), delta_r(:), amplitudes(:)
        real(wp) :: y_max, y_step
        type(values_t) :: values
        type(status_t) :: status
        logical :: from_table

        command%name = 'conicity'
        command%usage = '[CASE.nml]'
        command%about = &
            'Equivalent conicity of a wheelset by EN 15302:2008+A1:2010 from the profiles and' &
            // new_line('a') // 'radii of a case (groups &wheel and &rail) or from its rolling' &
            // new_line('a') // 'radius difference: on the side to which y points less that on' &
            // new_line('a') // 'the other side. CSV: amplitude_mm,tan_gamma_e,y_min_mm,' &
            // 'y_max_mm,regression,' // new_line('a') &
            // 'nonlinearity_per_mm,method,status.' // new_line('a')
        command%options = [ &
            option_t('--delta-r', 'FILE.csv', &
                     'instead of a case: columns y_mm (rising),delta_r_mm', reads=.true.), &
            option_t('--amplitudes', 'LIST', 'amplitudes, mm, as 1,2.5,3'), &
            option_t('--from', 'NUMBER', 'or the least amplitude, mm (default 1)'), &
            option_t('--to', 'NUMBER', 'the largest, mm (default: all that there are)'), &
            option_t('--step', 'NUMBER', 'and their step, mm (default 0.1)'), &
            option_t('--method', 'NAME', 'klingel (default; Annex B) or regression (Annex C)'), &
            option_t('--roll', '', 'of a case: the wheelset rolls until both wheels touch'), &
            option_t('--y-max', 'NUMBER', 'of a case: largest displacement, mm (default 10)'), &
            option_t('--y-step', 'NUMBER', &
                     'of a case: step of the displacement, mm (default 0.1)'), &
            option_t('--functions', 'FILE', 'of a case: write delta r, radii, contact angles,' &
                     // new_line('a') // 'roll and contact positions over it there', &
                     writes=.true.), &
            plot_option, &
            option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF to' &
                     // new_line('a') // 'FILE.nc', writes=.true.)]
        call parse_command(command, 0, 1)
        call prepare_plot(command)
        method = option_word(command, '--method', 'klingel', &
                             [character(len=10) :: 'klingel', 'regression'])
        call check_sources(command)
        if (given(command, '--amplitudes') .and. (given(command, '--from') .or. &
                                                  given(command, '--to') .or. &
                                                  given(command, '--step'))) &
            call usage_error('--amplitudes must not be given with --from, --to and --step', &
                             command%name)
        if (given(command, '--amplitudes')) &
            call take_list(command, option_text(command, '--amplitudes', ''), amplitudes)

        from_table = given(command, '--delta-r')
        if (from_table) then
            path = option_text(command, '--delta-r', '')
            call read_table(path, y, delta_r)
        else
            path = command%arguments(1)%text
            y_max = option_number(command, '--y-max', standard_y_max, above=0)
            y_step = option_number(command, '--y-step', amplitude_step, above=0)
            if (y_max/y_step > most_points) call usage_error('--y-step must leave at most ' &
                // integer_text(most_points) // ' shifts, got ' // trim(number_text(y_step)), &
                command%name)
            if (y_step > y_max) call usage_error('--y-step must be at most --y-max, got ' &
                // trim(number_text(y_step)) // ' and ' // trim(number_text(y_max)), command%name)
            call read_bodies_of(path, case)
            call tabulate_functions(path, case, y_step, int(y_max/y_step + rounding), &
                                    given(command, '--roll'), functions)
            y = functions%shift
            delta_r = functions%delta_r
        end if
        call find_equilibrium(y, delta_r, values%y_equilibrium, status, values%falls)
        call fail_on_error(status, path)
        values%largest = largest_amplitude(y, delta_r, values%y_equilibrium)
        if (.not. allocated(amplitudes)) call take_steps(command, path, values%largest, amplitudes)
        call find_values(path, y, delta_r, amplitudes, values)
        if (given(command, '--functions')) &
            call write_functions(option_text(command, '--functions', '-'), case, functions)
        if (given(command, '--plot') .and. .not. from_table) &
            call write_functions(plot_file('functions.csv'), case, functions)
        call write_values(command, method, amplitudes, values, from_table, &
                          case)
        call draw_plot(command)
    end subroutine run_conicity

    !> Either a case or a table, and with a table nothing that a case is asked for.
    subroutine check_sources(command)
        type(command_t), intent(in) :: command

        character(len=*), parameter :: of_a_case(4) = [character(len=11) :: &
            '--roll', '--y-max', '--y-step', '--functions']
        integer :: i

        if (size(command%arguments) == 0 .and. .not. given(command, '--delta-r')) &
            call usage_error('CASE.nml or --delta-r is needed', command%name)
        if (.not. given(command, '--delta-r')) return
        if (size(command%arguments) > 0) &
            call usage_error('--delta-r must not be given with a case, got ' &
                             // command%arguments(1)%text, command%name)
        do i = 1, size(of_a_case)
            if (given(command, trim(of_a_case(i)))) &
                call usage_error(trim(of_a_case(i)) // ' must not be given with --delta-r', &
                                 command%name)
        end do
    end subroutine check_sources

    subroutine read_table(path, y, delta_r)
        character(len=*), intent(in) :: path
        real(wp), allocatable, intent(out) :: y(:), delta_r(:)

        type(csv_table_t) :: table
        type(status_t) :: status
        integer, allocatable :: row(:)

        call read_csv(path, table, status)
        call fail_on_error(status)
        call column_numbers(table, 'y_mm', y, status)
        call fail_on_error(status)
        call column_numbers(table, 'delta_r_mm', delta_r, status)
        call fail_on_error(status)
        call drop_double_rows(y, delta_r, row)
        call check_order(table, y, row)
    end subroutine read_table

    !> Leave out rows that are the ones before once more.
    subroutine drop_double_rows(y, delta_r, row)
        real(wp), allocatable, intent(inout) :: y(:), delta_r(:)
        integer, allocatable, intent(out) :: row(:) ! of the table

        integer :: i

        row = [(i, i=1, size(y))]
        associate (is_kept => [row == 1 .or. y(max(row - 1, 1)) /= y &
                               .or. delta_r(max(row - 1, 1)) /= delta_r])
            row = pack(row, is_kept)
        end associate
        y = y(row)
        delta_r = delta_r(row)
    end subroutine drop_double_rows

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
        if (from > to*(1.0_wp + rounding)) &
            call fail(exit_bad_input, 'the table ends before the amplitude, got ' &
                      // trim(number_text(from)) // ', at most ' // trim(number_text(largest)) &
                      // ' mm (' // path // ')')
        if ((to - from)/step > most_points) &
            call usage_error('--step must leave at most ' // integer_text(most_points) &
                             // ' amplitudes, got ' // trim(number_text(step)), command%name)
        amplitudes = [(from + i*step, i=0, int((to - from)/step + rounding))]
    end subroutine take_steps

    subroutine check_order(table, y, row)
        type(csv_table_t), intent(in) :: table
        real(wp), intent(in) :: y(:)
        integer, intent(in) :: row(:) ! of the table

        type(status_t) :: status
        integer :: i

        do i = 2, size(y)
            if (y(i) > y(i - 1)) cycle
            call set_place_status(status, st_not_increasing, 'y_mm must rise from row to row', &
                                  cell_text(table, row(i), column_index(table, 'y_mm')), &
                                  table%file, table%line(row(i)))
            call fail_on_error(status)
        end do
    end subroutine check_order

    !> The conicity at every amplitude; ends the program at one beyond the table.
    subroutine find_values(path, y, delta_r, amplitudes, values)
        character(len=*), intent(in) :: path
        real(wp), intent(in) :: y(:), delta_r(:), amplitudes(:)
        type(values_t), intent(inout) :: values

        integer :: i

        allocate (values%found(size(amplitudes)), values%states(size(amplitudes)))
        do i = 1, size(amplitudes)
            call find_conicity(y, delta_r, values%y_equilibrium, amplitudes(i), values%found(i), &
                               values%states(i))
            ! Within the table an amplitude whose line passes its end leaves the others.
            if (values%states(i)%code /= st_out_of_range .or. amplitudes(i) > values%largest) &
                call fail_on_error(values%states(i), path)
        end do
    end subroutine find_values

    subroutine write_values(command, method, amplitudes, values, from_table, case)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: method
        real(wp), intent(in) :: amplitudes(:)
        type(values_t), intent(in) :: values
        logical, intent(in) :: from_table
        type(bodies_t), intent(in) :: case

        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: i, taken

        call open_result(command, writer, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, 'equivalent conicity, EN 15302:2008+A1:2010')
        call put_comment(writer, 'equilibrium at y = ' // &
                         trim(number_text(values%y_equilibrium)) // ' mm, where delta r ' // &
                         trim(merge('falls', 'rises', values%falls)))
        if (.not. from_table) call put_wheelset(writer, case)
        call tell_held(writer)
        call put_header(writer, [character(len=19) :: 'amplitude_mm', 'tan_gamma_e', 'y_min_mm', &
                                 'y_max_mm', 'regression', 'nonlinearity_per_mm', 'method', &
                                 'status'])
        taken = merge(2, 1, method == 'regression')
        do i = 1, size(amplitudes)
            associate (found => values%found(i), is_there => .not. is_error(values%states(i)))
                call put_cell(writer, amplitudes(i))
                call put_known(merge(found%regression, found%klingel, taken == 2), is_there .and. &
                               (taken == 2 .or. values%states(i)%code /= st_no_wave))
                call put_known(found%y_min, is_there)
                call put_known(found%y_max, is_there)
                call put_known(found%regression, is_there)
                call put_known(found%nonlinearity(taken), found%has_nonlinearity)
                call put_cell(writer, method)
                call put_cell(writer, trim(status_word(values%states(i)%code)))
                call end_row(writer)
            end associate
        end do
        call close_result(command, writer, shown, status)
        call fail_on_error(status)

    contains

        subroutine put_known(value, is_known)
            real(wp), intent(in) :: value
            logical, intent(in) :: is_known

            call put_cell(writer, value, is_known=is_known)
        end subroutine put_known
    end subroutine write_values
end module faststrip_command_wheelset_conicity
