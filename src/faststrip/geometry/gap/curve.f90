!> The undeformed gap as a curve: values between its points, its lowest point, and the intervals
!> in which it stays below a level.
!>
!> The height h(y) is the C2 cubic spline through the points, cut where they hold a step or a kink
!> (a wall, a fill value, the end of a body), so that it does not swing on its two sides
!> (`faststrip_numerics_torn_spline`); the longitudinal term A = 1/(2R), which jumps where a
!> profile's radius jumps, is linear between them. The curve is cut once into monotone pieces, so
!> that the level sets are found exactly, however small they are beside the distance of the points.
!>
!> Points that lie so close that their heights tell no slope are one that was measured or written
!> twice: of them the curve has the middle.
!>
!> Of a gap and its mirror image (y to -y) one counts as the image of the other (`side_of`),
!> and its curve is made from the other's: so the two curves agree to the last digit.
module faststrip_geometry_gap_curve
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_workspace_too_small, st_bad_argument
    use faststrip_numerics_reversal, only: reverse, reverse_negated, reverse_exchanged
    use faststrip_geometry_gap, only: gap_t, check_gap, check_gap_points
    use faststrip_geometry_gap_blocks, only: gap_blocks_t, reserve_blocks, set_blocks, &
                                             copy_blocks, extent, next_across, next_valley
    use faststrip_geometry_gap_pieces, only: cut_into_pieces, find_lowest
    use faststrip_numerics_torn_spline, only: torn_spline_setup, torn_spline_work_size
    implicit none
    private

    public :: gap_curve_t, gap_figures_t, reserve_gap_curve, set_gap_curve, set_gap_curve_points
    public :: copy_gap_curve, gap_at, gap_slopes, gap_curvature, level_intervals
    public :: mirror_gap_curve, valley_below
    public :: gap_inv2r, gap_inclination, inclination_change, largest_step, first_point_from

    !> The smallest longitudinal term in use, over the geometric mean of those that are positive.
    !> Tuned [1]. Origin: chosen; lengths go with the square root.
    real(wp), parameter :: flattest_ratio = 0.03_wp
    ! Points closer than this, over the mean distance of points, are one if their heights are as
    ! close, too: rounding of places, and what two scans of one place differ by.
    ! Tuned [1]. Origin: 1e-6 mm of rounding in points 0.05 mm apart.
    real(wp), parameter :: double_distance = 2.0e-5_wp
    ! Tuned [1]: heights, over the same distance. Origin: slopes to the next points change by as
    ! much, a hundredth of those of a patch.
    real(wp), parameter :: double_height = 1.0e-4_wp

    ! Tuned [1]: how much slopes may differ from that of the chord. Origin: an arc of 6 mm does so
    ! by 0.07 over 0.8 mm; a kink of twice as much is one of the profile.
    real(wp), parameter :: most_turn = 0.08_wp

    !> What a gap's curve knows besides its points.
    type :: gap_figures_t
        integer :: n = 0              !! number of points
        integer :: n_pieces = 0       !! number of monotone pieces, between n_pieces + 1 nodes
        real(wp) :: y_lowest = 0.0_wp !! where the gap is lowest, mm
        real(wp) :: h_lowest = 0.0_wp !! lowest height, mm
        real(wp) :: least_inv2r = 0.0_wp
            !! `gap_at` raises A to this, 1/mm; 0 if A is positive nowhere
        logical :: is_image = .false.  !! see `side_of`
        logical :: is_even = .false.   !! is it its own mirror image?
        logical :: has_steps = .false. !! is any interval a step?
        logical :: inclination_is_known = .false. !! does `inclination` count?
    end type gap_figures_t

    !> A gap ready to be evaluated; its arrays belong to the caller's workspace.
    type, extends(gap_figures_t) :: gap_curve_t
        integer :: version = 0   !! of what was set: changes whenever a gap is taken over
        real(wp), allocatable :: y(:), h(:)    !! points, mm
        real(wp), allocatable :: slope_from(:) !! h' of interval i at point i
        real(wp), allocatable :: slope_to(:)   !! h' of interval i at point i + 1
        logical, allocatable :: is_step(:)     !! is interval i a step, which no curve goes through?
        real(wp), allocatable :: inv2r(:)      !! A = 1/(2R) at the points, 1/mm
        integer, allocatable :: even_to(:)     !! last point up to which A is that of point i
        real(wp), allocatable :: inclination(:) !! of the surfaces from the tangent plane, rad
        type(gap_blocks_t) :: inclined         !! blocks of these
        real(wp), allocatable :: y_node(:), h_node(:) !! ends of the monotone pieces, mm
        type(gap_blocks_t) :: blocks           !! of these ends
        ! For taking over a gap.
        real(wp), allocatable :: bend(:)       ! h'' at the points, by three of them, 1/mm
        logical, allocatable :: is_torn(:)     ! does a step or a kink touch the point?
        real(wp), allocatable :: work(:)       ! for the spline
    end type gap_curve_t

