!> Do a wheelset and a track belong together? The gauge and the distance of the flange backs are two
!> numbers of one thing: where one is said and the other is left alone, it has to follow.
module faststrip_geometry_gauge_fit
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_halvings
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    use faststrip_geometry_profile, only: profile_t, profile_at
    implicit none
    private

    public :: find_back_spacing, check_fit, check_rolling_circles

    ! Gauges within these ranges are of one kind of track, worn and widened in curves, and its
    ! wheelsets have these distances of the flange backs.
    ! Given: commission regulation (EU) 1302/2014 (LOC&PAS TSI), distances between 1357 and 1363 mm
    ! for 1435 mm, between 1437 and 1443 mm for 1520 mm; their middle.
    real(wp), parameter :: norm_spacing(2) = [1360.0_wp, 1440.0_wp]
    ! Tuned [mm]: These ranges. Origin: chosen: worn and widened tracks, but for those of 1520 mm
    ! that are as wide as 1524 mm.
    real(wp), parameter :: least_gauge(2) = [1410.0_wp, 1505.0_wp], &
                           most_gauge(2) = [1475.0_wp, 1523.0_wp]
    ! Tuned [mm]: The same of the distance of the rails' origins, between gauge face and crown.
    ! Origin: chosen: 20 to 92 mm more than these gauges, a head's width and some.
    real(wp), parameter :: least_distance(2) = [1430.0_wp, 1575.0_wp], &
                           most_distance(2) = [1555.0_wp, 1615.0_wp]
    ! Tuned [mm]: How much farther apart than the gauge faces the nominal rolling circles may be:
    ! each over a rail's head. Origin: 65 mm on standard gauge, 25 mm to the face and 45 mm to the
    ! field side.
    real(wp), parameter :: most_beyond_gauge = 110.0_wp
    ! Given: EN 15313: where a flange's thickness is measured, mm.
    real(wp), parameter :: flank_depth = 10.0_wp
    ! Tuned [mm]: Steps along the flange. Origin: chosen: finer than any flange; with
    ! the bisections that follow the place is that of any finer step.
    real(wp), parameter :: flank_step = 0.25_wp

