!> The frame of a contact of wheel and rail, and the gap in it.
!>
!> The frame has its origin on the rail, at the reference point of the regions of overlap, and is
!> turned by the contact angle about x. At each y' wheel and rail are nearest on the wheel's
!> outline, at x' = x0(y'): there `h(y')` is their distance along the normal, negative where they
!> overlap, and over x' it grows by `(x' - x0)**2/(2 R)`,
!> `1/R = cos(alpha)/(r cos(alpha_t - gamma))` with the rolling radius r, the slope alpha of the
!> wheel's profile and alpha_t of its outline.
module faststrip_geometry_contact_frame
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, equal_within
    use faststrip_base_status, only: status_t, set_status, clear_status, st_no_contact
    use faststrip_geometry_overlap, only: region_t
    use faststrip_geometry_profile, only: profile_at
    use faststrip_geometry_touchable, only: upright
    use faststrip_geometry_undeformed_gap, only: smallest_step
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, outline_t, rail_height, &
                                                rail_origin, turned
    use faststrip_geometry_wheelset_state, only: rail_state_t
    implicit none
    private

    public :: contact_frame_t, frame_gap_t
    public :: place_frame, sample_gap, reserve_frame_gap, in_track, along_normal

    ! Least advance of y' over that of y that still counts as a function of y'.
    real(wp), parameter :: least_along = 1.0_wp/upright

    !> Place and direction of a contact.
    type :: contact_frame_t
        real(wp) :: origin(3) = 0.0_wp !! reference point on the rail, in the track, mm
        real(wp) :: angle = 0.0_wp     !! contact angle, about x, rad
    end type contact_frame_t

    !> The gap of a contact; the first `n` entries count.
    type :: frame_gap_t
        integer :: n = 0                        !! number of points
        integer :: first = 0                    !! the outline's point that is the first of them
        real(wp) :: overlap = 0.0_wp            !! largest, along the normal, mm
        real(wp), allocatable :: y(:)           !! y' from the reference point, increasing, mm
        real(wp), allocatable :: h(:)           !! height over the deepest point, mm
        real(wp), allocatable :: inv2r(:)       !! 1/(2 R), 1/mm
        real(wp), allocatable :: slope(:)       !! dh/dy'
        real(wp), allocatable :: inclination(:) !! mean slope of both less the contact angle, rad
        real(wp), allocatable :: x0(:)          !! where they are nearest along x, from the
                                                !! reference point, mm
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
    end subroutine place_frame

    !> Allocate for the gaps of a pair.
    subroutine reserve_frame_gap(gap, pair)
        type(frame_gap_t), intent(inout) :: gap   !! sized
        type(wheel_on_rail_t), intent(in) :: pair !! made

        integer :: n

        n = size(pair%y)
        if (allocated(gap%y)) then
            if (size(gap%y) == n) return
            deallocate (gap%y, gap%h, gap%inv2r, gap%slope, gap%inclination, gap%x0)
        end if
        allocate (gap%y(n), gap%h(n), gap%inv2r(n), gap%slope(n), gap%inclination(n), gap%x0(n), &
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
    end function in_track

    !> A point of the track that lies `depth` below the reference point, along the normal, mm.
    pure function along_normal(frame, depth) result(point)
        type(contact_frame_t), intent(in) :: frame !! mm, rad
        real(wp), intent(in) :: depth              !! into the rail, mm
        real(wp) :: point(3)                       !! in the track, mm

        point = frame%origin + in_track(frame, [0.0_wp, 0.0_wp, depth])
    end function along_normal

    !> The gap of a wheel that is lowered by `lowered`, from the deepest point of a region outwards
    !> as far as it stays within `height` and belongs to the region.
    subroutine sample_gap(pair, outline, region, lowered, frame, height, gap, status)
        type(wheel_on_rail_t), intent(in) :: pair  !! made
        type(outline_t), intent(in) :: outline     !! of the wheel
        type(region_t), intent(in) :: region       !! of this contact
        real(wp), intent(in) :: lowered            !! beyond the state of the outline, mm
        type(contact_frame_t), intent(in) :: frame !! of the region
        real(wp), intent(in) :: height             !! over the deepest point, > 0, mm
        type(frame_gap_t), intent(inout) :: gap    !! reserved
        type(status_t), intent(out) :: status      !! `st_no_contact`: nothing to sample

        real(wp) :: c, s, y_rail, origin(2), c_rail, s_rail
        integer :: start, first, last, i
        logical :: found

        call clear_status(status)
        gap%n = 0
        c = cos(frame%angle)
        s = sin(frame%angle)
        origin = rail_origin(pair, outline%rail)
        c_rail = cos(frame%angle - outline%rail%roll)
        s_rail = sin(frame%angle - outline%rail%roll)
        start = region%first - 1 + minloc(outline%height(region%first:region%last), dim=1, &
                                          mask=outline%is_there(region%first:region%last))
        y_rail = outline%y(start)
        call take(start, y_rail, found)
        if (.not. found) then
            call set_status(status, st_no_contact, 'wheel and rail touch where one of them ends')
            return
        end if
        first = reached(-1)
        last = reached(1)
        gap%n = last - first + 1
        gap%first = first
        ! The points are those of the outline: to the front of the arrays.
        do i = 1, gap%n
            gap%y(i) = gap%y(first + i - 1)
            gap%h(i) = gap%h(first + i - 1)
            gap%inv2r(i) = gap%inv2r(first + i - 1)
            gap%slope(i) = gap%slope(first + i - 1)
            gap%inclination(i) = gap%inclination(first + i - 1)
            gap%x0(i) = gap%x0(first + i - 1)
        end do
        gap%overlap = -minval(gap%h(:gap%n))
        gap%h(:gap%n) = gap%h(:gap%n) + gap%overlap

    contains

        ! How far the gap goes to one side.
        integer function reached(step)
            integer, intent(in) :: step

            real(wp) :: lowest, y_from
            integer :: k
            logical :: is_inside

            reached = start
            y_from = outline%y(start)
            lowest = gap%h(start)
            k = start
            do
                k = k + step
                if (k < region%from .or. k > region%to) exit
                call take(k, y_from, found)
                if (.not. found) exit
                if (step*(gap%y(k) - gap%y(k - step)) < smallest_step) exit
                lowest = min(lowest, gap%h(k))
                is_inside = k >= region%first .and. k <= region%last
                if (.not. is_inside .and. gap%h(k) - lowest > height) exit
                reached = k
            end do
        end function reached

        ! The gap at a point of the outline; the rail is sought from y_from, where its point would
        ! be in the track if it were not turned.
        subroutine take(k, y_from, found)
            integer, intent(in) :: k
            real(wp), intent(inout) :: y_from
            logical, intent(out) :: found

            real(wp) :: y, z, y_turned, n_wheel, n_rail, slope, residual, d2z, alpha, there(2)
            type(status_t) :: inside
            integer :: j

            found = outline%is_there(k)
            if (.not. found) return
            y = outline%y(k) - frame%origin(2)
            z = outline%z(k) + lowered - frame%origin(3)
            y_turned = y*c + z*s
            n_wheel = z*c - y*s
            found = .false.
            z = 0.0_wp
            slope = 0.0_wp
            do j = 1, most_steps
                y = min(max(y_from - origin(1), pair%rail%y_first), pair%rail%y_last)
                call profile_at(pair%rail, y, z, slope, d2z, inside)
                there = turned([y, z], outline%rail%roll)
                y_from = y + origin(1)
                y = there(1) + origin(1) - frame%origin(2)
                z = there(2) + origin(2) - frame%origin(3)
                if (c_rail + slope*s_rail < least_along) return
                residual = y_turned - y*c - z*s
                if (abs(residual) <= equal_within*(1.0_wp + abs(y_turned))) exit
                y_from = y_from + residual/(c_rail + slope*s_rail)
                if (y_from < origin(1) + pair%rail%y_first &
                    .or. y_from > origin(1) + pair%rail%y_last) return
            end do
            n_rail = z*c - y*s
            alpha = atan(pair%slope(k))
            slope = atan(slope) + outline%rail%roll
            if (cos(outline%slope(k) - frame%angle) < least_along) return
            found = .true.
            gap%y(k) = y_turned
            gap%h(k) = n_rail - n_wheel
            gap%inv2r(k) = 0.5_wp*cos(alpha)/((pair%radius + pair%z(k) - pair%z_line) &
                                              *cos(outline%slope(k) - frame%angle))
            gap%slope(k) = tan(slope - frame%angle) - tan(outline%slope(k) - frame%angle)
            gap%inclination(k) = 0.5_wp*(outline%slope(k) + slope) - frame%angle
            gap%x0(k) = outline%x(k) - frame%origin(1)
        end subroutine take
    end subroutine sample_gap
end module faststrip_geometry_contact_frame
