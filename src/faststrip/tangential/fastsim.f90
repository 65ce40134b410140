!> FASTSIM: Kalker's simplified theory of rolling contact on a Hertz ellipse.
!>
!> J. J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System
!> Dynamics 11 (1982) 1-13. The surface moves by `u = L p`; particles enter at the leading edge
!> (x > 0) without traction and gather it,
!>
!>     -dpx/dx = -(cksi/L1 - y cphi/L3),   -dpy/dx = -(ceta/L2 + x cphi/L3),
!>
!> until the traction reaches the bound, from where on it is scaled back to it. The flexibilities
!> make the linear forces Kalker's (theory 5):
!>
!>     L1 = 8a/(3 C11 G),  L2 = 8a/(3 C22 G),  L3 = pi a sqrt(a/b)/(4 C23 G)
!>
!> and the bound is the parabolic one, `mu (2Q/(pi a b)) (1 - (x/a)^2 - (y/b)^2)`.
!>
!> Deviation 1: the bound is scaled (by less than 3e-4 from 50x50 elements on) so that its sum
!> over the elements is mu Q exactly, whatever the grid.
module faststrip_tangential_fastsim
    use faststrip_kinds, only: wp, pi
    use faststrip_status, only: status_t, set_status, clear_status, is_error, &
                                st_bad_argument, st_workspace_too_small
    use faststrip_material, only: material_t, check_material, combined_shear_modulus, &
                                  combined_poisson_ratio
    use faststrip_creepage, only: creepage_t
    use faststrip_normal_hertz, only: hertz_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_motion, only: check_motion
    use faststrip_tangential_patch, only: patch_ellipse_t, patch_ellipse, check_strips
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, &
                                          state_adhesion, state_slip
    implicit none
    private

    public :: fastsim_solve, fastsim_strips_solve

