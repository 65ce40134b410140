!> Whole columns of influence numbers: one strip that carries pressure, many field points.
!>
!> The same integrals as in faststrip_influence_closed and faststrip_influence_offcentre, arranged
!> for vector arithmetic: field points are sorted by the rule they need, and points that need the
!> same rule are evaluated together. What fits no common rule (edges on both sides of the field
!> point, strips wide for their distance, extreme sizes, arguments that are not finite) goes to the
!> scalar functions, so that every argument has its answer.
!>
!> A column is what the matrix of the strip method is filled by: the source strip has half-length
!> xd and edges y_left, y_right; field point k lies at (x_k, y_k). All lengths are in mm.
!> Nothing here allocates or raises a floating-point exception.
module faststrip_influence_row
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp, pi
    use faststrip_influence_closed, only: strip_influence, strip_influence_center_gradient
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre, &
                                                       a => atanh_series, atanh_last
    implicit none
    private

    public :: influence_column, center_influence_column, center_influence_column_gradient
    public :: influence_column_at, influence_column_gradient

    integer :: i_, k_

    ! Field points are taken so many at a time, and evaluated so many together.
    integer, parameter :: chunk = 64
    integer, parameter :: lanes = 4

    ! The two forms of G overlap on [c_large, c_small].
    real(wp), parameter :: c_small = 1.0_wp
    real(wp), parameter :: c_large = 0.7_wp
    ! Edges beyond these sizes are left to the scalar functions.
    real(wp), parameter :: least_edge = 1.0e-100_wp
    real(wp), parameter :: largest_edge = 1.0e100_wp

    ! Midpoint rules in the angle, on half the circle: sizes, cosines and sines of the nodes.
    integer, parameter :: n_rules = 19
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, &
                                                32, 36, 40, 48, 56, 64]
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
    integer, parameter :: last_far = 7

    ! Near rules. Of all maps u = X + a sinh(t) of [t1, t2] on [-1, 1], a singularity at +-i cl
    ! allows those with a <= cl; the one with half interval H, `t = mid + tau`, has
    !     u = X + a sinh(mid + tau) = X (1 - cosh(tau)/cosh(H)) + sinh(tau)/sinh(H),
    !     a^2 = 1/sinh(H)^2 - X^2/cosh(H)^2,
    ! linear in X: with H fixed for each rule, hyperbolic functions are constants.
    real(wp), parameter :: near_a0(n_rules) = 1.0_wp/sinh(half_t)**2
    real(wp), parameter :: near_a1(n_rules) = 1.0_wp/cosh(half_t)**2
    ! From X = coth(H) on a^2 is negative, and u(tau) turns round at tanh(tau) = coth(H)/X; its mirror
    ! image of the end u = 1 stays as harmless as the kernel's singularity up to this X.
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

    ! Kinds of field points, each with one inner loop.
    integer, parameter :: far_thin = 1
    integer, parameter :: far_wide = 2
    integer, parameter :: near_thin = 3
    integer, parameter :: near_wide = 4
    integer, parameter :: n_kinds = 4
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
    pure subroutine influence_column(b, values)
        real(wp), intent(in) :: b          !! half-width over half-length of the strips, > 0
        real(wp), intent(out) :: values(:) !! (N), of half-length 1; 0 for b <= 0, NaN for b not
                                           !! finite

        real(wp), dimension(chunk) :: width, cl, cr
        integer :: from, to, i, n, n_near, n_mixed

        if (.not. is_plain(b, b)) then
            do n = 1, size(values)
                values(n) = strip_influence(n - 1, b)
            end do
            return
        end if
        width = 2.0_wp*b
        do from = 1, size(values), chunk
            to = min(from + chunk - 1, size(values))
            n_near = 0
            n_mixed = 0
            do i = 1, to - from + 1
                n = from + i - 2
                cl(i) = (2.0_wp*n - 1.0_wp)*b
                cr(i) = (2.0_wp*n + 1.0_wp)*b
                if (cr(i) <= c_small) then
                    n_near = i
                else if (cl(i) < c_large) then
                    n_mixed = n_mixed + 1
                end if
            end do
            if (n_near > 0) call near_center_value(n_near, width, cl, cr, values(from:))
            i = n_near + n_mixed + 1
            n = to - from + 2 - i
            if (n > 0) call far_center_value(n, width, cl(i:), cr(i:), values(from + i - 1:))
            do i = max(from, 2), from + n_near + n_mixed - 1
                if (i - from >= n_near) values(i) = strip_influence(i - 1, b)
            end do
            if (from == 1) values(1) = strip_influence(0, b)
        end do
    end subroutine influence_column

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
        logical :: plain

        plain = is_plain(half_length, max(abs(y_left), abs(y_right)))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        members = 0
        do k = 1, n
            form = 0
            if (plain .and. is_plain(1.0_wp, abs(y(k)))) then
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
            else if (half_length > 0.0_wp) then
                call strip_influence_center_gradient((y_left - y(k))/half_length, &
                                                     (y_right - y(k))/half_length, value(k), &
                                                     slope(k))
                value(k) = half_length*value(k)
            else
                value(k) = 0.0_wp
                slope(k) = 0.0_wp
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

        integer :: k

        do k = 1, size(y)
            value(k) = half_length*strip_influence_at(x(k)/half_length, &
                                                      (y_left - y(k))/half_length, &
                                                      (y_right - y(k))/half_length)
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

        integer :: from, to

        do from = 1, size(y), chunk
            to = min(from + chunk - 1, size(y))
            call chunk_gradient(to - from + 1, half_length, y_left, y_right, x(from:to), &
                                y(from:to), value(from:to), d_x(from:to), d_half_length(from:to))
        end do
    end subroutine influence_column_gradient

    !> The same for at most `chunk` points.
    pure subroutine chunk_gradient(n, half_length, y_left, y_right, x, y, value, d_x, &
                                   d_half_length)
        integer, intent(in) :: n
        real(wp), intent(in) :: half_length, y_left, y_right, x(n), y(n)
        real(wp), intent(out) :: value(n), d_x(n), d_half_length(n)

        real(wp), dimension(chunk) :: xs, cl, cr
        real(wp), dimension(lanes) :: gx, gl, gr, m0, m1, m2
        real(wp) :: per_length, narrowness, sigma
        integer, dimension(chunk) :: key, order
        integer :: count(0:n_kinds*n_rules), k, i, j, rule, kind, first, last, members(lanes)
        logical :: plain

        plain = is_plain(half_length, max(abs(y_left), abs(y_right)))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        do k = 1, n
            key(k) = 0
            if (.not. plain) cycle
            if (.not. is_plain(1.0_wp, abs(x(k))) .or. .not. is_plain(1.0_wp, abs(y(k)))) cycle
            xs(k) = abs(x(k))*per_length
            cl(k) = (y_left - y(k))*per_length
            cr(k) = (y_right - y(k))*per_length
            if (cl(k) + cr(k) < 0.0_wp) then
                sigma = -cl(k)
                cl(k) = -cr(k)
                cr(k) = sigma
            end if
            if (cl(k) < least_near .or. .not. cr(k) > cl(k)) cycle
            if (.not. (xs(k) < largest_sigma .and. cr(k) < largest_sigma)) cycle
            if (.not. xs(k) > 0.0_wp) cycle
            narrowness = (cr(k) - cl(k))/(max(cr(k), xs(k) - 1.0_wp) + max(cl(k), xs(k) - 1.0_wp))
            if (narrowness > atanh_last) cycle
            sigma = 0.5_wp*(sqrt((xs(k) - 1.0_wp)**2 + cl(k)*cl(k)) &
                            + sqrt((xs(k) + 1.0_wp)**2 + cl(k)*cl(k)))
            do rule = 1, last_far
                if (sigma >= far_limit(rule)) exit
            end do
            if (rule <= last_far) then
                kind = far_thin
                if (narrowness > thin_last) kind = far_wide
            else
                do rule = 1, n_rules
                    if (near_a0(rule) - xs(k)**2*near_a1(rule) <= cl(k)**2) exit
                end do
                if (rule > n_rules) cycle
                if (xs(k) > near_last(rule)) cycle
                kind = near_thin
                if (narrowness > thin_last) kind = near_wide
            end if
            key(k) = (kind - 1)*n_rules + rule
        end do

        ! Counting sort; points without a rule come first and are done one by one.
        count = 0
        do k = 1, n
            count(key(k)) = count(key(k)) + 1
        end do
        do i = 1, n_kinds*n_rules
            count(i) = count(i) + count(i - 1)
        end do
        do k = n, 1, -1
            order(count(key(k))) = k
            count(key(k)) = count(key(k)) - 1
        end do
        first = 1
        do while (first <= n)
            k = order(first)
            if (key(k) == 0) then
                call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                              value(k), d_x(k), d_half_length(k))
                first = first + 1
                cycle
            end if
            kind = (key(k) - 1)/n_rules + 1
            last = first
            sigma = xs(k)
            do i = first + 1, min(first + lanes - 1, n)
                if ((key(order(i)) - 1)/n_rules + 1 /= kind) exit
                sigma = max(sigma, xs(order(i)))
                if (kind >= near_thin .and. &
                    sigma > near_last(key(order(i)) - (kind - 1)*n_rules)) exit
                last = i
            end do
            rule = key(order(last)) - (kind - 1)*n_rules
            do j = 1, lanes
                k = order(min(first + j - 1, last))
                members(j) = k
                gx(j) = xs(k)
                gl(j) = cl(k)
                gr(j) = cr(k)
            end do
            i = rule_start(rule)
            j = rule_start(rule) + rule_size(rule) - 1
            if (kind == far_thin) then
                call far_thin_sums(rule_size(rule), cosine(i:j), gx, gl, gr, m0, m1, m2)
            else if (kind == far_wide) then
                call far_wide_sums(rule_size(rule), cosine(i:j), gx, gl, gr, m0, m1, m2)
            else if (kind == near_thin) then
                call near_thin_sums(rule_size(rule), one_cosh(i:j), one_sinh(i:j), d_cosh(i:j), &
                                    d_sinh(i:j), gx, gl, gr, m0, m1, m2)
            else
                call near_wide_sums(rule_size(rule), one_cosh(i:j), one_sinh(i:j), d_cosh(i:j), &
                                    d_sinh(i:j), gx, gl, gr, m0, m1, m2)
            end if
            do j = 1, last - first + 1
                k = members(j)
                value(k) = half_length*m0(j)
                d_x(k) = sign(1.0_wp, x(k))*m1(j)
                d_half_length(k) = m2(j)
            end do
            first = last + 1
        end do
    end subroutine chunk_gradient

    !> Trapezium rule in theta, u = cos(theta).
    pure subroutine far_wide_sums(n, u, x, cl, cr, m0, m1, m2)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n), x(lanes), cl(lanes), cr(lanes)
        real(wp), intent(out) :: m0(lanes), m1(lanes), m2(lanes)

        real(wp), dimension(lanes) :: s0, s1, s2
        real(wp) :: delta, sl, sr, z, y, ker
        integer :: i, j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        do j = 1, n
            !$omp simd private(delta, sl, sr, z, y, ker)
            do i = 1, lanes
                delta = u(j) - x(i)
                sl = sqrt(delta*delta + cl(i)*cl(i))
                sr = sqrt(delta*delta + cr(i)*cr(i))
                z = (cr(i) - cl(i))/(sr + sl)
                y = z*z
                ker = z*(a(0) + y*(a(1) + y*(a(2) + y*(a(3) + y*(a(4) + y*(a(5) + y*(a(6) &
                      + y*(a(7) + y*(a(8) + y*(a(9) + y*(a(10) + y*(a(11) + y*(a(12) &
                      + y*(a(13) + y*(a(14) + y*a(15))))))))))))))))
                s0(i) = s0(i) + ker
                ker = u(j)*ker
                s1(i) = s1(i) - ker
                s2(i) = s2(i) + u(j)*ker
            end do
        end do
        m0 = 2.0_wp*pi/n*(s0 - s2)
        m1 = 2.0_wp*pi/n*s1
        m2 = 2.0_wp*pi/n*s2
    end subroutine far_wide_sums

    !> The same for thin strips.
    pure subroutine far_thin_sums(n, u, x, cl, cr, m0, m1, m2)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n), x(lanes), cl(lanes), cr(lanes)
        real(wp), intent(out) :: m0(lanes), m1(lanes), m2(lanes)

        real(wp), dimension(lanes) :: s0, s1, s2, middle
        real(wp) :: c(lanes, 0:2*last_power), delta, r, y, ker
        integer :: i, j

        call expand_kernel(cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        do j = 1, n
            !$omp simd private(delta, r, y, ker)
            do i = 1, lanes
                delta = u(j) - x(i)
                r = 1.0_wp/sqrt(delta*delta + middle(i))
                y = middle(i)*(r*r)
                ker = c(i, 0) + y*(c(i, 1) + y*(c(i, 2) + y*(c(i, 3) + y*(c(i, 4) + y*(c(i, 5) &
                    + y*(c(i, 6) + y*(c(i, 7) + y*(c(i, 8) + y*(c(i, 9) + y*(c(i, 10) &
                    + y*(c(i, 11) + y*(c(i, 12) + y*(c(i, 13) + y*(c(i, 14) + y*(c(i, 15) &
                    + y*c(i, 16))))))))))))))))
                ker = r*ker
                s0(i) = s0(i) + ker
                ker = u(j)*ker
                s1(i) = s1(i) - ker
                s2(i) = s2(i) + u(j)*ker
            end do
        end do
        m0 = pi/n*(cr - cl)*(s0 - s2)
        m1 = pi/n*(cr - cl)*s1
        m2 = pi/n*(cr - cl)*s2
    end subroutine far_thin_sums

    !> The C_m of thin strips.
    pure subroutine expand_kernel(cl, cr, c)
        real(wp), intent(in) :: cl(lanes), cr(lanes)
        real(wp), intent(out) :: c(lanes, 0:2*last_power)

        real(wp) :: ratio(lanes), power(lanes)
        integer :: j, k

        ratio = ((cr - cl)/(cr + cl))**2
        power = 1.0_wp
        c = 0.0_wp
        do k = 0, last_power
            do j = 0, k
                c(:, k + j) = c(:, k + j) + legendre(j, k)*power
            end do
            power = power*ratio
        end do
    end subroutine expand_kernel

    !> Trapezium rule in phi, tau = H cos(phi); `rest` is 1 - u.
    pure subroutine near_wide_sums(n, p, q, dp, dq, x, cl, cr, m0, m1, m2)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in), dimension(lanes) :: x, cl, cr
        real(wp), intent(out), dimension(lanes) :: m0, m1, m2

        real(wp), dimension(lanes) :: s0, s1, s2
        real(wp) :: u, delta, rest, root, sl, sr, z, y, ker
        integer :: i, j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        do j = 1, n
            !$omp simd private(u, delta, rest, root, sl, sr, z, y, ker)
            do i = 1, lanes
                rest = q(j) - x(i)*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x(i)) - rest
                root = sqrt(rest*(2.0_wp - rest))
                sl = sqrt(delta*delta + cl(i)*cl(i))
                sr = sqrt(delta*delta + cr(i)*cr(i)) + sl
                ker = 1.0_wp/(root*sr)
                z = (cr(i) - cl(i))*root*ker
                y = z*z
                z = z*(a(0) + y*(a(1) + y*(a(2) + y*(a(3) + y*(a(4) + y*(a(5) + y*(a(6) &
                    + y*(a(7) + y*(a(8) + y*(a(9) + y*(a(10) + y*(a(11) + y*(a(12) &
                    + y*(a(13) + y*(a(14) + y*a(15))))))))))))))))
                ker = z*(dq(j) - x(i)*dp(j))*(ker*sr)
                s0(i) = s0(i) + root*root*ker
                ker = u*ker
                s1(i) = s1(i) - ker
                s2(i) = s2(i) + u*ker
            end do
        end do
        m0 = 2.0_wp*pi/n*s0
        m1 = 2.0_wp*pi/n*s1
        m2 = 2.0_wp*pi/n*s2
    end subroutine near_wide_sums

    !> The same for thin strips.
    pure subroutine near_thin_sums(n, p, q, dp, dq, x, cl, cr, m0, m1, m2)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in), dimension(lanes) :: x, cl, cr
        real(wp), intent(out), dimension(lanes) :: m0, m1, m2

        real(wp), dimension(lanes) :: s0, s1, s2, middle
        real(wp) :: c(lanes, 0:2*last_power), u, delta, rest, root2, r, y, ker
        integer :: i, j

        call expand_kernel(cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        do j = 1, n
            !$omp simd private(u, delta, rest, root2, r, y, ker)
            do i = 1, lanes
                rest = q(j) - x(i)*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x(i)) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle(i)))
                y = middle(i)*root2*(r*r)
                ker = c(i, 0) + y*(c(i, 1) + y*(c(i, 2) + y*(c(i, 3) + y*(c(i, 4) + y*(c(i, 5) &
                    + y*(c(i, 6) + y*(c(i, 7) + y*(c(i, 8) + y*(c(i, 9) + y*(c(i, 10) &
                    + y*(c(i, 11) + y*(c(i, 12) + y*(c(i, 13) + y*(c(i, 14) + y*(c(i, 15) &
                    + y*c(i, 16))))))))))))))))
                ker = r*ker*(dq(j) - x(i)*dp(j))
                s0(i) = s0(i) + root2*ker
                ker = u*ker
                s1(i) = s1(i) - ker
                s2(i) = s2(i) + u*ker
            end do
        end do
        m0 = pi/n*(cr - cl)*s0
        m1 = pi/n*(cr - cl)*s1
        m2 = pi/n*(cr - cl)*s2
    end subroutine near_thin_sums
end module faststrip_influence_row
