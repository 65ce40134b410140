!> The derivative of a strip's influence with respect to an edge, off the centre line.
module faststrip_influence_offcentre_slope
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan, &
                                             ieee_positive_inf
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: beyond_all, smallest_size
    use faststrip_influence_angle_rules, only: cosine, sine, rule_size, rule_start
    use faststrip_influence_offcentre_rules, only: for_value, interval, least_far_rule, &
                                                   least_near_rule
    implicit none
    private

    public :: strip_influence_edge_slope

    ! Given: ln 2.
    real(wp), parameter :: log_2 = 0.693147180559945309417232121458176568_wp
    ! The slope's series may be cut after one term below this c/(1 - |X|).
    real(wp), parameter :: small_ratio = sqrt(epsilon(1.0_wp))

contains

    !> dG(X,c)/dc = int sqrt(1 - u^2)/sqrt((u - X)^2 + c^2) du: the derivative of a strip's
    !> influence (mm) with respect to its right edge (mm), and less that with respect to its left
    !> edge. Even in both arguments; +Inf for c = 0 inside the strip, NaN for what is not finite.
    !> Relative error 1e-13.
    !>
    !> Elliptic; with `u = X + c sinh(t)` it is `int sqrt(1 - u^2) dt`, which the rules of the far
    !> and of the near field integrate as they stand, without the cancellation that Legendre's
    !> integrals of three kinds have near X = 0.
    pure real(wp) function strip_influence_edge_slope(x, c) result(slope)
        real(wp), intent(in) :: x !! X, field point along the strip over the half-length
        real(wp), intent(in) :: c !! edge less the field point's y over the half-length

        real(wp) :: xs, cs, sigma, rest

        if (.not. (ieee_is_finite(x) .and. ieee_is_finite(c))) then
            slope = ieee_value(slope, ieee_quiet_nan)
            return
        end if
        xs = abs(x)
        cs = abs(c)
        rest = abs(1.0_wp - xs)
        if (max(xs, cs) > beyond_all) then
            slope = 0.5_wp*pi/max(xs, cs)/sqrt(1.0_wp + (min(xs, cs)/max(xs, cs))**2)
            return
        end if
        sigma = 0.5_wp*(sqrt((xs - 1.0_wp)**2 + cs*cs) + sqrt((xs + 1.0_wp)**2 + cs*cs))
        if (sigma >= for_value%far(for_value%last_far)) then
            slope = far_slope(xs, cs, least_far_rule(sigma, for_value))
        else if (xs < 1.0_wp .and. cs <= small_ratio*rest) then
            slope = thin_slope(xs, cs)
        else if (cs <= smallest_size) then
            ! The edge is on the field point.
            slope = pi*(xs - sqrt((xs - 1.0_wp)*(xs + 1.0_wp)))
        else
            slope = near_slope(xs, cs)
        end if
    end function strip_influence_edge_slope

    !> Trapezium rule in theta.
    pure real(wp) function far_slope(x, c, rule) result(slope)
        real(wp), intent(in) :: x, c
        integer, intent(in) :: rule

        integer :: j

        slope = 0.0_wp
        do j = rule_start(rule), rule_start(rule) + rule_size(rule) - 1
            slope = slope + sine(j)**2/sqrt((cosine(j) - x)**2 + c*c)
        end do
        slope = pi/rule_size(rule)*slope
    end function far_slope

    !> The first term of the series in c, 0 <= X < 1.
    pure real(wp) function thin_slope(x, c) result(slope)
        real(wp), intent(in) :: x, c

        real(wp) :: w

        if (c > 0.0_wp) then
            w = (1.0_wp - x)*(1.0_wp + x)
            slope = sqrt(w)*(4.0_wp*log_2 - 2.0_wp + 2.0_wp*(log(w) - log(c))) &
                    + 2.0_wp*x*asin(x)
        else
            slope = ieee_value(slope, ieee_positive_inf)
        end if
    end function thin_slope

    !> Trapezium rule in phi, t = mid + half cos(phi): with the ends u = -1 and 1 in sin(phi), what
    !> is left is singular at Im t = +-pi.
    pure real(wp) function near_slope(x, c) result(slope)
        real(wp), intent(in) :: x, c

        real(wp) :: mid, half, delta
        integer :: rule, j

        call interval(x, c, mid, half)
        rule = least_near_rule(0.5_wp*half, for_value)
        slope = 0.0_wp
        do j = rule_start(rule), rule_start(rule) + rule_size(rule) - 1
            delta = c*sinh(mid + half*cosine(j))
            slope = slope + sine(j)*sqrt(max(0.0_wp, ((1.0_wp - x) - delta)*((1.0_wp + x) + delta)))
        end do
        slope = pi/rule_size(rule)*half*slope
    end function near_slope
end module faststrip_influence_offcentre_slope
