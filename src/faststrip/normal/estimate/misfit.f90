!> How far a gap is from the parabola of its Hertz contact.
!>
!> Hertz's pressure closes the gap `h0 + A x^2 + B y^2` on its ellipse. What the gap of a contact
!> differs from that by,
!>
!>     d(x, y) = [h(y) - h0 - B y^2 + (A(y) - A) x^2]/penetration,
!>
!> is a gap that is left (or an overlap) where the ellipse says contact, and beside it an overlap if
!> it is lower than the surfaces are apart there. Looked at in a few places of either side, beside
!> the ellipse also wherever the gap has a valley.
module faststrip_normal_estimate_misfit
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, gap_curvature, gap_inv2r, &
                                            valley_below
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    implicit none
    private

    public :: misfit_t, find_misfit, most_misfit

    !> The most told of a difference.
    !> Tuned [1]. Origin: chosen: beyond any that is told apart.
    real(wp), parameter :: most_misfit = 1.0e3_wp

    !> Differences over the penetration from the lowest height.
    type :: misfit_t
        real(wp) :: largest = 0.0_wp !! largest on and just beyond the ellipse
        real(wp) :: inside = 0.0_wp  !! largest on the ellipse
        real(wp) :: mean = 0.0_wp    !! mean by the pressure of a flat punch: to first order what
                                     !! the penetration under a load is larger by
        real(wp) :: magnitude = 0.0_wp !! the same mean of magnitudes
        real(wp) :: tips = 0.0_wp    !! root mean square on the centre line and at the tips
        real(wp) :: odd = 0.0_wp     !! mean of y/b times d: left and right are unlike
        real(wp) :: overlap = 0.0_wp !! largest beside the ellipse
        real(wp) :: aside = 0.0_wp   !! largest overlap times its distance from the ellipse over b
        real(wp) :: peak = 0.0_wp    !! maximum pressure by which a valley beside it would close
                                     !! that, over the ellipse's
        real(wp) :: rise = 0.0_wp    !! of the parabola from the middle to y = b
    end type misfit_t

    ! Where the gap is looked at, in half-widths of the ellipse: on it, and just beyond.
    ! Tuned [half-widths]. Origin: chosen: more at the edge, where ellipses differ.
    real(wp), parameter :: places(7) = [0.15_wp, 0.3_wp, 0.45_wp, 0.6_wp, 0.75_wp, 0.88_wp, &
                                        1.0_wp], beyond = 1.15_wp
    ! What each stands for of one half.
    ! Given: from the middle between neighbours to the next.
    real(wp), parameter :: shares(7) = [0.225_wp, 0.15_wp, 0.15_wp, 0.15_wp, 0.14_wp, 0.125_wp, &
                                        0.06_wp]
    ! Where an overlap is looked for beside it.
    ! Tuned [half-widths]. Origin: chosen; valleys are looked for besides.
    real(wp), parameter :: outside(5) = [beyond, 1.35_wp, 1.7_wp, 2.2_wp, 3.0_wp]
    ! From here on displacements are added up from afar.
    ! Tuned [half-widths]. Origin: of a/b = 0.01 to 100 the sum near is 1 % of the penetration off
    ! before, the other less behind.
    real(wp), parameter :: far = 1.3_wp

    ! Gauss's rule from 0 to 1.
    ! Given: Gauss, six points, both sides of the middle.
    real(wp), parameter :: offset(3) = [0.119309593041598_wp, 0.330604693233132_wp, &
                                        0.466234757101576_wp]
    ! Given: Gauss, six points.
    real(wp), parameter :: weight(3) = [0.233956967286346_wp, 0.180380786524069_wp, &
                                        0.085662246189585_wp]

