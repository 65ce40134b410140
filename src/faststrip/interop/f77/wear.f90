!> Friction, wear and fatigue in the F77 interface, of workspaces of FSINIT and of FSWNEW alike.
!>
!> ```
!> KIND     how friction falls with slip: 0 it does not, 2 linear, 3 rational, 4 exponential
!> FRIC(1) kinetic over static friction, 1e-6 to 1     FRIC(2) slip speed of half of the fall, mm/s
!> FRIC(3) rolling speed, mm/s      FRIC(4) factor of the initial slope, above 0 to 1
!> FRIC(5) mu on the flange over that on the tread, PAR(5); 1: they are one
!> FRIC(6), FRIC(7) contact angles up to which the tread's counts and from which the flange's, rad
!> FRIC(8) contact angle, rad; of wheelsets it is found, as FRIC(3)
!> KOVER    what places of friction are: 0 y of the contact, 1 y on the rail, mm, 2 contact angle
!>          of either sign, rad (FRIC(8); of wheelsets it is found)
!> YRAIL    y on the rail's profile at y = 0, mm, for KOVER 1; of wheelsets it is found
!> AT(N), AMU(N) places, increasing, and the coefficients there; linear between, constant beyond
!> NREG     regimes of a law of wear, up to 32; 0: none
!> REGIM(1,I), REGIM(2,I) T gamma/A where regime I begins and ends, N/mm^2; the first at 0
!> REGIM(3,I) constant, ug/(m mm^2), and REGIM(4,I) slope, ug/(m N), of the wear rate
!> DENS     density of what is worn, kg/m^3            YIELD in cyclic shear, MPa; 0: not known
!> WEAR(1) T gamma, N       WEAR(2) with spin, N       WEAR(3) T gamma over the area, N/mm^2
!> WEAR(4) fatigue index; 0 with YIELD 0
!> WEAR(5) wear, ug per metre rolled, and WEAR(6) in mm^3; 0 with NREG 0
!> ```
module faststrip_interop_f77_wear
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_friction_table, only: friction_table_t, make_friction_table
    use faststrip_base_status, only: status_t, is_error, st_ok, st_workspace_too_small
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_interop_f77, only: n_iwork, number_of, find_either
    use faststrip_interop_f77_wheelset, only: find_column
    use faststrip_interop_f77_rows, only: n_fric, fill_friction
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_solution, only: mirror_t, strip_count, read_strip_forces, &
                                          read_strip_wear
    use faststrip_interop_wear, only: n_regime, n_wear, contact_wear, contact_strip_wear
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_contact, &
                                                 contact_mirror
    implicit none
    private

    public :: fsfric, fsfrtb, fswear, fsstwr, fswstw

