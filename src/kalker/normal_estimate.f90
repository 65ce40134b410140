!> How wrong a solution by Kalker's variational method is, from two grids and from its own.
!>
!> Richardson's estimate takes the differences of two grids, of second order. By chance two grids
!> may
!> agree better than either with the truth, where a peak lies between the elements or the border of
!> the patch jumps from one to the next, and the area is of first order. So the grid itself
!> says how large an error must be reckoned with:
!>
!> - pmax: half the largest difference of the largest pressure and its four neighbours,
!>   or what heights of the gap between the rows of elements ask for, which no row resolves
!>   (`faststrip_normal_unresolved`),
!> - area: twice Richardson's, and of the elements in contact a quarter of the share of those
!>   that have
!>   a neighbour out of it, and the share of those with less pressure than is not resolved,
!> - penetration: a tenth of the estimate for pmax.
!>
!> The factors were chosen on 400 random contacts of 16 families, 60 by 120 elements, against grids
!> twice as fine and carried on; each bounds 95 % of them.
module faststrip_kalker_normal_estimate
    use faststrip_base_kinds, only: wp
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_unresolved, only: unresolved_pressure
    use faststrip_kalker_grid, only: contact_grid_t, element_y
    use faststrip_geometry_gap_curve, only: gap_curve_t
    implicit none
    private

    public :: raise_estimates

    ! Tuned [1]: Factors of the estimates, see the module's head. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: peak_share = 0.5_wp, border_share = 0.25_wp, area_order = 2.0_wp
    ! Tuned [1]: Of the penetration, over that of pmax. Origin: calibrated, see the module's head.
    real(wp), parameter :: penetration_share = 0.1_wp

contains

    !> Raise Richardson's estimates to what the grid itself tells.
    pure subroutine raise_estimates(curve, compliance, grid, certificate)
        type(gap_curve_t), intent(in) :: curve            !! the gap that was solved, mm
        real(wp), intent(in) :: compliance                !! H of eq. (4), 1/MPa
        type(contact_grid_t), intent(in) :: grid          !! with pressures, some positive
        type(certificate_t), intent(inout) :: certificate !! with Richardson's estimates

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
        certificate%est_err_pmax = max(certificate%est_err_pmax, largest/pmax - 1.0_wp, &
                                       peak_share*(pmax - minval(around))/pmax)
        certificate%est_err_area = max(area_order*certificate%est_err_area, &
                                       (border_share*border + doubtful)/contact)
        certificate%est_err_penetration = max(certificate%est_err_penetration, &
                                              penetration_share*certificate%est_err_pmax)
    end subroutine raise_estimates

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
