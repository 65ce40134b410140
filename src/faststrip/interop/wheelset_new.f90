!> The making of the C and F77 interfaces' wheelsets, from the dimensions and where profiles come
!> from.
module faststrip_interop_wheelset_new
    use, intrinsic :: iso_c_binding, only: c_double, c_intptr_t, c_loc
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_not_finite
    use faststrip_contact_case, only: contact_case_t
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_gauge_fit, only: find_back_spacing
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_curve_profile, unset_inclination
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_geometry_touchable, only: touchable_t, body_wheel, body_rail
    use faststrip_interop_register, only: enter_register, kind_wheelset
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, allocate_wheelset, &
                                                 allocate_workspace
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_wheelset_model, only: make_wheelset, set_damping, set_rail_stiffness, &
                                        reserve_wheelset
    use faststrip_wheelset_types, only: side_right, side_left
    implicit none
    private

    public :: dimensions_t, profile_source_t, source_name_length, default_dimensions, &
              new_wheelset, &
              take_dimensions, make_profiles, make_profile

    !> Characters of a profile's name.
    !> Given: capacity.
    integer, parameter :: source_name_length = 16

    !> Dimensions of a wheelset on its track, in the order of the header and of F77's SETUP.
    type, bind(c) :: dimensions_t
        real(c_double) :: radius_right, radius_left !! nominal, mm
        real(c_double) :: back_spacing  !! of the flange backs, mm; 0: as belongs to the gauge
        real(c_double) :: tread_line    !! flange back to nominal rolling circle, mm
        real(c_double) :: gauge         !! mm
        real(c_double) :: gauge_depth   !! below the crown, mm
        real(c_double) :: rail_distance !! of the rails' origins, mm; 0: as the gauge says
        real(c_double) :: inclination
            !! of the rails, its tangent; 999: not said, 1:40 of names, an error of points
        real(c_double) :: roller_radius !! of rollers in the rails' place, mm; 0: rails
    end type dimensions_t

    !> Where a profile comes from: a name, or points; neither for one that is as the right one.
    type :: profile_source_t
        character(len=source_name_length) :: name = ''
        real(wp), pointer :: y(:) => null() !! to the field side, mm
        real(wp), pointer :: z(:) => null() !! down, mm
    end type profile_source_t

