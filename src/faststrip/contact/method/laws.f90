!> Creep force laws as methods of a contact: on the Hertz ellipse, if there is one, or on the
!> patches' ellipses; and no forces at all.
module faststrip_contact_method_laws
    use faststrip_base_friction, only: softened
    use faststrip_base_status, only: status_t, clear_status
    use faststrip_tangential_laws, only: law_solve, law_strips_solve, law_linear, &
                                         law_shen_hedrick_elkins, law_polach
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: tangential_method_t, workspace_t, contact_result_t
    use faststrip_contact_method_march_errors, only: left_out_t
    use faststrip_contact_methods, only: tangential_table, tangential_none, tangential_linear, &
                                         tangential_she, tangential_polach
    implicit none
    private

    public :: no_forces, linear_method, she_method, polach_method

    !> No forces.
    type, extends(tangential_method_t) :: no_forces_t
    contains
        procedure :: solve => solve_no_forces
    end type no_forces_t

    !> A creep force law.
    type, extends(left_out_t) :: law_method_t
        integer :: law = law_linear
    contains
        procedure :: solve => solve_by_law
    end type law_method_t

    type(no_forces_t), target, save :: no_forces = no_forces_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_none, dim=1)), &
        cuts_creepages=.false.)
        !! no forces
    ! Linear forces have no limit.
    type(law_method_t), target, save :: linear_method = law_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_linear, dim=1)), &
        cuts_creepages=.false., law=law_linear)
        !! Kalker's linear theory
    type(law_method_t), target, save :: she_method = law_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_she, dim=1)), &
        law=law_shen_hedrick_elkins)
        !! Shen, Hedrick and Elkins
    type(law_method_t), target, save :: polach_method = law_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_polach, dim=1)), &
        law=law_polach)
        !! Polach

contains

    !> Find no forces.
    subroutine solve_no_forces(self, workspace, case, result, status)
        class(no_forces_t), intent(in) :: self                 !! none
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! does not count
        type(contact_result_t), intent(inout) :: result        !! gets zeros
        type(status_t), intent(out) :: status                  !! `st_ok`

        result%tangential = tangential_result_t()
        call clear_status(status)
    end subroutine solve_no_forces

    !> Solve by a creep force law.
    subroutine solve_by_law(self, workspace, case, result, status)
        class(law_method_t), intent(in) :: self                !! which law
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `law_solve`

        if (workspace%is_ellipse) then
            call law_solve(self%law, workspace%hertz, softened(case%material, workspace%friction), &
                           workspace%mu, case%creepage, result%tangential, status, &
                           workspace%strips)
        else
            call law_strips_solve(self%law, workspace%strips, &
                                  softened(case%material, workspace%friction), workspace%mu, &
                                  case%creepage, result%tangential, status)
        end if
    end subroutine solve_by_law
end module faststrip_contact_method_laws
