!> Every figure of every contact of a list on standard input, by the Fortran interface: what the
!> other faces (`figures.c`, `figures.f`, Python) are compared with, bit for bit.
!>
!> One line each: `name contact step index value`. Step 1 is the first demand, step 2 the copy of
!> its solution, step 3 the second demand from there (warm), step 4 the same on the copy.
program figures
    use faststrip
    use faststrip_base_material, only: check_material, normal_compliance, combined_shear_modulus
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_fastsim, only: fastsim_coefficients_solve
    use faststrip_contact_methods, only: normal_method, tangential_method, method_name_length
    use faststrip_contact_wanted, only: unknown_error, auto_steps_t
    use, intrinsic :: iso_fortran_env, only: output_unit
    implicit none

    type(contact_case_t) :: case
    type(workspace_t) :: workspace, copy
    type(status_t) :: status
    character(len=method_name_length) :: normal, tangential
    real(wp) :: demand(10, 2), row(4)
    integer :: n_contacts, contact, numbers(2), by_load, elements, has_inclination, estimate, n, k

    call defaults()
    call words()
    read (*, *) n_contacts
    do contact = 1, n_contacts
        case = contact_case_t()
        read (*, *) normal, tangential, numbers, case%methods%strips_per_patch, &
            case%methods%points_per_strip, case%methods%fastsim_nx, case%methods%fastsim_ny, &
            by_load, elements, has_inclination, estimate, case%resolution_limit, &
            case%wanted%target, case%wanted%tolerance, n
        read (*, *) demand
        case%force_limit = case%resolution_limit
        case%methods%normal = normal_method(normal)
        case%methods%tangential = tangential_method(tangential)
        case%by_load = by_load == 1
        case%estimate = estimate == 1
        case%asked%field = elements == 1
        allocate (case%gap%y(n), case%gap%h(n), case%gap%inv2r(n))
        if (has_inclination == 1) allocate (case%gap%inclination(n))
        do k = 1, n
            read (*, *) row
            case%gap%y(k) = row(1)
            case%gap%h(k) = row(2)
            case%gap%inv2r(k) = row(3)
            if (has_inclination == 1) case%gap%inclination(k) = row(4)
        end do
        workspace = workspace_t()
        call reserve_workspace(workspace, case%methods, n, status)
        if (elements == 1) call reserve_contact_field(workspace, case%methods, status)
        if (is_error(status)) error stop 'no capacity'
        call set_contact_gap(workspace, case%gap%y, case%gap%h, case%gap%inv2r, status, &
                             case%gap%inclination)
        deallocate (case%gap%y, case%gap%h, case%gap%inv2r)
        if (allocated(case%gap%inclination)) deallocate (case%gap%inclination)
        if (is_error(status)) error stop 'no gap'
        call solve(workspace, 1)
        copy = workspace
        call show_arrays(copy, 2)
        case%warm_start = .true.
        call solve(workspace, 3)
        call solve(copy, 4)
    end do
    call without_workspace()