contains

    !> Allocate for gaps of up to `max_points` points.
    subroutine reserve_gap_curve(curve, max_points, status)
        type(gap_curve_t), intent(inout) :: curve !! emptied and sized
        integer, intent(in) :: max_points         !! >= 5
        type(status_t), intent(out) :: status     !! `st_bad_argument`

        call clear_status(status)
        if (max_points < 5) then ! Given: fewest points of a gap
            call set_status(status, st_bad_argument, 'capacity for gap points must be at ' // &
                            'least 5, got ' // count_text(max_points))
            return
        end if
        curve%n = 0
        curve%n_pieces = 0
        if (allocated(curve%y)) then
            if (size(curve%y) >= max_points) return
            deallocate (curve%y, curve%h, curve%slope_from, curve%slope_to, curve%inv2r, &
                        curve%inclination, curve%y_node, curve%h_node, curve%bend, curve%work, &
                        curve%is_step, curve%is_torn, curve%even_to)
        end if
        allocate (curve%y(max_points), curve%h(max_points), curve%slope_from(max_points), &
                  curve%slope_to(max_points), curve%inv2r(max_points), &
                  curve%inclination(max_points), &
                  curve%y_node(3*max_points), curve%h_node(3*max_points), &
                  curve%bend(max_points), curve%work(torn_spline_work_size(max_points)), &
                  source=0.0_wp)
        call reserve_blocks(curve%blocks, size(curve%h_node))
        call reserve_blocks(curve%inclined, max_points)
        allocate (curve%even_to(max_points), source=0)
        allocate (curve%is_step(max_points), curve%is_torn(max_points), source=.false.)
    end subroutine reserve_gap_curve

    !> Take over a gap: check it, fit the spline, cut it into monotone pieces. Allocates nothing.
    subroutine set_gap_curve(curve, gap, status)
        type(gap_curve_t), intent(inout) :: curve !! reserved beforehand
        type(gap_t), intent(in) :: gap            !! points of the gap, mm
        type(status_t), intent(out) :: status     !! those of `check_gap`, `st_workspace_too_small`

        call check_gap(gap, status)
        if (is_error(status)) return
        if (allocated(gap%inclination)) then
            call take_points(curve, gap%y, gap%h, gap%inv2r, status, gap%inclination)
        else
            call take_points(curve, gap%y, gap%h, gap%inv2r, status)
        end if
    end subroutine set_gap_curve

    !> The same from plain arrays. Where slopes are given that fit the heights, the curve has them:
    !> each interval is the cubic of its two ends.
    subroutine set_gap_curve_points(curve, y, h, inv2r, status, inclination, slope)
        type(gap_curve_t), intent(inout) :: curve !! reserved beforehand
        real(wp), intent(in) :: y(:)              !! lateral coordinate, strictly increasing, mm
        real(wp), intent(in) :: h(:)              !! gap on the line x = 0, mm
        real(wp), intent(in) :: inv2r(:)          !! 1/(2 R), R the local radius along x, 1/mm
        type(status_t), intent(out) :: status     !! those of `check_gap`, `st_workspace_too_small`
        real(wp), intent(in), optional :: inclination(:)
            !! of the surfaces from y = 0 on, finite, rad
        real(wp), intent(in), optional :: slope(:) !! h' at the points

        call check_capacity(curve, size(y), status)
        if (.not. is_error(status)) call check_gap_points(y, h, inv2r, status, inclination)
        if (is_error(status)) return
        call take_points(curve, y, h, inv2r, status, inclination, slope)
    end subroutine set_gap_curve_points

    !> The same from a curve that was set: nothing is checked or fitted again. Allocates nothing.
    subroutine copy_gap_curve(from, to, status)
        type(gap_curve_t), intent(in) :: from  !! a gap that was set
        type(gap_curve_t), intent(inout) :: to !! reserved beforehand
        type(status_t), intent(out) :: status  !! `st_workspace_too_small`

        integer :: n, nodes

        call check_capacity(to, from%n, status)
        if (is_error(status)) return
        n = from%n
        nodes = from%n_pieces + 1
        to%version = next_version(to)
        to%gap_figures_t = from%gap_figures_t
        if (n == 0) return
        to%y(:n) = from%y(:n)
        to%h(:n) = from%h(:n)
        to%slope_from(:n) = from%slope_from(:n)
        to%slope_to(:n) = from%slope_to(:n)
        to%is_step(:n) = from%is_step(:n)
        to%inv2r(:n) = from%inv2r(:n)
        to%even_to(:n) = from%even_to(:n)
        if (from%inclination_is_known) then
            to%inclination(:n) = from%inclination(:n)
            call copy_blocks(from%inclined, to%inclined, n)
        end if
        call copy_blocks(from%blocks, to%blocks, nodes)
        to%y_node(:nodes) = from%y_node(:nodes)
        to%h_node(:nodes) = from%h_node(:nodes)
    end subroutine copy_gap_curve

    !> The number of the next gap that is taken over.
    pure integer function next_version(curve)
        type(gap_curve_t), intent(in) :: curve

        next_version = 1
        if (curve%version < huge(1)) next_version = curve%version + 1
    end function next_version

    !> Up to which point A stays what it is at each of them.
    pure subroutine find_even_parts(curve)
        type(gap_curve_t), intent(inout) :: curve ! its points are set

        integer :: i, last

        last = curve%n
        curve%even_to(last) = last
        do i = last - 1, 1, -1
            if (curve%inv2r(i + 1) /= curve%inv2r(i)) last = i
            curve%even_to(i) = last
        end do
    end subroutine find_even_parts

    !> Make one point of those that were written twice.
    pure subroutine join_doubles(curve, n)
        type(gap_curve_t), intent(inout) :: curve ! its points are set
        integer, intent(inout) :: n               ! their number

        integer :: i, first, kept
        real(wp) :: near, nearest, alike

        near = double_distance*(curve%y(n) - curve%y(1))/(n - 1)
        nearest = near
        do i = 2, n
            nearest = min(nearest, curve%y(i) - curve%y(i - 1))
        end do
        if (nearest >= near) return
        alike = double_height*(curve%y(n) - curve%y(1))/(n - 1)
        kept = 1
        do i = 2, n
            if (.not. is_double(i)) kept = kept + 1
        end do
        if (kept == n .or. kept < 5) return ! Given: fewest points of a gap
        kept = 0
        first = 1
        do i = 1, n
            if (i < n) then
                if (is_double(i + 1)) cycle
            end if
            kept = kept + 1
            call take_middle(curve%y)
            call take_middle(curve%h)
            call take_middle(curve%inv2r)
            if (curve%inclination_is_known) call take_middle(curve%inclination)
            first = i + 1
        end do
        n = kept

    contains

        !> Is a point the one before once more?
        pure logical function is_double(i)
            integer, intent(in) :: i

            is_double = curve%y(i) - curve%y(i - 1) <= near &
                        .and. abs(curve%h(i) - curve%h(i - 1)) <= alike
        end function is_double

        pure subroutine take_middle(values)
            real(wp), intent(inout) :: values(:)

            values(kept) = 0.5_wp*(values(first) + values(i))
        end subroutine take_middle
    end subroutine join_doubles

    subroutine take_points(curve, y, h, inv2r, status, inclination, slope)
        type(gap_curve_t), intent(inout) :: curve
        real(wp), intent(in) :: y(:), h(:), inv2r(:)
        type(status_t), intent(inout) :: status
        real(wp), intent(in), optional :: inclination(:), slope(:)

        integer :: n, side
        logical :: has_slopes

        n = size(y)
        curve%n = 0
        curve%version = next_version(curve)
        call check_capacity(curve, n, status)
        if (is_error(status)) return
        side = side_of(y, h, inv2r)
        curve%is_even = side == 0
        curve%inclination_is_known = present(inclination)
        if (side < 0) then
            curve%y(:n) = -y(n:1:-1)
            curve%h(:n) = h(n:1:-1)
            curve%inv2r(:n) = inv2r(n:1:-1)
            if (present(inclination)) curve%inclination(:n) = -inclination(n:1:-1)
        else
            curve%y(:n) = y
            curve%h(:n) = h
            curve%inv2r(:n) = inv2r
            if (present(inclination)) curve%inclination(:n) = inclination
        end if
        has_slopes = present(slope)
        if (has_slopes) has_slopes = slopes_fit(y, h, slope)
        if (has_slopes) then
            call set_slopes(curve, slope, side < 0)
        else
            call join_doubles(curve, n)
            call torn_spline_setup(curve%y(:n), curve%h(:n), curve%slope_from(:n), &
                                   curve%slope_to(:n), curve%bend(:n), curve%is_torn(:n), &
                                   curve%is_step(:n), curve%has_steps, curve%work, status)
            if (is_error(status)) return
        end if
        curve%least_inv2r = flattest_ratio*usual_inv2r(curve%inv2r(:n))
        curve%n = n
        curve%is_image = .false.
        call cut_into_pieces(n, curve%y, curve%h, curve%bend, curve%slope_from, curve%slope_to, &
                             curve%work, curve%y_node, curve%h_node, curve%n_pieces)
        call find_lowest(curve%y_node(:curve%n_pieces + 1), curve%h_node(:curve%n_pieces + 1), &
                         curve%y_lowest, curve%h_lowest)
        if (side < 0) then
            call mirror_gap_curve(curve)
        else
            call set_blocks(curve%blocks, curve%h_node(:curve%n_pieces + 1))
            call find_even_parts(curve)
            if (curve%inclination_is_known) &
                call set_blocks(curve%inclined, curve%inclination(:n))
        end if
    end subroutine take_points

    !> Is the curve of these slopes near to its chords everywhere? Where it is not there is a step
    !> or a kink, of which slopes at points tell nothing.
    pure logical function slopes_fit(y, h, slope) result(fit)
        real(wp), intent(in) :: y(:), h(:), slope(:)

        real(wp) :: secant, worst
        integer :: i

        worst = 0.0_wp
        do i = 1, size(y) - 1
            secant = (h(i + 1) - h(i))/(y(i + 1) - y(i))
            worst = max(worst, abs(slope(i) - secant), abs(slope(i + 1) - secant))
        end do
        fit = worst <= most_turn
    end function slopes_fit

    !> The curve through the points with these slopes, or with those of the mirror image.
    pure subroutine set_slopes(curve, slope, is_mirrored)
        type(gap_curve_t), intent(inout) :: curve ! its points are set
        real(wp), intent(in) :: slope(:)
        logical, intent(in) :: is_mirrored

        integer :: i

        associate (n => size(slope))
            do i = 1, n
                if (is_mirrored) then
                    curve%slope_from(i) = -slope(n + 1 - i)
                else
                    curve%slope_from(i) = slope(i)
                end if
            end do
            curve%slope_to(:n - 1) = curve%slope_from(2:n)
            ! Nothing swings.
            curve%bend(:n) = huge(1.0_wp)
            curve%is_step(:n) = .false.
        end associate
        curve%has_steps = .false.
    end subroutine set_slopes

    !> Returns -1 where the gap counts as a mirror image, 1 where its mirror image does, 0 where it
    !> is its own. The image is that which is lower, or has its point farther from y = 0, or the
    !> smaller longitudinal term, at the first point that tells it from the other.
    pure integer function side_of(y, h, inv2r) result(side)
        real(wp), intent(in) :: y(:), h(:), inv2r(:)

        integer :: i, j

        side = 0
        do i = 1, size(y)
            j = size(y) + 1 - i
            if (h(i) /= h(j)) then
                side = merge(-1, 1, h(i) < h(j))
                return
            else if (y(i) /= -y(j)) then
                side = merge(-1, 1, y(i) < -y(j))
                return
            else if (inv2r(i) /= inv2r(j)) then
                side = merge(-1, 1, inv2r(i) < inv2r(j))
                return
            end if
        end do
    end function side_of

    !> Mirror a curve, y to -y; twice gives the same curve to the last digit.
    pure subroutine mirror_gap_curve(curve)
        type(gap_curve_t), intent(inout) :: curve !! a gap that was set

        integer :: n, nodes

        n = curve%n
        nodes = curve%n_pieces + 1
        call reverse_negated(curve%y(:n))
        call reverse(curve%h(:n))
        call reverse(curve%inv2r(:n))
        call reverse_exchanged(curve%slope_from(:n - 1), curve%slope_to(:n - 1))
        if (curve%has_steps) call reverse(curve%is_step(:n - 1))
        call reverse_negated(curve%y_node(:nodes))
        call reverse(curve%h_node(:nodes))
        call set_blocks(curve%blocks, curve%h_node(:nodes))
        call find_even_parts(curve)
        if (curve%inclination_is_known) then
            call reverse_negated(curve%inclination(:n))
            call set_blocks(curve%inclined, curve%inclination(:n))
        end if
        curve%y_lowest = -curve%y_lowest
        curve%is_image = .not. curve%is_image
    end subroutine mirror_gap_curve

    !> Refuse more points than there is capacity for; the points themselves are not looked at.
    pure subroutine check_capacity(curve, n, status)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: n
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. allocated(curve%y)) then
            call set_status(status, st_workspace_too_small, 'no workspace was reserved for the gap')
        else if (n > size(curve%y)) then
            call set_status(status, st_workspace_too_small, 'the gap must have at most ' // &
                            trim(count_text(size(curve%y))) // &
                            ' points, for which capacity was reserved, got ' // count_text(n))
        end if
    end subroutine check_capacity

    !> Geometric mean of the terms that are positive; the least of all where no other is so much
    !> larger that it matters; 0 if none is.
    pure real(wp) function usual_inv2r(inv2r) result(usual)
        real(wp), intent(in) :: inv2r(:)

        real(wp) :: largest, total, unit
        integer :: i, n

        usual = inv2r(1)
        largest = usual
        do i = 2, size(inv2r)
            usual = min(usual, inv2r(i))
            largest = max(largest, inv2r(i))
        end do
        if (usual >= flattest_ratio*largest .and. usual > 0.0_wp) return
        ! In a power of two for a unit, so that other units of length leave the digits as they are.
        usual = 0.0_wp
        unit = scale(1.0_wp, exponent(largest) - 1)
        total = 0.0_wp
        n = 0
        do i = 1, size(inv2r)
            if (inv2r(i) <= 0.0_wp) cycle
            n = n + 1
            total = total + log(max(inv2r(i)/unit, tiny(1.0_wp)))
        end do
        if (n > 0) usual = unit*exp(total/n)
    end function usual_inv2r

    !> Height and longitudinal term of the gap; outside the points those of the nearest one.
    !>
    !> A term below 3 % of the gap's geometric mean is raised to that: strips would become more
    !> than six times as long as usual, and endless where it is not positive. `gap_inv2r` tells it
    !> as it was given.
    pure subroutine gap_at(curve, y, h, inv2r, near)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y              !! lateral position, mm
        real(wp), intent(out) :: h             !! height, mm
        real(wp), intent(out) :: inv2r         !! A = 1/(2R), 1/mm
        integer, intent(inout), optional :: near
            !! of places from left to right: interval of the last one, 0: none; that of this one

        integer :: i
        real(wp) :: t

        if (y <= curve%y(1)) then
            h = curve%h(1)
            inv2r = curve%inv2r(1)
        else if (y >= curve%y(curve%n)) then
            h = curve%h(curve%n)
            inv2r = curve%inv2r(curve%n)
        else
            if (present(near)) then
                i = near
                call go_on_to(curve, y, i)
                near = i
            else
                i = interval_of(curve, y)
            end if
            t = (y - curve%y(i))/(curve%y(i + 1) - curve%y(i))
            h = height(curve, i, t)
            inv2r = curve%inv2r(i) + t*(curve%inv2r(i + 1) - curve%inv2r(i))
        end if
        inv2r = max(inv2r, curve%least_inv2r)
    end subroutine gap_at

    !> Slopes of the gap at places; outside the points those at the nearest one, at a kink the mean
    !> of its two sides. Those of a mirror image are the negative to the last digit.
    pure subroutine gap_slopes(curve, y, slope)
        type(gap_curve_t), intent(in) :: curve   !! a gap that was set
        real(wp), intent(in) :: y(:)             !! lateral positions, increasing, mm
        real(wp), intent(inout) :: slope(:)      !! h' at each

        ! Given: of the slope of a cubic between two heights.
        real(wp), parameter :: cubic = 6.0_wp
        integer :: i, k
        real(wp) :: dy, t, u

        if (size(y) == 0) return
        i = interval_of(curve, y(1))
        do k = 1, size(y)
            do while (i < curve%n - 1)
                if (y(k) < curve%y(i + 1)) exit
                i = i + 1
            end do
            if (y(k) <= curve%y(1)) then
                slope(k) = curve%slope_from(1)
            else if (y(k) >= curve%y(curve%n)) then
                slope(k) = curve%slope_to(curve%n - 1)
            else if (y(k) <= curve%y(i)) then
                slope(k) = 0.5_wp*(curve%slope_to(i - 1) + curve%slope_from(i))
            else
                dy = curve%y(i + 1) - curve%y(i)
                t = (y(k) - curve%y(i))/dy
                u = (curve%y(i + 1) - y(k))/dy
                slope(k) = (curve%slope_from(i)*(u*(u - 2.0_wp*t)) &
                            + curve%slope_to(i)*(t*(t - 2.0_wp*u))) &
                           + cubic*(t*u)*((curve%h(i + 1) - curve%h(i))/dy)
            end if
        end do
    end subroutine gap_slopes

    !> The longitudinal term as it was given, 1/mm; outside the points that of the nearest one.
    pure real(wp) function gap_inv2r(curve, y) result(inv2r)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y              !! lateral position, mm

        inv2r = between_points(curve, curve%inv2r, y)
    end function gap_inv2r

    !> How far the surfaces have turned from the tangent plane at y = 0, rad; zero if it is not
    !> known, or without a gap.
    pure real(wp) function gap_inclination(curve, y) result(inclination)
        type(gap_curve_t), intent(in) :: curve !! a gap, or none
        real(wp), intent(in) :: y              !! lateral position, mm

        inclination = 0.0_wp
        if (curve%n > 0 .and. curve%inclination_is_known) &
            inclination = between_points(curve, curve%inclination, y)
    end function gap_inclination

    !> Values at the points, linear between them and constant beyond.
    pure real(wp) function between_points(curve, values, y) result(value)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: values(:)
        real(wp), intent(in) :: y

        integer :: i
        real(wp) :: t

        i = interval_of(curve, y)
        t = (y - curve%y(i))/(curve%y(i + 1) - curve%y(i))
        t = max(0.0_wp, min(1.0_wp, t))
        value = values(i) + t*(values(i + 1) - values(i))
    end function between_points

    !> By how much the inclination changes between two places, rad; zero if it is not known.
    pure real(wp) function inclination_change(curve, y_from, y_to) result(inclination)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y_from         !! left place, mm
        real(wp), intent(in) :: y_to           !! right place, mm

        integer :: first, last

        inclination = 0.0_wp
        if (.not. curve%inclination_is_known) return
        first = interval_of(curve, y_from)
        last = interval_of(curve, y_to) + 1
        inclination = extent(curve%inclined, curve%inclination(:curve%n), first, last)
    end function inclination_change

    !> The steps of the gap that lie between two places or reach into that range. Their height is
    !> over what the slopes beside them lead to; zero if there is none.
    pure subroutine largest_step(curve, y_from, y_to, highest, steepest, y)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y_from         !! left place, mm
        real(wp), intent(in) :: y_to           !! right place, mm
        real(wp), intent(out) :: highest       !! of the steps, mm
        real(wp), intent(out) :: steepest      !! height of a step over its length
        real(wp), intent(out) :: y             !! lower end of the highest, mm

        real(wp) :: step, dy, slope, before, behind
        integer :: i, first, last

        highest = 0.0_wp
        steepest = 0.0_wp
        y = y_from
        if (.not. curve%has_steps) return
        last = 0
        do i = interval_of(curve, y_from), curve%n - 1
            if (curve%y(i) >= y_to) exit
            if (.not. curve%is_step(i) .or. curve%y(i + 1) <= y_from) cycle
            dy = curve%y(i + 1) - curve%y(i)
            if (i > last) call find_row(curve, i, first, last, before, behind)
            ! In a row of steps the slope goes over from one side's to the other's.
            slope = 0.5_wp*(before + behind)
            if (first < last) slope = before + (behind - before) &
                *(0.5_wp*(curve%y(i) + curve%y(i + 1)) - curve%y(first)) &
                /(curve%y(last + 1) - curve%y(first))
            step = abs(curve%h(i + 1) - curve%h(i) - slope*dy)
            steepest = max(steepest, step/dy)
            if (step <= highest) cycle
            highest = step
            y = curve%y(merge(i, i + 1, curve%h(i) < curve%h(i + 1)))
        end do
    end subroutine largest_step

    !> The row of steps that interval i belongs to, and the slopes on both its sides. The intervals
    !> at the ends of the points are no steps.
    pure subroutine find_row(curve, i, first, last, before, behind)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: i
        integer, intent(out) :: first, last      ! intervals of the row
        real(wp), intent(out) :: before, behind  ! slopes

        first = i
        do while (curve%is_step(first - 1))
            first = first - 1
        end do
        last = i
        do while (curve%is_step(last + 1))
            last = last + 1
        end do
        before = curve%slope_to(first - 1)
        behind = curve%slope_from(last + 1)
    end subroutine find_row

    !> Half the second derivative of the height, the B of a Hertzian gap `A x^2 + B y^2`, 1/mm.
    pure real(wp) function gap_curvature(curve, y) result(b)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y              !! lateral position, taken into the range, mm

        integer :: i
        real(wp) :: t, dy, secant, c2, c3

        i = interval_of(curve, y)
        ! At the foot of a step the curvature is that of the side which is no step.
        if (curve%is_step(i) .and. y <= curve%y(i) .and. i > 1) i = i - 1
        dy = curve%y(i + 1) - curve%y(i)
        t = min(max((y - curve%y(i))/dy, 0.0_wp), 1.0_wp)
        secant = curve%h(i + 1) - curve%h(i)
        c3 = (curve%slope_from(i) + curve%slope_to(i))*dy - 2.0_wp*secant
        c2 = secant - curve%slope_from(i)*dy - c3
        b = (c2 + 3.0_wp*c3*t)/dy**2
    end function gap_curvature

    !> The intervals in which the gap is below a level, in the order of y.
    !>
    !> The ends are exact roots of the spline; an interval that runs out of the data ends there.
    pure subroutine level_intervals(curve, level, y_from, y_to, n)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: level          !! height, mm
        real(wp), intent(inout) :: y_from(:)   !! left ends, mm; the first `n` count
        real(wp), intent(inout) :: y_to(:)     !! right ends, mm
        integer, intent(out) :: n              !! number of intervals; at most size(y_from),
                                               !! further ones to the right are left out
        integer :: j
        logical :: inside

        n = 0
        inside = curve%h_node(1) < level
        if (inside) then
            n = 1
            y_from(1) = curve%y_node(1)
        end if
        j = 1
        do
            j = next_across(curve%blocks, curve%h_node(:curve%n_pieces + 1), j + 1, level, inside)
            if (j > curve%n_pieces + 1) exit
            if (inside) then
                y_to(n) = crossing(curve, j - 1, level)
            else
                if (n == size(y_from)) return
                n = n + 1
                y_from(n) = crossing(curve, j - 1, level)
            end if
            inside = .not. inside
        end do
        if (inside) y_to(n) = curve%y_node(curve%n_pieces + 1)
    end subroutine level_intervals

    !> The first end of two monotone pieces, from one on, that is a valley below a level: its number
    !> among the ends, 2 to n_pieces; more than n_pieces if there is none.
    pure integer function valley_below(curve, level, from) result(node)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: level          !! height, mm
        integer, intent(in) :: from            !! where to begin, 1 to n_pieces + 1

        node = next_valley(curve%blocks, curve%h_node(:curve%n_pieces + 1), from, level)
    end function valley_below

    !> Where monotone piece j crosses a level that its two ends enclose: by Newton's steps, halvings
    !> where they leave what encloses the crossing.
    pure real(wp) function crossing(curve, j, level) result(y)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: j
        real(wp), intent(in) :: level

        integer :: i, k
        real(wp) :: low, high, dy, c1, c2, c3, t, before, f, slope
        logical :: rising

        low = curve%y_node(j)
        high = curve%y_node(j + 1)
        i = interval_of(curve, 0.5_wp*(low + high))
        dy = curve%y(i + 1) - curve%y(i)
        call find_cubic(curve, i, c1, c2, c3)
        low = (low - curve%y(i))/dy
        high = (high - curve%y(i))/dy
        rising = curve%h_node(j + 1) > curve%h_node(j)
        t = low + (high - low)*((level - curve%h_node(j))/(curve%h_node(j + 1) - curve%h_node(j)))
        do k = 1, most_steps
            f = (curve%h(i) - level) + t*(c1 + t*(c2 + t*c3))
            slope = c1 + t*(2.0_wp*c2 + 3.0_wp*t*c3)
            if ((f > 0.0_wp) .eqv. rising) then
                high = t
            else
                low = t
            end if
            before = t
            t = 0.5_wp*(low + high)
            if (abs(f) < merge(slope, -slope, rising)*(high - low)) t = before - f/slope
            if (abs(t - before) <= epsilon(1.0_wp)*max(abs(low), abs(high))) exit
        end do
        y = curve%y(i) + t*dy
    end function crossing

    !> The first point at or to the right of a position: 1 to n + 1.
    pure integer function first_point_from(curve, y) result(first)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: y              !! lateral position, mm

        if (y <= curve%y(1)) then
            first = 1
        else if (y > curve%y(curve%n)) then
            first = curve%n + 1
        else
            first = interval_of(curve, y)
            if (curve%y(first) < y) first = first + 1
        end if
    end function first_point_from

    !> Index i of the point interval that holds y, with y_i <= y < y_(i+1) inside the data.
    pure integer function interval_of(curve, y) result(i)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y

        integer :: high, middle

        i = 1
        high = curve%n
        if (y > curve%y(1) .and. y < curve%y(high)) then
            ! Points are mostly even: there, or one beside.
            middle = 1 + int((y - curve%y(1))/(curve%y(high) - curve%y(1))*(high - 1))
            middle = min(middle, high - 1)
            if (y >= curve%y(middle)) then
                i = middle
                if (y < curve%y(middle + 1)) high = middle + 1
            else
                high = middle
                if (y >= curve%y(middle - 1)) i = middle - 1
            end if
        end if
        do while (high - i > 1)
            middle = (i + high)/2
            if (y >= curve%y(middle)) then
                i = middle
            else
                high = middle
            end if
        end do
    end function interval_of

    !> The same from the interval of a place before it, 0: none.
    pure subroutine go_on_to(curve, y, i)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y ! inside the data
        integer, intent(inout) :: i

        if (i > 0) then
            if (y < curve%y(i)) i = 0
        end if
        if (i == 0) i = interval_of(curve, y)
        do while (y >= curve%y(i + 1))
            i = i + 1
        end do
    end subroutine go_on_to

    !> Height in interval i at the local coordinate t of 0 to 1.
    pure real(wp) function height(curve, i, t) result(h)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: i
        real(wp), intent(in) :: t

        real(wp) :: c1, c2, c3

        call find_cubic(curve, i, c1, c2, c3)
        h = curve%h(i) + t*(c1 + t*(c2 + t*c3))
    end function height

    !> The cubic of interval i over its left point: coefficients of the powers of t.
    pure subroutine find_cubic(curve, i, c1, c2, c3)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: i
        real(wp), intent(out) :: c1, c2, c3

        real(wp) :: dy, secant

        dy = curve%y(i + 1) - curve%y(i)
        secant = curve%h(i + 1) - curve%h(i)
        c1 = curve%slope_from(i)*dy
        c3 = (curve%slope_from(i) + curve%slope_to(i))*dy - 2.0_wp*secant
        c2 = secant - c1 - c3
    end subroutine find_cubic
end module faststrip_geometry_gap_curve
