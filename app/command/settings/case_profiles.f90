!> The profiles of a case file: the standard ones by name, others from files.
module faststrip_command_settings_case_profiles
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: doubt_about, of_radius, of_gauge, of_tread_line, &
                                        of_gauge_depth, of_inclination, of_profile_width
    use faststrip_base_status, only: status_t, is_error, message_length, number_text
    use faststrip_base_text, only: integer_text, lower_case
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_curve_profile, unset_inclination
    use faststrip_geometry_gauge_fit, only: find_back_spacing
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_touchable, only: touchable_t, touchable_words
    use faststrip_files_profile, only: read_profile, profile_file_t, profile_options_t, &
                                       length_unit, body_wheel, body_rail
    use faststrip_command_program_console, only: fail_on_error, printable, hold
    use faststrip_command_settings_doubts, only: hold_value
    use faststrip_command_program_files, only: take_input
    use faststrip_command_settings_methods, only: word_length
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, find_group, sets, &
                                                   refuse
    use faststrip_command_settings_namelist_values, only: reading_t, next_lines, refuse_values, &
                                                          name_length
    use faststrip_command_settings_case_values, only: unset, need_finite, need_positive
    implicit none
    private

    public :: read_wheel_group, read_rail_group, complete_wheelset, shape_t, left_wheel_t, beside
    public :: path_length, hold_width

    integer, parameter :: path_length = 512
    ! Of a file with both sides.
    integer, parameter :: left_side = -1

    character(len=name_length), parameter :: wheel_names(*) = [character(len=name_length) :: &
        'profile', 'profile_left', 'radius_mm', 'radius_left_mm', 'back_spacing_mm', &
        'tread_line_mm', 'y_positive_to', 'z_positive_to', 'unit', 'section', 'side', &
        'any_count', 'ignore_smoothing', 'tape_circle_mm']
    character(len=name_length), parameter :: rail_names(*) = [character(len=name_length) :: &
        'profile', 'profile_left', 'inclination', 'cant', 'gauge_mm', 'gauge_depth_mm', &
        'rail_distance_mm', 'y_positive_to', 'z_positive_to', 'unit', 'section', 'side', &
        'any_count', 'ignore_smoothing']

    !> A profile that a case file names.
    type :: shape_t
        character(len=:), allocatable :: name  !! `s1002`, `uic60`, ... or the file's name
        character(len=:), allocatable :: words !! what was noticed of the file; or empty
        type(profile_t) :: profile             !! in the frame of a right wheel or rail
    end type shape_t

    !> The left wheel of a case file; where it says nothing, as the right one.
    type, extends(shape_t) :: left_wheel_t
        real(wp) :: radius = 0.0_wp !! rolling radius at the mean tread line, mm
    end type left_wheel_t

    !> How a profile file is to be read, as a case file says it.
    type :: file_words_t
        character(len=word_length) :: y_positive_to = ''
        character(len=word_length) :: z_positive_to = ''
        character(len=word_length) :: unit = ''
        character(len=word_length) :: side = 'right'
        integer :: section = 0
        logical :: any_count = .false.
        logical :: ignore_smoothing = .false.
    end type file_words_t

