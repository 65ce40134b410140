!> The strips of a wheel's contact, what each of them transmits, where they are on the profiles of
!> wheel and rail, and the gap that they were found for.
!>
!> A strip's place is that of its middle: the points of both profiles that lie above each other
!> there along the contact's normal. Where the gap was turned into its principal axes the strip's
!> place is that of the gap's point it came from.
module faststrip_wheelset_strips
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, equal_within
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument
    use faststrip_geometry_contact_frame, only: contact_frame_t, place_frame
    use faststrip_geometry_contact_yawed, only: find_frame_gap
    use faststrip_geometry_profile, only: profile_at
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_height, on_rail_profile, &
                                                unrolled
    use faststrip_geometry_wheelset_state, only: rail_state_t
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips, copy_strips, mirror_strips
    use faststrip_numerics_reversal, only: reverse, reverse_negated
    use faststrip_tangential_types, only: strip_forces_t, reserve_strip_forces, copy_strip_forces
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_result_t, wheel_workspace_t, side_left
    implicit none
    private

    public :: wheel_strips_t, find_wheel_strips, find_wheel_gap

    !> Strips of one contact, in its frame, and their places.
    type :: wheel_strips_t
        type(contact_strips_t) :: strips       !! mm, MPa
        type(strip_forces_t) :: forces         !! N; empty if the method has none
        real(wp), allocatable :: rail(:, :)    !! y, z of it on the rail's profile, mm
        real(wp), allocatable :: wheel(:, :)   !! y, z of it on the wheel's profile, mm
    end type wheel_strips_t

