!> The influence of a strip at a point off its centre line, by quadrature that knows the kernel.
!>
!> With `u` along the strip that carries the pressure, `X = x/xd` and edges `c = e/xd`,
!>
!>     G(X, cr) - G(X, cl) = int_{-1}^{1} sqrt(1 - u^2) ker(u - X) du,
!>     ker(delta) = asinh(cr/|delta|) - asinh(cl/|delta|) = log(1 + d),
!>     d = (cr - cl) [1 + (cr + cl)/(s_r + s_l)] / (cl + s_l),   s = sqrt(delta^2 + c^2),
!>
!> the inner integral of eq. (18)-(20) with source and field exchanged. The kernel is singular at
!> `delta = +-i cl`, so in `u = cos(theta)` the trapezium rule with N nodes errs by
!> `exp(-2 N acosh(sigma))`, `sigma = (hypot(X - 1, cl) + hypot(X + 1, cl))/2`. Close to the strip
!> a folded double-exponential rule takes over.
module faststrip_influence_offcentre
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_kinds, only: wp, pi
    implicit none
    private

    public :: strip_influence_gradient

    integer :: i_

    ! Nodes u = cos(theta) of the trapezium (midpoint) rule in theta.
    real(wp), parameter :: u4(4) = cos([(pi*(i_ - 0.5_wp)/4, i_=1, 4)])
    real(wp), parameter :: u8(8) = cos([(pi*(i_ - 0.5_wp)/8, i_=1, 8)])
    real(wp), parameter :: u12(12) = cos([(pi*(i_ - 0.5_wp)/12, i_=1, 12)])
    real(wp), parameter :: u16(16) = cos([(pi*(i_ - 0.5_wp)/16, i_=1, 16)])
    real(wp), parameter :: u24(24) = cos([(pi*(i_ - 0.5_wp)/24, i_=1, 24)])
    real(wp), parameter :: u32(32) = cos([(pi*(i_ - 0.5_wp)/32, i_=1, 32)])

    ! The folded double-exponential rule on [0,1]: abscissae y and weights.
    integer, parameter :: n_fold = 128
    real(wp), parameter :: h_fold = 0.0352_wp
    real(wp), parameter :: t_fold(n_fold) = [(h_fold*(i_ - 1), i_=1, n_fold)]
    real(wp), parameter :: y_fold(n_fold) = 2.0_wp/(1.0_wp + exp(sinh(t_fold) + t_fold))
    real(wp), parameter :: w_end(n_fold) = [0.5_wp, (1.0_wp, i_=2, n_fold)]
    real(wp), parameter :: w_fold(n_fold) = &
        w_end*h_fold*(cosh(t_fold) + 1.0_wp)*0.5_wp*y_fold*(2.0_wp - y_fold)

