!> The influence integral of a strip at its centre line, in closed form.
!>
!> A strip of half-length xd and half-width yd carries `p(x) = p0 sqrt(1 - (x/xd)^2)`; the
!> displacement of the surface on the centre line of a strip n widths away is `H xd i_n(b) p0`,
!> `b = yd/xd`, with (eq. (12) with its Jacobian, source and field exchanged)
!>
!>     i_n(b) = int_{-1}^{1} int_{(2n-1)b}^{(2n+1)b} sqrt(1 - u^2)/sqrt(u^2 + v^2) dv du
!>            = G((2n+1)b) - G((2n-1)b),
!>     G(c)   = int_{-1}^{1} sqrt(1 - u^2) asinh(c/|u|) du.
!>
!> G is one odd function of one variable: `c [A(c^2) - B(c^2) ln c]` for c <= 1 and
!> `(pi/2)(ln 4c + 1/2) + R(1/c^2)/c^2` for c >= 0.7, with polynomials made by
!> tools/generate/influence_coefficients.py. Differences are formed from divided differences of the
!> polynomials, so that no digit cancels for far or thin strips.
!>
!> Arguments that are not finite give a quiet NaN; nothing here raises a floating-point exception.
module faststrip_influence_closed
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: beyond_all
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre, &
                                                       a_short, b_short, r_short, short_last
    use faststrip_numerics_logarithm, only: log_1p
    implicit none
    private

    public :: influence_primitive, strip_influence
    public :: strip_influence_edges, strip_influence_center_gradient
    public :: c_small, c_large, c_near, c_far, table_end

    !> Largest c of the form for small c, in half-lengths: as far as its polynomials were fitted.
    !> Given: the range its polynomials were fitted on.
    real(wp), parameter :: c_small = 1.0_wp
    !> Least c of the form for large c: as far as its polynomial was fitted. The two forms overlap
    !> for strips with an edge on either side of 1.
    !> Given: the range its polynomial was fitted on.
    real(wp), parameter :: c_large = 0.7_wp
    ! Where both forms serve a difference is taken apart here.
    ! Tuned [half-lengths]. Origin: sqrt(c_large c_small), rounded; errors stay below 6e-16 at any
    ! place from c_large to c_small. Half and double lie outside, where one of the forms is wrong.
    real(wp), parameter :: c_middle = 0.84_wp
    !> Largest c of the short form for small c, 0.6.
    real(wp), parameter :: c_near = sqrt(short_last)
    !> Least c of the short form for large c, 5/3 and a rounding.
    !> Given: follows from c_near.
    real(wp), parameter :: c_far = 1.0_wp/c_near + 1.0e-12_wp
    ! Given: ln 4.
    real(wp), parameter :: log_4 = 1.386294361119890618834464242916353136_wp

    integer :: k_
    !> The largest n of the tables of logarithms: beyond, few terms in powers of 1/(4n^2) serve.
    !> Tuned [strips]. Origin: chosen: as many as a patch seldom has; from 16 on five powers are
    !> exact.
    integer, parameter :: table_end = 64
    ! 2n atanh(1/(2n)), and the coefficients of its powers.
    real(wp), parameter :: distance_table(table_end) = &
        [(2*k_*atanh(1.0_wp/(2*k_)), k_=1, table_end)]
    real(wp), parameter :: distance_series(0:4) = [(1.0_wp/(2*k_ + 1), k_=0, 4)]

