!> Kalker's FASTSIM and its variants as methods of a contact: on the Hertz ellipse, if there is one,
!> or on the patches' ellipses.
module faststrip_contact_method_fastsim
    use faststrip_base_friction, only: softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_tangential_fastsim, only: fastsim_curved_solve, fastsim_rolling_t, &
                                            fastsim_variant_t
    use faststrip_tangential_force_errors, only: errors_of_fastsim
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_method_asked, only: asked_field, asked_strip_forces
    use faststrip_contact_method_march_errors, only: left_out_t, estimate_march
    use faststrip_contact_methods, only: tangential_table, tangential_fastsim, &
                                         tangential_fastsim_elliptic, tangential_fastsim_weighted
    implicit none
    private

    public :: fastsim_method, elliptic_fastsim_method, weighted_fastsim_method

    !> A variant of FASTSIM.
    type, extends(left_out_t) :: fastsim_method_t
        logical :: elliptic_bound = .false.
        logical :: single_flexibility = .false.
    contains
        procedure :: solve => solve_by_fastsim
    end type fastsim_method_t

    !> Kalker's own, whose errors are known.
    type, extends(fastsim_method_t) :: kalkers_fastsim_t
    contains
        procedure :: estimate => estimate_by_fastsim
    end type kalkers_fastsim_t

    type(kalkers_fastsim_t), target, save :: fastsim_method = kalkers_fastsim_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_fastsim, dim=1)), &
        gives_strip_forces=.false.)
        !! FASTSIM
    type(fastsim_method_t), target, save :: elliptic_fastsim_method = fastsim_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_fastsim_elliptic, &
                                       dim=1)), gives_strip_forces=.false., elliptic_bound=.true.)
        !! FASTSIM with the elliptic traction bound
    type(fastsim_method_t), target, save :: weighted_fastsim_method = fastsim_method_t( &
        about=tangential_table(findloc(tangential_table%number, tangential_fastsim_weighted, &
                                       dim=1)), gives_strip_forces=.false., &
        single_flexibility=.true.)
        !! FASTSIM with a single flexibility

contains

    !> Solve by FASTSIM.
    subroutine solve_by_fastsim(self, workspace, case, result, status)
        class(fastsim_method_t), intent(in) :: self            !! which variant
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `fastsim_curved_solve`

        type(fastsim_rolling_t) :: rolling

        rolling = fastsim_rolling_t(softened(case%material, workspace%friction), workspace%mu, &
                                    case%creepage, case%methods%fastsim_nx, &
                                    case%methods%fastsim_ny, fastsim_variant_t( &
                                    self%elliptic_bound, self%single_flexibility))
        if (workspace%is_ellipse) then
            call fastsim_curved_solve(workspace%strips, rolling, result%tangential, status, &
                                      asked_field(workspace, case), workspace%friction, &
                                      asked_strip_forces(workspace, case), workspace%hertz)
        else
            call fastsim_curved_solve(workspace%strips, rolling, result%tangential, status, &
                                      asked_field(workspace, case), workspace%friction, &
                                      asked_strip_forces(workspace, case))
        end if
    end subroutine solve_by_fastsim

    !> Error estimates of its forces.
    subroutine estimate_by_fastsim(self, workspace, case, result, status, finer)
        class(kalkers_fastsim_t), intent(in) :: self    !! Kalker's own
        type(workspace_t), intent(in) :: workspace      !! with a solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer         !! see `estimate_force_errors`

        call estimate_march(workspace, case, errors_of_fastsim, case%methods%fastsim_nx, result, &
                            status, finer)
    end subroutine estimate_by_fastsim
end module faststrip_contact_method_fastsim
