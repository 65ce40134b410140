!> Where a sampled curve is torn: steps, kinks and points that stand out, which no spline should
!> be drawn through as if they were smooth.
!>
!> A C2 spline answers a step anywhere with waves everywhere: they fall off by 0.27 from point to
!> point, and a wall of a kilometre is still seen twenty points away. So the curve has to be cut
!> there, and before that the places have to be known.
!>
!> Looked at are the second derivatives c that three neighbouring points give. A step between two
!> points makes one c too large and the next too small by the same; a kink makes one or two too
!> large; a jump of the curvature, as where two arcs meet, makes none stand out: c goes from the
!> values on its left to those on its right. A point is **torn** if its c lies outside of what both
!> sides foretell by ten times what they scatter, that is where the next seven c of either side
!> lead, by their medians, which up to three others of their kind among the seven do not disturb.
!> Where one side is too rough to foretell anything, as in a block of fill values, or has too few
!> points, the other decides.
!>
!> Where stitched scans scatter, one point in two or three stands out by the same and the median
!> deviation of the others is nothing: what stands out so on both sides again and again, and by no
!> more than a thousandth of the points' distance, is no tear.
!>
!> Only ratios of differences count: units of length, the curve's direction and a height added to
!> all points change nothing but rounding.
module faststrip_numerics_cliffs
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: find_torn_points, too_much

    ! c of a side that foretell the next one: three of them may be torn themselves. With 5 two
    ! steps within five points go unseen; with 9 the curvature has changed too much.
    ! Tuned [points]. Origin: as said with it.
    integer, parameter :: window = 7
    ! Fewer than most of them foretell nothing.
    integer, parameter :: fewest = (window + 1)/2
    !> How many times what neighbours foretell is too much: median deviations of second derivatives,
    !> and of a spline's interval what a parabola rises. In noise 10 deviations are passed by one
    !> point in some thousand, and what is lost there is little; smooth curves stay far below 3.
    !> Tuned [1]. Origin: as said with it.
    real(wp), parameter :: too_much = 10.0_wp
    ! A change of c by less than this is no step; sooner than that the rest is not even looked at.
    ! Tuned [1, of the unit of c]. Origin: chosen; saves time in smooth curves.
    real(wp), parameter :: least_change = 0.02_wp
    ! A kink, unlike a step, has to have so much of the curvature around it: where two arcs of
    ! changing curvature meet c may stand out by a tenth, in the reference's 20 gaps. With 4, kinks
    ! of a few um per mm in coarse data go unseen.
    ! Tuned [median deviations]. Origin: as said with it.
    real(wp), parameter :: kink_factor = 2.0_wp
    ! A step turns the curve up and down by the same, up to this and what scatters.
    ! Tuned [1]. Origin: chosen; between a step, 0, and a kink, 1.
    real(wp), parameter :: step_balance = 0.5_wp
    ! Beside a rough side c has to be so many times what the smooth side has: noise that is joined
    ! to a smooth curve is no row of steps.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: rough_factor = 1000.0_wp
    ! The nearest three c of a smooth side differ by less than this from what it foretells.
    ! Tuned [1]. Origin: chosen; round.
    real(wp), parameter :: agreement = 0.25_wp
    ! Scatter that comes again: one in three of the c on each side stands out as far as half of it.
    integer, parameter :: again = nint(window/3.0_wp)
    ! Its height over the chord of the points beside it, over their distance.
    ! Tuned [1]. Origin: chosen: slopes that change by less are a twentieth of those of a patch.
    real(wp), parameter :: scatter_height = 1.0e-3_wp
    ! Rounding of heights and places, in units of their last digit.
    ! Tuned [units in the last place]. Origin: some roundings of a third difference, with a margin.
    real(wp), parameter :: rounding = 64.0_wp

    !> What the points of one side foretell.
    type :: side_t
        logical :: is_known = .false. ! are there enough points?
        logical :: agrees = .false.   ! do the nearest three lie as expected?
        real(wp) :: c = 0.0_wp        ! second derivative expected
        real(wp) :: scatter = 0.0_wp  ! of second derivatives around the expected ones, median
        real(wp) :: uneven = 0.0_wp   ! the same of heights over the chord of their neighbours
    end type side_t

