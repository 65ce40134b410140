!> Where a wheel touches a rail: the rigid contact of a wheelset shifted sideways, without yaw
!> and without roll, and the creepages that follow from it.
!>
!> Lateral coordinates of the track are those of the right rail: measured from the track centre,
!> to the field side. The left wheel is the right one mirrored: its contact is that of a right
!> wheel shifted the other way.
module faststrip_geometry_rigid_contact
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_halvings, largest_place
    use faststrip_geometry_contact_scan, only: placing_t, wheel_level, find_lowest_dip, &
                                               find_lowest_sample, sample_place, sample_step, &
                                               scan_step, stretch, slack
    use faststrip_geometry_gauge_fit, only: check_fit, check_rolling_circles
    use faststrip_geometry_profile, only: profile_t, profile_at, profile_bounds
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_no_contact, st_out_of_range
    implicit none
    private

    public :: wheelset_t, track_t, rigid_contact_t
    public :: find_rigid_contact, find_rigid_contacts, contact_force, shift_creepage
    public :: place_rail, check_roller, creepage_set_a, creepage_set_b, largest_length

    !> The wheelset; both wheels carry the same profile.
    type :: wheelset_t
        ! Given: dimensions of standard gauge.
        real(wp) :: back_spacing = 1360.0_wp !! distance of the two flange backs, mm
        ! Given: dimensions of the wheelset.
        real(wp) :: tread_line = 70.0_wp     !! flange back to nominal rolling circle (y = 0), mm
        ! Given: dimensions of the reference's wheelset.
        real(wp) :: radius = 460.0_wp        !! nominal radius r0, mm
    end type wheelset_t

    !> The track; both rails carry the same profile.
    type :: track_t
        ! Given: dimensions of standard gauge.
        real(wp) :: gauge = 1435.0_wp     !! distance of the two gauge faces, mm
        ! Given: dimensions of the track.
        real(wp) :: gauge_depth = 14.0_wp !! depth below the crown where it is measured, mm
        real(wp) :: rail_distance = 0.0_wp !! distance of the origins of the two rail profiles, mm;
                                           !! 0 where the gauge counts
        real(wp) :: roller_radius = 0.0_wp !! of rollers in the rails' place, at z = 0 of the track,
                                           !! mm; 0: rails
    end type track_t

    !> One point of contact.
    type :: rigid_contact_t
        real(wp) :: y_wheel = 0.0_wp !! on the wheel profile, mm
        real(wp) :: z_wheel = 0.0_wp !! on the wheel profile, mm
        real(wp) :: y_rail = 0.0_wp  !! on the rail profile, mm
        real(wp) :: z_rail = 0.0_wp  !! on the rail profile, mm
        real(wp) :: y_track = 0.0_wp !! from the track centre, mm
        real(wp) :: gamma = 0.0_wp   !! contact angle, atan(dz/dy), rad; negative on the tread
        ! Given: dimensions of the reference's wheelset.
        real(wp) :: radius = 0.0_wp  !! rolling radius at the contact, mm
        real(wp) :: roller_radius = 0.0_wp !! of the roller there, mm; 0: of a rail
    end type rigid_contact_t

    !> The signs of Table 2 taken literally: cksi = Sx, not consistent with its spin. Only to
    !> reproduce the paper.
    !> Given: numbers of kinds.
    integer, parameter :: creepage_set_a = 1

    !> The physical signs: cksi = -Sx of Table 2, what a wheelset's motion gives.
    !> Given: numbers of kinds.
    integer, parameter :: creepage_set_b = 2

    !> Lengths and coordinates beyond are refused, mm.
    !> Tuned [mm]. Origin: safeguard.
    real(wp), parameter :: largest_length = 1.0e6_wp

