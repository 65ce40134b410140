!> Columns of influence coefficients at the tips of strips, as many and as exact as an iteration
!> needs.
!>
!> The same integrals as in faststrip_influence_row to a relative 3e-8, by
!> faststrip_influence_angle_sums with the accuracy `coarse`. What fits no rule goes to the scalar
!> procedure of faststrip_influence_offcentre.
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
    use faststrip_influence_angle_rules, only: coarse
    use faststrip_influence_angle_sums, only: angle_moments
    use faststrip_influence_four_lanes, only: are_lanes_wanted
    use faststrip_influence_plain_sizes, only: least_plain, largest_plain
    implicit none
    private

    public :: tip_influence_column, tip_influence_column_gradient

    integer :: k_

    ! The series of a strip's own tip, up to a largest kappa.
    ! Tuned [1]. Origin: chosen: strips of a patch seldom pass it; errors of 4e-12 there.
    real(wp), parameter :: own_kappa = 0.35_wp
    ! Its last power: of half of the digits.
    integer, parameter :: last_own = ceiling(0.5_wp*log(epsilon(1.0_wp))/log(own_kappa))
    ! Given: the binomial series.
    real(wp), parameter :: own(0:last_own) = &
        [((-1.0_wp)**k_*gamma(1.5_wp)/(gamma(k_ + 1.0_wp)*gamma(1.5_wp - k_)) &
          *gamma(-0.5_wp*k_ - 0.25_wp)*gamma(0.5_wp*k_ + 0.75_wp)/sqrt(pi), k_=0, last_own)]

contains

    !> Influence of a strip on the tips of others and on its own; relative error below 1e-7.
    pure subroutine tip_influence_column(half_length, y_left, y_right, x, y, value, portable)
        real(wp), intent(in) :: half_length !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: x(:)        !! field points along the strip, (n), mm, finite
        real(wp), intent(in) :: y(:)        !! field points across, (n), mm, finite
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        real(wp) :: m(3)
        integer :: k
        logical :: by_lanes

        by_lanes = are_lanes_wanted(portable)
        do k = 1, size(y)
            call entry(by_lanes, half_length, y_left, y_right, x(k), y(k), m)
            value(k) = m(1)
        end do
    end subroutine tip_influence_column

    !> The same and its derivatives as in `strip_influence_gradient`. At the strip's own tip the tip
    !> moves with the half-length: d_half_length is the derivative of both, d_x is 0.
    pure subroutine tip_influence_column_gradient(half_length, y_left, y_right, x, y, value, d_x, &
                                                  d_half_length, portable)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: x(:)              !! field points along the strip, (n), mm, finite
        real(wp), intent(in) :: y(:)              !! field points across, (n), mm, finite
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_x(:)           !! dI/dx, (n)
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        real(wp) :: m(3)
        integer :: k
        logical :: by_lanes

        by_lanes = are_lanes_wanted(portable)
        do k = 1, size(y)
            call entry(by_lanes, half_length, y_left, y_right, x(k), y(k), m)
            value(k) = m(1)
            d_x(k) = m(2)
            d_half_length(k) = m(3)
        end do
    end subroutine tip_influence_column_gradient

    !> One number: value, and its derivatives in x and in the half-length if asked for.
    pure subroutine entry(by_lanes, half_length, y_left, y_right, x, y, m)
        logical, intent(in) :: by_lanes
        real(wp), intent(in) :: half_length, y_left, y_right, x, y
        real(wp), intent(out) :: m(3)

        real(wp) :: per_length, xs, cl, cr, other
        logical :: found, own_tip

        found = .false.
        own_tip = .false.
        if (min(half_length, abs(x)) > least_plain &
            .and. max(half_length, abs(x), abs(y_left), abs(y_right), abs(y)) < largest_plain) then
            per_length = 1.0_wp/half_length
            xs = abs(x)*per_length
            cl = (y_left - y)*per_length
            cr = (y_right - y)*per_length
            if (cl + cr < 0.0_wp) then
                other = -cl
                cl = -cr
                cr = other
            end if
            call angle_moments(coarse, by_lanes, xs, cl, cr, m, found)
            if (abs(x) >= half_length .and. abs(x) <= half_length) then
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
            primitive = primitive*kappa + own(k)/(k + 1.5_wp) ! Given: integral of a power
        end do
        root = sqrt(kappa)
        m(1) = 4.0_wp*kappa*(pi + root*primitive)
        m(2) = 0.0_wp
        m(3) = m(1) - 4.0_wp*kappa*(pi + root*slope)
    end subroutine own_tip_series
end module faststrip_influence_tip
