!> Tables of comma-separated values: a strict reader, and a writer that leaves either the whole
!> new file or the old one.
!>
!> The dialect: comment lines start with `#`, the first other line names the columns, then one
!> row a line. Cells are separated by commas; blanks around a cell do not count; a cell in double
!> quotes may hold commas, blanks and doubled quotes, but no line break. Empty lines are passed
!> over. Line ends LF or CRLF, a byte order mark in front is tolerated.
module faststrip_files_csv
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_null_char, &
                                           c_null_ptr, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: output_unit
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_file_format, st_file_write
    use faststrip_base_text, only: trim_blanks, parse_real, parse_integer, integer_text, &
                                   set_place_status
    use faststrip_files_lines, only: text_file_t, open_text, close_text, is_folder, read_line
    implicit none
    private

    public :: csv_text_t, csv_table_t, csv_writer_t
    public :: read_csv, column_index, require_column, cell_text, cell_number, cell_integer
    public :: column_numbers
    public :: temporary_prefix, temporary_ending, most_temporaries, temporary_name
    public :: open_csv, put_comment, put_header, put_cell, end_row, put_line, close_csv, abort_csv
    public :: real_text

    !> One text of its own length.
    type :: csv_text_t
        character(len=:), allocatable :: text !! without quotes
    end type csv_text_t

    !> A file as it was read.
    type :: csv_table_t
        character(len=:), allocatable :: file         !! name of the file
        integer :: n_columns = 0                      !! number of columns
        integer :: n_rows = 0                         !! number of rows below the header
        type(csv_text_t), allocatable :: names(:)     !! names of the columns
        type(csv_text_t), allocatable :: cells(:, :)  !! texts, (column, row)
        integer, allocatable :: line(:)               !! line of the file each row stands on
        type(csv_text_t), allocatable :: comments(:)  !! comment lines, without the `#`
    end type csv_table_t

    !> A file being written; its parts are the writer's own business.
    type :: csv_writer_t
        private
        character(len=:), allocatable :: path
        character(len=:), allocatable :: final
        character(len=:), allocatable :: temporary
        character(len=:), allocatable :: row
        type(status_t) :: status
        type(c_ptr) :: stream = c_null_ptr
        integer :: n_cells = 0
    end type csv_writer_t

    !> Add one cell to the row: text (quoted where needed), a whole number, or a real number so
    !> that it reads back as the same double; a number that is not finite leaves the cell empty.
    interface put_cell
        module procedure put_text_cell, put_integer_cell, put_real_cell
    end interface put_cell

    ! Files are written through the C library: its streams report every failed write, also one
    ! that shows only when the buffer is emptied, where FLUSH and CLOSE may stay silent.
    interface
        function c_fopen(path, mode) bind(c, name='fopen') result(stream)
            import :: c_char, c_ptr
            character(kind=c_char), intent(in) :: path(*), mode(*)
            type(c_ptr) :: stream
        end function c_fopen

        function c_fdopen(descriptor, mode) bind(c, name='fdopen') result(stream)
            import :: c_char, c_int, c_ptr
            integer(c_int), value :: descriptor
            character(kind=c_char), intent(in) :: mode(*)
            type(c_ptr) :: stream
        end function c_fdopen

        function c_dup(descriptor) bind(c, name='dup') result(copy)
            import :: c_int
            integer(c_int), value :: descriptor
            integer(c_int) :: copy
        end function c_dup

        function c_fputs(text, stream) bind(c, name='fputs') result(code)
            import :: c_char, c_int, c_ptr
            character(kind=c_char), intent(in) :: text(*)
            type(c_ptr), value :: stream
            integer(c_int) :: code
        end function c_fputs

        function c_fclose(stream) bind(c, name='fclose') result(code)
            import :: c_int, c_ptr
            type(c_ptr), value :: stream
            integer(c_int) :: code
        end function c_fclose

        function c_rename(old, new) bind(c, name='rename') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: old(*), new(*)
            integer(c_int) :: code
        end function c_rename

        function c_remove(path) bind(c, name='remove') result(code)
            import :: c_char, c_int
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int) :: code
        end function c_remove

        function c_readlink(path, target, capacity) bind(c, name='readlink') result(length)
            import :: c_char, c_size_t
            character(kind=c_char), intent(in) :: path(*)
            character(kind=c_char), intent(out) :: target(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: length
        end function c_readlink

        function c_gethostname(name, capacity) bind(c, name='gethostname') result(code)
            import :: c_char, c_int, c_size_t
            character(kind=c_char), intent(out) :: name(*)
            integer(c_size_t), value :: capacity
            integer(c_int) :: code
        end function c_gethostname

        ! The number of the C library's last error, by gfortran's own library.
        function last_error() bind(c, name='_gfortran_ierrno_i4') result(number)
            import :: c_int
            integer(c_int) :: number
        end function last_error

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

        function c_getpid() bind(c, name='getpid') result(number)
            import :: c_int
            integer(c_int) :: number
        end function c_getpid
    end interface

    !> What is written goes to a file of the name `faststrip_HOST_PROCESS_NUMBER.tmp` beside its
    !> place first; by host and process a file that a killed run left is told from that of a run
    !> which goes on.
    character(len=*), parameter :: temporary_ending = '.tmp'
    !> The numbers go up to this.
    integer, parameter :: most_temporaries = 8

    ! More cells than this are no table, or have no end: 1 GB in memory.
    integer, parameter :: most_cells = 25000000
    integer, parameter :: longest_path = 4096

    character(len=*), parameter :: byte_order_mark = char(239) // char(187) // char(191)

contains

    !> Read a whole file. On an error the table is empty but for the name of the file.
    subroutine read_csv(path, table, status)
        character(len=*), intent(in) :: path     !! name of the file
        type(csv_table_t), intent(out) :: table  !! names, texts and line numbers
        type(status_t), intent(out) :: status    !! `st_file_missing`; `st_file_format`: no
                                                 !! header, a name twice, a row with more or
                                                 !! fewer cells than names, an open quote
        type(text_file_t) :: file

        call empty_table(path, table)
        call open_text(path, file, status)
        if (status%code /= 0) return
        call read_rows(file, table, status)
        call close_text(file)
        if (status%code /= 0) call empty_table(path, table)
    end subroutine read_csv

    subroutine empty_table(path, table)
        character(len=*), intent(in) :: path
        type(csv_table_t), intent(out) :: table

        table%file = path
        allocate (table%names(0), table%cells(0, 0), table%line(0), table%comments(0))
    end subroutine empty_table

    subroutine read_rows(file, table, status)
        type(text_file_t), intent(inout) :: file
        type(csv_table_t), intent(inout) :: table
        type(status_t), intent(inout) :: status
        character(len=:), allocatable :: line
        type(csv_text_t), allocatable :: cells(:)
        integer :: n_comments
        logical :: found, has_header

        n_comments = 0
        has_header = .false.
        do
            call read_line(file, line, found, status)
            if (status%code /= 0) return
            if (.not. found) exit
            if (file%line == 1 .and. index(line, byte_order_mark) == 1) line = line(4:)
            line = trim_blanks(line)
            if (len(line) == 0) cycle
            if (line(1:1) == '#') then
                call append_comment(table%comments, n_comments, trim_blanks(line(2:)))
                cycle
            end if
            call split_line(line, cells, table%file, file%line, status)
            if (status%code /= 0) return
            if (has_header) then
                call append_row(table, cells, file%line, status)
            else
                call take_header(table, cells, file%line, status)
                has_header = .true.
            end if
            if (status%code /= 0) return
        end do
        table%comments = table%comments(:n_comments)
        if (.not. has_header) then
            call set_place_status(status, st_file_format, 'no row of column names', '', &
                                  table%file, 0)
            return
        end if
        table%cells = table%cells(:, :table%n_rows)
        table%line = table%line(:table%n_rows)
    end subroutine read_rows

    pure subroutine append_comment(comments, n, text)
        type(csv_text_t), allocatable, intent(inout) :: comments(:)
        integer, intent(inout) :: n
        character(len=*), intent(in) :: text
        type(csv_text_t), allocatable :: wider(:)

        if (n == size(comments)) then
            allocate (wider(2*n + 8))
            wider(:n) = comments
            call move_alloc(wider, comments)
        end if
        n = n + 1
        comments(n)%text = text
    end subroutine append_comment

    subroutine take_header(table, cells, number, status)
        type(csv_table_t), intent(inout) :: table
        type(csv_text_t), intent(in) :: cells(:)
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        integer :: i, j

        do i = 2, size(cells)
            do j = 1, i - 1
                if (cells(i)%text == cells(j)%text) then
                    call set_place_status(status, st_file_format, 'column name used twice', &
                                          "'" // cells(i)%text // "'", table%file, number)
                    return
                end if
            end do
        end do
        table%n_columns = size(cells)
        table%names = cells
        deallocate (table%cells)
        allocate (table%cells(table%n_columns, 0))
    end subroutine take_header

    subroutine append_row(table, cells, number, status)
        type(csv_table_t), intent(inout) :: table
        type(csv_text_t), intent(in) :: cells(:)
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        type(csv_text_t), allocatable :: more_cells(:, :)
        integer, allocatable :: more_lines(:)
        integer :: n, capacity, i, j

        if (size(cells) /= table%n_columns) then
            call refuse_width(table, cells, number, status)
            return
        end if
        n = table%n_rows
        if (real(n + 1, wp)*table%n_columns > most_cells) then
            call set_place_status(status, st_file_format, 'a table of more than ' &
                                  // integer_text(most_cells) // ' cells', '', table%file, number)
            return
        end if
        if (n == size(table%line)) then
            capacity = 2*n + 64
            allocate (more_cells(table%n_columns, capacity), more_lines(capacity))
            do j = 1, n
                do i = 1, table%n_columns
                    call move_alloc(table%cells(i, j)%text, more_cells(i, j)%text)
                end do
            end do
            more_lines(:n) = table%line
            call move_alloc(more_cells, table%cells)
            call move_alloc(more_lines, table%line)
        end if
        n = n + 1
        table%cells(:, n) = cells
        table%line(n) = number
        table%n_rows = n
    end subroutine append_row

    ! A row that is too short misses its last columns; one that is too long has cells without any.
    subroutine refuse_width(table, cells, number, status)
        type(csv_table_t), intent(in) :: table
        type(csv_text_t), intent(in) :: cells(:)
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        character(len=:), allocatable :: what, value

        what = 'row of ' // integer_text(size(cells)) // ' cells under ' &
               // integer_text(table%n_columns) // ' column names'
        if (size(cells) < table%n_columns) then
            what = what // ', none for the column'
            value = table%names(size(cells) + 1)%text
        else
            what = what // ', one beyond the column ' // table%names(table%n_columns)%text
            value = "'" // cells(table%n_columns + 1)%text // "'"
        end if
        call set_place_status(status, st_file_format, what, value, table%file, number)
    end subroutine refuse_width

    subroutine split_line(line, cells, file, number, status)
        character(len=*), intent(in) :: line
        type(csv_text_t), allocatable, intent(out) :: cells(:)
        character(len=*), intent(in) :: file
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        integer :: pass, n, start, next
        character(len=:), allocatable :: text
        logical :: valid

        do pass = 1, 2
            n = 0
            start = 1
            do
                n = n + 1
                call take_cell(line, start, text, next, valid)
                if (.not. valid) then
                    call set_place_status(status, st_file_format, 'misplaced quote in cell ' // &
                                          integer_text(n), trim_blanks(line(start:)), file, number)
                    return
                end if
                if (pass == 2) call move_alloc(text, cells(n)%text)
                if (next > len(line)) exit
                start = next + 1
            end do
            if (pass == 1) allocate (cells(n))
        end do
    end subroutine split_line

    ! The cell that starts at a place of a line; `next` is the comma after it, or beyond the line.
    pure subroutine take_cell(line, start, text, next, valid)
        character(len=*), intent(in) :: line
        integer, intent(in) :: start
        character(len=:), allocatable, intent(out) :: text
        integer, intent(out) :: next
        logical, intent(out) :: valid
        integer :: i, first

        valid = .true.
        next = len(line) + 1
        if (start <= len(line)) then
            i = index(line(start:), ',')
            if (i > 0) next = start + i - 1
        end if
        text = trim_blanks(line(start:next - 1))
        if (index(text, '"') == 0) return

        valid = text(1:1) == '"'
        if (.not. valid) return
        first = start + index(line(start:), '"') - 1
        text = ''
        i = first + 1
        do
            valid = i <= len(line)
            if (.not. valid) return
            if (line(i:i) == '"') then
                if (i == len(line)) exit
                if (line(i + 1:i + 1) /= '"') exit
                i = i + 1
            end if
            text = text // line(i:i)
            i = i + 1
        end do
        next = index(line(i + 1:), ',')
        if (next == 0) then
            next = len(line) + 1
        else
            next = i + next
        end if
        valid = len(trim_blanks(line(i + 1:next - 1))) == 0
    end subroutine take_cell

    !> Number of the column of that name (upper and lower case differ); 0 if there is none.
    pure integer function column_index(table, name)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        character(len=*), intent(in) :: name     !! name of a column

        do column_index = 1, table%n_columns
            if (table%names(column_index)%text == name) return
        end do
        column_index = 0
    end function column_index

    !> Number of the column of that name, or an error that names it and the file.
    pure subroutine require_column(table, name, column, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        character(len=*), intent(in) :: name     !! name of a column
        integer, intent(out) :: column           !! its number; 0 if there is none
        type(status_t), intent(out) :: status    !! `st_file_format`

        call clear_status(status)
        column = column_index(table, name)
        if (column == 0) then
            call set_place_status(status, st_file_format, 'no such column', name, table%file, 0)
        end if
    end subroutine require_column

    !> The text of a cell; empty outside the table.
    pure function cell_text(table, row, column) result(text)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        integer, intent(in) :: column            !! 1 to n_columns
        character(len=:), allocatable :: text    !! without quotes

        text = ''
        if (row < 1 .or. row > table%n_rows) return
        if (column < 1 .or. column > table%n_columns) return
        text = table%cells(column, row)%text
    end function cell_text

    !> The real number in a cell. Refused: an empty cell, anything beside the number, NaN and
    !> infinities, numbers too large for a double.
    pure subroutine cell_number(table, row, column, value, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        integer, intent(in) :: column            !! 1 to n_columns
        real(wp), intent(out) :: value           !! the number; 0 on an error
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_file_format`
        logical :: valid

        value = 0.0_wp
        call check_cell(table, row, column, status)
        if (status%code /= 0) return
        call parse_real(table%cells(column, row)%text, value, valid)
        if (.not. valid) then
            call set_place_status(status, st_file_format, 'not a finite number in column ' // &
                                  table%names(column)%text, &
                                  "'" // table%cells(column, row)%text // "'", &
                                  table%file, table%line(row))
        end if
    end subroutine cell_number

    !> The whole number in a cell.
    pure subroutine cell_integer(table, row, column, value, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        integer, intent(in) :: column            !! 1 to n_columns
        integer, intent(out) :: value            !! the number; 0 on an error
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_file_format`
        logical :: valid

        value = 0
        call check_cell(table, row, column, status)
        if (status%code /= 0) return
        call parse_integer(table%cells(column, row)%text, value, valid)
        if (.not. valid) then
            call set_place_status(status, st_file_format, 'not a whole number in column ' // &
                                  table%names(column)%text, &
                                  "'" // table%cells(column, row)%text // "'", &
                                  table%file, table%line(row))
        end if
    end subroutine cell_integer

    pure subroutine check_cell(table, row, column, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row, column
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (row < 1 .or. row > table%n_rows .or. column < 1 .or. column > table%n_columns) then
            call set_status(status, st_bad_argument, 'no row ' // integer_text(row) // &
                            ', column ' // integer_text(column) // ' in the table')
        end if
    end subroutine check_cell

    !> All numbers of the column of that name.
    pure subroutine column_numbers(table, name, values, status)
        type(csv_table_t), intent(in) :: table               !! a table that was read
        character(len=*), intent(in) :: name                 !! name of a column
        real(wp), allocatable, intent(out) :: values(:)      !! n_rows numbers
        type(status_t), intent(out) :: status                !! `st_file_format`
        integer :: row, column

        allocate (values(table%n_rows), source=0.0_wp)
        call require_column(table, name, column, status)
        if (status%code /= 0) return
        do row = 1, table%n_rows
            call cell_number(table, row, column, values(row), status)
            if (status%code /= 0) return
        end do
    end subroutine column_numbers

    !> The beginning of the names of files being written on this host.
    function temporary_prefix() result(prefix)
        character(len=:), allocatable :: prefix !! `faststrip_HOST_`
        character(kind=c_char) :: name(longest_path)
        integer :: i

        prefix = 'faststrip_'
        name = c_null_char
        if (c_gethostname(name, int(size(name) - 1, c_size_t)) /= 0) return
        do i = 1, size(name)
            if (name(i) == c_null_char) exit
            if (name(i) /= '/') prefix = prefix // name(i)
        end do
        prefix = prefix // '_'
    end function temporary_prefix

    !> Where a file is written until it is whole.
    function temporary_name(path, number) result(name)
        character(len=*), intent(in) :: path       !! name of the file
        integer, intent(in) :: number              !! 1 to `most_temporaries`
        character(len=:), allocatable :: name

        name = final_path(path)
        name = name(:index(name, '/', back=.true.)) // temporary_prefix() &
               // integer_text(int(c_getpid())) // '_' // integer_text(number) // temporary_ending
    end function temporary_name

    ! Where symbolic links lead to, also to what is not there yet.
    function final_path(path) result(final)
        character(len=*), intent(in) :: path
        character(len=:), allocatable :: final
        integer, parameter :: most_links = 40
        character(kind=c_char) :: target(longest_path)
        character(len=:), allocatable :: text
        integer :: i, step, length

        final = path
        do step = 1, most_links
            length = int(c_readlink(final // c_null_char, target, size(target, kind=c_size_t)))
            if (length < 1) return
            allocate (character(len=length) :: text)
            do i = 1, length
                text(i:i) = target(i)
            end do
            if (text(1:1) /= '/') text = final(:index(final, '/', back=.true.)) // text
            call move_alloc(text, final)
        end do
    end function final_path

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
        if (index(path, '/dev/') /= 1) writer%final = final_path(path)
        writer%temporary = ''
        writer%row = ''
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
                writer%temporary = temporary_name(path, number)
                writer%stream = c_fopen(writer%temporary // c_null_char, 'wx' // c_null_char)
                if (c_associated(writer%stream)) exit
            end do
        end if
        if (.not. c_associated(writer%stream)) call note_failure(writer)
        status = writer%status
    end subroutine open_csv

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
        integer :: i

        do i = 1, size(names)
            call put_text_cell(writer, trim(names(i)))
        end do
        call end_row(writer)
    end subroutine put_header

    subroutine put_text_cell(writer, value)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: value       !! one line of text, kept as it is

        if (scan(value, achar(10) // achar(13)) > 0) call note_line_break(writer)
        call append_cell(writer, quoted(value))
    end subroutine put_text_cell

    subroutine put_integer_cell(writer, value)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        integer, intent(in) :: value                !! any

        call append_cell(writer, integer_text(value))
    end subroutine put_integer_cell

    subroutine put_real_cell(writer, value)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        real(wp), intent(in) :: value               !! any; not finite: an empty cell

        call append_cell(writer, real_text(value))
    end subroutine put_real_cell

    !> A double as text with 17 significant digits, which read back as the same double; empty
    !> if it is not finite.
    pure function real_text(value) result(text)
        real(wp), intent(in) :: value         !! any
        character(len=:), allocatable :: text !! as `1.2345678901234567E+002`, no blanks
        character(len=24) :: buffer

        text = ''
        if (.not. ieee_is_finite(value)) return
        write (buffer, '(es24.16e3)') value
        text = trim(adjustl(buffer))
    end function real_text

    pure function quoted(value) result(text)
        character(len=*), intent(in) :: value
        character(len=:), allocatable :: text
        integer :: i
        logical :: needed

        needed = scan(value, ',"') > 0
        if (len(value) > 0) needed = needed .or. len(trim_blanks(value)) < len(value) &
                                     .or. value(1:1) == '#'
        if (.not. needed) then
            text = value
            return
        end if
        text = '"'
        do i = 1, len(value)
            if (value(i:i) == '"') text = text // '"'
            text = text // value(i:i)
        end do
        text = text // '"'
    end function quoted

    subroutine append_cell(writer, text)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: text

        if (writer%n_cells > 0) writer%row = writer%row // ','
        writer%row = writer%row // text
        writer%n_cells = writer%n_cells + 1
    end subroutine append_cell

    !> End the row and write it.
    subroutine end_row(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_line(writer, writer%row)
        writer%row = ''
        writer%n_cells = 0
    end subroutine end_row

    !> Write one line as it is, for files that are no tables.
    subroutine put_line(writer, text)
        type(csv_writer_t), intent(inout) :: writer !! an open file, not in the middle of a row
        character(len=*), intent(in) :: text        !! the line, without its end
        integer(c_int) :: code

        if (.not. c_associated(writer%stream) .or. writer%status%code /= 0) return
        code = c_fputs(text // new_line('a') // c_null_char, writer%stream)
        if (code < 0) call note_failure(writer)
    end subroutine put_line

    subroutine note_failure(writer)
        type(csv_writer_t), intent(inout) :: writer

        character(len=:), allocatable :: name
        integer(c_int) :: number

        number = last_error()
        if (writer%status%code /= 0) return
        name = writer%path
        if (name == '-') name = 'standard output'
        call set_status(writer%status, st_file_write, 'cannot write the file: ' // name // ': ' &
                        // cause(number))
    end subroutine note_failure

    ! The C library's words for an error.
    function cause(number) result(words)
        integer(c_int), intent(in) :: number
        character(len=:), allocatable :: words
        character(kind=c_char), pointer :: text(:)
        type(c_ptr) :: place
        integer :: i

        place = c_strerror(number)
        call c_f_pointer(place, text, [int(c_strlen(place))])
        allocate (character(len=size(text)) :: words)
        do i = 1, size(text)
            words(i:i) = text(i)
        end do
    end function cause

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
            if (writer%status%code == 0) then
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
end module faststrip_files_csv
