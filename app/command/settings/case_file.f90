!> One case: what is rolling on what, how it is loaded, how it is to be solved. What a single value
!> may be is told by the table of settings; here is what values must be together.
module faststrip_command_settings_case_file
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: integer_text
    use faststrip_geometry_rigid_contact, only: creepage_set_a, creepage_set_b
    use faststrip_wheelset_types, only: standard_accuracy
    use faststrip_command_settings_friction, only: read_friction_group
    use faststrip_command_settings_group, only: case_text_t, group_t, read_case_text, need_groups, &
                                                stands_in, read_group, is_set, number_of, &
                                                text_of, list_of, beside, take_file, refuse, &
                                                refuse_each
    use faststrip_command_settings_methods, only: settings_t, put_setting
    use faststrip_command_settings_profiles, only: bodies_t, read_bodies
    use faststrip_command_settings_table, only: settings, value_t, a_path
    implicit none
    private

    public :: case_t, read_case, read_bodies_of, read_settings, read_thermal_group

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
        type(bodies_t) :: bodies                    !! unless there is a gap file
        logical :: creepage_by_formula = .false.    !! from the shift, else as given
        integer :: creepage_signs = creepage_set_b  !! for the formula
    end type case_t

contains

    !> Read a case file; ends the program with one line at the first thing that is wrong.
    subroutine read_case(path, case)
        character(len=*), intent(in) :: path !! name of the `.nml` file
        type(case_t), intent(out) :: case    !! checked

        ! The last two are not needed with a gap file.
        character(len=*), parameter :: needed(*) = [character(len=8) :: 'contact', 'material', &
                                                    'motion', 'wheel', 'rail']
        type(case_text_t) :: content
        type(group_t) :: group
        logical :: from_profiles

        call read_case_text(path, .false., content)
        call need_groups(content, needed(:merge(3, 5, stands_in(content, 'contact', 'gap_file'))))
        call read_contact_group(content, case)
        from_profiles = len(case%gap_file) == 0
        call read_settings(content, 'material', case, group)
        call read_bodies(content, from_profiles, .false., case%bodies)
        call read_motion_group(content, from_profiles, case)
        call read_friction_group(content, case%mu, from_profiles, case%friction)
        call read_thermal_group(content, case)
        call read_settings(content, 'numerics', case, group)
        if (case%damping > 0.0_wp) &
            call refuse(group, 'contact_damping_s_per_mm', 'is for wheelsets only', '')
        if (case%speed_floor > 0.0_wp) &
            call refuse(group, 'speed_floor_mm_s', 'is for wheelsets only', '')
        if (any(case%rail_stiffness > 0.0_wp)) &
            call refuse(group, 'rail_stiffness_z_N_mm', 'is for wheelsets only', '')
        if (abs(case%profile_accuracy - standard_accuracy) > 0.0_wp) &
            call refuse(group, 'profile_accuracy_um', 'is for wheelsets only', '')
        call read_sweep_group(content, case)
    end subroutine read_case

    !> Read the wheels and rails of a case file, both sides of them; the other groups may stand
    !> there. Ends the program with one line at the first thing that is wrong.
    subroutine read_bodies_of(path, bodies)
        character(len=*), intent(in) :: path       !! name of the `.nml` file
        type(bodies_t), intent(out) :: bodies      !! checked

        type(case_text_t) :: content
        type(group_t) :: rail

        call read_case_text(path, .false., content)
        call need_groups(content, [character(len=8) :: 'wheel', 'rail'])
        call read_bodies(content, .true., .true., bodies)
        call read_group(content, 'rail', rail)
        call refuse_each(rail, ['roller_radius_mm'], 'is for contact, sweep and wheelset only')
    end subroutine read_bodies_of

    !> Read the group that asks for temperatures, if there is one, empty or not.
    subroutine read_thermal_group(content, case)
        type(case_text_t), intent(in) :: content !! a case file
        class(settings_t), intent(inout) :: case !! has the rolling speed, 0 if not given

        type(group_t) :: group

        call read_settings(content, 'thermal', case, group)
        case%asked%temperatures = group%first > 0
        if (.not. case%asked%temperatures .or. case%friction%speed > 0.0_wp) return
        call read_group(content, 'motion', group)
        call refuse(group, 'speed_mm_s', 'must be given with &thermal', '')
    end subroutine read_thermal_group

    !> Read a group whose values each go to one place of a case: `material`, `thermal`, `numerics`.
    subroutine read_settings(content, name, case, group)
        type(case_text_t), intent(in) :: content !! a case file
        character(len=*), intent(in) :: name     !! of the group
        class(settings_t), intent(inout) :: case !! gets what the group gives
        type(group_t), intent(out) :: group      !! as it was read

        type(value_t) :: value
        integer :: i

        call read_group(content, name, group)
        do i = 1, size(group%row)
            if (.not. group%value(i)%is_given) cycle
            value = group%value(i)
            if (settings(group%row(i))%kind == a_path) then
                if (value%text == '') cycle
                value%text = beside(group%file, value%text)
                call take_file(group, trim(settings(group%row(i))%key), value%text, '')
            end if
            call put_setting(case, trim(settings(group%row(i))%key), value)
        end do
    end subroutine read_settings

    subroutine read_contact_group(content, case)
        type(case_text_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        type(group_t) :: group

        call read_group(content, 'contact', group)
        case%name = text_of(group, 'name', 'case')
        case%gap_file = trim(text_of(group, 'gap_file', ''))
        if (len(case%gap_file) > 0) then
            case%gap_file = beside(group%file, case%gap_file)
            call take_file(group, 'gap_file', case%gap_file, '')
        end if
        case%by_load = .not. is_set(group, 'penetration_mm')
        if (case%by_load .eqv. .not. is_set(group, 'load_N')) then
            if (case%by_load) call refuse(group, 'load_N', 'must be given, or penetration_mm', '')
            call refuse(group, 'penetration_mm', 'must not be given with load_N', &
                        number_text(number_of(group, 'penetration_mm', 0.0_wp)))
        end if
        case%load = number_of(group, 'load_N', 0.0_wp)
        case%penetration = number_of(group, 'penetration_mm', 0.0_wp)
        case%shift = number_of(group, 'shift_mm', case%shift)
        case%load_is_vertical = text_of(group, 'load_direction', 'normal') == 'vertical'
        if (case%load_is_vertical .and. .not. case%by_load) &
            call refuse(group, 'load_direction', 'must be normal with penetration_mm', 'vertical')
        if (case%load_is_vertical .and. len(case%gap_file) > 0) &
            call refuse(group, 'load_direction', 'must be normal with a gap file', 'vertical')
    end subroutine read_contact_group

    subroutine read_motion_group(content, from_profiles, case)
        type(case_text_t), intent(in) :: content
        logical, intent(in) :: from_profiles
        type(case_t), intent(inout) :: case

        type(group_t) :: group

        call read_group(content, 'motion', group)
        case%creepage%cksi = number_of(group, 'cksi', 0.0_wp)
        case%creepage%ceta = number_of(group, 'ceta', 0.0_wp)
        case%creepage%cphi = number_of(group, 'cphi_rad_per_mm', 0.0_wp)
        case%friction%speed = number_of(group, 'speed_mm_s', case%friction%speed)
        case%creepage_by_formula = text_of(group, 'creepage', 'given') == 'formula'
        if (case%creepage_by_formula .and. .not. from_profiles) &
            call refuse(group, 'creepage', 'must be given with a gap file', 'formula')
        associate (creepage => case%creepage)
            if (case%creepage_by_formula .and. &
                any([creepage%cksi, creepage%ceta, creepage%cphi] /= 0.0_wp)) &
                call refuse(group, 'creepage', 'must not be formula where cksi, ceta or ' // &
                            'cphi_rad_per_mm stand', '')
        end associate
        if (text_of(group, 'sign_set', 'B') == 'A') case%creepage_signs = creepage_set_a
        case%given%is_given = [is_set(group, 'Fx_N'), is_set(group, 'Fy_N')]
        case%given%force = [number_of(group, 'Fx_N', 0.0_wp), number_of(group, 'Fy_N', 0.0_wp)]
        if (case%given%is_given(1) .and. is_set(group, 'cksi')) &
            call refuse(group, 'Fx_N', 'must not be given with cksi, which follows from it', '')
        if (case%given%is_given(2) .and. is_set(group, 'ceta')) &
            call refuse(group, 'Fy_N', 'must not be given with ceta, which follows from it', '')
    end subroutine read_motion_group

    subroutine read_sweep_group(content, case)
        type(case_text_t), intent(in) :: content
        type(case_t), intent(inout) :: case

        type(group_t) :: group

        call read_group(content, 'sweep', group)
        case%shifts = list_of(group, 'shifts_mm')
        case%shift_loads = list_of(group, 'load_N')
        case%shift_cksi = list_of(group, 'cksi')
        case%shift_ceta = list_of(group, 'ceta')
        case%shift_cphi = list_of(group, 'cphi_rad_per_mm')
        if (size(case%shifts) == 0) return
        if (size(case%shift_loads) > 0) then
            call need_as_many('load_N', size(case%shift_loads))
            if (case%load_is_vertical) call refuse(group, 'load_N', &
                'must not be listed with load_direction vertical', '')
            if (.not. case%by_load) call refuse(group, 'load_N', &
                'must not be listed with &contact penetration_mm', '')
        end if
        if (max(size(case%shift_cksi), size(case%shift_ceta), size(case%shift_cphi)) == 0) return
        if (case%creepage_by_formula) call refuse(group, 'cksi', &
            'must not be listed with &motion creepage formula', '')
        call take_listed('cksi', case%creepage%cksi, case%shift_cksi)
        call take_listed('ceta', case%creepage%ceta, case%shift_ceta)
        call take_listed('cphi_rad_per_mm', case%creepage%cphi, case%shift_cphi)

    contains

        !> What is not listed is that of `&motion`.
        subroutine take_listed(key, usual, list)
            character(len=*), intent(in) :: key
            real(wp), intent(in) :: usual
            real(wp), allocatable, intent(inout) :: list(:)

            if (.not. is_set(group, key)) list = spread(usual, 1, size(case%shifts))
            call need_as_many(key, size(list))
        end subroutine take_listed

        subroutine need_as_many(key, given)
            character(len=*), intent(in) :: key
            integer, intent(in) :: given

            if (given /= size(case%shifts)) &
                call refuse(group, key, 'must have as many numbers as shifts, ' &
                            // integer_text(size(case%shifts)), integer_text(given))
        end subroutine need_as_many
    end subroutine read_sweep_group
end module faststrip_command_settings_case_file
