!> What tells files from each other: SHA-256 of all their bytes, or of the first ones.
module faststrip_files_digest
    use, intrinsic :: iso_c_binding, only: c_associated, c_null_char, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_files_sha256, only: sha256_t, sha256_start, sha256_add, sha256_digest, &
                                      digest_length
    use faststrip_files_stdio, only: c_open_input, c_fread, c_ferror, c_fclose
    implicit none
    private

    public :: digest_of_file, hash_file, digest_length

contains

    !> SHA-256 of a whole file in hexadecimal digits; empty if it cannot be read.
    function digest_of_file(path) result(digest)
        character(len=*), intent(in) :: path !! name of the file
        character(len=digest_length) :: digest !! blank if it cannot be read
        type(sha256_t) :: hash
        logical :: is_read

        call hash_file(path, huge(0_int64), hash, is_read)
        digest = ''
        if (is_read) digest = sha256_digest(hash)
    end function digest_of_file

    !> Add up a file, or its beginning.
    subroutine hash_file(path, bytes, hash, is_read, found)
        character(len=*), intent(in) :: path   !! name of the file
        integer(int64), intent(in) :: bytes    !! of them, at most
        type(sha256_t), intent(out) :: hash    !! the sum; more may be added
        logical, intent(out) :: is_read        !! could it be read?
        integer(int64), intent(out), optional :: found !! bytes that were added

        ! Tuned [characters]: read at once. Origin: chosen.
        integer, parameter :: most = 65536
        character(len=:), allocatable :: piece
        type(c_ptr) :: stream
        integer(c_size_t) :: n
        integer(int64) :: done

        call sha256_start(hash)
        done = 0
        if (present(found)) found = 0
        stream = c_open_input(path // c_null_char)
        is_read = c_associated(stream)
        if (.not. is_read) return
        allocate (character(len=most) :: piece)
        do while (done < bytes)
            n = c_fread(piece, 1_c_size_t, int(min(bytes - done, int(most, int64)), c_size_t), &
                        stream)
            if (n == 0) exit
            call sha256_add(hash, piece(:n))
            done = done + n
        end do
        is_read = c_ferror(stream) == 0
        if (c_fclose(stream) /= 0) is_read = .false.
        if (present(found)) found = done
    end subroutine hash_file
end module faststrip_files_digest
