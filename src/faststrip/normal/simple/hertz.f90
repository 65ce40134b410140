!> Hertz's contact of two smooth bodies: an ellipse under a semi-ellipsoidal pressure.
!>
!> The gap is `z = A x^2 + B y^2`. An ellipse with semi-axes a (along x) and b (along y) under
!> `p = pmax sqrt(1 - (x/a)^2 - (y/b)^2)` moves the surface by `D - A x^2 - B y^2` when
!> (Johnson, Contact Mechanics, 1985, section 4.2; g = short over long axis, L = the long one,
!> m = 1 - g^2, A_L the curvature along the long axis, A_S across it)
!>
!>     A_S/A_L = B(m)/(g^2 D(m)),  L^3 = (3/2) Q H D(m)/A_L,  penetration = (3/2) Q H K(m)/L,
!>
!> with the complete elliptic integrals K, `D = (K - E)/m` and `B = K - D`.
module faststrip_normal_simple_hertz
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: beyond_all, largest_size, most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, add_words, message_length, st_bad_argument, &
                                     st_bad_load, st_bad_material, st_no_contact, &
                                     st_no_convergence, st_no_hertz_ellipse, st_not_finite, &
                                     st_out_of_range, st_workspace_too_small
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_inv2r, gap_curvature
    use faststrip_normal_limitations, only: check_depth
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: hertz_t, hertz_solve, hertz_shape, hertz_solve_gap, hertz_solve_gap_penetration
    public :: hertz_strips, hertz_solve_gap_demand, put_hertz_strips

    !> A Hertz contact.
    type :: hertz_t
        real(wp) :: a = 0.0_wp           !! semi-axis along the rolling direction x, mm
        real(wp) :: b = 0.0_wp           !! semi-axis along y, mm
        real(wp) :: y = 0.0_wp           !! middle, from the contact reference point, mm
        real(wp) :: penetration = 0.0_wp !! approach of the bodies, mm
        real(wp) :: pmax = 0.0_wp        !! pressure in the middle, MPa
        real(wp) :: area = 0.0_wp        !! pi a b, mm^2
        real(wp) :: load = 0.0_wp        !! the load it carries, N
    end type hertz_t

