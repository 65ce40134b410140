!> `faststrip-lab bench speed`: what the methods cost on the paper's contacts, all in one run.
!>
!> In each round every contact is solved by every method of a list, turn about; its gap is made a
!> curve, and influence coefficients of its 15 strips are computed. Then the states of a wheelset
!> are solved. So what else happens on the machine falls on all of them, and ratios of two of them
!> hold. Times are those of the processor, of each contact the least of the rounds: the tail over
!> the contacts is the solver's own.
module faststrip_lab_grid_speed
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, end_row
    use faststrip_contact_methods, only: tangential_none
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_grid_column_times, only: column_ns, column_names
    use faststrip_lab_grid_method_list, only: method_entry_t, read_method_list
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_wheelset_types, only: wheelset_workspace_t
    use faststrip_lab_studies_speed_states, only: states_t, read_states, time_states, state_methods
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_command_program_machine, only: cpu_name
    use faststrip_command_contact_solver, only: solver_t, ready_gap_t, new_solver, make_ready, solve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t, times_t
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_geometry_gap, only: gap_t
    implicit none
    private

    public :: bench_speed

    ! Given: the friction of the references.
    real(wp), parameter :: mu = 0.3_wp
    ! Tuned [strips]: whose influence coefficients are computed. Origin: as users have them.
    integer, parameter :: strips_across = 15
    ! Tuned [us]: a time of less is the mean of many. Origin: a clock of whole microseconds.
    real(wp), parameter :: shortest_us = 50.0_wp
    ! Tuned [1]: of how many at most. Origin: chosen.
    integer, parameter :: most_repetitions = 32
    ! Tuned [us]: a contact is timed no more by a method that took so long. Origin: chosen.
    real(wp), parameter :: enough_us = 1.5e5_wp

    !> What a method took on the contacts. Its solver stands beside it: copies of a type that holds
    !> one take long to compile.
    type :: timing_t
        real(wp), allocatable :: us(:), spent(:)
        type(status_t), allocatable :: status(:)
    end type timing_t

