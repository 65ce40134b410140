!> Pressures beyond those of the strips where the longitudinal term A = 1/(2R) varies along y.
!>
!> A strip knows A in its own middle, and takes its pressure for a semi-ellipse along x. Two things
!> escape it:
!>
!> - *Locally.* In strips that are short beside their width the contact is one of plane strain
!>   along x, whose line load hardly changes along y. Its maximum pressure goes with sqrt(A), so
!>   that A above the line through the middles of the strips means a pressure above theirs. In
!>   long strips A moves the tips and leaves the pressure on the centre line alone: 1/(1 + xd/w).
!> - *Off the centre line.* At x the gap differs from the centre line's by A(y) x^2. A strip whose
!>   A is much smaller than that of its neighbours is long, and at x beyond their tips it stands
!>   out of the surface: it has an edge there, with a pressure that may exceed that of the centre
!>   line by much. It is in plane strain along y with
!>
!>       p(x) = 1/(pi^2 H) int min([A(y') - A(y)] x^2, u(x, y))/(y' - y)^2 dy',
!>
!>   as in `faststrip_normal_estimate_unresolved`. Where A is larger the surface falls back behind
!>   the gap and is free, but never by more than it was pressed in, u = D - h - A x^2: pressures
!>   press in all around them.
module faststrip_normal_estimate_longitudinal
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, first_point_from
    use faststrip_normal_strip_state, only: flattest
    implicit none
    private

    public :: inv2r_samples_t, inv2r_range, local_rise, off_centre_pressure

    !> A about a strip, 1/mm; at an end of the patch the strip's own stands for its neighbour's.
    type :: inv2r_samples_t
        real(wp) :: before = 0.0_wp !! in the middle of the strip before
        real(wp) :: left = 0.0_wp   !! at the left edge
        real(wp) :: middle = 0.0_wp !! in the middle
        real(wp) :: right = 0.0_wp  !! at the right edge
        real(wp) :: behind = 0.0_wp !! in the middle of the strip behind
    end type inv2r_samples_t

    ! Points of the gap looked at in a strip and in all of the contact, even; of more, so many
    ! evenly spread ones.
    ! Tuned [points]. Origin: cost.
    integer, parameter :: most_points = 32, most_of_contact = 128

    ! Where the pressure off the centre line is looked for, over the half-length.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: places(3) = [0.5_wp, 0.7_wp, 0.9_wp]

    ! Share of the pressure above that counts: u is an upper bound, as the free surface stays
    ! pressed in somewhat. With 0.5 to 0.7 random gaps whose A falls by steps are told from those
    ! whose maximum pressure stays on the centre line; with 0.25 the half is missed, with 1
    ! exponential ones are taken for them.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: off_centre_share = 0.6_wp

    ! The integral: distances from a quarter of the width, below which the bracket is a parabola,
    ! to a half-length, as neighbours beyond that do not matter, in cells of a constant ratio.
    ! Tuned [strip widths]. Origin: chosen.
    real(wp), parameter :: nearest = 0.25_wp
    ! Tuned [cells]: Number. Origin: chosen.
    integer, parameter :: cells = 10

    ! The same, with A's bracket at its largest everywhere: distances of less than a width give
    ! 2*(4 + 3)/w, those beyond 2/w.
    ! Given: follows from the bracket.
    real(wp), parameter :: near_bound = 14.0_wp, far_bound = 2.0_wp

contains

    !> By how much A varies in a stretch of the gap, as far as its points tell, 1/mm.
    pure real(wp) function inv2r_range(curve, y_from, y_to) result(width)
        type(gap_curve_t), intent(in) :: curve  !! the gap that was solved
        real(wp), intent(in) :: y_from, y_to    !! the stretch, mm

        real(wp) :: low, high, inv2r
        integer :: from, n, i

        width = 0.0_wp
        call points_between(curve, y_from, y_to, from, n)
        if (n < 1) return
        low = usable(curve%inv2r(from))
        high = low
        do i = 1, min(n, most_of_contact)
            inv2r = usable(curve%inv2r(from + spread_evenly(i, n, most_of_contact)))
            low = min(low, inv2r)
            high = max(high, inv2r)
        end do
        width = max(high, curve%least_inv2r) - max(low, curve%least_inv2r)
    end function inv2r_range

    !> By how much the pressure somewhere on the centre line of a strip may be above its own,
    !> over its own, and by how much A varies in it and to its neighbours.
    pure subroutine local_rise(curve, y_left, y_right, half_length, inv2r, rise, variation)
        type(gap_curve_t), intent(in) :: curve        !! the gap that was solved
        real(wp), intent(in) :: y_left, y_right       !! edges of the strip, mm
        real(wp), intent(in) :: half_length           !! of the strip, mm
        type(inv2r_samples_t), intent(in) :: inv2r    !! A about the strip
        real(wp), intent(out) :: rise                 !! not negative
        real(wp), intent(out) :: variation            !! highest less lowest A, 1/mm

        real(wp) :: middle, low, high, ratio, to_left, to_right, here, line
        integer :: from, n, i, j

        middle = 0.5_wp*(y_left + y_right)
        low = min(inv2r%before, inv2r%left, inv2r%middle, inv2r%right, inv2r%behind)
        high = max(inv2r%before, inv2r%left, inv2r%middle, inv2r%right, inv2r%behind)
        ! Neighbours are about as wide.
        to_left = (inv2r%before - inv2r%middle)/(y_right - y_left)
        to_right = (inv2r%behind - inv2r%middle)/(y_right - y_left)
        ratio = max(1.0_wp, inv2r%left/(0.5_wp*(inv2r%before + inv2r%middle)), &
                    inv2r%right/(0.5_wp*(inv2r%behind + inv2r%middle)))
        call points_between(curve, y_left, y_right, from, n)
        do i = 1, min(n, most_points)
            j = from + spread_evenly(i, n, most_points)
            here = usable(max(curve%inv2r(j), curve%least_inv2r))
            low = min(low, here)
            high = max(high, here)
            if (curve%y(j) < middle) then
                line = inv2r%middle + to_left*(middle - curve%y(j))
            else
                line = inv2r%middle + to_right*(curve%y(j) - middle)
            end if
            if (here > ratio*line) ratio = here/line
        end do
        variation = high - low
        rise = (sqrt(ratio) - 1.0_wp)/(1.0_wp + half_length/(y_right - y_left))
    end subroutine local_rise

    !> The maximum pressure of a strip, on the centre line or off it, MPa. Where A varies so little
    !> that it cannot be off it, that is not looked for.
    pure real(wp) function off_centre_pressure(curve, compliance, depth, y_left, y_right, &
                                               y_from, y_to, half_length, p0, variation, &
                                               variation_of_all) result(pressure)
        type(gap_curve_t), intent(in) :: curve        !! the gap that was solved
        real(wp), intent(in) :: compliance            !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth                 !! penetration above the lowest gap, mm
        real(wp), intent(in) :: y_left, y_right       !! edges of the strip, mm
        real(wp), intent(in) :: y_from, y_to          !! ends of its patch, mm
        real(wp), intent(in) :: half_length           !! of the strip, mm
        real(wp), intent(in) :: p0                    !! its pressure on the centre line, MPa
        real(wp), intent(in) :: variation             !! of A about it, 1/mm
        real(wp), intent(in) :: variation_of_all      !! of A in the contact, 1/mm

        real(wp), dimension(size(places)) :: x_squared, free, response
        real(wp) :: width, middle, h, inv2r, there, reach, distance, ratio, weight, y, unused
        integer :: i, side

        pressure = p0
        width = y_right - y_left
        ! Semi-ellipse and parabola together stay below p0 where the parabola ends below p0/2.
        if (off_centre_share*(near_bound*variation + far_bound*variation_of_all)*half_length**2 &
            <= 0.5_wp*p0*(pi**2*compliance*width)) return
        middle = 0.5_wp*(y_left + y_right)
        call gap_at(curve, middle, h, inv2r)
        inv2r = usable(inv2r)
        x_squared = (places*half_length)**2
        free = max(depth - (h - curve%h_lowest) - inv2r*x_squared, 0.0_wp)
        reach = min(max(half_length, 2.0_wp*width), max(middle - y_from, y_to - middle))
        distance = nearest*width
        ratio = max(reach/distance, 2.0_wp)**(1.0_wp/cells)
        response = 0.0_wp
        do i = 0, cells
            if (i == 0) then
                weight = 1.0_wp/distance
                y = distance
            else
                weight = (1.0_wp - 1.0_wp/ratio)/distance
                y = distance*sqrt(ratio)
                distance = distance*ratio
            end if
            do side = -1, 1, 2
                if (middle + side*y < y_from .or. middle + side*y > y_to) cycle
                call gap_at(curve, middle + side*y, unused, there)
                response = response + weight*min((usable(there) - inv2r)*x_squared, free)
            end do
        end do
        pressure = max(p0, maxval(p0*sqrt(1.0_wp - places**2) &
                                  + off_centre_share*max(response, 0.0_wp)/(pi**2*compliance)))
    end function off_centre_pressure

    !> A as the strips' equations take it.
    pure real(wp) function usable(inv2r)
        real(wp), intent(in) :: inv2r

        usable = min(max(inv2r, flattest), largest_size)
    end function usable

    !> The first of the gap's points in a stretch, and how many there are.
    pure subroutine points_between(curve, y_from, y_to, from, n)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y_from, y_to
        integer, intent(out) :: from, n

        integer :: behind

        from = first_point_from(curve, y_from)
        behind = first_point_from(curve, y_to)
        if (behind <= curve%n) then
            if (.not. curve%y(behind) > y_to) behind = behind + 1
        end if
        n = behind - from
    end subroutine points_between

    !> Of n points all, or so many spread evenly: how far behind the first one number i is. Counted
    !> from both ends: a mirrored gap is looked at in the same points.
    pure integer function spread_evenly(i, n, most) result(offset)
        integer, intent(in) :: i, n, most

        if (n <= most) then
            offset = i - 1
        else if (i <= most/2) then
            offset = ((i - 1)*(n - 1))/(most - 1)
        else
            offset = n - 1 - ((most - i)*(n - 1))/(most - 1)
        end if
    end function spread_evenly
end module faststrip_normal_estimate_longitudinal
