!> Error estimates of the Hertz contact of a gap, from what the gap differs from its parabola by.
!>
!> With the numbers of `faststrip_normal_estimate_misfit`, all over the penetration, and e the rise
!> of the parabola to the ellipse's end, over Hertz's figures
!>
!>     penetration   0.3 (4 |mean| + magnitude + 2 overlap)
!>     pmax          0.43 [(2 |mean| + magnitude)/e + overlap], at least peak - 1
!>     area          1.6 (tips/e + 0.6 overlap)
!>
!> and, as the true ones may be smaller by as much, E (1 + E) of each.
!> The mean is the penetration's error to first order; the magnitude bounds what it is by second
!> order or what cancels by chance. Pressure and area follow the curvature: a needle along x (e
!> small) feels differences that its penetration does not. The factors were chosen on 790 random
!> gaps of `faststrip-lab force-data` of eight families, whose differences from the parabola were
!> made up to 1000 times smaller, against 31 strips; of six other families they bound 99 %, of
!> single patches of `faststrip-lab fuzz` 94 to 98 %, and are two to seven times the error in the
!> median.
module faststrip_normal_estimate_hertz_errors
    use faststrip_base_kinds, only: wp
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_estimate_misfit, only: misfit_t
    implicit none
    private

    public :: estimate_hertz_errors

    ! Tuned [1]: The penetration's factors, see the module's head. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: penetration_factor = 0.3_wp, penetration_mean = 4.0_wp, &
                           penetration_overlap = 2.0_wp
    ! Tuned [1]: The maximum pressure's factors. Origin: calibrated, see the module's head.
    real(wp), parameter :: pmax_factor = 0.43_wp, pmax_mean = 2.0_wp
    ! Tuned [1]: The area's factors. Origin: calibrated, see the module's head.
    real(wp), parameter :: area_factor = 1.6_wp, area_overlap = 0.6_wp

contains

    !> The error estimates of a Hertz contact.
    pure type(normal_errors_t) function estimate_hertz_errors(misfit) result(normal_errors)
        type(misfit_t), intent(in) :: misfit !! of its gap

        normal_errors%residual_inside = misfit%inside
        normal_errors%overlap_outside = misfit%overlap
        normal_errors%est_err_penetration = over_exact( &
            penetration_factor*(penetration_mean*abs(misfit%mean) + misfit%magnitude &
                                + penetration_overlap*misfit%overlap))
        normal_errors%est_err_pmax = over_exact(max( &
            pmax_factor*((pmax_mean*abs(misfit%mean) + misfit%magnitude)/misfit%rise &
                         + misfit%overlap), misfit%peak - 1.0_wp))
        normal_errors%est_err_area = &
            over_exact(area_factor*(misfit%tips/misfit%rise + area_overlap*misfit%overlap))
    end function estimate_hertz_errors

    !> An error over a figure as one over the exact figure, which may be smaller.
    elemental real(wp) function over_exact(error)
        real(wp), intent(in) :: error

        over_exact = error*(1.0_wp + error)
    end function over_exact
end module faststrip_normal_estimate_hertz_errors