contains

    subroutine solve(workspace, step)
        type(workspace_t), intent(inout) :: workspace
        integer, intent(in) :: step

        type(contact_result_t) :: result

        associate (d => demand(:, merge(1, 2, step == 1)))
            case%material = material_t(e_wheel=d(1), e_rail=d(2), nu_wheel=d(3), nu_rail=d(4))
            case%mu = d(5)
            case%load = d(6)
            case%penetration = d(7)
            case%creepage = creepage_t(cksi=d(8), ceta=d(9), cphi=d(10))
        end associate
        call solve_contact(workspace, case, result, status)
        call put('status', step, 0, real(status%code, wp))
        write (*, '(a, 2(1x, i0), 1x, a)') 'message', contact, step, trim(status%message)
        call put('load', step, 0, result%normal%load)
        call put('penetration', step, 0, result%normal%penetration)
        call put('area', step, 0, result%normal%area)
        call put('pmax', step, 0, result%normal%pmax)
        call put('y_min', step, 0, result%normal%y_min)
        call put('y_max', step, 0, result%normal%y_max)
        call put('x_max', step, 0, result%normal%x_max)
        call put('cksi', step, 0, result%creepage%cksi)
        call put('ceta', step, 0, result%creepage%ceta)
        call put('fx', step, 0, result%tangential%fx)
        call put('fy', step, 0, result%tangential%fy)
        call put('mz', step, 0, result%tangential%mz)
        call put('friction_power', step, 0, result%tangential%friction_power)
        call put('stick_fraction', step, 0, result%tangential%stick_fraction)
        call put('n_patches', step, 0, real(result%normal%n_patches, wp))
        call put('iterations', step, 0, real(result%normal%iterations, wp))
        call put('n_elements', step, 0, real(workspace%field%n, wp))
        call put('is_estimated', step, 0, merge(1.0_wp, 0.0_wp, result%is_estimated))
        call put('strips_across', step, 0, real(result%normal%strips_across, wp))
        call put('est_err_penetration', step, 0, result%normal_errors%est_err_penetration)
        call put('est_err_pmax', step, 0, result%normal_errors%est_err_pmax)
        call put('est_err_area', step, 0, result%normal_errors%est_err_area)
        call put('residual_inside', step, 0, result%normal_errors%residual_inside)
        call put('overlap_outside', step, 0, result%normal_errors%overlap_outside)
        call put('forces_are_estimated', step, 0, &
                 merge(1.0_wp, 0.0_wp, result%forces_are_estimated))
        call put('est_err_fx', step, 0, result%force_errors%fx)
        call put('est_err_fy', step, 0, result%force_errors%fy)
        call put('est_err_mz', step, 0, result%force_errors%mz)
        call put('est_err_cksi', step, 0, result%creepage_errors(1))
        call put('est_err_ceta', step, 0, result%creepage_errors(2))
        call put('limitations', step, 0, real(status%limitations, wp))
        call show_steps(workspace%steps, step)
        call show_arrays(workspace, step)
    end subroutine solve

    !> What auto did; -1 for an estimate that is not known, of all of them 0.
    subroutine show_steps(taken, step)
        type(auto_steps_t), intent(in) :: taken
        integer, intent(in) :: step

        integer :: i
        logical :: is_known

        is_known = taken%estimate < unknown_error
        call put('n_steps', step, 0, real(taken%n, wp))
        call put('best_step', step, 0, real(taken%best, wp))
        call put('target_is_known', step, 0, merge(1.0_wp, 0.0_wp, is_known))
        call put('target_is_met', step, 0, merge(1.0_wp, 0.0_wp, taken%is_met))
        call put('est_err_target', step, 0, merge(taken%estimate, 0.0_wp, is_known))
        do i = 1, taken%n
            associate (one => taken%steps(i))
                call put('step_normal', step, i, real(one%methods%normal, wp))
                call put('step_tangential', step, i, real(one%methods%tangential, wp))
                call put('step_strips', step, i, real(one%methods%strips_per_patch, wp))
                call put('step_points', step, i, real(one%methods%points_per_strip, wp))
                call put('step_estimate', step, i, &
                         merge(one%estimate, -1.0_wp, one%estimate < unknown_error))
            end associate
        end do
    end subroutine show_steps

    subroutine show_arrays(workspace, step)
        type(workspace_t), intent(in) :: workspace
        integer, intent(in) :: step

        integer :: i, n_strips

        n_strips = merge(workspace%strips%n, 0, workspace%solved_by > 0)
        call put('n_strips', step, 0, real(n_strips, wp))
        do i = 1, n_strips
            call put('strip_y_left', step, i, workspace%strips%y_left(i))
            call put('strip_y_right', step, i, workspace%strips%y_right(i))
            call put('strip_half_length', step, i, workspace%strips%half_length(i))
            call put('strip_p0', step, i, workspace%strips%p0(i))
            call put('strip_patch', step, i, real(workspace%strips%patch(i), wp))
        end do
        do i = 1, workspace%field%n
            call put('element_x', step, i, workspace%field%x(i))
            call put('element_y', step, i, workspace%field%y(i))
            call put('element_area', step, i, workspace%field%area(i))
            call put('element_pn', step, i, workspace%field%pn(i))
            call put('element_px', step, i, workspace%field%px(i))
            call put('element_py', step, i, workspace%field%py(i))
            call put('element_sx', step, i, workspace%field%sx(i))
            call put('element_sy', step, i, workspace%field%sy(i))
            call put('element_state', step, i, real(workspace%field%state(i), wp))
        end do
    end subroutine show_arrays

    !> Three of each procedure without a workspace, then two that end with an error.
    subroutine without_workspace()
        type(tangential_result_t) :: forces
        type(hertz_t) :: hertz
        type(kalker_coefficients_t) :: c
        type(material_t) :: material
        type(creepage_t) :: creepage
        real(wp) :: x(11)
        integer :: nx, ny, i

        contact = 0
        do i = 1, 5
            read (*, *) x, nx, ny
            c = kalker_coefficients_t(c11=x(4), c22=x(5), c23=x(6), c33=0.0_wp)
            creepage = creepage_t(cksi=x(7), ceta=x(8), cphi=x(9))
            hertz = hertz_t(a=x(1), b=x(2), load=x(11))
            call fastsim_coefficients_solve(hertz, x(3), c, x(10), creepage, nx, ny, forces, status)
            call put('fastsim_status', i, 0, real(status%code, wp))
            call put('fastsim_fx', i, 0, forces%fx)
            call put('fastsim_fy', i, 0, forces%fy)
            call put('fastsim_mz', i, 0, forces%mz)
        end do
        do i = 1, 5
            read (*, *) x(:7)
            material = material_t(e_wheel=x(1), e_rail=x(2), nu_wheel=x(3), nu_rail=x(4))
            hertz = hertz_t()
            call check_material(material, status)
            if (.not. is_error(status)) call hertz_solve(normal_compliance(material), x(5), x(6), &
                                                         x(7), hertz, status)
            call put('hertz_status', i, 0, real(status%code, wp))
            call put('hertz_a', i, 0, hertz%a)
            call put('hertz_b', i, 0, hertz%b)
            call put('hertz_penetration', i, 0, hertz%penetration)
            call put('hertz_pmax', i, 0, hertz%pmax)
            call put('shear_modulus', i, 0, combined_shear_modulus(material))
        end do
        do i = 1, 5
            read (*, *) x(:2)
            call kalker_coefficients(x(1), x(2), c, status)
            call put('kalker_status', i, 0, real(status%code, wp))
            call put('kalker_c11', i, 0, c%c11)
            call put('kalker_c22', i, 0, c%c22)
            call put('kalker_c23', i, 0, c%c23)
            call put('kalker_c33', i, 0, c%c33)
        end do
    end subroutine without_workspace

    subroutine defaults()
        type(contact_case_t) :: case
        type(wanted_t) :: wanted

        contact = 0
        call put('default_normal', 0, 0, real(case%methods%normal, wp))
        call put('default_tangential', 0, 0, real(case%methods%tangential, wp))
        call put('default_strips_per_patch', 0, 0, real(case%methods%strips_per_patch, wp))
        call put('default_points_per_strip', 0, 0, real(case%methods%points_per_strip, wp))
        call put('default_fastsim_nx', 0, 0, real(case%methods%fastsim_nx, wp))
        call put('default_fastsim_ny', 0, 0, real(case%methods%fastsim_ny, wp))
        call put('default_by_load', 0, 0, merge(1.0_wp, 0.0_wp, case%by_load))
        call put('default_warm_start', 0, 0, merge(1.0_wp, 0.0_wp, case%warm_start))
        call put('default_with_elements', 0, 0, 0.0_wp)
        call put('default_e_wheel', 0, 0, case%material%e_wheel)
        call put('default_e_rail', 0, 0, case%material%e_rail)
        call put('default_nu_wheel', 0, 0, case%material%nu_wheel)
        call put('default_nu_rail', 0, 0, case%material%nu_rail)
        call put('default_mu', 0, 0, case%mu)
        call put('default_load', 0, 0, case%load)
        call put('default_penetration', 0, 0, case%penetration)
        call put('default_cksi', 0, 0, case%creepage%cksi)
        call put('default_ceta', 0, 0, case%creepage%ceta)
        call put('default_cphi', 0, 0, case%creepage%cphi)
        call put('default_estimate', 0, 0, merge(1.0_wp, 0.0_wp, case%estimate))
        call put('default_resolution_limit', 0, 0, case%resolution_limit)
        call put('default_force_limit', 0, 0, case%force_limit)
        call put('default_target', 0, 0, real(wanted%target, wp))
        call put('default_tolerance', 0, 0, wanted%tolerance)
        call put('default_budget_us', 0, 0, wanted%budget_us)
    end subroutine defaults

    subroutine words()
        integer :: code

        do code = -1, 130
            write (*, '(a, 2(1x, i0), 1x, a)') 'word', 0, code, trim(status_word(code))
        end do
    end subroutine words

    subroutine put(name, step, i, value)
        character(len=*), intent(in) :: name
        integer, intent(in) :: step, i
        real(wp), intent(in) :: value

        write (output_unit, '(a, 3(1x, i0), es26.17e3)') name, contact, step, i, value
    end subroutine put
end program figures
