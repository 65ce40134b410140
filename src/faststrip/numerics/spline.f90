!> Cubic interpolation through points with increasing abscissae.
!>
!> Both kinds are kept the same way, as a slope at every knot, so that one evaluation serves
!> both: between two knots the curve is the cubic with the two values and the two slopes.
module faststrip_numerics_spline
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, count_text, &
                                     st_bad_argument, st_linear_algebra, st_not_finite, &
                                     st_not_increasing, st_too_few_points, st_workspace_too_small
    implicit none
    private

    public :: spline_setup, spline_value, spline_work_size, cubic_value, interval_of, widen_by_cubic
    public :: spline_not_a_knot, spline_monotone
    public :: check_points, find_secants, not_a_knot_slopes, monotone_slopes

    !> Twice continuously differentiable; the third derivative does not jump at the second and
    !> the last but one knot (not-a-knot).
    !> Given: numbers of kinds.
    integer, parameter :: spline_not_a_knot = 1

    !> Once continuously differentiable, without overshoot: monotone between two points, extrema
    !> only at points (Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980); slopes by the weighted
    !> harmonic mean of Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984)).
    !> Given: numbers of kinds.
    integer, parameter :: spline_monotone = 2

contains

    ! Numbers beyond `largest_size`, and knots nearer to each other than its inverse, are refused:
    ! with them no intermediate result can overflow.

    !> Length of the workspace `spline_setup` needs for n points.
    pure integer function spline_work_size(n)
        integer, intent(in) :: n !! number of points

        spline_work_size = 3*max(n, 1)
    end function spline_work_size

    !> Slopes at the knots of the interpolating curve.
    !>
    !> Two points give a straight line, three a parabola (not-a-knot). On an error the slopes are
    !> zero.
    pure subroutine spline_setup(x, y, kind, slopes, work, status)
        real(wp), intent(in) :: x(:)          !! knots, strictly increasing, at least 2
        real(wp), intent(in) :: y(:)          !! values at the knots, as many
        integer, intent(in) :: kind           !! `spline_not_a_knot` or `spline_monotone`
        real(wp), intent(out) :: slopes(:)    !! dy/dx at the knots, as many
        real(wp), intent(inout) :: work(:)    !! at least `spline_work_size(size(x))` long
        type(status_t), intent(out) :: status !! `st_bad_argument`, `st_too_few_points`,
                                              !! `st_not_finite`, `st_not_increasing`,
                                              !! `st_workspace_too_small`, `st_linear_algebra`
        integer :: n

        slopes = 0.0_wp
        n = size(x)
        call check_points(x, y, status)
        if (status%code /= 0) return
        if (size(slopes) /= n) then
            call set_status(status, st_bad_argument, 'spline: as many slopes as knots needed')
            return
        end if
        if (size(work) < spline_work_size(n)) then
            call set_status(status, st_workspace_too_small, 'spline: the workspace is too small')
            return
        end if
        call find_secants(n, x, y, work(:n))
        select case (kind)
        case (spline_not_a_knot)
            call not_a_knot_slopes(n, x, work(:n), slopes, work(n + 1:2*n), &
                                   work(2*n + 1:3*n), status)
        case (spline_monotone)
            call monotone_slopes(n, x, work(:n), slopes)
        case default
            call set_status(status, st_bad_argument, 'spline: unknown kind')
        end select
    end subroutine spline_setup

    !> Refuse points that no curve is drawn through.
    pure subroutine check_points(x, y, status)
        real(wp), intent(in) :: x(:)          !! knots
        real(wp), intent(in) :: y(:)          !! values
        type(status_t), intent(out) :: status !! those of `spline_setup` about them
        integer :: i

        call clear_status(status)
        if (size(y) /= size(x)) then
            call set_status(status, st_bad_argument, 'spline: as many values as knots needed')
            return
        end if
        if (size(x) < 2) then
            call set_status(status, st_too_few_points, 'spline: there must be at least 2 ' &
                            // 'points, got ' // count_text(size(x)))
            return
        end if
        do i = 1, size(x)
            if (.not. (ieee_is_finite(x(i)) .and. ieee_is_finite(y(i)))) then
                call set_status(status, st_not_finite, 'spline: points must be finite, got (' // &
                                trim(number_text(x(i))) // ', ' // trim(number_text(y(i))) // ')')
                return
            end if
            if (max(abs(x(i)), abs(y(i))) > largest_size) then
                call set_status(status, st_bad_argument, &
                                'spline: points must be within 1e30, got (' // &
                                trim(number_text(x(i))) // ', ' // trim(number_text(y(i))) // ')')
                return
            end if
        end do
        do i = 2, size(x)
            if (x(i) - x(i - 1) < 1.0_wp/largest_size) then
                call set_status(status, st_not_increasing, &
                                'spline: knots must ascend, got ' // &
                                trim(number_text(x(i))))
                return
            end if
        end do
    end subroutine check_points

    !> The slopes of the chords between neighbours.
    pure subroutine find_secants(n, x, y, secants)
        integer, intent(in) :: n                !! number of knots, at least 2
        real(wp), intent(in) :: x(n), y(n)      !! knots, strictly increasing, and values
        real(wp), intent(inout) :: secants(n)   !! of each interval; the last has no meaning

        integer :: i

        do i = 1, n - 1
            secants(i) = (y(i + 1) - y(i))/(x(i + 1) - x(i))
        end do
    end subroutine find_secants

    !> The slopes that make the second derivative continuous (de Boor, A Practical Guide to
    !> Splines, ch. IV): a tridiagonal system, its first and last row from not-a-knot. Rows are
    !> scaled by the sum of the two intervals, so that the diagonal is of order one and its own
    !> pivot.
    pure subroutine not_a_knot_slopes(n, x, secants, slopes, upper, pivots, status)
        integer, intent(in) :: n                !! number of knots, at least 2
        real(wp), intent(in) :: x(n)            !! knots, strictly increasing
        real(wp), intent(in) :: secants(n)      !! of `find_secants`
        real(wp), intent(inout) :: slopes(n)    !! at the knots
        real(wp), intent(inout) :: upper(n), pivots(n) !! workspace
        type(status_t), intent(inout) :: status !! gets `st_linear_algebra`

        real(wp) :: a, b, pivot, factor
        integer :: i

        if (n == 2) then
            slopes(:2) = secants(1)
            return
        else if (n == 3) then
            a = (x(2) - x(1))/(x(3) - x(1))
            slopes(2) = (1.0_wp - a)*secants(1) + a*secants(2)
            slopes(1) = 2.0_wp*secants(1) - slopes(2)
            slopes(3) = 2.0_wp*secants(2) - slopes(2)
            return
        end if
        a = (x(2) - x(1))/(x(3) - x(1))
        b = (x(3) - x(2))/(x(3) - x(1))
        pivot = b
        pivots(1) = b
        upper(1) = 1.0_wp
        slopes(1) = (2.0_wp + a)*b*secants(1) + a**2*secants(2)
        do i = 2, n - 1
            a = (x(i) - x(i - 1))/(x(i + 1) - x(i - 1))
            b = (x(i + 1) - x(i))/(x(i + 1) - x(i - 1))
            factor = b/pivot
            pivot = 2.0_wp - factor*upper(i - 1)
            pivots(i) = pivot
            upper(i) = a
            slopes(i) = 3.0_wp*(b*secants(i - 1) + a*secants(i)) - factor*slopes(i - 1)
        end do
        factor = 1.0_wp/pivot
        pivot = a - factor*a
        if (.not. abs(pivot) > 0.0_wp) then
            slopes = 0.0_wp
            call set_status(status, st_linear_algebra, 'spline: the system is singular')
            return
        end if
        slopes(n) = ((2.0_wp + b)*a*secants(n - 1) + b**2*secants(n - 2) &
                     - factor*slopes(n - 1))/pivot
        do i = n - 1, 1, -1
            slopes(i) = (slopes(i) - upper(i)*slopes(i + 1))/pivots(i)
        end do
    end subroutine not_a_knot_slopes

    !> The slopes of a curve that is monotone between two points.
    pure subroutine monotone_slopes(n, x, secants, slopes)
        integer, intent(in) :: n             !! number of knots, at least 2
        real(wp), intent(in) :: x(n)         !! knots, strictly increasing
        real(wp), intent(in) :: secants(n)   !! of `find_secants`
        real(wp), intent(inout) :: slopes(n) !! at the knots

        real(wp) :: h_left, h_right, left, right
        integer :: i

        if (n == 2) slopes(:2) = secants(1)
        do i = 2, n - 1
            h_left = x(i) - x(i - 1)
            h_right = x(i + 1) - x(i)
            left = secants(i - 1)
            right = secants(i)
            if (sign(1.0_wp, left) /= sign(1.0_wp, right) &
                .or. min(abs(left), abs(right)) <= 0.0_wp) then
                slopes(i) = 0.0_wp
            else if (abs(left) < abs(right)) then
                ! (w1 + w2)/(w1/left + w2/right), written so that nothing small is inverted
                slopes(i) = left*(3.0_wp*(h_left + h_right) &
                                  /((h_left + 2.0_wp*h_right) &
                                    + (2.0_wp*h_left + h_right)*(left/right)))
            else
                slopes(i) = right*(3.0_wp*(h_left + h_right) &
                                   /((2.0_wp*h_left + h_right) &
                                     + (h_left + 2.0_wp*h_right)*(right/left)))
            end if
            if (i == 2) slopes(1) = end_slope(h_left, h_right, left, right)
            if (i == n - 1) slopes(n) = end_slope(h_right, h_left, right, left)
        end do
    end subroutine monotone_slopes

    ! One-sided three-point slope, limited to the sign and to three times the first secant.
    pure real(wp) function end_slope(h_near, h_far, near, far) result(slope)
        real(wp), intent(in) :: h_near, h_far, near, far

        slope = near + h_near/(h_near + h_far)*(near - far)
        if (sign(1.0_wp, slope) /= sign(1.0_wp, near)) then
            slope = 0.0_wp
        else if (sign(1.0_wp, near) /= sign(1.0_wp, far) .and. abs(slope) > 3.0_wp*abs(near)) then
            slope = 3.0_wp*near
        end if
    end function end_slope

    !> Value and first two derivatives of the curve at one place.
    !>
    !> Outside the knots the curve goes on as the straight line with the slope of the end knot
    !> (second derivative zero): callers for whom that is no answer check the range. A place that
    !> is not finite or beyond 1e30 gives NaN. At a knot the second derivative is that of the
    !> interval to the right (of the last interval at the last knot).
    pure subroutine spline_value(x, y, slopes, at, value, d1, d2)
        real(wp), intent(in) :: x(:)      !! knots as given to `spline_setup`
        real(wp), intent(in) :: y(:)      !! values at the knots
        real(wp), intent(in) :: slopes(:) !! slopes at the knots from `spline_setup`
        real(wp), intent(in) :: at        !! where
        real(wp), intent(out) :: value    !! the curve there
        real(wp), intent(out) :: d1       !! its first derivative
        real(wp), intent(out) :: d2       !! its second derivative
        integer :: i, n

        n = size(x)
        if (.not. ieee_is_finite(at)) then
            value = ieee_value(value, ieee_quiet_nan)
            d1 = value
            d2 = value
        else if (abs(at) > largest_size) then
            value = ieee_value(value, ieee_quiet_nan)
            d1 = value
            d2 = value
        else if (at < x(1)) then
            value = y(1) + slopes(1)*(at - x(1))
            d1 = slopes(1)
            d2 = 0.0_wp
        else if (at > x(n)) then
            value = y(n) + slopes(n)*(at - x(n))
            d1 = slopes(n)
            d2 = 0.0_wp
        else
            i = interval_of(x, at)
            call cubic_value(y(i:i + 1), slopes(i:i + 1), x(i + 1) - x(i), at - x(i), value, d1, d2)
        end if
    end subroutine spline_value

    !> A cubic with given values and slopes at both ends.
    pure subroutine cubic_value(ends, slopes, h, t, value, d1, d2)
        real(wp), intent(in) :: ends(2)   !! values at the ends
        real(wp), intent(in) :: slopes(2) !! slopes there
        real(wp), intent(in) :: h         !! width, above 0
        real(wp), intent(in) :: t         !! place from the first end on
        real(wp), intent(out) :: value    !! there
        real(wp), intent(out) :: d1       !! first derivative
        real(wp), intent(out) :: d2       !! second derivative

        real(wp) :: secant, c2, c3

        secant = (ends(2) - ends(1))/h
        c2 = (3.0_wp*secant - 2.0_wp*slopes(1) - slopes(2))/h
        c3 = (slopes(1) + slopes(2) - 2.0_wp*secant)/h**2
        value = ends(1) + t*(slopes(1) + t*(c2 + t*c3))
        d1 = slopes(1) + t*(2.0_wp*c2 + 3.0_wp*t*c3)
        d2 = 2.0_wp*c2 + 6.0_wp*t*c3 ! Given: second derivative of a cubic
    end subroutine cubic_value

    !> Widen bounds so that a cubic lies within them between two places: it does within those of its
    !> control points (Farin, Curves and Surfaces for CAGD, ch. 5).
    pure subroutine widen_by_cubic(ends, slopes, h, t, bounds)
        real(wp), intent(in) :: ends(2)      !! values at the ends
        real(wp), intent(in) :: slopes(2)    !! slopes there
        real(wp), intent(in) :: h            !! width, above 0
        real(wp), intent(in) :: t(2)         !! places from the first end on, the second not before
        real(wp), intent(inout) :: bounds(2) !! the smaller and the larger one

        real(wp) :: values(4), d1(2), d2
        integer :: i

        do i = 1, 2
            call cubic_value(ends, slopes, h, t(i), values(i), d1(i), d2)
        end do
        values(3:) = values(:2) + [d1(1), -d1(2)]*(t(2) - t(1))/3.0_wp
        bounds = [min(bounds(1), minval(values)), max(bounds(2), maxval(values))]
    end subroutine widen_by_cubic

    !> The interval [x(i), x(i+1)) that holds a place between the first and the last knot.
    pure integer function interval_of(x, at) result(i)
        real(wp), intent(in) :: x(:) !! knots, increasing, at least 2
        real(wp), intent(in) :: at   !! the place

        integer :: upper, middle

        i = 1
        upper = size(x)
        do while (upper - i > 1)
            middle = i + (upper - i)/2
            if (at < x(middle)) then
                upper = middle
            else
                i = middle
            end if
        end do
    end function interval_of
end module faststrip_numerics_spline
