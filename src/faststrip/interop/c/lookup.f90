!> Lookup tables in the C interface: what `include/faststrip.h` declares, and where it is
!> documented.
module faststrip_interop_c_lookup
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_size_t, c_ptr, &
                                           c_associated, c_f_pointer
    use, intrinsic :: iso_fortran_env, only: int8
    use faststrip_base_status, only: status_t, set_status, st_bad_argument, st_ok
    use faststrip_interop_c, only: put_text, numbers_at
    use faststrip_interop_lookup_handle, only: new_lookup, free_lookup, find_lookup, &
                                               look_up_states, describe_lookup, n_about
    use faststrip_lookup_hertz, only: n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: faststrip_lookup_open, faststrip_lookup_free, faststrip_lookup_about, &
              faststrip_lookup_forces

    ! Forces of a state.
    integer, parameter :: n_forces = 3

contains

    !> Open a table from its bytes.
    integer(c_int) function faststrip_lookup_open(bytes, length, lookup, text, text_length) &
        bind(c) result(code)
        type(c_ptr), value :: bytes             !! of a file
        integer(c_size_t), value :: length      !! of them
        type(c_ptr), value :: lookup            !! where the handle goes
        type(c_ptr), value :: text              !! `text_length` characters, written; or null
        integer(c_size_t), value :: text_length !! with the closing zero

        integer(c_intptr_t), pointer :: number
        integer(int8), pointer :: content(:)
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(lookup)) return
        call c_f_pointer(lookup, number)
        number = 0
        if (c_associated(bytes) .and. length < huge(length)) then
            call c_f_pointer(bytes, content, [length])
            call new_lookup(content, number, status)
        else
            call set_status(status, st_bad_argument, 'no bytes to open a lookup table from')
        end if
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, text_length))
    end function faststrip_lookup_open

    !> Free a table and set the caller's pointer to null; a null one is left alone.
    integer(c_int) function faststrip_lookup_free(lookup) bind(c) result(code)
        type(c_ptr), value :: lookup !! where the handle is

        integer(c_intptr_t), pointer :: number
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(lookup)) return
        call c_f_pointer(lookup, number)
        code = st_ok
        if (number == 0) return
        call free_lookup(number, status)
        code = status%code
        number = 0
    end function faststrip_lookup_free

    !> Numbers about a table.
    integer(c_int) function faststrip_lookup_about(lookup, numbers) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        type(c_ptr), value :: numbers        !! 23, written

        type(lookup_t), pointer :: table
        real(c_double), pointer :: found(:)

        call find_lookup(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (.not. c_associated(numbers) .or. table%kind /= lookup_kind_hertz) return
        found => numbers_at(numbers, n_about)
        found = describe_lookup(table)
        code = st_ok
    end function faststrip_lookup_about

    !> Forces of many states.
    integer(c_int) function faststrip_lookup_forces(lookup, order, n, states, forces, jacobians, &
                                                    codes) bind(c) result(code)
        integer(c_intptr_t), value :: lookup !! a handle
        integer(c_int), value :: order       !! of interpolation, 1 or 3
        integer(c_int), value :: n           !! number of states
        type(c_ptr), value :: states         !! eight numbers of each
        type(c_ptr), value :: forces         !! three of each, written
        type(c_ptr), value :: jacobians      !! 24 of each, written; or null
        type(c_ptr), value :: codes          !! status of each, written; or null

        type(lookup_t), pointer :: table
        real(c_double), pointer :: given(:, :), found(:, :), slopes(:, :, :)
        integer(c_int), pointer :: states_codes(:)
        type(status_t) :: status

        call find_lookup(lookup, table, code)
        if (code /= st_ok) return
        code = st_bad_argument
        if (n < 0) return
        if (.not. (c_associated(states) .and. c_associated(forces))) return
        call c_f_pointer(states, given, [n_lookup_state, n])
        call c_f_pointer(forces, found, [n_forces, n])
        ! A pointer to nothing is an optional argument that is not there.
        slopes => null()
        states_codes => null()
        if (c_associated(jacobians)) call c_f_pointer(jacobians, slopes, &
                                                      [n_forces, n_lookup_state, n])
        if (c_associated(codes)) call c_f_pointer(codes, states_codes, [n])
        call look_up_states(table, order, given, found, status, slopes, states_codes)
        code = status%code
    end function faststrip_lookup_forces
end module faststrip_interop_c_lookup
