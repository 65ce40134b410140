!> Wear of a profile against a nominal one: how far its surface lies below the nominal one, along
!> the normals of the nominal curve; and how a worn rail is laid onto it.
!>
!> Both are curves of points, y to the field side, z down, from small y to large y. A rail is
!> aligned by its field side, where wheels touch least: the outer four tenths of that half.
module faststrip_geometry_wear
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, rounding
    use faststrip_base_status, only: status_t, set_status, clear_status, &
                                     st_out_of_range, st_no_convergence
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    implicit none
    private

    public :: wear_depths, align_by_field_side, rail_wear_t, measure_rail_wear

    ! Wear is looked for as far as this on both sides of the nominal curve.
    ! Tuned [mm]. Origin: rails and flanges are taken out of use earlier.
    real(wp), parameter :: farthest = 20.0_wp
    ! Where the field side begins, from the middle of the head, over its half width.
    ! Tuned [1]. Origin: wheels wear R300 and R80 of a 60E1 up to there.
    real(wp), parameter :: field_part = 0.6_wp
    ! Given: EN 13231, the usual gauge point: depth below the crown, mm.
    real(wp), parameter :: gauge_depth = 14.0_wp

    !> Wear of a rail in three directions; NaN where the profiles do not reach.
    type :: rail_wear_t
        logical :: is_known(3) = .false.  !! top, side, corner
        real(wp) :: top = 0.0_wp          !! down, at the middle of the nominal head, mm
        real(wp) :: side = 0.0_wp         !! to the field side, 14 mm below the nominal crown, mm
        real(wp) :: corner = 0.0_wp       !! along the normal at 45 degrees on the gauge side, mm
    end type rail_wear_t

