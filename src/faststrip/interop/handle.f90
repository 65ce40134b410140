!> What stands behind the handles of the C and F77 faces: a workspace, a field and the words of the
!> last call, in one piece that the caller makes and frees.
module faststrip_interop_handle
    use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_loc, c_f_pointer, c_associated
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_status, only: status_t, set_status, clear_status, is_error, st_bad_argument, &
                                st_workspace_too_small
    use faststrip_tangential_types, only: tangential_field_t
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_solve, only: workspace_t, contact_case_t, contact_result_t, &
                                       reserve_workspace, reserve_contact_field, solve_contact, &
                                       set_contact_gap
    use faststrip_kinds, only: wp
    implicit none
    private

    public :: handle_t, new_handle, free_handle, find_handle, handle_gap, handle_solve, copy_handle

    !> What every live handle begins with.
    integer(int64), parameter :: alive = 4919131752989213764_int64

    !> One caller's workspace.
    type :: handle_t
        integer(int64) :: mark = 0
        type(workspace_t) :: workspace
        type(contact_case_t) :: case      !! filled in anew for every call, without a gap
        type(tangential_field_t) :: field !! elements of the last contact, if room was made
        type(status_t) :: status          !! of the last call
    end type handle_t

contains

    !> Make a handle with room for methods, gaps of up to `max_points` points and, if wanted, the
    !> elements. The one allocation.
    subroutine new_handle(methods, max_points, with_field, address, status)
        type(contact_methods_t), intent(in) :: methods !! what will be asked of it
        integer, intent(in) :: max_points              !! points of a gap
        logical, intent(in) :: with_field              !! are the elements wanted?
        type(c_ptr), intent(out) :: address            !! of the handle; null when there is an error
        type(status_t), intent(out) :: status          !! those of `reserve_workspace`

        type(handle_t), pointer :: handle
        integer :: failure

        address = c_null_ptr
        allocate (handle, stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a workspace')
            return
        end if
        call reserve_workspace(handle%workspace, methods, max_points, status)
        if (with_field .and. .not. is_error(status)) &
            call reserve_contact_field(handle%field, methods, status)
        if (is_error(status)) then
            deallocate (handle)
            return
        end if
        handle%mark = alive
        address = c_loc(handle)
    end subroutine new_handle

    !> Free a handle; nothing happens to what is none.
    subroutine free_handle(address, status)
        type(c_ptr), intent(in) :: address    !! of a handle
        type(status_t), intent(out) :: status !! `st_bad_argument`: no handle

        type(handle_t), pointer :: handle

        call find_handle(address, handle, status)
        if (is_error(status)) return
        handle%mark = 0
        deallocate (handle)
    end subroutine free_handle

    !> The handle at an address.
    subroutine find_handle(address, handle, status)
        type(c_ptr), intent(in) :: address             !! as the caller passed it
        type(handle_t), pointer, intent(out) :: handle !! null if it is none
        type(status_t), intent(out) :: status          !! `st_bad_argument`

        handle => null()
        call clear_status(status)
        if (c_associated(address)) call c_f_pointer(address, handle)
        if (associated(handle)) then
            if (handle%mark == alive) return
            handle => null()
        end if
        call set_status(status, st_bad_argument, 'no workspace, or one that was freed')
    end subroutine find_handle

    !> Hand a gap over.
    subroutine handle_gap(handle, y, h, inv2r, turn)
        type(handle_t), intent(inout) :: handle         !! its status tells how it ended
        real(wp), intent(in) :: y(:), h(:), inv2r(:)    !! mm, mm, 1/mm
        real(wp), intent(in), optional :: turn(:)       !! rad

        call set_contact_gap(handle%workspace, y, h, inv2r, handle%status, turn)
    end subroutine handle_gap

    !> Solve the handle's case on the gap that was handed over.
    subroutine handle_solve(handle, with_field, result)
        type(handle_t), intent(inout) :: handle       !! its status tells how it ended
        logical, intent(in) :: with_field             !! are the elements wanted?
        type(contact_result_t), intent(out) :: result !! figures

        handle%field%n = 0
        if (with_field) then
            call solve_contact(handle%workspace, handle%case, result, handle%status, handle%field)
        else
            call solve_contact(handle%workspace, handle%case, result, handle%status)
        end if
    end subroutine handle_solve

    !> Copy gap, solution and elements of one handle into another; the other's room becomes the
    !> same.
    subroutine copy_handle(from, to)
        type(handle_t), intent(in) :: from  !! stays as it is
        type(handle_t), intent(inout) :: to !! becomes equal

        to%workspace = from%workspace
        to%field = from%field
        call clear_status(to%status)
    end subroutine copy_handle
end module faststrip_interop_handle
