!> Checks of one normal solution: the figures against the strips, the strips against the gap.
!>
!> Nothing that the solver computed is taken for granted: the compliance comes from the moduli, the
!> displacements from `faststrip_lab_fuzz_influence`, the figures from the strips by formulas of
!> their own. Only the curve through the gap's points is the library's; a check of its own holds it
!> against the points.
module faststrip_lab_fuzz_solution_checks
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_fuzz_influence, only: displacement
    use faststrip_lab_fuzz_checks, only: verdict_t, report_badness, check_finite, check_order, &
                                         check_load, check_pmax, check_area, check_ends, &
                                         check_depth, check_centre, check_tip, check_middle, &
                                         check_outside, check_curve
    implicit none
    private

    public :: check_figures, check_contact, check_gap_curve

    real(wp), parameter :: load_tolerance = 1.0e-6_wp
    real(wp), parameter :: rounding = 1.0e-9_wp
    ! Of D - h_lowest. The strips close the gap here to Newton's last step.
    real(wp), parameter :: closed_tolerance = 1.0e-4_wp
    ! Of a patch's width: what Newton's last steps, 1e-6 each, of the two ends and of the strip
    ! itself may leave of a strip's place.
    real(wp), parameter :: place_tolerance = 3.0e-6_wp
    real(wp), parameter :: middle_tolerance = 0.1_wp
    real(wp), parameter :: overlap_tolerance = 0.02_wp
    real(wp), parameter :: area_tolerance = 1.0e-3_wp
    real(wp), parameter :: dip_tolerance = 0.02_wp  ! of D - h_lowest

    integer, parameter :: most_strips_checkd = 24, scan_places = 1000, places_in_interval = 3

    !> Bodies pressed together.
    type :: deformed_t
        real(wp) :: penetration = 0.0_wp ! D, from h = 0, mm
        real(wp) :: depth = 0.0_wp       ! D - h_lowest, mm
        real(wp) :: compliance = 0.0_wp  ! from the moduli, 1/MPa
    end type deformed_t

