!> Where the grid of a gap h(y) + A(y) x^2 has to lie, and what pressures to start from.
!>
!> Middles of elements lie at odd multiples of half a side, x = 0 and y = 0 between elements, as
!> CONTACT's grids of the reference do. Rows and columns are taken as the start has them, with
!> margin. Displacements are positive, so that all contact is where the undeformed gap is below the
!> approach: rows of which that holds and that are not in the grid are looked at afterwards, on the
!> line x = 0, with the rows of the solution as strips. Whether the columns suffice is seen by the
!> outermost.
module faststrip_kalker_normal_position
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_ratio, half_digits
    use faststrip_base_text, only: integer_text
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_contact, st_out_of_range
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_strip_patches, only: patches_t, max_patches
    use faststrip_normal_strip_start, only: start_patches
    use faststrip_normal_strip_state, only: flattest
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_kalker_grid, only: contact_grid_t, size_grid, element_x, element_y
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: extent_t, guess_extent, extent_of_strips, extent_of_grid, position_grid
    public :: take_missing_rows, columns_suffice, reaches_end_of_data, guess_pressures
    public :: enlargement

    !> What a grid has to hold.
    type :: extent_t
        real(wp) :: y_from = 0.0_wp      !! left end of the contact, mm
        real(wp) :: y_to = 0.0_wp        !! right end, mm
        real(wp) :: half_length = 0.0_wp !! largest |x| in contact, mm
        real(wp) :: half_width = 0.0_wp  !! half the width of all patches together, mm
        real(wp) :: level = 0.0_wp       !! height of the gap at the ends, from the lowest, mm
    end type extent_t

    !> By how much a grid is larger than what it was to hold: of the level for rows of a guess, of
    !> the half-length where columns are missing.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: enlargement = 1.3_wp
    ! Tuned [1]. Origin: chosen: errors of the area of strips.
    real(wp), parameter :: strips_margin = 0.02_wp ! of the extent of a strip solution
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: guess_length = 1.1_wp ! of the half-length, for columns of a guess
    ! A row is missing if its gap is below this of the approach: strips are not exact.
    ! Tuned [1]. Origin: chosen: errors of the penetration of strips.
    real(wp), parameter :: doubtful = 1.0e-3_wp

