!> One case: what is rolling on what, how it is loaded, how it is to be solved.
module faststrip_command_settings_case_file
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: lower_case
    use faststrip_base_material, only: material_t
    use faststrip_base_plausible, only: of_shift, of_speed, of_yield, of_noise
    use faststrip_base_creepage, only: creepage_t
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, creepage_set_a, creepage_set_b
    use faststrip_geometry_undeformed_gap, only: standard_gap_step, standard_gap_height
    use faststrip_command_settings_case_friction, only: read_friction_group
    use faststrip_command_settings_case_profiles, only: read_wheel_group, read_rail_group, &
                                                        complete_wheelset, shape_t, beside, &
                                                        path_length, hold_width
    use faststrip_command_settings_case_values, only: unset, need_finite, need_positive, &
                                                      need_poisson, not_given, take_list, &
                                                      need_as_many, case_groups
    use faststrip_command_settings_doubts, only: hold_value
    use faststrip_command_program_files, only: take_input
    use faststrip_contact_methods, only: normal_table, tangential_table, normal_method, &
                                         tangential_method, normal_method_name, &
                                         tangential_method_name
    use faststrip_contact_wanted, only: target_number, target_names
    use faststrip_command_settings_methods, only: settings_t, check_settings, one_of, word_length, &
                                                  norm_starts
    use faststrip_command_rows_wear_figures, only: take_wear_law
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, read_namelist_file, &
                                                   find_group, sets, refuse
    use faststrip_command_settings_namelist_values, only: reading_t, next_lines, refuse_values, &
                                                          name_length
    implicit none
    private

    public :: case_t, read_case, read_material_group, read_numerics_group, beside

    integer, parameter :: max_shifts = 1000

    ! The names of the groups.
    character(len=name_length), parameter :: contact_names(*) = [character(len=name_length) :: &
        'name', 'gap_file', 'load_N', 'penetration_mm', 'load_direction', 'shift_mm']
    character(len=name_length), parameter :: material_names(*) = [character(len=name_length) :: &
        'E_wheel_MPa', 'E_rail_MPa', 'nu_wheel', 'nu_rail', 'mu']
    character(len=name_length), parameter :: motion_names(*) = [character(len=name_length) :: &
        'creepage', 'sign_set', 'cksi', 'ceta', 'cphi_rad_per_mm', 'speed_mm_s']
    character(len=name_length), parameter :: numerics_names(*) = [character(len=name_length) :: &
        'normal', 'tangential', 'strips_per_patch', 'points_per_strip', &
        'fastsim_nx', 'fastsim_ny', 'gap_step_mm', 'gap_height_mm', 'smoothing_um', &
        'element_dx_mm', 'element_dy_mm', 'error_target', 'norm_start', 'tolerance', &
        'target', 'budget_us', 'max_elements', 'resolution_limit', 'force_limit', &
        'yield_MPa', 'yield_shear_MPa', 'wear_file']
    character(len=name_length), parameter :: sweep_names(*) = [character(len=name_length) :: &
        'shifts_mm', 'load_N', 'cksi', 'ceta', 'cphi_rad_per_mm']

    !> A case as its file tells it: a contact but for its gap, which the profiles make or another
    !> file holds. The load may be a vertical one, creepages may follow from the shift.
    type, extends(settings_t) :: case_t
        character(len=:), allocatable :: name       !! for the CSV
        character(len=:), allocatable :: gap_file   !! empty: the gap comes from the profiles
        logical :: load_is_vertical = .false.       !! else along the contact normal
        real(wp) :: shift = 0.0_wp                  !! lateral shift of the wheelset, mm
        real(wp), allocatable :: shifts(:)          !! of the sweep, mm
        real(wp), allocatable :: shift_loads(:)     !! normal force of each shift, N; or empty
        real(wp), allocatable :: shift_cksi(:)      !! creepages of each shift; or empty
        real(wp), allocatable :: shift_ceta(:)      !! the same
        real(wp), allocatable :: shift_cphi(:)      !! the same, rad/mm
        type(shape_t) :: wheel, rail                !! unless there is a gap file
        type(wheelset_t) :: wheelset                !! mm
        type(track_t) :: track                      !! mm
        logical :: creepage_by_formula = .false.    !! from the shift, else as given
        integer :: creepage_signs = creepage_set_b  !! for the formula
        real(wp) :: gap_step = 0.0_wp               !! sampling of the gap, mm
        real(wp) :: gap_height = 0.0_wp             !! largest gap sampled, mm
    end type case_t

