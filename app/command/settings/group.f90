!> Case files: groups of names and values, read by the table of settings.
!>
!> The form is that of a Fortran namelist: `&group`, names and values, a slash; comments from an
!> exclamation mark on; text in either quotes, which stand doubled inside; lists over several lines,
!> with repeat counts. It is read here, not by the Fortran runtime, which does not tell what is
!> wrong, nor where.
module faststrip_command_settings_group
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: likely_mistake
    use faststrip_base_status, only: status_t, number_text
    use faststrip_base_text, only: trim_blanks, lower_case, integer_text
    use faststrip_files_csv, only: csv_text_t
    use faststrip_files_lines, only: text_file_t, open_text, read_line, close_text, longest_line
    use faststrip_command_program_console, only: fail, fail_on_error, exit_bad_input
    use faststrip_command_program_files, only: take_input
    use faststrip_command_settings_doubts, only: hold_value
    use faststrip_command_settings_table, only: settings, value_t, of_group, find_setting, &
                                                read_value, kind_words, range_words, a_text, &
                                                a_path, a_word, a_number, a_list, wrong_kind, &
                                                no_fault
    implicit none
    private

    public :: case_text_t, group_t, read_case_text, need_groups, stands_in, read_group, is_set
    public :: given_value, number_of, text_of, list_of, beside, take_file, refuse, refuse_each

    ! Tuned [lines]: most of a case file. Origin: capacity: the longest lists take a few hundred.
    integer, parameter :: most_case_lines = 10000
    ! Tuned [letters]: that names have in common to be told. Origin: chosen: as mu has.
    integer, parameter :: enough_alike = 2
    ! What names are made of.
    character(len=*), parameter :: word_letters = &
        'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'

    character(len=*), parameter :: groups(*) = [character(len=8) :: &
        'contact', 'material', 'wheel', 'rail', 'motion', 'friction', 'thermal', &
        'numerics', 'sweep', 'state']

    !> A case file as it was read.
    type :: case_text_t
        character(len=:), allocatable :: file      !! its name
        type(csv_text_t), allocatable :: line(:)   !! its lines without comments
    end type case_text_t

    !> The values of a group.
    type :: group_t
        character(len=:), allocatable :: file     !! its name
        character(len=:), allocatable :: name     !! without the ampersand
        integer :: first = 0                      !! line with the ampersand; 0: not there
        integer :: last = 0                       !! line with the closing slash
        integer, allocatable :: row(:)            !! of the table of settings
        type(value_t), allocatable :: value(:)    !! one a row
    end type group_t

