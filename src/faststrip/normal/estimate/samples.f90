!> The gap between the deformed surfaces of a strip solution, at any points.
module faststrip_normal_estimate_samples
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_influence_center_column, only: center_influence_column
    use faststrip_influence_tip, only: tip_influence_column
    use faststrip_normal_overlap, only: most_at_once
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_strip_state, only: flattest
    implicit none
    private

    public :: block, most_samples, sample, usable, part_end

    !> Strips looked at together.
    integer, parameter :: block = most_at_once
    !> Most points sampled together: both edges of each strip of a block.
    !> Given: of one strip at most.
    integer, parameter :: most_samples = 2*block

contains

    !> The gap between the deformed surfaces over the depth, on the centre line or at any x.
    pure subroutine sample(curve, compliance, strips, depth, y, gap, x)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! at which the strips close it, mm
        real(wp), intent(in) :: y(:)                 !! at most `most_samples`, mm
        real(wp), intent(out) :: gap(:)              !! over the depth
        real(wp), intent(in), optional :: x(:)       !! zero without it, mm

        real(wp) :: influence(most_samples), h, inv2r
        integer :: s, i, n

        n = size(y)
        do i = 1, n
            call gap_at(curve, y(i), h, inv2r)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp
            if (present(x)) gap(i) = gap(i) + usable(inv2r)*(x(i)*(x(i)/depth))
        end do
        do s = 1, strips%n
            if (present(x)) then
                call tip_influence_column(strips%half_length(s), strips%y_left(s), &
                                          strips%y_right(s), x, y, influence(:n))
            else
                call center_influence_column(strips%half_length(s), strips%y_left(s), &
                                             strips%y_right(s), y, influence(:n))
            end if
            gap(:n) = gap(:n) + compliance*strips%p0(s)/depth*influence(:n)
        end do
    end subroutine sample

    !> A as the strips' equations take it.
    elemental real(wp) function usable(inv2r)
        real(wp), intent(in) :: inv2r !! 1/mm

        usable = min(max(inv2r, flattest), largest_size)
    end function usable

    !> Where part i of n things ends that are cut into so many parts, counted from both ends: in a
    !> mirror the parts are the same.
    elemental integer function part_end(i, parts, n)
        integer, intent(in) :: i, parts, n !! 0 to parts; 1 to n; at least 1

        part_end = merge((i*n)/parts, n - ((parts - i)*n)/parts, 2*i <= parts)
    end function part_end
end module faststrip_normal_estimate_samples
