!> Where a patch is cut into strips: narrower ones towards its ends, where lengths change fastest,
!> and where the gap's curvature changes, as there do pressures and lengths.
!>
!> Of `s` from -1 to 1, which grows by 2/n from strip to strip, `blend(s)` is the place in
!> half-widths of the patch where the curvature does not change. Elsewhere strips are narrower by
!> `1 + V`, with `V = |B(s + d) - B(s - d)|` over the mean of `|B|`, bounded, and smoothed by a
!> triangle of half-width d. B is the mean of the curvature between two places, from the slopes at
!> them: at a place it is noise where the gap has kinks or was measured.
!>
!> The edges follow from the gap and the patch alone, and smoothly. They are ratios, so the unit of
!> length does not matter, and those of a mirror image are the mirror image of the edges, to the
!> last digit: sums are taken in pairs, and from the middle of the patch outwards.
module faststrip_normal_strip_grading
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_slopes
    implicit none
    private

    public :: grade, grade_plainly

    real(wp), public :: end_grading = 0.7_wp, steepest = 4, reach = 1.5, reach2=1.5, gain = 1
    integer, public :: per_strip = 3, box = 1
    integer, parameter :: most_half = 256, padding = 32

contains

    pure subroutine grade(curve, y_from, y_to, n, edge)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y_from, y_to
        integer, intent(in) :: n
        real(wp), intent(inout) :: edge(:)

        real(wp), dimension(-most_half:most_half) :: eta, y, slope
        real(wp), dimension(1 - padding:2*most_half + padding) :: bend, change, b2
        real(wp), dimension(0:most_half) :: left, right
        real(wp) :: middle, half, usual, total, at
        integer :: m, d, d2, i, j, k

        m = min(most_half, (per_strip*n + 1)/2)
        d = max(1, nint(reach*2*m/n))
        d2 = max(1, nint(reach2*2*m/n))
        middle = 0.5_wp*(y_from + y_to)
        half = 0.5_wp*(y_to - y_from)
        eta(0) = 0.0_wp
        do j = 1, m
            eta(j) = blend(real(j, wp)/m)
            eta(-j) = -eta(j)
        end do
        y(-m:m) = middle + half*eta(-m:m)
        call gap_slopes(curve, y(-m:m), slope(-m:m))
        usual = 0.0_wp
        do j = m, 1, -1
            usual = usual + (abs(slope(j) - slope(j - 1)) + abs(slope(1 - j) - slope(-j)))
        end do
        usual = 0.5_wp*usual
        if (.not. (usual > 0.0_wp .and. usual < huge(1.0_wp))) then
            call grade_plainly(n, edge)
            return
        end if
        do i = 1, 2*m
            bend(i) = (slope(i - m) - slope(i - m - 1))/((eta(i - m) - eta(i - m - 1))*usual)
        end do
        bend(1 - padding:0) = bend(1)
        bend(2*m + 1:2*m + padding) = bend(2*m)
        b2 = bend
        if (box > 0) then
        do i = 1,2*m
            b2(i) = bend(i)
            do j=1,box
            b2(i) = b2(i) + (bend(i-j)+bend(i+j))
            end do
            b2(i) = b2(i)/(2*box+1)
        end do
        b2(1 - padding:0) = b2(1)
        b2(2*m + 1:2*m + padding) = b2(2*m)
        end if
        do i = 1, 2*m
            change(i) = min(gain*abs(b2(i + d) - b2(i - d)), steepest)
        end do
        change(1 - padding:0) = change(1)
        change(2*m + 1:2*m + padding) = change(2*m)
        left(0) = 0.0_wp
        right(0) = 0.0_wp
        do j = 1, m
            left(j) = left(j - 1) + density(m + 1 - j)
            right(j) = right(j - 1) + density(m + j)
        end do
        total = left(m) + right(m)
        do k = 1, n - 1
            at = 0.5_wp*((right(m) - left(m)) + total*(2*k - n)/n)
            if (at < 0.0_wp) then
                edge(k) = -blend(place(left, -at))
            else
                edge(k) = blend(place(right, at))
            end if
        end do
        edge(n) = 1.0_wp

    contains

        pure real(wp) function density(i)
            integer, intent(in) :: i
            integer :: j

            density = d2*change(i)
            do j = 1, d2 - 1
                density = density + (d2 - j)*(change(i - j) + change(i + j))
            end do
            density = 1.0_wp + density/d2**2
        end function density

        pure real(wp) function place(sums, at)
            real(wp), intent(in) :: sums(0:), at
            integer :: i
            do i = 0, m - 2
                if (sums(i + 1) >= at) exit
            end do
            place = (i + (at - sums(i))/(sums(i + 1) - sums(i)))/m
        end function place
    end subroutine grade

    pure subroutine grade_plainly(n, edge)
        integer, intent(in) :: n
        real(wp), intent(inout) :: edge(:)
        integer :: k

        do k = 1, n
            edge(k) = blend(2.0_wp*k/n - 1.0_wp)
        end do
    end subroutine grade_plainly

    pure real(wp) function blend(s)
        real(wp), intent(in) :: s

        blend = (1.0_wp - end_grading)*s + end_grading*sin(0.5_wp*pi*s)
    end function blend
end module faststrip_normal_strip_grading
