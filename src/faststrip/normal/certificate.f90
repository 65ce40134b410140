!> An a posteriori certificate of a strip solution: how well the contact condition holds where it
!> was not asked for, and how wrong penetration, largest pressure and area are by that.
!>
!> The solver closes the gap on the centre line and at the tip of each strip's middle. Here the
!> gap between the deformed surfaces, from the exact influence integral, is sampled in between,
!>
!>     r(x, y) = [h(y) + A(y) x^2 - D + H sum_s p0_s I_s(x, y)]/(D - h_lowest),
!>
!> zero under contact, positive where the surfaces part, negative where they overlap:
!>
!> - `m`: at 1/sqrt(2) of the half-length (Chebyshev's point) in the middle of every second
!>   strip,
!> - `e`: on the centre line at the edges of the strips, the patch's ends among them,
!> - `t`: at the tips at the edges, half-lengths carried on by a cubic through four squares xd^2,
!> - outside: ahead of some tips, beyond the ends, and wherever else the gap is below D.
!>
!> The first-order error of the penetration is a mean of r (reciprocity: weighted by the pressure
!> of a flat punch on the patch, for an ellipse evenly across strips). Its sign is of no use,
!> because the patch is in error too; its size is, so magnitudes are taken:
!>
!>     penetration   0.60 (rms e + 3 mean |m|)
!>     area          1.30 (rms t + 2.5 mean |m|)
!>     pmax          0.62 (max |e_left + e_right|/2 D/(2 H w pmax) + 0.75 max |q_k/q* - 1|/2)
!>
!> with means over y. Of n strips across the patch with the largest pressure, fewer than eight raise
!> the area's estimate by 8/n, because a cubic through few lengths tells less of the tips; and
!> pmax is not trusted beyond 0.15/n^2, the discretisation error of slim ellipses, whose pressures
!> are so smooth along y that both terms miss it. The first term of pmax is the
!> pressure that closes a wave of the amplitude e over the strip's width w on a half-space, over the
!> strip with the largest pressure and its
!> neighbours; the second is how far q = p0^2 of these is from the polynomial through the two
!> strips on each side, over the largest q*. The factors in front were calibrated so that 95 %
!> of the Hertz ellipses of a/b = 0.004 to 100 and of every second of the 20 gaps of the
!> reference are bounded, with 5 to 41 strips, and then raised by about 1.3. They are factors of
!> experience, no bounds in the strict sense. Which samples serve for what was chosen on these
!> and on random gaps, of another seed than those the study of the program draws.
module faststrip_normal_certificate
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                st_bad_argument, st_bad_material, st_not_finite, &
                                st_no_contact, st_out_of_range, st_workspace_too_small
    use faststrip_influence_row, only: center_influence_column, influence_column_gradient
    use faststrip_profile_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_strip_state, only: flattest
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: certificate_t, certify_strips, richardson_estimate

    !> How well a solution fulfils the contact condition, and its estimated relative errors.
    type :: certificate_t
        real(wp) :: residual_inside = 0.0_wp !! largest |gap| inside the patches over D - h_lowest
        real(wp) :: overlap_outside = 0.0_wp !! largest overlap outside over D - h_lowest
        real(wp) :: est_err_penetration = 0.0_wp !! of D - h_lowest, relative, not negative
        real(wp) :: est_err_pmax = 0.0_wp    !! relative, not negative
        real(wp) :: est_err_area = 0.0_wp    !! relative, not negative
    end type certificate_t

    real(wp), parameter :: penetration_factor = 0.6_wp, penetration_middle = 3.0_wp
    real(wp), parameter :: area_factor = 1.3_wp, area_middle = 2.5_wp
    real(wp), parameter :: pmax_factor = 0.62_wp, pmax_curve = 0.75_wp
    real(wp), parameter :: area_strips = 8.0_wp, pmax_least = 0.15_wp

    integer, parameter :: middle_stride = 2  ! strips from one middle sampled to the next
    integer, parameter :: tips_ahead = 4     ! of a block of strips, sampled outside
    real(wp), parameter :: ahead = 1.05_wp   ! of the half-length, outside
    real(wp), parameter :: beyond(2) = [0.25_wp, 1.0_wp] ! widths of the end strip, outside
    integer, parameter :: scan_points = 8    ! in a stretch below D outside the patches
    integer, parameter :: max_intervals = 64
    integer, parameter :: block = 32         ! strips sampled together

    ! Sizes that cannot overflow.
    real(wp), parameter :: smallest = 1.0e-30_wp, largest = 1.0e30_wp

    ! Two-grid estimate: the order of the strips, and Roache's factor of safety for two grids.
    real(wp), parameter :: order = 2.0_wp, two_grid_safety = 3.0_wp

contains

    !> Certify a strip solution. Nothing is allocated or kept.
    !>
    !> The cost is one and a half influence integrals off the centre line and one on it for each
    !> pair of strips: about that of one Newton iteration.
    !>
    !> Errors: `st_workspace_too_small` (no gap, no room for strips), `st_bad_argument` (no
    !> strips, strips without length or out of order, no pressure), `st_bad_material`,
    !> `st_not_finite`, `st_no_contact` (penetration not above the lowest gap),
    !> `st_out_of_range` (a size beyond 1e-30 to 1e30).
    pure subroutine certify_strips(curve, compliance, strips, result, certificate, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        type(normal_result_t), intent(in) :: result  !! its penetration and pmax are used
        type(certificate_t), intent(out) :: certificate !! zeros after an error
        type(status_t), intent(out) :: status        !! how it ended

        real(wp), dimension(block) :: x, y, x_edge, y_edge, middle, edge, tip
        real(wp) :: depth, width, left_edge, left_tip, wave
        real(wp) :: widths, sum_edge, sum_tip, middle_widths, sum_middle
        real(wp) :: across ! strips of the patch with the largest pressure
        integer :: k, j, m, n_middle, from, first, last, peak

        call check_solution(curve, compliance, strips, result, status)
        if (is_error(status)) return
        depth = result%penetration - curve%h_lowest
        peak = maxloc(strips%p0(:strips%n), dim=1)
        widths = 0.0_wp
        sum_middle = 0.0_wp
        middle_widths = 0.0_wp
        sum_edge = 0.0_wp
        sum_tip = 0.0_wp
        wave = 0.0_wp
        left_edge = 0.0_wp
        left_tip = 0.0_wp
        first = 1
        last = 0
        do from = 1, strips%n, block
            m = min(block, strips%n - from + 1)
            n_middle = 0
            do j = 1, m
                k = from + j - 1
                if (k > last) then
                    first = k
                    last = last_of_patch(strips, first)
                end if
                if (modulo(k - first, middle_stride) == 0) then
                    n_middle = n_middle + 1
                    x(n_middle) = sqrt(0.5_wp)*strips%half_length(k)
                    y(n_middle) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
                    middle(n_middle) = strips%y_right(k) - strips%y_left(k)
                    middle_widths = middle_widths + middle(n_middle)
                end if
                y_edge(j) = strips%y_right(k)
                x_edge(j) = 0.0_wp
                if (k < last) x_edge(j) = tip_between(strips, first, last, k)
            end do
            call add_middles(curve, compliance, strips, depth, x(:n_middle), y(:n_middle), &
                             middle(:n_middle), sum_middle, certificate%residual_inside)
            call look_ahead(curve, compliance, strips, depth, from, from + m - 1, &
                            certificate%overlap_outside)
            call sample(curve, compliance, strips, depth, x_edge(:m), y_edge(:m), tip(:m))
            call sample_centre_line(curve, compliance, strips, depth, y_edge(:m), edge(:m))
            certificate%residual_inside = max(certificate%residual_inside, &
                                              maxval(abs(edge(:m))), maxval(abs(tip(:m))))
            do j = 1, m
                k = from + j - 1
                if (starts_patch(strips, k)) then
                    call look_beyond(curve, compliance, strips, depth, k, left_edge, &
                                     certificate%overlap_outside)
                    left_tip = left_edge
                    certificate%residual_inside = max(certificate%residual_inside, abs(left_edge))
                end if
                width = strips%y_right(k) - strips%y_left(k)
                widths = widths + width
                sum_edge = sum_edge + width*(0.5_wp*(abs(left_edge) + abs(edge(j))))**2
                sum_tip = sum_tip + width*(0.5_wp*(abs(left_tip) + abs(tip(j))))**2
                if (abs(k - peak) <= 1) &
                    wave = max(wave, 0.5_wp*abs(left_edge + edge(j)) &
                               *(depth/(2.0_wp*compliance*width))/result%pmax)
                left_edge = edge(j)
                left_tip = tip(j)
            end do
        end do
        call look_elsewhere(curve, compliance, strips, depth, certificate%overlap_outside)
        certificate%est_err_penetration = &
            penetration_factor*(sqrt(sum_edge/widths) &
                                + penetration_middle*sum_middle/middle_widths)
        across = count(strips%patch(:strips%n) == strips%patch(peak))
        certificate%est_err_area = &
            area_factor*max(1.0_wp, area_strips/across) &
            *(sqrt(sum_tip/widths) + area_middle*sum_middle/middle_widths)
        certificate%est_err_pmax = max( &
            pmax_factor*(wave + pmax_curve*peak_roughness(strips, peak)), pmax_least/across**2)
    end subroutine certify_strips

    !> Errors of a fine solution from it and a coarser one of the same contact, as Richardson: the
    !> difference over `ratio^2 - 1`, second order in the number of strips, times 3, Roache's
    !> factor of safety for two grids. The residuals of the certificate are left as they are.
    !>
    !> Errors: `st_bad_argument`: a ratio not above 1, or a result without pressure or area.
    pure subroutine richardson_estimate(coarse, fine, ratio, h_lowest, certificate, status)
        type(normal_result_t), intent(in) :: coarse !! with fewer strips
        type(normal_result_t), intent(in) :: fine   !! with more strips, the errors are its
        real(wp), intent(in) :: ratio               !! of their numbers of strips, 2 for N/2 and N
        real(wp), intent(in) :: h_lowest            !! lowest height of the gap, mm
        type(certificate_t), intent(inout) :: certificate !! its estimates are replaced
        type(status_t), intent(out) :: status       !! `st_bad_argument`, `st_not_finite`

        real(wp) :: factor

        call clear_status(status)
        if (.not. all(ieee_is_finite([ratio, h_lowest, coarse%penetration, coarse%pmax, &
                                      coarse%area, fine%penetration, fine%pmax, fine%area]))) then
            call set_status(status, st_not_finite, 'a figure of the solutions is not finite')
            return
        end if
        if (ratio <= 1.0_wp .or. ratio > largest) then
            call set_status(status, st_bad_argument, 'the ratio of the numbers of strips is not ' &
                            //'above 1: '//number_text(ratio))
        else if (min(fine%pmax, fine%area, fine%penetration - h_lowest) < smallest &
                 .or. max(coarse%pmax, coarse%area, abs(coarse%penetration)) > largest &
                 .or. max(fine%pmax, fine%area, abs(fine%penetration)) > largest) then
            call set_status(status, st_bad_argument, 'a result without penetration, pressure or ' &
                            //'area')
        else
            factor = two_grid_safety/(ratio**order - 1.0_wp)
            certificate%est_err_penetration = factor*abs(coarse%penetration - fine%penetration) &
                                              /(fine%penetration - h_lowest)
            certificate%est_err_pmax = factor*abs(coarse%pmax - fine%pmax)/fine%pmax
            certificate%est_err_area = factor*abs(coarse%area - fine%area)/fine%area
        end if
    end subroutine richardson_estimate

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
                            'the compliance is not positive: '//number_text(compliance))
        else if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no room was reserved for the strips')
        else if (strips%n < 1) then
            call set_status(status, st_bad_argument, 'there are no strips to certify')
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
        if (low < smallest .or. high > largest) then
            call set_status(status, st_out_of_range, &
                            'a size of the solution is beyond 1e-30 to 1e30')
        else if (maxval(strips%p0(:strips%n)) < smallest) then
            call set_status(status, st_bad_argument, 'no strip carries pressure')
        end if
    end subroutine check_solution

    !> The gap between the deformed surfaces over the penetration, at any points.
    pure subroutine sample(curve, compliance, strips, depth, x, y, gap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, x(:), y(:)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(out) :: gap(:)

        real(wp), dimension(block) :: influence, d_x, d_half_length
        real(wp) :: h, inv2r
        integer :: s, i, m

        m = size(y)
        do i = 1, m
            call gap_at(curve, y(i), h, inv2r)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp &
                     + min(max(inv2r, flattest), largest)*(x(i)*(x(i)/depth))
        end do
        do s = 1, strips%n
            ! Its derivatives are of no use here, but it is the fast one.
            call influence_column_gradient(strips%half_length(s), strips%y_left(s), &
                                           strips%y_right(s), x, y, influence(:m), d_x(:m), &
                                           d_half_length(:m))
            gap = gap + compliance*strips%p0(s)/depth*influence(:m)
        end do
    end subroutine sample

    !> The same on the centre line.
    pure subroutine sample_centre_line(curve, compliance, strips, depth, y, gap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, y(:)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(out) :: gap(:)

        real(wp) :: influence(block), h, inv2r
        integer :: s, i

        do i = 1, size(y)
            call gap_at(curve, y(i), h, inv2r)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp
        end do
        do s = 1, strips%n
            call center_influence_column(strips%half_length(s), strips%y_left(s), &
                                         strips%y_right(s), y, influence(:size(y)))
            gap = gap + compliance*strips%p0(s)/depth*influence(:size(y))
        end do
    end subroutine sample_centre_line

    !> Add the gaps at points in the middle of strips to a sum weighted by the strips' widths.
    pure subroutine add_middles(curve, compliance, strips, depth, x, y, width, total, inside)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, x(:), y(:), width(:)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(inout) :: total, inside

        real(wp) :: gap(block)
        integer :: i

        call sample(curve, compliance, strips, depth, x, y, gap(:size(x)))
        do i = 1, size(x)
            total = total + width(i)*abs(gap(i))
            inside = max(inside, abs(gap(i)))
        end do
    end subroutine add_middles

    !> The overlap ahead of some of the tips of strips `from` to `to`.
    pure subroutine look_ahead(curve, compliance, strips, depth, from, to, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: from, to
        real(wp), intent(inout) :: overlap

        real(wp), dimension(tips_ahead) :: x, y, gap
        integer :: i, k

        do i = 1, tips_ahead
            k = from + ((to - from)*(2*i - 1))/(2*tips_ahead)
            x(i) = ahead*strips%half_length(k)
            y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        end do
        call sample(curve, compliance, strips, depth, x, y, gap)
        overlap = max(overlap, -minval(gap))
    end subroutine look_ahead

    !> The gap at the left end of the patch that starts with strip `first`, and the overlap beyond
    !> both its ends.
    pure subroutine look_beyond(curve, compliance, strips, depth, first, left_end, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first
        real(wp), intent(out) :: left_end
        real(wp), intent(inout) :: overlap

        real(wp) :: y(5), gap(5)
        integer :: i, last

        last = last_of_patch(strips, first)
        y(1) = strips%y_left(first)
        y(2:3) = y(1) - beyond*(strips%y_right(first) - y(1))
        y(4:5) = strips%y_right(last) + beyond*(strips%y_right(last) - strips%y_left(last))
        call sample_centre_line(curve, compliance, strips, depth, y, gap)
        left_end = gap(1)
        do i = 2, 5
            if (is_outside(curve, strips, y(i))) overlap = max(overlap, -gap(i))
        end do
    end subroutine look_beyond

    !> The overlap wherever the undeformed gap is below the penetration and there is no patch.
    pure subroutine look_elsewhere(curve, compliance, strips, depth, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(inout) :: overlap

        real(wp) :: y_from(max_intervals), y_to(max_intervals), low
        integer :: i, n, first, last

        call level_intervals(curve, curve%h_lowest + depth, y_from, y_to, n)
        do i = 1, n
            low = y_from(i)
            first = 1
            do while (first <= strips%n)
                last = last_of_patch(strips, first)
                if (strips%y_right(last) > low .and. strips%y_left(first) < y_to(i)) then
                    call scan(curve, compliance, strips, depth, low, strips%y_left(first), overlap)
                    low = max(low, strips%y_right(last))
                end if
                first = last + 1
            end do
            call scan(curve, compliance, strips, depth, low, y_to(i), overlap)
        end do
    end subroutine look_elsewhere

    !> The overlap in one stretch of the centre line.
    pure subroutine scan(curve, compliance, strips, depth, from, to, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, from, to
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(inout) :: overlap

        real(wp) :: gap(scan_points), y(scan_points)
        integer :: j

        if (to <= from) return
        y = [(from + (to - from)*(j - 0.5_wp)/scan_points, j=1, scan_points)]
        call sample_centre_line(curve, compliance, strips, depth, y, gap)
        overlap = max(overlap, -minval(gap))
    end subroutine scan

    !> Is a place among the gap's points and in no patch?
    pure logical function is_outside(curve, strips, y)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: y

        is_outside = y >= curve%y(1) .and. y <= curve%y(curve%n) &
                     .and. .not. any(strips%y_left(:strips%n) <= y &
                                     .and. strips%y_right(:strips%n) >= y)
    end function is_outside

    pure logical function starts_patch(strips, k)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        starts_patch = k == 1
        if (k > 1) starts_patch = strips%patch(k) /= strips%patch(k - 1)
    end function starts_patch

    !> The last strip of the patch that starts with strip `first`.
    pure integer function last_of_patch(strips, first) result(last)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first

        do last = first, strips%n - 1
            if (starts_patch(strips, last + 1)) return
        end do
        last = strips%n
    end function last_of_patch

    !> Half-length of the patch at the edge between strips k and k + 1.
    pure real(wp) function tip_between(strips, first, last, k) result(x)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last, k

        real(wp) :: low, high, square
        integer :: from

        from = min(max(k - 1, first - 1), last - 2)
        square = square_at(strips, strips%half_length, first, last, from, from + 3, first - 2, &
                           strips%y_right(k))
        ! A cubic through lengths that jump may leave them far behind.
        low = min(strips%half_length(k), strips%half_length(k + 1))
        high = max(strips%half_length(k), strips%half_length(k + 1))
        x = sqrt(min(max(square, 0.5_wp*low**2), 2.0_wp*high**2))
    end function tip_between

    !> How far the pressures about the largest are from the curve through their neighbours: half
    !> the deviation of the squares over the largest.
    pure real(wp) function peak_roughness(strips, peak) result(roughness)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: peak

        real(wp) :: square
        integer :: first, last, k

        first = peak
        do while (.not. starts_patch(strips, first))
            first = first - 1
        end do
        last = last_of_patch(strips, first)
        roughness = 0.0_wp
        do k = max(first, peak - 1), min(last, peak + 1)
            square = square_at(strips, strips%p0, first, last, max(k - 2, first - 1), &
                               min(k + 2, last + 1), k, &
                               0.5_wp*(strips%y_left(k) + strips%y_right(k)))
            roughness = max(roughness, 0.5_wp*abs(square - strips%p0(k)**2)/strips%p0(peak)**2)
        end do
    end function peak_roughness

    !> The polynomial through the squares of a quantity at the middles of strips `from` to `to`,
    !> one left out; the ends of the patch, with the value zero, are strips first - 1 and last + 1.
    pure real(wp) function square_at(strips, quantity, first, last, from, to, left_out, y)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: quantity(:), y
        integer, intent(in) :: first, last, from, to, left_out

        real(wp) :: term
        integer :: i, j

        square_at = 0.0_wp
        do i = max(from, first), min(to, last)
            if (i == left_out) cycle
            term = quantity(i)**2
            do j = from, to
                if (j == i .or. j == left_out) cycle
                term = term*((y - node(strips, first, last, j)) &
                             /(node(strips, first, last, i) - node(strips, first, last, j)))
            end do
            square_at = square_at + term
        end do
    end function square_at

    !> Where strip i of a patch has its middle, or the patch its end.
    pure real(wp) function node(strips, first, last, i)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last, i

        if (i < first) then
            node = strips%y_left(first)
        else if (i > last) then
            node = strips%y_right(last)
        else
            node = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
        end if
    end function node
end module faststrip_normal_certificate
