!> The gap between the deformed surfaces of a strip solution, sampled where the contact condition
!> was not asked for: `m`, `e` and `t` of `faststrip_normal_estimate_errors`.
module faststrip_normal_estimate_samples
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_influence_row, only: center_influence_column, influence_column_gradient
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, first_of_patch, last_of_patch
    use faststrip_normal_strip_state, only: flattest
    implicit none
    private

    public :: samples_t, take_samples, sample, sample_centre_line
    public :: block

    ! Tuned [strips]. Origin: capacity: what is kept on the stack.
    integer, parameter :: block = 32         !! strips sampled together

    !> Gaps in a block of strips, strip i of it from 1 on, and in the strips on both its sides.
    type :: samples_t
        real(wp), dimension(0:block + 1) :: left = 0.0_wp   ! on the centre line, at the left edge
        real(wp), dimension(0:block + 1) :: right = 0.0_wp  ! at the right edge
        real(wp), dimension(0:block + 1) :: middle = 0.0_wp ! in the middle of the strip
        real(wp), dimension(0:block + 1) :: tip = 0.0_wp    ! at the tip at the right edge
        real(wp), dimension(0:block + 1) :: tips = 0.0_wp   ! mean size of those at both edges
        real(wp), dimension(0:block + 1) :: inv2r = 0.0_wp  ! A in the middle of the strip
        real(wp), dimension(0:block + 1) :: inv2r_right = 0.0_wp ! A at the right edge
    end type samples_t

