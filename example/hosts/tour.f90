!> Everything that `use faststrip` gives, once: from profiles to forces, by every method, of a
!> contact and of a wheelset. Prints what it finds.
program tour
    use faststrip
    implicit none
    ! BEGIN methods
    integer, parameter :: normals(*) = [ &
        normal_strip, normal_hertz, normal_equal_area, normal_equal_moments, normal_auto, &
        normal_kpec, normal_analyn, normal_kpec_strips]
    integer, parameter :: tangentials(*) = [ &
        tangential_none, tangential_faststrip, tangential_fastsim, tangential_faststrip_paper, &
        tangential_faststrip_corrected, tangential_fastsim_elliptic, tangential_fastsim_weighted, &
        tangential_linear, tangential_she, tangential_polach, tangential_faststrip_plain]
    ! END methods
    integer, parameter :: targets(5) = [target_forces, target_pmax, target_penetration, &
                                        target_area, target_power]
    integer, parameter :: falls(3) = [friction_linear, friction_rational, friction_exponential]
    real(wp), parameter :: radius = 460.0_wp, load = 8.0e4_wp ! mm, N
    type(status_t) :: status
    type(profile_t) :: wheel, rail, worn
    type(rigid_contact_t) :: right, left
    type(gap_t) :: gap
    type(contact_case_t) :: case

    call make_wheel_profile('s1002', wheel, status)
    call check('wheel')
    ! 1:40, that of a rail by name where nothing is said.
    call make_rail_profile('60e1', unset_inclination, rail, status)
    call check('rail')
    call make_rail_profile('60e1', standard_inclination, rail, status)
    call check('rail')
    call make_worn_rail()
    call find_rigid_contacts(wheel, rail, wheelset_t(), track_t(), 2.0_wp, right, left, status)
    call check('rigid contact')
    call make_gap(wheel, rail, wheelset_t(), right, standard_gap_step, standard_gap_height, gap, &
                  status)
    call check('gap')
    case%gap = gap
    case%load = load
    case%material = material_t()
    case%creepage = creepage_t(cksi=1.0e-3_wp, ceta=5.0e-4_wp, cphi=1.0e-4_wp)
    call by_every_method()
    call with_friction_and_wear()
    call geometry_over_y()
    call of_a_wheelset()

