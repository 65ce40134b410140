!> What is done to the points of a profile on request, and the words for what was done.
module faststrip_files_profile_cleaning
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text, set_status, &
                                     st_bad_argument, st_too_few_points
    use faststrip_base_text, only: integer_text
    use faststrip_geometry_arc_spline, only: find_kinks, standard_kink_angle
    use faststrip_geometry_cleaning, only: keep_range, drop_double, drop_folds, turn_points, &
                                           resample
    use faststrip_geometry_curve_smoothing, only: smooth_by_wavelength, smooth_by_noise
    use faststrip_files_profile_points, only: profile_file_t
    implicit none
    private

    public :: cleaning_t, check_cleaning, clean

    real(wp), parameter :: mm_per_um = 1.0e-3_wp

    !> What is to be done, in the order of the members.
    type :: cleaning_t
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
    end type cleaning_t

contains

    !> Can it be done?
    pure subroutine check_cleaning(cleaning, status)
        type(cleaning_t), intent(in) :: cleaning !! what is to be done
        type(status_t), intent(out) :: status    !! `st_bad_argument`: a number that cannot be

        call clear_status(status)
        associate (lengths => [cleaning%wavelength, cleaning%noise, cleaning%step])
            if (.not. all(ieee_is_finite([cleaning%keep, cleaning%double, cleaning%shift, &
                                          cleaning%turn, cleaning%kink_angle, lengths]))) then
                call set_status(status, st_bad_argument, &
                                'what is asked of a profile must be finite numbers')
            else if (cleaning%keeps .and. .not. cleaning%keep(2) > cleaning%keep(1)) then
                call set_status(status, st_bad_argument, 'the range that is kept must end above ' &
                                // 'its beginning, got ' // trim(number_text(cleaning%keep(1))) &
                                // ' to ' // trim(number_text(cleaning%keep(2))) // ' mm')
            else if (any(lengths < 0.0_wp)) then
                call set_status(status, st_bad_argument, 'wavelength, noise and step must not ' // &
                                'be negative, got ' // trim(number_text(minval(lengths))) // ' mm')
            else if (all(lengths(:2) > 0.0_wp)) then
                call set_status(status, st_bad_argument, 'a profile must be smoothed by a ' // &
                                'wavelength or by its noise, not by both')
            else if (.not. cleaning%kink_angle > 0.0_wp) then
                call set_status(status, st_bad_argument, 'the angle of a kink must be above 0, ' &
                                // 'got ' // number_text(cleaning%kink_angle))
            end if
        end associate
    end subroutine check_cleaning

    !> Do it.
    subroutine clean(cleaning, profile, done, status)
        type(cleaning_t), intent(in) :: cleaning             !! what is to be done
        type(profile_file_t), intent(inout) :: profile       !! y and z change
        character(len=:), allocatable, intent(out) :: done   !! in words; empty: nothing
        type(status_t), intent(out) :: status                !! of what failed

        real(wp) :: rms, wavelength
        integer :: n

        call clear_status(status)
        done = ''
        n = size(profile%y)
        if (cleaning%keeps) then
            call keep_range(profile%y, profile%z, cleaning%keep(1), cleaning%keep(2))
            call say_dropped('outside ' // trim(number_text(cleaning%keep(1))) // ' to ' // &
                             trim(number_text(cleaning%keep(2))) // ' mm')
        end if
        if (cleaning%double >= 0.0_wp) then
            call drop_double(profile%y, profile%z, cleaning%double)
            call say_dropped('within ' // trim(number_text(cleaning%double)) // ' mm of another')
        end if
        if (cleaning%folds) then
            call drop_folds(profile%y, profile%z)
            call say_dropped('that turn back')
        end if
        if (size(profile%y) < 2) then
            call set_status(status, st_too_few_points, 'no points are left of the profile')
            return
        end if
        if (cleaning%mirror) then
            n = size(profile%y)
            profile%y = -profile%y(n:1:-1)
            profile%z = profile%z(n:1:-1)
            call say('mirrored')
        end if
        if (any(abs(cleaning%shift) > 0.0_wp)) then
            profile%y = profile%y + cleaning%shift(1)
            profile%z = profile%z + cleaning%shift(2)
            call say('shifted by ' // trim(number_text(cleaning%shift(1))) // ', ' // &
                     trim(number_text(cleaning%shift(2))) // ' mm')
        end if
        if (abs(cleaning%turn) > 0.0_wp) then
            call turn_points(profile%y, profile%z, cleaning%turn)
            call say('turned by ' // trim(number_text(cleaning%turn)) // ' rad')
        end if
        if (cleaning%wavelength > 0.0_wp) then
            call smooth_by_wavelength(profile%y, profile%z, kinks(), cleaning%wavelength, rms, &
                                      status)
            if (is_error(status)) return
            call say_smoothed(cleaning%wavelength)
        else if (cleaning%noise > 0.0_wp) then
            call smooth_by_noise(profile%y, profile%z, kinks(), cleaning%noise, wavelength, rms, &
                                 status)
            if (is_error(status)) return
            call say_smoothed(wavelength)
        end if
        if (.not. cleaning%step > 0.0_wp) return
        call resample(profile%y, profile%z, cleaning%step, &
                      merge(2.0_wp*pi, cleaning%kink_angle, cleaning%rounds), status)
        if (is_error(status)) return
        call say('resampled every ' // trim(number_text(cleaning%step)) // ' mm')

    contains

        function kinks() result(is_kink)
            logical, allocatable :: is_kink(:)

            allocate (is_kink(size(profile%y)), source=.false.)
            if (.not. cleaning%rounds) &
                call find_kinks(profile%y, profile%z, cleaning%kink_angle, is_kink)
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
    end subroutine clean
end module faststrip_files_profile_cleaning
