!> A posteriori error estimates of a strip solution: how well the contact condition holds where it
!> was not asked for, and what penetration, maximum pressure and area err by that.
!>
!> The solver closes the gap on the centre line and at the tip of each strip's middle. Here the
!> gap between the deformed surfaces is sampled in between,
!>
!>     r(x, y) = [h(y) + A(y) x^2 - D + H sum_s p0_s I_s(x, y)]/(D - h_lowest),
!>
!> zero under contact, positive where the surfaces part, negative where they overlap:
!>
!> - `e`: on the centre line at the edges of the strips, the patch's ends among them,
!> - `m`: at 1/sqrt(2) of the half-length (Chebyshev's point) in the middle of nine strips,
!> - outside: on the centre line beside the ends (by half), at the ends of the points, and wherever
!>   else a valley is below D (`faststrip_normal_overlap`).
!>
!> `e` falls with the number of strips; `m` does not, as all strips take their sections for
!> semi-ellipses. The first-order error of the penetration is a mean of r (reciprocity: weighted by
!> the pressure of a flat punch). With means over y, c what the penetration was corrected by, and n
!> strips across the patch with the maximum pressure
!>
!>     penetration   2.5 |0.28 mean m - 0.3 c| + 0.4 mean |m| + 0.24 rms e
!>     area          9.4 mean |m| + 1.85 rms e + 0.2/n^2
!>
!> The maximum pressure may be wrong in its strip, or another strip may carry more. Strip k has
!>
!>     d_k = 0.3 |e_k - mean e| (D - h_lowest)/(H l) + 1.7 u_k + 0.25 v_k
!>
!> more: e_k is the mean of e at its two edges, l what a wave as long as the strip is wide presses
!> in, 1/l = 1/(2w) + 1/[2 pi xd (1 + ln(1 + w/xd))] (strips much wider than long are needles), u_k
!> the pressure of heights that the strip does not resolve
!> (`faststrip_normal_estimate_unresolved`), v_k how far its pressure is from those of its
!> neighbours. Then
!>
!>     pmax = max(d_k/pmax of the strip with the maximum pressure and its neighbours,
!>                (p0_k + d_k)/pmax - 1 of all strips)
!>            + 0.38 mean |m| sum w (D - h_lowest)/(H sum w xd p0) + 0.2/n^2
!>     and at least 4.5 (q/pmax - 1), at most 1
!>
!> The ratio of sums is the load that sections which are no semi-ellipses have too much or too
!> little, over all load. q is the largest pressure that a longitudinal term A which varies along y
!> may mean (`faststrip_normal_estimate_pressure`). pmax and area are at least the overlap outside
!> where it is more than a hundredth: what presses there is not in the solution.
!>
!> The factors were fitted so that 97 % of the estimates are at least the error: against NORM on two
!> grids carried on, with 5, 9, 15 and 31 strips, on 800 contacts of S1002 on 60E1 and 54E1, Hertz
!> ellipses of a/b = 0.003 to 110, the 20 gaps of the reference and gaps of seeds 1 to 10 of
!> `faststrip-lab fuzz`; they hold of seeds 51 to 58 as well. They are of experience, no bounds in
!> the strict sense.
module faststrip_normal_estimate_errors
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size, smallest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_bad_material, st_not_finite, &
                                     st_no_contact, st_out_of_range, st_workspace_too_small
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_overlap, only: named_overlap, overlap_outside
    use faststrip_normal_estimate_pressure, only: unresolved_in, longitudinal_pressure
    use faststrip_normal_estimate_samples, only: block, most_samples, sample, part_end
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, ends_patch
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: normal_errors_t, estimate_strip_errors

    !> How well a solution fulfils the contact condition, and its estimated relative errors.
    type :: normal_errors_t
        real(wp) :: residual_inside = 0.0_wp !! largest |gap| inside the patches over D - h_lowest
        real(wp) :: overlap_outside = 0.0_wp !! largest overlap outside over D - h_lowest
        real(wp) :: est_err_penetration = 0.0_wp !! of D - h_lowest, relative, not negative
        real(wp) :: est_err_pmax = 0.0_wp    !! relative, not negative
        real(wp) :: est_err_area = 0.0_wp    !! relative, not negative
    end type normal_errors_t

    ! Tuned [1]: The penetration's factors, see the module's head. Origin: calibrated.
    real(wp), parameter :: bias_factor = 2.5_wp, bias_section = 0.28_wp, bias_corrected = 0.3_wp
    ! Tuned [1]: The same. Origin: calibrated.
    real(wp), parameter :: penetration_section = 0.4_wp, penetration_edge = 0.24_wp
    ! Tuned [1]: The area's factors. Origin: calibrated.
    real(wp), parameter :: area_section = 9.4_wp, area_edge = 1.85_wp
    ! Tuned [1]: The maximum pressure's factors. Origin: calibrated.
    real(wp), parameter :: edge_factor = 0.3_wp, wave_factor = 0.25_wp, load_factor = 0.38_wp
    ! Tuned [1]: The same, of unresolved heights and of A. Origin: calibrated; with 3 five strips of
    ! a test where A varies much are not bounded.
    real(wp), parameter :: unresolved_factor = 1.7_wp, longitudinal_factor = 4.5_wp
    ! Tuned [1]: The area's, of the strips at ends that are held. Origin: calibrated.
    real(wp), parameter :: end_share = 0.3_wp
    ! Tuned [1]: Least estimate of area and of maximum pressure, times n squared. Origin:
    ! calibrated.
    real(wp), parameter :: least_estimate = 0.2_wp
    ! Tuned [1]: Pressures of unresolved heights that count, over the largest. Origin: cost.
    real(wp), parameter :: least_unresolved = 0.002_wp

    ! Tuned [strips]: Strips in which sections are sampled. Origin: cost; of fifteen or all of
    ! thirty-one estimates are the same.
    integer, parameter :: most_sections = 9

    !> Sums over the strips, and the largest of what their residuals ask for.
    type :: sums_t
        integer :: peak = 0         ! the strip with the maximum pressure
        real(wp) :: widths = 0.0_wp ! of all strips, mm
        real(wp) :: edge = 0.0_wp   ! squares of e, times widths
        real(wp) :: section = 0.0_wp, section_size = 0.0_wp ! means of m and of |m|
        real(wp) :: ends = 0.0_wp   ! areas of strips at ends of patches, mm2
        real(wp) :: loads = 0.0_wp  ! width times length times pressure, N
        real(wp) :: peak_extra = 0.0_wp ! pressure that the peak and its neighbours ask for, MPa
        real(wp) :: largest_p0 = 0.0_wp ! with what its strip asks for, MPa
        real(wp) :: longitudinal = 0.0_wp ! that a varying A may mean, MPa
    end type sums_t

contains

    !> Certify a strip solution. Nothing is allocated or kept.
    !>
    !> The cost is one influence integral on the centre line for each pair of strips, and nine off
    !> it for each strip.
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

        type(sums_t) :: sums
        real(wp) :: depth
        integer :: i, blocks

        call check_solution(curve, compliance, strips, result, status)
        if (is_error(status)) return
        depth = (result%penetration - curve%h_lowest)/result%correction
        sums%peak = maxloc(strips%p0(:strips%n), dim=1)
        ! An odd number, so that none ends in the middle and a mirrored solution has the same.
        blocks = 1 + 2*((strips%n + block - 2)/(2*block - 2))
        do i = 1, blocks
            call add_edges(curve, compliance, strips, depth, &
                           1 + part_end(i - 1, blocks, strips%n), part_end(i, blocks, strips%n), &
                           sums, normal_errors%residual_inside)
        end do
        call add_sections(curve, compliance, strips, depth, sums, normal_errors%residual_inside)
        normal_errors%overlap_outside = overlap_outside(curve, compliance, depth, strips)
        call estimate(strips, result, depth/compliance, sums, normal_errors)
    end subroutine estimate_strip_errors

    !> Add what the edges of a block of strips tell.
    pure subroutine add_edges(curve, compliance, strips, depth, from, to, sums, residual)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: from, to ! the strips
        type(sums_t), intent(inout) :: sums
        real(wp), intent(inout) :: residual ! raised to the largest |gap|

        real(wp), dimension(block) :: width, edge ! mean gaps of both edges
        real(wp), dimension(most_samples) :: y, gap
        real(wp) :: extra, mean
        integer :: right(block), i, k, n, edges

        n = to - from + 1
        width(:n) = strips%y_right(from:to) - strips%y_left(from:to)
        edges = 0
        do k = from, to
            if (k == from .or. starts_patch(strips, k)) then
                edges = edges + 1
                y(edges) = strips%y_left(k)
            end if
            edges = edges + 1
            y(edges) = strips%y_right(k)
            right(k - from + 1) = edges
        end do
        call sample(curve, compliance, strips, depth, y(:edges), gap(:edges))
        residual = max(residual, maxval(abs(gap(:edges))))
        do i = 1, n
            edge(i) = 0.5_wp*(gap(right(i) - 1) + gap(right(i)))
        end do
        mean = sum(width(:n)*edge(:n))/sum(width(:n))
        sums%widths = sums%widths + sum(width(:n))
        do k = from, to
            i = k - from + 1
            sums%edge = sums%edge &
                        + width(i)*(0.5_wp*(abs(gap(right(i) - 1)) + abs(gap(right(i)))))**2
            if (starts_patch(strips, k) .or. ends_patch(strips, k)) &
                sums%ends = sums%ends + 2.0_wp*width(i)*strips%half_length(k)
            sums%loads = sums%loads + width(i)*strips%half_length(k)*max(strips%p0(k), 0.0_wp)
            extra = edge_factor*abs(edge(i) - mean)*(depth/compliance) &
                    /wave_length(width(i), strips%half_length(k)) &
                    + unresolved_factor*unresolved_in(curve, compliance, strips, k, &
                                                      least_unresolved*strips%p0(sums%peak)) &
                    + wave_factor*pressure_wave(strips, strips%p0(sums%peak), k)
            sums%largest_p0 = max(sums%largest_p0, strips%p0(k) + extra)
            if (abs(k - sums%peak) <= 1 .and. strips%patch(k) == strips%patch(sums%peak)) &
                sums%peak_extra = max(sums%peak_extra, extra)
        end do
        sums%longitudinal = max(sums%longitudinal, &
                              longitudinal_pressure(curve, compliance, strips, depth, from, to))
    end subroutine add_edges

    !> The gap that a pressure p in a strip of some width closes is H p times this, mm.
    pure real(wp) function wave_length(width, half_length) result(length)
        real(wp), intent(in) :: width, half_length

        length = 1.0_wp/(0.5_wp/width + 0.5_wp/(pi*half_length &
                                                 *(1.0_wp + log(1.0_wp + width/half_length))))
    end function wave_length

    !> How far the pressure of a strip is from a cubic through the squares of two on either side,
    !> MPa; beside an end of the patch nothing.
    pure real(wp) function pressure_wave(strips, peak, k) result(wave)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: peak ! pressure, MPa
        integer, intent(in) :: k

        real(wp) :: y(-2:2), factor
        integer :: i, j

        wave = 0.0_wp
        if (k < 3 .or. k + 2 > strips%n) return
        if (any(strips%patch([k - 2, k + 2]) /= strips%patch(k))) return
        y = 0.5_wp*(strips%y_left(k - 2:k + 2) + strips%y_right(k - 2:k + 2))
        do i = -2, 2
            if (i == 0) cycle
            factor = 1.0_wp
            do j = -2, 2
                if (j /= 0 .and. j /= i) factor = factor*((y(0) - y(j))/(y(i) - y(j)))
            end do
            wave = wave + factor*(strips%p0(k + i)*(strips%p0(k + i)/peak))
        end do
        wave = 0.5_wp*abs(strips%p0(k)*(strips%p0(k)/peak) - wave)
    end function pressure_wave

    !> Add what the sections of some strips tell.
    pure subroutine add_sections(curve, compliance, strips, depth, sums, residual)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        type(sums_t), intent(inout) :: sums
        real(wp), intent(inout) :: residual ! raised to the largest |gap|

        real(wp), dimension(most_sections) :: x, y, gap, width
        integer :: i, k, n

        ! In the middle of as many parts, counted from both ends; of an even number of strips an
        ! even one, as none is in the middle.
        n = min(most_sections, strips%n)
        n = n - modulo(strips%n - n, 2)
        do i = 1, n
            k = 1 + part_end(2*i - 1, 2*n, strips%n - 1)
            x(i) = sqrt(0.5_wp)*strips%half_length(k)
            y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            width(i) = strips%y_right(k) - strips%y_left(k)
        end do
        call sample(curve, compliance, strips, depth, y(:n), gap(:n), x(:n))
        residual = max(residual, maxval(abs(gap(:n))))
        sums%section = sum(width(:n)*gap(:n))/sum(width(:n))
        sums%section_size = sum(width(:n)*abs(gap(:n)))/sum(width(:n))
    end subroutine add_sections

    !> The estimated errors from the sums.
    pure subroutine estimate(strips, result, per_length, sums, normal_errors)
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result
        real(wp), intent(in) :: per_length ! depth over compliance, N/mm
        type(sums_t), intent(in) :: sums
        type(normal_errors_t), intent(inout) :: normal_errors

        real(wp) :: edge, least

        edge = sqrt(sums%edge/sums%widths)
        least = least_estimate &
                /count(strips%patch(:strips%n) == strips%patch(sums%peak))**2
        normal_errors%est_err_penetration = &
            bias_factor*abs(bias_section*sums%section &
                            - bias_corrected*(result%correction - 1.0_wp)) &
            + penetration_section*sums%section_size + penetration_edge*edge
        normal_errors%est_err_area = area_section*sums%section_size + area_edge*edge + least
        if (result%ends_are_held) normal_errors%est_err_area = normal_errors%est_err_area &
                                                               + end_share*sums%ends/result%area
        normal_errors%est_err_pmax = max(sums%peak_extra, &
                                         sums%largest_p0 - strips%p0(sums%peak))/result%pmax &
            + load_factor*sums%section_size*sums%widths*(per_length/sums%loads) + least
        normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, min(1.0_wp, &
            longitudinal_factor*max(sums%longitudinal/result%pmax - 1.0_wp, 0.0_wp)))
        if (normal_errors%overlap_outside > named_overlap) then
            normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, &
                                             normal_errors%overlap_outside)
            normal_errors%est_err_area = max(normal_errors%est_err_area, &
                                             normal_errors%overlap_outside)
        end if
    end subroutine estimate

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
