!> Kik and Piotrowski's virtual penetration with an elliptic correction of its shape.
!>
!> Kik and Piotrowski (2nd Mini Conference on Contact Mechanics, Budapest 1996; Piotrowski and
!> Chollet, Vehicle System Dynamics 43, 2005, section 4; Piotrowski and Kik, VSD 46, 2008) take for
!> the patch what two bodies that do not deform would overlap in if they were pressed together by a
!> share of the penetration D only, and semi-elliptic pressures along x whose largest values go
!> with the length of the patch there:
!>
!>     A x^2 + h(y) - h_0 <= eps D,  p(x, y) = p_0/x_0 sqrt(x_l(y)^2 - x^2).
!>
!> The lowest point y_0 is where the surfaces meet, which gives p_0:
!>
!>     D = H int p(x, y)/sqrt(x^2 + (y - y_0)^2) dx dy.
!>
!> With one share everywhere (0.55 in 1996) the patch of an ellipse is one with other axes. The
!> elliptic correction (Vollebregt, User guide for CONTACT, "fast, approximate solution methods")
!> lets the share depend on y by way of an equivalent ellipse: from the width 2w of what overlaps by
!> D/2 comes B = D/(2 w^2), from A at the lowest point and B by Hertz the semi-axes a and b, and
!>
!>     eps D = A a^2 - (A a^2 - B b^2) ((y - y_m)/b)^2,
!>
!> y_m the middle of the overlap. On a Hertzian gap patch, pressures and penetration are then those
!> of Hertz.
!>
!> What differs (VSD 2008, and KPEC of CONTACT):
!>
!> - **V1** There are no elements: integrals over x are exact, those over y by Gauss's rule.
!> - **V2** Each stretch that overlaps by D/2 is a contact of its own, pressed in by what makes half
!>   of it reach down to its lowest point, D - 2 h_0 with h_0 the height of that above the lowest of
!>   all. Two do not feel each other; where they meet the load jumps, see `finish_approximate`.
module faststrip_normal_simple_kpec
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_ratio
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_simple_approximate, only: zone_t, check_approximate, finish_approximate, &
                                                   lowest_between, find_end, load_search_t, &
                                                   start_search, next_penetration, most_zones, &
                                                   close_enough, gauss_place, gauss_weight
    use faststrip_normal_simple_hertz, only: hertz_shape
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: demand_t, normal_result_t
    use faststrip_numerics_elliptic, only: complete_elliptic_d
    implicit none
    private

    public :: kpec_solve

    ! The share of the penetration whose overlap gives the equivalent ellipse.
    ! Given: User guide for CONTACT.
    real(wp), parameter :: ellipse_share = 0.5_wp
    ! The equivalent ellipse reaches beyond the lowest point by this factor.
    ! Given: KPEC of CONTACT.
    real(wp), parameter :: least_reach = 1.1_wp
    ! Steps out of the overlap in which the end of a patch is looked for, over its half-width.
    ! Tuned [1]. Origin: chosen for the time: half and double move forces in the eleventh digit.
    real(wp), parameter :: stride = 0.1_wp
    !> One patch.
    type, extends(zone_t) :: kpec_zone_t
        real(wp) :: h_low = 0.0_wp !! height of the lowest point, mm
        real(wp) :: depth = 0.0_wp !! its penetration D, from the lowest point, mm
        ! eps D is `peak - fall*(y - middle)**2`.
        real(wp) :: peak = 0.0_wp, fall = 0.0_wp, middle = 0.0_wp
        real(wp) :: stiffness = 0.0_wp !! maximum pressure over half-length, p_0/x_0, MPa/mm
    contains
        procedure :: row => kpec_row
    end type kpec_zone_t

    !> All patches.
    type :: zones_t
        integer :: n = 0
        type(kpec_zone_t) :: at(most_zones)
    end type zones_t

