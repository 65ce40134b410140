!> The Hertz ellipse as a method of a contact, with what the gap differs from its parabola by.
module faststrip_contact_method_hertz
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_simple_hertz, only: hertz_solve_gap_demand, hertz_strips
    use faststrip_normal_estimate_hertz_errors, only: estimate_hertz_errors
    use faststrip_normal_limitations, only: check_lowest, name_resolution, name_conformal, &
                                            name_steps
    use faststrip_normal_estimate_misfit, only: misfit_t, find_misfit
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_hertz_errors, only: add_hertz_errors
    use faststrip_tangential_motion, only: cut_creepage
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t, demand_of
    use faststrip_contact_method_capacity, only: on_gap_t, ellipse_strips
    use faststrip_contact_methods, only: normal_table, normal_hertz
    implicit none
    private

    public :: hertz_method, add_shape_errors

    !> The ellipse where the gap is lowest.
    type, extends(on_gap_t) :: hertz_method_t
    contains
        procedure :: solve => solve_by_hertz
        procedure :: estimate => estimate_by_hertz
    end type hertz_method_t

    type(hertz_method_t), target, save :: hertz_method = hertz_method_t( &
        about=normal_table(findloc(normal_table%number, normal_hertz, dim=1)))
        !! the Hertz ellipse

contains

    !> Solve by Hertz.
    subroutine solve_by_hertz(self, workspace, case, normal, status)
        class(hertz_method_t), intent(in) :: self     !! Hertz
        type(workspace_t), intent(inout) :: workspace !! its ellipse and strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `hertz_solve_gap_demand`

        associate (hertz => workspace%hertz, curve => workspace%solver%curve)
            call hertz_solve_gap_demand(curve, normal_compliance(case%material), &
                                        demand_of(workspace, case), hertz, status)
            if (is_error(status)) return
            normal%load = hertz%load
            normal%penetration = hertz%penetration + curve%h_lowest
            normal%area = hertz%area
            normal%pmax = hertz%pmax
            normal%y_min = hertz%y - hertz%b
            normal%y_max = hertz%y + hertz%b
            normal%x_max = hertz%a
            normal%n_patches = 1
            call check_lowest(curve, hertz%penetration, status)
            if (is_error(status)) then
                normal = normal_result_t()
                return
            end if
            call hertz_strips(hertz, ellipse_strips(case%methods), workspace%strips, status)
            if (is_error(status)) return
            workspace%is_ellipse = .true.
            call name_conformal(curve, workspace%strips, status, .true.)
            call name_steps(curve, hertz%penetration, workspace%strips, status)
        end associate
    end subroutine solve_by_hertz

    !> Error estimates of the ellipse; more than the limit is named in the status.
    subroutine estimate_by_hertz(self, workspace, case, result, status)
        class(hertz_method_t), intent(in) :: self       !! Hertz
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        result%normal_errors = estimate_hertz_errors(misfit_of(workspace, case))
        result%is_estimated = .true.
        result%has_residuals = .true.
        call name_resolution(result%normal_errors%est_err_penetration, &
                             result%normal_errors%est_err_pmax, &
                             result%normal_errors%est_err_area, case%resolution_limit, status)
    end subroutine estimate_by_hertz

    !> Add to the errors of forces on the workspace's Hertz ellipse what its shape is wrong by: an
    !> ellipse that was handed over has no gap that it could differ from.
    pure subroutine add_shape_errors(workspace, case, errors, status)
        type(workspace_t), intent(in) :: workspace    !! with a solution by Hertz
        type(contact_case_t), intent(in) :: case      !! what was solved
        type(force_errors_t), intent(inout) :: errors !! of a method on the ellipse
        type(status_t), intent(inout) :: status       !! that of `kalker_coefficients`

        type(creepage_t) :: creepage
        real(wp) :: share

        if (workspace%solver%curve%n == 0) return
        call cut_creepage(case%creepage, creepage, share)
        call add_hertz_errors(workspace%hertz, misfit_of(workspace, case), &
                              softened(case%material, workspace%friction), workspace%mu, creepage, &
                              errors, status)
    end subroutine add_shape_errors

    !> What the gap in the workspace differs from the parabola of its Hertz contact by.
    pure type(misfit_t) function misfit_of(workspace, case) result(misfit)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case

        misfit = find_misfit(workspace%solver%curve, normal_compliance(case%material), &
                             workspace%hertz)
    end function misfit_of
end module faststrip_contact_method_hertz