contains

    !> The figures against the strips they were made of.
    pure subroutine check_figures(case, strips, result, verdict)
        class(contact_case_t), intent(in) :: case    !! load that was asked, gap
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result
        type(verdict_t), intent(inout) :: verdict

        real(wp) :: carried, area, plain_area, jumps
        integer :: n, first, last, n_patches
        logical :: good

        n = strips%n
        call say_whether(verdict, check_finite, n >= 1)
        if (n < 1) return
        associate (left => strips%y_left(:n), right => strips%y_right(:n), p0 => strips%p0(:n), &
                   half_length => strips%half_length(:n))
            good = all(ieee_is_finite([left, right, p0, half_length])) &
                   .and. all(ieee_is_finite([result%load, result%penetration, result%area, &
                                             result%pmax, result%y_min, result%y_max, &
                                             result%x_max]))
            call say_whether(verdict, check_finite, good)
            if (.not. good) return
            good = all(p0 > 0.0_wp) .and. all(half_length > 0.0_wp) .and. all(right > left) &
                   .and. all(left(2:) >= right(:n - 1)) .and. left(1) >= case%gap%y(1) &
                   .and. right(n) <= case%gap%y(size(case%gap%y))
            call say_whether(verdict, check_order, good)
            if (.not. good) return
            carried = 0.5_wp*pi*sum(p0*half_length*(right - left))
            verdict%load_error = carried/case%load - 1.0_wp
            call report_badness(verdict, check_load, &
                                max(abs(carried - case%load), abs(result%load - case%load)) &
                                /(load_tolerance*case%load))
            call check_peak(result%pmax, maxval(p0), p0, strips, check_pmax, verdict)
            call check_peak(result%x_max, maxval(half_length), half_length, strips, check_ends, &
                            verdict)
            area = 0.0_wp
            jumps = 0.0_wp
            n_patches = 0
            last = 0
            do while (last < n)
                first = last + 1
                last = end_of_patch(strips, first)
                n_patches = n_patches + 1
                area = area + patch_area(left(first:last), right(first:last), &
                                         half_length(first:last))
                jumps = jumps + unevenness(left(first:last), right(first:last), &
                                           half_length(first:last))
            end do
            ! Strips of constant length take a round patch for too large, chords for too small.
            plain_area = 2.0_wp*sum(half_length*(right - left))
            call report_badness(verdict, check_area, &
                                abs(result%area - 0.5_wp*(area + plain_area)) &
                                /(abs(plain_area - area) + jumps + area_tolerance*plain_area))
            call report_badness(verdict, check_ends, &
                                max(abs(result%y_min - left(1)), abs(result%y_max - right(n))) &
                                /(rounding*(right(n) - left(1)) &
                                  + epsilon(1.0_wp)*maxval(abs([left(1), right(n)]))))
            call say_whether(verdict, check_ends, result%n_patches == n_patches &
                             .and. strips%n_patches == n_patches)
        end associate
    end subroutine check_figures

    !> A peak is at the largest strip, or above it by what a curve through its square and those of
    !> the neighbours can rise: an eighth of the larger fall to a neighbour, and four times that
    !> for strips of unlike widths and falls.
    pure subroutine check_peak(peak, largest, values, strips, check, verdict)
        real(wp), intent(in) :: peak, largest, values(:)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: check
        type(verdict_t), intent(inout) :: verdict

        real(wp) :: fall, above
        integer :: k

        ! Any strip near the largest may have the peak beside it.
        fall = 0.0_wp
        do k = 1, strips%n
            if (values(k) < 0.9_wp*largest) cycle
            fall = max(fall, values(k)**2 - neighbour(k - 1, k), values(k)**2 - neighbour(k + 1, k))
        end do
        above = sqrt(largest**2 + 0.5_wp*fall)
        if (peak <= largest) then
            call report_badness(verdict, check, (largest - peak)/(rounding*largest))
        else
            call report_badness(verdict, check, (peak - largest)/(above - largest &
                                                                  + rounding*largest))
        end if

    contains

        !> Square of a strip's value, zero beyond the patch.
        pure real(wp) function neighbour(k, of)
            integer, intent(in) :: k, of

            neighbour = 0.0_wp
            if (k < 1 .or. k > strips%n) return
            if (strips%patch(k) == strips%patch(of)) neighbour = values(k)**2
        end function neighbour
    end subroutine check_peak

    !> Area of a patch whose squared half-length is linear between the middles of strips and
    !> vanishes at the ends.
    pure real(wp) function patch_area(left, right, half_length) result(area)
        real(wp), intent(in) :: left(:), right(:), half_length(:)

        real(wp) :: before, y, last_y
        integer :: k

        area = 0.0_wp
        before = 0.0_wp
        last_y = left(1)
        do k = 1, size(left)
            y = 0.5_wp*(left(k) + right(k))
            area = area + between(y - last_y, before, half_length(k))
            before = half_length(k)
            last_y = y
        end do
        area = area + between(right(size(right)) - last_y, before, 0.0_wp)

    contains

        !> int 2 sqrt(q) dy of linear q = x^2: (4/3) (x2^3 - x1^3)/(x2^2 - x1^2) dy.
        pure real(wp) function between(width, x1, x2)
            real(wp), intent(in) :: width, x1, x2

            between = 4.0_wp/3.0_wp*width*(x1**2 + x1*x2 + x2**2)/(x1 + x2)
        end function between
    end function patch_area

    !> What curves through lengths that do not follow a line may add or leave out: a sixth of the
    !> second difference of neighbours, over the width of the strip.
    pure real(wp) function unevenness(left, right, half_length)
        real(wp), intent(in) :: left(:), right(:), half_length(:)

        integer :: k

        unevenness = 0.0_wp
        do k = 2, size(left) - 1
            unevenness = unevenness + 2.0_wp*(right(k) - left(k))/6.0_wp &
                         *abs(half_length(k - 1) - 2.0_wp*half_length(k) + half_length(k + 1))
        end do
    end function unevenness

    !> The strips against the gap: closed in the patches, open outside.
    subroutine check_contact(case, curve, strips, result, verdict)
        class(contact_case_t), intent(in) :: case    !! moduli
        type(gap_curve_t), intent(in) :: curve       !! of its gap
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result
        type(verdict_t), intent(inout) :: verdict

        type(deformed_t) :: deformed

        ! At which the strips close the gap.
        deformed%depth = (result%penetration - curve%h_lowest)/result%correction
        deformed%penetration = curve%h_lowest + deformed%depth
        call say_whether(verdict, check_depth, deformed%depth > 0.0_wp)
        if (.not. deformed%depth > 0.0_wp) return
        associate (material => case%material)
            deformed%compliance = ((1.0_wp - material%nu_wheel**2)/material%e_wheel &
                                   + (1.0_wp - material%nu_rail**2)/material%e_rail)/pi
        end associate
        call check_patches(deformed, curve, strips, verdict)
        call check_surroundings(deformed, curve, strips, verdict)
    end subroutine check_contact

    !> Distance of the deformed surfaces at a place over D - h_lowest.
    real(wp) function opening(deformed, curve, strips, x, y)
        type(deformed_t), intent(in) :: deformed
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: x, y ! mm

        real(wp) :: h, inv2r

        call gap_at(curve, y, h, inv2r)
        opening = (h + inv2r*x**2 - deformed%penetration &
                   + deformed%compliance*displacement(strips, x, y))/deformed%depth
    end function opening

    !> Closed in the patches: at the middles and tips of strips, and nearly so between them.
    subroutine check_patches(deformed, curve, strips, verdict)
        type(deformed_t), intent(in) :: deformed
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(verdict_t), intent(inout) :: verdict

        real(wp) :: y, middle, weight, weights, shift, play
        integer :: k, stride, first, last

        stride = 1 + (strips%n - 1)/most_strips_checkd
        middle = 0.0_wp
        weights = 0.0_wp
        last = 0
        do k = 1, strips%n
            if (k > last) then
                first = k
                last = end_of_patch(strips, first)
            end if
            if (modulo(k, stride) /= 0 .and. k /= first .and. k /= last) cycle
            y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            ! On a step in a patch (a fill value of 1e10 mm) the height moves by many penetrations
            ! over the width to which the strip's place is known; elsewhere by next to nothing.
            shift = place_tolerance*(strips%y_right(last) - strips%y_left(first))
            play = abs(height_at(y + shift) - height_at(y - shift))/deformed%depth
            associate (xd => strips%half_length(k))
                call report_badness(verdict, check_centre, abs(opened(0.0_wp)) &
                                    /(closed_tolerance + play))
                call report_badness(verdict, check_tip, abs(opened(xd)) &
                                    /(closed_tolerance + play))
                weight = strips%y_right(k) - strips%y_left(k)
                middle = middle + weight*max(abs(opened(0.5_wp*xd)) - play, 0.0_wp)
                weights = weights + weight
            end associate
        end do
        call report_badness(verdict, check_middle, middle/(weights*middle_tolerance))

    contains

        !> On the strip's middle line.
        real(wp) function opened(x)
            real(wp), intent(in) :: x

            opened = opening(deformed, curve, strips, x, y)
        end function opened

        real(wp) function height_at(at)
            real(wp), intent(in) :: at

            real(wp) :: inv2r

            call gap_at(curve, at, height_at, inv2r)
        end function height_at
    end subroutine check_patches

    !> Open outside, at places on the line x = 0, more than half an end strip away from the patches:
    !> what is nearer belongs to where the ends are.
    subroutine check_surroundings(deformed, curve, strips, verdict)
        type(deformed_t), intent(in) :: deformed
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(verdict_t), intent(inout) :: verdict

        real(wp) :: at, h, inv2r, gap
        integer :: i, next

        call report_badness(verdict, check_outside, 0.0_wp)
        next = 1
        do i = 0, scan_places
            at = curve%y(1) + (curve%y(curve%n) - curve%y(1))*real(i, wp)/scan_places
            call gap_at(curve, at, h, inv2r)
            if (h >= deformed%penetration) cycle
            do while (next <= strips%n)
                if (1.5_wp*strips%y_right(next) - 0.5_wp*strips%y_left(next) >= at) exit
                next = next + 1
            end do
            if (next <= strips%n) then
                if (1.5_wp*strips%y_left(next) - 0.5_wp*strips%y_right(next) <= at) cycle
            end if
            gap = opening(deformed, curve, strips, 0.0_wp, at)
            call report_badness(verdict, check_outside, -gap/overlap_tolerance)
            if (-gap <= verdict%overlap) cycle
            verdict%overlap = -gap
            verdict%overlap_y = at
        end do
    end subroutine check_surroundings

    !> The curve against its points: it passes through them, and between two of them it dips by no
    !> more than twice what the smaller of the bends there makes, or the bend at a point that is
    !> lower than its neighbours: that of the parabola through the three.
    subroutine check_gap_curve(gap, curve, penetration, verdict)
        type(gap_t), intent(in) :: gap
        type(gap_curve_t), intent(in) :: curve    !! of the gap
        real(wp), intent(in) :: penetration       !! from h = 0, mm
        type(verdict_t), intent(inout) :: verdict

        ! Below this part of the largest the solver may raise the longitudinal term. The check's
        ! own bound, not the solver's share of the mean: so it notices a change of that.
        real(wp), parameter :: raised_part = 0.03_wp
        real(wp) :: depth, bend(size(gap%y)), floor, lowest, h, inv2r, y, size_of_h, largest_term
        integer :: i, j, n

        n = size(gap%y)
        bend(1) = 0.0_wp
        bend(n) = 0.0_wp
        do i = 2, n - 1
            bend(i) = 2.0_wp*((gap%h(i + 1) - gap%h(i))/(gap%y(i + 1) - gap%y(i)) &
                              - (gap%h(i) - gap%h(i - 1))/(gap%y(i) - gap%y(i - 1))) &
                      /(gap%y(i + 1) - gap%y(i - 1))
        end do
        bend(1) = bend(2)
        bend(n) = bend(n - 1)
        largest_term = maxval(abs(gap%inv2r))
        ! The depth that the points allow.
        lowest = huge(1.0_wp)
        do i = 1, n - 1
            lowest = min(lowest, floor_of(i))
        end do
        depth = penetration - lowest
        call say_whether(verdict, check_depth, depth > 0.0_wp)
        if (.not. depth > 0.0_wp) return
        call report_badness(verdict, check_curve, 0.0_wp)
        do i = 1, n - 1
            size_of_h = max(abs(gap%h(i)), abs(gap%h(i + 1)))
            call gap_at(curve, gap%y(i), h, inv2r)
            call report_badness(verdict, check_curve, &
                                abs(h - gap%h(i))/(rounding*depth + 1.0e-12_wp*size_of_h))
            call hold_term(inv2r, gap%inv2r(i), gap%inv2r(i))
            floor = floor_of(i)
            do j = 1, places_in_interval
                y = gap%y(i) + (gap%y(i + 1) - gap%y(i))*real(j, wp)/(places_in_interval + 1)
                call gap_at(curve, y, h, inv2r)
                call hold_term(inv2r, minval(gap%inv2r(i:i + 1)), maxval(gap%inv2r(i:i + 1)))
                if (h > penetration) cycle
                call report_badness(verdict, check_curve, &
                                    (floor - h)/(dip_tolerance*depth + 1.0e-12_wp*size_of_h))
            end do
        end do

    contains

        !> How low the curve may be in an interval.
        pure real(wp) function floor_of(i)
            integer, intent(in) :: i

            real(wp) :: allowed

            ! As far as the bend at either end lets a parabola fall below them.
            allowed = max(bend(i), bend(i + 1), 0.0_wp)
            floor_of = min(gap%h(i), gap%h(i + 1)) - 0.25_wp*allowed*(gap%y(i + 1) - gap%y(i))**2
        end function floor_of

        !> The longitudinal term stays between those of two points; where these are far below the
        !> largest it may be raised.
        subroutine hold_term(inv2r, lowest_term, highest_term)
            real(wp), intent(in) :: inv2r, lowest_term, highest_term

            real(wp) :: raised

            raised = max(highest_term, merge(raised_part*largest_term, highest_term, &
                                             lowest_term < raised_part*largest_term))
            call report_badness(verdict, check_curve, &
                                max(lowest_term - inv2r, inv2r - raised)/(rounding*largest_term))
        end subroutine hold_term
    end subroutine check_gap_curve

    pure integer function end_of_patch(strips, first) result(last)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first

        do last = first, strips%n - 1
            if (strips%patch(last + 1) /= strips%patch(first)) return
        end do
        last = strips%n
    end function end_of_patch

    pure subroutine say_whether(verdict, check, good)
        type(verdict_t), intent(inout) :: verdict
        integer, intent(in) :: check
        logical, intent(in) :: good

        call report_badness(verdict, check, merge(0.0_wp, huge(1.0_wp), good))
    end subroutine say_whether
end module faststrip_lab_fuzz_solution_checks
