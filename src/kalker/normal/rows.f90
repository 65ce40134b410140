!> Strips as pressures on a grid, and the rows of a grid as strips.
module faststrip_kalker_normal_rows
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, st_no_contact, &
                                     st_workspace_too_small
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_kalker_grid, only: contact_grid_t, element_x, element_y
    implicit none
    private

    public :: pressures_of_strips, rows_as_strips, count_rows

contains

    !> Pressures of a strip solution on a grid. Between the middles of strips the squares of p0 and
    !> xd are linear in y, towards an end of a patch they fall to zero.
    pure subroutine pressures_of_strips(strips, grid)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(contact_grid_t), intent(inout) :: grid  !! positioned; `pressure` is written

        integer :: i, j, k
        real(wp) :: y, p0_squared, xd_squared

        k = 1
        do j = 1, grid%ny
            grid%pressure(:, j) = 0.0_wp
            y = element_y(grid, j)
            do while (k <= strips%n)
                if (strips%y_right(k) > y) exit
                k = k + 1
            end do
            if (k > strips%n) cycle
            if (strips%y_left(k) > y) cycle
            p0_squared = between(strips, strips%p0, k, y)
            xd_squared = between(strips, strips%half_length, k, y)
            do i = 1, grid%nx
                if (element_x(grid, i)**2 >= xd_squared) cycle
                grid%pressure(i, j) = sqrt(p0_squared*(1.0_wp - element_x(grid, i)**2/xd_squared))
            end do
        end do
    end subroutine pressures_of_strips

    !> Square of a strips' quantity at y in strip k.
    pure real(wp) function between(strips, quantity, k, y)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: quantity(:), y
        integer, intent(in) :: k

        real(wp) :: middle, place, value
        integer :: other

        middle = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        other = merge(k - 1, k + 1, y < middle)
        ! Beside the patch it is zero at the edge.
        place = merge(strips%y_left(k), strips%y_right(k), y < middle)
        value = 0.0_wp
        if (other >= 1 .and. other <= strips%n) then
            if (strips%patch(other) == strips%patch(k)) then
                place = 0.5_wp*(strips%y_left(other) + strips%y_right(other))
                value = quantity(other)**2
            end if
        end if
        between = quantity(k)**2 + (value - quantity(k)**2)*((y - middle)/(place - middle))
    end function between

    !> Number of rows in contact: the strips `rows_as_strips` needs capacity for.
    pure integer function count_rows(grid)
        type(contact_grid_t), intent(in) :: grid !! with pressures

        integer :: j

        count_rows = 0
        do j = 1, grid%ny
            if (any(grid%pressure(:, j) > 0.0_wp)) count_rows = count_rows + 1
        end do
    end function count_rows

    !> Each row in contact as a strip of eq. (1), for methods that work on strips: p0 is the row's
    !> own pressure on the centre line, xd makes the strip carry the row's own load. Rows without
    !> pressure between them part patches. Meant for gaps that are symmetric in x.
    pure subroutine rows_as_strips(grid, strips, status)
        type(contact_grid_t), intent(in) :: grid        !! with pressures
        type(contact_strips_t), intent(inout) :: strips !! with capacity for `count_rows`
        type(status_t), intent(out) :: status !! `st_no_contact`, `st_workspace_too_small`

        integer :: j, before
        real(wp) :: row_sum

        call clear_status(status)
        strips%n = 0
        strips%n_patches = 0
        if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no workspace was reserved for strips')
            return
        else if (size(strips%p0) < count_rows(grid)) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the strips')
            return
        end if
        before = -1
        do j = 1, grid%ny
            row_sum = sum(grid%pressure(:, j))
            if (row_sum <= 0.0_wp) cycle
            if (before /= j - 1) strips%n_patches = strips%n_patches + 1
            before = j
            strips%n = strips%n + 1
            associate (k => strips%n)
                strips%patch(k) = strips%n_patches
                strips%y_left(k) = element_y(grid, j) - 0.5_wp*grid%dy
                strips%y_right(k) = element_y(grid, j) + 0.5_wp*grid%dy
                strips%p0(k) = centre_pressure(grid, j)
                strips%half_length(k) = row_sum*grid%dx/(0.5_wp*pi*strips%p0(k))
            end associate
        end do
        if (strips%n == 0) call set_status(status, st_no_contact, 'no element is in contact')
    end subroutine rows_as_strips

    !> Pressure of a row on the centre line: p^2 is linear in x^2 through two elements on each side,
    !> the largest of the row where there are no two.
    pure real(wp) function centre_pressure(grid, j) result(p0)
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: j

        integer :: i
        real(wp) :: square, x2, x1

        p0 = maxval(grid%pressure(:, j))
        i = floor((0.0_wp - grid%x_first)/grid%dx + 1.0_wp)
        if (i < 2 .or. i + 2 > grid%nx) return
        if (any(grid%pressure(i - 1:i + 2, j) <= 0.0_wp)) return
        associate (p => grid%pressure(i - 1:i + 2, j))
            x1 = 0.5_wp*(element_x(grid, i)**2 + element_x(grid, i + 1)**2)
            x2 = 0.5_wp*(element_x(grid, i - 1)**2 + element_x(grid, i + 2)**2)
            square = 0.5_wp*(p(2)**2 + p(3)**2)
            square = square + (square - 0.5_wp*(p(1)**2 + p(4)**2))*(x1/(x2 - x1))
            p0 = sqrt(max(square, p0**2))
        end associate
    end function centre_pressure
end module faststrip_kalker_normal_rows
