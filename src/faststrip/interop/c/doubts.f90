!> What is outside of practice in the last call of a workspace or a wheelset, in the C interface.
module faststrip_interop_c_doubts
    use, intrinsic :: iso_c_binding, only: c_int, c_char, c_size_t, c_ptr, c_intptr_t, &
                                           c_associated, c_f_pointer, c_null_char
    use faststrip_base_status, only: message_length, st_ok, st_bad_argument, st_workspace_too_small
    use faststrip_contact_plausible, only: doubts_t
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset
    implicit none
    private

    public :: faststrip_doubt, find_words

contains

    !> One of the lines about what is outside of practice, mostly a unit, in the last contact of a
    !> workspace or the last state of a wheelset; empty behind the last one.
    integer(c_int) function faststrip_doubt(workspace, i, text, length) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle of either kind
        integer(c_int), value :: i              !! from 0 on
        type(c_ptr), value :: text              !! `length` characters, written
        integer(c_size_t), value :: length      !! with the closing zero

        character(kind=c_char), pointer :: letters(:)
        character(len=message_length) :: words
        integer :: k, n
        integer(c_int) :: count

        code = st_bad_argument
        if (.not. c_associated(text) .or. length < 1) return
        call find_words(workspace, i + 1, words, count, code)
        if (code /= st_ok) return
        call c_f_pointer(text, letters, [length])
        n = int(min(int(len_trim(words), c_size_t), length - 1))
        do k = 1, n
            letters(k) = words(k:k)
        end do
        letters(n + 1) = c_null_char
        code = merge(st_ok, st_workspace_too_small, n == len_trim(words))
    end function faststrip_doubt

    !> How many lines a handle of either kind has, and the i-th of them; blank beyond.
    subroutine find_words(number, i, words, n, code)
        integer(c_intptr_t), intent(in) :: number !! of the handle, as the caller passed it
        integer, intent(in) :: i                  !! from 1 on
        character(len=*), intent(out) :: words    !! the line
        integer(c_int), intent(out) :: n          !! number of lines
        integer(c_int), intent(out) :: code       !! 0, or the status of no handle

        type(handle_t), pointer :: contact
        type(wheelset_handle_t), pointer :: wheelset

        words = ''
        n = 0
        call find_handle(number, contact, code)
        if (associated(contact)) then
            call take_words(contact%doubts, i, words, n)
        else
            call find_wheelset(number, wheelset, code)
            if (associated(wheelset)) call take_words(wheelset%doubts, i, words, n)
        end if
    end subroutine find_words

    pure subroutine take_words(doubts, i, words, n)
        type(doubts_t), intent(in) :: doubts
        integer, intent(in) :: i
        character(len=*), intent(out) :: words
        integer(c_int), intent(out) :: n

        words = ''
        n = doubts%n
        if (i >= 1 .and. i <= doubts%n) words = doubts%words(i)
    end subroutine take_words
end module faststrip_interop_c_doubts