contains

    !> G(c), odd; relative error below 1e-15.
    elemental real(wp) function influence_primitive(c) result(g)
        real(wp), intent(in) :: c !! edge of the strip over its half-length, any size and sign

        real(wp) :: size, w

        size = abs(c)
        if (.not. ieee_is_finite(c)) then
            g = ieee_value(g, ieee_quiet_nan)
            return
        else if (size > c_small) then
            w = (1.0_wp/size)**2
            if (size > c_far) then
                g = w*polynomial(r_short, w)
            else
                g = w*polynomial(r_large, w - r_centre)
            end if
            g = 0.5_wp*pi*(log(size) + (log_4 + 0.5_wp)) + g
        else if (size > 0.0_wp) then
            w = size*size
            if (size <= c_near) then
                g = size*(polynomial(a_short, w) - polynomial(b_short, w)*log(size))
            else
                g = size*(polynomial(a_small, w) - polynomial(b_small, w)*log(size))
            end if
        else
            g = 0.0_wp
        end if
        g = sign(g, c)
    end function influence_primitive

    !> i_n(b) of eq. (12), equal strips; 0 for b <= 0. Relative error below 1e-15 for b in
    !> [1e-8, 1e8] and n up to 1e4.
    elemental real(wp) function strip_influence(n, b) result(value)
        integer, intent(in) :: n  !! distance of the strips in strips, its sign ignored
        real(wp), intent(in) :: b !! half-width over half-length of the strip with the pressure, > 0

        real(wp) :: distance, cl, cr, t, wl, wr, xl, xr, p, q(2), r(2)

        if (.not. ieee_is_finite(b)) then
            value = ieee_value(value, ieee_quiet_nan)
            return
        else if (b <= 0.0_wp) then
            value = 0.0_wp
            return
        else if (n == 0) then
            value = 2.0_wp*influence_primitive(b)
            return
        end if
        distance = 2.0_wp*abs(real(n, wp))
        if (distance < 2.0_wp*table_end + 1.0_wp) then
            t = distance_table(abs(n))
        else
            t = polynomial(distance_series, 1.0_wp/distance**2)
        end if
        if (b > beyond_all) then
            value = pi*t/distance
            return
        end if
        cl = (distance - 1.0_wp)*b
        cr = (distance + 1.0_wp)*b
        if (cl >= c_large) then
            wl = 1.0_wp/cl
            wr = 1.0_wp/cr
            p = 4.0_wp*distance/((distance - 1.0_wp)*(distance + 1.0_wp))*wl*wr
            wl = wl*wl
            wr = wr*wr
            if (cl >= c_far) then
                q = divided_difference(r_short, wr, wl)
            else
                q = divided_difference(r_large, wr - r_centre, wl - r_centre)
            end if
            value = pi*t/distance - p*(q(1) + wr*q(2))
        else if (cr <= c_small) then
            xl = cl*cl
            xr = cr*cr
            p = 2.0_wp*distance*(distance + 1.0_wp)*b*b
            if (cr <= c_near) then
                q = divided_difference(a_short, xr, xl)
                r = divided_difference(b_short, xr, xl)
            else
                q = divided_difference(a_small, xr, xl)
                r = divided_difference(b_small, xr, xl)
            end if
            value = 2.0_wp*b*(q(1) + p*q(2) - log(cr)*(r(1) + p*r(2)) &
                              - (1.0_wp - 1.0_wp/distance)*t*r(1))
        else
            value = influence_primitive(cr) - influence_primitive(cl)
        end if
    end function strip_influence

    !> G(c_right) - G(c_left): influence of a strip of any width at any point of its centre line,
    !> inside it or outside; without cancellation, antisymmetric in its arguments.
    elemental real(wp) function strip_influence_edges(c_left, c_right) result(value)
        real(wp), intent(in) :: c_left  !! left edge less the field point's y over the half-length
        real(wp), intent(in) :: c_right !! right edge less the field point's y over the half-length

        real(wp) :: near, far

        if (.not. (ieee_is_finite(c_left) .and. ieee_is_finite(c_right))) then
            value = ieee_value(value, ieee_quiet_nan)
            return
        end if
        near = min(abs(c_left), abs(c_right))
        far = max(abs(c_left), abs(c_right))
        if ((c_left < 0.0_wp .and. c_right > 0.0_wp) &
            .or. (c_left > 0.0_wp .and. c_right < 0.0_wp)) then
            value = influence_primitive(far) + influence_primitive(near)
        else if (near >= c_large) then
            value = far_difference(near, far)
        else if (far <= c_small) then
            value = near_difference(near, far)
        else
            value = near_difference(near, c_middle) + far_difference(c_middle, far)
        end if
        if (c_left > c_right) value = -value
    end function strip_influence_edges

    !> G(c_right) - G(c_left) and, with I = xd [G(c_right) - G(c_left)], the derivative dI/dxd at
    !> fixed edges in mm, G(c_right) - G(c_left) - [c_right G'(c_right) - c_left G'(c_left)], from
    !> the derivatives of the polynomials: no elliptic integral. Relative error of the derivative
    !> 1e-14 max(1, |c|/(c_right - c_left)).
    elemental subroutine strip_influence_center_gradient(c_left, c_right, value, d_half_length)
        real(wp), intent(in) :: c_left         !! left edge less the field point's y over xd
        real(wp), intent(in) :: c_right        !! right edge less the field point's y over xd
        real(wp), intent(out) :: value         !! influence over the half-length
        real(wp), intent(out) :: d_half_length !! dI/dxd

        value = strip_influence_edges(c_left, c_right)
        if (ieee_is_finite(value)) then
            d_half_length = value - (primitive_moment(c_right) - primitive_moment(c_left))
        else
            d_half_length = value
        end if
    end subroutine strip_influence_center_gradient

    !> c G'(c), odd, for finite c.
    elemental real(wp) function primitive_moment(c) result(moment)
        real(wp), intent(in) :: c

        real(wp) :: size, w, q(2), r(2)

        size = abs(c)
        moment = 0.0_wp
        if (size > c_small) then
            w = (1.0_wp/size)**2
            if (size >= c_far) then
                q = divided_difference(r_short, w, w)
            else
                q = divided_difference(r_large, w - r_centre, w - r_centre)
            end if
            moment = 0.5_wp*pi - 2.0_wp*w*(q(1) + w*q(2))
        else if (size > 0.0_wp) then
            w = size*size
            if (size <= c_near) then
                q = divided_difference(a_short, w, w)
                r = divided_difference(b_short, w, w)
            else
                q = divided_difference(a_small, w, w)
                r = divided_difference(b_small, w, w)
            end if
            moment = size*(q(1) + 2.0_wp*w*q(2) - r(1) - log(size)*(r(1) + 2.0_wp*w*r(2)))
        end if
        moment = sign(moment, c)
    end function primitive_moment

    !> G(cr) - G(cl) for c_large <= cl <= cr.
    elemental real(wp) function far_difference(cl, cr) result(value)
        real(wp), intent(in) :: cl, cr

        real(wp) :: wl, wr, p, q(2)

        ! Beyond, cr/cl could overflow.
        if (cr > c_large*huge(cr)) then
            value = 0.5_wp*pi*(log(cr) - log(cl))
            return
        end if
        wl = 1.0_wp/cl
        wr = 1.0_wp/cr
        p = (cr - cl)*wl*(1.0_wp + cl*wr)*wl*wr
        wl = wl*wl
        wr = wr*wr
        if (cl >= c_far) then
            q = divided_difference(r_short, wr, wl)
        else
            q = divided_difference(r_large, wr - r_centre, wl - r_centre)
        end if
        value = 0.5_wp*pi*log_ratio(cl, cr) - p*(q(1) + wr*q(2))
    end function far_difference

    !> G(cr) - G(cl) for 0 <= cl <= cr <= c_small.
    elemental real(wp) function near_difference(cl, cr) result(value)
        real(wp), intent(in) :: cl, cr

        real(wp) :: width, xl, xr, p, q(2), r(2)

        width = cr - cl
        value = 0.0_wp
        if (.not. width > 0.0_wp) return
        xl = cl*cl
        xr = cr*cr
        p = cr*(cr + cl)
        if (cr <= c_near) then
            q = divided_difference(a_short, xr, xl)
            r = divided_difference(b_short, xr, xl)
        else
            q = divided_difference(a_small, xr, xl)
            r = divided_difference(b_small, xr, xl)
        end if
        value = width*(q(1) + p*q(2) - log(cr)*(r(1) + p*r(2)))
        if (cl > 0.0_wp) value = value - cl*log_ratio(cl, cr)*r(1)
    end function near_difference

    !> ln(cr/cl) for 0 < cl <= cr, accurate when they are close and when they are far apart.
    elemental real(wp) function log_ratio(cl, cr) result(value)
        real(wp), intent(in) :: cl, cr

        if (cr - cl < cl) then
            value = log_1p((cr - cl)/cl)
        else if (cl >= c_large) then
            value = log(cr/cl)
        else
            value = log(cr) - log(cl)
        end if
    end function log_ratio

    !> p(x) by Horner's rule on the even and the odd powers: two short chains are done before one
    !> long one.
    pure real(wp) function polynomial(a, x) result(p)
        real(wp), intent(in) :: a(0:)
        real(wp), intent(in) :: x

        real(wp) :: x2, odd
        integer :: k, last

        last = ubound(a, 1) - mod(ubound(a, 1), 2)
        x2 = x*x
        p = a(last)
        odd = 0.0_wp
        if (last < ubound(a, 1)) odd = a(last + 1)
        do k = last - 2, 0, -2
            p = p*x2 + a(k)
            odd = odd*x2 + a(k + 1)
        end do
        p = p + x*odd
    end function polynomial

    !> p(y) and the divided difference p[x,y] = (p(x) - p(y))/(x - y), together by Horner's rule,
    !> even and odd powers apart: with p(x) = e(x^2) + x o(x^2),
    !> `p[x,y] = (x + y)(e[x^2,y^2] + x o[x^2,y^2]) + o(y^2)`.
    !>
    !> Short or long polynomial is chosen at each call: by one procedure for all of them a number
    !> takes 1.06 to 1.18 times as long.
    pure function divided_difference(a, x, y) result(q)
        real(wp), intent(in) :: a(0:)
        real(wp), intent(in) :: x, y
        real(wp) :: q(2)

        real(wp) :: x2, y2, even, odd, d_even, d_odd
        integer :: k, last

        last = ubound(a, 1) - mod(ubound(a, 1), 2)
        x2 = x*x
        y2 = y*y
        even = a(last)
        odd = 0.0_wp
        if (last < ubound(a, 1)) odd = a(last + 1)
        d_even = 0.0_wp
        d_odd = 0.0_wp
        do k = last - 2, 0, -2
            d_even = d_even*x2 + even
            d_odd = d_odd*x2 + odd
            even = even*y2 + a(k)
            odd = odd*y2 + a(k + 1)
        end do
        q(1) = even + y*odd
        q(2) = (x + y)*(d_even + x*d_odd) + odd
    end function divided_difference
end module faststrip_influence_closed
