!> A profile through points as a curve by arc length, evaluated as z(y) where y increases.
!>
!> Both coordinates are cubic splines of the length of the chords, so that a flank as steep as the
!> gauge face of a rail is as smooth as its crown; a spline z(y) has no third derivative there.
!> Where the points turn by more than an angle in one place there is a kink: the splines end on it
!> and begin anew.
module faststrip_geometry_arc_spline
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_halvings
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, st_too_few_points, st_not_increasing, &
                                     st_not_finite, st_bad_argument
    use faststrip_geometry_touchable, only: upright
    use faststrip_numerics_spline, only: spline_setup, spline_work_size, spline_not_a_knot, &
                                         cubic_value, interval_of, widen_by_cubic
    implicit none
    private

    public :: arc_spline_t, make_arc_spline, arc_spline_at, arc_spline_bounds, find_kinks, &
              chord_lengths, standard_kink_angle, fewest_points

    !> Turn of a profile within one point from which it is a kink, rad.
    !> Tuned [rad]: 20 degrees. Origin: points 2 mm apart on the gauge corner R13 turn by 9 degrees.
    real(wp), parameter :: standard_kink_angle = pi/9.0_wp

    ! The directions on both sides of a kink are those of stretches as long as this.
    ! Tuned [mm]. Origin: noise of 10 um turns them by less than 2 degrees.
    real(wp), parameter :: stretch = 0.5_wp

    !> Fewest points of a profile.
    !> Given: as few as a cubic has coefficients, and one more.
    integer, parameter :: fewest_points = 5

    ! Bounds of dy/ds over the mean of its interval: y stays increasing.
    ! Given: Fritsch and Carlson (1980): up to three times is monotone.
    real(wp), parameter :: steepest = 3.0_wp
    ! The lower of them: nowhere within an interval of even slope is the curve upright.
    real(wp), parameter :: flattest = 1.0_wp/upright

    !> The points and the derivatives of both coordinates at both ends of each interval.
    type :: arc_spline_t
        real(wp), allocatable :: y(:)         !! strictly increasing, mm
        real(wp), allocatable :: z(:)         !! depth, mm
        real(wp), allocatable :: s(:)         !! length of the chords from the first point, mm
        real(wp), allocatable :: y_from(:), y_to(:) !! dy/ds at the ends of interval i
        real(wp), allocatable :: z_from(:), z_to(:) !! dz/ds there
        logical, allocatable :: is_kink(:)    !! is there a kink at the point?
    end type arc_spline_t

