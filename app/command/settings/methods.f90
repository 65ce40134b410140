!> Which methods a contact is solved by, and how finely, as people say it.
module faststrip_command_settings_methods
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_thermal, only: of_wheel, of_rail
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_method, tangential_method, &
                                         tangential_none
    use faststrip_contact_wanted, only: target_pmax
    use faststrip_geometry_undeformed_gap, only: standard_gap_step, standard_gap_height
    use faststrip_wheelset_types, only: standard_accuracy
    use faststrip_files_wear_law, only: read_wear_law
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_settings_table, only: value_t
    implicit none
    private

    public :: settings_t, put_setting, settle_wanted

    ! Given: millimetres of a micrometre.
    real(wp), parameter :: mm_per_um = 1.0e-3_wp

    !> A contact's case with what only people give, or need to see.
    type, extends(contact_case_t) :: settings_t
        character(len=:), allocatable :: wear_file   !! of the wear law; or not allocated
        character(len=:), allocatable :: wear_source !! what the file names as its source
        real(wp) :: gap_step = standard_gap_step     !! sampling of a gap of two profiles, mm
        real(wp) :: gap_height = standard_gap_height !! largest gap sampled, mm
        real(wp) :: damping = 0.0_wp     !! of a wheelset's contacts, s/mm
        real(wp) :: speed_floor = 0.0_wp !! of its rolling speeds, mm/s
        real(wp) :: rail_stiffness(2) = 0.0_wp !! below its rails, along y and z, N/mm
        real(wp) :: profile_accuracy = standard_accuracy !! of heights of its profiles, mm
        logical :: tolerance_is_given = .false. !! else it does not count beside a budget
        logical :: target_is_given = .false.    !! else it is pmax where no forces are asked for
    end type settings_t

contains

    !> Set what one setting says: the only place that knows where it goes. Of a case file, of an
    !> option, of a column of a table. Ends the program if a file that it names cannot be read.
    subroutine put_setting(choice, key, value)
        class(settings_t), intent(inout) :: choice !! gets it
        character(len=*), intent(in) :: key        !! name in a case file, or column of a batch
        type(value_t), intent(in) :: value         !! as the table of settings allows it

        type(status_t) :: status

        associate (methods => choice%methods, wanted => choice%wanted, thermal => choice%thermal)
            select case (key)
            case ('E_wheel_MPa'); choice%material%e_wheel = value%number
            case ('E_rail_MPa'); choice%material%e_rail = value%number
            case ('nu_wheel'); choice%material%nu_wheel = value%number
            case ('nu_rail'); choice%material%nu_rail = value%number
            case ('mu'); choice%mu = value%number
            case ('cksi'); choice%creepage%cksi = value%number
            case ('ceta'); choice%creepage%ceta = value%number
            case ('cphi_rad_per_mm'); choice%creepage%cphi = value%number
            case ('speed_mm_s'); choice%friction%speed = value%number
            case ('conductivity_W_per_mK'); thermal%conductivity = value%number
            case ('conductivity_wheel_W_per_mK'); thermal%conductivity(of_wheel) = value%number
            case ('conductivity_rail_W_per_mK'); thermal%conductivity(of_rail) = value%number
            case ('heat_capacity_J_per_kgK'); thermal%heat_capacity = value%number
            case ('heat_capacity_wheel_J_per_kgK'); thermal%heat_capacity(of_wheel) = value%number
            case ('heat_capacity_rail_J_per_kgK'); thermal%heat_capacity(of_rail) = value%number
            case ('density_kg_per_m3'); thermal%density = value%number
            case ('density_wheel_kg_per_m3'); thermal%density(of_wheel) = value%number
            case ('density_rail_kg_per_m3'); thermal%density(of_rail) = value%number
            case ('temperature_wheel_C'); thermal%temperature(of_wheel) = value%number
            case ('temperature_rail_C'); thermal%temperature(of_rail) = value%number
            case ('normal'); methods%normal = normal_method(value%text)
            case ('tangential'); methods%tangential = tangential_method(value%text)
            case ('strips_per_patch'); methods%strips_per_patch = value%whole
            case ('points_per_strip'); methods%points_per_strip = value%whole
            case ('fastsim_nx'); methods%fastsim_nx = value%whole
            case ('fastsim_ny'); methods%fastsim_ny = value%whole
            case ('element_dx_mm')
                methods%element_dx = value%number
                methods%dx_is_given = .true.
            case ('element_dy_mm')
                methods%element_dy = value%number
                methods%dy_is_given = .true.
            case ('error_target'); methods%error_target = value%number
            case ('max_elements'); methods%max_elements = value%whole
            case ('norm_start'); methods%norm_start = value%whole
            case ('resolution_limit'); choice%resolution_limit = value%number
            case ('force_limit'); choice%force_limit = value%number
            case ('subsurface'); choice%asked%subsurface = value%flag
            case ('curved'); choice%curved = value%flag
            case ('yield_MPa'); choice%yield = value%number
            case ('yield_shear_MPa'); choice%yield_shear = value%number
            case ('smoothing_um'); choice%smoothing = mm_per_um*value%number
            case ('tolerance')
                wanted%tolerance = value%number
                choice%tolerance_is_given = .true.
            case ('target')
                wanted%target = value%whole
                choice%target_is_given = .true.
            case ('budget_us'); wanted%budget_us = value%number
            case ('gap_step_mm'); choice%gap_step = value%number
            case ('gap_height_mm'); choice%gap_height = value%number
            case ('contact_damping_s_per_mm'); choice%damping = value%number
            case ('speed_floor_mm_s'); choice%speed_floor = value%number
            case ('rail_stiffness_y_N_mm'); choice%rail_stiffness(1) = value%number
            case ('rail_stiffness_z_N_mm'); choice%rail_stiffness(2) = value%number
            case ('profile_accuracy_um'); choice%profile_accuracy = mm_per_um*value%number
            case ('wear_file')
                call read_wear_law(value%text, choice%wear_law, choice%wear_source, status)
                call fail_on_error(status)
                choice%wear_file = value%text
            case default
                error stop 'faststrip: a setting has no place in a case'
            end select
        end associate
    end subroutine put_setting

    !> Settle what auto is asked for, when all is given: pmax, where neither a target nor forces are
    !> asked for; a budget alone, where no tolerance is given beside it.
    subroutine settle_wanted(case)
        class(settings_t), intent(inout) :: case !! as the user gave it

        if (.not. case%target_is_given .and. case%methods%tangential == tangential_none) &
            case%wanted%target = target_pmax
        if (case%wanted%budget_us > 0.0_wp .and. .not. case%tolerance_is_given) &
            case%wanted%tolerance = 0.0_wp
    end subroutine settle_wanted
end module faststrip_command_settings_methods
