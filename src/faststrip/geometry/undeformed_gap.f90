!> The undeformed gap about a rigid contact.
module faststrip_geometry_undeformed_gap
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_points, most_steps, largest_place, rounding
    use faststrip_geometry_profile, only: profile_t, profile_at
    use faststrip_geometry_rigid_contact, only: rigid_contact_t, wheelset_t, largest_length
    use faststrip_geometry_touchable, only: upright
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    implicit none
    private

    public :: make_gap, standard_gap_step, standard_gap_height, smallest_step

    !> Spacing of the samples, mm.
    !> Tuned [mm]. Origin: chosen: many samples in a strip of the S1002/UIC60 contacts.
    real(wp), parameter :: standard_gap_step = 0.05_wp

    !> Gap beyond which no sample is taken, mm.
    !> Tuned [mm]. Origin: chosen: some times the penetration of the S1002/UIC60 contacts.
    real(wp), parameter :: standard_gap_height = 0.6_wp

    !> Shortest spacing of samples, and least radius, mm.
    !> Tuned [mm]. Origin: safeguard; digits of profiles end there.
    real(wp), parameter :: smallest_step = 1.0e-3_wp

    ! Least dy'/dy of a profile that still counts as a function of y'.
    real(wp), parameter :: least_along = 1.0_wp/upright
    ! Tuned [1]: residual over the coordinate that ends the steps. Origin: safeguard: above
    ! rounding; gaps change by 1e-12 mm with ten times as much.
    real(wp), parameter :: exact = 1.0e-13_wp

    ! A point of a profile in its own frame and in the turned one.
    type :: inclined_point_t
        real(wp) :: y = 0.0_wp     ! lateral coordinate of the profile, mm
        real(wp) :: z = 0.0_wp     ! depth, mm
        real(wp) :: dz = 0.0_wp    ! slope dz/dy
        real(wp) :: n = 0.0_wp     ! along the turned normal from the contact, mm
        real(wp) :: along = 0.0_wp ! dy'/dy
    end type inclined_point_t

