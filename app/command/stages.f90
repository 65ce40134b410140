!> The stages of one contact, each with the time it took: the normal problem, then the tangential
!> one.
module faststrip_command_stages
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_limitations, only: name_resolution
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          strip_forces_t, reserve_strip_forces
    use faststrip_kalker_tangential, only: are_alike
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: contact_methods_t, normal_strip, normal_hertz, &
                                         normal_norm, &
                                         tangential_none, tangential_faststrip, &
                                         tangential_faststrip_plain, tangential_tang, gives_stick
    use faststrip_contact_solve, only: workspace_t, solve_contact_normal, &
                                       solve_contact_tangential, estimate_contact_errors, &
                                       estimate_contact_forces
    use faststrip_command_clock, only: microseconds, cpu_microseconds
    use faststrip_command_methods, only: numerics_t
    use faststrip_command_normal_stage, only: reserve_for_points
    use faststrip_command_norm_stage, only: norm_stage_t, reserve_norm_stage, solve_by_norm, &
                                            take_rows
    use faststrip_command_wear_figures, only: wear_figures_t
    use faststrip_command_tang_stage, only: tang_stage_t, solve_by_tang, settle_by_tang, &
                                            estimate_by_tang
    implicit none
    private

    public :: solver_t, outcome_t, solve_pressures, solve_forces, estimate_figures
    public :: find_strip_forces, tell_forces, add_times, take_figures, make_room

    !> Methods with their workspaces, used for one contact after the other.
    type :: solver_t
        type(numerics_t) :: numerics        !! what was asked for
        type(numerics_t) :: chosen          !! what the last contact was solved by
        logical :: with_field = .false.     !! are the elements wanted?
        type(contact_case_t) :: case        !! the last one: its gap smoothed if that was asked
                                            !! for, its methods the core's part of `chosen`
        type(gap_curve_t) :: curve          !! its gap, for all methods
        integer(int64) :: gap_id = 0        !! number of that gap; 0: it has none
        type(workspace_t) :: workspace      !! with the strips of the last contact
        integer, private :: points = 0      ! of a gap that the workspace has room for
        type(contact_methods_t), private :: methods ! that it has room for
        logical :: tells_times = .true.     !! do the steps of auto tell their times?
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
        character(len=:), allocatable :: choice !! the steps of auto; else empty
        logical :: has_forces = .true.          !! do forces and friction power count?
        logical :: knows_stick = .true.         !! does the stick fraction count?
        logical :: is_certified = .false.       !! do the certificate's residuals count?
        logical :: is_estimated = .false.       !! and its errors?
        type(certificate_t) :: certificate      !! how wrong the normal solution is
        logical :: forces_are_estimated = .false. !! do the errors of the forces count?
        type(force_errors_t) :: force_errors    !! how wrong the forces are
        type(wear_figures_t) :: wear            !! T gamma, wear, fatigue, if there are forces
        real(wp) :: gap_change_um = 0.0_wp      !! rms change of the gap by smoothing, um
        real(wp) :: normal_us = 0.0_wp          !! wall-clock time of the normal problem, us; of
                                                !! auto with all that was tried, and estimates
        real(wp) :: tangential_us = 0.0_wp      !! of the tangential problem, us
        real(wp) :: normal_cpu_us = 0.0_wp      !! the same of the processor, us
        real(wp) :: tangential_cpu_us = 0.0_wp
    end type outcome_t

