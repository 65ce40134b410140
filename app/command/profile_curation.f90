!> What `faststrip profile` does to points, each only if asked for, and the words for what was done.
module faststrip_command_profile_curation
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text, set_status, &
                                     st_too_few_points
    use faststrip_base_text, only: integer_text, parse_real
    use faststrip_geometry_arc_spline, only: find_kinks, standard_kink_angle
    use faststrip_geometry_curation, only: keep_range, drop_double, drop_folds, turn_points, &
                                           resample
    use faststrip_geometry_curve_smoothing, only: smooth_by_wavelength, smooth_by_noise
    use faststrip_files_profile, only: profile_file_t
    use faststrip_command_options, only: command_t, option_t, given, option_text, option_number, &
                                         refuse_value
    implicit none
    private

    public :: curation_t, curation_options, take_curation, curate

    real(wp), parameter :: degree = pi/180.0_wp
    real(wp), parameter :: mm_per_um = 1.0e-3_wp

    !> What is to be done, in the order of the members.
    type :: curation_t
        logical :: keeps = .false.            !! a range of y?
        real(wp) :: keep(2) = 0.0_wp          !! mm
        real(wp) :: double = -1.0_wp          !! leave out points as near as this, mm; below 0: none
        logical :: folds = .false.            !! leave out zig-zags?
        logical :: mirror = .false.           !! y to -y?
        real(wp) :: shift(2) = 0.0_wp         !! along y and z, mm
        real(wp) :: turn = 0.0_wp             !! from y to z, rad
        real(wp) :: wavelength = 0.0_wp       !! of smoothing, mm; 0: none
        real(wp) :: noise = 0.0_wp            !! of smoothing, mm; 0: none
        real(wp) :: step = 0.0_wp             !! of resampling, mm; 0: none
        real(wp) :: kink_angle = standard_kink_angle !! turn from which a point is a kink, rad
        logical :: rounds = .false.           !! smooth over kinks?
    end type curation_t

    !> The options of the command line.
    type(option_t), parameter :: curation_options(15) = [ &
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
        option_t('--round-kinks', '', 'smooth and resample over kinks'), &
        option_t('--tape-circle', 'MM', 'where the tape circle of a wheel is, in y of the file')]

