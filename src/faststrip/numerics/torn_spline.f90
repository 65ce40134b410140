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
    use faststrip_base_status, only: status_t, is_error
    use faststrip_numerics_cliffs, only: find_torn_points, too_much
    use faststrip_numerics_spline, only: spline_setup, spline_not_a_knot, spline_monotone
    implicit none
    private

    public :: torn_spline_setup, torn_spline_work_size, tame_interval

contains

    !> Length of the workspace `torn_spline_setup` needs for n points.
    pure integer function torn_spline_work_size(n)
        integer, intent(in) :: n !! number of points

        torn_spline_work_size = 4*max(n, 1)
    end function torn_spline_work_size

    !> The slopes at both ends of every interval.
    subroutine torn_spline_setup(x, y, slope_from, slope_to, c, is_torn, is_step, work, status)
        real(wp), intent(in) :: x(:)              !! knots, strictly increasing, at least 3
        real(wp), intent(in) :: y(:)              !! values at the knots, as many
        real(wp), intent(inout) :: slope_from(:)  !! of interval i at its left end, as many
        real(wp), intent(inout) :: slope_to(:)    !! and at its right end, as many; the last ones
                                                  !! of both have no meaning
        real(wp), intent(inout) :: c(:)           !! second derivatives by three points, as many
        logical, intent(inout) :: is_torn(:)      !! is there a tear at the knot? as many
        logical, intent(inout) :: is_step(:)      !! is interval i a step? as many
        real(wp), intent(inout) :: work(:)        !! see `torn_spline_work_size`
        type(status_t), intent(out) :: status     !! those of `spline_setup`

        integer :: n, first, last
        logical :: any_torn

        n = size(x)
        is_step = .false.
        call find_torn_points(x, y, c, work(:n), is_torn, any_torn)
        last = merge(1, n, any_torn)
        if (.not. any_torn) call fit(1, n, spline_not_a_knot)
        do while (last < n)
            first = last
            last = first + 1
            do while (last < n .and. .not. is_torn(last))
                last = last + 1
            end do
            call fit(first, last, spline_not_a_knot)
            if (is_error(status)) return
        end do
        if (any_torn) call take_steps()

    contains

        !> Interpolate the points `first` to `last`.
        subroutine fit(first, last, kind)
            integer, intent(in) :: first, last, kind

            integer :: m

            m = last - first + 1
            call spline_setup(x(first:last), y(first:last), kind, work(:m), work(n + 1:), status)
            slope_from(first:last - 1) = work(:m - 1)
            slope_to(first:last - 1) = work(2:m)
        end subroutine fit

        !> The intervals between torn points that are neighbours.
        subroutine take_steps()
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
                call fit(first, last, spline_monotone)
                if (is_error(status)) return
                slope_from(first) = slope_to(first - 1)
                slope_to(last - 1) = slope_from(last)
                call make_monotone(x(first:first + 1), y(first:first + 1), slope_from(first), &
                                   slope_to(first))
                call make_monotone(x(last - 1:last), y(last - 1:last), slope_from(last - 1), &
                                   slope_to(last - 1))
            end do
        end subroutine take_steps
    end subroutine torn_spline_setup

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
