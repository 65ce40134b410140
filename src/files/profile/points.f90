!> What a profile file holds, and what its reader was told: the points as they are read, with the
!> lines they stand on, and the words about them.
module faststrip_files_profile_points
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, message_length, st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, lower_case, set_place_status, &
                                   integer_text
    use faststrip_files_lines, only: text_file_t, open_text, read_line, close_text
    implicit none
    private

    public :: profile_file_t, profile_options_t, key_t, line_t
    public :: read_lines, append_point, add_key, add_note, without_comment, split_words
    public :: split_key, parse_words, has_decimal_commas, is_number_line, unquoted, length_unit
    public :: largest_coordinate

    !> A sense or a choice that is left to the format.
    integer, parameter :: sense_of_format = 0

    !> Largest coordinate that is read, in the file's own unit.
    real(wp), parameter :: largest_coordinate = 1.0e9_wp

    ! Around values that are texts.
    character(len=*), parameter :: quotes = '"'''

    !> One line of a file.
    type :: line_t
        character(len=:), allocatable :: text !! without its end
    end type line_t

    !> One word about a profile: a key of the header and its value, as they stand.
    type :: key_t
        character(len=:), allocatable :: key   !! as it stands
        character(len=:), allocatable :: value !! as it stands, without quotes
    end type key_t

    !> What the user says about a file; what is not said is the format's.
    type :: profile_options_t
        integer :: kind = 0                      !! `body_wheel`, `body_rail`; 0: the format's
        integer :: section = 0                   !! of a file with several; 0: the only one
        integer :: side = 1                      !! of a file with both sides: 1 right, -1 left
        integer :: y_sense = sense_of_format     !! +1 to the field side, -1 to flange or gauge
        integer :: z_sense = sense_of_format     !! +1 down, -1 up
        real(wp) :: unit_mm = 0.0_wp             !! mm to a unit of length; 0: the format's
        logical :: any_count = .false.           !! take a number of points the header denies?
        logical :: ignore_smoothing = .false.    !! pass over a file's own smoothing?
        logical :: has_tape_circle = .false.     !! is the next one given?
        real(wp) :: tape_circle = 0.0_wp         !! of a wheel, from the origin of the file's y to
                                                 !! the field side, mm
    end type profile_options_t

    !> A profile as a curve: y to the field side, z down, mm, from small y to large y.
    type :: profile_file_t
        character(len=16) :: format = ''         !! in words
        integer :: kind = 0                      !! `body_wheel`, `body_rail`; 0: not known
        integer :: n = 0                         !! number of points while they are read
        real(wp), allocatable :: y(:)            !! mm
        real(wp), allocatable :: z(:)            !! mm
        integer, allocatable :: line(:)          !! of the file
        integer :: y_sense = 1                   !! of the file: +1 to the field side
        integer :: z_sense = 1                   !! of the file: +1 down
        logical :: is_reversed = .false.         !! did the file run from large y to small y?
        real(wp) :: unit_mm = 1.0_wp             !! mm to a unit of the file
        logical :: has_unit = .true.             !! does the file or its format tell the unit?
        real(wp) :: tape_circle = 0.0_wp         !! y of it in the file, mm, to the field side
        real(wp) :: flange_back = -70.0_wp       !! y of the reference of a wheel's back, mm
        integer :: n_sections = 1                !! of the file
        integer :: section = 1                   !! that was read
        type(key_t), allocatable :: keys(:)      !! whatever else the header says
        integer :: n_keys = 0                    !! used of them
        character(len=message_length) :: notes = '' !! what was noticed, one line
    end type profile_file_t

    character(len=*), parameter :: blanks = ' ' // achar(9)
    character(len=*), parameter :: digits = '0123456789'
    character(len=*), parameter :: separators = ' ,;' // achar(9)