contains

    !> CALL FSFRIC(IWORK, KIND, FRIC, INFO)
    !>
    !> Set friction for all further calls of FSSOLV or FSWSLV, which refuse what is none; figures
    !> of the last solution are forgotten. FSINIT and FSWNEW set one number.
    subroutine fsfric(iwork, kind, fric, info) bind(c, name='fsfric_')
        integer(c_int), intent(in) :: iwork(n_iwork)    !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: kind              !! as above
        real(c_double), intent(in) :: fric(n_fric)  !! as above
        integer(c_int), intent(out) :: info             !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        real(c_double) :: angle

        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call fill_friction(kind, fric, handle%case%friction, handle%contact_angle)
            handle%result = contact_result_t()
        else if (associated(wheelset)) then
            call fill_friction(kind, fric, wheelset%model%case%friction, angle)
            wheelset%has = .false.
        end if
    end subroutine fsfric

    !> CALL FSFRTB(IWORK, KOVER, YRAIL, N, AT, AMU, INFO)
    !>
    !> Set friction across the rail for all further calls of FSSOLV or FSWSLV, in place of PAR(5);
    !> figures of the last solution are forgotten. FSFRIC takes it back, and comes first where it
    !> is called too.
    subroutine fsfrtb(iwork, kover, y_rail, n, at, amu, info) bind(c, name='fsfrtb_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: kover          !! as above
        real(c_double), intent(in) :: y_rail         !! as above
        integer(c_int), intent(in) :: n              !! places, 1 to 16; 0: mu is the same
        real(c_double), intent(in) :: at(*)          !! as above
        real(c_double), intent(in) :: amu(*)         !! as above
        integer(c_int), intent(out) :: info          !! status; 100: no table, nothing is changed

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        type(friction_table_t) :: table
        type(status_t) :: status

        call find_either(iwork, handle, wheelset, info)
        if (info /= st_ok) return
        if (n /= 0) call make_friction_table(kover, at(:n), amu(:n), table, status)
        info = status%code
        if (is_error(status)) return
        table%y_rail = y_rail
        if (associated(handle)) then
            handle%case%friction%table = table
            handle%result = contact_result_t()
        else if (associated(wheelset)) then
            wheelset%model%case%friction%table = table
            wheelset%has = .false.
        end if
    end subroutine fsfrtb

    !> CALL FSWEAR(IWORK, K, NREG, REGIM, DENS, YIELD, WEAR, INFO)
    !>
    !> T gamma, wear and fatigue of the last solution; of a wheelset those of contact K, column K
    !> of CONT. INFO 109: the law ends at a T gamma/A below one of a strip.
    subroutine fswear(iwork, k, n_regimes, regimes, density, yield_shear, wear, info) &
        bind(c, name='fswear_')
        integer(c_int), intent(in) :: iwork(n_iwork)     !! with a solution
        integer(c_int), intent(in) :: k                  !! contact; of FSINIT's it does not count
        integer(c_int), intent(in) :: n_regimes          !! as above
        real(c_double), intent(in) :: regimes(n_regime, *) !! as above
        real(c_double), intent(in) :: density            !! as above
        real(c_double), intent(in) :: yield_shear        !! as above
        real(c_double), intent(out) :: wear(n_wear)      !! as above; zero when there is an error
        integer(c_int), intent(out) :: info              !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        integer :: side, i

        wear = 0.0_c_double
        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call contact_wear(handle%workspace, handle%result, handle%result%creepage, &
                              regimes(:, :n_regimes), density, yield_shear, wear, handle%status)
            info = handle%status%code
        else if (associated(wheelset)) then
            call find_contact(wheelset, k, side, i)
            if (.not. is_error(wheelset%status)) then
                associate (contact => wheelset%result%wheel(side)%contact(i))
                    call contact_wear(wheelset%workspace%wheel(side)%contact(i), &
                                      contact%figures, contact%creepage, regimes(:, :n_regimes), &
                                      density, yield_shear, wear, wheelset%status)
                end associate
            end if
            info = wheelset%status%code
        end if
    end subroutine fswear

    !> CALL FSSTWR(IWORK, NREG, REGIM, DENS, M, N, FX, FY, POWER, TGA, WMASS, DEPTH, INFO)
    !>
    !> Forces and wear of the strips of the last contact, in the order of FSSTRP.
    subroutine fsstwr(iwork, n_regimes, regimes, density, capacity, n, fx, fy, power, t_gamma, &
                      mass, depth, info) bind(c, name='fsstwr_')
        integer(c_int), intent(in) :: iwork(n_iwork)     !! made by FSINIT, with a solution
        integer(c_int), intent(in) :: n_regimes          !! as above
        real(c_double), intent(in) :: regimes(n_regime, *) !! as above
        real(c_double), intent(in) :: density            !! as above
        integer(c_int), intent(in) :: capacity           !! length of the arrays
        integer(c_int), intent(out) :: n                 !! number of strips
        real(c_double), intent(inout) :: fx(*), fy(*)    !! on the rail, N
        real(c_double), intent(inout) :: power(*)        !! friction power over rolling speed, N
        real(c_double), intent(inout) :: t_gamma(*)      !! T gamma over the area, N/mm^2
        real(c_double), intent(inout) :: mass(*)         !! ug per metre rolled
        real(c_double), intent(inout) :: depth(*)        !! depth when rolled over once, mm
        integer(c_int), intent(out) :: info              !! status

        type(handle_t), pointer :: handle

        n = 0
        call find_handle(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call contact_strip_wear(handle%workspace, handle%result, regimes(:, :n_regimes), density, &
                                handle%status)
        info = handle%status%code
        if (is_error(handle%status)) return
        call copy_strip_wear(handle%workspace, mirror_t(), capacity, n, fx, fy, power, t_gamma, &
                             mass, depth, info)
    end subroutine fsstwr

    !> CALL FSWSTW(IWORK, K, NREG, REGIM, DENS, M, N, FX, FY, POWER, TGA, WMASS, DEPTH, INFO)
    !>
    !> The same of a contact of a wheelset, column K of CONT, in the order of FSWSTR.
    subroutine fswstw(iwork, k, n_regimes, regimes, density, capacity, n, fx, fy, power, t_gamma, &
                      mass, depth, info) bind(c, name='fswstw_')
        integer(c_int), intent(in) :: iwork(n_iwork)     !! made by FSWNEW, with a solution
        integer(c_int), intent(in) :: k                  !! contact
        integer(c_int), intent(in) :: n_regimes          !! as above
        real(c_double), intent(in) :: regimes(n_regime, *) !! as above
        real(c_double), intent(in) :: density            !! as above
        integer(c_int), intent(in) :: capacity           !! length of the arrays
        integer(c_int), intent(out) :: n                 !! number of strips
        real(c_double), intent(inout) :: fx(*), fy(*)    !! on the rail, N
        real(c_double), intent(inout) :: power(*)        !! friction power over rolling speed, N
        real(c_double), intent(inout) :: t_gamma(*)      !! T gamma over the area, N/mm^2
        real(c_double), intent(inout) :: mass(*)         !! ug per metre rolled
        real(c_double), intent(inout) :: depth(*)        !! depth when rolled over once, mm
        integer(c_int), intent(out) :: info              !! status

        type(wheelset_handle_t), pointer :: handle
        integer :: side, i

        n = 0
        call find_column(iwork, k, handle, side, i, info)
        if (info /= st_ok) return
        associate (contact => handle%workspace%wheel(side)%contact(i))
            call contact_strip_wear(contact, handle%result%wheel(side)%contact(i)%figures, &
                                    regimes(:, :n_regimes), density, handle%status)
            info = handle%status%code
            if (is_error(handle%status)) return
            call copy_strip_wear(contact, contact_mirror(handle, side), capacity, n, fx, fy, &
                                 power, t_gamma, mass, depth, info)
        end associate
    end subroutine fswstw

    ! What was found, unless the arrays are too short.
    subroutine copy_strip_wear(workspace, mirror, capacity, n, fx, fy, power, t_gamma, mass, &
                               depth, info)
        type(workspace_t), intent(in) :: workspace
        type(mirror_t), intent(in) :: mirror
        integer(c_int), intent(in) :: capacity
        integer(c_int), intent(out) :: n
        real(c_double), intent(inout) :: fx(*), fy(*), power(*), t_gamma(*), mass(*), depth(*)
        integer(c_int), intent(inout) :: info

        n = strip_count(workspace)
        if (capacity < n) then
            info = st_workspace_too_small
            return
        end if
        call read_strip_forces(workspace, mirror, fx(:n), fy(:n), power(:n))
        call read_strip_wear(workspace, mirror, t_gamma(:n), mass(:n), depth(:n))
    end subroutine copy_strip_wear
end module faststrip_interop_f77_wear
