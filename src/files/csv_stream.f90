!> Tables of comma-separated values read row by row, however long they are: nothing but a buffer is
!> in memory. The dialect stands in `faststrip_files_csv`; a line that is no row is reported as
!> `read_csv` tells it.
module faststrip_files_csv_stream
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: set_place_status
    use faststrip_files_csv_table, only: csv_table_t, start_table, find_content, take_names, &
                                         take_only_row
    use faststrip_files_lines, only: text_file_t, open_text, close_text, place_t, &
                                     place_in, go_to_place, count_anew
    use faststrip_files_sha256, only: sha256_start, sha256_digest, digest_length
    implicit none
    private

    public :: csv_stream_t, row_place_t, csv_scan_t
    public :: open_stream, find_row, row_place, go_to_row, close_stream, scan_csv, find_row_place

    !> Between two rows of a file.
    type :: row_place_t
        integer(int64) :: row = 0 !! rows before it
        type(place_t) :: place    !! where its line begins, or comments above it
    end type row_place_t

    !> A table being read.
    type :: csv_stream_t
        type(csv_table_t) :: table     !! names of the columns, no rows
        type(text_file_t) :: file      !! its buffer holds the row, its line counts
        integer(int64) :: row = 0      !! number of the row found last
    end type csv_stream_t

    ! Tuned [places]: of rows that are kept. Origin: chosen: memory of a few kilobytes, and to find
    ! a row takes no longer than a thousandth of the file does.
    integer, parameter :: most_places = 2048

    !> What there is in a file that was read once.
    type :: csv_scan_t
        integer(int64) :: rows = 0                    !! rows, all of them well-formed
        character(len=digest_length) :: digest = ''   !! SHA-256 of the file
        integer(int64), private :: stride = 1         ! rows from one place to the next
        integer, private :: n = 0
        type(row_place_t), private :: places(most_places)
    end type csv_scan_t

contains

    !> Open a file and read on to the names of its columns.
    subroutine open_stream(path, stream, status)
        character(len=*), intent(in) :: path       !! name of the file, or of a pipe
        type(csv_stream_t), intent(out) :: stream  !! to be closed by `close_stream` if all is well
        type(status_t), intent(out) :: status      !! those of `read_csv`

        call open_and_hash(path, .false., stream, status)
    end subroutine open_stream

    subroutine open_and_hash(path, is_hashed, stream, status)
        character(len=*), intent(in) :: path
        logical, intent(in) :: is_hashed
        type(csv_stream_t), intent(inout) :: stream
        type(status_t), intent(out) :: status
        integer :: first, last
        logical :: found

        call start_table(path, stream%table)
        call open_text(path, stream%file, status)
        if (is_error(status)) return
        stream%file%is_hashed = is_hashed
        if (is_hashed) call sha256_start(stream%file%hash)
        call find_content(stream%file, stream%table, .false., first, last, found, status)
        if (.not. is_error(status)) then
            if (found) then
                call take_names(stream%table, stream%file%buffer(first:last), stream%file%line, &
                                status)
            else
                call set_place_status(status, st_file_format, &
                                      'column names must be given, got none', '', path, 0)
            end if
        end if
        if (is_error(status)) call close_text(stream%file)
        stream%file%without = ' without a row'
    end subroutine open_and_hash

    !> Find the next row: a range of `stream%file%buffer`, until the next call. Its cells are not
    !> yet looked at; `take_only_row` does.
    subroutine find_row(stream, first, last, found, status)
        type(csv_stream_t), intent(inout) :: stream !! counts the rows
        integer, intent(out) :: first, last         !! without blanks at its ends
        logical, intent(out) :: found               !! was there a row left?
        type(status_t), intent(out) :: status       !! `st_file_format`: reading failed, or there
                                                    !! are too many lines without a row

        call clear_status(status)
        call find_content(stream%file, stream%table, .false., first, last, found, status)
        if (is_error(status) .or. .not. found) return
        call count_anew(stream%file)
        stream%row = stream%row + 1
    end subroutine find_row

    !> Where the next row is read from.
    pure type(row_place_t) function row_place(stream)
        type(csv_stream_t), intent(in) :: stream !! an open one

        row_place = row_place_t(stream%row, place_in(stream%file))
    end function row_place

    !> Read on from a place between two rows of a file.
    subroutine go_to_row(stream, place, status)
        type(csv_stream_t), intent(inout) :: stream !! an open one of that file
        type(row_place_t), intent(in) :: place      !! of `row_place`
        type(status_t), intent(out) :: status       !! `st_file_format`

        call go_to_place(stream%file, place%place, status)
        stream%row = place%row
    end subroutine go_to_row

    !> Close the file.
    subroutine close_stream(stream)
        type(csv_stream_t), intent(inout) :: stream !! of `open_stream`

        call close_text(stream%file)
    end subroutine close_stream

    !> Read a file once: count its rows, check that each has as many cells as there are names, and
    !> find what tells it from other files.
    subroutine scan_csv(path, scan, status)
        character(len=*), intent(in) :: path    !! of a file that can be read again
        type(csv_scan_t), intent(out) :: scan   !! what there is
        type(status_t), intent(out) :: status   !! those of `read_csv`
        type(csv_stream_t) :: stream
        type(row_place_t) :: place
        integer :: first, last
        logical :: found

        call open_and_hash(path, .true., stream, status)
        if (is_error(status)) return
        do
            place = row_place(stream)
            call find_row(stream, first, last, found, status)
            if (is_error(status) .or. .not. found) exit
            call keep_place(scan, place)
            call take_only_row(stream%table, stream%file%buffer(first:last), stream%file%line, &
                               status)
            if (is_error(status)) exit
        end do
        scan%rows = stream%row
        scan%digest = sha256_digest(stream%file%hash)
        call close_stream(stream)
    end subroutine scan_csv

    ! Keep a place if it is one stride behind the last; if there are too many, every second goes.
    pure subroutine keep_place(scan, place)
        type(csv_scan_t), intent(inout) :: scan
        type(row_place_t), intent(in) :: place

        if (modulo(place%row, scan%stride) /= 0) return
        if (scan%n == most_places) then
            scan%n = most_places/2
            scan%places(:scan%n) = scan%places(1:most_places:2)
            scan%stride = 2*scan%stride
            if (modulo(place%row, scan%stride) /= 0) return
        end if
        scan%n = scan%n + 1
        scan%places(scan%n) = place
    end subroutine keep_place

    !> The place before a row of a file that was scanned.
    subroutine find_row_place(scan, stream, row, place, status)
        type(csv_scan_t), intent(in) :: scan        !! of the file
        type(csv_stream_t), intent(inout) :: stream !! of the file; is there afterwards
        integer(int64), intent(in) :: row           !! 1 to `scan%rows` + 1
        type(row_place_t), intent(out) :: place     !! before it
        type(status_t), intent(out) :: status       !! `st_file_format`
        integer :: first, last
        logical :: found

        call clear_status(status)
        if (scan%n > 0) then
            place = scan%places(min(int((row - 1)/scan%stride, kind(first)) + 1, scan%n))
            call go_to_row(stream, place, status)
        end if
        do while (stream%row < row - 1 .and. .not. is_error(status))
            call find_row(stream, first, last, found, status)
            if (.not. (found .or. is_error(status))) &
                call set_place_status(status, st_file_format, 'the file has changed', '', &
                                      stream%file%path, stream%file%line)
        end do
        place = row_place(stream)
    end subroutine find_row_place
end module faststrip_files_csv_stream
