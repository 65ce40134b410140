!> Off the centre line, near the strip: trapezium rules in phi, u = X + c sinh(mid + half cos(phi)).
module faststrip_influence_offcentre_near
    use faststrip_base_kinds, only: wp, pi
    use faststrip_numerics_logarithm, only: log_1p
    use faststrip_influence_angle_rules, only: cosine, sine, rule_size, rule_start
    use faststrip_influence_closed_coefficients, only: a => atanh_series, atanh_last
    use faststrip_influence_offcentre_rules, only: accuracy_t, interval, least_near_rule
    implicit none
    private

    public :: near_moments, smooth_near_moments

contains

    !> Trapezium rule in phi, `u = X + c sinh(mid + half cos(phi))`.
    pure subroutine near_moments(x, cl, cr, c, accuracy, m)
        real(wp), intent(in) :: x, cl, cr, c
        type(accuracy_t), intent(in) :: accuracy
        real(wp), intent(out) :: m(3)

        real(wp) :: mid, half
        integer :: rule

        call interval(x, c, mid, half)
        rule = least_near_rule(half, accuracy)
        if (cr - cl <= atanh_last*(max(cr, x - 1.0_wp) + max(cl, x - 1.0_wp))) then
            call narrow_near_sums(rule_size(rule), cosine(rule_start(rule)), &
                                  sine(rule_start(rule)), x, cl, cr, c, mid, half, m)
        else
            call near_sums(rule_size(rule), cosine(rule_start(rule)), &
                           sine(rule_start(rule)), x, cl, cr, c, mid, half, m)
        end if
    end subroutine near_moments

    !> The sums of the rule.
    pure subroutine near_sums(n, cos_phi, sin_phi, x, cl, cr, c, mid, half, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: cos_phi(n), sin_phi(n)
        real(wp), intent(in) :: x, cl, cr, c, mid, half
        real(wp), intent(out) :: m(3)

        real(wp) :: e, delta, u, root, sl, sr, d, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(e, delta, u, root, sl, sr, d, ker) reduction(+:m0, m1, m2)
        do j = 1, n
            e = exp(mid + half*cos_phi(j))
            delta = 0.5_wp*c*(e - 1.0_wp/e)
            u = x + delta
            root = (1.0_wp - x - delta)*(1.0_wp + x + delta)
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            ker = log_1p(d)
            ker = ker*0.5_wp*c*(e + 1.0_wp/e)*sin_phi(j)/sqrt(root)
            m0 = m0 + root*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = pi/n*half*m0
        m(2) = -pi/n*half*m1
        m(3) = pi/n*half*m2
    end subroutine near_sums

    !> The same for strips so narrow, for their distance, that the kernel needs no logarithm. With
    !> one loop for both kernels a number takes 1.7 times as long.
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
            ! Written out: with the plain loop a scalar gradient takes 1.1 times as long.
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

    !> The part ln(c + s) of the kernel of an edge on the field point, trapezium rule in phi.
    pure subroutine smooth_near_moments(x, c, accuracy, m)
        real(wp), intent(in) :: x, c
        type(accuracy_t), intent(in) :: accuracy
        real(wp), intent(out) :: m(3)

        real(wp) :: mid, half
        integer :: rule

        call interval(x, c, mid, half)
        ! The nearest singularities are twice as far as those of a kernel with two edges.
        rule = least_near_rule(0.5_wp*half, accuracy)
        call smooth_near_sums(rule_size(rule), cosine(rule_start(rule)), &
                              sine(rule_start(rule)), x, c, mid, half, m)
    end subroutine smooth_near_moments

    !> The sums of the rule.
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
end module faststrip_influence_offcentre_near
