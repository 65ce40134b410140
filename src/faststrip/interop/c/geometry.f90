!> Contact geometry functions and equivalent conicity in the C interface: what `include/faststrip.h`
!> declares, and where it is documented.
module faststrip_interop_c_geometry
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_bad_argument
    use faststrip_interop_c, only: put_text, numbers_at
    use faststrip_interop_c_wheelset, only: c_setup_t, find_setup, read_sources
    use faststrip_interop_geometry, only: table_functions, table_conicity, n_function, n_conicity
    use faststrip_interop_wheelset_new, only: profile_source_t
    implicit none
    private

    public :: faststrip_contact_functions, faststrip_conicity

contains

    !> The contact of both wheels over the lateral shift.
    integer(c_int) function faststrip_contact_functions(setup, wheels, rails, with_roll, n, y, &
                                                        functions, states, text, length) bind(c) &
        result(code)
        type(c_ptr), value :: setup         !! a `faststrip_wheelset_setup`
        type(c_ptr), value :: wheels        !! two of `faststrip_profile`, right and left
        type(c_ptr), value :: rails         !! two of `faststrip_profile`, right and left
        integer(c_int), value :: with_roll  !! rolls it until both wheels touch?
        integer(c_int), value :: n          !! number of shifts
        type(c_ptr), value :: y             !! shifts, mm
        type(c_ptr), value :: functions     !! ten numbers of each, written
        type(c_ptr), value :: states        !! status of each, written
        type(c_ptr), value :: text          !! `length` characters, written; or null
        integer(c_size_t), value :: length  !! with the closing zero

        type(c_setup_t), pointer :: fields
        type(profile_source_t) :: sources(2, 2)
        real(c_double), pointer :: rows(:, :)
        integer(c_int), pointer :: codes(:)
        type(status_t) :: status

        call find_setup(setup, fields, status)
        if (.not. is_error(status)) call read_sources(wheels, 'wheel', sources(:, 1), status)
        if (.not. is_error(status)) call read_sources(rails, 'rail', sources(:, 2), status)
        if (.not. is_error(status)) call check_rows(n, [y, functions, states], status)
        if (.not. is_error(status)) then
            call c_f_pointer(functions, rows, [n_function, n])
            call c_f_pointer(states, codes, [n])
            call table_functions(sources(:, 1), sources(:, 2), fields%dimensions, &
                                 with_roll /= 0, numbers_at(y, n), rows, codes, status)
        end if
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_contact_functions

    !> Equivalent conicity over the amplitude from a rolling radius difference.
    integer(c_int) function faststrip_conicity(n, y, delta_r, m, amplitudes, equilibrium, &
                                               conicities, states, text, length) bind(c) &
        result(code)
        integer(c_int), value :: n         !! points of the table
        type(c_ptr), value :: y, delta_r   !! mm
        integer(c_int), value :: m         !! number of amplitudes
        type(c_ptr), value :: amplitudes   !! mm
        type(c_ptr), value :: equilibrium  !! two numbers, written
        type(c_ptr), value :: conicities   !! six numbers of each amplitude, written
        type(c_ptr), value :: states       !! two integers of each amplitude, written
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        real(c_double), pointer :: rows(:, :)
        integer(c_int), pointer :: codes(:, :)
        type(status_t) :: status

        call check_rows(min(n, m), [y, delta_r, amplitudes, equilibrium, conicities, states], &
                        status)
        if (.not. is_error(status)) then
            call c_f_pointer(conicities, rows, [n_conicity, m])
            call c_f_pointer(states, codes, [2, m])
            call table_conicity(numbers_at(y, n), numbers_at(delta_r, n), &
                                numbers_at(amplitudes, m), numbers_at(equilibrium, 2), rows, &
                                codes, status)
        end if
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_conicity

    ! Are there arrays, and a number of their rows?
    subroutine check_rows(n, arrays, status)
        integer(c_int), intent(in) :: n
        type(c_ptr), intent(in) :: arrays(:)
        type(status_t), intent(out) :: status

        integer :: i

        call clear_status(status)
        if (n < 0) call set_status(status, st_bad_argument, 'a number of points must not be ' // &
                                   'negative')
        do i = 1, size(arrays)
            if (.not. c_associated(arrays(i))) &
                call set_status(status, st_bad_argument, 'an array is missing')
        end do
    end subroutine check_rows
end module faststrip_interop_c_geometry
