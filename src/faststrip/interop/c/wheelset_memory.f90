!> The memory of wheelsets as bytes in the C interface: what `include/faststrip.h` declares, and
!> where it is documented.
module faststrip_interop_c_wheelset_memory
    use, intrinsic :: iso_fortran_env, only: int8, int64
    use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_size_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: set_status, st_ok, st_bad_argument
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, save_memory, &
                                                 restore_memory
    implicit none
    private

    public :: faststrip_wheelset_save, faststrip_wheelset_restore

contains

    !> Write what the next solution depends on.
    integer(c_int) function faststrip_wheelset_save(wheelset, capacity, n, bytes) bind(c) &
        result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_size_t), value :: capacity   !! length of `bytes`
        type(c_ptr), value :: n                !! how many there are, written
        type(c_ptr), value :: bytes            !! written; null with a capacity of 0

        type(wheelset_handle_t), pointer :: handle
        integer(int8), pointer, contiguous :: content(:)
        integer(int8), target :: none(0)
        integer(c_size_t), pointer :: length
        integer(int64) :: needed

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        if (.not. c_associated(n) .or. capacity < 0 &
            .or. .not. c_associated(bytes) .and. capacity > 0) then
            call set_status(handle%status, st_bad_argument, 'number or bytes are missing')
        else
            content => none
            if (capacity > 0) call c_f_pointer(bytes, content, [capacity])
            call save_memory(handle, content, needed)
            call c_f_pointer(n, length)
            length = needed
        end if
        code = handle%status%code
    end function faststrip_wheelset_save

    !> Take over what was written.
    integer(c_int) function faststrip_wheelset_restore(wheelset, n, bytes) bind(c) result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_size_t), value :: n          !! length of `bytes`
        type(c_ptr), value :: bytes            !! of `faststrip_wheelset_save`

        type(wheelset_handle_t), pointer :: handle
        integer(int8), pointer, contiguous :: content(:)

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        if (c_associated(bytes) .and. n >= 0) then
            call c_f_pointer(bytes, content, [n])
            call restore_memory(handle, content)
        else
            call set_status(handle%status, st_bad_argument, 'bytes are missing')
        end if
        code = handle%status%code
    end function faststrip_wheelset_restore
end module faststrip_interop_c_wheelset_memory
