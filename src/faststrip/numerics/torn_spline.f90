!> Cubic interpolation through points that may hold steps and kinks.
!>
!> Where nothing is torn (`faststrip_numerics_cliffs`) this is the C2 not-a-knot spline. Else each
!> smooth stretch between two tears has such a spline of its own, which knows nothing of what lies
!> beyond: at a kink two of them share the point. Intervals within a tear, the steps, are monotone,
!> with the slopes of the stretches as far as that allows.
!>
!> So every interval has its own two slopes. Waves of tears that were not found are limited too:
!> `tame_interval` bounds by how much an interval may leave the range of its two points.
module faststrip_numerics_torn_spline
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_numerics_cliffs, only: find_torn_points, too_much
    use faststrip_numerics_spline, only: check_points, find_secants, not_a_knot_slopes, &
                                         monotone_slopes
    implicit none
    private

    public :: torn_spline_setup, torn_spline_work_size, tame_interval

contains

    !> Length of the workspace `torn_spline_setup` needs for n points.
    pure integer function torn_spline_work_size(n)
        integer, intent(in) :: n !! number of points

        torn_spline_work_size = 3*max(n, 1)
    end function torn_spline_work_size

    !> The slopes at both ends of every interval.
    subroutine torn_spline_setup(x, y, slope_from, slope_to, c, is_torn, is_step, any_step, work, &
                                 status)
        real(wp), intent(in) :: x(:)              !! knots, finite, strictly increasing, at least 3
        real(wp), intent(in) :: y(:)              !! values at the knots, finite, as many
        real(wp), intent(inout) :: slope_from(:)  !! of interval i at its left end, as many
        real(wp), intent(inout) :: slope_to(:)    !! and at its right end, as many; the last ones
                                                  !! of both have no meaning
        real(wp), intent(inout) :: c(:)           !! second derivatives by three points, as many
        logical, intent(inout) :: is_torn(:)      !! is there a tear at the knot? as many
        logical, intent(inout) :: is_step(:)      !! is interval i a step? as many
        logical, intent(out) :: any_step          !! is one?
        real(wp), intent(inout) :: work(:)        !! see `torn_spline_work_size`
        type(status_t), intent(out) :: status     !! those of `check_points`, `not_a_knot_slopes`

        integer :: n, first, last
        logical :: any_torn

        n = size(x)
        any_step = .false.
        call check_size(n, x, y, status)
        if (is_error(status)) return
        is_step = .false.
        associate (secants => work(:n))
            call find_secants(n, x, y, secants)
            call find_torn_points(n, x, y, secants, c, work(n + 1:2*n), is_torn, any_torn)
            last = 1
            do while (last < n)
                first = last
                last = merge(first + 1, n, any_torn)
                do while (last < n)
                    if (is_torn(last)) exit
                    last = last + 1
                end do
                call not_a_knot_slopes(last - first + 1, x(first:last), secants(first:last), &
                                       slope_from(first:last), work(n + 1:2*n), &
                                       work(2*n + 1:3*n), status)
                if (is_error(status)) return
                slope_to(first:last - 1) = slope_from(first + 1:last)
            end do
            if (any_torn) call take_steps(secants)
        end associate

    contains

        !> The intervals between torn points that are neighbours.
        subroutine take_steps(secants)
            real(wp), intent(in) :: secants(:)

            real(wp) :: kept
            integer :: first, last

            ! The rows of torn points, as `faststrip_numerics_cliffs` goes through them before some
            ! are let be.
            last = 1
            do while (last < n)
                first = last + 1
                last = first
                if (.not. is_torn(first)) cycle
                do while (is_torn(last + 1))
                    last = last + 1
                end do
                if (last == first) cycle
                is_step(first:last - 1) = .true.
                any_step = .true.
                kept = slope_from(last)
                call monotone_slopes(last - first + 1, x(first:last), secants(first:last), &
                                     slope_from(first:last))
                slope_to(first:last - 1) = slope_from(first + 1:last)
                slope_from(last) = kept
                slope_from(first) = slope_to(first - 1)
                slope_to(last - 1) = kept
                call make_monotone(x(first:first + 1), y(first:first + 1), slope_from(first), &
                                   slope_to(first))
                call make_monotone(x(last - 1:last), y(last - 1:last), slope_from(last - 1), &
                                   slope_to(last - 1))
            end do
        end subroutine take_steps
    end subroutine torn_spline_setup

    !> Refuse points beyond all sizes, or too near to each other: `check_points` tells which.
    pure subroutine check_size(n, x, y, status)
        integer, intent(in) :: n
        real(wp), intent(in) :: x(n), y(n)
        type(status_t), intent(out) :: status

        real(wp) :: largest, nearest
        integer :: i

        call clear_status(status)
        largest = max(-x(1), x(n))
        nearest = largest_size
        do i = 1, n - 1
            largest = max(largest, abs(y(i)))
            nearest = min(nearest, x(i + 1) - x(i))
        end do
        if (max(largest, abs(y(n))) > largest_size .or. nearest < 1.0_wp/largest_size) &
            call check_points(x, y, status)
    end subroutine check_size

    !> Hold the slopes of an interval so that its cubic is monotone (Fritsch & Carlson, SIAM J.
    !> Numer. Anal. 17 (1980)): their signs are that of the secant, or zero, and neither is more
    !> than three times as steep.
    pure subroutine make_monotone(x, y, slope_from, slope_to)
        real(wp), intent(in) :: x(2), y(2)
        real(wp), intent(inout) :: slope_from, slope_to

        real(wp) :: secant

        secant = (y(2) - y(1))/(x(2) - x(1))
        slope_from = limited(slope_from)
        slope_to = limited(slope_to)

    contains

        pure real(wp) function limited(slope)
            real(wp), intent(in) :: slope

            limited = sign(min(max(slope*sign(1.0_wp, secant), 0.0_wp), 3.0_wp*abs(secant)), secant)
        end function limited
    end subroutine make_monotone

    !> Make interval i monotone if it leaves the range of its two points by more than their
    !> neighbours' second derivatives allow; that is where a tear was not found.
    !>
    !> Too much is ten times what a parabola with these second derivatives would leave it by. A
    !> spline through noise has less than 3, through a jump of the curvature less than 2; the waves
    !> of an unseen step have more than 100 three points away.
    pure subroutine tame_interval(i, x, y, c, lowest, highest, slope_from, slope_to, is_tamed)
        integer, intent(in) :: i            !! number of the interval
        real(wp), intent(in) :: x(:), y(:)  !! knots and values
        real(wp), intent(in) :: c(:)        !! second derivatives by three points, as
                                            !! `torn_spline_setup` gave them
        real(wp), intent(in) :: lowest      !! of the interval's cubic
        real(wp), intent(in) :: highest     !! of the interval's cubic
        real(wp), intent(inout) :: slope_from, slope_to !! at its two ends
        logical, intent(out) :: is_tamed    !! were they changed?

        real(wp) :: left, right

        left = max(abs(c(max(i - 1, 1))), abs(c(i)))
        right = max(abs(c(i + 1)), abs(c(min(i + 2, size(c)))))
        ! Given: what a parabola leaves its chord by
        is_tamed = max(min(y(i), y(i + 1)) - lowest, highest - max(y(i), y(i + 1))) &
                   > too_much/8.0_wp*(x(i + 1) - x(i))**2*min(left, right)
        if (is_tamed) call make_monotone(x(i:i + 1), y(i:i + 1), slope_from, slope_to)
    end subroutine tame_interval
end module faststrip_numerics_torn_spline
