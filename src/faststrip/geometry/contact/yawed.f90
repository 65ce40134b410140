!> The gap of a contact, of a yawed wheel, too: what strips are given.
!>
!> Along x a yawed wheel is not cut along its parallel circle but at the angle beta to it,
!> `sin(beta) = sin(yaw)/cos(alpha)`, and the curvature of its profile comes in (Euler):
!> `kappa_p cos(beta)**2 + kappa_m sin(beta)**2`, with `kappa_p = cos(alpha)/r` of the circle and
!> `kappa_m` of the profile. At the root of a flange that is up to a quarter more. Where the
!> profile's radius jumps it would jump, too; so 1/(2 R) is that of the parabola through the exact
!> gap at the lowest place and as far ahead and behind as a patch goes there. A roller keeps the
!> curvature of its circle.
module faststrip_geometry_contact_yawed
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_contact_frame, only: contact_frame_t, frame_gap_t, sample_gap, &
                                               in_track, frame_ahead
    use faststrip_geometry_overlap, only: region_t
    use faststrip_geometry_profile, only: profile_at
    use faststrip_geometry_sheared_gap, only: turn_sheared_gap
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t
    use faststrip_geometry_wheel_outline, only: outline_t
    implicit none
    private

    public :: find_frame_gap

    ! Tuned [1]: what the profile's curvature may add to that along x until it is looked at, and
    ! from which it counts wholly. Origin: a thousandth changes the load of a height by 0.05 %.
    real(wp), parameter :: little_bend = 1.0e-3_wp, much_bend = 2.0_wp*little_bend
    ! Half length of a patch, squared, over that of the overlap.
    ! Given: one half, of Hertz contacts.
    real(wp), parameter :: patch_part = 0.5_wp
    ! Tuned [1]: smallest depth that a reach is taken of, over the largest. Origin: strips at the
    ! ends of a patch are 0.3 times as long as the longest.
    real(wp), parameter :: least_depth = 0.09_wp
    ! Tuned [1]: spread of the strips' places over the length of the longest, squared, up to which
    ! they lie side by side, and from which their places count wholly. Origin: measured: the load of
    ! a height changes by 0.035 of it.
    real(wp), parameter :: near_places = 0.02_wp, apart_places = 2.0_wp*near_places
    ! Tuned [1]: what strips at their places leave out, as a bulge of the gap, over that spread:
    ! their pressures lean. Origin: 40 yawed contacts at flange roots against their exact gaps: pmax
    ! up to 1.2 %, the penetration 0.3 %.
    real(wp), parameter :: lean_part = 0.06_wp
    ! Tuned [1]: smallest secant over the curvature of the circle. Origin: safeguard: beyond a kink
    ! of the profile a parabola tells nothing.
    real(wp), parameter :: least_secant = 0.2_wp
    ! Tuned [mm]: how near to the wheel's surface. Origin: a millionth of a penetration.
    real(wp), parameter :: near_surface = 1.0e-8_wp

