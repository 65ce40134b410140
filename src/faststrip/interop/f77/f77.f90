!> The F77 interface: external subroutines with plain arguments, names of at most six letters.
!>
!> INTEGER is four bytes, DOUBLE PRECISION eight; FSINTS tells a host that was compiled with others,
!> and where IOPT shows it, it is refused. Names carry the trailing underscore most Fortran
!> compilers add; the installed library has them without it too. A workspace is an INTEGER array
!> `IWORK` of the caller (`FSINIT` with `LIWORK = -1` gives its length) that holds a handle: FSINIT
!> allocates, FSFREE frees, nothing in between allocates, and the library remembers nothing of its
!> own. `INFO` is a code of `faststrip_base_status`: 0, below 100 a result with a named limitation
!> (1 fallback_used, 2 edge_of_data, 3 fewer_strips, 4 overlap_left, 5 flat_along_x, 6 conformal, 7
!> target_missed, 8 under_resolved, 9 more_strips, 10 beyond_yield, 11 no_wave, 12 not_unique), from
!> 100 on no result.
!>
!> ```
!> IOPT(1) normal method: 1 strip, 2 hertz, 3 equal_area, 4 equal_moments, 6 auto, 7 kpec, 8 analyn,
!>         9 kpec_strips
!> IOPT(2) tangential method: 0 none, 1 faststrip, 2 fastsim, 3 faststrip-paper,
!>         4 faststrip-corrected, 5 fastsim-elliptic, 6 fastsim-weighted, 7 linear, 8 she, 9 polach,
!>         11 faststrip-plain
!> IOPT(3) strips per patch, 0: left to the solver     IOPT(4) points per strip
!> IOPT(5) points along a row of FASTSIM               IOPT(6) rows of FASTSIM
!> IOPT(7) 1: PAR(6) is the load, 0: the penetration   IOPT(8) 1: warm start
!> IOPT(9) 1: elements wanted
!> PAR(1), PAR(2) Young's modulus of wheel and rail, MPa
!> PAR(3), PAR(4) Poisson's ratio of wheel and rail    PAR(5) coefficient of friction
!> PAR(6) load, N, or penetration, mm                  PAR(7) longitudinal creepage
!> PAR(8) lateral creepage                             PAR(9) spin, rad/mm
!> RES(1) normal load, N
!> RES(2) penetration, the approach from h = 0, mm
!> RES(3) contact area, mm^2
!> RES(4) maximum pressure, MPa
!> RES(5) least y of the contact, mm
!> RES(6) largest y of the contact, mm
!> RES(7) largest half-length of the contact, along x, mm
!> RES(8) longitudinal force on the rail, N
!> RES(9) lateral force on the rail, in the contact plane, N
!> RES(10) moment on the rail about the reference point, N mm
!> RES(11) frictional work per distance rolled, N
!> RES(12) share of the area in adhesion
!> RES(13) number of contact patches
!> RES(14) number of strips
!> ERR(1) estimated error of the penetration over the depth
!> ERR(2) estimated relative error of pmax
!> ERR(3) estimated relative error of the area
!> ERR(4) largest gap left inside, over the depth
!> ERR(5) largest overlap outside, over the depth
!> ERR(6) 1: ERR(1) to ERR(5) are known; 0: they are zero, of equal ellipses or by FSLIMT; the
!>        depth is D - h_lowest, below the lowest point of the gap
!> ERR(7) strips across the patch that has most, 0: no strips
!> FERR(1) estimated error of Fx over mu N
!> FERR(2) estimated error of Fy over mu N
!> FERR(3) estimated error of Mz over mu N sqrt(area/pi)
!> FERR(4) 1: FERR(1) to FERR(3) are known; 0: they are zero, of a method without, or by FSLIMT
!> ITARG  what auto is to know: 1 forces, 2 maximum pressure, 3 penetration, 4 area, 5 power
!> TAKN(1) steps that auto took     TAKN(2) the best of them, whose solution is the result
!> TAKN(3) estimated error of what was wanted          TAKN(4) 1: it is known, 0: TAKN(3) is zero
!> TAKN(5) 1: it is within the tolerance
!> LSET   all limitations of the contact: 2**INFO of each, added up
!> ```
!>
!> FSSOLV estimates errors unless FSLIMT switched that off, and says 8, under_resolved, where one of
!> ERR(1) to ERR(3) or of FERR(1) to FERR(3) is above a limit. FSERRS and FSFERR have them.
!>
!> With IOPT(1) = 6, in FSINIT too, both methods are as fine as estimated errors ask, of what
!> FSWANT says is wanted; FSTAKN and FSSTEP say what was done. IOPT(3) and IEST of FSLIMT do not
!> count then; where ITARG is 1 or 5, nor do IOPT(4) and IOPT(2), which must not be 0: 1 serves.
!> RLIM counts only where the tolerance is 0. INFO 7, target_missed: as near as strips come.
module faststrip_interop_f77
    use, intrinsic :: iso_c_binding, only: c_int, c_int64_t, c_double, c_size_t, c_char, c_intptr_t
    use faststrip_base_status, only: status_t, status_word, set_status, clear_status, is_error, &
                                     count_text, st_ok, st_bad_argument, st_workspace_too_small
    use faststrip_normal_limitations, only: check_resolution
    use faststrip_contact_methods, only: tangential_faststrip
    use faststrip_contact_wanted, only: wanted_t, check_wanted
    use faststrip_contact_method, only: workspace_t
    use faststrip_interop_handle, only: handle_t, new_handle, free_handle, find_handle, &
                                        handle_gap, handle_solve, copy_handle
    use faststrip_interop_f77_rows, only: n_iopt, n_par, n_res, n_err, n_ferr, n_takn, &
                                          default_rows, methods_of, fill_case, res_of, err_of, &
                                          ferr_of, takn_of
    use faststrip_interop_solution, only: mirror_t, strip_count, read_strips, read_elements, &
                                          read_steps
    use faststrip_interop_classic, only: classic_fastsim, classic_hertz, classic_kalker
    use faststrip_interop_profile_points, only: gap_of_points, copy_gap, n_setup, n_contact
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, &
                                                 forget_asked
    use faststrip_geometry_gap, only: gap_t
    implicit none
    private

    public :: fstsim, fskalk, fsherz, fsdflt, fsinit, fsgap, fssolv, fscont, fsstrp, fselem
    public :: fslimt, fserrs, fsferr, fslset, fscopy, fsfree, fsmsg, fslast, fsprof, fsrprf
    public :: fswant, fstakn, fsstep, fsints, fscurv, fsgapt
    public :: n_iwork, check_count, check_choices, set_number, number_of, find_either, copy_strips

    ! A workspace array: two marks around the handle.
    integer, parameter :: n_iwork = 8, first_mark = 1179603536, last_mark = 1412575053

