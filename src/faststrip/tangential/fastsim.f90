!> Kalker's simplified theory of rolling contact on a Hertz ellipse: FASTSIM.
!>
!> J. J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle System
!> Dynamics 11 (1982) 1-13. The surface moves by `u = L p`; particles enter at the leading edge
!> (x > 0) without traction and gather it,
!>
!>     -dpx/dx = -(cksi/L1 - y cphi/L3),   -dpy/dx = -(ceta/L2 + x cphi/L3),
!>
!> until the traction reaches the bound, from where on it is scaled back to it. The flexibilities
!> make the linear forces Kalker's:
!>
!>     L1 = 8a/(3 C11 G),  L2 = 8a/(3 C22 G),  L3 = pi a sqrt(a/b)/(4 C23 G)
!>
!> and the bound is the parabolic one, `mu (2Q/(pi a b)) (1 - (x/a)^2 - (y/b)^2)`.
!>
!> One deviation from Kalker:
!>
!> - **F1** The bound is scaled (by less than 3e-4 from 50x50 elements on) so that its sum over the
!>   elements is mu Q exactly, whatever the grid.
!>
!> Two variants in use (`fastsim_variant_t`):
!>
!>  1. the **elliptic bound** of Hertz's pressure, `mu pmax sqrt(1 - (x/a)^2 - (y/b)^2)`, scaled
!>     alike: the true one, where the flexibilities go with the parabolic one;
!>  2. a **single flexibility** for all three (J. J. Kalker, 1990, section 3.6),
!>
!>         L = (L1 |cksi| + L2 |ceta| + L3 c |cphi|)/sqrt(cksi^2 + ceta^2 + (c cphi)^2),
!>
!>     c = sqrt(ab): slip is then parallel to the traction, and the linear forces are Kalker's for
!>     one creepage at a time only.
!>
!> And a bound that falls with slip (`faststrip_base_friction`), along with either:
!>
!> - **F2** The coefficient is that of the slip which there would be if it were still the one of the
!>   element ahead: what springs of the bedding give back by its fall is no cause of a further fall.
!>   On a bedding of springs a coefficient that is given by all of the slip has no solution that
!>   grids agree on (CONTACT has a friction memory for that); this one needs no iteration, is unique
!>   and converges. Particles enter with the static value; one that sticks again keeps what it has.
!>   A coefficient that falls with temperature is that of the heat of the elements ahead in the row
!>   and its own, under this slip (`hot_share`).
!>
!> On a curved surface an ellipse rolls with the mean by load of the motion of the strips under it,
!> and each row has the rest besides, with L1 along x (`faststrip_tangential_strip_slip`).
module faststrip_tangential_fastsim
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size, smallest_size
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, count_text, &
                                     st_bad_argument, st_bad_material, st_not_finite, &
                                     st_out_of_range
    use faststrip_base_material, only: material_t, check_material, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, check_friction, falls, falls_when_hot, &
                                       falling_share, hot_share
    use faststrip_base_friction_table, only: mean_mu_between
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_tangential_heat_sources, only: rise_ahead, most_along, weight_of_itself
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_motion, only: check_motion, check_ellipse
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end, &
                                                     check_strips
    use faststrip_tangential_strip_slip, only: patch_motion, rest_of_slip, slip_between, add_between
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, strip_forces_t, &
                                          empty_field, empty_strip_forces, add_element, &
                                          match_power, stick_share, state_adhesion, state_slip, &
                                          most_rows
    implicit none
    private

    public :: fastsim_solve, fastsim_strips_solve, fastsim_coefficients_solve, fastsim_variant_t
    public :: fastsim_curved_solve, fastsim_rolling_t

    !> What is not Kalker's standard choice.
    type :: fastsim_variant_t
        logical :: elliptic_bound = .false.     !! or the parabolic one
        logical :: single_flexibility = .false. !! or three
    end type fastsim_variant_t

    !> How a contact rolls.
    type :: fastsim_rolling_t
        type(material_t) :: material       !! moduli in MPa
        real(wp) :: mu = 0.0_wp            !! coefficient of friction, >= 0
        type(creepage_t) :: creepage       !! about y = 0, rail relative to wheel
        integer :: nx = 0                  !! elements along x in each row, >= 1
        integer :: ny = 0                  !! rows across each ellipse, >= 1
        type(fastsim_variant_t) :: variant !! or Kalker's choice
    end type fastsim_rolling_t

    !> One ellipse.
    type, extends(patch_ellipse_t) :: ellipse_t
        type(kalker_coefficients_t) :: c   ! of the ellipse
        real(wp) :: g = 0.0_wp             ! combined shear modulus, MPa
        real(wp) :: mu = 0.0_wp            ! coefficient of friction
        integer :: nx = 0, ny = 0          ! elements along, rows across
        integer :: first = 0, last = 0     ! of the strips under it, where they count
    end type ellipse_t

    !> Areas of the elements gone through so far.
    type :: areas_t
        real(wp) :: stuck = 0.0_wp   !! in adhesion, mm^2
        real(wp) :: covered = 0.0_wp !! all, mm^2
    end type areas_t

