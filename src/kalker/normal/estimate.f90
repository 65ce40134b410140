!> Error estimates of a solution by Kalker's variational method, from two grids and its own.
!>
!> Richardson's estimate takes the differences of two grids, of second order. By chance two grids
!> may agree better than either with the exact solution, where a peak lies between the elements. So
!> the grid itself says how large an error must be reckoned with:
!>
!> - pmax: half the largest difference of the maximum pressure and its four neighbours,
!>   or what heights of the gap between the rows of elements ask for, which no row resolves
!>   (`faststrip_normal_estimate_unresolved`), or, of another patch of few rows, where the largest
!>   pressure may lie as well, the same half, and what a line contact of its load on the gap's
!>   curvature has,
!> - area: elements are counted, and too many of them (`faststrip_kalker_border`). What the count
!>   differs by from the area under the border; and what that area itself may lack: what it differs
!>   by from the coarser grid's, 0.35 of the square of the share of elements that have a neighbour
!>   out of contact, and the share of those with less pressure than is not resolved,
!> - penetration: a tenth of the estimate for pmax.
!>
!> The factors were chosen on 400 random contacts of 16 families, 60 by 120 elements, against grids
!> twice as fine and carried on; each bounds 95 % of them. Those of the area were chosen on 154 of
!> 11 families, 5 to 40 elements across, against the area under the border on 150 by 150.
module faststrip_kalker_normal_estimate
    use faststrip_base_kinds, only: wp, pi
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_estimate_unresolved, only: unresolved_pressure
    use faststrip_normal_types, only: normal_result_t
    use faststrip_kalker_border, only: border_area
    use faststrip_kalker_grid, only: contact_grid_t, element_y
    use faststrip_kalker_normal_options, only: fewest_elements
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    implicit none
    private

    public :: richardson_estimate, raise_estimates

    ! Given: order of a smooth solution; factor of safety for two grids (P. J. Roache, Perspective:
    ! A Method for Uniform Reporting of Grid Refinement Studies, 1994).
    real(wp), parameter :: order = 2.0_wp, two_grid_safety = 3.0_wp
    ! Tuned [1]: Factors of the estimates, see the module's head. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: peak_share = 0.5_wp, border_share = 0.35_wp
    ! Tuned [1]: Of the penetration, over that of pmax. Origin: calibrated, see the module's head.
    real(wp), parameter :: penetration_share = 0.1_wp

