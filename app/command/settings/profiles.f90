!> The wheels and rails of a case file: the standard ones by name, others from files.
module faststrip_command_settings_profiles
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: doubt_about, of_profile_width
    use faststrip_base_status, only: status_t, is_error, message_length, number_text
    use faststrip_base_text, only: lower_case
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_curve_profile, unset_inclination
    use faststrip_geometry_gauge_fit, only: find_back_spacing
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_touchable, only: touchable_t, touchable_words
    use faststrip_files_profile, only: read_profile, profile_file_t, profile_options_t, &
                                       length_unit, body_wheel, body_rail
    use faststrip_command_program_console, only: fail_on_error, printable, hold
    use faststrip_command_settings_group, only: case_text_t, group_t, read_group, is_set, &
                                                number_of, text_of, beside, take_file, refuse, &
                                                refuse_each
    use faststrip_command_settings_table, only: settings, value_t
    implicit none
    private

    public :: bodies_t, read_bodies, put_reading

    !> A profile that a case file names.
    type :: shape_t
        character(len=:), allocatable :: name  !! `s1002`, `uic60`, ... or the file's name
        character(len=:), allocatable :: words !! what was noticed of the file; or empty
        type(profile_t) :: profile             !! in the frame of a right wheel or rail
    end type shape_t

    !> The left wheel of a case file; where it says nothing, as the right one.
    type, extends(shape_t) :: left_wheel_t
        real(wp) :: radius = 0.0_wp !! nominal radius, mm
    end type left_wheel_t

    !> The groups `wheel` and `rail` of a case file. What it says of one side only holds for both.
    type :: bodies_t
        type(wheelset_t) :: wheelset        !! mm; the radius is the right wheel's
        type(track_t) :: track              !! mm
        type(shape_t) :: wheel              !! the right one
        type(shape_t) :: rail               !! the right one, inclined
        type(left_wheel_t) :: left_wheel    !! mirrored, in the frame of a right wheel
        type(shape_t) :: left_rail          !! inclined and mirrored, in the frame of a right rail
    end type bodies_t

