!> Reading wheel and rail profiles of every format into one frame: y to the field side, z down, mm,
!> points along the curve from small y to large y; of a wheel y = 0 at the nominal rolling circle.
!>
!> The format is found by what stands in the file, then by the end of its name. Nothing is
!> repaired: what is no number ends the reading with the file, the line and the token; what lies
!> wrong is refused with the option that says how it lies.
module faststrip_files_profile
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_file_format
    use faststrip_base_text, only: lower_case, integer_text, set_place_status
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t, line_t, &
                                              read_lines, without_comment, split_key, length_unit
    use faststrip_files_profile_simpack, only: read_simpack
    use faststrip_files_profile_miniprof, only: read_miniprof, is_miniprof_key
    use faststrip_files_profile_vampire, only: read_vampire
    use faststrip_files_profile_text, only: read_text_profile
    use faststrip_files_profile_senses, only: check_shape
    implicit none
    private

    public :: read_profile, profile_format_t, profile_formats, profile_file_t, profile_options_t
    public :: length_unit, ends_with
    public :: body_wheel, body_rail

    !> A format besides text of two columns.
    type :: profile_format_t
        character(len=8) :: name = ''       !! of the program
        character(len=6) :: endings(3) = '' !! of names: wheels, rails, either; lower case
    end type profile_format_t

    ! Formats: rows of the table.
    integer, parameter :: is_text = 0, is_miniprof = 1, is_simpack = 2, is_vampire = 3, &
                          is_gensys = 4

    !> All of them.
    type(profile_format_t), parameter :: profile_formats(*) = [ &
        profile_format_t('MiniProf', [character(len=6) :: '.whl', '.ban', '.mpt']), &
        profile_format_t('SIMPACK', [character(len=6) :: '.prw', '.prr', '']), &
        profile_format_t('VAMPIRE', [character(len=6) :: '.whe', '.rai', '']), &
        profile_format_t('GENSYS', [character(len=6) :: '.wheel', '.rail', ''])]

    ! Lines above the points that are looked at for the format.
    integer, parameter :: first_lines = 60

