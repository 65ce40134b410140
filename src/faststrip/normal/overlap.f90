!> Where the deformed surfaces overlap beside strips, or cells, that press.
module faststrip_normal_overlap
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, gap_slopes, &
                                            level_intervals, valley_below
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, ends_patch
    implicit none
    private

    public :: overlap_t, most_at_once, find_overlaps, overlap_outside
    public :: overlap_tolerance, named_overlap

    !> Overlaps that are left, over the penetration: of cells as of strips.
    !> Tuned [1]. Origin: far below the errors of 15 strips.
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp
    !> Overlaps that are named, in rough gaps: `st_overlap_left`.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: named_overlap = 0.01_wp

    !> Most ranges of y that press, and most that overlap, points scanned in one stretch outside the
    !> patches, and strips whose samples are taken, at a time.
    !> Tuned [ranges; points; strips]. Origin: capacity, on the stack.
    integer, parameter :: most_at_once = 64

    ! Tuned [strip widths]: Places beside an end, in widths of its strip. Origin: chosen.
    real(wp), parameter :: beside(6) = [0.5_wp, 0.7_wp, 0.9_wp, 1.2_wp, 1.6_wp, 2.2_wp]
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: share = 0.5_wp ! of what counts there: few strips leave some

    !> A place outside the patches where the surfaces overlap.
    type :: overlap_t
        real(wp) :: from = 0.0_wp, to = 0.0_wp  !! its ends, mm
        real(wp) :: deepest = 0.0_wp            !! mm; 0: none
        real(wp) :: low = 0.0_wp, high = 0.0_wp !! ends of the stretch it lies in, mm
        real(wp) :: step = 0.0_wp               !! distance of the places looked at, mm
    end type overlap_t

