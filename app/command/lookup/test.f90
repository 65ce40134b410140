!> `faststrip lookup test`: a table of creep forces against direct solutions of fresh states.
module faststrip_command_lookup_test
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, exit_bad_input, &
                                                 begin_table, end_table
    use faststrip_command_lookup_columns, only: hertz_columns, wheel_columns, error_names, &
                                                state_kinds, orders, force_columns
    use faststrip_command_lookup_family, only: families_t, make_family, release_family
    use faststrip_command_lookup_file, only: read_table
    use faststrip_command_lookup_options, only: method_options, take_choice, take_threads, &
                                                choice_text, usual_tests, usual_wheel_tests
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, &
                                   cell_number, put_comment, put_header, put_cell, end_row
    use faststrip_lookup_faces, only: n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel
    use faststrip_tabulate_family, only: family_t, judged_t, states_all
    use faststrip_tabulate_forces, only: choice_t
    use faststrip_tabulate_judge, only: judge_states
    implicit none
    private

    public :: run_lookup_test

    ! States that times are taken of: more than nodes that a cache holds.
    integer, parameter :: timed_states = 2*usual_tests
    ! Tuned [passes]: over them, of which the fastest counts. Origin: chosen: another program may
    ! disturb some.
    integer, parameter :: timed_passes = 5

