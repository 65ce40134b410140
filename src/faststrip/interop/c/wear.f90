!> Wear and fatigue in the C interface: what `include/faststrip.h` declares, and where it is
!> documented.
module faststrip_interop_c_wear
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_associated, &
                                           c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_ok
    use faststrip_interop_c, only: check_capacity, numbers_at
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_interop_handle, only: handle_t, find_handle
    use faststrip_interop_solution, only: mirror_t, strip_count, read_strip_forces, &
                                          read_strip_wear
    use faststrip_interop_wear, only: n_regime, n_wear, contact_wear, contact_strip_wear
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, find_contact, &
                                                 contact_mirror
    implicit none
    private

    public :: faststrip_get_wear, faststrip_get_strip_wear
    public :: faststrip_wheelset_get_wear, faststrip_wheelset_get_strip_wear

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

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call clear_figures(figures)
        call read_law(law, figures, wanted, handle%status)
        if (.not. is_error(handle%status)) &
            call contact_wear(handle%workspace, handle%result, handle%result%creepage, &
                              wanted%regimes, wanted%density, yield_shear, &
                              numbers_at(figures, n_wear), handle%status)
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
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call clear_figures(figures)
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) call read_law(law, figures, wanted, handle%status)
        if (.not. is_error(handle%status)) then
            associate (contact => handle%result%wheel(side)%contact(k))
                call contact_wear(handle%workspace%wheel(side)%contact(k), contact%figures, &
                                  contact%creepage, wanted%regimes, wanted%density, yield_shear, &
                                  numbers_at(figures, n_wear), handle%status)
            end associate
        end if
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

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call write_strip_wear(handle%workspace, handle%result, mirror_t(), law, capacity, n, &
                              [fx, fy, power, t_gamma, mass, depth], handle%status)
        code = handle%status%code
    end function faststrip_get_strip_wear

    !> Forces and wear of the strips of a contact of a wheelset.
    integer(c_int) function faststrip_wheelset_get_strip_wear(wheelset, i, law, capacity, n, fx, &
                                                              fy, power, t_gamma, mass, depth) &
        bind(c) result(code)
        integer(c_intptr_t), value :: wheelset   !! a handle
        integer(c_int), value :: i               !! contact, from 0 on
        type(c_ptr), value :: law                !! a `faststrip_wear_law`, or null
        integer(c_int), value :: capacity        !! length of the arrays
        type(c_ptr), value :: n                  !! number of strips, written
        type(c_ptr), value :: fx, fy             !! on the rail, N, written
        type(c_ptr), value :: power              !! friction power over rolling speed, N, written
        type(c_ptr), value :: t_gamma            !! T gamma over the area, N/mm^2, written
        type(c_ptr), value :: mass               !! ug per metre rolled, written
        type(c_ptr), value :: depth              !! depth when rolled over once, mm, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) &
            call write_strip_wear(handle%workspace%wheel(side)%contact(k), &
                                  handle%result%wheel(side)%contact(k)%figures, &
                                  contact_mirror(handle, side), law, capacity, n, &
                                  [fx, fy, power, t_gamma, mass, depth], handle%status)
        code = handle%status%code
    end function faststrip_wheelset_get_strip_wear

    ! What the strips of a solution transmit, and their wear, into a caller's six arrays.
    subroutine write_strip_wear(workspace, result, mirror, law, capacity, n, arrays, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_result_t), intent(in) :: result
        type(mirror_t), intent(in) :: mirror
        type(c_ptr), intent(in) :: law, n, arrays(6)
        integer(c_int), intent(in) :: capacity
        type(status_t), intent(out) :: status

        type(law_t) :: wanted
        integer :: count

        count = strip_count(workspace)
        call check_capacity(capacity, count, n, arrays, status)
        if (.not. is_error(status)) call read_law(law, arrays(1), wanted, status)
        if (.not. is_error(status)) &
            call contact_strip_wear(workspace, result, wanted%regimes, wanted%density, status)
        if (is_error(status)) return
        call read_strip_forces(workspace, mirror, numbers_at(arrays(1), count), &
                               numbers_at(arrays(2), count), numbers_at(arrays(3), count))
        call read_strip_wear(workspace, mirror, numbers_at(arrays(4), count), &
                             numbers_at(arrays(5), count), numbers_at(arrays(6), count))
    end subroutine write_strip_wear

    ! With an error all figures are zero.
    subroutine clear_figures(address)
        type(c_ptr), intent(in) :: address

        real(c_double), pointer :: figures(:)

        if (.not. c_associated(address)) return
        figures => numbers_at(address, n_wear)
        figures = 0.0_c_double
    end subroutine clear_figures

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
