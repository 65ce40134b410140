!> One contact from gap to forces, by the methods asked for, with the time each stage took.
module faststrip_command_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, number_text, &
                                     st_beyond_yield
    use faststrip_base_material, only: check_material
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, &
                                            copy_gap_curve
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_normal_limitations, only: add_limitation
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_strip, normal_hertz, normal_auto
    use faststrip_contact_solve, only: reserve_contact_field
    use faststrip_command_auto_solver, only: solve_wanted
    use faststrip_command_clock, only: microseconds, cpu_microseconds
    use faststrip_command_methods, only: numerics_t, core_methods
    use faststrip_command_norm_stage, only: release_norm_stage
    use faststrip_command_stages, only: solver_t, outcome_t, solve_pressures, solve_forces, &
                                        estimate_figures
    use faststrip_command_tang_stage, only: release_tang_stage
    use faststrip_command_wear_figures, only: find_wear_figures
    implicit none
    private

    public :: solver_t, release_solver, outcome_t, make_solver, solve, name_yield
    public :: own_solver_t, new_solver, free_solver
    public :: ready_gap_t, make_ready

    !> A solver in memory of its own. An array of these takes a moment to compile; where an array of
    !> solvers is made gfortran 12 writes out how each part of them begins, for a minute.
    type :: own_solver_t
        type(solver_t), pointer :: solver => null() !! of `new_solver`, for `free_solver`
    end type own_solver_t

    !> A gap that is ready for many contacts.
    type :: ready_gap_t
        integer(int64) :: id = 0          !! number that no other gap of the run has, above 0
        type(gap_curve_t) :: curve        !! smoothed if that was asked for
        real(wp) :: change_um = 0.0_wp    !! rms change by that, um
    end type ready_gap_t

