!> Heights of the gap that a strip does not resolve, as the pressure they cause.
!>
!> A strip knows the gap on its own middle line. Between the middles of its neighbours lie points
!> of the gap whose heights differ from any smooth curve: noise of a measurement, ripples, a kink.
!> What they differ by, d(y), is the same all along the strip, so that the half-space is in plane
!> strain there, and the pressure that closes it is
!>
!>     p(y) = -1/(pi^2 H) int [d(y) - d(y')]/(y - y')^2 dy',
!>
!> (K.L. Johnson, Contact Mechanics, 1985, section 2.3: a wave of amplitude d and wave number c
!> takes c d/(pi H)). The smooth curve is the polynomial through nodes that the caller names: what
!> the strip and its neighbours know of the gap.
module faststrip_normal_estimate_unresolved
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, first_point_from
    implicit none
    private

    public :: unresolved_pressure, most_nodes

    !> Points of the gap looked at together, even; of more, so many evenly spread ones, which tell
    !> of long waves, and as many neighbours in the middle, which tell of short ones.
    !> Tuned [points]. Origin: cost; four times as many tell no more of random gaps.
    integer, parameter :: most_points = 24

    !> Most nodes of a smooth curve.
    !> Tuned [points]. Origin: middles of a strip and its neighbours, and its edges.
    integer, parameter :: most_nodes = 5

    ! Of n even points the integral is below the largest |d| over their spacing, times this.
    ! Given: 4 (1 + 1/4 + 1/9 + ...) and what lies beyond the last ones.
    real(wp), parameter :: largest_sum = 8.0_wp

contains

    !> The maximum pressure in a strip that unresolved heights of the gap ask for, MPa; not
    !> negative. Zero where fewer than three points of the gap lie between the nodes, or where it is
    !> sure to be less than `least`.
    pure real(wp) function unresolved_pressure(curve, compliance, y_left, y_right, node, least) &
        result(pressure)
        type(gap_curve_t), intent(in) :: curve    !! the gap that was solved, mm
        real(wp), intent(in) :: compliance        !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: y_left, y_right   !! edges of the strip, mm
        real(wp), intent(in) :: node(:)
            !! where the smooth curve meets the gap, all different, at most `most_nodes`, mm
        real(wp), intent(in), optional :: least   !! that counts, MPa; otherwise all

        real(wp) :: coefficient(most_nodes), counts
        integer :: from, to, n, m, i, point(most_points)

        from = first_point_from(curve, minval(node))
        to = first_point_from(curve, maxval(node))
        if (curve%y(min(to, curve%n)) > maxval(node) .or. to > curve%n) to = to - 1
        pressure = 0.0_wp
        if (to - from < 2) return
        counts = 0.0_wp
        if (present(least)) counts = least*(pi**2*compliance)
        call divide_differences(curve, node, coefficient(:size(node)))
        n = to - from + 1
        if (n <= most_points) then
            do i = 1, n
                point(i) = from + i - 1
            end do
            pressure = response(point(:n), .true.)
        else
            ! Counted from both ends, and as many before the middle as behind it: a mirrored gap
            ! is looked at in the same points.
            do i = 1, most_points/2
                point(i) = from + ((i - 1)*(n - 1))/(most_points - 1)
                point(most_points + 1 - i) = to - (point(i) - from)
            end do
            pressure = response(point, .true.)
            m = most_points - modulo(n, 2)
            do i = 1, m
                point(i) = (from + to - m + 1)/2 + i - 1
            end do
            pressure = max(pressure, response(point(:m), .false.))
        end if
        pressure = pressure/(pi**2*compliance)

    contains

        !> The largest of minus the integral at the given points of the gap that lie in the strip;
        !> at least zero. If these are all there are nothing differs beyond them. If not it differs
        !> by as much as at the point itself, and the points near the first and the last one, which
        !> have neighbours on one side, are left out.
        pure real(wp) function response(point, are_all) result(largest)
            integer, intent(in) :: point(:)  ! at least three, ascending
            logical, intent(in) :: are_all   ! that lie between the nodes

            real(wp), dimension(most_points) :: y, d, share, smooth
            real(wp) :: total
            integer :: i, j, m, margin

            m = size(point)
            do i = 1, m
                y(i) = curve%y(point(i))
                d(i) = curve%h(point(i))
            end do
            smooth(:m) = coefficient(size(node))
            do j = size(node) - 1, 1, -1
                do i = 1, m
                    smooth(i) = coefficient(j) + (y(i) - node(j))*smooth(i)
                end do
            end do
            d(:m) = d(:m) - smooth(:m)
            share(1) = 0.5_wp*(y(2) - y(1))
            share(m) = 0.5_wp*(y(m) - y(m - 1))
            share(2:m - 1) = 0.5_wp*(y(3:m) - y(1:m - 2))
            largest = 0.0_wp
            if (largest_sum*maxval(abs(d(:m))) < counts*minval(share(2:m - 1))) return
            margin = merge(0, m/4, are_all)
            do i = 1 + margin, m - margin
                if (y(i) < y_left .or. y(i) > y_right) cycle
                total = 0.0_wp
                if (are_all) total = d(i)/(y(i) - y(1) + share(1)) + d(i)/(y(m) - y(i) + share(m))
                do j = 1, m
                    if (j /= i) total = total + share(j)*(d(i) - d(j))/(y(i) - y(j))**2
                end do
                largest = max(largest, -total)
            end do
        end function response
    end function unresolved_pressure

    !> Newton's divided differences of the gap's heights at the nodes.
    pure subroutine divide_differences(curve, node, coefficient)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: node(:)
        real(wp), intent(out) :: coefficient(:)

        real(wp) :: inv2r
        integer :: i, j

        do i = 1, size(node)
            call gap_at(curve, node(i), coefficient(i), inv2r)
        end do
        do j = 2, size(node)
            do i = size(node), j, -1
                coefficient(i) = (coefficient(i) - coefficient(i - 1))/(node(i) - node(i - j + 1))
            end do
        end do
    end subroutine divide_differences
end module faststrip_normal_estimate_unresolved
