!> The wheelsets of the F77 face, with the conventions of `faststrip_interop_f77`: `IOPT` and `PAR`
!> from there, of which methods, material and friction count; `IWORK` is as long as FSINIT says.
!>
!> ```
!> SETUP(1), SETUP(2) nominal radius of the right and left wheel, mm
!> SETUP(3) distance of the flange backs, mm; 0: as belongs to the gauge (1435 or 1520 mm)
!> SETUP(4) flange back to tape circle, mm
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
!> STATE(10) pitch rate, negative for rolling ahead    STATE(11) curvature of the track, 1/mm
!> RAIL(1), RAIL(2) y and z of the right rail beside its place, mm      RAIL(3) its roll, rad
!> RAIL(4), RAIL(5) rates of y and z, mm/s     RAIL(6) of its roll, rad/s
!> RAIL(7) to RAIL(12) the same of the left rail
!> IDMND(1) prescribed are: 0 z and roll, 1 the vertical force of each wheel, 2 the axle load
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
!> CONT(24,K) largest pressure, MPa   CONT(25), CONT(26) ends, mm      CONT(27,K) half-length, mm
!> CONT(28), CONT(29) Fx, Fy in the tangent plane, N   CONT(30,K) Mz, N mm, all on the rail
!> CONT(31,K) friction power, N     CONT(32,K) share in adhesion
!> CONT(33) to CONT(35) force in the track, N
!> CONT(36) to CONT(38) the same in the wheelset's frame
!> CONT(39) to CONT(41) moment about the wheelset's centre in the track, N mm
!> CONT(42) to CONT(47) as ERR(1) to ERR(3), FERR(1) to FERR(3)
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
                                     st_bad_argument, &
                                     st_workspace_too_small
    use faststrip_contact_case, only: contact_case_t
    use faststrip_interop_f77, only: n_iopt, n_par, n_iwork, check_choices, set_number, number_of
    use faststrip_interop_flat, only: fill_case
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, n_dimensions => n_setup, &
                                                 n_state, n_rails, n_choices, n_loads, n_counts, &
                                                 n_numbers, n_totals, n_sums, free_wheelset, &
                                                 find_wheelset, wheelset_solve, contact_count, &
                                                 read_contact, contact_limitations, read_totals
    use faststrip_interop_wheelset_new, only: profile_source_t, default_setup, new_wheelset
    implicit none
    private

    public :: fswdft, fswnew, fsrail, fswslv, fswset, fswfre
    public :: n_setup, read_sources

    integer, parameter :: n_setup = n_dimensions + 1
    integer, parameter :: n_cont = n_counts + n_numbers, n_wres = n_totals + n_sums
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

        call default_setup(setup(:n_dimensions))
        setup(n_setup) = case%resolution_limit
    end subroutine fswdft

    !> CALL FSWNEW(IOPT, PAR, SETUP, NPROF, YPROF, ZPROF, IWORK, LIWORK, INFO)
    !>
    !> Make a wheelset on its track. Methods of the library, IOPT(1) to IOPT(6).
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
        call fill_case(iopt, [par(:6), par(6:)], case)
        case%estimate = abs(setup(n_setup)) > 0.0_c_double
        if (case%estimate) then
            case%resolution_limit = setup(n_setup)
            case%force_limit = setup(n_setup)
        end if
        call new_wheelset(sources(:2), sources(3:), setup(:n_dimensions), case, number, status)
        info = status%code
        if (.not. is_error(status)) call set_number(iwork(:n_iwork), number)
    end subroutine fswnew

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
        type(status_t) :: status

        call find_wheelset(number_of(iwork), handle, status)
        info = status%code
        if (.not. is_error(status)) handle%rails = rail
    end subroutine fsrail

    !> CALL FSWSLV(IWORK, STATE, IDMND, DMND, M, N, CONT, WRES, INFO)
    !>
    !> Solve the contacts of both wheels, those of the right one first. INFO 110: M below N.
    subroutine fswslv(iwork, state, idmnd, dmnd, capacity, n, cont, wres, info) &
        bind(c, name='fswslv_')
        integer(c_int), intent(in) :: iwork(n_iwork)    !! made by FSWNEW
        real(c_double), intent(in) :: state(n_state)    !! as above
        integer(c_int), intent(in) :: idmnd(n_choices)  !! as above
        real(c_double), intent(in) :: dmnd(n_loads)     !! as above
        integer(c_int), intent(in) :: capacity          !! contacts that CONT has columns for
        integer(c_int), intent(out) :: n                !! number of contacts
        real(c_double), intent(inout) :: cont(n_cont, *) !! as above, written up to N
        real(c_double), intent(out) :: wres(n_wres)     !! as above; zero when there is an error
        integer(c_int), intent(out) :: info             !! status

        type(wheelset_handle_t), pointer :: handle
        type(status_t) :: status
        integer(c_int) :: counts(n_counts), sums(n_sums)
        integer :: i

        n = 0
        wres = 0.0_c_double
        call find_wheelset(number_of(iwork), handle, status)
        info = status%code
        if (is_error(status)) return
        if (any(idmnd(3:) < 0 .or. idmnd(3:) > 1)) then
            call set_status(handle%status, st_bad_argument, 'IDMND(3) and IDMND(4) must be 0 or ' &
                            // '1; INTEGER must be four bytes, see FSINTS')
            handle%has = .false.
            info = handle%status%code
            return
        end if
        call wheelset_solve(handle, state, idmnd, dmnd)
        n = contact_count(handle)
        if (n > capacity) then
            call set_status(handle%status, st_workspace_too_small, &
                            'there are more contacts than fit: ' // count_text(n))
            handle%has = .false.
        else
            do i = 1, n
                call read_contact(handle, i, counts, cont(n_counts + 1:, i))
                cont(:n_counts, i) = counts
            end do
        end if
        call read_totals(handle, sums, wres(:n_totals))
        wres(n_totals + 1:) = sums
        info = handle%status%code
    end subroutine fswslv

    !> CALL FSWSET(IWORK, K, LSET, INFO)
    !>
    !> All limitations of a contact of the last solution, of which CONT(2,K) is the first.
    subroutine fswset(iwork, k, lset, info) bind(c, name='fswset_')
        integer(c_int), intent(in) :: iwork(n_iwork) !! made by FSWNEW, with a solution
        integer(c_int), intent(in) :: k              !! column of CONT
        integer(c_int), intent(out) :: lset          !! 2**INFO of each, added up
        integer(c_int), intent(out) :: info          !! status; 100: no such contact

        type(wheelset_handle_t), pointer :: handle
        type(status_t) :: status

        lset = 0
        call find_wheelset(number_of(iwork), handle, status)
        info = status%code
        if (is_error(status)) return
        if (k < 1 .or. k > contact_count(handle)) then
            call set_status(handle%status, st_bad_argument, 'K must be 1 to ' // &
                            trim(count_text(contact_count(handle))) // ', the contacts, got ' // &
                            count_text(k))
            info = handle%status%code
        else
            lset = contact_limitations(handle, k)
        end if
    end subroutine fswset

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