contains

    !> Words of what is not good.
    subroutine check(what)
        character(len=*), intent(in) :: what

        if (status%code == st_ok) return
        print '(4a)', what, ': ', trim(status_word(status%code)), ' ' // trim(status%message)
        if (status%limitations /= 0) print '(a)', trim(limitation_words(status%limitations))
        if (is_error(status)) error stop 1
    end subroutine check

    !> A rail by points along its curve, as it was measured.
    subroutine make_worn_rail()
        type(touchable_t) :: part
        real(wp) :: y(61)
        integer :: i

        y = [(real(i - 31, wp), i=1, size(y))]
        call make_curve_profile(y, y*y/600.0_wp, body_rail, 0.0_wp, standard_kink_angle, worn, &
                                part, status)
        call check('worn rail')
        ! The same procedure takes wheels; this one would bulge into the rail.
        call make_curve_profile(y, -y*y/2000.0_wp, body_wheel, 0.0_wp, standard_kink_angle, worn, &
                                part, status)
        call check('worn wheel')
    end subroutine make_worn_rail

    !> Pressures by one method after the other, then forces on the pressures of the last.
    subroutine by_every_method()
        type(workspace_t) :: workspace
        type(contact_result_t) :: result
        real(wp) :: over_all(4, 4)
        integer :: i

        do i = 1, size(normals)
            case%methods = contact_methods_t(normal=normals(i))
            case%wanted = wanted_t(target=targets(1 + modulo(i, size(targets))), &
                                   tolerance=0.05_wp)
            call reserve_workspace(workspace, case%methods, size(gap%y), status)
            call check('workspace')
            call set_contact_gap(workspace, gap%y, gap%h, gap%inv2r, status)
            call check('gap of the workspace')
            call solve_contact(workspace, case, result, status)
            call check('contact')
            print '(a, i0, 2(1x, f10.3))', 'normal ', normals(i), result%normal%pmax, &
                result%tangential%fx
        end do
        case%methods = contact_methods_t()
        call reserve_workspace(workspace, case%methods, size(gap%y), status)
        call solve_contact(workspace, case, result, status)
        call check('contact by strips')
        do i = 2, size(tangentials)
            case%methods%tangential = tangentials(i)
            call solve_contact_forces(workspace, case, result, status)
            call check('forces')
            print '(a, i0, 2(1x, f10.3))', 'tangential ', tangentials(i), &
                result%tangential%fx, result%tangential%fy
        end do
        call find_contact_derivatives(workspace, case, result, over_all, status)
        call check('derivatives')
        print '(a, 1x, es10.3)', 'stiffness', over_all(1, 1)
        ! NORM and TANG come with faststrip-kalker; without it they are refused by name.
        case%methods = contact_methods_t(normal=normal_norm, tangential=tangential_tang)
        call solve_contact(workspace, case, result, status)
        if (.not. is_error(status)) error stop 2
        case%methods = contact_methods_t()
    end subroutine by_every_method

    !> Friction that falls with slip, wear by a law, elements.
    subroutine with_friction_and_wear()
        type(workspace_t) :: workspace
        type(contact_result_t) :: result
        type(tangential_field_t) :: field
        type(friction_t) :: friction
        type(wear_law_t) :: law
        integer :: i

        law%n = 1
        law%to(1) = 100.0_wp
        law%slope(1) = 5.0_wp
        law%density = 7850.0_wp
        case%wear_law = law
        case%asked%field = .true.
        call reserve_workspace(workspace, case%methods, size(gap%y), status)
        call check('workspace')
        call reserve_contact_field(workspace, case%methods, status)
        call check('elements')
        do i = 1, size(falls)
            friction = friction_t(kind=falls(i), kinetic_share=0.6_wp, &
                                  half_slip_speed=1.0e3_wp, speed=2.0e4_wp, flange_share=0.5_wp, &
                                  tread_angle=0.1_wp, flange_angle=0.5_wp)
            case%mu = friction_at_angle(friction, 0.35_wp, right%gamma)
            case%friction = friction
            call solve_contact(workspace, case, result, status)
            call check('falling friction')
            field = workspace%field
            print '(a, i0, 2(1x, f10.3), 1x, i0)', 'friction ', falls(i), result%tangential%fx, &
                result%wear%wear%mass, field%n
        end do
        case%friction = friction_t()
        case%wear_law = wear_law_t()
        case%asked%field = .false.
        case%mu = 0.35_wp
    end subroutine with_friction_and_wear

    !> The rolling radius difference over the lateral displacement, and its conicity.
    subroutine geometry_over_y()
        integer, parameter :: n = 81
        type(side_t) :: side
        type(contact_functions_t) :: found
        type(conicity_t) :: conicity
        real(wp) :: y(n), delta_r(n), middle
        integer :: i

        side = side_t(wheel, rail, radius)
        do i = 1, n
            y(i) = 0.1_wp*(i - 41)
            call find_contact_functions(side, side, wheelset_t(), track_t(), y(i), .false., found, &
                                        status)
            call check('contact functions')
            delta_r(i) = found%delta_r
        end do
        call find_equilibrium(y, delta_r, middle, status)
        call check('equilibrium')
        call find_conicity(y, delta_r, middle, 3.0_wp, conicity, status)
        call check('conicity')
        print '(a, 1x, f8.5)', 'conicity', conicity%klingel
    end subroutine geometry_over_y

    !> A wheelset by its height, by loads and by its axle load; strips and elements of one contact.
    subroutine of_a_wheelset()
        integer, parameter :: kinds(3) = [demand_loads, demand_axle_load, demand_position]
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t) :: workspace
        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(wheelset_result_t) :: result
        type(wheel_contact_t) :: contact
        type(wheel_strips_t) :: strips
        type(tangential_field_t) :: field
        real(wp) :: slopes(6, 9, 2)
        integer :: i, side

        case%asked%field = .true.
        call make_wheelset([wheel, wheel], [rail, rail], wheelset_t(), radius, track_t(), case, &
                           model, status)
        call check('wheelset')
        call reserve_wheelset(workspace, model, status)
        call check('workspace of the wheelset')
        state%y = 3.0_wp
        state%speed = 2.0e4_wp
        state%pitch_rate = -2.0e4_wp/radius
        state%rail(side_left) = rail_state_t(y=0.2_wp)
        demand%load = load
        demand%axle_load = 2.0_wp*load
        ! Where it stands before it moves.
        demand%kind = demand_rest
        call solve_wheelset(model, workspace, state, demand, result, status)
        call check('state at rest')
        state%z = result%wheel(side_right)%z
        do i = 1, 3
            demand%kind = kinds(i)
            demand%roll_is_free = kinds(i) /= demand_position
            call solve_wheelset(model, workspace, state, demand, result, status)
            call check('state')
            state%z = result%wheel(side_right)%z
            state%roll = result%wheel(side_right)%roll
            call find_wheelset_derivatives(model, workspace, demand%wants, result, slopes, status)
            call check('derivatives')
            print '(a, 2(1x, es10.3))', 'stiffness', slopes(3, 2, :)
            do side = side_right, side_left
                contact = result%wheel(side)%contact(1)
                call find_wheel_strips(model, workspace, result, side, 1, strips, status)
                call check('strips')
                call find_wheel_field(workspace, result, side, 1, field, status)
                call check('elements')
                print '(a, i0, 2(1x, f10.3), 2(1x, i0))', 'side ', side, contact%force(2:), &
                    strips%strips%n, field%n
            end do
        end do
    end subroutine of_a_wheelset
end program tour