contains

    !> Hold a gap against the parabola of its Hertz contact.
    pure type(misfit_t) function find_misfit(curve, compliance, hertz) result(misfit)
        type(gap_curve_t), intent(in) :: curve !! the gap
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        type(hertz_t), intent(in) :: hertz     !! its Hertz contact, at the lowest place

        real(wp) :: b, h0, inv2r0, share
        real(wp), dimension(2) :: centre, tip, middle ! left and right
        integer :: i

        call gap_at(curve, hertz%y, h0, inv2r0)
        b = gap_curvature(curve, hertz%y)
        misfit%rise = b*hertz%b**2/hertz%penetration
        do i = 1, size(places)
            share = 0.5_wp*shares(i)
            call differ(places(i), centre, tip)
            misfit%inside = max(misfit%inside, maxval(abs(centre) + abs(tip)))
            ! Sums of two, so that left and right may be exchanged.
            misfit%tips = misfit%tips + 0.5_wp*share*sum(centre**2 + (centre + tip)**2)
            ! The mean of x^2 under a flat punch is half of that at the tip.
            middle = centre + 0.5_wp*tip
            misfit%mean = misfit%mean + share*sum(middle)
            misfit%magnitude = misfit%magnitude + share*sum(abs(middle))
            misfit%odd = misfit%odd + share*places(i)*(middle(2) - middle(1))
        end do
        misfit%tips = sqrt(misfit%tips)
        call differ(beyond, centre, tip)
        misfit%largest = min(max(misfit%inside, maxval(abs(centre))), most_misfit)
        call look_beside(curve, compliance, hertz, h0, b, misfit)

    contains

        !> The differences at t = |y|/b on the centre line, and what the tips have besides.
        pure subroutine differ(t, centre, tip)
            real(wp), intent(in) :: t
            real(wp), intent(out) :: centre(2), tip(2)

            real(wp) :: h, inv2r
            integer :: side

            do side = 1, 2
                call gap_at(curve, hertz%y + (2*side - 3)*t*hertz%b, h, inv2r)
                centre(side) = told((h - h0 - b*(t*hertz%b)**2)/hertz%penetration)
                tip(side) = told((inv2r - inv2r0)*hertz%a**2*max(1.0_wp - t*t, 0.0_wp) &
                                 /hertz%penetration)
            end do
        end subroutine differ

        pure real(wp) function told(difference)
            real(wp), intent(in) :: difference

            told = max(-most_misfit, min(difference, most_misfit))
        end function told
    end function find_misfit

    !> The overlap beside the ellipse, and what closing it would take in the gap's valleys.
    pure subroutine look_beside(curve, compliance, hertz, h0, b, misfit)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, h0, b
        type(hertz_t), intent(in) :: hertz
        type(misfit_t), intent(inout) :: misfit

        real(wp) :: y, h, inv2r, bend, overlap
        integer :: i, side

        bend = b*hertz%b**2
        do i = 1, size(outside)
            do side = -1, 1, 2
                y = hertz%y + side*outside(i)*hertz%b
                if (y < curve%y(1) .or. y > curve%y(curve%n)) cycle
                call gap_at(curve, y, h, inv2r)
                call take_overlap(outside(i), -clearance(outside(i), h), misfit)
            end do
        end do
        i = 1
        do
            ! A level that rounding does not bring below what is asked for next.
            i = valley_below(curve, h0 + hertz%penetration &
                             + 2.0_wp*spacing(abs(h0) + hertz%penetration), i + 1)
            if (i > curve%n_pieces) exit
            if (curve%h_node(i) - h0 >= hertz%penetration) cycle
            y = abs(curve%y_node(i) - hertz%y)/hertz%b
            if (y <= beyond) cycle
            overlap = -clearance(y, curve%h_node(i))
            if (overlap <= 0.0_wp) cycle
            call take_overlap(y, overlap, misfit)
            misfit%peak = max(misfit%peak, &
                              pressure_of_valley(curve, compliance, curve%y_node(i), &
                                                 overlap*hertz%penetration)/hertz%pmax)
        end do
        misfit%overlap = min(misfit%overlap, most_misfit)
        misfit%aside = min(misfit%aside, most_misfit)
        misfit%peak = min(misfit%peak, most_misfit)

    contains

        !> Gap that the pressure leaves at y = t b, over the penetration.
        pure real(wp) function clearance(t, height)
            real(wp), intent(in) :: t, height

            real(wp) :: scale

            ! What the integral is to be taken times for a displacement over the penetration.
            scale = 0.75_wp*hertz%load*compliance/hertz%penetration ! Given: Hertz
            if (t < far) then
                clearance = (height - h0 - bend*t*t)/hertz%penetration &
                            + scale*sum_near(hertz%a/hertz%b, t)/hertz%b
            else
                clearance = (height - h0)/hertz%penetration - 1.0_wp &
                            + scale*sum_far(hertz%a/hertz%b, t)/hertz%b
            end if
        end function clearance
    end subroutine look_beside

    pure subroutine take_overlap(t, overlap, misfit)
        real(wp), intent(in) :: t, overlap
        type(misfit_t), intent(inout) :: misfit

        misfit%overlap = max(misfit%overlap, overlap)
        misfit%aside = max(misfit%aside, overlap*(t - 1.0_wp))
    end subroutine take_overlap

    !> Maximum pressure of the Hertz contact of a place of the gap for a penetration, MPa; zero if
    !> it is no valley.
    pure real(wp) function pressure_of_valley(curve, compliance, y, depth) result(pressure)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, y, depth

        type(hertz_t) :: unit_load
        type(status_t) :: status

        pressure = 0.0_wp
        call hertz_solve(compliance, gap_inv2r(curve, y), gap_curvature(curve, y), 1.0_wp, &
                         unit_load, status)
        if (is_error(status)) return
        ! Pressure goes with the root of the penetration.
        pressure = unit_load%pmax*sqrt(depth/unit_load%penetration)
    end function pressure_of_valley

    !> Distance of the surfaces beside the ellipse, for a gap that is the parabola: with b = 1
    !>
    !>     int_0^q [t^2/(1 + w) - 1] dw/sqrt((a^2 + w)(1 + w) w),  q = t^2 - 1,  w = q s^2
    pure real(wp) function sum_near(a, t) result(total)
        real(wp), intent(in) :: a, t

        real(wp) :: q, w
        integer :: i, side

        q = t*t - 1.0_wp
        total = 0.0_wp
        do i = 1, size(offset)
            do side = -1, 1, 2
                w = q*(0.5_wp + side*offset(i))**2
                total = total + weight(i)*(t*t/(1.0_wp + w) - 1.0_wp) &
                                /sqrt((a*a + w)*(1.0_wp + w))
            end do
        end do
        total = 2.0_wp*sqrt(q)*total
    end function sum_near

    !> Displacement at t, from afar: with b = 1
    !>
    !>     int_q^infinity [1 - t^2/(1 + w)] dw/sqrt((a^2 + w)(1 + w) w),  w = q/s^2,  s = r^2
    pure real(wp) function sum_far(a, t) result(total)
        real(wp), intent(in) :: a, t

        real(wp) :: q, r, square
        integer :: i, side

        q = t*t - 1.0_wp
        total = 0.0_wp
        do i = 1, size(offset)
            do side = -1, 1, 2
                r = 0.5_wp + side*offset(i)
                square = r**4
                total = total + weight(i)*2.0_wp*r*(1.0_wp - t*t*square/(square + q)) &
                                /sqrt((a*a*square + q)*(square + q))
            end do
        end do
        total = 2.0_wp*sqrt(q)*total
    end function sum_far
end module faststrip_normal_estimate_misfit
