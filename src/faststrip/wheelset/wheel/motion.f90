!> How a contact of a wheel moves, and the force that it has of it.
module faststrip_wheelset_wheel_motion
    use faststrip_base_friction, only: friction_at_angle, largest_speed
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio
    use faststrip_base_status, only: set_status, st_out_of_range
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: tangential_linear
    use faststrip_geometry_contact_frame, only: contact_frame_t, in_track, along_normal
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_origin
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, on_roller_t, &
                                                 rigid_creepage, approach_rate, rail_velocity, &
                                                 cross
    use faststrip_wheelset_types, only: wheelset_model_t, wheel_contact_t
    implicit none
    private

    public :: find_motion, take_motion, place_on_wheel, find_contact_force

    ! Falling friction takes a wheelset that rolls slower than this, in mm/s, as one that rolls so:
    ! slip is nothing there.
    real(wp), parameter :: least_speed = 1.0_wp/largest_speed

contains

    !> Creepages, speed and approach rate of a contact.
    subroutine find_motion(model, pair, state, axes, frame, case, contact)
        type(wheelset_model_t), intent(in) :: model      !! made
        type(wheel_on_rail_t), intent(in) :: pair        !! of this side
        type(wheelset_state_t), intent(in) :: state      !! as of a right wheel
        type(wheelset_axes_t), intent(in) :: axes        !! where the wheelset is
        type(contact_frame_t), intent(in) :: frame       !! of the contact
        type(contact_case_t), intent(in) :: case         !! its penetration is known
        type(wheel_contact_t), intent(inout) :: contact  !! gets them

        type(on_roller_t) :: roller
        real(wp) :: point(3), moving(3)

        ! Velocities are those of the wheel's surface before it is deformed.
        point = along_normal(frame, case%penetration + frame%lift)
        associate (rail => state%rail(1), c => contact%creepage)
            moving = rail_velocity(rail, frame%origin(2:3) - rail_origin(pair, rail))
            if (pair%roller_radius > 0.0_wp) then
                roller = on_roller_t(norm2(frame%origin([1, 3]) &
                                           - [0.0_wp, pair%roller_radius + rail%z]), &
                                     frame%turn, state%speed/pair%roller_radius)
            end if
            call rigid_creepage(state, axes, point, frame%angle, c, contact%speed, moving, &
                                model%speed_floor, roller)
            contact%approach_rate = approach_rate(state, axes, point, frame%angle, moving, roller)
            if (max(abs(c%cksi), abs(c%ceta), abs(c%cphi)) >= largest_ratio &
                .and. case%methods%tangential == tangential_linear) &
                call set_status(contact%status, st_out_of_range, 'linear forces have no limit ' // &
                                'where a wheelset slides but hardly rolls: take another method')
        end associate
    end subroutine find_motion

    !> Force and moment of a solved contact on its rail. Damping is that of Hunt and Crossley,
    !> N (1 + 3/2 alpha v), never below 0: it vanishes where bodies touch first. Friction is in
    !> proportion, which is exact where all slides.
    pure subroutine find_contact_force(model, axes, contact)
        type(wheelset_model_t), intent(in) :: model     !! made
        type(wheelset_axes_t), intent(in) :: axes       !! where the wheelset is
        type(wheel_contact_t), intent(inout) :: contact !! solved; gets them

        type(contact_frame_t) :: frame
        real(wp) :: damped

        frame = contact_frame_t(contact%place, contact%angle, contact%turn)
        associate (normal => contact%figures%normal, forces => contact%figures%tangential)
            damped = max(0.0_wp, 1.0_wp + model%damping*contact%approach_rate)
            contact%force = damped*in_track(frame, [forces%fx, forces%fy, normal%load])
            contact%force_wheelset = [dot_product(contact%force, axes%ahead), &
                                      dot_product(contact%force, axes%axle), &
                                      dot_product(contact%force, axes%down)]
            contact%moment = cross(frame%origin - axes%centre, contact%force) &
                             + damped*in_track(frame, [contact%figures%moment, forces%mz])
        end associate
    end subroutine find_contact_force

    !> Creepages of a contact, and the friction of its angle and speed.
    pure subroutine take_motion(model, contact, case)
        type(wheelset_model_t), intent(in) :: model  !! made
        type(wheel_contact_t), intent(in) :: contact !! its creepages, angle and speed are known
        type(contact_case_t), intent(inout) :: case  !! gets what follows of them

        case%creepage = contact%creepage
        case%mu = friction_at_angle(model%case%friction, model%case%mu, contact%angle)
        case%friction%speed = max(contact%speed, least_speed)
        case%friction%table%y_rail = contact%rail(1)
        case%friction%table%angle = contact%angle
        if (case%curved) then
            case%pitch = cos(contact%angle)/contact%radius
            if (model%pair(1)%roller_radius > 0.0_wp) &
                case%pitch = case%pitch + cos(contact%angle)/model%pair(1)%roller_radius
        end if
    end subroutine take_motion

    !> Where a point of the track is in the frame of the wheel's profile.
    pure subroutine place_on_wheel(pair, axes, point, contact)
        type(wheel_on_rail_t), intent(in) :: pair       !! of this side
        type(wheelset_axes_t), intent(in) :: axes       !! where the wheelset is
        real(wp), intent(in) :: point(3)                !! in the track, mm
        type(wheel_contact_t), intent(inout) :: contact !! gets the place and the rolling radius

        real(wp) :: arm(3), down

        arm = point - axes%centre
        down = dot_product(arm, axes%down)
        contact%wheel(1) = dot_product(arm, axes%ahead)
        contact%wheel(2) = dot_product(arm, axes%axle) - pair%y_line
        contact%wheel(3) = down - pair%radius + pair%z_line
        contact%radius = hypot(down, contact%wheel(1))
    end subroutine place_on_wheel
end module faststrip_wheelset_wheel_motion
