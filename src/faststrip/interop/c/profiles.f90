!> Gaps of profiles, and of the contacts of a wheelset, in the C interface: what
!> `include/faststrip.h` declares, and where it is documented.
module faststrip_interop_c_profiles
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_intptr_t, c_ptr, &
                                           c_associated, c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_workspace_too_small, st_ok
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_interop_c, only: put_text, numbers_at
    use faststrip_interop_c_wheelset, only: read_source_at
    use faststrip_interop_profile_points, only: gap_of_profiles, copy_gap, draw_profile, n_setup, &
                                                n_contact
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, find_wheelset, find_contact
    use faststrip_interop_wheelset_new, only: profile_source_t
    use faststrip_numerics_reversal, only: reverse, reverse_negated
    use faststrip_wheelset_strips, only: find_wheel_gap
    use faststrip_wheelset_types, only: side_left
    implicit none
    private

    public :: faststrip_pair_gap, faststrip_roller_gap, faststrip_draw_profile
    public :: faststrip_wheelset_get_gap

contains

    !> The gap of a wheel on a rail, each given by name or by points.
    integer(c_int) function faststrip_pair_gap(wheel, rail, setup, capacity, n, y, h, inv2r, &
                                               inclination, contact, text, length) bind(c) &
        result(code)
        type(c_ptr), value :: wheel, rail               !! each a `faststrip_profile`
        type(c_ptr), value :: setup                     !! nine numbers
        integer(c_int), value :: capacity               !! length of the arrays of the gap
        type(c_ptr), value :: n                         !! points of the gap, written
        type(c_ptr), value :: y, h, inv2r, inclination  !! mm, mm, 1/mm, rad, written
        type(c_ptr), value :: contact                   !! six numbers, written
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        code = faststrip_roller_gap(wheel, rail, setup, 0.0_c_double, capacity, n, y, h, inv2r, &
                                    inclination, contact, text, length)
    end function faststrip_pair_gap

    !> The gap of a wheel on a roller in the rail's place, each given by name or by points.
    integer(c_int) function faststrip_roller_gap(wheel, rail, setup, roller_radius, capacity, n, &
                                                 y, h, inv2r, inclination, contact, text, length) &
        bind(c) result(code)
        type(c_ptr), value :: wheel, rail               !! each a `faststrip_profile`
        type(c_ptr), value :: setup                     !! nine numbers
        real(c_double), value :: roller_radius          !! at the crown, mm; 0: a rail
        integer(c_int), value :: capacity               !! length of the arrays of the gap
        type(c_ptr), value :: n                         !! points of the gap, written
        type(c_ptr), value :: y, h, inv2r, inclination  !! mm, mm, 1/mm, rad, written
        type(c_ptr), value :: contact                   !! six numbers, written
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        type(profile_source_t) :: of_wheel, of_rail
        type(gap_t) :: gap
        type(status_t) :: status
        integer(c_int), pointer :: number

        call check_arrays(capacity, [setup, n, y, h, inv2r, inclination, contact], status)
        if (.not. is_error(status)) call read_source_at(wheel, 'wheel', of_wheel, status)
        if (.not. is_error(status)) call read_source_at(rail, 'rail', of_rail, status)
        if (.not. is_error(status)) then
            call c_f_pointer(n, number)
            call gap_of_profiles(of_wheel, of_rail, numbers_at(setup, n_setup), gap, &
                                 numbers_at(contact, n_contact), status, roller_radius)
            call copy_gap(gap, numbers_at(y, capacity), numbers_at(h, capacity), &
                          numbers_at(inv2r, capacity), numbers_at(inclination, capacity), number, &
                          status)
        end if
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_roller_gap

    !> Points of a profile that is given by name or by points.
    integer(c_int) function faststrip_draw_profile(profile, is_rail, inclination, n, y, z, text, &
                                                   length) bind(c) result(code)
        type(c_ptr), value :: profile      !! a `faststrip_profile`
        integer(c_int), value :: is_rail   !! of a rail? (0: of a wheel)
        real(c_double), value :: inclination !! of a rail, its tangent, or 999: not said
        integer(c_int), value :: n         !! points wanted
        type(c_ptr), value :: y, z         !! mm, written
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        type(profile_source_t) :: source
        type(status_t) :: status

        call check_arrays(n, [y, z], status)
        if (.not. is_error(status)) &
            call read_source_at(profile, trim(merge('rail ', 'wheel', is_rail /= 0)), source, &
                                status)
        if (.not. is_error(status)) &
            call draw_profile(source, merge(body_rail, body_wheel, is_rail /= 0), &
                              merge(inclination, 0.0_c_double, is_rail /= 0), numbers_at(y, n), &
                              numbers_at(z, n), status)
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_draw_profile

    !> The gap of a contact of a wheelset's last solution.
    integer(c_int) function faststrip_wheelset_get_gap(wheelset, i, capacity, n, y, h, inv2r, &
                                                       inclination) bind(c) result(code)
        integer(c_intptr_t), value :: wheelset          !! a handle
        integer(c_int), value :: i                      !! contact, from 0 on
        integer(c_int), value :: capacity               !! length of the arrays
        type(c_ptr), value :: n                         !! points of the gap, written
        type(c_ptr), value :: y, h, inv2r, inclination  !! mm, mm, 1/mm, rad, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call check_arrays(capacity, [n, y, h, inv2r, inclination], handle%status)
        if (.not. is_error(handle%status)) call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) call write_gap()
        code = handle%status%code

    contains

        subroutine write_gap()
            integer(c_int), pointer :: number
            real(c_double), pointer :: rows(:), heights(:), terms(:), angles(:)

            call find_wheel_gap(handle%model, handle%workspace, handle%result, side, k, &
                                handle%status)
            if (is_error(handle%status)) return
            call c_f_pointer(n, number)
            associate (gap => handle%workspace%wheel(side)%gap)
                number = gap%n
                if (number > capacity) then
                    call set_status(handle%status, st_workspace_too_small, 'the gap has more ' // &
                                    'points than the arrays: ' // count_text(number))
                    return
                end if
                rows => numbers_at(y, gap%n)
                heights => numbers_at(h, gap%n)
                terms => numbers_at(inv2r, gap%n)
                angles => numbers_at(inclination, gap%n)
                rows = gap%y(:gap%n)
                heights = gap%h(:gap%n)
                terms = gap%inv2r(:gap%n)
                angles = gap%inclination(:gap%n)
            end associate
            ! A left wheel was solved in a mirror.
            if (side /= side_left) return
            call reverse_negated(rows)
            call reverse(heights)
            call reverse(terms)
            call reverse_negated(angles)
        end subroutine write_gap
    end function faststrip_wheelset_get_gap

    ! Are there arrays, and a length of them?
    subroutine check_arrays(capacity, arrays, status)
        integer(c_int), intent(in) :: capacity
        type(c_ptr), intent(in) :: arrays(:)
        type(status_t), intent(out) :: status

        integer :: i

        call clear_status(status)
        if (capacity < 0) call set_status(status, st_bad_argument, 'the length of arrays must ' // &
                                          'not be negative, got ' // count_text(capacity))
        do i = 1, size(arrays)
            if (.not. c_associated(arrays(i))) &
                call set_status(status, st_bad_argument, 'an array is missing')
        end do
    end subroutine check_arrays
end module faststrip_interop_c_profiles
