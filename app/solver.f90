!> One contact from gap to forces, by the methods asked for, with the time each stage took.
module faststrip_app_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, is_error
    use faststrip_material, only: material_t, check_material, normal_compliance
    use faststrip_creepage, only: creepage_t
    use faststrip_profile_gap, only: gap_t, check_gap
    use faststrip_profile_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_hertz, only: hertz_t, hertz_solve_gap, hertz_strips
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, normal_result_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field
    use faststrip_tangential_fastsim, only: fastsim_solve, fastsim_strips_solve
    use faststrip_tangential_faststrip, only: faststrip_solve
    use faststrip_app_clock, only: microseconds
    use faststrip_app_methods, only: methods_t
    implicit none
    private

    public :: solver_t, outcome_t, make_solver, solve

    !> Methods with the room they need, used for one contact after the other.
    type :: solver_t
        type(methods_t) :: methods          !! what was asked for
        logical :: with_field = .false.     !! are the elements wanted?
        type(contact_strips_t) :: strips    !! of the last contact
        type(tangential_field_t) :: field   !! of the last contact, if wanted
        type(strip_workspace_t), private :: workspace
        type(gap_curve_t), private :: curve
    end type solver_t

    !> Figures of one contact.
    type :: outcome_t
        type(normal_result_t) :: normal         !! penetration, area, ...
        type(tangential_result_t) :: tangential !! forces, friction power, ...
        real(wp) :: normal_us = 0.0_wp          !! wall-clock time of the normal problem, us
        real(wp) :: tangential_us = 0.0_wp      !! of the tangential problem, us
    end type outcome_t

contains

    !> Make room for a choice of methods.
    subroutine make_solver(methods, with_field, solver, status)
        type(methods_t), intent(in) :: methods  !! checked
        logical, intent(in) :: with_field       !! are the elements wanted?
        type(solver_t), intent(out) :: solver   !! ready
        type(status_t), intent(out) :: status   !! from the library

        integer :: room

        solver%methods = methods
        solver%with_field = with_field
        room = 2*methods%strips_per_patch + 60
        call reserve_strips(solver%strips, room, status)
        if (is_error(status) .or. .not. with_field) return
        call reserve_field(solver%field, max(room*methods%points_per_strip, &
                                             methods%fastsim_nx*methods%fastsim_ny*16), status)
    end subroutine make_solver

    !> Solve one contact.
    subroutine solve(solver, gap, material, mu, load, creepage, outcome, status)
        type(solver_t), intent(inout) :: solver    !! made beforehand
        type(gap_t), intent(in) :: gap             !! undeformed gap, mm
        type(material_t), intent(in) :: material   !! moduli, MPa
        real(wp), intent(in) :: mu                 !! coefficient of friction
        real(wp), intent(in) :: load               !! normal force, N
        type(creepage_t), intent(in) :: creepage   !! about y = 0
        type(outcome_t), intent(out) :: outcome    !! figures
        type(status_t), intent(out) :: status      !! an error, or a named limitation

        type(hertz_t) :: hertz
        type(status_t) :: tangential_status
        integer(int64) :: before, between, after

        call check_material(material, status)
        if (is_error(status)) return
        call make_room(solver, gap, status)
        if (is_error(status)) return
        call system_clock(before)
        if (solver%methods%normal == 'hertz') then
            call solve_hertz(solver, gap, material, load, hertz, outcome%normal, status)
        else
            call set_strip_gap(solver%workspace, gap, status)
            if (is_error(status)) return
            call strip_solve(solver%workspace, normal_compliance(material), load, &
                             strip_options_t(strips_per_patch=solver%methods%strips_per_patch), &
                             solver%strips, outcome%normal, status)
        end if
        if (is_error(status)) return
        call system_clock(between)
        if (solver%with_field) then
            call solve_tangential(solver, hertz, material, mu, creepage, outcome%tangential, &
                                  tangential_status, solver%field)
        else
            call solve_tangential(solver, hertz, material, mu, creepage, outcome%tangential, &
                                  tangential_status)
        end if
        call system_clock(after)
        outcome%normal_us = microseconds(before, between)
        outcome%tangential_us = microseconds(between, after)
        if (is_error(tangential_status)) status = tangential_status
    end subroutine solve

    !> Grow the workspaces to what a gap and the methods need, outside the time that is measured.
    subroutine make_room(solver, gap, status)
        type(solver_t), intent(inout) :: solver
        type(gap_t), intent(in) :: gap
        type(status_t), intent(out) :: status

        call check_gap(gap, status)
        if (is_error(status)) return
        if (solver%methods%normal == 'hertz') then
            call reserve_gap_curve(solver%curve, size(gap%y), status)
        else
            call reserve_strip_workspace(solver%workspace, size(solver%strips%p0), size(gap%y), &
                                         status)
        end if
    end subroutine make_room

    subroutine solve_hertz(solver, gap, material, load, hertz, normal, status)
        type(solver_t), intent(inout) :: solver
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: load
        type(hertz_t), intent(out) :: hertz
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        call set_gap_curve(solver%curve, gap, status)
        if (is_error(status)) return
        call hertz_solve_gap(solver%curve, normal_compliance(material), load, hertz, status)
        if (is_error(status)) return
        normal%penetration = hertz%penetration + solver%curve%h_lowest
        normal%area = hertz%area
        normal%pmax = hertz%pmax
        normal%y_min = hertz%y - hertz%b
        normal%y_max = hertz%y + hertz%b
        normal%x_max = hertz%a
        normal%n_patches = 1
        call hertz_strips(hertz, solver%methods%strips_per_patch, solver%strips, status)
    end subroutine solve_hertz

    subroutine solve_tangential(solver, hertz, material, mu, creepage, tangential, status, field)
        type(solver_t), intent(in) :: solver
        type(hertz_t), intent(in) :: hertz
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field

        associate (methods => solver%methods)
            if (methods%tangential == 'faststrip') then
                call faststrip_solve(solver%strips, material, mu, creepage, &
                                     methods%points_per_strip, tangential, status, field)
            else if (methods%normal == 'hertz') then
                call fastsim_solve(hertz, material, mu, creepage, methods%fastsim_nx, &
                                   methods%fastsim_ny, tangential, status, field)
            else
                call fastsim_strips_solve(solver%strips, material, mu, creepage, &
                                          methods%fastsim_nx, methods%fastsim_ny, tangential, &
                                          status, field)
            end if
        end associate
    end subroutine solve_tangential
end module faststrip_app_solver
