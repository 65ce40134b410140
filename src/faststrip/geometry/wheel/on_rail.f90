!> One wheel of a wheelset and its rail, and the wheel's outline as it is seen along the rail.
!>
!> A rail is the same all along x. What a wheel that is turned by yaw and roll can touch of it is
!> therefore its outline against the (y, z) plane: the points whose normal has no part along x. At a
!> place y of the profile it is `theta` ahead of the lowest point of the wheel's circle,
!> `sin(theta) e_x + cos(theta) e_z = (dz/dy) e_y`, with e the parts along x of the wheelset's axes:
!> exact for a surface of revolution. The least distance of wheel and rail at each y' of a turned
!> frame, too, is that of the outline.
!>
!> A roller in the rail's place has its axis along y at z = R of the track. What can touch it are
!> the points whose normal meets that axis, `a sin(theta) + b cos(theta) = c` again; they are looked
!> at in the frame that unrolls the roller: x = R phi ahead, the same y, z as far within radius R.
!>
!> A rail may lie beside its place, turned about its origin: what is below a wheel's point is then
!> sought along the rail.
!>
!> A left wheel is given as a right one: in a mirror.
module faststrip_geometry_wheel_on_rail
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, most_points
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_out_of_range
    use faststrip_geometry_profile, only: profile_t, profile_at, profile_none
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, place_rail
    use faststrip_geometry_undeformed_gap, only: standard_gap_step
    use faststrip_geometry_wheelset_state, only: wheelset_axes_t, rail_state_t
    implicit none
    private

    public :: wheel_on_rail_t
    public :: make_wheel_on_rail, put_on_roller, rail_height, rail_span, steepest_rail
    public :: outline_point, rail_origin, turned, on_rail_profile, unrolled, rolled

    ! Distance of the rail's samples, of which regions of overlap are found, mm; between them a
    ! cubic.
    real(wp), parameter :: rail_step = standard_gap_step
    ! Distance of the outline's points along the profile, mm: some twenty in the narrowest patch of
    ! a flange.
    real(wp), parameter :: outline_step = 2.0_wp*rail_step
    ! Tuned [1]: slope of the rail beyond which its ends are left out. Origin: safeguard: no wheel
    ! touches a flank that stands upright, nor is there a cubic through it.
    real(wp), parameter :: steepest = 50.0_wp
    ! Tuned [samples]: of which the largest slope is known. Origin: chosen: 1 mm, as far as cells of
    ! an outline may move until they are looked at.
    integer, parameter :: steep_samples = 20
    ! Tuned [mm]: how near to it on a rail that is turned. Origin: safeguard: above rounding; wheels
    ! on turned rails change by some last digits with a tenth.
    real(wp), parameter :: near_point = 1.0e-11_wp

    !> One wheel and its rail, as a right pair; made once.
    type :: wheel_on_rail_t
        type(profile_t) :: wheel           !! y = 0 at the nominal rolling circle
        type(profile_t) :: rail            !! inclined
        real(wp) :: y_line = 0.0_wp        !! nominal rolling circle from the wheelset's centre, mm
        real(wp) :: radius = 0.0_wp        !! nominal radius, mm
        real(wp) :: z_line = 0.0_wp        !! z of the profile there, mm
        real(wp) :: y_rail = 0.0_wp        !! the rail's origin in the track, mm
        real(wp) :: z_rail = 0.0_wp        !! the same, mm
        real(wp) :: roller_radius = 0.0_wp !! of a roller in the rail's place, at z = 0 of the
                                           !! track, mm; 0: a rail
        real(wp), allocatable :: y(:)      !! points of the wheel's profile, mm
        real(wp), allocatable :: z(:)      !! the same, mm
        real(wp), allocatable :: slope(:)  !! dz/dy there
        real(wp) :: y_sample = 0.0_wp      !! first sample of the rail, in the track, mm
        real(wp) :: sample_step = 0.0_wp   !! to the next ones, mm
        real(wp), allocatable :: sample(:) !! height of the rail in the track, mm
        real(wp), allocatable :: sample_slope(:) !! its slope
        real(wp), allocatable :: steep(:)  !! largest slope in each `steep_samples` of them, and to
                                           !! the next
        real(wp) :: depth = 0.0_wp         !! largest z of the samples from the rail's origin, mm
        real(wp) :: mark = 0.0_wp          !! a sum of all that makes the pair, which tells it from
                                           !! others, mm
    end type wheel_on_rail_t

