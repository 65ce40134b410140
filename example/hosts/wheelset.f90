!> Wheelsets by `use faststrip`: every figure of every contact, as bits.
program wheelsets
    use faststrip
    implicit none
    integer, parameter :: cases = 12
    type(wheelset_model_t) :: model
    type(wheelset_workspace_t) :: workspace
    type(wheelset_result_t) :: result
    type(wheelset_demand_t) :: demand
    type(wheelset_state_t) :: state
    type(wheel_strips_t) :: found
    type(tangential_field_t) :: field
    type(status_t) :: status
    real(wp) :: slopes(6, 9, 2)
    integer :: setup, i, side, k

    do setup = 1, 2
        call make(setup)
        state = wheelset_state_t()
        do i = 1, cases
            call ask(i)
            call solve_wheelset(model, workspace, state, demand, result, status)
            do side = 1, 2
                if (is_error(status)) demand%wants(side) = .false.
            end do
            print '(a, 2(1x, i0))', 'solved', status%code, sum(result%wheel%n, mask=demand%wants)
            do side = 1, 2
                if (.not. demand%wants(side)) cycle
                associate (wheel => result%wheel(side))
                    print '(a, 3(1x, i0))', 'wheel', wheel%status%code, wheel%n, wheel%solutions
                    call show([wheel%z, wheel%roll, wheel%force, wheel%force_wheelset, &
                               wheel%moment])
                    do k = 1, wheel%n
                        call show_contact(side, wheel%contact(k))
                        call show_parts(side, k)
                    end do
                    state%z = wheel%z
                    state%roll = wheel%roll
                end associate
            end do
            if (is_error(status)) cycle
            call find_wheelset_derivatives(model, workspace, demand%wants, result, slopes, status)
            print '(a, 1x, i0)', 'derivatives', status%code
            if (is_error(status)) cycle
            do side = 1, 2
                do k = 1, 9
                    call show(slopes(:, k, side))
                end do
            end do
        end do
    end do

