!> Complete elliptic integrals by the arithmetic-geometric mean.
!>
!> The argument is always the complementary parameter `m1 = 1 - m = 1 - k^2`, so that no digit is
!> lost as m approaches 1. The recurrences are Bulirsch's (`cel`, Numerische Mathematik 7, 1965,
!> and 13, 1969): sums of positive terms only, hence accurate to a few units in the last place for
!> any m1 > 0.
module faststrip_numerics_elliptic
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp, pi
    implicit none
    private

    public :: complete_elliptic, complete_elliptic_d

contains

    !> K(m) and E(m) of the first and second kind; NaN both for m1 <= 0 or not finite.
    pure elemental subroutine complete_elliptic(m1, k, e)
        real(wp), intent(in) :: m1 !! complementary parameter 1 - k^2, > 0 (in (0,1] for k real)
        real(wp), intent(out) :: k !! int_0^{pi/2} (1 - m sin^2)^(-1/2)
        real(wp), intent(out) :: e !! int_0^{pi/2} (1 - m sin^2)^(1/2)

        k = positive_integral(m1, 1.0_wp, 1.0_wp)
        e = positive_integral(m1, 1.0_wp, m1)
    end subroutine complete_elliptic

    !> D(m) = (K(m) - E(m))/m without the cancellation of the difference at small m; NaN for
    !> m1 <= 0 or not finite.
    pure elemental real(wp) function complete_elliptic_d(m1) result(d)
        real(wp), intent(in) :: m1 !! complementary parameter 1 - k^2, > 0

        d = positive_integral(m1, 0.0_wp, 1.0_wp)
    end function complete_elliptic_d

    !> int_0^{pi/2} (a cos^2 + b sin^2) / sqrt(cos^2 + m1 sin^2), a, b >= 0: Bulirsch's cel with
    !> p = 1. Each step squares the relative difference of the two means: the loop ends, within some
    !> twenty steps of the smallest m1, where the square is below rounding.
    pure elemental real(wp) function positive_integral(m1, a, b) result(value)
        real(wp), intent(in) :: m1, a, b

        real(wp), parameter :: close_enough = 0.5_wp*sqrt(epsilon(1.0_wp))
        real(wp) :: mean, geometric, product, ai, bi, p, previous, g

        value = ieee_value(value, ieee_quiet_nan)
        if (.not. ieee_is_finite(m1)) return
        if (m1 <= 0.0_wp) return
        mean = 1.0_wp
        geometric = sqrt(m1)
        product = geometric
        ai = a
        bi = b
        p = 1.0_wp
        do
            previous = ai
            ai = ai + bi/p
            g = product/p
            bi = 2.0_wp*(bi + previous*g)
            p = p + g
            g = mean
            mean = mean + geometric
            ! Also where numbers near the largest there are have overflowed.
            if (.not. abs(g - geometric) > close_enough*g) exit
            geometric = 2.0_wp*sqrt(product)
            product = geometric*mean
        end do
        value = 0.5_wp*pi*(bi + ai*mean)/(mean*(mean + p))
    end function positive_integral
end module faststrip_numerics_elliptic