contains

    !> CALL FSTSIM(A, B, G, C11, C22, C23, CKSI, CETA, CPHI, AMU, FN, NX, NY, FX, FY, FMZ, INFO)
    !>
    !> FASTSIM on an ellipse: what a vehicle code's own FASTSIM takes and gives.
    subroutine fstsim(a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load, nx, ny, fx, fy, mz, &
                      info) bind(c, name='fstsim_')
        real(c_double), intent(in) :: a, b             !! semi-axes along x and y, mm
        real(c_double), intent(in) :: g                !! combined shear modulus, MPa
        real(c_double), intent(in) :: c11, c22, c23    !! Kalker's coefficients
        real(c_double), intent(in) :: cksi, ceta, cphi !! creepages, -, -, rad/mm
        real(c_double), intent(in) :: mu               !! coefficient of friction
        real(c_double), intent(in) :: load             !! normal force, N
        integer(c_int), intent(in) :: nx, ny           !! points along a row, rows
        real(c_double), intent(out) :: fx, fy, mz      !! on the rail, N, N, N mm
        integer(c_int), intent(out) :: info            !! status

        type(status_t) :: status
        real(c_double) :: forces(3)

        call classic_fastsim([a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load], nx, ny, forces, &
                             status)
        fx = forces(1)
        fy = forces(2)
        mz = forces(3)
        info = status%code
    end subroutine fstsim

    !> CALL FSKALK(AOVERB, PNU, C, INFO)
    !>
    !> Kalker's coefficients C11, C22, C23, C33 of an ellipse.
    subroutine fskalk(a_over_b, nu, c, info) bind(c, name='fskalk_')
        real(c_double), intent(in) :: a_over_b !! semi-axis along x over that along y
        real(c_double), intent(in) :: nu       !! combined Poisson's ratio
        real(c_double), intent(out) :: c(4)    !! C11, C22, C23, C33
        integer(c_int), intent(out) :: info    !! status

        type(status_t) :: status

        call classic_kalker(a_over_b, nu, c, status)
        info = status%code
    end subroutine fskalk

    !> CALL FSHERZ(PAR, AX, BY, FN, A, B, PEN, PMAX, INFO)
    !>
    !> Hertz's ellipse of the gap AX x^2 + BY y^2; PAR as elsewhere, of which the first four count.
    subroutine fsherz(par, inv2r_x, inv2r_y, load, a, b, penetration, pmax, info) &
        bind(c, name='fsherz_')
        real(c_double), intent(in) :: par(4)             !! moduli, MPa, and Poisson's ratios
        real(c_double), intent(in) :: inv2r_x, inv2r_y   !! 1/mm
        real(c_double), intent(in) :: load               !! normal force, N
        real(c_double), intent(out) :: a, b, penetration !! mm
        real(c_double), intent(out) :: pmax              !! MPa
        integer(c_int), intent(out) :: info              !! status

        type(status_t) :: status
        real(c_double) :: figures(4)

        call classic_hertz(par, inv2r_x, inv2r_y, load, figures, status)
        a = figures(1)
        b = figures(2)
        penetration = figures(3)
        pmax = figures(4)
        info = status%code
    end subroutine fsherz

    !> CALL FSPROF(NW, YW, ZW, NR, YR, ZR, SETUP, LGAP, NGAP, Y, H, AX, TURN, CONT, INFO)
    !>
    !> The gap of a wheel on a rail, both given by points along the curve, y to the field side, z
    !> down, of the wheel from the nominal rolling circle. SETUP: distance of the flange backs (0:
    !> as belongs to the gauge), flange back to nominal rolling circle, rolling radius, gauge, its
    !> depth below the crown, rail inclination (its tangent; 0: as in the track), shift to the
    !> right, spacing and height of the gap. CONT: contact angle, rolling radius, y on the wheel and
    !> on the rail, points left out of the wheel and of the rail. INFO 110: LGAP below NGAP.
    subroutine fsprof(n_wheel, y_wheel, z_wheel, n_rail, y_rail, z_rail, setup, capacity, n, y, h, &
                      inv2r, inclination, contact, info) bind(c, name='fsprof_')
        integer(c_int), intent(in) :: n_wheel                         !! number of points
        real(c_double), intent(in) :: y_wheel(n_wheel), z_wheel(n_wheel) !! mm
        integer(c_int), intent(in) :: n_rail                          !! number of points
        real(c_double), intent(in) :: y_rail(n_rail), z_rail(n_rail)  !! mm
        real(c_double), intent(in) :: setup(n_setup)                  !! as above
        integer(c_int), intent(in) :: capacity                        !! of the arrays of the gap
        integer(c_int), intent(out) :: n                              !! points of the gap
        real(c_double), intent(inout) :: y(capacity), h(capacity)     !! mm
        real(c_double), intent(inout) :: inv2r(capacity)              !! 1/mm
        real(c_double), intent(inout) :: inclination(capacity)        !! rad
        real(c_double), intent(out) :: contact(n_contact)             !! as above
        integer(c_int), intent(out) :: info                           !! status

        call fsrprf(0.0_c_double, n_wheel, y_wheel, z_wheel, n_rail, y_rail, z_rail, setup, &
                    capacity, n, y, h, inv2r, inclination, contact, info)
    end subroutine fsprof

    !> CALL FSRPRF(RADIUS, NW, YW, ZW, NR, YR, ZR, SETUP, LGAP, NGAP, Y, H, AX, TURN, CONT, INFO)
    !>
    !> FSPROF on a roller of RADIUS (mm, at the crown) in the rail's place; 0: on a rail.
    subroutine fsrprf(radius, n_wheel, y_wheel, z_wheel, n_rail, y_rail, z_rail, setup, capacity, &
                      n, y, h, inv2r, inclination, contact, info) bind(c, name='fsrprf_')
        real(c_double), intent(in) :: radius                          !! mm
        integer(c_int), intent(in) :: n_wheel                         !! number of points
        real(c_double), intent(in) :: y_wheel(n_wheel), z_wheel(n_wheel) !! mm
        integer(c_int), intent(in) :: n_rail                          !! number of points
        real(c_double), intent(in) :: y_rail(n_rail), z_rail(n_rail)  !! mm
        real(c_double), intent(in) :: setup(n_setup)                  !! as above
        integer(c_int), intent(in) :: capacity                        !! of the arrays of the gap
        integer(c_int), intent(out) :: n                              !! points of the gap
        real(c_double), intent(inout) :: y(capacity), h(capacity)     !! mm
        real(c_double), intent(inout) :: inv2r(capacity)              !! 1/mm
        real(c_double), intent(inout) :: inclination(capacity)        !! rad
        real(c_double), intent(out) :: contact(n_contact)             !! as above
        integer(c_int), intent(out) :: info                           !! status

        type(status_t) :: status
        type(gap_t) :: gap

        call gap_of_points(y_wheel, z_wheel, y_rail, z_rail, setup, gap, contact, status, radius)
        call copy_gap(gap, y, h, inv2r, inclination, n, status)
        info = status%code
    end subroutine fsrprf

    !> CALL FSDFLT(IOPT, PAR)
    !>
    !> Steel on steel, mu 0.3, strips and FASTSTRIP; load and creepages zero.
    subroutine fsdflt(iopt, par) bind(c, name='fsdflt_')
        integer(c_int), intent(out) :: iopt(n_iopt) !! choices
        real(c_double), intent(out) :: par(n_par)   !! numbers

        call default_rows(iopt, par)
    end subroutine fsdflt

    !> CALL FSINIT(IOPT, MPTS, IWORK, LIWORK, INFO)
    !>
    !> Make a workspace for gaps of up to MPTS points and the methods of IOPT. With LIWORK = -1 only
    !> IWORK(1) is set, to the length of IWORK that is needed.
    subroutine fsinit(iopt, max_points, iwork, liwork, info) bind(c, name='fsinit_')
        integer(c_int), intent(in) :: iopt(n_iopt)  !! choices
        integer(c_int), intent(in) :: max_points    !! most points of a gap
        integer(c_int), intent(inout) :: iwork(*)   !! the caller's workspace array
        integer(c_int), intent(in) :: liwork        !! its length, or -1
        integer(c_int), intent(out) :: info         !! status

        type(status_t) :: status
        integer(c_intptr_t) :: number

        info = 0
        if (liwork == -1) then
            iwork(1) = n_iwork
            return
        end if
        if (liwork < n_iwork) then
            info = st_workspace_too_small
            return
        end if
        iwork(:n_iwork) = 0
        call check_choices(iopt, status)
        info = status%code
        if (is_error(status)) return
        call new_handle(methods_of(iopt), max_points, iopt(9) /= 0, number, status)
        info = status%code
        if (is_error(status)) return
        call set_number(iwork(:n_iwork), number)
    end subroutine fsinit

    !> CALL FSGAP(IWORK, N, Y, H, A, INFO)
    !>
    !> Hand over the gap that the next calls of FSSOLV are for: h(x, y) = H + A x^2 at Y.
    subroutine fsgap(iwork, n, y, h, a, info) bind(c, name='fsgap_')
        integer(c_int), intent(in) :: iwork(n_iwork)      !! made by FSINIT
        integer(c_int), intent(in) :: n                   !! number of points
        real(c_double), intent(in) :: y(*), h(*), a(*)    !! mm, mm, 1/mm
        integer(c_int), intent(out) :: info               !! status

        type(handle_t), pointer :: handle

        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_count(handle%status, n, 'gap points')
        if (.not. is_error(handle%status)) call handle_gap(handle, y(:n), h(:n), a(:n))
        info = handle%status%code
    end subroutine fsgap

    !> CALL FSGAPT(IWORK, N, Y, H, A, TURN, INFO)
    !>
    !> The same with the inclination TURN of the surfaces, rad, as FSPROF gives it: contacts that
    !> turn far are named then, and may lie on the curved surface (FSCURV).
    subroutine fsgapt(iwork, n, y, h, a, inclination, info) bind(c, name='fsgapt_')
        integer(c_int), intent(in) :: iwork(n_iwork)      !! made by FSINIT
        integer(c_int), intent(in) :: n                   !! number of points
        real(c_double), intent(in) :: y(*), h(*), a(*)    !! mm, mm, 1/mm
        real(c_double), intent(in) :: inclination(*)      !! rad
        integer(c_int), intent(out) :: info               !! status

        type(handle_t), pointer :: handle

        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_count(handle%status, n, 'gap points')
        if (.not. is_error(handle%status)) &
            call handle_gap(handle, y(:n), h(:n), a(:n), inclination(:n))
        info = handle%status%code
    end subroutine fsgapt

    !> Refuse a number of things that is none.
    subroutine check_count(status, n, what)
        type(status_t), intent(out) :: status !! `st_bad_argument`
        integer(c_int), intent(in) :: n       !! how many the caller says there are
        character(len=*), intent(in) :: what  !! things, in the plural

        call clear_status(status)
        if (n < 0) call set_status(status, st_bad_argument, 'the number of ' // what // &
                                   ' must not be negative, got ' // count_text(n))
    end subroutine check_count

    !> CALL FSSOLV(IWORK, IOPT, PAR, RES, INFO)
    !>
    !> Solve one contact on the gap that was handed over.
    subroutine fssolv(iwork, iopt, par, res, info) bind(c, name='fssolv_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! with a gap
        integer(c_int), intent(in) :: iopt(n_iopt)   !! choices
        real(c_double), intent(in) :: par(n_par)     !! numbers
        real(c_double), intent(out) :: res(n_res)    !! figures; zero when there is an error
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        res = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_choices(iopt, handle%status)
        info = handle%status%code
        if (is_error(handle%status)) return
        call fill_case(iopt, par, handle%case)
        call handle_solve(handle)
        info = handle%status%code
        if (.not. is_error(handle%status)) res = res_of(handle)
    end subroutine fssolv

    !> CALL FSCONT(IWORK, N, Y, H, A, IOPT, PAR, RES, INFO)
    !>
    !> FSGAP and FSSOLV in one.
    subroutine fscont(iwork, n, y, h, a, iopt, par, res, info) bind(c, name='fscont_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSINIT
        integer(c_int), intent(in) :: n                !! number of points
        real(c_double), intent(in) :: y(*), h(*), a(*) !! mm, mm, 1/mm
        integer(c_int), intent(in) :: iopt(n_iopt)     !! choices
        real(c_double), intent(in) :: par(n_par)       !! numbers
        real(c_double), intent(out) :: res(n_res)      !! figures; zero when there is an error
        integer(c_int), intent(out) :: info            !! status

        res = 0.0_c_double
        call fsgap(iwork, n, y, h, a, info)
        if (info == 0) call fssolv(iwork, iopt, par, res, info)
    end subroutine fscont

    !> CALL FSSTRP(IWORK, M, N, YL, YR, XD, P0, IPATCH, INFO)
    !>
    !> The strips of the last contact.
    subroutine fsstrp(iwork, capacity, n, y_left, y_right, half_length, p0, patch, info) &
        bind(c, name='fsstrp_')
        integer(c_int), intent(in) :: iwork(n_iwork)         !! with a solution
        integer(c_int), intent(in) :: capacity                   !! length of the arrays
        integer(c_int), intent(out) :: n                     !! number of strips
        real(c_double), intent(inout) :: y_left(*), y_right(*) !! edges, mm
        real(c_double), intent(inout) :: half_length(*)      !! mm
        real(c_double), intent(inout) :: p0(*)               !! pressure on the centre line, MPa
        integer(c_int), intent(inout) :: patch(*)            !! number of the patch
        integer(c_int), intent(out) :: info                  !! status

        type(handle_t), pointer :: handle

        n = 0
        call find_handle(number_of(iwork), handle, info)
        if (associated(handle)) &
            call copy_strips(handle%workspace, mirror_t(), capacity, n, y_left, y_right, &
                             half_length, p0, patch, info)
    end subroutine fsstrp

    !> The strips of a solution, unless the arrays are too short.
    subroutine copy_strips(workspace, mirror, capacity, n, y_left, y_right, half_length, p0, &
                           patch, info)
        type(workspace_t), intent(in) :: workspace             !! of the solution
        type(mirror_t), intent(in) :: mirror                   !! that it was solved in
        integer(c_int), intent(in) :: capacity                 !! length of the arrays
        integer(c_int), intent(out) :: n                       !! number of strips
        real(c_double), intent(inout) :: y_left(*), y_right(*) !! edges, mm
        real(c_double), intent(inout) :: half_length(*)        !! mm
        real(c_double), intent(inout) :: p0(*)                 !! on the centre line, MPa
        integer(c_int), intent(inout) :: patch(*)              !! number of the patch
        integer(c_int), intent(inout) :: info                  !! status

        n = strip_count(workspace)
        if (capacity < n) then
            info = st_workspace_too_small
        else
            call read_strips(workspace, mirror, y_left(:n), y_right(:n), half_length(:n), p0(:n), &
                             patch(:n))
        end if
    end subroutine copy_strips

    !> CALL FSELEM(IWORK, M, N, X, Y, AREA, PN, PX, PY, SX, SY, ISTATE, INFO)
    !>
    !> The elements of the last contact, if IOPT(9) asked for them.
    subroutine fselem(iwork, capacity, n, x, y, area, pn, px, py, sx, sy, state, info) &
        bind(c, name='fselem_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! with a solution
        integer(c_int), intent(in) :: capacity             !! length of the arrays
        integer(c_int), intent(out) :: n               !! number of elements
        real(c_double), intent(inout) :: x(*), y(*)    !! middle of the element, mm
        real(c_double), intent(inout) :: area(*)       !! mm^2
        real(c_double), intent(inout) :: pn(*)         !! pressure, MPa
        real(c_double), intent(inout) :: px(*), py(*)  !! traction on the rail, MPa
        real(c_double), intent(inout) :: sx(*), sy(*)  !! slip over rolling speed
        integer(c_int), intent(inout) :: state(*)      !! 1 adhesion, 2 slip
        integer(c_int), intent(out) :: info            !! status

        type(handle_t), pointer :: handle

        n = 0
        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        n = handle%workspace%field%n
        if (capacity < n) info = st_workspace_too_small
        if (n > 0 .and. capacity >= n) &
            call read_elements(handle%workspace, mirror_t(), x(:n), y(:n), area(:n), pn(:n), &
                               px(:n), py(:n), sx(:n), sy(:n), state(:n))
    end subroutine fselem

    !> CALL FSLIMT(IWORK, IEST, RLIM, INFO)
    !>
    !> Set for all further calls of FSSOLV whether errors are estimated, and from which estimated
    !> error on they say so (8, under_resolved): relative, of the forces over mu N, of the moment
    !> over mu N c. FSINIT sets 1 and 0.1. After an error both are as they were.
    subroutine fslimt(iwork, estimate, limit, info) bind(c, name='fslimt_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT
        integer(c_int), intent(in) :: estimate       !! are errors estimated? 0 means no
        real(c_double), intent(in) :: limit          !! above 0
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        call check_resolution(limit, 'the resolution limit', handle%status)
        info = handle%status%code
        if (is_error(handle%status)) return
        handle%case%estimate = estimate /= 0
        handle%case%resolution_limit = limit
        handle%case%force_limit = limit
    end subroutine fslimt

    !> CALL FSCURV(IWORK, ICURV, INFO)
    !>
    !> Set for all further calls of FSSOLV or FSWSLV whether strips lie on a curved surface, each
    !> with its own plane (ICURV 1), or in the plane of the contact (0, as FSINIT and FSWNEW set).
    subroutine fscurv(iwork, curved, info) bind(c, name='fscurv_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: curved         !! as above
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset

        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) handle%case%curved = curved /= 0
        if (associated(wheelset)) then
            wheelset%model%case%curved = curved /= 0
            call forget_asked(wheelset)
        end if
    end subroutine fscurv

    !> CALL FSERRS(IWORK, ERR, INFO)
    !>
    !> The estimated errors of the last contact; zeros if there was none.
    subroutine fserrs(iwork, err, info) bind(c, name='fserrs_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! with a solution
        real(c_double), intent(out) :: err(n_err)    !! estimates
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        err = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (associated(handle)) err = err_of(handle)
    end subroutine fserrs

    !> CALL FSFERR(IWORK, FERR, INFO)
    !>
    !> The estimated errors of the last contact's forces; zeros if they are not known.
    subroutine fsferr(iwork, ferr, info) bind(c, name='fsferr_')
        integer(c_int), intent(in) :: iwork(n_iwork)     !! with a solution
        real(c_double), intent(out) :: ferr(n_ferr)      !! estimates, and whether they are known
        integer(c_int), intent(out) :: info              !! status

        type(handle_t), pointer :: handle

        ferr = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (associated(handle)) ferr = ferr_of(handle)
    end subroutine fsferr

    !> CALL FSLSET(IWORK, LSET, INFO)
    !>
    !> All limitations of the last contact, of which INFO of FSSOLV is the first; zero if there was
    !> none.
    subroutine fslset(iwork, lset, info) bind(c, name='fslset_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! with a solution
        integer(c_int), intent(out) :: lset          !! 2**INFO of each, added up
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        lset = 0
        call find_handle(number_of(iwork), handle, info)
        if (associated(handle)) lset = handle%limitations
    end subroutine fslset

    !> CALL FSWANT(IWORK, ITARG, TOL, BUDGET, INFO)
    !>
    !> Set for all further calls of FSSOLV or FSWSLV with IOPT(1) = 6 which figure is wanted, its
    !> largest estimated error, as FERR and ERR have it, and how long it may take. FSINIT and FSWNEW
    !> set 1, 0.02 and 0. After an error all are as they were.
    subroutine fswant(iwork, target, tolerance, budget_us, info) bind(c, name='fswant_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSINIT or FSWNEW
        integer(c_int), intent(in) :: target         !! `ITARG`
        real(c_double), intent(in) :: tolerance      !! at 0 the least within the budget
        real(c_double), intent(in) :: budget_us      !! us; 0: as long as it takes
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        type(wanted_t) :: wanted
        type(status_t) :: status

        call find_either(iwork, handle, wheelset, info)
        if (info /= st_ok) return
        wanted = wanted_t(target=target, tolerance=tolerance, budget_us=budget_us)
        ! FSSOLV has the tangential method and says whether it serves the target.
        call check_wanted(wanted, tangential_faststrip, status)
        info = status%code
        if (associated(handle)) then
            handle%status = status
            if (.not. is_error(status)) handle%case%wanted = wanted
        else
            wheelset%status = status
            if (.not. is_error(status)) wheelset%model%case%wanted = wanted
            call forget_asked(wheelset)
        end if
    end subroutine fswant

    !> CALL FSTAKN(IWORK, TAKN, INFO)
    !>
    !> What came of the last contact by auto; zeros if there was none.
    subroutine fstakn(iwork, takn, info) bind(c, name='fstakn_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! with a solution
        real(c_double), intent(out) :: takn(n_takn)  !! as above
        integer(c_int), intent(out) :: info          !! status

        type(handle_t), pointer :: handle

        takn = 0.0_c_double
        call find_handle(number_of(iwork), handle, info)
        if (associated(handle)) takn = takn_of(handle)
    end subroutine fstakn

    !> CALL FSSTEP(IWORK, M, N, INORM, ITANG, NSTRIP, NPOINT, EST, TNORM, TTANG, INFO)
    !>
    !> The steps of the last contact by auto.
    subroutine fsstep(iwork, capacity, n, normal, tangential, strips, points, estimate, &
                      normal_us, tangential_us, info) bind(c, name='fsstep_')
        integer(c_int), intent(in) :: iwork(n_iwork)      !! with a solution
        integer(c_int), intent(in) :: capacity            !! length of the arrays
        integer(c_int), intent(out) :: n                  !! number of steps
        integer(c_int), intent(inout) :: normal(*)        !! method, as IOPT(1)
        integer(c_int), intent(inout) :: tangential(*)    !! method, as IOPT(2)
        integer(c_int), intent(inout) :: strips(*)        !! strips across the widest patch
        integer(c_int), intent(inout) :: points(*)        !! points along a strip
        real(c_double), intent(inout) :: estimate(*)
            !! estimated error of what was wanted, -1 where it is not known
        real(c_double), intent(inout) :: normal_us(*)     !! time of the pressures, us
        real(c_double), intent(inout) :: tangential_us(*) !! of the forces, us
        integer(c_int), intent(out) :: info               !! status

        type(handle_t), pointer :: handle

        n = 0
        call find_handle(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        n = handle%workspace%steps%n
        if (capacity < n) then
            info = st_workspace_too_small
            return
        end if
        call read_steps(handle%workspace, normal(:n), tangential(:n), strips(:n), points(:n), &
                        estimate(:n), normal_us(:n), tangential_us(:n))
    end subroutine fsstep

    !> CALL FSCOPY(IFROM, ITO, INFO)
    !>
    !> Copy gap and solution of one workspace into another, and what FSLIMT and FSWANT set, for a
    !> step that may be taken back.
    subroutine fscopy(from, to, info) bind(c, name='fscopy_')
        integer(c_int), intent(in) :: from(n_iwork) !! made by FSINIT
        integer(c_int), intent(in) :: to(n_iwork)   !! made by another call of FSINIT
        integer(c_int), intent(out) :: info         !! status

        type(handle_t), pointer :: source, target

        call find_handle(number_of(from), source, info)
        if (.not. associated(source)) return
        call find_handle(number_of(to), target, info)
        if (.not. associated(target)) return
        if (.not. associated(source, target)) call copy_handle(source, target)
    end subroutine fscopy

    !> CALL FSFREE(IWORK, INFO)
    !>
    !> Free what FSINIT allocated.
    subroutine fsfree(iwork, info) bind(c, name='fsfree_')
        integer(c_int), intent(inout) :: iwork(n_iwork) !! made by FSINIT; zero afterwards
        integer(c_int), intent(out) :: info             !! status

        type(status_t) :: status

        call free_handle(number_of(iwork), status)
        info = status%code
        iwork = 0
    end subroutine fsfree

    !> CALL FSMSG(INFO, TEXT)
    !>
    !> The word of a status.
    subroutine fsmsg(info, text, length) bind(c, name='fsmsg_')
        integer(c_int), intent(in) :: info                         !! status of a call
        character(kind=c_char), intent(out) :: text(*)             !! CHARACTER*(*), blank-padded
        integer(c_size_t), value :: length                         !! passed by the compiler

        call put_text(trim(status_word(info)), text, length)
    end subroutine fsmsg

    !> CALL FSLAST(IWORK, TEXT)
    !>
    !> The words of the last call of a workspace, also of FSWNEW, with the offending value; blank
    !> when all was well.
    subroutine fslast(iwork, text, length) bind(c, name='fslast_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSINIT
        character(kind=c_char), intent(out) :: text(*) !! CHARACTER*(*), blank-padded
        integer(c_size_t), value :: length             !! passed by the compiler

        type(handle_t), pointer :: handle
        type(wheelset_handle_t), pointer :: wheelset
        integer(c_int) :: info

        call find_either(iwork, handle, wheelset, info)
        if (associated(handle)) then
            call put_text(trim(handle%status%message), text, length)
        else if (associated(wheelset)) then
            call put_text(trim(wheelset%status%message), text, length)
        else
            call put_text('no workspace, or one that was freed', text, length)
        end if
    end subroutine fslast

    !> CALL FSINTS(IONES, INFO)
    !>
    !> Is the caller's INTEGER four bytes long, as all of the library's are? IONES holds two ones.
    !> INFO, 0 or 100, is as long as the caller has it.
    subroutine fsints(ones, info) bind(c, name='fsints_')
        integer(c_int), intent(in) :: ones(2)     !! two numbers as the caller has them, both 1
        integer(c_int), intent(inout) :: info(*)  !! status

        if (all(ones == 1)) then
            info(1) = st_ok
        else
            info(:2) = transfer(int(st_bad_argument, c_int64_t), info(:2))
        end if
    end subroutine fsints

    !> Refuse choices that cannot be of an INTEGER of four bytes: of longer ones every second number
    !> is the upper half of the one before.
    pure subroutine check_choices(iopt, status)
        integer(c_int), intent(in) :: iopt(n_iopt) !! as the caller passed them
        type(status_t), intent(out) :: status      !! `st_bad_argument`

        call clear_status(status)
        if (any(iopt(7:) < 0 .or. iopt(7:) > 1) .or. iopt(5) > 0 .and. iopt(6) == 0) &
            call set_status(status, st_bad_argument, 'IOPT(7) to IOPT(9) must be 0 or 1, and ' // &
                            'FASTSIM must have rows; INTEGER must be four bytes, see FSINTS')
    end subroutine check_choices

    !> What a workspace array stands for: one of both, or an error.
    subroutine find_either(iwork, handle, wheelset, info)
        integer(c_int), intent(in) :: iwork(n_iwork)                 !! made by FSINIT or FSWNEW
        type(handle_t), pointer, intent(out) :: handle               !! of FSINIT, or null
        type(wheelset_handle_t), pointer, intent(out) :: wheelset    !! of FSWNEW, or null
        integer(c_int), intent(out) :: info                          !! status

        call find_handle(number_of(iwork), handle, info)
        wheelset => null()
        if (info /= st_ok) call find_wheelset(number_of(iwork), wheelset, info)
    end subroutine find_either

    !> Put the number of a handle between its marks.
    pure subroutine set_number(iwork, number)
        integer(c_int), intent(out) :: iwork(n_iwork) !! the caller's workspace array
        integer(c_intptr_t), intent(in) :: number     !! of the handle

        iwork(1) = first_mark
        iwork(2:n_iwork - 1) = transfer([number, 0_c_intptr_t, 0_c_intptr_t], iwork(:1), &
                                         n_iwork - 2)
        iwork(n_iwork) = last_mark
    end subroutine set_number

    !> The number between the marks; 0 if there are none.
    pure integer(c_intptr_t) function number_of(iwork)
        integer(c_int), intent(in) :: iwork(n_iwork) !! the caller's workspace array

        number_of = 0
        if (iwork(1) == first_mark .and. iwork(n_iwork) == last_mark) &
            number_of = transfer(iwork(2:n_iwork - 1), number_of)
    end function number_of

    subroutine put_text(words, text, length)
        character(len=*), intent(in) :: words
        character(kind=c_char), intent(inout) :: text(*)
        integer(c_size_t), intent(in) :: length

        integer(c_size_t) :: i

        do i = 1, length
            text(i) = ' '
            if (i <= len(words)) text(i) = words(i:i)
        end do
    end subroutine put_text
end module faststrip_interop_f77
