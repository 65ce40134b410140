!> One contact from gap to forces: the call an embedding program makes, and the only place where
!> pressures, their errors, forces and their errors are put together.
!>
!> A workspace, one per thread, is reserved once; after that nothing is allocated, and every
!> call leaves the host's floating-point flags, traps and rounding as they were. The workspace
!> remembers the gap and, for warm starts, the last solution; copying it (by assignment) saves both,
!> for steps that are taken back. Memory of methods outside the core is not copied, but shared.
module faststrip_contact_solve
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, add_limitation, number_text, &
                                     st_beyond_yield, st_target_missed
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_gap_curve, only: gap_curve_t, set_gap_curve_points, copy_gap_curve
    use faststrip_contact_auto, only: solve_auto
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_clock, only: lap_t, start_lap, add_lap
    use faststrip_contact_method, only: contact_result_t, workspace_t, normal_method_t, &
                                        tangential_method_t
    use faststrip_contact_method_capacity, only: ellipse_strips
    use faststrip_contact_method_heat, only: find_heat
    use faststrip_contact_method_loads, only: find_stress_peak
    use faststrip_contact_method_surface, only: check_surface, conformal_turn, &
                                                add_pressure_errors, shift_pressure_errors, &
                                                add_turn_errors
    use faststrip_contact_methods, only: contact_methods_t, normal_hertz, tangential_none
    use faststrip_contact_parts, only: check_methods, check_contact, set_case_gap, &
                                       find_normal_method, find_tangential_method, &
                                       find_pressures, add_forces
    use faststrip_contact_wanted, only: clear_steps
    use faststrip_contact_wear, only: find_wear
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_strips
    use faststrip_normal_strips, only: usual_strip_tolerance
    implicit none
    private

    public :: set_contact_gap, set_contact_curve, set_contact_ellipse
    public :: solve_contact, solve_contact_forces, estimate_contact, name_yield

    ! Tuned [solutions]: of pressures whose turned force is the load. Origin: safeguard: three or
    ! four are taken.
    integer, parameter :: most_loads = 12

