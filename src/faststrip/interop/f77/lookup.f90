!> Lookup tables in the F77 interface.
!>
!> ```
!> BYTES    bytes of a table's file, in an array of any type
!> IORDER   interpolation: 1 linear, 3 cubic
!> STATE(1,I), STATE(2,I) semi-axes along and across the rolling direction, mm, of state I
!> STATE(3,I) load, N      STATE(4,I) mu      STATE(5,I) shear modulus, MPa
!> STATE(6,I), STATE(7,I), STATE(8,I) CKSI, CETA, CPHI, rad/mm
!> FORCE(1,I), FORCE(2,I) FX, FY on the rail, N          FORCE(3,I) MZ about the middle, N mm
!> DJAC(K,J,I) derivative of FORCE(K,I) by STATE(J,I)    ISTAT(I) status of state I
!> ABOUT    as numbers of faststrip_lookup_about
!> ```
module faststrip_interop_f77_lookup
    use, intrinsic :: iso_c_binding, only: c_int, c_int8_t, c_double, c_intptr_t
    use faststrip_base_status, only: status_t, is_error, st_bad_argument, st_workspace_too_small
    use faststrip_interop_f77, only: n_iwork, set_number, number_of
    use faststrip_interop_lookup_handle, only: new_lookup, free_lookup, find_lookup, &
                                               look_up_states, describe_lookup, n_about
    use faststrip_lookup_hertz, only: n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: fslopn, fslfre, fslinf, fslook

    ! Forces of a state.
    integer, parameter :: n_forces = 3

contains

    !> CALL FSLOPN(NBYTES, BYTES, IWORK, LIWORK, INFO)
    !>
    !> Open a table. INFO 121: damaged, cut, of another version; 110: LIWORK below 8.
    subroutine fslopn(n_bytes, bytes, iwork, liwork, info) bind(c, name='fslopn_')
        integer(c_int), intent(in) :: n_bytes     !! of the file
        integer(c_int8_t), intent(in) :: bytes(*)     !! as above
        integer(c_int), intent(inout) :: iwork(*) !! the caller's workspace array
        integer(c_int), intent(in) :: liwork      !! its length
        integer(c_int), intent(out) :: info       !! status

        type(status_t) :: status
        integer(c_intptr_t) :: number

        info = st_workspace_too_small
        if (liwork < n_iwork) return
        iwork(:n_iwork) = 0
        info = st_bad_argument
        if (n_bytes < 0) return
        call new_lookup(bytes(:n_bytes), number, status)
        info = status%code
        if (.not. is_error(status)) call set_number(iwork(:n_iwork), number)
    end subroutine fslopn

    !> CALL FSLFRE(IWORK, INFO)
    !>
    !> Free a table.
    subroutine fslfre(iwork, info) bind(c, name='fslfre_')
        integer(c_int), intent(inout) :: iwork(n_iwork) !! made by FSLOPN; zero afterwards
        integer(c_int), intent(out) :: info             !! status

        type(status_t) :: status

        call free_lookup(number_of(iwork), status)
        info = status%code
        iwork = 0
    end subroutine fslfre

    !> CALL FSLINF(IWORK, ABOUT, INFO)
    !>
    !> Numbers about a table.
    subroutine fslinf(iwork, about, info) bind(c, name='fslinf_')
        integer(c_int), intent(in) :: iwork(n_iwork)    !! made by FSLOPN
        real(c_double), intent(out) :: about(n_about)   !! as above; zero when there is an error
        integer(c_int), intent(out) :: info             !! status

        type(lookup_t), pointer :: lookup

        about = 0.0_c_double
        call find_lookup(number_of(iwork), lookup, info)
        if (.not. associated(lookup)) return
        if (lookup%kind /= lookup_kind_hertz) info = st_bad_argument
        about = describe_lookup(lookup)
    end subroutine fslinf

    !> CALL FSLOOK(IWORK, IORDER, N, STATE, FORCE, DJAC, ISTAT, INFO)
    !>
    !> Look up the forces of N states and their derivatives. INFO: the status of the first state
    !> that fails; its FORCE and DJAC are zero, the others go on.
    subroutine fslook(iwork, order, n, states, forces, jacobians, codes, info) &
        bind(c, name='fslook_')
        integer(c_int), intent(in) :: iwork(n_iwork)      !! made by FSLOPN
        integer(c_int), intent(in) :: order               !! as above
        integer(c_int), intent(in) :: n                   !! number of states
        real(c_double), intent(in) :: states(n_lookup_state, *) !! as above
        real(c_double), intent(inout) :: forces(n_forces, *)    !! as above
        real(c_double), intent(inout) :: jacobians(n_forces, n_lookup_state, *) !! as above
        integer(c_int), intent(inout) :: codes(*)         !! as above
        integer(c_int), intent(out) :: info               !! status

        type(lookup_t), pointer :: lookup
        type(status_t) :: status

        call find_lookup(number_of(iwork), lookup, info)
        if (.not. associated(lookup)) return
        info = st_bad_argument
        if (n < 0) return
        call look_up_states(lookup, order, states(:, :n), forces(:, :n), status, &
                            jacobians(:, :, :n), codes(:n))
        info = status%code
    end subroutine fslook
end module faststrip_interop_f77_lookup
