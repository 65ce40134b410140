!> The C interface: what `include/faststrip.h` declares, and where it is documented.
!>
!> Every function returns a code of `faststrip_base_status`. Pointers, sizes and handles are checked
!> here; numbers are checked by the procedures that take them.
module faststrip_interop_c
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_char, c_intptr_t, c_ptr, &
                                           c_null_char, c_associated, c_f_pointer, c_sizeof
    use faststrip_base_status, only: status_t, status_word, set_status, clear_status, is_error, &
                                     st_ok, st_bad_argument, st_workspace_too_small
    use faststrip_contact_method, only: workspace_t
    use faststrip_interop_handle, only: handle_t, new_handle, free_handle, find_handle, copy_handle
    use faststrip_interop_solution, only: mirror_t, read_steps, strip_count, read_strips, &
                                          read_elements
    use faststrip_interop_c_solve, only: take_gap, solve_fields
    use faststrip_interop_c_structs, only: c_case_t, c_result_t, default_case, find_case, &
                                           check_size, methods_of, with_elements
    use faststrip_interop_classic, only: classic_fastsim, classic_hertz, classic_kalker
    use faststrip_interop_profile_points, only: gap_of_points, copy_gap, n_setup, n_contact
    use faststrip_geometry_gap, only: gap_t
    implicit none
    private

    public :: faststrip_version, faststrip_message, faststrip_default_case, faststrip_check_case
    public :: faststrip_new, faststrip_free, faststrip_copy, faststrip_set_gap, faststrip_solve
    public :: faststrip_get_strips, faststrip_get_elements, faststrip_get_steps
    public :: faststrip_last_message
    public :: faststrip_fastsim, faststrip_hertz, faststrip_kalker
    public :: faststrip_profile_gap
    public :: put_text, check_capacity, numbers_at, write_strips, write_elements

    character(len=*), parameter :: version = '0.1.0'

