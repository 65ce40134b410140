!> Temperatures in the C interface: what `include/faststrip.h` declares, and where it is documented.
module faststrip_interop_c_heat
    use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_ptr, c_associated
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_ok
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_interop_c, only: numbers_at
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_heat, only: n_flash, contact_flash, contact_temperatures
    use faststrip_interop_solution, only: mirror_t
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, find_contact, &
                                                 contact_mirror
    implicit none
    private

    public :: faststrip_get_flash, faststrip_get_temperatures
    public :: faststrip_wheelset_get_flash, faststrip_wheelset_get_temperatures

contains

    !> Largest rise and temperature of the last contact.
    integer(c_int) function faststrip_get_flash(workspace, figures) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: figures           !! four numbers, written

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call write_flash(handle%result, figures, handle%status)
        code = handle%status%code
    end function faststrip_get_flash

    !> The same of a contact of a wheelset.
    integer(c_int) function faststrip_wheelset_get_flash(wheelset, i, figures) bind(c) result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_int), value :: i             !! contact, from 0 on
        type(c_ptr), value :: figures          !! four numbers, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) &
            call write_flash(handle%result%wheel(side)%contact(k)%figures, figures, handle%status)
        code = handle%status%code
    end function faststrip_wheelset_get_flash

    !> Temperatures of both surfaces of the last contact at places.
    integer(c_int) function faststrip_get_temperatures(workspace, n, x, y, wheel, rail) bind(c) &
        result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        integer(c_int), value :: n              !! number of places
        type(c_ptr), value :: x, y              !! `n` numbers each, mm
        type(c_ptr), value :: wheel, rail       !! `n` numbers each, C, written

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call write_temperatures(handle%workspace, handle%result, mirror_t(), n, &
                                [x, y, wheel, rail], handle%status)
        code = handle%status%code
    end function faststrip_get_temperatures

    !> The same of a contact of a wheelset.
    integer(c_int) function faststrip_wheelset_get_temperatures(wheelset, i, n, x, y, wheel, rail) &
        bind(c) result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_int), value :: i             !! contact, from 0 on
        integer(c_int), value :: n             !! number of places
        type(c_ptr), value :: x, y             !! `n` numbers each, mm
        type(c_ptr), value :: wheel, rail      !! `n` numbers each, C, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) &
            call write_temperatures(handle%workspace%wheel(side)%contact(k), &
                                    handle%result%wheel(side)%contact(k)%figures, &
                                    contact_mirror(handle, side), n, [x, y, wheel, rail], &
                                    handle%status)
        code = handle%status%code
    end function faststrip_wheelset_get_temperatures

    ! Figures into a caller's array.
    subroutine write_flash(result, figures, status)
        type(contact_result_t), intent(in) :: result
        type(c_ptr), intent(in) :: figures
        type(status_t), intent(out) :: status

        if (c_associated(figures)) then
            call contact_flash(result, numbers_at(figures, n_flash), status)
        else
            call set_status(status, st_bad_argument, 'the figures are missing')
        end if
    end subroutine write_flash

    ! Temperatures into a caller's arrays.
    subroutine write_temperatures(workspace, result, mirror, n, arrays, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_result_t), intent(in) :: result
        type(mirror_t), intent(in) :: mirror
        integer(c_int), intent(in) :: n
        type(c_ptr), intent(in) :: arrays(4)
        type(status_t), intent(out) :: status

        integer :: i

        call clear_status(status)
        if (n < 0 .or. n > 0 .and. .not. all([(c_associated(arrays(i)), i=1, size(arrays))])) then
            call set_status(status, st_bad_argument, 'the number of places must not be ' // &
                            'negative, and x, y, wheel and rail must be there')
        else if (n > 0) then
            call contact_temperatures(workspace, result, mirror, numbers_at(arrays(1), n), &
                                      numbers_at(arrays(2), n), numbers_at(arrays(3), n), &
                                      numbers_at(arrays(4), n), status)
        end if
    end subroutine write_temperatures
end module faststrip_interop_c_heat
