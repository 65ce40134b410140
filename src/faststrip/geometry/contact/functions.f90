!> Contact geometry of a whole wheelset over its lateral shift: rolling radii, contact angles, roll.
!>
!> Each wheel comes down on its rail by itself, as EN 15302:2008+A1:2010 has it, or the wheelset
!> rolls until both touch. Both sides are given in the frame of the right one, y to the field side:
!> the left side is a right one that is shifted and rolled the other way. The wheelset rolls about
!> the middle of its axle, positive where the right wheel goes down; the shift is the middle's.
module faststrip_geometry_contact_functions
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, rounding
    use faststrip_base_plausible, only: quantities, of_turn
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_contact, st_no_convergence
    use faststrip_geometry_contact_scan, only: placing_t, wheel_rolled, find_lowest_dip
    use faststrip_geometry_profile, only: profile_t, profile_at
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contact
    implicit none
    private

    public :: side_t, contact_functions_t, find_contact_functions

    !> A wheel and the rail below it, in the frame of the right side.
    type :: side_t
        type(profile_t) :: wheel            !! y = 0 at the nominal rolling circle
        type(profile_t) :: rail             !! inclined
        ! Given: dimensions of the reference's wheelset.
        real(wp) :: radius = 460.0_wp       !! nominal radius, mm
    end type side_t

    !> A shifted wheelset.
    type :: contact_functions_t
        real(wp) :: shift = 0.0_wp     !! to the right, mm
        real(wp) :: roll = 0.0_wp      !! the right wheel down, rad
        real(wp) :: delta_r = 0.0_wp   !! rolling radius, right less left, mm
        type(rigid_contact_t) :: right !! where the right wheel touches
        type(rigid_contact_t) :: left  !! where the left one does, in its mirrored frame
    end type contact_functions_t

    ! Rolls beyond are not looked at.
    real(wp), parameter :: largest_roll = quantities(of_turn)%possible

