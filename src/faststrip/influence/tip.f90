!> Columns of influence coefficients at the tips of strips, as many and as exact as an iteration
!> needs.
!>
!> The same integrals as in faststrip_influence_offcentre_column to a relative 3e-8, by
!> faststrip_influence_angle_sums with the accuracy `coarse`. What fits no rule goes to the scalar
!> procedure of faststrip_influence_offcentre.
module faststrip_influence_tip
    use faststrip_base_kinds, only: wp
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_angle_rules, only: coarse
    use faststrip_influence_angle_sums, only: angle_column
    implicit none
    private

    public :: tip_influence_column, tip_influence_column_gradient

    ! Tuned [points]: values of a column found together. Origin: capacity, on the stack.
    integer, parameter :: block = 64

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

        real(wp), dimension(block) :: d_x, d_half_length
        integer :: from, to

        do from = 1, size(y), block
            to = min(from + block - 1, size(y))
            call tip_influence_column_gradient(half_length, y_left, y_right, x(from:to), &
                                               y(from:to), value(from:to), d_x(:to - from + 1), &
                                               d_half_length(:to - from + 1), portable)
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

        integer :: found, k

        call angle_column(coarse, half_length, y_left, y_right, x, y, value, d_x, d_half_length, &
                          portable, found)
        if (found == 1) return
        do k = 1, size(y)
            if (value(k) > 0.0_wp) cycle
            call alone(half_length, y_left, y_right, x(k), y(k), value(k), d_x(k), d_half_length(k))
        end do
    end subroutine tip_influence_column_gradient

    !> One number that the lanes do not give.
    pure subroutine alone(half_length, y_left, y_right, x, y, value, d_x, d_half_length)
        real(wp), intent(in) :: half_length, y_left, y_right, x, y
        real(wp), intent(out) :: value, d_x, d_half_length

        real(wp) :: left, right
        logical :: own_tip

        left = y_left - y
        right = y_right - y
        own_tip = abs(x) >= half_length .and. abs(x) <= half_length &
                  .and. max(left, -right) < 0.0_wp .and. abs(left + right) &
                        <= 4.0_wp*epsilon(y)*(max(-left, right) + abs(y))
        call strip_influence_gradient(x, half_length, left, right, value, d_x, d_half_length)
        if (own_tip) then
            d_half_length = d_half_length + sign(d_x, d_x*x)
            d_x = 0.0_wp
        end if
    end subroutine alone
end module faststrip_influence_tip
