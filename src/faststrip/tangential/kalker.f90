!> Kalker's creepage coefficients of the linear theory, for any ellipse.
!>
!> With a along the rolling direction, G the combined shear modulus (conventions: forces on the
!> rail, creepage of the rail relative to the wheel):
!>
!>     Fx = -C11 G ab cksi
!>     Fy = -C22 G ab ceta - C23 G (ab)^1.5 cphi
!>     Mz =  C23 G (ab)^1.5 ceta - C33 G (ab)^2 cphi
module faststrip_tangential_kalker
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_ratio
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_material, st_not_finite, st_out_of_range
    use faststrip_tangential_kalker_table, only: n_ratios, n_poisson, table_poisson, &
                                                 table_log_ratio, table_log_value, table_slope
    implicit none
    private

    public :: kalker_coefficients_t, kalker_coefficients

    !> Coefficients of the linear theory; `C32 = -C23`.
    type :: kalker_coefficients_t
        real(wp) :: c11 = 0.0_wp !! longitudinal
        real(wp) :: c22 = 0.0_wp !! lateral
        real(wp) :: c23 = 0.0_wp !! lateral force by spin
        real(wp) :: c33 = 0.0_wp !! moment by spin
    end type kalker_coefficients_t

    ! Given: ln 4.
    real(wp), parameter :: ln_4 = 1.386294361119890618834464242916353136_wp
    real(wp), parameter :: ln_16 = 2.0_wp*ln_4

