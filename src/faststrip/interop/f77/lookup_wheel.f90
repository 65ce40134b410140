!> Lookup tables of a wheel on a rail in the F77 interface. FSLOPN opens them, FSLFRE frees them.
!>
!> ```
!> IORDER   interpolation: 1 linear, 3 cubic
!> PLACE(1,I), PLACE(2,I), PLACE(3,I) Y of the wheelset, mm, YAW, rad, vertical part of the normal
!>          forces, N, of place I
!> CONTAC(K,L,I) number K of slot L: normal force, N; contact angle, rad; Y, Z on the rail, mm; X in
!>          the track, mm; Y on the wheel, mm; rolling radius, mm; Z of the wheelset, mm; area, mm2;
!>          maximum pressure, MPa; length c, mm; lengths of the creepages, mm2, mm2, mm3
!> DCON(K,L,J,I) derivative of CONTAC(K,L,I) by PLACE(J,I)
!> ISLOT(I) which contact, from 1
!> STATE(1,I) to STATE(3,I) as PLACE     STATE(4,I) mu
!> STATE(5,I), STATE(6,I), STATE(7,I) CKSI, CETA, CPHI, rad/mm, of the contact
!> FORCE(1,I), FORCE(2,I) FX, FY on the rail, N          FORCE(3,I) MZ, N mm
!> DJAC(K,J,I) derivative of FORCE(K,I) by STATE(J,I)    ISTAT(I) status of state I
!> ABOUT    as numbers of faststrip_lookup_wheel_about; ABOUT(6) is the number of slots
!> ERRZ     twelve errors of Z, as of faststrip_lookup_wheel_z_errors
!> ```
module faststrip_interop_f77_lookup_wheel
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use faststrip_base_status, only: status_t, st_bad_argument
    use faststrip_interop_f77, only: n_iwork, number_of
    use faststrip_interop_lookup_handle, only: find_lookup, find_contacts, look_up_wheels, &
                                               describe_wheel, n_about_wheel, describe_z, n_about_z
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers
    use faststrip_lookup_wheel, only: n_wheel_place, n_wheel_state
    implicit none
    private

    public :: fslwin, fslwze, fslcon, fslwhl

    ! Forces of a state.
    integer, parameter :: n_forces = 3

contains

    !> CALL FSLWIN(IWORK, ABOUT, INFO)
    !>
    !> Numbers about the table of a wheel. INFO 100: another table.
    subroutine fslwin(iwork, about, info) bind(c, name='fslwin_')
        integer(c_int), intent(in) :: iwork(n_iwork)        !! made by FSLOPN
        real(c_double), intent(out) :: about(n_about_wheel) !! as above; zero when there is an error
        integer(c_int), intent(out) :: info                 !! status

        type(lookup_t), pointer :: lookup

        about = 0.0_c_double
        call find_wheel(iwork, lookup, info)
        if (associated(lookup)) about = describe_wheel(lookup)
    end subroutine fslwin

    !> CALL FSLWZE(IWORK, ERRZ, INFO)
    !>
    !> Errors of Z of the table of a wheel. INFO 100: another table; 121: a file of an older
    !> version, which does not know them.
    subroutine fslwze(iwork, errors, info) bind(c, name='fslwze_')
        integer(c_int), intent(in) :: iwork(n_iwork)     !! made by FSLOPN
        real(c_double), intent(out) :: errors(n_about_z) !! as above; zero when there is an error
        integer(c_int), intent(out) :: info              !! status

        type(lookup_t), pointer :: lookup
        type(status_t) :: status

        errors = 0.0_c_double
        call find_wheel(iwork, lookup, info)
        if (.not. associated(lookup)) return
        call describe_z(lookup, errors, status)
        info = status%code
    end subroutine fslwze

    ! The table of a workspace; none if it is not that of a wheel.
    subroutine find_wheel(iwork, lookup, info)
        integer(c_int), intent(in) :: iwork(n_iwork)
        type(lookup_t), pointer, intent(out) :: lookup
        integer(c_int), intent(out) :: info

        call find_lookup(number_of(iwork), lookup, info)
        if (.not. associated(lookup)) return
        if (lookup%kind == lookup_kind_wheel) return
        info = st_bad_argument
        lookup => null()
    end subroutine find_wheel

    !> CALL FSLCON(IWORK, IORDER, N, NSLOT, PLACE, CONTAC, DCON, ISTAT, INFO)
    !>
    !> Look up the contacts at N places and their derivatives. NSLOT is ABOUT(6). INFO: the status
    !> of the first place that fails; its CONTAC and DCON are zero, the others go on.
    subroutine fslcon(iwork, order, n, n_slots, places, contacts, slopes, codes, info) &
        bind(c, name='fslcon_')
        integer(c_int), intent(in) :: iwork(n_iwork)    !! made by FSLOPN
        integer(c_int), intent(in) :: order             !! as above
        integer(c_int), intent(in) :: n                 !! number of places
        integer(c_int), intent(in) :: n_slots           !! of the arrays: those of the table or more
        real(c_double), intent(in) :: places(n_wheel_place, *) !! as above
        real(c_double), intent(inout) :: contacts(n_contact_numbers, n_slots, *) !! as above
        real(c_double), intent(inout) :: &
            slopes(n_contact_numbers, n_slots, n_wheel_place, *) !! as above
        integer(c_int), intent(inout) :: codes(*)       !! as above
        integer(c_int), intent(out) :: info             !! status

        type(lookup_t), pointer :: lookup
        type(status_t) :: status

        call find_wheel(iwork, lookup, info)
        if (.not. associated(lookup)) return
        info = st_bad_argument
        if (n < 0) return
        call find_contacts(lookup, order, places(:, :n), contacts(:, :, :n), status, &
                           slopes(:, :, :, :n), codes(:n))
        info = status%code
    end subroutine fslcon

    !> CALL FSLWHL(IWORK, IORDER, N, ISLOT, STATE, FORCE, DJAC, ISTAT, INFO)
    !>
    !> Look up the creep forces of N states and their derivatives. INFO: the status of the first
    !> state that fails; its FORCE and DJAC are zero, the others go on.
    subroutine fslwhl(iwork, order, n, slots, states, forces, jacobians, codes, info) &
        bind(c, name='fslwhl_')
        integer(c_int), intent(in) :: iwork(n_iwork)   !! made by FSLOPN
        integer(c_int), intent(in) :: order            !! as above
        integer(c_int), intent(in) :: n                !! number of states
        integer(c_int), intent(in) :: slots(*)         !! as above
        real(c_double), intent(in) :: states(n_wheel_state, *)  !! as above
        real(c_double), intent(inout) :: forces(n_forces, *)    !! as above
        real(c_double), intent(inout) :: jacobians(n_forces, n_wheel_state, *) !! as above
        integer(c_int), intent(inout) :: codes(*)      !! as above
        integer(c_int), intent(out) :: info            !! status

        type(lookup_t), pointer :: lookup
        type(status_t) :: status

        call find_wheel(iwork, lookup, info)
        if (.not. associated(lookup)) return
        info = st_bad_argument
        if (n < 0) return
        call look_up_wheels(lookup, order, slots(:n), states(:, :n), forces(:, :n), status, &
                            jacobians(:, :, :n), codes(:n))
        info = status%code
    end subroutine fslwhl
end module faststrip_interop_f77_lookup_wheel
