!> Tables of comma-separated values as they are read, strictly; the dialect stands in
!> `faststrip_files_csv`.
module faststrip_files_csv_table
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, parse_integer, integer_text, &
                                   set_place_status
    use faststrip_files_lines, only: text_file_t, open_text, close_text, read_line
    implicit none
    private

    public :: csv_text_t, csv_table_t
    public :: read_csv, column_index, require_column, cell_text, cell_number, cell_integer
    public :: column_numbers

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
        integer, allocatable :: comment_line(:)       !! line of the file each stands on
    end type csv_table_t

    ! More cells than this are no table, or have no end: 1 GB in memory.
    integer, parameter :: most_cells = 25000000

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
        allocate (table%comment_line(0))
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
                call append_comment(table, n_comments, trim_blanks(line(2:)), file%line)
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
        table%comment_line = table%comment_line(:n_comments)
        if (.not. has_header) then
            call set_place_status(status, st_file_format, &
                                  'column names must be given, got none', '', &
                                  table%file, 0)
            return
        end if
        table%cells = table%cells(:, :table%n_rows)
        table%line = table%line(:table%n_rows)
    end subroutine read_rows

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

    subroutine take_header(table, cells, number, status)
        type(csv_table_t), intent(inout) :: table
        type(csv_text_t), intent(in) :: cells(:)
        integer, intent(in) :: number
        type(status_t), intent(inout) :: status
        integer :: i, j

        do i = 2, size(cells)
            do j = 1, i - 1
                if (cells(i)%text == cells(j)%text) then
                    call set_place_status(status, st_file_format, 'column names must differ', &
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
            call set_place_status(status, st_file_format, 'a table must have at most ' &
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

        what = 'a row must have ' // integer_text(table%n_columns) // ' cells as the column names'
        value = integer_text(size(cells))
        if (size(cells) < table%n_columns) then
            value = value // ', none for the column ' // table%names(size(cells) + 1)%text
        else
            value = value // ', beyond the column ' // table%names(table%n_columns)%text &
                    // " '" // cells(table%n_columns + 1)%text // "'"
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
                    call set_place_status(status, st_file_format, 'quotes must enclose all of ' &
                                          // 'cell ' // integer_text(n), &
                                          trim_blanks(line(start:)), file, number)
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
            call set_place_status(status, st_file_format, &
                                  'missing column: ' // name, '', table%file, 0)
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
            call set_place_status(status, st_file_format, &
                                  'a finite number must stand in column ' // &
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
            call set_place_status(status, st_file_format, &
                                  'a whole number must stand in column ' // &
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
end module faststrip_files_csv_table