contains

    !> Read the options.
    subroutine take_curation(command, curation)
        type(command_t), intent(in) :: command      !! a parsed command
        type(curation_t), intent(out) :: curation   !! what is to be done

        character(len=:), allocatable :: text
        integer :: comma
        logical :: valid(2)

        if (given(command, '--keep')) then
            text = option_text(command, '--keep', '')
            comma = index(text, ',')
            valid = .false.
            if (comma > 0) then
                call parse_real(text(:comma - 1), curation%keep(1), valid(1))
                call parse_real(text(comma + 1:), curation%keep(2), valid(2))
            end if
            if (.not. all(valid) .or. curation%keep(2) <= curation%keep(1)) &
                call refuse_value(command, '--keep', 'FROM,TO, the second number larger')
            curation%keeps = .true.
        end if
        if (given(command, '--inclination') .and. given(command, '--cant')) &
            call refuse_value(command, '--cant', 'given without --inclination, which is its name')
        curation%double = option_number(command, '--drop-double', -1.0_wp, least=0)
        curation%folds = given(command, '--drop-folds')
        curation%mirror = given(command, '--mirror')
        curation%shift = [option_number(command, '--shift-y', 0.0_wp), &
                          option_number(command, '--shift-z', 0.0_wp)]
        curation%turn = degree*option_number(command, '--rotate', 0.0_wp) &
                        - atan(option_number(command, '--inclination', &
                                             option_number(command, '--cant', 0.0_wp)))
        curation%wavelength = option_number(command, '--smooth-wavelength', 0.0_wp, above=0)
        curation%noise = mm_per_um*option_number(command, '--smooth-noise', 0.0_wp, above=0)
        if (curation%wavelength > 0.0_wp .and. curation%noise > 0.0_wp) &
            call refuse_value(command, '--smooth-noise', 'given without --smooth-wavelength')
        curation%step = option_number(command, '--resample', 0.0_wp, above=0)
        curation%kink_angle = degree*option_number(command, '--kink-angle', &
                                                   standard_kink_angle/degree, above=0)
        curation%rounds = given(command, '--round-kinks')
    end subroutine take_curation

    !> Do it.
    subroutine curate(curation, profile, done, status)
        type(curation_t), intent(in) :: curation             !! what is to be done
        type(profile_file_t), intent(inout) :: profile       !! y and z change
        character(len=:), allocatable, intent(out) :: done   !! in words; empty: nothing
        type(status_t), intent(out) :: status                !! of what failed

        real(wp) :: rms, wavelength
        integer :: n

        call clear_status(status)
        done = ''
        n = size(profile%y)
        if (curation%keeps) then
            call keep_range(profile%y, profile%z, curation%keep(1), curation%keep(2))
            call say_dropped('outside ' // trim(number_text(curation%keep(1))) // ' to ' // &
                             trim(number_text(curation%keep(2))) // ' mm')
        end if
        if (curation%double >= 0.0_wp) then
            call drop_double(profile%y, profile%z, curation%double)
            call say_dropped('within ' // trim(number_text(curation%double)) // ' mm of another')
        end if
        if (curation%folds) then
            call drop_folds(profile%y, profile%z)
            call say_dropped('that turn back')
        end if
        if (size(profile%y) < 2) then
            call set_status(status, st_too_few_points, 'no points are left of the profile')
            return
        end if
        if (curation%mirror) then
            n = size(profile%y)
            profile%y = -profile%y(n:1:-1)
            profile%z = profile%z(n:1:-1)
            call say('mirrored')
        end if
        if (any(abs(curation%shift) > 0.0_wp)) then
            profile%y = profile%y + curation%shift(1)
            profile%z = profile%z + curation%shift(2)
            call say('shifted by ' // trim(number_text(curation%shift(1))) // ', ' // &
                     trim(number_text(curation%shift(2))) // ' mm')
        end if
        if (abs(curation%turn) > 0.0_wp) then
            call turn_points(profile%y, profile%z, curation%turn)
            call say('turned by ' // trim(number_text(curation%turn)) // ' rad')
        end if
        if (curation%wavelength > 0.0_wp) then
            call smooth_by_wavelength(profile%y, profile%z, kinks(), curation%wavelength, rms, &
                                      status)
            if (is_error(status)) return
            call say_smoothed(curation%wavelength)
        else if (curation%noise > 0.0_wp) then
            call smooth_by_noise(profile%y, profile%z, kinks(), curation%noise, wavelength, rms, &
                                 status)
            if (is_error(status)) return
            call say_smoothed(wavelength)
        end if
        if (.not. curation%step > 0.0_wp) return
        call resample(profile%y, profile%z, curation%step, &
                      merge(2.0_wp*pi, curation%kink_angle, curation%rounds), status)
        if (is_error(status)) return
        call say('resampled every ' // trim(number_text(curation%step)) // ' mm')

    contains

        function kinks() result(is_kink)
            logical, allocatable :: is_kink(:)

            allocate (is_kink(size(profile%y)), source=.false.)
            if (.not. curation%rounds) &
                call find_kinks(profile%y, profile%z, curation%kink_angle, is_kink)
        end function kinks

        subroutine say_smoothed(length)
            real(wp), intent(in) :: length

            call say('smoothed by a wavelength of ' // trim(number_text(length)) // &
                     ' mm, points moved by ' // trim(number_text(rms/mm_per_um)) // ' um (rms)')
        end subroutine say_smoothed

        subroutine say_dropped(which)
            character(len=*), intent(in) :: which

            call say(integer_text(n - size(profile%y)) // ' points ' // which // ' dropped')
            n = size(profile%y)
        end subroutine say_dropped

        subroutine say(words)
            character(len=*), intent(in) :: words

            if (len(done) > 0) done = done // ', '
            done = done // words
        end subroutine say
    end subroutine curate
end module faststrip_command_profile_curation