contains

    !> Depth of wear at each point of a nominal curve.
    pure subroutine wear_depths(nominal_y, nominal_z, y, z, side, depth, is_known)
        real(wp), intent(in) :: nominal_y(:), nominal_z(:)  !! mm
        real(wp), intent(in) :: y(:), z(:)                  !! the measured curve, mm
        real(wp), intent(in) :: side         !! 1, material below the curve (rail); -1, above
        real(wp), intent(out) :: depth(:)    !! into the material, mm, one a nominal point
        logical, intent(out) :: is_known(:)  !! does the normal meet the measured curve?

        real(wp) :: normal(2), tangent(2)
        integer :: i, n

        n = size(nominal_y)
        depth = 0.0_wp
        is_known = .false.
        do i = 1, n
            tangent = [nominal_y(min(i + 1, n)) - nominal_y(max(i - 1, 1)), &
                       nominal_z(min(i + 1, n)) - nominal_z(max(i - 1, 1))]
            if (.not. norm2(tangent) > 0.0_wp) cycle
            tangent = tangent/norm2(tangent)
            normal = side*[-tangent(2), tangent(1)]
            call meet([nominal_y(i), nominal_z(i)], normal, y, z, depth(i), is_known(i))
        end do
    end subroutine wear_depths

    !> Distance along a direction to a curve, the nearest of all on both sides.
    pure subroutine meet(from, direction, y, z, distance, is_met)
        real(wp), intent(in) :: from(2), direction(2), y(:), z(:)
        real(wp), intent(out) :: distance
        logical, intent(out) :: is_met

        real(wp) :: across(2), along, t
        integer :: i

        is_met = .false.
        distance = 0.0_wp
        do i = 1, size(y) - 1
            ! Across the direction the chord changes its sides.
            across = [(y(i) - from(1))*direction(2) - (z(i) - from(2))*direction(1), &
                      (y(i + 1) - from(1))*direction(2) - (z(i + 1) - from(2))*direction(1)]
            if (across(1)*across(2) > 0.0_wp .or. .not. abs(across(1) - across(2)) > 0.0_wp) cycle
            t = across(1)/(across(1) - across(2))
            along = (y(i) + t*(y(i + 1) - y(i)) - from(1))*direction(1) &
                    + (z(i) + t*(z(i + 1) - z(i)) - from(2))*direction(2)
            if (abs(along) > farthest) cycle
            if (is_met .and. abs(along) >= abs(distance)) cycle
            is_met = .true.
            distance = along
        end do
    end subroutine meet

    !> Wear of a rail that lies on the nominal one.
    pure subroutine measure_rail_wear(nominal_y, nominal_z, y, z, wear)
        real(wp), intent(in) :: nominal_y(:), nominal_z(:)  !! mm
        real(wp), intent(in) :: y(:), z(:)                  !! the measured curve, mm
        type(rail_wear_t), intent(out) :: wear              !! what the profiles reach

        real(wp) :: middle, top, depth
        integer :: i

        top = minval(nominal_z)
        middle = head_middle(nominal_y)
        do i = 1, size(nominal_y) - 1
            associate (y1 => nominal_y(i), y2 => nominal_y(i + 1), z1 => nominal_z(i), &
                       z2 => nominal_z(i + 1))
                if (y1 <= middle .and. y2 > middle) call take([middle, z1 + (z2 - z1) &
                    *(middle - y1)/(y2 - y1)], [0.0_wp, 1.0_wp], wear%top, &
                    wear%is_known(1))
                if (y1 >= middle) cycle
                depth = top + gauge_depth
                if (z1 >= depth .and. z2 < depth .and. .not. wear%is_known(2)) &
                    call take([y1 + (y2 - y1)*(z1 - depth)/(z1 - z2), depth], &
                              [1.0_wp, 0.0_wp], wear%side, wear%is_known(2))
                if (z1 - z2 >= y2 - y1) call take([0.5_wp*(y1 + y2), 0.5_wp*(z1 + z2)], &
                    [1.0_wp, 1.0_wp]/sqrt(2.0_wp), wear%corner, wear%is_known(3))
            end associate
        end do

    contains

        pure subroutine take(from, direction, value, is_known)
            real(wp), intent(in) :: from(2), direction(2)
            real(wp), intent(inout) :: value
            logical, intent(inout) :: is_known

            call meet(from, direction, y, z, value, is_known)
        end subroutine take
    end subroutine measure_rail_wear

    pure real(wp) function head_middle(nominal_y)
        real(wp), intent(in) :: nominal_y(:)

        head_middle = 0.5_wp*(minval(nominal_y) + maxval(nominal_y))
    end function head_middle

    !> Move and turn a rail so that its field side lies on that of the nominal one.
    subroutine align_by_field_side(nominal_y, nominal_z, y, z, motion, status)
        real(wp), intent(in) :: nominal_y(:), nominal_z(:)  !! mm
        real(wp), intent(inout) :: y(:), z(:)               !! moved, mm
        real(wp), intent(out) :: motion(3)     !! along y and z, mm; and, done before, the turn
                                               !! from y to z about the origin, rad
        type(status_t), intent(out) :: status  !! `st_out_of_range`: no common field side;
                                               !! `st_no_convergence`

        real(wp) :: matrix(3, 3), right(3), row(3), miss, before(size(y)), scale, nearest(2)
        real(wp) :: normal(2)
        integer :: i, step, n, pivot(3)
        logical :: is_singular, is_near

        call clear_status(status)
        motion = 0.0_wp
        ! First the outermost places of the field side and the tops onto each other.
        motion(1) = maxval(nominal_y) - maxval(y)
        motion(2) = minval(nominal_z) - minval(z)
        y = y + motion(1)
        z = z + motion(2)
        scale = maxval(nominal_y) - minval(nominal_y)
        do step = 1, most_steps
            matrix = 0.0_wp
            right = 0.0_wp
            n = 0
            do i = 1, size(y)
                if (y(i) < head_middle(nominal_y) + field_part*0.5_wp*scale) cycle
                call near([y(i), z(i)], nominal_y, nominal_z, nearest, normal, is_near)
                if (.not. is_near) cycle
                n = n + 1
                miss = dot_product(nearest - [y(i), z(i)], normal)
                row = [normal(1), normal(2), (y(i)*normal(2) - z(i)*normal(1))/scale]
                right = right + miss*row
                matrix = matrix + spread(row, 2, 3)*spread(row, 1, 3)
            end do
            if (n < 3) exit
            pivot = 0
            call lu_factor(3, matrix, pivot, is_singular)
            if (is_singular) exit
            call lu_solve(3, matrix, pivot, right)
            right(3) = right(3)/scale
            before = y
            y = before*cos(right(3)) - z*sin(right(3)) + right(1)
            z = before*sin(right(3)) + z*cos(right(3)) + right(2)
            motion(:2) = [motion(1)*cos(right(3)) - motion(2)*sin(right(3)), &
                          motion(1)*sin(right(3)) + motion(2)*cos(right(3))] + right(:2)
            motion(3) = motion(3) + right(3)
            if (maxval(abs(right*[1.0_wp, 1.0_wp, scale])) < rounding) return
        end do
        if (n < 3 .or. step <= most_steps) then
            call set_status(status, st_out_of_range, 'the profiles have no field side in common')
        else
            call set_status(status, st_no_convergence, 'the profiles could not be aligned')
        end if
    end subroutine align_by_field_side

    !> The nearest place of a curve within reach, and the normal there.
    pure subroutine near(point, y, z, nearest, normal, is_near)
        real(wp), intent(in) :: point(2), y(:), z(:)
        real(wp), intent(out) :: nearest(2), normal(2)
        logical, intent(out) :: is_near

        real(wp) :: chord(2), t, length, distance, least, place(2) ! squares of lengths
        integer :: i

        least = farthest**2
        is_near = .false.
        nearest = 0.0_wp
        normal = 0.0_wp
        do i = 1, size(y) - 1
            chord = [y(i + 1) - y(i), z(i + 1) - z(i)]
            length = dot_product(chord, chord)
            if (.not. length > 0.0_wp) cycle
            t = dot_product(point - [y(i), z(i)], chord)/length
            ! Beyond the ends of the curve nothing is near.
            if (i == 1 .and. t < 0.0_wp .or. i == size(y) - 1 .and. t > 1.0_wp) cycle
            t = min(max(t, 0.0_wp), 1.0_wp)
            place = [y(i), z(i)] + t*chord
            distance = dot_product(point - place, point - place)
            if (distance >= least) cycle
            least = distance
            is_near = .true.
            nearest = place
            normal = [-chord(2), chord(1)]/sqrt(length)
        end do
    end subroutine near
end module faststrip_geometry_wear
