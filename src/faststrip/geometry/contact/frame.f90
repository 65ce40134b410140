!> The frame of a contact of wheel and rail, and the gap in it.
!>
!> The frame has its origin on the rail, at the reference point of the regions of overlap, and is
!> turned by the contact angle about x. At each y' wheel and rail are nearest on the wheel's
!> outline, at x' = x0(y'): there `h(y')` is their distance along the normal, negative where they
!> overlap, and over x' it grows by `(x' - x0)**2/(2 R)`,
!> `1/R = cos(alpha)/(r cos(alpha_t - gamma))` with the rolling radius r, the slope alpha of the
!> wheel's profile and alpha_t of its outline.
!>
!> On a roller the frame is turned about its axis as well, to the place of the reference point, and
!> the gap is that over the unrolled roller. `1/R` grows by `cos(beta)/(r cos(beta - gamma))` with
!> the slope beta and the radius r of the roller.
module faststrip_geometry_contact_frame
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, st_no_contact
    use faststrip_geometry_overlap, only: region_t
    use faststrip_geometry_profile, only: profile_point
    use faststrip_geometry_touchable, only: upright
    use faststrip_geometry_undeformed_gap, only: smallest_step
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_height, &
                                                rail_origin, turned, unrolled, rolled
    use faststrip_geometry_wheel_outline, only: outline_t, lower_outline, see_points, see_point, &
                                                cell_of
    use faststrip_geometry_wheelset_state, only: rail_state_t
    implicit none
    private

    public :: contact_frame_t, frame_gap_t
    public :: place_frame, frame_ahead, sample_gap, reserve_frame_gap, in_track, along_normal

    ! Tuned [points]: of a region from which on every second one is taken, and how many times as far
    ! apart they are beyond it. Origin: measured: with every point forces are as near to those of
    ! points eight times as dense, 4e-5 of N, and a step of a wheelset costs a fifth more.
    integer, parameter :: enough_points = 80, step_beyond = 4
    ! Tuned [mm]: what is left of the way to a point of the rail is gone by its curvature. Origin:
    ! a third derivative of 0.1 mm**-2 leaves 1e-13 mm.
    real(wp), parameter :: last_way = 1.0e-4_wp
    ! Least advance of y' over that of y that still counts as a function of y'.
    real(wp), parameter :: least_along = 1.0_wp/upright

    !> Place and direction of a contact.
    type :: contact_frame_t
        real(wp) :: origin(3) = 0.0_wp !! reference point on the rail, in the track, mm
        real(wp) :: angle = 0.0_wp     !! contact angle, about x, rad
        real(wp) :: turn = 0.0_wp      !! then about y, on a roller, rad
        real(wp) :: lift = 0.0_wp      !! how far below the origin, along the normal, the plane is
                                       !! in which bodies slide, mm
    end type contact_frame_t

    ! A point on a rail's profile.
    type :: rail_place_t
        logical :: is_new = .false.    ! is only y known, and that not well?
        real(wp) :: y = 0.0_wp, z = 0.0_wp      ! of the profile, mm
        real(wp) :: slope = 0.0_wp, bend = 0.0_wp ! dz/dy, d2z/dy2, 1/mm
        real(wp) :: across = 0.0_wp    ! y' of the frame, from the rail's origin, mm
    end type rail_place_t

    !> The gap of a contact; the first `n` entries count.
    type :: frame_gap_t
        integer :: n = 0                        !! number of points
        real(wp) :: overlap = 0.0_wp            !! largest of a point, along the normal, mm
        real(wp), allocatable :: wheel(:)       !! y on the wheel's profile, mm
        real(wp), allocatable :: across(:)      !! y' from the reference point, mm
        real(wp), allocatable :: down(:)        !! the wheel below the reference point, mm
        real(wp), allocatable :: y(:)           !! y', increasing; of a turned gap across its strips
        real(wp), allocatable :: h(:)           !! height over the deepest point, mm
        real(wp), allocatable :: inv2r(:)       !! 1/(2 R), 1/mm
        real(wp), allocatable :: of_rail(:)     !! what a roller has of it, 1/mm; of a rail 0
        real(wp), allocatable :: slope(:)       !! dh/dy'
        real(wp), allocatable :: inclination(:) !! mean slope of both less the contact angle, rad
        real(wp), allocatable :: x0(:)          !! where they are nearest along x, from the
                                                !! reference point, mm; of a turned gap what is left
        real(wp), allocatable :: ahead(:)       !! where pressures have their centre along x there,
                                                !! from the reference point, mm
        logical :: runs = .false.               !! is that anywhere but at 0?
        real(wp) :: left_out = 0.0_wp           !! how far it is from what strips take it for, over
                                                !! the overlap
        real(wp) :: apart = 0.0_wp              !! how far places of strips count: 0, not, to 1
        real(wp), allocatable :: reach(:)       !! half-length of a patch there, mm; if they count
        real(wp), allocatable :: lower(:, :)    !! (n, 4) for it: what is added to h; what that
                                                !! misses; the sum; what it missed before, mm
        real(wp), allocatable :: tilt(:, :)     !! (n, 3) the same of the slope
        real(wp), allocatable :: bend(:, :)     !! (n, 3) the same of 1/(2 R), 1/mm
        real(wp), allocatable :: skew(:)        !! by how much that is more ahead than behind, mm
    end type frame_gap_t

contains

    !> The frame of a region.
    pure subroutine place_frame(pair, rail, region, frame)
        type(wheel_on_rail_t), intent(in) :: pair  !! made
        type(rail_state_t), intent(in) :: rail     !! as it lies
        type(region_t), intent(in) :: region       !! found
        type(contact_frame_t), intent(out) :: frame !! mm, rad

        real(wp) :: slope
        logical :: is_there

        frame%origin(1) = region%x
        frame%origin(2) = region%y
        call rail_height(pair, rail, region%y, frame%origin(3), slope, is_there)
        frame%angle = region%angle
        if (pair%roller_radius > 0.0_wp) call turn_frame(pair, rail, region%x, frame)
    end subroutine place_frame

    ! From over an unrolled roller to the roller.
    pure subroutine turn_frame(pair, rail, x, frame)
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail
        real(wp), intent(in) :: x
        type(contact_frame_t), intent(inout) :: frame

        frame%origin = rolled(pair, rail, [x, frame%origin(2:3)])
        frame%turn = x/pair%roller_radius
    end subroutine turn_frame

    !> The frame that is farther ahead around a roller.
    pure type(contact_frame_t) function frame_ahead(pair, rail, frame, ahead) result(there)
        type(wheel_on_rail_t), intent(in) :: pair  !! made, on a roller
        type(rail_state_t), intent(in) :: rail     !! as it lies
        type(contact_frame_t), intent(in) :: frame !! mm, rad
        real(wp), intent(in) :: ahead              !! of the reference point, mm

        there = frame
        there%origin = unrolled(pair, rail, frame%origin)
        call turn_frame(pair, rail, there%origin(1) &
                        + ahead/scale_ahead(pair, rail, there%origin), there)
    end function frame_ahead

    ! A way on the roller at a point over the way along it at its radius; of a rail 1.
    pure real(wp) function scale_ahead(pair, rail, point) result(scale)
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail
        real(wp), intent(in) :: point(3) ! unrolled, mm

        scale = 1.0_wp
        if (pair%roller_radius > 0.0_wp) scale = scale - (point(3) - rail%z)/pair%roller_radius
    end function scale_ahead

    !> Allocate for the gaps of a pair.
    subroutine reserve_frame_gap(gap, pair)
        type(frame_gap_t), intent(inout) :: gap   !! sized
        type(wheel_on_rail_t), intent(in) :: pair !! made

        integer :: n

        n = size(pair%y)
        if (allocated(gap%y)) then
            ! It may have been of a pair on rollers.
            gap%of_rail = 0.0_wp
            if (size(gap%y) == n) return
            deallocate (gap%wheel, gap%across, gap%down, gap%y, gap%h, gap%inv2r, gap%of_rail, &
                        gap%slope, gap%inclination, gap%x0, gap%ahead, gap%reach, &
                        gap%lower, gap%tilt, gap%bend, gap%skew)
        end if
        allocate (gap%wheel(n), gap%across(n), gap%down(n), gap%y(n), gap%h(n), gap%inv2r(n), &
                  gap%of_rail(n), gap%slope(n), gap%inclination(n), gap%x0(n), gap%ahead(n), &
                  gap%reach(n), gap%lower(n, 4), gap%tilt(n, 3), gap%bend(n, 3), gap%skew(n), &
                  source=0.0_wp)
    end subroutine reserve_frame_gap

    !> A vector of the contact frame in the track.
    pure function in_track(frame, vector) result(turned)
        type(contact_frame_t), intent(in) :: frame !! mm, rad
        real(wp), intent(in) :: vector(3)          !! along x, y' and the normal, any unit
        real(wp) :: turned(3)                      !! along x, y and z of the track

        associate (c => cos(frame%angle), s => sin(frame%angle))
            turned = [vector(1), vector(2)*c - vector(3)*s, vector(2)*s + vector(3)*c]
        end associate
        if (.not. abs(frame%turn) > 0.0_wp) return
        associate (c => cos(frame%turn), s => sin(frame%turn))
            turned([1, 3]) = [turned(1)*c - turned(3)*s, turned(1)*s + turned(3)*c]
        end associate
    end function in_track

    !> A point of the track that lies `depth` below the reference point, along the normal, mm.
    pure function along_normal(frame, depth) result(point)
        type(contact_frame_t), intent(in) :: frame !! mm, rad
        real(wp), intent(in) :: depth              !! into the rail, mm
        real(wp) :: point(3)                       !! in the track, mm

        point = frame%origin + in_track(frame, [0.0_wp, 0.0_wp, depth])
    end function along_normal

    !> The gap of a wheel that is lowered by `lowered`, from the deepest point of a region outwards
    !> as far as it stays within `height` and belongs to the region. Its points are some of the
    !> outline's, always the same ones of the profile, so that they move smoothly with it.
    subroutine sample_gap(pair, outline, region, lowered, frame, height, every_point, gap, status)
        type(wheel_on_rail_t), intent(in) :: pair  !! made
        type(outline_t), intent(inout) :: outline  !! of the wheel
        type(region_t), intent(in) :: region       !! of this contact
        real(wp), intent(in) :: lowered            !! beyond the state of the outline, mm
        type(contact_frame_t), intent(in) :: frame !! of the region
        real(wp), intent(in) :: height             !! over the deepest point, > 0, mm
        logical, intent(in) :: every_point         !! is every point of the outline taken?
        type(frame_gap_t), intent(inout) :: gap    !! reserved
        type(status_t), intent(out) :: status      !! `st_no_contact`: nothing to sample

        type(rail_place_t) :: middle
        real(wp) :: c, s, c_rail, s_rail, offset(2), origin(3), scale
        integer :: start, step, beyond, first
        logical :: found

        call clear_status(status)
        c = cos(frame%angle)
        s = sin(frame%angle)
        associate (rail => outline%state%rail(1))
            c_rail = cos(frame%angle - rail%roll)
            s_rail = sin(frame%angle - rail%roll)
            origin = unrolled(pair, rail, frame%origin)
            scale = scale_ahead(pair, rail, origin)
            offset = turned(rail_origin(pair, rail) - origin(2:3), -frame%angle)
        end associate
        call lower_outline(outline, lowered)
        call see_points(outline, pair, region%first, region%last)
        step = merge(1, 2, every_point .or. region%last - region%first < enough_points)
        beyond = merge(1, step_beyond*step, every_point)
        start = region%first - 1 + minloc(outline%height(region%first:region%last), dim=1, &
                                          mask=outline%is_there(region%first:region%last))
        start = max(start/step*step, region%first)
        ! Points to the left come to the end of the arrays, then all to their front.
        first = size(gap%y)
        middle%y = outline%y(start) - pair%y_rail - outline%state%rail(1)%y
        middle%is_new = .true.
        call take(start, first, middle, found)
        if (.not. found) then
            gap%n = 0
            call set_status(status, st_no_contact, 'wheel and rail touch where one of them ends')
            return
        end if
        call follow(-1, first, middle)
        gap%n = size(gap%y) - first + 1
        call move_to_front(gap%wheel)
        call move_to_front(gap%down)
        call move_to_front(gap%y)
        call move_to_front(gap%h)
        call move_to_front(gap%inv2r)
        if (outline%roller_radius > 0.0_wp) call move_to_front(gap%of_rail)
        call move_to_front(gap%slope)
        call move_to_front(gap%inclination)
        call move_to_front(gap%x0)
        call follow(1, gap%n, middle)
        gap%across(:gap%n) = gap%y(:gap%n)
        gap%overlap = -lowest_of(gap)
        gap%h(:gap%n) = gap%h(:gap%n) + gap%overlap

    contains

        subroutine move_to_front(values)
            real(wp), intent(inout) :: values(:)

            integer :: i

            do i = 1, gap%n
                values(i) = values(first - 1 + i)
            end do
        end subroutine move_to_front

        ! The gap to one side, to or beyond the height: the entry `i` is that of the last point.
        subroutine follow(side, i, from)
            integer, intent(in) :: side
            integer, intent(inout) :: i
            type(rail_place_t), intent(in) :: from

            type(rail_place_t) :: place
            real(wp) :: lowest
            integer :: k, next, width

            place = from
            lowest = gap%h(i)
            k = start
            do
                width = merge(step, beyond, k + side >= region%first .and. k + side <= region%last)
                do
                    next = merge(k/width + 1, (k - 1)/width, side > 0)*width
                    next = min(max(next, region%from), region%to)
                    if (next == k) return
                    call take(next, i + side, place, found)
                    if (found .or. width == 1) exit
                    ! An end of wheel or rail is near.
                    width = 1
                end do
                if (.not. found) return
                if (side*(gap%y(i + side) - gap%y(i)) < smallest_step) return
                i = i + side
                k = next
                lowest = min(lowest, gap%h(i))
                if ((k < region%first .or. k > region%last) .and. gap%h(i) - lowest > height) return
            end do
        end subroutine follow

        ! The gap at a point of the outline, to entry i; its place on the rail is sought from the
        ! last one.
        subroutine take(k, i, place, found)
            integer, intent(in) :: k, i
            type(rail_place_t), intent(inout) :: place
            logical, intent(out) :: found

            type(rail_place_t) :: there
            real(wp) :: point(3), tangent, across, n_wheel, along, y_wheel

            if (outline%is_seen(cell_of(k))) then
                found = outline%is_there(k)
                point = [outline%x(k), outline%y(k), outline%z(k)]
                tangent = outline%slope(k)
            else
                call see_point(outline, pair, k, point, tangent, found)
            end if
            if (.not. found) return
            across = point(2) - origin(2)
            n_wheel = point(3) + lowered - origin(3)
            y_wheel = across*c + n_wheel*s
            n_wheel = n_wheel*c - across*s
            there = place
            call find_on_rail(pair, c_rail, s_rail, y_wheel - offset(1), there, found)
            along = c + tangent*s
            found = found .and. along >= least_along*sqrt(1.0_wp + tangent**2)
            if (.not. found) return
            place = there
            gap%wheel(i) = pair%y(k)
            gap%y(i) = y_wheel
            gap%down(i) = n_wheel
            gap%h(i) = offset(2) + place%z*c_rail - place%y*s_rail - n_wheel
            gap%inv2r(i) = 0.5_wp*sqrt((1.0_wp + tangent**2)/(1.0_wp + pair%slope(k)**2)) &
                           /((pair%radius + pair%z(k) - pair%z_line)*along)
            if (outline%roller_radius > 0.0_wp) then
                gap%of_rail(i) = 0.5_wp/((pair%roller_radius - pair%z_rail - place%z) &
                                         *(c + place%slope*s))
                gap%inv2r(i) = gap%inv2r(i) + gap%of_rail(i)
            end if
            gap%slope(i) = (place%slope*c_rail - s_rail)/(c_rail + place%slope*s_rail) &
                           - (tangent*c - s)/along
            gap%inclination(i) = 0.5_wp*(atan(tangent) + atan(place%slope) &
                                         + outline%state%rail(1)%roll) - frame%angle
            gap%x0(i) = (point(1) - origin(1))*scale
        end subroutine take
    end subroutine sample_gap

    ! The lowest height of a gap: of its points, or of the cubic beside the lowest of them.
    pure real(wp) function lowest_of(gap) result(lowest)
        type(frame_gap_t), intent(in) :: gap

        real(wp) :: dy, rise, c1, c2, c3, t
        integer :: i

        i = minloc(gap%h(:gap%n), dim=1)
        lowest = gap%h(i)
        if (gap%slope(i) > 0.0_wp) i = i - 1
        if (i < 1 .or. i >= gap%n) return
        if (gap%slope(i) >= 0.0_wp .or. gap%slope(i + 1) <= 0.0_wp) return
        dy = gap%y(i + 1) - gap%y(i)
        rise = gap%h(i + 1) - gap%h(i)
        c1 = gap%slope(i)*dy
        c3 = c1 + gap%slope(i + 1)*dy - 2.0_wp*rise
        c2 = rise - c1 - c3
        t = -c1/(c2 + sqrt(c2**2 - 3.0_wp*c1*c3))
        lowest = gap%h(i) + t*(c1 + t*(c2 + t*c3))
    end function lowest_of

    ! The point of a rail that lies at a y' of the frame, from another one that is near.
    pure subroutine find_on_rail(pair, c, s, across, place, found)
        type(wheel_on_rail_t), intent(in) :: pair
        real(wp), intent(in) :: c, s      ! of the frame's angle against the rail
        real(wp), intent(in) :: across    ! y' from the rail's origin, mm
        type(rail_place_t), intent(inout) :: place
        logical, intent(out) :: found

        real(wp) :: way, advance
        integer :: i
        logical :: is_there

        found = .false.
        if (.not. place%is_new) then
            ! To second order.
            advance = c + place%slope*s
            way = (across - place%across)/advance
            place%y = place%y + way*(1.0_wp - 0.5_wp*place%bend*s*way/advance)
        end if
        place%is_new = .false.
        place%across = across
        do i = 1, most_steps
            place%y = min(max(place%y, pair%rail%y_first), pair%rail%y_last)
            call profile_point(pair%rail, place%y, place%z, place%slope, place%bend, is_there)
            advance = c + place%slope*s
            if (advance < least_along) return
            way = (across - place%y*c - place%z*s)/advance
            place%y = place%y + way
            if (place%y < pair%rail%y_first - last_way &
                .or. place%y > pair%rail%y_last + last_way) return
            if (abs(way) <= last_way) exit
        end do
        found = .true.
        place%z = place%z + way*(place%slope + 0.5_wp*place%bend*way)
        place%slope = place%slope + place%bend*way
    end subroutine find_on_rail
end module faststrip_geometry_contact_frame
