!> Where a wheel that is lowered onto its rail would overlap it, and the frame of each contact.
!>
!> A region of overlap is a run of points of the wheel's outline below the rail. Its reference point
!> is the mean over the region, each point weighted by the square of the overlap over the whole
!> length along x, `pen**2` over `pen = depth - x**2/(2 r)`: 16/15 depth**2.5 sqrt(2 r). The contact
!> angle is the mean of the rail's inclination with the same weights. So place and angle move
!> smoothly while regions grow, merge and vanish.
!>
!> Source of the weights: CONTACT's user guide, the contact search of wheel and rail.
module faststrip_geometry_overlap
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_height
    use faststrip_geometry_wheel_outline, only: outline_t, lower_outline, see_points, &
                                                look_whether_lower, may_be_lower, cell_end
    implicit none
    private

    public :: region_t, find_regions, join_regions, region_distance, most_regions, depth_weight

    !> Most regions of one wheel.
    !> Tuned [regions]. Origin: capacity; the deepest ones are kept.
    integer, parameter :: most_regions = 8

    !> A region of overlap; of several that were joined, the whole.
    type :: region_t
        integer :: first = 0           !! first point of the outline that overlaps
        integer :: last = 0            !! last one
        integer :: from = 0            !! first point that belongs to this region: from the height
                                       !! between it and the next region
        integer :: to = 0              !! last one
        real(wp) :: left(2) = 0.0_wp   !! y, z of the rail where it begins, mm
        real(wp) :: right(2) = 0.0_wp  !! y, z of the rail where it ends, mm
        real(wp) :: depth = 0.0_wp     !! largest overlap, vertical, mm
        real(wp) :: weight = 0.0_wp    !! mm**3.5
        real(wp) :: x = 0.0_wp         !! weighted mean, in the track, mm; on a roller along it
        real(wp) :: y = 0.0_wp         !! weighted mean, in the track, mm
        real(wp) :: angle = 0.0_wp     !! weighted mean of the rail's inclination, rad
    end type region_t

