!> Profile files in the C interface: what `include/faststrip.h` declares, and where it is
!> documented. The one call of the library that reads a file.
module faststrip_files_profile_c
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_null_char, c_ptr, c_size_t, &
                                           c_associated, c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_interop_c, only: put_text, numbers_at
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_files_printable, only: printable
    use faststrip_files_profile, only: profile_options_t
    use faststrip_files_profile_cleaning, only: cleaning_t
    use faststrip_files_profile_taken, only: taken_profile_t, take_profile
    implicit none
    private

    public :: faststrip_default_reading, faststrip_read_profile

    !> `faststrip_reading` of the header.
    type, bind(c) :: c_reading_t
        integer(c_size_t) :: size
        integer(c_int) :: kind, section, side, y_sense, z_sense, any_count, ignore_smoothing, &
                          has_tape_circle, keeps, drops_folds, mirrors, rounds_kinks
        real(c_double) :: unit, tape_circle, keep(2), double, shift(2), turn, wavelength, noise, &
                          step, kink_angle
    end type c_reading_t

    !> `faststrip_profile_about` of the header.
    type, bind(c) :: c_about_t
        integer(c_int) :: kind, has_flange
        real(c_double) :: sd, sh, qr
        character(kind=c_char) :: format(16)
    end type c_about_t

    !> Bytes of `faststrip_reading`.
    integer(c_size_t), parameter :: reading_size = 8 + 4*12 + 8*12
    !> Characters of a file's name.
    !> Given: Linux has no longer ones.
    integer, parameter :: longest_path = 4096

