!> Wheel and rail profiles of every kind behind one interface.
!>
!> The frame is that of a right wheel and a right rail: y to the field side, z down. A wheel has
!> y = 0 at its nominal rolling circle; a rail is inclined already, with the origin at its highest
!> point (points: where their author put it).
!>
!> The rail inclination is the tangent of the angle by which the rail leans to the track's centre,
!> 0.025 for 1:40. A rail by name stands upright in its drawing: it is inclined by
!> `standard_inclination` where nothing is said. Nobody but who measured it knows how a rail of
!> points stands: there `unset_inclination` is an error.
module faststrip_geometry_profile
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_place
    use faststrip_geometry_rail_uic60, only: rail_head_t, make_rail_head, rail_head_at, &
                                             uic60_transition, en60e1_transition, &
                                             en54e1_transition, half_width_54
    use faststrip_geometry_arc_spline, only: arc_spline_t, make_arc_spline, arc_spline_at, &
                                             standard_kink_angle, arc_spline_bounds
    use faststrip_geometry_touchable, only: touchable_t, find_touchable, body_wheel, body_rail
    use faststrip_geometry_sampled, only: sampled_profile_t, make_sampled_profile, &
                                          sampled_profile_at, sampled_profile_bounds
    use faststrip_geometry_wheel_s1002, only: s1002_at, s1002_first, s1002_last, s1002_tip
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range, &
                                     st_too_few_points
    use faststrip_base_text, only: lower_case
    implicit none
    private

    public :: profile_t, make_wheel_profile, make_rail_profile, make_points_profile, profile_at
    public :: profile_point, make_curve_profile, thin_profile, profile_bounds
    public :: profile_none, profile_s1002, profile_uic60, profile_60e1, profile_points
    public :: profile_curve, profile_54e1, profile_cone
    public :: standard_inclination, unset_inclination

    ! Given: numbers of kinds.
    integer, parameter :: profile_none = 0
    integer, parameter :: profile_s1002 = 1
    integer, parameter :: profile_uic60 = 2
    integer, parameter :: profile_60e1 = 3
    integer, parameter :: profile_points = 4
    integer, parameter :: profile_curve = 5
    integer, parameter :: profile_54e1 = 6
    integer, parameter :: profile_cone = 7

    !> Rail inclination 1:40, of rails by name where nothing is said.
    !> Given: 1:40.
    real(wp), parameter :: standard_inclination = 0.025_wp
    !> What stands where no inclination was said.
    !> Given: out of range of all inclinations.
    real(wp), parameter :: unset_inclination = 999.0_wp
    ! Tuned [1]: Largest inclination of points. Origin: safeguard, 45 degrees.
    real(wp), parameter :: largest_inclination = 1.0_wp

    ! Treads of cones, from the flange root to the field side.
    ! Given: width of the tread of S1002, mm.
    real(wp), parameter :: cone_first = -35.0_wp, cone_last = 60.0_wp
    ! Given: the two cones of EN 13715.
    real(wp), parameter :: cone20 = 0.05_wp, cone40 = 0.025_wp

    ! Of every second point a smooth curve turns by twice as much.
    ! Given: two turns in one.
    real(wp), parameter :: turn_of_two = 2.0_wp

    !> One profile, ready to be evaluated between y_first and y_last.
    type :: profile_t
        integer :: kind = profile_none     !! which profile: one of the `profile_` kinds
        real(wp) :: y_first = 0.0_wp       !! first y of the definition, mm
        real(wp) :: y_last = 0.0_wp        !! last y of the definition, mm
        type(rail_head_t) :: head          !! used by `uic60`, `60e1`, `54e1`
        real(wp) :: cone = 0.0_wp          !! used by `cone`: rise to the field side
        type(sampled_profile_t) :: sampled !! used by `points`
        type(arc_spline_t) :: curve        !! used by `curve`
        logical :: is_clipped = .false.    !! was an overhang clipped at y_first?
        real(wp) :: z_below = 0.0_wp       !! how deep it reaches, mm
    end type profile_t

