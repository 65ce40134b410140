!> Where a wheelset is and how it moves, and its axes in the track.
!>
!> The track frame: x in the direction of travel, y to the right, z down; its origin on the centre
!> line, as high as the crowns of the rails. The centre of a wheelset that stands level on the
!> track is at `(0, y, z - r)`, with r the mean of its nominal radii: z = 0 where the nominal
!> rolling circles are as high as the crowns. The wheelset is turned by its yaw about z (nose to the
!> right) and then by its roll about the track's x (right wheel down), as CONTACT turns it. Each
!> rail may lie beside its place in the design, turned about x, and may move there.
module faststrip_geometry_wheelset_state
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_place, largest_ratio
    use faststrip_base_plausible, only: quantities, likely_mistake, of_turn
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_argument
    implicit none
    private

    public :: wheelset_state_t, wheelset_axes_t, rail_state_t, on_roller_t, pure_rolling
    public :: mirrored_state, reversed_state, rolls_back, rolling_state, resting_state, &
              is_at_rest, check_state, wheelset_axes, rigid_creepage, approach_rate, &
              rail_velocity, cross, is_same_state

    ! Roll, yaw and contact angles beyond are refused, rad: lines of a wheel that is turned farther
    ! have no meaning.
    real(wp), parameter :: largest_turn = quantities(of_turn)%possible

    !> A pitch rate that is not said: that of pure rolling at the mean nominal radius.
    !> Given: out of range of all rates.
    real(wp), parameter :: pure_rolling = -huge(1.0_wp)

    !> How a rail lies and moves beside its place in the design, in the track frame; it is turned
    !> about the origin of its profile.
    type :: rail_state_t
        real(wp) :: y = 0.0_wp         !! to the right, mm
        real(wp) :: z = 0.0_wp         !! down, mm
        real(wp) :: roll = 0.0_wp      !! right side down, rad
        real(wp) :: y_rate = 0.0_wp    !! mm/s
        real(wp) :: z_rate = 0.0_wp    !! mm/s
        real(wp) :: roll_rate = 0.0_wp !! rad/s
    end type rail_state_t

    !> Position and velocity of a wheelset, and of the rails below it, in the track frame.
    type :: wheelset_state_t
        real(wp) :: y = 0.0_wp          !! lateral displacement, mm
        real(wp) :: z = 0.0_wp          !! vertical displacement of the centre, mm
        real(wp) :: roll = 0.0_wp       !! right wheel down, rad
        real(wp) :: yaw = 0.0_wp        !! nose to the right, rad
        real(wp) :: speed = 0.0_wp      !! along the track, mm/s
        real(wp) :: y_rate = 0.0_wp     !! mm/s
        real(wp) :: z_rate = 0.0_wp     !! mm/s
        real(wp) :: roll_rate = 0.0_wp  !! about the wheelset's x axis, rad/s
        real(wp) :: yaw_rate = 0.0_wp   !! relative to the track, about the wheelset's z axis, rad/s
        real(wp) :: pitch_rate = pure_rolling !! about the axle, negative for rolling ahead, rad/s;
                                              !! the mean of both wheels
        real(wp) :: pitch_rate_difference = 0.0_wp
            !! left less right, of wheels that rotate independently, rad/s
        real(wp) :: curvature = 0.0_wp  !! of the track, positive to the right, 1/mm
        type(rail_state_t) :: rail(2)   !! right, left
    end type wheelset_state_t

    !> The place of a contact on a roller, whose axis lies along y of the track.
    type :: on_roller_t
        real(wp) :: radius = 0.0_wp !! of the roller there, mm; 0: a rail
        real(wp) :: turn = 0.0_wp   !! by which it is ahead, about the axis, rad
        real(wp) :: rate = 0.0_wp   !! at which the roller turns, rad/s
    end type on_roller_t

    !> The wheelset's frame in the track.
    type :: wheelset_axes_t
        real(wp) :: ahead(3) = 0.0_wp  !! its x axis
        real(wp) :: axle(3) = 0.0_wp   !! its y axis
        real(wp) :: down(3) = 0.0_wp   !! its z axis
        real(wp) :: centre(3) = 0.0_wp !! mm
    end type wheelset_axes_t