contains

    !> Ellipse, penetration and pressure of a Hertz contact, relative error below 1e-13 for any
    !> ratio of the axes between 1e-4 and 1e4 (and still finite far beyond).
    !>
    !> Newton's method on `ln(a/b)` against `ln(B/A)`: the relation is smooth, its slope runs from
    !> 3/2 (circle) to just above 2, so that it converges from anywhere in a few steps.
    pure subroutine hertz_solve(compliance, inv2r_x, inv2r_y, load, hertz, status)
        real(wp), intent(in) :: compliance   !! H of eq. (4), 1/MPa (1/E* = pi H)
        real(wp), intent(in) :: inv2r_x      !! A, gap per x^2: half the curvature along x, 1/mm
        real(wp), intent(in) :: inv2r_y      !! B, gap per y^2: half the curvature along y, 1/mm
        real(wp), intent(in) :: load         !! Q, N
        type(hertz_t), intent(out) :: hertz  !! the contact; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_not_finite`, `st_bad_material`, `st_bad_load`, `st_no_hertz_ellipse` (a relative
            !! curvature that is not positive), `st_out_of_range` (axes beyond all proportion)

        real(wp) :: axes, k, d, s, log_long, long, short
        logical :: found

        call check_arguments(compliance, inv2r_x, inv2r_y, load, status)
        if (status%code /= 0) return

        ! The long axis lies along the smaller curvature; work with ratios above one.
        if (abs(log(inv2r_y) - log(inv2r_x)) > log(largest_size)) then
            call set_status(status, st_out_of_range, 'curvatures beyond all proportion: ' // &
                            trim(number_text(inv2r_x)) // ' and ' // trim(number_text(inv2r_y)) &
                            // ' 1/mm')
            return
        end if
        axes = log(max(inv2r_x, inv2r_y)/min(inv2r_x, inv2r_y))/1.5_wp ! Given: Hertz
        call hertz_shape(inv2r_x, inv2r_y, axes, k, s, found)
        if (.not. found) then
            call set_status(status, st_no_convergence, 'axes of the Hertz ellipse not found')
            return
        end if
        d = k*(0.5_wp + s)

        ! Given: Hertz
        log_long = (log(1.5_wp*d) + log(load) + log(compliance) &
                    - log(min(inv2r_x, inv2r_y)))/3.0_wp
        if (abs(log_long) + axes + abs(log(load)) > log(beyond_all)) then
            call set_status(status, st_out_of_range, 'a Hertz contact beyond all proportion: ' // &
                            'load ' // trim(number_text(load)) // ' N')
            return
        end if
        ! Given: Hertz
        long = cube_root(1.5_wp*d*fraction(load)*fraction(compliance) &
                         /fraction(min(inv2r_x, inv2r_y)), &
                         exponent(load) + exponent(compliance) - exponent(min(inv2r_x, inv2r_y)))
        short = long*exp(-axes)
        if (inv2r_x <= inv2r_y) then
            hertz%a = long
            hertz%b = short
        else
            hertz%a = short
            hertz%b = long
        end if
        hertz%penetration = 1.5_wp*load*compliance*k/long ! Given: Hertz
        hertz%area = pi*hertz%a*hertz%b
        hertz%pmax = 1.5_wp*load/hertz%area ! Given: Hertz
        hertz%load = load
    end subroutine hertz_solve

    !> The shape of the Hertz ellipse of two curvatures: with D the approach, A_L and A_S the
    !> curvatures along the long and the short axis L and S,
    !>
    !>     A_L L^2 = (1/2 + s) D,  A_S S^2 = (1/2 - s) D,  pmax = D/(pi H K S).
    pure subroutine hertz_shape(inv2r_x, inv2r_y, axes, k, s, found)
        real(wp), intent(in) :: inv2r_x  !! A, half the curvature along x, above 0, 1/mm
        real(wp), intent(in) :: inv2r_y  !! B, half the curvature along y, above 0, 1/mm
        real(wp), intent(inout) :: axes  !! ln(L/S): where to start, then what was found
        real(wp), intent(out) :: k       !! K(m)
        real(wp), intent(out) :: s       !! (D - B)/(2K) of the elliptic integrals, in [0, 1/2)
        logical, intent(out) :: found    !! did Newton's method converge?

        real(wp) :: target, step, slope
        integer :: i

        target = log(max(inv2r_x, inv2r_y)/min(inv2r_x, inv2r_y))
        do i = 1, most_steps
            call ellipse_integrals(exp(-axes), k, s, slope)
            ! ln(A_S/A_L) = ln(B/D) + 2 ln(L/S); B/D = (1/2 - s)/(1/2 + s).
            step = (target - 2.0_wp*axes - log((0.5_wp - s)/(0.5_wp + s)))/slope
            axes = max(axes + step, 0.0_wp)
            if (abs(step) <= 4.0_wp*epsilon(1.0_wp)*(1.0_wp + axes)) exit
        end do
        found = i <= most_steps
        call ellipse_integrals(exp(-axes), k, s, slope)
    end subroutine hertz_shape

    !> Cube root of `mantissa*2**power`. With another unit of length or force that is a power of two
    !> the root has the same digits, which it would not have by a logarithm: so has all that starts
    !> from it.
    pure real(wp) function cube_root(mantissa, power) result(root)
        real(wp), intent(in) :: mantissa !! positive, of about one
        integer, intent(in) :: power

        integer :: thirds

        thirds = (power - modulo(power, 3))/3
        root = scale(scale(mantissa, power - 3*thirds)**(1.0_wp/3.0_wp), thirds)
    end function cube_root

    pure subroutine check_arguments(compliance, inv2r_x, inv2r_y, load, status)
        real(wp), intent(in) :: compliance, inv2r_x, inv2r_y, load
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. (ieee_is_finite(compliance) .and. ieee_is_finite(inv2r_x) &
                   .and. ieee_is_finite(inv2r_y) .and. ieee_is_finite(load))) then
            call set_status(status, st_not_finite, 'a Hertz contact from numbers that are not ' // &
                            'finite: H ' // trim(number_text(compliance)) // ' 1/MPa, A ' // &
                            trim(number_text(inv2r_x)) // ' 1/mm, B ' // &
                            trim(number_text(inv2r_y)) // ' 1/mm, load ' // &
                            trim(number_text(load)) // ' N')
        else if (compliance <= 0.0_wp) then
            call set_status(status, st_bad_material, 'compliance must be above 0, got ' // &
                            trim(number_text(compliance)) // ' 1/MPa')
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, 'load must be above 0, got ' // &
                            trim(number_text(load)) // ' N')
        else if (inv2r_x <= 0.0_wp) then
            call refuse_curvature('x', inv2r_x, status)
        else if (inv2r_y <= 0.0_wp) then
            call refuse_curvature('y', inv2r_y, status)
        end if
    end subroutine check_arguments

    !> Say which curvature is not above 0. For auto that is no error: without allocation.
    pure subroutine refuse_curvature(along, inv2r, status)
        character(len=1), intent(in) :: along
        real(wp), intent(in) :: inv2r
        type(status_t), intent(inout) :: status

        character(len=message_length) :: words

        words = 'no Hertz ellipse: half the relative curvature along'
        call add_words(words, ' ' // along)
        call add_words(words, ' must be above 0, got')
        call add_words(words, ' ' // number_text(inv2r))
        call add_words(words, ' 1/mm')
        call set_status(status, st_no_hertz_ellipse, words)
    end subroutine refuse_curvature

    !> Complete elliptic integrals of modulus m = 1 - g^2 by the arithmetic-geometric mean, without
    !> the cancellation of K - E near the circle: `K - E = K sum 2^(n-1) c_n^2` with `c_0^2 = m`
    !> and `c_(n+1) = c_n^2/(4 a_(n+1))`, so that `(K - E)/m = K (1/2 + s)`.
    pure subroutine ellipse_integrals(g, k, s, slope)
        real(wp), intent(in) :: g      !! short over long axis, in (0, 1]
        real(wp), intent(out) :: k     !! K(m)
        real(wp), intent(out) :: s     !! (D - B)/(2K), in [0, 1/2)
        real(wp), intent(out) :: slope !! d ln(A_S/A_L)/d ln(L/S)

        real(wp) :: mean, geometric, c, c_squared, s_over_m, weight, next

        ! c_1 = (1 - g)/2; everything is kept over m = (1 - g)(1 + g).
        mean = 0.5_wp*(1.0_wp + g)
        geometric = sqrt(g)
        c = 0.5_wp*(1.0_wp - g)
        s_over_m = 0.25_wp/(1.0_wp + g)**2
        weight = s_over_m
        do while (abs(mean - geometric) > 4.0_wp*epsilon(1.0_wp)*mean)
            next = 0.5_wp*(mean + geometric)
            ! 2 c_(n+1)^2/c_n^2 = 2 (c_n/(4 a_(n+1)))^2
            c_squared = (c/(4.0_wp*next))**2
            weight = 2.0_wp*weight*c_squared
            s_over_m = s_over_m + weight
            c = c*c/(4.0_wp*next)
            geometric = sqrt(mean*geometric)
            mean = next
        end do
        k = pi/(mean + geometric)
        s = s_over_m*(1.0_wp - g)*(1.0_wp + g)
        ! From dK/dm = B/(2 g^2), dE/dm = -D/2: no difference of nearly equal numbers is left.
        slope = 1.0_wp + 2.0_wp*s_over_m*(g*g/(0.5_wp - s) + 1.0_wp/(0.5_wp + s))
    end subroutine ellipse_integrals

    !> The Hertz contact of a gap: the ellipse of the curvatures where the gap is lowest, what
    !> vehicle codes take at the rigid contact point. The penetration counts from there. Where one
    !> of them is not positive there is no ellipse and no result; the strips need none.
    pure subroutine hertz_solve_gap(curve, compliance, load, hertz, status)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set, mm
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load           !! Q, N
        type(hertz_t), intent(out) :: hertz    !! the contact; zero when there is an error
        type(status_t), intent(out) :: status  !! as `hertz_solve`; `st_workspace_too_small`

        if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
            return
        end if
        call hertz_solve(compliance, gap_inv2r(curve, curve%y_lowest), &
                         gap_curvature(curve, curve%y_lowest), load, hertz, status)
        hertz%y = curve%y_lowest
    end subroutine hertz_solve_gap

    !> The same for a load or a penetration.
    pure subroutine hertz_solve_gap_demand(curve, compliance, demand, hertz, status)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set, mm
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand   !! load or penetration
        type(hertz_t), intent(out) :: hertz    !! the contact; zero when there is an error
        type(status_t), intent(out) :: status  !! as `hertz_solve_gap_penetration`

        if (demand%by_load) then
            call hertz_solve_gap(curve, compliance, demand%load, hertz, status)
        else
            call hertz_solve_gap_penetration(curve, compliance, demand%penetration, hertz, status)
        end if
    end subroutine hertz_solve_gap_demand

    !> The same for a given penetration, from h = 0; the load is in the result.
    pure subroutine hertz_solve_gap_penetration(curve, compliance, penetration, hertz, status)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set, mm
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration    !! approach of the bodies, mm
        type(hertz_t), intent(out) :: hertz    !! the contact; zero when there is an error
        type(status_t), intent(out) :: status  !! as `hertz_solve_gap`, `st_no_contact`

        type(hertz_t) :: unit_load
        real(wp) :: depth

        if (.not. ieee_is_finite(penetration)) then
            call set_status(status, st_not_finite, 'the penetration must be a finite number, got ' &
                            // number_text(penetration))
            return
        end if
        depth = 0.0_wp
        if (curve%n > 0) then
            depth = penetration - curve%h_lowest
            if (depth <= 0.0_wp) then
                call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                                // trim(number_text(penetration)) // ' mm, lowest gap ' &
                                // trim(number_text(curve%h_lowest)) // ' mm')
                return
            end if
            call check_depth(depth, status)
            if (is_error(status)) return
        end if
        call hertz_solve_gap(curve, compliance, 1.0_wp, unit_load, status)
        if (is_error(status)) return
        ! Penetration goes with load^(2/3).
        call hertz_solve_gap(curve, compliance, sqrt(depth/unit_load%penetration)**3, hertz, &
                            status)
    end subroutine hertz_solve_gap_penetration

    !> The Hertz ellipse cut into strips of equal width, with the load of each strip exact: half
    !> length and pressure of a strip are `a q` and `pmax q`, `q^2` the mean of `1 - (y/b)^2`
    !> over its width.
    pure subroutine hertz_strips(hertz, n, strips, status)
        type(hertz_t), intent(in) :: hertz              !! a solved contact
        integer, intent(in) :: n                        !! number of strips, >= 1
        type(contact_strips_t), intent(inout) :: strips !! with capacity for n, see `reserve_strips`
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (n < 1, no ellipse), `st_workspace_too_small`

        call clear_status(status)
        if (n < 1) then
            call set_status(status, st_bad_argument, 'the number of strips must be at least ' &
                            // '1, got ' // count_text(n))
            return
        end if
        if (hertz%a <= 0.0_wp .or. hertz%b <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'no Hertz ellipse to cut into strips')
            return
        end if
        if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no workspace was reserved for strips')
            return
        end if
        if (size(strips%p0) < n) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the strips')
            return
        end if
        call put_hertz_strips(hertz, 1, n, strips)
        strips%patch(:n) = 1
        strips%n = n
        strips%n_patches = 1
    end subroutine hertz_strips

    !> Cut an ellipse into the strips `first` to `last` of a contact, as `hertz_strips`.
    pure subroutine put_hertz_strips(hertz, first, last, strips)
        type(hertz_t), intent(in) :: hertz              !! an ellipse with its pressure
        integer, intent(in) :: first                    !! number of its first strip, >= 1
        integer, intent(in) :: last !! number of its last strip, there is capacity
        type(contact_strips_t), intent(inout) :: strips !! edges, lengths, pressures are written

        real(wp) :: left, right, q
        integer :: i, n

        n = last - first + 1
        do i = 1, n
            left = real(2*(i - 1) - n, wp)/n
            right = real(2*i - n, wp)/n
            q = sqrt(1.0_wp - (left*left + left*right + right*right)/3.0_wp)
            strips%y_left(first + i - 1) = hertz%y + hertz%b*left
            strips%y_right(first + i - 1) = hertz%y + hertz%b*right
            strips%half_length(first + i - 1) = hertz%a*q
            strips%p0(first + i - 1) = hertz%pmax*q
        end do
    end subroutine put_hertz_strips
end module faststrip_normal_simple_hertz
