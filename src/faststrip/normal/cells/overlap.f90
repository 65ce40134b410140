!> Where the deformed surfaces overlap outside the cells that press.
module faststrip_normal_cells_overlap
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_influence_row, only: center_influence_column
    use faststrip_normal_cells, only: cells_t, max_ranges, same
    implicit none
    private

    public :: ranges_t, add_overlaps, overlap_tolerance, named_overlap

    !> Overlaps that are left, over the penetration: of cells as of strips.
    !> Tuned [1]. Origin: far below the errors of 15 strips.
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp
    !> Overlaps that are named, in rough gaps: `st_overlap_left`.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: named_overlap = 0.01_wp
    ! Tuned [points]. Origin: capacity: what is kept on the stack.
    integer, parameter :: block = 64                     ! points evaluated together

    !> Ranges of y: patches, and overlaps between them.
    type :: ranges_t
        integer :: n = 0 !! how many
        real(wp) :: from(2*max_ranges) = 0.0_wp, to(2*max_ranges) = 0.0_wp !! ends, mm
    end type ranges_t

contains

    !> Add a range around the deepest overlap of each stretch outside the strips that press.
    pure subroutine add_overlaps(cells, curve, compliance, depth, ranges, overlap)
        type(cells_t), intent(in) :: cells !! with the pressures found
        type(gap_curve_t), intent(in) :: curve     !! a gap that was set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth              !! penetration above the lowest height, mm
        type(ranges_t), intent(inout) :: ranges    !! of the patches, in the order of y
        real(wp), intent(out) :: overlap           !! the deepest, over the penetration

        type(ranges_t) :: solved
        real(wp) :: low, high, widest
        integer :: r

        overlap = 0.0_wp
        solved = ranges
        widest = maxval(solved%to(:solved%n) - solved%from(:solved%n))
        low = curve%y(1)
        do r = 1, solved%n + 1
            high = curve%y(curve%n)
            if (r <= solved%n) high = solved%from(r)
            if (high - low > same*widest .and. ranges%n < size(ranges%from)) &
                call add_overlap(cells, curve, compliance, depth, low, high, ranges, overlap)
            if (r <= solved%n) low = max(low, solved%to(r))
        end do
    end subroutine add_overlaps

    !> The same for one stretch; nothing is added if the overlap is too small to count.
    pure subroutine add_overlap(cells, curve, compliance, depth, low, high, ranges, overlap)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, low, high
        type(ranges_t), intent(inout) :: ranges
        real(wp), intent(inout) :: overlap

        real(wp) :: deepest, y_deepest, y_low, y_high

        call find_deepest(cells, curve, compliance, depth, low, high, deepest, y_deepest)
        if (y_deepest <= low) return
        overlap = max(overlap, deepest/depth)
        y_low = edge_of_overlap(cells, curve, compliance, depth, low, high, y_deepest, -1.0_wp)
        y_high = edge_of_overlap(cells, curve, compliance, depth, low, high, y_deepest, 1.0_wp)
        ! Patches on both sides close it by themselves, or meet.
        if (y_low <= low .and. y_high >= high .and. low > curve%y(1) &
            .and. high < curve%y(curve%n)) return
        ranges%n = ranges%n + 1
        ranges%from(ranges%n) = y_low
        ranges%to(ranges%n) = y_high
    end subroutine add_overlap

    !> The deepest overlap of a stretch, among the valleys of the curve in it and even points.
    pure subroutine find_deepest(cells, curve, compliance, depth, low, high, deepest, y_deepest)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, low, high
        real(wp), intent(out) :: deepest   ! mm
        real(wp), intent(out) :: y_deepest ! `low` if none is deeper than the tolerance

        ! Tuned [points]: looked at at a time. Origin: chosen: several in each cell of the widest
        ! stretch between ranges.
        integer, parameter :: n_even = 32
        real(wp) :: y(block)
        integer :: j, n

        deepest = overlap_tolerance*depth
        y_deepest = low
        n = 0
        do j = first_node_above(curve, low), curve%n_pieces
            if (curve%y_node(j) >= high) exit
            if (curve%h_node(j) - curve%h_lowest >= depth - deepest) cycle
            if (curve%h_node(j) > min(curve%h_node(j - 1), curve%h_node(j + 1))) cycle
            n = n + 1
            y(n) = curve%y_node(j)
            if (n < block) cycle
            call take_deepest(cells, curve, compliance, depth, y, deepest, y_deepest)
            n = 0
        end do
        do j = 1, n_even
            n = n + 1
            y(n) = low + (high - low)*(j - 0.5_wp)/n_even
            if (n < block) cycle
            call take_deepest(cells, curve, compliance, depth, y, deepest, y_deepest)
            n = 0
        end do
        if (n > 0) call take_deepest(cells, curve, compliance, depth, y(:n), deepest, y_deepest)
    end subroutine find_deepest

    !> Take the deepest overlap at some points, if it is deeper than what was found before.
    pure subroutine take_deepest(cells, curve, compliance, depth, y, deepest, y_deepest)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, y(:)
        real(wp), intent(inout) :: deepest, y_deepest

        real(wp) :: here(block)
        integer :: i

        call find_overlaps(cells, curve, compliance, depth, y, here(:size(y)))
        i = maxloc(here(:size(y)), dim=1)
        if (here(i) <= deepest) return
        deepest = here(i)
        y_deepest = y(i)
    end subroutine take_deepest

    !> The first inner end of the curve's monotone pieces to the right of a position.
    pure integer function first_node_above(curve, y) result(node)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y

        integer :: below, middle

        below = 1
        node = curve%n_pieces + 1
        do while (node - below > 1)
            middle = (below + node)/2
            if (curve%y_node(middle) <= y) then
                below = middle
            else
                node = middle
            end if
        end do
    end function first_node_above

    !> Where an overlap ends, found within a factor of two.
    pure real(wp) function edge_of_overlap(cells, curve, compliance, depth, low, high, y_deepest, &
                                           direction) result(y_edge)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, low, high, y_deepest
        real(wp), intent(in) :: direction ! -1: to the left, 1: to the right

        real(wp) :: reach, y(1), overlap(1)
        ! Tuned [halvings]: of the reach in which the edge is sought. Origin: chosen.
        integer, parameter :: max_reaches = 20
        integer :: i

        reach = max(high - y_deepest, y_deepest - low)
        do i = 1, max_reaches
            y(1) = min(max(y_deepest + direction*reach, low), high)
            call find_overlaps(cells, curve, compliance, depth, y, overlap)
            if (overlap(1) > 0.0_wp) exit
            reach = 0.5_wp*reach
        end do
        y_edge = y(1)
    end function edge_of_overlap

    !> By how much the deformed surfaces overlap, mm; less than zero: the gap.
    pure subroutine find_overlaps(cells, curve, compliance, depth, y, overlap)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, y(:)
        real(wp), intent(out) :: overlap(:)

        real(wp) :: h, inv2r, influence(block)
        integer :: i, s

        do i = 1, size(y)
            call gap_at(curve, y(i), h, inv2r)
            overlap(i) = depth - (h - curve%h_lowest)
        end do
        do s = 1, cells%n
            if (.not. cells%presses(s)) cycle
            call center_influence_column(cells%half_length(s), cells%y_left(s), &
                                         cells%y_right(s), y, influence(:size(y)))
            overlap = overlap - compliance*cells%p0(s)*influence(:size(y))
        end do
    end subroutine find_overlaps
end module faststrip_normal_cells_overlap
