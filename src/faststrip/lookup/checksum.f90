!> The checksum of a lookup table's bytes: CRC-32 as of IEEE 802.3, zip and PNG (reflected
!> polynomial EDB88320). It tells every change of one byte, and every burst of up to four.
module faststrip_lookup_checksum
    use, intrinsic :: iso_fortran_env, only: int8, int32
    implicit none
    private

    public :: crc32

    ! Given: the polynomial of IEEE 802.3, its bits reversed.
    integer(int32), parameter :: polynomial = int(z'6DB88320', int32) - huge(0_int32) - 1

contains

    !> CRC-32 of bytes.
    pure integer(int32) function crc32(bytes)
        integer(int8), intent(in) :: bytes(:) !! any

        integer(int32) :: steps(0:255)
        integer :: i, k

        do i = 0, 255
            steps(i) = int(i, int32)
            do k = 1, 8
                if (btest(steps(i), 0)) then
                    steps(i) = ieor(ishft(steps(i), -1), polynomial)
                else
                    steps(i) = ishft(steps(i), -1)
                end if
            end do
        end do
        crc32 = not(0_int32)
        do i = 1, size(bytes)
            crc32 = ieor(steps(iand(ieor(crc32, int(bytes(i), int32)), 255_int32)), &
                         ishft(crc32, -8))
        end do
        crc32 = not(crc32)
    end function crc32
end module faststrip_lookup_checksum
