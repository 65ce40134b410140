!> The normal problem of one contact by the core's methods: its workspace.
module faststrip_command_normal_stage
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap, only: check_gap
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: workspace_t, reserve_workspace
    implicit none
    private

    public :: make_room

contains

    !> Grow the workspace to what a contact needs, outside the time that is measured.
    subroutine make_room(workspace, contact, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        class(contact_case_t), intent(in) :: contact  !! its gap and methods
        type(status_t), intent(out) :: status         !! those of `check_gap`

        call check_gap(contact%gap, status)
        if (is_error(status)) return
        call reserve_workspace(workspace, contact%methods, size(contact%gap%y), status)
    end subroutine make_room
end module faststrip_command_normal_stage
