!> Tables of comma-separated values as they are read, strictly; the dialect stands in
!> `faststrip_files_csv`.
module faststrip_files_csv_table
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, parse_integer, integer_text, &
                                   set_place_status
    use faststrip_files_lines, only: text_file_t, open_text, close_text, find_line
    implicit none
    private

    public :: csv_text_t, csv_table_t
    public :: read_csv, column_index, require_column, cell_text, cell_number, cell_integer
    public :: column_numbers, several_columns
    public :: start_table, take_names, take_only_row, leave_blanks, byte_order_mark

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
        character(len=:), allocatable, private :: text !! of all cells, one behind the other; may
                                                       !! be longer
        integer, allocatable, private :: end_of(:)     !! where that of a cell ends, row by row,
                                                       !! from 0 on; may be longer
        integer, allocatable :: line(:)               !! line of the file each row stands on
        type(csv_text_t), allocatable :: comments(:)  !! comment lines, without the `#`
        integer, allocatable :: comment_line(:)       !! line of the file each stands on
    end type csv_table_t

    ! More cells than this are no table, or have no end: 1 GB in memory with the texts.
    integer, parameter :: most_cells = 25000000

    character(len=1), parameter :: tab = achar(9)
    !> What may stand in front of a text in UTF-8.
    character(len=*), parameter :: byte_order_mark = char(239) // char(187) // char(191)

