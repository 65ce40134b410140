!> The ranges of y that cells cover: at first where the bodies would overlap undeformed, then the
!> patches of the cells before and what overlaps beside them.
module faststrip_normal_cells_ranges
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, level_intervals
    use faststrip_normal_cells, only: cells_t, next_run
    use faststrip_normal_overlap, only: overlap_t, most_at_once, find_overlaps
    implicit none
    private

    public :: first_ranges, next_ranges

    ! Tuned [1]: between ranges, of the widest one: nearer ones are joined. Origin: chosen.
    real(wp), parameter :: finest_distance = 1.0e-3_wp

    !> Ranges of y: patches, and overlaps between them.
    type :: ranges_t
        integer :: n = 0 !! how many
        real(wp) :: from(2*most_at_once) = 0.0_wp, to(2*most_at_once) = 0.0_wp !! ends, mm
    end type ranges_t

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
        if (n == most_at_once) then
            do j = curve%n_pieces + 1, 2, -1
                if (curve%h_node(j) < level) exit
            end do
            n = 1
            cells%y_to(1) = curve%y_node(min(j + 1, curve%n_pieces + 1))
        end if
        cells%n_ranges = n
    end subroutine first_ranges

    !> The next ranges: the patches found, somewhat wider, and places beside them where the surfaces
    !> overlap.
    pure subroutine next_ranges(cells, curve, compliance, grow, at_rest)
        type(cells_t), intent(inout) :: cells
            !! with the pressures found; gets the ranges
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: grow           !! each way, in cells
        logical, intent(out) :: at_rest
            !! does nothing overlap, does no patch end with its range, and do most cells press?

        type(ranges_t) :: ranges
        type(overlap_t) :: overlaps(most_at_once)
        real(wp) :: wider(2, most_at_once) ! by which patches are to grow, mm
        integer :: i, m

        call take_patches(cells, curve, grow, ranges, wider, at_rest)
        m = ranges%n
        associate (n => cells%n)
            call find_overlaps(curve, compliance, cells%depth, cells%y_left(:n), &
                               cells%y_right(:n), cells%p0(:n), cells%half_length(:n), &
                               ranges%from(:m), ranges%to(:m), &
                               maxval(cells%y_right(:n) - cells%y_left(:n), &
                                      mask=cells%presses(:n)), overlaps)
            at_rest = at_rest .and. 2*count(cells%presses(:n)) >= n
        end associate
        ranges%from(:m) = max(curve%y(1), ranges%from(:m) - wider(1, :m))
        ranges%to(:m) = min(curve%y(curve%n), ranges%to(:m) + wider(2, :m))
        do i = 1, size(overlaps)
            if (overlaps(i)%deepest <= 0.0_wp) exit
            at_rest = .false.
            ranges%n = m + i
            ranges%from(m + i) = overlaps(i)%from
            ranges%to(m + i) = overlaps(i)%to
        end do
        call sort_ranges(ranges)
        call join_ranges(ranges, cells)
    end subroutine next_ranges

    !> The patches found, and by how much each is to grow: by a cell where it ends with its range.
    pure subroutine take_patches(cells, curve, grow, ranges, wider, at_rest)
        type(cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: grow ! elsewhere, in cells
        type(ranges_t), intent(inout) :: ranges
        real(wp), intent(inout) :: wider(:, :)
        logical, intent(out) :: at_rest ! does none end with its range?

        real(wp) :: width
        integer :: first, last
        logical :: cut_left, cut_right

        at_rest = .true.
        last = 0
        do while (ranges%n < most_at_once)
            call next_run(cells, first, last)
            if (first > cells%n) exit
            cut_left = first == 1
            if (first > 1) cut_left = cells%y_left(first) > cells%y_right(first - 1)
            cut_right = last == cells%n
            if (last < cells%n) cut_right = cells%y_left(last + 1) > cells%y_right(last)
            cut_left = cut_left .and. cells%y_left(first) > curve%y(1)
            cut_right = cut_right .and. cells%y_right(last) < curve%y(curve%n)
            at_rest = at_rest .and. .not. (cut_left .or. cut_right)
            ranges%n = ranges%n + 1
            width = cells%y_right(first) - cells%y_left(first)
            wider(1, ranges%n) = width*merge(1.0_wp, grow, cut_left)
            wider(2, ranges%n) = width*merge(1.0_wp, grow, cut_right)
            ranges%from(ranges%n) = cells%y_left(first)
            ranges%to(ranges%n) = cells%y_right(last)
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
                if (ranges%from(k) - cells%y_to(last) < finest .or. last == most_at_once) then
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
