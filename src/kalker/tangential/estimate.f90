!> Error estimates of forces by TANG, from those of elements twice as long and wide.
!>
!> The error falls with the sides to the power of about 1.5, but Fx is not monotone, and two grids
!> may agree by chance better than either with the exact solution: so every force counts the
!> differences d of all three a little, and what so many elements leave at least. Over mu N, the
!> moment over mu N c and about the patch's middle,
!>
!>     error_i = k_i (d_i + 0.1 max d + 0.8 f/n) + f s_i,  k = 0.62, 1.05, 0.73
!>
!> with n elements in contact and f the largest of the three forces, at most 1. s is what errors of
!> the pressures make of the forces: where they are NORM's a tenth of the penetration's estimate,
!> for the coarser grid has pressures of its own, and where they are those of strips, the same on
!> both grids, 0.4, 0.45 and 0.8 of the area's.
!>
!> The factors bound 95 % of six creepages each of random contacts of eight families, 12 to 50
!> elements across, against 72 and 108 extrapolated; for others see `docs/method.md`.
module faststrip_kalker_tangential_estimate
    use faststrip_base_kinds, only: wp, pi
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_grid, only: contact_grid_t, element_y
    implicit none
    private

    public :: estimate_tang, shares_of_grid, shares_of_strips

    ! Tuned [1]: Factors of safety of Fx, Fy, Mz. Origin: calibrated, see the module's head.
    real(wp), parameter :: safety(3) = [0.62_wp, 1.05_wp, 0.73_wp]
    ! Tuned [1]: Share of the largest difference in each. Origin: calibrated, see the module's head.
    real(wp), parameter :: largest_share = 0.1_wp
    ! Tuned [1]: What elements leave at least, times their number. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: least_left = 0.8_wp
    ! Tuned [1]: Of NORM's estimate for the penetration. Origin: calibrated, see the module's head.
    real(wp), parameter :: share_of_penetration = 0.1_wp
    ! Tuned [1]: Of the strips' estimate for the area, Fx, Fy, Mz. Origin: calibrated, see the
    ! module's head.
    real(wp), parameter :: share_of_area(3) = [0.4_wp, 0.45_wp, 0.8_wp]

contains

    !> Estimate the errors of forces from those of a coarser grid.
    pure type(force_errors_t) function estimate_tang(grid, mu, fine, coarse, shares) result(errors)
        type(contact_grid_t), intent(in) :: grid        !! the finer one, with pressures
        real(wp), intent(in) :: mu                      !! coefficient of friction
        type(tangential_result_t), intent(in) :: fine   !! forces on it
        type(tangential_result_t), intent(in) :: coarse !! with elements twice as long and wide
        real(wp), intent(in) :: shares(3)               !! s of the module's head

        real(wp) :: load, y, radius, differences(3), size_of, parts(3)
        integer :: j, elements

        load = 0.0_wp
        y = 0.0_wp
        do j = 1, grid%ny
            load = load + sum(grid%pressure(:, j))
            y = y + element_y(grid, j)*sum(grid%pressure(:, j))
        end do
        elements = count(grid%pressure > 0.0_wp)
        if (mu*load <= 0.0_wp) return
        y = y/load
        load = load*grid%dx*grid%dy
        radius = sqrt(elements*grid%dx*grid%dy/pi)
        differences = abs(about_middle(fine, y, radius) - about_middle(coarse, y, radius))/(mu*load)
        size_of = min(maxval(abs(about_middle(fine, y, radius)))/(mu*load), 1.0_wp)
        parts = safety*(differences + largest_share*maxval(differences) &
                        + least_left*size_of/elements) + size_of*shares
        errors = force_errors_t(parts(1), parts(2), parts(3) + abs(y)/radius*parts(1), &
                                abs(y)/radius*parts(1))
    end function estimate_tang

    !> What errors of NORM's pressures make of the forces on its grid.
    pure function shares_of_grid(normal_errors) result(shares)
        type(normal_errors_t), intent(in) :: normal_errors !! of NORM's solution
        real(wp) :: shares(3)

        shares = share_of_penetration*normal_errors%est_err_penetration
    end function shares_of_grid

    !> What errors of strips make of the forces on both grids.
    pure function shares_of_strips(normal_errors) result(shares)
        type(normal_errors_t), intent(in) :: normal_errors !! of the strips' solution
        real(wp) :: shares(3)

        shares = share_of_area*normal_errors%est_err_area
    end function shares_of_strips

    !> Fx, Fy and Mz about y, over the radius.
    pure function about_middle(forces, y, radius) result(three)
        type(tangential_result_t), intent(in) :: forces
        real(wp), intent(in) :: y, radius
        real(wp) :: three(3)

        three = [forces%fx, forces%fy, (forces%mz + y*forces%fx)/radius]
    end function about_middle
end module faststrip_kalker_tangential_estimate