contains

    !> The curve through points whose y increases.
    subroutine make_arc_spline(y, z, kink_angle, curve, status)
        real(wp), intent(in) :: y(:)              !! strictly increasing, mm
        real(wp), intent(in) :: z(:)              !! depth at y, mm, as many
        real(wp), intent(in) :: kink_angle        !! turn from which a point is a kink, above 0, rad
        type(arc_spline_t), intent(out) :: curve  !! ready for `arc_spline_at`
        type(status_t), intent(out) :: status     !! `st_too_few_points`, `st_not_finite`,
                                                  !! `st_not_increasing`, `st_bad_argument`,
                                                  !! `st_linear_algebra`

        real(wp), allocatable :: slopes(:), work(:)
        integer :: n, first, last

        n = size(y)
        call check_points(y, z, kink_angle, status)
        if (is_error(status)) return
        curve%y = y
        curve%z = z
        allocate (curve%s(n), slopes(n), work(spline_work_size(n)), source=0.0_wp)
        allocate (curve%y_from(n), curve%y_to(n), curve%z_from(n), curve%z_to(n), source=0.0_wp)
        allocate (curve%is_kink(n), source=.false.)
        call chord_lengths(y, z, curve%s, status)
        if (is_error(status)) return
        call find_kinks(y, z, kink_angle, curve%is_kink)
        last = 1
        do while (last < n)
            first = last
            last = first + 1
            do while (last < n .and. .not. curve%is_kink(last))
                last = last + 1
            end do
            call fit(y, curve%y_from, curve%y_to)
            if (is_error(status)) return
            call fit(z, curve%z_from, curve%z_to)
            if (is_error(status)) return
        end do
        call keep_increasing(curve)

    contains

        !> One coordinate of one stretch between two kinks.
        subroutine fit(values, from, to)
            real(wp), intent(in) :: values(:)
            real(wp), intent(inout) :: from(:), to(:)

            call spline_setup(curve%s(first:last), values(first:last), spline_not_a_knot, &
                              slopes(first:last), work, status)
            from(first:last - 1) = slopes(first:last - 1)
            to(first:last - 1) = slopes(first + 1:last)
        end subroutine fit
    end subroutine make_arc_spline

    subroutine check_points(y, z, kink_angle, status)
        real(wp), intent(in) :: y(:), z(:), kink_angle
        type(status_t), intent(out) :: status

        integer :: i
        logical :: valid

        call clear_status(status)
        valid = ieee_is_finite(kink_angle)
        if (valid) valid = kink_angle > 0.0_wp
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'the angle of a kink must be above 0, got ' &
                            //number_text(kink_angle))
        else if (size(y) < fewest_points .or. size(z) /= size(y)) then
            call set_status(status, st_too_few_points, 'a profile must have at least ' &
                            //trim(count_text(fewest_points))//' points that can be touched, got ' &
                            //count_text(size(y)))
        else if (.not. all(ieee_is_finite(y)) .or. .not. all(ieee_is_finite(z))) then
            call set_status(status, st_not_finite, 'points of a profile must be finite numbers')
        else
            do i = 2, size(y)
                if (y(i) > y(i - 1)) cycle
                call set_status(status, st_not_increasing, 'y of a profile must increase, got ' &
                                //trim(number_text(y(i)))//' after '//number_text(y(i - 1)))
                return
            end do
        end if
    end subroutine check_points

    !> Points in which a curve turns by more than an angle, and not on the way of an arc: the
    !> stretches of half a millimetre on both sides differ by as much.
    pure subroutine find_kinks(y, z, kink_angle, is_kink)
        real(wp), intent(in) :: y(:)          !! mm, along the curve
        real(wp), intent(in) :: z(:)          !! mm, as many
        real(wp), intent(in) :: kink_angle    !! rad
        logical, intent(out) :: is_kink(:)    !! as many; the ends are none

        integer :: i, before, after

        is_kink = .false.
        do i = 2, size(y) - 1
            if (turn(i - 1, i, i + 1) < kink_angle) cycle
            before = i - 1
            do while (before > 1 .and. hypot(y(i) - y(before), z(i) - z(before)) < stretch)
                before = before - 1
            end do
            after = i + 1
            do while (after < size(y) .and. hypot(y(after) - y(i), z(after) - z(i)) < stretch)
                after = after + 1
            end do
            is_kink(i) = turn(before, i, after) >= kink_angle
        end do

    contains

        !> By how much the curve turns at a point, from one chord to the next.
        pure real(wp) function turn(i, j, k)
            integer, intent(in) :: i, j, k

            real(wp) :: dy(2), dz(2)

            dy = [y(j) - y(i), y(k) - y(j)]
            dz = [z(j) - z(i), z(k) - z(j)]
            turn = abs(atan2(dy(1)*dz(2) - dy(2)*dz(1), dy(1)*dy(2) + dz(1)*dz(2)))
        end function turn
    end subroutine find_kinks

    !> Bound dy/ds so that y increases within every interval.
    pure subroutine keep_increasing(curve)
        type(arc_spline_t), intent(inout) :: curve

        real(wp) :: mean
        integer :: i

        do i = 1, size(curve%y) - 1
            mean = (curve%y(i + 1) - curve%y(i))/(curve%s(i + 1) - curve%s(i))
            curve%y_from(i) = min(max(curve%y_from(i), flattest*mean), steepest*mean)
            curve%y_to(i) = min(max(curve%y_to(i), flattest*mean), steepest*mean)
        end do
    end subroutine keep_increasing

    !> The depth at y and its first two derivatives.
    pure subroutine arc_spline_at(curve, y, z, dz, d2z, is_there)
        type(arc_spline_t), intent(in) :: curve !! from `make_arc_spline`
        real(wp), intent(in) :: y               !! lateral coordinate, mm
        real(wp), intent(out) :: z              !! depth, mm
        real(wp), intent(out) :: dz             !! slope dz/dy; at a kink that beyond it
        real(wp), intent(out) :: d2z            !! second derivative, 1/mm
        logical, intent(out) :: is_there        !! is y from the first to the last point? If not:
                                                !! all zero

        real(wp) :: t, h, value, y1, y2, z1, z2
        integer :: i

        z = 0.0_wp
        dz = 0.0_wp
        d2z = 0.0_wp
        is_there = ieee_is_finite(y) .and. allocated(curve%y)
        if (is_there) is_there = y >= curve%y(1) .and. y <= curve%y(size(curve%y))
        if (.not. is_there) return
        i = interval_of(curve%y, y)
        h = curve%s(i + 1) - curve%s(i)
        t = place_in(curve, i, h, y)
        call cubic_value(curve%y(i:i + 1), [curve%y_from(i), curve%y_to(i)], h, t, value, y1, y2)
        call cubic_value(curve%z(i:i + 1), [curve%z_from(i), curve%z_to(i)], h, t, z, z1, z2)
        dz = z1/y1
        d2z = (z2 - dz*y2)/y1**2
    end subroutine arc_spline_at

    !> Bounds of the depth between two places.
    pure function arc_spline_bounds(curve, from, to) result(bounds)
        type(arc_spline_t), intent(in) :: curve !! from `make_arc_spline`
        real(wp), intent(in) :: from  !! on the curve, mm
        real(wp), intent(in) :: to    !! the same, not before, mm
        real(wp) :: bounds(2)         !! z is from the first to the second one, mm

        real(wp) :: h, t(2)
        integer :: i, first, last

        bounds = [huge(1.0_wp), -huge(1.0_wp)]
        first = interval_of(curve%y, from)
        last = interval_of(curve%y, to)
        do i = first, last
            h = curve%s(i + 1) - curve%s(i)
            t = [0.0_wp, h]
            if (i == first) t(1) = place_in(curve, i, h, from)
            if (i == last) t(2) = place_in(curve, i, h, to)
            call widen_by_cubic(curve%z(i:i + 1), [curve%z_from(i), curve%z_to(i)], h, t, bounds)
        end do
    end function arc_spline_bounds

    !> The length within interval i at which it has a given y: Newton between halvings.
    pure real(wp) function place_in(curve, i, h, y) result(t)
        type(arc_spline_t), intent(in) :: curve
        integer, intent(in) :: i
        real(wp), intent(in) :: h, y

        real(wp) :: low, high, value, d1, d2, step
        integer :: k

        low = 0.0_wp
        high = h
        t = h*((y - curve%y(i))/(curve%y(i + 1) - curve%y(i)))
        do k = 1, most_halvings
            call cubic_value(curve%y(i:i + 1), [curve%y_from(i), curve%y_to(i)], h, t, value, d1, &
                             d2)
            if (value < y) then
                low = t
            else
                high = t
            end if
            step = 0.0_wp
            if (d1 > 0.0_wp) step = (y - value)/d1
            if (abs(step) <= spacing(h) .and. d1 > 0.0_wp) exit
            t = t + step
            if (.not. (t > low .and. t < high) .or. .not. d1 > 0.0_wp) t = 0.5_wp*(low + high)
            if (high - low <= spacing(h)) exit
        end do
    end function place_in

    !> Length of the chords from the first point on.
    pure subroutine chord_lengths(y, z, s, status)
        real(wp), intent(in) :: y(:), z(:)       !! points, mm, as many
        real(wp), intent(out) :: s(:)            !! lengths, mm, as many
        type(status_t), intent(inout) :: status  !! `st_not_increasing`: two points in one place

        integer :: i

        if (size(s) > 0) s(1) = 0.0_wp
        do i = 2, size(s)
            s(i) = s(i - 1) + hypot(y(i) - y(i - 1), z(i) - z(i - 1))
            if (s(i) > s(i - 1)) cycle
            call set_status(status, st_not_increasing, 'two points of the profile are in one ' &
                            //'place, y = '//trim(number_text(y(i)))//' mm')
            return
        end do
    end subroutine chord_lengths
end module faststrip_geometry_arc_spline
