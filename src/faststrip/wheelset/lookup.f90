!> A wheel whose table answers for it: from its height or its load to the forces of its contacts.
!>
!> A table knows a wheel and rail whose roll is the same. Where it is not, or where the rail has
!> moved, the table is asked for the wheelset that has the wheel's point of contact where it is, and
!> no roll to the rail: what is left out is that the wheel's profile is inclined by the roll, which
!> moves the contact by the roll over the difference of curvatures.
!>
!> Strips take over before a table ends: from a quarter of its last cell on along y, yaw and load,
!> and over the last fifth of the roll, its share in forces, moments and heights falls to 0 at the
!> end, linearly.
module faststrip_wheelset_lookup
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_contact_case, only: contact_case_t
    use faststrip_geometry_contact_frame, only: contact_frame_t
    use faststrip_geometry_profile, only: profile_at
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_origin, turned
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, rail_state_t, &
                                                 wheelset_axes
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: n_contact_numbers, most_slots, at_load, at_angle, &
                                      at_rail_y, at_rail_z, at_ahead, at_wheel_y, at_radius, &
                                      at_height, at_area, at_pmax
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, load_at_height, &
                                      is_in_table, n_wheel_place
    use faststrip_wheelset_types, only: wheelset_model_t, wheel_result_t, wheel_contact_t
    use faststrip_wheelset_wheel, only: add_contacts
    use faststrip_wheelset_wheel_motion, only: find_motion, take_motion, place_on_wheel, &
                                               find_contact_force
    implicit none
    private

    public :: look_up_at_height, look_up_at_load

    ! Tuned [passes]: to find the place of a wheel with roll. Origin: the third changes nothing.
    integer, parameter :: roll_passes = 3
    ! Tuned [rad]: roll of a wheel over its rail beyond which a table, which is of none, has no
    ! answer. Origin: measured: up to 0.4 mrad forces keep a promise of 0.03, with 1 mrad they miss
    ! strips by 0.06.
    real(wp), parameter :: largest_tilt = 5.0e-4_wp
    ! Tuned [rad]: over which it hands over to strips before. Origin: that measurement.
    real(wp), parameter :: tilt_way = 1.0e-4_wp
    ! Tuned [cells]: of an end, over which the table does. Origin: chosen: what it misses, 1 % of a
    ! load, moves forces by less than a lateral displacement does.
    real(wp), parameter :: end_way = 0.25_wp
    ! Tuned [rad]: how far beside the one yaw of a table it answers alone, and from where on strips
    ! do. Origin: chosen: above the steps of derivatives; places move by 2 um on a flange.
    real(wp), parameter :: yaw_alone = 1.0e-7_wp, yaw_beside = 1.0e-4_wp
    ! Tuned [1]: how far within a table's ends of load a search stays. Origin: chosen: the table's
    ! share is next to nothing there.
    real(wp), parameter :: within_ends = 1.0e-6_wp
    ! Tuned [1]: vertical force that is found, of the load. Origin: chosen: far below what tables
    ! miss.
    real(wp), parameter :: near_enough = 1.0e-9_wp

