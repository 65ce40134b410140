!> The tangential problem of one contact, by the method asked for.
module faststrip_command_tangential_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, strip_forces_t
    use faststrip_contact_solve, only: contact_case_t, solve_contact_tangential
    use faststrip_command_normal_stage, only: normal_stage_t
    implicit none
    private

    public :: solve_tangential

contains

    !> Solve the tangential problem on a normal solution.
    subroutine solve_tangential(normal, material, mu, creepage, tangential, status, field, &
                                per_strip)
        type(normal_stage_t), intent(in) :: normal   !! with a solution
        type(material_t), intent(in) :: material     !! moduli, MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction
        type(creepage_t), intent(in) :: creepage     !! about y = 0
        type(tangential_result_t), intent(out) :: tangential !! figures
        type(status_t), intent(out) :: status        !! an error, or a named limitation
        type(tangential_field_t), intent(inout), optional :: field !! elements, if wanted
        type(strip_forces_t), intent(inout), optional :: per_strip !! of faststrip, if wanted

        type(contact_case_t) :: case

        case%material = material
        case%mu = mu
        case%creepage = creepage
        case%methods = normal%methods
        call solve_contact_tangential(normal%workspace, case, tangential, status, field, &
                                      per_strip)
    end subroutine solve_tangential
end module faststrip_command_tangential_stage
