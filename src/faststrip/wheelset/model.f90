!> A wheelset on its track: made, with damping, springs or rollers, and reserved for.
module faststrip_wheelset_model
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_contact_case, only: contact_case_t, keeps_elements
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field
    use faststrip_geometry_contact_frame, only: reserve_frame_gap
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_profile, only: profile_t
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, check_roller
    use faststrip_geometry_wheel_on_rail, only: make_wheel_on_rail, put_on_roller
    use faststrip_geometry_wheel_outline, only: reserve_outline
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_guide, only: needs_guide, take_guide
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, side_right, &
                                        side_left, most_contacts
    implicit none
    private

    public :: make_wheelset, set_damping, set_rail_stiffness, set_roller, reserve_wheelset
    public :: check_damping, check_rail_stiffness, check_on_rollers, check_workspace

contains

    !> Put a wheelset on a track.
    subroutine make_wheelset(wheels, rails, wheelset, radius_left, track, case, model, status)
        type(profile_t), intent(in) :: wheels(2)     !! right and left, both as a right wheel
        type(profile_t), intent(in) :: rails(2)      !! right and left, both as a right rail, canted
        type(wheelset_t), intent(in) :: wheelset     !! mm; its radius is that of the right wheel
        real(wp), intent(in) :: radius_left          !! nominal radius of the left wheel, mm
        type(track_t), intent(in) :: track           !! mm
        type(contact_case_t), intent(in) :: case     !! material, friction, methods
        type(wheelset_model_t), intent(inout) :: model !! made
        type(status_t), intent(out) :: status
            !! `st_bad_argument`, `st_out_of_range`: dimensions, profiles

        type(wheelset_t) :: left

        left = wheelset
        left%radius = radius_left
        model%case = case
        ! Solutions copy the case: without a gap that allocates nothing.
        model%case%gap = gap_t()
        model%radius = 0.5_wp*(wheelset%radius + radius_left)
        call make_wheel_on_rail(wheels(side_right), rails(side_right), wheelset, track, &
                                model%pair(side_right), status)
        if (is_error(status)) return
        call make_wheel_on_rail(wheels(side_left), rails(side_left), left, track, &
                                model%pair(side_left), status)
    end subroutine make_wheelset

    !> Contact damping of a wheelset, and the floor of its rolling speeds.
    pure subroutine set_damping(model, damping, speed_floor, status)
        type(wheelset_model_t), intent(inout) :: model !! changed unless there is an error
        real(wp), intent(in) :: damping
            !! share by which forces grow with the approach rate, s/mm; 0: none
        real(wp), intent(in) :: speed_floor
            !! below which forces grow with the velocities, mm/s; 0: none
        type(status_t), intent(out) :: status !! `st_bad_argument`: below 0, or no number

        call check_damping(damping, speed_floor, status)
        if (is_error(status)) return
        model%damping = damping
        model%speed_floor = speed_floor
    end subroutine set_damping

    !> Refuse what `set_damping` would.
    pure subroutine check_damping(damping, speed_floor, status)
        real(wp), intent(in) :: damping, speed_floor !! s/mm, mm/s
        type(status_t), intent(out) :: status        !! `st_bad_argument`

        call clear_status(status)
        if (.not. (damping >= 0.0_wp .and. ieee_is_finite(damping))) then
            call set_status(status, st_bad_argument, 'contact damping must be at least 0 s/mm, ' &
                            // 'got ' // number_text(damping))
        else if (.not. (speed_floor >= 0.0_wp .and. ieee_is_finite(speed_floor))) then
            call set_status(status, st_bad_argument, 'the floor of the speed must be at least ' // &
                            '0 mm/s, got ' // number_text(speed_floor))
        end if
    end subroutine check_damping

    !> Springs below both rails, which give way along y and z.
    pure subroutine set_rail_stiffness(model, stiffness, status)
        type(wheelset_model_t), intent(inout) :: model !! changed unless there is an error
        real(wp), intent(in) :: stiffness(2)           !! along y and z, N/mm; 0: rigid
        type(status_t), intent(out) :: status          !! `st_bad_argument`: below 0, or too large

        call check_rail_stiffness(stiffness, status)
        if (.not. is_error(status)) model%rail_stiffness = stiffness
    end subroutine set_rail_stiffness

    !> Refuse what `set_rail_stiffness` would.
    pure subroutine check_rail_stiffness(stiffness, status)
        real(wp), intent(in) :: stiffness(2)  !! N/mm
        type(status_t), intent(out) :: status !! `st_bad_argument`

        integer :: i

        call clear_status(status)
        do i = 1, 2
            if (.not. (stiffness(i) >= 0.0_wp .and. stiffness(i) <= largest_size)) &
                call set_status(status, st_bad_argument, 'the stiffness below a rail must be 0 ' &
                                // 'to ' // trim(number_text(largest_size)) // ' N/mm, got ' // &
                                number_text(stiffness(i)))
        end do
    end subroutine check_rail_stiffness

    !> Put a wheelset on rollers, both on one axis along y, or back on rails. It has to be reserved
    !> anew.
    pure subroutine set_roller(model, radius, status)
        type(wheelset_model_t), intent(inout) :: model !! made; changed unless there is an error
        real(wp), intent(in) :: radius                 !! at z = 0 of the track, mm; 0: rails
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: below 0, no number, not above the depth of the profiles

        integer :: side

        call clear_status(status)
        do side = side_right, side_left
            if (radius /= 0.0_wp) &
                call check_roller(radius, maxval(model%pair(side)%sample), status)
        end do
        if (is_error(status)) return
        do side = side_right, side_left
            call put_on_roller(model%pair(side), radius)
        end do
    end subroutine set_roller

    !> Refuse what a wheelset on rollers, whose rails are all of revolution about y, cannot have.
    subroutine check_on_rollers(model, state, status)
        type(wheelset_model_t), intent(in) :: model   !! made
        type(wheelset_state_t), intent(in) :: state   !! that is asked
        type(status_t), intent(inout) :: status       !! `st_bad_argument`, unless it is an error

        if (is_error(status) .or. .not. any(model%pair%roller_radius > 0.0_wp)) return
        call check_none('curvature', state%curvature, '1/mm')
        call check_none('roll of a rail', maxval(abs(state%rail%roll)), 'rad')
        call check_none('roll_rate of a rail', maxval(abs(state%rail%roll_rate)), 'rad/s')

    contains

        subroutine check_none(name, value, unit)
            character(len=*), intent(in) :: name, unit
            real(wp), intent(in) :: value

            if (abs(value) > 0.0_wp .and. .not. is_error(status)) &
                call set_status(status, st_bad_argument, name // ' of a wheelset on rollers ' // &
                                'must be 0 ' // unit // ', got ' // number_text(value))
        end subroutine check_none
    end subroutine check_on_rollers

    !> Allocate for a model; the only allocation.
    subroutine reserve_wheelset(workspace, model, status)
        type(wheelset_workspace_t), intent(inout) :: workspace !! sized
        type(wheelset_model_t), intent(in) :: model            !! made
        type(status_t), intent(out) :: status                  !! those of `reserve_workspace`

        type(contact_case_t) :: guide
        integer :: side, i

        call clear_status(status)
        guide%methods = model%case%methods
        call take_guide(guide)
        workspace%has_last = .false.
        if (.not. allocated(workspace%near)) allocate (workspace%near(1))
        do side = side_right, side_left
            associate (wheel => workspace%wheel(side), pair => model%pair(side))
                if (.not. allocated(pair%y)) then
                    call set_status(status, st_bad_argument, 'the wheelset must be made first')
                    return
                else if (model%case%asked%subsurface) then
                    call set_status(status, st_bad_argument, 'stresses below the surface are ' // &
                                    'those of one contact, not of a wheelset')
                    return
                end if
                wheel%n = 0
                wheel%approach = 0.0_wp
                call reserve_frame_gap(wheel%gap, pair)
                call reserve_outline(wheel%outline, pair)
                if (.not. allocated(wheel%contact)) allocate (wheel%contact(most_contacts))
                do i = 1, most_contacts
                    if (needs_guide(model%case)) &
                        call reserve_workspace(wheel%contact(i), guide%methods, size(pair%y), &
                                               status)
                    if (is_error(status)) return
                    call reserve_workspace(wheel%contact(i), model%case%methods, size(pair%y), &
                                           status)
                    if (keeps_elements(model%case) .and. .not. is_error(status)) &
                        call reserve_contact_field(wheel%contact(i), model%case%methods, status)
                    if (is_error(status)) return
                end do
            end associate
        end do
    end subroutine reserve_wheelset

    !> Refuse a workspace that was reserved for another model, or not at all.
    subroutine check_workspace(model, workspace, status)
        type(wheelset_model_t), intent(in) :: model           !! made
        type(wheelset_workspace_t), intent(in) :: workspace   !! to be solved in
        type(status_t), intent(inout) :: status               !! `st_workspace_too_small`

        integer :: side
        logical :: fits

        do side = side_right, side_left
            associate (wheel => workspace%wheel(side), pair => model%pair(side))
                fits = allocated(wheel%outline%x) .and. allocated(pair%y)
                if (fits) fits = size(wheel%outline%x) == size(pair%y) &
                                 .and. wheel%outline%mark == pair%mark
            end associate
            if (.not. fits) &
                call set_status(status, st_workspace_too_small, &
                                'no workspace was reserved for this wheelset')
        end do
    end subroutine check_workspace
end module faststrip_wheelset_model