contains

    !> The rigid contact of a right wheel on the right rail.
    !>
    !> The wheel comes down vertically: contact is where the vertical distance is smallest.
    pure subroutine find_rigid_contact(wheel, rail, wheelset, track, shift, contact, status)
        type(profile_t), intent(in) :: wheel           !! wheel profile
        type(profile_t), intent(in) :: rail            !! rail profile, inclined
        type(wheelset_t), intent(in) :: wheelset       !! mm
        type(track_t), intent(in) :: track             !! mm
        real(wp), intent(in) :: shift                  !! of the wheelset to the right, mm
        type(rigid_contact_t), intent(out) :: contact  !! where they touch
        type(status_t), intent(out) :: status          !! `st_bad_argument`: dimensions;
                                                       !! `st_out_of_range`: profiles too short;
                                                       !! `st_no_contact`: they do not overlap or
                                                       !! touch at the end of a profile
        real(wp) :: offset, first, last, z_crown, least
        logical :: found

        call check_setup(wheelset, track, shift, status)
        if (status%code /= 0) return
        call rail_offset(wheel, rail, wheelset, track, shift, offset, z_crown, status)
        if (status%code /= 0) return
        ! y is the coordinate of the rail profile; the wheel's is y + offset.
        first = max(rail%y_first, wheel%y_first - offset)
        last = min(rail%y_last, wheel%y_last - offset)
        if (last - first < 4.0_wp*scan_step) then
            call set_status(status, st_no_contact, 'wheel and rail do not overlap at the shift ' &
                            // trim(number_text(shift)) // ' mm')
            return
        end if
        call find_lowest_dip(wheel, rail, placing_t(wheel_level, offset), first, last, &
                             contact%y_rail, least, found)
        if (.not. found) then
            call set_status(status, st_no_contact, &
                            'wheel and rail touch at the end of a profile at the shift ' // &
                            trim(number_text(shift)) // ' mm')
            return
        end if
        call complete_contact(wheel, rail, wheelset, shift, offset, contact, status)
        if (is_roller(track)) &
            contact%roller_radius = track%roller_radius + z_crown - contact%z_rail
    end subroutine find_rigid_contact

    pure subroutine check_setup(wheelset, track, shift, status)
        type(wheelset_t), intent(in) :: wheelset
        type(track_t), intent(in) :: track
        real(wp), intent(in) :: shift
        type(status_t), intent(out) :: status

        call clear_status(status)
        call check_length('distance of the flange backs', wheelset%back_spacing, status)
        call check_length('distance of flange back and nominal rolling circle', &
                          wheelset%tread_line, status)
        call check_length('rolling radius', wheelset%radius, status)
        call check_length('gauge', track%gauge, status)
        call check_length('depth of the gauge below the crown', track%gauge_depth, status)
        if (is_apart(track)) call check_length('distance of the rails', track%rail_distance, status)
        if (status%code /= 0) return
        if (.not. ieee_is_finite(shift)) then
            call set_status(status, st_bad_argument, 'the lateral shift must be a finite ' // &
                            'number, got ' // number_text(shift))
        else if (abs(shift) > largest_place) then
            call set_status(status, st_bad_argument, &
                            'the lateral shift must be within 10 m, got ' // &
                            trim(number_text(shift)) // ' mm')
        end if
    end subroutine check_setup

    ! Is the distance of the rails given, and not their gauge?
    pure logical function is_apart(track)
        type(track_t), intent(in) :: track

        is_apart = track%rail_distance /= 0.0_wp
    end function is_apart

    ! Are there rollers in the place of rails?
    pure logical function is_roller(track)
        type(track_t), intent(in) :: track

        is_roller = track%roller_radius /= 0.0_wp
    end function is_roller

    ! Positive, finite, and no more than a kilometre.
    pure subroutine check_length(name, value, status)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: value
        type(status_t), intent(inout) :: status
        logical :: valid

        if (status%code /= 0) return
        valid = ieee_is_finite(value)
        if (valid) valid = value > 0.0_wp .and. value <= largest_length
        if (.not. valid) then
            call set_status(status, st_bad_argument, name // &
                            ' must be above 0 and at most 1e6 mm, got ' // trim(number_text(value)))
        end if
    end subroutine check_length

    ! What to add to a coordinate of the rail profile to get that of the wheel profile.
    pure subroutine rail_offset(wheel, rail, wheelset, track, shift, offset, z_crown, status)
        type(profile_t), intent(in) :: wheel, rail
        type(wheelset_t), intent(in) :: wheelset
        type(track_t), intent(in) :: track
        real(wp), intent(in) :: shift
        real(wp), intent(out) :: offset, z_crown
        type(status_t), intent(out) :: status
        real(wp) :: y_origin

        offset = 0.0_wp
        z_crown = 0.0_wp
        call clear_status(status)
        if (wheel%y_last <= wheel%y_first .or. rail%y_last <= rail%y_first) then
            call set_status(status, st_bad_argument, 'there is no wheel or no rail profile')
            return
        end if
        call place_rail(wheel, rail, wheelset, track, y_origin, status, z_crown)
        if (status%code /= 0) return
        offset = y_origin - (0.5_wp*wheelset%back_spacing + wheelset%tread_line + shift)
    end subroutine rail_offset

    !> Where the origin of a rail's profile lies in the track, of a wheelset that fits between the
    !> rails.
    pure subroutine place_rail(wheel, rail, wheelset, track, y_origin, status, z_crown)
        type(profile_t), intent(in) :: wheel      !! of both wheels
        type(profile_t), intent(in) :: rail       !! inclined
        type(wheelset_t), intent(in) :: wheelset  !! mm
        type(track_t), intent(in) :: track        !! mm
        real(wp), intent(out) :: y_origin         !! from the track centre to the field side, mm
        type(status_t), intent(out) :: status     !! `st_bad_argument`: they do not fit, or there
                                                  !! is no such roller; `st_out_of_range`: no
                                                  !! gauge face
        real(wp), intent(out), optional :: z_crown !! of the profile, mm; 0 where the distance of
                                                   !! the rails counts

        real(wp) :: y_gauge, top, bottom

        y_origin = 0.0_wp
        if (present(z_crown)) z_crown = 0.0_wp
        call clear_status(status)
        if (is_apart(track)) call check_length('distance of the rails', track%rail_distance, status)
        if (is_error(status)) return
        call find_gauge_point(rail, track%gauge_depth, y_gauge, status, top, bottom)
        if (is_apart(track)) then
            y_origin = 0.5_wp*track%rail_distance
            ! Without a gauge face nothing is known of how they fit.
            if (is_error(status)) then
                call clear_status(status)
            else
                call check_rolling_circles(wheelset%back_spacing, wheelset%tread_line, &
                                           track%rail_distance + 2.0_wp*y_gauge, status)
            end if
        else if (.not. is_error(status)) then
            y_origin = 0.5_wp*track%gauge - y_gauge
            if (present(z_crown)) z_crown = top
            call check_fit(wheel, wheelset%back_spacing, wheelset%tread_line, track%gauge, status)
            bottom = bottom - top
        end if
        if (is_roller(track)) call check_roller(track%roller_radius, bottom, status)
    end subroutine place_rail

    !> Refuse the radius of a roller whose profile would reach its axis.
    pure subroutine check_roller(radius, depth, status)
        real(wp), intent(in) :: radius          !! at z = 0 of the track, mm
        real(wp), intent(in) :: depth           !! largest z of its profile in the track, mm
        type(status_t), intent(inout) :: status !! `st_bad_argument`

        call check_length('radius of the rollers (0: rails)', radius, status)
        if (is_error(status)) return
        if (radius <= depth) &
            call set_status(status, st_bad_argument, 'radius of the rollers must be above the ' // &
                            trim(number_text(depth)) // ' mm that their profile reaches down, ' // &
                            'got ' // trim(number_text(radius)) // ' mm')
    end subroutine check_roller

    !> The point of the gauge face at a depth below the highest point of the rail, or the innermost
    !> one above it where the face overhangs.
    pure subroutine find_gauge_point(rail, depth, y_gauge, status, z_crown, z_bottom)
        type(profile_t), intent(in) :: rail   !! inclined
        real(wp), intent(in) :: depth         !! below the crown, mm
        real(wp), intent(out) :: y_gauge      !! on the profile, mm
        type(status_t), intent(out) :: status !! `st_out_of_range`: it does not reach so deep
        real(wp), intent(out) :: z_crown      !! highest point of the profile, mm
        real(wp), intent(out) :: z_bottom     !! bound of its lowest point, mm
        real(wp) :: z, dz, d2z, top, low, high, y, bounds(2)
        integer :: i, i_top

        bounds = profile_bounds(rail, rail%y_first, rail%y_last)
        z_bottom = bounds(2)
        call find_lowest_sample(rail, rail, placing_t(), rail%y_first, rail%y_last, top, i_top)
        ! The crown itself, where the slope changes sign next to the highest sample.
        low = sample(max(i_top - 1, 0))
        high = sample(i_top + 1)
        do i = 1, most_halvings
            y = 0.5_wp*(low + high)
            call profile_at(rail, y, z, dz, d2z, status)
            top = min(top, z)
            if (dz < 0.0_wp) then
                low = y
            else
                high = y
            end if
        end do
        z_crown = top
        ! From the crown inwards to the first sample below the depth.
        y_gauge = 0.0_wp
        i = i_top - 1
        do while (i >= 0)
            bounds = profile_bounds(rail, sample(max(i - stretch, 0)), sample(i))
            if (bounds(2) - top < depth - slack) then
                i = i - stretch
            else
                call profile_at(rail, sample(i), z, dz, d2z, status)
                if (z - top >= depth) exit
                i = i - 1
            end if
        end do
        if (i < 0 .and. rail%is_clipped .and. rail%z_below - top >= depth) then
            ! The gauge face overhangs: its innermost place is where it was clipped.
            y_gauge = rail%y_first
            return
        end if
        if (i < 0) then
            call set_status(status, st_out_of_range, 'the rail profile does not reach the ' // &
                            trim(number_text(depth)) // &
                            ' mm below its crown where the gauge is measured (gauge_depth_mm)')
            return
        end if
        low = sample(i)
        high = min(low + sample_step(rail%y_first, rail%y_last), rail%y_last)
        do i = 1, most_halvings
            y_gauge = 0.5_wp*(low + high)
            call profile_at(rail, y_gauge, z, dz, d2z, status)
            if (z - top >= depth) then
                low = y_gauge
            else
                high = y_gauge
            end if
        end do

    contains

        pure real(wp) function sample(number)
            integer, intent(in) :: number

            sample = sample_place(rail%y_first, rail%y_last, number)
        end function sample
    end subroutine find_gauge_point

    pure subroutine complete_contact(wheel, rail, wheelset, shift, offset, contact, status)
        type(profile_t), intent(in) :: wheel, rail
        type(wheelset_t), intent(in) :: wheelset
        real(wp), intent(in) :: shift, offset
        type(rigid_contact_t), intent(inout) :: contact
        type(status_t), intent(out) :: status
        real(wp) :: z_line, dz, d2z

        call profile_at(wheel, 0.0_wp, z_line, dz, d2z, status)
        if (is_error(status)) return
        contact%y_wheel = contact%y_rail + offset
        contact%y_track = 0.5_wp*wheelset%back_spacing + wheelset%tread_line + shift &
                          + contact%y_wheel
        call profile_at(wheel, contact%y_wheel, contact%z_wheel, dz, d2z, status)
        if (is_error(status)) return
        ! At a kink of the wheel the slope of the (smoother) rail is that of the contact.
        call profile_at(rail, contact%y_rail, contact%z_rail, dz, d2z, status)
        if (is_error(status)) return
        contact%gamma = atan(dz)
        contact%radius = wheelset%radius + contact%z_wheel - z_line
        if (contact%radius <= 0.0_wp) then
            call set_status(status, st_bad_argument, &
                            'the rolling radius at the contact must be above 0, got ' // &
                            trim(number_text(contact%radius)) // ' mm')
        end if
    end subroutine complete_contact

    !> The rigid contacts of both wheels. The left one is given in the mirrored frame, as if it
    !> were a right wheel.
    pure subroutine find_rigid_contacts(wheel, rail, wheelset, track, shift, right, left, &
                                        status)
        type(profile_t), intent(in) :: wheel        !! profile of both wheels
        type(profile_t), intent(in) :: rail         !! profile of both rails, inclined
        type(wheelset_t), intent(in) :: wheelset    !! mm
        type(track_t), intent(in) :: track          !! mm
        real(wp), intent(in) :: shift               !! of the wheelset to the right, mm
        type(rigid_contact_t), intent(out) :: right !! contact of the right wheel
        type(rigid_contact_t), intent(out) :: left  !! contact of the left wheel, mirrored
        type(status_t), intent(out) :: status       !! as `find_rigid_contact`

        call find_rigid_contact(wheel, rail, wheelset, track, shift, right, status)
        if (is_error(status)) return
        call find_rigid_contact(wheel, rail, wheelset, track, -shift, left, status)
    end subroutine find_rigid_contacts

    !> Normal force of a contact under a vertical load, `Fn = Q/cos(gamma)`, N.
    elemental real(wp) function contact_force(load, gamma)
        real(wp), intent(in) :: load  !! vertical load Q, N
        real(wp), intent(in) :: gamma !! contact angle, within +-pi/2, rad

        contact_force = load/cos(gamma)
    end function contact_force

    !> Creepages of the right wheel of a wheelset that rolls straight ahead, shifted, on rigid
    !> axles: `cksi = (rR - rL)/(2 r0)`, `ceta = 0`, `cphi = -sin(gamma)/r0`, of the rail surface
    !> relative to the wheel's. Table 2 has `|Sx| = |cksi|` and `Phi = |cphi|`. Rollers on one axle
    !> of their own, with the radii RR and RL at the contacts and the mean R of these, take
    !> `(RR - RL)/(2 R)` from cksi and add `-sin(gamma)/R` to cphi.
    pure function shift_creepage(wheelset, right, left, signs) result(creepage)
        type(wheelset_t), intent(in) :: wheelset   !! mm
        type(rigid_contact_t), intent(in) :: right !! contact of the right wheel
        type(rigid_contact_t), intent(in) :: left  !! contact of the left wheel
        integer, intent(in) :: signs               !! `creepage_set_a` or `creepage_set_b`
        type(creepage_t) :: creepage               !! -, -, rad/mm

        creepage%cksi = (right%radius - left%radius)/(2.0_wp*wheelset%radius)
        if (signs == creepage_set_a) creepage%cksi = -creepage%cksi
        creepage%ceta = 0.0_wp
        creepage%cphi = -sin(right%gamma)/wheelset%radius
        if (.not. right%roller_radius > 0.0_wp) return
        associate (both => right%roller_radius + left%roller_radius)
            creepage%cksi = creepage%cksi + merge(1.0_wp, -1.0_wp, signs == creepage_set_a) &
                            *(right%roller_radius - left%roller_radius)/both
            creepage%cphi = creepage%cphi - 2.0_wp*sin(right%gamma)/both
        end associate
    end function shift_creepage
end module faststrip_geometry_rigid_contact
