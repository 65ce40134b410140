!> The wheelsets of the F77 interface, with the conventions of `faststrip_interop_f77`: `IOPT` and
!> `PAR` from there, of which methods, material and friction count; `IWORK` is as long as FSINIT
!> says.
!>
!> ```
!> SETUP(1), SETUP(2) nominal radius of the right and left wheel, mm
!> SETUP(3) distance of the flange backs, mm; 0: as belongs to the gauge (1435 or 1520 mm)
!> SETUP(4) flange back to nominal rolling circle, mm
!> SETUP(5) gauge, mm                                  SETUP(6) its depth below the crown, mm
!> SETUP(7) distance of the origins of the rails' profiles, mm; 0: as the gauge says
!> SETUP(8) rail inclination, its tangent, .025 for 1:40, 0 for points as they lie in the track;
!>        999: not said, 1:40 of standard profiles, an error (100) of points
!> SETUP(9) limit of estimated errors; 0: none
!> NPROF(1), NPROF(2) points of the right and left wheel, NPROF(3), NPROF(4) of the rails; a left
!>        one of 0 is as the right one; or, below 0, a standard profile: wheels -1 S1002, -2 a cone
!>        of 1:20, -3 of 1:40; rails -1 UIC60, -2 60E1, -3 54E1
!> YPROF, ZPROF their points, one profile after the other, as FSPROF takes them, mm
!> STATE(1) y, mm           STATE(2) z, mm             STATE(3) roll, right wheel down, rad
!> STATE(4) yaw, nose to the right, rad                STATE(5) speed, mm/s
!> STATE(6), STATE(7) rates of y and z, mm/s           STATE(8), STATE(9) of roll and yaw, rad/s
!> STATE(10) pitch rate, negative for rolling ahead, rad/s; 0: pure rolling at the mean nominal
!>        radius; 1D300: locked wheels, 0
!> STATE(11) curvature of the track, 1/mm
!> RAIL(1), RAIL(2) y and z of the right rail beside its place, mm      RAIL(3) its roll, rad
!> RAIL(4), RAIL(5) rates of y and z, mm/s     RAIL(6) of its roll, rad/s
!> RAIL(7) to RAIL(12) the same of the left rail
!> IDMND(1) prescribed are: 0 z and roll, 1 the vertical force of each wheel, 2 the axle load,
!>        3 the axle load at rest: static equilibrium, with the roll found
!> IDMND(2) wheels: 0 both, 1 right, 2 left            IDMND(3) 1: the roll is free, and found
!> IDMND(4) 1: warm start
!> DMND(1), DMND(2) vertical force of the right and left wheel, N      DMND(3) axle load, N
!> DMND(4) moment about the wheelset's centre along the track that the frame exerts on it, N mm
!> CONT(1,K) side of contact K: 1 right, 2 left        CONT(2,K) its status
!> CONT(3,K) patches        CONT(4,K) strips across    CONT(5,K) 1: CONT(42) to CONT(44) are known
!> CONT(6,K) 1: CONT(45) to CONT(47) are known         CONT(7) to CONT(9) place in the track, mm
!> CONT(10,K) contact angle, rad                       CONT(11), CONT(12) y, z on the rail, mm
!> CONT(13) to CONT(15) x, y, z on the wheel, mm       CONT(16,K) rolling radius, mm
!> CONT(17,K) rolling speed, mm/s                      CONT(18) to CONT(20) creepages, -, -, rad/mm
!> CONT(21,K) normal force, N       CONT(22,K) penetration, mm         CONT(23,K) area, mm^2
!> CONT(24,K) maximum pressure, MPa   CONT(25), CONT(26) ends, mm      CONT(27,K) half-length, mm
!> CONT(28), CONT(29) Fx, Fy in the tangent plane, N   CONT(30,K) Mz, N mm, all on the rail
!> CONT(31,K) friction power, N     CONT(32,K) share in adhesion
!> CONT(33) to CONT(35) force in the track, N
!> CONT(36) to CONT(38) the same in the wheelset's frame
!> CONT(39) to CONT(41) moment about the wheelset's centre in the track, N mm
!> CONT(42) to CONT(47) as ERR(1) to ERR(3), FERR(1) to FERR(3)
!> CONT(48) share of the normal force that .5 um of the profiles may move
!> WRES(1), WRES(2) z of the wheelset's centre, right and left, mm     WRES(3) roll, rad
!> WRES(4) to WRES(6) force on the right rail in the track, WRES(7) to WRES(9) on the left, N
!> WRES(10) to WRES(15) the same in the wheelset's frame
!> WRES(16) to WRES(21) moments about the wheelset's centre, N mm
!> WRES(22), WRES(23) status of each wheel             WRES(24), WRES(25) contacts
!> WRES(26), WRES(27) contact problems that were solved
!> ```
module faststrip_interop_f77_wheelset
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_ok, st_bad_argument, st_workspace_too_small
    use faststrip_contact_case, only: contact_case_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t
    use faststrip_interop_f77, only: n_iwork, check_choices, set_number, number_of, copy_strips
    use faststrip_interop_f77_rows, only: n_iopt, n_par, fill_case
    use faststrip_interop_solution, only: read_elements
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, free_wheelset, find_wheelset, &
                                                 take_wheels, wheelset_solve, contact_place, &
                                                 find_contact, contact_mirror, copy_wheelset, &
                                                 use_lookup, forget_asked, &
                                                 pitch_rate_of
    use faststrip_interop_wheelset_new, only: dimensions_t, profile_source_t, &
                                              default_dimensions, new_wheelset
    use faststrip_wheelset_model, only: set_damping, set_rail_stiffness, set_roller, &
                                        reserve_wheelset
    use faststrip_wheelset_types, only: wheelset_demand_t, side_right, side_left
    implicit none
    private

    public :: fswdft, fswnew, fsrail, fsptch, fsaxle, fsprat, fsdamp, fsspri, fsroll, fswslv, &
              fswset, fswstr, fswelm, fswlkp
    public :: fswcpy, fswfre
    public :: n_setup, read_dimensions, read_sources, find_column

    ! Lengths of the rows above.
    integer, parameter :: n_setup = 9, n_state = 11, n_rails = 12, n_idmnd = 4, n_dmnd = 4, &
                          n_cont = 48, n_wres = 27
    ! Given: names of profiles, in the order of their numbers.
    character(len=6), parameter :: wheel_names(3) = ['s1002 ', 'cone20', 'cone40']
    character(len=6), parameter :: rail_names(3) = ['uic60 ', '60e1  ', '54e1  ']