contains

    !> Influence of a strip and its derivatives with respect to the place of the field point along
    !> the strip and to the half-length, at fixed edges; relative error 1e-10.
    pure subroutine strip_influence_gradient(x, half_length, e_left, e_right, value, d_x, &
                                             d_half_length)
        real(wp), intent(in) :: x              !! field point along the strip, mm
        real(wp), intent(in) :: half_length    !! xd of the strip that carries the pressure, mm
        real(wp), intent(in) :: e_left         !! its left edge less the field point's y, mm
        real(wp), intent(in) :: e_right        !! its right edge less the field point's y, mm
        real(wp), intent(out) :: value         !! influence I, mm
        real(wp), intent(out) :: d_x           !! dI/dx
        real(wp), intent(out) :: d_half_length !! dI/dxd

        real(wp) :: place, cl, cr, part(3), other(3)

        if (.not. (ieee_is_finite(x) .and. ieee_is_finite(half_length) &
                   .and. ieee_is_finite(e_left) .and. ieee_is_finite(e_right))) then
            value = ieee_value(value, ieee_quiet_nan)
            d_x = value
            d_half_length = value
            return
        end if
        if (half_length <= 0.0_wp) then
            value = 0.0_wp
            d_x = 0.0_wp
            d_half_length = 0.0_wp
            return
        end if
        place = abs(x)/half_length
        cl = e_left/half_length
        cr = e_right/half_length
        if (cl >= 0.0_wp) then
            call moments(place, cl, cr, part)
        else if (cr <= 0.0_wp) then
            call moments(place, -cr, -cl, part)
        else
            call moments(place, 0.0_wp, cr, part)
            if (cl == -cr) then
                other = part
            else
                call moments(place, 0.0_wp, -cl, other)
            end if
            part = part + other
        end if
        value = half_length*part(1)
        d_half_length = part(3)
        if (x < 0.0_wp) then
            d_x = -part(2)
        else
            d_x = part(2)
        end if
    end subroutine strip_influence_gradient

    !> Value, derivative in X and `int u^2/sqrt(1-u^2) ker du`, for `0 <= cl < cr`.
    pure subroutine moments(x, cl, cr, m)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: sigma

        sigma = 0.5_wp*(hypot(x - 1.0_wp, cl) + hypot(x + 1.0_wp, cl))
        if (sigma > 20.0_wp) then
            call far_moments(u4, x, cl, cr, m)
        else if (sigma > 3.0_wp) then
            call far_moments(u8, x, cl, cr, m)
        else if (sigma > 1.59_wp) then
            call far_moments(u12, x, cl, cr, m)
        else if (sigma > 1.32_wp) then
            call far_moments(u16, x, cl, cr, m)
        else if (sigma > 1.139_wp) then
            call far_moments(u24, x, cl, cr, m)
        else if (sigma > 1.078_wp) then
            call far_moments(u32, x, cl, cr, m)
        else if (x < 1.0_wp) then
            call near_moments(x, cl, cr, m)
        else
            call tip_moments(x, cl, cr, m)
        end if
    end subroutine moments

    !> Trapezium rule in theta. The derivative in X comes from that of the kernel: no logarithm
    !> and no cancellation in the far field.
    pure subroutine far_moments(u, x, cl, cr, m)
        real(wp), intent(in) :: u(:)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: delta, sl, sr, d, one_d, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(delta, sl, sr, d, one_d, ker) reduction(+:m0, m1, m2)
        do j = 1, size(u)
            delta = u(j) - x
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(1.0_wp + (cr + cl)/(sr + sl))/(cl + sl)
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            m0 = m0 + (1.0_wp - u(j)*u(j))*ker
            m2 = m2 + u(j)*u(j)*ker
            m1 = m1 + (1.0_wp - u(j)*u(j))*delta/(sr*sl*(cr*sl + cl*sr))
        end do
        m(1) = pi/size(u)*m0
        m(2) = pi/size(u)*(cr - cl)*(cr + cl)*m1
        m(3) = pi/size(u)*m2
    end subroutine far_moments

    !> Double-exponential rule on both sides of the field point, `0 <= X < 1`.
    pure subroutine near_moments(x, cl, cr, m)
        real(wp), intent(in) :: x, cl, cr
        real(wp), intent(out) :: m(3)

        real(wp) :: side, y, q, u, delta, sl, sr, d, one_d, ker, f, m0, m1, m2
        integer :: j, k

        m = 0.0_wp
        side = x
        do k = 1, 2
            m0 = 0.0_wp
            m1 = 0.0_wp
            m2 = 0.0_wp
            !$omp simd private(y, q, u, delta, sl, sr, d, one_d, ker, f) reduction(+:m0, m1, m2)
            do j = 1, n_fold
                y = y_fold(j)
                q = y*(2.0_wp - y)
                delta = (1.0_wp - side)*q
                sl = sqrt(delta*delta + cl*cl)
                sr = sqrt(delta*delta + cr*cr)
                d = (cr - cl)*(1.0_wp + (cr + cl)/(sr + sl))/(cl + sl)
                one_d = 1.0_wp + d
                ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
                f = 1.0_wp + side + delta
                u = side + delta
                ker = ker*w_fold(j)/sqrt(f)
                m0 = m0 + f*(1.0_wp - y)**2*ker
                m1 = m1 + u*ker
                m2 = m2 + u*u*ker
            end do
            f = 2.0_wp*sqrt(1.0_wp - side)
            m(1) = m(1) + f*(1.0_wp - side)*m0
            if (k == 1) then
                m(2) = m(2) - f*m1
            else
                m(2) = m(2) + f*m1
            end if
            m(3) = m(3) + f*m2
            side = -side
        end do
    end subroutine near_moments

    !> Double-exponential rule from the near end, `X >= 1`.
    pure subroutine tip_moments(x, cl, cr, m)
        real(wp), intent(in) :: x, cl, cr
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
            u = 1.0_wp - 2.0_wp*q*q
            delta = x - 1.0_wp + 2.0_wp*q*q
            sl = sqrt(delta*delta + cl*cl)
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(1.0_wp + (cr + cl)/(sr + sl))/(cl + sl)
            one_d = 1.0_wp + d
            ker = log(one_d) + (d - (one_d - 1.0_wp))/one_d
            ker = ker*w_fold(j)/sqrt(1.0_wp + q)
            m0 = m0 + 4.0_wp*(q*(1.0_wp - y))**2*(1.0_wp + q)*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = 4.0_wp*m0
        m(2) = -4.0_wp*m1
        m(3) = 4.0_wp*m2
    end subroutine tip_moments
end module faststrip_influence_offcentre
