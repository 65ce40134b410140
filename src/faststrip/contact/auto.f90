!> Only the model a contact requires: solve cheaply, read the estimated errors, refine what they say
!> is missing, stop when the estimate of what is wanted meets the tolerance.
!>
!> Hertz is taken where the gap is near enough to a parabola for its error to be estimated; else a
!> few strips find the patches and more start from them. The estimate says how many: it falls with a
!> power of their number, to what the method itself is wrong by, which more strips do not help. What
!> strips cannot meet ends in `st_target_missed`, as near as they come, or is left to Kalker's
!> methods, on finer and finer grids, if they were entered. Methods whose errors are not estimated
!> are never taken.
!>
!> A workspace that was reserved for `normal_auto` is enough; without Kalker's methods nothing is
!> allocated.
module faststrip_contact_auto
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_friction, only: falls, softened
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_workspace_too_small, st_more_strips, &
                                     st_fewer_strips
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_strips, only: contact_strips_t, copy_strips, last_of_patch, usual_strips
    use faststrip_tangential_force_errors, only: estimate_force_errors, &
                                                 errors_of_fitted
    use faststrip_contact_case, only: contact_case_t, asked_t, keeps_elements, &
                                        wants_strip_forces
    use faststrip_contact_clock, only: now, since, lap_t, start_lap, add_lap
    use faststrip_contact_grids, only: plan_of_finer, follow_on, most_grids
    use faststrip_contact_method, only: workspace_t, contact_result_t, normal_method_of, &
                                        tangential_method_t, tangential_method_of
    use faststrip_contact_methods, only: contact_methods_t, normal_strip, normal_hertz, &
                                         normal_norm, tangential_none, tangential_faststrip, &
                                         tangential_tang
    use faststrip_contact_parts, only: check_contact_friction, find_pressures, add_forces
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: wanted_t, check_wanted, needs_forces, margin, &
                                        others_across, others_time, auto_step_t, auto_steps_t, &
                                        clear_steps, unknown_error, most_steps
    implicit none
    private

    public :: solve_auto

    ! Most steps by the core: grids may follow.
    integer, parameter :: most_own_steps = most_steps - most_grids
    ! Strips of a Hertz ellipse, which cost next to nothing; least points along a strip, which are
    ! cheap.
    integer, parameter :: hertz_strips = usual_strips, least_points = usual_strips
    ! Tuned [power]: Power of the number of strips by which estimates fall, where nothing else is
    ! known, and at least where two steps tell it. Origin: measured on 200 contacts, 5 to 31 strips:
    ! 1.9 for pmax, 2.1 for the penetration, 1.7 for the area; next to none at kinks.
    real(wp), parameter :: usual_order = 1.9_wp, least_order = 0.2_wp
    ! Tuned [1]: As near as this part to what the method itself is wrong by is near enough. Origin:
    ! chosen; 0.18 moves 4 of 160 answers.
    real(wp), parameter :: near = 0.1_wp
    ! Tuned [1]: Factor of the number of strips of a step at least. Origin: chosen for the time;
    ! 1.4, as of grids, moves one of 160 answers by 1.6 %.
    real(wp), parameter :: least_growth = 1.3_wp
    ! Tuned [1]: Factor of the number of strips of a step at most: what few strips tell of many more
    ! is little. Origin: measured on contacts with waves and kinks; 3 moves 2 of 160 answers.
    real(wp), parameter :: largest_growth = 5.0_wp
    ! Tuned [1]: Estimated error of the area up to which a Hertz ellipse tells others how large the
    ! contact is. Origin: chosen; of 160 answers half moves none, double one by 0.4 %; half sends
    ! contacts of `./run net` to strips before grids.
    real(wp), parameter :: nearly_ellipse = 0.2_wp
    ! Tuned [power]: Power of the number of strips by which their time grows. Origin: measured, 1.3
    ! from 5 to 15 strips, 1.6 from 15 to 31, 2.5 from there to 47; 2 sends contacts of `./run net`
    ! from strips to grids.
    real(wp), parameter :: time_order = 1.6_wp
    ! Tuned [us]: Time of strips by what they cost: always, of a step, of an influence coefficient.
    ! Origin: 20 contacts with 5 to 61 strips, with their estimates: nine in ten are within a third.
    ! Counts tell it alike on every machine, however busy.
    real(wp), parameter :: always_us = 22.0_wp, step_us = 1.0_wp, number_us = 0.055_wp
    ! Tuned [1]: Time of the first strips over that of an ellipse. Origin: measured.
    real(wp), parameter :: strips_over_ellipse = 8.0_wp

    !> How the estimate falls with the number of strips: to `least`, and the rest with a power.
    type :: fall_t
        integer :: normal = 0                    ! method
        real(wp) :: across = 0.0_wp              ! strips
        real(wp) :: estimate = unknown_error     ! with them
        real(wp) :: least = 0.0_wp               ! what more strips do not help
        real(wp) :: order = usual_order          ! the power
        real(wp) :: us = 0.0_wp                  ! time that such a solution takes
    end type fall_t

    !> Where the search is.
    type :: search_t
        type(wanted_t) :: wanted
        type(contact_case_t) :: case             ! without a gap, by the methods of the step
        type(contact_result_t) :: last, best     ! figures
        type(status_t) :: last_status, best_status
        integer :: best_solved_by = 0
        logical :: is_best = .false.             ! is the best in the workspace?
        logical :: has_finer = .false.           ! are Kalker's methods there?
        type(fall_t) :: before                   ! of the step before, if by the same normal method
        real(wp) :: idle_us = 0.0_wp             ! of what gave no step
        integer(int64) :: began = 0
    end type search_t

