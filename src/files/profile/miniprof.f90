!> MiniProf profiles, `.whl` of wheels, `.ban` of rails, `.mpt` with several sections.
!>
!> Three generations of header: `MINIPROF` in the first line and free lines up to an empty one;
!> `KEY=value` with `ColumnDef`; the same with more keys and no empty line before the points. Some
!> programs put lines into double quotes; an open one before a point makes it a comment, and behind
!> a point `"`, `!` and `%` begin one.
!>
!> Senses of the format: of a wheel X runs from the back of the flange to the field side and Y
!> towards the tip of the flange; of a rail X runs to the gauge side and Y up; mm. Layout: files of
!> three generations, and the public readers of CONTACT (github.com/eve70a/CONTACT).
module faststrip_files_profile_miniprof
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, parse_integer, integer_text, &
                                   lower_case, set_place_status
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t, line_t, &
                                              append_point, add_key, add_note, split_key, &
                                              parse_words, is_number_line, without_comment, &
                                              split_words, largest_coordinate
    implicit none
    private

    public :: read_miniprof, is_miniprof_key

    !> Flange back to nominal rolling circle, mm.
    real(wp), parameter :: standard_tape_circle = 70.0_wp
    ! Where a header may say that it is, and what counts as the same, mm.
    real(wp), parameter :: least_taper_line = 40.0_wp, most_taper_line = 120.0_wp, &
                           same_taper_line = 0.01_wp

    ! Columns of a line of points at most.
    integer, parameter :: most_columns = 8

    ! What the header says about the points.
    type :: header_t
        integer :: column_x = 1
        integer :: column_y = 2
        integer :: n_columns = 0                  ! 0: two or more
        integer :: n_points = -1                  ! -1: not said
        integer :: line_of_count = 0
        real(wp) :: offset_x = 0.0_wp
        real(wp) :: offset_y = 0.0_wp
    end type header_t