contains

    !> Read a case file; ends the program with one line at the first thing that is wrong.
    subroutine read_case(path, case)
        character(len=*), intent(in) :: path !! name of the `.nml` file
        type(case_t), intent(out) :: case    !! checked

        type(namelist_file_t) :: content
        logical :: from_profiles

        call take_input(path)
        call read_namelist_file(path, case_groups, content)
        call read_contact_group(content, case)
        from_profiles = len(case%gap_file) == 0
        call read_material_group(content, case)
        call read_wheel_group(content, from_profiles, case%wheelset, case%wheel)
        call read_rail_group(content, from_profiles, case%track, case%rail)
        if (from_profiles) then
            call complete_wheelset(content, case%track, case%wheelset)
            call hold_width(content, case%wheel, case%wheelset%radius)
            call hold_width(content, case%rail, case%wheelset%radius)
        end if
        call read_motion_group(content, from_profiles, case)
        call read_friction_group(content, case%mu, from_profiles, case%friction)
        call read_numerics_group(content, case)
        call read_sweep_group(content, case)
    end subroutine read_case

    subroutine read_contact_group(content, case)
        type(namelist_file_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        character(len=path_length) :: name, gap_file
        character(len=word_length) :: load_direction
        real(wp) :: load_n, penetration_mm, shift_mm
        namelist /contact/ name, gap_file, load_n, penetration_mm, load_direction, shift_mm
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        name = 'case'
        gap_file = ''
        load_direction = 'normal'
        load_n = unset()
        penetration_mm = unset()
        shift_mm = 0.0_wp
        call find_group(content, 'contact', .true., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=contact, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, contact_names, reading)
        end do
        case%name = trim(name)
        case%gap_file = ''
        if (len_trim(gap_file) > 0) then
            case%gap_file = beside(content%file, trim(gap_file))
            call take_input(case%gap_file)
        end if
        case%by_load = .not. sets(content, group, 'penetration_mm')
        if (case%by_load) then
            call need_positive(content, group, 'load_N', load_n)
        else
            call need_finite(content, group, 'penetration_mm', penetration_mm)
            if (sets(content, group, 'load_N')) &
                call refuse(content, group, 'penetration_mm', 'must not be given with load_N', &
                            number_text(penetration_mm))
        end if
        case%penetration = penetration_mm
        call need_finite(content, group, 'shift_mm', shift_mm)
        call hold_value(content, group, 'shift_mm', of_shift, shift_mm)
        case%load = load_n
        case%shift = shift_mm
        case%load_is_vertical = load_direction == 'vertical'
        if (load_direction /= 'vertical' .and. load_direction /= 'normal') &
            call refuse(content, group, 'load_direction', 'must be normal or vertical', &
                        load_direction)
        if (case%load_is_vertical .and. .not. case%by_load) &
            call refuse(content, group, 'load_direction', &
                        'must be normal with penetration_mm', load_direction)
        if (case%load_is_vertical .and. len(case%gap_file) > 0) &
            call refuse(content, group, 'load_direction', &
                        'must be normal with a gap file', load_direction)
    end subroutine read_contact_group

    subroutine read_material_group(content, case)
        type(namelist_file_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        real(wp) :: e_wheel_mpa, e_rail_mpa, nu_wheel, nu_rail, mu
        namelist /material/ e_wheel_mpa, e_rail_mpa, nu_wheel, nu_rail, mu
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        e_wheel_mpa = case%material%e_wheel
        e_rail_mpa = case%material%e_rail
        nu_wheel = case%material%nu_wheel
        nu_rail = case%material%nu_rail
        mu = unset()
        call find_group(content, 'material', .true., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=material, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, material_names, reading)
        end do
        call need_positive(content, group, 'E_wheel_MPa', e_wheel_mpa)
        call need_positive(content, group, 'E_rail_MPa', e_rail_mpa)
        call need_poisson(content, group, 'nu_wheel', nu_wheel)
        call need_poisson(content, group, 'nu_rail', nu_rail)
        call need_finite(content, group, 'mu', mu)
        if (mu < 0.0_wp) call refuse(content, group, 'mu', 'must not be negative', number_text(mu))
        case%material = material_t(e_wheel_mpa, e_rail_mpa, nu_wheel, nu_rail)
        case%mu = mu
    end subroutine read_material_group

    subroutine read_motion_group(content, from_profiles, case)
        type(namelist_file_t), intent(in) :: content
        logical, intent(in) :: from_profiles
        type(case_t), intent(inout) :: case

        character(len=word_length) :: creepage
        character(len=word_length) :: sign_set
        real(wp) :: cksi, ceta, cphi_rad_per_mm, speed_mm_s
        namelist /motion/ creepage, sign_set, cksi, ceta, cphi_rad_per_mm, speed_mm_s
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        creepage = 'given'
        sign_set = 'B'
        cksi = 0.0_wp
        ceta = 0.0_wp
        cphi_rad_per_mm = 0.0_wp
        speed_mm_s = unset()
        call find_group(content, 'motion', .true., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=motion, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, motion_names, reading)
        end do
        call need_finite(content, group, 'cksi', cksi)
        call need_finite(content, group, 'ceta', ceta)
        call need_finite(content, group, 'cphi_rad_per_mm', cphi_rad_per_mm)
        case%creepage = creepage_t(cksi, ceta, cphi_rad_per_mm)
        if (sets(content, group, 'speed_mm_s')) then
            call need_positive(content, group, 'speed_mm_s', speed_mm_s)
            call hold_value(content, group, 'speed_mm_s', of_speed, speed_mm_s)
            case%friction%speed = speed_mm_s
        end if
        case%creepage_by_formula = creepage == 'formula'
        if (creepage /= 'formula' .and. creepage /= 'given') &
            call refuse(content, group, 'creepage', 'must be formula or given', creepage)
        if (case%creepage_by_formula .and. .not. from_profiles) &
            call refuse(content, group, 'creepage', 'must be given with a gap file', creepage)
        if (case%creepage_by_formula .and. any([cksi, ceta, cphi_rad_per_mm] /= 0.0_wp)) &
            call refuse(content, group, 'creepage', &
                        'must be given where creepages are given', creepage)
        if (lower_case(sign_set) /= 'a' .and. lower_case(sign_set) /= 'b') &
            call refuse(content, group, 'sign_set', 'must be A or B', sign_set)
        case%creepage_signs = merge(creepage_set_a, creepage_set_b, lower_case(sign_set) == 'a')
    end subroutine read_motion_group

    subroutine read_numerics_group(content, case)
        type(namelist_file_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        character(len=word_length) :: normal, tangential, norm_start, target
        integer :: strips_per_patch, points_per_strip, fastsim_nx, fastsim_ny, max_elements
        real(wp) :: gap_step_mm, gap_height_mm, smoothing_um, element_dx_mm, element_dy_mm, &
            error_target, tolerance, budget_us, resolution_limit, force_limit, &
            yield_mpa, yield_shear_mpa
        character(len=path_length) :: wear_file
        namelist /numerics/ normal, tangential, strips_per_patch, points_per_strip, fastsim_nx, &
            fastsim_ny, gap_step_mm, gap_height_mm, smoothing_um, element_dx_mm, element_dy_mm, &
            error_target, norm_start, tolerance, target, budget_us, max_elements, &
            resolution_limit, force_limit, yield_mpa, yield_shear_mpa, wear_file
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code
        character(len=:), allocatable :: what, range, value

        normal = normal_method_name(case%methods%normal)
        tangential = tangential_method_name(case%methods%tangential)
        strips_per_patch = case%methods%strips_per_patch
        points_per_strip = case%methods%points_per_strip
        fastsim_nx = case%methods%fastsim_nx
        fastsim_ny = case%methods%fastsim_ny
        element_dx_mm = case%methods%element_dx
        element_dy_mm = case%methods%element_dy
        error_target = case%methods%error_target
        norm_start = norm_starts(case%methods%norm_start)
        tolerance = case%wanted%tolerance
        budget_us = case%wanted%budget_us
        max_elements = case%methods%max_elements
        target = target_names(case%wanted%target)
        resolution_limit = case%resolution_limit
        force_limit = case%force_limit
        yield_mpa = case%yield
        yield_shear_mpa = case%yield_shear
        wear_file = ''
        gap_step_mm = standard_gap_step
        gap_height_mm = standard_gap_height
        smoothing_um = 0.0_wp
        call find_group(content, 'numerics', .false., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=numerics, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, numerics_names, reading)
        end do
        case%methods%normal = normal_method(normal)
        if (case%methods%normal < 0) call refuse(content, group, 'normal', 'must be ' &
                                            // one_of(normal_table%name), trim(normal))
        case%methods%tangential = tangential_method(tangential)
        if (case%methods%tangential < 0) call refuse(content, group, 'tangential', 'must be ' &
                                                // one_of(tangential_table%name), trim(tangential))
        case%methods%strips_per_patch = strips_per_patch
        case%methods%points_per_strip = points_per_strip
        case%methods%fastsim_nx = fastsim_nx
        case%methods%fastsim_ny = fastsim_ny
        case%smoothing = 1.0e-3_wp*smoothing_um
        case%yield = yield_mpa
        case%yield_shear = yield_shear_mpa
        case%methods%element_dx = element_dx_mm
        case%methods%element_dy = element_dy_mm
        case%methods%dx_is_given = sets(content, group, 'element_dx_mm')
        case%methods%dy_is_given = sets(content, group, 'element_dy_mm')
        case%methods%error_target = error_target
        case%methods%norm_start = findloc(norm_starts == norm_start, .true., dim=1)
        if (case%methods%norm_start == 0) call refuse(content, group, 'norm_start', 'must be ' &
                                                      // one_of(norm_starts), trim(norm_start))
        case%wanted%tolerance = tolerance
        case%wanted%budget_us = budget_us
        case%tolerance_is_given = sets(content, group, 'tolerance')
        case%target_is_given = sets(content, group, 'target')
        case%methods%max_elements = max_elements
        case%wanted%target = target_number(target)
        if (case%wanted%target == 0) call refuse(content, group, 'target', 'must be ' &
                                                    // one_of(target_names), trim(target))
        call check_settings(case, smoothing_um, what, range, value)
        call hold_value(content, group, 'smoothing_um', of_noise, smoothing_um)
        call hold_value(content, group, 'yield_MPa', of_yield, yield_mpa)
        call hold_value(content, group, 'yield_shear_MPa', of_yield, yield_shear_mpa)
        if (len(what) > 0) call refuse(content, group, what, 'must be ' // range, value)
        if (len_trim(wear_file) > 0) then
            call take_input(beside(content%file, trim(wear_file)))
            call take_wear_law(beside(content%file, trim(wear_file)), case)
        end if
        call need_positive(content, group, 'resolution_limit', resolution_limit)
        call need_positive(content, group, 'force_limit', force_limit)
        case%resolution_limit = resolution_limit
        case%force_limit = force_limit
        call need_positive(content, group, 'gap_step_mm', gap_step_mm)
        call need_positive(content, group, 'gap_height_mm', gap_height_mm)
        case%gap_step = gap_step_mm
        case%gap_height = gap_height_mm
    end subroutine read_numerics_group

    subroutine read_sweep_group(content, case)
        type(namelist_file_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        real(wp) :: shifts_mm(max_shifts), load_n(max_shifts)
        real(wp) :: cksi(max_shifts), ceta(max_shifts), cphi_rad_per_mm(max_shifts)
        namelist /sweep/ shifts_mm, load_n, cksi, ceta, cphi_rad_per_mm
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: n, code

        shifts_mm = not_given
        load_n = not_given
        cksi = not_given
        ceta = not_given
        cphi_rad_per_mm = not_given
        call find_group(content, 'sweep', .false., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=sweep, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, sweep_names, reading)
        end do
        call take_list(content, group, 'shifts_mm', shifts_mm, case%shifts)
        call take_list(content, group, 'load_N', load_n, case%shift_loads)
        call take_list(content, group, 'cksi', cksi, case%shift_cksi)
        call take_list(content, group, 'ceta', ceta, case%shift_ceta)
        call take_list(content, group, 'cphi_rad_per_mm', cphi_rad_per_mm, case%shift_cphi)
        n = size(case%shifts)
        if (n == 0) return
        call hold_value(content, group, 'shifts_mm', of_shift, maxval(abs(case%shifts)))
        if (size(case%shift_loads) > 0) then
            call need_as_many(content, group, 'load_N', size(case%shift_loads), n)
            if (case%load_is_vertical) call refuse(content, group, 'load_N', &
                'must not be listed with load_direction vertical', '')
            if (.not. case%by_load) call refuse(content, group, 'load_N', &
                'must not be listed with &contact penetration_mm', '')
            if (any(case%shift_loads <= 0.0_wp)) call refuse(content, group, 'load_N', &
                'must be above 0', number_text(minval(case%shift_loads)))
        end if
        if (max(size(case%shift_cksi), size(case%shift_ceta), size(case%shift_cphi)) == 0) return
        if (case%creepage_by_formula) call refuse(content, group, 'cksi', &
            'must not be listed with &motion creepage formula', '')
        call need_as_many(content, group, 'cksi', size(case%shift_cksi), n)
        call need_as_many(content, group, 'ceta', size(case%shift_ceta), n)
        call need_as_many(content, group, 'cphi_rad_per_mm', size(case%shift_cphi), n)
    end subroutine read_sweep_group
end module faststrip_command_settings_case_file
