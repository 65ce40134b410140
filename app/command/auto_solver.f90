!> `--normal auto`: one contact as well as is wanted, by the core, and by Kalker's methods where it
!> cannot do.
module faststrip_command_auto_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_field_t
    use faststrip_contact_auto, only: taken_t, solve_contact_auto
    use faststrip_contact_methods, only: normal_norm, tangential_tang
    use faststrip_contact_solve, only: contact_result_t
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: wanted_t, needs_forces, target_pmax, target_area
    use faststrip_command_auto_stage, only: wanted_of, grid_step_t, first_grid, next_grid, &
                                            add_step, add_grid
    use faststrip_command_clock, only: microseconds, cpu_microseconds
    use faststrip_command_methods, only: numerics_t, core_methods
    use faststrip_command_stages, only: solver_t, outcome_t, solve_pressures, solve_forces, &
                                        estimate_figures, find_strip_forces, tell_forces, &
                                        add_times, take_figures, make_room
    implicit none
    private

    public :: solve_wanted

contains

    !> Solve a contact as well as is wanted.
    subroutine solve_wanted(solver, outcome, status)
        type(solver_t), intent(inout) :: solver   !! with a contact
        type(outcome_t), intent(inout) :: outcome !! figures, steps, times of all of them
        type(status_t), intent(out) :: status     !! an error, or a named limitation

        type(wanted_t) :: wanted
        type(contact_result_t) :: result
        type(taken_t) :: taken
        real(wp) :: cpu ! us

        call make_room(solver, status)
        if (is_error(status)) return
        wanted = wanted_of(solver%numerics, solver%case)
        cpu = cpu_microseconds()
        if (solver%with_field) then
            call solve_contact_auto(solver%workspace, solver%case, wanted, result, taken, status, &
                                    solver%field, curve=solver%curve)
        else
            call solve_contact_auto(solver%workspace, solver%case, wanted, result, taken, status, &
                                    curve=solver%curve)
        end if
        if (is_error(status)) return
        cpu = cpu_microseconds() - cpu
        call take_steps(taken, cpu, solver%tells_times, outcome)
        call take_result(result, outcome)
        solver%chosen%contact_methods_t = taken%steps(taken%best)%methods
        if (wanted%others%one_us > 0.0_wp .and. .not. taken%is_met) &
            call follow_on(solver, wanted, taken, outcome, status)
        if (solver%chosen%normal == normal_norm) return
        if (.not. needs_forces(wanted%target) .and. &
            solver%numerics%tangential == tangential_tang) then
            solver%chosen%tangential = tangential_tang
            solver%case%methods = core_methods(solver%chosen)
            call solve_forces(solver, outcome, status)
        else
            solver%case%methods = core_methods(solver%chosen)
            call tell_forces(solver, outcome)
            call find_strip_forces(solver, status)
        end if
    end subroutine solve_wanted

    !> Times and words of the core's steps.
    subroutine take_steps(taken, cpu_us, tells_times, outcome)
        type(taken_t), intent(in) :: taken
        real(wp), intent(in) :: cpu_us ! of all of them
        logical, intent(in) :: tells_times
        type(outcome_t), intent(inout) :: outcome

        real(wp) :: normal_us, tangential_us, share
        integer :: i

        normal_us = sum(taken%steps(:taken%n)%normal_us)
        tangential_us = sum(taken%steps(:taken%n)%tangential_us)
        outcome%normal_us = outcome%normal_us + normal_us
        outcome%tangential_us = outcome%tangential_us + tangential_us
        share = 1.0_wp
        if (tangential_us > 0.0_wp) share = normal_us/(normal_us + tangential_us)
        outcome%normal_cpu_us = outcome%normal_cpu_us + share*cpu_us
        outcome%tangential_cpu_us = outcome%tangential_cpu_us + (1.0_wp - share)*cpu_us
        outcome%choice = ''
        do i = 1, taken%n
            if (i > 1) outcome%choice = outcome%choice // '; '
            call add_step(taken%steps(i), tells_times, outcome%choice)
        end do
    end subroutine take_steps

    !> The figures of the core.
    subroutine take_result(result, outcome)
        type(contact_result_t), intent(in) :: result
        type(outcome_t), intent(inout) :: outcome

        outcome%normal = result%normal
        outcome%tangential = result%tangential
        outcome%certificate = result%certificate
        outcome%is_certified = result%is_estimated
        outcome%is_estimated = result%is_estimated
        outcome%force_errors = result%force_errors
        outcome%forces_are_estimated = result%forces_are_estimated
    end subroutine take_result

    !> Solve by Kalker's methods, on finer grids if their own estimates ask for it, and take what is
    !> better than the core's solution.
    subroutine follow_on(solver, wanted, taken, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(wanted_t), intent(in) :: wanted
        type(taken_t), intent(in) :: taken ! by the core
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(inout) :: status

        type(outcome_t) :: trial
        type(status_t) :: tried
        type(numerics_t) :: chosen
        type(contact_strips_t) :: strips
        type(tangential_field_t) :: field
        type(grid_step_t) :: step
        real(wp) :: best

        best = taken%estimate
        strips = solver%workspace%strips
        if (solver%with_field) field = solver%field
        chosen = solver%chosen
        step = first_grid(wanted, taken, solver%numerics, outcome%normal, strips, &
                          outcome%normal_us + outcome%tangential_us)
        do while (step%across > 0.0_wp)
            trial = outcome_t()
            call solve_on_grid(solver, wanted, strips, step, trial, tried)
            if (.not. is_error(tried)) step%estimate = max(step%estimate, &
                contradiction(wanted%target, outcome%normal, best, trial%normal))
            call add_times(trial, outcome)
            outcome%choice = outcome%choice // '; '
            call add_grid(step, solver%tells_times, outcome%choice)
            if (is_error(tried) .or. step%estimate >= best) then
                solver%workspace%strips = strips
                if (solver%with_field) solver%field = field
                solver%chosen = chosen
            else
                best = step%estimate
                call take_figures(trial, outcome)
                strips = solver%workspace%strips
                if (solver%with_field) field = solver%field
                chosen = solver%chosen
                call name_target(wanted, best, merge(solver%case%force_limit, &
                                                     solver%case%resolution_limit, &
                                                     needs_forces(wanted%target)), tried)
                status = tried
            end if
            if (is_error(tried) .or. best <= wanted%tolerance) exit
            step = next_grid(wanted, step, outcome%normal_us + outcome%tangential_us)
        end do
    end subroutine follow_on

    !> By how much more two solutions differ than the error that is told of the first: an error of
    !> one of them that nobody told.
    pure real(wp) function contradiction(target, first, error, second)
        integer, intent(in) :: target
        type(normal_result_t), intent(in) :: first, second
        real(wp), intent(in) :: error ! relative

        contradiction = 0.0_wp
        if (target == target_pmax) contradiction = unlike(first%pmax, second%pmax) - error
        if (target == target_area) contradiction = unlike(first%area, second%area) - error
    end function contradiction

    !> Difference of two figures over the larger.
    pure real(wp) function unlike(a, b)
        real(wp), intent(in) :: a, b

        unlike = abs(a - b)/max(a, b)
    end function unlike

    !> Both problems on one grid, and how wrong the target is.
    subroutine solve_on_grid(solver, wanted, strips, step, trial, status)
        type(solver_t), intent(inout) :: solver
        type(wanted_t), intent(in) :: wanted
        type(contact_strips_t), intent(in) :: strips ! to start from
        type(grid_step_t), intent(inout) :: step     ! its estimate and time are filled in
        type(outcome_t), intent(inout) :: trial
        type(status_t), intent(out) :: status

        type(contact_result_t) :: result
        real(wp) :: limits(2), cpu ! us
        integer(int64) :: before, after

        solver%chosen = solver%numerics
        solver%chosen%normal = normal_norm
        if (needs_forces(wanted%target)) solver%chosen%tangential = tangential_tang
        step%tangential = solver%chosen%tangential
        solver%chosen%element_dx = step%dx
        solver%chosen%element_dy = step%dy
        solver%chosen%dx_is_given = .true.
        solver%chosen%dy_is_given = .true.
        solver%chosen%error_target = 0.0_wp
        solver%case%methods = core_methods(solver%chosen)
        ! What is missing is told for the target.
        limits = [solver%case%resolution_limit, solver%case%force_limit]
        solver%case%resolution_limit = huge(1.0_wp)
        solver%case%force_limit = huge(1.0_wp)
        call solve_pressures(solver, trial, status, strips)
        if (.not. is_error(status)) call solve_forces(solver, trial, status)
        if (.not. is_error(status)) then
            cpu = cpu_microseconds()
            call system_clock(before)
            call estimate_figures(solver, trial, status)
            call system_clock(after)
            trial%tangential_us = trial%tangential_us + microseconds(before, after)
            trial%tangential_cpu_us = trial%tangential_cpu_us + cpu_microseconds() - cpu
        end if
        solver%case%resolution_limit = limits(1)
        solver%case%force_limit = limits(2)
        step%us = trial%normal_us + trial%tangential_us
        step%status = status
        if (is_error(status)) return
        result%normal = trial%normal
        result%certificate = trial%certificate
        result%is_estimated = trial%is_estimated
        result%tangential = trial%tangential
        result%force_errors = trial%force_errors
        result%forces_are_estimated = trial%forces_are_estimated
        step%estimate = target_error(wanted%target, solver%case, result)
    end subroutine solve_on_grid
end module faststrip_command_auto_solver