contains

    !> Run the action from the command line.
    subroutine run_lookup_test()
        type(command_t) :: command
        type(choice_t) :: choice
        type(families_t), target :: families
        class(family_t), pointer :: family
        type(lookup_t) :: lookup
        type(judged_t), allocatable :: states(:), all_states(:)
        type(status_t) :: status
        real(wp), allocatable :: errors(:, :, :, :)
        real(wp) :: times(2)
        integer, allocatable :: tested(:)
        integer :: n, seed, kind
        logical :: is_wheel

        command%name = 'lookup test'
        command%n_words = 2
        command%usage = 'TABLE.fslt'
        command%about = &
            'Compare a table with direct solutions of fresh contacts: a/b over its axis, size,' &
            // new_line('a') // 'load and friction of any kind, creepages of a hundredth to a' &
            // ' hundred times what' // new_line('a') // 'makes mu N by the linear theory, in any' &
            // ' direction. CSV: order,force,mean,' // new_line('a') &
            // 'percentile_99,worst,lookup_us: errors over mu N, of Mz over mu N c, and the' &
            // new_line('a') // 'processor time of a look-up with its 24 derivatives.' &
            // ' The table of a wheel is' // new_line('a') // 'compared with its --case: sums' &
            // ' over the contacts, on fresh states and on such where a' // new_line('a') &
            // 'contact comes or goes.' // new_line('a')
        command%options = [ &
            option_t('--tests', 'N', 'fresh contacts (default 10000, of a wheel 2000 states)'), &
            option_t('--seed', 'N', 'other contacts for another number (default 1)'), &
            option_t('--case', 'CASE.nml', 'wheel and rail of the table of a wheel', &
                     reads=.true.), &
            option_t('--states', 'FILE.csv', 'contacts of its rows instead, as of lookup eval', &
                     reads=.true.), &
            option_t('--contacts', 'FILE', 'write the contacts there, with their forces solved' &
                     // new_line('a') // 'and looked up', writes=.true.), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.), &
            method_options]
        call parse_command(command, 1)
        call take_choice(command, choice)
        call read_table(command%arguments(1)%text, lookup)
        choice%nu = lookup%nu
        is_wheel = lookup%kind == lookup_kind_wheel
        n = option_integer(command, '--tests', merge(usual_wheel_tests, usual_tests, is_wheel), &
                           least=1, most=10000000)
        seed = option_integer(command, '--seed', 1, least=0, most=1000000)
        if (is_wheel .and. given(command, '--states')) &
            call usage_error('--states is for tables of ellipses', command%name)
        if (.not. is_wheel .and. given(command, '--case')) &
            call usage_error('--case is for tables of wheels', command%name)
        if (given(command, '--states') .and. (given(command, '--tests') .or. &
                                              given(command, '--seed'))) &
            call usage_error('--states must not be given with --tests and --seed', command%name)
        if (is_wheel .and. .not. given(command, '--case')) &
            call fail(exit_bad_input, 'the table of a wheel is tested with --case CASE.nml')
        call make_family(command, choice, take_threads(command), lookup, families, family)
        allocate (errors(family%n_errors, 3, 2, family%n_kinds), tested(family%n_kinds))
        allocate (all_states(0))
        do kind = 1, family%n_kinds
            if (given(command, '--states')) then
                call read_states(option_text(command, '--states', ''), states)
            else
                call family%draw(lookup, n, seed, kind, states, status)
                call fail_on_error(status)
            end if
            call judge_states(family, lookup, states, errors(:, :, :, kind), tested(kind), status)
            call fail_on_error(status)
            all_states = [all_states, states]
        end do
        call find_times(family, lookup, times)
        call write_errors(option_text(command, '-o', '-'), is_wheel, errors, tested, times, &
                          choice_text(choice))
        if (given(command, '--contacts')) &
            call write_states(option_text(command, '--contacts', ''), family, is_wheel, all_states)
        call release_family(families)
    end subroutine run_lookup_test

    !> The states of a file; ends the program at one that is none.
    subroutine read_states(path, states)
        character(len=*), intent(in) :: path
        type(judged_t), allocatable, intent(out) :: states(:)

        type(csv_table_t) :: table
        type(status_t) :: status
        integer :: i, row, column

        call read_csv(path, table, status)
        call fail_on_error(status)
        if (table%n_rows == 0) call fail(exit_bad_input, 'there are no states (' // path // ')')
        allocate (states(table%n_rows))
        do i = 1, size(hertz_columns)
            call require_column(table, trim(hertz_columns(i)), column, status)
            call fail_on_error(status)
            do row = 1, table%n_rows
                call cell_number(table, row, column, states(row)%state(i), status)
                call fail_on_error(status)
            end do
        end do
    end subroutine read_states

    !> Errors, one row an error.
    subroutine write_errors(path, is_wheel, errors, tested, times, method)
        character(len=*), intent(in) :: path, method
        logical, intent(in) :: is_wheel
        real(wp), intent(in) :: errors(:, :, :, :), times(2)
        integer, intent(in) :: tested(:)

        type(csv_writer_t) :: writer
        integer :: kind, order, k, i

        call begin_table(writer, path)
        if (is_wheel) then
            call put_comment(writer, integer_text(tested(1)) // ' fresh states, ' &
                             // integer_text(tested(2)) // ' in cells where contacts come or ' &
                             // 'go, ' // method)
            call put_cell(writer, 'states')
        else
            call put_comment(writer, integer_text(tested(1)) // ' contacts, ' // method)
        end if
        call put_header(writer, [character(len=13) :: 'order', merge('error', 'force', is_wheel), &
                                 'mean', 'percentile_99', 'worst', 'lookup_us'])
        do kind = 1, size(errors, 4)
            do order = 1, size(orders)
                do k = 1, size(errors, 1)
                    if (is_wheel) call put_cell(writer, trim(state_kinds(kind)))
                    call put_cell(writer, trim(orders(order)))
                    call put_cell(writer, trim(error_names(k)))
                    do i = 1, 3
                        call put_cell(writer, errors(k, i, order, kind), tested(kind) > 0)
                    end do
                    call put_cell(writer, times(order))
                    call end_row(writer)
                end do
            end do
        end do
        call end_table(writer)
    end subroutine write_errors

    !> States with their sums, solved and looked up.
    subroutine write_states(path, family, is_wheel, states)
        character(len=*), intent(in) :: path
        class(family_t), intent(in) :: family
        logical, intent(in) :: is_wheel
        type(judged_t), intent(in) :: states(:)

        character(len=9), parameter :: sums(6) = [character(len=9) :: &
            'Fx_N', 'Fy_N', 'Fz_N', 'Mz_Nmm', 'N_y_N', 'z_mm']
        type(csv_writer_t) :: writer
        integer :: i, j, k

        call begin_table(writer, path)
        if (is_wheel) then
            call put_comment(writer, 'sums over the contacts of a wheel: creep forces in the ' &
                             // 'track, their moment, the lateral part of the normal ' &
                             // 'forces; the height')
            call put_header(writer, [character(len=16) :: wheel_columns, 'change', 'contacts', &
                                     sums, (sums(k)(:index(sums(k), '_', back=.true.)) &
                                            // 'linear', k=1, size(sums)), &
                                     (sums(k)(:index(sums(k), '_', back=.true.)) // 'cubic', &
                                      k=1, size(sums))])
        else
            call put_header(writer, [character(len=15) :: hertz_columns, force_columns, &
                                     (force_columns(k)(:3) // 'linear' // force_columns(k)(3:), &
                                      k=1, n_forces), &
                                     (force_columns(k)(:3) // 'cubic' // force_columns(k)(3:), &
                                      k=1, n_forces)])
        end if
        do i = 1, size(states)
            associate (state => states(i))
                do k = 1, family%n_numbers
                    call put_cell(writer, state%state(k))
                end do
                if (is_wheel) call put_cell(writer, merge(1, 0, state%changes))
                if (is_wheel) call put_cell(writer, state%n)
                do j = 0, 2
                    do k = 1, family%n_sums
                        call put_cell(writer, state%sums(k, j), state%is_solved)
                    end do
                end do
            end associate
            call end_row(writer)
        end do
        call end_table(writer)
    end subroutine write_states

    !> Processor time of a look-up with derivatives, us: the least of some passes.
    subroutine find_times(family, lookup, times)
        class(family_t), intent(in) :: family
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(out) :: times(2)

        integer, parameter :: order_of(2) = [lookup_linear, lookup_cubic]
        type(judged_t), allocatable :: states(:)
        real(wp) :: before, found(n_forces), total
        type(status_t) :: status
        integer :: i, order, pass

        call family%draw(lookup, timed_states, 0, states_all, states, status)
        call fail_on_error(status)
        times = huge(1.0_wp)
        total = 0.0_wp
        do order = 1, size(order_of)
            do pass = 1, timed_passes
                before = cpu_microseconds()
                do i = 1, size(states)
                    call family%look_up(lookup, order_of(order), states(i), found, status)
                    total = total + abs(found(1))
                end do
                times(order) = min(times(order), (cpu_microseconds() - before)/size(states))
            end do
        end do
        ! What is found has to be used, or nothing of it is done.
        if (total < 0.0_wp) times = 0.0_wp
    end subroutine find_times
end module faststrip_command_lookup_test
