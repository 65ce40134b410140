!> Columns of influence numbers at the tips of strips, as many and as exact as an iteration needs.
!>
!> The same integrals as in faststrip_influence_row to a relative 3e-8: fewer nodes, and for thin
!> strips no more terms than their width asks for. What fits no rule goes to the scalar procedure of
!> faststrip_influence_offcentre.
!>
!> At its own tip a strip's influence depends on one ratio only. With `kappa = w/(4 xd)`
!>
!>     I(xd; xd, -w/2, w/2) = 2 xd G(1, 2 kappa),   dG/dkappa = 2 g(kappa),
!>     g = 2 int_0^1 sqrt(s (1 - s))/sqrt(s^2 + kappa^2) ds
!>       = pi + sum_m B_m kappa^(m + 1/2),          kappa < 1,
!>     B_m = (-1)^m binom(1/2, m) Gamma(-m/2 - 1/4) Gamma(m/2 + 3/4)/sqrt(pi),
!>
!> the residues of the integral's Mellin transform.
module faststrip_influence_tip
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_closed_coefficients, only: a => atanh_series, atanh_last
    implicit none
    private

    public :: tip_influence_column, tip_influence_column_gradient

    integer :: i_, k_

    ! Midpoint rules in the angle, as in faststrip_influence_row, for an accuracy exp(-digits).
    integer, parameter :: n_rules = 18
    integer, parameter :: rule_size(n_rules) = [4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 28, 32, &
                                                36, 40, 48, 56, 64]
    integer, parameter :: rule_start(n_rules) = [(sum(rule_size(:i_)) - rule_size(i_) + 1, &
                                                  i_=1, n_rules)]
    integer, parameter :: n_nodes = sum(rule_size)
    real(wp), parameter :: angle(n_nodes) = &
        [((pi*(i_ - 0.5_wp)/rule_size(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    real(wp), parameter :: cosine(n_nodes) = cos(angle)
    real(wp), parameter :: digits = 17.5_wp
    real(wp), parameter :: far_limit(n_rules) = cosh(0.5_wp*digits/(rule_size - 1))
    real(wp), parameter :: half_t(n_rules) = 0.5_wp*pi/sinh(0.5_wp*digits/rule_size)
    integer, parameter :: last_far = 8 ! the largest far rule that is cheaper than a near one
    real(wp), parameter :: near_a0(n_rules) = 1.0_wp/sinh(half_t)**2
    real(wp), parameter :: near_a1(n_rules) = 1.0_wp/cosh(half_t)**2
    real(wp), parameter :: turn(n_rules) = 0.5_wp*(half_t + sqrt(half_t**2 + 0.25_wp*pi**2))
    real(wp), parameter :: near_last(n_rules) = 1.0_wp/(tanh(half_t)*tanh(turn))
    real(wp), parameter :: h_node(n_nodes) = [((half_t(k_), i_=1, rule_size(k_)), k_=1, n_rules)]
    real(wp), parameter :: tau(n_nodes) = h_node*cosine
    real(wp), parameter :: one_cosh(n_nodes) = 2.0_wp*sinh(0.5_wp*(h_node + tau)) &
                                               *sinh(0.5_wp*(h_node - tau))/cosh(h_node)
    real(wp), parameter :: one_sinh(n_nodes) = 2.0_wp*cosh(0.5_wp*(h_node + tau)) &
                                               *sinh(0.5_wp*(h_node - tau))/sinh(h_node)
    real(wp), parameter :: d_cosh(n_nodes) = h_node*sin(angle)*sinh(tau)/cosh(h_node)
    real(wp), parameter :: d_sinh(n_nodes) = h_node*sin(angle)*cosh(tau)/sinh(h_node)

    ! Thin strips: powers of the half-width over the distance up to twice 2, 4, 6, each good up to
    ! a largest narrowness.
    integer, parameter :: last_power = 6
    real(wp), parameter :: thin_last(3) = [0.045_wp, 0.16_wp, 0.28_wp]
    ! Coefficient of t^(2j) in P_2k(t), over 2k + 1.
    real(wp), parameter :: legendre(0:last_power, 0:last_power) = reshape( &
        [((merge((-1.0_wp)**(k_ - i_)*gamma(2.0_wp*(k_ + i_) + 1.0_wp) &
                 /(4.0_wp**k_*gamma(max(k_ - i_, 0) + 1.0_wp)*gamma(k_ + i_ + 1.0_wp) &
                   *gamma(2.0_wp*i_ + 1.0_wp)*(2*k_ + 1)), 0.0_wp, i_ <= k_), &
           i_=0, last_power), k_=0, last_power)], [last_power + 1, last_power + 1])
    integer, parameter :: wide = 4

    ! Largest X and sigma of the vector rules; least distance of a field point from the edge; sizes
    ! beyond which the scalar procedure has to do.
    real(wp), parameter :: largest_sigma = 1.0e3_wp
    real(wp), parameter :: least_near = 1.0e-5_wp
    real(wp), parameter :: least_size = 1.0e-100_wp, largest_size = 1.0e100_wp

    ! The series of a strip's own tip, up to a largest kappa.
    integer, parameter :: last_own = 18
    real(wp), parameter :: own_kappa = 0.35_wp
    real(wp), parameter :: own(0:last_own) = &
        [((-1.0_wp)**k_*gamma(1.5_wp)/(gamma(k_ + 1.0_wp)*gamma(1.5_wp - k_)) &
          *gamma(-0.5_wp*k_ - 0.25_wp)*gamma(0.5_wp*k_ + 0.75_wp)/sqrt(pi), k_=0, last_own)]

contains

    !> Influence of a strip on the tips of others and on its own; relative error below 1e-7.
    pure subroutine tip_influence_column(half_length, y_left, y_right, x, y, value)
        real(wp), intent(in) :: half_length !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: x(:)        !! field points along the strip, (n), mm, finite
        real(wp), intent(in) :: y(:)        !! field points across, (n), mm, finite
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm

        real(wp) :: m(3)
        integer :: k

        do k = 1, size(y)
            call entry(half_length, y_left, y_right, x(k), y(k), m)
            value(k) = m(1)
        end do
    end subroutine tip_influence_column

    !> The same and its derivatives as in `strip_influence_gradient`. At the strip's own tip the tip
    !> moves with the half-length: d_half_length is the derivative of both, d_x is 0.
    pure subroutine tip_influence_column_gradient(half_length, y_left, y_right, x, y, value, d_x, &
                                                  d_half_length)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: x(:)              !! field points along the strip, (n), mm, finite
        real(wp), intent(in) :: y(:)              !! field points across, (n), mm, finite
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_x(:)           !! dI/dx, (n)
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)

        real(wp) :: m(3)
        integer :: k

        do k = 1, size(y)
            call entry(half_length, y_left, y_right, x(k), y(k), m)
            value(k) = m(1)
            d_x(k) = m(2)
            d_half_length(k) = m(3)
        end do
    end subroutine tip_influence_column_gradient

    !> One number: value, and its derivatives in x and in the half-length if asked for.
    pure subroutine entry(half_length, y_left, y_right, x, y, m)
        real(wp), intent(in) :: half_length, y_left, y_right, x, y
        real(wp), intent(out) :: m(3)

        real(wp) :: per_length, xs, cl, cr, other
        logical :: found, own_tip

        found = .false.
        own_tip = .false.
        if (min(half_length, abs(x)) > least_size &
            .and. max(half_length, abs(x), abs(y_left), abs(y_right), abs(y)) < largest_size) then
            per_length = 1.0_wp/half_length
            xs = abs(x)*per_length
            cl = (y_left - y)*per_length
            cr = (y_right - y)*per_length
            if (cl + cr < 0.0_wp) then
                other = -cl
                cl = -cr
                cr = other
            end if
            if (cl >= least_near .and. cr > cl .and. cr < largest_sigma &
                .and. xs < largest_sigma) then
                call point(xs, cl, cr, m, found)
            else if (abs(x) >= half_length .and. abs(x) <= half_length) then
                own_tip = cr > 0.0_wp .and. cl + cr <= 4.0_wp*epsilon(cr)*(cr + abs(y)*per_length)
                if (own_tip .and. cr <= 2.0_wp*own_kappa) then
                    call own_tip_series(0.5_wp*cr, m)
                    found = .true.
                end if
            end if
        end if
        if (found) then
            m(1) = half_length*m(1)
            m(2) = sign(1.0_wp, x)*m(2)
        else
            call strip_influence_gradient(x, half_length, y_left - y, y_right - y, m(1), m(2), m(3))
            if (own_tip) then
                m(3) = m(3) + sign(m(2), m(2)*x)
                m(2) = 0.0_wp
            end if
        end if
    end subroutine entry

    !> The strip's own tip: 2 G(1, 2 kappa), 0, and the derivative in the half-length, the tip
    !> moving along.
    pure subroutine own_tip_series(kappa, m)
        real(wp), intent(in) :: kappa
        real(wp), intent(out) :: m(3)

        real(wp) :: primitive, slope, root
        integer :: k

        primitive = 0.0_wp
        slope = 0.0_wp
        do k = last_own, 0, -1
            slope = slope*kappa + own(k)
            primitive = primitive*kappa + own(k)/(k + 1.5_wp)
        end do
        root = sqrt(kappa)
        m(1) = 4.0_wp*kappa*(pi + root*primitive)
        m(2) = 0.0_wp
        m(3) = m(1) - 4.0_wp*kappa*(pi + root*slope)
    end subroutine own_tip_series

    !> Any other point of X > 0, 0 < cl; `found` is false if no rule fits.
    pure subroutine point(x, cl, cr, m, found)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)
        logical, intent(out) :: found

        real(wp) :: narrowness, sigma
        integer :: rule, i, form
        logical :: far

        found = .false.
        m = 0.0_wp
        narrowness = (cr - cl)/(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))
        if (narrowness > atanh_last) return
        do form = 1, wide - 1
            if (narrowness <= thin_last(form)) exit
        end do
        sigma = 0.5_wp*(sqrt((x - 1.0_wp)**2 + cl*cl) + sqrt((x + 1.0_wp)**2 + cl*cl))
        do rule = 1, n_rules
            if (sigma >= far_limit(rule)) exit
        end do
        far = rule <= last_far
        if (.not. far) then
            do i = 1, n_rules
                if (near_a0(i) - x*x*near_a1(i) <= cl*cl) exit
            end do
            if (i > n_rules) return
            far = x > near_last(i)
            if (far .and. rule > n_rules) return
            if (.not. far) rule = i
        end if
        found = .true.
        i = rule_start(rule)
        if (far) then
            call far_sums(rule_size(rule), cosine(i), x, cl, cr, form, m)
        else
            call near_sums(rule_size(rule), one_cosh(i), one_sinh(i), d_cosh(i), d_sinh(i), x, &
                           cl, cr, form, m)
        end if
    end subroutine point

    !> Trapezium rule in theta, u = cos(theta): the sums of sqrt(1 - u^2), -u/sqrt(1 - u^2) and
    !> u^2/sqrt(1 - u^2) times the kernel.
    pure subroutine far_sums(n, u, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in) :: u(n), x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, delta, r, y, y2, y4, ker, s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        if (form < wide) call expand_kernel(form, cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        select case (form)
        case (1)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                ker = r*((c(0) + y*c(1)) + y2*((c(2) + y*c(3)) + y2*c(4)))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case (2)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) + y4*c(8)))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case (3)
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/sqrt(delta*delta + middle)
                y = middle*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) + y4*c(12))))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        case default
            !$omp simd private(delta, r, y, y2, y4, ker) reduction(+:s0, s1, s2)
            do j = 1, n
                delta = u(j) - x
                r = 1.0_wp/(sqrt(delta*delta + cl*cl) + sqrt(delta*delta + cr*cr))
                y = ((cr - cl)*r)**2
                y2 = y*y
                y4 = y2*y2
                ker = r*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                         + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                               + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                                     + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
                s0 = s0 + ker
                s1 = s1 + u(j)*ker
                s2 = s2 + u(j)*u(j)*ker
            end do
        end select
        m = merge(2.0_wp, 1.0_wp, form == wide)*pi/n*(cr - cl)*[s0 - s2, -s1, s2]
    end subroutine far_sums

    !> Trapezium rule in phi, tau = H cos(phi), `rest` is 1 - u; see faststrip_influence_row.
    pure subroutine near_sums(n, p, q, dp, dq, x, cl, cr, form, m)
        integer, intent(in) :: n, form
        real(wp), intent(in), dimension(n) :: p, q, dp, dq
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: c(0:2*last_power), middle, u, delta, rest, root, root2, r, y, y2, y4, ker, &
                    s0, s1, s2
        integer :: j

        s0 = 0.0_wp
        s1 = 0.0_wp
        s2 = 0.0_wp
        if (form < wide) call expand_kernel(form, cl, cr, c)
        middle = (0.5_wp*(cl + cr))**2
        select case (form)
        case (1)
            !$omp simd private(u, delta, rest, root, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*((c(2) + y*c(3)) + y2*c(4)))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case (2)
            !$omp simd private(u, delta, rest, root, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) + y4*c(8)))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case (3)
            !$omp simd private(u, delta, rest, root, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                r = 1.0_wp/sqrt(root2*(delta*delta + middle))
                y = middle*root2*(r*r)
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((c(0) + y*c(1)) + y2*(c(2) + y*c(3)) &
                         + y4*(((c(4) + y*c(5)) + y2*(c(6) + y*c(7))) &
                               + y4*(((c(8) + y*c(9)) + y2*(c(10) + y*c(11))) + y4*c(12))))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        case default
            !$omp simd private(u, delta, rest, root, root2, r, y, y2, y4, ker) &
            !$omp& reduction(+:s0, s1, s2)
            do j = 1, n
                rest = q(j) - x*p(j)
                u = 1.0_wp - rest
                delta = (1.0_wp - x) - rest
                root2 = rest*(2.0_wp - rest)
                root = sqrt(root2)
                r = 1.0_wp/(root*(sqrt(delta*delta + cl*cl) + sqrt(delta*delta + cr*cr)))
                y = ((cr - cl)*root*r)**2
                y2 = y*y
                y4 = y2*y2
                ker = (dq(j) - x*dp(j))*r*((a(0) + y*a(1)) + y2*(a(2) + y*a(3)) &
                         + y4*(((a(4) + y*a(5)) + y2*(a(6) + y*a(7))) &
                               + y4*(((a(8) + y*a(9)) + y2*(a(10) + y*a(11))) &
                                     + y4*((a(12) + y*a(13)) + y2*(a(14) + y*a(15))))))
                s0 = s0 + root2*ker
                s1 = s1 + u*ker
                s2 = s2 + u*u*ker
            end do
        end select
        m = merge(2.0_wp, 1.0_wp, form == wide)*pi/n*(cr - cl)*[s0, -s1, s2]
    end subroutine near_sums

    !> The C_m of thin strips, C_m = sum_k legendre(m - k, k) ratio^k, as many as `form` needs.
    pure subroutine expand_kernel(form, cl, cr, c)
        integer, intent(in) :: form
        real(wp), intent(in) :: cl, cr
        real(wp), intent(out) :: c(0:2*last_power)

        real(wp), parameter :: l(0:last_power, 0:last_power) = legendre
        real(wp) :: t, t2, t3, t4

        t = ((cr - cl)/(cr + cl))**2
        t2 = t*t
        c(0) = 1.0_wp
        c(1) = t*l(0, 1)
        c(2) = t*(l(1, 1) + t*l(0, 2))
        c(3) = t2*l(1, 2)
        c(4) = t2*l(2, 2)
        if (form == 1) return
        t3 = t2*t
        t4 = t2*t2
        c(3) = c(3) + t3*l(0, 3)
        c(4) = c(4) + t3*(l(1, 3) + t*l(0, 4))
        c(5) = t3*(l(2, 3) + t*l(1, 4))
        c(6) = t3*(l(3, 3) + t*l(2, 4))
        c(7) = t4*l(3, 4)
        c(8) = t4*l(4, 4)
        if (form == 2) return
        c(5) = c(5) + t4*t*l(0, 5)
        c(6) = c(6) + t4*t*(l(1, 5) + t*l(0, 6))
        c(7) = c(7) + t4*t*(l(2, 5) + t*l(1, 6))
        c(8) = c(8) + t4*t*(l(3, 5) + t*l(2, 6))
        c(9) = t4*t*(l(4, 5) + t*l(3, 6))
        c(10) = t4*t*(l(5, 5) + t*l(4, 6))
        c(11) = t4*t2*l(5, 6)
        c(12) = t4*t2*l(6, 6)
    end subroutine expand_kernel
end module faststrip_influence_tip
