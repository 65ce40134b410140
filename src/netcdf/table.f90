!> A CSV file written anew as NetCDF-4, with the conventions for climate and forecast data (CF), in
!> little memory for any number of rows: it is read twice, first for what its columns hold.
module faststrip_netcdf_table
    use, intrinsic :: iso_c_binding, only: c_int
    use faststrip_base_status, only: status_t, is_error, st_file_format
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_files_columns, only: holds_text, is_variable_name
    use faststrip_files_csv_stream, only: csv_stream_t, open_stream, find_row, close_stream
    use faststrip_files_csv_table, only: cell_text, take_only_row, leave_blanks
    use faststrip_files_lines, only: text_file_t, open_text, find_line, close_text
    use faststrip_netcdf_columns, only: table_column_t, make_column, look_at, settle, &
                                        reserve_rows, keep_cell
    use faststrip_netcdf_file, only: netcdf_file_t, create_netcdf, put_attribute, &
                                     define_columns, put_rows, close_netcdf
    implicit none
    private

    public :: conversion_t, progress_told, write_table

    !> What is to be written.
    type :: conversion_t
        character(len=:), allocatable :: source  !! the CSV file
        character(len=:), allocatable :: called  !! what messages on its cells call it
        character(len=:), allocatable :: target  !! the file to be made, which must not be there
        character(len=:), allocatable :: name    !! what messages call that
        character(len=:), allocatable :: writer  !! name, version and revision of the program
        logical :: is_single = .false.           !! numbers in single precision?
    end type conversion_t

    abstract interface
        !> How far it is.
        subroutine progress_told(rows, total) bind(c)
            import :: c_int
            integer(c_int), value :: rows  !! read, or written
            integer(c_int), value :: total !! 0 if not yet known
        end subroutine progress_told
    end interface

    ! Tuned [1, bytes]: rows at a time, if the texts of so many are no longer than this. Origin:
    ! measured: half as many make the file 2.4 % larger, four times as many 0.5 % smaller.
    integer, parameter :: most_rows = 8192, most_text = 4194304

    character(len=*), parameter :: conventions = 'CF-1.8'
    character(len=*), parameter :: revision_mark = ' rev '

