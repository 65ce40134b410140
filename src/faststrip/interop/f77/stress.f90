!> Stresses below the surface in the F77 interface, of workspaces of FSINIT whose elements were
!> wanted, or without tangential method.
!>
!> ```
!> X, Y, Z  points in the frame of the contact, Z the depth below the surface, from 0 on, mm
!> STRESS(1,I) to STRESS(6,I) stress of the rail, xx, yy, zz, xy, xz, yz, MPa; tension is positive
!> STRESS(7,I), STRESS(8,I) von Mises' and Tresca's equivalent stress, MPa
!> STRESS(9,I) to STRESS(11,I) principal values, the largest first, MPa
!> PEAK(1)  largest von Mises stress, MPa              PEAK(2) to PEAK(4) where it is, x, y, z, mm
!> PEAK(5)  its estimated relative error
!> ```
module faststrip_interop_f77_stress
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_status, only: st_bad_argument, st_ok
    use faststrip_interop_f77, only: n_iwork, number_of
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_stress, only: n_values, n_peak, handle_stresses, handle_peak
    implicit none
    private

    public :: fsstrs, fspeak

contains

    !> CALL FSSTRS(IWORK, N, X, Y, Z, STRESS, INFO)
    !>
    !> Stresses of the rail at points below the last contact.
    subroutine fsstrs(iwork, n, x, y, z, stress, info) bind(c, name='fsstrs_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSINIT, with a solution
        integer(c_int), intent(in) :: n                !! number of points
        real(c_double), intent(in) :: x(*), y(*), z(*) !! as above
        real(c_double), intent(inout) :: stress(n_values, *) !! as above
        integer(c_int), intent(out) :: info            !! status

        type(handle_t), pointer :: handle

        call find_handle(number_of(iwork), handle, info)
        if (info /= st_ok) return
        info = st_bad_argument
        if (n < 0) return
        call handle_stresses(handle, x(:n), y(:n), z(:n), stress(:, :n))
        info = handle%status%code
    end subroutine fsstrs

    !> CALL FSPEAK(IWORK, PEAK, INFO)
    !>
    !> The largest von Mises stress of the rail below the last contact.
    subroutine fspeak(iwork, peak, info) bind(c, name='fspeak_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSINIT, with a solution
        real(c_double), intent(out) :: peak(n_peak)    !! as above; zeros when there is an error
        integer(c_int), intent(out) :: info            !! status

        type(handle_t), pointer :: handle

        peak = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call handle_peak(handle, peak)
        info = handle%status%code
    end subroutine fspeak
end module faststrip_interop_f77_stress
