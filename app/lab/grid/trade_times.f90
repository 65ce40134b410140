!> What a normal method of the core takes by itself: on a gap whose curve is made already, by the
!> calls of an embedding program, timed in groups long enough for the clock.
module faststrip_lab_grid_trade_times
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_command_program_clock, only: cpu_microseconds, spread_of, spread_names
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: tangential_none
    use faststrip_contact_solve, only: solve_contact
    use faststrip_geometry_gap, only: gap_t
    implicit none
    private

    public :: solution_columns, time_solution

    !> The columns of these times: median, 95th percentile, worst.
    character(len=*), parameter :: solution_columns(3) = 'cpu_us_solution_' // spread_names

    integer, parameter :: n_groups = 9
    ! A group is long enough for the clock, us.
    real(wp), parameter :: enough_us = 100.0_wp

contains

    !> Solve the last contact of a workspace again and again, cold, without forces.
    subroutine time_solution(workspace, solved, times, is_known)
        type(workspace_t), intent(inout) :: workspace !! has solved a contact by a normal method
        type(contact_case_t), intent(in) :: solved    !! that contact
        real(wp), intent(out) :: times(3)       !! of one solution, us
        logical, intent(out) :: is_known        !! does it solve?

        type(contact_case_t) :: case
        type(contact_result_t) :: result
        type(status_t) :: status
        real(wp) :: groups(n_groups), before, spent
        integer :: group, i, repeats

        case = solved
        case%methods%tangential = tangential_none
        case%asked%times = .false.
        ! The workspace has its curve.
        case%gap = gap_t()
        case%estimate = .false.
        case%warm_start = .false.
        times = 0.0_wp
        repeats = 1
        group = 0
        do while (group < n_groups)
            before = cpu_microseconds()
            do i = 1, repeats
                call solve_contact(workspace, case, result, status)
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
end module faststrip_lab_grid_trade_times