contains

    !> Read the group of the wheel. Without `left` the names of a left wheel are refused.
    subroutine read_wheel_group(content, required, wheelset, right, left)
        type(namelist_file_t), intent(in) :: content       !! a case file
        logical, intent(in) :: required                    !! else nothing is taken
        type(wheelset_t), intent(inout) :: wheelset        !! mm; radius of the right wheel; flange
                                                           !! backs 0 apart where nothing is said
        type(shape_t), intent(inout) :: right              !! the right wheel
        type(left_wheel_t), intent(inout), optional :: left !! the left wheel

        character(len=path_length) :: profile, profile_left
        character(len=word_length) :: y_positive_to, z_positive_to, unit, side
        integer :: section
        logical :: any_count, ignore_smoothing
        real(wp) :: radius_mm, radius_left_mm, back_spacing_mm, tread_line_mm, tape_circle_mm
        namelist /wheel/ profile, profile_left, radius_mm, radius_left_mm, back_spacing_mm, &
            tread_line_mm, y_positive_to, z_positive_to, unit, section, side, any_count, &
            ignore_smoothing, tape_circle_mm
        type(file_words_t) :: default
        type(profile_options_t) :: options
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        profile = ''
        profile_left = ''
        radius_mm = wheelset%radius
        radius_left_mm = unset()
        back_spacing_mm = wheelset%back_spacing
        tread_line_mm = wheelset%tread_line
        tape_circle_mm = 0.0_wp
        y_positive_to = default%y_positive_to
        z_positive_to = default%z_positive_to
        unit = default%unit
        side = default%side
        section = default%section
        any_count = default%any_count
        ignore_smoothing = default%ignore_smoothing
        right%words = ''
        call find_group(content, 'wheel', required, group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=wheel, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, wheel_names, reading)
        end do
        if (.not. present(left)) call refuse_left(content, group, &
            [character(len=name_length) :: 'profile_left', 'radius_left_mm'])
        if (.not. required) return
        call need_positive(content, group, 'radius_mm', radius_mm)
        if (.not. sets(content, group, 'radius_left_mm')) radius_left_mm = radius_mm
        call need_positive(content, group, 'radius_left_mm', radius_left_mm)
        call need_positive(content, group, 'back_spacing_mm', back_spacing_mm)
        call need_positive(content, group, 'tread_line_mm', tread_line_mm)
        call hold_value(content, group, 'radius_mm', of_radius, radius_mm)
        call hold_value(content, group, 'radius_left_mm', of_radius, radius_left_mm)
        call hold_value(content, group, 'back_spacing_mm', of_gauge, back_spacing_mm)
        call hold_value(content, group, 'tread_line_mm', of_tread_line, tread_line_mm)
        ! Where it is not said it follows from the track.
        if (.not. sets(content, group, 'back_spacing_mm')) back_spacing_mm = 0.0_wp
        wheelset = wheelset_t(back_spacing_mm, tread_line_mm, radius_mm)
        call need_finite(content, group, 'tape_circle_mm', tape_circle_mm)
        options%kind = body_wheel
        options%has_tape_circle = sets(content, group, 'tape_circle_mm')
        options%tape_circle = tape_circle_mm
        call take_words(content, group, file_words_t(y_positive_to, z_positive_to, unit, side, &
                        section, any_count, ignore_smoothing), options)
        call take_wheel(content, group, 'profile', profile, options, right)
        if (.not. present(left)) return
        left%radius = radius_left_mm
        left%shape_t = right
        if (.not. sets(content, group, 'profile_left')) return
        options%side = left_side
        call take_wheel(content, group, 'profile_left', profile_left, options, left%shape_t)
    end subroutine read_wheel_group

    !> The wheel of a name, or of a file.
    subroutine take_wheel(content, group, key, profile, options, shape)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key, profile
        type(profile_options_t), intent(in) :: options
        type(shape_t), intent(inout) :: shape

        type(status_t) :: status

        shape%name = trim(profile)
        shape%words = ''
        select case (lower_case(profile))
        case (''); call refuse(content, group, key, 'must be given', '')
        case ('s1002', 'cone20', 'cone40')
            shape%name = lower_case(trim(profile))
            call make_wheel_profile(shape%name, shape%profile, status)
            call fail_on_error(status)
        case default
            call read_points(content, group, profile, options, 0.0_wp, shape)
        end select
    end subroutine take_wheel

    !> Read the group of the rail. Without `left` the names of a left rail are refused.
    subroutine read_rail_group(content, required, track, right, left)
        type(namelist_file_t), intent(in) :: content   !! a case file
        logical, intent(in) :: required                !! else nothing is taken
        type(track_t), intent(inout) :: track          !! mm
        type(shape_t), intent(inout) :: right          !! the right rail, inclined
        type(shape_t), intent(inout), optional :: left !! the left rail, inclined

        character(len=path_length) :: profile, profile_left
        character(len=word_length) :: y_positive_to, z_positive_to, unit, side
        integer :: section
        logical :: any_count, ignore_smoothing
        real(wp) :: inclination, cant, gauge_mm, gauge_depth_mm, rail_distance_mm
        namelist /rail/ profile, profile_left, inclination, cant, gauge_mm, gauge_depth_mm, &
            rail_distance_mm, y_positive_to, z_positive_to, unit, section, side, any_count, &
            ignore_smoothing
        type(file_words_t) :: default
        type(profile_options_t) :: options
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code

        profile = ''
        profile_left = ''
        inclination = unset_inclination
        cant = unset_inclination
        gauge_mm = track%gauge
        gauge_depth_mm = track%gauge_depth
        rail_distance_mm = unset()
        y_positive_to = default%y_positive_to
        z_positive_to = default%z_positive_to
        unit = default%unit
        side = default%side
        section = default%section
        any_count = default%any_count
        ignore_smoothing = default%ignore_smoothing
        right%words = ''
        call find_group(content, 'rail', required, group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=rail, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, rail_names, reading)
        end do
        if (.not. present(left)) call refuse_left(content, group, &
            [character(len=name_length) :: 'profile_left'])
        if (.not. required) return
        call need_positive(content, group, 'gauge_mm', gauge_mm)
        call need_positive(content, group, 'gauge_depth_mm', gauge_depth_mm)
        call hold_value(content, group, 'gauge_mm', of_gauge, gauge_mm)
        call hold_value(content, group, 'gauge_depth_mm', of_gauge_depth, gauge_depth_mm)
        call hold_value(content, group, 'rail_distance_mm', of_gauge, rail_distance_mm)
        call hold_value(content, group, 'inclination', of_inclination, inclination)
        call hold_value(content, group, 'cant', of_inclination, cant)
        track = track_t(gauge_mm, gauge_depth_mm)
        if (sets(content, group, 'rail_distance_mm')) then
            call need_positive(content, group, 'rail_distance_mm', rail_distance_mm)
            if (sets(content, group, 'gauge_mm') .or. sets(content, group, 'gauge_depth_mm')) &
                call refuse(content, group, 'rail_distance_mm', &
                            'must not be given with gauge_mm or gauge_depth_mm', &
                            number_text(rail_distance_mm))
            track%rail_distance = rail_distance_mm
        end if
        call take_alias()
        options%kind = body_rail
        call take_words(content, group, file_words_t(y_positive_to, z_positive_to, unit, side, &
                        section, any_count, ignore_smoothing), options)
        call take_rail(content, group, 'profile', profile, inclination, options, right)
        if (.not. present(left)) return
        left = right
        if (.not. sets(content, group, 'profile_left')) return
        options%side = left_side
        call take_rail(content, group, 'profile_left', profile_left, inclination, options, left)

    contains

        !> The older name of the inclination.
        subroutine take_alias()
            if (.not. sets(content, group, 'cant')) return
            if (sets(content, group, 'inclination')) call refuse(content, group, 'cant', &
                'must not be given with inclination, which is its name', number_text(cant))
            inclination = cant
        end subroutine take_alias
    end subroutine read_rail_group

    !> The rail of a name, or of a file.
    subroutine take_rail(content, group, key, profile, inclination, options, shape)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key, profile
        real(wp), intent(in) :: inclination
        type(profile_options_t), intent(in) :: options
        type(shape_t), intent(inout) :: shape

        character(len=name_length) :: name
        type(status_t) :: status

        name = merge('cant       ', 'inclination', sets(content, group, 'cant'))
        call need_finite(content, group, trim(name), inclination)
        if (sets(content, group, trim(name)) .and. abs(inclination) > 1.0_wp) &
            call refuse(content, group, trim(name), 'must be the tangent of the rail ' // &
                        'inclination, -1 to 1', number_text(inclination))
        shape%name = trim(profile)
        shape%words = ''
        select case (lower_case(profile))
        case (''); call refuse(content, group, key, 'must be given', '')
        case ('uic60', '60e1', '54e1')
            shape%name = lower_case(trim(profile))
            call make_rail_profile(shape%name, inclination, shape%profile, status)
            if (is_error(status)) call refuse(content, group, trim(name), status%message, '')
        case default
            call read_points(content, group, profile, options, inclination, shape)
        end select
    end subroutine take_rail

    !> Flange backs of which nothing is said are as far apart as belongs to the track.
    subroutine complete_wheelset(content, track, wheelset)
        type(namelist_file_t), intent(in) :: content !! a case file, both groups read
        type(track_t), intent(in) :: track           !! mm
        type(wheelset_t), intent(inout) :: wheelset  !! mm

        type(group_t) :: group
        type(status_t) :: status

        if (abs(wheelset%back_spacing) > 0.0_wp) return
        call find_back_spacing(track%gauge, track%rail_distance, wheelset%back_spacing, status)
        if (.not. is_error(status)) return
        call find_group(content, 'wheel', .true., group)
        call refuse(content, group, 'back_spacing_mm', &
                    trim(status%message(index(status%message, 'must'):)), '')
    end subroutine complete_wheelset

    !> Keep words about a profile that is too wide or too narrow for the wheel.
    subroutine hold_width(content, shape, radius)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(shape_t), intent(in) :: shape           !! a wheel or a rail
        real(wp), intent(in) :: radius               !! rolling radius, mm

        character(len=message_length) :: words

        words = doubt_about(of_profile_width, 'the width of ' // printable(shape%name), &
                            shape%profile%y_last - shape%profile%y_first, radius)
        if (words /= '') call hold(trim(words) // ' (' // content%file // ')')
    end subroutine hold_width

    !> What knows one wheel takes no name of the other side.
    subroutine refuse_left(content, group, names)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: names(:)

        integer :: i

        do i = 1, size(names)
            if (sets(content, group, trim(names(i)))) &
                call refuse(content, group, trim(names(i)), &
                            'must not be given for one contact, of the right wheel', '')
        end do
    end subroutine refuse_left

    !> What the words of a case file mean.
    subroutine take_words(content, group, words, options)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        type(file_words_t), intent(in) :: words
        type(profile_options_t), intent(inout) :: options

        options%y_sense = sense_of('y_positive_to', words%y_positive_to, 'field', 'gauge')
        options%z_sense = sense_of('z_positive_to', words%z_positive_to, 'down', 'up')
        options%side = sense_of('side', words%side, 'right', 'left')
        if (words%unit /= '') then
            options%unit_mm = length_unit(trim(words%unit))
            if (.not. options%unit_mm > 0.0_wp) &
                call refuse(content, group, 'unit', 'must be mm, m or in', words%unit)
        end if
        if (words%section < 0) &
            call refuse(content, group, 'section', 'must be from 1 on', integer_text(words%section))
        options%section = words%section
        options%any_count = words%any_count
        options%ignore_smoothing = words%ignore_smoothing

    contains

        !> +1 or -1 for one of two words, 0 for none.
        integer function sense_of(name, word, positive, negative) result(sense)
            character(len=*), intent(in) :: name, word, positive, negative

            sense = 0
            if (word == positive) sense = 1
            if (word == negative) sense = -1
            if (sense == 0 .and. word /= '') call refuse(content, group, name, 'must be ' // &
                                                         positive // ' or ' // negative, word)
        end function sense_of
    end subroutine take_words

    subroutine read_points(content, group, path, options, inclination, shape)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: path
        type(profile_options_t), intent(in) :: options
        real(wp), intent(in) :: inclination
        type(shape_t), intent(inout) :: shape

        type(status_t) :: status
        type(profile_file_t) :: points
        type(touchable_t) :: part
        character(len=:), allocatable :: file

        file = beside(content%file, trim(path))
        call take_input(file)
        call read_profile(file, options, points, status)
        call fail_on_error(status)
        ! Only who measured a rail knows how it stands.
        if (.not. abs(inclination - unset_inclination) > 0.0_wp) &
            call refuse(content, group, 'inclination', 'must be given for the rail of ' // &
                        trim(path) // ': 0 if it stands as in the track, 0.025 to turn it by ' // &
                        '1:40', '')
        call make_curve_profile(points%y, points%z, options%kind, inclination, &
                                standard_kink_angle, shape%profile, part, status)
        call fail_on_error(status, file)
        shape%words = trim(touchable_words(part))
        if (points%notes /= '' .and. len(shape%words) > 0) shape%words = '; ' // shape%words
        shape%words = trim(points%notes) // shape%words
        if (len(shape%words) == 0) return
        shape%words = printable(file // ': ' // shape%words)
    end subroutine read_points

    !> A path that is relative to the folder of another file.
    pure function beside(file, path) result(resolved)
        character(len=*), intent(in) :: file     !! name of that file
        character(len=*), intent(in) :: path     !! as it stands there
        character(len=len(path) + merge(0, index(file, '/', back=.true.), index(path, '/') == 1)) &
            :: resolved

        resolved = path
        if (index(path, '/') /= 1) resolved = file(:index(file, '/', back=.true.)) // path
    end function beside
end module faststrip_command_settings_case_profiles
