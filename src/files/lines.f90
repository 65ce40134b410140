!> Lines of text files, read strictly.
module faststrip_files_lines
    use, intrinsic :: iso_fortran_env, only: iostat_end, iostat_eor
    use faststrip_base_status, only: status_t, set_status, clear_status, st_file_missing, &
                                     st_file_format
    use faststrip_base_text, only: integer_text, set_place_status
    implicit none
    private

    public :: text_file_t, open_text, read_line, close_text, is_folder
    public :: longest_line, most_lines, most_bytes

    ! What is longer has no end, or is no table: the longest table the program writes itself has a
    ! row for each of a million random gaps.
    integer, parameter :: longest_line = 65536    !! characters
    integer, parameter :: most_lines = 1200000    !! of a file
    integer, parameter :: most_bytes = 268435456  !! of a file

    !> A text file being read.
    type :: text_file_t
        integer :: unit = 0                   !! the Fortran unit
        character(len=:), allocatable :: path !! its name
        integer :: line = 0                   !! number of the line read last
        integer :: bytes = 0                  !! read so far
    end type text_file_t

    character(len=1), parameter :: carriage_return = achar(13)

contains

    !> Open a text file for reading.
    subroutine open_text(path, file, status)
        character(len=*), intent(in) :: path    !! name of the file
        type(text_file_t), intent(out) :: file  !! to be closed by `close_text` if all is well
        type(status_t), intent(out) :: status   !! `st_file_missing`: not there, a folder, or not
                                                !! readable
        character(len=200) :: words
        logical :: exists
        integer :: code

        call clear_status(status)
        file%path = path
        exists = .false.
        if (len_trim(path) > 0) inquire (file=path, exist=exists)
        if (.not. exists) then
            call set_status(status, st_file_missing, 'no such file: ' // path)
        else if (is_folder(path)) then
            call set_status(status, st_file_missing, 'a folder, not a file: ' // path)
        else
            open (newunit=file%unit, file=path, status='old', action='read', form='formatted', &
                  iostat=code, iomsg=words)
            if (code == 0) return
            call set_status(status, st_file_missing, 'cannot read the file: ' // path)
            if (index(words, 'Permission denied') > 0) status%message = &
                trim(status%message) // ': permission denied'
        end if
    end subroutine open_text

    !> Close a file.
    subroutine close_text(file)
        type(text_file_t), intent(inout) :: file !! opened by `open_text`

        close (file%unit)
    end subroutine close_text

    !> Is there a folder of that name?
    logical function is_folder(path)
        character(len=*), intent(in) :: path !! a name

        inquire (file=path // '/.', exist=is_folder)
    end function is_folder

    !> The next line of a file without its line end (LF or CRLF).
    subroutine read_line(file, line, found, status)
        type(text_file_t), intent(inout) :: file            !! counts the lines
        character(len=:), allocatable, intent(out) :: line  !! the line; empty at the end
        logical, intent(out) :: found                       !! was there a line left?
        type(status_t), intent(out) :: status               !! `st_file_format`: reading failed,
                                                            !! or there is too much to read
        character(len=4096) :: chunk
        integer :: code, length

        line = ''
        found = .false.
        call clear_status(status)
        do
            read (file%unit, '(a)', advance='no', size=length, iostat=code) chunk
            if (code == 0) length = len(chunk)
            if (code == 0 .or. code == iostat_eor) then
                if (.not. found) file%line = file%line + 1
                found = .true.
                line = line // chunk(:length)
                if (len(line) > longest_line) call refuse('a line must have at most ' &
                    // integer_text(longest_line) // ' characters')
                if (code == 0 .and. status%code == 0) cycle
            else if (code /= iostat_end) then
                file%line = file%line + 1
                call refuse('cannot read on')
            end if
            exit
        end do
        file%bytes = file%bytes + len(line) + 1
        if (file%line > most_lines) then
            call refuse('a file must have at most ' // integer_text(most_lines) // ' lines')
        else if (file%bytes > most_bytes) then
            call refuse('a file must have at most ' // integer_text(most_bytes/1048576) // ' MB')
        end if
        length = len(line)
        if (length > 0) then
            if (line(length:) == carriage_return) line = line(:length - 1)
        end if

    contains

        subroutine refuse(what)
            character(len=*), intent(in) :: what

            call set_place_status(status, st_file_format, what, '', file%path, file%line)
        end subroutine refuse
    end subroutine read_line
end module faststrip_files_lines
