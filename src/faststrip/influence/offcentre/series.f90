!> Off the centre line, thin strips well inside the ends: the series in powers of c.
module faststrip_influence_offcentre_series
    use faststrip_base_kinds, only: wp
    use faststrip_influence_offcentre_rules, only: for_value, for_gradient
    implicit none
    private

    public :: series_moments

    integer :: k_

    ! Given: ln 2.
    real(wp), parameter :: log_2 = 0.693147180559945309417232121458176568_wp
    ! Most terms of the series: those that both accuracies need at their largest ratio.
    integer, parameter :: max_terms = &
        2 + ceiling(max(log(for_value%tail)/(2.0_wp*log(for_value%thin)), &
                        log(for_gradient%tail)/(2.0_wp*log(for_gradient%thin))))
    ! The series in c: 1/(2k + 1), 1/k, ratio of successive factors.
    real(wp), parameter :: inverse_odd(0:max_terms) = [(1.0_wp/(2*k_ + 1), k_=0, max_terms)]
    real(wp), parameter :: reciprocal(max_terms) = [(1.0_wp/k_, k_=1, max_terms)]
    real(wp), parameter :: series_step(0:max_terms) = [(-0.25_wp/(k_ + 1)**2, k_=0, max_terms)]

contains

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
end module faststrip_influence_offcentre_series
