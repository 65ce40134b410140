!> Columns of influence coefficients at points anywhere.
!>
!> What has no rule with constant nodes (faststrip_influence_angle_sums) goes to the scalar
!> procedures of faststrip_influence_offcentre.
module faststrip_influence_offcentre_column
    use faststrip_base_kinds, only: wp
    use faststrip_influence_angle_rules, only: fine
    use faststrip_influence_angle_sums, only: angle_moments
    use faststrip_influence_four_lanes, only: are_lanes_wanted
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_plain_sizes, only: is_plain
    implicit none
    private

    public :: influence_column_at, influence_column_gradient

contains

    !> Influence of a strip on any points; `strip_influence_at` for each.
    pure subroutine influence_column_at(half_length, y_left, y_right, x, y, value)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: x(:)        !! field points along the strip, (n), mm
        real(wp), intent(in) :: y(:)        !! field points across, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm

        real(wp) :: d_x, d_half_length
        integer :: k
        logical :: plain

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        do k = 1, size(y)
            if (plain .and. is_plain(1.0_wp, abs(x(k))) .and. is_plain(1.0_wp, abs(y(k)))) then
                value(k) = half_length*strip_influence_at(x(k)/half_length, &
                                                          (y_left - y(k))/half_length, &
                                                          (y_right - y(k))/half_length)
            else
                call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                              value(k), d_x, d_half_length)
            end if
        end do
    end subroutine influence_column_at

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

        real(wp) :: per_length, xs, cl, cr, m(3)
        integer :: k
        logical :: plain, found, by_lanes

        plain = is_plain(half_length, abs(y_left)) .and. is_plain(1.0_wp, abs(y_right))
        per_length = 0.0_wp
        if (plain) per_length = 1.0_wp/half_length
        by_lanes = are_lanes_wanted(portable)
        do k = 1, size(y)
            found = .false.
            if (plain .and. is_plain(1.0_wp, abs(x(k))) .and. is_plain(1.0_wp, abs(y(k)))) then
                xs = abs(x(k))*per_length
                cl = (y_left - y(k))*per_length
                cr = (y_right - y(k))*per_length
                if (cl + cr < 0.0_wp) then
                    m(1) = -cl
                    cl = -cr
                    cr = m(1)
                end if
                if (xs > 0.0_wp) call angle_moments(fine, by_lanes, xs, cl, cr, m, found)
            end if
            if (found) then
                value(k) = half_length*m(1)
                d_x(k) = sign(1.0_wp, x(k))*m(2)
                d_half_length(k) = m(3)
            else
                call strip_influence_gradient(x(k), half_length, y_left - y(k), y_right - y(k), &
                                              value(k), d_x(k), d_half_length(k))
            end if
        end do
    end subroutine influence_column_gradient
end module faststrip_influence_offcentre_column
