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
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: nothing, smallest_size, largest_size, beyond_all
    use faststrip_influence_closed, only: strip_influence_edges, strip_influence_center_gradient
    use faststrip_influence_closed_coefficients, only: atanh_last
    use faststrip_influence_angle_rules, only: cosine, rule_size, rule_start
    use faststrip_influence_offcentre_rules, only: accuracy_t, for_value, for_gradient, &
                                                   least_far_rule
    use faststrip_influence_offcentre_far, only: far_moments, narrow_far_moments, &
                                                 smooth_far_moments
    use faststrip_influence_offcentre_near, only: near_moments, smooth_near_moments
    use faststrip_influence_offcentre_series, only: series_moments
    use faststrip_influence_offcentre_folded, only: folded_moments
    use faststrip_numerics_logarithm, only: log_1p
    implicit none
    private

    public :: strip_influence_at, strip_influence_gradient

    ! Given: ln 2.
    real(wp), parameter :: log_2 = 0.693147180559945309417232121458176568_wp

    ! A strip within this distance of the field point, in half-lengths, has no influence.
    real(wp), parameter :: no_width = 1.0_wp/beyond_all

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

    !> The three integrals `int sqrt(1-u^2) ker`, its derivative in X, `int u^2/sqrt(1-u^2) ker` for
    !> any edges el <= er, x >= 0.
    pure subroutine any_edges(x, xd, el, er, accuracy, m)
        real(wp), intent(in) :: x, xd, el, er
        type(accuracy_t), intent(in) :: accuracy
        real(wp), intent(out) :: m(3)

        real(wp) :: other(3)

        if (el >= 0.0_wp) then
            call one_side(x, xd, el, er, accuracy, m)
        else if (er <= 0.0_wp) then
            call one_side(x, xd, -er, -el, accuracy, m)
        else
            call one_side(x, xd, 0.0_wp, er, accuracy, m)
            if (-el < er .or. -el > er) then
                call one_side(x, xd, 0.0_wp, -el, accuracy, other)
                m = m + other
            else
                m = 2.0_wp*m
            end if
        end if
        if (.not. x > 0.0_wp) m(2) = 0.0_wp
    end subroutine any_edges

    !> The same for 0 <= el <= er: scaling, and the limit of a point source.
    pure subroutine one_side(x, xd, el, er, accuracy, m)
        real(wp), intent(in) :: x, xd, el, er
        type(accuracy_t), intent(in) :: accuracy
        real(wp), intent(out) :: m(3)

        ! Longer strips are as long as this: `far` cannot overflow.
        real(wp), parameter :: longest = beyond_all**2
        real(wp) :: near, far

        ! From so far away a strip is a point; an edge as many times farther still sees it, and all
        ! within the former, as one.
        near = largest_size*min(xd, longest)
        far = largest_size*near
        if (x > near .or. el > near) then
            call point_moments(x, xd, el, er, m)
        else if (er > far) then
            call unit_moments(x/xd, el/xd, far/xd, accuracy, m)
            m(1) = m(1) + 0.5_wp*pi*(log(er) - log(far))
            m(3) = m(3) + 0.5_wp*pi*(log(er) - log(far))
        else
            call unit_moments(x/xd, el/xd, er/xd, accuracy, m)
        end if
    end subroutine one_side

    !> A strip so short that it is a point: `(pi/2) ker(x)`; x > 0 or el > 0.
    pure subroutine point_moments(x, xd, el, er, m)
        real(wp), intent(in) :: x, xd, el, er
        real(wp), intent(out) :: m(3)

        real(wp) :: size, xs, cl, cr, sl, sr, ker
        logical :: beyond

        size = max(x, el)
        xs = x/size
        cl = el/size
        sl = hypot(xs, cl)
        ! Edges beyond are infinitely far.
        beyond = er*nothing > size
        if (size < 1.0_wp) beyond = er > size/nothing
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
    pure subroutine unit_moments(x, cl, cr, accuracy, m)
        real(wp), intent(in) :: x, cl, cr
        type(accuracy_t), intent(in) :: accuracy
        real(wp), intent(out) :: m(3)

        real(wp) :: sigma, other(3)
        integer :: rule

        m = 0.0_wp
        if (.not. cr > max(cl, no_width)) return
        if (.not. x > 0.0_wp .and. cl <= accuracy%loss*(cr - cl)) then
            call strip_influence_center_gradient(cl, cr, m(1), m(3))
            return
        end if
        sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cl*cl) + sqrt((x + 1.0_wp)**2 + cl*cl))
        rule = least_far_rule(sigma, accuracy)
        if (rule <= accuracy%last_far) then
            if (cr - cl <= atanh_last*(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))) then
                call narrow_far_moments(rule_size(rule), cosine(rule_start(rule)), x, cl, cr, m)
            else
                call far_moments(rule_size(rule), cosine(rule_start(rule)), x, cl, cr, m)
            end if
        else if (cr <= accuracy%thin*(1.0_wp - x) .and. cr <= accuracy%loss*(cr - cl)) then
            call series_moments(x, cl, cr, accuracy%tail, m)
        else if (x > 1.0_wp .or. cl > smallest_size) then
            call near_moments(x, cl, cr, max(cl, x - 1.0_wp), accuracy, m)
        else if (cr >= accuracy%split) then
            sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cr*cr) + sqrt((x + 1.0_wp)**2 + cr*cr))
            rule = least_far_rule(sigma, accuracy)
            if (rule <= accuracy%last_far) then
                call smooth_far_moments(rule_size(rule), cosine(rule_start(rule)), x, cr, m)
            else
                call smooth_near_moments(x, cr, accuracy, m)
            end if
            call logarithm_moments(x, other)
            m = m - other
        else
            call folded_moments(x, cl, cr, m)
        end if
    end subroutine unit_moments

    !> The integrals of ln|u - X|, 0 <= X <= 1, exactly.
    pure subroutine logarithm_moments(x, m)
        real(wp), intent(in) :: x
        real(wp), intent(out) :: m(3)

        m(1) = 0.5_wp*pi*(x*x - 0.5_wp - log_2)
        m(2) = pi*x
        m(3) = 0.5_wp*pi*(0.5_wp - x*x - log_2)
    end subroutine logarithm_moments
end module faststrip_influence_offcentre
