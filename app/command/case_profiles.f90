!> The profiles of a case file: the standard ones by name, others from files.
module faststrip_command_case_profiles
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: lower_case
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_points_profile, standard_cant
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_files_profile, only: read_points_file, read_simpack_file, simpack_wheel, &
                                       simpack_rail
    use faststrip_command_console, only: fail_on_error
    use faststrip_command_files, only: take_input
    use faststrip_command_methods, only: word_length
    use faststrip_command_namelist, only: namelist_file_t, group_t, find_group, sets, refuse
    use faststrip_command_namelist_values, only: reading_t, next_lines, refuse_values, name_length
    use faststrip_command_case_values, only: unset, need_finite, need_positive
    implicit none
    private

    public :: read_wheel_group, read_rail_group, beside, path_length

    integer, parameter :: path_length = 512

    character(len=name_length), parameter :: wheel_names(*) = [character(len=name_length) :: &
        'profile', 'radius_mm', 'back_spacing_mm', 'tread_line_mm', &
        'y_positive_to', 'z_positive_to']
    character(len=name_length), parameter :: rail_names(*) = [character(len=name_length) :: &
        'profile', 'cant', 'gauge_mm', 'gauge_depth_mm', 'y_positive_to', 'z_positive_to']

contains

    !> Read the group of the wheel.
    subroutine read_wheel_group(content, required, wheelset, name, shape)
        type(namelist_file_t), intent(in) :: content       !! a case file
        logical, intent(in) :: required                    !! else nothing is taken
        type(wheelset_t), intent(inout) :: wheelset        !! mm
        character(len=:), allocatable, intent(out) :: name !! `s1002` or the file's name
        type(profile_t), intent(inout) :: shape            !! of the wheel

        character(len=path_length) :: profile
        character(len=word_length) :: y_positive_to, z_positive_to
        real(wp) :: radius_mm, back_spacing_mm, tread_line_mm
        namelist /wheel/ profile, radius_mm, back_spacing_mm, tread_line_mm, &
            y_positive_to, z_positive_to
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code
        type(status_t) :: status

        profile = ''
        radius_mm = wheelset%radius
        back_spacing_mm = wheelset%back_spacing
        tread_line_mm = wheelset%tread_line
        y_positive_to = 'field'
        z_positive_to = 'down'
        call find_group(content, 'wheel', required, group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=wheel, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, wheel_names, reading)
        end do
        if (.not. required) return
        call need_positive(content, group, 'radius_mm', radius_mm)
        call need_positive(content, group, 'back_spacing_mm', back_spacing_mm)
        call need_positive(content, group, 'tread_line_mm', tread_line_mm)
        wheelset = wheelset_t(back_spacing_mm, tread_line_mm, radius_mm)
        name = trim(profile)
        select case (profile)
        case (''); call refuse(content, group, 'profile', 'must be given', '')
        case ('s1002')
            call make_wheel_profile('s1002', shape, status)
            call fail_on_error(status)
        case default
            call read_points(content, group, profile, y_positive_to, z_positive_to, &
                             simpack_wheel, 0.0_wp, shape)
        end select
    end subroutine read_wheel_group

    !> Read the group of the rail.
    subroutine read_rail_group(content, required, track, name, shape)
        type(namelist_file_t), intent(in) :: content       !! a case file
        logical, intent(in) :: required                    !! else nothing is taken
        type(track_t), intent(inout) :: track              !! mm
        character(len=:), allocatable, intent(out) :: name !! `uic60`, `60e1` or the file's name
        type(profile_t), intent(inout) :: shape            !! of the rail, inclined

        character(len=path_length) :: profile
        character(len=word_length) :: y_positive_to, z_positive_to
        real(wp) :: cant, gauge_mm, gauge_depth_mm
        namelist /rail/ profile, cant, gauge_mm, gauge_depth_mm, y_positive_to, z_positive_to
        type(group_t) :: group
        type(reading_t) :: reading
        integer :: code
        type(status_t) :: status

        profile = ''
        cant = unset()
        gauge_mm = track%gauge
        gauge_depth_mm = track%gauge_depth
        y_positive_to = 'field'
        z_positive_to = 'down'
        call find_group(content, 'rail', required, group)
        do
            call next_lines(content, group, reading)
            if (.not. allocated(reading%text)) exit
            read (reading%text, nml=rail, iostat=code, iomsg=reading%words)
            if (code /= 0) call refuse_values(content, group, rail_names, reading)
        end do
        if (.not. required) return
        ! A drawn profile stands upright; a measured one is taken as it stands.
        if (.not. sets(content, group, 'cant')) &
            cant = merge(standard_cant, 0.0_wp, any(profile == ['uic60', '60e1 ']))
        call need_finite(content, group, 'cant', cant)
        call need_positive(content, group, 'gauge_mm', gauge_mm)
        call need_positive(content, group, 'gauge_depth_mm', gauge_depth_mm)
        track = track_t(gauge_mm, gauge_depth_mm)
        name = trim(profile)
        select case (profile)
        case (''); call refuse(content, group, 'profile', 'must be given', '')
        case ('uic60', '60e1')
            call make_rail_profile(trim(profile), cant, shape, status)
            if (is_error(status)) call refuse(content, group, 'cant', status%message, '')
        case default
            call read_points(content, group, profile, y_positive_to, z_positive_to, &
                             simpack_rail, cant, shape)
        end select
    end subroutine read_rail_group

    subroutine read_points(content, group, path, y_positive_to, z_positive_to, simpack_kind, &
                           cant, profile)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: path, y_positive_to, z_positive_to
        integer, intent(in) :: simpack_kind
        real(wp), intent(in) :: cant
        type(profile_t), intent(out) :: profile

        type(status_t) :: status
        character(len=:), allocatable :: file
        real(wp), allocatable :: y(:), z(:)

        if (y_positive_to /= 'field' .and. y_positive_to /= 'gauge') &
            call refuse(content, group, 'y_positive_to', 'must be field or gauge', &
                        y_positive_to)
        if (z_positive_to /= 'down' .and. z_positive_to /= 'up') &
            call refuse(content, group, 'z_positive_to', 'must be down or up', z_positive_to)
        file = beside(content%file, trim(path))
        call take_input(file)
        if (ends_with(file, '.prw') .or. ends_with(file, '.prr')) then
            call read_simpack_file(file, simpack_kind, y, z, status)
        else
            call read_points_file(file, merge(1, -1, y_positive_to == 'field'), &
                                  merge(1, -1, z_positive_to == 'down'), y, z, status)
        end if
        call fail_on_error(status)
        call make_points_profile(y, z, cant, profile, status)
        call fail_on_error(status, file)
    end subroutine read_points

    !> Does a file name end so, in upper or lower case?
    pure logical function ends_with(file, ending)
        character(len=*), intent(in) :: file, ending

        ends_with = .false.
        if (len(file) < len(ending)) return
        ends_with = lower_case(file(len(file) - len(ending) + 1:)) == ending
    end function ends_with

    !> A path that is relative to the folder of another file.
    pure function beside(file, path) result(resolved)
        character(len=*), intent(in) :: file     !! name of that file
        character(len=*), intent(in) :: path     !! as it stands there
        character(len=:), allocatable :: resolved

        resolved = path
        if (index(path, '/') /= 1) resolved = file(:index(file, '/', back=.true.)) // path
    end function beside
end module faststrip_command_case_profiles
