!> What to hold against a normal solution: limitations that are named with it.
!>
!> The strips solve the half-space of a gap whose longitudinal term A = 1/(2R) is positive. Where
!> the input is not like that the solution says so:
!>
!> - no finite patch: A is positive nowhere in the contact. Bodies that are cylinders along x, or
!>   hollow, touch along all of it;
!> - flat along x: somewhere in the contact A was not positive, or below 3 % of the geometric mean
!>   of the gap, and was raised to that. The patch there is as long as this makes it;
!> - half-space doubtful: a slope of the gap above 0.2 across a strip or at its tip, or
!>   surfaces whose inclination changes by more than 20 degrees over the contact, from patch to
!>   patch too: all have one plane. A half-space takes surfaces
!>   for planes and moves them along one normal; the slope's square, 4 %, is what is left out. The
!>   gap does not tell by how much the surfaces turn together, as wheel flange and rail corner do:
!>   that takes `gap_t%inclination`, which gaps made from profiles have. Likewise a step of the gap
!>   in a patch or at its end, a wall or a body's edge, if it is higher than 1 % of the penetration
!>   or steep beside the patch: the pressures at its foot are not bounded, and no strip is short
!>   enough for them.
!>
!> Heights count from anywhere, and the penetration with them: it may be of either sign. A contact
!> on fill values below the gap is an error.
!>
!> Of several limitations the status has the code of the first that applies here, the set of all,
!> and all of the words there is capacity for:
!>
!>     fallback_used, overlap_left, edge_of_data, flat_along_x, conformal, more_strips,
!>     fewer_strips, under_resolved
!>
!> Words of limitations are put together without taking memory: a solution with one is no rarer
!> than one without where gaps were measured.
module faststrip_normal_limitations
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_size, nothing, too_large
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     add_limitation, add_words, message_length, st_bad_argument, &
                                     st_edge_of_data, st_flat_along_x, st_conformal, &
                                     st_under_resolved, st_no_finite_patch, st_out_of_range, &
                                     first_error
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, gap_inv2r, gap_inclination, &
                                            inclination_change, largest_step
    use faststrip_normal_strips, only: contact_strips_t, ends_patch, load_of, middle_of, strips_load
    implicit none
    private

    public :: check_curvature, check_depth, check_lowest, name_limitations, name_steps, name_step
    public :: name_conformal, turn_of_contact, lean_of_contact, name_lean, doubtful_inclination
    public :: name_resolution, name_force_resolution, name_creepage_resolution
    public :: default_resolution, check_resolution

    !> Estimated relative error up to which a solution is called resolved. At 5 % twice, at 20 %
    !> half
    !> as many random gaps are named.
    !> Tuned [1]. Origin: as said with it.
    real(wp), parameter :: default_resolution = 0.1_wp

    ! Tuned [1]: Slope from which the half-space is doubtful. Origin: its square, 4 %, is what a
    ! half-space leaves out.
    real(wp), parameter :: doubtful_slope = 0.2_wp
    !> Change of inclination from which the half-space is doubtful.
    !> Tuned [rad]. Origin: as doubtful_slope, of two normals.
    real(wp), parameter :: doubtful_inclination = 20.0_wp*pi/180.0_wp
    ! Tuned [1]: part of the load that pressures on their own surfaces have along the plane of the
    ! contact, from which the half-space is doubtful. Origin: S1002 on 60E1 at 6.9 mm, where it is
    ! .03, the lateral force is wrong by 7 % of itself (virtual work); up to 6 mm it is below .014.
    real(wp), parameter :: doubtful_lean = 0.02_wp
    ! Height of a step over the penetration. Lower ones change it by less than 0.5 %.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: doubtful_step = 0.01_wp
    ! Slope of a step over penetration by half the patch's width. With 0.5 the maximum pressure is
    ! off by up to 20 %, with 0.1 by less than 1 %.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: doubtful_steepness = 0.2_wp
    ! Of all heights' range: a step as high as this leads to a fill value, and not over noise.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: fill_step = 0.5_wp

