!> Lookup tables behind the handles of the C and F77 interfaces.
module faststrip_interop_lookup_handle
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_loc, c_f_pointer
    use, intrinsic :: iso_fortran_env, only: int8
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_workspace_too_small, st_file_format, st_ok
    use faststrip_interop_register, only: enter_register, leave_register, look_up_register, &
                                          kind_lookup
    use faststrip_lookup_bytes, only: open_lookup
    use faststrip_lookup_hertz, only: look_up_hertz
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz, lookup_kind_wheel, &
                                      n_wheel_errors
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    implicit none
    private

    public :: new_lookup, free_lookup, find_lookup, look_up_states, describe_lookup, n_about
    public :: find_contacts, look_up_wheels, describe_wheel, n_about_wheel
    public :: describe_z, n_about_z

    !> Numbers about a table.
    !> Given: by the interface.
    integer, parameter :: n_about = 23, n_about_wheel = 60, n_about_z = 12

    ! Numbers about the table of a wheel before the errors; which error is that of z.
    ! Given: by the interface.
    integer, parameter :: before_errors = 12, at_z = n_wheel_errors

contains

    !> Open a table and make a handle for it.
    subroutine new_lookup(bytes, number, status)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a file
        integer(c_intptr_t), intent(out) :: number        !! of the handle; 0 when there is an error
        type(status_t), intent(out) :: status             !! of `open_lookup`, `enter_register`

        type(lookup_t), pointer :: lookup
        type(environment_t) :: environment
        integer :: failure

        number = 0
        allocate (lookup, stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a lookup table')
            return
        end if
        call hold_environment(environment)
        call open_lookup(bytes, lookup, status)
        call restore_environment(environment)
        if (.not. is_error(status)) call enter_register(c_loc(lookup), kind_lookup, number, status)
        if (is_error(status)) deallocate (lookup)
    end subroutine new_lookup

    !> Free a table; nothing happens to what is none.
    subroutine free_lookup(number, status)
        integer(c_intptr_t), intent(in) :: number !! as the caller passed it
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no table, or freed

        type(lookup_t), pointer :: lookup
        type(c_ptr) :: address

        call leave_register(number, kind_lookup, address, status)
        if (is_error(status)) return
        call c_f_pointer(address, lookup)
        deallocate (lookup)
    end subroutine free_lookup

    !> The table of a number.
    subroutine find_lookup(number, lookup, code)
        integer(c_intptr_t), intent(in) :: number       !! as the caller passed it
        type(lookup_t), pointer, intent(out) :: lookup  !! null if it is none
        integer(c_int), intent(out) :: code !! `st_bad_argument`: no table, or freed

        type(c_ptr) :: address
        type(status_t) :: status

        lookup => null()
        call look_up_register(number, kind_lookup, address, status)
        code = status%code
        if (code == st_ok) call c_f_pointer(address, lookup)
    end subroutine find_lookup

    !> Forces of many states; the status of the first that fails.
    subroutine look_up_states(lookup, order, states, forces, status, jacobians, codes)
        type(lookup_t), intent(in) :: lookup                 !! opened
        integer(c_int), intent(in) :: order                  !! 1 or 3
        real(c_double), intent(in) :: states(:, :)           !! numbers, states
        real(c_double), intent(inout) :: forces(:, :)        !! forces, states
        type(status_t), intent(out) :: status                !! of `look_up_hertz`
        real(c_double), intent(inout), optional :: jacobians(:, :, :) !! forces, numbers, states
        integer(c_int), intent(inout), optional :: codes(:)  !! status of each state

        type(environment_t) :: environment
        type(status_t) :: found
        integer :: i

        call clear_status(status)
        call hold_environment(environment)
        do i = 1, size(states, 2)
            if (present(jacobians)) then
                call look_up_hertz(lookup, order, states(:, i), forces(:, i), found, &
                                   jacobians(:, :, i))
            else
                call look_up_hertz(lookup, order, states(:, i), forces(:, i), found)
            end if
            if (present(codes)) codes(i) = found%code
            if (found%code /= st_ok .and. status%code == st_ok) status = found
        end do
        call restore_environment(environment)
    end subroutine look_up_states

    !> The contacts of a wheel at many places; the status of the first that fails.
    subroutine find_contacts(lookup, order, places, contacts, status, slopes, codes)
        type(lookup_t), intent(in) :: lookup                 !! opened
        integer(c_int), intent(in) :: order                  !! 1 or 3
        real(c_double), intent(in) :: places(:, :)           !! y, yaw, load, places
        real(c_double), intent(inout) :: contacts(:, :, :)   !! numbers, slots, places
        type(status_t), intent(out) :: status                !! of `look_up_contacts`
        real(c_double), intent(inout), optional :: slopes(:, :, :, :)
            !! numbers, slots, by y, yaw, load, places
        integer(c_int), intent(inout), optional :: codes(:)  !! status of each place

        type(environment_t) :: environment
        type(status_t) :: found
        integer :: i

        call clear_status(status)
        call hold_environment(environment)
        do i = 1, size(places, 2)
            if (present(slopes)) then
                call look_up_contacts(lookup, order, places(:, i), contacts(:, :, i), found, &
                                      slopes(:, :, :, i))
            else
                call look_up_contacts(lookup, order, places(:, i), contacts(:, :, i), found)
            end if
            if (present(codes)) codes(i) = found%code
            if (found%code /= st_ok .and. status%code == st_ok) status = found
        end do
        call restore_environment(environment)
    end subroutine find_contacts

    !> Creep forces of contacts of a wheel; the status of the first state that fails.
    subroutine look_up_wheels(lookup, order, slots, states, forces, status, jacobians, codes)
        type(lookup_t), intent(in) :: lookup                 !! opened
        integer(c_int), intent(in) :: order                  !! 1 or 3
        integer(c_int), intent(in) :: slots(:)               !! which contact, of each state
        real(c_double), intent(in) :: states(:, :)           !! numbers, states
        real(c_double), intent(inout) :: forces(:, :)        !! forces, states
        type(status_t), intent(out) :: status                !! of `look_up_wheel`
        real(c_double), intent(inout), optional :: jacobians(:, :, :) !! forces, numbers, states
        integer(c_int), intent(inout), optional :: codes(:)  !! status of each state

        type(environment_t) :: environment
        type(status_t) :: found
        integer :: i

        call clear_status(status)
        call hold_environment(environment)
        do i = 1, size(states, 2)
            if (present(jacobians)) then
                call look_up_wheel(lookup, order, slots(i), states(:, i), forces(:, i), found, &
                                   jacobians(:, :, i))
            else
                call look_up_wheel(lookup, order, slots(i), states(:, i), forces(:, i), found)
            end if
            if (present(codes)) codes(i) = found%code
            if (found%code /= st_ok .and. status%code == st_ok) status = found
        end do
        call restore_environment(environment)
    end subroutine look_up_wheels

    !> Numbers about the table of a wheel, as the header has them; zero for another one.
    pure function describe_wheel(lookup) result(numbers)
        type(lookup_t), intent(in) :: lookup !! opened
        real(c_double) :: numbers(n_about_wheel)

        numbers = 0.0_c_double
        if (lookup%kind /= lookup_kind_wheel) return
        associate (wheel => lookup%wheel)
            numbers = [lookup%nu, wheel%shear, lookup%promised, real(wheel%tested, c_double), &
                       real(wheel%slots, c_double), wheel%y%x([1, wheel%y%n]), &
                       wheel%yaw%x([1, wheel%yaw%n]), wheel%load%x([1, wheel%load%n]), &
                       reshape(wheel%errors(:at_z - 1, :, :, :), [n_about_wheel - before_errors])]
        end associate
    end function describe_wheel

    !> Errors of z: mean, 99th percentile, worst; linear, cubic; all states, those where contacts
    !> come or go.
    pure subroutine describe_z(lookup, numbers, status)
        type(lookup_t), intent(in) :: lookup !! opened, of a wheel
        real(c_double), intent(out) :: numbers(n_about_z) !! loads that they make over the load
        type(status_t), intent(out) :: status
            !! `st_file_format`: an older table, whose errors of z are not known

        numbers = 0.0_c_double
        call clear_status(status)
        if (lookup%wheel%n_errors < at_z) then
            call set_status(status, st_file_format, 'an older table, whose errors of z are not ' &
                            // 'known')
        else
            numbers = reshape(lookup%wheel%errors(at_z, :, :, :), [n_about_z])
        end if
    end subroutine describe_z

    !> Numbers about a table of ellipses, as the header has them; zero for another one.
    pure function describe_lookup(lookup) result(numbers)
        type(lookup_t), intent(in) :: lookup !! opened
        real(c_double) :: numbers(n_about)

        numbers = 0.0_c_double
        if (lookup%kind /= lookup_kind_hertz) return
        numbers = [lookup%nu, lookup%promised, real(lookup%tested, c_double), &
                   exp(lookup%shape%x(1)), exp(lookup%shape%x(lookup%shape%n)), &
                   reshape(lookup%errors, [size(lookup%errors)])]
    end function describe_lookup
end module faststrip_interop_lookup_handle