contains

    !> The gaps sampled in a block of strips, and in the strips before and behind it.
    pure subroutine take_samples(curve, compliance, strips, depth, from, samples, residual)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        integer, intent(in) :: from                  !! first strip of the block
        type(samples_t), intent(out) :: samples      !! the gaps over the depth
        real(wp), intent(inout) :: residual          !! raised to the largest |gap| of the block

        real(wp), dimension(block + 2) :: x, y, x_tip, gap, inv2r
        real(wp) :: y_edge(1), edge(1)
        integer :: first, last, low, high, k, n, to

        to = min(from + block - 1, strips%n)
        low = max(1, from - 1)
        high = min(strips%n, to + 1)
        n = high - low + 1
        first = first_of_patch(strips, low)
        last = last_of_patch(strips, low)
        do k = low, high
            if (k > last) then
                first = k
                last = last_of_patch(strips, first)
            end if
            associate (i => k - low + 1)
                y(i) = strips%y_right(k)
                x_tip(i) = 0.0_wp
                if (k < last) x_tip(i) = tip_between(strips, first, last, k)
            end associate
        end do
        call sample_centre_line(curve, compliance, strips, depth, y(:n), gap(:n))
        samples%right(low - from + 1:high - from + 1) = gap(:n)
        call sample(curve, compliance, strips, depth, x_tip(:n), y(:n), gap(:n), inv2r(:n))
        samples%tip(low - from + 1:high - from + 1) = gap(:n)
        samples%inv2r_right(low - from + 1:high - from + 1) = inv2r(:n)
        do k = low, high
            associate (i => k - low + 1)
                x(i) = sqrt(0.5_wp)*strips%half_length(k)
                y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            end associate
        end do
        call sample(curve, compliance, strips, depth, x(:n), y(:n), gap(:n), inv2r(:n))
        samples%middle(low - from + 1:high - from + 1) = gap(:n)
        samples%inv2r(low - from + 1:high - from + 1) = inv2r(:n)
        do k = low, high
            associate (i => k - from + 1)
                if (k == low .or. starts_patch(strips, k)) then
                    y_edge = strips%y_left(k)
                    call sample_centre_line(curve, compliance, strips, depth, y_edge, edge)
                    samples%left(i) = edge(1)
                    samples%tips(i) = 0.5_wp*(abs(edge(1)) + abs(samples%tip(i)))
                else
                    samples%left(i) = samples%right(i - 1)
                    samples%tips(i) = 0.5_wp*(abs(samples%tip(i - 1)) + abs(samples%tip(i)))
                end if
                if (k < from .or. k > to) cycle
                residual = max(residual, abs(samples%left(i)), abs(samples%right(i)), &
                               abs(samples%middle(i)), abs(samples%tip(i)))
            end associate
        end do
    end subroutine take_samples

    !> The gap between the deformed surfaces over the penetration, at any points, and A there.
    pure subroutine sample(curve, compliance, strips, depth, x, y, gap, inv2r)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        real(wp), intent(in) :: x(:), y(:)           !! at most `block` + 2 points, mm
        real(wp), intent(out) :: gap(:)              !! over the depth
        real(wp), intent(out) :: inv2r(:)            !! A, 1/mm

        real(wp), dimension(block + 2) :: influence, d_x, d_half_length
        real(wp) :: h
        integer :: s, i, m

        m = size(y)
        do i = 1, m
            call gap_at(curve, y(i), h, inv2r(i))
            inv2r(i) = min(max(inv2r(i), flattest), largest_size)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp + inv2r(i)*(x(i)*(x(i)/depth))
        end do
        do s = 1, strips%n
            ! Its derivatives are of no use here, but it is the fast one.
            call influence_column_gradient(strips%half_length(s), strips%y_left(s), &
                                           strips%y_right(s), x, y, influence(:m), d_x(:m), &
                                           d_half_length(:m))
            gap = gap + compliance*strips%p0(s)/depth*influence(:m)
        end do
    end subroutine sample

    !> The same on the centre line.
    pure subroutine sample_centre_line(curve, compliance, strips, depth, y, gap)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        real(wp), intent(in) :: y(:)                 !! at most `block` + 2 places, mm
        real(wp), intent(out) :: gap(:)              !! over the depth

        real(wp) :: influence(block + 2), h, inv2r
        integer :: s, i

        do i = 1, size(y)
            call gap_at(curve, y(i), h, inv2r)
            gap(i) = (h - curve%h_lowest)/depth - 1.0_wp
        end do
        do s = 1, strips%n
            call center_influence_column(strips%half_length(s), strips%y_left(s), &
                                         strips%y_right(s), y, influence(:size(y)))
            gap = gap + compliance*strips%p0(s)/depth*influence(:size(y))
        end do
    end subroutine sample_centre_line

    !> Half-length of the patch at the edge between strips k and k + 1.
    pure real(wp) function tip_between(strips, first, last, k) result(x)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last, k

        real(wp) :: low, high, square
        integer :: from

        from = min(max(k - 1, first - 1), last - 2)
        square = square_at(strips, strips%half_length, first, last, from, from + 3, first - 2, &
                           strips%y_right(k))
        ! A cubic through lengths that jump may leave them far behind.
        low = min(strips%half_length(k), strips%half_length(k + 1))
        high = max(strips%half_length(k), strips%half_length(k + 1))
        x = sqrt(min(max(square, 0.5_wp*low**2), 2.0_wp*high**2))
    end function tip_between

    !> The polynomial through the squares of a quantity at the middles of strips `from` to `to`,
    !> one left out; the ends of the patch, with the value zero, are strips first - 1 and last + 1.
    pure real(wp) function square_at(strips, quantity, first, last, from, to, left_out, y)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: quantity(:), y
        integer, intent(in) :: first, last, from, to, left_out

        real(wp) :: term
        integer :: i, j

        square_at = 0.0_wp
        do i = max(from, first), min(to, last)
            if (i == left_out) cycle
            term = quantity(i)**2
            do j = from, to
                if (j == i .or. j == left_out) cycle
                term = term*((y - node(strips, first, last, j)) &
                             /(node(strips, first, last, i) - node(strips, first, last, j)))
            end do
            square_at = square_at + term
        end do
    end function square_at

    !> Where strip i of a patch has its middle, or the patch its end.
    pure real(wp) function node(strips, first, last, i)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last, i

        if (i < first) then
            node = strips%y_left(first)
        else if (i > last) then
            node = strips%y_right(last)
        else
            node = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
        end if
    end function node
end module faststrip_normal_estimate_samples
