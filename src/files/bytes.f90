!> Files of bytes, read and written whole.
module faststrip_files_bytes
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_loc, c_null_char, &
                                           c_null_ptr, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: int8, int64
    use faststrip_base_status, only: status_t, set_status, clear_status, st_file_missing, &
                                     st_file_write
    use faststrip_files_lines, only: is_folder
    use faststrip_files_stdio, only: c_open_input, c_fopen, c_fclose, c_ferror, c_rename, &
                                     c_remove
    use faststrip_files_temporary, only: most_temporaries, name_temporary, find_final_path
    implicit none
    private

    public :: read_bytes, write_bytes, remove_file

    ! Numbers in memory, as bytes; of text alone there are other ones.
    interface
        function c_fread_bytes(to, size, count, stream) bind(c, name='fread') result(n)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: to
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: n
        end function c_fread_bytes

        function c_fwrite_bytes(from, size, count, stream) bind(c, name='fwrite') result(n)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: from
            integer(c_size_t), value :: size, count
            type(c_ptr), value :: stream
            integer(c_size_t) :: n
        end function c_fwrite_bytes
    end interface

    ! Tuned [bytes]: the largest file. Origin: safeguard.
    integer(int64), parameter :: most_bytes = 2000000000_int64

contains

    !> Read a file.
    subroutine read_bytes(path, bytes, status)
        character(len=*), intent(in) :: path                        !! name of the file
        integer(int8), allocatable, target, intent(out) :: bytes(:) !! all of it
        type(status_t), intent(out) :: status
            !! `st_file_missing`: not there, a folder, not readable, above 2 GB

        type(c_ptr) :: stream
        integer(int64) :: length
        integer(c_size_t) :: n
        integer :: failure
        logical :: exists

        call clear_status(status)
        exists = .false.
        length = 0
        if (len_trim(path) > 0) inquire (file=path, exist=exists, size=length)
        if (.not. exists) then
            call set_status(status, st_file_missing, 'no such file: ' // path)
        else if (is_folder(path)) then
            call set_status(status, st_file_missing, 'a folder, not a file: ' // path)
        else if (length > most_bytes) then
            call set_status(status, st_file_missing, 'a file too large to be read: ' // path)
        end if
        if (status%code /= 0) return
        stream = c_open_input(trim(path) // c_null_char)
        allocate (bytes(max(length, 0_int64)), stat=failure)
        n = 0
        if (c_associated(stream) .and. failure == 0) then
            if (length > 0) n = c_fread_bytes(c_loc(bytes), 1_c_size_t, int(length, c_size_t), &
                                              stream)
            if (c_ferror(stream) /= 0) n = 0
        end if
        if (c_associated(stream)) failure = c_fclose(stream)
        if (.not. c_associated(stream) .or. n < length) &
            call set_status(status, st_file_missing, 'cannot read the file: ' // path)
    end subroutine read_bytes

    !> Remove a file, if there is one.
    subroutine remove_file(path)
        character(len=*), intent(in) :: path !! name of the file

        integer(c_int) :: ignored

        if (len_trim(path) > 0) ignored = c_remove(trim(path) // c_null_char)
    end subroutine remove_file

    !> Write a file: either the whole new one is left, or the old one. What is no ordinary file
    !> (`/dev/...`) is written directly.
    subroutine write_bytes(path, bytes, status)
        character(len=*), intent(in) :: path           !! name of the file
        integer(int8), target, contiguous, intent(in) :: bytes(:) !! all of it
        type(status_t), intent(out) :: status          !! `st_file_write`

        type(c_ptr) :: stream
        character(len=:), allocatable :: temporary, final
        integer(c_size_t) :: n
        integer(c_int) :: code
        integer :: number

        call clear_status(status)
        temporary = ''
        if (len_trim(path) == 0 .or. is_folder(path)) then
            call set_status(status, st_file_write, 'cannot write the file: ' // path)
            return
        end if
        stream = c_null_ptr
        final = path
        if (index(path, '/dev/') /= 1) call find_final_path(path, final)
        if (index(final, '/dev/') == 1) then
            stream = c_fopen(final // c_null_char, 'w' // c_null_char)
        else
            do number = 1, most_temporaries
                call name_temporary(path, number, temporary)
                stream = c_fopen(temporary // c_null_char, 'wx' // c_null_char)
                if (c_associated(stream)) exit
            end do
        end if
        if (.not. c_associated(stream)) then
            call set_status(status, st_file_write, 'cannot write the file: ' // path)
            return
        end if
        n = c_fwrite_bytes(c_loc(bytes), 1_c_size_t, int(size(bytes), c_size_t), stream)
        code = c_fclose(stream)
        if (code == 0 .and. n == size(bytes) .and. len(temporary) > 0) &
            code = c_rename(temporary // c_null_char, final // c_null_char)
        if (code == 0 .and. n == size(bytes)) return
        if (len(temporary) > 0) code = c_remove(temporary // c_null_char)
        call set_status(status, st_file_write, 'cannot write the file: ' // path)
    end subroutine write_bytes
end module faststrip_files_bytes
