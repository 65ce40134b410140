!> What a normal method of the core takes by itself: on a gap whose curve is made already, by the
!> calls of an embedding program, timed in groups long enough for the clock.
module faststrip_lab_bench_trade_times
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_command_clock, only: cpu_microseconds, spread_of, spread_names
    use faststrip_command_solver, only: solver_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: solve_contact_normal
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: solution_columns, time_solution

    !> The columns of these times: median, 95th percentile, worst.
    character(len=*), parameter :: solution_columns(3) = 'cpu_us_solution_' // spread_names

    integer, parameter :: n_groups = 9
    ! A group is long enough for the clock, us.
    real(wp), parameter :: enough_us = 100.0_wp

contains

    !> Solve the last contact of a solver again and again, from nothing.
    subroutine time_solution(solver, times, is_known)
        type(solver_t), intent(inout) :: solver !! has solved a contact by a normal method
        real(wp), intent(out) :: times(3)       !! of one solution, us
        logical, intent(out) :: is_known        !! does it solve?

        type(contact_case_t) :: case
        type(normal_result_t) :: normal
        type(status_t) :: status
        real(wp) :: groups(n_groups), before, spent
        integer :: group, i, repeats

        case = solver%case
        ! The workspace has its curve.
        if (allocated(case%gap%y)) deallocate (case%gap%y)
        case%estimate = .false.
        case%warm_start = .false.
        times = 0.0_wp
        repeats = 1
        group = 0
        do while (group < n_groups)
            before = cpu_microseconds()
            do i = 1, repeats
                call solve_contact_normal(solver%workspace, case, normal, status)
            end do
            spent = cpu_microseconds() - before
            is_known = .not. is_error(status)
            if (.not. is_known) return
            if (spent < enough_us) then
                repeats = 2*repeats
                cycle
            end if
            group = group + 1
            groups(group) = spent/repeats
        end do
        times = spread_of(groups)
    end subroutine time_solution
end module faststrip_lab_bench_trade_times
