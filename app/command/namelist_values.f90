!> What is wrong with the values of a namelist group, in words of the group: the Fortran runtime
!> only says that it lost its way.
module faststrip_command_namelist_values
    use faststrip_base_text, only: trim_blanks, lower_case, parse_real, parse_integer
    use faststrip_command_namelist, only: namelist_file_t, group_t, refuse_line, word_letters
    implicit none
    private

    public :: refuse_values, name_length

    !> Length of the names in a list of names.
    integer, parameter :: name_length = 16
    ! All other names take numbers.
    character(len=name_length), parameter :: text_names(12) = [character(len=name_length) :: &
        'name', 'gap_file', 'load_direction', 'profile', 'y_positive_to', 'z_positive_to', &
        'creepage', 'sign_set', 'normal', 'tangential', 'norm_start', 'target']
    character(len=name_length), parameter :: whole_names(5) = [character(len=name_length) :: &
        'strips_per_patch', 'points_per_strip', 'fastsim_nx', 'fastsim_ny', 'max_elements']

contains

    !> End the program with an error about line n of a group, which the runtime could not read.
    subroutine refuse_values(content, group, n, names, words)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        integer, intent(in) :: n                     !! number of the line within the group
        character(len=*), intent(in) :: names(:)     !! that the group knows
        character(len=*), intent(in) :: words        !! of the runtime

        character(len=:), allocatable :: line, name, value
        integer :: i, from, name_at, to

        name = ''
        do i = group%first, group%first + n - 1
            line = content%line(i)
            from = 1
            if (i == group%first) from = index(line, '&') + len(group%name) + 1
            do
                call find_name(line, from, name_at, to)
                value = without_end(line(from:name_at - 1))
                if (i == group%first + n - 1 .and. len(name) > 0) &
                    call check_value(content, group, i, name, value, names, from == 1)
                if (to > len(line)) exit
                name = trim_blanks(line(name_at:to - 1))
                from = to + 1
                if (place(names, name) == 0) call refuse_line(content, i, '&' // group%name &
                    // ' unknown name', lower_case(name))
            end do
        end do
        call refuse_line(content, group%first + n - 1, '&' // group%name // ' ' // trim(words), &
                         adjustl(content%line(group%first + n - 1)))
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
end module faststrip_command_namelist_values