contains

    !> Measure and write the CSV.
    subroutine bench_speed(file, methods_file, folder, rounds, quick)
        character(len=*), intent(in) :: file         !! to write, - for stdout
        character(len=*), intent(in) :: methods_file !! with the methods
        character(len=*), intent(in) :: folder       !! with the contacts
        integer, intent(in) :: rounds                !! how often all is timed, >= 1
        logical, intent(in) :: quick                 !! fewer methods and contacts

        type(method_entry_t), allocatable :: entries(:)
        type(bench_case_t), allocatable :: cases(:)
        type(timing_t), allocatable :: timings(:)
        type(solver_t), pointer :: solver
        type(states_t) :: states
        type(wheelset_workspace_t) :: workspace
        real(wp), allocatable :: ns(:, :), gap_us(:)
        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: round, i, k

        call read_method_list(methods_file, entries)
        call read_bench_cases(folder, cases)
        if (quick) then
            entries = pack(entries, [(entries(k)%when == 'always', k=1, size(entries))])
            cases = cases(:: 5)
        end if
        do i = 1, size(cases)
            cases(i)%mu = mu
        end do
        call read_states(quick, states, workspace)
        allocate (timings(size(entries)))
        call new_solver(solver, status)
        call fail_on_error(status)
        do k = 1, size(entries)
            allocate (timings(k)%us(size(cases)), source=huge(1.0_wp))
            allocate (timings(k)%spent(size(cases)), source=0.0_wp)
            allocate (timings(k)%status(size(cases)))
        end do
        allocate (ns(size(column_names), size(cases)), source=huge(1.0_wp))
        allocate (gap_us(size(cases)), source=huge(1.0_wp))
        call begin_table(writer, file)
        call put_header(writer, [character(len=6) :: 'stage', 'method', 'case', 'status', &
                                 'cpu_us', 'cpu'])
        do round = 1, rounds
            call progress('rounds', round, rounds)
            do i = 1, size(cases)
                do k = 1, size(entries)
                    call time_method(entries(k), solver, cases(i), i, timings(k))
                end do
                call time_gap(cases(i), gap_us(i))
                call time_columns(cases(i), ns(:, i))
            end do
            call time_states(states, workspace)
        end do
        do k = 1, size(entries)
            do i = 1, size(cases)
                call put_time(writer, entries(k)%stage, entries(k)%name, cases(i)%name, &
                              timings(k)%us(i), timings(k)%status(i))
            end do
        end do
        do i = 1, size(cases)
            call put_time(writer, 'gap', 'made a curve', cases(i)%name, gap_us(i))
        end do
        do k = 1, size(column_names)
            do i = 1, size(cases)
                ! Numbers are reported in us, too.
                call put_time(writer, 'influence', trim(column_names(k)), cases(i)%name, &
                              1.0e-3_wp*ns(k, i))
            end do
        end do
        do k = 1, size(state_methods)
            do i = 1, size(states%name)
                call put_time(writer, 'wheelset', trim(state_methods(k)), trim(states%name(i)), &
                              states%us(k, i), states%status(k, i))
            end do
        end do
        call end_table(writer)
    end subroutine bench_speed

    !> Time one contact by one method, its own stage only.
    subroutine time_method(entry, solver, bench_case, i, timing)
        type(method_entry_t), intent(in) :: entry
        type(solver_t), intent(inout) :: solver
        type(bench_case_t), intent(in) :: bench_case
        integer, intent(in) :: i !! its number
        type(timing_t), intent(inout) :: timing

        type(contact_case_t) :: case
        type(contact_result_t) :: result
        type(ready_gap_t) :: ready
        type(status_t) :: status
        real(wp) :: us
        integer :: n

        if (timing%spent(i) > enough_us) return
        case = bench_case%contact_case_t
        case%methods = entry%settings%methods
        case%wanted = entry%settings%wanted
        case%asked%times = .true.
        ! Neither what makes the gap a curve nor what estimates errors counts.
        case%estimate = .false.
        call make_ready(0.0_wp, case%gap, ready, timing%status(i))
        ready%id = i
        case%gap = gap_t()
        if (.not. is_error(timing%status(i))) &
            call solve(solver, case, result, timing%status(i), ready)
        if (is_error(timing%status(i))) return
        result%times = times_t()
        us = 0.0_wp
        do n = 1, most_repetitions
            if (entry%stage == 'tangential') then
                call solve_contact_forces(solver%workspace, case, result, status)
                us = result%times%tangential_cpu_us
            else
                if (entry%stage == 'normal') case%methods%tangential = tangential_none
                call solve(solver, case, result, status, ready)
                us = us + result%times%normal_cpu_us + result%times%tangential_cpu_us
            end if
            if (us > shortest_us) exit
        end do
        timing%spent(i) = timing%spent(i) + us
        timing%us(i) = min(timing%us(i), us/min(n, most_repetitions))
    end subroutine time_method

    !> Time what makes the gap a curve, once for all that is solved on it; kept if less than before.
    subroutine time_gap(case, us)
        type(bench_case_t), intent(in) :: case
        real(wp), intent(inout) :: us

        integer, parameter :: repetitions = 4
        type(gap_curve_t) :: curve
        type(status_t) :: status
        real(wp) :: from
        integer :: repetition

        call reserve_gap_curve(curve, size(case%gap%y), status)
        call fail_on_error(status)
        from = cpu_microseconds()
        do repetition = 1, repetitions
            call set_gap_curve(curve, case%gap, status)
        end do
        call fail_on_error(status)
        us = min(us, (cpu_microseconds() - from)/repetitions)
    end subroutine time_gap

    !> Time the influence coefficients of a contact's strips, ns each; kept if less than before.
    subroutine time_columns(case, ns)
        type(bench_case_t), intent(in) :: case
        real(wp), intent(inout) :: ns(:) !! in the order of `column_names`

        ! Tuned [1]: numbers that are timed at once. Origin: chosen: 200 us.
        integer, parameter :: fewest = 4000
        type(workspace_t) :: workspace
        type(normal_result_t) :: result
        type(status_t) :: status
        integer :: k

        call solve_by_strips(workspace, case, strips_across, result, status)
        call fail_on_error(status)
        do k = 1, size(ns)
            ns(k) = min(ns(k), column_ns(k, workspace%strips, fewest))
        end do
    end subroutine time_columns

    !> A row; one that could not be solved has no time.
    subroutine put_time(writer, stage, method, name, us, status)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: stage, method, name
        real(wp), intent(in) :: us
        type(status_t), intent(in), optional :: status

        call put_cell(writer, stage)
        call put_cell(writer, method)
        call put_cell(writer, name)
        if (present(status)) then
            call put_cell(writer, trim(status_word(status%code)))
        else
            call put_cell(writer, 'ok')
        end if
        call put_cell(writer, us, is_known=us < huge(1.0_wp))
        call put_cell(writer, cpu_name())
        call end_row(writer)
    end subroutine put_time
end module faststrip_lab_grid_speed
