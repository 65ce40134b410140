!> Where a tangential method puts what a case asks for besides the sums.
module faststrip_contact_method_asked
    use faststrip_tangential_types, only: tangential_field_t, strip_forces_t
    use faststrip_contact_case, only: contact_case_t, keeps_elements, wants_strip_forces
    use faststrip_contact_method, only: workspace_t
    implicit none
    private

    public :: asked_field, asked_strip_forces

contains

    !> The workspace's field if the case needs it, else no target: an absent argument.
    function asked_field(workspace, case) result(field)
        type(workspace_t), intent(in), target :: workspace !! owns it
        type(contact_case_t), intent(in) :: case           !! may ask for it
        type(tangential_field_t), pointer :: field

        field => null()
        if (keeps_elements(case)) field => workspace%field
    end function asked_field

    !> The workspace's sums over strips, likewise.
    function asked_strip_forces(workspace, case) result(forces)
        type(workspace_t), intent(in), target :: workspace !! owns them
        type(contact_case_t), intent(in) :: case           !! may ask for them
        type(strip_forces_t), pointer :: forces

        forces => null()
        if (wants_strip_forces(case)) forces => workspace%strip_forces
    end function asked_strip_forces
end module faststrip_contact_method_asked
