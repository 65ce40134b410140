!> Derivatives in the C interface: what `include/faststrip.h` declares, and where it is documented.
module faststrip_interop_c_derivatives
    use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_ptr, c_associated, c_f_pointer
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_ok, st_bad_argument, &
                                     st_no_convergence
    use faststrip_interop_handle, only: handle_t, find_handle, handle_derivatives
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, &
                                                 wheelset_derivatives
    implicit none
    private

    public :: faststrip_get_derivatives, faststrip_wheelset_get_derivatives

contains

    !> Derivatives of load and forces of the last contact over penetration and creepages.
    integer(c_int) function faststrip_get_derivatives(workspace, derivatives) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: derivatives       !! (4, 4) doubles, rows load, Fx, Fy, Mz; written

        type(handle_t), pointer :: handle
        real(wp), pointer :: rows(:, :)
        real(wp) :: found(4, 4)

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call check_room(derivatives, handle%status)
        if (.not. is_error(handle%status)) call handle_derivatives(handle, found)
        code = handle%status%code
        if (is_error(handle%status)) return
        call c_f_pointer(derivatives, rows, [4, 4])
        rows = transpose(found)
    end function faststrip_get_derivatives

    !> Derivatives of the wheels' forces and moments over position and velocity.
    integer(c_int) function faststrip_wheelset_get_derivatives(wheelset, derivatives) bind(c) &
        result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        type(c_ptr), value :: derivatives
            !! (2, 6, 9) doubles: right and left, rows Fx, Fy, Fz, Mx, My, Mz; written but with
            !! errors other than 108

        type(wheelset_handle_t), pointer :: handle
        real(wp), pointer :: rows(:, :, :)
        real(wp) :: found(6, 9, 2)
        integer :: side

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call check_room(derivatives, handle%status)
        if (.not. is_error(handle%status)) call wheelset_derivatives(handle, found)
        code = handle%status%code
        if (is_error(handle%status) .and. code /= st_no_convergence) return
        call c_f_pointer(derivatives, rows, [9, 6, 2])
        do side = 1, 2
            rows(:, :, side) = transpose(found(:, :, side))
        end do
    end function faststrip_wheelset_get_derivatives

    subroutine check_room(derivatives, status)
        type(c_ptr), intent(in) :: derivatives
        type(status_t), intent(out) :: status

        if (.not. c_associated(derivatives)) &
            call set_status(status, st_bad_argument, 'there is no array for derivatives')
    end subroutine check_room
end module faststrip_interop_c_derivatives