contains

    !> Standard gauge, wheels of 460 mm, no word of the rails' inclination.
    pure type(dimensions_t) function default_dimensions() result(dimensions)
        type(wheelset_t) :: wheelset
        type(track_t) :: track

        dimensions = dimensions_t(wheelset%radius, wheelset%radius, wheelset%back_spacing, &
                                  wheelset%tread_line, track%gauge, track%gauge_depth, &
                                  track%rail_distance, unset_inclination, track%roller_radius)
    end function default_dimensions

    !> Make a wheelset on its track. The one allocation.
    subroutine new_wheelset(wheels, rails, dimensions, case, number, status, damping, speed_floor, &
                            rail_stiffness)
        type(profile_source_t), intent(in) :: wheels(2) !! right and left, both as a right wheel
        type(profile_source_t), intent(in) :: rails(2)  !! right and left, both as a right rail
        type(dimensions_t), intent(in) :: dimensions    !! mm
        type(contact_case_t), intent(in) :: case        !! material, friction, methods
        integer(c_intptr_t), intent(out) :: number      !! of the handle; 0 when there is an error
        type(status_t), intent(out) :: status
            !! those of `make_wheelset`, `set_damping`, `set_rail_stiffness`, `reserve_wheelset`
            !! and of profiles
        real(c_double), intent(in), optional :: damping, speed_floor !! as `set_damping` has them
        real(c_double), intent(in), optional :: rail_stiffness(2)
            !! as `set_rail_stiffness` has it

        type(wheelset_handle_t), pointer :: handle
        type(environment_t) :: environment

        number = 0
        call allocate_wheelset(handle, status)
        if (is_error(status)) return
        call hold_environment(environment)
        call allocate_workspace(handle, status)
        if (.not. is_error(status)) &
            call fill_handle(wheels, rails, dimensions, case, handle, status)
        if (present(damping) .and. present(speed_floor) .and. .not. is_error(status)) &
            call set_damping(handle%model, damping, speed_floor, status)
        if (present(rail_stiffness) .and. .not. is_error(status)) &
            call set_rail_stiffness(handle%model, rail_stiffness, status)
        call restore_environment(environment)
        if (.not. is_error(status)) &
            call enter_register(c_loc(handle), kind_wheelset, number, status)
        if (is_error(status)) deallocate (handle)
    end subroutine new_wheelset

    subroutine fill_handle(wheels, rails, dimensions, case, handle, status)
        type(profile_source_t), intent(in) :: wheels(2), rails(2)
        type(dimensions_t), intent(in) :: dimensions
        type(contact_case_t), intent(in) :: case
        type(wheelset_handle_t), intent(inout) :: handle
        type(status_t), intent(out) :: status

        type(profile_t), allocatable :: wheel(:), rail(:)
        type(wheelset_t) :: wheelset
        type(track_t) :: track

        allocate (wheel(2), rail(2))
        call take_dimensions(dimensions, wheelset, track, status)
        if (is_error(status)) return
        call make_profiles(wheels, body_wheel, 0.0_wp, wheel, status)
        if (.not. is_error(status)) &
            call make_profiles(rails, body_rail, dimensions%inclination, rail, status)
        if (.not. is_error(status)) &
            call make_wheelset(wheel, rail, wheelset, dimensions%radius_left, track, case, &
                               handle%model, status)
        if (.not. is_error(status)) &
            call reserve_wheelset(handle%workspace, handle%model, status)
    end subroutine fill_handle

    !> Wheelset and track of a setup.
    pure subroutine take_dimensions(dimensions, wheelset, track, status)
        type(dimensions_t), intent(in) :: dimensions  !! mm
        type(wheelset_t), intent(out) :: wheelset     !! mm; its radius is that of the right wheel
        type(track_t), intent(out) :: track           !! mm
        type(status_t), intent(out) :: status
            !! `st_not_finite`; `st_bad_argument`: no distance of the flange backs is known

        call clear_status(status)
        associate (d => dimensions)
            if (.not. all(ieee_is_finite([d%radius_right, d%radius_left, d%back_spacing, &
                                          d%tread_line, d%gauge, d%gauge_depth, d%rail_distance, &
                                          d%inclination, d%roller_radius]))) then
                call set_status(status, st_not_finite, 'the setup must be finite numbers')
                return
            end if
            wheelset = wheelset_t(d%back_spacing, d%tread_line, d%radius_right)
            track = track_t(d%gauge, d%gauge_depth, d%rail_distance, d%roller_radius)
            if (.not. abs(d%back_spacing) > 0.0_wp) &
                call find_back_spacing(track%gauge, track%rail_distance, wheelset%back_spacing, &
                                       status)
        end associate
    end subroutine take_dimensions

    !> The right and the left profile of one body.
    subroutine make_profiles(sources, body, inclination, profiles, status)
        type(profile_source_t), intent(in) :: sources(2) !! both as a right one
        integer, intent(in) :: body                      !! `body_wheel`, `body_rail`
        real(wp), intent(in) :: inclination              !! of rails; of wheels 0
        type(profile_t), intent(inout) :: profiles(2)    !! made
        type(status_t), intent(out) :: status            !! those of profiles

        integer :: side, n_out

        call clear_status(status)
        do side = side_right, side_left
            if (side == side_left .and. sources(side)%name == '' &
                .and. .not. associated(sources(side)%y)) then
                profiles(side_left) = profiles(side_right)
            else
                call make_profile(sources(side), body, inclination, profiles(side), n_out, status)
            end if
            if (is_error(status)) return
        end do
    end subroutine make_profiles

    !> One profile of a name, or of points.
    subroutine make_profile(source, body, inclination, profile, n_out, status)
        type(profile_source_t), intent(in) :: source !! as a right one
        integer, intent(in) :: body                  !! `body_wheel`, `body_rail`
        real(wp), intent(in) :: inclination          !! of a rail, its tangent, or
                                                     !! `unset_inclination`; of a wheel 0
        type(profile_t), intent(out) :: profile      !! made
        integer, intent(out) :: n_out                !! points that cannot be touched
        type(status_t), intent(out) :: status        !! those of profiles

        type(touchable_t) :: part

        n_out = 0
        if (associated(source%y)) then
            call make_curve_profile(source%y, source%z, body, inclination, standard_kink_angle, &
                                    profile, part, status)
            if (.not. is_error(status)) n_out = size(source%y) - size(part%point)
        else if (body == body_wheel) then
            call make_wheel_profile(trim(source%name), profile, status)
        else
            call make_rail_profile(trim(source%name), inclination, profile, status)
        end if
    end subroutine make_profile
end module faststrip_interop_wheelset_new
