!> Stresses below the surface in the C interface: what `include/faststrip.h` declares, and where it
!> is documented.
module faststrip_interop_c_stress
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: set_status, count_text, st_bad_argument, st_ok
    use faststrip_interop_c, only: numbers_at
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_stress, only: n_values, n_peak, handle_stresses, handle_peak
    implicit none
    private

    public :: faststrip_get_stresses, faststrip_get_stress_peak

contains

    !> Stresses of the rail below the last contact.
    integer(c_int) function faststrip_get_stresses(workspace, n, x, y, z, stresses) bind(c) &
        result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        integer(c_int), value :: n              !! number of points
        type(c_ptr), value :: x, y, z           !! `n` numbers each, z into the rail, mm
        type(c_ptr), value :: stresses          !! 11 `n` numbers, MPa, written

        type(handle_t), pointer :: handle
        real(c_double), pointer :: values(:, :)

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        if (n < 0) then
            call set_status(handle%status, st_bad_argument, 'the number of points must not be ' // &
                            'negative, got ' // count_text(n))
        else if (.not. (c_associated(x) .and. c_associated(y) .and. c_associated(z) &
                        .and. c_associated(stresses))) then
            call set_status(handle%status, st_bad_argument, 'stresses need x, y, z and a place')
        else
            call c_f_pointer(stresses, values, [n_values, n])
            call handle_stresses(handle, numbers_at(x, n), numbers_at(y, n), numbers_at(z, n), &
                                 values)
        end if
        code = handle%status%code
    end function faststrip_get_stresses

    !> The largest von Mises stress of the rail below the last contact.
    integer(c_int) function faststrip_get_stress_peak(workspace, figures) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: figures           !! five numbers, written

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        if (c_associated(figures)) then
            call handle_peak(handle, numbers_at(figures, n_peak))
        else
            call set_status(handle%status, st_bad_argument, 'nowhere to put the figures')
        end if
        code = handle%status%code
    end function faststrip_get_stress_peak
end module faststrip_interop_c_stress
