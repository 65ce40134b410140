!> The outline of a wheel over its rail, looked at where something can touch.
!>
!> The points of the outline are those of the wheel's profile. They are looked at in cells, and of
!> each cell the least height over the rail is kept. When the wheelset moves, that height can
!> shrink by no more than the motion allows: by the cell's own fall and by its way to the side times
!> the steepest slope of the rail nearby. Only cells that may be low enough are looked at again, so
!> that a step of a vehicle costs what its contacts cost; what is found is what all points would
!> tell.
!>
!> With the roll phi and the yaw psi a point of the outline at the lever eta, on a circle of radius
!> rho where the profile's slope is S, moves in a step by no more than
!> `dy = |dy0| + eta (psi dpsi + phi dphi) + rho ((1 + S psi**2 phi) dphi + S psi (2 + S phi) dpsi)`
!> to the side and by
!> `dz = eta (dphi + psi phi dpsi) + rho ((phi + S psi**2) dphi + S psi (S + 2 phi) dpsi)` down,
!> where the terms of the yaw grow by `1/cos(theta)`, theta the angle by which the outline is ahead.
!>
!> Over a roller of radius R the outline depends on the height as well: it is that of a wheel that
!> is lowered so far. A point that lies `phi_r <= psi (eta + 3/2 S rho)/R` off the top then moves by
!> less than `(1 + |S|) phi_r (phi_r + psi + phi) dz` beside the lowering itself. Yaw moves a wheel
!> off the top besides: by less than `(1 + |S|) (1 + eta/R) eta psi dpsi`. All of it counts twice.
module faststrip_geometry_wheel_outline
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, equal_within
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, outline_point, rail_height, &
                                                rail_span, steepest_rail
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, wheelset_axes
    implicit none
    private

    public :: outline_t, reserve_outline, move_outline, lower_outline, see_points, see_point
    public :: may_be_lower, look_whether_lower, lowest_height, lowered_axes, cell_of, cell_end

    ! Tuned [points]: in a cell. Origin: measured: with half as many a step of a wheelset costs 2 %
    ! more, with twice as many it costs the same.
    integer, parameter :: cell_points = 16
    ! Tuned [mm]: way to the side over which the rail's slope is taken as bounded by that around a
    ! cell. Origin: chosen: rails bend little over it, and a cell is looked at once in a hundred
    ! steps of 10 um.
    real(wp), parameter :: largest_way = 1.0_wp
    ! Tuned [1]: sine of theta beyond which a cell is always looked at. Origin: safeguard: the
    ! bounds have 1/cos(theta), and the outline ends at 1.
    real(wp), parameter :: farthest_ahead = 0.7_wp
    ! Given: 1/cos(theta) there, rounded up.
    real(wp), parameter :: most_ahead = 1.5_wp
    ! Tuned [1]: bounds over a roller, over those above. Origin: safeguard: they are of first order;
    ! walks at random find no point that is missed with 1.
    real(wp), parameter :: on_roller = 2.0_wp

    !> The outline of a wheel over its rail; the points are those of the wheel's profile, and of
    !> those that were seen.
    type :: outline_t
        type(wheelset_state_t) :: state     !! of it, as of a right wheel, at z = 0
        type(wheelset_axes_t) :: axes       !! of the state
        logical :: has_state = .false.      !! is there one?
        real(wp) :: mark = 0.0_wp           !! of the pair it was reserved for, mm
        real(wp), allocatable :: x(:)       !! in the track, mm
        real(wp), allocatable :: y(:)       !! the same, mm
        real(wp), allocatable :: z(:)       !! the same, at z = 0, mm
        real(wp), allocatable :: slope(:)   !! dz/dy of the outline in the track
        real(wp), allocatable :: height(:)  !! of the wheel's point over the rail, mm
        real(wp), allocatable :: below(:)   !! dz/dy of the rail below it
        logical, allocatable :: is_there(:) !! is there an outline, over the rail?
        logical, allocatable :: is_seen(:)  !! are the points of a cell those of the state?
        real(wp), allocatable :: low(:)     !! no point of a cell is lower over the rail, mm
        real(wp), allocatable :: way(:)     !! how far it may go to the side until it is, mm
        real(wp), allocatable :: steep(:)   !! steepest slope of the rail that far around it
        real(wp), allocatable :: lever(:)   !! longest of a cell from the wheelset's centre, mm
        real(wp), allocatable :: bend(:)    !! steepest slope of the wheel's profile in it
        real(wp) :: largest_radius = 0.0_wp !! of the wheel, mm
        real(wp) :: roller_radius = 0.0_wp  !! of the roller below it, mm; 0: a rail
        real(wp) :: lowered = 0.0_wp        !! over a roller: how far below the state, mm
    end type outline_t