contains

    !> Tell which points are torn. The first and the last are not.
    pure subroutine find_torn_points(n, x, y, secants, c, excess, is_torn, any_torn)
        integer, intent(in) :: n              !! number of points, at least 3
        real(wp), intent(in) :: x(n)          !! strictly increasing
        real(wp), intent(in) :: y(n)          !! heights
        real(wp), intent(in) :: secants(n)    !! slopes of the intervals; the last has no meaning
        real(wp), intent(inout) :: c(n)       !! second derivatives by three points; those of the
                                              !! ends repeat their neighbours'
        real(wp), intent(inout) :: excess(n)  !! work space
        logical, intent(inout) :: is_torn(n)  !! the answer
        logical, intent(out) :: any_torn      !! is one?

        integer :: k
        logical :: any_rough ! does any c jump?

        do k = 2, n - 1
            c(k) = 2.0_wp*(secants(k) - secants(k - 1))/(x(k + 1) - x(k - 1))
        end do
        c(1) = c(2)
        c(n) = c(n - 1)
        do k = 2, n - 1
            excess(k) = change_beyond(n, c, k)
        end do
        is_torn = .false.
        any_torn = .false.
        any_rough = .false.
        do k = 2, n - 1
            if (excess(k) <= 0.0_wp) cycle
            any_rough = any_rough .or. jumps(c(k - 1), c(k)) .or. jumps(c(k + 1), c(k))
            ! The smaller part of a kink between two points is no extremum.
            if ((c(k) - c(k - 1))*sign(1.0_wp, c(k) - c(k + 1)) <= 0.0_wp &
                .and. .not. is_torn(k - 1)) cycle
            call look_at(n, x, y, secants, c, k, excess, is_torn)
            any_torn = any_torn .or. is_torn(k)
        end do
        if (.not. (any_torn .or. any_rough)) return
        do k = n - 1, 2, -1
            if (.not. is_torn(k + 1)) cycle
            if (.not. is_torn(k)) call look_at(n, x, y, secants, c, k, excess, is_torn)
        end do
        call let_arcs_be(n, x, c, excess, is_torn)
        call compare_one_side(n, 1, any_rough, x, y, secants, c, is_torn)
        call compare_one_side(n, -1, any_rough, x, y, secants, c, is_torn)
        any_torn = any(is_torn)
    end subroutine find_torn_points

    !> By how much a second derivative differs from one beside it, over what is no step.
    pure real(wp) function change_beyond(n, c, k)
        integer, intent(in) :: n, k
        real(wp), intent(in) :: c(n)

        change_beyond = max(abs(c(k) - c(k - 1)), abs(c(k + 1) - c(k))) - least_change*abs(c(k))
    end function change_beyond

    !> Is a second derivative beyond that of a smooth point before it?
    pure logical function jumps(before, c)
        real(wp), intent(in) :: before, c

        jumps = abs(c - before) > 0.5_wp*rough_factor*abs(before)
    end function jumps

    !> Is this point one that neither side foretells?
    pure subroutine look_at(n, x, y, secants, c, k, excess, is_torn)
        integer, intent(in) :: n, k
        real(wp), intent(in) :: x(n), y(n), secants(n), c(n)
        real(wp), intent(inout) :: excess(n)
        logical, intent(inout) :: is_torn(n)

        type(side_t) :: left, right
        real(wp) :: change

        if (change_beyond(n, c, k) <= 0.0_wp) return
        left = foretold(n, x, c, is_torn, .false., k, -1)
        right = foretold(n, x, c, is_torn, .false., k, 1)
        if (.not. (left%is_known .or. right%is_known)) return
        if (.not. left%is_known) left = right
        if (.not. right%is_known) right = left
        excess(k) = excess_over(c(k), left, right)
        change = abs(excess(k))
        is_torn(k) = change > too_much*max(left%scatter, right%scatter) &
                     .and. change > least_change*abs(c(k)) &
                     .and. change*chord_factor(n, x, k) &
                     > max(too_much*max(left%uneven, right%uneven), &
                           rounding_of(n, x, y, secants, k))
        if (is_torn(k)) is_torn(k) = .not. comes_again(n, x, c, k, excess(k))
    end subroutine look_at

    !> Does what a second derivative has too much come again and again on both sides of its point?
    pure logical function comes_again(n, x, c, k, excess)
        integer, intent(in) :: n, k
        real(wp), intent(in) :: x(n), c(n), excess

        integer :: i, step, n_seen, n_again
        logical :: any_side

        comes_again = .false.
        any_side = .false.
        if (abs(excess)*chord_factor(n, x, k) > 0.5_wp*scatter_height*(x(k + 1) - x(k - 1))) return
        do step = -1, 1, 2
            n_seen = 0
            n_again = 0
            i = k + step
            do while (i > 1 .and. i < n .and. n_seen < window)
                n_seen = n_seen + 1
                if ((c(i) - (c(k) - 0.5_wp*excess))*sign(1.0_wp, excess) >= 0.0_wp) &
                    n_again = n_again + 1
                i = i + step
            end do
            if (n_seen < fewest) cycle
            if (n_again < again*n_seen/window) return
            any_side = .true.
        end do
        comes_again = any_side
    end function comes_again

    !> Points of a rough stretch as seen from the smooth side before it: the last points that are
    !> not torn foretell, until others agree with them, or with each other.
    pure subroutine compare_one_side(n, step, any_rough, x, y, secants, c, is_torn)
        integer, intent(in) :: n, step   ! 1 from the left, -1 from the right
        logical, intent(in) :: any_rough ! may any c jump?
        real(wp), intent(in) :: x(n), y(n), secants(n), c(n)
        logical, intent(inout) :: is_torn(n)

        type(side_t) :: before, after
        real(wp) :: change
        integer :: k
        logical :: goes_on ! was the point before torn, as seen from `before`?

        goes_on = .false.
        do k = merge(2, n - 1, step > 0), merge(n - 1, 2, step > 0), step
            ! The point before is as the side before, unless it is torn.
            if (.not. (goes_on .or. is_torn(k - step))) then
                if (.not. any_rough) cycle
                if (.not. jumps(c(k - step), c(k))) cycle
            end if
            if (is_torn(k)) cycle
            if (.not. goes_on) before = foretold(n, x, c, is_torn, .true., k, -step)
            goes_on = .false.
            if (.not. before%is_known) cycle
            change = abs(c(k) - before%c)
            if (change <= max(rough_factor*abs(before%c), too_much*before%scatter)) cycle
            if (change*chord_factor(n, x, k) &
                <= max(too_much*before%uneven, rounding_of(n, x, y, secants, k))) cycle
            if (comes_again(n, x, c, k, c(k) - before%c)) cycle
            after = foretold(n, x, c, is_torn, .false., k, step)
            if (after%is_known .and. after%agrees .and. too_much*after%scatter < change &
                .and. abs(excess_over(c(k), before, after)) &
                <= max(too_much*max(before%scatter, after%scatter), &
                       least_change*abs(c(k)))) cycle
            is_torn(k) = .true.
            goes_on = .true.
        end do
    end subroutine compare_one_side

    !> Torn neighbours are a step if c is too large and too small beside each other by the same, so
    !> that the slope goes on as before; else a kink, one or two of them, if that is large. More
    !> than two too large by the same sign, or up to three by little, are arcs that meet: the spline
    !> goes through them well enough. Longer rows of both signs are fill values.
    pure subroutine let_arcs_be(n, x, c, excess, is_torn)
        integer, intent(in) :: n
        real(wp), intent(in) :: x(n), c(n), excess(n)
        logical, intent(inout) :: is_torn(n)

        integer :: first, last, k
        real(wp) :: up, down, change

        last = 1
        do while (last < n)
            first = last + 1
            last = first
            if (.not. is_torn(first)) cycle
            do while (is_torn(last + 1))
                last = last + 1
            end do
            up = 0.0_wp
            down = 0.0_wp
            do k = first, last
                change = 0.5_wp*excess(k)*(x(k + 1) - x(k - 1))
                up = up + max(change, 0.0_wp)
                down = down - min(change, 0.0_wp)
            end do
            if (min(up, down) >= step_balance*max(up, down)) cycle
            if ((last - first > 1 .and. min(up, down) <= 0.0_wp) &
                .or. (last - first <= 2 .and. maxval(abs(excess(first:last))) &
                      <= kink_factor*max(abs(c(first - 1)), abs(c(last + 1))))) &
                is_torn(first:last) = .false.
        end do
    end subroutine let_arcs_be

    !> By how much a second derivative lies outside of those that two sides foretell.
    pure real(wp) function excess_over(c, one, other) result(excess)
        real(wp), intent(in) :: c
        type(side_t), intent(in) :: one, other

        excess = max(c - max(one%c, other%c), 0.0_wp) + min(c - min(one%c, other%c), 0.0_wp)
    end function excess_over

    !> What the nearest points of one side foretell for point k, torn ones counted or not.
    pure type(side_t) function foretold(n, x, c, is_torn, leave_out, k, step) result(side)
        integer, intent(in) :: n
        real(wp), intent(in) :: x(n), c(n)
        logical, intent(in) :: is_torn(n), leave_out
        integer, intent(in) :: k, step ! -1 for the left side, 1 for the right

        integer :: i, m
        real(wp) :: values(window), places(window), chords(window), trend(window), rest(window)
        real(wp) :: middle, spread

        m = 0
        i = k + step
        do while (i > 1 .and. i < n .and. m < window)
            if (.not. (leave_out .and. is_torn(i))) then
                m = m + 1
                values(m) = c(i)
                ! The difference quotient is the second derivative at the mean of its points, up
                ! to the third order.
                places(m) = centre(i) - centre(k)
                chords(m) = chord_factor(n, x, i)
            end if
            i = i + step
        end do
        side%is_known = m >= fewest
        if (.not. side%is_known) return
        side%c = median(m, values)
        rest(:m) = abs(values(:m) - side%c)
        side%scatter = median(m, rest)
        ! The same with a trend; it is taken if it foretells these better.
        do i = 1, m - 1
            trend(i) = (values(i + 1) - values(i))/(places(i + 1) - places(i))
        end do
        values(:m) = values(:m) - median(m - 1, trend)*places(:m)
        middle = median(m, values)
        do i = 1, m
            values(i) = abs(values(i) - middle)
        end do
        spread = median(m, values)
        if (spread < side%scatter) then
            side%c = middle
            side%scatter = spread
            rest(:m) = values(:m)
        end if
        side%agrees = all(rest(:3) <= agreement*abs(side%c))
        do i = 1, m
            rest(i) = rest(i)*chords(i)
        end do
        side%uneven = median(m, rest)

    contains

        pure real(wp) function centre(i)
            integer, intent(in) :: i

            centre = ((x(i - 1) + x(i + 1)) + x(i))/3.0_wp
        end function centre
    end function foretold

    !> Height of the middle one of three points over the chord of the others per second derivative.
    pure real(wp) function chord_factor(n, x, k)
        integer, intent(in) :: n
        real(wp), intent(in) :: x(n)
        integer, intent(in) :: k

        chord_factor = 0.5_wp*(x(k) - x(k - 1))*(x(k + 1) - x(k))
    end function chord_factor

    !> What of such a height may be rounding.
    pure real(wp) function rounding_of(n, x, y, secants, k)
        integer, intent(in) :: n
        real(wp), intent(in) :: x(n), y(n), secants(n)
        integer, intent(in) :: k

        real(wp) :: slope

        slope = max(abs(secants(k - 1)), abs(secants(k)))
        rounding_of = rounding*epsilon(1.0_wp)*(maxval(abs(y(k - 1:k + 1))) + abs(x(k))*slope)
    end function rounding_of

    !> Median; of an even number the mean of the middle two.
    pure real(wp) function median(m, values)
        integer, intent(in) :: m
        real(wp), intent(in) :: values(m)

        integer, parameter :: middle = (window + 1)/2
        real(wp) :: sorted(window), lower
        integer :: i, j

        ! Those that are missing on both sides of the others, so that the middle is in its place.
        sorted = huge(1.0_wp)
        sorted(:(window - m)/2) = -huge(1.0_wp)
        sorted((window - m)/2 + 1:(window + m)/2) = values
        ! The larger half only.
        do i = window, middle - 1, -1
            do j = 1, i - 1
                lower = min(sorted(j), sorted(j + 1))
                sorted(j + 1) = max(sorted(j), sorted(j + 1))
                sorted(j) = lower
            end do
        end do
        median = sorted(middle)
        if (modulo(m, 2) == 0) median = 0.5_wp*(median + sorted(middle - 1))
    end function median
end module faststrip_numerics_cliffs