contains

    !> Is it a key by which a header of MiniProf is known?
    pure logical function is_miniprof_key(key)
        character(len=*), intent(in) :: key !! as it stands

        select case (lower_case(key))
        case ('columndef', 'xypoints', 'mptypeno', 'mpserno', 'xoffset', 'refpoint1')
            is_miniprof_key = .true.
        case default
            is_miniprof_key = .false.
        end select
    end function is_miniprof_key

    !> Read the lines of a file, as they stand; senses and nominal rolling circle are those of the
    !> format.
    subroutine read_miniprof(path, lines, options, profile, status)
        character(len=*), intent(in) :: path              !! name of the file
        type(line_t), intent(in) :: lines(:)              !! its lines
        type(profile_options_t), intent(in) :: options    !! what the user says
        type(profile_file_t), intent(inout) :: profile    !! kind is set from outside, or here
        type(status_t), intent(out) :: status             !! `st_file_format`

        integer :: first, last

        call clear_status(status)
        profile%format = 'miniprof'
        first = 1
        last = size(lines)
        if (has_sections(lines)) then
            profile%format = 'miniprof mpt'
            if (profile%kind == 0) profile%kind = body_rail
            call find_section(path, lines, options, profile, first, last, status)
            if (is_error(status)) return
        end if
        call read_block(path, lines, first, last, options, profile, status)
        if (is_error(status)) return
        call take_senses(options, profile)
    end subroutine read_miniprof

    pure logical function has_sections(lines)
        type(line_t), intent(in) :: lines(:)

        integer :: i

        has_sections = .false.
        do i = 1, min(size(lines), 3)
            if (index(lower_case(trim_blanks(lines(i)%text)), '[fileinfo]') == 1) &
                has_sections = .true.
        end do
    end function has_sections

    !> The lines of the section that is wanted.
    subroutine find_section(path, lines, options, profile, first, last, status)
        character(len=*), intent(in) :: path
        type(line_t), intent(in) :: lines(:)
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        integer, intent(out) :: first, last
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: line
        integer :: i, n

        first = 1
        last = 0
        n = 0
        line = ''
        do i = 1, size(lines)
            line = lower_case(trim_blanks(lines(i)%text))
            if (index(line, '[profile') /= 1 .or. index(line, 'info]') == 0) cycle
            n = n + 1
            if (n == max(options%section, 1)) then
                first = i
                last = size(lines)
            else if (n == max(options%section, 1) + 1) then
                last = i - 1
            end if
        end do
        profile%n_sections = n
        profile%section = max(options%section, 1)
        if (n == 0) then
            call set_place_status(status, st_file_format, 'no section [Profile1Info]', '', path, 0)
        else if (n > 1 .and. options%section == 0 .or. options%section > n) then
            call set_place_status(status, st_file_format, 'a file of ' // integer_text(n) // &
                                  ' sections: --section must be 1 to ' // integer_text(n), &
                                  integer_text(options%section), path, 0)
        end if
    end subroutine find_section

    !> Header and points.
    subroutine read_block(path, lines, first, last, options, profile, status)
        character(len=*), intent(in) :: path
        type(line_t), intent(in) :: lines(:)
        integer, intent(in) :: first, last
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(inout) :: status

        type(header_t) :: header
        character(len=:), allocatable :: line, key, value
        integer :: i, n_comments
        logical :: is_key, is_free, in_points, is_comment

        is_free = is_old_header(lines)
        in_points = .false.
        n_comments = 0
        line = ''
        do i = first, last
            call take_quotes(lines(i)%text, line, is_comment)
            if (is_comment .and. .not. is_free) n_comments = n_comments + 1
            if (is_comment) cycle
            if (len(line) == 0) then
                if (is_free) in_points = .true.
                cycle
            end if
            if (is_free .and. .not. in_points) then
                if (i == 1) call take_kind(lower_case(line), profile)
                call add_key(profile, 'line ' // integer_text(i), line)
                cycle
            end if
            if (is_number_line(line)) then
                in_points = .true.
                call take_point(line, path, i, header, profile, status)
            else if (line(1:1) == '[') then
                cycle
            else
                call split_key(line, key, value, is_key)
                if (.not. is_key) then
                    call set_place_status(status, st_file_format, &
                                          'a line must be KEY=value or a point', line, path, i)
                else if (in_points) then
                    call set_place_status(status, st_file_format, &
                                          'keys must stand above the points', line, path, i)
                else
                    call take_key(key, value, path, i, options, profile, header, status)
                end if
            end if
            if (is_error(status)) return
        end do
        call check_count(path, header, n_comments, options, profile, status)
        profile%y(:profile%n) = profile%y(:profile%n) + header%offset_x
        profile%z(:profile%n) = profile%z(:profile%n) + header%offset_y
        if (abs(header%offset_x) + abs(header%offset_y) > 0.0_wp) &
            call add_note(profile, 'XOffset and YOffset of the header added')
        if (n_comments > 0) call add_note(profile, integer_text(n_comments) // &
                                          ' points in open quotes passed over')
    end subroutine read_block

    pure logical function is_old_header(lines)
        type(line_t), intent(in) :: lines(:)

        character(len=:), allocatable :: line

        is_old_header = .false.
        if (size(lines) == 0) return
        line = lower_case(trim_blanks(lines(1)%text))
        is_old_header = index(line, '=') == 0 .and. &
            (index(line, 'miniprof') > 0 .or. index(line, '#mini') == 1)
    end function is_old_header

    pure subroutine take_kind(line, profile)
        character(len=*), intent(in) :: line
        type(profile_file_t), intent(inout) :: profile

        if (profile%kind > 0) return
        if (index(line, 'wheel') > 0) profile%kind = body_wheel
        if (index(line, 'rail') > 0) profile%kind = body_rail
    end subroutine take_kind

    !> A line without the quotes around it; one with an open quote is a comment.
    pure subroutine take_quotes(text, line, is_comment)
        character(len=*), intent(in) :: text
        character(len=:), allocatable, intent(out) :: line
        logical, intent(out) :: is_comment

        integer :: n

        is_comment = .false.
        line = trim_blanks(text)
        n = len(line)
        if (n == 0) return
        if (line(1:1) /= '"') return
        is_comment = .true.
        if (n > 1) is_comment = line(n:n) /= '"'
        if (.not. is_comment) line = trim_blanks(line(2:n - 1))
    end subroutine take_quotes

    subroutine take_key(key, text, path, number, options, profile, header, status)
        character(len=*), intent(in) :: key, text, path
        integer, intent(in) :: number
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(header_t), intent(inout) :: header
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: range, columns
        real(wp) :: taper_line
        logical :: valid

        call add_key(profile, key, text)
        valid = .true.
        select case (lower_case(key))
        case ('columndef')
            range = 'column letters with commas between them, X and Y among them'
            call remove_blanks(text, columns)
            call take_columns(columns, header, valid)
        case ('xypoints')
            range = 'a whole number from 0 on'
            if (len(text) == 0) return
            call parse_integer(text, header%n_points, valid)
            valid = valid .and. header%n_points >= 0
            header%line_of_count = number
        case ('xoffset', 'yoffset')
            range = 'a finite number within 1e9'
            if (len(text) == 0) return
            if (lower_case(key) == 'xoffset') then
                call parse_real(text, header%offset_x, valid)
            else
                call parse_real(text, header%offset_y, valid)
            end if
            valid = valid .and. max(abs(header%offset_x), abs(header%offset_y)) &
                    <= largest_coordinate
        case ('wheeldiametertaperline')
            ! Where the nominal rolling circle is; what cannot be a place on a wheel means something
            ! else.
            call parse_real(text, taper_line, valid)
            valid = .not. valid .or. options%has_tape_circle .or. taper_line < least_taper_line &
                .or. taper_line > most_taper_line &
                .or. abs(taper_line - standard_tape_circle) < same_taper_line
            range = '70, or --tape-circle must say where the nominal rolling circle is'
        case default
            return
        end select
        if (.not. valid) call set_place_status(status, st_file_format, key // ' must be ' // &
                                               range, "'" // text // "'", path, number)
    end subroutine take_key

    pure subroutine remove_blanks(text, packed)
        character(len=*), intent(in) :: text
        character(len=:), allocatable, intent(out) :: packed

        integer :: i

        packed = ''
        do i = 1, len(text)
            if (text(i:i) /= ' ' .and. text(i:i) /= achar(9)) packed = packed // text(i:i)
        end do
    end subroutine remove_blanks

    !> The columns of X and Y.
    pure subroutine take_columns(text, header, valid)
        character(len=*), intent(in) :: text
        type(header_t), intent(inout) :: header
        logical, intent(out) :: valid

        character(len=1) :: letter
        integer :: i, n

        header%column_x = 0
        header%column_y = 0
        n = 0
        valid = .false.
        do i = 1, len(text)
            letter = text(i:i)
            if (mod(i, 2) == 0) then
                if (letter /= ',') return
                cycle
            end if
            n = n + 1
            if (n > most_columns .or. letter == ',' .or. letter == ' ') return
            if (letter == 'X' .or. letter == 'x') header%column_x = n
            if (letter == 'Y' .or. letter == 'y') header%column_y = n
            if (letter == '*') n = 0
            if (letter == '*') exit
        end do
        header%n_columns = n
        valid = header%column_x > 0 .and. header%column_y > 0
    end subroutine take_columns

    subroutine take_point(line, path, number, header, profile, status)
        character(len=*), intent(in) :: line, path
        integer, intent(in) :: number
        type(header_t), intent(in) :: header
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(inout) :: status

        real(wp) :: values(most_columns)
        character(len=:), allocatable :: content
        integer :: n, least, most

        least = 2
        most = most_columns
        if (header%n_columns > 0) then
            least = header%n_columns
            most = header%n_columns
        end if
        content = without_comment(line, '"!%')
        call parse_words(content(:end_of_numbers(content, header%n_columns)), least, most, path, &
                         number, values, n, status)
        if (is_error(status)) return
        call append_point(profile, values(header%column_x), values(header%column_y), number)
    end subroutine take_point

    !> Where a line of points ends without words behind its columns that begin with a letter.
    pure integer function end_of_numbers(line, n_columns) result(length)
        character(len=*), intent(in) :: line
        integer, intent(in) :: n_columns ! 0: not said

        integer :: first(most_columns + 1), last(most_columns + 1), n

        length = len(line)
        if (n_columns == 0) return
        call split_words(line, first, last, n)
        if (n <= n_columns) return
        select case (lower_case(line(first(n_columns + 1):first(n_columns + 1))))
        case ('a':'z'); length = last(n_columns)
        end select
    end function end_of_numbers

    !> Are there as many points as the header says?
    subroutine check_count(path, header, n_comments, options, profile, status)
        character(len=*), intent(in) :: path
        type(header_t), intent(in) :: header
        integer, intent(in) :: n_comments
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(inout) :: status

        if (header%n_points < 0 .or. profile%n == header%n_points .or. &
            profile%n + n_comments == header%n_points) return
        if (options%any_count) then
            call add_note(profile, 'XYPoints says ' // integer_text(header%n_points) // &
                          ' points, the file has ' // integer_text(profile%n))
        else
            call set_place_status(status, st_file_format, 'XYPoints must be the number of ' // &
                                  'points, ' // integer_text(profile%n) // ' (--any-count, or ' &
                                  // 'any_count in a case file, takes them)', &
                                  integer_text(header%n_points), path, header%line_of_count)
        end if
    end subroutine check_count

    !> The senses of the format.
    pure subroutine take_senses(options, profile)
        type(profile_options_t), intent(in) :: options
        type(profile_file_t), intent(inout) :: profile

        integer :: kind

        kind = profile%kind
        if (options%kind > 0) kind = options%kind
        if (kind == body_rail) then
            profile%y_sense = -1
            profile%z_sense = -1
        else if (kind == body_wheel) then
            profile%tape_circle = standard_tape_circle
        end if
    end subroutine take_senses
end module faststrip_files_profile_miniprof