contains

    !> mm to a unit of length by its name; 0: there is no such unit.
    pure real(wp) function length_unit(name)
        character(len=*), intent(in) :: name !! `mm`, `m` or `in`

        select case (name)
        case ('mm'); length_unit = 1.0_wp
        case ('m'); length_unit = 1000.0_wp
        case ('in', 'inch'); length_unit = 25.4_wp
        case default; length_unit = 0.0_wp
        end select
    end function length_unit

    !> All lines of a file.
    subroutine read_lines(path, lines, status)
        character(len=*), intent(in) :: path                !! name of the file
        type(line_t), allocatable, intent(out) :: lines(:)  !! of the file
        type(status_t), intent(out) :: status               !! `st_file_missing`, `st_file_format`

        type(text_file_t) :: file
        type(line_t), allocatable :: longer(:)
        character(len=:), allocatable :: line
        integer :: n, i
        logical :: found

        allocate (lines(0))
        call open_text(path, file, status)
        if (is_error(status)) return
        deallocate (lines)
        allocate (lines(1024))
        n = 0
        do
            call read_line(file, line, found, status)
            if (is_error(status) .or. .not. found) exit
            if (n == size(lines)) then
                allocate (longer(2*n))
                do i = 1, n
                    call move_alloc(lines(i)%text, longer(i)%text)
                end do
                call move_alloc(longer, lines)
            end if
            n = n + 1
            call move_alloc(line, lines(n)%text)
        end do
        call close_text(file)
        allocate (longer(n))
        do i = 1, n
            call move_alloc(lines(i)%text, longer(i)%text)
        end do
        call move_alloc(longer, lines)
    end subroutine read_lines

    !> Add a point.
    subroutine append_point(profile, y, z, line)
        type(profile_file_t), intent(inout) :: profile !! being read
        real(wp), intent(in) :: y, z                   !! as they stand
        integer, intent(in) :: line                    !! where

        real(wp), allocatable :: longer(:)
        integer, allocatable :: longer_line(:)
        integer :: n

        n = profile%n
        if (.not. allocated(profile%y)) then
            allocate (profile%y(512), profile%z(512), source=0.0_wp)
            allocate (profile%line(512), source=0)
        else if (n == size(profile%y)) then
            allocate (longer(2*n), source=0.0_wp)
            longer(:n) = profile%y
            call move_alloc(longer, profile%y)
            allocate (longer(2*n), source=0.0_wp)
            longer(:n) = profile%z
            call move_alloc(longer, profile%z)
            allocate (longer_line(2*n), source=0)
            longer_line(:n) = profile%line
            call move_alloc(longer_line, profile%line)
        end if
        profile%n = n + 1
        profile%y(n + 1) = y
        profile%z(n + 1) = z
        profile%line(n + 1) = line
    end subroutine append_point

    !> Keep a word about the profile.
    subroutine add_key(profile, key, value)
        type(profile_file_t), intent(inout) :: profile !! being read
        character(len=*), intent(in) :: key            !! as it stands
        character(len=*), intent(in) :: value          !! as it stands; quotes around it are left

        type(key_t), allocatable :: longer(:)
        integer :: i, n

        if (.not. allocated(profile%keys)) allocate (profile%keys(32))
        n = profile%n_keys
        if (n == size(profile%keys)) then
            allocate (longer(2*n))
            do i = 1, n
                call move_alloc(profile%keys(i)%key, longer(i)%key)
                call move_alloc(profile%keys(i)%value, longer(i)%value)
            end do
            call move_alloc(longer, profile%keys)
        end if
        profile%n_keys = n + 1
        profile%keys(n + 1)%key = key
        profile%keys(n + 1)%value = unquoted(value)
    end subroutine add_key

    !> Add to what was noticed; what does not fit is cut.
    subroutine add_note(profile, words)
        type(profile_file_t), intent(inout) :: profile !! being read
        character(len=*), intent(in) :: words          !! a few

        if (profile%notes /= '') then
            profile%notes = trim(profile%notes) // '; ' // words
        else
            profile%notes = words
        end if
    end subroutine add_note

    ! Where a line ends before its comment.
    pure integer function content_end(line, marks)
        character(len=*), intent(in) :: line, marks

        integer :: i
        logical :: is_quoted

        is_quoted = .false.
        do i = 1, len(line)
            if (line(i:i) == "'") is_quoted = .not. is_quoted
            if (.not. is_quoted .and. index(marks, line(i:i)) > 0) exit
        end do
        ! A quote that is never closed quotes nothing.
        if (is_quoted .and. i > len(line)) then
            i = scan(line, marks)
            if (i == 0) i = len(line) + 1
        end if
        content_end = i - 1
    end function content_end

    !> A line without what follows the first comment mark outside single quotes, trimmed.
    pure function without_comment(line, marks) result(text)
        character(len=*), intent(in) :: line  !! any
        character(len=*), intent(in) :: marks !! each begins a comment
        character(len=len(trim_blanks(line(:content_end(line, marks))))) :: text

        text = trim_blanks(line(:content_end(line, marks)))
    end function without_comment

    ! 1 for a text in quotes, else 0.
    pure integer function quotes_of(text) result(n)
        character(len=*), intent(in) :: text

        n = 0
        if (len(text) < 2) return
        if (scan(text, quotes) == 1 .and. text(len(text):) == text(1:1)) n = 1
    end function quotes_of

    !> Text without the quotes around it.
    pure function unquoted(text) result(inner)
        character(len=*), intent(in) :: text     !! any
        character(len=len(trim_blanks(text)) - 2*quotes_of(trim_blanks(text))) :: inner
            !! without blanks around it, either

        inner = trim_blanks(text)
        if (quotes_of(trim_blanks(text)) == 1) inner = text(scan(text, quotes) + 1:)
    end function unquoted

    !> Key and value of a line `key = value`.
    pure subroutine split_key(line, key, value, is_key)
        character(len=*), intent(in) :: line                !! any
        character(len=:), allocatable, intent(out) :: key   !! before the first `=`
        character(len=:), allocatable, intent(out) :: value !! behind it
        logical, intent(out) :: is_key                      !! is there one?

        integer :: equals

        equals = index(line, '=')
        is_key = equals > 1
        key = ''
        value = ''
        if (.not. is_key) return
        key = trim_blanks(line(:equals - 1))
        value = trim_blanks(line(equals + 1:))
        is_key = len(key) > 0
    end subroutine split_key

    !> Places of the first words of a line; `n` counts all of them. Words are separated by blanks,
    !> or by one comma or semicolon with blanks around it: two in a row leave an empty word.
    pure subroutine split_words(line, first, last, n)
        character(len=*), intent(in) :: line       !! trimmed
        integer, intent(out) :: first(:), last(:)  !! places of the words
        integer, intent(out) :: n                  !! their number, which may be larger
        integer :: i, length

        first = 1
        last = 0
        n = 0
        i = 1
        do
            length = scan(line(i:), separators) - 1
            if (length < 0) length = len(line) - i + 1
            n = n + 1
            if (n <= size(first)) then
                first(n) = i
                last(n) = i + length - 1
            end if
            i = after_blanks(i + length)
            if (i > len(line)) exit
            if (scan(line(i:i), ',;') == 1) then
                i = after_blanks(i + 1)
                if (i > len(line)) then
                    ! A separator at the end leaves an empty word behind it.
                    n = n + 1
                    if (n <= size(first)) first(n) = len(line) + 1
                    if (n <= size(first)) last(n) = len(line)
                    exit
                end if
            end if
        end do

    contains

        pure integer function after_blanks(start)
            integer, intent(in) :: start

            after_blanks = len(line) + 1
            if (start > len(line)) return
            after_blanks = verify(line(start:), blanks) + start - 1
            if (after_blanks < start) after_blanks = len(line) + 1
        end function after_blanks
    end subroutine split_words

    !> The numbers of a line of points.
    subroutine parse_words(line, least, most, path, number, values, n, status)
        character(len=*), intent(in) :: line    !! trimmed
        integer, intent(in) :: least, most      !! numbers that may stand in it
        character(len=*), intent(in) :: path    !! of the file
        integer, intent(in) :: number           !! of the line
        real(wp), intent(out) :: values(:)      !! at least `most` long
        integer, intent(out) :: n               !! numbers that stand in it
        type(status_t), intent(inout) :: status !! `st_file_format`

        integer :: first(size(values)), last(size(values)), i
        logical :: valid
        character(len=:), allocatable :: what

        values = 0.0_wp
        call split_words(line, first, last, n)
        if (has_decimal_commas(line)) then
            call set_place_status(status, st_file_format, 'a coordinate must have a point for ' // &
                                  'its decimals, not a comma', line, path, number)
            return
        end if
        ! One separator may stand behind the last number.
        if (n > least .and. n <= size(values)) then
            if (last(n) < first(n)) n = n - 1
        end if
        if (n < least .or. n > most) then
            what = integer_text(least)
            if (most > least) what = what // ' to ' // integer_text(most)
            if (least == 2) what = 'two'
            call set_place_status(status, st_file_format, 'a point must be ' // what // &
                                  ' numbers', line, path, number)
            return
        end if
        do i = 1, n
            call parse_real(line(first(i):last(i)), values(i), valid)
            if (.not. valid .or. abs(values(i)) > largest_coordinate) then
                call set_place_status(status, st_file_format, &
                                      'a coordinate must be a finite number within 1e9', &
                                      "'" // line(first(i):last(i)) // "'", path, number)
                return
            end if
        end do
    end subroutine parse_words

    !> Are there commas between digits in a line without a point whose words something else
    !> separates, too?
    pure logical function has_decimal_commas(line)
        character(len=*), intent(in) :: line

        integer :: i

        has_decimal_commas = .false.
        if (index(line, ',') == 0 .or. index(line, '.') > 0) return
        do i = 2, len(line) - 1
            if (line(i:i) /= ',') cycle
            if (scan(line(i - 1:i - 1), digits) == 0 .or. scan(line(i + 1:i + 1), digits) == 0) &
                cycle
            has_decimal_commas = scan(line, blanks // ';') > 0
            return
        end do
    end function has_decimal_commas

    !> Does a line begin with a number?
    pure logical function is_number_line(line)
        character(len=*), intent(in) :: line !! trimmed

        integer :: first(1), last(1), n
        real(wp) :: value

        call split_words(line, first, last, n)
        call parse_real(lower_case(line(first(1):last(1))), value, is_number_line)
    end function is_number_line
end module faststrip_files_profile_points
