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
!> with means over y. Of n strips across the patch with the largest pressure, fewer than eight raise
!> the area's estimate by 8/n, because a cubic through few lengths tells less of the tips. These
!> factors were calibrated so that 95 % of the Hertz ellipses of a/b = 0.004 to 100 and of every
!> second of the 20 gaps of the reference are bounded, with 5 to 41 strips, and then raised by
!> about 1.3.
!>
!> The largest pressure may be wrong in its strip, or another strip may carry more. Each strip k of
!> a patch of n strips has a pressure of its own that its residuals ask for. A wave of amplitude d
!> and wave number c is closed by the pressure c d/(pi H) on a half-space, so that
!>
!>     d_k = 0.30 |e_k| D/(H l)                       e_k: mean of e at its two edges
!>         + 0.35 C(s_k) D/(H l)                      s_k: half the difference of e at them
!>         + 0.45 |m_k| D/(H xd)                      the section is no semi-ellipse
!>         + 0.50 C(m_k) D/(2 H w)                    and changes from strip to strip
!>         + 0.012 |p0_k-2 - 4 p0_k-1 + 6 p0_k - 4 p0_k+1 + p0_k+2|
!>         + 1.10 u_k                                 of heights that the strip does not resolve:
!>                                                    `faststrip_normal_unresolved`
!>         + p0_k (sqrt(A/line) - 1)/(1 + xd/w)       A between the middles of the strips:
!>                                                    `faststrip_normal_longitudinal`
!>
!>     pmax = max( max d_k/pmax of the strip with the largest pressure and its neighbours,
!>                 max (p0_k + d_k)/pmax - max p0_k/pmax of all strips,
!>                 0.40/n^2 )
!>            + 1/3 sum w xd 0.45 |m_k| D/(H xd) / sum w xd p0_k
!>     and at least 1 - pmax/max q_k
!>
!> with 1/l = 1/(2w) + 1/[2 pi xd (1 + ln(1 + w/xd))]: strips shorter than wide are needles, which
!> press in what is about as long as they are, not as wide, and take more pressure to close a gap.
!> The sum is the load that sections which are no semi-ellipses have too much or too little:
!> others take it, and their pressures go with its cube root, wherever they are. q_k is the largest
!> pressure of a strip off the centre line (`faststrip_normal_longitudinal`).
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
!> `faststrip-lab bench certificate` judges them with another.
!> All factors are of experience, no bounds in the strict sense.
module faststrip_normal_certificate
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_bad_material, st_not_finite, &
                                     st_no_contact, st_out_of_range, st_workspace_too_small
    use faststrip_influence_row, only: center_influence_column, influence_column_gradient
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_strip_state, only: flattest
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_longitudinal, only: inv2r_samples_t, inv2r_range, local_rise, &
                                             off_centre_pressure
    use faststrip_normal_unresolved, only: unresolved_pressure, unresolved_pressure_growth, &
                                           most_nodes
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
    real(wp), parameter :: area_factor = 1.5_wp, area_middle = 3.5_wp
    real(wp), parameter :: area_strips = 8.0_wp, area_unresolved = 0.5_wp
    real(wp), parameter :: edge_factor = 0.3_wp, slope_factor = 0.35_wp
    real(wp), parameter :: section_factor = 0.45_wp, section_change = 0.5_wp
    real(wp), parameter :: unresolved_factor = 1.1_wp, wave_factor = 0.012_wp
    real(wp), parameter :: pmax_least = 0.4_wp

    ! The largest pressure goes with the cube root of the load of its surroundings.
    real(wp), parameter :: per_load = 1.0_wp/3.0_wp

    integer, parameter :: tips_ahead = 4     ! of a block of strips, sampled outside
    real(wp), parameter :: ahead = 1.05_wp   ! of the half-length, outside
    real(wp), parameter :: beyond(2) = [0.25_wp, 1.0_wp] ! widths of the end strip, outside
    integer, parameter :: scan_points = 8    ! in a stretch below D outside the patches
    integer, parameter :: max_intervals = 64
    integer, parameter :: block = 32         ! strips sampled together

    !> Gaps in a block of strips, strip i of it from 1 on, and in the strips on both its sides.
    type :: samples_t
        real(wp), dimension(0:block + 1) :: left = 0.0_wp   ! on the centre line, at the left edge
        real(wp), dimension(0:block + 1) :: right = 0.0_wp  ! at the right edge
        real(wp), dimension(0:block + 1) :: middle = 0.0_wp ! in the middle of the strip
        real(wp), dimension(0:block + 1) :: tip = 0.0_wp    ! at the tip at the right edge
        real(wp), dimension(0:block + 1) :: tips = 0.0_wp   ! mean size of those at both edges
        real(wp), dimension(0:block + 1) :: inv2r = 0.0_wp  ! A in the middle of the strip
        real(wp), dimension(0:block + 1) :: inv2r_right = 0.0_wp ! A at the right edge
    end type samples_t

    ! Sizes that cannot overflow.
    real(wp), parameter :: smallest = 1.0e-30_wp, largest = 1.0e30_wp

    ! Two-grid estimate: the order of the strips, and Roache's factor of safety for two grids.
    real(wp), parameter :: order = 2.0_wp, two_grid_safety = 3.0_wp

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
    pure subroutine certify_strips(curve, compliance, strips, result, certificate, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        type(normal_result_t), intent(in) :: result  !! its penetration and pmax are used
        type(certificate_t), intent(out) :: certificate !! zeros after an error
        type(status_t), intent(out) :: status        !! how it ended

        type(samples_t) :: samples
        real(wp) :: depth, width, extra, peak_extra, largest_p0
        real(wp) :: widths, sum_edge, sum_tip, sum_middle, sum_area, sum_unresolved
        real(wp) :: unresolved, at_tip, rise, variation, variation_of_all, off_centre
        real(wp) :: sum_section, sum_load
        integer :: k, from, peak, across

        call check_solution(curve, compliance, strips, result, status)
        if (is_error(status)) return
        depth = result%penetration - curve%h_lowest
        peak = maxloc(strips%p0(:strips%n), dim=1)
        largest_p0 = 0.0_wp
        peak_extra = 0.0_wp
        widths = 0.0_wp
        sum_middle = 0.0_wp
        sum_edge = 0.0_wp
        sum_tip = 0.0_wp
        sum_area = 0.0_wp
        sum_unresolved = 0.0_wp
        sum_section = 0.0_wp
        sum_load = 0.0_wp
        off_centre = 0.0_wp
        variation_of_all = inv2r_range(curve, strips%y_left(1), strips%y_right(strips%n))
        do from = 1, strips%n, block
            call take_samples(curve, compliance, strips, depth, from, samples, certificate)
            do k = from, min(from + block - 1, strips%n)
                width = strips%y_right(k) - strips%y_left(k)
                widths = widths + width
                associate (i => k - from + 1)
                    sum_edge = sum_edge &
                               + width*(0.5_wp*(abs(samples%left(i)) + abs(samples%right(i))))**2
                    sum_tip = sum_tip + width*samples%tips(i)**2
                    sum_middle = sum_middle + width*abs(samples%middle(i))
                end associate
                call find_unresolved(curve, compliance, strips, k, unresolved, at_tip)
                sum_unresolved = sum_unresolved + width*strips%half_length(k) &
                                 *min(1.0_wp, unresolved/max(strips%p0(k), smallest))
                sum_area = sum_area + width*strips%half_length(k)
                call local_rise(curve, strips%y_left(k), strips%y_right(k), &
                                strips%half_length(k), inv2r_about(strips, k, k - from + 1, &
                                                                   samples), rise, variation)
                extra = missing_pressure(compliance, strips, depth, k, k - from + 1, samples, &
                                         unresolved) + max(strips%p0(k), 0.0_wp)*rise
                off_centre = max(off_centre, strips%p0(k) + unresolved_factor*at_tip, &
                                 off_centre_pressure( &
                                     curve, compliance, depth, strips%y_left(k), &
                                     strips%y_right(k), strips%y_left(first_of_patch(strips, k)), &
                                     strips%y_right(last_of_patch(strips, k)), &
                                     strips%half_length(k), strips%p0(k), variation, &
                                     variation_of_all))
                sum_section = sum_section + width*abs(samples%middle(k - from + 1)) &
                              *(section_factor*depth/compliance)
                sum_load = sum_load + width*strips%half_length(k)*max(strips%p0(k), 0.0_wp)
                largest_p0 = max(largest_p0, strips%p0(k) + extra)
                if (abs(k - peak) <= 1 .and. strips%patch(k) == strips%patch(peak)) &
                    peak_extra = max(peak_extra, extra)
            end do
        end do
        call look_elsewhere(curve, compliance, strips, depth, certificate%overlap_outside)
        certificate%est_err_penetration = &
            penetration_factor*(sqrt(sum_edge/widths) + penetration_middle*sum_middle/widths)
        across = count(strips%patch(:strips%n) == strips%patch(peak))
        certificate%est_err_area = &
            area_factor*max(1.0_wp, area_strips/across) &
            *(sqrt(sum_tip/widths) + area_middle*sum_middle/widths) &
            + area_unresolved*sum_unresolved/sum_area
        certificate%est_err_pmax = max(peak_extra/result%pmax, &
                                       (largest_p0 - strips%p0(peak))/result%pmax, &
                                       pmax_least/across**2) + per_load*(sum_section/sum_load)
        certificate%est_err_pmax = max(certificate%est_err_pmax, &
                                       1.0_wp - result%pmax/max(off_centre, result%pmax))
    end subroutine certify_strips

    !> The gaps sampled in a block of strips, and in the strips before and behind it.
    pure subroutine take_samples(curve, compliance, strips, depth, from, samples, certificate)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: from ! first strip of the block
        type(samples_t), intent(out) :: samples
        type(certificate_t), intent(inout) :: certificate ! its residuals are increased

        real(wp), dimension(block + 2) :: x, y, x_tip, gap, inv2r
        real(wp) :: y_edge(1), edge(1)
        integer :: first, last, low, high, k, n, to

        to = min(from + block - 1, strips%n)
        low = max(1, from - 1)
        high = min(strips%n, to + 1)
        n = high - low + 1
        first = first_of_patch(strips, low)
        last = last_of_patch(strips, low)
        do k = low, high
            if (k > last) then
                first = k
                last = last_of_patch(strips, first)
            end if
            associate (i => k - low + 1)
                y(i) = strips%y_right(k)
                x_tip(i) = 0.0_wp
                if (k < last) x_tip(i) = tip_between(strips, first, last, k)
            end associate
        end do
        call sample_centre_line(curve, compliance, strips, depth, y(:n), gap(:n))
        samples%right(low - from + 1:high - from + 1) = gap(:n)
        call sample(curve, compliance, strips, depth, x_tip(:n), y(:n), gap(:n), inv2r(:n))
        samples%tip(low - from + 1:high - from + 1) = gap(:n)
        samples%inv2r_right(low - from + 1:high - from + 1) = inv2r(:n)
        do k = low, high
            associate (i => k - low + 1)
                x(i) = sqrt(0.5_wp)*strips%half_length(k)
                y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            end associate
        end do
        call sample(curve, compliance, strips, depth, x(:n), y(:n), gap(:n), inv2r(:n))
        samples%middle(low - from + 1:high - from + 1) = gap(:n)
        samples%inv2r(low - from + 1:high - from + 1) = inv2r(:n)
        call look_ahead(curve, compliance, strips, depth, from, to, certificate%overlap_outside)
        do k = low, high
            associate (i => k - from + 1)
                if (k == low .or. starts_patch(strips, k)) then
                    y_edge = strips%y_left(k)
                    call sample_centre_line(curve, compliance, strips, depth, y_edge, edge)
                    samples%left(i) = edge(1)
                    samples%tips(i) = 0.5_wp*(abs(edge(1)) + abs(samples%tip(i)))
                else
                    samples%left(i) = samples%right(i - 1)
                    samples%tips(i) = 0.5_wp*(abs(samples%tip(i - 1)) + abs(samples%tip(i)))
                end if
                if (k < from .or. k > to) cycle
                if (starts_patch(strips, k)) &
                    call look_beyond(curve, compliance, strips, depth, k, &
                                     certificate%overlap_outside)
                certificate%residual_inside = max(certificate%residual_inside, &
                                                  abs(samples%left(i)), abs(samples%right(i)), &
                                                  abs(samples%middle(i)), abs(samples%tip(i)))
            end associate
        end do
    end subroutine take_samples

    !> The pressure that the gaps sampled about a strip ask for beyond its own, MPa.
    pure real(wp) function missing_pressure(compliance, strips, depth, k, i, samples, unresolved) &
        result(pressure)
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k, i ! the strip, and where its samples are
        type(samples_t), intent(in) :: samples
        real(wp), intent(in) :: unresolved ! of heights, MPa

        real(wp) :: edge, width, per_width, per_wave
        real(wp), dimension(-1:1) :: middle, slope
        logical :: has_left, has_right
        integer :: j

        edge = 0.5_wp*(samples%left(i) + samples%right(i))
        do j = -1, 1
            middle(j) = samples%middle(i + j)
            slope(j) = 0.5_wp*(samples%right(i + j) - samples%left(i + j))
        end do
        has_left = .not. starts_patch(strips, k)
        has_right = k < last_of_patch(strips, k)
        width = strips%y_right(k) - strips%y_left(k)
        per_width = depth/(2.0_wp*compliance*width)
        per_wave = per_width + depth/(2.0_wp*pi*compliance*strips%half_length(k) &
                                      *(1.0_wp + log(1.0_wp + width/strips%half_length(k))))
        pressure = per_wave*(edge_factor*abs(edge) &
                             + slope_factor*change(slope, has_left, has_right)) &
                   + per_width*section_change*change(middle, has_left, has_right) &
                   + section_factor*abs(middle(0))*depth/(compliance*strips%half_length(k)) &
                   + unresolved_factor*unresolved + wave_factor*pressure_wave(strips, k)
    end function missing_pressure

    !> A about strip k, whose samples are number i.
    pure type(inv2r_samples_t) function inv2r_about(strips, k, i, samples) result(inv2r)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k, i
        type(samples_t), intent(in) :: samples

        inv2r%middle = samples%inv2r(i)
        inv2r%right = samples%inv2r_right(i)
        inv2r%before = inv2r%middle
        inv2r%behind = inv2r%middle
        inv2r%left = inv2r%middle
        if (.not. starts_patch(strips, k)) then
            inv2r%before = samples%inv2r(i - 1)
            inv2r%left = samples%inv2r_right(i - 1)
        end if
        if (k < last_of_patch(strips, k)) then
            inv2r%behind = samples%inv2r(i + 1)
        else
            ! Nothing presses at the end of a patch: A there is of no matter, left or right.
            inv2r%right = inv2r%middle
        end if
    end function inv2r_about

    !> Second difference of the pressures at a strip, MPa; at an end of the patch nothing.
    pure real(wp) function pressure_bend(strips, k) result(bend)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        bend = 0.0_wp
        if (starts_patch(strips, k) .or. k == last_of_patch(strips, k)) return
        bend = (strips%p0(k - 1) - strips%p0(k)) + (strips%p0(k + 1) - strips%p0(k))
    end function pressure_bend

    !> Size of the fourth difference of the pressures at a strip, MPa; beside an end nothing.
    pure real(wp) function pressure_wave(strips, k) result(wave)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        wave = 0.0_wp
        if (starts_patch(strips, k) .or. k == last_of_patch(strips, k)) return
        if (starts_patch(strips, k - 1) .or. k + 1 == last_of_patch(strips, k)) return
        wave = abs((pressure_bend(strips, k - 1) - pressure_bend(strips, k)) &
                   + (pressure_bend(strips, k + 1) - pressure_bend(strips, k)))
    end function pressure_wave

    !> The pressure that heights in strip k ask for which it does not resolve, and how far a
    !> longitudinal term that it does not resolve raises the largest pressure above its own. The
    !> smooth curve meets the gap where it is sampled: in its middle, at its edges and in its
    !> neighbours' middles.
    pure subroutine find_unresolved(curve, compliance, strips, k, pressure, rise)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k
        real(wp), intent(out) :: pressure, rise ! MPa

        real(wp) :: node(most_nodes), tip, half
        integer :: n

        associate (left => strips%y_left(:strips%n), right => strips%y_right(:strips%n))
            n = 3
            node(1) = left(k)
            node(2) = 0.5_wp*(left(k) + right(k))
            node(3) = right(k)
            if (.not. starts_patch(strips, k)) then
                n = n + 1
                node(n) = 0.5_wp*(left(k - 1) + right(k - 1))
            end if
            if (k < last_of_patch(strips, k)) then
                n = n + 1
                node(n) = 0.5_wp*(left(k + 1) + right(k + 1))
            end if
            ! At an end of the patch the neighbour's other edge serves instead.
            if (n == 4 .and. starts_patch(strips, k)) node(5) = right(k + 1)
            if (n == 4 .and. .not. starts_patch(strips, k)) node(5) = left(k - 1)
            if (n == 4) n = 5
            pressure = unresolved_pressure(curve, compliance, left(k), right(k), node(:n))
            tip = unresolved_pressure_growth(curve, compliance, left(k), right(k), node(:n)) &
                  *min(strips%half_length(k), largest)**2
        end associate
        half = 0.5_wp*max(strips%p0(k), 0.0_wp)
        rise = 0.0_wp
        if (tip > half) rise = tip*(1.0_wp - half/tip)**2
    end subroutine find_unresolved

    !> How far the middle one of three values is from the mean of the outer ones; at an end from the
    !> straight line on, which is nothing; alone its size.
    pure real(wp) function change(values, has_left, has_right)
        real(wp), intent(in) :: values(-1:1)
        logical, intent(in) :: has_left, has_right

        change = 0.0_wp
        if (has_left .and. has_right) then
            change = abs(values(0) - 0.5_wp*(values(-1) + values(1)))
        else if (.not. (has_left .or. has_right)) then
            change = abs(values(0))
        end if
    end function change

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
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the strips')
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

    !> The gap between the deformed surfaces over the penetration, at any points, and A there.
    pure subroutine sample(curve, compliance, strips, depth, x, y, gap, inv2r)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, x(:), y(:)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(out) :: gap(:), inv2r(:)

        real(wp), dimension(block + 2) :: influence, d_x, d_half_length
        real(wp) :: h
        integer :: s, i, m

        m = size(y)
        do i = 1, m
            call gap_at(curve, y(i), h, inv2r(i))
            inv2r(i) = min(max(inv2r(i), flattest), largest)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp + inv2r(i)*(x(i)*(x(i)/depth))
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

        real(wp) :: influence(block + 2), h, inv2r
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

    !> The overlap ahead of some of the tips of strips `from` to `to`.
    pure subroutine look_ahead(curve, compliance, strips, depth, from, to, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: from, to
        real(wp), intent(inout) :: overlap

        real(wp), dimension(tips_ahead) :: x, y, gap, inv2r
        integer :: i, k

        do i = 1, tips_ahead
            k = from + ((to - from)*(2*i - 1))/(2*tips_ahead)
            x(i) = ahead*strips%half_length(k)
            y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        end do
        call sample(curve, compliance, strips, depth, x, y, gap, inv2r)
        overlap = max(overlap, -minval(gap))
    end subroutine look_ahead

    !> The overlap beyond both ends of the patch that starts with strip `first`.
    pure subroutine look_beyond(curve, compliance, strips, depth, first, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first
        real(wp), intent(inout) :: overlap

        real(wp) :: y(4), gap(4)
        integer :: i, last

        last = last_of_patch(strips, first)
        y(1:2) = strips%y_left(first) - beyond*(strips%y_right(first) - strips%y_left(first))
        y(3:4) = strips%y_right(last) + beyond*(strips%y_right(last) - strips%y_left(last))
        call sample_centre_line(curve, compliance, strips, depth, y, gap)
        do i = 1, 4
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

    !> The first strip of the patch that strip k belongs to.
    pure integer function first_of_patch(strips, k) result(first)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: k

        do first = k, 2, -1
            if (starts_patch(strips, first)) return
        end do
        first = 1
    end function first_of_patch

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
