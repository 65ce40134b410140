!> SHA-256 (FIPS 180-4): what tells a file from another one that has the same name and length.
!>
!> Written here because the libraries that have it are large and not everywhere; `sha256.c` is
!> tested against the published vectors.
module faststrip_files_sha256
    use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t
    implicit none
    private

    public :: sha256_t, sha256_start, sha256_add, sha256_digest, digest_length

    !> Length of a digest, hexadecimal digits.
    integer, parameter :: digest_length = 64

    !> The sum over bytes that are added one after the other.
    type, bind(c) :: sha256_t
        private
        integer(c_int32_t) :: state(8)
        integer(c_int64_t) :: length
        character(kind=c_char) :: block(64)
    end type sha256_t

    interface
        !> Begin anew, with no bytes.
        subroutine sha256_start(sum) bind(c, name='faststrip_sha256_start')
            import :: sha256_t
            type(sha256_t), intent(out) :: sum
        end subroutine sha256_start

        subroutine c_sha256_add(sum, bytes, n) bind(c, name='faststrip_sha256_add')
            import :: sha256_t, c_char, c_int64_t
            type(sha256_t), intent(inout) :: sum
            character(kind=c_char), intent(in) :: bytes(*)
            integer(c_int64_t), value :: n
        end subroutine c_sha256_add

        subroutine c_sha256_digest(sum, digest) bind(c, name='faststrip_sha256_digest')
            import :: sha256_t, c_char
            type(sha256_t), intent(in) :: sum
            character(kind=c_char), intent(out) :: digest(*)
        end subroutine c_sha256_digest
    end interface

contains

    !> Add bytes behind those before.
    subroutine sha256_add(sum, bytes)
        type(sha256_t), intent(inout) :: sum  !! that was started
        character(len=*), intent(in) :: bytes !! any

        call c_sha256_add(sum, bytes, len(bytes, c_int64_t))
    end subroutine sha256_add

    !> The digest of all bytes so far; more may be added.
    function sha256_digest(sum) result(digest)
        type(sha256_t), intent(in) :: sum !! that was started
        character(len=digest_length) :: digest

        call c_sha256_digest(sum, digest)
    end function sha256_digest
end module faststrip_files_sha256
