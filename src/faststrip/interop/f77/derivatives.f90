!> Derivatives in the F77 interface.
module faststrip_interop_f77_derivatives
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_status, only: first_error, st_no_convergence
    use faststrip_interop_f77, only: n_iwork, number_of
    use faststrip_interop_handle, only: handle_t, find_handle, handle_derivatives
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, &
                                                 wheelset_derivatives
    implicit none
    private

    public :: fsderv, fswdrv

contains

    !> CALL FSDERV(IWORK, D, INFO)
    !>
    !> Derivatives of load, Fx, Fy, Mz of the last contact, in the rows of D, over penetration,
    !> cksi, ceta, cphi, in its columns.
    subroutine fsderv(iwork, d, info) bind(c, name='fsderv_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT
        real(c_double), intent(inout) :: d(4, 4)     !! N, N mm over mm, 1, rad/mm; kept with errors
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle
        real(c_double) :: found(4, 4)

        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call handle_derivatives(handle, found)
        info = handle%status%code
        if (info < first_error) d = found
    end subroutine fsderv

    !> CALL FSWDRV(IWORK, D, INFO)
    !>
    !> Derivatives of Fx, Fy, Fz, Mx, My, Mz of each wheel, in the rows of D, over y, z, roll,
    !> yaw, their rates and the pitch rate, in its columns, at the last solution; right, left.
    subroutine fswdrv(iwork, d, info) bind(c, name='fswdrv_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(inout) :: d(6, 9, 2)
            !! N, N mm over mm, rad, 1/s; NaN of a wheel with 108, kept with other errors
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle
        real(c_double) :: found(6, 9, 2)

        call find_wheelset(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call wheelset_derivatives(handle, found)
        info = handle%status%code
        if (info < first_error .or. info == st_no_convergence) d = found
    end subroutine fswdrv
end module faststrip_interop_f77_derivatives
