!> Strips that do not stand side by side: those of a yawed wheel whose patch is wide or has two
!> lobes lie at places x0(y) along x that run with y.
!>
!> A pressure at x0_s acts at the distance `x + x0_k - x0_s` along x, not at x: strips that are
!> apart press each other down by less. By how much less is taken from the heights of the gap,
!>
!>     h'(y) = h(y) + H sum_s p_s [I_s(x0(y) - x0_s, y) - I_s(0, y)],
!>
!> H, I_s of eq. (4), and 1/(2 R) is that of the parabola through the same at the tips. So strips
!> are solved for as ever, on a gap that follows of their pressures. The sums are found at some
!> places across the overlap, and on a spline between them.
module faststrip_normal_strip_places
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_influence_offcentre_column, only: influence_column_gradient
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_numerics_spline, only: spline_setup, spline_value, spline_not_a_knot, interval_of
    implicit none
    private

    public :: find_displaced, add_pressed, value_between

    ! Tuned [places]: across the overlap. Origin: measured: with twice as many
    ! loads change by 6e-4 at most, and no less with four times.
    integer, parameter :: n_places = 25
    ! Tuned [places]: the same for strips of another contact, which are farther off. Origin:
    ! measured: with 17 loads change by 4e-7 at most, with 5 by 5e-6.
    integer, parameter :: n_beside = 9
    ! Tuned [1]: by how much they reach beyond it, over its width. Origin: patches end within it.
    real(wp), parameter :: beyond = 0.05_wp