contains

    !> Read both groups; ends the program with one line at the first thing that is wrong.
    subroutine read_bodies(content, is_required, both_sides, bodies)
        type(case_text_t), intent(in) :: content  !! a case file
        logical, intent(in) :: is_required        !! else only what stands there is checked
        logical, intent(in) :: both_sides         !! else the names of the left side are refused
        type(bodies_t), intent(inout) :: bodies   !! read

        type(group_t) :: wheel, rail

        bodies%wheel%words = ''
        bodies%rail%words = ''
        call read_group(content, 'wheel', wheel)
        if (.not. both_sides) call refuse_left(wheel, ['profile_left  ', 'radius_left_mm'])
        if (is_required) call take_wheels(wheel, both_sides, bodies)
        call read_group(content, 'rail', rail)
        if (.not. both_sides) call refuse_left(rail, ['profile_left'])
        if (.not. is_required) return
        call take_rails(rail, both_sides, bodies)
        call space_backs(wheel, bodies)
        call hold_width(wheel, bodies%wheel, bodies%wheelset%radius)
        if (both_sides) call hold_width(wheel, bodies%left_wheel%shape_t, bodies%wheelset%radius)
        call hold_width(rail, bodies%rail, bodies%wheelset%radius)
        if (both_sides) call hold_width(rail, bodies%left_rail, bodies%wheelset%radius)
    end subroutine read_bodies

    !> Set what one setting says about how the file of a profile is to be read.
    subroutine put_reading(options, key, value)
        type(profile_options_t), intent(inout) :: options !! gets it
        character(len=*), intent(in) :: key               !! name in a case file
        type(value_t), intent(in) :: value                !! as the table of settings allows it

        ! Given: the first of two words is +1, the second -1.
        integer, parameter :: sense(0:2) = [0, 1, -1]

        if (.not. value%is_given) return
        select case (key)
        case ('section'); options%section = value%whole
        case ('side'); options%side = sense(value%whole)
        case ('y_positive_to'); options%y_sense = sense(value%whole)
        case ('z_positive_to'); options%z_sense = sense(value%whole)
        case ('unit'); options%unit_mm = length_unit(value%text)
        case ('any_count'); options%any_count = value%flag
        case ('ignore_smoothing'); options%ignore_smoothing = value%flag
        case ('tape_circle_mm')
            options%has_tape_circle = .true.
            options%tape_circle = value%number
        end select
    end subroutine put_reading

    !> What a group says about how the files of its profiles are to be read.
    function reading_of(group, kind) result(options)
        type(group_t), intent(in) :: group
        integer, intent(in) :: kind
        type(profile_options_t) :: options

        integer :: i

        options%kind = kind
        do i = 1, size(group%row)
            call put_reading(options, trim(settings(group%row(i))%key), group%value(i))
        end do
    end function reading_of

    subroutine take_wheels(group, both_sides, bodies)
        type(group_t), intent(in) :: group
        logical, intent(in) :: both_sides
        type(bodies_t), intent(inout) :: bodies

        type(profile_options_t) :: options

        associate (wheelset => bodies%wheelset)
            wheelset%radius = number_of(group, 'radius_mm', wheelset%radius)
            wheelset%tread_line = number_of(group, 'tread_line_mm', wheelset%tread_line)
            ! Where it is not said it follows from the track.
            wheelset%back_spacing = number_of(group, 'back_spacing_mm', 0.0_wp)
        end associate
        options = reading_of(group, body_wheel)
        call take_wheel(group, 'profile', options, bodies%wheel)
        if (.not. both_sides) return
        bodies%left_wheel%shape_t = bodies%wheel
        bodies%left_wheel%radius = number_of(group, 'radius_left_mm', bodies%wheelset%radius)
        if (.not. is_set(group, 'profile_left')) return
        options%side = -1
        call take_wheel(group, 'profile_left', options, bodies%left_wheel%shape_t)
    end subroutine take_wheels

    !> The wheel of a name, or of a file.
    subroutine take_wheel(group, key, options, shape)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key
        type(profile_options_t), intent(in) :: options
        type(shape_t), intent(inout) :: shape

        type(status_t) :: status

        shape%name = trim(text_of(group, key, ''))
        shape%words = ''
        select case (lower_case(shape%name))
        case (''); call refuse(group, key, 'must be given', '')
        case ('s1002', 'cone20', 'cone40')
            shape%name = lower_case(shape%name)
            call make_wheel_profile(shape%name, shape%profile, status)
            call fail_on_error(status)
        case default
            call read_points(group, key, 's1002, cone20, cone40', options, 0.0_wp, shape)
        end select
    end subroutine take_wheel

    subroutine take_rails(group, both_sides, bodies)
        type(group_t), intent(in) :: group
        logical, intent(in) :: both_sides
        type(bodies_t), intent(inout) :: bodies

        type(profile_options_t) :: options

        associate (track => bodies%track)
            track%gauge = number_of(group, 'gauge_mm', track%gauge)
            track%gauge_depth = number_of(group, 'gauge_depth_mm', track%gauge_depth)
            track%rail_distance = number_of(group, 'rail_distance_mm', track%rail_distance)
            track%roller_radius = number_of(group, 'roller_radius_mm', track%roller_radius)
            if (is_set(group, 'rail_distance_mm') .and. &
                (is_set(group, 'gauge_mm') .or. is_set(group, 'gauge_depth_mm'))) &
                call refuse(group, 'rail_distance_mm', &
                            'must not be given with gauge_mm or gauge_depth_mm', &
                            number_text(track%rail_distance))
        end associate
        if (is_set(group, 'cant') .and. is_set(group, 'inclination')) &
            call refuse(group, 'cant', 'must not be given with inclination, which is its name', &
                        number_text(number_of(group, 'cant', 0.0_wp)))
        options = reading_of(group, body_rail)
        call take_rail(group, 'profile', options, bodies%rail)
        if (.not. both_sides) return
        bodies%left_rail = bodies%rail
        if (.not. is_set(group, 'profile_left')) return
        options%side = -1
        call take_rail(group, 'profile_left', options, bodies%left_rail)
    end subroutine take_rails

    !> The rail of a name, or of a file.
    subroutine take_rail(group, key, options, shape)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key
        type(profile_options_t), intent(in) :: options
        type(shape_t), intent(inout) :: shape

        real(wp) :: inclination
        type(status_t) :: status

        inclination = number_of(group, 'inclination', number_of(group, 'cant', unset_inclination))
        shape%name = trim(text_of(group, key, ''))
        shape%words = ''
        select case (lower_case(shape%name))
        case (''); call refuse(group, key, 'must be given', '')
        case ('uic60', '60e1', '54e1')
            shape%name = lower_case(shape%name)
            call make_rail_profile(shape%name, inclination, shape%profile, status)
            if (is_error(status)) &
                call refuse(group, trim(merge('cant       ', 'inclination', &
                                              is_set(group, 'cant'))), status%message, '')
        case default
            call read_points(group, key, 'uic60, 60e1, 54e1', options, inclination, shape)
        end select
    end subroutine take_rail

    !> Flange backs of which nothing is said are as far apart as belongs to the track.
    subroutine space_backs(group, bodies)
        type(group_t), intent(in) :: group
        type(bodies_t), intent(inout) :: bodies

        type(status_t) :: status

        if (is_set(group, 'back_spacing_mm')) return
        call find_back_spacing(bodies%track%gauge, bodies%track%rail_distance, &
                               bodies%wheelset%back_spacing, status)
        if (is_error(status)) call refuse(group, 'back_spacing_mm', &
            trim(status%message(index(status%message, 'must'):)), '')
    end subroutine space_backs

    !> Keep words about a profile that is too wide or too narrow for the wheel.
    subroutine hold_width(group, shape, radius)
        type(group_t), intent(in) :: group
        type(shape_t), intent(in) :: shape
        real(wp), intent(in) :: radius

        character(len=message_length) :: words

        words = doubt_about(of_profile_width, 'the width of ' // printable(shape%name), &
                            shape%profile%y_last - shape%profile%y_first, radius)
        if (words /= '') call hold(trim(words) // ' (' // group%file // ')')
    end subroutine hold_width

    !> What knows one wheel takes no name of the other side.
    subroutine refuse_left(group, keys)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: keys(:)

        call refuse_each(group, keys, 'must not be given for one contact, of the right wheel')
    end subroutine refuse_left

    subroutine read_points(group, key, names, options, inclination, shape)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key, names
        type(profile_options_t), intent(in) :: options
        real(wp), intent(in) :: inclination
        type(shape_t), intent(inout) :: shape

        type(status_t) :: status
        type(profile_file_t) :: points
        type(touchable_t) :: part
        character(len=:), allocatable :: file

        file = beside(group%file, shape%name)
        call take_file(group, key, file, names // ' or ')
        call read_profile(file, options, points, status)
        call fail_on_error(status)
        ! Only who measured a rail knows how it stands.
        if (.not. abs(inclination - unset_inclination) > 0.0_wp) &
            call refuse(group, 'inclination', 'must be given for the rail of ' // &
                        shape%name // ': 0 if it stands as in the track, 0.025 to turn it by ' // &
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
end module faststrip_command_settings_profiles
