!> One contact from gap to forces, by the methods asked for, with the time each stage took.
module faststrip_command_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_ok
    use faststrip_base_material, only: material_t, check_material
    use faststrip_base_creepage, only: creepage_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_limitations, only: name_resolution
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          strip_forces_t, reserve_strip_forces
    use faststrip_contact_methods, only: gives_stick
    use faststrip_contact_solve, only: reserve_contact_field
    use faststrip_command_clock, only: microseconds, cpu_microseconds
    use faststrip_command_methods, only: methods_t
    use faststrip_command_normal_stage, only: normal_stage_t, demand_t, make_normal_stage, &
                                              make_room, solve_normal, certify
    use faststrip_command_norm_stage, only: norm_stage_t, make_norm_room, release_norm_stage, &
                                            solve_by_norm, take_rows
    use faststrip_command_auto_stage, only: choose
    use faststrip_command_tang_stage, only: tang_stage_t, release_tang_stage, solve_by_tang
    use faststrip_command_tangential_stage, only: solve_tangential
    implicit none
    private

    public :: solver_t, release_solver, demand_t, outcome_t, make_solver, solve

    !> Methods with the room they need, used for one contact after the other.
    type :: solver_t
        type(methods_t) :: methods          !! what was asked for
        type(methods_t) :: chosen           !! what the last contact was solved by
        logical :: with_field = .false.     !! are the elements wanted?
        type(normal_stage_t) :: normal      !! with the strips of the last contact
        type(norm_stage_t) :: norm          !! if that is the normal method
        type(tang_stage_t) :: tang          !! if that is the tangential method
        type(tangential_field_t) :: field   !! of the last contact, if wanted
        logical :: with_strip_forces = .false. !! are the sums of each strip wanted?
        type(strip_forces_t) :: strip_forces   !! of the last contact, if wanted
        type(gap_t) :: gap                  !! of the last contact, smoothed if that was asked for
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
        real(wp) :: gap_change_um = 0.0_wp      !! rms change of the gap by smoothing, um
        real(wp) :: normal_us = 0.0_wp          !! wall-clock time of the normal problem, us
        real(wp) :: tangential_us = 0.0_wp      !! of the tangential problem, us
        real(wp) :: normal_cpu_us = 0.0_wp      !! the same of the processor, us
        real(wp) :: tangential_cpu_us = 0.0_wp
    end type outcome_t