contains

    !> Read a case file; ends the program if it is missing, has an unknown group, a group twice or
    !> one that is not closed, or unknown names, all of which are told.
    subroutine read_case_text(path, has_state, content)
        character(len=*), intent(in) :: path       !! name of the file
        logical, intent(in) :: has_state           !! may it have the group `state`?
        type(case_text_t), intent(out) :: content  !! the lines

        type(text_file_t) :: file
        type(status_t) :: status
        character(len=:), allocatable :: text
        integer :: n
        logical :: found

        call take_input(path)
        content%file = path
        call open_text(path, file, status)
        call fail_on_error(status)
        allocate (content%line(most_case_lines))
        n = 0
        do
            call read_line(file, text, found, status)
            call fail_on_error(status)
            if (.not. found) exit
            n = n + 1
            if (n > most_case_lines) call refuse_line(path, n, 'a case file must have at most ' &
                // integer_text(most_case_lines) // ' lines', '')
            content%line(n)%text = without_comment(text)
        end do
        call close_text(file)
        content%line = content%line(:n)
        call check_groups(content, groups(:size(groups) - merge(0, 1, has_state)))
        call check_names(content)
    end subroutine read_case_text

    !> End the program if groups are missing, and name all of them.
    subroutine need_groups(content, names)
        type(case_text_t), intent(in) :: content !! a case file
        character(len=*), intent(in) :: names(:) !! lower case, without ampersand

        type(group_t) :: group
        character(len=:), allocatable :: missing
        integer :: i, n

        missing = ''
        n = 0
        do i = 1, size(names)
            call start_group(content, trim(names(i)), group)
            if (group%first > 0) cycle
            n = n + 1
            missing = missing // ', &' // trim(names(i))
        end do
        if (n > 0) call fail(exit_bad_input, trim(merge('missing groups:', 'missing group: ', &
                                                        n > 1)) // missing(2:) // ' (' // &
                             content%file // ')')
    end subroutine need_groups

    !> Does a name stand in a group, whatever its value?
    logical function stands_in(content, name, key) result(stands)
        type(case_text_t), intent(in) :: content !! a case file
        character(len=*), intent(in) :: name     !! of the group, lower case, without ampersand
        character(len=*), intent(in) :: key      !! lower case

        type(group_t) :: group
        integer :: i

        call start_group(content, name, group)
        stands = .false.
        do i = max(group%first, 1), group%last
            stands = stands .or. index(lower_case(content%line(i)%text), key) > 0
        end do
    end function stands_in

    ! A group without its values.
    subroutine start_group(content, name, group)
        type(case_text_t), intent(in) :: content
        character(len=*), intent(in) :: name
        type(group_t), intent(out) :: group

        group%file = content%file
        group%name = name
        group%row = of_group(name)
        allocate (group%value(size(group%row)))
        call find_lines(content, group)
    end subroutine start_group

    ! End the program with all names of all groups that are unknown, and the line of the first.
    subroutine check_names(content)
        type(case_text_t), intent(in) :: content

        type(group_t) :: group
        character(len=:), allocatable :: unknown
        integer :: i, line

        unknown = ''
        line = 0
        do i = 1, size(groups)
            call start_group(content, trim(groups(i)), group)
            if (group%first > 0) call find_values(content, group, unknown, line)
        end do
        if (line > 0) call refuse_line(content%file, line, unknown(3:), '')
    end subroutine check_names

    ! The names of a group that begin as another one does; else where all of them are told.
    function similar_names(group, name) result(words)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: name
        character(len=:), allocatable :: words

        character(len=:), allocatable :: key
        integer :: i, length, longest

        words = ''
        longest = enough_alike
        do i = 1, size(group%row)
            key = trim(settings(group%row(i))%key)
            length = alike(lower_case(key), lower_case(name))
            if (length < longest) cycle
            if (length > longest) words = ''
            longest = length
            words = words // ' or ' // key
        end do
        if (len(words) > 0) then
            words = 'did you mean ' // words(5:) // '?'
        else
            words = 'faststrip settings lists those that there are'
        end if
    end function similar_names

    ! How many letters two words have in common, from their first one on.
    pure integer function alike(one, other) result(length)
        character(len=*), intent(in) :: one, other

        do length = 0, min(len(one), len(other)) - 1
            if (one(length + 1:length + 1) /= other(length + 1:length + 1)) return
        end do
        length = min(len(one), len(other))
    end function alike

    subroutine check_groups(content, known)
        type(case_text_t), intent(in) :: content
        character(len=*), intent(in) :: known(:)

        character(len=:), allocatable :: text, name
        integer :: i, at, open_at, slash
        logical :: is_seen(size(known))

        open_at = 0
        is_seen = .false.
        do i = 1, size(content%line)
            text = trim_blanks(content%line(i)%text)
            if (len(text) == 0) cycle
            if (text(1:1) == '&') then
                if (open_at > 0) call refuse_open()
                name = lower_case(first_word(text(2:)))
                at = findloc(known == name, .true., dim=1)
                if (at == 0) call refuse_line(content%file, i, 'unknown group: &' // name, '')
                if (is_seen(at)) call refuse_line(content%file, i, 'a group must stand once', &
                                                  '&' // name)
                is_seen(at) = .true.
                open_at = i
            else if (open_at == 0) then
                call refuse_line(content%file, i, 'text must stand in a group', text)
            end if
            if (first_outside_quotes(text, ';') > 0) &
                call refuse_line(content%file, i, 'must not hold a semicolon', text)
            slash = first_outside_quotes(text, '/')
            if (slash > 0 .and. slash < len(text)) &
                call refuse_line(content%file, i, 'a line must end at its slash', text)
            if (slash > 0) open_at = 0
        end do
        if (open_at > 0) call refuse_open()

    contains

        subroutine refuse_open()
            call refuse_line(content%file, open_at, 'a group must be closed by /', &
                             trim_blanks(content%line(open_at)%text))
        end subroutine refuse_open
    end subroutine check_groups

    !> Read a group, if it is there; ends the program at a value that the table of settings does not
    !> allow and where some are missing that are needed.
    subroutine read_group(content, name, group)
        type(case_text_t), intent(in) :: content !! a case file
        character(len=*), intent(in) :: name     !! lower case, without ampersand
        type(group_t), intent(out) :: group      !! its values

        character(len=:), allocatable :: unknown, missing
        integer :: i, line

        call start_group(content, name, group)
        if (group%first == 0) return
        unknown = ''
        line = 0
        call find_values(content, group, unknown, line)
        missing = ''
        do i = 1, size(group%row)
            if (group%value(i)%is_given) then
                call take_value(group, i)
            else if (settings(group%row(i))%is_needed) then
                missing = missing // ' and ' // trim(settings(group%row(i))%key)
            end if
        end do
        if (len(missing) > 0) call refuse_line(group%file, group%first, '&' // group%name // &
                                               missing(5:) // ' must be given', '')
    end subroutine read_group

    subroutine find_lines(content, group)
        type(case_text_t), intent(in) :: content
        type(group_t), intent(inout) :: group

        character(len=:), allocatable :: text
        integer :: i

        do i = 1, size(content%line)
            text = trim_blanks(content%line(i)%text)
            if (len(text) == 0) cycle
            if (group%first == 0 .and. text(1:1) == '&') then
                if (lower_case(first_word(text(2:))) == group%name) group%first = i
            end if
            if (group%first == 0) cycle
            group%last = i
            if (first_outside_quotes(text, '/') > 0) return
        end do
    end subroutine find_lines

    !> The text of each value of a group, over lines; of a name that stands twice the last. Unknown
    !> names are added to a text.
    subroutine find_values(content, group, unknown, line_of_first)
        type(case_text_t), intent(in) :: content
        type(group_t), intent(inout) :: group
        character(len=:), allocatable, intent(inout) :: unknown
        integer, intent(inout) :: line_of_first ! of the first unknown name, 0: none yet

        character(len=:), allocatable :: line, name
        integer :: i, at, row, from, name_at, equals

        at = 0
        do i = group%first, group%last
            line = content%line(i)%text
            from = 1
            if (i == group%first) from = index(line, '&') + len(group%name) + 1
            do
                call find_name(line, from, name_at, equals)
                call add_text(line(from:name_at - 1))
                if (equals > len(line)) exit
                name = trim_blanks(line(name_at:equals - 1))
                from = equals + 1
                if (len(name) == 0) &
                    call refuse_line(group%file, i, 'a name must stand before =', trim_blanks(line))
                row = find_setting(group%name, name)
                if (row == 0) then
                    at = -1
                    unknown = unknown // '; &' // group%name // ' unknown name: ' // name // &
                              ', ' // similar_names(group, name)
                    if (line_of_first == 0) line_of_first = i
                    cycle
                end if
                at = findloc(group%row, row, dim=1)
                group%value(at)%is_given = .true.
                group%value(at)%line = i
                group%value(at)%text = ''
                if (allocated(group%value(at)%list)) deallocate (group%value(at)%list)
            end do
        end do

    contains

        subroutine add_text(part)
            character(len=*), intent(in) :: part

            character(len=:), allocatable :: text

            text = trim_blanks(part)
            if (i == group%last) text = without_end(text, '/')
            if (len(text) == 0 .or. at < 0) return
            if (at == 0) call refuse_line(group%file, i, '&' // group%name // &
                                          ' must begin with a name', text)
            if (settings(group%row(at))%kind == a_list) then
                call take_part(text)
                return
            end if
            if (len(group%value(at)%text) > longest_line) &
                call refuse_line(group%file, i, '&' // group%name // ' ' // &
                                 trim(settings(group%row(at))%key) // ' must be one value', text)
            group%value(at)%text = trim_blanks(group%value(at)%text // ' ' // text)
        end subroutine add_text

        !> What stands on one line of a list, so that the line is named which is wrong; whether the
        !> numbers are in their range is asked of the whole list.
        subroutine take_part(text)
            character(len=*), intent(in) :: text

            integer :: fault

            call read_value(settings(group%row(at)), without_end(text, ','), group%value(at), fault)
            if (fault == wrong_kind) call refuse_line(group%file, i, '&' // group%name // ' ' &
                // trim(settings(group%row(at))%key) // ' must be a list of numbers', text)
        end subroutine take_part
    end subroutine find_values

    !> The next `name =` of a line: where the name starts, and where the equals sign is; both
    !> beyond the line if there is none.
    pure subroutine find_name(line, from, name_at, equals)
        character(len=*), intent(in) :: line
        integer, intent(in) :: from
        integer, intent(out) :: name_at, equals

        equals = first_outside_quotes(line(from:), '=')
        if (equals == 0) then
            name_at = len(line) + 1
            equals = name_at
            return
        end if
        equals = from + equals - 1
        name_at = verify(line(:equals - 1), ' ' // achar(9), back=.true.)
        do while (name_at >= from)
            if (scan(line(name_at:name_at), word_letters // '()') == 0) exit
            name_at = name_at - 1
        end do
        name_at = max(name_at + 1, from)
    end subroutine find_name

    !> Read a value that was found, and refuse it if it is not as the table says.
    subroutine take_value(group, i)
        type(group_t), intent(inout) :: group
        integer, intent(in) :: i

        character(len=:), allocatable :: text, key
        integer :: fault

        associate (setting => settings(group%row(i)), value => group%value(i))
            key = trim(setting%key)
            text = without_end(value%text, ',')
            if (any(setting%kind == [a_text, a_path, a_word])) then
                if (.not. is_quoted(text)) call refuse(group, key, 'must be text in quotes', text)
                text = unquoted(text)
            else if (setting%nought /= '' .and. is_quoted(text)) then
                text = unquoted(text)
            end if
            ! Its numbers are there already.
            if (setting%kind == a_list) text = ''
            call read_value(setting, text, value, fault)
            if (fault == wrong_kind) &
                call refuse(group, key, 'must be ' // trim(kind_words(setting)), text)
            if (setting%kind == a_list) value%number = number_to_name(value%list, fault)
            if (setting%quantity > 0) call hold_value(setting%quantity, '&' // group%name // ' ' &
                                                      // key, value%number, place(group, i))
            if (fault == no_fault) return
            if (any(setting%kind == [a_number, a_list])) then
                text = number_text(value%number)
                if (setting%quantity > 0) &
                    text = trim(text) // likely_mistake(setting%quantity, value%number)
                if (.not. abs(value%number) <= huge(value%number)) &
                    call refuse(group, key, 'must be a finite number', text)
            end if
            if (setting%kind == a_list) then
                if (size(value%list) > setting%most) text = 'more'
            end if
            call refuse(group, key, 'must be ' // trim(range_words(setting, value%number)), text)
        end associate
    end subroutine take_value

    !> The number of a list to speak of: the first that is not finite, else the least where one is
    !> out of range, else the largest.
    pure real(wp) function number_to_name(list, fault) result(number)
        real(wp), intent(in) :: list(:)
        integer, intent(in) :: fault

        integer :: k

        k = findloc(abs(list) <= huge(list), .false., dim=1)
        if (k == 0) k = merge(maxloc(abs(list), dim=1), minloc(list, dim=1), fault == no_fault)
        number = list(k)
    end function number_to_name

    !> Does the group give a name?
    logical function is_set(group, key)
        type(group_t), intent(in) :: group   !! that was read
        character(len=*), intent(in) :: key  !! name in the group

        is_set = group%value(at_key(group, key))%is_given
    end function is_set

    !> The value of a name.
    function given_value(group, key) result(value)
        type(group_t), intent(in) :: group   !! that was read
        character(len=*), intent(in) :: key  !! name in the group
        type(value_t) :: value

        value = group%value(at_key(group, key))
    end function given_value

    !> The number of a name, or a default if it is not given.
    real(wp) function number_of(group, key, default) result(number)
        type(group_t), intent(in) :: group      !! that was read
        character(len=*), intent(in) :: key     !! name in the group
        real(wp), intent(in) :: default         !! if it is not given

        number = default
        associate (value => group%value(at_key(group, key)))
            if (value%is_given) number = value%number
        end associate
    end function number_of

    !> The text of a name, or a default if it is not given; a path as it stands there.
    function text_of(group, key, default) result(text)
        type(group_t), intent(in) :: group      !! that was read
        character(len=*), intent(in) :: key     !! name in the group
        character(len=*), intent(in) :: default !! if it is not given
        character(len=:), allocatable :: text

        text = default
        associate (value => group%value(at_key(group, key)))
            if (value%is_given) text = value%text
        end associate
    end function text_of

    !> The numbers of a list; none if it is not given.
    function list_of(group, key) result(list)
        type(group_t), intent(in) :: group   !! that was read
        character(len=*), intent(in) :: key  !! name in the group
        real(wp), allocatable :: list(:)

        allocate (list(0))
        associate (value => group%value(at_key(group, key)))
            if (value%is_given) list = value%list
        end associate
    end function list_of

    integer function at_key(group, key) result(at)
        type(group_t), intent(in) :: group
        character(len=*), intent(in) :: key

        do at = 1, size(group%row)
            if (settings(group%row(at))%key == key) return
        end do
        error stop 'faststrip: a setting is asked for that is not in the table'
    end function at_key

    !> End the program with an error about a name of a group; the line is the one that gives it.
    subroutine refuse(group, key, what, value)
        type(group_t), intent(in) :: group       !! a group of a case file
        character(len=*), intent(in) :: key      !! name in the group
        character(len=*), intent(in) :: what     !! what is wrong
        character(len=*), intent(in) :: value    !! the offending value; may be empty

        integer :: at, line

        at = at_key(group, key)
        line = max(group%first, 1)
        if (group%value(at)%is_given) line = group%value(at)%line
        call refuse_line(group%file, line, '&' // group%name // ' ' // key // ' ' // what, value)
    end subroutine refuse

    !> The same about the first of some names that is given.
    subroutine refuse_each(group, keys, what)
        type(group_t), intent(in) :: group       !! a group of a case file
        character(len=*), intent(in) :: keys(:)  !! names in the group
        character(len=*), intent(in) :: what     !! what is wrong

        integer :: i

        do i = 1, size(keys)
            if (is_set(group, trim(keys(i)))) call refuse(group, trim(keys(i)), what, '')
        end do
    end subroutine refuse_each

    !> Where a value stands, as `FILE:LINE`.
    function place(group, i)
        type(group_t), intent(in) :: group
        integer, intent(in) :: i
        character(len=:), allocatable :: place

        place = group%file // ':' // integer_text(group%value(i)%line)
    end function place

    !> End the program with an error about a line.
    subroutine refuse_line(file, number, what, value)
        character(len=*), intent(in) :: file
        integer, intent(in) :: number
        character(len=*), intent(in) :: what, value

        character(len=:), allocatable :: text

        text = what
        if (len_trim(value) > 0) text = text // ', got ' // trim(value)
        call fail(exit_bad_input, text // ' (' // file // ':' // integer_text(number) // ')')
    end subroutine refuse_line

    !> Take the file that a name of a group is the path of; ends the program if there is none.
    subroutine take_file(group, key, path, instead)
        type(group_t), intent(in) :: group       !! a group of a case file
        character(len=*), intent(in) :: key      !! name in the group
        character(len=*), intent(in) :: path     !! of the file, as seen from here
        character(len=*), intent(in) :: instead  !! what may stand there instead; may be empty

        logical :: is_there

        inquire (file=path, exist=is_there)
        if (.not. is_there) call refuse(group, key, 'must be ' // instead // &
                                        'a file that is there', path)
        call take_input(path)
    end subroutine take_file

    !> A path that is relative to the folder of another file.
    pure function beside(file, path) result(resolved)
        character(len=*), intent(in) :: file     !! name of that file
        character(len=*), intent(in) :: path     !! as it stands there
        character(len=len(path) + merge(0, index(file, '/', back=.true.), index(path, '/') == 1)) &
            :: resolved

        resolved = path
        if (index(path, '/') /= 1) resolved = file(:index(file, '/', back=.true.)) // path
    end function beside

    !> The line up to an exclamation mark outside quotes.
    pure function without_comment(text) result(kept)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: kept

        integer :: mark

        mark = first_outside_quotes(text, '!')
        if (mark == 0) mark = len(text) + 1
        kept = text(:mark - 1)
    end function without_comment

    !> Position of the first such character that stands outside quotes; 0 if there is none.
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

    !> A text without one such character at its end, and the blanks before it.
    pure function without_end(text, mark) result(kept)
        character(len=*), intent(in) :: text
        character, intent(in) :: mark
        character(len=:), allocatable :: kept

        kept = text
        if (len(text) == 0) return
        if (text(len(text):) == mark) kept = trim_blanks(text(:len(text) - 1))
    end function without_end

    pure function first_word(text) result(word)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: word

        word = text(:scan(text // ' ', ' /' // achar(9)) - 1)
    end function first_word

    !> Is a value one text between quotes, which stand doubled inside?
    pure logical function is_quoted(value)
        character(len=*), intent(in) :: value

        integer :: i

        is_quoted = .false.
        if (len(value) < 2) return
        if (value(1:1) /= '''' .and. value(1:1) /= '"') return
        i = 2
        do while (i <= len(value))
            if (value(i:i) == value(1:1)) then
                is_quoted = i == len(value)
                if (is_quoted) return
                if (value(i + 1:i + 1) /= value(1:1)) return
                i = i + 1
            end if
            i = i + 1
        end do
    end function is_quoted

    !> What stands between the quotes.
    pure function unquoted(value) result(text)
        character(len=*), intent(in) :: value
        character(len=:), allocatable :: text

        integer :: i

        text = ''
        i = 2
        do while (i < len(value))
            text = text // value(i:i)
            if (value(i:i) == value(1:1)) i = i + 1
            i = i + 1
        end do
    end function unquoted
end module faststrip_command_settings_group