contains

    !> Write the file.
    subroutine write_table(what, progress, words, status)
        type(conversion_t), intent(in) :: what              !! from where to where
        procedure(progress_told) :: progress                !! called now and then
        character(len=:), allocatable, intent(out) :: words !! on cells left out; empty: none were
        type(status_t), intent(out) :: status               !! those of the CSV reader;
                                                            !! `st_file_format`: a name that is
                                                            !! none for a variable, a number beyond
                                                            !! single precision; `st_file_write`

        type(table_column_t), allocatable :: columns(:)
        type(netcdf_file_t) :: file
        type(status_t) :: closing
        character(len=:), allocatable :: comments
        integer :: n_rows, n_at_once

        words = ''
        call read_comments(what%source, comments, status)
        if (.not. is_error(status)) call look_at_rows(what, progress, columns, n_rows, status)
        if (is_error(status)) return
        n_at_once = max(min(n_rows, most_rows, &
                            most_text/max(sum(columns%longest, columns%holds == holds_text), 1)), 1)
        call create_netcdf(file, what%target, what%name, what%is_single, status)
        call describe_table(file, what, comments)
        if (.not. is_error(status)) call define_columns(file, columns, n_at_once, status)
        if (.not. is_error(status)) &
            call copy_rows(what%source, progress, n_rows, n_at_once, columns, file, status)
        call close_netcdf(file, closing)
        if (.not. is_error(status)) status = closing
        words = words_of_refused(what%called, columns)
    end subroutine write_table

    ! The comment lines above the names of the columns, parted by line feeds.
    subroutine read_comments(path, comments, status)
        character(len=*), intent(in) :: path
        character(len=:), allocatable, intent(out) :: comments
        type(status_t), intent(out) :: status

        type(text_file_t) :: file
        integer :: first, last
        logical :: found

        comments = ''
        call open_text(path, file, status)
        if (is_error(status)) return
        do
            call find_line(file, first, last, found, status)
            if (is_error(status) .or. .not. found) exit
            call leave_blanks(file%buffer, first, last)
            if (last < first) cycle
            if (file%buffer(first:first) /= '#') exit
            first = first + 1
            call leave_blanks(file%buffer, first, last)
            if (len(comments) > 0) comments = comments // new_line('a')
            comments = comments // file%buffer(first:last)
        end do
        call close_text(file)
    end subroutine read_comments

    ! The first reading: how many rows there are, and what the columns hold.
    subroutine look_at_rows(what, progress, columns, n_rows, status)
        type(conversion_t), intent(in) :: what
        procedure(progress_told) :: progress
        type(table_column_t), allocatable, intent(out) :: columns(:)
        integer, intent(out) :: n_rows
        type(status_t), intent(out) :: status

        type(csv_stream_t) :: stream
        integer :: i
        logical :: found

        n_rows = 0
        call open_stream(what%source, stream, status)
        if (is_error(status)) return
        allocate (columns(stream%table%n_columns))
        do i = 1, size(columns)
            associate (name => stream%table%names(i)%text)
                if (.not. is_variable_name(name)) &
                    call set_place_status(status, st_file_format, 'a column must have a name ' &
                                          // 'that NetCDF takes', "'" // name // "'", &
                                          what%called, stream%file%line)
                call make_column(name, columns(i))
            end associate
        end do
        do while (.not. is_error(status))
            call next_row(stream, found, status)
            if (is_error(status) .or. .not. found) exit
            n_rows = n_rows + 1
            do i = 1, size(columns)
                call look_at(columns(i), cell_text(stream%table, 1, i), stream%file%line)
            end do
            if (modulo(n_rows, most_rows) == 0) call progress(int(n_rows, c_int), 0_c_int)
        end do
        call close_stream(stream)
        do i = 1, size(columns)
            call settle(columns(i))
            if (is_error(status) .or. .not. what%is_single) cycle
            if (columns(i)%large_line > 0) &
                call set_place_status(status, st_file_format, 'a number must be within single ' &
                                      // 'precision in column ' // columns(i)%name, '', &
                                      what%called, columns(i)%large_line)
        end do
    end subroutine look_at_rows

    ! The second reading.
    subroutine copy_rows(path, progress, n_rows, n_at_once, columns, file, status)
        character(len=*), intent(in) :: path
        procedure(progress_told) :: progress
        integer, intent(in) :: n_rows, n_at_once
        type(table_column_t), intent(inout) :: columns(:)
        type(netcdf_file_t), intent(inout) :: file
        type(status_t), intent(out) :: status

        type(csv_stream_t) :: stream
        integer :: i, row, n
        logical :: found

        call open_stream(path, stream, status)
        if (is_error(status)) return
        do i = 1, size(columns)
            call reserve_rows(columns(i), n_at_once)
        end do
        do row = 1, n_rows
            call next_row(stream, found, status)
            if (is_error(status)) exit
            if (.not. found .or. stream%table%n_columns /= size(columns)) then
                call set_place_status(status, st_file_format, 'the file has changed', '', path, 0)
                exit
            end if
            n = modulo(row - 1, n_at_once) + 1
            do i = 1, size(columns)
                call keep_cell(columns(i), n, cell_text(stream%table, 1, i))
            end do
            if (n < n_at_once .and. row < n_rows) cycle
            call put_rows(file, columns, n, status)
            if (is_error(status)) exit
            call progress(int(row, c_int), int(n_rows, c_int))
        end do
        call close_stream(stream)
    end subroutine copy_rows

    ! Take the next row of a table.
    subroutine next_row(stream, found, status)
        type(csv_stream_t), intent(inout) :: stream
        logical, intent(out) :: found
        type(status_t), intent(out) :: status

        integer :: first, last

        call find_row(stream, first, last, found, status)
        if (found .and. .not. is_error(status)) &
            call take_only_row(stream%table, stream%file%buffer(first:last), stream%file%line, &
                               status)
    end subroutine next_row

    ! The attributes of the whole file. The time is left out: the same table is the same file.
    subroutine describe_table(file, what, comments)
        type(netcdf_file_t), intent(inout) :: file
        type(conversion_t), intent(in) :: what
        character(len=*), intent(in) :: comments

        character(len=:), allocatable :: source
        integer :: mark

        source = comments(:index(comments // new_line('a'), new_line('a')) - 1)
        mark = index(source, revision_mark)
        call put_attribute(file, 'Conventions', conventions)
        call put_attribute(file, 'title', 'table of wheel/rail contact')
        if (mark > 0) then
            call put_attribute(file, 'source', source)
            call put_attribute(file, 'revision', source(mark + len(revision_mark):))
        end if
        call put_attribute(file, 'history', 'written as NetCDF by ' // what%writer)
        if (len(comments) > 0) call put_attribute(file, 'comment', comments)
    end subroutine describe_table

    ! What is to be said about cells that hold no number where one must stand.
    function words_of_refused(path, columns) result(words)
        character(len=*), intent(in) :: path
        type(table_column_t), intent(in) :: columns(:)
        character(len=:), allocatable :: words

        type(status_t) :: status
        integer :: i

        words = ''
        do i = 1, size(columns)
            associate (column => columns(i))
                if (column%n_refused == 0) cycle
                call set_place_status(status, st_file_format, 'left out: ' &
                                      // integer_text(sum(columns%n_refused)) // ' cells that ' &
                                      // 'are no numbers, first in column ' // column%name, &
                                      "'" // column%refused // "'", path, column%refused_line)
                words = trim(status%message)
                return
            end associate
        end do
    end function words_of_refused
end module faststrip_netcdf_table
