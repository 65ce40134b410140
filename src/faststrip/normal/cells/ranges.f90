!> The ranges of y that cells cover: at first where the bodies would overlap undeformed, then the
!> patches of the cells before and what overlaps beside them.
module faststrip_normal_cells_ranges
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, level_intervals
    use faststrip_normal_cells, only: cells_t, next_run, max_ranges
    use faststrip_normal_cells_overlap, only: ranges_t, add_overlaps
    implicit none
    private

    public :: first_ranges, next_ranges

    ! Between ranges, of the widest one: nearer ones are joined.
    ! Tuned [1]: narrowest range, over the widest. Origin: chosen.
    real(wp), parameter :: finest_distance = 1.0e-3_wp

contains

    !> The first ranges are where the gap is below the penetration; one range from the first to the
    !> last if there are too many.
    pure subroutine first_ranges(cells, curve, depth)
        type(cells_t), intent(inout) :: cells !! gets the ranges
        type(gap_curve_t), intent(in) :: curve        !! a gap that was set
        real(wp), intent(in) :: depth                 !! penetration above the lowest height, mm

        real(wp) :: level
        integer :: n, j

        level = curve%h_lowest + depth
        call level_intervals(curve, level, cells%y_from, cells%y_to, n)
        if (n == max_ranges) then
            do j = curve%n_pieces + 1, 2, -1
                if (curve%h_node(j) < level) exit
            end do
            n = 1
            cells%y_to(1) = curve%y_node(min(j + 1, curve%n_pieces + 1))
        end if
        cells%n_ranges = n
    end subroutine first_ranges

    !> The next ranges: the patches found, somewhat wider, and places where the
    !> surfaces overlap.
    pure subroutine next_ranges(cells, curve, compliance, grow, overlap)
        type(cells_t), intent(inout) :: cells !! with the pressures found; gets the ranges
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: grow           !! each way, in cells
        real(wp), intent(out) :: overlap       !! deepest outside the patches, of the penetration

        type(ranges_t) :: ranges

        call take_patches(cells, curve, grow, ranges)
        call add_overlaps(cells, curve, compliance, ranges, overlap)
        call sort_ranges(ranges)
        call join_ranges(ranges, cells)
    end subroutine next_ranges

    !> The patches found, wider by some cells.
    pure subroutine take_patches(cells, curve, grow, ranges)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: grow
        type(ranges_t), intent(out) :: ranges

        integer :: first, last

        ranges%n = 0
        last = 0
        do while (ranges%n < max_ranges)
            call next_run(cells, first, last)
            if (first > cells%n) exit
            ranges%n = ranges%n + 1
            ranges%from(ranges%n) = max(curve%y(1), cells%y_left(first) &
                                        - grow*(cells%y_right(first) - cells%y_left(first)))
            ranges%to(ranges%n) = min(curve%y(curve%n), cells%y_right(last) &
                                      + grow*(cells%y_right(last) - cells%y_left(last)))
        end do
    end subroutine take_patches

    !> Into the order of y.
    pure subroutine sort_ranges(ranges)
        type(ranges_t), intent(inout) :: ranges

        integer :: k, j

        do k = 2, ranges%n
            j = k
            do while (j > 1)
                if (ranges%from(j - 1) <= ranges%from(j)) exit
                call exchange(ranges%from(j - 1), ranges%from(j))
                call exchange(ranges%to(j - 1), ranges%to(j))
                j = j - 1
            end do
        end do
    end subroutine sort_ranges

    !> Hand the ranges over, joined where they meet.
    pure subroutine join_ranges(ranges, cells)
        type(ranges_t), intent(in) :: ranges
        type(cells_t), intent(inout) :: cells

        real(wp) :: finest
        integer :: k, last

        finest = finest_distance*maxval(ranges%to(:ranges%n) - ranges%from(:ranges%n))
        cells%n_ranges = 0
        do k = 1, ranges%n
            last = cells%n_ranges
            if (last > 0) then
                if (ranges%from(k) - cells%y_to(last) < finest .or. last == max_ranges) then
                    cells%y_to(last) = max(cells%y_to(last), ranges%to(k))
                    cycle
                end if
            end if
            cells%n_ranges = last + 1
            cells%y_from(last + 1) = ranges%from(k)
            cells%y_to(last + 1) = ranges%to(k)
        end do
    end subroutine join_ranges

    pure subroutine exchange(a, b)
        real(wp), intent(inout) :: a, b

        real(wp) :: kept

        kept = a
        a = b
        b = kept
    end subroutine exchange
end module faststrip_normal_cells_ranges
