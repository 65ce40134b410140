!> The influence of a strip at a point off its centre line, with derivatives.
!>
!> With `u` along the strip that carries the pressure, `X = x/xd` and edges `c = e/xd`,
!>
!>     G(X, cr) - G(X, cl) = int_{-1}^{1} sqrt(1 - u^2) ker(u - X) du,
!>     ker(delta) = asinh(cr/|delta|) - asinh(cl/|delta|) = ln(1 + d),
!>     d = (cr - cl) [1 + (cr + cl)/(s_r + s_l)] / (cl + s_l),   s = sqrt(delta^2 + c^2),
!>     ker(delta) = 2 atanh((cr - cl)/(s_r + s_l)),  the cheaper form while the argument is small,
!>
!> the inner integral of eq. (18)-(20) with source and field exchanged, even in X. Derivatives need
!> two more integrals of the same kernel (edges and half-length in mm, I = xd [G(cr) - G(cl)]):
!>
!>     dI/dx = - int u/sqrt(1 - u^2) ker du,    dI/dxd = int u^2/sqrt(1 - u^2) ker du.
!>
!> For 0 <= cl < cr the kernel is singular at `delta = +-i cl`, `+-i cr` (a logarithm at 0 for
!> cl = 0), and the rule is chosen by how near that is:
!>
!> 1. far: `u = cos(theta)`, trapezium rule of N nodes, error `exp(-2 (N - 1) acosh(sigma))`,
!>    `sigma = (hypot(X - 1, cl) + hypot(X + 1, cl))/2`;
!> 2. thin strips well inside the ends: the series in powers of c;
!> 3. near: `u = X + c sinh(t)`, which moves the singularity to `Im t >= pi/2`, then
!>    `t = mid + half cos(phi)`, trapezium rule in phi;
!> 4. field point on the strip's edge (cl = 0, |X| <= 1): `ker = ln(cr + s_r) - ln|delta|`, the
!>    second part known exactly and the first by 1. or 3.; where that cancels (small cr), a folded
!>    double-exponential rule on both sides of the field point.
!>
!> Edges on both sides of the field point make two such problems. Arguments that are not finite
!> give quiet NaNs; a strip of no length or no width has no influence. Nothing here raises a
!> floating-point exception.
module faststrip_influence_offcentre
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan, &
                                             ieee_positive_inf
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_closed, only: strip_influence_edges, strip_influence_center_gradient
    use faststrip_influence_closed_coefficients, only: a => atanh_series, atanh_last
    implicit none
    private

    public :: strip_influence_at, strip_influence_gradient, strip_influence_edge_slope

    integer :: i_, k_

    ! Trapezium (midpoint) rules in the angle; the cosines and sines of their nodes.
    integer, parameter :: n_rules = 13
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 12, 16, 20, 24, 32, 48, 64, &
                                                          96, 128, 192]
    integer, parameter :: rule_start(n_rules) = [(sum(rule_size(:i_)) - rule_size(i_) + 1, &
                                                  i_=1, n_rules)]
    integer, parameter :: n_nodes = sum(rule_size)
    real(wp), parameter :: angle(n_nodes) = &
        [((pi*(i_ - 0.5_wp)/rule_size(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    real(wp), parameter :: cosine(n_nodes) = cos(angle)
    real(wp), parameter :: sine(n_nodes) = sin(angle)

    ! An accuracy exp(-digits) is reached by rule k for sigma >= far_limit(k), and for half the
    ! length of the interval in t up to near_limit(k).
    real(wp), parameter :: value_digits = 36.5_wp
    real(wp), parameter :: gradient_digits = 27.0_wp
    real(wp), parameter :: value_far(n_rules) = cosh(0.5_wp*value_digits/(rule_size - 1))
    real(wp), parameter :: gradient_far(n_rules) = cosh(0.5_wp*gradient_digits/(rule_size - 1))
    real(wp), parameter :: value_near(n_rules) = 0.5_wp*pi/sinh(0.5_wp*value_digits/rule_size)
    real(wp), parameter :: gradient_near(n_rules) = &
        0.5_wp*pi/sinh(0.5_wp*gradient_digits/rule_size)

    ! The folded double-exponential rule on [0,1]: abscissae y and weights.
    integer, parameter :: n_fold = 160
    real(wp), parameter :: h_fold = 0.0288_wp
    real(wp), parameter :: t_fold(n_fold) = [(h_fold*(i_ - 1), i_=1, n_fold)]
    real(wp), parameter :: y_fold(n_fold) = 2.0_wp/(1.0_wp + exp(sinh(t_fold) + t_fold))
    real(wp), parameter :: w_end(n_fold) = [0.5_wp, (1.0_wp, i_=2, n_fold)]
    real(wp), parameter :: w_fold(n_fold) = &
        w_end*h_fold*(cosh(t_fold) + 1.0_wp)*0.5_wp*y_fold*(2.0_wp - y_fold)

    real(wp), parameter :: log_2 = 0.693147180559945309417232121458176568_wp

    !> What one accuracy asks of the rules.
    type :: demand_t
        real(wp) :: far(n_rules)  ! least sigma of each far rule
        real(wp) :: near(n_rules) ! largest half interval of each near rule
        integer :: last_far       ! largest far rule worth its price
        real(wp) :: thin          ! largest cr/(1 - |X|) of the series
        real(wp) :: tail          ! of the series, where it may be cut
        real(wp) :: loss          ! largest cr/(cr - cl) when primitives are subtracted
        real(wp) :: split         ! least cr for taking the logarithm apart
    end type demand_t

    ! The series in c: 1/(2k + 1), 1/k, ratio of successive factors.
    integer, parameter :: max_terms = 12
    real(wp), parameter :: inverse_odd(0:max_terms) = [(1.0_wp/(2*k_ + 1), k_=0, max_terms)]
    real(wp), parameter :: reciprocal(max_terms) = [(1.0_wp/k_, k_=1, max_terms)]
    real(wp), parameter :: series_step(0:max_terms) = [(-0.25_wp/(k_ + 1)**2, k_=0, max_terms)]

    type(demand_t), parameter :: for_value = demand_t(value_far, value_near, 9, 0.1_wp, &
                                                      1.0e-16_wp, 20.0_wp, 0.5_wp)
    type(demand_t), parameter :: for_gradient = demand_t(gradient_far, gradient_near, 7, 0.2_wp, &
                                                         1.0e-11_wp, 1.0e3_wp, 1.0e-3_wp)

    ! From this many half-lengths away a strip is a point; an edge this many times farther still
    ! sees it, and all within the former, as one.
    real(wp), parameter :: point_ratio = 1.0e30_wp
    ! On the centre line the closed form serves while edges are at most this many widths away.
    real(wp), parameter :: center_ratio = 1.0e3_wp
    ! A strip within this distance of the field point, in half-lengths, has no influence.
    real(wp), parameter :: no_width = 1.0e-250_wp
    ! The slope in an edge: its series may be cut after one term below this c/(1 - |X|), and off the
    ! strip the edge is on the field point below this c.
    real(wp), parameter :: small_ratio = 1.0e-8_wp
    real(wp), parameter :: small_edge = 1.0e-27_wp
    ! Below this, an edge is on the field point.
    real(wp), parameter :: on_the_edge = 1.0e-20_wp

contains

    !> G(X, c_right) - G(X, c_left): influence of a strip over its half-length at any point.
    !> Even in x, antisymmetric in the edges.
    pure real(wp) function strip_influence_at(x, c_left, c_right) result(value)
        real(wp), intent(in) :: x       !! X, field point along the strip over the half-length
        real(wp), intent(in) :: c_left  !! left edge less the field point's y over the half-length
        real(wp), intent(in) :: c_right !! right edge less the field point's y over the half-length

        real(wp) :: m(3)

        if (.not. (ieee_is_finite(x) .and. ieee_is_finite(c_left) &
                   .and. ieee_is_finite(c_right))) then
            value = ieee_value(value, ieee_quiet_nan)
        else if (.not. abs(x) > 0.0_wp) then
            value = strip_influence_edges(c_left, c_right)
        else
            call any_edges(abs(x), 1.0_wp, min(c_left, c_right), max(c_left, c_right), &
                           for_value, m)
            value = m(1)
            if (c_left > c_right) value = -value
        end if
    end function strip_influence_at

    !> Influence of a strip and its derivatives with respect to the place of the field point along
    !> the strip and to the half-length, both at fixed edges. Relative error 1e-10 (the value too;
    !> `strip_influence_at` has more digits). d_x is odd in x, 0 at x = 0.
    pure subroutine strip_influence_gradient(x, half_length, e_left, e_right, value, d_x, &
                                             d_half_length)
        real(wp), intent(in) :: x              !! field point along the strip, mm
        real(wp), intent(in) :: half_length    !! xd of the strip that carries the pressure, mm
        real(wp), intent(in) :: e_left         !! its left edge less the field point's y, mm
        real(wp), intent(in) :: e_right        !! its right edge less the field point's y, mm
        real(wp), intent(out) :: value         !! influence I, mm; 0 for half_length <= 0; at most
                                               !! the largest double
        real(wp), intent(out) :: d_x           !! dI/dx
        real(wp), intent(out) :: d_half_length !! dI/dxd

        real(wp) :: m(3), largest

        if (.not. (ieee_is_finite(x) .and. ieee_is_finite(half_length) &
                   .and. ieee_is_finite(e_left) .and. ieee_is_finite(e_right))) then
            value = ieee_value(value, ieee_quiet_nan)
            d_x = value
            d_half_length = value
            return
        end if
        if (half_length > 0.0_wp) then
            call any_edges(abs(x), half_length, min(e_left, e_right), max(e_left, e_right), &
                           for_gradient, m)
        else
            m = 0.0_wp
        end if
        if (e_left > e_right) m = -m
        largest = huge(1.0_wp)/max(half_length, 1.0_wp)
        value = half_length*max(-largest, min(largest, m(1)))
        d_x = m(2)
        if (x < 0.0_wp) d_x = -d_x
        d_half_length = m(3)
    end subroutine strip_influence_gradient

    !> dG(X,c)/dc = int sqrt(1 - u^2)/sqrt((u - X)^2 + c^2) du: the derivative of a strip's
    !> influence (mm) with respect to its right edge (mm), and less that with respect to its left
    !> edge. Even in both arguments; +Inf for c = 0 inside the strip, NaN for what is not finite.
    !> Relative error 1e-13.
    !>
    !> Elliptic; with `u = X + c sinh(t)` it is `int sqrt(1 - u^2) dt`, which the rules of the far
    !> and of the near field integrate as they stand, without the cancellation that Legendre's
    !> integrals of three kinds have near X = 0.
    pure real(wp) function strip_influence_edge_slope(x, c) result(slope)
        real(wp), intent(in) :: x !! X, field point along the strip over the half-length
        real(wp), intent(in) :: c !! edge less the field point's y over the half-length

        real(wp), parameter :: largest = 1.0e100_wp
        real(wp) :: xs, cs, sigma, rest

        if (.not. (ieee_is_finite(x) .and. ieee_is_finite(c))) then
            slope = ieee_value(slope, ieee_quiet_nan)
            return
        end if
        xs = abs(x)
        cs = abs(c)
        rest = abs(1.0_wp - xs)
        if (max(xs, cs) > largest) then
            slope = 0.5_wp*pi/max(xs, cs)
            if (min(xs, cs) > 1.0e-8_wp*max(xs, cs)) &
                slope = slope/sqrt(1.0_wp + (min(xs, cs)/max(xs, cs))**2)
            return
        end if
        sigma = 0.5_wp*(sqrt((xs - 1.0_wp)**2 + cs*cs) + sqrt((xs + 1.0_wp)**2 + cs*cs))
        if (sigma >= for_value%far(for_value%last_far)) then
            slope = far_slope(xs, cs, least_far_rule(sigma, for_value))
        else if (xs < 1.0_wp .and. cs <= small_ratio*rest) then
            slope = thin_slope(xs, cs)
        else if (cs <= small_edge) then
            slope = pi*(xs - sqrt((xs - 1.0_wp)*(xs + 1.0_wp)))
        else
            slope = near_slope(xs, cs)
        end if
    end function strip_influence_edge_slope

    !> Trapezium rule in theta.
    pure real(wp) function far_slope(x, c, rule) result(slope)
        real(wp), intent(in) :: x, c
        integer, intent(in) :: rule

        integer :: j

        slope = 0.0_wp
        do j = rule_start(rule), rule_start(rule) + rule_size(rule) - 1
            slope = slope + sine(j)**2/sqrt((cosine(j) - x)**2 + c*c)
        end do
        slope = pi/rule_size(rule)*slope
    end function far_slope

    !> The first term of the series in c, 0 <= X < 1.
    pure real(wp) function thin_slope(x, c) result(slope)
        real(wp), intent(in) :: x, c

        real(wp) :: w

        if (c > 0.0_wp) then
            w = (1.0_wp - x)*(1.0_wp + x)
            slope = sqrt(w)*(4.0_wp*log_2 - 2.0_wp + 2.0_wp*(log(w) - log(c))) &
                    + 2.0_wp*x*asin(x)
        else
            slope = ieee_value(slope, ieee_positive_inf)
        end if
    end function thin_slope

    !> Trapezium rule in phi, t = mid + half cos(phi): with the ends u = -1 and 1 in sin(phi), what
    !> is left is singular at Im t = +-pi.
    pure real(wp) function near_slope(x, c) result(slope)
        real(wp), intent(in) :: x, c

        real(wp) :: t_left, t_right, mid, half, delta
        integer :: rule, j

        t_left = asinh(-(1.0_wp + x)/c)
        t_right = asinh((1.0_wp - x)/c)
        mid = 0.5_wp*(t_right + t_left)
        half = 0.5_wp*(t_right - t_left)
        rule = least_near_rule(0.5_wp*half, for_value)
        slope = 0.0_wp
        do j = rule_start(rule), rule_start(rule) + rule_size(rule) - 1
            delta = c*sinh(mid + half*cosine(j))
            slope = slope + sine(j)*sqrt(max(0.0_wp, ((1.0_wp - x) - delta)*((1.0_wp + x) + delta)))
        end do
        slope = pi/rule_size(rule)*half*slope
    end function near_slope

    !> The three integrals `int sqrt(1-u^2) ker`, its derivative in X, `int u^2/sqrt(1-u^2) ker` for
    !> any edges el <= er, x >= 0.
    pure subroutine any_edges(x, xd, el, er, demand, m)
        real(wp), intent(in) :: x, xd, el, er
        type(demand_t), intent(in) :: demand
        real(wp), intent(out) :: m(3)

        real(wp) :: other(3)

        if (el >= 0.0_wp) then
            call one_side(x, xd, el, er, demand, m)
        else if (er <= 0.0_wp) then
            call one_side(x, xd, -er, -el, demand, m)
        else
            call one_side(x, xd, 0.0_wp, er, demand, m)
            if (-el < er .or. -el > er) then
                call one_side(x, xd, 0.0_wp, -el, demand, other)
                m = m + other
            else
                m = 2.0_wp*m
            end if
        end if
        if (.not. x > 0.0_wp) m(2) = 0.0_wp
    end subroutine any_edges

    !> The same for 0 <= el <= er: scaling, and the limit of a point source.
    pure subroutine one_side(x, xd, el, er, demand, m)
        real(wp), intent(in) :: x, xd, el, er
        type(demand_t), intent(in) :: demand
        real(wp), intent(out) :: m(3)

        real(wp), parameter :: largest_scaled = 1.0e240_wp
        real(wp) :: near, far

        near = point_ratio*min(xd, largest_scaled)
        far = point_ratio*near
        if (x > near .or. el > near) then
            call point_moments(x, xd, el, er, m)
        else if (er > far) then
            call unit_moments(x/xd, el/xd, far/xd, demand, m)
            m(1) = m(1) + 0.5_wp*pi*(log(er) - log(far))
            m(3) = m(3) + 0.5_wp*pi*(log(er) - log(far))
        else
            call unit_moments(x/xd, el/xd, er/xd, demand, m)
        end if
    end subroutine one_side

    !> A strip so short that it is a point: `(pi/2) ker(x)`; x > 0 or el > 0.
    pure subroutine point_moments(x, xd, el, er, m)
        real(wp), intent(in) :: x, xd, el, er
        real(wp), intent(out) :: m(3)

        real(wp), parameter :: far_edge = 1.0e60_wp
        real(wp) :: size, xs, cl, cr, sl, sr, ker
        logical :: beyond

        size = max(x, el)
        xs = x/size
        cl = el/size
        sl = hypot(xs, cl)
        beyond = er/far_edge > size
        if (size < 1.0_wp) beyond = er > far_edge*size
        if (beyond) then
            ker = log_2 + log(er) - log(size) - log(cl + sl)
            m(2) = -xs/(sl*(cl + sl))
        else
            cr = er/size
            m = 0.0_wp
            if (.not. cr > cl) return
            sr = hypot(xs, cr)
            ker = log_1p((cr - cl)/(cl + sl)*(1.0_wp + (cr + cl)/(sr + sl)))
            m(2) = -xs*(cr - cl)*(cr + cl)/(sr*sl*(cr*sl + cl*sr))
        end if
        m(1) = 0.5_wp*pi*ker
        m(2) = 0.5_wp*pi*(xd/size)*m(2)
        m(3) = m(1)
    end subroutine point_moments

    !> The same for X >= 0, 0 <= cl <= cr in half-lengths: choose the rule.
    pure subroutine unit_moments(x, cl, cr, demand, m)
        real(wp), intent(in) :: x, cl, cr
        type(demand_t), intent(in) :: demand
        real(wp), intent(out) :: m(3)

        real(wp) :: sigma, other(3)
        integer :: rule

        m = 0.0_wp
        if (.not. cr > max(cl, no_width)) return
        if (.not. x > 0.0_wp .and. cl <= center_ratio*(cr - cl)) then
            call strip_influence_center_gradient(cl, cr, m(1), m(3))
            return
        end if
        sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cl*cl) + sqrt((x + 1.0_wp)**2 + cl*cl))
        rule = least_far_rule(sigma, demand)
        if (rule <= demand%last_far) then
            if (cr - cl <= atanh_last*(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))) then
                call narrow_far_moments(rule_size(rule), cosine(rule_start(rule)), x, cl, cr, m)
            else
                call far_moments(rule_size(rule), cosine(rule_start(rule)), x, cl, cr, m)
            end if
        else if (cr <= demand%thin*(1.0_wp - x) .and. cr <= demand%loss*(cr - cl)) then
            call series_moments(x, cl, cr, demand%tail, m)
        else if (x > 1.0_wp .or. cl > on_the_edge) then
            call near_moments(x, cl, cr, max(cl, x - 1.0_wp), demand, m)
        else if (cr >= demand%split) then
            sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cr*cr) + sqrt((x + 1.0_wp)**2 + cr*cr))
            rule = least_far_rule(sigma, demand)
            if (rule <= demand%last_far) then
                call smooth_far_moments(rule_size(rule), cosine(rule_start(rule)), x, cr, m)
            else
                call smooth_near_moments(x, cr, demand, m)
            end if
            call logarithm_moments(x, other)
            m = m - other
        else
            call folded_moments(x, cl, cr, m)
        end if
    end subroutine unit_moments

    !> The smallest trapezium rule in theta that is accurate enough; n_rules + 1 if none is.
    pure integer function least_far_rule(sigma, demand) result(rule)
        real(wp), intent(in) :: sigma
        type(demand_t), intent(in) :: demand

        do rule = 1, n_rules
            if (sigma >= demand%far(rule)) exit
        end do
    end function least_far_rule

    !> The smallest trapezium rule in phi that is accurate enough; the largest if none is.
    pure integer function least_near_rule(half, demand) result(rule)
        real(wp), intent(in) :: half
        type(demand_t), intent(in) :: demand

        do rule = 1, n_rules - 1
            if (half <= demand%near(rule)) exit
        end do
    end function least_near_rule

    !> ln(1 + d), d >= 0, with all its digits.
    pure real(wp) function log_1p(d)
        real(wp), intent(in) :: d

        real(wp) :: one_d

        one_d = 1.0_wp + d
        log_1p = log(one_d) + (d - (one_d - 1.0_wp))/one_d
    end function log_1p

    !> Trapezium rule in theta. The derivative in X comes from that of the kernel: no logarithm
    !> and no cancellation in the far field.
    pure subroutine far_moments(n, u, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, sl, sr, d, one_d, ker, uu, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(delta, sl, sr, d, one_d, ker, uu) reduction(+:m0, m1, m2)
        do j = 1, n
            delta = u(j) - x
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            uu = u(j)*u(j)
            m0 = m0 + (1.0_wp - uu)*ker
            m2 = m2 + uu*ker
            m1 = m1 + (1.0_wp - uu)*delta/(sr*sl*(cr*sl + cl*sr))
        end do
        m(1) = pi/n*m0
        m(2) = pi/n*(cr - cl)*(cr + cl)*m1
        m(3) = pi/n*m2
    end subroutine far_moments

    !> The same for strips so narrow, for their distance, that the kernel needs no logarithm.
    pure subroutine narrow_far_moments(n, u, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, sl, sr, z, y, ker, uu, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(delta, sl, sr, z, y, ker, uu) reduction(+:m0, m1, m2)
        do j = 1, n
            delta = u(j) - x
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            z = (cr - cl)/(sr + sl)
            y = z*z
            ker = z*(a(0) + y*(a(1) + y*(a(2) + y*(a(3) + y*(a(4) + y*(a(5) + y*(a(6) &
                  + y*(a(7) + y*(a(8) + y*(a(9) + y*(a(10) + y*(a(11) + y*(a(12) &
                  + y*(a(13) + y*(a(14) + y*a(15))))))))))))))))
            uu = u(j)*u(j)
            m0 = m0 + (1.0_wp - uu)*ker
            m2 = m2 + uu*ker
            m1 = m1 + (1.0_wp - uu)*delta/(sr*sl*(cr*sl + cl*sr))
        end do
        m(1) = 2.0_wp*pi/n*m0
        m(2) = pi/n*(cr - cl)*(cr + cl)*m1
        m(3) = 2.0_wp*pi/n*m2
    end subroutine narrow_far_moments

    !> Trapezium rule in phi, `u = X + c sinh(mid + half cos(phi))`.
    pure subroutine near_moments(x, cl, cr, c, demand, m)
        real(wp), intent(in) :: x, cl, cr, c
        type(demand_t), intent(in) :: demand
        real(wp), intent(out) :: m(3)

        real(wp) :: t_left, t_right, mid, half
        integer :: rule

        t_left = asinh(-(1.0_wp + x)/c)
        t_right = asinh((1.0_wp - x)/c)
        mid = 0.5_wp*(t_right + t_left)
        half = 0.5_wp*(t_right - t_left)
        rule = least_near_rule(half, demand)
        if (cr - cl <= atanh_last*(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))) then
            call narrow_near_sums(rule_size(rule), cosine(rule_start(rule)), &
                                  sine(rule_start(rule)), x, cl, cr, c, mid, half, m)
        else
            call near_sums(rule_size(rule), cosine(rule_start(rule)), sine(rule_start(rule)), &
                           x, cl, cr, c, mid, half, m)
        end if
    end subroutine near_moments

    pure subroutine near_sums(n, cos_phi, sin_phi, x, cl, cr, c, mid, half, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: cos_phi(n), sin_phi(n)
        real(wp), intent(in) :: x, cl, cr, c, mid, half
        real(wp), intent(out) :: m(3)

        real(wp) :: e, delta, u, root, sl, sr, d, one_d, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(e, delta, u, root, sl, sr, d, one_d, ker) reduction(+:m0, m1, m2)
        do j = 1, n
            e = exp(mid + half*cos_phi(j))
            delta = 0.5_wp*c*(e - 1.0_wp/e)
            u = x + delta
            root = (1.0_wp - x - delta)*(1.0_wp + x + delta)
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            ker = ker*0.5_wp*c*(e + 1.0_wp/e)*sin_phi(j)/sqrt(root)
            m0 = m0 + root*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = pi/n*half*m0
        m(2) = -pi/n*half*m1
        m(3) = pi/n*half*m2
    end subroutine near_sums

    !> The same for strips so narrow, for their distance, that the kernel needs no logarithm.
    pure subroutine narrow_near_sums(n, cos_phi, sin_phi, x, cl, cr, c, mid, half, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: cos_phi(n), sin_phi(n)
        real(wp), intent(in) :: x, cl, cr, c, mid, half
        real(wp), intent(out) :: m(3)

        real(wp) :: e, delta, u, root, sl, sr, z, y, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(e, delta, u, root, sl, sr, z, y, ker) reduction(+:m0, m1, m2)
        do j = 1, n
            e = exp(mid + half*cos_phi(j))
            delta = 0.5_wp*c*(e - 1.0_wp/e)
            u = x + delta
            root = (1.0_wp - x - delta)*(1.0_wp + x + delta)
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            z = (cr - cl)/(sr + sl)
            y = z*z
            ker = z*(a(0) + y*(a(1) + y*(a(2) + y*(a(3) + y*(a(4) + y*(a(5) + y*(a(6) &
                  + y*(a(7) + y*(a(8) + y*(a(9) + y*(a(10) + y*(a(11) + y*(a(12) &
                  + y*(a(13) + y*(a(14) + y*a(15))))))))))))))))
            ker = ker*c*(e + 1.0_wp/e)*sin_phi(j)/sqrt(root)
            m0 = m0 + root*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = pi/n*half*m0
        m(2) = -pi/n*half*m1
        m(3) = pi/n*half*m2
    end subroutine narrow_near_sums

    !> The part ln(c + s) of the kernel of an edge on the field point, trapezium rule in theta.
    pure subroutine smooth_far_moments(n, u, x, c, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n)
        real(wp), intent(in) :: x, c
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, s, ker, uu, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(delta, s, ker, uu) reduction(+:m0, m1, m2)
        do j = 1, n
            delta = u(j) - x
            s = sqrt(delta*delta + c*c)
            ker = log(c + s)
            uu = u(j)*u(j)
            m0 = m0 + (1.0_wp - uu)*ker
            m2 = m2 + uu*ker
            m1 = m1 - (1.0_wp - uu)*delta/(s*(c + s))
        end do
        m(1) = pi/n*m0
        m(2) = pi/n*m1
        m(3) = pi/n*m2
    end subroutine smooth_far_moments

    !> The same, trapezium rule in phi.
    pure subroutine smooth_near_moments(x, c, demand, m)
        real(wp), intent(in) :: x, c
        type(demand_t), intent(in) :: demand
        real(wp), intent(out) :: m(3)

        real(wp) :: t_left, t_right, mid, half
        integer :: rule

        t_left = asinh(-(1.0_wp + x)/c)
        t_right = asinh((1.0_wp - x)/c)
        mid = 0.5_wp*(t_right + t_left)
        half = 0.5_wp*(t_right - t_left)
        ! The nearest singularities are twice as far as those of a kernel with two edges.
        rule = least_near_rule(0.5_wp*half, demand)
        call smooth_near_sums(rule_size(rule), cosine(rule_start(rule)), sine(rule_start(rule)), &
                              x, c, mid, half, m)
    end subroutine smooth_near_moments

    pure subroutine smooth_near_sums(n, cos_phi, sin_phi, x, c, mid, half, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: cos_phi(n), sin_phi(n)
        real(wp), intent(in) :: x, c, mid, half
        real(wp), intent(out) :: m(3)

        real(wp) :: e, delta, u, root, s, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(e, delta, u, root, s, ker) reduction(+:m0, m1, m2)
        do j = 1, n
            e = exp(mid + half*cos_phi(j))
            delta = 0.5_wp*c*(e - 1.0_wp/e)
            s = 0.5_wp*c*(e + 1.0_wp/e)
            u = x + delta
            root = (1.0_wp - x - delta)*(1.0_wp + x + delta)
            ker = log(c + s)*s*sin_phi(j)/sqrt(root)
            m0 = m0 + root*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = pi/n*half*m0
        m(2) = -pi/n*half*m1
        m(3) = pi/n*half*m2
    end subroutine smooth_near_sums

    !> The integrals of ln|u - X|, 0 <= X <= 1, exactly.
    pure subroutine logarithm_moments(x, m)
        real(wp), intent(in) :: x
        real(wp), intent(out) :: m(3)

        m(1) = 0.5_wp*pi*(x*x - 0.5_wp - log_2)
        m(2) = pi*x
        m(3) = 0.5_wp*pi*(0.5_wp - x*x - log_2)
    end subroutine logarithm_moments

    !> Series in powers of c, cr < 1 - X. The derivatives of f = sqrt(1 - X^2), of hh = 1/f and of
    !> F = f (4 ln 2 - 2 + 2 ln w) + 2 X asin X, each times w^m, w = 1 - X^2, come by recurrence;
    !>
    !>     G = sum_k (-1)^k c^(2k+1)/(4^k k!^2 (2k+1)) [F^(2k) + 2 f^(2k) (H_k + 1/(2k+1) - ln c)]
    pure subroutine series_moments(x, cl, cr, tail, m)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(in) :: tail
        real(wp), intent(out) :: m(3)

        real(wp) :: w, hh(0:2*max_terms + 1), f(0:2*max_terms + 1), ff(0:2*max_terms + 1)
        real(wp) :: log_w, ratio, power, right(3), left(3)
        integer :: k, terms

        ratio = (cr/(1.0_wp - x))**2
        power = ratio
        do terms = 2, max_terms - 1
            power = power*ratio
            if (power < tail) exit
        end do
        w = (1.0_wp - x)*(1.0_wp + x)
        log_w = 4.0_wp*log_2 + 2.0_wp*log(w)
        f(0) = sqrt(w)
        hh(0) = 1.0_wp/f(0)
        hh(1) = x*hh(0)
        f(1) = -x*hh(0)*w
        ff(0) = f(0)*(log_w - 2.0_wp) + 2.0_wp*x*asin(x)
        ff(1) = w*(2.0_wp*asin(x) - x*hh(0)*log_w)
        do k = 1, 2*terms - 2
            hh(k + 1) = (2*k + 1)*x*hh(k) + k**2*w*hh(k - 1)
            f(k + 1) = -w*(x*hh(k) + k*w*hh(k - 1))
            ff(k + 1) = (2*k - 1)*x*ff(k) + ((k - 1)**2 - 1)*w*ff(k - 1) &
                        + 4.0_wp*w*(hh(k - 1) - f(k - 1))
        end do
        call series_primitive(cr, w, terms, f, ff, right)
        if (cl > 0.0_wp) then
            call series_primitive(cl, w, terms, f, ff, left)
            right = right - left
        end if
        m(1) = right(1)
        m(2) = right(2)
        m(3) = right(1) - x*right(2) - right(3)
    end subroutine series_moments

    !> G, G_X and c G_c from the scaled derivatives.
    pure subroutine series_primitive(c, w, terms, f, ff, g)
        real(wp), intent(in) :: c, w
        integer, intent(in) :: terms
        real(wp), intent(in) :: f(0:), ff(0:)
        real(wp), intent(out) :: g(3)

        real(wp) :: ratio, factor, odd_factor, harmonic, log_c, inner, outer
        integer :: k

        g = 0.0_wp
        log_c = log(c)
        ratio = (c/w)**2
        factor = c
        harmonic = 0.0_wp
        do k = 0, terms - 1
            odd_factor = factor*inverse_odd(k)
            outer = 2.0_wp*(harmonic - log_c)
            inner = outer + 2.0_wp*inverse_odd(k)
            g(1) = g(1) + odd_factor*(ff(2*k) + f(2*k)*inner)
            g(2) = g(2) + odd_factor*(ff(2*k + 1) + f(2*k + 1)*inner)
            g(3) = g(3) + factor*(ff(2*k) + f(2*k)*outer)
            factor = factor*ratio*series_step(k)
            harmonic = harmonic + reciprocal(k + 1)
        end do
        g(2) = g(2)/w
    end subroutine series_primitive

    !> Double-exponential rule on both sides of the field point, 0 <= X <= 1.
    pure subroutine folded_moments(x, cl, cr, m)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: right(3)

        if (x < 1.0_wp) then
            call fold_side(-x, cl, cr, m)
            call fold_side(x, cl, cr, right)
            m(1) = m(1) + right(1)
            m(2) = m(2) - right(2)
            m(3) = m(3) + right(3)
        else
            call fold_tip(cl, cr, m)
        end if
    end subroutine folded_moments

    !> The side of the field point where u runs from `place` to 1, -1 < place < 1; the second
    !> integral with the sign of the other side.
    pure subroutine fold_side(place, cl, cr, m)
        real(wp), intent(in) :: place, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: y, u, delta, sl, sr, d, one_d, ker, f, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(y, u, delta, sl, sr, d, one_d, ker, f) reduction(+:m0, m1, m2)
        do j = 1, n_fold
            y = y_fold(j)
            delta = (1.0_wp - place)*(y*(2.0_wp - y))
            f = 1.0_wp + place + delta
            u = place + delta
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            ker = ker*w_fold(j)/sqrt(f)
            m0 = m0 + f*(1.0_wp - y)**2*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        f = 2.0_wp*sqrt(1.0_wp - place)
        m(1) = f*(1.0_wp - place)*m0
        m(2) = f*m1
        m(3) = f*m2
    end subroutine fold_side

    !> The field point at the end of the strip, X = 1, u = 1 - 2 q^2: no square root is left.
    pure subroutine fold_tip(cl, cr, m)
        real(wp), intent(in) :: cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: y, q, u, delta, sl, sr, d, one_d, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(y, q, u, delta, sl, sr, d, one_d, ker) reduction(+:m0, m1, m2)
        do j = 1, n_fold
            y = y_fold(j)
            q = y*(2.0_wp - y)
            delta = 2.0_wp*q*q
            u = 1.0_wp - delta
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            ker = ker*w_fold(j)/sqrt(1.0_wp + q)
            m0 = m0 + (q*(1.0_wp - y))**2*(1.0_wp + q)*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = 16.0_wp*m0
        m(2) = -4.0_wp*m1
        m(3) = 4.0_wp*m2
    end subroutine fold_tip
end module faststrip_influence_offcentre
