!> Contacts of one wheel that lie beside each other: when they count as one, and what they do until
!> then.
!>
!> Regions of overlap that are nearer than a distance are one contact, whose patches press each
!> other's bodies in and slide in one plane. From half as far again on they come to do so gradually:
!> they turn towards the common angle, slide in the common plane, and what the strips of one press
!> in at another raises its gap. So forces of strips do not jump where they become one.
module faststrip_wheelset_wheel_neighbours
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_contact_frame, only: contact_frame_t, place_frame, in_track
    use faststrip_geometry_overlap, only: region_t, join_regions, region_distance, most_regions
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t
    use faststrip_geometry_wheelset_state, only: rail_state_t
    use faststrip_normal_strip_places, only: add_pressed
    use faststrip_normal_strips, only: strips_load
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_wheelset_approach, only: hertz_power
    use faststrip_wheelset_types, only: wheelset_model_t, wheel_contact_t, wheel_result_t, &
                                        wheel_workspace_t, most_contacts
    implicit none
    private

    public :: join_near, place_frames, press_gap, estimate_loads, add_load_errors

    ! Tuned [1]: of its overlap that the contacts beside it leave a contact to bear. Origin: chosen:
    ! its load is next to nothing.
    real(wp), parameter :: least_left = 1.0e-3_wp
    ! Given: power of the load with which a moment grows at most, where all slips (Hertz).
    real(wp), parameter :: moment_power = 4.0_wp/3.0_wp
    ! Tuned [1]: of a creep force times the patch's size, how much a moment changes besides, over
    ! the change of the load. Origin: 368 contacts of S1002 on three rails: with .2 97 of 100 change
    ! by no more, with .1 91.
    real(wp), parameter :: moment_of_force = 0.2_wp