contains

    !> Hand over the gap that the next solutions are for.
    subroutine set_contact_gap(workspace, y, h, inv2r, status, inclination, slope)
        type(workspace_t), intent(inout) :: workspace !! with capacity for as many points
        real(wp), intent(in) :: y(:)          !! lateral coordinate, strictly increasing, mm
        real(wp), intent(in) :: h(:)          !! gap on the line x = 0, mm
        real(wp), intent(in) :: inv2r(:)      !! 1/(2 R), R the local radius along x, 1/mm
        type(status_t), intent(out) :: status !! those of `check_gap`, `st_workspace_too_small`
        real(wp), intent(in), optional :: inclination(:)
            !! how far the surfaces have turned from the tangent plane at y = 0, finite, rad
        real(wp), intent(in), optional :: slope(:) !! dh/dy, where it is known

        type(environment_t) :: environment

        call hold_environment(environment)
        workspace%solved_by = 0
        call clear_steps(workspace%steps)
        call set_gap_curve_points(workspace%solver%curve, y, h, inv2r, status, inclination, slope)
        call restore_environment(environment)
    end subroutine set_contact_gap

    !> The same by a gap that is a curve already: only copied.
    subroutine set_contact_curve(workspace, curve, status)
        type(workspace_t), intent(inout) :: workspace !! with capacity for as many points
        type(gap_curve_t), intent(in) :: curve        !! of `set_gap_curve`
        type(status_t), intent(out) :: status         !! those of `copy_gap_curve`

        workspace%solved_by = 0
        call copy_gap_curve(curve, workspace%solver%curve, status)
    end subroutine set_contact_curve

    !> Hand over a Hertz ellipse and its load in place of a gap: `solve_contact_forces` finds the
    !> forces on it, of which nothing but their method is wrong.
    subroutine set_contact_ellipse(workspace, methods, hertz, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with capacity for the methods
        type(contact_methods_t), intent(in) :: methods  !! strips of the ellipse
        type(hertz_t), intent(in) :: hertz              !! semi-axes, mm, and load, N
        type(contact_result_t), intent(out) :: result   !! figures of its pressures
        type(status_t), intent(out) :: status           !! those of `hertz_strips`

        workspace%solved_by = 0
        workspace%field%n = 0
        workspace%strip_forces%n = 0
        workspace%solver%curve%n = 0
        workspace%solver%curve%inclination_is_known = .false.
        call clear_steps(workspace%steps)
        call hertz_strips(hertz, ellipse_strips(methods), workspace%strips, status)
        if (is_error(status)) return
        workspace%hertz = hertz
        workspace%is_ellipse = .true.
        workspace%solved_by = normal_hertz
        workspace%methods = methods
        workspace%methods%normal = normal_hertz
        result%is_estimated = .true.
        associate (normal => result%normal)
            normal%load = hertz%load
            normal%penetration = hertz%penetration
            normal%area = hertz%area
            normal%pmax = hertz%pmax
            normal%y_min = hertz%y - hertz%b
            normal%y_max = hertz%y + hertz%b
            normal%x_max = hertz%a
            normal%n_patches = 1
        end associate
    end subroutine set_contact_ellipse

    !> Solve a contact: the normal problem and, unless the method is `tangential_none`, the
    !> tangential one; by `normal_auto` as well as is wanted.
    !>
    !> A status below `first_error` is that of the normal solution: the result stands, with a named
    !> limitation. With an error there is no result.
    subroutine solve_contact(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace !! with capacity for the methods
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(contact_result_t), intent(out) :: result !! figures
        type(status_t), intent(out) :: status
            !! those of `strip_solve`, `hertz_solve_gap`, `replace_by_ellipses`,
            !! `faststrip_tangential_solve`, `fastsim_solve`, `check_material`, `check_gap`,
            !! `solve_auto`, `smooth_gap`, `find_heat`, `take_loads`, `check_surface`;
            !! `st_beyond_yield`; `st_target_missed`: the load, on a curved surface

        class(normal_method_t), pointer :: normal
        class(tangential_method_t), pointer :: tangential
        type(environment_t) :: environment
        type(lap_t) :: lap
        real(wp) :: turn

        call hold_environment(environment)
        workspace%solved_by = 0
        workspace%load_factor = 1.0_wp
        workspace%field%n = 0
        workspace%strip_forces%n = 0
        call clear_steps(workspace%steps)
        call check_contact(workspace, case, normal, tangential, status)
        if (.not. is_error(status)) then
            call start_lap(case%asked%times, lap)
            call set_case_gap(workspace, case, result%gap_change, status)
            if (case%curved .and. .not. is_error(status)) &
                call check_surface(workspace%solver%curve, status)
            call add_lap(case%asked%times, lap, result%times%normal_us, &
                         result%times%normal_cpu_us)
        end if
        if (is_error(status)) then
            continue
        else if (case%curved .and. case%by_load) then
            call solve_for_load(workspace, case, normal, tangential, result, status)
        else
            call solve_by_methods(workspace, case, normal, tangential, result, status)
        end if
        turn = conformal_turn(workspace, result)
        call add_pressure_errors(turn, case, result, status)
        call add_turn_errors(workspace, turn, case, result, status)
        if (case%asked%temperatures .and. .not. is_error(status)) &
            call find_heat(workspace, case, result, status)
        if (case%asked%subsurface .and. .not. is_error(status)) &
            call find_stress_peak(workspace, case, result, status)
        if (is_error(status)) then
            result = contact_result_t()
        else
            call find_wear(workspace, case, result)
            call name_yield(case%yield, result%normal%pmax, status)
        end if
        call restore_environment(environment)
    end subroutine solve_contact

    subroutine solve_by_methods(workspace, case, normal, tangential, result, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        class(normal_method_t), pointer, intent(in) :: normal ! null if it is auto
        class(tangential_method_t), pointer, intent(in) :: tangential
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        if (.not. associated(normal)) then
            call solve_auto(workspace, case, tangential, result, status)
            return
        end if
        call find_pressures(workspace, case, normal, result, status)
        if (is_error(status) .or. case%methods%tangential == tangential_none) return
        call add_forces(workspace, case, tangential, result, status)
    end subroutine solve_by_methods

    ! The pressures whose force along the normal of the contact, turned and with tractions, is the
    ! load.
    subroutine solve_for_load(workspace, case, normal, tangential, result, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        class(normal_method_t), pointer, intent(in) :: normal ! null if it is auto
        class(tangential_method_t), pointer, intent(in) :: tangential
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        integer :: i

        do i = 1, most_loads
            call clear_steps(workspace%steps)
            call solve_by_methods(workspace, case, normal, tangential, result, status)
            if (is_error(status)) return
            if (abs(result%normal%load - case%load) <= usual_strip_tolerance*case%load) return
            if (.not. result%normal%load > 0.0_wp) exit
            workspace%load_factor = workspace%load_factor*(case%load/result%normal%load)
        end do
        call add_limitation(status, st_target_missed, 'the force along the normal of the ' // &
                            'contact is not the load, but ' // &
                            trim(number_text(result%normal%load)) // ' N')
    end subroutine solve_for_load

    !> The tangential problem on the workspace's normal solution: other creepages, friction, method
    !> or resolution without solving the normal problem again.
    subroutine solve_contact_forces(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with a normal solution
        type(contact_case_t), intent(in) :: case        !! material, mu, creepages, method
        type(contact_result_t), intent(inout) :: result !! of that solution; gets other forces
        type(status_t), intent(out) :: status           !! as `solve_contact`

        class(normal_method_t), pointer :: normal
        class(tangential_method_t), pointer :: tangential
        type(environment_t) :: environment
        real(wp) :: turn

        call hold_environment(environment)
        call check_methods(workspace, case%methods, normal, tangential, status)
        if (case%curved .and. .not. is_error(status)) &
            call check_surface(workspace%solver%curve, status)
        if (.not. is_error(status)) then
            turn = conformal_turn(workspace, result)
            if (turn > 0.0_wp) call shift_pressure_errors(-turn**2, result)
            call add_forces(workspace, case, tangential, result, status)
            if (turn > 0.0_wp) call shift_pressure_errors(turn**2, result)
            call add_turn_errors(workspace, turn, case, result, status)
        end if
        if (case%asked%subsurface) call find_stress_peak(workspace, case, result, status)
        if (.not. is_error(status)) call find_wear(workspace, case, result)
        if (case%asked%temperatures .and. .not. is_error(status)) &
            call find_heat(workspace, case, result, status)
        call restore_environment(environment)
    end subroutine solve_contact_forces

    !> Error estimates of the workspace's solution after one with `case%estimate` off; more than the
    !> limit is named in the status.
    subroutine estimate_contact(workspace, case, result, status)
        type(workspace_t), intent(in) :: workspace      !! with a solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their errors
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        class(normal_method_t), pointer :: normal
        class(tangential_method_t), pointer :: tangential
        type(environment_t) :: environment
        real(wp) :: turn

        call hold_environment(environment)
        call find_normal_method(workspace, workspace%solved_by, normal, status)
        if (.not. is_error(status)) &
            call find_tangential_method(workspace, case%methods%tangential, tangential, status)
        if (.not. is_error(status)) then
            call normal%estimate(workspace, case, result, status)
            if (result%is_estimated .and. case%methods%tangential /= tangential_none) &
                call tangential%estimate(workspace, case, result, status)
            turn = conformal_turn(workspace, result)
            call add_pressure_errors(turn, case, result, status)
            call add_turn_errors(workspace, turn, case, result, status)
        end if
        call restore_environment(environment)
    end subroutine estimate_contact

    !> Name a maximum pressure above the limit that the user has set.
    pure subroutine name_yield(limit, pmax, status)
        real(wp), intent(in) :: limit           !! MPa; 0: none
        real(wp), intent(in) :: pmax            !! MPa
        type(status_t), intent(inout) :: status !! limitations so far; gets `st_beyond_yield`

        if (.not. limit > 0.0_wp .or. pmax <= limit) return
        call add_limitation(status, st_beyond_yield, 'pmax of ' // trim(number_text(pmax)) // &
                            ' MPa is above the limit of ' // trim(number_text(limit)) // ' MPa')
    end subroutine name_yield
end module faststrip_contact_solve