contains

    !> Find places outside the patches where the deformed surfaces overlap.
    pure subroutine find_overlaps(curve, compliance, depth, y_left, y_right, p0, half_length, &
                                  from, to, width, found)
        type(gap_curve_t), intent(in) :: curve        !! a gap that was set
        real(wp), intent(in) :: compliance            !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth                 !! above the lowest height, mm
        real(wp), intent(in) :: y_left(:), y_right(:) !! edges of strips, (n), mm
        real(wp), intent(in) :: p0(:), half_length(:) !! their pressures, MPa, and lengths, mm, (n)
        real(wp), intent(in) :: from(:), to(:)        !! ends of the patches, (m), mm
        real(wp), intent(in) :: width                 !! of a strip: two places are looked at in it
        type(overlap_t), intent(out) :: found(:)      !! those found, then ones of no depth

        real(wp) :: y_from(most_at_once), y_to(most_at_once), low
        integer :: i, m, n, p

        n = 0
        call level_intervals(curve, curve%h_lowest + depth, y_from, y_to, m)
        do i = 1, m
            low = y_from(i)
            do p = 1, size(from)
                if (to(p) <= low .or. from(p) >= y_to(i)) cycle
                if (from(p) > low) call scan(low, from(p), -1, found, n)
                low = max(low, to(p))
            end do
            if (y_to(i) > low) call scan(low, y_to(i), &
                                               merge(1, 0, low > y_from(i)), found, n)
        end do

    contains

        !> One stretch.
        pure subroutine scan(low, high, way, found, n)
            real(wp), intent(in) :: low, high ! its ends, mm
            integer, intent(in) :: way ! from the patch beside it: 1 to the right, -1 to the left;
                                       ! 0: there is none
            type(overlap_t), intent(inout) :: found(:)
            integer, intent(inout) :: n ! how many so far

            real(wp) :: dy, deep(most_at_once)
            integer :: k, j, places
            logical :: is_deep, was_deep

            ! A quarter less: a stretch often is a whole number of cells, and rounding would count.
            places = max(2, min(most_at_once, ceiling(2.0_wp*(high - low)/width - 0.25_wp)))
            dy = (high - low)/places
            deep(:places) = 0.0_wp
            was_deep = way /= 0
            do k = 1, places
                j = merge(k, places + 1 - k, way >= 0)
                associate (y => low + (j - 0.5_wp)*dy)
                    deep(j) = overlap_depth(curve, compliance, depth, y_left, y_right, p0, &
                                            half_length, y)
                    if (was_deep .and. deep(j) <= 0.0_wp) then
                        if (stays_apart(curve, y, way*dy, places - k)) exit
                    end if
                end associate
                was_deep = deep(j) > 0.0_wp
            end do
            was_deep = .false.
            do j = 1, places
                is_deep = deep(j) > overlap_tolerance*depth
                if (is_deep .and. .not. was_deep) then
                    if (n == size(found)) return
                    n = n + 1
                    found(n) = overlap_t(low + (j - 1)*dy, low=low, high=high, step=dy)
                end if
                if (is_deep) then
                    found(n)%to = low + j*dy
                    found(n)%deepest = max(found(n)%deepest, deep(j))
                end if
                was_deep = is_deep
            end do
        end subroutine scan
    end subroutine find_overlaps

    !> Largest overlap of the deformed surfaces outside the patches of a solution, over the depth:
    !> in the gap's valleys, at the ends of its points, and next to the ends of the patches.
    pure real(wp) function overlap_outside(curve, compliance, depth, strips) result(largest)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: depth                !! at which the strips close it, mm
        type(contact_strips_t), intent(in) :: strips !! the solution

        real(wp) :: width
        integer :: j, k

        ! A valley may be cut off by the end of the points.
        largest = max(overlap_at(curve%y(1)), overlap_at(curve%y(curve%n)))
        j = 1
        do
            j = valley_below(curve, curve%h_lowest + depth, j + 1)
            if (j > curve%n_pieces) exit
            largest = max(largest, overlap_at(curve%y_node(j)))
        end do
        do k = 1, strips%n
            width = strips%y_right(k) - strips%y_left(k)
            if (starts_patch(strips, k)) &
                largest = max(largest, overlap_beside(strips%y_left(k), -width))
            if (ends_patch(strips, k)) &
                largest = max(largest, overlap_beside(strips%y_right(k), width))
        end do
        largest = largest/depth

    contains

        !> Overlap at a place, mm; zero in a patch and where the gap has no points.
        pure real(wp) function overlap_at(y) result(overlap)
            real(wp), intent(in) :: y ! mm

            overlap = 0.0_wp
            associate (n => strips%n)
                if (y < curve%y(1) .or. y > curve%y(curve%n)) return
                if (any(strips%y_left(:n) <= y .and. strips%y_right(:n) >= y)) return
                overlap = max(overlap, overlap_depth(curve, compliance, depth, strips%y_left(:n), &
                                                     strips%y_right(:n), strips%p0(:n), &
                                                     strips%half_length(:n), y))
            end associate
        end function overlap_at

        !> Overlap beside an end of a patch, so far as it counts, mm.
        pure real(wp) function overlap_beside(y, outwards) result(counts)
            real(wp), intent(in) :: y        ! the end, mm
            real(wp), intent(in) :: outwards ! width of the end strip, negative to the left, mm

            real(wp) :: overlap, at
            integer :: i, n
            logical :: overlaps

            counts = 0.0_wp
            overlaps = .true.
            do i = 1, size(beside)
                at = y + beside(i)*outwards
                overlap = overlap_at(at)
                counts = max(counts, share*overlap)
                n = size(beside) - i
                if (overlaps .and. overlap <= 0.0_wp .and. n > 0) then
                    if (stays_apart(curve, at, (beside(size(beside)) - beside(i))*outwards/n, n)) &
                        exit
                end if
                overlaps = overlap > 0.0_wp
            end do
        end function overlap_beside
    end function overlap_outside

    !> Do surfaces that are apart at a place stay apart, on the way from a patch or an overlap? They
    !> do as far as the gap is convex: displacements beside all pressures are convex, so that the
    !> overlap is concave, and it falls already.
    pure logical function stays_apart(curve, y, dy, n)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y  !! place, mm
        real(wp), intent(in) :: dy !! from place to place, negative to the left, mm
        integer, intent(in) :: n   !! places to come, at most `most_at_once`

        real(wp) :: at(0:most_at_once), slope(0:most_at_once)
        integer :: j

        do j = 0, n
            at(j) = y + (j + merge(0, -n, dy > 0.0_wp))*abs(dy)
        end do
        call gap_slopes(curve, at(:n), slope(:n))
        stays_apart = all(slope(1:n) >= slope(:n - 1))
    end function stays_apart

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
end module faststrip_normal_overlap
