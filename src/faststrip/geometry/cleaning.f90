!> Changes to the points of a profile, each on request only; every one reports what it did.
module faststrip_geometry_cleaning
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_points
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_too_few_points
    use faststrip_numerics_spline, only: spline_setup, spline_value, spline_work_size, &
                                         spline_not_a_knot
    use faststrip_geometry_arc_spline, only: find_kinks, chord_lengths
    implicit none
    private

    public :: keep_range, drop_double, drop_folds, turn_points, resample

    ! A point in which a curve turns by more is that of a fold.
    ! Tuned [rad]. Origin: 150 degrees, as CONTACT has it for the zig-zag of two stitched parts.
    real(wp), parameter :: folded = 5.0_wp/6.0_wp*pi

contains

    !> Leave out points outside a range of y.
    pure subroutine keep_range(y, z, from, to)
        real(wp), allocatable, intent(inout) :: y(:)  !! mm, along the curve
        real(wp), allocatable, intent(inout) :: z(:)  !! mm, as many
        real(wp), intent(in) :: from, to              !! mm

        logical :: is_kept(size(y))

        is_kept = y >= from .and. y <= to
        y = pack(y, is_kept)
        z = pack(z, is_kept)
    end subroutine keep_range

    !> Leave out points no farther than a distance from the one kept before.
    pure subroutine drop_double(y, z, distance)
        real(wp), allocatable, intent(inout) :: y(:)  !! mm, along the curve
        real(wp), allocatable, intent(inout) :: z(:)  !! mm, as many
        real(wp), intent(in) :: distance              !! mm, from 0 on

        logical :: is_kept(size(y))
        integer :: i, last

        is_kept = .true.
        last = 1
        do i = 2, size(y)
            is_kept(i) = hypot(y(i) - y(last), z(i) - z(last)) > distance
            if (is_kept(i)) last = i
        end do
        y = pack(y, is_kept)
        z = pack(z, is_kept)
    end subroutine drop_double

    !> Leave out points in which the curve turns back, zig-zags, until there are none.
    pure subroutine drop_folds(y, z)
        real(wp), allocatable, intent(inout) :: y(:)  !! mm, along the curve
        real(wp), allocatable, intent(inout) :: z(:)  !! mm, as many

        real(wp) :: kept_y(size(y)), kept_z(size(y)), a(2), b(2)
        integer :: i, n

        n = 0
        do i = 1, size(y)
            do while (n >= 2)
                a = [kept_y(n) - kept_y(n - 1), kept_z(n) - kept_z(n - 1)]
                b = [y(i) - kept_y(n), z(i) - kept_z(n)]
                if (abs(atan2(a(1)*b(2) - a(2)*b(1), dot_product(a, b))) <= folded) exit
                n = n - 1
            end do
            n = n + 1
            kept_y(n) = y(i)
            kept_z(n) = z(i)
        end do
        y = kept_y(:n)
        z = kept_z(:n)
    end subroutine drop_folds

    !> Turn points about the origin: a positive angle leads from y to z.
    pure subroutine turn_points(y, z, angle)
        real(wp), intent(inout) :: y(:)  !! mm
        real(wp), intent(inout) :: z(:)  !! mm, as many
        real(wp), intent(in) :: angle    !! rad

        real(wp) :: before(size(y))

        before = y
        y = before*cos(angle) - z*sin(angle)
        z = before*sin(angle) + z*cos(angle)
    end subroutine turn_points

    !> Points at even distances along the curve, between kinks one by one; ends and kinks stay.
    subroutine resample(y, z, step, kink_angle, status)
        real(wp), allocatable, intent(inout) :: y(:)  !! mm, along the curve
        real(wp), allocatable, intent(inout) :: z(:)  !! mm, as many
        real(wp), intent(in) :: step                  !! distance, above 0, mm
        real(wp), intent(in) :: kink_angle            !! turn from which a point is a kink, rad
        type(status_t), intent(out) :: status         !! `st_bad_argument`, `st_too_few_points`,
                                                      !! `st_not_increasing` (two points in one
                                                      !! place), `st_linear_algebra`

        real(wp), allocatable :: new_y(:), new_z(:), s(:)
        logical, allocatable :: is_kink(:)
        integer :: first, last, n, n_new
        logical :: valid

        n = size(y)
        call clear_status(status)
        valid = ieee_is_finite(step)
        if (valid) valid = step > 0.0_wp
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'the distance of points must be above 0 mm, ' &
                            //'got '//number_text(step))
            return
        else if (n < 2) then
            call set_status(status, st_too_few_points, 'there must be points to resample')
            return
        end if
        allocate (s(n), source=0.0_wp)
        allocate (is_kink(n), source=.false.)
        call chord_lengths(y, z, s, status)
        if (is_error(status)) return
        if (s(n)/step > most_points) then
            call set_status(status, st_bad_argument, 'the distance of points must leave at most ' &
                            //'1e6 of them, got '//trim(number_text(step))//' mm')
            return
        end if
        call find_kinks(y, z, kink_angle, is_kink)
        allocate (new_y(n + nint(s(n)/step) + 2), new_z(n + nint(s(n)/step) + 2), source=0.0_wp)
        new_y(1) = y(1)
        new_z(1) = z(1)
        n_new = 1
        last = 1
        do while (last < n)
            first = last
            last = first + 1
            do while (last < n .and. .not. is_kink(last))
                last = last + 1
            end do
            call resample_stretch(y(first:last), z(first:last), s(first:last), step, new_y, &
                                  new_z, n_new, status)
            if (is_error(status)) return
        end do
        y = new_y(:n_new)
        z = new_z(:n_new)
    end subroutine resample

    subroutine resample_stretch(y, z, s, step, new_y, new_z, n_new, status)
        real(wp), intent(in) :: y(:), z(:), s(:), step
        real(wp), intent(inout) :: new_y(:), new_z(:)
        integer, intent(inout) :: n_new
        type(status_t), intent(inout) :: status

        real(wp), allocatable :: slope(:, :), work(:)
        real(wp) :: at, d1, d2
        integer :: i, m, n

        n = size(y)
        allocate (slope(n, 2), work(spline_work_size(n)), source=0.0_wp)
        call spline_setup(s, y, spline_not_a_knot, slope(:, 1), work, status)
        if (is_error(status)) return
        call spline_setup(s, z, spline_not_a_knot, slope(:, 2), work, status)
        if (is_error(status)) return
        m = max(1, nint((s(n) - s(1))/step))
        do i = 1, m - 1
            at = s(1) + (s(n) - s(1))*i/m
            n_new = n_new + 1
            call spline_value(s, y, slope(:, 1), at, new_y(n_new), d1, d2)
            call spline_value(s, z, slope(:, 2), at, new_z(n_new), d1, d2)
        end do
        n_new = n_new + 1
        new_y(n_new) = y(n)
        new_z(n_new) = z(n)
    end subroutine resample_stretch
end module faststrip_geometry_cleaning
