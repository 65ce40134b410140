!> The case of a wheelset: both wheels and rails, friction, methods, and one state or none.
module faststrip_command_wheelset_case
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_geometry_profile, only: profile_t
    use faststrip_contact_methods, only: normal_table, tangential_table, normal_auto, &
                                         normal_method_name, tangential_method_name
    use faststrip_wheelset_types, only: wheelset_model_t
    use faststrip_wheelset_solve, only: make_wheelset
    use faststrip_command_settings_case_file, only: case_t, read_material_group, read_numerics_group
    use faststrip_command_settings_case_friction, only: read_friction_group
    use faststrip_command_settings_case_profiles, only: read_wheel_group, read_rail_group, &
                                                        complete_wheelset, shape_t, left_wheel_t, &
                                                        hold_width
    use faststrip_command_settings_case_values, only: unset, case_groups
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_program_files, only: take_input
    use faststrip_command_settings_methods, only: in_core, settle_wanted, word_length
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, read_namelist_file, &
                                                   find_group, sets, refuse
    use faststrip_command_settings_namelist_values, only: reading_t, next_lines, refuse_values, &
                                                          name_length
    use faststrip_command_wheelset_states, only: given_state_t, state_names, n_numbers
    implicit none
    private

    public :: wheelset_case_t, read_wheelset_case

    !> A case of two wheels.
    type, extends(case_t) :: wheelset_case_t
        type(left_wheel_t) :: left_wheel      !! as a right wheel
        type(shape_t) :: left_rail            !! as a right rail
        logical :: has_state = .false.        !! has the file a `&state`?
        type(given_state_t) :: state          !! what it says
    end type wheelset_case_t