contains

    !> Allocate for a choice of methods. A solver that has served another choice keeps its capacity:
    !> with INTENT(OUT) gfortran 12 would finalise it, free what it holds and leave the numbers that
    !> tell how much that is.
    subroutine make_solver(numerics, with_field, solver, status, with_strip_forces)
        type(numerics_t), intent(in) :: numerics !! checked
        logical, intent(in) :: with_field       !! are the elements wanted?
        type(solver_t), intent(inout) :: solver !! ready
        type(status_t), intent(out) :: status   !! from the library
        logical, intent(in), optional :: with_strip_forces !! are the sums of each strip wanted?

        solver%numerics = numerics
        solver%with_field = with_field
        call clear_status(status)
        if (with_field) &
            call reserve_contact_field(solver%field, core_methods(numerics), status)
        solver%with_strip_forces = .false.
        if (present(with_strip_forces)) solver%with_strip_forces = with_strip_forces
        ! Wear is that of the strips.
        if (numerics%wear%law%n > 0) solver%with_strip_forces = .true.
    end subroutine make_solver

    !> Allocate and make one. Arguments as those of `make_solver`.
    subroutine new_solver(numerics, own, status)
        type(numerics_t), intent(in) :: numerics !! checked
        type(own_solver_t), intent(inout) :: own !! had none
        type(status_t), intent(out) :: status    !! from the library

        allocate (own%solver)
        call make_solver(numerics, .false., own%solver, status)
    end subroutine new_solver

    !> Give one back with all it has.
    subroutine free_solver(own)
        type(own_solver_t), intent(inout) :: own !! has none afterwards

        if (.not. associated(own%solver)) return
        call release_solver(own%solver)
        deallocate (own%solver)
    end subroutine free_solver

    !> Give back what the compiler does not.
    subroutine release_solver(solver)
        type(solver_t), intent(inout) :: solver !! serves again

        call release_norm_stage(solver%norm)
        call release_tang_stage(solver%tang)
    end subroutine release_solver

    !> Solve one contact.
    subroutine solve(solver, case, outcome, status, ready)
        type(solver_t), intent(inout) :: solver     !! made beforehand
        class(contact_case_t), intent(in) :: case   !! what to solve; its methods do not count
        type(outcome_t), intent(out) :: outcome     !! figures
        type(status_t), intent(out) :: status       !! an error, or a named limitation
        type(ready_gap_t), intent(in), optional :: ready !! its gap; that of the case does not count

        call solve_methods(solver, case, outcome, status, ready)
        if (is_error(status)) return
        call name_yield(solver%numerics%yield_mpa, outcome%normal%pmax, status)
        if (outcome%has_forces) &
            call find_wear_figures(solver%numerics%wear, outcome%normal, outcome%tangential, &
                                   solver%case%creepage, solver%workspace%strips, &
                                   solver%strip_forces, outcome%wear)
    end subroutine solve

    !> The same without the limit of the user.
    subroutine solve_methods(solver, case, outcome, status, ready)
        type(solver_t), intent(inout) :: solver     !! made beforehand
        class(contact_case_t), intent(in) :: case   !! what to solve; its methods do not count
        type(outcome_t), intent(out) :: outcome     !! figures
        type(status_t), intent(out) :: status       !! an error, or a named limitation
        type(ready_gap_t), intent(in), optional :: ready !! its gap

        outcome%choice = ''
        if (present(ready)) then
            call take_ready(solver, case, ready, outcome, status)
        else
            call take_contact(solver, case, outcome, status)
        end if
        if (is_error(status)) return
        solver%chosen = solver%numerics
        solver%case%methods = core_methods(solver%chosen)
        if (solver%numerics%normal == normal_auto) then
            call solve_wanted(solver, outcome, status)
            return
        end if
        ! Errors are estimated outside the time that is measured.
        solver%case%estimate = .not. any(solver%case%methods%normal == [normal_strip, normal_hertz])
        call solve_pressures(solver, outcome, status)
        if (is_error(status)) return
        call solve_forces(solver, outcome, status)
        if (.not. is_error(status)) call estimate_figures(solver, outcome, status)
    end subroutine solve_methods

    !> Name a largest pressure above the limit that the user has set.
    subroutine name_yield(limit, pmax, status)
        real(wp), intent(in) :: limit          !! MPa; 0: none
        real(wp), intent(in) :: pmax           !! MPa
        type(status_t), intent(inout) :: status !! gets `st_beyond_yield`

        if (.not. limit > 0.0_wp .or. pmax <= limit) return
        call add_limitation(status, st_beyond_yield, 'pmax of ' // trim(number_text(pmax)) // &
                            ' MPa is above the limit of ' // trim(number_text(limit)) // ' MPa')
    end subroutine name_yield

    !> Check the contact, smooth its gap if that is asked for, and make it a curve once for all
    !> methods, which counts as normal time.
    subroutine take_contact(solver, case, outcome, status)
        type(solver_t), intent(inout) :: solver
        class(contact_case_t), intent(in) :: case
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        type(environment_t) :: environment
        integer(int64) :: before, after
        real(wp) :: cpu ! us

        call check_material(case%material, status)
        if (is_error(status)) return
        solver%case = case
        call smooth_if_wanted(solver%numerics, solver%case%gap, outcome%gap_change_um, status)
        if (is_error(status)) return
        call check_gap(solver%case%gap, status)
        if (is_error(status)) return
        call reserve_gap_curve(solver%curve, size(solver%case%gap%y), status)
        if (is_error(status)) return
        solver%gap_id = 0
        cpu = cpu_microseconds()
        call system_clock(before)
        ! As the library does: in its own rounding mode, without the host's traps.
        call hold_environment(environment)
        call set_gap_curve(solver%curve, solver%case%gap, status)
        call restore_environment(environment)
        call system_clock(after)
        outcome%normal_us = microseconds(before, after)
        outcome%normal_cpu_us = cpu_microseconds() - cpu
    end subroutine take_contact

    !> The same with a gap that is a curve already: only copied, unless it is that of the last
    !> contact.
    subroutine take_ready(solver, case, ready, outcome, status)
        type(solver_t), intent(inout) :: solver
        class(contact_case_t), intent(in) :: case
        type(ready_gap_t), intent(in) :: ready
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        call check_material(case%material, status)
        if (is_error(status)) return
        solver%case = case
        outcome%gap_change_um = ready%change_um
        if (solver%gap_id == ready%id) return
        solver%gap_id = 0
        call reserve_gap_curve(solver%curve, ready%curve%n, status)
        if (is_error(status)) return
        call copy_gap_curve(ready%curve, solver%curve, status)
        if (.not. is_error(status)) solver%gap_id = ready%id
    end subroutine take_ready

    !> Smooth a gap if that is asked for.
    subroutine smooth_if_wanted(numerics, gap, change_um, status)
        type(numerics_t), intent(in) :: numerics
        type(gap_t), intent(inout) :: gap
        real(wp), intent(out) :: change_um ! rms, um
        type(status_t), intent(out) :: status

        type(gap_t) :: smooth
        real(wp) :: change ! mm

        change_um = 0.0_wp
        call clear_status(status)
        if (numerics%smoothing_um <= 0.0_wp) return
        call smooth_gap(gap, 1.0e-3_wp*numerics%smoothing_um, smooth, change, status)
        if (is_error(status)) return
        gap = smooth
        change_um = 1.0e3_wp*change
    end subroutine smooth_if_wanted

    !> Make a gap ready for many contacts: smoothed if that is asked for, and a curve.
    subroutine make_ready(numerics, gap, ready, status)
        type(numerics_t), intent(in) :: numerics    !! what was asked for
        type(gap_t), intent(inout) :: gap           !! is smoothed
        type(ready_gap_t), intent(inout) :: ready   !! its number is the caller's
        type(status_t), intent(out) :: status       !! those of `smooth_gap` and `check_gap`

        type(environment_t) :: environment

        call smooth_if_wanted(numerics, gap, ready%change_um, status)
        if (.not. is_error(status)) call check_gap(gap, status)
        if (.not. is_error(status)) call reserve_gap_curve(ready%curve, size(gap%y), status)
        if (is_error(status)) return
        call hold_environment(environment)
        call set_gap_curve(ready%curve, gap, status)
        call restore_environment(environment)
    end subroutine make_ready
end module faststrip_command_solver
