!> What Kalker's methods do where auto finds that strips cannot: grids, finer and finer ones.
module faststrip_contact_grids
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_field_t, strip_forces_t
    use faststrip_contact_case, only: contact_case_t, keeps_elements
    use faststrip_contact_clock, only: now, since
    use faststrip_contact_method, only: workspace_t, contact_result_t, normal_method_t, &
                                        normal_method_of, tangential_method_of
    use faststrip_contact_methods, only: normal_hertz, normal_norm, tangential_none, &
                                         tangential_tang, start_last
    use faststrip_contact_parts, only: find_pressures, add_forces
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: wanted_t, others_t, others_across, others_time, margin, &
                                        needs_forces, auto_step_t, auto_steps_t, unknown_error, &
                                        target_area, target_pmax
    implicit none
    private

    public :: plan_of_finer, follow_on, least_across, most_grids

    !> Grids that are tried for one contact.
    !> Tuned [grids]. Origin: chosen for the time.
    integer, parameter :: most_grids = 3
    ! Tuned [strips]: across where grids follow, unless the area is wanted: their own estimate of
    ! the area falls slowly. Origin: measured, 134 contacts of the families of `force-data`; 31 and
    ! 61 move 5 and 7 of 160 answers.
    integer, parameter :: most_strips = 41
    !> Elements across a patch at least.
    !> Tuned [elements]. Origin: as NORM's coarser grid.
    integer, parameter :: least_across = 8
    ! Tuned [1]: how many more the next try has at least and at most. Origin: chosen for the time;
    ! 1.3, as of strips, moves 12 of 160 answers by up to 1.1 %; 5 sends a contact of `./run net` to
    ! another grid.
    real(wp), parameter :: least_growth = 1.4_wp, largest_growth = 3.0_wp
    ! Tuned [elements]: across where the largest grid is not expected to do: their estimate tells.
    ! Origin: chosen for the time.
    real(wp), parameter :: telling_across = 30.0_wp
    ! Tuned [1]: a finer grid is not tried where the finest would be expected to miss by more than
    ! this factor. Origin: chosen for the time: without, hopeless contacts take half a minute.
    real(wp), parameter :: largest_miss = 10.0_wp
    ! Tuned [1]: of what is left of a budget, planned for a grid of which no time is known. Origin:
    ! chosen.
    real(wp), parameter :: share_of_budget = 0.6_wp
    ! Tuned [1]: Elements of a grid over those in its patches. Origin: measured; half and double
    ! move none of 160 answers: it bounds grids by `max_elements`.
    real(wp), parameter :: surplus = 1.7_wp

    !> A try.
    type :: grid_step_t
        real(wp) :: across = 0.0_wp     !! elements across the widest patch, either way; 0: no try
        real(wp) :: dx = 0.0_wp         !! sides of the elements, mm
        real(wp) :: dy = 0.0_wp         !! the other
        integer, private :: number = 1  ! of this contact
        real(wp), private :: most_across = 0.0_wp
    end type grid_step_t

