!> The elements of a wheel's contact: pressure, tractions and slip as they are, not in the mirror
!> that a left wheel and a wheelset which rolls backwards are solved in.
module faststrip_wheelset_field
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument
    use faststrip_numerics_reversal, only: reverse
    use faststrip_tangential_types, only: tangential_field_t, reserve_field
    use faststrip_wheelset_types, only: wheelset_workspace_t, wheelset_result_t, side_left
    implicit none
    private

    public :: find_wheel_field, mirror_elements

contains

    !> The elements of a contact of the last solution, if its model's case asks for them, in the
    !> frame of the contact. Allocates where `field` is too small.
    subroutine find_wheel_field(workspace, result, side, i, field, status)
        type(wheelset_workspace_t), intent(in) :: workspace !! of the solution
        type(wheelset_result_t), intent(in) :: result       !! of the same solution
        integer, intent(in) :: side                         !! `side_right`, `side_left`
        integer, intent(in) :: i                            !! contact of that wheel
        type(tangential_field_t), intent(inout) :: field    !! empty if there are none
        type(status_t), intent(out) :: status               !! `st_bad_argument`: no such contact

        logical :: is_small

        call clear_status(status)
        if (i < 1 .or. i > result%wheel(side)%n .or. .not. workspace%has_last &
            .or. result%wheel(side)%solutions == 0) then
            call set_status(status, st_bad_argument, 'there is no such contact of the wheel')
            return
        end if
        associate (from => workspace%wheel(side)%contact(i)%field, n => field%n)
            is_small = .not. allocated(field%x)
            if (.not. is_small) is_small = size(field%x) < from%n
            if (is_small) call reserve_field(field, max(from%n, 1), status)
            if (is_error(status)) return
            n = from%n
            ! There may be no arrays to copy from.
            if (n == 0) return
            field%x(:n) = from%x(:n)
            field%y(:n) = from%y(:n)
            field%dx(:n) = from%dx(:n)
            field%area(:n) = from%area(:n)
            field%pn(:n) = from%pn(:n)
            field%px(:n) = from%px(:n)
            field%py(:n) = from%py(:n)
            field%sx(:n) = from%sx(:n)
            field%sy(:n) = from%sy(:n)
            field%state(:n) = from%state(:n)
            field%temperature(:n) = from%temperature(:n)
            field%has_temperature = from%has_temperature
            call mirror_elements([workspace%is_reversed(side), side == side_left], field%x(:n), &
                                 field%y(:n), field%area(:n), field%pn(:n), field%px(:n), &
                                 field%py(:n), field%sx(:n), field%sy(:n), field%state(:n), &
                                 field%dx(:n))
            if (side == side_left) call mirror_values(field%y(:n), field%temperature(:n))
        end associate
    end subroutine find_wheel_field

    !> Elements in a mirror. One in y puts the last row first; each begins where it did.
    subroutine mirror_elements(mirrored, x, y, area, pn, px, py, sx, sy, state, dx)
        logical, intent(in) :: mirrored(2)      !! do x and y become their negatives?
        real(wp), intent(inout) :: x(:), y(:)   !! middle of the element, mm
        real(wp), intent(inout) :: area(:)      !! mm^2
        real(wp), intent(inout) :: pn(:)        !! pressure, MPa
        real(wp), intent(inout) :: px(:), py(:) !! traction on the rail, MPa
        real(wp), intent(inout) :: sx(:), sy(:) !! slip over rolling speed
        integer, intent(inout) :: state(:)      !! adhesion or slip
        real(wp), intent(inout), optional :: dx(:) !! mm

        integer :: first, last

        if (mirrored(1)) then
            x = -x
            px = -px
            sx = -sx
        end if
        if (.not. mirrored(2)) return
        y = -y
        py = -py
        sy = -sy
        call turn_round(1, size(x))
        first = 1
        do while (first <= size(x))
            last = row_end(y, first)
            call turn_round(first, last)
            first = last + 1
        end do

    contains

        subroutine turn_round(i, j)
            integer, intent(in) :: i, j ! from the one element to the other

            call reverse(x(i:j))
            call reverse(y(i:j))
            call reverse(area(i:j))
            call reverse(pn(i:j))
            call reverse(px(i:j))
            call reverse(py(i:j))
            call reverse(sx(i:j))
            call reverse(sy(i:j))
            call reverse(state(i:j))
            if (present(dx)) call reverse(dx(i:j))
        end subroutine turn_round
    end subroutine mirror_elements

    !> Values of elements that have been mirrored in y, in the same order.
    subroutine mirror_values(y, values)
        real(wp), intent(in) :: y(:)         ! as they are in the mirror
        real(wp), intent(inout) :: values(:) ! of each

        integer :: first, last

        call reverse(values)
        first = 1
        do while (first <= size(y))
            last = row_end(y, first)
            call reverse(values(first:last))
            first = last + 1
        end do
    end subroutine mirror_values

    !> The last element of the row that begins with another one.
    pure integer function row_end(y, first)
        real(wp), intent(in) :: y(:)
        integer, intent(in) :: first

        row_end = first
        do while (row_end < size(y))
            if (abs(y(row_end + 1) - y(first)) > 0.0_wp) exit
            row_end = row_end + 1
        end do
    end function row_end
end module faststrip_wheelset_field
