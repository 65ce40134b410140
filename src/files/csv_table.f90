!> Tables of comma-separated values as they are read, strictly; the dialect stands in
!> `faststrip_files_csv`.
module faststrip_files_csv_table
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_file_format
    use faststrip_base_text, only: trim_blanks, parse_real, parse_integer, integer_text, &
                                   lower_case, set_place_status
    use faststrip_files_column_names, only: is_nearly
    use faststrip_files_lines, only: text_file_t, open_text, close_text, find_line
    implicit none
    private

    public :: csv_text_t, csv_table_t
    public :: read_csv, column_index, require_column, cell_text, cell_number, cell_integer
    public :: read_cell, column_numbers, several_columns, refuse_misspelt
    public :: start_table, find_content, take_names, take_only_row, leave_blanks

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
        integer, private :: n_comments = 0            !! used of them while they are read
        ! What parts the cells; a blank stands for any number of blanks and tabulators.
        character(len=1), private :: separator = ','
        logical, private :: has_names = .false.       ! was there a line of names?
    end type csv_table_t

    ! More cells than this are no table, or have no end: 1 GB in memory with the texts.
    integer, parameter :: most_cells = 25000000

    character(len=1), parameter :: tab = achar(9)
    ! What may part cells; of those that stand in the line of names the first of these does.
    character(len=*), parameter :: separators = ',;' // tab // ' '
    ! A first line that begins so tells it, as spreadsheets write it.
    character(len=*), parameter :: separator_line = 'sep='

    !> What stands in the column of a name, unless there was an error before.
    interface read_cell
        module procedure read_number, read_integer, read_text
    end interface read_cell

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
        integer :: first, last, filled, n
        logical :: found

        filled = 0
        do
            call find_content(file, table, .true., first, last, found, status)
            if (status%code /= 0) return
            if (.not. found) exit
            if (table%has_names) then
                call take_cells(file%buffer(first:last), table, filled, n, file%line, status)
                if (status%code == 0) call keep_row(table, filled, n, file%line, status)
            else
                call take_names(table, file%buffer(first:last), file%line, status)
            end if
            if (status%code /= 0) return
        end do
        table%comments = table%comments(:table%n_comments)
        table%comment_line = table%comment_line(:table%n_comments)
        if (.not. table%has_names) then
            call set_place_status(status, st_file_format, &
                                  'column names must be given, got none', '', &
                                  table%file, 0)
            return
        end if
        table%line = table%line(:table%n_rows)
    end subroutine read_rows

    !> Find the next line that holds names or a row: one that is not empty, no comment, and not a
    !> first line like `sep=;`, which tells what parts the cells. Above the names `!` and `%` begin
    !> comments, too.
    subroutine find_content(file, table, keeps_comments, first, last, found, status)
        type(text_file_t), intent(inout) :: file  !! counts the lines
        type(csv_table_t), intent(inout) :: table !! of `start_table`, with names or without
        logical, intent(in) :: keeps_comments     !! are comments kept in the table?
        integer, intent(out) :: first, last       !! a range of `file%buffer`, without blanks at
                                                  !! its ends
        logical, intent(out) :: found             !! was there a line left?
        type(status_t), intent(inout) :: status   !! set if not all is well, as of `find_line`
        integer :: at

        do
            call find_line(file, first, last, found, status)
            if (status%code /= 0 .or. .not. found) return
            associate (buffer => file%buffer)
                call leave_blanks(buffer, first, last, keeps_tabs=table%separator == tab)
                if (verify(buffer(first:last), ' ' // tab) == 0) cycle
                if (buffer(first:first) /= '#') then
                    if (table%has_names) return
                    if (scan(buffer(first:first), '!%') == 0) then
                        if (.not. is_separator_line(file%line, buffer(first:last))) return
                        at = first + len(separator_line)
                        if (at == last) table%separator = buffer(at:at)
                        cycle
                    end if
                end if
                if (keeps_comments) call append_comment( &
                    table, trim_blanks(buffer(first + 1:last)), file%line)
            end associate
        end do
    end subroutine find_content

    ! Is it a first line that tells what parts the cells? Of a tabulator nothing is left.
    pure logical function is_separator_line(number, line)
        integer, intent(in) :: number
        character(len=*), intent(in) :: line

        is_separator_line = number == 1 .and. index(lower_case(line), separator_line) == 1 &
            .and. len(line) <= len(separator_line) + 1
        if (is_separator_line) &
            is_separator_line = verify(line(len(separator_line) + 1:), separators) == 0
    end function is_separator_line

    ! What parts the names in a line: the first of the separators that no quotes enclose.
    pure character(len=1) function separator_of(line)
        character(len=*), intent(in) :: line
        integer :: i, at, best
        logical :: is_quoted

        best = len(separators) + 1
        is_quoted = .false.
        do i = 1, len(line)
            if (line(i:i) == '"') is_quoted = .not. is_quoted
            at = index(separators, line(i:i))
            if (at > 0 .and. .not. is_quoted) best = min(best, at)
        end do
        if (best > len(separators)) best = 1
        separator_of = separators(best:best)
    end function separator_of

    !> Take one line as the names of the columns. What parts them parts the cells of all rows:
    !> commas, or semicolons, or tabulators, or blanks.
    subroutine take_names(table, line, number, status)
        type(csv_table_t), intent(inout) :: table !! of `start_table`
        character(len=*), intent(in) :: line      !! without blanks at its ends, not empty
        integer, intent(in) :: number             !! of the line
        type(status_t), intent(out) :: status     !! `st_file_format`: a name twice, an open quote
        integer :: n

        call clear_status(status)
        table%has_names = .true.
        if (table%separator == separators(1:1)) table%separator = separator_of(line)
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
    pure subroutine leave_blanks(text, first, last, keeps_tabs)
        character(len=*), intent(in) :: text    !! all of it
        integer, intent(inout) :: first, last   !! the range; empty if there is nothing else
        logical, intent(in), optional :: keeps_tabs !! are tabulators cells' ends, and stay?
        character(len=1) :: other

        other = tab
        if (present(keeps_tabs)) other = merge(' ', tab, keeps_tabs)
        do while (last >= first)
            if (text(last:last) /= ' ' .and. text(last:last) /= other) exit
            last = last - 1
        end do
        do while (first < last)
            if (text(first:first) /= ' ' .and. text(first:first) /= other) exit
            first = first + 1
        end do
    end subroutine leave_blanks

    pure subroutine append_comment(table, text, line)
        type(csv_table_t), intent(inout) :: table
        character(len=*), intent(in) :: text
        integer, intent(in) :: line
        type(csv_text_t), allocatable :: wider(:)
        integer, allocatable :: more_lines(:)

        associate (n => table%n_comments)
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
        end associate
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
                if (line(i:i) /= table%separator) then
                    if (table%separator /= ' ' .or. line(i:i) /= tab) cycle
                end if
            end if
            first = start
            last = i - 1
            start = i + 1
            call leave_blanks(line, first, last)
            if (last < first .and. table%separator == ' ') cycle
            call put_cell(line(first:last), table, filled + n)
            n = n + 1
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
            call take_cell(line, start, table%separator, text, next, valid)
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
            if (table%separator == ' ') start = next + verify(line(next:), ' ' // tab) - 1
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

    ! The cell that starts at a place of a line; `next` is the separator after it, or beyond the
    ! line.
    pure subroutine take_cell(line, start, separator, text, next, valid)
        character(len=*), intent(in) :: line
        integer, intent(in) :: start
        character(len=1), intent(in) :: separator
        character(len=:), allocatable, intent(out) :: text
        integer, intent(out) :: next
        logical, intent(out) :: valid
        integer :: i

        valid = .true.
        next = end_of_cell(start)
        text = trim_blanks(line(start:next - 1))
        if (index(text, '"') == 0) return

        valid = text(1:1) == '"'
        if (.not. valid) return
        i = start + index(line(start:), '"')
        text = ''
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
        next = end_of_cell(i + 1)
        valid = len(trim_blanks(line(i + 1:next - 1))) == 0

    contains

        ! The first separator from one place on.
        pure integer function end_of_cell(from) result(at)
            integer, intent(in) :: from

            at = 0
            if (separator == ' ') then
                at = scan(line(from:), ' ' // tab)
            else
                at = index(line(from:), separator)
            end if
            at = merge(from + at - 1, len(line) + 1, at > 0)
        end function end_of_cell
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

        character(len=:), allocatable :: got
        integer :: i

        call clear_status(status)
        column = column_index(table, name)
        if (column > 0) return
        got = ''
        do i = 1, table%n_columns
            if (table%n_columns == 1 .or. is_nearly(table%names(i)%text, name)) &
                got = table%names(i)%text
        end do
        call set_place_status(status, st_file_format, 'missing column: ' // name, got, &
                              table%file, 0)
    end subroutine require_column

    !> Refuse a column that has nearly the name of one that may be left out, and is: it would be
    !> taken for none.
    pure subroutine refuse_misspelt(table, name, known, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        character(len=*), intent(in) :: name     !! of a column that may be left out
        character(len=*), intent(in) :: known(:) !! names that mean something else
        type(status_t), intent(inout) :: status  !! `st_file_format`

        integer :: i

        if (status%code /= 0 .or. column_index(table, name) > 0) return
        do i = 1, table%n_columns
            if (any(known == table%names(i)%text)) cycle
            if (.not. is_nearly(table%names(i)%text, name)) cycle
            call set_place_status(status, st_file_format, 'a column must be named ' // name, &
                                  table%names(i)%text, table%file, 0)
            return
        end do
    end subroutine refuse_misspelt

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
        if (valid) return
        if (has_decimal_comma(cell_text(table, row, column))) then
            call set_place_status(status, st_file_format, 'a number must have a point for its ' // &
                                  'decimals, not a comma, in column ' // &
                                  table%names(column)%text, &
                                  "'" // cell_text(table, row, column) // "'", &
                                  table%file, table%line(row))
        else
            call set_place_status(status, st_file_format, &
                                  'a finite number must stand in column ' // &
                                  table%names(column)%text, &
                                  "'" // cell_text(table, row, column) // "'", &
                                  table%file, table%line(row))
        end if
    end subroutine cell_number

    ! Is a text a number but for a comma instead of its point?
    pure logical function has_decimal_comma(text) result(has)
        character(len=*), intent(in) :: text
        real(wp) :: value
        integer :: i

        i = index(text, ',')
        has = i > 0
        if (has) call parse_real(text(:i - 1) // '.' // text(i + 1:), value, has)
    end function has_decimal_comma

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

    pure subroutine read_number(table, row, name, value, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        character(len=*), intent(in) :: name     !! of the column
        real(wp), intent(inout) :: value         !! 0 where the cell holds none
        type(status_t), intent(inout) :: status  !! `st_bad_argument`, `st_file_format`
        integer :: column

        if (status%code /= 0) return
        call require_column(table, name, column, status)
        if (status%code == 0) call cell_number(table, row, column, value, status)
    end subroutine read_number

    pure subroutine read_integer(table, row, name, value, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        character(len=*), intent(in) :: name     !! of the column
        integer, intent(inout) :: value          !! 0 where the cell holds none
        type(status_t), intent(inout) :: status  !! `st_bad_argument`, `st_file_format`
        integer :: column

        if (status%code /= 0) return
        call require_column(table, name, column, status)
        if (status%code == 0) call cell_integer(table, row, column, value, status)
    end subroutine read_integer

    pure subroutine read_text(table, row, name, text, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! 1 to n_rows
        character(len=*), intent(in) :: name     !! of the column
        character(len=:), allocatable, intent(inout) :: text !! of the cell
        type(status_t), intent(inout) :: status  !! `st_file_format`
        integer :: column

        if (status%code /= 0) return
        call require_column(table, name, column, status)
        if (status%code == 0) text = cell_text(table, row, column)
    end subroutine read_text

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