contains

    !> The contact of both wheels at a lateral shift.
    pure subroutine find_contact_functions(right, left, wheelset, track, shift, with_roll, &
                                           functions, status)
        type(side_t), intent(in) :: right         !! wheel and rail
        type(side_t), intent(in) :: left          !! the same, mirrored
        type(wheelset_t), intent(in) :: wheelset  !! mm; its radius is not used
        type(track_t), intent(in) :: track        !! mm
        real(wp), intent(in) :: shift             !! of the wheelset to the right, mm
        logical, intent(in) :: with_roll          !! else it stays level
        type(contact_functions_t), intent(out) :: functions !! where they touch
        type(status_t), intent(out) :: status     !! `st_bad_argument`, `st_out_of_range`,
                                                  !! `st_no_contact` as `find_rigid_contact`;
                                                  !! `st_no_convergence`: no roll was found

        functions%shift = shift
        call find_level_contact(right, wheelset, track, shift, functions%right, status)
        if (is_error(status)) return
        call find_level_contact(left, wheelset, track, -shift, functions%left, status)
        if (is_error(status)) return
        if (with_roll) call find_roll(right, left, wheelset, functions, status)
        functions%delta_r = functions%right%radius - functions%left%radius
        ! What is left on one cone is rounding.
        if (abs(functions%delta_r) <= rounding) functions%delta_r = 0.0_wp
    end subroutine find_contact_functions

    pure subroutine find_level_contact(side, wheelset, track, shift, contact, status)
        type(side_t), intent(in) :: side
        type(wheelset_t), intent(in) :: wheelset
        type(track_t), intent(in) :: track
        real(wp), intent(in) :: shift
        type(rigid_contact_t), intent(out) :: contact
        type(status_t), intent(out) :: status

        call find_rigid_contact(side%wheel, side%rail, wheelset_t(wheelset%back_spacing, &
                                wheelset%tread_line, side%radius), track, shift, contact, status)
    end subroutine find_level_contact

    !> Roll until both wheels stop the axle's middle at the same height. The heights depend on the
    !> roll without jumps, so that of two rolls at which one or the other wheel stops it there is
    !> one between.
    pure subroutine find_roll(right, left, wheelset, functions, status)
        type(side_t), intent(in) :: right, left
        type(wheelset_t), intent(in) :: wheelset
        type(contact_functions_t), intent(inout) :: functions
        type(status_t), intent(out) :: status

        type(rigid_contact_t) :: level(2)
        real(wp) :: low, high, height(2), slope(2), next
        integer :: step

        level = [functions%right, functions%left]
        low = -largest_roll
        high = largest_roll
        functions%roll = 0.0_wp
        do step = 1, most_steps
            call find_rolled_contact(right, wheelset, level(1), functions%shift, functions%roll, &
                                     functions%right, height(1), slope(1), status)
            if (is_error(status)) return
            call find_rolled_contact(left, wheelset, level(2), -functions%shift, -functions%roll, &
                                     functions%left, height(2), slope(2), status)
            if (is_error(status)) return
            ! z points down: the wheel that stops the axle first has the smaller one.
            if (abs(height(1) - height(2)) <= rounding) return
            if (height(1) > height(2)) low = functions%roll
            if (height(1) < height(2)) high = functions%roll
            next = low
            if (abs(sum(slope)) > 0.0_wp) &
                next = functions%roll - (height(1) - height(2))/sum(slope)
            if (.not. (next > low .and. next < high)) next = 0.5_wp*(low + high)
            if (.not. abs(next - functions%roll) > spacing(largest_roll)) return
            functions%roll = next
        end do
        call set_status(status, st_no_convergence, 'no roll lets both wheels touch at the shift ' &
                        // trim(number_text(functions%shift)) // ' mm')
    end subroutine find_roll

    !> The contact of one side that is rolled, the right wheel down: where on the wheel the vertical
    !> distance to the rail is smallest.
    pure subroutine find_rolled_contact(side, wheelset, level, shift, roll, contact, height, &
                                        slope, status)
        type(side_t), intent(in) :: side
        type(wheelset_t), intent(in) :: wheelset
        type(rigid_contact_t), intent(in) :: level    ! at the same shift without roll
        real(wp), intent(in) :: shift, roll           ! mm, rad
        type(rigid_contact_t), intent(out) :: contact
        real(wp), intent(out) :: height               ! z of the axle's middle below the rail's
                                                      ! origin, mm
        real(wp), intent(out) :: slope                ! by which it rises with the roll, mm/rad
        type(status_t), intent(out) :: status

        type(placing_t) :: placing
        real(wp) :: z, dz, d2z
        logical :: found

        call clear_status(status)
        ! From the middle of the axle, which lies on the wheelset's own axes.
        placing = placing_t(wheel_rolled, sine=sin(roll), cosine=cos(roll), &
                            across=0.5_wp*wheelset%back_spacing + wheelset%tread_line, &
                            below=level%radius - level%z_wheel, &
                            origin=level%y_track - level%y_rail - shift)
        call find_lowest_dip(side%wheel, side%rail, placing, side%wheel%y_first, &
                             side%wheel%y_last, contact%y_wheel, height, found)
        if (.not. found) then
            call set_status(status, st_no_contact, 'wheel and rail touch at the end of a profile ' &
                            // 'at the shift ' // trim(number_text(shift)) // ' mm and the roll ' &
                            // trim(number_text(roll)) // ' rad')
            return
        end if
        call profile_at(side%wheel, contact%y_wheel, contact%z_wheel, dz, d2z, status)
        associate (p => placing)
            contact%radius = p%below + contact%z_wheel
            contact%y_rail = (p%across + contact%y_wheel)*p%cosine - contact%radius*p%sine &
                             - p%origin
            contact%y_track = p%origin + shift + contact%y_rail
        end associate
        call profile_at(side%rail, contact%y_rail, contact%z_rail, dz, d2z, status)
        contact%gamma = atan(dz)
        ! What turns about the middle of the axle goes down by its way across and inwards by its
        ! depth below.
        z = contact%z_rail - height
        slope = -(contact%y_rail + placing%origin) - dz*z
    end subroutine find_rolled_contact
end module faststrip_geometry_contact_functions