contains

    !> What strips at their places change of a gap.
    pure subroutine find_displaced(strips, compliance, overlap, y, h, x0, reach, height, slope, &
                                   bend, skew)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: overlap              !! up to which height bodies overlap, mm
        real(wp), intent(in) :: y(:)                 !! points of the gap, increasing, mm
        real(wp), intent(in) :: h(:)                 !! its heights, mm
        real(wp), intent(in) :: x0(:)                !! where the gap is least along x there, mm
        real(wp), intent(in) :: reach(:)             !! half-length of a patch there, > 0, mm
        real(wp), intent(out) :: height(:)           !! to add to the gap, mm
        real(wp), intent(out) :: slope(:)            !! its derivative over y
        real(wp), intent(out) :: bend(:)             !! to add to 1/(2 R), 1/mm
        real(wp), intent(out) :: skew(:)
            !! by how much the gap is higher at the end ahead of a patch than behind, mm

        type(status_t) :: status
        real(wp), dimension(n_places) :: place, ahead, tip, lower, curved, leaning, apart, &
            side_by_side, shifted, front, back, there
        real(wp) :: lower_slope(n_places), curved_slope(n_places), work(3*n_places), factor, at, &
            first, last, d1, d2
        integer :: i, s

        call find_overlap(y, h, overlap, first, last)
        place = [(first + (last - first)*i/(n_places - 1), i=0, n_places - 1)]
        do i = 1, n_places
            ahead(i) = value_between(y, x0, place(i))
            tip(i) = value_between(y, reach, place(i))
        end do
        lower = 0.0_wp
        curved = 0.0_wp
        leaning = 0.0_wp
        do s = 1, strips%n
            factor = compliance*strips%p0(s)
            apart = ahead - value_between(y, x0, &
                                          0.5_wp*(strips%y_left(s) + strips%y_right(s)))
            call find_column(0.0_wp*apart, side_by_side)
            call find_column(apart, shifted)
            call find_column(tip, there)
            call find_column(apart + tip, front)
            call find_column(apart - tip, back)
            lower = lower + factor*(shifted - side_by_side)
            curved = curved + factor*((0.5_wp*(front + back) - there) - (shifted - side_by_side))
            leaning = leaning + factor*(front - back)
        end do
        curved = curved/tip**2
        call spline_setup(place, lower, spline_not_a_knot, lower_slope, work, status)
        call spline_setup(place, curved, spline_not_a_knot, curved_slope, work, status)
        do i = 1, size(y)
            at = max(first, min(y(i), last))
            call spline_value(place, lower, lower_slope, at, height(i), slope(i), d2)
            call spline_value(place, curved, curved_slope, at, bend(i), d1, d2)
            skew(i) = value_between(place, leaning, at)
            if (y(i) < first .or. y(i) > last) slope(i) = 0.0_wp
        end do

    contains

        ! The influence of strip s.
        pure subroutine find_column(x, column)
            real(wp), intent(in) :: x(n_places)
            real(wp), intent(out) :: column(n_places)

            real(wp), dimension(n_places) :: d_x, d_half_length

            call influence_column_gradient(strips%half_length(s), strips%y_left(s), &
                                           strips%y_right(s), x, place, column, d_x, d_half_length)
        end subroutine find_column
    end subroutine find_displaced

    !> What strips of another contact press the bodies in by: the gap is that much higher, and bends
    !> along x less.
    pure subroutine add_pressed(strips, factor, origin, along, overlap, y, h, inv2r, height, &
                                slope, bend)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        real(wp), intent(in) :: factor               !! H of eq. (4) times what of it counts, 1/MPa
        real(wp), intent(in) :: origin(2)            !! of the gap in the strips' plane, mm
        real(wp), intent(in) :: along                !! advance there of its y
        real(wp), intent(in) :: overlap              !! up to which height bodies overlap, mm
        real(wp), intent(in) :: y(:)                 !! points of the gap, increasing, mm
        real(wp), intent(in) :: h(:)                 !! its heights, mm
        real(wp), intent(in) :: inv2r(:)             !! its 1/(2 R), 1/mm
        real(wp), intent(inout) :: height(:)         !! added to, mm
        real(wp), intent(inout) :: slope(:)          !! its derivative over y
        real(wp), intent(inout) :: bend(:)           !! added to, of 1/(2 R), 1/mm

        type(status_t) :: status
        real(wp), dimension(n_beside) :: place, there, column, ahead, behind, pressed, &
            pressed_slope, curved, curved_slope
        real(wp) :: work(3*n_beside), first, last, tip, at, value, d1, d2
        integer :: i, s

        call find_overlap(y, h, overlap, first, last)
        place = [(first + (last - first)*i/(n_beside - 1), i=0, n_beside - 1)]
        tip = sqrt(overlap/inv2r(minloc(h, dim=1)))
        there = origin(2) + along*place
        pressed = 0.0_wp
        curved = 0.0_wp
        do s = 1, strips%n
            call find_column(origin(1), column)
            call find_column(origin(1) + tip, ahead)
            call find_column(origin(1) - tip, behind)
            pressed = pressed + factor*strips%p0(s)*column
            curved = curved + factor*strips%p0(s)*(0.5_wp*(ahead + behind) - column)/tip**2
        end do
        call spline_setup(place, pressed, spline_not_a_knot, pressed_slope, work, status)
        call spline_setup(place, curved, spline_not_a_knot, curved_slope, work, status)
        do i = 1, size(y)
            at = max(first, min(y(i), last))
            call spline_value(place, pressed, pressed_slope, at, value, d1, d2)
            height(i) = height(i) + value
            if (y(i) >= first .and. y(i) <= last) slope(i) = slope(i) + d1
            call spline_value(place, curved, curved_slope, at, value, d1, d2)
            bend(i) = bend(i) + value
        end do

    contains

        ! The influence of strip s.
        pure subroutine find_column(at_x, influence)
            real(wp), intent(in) :: at_x
            real(wp), intent(out) :: influence(n_beside)

            real(wp), dimension(n_beside) :: xs, d_x, d_half_length

            xs = at_x
            call influence_column_gradient(strips%half_length(s), strips%y_left(s), &
                                           strips%y_right(s), xs, there, influence, d_x, &
                                           d_half_length)
        end subroutine find_column
    end subroutine add_pressed

    ! Where bodies overlap, and a little beyond, within a gap.
    pure subroutine find_overlap(y, h, overlap, first, last)
        real(wp), intent(in) :: y(:), h(:), overlap
        real(wp), intent(out) :: first, last

        real(wp) :: more
        integer :: i

        first = y(size(y))
        last = y(1)
        do i = 1, size(y)
            if (h(i) > overlap) cycle
            first = min(first, y(i) - rest(i, -1))
            last = max(last, y(i) + rest(i, 1))
        end do
        more = beyond*(last - first)
        first = max(first - more, y(1))
        last = min(last + more, y(size(y)))

    contains

        ! How far the overlap goes on beyond point i, to a point that it does not reach.
        pure real(wp) function rest(i, way)
            integer, intent(in) :: i, way

            integer :: next

            rest = 0.0_wp
            next = i + way
            if (next < 1 .or. next > size(y)) return
            if (h(next) > overlap) rest = abs(y(next) - y(i))*(overlap - h(i))/(h(next) - h(i))
        end function rest
    end subroutine find_overlap

    !> A value at a place between points, linearly.
    pure real(wp) function value_between(y, value, at) result(between)
        real(wp), intent(in) :: y(:)     !! points, increasing, mm
        real(wp), intent(in) :: value(:) !! there
        real(wp), intent(in) :: at       !! the place, within the points, mm

        integer :: i

        i = interval_of(y, at)
        between = value(i) + (value(i + 1) - value(i))*(at - y(i))/(y(i + 1) - y(i))
    end function value_between
end module faststrip_normal_strip_places
