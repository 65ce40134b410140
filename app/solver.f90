!> One contact from gap to forces, by the methods asked for, with the time each stage took.
module faststrip_app_solver
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, is_error
    use faststrip_material, only: material_t, check_material, normal_compliance
    use faststrip_creepage, only: creepage_t
    use faststrip_profile_gap, only: gap_t, check_gap
    use faststrip_profile_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_certificate, only: certificate_t, certify_strips
    use faststrip_normal_equal_ellipse, only: replace_by_ellipses, equal_area, equal_moments
    use faststrip_normal_hertz, only: hertz_t, hertz_solve_gap, hertz_solve_gap_penetration, &
                                      hertz_strips
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, normal_result_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve, &
                                      strip_solve_penetration, strips_auto
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field
    use faststrip_tangential_fastsim, only: fastsim_solve, fastsim_strips_solve
    use faststrip_tangential_faststrip, only: faststrip_solve
    use faststrip_app_clock, only: microseconds
    use faststrip_app_methods, only: methods_t
    implicit none
    private

    public :: solver_t, demand_t, outcome_t, make_solver, solve

    ! Strips of a Hertz ellipse where the number is left to the solver, and the most it takes.
    integer, parameter :: auto_hertz_strips = 15, auto_most_strips = 41

    !> Methods with the room they need, used for one contact after the other.
    type :: solver_t
        type(methods_t) :: methods          !! what was asked for
        logical :: with_field = .false.     !! are the elements wanted?
        type(contact_strips_t) :: strips    !! of the last contact
        type(tangential_field_t) :: field   !! of the last contact, if wanted
        type(strip_workspace_t), private :: workspace
        type(gap_curve_t), private :: curve
    end type solver_t

    !> What presses the bodies together.
    type :: demand_t
        logical :: by_load = .true.      !! is the load given, or the penetration?
        real(wp) :: load = 0.0_wp        !! normal force, N
        real(wp) :: penetration = 0.0_wp !! approach from h = 0, mm
    end type demand_t

    !> Figures of one contact.
    type :: outcome_t
        type(normal_result_t) :: normal         !! penetration, area, ...
        type(tangential_result_t) :: tangential !! forces, friction power, ...
        logical :: is_certified = .false.       !! does the certificate count? only for strips
        type(certificate_t) :: certificate      !! how wrong the normal solution is
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
        if (methods%strips_per_patch == strips_auto) room = 2*auto_most_strips + 60
        call reserve_strips(solver%strips, room, status)
        if (is_error(status) .or. .not. with_field) return
        call reserve_field(solver%field, max(room*methods%points_per_strip, &
                                             methods%fastsim_nx*methods%fastsim_ny*16), status)
    end subroutine make_solver

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

        type(hertz_t) :: hertz
        type(status_t) :: tangential_status, certificate_status
        integer(int64) :: before, between, after

        call check_material(material, status)
        if (is_error(status)) return
        call make_room(solver, gap, status)
        if (is_error(status)) return
        call system_clock(before)
        if (solver%methods%normal == 'hertz') then
            call solve_hertz(solver, gap, material, demand, hertz, outcome%normal, status)
        else
            call solve_by_strips(solver, gap, material, demand, outcome%normal, status)
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
        if (solver%methods%normal /= 'strip' .or. is_error(status)) return
        call certify_strips(solver%workspace%curve, normal_compliance(material), solver%strips, &
                            outcome%normal, outcome%certificate, certificate_status)
        outcome%is_certified = .not. is_error(certificate_status)
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

    subroutine solve_by_strips(solver, gap, material, demand, normal, status)
        type(solver_t), intent(inout) :: solver
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        type(demand_t), intent(in) :: demand
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        type(strip_options_t) :: options
        type(status_t) :: ellipses

        call set_strip_gap(solver%workspace, gap, status)
        if (is_error(status)) return
        options%strips_per_patch = solver%methods%strips_per_patch
        if (demand%by_load) then
            call strip_solve(solver%workspace, normal_compliance(material), demand%load, options, &
                             solver%strips, normal, status)
        else
            call strip_solve_penetration(solver%workspace, normal_compliance(material), &
                                         demand%penetration, options, solver%strips, normal, &
                                         status)
        end if
        if (is_error(status) .or. solver%methods%normal == 'strip') return
        call replace_by_ellipses( &
            merge(equal_area, equal_moments, solver%methods%normal == 'equal_area'), &
            solver%workspace%curve, solver%strips, normal, ellipses)
        if (is_error(ellipses)) status = ellipses
    end subroutine solve_by_strips

    subroutine solve_hertz(solver, gap, material, demand, hertz, normal, status)
        type(solver_t), intent(inout) :: solver
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        type(demand_t), intent(in) :: demand
        type(hertz_t), intent(out) :: hertz
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        integer :: n

        call set_gap_curve(solver%curve, gap, status)
        if (is_error(status)) return
        if (demand%by_load) then
            call hertz_solve_gap(solver%curve, normal_compliance(material), demand%load, hertz, &
                                 status)
        else
            call hertz_solve_gap_penetration(solver%curve, normal_compliance(material), &
                                             demand%penetration, hertz, status)
        end if
        if (is_error(status)) return
        normal%load = hertz%load
        normal%penetration = hertz%penetration + solver%curve%h_lowest
        normal%area = hertz%area
        normal%pmax = hertz%pmax
        normal%y_min = hertz%y - hertz%b
        normal%y_max = hertz%y + hertz%b
        normal%x_max = hertz%a
        normal%n_patches = 1
        n = solver%methods%strips_per_patch
        if (n == strips_auto) n = auto_hertz_strips
        call hertz_strips(hertz, n, solver%strips, status)
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
