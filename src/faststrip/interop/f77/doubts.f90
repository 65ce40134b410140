!> What is outside of practice in the last call of a workspace or a wheelset, in the F77 interface.
module faststrip_interop_f77_doubts
    use, intrinsic :: iso_c_binding, only: c_int, c_char, c_size_t
    use faststrip_base_status, only: message_length
    use faststrip_interop_c_doubts, only: find_words
    use faststrip_interop_f77, only: n_iwork, number_of
    implicit none
    private

    public :: fsdoub

contains

    !> CALL FSDOUB(IWORK, I, N, TEXT, INFO)
    !>
    !> How many lines there are about what is outside of practice, mostly a unit, in the last call
    !> of FSSOLV or FSWSLV, and the I-th of them; blank beyond.
    subroutine fsdoub(iwork, i, n, text, info, length) bind(c, name='fsdoub_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: i                !! from 1 on
        integer(c_int), intent(out) :: n               !! number of lines
        character(kind=c_char), intent(out) :: text(*) !! CHARACTER*(*), blank-padded
        integer(c_int), intent(out) :: info            !! status
        integer(c_size_t), value :: length             !! passed by the compiler

        character(len=message_length) :: words
        integer(c_size_t) :: k

        call find_words(number_of(iwork), i, words, n, info)
        do k = 1, length
            text(k) = ' '
            if (k <= message_length) text(k) = words(k:k)
        end do
    end subroutine fsdoub
end module faststrip_interop_f77_doubts