contains

    !> What is expected of finer methods, if they are there and the budget allows for the coarsest
    !> grid; then fewer strips are tried.
    subroutine plan_of_finer(method, wanted, is_there)
        class(normal_method_t), pointer, intent(in) :: method !! or null
        type(wanted_t), intent(inout) :: wanted               !! gets it
        logical, intent(inout) :: is_there                    !! are they? true then

        type(others_t) :: others

        if (.not. associated(method)) return
        others = method%expected(wanted%target)
        if (.not. others%one_us > 0.0_wp) return
        if (wanted%budget_us > 0.0_wp .and. others_time(others, real(least_across, wp)) &
            > share_of_budget*wanted%budget_us) return
        is_there = .true.
        wanted%others = others
        if (wanted%target /= target_area) wanted%most_strips = min(wanted%most_strips, most_strips)
    end subroutine plan_of_finer

    !> The first try for a contact that strips cannot do.
    pure type(grid_step_t) function first_grid(wanted, taken, max_elements, normal, strips, &
                                               spent_us) result(grid)
        type(wanted_t), intent(in) :: wanted         !! target, tolerance and budget
        type(auto_steps_t), intent(in) :: taken      !! what the core did
        integer, intent(in) :: max_elements          !! most elements
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
        grid%most_across = sqrt(max_elements/surplus*width/(normal%y_max - normal%y_min))
        across = real(least_across, wp)
        associate (coarse => taken%steps(max(taken%first, 1)))
            if (wanted%tolerance > 0.0_wp .and. coarse%estimate < unknown_error) &
                across = max(across, others_across(wanted, &
                                                   real(coarse%methods%strips_per_patch, wp), &
                                                   coarse%estimate))
        end associate
        if (across > grid%most_across) across = min(telling_across, grid%most_across)
        if (wanted%budget_us > 0.0_wp) then
            across = min(across, sqrt(share_of_budget*max(wanted%budget_us - spent_us, 0.0_wp) &
                                      /wanted%others%one_us))
            if (across < least_across) return
        end if
        across = real(ceiling(across), wp)
        grid%across = across
        grid%dx = 2.0_wp*normal%x_max/across
        grid%dy = width/across
    end function first_grid

    !> The next try, on a finer grid; none if it would not help, or not fit.
    pure type(grid_step_t) function next_grid(wanted, last, step, spent_us) result(grid)
        type(wanted_t), intent(in) :: wanted  !! target, tolerance and budget
        type(grid_step_t), intent(in) :: last !! the last try
        type(auto_step_t), intent(in) :: step !! what came of it
        real(wp), intent(in) :: spent_us      !! all time so far, us

        real(wp) :: growth, reach

        if (step%estimate >= unknown_error .or. last%number >= most_grids) return
        reach = min(last%most_across/last%across, largest_growth**(most_grids - last%number))
        if (wanted%tolerance > 0.0_wp .and. wanted%budget_us <= 0.0_wp .and. &
            step%estimate > largest_miss*wanted%tolerance*reach**wanted%others%order) return
        growth = min(last%most_across/last%across, largest_growth)
        if (wanted%tolerance > 0.0_wp) &
            growth = min(growth, max(least_growth, (step%estimate/(margin*wanted%tolerance)) &
                                                   **(1.0_wp/wanted%others%order)))
        if (wanted%budget_us > 0.0_wp) &
            growth = min(growth, sqrt(max(wanted%budget_us - spent_us, 0.0_wp) &
                                      /(step%normal_us + step%tangential_us)))
        if (growth < least_growth) return
        growth = real(ceiling(growth*last%across), wp)/last%across
        grid = last
        grid%number = last%number + 1
        grid%across = growth*last%across
        grid%dx = last%dx/growth
        grid%dy = last%dy/growth
    end function next_grid

    !> Solve by Kalker's methods, on finer grids if their own estimates ask for it, and take what is
    !> better than the core's solution.
    subroutine follow_on(workspace, case, wanted, steps_case, best, solved_by, status, is_taken)
        type(workspace_t), intent(inout) :: workspace   !! with the core's solution; its steps go on
        type(contact_case_t), intent(in) :: case        !! as the caller has it
        type(wanted_t), intent(in) :: wanted            !! target, tolerance, budget
        type(contact_case_t), intent(inout) :: steps_case !! the same without gap, for the steps
        type(contact_result_t), intent(inout) :: best   !! of the core; a better one
        integer, intent(in) :: solved_by                !! normal method of the core's solution
        type(status_t), intent(out) :: status           !! of a solution that was taken
        logical, intent(out) :: is_taken                !! was one?

        type(contact_result_t) :: trial
        type(status_t) :: tried
        type(contact_strips_t) :: strips
        type(strip_forces_t) :: strip_forces
        type(tangential_field_t) :: field
        type(grid_step_t) :: grid
        type(auto_step_t) :: step

        is_taken = .false.
        strips = workspace%strips
        grid = first_grid(wanted, workspace%steps, case%methods%max_elements, best%normal, strips, &
                          time_of(workspace%steps))
        do while (grid%across > 0.0_wp)
            trial = contact_result_t()
            workspace%strips = strips
            call solve_on_grid(workspace, case, wanted, steps_case, grid, trial, step, tried)
            if (.not. is_error(tried)) step%estimate = max(step%estimate, &
                contradiction(wanted%target, best%normal, workspace%steps%estimate, trial%normal))
            workspace%steps%n = workspace%steps%n + 1
            workspace%steps%steps(workspace%steps%n) = step
            if (.not. is_error(tried) .and. step%estimate < workspace%steps%estimate) then
                is_taken = .true.
                best = trial
                workspace%steps%best = workspace%steps%n
                workspace%steps%estimate = step%estimate
                workspace%steps%is_met = step%estimate <= wanted%tolerance
                strips = workspace%strips
                if (keeps_elements(case)) field = workspace%field
                if (steps_case%asked%strip_forces) strip_forces = workspace%strip_forces
                status = tried
                call name_target(wanted, workspace%steps%estimate, &
                                 merge(case%force_limit, case%resolution_limit, &
                                       needs_forces(wanted%target)), status)
            end if
            if (is_error(tried) .or. workspace%steps%is_met) exit
            grid = next_grid(wanted, grid, step, time_of(workspace%steps))
        end do
        workspace%strips = strips
        workspace%solved_by = merge(normal_norm, solved_by, is_taken)
        workspace%is_ellipse = workspace%solved_by == normal_hertz
        if (.not. is_taken) return
        if (keeps_elements(case)) workspace%field = field
        if (steps_case%asked%strip_forces) workspace%strip_forces = strip_forces
    end subroutine follow_on

    !> Time of all steps so far, us.
    pure real(wp) function time_of(taken) result(us)
        type(auto_steps_t), intent(in) :: taken

        us = sum(taken%steps(:taken%n)%normal_us + taken%steps(:taken%n)%tangential_us)
    end function time_of

    !> By how much more two solutions differ than the error estimate of the first: an error of
    !> one of them that was not estimated.
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

    !> Both problems on one grid, and the error estimate of the target.
    subroutine solve_on_grid(workspace, case, wanted, steps_case, grid, trial, step, status)
        type(workspace_t), intent(inout) :: workspace ! with strips to start from
        type(contact_case_t), intent(in) :: case
        type(wanted_t), intent(in) :: wanted
        type(contact_case_t), intent(inout) :: steps_case
        type(grid_step_t), intent(in) :: grid
        type(contact_result_t), intent(inout) :: trial
        type(auto_step_t), intent(out) :: step
        type(status_t), intent(out) :: status

        integer(int64) :: before

        associate (methods => steps_case%methods)
            methods = case%methods
            methods%normal = normal_norm
            if (needs_forces(wanted%target)) methods%tangential = tangential_tang
            methods%element_dx = grid%dx
            methods%element_dy = grid%dy
            methods%dx_is_given = .true.
            methods%dy_is_given = .true.
            methods%error_target = 0.0_wp
            methods%norm_start = start_last
            step%methods = methods
        end associate
        step%across = nint(grid%across)
        steps_case%asked%field = case%asked%field .or. case%asked%temperatures
        steps_case%asked%subsurface = case%asked%subsurface
        before = now()
        call find_pressures(workspace, steps_case, normal_method_of(workspace, normal_norm), &
                            trial, status)
        step%normal_us = since(before)
        before = now()
        if (.not. is_error(status)) then
            if (step%methods%tangential /= tangential_none) &
                call add_forces(workspace, steps_case, &
                                tangential_method_of(workspace, step%methods%tangential), trial, &
                                status)
        end if
        step%tangential_us = since(before)
        if (is_error(status)) then
            step%code = status%code
        else
            step%estimate = target_error(wanted%target, steps_case, trial)
        end if
    end subroutine solve_on_grid
end module faststrip_contact_grids