contains

    !> The normal problem, and the strips that the forces are for.
    subroutine solve_pressures(solver, outcome, status, strips)
        type(solver_t), intent(inout) :: solver     !! with a contact and its methods
        type(outcome_t), intent(inout) :: outcome   !! its figures and their time are filled in
        type(status_t), intent(out) :: status       !! of the method
        type(contact_strips_t), intent(in), optional :: strips !! for NORM to start from

        integer(int64) :: before, after
        real(wp) :: cpu ! us

        call make_room(solver, status)
        if (is_error(status)) return
        if (solver%chosen%normal == normal_norm) &
            call reserve_norm_stage(solver%norm, solver%curve%n, status)
        if (is_error(status)) return
        cpu = cpu_microseconds()
        call system_clock(before)
        if (solver%chosen%normal == normal_norm) then
            call solve_by_norm(solver%norm, solver%chosen, solver%case, solver%curve, &
                               outcome%normal, outcome%certificate, status, strips)
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

    !> Room in the workspace for the contact and its methods. Where there is enough the last
    !> solution stays, for the next one to start from.
    subroutine make_room(solver, status)
        type(solver_t), intent(inout) :: solver !! with a contact
        type(status_t), intent(out) :: status   !! those of `reserve_workspace`

        call clear_status(status)
        associate (methods => solver%case%methods)
            if (solver%curve%n <= solver%points .and. &
                methods%normal == solver%methods%normal .and. &
                methods%strips_per_patch == solver%methods%strips_per_patch) return
            solver%points = max(solver%points, solver%curve%n)
            call reserve_for_points(solver%workspace, solver%case, solver%points, status)
            solver%methods = methods
        end associate
        if (is_error(status)) solver%points = 0
    end subroutine make_room

    !> The tangential problem; an error of it becomes that of the contact.
    subroutine solve_forces(solver, outcome, status)
        type(solver_t), intent(inout) :: solver     !! with a normal solution
        type(outcome_t), intent(inout) :: outcome   !! its forces and their time are filled in
        type(status_t), intent(inout) :: status     !! limitations so far

        type(status_t) :: tangential_status
        integer(int64) :: before, after
        real(wp) :: cpu ! us

        cpu = cpu_microseconds()
        call system_clock(before)
        if (solver%chosen%tangential == tangential_tang .and. &
            solver%chosen%normal == normal_norm .and. .not. are_alike(solver%case%material)) then
            call settle_by_tang(solver%tang, solver%case, solver%norm, solver%with_field, &
                                outcome%normal, outcome%tangential, solver%field, &
                                tangential_status)
            if (.not. is_error(tangential_status)) &
                call take_rows(solver%norm, solver%workspace, tangential_status)
        else if (solver%chosen%tangential == tangential_tang) then
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
        outcome%tangential_us = outcome%tangential_us + microseconds(before, after)
        outcome%tangential_cpu_us = outcome%tangential_cpu_us + cpu_microseconds() - cpu
        if (is_error(tangential_status)) status = tangential_status
        call tell_forces(solver, outcome)
        call find_strip_forces(solver, status)
    end subroutine solve_forces

    !> How wrong the figures are.
    subroutine estimate_figures(solver, outcome, status)
        type(solver_t), intent(inout) :: solver   !! with a solution
        type(outcome_t), intent(inout) :: outcome !! its estimates are filled in
        type(status_t), intent(inout) :: status   !! limitations so far; `st_under_resolved`

        if (any(solver%chosen%normal == [normal_strip, normal_hertz])) then
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
    end subroutine estimate_figures

    !> The sums of each strip, if they are wanted and the method has them: once more, so that the
    !> time is that of the forces.
    subroutine find_strip_forces(solver, status)
        type(solver_t), intent(inout) :: solver !! with a solution
        type(status_t), intent(inout) :: status !! changed by an error

        type(tangential_result_t) :: again
        type(status_t) :: summed

        solver%strip_forces%n = 0
        if (is_error(status) .or. .not. solver%with_strip_forces) return
        if (all(solver%chosen%tangential /= [tangential_faststrip, tangential_faststrip_plain])) &
            return
        call reserve_strip_forces(solver%strip_forces, size(solver%workspace%strips%p0), summed)
        if (.not. is_error(summed)) &
            call solve_contact_tangential(solver%workspace, solver%case, again, summed, &
                                          per_strip=solver%strip_forces)
        if (is_error(summed)) status = summed
    end subroutine find_strip_forces

    !> Say which of the forces the method gives.
    subroutine tell_forces(solver, outcome)
        type(solver_t), intent(in) :: solver      !! with its methods
        type(outcome_t), intent(inout) :: outcome !! of them

        outcome%has_forces = solver%chosen%tangential /= tangential_none
        outcome%knows_stick = gives_stick(solver%chosen%tangential) .and. outcome%has_forces
    end subroutine tell_forces

    !> Add the times of one outcome to those of another.
    subroutine add_times(from, to)
        type(outcome_t), intent(in) :: from  !! what was done before
        type(outcome_t), intent(inout) :: to !! gets it on top

        to%normal_us = to%normal_us + from%normal_us
        to%tangential_us = to%tangential_us + from%tangential_us
        to%normal_cpu_us = to%normal_cpu_us + from%normal_cpu_us
        to%tangential_cpu_us = to%tangential_cpu_us + from%tangential_cpu_us
    end subroutine add_times

    !> Take the figures of another outcome and how wrong they are, without times and words.
    subroutine take_figures(from, to)
        type(outcome_t), intent(in) :: from  !! a better one
        type(outcome_t), intent(inout) :: to !! gets its figures

        to%normal = from%normal
        to%tangential = from%tangential
        to%has_forces = from%has_forces
        to%knows_stick = from%knows_stick
        to%is_certified = from%is_certified
        to%is_estimated = from%is_estimated
        to%certificate = from%certificate
        to%forces_are_estimated = from%forces_are_estimated
        to%force_errors = from%force_errors
    end subroutine take_figures

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
end module faststrip_command_stages
