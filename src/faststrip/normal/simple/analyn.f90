!> Strips that are slices of the Hertz ellipses of the gap's local curvatures.
!>
!> Sichani, Enblom and Berg (Vehicle System Dynamics 52, 2014, "A novel method to model wheel-rail
!> normal contact in vehicle dynamics simulation") approximate how the surfaces give way from
!> Hertz's theory with the curvatures A(y) and B(y) of each place. An ellipse of penetration D has
!> A a^2 (1 + alpha) = D = B b^2 (1 + beta); where the gap is h above its lowest point,
!>
!>     (1 + alpha(y)) A x^2 + (1 + beta(y)) h(y) <= D
!>
!> is the patch, `d = D - (1 + beta) h` the penetration left there, and the pressure along x is the
!> semi-ellipse of that half-length whose largest value is that of a Hertz contact of A(y), B(y)
!> and penetration d. On a Hertzian gap all is Hertz's. Patches need no rule: they are where d is
!> positive, and each one's pressures are its own.
!>
!> What differs (from the authors, and ANALYN of CONTACT):
!>
!> - **V3** B is that of the gap's spline at the place itself, no difference over elements, so that
!>   noise of the gap and jumps of a profile's radius show more; where it is below 0.092 A and half
!>   of what the gap has on the mean it is raised to the smaller of these. CONTACT raises it to
!>   1e-4/mm, which is 0.092 A of a wheel of 460 mm; so the lengths' unit does not count.
module faststrip_normal_simple_analyn
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, gap_curvature, level_intervals
    use faststrip_normal_simple_approximate, only: zone_t, check_approximate, finish_approximate, &
                                                   lowest_between, find_end, load_search_t, &
                                                   start_search, next_penetration, most_zones, &
                                                   close_enough, gauss_place, gauss_weight
    use faststrip_normal_simple_hertz, only: hertz_shape
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: demand_t, normal_result_t
    implicit none
    private

    public :: analyn_solve

    ! Least curvature B that counts is the smaller of these parts of A and of the mean of the gap up
    ! to the penetration.
    ! Tuned [1]: Over A. Origin: 1e-4/mm, as in CONTACT, on a wheel of 460 mm.
    real(wp), parameter :: least_ratio = 0.092_wp
    ! Tuned [1]: Over the mean. Origin: chosen: below what gaps of one curvature have; 20 contacts
    ! S1002/UIC60 are the same at half and double.
    real(wp), parameter :: least_of_mean = 0.5_wp
    ! Places in a stretch below the penetration where the penetration left is looked at.
    ! Tuned [points]. Origin: chosen: patches narrower than the distance may be missed; with twice
    ! as many Fx and Fy of 20 contacts S1002/UIC60 change by up to 0.2 %, with half nothing does.
    integer, parameter :: probes = 16
    ! Change of ln(B/A) over that of ln(a/b), of which Newton's method starts.
    ! Tuned [1]. Origin: chosen: between 3/2 of circles and 2; from 3/2 forces change in the ninth
    ! digit.
    real(wp), parameter :: usual_slope = 1.7_wp

    !> One patch.
    type, extends(zone_t) :: analyn_zone_t
        real(wp) :: compliance = 0.0_wp !! H of eq. (4), 1/MPa
        real(wp) :: h_low = 0.0_wp      !! lowest height of all the gap, mm
        real(wp) :: depth = 0.0_wp      !! penetration D above it, mm
        real(wp) :: least = 0.0_wp      !! half the gap's mean B up to there, 1/mm
        real(wp) :: log_ratio = 0.0_wp, axes = 0.0_wp !! |ln(A/B)| and ln(a/b) somewhere
    contains
        procedure :: row => analyn_row
    end type analyn_zone_t

    !> All patches.
    type :: zones_t
        integer :: n = 0
        type(analyn_zone_t) :: at(most_zones)
    end type zones_t

contains

    !> Solve by ANALYN under a load or for a penetration. Nothing is allocated, no state is kept.
    !>
    !> Errors: those of `check_approximate`; `st_no_convergence`, nothing carries a load. Named
    !> limitations: `st_under_resolved`, no penetration has the load, patches meet or part there;
    !> those of `strip_solve` that the gap brings along. No error is estimated.
    pure subroutine analyn_solve(curve, compliance, demand, strips_per_patch, strips, result, &
                                 status)
        type(gap_curve_t), intent(in) :: curve       !! a gap that was set, mm
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        integer, intent(in) :: strips_per_patch      !! of the widest patch, >= 1
        type(contact_strips_t), intent(inout) :: strips !! reserved; the patches cut into strips
        type(normal_result_t), intent(out) :: result !! figures
        type(status_t), intent(out) :: status        !! how it ended

        type(load_search_t) :: search
        type(zones_t) :: zones
        real(wp) :: depth
        logical :: again

        call check_approximate(curve, compliance, demand, strips_per_patch, strips, depth, status)
        if (is_error(status)) return
        if (demand%by_load) then
            call start_search(compliance, demand%load, close_enough, search)
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
                                close_enough, strips, result, status)
    end subroutine analyn_solve

    !> All patches of a penetration, and their loads.
    pure subroutine find_zones(curve, compliance, depth, zones)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(zones_t), intent(inout) :: zones

        type(analyn_zone_t) :: zone
        real(wp) :: y_from(most_zones), y_to(most_zones), h, inv2r, k, s
        integer :: i, n
        logical :: found

        zone%compliance = compliance
        zone%h_low = curve%h_lowest
        zone%depth = depth
        call level_intervals(curve, curve%h_lowest + depth, y_from, y_to, n)
        zones%n = 0
        if (n == 0) return
        i = max(1, count(y_from(:n) <= curve%y_lowest))
        zone%least = least_of_mean*(sqrt(depth)/max(0.5_wp*(y_to(i) - y_from(i)), &
                                                    tiny(1.0_wp)**0.25_wp))**2
        call gap_at(curve, curve%y_lowest, h, inv2r)
        zone%log_ratio = abs(log_ratio_at(curve, zone%least, curve%y_lowest, inv2r))
        zone%axes = zone%log_ratio/1.5_wp ! Given: Hertz
        call hertz_shape(1.0_wp, exp(zone%log_ratio), zone%axes, k, s, found)
        do i = 1, n
            call find_zones_between(curve, y_from(i), y_to(i), zone, zones)
        end do
    end subroutine find_zones

    !> The patches in a stretch of the gap that is below the penetration.
    pure subroutine find_zones_between(curve, y_from, y_to, start, zones)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y_from, y_to
        type(analyn_zone_t), intent(in) :: start ! a patch without ends
        type(zones_t), intent(inout) :: zones

        type(analyn_zone_t) :: zone
        real(wp) :: y(0:probes + 1), before, left, square, p0
        integer :: i, n
        logical :: inside, was_inside

        ! The lowest point is one of the places.
        n = -1
        do i = 0, probes
            n = n + 1
            y(n) = y_from + (y_to - y_from)*i/probes
            before = y_from + (y_to - y_from)*max(i - 1, 0)/probes
            if (before < curve%y_lowest .and. curve%y_lowest < y(n)) then
                y(n + 1) = y(n)
                y(n) = curve%y_lowest
                n = n + 1
            end if
        end do
        zone = start
        was_inside = .false.
        before = y(0)
        do i = 0, n
            call zone%row(curve, y(i), left, square, p0)
            inside = left > 0.0_wp
            if (inside .and. .not. was_inside) then
                zone%y_from = y(i)
                if (i > 0) zone%y_from = find_end(curve, zone, y(i), before)
            end if
            if (was_inside .and. (i == n .or. .not. inside)) then
                zone%y_to = y(i)
                if (.not. inside) zone%y_to = find_end(curve, zone, before, y(i))
                if (zones%n < most_zones .and. zone%y_to > zone%y_from) then
                    zones%n = zones%n + 1
                    zones%at(zones%n) = zone
                    call find_load(curve, zones%at(zones%n))
                end if
            end if
            was_inside = inside
            before = y(i)
        end do
    end subroutine find_zones_between

    !> Lowest point and load of a patch.
    pure subroutine find_load(curve, zone)
        type(gap_curve_t), intent(in) :: curve
        type(analyn_zone_t), intent(inout) :: zone

        real(wp) :: h, h_from, h_to, inv2r, reach, left, square, p0
        integer :: i, side

        call gap_at(curve, zone%y_from, h_from, inv2r)
        call gap_at(curve, zone%y_to, h_to, inv2r)
        call lowest_between(curve, zone%y_from, h_from, zone%y_to, h_to, zone%y_low, h)
        zone%load = 0.0_wp
        do side = -1, 1, 2
            reach = merge(zone%y_to - zone%y_low, zone%y_low - zone%y_from, side > 0)
            do i = 1, size(gauss_place)
                call zone%row(curve, zone%y_low + side*reach*gauss_place(i), left, square, p0)
                zone%load = zone%load + 0.5_wp*pi*gauss_weight(i)*reach*p0*sqrt(square)
            end do
        end do
    end subroutine find_load

    !> Length and pressure at one y; see `zone_t`.
    pure subroutine analyn_row(zone, curve, y, left, square, p0)
        class(analyn_zone_t), intent(in) :: zone !! its penetration counts, not its ends
        type(gap_curve_t), intent(in) :: curve   !! the gap
        real(wp), intent(in) :: y                !! mm
        real(wp), intent(out) :: left            !! d, mm
        real(wp), intent(out) :: square          !! half-length squared, mm2
        real(wp), intent(out) :: p0              !! MPa

        real(wp) :: h, inv2r, log_ratio, axes, k, s, short
        logical :: found

        call gap_at(curve, y, h, inv2r)
        log_ratio = log_ratio_at(curve, zone%least, y, inv2r)
        axes = max(zone%axes + (abs(log_ratio) - zone%log_ratio)/usual_slope, 0.0_wp)
        call hertz_shape(1.0_wp, exp(abs(log_ratio)), axes, k, s, found)
        ! 1/(1 + alpha) = 1/2 + s, 1/(1 + beta) = 1/2 - s, s below 0 where B is less than A.
        short = 0.5_wp - s
        if (log_ratio < 0.0_wp) s = -s
        left = zone%depth - (h - zone%h_low)/(0.5_wp - s)
        square = max(left, 0.0_wp)*(0.5_wp + s)/inv2r
        ! pmax = d/(pi H K S), A_S S^2 = (1/2 - |s|) d
        p0 = sqrt(max(left, 0.0_wp)*inv2r*exp(max(log_ratio, 0.0_wp))/short) &
             /(pi*zone%compliance*k)
    end subroutine analyn_row

    !> ln(B/A) at one y.
    pure real(wp) function log_ratio_at(curve, least, y, inv2r) result(log_ratio)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: least, y, inv2r

        log_ratio = log(max(gap_curvature(curve, y)/inv2r, min(least/inv2r, least_ratio)))
    end function log_ratio_at
end module faststrip_normal_simple_analyn