contains

    !> Solve by KPEC under a load or for a penetration. Nothing is allocated, no state is kept.
    !>
    !> Errors: those of `check_approximate`; `st_no_convergence`, nothing carries a load. Named
    !> limitations: `st_under_resolved`, no penetration has the load, patches meet or part there;
    !> those of `strip_solve` that the gap brings along. No error is estimated.
    pure subroutine kpec_solve(curve, compliance, demand, strips_per_patch, strips, result, &
                               status, tolerance)
        type(gap_curve_t), intent(in) :: curve       !! a gap that was set, mm
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        integer, intent(in) :: strips_per_patch      !! of the widest patch, >= 1
        type(contact_strips_t), intent(inout) :: strips !! reserved; the patches cut into strips
        type(normal_result_t), intent(out) :: result !! figures
        type(status_t), intent(out) :: status        !! how it ended
        real(wp), intent(in), optional :: tolerance
            !! how near the penetration's load is to come to that asked for, if not exactly; the
            !! pressures are scaled to it in any case

        real(wp) :: wanted
        type(load_search_t) :: search
        type(zones_t) :: zones
        real(wp) :: depth
        logical :: again

        call check_approximate(curve, compliance, demand, strips_per_patch, strips, depth, status)
        if (is_error(status)) return
        wanted = close_enough
        if (present(tolerance)) wanted = tolerance
        if (demand%by_load) then
            call start_search(compliance, demand%load, wanted, search)
            do
                depth = search%penetration
                call find_zones(curve, compliance, depth, zones)
                call next_penetration(sum(zones%at(:zones%n)%load), search, again)
                if (.not. again) exit
            end do
            result%iterations = search%steps
        else
            call find_zones(curve, compliance, depth, zones)
        end if
        call finish_approximate(curve, demand, depth, zones%at(:zones%n), strips_per_patch, &
                                wanted, strips, result, status)
    end subroutine kpec_solve

    !> All patches of a penetration, their pressures and loads.
    pure subroutine find_zones(curve, compliance, depth, zones)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(zones_t), intent(inout) :: zones

        real(wp) :: y_from(most_zones), y_to(most_zones), least, most, level
        integer :: i, n

        level = curve%h_lowest + ellipse_share*depth
        call level_intervals(curve, level, y_from, y_to, n)
        zones%n = 0
        most = curve%y(1)
        do i = 1, n
            ! Up to the middle between two stretches, or to the end of the points.
            least = most
            most = curve%y(curve%n)
            if (i < n) most = 0.5_wp*(y_to(i) + y_from(min(i + 1, n)))
            if (.not. y_to(i) > y_from(i)) cycle
            zones%n = zones%n + 1
            call find_shape(curve, y_from(i), y_to(i), level, least, most, zones%at(zones%n))
            call find_pressure(curve, compliance, zones%at(zones%n))
        end do
    end subroutine find_zones

    !> The equivalent ellipse of a stretch that overlaps, and the ends of its patch.
    pure subroutine find_shape(curve, y_from, y_to, level, least, most, zone)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y_from, y_to ! where the gap is below the level
        real(wp), intent(in) :: level        ! h, mm
        real(wp), intent(in) :: least, most  ! its patch may not go beyond
        type(kpec_zone_t), intent(out) :: zone

        real(wp) :: h, inv2r, half_width, b, bend, axes, k, s
        logical :: found

        call lowest_between(curve, y_from, level, y_to, level, zone%y_low, zone%h_low)
        zone%depth = (level - zone%h_low)/ellipse_share
        zone%middle = 0.5_wp*(y_from + y_to)
        half_width = 0.5_wp*(y_to - y_from)
        bend = ellipse_share*zone%depth/half_width**2
        call gap_at(curve, zone%y_low, h, inv2r)
        bend = max(min(bend, largest_ratio**2*inv2r), inv2r/largest_ratio**2)
        axes = abs(log(bend/inv2r))/1.5_wp ! Given: Hertz
        call hertz_shape(inv2r, bend, axes, k, s, found)
        ! A a^2 = (1/2 + s) D, B b^2 = (1/2 - s) D; s below 0 where the long axis lies across.
        if (inv2r > bend) s = -s
        b = sqrt((0.5_wp - s)*zone%depth/bend)
        b = max(b, least_reach*abs(zone%y_low - zone%middle))
        zone%peak = (0.5_wp + s)*zone%depth
        zone%fall = 2.0_wp*s*zone%depth/b**2
        zone%y_from = end_beyond(curve, zone, y_from, least, stride*half_width)
        zone%y_to = end_beyond(curve, zone, y_to, most, stride*half_width)
    end subroutine find_shape

    !> The end of a patch to one side: from the lowest point to the end of the overlap, and on in
    !> strides from there.
    pure real(wp) function end_beyond(curve, zone, y_overlap, furthest, step) result(y)
        type(gap_curve_t), intent(in) :: curve
        type(kpec_zone_t), intent(in) :: zone
        real(wp), intent(in) :: y_overlap, furthest, step

        real(wp) :: inside, outside, left, square, p0, side

        side = sign(1.0_wp, furthest - zone%y_low)
        inside = zone%y_low
        outside = y_overlap
        do
            call zone%row(curve, outside, left, square, p0)
            if (left <= 0.0_wp) exit
            inside = outside
            if ((furthest - inside)*side <= 0.0_wp) then
                y = inside
                return
            end if
            outside = side*min(side*(inside + side*step), side*furthest)
        end do
        y = find_end(curve, zone, inside, outside)
    end function end_beyond

    !> Length and pressure at one y; see `zone_t`.
    pure subroutine kpec_row(zone, curve, y, left, square, p0)
        class(kpec_zone_t), intent(in) :: zone !! with its shape
        type(gap_curve_t), intent(in) :: curve !! the gap
        real(wp), intent(in) :: y              !! mm
        real(wp), intent(out) :: left          !! what eps D leaves above the gap: A x_l^2, mm
        real(wp), intent(out) :: square        !! x_l^2, mm2
        real(wp), intent(out) :: p0            !! MPa

        real(wp) :: h, inv2r

        call gap_at(curve, y, h, inv2r)
        left = min(zone%peak - zone%fall*(y - zone%middle)**2, zone%depth) - (h - zone%h_low)
        square = max(left, 0.0_wp)/inv2r
        p0 = zone%stiffness*sqrt(square)
    end subroutine kpec_row

    !> The pressure with which the surfaces meet at the lowest point, and the load. Along x
    !>
    !>     int sqrt(l^2 - x^2)/sqrt(x^2 + s^2) dx = 2 l^2/sqrt(l^2 + s^2) D(m),  m = l^2/(l^2 + s^2)
    !>
    !> with the complete elliptic integral D. On either side of the lowest point the places of
    !> Gauss's rule are cubed, for the kernel has a logarithm there: ellipses of axes in a ratio of
    !> 50 get their penetration to a thousandth, those of 1/10 to 2 to some 1e-5.
    pure subroutine find_pressure(curve, compliance, zone)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(kpec_zone_t), intent(inout) :: zone

        real(wp) :: reach, far, share, left, square, p0, displacement, volume
        integer :: i, side

        displacement = 0.0_wp
        volume = 0.0_wp
        do side = -1, 1, 2
            reach = merge(zone%y_to - zone%y_low, zone%y_low - zone%y_from, side > 0)
            if (reach <= 0.0_wp) cycle
            do i = 1, size(gauss_place)
                far = reach*gauss_place(i)**3
                share = gauss_weight(i)*3.0_wp*gauss_place(i)**2*reach
                call zone%row(curve, zone%y_low + side*far, left, square, p0)
                volume = volume + share*square
                displacement = displacement + share*2.0_wp*square/sqrt(square + far**2) &
                                              *complete_elliptic_d(far**2/(square + far**2))
            end do
        end do
        zone%stiffness = 0.0_wp
        if (displacement > 0.0_wp) zone%stiffness = zone%depth/(compliance*displacement)
        zone%load = 0.5_wp*pi*zone%stiffness*volume
    end subroutine find_pressure
end module faststrip_normal_simple_kpec
