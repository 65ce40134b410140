!> Lookup tables of a wheel on a rail in the C interface: what `include/faststrip.h` declares, and
!> where it is documented.
module faststrip_interop_c_lookup_wheel
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: status_t, st_bad_argument, st_ok
    use faststrip_interop_c, only: numbers_at
    use faststrip_interop_lookup_handle, only: find_lookup, find_contacts, look_up_wheels, &
                                               describe_wheel, n_about_wheel, describe_z, n_about_z
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers
    use faststrip_lookup_wheel, only: n_wheel_place, n_wheel_state
    implicit none
    private

    public :: faststrip_lookup_wheel_about, faststrip_lookup_wheel_z_errors, &
              faststrip_lookup_wheel_contacts, faststrip_lookup_wheel_forces

    ! Forces of a state.
    integer, parameter :: n_forces = 3

contains

    !> Numbers about the table of a wheel.
    integer(c_int) function faststrip_lookup_wheel_about(lookup, numbers) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        type(c_ptr), value :: numbers        !! 60, written

        type(lookup_t), pointer :: table
        real(c_double), pointer :: found(:)

        call find_wheel(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (.not. c_associated(numbers)) return
        found => numbers_at(numbers, n_about_wheel)
        found = describe_wheel(table)
        code = st_ok
    end function faststrip_lookup_wheel_about

    !> Errors of z of the table of a wheel.
    integer(c_int) function faststrip_lookup_wheel_z_errors(lookup, errors) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        type(c_ptr), value :: errors         !! 12, written

        type(lookup_t), pointer :: table
        type(status_t) :: status

        call find_wheel(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (.not. c_associated(errors)) return
        call describe_z(table, numbers_at(errors, n_about_z), status)
        code = status%code
    end function faststrip_lookup_wheel_z_errors

    ! The table of a handle; none if it is not that of a wheel.
    subroutine find_wheel(lookup, table, code)
        integer(c_intptr_t), intent(in) :: lookup
        type(lookup_t), pointer, intent(out) :: table
        integer(c_int), intent(out) :: code

        call find_lookup(lookup, table, code)
        if (code /= st_ok) return
        if (table%kind /= lookup_kind_wheel) code = st_bad_argument
    end subroutine find_wheel

    !> Contacts at many places.
    integer(c_int) function faststrip_lookup_wheel_contacts(lookup, order, n, places, contacts, &
                                                            slopes, codes) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        integer(c_int), value :: order       !! of interpolation, 1 or 3
        integer(c_int), value :: n           !! number of places
        type(c_ptr), value :: places         !! three numbers of each
        type(c_ptr), value :: contacts       !! 14 of each slot, of each place, written
        type(c_ptr), value :: slopes         !! three times as many, written; or null
        type(c_ptr), value :: codes          !! status of each, written; or null

        type(lookup_t), pointer :: table
        real(c_double), pointer :: given(:, :), found(:, :, :), by_place(:, :, :, :)
        integer(c_int), pointer :: places_codes(:)
        type(status_t) :: status

        call find_wheel(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (n < 0) return
        if (.not. (c_associated(places) .and. c_associated(contacts))) return
        associate (slots => table%wheel%slots)
            call c_f_pointer(places, given, [n_wheel_place, n])
            call c_f_pointer(contacts, found, [n_contact_numbers, slots, n])
            ! A pointer to nothing is an optional argument that is not there.
            by_place => null()
            places_codes => null()
            if (c_associated(slopes)) &
                call c_f_pointer(slopes, by_place, [n_contact_numbers, slots, n_wheel_place, n])
        end associate
        if (c_associated(codes)) call c_f_pointer(codes, places_codes, [n])
        call find_contacts(table, order, given, found, status, by_place, places_codes)
        code = status%code
    end function faststrip_lookup_wheel_contacts

    !> Creep forces of contacts.
    integer(c_int) function faststrip_lookup_wheel_forces(lookup, order, n, slots, states, forces, &
                                                          jacobians, codes) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        integer(c_int), value :: order       !! of interpolation, 1 or 3
        integer(c_int), value :: n           !! number of states
        type(c_ptr), value :: slots          !! which contact, from 1, of each
        type(c_ptr), value :: states         !! seven numbers of each
        type(c_ptr), value :: forces         !! three of each, written
        type(c_ptr), value :: jacobians      !! 21 of each, written; or null
        type(c_ptr), value :: codes          !! status of each, written; or null

        type(lookup_t), pointer :: table
        real(c_double), pointer :: given(:, :), found(:, :), by_state(:, :, :)
        integer(c_int), pointer :: states_codes(:), which(:)
        type(status_t) :: status

        call find_wheel(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (n < 0) return
        if (.not. (c_associated(slots) .and. c_associated(states))) return
        if (.not. c_associated(forces)) return
        call c_f_pointer(slots, which, [n])
        call c_f_pointer(states, given, [n_wheel_state, n])
        call c_f_pointer(forces, found, [n_forces, n])
        by_state => null()
        states_codes => null()
        if (c_associated(jacobians)) call c_f_pointer(jacobians, by_state, &
                                                      [n_forces, n_wheel_state, n])
        if (c_associated(codes)) call c_f_pointer(codes, states_codes, [n])
        call look_up_wheels(table, order, which, given, found, status, by_state, states_codes)
        code = status%code
    end function faststrip_lookup_wheel_forces
end module faststrip_interop_c_lookup_wheel
