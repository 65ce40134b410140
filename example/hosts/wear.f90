!> Friction and wear by `use faststrip`: forces and figures of contacts and wheelsets, as bits.
program wear
    use faststrip
    implicit none
    type(contact_case_t) :: case
    type(wear_law_t) :: law
    type(status_t) :: status
    real(wp) :: y(301), yield_shear, angle, regime(4)
    integer :: n, i, k

    y = [(0.1_wp*(k - 151), k=1, size(y))]
    read (*, *) n, law%n, law%density, yield_shear
    do k = 1, law%n
        read (*, *) regime
        law%from(k) = regime(1)
        law%to(k) = regime(2)
        law%constant(k) = regime(3)
        law%slope(k) = regime(4)
    end do
    do i = 1, n
        case = contact_case_t()
        read (*, *) case%methods%normal, case%methods%tangential, case%friction%kind, case%mu, &
            case%friction%kinetic_share, case%friction%half_slip_speed, case%friction%speed, &
            case%friction%slope_factor, case%friction%flange_share, case%friction%tread_angle, &
            case%friction%flange_angle, angle
        call solve_one_contact()
        call solve_both_wheels()
    end do

contains

    subroutine solve_one_contact()
        type(workspace_t) :: workspace
        type(contact_case_t) :: here
        type(contact_result_t) :: result
        integer :: k

        here = case
        here%wear_law = law
        here%yield_shear = yield_shear
        here%mu = friction_at_angle(case%friction, case%mu, angle)
        here%load = 8.0e4_wp
        here%creepage = creepage_t(4.0e-3_wp, -2.0e-3_wp, 2.0e-4_wp)
        call reserve_workspace(workspace, here%methods, size(y), status)
        call set_contact_gap(workspace, y, 2.0e-3_wp*y*y + 3.0e-5_wp*y*y*y, &
                             [(1.0_wp/920.0_wp, k=1, size(y))], status)
        call solve_contact(workspace, here, result, status)
        print '(a, 1x, i0)', 'contact', status%code
        if (is_error(status)) return
        call show([result%tangential%fx, result%tangential%fy, result%tangential%mz])
        call show_figures(result, workspace%strip_forces%n > 0)
        associate (forces => workspace%strip_forces, worn => workspace%strip_wear)
            do k = 1, forces%n
                call show([forces%fx(k), forces%fy(k), forces%friction_power(k), &
                           worn%t_gamma_per_area(k), worn%mass(k), worn%pass_depth(k)])
            end do
        end associate
    end subroutine solve_one_contact

    subroutine solve_both_wheels()
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t) :: workspace
        type(wheelset_result_t) :: result
        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(profile_t) :: wheels(2), rails(2)
        integer :: k, side

        call make_wheel_profile('s1002', wheels(1), status)
        call make_rail_profile('60e1', standard_inclination, rails(1), status)
        wheels(2) = wheels(1)
        rails(2) = rails(1)
        case%wear_law = law
        case%yield_shear = yield_shear
        call make_wheelset(wheels, rails, wheelset_t(), 460.0_wp, track_t(), case, model, status)
        call reserve_wheelset(workspace, model, status)
        state%y = 6.2_wp
        state%yaw = 1.0e-3_wp
        state%speed = 1.0e4_wp
        state%pitch_rate = -1.0e4_wp/460.0_wp
        demand%load = 6.0e4_wp
        call solve_wheelset(model, workspace, state, demand, result, status)
        print '(a, 1x, i0)', 'wheelset', status%code
        if (is_error(status)) return
        do side = 1, 2
            do k = 1, result%wheel(side)%n
                associate (contact => result%wheel(side)%contact(k))
                    call show([contact%figures%tangential%fx, contact%figures%tangential%fy, &
                               contact%figures%tangential%mz])
                    call show_figures(contact%figures, &
                                      workspace%wheel(side)%contact(k)%strip_forces%n > 0)
                end associate
            end do
        end do
    end subroutine solve_both_wheels

    subroutine show_figures(result, has_strips)
        type(contact_result_t), intent(in) :: result
        logical, intent(in) :: has_strips

        associate (figures => result%wear)
            call show([figures%t_gamma, figures%t_gamma_spin, figures%t_gamma_per_area, &
                       figures%fatigue_index])
            if (has_strips) call show([figures%wear%mass, figures%wear%volume])
        end associate
    end subroutine show_figures

    !> Numbers as bits.
    subroutine show(numbers)
        real(wp), intent(in) :: numbers(:)

        print '(*(z16.16, :, 1x))', numbers
    end subroutine show
end program wear
