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
    use faststrip_normal_estimate_certificate, only: certificate_t
    use faststrip_normal_strips, only: contact_strips_t, copy_strips, last_of_patch
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_force_errors, only: estimate_force_errors, &
                                                 errors_of_fitted
    use faststrip_tangential_types, only: tangential_field_t, strip_forces_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_clock, only: now, since, lap_t, start_lap, add_lap
    use faststrip_contact_grids, only: grid_step_t, plan_of_finer, first_grid, next_grid
    use faststrip_contact_method, only: workspace_t, contact_result_t, normal_method_of, &
                                        tangential_method_t, tangential_method_of
    use faststrip_contact_methods, only: contact_methods_t, normal_strip, normal_hertz, &
                                         normal_norm, tangential_none, tangential_faststrip, &
                                         tangential_tang, start_last
    use faststrip_contact_parts, only: check_contact_friction, find_pressures, find_forces
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: wanted_t, check_wanted, needs_forces, margin, &
                                        others_across, others_time, auto_step_t, auto_steps_t, &
                                        unknown_error, most_steps, target_pmax, target_area
    implicit none
    private

    public :: solve_auto

    ! Tuned [steps]: Most steps by the core. Origin: safeguard: the estimate leads there in three.
    integer, parameter :: most_own_steps = 8
    ! Tuned [strips]: Strips that find the patches. Origin: time: fewer are no cheaper.
    integer, parameter :: first_strips = 5
    ! Tuned [strips]: Strips of a Hertz ellipse, which cost next to nothing. Origin: as
    ! strips_per_patch.
    integer, parameter :: hertz_strips = 15
    ! Tuned [points]: Least points along a strip. Origin: as points_per_strip; they are cheap.
    integer, parameter :: least_points = 15
    ! Tuned [power]: Power of the number of strips by which estimates fall, where nothing else is
    ! known, and its bounds where two steps tell it. Origin: measured on 200 contacts, 5 to 31
    ! strips: 1.9 for pmax, 2.1 for the penetration, 1.7 for the area; next to none at kinks.
    real(wp), parameter :: usual_order = 1.9_wp, least_order = 0.2_wp, largest_order = 2.5_wp
    ! Tuned [1]: As near as this part to what the method itself is wrong by is near enough. Origin:
    ! chosen.
    real(wp), parameter :: near = 0.1_wp
    ! Tuned [1]: Factor of the number of strips of a step at least. Origin: chosen for the time.
    real(wp), parameter :: least_growth = 1.3_wp
    ! Tuned [1]: Factor of the number of strips of a step at most: what few strips tell of many more
    ! is little. Origin: measured on contacts with waves and kinks.
    real(wp), parameter :: largest_growth = 5.0_wp
    ! Tuned [1]: Estimated error of the area up to which a Hertz ellipse tells others how large the
    ! contact is. Origin: chosen.
    real(wp), parameter :: nearly_ellipse = 0.2_wp
    ! Tuned [power]: Power of the number of strips by which their time grows. Origin: measured, 1.3
    ! from 5 to 15 strips, 1.6 from 15 to 31, 2.5 from there to 47.
    real(wp), parameter :: time_order = 1.6_wp
    ! Tuned [us]: Time of strips by what they cost: always, of a step, of an influence number with
    ! or without derivatives; of the estimate for a pair of strips. Origin: 58 contacts with 5 to 61
    ! strips, of which nine in ten are within a third. Counts tell it alike on every machine,
    ! however busy.
    real(wp), parameter :: always_us = 40.0_wp, step_us = 3.6_wp, number_us = 0.058_wp, &
                           pair_us = 0.36_wp
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
        type(auto_steps_t) :: taken
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
        call climb(search, workspace, case%warm_start, taken, status)
        if (.not. is_error(status)) call finish(search, workspace, case, taken, status)
        if (is_error(status)) then
            workspace%solved_by = 0
            return
        end if
        search%best%gap_change = result%gap_change
        search%best%times = result%times
        result = search%best
        workspace%steps = taken
        workspace%methods = taken%steps(taken%best)%methods
        if (.not. case%asked%times) return
        us = 0.0_wp
        cpu = 0.0_wp
        call add_lap(.true., lap, us, cpu)
        associate (times => result%times, steps => taken%steps(:taken%n))
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

        search%case%demand_t = case%demand_t
        search%case%material = case%material
        search%case%mu = case%mu
        search%case%friction = case%friction
        search%case%creepage = case%creepage
        search%case%asked%strip_forces = wants_strip_forces(case)
        ! What is under resolved for the target is told in the end.
        search%case%resolution_limit = huge(1.0_wp)
        search%case%force_limit = huge(1.0_wp)
    end subroutine begin_search

    !> Are sums over strips wanted, for themselves or for wear?
    pure logical function wants_strip_forces(case)
        type(contact_case_t), intent(in) :: case

        wants_strip_forces = case%asked%strip_forces .or. case%wear_law%n > 0
    end function wants_strip_forces

    !> Take steps until the estimate is met or nothing more would help.
    subroutine climb(search, workspace, warm_start, taken, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        logical, intent(in) :: warm_start
        type(auto_steps_t), intent(inout) :: taken
        type(status_t), intent(inout) :: status

        integer :: n

        call try_ellipse(search, workspace, taken)
        if (taken%is_met .or. is_left(search, workspace, taken) &
            .or. is_spent(search, taken)) return
        n = first_strips
        if (warm_start .and. workspace%first_strips > 0) n = workspace%first_strips
        n = min(n, search%wanted%most_strips)
        search%case%warm_start = warm_start
        do
            call solve_step(search, workspace, normal_strip, n, taken, status)
            if (is_error(status) .and. taken%n > 0) then
                ! What was found before stands.
                call clear_status(status)
                return
            end if
            if (is_error(status) .or. taken%is_met .or. taken%n == most_own_steps) return
            search%case%warm_start = .true.
            n = next_strips(search, workspace, taken)
            if (n == 0) return
        end do
    end subroutine climb

    !> Take the Hertz ellipse, with more strips if they are all that is missing, where its error is
    !> estimated.
    subroutine try_ellipse(search, workspace, taken)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(auto_steps_t), intent(inout) :: taken

        type(status_t) :: status
        integer :: n

        n = hertz_strips
        do while (n > 0 .and. taken%n < 2)
            call solve_step(search, workspace, normal_hertz, n, taken, status)
            if (is_error(status) .or. taken%n == 0 .or. taken%is_met) return
            n = next_strips(search, workspace, taken)
        end do
    end subroutine try_ellipse

    !> Is it known after an ellipse that strips cannot do, and is somebody there to follow?
    logical function is_left(search, workspace, taken)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(in) :: workspace
        type(auto_steps_t), intent(in) :: taken

        is_left = .false.
        if (taken%n == 0 .or. search%wanted%others%one_us <= 0.0_wp) return
        if (.not. needs_forces(search%wanted%target)) return
        ! An ellipse that is far off is no start for others.
        if (search%last%certificate%est_err_area > nearly_ellipse) return
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
    subroutine solve_step(search, workspace, normal, strips, taken, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        integer, intent(in) :: normal, strips ! method, and how many
        type(auto_steps_t), intent(inout) :: taken
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
                call add_forces_to(search, workspace, last, status)
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
        call add_step(search, workspace, step, taken)
    end subroutine solve_step

    !> Add a step; the best so far is kept.
    subroutine add_step(search, workspace, step, taken)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(auto_step_t), intent(in) :: step
        type(auto_steps_t), intent(inout) :: taken

        taken%n = taken%n + 1
        taken%steps(taken%n) = step
        if (taken%first == 0 .and. step%methods%normal == normal_strip) then
            taken%first = taken%n
            taken%first_across = narrow_across(workspace%strips)
        end if
        if (taken%best > 0 .and. step%estimate >= taken%estimate) return
        taken%best = taken%n
        taken%estimate = step%estimate
        taken%is_met = step%estimate <= search%wanted%tolerance
        search%best = search%last
        search%best_status = search%last_status
        search%best_solved_by = workspace%solved_by
        search%is_best = .true.
        if (.not. taken%is_met) call copy_strips(workspace%strips, workspace%best_strips)
    end subroutine add_step

    !> How many strips the next step takes; 0: none, nothing more would help or fit the budget.
    integer function next_strips(search, workspace, taken) result(n)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(in) :: workspace
        type(auto_steps_t), intent(in) :: taken

        type(fall_t) :: fall
        real(wp) :: growth, most, aim
        logical :: does_not_grow

        n = 0
        associate (step => taken%steps(taken%n), wanted => search%wanted)
            fall = fall_of(search, workspace, step)
            does_not_grow = search%before%normal == fall%normal &
                            .and. search%before%across >= fall%across
            search%before = fall
            ! More were asked for and did not settle.
            if (does_not_grow) return
            most = most_growth(search, taken, fall)
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
        associate (cost => search%last%normal%cost, n => workspace%strips%n)
            fall%us = always_us + step_us*cost%iterations + number_us*cost%values &
                      + number_us*cost%gradients + pair_us*real(n, wp)**2
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
            fall%order = min(max(fall%order, least_order), largest_order)
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
        associate (c => asked%certificate)
            c%est_err_pmax = c%est_err_pmax/finer**usual_order
            c%est_err_penetration = c%est_err_penetration/finer**usual_order
            c%est_err_area = c%est_err_area/finer**usual_order
        end associate
        case = search%case
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
                                   softened(search%case%material, search%case%friction), &
                                   search%case%mu, search%case%creepage, errors_of_fitted, &
                                   max(search%wanted%most_strips, least_points), &
                                   certificate_t(), asked%force_errors, status, &
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
    subroutine finish(search, workspace, case, taken, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(auto_steps_t), intent(inout) :: taken
        type(status_t), intent(out) :: status

        integer(int64) :: before
        logical :: is_finer

        if (.not. search%is_best) call copy_strips(workspace%best_strips, workspace%strips)
        workspace%solved_by = search%best_solved_by
        workspace%is_ellipse = search%best_solved_by == normal_hertz
        if (taken%steps(taken%best)%methods%normal == normal_strip) &
            workspace%first_strips = strips_next_time(search, taken)
        is_finer = .false.
        if (search%has_finer .and. .not. taken%is_met) &
            call follow_on(search, workspace, case, taken, status, is_finer)
        if (is_finer) return
        before = now()
        status = search%best_status
        ! Nobody asked for a number of strips.
        if (status%code == st_more_strips .or. status%code == st_fewer_strips) &
            call clear_status(status)
        search%case%methods = taken%steps(taken%best)%methods
        search%case%asked%field = case%asked%field
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
            call add_forces(search, workspace, status)
        else if (case%asked%field .or. wants_strip_forces(case) .and. .not. search%is_best) then
            call add_forces(search, workspace, status)
        end if
        if (is_error(status)) return
        associate (step => taken%steps(taken%best))
            step%methods = search%case%methods
            step%tangential_us = step%tangential_us + since(before)
        end associate
        call name_target(search%wanted, taken%estimate, limit_of(search, case), status)
    end subroutine finish

    !> Largest error that is called resolved, of what the target is of.
    pure real(wp) function limit_of(search, case) result(limit)
        type(search_t), intent(in) :: search
        type(contact_case_t), intent(in) :: case

        limit = merge(case%force_limit, case%resolution_limit, needs_forces(search%wanted%target))
    end function limit_of

    !> Solve by Kalker's methods, on finer grids if their own estimates ask for it, and take what is
    !> better than the core's solution.
    subroutine follow_on(search, workspace, case, taken, status, is_taken)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(auto_steps_t), intent(inout) :: taken
        type(status_t), intent(out) :: status
        logical, intent(out) :: is_taken ! was a solution taken?

        type(contact_result_t) :: trial
        type(status_t) :: tried
        type(contact_strips_t) :: strips
        type(strip_forces_t) :: strip_forces
        type(tangential_field_t) :: field
        type(grid_step_t) :: grid
        type(auto_step_t) :: step

        is_taken = .false.
        strips = workspace%strips
        grid = first_grid(search%wanted, taken, case%methods%max_elements, search%best%normal, &
                          strips, time_of(taken))
        do while (grid%across > 0.0_wp .and. taken%n < most_steps)
            trial = contact_result_t()
            workspace%strips = strips
            call solve_on_grid(search, workspace, case, grid, trial, step, tried)
            if (.not. is_error(tried)) step%estimate = max(step%estimate, &
                contradiction(search%wanted%target, search%best%normal, taken%estimate, &
                              trial%normal))
            taken%n = taken%n + 1
            taken%steps(taken%n) = step
            if (.not. is_error(tried) .and. step%estimate < taken%estimate) then
                is_taken = .true.
                search%best = trial
                taken%best = taken%n
                taken%estimate = step%estimate
                taken%is_met = step%estimate <= search%wanted%tolerance
                strips = workspace%strips
                if (case%asked%field) field = workspace%field
                if (wants_strip_forces(case)) strip_forces = workspace%strip_forces
                status = tried
                call name_target(search%wanted, taken%estimate, limit_of(search, case), status)
            end if
            if (is_error(tried) .or. taken%is_met) exit
            grid = next_grid(search%wanted, grid, step, time_of(taken))
        end do
        workspace%strips = strips
        workspace%solved_by = merge(normal_norm, search%best_solved_by, is_taken)
        workspace%is_ellipse = workspace%solved_by == normal_hertz
        if (.not. is_taken) return
        if (case%asked%field) workspace%field = field
        if (wants_strip_forces(case)) workspace%strip_forces = strip_forces
    end subroutine follow_on

    !> Time of all steps so far, us.
    pure real(wp) function time_of(taken) result(us)
        type(auto_steps_t), intent(in) :: taken

        us = sum(taken%steps(:taken%n)%normal_us + taken%steps(:taken%n)%tangential_us)
    end function time_of

    !> By how much more two solutions differ than the error that is told of the first: an error of
    !> one of them that nobody told.
    pure real(wp) function contradiction(target, first, error, second)
        integer, intent(in) :: target
        type(normal_result_t), intent(in) :: first, second
        real(wp), intent(in) :: error ! relative

        contradiction = 0.0_wp
        if (target == target_pmax) contradiction = difference(first%pmax, second%pmax) - error
        if (target == target_area) contradiction = difference(first%area, second%area) - error
    end function contradiction

    !> Difference of two figures over the larger.
    pure real(wp) function difference(a, b)
        real(wp), intent(in) :: a, b

        difference = abs(a - b)/max(a, b)
    end function difference

    !> Both problems on one grid, and how wrong the target is.
    subroutine solve_on_grid(search, workspace, case, grid, trial, step, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace ! with strips to start from
        type(contact_case_t), intent(in) :: case
        type(grid_step_t), intent(in) :: grid
        type(contact_result_t), intent(inout) :: trial
        type(auto_step_t), intent(out) :: step
        type(status_t), intent(out) :: status

        integer(int64) :: before

        associate (methods => search%case%methods)
            methods = case%methods
            methods%normal = normal_norm
            if (needs_forces(search%wanted%target)) methods%tangential = tangential_tang
            methods%element_dx = grid%dx
            methods%element_dy = grid%dy
            methods%dx_is_given = .true.
            methods%dy_is_given = .true.
            methods%error_target = 0.0_wp
            methods%norm_start = start_last
            step%methods = methods
        end associate
        step%across = nint(grid%across)
        search%case%asked%field = case%asked%field
        before = now()
        call find_pressures(workspace, search%case, normal_method_of(workspace, normal_norm), &
                            trial, status)
        step%normal_us = since(before)
        before = now()
        if (.not. is_error(status)) then
            if (step%methods%tangential /= tangential_none) &
                call add_forces_to(search, workspace, trial, status)
        end if
        step%tangential_us = since(before)
        if (is_error(status)) then
            step%code = status%code
        else
            step%estimate = target_error(search%wanted%target, search%case, trial)
        end if
    end subroutine solve_on_grid

    !> Strips that a contact like this one begins with in a warm start.
    pure integer function strips_next_time(search, taken) result(n)
        type(search_t), intent(in) :: search
        type(auto_steps_t), intent(in) :: taken

        n = taken%steps(taken%best)%methods%strips_per_patch
        if (taken%is_met) &
            n = min(n, odd_number(n*(taken%estimate/(margin*search%wanted%tolerance)) &
                                  **(1.0_wp/usual_order)))
        n = max(n, first_strips)
    end function strips_next_time

    !> Forces on the solution that is taken.
    subroutine add_forces(search, workspace, status)
        type(search_t), intent(inout) :: search
        type(workspace_t), intent(inout) :: workspace
        type(status_t), intent(inout) :: status ! changed by an error

        if (search%case%methods%tangential == tangential_none) return
        call add_forces_to(search, workspace, search%best, status)
    end subroutine add_forces

    !> Forces, and how wrong they are.
    subroutine add_forces_to(search, workspace, result, status)
        type(search_t), intent(in) :: search
        type(workspace_t), intent(inout) :: workspace
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        class(tangential_method_t), pointer :: method
        type(status_t) :: forces

        method => tangential_method_of(workspace, search%case%methods%tangential)
        call find_forces(workspace, search%case, method, result, forces)
        if (is_error(forces)) then
            status = forces
        else if (result%is_estimated) then
            call method%estimate(workspace, search%case, result, status)
        end if
    end subroutine add_forces_to
end module faststrip_contact_auto
