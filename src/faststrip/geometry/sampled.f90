!> A profile given by points, through a cubic spline.
module faststrip_geometry_sampled
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_arc_spline, only: fewest_points
    use faststrip_numerics_spline, only: spline_setup, spline_value, spline_work_size, &
                                         spline_not_a_knot, interval_of, widen_by_cubic
    use faststrip_base_status, only: status_t, set_status, is_error, count_text, st_too_few_points
    implicit none
    private

    public :: sampled_profile_t, make_sampled_profile, sampled_profile_at, sampled_profile_bounds

    !> Points and the slopes of the curve through them.
    type :: sampled_profile_t
        real(wp), allocatable :: y(:)      !! lateral coordinate, strictly increasing, mm
        real(wp), allocatable :: z(:)      !! depth, mm
        real(wp), allocatable :: slope(:)  !! dz/dy at the points
    end type sampled_profile_t

contains

    !> The twice continuously differentiable curve through all points (not-a-knot).
    subroutine make_sampled_profile(y, z, profile, status)
        real(wp), intent(in) :: y(:)                     !! strictly increasing, mm
        real(wp), intent(in) :: z(:)                     !! depth at y, mm
        type(sampled_profile_t), intent(out) :: profile  !! points and slopes
        type(status_t), intent(out) :: status            !! `st_too_few_points`,
                                                         !! `st_not_finite`,
                                                         !! `st_not_increasing`,
                                                         !! `st_bad_argument`,
                                                         !! `st_linear_algebra`
        real(wp), allocatable :: work(:)

        if (size(y) < fewest_points) then
            call set_status(status, st_too_few_points, 'a profile must have at least 5 ' // &
                            'points, got ' // count_text(size(y)))
            return
        end if
        profile%y = y
        profile%z = z
        allocate (profile%slope(size(y)), work(spline_work_size(size(y))), source=0.0_wp)
        call spline_setup(y, z, spline_not_a_knot, profile%slope, work, status)
        if (is_error(status)) deallocate (profile%y, profile%z, profile%slope)
    end subroutine make_sampled_profile

    !> The curve and its first two derivatives.
    pure subroutine sampled_profile_at(profile, y, z, dz, d2z, is_there)
        type(sampled_profile_t), intent(in) :: profile !! from `make_sampled_profile`
        real(wp), intent(in) :: y                      !! lateral coordinate, mm
        real(wp), intent(out) :: z                     !! depth, mm
        real(wp), intent(out) :: dz                    !! slope dz/dy
        real(wp), intent(out) :: d2z                   !! second derivative, 1/mm
        logical, intent(out) :: is_there               !! is y from the first to the last point?
                                                       !! If not: all zero

        z = 0.0_wp
        dz = 0.0_wp
        d2z = 0.0_wp
        is_there = ieee_is_finite(y) .and. allocated(profile%slope)
        if (is_there) is_there = y >= profile%y(1) .and. y <= profile%y(size(profile%y))
        if (is_there) call spline_value(profile%y, profile%z, profile%slope, y, z, dz, d2z)
    end subroutine sampled_profile_at

    !> Bounds of the curve between two places.
    pure function sampled_profile_bounds(profile, from, to) result(bounds)
        type(sampled_profile_t), intent(in) :: profile !! from `make_sampled_profile`
        real(wp), intent(in) :: from  !! on the profile, mm
        real(wp), intent(in) :: to    !! the same, not before, mm
        real(wp) :: bounds(2)         !! z is from the first to the second one, mm

        integer :: i

        bounds = [huge(1.0_wp), -huge(1.0_wp)]
        associate (y => profile%y)
            do i = interval_of(y, from), interval_of(y, to)
                call widen_by_cubic(profile%z(i:i + 1), profile%slope(i:i + 1), y(i + 1) - y(i), &
                                    [max(from, y(i)), min(to, y(i + 1))] - y(i), bounds)
            end do
        end associate
    end function sampled_profile_bounds
end module faststrip_geometry_sampled
