!> Grids of pressures for TANG where the normal problem was not solved on one.
module faststrip_kalker_tangential_pressures
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size, half_digits, smallest_size
    use faststrip_base_text, only: integer_text
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_no_contact, st_not_finite, &
                                     st_out_of_range
    use faststrip_normal_simple_patch_ellipse, only: check_strips
    use faststrip_normal_strips, only: contact_strips_t, strips_load
    use faststrip_kalker_grid, only: contact_grid_t, size_grid, element_x, element_y
    use faststrip_kalker_normal_rows, only: pressures_of_strips
    implicit none
    private

    public :: sample_strips, sample_ellipse

contains

    !> Position a grid under a strip solution and put its pressures there, scaled to its load.
    subroutine sample_strips(strips, dx, dy, most_elements, grid, status)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        real(wp), intent(in) :: dx, dy               !! sides of the elements, mm
        integer, intent(in) :: most_elements         !! the grid may have
        type(contact_grid_t), intent(inout) :: grid  !! positioned; heights are zero
        type(status_t), intent(out) :: status        !! those of `check_strips`; `st_bad_argument`,
                                                     !! `st_not_finite` (sides), `st_out_of_range`
                                                     !! (elements), `st_no_contact` (none is hit)

        call check_strips(strips, status)
        if (is_error(status)) return
        call position_grid(maxval(strips%half_length(:strips%n)), strips%y_left(1), &
                           strips%y_right(strips%n), dx, dy, most_elements, grid, status)
        if (is_error(status)) return
        call pressures_of_strips(strips, grid)
        call scale_to(strips_load(strips), grid, status)
    end subroutine sample_strips

    !> Position a grid under an ellipse and put Hertz's pressures there, scaled to the load.
    subroutine sample_ellipse(a, b, y0, load, dx, dy, most_elements, grid, status)
        real(wp), intent(in) :: a, b         !! semi-axes along x and y, mm
        real(wp), intent(in) :: y0           !! middle, mm
        real(wp), intent(in) :: load         !! N
        real(wp), intent(in) :: dx, dy       !! sides of the elements, mm
        integer, intent(in) :: most_elements !! the grid may have
        type(contact_grid_t), intent(inout) :: grid !! positioned; heights are zero
        type(status_t), intent(out) :: status !! `st_bad_argument`, `st_not_finite`,
                                              !! `st_out_of_range`, `st_no_contact`
        integer :: i, j
        real(wp) :: pmax, rest

        call clear_status(status)
        if (.not. all(ieee_is_finite([a, b, y0, load]))) then
            call set_status(status, st_not_finite, 'an ellipse or its load is not finite')
            return
        else if (min(a, b) <= 0.0_wp .or. load < 0.0_wp) then
            call set_status(status, st_bad_argument, 'no ellipse, or a negative load')
            return
        else if (max(a, b, abs(y0), load) > largest_size .or. min(a, b) < smallest_size) then
            call set_status(status, st_out_of_range, 'an ellipse beyond all proportion')
            return
        end if
        call position_grid(a, y0 - b, y0 + b, dx, dy, most_elements, grid, status)
        if (is_error(status)) return
        pmax = 1.5_wp*(load/(pi*a))/b ! Given: Hertz
        do j = 1, grid%ny
            do i = 1, grid%nx
                rest = 1.0_wp - (element_x(grid, i)/a)**2 - ((element_y(grid, j) - y0)/b)**2
                grid%pressure(i, j) = pmax*sqrt(max(rest, 0.0_wp))
            end do
        end do
        call scale_to(load, grid, status)
    end subroutine sample_ellipse

    !> Position a grid about the middle of a rectangle.
    subroutine position_grid(half_length, y_left, y_right, dx, dy, most_elements, grid, status)
        real(wp), intent(in) :: half_length, y_left, y_right, dx, dy
        integer, intent(in) :: most_elements
        type(contact_grid_t), intent(inout) :: grid
        type(status_t), intent(out) :: status

        real(wp) :: columns, rows

        call clear_status(status)
        if (.not. (ieee_is_finite(dx) .and. ieee_is_finite(dy))) then
            call set_status(status, st_not_finite, 'sides of elements are not finite')
            return
        else if (min(dx, dy) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'elements without sides')
            return
        else if (max(dx, dy) > largest_size .or. min(dx, dy) < smallest_size) then
            call set_status(status, st_out_of_range, 'elements beyond all proportion')
            return
        end if
        ! A whole number of elements stays one.
        columns = max((1.0_wp - half_digits)*(2.0_wp*half_length/dx), 1.0_wp)
        rows = max((1.0_wp - half_digits)*((y_right - y_left)/dy), 1.0_wp)
        ! What lies beside the last whole element may hold the middle of another one.
        if ((columns + 1.0_wp)*(rows + 1.0_wp) > most_elements) then
            call set_status(status, st_out_of_range, 'the grid must have at most ' &
                            // integer_text(most_elements) // ' elements (max_elements), got ' &
                            // trim(number_text(columns)) // ' by ' // trim(number_text(rows)))
            return
        end if
        call size_grid(grid, ceiling(columns), ceiling(rows))
        grid%dx = dx
        grid%dy = dy
        grid%x_first = -0.5_wp*(grid%nx - 1)*dx
        grid%y_first = 0.5_wp*(y_left + y_right) - 0.5_wp*(grid%ny - 1)*dy
        grid%height = 0.0_wp
    end subroutine position_grid

    subroutine scale_to(load, grid, status)
        real(wp), intent(in) :: load
        type(contact_grid_t), intent(inout) :: grid
        type(status_t), intent(out) :: status

        real(wp) :: total

        call clear_status(status)
        total = sum(grid%pressure)*grid%dx*grid%dy
        if (total <= 0.0_wp) then
            call set_status(status, st_no_contact, 'no element has its middle in the contact')
            return
        end if
        grid%pressure = grid%pressure*(load/total)
    end subroutine scale_to
end module faststrip_kalker_tangential_pressures
