!> `faststrip lookup test` with the table of a wheel: against direct solutions of fresh states.
module faststrip_command_lookup_wheel_test
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail, fail_on_error, put_origin, exit_bad_input
    use faststrip_command_lookup_direct, only: direct_choice_t
    use faststrip_command_lookup_options, only: take_threads, choice_text
    use faststrip_command_lookup_wheel_case, only: read_wheel_case
    use faststrip_command_lookup_wheel_eval, only: wheel_columns
    use faststrip_command_lookup_wheel_judge, only: judged_t, draw_wheel_states, judge_wheel, n_sums
    use faststrip_command_lookup_wheel_solver, only: wheel_solver_t, make_wheel_solvers, &
                                                     release_wheel_solvers
    use faststrip_command_program_options, only: command_t, given, option_text, option_integer
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_comment, put_header, put_cell, &
                                   end_row, close_csv
    use faststrip_lookup_faces, only: n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, n_wheel_errors, n_contact_numbers, most_slots, &
                                      at_load
    use faststrip_lookup_wheel, only: look_up_wheel, look_up_contacts, n_wheel_state, n_wheel_place
    use faststrip_wheelset_types, only: wheelset_model_t
    implicit none
    private

    public :: test_wheel, wheel_error_names, state_kinds

    !> What is compared, and of which states.
    !> Given: their order in a table.
    character(len=3), parameter :: wheel_error_names(n_wheel_errors) = [character(len=3) :: &
        'Fx', 'Fy', 'Mz', 'N_y']
    character(len=6), parameter :: state_kinds(2) = [character(len=6) :: 'all', 'change']
    character(len=6), parameter :: orders(2) = [character(len=6) :: 'linear', 'cubic']
    ! Tuned [states, look-ups]: that times are taken of. Origin: chosen, as for Hertz ellipses.
    integer, parameter :: timed_states = 20000, timed_passes = 5

contains

    !> Compare, and write what came out of it.
    subroutine test_wheel(command, lookup, choice)
        type(command_t), intent(in) :: command      !! parsed
        type(lookup_t), intent(in) :: lookup        !! of a wheel
        type(direct_choice_t), intent(in) :: choice !! what it is compared with

        type(wheelset_model_t) :: model
        type(wheel_solver_t), allocatable :: solvers(:)
        type(judged_t), allocatable :: states(:), all_states(:)
        type(csv_writer_t) :: writer
        type(status_t) :: status
        real(wp) :: errors(n_wheel_errors, 3, 2, 2), times(2)
        integer :: n, seed, kind, order, k, i, n_solved(2)

        if (.not. given(command, '--case')) &
            call fail(exit_bad_input, 'the table of a wheel is tested with --case CASE.nml')
        n = option_integer(command, '--tests', 2000, least=1, most=10000000)
        seed = option_integer(command, '--seed', 1, least=0, most=1000000)
        call read_wheel_case(option_text(command, '--case', ''), model)
        call make_wheel_solvers(model, choice, take_threads(command), solvers, status)
        call fail_on_error(status)
        allocate (all_states(0))
        do kind = 1, 2
            call draw_wheel_states(lookup, n, seed, kind == 2, states)
            call judge_wheel(solvers, lookup, states, errors(:, :, :, kind), n_solved(kind), status)
            call fail_on_error(status)
            all_states = [all_states, states]
        end do
        call release_wheel_solvers(solvers)
        call find_times(lookup, times)
        call open_csv(writer, option_text(command, '-o', '-'), status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, integer_text(n_solved(1)) // ' fresh states, ' &
                         // integer_text(n_solved(2)) // ' in cells where contacts come or go, ' &
                         // choice_text(choice))
        call put_header(writer, [character(len=13) :: 'states', 'order', 'error', 'mean', &
                                 'percentile_99', 'worst', 'lookup_us'])
        do kind = 1, 2
            do order = 1, 2
                do k = 1, n_wheel_errors
                    call put_cell(writer, trim(state_kinds(kind)))
                    call put_cell(writer, trim(orders(order)))
                    call put_cell(writer, trim(wheel_error_names(k)))
                    do i = 1, 3
                        call put_cell(writer, errors(k, i, order, kind), n_solved(kind) > 0)
                    end do
                    call put_cell(writer, times(order))
                    call end_row(writer)
                end do
            end do
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
        if (given(command, '--contacts')) &
            call write_states(option_text(command, '--contacts', ''), all_states)
    end subroutine test_wheel

    ! States with their sums, solved and looked up.
    subroutine write_states(path, states)
        character(len=*), intent(in) :: path
        type(judged_t), intent(in) :: states(:)

        character(len=9), parameter :: sums(n_sums) = [character(len=9) :: &
            'Fx_N', 'Fy_N', 'Fz_N', 'Mz_Nmm', 'N_y_N']
        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: i, j, k

        call open_csv(writer, path, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, 'sums over the contacts of a wheel: creep forces in the track, ' &
                         // 'their moment, the lateral part of the normal forces')
        call put_header(writer, [character(len=16) :: wheel_columns, 'change', 'contacts', &
                                 sums, (sums(k)(:index(sums(k), '_', back=.true.)) // 'linear', &
                                        k=1, n_sums), &
                                 (sums(k)(:index(sums(k), '_', back=.true.)) // 'cubic', &
                                  k=1, n_sums)])
        do i = 1, size(states)
            do k = 1, n_wheel_state
                call put_cell(writer, states(i)%state(k))
            end do
            call put_cell(writer, merge(1, 0, states(i)%changes))
            call put_cell(writer, states(i)%n)
            do j = 0, 2
                do k = 1, n_sums
                    call put_cell(writer, states(i)%sums(k, j), states(i)%is_solved)
                end do
            end do
            call end_row(writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine write_states

    ! Processor time of a look-up of one contact's forces with derivatives, us: the least of some
    ! passes.
    subroutine find_times(lookup, times)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(out) :: times(2)

        integer, parameter :: order_of(2) = [lookup_linear, lookup_cubic]
        type(judged_t), allocatable :: states(:)
        integer, allocatable :: slots(:)
        real(wp) :: before, found(n_forces), jacobian(n_forces, n_wheel_state), total
        real(wp) :: contacts(n_contact_numbers, most_slots)
        type(status_t) :: status
        integer :: i, order, pass

        call draw_wheel_states(lookup, timed_states, 0, .false., states)
        allocate (slots(size(states)))
        do i = 1, size(states)
            call look_up_contacts(lookup, lookup_linear, states(i)%state(:n_wheel_place), &
                                  contacts, status)
            slots(i) = maxloc(contacts(at_load, :), dim=1)
        end do
        times = huge(1.0_wp)
        total = 0.0_wp
        do order = 1, size(order_of)
            do pass = 1, timed_passes
                before = cpu_microseconds()
                do i = 1, size(states)
                    call look_up_wheel(lookup, order_of(order), slots(i), states(i)%state, found, &
                                       status, jacobian)
                    total = total + abs(found(1))
                end do
                times(order) = min(times(order), (cpu_microseconds() - before)/size(states))
            end do
        end do
        ! What is found has to be used, or nothing of it is done.
        if (total < 0.0_wp) times = 0.0_wp
    end subroutine find_times
end module faststrip_command_lookup_wheel_test