contains

    !> The gap of a wheel that is lowered by `lowered` about the frame of a region, in its principal
    !> axes.
    subroutine find_frame_gap(pair, outline, region, lowered, frame, height, every_point, gap, &
                              status)
        type(wheel_on_rail_t), intent(in) :: pair  !! made
        type(outline_t), intent(inout) :: outline  !! of the wheel
        type(region_t), intent(in) :: region       !! of this contact
        real(wp), intent(in) :: lowered            !! beyond the state of the outline, mm
        type(contact_frame_t), intent(in) :: frame !! of the region
        real(wp), intent(in) :: height             !! over the deepest point, > 0, mm
        logical, intent(in) :: every_point         !! is every point of the outline taken?
        type(frame_gap_t), intent(inout) :: gap    !! reserved
        type(status_t), intent(out) :: status      !! those of `sample_gap`

        real(wp) :: share, secant, lean, bulge
        integer :: i

        call sample_gap(pair, outline, region, lowered, frame, height, every_point, gap, status)
        if (is_error(status)) return
        gap%ahead(:gap%n) = gap%x0(:gap%n)
        gap%runs = any(abs(gap%ahead(:gap%n)) > 0.0_wp)
        gap%left_out = 0.0_wp
        share = (largest_bend(gap, outline%axes%axle(1)) - little_bend)/(much_bend - little_bend)
        share = max(0.0_wp, min(share, 1.0_wp))
        if (share > 0.0_wp) then
            do i = 1, gap%n
                call find_secant(pair, outline, lowered, frame, gap, i, secant, lean, bulge)
                gap%inv2r(i) = gap%inv2r(i) + share*(secant - gap%inv2r(i))
                gap%ahead(i) = gap%ahead(i) + share*lean
                gap%left_out = max(gap%left_out, share*bulge/gap%overlap)
            end do
        end if
        call turn_sheared_gap(gap)
        call find_places(gap)
    end subroutine find_frame_gap

    ! Whether strips of a gap have places along x that count, and how far they reach.
    pure subroutine find_places(gap)
        type(frame_gap_t), intent(inout) :: gap

        real(wp) :: first, last, longest, spread
        integer :: i

        first = huge(first)
        last = -huge(last)
        longest = 0.0_wp
        do i = 1, gap%n
            gap%reach(i) = half_length(gap, i)
            if (gap%h(i) >= gap%overlap) cycle
            first = min(first, gap%x0(i))
            last = max(last, gap%x0(i))
            longest = max(longest, gap%reach(i))
        end do
        spread = 0.0_wp
        if (longest > 0.0_wp) spread = ((last - first)/(2.0_wp*longest))**2
        gap%apart = max(0.0_wp, min((spread - near_places)/(apart_places - near_places), 1.0_wp))
        gap%left_out = gap%left_out + lean_part*min(spread, apart_places)
    end subroutine find_places

    ! Half-length of a patch at point i of a gap, mm.
    pure real(wp) function half_length(gap, i)
        type(frame_gap_t), intent(in) :: gap
        integer, intent(in) :: i

        half_length = sqrt(patch_part*max(gap%overlap - gap%h(i), least_depth*gap%overlap) &
                           /gap%inv2r(i))
    end function half_length

    ! What the profile's curvature adds to that along x, at most within the overlap, over it: the
    ! nearest place runs with y' by as much over sin(yaw).
    pure real(wp) function largest_bend(gap, sine) result(largest)
        type(frame_gap_t), intent(in) :: gap
        real(wp), intent(in) :: sine

        integer :: i

        largest = 0.0_wp
        do i = 2, gap%n
            if (min(gap%h(i - 1), gap%h(i)) >= gap%overlap) cycle
            largest = max(largest, abs((gap%x0(i) - gap%x0(i - 1))/(gap%y(i) - gap%y(i - 1))))
        end do
        largest = largest*abs(sine)
    end function largest_bend

    ! 1/(2 R) of the parabola through the gap at point i and as far ahead and behind as a patch
    ! goes there, and how far ahead of that point pressures have their centre: where a gap has
    ! `k x**3` beside it they tilt as by 3/4 of that at their ends (reciprocity, a fixed patch).
    ! Within the overlap also how far the gap is from that parabola where its height is half of that
    ! at the ends.
    pure subroutine find_secant(pair, outline, lowered, frame, gap, i, secant, lean, bulge)
        type(wheel_on_rail_t), intent(in) :: pair
        type(outline_t), intent(in) :: outline
        real(wp), intent(in) :: lowered
        type(contact_frame_t), intent(in) :: frame
        type(frame_gap_t), intent(in) :: gap
        integer, intent(in) :: i
        real(wp), intent(out) :: secant ! 1/mm
        real(wp), intent(out) :: lean   ! mm
        real(wp), intent(out) :: bulge  ! mm

        type(contact_frame_t) :: nearest
        real(wp) :: reach, circle, ahead, front, back

        nearest = frame
        ahead = gap%x0(i)
        if (outline%roller_radius > 0.0_wp) then
            nearest = frame_ahead(pair, outline%state%rail(1), frame, ahead)
            ahead = 0.0_wp
        end if
        circle = gap%inv2r(i) - gap%of_rail(i)
        reach = half_length(gap, i)
        front = rise_at(reach)
        back = rise_at(-reach)
        secant = max((front + back)/(2.0_wp*reach**2), least_secant*circle) + gap%of_rail(i)
        bulge = 0.0_wp
        if (gap%h(i) < gap%overlap) &
            bulge = 0.5_wp*abs(rise_at(sqrt(0.5_wp)*reach) + rise_at(-sqrt(0.5_wp)*reach) &
                               - 0.5_wp*(front + back))
        lean = 3.0_wp*0.25_wp*0.25_wp*(back - front)/(reach*secant)

    contains

        ! By how much the wheel's surface is higher there than at its lowest place, mm.
        pure real(wp) function rise_at(way)
            real(wp), intent(in) :: way

            real(wp) :: arm(3), normal(3), spoke(3), along, rho, y, z, dz, d2z, miss
            type(status_t) :: inside
            integer :: k

            normal = in_track(nearest, [0.0_wp, 0.0_wp, 1.0_wp])
            rise_at = circle*reach**2
            do k = 1, most_steps
                arm = nearest%origin - outline%axes%centre &
                      + in_track(nearest, [ahead + way, gap%across(i), gap%down(i) - rise_at])
                arm(3) = arm(3) - lowered
                along = dot_product(arm, outline%axes%axle)
                spoke = arm - along*outline%axes%axle
                rho = norm2(spoke)
                y = min(max(along - pair%y_line, pair%wheel%y_first), pair%wheel%y_last)
                call profile_at(pair%wheel, y, z, dz, d2z, inside)
                miss = rho - (pair%radius + z - pair%z_line)
                rise_at = rise_at + miss/dot_product(spoke/rho - dz*outline%axes%axle, normal)
                if (abs(miss) <= near_surface) exit
            end do
        end function rise_at
    end subroutine find_secant
end module faststrip_geometry_contact_yawed