contains

    !> Regions that are near to each other are one contact.
    pure subroutine join_near(model, regions, n, near)
        type(wheelset_model_t), intent(in) :: model     !! its distances
        type(region_t), intent(inout) :: regions(:)     !! found; joined and turned
        integer, intent(inout) :: n                     !! number of them
        real(wp), intent(out) :: near(:)                !! how near each is to the next one, 0 to 1

        integer :: i, kept

        kept = min(n, 1)
        do i = 2, n
            if (region_distance(regions(kept), regions(i)) < model%join_distance) then
                regions(kept) = join_regions(regions(kept), regions(i))
            else
                kept = kept + 1
                regions(kept) = regions(i)
            end if
        end do
        n = kept
        call turn_near(model, regions, n, near)
    end subroutine join_near

    ! Contacts turn towards their common angle the nearer they come, so that forces do not jump
    ! where they become one.
    pure subroutine turn_near(model, regions, n, near)
        type(wheelset_model_t), intent(in) :: model
        type(region_t), intent(inout) :: regions(:)
        integer, intent(in) :: n
        real(wp), intent(out) :: near(:)

        type(region_t) :: whole
        real(wp) :: turn(most_regions)
        integer :: i, first, last

        near = 0.0_wp
        do i = 1, n - 1
            near(i) = (model%turn_distance - region_distance(regions(i), regions(i + 1))) &
                      /(model%turn_distance - model%join_distance)
            near(i) = max(near(i), 0.0_wp)
        end do
        turn = 0.0_wp
        do first = 1, n - 1
            whole = regions(first)
            do last = first + 1, n
                if (.not. near(last - 1) > 0.0_wp) exit
                whole = join_regions(whole, regions(last))
                do i = first, last
                    turn(i) = turn(i) + run_share(near(:n), first, last) &
                                        *(whole%angle - regions(i)%angle)
                end do
            end do
        end do
        do i = 1, n
            regions(i)%angle = regions(i)%angle + turn(i)
        end do
    end subroutine turn_near

    ! How much a run of contacts is one by itself: 1, where these have become one, and neither
    ! neighbour is near. The shares of all runs with a contact, itself as well, are 1 together.
    pure real(wp) function run_share(near, first, last) result(share)
        real(wp), intent(in) :: near(:)
        integer, intent(in) :: first, last

        share = product(near(first:last - 1))*(1.0_wp - near(last))
        if (first > 1) share = share*(1.0_wp - near(first - 1))
    end function run_share

    !> The frames of all contacts of a wheel. On planes those that are near slide in that of the
    !> whole that they are going to be.
    pure subroutine place_frames(pair, rail, regions, near, curved, frames)
        type(wheel_on_rail_t), intent(in) :: pair       !! made
        type(rail_state_t), intent(in) :: rail          !! as it lies
        type(region_t), intent(in) :: regions(:)        !! of `join_near`
        real(wp), intent(in) :: near(:)                 !! of it
        logical, intent(in) :: curved                   !! do strips slide in their own planes?
        type(contact_frame_t), intent(out) :: frames(:) !! mm, rad

        type(region_t) :: joined
        type(contact_frame_t) :: whole
        integer :: i, first, last

        do i = 1, size(regions)
            call place_frame(pair, rail, regions(i), frames(i))
        end do
        if (curved) return
        do first = 1, size(regions) - 1
            joined = regions(first)
            do last = first + 1, size(regions)
                if (.not. near(last - 1) > 0.0_wp) exit
                joined = join_regions(joined, regions(last))
                call place_frame(pair, rail, joined, whole)
                do i = first, last
                    frames(i)%lift = frames(i)%lift + run_share(near, first, last) &
                                     *dot_product(whole%origin - frames(i)%origin, &
                                                  in_track(frames(i), [0.0_wp, 0.0_wp, 1.0_wp]))
                end do
            end do
        end do
    end subroutine place_frames

    !> What the contacts beside a contact press its bodies in by: the nearer, the more of it counts,
    !> and all of it where they become one. It is left a little to bear.
    pure subroutine press_gap(workspace, i, frames, near, compliance)
        type(wheel_workspace_t), intent(inout) :: workspace
            !! with strips of the others, as far as known, and the gap of this one, which changes
        integer, intent(in) :: i                       !! which contact
        type(contact_frame_t), intent(in) :: frames(:) !! of all contacts
        real(wp), intent(in) :: near(:)                !! of `join_near`
        real(wp), intent(in) :: compliance             !! H of eq. (4), 1/MPa

        real(wp) :: across(3), origin(3), along, part, before, rise
        integer :: j, lowest

        workspace%beside(i, :) = 0.0_wp
        if (.not. max(near(max(i - 1, 1)), near(i)) > 0.0_wp) return
        lowest = minloc(workspace%gap%h(:workspace%gap%n), dim=1)
        associate (gap => workspace%gap, n => workspace%gap%n)
            gap%lower(:n, 1) = 0.0_wp
            gap%tilt(:n, 1) = 0.0_wp
            gap%bend(:n, 1) = 0.0_wp
            do j = 1, size(frames)
                part = product(near(min(i, j):max(i, j) - 1))
                if (j == i .or. .not. part > 0.0_wp) cycle
                across = in_track(frames(j), [0.0_wp, 1.0_wp, 0.0_wp])
                along = dot_product(across, in_track(frames(i), [0.0_wp, 1.0_wp, 0.0_wp]))
                before = gap%lower(lowest, 1)
                origin = frames(i)%origin - frames(j)%origin
                call add_pressed(workspace%contact(j)%strips, part*along*compliance, &
                                 [origin(1), dot_product(origin, across)], along, gap%overlap, &
                                 gap%y(:n), gap%h(:n), gap%inv2r(:n), gap%lower(:n, 1), &
                                 gap%tilt(:n, 1), gap%bend(:n, 1))
                workspace%beside(i, j) = (gap%lower(lowest, 1) - before) &
                                         /max(strips_load(workspace%contact(j)%strips), tiny(part))
            end do
            part = max((1.0_wp - least_left)*gap%overlap - gap%h(lowest), 0.0_wp)
            part = part/max(gap%lower(lowest, 1), part, tiny(part))
            workspace%beside(i, :) = part*workspace%beside(i, :)
            rise = -gap%h(lowest)
            gap%h(:n) = gap%h(:n) + part*gap%lower(:n, 1)
            rise = rise + minval(gap%h(:n))
            gap%h(:n) = gap%h(:n) - rise
            gap%overlap = gap%overlap - rise
            gap%slope(:n) = gap%slope(:n) + part*gap%tilt(:n, 1)
            gap%inv2r(:n) = max(gap%inv2r(:n) + part*gap%bend(:n, 1), 0.5_wp*gap%inv2r(:n))
        end associate
    end subroutine press_gap

    !> What profiles, as exact as the model says, leave open of each normal force.
    !>
    !> A contact whose gap is wrong by eps along its normal has an approach that is wrong by
    !> c dz - eps - sum_j C_j dN_j, c the cosine of its angle, C_j what the load of another presses
    !> its bodies in by, and N grows by k = 3/2 N/penetration with it (Hertz). Where a load is given
    !> the wheels that carry it move by dz, so that the sum of the vertical forces stays: one
    !> contact is as exact as its load, two share the error.
    pure subroutine estimate_loads(model, load_is_given, workspaces, wheels)
        type(wheelset_model_t), intent(in) :: model       !! its accuracy of profiles
        logical, intent(in) :: load_is_given              !! of all these wheels, or their height?
        type(wheel_workspace_t), intent(in) :: workspaces(:) !! of their solutions
        type(wheel_result_t), intent(inout) :: wheels(:)  !! solved

        ! Of the loads: by the gap of each contact, by the height; of the vertical force by a gap.
        real(wp) :: by_gap(most_contacts, most_contacts, 2), by_height(most_contacts, 2), &
            of_sum(most_contacts, 2), total, all, moved, left
        integer :: side, i, j

        total = 0.0_wp
        all = 0.0_wp
        by_height = 0.0_wp
        of_sum = 0.0_wp
        do side = 1, size(wheels)
            call find_slopes(wheels(side), workspaces(side)%beside, by_gap(:, :, side))
            do j = 1, wheels(side)%n
                do i = 1, wheels(side)%n
                    associate (contact => wheels(side)%contact(i), slope => by_gap(i, j, side))
                        by_height(i, side) = by_height(i, side) &
                                             + slope*cos(wheels(side)%contact(j)%angle)
                        of_sum(j, side) = of_sum(j, side) &
                                          + slope*contact%force(3)/some_load(contact)
                    end associate
                end do
                total = total + of_sum(j, side)*cos(wheels(side)%contact(j)%angle)
                all = all + abs(of_sum(j, side))
            end do
        end do
        do side = 1, size(wheels)
            do i = 1, wheels(side)%n
                moved = 0.0_wp
                if (load_is_given .and. total > 0.0_wp) moved = by_height(i, side)/total
                ! Of all contacts, but those of this wheel by what they do themselves.
                left = abs(moved)*all
                do j = 1, wheels(side)%n
                    left = left - abs(moved*of_sum(j, side)) &
                           + left_of(by_gap(i, j, side), moved*of_sum(j, side))
                end do
                associate (contact => wheels(side)%contact(i))
                    contact%est_err_load = model%profile_accuracy*max(left, 0.0_wp) &
                                           /some_load(contact)
                end associate
            end do
        end do
    end subroutine estimate_loads

    !> What is open of a load is open of its forces, too: at given creepages they grow with powers
    !> of it from 2/3 to 1, where all slips, moments with powers to 4/3. Parts of other powers may
    !> cancel in one component: each gets what is open of both.
    pure subroutine add_load_errors(mu, wheel)
        real(wp), intent(in) :: mu                   !! coefficient of friction, the static one
        type(wheel_result_t), intent(inout) :: wheel !! of `estimate_loads`, its forces estimated

        real(wp) :: share, force, size
        integer :: i

        do i = 1, wheel%n
            associate (figures => wheel%contact(i)%figures)
                if (.not. figures%forces_are_estimated) cycle
                associate (forces => figures%tangential, errors => figures%force_errors)
                    force = hypot(forces%fx, forces%fy)
                    size = max(sqrt(figures%normal%area/pi), tiny(size))
                    share = wheel%contact(i)%est_err_load/max(mu*figures%normal%load, tiny(share))
                    errors%fx = errors%fx + share*force
                    errors%fy = errors%fy + share*force
                    errors%mz = errors%mz + share*(moment_power*abs(forces%mz)/size &
                                                   + moment_of_force*force)
                end associate
            end associate
        end do
    end subroutine add_load_errors

    ! How the loads of a wheel grow as the gap of each contact alone is lowered, N/mm:
    ! (I + K C) S = K.
    pure subroutine find_slopes(wheel, beside, slope)
        type(wheel_result_t), intent(in) :: wheel        ! solved
        real(wp), intent(in) :: beside(:, :)             ! C, mm/N
        real(wp), intent(out), contiguous :: slope(:, :) ! S

        real(wp) :: matrix(most_contacts, most_contacts), grows
        integer :: pivot(most_contacts), i
        logical :: singular

        slope = 0.0_wp
        matrix = 0.0_wp
        do i = 1, wheel%n
            grows = 0.0_wp
            associate (normal => wheel%contact(i)%figures%normal)
                if (normal%penetration > 0.0_wp) grows = hertz_power*normal%load/normal%penetration
            end associate
            ! Contacts of a table are not beside each other.
            if (wheel%solutions > 0) matrix(i, :) = grows*beside(i, :)
            matrix(i, i) = 1.0_wp
            slope(i, i) = grows
        end do
        call lu_factor(wheel%n, matrix, pivot, singular)
        if (singular) return
        do i = 1, wheel%n
            call lu_solve(wheel%n, matrix, pivot, slope(:, i))
        end do
    end subroutine find_slopes

    ! What is left of a slope, but for rounding.
    elemental real(wp) function left_of(slope, part)
        real(wp), intent(in) :: slope, part

        left_of = max(abs(slope - part) - 4.0_wp*epsilon(slope)*abs(slope), 0.0_wp)
    end function left_of

    ! The load of a contact, or next to nothing, N.
    elemental real(wp) function some_load(contact)
        type(wheel_contact_t), intent(in) :: contact

        some_load = max(contact%figures%normal%load, tiny(1.0_wp))
    end function some_load
end module faststrip_wheelset_wheel_neighbours
