!> SIMPACK profiles, `.prw` of wheels and `.prr` of rails: `key = value` between `header.begin`
!> and `header.end`, `spline.begin` and `spline.end`, points between `point.begin` and `point.end`.
!>
!> The file's own changes are made in the order of the format: least distance of points, shift,
!> rotation, bounds (where the lower is below the upper, points outside are left out), mirror,
!> inversion, units. `!` and `%` begin comments. Layout: the comments SIMPACK writes into its
!> files, and the public readers of CONTACT (github.com/eve70a/CONTACT).
module faststrip_files_profile_simpack
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: parse_real, integer_text, lower_case, set_place_status
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t, line_t, &
                                              append_point, add_key, add_note, without_comment, &
                                              split_key, parse_words, unquoted, length_unit
    implicit none
    private

    public :: read_simpack

    ! What a file says about its points.
    type :: changes_t
        real(wp) :: least_distance = 0.0_wp
        real(wp) :: shift_y = 0.0_wp
        real(wp) :: shift_z = 0.0_wp
        real(wp) :: rotation = 0.0_wp
        real(wp) :: y_min = 1.0_wp
        real(wp) :: y_max = 0.0_wp
        real(wp) :: z_min = 1.0_wp
        real(wp) :: z_max = 0.0_wp
        real(wp) :: per_metre = 1000.0_wp
        real(wp) :: per_radian = 1.0_wp
        logical :: has_per_metre = .false.        ! does the file give the factor?
        logical :: has_per_radian = .false.
        real(wp) :: unit_mm = 0.0_wp              ! by its name; 0: not said
        real(wp) :: unit_per_radian = 0.0_wp
        logical :: mirror_y = .false.
        logical :: mirror_z = .false.
    end type changes_t

    ! Where in the file a line stands.
    integer, parameter :: in_none = 0, in_header = 1, in_spline = 2

    real(wp), parameter :: largest = 1.0e9_wp, smallest_factor = 1.0e-6_wp
    ! Factors of units that differ by less, relatively, are the same.
    real(wp), parameter :: unit_difference = 1.0e-2_wp
    ! In a metre.
    real(wp), parameter :: millimetres = 1000.0_wp