contains

    !> Solve a contact as well as is wanted, on the gap in the workspace.
    !>
    !> Of the case's methods only the tangential one counts, where the target does not need forces:
    !> they are computed by it on the solution that is taken; else the march takes its place, or
    !> TANG. `case%force_limit`, or `case%resolution_limit` where the target is no force, counts
    !> where no tolerance is given. With an error there is no result.
    subroutine solve_auto(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace   !! reserved for `normal_auto`
        type(contact_case_t), intent(in) :: case        !! what to solve, and how well
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result !! empty; gets the figures
        type(status_t), intent(out) :: status
            !! those of `check_wanted` and `solve_contact`; `st_workspace_too_small`: not reserved
            !! for `normal_auto`; limitation `st_target_missed`

        type(search_t) :: search
        type(lap_t) :: lap
        real(wp) :: us, cpu

        search%began = now()
        call start_lap(case%asked%times, lap)
        search%wanted = case%wanted
        if (associated(tangential_method_of(workspace, tangential_tang))) &
            call plan_of_finer(normal_method_of(workspace, normal_norm), search%wanted, &
                               search%has_finer)
        call check_case(workspace, case, search%wanted, method, status)
        if (is_error(status)) return
        call begin_search(case, search)
        call climb(search, workspace, case%warm_start, status)
        if (.not. is_error(status)) call finish(search, workspace, case, status)
        if (is_error(status)) then
            workspace%solved_by = 0
            call clear_steps(workspace%steps)
            return
        end if
        search%best%gap_change = result%gap_change
        search%best%times = result%times
        result = search%best
        workspace%methods = workspace%steps%steps(workspace%steps%best)%methods
        if (.not. case%asked%times) return
        us = 0.0_wp
        cpu = 0.0_wp
        call add_lap(.true., lap, us, cpu)
        associate (times => result%times, steps => workspace%steps%steps(:workspace%steps%n))
            us = sum(steps%normal_us)/max(sum(steps%normal_us + steps%tangential_us), &
                                          tiny(us))
            times%normal_us = times%normal_us + sum(steps%normal_us)
            times%tangential_us = times%tangential_us + sum(steps%tangential_us)
            times%normal_cpu_us = times%normal_cpu_us + us*cpu
            times%tangential_cpu_us = times%tangential_cpu_us + (1.0_wp - us)*cpu
        end associate
    end subroutine solve_auto

    !> Refuse what cannot be solved.
    subroutine check_case(workspace, case, wanted, method, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(wanted_t), intent(in) :: wanted
        class(tangential_method_t), intent(in) :: method
        type(status_t), intent(out) :: status

        logical :: is_reserved

        call check_wanted(wanted, case%methods%tangential, status)
        if (.not. is_error(status)) call check_contact_friction(case, method%about, status)
        if (is_error(status)) return
        if (falls(case%friction) .and. needs_forces(wanted%target)) then
            call set_status(status, st_bad_argument, 'normal method auto estimates no errors ' // &
                            'of forces where friction falls with slip: the target must be ' // &
                            'pmax, penetration or area')
            return
        end if
        is_reserved = allocated(workspace%best_strips%p0) .and. allocated(workspace%strips%p0)
        if (is_reserved) is_reserved = size(workspace%strips%p0) >= size(workspace%best_strips%p0)
        if (.not. is_reserved) call set_status(status, st_workspace_too_small, &
            'the workspace was not reserved for normal method auto')
    end subroutine check_case

    !> A case for the steps.
    subroutine begin_search(case, search)
        type(contact_case_t), intent(in) :: case
        type(search_t), intent(inout) :: search

        search%case%contact_terms_t = case%contact_terms_t
        search%case%asked = asked_t(strip_forces=wants_strip_forces(case))
        search%case%warm_start = .false.
        search%case%estimate = .true.
        ! What is under resolved for the target is reported in the end.
        search%case%resolution_limit = huge(1.0_wp)
        search%case%force_limit = huge(1.0_wp)
    end subroutine begin_search

    !> Take steps until the estimate is met or nothing more would help.
    subroutine climb(search, workspace, warm_start, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        logical, intent(in) :: warm_start
        type(status_t), intent(inout) :: status

        integer :: n

        if (search%wanted%ellipse) call try_ellipse(search, workspace)
        if (workspace%steps%is_met .or. is_left(search, workspace) &
            .or. is_spent(search, workspace%steps)) return
        n = search%wanted%first_strips
        if (warm_start .and. workspace%first_strips > 0) n = workspace%first_strips
        n = min(n, search%wanted%most_strips)
        search%case%warm_start = warm_start
        do
            call solve_step(search, workspace, normal_strip, n, status)
            if (is_error(status) .and. workspace%steps%n > 0) then
                ! What was found before stands.
                call clear_status(status)
                return
            end if
            if (is_error(status) .or. workspace%steps%is_met &
                .or. workspace%steps%n == most_own_steps) return
            search%case%warm_start = .true.
            n = next_strips(search, workspace)
            if (n == 0) return
        end do
    end subroutine climb

    !> Take the Hertz ellipse, with more strips if they are all that is missing, where its error is
    !> estimated.
    subroutine try_ellipse(search, workspace)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace

        type(status_t) :: status
        integer :: n

        n = hertz_strips
        do while (n > 0 .and. workspace%steps%n < 2)
            call solve_step(search, workspace, normal_hertz, n, status)
            if (is_error(status) .or. workspace%steps%n == 0 .or. workspace%steps%is_met) return
            n = next_strips(search, workspace)
        end do
    end subroutine try_ellipse

    !> Is it known after an ellipse that strips cannot do, and is somebody there to follow?
    logical function is_left(search, workspace)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(in) :: workspace

        is_left = .false.
        if (workspace%steps%n == 0 .or. search%wanted%others%one_us <= 0.0_wp) return
        if (.not. needs_forces(search%wanted%target)) return
        ! An ellipse that is far off is no start for others.
        if (search%last%normal_errors%est_err_area > nearly_ellipse) return
        is_left = least_of_strips(search, workspace) > search%wanted%tolerance
    end function is_left

    !> Is there an answer by an ellipse, and no time for strips?
    logical function is_spent(search, taken)
        type(search_t), intent(in) :: search
        type(auto_steps_t), intent(in) :: taken

        is_spent = .false.
        if (taken%n == 0 .or. search%wanted%budget_us <= 0.0_wp) return
        is_spent = since(search%began)*(1.0_wp + strips_over_ellipse) > search%wanted%budget_us
    end function is_spent

    !> Methods of a step.
    pure type(contact_methods_t) function methods_of(wanted, normal, strips) result(methods)
        type(wanted_t), intent(in) :: wanted
        integer, intent(in) :: normal, strips

        methods%normal = normal
        methods%tangential = merge(tangential_faststrip, tangential_none, &
                                   needs_forces(wanted%target))
        methods%strips_per_patch = strips
        methods%points_per_strip = max(strips, least_points)
    end function methods_of

    !> Solve by some methods, and keep the solution if it is the best; an ellipse without estimate
    !> is no step.
    subroutine solve_step(search, workspace, normal, strips, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        integer, intent(in) :: normal, strips ! method, and how many
        type(status_t), intent(out) :: status

        type(auto_step_t) :: step
        integer(int64) :: before

        before = now()
        step%methods = methods_of(search%wanted, normal, strips)
        search%case%methods = step%methods
        search%last = contact_result_t()
        search%is_best = .false.
        associate (last => search%last)
            call find_pressures(workspace, search%case, normal_method_of(workspace, normal), &
                                last, status)
            step%normal_us = search%idle_us + since(before)
            if (is_error(status) .or. &
                (normal == normal_hertz .and. .not. last%is_estimated)) then
                search%idle_us = step%normal_us
                return
            end if
            search%idle_us = 0.0_wp
            before = now()
            if (needs_forces(search%wanted%target)) then
                call add_forces(workspace, search%case, &
                                tangential_method_of(workspace, step%methods%tangential), last, &
                                status)
                if (is_error(status)) then
                    search%idle_us = step%normal_us + since(before)
                    return
                end if
            end if
            step%estimate = target_error(search%wanted%target, search%case, last)
            step%tangential_us = since(before)
            if (last%normal%strips_across > 0) &
                step%methods%strips_per_patch = last%normal%strips_across
            step%across = step%methods%strips_per_patch
        end associate
        search%last_status = status
        call add_step(search, workspace, step)
    end subroutine solve_step

    !> Add a step; the best so far is kept.
    subroutine add_step(search, workspace, step)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(auto_step_t), intent(in) :: step

        workspace%steps%n = workspace%steps%n + 1
        workspace%steps%steps(workspace%steps%n) = step
        if (workspace%steps%first == 0 .and. step%methods%normal == normal_strip) then
            workspace%steps%first = workspace%steps%n
            workspace%steps%first_across = narrow_across(workspace%strips)
        end if
        if (workspace%steps%best > 0 .and. step%estimate >= workspace%steps%estimate) return
        workspace%steps%best = workspace%steps%n
        workspace%steps%estimate = step%estimate
        workspace%steps%is_met = step%estimate <= search%wanted%tolerance
        search%best = search%last
        search%best_status = search%last_status
        search%best_solved_by = workspace%solved_by
        search%is_best = .true.
        if (.not. workspace%steps%is_met) call copy_strips(workspace%strips, workspace%best_strips)
    end subroutine add_step

    !> How many strips the next step takes; 0: none, nothing more would help or fit the budget.
    integer function next_strips(search, workspace) result(n)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(in) :: workspace

        type(fall_t) :: fall
        real(wp) :: growth, most, aim
        logical :: does_not_grow

        n = 0
        associate (step => workspace%steps%steps(workspace%steps%n), wanted => search%wanted)
            fall = fall_of(search, workspace, step)
            does_not_grow = search%before%normal == fall%normal &
                            .and. search%before%across >= fall%across
            search%before = fall
            ! More were asked for and did not converge.
            if (does_not_grow) return
            most = most_growth(search, workspace%steps, fall)
            growth = most
            if (fall%estimate >= unknown_error) then
                ! Given: twice as many.
                growth = min(growth, 2.0_wp)
            else
                if (is_beyond(fall, most, wanted)) return
                aim = max(margin*wanted%tolerance, (1.0_wp + near)*fall%least)
                if (fall%estimate <= aim) return
                if (aim > fall%least) &
                    growth = min(most, ((fall%estimate - fall%least)/(aim - fall%least)) &
                                       **(1.0_wp/fall%order))
            end if
            growth = min(max(growth, least_growth), most, largest_growth)
            n = min(odd_number(growth*fall%across), wanted%most_strips)
            if (n < least_growth*fall%across) n = 0
        end associate
    end function next_strips

    !> Times as many strips as there may be: they fit the budget, and take no longer than others.
    real(wp) function most_growth(search, taken, fall) result(growth)
        type(search_t), intent(in) :: search
        type(auto_steps_t), intent(in) :: taken
        type(fall_t), intent(in) :: fall

        real(wp) :: left, others

        associate (wanted => search%wanted, step => taken%steps(taken%n))
            growth = wanted%most_strips/fall%across
            if (wanted%budget_us > 0.0_wp) then
                left = max(wanted%budget_us - since(search%began), 0.0_wp)
                growth = min(growth, (left/max(step%normal_us + step%tangential_us, &
                                               tiny(1.0_wp)))**(1.0_wp/time_order))
            end if
            if (wanted%others%one_us <= 0.0_wp .or. wanted%tolerance <= 0.0_wp &
                .or. taken%first == 0 .or. fall%estimate >= unknown_error) return
            associate (first => taken%steps(taken%first))
                others = others_time(wanted%others, others_across(wanted, taken%first_across, &
                                                                  first%estimate))
            end associate
            growth = min(growth, (others/fall%us)**(1.0_wp/time_order))
        end associate
    end function most_growth

    !> Can more strips by the same method not do, and is there another way? From an ellipse there
    !> always is: strips.
    pure logical function is_beyond(fall, most, wanted)
        type(fall_t), intent(in) :: fall
        real(wp), intent(in) :: most ! times as many strips as there may be
        type(wanted_t), intent(in) :: wanted

        real(wp) :: reach

        reach = fall%least + (fall%estimate - fall%least)/max(most, 1.0_wp)**fall%order
        is_beyond = reach > wanted%tolerance &
                    .and. (wanted%others%one_us > 0.0_wp .or. fall%normal == normal_hertz)
    end function is_beyond

    !> How the estimate of the last step is going to fall.
    type(fall_t) function fall_of(search, workspace, step) result(fall)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(in) :: workspace
        type(auto_step_t), intent(in) :: step

        real(wp) :: growth

        fall%normal = step%methods%normal
        fall%across = step%methods%strips_per_patch
        fall%estimate = step%estimate
        associate (cost => search%last%normal%cost)
            fall%us = always_us + step_us*cost%iterations &
                      + number_us*(cost%values + cost%gradients)
        end associate
        if (needs_forces(search%wanted%target)) then
            fall%least = least_estimate(search, workspace, fall)
        else if (fall%normal == normal_hertz) then
            fall%least = fall%estimate
        end if
        associate (before => search%before)
            growth = fall%across/max(before%across, 1.0_wp)
            if (before%normal /= fall%normal .or. growth <= 1.0_wp) return
            if (before%estimate >= unknown_error .or. before%estimate <= before%least) return
            if (fall%estimate <= fall%least) return
            fall%order = log((before%estimate - before%least)/(fall%estimate - fall%least)) &
                         /log(growth)
            fall%order = max(fall%order, least_order)
        end associate
    end function fall_of

    !> What the method itself is wrong by: the estimate of as many strips as there may be, with
    !> estimates of the pressures as they would be then.
    real(wp) function least_estimate(search, workspace, fall) result(least)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(in) :: workspace
        type(fall_t), intent(in) :: fall

        class(tangential_method_t), pointer :: method
        type(contact_case_t) :: case
        type(contact_result_t) :: asked
        type(status_t) :: status
        real(wp) :: finer

        least = fall%estimate
        asked = search%last
        if (.not. asked%forces_are_estimated) return
        finer = max(search%wanted%most_strips/fall%across, 1.0_wp)
        associate (c => asked%normal_errors)
            c%est_err_pmax = c%est_err_pmax/finer**usual_order
            c%est_err_penetration = c%est_err_penetration/finer**usual_order
            c%est_err_area = c%est_err_area/finer**usual_order
        end associate
        case = search%case
        case%creepage = search%last%creepage
        case%methods%points_per_strip = max(search%wanted%most_strips, least_points)
        call clear_status(status)
        method => tangential_method_of(workspace, case%methods%tangential)
        call method%estimate(workspace, case, asked, status, finer)
        least = min(target_error(search%wanted%target, case, asked), fall%estimate)
    end function least_estimate

    !> The same after an ellipse for strips, if these had no errors of their own.
    real(wp) function least_of_strips(search, workspace) result(least)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(in) :: workspace

        type(contact_result_t) :: asked
        type(status_t) :: status

        asked = search%last
        call clear_status(status)
        call estimate_force_errors(workspace%strips, &
                                   softened(search%case%material, workspace%friction), &
                                   workspace%mu, search%last%creepage, errors_of_fitted, &
                                   max(search%wanted%most_strips, least_points), &
                                   normal_errors_t(), asked%force_errors, status, &
                                   search%wanted%most_strips/search%before%across)
        least = target_error(search%wanted%target, search%case, asked)
        if (is_error(status)) least = 0.0_wp
    end function least_of_strips

    !> Strips across the widest patch, if all were as narrow as those of the narrowest patch.
    pure real(wp) function narrow_across(strips) result(across)
        type(contact_strips_t), intent(in) :: strips

        real(wp) :: widest, width, narrowest
        integer :: first, last

        widest = 0.0_wp
        narrowest = huge(1.0_wp)
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = last_of_patch(strips, first)
            width = strips%y_right(last) - strips%y_left(first)
            widest = max(widest, width)
            narrowest = min(narrowest, width/(last - first + 1))
        end do
        across = widest/narrowest
    end function narrow_across

    !> The next odd number, upwards: one strip is in the middle.
    pure integer function odd_number(number)
        real(wp), intent(in) :: number

        odd_number = 2*(ceiling(number)/2) + 1
    end function odd_number

    !> Take the best solution, or a better one by Kalker's methods, and what else the case asks for
    !> on it; say what is missing.
    subroutine finish(search, workspace, case, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(out) :: status

        integer(int64) :: before
        logical :: is_finer

        if (.not. search%is_best) call copy_strips(workspace%best_strips, workspace%strips)
        workspace%solved_by = search%best_solved_by
        workspace%is_ellipse = search%best_solved_by == normal_hertz
        if (workspace%steps%steps(workspace%steps%best)%methods%normal == normal_strip) &
            workspace%first_strips = strips_next_time(search, workspace%steps)
        is_finer = .false.
        if (search%has_finer .and. .not. workspace%steps%is_met) &
            call follow_on(workspace, case, search%wanted, search%case, search%best, &
                           search%best_solved_by, status, is_finer)
        if (is_finer) return
        before = now()
        status = search%best_status
        ! Nobody asked for a number of strips.
        if (status%code == st_more_strips .or. status%code == st_fewer_strips) &
            call clear_status(status)
        search%case%methods = workspace%steps%steps(workspace%steps%best)%methods
        search%case%asked%field = case%asked%field .or. case%asked%temperatures
        search%case%asked%subsurface = case%asked%subsurface
        if (.not. needs_forces(search%wanted%target)) then
            search%case%methods%tangential = case%methods%tangential
            search%case%methods%points_per_strip = case%methods%points_per_strip
            search%case%methods%fastsim_nx = case%methods%fastsim_nx
            search%case%methods%fastsim_ny = case%methods%fastsim_ny
            search%case%methods%element_dx = case%methods%element_dx
            search%case%methods%element_dy = case%methods%element_dy
            search%case%methods%dx_is_given = case%methods%dx_is_given
            search%case%methods%dy_is_given = case%methods%dy_is_given
            search%case%methods%max_elements = case%methods%max_elements
            call add_best_forces(search, workspace, status)
        else if (keeps_elements(case) .or. wants_strip_forces(case) .and. .not. search%is_best) then
            call add_best_forces(search, workspace, status)
        end if
        if (is_error(status)) return
        associate (step => workspace%steps%steps(workspace%steps%best))
            step%methods = search%case%methods
            step%tangential_us = step%tangential_us + since(before)
        end associate
        call name_target(search%wanted, workspace%steps%estimate, &
                         merge(case%force_limit, case%resolution_limit, &
                               needs_forces(search%wanted%target)), status)
    end subroutine finish

    !> Strips that a contact like this one begins with in a warm start.
    pure integer function strips_next_time(search, taken) result(n)
        type(search_t), intent(in) :: search
        type(auto_steps_t), intent(in) :: taken

        n = taken%steps(taken%best)%methods%strips_per_patch
        if (taken%is_met) &
            n = min(n, odd_number(n*(taken%estimate/(margin*search%wanted%tolerance)) &
                                  **(1.0_wp/usual_order)))
        n = max(n, search%wanted%first_strips)
    end function strips_next_time

    !> Forces on the solution that is taken.
    subroutine add_best_forces(search, workspace, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(status_t), intent(inout) :: status ! changed by an error

        if (search%case%methods%tangential == tangential_none) return
        call add_forces(workspace, search%case, &
                        tangential_method_of(workspace, search%case%methods%tangential), &
                        search%best, status)
    end subroutine add_best_forces

end module faststrip_contact_auto