contains

    !> Read a profile.
    subroutine read_profile(path, options, profile, status)
        character(len=*), intent(in) :: path              !! name of the file
        type(profile_options_t), intent(in) :: options    !! what the user says about it
        type(profile_file_t), intent(out) :: profile      !! the points, and what is known of them
        type(status_t), intent(out) :: status             !! `st_file_missing`, `st_file_format`,
                                                          !! `st_too_few_points`,
                                                          !! `st_bad_argument`

        type(line_t), allocatable :: lines(:)

        allocate (profile%y(0), profile%z(0), profile%line(0), profile%keys(0))
        call check_options(options, status)
        if (is_error(status)) return
        call read_lines(path, lines, status)
        if (is_error(status)) return
        deallocate (profile%y, profile%z, profile%line, profile%keys)
        profile%kind = kind_of_name(path)
        select case (format_of(path, lines))
        case (is_simpack)
            ! The file itself says what it is.
            profile%kind = 0
            call read_simpack(path, lines, options, profile, status)
            if (profile%kind == 0) profile%kind = kind_of_name(path)
        case (is_miniprof)
            call read_miniprof(path, lines, options, profile, status)
        case (is_vampire)
            call read_vampire(path, lines, options, profile, status)
        case (is_gensys)
            call read_gensys(path, lines, options, profile, status)
        case default
            call read_text_profile(path, lines, .false., options, profile, status)
        end select
        if (.not. allocated(profile%keys)) allocate (profile%keys(0))
        if (.not. allocated(profile%y)) &
            allocate (profile%y(0), profile%z(0), profile%line(0))
        call end_arrays(profile)
        if (.not. is_error(status)) call check_kind(path, options, profile, status)
        if (.not. is_error(status)) then
            call take_frame(options, profile)
            call check_shape(path, profile, options, status)
        end if
        if (.not. is_error(status)) return
        profile%n = 0
        call end_arrays(profile)
    end subroutine read_profile

    subroutine check_options(options, status)
        type(profile_options_t), intent(in) :: options
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (max(abs(options%y_sense), abs(options%z_sense), abs(options%side)) > 1 &
            .or. options%side == 0) then
            call set_status(status, st_bad_argument, 'senses of y and z must be +1, -1 or 0, got ' &
                            // integer_text(options%y_sense) // ', ' &
                            // integer_text(options%z_sense))
        else if (.not. (options%unit_mm >= 0.0_wp .and. options%unit_mm <= huge(1.0_wp))) then
            call set_status(status, st_bad_argument, 'the unit must be above 0 mm, got ' // &
                            number_text(options%unit_mm))
        else if (all(options%kind /= [0, body_wheel, body_rail])) then
            call set_status(status, st_bad_argument, 'a profile must be of a wheel or of a rail')
        else if (options%section < 0) then
            call set_status(status, st_bad_argument, 'the section must be from 1 on, got ' // &
                            integer_text(options%section))
        else if (.not. abs(options%tape_circle) <= huge(1.0_wp)) then
            call set_status(status, st_bad_argument, 'the nominal rolling circle must be a ' &
                            // 'finite number, got ' // number_text(options%tape_circle))
        end if
    end subroutine check_options

    !> A wheel of GENSYS, or a rail, whose sense of y is not known.
    subroutine read_gensys(path, lines, options, profile, status)
        character(len=*), intent(in) :: path
        type(line_t), intent(in) :: lines(:)
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(out) :: status

        logical :: is_rail

        is_rail = profile%kind == body_rail
        call read_text_profile(path, lines, .not. is_rail, options, profile, status)
        profile%format = 'gensys'
        if (is_rail .and. .not. is_error(status) .and. options%y_sense == 0) &
            call set_place_status(status, st_file_format, 'the sense of y of a GENSYS rail ' &
                                  // 'must be given (--y-positive-to, or y_positive_to in a ' // &
                                  'case file)', '', path, 0)
    end subroutine read_gensys

    !> The kind that the end of a name stands for.
    pure integer function kind_of_name(path) result(kind)
        character(len=*), intent(in) :: path

        integer :: i

        kind = 0
        do i = 1, size(profile_formats)
            if (has_ending(path, i, 1)) kind = body_wheel
            if (has_ending(path, i, 2)) kind = body_rail
        end do
    end function kind_of_name

    pure logical function has_ending(path, format, which)
        character(len=*), intent(in) :: path
        integer, intent(in) :: format, which

        has_ending = len_trim(profile_formats(format)%endings(which)) > 0
        if (has_ending) has_ending = ends_with(path, trim(profile_formats(format)%endings(which)))
    end function has_ending

    !> By what stands in the file, then by its name.
    pure integer function format_of(path, lines) result(format)
        character(len=*), intent(in) :: path
        type(line_t), intent(in) :: lines(:)

        character(len=:), allocatable :: line, key, value
        integer :: i
        logical :: is_key

        format = is_text
        line = ''
        do i = 1, size(profile_formats)
            if (has_ending(path, i, 1) .or. has_ending(path, i, 2) .or. has_ending(path, i, 3)) &
                format = i
        end do
        do i = 1, min(size(lines), first_lines)
            line = lower_case(without_comment(lines(i)%text, '!%'))
            if (i == 1 .and. (line == 'wheelprofile' .or. line == 'railprofile')) then
                format = is_vampire
                return
            else if (i <= 3 .and. (index(line, 'miniprof') == 1 .or. index(line, '#mini') == 1 &
                                   .or. index(line, '[fileinfo]') == 1)) then
                format = is_miniprof
                return
            else if (line == 'header.begin' .or. line == 'spline.begin' &
                     .or. line == 'point.begin') then
                format = is_simpack
                return
            end if
            call split_key(line, key, value, is_key)
            if (.not. is_key) cycle
            if (.not. is_miniprof_key(key)) cycle
            format = is_miniprof
            return
        end do
    end function format_of

    !> Only the points there are.
    subroutine end_arrays(profile)
        type(profile_file_t), intent(inout) :: profile

        profile%y = profile%y(:profile%n)
        profile%z = profile%z(:profile%n)
        profile%line = profile%line(:profile%n)
        profile%keys = profile%keys(:profile%n_keys)
    end subroutine end_arrays

    !> What the user says of the kind must not contradict the file.
    subroutine check_kind(path, options, profile, status)
        character(len=*), intent(in) :: path
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(inout) :: status

        if (options%kind > 0 .and. profile%kind > 0 .and. options%kind /= profile%kind) then
            call set_place_status(status, st_file_format, 'the profile must be that of a ' // &
                                  trim(kind_name(options%kind)) // ', the file is that of a ' // &
                                  trim(kind_name(profile%kind)), '', path, 0)
        else if (options%kind > 0) then
            profile%kind = options%kind
        end if
        if (profile%kind /= body_wheel .and. options%has_tape_circle .and. .not. is_error(status)) &
            call set_place_status(status, st_file_format, 'a nominal rolling circle must be ' &
                                  // 'that of a wheel (--kind wheel)', '', path, 0)
    end subroutine check_kind

    pure function kind_name(kind) result(name)
        integer, intent(in) :: kind
        character(len=5) :: name

        name = merge('wheel', 'rail ', kind == body_wheel)
    end function kind_name

    !> Units, senses, the nominal rolling circle as origin, and the order of the points.
    subroutine take_frame(options, profile)
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile

        integer :: n

        if (options%unit_mm > 0.0_wp) profile%unit_mm = options%unit_mm
        if (options%y_sense /= 0) profile%y_sense = options%y_sense
        if (options%z_sense /= 0) profile%z_sense = options%z_sense
        if (options%has_tape_circle) profile%tape_circle = options%tape_circle
        if (profile%tape_circle > 0.0_wp) profile%flange_back = -profile%tape_circle
        profile%y = profile%y*profile%unit_mm*profile%y_sense
        profile%z = profile%z*profile%unit_mm*profile%z_sense
        if (profile%kind == body_wheel) profile%y = profile%y - profile%tape_circle
        n = profile%n
        if (n < 2) return
        profile%is_reversed = profile%y(n) < profile%y(1)
        if (.not. profile%is_reversed) return
        profile%y = profile%y(n:1:-1)
        profile%z = profile%z(n:1:-1)
        profile%line = profile%line(n:1:-1)
    end subroutine take_frame

    !> Does a file name end so, in upper or lower case?
    pure logical function ends_with(file, ending)
        character(len=*), intent(in) :: file   !! its name
        character(len=*), intent(in) :: ending !! in lower case

        ends_with = .false.
        if (len(file) < len(ending)) return
        ends_with = lower_case(file(len(file) - len(ending) + 1:)) == ending
    end function ends_with
end module faststrip_files_profile
