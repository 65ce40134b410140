!> TFASTSTRIP of the paper, as printed and as corrected, as methods of a contact.
module faststrip_contact_method_paper
    use faststrip_base_friction, only: softened
    use faststrip_base_status, only: status_t
    use faststrip_tangential_paper, only: paper_solve, corrected_solve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_method_asked, only: asked_field
    use faststrip_contact_method_march_errors, only: left_out_t
    use faststrip_contact_methods, only: tangential_table, tangential_faststrip_paper, &
                                         tangential_faststrip_corrected
    implicit none
    private

    public :: printed_method, corrected_method

    !> As printed.
    type, extends(left_out_t) :: printed_method_t
    contains
        procedure :: solve => solve_as_printed
    end type printed_method_t

    !> As corrected.
    type, extends(left_out_t) :: corrected_method_t
    contains
        procedure :: solve => solve_as_corrected
    end type corrected_method_t

    type(printed_method_t), target, save :: printed_method = printed_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_faststrip_paper, &
                                       dim=1)))
        !! TFASTSTRIP as printed
    type(corrected_method_t), target, save :: corrected_method = corrected_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_faststrip_corrected, &
                                       dim=1)))
        !! TFASTSTRIP as corrected

contains

    !> Solve by TFASTSTRIP as printed.
    subroutine solve_as_printed(self, workspace, case, result, status)
        class(printed_method_t), intent(in) :: self            !! as printed
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `paper_solve`

        call paper_solve(workspace%strips, softened(case%material, workspace%friction), &
                         workspace%mu, case%creepage, case%methods%points_per_strip, &
                         result%tangential, status, asked_field(workspace, case))
    end subroutine solve_as_printed

    !> Solve by TFASTSTRIP as corrected.
    subroutine solve_as_corrected(self, workspace, case, result, status)
        class(corrected_method_t), intent(in) :: self          !! as corrected
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `corrected_solve`

        call corrected_solve(workspace%strips, softened(case%material, workspace%friction), &
                             workspace%mu, case%creepage, case%methods%points_per_strip, &
                             result%tangential, status, asked_field(workspace, case))
    end subroutine solve_as_corrected
end module faststrip_contact_method_paper