contains

    !> The version of the library, three numbers with points between.
    integer(c_int) function faststrip_version(text, length) bind(c) result(code)
        type(c_ptr), value :: text           !! `length` characters, written
        integer(c_size_t), value :: length   !! with the closing zero

        code = put_text(version, text, length)
    end function faststrip_version

    !> The word of a status code.
    integer(c_int) function faststrip_message(status, text, length) bind(c) result(code)
        integer(c_int), value :: status      !! what a call returned
        type(c_ptr), value :: text           !! `length` characters, written
        integer(c_size_t), value :: length   !! with the closing zero

        code = put_text(trim(status_word(status)), text, length)
    end function faststrip_message

    !> The words of a workspace's last call, with the offending value; empty when all was well.
    integer(c_int) function faststrip_last_message(workspace, text, length) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: text           !! `length` characters, written
        integer(c_size_t), value :: length   !! with the closing zero

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        code = put_text(trim(handle%status%message), text, length)
    end function faststrip_last_message

    !> Fill a case in with steel on steel, the methods of the project and nothing to solve.
    integer(c_int) function faststrip_default_case(case, length) bind(c) result(code)
        type(c_ptr), value :: case           !! a `faststrip_case`
        integer(c_size_t), value :: length   !! its size as the caller knows it

        type(status_t) :: status
        type(c_case_t), pointer :: fields

        call check_size('the case', 'faststrip_default_case', case, c_sizeof(fields), status, &
                        length)
        code = status%code
        if (is_error(status)) return
        call c_f_pointer(case, fields)
        fields = default_case()
    end function faststrip_default_case

    !> What `faststrip_new` has to say of a case: nothing when it can make the workspace.
    integer(c_int) function faststrip_check_case(case, max_points, text, length) bind(c) &
        result(code)
        type(c_ptr), value :: case           !! a `faststrip_case`
        integer(c_int), value :: max_points  !! most points of a gap
        type(c_ptr), value :: text           !! `length` characters, written; or null
        integer(c_size_t), value :: length   !! with the closing zero

        integer(c_intptr_t) :: number
        type(status_t) :: status, ignored

        call make_workspace(case, max_points, number, status)
        if (number /= 0) call free_handle(number, ignored)
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_check_case

    !> Make a workspace with capacity for the methods of a case.
    integer(c_int) function faststrip_new(case, max_points, workspace) bind(c) result(code)
        type(c_ptr), value :: case           !! a `faststrip_case`
        integer(c_int), value :: max_points  !! most points of a gap
        type(c_ptr), value :: workspace      !! where the handle goes

        integer(c_intptr_t), pointer :: number
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(workspace)) return
        call c_f_pointer(workspace, number)
        call make_workspace(case, max_points, number, status)
        code = status%code
    end function faststrip_new

    !> Free a workspace and set the caller's pointer to null; a null one is left alone.
    integer(c_int) function faststrip_free(workspace) bind(c) result(code)
        type(c_ptr), value :: workspace !! where the handle is

        integer(c_intptr_t), pointer :: number
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(workspace)) return
        call c_f_pointer(workspace, number)
        code = st_ok
        if (number == 0) return
        call free_handle(number, status)
        code = status%code
        number = 0
    end function faststrip_free

    !> Copy a workspace's gap and solution, for a step that may be taken back.
    integer(c_int) function faststrip_copy(from, to) bind(c) result(code)
        integer(c_intptr_t), value :: from !! a handle
        integer(c_intptr_t), value :: to   !! another one

        type(handle_t), pointer :: source, target

        call find_handle(from, source, code)
        if (code /= st_ok) return
        call find_handle(to, target, code)
        if (code /= st_ok .or. from == to) return
        call copy_handle(source, target)
    end function faststrip_copy

    !> Hand over the gap that the next solutions are for.
    integer(c_int) function faststrip_set_gap(workspace, n, y, h, inv2r, &
                                              inclination) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        integer(c_int), value :: n        !! number of points
        type(c_ptr), value :: y, h, inv2r !! `n` numbers each, mm, mm, 1/mm
        type(c_ptr), value :: inclination        !! `n` numbers, rad, or null: not known

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call take_gap(handle, n, y, h, inv2r, inclination)
        code = handle%status%code
    end function faststrip_set_gap

    !> Solve one contact on the gap of the workspace.
    integer(c_int) function faststrip_solve(workspace, case, result) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        type(c_ptr), value :: case      !! a `faststrip_case`
        type(c_ptr), value :: result    !! a `faststrip_result`, written

        type(handle_t), pointer :: handle
        type(c_case_t), pointer :: fields
        type(c_result_t), pointer :: figures

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call find_case(case, fields, handle%status)
        if (.not. (is_error(handle%status) .or. c_associated(result))) &
            call set_status(handle%status, st_bad_argument, 'the result is missing')
        code = handle%status%code
        if (is_error(handle%status)) return
        call c_f_pointer(result, figures)
        call solve_fields(handle, fields, figures)
        code = handle%status%code
    end function faststrip_solve

    !> The strips of the last contact.
    integer(c_int) function faststrip_get_strips(workspace, capacity, n, y_left, y_right, &
                                                 half_length, &
                                                 p0, patch) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        integer(c_int), value :: capacity                          !! length of the arrays
        type(c_ptr), value :: n                                !! number of strips, written
        type(c_ptr), value :: y_left, y_right, half_length, p0 !! mm, mm, mm, MPa, written
        type(c_ptr), value :: patch                            !! number of the patch, written

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call write_strips(handle%workspace, mirror_t(), capacity, n, &
                          [y_left, y_right, half_length, p0, patch], handle%status)
        code = handle%status%code
    end function faststrip_get_strips

    !> The elements of the last contact, if they were asked for.
    integer(c_int) function faststrip_get_elements(workspace, capacity, n, x, y, area, pn, px, &
                                                   py, sx, &
                                                   sy, state) bind(c) result(code)
        integer(c_intptr_t), value :: workspace !! a handle
        integer(c_int), value :: capacity   !! length of the arrays
        type(c_ptr), value :: n         !! number of elements, written
        type(c_ptr), value :: x, y      !! middle of the element, mm, written
        type(c_ptr), value :: area      !! mm^2, written
        type(c_ptr), value :: pn        !! pressure, MPa, written
        type(c_ptr), value :: px, py    !! traction on the rail, MPa, written
        type(c_ptr), value :: sx, sy    !! slip over rolling speed, written
        type(c_ptr), value :: state     !! 1 adhesion, 2 slip, written

        type(handle_t), pointer :: handle

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        call write_elements(handle%workspace, mirror_t(), capacity, n, &
                            [x, y, area, pn, px, py, sx, sy, state], handle%status)
        code = handle%status%code
    end function faststrip_get_elements

    !> The steps of the last contact by auto.
    integer(c_int) function faststrip_get_steps(workspace, capacity, n, normal, tangential, &
                                                strips, points, estimate, normal_us, &
                                                tangential_us) bind(c) result(code)
        integer(c_intptr_t), value :: workspace     !! a handle
        integer(c_int), value :: capacity           !! length of the arrays
        type(c_ptr), value :: n                     !! number of steps, written
        type(c_ptr), value :: normal, tangential    !! methods, written
        type(c_ptr), value :: strips, points
            !! strips across the widest patch, points along a strip, written
        type(c_ptr), value :: estimate
            !! of the target's error, -1 where it is not known, written
        type(c_ptr), value :: normal_us, tangential_us !! times, us, written

        type(handle_t), pointer :: handle
        integer :: count

        call find_handle(workspace, handle, code)
        if (code /= st_ok) return
        count = handle%workspace%steps%n
        call check_capacity(capacity, count, n, &
                            [normal, tangential, strips, points, estimate, normal_us, &
                             tangential_us], handle%status)
        code = handle%status%code
        if (is_error(handle%status)) return
        call read_steps(handle%workspace, integers_at(normal, count), &
                        integers_at(tangential, count), integers_at(strips, count), &
                        integers_at(points, count), &
                        numbers_at(estimate, count), numbers_at(normal_us, count), &
                        numbers_at(tangential_us, count))
    end function faststrip_get_steps

    !> FASTSIM with the caller's ellipse and creepage coefficients.
    integer(c_int) function faststrip_fastsim(a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load, &
                                              nx, ny, forces) bind(c) result(code)
        real(c_double), value :: a, b             !! semi-axes along x and y, mm
        real(c_double), value :: g                !! combined shear modulus, MPa
        real(c_double), value :: c11, c22, c23    !! Kalker's coefficients
        real(c_double), value :: cksi, ceta, cphi !! creepages, -, -, rad/mm
        real(c_double), value :: mu               !! coefficient of friction
        real(c_double), value :: load             !! normal force, N
        integer(c_int), value :: nx, ny           !! points along a row, rows
        type(c_ptr), value :: forces              !! Fx, Fy, Mz on the rail, N, N, N mm, written

        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(forces)) return
        call classic_fastsim([a, b, g, c11, c22, c23, cksi, ceta, cphi, mu, load], nx, ny, &
                             numbers_at(forces, 3), status)
        code = status%code
    end function faststrip_fastsim

    !> Hertz's ellipse of two curvatures.
    integer(c_int) function faststrip_hertz(e_wheel, e_rail, nu_wheel, nu_rail, inv2r_x, inv2r_y, &
                                            load, figures) bind(c) result(code)
        real(c_double), value :: e_wheel, e_rail   !! Young's moduli, MPa
        real(c_double), value :: nu_wheel, nu_rail !! Poisson's ratios
        real(c_double), value :: inv2r_x, inv2r_y  !! gap per x^2 and per y^2, 1/mm
        real(c_double), value :: load              !! normal force, N
        type(c_ptr), value :: figures  !! a, b, penetration, pmax: mm, mm, mm, MPa, written

        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(figures)) return
        call classic_hertz([e_wheel, e_rail, nu_wheel, nu_rail], inv2r_x, inv2r_y, load, &
                           numbers_at(figures, 4), status)
        code = status%code
    end function faststrip_hertz

    !> Kalker's creepage coefficients.
    integer(c_int) function faststrip_kalker(a_over_b, nu, coefficients) bind(c) result(code)
        real(c_double), value :: a_over_b !! semi-axis along x over that along y
        real(c_double), value :: nu       !! combined Poisson's ratio
        type(c_ptr), value :: coefficients !! c11, c22, c23, c33, written

        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(coefficients)) return
        call classic_kalker(a_over_b, nu, numbers_at(coefficients, 4), status)
        code = status%code
    end function faststrip_kalker

    !> The gap of a wheel on a rail, both given by points.
    integer(c_int) function faststrip_profile_gap(n_wheel, y_wheel, z_wheel, n_rail, y_rail, &
                                                  z_rail, setup, capacity, n, y, h, inv2r, &
                                                  inclination, contact) bind(c) result(code)
        integer(c_int), value :: n_wheel, n_rail        !! numbers of points
        type(c_ptr), value :: y_wheel, z_wheel          !! `n_wheel` numbers each, mm
        type(c_ptr), value :: y_rail, z_rail            !! `n_rail` numbers each, mm
        type(c_ptr), value :: setup                     !! nine numbers
        integer(c_int), value :: capacity               !! length of the arrays of the gap
        type(c_ptr), value :: n                         !! points of the gap, written
        type(c_ptr), value :: y, h, inv2r, inclination  !! mm, mm, 1/mm, rad, written
        type(c_ptr), value :: contact                   !! six numbers, written

        type(status_t) :: status
        type(gap_t) :: gap
        integer(c_int), pointer :: number

        code = st_bad_argument
        if (min(n_wheel, n_rail, capacity) < 0) return
        if (.not. (c_associated(y_wheel) .and. c_associated(z_wheel) .and. c_associated(y_rail) &
                   .and. c_associated(z_rail) .and. c_associated(setup) .and. c_associated(n) &
                   .and. c_associated(y) .and. c_associated(h) .and. c_associated(inv2r) &
                   .and. c_associated(inclination) .and. c_associated(contact))) return
        call c_f_pointer(n, number)
        call gap_of_points(numbers_at(y_wheel, n_wheel), numbers_at(z_wheel, n_wheel), &
                           numbers_at(y_rail, n_rail), numbers_at(z_rail, n_rail), &
                           numbers_at(setup, n_setup), gap, numbers_at(contact, n_contact), status)
        call copy_gap(gap, numbers_at(y, capacity), numbers_at(h, capacity), &
                      numbers_at(inv2r, capacity), numbers_at(inclination, capacity), number, &
                      status)
        code = status%code
    end function faststrip_profile_gap

    !> A workspace for a case; 0, and an error, if there cannot be one.
    subroutine make_workspace(case, max_points, number, status)
        type(c_ptr), intent(in) :: case
        integer(c_int), intent(in) :: max_points
        integer(c_intptr_t), intent(out) :: number
        type(status_t), intent(out) :: status

        type(c_case_t), pointer :: fields

        number = 0
        call find_case(case, fields, status)
        if (is_error(status)) return
        call new_handle(methods_of(fields), max_points, with_elements(fields), number, status)
    end subroutine make_workspace

    !> The strips of a solution, into a caller's five arrays.
    subroutine write_strips(workspace, mirror, capacity, n, arrays, status)
        type(workspace_t), intent(in) :: workspace !! of the solution
        type(mirror_t), intent(in) :: mirror       !! that it was solved in
        integer(c_int), intent(in) :: capacity     !! length of the arrays
        type(c_ptr), intent(in) :: n               !! number of strips, written
        type(c_ptr), intent(in) :: arrays(5)       !! in the order of `faststrip_get_strips`
        type(status_t), intent(out) :: status      !! those of `check_capacity`

        integer :: count

        count = strip_count(workspace)
        call check_capacity(capacity, count, n, arrays, status)
        if (is_error(status)) return
        call read_strips(workspace, mirror, numbers_at(arrays(1), count), &
                         numbers_at(arrays(2), count), numbers_at(arrays(3), count), &
                         numbers_at(arrays(4), count), integers_at(arrays(5), count))
    end subroutine write_strips

    !> The elements of a solution, into a caller's nine arrays.
    subroutine write_elements(workspace, mirror, capacity, n, arrays, status)
        type(workspace_t), intent(in) :: workspace !! of the solution
        type(mirror_t), intent(in) :: mirror       !! that it was solved in
        integer(c_int), intent(in) :: capacity     !! length of the arrays
        type(c_ptr), intent(in) :: n               !! number of elements, written
        type(c_ptr), intent(in) :: arrays(9)       !! in the order of `faststrip_get_elements`
        type(status_t), intent(out) :: status      !! those of `check_capacity`

        integer :: count

        count = workspace%field%n
        call check_capacity(capacity, count, n, arrays, status)
        if (is_error(status) .or. count == 0) return
        call read_elements(workspace, mirror, numbers_at(arrays(1), count), &
                           numbers_at(arrays(2), count), numbers_at(arrays(3), count), &
                           numbers_at(arrays(4), count), numbers_at(arrays(5), count), &
                           numbers_at(arrays(6), count), numbers_at(arrays(7), count), &
                           numbers_at(arrays(8), count), integers_at(arrays(9), count))
    end subroutine write_elements

    !> Tell how many there are, and refuse arrays that are missing or too short.
    subroutine check_capacity(capacity, count, n, arrays, status)
        integer(c_int), intent(in) :: capacity !! length of the arrays
        integer, intent(in) :: count           !! how many there are
        type(c_ptr), intent(in) :: n           !! where the number goes, or null
        type(c_ptr), intent(in) :: arrays(:)   !! of the caller
        type(status_t), intent(out) :: status  !! `st_bad_argument`, `st_workspace_too_small`

        integer(c_int), pointer :: number
        integer :: i

        call clear_status(status)
        if (c_associated(n)) then
            call c_f_pointer(n, number)
            number = count
        else
            call set_status(status, st_bad_argument, 'nowhere to put the number')
            return
        end if
        if (capacity < count) then
            call set_status(status, st_workspace_too_small, 'the arrays are too short')
            return
        end if
        do i = 1, size(arrays)
            if (c_associated(arrays(i))) cycle
            call set_status(status, st_bad_argument, 'an array is missing')
            return
        end do
    end subroutine check_capacity

    !> The caller's numbers at an address.
    function numbers_at(address, n) result(numbers)
        type(c_ptr), intent(in) :: address
        integer, intent(in) :: n
        real(c_double), pointer :: numbers(:)

        call c_f_pointer(address, numbers, [n])
    end function numbers_at

    !> The caller's integers at an address.
    function integers_at(address, n) result(integers)
        type(c_ptr), intent(in) :: address
        integer, intent(in) :: n
        integer(c_int), pointer :: integers(:)

        call c_f_pointer(address, integers, [n])
    end function integers_at

    !> Write words and the closing zero; what does not fit is cut.
    integer(c_int) function put_text(words, address, length) result(code)
        character(len=*), intent(in) :: words
        type(c_ptr), intent(in) :: address
        integer(c_size_t), intent(in) :: length

        character(kind=c_char), pointer :: text(:)
        integer :: i, n

        code = st_bad_argument
        if (.not. c_associated(address) .or. length < 1) return
        call c_f_pointer(address, text, [length])
        n = int(min(int(len(words), c_size_t), length - 1))
        do i = 1, n
            text(i) = words(i:i)
        end do
        text(n + 1) = c_null_char
        code = merge(st_ok, st_workspace_too_small, n == len(words))
    end function put_text
end module faststrip_interop_c