contains

    !> The first wheelset has profiles of names, the second one of points, and contact damping.
    subroutine make(setup)
        integer, intent(in) :: setup
        type(profile_t) :: wheels(2), rails(2)
        type(touchable_t) :: part
        type(contact_case_t) :: case
        type(track_t) :: track
        real(wp) :: y(61)
        integer :: i

        case%mu = 0.35_wp
        case%methods%strips_per_patch = 9
        case%asked%field = .true.
        if (setup == 1) then
            call make_wheel_profile('s1002', wheels(1), status)
            call make_rail_profile('60e1', 0.05_wp, rails(1), status)
        else
            y = [(real(i - 31, wp), i=1, 61)]
            call make_curve_profile(y, -y*y/2000.0_wp - y/20.0_wp, body_wheel, 0.0_wp, &
                                    standard_kink_angle, wheels(1), part, status)
            call make_curve_profile(y, y*y/600.0_wp, body_rail, 0.05_wp, standard_kink_angle, &
                                    rails(1), part, status)
            track%rail_distance = 1500.0_wp
        end if
        wheels(2) = wheels(1)
        rails(2) = rails(1)
        if (setup == 2) call make_wheel_profile('cone40', wheels(2), status)
        call make_wheelset(wheels, rails, wheelset_t(), 460.25_wp, track, case, model, status)
        if (setup == 2) model%damping = 1.0e-3_wp
        if (setup == 2) model%speed_floor = 100.0_wp
        if (setup == 2) model%rail_stiffness = [3.0e4_wp, 8.0e4_wp]
        call reserve_wheelset(workspace, model, status)
    end subroutine make

    !> The rails have moved in the second half, and each wheel rotates by itself.
    subroutine ask(i)
        integer, intent(in) :: i
        real(wp) :: moved

        state%y = 0.5_wp*i - 3.0_wp
        state%yaw = 0.001_wp*i
        state%speed = 20000.0_wp
        state%y_rate = 10.0_wp*i
        state%z_rate = 1.0_wp
        state%roll_rate = 0.001_wp
        state%yaw_rate = 0.01_wp*i
        state%pitch_rate = -20000.0_wp/460.0_wp
        state%curvature = 1.0e-6_wp
        moved = merge(real(i, wp), 0.0_wp, i > 6)
        state%rail(1) = rail_state_t(0.01_wp*moved, -0.02_wp*moved, 1.0e-4_wp*moved, 2.0_wp*moved, &
                                     -0.5_wp*moved, 1.0e-3_wp*moved)
        state%rail(2) = rail_state_t(-0.02_wp*moved, 0.01_wp*moved, -2.0e-4_wp*moved, -moved, &
                                     0.25_wp*moved, 2.0e-3_wp*moved)
        state%pitch_rate_difference = 0.01_wp*moved
        demand = wheelset_demand_t(modulo(i, 3))
        demand%load = [60000.0_wp, 50000.0_wp]
        demand%axle_load = 120000.0_wp
        demand%roll_moment = 1000000.0_wp
        demand%roll_is_free = modulo(i, 3) > 0 .and. i < 7
        if (modulo(i, 3) < 2 .and. i >= 9) demand%wants(modulo(i, 2) + 1) = .false.
        if (modulo(i, 2) == 0) then
            workspace%has_last = .false.
            workspace%wheel%n = 0
            workspace%wheel%approach = 0.0_wp
        end if
    end subroutine ask

    subroutine show_contact(side, contact)
        integer, intent(in) :: side
        type(wheel_contact_t), intent(in) :: contact

        associate (figures => contact%figures, creepage => contact%creepage)
            print '(a, 7(1x, i0))', 'contact', side, contact%status%code, &
                figures%normal%n_patches, figures%normal%strips_across, &
                merge(1, 0, figures%is_estimated), merge(1, 0, figures%forces_are_estimated), &
                contact%status%limitations
            call show([contact%place, contact%angle, contact%rail, contact%wheel])
            call show([contact%radius, contact%speed, creepage%cksi, creepage%ceta, creepage%cphi])
            call show([figures%normal%load, figures%normal%penetration, figures%normal%area])
            call show([figures%normal%pmax, figures%normal%y_min, figures%normal%y_max])
            call show([figures%normal%x_max, figures%tangential%fx, figures%tangential%fy])
            call show([figures%tangential%mz, figures%tangential%friction_power])
            call show([figures%tangential%stick_fraction, contact%force, contact%force_wheelset])
            call show(contact%moment)
            call show([figures%normal_errors%est_err_penetration, &
                       figures%normal_errors%est_err_pmax])
            call show([figures%normal_errors%est_err_area, figures%force_errors%fx])
            call show([figures%force_errors%fy, figures%force_errors%mz, &
                       contact%est_err_load])
        end associate
    end subroutine show_contact

    !> The second strip of a contact, and an element in its first half.
    subroutine show_parts(side, k)
        integer, intent(in) :: side, k
        type(status_t) :: status
        integer :: j

        call find_wheel_strips(model, workspace, result, side, k, found, status)
        if (.not. is_error(status)) &
            call find_wheel_field(workspace, result, side, k, field, status)
        j = field%n/3 + 1
        associate (strips => found%strips, forces => found%forces)
            print '(a, 5(1x, i0))', 'parts', status%code, strips%n, field%n, strips%patch(2), &
                field%state(j)
            call show([strips%y_left(2), strips%y_right(2), strips%half_length(2), strips%p0(2), &
                       forces%fx(2), forces%fy(2), forces%friction_power(2)])
        end associate
        call show([field%x(j), field%y(j), field%area(j), field%pn(j), field%px(j), field%py(j), &
                   field%sx(j), field%sy(j)])
    end subroutine show_parts

    !> Numbers as bits.
    subroutine show(numbers)
        real(wp), intent(in) :: numbers(:)

        print '(*(z16.16, :, 1x))', numbers
    end subroutine show
end program wheelsets