contains

    !> Extent of the ellipse that fits the gap's width, as the strips start.
    pure subroutine guess_extent(curve, compliance, demand, extent, status)
        type(gap_curve_t), intent(in) :: curve   !! a gap that was set
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand     !! load or penetration
        type(extent_t), intent(out) :: extent    !! first guess
        type(status_t), intent(out) :: status    !! `st_no_contact`

        type(patches_t) :: patches
        real(wp) :: depth, h, a_lowest, a, y, low(max_patches), high(max_patches)
        integer :: i, n

        call clear_status(status)
        call start_patches(curve, compliance, demand, patches, depth)
        if (patches%n < 1 .or. .not. depth > 0.0_wp) then
            call set_status(status, st_no_contact, 'no place where the bodies touch was found')
            return
        end if
        extent%level = patches%at(1)%seed_level
        call level_intervals(curve, curve%h_lowest + enlargement*extent%level, low, high, n)
        extent%y_from = low(1)
        extent%y_to = high(n)
        extent%half_width = 0.5_wp*sum(patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from)
        ! A x^2 at the tip of the lowest place; further on A may be smaller, the gap is larger.
        call gap_at(curve, curve%y_lowest, h, a_lowest)
        a_lowest = max(a_lowest, flattest)
        extent%half_length = patches%at(1)%seed_length
        do i = 1, curve%n
            y = curve%y(i)
            call gap_at(curve, y, h, a)
            if (h - curve%h_lowest >= extent%level) cycle
            extent%half_length = max(extent%half_length, patches%at(1)%seed_length*sqrt( &
                (1.0_wp - (h - curve%h_lowest)/extent%level)*(a_lowest/max(a, flattest))))
        end do
        extent%half_length = guess_length*extent%half_length
    end subroutine guess_extent

    !> Extent of a strip solution.
    pure subroutine extent_of_strips(strips, extent)
        type(contact_strips_t), intent(in) :: strips !! a solution with a strip at least
        type(extent_t), intent(inout) :: extent      !! a guess, replaced where it is known better

        real(wp) :: margin

        associate (left => strips%y_left(1), right => strips%y_right(strips%n))
            margin = strips_margin*(right - left)
            extent%y_from = left - margin
            extent%y_to = right + margin
        end associate
        extent%half_length = (1.0_wp + strips_margin)*maxval(strips%half_length(:strips%n))
    end subroutine extent_of_strips

    !> Extent of a solution on another grid, with margin for one of its elements.
    pure subroutine extent_of_grid(grid, extent)
        type(contact_grid_t), intent(in) :: grid !! with pressures
        type(extent_t), intent(inout) :: extent  !! a guess, replaced where it is known better

        integer :: i, j, first, last

        first = grid%ny
        last = 1
        extent%half_length = 0.0_wp
        do j = 1, grid%ny
            if (.not. any(grid%pressure(:, j) > 0.0_wp)) cycle
            first = min(first, j)
            last = j
            do i = 1, grid%nx
                if (grid%pressure(i, j) > 0.0_wp) &
                    extent%half_length = max(extent%half_length, abs(element_x(grid, i)))
            end do
        end do
        extent%half_length = extent%half_length + grid%dx
        extent%y_from = element_y(grid, first) - grid%dy
        extent%y_to = element_y(grid, last) + grid%dy
    end subroutine extent_of_grid

    !> Position a grid that holds an extent, as far as the gap has data, and take the heights.
    subroutine position_grid(curve, extent, dx, dy, most_elements, grid, status)
        type(gap_curve_t), intent(in) :: curve     !! a gap that was set
        type(extent_t), intent(in) :: extent       !! to be covered
        real(wp), intent(in) :: dx, dy             !! sides of the elements, mm, > 0
        integer, intent(in) :: most_elements       !! refuse more
        type(contact_grid_t), intent(inout) :: grid !! positioned; its pressures are of no meaning
        type(status_t), intent(out) :: status      !! `st_out_of_range`

        integer :: first, last, i, j
        real(wp) :: columns, rows, h, a

        call rows_of_data(curve, dy, first, last, status)
        if (is_error(status)) return
        first = max(first, min(floor(extent%y_from/dy - 0.5_wp), last))
        last = min(last, max(ceiling(extent%y_to/dy - 0.5_wp), first))
        columns = 2.0_wp*(aint(extent%half_length/dx) + 2.0_wp)
        rows = real(last, wp) - first + 1.0_wp
        if (columns*rows > most_elements) then
            call set_status(status, st_out_of_range, 'the contact must take at most ' &
                            //integer_text(most_elements)//' elements (max_elements), got ' &
                            //trim(number_text(columns))//' by '//trim(number_text(rows)))
            return
        end if
        call size_grid(grid, nint(columns), last - first + 1)
        grid%dx = dx
        grid%dy = dy
        grid%x_first = -0.5_wp*(grid%nx - 1)*dx
        grid%y_first = (first + 0.5_wp)*dy
        do j = 1, grid%ny
            call gap_at(curve, element_y(grid, j), h, a)
            do i = 1, grid%nx
                grid%height(i, j) = h + a*element_x(grid, i)**2
            end do
        end do
    end subroutine position_grid

    !> The rows whose middles the gap's points enclose.
    pure subroutine rows_of_data(curve, dy, from, to, status)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: dy
        integer, intent(out) :: from, to
        type(status_t), intent(out) :: status

        real(wp) :: low, high

        call clear_status(status)
        from = 0
        to = -1
        low = curve%y(1)/dy
        high = curve%y(curve%n)/dy
        ! Numbers of rows have to fit in integers.
        if (high - low > largest_ratio .or. max(abs(low), abs(high)) > 0.5_wp*huge(1)) then
            call set_status(status, st_out_of_range, 'elements of '//trim(number_text(dy)) &
                            //' mm are too short for the gap''s points')
            return
        end if
        from = ceiling(low - 0.5_wp - half_digits)
        to = floor(high - 0.5_wp + half_digits)
        if (to < from) &
            call set_status(status, st_out_of_range, 'elements of '//trim(number_text(dy)) &
                            //' mm are longer than the gap')
    end subroutine rows_of_data

    !> Make an extent hold the rows outside a grid in which its solution would overlap.
    pure subroutine take_missing_rows(curve, compliance, grid, approach, extent, is_missing)
        type(gap_curve_t), intent(in) :: curve   !! the gap of the grid
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(contact_grid_t), intent(in) :: grid !! positioned by `position_grid`, with pressures
        real(wp), intent(in) :: approach         !! D of its solution, mm
        type(extent_t), intent(inout) :: extent  !! grows
        logical, intent(out) :: is_missing       !! is there such a row?

        real(wp) :: p0(grid%ny), xd(grid%ny), y, h, a, u
        integer :: from, to, first, j, k
        type(status_t) :: status

        do k = 1, grid%ny
            p0(k) = maxval(grid%pressure(:, k))
            xd(k) = 0.0_wp
            if (p0(k) > 0.0_wp) xd(k) = sum(grid%pressure(:, k))*grid%dx/(0.5_wp*pi*p0(k))
        end do
        is_missing = .false.
        call rows_of_data(curve, grid%dy, from, to, status)
        first = nint(grid%y_first/grid%dy - 0.5_wp)
        do j = from, to
            if (j >= first .and. j < first + grid%ny) cycle
            y = (j + 0.5_wp)*grid%dy
            call gap_at(curve, y, h, a)
            if (h >= approach) cycle
            u = 0.0_wp
            do k = 1, grid%ny
                if (xd(k) == 0.0_wp) cycle
                u = u + compliance*p0(k)*xd(k)*strip_influence_edges( &
                    (element_y(grid, k) - 0.5_wp*grid%dy - y)/xd(k), &
                    (element_y(grid, k) + 0.5_wp*grid%dy - y)/xd(k))
            end do
            if (h + u - approach >= doubtful*(approach - curve%h_lowest)) cycle
            is_missing = .true.
            extent%y_from = min(extent%y_from, y)
            extent%y_to = max(extent%y_to, y)
        end do
    end subroutine take_missing_rows

    !> Are the outermost columns free of contact?
    pure logical function columns_suffice(grid)
        type(contact_grid_t), intent(in) :: grid !! with pressures

        columns_suffice = .not. (any(grid%pressure(1, :) > 0.0_wp) &
                                 .or. any(grid%pressure(grid%nx, :) > 0.0_wp))
    end function columns_suffice

    !> Is the last row for which there are points of the gap in contact?
    pure logical function reaches_end_of_data(curve, grid) result(reaches)
        type(gap_curve_t), intent(in) :: curve   !! the gap of the grid
        type(contact_grid_t), intent(in) :: grid !! positioned by `position_grid`, with pressures

        integer :: from, to, first
        type(status_t) :: status

        call rows_of_data(curve, grid%dy, from, to, status)
        first = nint(grid%y_first/grid%dy - 0.5_wp)
        reaches = .false.
        if (first == from) reaches = any(grid%pressure(:, 1) > 0.0_wp)
        if (first + grid%ny - 1 == to) &
            reaches = reaches .or. any(grid%pressure(:, grid%ny) > 0.0_wp)
    end function reaches_end_of_data

    !> Pressures to start from: of the ellipse that fits the gap's width, falling off with the gap.
    !> Only their proportions count.
    pure subroutine guess_pressures(curve, extent, grid)
        type(gap_curve_t), intent(in) :: curve      !! the gap of the grid
        type(extent_t), intent(in) :: extent        !! as guessed
        type(contact_grid_t), intent(inout) :: grid !! positioned; `pressure` is written

        real(wp) :: h, a, a_lowest, rise
        integer :: i, j

        call gap_at(curve, curve%y_lowest, h, a_lowest)
        rise = max(a_lowest, flattest)*(extent%half_length/guess_length)**2
        do j = 1, grid%ny
            call gap_at(curve, element_y(grid, j), h, a)
            do i = 1, grid%nx
                grid%pressure(i, j) = sqrt(max(0.0_wp, 1.0_wp - (h - curve%h_lowest)/extent%level &
                                               - a*element_x(grid, i)**2/rise))
            end do
        end do
    end subroutine guess_pressures
end module faststrip_kalker_normal_position