contains

    !> Errors of a fine solution from it and a coarser one of the same contact, as Richardson: the
    !> difference over `ratio^2 - 1`, second order in the number of elements or strips, times 3. The
    !> residuals are left as they are.
    pure subroutine richardson_estimate(coarse, fine, ratio, h_lowest, normal_errors)
        type(normal_result_t), intent(in) :: coarse !! with fewer elements
        type(normal_result_t), intent(in) :: fine   !! with more, the errors are its
        real(wp), intent(in) :: ratio               !! of their numbers, 2 for N/2 and N
        real(wp), intent(in) :: h_lowest            !! lowest height of the gap, mm
        type(normal_errors_t), intent(inout) :: normal_errors !! its estimates are replaced

        real(wp) :: factor

        factor = two_grid_safety/(ratio**order - 1.0_wp)
        normal_errors%est_err_penetration = factor*abs(coarse%penetration - fine%penetration) &
                                            /(fine%penetration - h_lowest)
        normal_errors%est_err_pmax = factor*abs(coarse%pmax - fine%pmax)/fine%pmax
        normal_errors%est_err_area = factor*abs(coarse%area - fine%area)/fine%area
    end subroutine richardson_estimate

    !> Raise Richardson's estimates to what the grid itself tells.
    pure subroutine raise_estimates(curve, compliance, grid, coarse, normal_errors)
        type(gap_curve_t), intent(in) :: curve            !! the gap that was solved, mm
        real(wp), intent(in) :: compliance                !! H of eq. (4), 1/MPa
        type(contact_grid_t), intent(in) :: grid          !! with pressures, some positive
        type(contact_grid_t), intent(in) :: coarse        !! the same with sides twice as long
        type(normal_errors_t), intent(inout) :: normal_errors !! with Richardson's estimates

        real(wp) :: around(4), pmax, y, unresolved, largest
        integer :: peak(2), i, j, border, contact, doubtful

        border = 0
        contact = 0
        doubtful = 0
        peak = maxloc(grid%pressure)
        pmax = grid%pressure(peak(1), peak(2))
        if (pmax <= 0.0_wp) return
        largest = pmax
        do j = 1, grid%ny
            if (all(grid%pressure(:, j) <= 0.0_wp)) cycle
            y = element_y(grid, j)
            unresolved = unresolved_pressure(curve, compliance, y - 0.5_wp*grid%dy, &
                                             y + 0.5_wp*grid%dy, &
                                             y + [-1.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 1.0_wp]*grid%dy)
            largest = max(largest, maxval(grid%pressure(:, j)) + unresolved)
            do i = 1, grid%nx
                if (grid%pressure(i, j) <= 0.0_wp) cycle
                contact = contact + 1
                if (grid%pressure(i, j) <= unresolved) doubtful = doubtful + 1
                if (any(neighbours(grid, i, j) <= 0.0_wp)) border = border + 1
            end do
        end do
        around = neighbours(grid, peak(1), peak(2))
        normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, largest/pmax - 1.0_wp, &
                                       peak_share*(pmax - minval(around))/pmax)
        normal_errors%est_err_area = area_error(grid, coarse, contact, border, doubtful)
        normal_errors%est_err_penetration = max(normal_errors%est_err_penetration, &
                                              penetration_share*normal_errors%est_err_pmax)
        normal_errors%est_err_pmax = max(normal_errors%est_err_pmax, &
                                       largest_of_narrow(curve, compliance, grid)/pmax - 1.0_wp)
    end subroutine raise_estimates

    !> What the count of elements lacks of the area under the border, and what that area may lack.
    pure real(wp) function area_error(grid, coarse, contact, border, doubtful) result(error)
        type(contact_grid_t), intent(in) :: grid, coarse
        integer, intent(in) :: contact, border, doubtful ! elements

        real(wp) :: under, cell

        cell = grid%dx*grid%dy
        under = border_area(grid)
        error = (abs(under/cell - contact) + abs(under - border_area(coarse))/cell &
                 + border_share*border*(real(border, wp)/contact) + doubtful)/contact
    end function area_error

    !> The maximum pressure that patches of few rows may have: at each peak of theirs half of what
    !> it stands above its lowest neighbour more, or that of a line contact.
    pure real(wp) function largest_of_narrow(curve, compliance, grid) result(largest)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(contact_grid_t), intent(in) :: grid

        real(wp) :: around(4)
        integer :: i, j, first, last

        largest = 0.0_wp
        do j = 1, grid%ny
            do i = 1, grid%nx
                associate (peak => grid%pressure(i, j))
                    if (peak <= 0.0_wp) cycle
                    around = neighbours(grid, i, j)
                    if (any(around > peak)) cycle
                    call find_rows(grid, i, j, first, last)
                    if (last - first >= fewest_elements) cycle
                    largest = max(largest, peak + peak_share*(peak - minval(around)), &
                                  line_pressure(curve, compliance, grid, i, first, last))
                end associate
            end do
        end do
    end function largest_of_narrow

    !> The rows in contact about an element.
    pure subroutine find_rows(grid, i, j, first, last)
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: i, j         !! element in contact
        integer, intent(out) :: first, last !! rows

        first = j
        do while (first > 1)
            if (grid%pressure(i, first - 1) <= 0.0_wp) exit
            first = first - 1
        end do
        last = j
        do while (last < grid%ny)
            if (grid%pressure(i, last + 1) <= 0.0_wp) exit
            last = last + 1
        end do
    end subroutine find_rows

    !> Maximum pressure of a line contact with the load of some rows on the curvature of their gap.
    pure real(wp) function line_pressure(curve, compliance, grid, i, first, last)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: i, first, last

        real(wp) :: y, half, curvature, h(3), inv2r
        integer :: k

        half = 0.5_wp*(last - first + 1)*grid%dy
        y = 0.5_wp*(element_y(grid, first) + element_y(grid, last))
        do k = 1, 3
            call gap_at(curve, y + (k - 2)*half, h(k), inv2r)
        end do
        curvature = max((h(1) - 2.0_wp*h(2) + h(3))/half**2, 0.0_wp)
        line_pressure = sqrt(sum(grid%pressure(i, first:last))*grid%dy*curvature/compliance)/pi
    end function line_pressure

    !> Pressures of the elements beside an element; zero beyond the grid.
    pure function neighbours(grid, i, j) result(pressure)
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: i, j
        real(wp) :: pressure(4)

        pressure = 0.0_wp
        if (i > 1) pressure(1) = grid%pressure(i - 1, j)
        if (i < grid%nx) pressure(2) = grid%pressure(i + 1, j)
        if (j > 1) pressure(3) = grid%pressure(i, j - 1)
        if (j < grid%ny) pressure(4) = grid%pressure(i, j + 1)
    end function neighbours
end module faststrip_kalker_normal_estimate
