!> Wear and fatigue in the C face: what `include/faststrip.h` declares, and where it is documented.
module faststrip_interop_c_wear
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument
    use faststrip_interop_c, only: check_capacity, numbers_at
    use faststrip_interop_flat, only: strip_count
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_wear, only: n_regime, n_wear, contact_wear, contact_strip_wear, &
                                      read_strip_wear, wheelset_wear
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset
    implicit none
    private

    public :: faststrip_get_wear, faststrip_get_strip_wear, faststrip_wheelset_get_wear

    !> `faststrip_wear_law` of the header.
    type, bind(c) :: c_law_t
        integer(c_int) :: n
        type(c_ptr) :: regimes
        real(c_double) :: density
    end type c_law_t

    !> The same in Fortran.
    type :: law_t
        real(c_double), pointer :: regimes(:, :)
        real(c_double) :: density = 0.0_c_double
    end type law_t

contains

    !> T gamma, wear and fatigue of the last contact.
    integer(c_int) function faststrip_get_wear(workspace, law, yield_shear, figures) bind(c) &
        result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: law               !! a `faststrip_wear_law`, or null
        real(c_double), value :: yield_shear    !! in cyclic shear, MPa; 0: not known
        type(c_ptr), value :: figures           !! six numbers, written

        type(handle_t), pointer :: handle
        type(law_t) :: wanted
        type(status_t) :: status

        call find_handle(workspace, handle, status)
        code = status%code
        if (is_error(status)) return
        call read_law(law, figures, wanted, handle%status)
        if (.not. is_error(handle%status)) &
            call contact_wear(handle, wanted%regimes, wanted%density, yield_shear, &
                              numbers_at(figures, n_wear))
        code = handle%status%code
    end function faststrip_get_wear

    !> T gamma, wear and fatigue of a contact of a wheelset.
    integer(c_int) function faststrip_wheelset_get_wear(wheelset, i, law, yield_shear, figures) &
        bind(c) result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_int), value :: i             !! contact, from 0 on
        type(c_ptr), value :: law              !! a `faststrip_wear_law`, or null
        real(c_double), value :: yield_shear   !! in cyclic shear, MPa; 0: not known
        type(c_ptr), value :: figures          !! six numbers, written

        type(wheelset_handle_t), pointer :: handle
        type(law_t) :: wanted
        type(status_t) :: status

        call find_wheelset(wheelset, handle, status)
        code = status%code
        if (is_error(status)) return
        call read_law(law, figures, wanted, handle%status)
        if (.not. is_error(handle%status)) &
            call wheelset_wear(handle, i + 1, wanted%regimes, wanted%density, yield_shear, &
                               numbers_at(figures, n_wear))
        code = handle%status%code
    end function faststrip_wheelset_get_wear

    !> Forces and wear of the strips of the last contact.
    integer(c_int) function faststrip_get_strip_wear(workspace, law, capacity, n, fx, fy, power, &
                                                     t_gamma, mass, depth) bind(c) result(code)
        integer(c_intptr_t), value :: workspace  !! a handle
        type(c_ptr), value :: law                !! a `faststrip_wear_law`, or null
        integer(c_int), value :: capacity        !! length of the arrays
        type(c_ptr), value :: n                  !! number of strips, written
        type(c_ptr), value :: fx, fy             !! on the rail, N, written
        type(c_ptr), value :: power              !! friction power over rolling speed, N, written
        type(c_ptr), value :: t_gamma            !! T gamma over the area, N/mm^2, written
        type(c_ptr), value :: mass               !! ug per metre rolled, written
        type(c_ptr), value :: depth              !! depth when rolled over once, mm, written

        type(handle_t), pointer :: handle
        type(law_t) :: wanted
        type(status_t) :: status
        integer :: count

        call find_handle(workspace, handle, status)
        code = status%code
        if (is_error(status)) return
        count = strip_count(handle)
        call check_capacity(handle, capacity, count, n, [fx, fy, power, t_gamma, mass, depth])
        if (.not. is_error(handle%status)) call read_law(law, fx, wanted, handle%status)
        if (.not. is_error(handle%status)) &
            call contact_strip_wear(handle, wanted%regimes, wanted%density)
        code = handle%status%code
        if (is_error(handle%status)) return
        call read_strip_wear(handle, numbers_at(fx, count), numbers_at(fy, count), &
                             numbers_at(power, count), numbers_at(t_gamma, count), &
                             numbers_at(mass, count), numbers_at(depth, count))
    end function faststrip_get_strip_wear

    ! A caller's law; one without regimes where there is none.
    subroutine read_law(address, figures, law, status)
        type(c_ptr), intent(in) :: address, figures
        type(law_t), intent(out) :: law
        type(status_t), intent(out) :: status

        type(c_law_t), pointer :: fields

        call clear_status(status)
        if (.not. c_associated(figures)) then
            call set_status(status, st_bad_argument, 'nowhere to put the figures')
            return
        end if
        call c_f_pointer(figures, law%regimes, [n_regime, 0])
        if (.not. c_associated(address)) return
        call c_f_pointer(address, fields)
        if (fields%n < 1 .or. .not. c_associated(fields%regimes)) then
            call set_status(status, st_bad_argument, 'a wear law must have regimes, got ' // &
                            count_text(fields%n))
            return
        end if
        call c_f_pointer(fields%regimes, law%regimes, [n_regime, fields%n])
        law%density = fields%density
    end subroutine read_law
end module faststrip_interop_c_wear
