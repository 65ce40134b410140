!> The values of a namelist group, line by line for the Fortran runtime, and what is wrong with them
!> in words of the group: the runtime only says that it lost its way.
module faststrip_command_settings_namelist_values
    use faststrip_base_status, only: message_length
    use faststrip_base_text, only: trim_blanks, lower_case, parse_real, parse_integer
    use faststrip_command_settings_namelist, only: namelist_file_t, group_t, group_text, &
                                                   line_length, refuse_line, word_letters
    implicit none
    private

    public :: reading_t, next_lines, refuse_values, name_length

    !> Length of the names in a list of names.
    integer, parameter :: name_length = 26
    ! All other names take numbers.
    character(len=name_length), parameter :: text_names(12) = [character(len=name_length) :: &
        'name', 'gap_file', 'load_direction', 'profile', 'y_positive_to', 'z_positive_to', &
        'creepage', 'sign_set', 'normal', 'tangential', 'norm_start', 'target']
    character(len=name_length), parameter :: whole_names(5) = [character(len=name_length) :: &
        'strips_per_patch', 'points_per_strip', 'fastsim_nx', 'fastsim_ny', 'max_elements']

    !> How far a group was read.
    type :: reading_t
        character(len=line_length), allocatable :: text(:) !! to be read; not there: all was read
        integer :: n = 0                                   !! lines of the group in it
        character(len=message_length) :: words = ''        !! of the runtime that could not
    end type reading_t

contains

    !> The lines of a group that are to be read next: all up to one more than the last time, so that
    !> the line is known which the runtime cannot read.
    subroutine next_lines(content, group, reading)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it, or none
        type(reading_t), intent(inout) :: reading    !! as it was left the last time

        if (allocated(reading%text)) deallocate (reading%text)
        if (group%first == 0 .or. reading%n > group%last - group%first) return
        reading%n = reading%n + 1
        reading%text = group_text(content, group, reading%n)
    end subroutine next_lines

    !> End the program with an error about the last line, which the runtime could not read.
    subroutine refuse_values(content, group, names, reading)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: names(:)     !! that the group knows
        type(reading_t), intent(in) :: reading       !! with the runtime's words

        character(len=:), allocatable :: line, name, value
        integer :: i, from, name_at, to, last

        last = group%first + reading%n - 1
        name = ''
        do i = group%first, last
            line = content%line(i)
            from = 1
            if (i == group%first) from = index(line, '&') + len(group%name) + 1
            do
                call find_name(line, from, name_at, to)
                value = without_end(line(from:name_at - 1))
                if (i == last .and. len(name) > 0) &
                    call check_value(content, group, i, name, value, names, from == 1)
                if (to > len(line)) exit
                name = trim_blanks(line(name_at:to - 1))
                from = to + 1
                if (place(names, name) == 0) call refuse_line(content, i, '&' // group%name &
                    // ' unknown name: ' // lower_case(name), '')
            end do
        end do
        call refuse_line(content, last, '&' // group%name // ' ' // trim(reading%words) &
                         // ': ' // trim_blanks(content%line(last)), '')
    end subroutine refuse_values

    !> The next `name =` of a line: where the name starts, and where the equals sign is; both
    !> beyond the line if there is none.
    pure subroutine find_name(line, from, name_at, equals)
        character(len=*), intent(in) :: line
        integer, intent(in) :: from
        integer, intent(out) :: name_at, equals

        character :: quote

        quote = ' '
        do equals = from, len(line)
            if (quote /= ' ') then
                if (line(equals:equals) == quote) quote = ' '
            else if (line(equals:equals) == '''' .or. line(equals:equals) == '"') then
                quote = line(equals:equals)
            else if (line(equals:equals) == '=') then
                name_at = verify(line(:equals - 1), ' ' // achar(9), back=.true.)
                do while (name_at >= from)
                    if (scan(line(name_at:name_at), word_letters // '()') == 0) exit
                    name_at = name_at - 1
                end do
                name_at = max(name_at + 1, from)
                return
            end if
        end do
        name_at = len(line) + 1
        equals = len(line) + 1
    end subroutine find_name

    !> A value without what separates it from the next one, or the slash that closes the group.
    pure function without_end(text) result(value)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: value

        integer :: last

        value = trim_blanks(text)
        do
            last = len(value)
            if (last == 0) return
            if (value(last:) /= ',' .and. value(last:) /= '/') return
            value = trim_blanks(value(:last - 1))
        end do
    end function without_end

    subroutine check_value(content, group, number, name, value, names, continues)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        integer, intent(in) :: number
        character(len=*), intent(in) :: name, value, names(:)
        logical, intent(in) :: continues ! is the value the rest of a list from the line before?

        character(len=:), allocatable :: what

        if (len(value) == 0) return
        if (any(text_names == lower_case(name))) then
            if (is_quoted(value)) return
            what = 'text in quotes'
        else if (any(whole_names == lower_case(name))) then
            if (is_list(value, .true.) .and. .not. continues) return
            what = 'a whole number'
        else if (group%name == 'sweep') then
            if (is_list(value, .false.)) return
            what = 'a list of numbers'
        else
            if (is_number(value, .false.) .and. .not. continues) return
            what = 'a number'
        end if
        call refuse_line(content, number, '&' // group%name // ' ' &
                         // trim(names(place(names, name))) // ' must be ' // what &
                         // ', got ' // value, '')
    end subroutine check_value

    !> Number of a name in a list, in upper or lower case; 0 if it is not there.
    pure integer function place(names, name)
        character(len=*), intent(in) :: names(:), name

        do place = size(names), 1, -1
            if (lower_case(names(place)) == lower_case(name)) return
        end do
    end function place

    !> Is a value one text between quotes, which stand doubled inside?
    pure logical function is_quoted(value)
        character(len=*), intent(in) :: value

        character :: quote
        integer :: i

        is_quoted = .false.
        quote = value(1:1)
        if (len(value) < 2 .or. quote /= '''' .and. quote /= '"') return
        i = 2
        do while (i <= len(value))
            if (value(i:i) == quote) then
                is_quoted = i == len(value)
                if (is_quoted) return
                if (value(i + 1:i + 1) /= quote) return
                i = i + 1
            end if
            i = i + 1
        end do
    end function is_quoted

    !> Are the parts of a value, between blanks and commas, all numbers?
    pure logical function is_list(value, whole)
        character(len=*), intent(in) :: value
        logical, intent(in) :: whole

        integer :: from, length

        is_list = .true.
        from = 1
        do while (from <= len(value))
            length = scan(value(from:), ' ,' // achar(9)) - 1
            if (length < 0) length = len(value) - from + 1
            if (length > 0) is_list = is_list .and. is_number(value(from:from + length - 1), whole)
            from = from + length + 1
        end do
    end function is_list

    pure logical function is_number(text, whole)
        character(len=*), intent(in) :: text
        logical, intent(in) :: whole

        real(kind(1.0d0)) :: value
        integer :: number

        if (whole) then
            call parse_integer(text, number, is_number)
        else
            call parse_real(text, value, is_number)
            if (.not. is_number) is_number = any(lower_case(text(verify(text // ' ', '+-'):)) &
                                                 == [character(len=8) :: 'nan', 'inf', 'infinity'])
        end if
    end function is_number
end module faststrip_command_settings_namelist_values
