!> Lines of text files, read strictly: the file goes through a buffer, and a line is a range of it.
!>
!> A line ends with LF, CRLF or CR; the last one may have no end. A byte order mark of UTF-8 in
!> front is passed over; a file in UTF-16 is refused by that name.
module faststrip_files_lines
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_long, c_null_char, &
                                           c_null_ptr, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: status_t, set_status, clear_status, st_file_missing, &
                                     st_file_format
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_files_sha256, only: sha256_t, sha256_add
    use faststrip_files_stdio, only: c_open_input, c_fread, c_ferror, c_fclose, c_fseek
    implicit none
    private

    public :: text_file_t, open_text, find_line, read_line, close_text, is_folder, longest_line
    public :: place_t, place_in, go_to_place, count_anew

    ! What is longer has no end, or is no table: the longest table the program writes itself has a
    ! row for each of a million random gaps.
    integer, parameter :: longest_line = 65536    !! characters
    integer, parameter :: most_lines = 1200000    !! of a file
    integer, parameter :: most_bytes = 268435456  !! of a file

    ! Longer than any line with its end.
    ! Tuned [characters]. Origin: chosen: most files are read at once, and so large a piece of
    ! memory is not yet fetched from the system and given back each time.
    integer, parameter :: buffer_length = longest_line + 4096

    !> A text file being read.
    type :: text_file_t
        character(len=:), allocatable :: path !! its name
        integer :: line = 0                   !! number of the line read last
        character(kind=c_char, len=:), allocatable :: buffer !! of the file, what is read on
        logical :: is_hashed = .false.        !! is `hash` of all that is read?
        type(sha256_t) :: hash                !! started by the caller, before the first line
        character(len=:), allocatable :: without !! in messages: what the limits are without, or ''
        integer, private :: lines = 0         !! that count for the limit
        integer, private :: bytes = 0         !! the same
        integer(int64), private :: base = 0   !! bytes of the file before the buffer
        type(c_ptr), private :: stream = c_null_ptr !! of the C library
        integer, private :: next = 1          !! first character of the buffer not yet given
        integer, private :: filled = 0        !! last one that was read
        logical, private :: has_ended = .false. !! is there nothing left to fill it with?
        logical, private :: has_failed = .false. !! because reading failed?
    end type text_file_t

    !> Between two lines of a file.
    type :: place_t
        integer(int64) :: offset = 0 !! bytes before it
        integer :: line = 0          !! lines before it
    end type place_t

    character(len=1), parameter :: line_feed = achar(10), carriage_return = achar(13)
    ! What may stand in front of a text in UTF-8, and in UTF-16.
    character(len=*), parameter :: byte_order_mark = char(239) // char(187) // char(191)
    character(len=*), parameter :: wide_marks(2) = [char(255) // char(254), char(254) // char(255)]

    interface
        function c_access(path, mode) bind(c, name='access') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode
            integer(c_int) :: code
        end function c_access
    end interface

    ! Given: of access(), is it there, and may it be read?
    integer(c_int), parameter :: is_there = 0, to_read = 4

contains

    !> Open a text file for reading.
    subroutine open_text(path, file, status)
        character(len=*), intent(in) :: path    !! name of the file
        type(text_file_t), intent(out) :: file  !! to be closed by `close_text` if all is well
        type(status_t), intent(out) :: status   !! `st_file_missing`: not there, a folder, or not
                                                !! readable
        call clear_status(status)
        file%path = path
        file%without = ''
        if (.not. may(path, is_there)) then
            call set_status(status, st_file_missing, 'no such file: ' // path)
        else if (is_folder(path)) then
            call set_status(status, st_file_missing, 'a folder, not a file: ' // path)
        else
            file%stream = c_open_input(trim(path) // c_null_char)
            if (c_associated(file%stream)) then
                allocate (character(len=buffer_length) :: file%buffer)
                return
            end if
            call set_status(status, st_file_missing, 'cannot read the file: ' // path)
            if (.not. may(path, to_read)) &
                status%message = trim(status%message) // ': permission denied'
        end if
    end subroutine open_text

    !> Close a file.
    subroutine close_text(file)
        type(text_file_t), intent(inout) :: file !! opened by `open_text`
        integer(c_int) :: code

        ! Nothing was written, so that nothing is lost if that fails.
        if (c_associated(file%stream)) code = c_fclose(file%stream)
        file%stream = c_null_ptr
        if (allocated(file%buffer)) deallocate (file%buffer)
    end subroutine close_text

    !> Where the next line begins.
    pure type(place_t) function place_in(file)
        type(text_file_t), intent(in) :: file !! an open one

        place_in = place_t(file%base + file%next - 1, file%line)
    end function place_in

    !> Read on from a place where a line begins. What was passed over is not hashed.
    subroutine go_to_place(file, place, status)
        type(text_file_t), intent(inout) :: file !! an open one that can be read twice
        type(place_t), intent(in) :: place       !! of `place_in`
        type(status_t), intent(out) :: status    !! `st_file_format`: it cannot be read there

        call clear_status(status)
        if (c_fseek(file%stream, int(place%offset, c_long), 0_c_int) /= 0) then
            call set_place_status(status, st_file_format, 'cannot read on', '', file%path, &
                                  place%line)
            return
        end if
        file%base = place%offset
        file%line = place%line
        file%next = 1
        file%filled = 0
        file%has_ended = .false.
    end subroutine go_to_place

    !> Let the limits count from here on: what was read so far is no sign that there is no end.
    pure subroutine count_anew(file)
        type(text_file_t), intent(inout) :: file !! an open one

        file%lines = 0
        file%bytes = 0
    end subroutine count_anew

    !> Is there a folder of that name?
    logical function is_folder(path)
        character(len=*), intent(in) :: path !! a name

        is_folder = may(path // '/.', is_there)
    end function is_folder

    ! May a file be what is asked? The C library says it: a host has no unit of Fortran's to spare.
    logical function may(path, mode)
        character(len=*), intent(in) :: path
        integer(c_int), intent(in) :: mode

        may = c_access(trim(path) // c_null_char, mode) == 0
    end function may

    !> The next line of a file without its line end.
    subroutine read_line(file, line, found, status)
        type(text_file_t), intent(inout) :: file            !! counts the lines
        character(len=:), allocatable, intent(out) :: line  !! the line; empty at the end
        logical, intent(out) :: found                       !! was there a line left?
        type(status_t), intent(out) :: status               !! as of `find_line`
        integer :: first, last

        call find_line(file, first, last, found, status)
        line = file%buffer(first:last)
    end subroutine read_line

    !> The same as a range of `file%buffer`, until the next call.
    subroutine find_line(file, first, last, found, status)
        type(text_file_t), intent(inout) :: file !! counts the lines
        integer, intent(out) :: first, last   !! the line's characters; none at the end
        logical, intent(out) :: found         !! was there a line left?
        type(status_t), intent(inout) :: status !! set if not all is well: `st_file_format`:
                                              !! reading failed, or there is too much to read
        integer :: i

        i = file%next
        do
            do i = i, file%filled
                ! Most characters are beyond both.
                if (file%buffer(i:i) > carriage_return) cycle
                if (file%buffer(i:i) == line_feed .or. file%buffer(i:i) == carriage_return) exit
            end do
            ! Whether a CR is half of a line end, the character behind it tells.
            if (i < file%filled .or. file%has_ended .or. i - file%next > longest_line) exit
            if (i == file%filled) then
                if (file%buffer(i:i) == line_feed) exit
            end if
            i = i - file%next
            call fill(file)
            i = i + file%next
        end do
        first = file%next
        last = i - 1
        found = first <= file%filled
        if (found .or. file%has_failed) then
            file%line = file%line + 1
            file%lines = file%lines + 1
        end if
        if (last - first + 1 > longest_line) then
            call refuse('a line must have at most ' // integer_text(longest_line) // ' characters')
        else if (file%has_failed .and. i > file%filled) then
            call refuse('cannot read on')
        end if
        file%next = min(i, file%filled) + 1
        if (i < file%filled) then
            if (file%buffer(i:i + 1) == carriage_return // line_feed) file%next = i + 2
        end if
        file%bytes = file%bytes + last - first + 2
        if (file%line == 1) then
            if (is_wide(file%buffer(first:last))) &
                call refuse('a file must be text of one byte a character, this one is UTF-16')
            if (index(file%buffer(first:last), byte_order_mark) == 1) &
                first = first + len(byte_order_mark)
        end if
        if (file%lines > most_lines .or. file%line == huge(file%line)) then
            call refuse('a file must have at most ' // integer_text(most_lines) // ' lines' &
                        // file%without)
        else if (file%bytes > most_bytes) then
            call refuse('a file must have at most ' // integer_text(most_bytes/1048576) // ' MB' &
                        // file%without)
        end if

    contains

        subroutine refuse(what)
            character(len=*), intent(in) :: what

            call set_place_status(status, st_file_format, what, '', file%path, file%line)
        end subroutine refuse
    end subroutine find_line

    ! Is it the first line of a text of two bytes a character, with its mark or without?
    pure logical function is_wide(line)
        character(len=*), intent(in) :: line
        character(len=2) :: pair

        pair = line
        is_wide = any(wide_marks == pair) .or. len(line) > 1 .and. &
                  (pair(1:1) == achar(0) .neqv. pair(2:2) == achar(0))
    end function is_wide

    ! Read on, behind what was not yet given, which moves to the beginning of the buffer.
    subroutine fill(file)
        type(text_file_t), intent(inout) :: file
        integer(c_size_t) :: room, n

        file%buffer(:file%filled - file%next + 1) = file%buffer(file%next:file%filled)
        file%filled = file%filled - file%next + 1
        file%base = file%base + file%next - 1
        file%next = 1
        room = len(file%buffer) - file%filled
        n = c_fread(file%buffer(file%filled + 1:), 1_c_size_t, room, file%stream)
        if (file%is_hashed) &
            call sha256_add(file%hash, file%buffer(file%filled + 1:file%filled + int(n)))
        file%filled = file%filled + int(n)
        file%has_ended = n < room
        file%has_failed = c_ferror(file%stream) /= 0
    end subroutine fill
end module faststrip_files_lines