contains

    !> Forces by FASTSIM on a Hertz ellipse with `nx` elements in each of `ny` strips of equal
    !> width; tractions stand at the middles of the elements, half a step behind the leading edge
    !> first.
    !>
    !> Without spin and slip the forces are those of the linear theory times `1 + w^2/8`, w = 2/ny.
    !> Slip is what scaling back leaves over of the elastic step, `L_i (dp_i/h)`, the measure the
    !> theory itself uses: with three flexibilities it is not parallel to the traction, but it
    !> never feeds energy.
    pure subroutine fastsim_solve(hertz, material, mu, creepage, nx, ny, result, status, field, &
                                  variant, friction)
        type(hertz_t), intent(in) :: hertz           !! the ellipse, centred at y = hertz%y
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, rail relative to wheel
        integer, intent(in) :: nx                    !! elements along x in each strip, >= 1
        integer, intent(in) :: ny                    !! strips across, >= 1; both <= 10000
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (no ellipse, mu < 0, grid), `st_not_finite`,
            !! `st_bad_material`, `st_out_of_range` (creepages, mu, a/b), `st_workspace_too_small`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for nx*ny elements
        type(fastsim_variant_t), intent(in), optional :: variant !! Kalker's choice without
        type(friction_t), intent(in), optional :: friction
            !! how the bound falls with slip and temperature, and a table over y in place of mu,
            !! which is then its mean; other parts do not count here

        type(areas_t) :: areas
        type(kalker_coefficients_t) :: c

        call check_input(mu, creepage, nx, ny, 1, status, field)
        if (is_error(status)) return
        call check_fall(nx, status, friction)
        if (is_error(status)) return
        call check_material(material, status)
        if (is_error(status)) return
        call check_ellipse(hertz, status)
        if (is_error(status)) return
        call kalker_coefficients(hertz%a/hertz%b, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        call add_ellipse(ellipse_t(hertz%a, hertz%b, hertz%y, hertz%load, c, &
                                   combined_shear_modulus(material), mu, nx, ny), creepage, &
                         chosen(variant), result, areas, field, friction)
        result%stick_fraction = stick_share(areas%stuck, areas%covered)
        if (present(field)) call match_power(result%friction_power, 1, field)
    end subroutine fastsim_solve

    !> Forces by FASTSIM on an ellipse with creepage coefficients the caller has, what vehicle codes
    !> keep in tables.
    pure subroutine fastsim_coefficients_solve(hertz, g, c, mu, creepage, nx, ny, result, status, &
                                               field)
        type(hertz_t), intent(in) :: hertz           !! `a`, `b`, `y` and `load` count
        real(wp), intent(in) :: g                    !! combined shear modulus, MPa
        type(kalker_coefficients_t), intent(in) :: c !! c11, c22, c23 > 0; c33 is not used
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, rail relative to wheel
        integer, intent(in) :: nx                    !! elements along x in each strip, >= 1
        integer, intent(in) :: ny                    !! strips across, >= 1; both <= 10000
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (no ellipse, coefficients, mu < 0, grid), `st_not_finite`,
            !! `st_bad_material` (g), `st_out_of_range` (anything beyond all proportion),
            !! `st_workspace_too_small`
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for nx*ny elements

        type(areas_t) :: areas

        call check_input(mu, creepage, nx, ny, 1, status, field)
        if (is_error(status)) return
        if (.not. (ieee_is_finite(hertz%a) .and. ieee_is_finite(hertz%b) &
                   .and. ieee_is_finite(hertz%y) .and. ieee_is_finite(hertz%load) &
                   .and. ieee_is_finite(g) .and. ieee_is_finite(c%c11) &
                   .and. ieee_is_finite(c%c22) .and. ieee_is_finite(c%c23))) then
            call set_status(status, st_not_finite, 'ellipse, load, shear modulus or creepage ' // &
                            'coefficients are not finite')
        else if (hertz%a <= 0.0_wp .or. hertz%b <= 0.0_wp .or. hertz%load < 0.0_wp) then
            call set_status(status, st_bad_argument, 'no ellipse with a load: a ' // &
                            trim(number_text(hertz%a)) // ' mm, b ' // &
                            trim(number_text(hertz%b)) // ' mm, load ' // &
                            trim(number_text(hertz%load)) // ' N')
        else if (g <= 0.0_wp) then
            call set_status(status, st_bad_material, 'shear modulus must be above 0, got ' // &
                            trim(number_text(g)) // ' MPa')
        else if (min(c%c11, c%c22, c%c23) <= 0.0_wp) then
            call set_status(status, st_bad_argument, &
                            'creepage coefficients must be above 0, got ' // &
                            trim(number_text(c%c11)) // ', ' // trim(number_text(c%c22)) // &
                            ', ' // trim(number_text(c%c23)))
        else if (max(hertz%a, hertz%b, abs(hertz%y), g, hertz%load, c%c11, c%c22, c%c23) &
                 > largest_size .or. &
                 min(hertz%a, hertz%b, g, c%c11, c%c22, c%c23) < smallest_size) then
            call set_status(status, st_out_of_range, 'ellipse, load, shear modulus or creepage' // &
                            ' coefficients beyond all proportion')
        else
            call add_ellipse(ellipse_t(hertz%a, hertz%b, hertz%y, hertz%load, c, g, mu, nx, ny), &
                             creepage, chosen(), result, areas, field)
            result%stick_fraction = stick_share(areas%stuck, areas%covered)
            if (present(field)) call match_power(result%friction_power, 1, field)
        end if
    end subroutine fastsim_coefficients_solve

    !> Forces by FASTSIM on the virtual ellipses of any contact patches: same area, proportions of
    !> the second moments, centroid and load (`patch_ellipse`), each under its own Hertz pressure.
    pure subroutine fastsim_strips_solve(strips, material, mu, creepage, nx, ny, result, status, &
                                         field, variant, friction)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, rail relative to wheel
        integer, intent(in) :: nx                    !! elements along x in each row, >= 1
        integer, intent(in) :: ny                    !! rows across each ellipse, >= 1
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! those of `fastsim_solve`; `st_bad_argument`, `st_not_finite`, `st_out_of_range`
            !! for the strips
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for nx*ny elements a patch
        type(fastsim_variant_t), intent(in), optional :: variant !! Kalker's choice without
        type(friction_t), intent(in), optional :: friction !! as of `fastsim_solve`

        call fastsim_curved_solve(strips, fastsim_rolling_t(material, mu, creepage, nx, ny, &
                                                            chosen(variant)), &
                                  result, status, field, friction)
    end subroutine fastsim_strips_solve

    !> The same, or on a Hertz ellipse, with what rows of a curved surface give to its strips.
    pure subroutine fastsim_curved_solve(strips, rolling, result, status, field, friction, &
                                         per_strip, hertz)
        type(contact_strips_t), intent(in) :: strips !! a normal solution, laid
        type(fastsim_rolling_t), intent(in) :: rolling !! how it rolls
        type(tangential_result_t), intent(out) :: result !! as of `fastsim_strips_solve`
        type(status_t), intent(out) :: status        !! as of `fastsim_strips_solve`
        type(tangential_field_t), intent(inout), optional :: field !! as of `fastsim_strips_solve`
        type(friction_t), intent(in), optional :: friction !! as of `fastsim_solve`
        type(strip_forces_t), intent(inout), optional :: per_strip
            !! on a curved surface shares of the rows' forces; needs capacity for the strips
        type(hertz_t), intent(in), optional :: hertz !! the ellipse of all strips, in place of its
                                                     !! patches'

        type(ellipse_t) :: ellipse
        type(areas_t) :: areas
        integer :: first, last

        call check_strips(strips, status)
        if (is_error(status)) return
        call check_input(rolling%mu, rolling%creepage, rolling%nx, rolling%ny, strips%n_patches, &
                         status, field)
        if (is_error(status)) return
        call check_fall(rolling%nx, status, friction)
        if (is_error(status)) return
        call check_material(rolling%material, status)
        if (is_error(status)) return
        if (present(per_strip) .and. strips%is_curved) &
            call empty_strip_forces(per_strip, strips%n, status)
        if (is_error(status)) return
        ellipse%g = combined_shear_modulus(rolling%material)
        ellipse%mu = rolling%mu
        ellipse%nx = rolling%nx
        ellipse%ny = rolling%ny
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            if (present(hertz)) then
                last = strips%n
                ellipse%patch_ellipse_t = patch_ellipse_t(hertz%a, hertz%b, hertz%y, hertz%load)
            else
                ellipse%patch_ellipse_t = patch_ellipse(strips, first, last)
            end if
            if (ellipse%load <= 0.0_wp) cycle
            call kalker_coefficients(ellipse%a/ellipse%b, &
                                     combined_poisson_ratio(rolling%material), ellipse%c, status)
            if (is_error(status)) then
                result = tangential_result_t()
                return
            end if
            ellipse%first = first
            ellipse%last = last
            call add_ellipse(ellipse, rolling%creepage, rolling%variant, result, areas, field, &
                             friction, strips, per_strip)
        end do
        result%stick_fraction = stick_share(areas%stuck, areas%covered)
        if (present(field)) call match_power(result%friction_power, 1, field)
    end subroutine fastsim_curved_solve

    !> Refuse what no FASTSIM can work on, and empty the field.
    pure subroutine check_input(mu, creepage, nx, ny, ellipses, status, field)
        real(wp), intent(in) :: mu               !! coefficient of friction
        type(creepage_t), intent(in) :: creepage !! rail relative to wheel
        integer, intent(in) :: nx, ny            !! elements along, strips across
        integer, intent(in) :: ellipses          !! number of ellipses to come
        type(status_t), intent(out) :: status    !! those of `fastsim_solve`
        type(tangential_field_t), intent(inout), optional :: field !! emptied

        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        if (nx < 1 .or. ny < 1 .or. max(nx, ny) > most_rows) then
            call set_status(status, st_bad_argument, 'elements along and across must be 1 to ' // &
                            '10000, got ' // trim(count_text(nx)) // ' and ' // count_text(ny))
            return
        end if
        if (present(field)) call empty_field(field, nx*ny*ellipses, status)
    end subroutine check_input

    !> Refuse friction that is none, and rows that are too long for temperatures.
    pure subroutine check_fall(nx, status, friction)
        integer, intent(in) :: nx             !! elements along
        type(status_t), intent(inout) :: status !! those of `check_friction`; `st_out_of_range`
        type(friction_t), intent(in), optional :: friction

        if (.not. present(friction)) return
        call check_friction(friction, status)
        if (is_error(status) .or. .not. falls_when_hot(friction)) return
        if (nx > most_along) call set_status(status, st_out_of_range, 'friction that falls ' // &
            'with temperature takes at most 1000 elements along, got ' // count_text(nx))
    end subroutine check_fall

    pure type(fastsim_variant_t) function chosen(variant)
        type(fastsim_variant_t), intent(in), optional :: variant

        chosen = fastsim_variant_t()
        if (present(variant)) chosen = variant
    end function chosen

    !> Add the forces of one ellipse.
    pure subroutine add_ellipse(ellipse, creepage, variant, result, areas, field, friction, &
                                strips, per_strip)
        type(ellipse_t), intent(in) :: ellipse       !! where it is and what it carries
        type(creepage_t), intent(in) :: creepage     !! about y = 0
        type(fastsim_variant_t), intent(in) :: variant !! bound and flexibilities
        type(tangential_result_t), intent(inout) :: result !! forces, moment, power are added to
        type(areas_t), intent(inout) :: areas      !! added to
        type(tangential_field_t), intent(inout), optional :: field !! emptied beforehand
        type(friction_t), intent(in), optional :: friction !! checked
        type(contact_strips_t), intent(in), optional :: strips !! under it, laid
        type(strip_forces_t), intent(inout), optional :: per_strip
            !! on a curved surface shares of the rows' forces are added to

        type(creepage_t) :: motion, rest
        real(wp) :: a, b, y0, l1, l2, l3, peak_bound, pmax, width, y, row, h, x, t, bound
        real(wp) :: size_squared, step, cksi, ceta, cphi, slope_x, slope_y, px, py, sx, sy, cell
        real(wp) :: place, g, mu
        real(wp) :: ahead_x, ahead_y, left, fall, gain, heat(most_along), row_bound
        real(wp) :: before(2)
        integer :: nx, ny, i, j, state
        logical :: is_falling, is_hot, varies, is_curved

        nx = ellipse%nx
        ny = ellipse%ny
        a = ellipse%a
        b = ellipse%b
        y0 = ellipse%y
        g = ellipse%g
        mu = ellipse%mu
        associate (c => ellipse%c)
            l1 = 8.0_wp*a/(3.0_wp*c%c11*g) ! Given: Kalker (1982)
            l2 = 8.0_wp*a/(3.0_wp*c%c22*g) ! Given: Kalker (1982)
            l3 = pi*a*sqrt(a/b)/(4.0_wp*c%c23*g)
        end associate
        pmax = 1.5_wp*ellipse%load/(pi*a*b) ! Given: Hertz
        width = 2.0_wp*b/ny
        motion = creepage
        is_curved = .false.
        if (present(strips)) is_curved = strips%is_curved
        if (is_curved) motion = patch_motion(strips, ellipse%first, ellipse%last, creepage)
        ! Motion at the middle of the ellipse.
        cksi = motion%cksi - y0*motion%cphi
        if (variant%single_flexibility) then
            l1 = weighted_flexibility(l1, l2, l3, cksi, motion%ceta, sqrt(a*b)*motion%cphi)
            l2 = l1
            l3 = l1
        end if
        peak_bound = mu*ellipse%load/(a*width*grid_sum(nx, ny, variant%elliptic_bound))
        is_falling = .false.
        is_hot = .false.
        varies = .false.
        if (present(friction)) then
            is_falling = falls(friction)
            is_hot = falls_when_hot(friction)
            varies = friction%table%n > 0 .and. mu > 0.0_wp
        end if
        do i = 1, ny
            t = real(2*i - 1 - ny, wp)/ny
            y = b*t
            row = a*sqrt(1.0_wp - t*t)
            h = 2.0_wp*row/nx
            cell = h*width
            slope_x = cksi/l1 - y*motion%cphi/l3
            ceta = motion%ceta
            cphi = motion%cphi
            if (is_curved) then
                rest = rest_of_slip(slip_between(strips, ellipse%first, ellipse%last, y0 + y, &
                                                 creepage), y0 + y, creepage, motion)
                slope_x = slope_x + rest%cksi/l1
                ceta = ceta + rest%ceta
                cphi = cphi + rest%cphi
                before = [result%fx, result%fy]
            end if
            px = 0.0_wp
            py = 0.0_wp
            left = 1.0_wp
            row_bound = peak_bound
            if (varies) row_bound = peak_bound/mu*mean_mu_between( &
                friction%table, mu, y0 + y - 0.5_wp*width, y0 + y + 0.5_wp*width)
            if (is_hot) gain = friction%heat%gain*sqrt(h)
            do j = 1, nx
                x = row*real(nx - 2*j + 1, wp)/nx
                ! Half a step from the edge to the middle of the first element.
                step = merge(0.5_wp*h, h, j == 1)
                slope_y = ceta/l2 + (x + 0.5_wp*step)*cphi/l3
                px = px - step*slope_x
                py = py - step*slope_y
                place = max((1.0_wp - t*t) - (x/a)**2, 0.0_wp)
                bound = row_bound*merge(sqrt(place), place, variant%elliptic_bound)
                if (is_falling) then
                    bound = left*bound
                    if (is_hot) heat(j) = 0.0_wp
                end if
                size_squared = px*px + py*py
                sx = 0.0_wp
                sy = 0.0_wp
                if (size_squared <= bound*bound) then
                    state = state_adhesion
                    areas%stuck = areas%stuck + cell
                else
                    state = state_slip
                    ahead_x = px
                    ahead_y = py
                    px = px*(bound/sqrt(size_squared))
                    py = py*(bound/sqrt(size_squared))
                    if (is_falling) then
                        fall = falling_share(friction, hypot(l1*(px - ahead_x), &
                                                             l2*(py - ahead_y))/step)/left
                        if (is_hot) fall = fall*hot_share(friction, &
                            friction%heat%shared + gain*rise_ahead(heat(:j - 1)), &
                            gain*weight_of_itself*fall*max((px*l1*(ahead_x - px) &
                                                     + py*l2*(ahead_y - py))/step, 0.0_wp))
                        left = left*fall
                        px = px*fall
                        py = py*fall
                    end if
                    sx = l1*(px - ahead_x)/step
                    sy = l2*(py - ahead_y)/step
                    if (is_falling .and. is_hot) heat(j) = max(-(px*sx + py*sy), 0.0_wp)
                end if
                areas%covered = areas%covered + cell
                result%fx = result%fx + cell*px
                result%fy = result%fy + cell*py
                result%mz = result%mz + cell*(x*py - (y0 + y)*px)
                ! What motion feeds in: friction and what is still stored where the row ends.
                result%friction_power = result%friction_power &
                                        - cell*(px*l1*slope_x + py*l2*slope_y)
                if (present(field)) call add_element(field, x, y0 + y, [h, cell], &
                                                     pmax*sqrt(place), px, py, sx, sy, state)
            end do
            if (is_curved .and. present(per_strip)) &
                call add_between(strips, ellipse%first, ellipse%last, y0 + y, &
                                 [result%fx, result%fy] - before, per_strip%fx, per_strip%fy)
        end do
    end subroutine add_ellipse

    !> The mean of the flexibilities by the share each has in the motion; that of long slip without
    !> motion, where it does not matter.
    pure real(wp) function weighted_flexibility(l1, l2, l3, cksi, ceta, spin) result(l)
        real(wp), intent(in) :: l1, l2, l3 !! mm/MPa
        real(wp), intent(in) :: cksi, ceta !! creepages
        real(wp), intent(in) :: spin       !! c cphi

        real(wp) :: motion

        l = l1
        motion = norm2([cksi, ceta, spin])
        if (motion > 0.0_wp) l = (l1*abs(cksi) + l2*abs(ceta) + l3*abs(spin))/motion
    end function weighted_flexibility

    !> Sum of `1 - (x/a)^2 - (y/b)^2`, or of its root, over the elements, a row's length counted in
    !> units of a and its width as one: the sums of the midpoint rule.
    pure real(wp) function grid_sum(nx, ny, elliptic)
        integer, intent(in) :: nx, ny
        logical, intent(in) :: elliptic

        real(wp) :: row, length_squared
        integer :: i

        row = 0.0_wp
        if (elliptic) then
            do i = 1, nx
                row = row + sqrt(1.0_wp - (real(2*i - 1 - nx, wp)/nx)**2)
            end do
            row = 2.0_wp*row/nx
        else
            row = (4.0_wp + 2.0_wp/real(nx, wp)**2)/3.0_wp
        end if
        grid_sum = 0.0_wp
        do i = 1, ny
            length_squared = 1.0_wp - (real(2*i - 1 - ny, wp)/ny)**2
            if (elliptic) then
                grid_sum = grid_sum + length_squared
            else
                grid_sum = grid_sum + sqrt(length_squared)**3
            end if
        end do
        grid_sum = row*grid_sum
    end function grid_sum
end module faststrip_tangential_fastsim
