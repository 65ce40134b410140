!> Columns of influence coefficients at points anywhere.
!>
!> What has no rule with constant nodes (faststrip_influence_angle_sums) goes to the scalar
!> procedures of faststrip_influence_offcentre.
module faststrip_influence_offcentre_column
    use faststrip_base_kinds, only: wp
    use faststrip_influence_angle_rules, only: fine
    use faststrip_influence_angle_sums, only: angle_column
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_plain_sizes, only: is_plain
    implicit none
    private

    public :: influence_column_gradient

contains

    !> Influence of a strip on any points, and its derivatives as in `strip_influence_gradient`;
    !> relative error 1e-10, of d_x relative to I/xd where that is larger.
    pure subroutine influence_column_gradient(half_length, y_left, y_right, x, y, value, d_x, &
                                              d_half_length, portable)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: x(:)              !! field points along the strip, (n), mm
        real(wp), intent(in) :: y(:)              !! field points across, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_x(:)           !! dI/dx, (n)
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        integer :: found, k

        call angle_column(fine, half_length, y_left, y_right, x, y, value, d_x, d_half_length, &
                          portable, found)
        if (found == 1) return
        do k = 1, size(y)
            if (value(k) > 0.0_wp) cycle
            call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                          value(k), d_x(k), d_half_length(k))
        end do
    end subroutine influence_column_gradient
end module faststrip_influence_offcentre_column
