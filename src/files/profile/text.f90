!> Profiles of two columns: plain text, CSV with names of columns, and the wheels of GENSYS.
!>
!> Numbers are separated by blanks, tabulators, a comma or a semicolon; `#`, `!` and `%` begin
!> comments, double quotes are passed over. One line of names may come before the points: with it
!> the columns of y and z are those whose names begin so, and `y_mm`, `y[m]`, `y_in` tell the unit.
!> GENSYS (gensys.se, users manual of KPF): y to the middle of the track, z down, the origin of a
!> wheel at its nominal rolling circle.
module faststrip_files_profile_text
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: lower_case, set_place_status
    use faststrip_geometry_touchable, only: body_wheel
    use faststrip_files_profile_points, only: profile_file_t, profile_options_t, line_t, &
                                              append_point, without_comment, split_words, &
                                              parse_words, has_decimal_commas, length_unit
    implicit none
    private

    public :: read_text_profile

    ! Columns of a line at most.
    integer, parameter :: most_columns = 16

contains

    !> Read the lines of a file, as they stand.
    subroutine read_text_profile(path, lines, is_gensys, options, profile, status)
        character(len=*), intent(in) :: path              !! name of the file
        type(line_t), intent(in) :: lines(:)              !! its lines
        logical, intent(in) :: is_gensys                  !! is it a wheel of GENSYS?
        type(profile_options_t), intent(in) :: options    !! what the user says
        type(profile_file_t), intent(inout) :: profile    !! the points
        type(status_t), intent(out) :: status             !! `st_file_format`

        character(len=:), allocatable :: line
        real(wp) :: values(most_columns)
        integer :: i, n, column_y, column_z, n_columns
        logical :: named

        call clear_status(status)
        profile%format = 'text'
        line = ''
        profile%has_unit = is_gensys
        if (is_gensys) then
            profile%format = 'gensys'
            profile%kind = body_wheel
            profile%y_sense = -1
        end if
        column_y = 1
        column_z = 2
        n_columns = 2
        named = .false.
        do i = 1, size(lines)
            line = without_comment(without_quotes(lines(i)%text), '#!%')
            if (len(line) == 0) cycle
            if (profile%n == 0 .and. .not. named) then
                named = is_name_line(line)
                if (named) then
                    call take_names(line, path, i, options, column_y, column_z, n_columns, &
                                    profile, status)
                    if (is_error(status)) return
                    cycle
                end if
            end if
            call parse_words(line, n_columns, n_columns, path, i, values, n, status)
            if (is_error(status)) then
                if (.not. (named .or. profile%n > 0 .or. n <= 2 .or. has_decimal_commas(line))) &
                    call set_place_status(status, st_file_format, 'a point must be two numbers, ' &
                                          // 'or a line above must name the columns, y and z ' // &
                                          'among them; other lines above begin with #', line, &
                                          path, i)
                return
            end if
            call append_point(profile, values(column_y), values(column_z), i)
        end do
    end subroutine read_text_profile

    !> Which columns are y and z, and in what unit.
    subroutine take_names(line, path, number, options, column_y, column_z, n_columns, profile, &
                          status)
        character(len=*), intent(in) :: line, path
        integer, intent(in) :: number
        type(profile_options_t), intent(in) :: options
        integer, intent(out) :: column_y, column_z, n_columns
        type(profile_file_t), intent(inout) :: profile
        type(status_t), intent(inout) :: status

        integer :: first(most_columns), last(most_columns), i
        real(wp) :: unit(2)
        character(len=:), allocatable :: word

        column_y = 0
        column_z = 0
        unit = 0.0_wp
        word = ''
        call split_words(line, first, last, n_columns)
        do i = 1, min(n_columns, most_columns)
            word = lower_case(line(first(i):last(i)))
            if (is_name_of(word, 'y') .and. column_y == 0) then
                column_y = i
                unit(1) = unit_of(word)
            else if (is_name_of(word, 'z') .and. column_z == 0) then
                column_z = i
                unit(2) = unit_of(word)
            end if
        end do
        if (n_columns > 2) profile%format = 'csv'
        if (n_columns == 2 .and. (column_y == 0 .or. column_z == 0)) then
            column_y = 1
            column_z = 2
            unit = 0.0_wp
        end if
        if (n_columns > most_columns .or. column_y == 0 .or. column_z == 0) then
            call set_place_status(status, st_file_format, 'names of columns must hold one of y ' &
                                  // 'and one of z; other lines above begin with #', line, &
                                  path, number)
        else if (abs(unit(1) - unit(2)) > 0.0_wp) then
            call set_place_status(status, st_file_format, 'y and z must have one unit', line, &
                                  path, number)
        else if (unit(1) > 0.0_wp) then
            profile%unit_mm = unit(1)
            profile%has_unit = .true.
            if (options%unit_mm > 0.0_wp .and. abs(options%unit_mm - unit(1)) > 0.0_wp) &
                call set_place_status(status, st_file_format, 'the unit asked for must be that ' &
                                      // 'of the names of the columns', line, path, number)
        end if
    end subroutine take_names

    !> Is a column's name that of a coordinate, with or without a unit?
    pure logical function is_name_of(word, coordinate)
        character(len=*), intent(in) :: word, coordinate

        is_name_of = word == coordinate
        if (len(word) > 1) is_name_of = word(1:1) == coordinate .and. scan(word(2:2), '_[(') == 1
    end function is_name_of

    pure real(wp) function unit_of(word)
        character(len=*), intent(in) :: word

        integer :: last

        last = len(word)
        if (scan(word(last:), '])') == 1) last = last - 1
        unit_of = length_unit(word(scan(word(:last), '_[(', back=.true.) + 1:last))
    end function unit_of

    !> Quotes around words are passed over.
    pure function without_quotes(text) result(bare)
        character(len=*), intent(in) :: text
        character(len=len(text)) :: bare

        integer :: i

        bare = text
        do i = 1, len(text)
            if (text(i:i) == '"') bare(i:i) = ' '
        end do
    end function without_quotes

    !> Two or more words that start with a letter, and none of them a special number.
    pure logical function is_name_line(line)
        character(len=*), intent(in) :: line

        integer :: first(most_columns), last(most_columns), n, i

        call split_words(line, first, last, n)
        is_name_line = n >= 2 .and. n <= most_columns
        do i = 1, min(n, most_columns)
            select case (lower_case(line(first(i):min(first(i), last(i)))))
            case ('a':'z')
                select case (lower_case(line(first(i):last(i))))
                case ('nan', 'inf', 'infinity')
                    is_name_line = .false.
                end select
            case default
                is_name_line = .false.
            end select
        end do
    end function is_name_line
end module faststrip_files_profile_text