contains

    !> Put a wheel on its rail: the one place that allocates.
    subroutine make_wheel_on_rail(wheel, rail, wheelset, track, pair, status)
        type(profile_t), intent(in) :: wheel         !! of this wheel
        type(profile_t), intent(in) :: rail          !! of its rail, inclined
        type(wheelset_t), intent(in) :: wheelset     !! its radius is that of this wheel, mm
        type(track_t), intent(in) :: track           !! mm
        type(wheel_on_rail_t), intent(out) :: pair   !! as a right pair
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: no profile, or they do not fit; `st_out_of_range`: no gauge face

        real(wp) :: dz, d2z

        call clear_status(status)
        if (wheel%kind == profile_none .or. rail%kind == profile_none) then
            call set_status(status, st_bad_argument, 'there is no wheel or no rail profile')
            return
        end if
        if (.not. wheelset%radius > 0.0_wp) then
            call set_status(status, st_bad_argument, 'the nominal radius must be above 0, got ' // &
                            trim(number_text(wheelset%radius)) // ' mm')
            return
        end if
        pair%wheel = wheel
        pair%rail = rail
        pair%radius = wheelset%radius
        pair%y_line = 0.5_wp*wheelset%back_spacing + wheelset%tread_line
        call profile_at(wheel, 0.0_wp, pair%z_line, dz, d2z, status)
        if (is_error(status)) then
            call set_status(status, st_out_of_range, &
                            'the wheel profile must reach its nominal rolling circle, y = 0')
            return
        end if
        call place_rail(wheel, rail, wheelset, track, pair%y_rail, status, pair%z_rail)
        if (is_error(status)) return
        ! With a gauge the crown is where z = 0.
        pair%z_rail = -pair%z_rail
        call sample_wheel(pair)
        call sample_rail(pair)
        ! Twice the one and thrice the other: what moves between them shows.
        pair%mark = sum(pair%z) + 2.0_wp*(sum(pair%sample) + pair%y_rail) &
                    + 3.0_wp*(pair%y_line + pair%radius)
        call put_on_roller(pair, track%roller_radius)
    end subroutine make_wheel_on_rail

    !> Put a roller in the place of a rail, or a rail in that of a roller.
    pure subroutine put_on_roller(pair, radius)
        type(wheel_on_rail_t), intent(inout) :: pair !! made
        real(wp), intent(in) :: radius !! at z = 0 of the track, above the rail's depth, mm; 0: rail

        pair%mark = pair%mark + 4.0_wp*(radius - pair%roller_radius)
        pair%roller_radius = radius
    end subroutine put_on_roller

    ! Points of the wheel at equal distances along its profile.
    subroutine sample_wheel(pair)
        type(wheel_on_rail_t), intent(inout) :: pair

        real(wp) :: y, z, dz, d2z
        type(status_t) :: inside
        integer :: n, pass

        do pass = 1, 2
            n = 0
            y = pair%wheel%y_first
            do
                call profile_at(pair%wheel, y, z, dz, d2z, inside)
                n = n + 1
                if (pass == 2) then
                    pair%y(n) = y
                    pair%z(n) = z
                    pair%slope(n) = dz
                end if
                if (y >= pair%wheel%y_last .or. n == most_points) exit
                y = min(y + outline_step/hypot(1.0_wp, dz), pair%wheel%y_last)
            end do
            if (pass == 1) allocate (pair%y(n), pair%z(n), pair%slope(n))
        end do
    end subroutine sample_wheel

    subroutine sample_rail(pair)
        type(wheel_on_rail_t), intent(inout) :: pair

        real(wp) :: y, y_first, y_last, d2z
        type(status_t) :: inside
        integer :: i, n

        associate (rail => pair%rail)
            y_first = touchable_end(rail, rail%y_first, rail_step)
            y_last = touchable_end(rail, rail%y_last, -rail_step)
            n = max(1, min(ceiling((y_last - y_first)/rail_step), most_points))
            pair%sample_step = (y_last - y_first)/n
            pair%y_sample = pair%y_rail + y_first
            allocate (pair%sample(0:n), pair%sample_slope(0:n))
            do i = 0, n
                y = min(y_first + i*pair%sample_step, y_last)
                call profile_at(rail, y, pair%sample(i), pair%sample_slope(i), d2z, inside)
            end do
            allocate (pair%steep(0:(n - 1)/steep_samples))
            do i = 0, ubound(pair%steep, 1)
                pair%steep(i) = maxval(abs(pair%sample_slope(i*steep_samples: &
                                                             min((i + 1)*steep_samples, n))))
            end do
            pair%depth = maxval(abs(pair%sample))
            pair%sample = pair%sample + pair%z_rail
        end associate
    end subroutine sample_rail

    ! The first place from an end on where a rail is not too steep; the end if there is none.
    real(wp) function touchable_end(rail, y_end, step)
        type(profile_t), intent(in) :: rail
        real(wp), intent(in) :: y_end, step

        real(wp) :: y, z, dz, d2z
        type(status_t) :: inside

        touchable_end = y_end
        y = y_end
        do while (y >= rail%y_first .and. y <= rail%y_last)
            call profile_at(rail, y, z, dz, d2z, inside)
            if (abs(dz) <= steepest) then
                touchable_end = y
                return
            end if
            y = y + step
        end do
    end function touchable_end

    !> Where the origin of a rail's profile lies in the track, mm.
    pure function rail_origin(pair, rail) result(origin)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp) :: origin(2)                     !! y, z, mm

        origin = [pair%y_rail + rail%y, pair%z_rail + rail%z]
    end function rail_origin

    !> A vector in the plane across the track, turned about x.
    pure function turned(vector, angle) result(there)
        real(wp), intent(in) :: vector(2) !! along y and z, any unit
        real(wp), intent(in) :: angle     !! rad
        real(wp) :: there(2)              !! the same unit

        there = vector
        if (abs(angle) > 0.0_wp) &
            there = [vector(1)*cos(angle) - vector(2)*sin(angle), &
                     vector(1)*sin(angle) + vector(2)*cos(angle)]
    end function turned

    !> A point of the track on the rail's profile, mm.
    pure function on_rail_profile(pair, rail, point) result(place)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp), intent(in) :: point(2)          !! y, z in the track, mm
        real(wp) :: place(2)                      !! y, z of the profile, mm

        place = turned(point - rail_origin(pair, rail), -rail%roll)
    end function on_rail_profile

    !> A point of the track as it lies over the unrolled roller; over a rail as it is.
    pure function unrolled(pair, rail, point) result(there)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp), intent(in) :: point(3)          !! in the track, mm
        real(wp) :: there(3)                      !! along the circumference, y, z, mm

        real(wp) :: below

        there = point
        if (.not. pair%roller_radius > 0.0_wp) return
        below = pair%roller_radius + rail%z - point(3)
        there(1) = pair%roller_radius*atan2(point(1), below)
        there(3) = pair%roller_radius + rail%z - hypot(point(1), below)
    end function unrolled

    !> The point of the track of one over the unrolled roller; over a rail as it is.
    pure function rolled(pair, rail, point) result(there)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp), intent(in) :: point(3)          !! along the circumference, y, z, mm
        real(wp) :: there(3)                      !! in the track, mm

        there = point
        if (.not. pair%roller_radius > 0.0_wp) return
        associate (turn => point(1)/pair%roller_radius, axis => pair%roller_radius + rail%z)
            there(1) = (axis - point(3))*sin(turn)
            there(3) = axis - (axis - point(3))*cos(turn)
        end associate
    end function rolled

    !> The first and the last y of a rail as it lies, mm, in the track.
    pure function rail_span(pair, rail) result(span)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp) :: span(2)                       !! mm; of a turned rail a little more

        span = pair%y_sample + rail%y + [0.0_wp, ubound(pair%sample, 1)*pair%sample_step]
        if (abs(rail%roll) > 0.0_wp) span = span + [-1.0_wp, 1.0_wp]*moved_aside(pair, rail)
    end function rail_span

    ! How far points of a rail are moved to the side by its roll, mm.
    pure real(wp) function moved_aside(pair, rail)
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail

        moved_aside = pair%depth*abs(sin(rail%roll)) &
                      + (1.0_wp - cos(rail%roll))*maxval(abs(pair%y_sample - pair%y_rail &
                        + [0.0_wp, ubound(pair%sample, 1)*pair%sample_step]))
    end function moved_aside

    !> The largest slope of a rail as it lies between two places, or more.
    pure real(wp) function steepest_rail(pair, rail, left, right) result(slope)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as it lies
        real(wp), intent(in) :: left              !! in the track, mm
        real(wp), intent(in) :: right             !! in the track, not before, mm

        real(wp) :: aside, turn
        integer :: first, last

        aside = 0.0_wp
        if (abs(rail%roll) > 0.0_wp) aside = moved_aside(pair, rail)
        first = bin_of(left - aside)
        last = bin_of(right + aside)
        slope = maxval(pair%steep(first:last))
        if (.not. abs(rail%roll) > 0.0_wp) return
        turn = tan(min(atan(slope) + abs(rail%roll), atan(steepest)))
        slope = max(slope, turn)

    contains

        pure integer function bin_of(y)
            real(wp), intent(in) :: y

            bin_of = min(max(int((y - rail%y - pair%y_sample)/(pair%sample_step*steep_samples)), &
                             0), ubound(pair%steep, 1))
        end function bin_of
    end function steepest_rail

    !> Height and slope of a rail as it lies.
    pure subroutine rail_height(pair, rail, y, z, slope, is_there)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! mm, rad
        real(wp), intent(in) :: y                 !! in the track, mm
        real(wp), intent(out) :: z                !! in the track, mm
        real(wp), intent(out) :: slope            !! dz/dy
        logical, intent(out) :: is_there          !! is y on the rail?

        real(wp) :: along, change, advance
        integer :: i

        call height_in_design(pair, y - rail%y, z, slope, is_there)
        z = z + rail%z
        if (.not. abs(rail%roll) > 0.0_wp) return
        associate (c => cos(rail%roll), s => sin(rail%roll), &
                   first => pair%y_sample - pair%y_rail, &
                   last => pair%y_sample + ubound(pair%sample, 1)*pair%sample_step - pair%y_rail)
            along = min(max((y - rail%y - pair%y_rail)*c, first), last)
            do i = 1, most_steps
                call height_in_design(pair, pair%y_rail + along, z, slope, is_there)
                z = z - pair%z_rail
                advance = c - slope*s
                ! A rail that is turned beyond the upright hangs over.
                is_there = is_there .and. advance*steepest > 1.0_wp
                if (.not. is_there) exit
                change = (y - rail%y - pair%y_rail - along*c + z*s)/advance
                is_there = abs(change) <= near_point
                along = along + change
                if (is_there) exit
            end do
            ! What is left of the way counts to first order: it is rounding then.
            if (is_there) z = z + slope*change
            z = pair%z_rail + rail%z + along*s + z*c
            slope = tan(atan(slope) + rail%roll)
        end associate
    end subroutine rail_height

    ! Height and slope of the rail in its place, between its samples.
    pure subroutine height_in_design(pair, y, z, slope, is_there)
        type(wheel_on_rail_t), intent(in) :: pair
        real(wp), intent(in) :: y
        real(wp), intent(out) :: z
        real(wp), intent(out) :: slope
        logical, intent(out) :: is_there

        real(wp) :: t, c1, c3, secant
        integer :: i

        t = (y - pair%y_sample)/pair%sample_step
        i = min(int(t), ubound(pair%sample, 1) - 1)
        is_there = t >= 0.0_wp .and. t <= real(i + 1, wp)
        z = 0.0_wp
        slope = 0.0_wp
        if (.not. is_there) return
        t = t - i
        secant = pair%sample(i + 1) - pair%sample(i)
        c1 = pair%sample_slope(i)*pair%sample_step
        c3 = c1 + pair%sample_slope(i + 1)*pair%sample_step - 2.0_wp*secant
        z = pair%sample(i) + t*(c1 + t*((secant - c1 - c3) + t*c3))
        slope = (c1 + t*(2.0_wp*(secant - c1 - c3) + 3.0_wp*t*c3))/pair%sample_step
    end subroutine height_in_design

    !> The point of the outline that a point of the wheel's profile is turned to.
    !>
    !> On a roller, with A from its axis to the wheel's on its own and the wheel's radius rho, the
    !> normal meets the axis where
    !> `[A x n - rho (dz/dy) n x e_y]_y = (dz/dy) [A x e_y]_y`, n = sin(theta) e_x + cos(theta) e_z.
    pure subroutine outline_point(pair, rail, axes, y, z, dz, point, slope, is_there)
        type(wheel_on_rail_t), intent(in) :: pair !! made
        type(rail_state_t), intent(in) :: rail    !! as a roller lies
        type(wheelset_axes_t), intent(in) :: axes !! of the state; over a roller with its height
        real(wp), intent(in) :: y                 !! on the wheel's profile, mm
        real(wp), intent(in) :: z                 !! on the wheel's profile, mm
        real(wp), intent(in) :: dz                !! slope of the profile there
        real(wp), intent(out) :: point(3)         !! in the track, mm; `unrolled` over a roller
        real(wp), intent(out) :: slope            !! dz/dy of the outline there
        logical, intent(out) :: is_there          !! has the wheel an outline there?

        real(wp) :: radius, a, b, c, reach, along, sine, cosine, spoke(3), normal(3), arm(3), down

        point = 0.0_wp
        slope = 0.0_wp
        radius = pair%radius + z - pair%z_line
        if (pair%roller_radius > 0.0_wp) then
            arm = axes%centre + (pair%y_line + y)*axes%axle
            arm(3) = arm(3) - pair%roller_radius - rail%z
            ! As of a rail: arm(3) is below 0.
            a = radius*dz*across(axes%ahead, axes%axle) - across(arm, axes%ahead)
            b = radius*dz*across(axes%down, axes%axle) - across(arm, axes%down)
            c = -dz*across(arm, axes%axle)
        else
            a = axes%ahead(1)
            b = axes%down(1)
            c = dz*axes%axle(1)
        end if
        ! a sin(theta) + b cos(theta) = reach sin(theta + turn)
        reach = sqrt(a**2 + b**2)
        along = c/reach
        is_there = abs(along) < 1.0_wp
        if (.not. is_there) return
        cosine = sqrt(1.0_wp - along**2)
        sine = (along*a - cosine*b)/reach
        cosine = (cosine*a + along*b)/reach
        spoke = cosine*axes%down + sine*axes%ahead
        point = axes%centre + (pair%y_line + y)*axes%axle + radius*spoke
        normal = spoke - dz*axes%axle
        down = normal(3)
        if (pair%roller_radius > 0.0_wp) then
            point = unrolled(pair, rail, point)
            associate (turn => point(1)/pair%roller_radius)
                down = normal(3)*cos(turn) - normal(1)*sin(turn)
            end associate
        end if
        is_there = down > 0.0_wp .and. radius > 0.0_wp
        if (is_there) slope = -normal(2)/down

    contains

        ! The part along y of a vector product.
        pure real(wp) function across(u, v)
            real(wp), intent(in) :: u(3), v(3)

            across = u(3)*v(1) - u(1)*v(3)
        end function across
    end subroutine outline_point
end module faststrip_geometry_wheel_on_rail
