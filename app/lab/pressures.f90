!> The pressures of one contact, on which benches then judge and time forces.
module faststrip_lab_pressures
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: tangential_none
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: solve_contact
    use faststrip_geometry_gap, only: check_gap
    implicit none
    private

    public :: solve_pressures

contains

    !> Solve the normal problem of a contact, whatever its tangential method.
    subroutine solve_pressures(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace !! grown as needed
        class(contact_case_t), intent(in) :: case     !! with its gap
        type(contact_result_t), intent(out) :: result !! without forces
        type(status_t), intent(out) :: status         !! those of `solve_contact`

        type(contact_case_t) :: normal

        call check_gap(case%gap, status)
        if (.not. is_error(status)) &
            call reserve_workspace(workspace, case%methods, size(case%gap%y), status)
        if (is_error(status)) return
        normal = case
        normal%methods%tangential = tangential_none
        call solve_contact(workspace, normal, result, status)
    end subroutine solve_pressures
end module faststrip_lab_pressures
