!> Where the deformed surfaces overlap outside what presses.
module faststrip_normal_cells_overlap
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, valley_below
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_normal_cells, only: cells_t, max_ranges
    implicit none
    private

    public :: ranges_t, add_overlaps, overlap_depth, overlap_tolerance, named_overlap

    !> Overlaps that are left, over the penetration: of cells as of strips.
    !> Tuned [1]. Origin: far below the errors of 15 strips.
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp
    !> Overlaps that are named, in rough gaps: `st_overlap_left`.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: named_overlap = 0.01_wp

    !> Ranges of y: patches, and overlaps between them.
    type :: ranges_t
        integer :: n = 0 !! how many
        real(wp) :: from(2*max_ranges) = 0.0_wp, to(2*max_ranges) = 0.0_wp !! ends, mm
    end type ranges_t

contains

    !> Add a range at each valley of the gap in which the surfaces overlap.
    pure subroutine add_overlaps(cells, curve, compliance, ranges, overlap)
        type(cells_t), intent(in) :: cells      !! with the pressures found
        type(gap_curve_t), intent(in) :: curve  !! a gap that was set
        real(wp), intent(in) :: compliance      !! H of eq. (4), 1/MPa
        type(ranges_t), intent(inout) :: ranges !! of the patches, in the order of y
        real(wp), intent(out) :: overlap        !! the deepest, over the penetration

        real(wp) :: depth, width, y
        integer :: j, n_patches

        overlap = 0.0_wp
        n_patches = ranges%n
        width = minval(cells%y_right(:cells%n) - cells%y_left(:cells%n))
        j = 1
        do
            j = valley_below(curve, curve%h_lowest + cells%depth, j + 1)
            if (j > curve%n_pieces .or. ranges%n == size(ranges%from)) return
            y = curve%y_node(j)
            if (any(ranges%from(:n_patches) <= y .and. ranges%to(:n_patches) >= y)) cycle
            associate (n => cells%n)
                depth = overlap_depth(curve, compliance, cells%depth, cells%y_left(:n), &
                                      cells%y_right(:n), cells%p0(:n), cells%half_length(:n), y)
            end associate
            if (depth <= overlap_tolerance*cells%depth) cycle
            overlap = max(overlap, depth/cells%depth)
            ranges%n = ranges%n + 1
            ranges%from(ranges%n) = max(curve%y(1), y - 0.5_wp*width)
            ranges%to(ranges%n) = min(curve%y(curve%n), y + 0.5_wp*width)
        end do
    end subroutine add_overlaps

    !> By how much the deformed surfaces overlap at a point outside the patches, mm; negative where
    !> they are apart, at least by that.
    pure real(wp) function overlap_depth(curve, compliance, penetration, y_left, y_right, p0, &
                                         half_length, y) result(depth)
        type(gap_curve_t), intent(in) :: curve         !! a gap that was set
        real(wp), intent(in) :: compliance             !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration            !! above the lowest height, mm
        real(wp), intent(in) :: y_left(:), y_right(:)  !! edges of strips, (n), mm
        real(wp), intent(in) :: p0(:), half_length(:)  !! their pressures, MPa, and lengths, mm, (n)
        real(wp), intent(in) :: y                      !! mm

        real(wp) :: h, inv2r, undeformed, displacement, least, width, middle
        integer :: s

        call gap_at(curve, y, h, inv2r)
        undeformed = penetration - (h - curve%h_lowest)
        depth = undeformed
        if (depth <= 0.0_wp) return
        ! Mostly a bound tells that there is no overlap: the mean of 1/r is not less than
        ! 1/sqrt(mean of r^2) (Jensen), and the mean of x^2 is xd^2/4, that of a width w^2/12.
        least = 0.0_wp
        do s = 1, size(p0)
            width = y_right(s) - y_left(s)
            middle = 0.5_wp*(y_left(s) + y_right(s)) - y
            ! Given: moment of a width
            least = least + p0(s)*half_length(s)*width &
                    /sqrt(0.25_wp*half_length(s)**2 + middle**2 + width**2/12.0_wp)
        end do
        depth = undeformed - 0.5_wp*pi*compliance*least
        if (depth <= 0.0_wp) return
        displacement = 0.0_wp
        do s = 1, size(p0)
            displacement = displacement + compliance*p0(s)*half_length(s) &
                           *strip_influence_edges((y_left(s) - y)/half_length(s), &
                                                  (y_right(s) - y)/half_length(s))
        end do
        depth = undeformed - displacement
    end function overlap_depth
end module faststrip_normal_cells_overlap