contains

    !> An analytic wheel profile by name.
    pure subroutine make_wheel_profile(name, profile, status)
        character(len=*), intent(in) :: name      !! `s1002`; `cone20`, `cone40`: 1:20, 1:40; in
                                                  !! any case
        type(profile_t), intent(out) :: profile   !! the profile
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no such name

        call clear_status(status)
        select case (lower_case(name))
        case ('s1002')
            profile%kind = profile_s1002
            profile%y_first = s1002_first
            profile%y_last = s1002_last
        case ('cone20', 'cone40')
            profile%kind = profile_cone
            profile%cone = merge(cone20, cone40, lower_case(name) == 'cone20')
            profile%y_first = cone_first
            profile%y_last = cone_last
        case default
            call set_status(status, st_bad_argument, &
                            'the wheel profile must be s1002, cone20 or cone40, got ' // name)
        end select
    end subroutine make_wheel_profile

    !> An analytic rail profile by name.
    pure subroutine make_rail_profile(name, inclination, profile, status)
        character(len=*), intent(in) :: name      !! `uic60` (Manchester), `60e1`, `54e1` (EN
                                                  !! 13674-1), in any case
        real(wp), intent(in) :: inclination       !! of the rail, its tangent, within +-0.1;
                                                  !! `unset_inclination`: 1:40
        type(profile_t), intent(out) :: profile   !! the inclined profile
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no such name, inclination

        real(wp) :: turn

        turn = merge(inclination, standard_inclination, is_said(inclination))
        call clear_status(status)
        select case (lower_case(name))
        case ('uic60')
            profile%kind = profile_uic60
            call make_rail_head(uic60_transition, turn, profile%head, status)
        case ('60e1')
            profile%kind = profile_60e1
            call make_rail_head(en60e1_transition, turn, profile%head, status)
        case ('54e1')
            profile%kind = profile_54e1
            call make_rail_head(en54e1_transition, turn, profile%head, status, half_width_54)
        case default
            call set_status(status, st_bad_argument, &
                            'the rail profile must be uic60, 60e1 or 54e1, got ' // name)
        end select
        if (is_error(status)) then
            profile%kind = profile_none
            return
        end if
        profile%y_first = profile%head%joint(1)
        profile%y_last = profile%head%joint(8)
    end subroutine make_rail_profile

    !> A wheel or rail profile through points, inclined about the origin of the points.
    !>
    !> An inclination of zero leaves the points where they are, which is right for wheels and for
    !> rails measured or listed as they lie in the track.
    subroutine make_points_profile(y, z, inclination, profile, status)
        real(wp), intent(in) :: y(:)             !! strictly increasing, mm
        real(wp), intent(in) :: z(:)             !! depth (down) at y, mm
        real(wp), intent(in) :: inclination      !! tangent of the angle by which the top leans to
                                                 !! negative y, within +-1
        type(profile_t), intent(out) :: profile  !! the curve through the points
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_too_few_points`,
                                                 !! `st_not_finite`, `st_not_increasing` (also
                                                 !! after turning), `st_linear_algebra`

        call check_inclination(inclination, status)
        if (is_error(status)) return
        ! The points themselves are checked before they are turned.
        call make_sampled_profile(y, z, profile%sampled, status)
        if (is_error(status)) return
        if (max(maxval(abs(y)), maxval(abs(z))) > largest_place) then
            call set_status(status, st_bad_argument, &
                            'points of the profile must be within 10 m, got ' // &
                            trim(number_text(max(maxval(abs(y)), maxval(abs(z))))) // ' mm')
            return
        end if
        if (abs(inclination) > 0.0_wp) then
            call make_sampled_profile((y + inclination*z)/hypot(1.0_wp, inclination), &
                                      (z - inclination*y)/hypot(1.0_wp, inclination), &
                                      profile%sampled, status)
            if (is_error(status)) return
        end if
        profile%kind = profile_points
        profile%y_first = profile%sampled%y(1)
        profile%y_last = profile%sampled%y(size(y))
    end subroutine make_points_profile

    ! Is it an inclination, and not the word for none?
    pure logical function is_said(inclination)
        real(wp), intent(in) :: inclination

        is_said = inclination /= unset_inclination
    end function is_said

    ! Of points an inclination must be said.
    pure subroutine check_inclination(inclination, status)
        real(wp), intent(in) :: inclination
        type(status_t), intent(out) :: status

        logical :: valid

        call clear_status(status)
        valid = ieee_is_finite(inclination)
        if (valid) valid = abs(inclination) <= largest_inclination
        if (valid) return
        if (is_said(inclination)) then
            call set_status(status, st_bad_argument, 'rail inclination must be -1 to 1, got ' // &
                            number_text(inclination))
        else
            call set_status(status, st_bad_argument, 'the rail inclination must be given for a ' &
                            // 'rail of points: 0 if they lie as in the track, 0.025 to turn ' // &
                            'them by 1:40')
        end if
    end subroutine check_inclination

    !> A wheel or rail profile through a curve of points, inclined about the origin: what of it can
    !> be touched.
    !>
    !> The points run along the curve from small y to large y; it may overhang, stand upright or
    !> fold back. An inclination of zero leaves the points where they are.
    subroutine make_curve_profile(y, z, body, inclination, kink_angle, profile, part, status)
        real(wp), intent(in) :: y(:)             !! mm, to the field side
        real(wp), intent(in) :: z(:)             !! mm, down
        integer, intent(in) :: body              !! `body_wheel` or `body_rail`
        real(wp), intent(in) :: inclination      !! tangent of the angle by which the top leans to
                                                 !! negative y, within +-1; of wheels 0
        real(wp), intent(in) :: kink_angle       !! turn from which a point is a kink, rad
        type(profile_t), intent(out) :: profile  !! the curve through the points
        type(touchable_t), intent(out) :: part   !! which of the points, and what was clipped
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_too_few_points`,
                                                 !! `st_not_finite`, `st_linear_algebra`

        real(wp), allocatable :: y_turned(:), z_turned(:)

        allocate (part%point(0))
        call check_inclination(inclination, status)
        if (is_error(status)) return
        if (body /= body_wheel .and. body /= body_rail) then
            call set_status(status, st_bad_argument, 'a profile must be of a wheel or of a rail')
        else if (size(y) == 0 .or. size(y) /= size(z)) then
            call set_status(status, st_too_few_points, 'a profile must have as many y as z')
        else if (.not. all(ieee_is_finite(y)) .or. .not. all(ieee_is_finite(z))) then
            call set_status(status, st_not_finite, 'points of a profile must be finite numbers')
        else if (max(maxval(abs(y)), maxval(abs(z))) > largest_place) then
            call set_status(status, st_bad_argument, &
                            'points of the profile must be within 10 m, got ' // &
                            trim(number_text(max(maxval(abs(y)), maxval(abs(z))))) // ' mm')
        end if
        if (is_error(status)) return
        y_turned = (y + inclination*z)/hypot(1.0_wp, inclination)
        z_turned = (z - inclination*y)/hypot(1.0_wp, inclination)
        call find_touchable(y_turned, z_turned, body, part)
        call make_arc_spline(y_turned(part%point), z_turned(part%point), kink_angle, &
                             profile%curve, status)
        if (is_error(status)) return
        profile%kind = profile_curve
        profile%y_first = profile%curve%y(1)
        profile%y_last = profile%curve%y(size(part%point))
        profile%is_clipped = part%n_clipped(1) > 0
        profile%z_below = part%deepest(1)
    end subroutine make_curve_profile

    !> A profile through every second point of another one's curve, and through both its ends: how
    !> much hangs on single points. Profiles of other kinds stay as they are.
    subroutine thin_profile(profile, first, thinned, status)
        type(profile_t), intent(in) :: profile   !! made by `make_curve_profile`, or another
        integer, intent(in) :: first             !! the first point after the end, 1 or 2: the
                                                 !! second or the third, and every second from there
        type(profile_t), intent(out) :: thinned  !! from the same first to the same last y
        type(status_t), intent(out) :: status    !! `st_bad_argument`; `st_too_few_points`, and
                                                 !! others of `make_curve_profile`

        integer :: i, n

        thinned = profile
        call clear_status(status)
        if (first < 1 .or. first > 2) then
            call set_status(status, st_bad_argument, 'first must be 1 or 2')
        else if (profile%kind == profile_curve) then
            n = size(profile%curve%y)
            associate (kept => [1, (i, i=first + 1, n - 1, 2), n])
                call make_arc_spline(profile%curve%y(kept), profile%curve%z(kept), &
                                     turn_of_two*standard_kink_angle, thinned%curve, status)
            end associate
        end if
    end subroutine thin_profile

    !> The profile and its first two derivatives.
    pure subroutine profile_at(profile, y, z, dz, d2z, status)
        type(profile_t), intent(in) :: profile !! a profile that was made
        real(wp), intent(in) :: y              !! lateral coordinate, mm
        real(wp), intent(out) :: z             !! depth, mm
        real(wp), intent(out) :: dz            !! slope dz/dy
        real(wp), intent(out) :: d2z           !! second derivative, 1/mm
        type(status_t), intent(out) :: status  !! `st_out_of_range` outside y_first to y_last, for
                                               !! y not finite and for no profile: all zero

        logical :: is_there

        call profile_point(profile, y, z, dz, d2z, is_there)
        if (.not. is_there) call set_status(status, st_out_of_range, &
            'y must be on the profile, got ' // trim(number_text(y)) // ' mm')
    end subroutine profile_at

    !> The same without words, where many points are looked at.
    pure subroutine profile_point(profile, y, z, dz, d2z, is_there)
        type(profile_t), intent(in) :: profile !! a profile that was made
        real(wp), intent(in) :: y              !! lateral coordinate, mm
        real(wp), intent(out) :: z             !! depth, mm
        real(wp), intent(out) :: dz            !! slope dz/dy
        real(wp), intent(out) :: d2z           !! second derivative, 1/mm
        logical, intent(out) :: is_there       !! is y on the profile? If not: all zero

        select case (profile%kind)
        case (profile_s1002)
            call s1002_at(y, z, dz, d2z, is_there)
        case (profile_uic60, profile_60e1, profile_54e1)
            call rail_head_at(profile%head, y, z, dz, d2z, is_there)
        case (profile_points)
            call sampled_profile_at(profile%sampled, y, z, dz, d2z, is_there)
        case (profile_curve)
            call arc_spline_at(profile%curve, y, z, dz, d2z, is_there)
        case default
            z = 0.0_wp
            dz = 0.0_wp
            d2z = 0.0_wp
            is_there = profile%kind == profile_cone .and. ieee_is_finite(y)
            if (is_there) is_there = y >= profile%y_first .and. y <= profile%y_last
            if (.not. is_there) return
            ! A straight tread that rises to the field side.
            z = -profile%cone*y
            dz = -profile%cone
        end select
    end subroutine profile_point

    !> Bounds of a profile between two places; of S1002 but for its jumps, 1.2e-4 mm.
    pure function profile_bounds(profile, from, to) result(bounds)
        type(profile_t), intent(in) :: profile !! a profile that was made
        real(wp), intent(in) :: from           !! on the profile, mm
        real(wp), intent(in) :: to             !! the same, not before, mm
        real(wp) :: bounds(2)                  !! z is from the first to the second one, mm

        real(wp) :: places(3), z(3), dz, d2z
        type(status_t) :: inside
        integer :: i

        select case (profile%kind)
        case (profile_points)
            bounds = sampled_profile_bounds(profile%sampled, from, to)
        case (profile_curve)
            bounds = arc_spline_bounds(profile%curve, from, to)
        case default
            ! From the flange tip, or the highest point of a rail, z goes one way to both sides.
            places = [from, to, merge(s1002_tip, 0.0_wp, profile%kind == profile_s1002)]
            if (places(3) < from .or. places(3) > to) places(3) = from
            do i = 1, 3
                call profile_at(profile, places(i), z(i), dz, d2z, inside)
            end do
            bounds = [minval(z), maxval(z)]
        end select
    end function profile_bounds
end module faststrip_geometry_profile