contains

    !> Forces by FASTSIM on a Hertz ellipse with `nx` elements in each of `ny` strips of equal width.
    pure subroutine fastsim_solve(hertz, material, mu, creepage, nx, ny, result, status, field)
        type(hertz_t), intent(in) :: hertz           !! the ellipse
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about the reference point
        integer, intent(in) :: nx                    !! elements along x in each strip, >= 1
        integer, intent(in) :: ny                    !! strips across, >= 1
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (no ellipse, mu < 0, empty grid), `st_not_finite`,
            !! `st_bad_material`, `st_out_of_range` (creepages, mu, a/b), `st_workspace_too_small`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs room for nx*ny elements

        call check(material, mu, creepage, nx, ny, 1, status, field)
        if (is_error(status)) return
        if (.not. (hertz%a > 0.0_wp .and. hertz%b > 0.0_wp)) then
            call set_status(status, st_bad_argument, 'no Hertz ellipse')
            return
        end if
        call march(hertz, material, mu, creepage, nx, ny, result, status, field)
        if (is_error(status)) return
        result%stick_fraction = result%stick_fraction/hertz%area
    end subroutine fastsim_solve

    !> Forces by FASTSIM on the patches of a strip solution, each replaced by the ellipse of its
    !> area and second moments under its load, in place.
    pure subroutine fastsim_strips_solve(strips, material, mu, creepage, nx, ny, result, status, &
                                         field)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about the reference point
        integer, intent(in) :: nx                    !! elements along x in each strip, >= 1
        integer, intent(in) :: ny                    !! strips across each ellipse, >= 1
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! as `fastsim_solve`, and `st_bad_argument` for strips no normal solution can have
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs room for nx*ny elements a patch

        type(patch_ellipse_t) :: ellipse
        type(hertz_t) :: stand_in
        real(wp) :: area
        integer :: first, last

        call check_strips(strips, status)
        if (is_error(status)) return
        call check(material, mu, creepage, nx, ny, strips%n_patches, status, field)
        if (is_error(status)) return
        area = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = first + count(strips%patch(first:strips%n) == strips%patch(first)) - 1
            ellipse = patch_ellipse(strips, first, last)
            if (ellipse%load <= 0.0_wp) cycle
            stand_in%a = ellipse%a
            stand_in%b = ellipse%b
            stand_in%y = ellipse%y
            stand_in%load = ellipse%load
            stand_in%area = pi*ellipse%a*ellipse%b
            stand_in%pmax = 1.5_wp*stand_in%load/stand_in%area
            area = area + stand_in%area
            call march(stand_in, material, mu, creepage, nx, ny, result, status, field)
            if (is_error(status)) then
                result = tangential_result_t()
                return
            end if
        end do
        if (area > 0.0_wp) result%stick_fraction = result%stick_fraction/area
    end subroutine fastsim_strips_solve

    pure subroutine check(material, mu, creepage, nx, ny, n_ellipses, status, field)
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        integer, intent(in) :: nx, ny, n_ellipses
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        if (nx < 1 .or. ny < 1) then
            call set_status(status, st_bad_argument, 'a grid with no elements')
            return
        end if
        if (.not. present(field)) return
        field%n = 0
        if (.not. allocated(field%x)) then
            call set_status(status, st_workspace_too_small, 'no room reserved for the field')
        else if (size(field%x) < nx*ny*n_ellipses) then
            call set_status(status, st_workspace_too_small, 'too little room for the field')
        end if
    end subroutine check

    !> March over one ellipse and add to the sums; the stick fraction counts the area in adhesion.
    !>
    !> Tractions stand at the middles of the elements, half a step behind the leading edge first.
    !> Without spin and slip the forces are those of the linear theory times `1 + w^2/8`, w = 2/ny.
    !> Slip is `L dp/dt` left over by scaling back, the measure of slip the theory itself uses:
    !> with three flexibilities it is not parallel to the traction, but never does it feed energy.
    pure subroutine march(hertz, material, mu, creepage, nx, ny, result, status, field)
        type(hertz_t), intent(in) :: hertz
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        integer, intent(in) :: nx, ny
        type(tangential_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field

        type(kalker_coefficients_t) :: c
        real(wp) :: g, l1, l2, l3, top, width, y, row, h, x, t, bound, size_squared, scale
        real(wp) :: slope_x, slope_y, px, py, sx, sy, cell
        integer :: i, j, state

        call kalker_coefficients(hertz%a/hertz%b, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        g = combined_shear_modulus(material)
        l1 = 8.0_wp*hertz%a/(3.0_wp*c%c11*g)
        l2 = 8.0_wp*hertz%a/(3.0_wp*c%c22*g)
        l3 = pi*hertz%a*sqrt(hertz%a/hertz%b)/(4.0_wp*c%c23*g)
        width = 2.0_wp*hertz%b/ny
        top = mu*hertz%load/(hertz%a*width*grid_sum(nx, ny))
        do i = 1, ny
            t = real(2*i - 1 - ny, wp)/ny
            y = hertz%y + hertz%b*t
            row = hertz%a*sqrt(1.0_wp - t*t)
            h = 2.0_wp*row/nx
            cell = h*width
            slope_x = (creepage%cksi - hertz%y*creepage%cphi)/l1 &
                      - hertz%b*t*creepage%cphi/l3
            px = 0.0_wp
            py = 0.0_wp
            do j = 1, nx
                x = row*real(nx - 2*j + 1, wp)/nx
                ! Half a step from the edge to the middle of the first element.
                scale = merge(0.5_wp*h, h, j == 1)
                slope_y = creepage%ceta/l2 + (x + 0.5_wp*scale)*creepage%cphi/l3
                px = px - scale*slope_x
                py = py - scale*slope_y
                bound = top*max((1.0_wp - t*t) - (x/hertz%a)**2, 0.0_wp)
                size_squared = px*px + py*py
                sx = 0.0_wp
                sy = 0.0_wp
                if (size_squared <= bound*bound) then
                    state = state_adhesion
                    result%stick_fraction = result%stick_fraction + cell
                else
                    state = state_slip
                    sx = -px
                    sy = -py
                    px = px*(bound/sqrt(size_squared))
                    py = py*(bound/sqrt(size_squared))
                    sx = l1*(sx + px)/scale
                    sy = l2*(sy + py)/scale
                end if
                result%fx = result%fx + cell*px
                result%fy = result%fy + cell*py
                result%mz = result%mz + cell*(x*py - y*px)
                result%friction_power = result%friction_power - cell*(px*sx + py*sy)
                if (present(field)) then
                    field%n = field%n + 1
                    field%x(field%n) = x
                    field%y(field%n) = y
                    field%area(field%n) = cell
                    field%pn(field%n) = hertz%pmax &
                                        *sqrt(max((1.0_wp - t*t) - (x/hertz%a)**2, 0.0_wp))
                    field%px(field%n) = px
                    field%py(field%n) = py
                    field%sx(field%n) = sx
                    field%sy(field%n) = sy
                    field%state(field%n) = state
                end if
            end do
        end do
    end subroutine march

    !> Sum of `1 - (x/a)^2 - (y/b)^2` over the elements, a row's length counted in units of a and
    !> its width as one: the sums of the midpoint rule, along x in closed form.
    pure real(wp) function grid_sum(nx, ny)
        integer, intent(in) :: nx, ny

        integer :: i

        grid_sum = 0.0_wp
        do i = 1, ny
            grid_sum = grid_sum + sqrt(1.0_wp - (real(2*i - 1 - ny, wp)/ny)**2)**3
        end do
        grid_sum = grid_sum*(4.0_wp + 2.0_wp/real(nx, wp)**2)/3.0_wp
    end function grid_sum
end module faststrip_tangential_fastsim
