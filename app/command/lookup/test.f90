!> `faststrip lookup test`: a table of creep forces against direct solutions of fresh contacts.
module faststrip_command_lookup_test
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, put_origin, &
                                                 exit_bad_input
    use faststrip_command_lookup_direct, only: direct_choice_t, direct_t, make_workers, &
                                               release_workers
    use faststrip_command_lookup_file, only: read_table
    use faststrip_command_lookup_eval, only: state_columns
    use faststrip_command_lookup_fill, only: judge_states, draw_states
    use faststrip_command_lookup_options, only: direct_options, take_direct_options, &
                                                take_threads, choice_text
    use faststrip_command_lookup_wheel_test, only: test_wheel
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer
    use faststrip_command_program_system, only: set_progress
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, &
                                   cell_number, open_csv, put_comment, put_header, put_cell, &
                                   end_row, close_csv
    use faststrip_lookup_faces, only: n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_hertz, only: look_up_hertz, n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel
    implicit none
    private

    public :: run_lookup_test

    character(len=2), parameter :: forces(3) = ['Fx', 'Fy', 'Mz']
    character(len=6), parameter :: orders(2) = [character(len=6) :: 'linear', 'cubic']
    ! Tuned [states, look-ups]: that times are taken of. Origin: chosen; long enough for a clock,
    ! with more states than nodes that a cache holds.
    integer, parameter :: timed_states = 20000, timed_passes = 10

contains

    !> Run the action from the command line.
    subroutine run_lookup_test()
        type(command_t) :: command
        type(direct_choice_t) :: choice
        type(direct_t), allocatable :: workers(:)
        type(lookup_t) :: lookup
        type(csv_writer_t) :: writer
        type(status_t) :: status
        real(wp), allocatable :: states(:, :), forces_of(:, :, :)
        real(wp) :: errors(3, 3, 2), times(2)
        integer :: n, seed, order, k, i

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
            option_t('--tests', 'N', 'fresh contacts (default 10000)'), &
            option_t('--seed', 'N', 'other contacts for another number (default 1)'), &
            option_t('--case', 'CASE.nml', 'wheel and rail of the table of a wheel', &
                     reads=.true.), &
            option_t('--states', 'FILE.csv', 'contacts of its rows instead, as of lookup eval', &
                     reads=.true.), &
            option_t('--contacts', 'FILE', 'write the contacts there, with their forces solved' &
                     // new_line('a') // 'and looked up', writes=.true.), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.), &
            direct_options]
        call parse_command(command, 1)
        call take_direct_options(command, choice)
        n = option_integer(command, '--tests', 10000, least=1, most=10000000)
        seed = option_integer(command, '--seed', 1, least=0, most=1000000)
        call read_table(command%arguments(1)%text, lookup)
        choice%nu = lookup%nu
        if (lookup%kind == lookup_kind_wheel) then
            if (given(command, '--states')) &
                call usage_error('--states is for tables of ellipses', command%name)
            call test_wheel(command, lookup, choice)
            return
        else if (given(command, '--case')) then
            call usage_error('--case is for tables of wheels', command%name)
        end if
        call make_workers(choice, take_threads(command), workers, status)
        call fail_on_error(status)
        if (given(command, '--states')) then
            if (given(command, '--tests') .or. given(command, '--seed')) &
                call usage_error('--states must not be given with --tests and --seed', command%name)
            call read_states(option_text(command, '--states', ''), states)
        else
            call draw_states(lookup, n, seed, states, status)
            call fail_on_error(status)
        end if
        call set_progress('contacts')
        call judge_states(workers, lookup, states, forces_of, errors, status)
        call fail_on_error(status)
        call release_workers(workers)
        call find_times(lookup, times)
        call open_csv(writer, option_text(command, '-o', '-'), status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, integer_text(size(states, 2)) // ' contacts, ' &
                         // choice_text(choice))
        call put_header(writer, [character(len=13) :: 'order', 'force', 'mean', 'percentile_99', &
                                 'worst', 'lookup_us'])
        do order = 1, size(orders)
            do k = 1, size(forces)
                call put_cell(writer, trim(orders(order)))
                call put_cell(writer, forces(k))
                do i = 1, 3
                    call put_cell(writer, errors(k, i, order))
                end do
                call put_cell(writer, times(order))
                call end_row(writer)
            end do
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
        if (given(command, '--contacts')) &
            call write_contacts(option_text(command, '--contacts', ''), states, forces_of)
    end subroutine run_lookup_test

    !> The states of a file; ends the program at one that is none.
    subroutine read_states(path, states)
        character(len=*), intent(in) :: path
        real(wp), allocatable, intent(out) :: states(:, :)

        type(csv_table_t) :: table
        type(status_t) :: status
        integer :: i, row, column

        call read_csv(path, table, status)
        call fail_on_error(status)
        if (table%n_rows == 0) call fail(exit_bad_input, 'there are no states (' // path // ')')
        allocate (states(n_lookup_state, table%n_rows))
        do i = 1, n_lookup_state
            call require_column(table, trim(state_columns(i)), column, status)
            call fail_on_error(status)
            do row = 1, table%n_rows
                call cell_number(table, row, column, states(i, row), status)
                call fail_on_error(status)
            end do
        end do
    end subroutine read_states

    !> Contacts with their forces, solved and looked up.
    subroutine write_contacts(path, states, forces_of)
        character(len=*), intent(in) :: path
        real(wp), intent(in) :: states(:, :), forces_of(:, :, :)

        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: i, j, k

        call open_csv(writer, path, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_header(writer, [character(len=15) :: state_columns, 'Fx_N', 'Fy_N', 'Mz_Nmm', &
                                 'Fx_linear_N', 'Fy_linear_N', 'Mz_linear_Nmm', 'Fx_cubic_N', &
                                 'Fy_cubic_N', 'Mz_cubic_Nmm'])
        do i = 1, size(states, 2)
            do k = 1, n_lookup_state
                call put_cell(writer, states(k, i))
            end do
            do j = 1, size(forces_of, 2)
                do k = 1, n_forces
                    call put_cell(writer, forces_of(k, j, i))
                end do
            end do
            call end_row(writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine write_contacts

    !> Processor time of a look-up with derivatives, us: the least of some passes.
    subroutine find_times(lookup, times)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(out) :: times(2)

        integer, parameter :: order_of(2) = [lookup_linear, lookup_cubic]
        real(wp), allocatable :: states(:, :)
        real(wp) :: before, found(n_forces), jacobian(n_forces, n_lookup_state), total
        type(status_t) :: status
        integer :: i, order, pass

        call draw_states(lookup, timed_states, 0, states, status)
        call fail_on_error(status)
        times = huge(1.0_wp)
        total = 0.0_wp
        do order = 1, size(order_of)
            do pass = 1, timed_passes
                before = cpu_microseconds()
                do i = 1, timed_states
                    call look_up_hertz(lookup, order_of(order), states(:, i), found, status, &
                                       jacobian)
                    total = total + abs(found(1))
                end do
                times(order) = min(times(order), (cpu_microseconds() - before)/timed_states)
            end do
        end do
        ! What is found has to be used, or nothing of it is done.
        if (total < 0.0_wp) times = 0.0_wp
    end subroutine find_times
end module faststrip_command_lookup_test