contains

    !> Fill in how a file is read if nothing is said about it.
    integer(c_int) function faststrip_default_reading(reading, length) bind(c) result(code)
        type(c_ptr), value :: reading      !! a `faststrip_reading`, written
        integer(c_size_t), value :: length !! its size as the caller knows it

        type(c_reading_t), pointer :: fields
        type(status_t) :: status

        call check_size(reading, length, status)
        code = status%code
        if (is_error(status)) return
        call c_f_pointer(reading, fields)
        fields = default_reading()
    end function faststrip_default_reading

    !> Read a profile of any format.
    integer(c_int) function faststrip_read_profile(path, reading, capacity, n, y, z, about, text, &
                                                   length) bind(c) result(code)
        type(c_ptr), value :: path         !! name of the file
        type(c_ptr), value :: reading      !! a `faststrip_reading`; or null
        integer(c_int), value :: capacity  !! length of the arrays
        type(c_ptr), value :: n            !! points of the profile, written
        type(c_ptr), value :: y, z         !! mm, written
        type(c_ptr), value :: about        !! a `faststrip_profile_about`, written; or null
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        type(environment_t) :: environment
        type(taken_profile_t) :: taken
        type(c_reading_t) :: fields
        type(status_t) :: status
        character(len=:), allocatable :: name, words

        words = ''
        call find_reading(reading, fields, status)
        if (.not. is_error(status)) call find_path(path, name, status)
        if (.not. is_error(status)) call check_arrays()
        if (.not. is_error(status)) then
            call hold_environment(environment)
            call take_profile(name, options_of(fields), cleaning_of(fields), taken, status)
            call restore_environment(environment)
            if (.not. is_error(status)) then
                words = printable(taken%words)
                call give()
            end if
        end if
        code = status%code
        if (is_error(status)) words = printable(trim(status%message))
        if (c_associated(text)) code = max(code, put_text(words, text, length))

    contains

        subroutine check_arrays()
            if (capacity < 0) then
                call set_status(status, st_bad_argument, 'the length of arrays must not be ' // &
                                'negative, got ' // count_text(capacity))
            else if (.not. (c_associated(n) .and. c_associated(y) .and. c_associated(z))) then
                call set_status(status, st_bad_argument, 'an array is missing')
            end if
        end subroutine check_arrays

        subroutine give()
            integer(c_int), pointer :: number
            real(c_double), pointer :: rows(:), heights(:)
            type(c_about_t), pointer :: known

            call c_f_pointer(n, number)
            number = size(taken%points%y)
            if (number > capacity) then
                call set_status(status, st_workspace_too_small, 'the profile has more points ' // &
                                'than the arrays: ' // count_text(number))
                return
            end if
            rows => numbers_at(y, number)
            heights => numbers_at(z, number)
            rows = taken%points%y
            heights = taken%points%z
            if (.not. c_associated(about)) return
            call c_f_pointer(about, known)
            known%kind = taken%points%kind
            known%has_flange = merge(1, 0, taken%flange%is_known)
            known%sd = taken%flange%sd
            known%sh = taken%flange%sh
            known%qr = taken%flange%qr
            known%format = transfer(trim(taken%points%format(:15)) // repeat(c_null_char, 16), &
                                    known%format)
        end subroutine give
    end function faststrip_read_profile

    pure type(c_reading_t) function default_reading() result(reading)
        type(cleaning_t) :: cleaning

        reading = c_reading_t(size=reading_size, kind=0, section=0, side=1, y_sense=0, z_sense=0, &
                              any_count=0, ignore_smoothing=0, has_tape_circle=0, keeps=0, &
                              drops_folds=0, mirrors=0, rounds_kinks=0, unit=0.0_c_double, &
                              tape_circle=0.0_c_double, keep=0.0_c_double, &
                              double=cleaning%double, shift=0.0_c_double, turn=0.0_c_double, &
                              wavelength=0.0_c_double, noise=0.0_c_double, step=0.0_c_double, &
                              kink_angle=standard_kink_angle)
    end function default_reading

    pure type(profile_options_t) function options_of(fields) result(options)
        type(c_reading_t), intent(in) :: fields

        options = profile_options_t(fields%kind, fields%section, fields%side, fields%y_sense, &
                                    fields%z_sense, fields%unit, fields%any_count /= 0, &
                                    fields%ignore_smoothing /= 0, fields%has_tape_circle /= 0, &
                                    fields%tape_circle)
    end function options_of

    pure type(cleaning_t) function cleaning_of(fields) result(cleaning)
        type(c_reading_t), intent(in) :: fields

        cleaning = cleaning_t(fields%keeps /= 0, fields%keep, fields%double, &
                              fields%drops_folds /= 0, fields%mirrors /= 0, fields%shift, &
                              fields%turn, fields%wavelength, fields%noise, fields%step, &
                              fields%kink_angle, fields%rounds_kinks /= 0)
    end function cleaning_of

    ! How a file is to be read, if the caller says it.
    subroutine find_reading(address, fields, status)
        type(c_ptr), intent(in) :: address
        type(c_reading_t), intent(out) :: fields
        type(status_t), intent(out) :: status

        type(c_reading_t), pointer :: given

        call clear_status(status)
        fields = default_reading()
        if (.not. c_associated(address)) return
        call c_f_pointer(address, given)
        call check_size(address, given%size, status)
        if (.not. is_error(status)) fields = given
    end subroutine find_reading

    ! Is there a reading, of the size that this library knows?
    subroutine check_size(address, length, status)
        type(c_ptr), intent(in) :: address
        integer(c_size_t), intent(in) :: length
        type(status_t), intent(out) :: status

        character(len=20) :: got

        call clear_status(status)
        write (got, '(i0)') length
        if (.not. c_associated(address)) then
            call set_status(status, st_bad_argument, 'the faststrip_reading is missing')
        else if (length /= reading_size) then
            call set_status(status, st_bad_argument, 'faststrip_reading must have the ' // &
                            trim(count_text(int(reading_size))) // ' bytes that ' // &
                            'faststrip_default_reading sets, got ' // got)
        end if
    end subroutine check_size

    ! The name of the file.
    subroutine find_path(address, path, status)
        type(c_ptr), intent(in) :: address
        character(len=:), allocatable, intent(out) :: path
        type(status_t), intent(inout) :: status

        character(kind=c_char), pointer :: letters(:)
        integer :: i, n

        path = ''
        if (.not. c_associated(address)) then
            call set_status(status, st_bad_argument, 'the name of the file is missing')
            return
        end if
        call c_f_pointer(address, letters, [longest_path + 1])
        do n = 0, longest_path
            if (letters(n + 1) == c_null_char) exit
        end do
        if (n > longest_path) then
            call set_status(status, st_bad_argument, 'the name of the file must have at most ' // &
                            trim(count_text(longest_path)) // ' characters')
            return
        end if
        deallocate (path)
        allocate (character(len=n) :: path)
        do i = 1, n
            path(i:i) = letters(i)
        end do
    end subroutine find_path
end module faststrip_files_profile_c
