!> Tables of comma-separated values as they are written: either the whole new file is left or the
!> old one. The dialect stands in `faststrip_files_csv`.
module faststrip_files_csv_writer
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_null_char, &
                                           c_null_ptr, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: int64, output_unit
    use faststrip_base_decimal, only: decompose_decimal
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_file_write
    use faststrip_base_text, only: integer_text
    use faststrip_files_lines, only: is_folder
    use faststrip_files_stdio, only: c_fopen, c_fdopen, c_fwrite, c_fclose, c_rename, c_remove
    use faststrip_files_temporary, only: most_temporaries, name_temporary, find_final_path
    implicit none
    private

    public :: csv_writer_t
    public :: open_csv, put_comment, put_header, put_cell, put_cells, put_empty_cells, end_row
    public :: put_line, close_csv, abort_csv
    public :: collect_csv, collected, collected_length, forget_collected, put_text
    public :: real_text, failure_words
    public :: finish_tables

    !> A file being written; its parts are the writer's own business.
    type :: csv_writer_t
        private
        character(len=:), allocatable :: path
        character(len=:), allocatable :: final
        character(len=:), allocatable :: temporary
        character(len=:), allocatable :: row ! may be longer
        integer :: used = 0                  ! characters of it that count
        logical :: collects = .false.        ! do ended rows stay in `row`?
        type(status_t) :: status
        type(c_ptr) :: stream = c_null_ptr
        integer :: n_cells = 0
    end type csv_writer_t

    ! Tuned [characters]: first room. Origin: chosen: a row of a result.
    integer, parameter :: first_room = 2048
    ! Of the C library's words for an error, which it has in every language.
    integer, parameter :: longest_words = 200

    !> Add one cell to the row: text (quoted where needed), a whole number, or a real number so
    !> that it reads back as the same double; a number that is not finite leaves the cell empty.
    interface put_cell
        module procedure put_text_cell, put_integer_cell, put_real_cell
    end interface put_cell

    !> Add several cells to the row.
    interface put_cells
        module procedure put_text_cells, put_integer_cells, put_real_cells, put_known_cells
    end interface put_cells

    abstract interface
        !> Make another file of a table that is whole.
        subroutine table_finisher(table, path, is_finished, status)
            import :: status_t
            character(len=*), intent(in) :: table !! name of the CSV file
            character(len=*), intent(in) :: path  !! of the file to be left, as it was given
            logical, intent(out) :: is_finished   !! else the CSV file gets that name
            type(status_t), intent(out) :: status !! `st_file_write`
        end subroutine table_finisher
    end interface

    procedure(table_finisher), pointer :: finish => null()

    interface
        function c_dup(descriptor) bind(c, name='dup') result(copy)
            import :: c_int
            integer(c_int), value :: descriptor
            integer(c_int) :: copy
        end function c_dup

        ! Where the C library keeps the number of its last error (errno), by the name that the
        ! Linux Standard Base gives it.
        function c_errno_location() bind(c, name='__errno_location') result(place)
            import :: c_ptr
            type(c_ptr) :: place
        end function c_errno_location

        function c_strerror(number) bind(c, name='strerror') result(text)
            import :: c_int, c_ptr
            integer(c_int), value :: number
            type(c_ptr) :: text
        end function c_strerror

        function c_strlen(text) bind(c, name='strlen') result(length)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: text
            integer(c_size_t) :: length
        end function c_strlen
    end interface