contains

    !> Allocate for the outline of a pair.
    subroutine reserve_outline(outline, pair)
        type(outline_t), intent(inout) :: outline !! sized
        type(wheel_on_rail_t), intent(in) :: pair !! made

        integer :: n, cells, cell, first, last

        n = size(pair%y)
        cells = cell_of(n)
        outline%has_state = .false.
        outline%mark = pair%mark
        if (allocated(outline%x)) then
            if (size(outline%x) /= n) &
                deallocate (outline%x, outline%y, outline%z, outline%slope, outline%height, &
                            outline%below, outline%is_there, outline%is_seen, outline%low, &
                            outline%way, &
                            outline%steep, outline%lever, outline%bend)
        end if
        if (.not. allocated(outline%x)) then
            allocate (outline%x(n), outline%y(n), outline%z(n), outline%slope(n), &
                      outline%height(n), outline%below(n), outline%low(cells), outline%way(cells), &
                      outline%steep(cells), outline%lever(cells), outline%bend(cells), &
                      source=0.0_wp)
            allocate (outline%is_there(n), outline%is_seen(cells), source=.false.)
        end if
        do cell = 1, cells
            first = (cell - 1)*cell_points + 1
            last = min(first + cell_points - 1, n)
            outline%lever(cell) = maxval(abs(pair%y_line + pair%y(first:last)))
            outline%bend(cell) = maxval(abs(pair%slope(first:last)))
        end do
        outline%largest_radius = pair%radius + maxval(pair%z) - pair%z_line
        outline%roller_radius = pair%roller_radius
        outline%lowered = 0.0_wp
    end subroutine reserve_outline

    !> The number of a point's cell.
    elemental integer function cell_of(point)
        integer, intent(in) :: point !! number of a point

        cell_of = (point - 1)/cell_points + 1
    end function cell_of

    !> The last point of a point's cell.
    pure integer function cell_end(outline, point)
        type(outline_t), intent(in) :: outline !! reserved
        integer, intent(in) :: point           !! number of a point

        cell_end = min(cell_of(point)*cell_points, size(outline%x))
    end function cell_end

    !> The outline at another state: what was known of its cells counts as far as it can have moved.
    pure subroutine move_outline(outline, state, radius)
        type(outline_t), intent(inout) :: outline     !! reserved
        type(wheelset_state_t), intent(in) :: state   !! as of a right wheel; its z does not count
        real(wp), intent(in) :: radius                !! mean of the nominal radii, mm

        real(wp) :: roll, yaw, d_roll, d_yaw, aside, down, more, s, yawed, tilt
        integer :: cell

        ! Where a wheel touches a roller is then found alike whatever was before.
        call lower_outline(outline, 0.0_wp)
        associate (before => outline%state)
            yaw = max(abs(state%yaw), abs(before%yaw))
            roll = max(abs(state%roll), abs(before%roll))
            d_yaw = abs(state%yaw - before%yaw)
            d_roll = abs(state%roll - before%roll)
            if (outline%has_state .and. state%rail(1)%roll == before%rail(1)%roll) then
                yawed = most_ahead*d_yaw*tan(yaw)
                tilt = tan(yaw)**2
                do cell = 1, size(outline%low)
                    s = outline%bend(cell)
                    aside = abs(state%y - before%y) + abs(state%rail(1)%y - before%rail(1)%y) &
                            + outline%lever(cell)*(yawed + d_roll*roll) &
                            + outline%largest_radius*(d_roll*(1.0_wp + s*tilt*roll) &
                                                      + s*yawed*(2.0_wp + s*roll))
                    down = abs(state%rail(1)%z - before%rail(1)%z) &
                           + outline%lever(cell)*(d_roll + roll*yawed) &
                           + outline%largest_radius*(d_roll*(roll + s*tilt) &
                                                     + s*yawed*(s + 2.0_wp*roll))
                    if (outline%roller_radius > 0.0_wp) then
                        associate (lever => outline%lever(cell))
                            more = (1.0_wp + s)*(abs(state%rail(1)%z - before%rail(1)%z) &
                                   + (1.0_wp + lever/outline%roller_radius)*lever*yaw*d_yaw)
                        end associate
                        aside = on_roller*(aside + more)
                        down = on_roller*(down + more)
                    end if
                    outline%way(cell) = outline%way(cell) - aside
                    outline%low(cell) = outline%low(cell) - down - outline%steep(cell)*aside
                    if (outline%way(cell) < 0.0_wp .or. s*tan(yaw) > farthest_ahead) &
                        outline%low(cell) = -huge(1.0_wp)
                end do
            else
                outline%low = -huge(1.0_wp)
            end if
        end associate
        outline%is_seen = .false.
        outline%has_state = .true.
        outline%state = state
        outline%state%z = 0.0_wp
        outline%axes = wheelset_axes(outline%state, radius)
    end subroutine move_outline

    !> The outline over a roller of a wheel that is lowered; over a rail nothing depends on it.
    pure subroutine lower_outline(outline, lowered)
        type(outline_t), intent(inout) :: outline !! at a state
        real(wp), intent(in) :: lowered           !! beyond the state, mm

        real(wp) :: tilt, turn, more
        integer :: cell

        if (.not. (outline%roller_radius > 0.0_wp .and. abs(lowered - outline%lowered) > 0.0_wp)) &
            return
        tilt = tan(abs(outline%state%yaw))
        do cell = 1, size(outline%low)
            associate (s => outline%bend(cell))
                turn = tilt*(outline%lever(cell) + most_ahead*s*outline%largest_radius) &
                       /outline%roller_radius
                more = on_roller*(1.0_wp + s)*turn*(turn + tilt + abs(outline%state%roll)) &
                       *abs(lowered - outline%lowered)
                outline%way(cell) = outline%way(cell) - more
                outline%low(cell) = outline%low(cell) - more*(1.0_wp + outline%steep(cell))
                if (outline%way(cell) < 0.0_wp .or. s*tilt > farthest_ahead) &
                    outline%low(cell) = -huge(1.0_wp)
            end associate
        end do
        outline%is_seen = .false.
        outline%lowered = lowered
    end subroutine lower_outline

    !> May a point of the outline be lower over the rail than this?
    pure logical function may_be_lower(outline, point, height)
        type(outline_t), intent(in) :: outline !! at a state
        integer, intent(in) :: point           !! number of a point
        real(wp), intent(in) :: height         !! mm

        may_be_lower = outline%is_seen(cell_of(point)) .or. outline%low(cell_of(point)) < height
    end function may_be_lower

    !> Is a point of the outline lower over the rail than this? Its cell is looked at if it may be.
    pure subroutine look_whether_lower(outline, pair, point, height, is_lower)
        type(outline_t), intent(inout) :: outline !! at a state
        type(wheel_on_rail_t), intent(in) :: pair !! made
        integer, intent(in) :: point              !! number of a point
        real(wp), intent(in) :: height            !! mm
        logical, intent(out) :: is_lower          !! is it, and over the rail?

        integer :: cell

        cell = (point - 1)/cell_points + 1
        is_lower = outline%is_seen(cell) .or. outline%low(cell) < height
        if (.not. is_lower) return
        if (.not. outline%is_seen(cell)) call see_cell(outline, pair, cell)
        is_lower = outline%is_there(point)
        if (is_lower) is_lower = outline%height(point) < height
    end subroutine look_whether_lower

    !> Look at points, with all of their cells.
    pure subroutine see_points(outline, pair, first, last)
        type(outline_t), intent(inout) :: outline !! at a state
        type(wheel_on_rail_t), intent(in) :: pair !! made
        integer, intent(in) :: first              !! number of a point
        integer, intent(in) :: last               !! number of another one, not before

        integer :: cell

        do cell = cell_of(first), cell_of(last)
            if (.not. outline%is_seen(cell)) call see_cell(outline, pair, cell)
        end do
    end subroutine see_points

    !> One point of the outline, as if it were not lowered.
    pure subroutine see_point(outline, pair, i, point, slope, is_there)
        type(outline_t), intent(in) :: outline    !! at a state
        type(wheel_on_rail_t), intent(in) :: pair !! made
        integer, intent(in) :: i                  !! number of the point
        real(wp), intent(out) :: point(3)         !! as `outline_point` has it, mm
        real(wp), intent(out) :: slope            !! dz/dy of the outline there
        logical, intent(out) :: is_there          !! has the wheel an outline there?

        call outline_point(pair, outline%state%rail(1), lowered_axes(outline, outline%lowered), &
                           pair%y(i), pair%z(i), pair%slope(i), point, slope, is_there)
        point(3) = point(3) - outline%lowered
    end subroutine see_point

    !> The axes of a wheelset that is lowered beyond the state of a wheel's outline.
    pure type(wheelset_axes_t) function lowered_axes(outline, lowered) result(axes)
        type(outline_t), intent(in) :: outline !! at a state
        real(wp), intent(in) :: lowered        !! mm

        axes = outline%axes
        axes%centre(3) = axes%centre(3) + lowered
    end function lowered_axes

    pure subroutine see_cell(outline, pair, cell)
        type(outline_t), intent(inout) :: outline
        type(wheel_on_rail_t), intent(in) :: pair
        integer, intent(in) :: cell

        type(wheelset_axes_t) :: axes
        real(wp) :: point(3), z, low, way, left, right, span(2)
        logical :: has_outline
        integer :: i

        low = huge(1.0_wp)
        way = largest_way
        left = huge(1.0_wp)
        right = -huge(1.0_wp)
        span = rail_span(pair, outline%state%rail(1))
        axes = lowered_axes(outline, outline%lowered)
        do i = (cell - 1)*cell_points + 1, min(cell*cell_points, size(outline%x))
            call outline_point(pair, outline%state%rail(1), axes, pair%y(i), pair%z(i), &
                               pair%slope(i), point, outline%slope(i), has_outline)
            outline%x(i) = point(1)
            outline%y(i) = point(2)
            outline%z(i) = point(3) - outline%lowered
            outline%is_there(i) = has_outline
            if (.not. has_outline) then
                way = 0.0_wp
                cycle
            end if
            left = min(left, point(2))
            right = max(right, point(2))
            call rail_height(pair, outline%state%rail(1), point(2), z, outline%below(i), &
                             outline%is_there(i))
            if (outline%is_there(i)) then
                outline%height(i) = z - outline%z(i)
                low = min(low, outline%height(i))
            else
                ! Beyond an end of the rail.
                way = min(way, max(span(1) - point(2), point(2) - span(2), 0.0_wp))
            end if
        end do
        outline%is_seen(cell) = .true.
        outline%low(cell) = low
        outline%way(cell) = way
        outline%steep(cell) = 0.0_wp
        if (right >= left) &
            outline%steep(cell) = steepest_rail(pair, outline%state%rail(1), left - way, &
                                                right + way)
    end subroutine see_cell

    !> The lowest height of an outline over the rail; `huge` where they never stand one over the
    !> other. Over a roller the outline is that of a wheel that just touches it.
    pure subroutine lowest_height(outline, pair, lowest)
        type(outline_t), intent(inout) :: outline !! at a state; some of its cells are looked at
        type(wheel_on_rail_t), intent(in) :: pair !! made
        real(wp), intent(out) :: lowest           !! mm

        integer :: i

        do i = 1, most_steps
            call find_lowest(outline, pair, lowest)
            if (.not. outline%roller_radius > 0.0_wp .or. lowest >= huge(lowest) &
                .or. abs(lowest - outline%lowered) <= equal_within*outline%largest_radius) exit
            call lower_outline(outline, lowest)
        end do
    end subroutine lowest_height

    ! The lowest height of an outline as it is.
    pure subroutine find_lowest(outline, pair, lowest)
        type(outline_t), intent(inout) :: outline
        type(wheel_on_rail_t), intent(in) :: pair
        real(wp), intent(out) :: lowest

        integer :: cell

        cell = minloc(outline%low, dim=1)
        if (.not. outline%is_seen(cell)) call see_cell(outline, pair, cell)
        lowest = outline%low(cell)
        do cell = 1, size(outline%low)
            if (.not. outline%is_seen(cell) .and. outline%low(cell) < lowest) &
                call see_cell(outline, pair, cell)
            lowest = min(lowest, outline%low(cell))
        end do
    end subroutine find_lowest
end module faststrip_geometry_wheel_outline
