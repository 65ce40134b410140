!> The normal problem of one contact by the core's methods: its workspace.
module faststrip_command_normal_stage
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap, only: check_gap
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: workspace_t, reserve_workspace
    implicit none
    private

    public :: reserve_for_case

contains

    !> Grow the workspace to what a contact needs, outside the time that is measured.
    subroutine reserve_for_case(workspace, case, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        class(contact_case_t), intent(in) :: case     !! its gap and methods
        type(status_t), intent(out) :: status         !! those of `check_gap`

        call check_gap(case%gap, status)
        if (is_error(status)) return
        call reserve_workspace(workspace, case%methods, size(case%gap%y), status)
    end subroutine reserve_for_case
end module faststrip_command_normal_stage
