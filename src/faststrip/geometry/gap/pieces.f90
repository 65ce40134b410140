!> A curve of cubics cut into monotone pieces, so that its level sets are found exactly.
module faststrip_geometry_gap_pieces
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_torn_spline, only: tame_interval
    implicit none
    private

    public :: cut_into_pieces, find_lowest

    ! Where the slopes at both ends of an interval differ from that of its chord by less than this
    ! part of it, the cubic is monotone (Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980)).
    ! Tuned [1]. Origin: below 1 by many roundings.
    real(wp), parameter :: surely_monotone = 0.999_wp

contains

    !> Cut a curve of cubics into monotone pieces. Where the curve swings between two points it is
    !> tamed before (`tame_interval`), which changes its slopes.
    pure subroutine cut_into_pieces(n, y, h, bend, slope_from, slope_to, work, y_node, h_node, &
                                    n_pieces)
        integer, intent(in) :: n                  !! number of points
        real(wp), intent(in) :: y(n), h(n)        !! points, mm
        real(wp), intent(in) :: bend(n)           !! h'' at the points, 1/mm
        real(wp), intent(inout) :: slope_from(n)  !! h' of interval i at point i
        real(wp), intent(inout) :: slope_to(n)    !! h' of interval i at point i + 1
        real(wp), intent(inout) :: work(n)        !! workspace
        real(wp), intent(inout) :: y_node(3*n), h_node(3*n) !! ends of the pieces, mm; the first
                                                  !! `n_pieces + 1` count
        integer, intent(out) :: n_pieces          !! at most three per interval

        real(wp) :: dy, rise, root(2), extremum(2)
        integer :: i, j, m, n_roots
        logical :: is_tamed

        do i = 1, n - 1
            dy = y(i + 1) - y(i)
            rise = h(i + 1) - h(i)
            work(i) = max(abs(slope_from(i)*dy - rise), abs(slope_to(i)*dy - rise)) &
                      - surely_monotone*abs(rise)
        end do
        m = 1
        y_node(1) = y(1)
        h_node(1) = h(1)
        do i = 1, n - 1
            if (work(i) >= 0.0_wp) then
                dy = y(i + 1) - y(i)
                call find_extrema(dy, h(i:i + 1), slope_from(i), slope_to(i), n_roots, root, &
                                  extremum)
                if (n_roots > 0) then
                    call tame_interval(i, y, h, bend, minval(extremum(:n_roots)), &
                                       maxval(extremum(:n_roots)), slope_from(i), slope_to(i), &
                                       is_tamed)
                    if (is_tamed) call find_extrema(dy, h(i:i + 1), slope_from(i), slope_to(i), &
                                                    n_roots, root, extremum)
                end if
                do j = 1, n_roots
                    m = m + 1
                    y_node(m) = y(i) + root(j)*dy
                    h_node(m) = extremum(j)
                end do
            end if
            m = m + 1
            y_node(m) = y(i + 1)
            h_node(m) = h(i + 1)
        end do
        n_pieces = m - 1
    end subroutine cut_into_pieces

    !> The lowest end of a piece.
    pure subroutine find_lowest(y_node, h_node, y, h)
        real(wp), intent(in) :: y_node(:), h_node(:) !! ends of the pieces, mm
        real(wp), intent(out) :: y, h                !! its place and height, mm

        integer :: i, j

        h = h_node(1)
        do i = 2, size(h_node)
            h = min(h, h_node(i))
        end do
        i = findloc(h_node, h, dim=1)
        ! The middle of a flat place, as seen from either side.
        j = i
        do while (j < size(h_node))
            if (h_node(j + 1) > h) exit
            j = j + 1
        end do
        y = y_node(i)
        if (j > i) y = 0.5_wp*(y_node(i) + y_node(j))
    end subroutine find_lowest

    !> Places and heights of the extrema inside an interval.
    pure subroutine find_extrema(dy, h, slope_from, slope_to, n, root, extremum)
        real(wp), intent(in) :: dy, h(2)             ! length and heights of the interval, mm
        real(wp), intent(in) :: slope_from, slope_to ! at its ends
        integer, intent(out) :: n
        real(wp), intent(out) :: root(2), extremum(2) ! in 0 to 1; mm

        real(wp) :: c1, c2, c3, secant

        secant = h(2) - h(1)
        c1 = slope_from*dy
        c3 = (slope_from + slope_to)*dy - 2.0_wp*secant
        c2 = secant - c1 - c3
        call unit_interval_roots(3.0_wp*c3, 2.0_wp*c2, c1, n, root)
        extremum = h(1) + root*(c1 + root*(c2 + root*c3))
    end subroutine find_extrema

    !> Roots of a t^2 + b t + c strictly inside (0, 1), ascending.
    pure subroutine unit_interval_roots(a, b, c, n, root)
        real(wp), intent(in) :: a, b, c
        integer, intent(out) :: n
        real(wp), intent(out) :: root(2)

        real(wp) :: discriminant, q, candidate(2)
        integer :: i

        n = 0
        root = 0.0_wp
        candidate = -1.0_wp
        discriminant = b*b - 4.0_wp*a*c
        if (discriminant <= 0.0_wp) return
        q = -0.5_wp*(b + sign(sqrt(discriminant), b))
        ! A quotient above one is no root inside; tested before dividing, which could overflow.
        if (abs(q) < abs(a)) candidate(1) = q/a
        if (abs(c) < abs(q)) candidate(2) = c/q
        if (candidate(1) > candidate(2)) candidate = [candidate(2), candidate(1)]
        do i = 1, 2
            if (candidate(i) <= 0.0_wp .or. candidate(i) >= 1.0_wp) cycle
            n = n + 1
            root(n) = candidate(i)
        end do
    end subroutine unit_interval_roots
end module faststrip_geometry_gap_pieces
