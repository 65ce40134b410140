!> The group `&friction` of a case file: friction that is not one number.
module faststrip_command_settings_case_friction
    use faststrip_base_friction, only: friction_t, friction_constant, friction_kind, &
                                       friction_kind_names
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: of_friction, of_contact_angle, of_slip_speed
    use faststrip_base_status, only: number_text
    use faststrip_base_text, only: lower_case
    use faststrip_command_settings_case_values, only: unset, need_finite, need_positive
    use faststrip_command_settings_doubts, only: hold_value
    use faststrip_command_settings_methods, only: one_of, word_length
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, find_group, sets, &
                                                   refuse
    use faststrip_command_settings_namelist_values, only: reading_t, next_lines, refuse_values, &
                                                          name_length
    implicit none
    private

    public :: read_friction_group

    character(len=name_length), parameter :: friction_names(*) = [character(len=name_length) :: &
        'kind', 'mu_kinetic', 'half_slip_speed_mm_s', 'initial_slope_factor', 'mu_flange', &
        'tread_angle_rad', 'flange_angle_rad']
    ! Names that need each other.
    character(len=name_length), parameter :: falling_names(*) = friction_names(2:3)
    character(len=name_length), parameter :: flange_names(*) = friction_names(5:7)

contains

    !> Read the group, if there is one.
    subroutine read_friction_group(content, mu, from_profiles, law)
        type(namelist_file_t), intent(in) :: content !! a case file
        real(wp), intent(in) :: mu                   !! of `&material`, checked
        logical, intent(in) :: from_profiles         !! is there a contact angle?
        type(friction_t), intent(inout) :: law      !! has the speed of `&motion`, 0 if not given

        character(len=word_length) :: kind
        real(wp) :: mu_kinetic, half_slip_speed_mm_s, initial_slope_factor, mu_flange, &
            tread_angle_rad, flange_angle_rad
        namelist /friction/ kind, mu_kinetic, half_slip_speed_mm_s, initial_slope_factor, &
            mu_flange, tread_angle_rad, flange_angle_rad
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        kind = 'constant'
        mu_kinetic = unset()
        half_slip_speed_mm_s = unset()
        initial_slope_factor = law%slope_factor
        mu_flange = unset()
        tread_angle_rad = unset()
        flange_angle_rad = unset()
        call find_group(content, 'friction', .false., group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=friction, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, friction_names, reading)
        end do
        law%kind = friction_kind(lower_case(kind))
        if (law%kind < 0) call refuse(content, group, 'kind', 'must be ' // &
                                           one_of(friction_kind_names), trim(kind))
        if (law%kind == friction_constant) then
            call refuse_each(content, group, falling_names, 'must not be given with kind constant')
        else
            call take_falling(content, group, mu, mu_kinetic, half_slip_speed_mm_s, trim(kind), law)
        end if
        call need_positive(content, group, 'initial_slope_factor', initial_slope_factor)
        if (initial_slope_factor > 1.0_wp) &
            call refuse(content, group, 'initial_slope_factor', 'must be at most 1', &
                        number_text(initial_slope_factor))
        law%slope_factor = initial_slope_factor
        if (.not. sets(content, group, 'mu_flange')) then
            call refuse_each(content, group, flange_names, 'must not be given without mu_flange')
            return
        end if
        if (.not. from_profiles) &
            call refuse(content, group, 'mu_flange', 'must not be given with a gap file, which ' &
                        // 'has no contact angle', number_text(mu_flange))
        call need_finite(content, group, 'mu_flange', mu_flange)
        call need_finite(content, group, 'tread_angle_rad', tread_angle_rad)
        call need_finite(content, group, 'flange_angle_rad', flange_angle_rad)
        if (mu_flange < 0.0_wp) call refuse(content, group, 'mu_flange', 'must not be negative', &
                                            number_text(mu_flange))
        if (mu <= 0.0_wp) call refuse(content, group, 'mu_flange', &
                                      'must not be given with &material mu 0', &
                                      number_text(mu_flange))
        call hold_value(content, group, 'mu_flange', of_friction, mu_flange)
        if (tread_angle_rad < 0.0_wp) call refuse(content, group, 'tread_angle_rad', &
                                                  'must not be negative', &
                                                  number_text(tread_angle_rad))
        if (flange_angle_rad <= tread_angle_rad) &
            call refuse(content, group, 'flange_angle_rad', 'must be above tread_angle_rad', &
                        number_text(flange_angle_rad))
        call hold_value(content, group, 'tread_angle_rad', of_contact_angle, tread_angle_rad)
        call hold_value(content, group, 'flange_angle_rad', of_contact_angle, flange_angle_rad)
        law%flange_share = mu_flange/mu
        law%tread_angle = tread_angle_rad
        law%flange_angle = flange_angle_rad
    end subroutine read_friction_group

    !> What falling friction needs.
    subroutine take_falling(content, group, mu, mu_kinetic, half_slip_speed, kind, law)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        real(wp), intent(in) :: mu, mu_kinetic, half_slip_speed
        character(len=*), intent(in) :: kind
        type(friction_t), intent(inout) :: law

        call need_positive(content, group, 'mu_kinetic', mu_kinetic)
        if (mu_kinetic > mu) call refuse(content, group, 'mu_kinetic', &
                                         'must be at most &material mu, the static value', &
                                         number_text(mu_kinetic))
        call need_positive(content, group, 'half_slip_speed_mm_s', half_slip_speed)
        call hold_value(content, group, 'half_slip_speed_mm_s', of_slip_speed, half_slip_speed)
        if (law%speed <= 0.0_wp) &
            call refuse(content, group, 'kind', 'must be constant without &motion speed_mm_s', &
                        kind)
        law%kinetic_share = mu_kinetic/mu
        law%half_slip_speed = half_slip_speed
    end subroutine take_falling

    subroutine refuse_each(content, group, names, what)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: names(:), what

        integer :: i

        do i = 1, size(names)
            if (sets(content, group, trim(names(i)))) &
                call refuse(content, group, trim(names(i)), what, '')
        end do
    end subroutine refuse_each
end module faststrip_command_settings_case_friction