contains

    !> Are two states the same, to the last bit?
    pure logical function is_same_state(one, other) result(is_same)
        type(wheelset_state_t), intent(in) :: one   !! mm, rad, s
        type(wheelset_state_t), intent(in) :: other !! the same

        is_same = one%y == other%y .and. one%z == other%z .and. one%roll == other%roll &
                  .and. one%yaw == other%yaw .and. one%speed == other%speed &
                  .and. one%y_rate == other%y_rate .and. one%z_rate == other%z_rate &
                  .and. one%roll_rate == other%roll_rate .and. one%yaw_rate == other%yaw_rate &
                  .and. one%pitch_rate == other%pitch_rate &
                  .and. one%pitch_rate_difference == other%pitch_rate_difference &
                  .and. one%curvature == other%curvature &
                  .and. all(is_same_rail(one%rail, other%rail))
    end function is_same_state

    elemental logical function is_same_rail(one, other) result(is_same)
        type(rail_state_t), intent(in) :: one, other

        is_same = one%y == other%y .and. one%z == other%z .and. one%roll == other%roll &
                  .and. one%y_rate == other%y_rate .and. one%z_rate == other%z_rate &
                  .and. one%roll_rate == other%roll_rate
    end function is_same_rail

    !> The same wheelset in a mirror: left is right.
    elemental type(wheelset_state_t) function mirrored_state(state) result(mirrored)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s

        mirrored = state
        mirrored%y = -state%y
        mirrored%roll = -state%roll
        mirrored%yaw = -state%yaw
        mirrored%y_rate = -state%y_rate
        mirrored%roll_rate = -state%roll_rate
        mirrored%yaw_rate = -state%yaw_rate
        mirrored%pitch_rate_difference = -state%pitch_rate_difference
        mirrored%curvature = -state%curvature
        mirrored%rail = mirrored_rail(state%rail(2:1:-1))
    end function mirrored_state

    !> The same wheelset on a track that is looked along from its other end, in a mirror: ahead is
    !> behind, right stays right.
    elemental type(wheelset_state_t) function reversed_state(state) result(reversed)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s

        reversed = state
        reversed%yaw = -state%yaw
        reversed%speed = -state%speed
        reversed%yaw_rate = -state%yaw_rate
        reversed%pitch_rate = -state%pitch_rate
        reversed%pitch_rate_difference = -state%pitch_rate_difference
    end function reversed_state

    !> Does a right wheel roll backwards, by the mean of its speed and that of its surface?
    pure logical function rolls_back(state, lever, radius)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s; its pitch rate is said
        real(wp), intent(in) :: lever               !! of the wheel about the middle, mm
        real(wp), intent(in) :: radius              !! nominal one of the wheel, mm

        rolls_back = state%speed - (state%yaw_rate + state%speed*state%curvature)*lever &
                     < right_pitch_rate(state)*radius
    end function rolls_back

    ! The pitch rate of the right wheel, rad/s.
    pure real(wp) function right_pitch_rate(state)
        type(wheelset_state_t), intent(in) :: state

        right_pitch_rate = state%pitch_rate - 0.5_wp*state%pitch_rate_difference
    end function right_pitch_rate

    !> The state with the pitch rate of pure rolling where none was said.
    elemental type(wheelset_state_t) function rolling_state(state, radius) result(rolling)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s
        real(wp), intent(in) :: radius              !! mean of the nominal radii, mm

        rolling = state
        if (state%pitch_rate == pure_rolling) rolling%pitch_rate = -state%speed/radius
    end function rolling_state

    !> Where the wheelset and its rails are, at rest.
    elemental type(wheelset_state_t) function resting_state(state) result(resting)
        type(wheelset_state_t), intent(in) :: state !! mm, rad

        resting = wheelset_state_t(y=state%y, z=state%z, roll=state%roll, yaw=state%yaw, &
                                   pitch_rate=0.0_wp, curvature=state%curvature)
        resting%rail%y = state%rail%y
        resting%rail%z = state%rail%z
        resting%rail%roll = state%rail%roll
    end function resting_state

    !> Does neither the wheelset move nor a rail? Then there is no slip, and by theories of rolling
    !> no friction.
    pure logical function is_at_rest(state)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s; its pitch rate is said

        associate (rail => state%rail)
            is_at_rest = .not. any(abs([state%speed, state%y_rate, state%z_rate, &
                                        state%roll_rate, state%yaw_rate, state%pitch_rate, &
                                        state%pitch_rate_difference, rail%y_rate, rail%z_rate, &
                                        rail%roll_rate]) > 0.0_wp)
        end associate
    end function is_at_rest

    elemental type(rail_state_t) function mirrored_rail(rail) result(mirrored)
        type(rail_state_t), intent(in) :: rail

        mirrored = rail
        mirrored%y = -rail%y
        mirrored%roll = -rail%roll
        mirrored%y_rate = -rail%y_rate
        mirrored%roll_rate = -rail%roll_rate
    end function mirrored_rail

    !> Refuse states that are no numbers or out of all range.
    pure subroutine check_state(state, status)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s
        type(status_t), intent(out) :: status       !! `st_bad_argument`

        integer :: i

        call clear_status(status)
        call check_value('y', state%y, largest_place, 'mm', status)
        call check_value('z', state%z, largest_place, 'mm', status)
        call check_value('roll', state%roll, largest_turn, 'rad', status)
        call check_value('yaw', state%yaw, largest_turn, 'rad', status)
        call check_value('speed', state%speed, huge(1.0_wp), 'mm/s', status)
        call check_value('y_rate', state%y_rate, huge(1.0_wp), 'mm/s', status)
        call check_value('z_rate', state%z_rate, huge(1.0_wp), 'mm/s', status)
        call check_value('roll_rate', state%roll_rate, huge(1.0_wp), 'rad/s', status)
        call check_value('yaw_rate', state%yaw_rate, huge(1.0_wp), 'rad/s', status)
        call check_value('pitch_rate', state%pitch_rate, huge(1.0_wp), 'rad/s', status)
        call check_value('pitch_rate_difference', state%pitch_rate_difference, huge(1.0_wp), &
                         'rad/s', status)
        call check_value('curvature', state%curvature, 1.0_wp, '1/mm', status)
        do i = 1, size(state%rail)
            associate (rail => state%rail(i))
                call check_value('y of a rail', rail%y, largest_place, 'mm', status)
                call check_value('z of a rail', rail%z, largest_place, 'mm', status)
                call check_value('roll of a rail', rail%roll, largest_turn, 'rad', status)
                call check_value('y_rate of a rail', rail%y_rate, huge(1.0_wp), 'mm/s', status)
                call check_value('z_rate of a rail', rail%z_rate, huge(1.0_wp), 'mm/s', status)
                call check_value('roll_rate of a rail', rail%roll_rate, huge(1.0_wp), 'rad/s', &
                                 status)
            end associate
        end do
    end subroutine check_state

    ! A finite number within a range.
    pure subroutine check_value(name, value, largest, unit, status)
        character(len=*), intent(in) :: name, unit
        real(wp), intent(in) :: value, largest
        type(status_t), intent(inout) :: status

        character(len=48) :: mistake
        logical :: valid

        if (status%code /= 0) return
        valid = ieee_is_finite(value)
        if (valid) valid = abs(value) <= largest
        if (valid) return
        mistake = ''
        if (unit == 'rad') mistake = likely_mistake(of_turn, value)
        if (largest < huge(1.0_wp)) then
            call set_status(status, st_bad_argument, name // ' of the wheelset must be within ' // &
                            '+-' // trim(number_text(largest)) // ' ' // unit // ', got ' // &
                            trim(number_text(value)) // mistake)
        else
            call set_status(status, st_bad_argument, name // ' of the wheelset must be a finite ' &
                            // 'number of ' // unit // ', got ' // number_text(value))
        end if
    end subroutine check_value

    !> The axes of a wheelset and its centre.
    pure type(wheelset_axes_t) function wheelset_axes(state, radius) result(axes)
        type(wheelset_state_t), intent(in) :: state !! mm, rad
        real(wp), intent(in) :: radius              !! mean of the nominal radii, mm

        associate (roll => state%roll, yaw => state%yaw)
            axes%ahead = [cos(yaw), sin(yaw)*cos(roll), sin(yaw)*sin(roll)]
            axes%axle = [-sin(yaw), cos(yaw)*cos(roll), cos(yaw)*sin(roll)]
            axes%down = [0.0_wp, -sin(roll), cos(roll)]
            axes%centre = [0.0_wp, state%y, state%z - radius]
        end associate
    end function wheelset_axes

    !> Creepages of rigid bodies at a point of the wheel: velocity of the rail relative to the wheel
    !> over the rolling speed, in the contact frame, turned by the contact angle about x. The
    !> rolling speed is the mean of that of travel and that of the wheel's surface about its axle,
    !> the right wheel's. On a roller the wheelset stays where it is: its surface's speed is that of
    !> travel, and it turns, too.
    !>
    !> Where a wheelset starts or stops the ratio has no bound, but forces have a limit: all slides,
    !> and only the proportions of the velocities count. So the speed is at least a millionth of
    !> what slides: creepages times the speed are always the velocities. With a floor the speed is
    !> the root of the sum of its square and the floor's, so that forces vanish with the velocities.
    pure subroutine rigid_creepage(state, axes, point, angle, creepage, speed, moving, floor, &
                                   roller)
        type(wheelset_state_t), intent(in) :: state  !! mm, rad, s; its pitch rate is said
        type(wheelset_axes_t), intent(in) :: axes    !! of the state
        real(wp), intent(in) :: point(3)             !! of the wheel, in the track, mm
        real(wp), intent(in) :: angle                !! contact angle, rad
        type(creepage_t), intent(out) :: creepage    !! zero if nothing moves; -, -, rad/mm
        real(wp), intent(out) :: speed               !! rolling speed, mm/s
        real(wp), intent(in), optional :: moving(3)  !! velocity of the rail there, mm/s
        real(wp), intent(in), optional :: floor      !! of the speed, mm/s
        type(on_roller_t), intent(in), optional :: roller !! below the wheel, if there is one

        real(wp) :: arm(3), pitch(3), turning(3), travel(3), rolled(3), velocity(3), slip(3), &
            fastest

        arm = point - axes%centre
        pitch = right_pitch_rate(state)*axes%axle
        ! The track itself turns in a curve, with all that is on it.
        turning = state%roll_rate*axes%ahead + state%yaw_rate*axes%down &
                  + [0.0_wp, 0.0_wp, state%speed*state%curvature]
        travel = [state%speed, state%y_rate, state%z_rate] &
                 + cross([0.0_wp, 0.0_wp, state%speed*state%curvature], axes%centre) &
                 + cross(turning, arm)
        rolled = cross(pitch, arm)
        velocity = travel + rolled
        turning = turning + pitch
        if (present(roller)) then
            if (roller%radius > 0.0_wp) call roll_along(roller, state%speed, travel, rolled, &
                                                        velocity, turning)
        end if
        speed = 0.5_wp*(abs(travel(1)) + abs(rolled(1)))
        if (present(floor)) speed = hypot(speed, floor)
        creepage = creepage_t()
        if (present(moving)) velocity = velocity - along_roller(moving, roller)
        slip = -[velocity(1), velocity(2)*cos(angle) + velocity(3)*sin(angle), &
                 turning(3)*cos(angle) - turning(2)*sin(angle)]
        fastest = maxval(abs(slip))
        if (speed > 0.0_wp .and. fastest/largest_ratio <= speed) then
            slip = slip/speed
        else if (fastest > 0.0_wp) then
            slip = largest_ratio*(slip/fastest)
            speed = fastest/largest_ratio
        else
            return
        end if
        creepage = creepage_t(slip(1), slip(2), slip(3))
    end subroutine rigid_creepage

    ! Velocities of a wheel that travels, as those of one on a roller, in the frame turned to their
    ! contact.
    pure subroutine roll_along(roller, speed, travel, rolled, velocity, turning)
        type(on_roller_t), intent(in) :: roller
        real(wp), intent(in) :: speed ! of travel, which the wheel does not have, mm/s
        real(wp), intent(inout) :: travel(3), rolled(3), velocity(3), turning(3) ! mm/s, rad/s

        real(wp) :: shown(3)

        shown = [roller%radius*roller%rate, 0.0_wp, 0.0_wp]
        travel(1) = travel(1) - speed
        velocity(1) = velocity(1) - speed
        turning(2) = turning(2) - roller%rate
        travel = along_roller(travel, roller) + shown
        velocity = along_roller(velocity, roller) + shown
        rolled = along_roller(rolled, roller)
        turning = along_roller(turning, roller)
    end subroutine roll_along

    ! A vector of the track in the frame that is turned to a contact on a roller; as it is on rails.
    pure function along_roller(vector, roller) result(along)
        real(wp), intent(in) :: vector(3)
        type(on_roller_t), intent(in), optional :: roller
        real(wp) :: along(3)

        along = vector
        if (.not. present(roller)) return
        if (.not. abs(roller%turn) > 0.0_wp) return
        associate (c => cos(roller%turn), s => sin(roller%turn))
            along([1, 3]) = [vector(1)*c + vector(3)*s, vector(3)*c - vector(1)*s]
        end associate
    end function along_roller

    !> How fast a wheel and its rail approach each other at a point, along the normal, mm/s. Neither
    !> travel nor pitch count: a rail is the same along x, and a wheel all around.
    pure real(wp) function approach_rate(state, axes, point, angle, moving, roller) result(rate)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s
        type(wheelset_axes_t), intent(in) :: axes   !! of the state
        real(wp), intent(in) :: point(3)            !! of the wheel, in the track, mm
        real(wp), intent(in) :: angle               !! contact angle, rad
        real(wp), intent(in) :: moving(3)           !! velocity of the rail there, mm/s
        type(on_roller_t), intent(in), optional :: roller !! below the wheel, if there is one

        real(wp) :: velocity(3)

        velocity = [0.0_wp, state%y_rate, state%z_rate] - moving &
                   + cross(state%roll_rate*axes%ahead + state%yaw_rate*axes%down, &
                           point - axes%centre)
        velocity = along_roller(velocity, roller)
        rate = velocity(3)*cos(angle) - velocity(2)*sin(angle)
    end function approach_rate

    !> Velocity of a point of a rail, mm/s.
    pure function rail_velocity(rail, arm) result(velocity)
        type(rail_state_t), intent(in) :: rail !! mm, rad, s
        real(wp), intent(in) :: arm(2)         !! y, z of the point from the rail's origin, mm
        real(wp) :: velocity(3)                !! in the track, mm/s

        velocity = [0.0_wp, rail%y_rate - rail%roll_rate*arm(2), &
                    rail%z_rate + rail%roll_rate*arm(1)]
    end function rail_velocity

    !> Vector product.
    pure function cross(a, b) result(c)
        real(wp), intent(in) :: a(3) !! any unit
        real(wp), intent(in) :: b(3) !! any unit
        real(wp) :: c(3)             !! product of the units

        c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
    end function cross
end module faststrip_geometry_wheelset_state
