!> Where a lattice starts, and the ranges of y that it covers: at first where the bodies would
!> overlap undeformed at the penetration that a load is likely to need, then the patches of the
!> lattice before and what overlaps beside them.
module faststrip_normal_cells_ranges
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_geometry_gap_curve, only: gap_curve_t, level_intervals
    use faststrip_normal_cells, only: lattice_cells_t, max_ranges
    use faststrip_normal_cells_overlap, only: ranges_t, add_overlaps
    implicit none
    private

    public :: start_depth, first_ranges, next_ranges

    ! Between ranges, of the widest one: nearer ones are joined.
    ! Tuned [1]: narrowest range, over the widest. Origin: chosen.
    real(wp), parameter :: finest_distance = 1.0e-3_wp
    ! Tuned [1]. Origin: virtual penetration of a Hertz contact (Piotrowski and Kik).
    real(wp), parameter :: start_level = 0.55_wp     ! of the penetration: virtual penetration
    ! Tuned [1]. Origin: a round contact between plane strain and a needle.
    real(wp), parameter :: start_factor = 0.6_wp     ! of the plane-strain pressure

contains

    !> Penetration, above the lowest height, at which pressures of 0.6 of the plane-strain one
    !> where the gap is below 0.55 D carry the load.
    pure subroutine start_depth(curve, compliance, load, depth)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load           !! N
        real(wp), intent(out) :: depth         !! mm

        ! Tuned [1]: Range of the search to either side. Origin: safeguard: all loads that can be
        ! solved.
        real(wp), parameter :: reach_of_search = 2.0_wp**200
        real(wp) :: low, high, unit
        integer :: i

        ! In a length of the case's own, with which the unit of length does not matter.
        unit = sqrt(compliance*load)
        low = unit/reach_of_search
        high = unit*reach_of_search
        do i = 1, most_steps
            depth = low*sqrt(high/low)
            if (start_load(curve, compliance, depth) < load) then
                low = depth
            else
                high = depth
            end if
            if (high - low <= 2.0_wp*epsilon(1.0_wp)*low) exit
        end do
    end subroutine start_depth

    !> That load; a gap straight between the ends of its monotone pieces lets it rise evenly, so
    !> that one penetration belongs to it.
    pure real(wp) function start_load(curve, compliance, depth) result(load)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth

        real(wp) :: level, low, high, width
        integer :: j

        level = start_level*depth
        load = 0.0_wp
        do j = 1, curve%n_pieces
            width = curve%y_node(j + 1) - curve%y_node(j)
            low = min(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            high = max(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            if (level >= high) then
                load = load + width*(level - 0.5_wp*(low + high))
            else if (level > low) then
                load = load + width*((level - low)*(0.5_wp*((level - low)/(high - low))))
            end if
        end do
        load = start_factor*(load/compliance)
    end function start_load

    !> The first ranges are where the gap is below the penetration; one range from the first to the
    !> last if there are too many.
    pure subroutine first_ranges(cells, curve, depth)
        type(lattice_cells_t), intent(inout) :: cells !! gets the ranges
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

    !> The ranges of the next lattice: the patches found, somewhat wider, and places where the
    !> surfaces overlap.
    pure subroutine next_ranges(cells, curve, compliance, depth, grow, overlap)
        type(lattice_cells_t), intent(inout) :: cells !! with the pressures found; gets the ranges
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth          !! penetration above the lowest height, mm
        real(wp), intent(in) :: grow           !! each way, in cells
        real(wp), intent(out) :: overlap       !! deepest outside the patches, of the penetration

        type(ranges_t) :: ranges

        call take_patches(cells, curve, grow, ranges)
        call add_overlaps(cells, curve, compliance, depth, ranges, overlap)
        call sort_ranges(ranges)
        call join_ranges(ranges, cells)
    end subroutine next_ranges

    !> The patches found, wider by some cells.
    pure subroutine take_patches(cells, curve, grow, ranges)
        type(lattice_cells_t), intent(in) :: cells
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: grow
        type(ranges_t), intent(out) :: ranges

        integer :: first, last, m

        m = 0
        last = 0
        do
            first = last + 1
            do while (first <= cells%n)
                if (cells%presses(first)) exit
                first = first + 1
            end do
            if (first > cells%n .or. m == max_ranges) exit
            last = first
            do while (last < cells%n)
                if (.not. cells%presses(last + 1) &
                    .or. cells%y_left(last + 1) > cells%y_right(last)) exit
                last = last + 1
            end do
            m = m + 1
            ranges%from(m) = max(curve%y(1), cells%y_left(first) &
                                 - grow*(cells%y_right(first) - cells%y_left(first)))
            ranges%to(m) = min(curve%y(curve%n), cells%y_right(last) &
                               + grow*(cells%y_right(last) - cells%y_left(last)))
        end do
        ranges%n = m
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
        type(lattice_cells_t), intent(inout) :: cells

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