contains

    !> CALL FSWDFT(SETUP)
    !>
    !> Standard gauge, wheels of 460 mm, no word of the rails' inclination.
    subroutine fswdft(setup) bind(c, name='fswdft_')
        real(c_double), intent(out) :: setup(n_setup) !! as above

        type(contact_case_t) :: case

        associate (d => default_dimensions())
            setup = [d%radius_right, d%radius_left, d%back_spacing, d%tread_line, d%gauge, &
                     d%gauge_depth, d%rail_distance, d%inclination, case%resolution_limit]
        end associate
    end subroutine fswdft

    !> CALL FSWNEW(IOPT, PAR, SETUP, NPROF, YPROF, ZPROF, IWORK, LIWORK, INFO)
    !>
    !> Make a wheelset on its track, by the methods of IOPT(1) to IOPT(6); IOPT(9) for FSWELM.
    subroutine fswnew(iopt, par, setup, n_profile, y_profile, z_profile, iwork, liwork, info) &
        bind(c, name='fswnew_')
        integer(c_int), intent(in) :: iopt(n_iopt)     !! choices
        real(c_double), intent(in) :: par(n_par)       !! numbers
        real(c_double), intent(in) :: setup(n_setup)   !! as above
        integer(c_int), intent(in) :: n_profile(4)     !! as above
        real(c_double), intent(in), target :: y_profile(*), z_profile(*) !! mm
        integer(c_int), intent(inout) :: iwork(*)      !! the caller's workspace array
        integer(c_int), intent(in) :: liwork           !! its length
        integer(c_int), intent(out) :: info            !! status

        type(profile_source_t) :: sources(4)
        type(contact_case_t) :: case
        type(status_t) :: status
        integer(c_intptr_t) :: number

        info = st_workspace_too_small
        if (liwork < n_iwork) return
        iwork(:n_iwork) = 0
        call check_choices(iopt, status)
        if (.not. is_error(status)) &
            call read_sources(n_profile, y_profile, z_profile, sources, status)
        info = status%code
        if (is_error(status)) return
        call fill_case(iopt, par, case)
        case%estimate = abs(setup(n_setup)) > 0.0_c_double
        if (case%estimate) then
            case%resolution_limit = setup(n_setup)
            case%force_limit = setup(n_setup)
        end if
        call new_wheelset(sources(:2), sources(3:), read_dimensions(setup), case, number, status)
        info = status%code
        if (.not. is_error(status)) call set_number(iwork(:n_iwork), number)
    end subroutine fswnew

    !> Dimensions of a wheelset on its track.
    pure type(dimensions_t) function read_dimensions(setup) result(dimensions)
        real(c_double), intent(in) :: setup(n_setup) !! as above

        dimensions = dimensions_t(setup(1), setup(2), setup(3), setup(4), setup(5), setup(6), &
                                  setup(7), setup(8), 0.0_c_double)
    end function read_dimensions

    !> Where the profiles of wheels and rails come from.
    subroutine read_sources(n_profile, y_profile, z_profile, sources, status)
        integer(c_int), intent(in) :: n_profile(4)           !! as above
        real(c_double), intent(in), target :: y_profile(*), z_profile(*) !! mm
        type(profile_source_t), intent(out) :: sources(4)    !! wheels and rails, right and left
        type(status_t), intent(out) :: status                !! `st_bad_argument`

        integer :: i, first

        call clear_status(status)
        first = 1
        do i = 1, size(sources)
            associate (n => n_profile(i))
                if (n > 0) then
                    sources(i)%y => y_profile(first:first + n - 1)
                    sources(i)%z => z_profile(first:first + n - 1)
                    first = first + n
                else if (n < -size(wheel_names)) then
                    call set_status(status, st_bad_argument, 'no such standard profile: ' // &
                                    count_text(n))
                else if (n < 0) then
                    sources(i)%name = merge(wheel_names(-n), rail_names(-n), i <= 2)
                end if
            end associate
        end do
    end subroutine read_sources

    !> CALL FSRAIL(IWORK, RAIL, INFO)
    !>
    !> Say for all further calls of FSWSLV where the rails lie and how they move; FSWNEW sets zeros.
    subroutine fsrail(iwork, rail, info) bind(c, name='fsrail_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(in) :: rail(n_rails)  !! as above
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        handle%rail = [rail_state_t(rail(1), rail(2), rail(3), rail(4), rail(5), rail(6)), &
                       rail_state_t(rail(7), rail(8), rail(9), rail(10), rail(11), rail(12))]
    end subroutine fsrail

    !> CALL FSPTCH(IWORK, DPITCH, INFO)
    !>
    !> Say for all further calls of FSWSLV, of wheels that rotate independently, the pitch rate of
    !> the left wheel less that of the right one; STATE(10) is their mean. FSWNEW sets 0.
    subroutine fsptch(iwork, difference, info) bind(c, name='fsptch_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(in) :: difference     !! rad/s
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info == st_ok) handle%pitch_rate_difference = difference
    end subroutine fsptch

    !> CALL FSAXLE(IWORK, IGIVEN, AXLMOM, INFO)
    !>
    !> Say for all further calls of FSWSLV the moment about the axle that a drive or brake exerts on
    !> the wheelset, negative to drive ahead: the wheels asked for carry it together, at a pitch
    !> rate that is found (FSPRAT); STATE(10) must be 0. FSWNEW sets none.
    subroutine fsaxle(iwork, is_given, moment, info) bind(c, name='fsaxle_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        integer(c_int), intent(in) :: is_given       !! 1 if it is given, 0 if none is
        real(c_double), intent(in) :: moment         !! N mm
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        handle%axle_moment_is_given = is_given /= 0
        handle%axle_moment = moment
    end subroutine fsaxle

    !> CALL FSPRAT(IWORK, PITCH, INFO)
    !>
    !> The pitch rate of the last solution: as given, of pure rolling, or found.
    subroutine fsprat(iwork, pitch_rate, info) bind(c, name='fsprat_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(out) :: pitch_rate    !! rad/s; 0 where there is no solution
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        pitch_rate = 0.0_c_double
        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        if (any(handle%has)) pitch_rate = handle%result%pitch_rate
    end subroutine fsprat

    !> CALL FSDAMP(IWORK, DAMP, VFLOOR, INFO)
    !>
    !> Set contact damping and the floor of the rolling speed: forces grow by DAMP times the
    !> approach rate, but never pull (Hunt and Crossley, 3/2 alpha); well below VFLOOR friction
    !> grows with the slip velocities. FSWNEW sets 0, none. After an error both are as they were.
    subroutine fsdamp(iwork, damping, speed_floor, info) bind(c, name='fsdamp_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(in) :: damping        !! s/mm
        real(c_double), intent(in) :: speed_floor    !! mm/s
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call set_damping(handle%model, damping, speed_floor, handle%status)
        call forget_asked(handle)
        info = handle%status%code
    end subroutine fsdamp

    !> CALL FSSPRI(IWORK, STIFFY, STIFFZ, INFO)
    !>
    !> Set springs below each rail, along y and z: a rail without mass is displaced by the force
    !> over the stiffness, beside where FSRAIL has it; 0: rigid. FSWNEW sets 0. After an error both
    !> are as they were.
    subroutine fsspri(iwork, stiffness_y, stiffness_z, info) bind(c, name='fsspri_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(in) :: stiffness_y    !! N/mm
        real(c_double), intent(in) :: stiffness_z    !! N/mm
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call set_rail_stiffness(handle%model, [stiffness_y, stiffness_z], handle%status)
        call forget_asked(handle)
        info = handle%status%code
    end subroutine fsspri

    !> CALL FSROLL(IWORK, RADIUS, INFO)
    !>
    !> Put the wheelset on rollers in the rails' place, both on one axis along y: RADIUS (mm) is
    !> that at z = 0 of the track, the crown where the gauge is given; STATE(5) is the speed of the
    !> surface there. 0: rails, as FSWNEW has them. Allocates.
    subroutine fsroll(iwork, radius, info) bind(c, name='fsroll_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        real(c_double), intent(in) :: radius         !! mm
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call set_roller(handle%model, radius, handle%status)
        if (.not. is_error(handle%status)) then
            handle%has = .false.
            call reserve_wheelset(handle%workspace, handle%model, handle%status)
        end if
        info = handle%status%code
    end subroutine fsroll

    !> CALL FSWSLV(IWORK, STATE, IDMND, DMND, M, N, CONT, WRES, INFO)
    !>
    !> Solve the contacts of both wheels, those of the right one first. INFO 110: M below N.
    subroutine fswslv(iwork, state, idmnd, dmnd, capacity, n, cont, wres, info) &
        bind(c, name='fswslv_')
        integer(c_int), intent(in) :: iwork(n_iwork)    !! made by FSWNEW
        real(c_double), intent(in) :: state(n_state)    !! as above
        integer(c_int), intent(in) :: idmnd(n_idmnd)  !! as above
        real(c_double), intent(in) :: dmnd(n_dmnd)     !! as above
        integer(c_int), intent(in) :: capacity          !! contacts that CONT has columns for
        integer(c_int), intent(out) :: n                !! number of contacts
        real(c_double), intent(inout) :: cont(n_cont, *) !! as above, written up to N
        real(c_double), intent(out) :: wres(n_wres)     !! as above; zero when there is an error
        integer(c_int), intent(out) :: info             !! status

        type(wheelset_handle_t), pointer :: handle
        type(wheelset_demand_t) :: demand
        integer :: i

        n = 0
        wres = 0.0_c_double
        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        if (any(idmnd(3:) < 0 .or. idmnd(3:) > 1)) then
            call set_status(handle%status, st_bad_argument, 'IDMND(3) and IDMND(4) must be 0 or ' &
                            // '1; INTEGER must be four bytes, see FSINTS')
            handle%has = .false.
            info = handle%status%code
            return
        end if
        call take_wheels(handle, idmnd(2), demand%wants)
        if (.not. is_error(handle%status)) then
            demand%kind = idmnd(1)
            demand%load = dmnd(:2)
            demand%axle_load = dmnd(3)
            demand%roll_is_free = idmnd(3) /= 0
            demand%roll_moment = dmnd(4)
            demand%axle_moment_is_given = handle%axle_moment_is_given
            demand%axle_moment = handle%axle_moment
            call wheelset_solve(handle, state_of(state, handle), demand, idmnd(4) /= 0, &
                                capacity, n)
        end if
        if (.not. is_error(handle%status)) then
            do i = 1, n
                cont(:, i) = cont_of(handle, i)
            end do
        end if
        wres = wres_of(handle)
        info = handle%status%code
    end subroutine fswslv

    ! Position and velocity as the core has them.
    pure type(wheelset_state_t) function state_of(row, handle) result(state)
        real(c_double), intent(in) :: row(n_state)
        type(wheelset_handle_t), intent(in) :: handle

        state = wheelset_state_t(row(1), row(2), row(3), row(4), row(5), row(6), row(7), row(8), &
                                 row(9), pitch_rate_of(row(10)), handle%pitch_rate_difference, &
                                 row(11), handle%rail)
    end function state_of

    ! One contact of the last solution.
    pure function cont_of(handle, i) result(cont)
        type(wheelset_handle_t), intent(in) :: handle
        integer, intent(in) :: i
        real(c_double) :: cont(n_cont)

        integer :: side, k

        call contact_place(handle, i, side, k)
        associate (contact => handle%result%wheel(side)%contact(k))
            associate (normal => contact%figures%normal, forces => contact%figures%tangential, &
                       errors => contact%figures%normal_errors, creepage => contact%creepage, &
                       wrong => contact%figures%force_errors)
                cont = [real([side, contact%status%code, normal%n_patches, normal%strips_across, &
                              merge(1, 0, contact%figures%is_estimated), &
                              merge(1, 0, contact%figures%forces_are_estimated)], c_double), &
                        contact%place, contact%angle, contact%rail, contact%wheel, &
                        contact%radius, contact%speed, creepage%cksi, creepage%ceta, &
                        creepage%cphi, normal%load, normal%penetration, normal%area, &
                        normal%pmax, normal%y_min, normal%y_max, normal%x_max, forces%fx, &
                        forces%fy, forces%mz, forces%friction_power, forces%stick_fraction, &
                        contact%force, contact%force_wheelset, contact%moment, &
                        errors%est_err_penetration, errors%est_err_pmax, errors%est_err_area, &
                        wrong%fx, wrong%fy, wrong%mz, contact%est_err_load]
            end associate
        end associate
    end function cont_of

    ! What the wheels of the last solution came to; zeros where there was none.
    pure function wres_of(handle) result(wres)
        type(wheelset_handle_t), intent(in) :: handle
        real(c_double) :: wres(n_wres)

        integer :: side

        wres = 0.0_c_double
        do side = side_right, side_left
            if (.not. handle%has(side)) cycle
            associate (wheel => handle%result%wheel(side), of_side => 3*(side - 1))
                wres(side) = wheel%z
                wres(3) = wheel%roll
                wres(4 + of_side:6 + of_side) = wheel%force
                wres(10 + of_side:12 + of_side) = wheel%force_wheelset
                wres(16 + of_side:18 + of_side) = wheel%moment
                wres(21 + side:25 + side:2) = real([wheel%status%code, wheel%n, &
                                                    wheel%solutions], c_double)
            end associate
        end do
    end function wres_of

    !> CALL FSWSET(IWORK, K, LSET, INFO)
    !>
    !> All limitations of a contact of the last solution, of which CONT(2,K) is the first.
    subroutine fswset(iwork, k, lset, info) bind(c, name='fswset_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW, with a solution
        integer(c_int), intent(in) :: k              !! column of CONT
        integer(c_int), intent(out) :: lset          !! 2**INFO of each, added up
        integer(c_int), intent(out) :: info          !! status; 100: no such contact

        type(wheelset_handle_t), pointer :: handle
        integer :: side, i

        lset = 0
        call find_column(iwork, k, handle, side, i, info)
        if (info == st_ok) lset = handle%result%wheel(side)%contact(i)%status%limitations
    end subroutine fswset

    !> The contact that is column K of CONT.
    subroutine find_column(iwork, k, handle, side, i, info)
        integer(c_int), intent(in) :: iwork(n_iwork)             !! made by FSWNEW
        integer(c_int), intent(in) :: k                          !! column of CONT
        type(wheelset_handle_t), pointer, intent(out) :: handle  !! null if it is none
        integer, intent(out) :: side                             !! `side_right`, `side_left`
        integer, intent(out) :: i                                !! contact of its wheel
        integer(c_int), intent(out) :: info                      !! status

        call find_wheelset(number_of(iwork), handle, info)
        if (info /= st_ok) return
        call find_contact(handle, k, side, i)
        info = handle%status%code
    end subroutine find_column

    !> CALL FSWSTR(IWORK, K, M, N, YL, YR, XD, P0, IPATCH, INFO)
    !>
    !> The strips of a contact of the last solution, as of FSSTRP.
    subroutine fswstr(iwork, k, capacity, n, y_left, y_right, half_length, p0, patch, info) &
        bind(c, name='fswstr_')
        integer(c_int), intent(in) :: iwork(n_iwork)         !! made by FSWNEW, with a solution
        integer(c_int), intent(in) :: k                      !! column of CONT
        integer(c_int), intent(in) :: capacity               !! length of the arrays
        integer(c_int), intent(out) :: n                     !! number of strips
        real(c_double), intent(inout) :: y_left(*), y_right(*) !! edges, mm
        real(c_double), intent(inout) :: half_length(*)      !! mm
        real(c_double), intent(inout) :: p0(*)               !! pressure on the centre line, MPa
        integer(c_int), intent(inout) :: patch(*)            !! number of the patch
        integer(c_int), intent(out) :: info                  !! status; 100: no such contact

        type(wheelset_handle_t), pointer :: handle
        integer :: side, i

        n = 0
        call find_column(iwork, k, handle, side, i, info)
        if (info == st_ok) &
            call copy_strips(handle%workspace%wheel(side)%contact(i), &
                             contact_mirror(handle, side), capacity, n, y_left, y_right, &
                             half_length, p0, patch, info)
    end subroutine fswstr

    !> CALL FSWELM(IWORK, K, M, N, X, Y, AREA, PN, PX, PY, SX, SY, ISTATE, INFO)
    !>
    !> The elements of a contact of the last solution, as of FSELEM, if IOPT(9) of FSWNEW asked for
    !> them.
    subroutine fswelm(iwork, k, capacity, n, x, y, area, pn, px, py, sx, sy, state, info) &
        bind(c, name='fswelm_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSWNEW, with a solution
        integer(c_int), intent(in) :: k                !! column of CONT
        integer(c_int), intent(in) :: capacity         !! length of the arrays
        integer(c_int), intent(out) :: n               !! number of elements
        real(c_double), intent(inout) :: x(*), y(*)    !! middle of the element, mm
        real(c_double), intent(inout) :: area(*)       !! mm^2
        real(c_double), intent(inout) :: pn(*)         !! pressure, MPa
        real(c_double), intent(inout) :: px(*), py(*)  !! traction on the rail, MPa
        real(c_double), intent(inout) :: sx(*), sy(*)  !! slip over rolling speed
        integer(c_int), intent(inout) :: state(*)      !! 1 adhesion, 2 slip
        integer(c_int), intent(out) :: info            !! status; 100: no such contact

        type(wheelset_handle_t), pointer :: handle
        integer :: side, i

        n = 0
        call find_column(iwork, k, handle, side, i, info)
        if (info /= st_ok) return
        associate (contact => handle%workspace%wheel(side)%contact(i))
            n = contact%field%n
            if (capacity < n) info = st_workspace_too_small
            if (n > 0 .and. capacity >= n) &
                call read_elements(contact, contact_mirror(handle, side), x(:n), y(:n), &
                                   area(:n), pn(:n), px(:n), py(:n), sx(:n), sy(:n), state(:n))
        end associate
    end subroutine fswelm

    !> CALL FSWLKP(IWORK, ITABLE, IORDER, INFO)
    !>
    !> Let a lookup table answer for a wheelset where it reaches; strips do beyond. ITABLE as FSLOPN
    !> made it; all zero, as FSLFRE leaves it: none any more. IORDER as FSLCON takes it.
    subroutine fswlkp(iwork, table, order, info) bind(c, name='fswlkp_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW
        integer(c_int), intent(in) :: table(n_iwork) !! as above
        integer(c_int), intent(in) :: order          !! as above
        integer(c_int), intent(out) :: info          !! status

        type(wheelset_handle_t), pointer :: handle
        integer(c_intptr_t) :: number

        call find_wheelset(number_of(iwork), handle, info)
        if (.not. associated(handle)) return
        number = number_of(table)
        ! What is neither a table nor nothing is refused.
        if (number == 0 .and. any(table /= 0)) number = -1
        call use_lookup(handle, number, order)
        info = handle%status%code
    end subroutine fswlkp

    !> CALL FSWCPY(IFROM, ITO, INFO)
    !>
    !> Copy a wheelset with its last solution, and what FSRAIL set, into another one, for a step
    !> that may be taken back.
    subroutine fswcpy(from, to, info) bind(c, name='fswcpy_')
        integer(c_int), intent(in) :: from(n_iwork) !! made by FSWNEW
        integer(c_int), intent(in) :: to(n_iwork)   !! made by another call of FSWNEW
        integer(c_int), intent(out) :: info         !! status

        type(wheelset_handle_t), pointer :: source, target

        call find_wheelset(number_of(from), source, info)
        if (.not. associated(source)) return
        call find_wheelset(number_of(to), target, info)
        if (.not. associated(target)) return
        if (.not. associated(source, target)) call copy_wheelset(source, target)
    end subroutine fswcpy

    !> CALL FSWFRE(IWORK, INFO)
    !>
    !> Free what FSWNEW allocated.
    subroutine fswfre(iwork, info) bind(c, name='fswfre_')
        integer(c_int), intent(inout) :: iwork(n_iwork) !! made by FSWNEW; zero afterwards
        integer(c_int), intent(out) :: info             !! status

        type(status_t) :: status

        call free_wheelset(number_of(iwork), status)
        info = status%code
        iwork = 0
    end subroutine fswfre
end module faststrip_interop_f77_wheelset