contains

    !> The strips of a contact of the last solution. Allocates where `found` is too small.
    subroutine find_wheel_strips(model, workspace, result, side, i, found, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! of the solution; its gap is
                                                               !! sampled again
        type(wheelset_result_t), intent(in) :: result          !! of the same solution
        integer, intent(in) :: side                            !! `side_right`, `side_left`
        integer, intent(in) :: i                               !! contact of that wheel
        type(wheel_strips_t), intent(inout) :: found           !! as they are, not in a mirror
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: no such contact; those of `find_frame_gap`

        call check_place(workspace, result, side, i, status)
        if (is_error(status)) return
        call reserve_wheel_strips(found, size(workspace%wheel(side)%contact(i)%strips%p0), status)
        if (is_error(status)) return
        associate (contact => workspace%wheel(side)%contact(i))
            call copy_strips(contact%strips, found%strips)
            call copy_strip_forces(contact%strip_forces, found%forces)
        end associate
        if (workspace%is_reversed(side)) found%forces%fx = -found%forces%fx
        call find_places(model, model%pair(side), workspace%wheel(side), i, &
                         result%wheel(side)%z, found, status)
        if (side == side_left) call mirror(found)
    end subroutine find_wheel_strips

    ! Is there such a contact?
    pure subroutine check_place(workspace, result, side, i, status)
        type(wheelset_workspace_t), intent(in) :: workspace
        type(wheelset_result_t), intent(in) :: result
        integer, intent(in) :: side, i
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (i < 1 .or. i > result%wheel(side)%n .or. .not. workspace%has_last) &
            call set_status(status, st_bad_argument, 'there is no such contact of the wheel')
    end subroutine check_place

    !> The gap of a contact of the last solution, by all points of the wheel's profile: it is in
    !> `workspace%wheel(side)%gap`, of a left wheel as in a mirror. A gap that was smoothed is what
    !> was solved; another one is that of the bodies as contacts beside this one do not press them.
    subroutine find_wheel_gap(model, workspace, result, side, i, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! of the solution; gets the gap
        type(wheelset_result_t), intent(in) :: result          !! of the same solution
        integer, intent(in) :: side                            !! `side_right`, `side_left`
        integer, intent(in) :: i                               !! contact of that wheel
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: no such contact; those of `find_frame_gap`

        type(contact_frame_t) :: frame

        call check_place(workspace, result, side, i, status)
        if (is_error(status)) return
        associate (wheel => workspace%wheel(side), gap => workspace%wheel(side)%gap)
            if (model%case%smoothing > 0.0_wp) then
                associate (curve => wheel%contact(i)%solver%curve)
                    gap%n = curve%n
                    gap%y(:gap%n) = curve%y(:gap%n)
                    gap%h(:gap%n) = curve%h(:gap%n)
                    gap%inv2r(:gap%n) = curve%inv2r(:gap%n)
                    gap%inclination(:gap%n) = curve%inclination(:gap%n)
                end associate
                return
            end if
            call place_frame(model%pair(side), wheel%outline%state%rail(1), wheel%region(i), frame)
            call find_frame_gap(model%pair(side), wheel%outline, wheel%region(i), &
                                result%wheel(side)%z, frame, model%gap_height, .true., gap, status)
        end associate
    end subroutine find_wheel_gap

    !> Allocate for strips of a contact.
    subroutine reserve_wheel_strips(found, capacity, status)
        type(wheel_strips_t), intent(inout) :: found !! sized
        integer, intent(in) :: capacity              !! largest number of strips, >= 1
        type(status_t), intent(out) :: status        !! `st_bad_argument`

        call reserve_strips(found%strips, capacity, status)
        if (is_error(status)) return
        call reserve_strip_forces(found%forces, capacity, status)
        if (is_error(status)) return
        if (allocated(found%rail)) then
            if (size(found%rail, 2) == capacity) return
            deallocate (found%rail, found%wheel)
        end if
        allocate (found%rail(2, capacity), found%wheel(2, capacity), source=0.0_wp)
    end subroutine reserve_wheel_strips

    ! Where the middles of the strips are. The strips lie along the gap as it was solved; its points
    ! are those of the outline, which are those of the wheel's profile.
    subroutine find_places(model, pair, workspace, i, lowered, found, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheel_on_rail_t), intent(in) :: pair
        type(wheel_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: i
        real(wp), intent(in) :: lowered
        type(wheel_strips_t), intent(inout) :: found
        type(status_t), intent(out) :: status

        type(contact_frame_t) :: frame
        type(status_t) :: inside
        real(wp) :: y, part, dz, d2z
        integer :: k, j

        associate (gap => workspace%gap, strips => found%strips)
            call place_frame(pair, workspace%outline%state%rail(1), workspace%region(i), frame)
            call find_frame_gap(pair, workspace%outline, workspace%region(i), lowered, frame, &
                                model%gap_height, model%case%smoothing > 0.0_wp, gap, status)
            if (is_error(status)) return
            j = 1
            do k = 1, strips%n
                y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
                do while (j < gap%n - 1 .and. y > gap%y(j + 1))
                    j = j + 1
                end do
                part = (y - gap%y(j))/(gap%y(j + 1) - gap%y(j))
                found%rail(:, k) = rail_point(pair, workspace%outline%state%rail(1), frame, &
                                              gap%across(j) + part*(gap%across(j + 1) &
                                                                    - gap%across(j)))
                y = gap%wheel(j) + part*(gap%wheel(j + 1) - gap%wheel(j))
                found%wheel(1, k) = y
                call profile_at(pair%wheel, y, found%wheel(2, k), dz, d2z, inside)
            end do
        end associate
    end subroutine find_places

    ! The point of the rail's profile at a y' of the frame.
    pure function rail_point(pair, rail, frame, along) result(point)
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail
        type(contact_frame_t), intent(in) :: frame
        real(wp), intent(in) :: along
        real(wp) :: point(2)

        real(wp) :: origin(3), y, z, slope, residual
        logical :: is_there
        integer :: i

        origin = unrolled(pair, rail, frame%origin)
        associate (c => cos(frame%angle), s => sin(frame%angle))
            y = origin(2) + along*c
            do i = 1, most_steps
                call rail_height(pair, rail, y, z, slope, is_there)
                residual = along - (y - origin(2))*c - (z - origin(3))*s
                if (.not. is_there .or. abs(residual) <= equal_within*(1.0_wp + abs(along))) exit
                y = y + residual/(c + slope*s)
            end do
        end associate
        point = on_rail_profile(pair, rail, [y, z])
    end function rail_point

    ! Strips that were found in a mirror, as they are.
    pure subroutine mirror(found)
        type(wheel_strips_t), intent(inout) :: found

        associate (n => found%strips%n, forces => found%forces)
            call mirror_strips(found%strips)
            call reverse(forces%fx(:forces%n))
            call reverse_negated(forces%fy(:forces%n))
            call reverse(forces%friction_power(:forces%n))
            call reverse_negated(found%rail(1, :n))
            call reverse(found%rail(2, :n))
            call reverse_negated(found%wheel(1, :n))
            call reverse(found%wheel(2, :n))
        end associate
    end subroutine mirror
end module faststrip_wheelset_strips
