!> Case files: text with line numbers, cut into namelist groups.
!>
!> The Fortran runtime reads the groups; what it does not tell, which line is wrong, is found by
!> reading a group line by line.
module faststrip_command_settings_namelist
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: trim_blanks, lower_case, integer_text
    use faststrip_files_lines, only: text_file_t, open_text, read_line, close_text
    use faststrip_command_program_console, only: fail, fail_on_error, exit_bad_input
    implicit none
    private

    public :: namelist_file_t, group_t, read_namelist_file, find_group, group_text, line_length
    public :: sets, place_setting, refuse, refuse_line, word_letters

    !> Longest line of a case file, characters.
    integer, parameter :: line_length = 1024
    !> Most lines of a case file: the longest lists take a few hundred.
    integer, parameter :: most_case_lines = 10000
    !> What names are made of.
    character(len=*), parameter :: word_letters = &
        'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'

    !> A case file as it was read.
    type :: namelist_file_t
        character(len=:), allocatable :: file            !! its name
        character(len=line_length), allocatable :: line(:) !! its lines, comments blanked
    end type namelist_file_t

    !> Where a group stands in its file.
    type :: group_t
        character(len=:), allocatable :: name !! without the ampersand
        integer :: first = 0                  !! line with the ampersand; 0: not there
        integer :: last = 0                   !! line with the closing slash
    end type group_t

