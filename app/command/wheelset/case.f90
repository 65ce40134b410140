!> The case of a wheelset: both wheels and rails, friction, methods, and one state or none.
module faststrip_command_wheelset_case
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_profile, only: profile_t
    use faststrip_contact_methods, only: normal_table, tangential_table, is_in_core, &
                                         normal_auto, normal_method_name, tangential_method_name
    use faststrip_wheelset_types, only: wheelset_model_t, standard_accuracy
    use faststrip_wheelset_model, only: make_wheelset, set_damping, set_rail_stiffness
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_settings_case_file, only: read_settings, read_thermal_group
    use faststrip_command_settings_friction, only: read_friction_group
    use faststrip_command_settings_group, only: case_text_t, group_t, read_case_text, need_groups, &
                                                read_group, is_set, text_of, refuse
    use faststrip_command_settings_methods, only: settings_t
    use faststrip_command_settings_profiles, only: bodies_t, read_bodies
    use faststrip_command_wheelset_states, only: given_state_t
    implicit none
    private

    public :: wheelset_case_t, read_wheelset_case, make_model, try_model

    !> A case of two wheels.
    type, extends(settings_t) :: wheelset_case_t
        type(bodies_t) :: bodies                 !! both sides
        logical :: gap_height_is_given = .false. !! else it is that of each contact
        logical :: has_state = .false.           !! has the file a `&state`?
        type(given_state_t) :: state             !! what it says
    end type wheelset_case_t

contains

    !> Read a case file; ends the program with one line at the first thing that is wrong. Groups
    !> that are for one contact may stand there, too. What auto is asked for is settled by the
    !> options, `take_method_options`.
    subroutine read_wheelset_case(path, case, for_table)
        character(len=*), intent(in) :: path            !! name of the `.nml` file
        type(wheelset_case_t), intent(inout) :: case    !! checked
        logical, intent(in), optional :: for_table      !! only what is cheap enough for one?

        type(case_text_t) :: content
        type(group_t) :: group

        call read_case_text(path, .true., content)
        call need_groups(content, [character(len=8) :: 'material', 'wheel', 'rail'])
        call read_settings(content, 'material', case, group)
        ! Each contact has its own rolling speed.
        case%friction%speed = 1.0_wp
        call read_friction_group(content, case%mu, .true., case%friction)
        call read_thermal_group(content, case)
        call read_bodies(content, .true., .true., case%bodies)
        call read_settings(content, 'numerics', case, group)
        if (present(for_table)) call refuse_dear_methods(group, case)
        if (is_set(group, 'gap_step_mm')) &
            call refuse(group, 'gap_step_mm', 'must not be given for a wheelset', '')
        case%gap_height_is_given = is_set(group, 'gap_height_mm')
        call read_group(content, 'state', group)
        case%has_state = group%first > 0
        if (.not. case%has_state) return
        case%state%side = text_of(group, 'side', case%state%side)
        case%state%is_given = group%value(2:)%is_given
        case%state%number = group%value(2:)%number
    end subroutine read_wheelset_case

    !> The model of a case; ends the program with one line if it cannot be made.
    subroutine make_model(path, case, model)
        character(len=*), intent(in) :: path           !! name of the `.nml` file
        type(wheelset_case_t), intent(in) :: case      !! of it
        type(wheelset_model_t), intent(inout) :: model !! made

        type(status_t) :: status

        call try_model(case, model, status)
        call fail_on_error(status, path)
    end subroutine make_model

    !> The same, or its status.
    subroutine try_model(case, model, status)
        type(wheelset_case_t), intent(in) :: case      !! as it was read
        type(wheelset_model_t), intent(inout) :: model !! made
        type(status_t), intent(out) :: status          !! those of `make_wheelset` and setters

        type(profile_t) :: wheels(2), rails(2)

        associate (bodies => case%bodies)
            wheels = [bodies%wheel%profile, bodies%left_wheel%profile]
            rails = [bodies%rail%profile, bodies%left_rail%profile]
            call make_wheelset(wheels, rails, bodies%wheelset, bodies%left_wheel%radius, &
                               bodies%track, case%contact_case_t, model, status)
        end associate
        if (.not. is_error(status)) &
            call set_damping(model, case%damping, case%speed_floor, status)
        if (.not. is_error(status)) call set_rail_stiffness(model, case%rail_stiffness, status)
        if (case%gap_height_is_given) model%gap_height = case%gap_height
        model%profile_accuracy = case%profile_accuracy
    end subroutine try_model

    !> A table is made of many solutions of the library's methods.
    subroutine refuse_dear_methods(group, case)
        type(group_t), intent(in) :: group
        type(wheelset_case_t), intent(in) :: case

        if (case%methods%normal == normal_auto &
            .or. .not. is_in_core(normal_table, case%methods%normal)) &
            call refuse(group, 'normal', 'must be a method of strips or ellipses for a table', &
                        trim(normal_method_name(case%methods%normal)))
        if (.not. is_in_core(tangential_table, case%methods%tangential)) &
            call refuse(group, 'tangential', 'must be a method of the library for a table', &
                        trim(tangential_method_name(case%methods%tangential)))
        if (case%damping > 0.0_wp) &
            call refuse(group, 'contact_damping_s_per_mm', 'must not be given for a table', '')
        if (case%speed_floor > 0.0_wp) &
            call refuse(group, 'speed_floor_mm_s', 'must not be given for a table', '')
        if (any(case%rail_stiffness > 0.0_wp)) &
            call refuse(group, 'rail_stiffness_z_N_mm', 'must not be given for a table', '')
        if (abs(case%profile_accuracy - standard_accuracy) > 0.0_wp) &
            call refuse(group, 'profile_accuracy_um', 'must not be given for a table', '')
        if (case%smoothing > 0.0_wp) &
            call refuse(group, 'smoothing_um', 'must not be given for a table; smooth its ' // &
                        'profiles (faststrip profile --smooth-wavelength)', '')
    end subroutine refuse_dear_methods
end module faststrip_command_wheelset_case
