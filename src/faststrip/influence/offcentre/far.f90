!> Off the centre line, far from the strip's edges: trapezium rules in theta, u = cos(theta).
module faststrip_influence_offcentre_far
    use faststrip_base_kinds, only: wp, pi
    use faststrip_numerics_logarithm, only: log_1p
    use faststrip_influence_closed_coefficients, only: a => atanh_series
    implicit none
    private

    public :: far_moments, narrow_far_moments, smooth_far_moments

contains

    !> Trapezium rule in theta. The derivative in X comes from that of the kernel: no logarithm
    !> and no cancellation in the far field.
    pure subroutine far_moments(n, u, x, cl, cr, m)
        integer, intent(in) :: n
        real(wp), intent(in) :: u(n)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, sl, sr, d, ker, uu, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(delta, sl, sr, d, ker, uu) reduction(+:m0, m1, m2)
        do j = 1, n
            delta = u(j) - x
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            ker = log_1p(d)
            uu = u(j)*u(j)
            m0 = m0 + (1.0_wp - uu)*ker
            m2 = m2 + uu*ker
            m1 = m1 + (1.0_wp - uu)*delta/(sr*sl*(cr*sl + cl*sr))
        end do
        m(1) = pi/n*m0
        m(2) = pi/n*(cr - cl)*(cr + cl)*m1
        m(3) = pi/n*m2
    end subroutine far_moments

    !> The same for strips so narrow, for their distance, that the kernel needs no logarithm; a loop
    !> of its own as in faststrip_influence_offcentre_near.
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
            ! Written out: with the plain loop a scalar gradient takes 1.1 times as long.
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
end module faststrip_influence_offcentre_far
