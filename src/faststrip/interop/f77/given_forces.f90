!> Forces given instead of creepages in the F77 interface.
!>
!> ```
!> IGIV(1) 1: FGIV(1) is given, and PAR(7), which must be 0, is found
!> IGIV(2) 1: the same of FGIV(2) and PAR(8)
!> FGIV(1), FGIV(2) longitudinal and lateral force on the rail, N
!> CREEP(1) to CREEP(3) longitudinal and lateral creepage, spin, rad/mm
!> CREEP(4), CREEP(5) estimated errors of the first two, 0 where they were given or are not known
!> ```
module faststrip_interop_f77_given_forces
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_contact_case, only: given_forces_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_interop_f77, only: n_iwork, number_of
    use faststrip_interop_handle, only: handle_t, find_handle
    implicit none
    private

    public :: fsgivn, fscrep

contains

    !> CALL FSGIVN(IWORK, IGIV, FGIV, INFO)
    !>
    !> Give forces for all further calls of FSSOLV, which refuses (109) what is above mu N; figures
    !> of the last solution are forgotten. With IGIV 0 creepages are given again.
    subroutine fsgivn(iwork, igiv, fgiv, info) bind(c, name='fsgivn_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT
        integer(c_int), intent(in) :: igiv(2)        !! as above
        real(c_double), intent(in) :: fgiv(2)        !! as above
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        handle%case%given = given_forces_t(igiv /= 0, fgiv)
        handle%result = contact_result_t()
    end subroutine fsgivn

    !> CALL FSCREP(IWORK, CREEP, INFO)
    !>
    !> The creepages of the last contact: found where forces were given, else those of PAR.
    subroutine fscrep(iwork, creep, info) bind(c, name='fscrep_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT, with a solution
        real(c_double), intent(out) :: creep(5)      !! as above; zeros without a solution
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        creep = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        associate (c => handle%result%creepage)
            creep = [c%cksi, c%ceta, c%cphi, handle%result%creepage_errors]
        end associate
    end subroutine fscrep
end module faststrip_interop_f77_given_forces