contains

    !> A wheel at a height.
    subroutine look_up_at_height(model, pair, state, z, wheel, share)
        type(wheelset_model_t), intent(in) :: model  !! made, with its table
        type(wheel_on_rail_t), intent(in) :: pair    !! of this side
        type(wheelset_state_t), intent(in) :: state  !! as of a right wheel; its z does not count
        real(wp), intent(in) :: z                    !! of the wheelset's centre, mm
        type(wheel_result_t), intent(inout) :: wheel !! as of a right wheel, if it is there
        real(wp), intent(out) :: share               !! that it has: 0, beyond the table, to 1

        real(wp) :: load, height, contacts(n_contact_numbers, most_slots), place(n_wheel_place)

        height = z
        load = 0.0_wp
        call find_place(model, pair, state, .false., load, height, place, contacts, share)
        if (share > 0.0_wp) call find_forces(model, pair, state, place, height, contacts, wheel, &
                                             share)
    end subroutine look_up_at_height

    !> A wheel that carries a load: the vertical part of all its forces, on the rail.
    subroutine look_up_at_load(model, pair, state, wanted, wheel, share)
        type(wheelset_model_t), intent(in) :: model  !! made, with its table
        type(wheel_on_rail_t), intent(in) :: pair    !! of this side
        type(wheelset_state_t), intent(in) :: state  !! as of a right wheel; its z does not count
        real(wp), intent(in) :: wanted               !! above 0, N
        type(wheel_result_t), intent(inout) :: wheel !! as of a right wheel, if it is there
        real(wp), intent(out) :: share               !! that it has: 0, beyond the table, to 1

        real(wp) :: load, height, contacts(n_contact_numbers, most_slots), place(n_wheel_place)
        real(wp) :: miss, load_before, miss_before, slope
        integer :: i

        ! Of normal forces: friction has its part of the load, which may lie beyond the table.
        load = within(wanted)
        load_before = 0.0_wp
        miss_before = -wanted
        do i = 1, most_steps
            height = 0.0_wp
            call find_place(model, pair, state, .true., load, height, place, contacts, share)
            if (share > 0.0_wp) call find_forces(model, pair, state, place, height, contacts, &
                                                 wheel, share)
            if (.not. share > 0.0_wp) return
            miss = wheel%force(3) - wanted
            if (abs(miss) <= near_enough*wanted) return
            slope = (miss - miss_before)/(load - load_before)
            load_before = load
            miss_before = miss
            load = within(load - miss/slope)
            ! An end is held.
            if (load == load_before) exit
        end do
        share = 0.0_wp

    contains

        pure real(wp) function within(load)
            real(wp), intent(in) :: load

            associate (axis => model%lookup%wheel%load)
                within = max(axis%x(1)*(1.0_wp + within_ends), &
                             min(load, axis%x(axis%n)*(1.0_wp - within_ends)))
            end associate
        end function within
    end subroutine look_up_at_load

    ! Where the table has the wheel, and its contacts there: from the height to the load, or back.
    subroutine find_place(model, pair, state, is_given, load, z, place, contacts, share)
        type(wheelset_model_t), intent(in) :: model
        type(wheel_on_rail_t), intent(in) :: pair
        type(wheelset_state_t), intent(in) :: state
        logical, intent(in) :: is_given
        real(wp), intent(inout) :: load, z
        real(wp), intent(out) :: place(n_wheel_place)
        real(wp), intent(out) :: contacts(n_contact_numbers, most_slots)
        real(wp), intent(out) :: share

        type(status_t) :: status
        real(wp) :: centre(2), design(2), lies(2), arm(2), moved(2), tilt, yaw, share_of_yaw
        integer :: pass, passes, main
        logical :: is_there

        associate (rail => state%rail(1))
            tilt = state%roll - rail%roll
            share = 0.0_wp
            if (.not. abs(tilt) <= largest_tilt) return
            passes = 1
            if (max(abs(tilt), abs(rail%roll)) > 0.0_wp) passes = roll_passes
            yaw = state%yaw
            share_of_yaw = 1.0_wp
            associate (axis => model%lookup%wheel%yaw)
                if (axis%n == 1) then
                    share_of_yaw = (yaw_beside - abs(yaw - axis%x(1)))/(yaw_beside - yaw_alone)
                    if (.not. share_of_yaw > 0.0_wp) return
                    yaw = axis%x(1)
                end if
            end associate
            lies = rail_origin(pair, rail)
            design = rail_origin(pair, rail_state_t())
            arm = [pair%y_line, pair%radius]
            do pass = 1, passes
                ! The wheelset's centre over a rail that lies as in the design; then without roll.
                centre = turned([state%y, z - model%radius] - lies, -rail%roll) + design
                moved = turned(arm, tilt) - arm
                place = [centre(1) + moved(1), yaw, load]
                is_there = .true.
                if (.not. is_given) &
                    call load_at_height(model%lookup, model%lookup_order, place(1), place(2), &
                                        centre(2) + model%radius + moved(2), place(3), is_there)
                ! Not by a status: words would be allocated for it.
                if (is_there) is_there = is_in_table(model%lookup, place)
                if (.not. is_there) return
                call look_up_contacts(model%lookup, model%lookup_order, place, contacts, status)
                if (is_error(status)) return
                main = maxloc(contacts(at_load, :), dim=1)
                arm = [pair%y_line + contacts(at_wheel_y, main), contacts(at_radius, main)]
                if (.not. is_given) cycle
                centre(2) = contacts(at_height, main) - moved(2) - model%radius
                centre = turned(centre - design, rail%roll) + lies
                z = centre(2) + model%radius
            end do
            associate (wheel => model%lookup%wheel)
                share = min(1.0_wp, share_of_yaw, (largest_tilt - abs(tilt))/tilt_way, &
                            share_along(wheel%y, place(1)), share_along(wheel%yaw, place(2)), &
                            share_along(wheel%load, place(3)))
            end associate
        end associate
    end subroutine find_place

    ! How far a place is from the nearer end of an axis, over the way of the hand-over. An axis of
    ! one node has none.
    pure real(wp) function share_along(axis, x) result(share)
        type(lookup_axis_t), intent(in) :: axis
        real(wp), intent(in) :: x ! within the axis

        share = 1.0_wp
        if (axis%n > 1) &
            share = min((x - axis%x(1))/(axis%x(2) - axis%x(1)), &
                        (axis%x(axis%n) - x)/(axis%x(axis%n) - axis%x(axis%n - 1)))/end_way
    end function share_along

    ! Creepages, forces and moments of all contacts, along y.
    subroutine find_forces(model, pair, state, place, z, contacts, wheel, share)
        type(wheelset_model_t), intent(in) :: model
        type(wheel_on_rail_t), intent(in) :: pair
        type(wheelset_state_t), intent(in) :: state
        real(wp), intent(in) :: place(n_wheel_place), z, contacts(n_contact_numbers, most_slots)
        type(wheel_result_t), intent(inout) :: wheel
        real(wp), intent(inout) :: share ! 0: there are none

        type(wheelset_state_t) :: lowered
        type(wheelset_axes_t) :: axes
        type(contact_case_t) :: case
        integer :: slot
        logical :: rest(most_slots), is_there

        lowered = state
        lowered%z = z
        axes = wheelset_axes(lowered, model%radius)
        case = model%case
        call clear_status(wheel%status)
        wheel%z = z
        wheel%solutions = 0
        wheel%n = 0
        rest = contacts(at_load, :) > 0.0_wp
        do while (any(rest))
            slot = minloc(contacts(at_rail_y, :), dim=1, mask=rest)
            rest(slot) = .false.
            wheel%n = wheel%n + 1
            wheel%contact(wheel%n) = wheel_contact_t()
            call find_contact(model, pair, lowered, axes, place, slot, contacts(:, slot), case, &
                              wheel%contact(wheel%n), is_there)
            if (.not. is_there) share = 0.0_wp
            if (.not. is_there) return
        end do
        call add_contacts(wheel)
        if (wheel%n == 0) share = 0.0_wp
    end subroutine find_forces

    subroutine find_contact(model, pair, state, axes, place, slot, numbers, case, contact, is_there)
        type(wheelset_model_t), intent(in) :: model
        type(wheel_on_rail_t), intent(in) :: pair
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_axes_t), intent(in) :: axes
        real(wp), intent(in) :: place(n_wheel_place), numbers(n_contact_numbers)
        integer, intent(in) :: slot
        type(contact_case_t), intent(inout) :: case
        type(wheel_contact_t), intent(inout) :: contact
        logical, intent(out) :: is_there

        type(status_t) :: status
        real(wp) :: height, slope, bend, forces(n_forces)

        associate (rail => state%rail(1), figures => contact%figures, c => contact%creepage)
            contact%rail = numbers(at_rail_y:at_rail_z)
            contact%place = [numbers(at_ahead), rail_origin(pair, rail) &
                             + turned(contact%rail, rail%roll)]
            contact%angle = numbers(at_angle) + rail%roll
            call place_on_wheel(pair, axes, contact%place, contact)
            ! The wheel's surface before it is deformed lies below the rail's.
            call profile_at(pair%wheel, contact%wheel(2), height, slope, bend, status)
            is_there = .not. is_error(status)
            if (.not. is_there) return
            case%penetration = max(pair%radius + height - pair%z_line - contact%radius, 0.0_wp) &
                               *cos(contact%angle)
            call find_motion(model, pair, state, axes, &
                             contact_frame_t(contact%place, contact%angle), case, contact)
            call take_motion(model, contact, case)
            call look_up_wheel(model%lookup, model%lookup_order, slot, &
                               [place, case%mu, c%cksi, c%ceta, c%cphi], forces, status)
            is_there = .not. is_error(status)
            if (.not. is_there) return
            figures%normal%load = numbers(at_load)
            figures%normal%penetration = case%penetration
            figures%normal%area = numbers(at_area)
            figures%normal%pmax = numbers(at_pmax)
            figures%tangential%fx = forces(1)
            figures%tangential%fy = forces(2)
            figures%tangential%mz = forces(3)
            figures%tangential%friction_power = &
                max(-dot_product(forces, [c%cksi, c%ceta, c%cphi]), 0.0_wp)
            call find_contact_force(model, axes, contact)
        end associate
    end subroutine find_contact
end module faststrip_wheelset_lookup
