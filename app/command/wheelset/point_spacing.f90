!> Do the points of profiles resolve the contacts of a wheelset? They are found again with every
!> second point of the profiles that came from files, as those of one contact are.
module faststrip_command_wheelset_point_spacing
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_case, only: asked_t
    use faststrip_contact_methods, only: normal_strip, tangential_faststrip
    use faststrip_geometry_profile, only: thin_profile, profile_curve
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_model, only: reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, wheel_contact_t, &
                                        wheel_result_t, side_right, side_left, standard_join
    use faststrip_command_contact_point_spacing, only: point_spacing_t, name_spacing
    use faststrip_command_wheelset_case, only: wheelset_case_t, try_model
    implicit none
    private

    public :: wheelset_spacing_t, prepare_spacing, name_wheelset_spacing

    ! Farther apart contacts are not the same one, mm: half the way at which they become one.
    real(wp), parameter :: farthest = 0.5_wp*standard_join
    ! Tuned [1]: of the force of its wheel, below which a contact does not count. Origin: chosen.
    real(wp), parameter :: least_share = 0.01_wp

    !> A wheelset with all points of its profiles, and twice with every second one. Pointers, as
    !> `faststrip_command_wheelset` has them.
    type :: wheelset_spacing_t
        logical :: is_known = .false. !! are there points?
        type(wheelset_model_t), pointer :: model(:) => null()
        type(wheelset_workspace_t), pointer :: workspace(:) => null()
        type(wheelset_result_t), pointer :: result(:) => null()
    end type wheelset_spacing_t

contains

    !> Make the wheelsets, with strips and FASTSTRIP and nothing else.
    subroutine prepare_spacing(case, spacing)
        type(wheelset_case_t), intent(in) :: case       !! as it was read
        type(wheelset_spacing_t), intent(out) :: spacing
            !! not known of standard profiles, nor of those that have too few points

        type(wheelset_case_t) :: thinned
        type(status_t) :: status
        integer :: first

        associate (bodies => case%bodies)
            if (all([bodies%wheel%profile%kind, bodies%rail%profile%kind, &
                     bodies%left_wheel%profile%kind, bodies%left_rail%profile%kind] &
                    /= profile_curve)) return
        end associate
        allocate (spacing%model(3), spacing%workspace(3), spacing%result(3))
        thinned = case
        thinned%methods%normal = normal_strip
        thinned%methods%tangential = tangential_faststrip
        thinned%asked = asked_t()
        thinned%estimate = .false.
        thinned%wear_law%n = 0
        do first = 0, 2
            if (first > 0) call thin(first, case, thinned, status)
            if (.not. is_error(status)) call try_model(thinned, spacing%model(first + 1), status)
            if (.not. is_error(status)) &
                call reserve_wheelset(spacing%workspace(first + 1), spacing%model(first + 1), &
                                      status)
            ! Too few points to leave out any.
            if (is_error(status)) return
        end do
        spacing%is_known = .true.
    end subroutine prepare_spacing

    subroutine thin(first, case, thinned, status)
        integer, intent(in) :: first
        type(wheelset_case_t), intent(in) :: case
        type(wheelset_case_t), intent(inout) :: thinned
        type(status_t), intent(out) :: status

        associate (from => case%bodies, to => thinned%bodies)
            call thin_profile(from%wheel%profile, first, to%wheel%profile, status)
            if (.not. is_error(status)) &
                call thin_profile(from%rail%profile, first, to%rail%profile, status)
            if (.not. is_error(status)) &
                call thin_profile(from%left_wheel%profile, first, to%left_wheel%profile, status)
            if (.not. is_error(status)) &
                call thin_profile(from%left_rail%profile, first, to%left_rail%profile, status)
        end associate
    end subroutine thin

    !> Add to the contacts of a result what the points do not resolve.
    subroutine name_wheelset_spacing(spacing, state, demand, result)
        type(wheelset_spacing_t), intent(inout) :: spacing  !! prepared
        type(wheelset_state_t), intent(in) :: state         !! that was solved
        type(wheelset_demand_t), intent(in) :: demand       !! likewise
        type(wheelset_result_t), intent(inout) :: result    !! its contacts' status is changed

        type(status_t) :: status(3)
        type(point_spacing_t) :: point
        integer :: side, i, k

        if (.not. spacing%is_known) return
        do i = 1, 3
            spacing%workspace(i)%has_last = .false.
            call solve_wheelset(spacing%model(i), spacing%workspace(i), state, demand, &
                                spacing%result(i), status(i))
        end do
        if (is_error(status(1))) return
        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            associate (wheel => spacing%result(1)%wheel(side))
                do k = 1, wheel%n
                    if (wheel%contact(k)%figures%normal%load < least_share*norm2(wheel%force)) cycle
                    point = point_spacing_t()
                    point%is_known = .true.
                    do i = 2, 3
                        point%is_solved = point%is_solved .and. .not. is_error(status(i))
                        if (point%is_solved) &
                            call compare(wheel%contact(k), spacing%result(i)%wheel(side), point)
                    end do
                    i = nearest(wheel%contact(k), result%wheel(side))
                    if (i > 0) call name_spacing(point, result%wheel(side)%contact(i)%status)
                end do
            end associate
        end do
    end subroutine name_wheelset_spacing

    subroutine compare(given, wheel, point)
        type(wheel_contact_t), intent(in) :: given
        type(wheel_result_t), intent(in) :: wheel
        type(point_spacing_t), intent(inout) :: point

        real(wp) :: change
        integer :: i

        i = nearest(given, wheel)
        point%is_there = point%is_there .and. i > 0
        if (i == 0) return
        associate (a => given%figures, b => wheel%contact(i)%figures)
            point%pmax = max(point%pmax, abs(b%normal%pmax - a%normal%pmax)/a%normal%pmax)
            change = hypot(b%tangential%fx - a%tangential%fx, b%tangential%fy - a%tangential%fy) &
                     /(a%mu*a%normal%load)
        end associate
        if (ieee_is_finite(change)) point%forces = max(point%forces, change)
    end subroutine compare

    ! The contact of a wheel at the place of another one; 0 if there is none.
    pure integer function nearest(contact, wheel) result(at)
        type(wheel_contact_t), intent(in) :: contact
        type(wheel_result_t), intent(in) :: wheel

        real(wp) :: distance, least
        integer :: i

        at = 0
        least = farthest
        do i = 1, wheel%n
            distance = norm2(wheel%contact(i)%rail - contact%rail)
            if (distance >= least) cycle
            least = distance
            at = i
        end do
    end function nearest
end module faststrip_command_wheelset_point_spacing