contains

    !> Sample the gap along the common normal of a rigid contact.
    !>
    !> The frame is turned by the contact angle about the contact point:
    !> `y' = (Y - Yc) cos(gamma) + (Z - Zc) sin(gamma)`; the gap is the distance of rail and
    !> wheel along the turned normal and `inv2r = 1/(2 R)`,
    !> `R = r cos(alpha - gamma)/cos(alpha)` with the local rolling radius r and slope angle
    !> alpha of the wheel; of a roller the same is added, with those of the roller; `inclination`
    !> is the mean slope angle of the two less gamma. Samples stand at the multiples of `step`,
    !> from the contact outwards as far as the gap stays within `height` and both profiles go on,
    !> as functions of y'.
    subroutine make_gap(wheel, rail, wheelset, contact, step, height, gap, status)
        type(profile_t), intent(in) :: wheel          !! wheel profile
        type(profile_t), intent(in) :: rail           !! rail profile, inclined
        type(wheelset_t), intent(in) :: wheelset      !! its radius is used, mm
        type(rigid_contact_t), intent(in) :: contact  !! from `find_rigid_contact`
        real(wp), intent(in) :: step                  !! spacing of the samples, >= 1e-3 mm
        real(wp), intent(in) :: height                !! largest gap, > 0, mm
        type(gap_t), intent(out) :: gap               !! mm, mm, 1/mm
        type(status_t), intent(out) :: status         !! `st_bad_argument`; `st_too_few_points`:
                                                      !! fewer than 5 samples within the height
        real(wp), allocatable :: h(:), inv2r(:), inclination(:)
        real(wp) :: z_line, dz, d2z
        integer :: n_left, n_right, i, capacity

        call check_sampling(step, height, status)
        if (is_error(status)) return
        call check_contact(wheelset, contact, status)
        if (is_error(status)) return
        call profile_at(wheel, 0.0_wp, z_line, dz, d2z, status)
        if (is_error(status)) return
        capacity = min(most_points, &
                   ceiling(2.0_wp*min(wheel%y_last - wheel%y_first, &
                                      rail%y_last - rail%y_first, largest_length)/step) + 1)
        allocate (h(-capacity:capacity), inv2r(-capacity:capacity), &
                  inclination(-capacity:capacity), source=0.0_wp)
        call sample_side(-1, n_left)
        call sample_side(1, n_right)
        if (min(n_left, n_right) < 0) then
            call set_status(status, st_bad_argument, &
                            'the gap does not start at a contact of the profiles')
            return
        end if
        gap%y = [(real(i, wp)*step, i=-n_left, n_right)]
        gap%h = h(-n_left:n_right)
        gap%inv2r = inv2r(-n_left:n_right)
        gap%inclination = inclination(-n_left:n_right)
        call check_gap(gap, status)

    contains

        ! Samples from the contact to one side; `n` of them beside the contact.
        subroutine sample_side(side, n)
            integer, intent(in) :: side
            integer, intent(out) :: n
            type(inclined_point_t) :: on_wheel, on_rail
            real(wp) :: y_turned, radius, of_roller, bend
            logical :: found
            integer :: j

            on_wheel = inclined_point_t(y=contact%y_wheel)
            on_rail = inclined_point_t(y=contact%y_rail)
            n = -1
            do j = 0, capacity
                y_turned = real(side*j, wp)*step
                call go_to(wheel, contact%y_wheel, contact%z_wheel, contact%gamma, y_turned, &
                           on_wheel, found)
                if (.not. found) exit
                call go_to(rail, contact%y_rail, contact%z_rail, contact%gamma, y_turned, &
                           on_rail, found)
                if (.not. found) exit
                if (on_rail%n - on_wheel%n > height) exit
                ! cos(alpha - gamma)/cos(alpha) = cos(gamma) + tan(alpha) sin(gamma) > 0
                radius = (wheelset%radius + on_wheel%z - z_line) &
                         *(cos(contact%gamma) + on_wheel%dz*sin(contact%gamma))
                if (radius < smallest_step) exit
                bend = 0.5_wp/radius
                if (contact%roller_radius > 0.0_wp) then
                    of_roller = (contact%roller_radius + contact%z_rail - on_rail%z)*on_rail%along
                    if (of_roller < smallest_step) exit
                    bend = bend + 0.5_wp/of_roller
                end if
                n = j
                h(side*j) = on_rail%n - on_wheel%n
                inv2r(side*j) = bend
                inclination(side*j) = 0.5_wp*(atan(on_wheel%dz) + atan(on_rail%dz)) - contact%gamma
            end do
        end subroutine sample_side
    end subroutine make_gap

    pure subroutine check_sampling(step, height, status)
        real(wp), intent(in) :: step, height
        type(status_t), intent(out) :: status
        logical :: valid

        call clear_status(status)
        valid = ieee_is_finite(step)
        if (valid) valid = step >= smallest_step .and. step <= largest_place
        if (.not. valid) then
            call set_status(status, st_bad_argument, &
                            'step of the gap must be 0.001 to 10000 mm, got ' &
                            // trim(number_text(step)))
            return
        end if
        valid = ieee_is_finite(height)
        if (valid) valid = height > 0.0_wp
        if (.not. valid) then
            call set_status(status, st_bad_argument, 'height of the gap must be above 0, got ' // &
                            trim(number_text(height)) // ' mm')
        end if
    end subroutine check_sampling

    pure subroutine check_contact(wheelset, contact, status)
        type(wheelset_t), intent(in) :: wheelset
        type(rigid_contact_t), intent(in) :: contact
        type(status_t), intent(out) :: status
        logical :: valid

        call clear_status(status)
        valid = all(ieee_is_finite([contact%y_wheel, contact%z_wheel, contact%y_rail, &
                                    contact%z_rail, contact%gamma, wheelset%radius]))
        if (valid) valid = maxval(abs([contact%y_wheel, contact%z_wheel, contact%y_rail, &
                                       contact%z_rail, wheelset%radius])) <= largest_length &
                           .and. abs(contact%gamma) < 0.5_wp*pi .and. wheelset%radius > 0.0_wp
        if (.not. valid) call set_status(status, st_bad_argument, &
                                         'the gap does not start at a contact of the profiles')
    end subroutine check_contact

    ! From a point of a profile on to the one with a given y' (in the frame turned by gamma about
    ! the contact). Newton within a bracket, so that a jump of the profile ends on the jump.
    ! Not found: beyond the profile, or where it is no function of y' any more.
    pure subroutine go_to(profile, y_contact, z_contact, gamma, y_turned, point, found)
        type(profile_t), intent(in) :: profile
        real(wp), intent(in) :: y_contact, z_contact, gamma, y_turned
        type(inclined_point_t), intent(inout) :: point
        logical, intent(out) :: found
        real(wp) :: start, far, near, next, residual, side
        integer :: i

        found = .false.
        start = point%y
        if (start < profile%y_first .or. start > profile%y_last) return
        call turned_at(start, point, residual)
        if (point%along <= least_along) return
        side = sign(1.0_wp, residual)
        near = start
        ! The far end of the bracket: twice the distance to go, and on.
        far = start
        next = max(2.0_wp*abs(residual)/point%along, rounding)
        do
            far = max(profile%y_first, min(far + side*next, profile%y_last))
            call turned_at(far, point, residual)
            if (point%along <= least_along) return
            if (side*residual <= 0.0_wp) exit
            if (far <= profile%y_first .or. far >= profile%y_last) return
            near = far
            next = 2.0_wp*next
        end do
        next = 0.5_wp*(near + far)
        do i = 1, most_steps
            call turned_at(next, point, residual)
            if (point%along <= least_along) return
            if (side*residual > 0.0_wp) then
                near = next
            else
                far = next
            end if
            if (abs(residual) <= exact*(1.0_wp + abs(y_turned)) &
                .or. abs(far - near) <= spacing(next)) exit
            next = next + residual/point%along
            if ((next - near)*(next - far) > 0.0_wp) next = 0.5_wp*(near + far)
        end do
        found = .true.

    contains

        pure subroutine turned_at(y, there, residual)
            real(wp), intent(in) :: y
            type(inclined_point_t), intent(out) :: there
            real(wp), intent(out) :: residual
            real(wp) :: d2z
            type(status_t) :: inside

            there%y = y
            call profile_at(profile, y, there%z, there%dz, d2z, inside)
            there%along = cos(gamma) + there%dz*sin(gamma)
            there%n = (there%z - z_contact)*cos(gamma) - (y - y_contact)*sin(gamma)
            residual = y_turned - (y - y_contact)*cos(gamma) - (there%z - z_contact)*sin(gamma)
        end subroutine turned_at
    end subroutine go_to
end module faststrip_geometry_undeformed_gap
