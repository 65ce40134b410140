!> The normal problem of one contact by the core's methods: its workspace.
module faststrip_command_normal_stage
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap, only: check_gap
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: workspace_t, reserve_workspace
    implicit none
    private

    public :: reserve_for_case, reserve_for_points

contains

    !> Grow the workspace to what a contact needs, outside the time that is measured.
    subroutine reserve_for_case(workspace, case, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        class(contact_case_t), intent(in) :: case     !! its gap and methods
        type(status_t), intent(out) :: status         !! those of `check_gap`

        call check_gap(case%gap, status)
        if (is_error(status)) return
        call reserve_for_points(workspace, case, size(case%gap%y), status)
    end subroutine reserve_for_case

    !> The same for a contact whose gap is a curve already.
    subroutine reserve_for_points(workspace, case, points, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        class(contact_case_t), intent(in) :: case     !! its methods
        integer, intent(in) :: points                 !! of the gap
        type(status_t), intent(out) :: status         !! those of `reserve_workspace`

        call reserve_workspace(workspace, case%methods, points, status)
    end subroutine reserve_for_points
end module faststrip_command_normal_stage
