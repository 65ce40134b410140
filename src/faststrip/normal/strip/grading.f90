!> Where a patch is cut into strips: they are narrower towards its ends, where lengths change
!> fastest, and where the curvature of the gap changes, as pressures and lengths do there.
!>
!> With `s` from -1 to 1, which grows by 2/n from strip to strip, `blend(s)` is the place, in
!> half-widths of the patch, of an edge where the curvature does not change. Elsewhere strips are
!> as dense as `sqrt(1 + V^2)` and its mean over the patch, added: V is by how much the curvature's
!> means differ in d to the right, d to the left and d about the place, over the mean of its size in
!> the patch, and bounded. Means, which are differences of slopes: at one place the curvature would
!> be noise where the gap has kinks or was measured. Squares: what is noise, or a change that goes
!> on through the patch, hardly moves the edges, so that they come to rest with the ends. The mean:
!> half of the strips lie as if nothing changed, so that none is twice as wide as those; creep
!> forces need that (W. Huang, R. D. Russell, Adaptive Moving Mesh Methods, 2011, 2.4).
!>
!> So the edges follow from the gap and the patch, smoothly. They are ratios, in which no unit of
!> length is left, and those of a mirror image are the mirror image of the edges to the last digit:
!> sums are taken in pairs and from the middle outwards.
module faststrip_normal_strip_grading
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_slopes
    implicit none
    private

    public :: grade, grade_plainly

    ! Tuned [1]. Origin: chosen for the errors of pmax and area.
    real(wp), parameter :: end_grading = 0.7_wp ! towards the ends; 0: even strips, 1: as the sine
    ! Tuned [1]. Origin: chosen for the errors of forces on 240 contacts of many kinds, Fx .23 % of
    ! mu N in the mean, with 3.4 .22, with 8 .24; of 1089 contacts of new wheels 14 are under
    ! resolved, 38, 11.
    real(wp), parameter :: most_narrowed = 5.0_wp ! largest V
    ! Tuned [strips]: d. Origin: chosen for the errors of pmax; from 2.6 to 3.2 they change little.
    real(wp), parameter :: reach = 3.0_wp
    ! Tuned [places]: in a strip, at which the slope of the gap is looked at. Origin: chosen: with
    ! more the figures are as good.
    integer, parameter :: per_strip = 2
    ! Tuned [places]: most in half a patch. Origin: capacity; more than 170 strips do with fewer.
    integer, parameter :: most_places = 256

contains

    !> Right edges of the strips of a patch, in half-widths from its middle: rising, the last is 1.
    pure subroutine grade(curve, y_from, y_to, n, edge)
        type(gap_curve_t), intent(in) :: curve  !! a gap that was set
        real(wp), intent(in) :: y_from          !! left end of the patch, mm
        real(wp), intent(in) :: y_to            !! right end, mm
        integer, intent(in) :: n                !! strips, >= 1
        real(wp), intent(inout) :: edge(:)      !! (n)

        real(wp), dimension(-most_places:most_places) :: place, y, slope
        real(wp), dimension(0:most_places) :: to_left, to_right ! strips from the middle, no unit
        real(wp) :: middle, half, turn, mean_density, at
        integer :: m, d, j, k

        m = min(most_places, (per_strip*n + 1)/2)
        d = max(1, nint(reach*2*m/n))
        place(0) = 0.0_wp
        do j = 1, m
            place(j) = blend(real(j, wp)/m)
            place(-j) = -place(j)
        end do
        middle = 0.5_wp*(y_from + y_to)
        half = 0.5_wp*(y_to - y_from)
        y(-m:m) = middle + half*place(-m:m)
        call gap_slopes(curve, y(-m:m), slope(-m:m))
        turn = 0.0_wp
        do j = 1, m
            turn = turn + (abs(slope(j) - slope(j - 1)) + abs(slope(1 - j) - slope(-j)))
        end do
        if (.not. (turn > tiny(turn) .and. turn < huge(turn))) then
            call grade_plainly(n, edge)
            return
        end if
        to_left(0) = 0.0_wp
        to_right(0) = 0.0_wp
        do j = 1, m
            to_left(j) = to_left(j - 1) + density(1 - j)
            to_right(j) = to_right(j - 1) + density(j)
        end do
        mean_density = (to_left(m) + to_right(m))/(2*m)
        do j = 1, m
            to_left(j) = to_left(j) + mean_density*j
            to_right(j) = to_right(j) + mean_density*j
        end do
        do k = 1, n - 1
            at = 0.5_wp*((to_right(m) - to_left(m)) + (to_right(m) + to_left(m))*(2*k - n)/n)
            if (at < 0.0_wp) then
                edge(k) = -blend(inverse(to_left(:m), -at))
            else
                edge(k) = blend(inverse(to_right(:m), at))
            end if
        end do
        edge(n) = 1.0_wp

    contains

        !> sqrt(1 + V^2) between places j - 1 and j. At the ends of the patch means are those of
        !> less.
        pure real(wp) function density(j)
            integer, intent(in) :: j

            real(wp) :: left, right, about
            integer :: beside

            beside = (d - 1)/2
            left = mean(max(j - 1 - d, -m), max(j - 1, 1 - m))
            right = mean(min(j, m - 1), min(j + d, m))
            about = mean(max(j - 1 - beside, -m), min(j + beside, m))
            density = sqrt(1.0_wp + min(most_narrowed, max(left, right, about) &
                                                       - min(left, right, about))**2)
        end function density

        !> Mean of the curvature between two places, over that of its size.
        pure real(wp) function mean(from, to)
            integer, intent(in) :: from, to

            mean = (slope(to) - slope(from))/((place(to) - place(from))*(0.5_wp*turn))
        end function mean
    end subroutine grade

    !> The same where the curvature of the gap does not change.
    pure subroutine grade_plainly(n, edge)
        integer, intent(in) :: n           !! strips, >= 1
        real(wp), intent(inout) :: edge(:) !! (n)

        integer :: k

        do k = 1, n
            edge(k) = blend(2.0_wp*k/n - 1.0_wp)
        end do
    end subroutine grade_plainly

    !> Strips grow narrower towards the ends of a patch; -1, 0, 1 stay in place.
    pure real(wp) function blend(s)
        real(wp), intent(in) :: s

        blend = (1.0_wp - end_grading)*s + end_grading*sin(0.5_wp*pi*s)
    end function blend

    !> Where sums reach a value, between 0, the first, and 1, the last.
    pure real(wp) function inverse(sums, value)
        real(wp), intent(in) :: sums(0:) ! rising, from 0
        real(wp), intent(in) :: value

        integer :: i, m

        m = ubound(sums, 1)
        do i = 0, m - 2
            if (sums(i + 1) >= value) exit
        end do
        inverse = (i + (value - sums(i))/(sums(i + 1) - sums(i)))/m
    end function inverse
end module faststrip_normal_strip_grading
