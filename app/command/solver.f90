!> One contact from gap to forces, by the methods asked for, with the time each stage took.
module faststrip_command_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_ok
    use faststrip_base_material, only: check_material
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_limitations, only: name_resolution
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          strip_forces_t, reserve_strip_forces
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_strip, normal_hertz, normal_norm, normal_auto, &
                                         tangential_none, tangential_faststrip, &
                                         tangential_tang, gives_stick
    use faststrip_contact_solve, only: workspace_t, reserve_contact_field, solve_contact_normal, &
                                       solve_contact_tangential, estimate_contact_errors, &
                                       estimate_contact_forces
    use faststrip_command_clock, only: microseconds, cpu_microseconds
    use faststrip_command_methods, only: numerics_t, core_methods
    use faststrip_command_normal_stage, only: reserve_for_case
    use faststrip_command_norm_stage, only: norm_stage_t, reserve_norm_stage, release_norm_stage, &
                                            solve_by_norm, take_rows
    use faststrip_command_auto_stage, only: choose
    use faststrip_command_tang_stage, only: tang_stage_t, release_tang_stage, solve_by_tang, &
                                            estimate_by_tang
    implicit none
    private

    public :: solver_t, release_solver, outcome_t, make_solver, solve

    !> Methods with their workspaces, used for one contact after the other.
    type :: solver_t
        type(numerics_t) :: numerics        !! what was asked for
        type(numerics_t) :: chosen          !! what the last contact was solved by
        logical :: with_field = .false.     !! are the elements wanted?
        type(contact_case_t) :: case        !! the last one: its gap smoothed if that was asked
                                            !! for, its methods the core's part of `chosen`
        type(gap_curve_t) :: curve          !! its gap, for all methods
        type(workspace_t) :: workspace      !! with the strips of the last contact
        type(norm_stage_t) :: norm          !! if that is the normal method
        type(tang_stage_t) :: tang          !! if that is the tangential method
        type(tangential_field_t) :: field   !! of the last contact, if wanted
        logical :: with_strip_forces = .false. !! are the sums of each strip wanted?
        type(strip_forces_t) :: strip_forces   !! of the last contact, if wanted
    end type solver_t

    !> Figures of one contact.
    type :: outcome_t
        type(normal_result_t) :: normal         !! penetration, area, ...
        type(tangential_result_t) :: tangential !! forces, friction power, ...
        character(len=:), allocatable :: choice !! methods chosen and why, of auto; else empty
        logical :: has_forces = .true.          !! do forces and friction power count?
        logical :: knows_stick = .true.         !! does the stick fraction count?
        logical :: is_certified = .false.       !! do the certificate's residuals count?
        logical :: is_estimated = .false.       !! and its errors?
        type(certificate_t) :: certificate      !! how wrong the normal solution is
        logical :: forces_are_estimated = .false. !! do the forces' errors count?
        type(force_errors_t) :: force_errors    !! how wrong the forces are
        real(wp) :: gap_change_um = 0.0_wp      !! rms change of the gap by smoothing, um
        real(wp) :: normal_us = 0.0_wp          !! wall-clock time of the normal problem, us
        real(wp) :: tangential_us = 0.0_wp      !! of the tangential problem, us
        real(wp) :: normal_cpu_us = 0.0_wp      !! the same of the processor, us
        real(wp) :: tangential_cpu_us = 0.0_wp
    end type outcome_t

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
        if (with_field .and. numerics%normal /= normal_auto) &
            call reserve_contact_field(solver%field, core_methods(numerics), status)
        solver%with_strip_forces = .false.
        if (present(with_strip_forces)) solver%with_strip_forces = with_strip_forces
    end subroutine make_solver

    !> Give back what the compiler does not, of solvers in an array.
    subroutine release_solver(solver)
        type(solver_t), intent(inout) :: solver !! serves again

        call release_norm_stage(solver%norm)
        call release_tang_stage(solver%tang)
    end subroutine release_solver

    !> Solve one contact.
    subroutine solve(solver, case, outcome, status)
        type(solver_t), intent(inout) :: solver     !! made beforehand
        class(contact_case_t), intent(in) :: case   !! what to solve; its methods do not count
        type(outcome_t), intent(out) :: outcome     !! figures
        type(status_t), intent(out) :: status       !! an error, or a named limitation

        type(status_t) :: choice_status

        outcome%choice = ''
        call take_contact(solver, case, outcome, status)
        if (is_error(status)) return
        call take_methods(solver, outcome, choice_status)
        status = choice_status
        if (is_error(status)) return
        call solve_pressures(solver, outcome, status)
        if (is_error(status)) return
        call solve_forces(solver, outcome, status)
        if (status%code == st_ok) status = choice_status
        if (.not. is_error(status)) call estimate(solver, outcome, status)
    end subroutine solve

    !> How wrong the figures are: outside the time that is measured.
    subroutine estimate(solver, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(inout) :: status

        if (solver%chosen%normal == normal_strip .or. solver%chosen%normal == normal_hertz) then
            call estimate_contact_errors(solver%workspace, solver%case, outcome%normal, &
                                         outcome%certificate, outcome%is_certified, status)
            outcome%is_estimated = outcome%is_certified
        end if
        if (.not. outcome%is_estimated) return
        if (solver%chosen%tangential == tangential_tang) then
            call estimate_by_tang(solver%tang, solver%chosen, solver%case, solver%workspace, &
                                  solver%norm, outcome%certificate, outcome%tangential, &
                                  outcome%force_errors, outcome%forces_are_estimated, status)
        else
            call estimate_contact_forces(solver%workspace, solver%case, outcome%certificate, &
                                         outcome%force_errors, outcome%forces_are_estimated, &
                                         status)
        end if
    end subroutine estimate

    !> The normal problem, and the strips that the forces are for.
    subroutine solve_pressures(solver, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        integer(int64) :: before, after
        real(wp) :: cpu ! us

        call reserve_for_case(solver%workspace, solver%case, status)
        if (is_error(status)) return
        if (solver%chosen%normal == normal_norm) &
            call reserve_norm_stage(solver%norm, size(solver%case%gap%y), status)
        if (is_error(status)) return
        cpu = cpu_microseconds()
        call system_clock(before)
        if (solver%chosen%normal == normal_norm) then
            call solve_by_norm(solver%norm, solver%chosen, solver%case, solver%curve, &
                               outcome%normal, outcome%certificate, status)
            outcome%is_certified = .true.
            outcome%is_estimated = solver%norm%workspace%is_estimated
            if (outcome%is_estimated) &
                call name_resolution(outcome%certificate%est_err_penetration, &
                                     outcome%certificate%est_err_pmax, &
                                     outcome%certificate%est_err_area, &
                                     solver%case%resolution_limit, status)
        else
            call solve_contact_normal(solver%workspace, solver%case, outcome%normal, status, &
                                      curve=solver%curve)
        end if
        if (is_error(status)) return
        call system_clock(after)
        outcome%normal_us = outcome%normal_us + microseconds(before, after)
        outcome%normal_cpu_us = outcome%normal_cpu_us + cpu_microseconds() - cpu
        if (solver%chosen%normal /= normal_norm) return
        call take_rows(solver%norm, solver%workspace, status)
        if (is_error(status)) return
        if (solver%with_field) call grow_field(solver, status)
    end subroutine solve_pressures

    !> The tangential problem; an error of it becomes that of the contact.
    subroutine solve_forces(solver, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(inout) :: status

        type(status_t) :: tangential_status
        integer(int64) :: before, after
        real(wp) :: cpu ! us

        cpu = cpu_microseconds()
        call system_clock(before)
        if (solver%chosen%tangential == tangential_tang) then
            call solve_by_tang(solver%tang, solver%chosen, solver%case, solver%workspace, &
                               solver%norm, solver%with_field, outcome%tangential, solver%field, &
                               tangential_status)
        else if (solver%with_field) then
            call solve_contact_tangential(solver%workspace, solver%case, outcome%tangential, &
                                          tangential_status, solver%field)
        else
            call solve_contact_tangential(solver%workspace, solver%case, outcome%tangential, &
                                          tangential_status)
        end if
        call system_clock(after)
        outcome%tangential_us = microseconds(before, after)
        outcome%tangential_cpu_us = cpu_microseconds() - cpu
        solver%strip_forces%n = 0
        if (solver%with_strip_forces .and. solver%chosen%tangential == tangential_faststrip &
            .and. .not. is_error(tangential_status)) then
            ! Once more, so that the time is that of the forces.
            call reserve_strip_forces(solver%strip_forces, size(solver%workspace%strips%p0), &
                                      tangential_status)
            if (.not. is_error(tangential_status)) &
                call solve_contact_tangential(solver%workspace, solver%case, &
                                              outcome%tangential, tangential_status, &
                                              per_strip=solver%strip_forces)
        end if
        outcome%has_forces = solver%chosen%tangential /= tangential_none
        outcome%knows_stick = gives_stick(solver%chosen%tangential) .and. outcome%has_forces
        if (is_error(tangential_status)) status = tangential_status
    end subroutine solve_forces

    !> Check the contact, smooth its gap if that is asked for, and make it a curve once for all
    !> methods, which counts as normal time.
    subroutine take_contact(solver, case, outcome, status)
        type(solver_t), intent(inout) :: solver
        class(contact_case_t), intent(in) :: case
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        type(gap_t) :: smooth
        type(environment_t) :: environment
        integer(int64) :: before, after
        real(wp) :: change, cpu ! mm, us

        call check_material(case%material, status)
        if (is_error(status)) return
        solver%case = case
        if (solver%numerics%smoothing_um > 0.0_wp) then
            call smooth_gap(case%gap, 1.0e-3_wp*solver%numerics%smoothing_um, smooth, change, &
                            status)
            if (is_error(status)) return
            solver%case%gap = smooth
            outcome%gap_change_um = 1.0e3_wp*change
        end if
        call check_gap(solver%case%gap, status)
        if (is_error(status)) return
        call reserve_gap_curve(solver%curve, size(solver%case%gap%y), status)
        if (is_error(status)) return
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

    !> The methods asked for, or those chosen for this contact; choosing counts as normal time.
    subroutine take_methods(solver, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        integer(int64) :: before, after
        real(wp) :: cpu ! us

        call clear_status(status)
        solver%chosen = solver%numerics
        if (solver%numerics%normal == normal_auto) then
            cpu = cpu_microseconds()
            call system_clock(before)
            call choose(solver%numerics, solver%case, solver%curve, solver%with_field, &
                        solver%chosen, outcome%choice, status)
            call system_clock(after)
            if (is_error(status)) return
            outcome%normal_us = outcome%normal_us + microseconds(before, after)
            outcome%normal_cpu_us = outcome%normal_cpu_us + cpu_microseconds() - cpu
            if (solver%with_field) then
                call reserve_contact_field(solver%field, core_methods(solver%chosen), status)
            end if
        end if
        solver%case%methods = core_methods(solver%chosen)
        ! `solve` does.
        solver%case%estimate = .not. any(solver%case%methods%normal == [normal_strip, normal_hertz])
    end subroutine take_methods

    !> Room for the elements of as many strips as there are rows.
    subroutine grow_field(solver, status)
        type(solver_t), intent(inout) :: solver
        type(status_t), intent(inout) :: status

        type(status_t) :: reserved

        call reserve_field(solver%field, max(solver%workspace%strips%n &
                                             *solver%chosen%points_per_strip, &
                                             size(solver%field%x)), reserved)
        if (is_error(reserved)) status = reserved
    end subroutine grow_field
end module faststrip_command_solver
