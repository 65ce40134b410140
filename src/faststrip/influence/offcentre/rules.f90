!> Which rule the scalar procedures off the centre line take, for a value or for derivatives.
module faststrip_influence_offcentre_rules
    use faststrip_base_kinds, only: wp
    use faststrip_influence_angle_rules, only: exact, fine, far_limit, half_t, n_rules
    implicit none
    private

    public :: accuracy_t, for_value, for_gradient, least_far_rule, least_near_rule, interval

    !> Limits of the rules and forms that meet one accuracy.
    type :: accuracy_t
        real(wp) :: far(n_rules)  !! least sigma of each far rule
        real(wp) :: near(n_rules) !! largest half interval of each near rule
        integer :: last_far       !! largest far rule worth its price
        real(wp) :: thin          !! largest cr/(1 - |X|) of the series
        real(wp) :: tail          !! of the series, where it may be cut
        real(wp) :: loss          !! largest cr/(cr - cl) when primitives are subtracted
        real(wp) :: split         !! least cr for taking the logarithm apart
    end type accuracy_t

    ! Tuned [several]: Limits of the forms for values. Origin: chosen for time and errors of single
    ! values, 3e-16 (95 %; largest 2e-15); the order is that of accuracy_t. One at a time, at half
    ! and double: last_far takes 1.04 and 1.09 times as long, and at half errs by 4e-15; thin takes
    ! 1.08 and 0.94; tail and split change nothing; loss errs by 1e-15 and 6e-15.
    type(accuracy_t), parameter :: for_value = accuracy_t( &
        far_limit(:, exact), half_t(:, exact), 9, 0.1_wp, 1.0e-16_wp, 20.0_wp, 0.5_wp)
    ! Tuned [several]: Limits of the forms for derivatives. Origin: the same for derivatives, errors
    ! 7e-12, of d_x 4e-11. last_far takes 1.08 and 1.2 times as long, and at half errs by 2e-9; thin
    ! takes 1.09 and 0.96; tail errs by 2e-12 and 1e-11; loss and split change nothing.
    type(accuracy_t), parameter :: for_gradient = accuracy_t( &
        far_limit(:, fine), half_t(:, fine), 7, 0.2_wp, 1.0e-11_wp, 1.0e3_wp, 1.0e-3_wp)

contains

    !> The smallest trapezium rule in theta that is accurate enough; n_rules + 1 if none is.
    pure integer function least_far_rule(sigma, accuracy) result(rule)
        real(wp), intent(in) :: sigma
        type(accuracy_t), intent(in) :: accuracy

        do rule = 1, n_rules
            if (sigma >= accuracy%far(rule)) exit
        end do
    end function least_far_rule

    !> The smallest trapezium rule in phi that is accurate enough; the largest if none is.
    pure integer function least_near_rule(half, accuracy) result(rule)
        real(wp), intent(in) :: half
        type(accuracy_t), intent(in) :: accuracy

        do rule = 1, n_rules - 1
            if (half <= accuracy%near(rule)) exit
        end do
    end function least_near_rule

    !> Middle and half of the interval of t in which u = X + c sinh(t) goes from -1 to 1.
    pure subroutine interval(x, c, mid, half)
        real(wp), intent(in) :: x, c
        real(wp), intent(out) :: mid, half

        real(wp) :: t_left, t_right

        t_left = asinh(-(1.0_wp + x)/c)
        t_right = asinh((1.0_wp - x)/c)
        mid = 0.5_wp*(t_right + t_left)
        half = 0.5_wp*(t_right - t_left)
    end subroutine interval
end module faststrip_influence_offcentre_rules
