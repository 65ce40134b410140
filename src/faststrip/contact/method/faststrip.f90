!> FASTSTRIP, the march in the strips, as a method of a contact.
module faststrip_contact_method_faststrip
    use faststrip_base_friction, only: softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve
    use faststrip_tangential_force_errors, only: errors_of_march, errors_of_fitted
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_method_asked, only: asked_field, asked_strip_forces
    use faststrip_contact_method_march_errors, only: left_out_t, estimate_march
    use faststrip_contact_methods, only: tangential_table, tangential_faststrip, &
                                         tangential_faststrip_plain
    implicit none
    private

    public :: faststrip_method, plain_faststrip_method

    !> With its correction, or without.
    type, extends(left_out_t) :: faststrip_method_t
        logical :: is_corrected = .true.
    contains
        procedure :: solve => solve_by_faststrip
        procedure :: estimate => estimate_by_faststrip
    end type faststrip_method_t

    type(faststrip_method_t), target, save :: faststrip_method = faststrip_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_faststrip, dim=1)))
        !! FASTSTRIP
    type(faststrip_method_t), target, save :: plain_faststrip_method = faststrip_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_faststrip_plain, &
                                       dim=1)), is_corrected=.false.)
        !! FASTSTRIP without its correction

contains

    !> Solve by FASTSTRIP.
    subroutine solve_by_faststrip(self, workspace, case, result, status)
        class(faststrip_method_t), intent(in) :: self          !! corrected or not
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `faststrip_tangential_solve`

        call faststrip_tangential_solve( &
            workspace%strips, softened(case%material, workspace%friction), workspace%mu, &
            case%creepage, case%methods%points_per_strip, result%tangential, status, &
            asked_field(workspace, case), asked_strip_forces(workspace, case), &
            self%is_corrected, workspace%friction)
    end subroutine solve_by_faststrip

    !> Error estimates of its forces.
    subroutine estimate_by_faststrip(self, workspace, case, result, status, finer)
        class(faststrip_method_t), intent(in) :: self   !! corrected or not
        type(workspace_t), intent(in) :: workspace      !! with a solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer         !! see `estimate_force_errors`

        call estimate_march(workspace, case, &
                            merge(errors_of_fitted, errors_of_march, self%is_corrected), &
                            case%methods%points_per_strip, result, status, finer)
    end subroutine estimate_by_faststrip
end module faststrip_contact_method_faststrip
