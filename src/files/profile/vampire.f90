!> VAMPIRE profiles, `.whe` of wheels and `.rai` of rails.
!>
!> The first line says `WHEELPROFILE` or `RAILPROFILE`, the second is a title, the third is
!> `TREADDATUM` or `GAUGEPOINT` with `EUROPEAN`, `US`, `US1`, `US2` or `CUSTOM` and a length, the
!> fourth `FLANGEBACK` or `GAUGE` with a distance; then a line a point: y and z of the left side,
!> y and z of the right one, in mm, y from the middle of the track to the right. z of rails points
!> up, that of wheels down. Layout: the public reader of CONTACT
!> (github.com/eve70a/CONTACT, matlab/read_vampire.m).
module faststrip_files_profile_vampire
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, lower_case, set_place_status
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t, line_t, &
                                              append_point, add_key, without_comment, parse_words
    implicit none
    private

    public :: read_vampire

    real(wp), parameter :: inch = 25.4_wp
    ! Flange back to tread datum.
    real(wp), parameter :: european_datum = 70.0_wp
    real(wp), parameter :: us1_datum = (2.0_wp + 27.0_wp/32.0_wp)*inch
    real(wp), parameter :: us2_datum = (3.0_wp + 1.0_wp/16.0_wp)*inch
    ! Depth of the gauge point below the crown.
    real(wp), parameter :: european_gauge_point = 14.0_wp, us_gauge_point = 5.0_wp/8.0_wp*inch

    ! Lines above the points.
    integer, parameter :: header_lines = 4

contains

    !> Read the lines of a file: y to the field side, in mm, of a wheel from its tread datum.
    subroutine read_vampire(path, lines, options, profile, status)
        character(len=*), intent(in) :: path              !! name of the file
        type(line_t), intent(in) :: lines(:)              !! its lines
        type(profile_options_t), intent(in) :: options    !! the side that is wanted
        type(profile_file_t), intent(inout) :: profile    !! the points
        type(status_t), intent(out) :: status             !! `st_file_format`

        character(len=:), allocatable :: line
        real(wp) :: values(4), datum, distance, from_middle
        integer :: i, n

        call clear_status(status)
        profile%format = 'vampire'
        if (size(lines) < header_lines) then
            call set_place_status(status, st_file_format, 'a VAMPIRE file must have four lines ' &
                                  // 'above its points', '', path, 0)
            return
        end if
        profile%kind = merge(body_wheel, body_rail, lower_case(trim_blanks(lines(1)%text)) == &
                             'wheelprofile')
        call add_key(profile, 'title', lines(2)%text)
        if (profile%kind == body_wheel) then
            call take_length(path, lines, 3, 'treaddatum', profile, datum, status)
            if (.not. is_error(status)) &
                call take_length(path, lines, 4, 'flangeback', profile, distance, status)
        else
            call take_length(path, lines, 3, 'gaugepoint', profile, datum, status)
            if (.not. is_error(status)) &
                call take_length(path, lines, 4, 'gauge', profile, distance, status)
            profile%z_sense = -1
        end if
        if (is_error(status)) return
        from_middle = 0.5_wp*distance
        if (profile%kind == body_wheel) then
            from_middle = from_middle + datum
            profile%flange_back = -datum
        end if
        line = ''
        do i = header_lines + 1, size(lines)
            line = without_comment(lines(i)%text, '"!%')
            if (len(line) == 0) cycle
            call parse_words(line, 4, 4, path, i, values, n, status)
            if (is_error(status)) return
            if (options%side < 0) then
                call append_point(profile, -values(1) - from_middle, values(2), i)
            else
                call append_point(profile, values(3) - from_middle, values(4), i)
            end if
        end do
    end subroutine read_vampire

    !> The length a line of the header names, by a word or a number.
    subroutine take_length(path, lines, i, name, profile, length, status)
        character(len=*), intent(in) :: path, name
        type(line_t), intent(in) :: lines(:)
        integer, intent(in) :: i
        type(profile_file_t), intent(inout) :: profile
        real(wp), intent(out) :: length
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: line, word
        logical :: valid

        length = 0.0_wp
        line = lower_case(trim_blanks(lines(i)%text))
        valid = index(line // ' ', name // ' ') == 1
        word = ''
        if (valid) word = trim_blanks(line(len(name) + 1:))
        call add_key(profile, name, word)
        if (index(word, 'custom') == 1) word = trim_blanks(word(len('custom') + 1:))
        select case (name // ' ' // word)
        case ('treaddatum european'); length = european_datum
        case ('treaddatum us1'); length = us1_datum
        case ('treaddatum us2'); length = us2_datum
        case ('gaugepoint european'); length = european_gauge_point
        case ('gaugepoint us'); length = us_gauge_point
        case default
            if (valid) call parse_real(word, length, valid)
            valid = valid .and. length > 0.0_wp
        end select
        if (.not. valid) call set_place_status(status, st_file_format, 'line 3 and 4 must be ' // &
                                               'TREADDATUM and FLANGEBACK, or GAUGEPOINT and ' // &
                                               'GAUGE, with a length above 0', &
                                               lines(i)%text, path, i)
    end subroutine take_length
end module faststrip_files_profile_vampire
