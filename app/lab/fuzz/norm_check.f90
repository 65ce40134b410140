!> Kalker's method on a grid as a check: another discretisation of another kind.
!>
!> The grid has some 25 elements along the contact and 40 across each patch, and half as many
!> before: the difference is NORM's own estimate. What may differ are both estimates, with a margin,
!> and a floor for what the elements resolve.
module faststrip_lab_fuzz_norm_check
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, release_norm
    use faststrip_lab_pressures, only: solve_by_norm
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_fuzz_checks, only: verdict_t, report_badness, check_norm_depth, &
                                         check_norm_pmax, check_norm_area
    implicit none
    private

    public :: check_by_norm

    real(wp), parameter :: elements_along = 25.0_wp, elements_across = 40.0_wp
    integer, parameter :: most_elements = 60000
    real(wp), parameter :: margin = 3.0_wp         ! of the estimates
    real(wp), parameter :: floor(3) = [0.01_wp, 0.05_wp, 0.06_wp] ! penetration, pmax, area

contains

    !> Solve the case on a grid and compare; where no grid holds the contact nothing is checked.
    subroutine check_by_norm(case, curve, strips, verdict)
        class(contact_case_t), intent(in) :: case    !! material, demand
        type(gap_curve_t), intent(in) :: curve       !! its gap
        type(contact_strips_t), intent(in) :: strips !! its solution
        type(verdict_t), intent(inout) :: verdict

        type(norm_workspace_t) :: workspace
        type(norm_options_t) :: options
        type(normal_result_t) :: norm
        type(status_t) :: status
        real(wp) :: depth, norm_depth, own(3), narrowest
        integer :: p

        narrowest = strips%y_right(strips%n) - strips%y_left(1)
        do p = 1, strips%n_patches
            narrowest = min(narrowest, &
                            maxval(strips%y_right(:strips%n), strips%patch(:strips%n) == p) &
                            - minval(strips%y_left(:strips%n), strips%patch(:strips%n) == p))
        end do
        options%dx = 2.0_wp*maxval(strips%half_length(:strips%n))/elements_along
        options%dy = narrowest/elements_across
        options%most_elements = most_elements
        call solve_by_norm(workspace, case, options, norm, status, strips)
        if (.not. is_error(status) .and. workspace%is_estimated) then
            depth = verdict%result%penetration - curve%h_lowest
            norm_depth = norm%penetration - curve%h_lowest
            own = [workspace%normal_errors%est_err_penetration, &
                   workspace%normal_errors%est_err_pmax, workspace%normal_errors%est_err_area]
            call compare(check_norm_depth, 1, depth/norm_depth)
            call compare(check_norm_pmax, 2, verdict%result%pmax/norm%pmax)
            call compare(check_norm_area, 3, verdict%result%area/norm%area)
        end if
        call release_norm(workspace)

    contains

        subroutine compare(check, figure, ratio)
            integer, intent(in) :: check, figure
            real(wp), intent(in) :: ratio

            call report_badness(verdict, check, abs(ratio - 1.0_wp) &
                                /(floor(figure) &
                                  + margin*(own(figure) + verdict%est_err(figure))))
        end subroutine compare
    end subroutine check_by_norm
end module faststrip_lab_fuzz_norm_check
