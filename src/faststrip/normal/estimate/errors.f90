!> A posteriori error estimates of a strip solution: how well the contact condition holds where it
!> was not asked for, and what penetration, maximum pressure and area err by that.
!>
!> The solver closes the gap on the centre line and at the tip of each strip's middle. Here the
!> gap between the deformed surfaces, from the exact influence integral, is sampled in between,
!>
!>     r(x, y) = [h(y) + A(y) x^2 - D + H sum_s p0_s I_s(x, y)]/(D - h_lowest),
!>
!> zero under contact, positive where the surfaces part, negative where they overlap:
!>
!> - `m`: at 1/sqrt(2) of the half-length (Chebyshev's point) in the middle of each strip,
!> - `e`: on the centre line at the edges of the strips, the patch's ends among them,
!> - `t`: at the tips at the edges, half-lengths carried on by a cubic through four squares xd^2,
!> - outside: ahead of some tips, beyond the ends, and wherever else the gap is below D.
!>
!> The first-order error of the penetration is a mean of r (reciprocity: weighted by the pressure
!> of a flat punch on the patch, for an ellipse evenly across strips). Its sign is of no use,
!> because the patch is in error too; its size is, so magnitudes are taken:
!>
!>     penetration   0.60 (rms e + 3 mean |m|)
!>     area          1.50 (rms t + 3.5 mean |m|) + 0.5 mean u_k/p0_k, each at most 1
!>
!> with means over y. Of n strips across the patch with the maximum pressure, fewer than eight raise
!> the area's estimate by 8/n, because a cubic through few lengths tells less of the tips. These
!> factors were calibrated so that 95 % of the Hertz ellipses of a/b = 0.004 to 100 and of every
!> second of the 20 gaps of the reference are bounded, with 5 to 41 strips, and then raised by
!> about 1.3.
!>
!> The maximum pressure may be wrong in its strip, or another strip may carry more. Each strip k of
!> a patch of n strips has a pressure of its own that its residuals ask for. A wave of amplitude d
!> and wave number c is closed by the pressure c d/(pi H) on a half-space, so that
!>
!>     d_k = 0.30 |e_k| D/(H l)                       e_k: mean of e at its two edges
!>         + 0.35 C(s_k) D/(H l)                      s_k: half the difference of e at them
!>         + 0.45 |m_k| D/(H xd)                      the section is no semi-ellipse
!>         + 0.50 C(m_k) D/(2 H w)                    and changes from strip to strip
!>         + 0.012 |p0_k-2 - 4 p0_k-1 + 6 p0_k - 4 p0_k+1 + p0_k+2|
!>         + 1.10 u_k                                 of heights that the strip does not resolve:
!>                                                    `faststrip_normal_estimate_unresolved`
!>         + p0_k (sqrt(A/line) - 1)/(1 + xd/w)       A between the middles of the strips:
!>                                                    `faststrip_normal_estimate_longitudinal`
!>
!>     pmax = max( max d_k/pmax of the strip with the maximum pressure and its neighbours,
!>                 max (p0_k + d_k)/pmax - max p0_k/pmax of all strips,
!>                 0.40/n^2 )
!>            + 1/3 sum w xd 0.45 |m_k| D/(H xd) / sum w xd p0_k
!>     and at least 1 - pmax/max q_k
!>     and, as the area, at least the overlap outside where it is more than a hundredth: what
!>     presses there is not in the solution
!>
!> with 1/l = 1/(2w) + 1/[2 pi xd (1 + ln(1 + w/xd))]: strips shorter than wide are needles, which
!> press in what is about as long as they are, not as wide, and take more pressure to close a gap.
!> The sum is the load that sections which are no semi-ellipses have too much or too little:
!> others take it, and their pressures go with its cube root, wherever they are. q_k is the maximum
!> pressure of a strip off the centre line (`faststrip_normal_estimate_longitudinal`).
!>
!> C(a_k) = |a_k - (a_k-1 + a_k+1)/2|. The fourth difference is what steps instead of a wave
!> of two to four strips are wrong by: steps that alternate by +-p stand for a wave of 1.17 p.
!> Where A = 1/(2R) jumps or bends between strips the pressure u of a strip grows with x^2, to u'
!> at its tip, and with its own, p0 sqrt(1 - (x/xd)^2), has a largest value of p0 + u' (1 - p0/(2
!> u'))^2 where u' is above p0/2. The last line is the discretisation error of ellipses, whose
!> pressures are so smooth along y that all terms miss it.
!>
!> The factors of e_k, m_k and u_k were chosen on 800 random contacts of 16 families, solved by NORM
!> on two grids, with 5 to 41 strips. Those of s_k and of the fourth difference would be 1 and 0.010
!> for waves of two strips on a half-space; that of s_k was lowered with an eye on families of
!> `faststrip-lab fuzz`, as smooth contacts have such differences too: at 0.5 the estimates are a
!> tenth larger in the median. That of C(m_k), 0.7 before, makes up in the median for the terms of
!> A, of needles and of load, which were settled with seeds 12, 13 and 21.
!> `faststrip-lab bench estimates` judges them with another.
!> All factors are of experience, no bounds in the strict sense.
module faststrip_normal_estimate_errors
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size, smallest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_bad_material, st_not_finite, &
                                     st_no_contact, st_out_of_range, st_workspace_too_small
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_cells_overlap, only: named_overlap
    use faststrip_normal_estimate_outside, only: look_ahead, look_beyond, look_elsewhere
    use faststrip_normal_estimate_pressure, only: missing_pressure, section_load, &
                                                              inv2r_about, find_unresolved, &
                                                              unresolved_factor
    use faststrip_normal_estimate_samples, only: samples_t, take_samples, block
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, first_of_patch, last_of_patch
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_estimate_longitudinal, only: inv2r_range, local_rise, off_centre_pressure
    implicit none
    private

    public :: normal_errors_t, estimate_strip_errors, richardson_estimate

    !> How well a solution fulfils the contact condition, and its estimated relative errors.
    type :: normal_errors_t
        real(wp) :: residual_inside = 0.0_wp !! largest |gap| inside the patches over D - h_lowest
        real(wp) :: overlap_outside = 0.0_wp !! largest overlap outside over D - h_lowest
        real(wp) :: est_err_penetration = 0.0_wp !! of D - h_lowest, relative, not negative
        real(wp) :: est_err_pmax = 0.0_wp    !! relative, not negative
        real(wp) :: est_err_area = 0.0_wp    !! relative, not negative
    end type normal_errors_t

    ! Tuned [1]: Factors of the estimates, see the module's head. Origin: calibrated, see the
    ! module's head.
    ! Tuned [1]: The penetration's factors, see the module's head. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: penetration_factor = 0.6_wp, penetration_middle = 3.0_wp
    ! Tuned [1]: The area's factors. Origin: calibrated, see the module's head.
    real(wp), parameter :: area_factor = 1.5_wp, area_middle = 3.5_wp
    ! Tuned [1]: The area's, with few strips and of unresolved heights. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: area_strips = 8.0_wp, area_unresolved = 0.5_wp
    ! Tuned [1]: The maximum pressure's least estimate, times n squared. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: pmax_least = 0.4_wp

    ! The maximum pressure goes with the cube root of the load of its surroundings.
    ! Tuned [power]: The power. Origin: a point contact of Hertz.
    real(wp), parameter :: per_load = 1.0_wp/3.0_wp

    ! Two-grid estimate: the order of the strips, and Roache's factor of safety for two grids.
    ! Tuned [1]. Origin: the order of a smooth solution; Roache's factor.
    real(wp), parameter :: order = 2.0_wp, two_grid_safety = 3.0_wp

    !> Sums over the strips, and the largest of what their residuals ask for.
    type :: sums_t
        integer :: peak = 0            ! the strip with the maximum pressure
        real(wp) :: variation = 0.0_wp ! of A in all strips
        real(wp) :: widths = 0.0_wp, areas = 0.0_wp, loads = 0.0_wp
        real(wp) :: edge = 0.0_wp, tip = 0.0_wp      ! squares, times widths
        real(wp) :: middle = 0.0_wp                  ! sizes, times widths
        real(wp) :: section = 0.0_wp, unresolved = 0.0_wp ! of load, of area
        real(wp) :: peak_extra = 0.0_wp ! pressure that the peak and its neighbours ask for, MPa
        real(wp) :: largest_p0 = 0.0_wp ! with what its strip asks for, MPa
        real(wp) :: off_centre = 0.0_wp ! maximum pressure off the centre line, MPa
    end type sums_t

contains

    !> Certify a strip solution. Nothing is allocated or kept.
    !>
    !> The cost is two influence integrals off the centre line and one on it for each
    !> pair of strips: about that of one Newton iteration.
    !>
    !> Errors: `st_workspace_too_small` (no gap, no capacity for strips), `st_bad_argument` (no
    !> strips, strips without length or out of order, no pressure), `st_bad_material`,
    !> `st_not_finite`, `st_no_contact` (penetration not above the lowest gap),
    !> `st_out_of_range` (a size beyond 1e-30 to 1e30).
    pure subroutine estimate_strip_errors(curve, compliance, strips, result, normal_errors, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        type(normal_result_t), intent(in) :: result  !! penetration, correction and pmax count
        type(normal_errors_t), intent(out) :: normal_errors !! zeros after an error
        type(status_t), intent(out) :: status        !! how it ended

        type(samples_t) :: samples
        type(sums_t) :: sums
        real(wp) :: depth
        integer :: k, from, to

        call check_solution(curve, compliance, strips, result, status)
        if (is_error(status)) return
        depth = (result%penetration - curve%h_lowest)/result%correction
        sums%peak = maxloc(strips%p0(:strips%n), dim=1)
        sums%variation = inv2r_range(curve, strips%y_left(1), strips%y_right(strips%n))
        do from = 1, strips%n, block
            to = min(from + block - 1, strips%n)
            call take_samples(curve, compliance, strips, depth, from, samples, &
                              normal_errors%residual_inside)
            call look_ahead(curve, compliance, strips, depth, from, to, &
                            normal_errors%overlap_outside)
            do k = from, to
                if (starts_patch(strips, k)) &
                    call look_beyond(curve, compliance, strips, depth, k, &
                                     normal_errors%overlap_outside)
            end do
            do k = from, to
                call add_residuals(strips, k, k - from + 1, samples, sums)
                call add_pressures(curve, compliance, strips, depth, k, k - from + 1, samples, sums)
            end do
        end do
        call look_elsewhere(curve, compliance, strips, depth, normal_errors%overlap_outside)
        call estimate(strips, result, sums, normal_errors)
    end subroutine estimate_strip_errors

    !> Add the residuals of strip k, whose samples are number i.
    pure subroutine add_residuals(strips, k, i, samples, sums)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k, i
        type(samples_t), intent(in) :: samples
        type(sums_t), intent(inout) :: sums

        real(wp) :: width

        width = strips%y_right(k) - strips%y_left(k)
        sums%widths = sums%widths + width
        sums%edge = sums%edge &
                    + width*(0.5_wp*(abs(samples%left(i)) + abs(samples%right(i))))**2
        sums%tip = sums%tip + width*samples%tips(i)**2
        sums%middle = sums%middle + width*abs(samples%middle(i))
    end subroutine add_residuals

    !> Add the pressures that strip k asks for, whose samples are number i.
    pure subroutine add_pressures(curve, compliance, strips, depth, k, i, samples, sums)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k, i
        type(samples_t), intent(in) :: samples
        type(sums_t), intent(inout) :: sums

        real(wp) :: width, area, extra, unresolved, at_tip, rise, variation, off_centre

        width = strips%y_right(k) - strips%y_left(k)
        area = width*strips%half_length(k)
        call find_unresolved(curve, compliance, strips, k, unresolved, at_tip)
        sums%unresolved = sums%unresolved &
                          + area*min(1.0_wp, unresolved/max(strips%p0(k), smallest_size))
        sums%areas = sums%areas + area
        call local_rise(curve, strips%y_left(k), strips%y_right(k), strips%half_length(k), &
                        inv2r_about(strips, k, i, samples), rise, variation)
        extra = missing_pressure(compliance, strips, depth, k, i, samples, unresolved) &
                + max(strips%p0(k), 0.0_wp)*rise
        off_centre = off_centre_pressure( &
                     curve, compliance, depth, strips%y_left(k), strips%y_right(k), &
                     strips%y_left(first_of_patch(strips, k)), &
                     strips%y_right(last_of_patch(strips, k)), strips%half_length(k), &
                     strips%p0(k), variation, sums%variation)
        sums%off_centre = max(sums%off_centre, strips%p0(k) + unresolved_factor*at_tip, off_centre)
        sums%section = sums%section &
                       + width*abs(samples%middle(i))*section_load(compliance, depth)
        sums%loads = sums%loads + area*max(strips%p0(k), 0.0_wp)
        sums%largest_p0 = max(sums%largest_p0, strips%p0(k) + extra)
        if (abs(k - sums%peak) <= 1 .and. strips%patch(k) == strips%patch(sums%peak)) &
            sums%peak_extra = max(sums%peak_extra, extra)
    end subroutine add_pressures

    !> The estimated errors from the sums.
    pure subroutine estimate(strips, result, sums, normal_errors)
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result
        type(sums_t), intent(in) :: sums
        type(normal_errors_t), intent(inout) :: normal_errors

        integer :: across

        normal_errors%est_err_penetration = penetration_factor &
            *(sqrt(sums%edge/sums%widths) + penetration_middle*sums%middle/sums%widths)
        across = count(strips%patch(:strips%n) == strips%patch(sums%peak))
        normal_errors%est_err_area = &
            area_factor*max(1.0_wp, area_strips/across) &
            *(sqrt(sums%tip/sums%widths) + area_middle*sums%middle/sums%widths) &
            + area_unresolved*sums%unresolved/sums%areas
        normal_errors%est_err_pmax = max(sums%peak_extra/result%pmax, &
                                       (sums%largest_p0 - strips%p0(sums%peak))/result%pmax, &
                                       pmax_least/across**2) + per_load*(sums%section/sums%loads)
        normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, &
                                       1.0_wp - result%pmax/max(sums%off_centre, result%pmax))
        if (normal_errors%overlap_outside > named_overlap) then
            normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, &
                                             normal_errors%overlap_outside)
            normal_errors%est_err_area = max(normal_errors%est_err_area, &
                                             normal_errors%overlap_outside)
        end if
    end subroutine estimate

    !> Errors of a fine solution from it and a coarser one of the same contact, as Richardson: the
    !> difference over `ratio^2 - 1`, second order in the number of strips, times 3, Roache's
    !> factor of safety for two grids. The residuals are left as they are.
    !>
    !> Errors: `st_bad_argument`: a ratio not above 1, or a result without pressure or area.
    pure subroutine richardson_estimate(coarse, fine, ratio, h_lowest, normal_errors, status)
        type(normal_result_t), intent(in) :: coarse !! with fewer strips
        type(normal_result_t), intent(in) :: fine   !! with more strips, the errors are its
        real(wp), intent(in) :: ratio               !! of their numbers of strips, 2 for N/2 and N
        real(wp), intent(in) :: h_lowest            !! lowest height of the gap, mm
        type(normal_errors_t), intent(inout) :: normal_errors !! its estimates are replaced
        type(status_t), intent(out) :: status       !! `st_bad_argument`, `st_not_finite`

        real(wp) :: factor

        call clear_status(status)
        if (.not. all(ieee_is_finite([ratio, h_lowest, coarse%penetration, coarse%pmax, &
                                      coarse%area, fine%penetration, fine%pmax, fine%area]))) then
            call set_status(status, st_not_finite, 'a figure of the solutions is not finite')
            return
        end if
        if (ratio <= 1.0_wp .or. ratio > largest_size) then
            call set_status(status, st_bad_argument, 'the ratio of the numbers of strips must ' &
                            //'be above 1, got '//number_text(ratio))
        else if (min(fine%pmax, fine%area, fine%penetration - h_lowest) < smallest_size &
                 .or. max(coarse%pmax, coarse%area, abs(coarse%penetration)) > largest_size &
                 .or. max(fine%pmax, fine%area, abs(fine%penetration)) > largest_size) then
            call set_status(status, st_bad_argument, 'a result without penetration, pressure or ' &
                            //'area')
        else
            factor = two_grid_safety/(ratio**order - 1.0_wp)
            normal_errors%est_err_penetration = factor*abs(coarse%penetration - fine%penetration) &
                                              /(fine%penetration - h_lowest)
            normal_errors%est_err_pmax = factor*abs(coarse%pmax - fine%pmax)/fine%pmax
            normal_errors%est_err_area = factor*abs(coarse%area - fine%area)/fine%area
        end if
    end subroutine richardson_estimate

    !> Whether there is a solution to estimate the errors of.
    pure subroutine check_solution(curve, compliance, strips, result, status)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result
        type(status_t), intent(out) :: status

        real(wp) :: low, high
        integer :: k

        call clear_status(status)
        if (.not. all(ieee_is_finite([compliance, result%penetration, result%pmax]))) then
            call set_status(status, st_not_finite, &
                            'compliance, penetration or pmax is not a finite number')
        else if (compliance <= 0.0_wp) then
            call set_status(status, st_bad_material, &
                            'the compliance must be above 0, got '//number_text(compliance))
        else if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the strips')
        else if (strips%n < 1) then
            call set_status(status, st_bad_argument, 'there must be strips to estimate the ' &
                            // 'errors of, got none')
        else if (result%penetration <= curve%h_lowest) then
            call set_status(status, st_no_contact, 'the penetration is not above the lowest gap: ' &
                            //trim(number_text(result%penetration))//' mm')
        end if
        if (is_error(status)) return
        low = min(compliance, result%penetration - curve%h_lowest, result%pmax)
        high = max(compliance, result%penetration - curve%h_lowest, result%pmax)
        do k = 1, strips%n
            if (.not. all(ieee_is_finite([strips%y_left(k), strips%y_right(k), &
                                          strips%half_length(k), strips%p0(k)]))) then
                call set_status(status, st_not_finite, 'a strip has figures that are not finite')
                return
            else if (strips%y_right(k) <= strips%y_left(k) &
                     .or. strips%half_length(k) <= 0.0_wp) then
                call set_status(status, st_bad_argument, 'a strip has no width or no length')
                return
            end if
            high = max(high, abs(strips%y_left(k)), abs(strips%y_right(k)), &
                       strips%half_length(k), abs(strips%p0(k)))
            low = min(low, strips%half_length(k), strips%y_right(k) - strips%y_left(k))
            if (k == 1) cycle
            if (strips%y_left(k) < strips%y_left(k - 1) + 0.5_wp &
                *(strips%y_right(k - 1) - strips%y_left(k - 1))) then
                call set_status(status, st_bad_argument, 'the strips are not in the order of y')
                return
            end if
        end do
        if (low < smallest_size .or. high > largest_size) then
            call set_status(status, st_out_of_range, &
                            'a size of the solution is beyond 1e-30 to 1e30')
        else if (maxval(strips%p0(:strips%n)) < smallest_size) then
            call set_status(status, st_bad_argument, 'no strip carries pressure')
        end if
    end subroutine check_solution
end module faststrip_normal_estimate_errors