contains

    !> Start a file. What is written goes to a file of another name in the same folder until
    !> `close_csv` renames it: a run that fails leaves an older file as it was. `-` means the
    !> standard output; what is no ordinary file (`/dev/...`) is written directly. A symbolic link
    !> is followed.
    subroutine open_csv(writer, path, status)
        type(csv_writer_t), intent(out) :: writer !! to be closed by `close_csv` or `abort_csv`
        character(len=*), intent(in) :: path      !! name of the file, or `-`
        type(status_t), intent(out) :: status     !! `st_file_write`
        integer :: number

        call clear_status(status)
        writer%path = path
        writer%final = path
        if (index(path, '/dev/') /= 1) call find_final_path(path, writer%final)
        writer%temporary = ''
        allocate (character(len=first_room) :: writer%row)
        if (path == '-') then
            flush (output_unit)
            writer%stream = c_fdopen(c_dup(1_c_int), 'w' // c_null_char)
        else if (index(writer%final, '/dev/') == 1) then
            writer%stream = c_fopen(writer%final // c_null_char, 'w' // c_null_char)
        else if (len_trim(path) == 0) then
            call set_status(writer%status, st_file_write, 'cannot write a file without a name')
        else if (is_folder(path)) then
            call set_status(writer%status, st_file_write, 'cannot write the file: ' // path &
                            // ': Is a directory')
        else
            do number = 1, most_temporaries
                call name_temporary(path, number, writer%temporary)
                writer%stream = c_fopen(writer%temporary // c_null_char, 'wx' // c_null_char)
                if (c_associated(writer%stream)) exit
            end do
        end if
        if (.not. c_associated(writer%stream)) call note_failure(writer)
        status = writer%status
    end subroutine open_csv

    !> From now on `close_csv` lets a procedure make another file of a table.
    subroutine finish_tables(by)
        procedure(table_finisher) :: by !! it

        finish => by
    end subroutine finish_tables

    !> Start a writer that writes nowhere: lines and rows are collected until `forget_collected`.
    subroutine collect_csv(writer)
        type(csv_writer_t), intent(out) :: writer !! needs no closing

        writer%path = 'memory'
        writer%temporary = ''
        writer%collects = .true.
        allocate (character(len=first_room) :: writer%row)
    end subroutine collect_csv

    !> How much was collected so far.
    pure integer function collected_length(writer)
        type(csv_writer_t), intent(in) :: writer !! of `collect_csv`

        collected_length = writer%used
    end function collected_length

    !> A part of what was collected.
    pure function collected(writer, first, last) result(text)
        type(csv_writer_t), intent(in) :: writer !! of `collect_csv`
        integer, intent(in) :: first             !! its first character
        integer, intent(in) :: last              !! its last, at most `collected_length`
        character(len=last - first + 1) :: text

        text = writer%row(first:last)
    end function collected

    !> Begin to collect anew.
    pure subroutine forget_collected(writer)
        type(csv_writer_t), intent(inout) :: writer !! of `collect_csv`, not in the middle of a row

        writer%used = 0
    end subroutine forget_collected

    !> Add a comment line, above the header.
    subroutine put_comment(writer, text)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: text        !! one line; `# ` goes in front

        if (scan(text, achar(10) // achar(13)) > 0) call note_line_break(writer)
        call put_line(writer, '# ' // trim(text))
    end subroutine put_comment

    !> Add the row of column names.
    subroutine put_header(writer, names)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        character(len=*), intent(in) :: names(:)     !! the names; trailing blanks do not count

        call put_text_cells(writer, names)
        call end_row(writer)
    end subroutine put_header

    subroutine put_text_cells(writer, values)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: values(:)   !! texts; trailing blanks do not count
        integer :: i

        do i = 1, size(values)
            call put_text_cell(writer, trim(values(i)))
        end do
    end subroutine put_text_cells

    subroutine put_integer_cells(writer, values)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        integer, intent(in) :: values(:)            !! any
        integer :: i

        do i = 1, size(values)
            call put_integer_cell(writer, values(i))
        end do
    end subroutine put_integer_cells

    subroutine put_real_cells(writer, values, is_known)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        real(wp), intent(in) :: values(:)           !! any; not finite: an empty cell
        logical, intent(in), optional :: is_known   !! else empty cells, too; default true
        integer :: i

        do i = 1, size(values)
            call put_real_cell(writer, values(i), is_known)
        end do
    end subroutine put_real_cells

    subroutine put_known_cells(writer, values, known)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        real(wp), intent(in) :: values(:)           !! any; not finite: an empty cell
        logical, intent(in) :: known(:)             !! each; else an empty cell, too
        integer :: i

        do i = 1, size(values)
            call put_real_cell(writer, values(i), known(i))
        end do
    end subroutine put_known_cells

    !> Add empty cells to the row.
    subroutine put_empty_cells(writer, n)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        integer, intent(in) :: n                    !! how many
        integer :: i

        do i = 1, n
            call append_cell(writer, '')
        end do
    end subroutine put_empty_cells

    subroutine put_text_cell(writer, value)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: value       !! one line of text, kept as it is

        if (scan(value, achar(10) // achar(13)) > 0) call note_line_break(writer)
        call append_quoted(writer, value)
    end subroutine put_text_cell

    subroutine put_integer_cell(writer, value)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        integer, intent(in) :: value                !! any

        call append_cell(writer, integer_text(value))
    end subroutine put_integer_cell

    subroutine put_real_cell(writer, value, is_known)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        real(wp), intent(in) :: value               !! any; not finite: an empty cell
        logical, intent(in), optional :: is_known   !! else an empty cell, too; default true
        character(len=24) :: buffer
        integer :: first

        if (present(is_known)) then
            if (.not. is_known) then
                call append_cell(writer, '')
                return
            end if
        end if
        if (.not. ieee_is_finite(value)) then
            call append_cell(writer, '')
            return
        end if
        call write_real(value, buffer, first)
        call append_cell(writer, buffer(first:))
    end subroutine put_real_cell

    pure integer function real_length(value) result(length)
        real(wp), intent(in) :: value
        character(len=24) :: buffer
        integer :: first

        length = 0
        if (.not. ieee_is_finite(value)) return
        call write_real(value, buffer, first)
        length = len(buffer) - first + 1
    end function real_length

    !> A double as text with 17 significant digits, which read back as the same double; empty
    !> if it is not finite.
    pure function real_text(value) result(text)
        real(wp), intent(in) :: value               !! any
        character(len=real_length(value)) :: text   !! as `1.2345678901234567E+002`, no blanks
        character(len=24) :: buffer
        integer :: first

        if (len(text) == 0) return
        call write_real(value, buffer, first)
        text = buffer(first:)
    end function real_text

    ! A finite number into the end of a buffer.
    pure subroutine write_real(value, buffer, first)
        real(wp), intent(in) :: value
        character(len=24), intent(out) :: buffer
        integer, intent(out) :: first ! where the text begins: ends with the buffer

        ! Given: of the format es24.16e3.
        integer, parameter :: sign_at = 1, point_at = 3, mantissa_end = 19, exponent_sign_at = 21
        integer(int64) :: digits
        integer :: power, i
        logical :: is_sure

        call decompose_decimal(abs(value), digits, power, is_sure)
        ! Of zero, which has none, there are many.
        if (is_sure .or. .not. abs(value) > 0.0_wp) then
            do i = mantissa_end, sign_at + 1, -1
                if (i == point_at) cycle
                buffer(i:i) = achar(iachar('0') + int(modulo(digits, 10_int64)))
                digits = digits/10
            end do
            buffer(point_at:point_at) = '.'
            buffer(sign_at:sign_at) = merge('-', ' ', sign(1.0_wp, value) < 0.0_wp)
            buffer(mantissa_end + 1:mantissa_end + 1) = 'E'
            buffer(exponent_sign_at:exponent_sign_at) = merge('-', '+', power < 0)
            power = abs(power)
            do i = len(buffer), exponent_sign_at + 1, -1
                buffer(i:i) = achar(iachar('0') + modulo(power, 10))
                power = power/10
            end do
        else
            write (buffer, '(es24.16e3)') value
        end if
        first = merge(2, 1, buffer(sign_at:sign_at) == ' ')
    end subroutine write_real

    ! Add a text in quotes if it needs them.
    subroutine append_quoted(writer, value)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: value
        character(len=*), parameter :: blanks = ' ' // achar(9)
        integer :: i
        logical :: needed

        needed = scan(value, ',"') > 0
        if (len(value) > 0) needed = needed .or. scan(value(1:1), '#' // blanks) > 0 &
                                     .or. scan(value(len(value):), blanks) > 0
        if (.not. needed) then
            call append_cell(writer, value)
            return
        end if
        call append_cell(writer, '"')
        do i = 1, len(value)
            if (value(i:i) == '"') call append(writer, '"')
            call append(writer, value(i:i))
        end do
        call append(writer, '"')
    end subroutine append_quoted

    subroutine append_cell(writer, text)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: text

        if (writer%n_cells > 0) call append(writer, ',')
        call append(writer, text)
        writer%n_cells = writer%n_cells + 1
    end subroutine append_cell

    ! Put a text behind what there is of the row.
    subroutine append(writer, text)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: longer

        if (writer%used + len(text) > len(writer%row)) then
            allocate (character(len=2*(writer%used + len(text))) :: longer)
            longer(:writer%used) = writer%row(:writer%used)
            call move_alloc(longer, writer%row)
        end if
        writer%row(writer%used + 1:writer%used + len(text)) = text
        writer%used = writer%used + len(text)
    end subroutine append

    !> End the row and write it.
    subroutine end_row(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call append(writer, new_line('a'))
        writer%n_cells = 0
        if (writer%collects) return
        call put_text(writer, writer%row(:writer%used))
        writer%used = 0
    end subroutine end_row

    !> Write one line as it is, for files that are no tables.
    subroutine put_line(writer, text)
        type(csv_writer_t), intent(inout) :: writer !! an open file, not in the middle of a row
        character(len=*), intent(in) :: text        !! the line, without its end

        call append(writer, text)
        call end_row(writer)
    end subroutine put_line

    !> Write whole lines as they are.
    subroutine put_text(writer, text)
        type(csv_writer_t), intent(inout) :: writer !! an open file, not in the middle of a row
        character(len=*), intent(in) :: text        !! lines with their ends

        if (writer%collects) then
            call append(writer, text)
        else if (c_associated(writer%stream) .and. writer%status%code == 0) then
            if (c_fwrite(text, 1_c_size_t, len(text, c_size_t), writer%stream) &
                < len(text, c_size_t)) call note_failure(writer)
        end if
    end subroutine put_text

    subroutine note_failure(writer)
        type(csv_writer_t), intent(inout) :: writer

        character(len=:), allocatable :: name
        character(len=longest_words) :: words

        words = failure_words()
        if (writer%status%code /= 0) return
        name = writer%path
        if (name == '-') name = 'standard output'
        call set_status(writer%status, st_file_write, 'cannot write the file: ' // name // ': ' &
                        // trim(words))
    end subroutine note_failure

    !> The C library's words for its last error.
    function failure_words() result(words)
        character(len=longest_words) :: words
        integer(c_int), pointer :: last_error
        character(kind=c_char), pointer :: text(:)
        type(c_ptr) :: place
        integer :: i

        call c_f_pointer(c_errno_location(), last_error)
        place = c_strerror(last_error)
        call c_f_pointer(place, text, [int(c_strlen(place))])
        words = ''
        do i = 1, min(size(text), len(words))
            words(i:i) = text(i)
        end do
    end function failure_words

    subroutine note_line_break(writer)
        type(csv_writer_t), intent(inout) :: writer

        call set_status(writer%status, st_file_write, &
                        'a line break inside a cell of the file: ' // writer%path)
    end subroutine note_line_break

    !> Finish the file and give it its name. If anything failed since `open_csv`, or fails now,
    !> the file that was there before stays and the status says so.
    subroutine close_csv(writer, status)
        type(csv_writer_t), intent(inout) :: writer !! closed afterwards
        type(status_t), intent(out) :: status       !! `st_file_write`
        integer(c_int) :: code
        logical :: is_finished

        call clear_status(status)
        if (.not. c_associated(writer%stream)) then
            call set_status(status, st_file_write, 'the file is not open')
            return
        end if
        if (writer%n_cells > 0) call end_row(writer)
        code = c_fclose(writer%stream)
        writer%stream = c_null_ptr
        if (code /= 0) call note_failure(writer)
        if (len(writer%temporary) > 0) then
            is_finished = .false.
            if (associated(finish) .and. writer%status%code == 0) &
                call finish(writer%temporary, writer%path, is_finished, writer%status)
            if (is_finished) then
                code = c_remove(writer%temporary // c_null_char)
            else if (writer%status%code == 0) then
                code = c_rename(writer%temporary // c_null_char, writer%final // c_null_char)
                if (code /= 0) call note_failure(writer)
            end if
            if (writer%status%code /= 0) code = c_remove(writer%temporary // c_null_char)
        end if
        status = writer%status
    end subroutine close_csv

    !> Drop the file: what was there before stays. Harmless on a writer that is not open.
    subroutine abort_csv(writer)
        type(csv_writer_t), intent(inout) :: writer !! closed afterwards
        integer(c_int) :: code

        if (.not. c_associated(writer%stream)) return
        code = c_fclose(writer%stream)
        writer%stream = c_null_ptr
        if (len(writer%temporary) > 0) code = c_remove(writer%temporary // c_null_char)
    end subroutine abort_csv
end module faststrip_files_csv_writer