contains

    !> The weight of a place in a region: the square of the overlap, over its length.
    elemental real(wp) function depth_weight(depth) result(weight)
        real(wp), intent(in) :: depth !! >= 0, mm

        weight = depth**2*sqrt(depth)
    end function depth_weight

    !> The regions in which a wheel that is lowered by `lowered` overlaps its rail, along y.
    subroutine find_regions(pair, outline, lowered, regions, n)
        type(wheel_on_rail_t), intent(in) :: pair     !! made
        type(outline_t), intent(inout) :: outline     !! of the wheel; points are looked at
        real(wp), intent(in) :: lowered               !! beyond the state of the outline, mm
        type(region_t), intent(out) :: regions(most_regions) !! the first `n` count
        integer, intent(out) :: n                     !! number of regions

        type(region_t) :: region
        integer :: i, previous, top

        call lower_outline(outline, lowered)
        n = 0
        previous = 0
        top = 1
        i = 1
        do while (i <= size(outline%x))
            if (.not. may_be_lower(outline, i, lowered)) then
                i = cell_end(outline, i) + 1
                cycle
            else if (.not. overlaps(i)) then
                i = i + 1
                cycle
            end if
            region = region_t()
            region%first = i
            do
                if (i == size(outline%x)) exit
                if (.not. overlaps(i + 1)) exit
                i = i + 1
            end do
            region%last = i
            region%from = 1
            region%to = size(outline%x)
            if (previous > 0) then
                top = highest_between(previous, region%first)
                region%from = top
            end if
            call weigh(region)
            if (previous > 0 .and. n > 0) regions(n)%to = top
            call keep(region)
            previous = region%last
            i = i + 1
        end do

    contains

        logical function overlaps(k) result(does)
            integer, intent(in) :: k

            call look_whether_lower(outline, pair, k, lowered, does)
        end function overlaps

        ! The point between two regions that stands highest over the rail.
        integer function highest_between(from, to) result(highest)
            integer, intent(in) :: from, to

            integer :: k

            call see_points(outline, pair, from, to)
            highest = from
            do k = from + 1, to - 1
                if (.not. outline%is_there(k)) then
                    highest = k
                    return
                end if
                if (outline%height(k) > outline%height(highest)) highest = k
            end do
        end function highest_between

        ! One more region; of too many the shallowest is left out.
        subroutine keep(new)
            type(region_t), intent(in) :: new

            integer :: shallowest

            if (n < most_regions) then
                n = n + 1
                regions(n) = new
                return
            end if
            shallowest = minloc(regions%depth, dim=1)
            if (regions(shallowest)%depth >= new%depth) return
            regions(shallowest:n - 1) = regions(shallowest + 1:n)
            regions(n) = new
        end subroutine keep

        subroutine weigh(region)
            type(region_t), intent(inout) :: region

            real(wp) :: depth, share
            integer :: k, before, after

            call see_points(outline, pair, max(region%first - 1, 1), &
                            min(region%last + 1, size(outline%x)))
            do k = region%first, region%last
                depth = lowered - outline%height(k)
                before = max(k - 1, 1)
                after = min(k + 1, size(outline%x))
                if (.not. outline%is_there(before)) before = k
                if (.not. outline%is_there(after)) after = k
                share = depth_weight(depth)*0.5_wp*abs(outline%y(after) - outline%y(before))
                region%depth = max(region%depth, depth)
                region%weight = region%weight + share
                region%x = region%x + share*outline%x(k)
                region%y = region%y + share*outline%y(k)
                region%angle = region%angle + share*atan(outline%below(k))
            end do
            region%left = end_of(region%first - 1, region%first)
            region%right = end_of(region%last + 1, region%last)
            if (region%weight > 0.0_wp) then
                region%x = region%x/region%weight
                region%y = region%y/region%weight
                region%angle = region%angle/region%weight
            else
                k = (region%first + region%last)/2
                region%x = outline%x(k)
                region%y = outline%y(k)
                region%angle = atan(outline%below(k))
            end if
        end subroutine weigh

        ! Where the overlap ends, on the rail, between a point outside and one inside.
        pure function end_of(outside, inside) result(place)
            integer, intent(in) :: outside, inside
            real(wp) :: place(2)

            real(wp) :: t, slope
            logical :: is_there

            t = 0.0_wp
            place(1) = outline%y(inside)
            if (outside >= 1 .and. outside <= size(outline%x)) then
                if (outline%is_there(outside)) then
                    t = (lowered - outline%height(inside)) &
                        /(outline%height(outside) - outline%height(inside))
                    place(1) = place(1) + t*(outline%y(outside) - outline%y(inside))
                end if
            end if
            call rail_height(pair, outline%state%rail(1), place(1), place(2), slope, is_there)
        end function end_of
    end subroutine find_regions

    !> Distance of two regions that follow each other, on the rail, mm.
    pure real(wp) function region_distance(left, right) result(distance)
        type(region_t), intent(in) :: left  !! the one of smaller y
        type(region_t), intent(in) :: right !! the next one

        distance = norm2(right%left - left%right)
    end function region_distance

    !> Two regions that follow each other as one, with one reference point and one angle.
    pure type(region_t) function join_regions(left, right) result(whole)
        type(region_t), intent(in) :: left  !! the one of smaller y
        type(region_t), intent(in) :: right !! the next one

        real(wp) :: share

        whole = left
        whole%last = right%last
        whole%to = right%to
        whole%right = right%right
        whole%depth = max(left%depth, right%depth)
        whole%weight = left%weight + right%weight
        share = 0.5_wp
        if (whole%weight > 0.0_wp) share = right%weight/whole%weight
        whole%x = left%x + share*(right%x - left%x)
        whole%y = left%y + share*(right%y - left%y)
        whole%angle = left%angle + share*(right%angle - left%angle)
    end function join_regions
end module faststrip_geometry_overlap
