!> The options of `faststrip profile` that say what is done to points.
module faststrip_command_profile_cleaning
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_files_profile_cleaning, only: cleaning_t
    use faststrip_command_program_options, only: command_t, option_t, given, option_number, &
                                                 option_pair, refuse_value
    implicit none
    private

    public :: cleaning_options, take_cleaning

    ! Given: units.
    real(wp), parameter :: degree = pi/180.0_wp, mm_per_um = 1.0e-3_wp

    !> The options of the command line.
    type(option_t), parameter :: cleaning_options(14) = [ &
        option_t('--keep', 'FROM,TO', 'keep the points in this range of y, mm'), &
        option_t('--drop-double', 'MM', 'drop points no farther from the one before (0: in one' // &
                 new_line('a') // 'place)'), &
        option_t('--drop-folds', '', 'drop points in which the profile turns back'), &
        option_t('--mirror', '', 'mirror y'), &
        option_t('--shift-y', 'MM', 'shift along y'), &
        option_t('--shift-z', 'MM', 'shift along z'), &
        option_t('--rotate', 'DEG', 'turn about the origin, from y to z'), &
        option_t('--inclination', 'TANGENT', 'turn a rail so that its top leans to the gauge' // &
                 new_line('a') // 'side, 0.025 for 1:40'), &
        option_t('--cant', 'TANGENT', 'the same, by its older name'), &
        option_t('--smooth-wavelength', 'MM', 'halve waves of this length, remove shorter ones'), &
        option_t('--smooth-noise', 'UM', 'smooth for this standard deviation of the points'), &
        option_t('--resample', 'MM', 'points at this distance along the profile'), &
        option_t('--kink-angle', 'DEG', 'what turns by more in one point is a kink' // &
                 new_line('a') // '(default 20)'), &
        option_t('--round-kinks', '', 'smooth and resample over kinks')]

contains

    !> Read the options.
    subroutine take_cleaning(command, cleaning)
        type(command_t), intent(in) :: command      !! a parsed command
        type(cleaning_t), intent(out) :: cleaning   !! what is to be done

        if (given(command, '--keep')) then
            call option_pair(command, '--keep', '', 'FROM,TO', cleaning%keep)
            if (cleaning%keep(2) <= cleaning%keep(1)) &
                call refuse_value(command, '--keep', 'FROM,TO, the second number larger')
            cleaning%keeps = .true.
        end if
        if (given(command, '--inclination') .and. given(command, '--cant')) &
            call refuse_value(command, '--cant', 'given without --inclination, which is its name')
        cleaning%double = option_number(command, '--drop-double', -1.0_wp, least=0)
        cleaning%folds = given(command, '--drop-folds')
        cleaning%mirror = given(command, '--mirror')
        cleaning%shift = [option_number(command, '--shift-y', 0.0_wp), &
                          option_number(command, '--shift-z', 0.0_wp)]
        cleaning%turn = degree*option_number(command, '--rotate', 0.0_wp) &
                        - atan(option_number(command, '--inclination', &
                                             option_number(command, '--cant', 0.0_wp)))
        cleaning%wavelength = option_number(command, '--smooth-wavelength', 0.0_wp, above=0)
        cleaning%noise = mm_per_um*option_number(command, '--smooth-noise', 0.0_wp, above=0)
        if (cleaning%wavelength > 0.0_wp .and. cleaning%noise > 0.0_wp) &
            call refuse_value(command, '--smooth-noise', 'given without --smooth-wavelength')
        cleaning%step = option_number(command, '--resample', 0.0_wp, above=0)
        cleaning%kink_angle = degree*option_number(command, '--kink-angle', &
                                                   standard_kink_angle/degree, above=0)
        cleaning%rounds = given(command, '--round-kinks')
    end subroutine take_cleaning
end module faststrip_command_profile_cleaning