contains

    !> Make room for a choice of methods.
    subroutine make_solver(methods, with_field, solver, status, with_strip_forces)
        type(methods_t), intent(in) :: methods  !! checked
        logical, intent(in) :: with_field       !! are the elements wanted?
        type(solver_t), intent(out) :: solver   !! ready
        type(status_t), intent(out) :: status   !! from the library
        logical, intent(in), optional :: with_strip_forces !! are the sums of each strip wanted?

        solver%methods = methods
        solver%with_field = with_field
        call clear_status(status)
        if (methods%normal /= 'auto') call make_normal_stage(methods, solver%normal)
        if (with_field .and. methods%normal /= 'auto') &
            call reserve_contact_field(solver%field, solver%normal%methods, status)
        if (present(with_strip_forces)) solver%with_strip_forces = with_strip_forces
    end subroutine make_solver

    !> Give back what the compiler does not, of solvers in an array.
    subroutine release_solver(solver)
        type(solver_t), intent(inout) :: solver !! serves again

        call release_norm_stage(solver%norm)
        call release_tang_stage(solver%tang)
    end subroutine release_solver

    !> Solve one contact.
    subroutine solve(solver, gap, material, mu, demand, creepage, outcome, status)
        type(solver_t), intent(inout) :: solver    !! made beforehand
        type(gap_t), intent(in) :: gap             !! undeformed gap, mm
        type(material_t), intent(in) :: material   !! moduli, MPa
        real(wp), intent(in) :: mu                 !! coefficient of friction
        type(demand_t), intent(in) :: demand       !! load or penetration
        type(creepage_t), intent(in) :: creepage   !! about y = 0
        type(outcome_t), intent(out) :: outcome    !! figures
        type(status_t), intent(out) :: status      !! an error, or a named limitation

        type(status_t) :: tangential_status, choice_status
        real(wp) :: change
        integer(int64) :: before, between, after
        real(wp) :: cpu ! us

        outcome%choice = ''
        call check_material(material, status)
        if (is_error(status)) return
        if (solver%methods%smoothing_um > 0.0_wp) then
            call smooth_gap(gap, 1.0e-3_wp*solver%methods%smoothing_um, solver%gap, change, status)
            if (is_error(status)) return
            outcome%gap_change_um = 1.0e3_wp*change
        else
            solver%gap = gap
        end if
        call take_methods(solver, material, mu, demand, creepage, outcome, choice_status)
        status = choice_status
        if (is_error(status)) return
        call make_room(solver%normal, solver%gap, status)
        if (is_error(status)) return
        if (solver%chosen%normal == 'norm') call make_norm_room(solver%norm, solver%gap, status)
        if (is_error(status)) return
        cpu = cpu_microseconds()
        call system_clock(before)
        if (solver%chosen%normal == 'norm') then
            call solve_by_norm(solver%norm, solver%chosen, solver%gap, material, demand, &
                               outcome%normal, outcome%certificate, status)
            outcome%is_certified = .true.
            outcome%is_estimated = solver%norm%workspace%is_estimated
            if (outcome%is_estimated) &
                call name_resolution(outcome%certificate%est_err_penetration, &
                                     outcome%certificate%est_err_pmax, &
                                     outcome%certificate%est_err_area, &
                                     solver%methods%resolution_limit, status)
        else
            call solve_normal(solver%normal, solver%gap, material, demand, outcome%normal, status)
        end if
        if (is_error(status)) return
        call system_clock(between)
        outcome%normal_us = outcome%normal_us + microseconds(before, between)
        outcome%normal_cpu_us = outcome%normal_cpu_us + cpu_microseconds() - cpu
        cpu = cpu_microseconds()
        if (solver%chosen%normal == 'norm') then
            call take_rows(solver%norm, solver%normal, status)
            if (is_error(status)) return
            if (solver%with_field) call grow_field(solver, status)
            if (is_error(status)) return
            call system_clock(between)
            cpu = cpu_microseconds()
        end if
        if (solver%chosen%tangential == 'tang') then
            call solve_by_tang(solver%tang, solver%chosen, solver%normal, solver%norm, &
                               material, mu, creepage, solver%with_field, outcome%tangential, &
                               solver%field, tangential_status)
        else if (solver%with_field) then
            call solve_tangential(solver%normal, material, mu, creepage, outcome%tangential, &
                                  tangential_status, solver%field)
        else
            call solve_tangential(solver%normal, material, mu, creepage, outcome%tangential, &
                                  tangential_status)
        end if
        call system_clock(after)
        outcome%tangential_cpu_us = cpu_microseconds() - cpu
        solver%strip_forces%n = 0
        if (solver%with_strip_forces .and. solver%chosen%tangential == 'faststrip' &
            .and. .not. is_error(tangential_status)) then
            ! Once more, so that the time is that of the forces.
            call reserve_strip_forces(solver%strip_forces, &
                                      size(solver%normal%workspace%strips%p0), &
                                      tangential_status)
            if (.not. is_error(tangential_status)) &
                call solve_tangential(solver%normal, material, mu, creepage, outcome%tangential, &
                                      tangential_status, per_strip=solver%strip_forces)
        end if
        outcome%has_forces = solver%chosen%tangential /= 'none'
        outcome%knows_stick = gives_stick(solver%normal%methods%tangential) .and. outcome%has_forces
        outcome%tangential_us = microseconds(between, after)
        if (is_error(tangential_status)) status = tangential_status
        if (status%code == st_ok) status = choice_status
        if (is_error(status) .or. solver%chosen%normal == 'norm') return
        call certify(solver%normal, material, outcome%normal, outcome%certificate, &
                     outcome%is_certified, status)
        outcome%is_estimated = outcome%is_certified
    end subroutine solve

    !> The methods asked for, or those chosen for this contact; choosing counts as normal time.
    subroutine take_methods(solver, material, mu, demand, creepage, outcome, status)
        type(solver_t), intent(inout) :: solver
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(demand_t), intent(in) :: demand
        type(creepage_t), intent(in) :: creepage
        type(outcome_t), intent(inout) :: outcome
        type(status_t), intent(out) :: status

        integer(int64) :: before, after
        real(wp) :: cpu ! us

        call clear_status(status)
        solver%chosen = solver%methods
        if (solver%methods%normal /= 'auto') return
        cpu = cpu_microseconds()
        call system_clock(before)
        call choose(solver%methods, solver%gap, material, mu, demand, creepage, &
                    solver%with_field, solver%chosen, outcome%choice, status)
        call system_clock(after)
        if (is_error(status)) return
        outcome%normal_us = microseconds(before, after)
        outcome%normal_cpu_us = cpu_microseconds() - cpu
        call make_normal_stage(solver%chosen, solver%normal)
        if (solver%with_field) &
            call reserve_contact_field(solver%field, solver%normal%methods, status)
    end subroutine take_methods

    !> Room for the elements of as many strips as there are rows.
    subroutine grow_field(solver, status)
        type(solver_t), intent(inout) :: solver
        type(status_t), intent(inout) :: status

        type(status_t) :: room

        call reserve_field(solver%field, max(solver%normal%workspace%strips%n &
                                             *solver%chosen%points_per_strip, &
                                             size(solver%field%x)), room)
        if (is_error(room)) status = room
    end subroutine grow_field
end module faststrip_command_solver