contains

    !> The coefficients at any a/b and nu.
    !>
    !> Inside the table (0.1 <= a/b <= 10; Kalker 1990, Table E3; C33: Kalker 1967) a cubic spline
    !> in ln C against ln(a/b), exact at the nodes. Outside, Kalker's asymptotic expressions times
    !> the misfit at the end of the table, which fades towards the limit: continuous with its first
    !> derivative across the ends. In nu the quadratic through 0, 0.25 and 0.5; there is no table
    !> below zero.
    pure subroutine kalker_coefficients(a_over_b, nu, coefficients, status)
        real(wp), intent(in) :: a_over_b !! semi-axis along x over semi-axis along y, 1e-12 to 1e12
        real(wp), intent(in) :: nu       !! combined Poisson's ratio, 0 to 0.5
        type(kalker_coefficients_t), intent(out) :: coefficients !! zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_not_finite`, `st_out_of_range` (a_over_b), `st_bad_material` (nu)

        real(wp) :: log_ratio, weight(n_poisson), c(4)

        call clear_status(status)
        if (.not. (ieee_is_finite(a_over_b) .and. ieee_is_finite(nu))) then
            call set_status(status, st_not_finite, "Kalker's coefficients from numbers that " // &
                            'are not finite: a/b ' // trim(number_text(a_over_b)) // ', nu ' // &
                            trim(number_text(nu)))
            return
        end if
        if (a_over_b < 1.0_wp/largest_ratio**2 .or. a_over_b > largest_ratio**2) then
            call set_status(status, st_out_of_range, "a/b must be 1e-12 to 1e12, got " // &
                            trim(number_text(a_over_b)))
            return
        end if
        if (nu < 0.0_wp .or. nu > 0.5_wp) then
            call set_status(status, st_bad_material, &
                            "Poisson's ratio must be 0 to 0.5, got " // &
                            trim(number_text(nu)))
            return
        end if

        log_ratio = log(a_over_b)
        weight = quadratic_weights(nu)
        if (log_ratio < table_log_ratio(1)) then
            c = outside(log_ratio, 1, weight)
        else if (log_ratio > table_log_ratio(n_ratios)) then
            c = outside(log_ratio, n_ratios, weight)
        else
            c = inside(log_ratio, weight)
        end if
        coefficients = kalker_coefficients_t(c(1), c(2), c(3), c(4))
    end subroutine kalker_coefficients

    !> Weights of the three nu of the table, Lagrange's quadratic.
    pure function quadratic_weights(nu) result(weight)
        real(wp), intent(in) :: nu
        real(wp) :: weight(n_poisson)
        real(wp) :: d1, d2, d3

        associate (p => table_poisson)
            d1 = nu - p(1)
            d2 = nu - p(2)
            d3 = nu - p(3)
            weight(1) = d2*d3/((p(1) - p(2))*(p(1) - p(3)))
            weight(2) = d1*d3/((p(2) - p(1))*(p(2) - p(3)))
            weight(3) = d1*d2/((p(3) - p(1))*(p(3) - p(2)))
        end associate
    end function quadratic_weights

    !> The spline through the table.
    pure function inside(log_ratio, weight) result(c)
        real(wp), intent(in) :: log_ratio, weight(n_poisson)
        real(wp) :: c(4)
        real(wp) :: h, t, s, left, right, left_slope, right_slope
        integer :: i, k

        i = min(max(count(table_log_ratio <= log_ratio), 1), n_ratios - 1)
        h = table_log_ratio(i + 1) - table_log_ratio(i)
        t = (log_ratio - table_log_ratio(i))/h
        s = 1.0_wp - t
        ! Hermite's form of the cubic.
        left = s*s*(1.0_wp + 2.0_wp*t)
        right = t*t*(1.0_wp + 2.0_wp*s)
        left_slope = h*t*s*s
        right_slope = -h*s*t*t
        ! No matmul: without optimization it allocates.
        c = 0.0_wp
        do k = 1, n_poisson
            c = c + weight(k)*exp(left*table_log_value(i, k, :) &
                                  + right*table_log_value(i + 1, k, :) &
                                  + left_slope*table_slope(i, k, :) &
                                  + right_slope*table_slope(i + 1, k, :))
        end do
    end function inside

    !> The asymptotes, led over into the end of the table.
    pure function outside(log_ratio, end_node, weight) result(c)
        real(wp), intent(in) :: log_ratio, weight(n_poisson)
        integer, intent(in) :: end_node !! 1 or `n_ratios`
        real(wp) :: c(4)
        real(wp) :: log_end, here(4), there(4), fading(4)
        integer :: k

        log_end = table_log_ratio(end_node)
        fading = exp(-abs(log_ratio - log_end))
        ! C11 and C22 of long ellipses are series in 1/ln, cut after the second term.
        if (log_ratio > 0.0_wp) then
            fading(1:2) = ((ln_16 + 2.0_wp*log_end)/(ln_16 + 2.0_wp*log_ratio))**2
        end if
        c = 0.0_wp
        do k = 1, n_poisson
            here = asymptotes(log_ratio, table_poisson(k))
            there = asymptotes(log_end, table_poisson(k))
            c = c + weight(k)*here*exp(fading*(table_log_value(end_node, k, :) - log(there)))
        end do
    end function outside

    !> Kalker's expressions for a/b -> 0 and a/b -> infinity (Kalker 1990, Table E3).
    pure function asymptotes(log_ratio, nu) result(c)
        real(wp), intent(in) :: log_ratio, nu
        real(wp) :: c(4)
        real(wp) :: g, lambda, q

        g = exp(-abs(log_ratio))
        lambda = ln_16 + 2.0_wp*abs(log_ratio)
        if (log_ratio < 0.0_wp) then
            c(1) = pi**2/(4.0_wp*(1.0_wp - nu))
            c(2) = pi**2/4.0_wp
            ! Given: Kalker's asymptotes
            c(3) = pi*sqrt(g)/(3.0_wp*(1.0_wp - nu))*(1.0_wp + nu*(0.5_wp*lambda + ln_4 - 5.0_wp))
            c(4) = pi**2/(16.0_wp*(1.0_wp - nu)*g) ! Given: Kalker's asymptotes
        else
            q = lambda - 2.0_wp*nu
            c(1) = 2.0_wp*pi/(g*q)*(1.0_wp + (3.0_wp - ln_4)/q)
            q = (1.0_wp - nu)*lambda + 2.0_wp*nu
            c(2) = 2.0_wp*pi/(g*q)*(1.0_wp + (1.0_wp - nu)*(3.0_wp - ln_4)/q)
            q = (1.0_wp - nu)*lambda - 2.0_wp + 4.0_wp*nu
            c(3) = 2.0_wp*pi/(3.0_wp*g*sqrt(g)*q)
            c(4) = 0.25_wp*pi*(1.0_wp - nu*(lambda - 2.0_wp)/q)
        end if
    end function asymptotes
end module faststrip_tangential_kalker
