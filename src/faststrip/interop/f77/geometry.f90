!> Contact geometry functions and equivalent conicity in the F77 interface; neither needs a
!> workspace.
!>
!> ```
!> SETUP, NPROF, YPROF, ZPROF as FSWNEW takes them; SETUP(9) does not count
!> IROLL    1: the wheelset rolls until both wheels touch, 0: it stays level
!> FUNC(1,I) rolling radius difference at the shift Y(I), right less left, mm
!> FUNC(2,I), FUNC(3,I) rolling radius of the right and left wheel, mm
!> FUNC(4,I), FUNC(5,I) contact angle of both, rad     FUNC(6,I) roll, rad
!> FUNC(7,I), FUNC(8,I) y of the contact on the right wheel and rail, FUNC(9,I), FUNC(10,I) on the
!>          left ones, of the left in its mirror, mm
!> ISTAT(I) status of the shift: 0, or 106, a wheel leaves its rail, with zeros in FUNC
!> EQU(1)   where the wheelset is in equilibrium       EQU(2) largest amplitude of the table, mm
!> CON(1,J) tan gamma_e at AMP(J) by Klingel's equation, EN 15302:2008+A1:2010, Annex B
!> CON(2,J) by linear regression, Annex C              CON(3,J), CON(4,J) turning points, mm
!> CON(5,J), CON(6,J) nonlinearity of both, 1/mm
!> JSTAT(1,J) status of the amplitude: 0; 11, no wave: CON(1,J) is 0, CON(3,J), CON(4,J) are the
!>          ends of the line of CON(2,J); or 100, 109, with zeros in CON
!> JSTAT(2,J) 1: CON(5,J) and CON(6,J) are known
!> ```
module faststrip_interop_f77_geometry
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_status, only: status_t, is_error, st_bad_argument
    use faststrip_interop_f77_wheelset, only: n_setup, read_dimensions, read_sources
    use faststrip_interop_geometry, only: table_functions, table_conicity, n_function, n_conicity
    use faststrip_interop_wheelset_new, only: profile_source_t
    implicit none
    private

    public :: fscfun, fsconi

contains

    !> CALL FSCFUN(SETUP, NPROF, YPROF, ZPROF, IROLL, N, Y, FUNC, ISTAT, INFO)
    !>
    !> The contact of both wheels over the lateral shift. INFO 106: at no shift.
    subroutine fscfun(setup, n_profile, y_profile, z_profile, with_roll, n, y, functions, states, &
                      info) bind(c, name='fscfun_')
        real(c_double), intent(in) :: setup(n_setup)  !! as above
        integer(c_int), intent(in) :: n_profile(4)    !! as above
        real(c_double), intent(in), target :: y_profile(*), z_profile(*) !! mm
        integer(c_int), intent(in) :: with_roll       !! as above
        integer(c_int), intent(in) :: n               !! number of shifts
        real(c_double), intent(in) :: y(*)            !! shifts to the right, mm
        real(c_double), intent(inout) :: functions(n_function, *) !! as above
        integer(c_int), intent(inout) :: states(*)    !! as above
        integer(c_int), intent(out) :: info           !! status

        type(profile_source_t) :: sources(4)
        type(status_t) :: status

        info = st_bad_argument
        if (n < 0) return
        call read_sources(n_profile, y_profile, z_profile, sources, status)
        if (.not. is_error(status)) &
            call table_functions(sources(:2), sources(3:), read_dimensions(setup), with_roll /= 0, &
                                 y(:n), functions(:, :n), states(:n), status)
        info = status%code
    end subroutine fscfun

    !> CALL FSCONI(N, Y, DR, M, AMP, EQU, CON, JSTAT, INFO)
    !>
    !> Equivalent conicity over the amplitude from a rolling radius difference DR over Y, rising.
    subroutine fsconi(n, y, delta_r, m, amplitudes, equilibrium, conicities, states, info) &
        bind(c, name='fsconi_')
        integer(c_int), intent(in) :: n                 !! points of the table
        real(c_double), intent(in) :: y(*), delta_r(*)  !! mm
        integer(c_int), intent(in) :: m                 !! number of amplitudes
        real(c_double), intent(in) :: amplitudes(*)     !! mm
        real(c_double), intent(inout) :: equilibrium(2) !! as above
        real(c_double), intent(inout) :: conicities(n_conicity, *) !! as above
        integer(c_int), intent(inout) :: states(2, *)   !! as above
        integer(c_int), intent(out) :: info             !! status

        type(status_t) :: status

        info = st_bad_argument
        if (min(n, m) < 0) return
        call table_conicity(y(:n), delta_r(:n), amplitudes(:m), equilibrium, conicities(:, :m), &
                            states(:, :m), status)
        info = status%code
    end subroutine fsconi
end module faststrip_interop_f77_geometry
