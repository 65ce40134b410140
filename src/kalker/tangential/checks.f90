!> What TANG refuses of bodies and grids.
module faststrip_kalker_tangential_checks
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio, largest_size, smallest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_no_contact, st_not_finite, &
                                     st_out_of_range
    use faststrip_base_material, only: material_t, check_material, combined_shear_modulus
    use faststrip_kalker_grid, only: contact_grid_t
    implicit none
    private

    public :: check_bodies, check_grid

contains

    !> Check moduli and Poisson's ratios.
    subroutine check_bodies(material, status)
        type(material_t), intent(in) :: material !! MPa
        type(status_t), intent(out) :: status    !! those of `check_material`; `st_out_of_range`

        real(wp) :: g

        call check_material(material, status)
        if (is_error(status)) return
        if (max(material%e_wheel, material%e_rail) > largest_size .or. &
            min(material%e_wheel, material%e_rail) < smallest_size) then
            call set_status(status, st_out_of_range, "Young's moduli beyond 1e-30 to 1e30 MPa")
            return
        end if
        g = combined_shear_modulus(material)
        if (g > largest_size .or. g < smallest_size) then
            call set_status(status, st_out_of_range, 'shear moduli beyond 1e-30 to 1e30 MPa')
        end if
    end subroutine check_bodies

    !> Check the elements of a grid and their pressures.
    subroutine check_grid(grid, status)
        type(contact_grid_t), intent(in) :: grid !! pressures in MPa
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_not_finite`,
                                                 !! `st_out_of_range`, `st_no_contact`

        integer :: j

        call clear_status(status)
        if (.not. allocated(grid%pressure)) then
            call set_status(status, st_bad_argument, 'a grid without pressures')
            return
        else if (min(grid%nx, grid%ny) < 1) then
            call set_status(status, st_bad_argument, 'a grid without elements')
            return
        else if (any(shape(grid%pressure) /= [grid%nx, grid%ny])) then
            call set_status(status, st_bad_argument, 'pressures of another shape than the grid')
            return
        else if (.not. all(ieee_is_finite([grid%dx, grid%dy, grid%x_first, grid%y_first]))) then
            call set_status(status, st_not_finite, 'a side or a place of the grid is not finite')
            return
        else if (min(grid%dx, grid%dy) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'elements without sides')
            return
        else if (max(grid%dx, grid%dy, abs(grid%x_first), abs(grid%y_first)) > largest_size .or. &
                 min(grid%dx, grid%dy) < smallest_size .or. &
                 max(grid%dx/grid%dy, grid%dy/grid%dx) > largest_ratio) then
            call set_status(status, st_out_of_range, 'elements or places beyond all proportion')
            return
        end if
        do j = 1, grid%ny
            if (.not. all(ieee_is_finite(grid%pressure(:, j)))) then
                call set_status(status, st_not_finite, 'a pressure is not a finite number')
                return
            else if (any(grid%pressure(:, j) < 0.0_wp)) then
                call set_status(status, st_bad_argument, 'pressures must not be negative, got ' // &
                                number_text(minval(grid%pressure(:, j))))
                return
            end if
        end do
        if (maxval(grid%pressure) > largest_size) then
            call set_status(status, st_out_of_range, 'a pressure is above 1e30 MPa')
        else if (maxval(grid%pressure) < smallest_size) then
            call set_status(status, st_no_contact, 'no element is in contact')
        end if
    end subroutine check_grid
end module faststrip_kalker_tangential_checks
