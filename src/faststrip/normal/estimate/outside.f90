!> Overlap of the deformed surfaces outside the patches of a strip solution, for
!> `faststrip_normal_estimate_errors`.
module faststrip_normal_estimate_outside
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, level_intervals
    use faststrip_normal_estimate_samples, only: sample, sample_centre_line
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
    implicit none
    private

    public :: look_ahead, look_beyond, look_elsewhere

    ! Tuned [strips]: How many. Origin: chosen.
    integer, parameter :: tips_ahead = 4     ! of a block of strips
    ! Tuned [half-lengths]. Origin: chosen; just outside.
    real(wp), parameter :: ahead = 1.05_wp   ! of the half-length
    ! Tuned [strip widths]. Origin: chosen; just outside, and one strip.
    real(wp), parameter :: beyond(2) = [0.25_wp, 1.0_wp] ! widths of the end strip
    ! Tuned [points]. Origin: chosen.
    integer, parameter :: scan_points = 8    ! in a stretch below D
    ! Tuned [intervals]: Most stretches looked at. Origin: capacity.
    integer, parameter :: max_intervals = 64

contains

    !> The overlap ahead of some of the tips of strips `from` to `to`.
    pure subroutine look_ahead(curve, compliance, strips, depth, from, to, overlap)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        integer, intent(in) :: from, to              !! strips
        real(wp), intent(inout) :: overlap           !! raised to the largest, over the depth

        real(wp), dimension(tips_ahead) :: x, y, gap, inv2r
        integer :: i, k

        do i = 1, tips_ahead
            k = from + ((to - from)*(2*i - 1))/(2*tips_ahead)
            x(i) = ahead*strips%half_length(k)
            y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
        end do
        call sample(curve, compliance, strips, depth, x, y, gap, inv2r)
        overlap = max(overlap, -minval(gap))
    end subroutine look_ahead

    !> The overlap beyond both ends of the patch that starts with strip `first`.
    pure subroutine look_beyond(curve, compliance, strips, depth, first, overlap)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        integer, intent(in) :: first                 !! strip of the patch
        real(wp), intent(inout) :: overlap           !! raised to the largest, over the depth

        real(wp) :: y(4), gap(4)
        integer :: i, last

        last = last_of_patch(strips, first)
        y(1:2) = strips%y_left(first) - beyond*(strips%y_right(first) - strips%y_left(first))
        y(3:4) = strips%y_right(last) + beyond*(strips%y_right(last) - strips%y_left(last))
        call sample_centre_line(curve, compliance, strips, depth, y, gap)
        do i = 1, 4
            if (is_outside(curve, strips, y(i))) overlap = max(overlap, -gap(i))
        end do
    end subroutine look_beyond

    !> The overlap wherever the undeformed gap is below the penetration and there is no patch.
    pure subroutine look_elsewhere(curve, compliance, strips, depth, overlap)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! D - h_lowest, mm
        real(wp), intent(inout) :: overlap           !! raised to the largest, over the depth

        real(wp) :: y_from(max_intervals), y_to(max_intervals), low
        integer :: i, n, first, last

        call level_intervals(curve, curve%h_lowest + depth, y_from, y_to, n)
        do i = 1, n
            low = y_from(i)
            first = 1
            do while (first <= strips%n)
                last = last_of_patch(strips, first)
                if (strips%y_right(last) > low .and. strips%y_left(first) < y_to(i)) then
                    call scan(curve, compliance, strips, depth, low, strips%y_left(first), overlap)
                    low = max(low, strips%y_right(last))
                end if
                first = last + 1
            end do
            call scan(curve, compliance, strips, depth, low, y_to(i), overlap)
        end do
    end subroutine look_elsewhere

    !> The overlap in one stretch of the centre line.
    pure subroutine scan(curve, compliance, strips, depth, from, to, overlap)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, from, to
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(inout) :: overlap

        real(wp) :: gap(scan_points), y(scan_points)
        integer :: j

        if (to <= from) return
        y = [(from + (to - from)*(j - 0.5_wp)/scan_points, j=1, scan_points)]
        call sample_centre_line(curve, compliance, strips, depth, y, gap)
        overlap = max(overlap, -minval(gap))
    end subroutine scan

    !> Is a place among the gap's points and in no patch?
    pure logical function is_outside(curve, strips, y)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: y

        is_outside = y >= curve%y(1) .and. y <= curve%y(curve%n) &
                     .and. .not. any(strips%y_left(:strips%n) <= y &
                                     .and. strips%y_right(:strips%n) >= y)
    end function is_outside
end module faststrip_normal_estimate_outside