contains

    ! Length of the text of a cell; 0 outside the table.
    pure integer function cell_length(table, row, column) result(length)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        integer, intent(in) :: column            !! 1 to n_columns
        integer :: i

        length = 0
        if (row < 1 .or. row > table%n_rows) return
        if (column < 1 .or. column > table%n_columns) return
        i = (row - 1)*table%n_columns + column
        length = table%end_of(i) - table%end_of(i - 1)
    end function cell_length

    !> Read a whole file. On an error the table is empty but for the name of the file.
    subroutine read_csv(path, table, status)
        character(len=*), intent(in) :: path     !! name of the file
        type(csv_table_t), intent(out) :: table  !! names, texts and line numbers
        type(status_t), intent(out) :: status    !! `st_file_missing`; `st_file_format`: no
                                                 !! header, a name twice, a row with more or
                                                 !! fewer cells than names, an open quote
        type(text_file_t) :: file

        call start_table(path, table)
        call open_text(path, file, status)
        if (status%code /= 0) return
        call read_rows(file, table, status)
        call close_text(file)
        if (status%code /= 0) call start_table(path, table)
    end subroutine read_csv

    !> A table without names and rows, for who takes line by line: `take_names`, then
    !> `take_only_row`.
    subroutine start_table(path, table)
        character(len=*), intent(in) :: path    !! name of the file, for messages
        type(csv_table_t), intent(out) :: table !! empty

        ! Tuned [characters, cells]: first room. Origin: chosen: a gap of 400 points.
        integer, parameter :: first_text = 16384, first_cells = 2048

        table%file = path
        allocate (table%names(0), table%line(0), table%comments(0), table%comment_line(0))
        allocate (character(len=first_text) :: table%text)
        allocate (table%end_of(0:first_cells))
        table%end_of(0) = 0
    end subroutine start_table

    subroutine read_rows(file, table, status)
        type(text_file_t), intent(inout) :: file
        type(csv_table_t), intent(inout) :: table
        type(status_t), intent(inout) :: status
        integer :: n_comments, first, last, filled, n
        logical :: found, has_header

        n_comments = 0
        filled = 0
        has_header = .false.
        do
            call find_line(file, first, last, found, status)
            if (status%code /= 0) return
            if (.not. found) exit
            if (file%line == 1 .and. index(file%buffer(first:last), byte_order_mark) == 1) &
                first = first + len(byte_order_mark)
            call leave_blanks(file%buffer, first, last)
            if (last < first) cycle
            if (file%buffer(first:first) == '#') then
                call append_comment(table, n_comments, &
                                    trim_blanks(file%buffer(first + 1:last)), file%line)
                cycle
            end if
            call take_cells(file%buffer(first:last), table, filled, n, file%line, status)
            if (status%code /= 0) return
            if (has_header) then
                call keep_row(table, filled, n, file%line, status)
            else
                call take_header(table, n, file%line, status)
                has_header = .true.
                filled = 0
            end if
            if (status%code /= 0) return
        end do
        table%comments = table%comments(:n_comments)
        table%comment_line = table%comment_line(:n_comments)
        if (.not. has_header) then
            call set_place_status(status, st_file_format, &
                                  'column names must be given, got none', '', &
                                  table%file, 0)
            return
        end if
        table%line = table%line(:table%n_rows)
    end subroutine read_rows

    !> Take one line as the names of the columns.
    subroutine take_names(table, line, number, status)
        type(csv_table_t), intent(inout) :: table !! of `start_table`
        character(len=*), intent(in) :: line      !! without blanks at its ends, not empty
        integer, intent(in) :: number             !! of the line
        type(status_t), intent(out) :: status     !! `st_file_format`: a name twice, an open quote
        integer :: n

        call clear_status(status)
        call take_cells(line, table, 0, n, number, status)
        if (status%code == 0) call take_header(table, n, number, status)
    end subroutine take_names

    !> Take one line as the table's only row, number 1, instead of the one before.
    subroutine take_only_row(table, line, number, status)
        type(csv_table_t), intent(inout) :: table !! with names
        character(len=*), intent(in) :: line      !! without blanks at its ends, not empty
        integer, intent(in) :: number             !! of the line
        type(status_t), intent(out) :: status     !! `st_file_format`: more or fewer cells than
                                                  !! names, an open quote
        integer :: n, filled

        call clear_status(status)
        table%n_rows = 0
        filled = 0
        call take_cells(line, table, filled, n, number, status)
        if (status%code == 0) call keep_row(table, filled, n, number, status)
    end subroutine take_only_row

    !> Leave out the blanks and tabulators at both ends of a range.
    pure subroutine leave_blanks(text, first, last)
        character(len=*), intent(in) :: text    !! all of it
        integer, intent(inout) :: first, last   !! the range; empty if there is nothing else

        do while (last >= first)
            if (text(last:last) /= ' ' .and. text(last:last) /= tab) exit
            last = last - 1
        end do
        do while (first < last)
            if (text(first:first) /= ' ' .and. text(first:first) /= tab) exit
            first = first + 1
        end do
    end subroutine leave_blanks

    pure subroutine append_comment(table, n, text, line)
        type(csv_table_t), intent(inout) :: table
        integer, intent(inout) :: n
        character(len=*), intent(in) :: text
        integer, intent(in) :: line
        type(csv_text_t), allocatable :: wider(:)
        integer, allocatable :: more_lines(:)

        if (n == size(table%comments)) then
            allocate (wider(2*n + 8), more_lines(2*n + 8))
            wider(:n) = table%comments
            more_lines(:n) = table%comment_line
            call move_alloc(wider, table%comments)
            call move_alloc(more_lines, table%comment_line)
        end if
        n = n + 1
        table%comments(n)%text = text
        table%comment_line(n) = line
    end subroutine append_comment

    ! The first `n` cells are the names.
    subroutine take_header(table, n, number, status)
        type(csv_table_t), intent(inout) :: table
        integer, intent(in) :: n, number
        type(status_t), intent(inout) :: status
        integer :: i, j

        deallocate (table%names)
        allocate (table%names(n))
        do i = 1, n
            table%names(i)%text = cell(table, i)
        end do
        do i = 2, n
            do j = 1, i - 1
                if (table%names(i)%text == table%names(j)%text) then
                    call set_place_status(status, st_file_format, 'column names must differ', &
                                          "'" // table%names(i)%text // "'", table%file, number)
                    return
                end if
            end do
        end do
        table%n_columns = n
    end subroutine take_header

    ! The `n` cells behind the `filled` ones of the rows so far are one more row.
    subroutine keep_row(table, filled, n, number, status)
        type(csv_table_t), intent(inout) :: table
        integer, intent(inout) :: filled
        integer, intent(in) :: n, number
        type(status_t), intent(inout) :: status
        integer, allocatable :: more_lines(:)

        if (n /= table%n_columns) then
            call refuse_width(table, filled, n, number, status)
            return
        end if
        filled = filled + n
        if (filled > most_cells) then
            call set_place_status(status, st_file_format, 'a table must have at most ' &
                                  // integer_text(most_cells) // ' cells', '', table%file, number)
            return
        end if
        if (table%n_rows == size(table%line)) then
            allocate (more_lines(2*table%n_rows + 64))
            more_lines(:table%n_rows) = table%line
            call move_alloc(more_lines, table%line)
        end if
        table%n_rows = table%n_rows + 1
        table%line(table%n_rows) = number
    end subroutine keep_row

    ! A row that is too short misses its last columns; one that is too long has cells without any.
    subroutine refuse_width(table, filled, n, number, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: filled, n, number
        type(status_t), intent(inout) :: status
        character(len=:), allocatable :: what, value

        what = 'a row must have ' // integer_text(table%n_columns) // ' cells as the column names'
        value = integer_text(n)
        if (n < table%n_columns) then
            value = value // ', none for the column ' // table%names(n + 1)%text
        else
            value = value // ', beyond the column ' // table%names(table%n_columns)%text &
                    // " '" // cell(table, filled + table%n_columns + 1) // "'"
        end if
        call set_place_status(status, st_file_format, what, value, table%file, number)
    end subroutine refuse_width

    ! Text number i.
    pure function cell(table, i) result(text)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: i
        character(len=table%end_of(i) - table%end_of(i - 1)) :: text

        text = table%text(table%end_of(i - 1) + 1:table%end_of(i))
    end function cell

    ! Put the `n` cells of a line behind `filled` others.
    subroutine take_cells(line, table, filled, n, number, status)
        character(len=*), intent(in) :: line
        type(csv_table_t), intent(inout) :: table
        integer, intent(in) :: filled
        integer, intent(out) :: n
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        integer :: i, start, first, last

        call make_room(table, filled, len(line))
        n = 0
        start = 1
        do i = 1, len(line) + 1
            if (i <= len(line)) then
                if (line(i:i) == '"') then
                    call take_quoted_cells(line, table, filled, n, number, status)
                    return
                end if
                if (line(i:i) /= ',') cycle
            end if
            first = start
            last = i - 1
            call leave_blanks(line, first, last)
            call put_cell(line(first:last), table, filled + n)
            n = n + 1
            start = i + 1
        end do
    end subroutine take_cells

    ! The same of a line with quotes.
    subroutine take_quoted_cells(line, table, filled, n, number, status)
        character(len=*), intent(in) :: line
        type(csv_table_t), intent(inout) :: table
        integer, intent(in) :: filled
        integer, intent(out) :: n
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        integer :: start, next
        character(len=:), allocatable :: text
        logical :: valid

        n = 0
        start = 1
        do
            call take_cell(line, start, text, next, valid)
            if (.not. valid) then
                call set_place_status(status, st_file_format, 'quotes must enclose all of ' &
                                      // 'cell ' // integer_text(n + 1), &
                                      trim_blanks(line(start:)), table%file, number)
                return
            end if
            call put_cell(text, table, filled + n)
            n = n + 1
            if (next > len(line)) exit
            start = next + 1
        end do
    end subroutine take_quoted_cells

    ! Room for the cells of a line behind `filled` others.
    subroutine make_room(table, filled, length)
        type(csv_table_t), intent(inout) :: table
        integer, intent(in) :: filled, length
        character(len=:), allocatable :: more_text
        integer, allocatable :: more_ends(:)
        integer :: used

        used = table%end_of(filled)
        if (used + length > len(table%text)) then
            allocate (character(len=2*len(table%text) + length) :: more_text)
            more_text(:used) = table%text(:used)
            call move_alloc(more_text, table%text)
        end if
        ! A line of so many characters has at most one cell more.
        if (filled + length + 1 > ubound(table%end_of, 1)) then
            allocate (more_ends(0:2*ubound(table%end_of, 1) + length + 1))
            more_ends(:filled) = table%end_of(:filled)
            call move_alloc(more_ends, table%end_of)
        end if
    end subroutine make_room

    ! Put a text behind `filled` others.
    pure subroutine put_cell(text, table, filled)
        character(len=*), intent(in) :: text
        type(csv_table_t), intent(inout) :: table
        integer, intent(in) :: filled

        associate (from => table%end_of(filled))
            table%text(from + 1:from + len(text)) = text
            table%end_of(filled + 1) = from + len(text)
        end associate
    end subroutine put_cell

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
            call set_place_status(status, st_file_format, &
                                  'missing column: ' // name, '', table%file, 0)
        end if
    end subroutine require_column

    !> The text of a cell; empty outside the table.
    pure function cell_text(table, row, column) result(text)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        integer, intent(in) :: column            !! 1 to n_columns
        character(len=cell_length(table, row, column)) :: text !! without quotes

        if (len(text) > 0) text = cell(table, (row - 1)*table%n_columns + column)
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
        call parse_cell(table, row, column, value, valid)
        if (.not. valid) then
            call set_place_status(status, st_file_format, &
                                  'a finite number must stand in column ' // &
                                  table%names(column)%text, &
                                  "'" // cell_text(table, row, column) // "'", &
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
        call parse_integer(cell_text(table, row, column), value, valid)
        if (.not. valid) then
            call set_place_status(status, st_file_format, &
                                  'a whole number must stand in column ' // &
                                  table%names(column)%text, &
                                  "'" // cell_text(table, row, column) // "'", &
                                  table%file, table%line(row))
        end if
    end subroutine cell_integer

    pure subroutine parse_cell(table, row, column, value, valid)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row, column
        real(wp), intent(out) :: value
        logical, intent(out) :: valid
        integer :: i

        i = (row - 1)*table%n_columns + column
        call parse_real(table%text(table%end_of(i - 1) + 1:table%end_of(i)), value, valid)
    end subroutine parse_cell

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

    !> The numbers of several columns, row by row up to the first cell that holds none.
    pure subroutine several_columns(table, columns, values, n, status)
        type(csv_table_t), intent(in) :: table          !! a table that was read
        integer, intent(in) :: columns(:)               !! their numbers, each 1 to n_columns
        real(wp), allocatable, intent(out) :: values(:, :) !! (row, column), the first `n` rows
                                                        !! count
        integer, intent(out) :: n                       !! rows before the first such cell
        type(status_t), intent(out) :: status           !! `st_file_format`
        logical :: valid
        integer :: row, i

        call clear_status(status)
        allocate (values(table%n_rows, size(columns)))
        n = 0
        do row = 1, table%n_rows
            do i = 1, size(columns)
                call parse_cell(table, row, columns(i), values(row, i), valid)
                if (valid) cycle
                call cell_number(table, row, columns(i), values(row, i), status)
                return
            end do
            n = row
        end do
    end subroutine several_columns
end module faststrip_files_csv_table
