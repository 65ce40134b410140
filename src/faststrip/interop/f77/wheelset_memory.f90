!> The memory of wheelsets as bytes in the F77 interface.
!>
!> ```
!> BYTES    what the next solution of a wheelset depends on, in an array of any type
!> NEEDED   how many they are
!> ```
module faststrip_interop_f77_wheelset_memory
    use, intrinsic :: iso_c_binding, only: c_int, c_int8_t
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: is_error
    use faststrip_interop_f77, only: n_iwork, number_of, check_count
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, save_memory, &
                                                 restore_memory
    implicit none
    private

    public :: fswsav, fswrst

contains

    !> CALL FSWSAV(IWORK, NBYTES, BYTES, NEEDED, INFO)
    !>
    !> Write the memory of a wheelset. INFO 110: NBYTES below NEEDED.
    subroutine fswsav(iwork, n_bytes, bytes, needed, info) bind(c, name='fswsav_')
        integer(c_int), intent(in) :: iwork(n_iwork)  !! made by FSWNEW
        integer(c_int), intent(in) :: n_bytes         !! length of BYTES
        integer(c_int8_t), intent(inout) :: bytes(*)  !! as above
        integer(c_int), intent(out) :: needed         !! as above
        integer(c_int), intent(out) :: info           !! status

        type(wheelset_handle_t), pointer :: handle
        integer(int64) :: n

        needed = 0
        call find_wheelset(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_count(handle%status, n_bytes, 'bytes')
        if (.not. is_error(handle%status)) then
            call save_memory(handle, bytes(:n_bytes), n)
            needed = int(n, c_int)
        end if
        info = handle%status%code
    end subroutine fswsav

    !> CALL FSWRST(IWORK, NBYTES, BYTES, INFO)
    !>
    !> Take the memory of a wheelset over. INFO 121: damaged, cut, of another version or wheelset.
    subroutine fswrst(iwork, n_bytes, bytes, info) bind(c, name='fswrst_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW, as the one of FSWSAV
        integer(c_int), intent(in) :: n_bytes        !! NEEDED of FSWSAV
        integer(c_int8_t), intent(in) :: bytes(*)    !! as above
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_count(handle%status, n_bytes, 'bytes')
        if (.not. is_error(handle%status)) call restore_memory(handle, bytes(:n_bytes))
        info = handle%status%code
    end subroutine fswrst
end module faststrip_interop_f77_wheelset_memory