contains

    !> Read the lines of a file: y to the field side, z down, in mm.
    subroutine read_simpack(path, lines, options, profile, status)
        character(len=*), intent(in) :: path              !! name of the file
        type(line_t), intent(in) :: lines(:)              !! its lines
        type(profile_options_t), intent(in) :: options    !! what the user says
        type(profile_file_t), intent(inout) :: profile    !! the points
        type(status_t), intent(out) :: status             !! `st_file_format`

        type(changes_t) :: changes
        character(len=:), allocatable :: line, key, value
        real(wp) :: values(4)
        integer :: i, n, place
        logical :: in_points, has_points, is_key

        call clear_status(status)
        profile%format = 'simpack'
        place = in_none
        in_points = .false.
        has_points = .false.
        line = ''
        do i = 1, size(lines)
            line = without_comment(lines(i)%text, '!%')
            if (len(line) == 0) cycle
            select case (lower_case(line))
            case ('header.begin'); place = in_header
            case ('spline.begin'); place = in_spline
            case ('header.end', 'spline.end'); place = in_none
            case ('point.begin')
                if (has_points) call refuse('points must stand in one list', line)
                in_points = .true.
                has_points = .true.
            case ('point.end'); in_points = .false.
            case default
                if (in_points) then
                    call parse_words(line, 2, 3, path, i, values, n, status)
                    if (.not. is_error(status)) &
                        call append_point(profile, values(1), values(2), i)
                else
                    call split_key(line, key, value, is_key)
                    if (is_key) then
                        call take_key(lower_case(key), value, path, i, place, options, profile, &
                                      changes, status)
                    else
                        call refuse('a line must be "key = value"', line)
                    end if
                end if
            end select
            if (is_error(status)) return
        end do
        i = 0
        if (in_points .or. .not. has_points) then
            call refuse('no list between point.begin and point.end', '')
        else
            call take_units(changes, profile)
            call apply_changes(changes, profile)
        end if

    contains

        subroutine refuse(what, found)
            character(len=*), intent(in) :: what, found

            call set_place_status(status, st_file_format, what, found, path, i)
        end subroutine refuse
    end subroutine read_simpack

    subroutine take_key(key, text, path, number, place, options, profile, changes, status)
        character(len=*), intent(in) :: key, text, path
        integer, intent(in) :: number, place
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(changes_t), intent(inout) :: changes
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: range
        real(wp) :: value
        logical :: valid, flag

        call add_key(profile, key, text)
        call parse_real(text, value, valid)
        valid = valid .and. abs(value) <= largest
        flag = valid .and. (value == 0.0_wp .or. value == 1.0_wp)
        range = 'a finite number within 1e9'
        select case (key)
        case ('type')
            ! The one of the header; that in the spline part is the original file's.
            if (place == in_spline .or. place /= in_header .and. profile%kind > 0) return
            range = '0 (rail) or 1 (wheel)'
            valid = flag
            if (valid) profile%kind = merge(body_wheel, body_rail, value > 0.0_wp)
        case ('point.dist.min')
            range = 'a number from 0 to 1e9'
            valid = valid .and. value >= 0.0_wp
            changes%least_distance = value
        case ('shift.y'); changes%shift_y = value
        case ('shift.z'); changes%shift_z = value
        case ('rotate'); changes%rotation = value
        case ('bound.y.min'); changes%y_min = value
        case ('bound.y.max'); changes%y_max = value
        case ('bound.z.min'); changes%z_min = value
        case ('bound.z.max'); changes%z_max = value
        case ('mirror.y', 'mirror.z', 'inversion')
            range = '0 or 1'
            valid = flag
            if (key == 'mirror.y') changes%mirror_y = flag .and. value > 0.0_wp
            if (key == 'mirror.z') changes%mirror_z = flag .and. value > 0.0_wp
        case ('units.len.f', 'units.ang.f')
            range = '1e-6 to 1e9'
            valid = valid .and. value >= smallest_factor
            if (key == 'units.len.f') then
                changes%per_metre = value
                changes%has_per_metre = .true.
            else
                changes%per_radian = value
                changes%has_per_radian = .true.
            end if
        case ('units.len')
            range = 'mm, m or in'
            changes%unit_mm = length_unit(lower_case(unquoted(text)))
            valid = changes%unit_mm > 0.0_wp .or. len(unquoted(text)) == 0
        case ('units.ang')
            range = 'rad or deg'
            select case (lower_case(unquoted(text)))
            case ('rad'); changes%unit_per_radian = 1.0_wp
            case ('deg'); changes%unit_per_radian = 180.0_wp/pi
            end select
            valid = changes%unit_per_radian > 0.0_wp .or. len(unquoted(text)) == 0
        case ('approx.smooth')
            if (valid .and. abs(value) > 0.0_wp .and. options%ignore_smoothing) then
                call add_note(profile, 'approx.smooth of the file passed over')
            else if (valid .and. abs(value) > 0.0_wp) then
                call set_place_status(status, st_file_format, 'approx.smooth must be 0, or ' // &
                                      'passed over by --ignore-smoothing', text, path, number)
                return
            end if
        case default
            return
        end select
        if (valid) return
        call set_place_status(status, st_file_format, key // ' must be ' // range, &
                              "'" // text // "'", path, number)
    end subroutine take_key

    !> The factors of the units: a factor of the file, else the one of a unit's name. Where both
    !> are there and differ it is said.
    subroutine take_units(changes, profile)
        type(changes_t), intent(inout) :: changes
        type(profile_file_t), intent(inout) :: profile

        if (changes%unit_mm > 0.0_wp) then
            if (.not. changes%has_per_metre) then
                changes%per_metre = millimetres/changes%unit_mm
            else if (abs(changes%per_metre*changes%unit_mm - millimetres) > &
                     unit_difference*millimetres) then
                call add_note(profile, 'units.len.f taken, units.len of the file is another unit')
            end if
        end if
        if (changes%unit_per_radian > 0.0_wp) then
            if (.not. changes%has_per_radian) then
                changes%per_radian = changes%unit_per_radian
            else if (abs(changes%per_radian - changes%unit_per_radian) > &
                     unit_difference*changes%unit_per_radian) then
                call add_note(profile, 'units.ang.f taken, units.ang of the file is another unit')
            end if
        end if
    end subroutine take_units

    !> What the file wants done with its points, in the order of the format.
    subroutine apply_changes(changes, profile)
        type(changes_t), intent(in) :: changes
        type(profile_file_t), intent(inout) :: profile

        real(wp) :: y, z, turn, before(2)
        integer :: i, n, n_close, n_outside

        turn = changes%rotation/changes%per_radian
        profile%unit_mm = millimetres/changes%per_metre
        profile%y_sense = merge(-1, 1, changes%mirror_y)
        profile%z_sense = merge(-1, 1, changes%mirror_z)
        before = 0.0_wp
        n = 0
        n_close = 0
        n_outside = 0
        do i = 1, profile%n
            y = profile%y(i)
            z = profile%z(i)
            if (i > 1 .and. hypot(y - before(1), z - before(2)) < changes%least_distance) then
                n_close = n_close + 1
                cycle
            end if
            before = [y, z]
            y = y + changes%shift_y
            z = z + changes%shift_z
            if (abs(turn) > 0.0_wp) then
                y = y*cos(turn) - z*sin(turn)
                z = (before(1) + changes%shift_y)*sin(turn) + z*cos(turn)
            end if
            if (is_outside(y, changes%y_min, changes%y_max) .or. &
                is_outside(z, changes%z_min, changes%z_max)) then
                n_outside = n_outside + 1
                cycle
            end if
            n = n + 1
            profile%y(n) = y
            profile%z(n) = z
            profile%line(n) = profile%line(i)
        end do
        profile%n = n
        if (n_close > 0) call add_note(profile, integer_text(n_close) // &
                                       ' points left out by point.dist.min')
        if (n_outside > 0) call add_note(profile, integer_text(n_outside) // &
                                         ' points outside bound.y or bound.z left out')
        if (abs(turn) > 0.0_wp) call add_note(profile, 'rotated as the file says')
    end subroutine apply_changes

    pure logical function is_outside(value, least, most)
        real(wp), intent(in) :: value, least, most

        is_outside = least < most .and. (value < least .or. value > most)
    end function is_outside
end module faststrip_files_profile_simpack