contains

    !> The distance of the flange backs that belongs to a gauge, or to the distance of the rails.
    pure subroutine find_back_spacing(gauge, rail_distance, back_spacing, status)
        real(wp), intent(in) :: gauge         !! mm
        real(wp), intent(in) :: rail_distance !! of the origins of the profiles, mm; 0: the gauge
        real(wp), intent(out) :: back_spacing !! mm; 0 on an error
        type(status_t), intent(out) :: status !! `st_bad_argument`: none is known

        logical :: is_of(size(norm_spacing))

        call clear_status(status)
        if (abs(rail_distance) > 0.0_wp) then
            is_of = rail_distance >= least_distance .and. rail_distance <= most_distance
        else
            is_of = gauge >= least_gauge .and. gauge <= most_gauge
        end if
        back_spacing = sum(norm_spacing, mask=is_of)
        if (any(is_of)) return
        if (abs(rail_distance) > 0.0_wp) then
            call set_status(status, st_bad_argument, 'the distance of the flange backs must be ' &
                            // 'given with rails ' // trim(number_text(rail_distance)) // &
                            ' mm apart: those of gauge 1435 and 1520 mm alone are known')
        else
            call set_status(status, st_bad_argument, 'the distance of the flange backs must be ' &
                            // 'given with the gauge ' // trim(number_text(gauge)) // &
                            ' mm: those of 1435 and 1520 mm alone are known')
        end if
    end subroutine find_back_spacing

    !> A wheelset whose flanges do not go between the rails, or whose nominal rolling circles are
    !> not over them, is refused.
    pure subroutine check_fit(wheel, back_spacing, tread_line, gauge, status)
        type(profile_t), intent(in) :: wheel     !! of both wheels
        real(wp), intent(in) :: back_spacing     !! distance of the flange backs, mm
        real(wp), intent(in) :: tread_line       !! flange back to nominal rolling circle, mm
        real(wp), intent(in) :: gauge            !! mm
        type(status_t), intent(out) :: status    !! `st_bad_argument`

        real(wp) :: y_flank, play
        logical :: is_flanged

        call find_flank(wheel, y_flank, is_flanged)
        if (is_flanged) then
            play = gauge - (back_spacing + 2.0_wp*(tread_line + y_flank))
            if (play < 0.0_wp) then
                call set_status(status, st_bad_argument, trim(pair_words(gauge, back_spacing)) // &
                                ' fit, got a play of ' // trim(number_text(play)) // ' mm')
                return
            end if
        end if
        call check_rolling_circles(back_spacing, tread_line, gauge, status)
    end subroutine check_fit

    !> Nominal rolling circles that are not over the heads of the rails are refused.
    pure subroutine check_rolling_circles(back_spacing, tread_line, gauge, status)
        real(wp), intent(in) :: back_spacing     !! distance of the flange backs, mm
        real(wp), intent(in) :: tread_line       !! flange back to nominal rolling circle, mm
        real(wp), intent(in) :: gauge            !! mm
        type(status_t), intent(out) :: status    !! `st_bad_argument`

        real(wp) :: apart, belonging
        type(status_t) :: known

        call clear_status(status)
        apart = back_spacing + 2.0_wp*tread_line
        if (apart > gauge .and. apart <= gauge + most_beyond_gauge) return
        call find_back_spacing(gauge, 0.0_wp, belonging, known)
        if (is_error(known)) then
            call set_status(status, st_bad_argument, trim(pair_words(gauge, back_spacing)) // &
                            ' fit, got nominal rolling circles ' // trim(number_text(apart)) // &
                            ' mm apart')
        else
            call set_status(status, st_bad_argument, trim(pair_words(gauge, back_spacing)) // &
                            ' fit, got nominal rolling circles ' // trim(number_text(apart)) // &
                            ' mm apart; ' // trim(number_text(belonging)) // &
                            ' mm belong to this gauge')
        end if
    end subroutine check_rolling_circles

    pure function pair_words(gauge, back_spacing) result(words)
        real(wp), intent(in) :: gauge, back_spacing
        character(len=120) :: words

        words = 'the gauge ' // trim(number_text(gauge)) // &
                ' mm and the distance of the flange backs ' // &
                trim(number_text(back_spacing)) // ' mm must'
    end function pair_words

    ! Where the flange is as thick as EN 15313 measures it: from the nominal rolling circle inwards
    ! the first place so far below it.
    pure subroutine find_flank(wheel, y_flank, is_flanged)
        type(profile_t), intent(in) :: wheel
        real(wp), intent(out) :: y_flank
        logical, intent(out) :: is_flanged

        real(wp) :: z_line, dz, d2z, low, high
        type(status_t) :: status
        integer :: step

        y_flank = 0.0_wp
        is_flanged = .false.
        call profile_at(wheel, 0.0_wp, z_line, dz, d2z, status)
        if (is_error(status)) return
        high = 0.0_wp
        do
            low = max(high - flank_step, wheel%y_first)
            is_flanged = depth(low) >= flank_depth
            if (is_flanged .or. .not. low > wheel%y_first) exit
            high = low
        end do
        if (.not. is_flanged) return
        do step = 1, most_halvings
            y_flank = 0.5_wp*(low + high)
            if (depth(y_flank) >= flank_depth) then
                low = y_flank
            else
                high = y_flank
            end if
        end do

    contains

        pure real(wp) function depth(y)
            real(wp), intent(in) :: y

            real(wp) :: z, slope, bend
            type(status_t) :: inside

            call profile_at(wheel, y, z, slope, bend, inside)
            depth = z - z_line
        end function depth
    end subroutine find_flank
end module faststrip_geometry_gauge_fit
