!> `--normal auto` beyond the core: what is asked of it, which grid Kalker's methods take where
!> strips cannot do, and the words about all steps.
module faststrip_command_auto_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_auto, only: auto_step_t, taken_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_method_name, tangential_method_name, &
                                         normal_norm, tangential_none
    use faststrip_contact_target, only: unknown_error
    use faststrip_contact_wanted, only: wanted_t, others_t, others_across, others_time, &
                                        needs_forces, margin, target_area, target_pmax
    use faststrip_command_methods, only: numerics_t
    implicit none
    private

    public :: wanted_of, grid_step_t, first_grid, next_grid, add_step, add_grid

    ! Grids that Kalker's methods are tried on for one contact.
    integer, parameter :: most_grids = 3
    ! Strips across where Kalker's methods follow; their own estimate of the area falls slowly.
    integer, parameter :: most_strips = 41
    ! What Kalker's methods cost and how wrong they say they are, by target: forces, pmax,
    ! penetration, area, power; medians of 134 contacts of the families of `force-data`.
    type(others_t), parameter :: kalker(5) = [ &
        others_t(one_us=10.0_wp, one=1.3_wp, order=1.8_wp), &
        others_t(one_us=3.0_wp, over_strips=3.5_wp, order=2.0_wp), &
        others_t(one_us=3.0_wp, over_strips=2.9_wp, order=2.0_wp), &
        others_t(one_us=3.0_wp, over_strips=6.4_wp, order=1.3_wp), &
        others_t(one_us=10.0_wp, one=2.6_wp, order=1.8_wp)]
    ! Elements across the patch at least, and how many more the next try has at least and at most.
    real(wp), parameter :: least_across = 8.0_wp, least_growth = 1.4_wp, largest_growth = 3.0_wp
    ! Elements across where the largest grid is not expected to do: their estimate tells.
    real(wp), parameter :: telling_across = 30.0_wp
    ! A finer grid is not tried where the finest would be expected to miss by more than this factor.
    real(wp), parameter :: largest_miss = 10.0_wp
    ! What is left of a budget, of which so much is planned for a grid of which no time is known.
    real(wp), parameter :: share_of_budget = 0.6_wp
    ! Elements of a grid over those in its patches.
    real(wp), parameter :: surplus = 1.7_wp

    !> A try of Kalker's methods.
    type :: grid_step_t
        real(wp) :: across = 0.0_wp     !! elements across the widest patch, either way; 0: no try
        real(wp) :: dx = 0.0_wp         !! sides of the elements, mm
        real(wp) :: dy = 0.0_wp         !! the other
        integer :: tangential = tangential_none  !! method of the forces
        real(wp) :: estimate = unknown_error     !! of the target's error
        real(wp) :: us = 0.0_wp         !! its time, us
        type(status_t) :: status        !! how it ended
        integer, private :: number = 1  ! of this contact
        real(wp), private :: most_across = 0.0_wp
    end type grid_step_t

