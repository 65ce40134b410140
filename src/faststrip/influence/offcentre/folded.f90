!> Off the centre line, field points on an edge: a double-exponential rule on both sides. With seven
!> digits squares at its last nodes, which count for nothing, underflow: they are held above zero.
module faststrip_influence_offcentre_folded
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_logarithm, only: log_1p
    implicit none
    private

    public :: folded_moments

    integer :: i_

    ! The folded double-exponential rule on [0,1]: abscissae y and weights.
    ! Tuned [nodes]: Number of nodes. Origin: chosen for the error at the least distances.
    integer, parameter :: n_fold = 160
    ! Spacing of the nodes before the transformation: the last abscissa is below the rounding of
    ! numbers as small as rounding's root.
    real(wp), parameter :: h_fold = asinh(-0.5_wp*log(epsilon(1.0_wp)**3))/(n_fold - 1)
    real(wp), parameter :: t_fold(n_fold) = [(h_fold*(i_ - 1), i_=1, n_fold)]
    real(wp), parameter :: y_fold(n_fold) = 2.0_wp/(1.0_wp + exp(sinh(t_fold) + t_fold))
    real(wp), parameter :: w_end(n_fold) = [0.5_wp, (1.0_wp, i_=2, n_fold)]
    real(wp), parameter :: w_fold(n_fold) = &
        w_end*h_fold*(cosh(t_fold) + 1.0_wp)*0.5_wp*y_fold*(2.0_wp - y_fold)

contains

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

        real(wp) :: y, u, delta, sl, sr, d, ker, f, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(y, u, delta, sl, sr, d, ker, f) reduction(+:m0, m1, m2)
        do j = 1, n_fold
            y = y_fold(j)
            delta = (1.0_wp - place)*(y*(2.0_wp - y))
            f = 1.0_wp + place + delta
            u = place + delta
            sl = sqrt(max(delta*delta + cl*cl, tiny(cl)))
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            ker = log_1p(d)
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

        real(wp) :: y, q, u, delta, sl, sr, d, ker, m0, m1, m2
        integer :: j

        m0 = 0.0_wp
        m1 = 0.0_wp
        m2 = 0.0_wp
        !$omp simd private(y, q, u, delta, sl, sr, d, ker) reduction(+:m0, m1, m2)
        do j = 1, n_fold
            y = y_fold(j)
            q = y*(2.0_wp - y)
            delta = 2.0_wp*q*q
            u = 1.0_wp - delta
            sl = sqrt(max(delta*delta + cl*cl, tiny(cl)))
            sr = sqrt(delta*delta + cr*cr)
            d = (cr - cl)*(sr + sl + cr + cl)/((sr + sl)*(cl + sl))
            ker = log_1p(d)
            ker = ker*w_fold(j)/sqrt(1.0_wp + q)
            m0 = m0 + (q*(1.0_wp - y))**2*(1.0_wp + q)*ker
            m1 = m1 + u*ker
            m2 = m2 + u*u*ker
        end do
        m(1) = 16.0_wp*m0 ! Given: of the transformation
        m(2) = -4.0_wp*m1
        m(3) = 4.0_wp*m2
    end subroutine fold_tip
end module faststrip_influence_offcentre_folded
