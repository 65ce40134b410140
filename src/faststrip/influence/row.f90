!> Whole columns of influence numbers: one strip that carries pressure, many field points.
!>
!> A column is what the matrix of the strip method is filled by: the source strip has half-length
!> xd and edges y_left, y_right; field point k lies at (x_k, y_k). All lengths are in mm. The
!> integrals are those of faststrip_influence_closed and faststrip_influence_offcentre, arranged
!> for vector arithmetic:
!>
!> - centre line: field points are sorted by the two forms of G and evaluated side by side;
!> - off the centre line: rules whose nodes are constants, one square root and one division a node.
!>
!> What fits no such rule (edges on both sides of the field point, strips wide for their distance,
!> extreme sizes, arguments that are not finite) goes to the scalar procedures, so that every
!> argument has its answer. Nothing here allocates or raises a floating-point exception.
module faststrip_influence_row
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_closed, only: strip_influence, strip_influence_center_gradient
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre, &
                                                       a_short, b_short, r_short, short_last, &
                                                       a => atanh_series, atanh_last
    implicit none
    private

    public :: influence_column, center_influence_column, center_influence_column_gradient
    public :: influence_column_at, influence_column_gradient

    integer :: i_, k_

    ! Field points of the centre line are taken so many at a time.
    integer, parameter :: chunk = 64

    ! The two forms of G overlap on [c_large, c_small].
    real(wp), parameter :: c_small = 1.0_wp
    real(wp), parameter :: c_large = 0.7_wp
    ! Edges beyond these sizes are left to the scalar functions.
    real(wp), parameter :: least_edge = 1.0e-100_wp
    real(wp), parameter :: largest_edge = 1.0e100_wp

    ! Fewer terms serve up to c = 0.6 and from c = 5/3 on.
    real(wp), parameter :: c_near = sqrt(short_last)
    real(wp), parameter :: c_far = 1.0_wp/c_near + 1.0e-12_wp

    ! Equal strips, up to n = 64: ln(2n + 1), (n - 1/2) ln((2n + 1)/(2n - 1)), (2n + 1)^2,
    ! (2n + 1)^2 - (2n + 1)(2n - 1) + ..., and for the far form the same of the reciprocals.
    integer, parameter :: table_end = 64
    real(wp), parameter :: log_odd(table_end) = [(log(2.0_wp*k_ + 1.0_wp), k_=1, table_end)]
    real(wp), parameter :: left_log(table_end) = [((2*k_ - 1)*atanh(0.5_wp/k_), k_=1, table_end)]
    real(wp), parameter :: odd_square(0:table_end) = [((2.0_wp*k_ + 1.0_wp)**2, k_=0, table_end)]
    real(wp), parameter :: step_square(table_end) = [(4.0_wp*k_*(2*k_ + 1), k_=1, table_end)]
    real(wp), parameter :: half_pi_log(table_end) = [(pi*atanh(0.5_wp/k_), k_=1, table_end)]
    real(wp), parameter :: inverse_square(0:table_end) = 1.0_wp/odd_square
    real(wp), parameter :: inverse_step(table_end) = &
        [(8.0_wp*k_/((2.0_wp*k_ - 1.0_wp)*(2.0_wp*k_ + 1.0_wp))**2, k_=1, table_end)]

    ! Midpoint rules in the angle, on half the circle: sizes, cosines and sines of the nodes.
    integer, parameter :: n_rules = 18
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 28, 32, &
                                                36, 40, 48, 56, 64]
    integer, parameter :: rule_start(n_rules) = [(sum(rule_size(:i_)) - rule_size(i_) + 1, &
                                                  i_=1, n_rules)]
    integer, parameter :: n_nodes = sum(rule_size)
    real(wp), parameter :: angle(n_nodes) = &
        [((pi*(i_ - 0.5_wp)/rule_size(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    real(wp), parameter :: cosine(n_nodes) = cos(angle)

    ! As in faststrip_influence_offcentre: an accuracy exp(-digits) is reached by rule k for
    ! sigma >= far_limit(k) and for half intervals up to half_length_t(k).
    real(wp), parameter :: digits = 27.0_wp
    real(wp), parameter :: far_limit(n_rules) = cosh(0.5_wp*digits/(rule_size - 1))
    real(wp), parameter :: half_t(n_rules) = 0.5_wp*pi/sinh(0.5_wp*digits/rule_size)
    ! The largest far rule that is cheaper than a near one.
    integer, parameter :: last_far = 8

    ! Near rules. Of all maps u = X + a sinh(t) of [t1, t2] on [-1, 1], a singularity at +-i cl
    ! allows those with a <= cl; the one with half interval H, `t = mid + tau`, has
    !     u = X + a sinh(mid + tau) = X (1 - cosh(tau)/cosh(H)) + sinh(tau)/sinh(H),
    !     a^2 = 1/sinh(H)^2 - X^2/cosh(H)^2,
    ! linear in X: with H fixed for each rule, hyperbolic functions are constants.
    real(wp), parameter :: near_a0(n_rules) = 1.0_wp/sinh(half_t)**2
    real(wp), parameter :: near_a1(n_rules) = 1.0_wp/cosh(half_t)**2
    ! From X = coth(H) on a^2 is negative, and u(tau) turns round at tanh(tau) = coth(H)/X. The
    ! mirror image of the end u = 1 is as harmless as the kernel's singularity up to this X.
    real(wp), parameter :: turn(n_rules) = 0.5_wp*(half_t + sqrt(half_t**2 + 0.25_wp*pi**2))
    real(wp), parameter :: near_last(n_rules) = 1.0_wp/(tanh(half_t)*tanh(turn))
    real(wp), parameter :: h_node(n_nodes) = [((half_t(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    real(wp), parameter :: tau(n_nodes) = h_node*cosine
    ! 1 - cosh(tau)/cosh(H), 1 - sinh(tau)/sinh(H), and the derivatives times H sin(phi).
    real(wp), parameter :: one_cosh(n_nodes) = 2.0_wp*sinh(0.5_wp*(h_node + tau)) &
                                               *sinh(0.5_wp*(h_node - tau))/cosh(h_node)
    real(wp), parameter :: one_sinh(n_nodes) = 2.0_wp*cosh(0.5_wp*(h_node + tau)) &
                                               *sinh(0.5_wp*(h_node - tau))/sinh(h_node)
    real(wp), parameter :: d_cosh(n_nodes) = h_node*sin(angle)*sinh(tau)/cosh(h_node)
    real(wp), parameter :: d_sinh(n_nodes) = h_node*sin(angle)*cosh(tau)/sinh(h_node)

    ! A strip is thin if its half-width over its distance is below this. Its kernel is then, with
    ! h its half-width, c its middle, s = sqrt(delta^2 + c^2) and xi = (c/s)^2,
    !     ker = (2h/s) sum_k (h/s)^(2k) P_2k(c/s)/(2k + 1) = (2h/s) sum_m C_m(h^2/c^2) xi^m:
    ! one square root and one division, that of the weight included.
    real(wp), parameter :: thin_last = 0.26_wp
    integer, parameter :: last_power = 8
    ! Coefficient of t^(2j) in P_2k(t), over 2k + 1.
    real(wp), parameter :: legendre(0:last_power, 0:last_power) = reshape( &
        [((merge((-1.0_wp)**(k_ - i_)*gamma(2.0_wp*(k_ + i_) + 1.0_wp) &
                 /(4.0_wp**k_*gamma(max(k_ - i_, 0) + 1.0_wp)*gamma(k_ + i_ + 1.0_wp) &
                   *gamma(2.0_wp*i_ + 1.0_wp)*(2*k_ + 1)), 0.0_wp, i_ <= k_), &
           i_=0, last_power), k_=0, last_power)], [last_power + 1, last_power + 1])
    ! Largest X and sigma of the vector rules; least distance of a field point from the edge.
    real(wp), parameter :: largest_sigma = 1.0e3_wp
    real(wp), parameter :: least_near = 1.0e-5_wp

contains

    !> i_n(b) of eq. (12) for n = 0, 1, ..., size(values) - 1: the column of the classic table,
    !> equal strips, centre line. Relative error below 2e-15.
    !>
    !> One logarithm for the whole column and no division: those of 2n + 1 are constants up to
    !> n = 64, farther strips are left to `strip_influence`.
    pure subroutine influence_column(b, values)
        real(wp), intent(in) :: b           !! half-width over half-length of the strips, > 0
        real(wp), intent(out) :: values(0:) !! (0:N-1), of half-length 1; 0 for b <= 0, NaN for b
                                            !! not finite

        integer :: last, near, small, large, far, n

        last = ubound(values, 1)
        if (last >= 0) values(0) = strip_influence(0, b)
        far = 1
        if (is_plain(b, b)) then
            ! Up to `near` and from `far` on the short forms, up to `small` and from `large` on the
            ! long ones.
            far = min(last, table_end)
            near = min(far, nint_below(c_near/b))
            small = max(near, min(far, nint_below(c_small/b)))
            large = max(small, min(far, nint_below(c_large/b + 2.0_wp)))
            n = max(large, min(far, nint_below(c_far/b + 2.0_wp)))
            if (near > 0) call near_column_short(1, near, b, values(1:near))
            if (small > near) call near_column(near + 1, small, b, &
                                               values(near + 1:small))
            do far = small + 1, large
                values(far) = strip_influence(far, b)
            end do
            if (n > large) call far_column(large + 1, n, b, values(large + 1:n))
            far = min(last, table_end)
            if (far > n) call far_column_short(n + 1, far, b, values(n + 1:far))
            far = far + 1
        end if
        do n = far, last
            values(n) = strip_influence(n, b)
        end do
    end subroutine influence_column

    !> The largest n with 2n + 1 <= x, at least 0 and at most `table_end`.
    pure integer function nint_below(x) result(n)
        real(wp), intent(in) :: x

        n = int(0.5_wp*(max(1.0_wp, min(x, 2.0_wp*table_end + 2.0_wp)) - 1.0_wp))
    end function nint_below

    !> i_n(b) for n from `first` to `last`, (2n + 1) b <= c_near, by
    !> `c [A(c^2) - B(c^2) ln c]`; even and odd powers apart as in faststrip_influence_closed.
    pure subroutine near_column_short(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, log_b, two_b, x, y, x2, y2, ap, ad, bp, bd, p
        real(wp) :: e1, e2, e3, e4, e5, o1, o2, o3, o4, o5
        integer :: n

        square = b*b
        log_b = log(b)
        two_b = 2.0_wp*b
        !$omp simd private(x, y, x2, y2, ap, ad, bp, bd, p, &
        !$omp& e1, e2, e3, e4, e5, o1, o2, o3, o4, o5)
        do n = first, last
            x = square*odd_square(n)
            y = square*odd_square(n - 1)
            x2 = x*x
            y2 = y*y
            e5 = a_short(10)*y2 + a_short(8)
            o5 = a_short(11)*y2 + a_short(9)
            e4 = e5*y2 + a_short(6)
            o4 = o5*y2 + a_short(7)
            e3 = e4*y2 + a_short(4)
            o3 = o4*y2 + a_short(5)
            e2 = e3*y2 + a_short(2)
            o2 = o3*y2 + a_short(3)
            e1 = e2*y2 + a_short(0)
            o1 = o2*y2 + a_short(1)
            ap = e1 + y*o1
            e5 = (((a_short(10)*x2 + e5)*x2 + e4)*x2 + e3)*x2 + e2
            o5 = (((a_short(11)*x2 + o5)*x2 + o4)*x2 + o3)*x2 + o2
            ad = (x + y)*(e5 + x*o5) + o1
            e5 = b_short(10)*y2 + b_short(8)
            o5 = b_short(11)*y2 + b_short(9)
            e4 = e5*y2 + b_short(6)
            o4 = o5*y2 + b_short(7)
            e3 = e4*y2 + b_short(4)
            o3 = o4*y2 + b_short(5)
            e2 = e3*y2 + b_short(2)
            o2 = o3*y2 + b_short(3)
            e1 = e2*y2 + b_short(0)
            o1 = o2*y2 + b_short(1)
            bp = e1 + y*o1
            e5 = (((b_short(10)*x2 + e5)*x2 + e4)*x2 + e3)*x2 + e2
            o5 = (((b_short(11)*x2 + o5)*x2 + o4)*x2 + o3)*x2 + o2
            bd = (x + y)*(e5 + x*o5) + o1
            p = square*step_square(n)
            values(n) = two_b*(ap + p*ad - (log_b + log_odd(n))*(bp + p*bd) - left_log(n)*bp)
        end do
    end subroutine near_column_short

    !> The same for (2n + 1) b <= c_small.
    pure subroutine near_column(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, log_b, two_b, x, y, x2, y2, ap, ad, bp, bd, p
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = b*b
        log_b = log(b)
        two_b = 2.0_wp*b
        !$omp simd private(x, y, x2, y2, ap, ad, bp, bd, p, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*odd_square(n)
            y = square*odd_square(n - 1)
            x2 = x*x
            y2 = y*y
            e = a_small(18)
            o = a_small(19)
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 16, 0, -2
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + a_small(k)
                o = o*y2 + a_small(k + 1)
            end do
            ap = e + y*o
            ad = (x + y)*(d_even + x*d_odd) + o
            e = b_small(20)
            o = 0.0_wp
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 18, 0, -2
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + b_small(k)
                o = o*y2 + b_small(k + 1)
            end do
            bp = e + y*o
            bd = (x + y)*(d_even + x*d_odd) + o
            p = square*step_square(n)
            values(n) = two_b*(ap + p*ad - (log_b + log_odd(n))*(bp + p*bd) - left_log(n)*bp)
        end do
    end subroutine near_column

    !> i_n(b) for n from `first` to `last`, (2n - 1) b >= c_far, by
    !> `(pi/2)(ln 4c + 1/2) + R(1/c^2)/c^2`.
    pure subroutine far_column_short(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, x, y, x2, y2, rp, rd
        real(wp) :: e1, e2, e3, e4, e5, o1, o2, o3, o4, o5
        integer :: n

        square = (1.0_wp/b)**2
        !$omp simd private(x, y, x2, y2, rp, rd, &
        !$omp& e1, e2, e3, e4, e5, o1, o2, o3, o4, o5)
        do n = first, last
            x = square*inverse_square(n)
            y = square*inverse_square(n - 1)
            x2 = x*x
            y2 = y*y
            e5 = r_short(10)*y2 + r_short(8)
            o5 = r_short(11)*y2 + r_short(9)
            e4 = e5*y2 + r_short(6)
            o4 = o5*y2 + r_short(7)
            e3 = e4*y2 + r_short(4)
            o3 = o4*y2 + r_short(5)
            e2 = e3*y2 + r_short(2)
            o2 = o3*y2 + r_short(3)
            e1 = e2*y2 + r_short(0)
            o1 = o2*y2 + r_short(1)
            rp = e1 + y*o1
            e5 = (((r_short(10)*x2 + e5)*x2 + e4)*x2 + e3)*x2 + e2
            o5 = (((r_short(11)*x2 + o5)*x2 + o4)*x2 + o3)*x2 + o2
            rd = (x + y)*(e5 + x*o5) + o1
            values(n) = half_pi_log(n) - square*inverse_step(n)*(rp + square*inverse_square(n)*rd)
        end do
    end subroutine far_column_short

    !> The same for (2n - 1) b >= c_large.
    pure subroutine far_column(first, last, b, values)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: b
        real(wp), intent(out) :: values(first:last)

        real(wp) :: square, x, y, x2, y2, rp, rd
        real(wp) :: e, o, d_even, d_odd
        integer :: n, k

        square = (1.0_wp/b)**2
        !$omp simd private(x, y, x2, y2, rp, rd, &
        !$omp& e, o, d_even, d_odd, k)
        do n = first, last
            x = square*inverse_square(n) - r_centre
            y = square*inverse_square(n - 1) - r_centre
            x2 = x*x
            y2 = y*y
            e = r_large(26)
            o = 0.0_wp
            d_even = 0.0_wp
            d_odd = 0.0_wp
            do k = 24, 0, -2
                d_even = d_even*x2 + e
                d_odd = d_odd*x2 + o
                e = e*y2 + r_large(k)
                o = o*y2 + r_large(k + 1)
            end do
            rp = e + y*o
            rd = (x + y)*(d_even + x*d_odd) + o
            values(n) = half_pi_log(n) - square*inverse_step(n)*(rp + square*inverse_square(n)*rd)
        end do
    end subroutine far_column

    !> Influence of a strip on points of its centre line, any edges. Relative error below 2e-15,
    !> given the edges' distances over the half-length.
    pure subroutine center_influence_column(half_length, y_left, y_right, y, value)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: y(:)        !! field points, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm

        real(wp) :: slope(chunk)
        integer :: from, to

        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, half_length, y_left, y_right, y(from:to), .false., &
                              value(from:to), slope)
        end do
    end subroutine center_influence_column

    !> Influence of a strip on points of its centre line, and its derivative with respect to the
    !> half-length at fixed edges; the derivative to 1e-14 max(1, |c|/(c_right - c_left)).
    pure subroutine center_influence_column_gradient(half_length, y_left, y_right, y, value, &
                                                     d_half_length)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: y(:)              !! field points, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)

        integer :: from, to

        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call center_chunk(to - from + 1, half_length, y_left, y_right, y(from:to), .true., &
                              value(from:to), d_half_length(from:to))
        end do
    end subroutine center_influence_column_gradient

    !> The same for at most `chunk` points, the derivative if asked for.
    pure subroutine center_chunk(n, half_length, y_left, y_right, y, with_slope, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: half_length, y_left, y_right, y(n)
        logical, intent(in) :: with_slope
        real(wp), intent(inout) :: value(n), slope(n)

        real(wp), dimension(chunk, 2) :: width, cl, cr, i0, i1
        real(wp) :: per_length, c1, c2, other
        integer :: place(chunk, 2), members(2), form, k, j
        logical :: plain, inside

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        members = 0
        do k = 1, n
            form = 0
            inside = plain .and. is_plain(1.0_wp, abs(y(k)))
            if (inside) then
                c1 = (y_left - y(k))*per_length
                c2 = (y_right - y(k))*per_length
                if (c1 + c2 < 0.0_wp) then
                    other = -c1
                    c1 = -c2
                    c2 = other
                end if
                if (c1 >= c_large .and. c2 > c1) then
                    form = 2
                else if (c2 <= c_small .and. c2 > max(c1, least_edge) &
                         .and. (c1 >= 0.0_wp .or. c1 <= -c2)) then
                    form = 1
                end if
            end if
            if (form > 0) then
                members(form) = members(form) + 1
                j = members(form)
                place(j, form) = k
                cr(j, form) = c2
                if (c1 >= 0.0_wp) then
                    cl(j, form) = c1
                    width(j, form) = (y_right - y_left)*per_length
                else
                    cl(j, form) = 0.0_wp
                    width(j, form) = c2
                end if
            else if (inside) then
                call strip_influence_center_gradient((y_left - y(k))*per_length, &
                                                     (y_right - y(k))*per_length, value(k), &
                                                     slope(k))
                value(k) = half_length*value(k)
            else
                call strip_influence_gradient(0.0_wp, half_length, y_left - y(k), &
                                              y_right - y(k), value(k), other, slope(k))
            end if
        end do
        if (with_slope) then
            if (members(1) > 0) call near_center(members(1), width(:, 1), cl(:, 1), cr(:, 1), &
                                                 i0(:, 1), i1(:, 1))
            if (members(2) > 0) call far_center(members(2), width(:, 2), cl(:, 2), cr(:, 2), &
                                                i0(:, 2), i1(:, 2))
        else
            if (members(1) > 0) call near_center_value(members(1), width(:, 1), cl(:, 1), &
                                                       cr(:, 1), i0(:, 1))
            if (members(2) > 0) call far_center_value(members(2), width(:, 2), cl(:, 2), &
                                                      cr(:, 2), i0(:, 2))
        end if
        do form = 1, 2
            do j = 1, members(form)
                k = place(j, form)
                value(k) = half_length*i0(j, form)
                if (with_slope) slope(k) = i1(j, form)
                ! Edges on both sides at the same distance: twice one of them.
                if (cl(j, form) > 0.0_wp) cycle
                if (y_left < y(k)) then
                    if (y(k) < y_right) value(k) = 2.0_wp*value(k)
                    if (y(k) < y_right .and. with_slope) slope(k) = 2.0_wp*slope(k)
                end if
            end do
        end do
    end subroutine center_chunk

    !> Are these sizes such that their quotients stay far from the ends of the number range?
    elemental logical function is_plain(half_length, place)
        real(wp), intent(in) :: half_length, place

        is_plain = .false.
        if (.not. (ieee_is_finite(half_length) .and. ieee_is_finite(place))) return
        is_plain = half_length >= least_edge .and. half_length <= largest_edge &
                   .and. place <= largest_edge
    end function is_plain

    !> G(cr) - G(cl) and its derivative in the half-length for 0 <= cl < cr <= c_small.
    pure subroutine near_center(n, width, cl, cr, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n), slope(n)

        real(wp) :: xl, xr, al, ar, dal, dar, da, bl, br, dbl, dbr, db, d, one_d, log_r, ratio
        real(wp) :: left, right
        integer :: i, k

        !$omp simd private(xl, xr, al, ar, dal, dar, da, bl, br, dbl, dbr, db, d, one_d, &
        !$omp& log_r, ratio, left, right, k)
        do i = 1, n
            xl = cl(i)*cl(i)
            xr = cr(i)*cr(i)
            bl = b_small(20)*xl + b_small(19)
            br = b_small(20)*xr + b_small(19)
            db = b_small(20)
            dbl = b_small(20)
            dbr = b_small(20)
            al = a_small(19)
            ar = a_small(19)
            da = 0.0_wp
            dal = 0.0_wp
            dar = 0.0_wp
            do k = 18, 0, -1
                da = da*xr + al
                dal = dal*xl + al
                dar = dar*xr + ar
                al = al*xl + a_small(k)
                ar = ar*xr + a_small(k)
                db = db*xr + bl
                dbl = dbl*xl + bl
                dbr = dbr*xr + br
                bl = bl*xl + b_small(k)
                br = br*xr + b_small(k)
            end do
            d = width(i)/max(cl(i), 1.0e-30_wp*cr(i))
            one_d = 1.0_wp + d
            ratio = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            log_r = log(cr(i))
            d = cr(i)*(cr(i) + cl(i))
            value(i) = width(i)*(al + d*da - log_r*(bl + d*db)) - cl(i)*ratio*bl
            right = cr(i)*(2.0_wp*xr*(dar - log_r*dbr) - br)
            left = cl(i)*(2.0_wp*xl*(dal - (log_r - ratio)*dbl) - bl)
            slope(i) = left - right
        end do
    end subroutine near_center

    !> The value alone.
    pure subroutine near_center_value(n, width, cl, cr, value)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n)

        real(wp) :: xl, xr, al, da, bl, db, d, one_d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, al, da, bl, db, d, one_d, ratio, k)
        do i = 1, n
            xl = cl(i)*cl(i)
            xr = cr(i)*cr(i)
            bl = b_small(20)*xl + b_small(19)
            db = b_small(20)
            al = a_small(19)
            da = 0.0_wp
            do k = 18, 0, -1
                da = da*xr + al
                al = al*xl + a_small(k)
                db = db*xr + bl
                bl = bl*xl + b_small(k)
            end do
            d = width(i)/max(cl(i), 1.0e-30_wp*cr(i))
            one_d = 1.0_wp + d
            ratio = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            d = cr(i)*(cr(i) + cl(i))
            value(i) = width(i)*(al + d*da - log(cr(i))*(bl + d*db)) - cl(i)*ratio*bl
        end do
    end subroutine near_center_value

    !> G(cr) - G(cl) and its derivative in the half-length for c_large <= cl < cr.
    pure subroutine far_center(n, width, cl, cr, value, slope)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n), slope(n)

        real(wp) :: xl, xr, ul, ur, wl, wr, rl, rr, drl, drr, dr, d, one_d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, ul, ur, wl, wr, rl, rr, drl, drr, dr, d, one_d, ratio, k)
        do i = 1, n
            ul = 1.0_wp/cl(i)
            ur = 1.0_wp/cr(i)
            wl = ul*ul
            wr = ur*ur
            xl = wl - r_centre
            xr = wr - r_centre
            rl = r_large(26)
            rr = r_large(26)
            dr = 0.0_wp
            drl = 0.0_wp
            drr = 0.0_wp
            do k = 25, 0, -1
                dr = dr*xr + rl
                drl = drl*xl + rl
                drr = drr*xr + rr
                rl = rl*xl + r_large(k)
                rr = rr*xr + r_large(k)
            end do
            d = width(i)*ul
            one_d = 1.0_wp + d
            ratio = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            value(i) = 0.5_wp*pi*ratio - d*(1.0_wp + cl(i)*ur)*ul*ur*(rl + wr*dr)
            slope(i) = value(i) + 2.0_wp*(wr*(rr + wr*drr) - wl*(rl + wl*drl))
        end do
    end subroutine far_center

    !> The value alone.
    pure subroutine far_center_value(n, width, cl, cr, value)
        integer, intent(in) :: n
        real(wp), intent(in) :: width(n), cl(n), cr(n)
        real(wp), intent(out) :: value(n)

        real(wp) :: xl, xr, ul, ur, rl, dr, d, one_d, ratio
        integer :: i, k

        !$omp simd private(xl, xr, ul, ur, rl, dr, d, one_d, ratio, k)
        do i = 1, n
            ul = 1.0_wp/cl(i)
            ur = 1.0_wp/cr(i)
            xl = ul*ul - r_centre
            xr = ur*ur - r_centre
            rl = r_large(26)
            dr = 0.0_wp
            do k = 25, 0, -1
                dr = dr*xr + rl
                rl = rl*xl + r_large(k)
            end do
            d = width(i)*ul
            one_d = 1.0_wp + d
            ratio = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            value(i) = 0.5_wp*pi*ratio - d*(1.0_wp + cl(i)*ur)*ul*ur*(rl + ur*ur*dr)
        end do
    end subroutine far_center_value

    !> Influence of a strip on any points; `strip_influence_at` for each.
    pure subroutine influence_column_at(half_length, y_left, y_right, x, y, value)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: x(:)        !! field points along the strip, (n), mm
        real(wp), intent(in) :: y(:)        !! field points across, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm

        real(wp) :: d_x, d_half_length
        integer :: k
        logical :: plain

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        do k = 1, size(y)
            if (plain .and. is_plain(1.0_wp, abs(x(k))) .and. is_plain(1.0_wp, abs(y(k)))) then
                value(k) = half_length*strip_influence_at(x(k)/half_length, &
                                                          (y_left - y(k))/half_length, &
                                                          (y_right - y(k))/half_length)
            else
                call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                              value(k), d_x, d_half_length)
            end if
        end do
    end subroutine influence_column_at

    !> Influence of a strip on any points, and its derivatives as in `strip_influence_gradient`;
    !> relative error 1e-10, of d_x relative to I/xd where that is larger.
    pure subroutine influence_column_gradient(half_length, y_left, y_right, x, y, value, d_x, &
                                              d_half_length)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: x(:)              !! field points along the strip, (n), mm
        real(wp), intent(in) :: y(:)              !! field points across, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_x(:)           !! dI/dx, (n)
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)

        real(wp) :: per_length, xs, cl, cr, m(3)
        integer :: k
        logical :: plain, found

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        do k = 1, size(y)
            found = .false.
            if (plain .and. is_plain(1.0_wp, abs(x(k))) .and. is_plain(1.0_wp, abs(y(k)))) then
                xs = abs(x(k))*per_length
                cl = (y_left - y(k))*per_length
                cr = (y_right - y(k))*per_length
                if (cl + cr < 0.0_wp) then
                    m(1) = -cl
                    cl = -cr
                    cr = m(1)
                end if
                if (cl >= least_near .and. cr > cl .and. cr < largest_sigma .and. xs > 0.0_wp &
                    .and. xs < largest_sigma) call point_gradient(xs, cl, cr, m, found)
            end if
            if (found) then
                value(k) = half_length*m(1)
                d_x(k) = sign(1.0_wp, x(k))*m(2)
                d_half_length(k) = m(3)
            else
                call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                              value(k), d_x(k), d_half_length(k))
            end if
        end do
    end subroutine influence_column_gradient

    !> The same for one point; all sizes plain, 0 < cl, X > 0, in half-lengths. `found` is false if
    !> no rule fits.
    pure subroutine point_gradient(x, cl, cr, m, found)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)
        logical, intent(out) :: found

        real(wp) :: narrowness, sigma
        integer :: rule, i, j
        logical :: far, thin

        found = .false.
        m = 0.0_wp
        narrowness = (cr - cl)/(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))
        if (narrowness > atanh_last) return
        thin = narrowness <= thin_last
        sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cl*cl) + sqrt((x + 1.0_wp)**2 + cl*cl))
        far = sigma >= far_limit(last_far)
        rule = n_rules
        if (.not. far) then
            do rule = 1, n_rules
                if (near_a0(rule) - x*x*near_a1(rule) <= cl*cl) exit
            end do
            if (rule > n_rules) return
            far = x > near_last(rule)
        end if
        if (far) then
            do rule = 1, n_rules
                if (sigma >= far_limit(rule)) exit
            end do
            if (rule > n_rules) return
        end if
        found = .true.
        i = rule_start(rule)
        j = rule_start(rule) + rule_size(rule) - 1
        if (far .and. thin) then
            call far_thin_sums(rule_size(rule), cosine(i:j), x, cl, cr, m)
        else if (far) then
            call far_wide_sums(rule_size(rule), cosine(i:j), x, cl, cr, m)
        else if (thin) then
            call near_thin_sums(rule_size(rule), one_cosh(i:j), one_sinh(i:j), d_cosh(i:j), &
                                d_sinh(i:j), x, cl, cr, m)
        else
            call near_wide_sums(rule_size(rule), one_cosh(i:j), one_sinh(i:j), d_cosh(i:j), &
                                d_sinh(i:j), x, cl, cr, m)
        end if
    end subroutine point_gradient

    !> Trapezium rule in theta, u = cos(theta), for thin strips.
    pure subroutine far_thin_sums(n, u, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n), x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, delta, r, y, y2, y4, ker, s0, s1, s2
        integer :: j

        call expand_kernel(cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
        do j = 1, n
            delta = u(j) - x
            r = 1.0_wp/sqrt(delta*delta + middle)
            y = middle*(r*r)
            y2 = y*y
            y4 = y2*y2
            ker = (c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                  + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                        + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) &
                              + y4*(((c(12) + y*c(13)) + y2*(c(14) + y*c(15))) + y4*c(16))))
            ker = r*ker
            s0 = s0 + ker
            s1 = s1 + u(j)*ker
            s2 = s2 + u(j)*u(j)*ker
        end do
        m = pi/n*(cr - cl)*[s0 - s2, -s1, s2]
    end subroutine far_thin_sums

    !> The same for strips that are not so thin.
    pure subroutine far_wide_sums(n, u, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n), x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, sl, sr, z, y, y2, y4, ker, s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd private(delta, sl, sr, z, y, y2, y4, ker) reduction(+:s0, s1, s2)
        do j = 1, n
            delta = u(j) - x
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            z = (cr - cl)/(sr + sl)
            y = z*z
            y2 = y*y
            y4 = y2*y2
            ker = z*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                     + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                           + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                                 + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
            s0 = s0 + ker
            s1 = s1 + u(j)*ker
            s2 = s2 + u(j)*u(j)*ker
        end do
        m = 2.0_wp*pi/n*[s0 - s2, -s1, s2]
    end subroutine far_wide_sums

    !> Trapezium rule in phi, tau = H cos(phi), for thin strips; `rest` is 1 - u.
    pure subroutine near_thin_sums(n, p, q, dp, dq, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, u, delta, rest, root2, r, y, y2, y4, ker, s0, s1, s2
        integer :: j

        call expand_kernel(cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd private(u, delta, rest, root2, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
        do j = 1, n
            rest = q(j) - x*p(j)
            u = 1.0_wp - rest
            delta = (1.0_wp - x) - rest
            root2 = rest*(2.0_wp - rest)
            r = 1.0_wp/sqrt(root2*(delta*delta + middle))
            y = middle*root2*(r*r)
            y2 = y*y
            y4 = y2*y2
            ker = (c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                  + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                        + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) &
                              + y4*(((c(12) + y*c(13)) + y2*(c(14) + y*c(15))) + y4*c(16))))
            ker = r*ker*(dq(j) - x*dp(j))
            s0 = s0 + root2*ker
            s1 = s1 + u*ker
            s2 = s2 + u*u*ker
        end do
        m = pi/n*(cr - cl)*[s0, -s1, s2]
    end subroutine near_thin_sums

    !> The same for strips that are not so thin.
    pure subroutine near_wide_sums(n, p, q, dp, dq, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: u, delta, rest, root, s, z, y, y2, y4, ker, s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        !$omp simd private(u, delta, rest, root, s, z, y, y2, y4, ker) reduction(+:s0, s1, s2)
        do j = 1, n
            rest = q(j) - x*p(j)
            u = 1.0_wp - rest
            delta = (1.0_wp - x) - rest
            root = sqrt(rest*(2.0_wp - rest))
            s = sqrt(delta*delta + cl*cl) + sqrt(delta*delta + cr*cr)
            ! 1/(root s) serves both divisions.
            ker = 1.0_wp/(root*s)
            z = (cr - cl)*root*ker
            y = z*z
            y2 = y*y
            y4 = y2*y2
            z = z*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                   + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                         + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                               + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
            ker = z*(dq(j) - x*dp(j))*(ker*s)
            s0 = s0 + root*root*ker
            s1 = s1 + u*ker
            s2 = s2 + u*u*ker
        end do
        m = 2.0_wp*pi/n*[s0, -s1, s2]
    end subroutine near_wide_sums

    !> The C_m of thin strips: C_m = sum_k legendre(m - k, k) ratio^k, written out, for it is called
    !> once for each field point.
    pure subroutine expand_kernel(cl, cr, c)
        real(wp), intent(in) :: cl, cr
        real(wp), intent(out) :: c(0:2*last_power)

        real(wp), parameter :: l(0:last_power, 0:last_power) = legendre
        real(wp) :: t, t2, t3, t4, t5, t6, t7, t8

        t = ((cr - cl)/(cr + cl))**2
        t2 = t*t
        t3 = t2*t
        t4 = t2*t2
        t5 = t3*t2
        t6 = t3*t3
        t7 = t4*t3
        t8 = t4*t4
        c(0) = l(0, 0)
        c(1) = t*l(0, 1)
        c(2) = t*(l(1, 1) + t*l(0, 2))
        c(3) = t2*(l(1, 2) + t*l(0, 3))
        c(4) = t2*(l(2, 2) + t*(l(1, 3) + t*l(0, 4)))
        c(5) = t3*(l(2, 3) + t*(l(1, 4) + t*l(0, 5)))
        c(6) = t3*(l(3, 3) + t*(l(2, 4) + t*(l(1, 5) + t*l(0, 6))))
        c(7) = t4*(l(3, 4) + t*(l(2, 5) + t*(l(1, 6) + t*l(0, 7))))
        c(8) = t4*(l(4, 4) + t*(l(3, 5) + t*(l(2, 6) + t*(l(1, 7) + t*l(0, 8)))))
        c(9) = t5*(l(4, 5) + t*(l(3, 6) + t*(l(2, 7) + t*l(1, 8))))
        c(10) = t5*(l(5, 5) + t*(l(4, 6) + t*(l(3, 7) + t*l(2, 8))))
        c(11) = t6*(l(5, 6) + t*(l(4, 7) + t*l(3, 8)))
        c(12) = t6*(l(6, 6) + t*(l(5, 7) + t*l(4, 8)))
        c(13) = t7*(l(6, 7) + t*l(5, 8))
        c(14) = t7*(l(7, 7) + t*l(6, 8))
        c(15) = t8*l(7, 8)
        c(16) = t8*l(8, 8)
    end subroutine expand_kernel
end module faststrip_influence_row