contains

    !> What is asked of the core: of pmax, where neither a target nor forces are asked for.
    pure type(wanted_t) function wanted_of(numerics, case) result(wanted)
        type(numerics_t), intent(in) :: numerics !! normal method auto
        type(contact_case_t), intent(in) :: case !! its material

        wanted = numerics%wanted
        if (.not. numerics%target_is_given .and. numerics%tangential == tangential_none) &
            wanted%target = target_pmax
        if (wanted%budget_us > 0.0_wp .and. .not. numerics%tolerance_is_given) &
            wanted%tolerance = 0.0_wp
        if (wanted%budget_us > 0.0_wp .and. others_time(kalker(wanted%target), least_across) &
            > share_of_budget*wanted%budget_us) return
        wanted%others = kalker(wanted%target)
        if (wanted%target /= target_area) wanted%most_strips = most_strips
    end function wanted_of

    !> The first try for a contact that strips cannot do.
    pure type(grid_step_t) function first_grid(wanted, taken, numerics, normal, strips, spent_us) &
        result(step)
        type(wanted_t), intent(in) :: wanted         !! target, tolerance and budget
        type(taken_t), intent(in) :: taken           !! what the core did
        type(numerics_t), intent(in) :: numerics     !! most elements
        type(normal_result_t), intent(in) :: normal  !! the core's figures
        type(contact_strips_t), intent(in) :: strips !! and strips
        real(wp), intent(in) :: spent_us             !! its time, us

        real(wp) :: width, across
        integer :: first, last

        width = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = last_of_patch(strips, first)
            width = max(width, strips%y_right(last) - strips%y_left(first))
        end do
        step%most_across = sqrt(numerics%max_elements/surplus*width/(normal%y_max - normal%y_min))
        across = least_across
        associate (coarse => taken%steps(max(taken%first, 1)))
            if (wanted%tolerance > 0.0_wp .and. coarse%estimate < unknown_error) &
                across = max(across, others_across(wanted, &
                                                   real(coarse%methods%strips_per_patch, wp), &
                                                   coarse%estimate))
        end associate
        if (across > step%most_across) across = min(telling_across, step%most_across)
        if (wanted%budget_us > 0.0_wp) then
            across = min(across, sqrt(share_of_budget*max(wanted%budget_us - spent_us, 0.0_wp) &
                                      /wanted%others%one_us))
            if (across < least_across) return
        end if
        across = real(ceiling(across), wp)
        step%across = across
        step%dx = 2.0_wp*normal%x_max/across
        step%dy = width/across
    end function first_grid

    !> The next try, on a finer grid; none if it would not help, or not fit.
    pure type(grid_step_t) function next_grid(wanted, last, spent_us) result(step)
        type(wanted_t), intent(in) :: wanted  !! target, tolerance and budget
        type(grid_step_t), intent(in) :: last !! with its estimate
        real(wp), intent(in) :: spent_us      !! all time so far, us

        real(wp) :: growth, reach

        if (last%estimate >= unknown_error .or. last%number >= most_grids) return
        reach = min(last%most_across/last%across, largest_growth**(most_grids - last%number))
        if (wanted%tolerance > 0.0_wp .and. wanted%budget_us <= 0.0_wp .and. &
            last%estimate > largest_miss*wanted%tolerance*reach**wanted%others%order) return
        growth = min(last%most_across/last%across, largest_growth)
        if (wanted%tolerance > 0.0_wp) &
            growth = min(growth, max(least_growth, (last%estimate/(margin*wanted%tolerance)) &
                                                   **(1.0_wp/wanted%others%order)))
        if (wanted%budget_us > 0.0_wp) &
            growth = min(growth, sqrt(max(wanted%budget_us - spent_us, 0.0_wp)/last%us))
        if (growth < least_growth) return
        growth = real(ceiling(growth*last%across), wp)/last%across
        step = last
        step%number = last%number + 1
        step%across = growth*last%across
        step%dx = last%dx/growth
        step%dy = last%dy/growth
        step%estimate = unknown_error
    end function next_grid

    !> Add a step of the core in words: methods, estimate, time.
    subroutine add_step(step, tells_time, text)
        type(auto_step_t), intent(in) :: step !! what was tried
        logical, intent(in) :: tells_time     !! else the words are those of any other run
        character(len=:), allocatable, intent(inout) :: text !! for the CSV

        associate (methods => step%methods)
            text = text // trim(normal_method_name(methods%normal)) // ' ' &
                   // integer_text(methods%strips_per_patch)
            if (methods%tangential /= tangential_none) &
                text = text // ' + ' // trim(tangential_method_name(methods%tangential)) // ' ' &
                       // integer_text(methods%points_per_strip)
        end associate
        call add_told(step%estimate, step%normal_us + step%tangential_us, tells_time, text)
    end subroutine add_step

    !> Add a try of Kalker's methods in words.
    subroutine add_grid(step, tells_time, text)
        type(grid_step_t), intent(in) :: step !! what was tried
        logical, intent(in) :: tells_time     !! as for `add_step`
        character(len=:), allocatable, intent(inout) :: text !! for the CSV

        text = text // trim(normal_method_name(normal_norm)) // ' ' &
               // integer_text(nint(step%across))
        if (step%tangential /= tangential_none) &
            text = text // ' + ' // trim(tangential_method_name(step%tangential))
        if (is_error(step%status)) then
            text = text // ': ' // trim(status_word(step%status%code))
        else
            call add_told(step%estimate, step%us, tells_time, text)
        end if
    end subroutine add_grid

    subroutine add_told(estimate, us, tells_time, text)
        real(wp), intent(in) :: estimate, us
        logical, intent(in) :: tells_time
        character(len=:), allocatable, intent(inout) :: text

        if (estimate < unknown_error) then
            text = text // ': ' // trim(short(estimate))
        else
            text = text // ': not known'
        end if
        if (tells_time) text = text // ' in ' // integer_text(nint(us)) // ' us'
    end subroutine add_told

    !> A number of two digits that count.
    function short(value) result(text)
        real(wp), intent(in) :: value
        character(len=24) :: text

        real(wp), parameter :: least_plain = 1.0e-6_wp, most_plain = 10.0_wp
        character(len=24) :: buffer, form

        if (value >= least_plain .and. value < most_plain) then
            write (form, '(a, i0, a)') '(f12.', 1 - floor(log10(value)), ')'
        else
            form = '(es8.1)'
        end if
        write (buffer, form) value
        text = adjustl(buffer)
    end function short
end module faststrip_command_auto_stage
