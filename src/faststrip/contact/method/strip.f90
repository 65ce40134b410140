!> Strips as a method of a contact, with their own error estimate, and ellipses in their place.
module faststrip_contact_method_strip
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, clear_status, is_error, add_limitation, &
                                     message_length, st_under_resolved
    use faststrip_influence_rectangle, only: coupling_constant
    use faststrip_normal_simple_equal_ellipse, only: replace_by_ellipses, equal_area, equal_moments
    use faststrip_normal_estimate_errors, only: estimate_strip_errors
    use faststrip_normal_limitations, only: name_resolution
    use faststrip_normal_strip, only: strip_options_t, strip_solve_demand
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t, demand_of
    use faststrip_contact_method_capacity, only: on_strips_t, check_capacity
    use faststrip_contact_methods, only: normal_table, normal_strip, normal_equal_area, &
                                         normal_equal_moments, tangential_none
    implicit none
    private

    public :: strip_method, equal_area_method, equal_moments_method

    ! Tuned [1]: Errors of penetration, maximum pressure and area by what tractions of dissimilar
    ! materials do to pressures, over K mu. Origin: NORM and TANG, 84 pairs and gaps: nine in ten
    ! are less.
    real(wp), parameter :: lost_of_pressed(3) = [0.1_wp, 1.0_wp, 0.4_wp]

    !> Strips.
    type, extends(on_strips_t) :: strip_method_t
    contains
        procedure :: solve => solve_by_strips
        procedure :: estimate => estimate_by_strips
    end type strip_method_t

    !> Ellipses in the place of the strips of each patch: strips are solved with an estimate, whose
    !> limitations are named, but of the ellipses none is known.
    type, extends(on_strips_t) :: equal_ellipse_t
        integer :: kind = equal_area
    contains
        procedure :: solve => solve_by_ellipses
    end type equal_ellipse_t

    type(strip_method_t), target, save :: strip_method = strip_method_t( &
        about=normal_table(findloc(normal_table%number, normal_strip, dim=1)))
        !! strips
    type(equal_ellipse_t), target, save :: equal_area_method = equal_ellipse_t( &
        about=normal_table(findloc(normal_table%number, normal_equal_area, dim=1)), &
        kind=equal_area)
        !! ellipses of equal area
    type(equal_ellipse_t), target, save :: equal_moments_method = equal_ellipse_t( &
        about=normal_table(findloc(normal_table%number, normal_equal_moments, dim=1)), &
        kind=equal_moments)
        !! ellipses of equal moments

contains

    !> Solve by strips.
    subroutine solve_by_strips(self, workspace, case, normal, status)
        class(strip_method_t), intent(in) :: self     !! strips
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `strip_solve_demand`

        type(strip_options_t) :: options

        call clear_status(status)
        call check_capacity(workspace, case%methods, status)
        if (is_error(status)) return
        options%strips_per_patch = case%methods%strips_per_patch
        options%tolerance = case%strip_tolerance
        ! Other pressures for the same load begin with those before.
        options%warm_start = case%warm_start .or. abs(workspace%load_factor - 1.0_wp) > 0.0_wp
        options%stays = case%stays
        options%resolution_limit = case%resolution_limit
        call strip_solve_demand(workspace%solver, normal_compliance(case%material), &
                                demand_of(workspace, case), &
                                options, workspace%strips, normal, status)
    end subroutine solve_by_strips

    !> Error estimates of the strips; more than the limit is named in the status.
    subroutine estimate_by_strips(self, workspace, case, result, status)
        class(strip_method_t), intent(in) :: self       !! strips
        type(workspace_t), intent(in) :: workspace      !! with their solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        character(len=message_length) :: words
        type(status_t) :: estimate
        real(wp) :: lost(3)

        lost = 0.0_wp
        call estimate_strip_errors(workspace%solver%curve, normal_compliance(case%material), &
                                   workspace%strips, result%normal, result%normal_errors, &
                                   estimate)
        result%is_estimated = .not. is_error(estimate)
        result%has_residuals = result%is_estimated
        if (result%is_estimated) then
            if (case%methods%tangential /= tangential_none) &
                lost = lost_of_pressed*abs(coupling_constant(case%material))*case%mu
            associate (errors => result%normal_errors)
                errors%est_err_penetration = errors%est_err_penetration + lost(1)
                errors%est_err_pmax = errors%est_err_pmax + lost(2)
                errors%est_err_area = errors%est_err_area + lost(3)
            end associate
            call name_resolution(result%normal_errors%est_err_penetration, &
                                 result%normal_errors%est_err_pmax, &
                                 result%normal_errors%est_err_area, case%resolution_limit, status)
        else
            words = 'no error can be estimated:'
            words(len_trim(words) + 2:) = estimate%message
            call add_limitation(status, st_under_resolved, words)
        end if
    end subroutine estimate_by_strips

    !> Solve by strips and put ellipses in their place.
    subroutine solve_by_ellipses(self, workspace, case, normal, status)
        class(equal_ellipse_t), intent(in) :: self    !! which ellipses
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status
            !! of `strip_solve_demand`, `replace_by_ellipses`; `st_under_resolved` of the strips

        type(contact_result_t) :: strips
        type(status_t) :: ellipses

        call solve_by_strips(strip_method, workspace, case, normal, status)
        if (is_error(status)) return
        strips%normal = normal
        if (case%estimate) call estimate_by_strips(strip_method, workspace, case, strips, status)
        call replace_by_ellipses(self%kind, workspace%solver%curve, workspace%strips, normal, &
                                 ellipses)
        if (is_error(ellipses)) status = ellipses
    end subroutine solve_by_ellipses
end module faststrip_contact_method_strip