contains

    !> Read a case file; ends the program with one line at the first thing that is wrong. Groups
    !> that are for one contact may stand there, too.
    subroutine read_wheelset_case(path, case, model, for_table)
        character(len=*), intent(in) :: path            !! name of the `.nml` file
        type(wheelset_case_t), intent(inout) :: case    !! checked
        type(wheelset_model_t), intent(inout) :: model  !! made of it
        logical, intent(in), optional :: for_table      !! only what is cheap enough for one?

        type(namelist_file_t) :: content
        type(group_t) :: group
        type(profile_t) :: wheels(2), rails(2)
        type(status_t) :: status

        call take_input(path)
        call read_namelist_file(path, [case_groups, [character(len=len(case_groups)) :: 'state']], &
                                content)
        call read_material_group(content, case%case_t)
        ! Each contact has its own rolling speed.
        case%friction%speed = 1.0_wp
        call read_friction_group(content, case%mu, .true., case%friction)
        call read_wheel_group(content, .true., case%wheelset, case%wheel, case%left_wheel)
        call read_rail_group(content, .true., case%track, case%rail, case%left_rail)
        call complete_wheelset(content, case%track, case%wheelset)
        call hold_width(content, case%wheel, case%wheelset%radius)
        call hold_width(content, case%left_wheel%shape_t, case%wheelset%radius)
        call hold_width(content, case%rail, case%wheelset%radius)
        call hold_width(content, case%left_rail, case%wheelset%radius)
        call read_numerics_group(content, case%case_t)
        call settle_wanted(case%case_t)
        call find_group(content, 'numerics', .false., group)
        if (present(for_table)) call refuse_dear_methods(content, group, case)
        if (sets(content, group, 'gap_step_mm')) &
            call refuse(content, group, 'gap_step_mm', 'must not be given for a wheelset', '')
        call read_state_group(content, case)

        wheels = [case%wheel%profile, case%left_wheel%profile]
        rails = [case%rail%profile, case%left_rail%profile]
        call make_wheelset(wheels, rails, case%wheelset, case%left_wheel%radius, case%track, &
                           case%contact_case_t, model, status)
        call fail_on_error(status, path)
        if (sets(content, group, 'gap_height_mm')) model%gap_height = case%gap_height
    end subroutine read_wheelset_case

    !> A table is made of many solutions of the library's methods.
    subroutine refuse_dear_methods(content, group, case)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        type(wheelset_case_t), intent(in) :: case

        if (case%methods%normal == normal_auto &
            .or. .not. in_core(normal_table, case%methods%normal)) &
            call refuse(content, group, 'normal', 'must be a method of strips or ellipses for a ' &
                        // 'table', trim(normal_method_name(case%methods%normal)))
        if (.not. in_core(tangential_table, case%methods%tangential)) &
            call refuse(content, group, 'tangential', 'must be a method of the library for a ' // &
                        'table', trim(tangential_method_name(case%methods%tangential)))
        if (case%smoothing > 0.0_wp) &
            call refuse(content, group, 'smoothing_um', 'must not be given for a table; ' // &
                        'smooth its profiles (faststrip profile --smooth-wavelength)', '')
    end subroutine refuse_dear_methods

    !> The one state of a case.
    subroutine read_state_group(content, case)
        type(namelist_file_t), intent(in) :: content
        type(wheelset_case_t), intent(inout) :: case

        character(len=word_length) :: side
        real(wp) :: y_mm, z_mm, roll_rad, yaw_rad, speed_mm_s, pitch_rate_rad_s, Fz_N, vy_mm_s, &
            vz_mm_s, roll_rate_rad_s, yaw_rate_rad_s, curve_radius_mm, roll_moment_Nmm
        real(wp) :: rail_right_y_mm, rail_right_z_mm, rail_right_roll_rad, rail_right_vy_mm_s, &
            rail_right_vz_mm_s, rail_right_roll_rate_rad_s, rail_left_y_mm, rail_left_z_mm, &
            rail_left_roll_rad, rail_left_vy_mm_s, rail_left_vz_mm_s, rail_left_roll_rate_rad_s
        namelist /state/ side, y_mm, z_mm, roll_rad, yaw_rad, speed_mm_s, pitch_rate_rad_s, &
            Fz_N, vy_mm_s, vz_mm_s, roll_rate_rad_s, yaw_rate_rad_s, curve_radius_mm, &
            roll_moment_Nmm, rail_right_y_mm, rail_right_z_mm, rail_right_roll_rad, &
            rail_right_vy_mm_s, rail_right_vz_mm_s, rail_right_roll_rate_rad_s, rail_left_y_mm, &
            rail_left_z_mm, rail_left_roll_rad, rail_left_vy_mm_s, rail_left_vz_mm_s, &
            rail_left_roll_rate_rad_s
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code, i

        side = 'both'
        y_mm = unset()
        z_mm = unset()
        roll_rad = unset()
        yaw_rad = unset()
        speed_mm_s = unset()
        pitch_rate_rad_s = unset()
        Fz_N = unset()
        vy_mm_s = unset()
        vz_mm_s = unset()
        roll_rate_rad_s = unset()
        yaw_rate_rad_s = unset()
        curve_radius_mm = unset()
        roll_moment_Nmm = unset()
        rail_right_y_mm = unset()
        rail_right_z_mm = unset()
        rail_right_roll_rad = unset()
        rail_right_vy_mm_s = unset()
        rail_right_vz_mm_s = unset()
        rail_right_roll_rate_rad_s = unset()
        rail_left_y_mm = unset()
        rail_left_z_mm = unset()
        rail_left_roll_rad = unset()
        rail_left_vy_mm_s = unset()
        rail_left_vz_mm_s = unset()
        rail_left_roll_rate_rad_s = unset()
        call find_group(content, 'state', .false., group)
        case%has_state = group%first > 0
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=state, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, &
                [character(len=name_length) :: 'side', state_names], reading)
        end do
        case%state%side = side
        case%state%number = [y_mm, roll_rad, yaw_rad, speed_mm_s, pitch_rate_rad_s, Fz_N, z_mm, &
                             vy_mm_s, vz_mm_s, roll_rate_rad_s, yaw_rate_rad_s, &
                             curve_radius_mm, roll_moment_Nmm, rail_right_y_mm, rail_right_z_mm, &
                             rail_right_roll_rad, rail_right_vy_mm_s, rail_right_vz_mm_s, &
                             rail_right_roll_rate_rad_s, rail_left_y_mm, rail_left_z_mm, &
                             rail_left_roll_rad, rail_left_vy_mm_s, rail_left_vz_mm_s, &
                             rail_left_roll_rate_rad_s]
        case%state%is_given = [(sets(content, group, trim(state_names(i))), i=1, n_numbers)]
    end subroutine read_state_group
end module faststrip_command_wheelset_case