contains

    !> Read a case file; ends the program if it is missing, has an unknown group, a group twice or
    !> one that is not closed.
    subroutine read_namelist_file(path, known, content)
        character(len=*), intent(in) :: path              !! name of the file
        character(len=*), intent(in) :: known(:)          !! names of all groups, lower case
        type(namelist_file_t), intent(out) :: content     !! the lines

        type(text_file_t) :: file
        type(status_t) :: status
        character(len=:), allocatable :: text
        character(len=line_length), allocatable :: more(:)
        integer :: n
        logical :: found

        content%file = path
        call open_text(path, file, status)
        call fail_on_error(status)
        allocate (content%line(64))
        n = 0
        do
            call read_line(file, text, found, status)
            call fail_on_error(status)
            if (.not. found) exit
            if (n == size(content%line)) then
                allocate (more(2*n))
                more(:n) = content%line
                call move_alloc(more, content%line)
            end if
            n = n + 1
            if (n > most_case_lines) call refuse_line(content, n, 'a case file must have at most ' &
                // integer_text(most_case_lines) // ' lines', '')
            if (len(text) > line_length) call refuse_line(content, n, 'a line must have at most ' &
                // integer_text(line_length) // ' characters', '')
            content%line(n) = without_comment(text)
        end do
        call close_text(file)
        content%line = content%line(:n)
        call check_groups(content, known)
    end subroutine read_namelist_file

    subroutine check_groups(content, known)
        type(namelist_file_t), intent(in) :: content
        character(len=*), intent(in) :: known(:)

        character(len=:), allocatable :: text, name
        integer :: i, j, open_at, slash, seen(size(known))

        name = ''
        open_at = 0
        seen = 0
        do i = 1, size(content%line)
            text = trim_blanks(content%line(i))
            if (len(text) == 0) cycle
            if (text(1:1) == '&') then
                if (open_at > 0) call refuse_line(content, open_at, 'a group must be closed by /', &
                                                  trim_blanks(content%line(open_at)))
                name = lower_case(first_word(text(2:)))
                do j = 1, size(known)
                    if (known(j) == name) exit
                end do
                if (j > size(known)) call refuse_line(content, i, 'unknown group: &' // name, '')
                if (seen(j) > 0) call refuse_line(content, i, &
                    'a group must stand once', '&' // name)
                seen(j) = i
                open_at = i
            else if (open_at == 0) then
                call refuse_line(content, i, 'text must stand in a group', text)
            end if
            if (first_outside_quotes(text, ';') > 0) &
                call refuse_line(content, i, 'must not hold a semicolon', text)
            slash = slash_at(text)
            if (slash > 0 .and. slash < len(text)) &
                call refuse_line(content, i, 'a line must end at its slash', text)
            if (slash > 0) open_at = 0
        end do
        if (open_at > 0) call refuse_line(content, open_at, 'a group must be closed by /', &
                                          trim_blanks(content%line(open_at)))
    end subroutine check_groups

    !> Find a group; ends the program if it is required and missing.
    subroutine find_group(content, name, required, group)
        type(namelist_file_t), intent(in) :: content !! a case file
        character(len=*), intent(in) :: name         !! lower case, without ampersand
        logical, intent(in) :: required              !! is its absence an error?
        type(group_t), intent(out) :: group          !! first = 0 if it is not there

        character(len=:), allocatable :: text
        integer :: i

        group%name = name
        do i = 1, size(content%line)
            text = trim_blanks(content%line(i))
            if (len(text) == 0) cycle
            if (group%first == 0 .and. text(1:1) == '&') then
                if (lower_case(first_word(text(2:))) == name) group%first = i
            end if
            if (group%first == 0) cycle
            if (slash_at(text) > 0) then
                group%last = i
                return
            end if
        end do
        if (required) call fail(exit_bad_input, 'missing group: &' // name // ' (' &
                                // content%file // ')')
    end subroutine find_group

    !> The first `n` lines of a group, closed, for an internal namelist read.
    function group_text(content, group, n) result(text)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group that is there
        integer, intent(in) :: n                     !! 1 to last - first + 1
        character(len=line_length) :: text(n + 1)

        text(:n) = content%line(group%first:group%first + n - 1)
        text(n + 1) = '/'
    end function group_text

    !> Does a group set a name?
    logical function sets(content, group, name)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group

        sets = line_setting(content, group, name) > 0
    end function sets

    !> The last line of a group that sets a name; 0 if there is none.
    integer function line_setting(content, group, name) result(at)
        type(namelist_file_t), intent(in) :: content
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: name

        integer :: i
        character(len=line_length) :: line

        at = 0
        if (group%first == 0) return
        do i = group%first, group%last
            line = lower_case(content%line(i))
            if (sets_name(line, lower_case(name))) at = i
        end do
    end function line_setting

    !> Where a group sets a name, as `FILE:LINE`; empty if it does not.
    function place_setting(content, group, name) result(place)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        character(len=:), allocatable :: place

        integer :: line

        line = line_setting(content, group, name)
        place = ''
        if (line > 0) place = content%file // ':' // integer_text(line)
    end function place_setting

    !> End the program with an error about a name of a group; the line is the one that sets it.
    subroutine refuse(content, group, name, what, value)
        type(namelist_file_t), intent(in) :: content !! a case file
        type(group_t), intent(in) :: group           !! a group of it
        character(len=*), intent(in) :: name         !! name in the group
        character(len=*), intent(in) :: what         !! what is wrong
        character(len=*), intent(in) :: value        !! the offending value

        character(len=:), allocatable :: text

        text = '&' // group%name // ' ' // name // ' ' // what
        if (len_trim(value) > 0) text = text // ', got ' // trim(value)
        call refuse_line(content, max(line_setting(content, group, name), group%first, 1), text, '')
    end subroutine refuse

    !> End the program with an error about a line.
    subroutine refuse_line(content, number, what, value)
        type(namelist_file_t), intent(in) :: content !! a case file
        integer, intent(in) :: number                !! line number
        character(len=*), intent(in) :: what         !! what is wrong
        character(len=*), intent(in) :: value        !! the offending value; may be empty

        character(len=:), allocatable :: text

        text = what
        if (len_trim(value) > 0) text = text // ', got ' // trim(value)
        call fail(exit_bad_input, text // ' (' // content%file // ':' &
                  // integer_text(number) // ')')
    end subroutine refuse_line

    !> Does a line hold `name =`?
    pure logical function sets_name(line, name)
        character(len=*), intent(in) :: line, name

        integer :: from, at

        sets_name = .false.
        from = 1
        do
            at = index(line(from:), name)
            if (at == 0) return
            at = from + at - 1
            from = at + len(name)
            if (at > 1) then
                if (index(word_letters, line(at - 1:at - 1)) > 0) cycle
            end if
            sets_name = index(adjustl(line(from:)), '=') == 1
            if (sets_name) return
        end do
    end function sets_name

    !> The line up to an exclamation mark outside quotes.
    pure function without_comment(text) result(kept)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: kept

        integer :: mark

        mark = first_outside_quotes(text, '!')
        if (mark == 0) mark = len(text) + 1
        kept = text(:mark - 1)
    end function without_comment

    !> Place of the first such character that stands outside quotes; 0 if there is none.
    pure integer function first_outside_quotes(text, mark) result(at)
        character(len=*), intent(in) :: text
        character, intent(in) :: mark

        character :: quote

        quote = ' '
        do at = 1, len(text)
            if (quote /= ' ') then
                if (text(at:at) == quote) quote = ' '
            else if (text(at:at) == '''' .or. text(at:at) == '"') then
                quote = text(at:at)
            else if (text(at:at) == mark) then
                return
            end if
        end do
        at = 0
    end function first_outside_quotes

    !> Place of the first slash outside quotes, which closes a group; 0 if there is none.
    pure integer function slash_at(text)
        character(len=*), intent(in) :: text

        slash_at = first_outside_quotes(text, '/')
    end function slash_at

    pure function first_word(text) result(word)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: word

        integer :: n

        n = scan(text // ' ', ' /' // achar(9)) - 1
        word = text(:n)
    end function first_word
end module faststrip_command_settings_namelist