contains

    !> Refuse a gap whose longitudinal term is positive nowhere.
    pure subroutine check_curvature(curve, status)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        type(status_t), intent(out) :: status  !! `st_no_finite_patch`

        call clear_status(status)
        if (curve%least_inv2r > 0.0_wp) return
        call set_status(status, st_no_finite_patch, 'inv2r is positive nowhere in the gap, at ' &
                        //'most '//trim(number_text(maxval(curve%inv2r(:curve%n)))) &
                        //' 1/mm: no finite patch along x')
    end subroutine check_curvature

    !> Refuse a penetration that no contact has.
    pure subroutine check_depth(depth, status)
        real(wp), intent(in) :: depth         !! from the lowest height, above 0, mm
        type(status_t), intent(out) :: status !! `st_out_of_range`

        call clear_status(status)
        if (depth < nothing .or. depth > too_large) &
            call set_status(status, st_out_of_range, 'a contact beyond all proportion: ' &
                            //'penetration '//trim(number_text(min(depth, huge(depth))))//' mm')
    end subroutine check_depth

    !> Refuse a contact on fill values below the gap: its lowest stretch between steps is level,
    !> another one is a curve, and a step leads there that is high beside all heights and higher
    !> than the penetration. Heights count from anywhere: only differences are looked at.
    pure subroutine check_lowest(curve, depth, status)
        type(gap_curve_t), intent(in) :: curve  !! the gap that was solved
        real(wp), intent(in) :: depth           !! penetration from the lowest height, mm
        type(status_t), intent(inout) :: status !! `st_out_of_range`; an error before stays

        character(len=message_length) :: words
        real(wp) :: step
        integer :: lowest, first, last

        if (status%code >= first_error .or. .not. curve%has_steps) return
        associate (n => curve%n, h => curve%h(:curve%n))
            lowest = minloc(h, dim=1)
            call find_stretch(curve, lowest, first, last)
            step = 0.0_wp
            if (first > 1) step = h(first - 1) - h(first)
            if (last < n) step = max(step, h(last + 1) - h(last))
            if (step < max(depth, fill_step*maxval(h) - fill_step*h(lowest))) return
            if (is_curve(first, last)) return
            last = 0
            do
                if (last == n) return
                call find_stretch(curve, last + 1, first, last)
                if (is_curve(first, last)) exit
            end do
            words = 'the heights must not hold fill values below the gap: '//number_text(h(lowest))
            call add_words(words, ' mm at y = '//number_text(curve%y(lowest)))
            call add_words(words, ' mm, beyond a step of '//number_text(step))
            call add_words(words, ' mm')
        end associate
        call set_status(status, st_out_of_range, words)

    contains

        !> Are there enough points of different heights?
        pure logical function is_curve(first, last)
            integer, intent(in) :: first, last

            is_curve = last - first + 1 >= min_gap_points .and. &
                       .not. all(curve%h(first:last) == curve%h(first))
        end function is_curve
    end subroutine check_lowest

    !> The points around one of them that no step parts from it.
    pure subroutine find_stretch(curve, point, first, last)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: point
        integer, intent(out) :: first, last

        first = point
        do while (first > 1)
            if (curve%is_step(first - 1)) exit
            first = first - 1
        end do
        last = point
        do while (last < curve%n)
            if (curve%is_step(last)) exit
            last = last + 1
        end do
    end subroutine find_stretch

    !> Add to a status that a step of the gap lies in a patch.
    pure subroutine name_steps(curve, depth, strips, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: depth                !! penetration from the lowest height, mm
        type(contact_strips_t), intent(in) :: strips !! its solution
        type(status_t), intent(inout) :: status      !! limitations so far

        integer :: k, first
        logical :: is_named

        first = 1
        do k = 1, strips%n
            if (k < strips%n) then
                if (strips%patch(k + 1) == strips%patch(k)) cycle
            end if
            call name_step(curve, depth, 0.5_wp*(strips%y_right(k) - strips%y_left(first)), &
                           strips%y_left(first), strips%y_right(k), status, is_named)
            if (is_named) return
            first = k + 1
        end do
    end subroutine name_steps

    !> The same for one patch, or a part of it.
    pure subroutine name_step(curve, depth, half_width, y_from, y_to, status, is_named)
        type(gap_curve_t), intent(in) :: curve  !! the gap that was solved
        real(wp), intent(in) :: depth           !! penetration from the lowest height, mm
        real(wp), intent(in) :: half_width      !! of the patch, mm
        real(wp), intent(in) :: y_from, y_to    !! where to look for a step, mm
        type(status_t), intent(inout) :: status !! limitations so far
        logical, intent(out) :: is_named        !! is there such a step?

        character(len=message_length) :: words
        real(wp) :: step, steepest, y

        call largest_step(curve, y_from, y_to, step, steepest, y)
        is_named = step > doubtful_step*depth &
                   .or. steepest*half_width > doubtful_steepness*depth
        if (.not. is_named) return
        words = 'half-space doubtful: a step of '//number_text(step)
        call add_words(words, ' mm of the gap in a patch, at y = '//number_text(y))
        call add_words(words, ' mm')
        call add_limitation(status, st_conformal, words)
    end subroutine name_step

    !> Add to a status what the gap in the patches brings along: `st_edge_of_data`,
    !> `st_flat_along_x`, `st_conformal`, or instead of it the error `st_no_finite_patch`.
    pure subroutine name_limitations(curve, strips, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        type(contact_strips_t), intent(in) :: strips !! its solution
        type(status_t), intent(inout) :: status      !! limitations so far, no error

        character(len=message_length) :: words
        real(wp) :: lowest, highest, inv2r
        integer :: k

        if (strips%n < 1) return
        if (strips%y_left(1) <= curve%y(1) .or. strips%y_right(strips%n) >= curve%y(curve%n)) &
            call add_limitation(status, st_edge_of_data, &
                                'the contact runs to the end of the gap data')
        lowest = huge(1.0_wp)
        highest = -huge(1.0_wp)
        do k = 1, strips%n
            inv2r = gap_inv2r(curve, 0.5_wp*(strips%y_left(k) + strips%y_right(k)))
            lowest = min(lowest, inv2r)
            highest = max(highest, inv2r)
        end do
        if (highest <= 0.0_wp) then
            call set_status(status, st_no_finite_patch, 'inv2r is positive nowhere in the ' &
                            //'contact, at most '//trim(number_text(highest)) &
                            //' 1/mm: no finite patch along x')
            return
        end if
        if (lowest < curve%least_inv2r) then
            words = 'inv2r of '//number_text(lowest)
            call add_words(words, ' 1/mm in the contact raised to '//number_text(curve%least_inv2r))
            call add_limitation(status, st_flat_along_x, words)
        end if
        call name_conformal(curve, strips, status)
    end subroutine name_limitations

    !> Add to a status that surfaces turn or the gap is steep in the contact: `st_conformal`.
    pure subroutine name_conformal(curve, strips, status, is_ellipse)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        type(contact_strips_t), intent(in) :: strips !! its solution
        type(status_t), intent(inout) :: status      !! limitations so far, no error
        logical, intent(in), optional :: is_ellipse
            !! if present the strips at the ends and in the middle are looked at alone

        character(len=message_length) :: words
        real(wp) :: h_left, h_right, inv2r, slope, turn
        integer :: k, near

        slope = 0.0_wp
        near = 0
        do k = 1, strips%n
            if (present(is_ellipse) .and. all(k /= [1, (strips%n + 1)/2, strips%n])) cycle
            call gap_at(curve, strips%y_left(k), h_left, inv2r, near)
            call gap_at(curve, strips%y_right(k), h_right, inv2r, near)
            slope = max(slope, abs(h_right - h_left)/(strips%y_right(k) - strips%y_left(k)))
            inv2r = gap_inv2r(curve, 0.5_wp*(strips%y_left(k) + strips%y_right(k)))
            slope = max(slope, 2.0_wp*max(inv2r, 0.0_wp)*min(strips%half_length(k), largest_size))
        end do
        turn = turn_of_contact(curve, strips)
        if (turn > doubtful_inclination) then
            ! Given: degrees
            words = 'half-space doubtful: the inclination of the surfaces changes by ' &
                //number_text(turn*180.0_wp/pi)
            call add_words(words, ' degrees over the contact')
            call add_limitation(status, st_conformal, words)
        else if (slope > doubtful_slope) then
            words = 'half-space doubtful: a slope of '//number_text(slope)
            call add_words(words, ' of the gap in a patch')
            call add_limitation(status, st_conformal, words)
        end if
    end subroutine name_conformal

    !> By how much the inclination of the surfaces changes over a contact, all of its patches
    !> together, rad; zero if it is not known.
    pure real(wp) function turn_of_contact(curve, strips) result(turn)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        type(contact_strips_t), intent(in) :: strips !! its solution

        real(wp) :: low, high, ends(2)
        integer :: k, first

        turn = 0.0_wp
        low = huge(1.0_wp)
        high = -huge(1.0_wp)
        first = 1
        do k = 1, strips%n
            if (.not. ends_patch(strips, k)) cycle
            ends = [gap_inclination(curve, strips%y_left(first)), &
                    gap_inclination(curve, strips%y_right(k))]
            low = min(low, minval(ends))
            high = max(high, maxval(ends))
            turn = max(turn, high - low, inclination_change(curve, strips%y_left(first), &
                                                            strips%y_right(k)))
            first = k + 1
        end do
    end function turn_of_contact

    !> Mean by load of the sine of the strips' inclination: what pressures have along the plane of
    !> the contact, over the load; zero if no inclination is known.
    pure real(wp) function lean_of_contact(curve, strips) result(lean)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        type(contact_strips_t), intent(in) :: strips !! its solution

        integer :: k

        lean = 0.0_wp
        if (.not. curve%inclination_is_known) return
        do k = 1, strips%n
            lean = lean + load_of(strips, k)*sin(gap_inclination(curve, middle_of(strips, k)))
        end do
        lean = lean/max(strips_load(strips), tiny(lean))
    end function lean_of_contact

    !> Add to the status of a contact in a plane that its force has another direction by more than
    !> forces should: `st_conformal`.
    pure subroutine name_lean(curve, strips, status)
        type(gap_curve_t), intent(in) :: curve       !! the gap, in the mean plane of its contact
        type(contact_strips_t), intent(in) :: strips !! its solution
        type(status_t), intent(inout) :: status      !! limitations so far, no error

        character(len=message_length) :: words
        real(wp) :: lean

        lean = abs(lean_of_contact(curve, strips))
        if (lean <= doubtful_lean .or. btest(status%limitations, st_conformal)) return
        words = 'half-space doubtful: on their own surfaces pressures have a force of ' &
                //number_text(lean)
        call add_words(words, ' of the load along the plane of the contact')
        call add_limitation(status, st_conformal, words)
    end subroutine name_lean

    !> Add `st_under_resolved` to a status if an estimated error is above a limit, or no number.
    pure subroutine name_resolution(penetration, pmax, area, limit, status)
        real(wp), intent(in) :: penetration     !! estimated relative error of the penetration
        real(wp), intent(in) :: pmax            !! of the maximum pressure
        real(wp), intent(in) :: area            !! of the area
        real(wp), intent(in) :: limit           !! largest that is called resolved
        type(status_t), intent(inout) :: status !! limitations so far, or an error, which stays

        call name_first_above([pmax, penetration, area], &
                              [character(len=16) :: ' pmax', ' the penetration', ' the area'], &
                              [character(len=1) :: '', '', ''], limit, status)
    end subroutine name_resolution

    !> The same of forces.
    pure subroutine name_force_resolution(fx, fy, mz, limit, status)
        real(wp), intent(in) :: fx              !! estimated error of Fx over mu N
        real(wp), intent(in) :: fy              !! of Fy over mu N
        real(wp), intent(in) :: mz              !! of Mz over mu N c
        real(wp), intent(in) :: limit           !! largest that is called resolved
        type(status_t), intent(inout) :: status !! limitations so far, or an error, which stays

        call name_first_above([fx, fy, mz], [character(len=3) :: ' Fx', ' Fy', ' Mz'], &
                              [character(len=10) :: ' of mu N', ' of mu N', ' of mu N c'], limit, &
                              status)
    end subroutine name_force_resolution

    !> The same of creepages that were found.
    pure subroutine name_creepage_resolution(cksi, ceta, limit, status)
        real(wp), intent(in) :: cksi            !! estimated error of cksi, over the creepage
        real(wp), intent(in) :: ceta            !! of ceta
        real(wp), intent(in) :: limit           !! largest that is called resolved
        type(status_t), intent(inout) :: status !! limitations so far, or an error, which stays

        call name_first_above([cksi, ceta], [character(len=5) :: ' cksi', ' ceta'], &
                              [character(len=16) :: ' of the creepage', ' of the creepage'], &
                              limit, status)
    end subroutine name_creepage_resolution

    !> Name the first estimate that is above a limit.
    pure subroutine name_first_above(estimates, names, units, limit, status)
        real(wp), intent(in) :: estimates(:)
        character(len=*), intent(in) :: names(:), units(:) ! begin with a blank
        real(wp), intent(in) :: limit
        type(status_t), intent(inout) :: status

        character(len=message_length) :: words
        integer :: i

        if (is_error(status)) return
        do i = 1, size(estimates)
            if (.not. is_above(estimates(i))) cycle
            words = 'the estimated error of'
            call add_words(words, names(i))
            if (ieee_is_finite(estimates(i))) then
                call add_words(words, ' is above '//number_text(limit))
                call add_words(words, units(i))
                call add_words(words, ': '//number_text(estimates(i)))
            else
                call add_words(words, ' is beyond all proportion')
            end if
            call add_limitation(status, st_under_resolved, words)
            return
        end do

    contains

        !> A comparison with what is no number may trap.
        pure logical function is_above(number)
            real(wp), intent(in) :: number

            is_above = .not. ieee_is_finite(number)
            if (.not. is_above) is_above = number > limit
        end function is_above
    end subroutine name_first_above

    !> Refuse a limit that no estimate can be compared with.
    pure subroutine check_resolution(limit, name, status)
        real(wp), intent(in) :: limit         !! largest error that is called resolved
        character(len=*), intent(in) :: name  !! what it is called
        type(status_t), intent(out) :: status !! `st_bad_argument`: not above 0, or NaN

        character(len=message_length) :: words

        call clear_status(status)
        if (.not. ieee_is_nan(limit)) then
            if (limit > 0.0_wp) return
        end if
        words = name
        call add_words(words, ' must be above 0, got '//number_text(limit))
        call set_status(status, st_bad_argument, words)
    end subroutine check_resolution
end module faststrip_normal_limitations
