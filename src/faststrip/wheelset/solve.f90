!> A wheelset on a track: from its state to the forces of every contact.
!>
!> All contacts of a wheel share its height: each has the overlap along its own normal that follows
!> from it. The height is given, or it is that at which the vertical force of the contacts, normal
!> and friction forces together, is the one that was asked for; with both wheels under one axle load
!> the roll may be free, too.
module faststrip_wheelset_solve
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_friction, only: friction_at_angle, falls
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size
    use faststrip_base_material, only: combined_shear_modulus
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     join_limitations, number_text, st_bad_argument, &
                                     st_workspace_too_small, st_target_missed, st_beyond_adhesion, &
                                     st_no_convergence, st_no_contact
    use faststrip_contact_case, only: contact_case_t, keeps_elements
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field
    use faststrip_geometry_contact_frame, only: reserve_frame_gap
    use faststrip_geometry_gap, only: gap_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_geometry_profile, only: profile_t
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, check_roller
    use faststrip_geometry_wheel_on_rail, only: make_wheel_on_rail, put_on_roller
    use faststrip_geometry_wheel_outline, only: reserve_outline
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, check_state, pure_rolling, &
                                                 wheelset_axes_t, wheelset_axes, reversed_state, &
                                                 rolling_state, resting_state
    use faststrip_wheelset_approach, only: approach_search_t, start_search, take_force, &
                                           is_found, usual_approach, most_tries, &
                                           spring_share, find_spring_step, hertz_power
    use faststrip_wheelset_balance, only: solve_for_balance
    use faststrip_wheelset_guide, only: needs_guide, take_guide
    use faststrip_wheelset_height, only: set_outline, try_height, try_table
    use faststrip_wheelset_loads, only: start_afresh, solve_loads, solve_for_roll, name_jump
    use faststrip_wheelset_predict, only: predict_heights, remember_heights
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, &
                                        side_right, side_left, demand_position, demand_loads, &
                                        demand_axle_load, demand_rest, most_contacts
    use faststrip_wheelset_wheel, only: estimate_wheel, name_pressures, mirror_wheel, &
                                        reverse_wheel
    use faststrip_wheelset_wheel_neighbours, only: estimate_loads, add_load_errors
    implicit none
    private

    public :: make_wheelset, set_damping, set_rail_stiffness, set_roller
    public :: reserve_wheelset, solve_wheelset

    ! Tuned [1]: of the load, how near a method comes whose height strips find. Origin: chosen: far
    ! below what methods differ by.
    real(wp), parameter :: near_load = 1.0e-4_wp
    ! Tuned [1]: of a moment about the axle, over mu N r: it is found, and what methods jump by at a
    ! slip. Origin: chosen: the pitch rate to 1e-6 up to .999 of it; as of given forces.
    real(wp), parameter :: near_moment = 1.0e-6_wp, jump_of_moment = 5.0e-4_wp
    ! Tuned [1]: a quarter of the longest first step of slip. Origin: chosen: half of saturation.
    real(wp), parameter :: first_slip = 5.0e-4_wp
    ! Tuned [1]: fall of the linear moment over mu N r with slip, at least. Origin: safeguard: a
    ! fifth of that of steel under a wheel's load.
    real(wp), parameter :: least_fall = 100.0_wp
    ! Tuned [1]: longest step over the last one. Origin: safeguard.
    real(wp), parameter :: longest_step = 4.0_wp
    ! Tuned [1]: of a bracket of slips that is a jump. Origin: safeguard: far below what counts.
    real(wp), parameter :: least_slip = 1.0e-10_wp
    ! Tuned [solutions]: of a wheelset, by secants and in all. Origin: safeguard: four to eight are
    ! taken.
    integer, parameter :: most_secants = 16, most_slips = 60
    ! Given: y and z of both rails.
    integer, parameter :: n_directions = 4
    ! Tuned [1]: what may be missing of the balance of a rail and its spring, of the force. Origin:
    ! chosen: as loads are found.
    real(wp), parameter :: near_deflection = 1.0e-8_wp
    ! Tuned [solutions]: of a wheelset, until they are in balance; in a quarter of them steps that
    ! leave more than before are taken back. Origin: safeguard: three to six are taken, on rails
    ! that go to the side by millimetres up to 60; of 250 loads on springs at random 249 are found
    ! again by their height.
    integer, parameter :: most_deflections = 90

    !> What contacts carry about the axle.
    type :: axle_figures_t
        real(wp) :: moment = 0.0_wp ! N mm
        real(wp) :: bound = 0.0_wp  ! mu N r, N mm
        real(wp) :: fall = 0.0_wp   ! of the linear moment over the bound with slip, nearly
    end type axle_figures_t

contains

    !> Put a wheelset on a track.
    subroutine make_wheelset(wheels, rails, wheelset, radius_left, track, case, model, status)
        type(profile_t), intent(in) :: wheels(2)     !! right and left, both as a right wheel
        type(profile_t), intent(in) :: rails(2)      !! right and left, both as a right rail, canted
        type(wheelset_t), intent(in) :: wheelset     !! mm; its radius is that of the right wheel
        real(wp), intent(in) :: radius_left          !! nominal radius of the left wheel, mm
        type(track_t), intent(in) :: track           !! mm
        type(contact_case_t), intent(in) :: case     !! material, friction, methods
        type(wheelset_model_t), intent(inout) :: model !! made
        type(status_t), intent(out) :: status
            !! `st_bad_argument`, `st_out_of_range`: dimensions, profiles

        type(wheelset_t) :: left

        left = wheelset
        left%radius = radius_left
        model%case = case
        ! Solutions copy the case: without a gap that allocates nothing.
        model%case%gap = gap_t()
        model%radius = 0.5_wp*(wheelset%radius + radius_left)
        call make_wheel_on_rail(wheels(side_right), rails(side_right), wheelset, track, &
                                model%pair(side_right), status)
        if (is_error(status)) return
        call make_wheel_on_rail(wheels(side_left), rails(side_left), left, track, &
                                model%pair(side_left), status)
    end subroutine make_wheelset

    !> Contact damping of a wheelset, and the floor of its rolling speeds.
    pure subroutine set_damping(model, damping, speed_floor, status)
        type(wheelset_model_t), intent(inout) :: model !! changed unless there is an error
        real(wp), intent(in) :: damping
            !! share by which forces grow with the approach rate, s/mm; 0: none
        real(wp), intent(in) :: speed_floor
            !! below which forces grow with the velocities, mm/s; 0: none
        type(status_t), intent(out) :: status !! `st_bad_argument`: below 0, or no number

        call check_damping(damping, speed_floor, status)
        if (is_error(status)) return
        model%damping = damping
        model%speed_floor = speed_floor
    end subroutine set_damping

    pure subroutine check_damping(damping, speed_floor, status)
        real(wp), intent(in) :: damping, speed_floor
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. (damping >= 0.0_wp .and. ieee_is_finite(damping))) then
            call set_status(status, st_bad_argument, 'contact damping must be at least 0 s/mm, ' &
                            // 'got ' // number_text(damping))
        else if (.not. (speed_floor >= 0.0_wp .and. ieee_is_finite(speed_floor))) then
            call set_status(status, st_bad_argument, 'the floor of the speed must be at least ' // &
                            '0 mm/s, got ' // number_text(speed_floor))
        end if
    end subroutine check_damping

    !> Springs below both rails, which give way along y and z.
    pure subroutine set_rail_stiffness(model, stiffness, status)
        type(wheelset_model_t), intent(inout) :: model !! changed unless there is an error
        real(wp), intent(in) :: stiffness(2)           !! along y and z, N/mm; 0: rigid
        type(status_t), intent(out) :: status          !! `st_bad_argument`: below 0, or too large

        call check_rail_stiffness(stiffness, status)
        if (.not. is_error(status)) model%rail_stiffness = stiffness
    end subroutine set_rail_stiffness

    pure subroutine check_rail_stiffness(stiffness, status)
        real(wp), intent(in) :: stiffness(2)
        type(status_t), intent(out) :: status

        integer :: i

        call clear_status(status)
        do i = 1, 2
            if (.not. (stiffness(i) >= 0.0_wp .and. stiffness(i) <= largest_size)) &
                call set_status(status, st_bad_argument, 'the stiffness below a rail must be 0 ' &
                                // 'to ' // trim(number_text(largest_size)) // ' N/mm, got ' // &
                                number_text(stiffness(i)))
        end do
    end subroutine check_rail_stiffness

    !> Put a wheelset on rollers, both on one axis along y, or back on rails. It has to be reserved
    !> anew.
    pure subroutine set_roller(model, radius, status)
        type(wheelset_model_t), intent(inout) :: model !! made; changed unless there is an error
        real(wp), intent(in) :: radius                 !! at z = 0 of the track, mm; 0: rails
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: below 0, no number, not above the depth of the profiles

        integer :: side

        call clear_status(status)
        do side = side_right, side_left
            if (radius /= 0.0_wp) &
                call check_roller(radius, maxval(model%pair(side)%sample), status)
        end do
        if (is_error(status)) return
        do side = side_right, side_left
            call put_on_roller(model%pair(side), radius)
        end do
    end subroutine set_roller

    ! What a wheelset on rollers, whose rails are all of revolution about y, cannot have.
    subroutine check_on_rollers(model, state, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_state_t), intent(in) :: state
        type(status_t), intent(inout) :: status

        if (is_error(status) .or. .not. any(model%pair%roller_radius > 0.0_wp)) return
        call check_none('curvature', state%curvature, '1/mm')
        call check_none('roll of a rail', maxval(abs(state%rail%roll)), 'rad')
        call check_none('roll_rate of a rail', maxval(abs(state%rail%roll_rate)), 'rad/s')

    contains

        subroutine check_none(name, value, unit)
            character(len=*), intent(in) :: name, unit
            real(wp), intent(in) :: value

            if (abs(value) > 0.0_wp .and. .not. is_error(status)) &
                call set_status(status, st_bad_argument, name // ' of a wheelset on rollers ' // &
                                'must be 0 ' // unit // ', got ' // number_text(value))
        end subroutine check_none
    end subroutine check_on_rollers

    !> Allocate for a model; the only allocation.
    subroutine reserve_wheelset(workspace, model, status)
        type(wheelset_workspace_t), intent(inout) :: workspace !! sized
        type(wheelset_model_t), intent(in) :: model            !! made
        type(status_t), intent(out) :: status                  !! those of `reserve_workspace`

        type(contact_case_t) :: guide
        integer :: side, i

        call clear_status(status)
        guide%methods = model%case%methods
        call take_guide(guide)
        workspace%has_last = .false.
        if (.not. allocated(workspace%near)) allocate (workspace%near(1))
        do side = side_right, side_left
            associate (wheel => workspace%wheel(side), pair => model%pair(side))
                if (.not. allocated(pair%y)) then
                    call set_status(status, st_bad_argument, 'the wheelset must be made first')
                    return
                else if (model%case%asked%subsurface) then
                    call set_status(status, st_bad_argument, 'stresses below the surface are ' // &
                                    'those of one contact, not of a wheelset')
                    return
                end if
                wheel%n = 0
                wheel%approach = 0.0_wp
                call reserve_frame_gap(wheel%gap, pair)
                call reserve_outline(wheel%outline, pair)
                if (.not. allocated(wheel%contact)) allocate (wheel%contact(most_contacts))
                do i = 1, most_contacts
                    if (needs_guide(model%case)) &
                        call reserve_workspace(wheel%contact(i), guide%methods, size(pair%y), &
                                               status)
                    if (is_error(status)) return
                    call reserve_workspace(wheel%contact(i), model%case%methods, size(pair%y), &
                                           status)
                    if (keeps_elements(model%case) .and. .not. is_error(status)) &
                        call reserve_contact_field(wheel%contact(i), model%case%methods, status)
                    if (is_error(status)) return
                end do
            end associate
        end do
    end subroutine reserve_wheelset

    !> The contacts of a wheelset and their forces. One that rolls backwards, by the mean of its
    !> speed and that of its wheels' surfaces, is solved as its image that rolls ahead: x of the
    !> figures is that of the track either way.
    subroutine solve_wheelset(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! z, roll and pitch rate count where
                                                               !! the demand leaves them
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status
            !! `st_bad_argument`, `st_workspace_too_small`, `st_no_contact`, `st_no_convergence`,
            !! `st_beyond_adhesion`, those of contacts; `st_target_missed`: the force jumps over
            !! the load

        type(environment_t) :: environment

        if (all(model%rail_stiffness == 0.0_wp)) then
            call solve_on_rails(model, workspace, state, demand, result, status)
            return
        end if
        call hold_environment(environment)
        call check_rail_stiffness(model%rail_stiffness, status)
        if (.not. is_error(status)) &
            call solve_on_springs(model, workspace, state, demand, result, status)
        call restore_environment(environment)
    end subroutine solve_wheelset

    subroutine solve_on_rails(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        if (demand%axle_moment_is_given) then
            call solve_for_axle_moment(model, workspace, state, demand, result, status)
        else
            call solve_motion(model, workspace, state, demand, result, status)
        end if
    end subroutine solve_on_rails

    ! Rails without mass on springs: each is displaced by u beside where the state has it, with
    ! K u = F, F the force of its wheel. Steps of Newton's method for both, from the stiffness of
    ! Hertz' law along the normal of each contact, corrected by what steps find (Broyden).
    subroutine solve_on_springs(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: moved
        real(wp), dimension(n_directions) :: stiffness, u, best, force, left, before, missed, step
        real(wp) :: slope(n_directions, n_directions), reach
        integer :: i, j, solutions(2)
        logical :: singular, is_first, is_worse

        result%wheel%n = 0
        result%wheel%solutions = 0
        call start_deflection(model, workspace, state, demand, u, status)
        if (is_error(status)) return
        stiffness = [model%rail_stiffness, model%rail_stiffness]
        solutions = 0
        is_first = .true.
        best = 0.0_wp
        step = u
        do i = 1, most_deflections
            u = best + step
            moved = state
            moved%rail%y = state%rail%y + u(1::2)
            moved%rail%z = state%rail%z + u(2::2)
            call solve_on_rails(model, workspace, moved, demand, result, status)
            solutions = solutions + result%wheel%solutions
            result%wheel%solutions = solutions
            if (is_error(status)) then
                if (is_first .and. (status%code /= st_no_contact .or. all(step == 0.0_wp))) return
                ! Rails that gave way too far, mostly to where nothing touches them.
                step = merge(0.0_wp, 0.5_wp, is_first)*step
                cycle
            end if
            force = 0.0_wp
            if (demand%wants(side_right)) force(:2) = result%wheel(side_right)%force(2:3)
            if (demand%wants(side_left)) force(3:) = result%wheel(side_left)%force(2:3)
            left = merge(force - stiffness*u, 0.0_wp, stiffness > 0.0_wp)
            workspace%deflection = reshape(u, [2, 2])
            if (all(abs(left) <= near_deflection*norm2(force))) return
            is_worse = .false.
            if (is_first) then
                slope = first_slope(demand, result)
            else
                ! How forces have fallen, beside what was expected.
                missed = before - left - matmul(slope, step) - stiffness*step
                do j = 1, n_directions
                    slope(:, j) = slope(:, j) + missed*step(j)/sum(step**2)
                end do
                ! Where more is left than before, from there again, and not so far; after many steps
                ! on from there, for the way may lead over such places.
                is_worse = norm2(left) > norm2(before) .and. 4*i <= most_deflections
            end if
            is_first = .false.
            if (.not. is_worse) then
                best = u
                before = left
            end if
            reach = 0.5_wp*norm2(step)
            call find_spring_step(slope, stiffness, before, step, singular)
            if (singular) exit
            if (is_worse) step = step*min(1.0_wp, reach/norm2(step))
        end do
        workspace%has_last = .false.
        result%wheel%n = 0
        if (.not. (is_first .and. is_error(status))) &
            call set_status(status, st_no_convergence, &
                            'no balance of rails and their springs was found')
    end subroutine solve_on_springs

    ! How forces fall with the displacements of the rails. Where loads are given wheels follow the
    ! rails down: each by itself, or both together.
    pure function first_slope(demand, result) result(slope)
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(in) :: result
        real(wp) :: slope(n_directions, n_directions)

        real(wp), dimension(n_directions) :: normal, down
        real(wp) :: stiffness
        integer :: side, i, j

        slope = 0.0_wp
        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            do i = 1, result%wheel(side)%n
                associate (contact => result%wheel(side)%contact(i))
                    normal = 0.0_wp
                    normal(2*side - 1:2*side) = [-sin(contact%angle), cos(contact%angle)]
                    stiffness = hertz_power*contact%figures%normal%load &
                                /contact%figures%normal%penetration
                    do j = 1, n_directions
                        slope(:, j) = slope(:, j) + stiffness*normal*normal(j)
                    end do
                end associate
            end do
        end do
        if (demand%kind == demand_position) return
        do side = side_right, side_left
            down = 0.0_wp
            down(2*side) = 1.0_wp
            if (demand%kind /= demand_loads .and. .not. demand%roll_is_free .and. &
                demand%kind /= demand_rest) down(2::2) = 1.0_wp
            normal = matmul(slope, down)
            if (.not. dot_product(down, normal) > 0.0_wp) cycle
            normal = normal/sqrt(dot_product(down, normal))
            do j = 1, n_directions
                slope(:, j) = slope(:, j) - normal*normal(j)
            end do
            if (all(down(2::2) > 0.0_wp)) return
        end do
    end function first_slope

    ! Where rails lie at first: as at the last solution, or as a usual wheel presses them.
    subroutine start_deflection(model, workspace, state, demand, u, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        real(wp), intent(out) :: u(n_directions)
        type(status_t), intent(out) :: status

        real(wp) :: touch(2), low, high, z
        integer :: side, i

        u = reshape(workspace%deflection, [n_directions])
        call check_demand(state, demand, status)
        if (.not. is_error(status)) call check_workspace(model, workspace, status)
        if (is_error(status)) return
        if (workspace%has_last .and. demand%kind /= demand_position) return
        if (.not. workspace%has_last) u = 0.0_wp
        associate (stiffness => model%rail_stiffness(2))
            if (.not. stiffness > 0.0_wp) return
            if (demand%kind == demand_loads) then
                u(2::2) = merge(demand%load, 0.0_wp, demand%wants)/stiffness
                return
            else if (demand%kind == demand_rest .or. demand%roll_is_free) then
                u(2::2) = 0.5_wp*demand%axle_load/stiffness
                return
            end if
            do side = side_right, side_left
                touch(side) = huge(touch)
                if (.not. demand%wants(side)) cycle
                call set_outline(model, workspace, state, side, touch(side), status)
                if (is_error(status)) return
            end do
            z = state%z
            if (demand%kind == demand_axle_load) then
                ! Where both carry it, each on its spring.
                low = minval(touch)
                high = maxval(touch) + demand%axle_load/stiffness + usual_approach(demand%axle_load)
                do i = 1, most_deflections
                    z = 0.5_wp*(low + high)
                    if (stiffness*sum(spring_share(max(z - touch, 0.0_wp), stiffness)) &
                        > demand%axle_load) then
                        high = z
                    else
                        low = z
                    end if
                end do
            end if
            u(2::2) = spring_share(max(z - touch, 0.0_wp), stiffness)
        end associate
    end subroutine start_deflection

    ! The pitch rate at which contacts carry a moment about the axle. Ahead, it falls with the slip
    ! of the wheels, as forces do with creepage: secant steps in a bracket, over the moment as it
    ! would be unsaturated (law of Shen, Hedrick and Elkins, backwards), which is nearly linear.
    ! Where friction falls with slip the answer before the largest moment is taken.
    subroutine solve_for_axle_moment(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: turning
        type(axle_figures_t) :: figures
        real(wp) :: slip, before, left, left_before, fall, step, ends(2), ahead, largest
        integer :: i, k, solutions(2)

        result%wheel%n = 0
        result%wheel%solutions = 0
        call check_axle_moment(state, demand, status)
        if (is_error(status)) return
        turning = state
        ahead = sign(1.0_wp, state%speed)
        slip = 0.0_wp
        if (workspace%has_last) slip = slip_of(workspace%last_state, model%radius)
        ends = [-1.0_wp, 1.0_wp]
        solutions = 0
        largest = 0.0_wp
        before = slip
        left_before = 0.0_wp
        step = first_slip
        do i = 1, most_slips
            turning%pitch_rate = -state%speed/model%radius*(1.0_wp + slip)
            call solve_motion(model, workspace, turning, demand, result, status)
            if (is_error(status)) return
            solutions = solutions + result%wheel%solutions
            result%wheel%solutions = solutions
            figures = axle_figures(model, state, demand, result)
            if (abs(figures%moment - demand%axle_moment) <= near_moment*figures%bound) return
            if (.not. figures%bound > 0.0_wp) exit
            if ((figures%moment - largest)*sign(1.0_wp, demand%axle_moment) > 0.0_wp) &
                largest = figures%moment
            left = ahead*(unsaturated_share(figures%moment, figures%bound) &
                          - unsaturated_share(demand%axle_moment, figures%bound))
            k = merge(1, 2, left > 0.0_wp)
            ! Less than before farther on: the largest moment was passed.
            if (i > 1 .and. falls(model%case%friction) .and. &
                left*left_before > 0.0_wp .and. abs(left) > abs(left_before)) k = 3 - k
            ends(k) = slip
            if (ends(2) - ends(1) <= least_slip) exit
            if (i == 1) then
                fall = figures%fall
            else if ((left - left_before)*(slip - before) < 0.0_wp) then
                fall = (left_before - left)/(slip - before)
            else
                ! All slides: nothing tells how far.
                fall = 0.5_wp*fall
            end if
            before = slip
            left_before = left
            step = max(-longest_step*abs(step), min(left/fall, longest_step*abs(step)))
            slip = before + step
            if (i > most_secants) then
                slip = 0.5_wp*(ends(1) + ends(2))
            else if (slip <= ends(1) .or. slip >= ends(2)) then
                k = merge(1, 2, slip <= ends(1))
                slip = 0.5_wp*(ends(1) + ends(2))
                if (abs(ends(k)) >= 1.0_wp) slip = ends(k)
            end if
        end do
        if (abs(figures%moment - demand%axle_moment) <= jump_of_moment*figures%bound) return
        workspace%has_last = .false.
        result%wheel%n = 0
        call set_status(status, st_beyond_adhesion, 'the moment about the axle must not be above ' &
                        // 'what adhesion carries, ' // trim(number_text(largest)) // &
                        ' N mm, got ' // trim(number_text(demand%axle_moment)) // ' N mm')
    end subroutine solve_for_axle_moment

    ! Refuse a moment that no pitch rate is found for.
    pure subroutine check_axle_moment(state, demand, status)
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(status_t), intent(out) :: status

        call check_state(state, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(demand%axle_moment)) then
            call set_status(status, st_bad_argument, 'the moment about the axle must be a ' // &
                            'finite number, got ' // number_text(demand%axle_moment))
        else if (state%pitch_rate /= pure_rolling) then
            call set_status(status, st_bad_argument, 'the pitch rate must not be given with a ' // &
                            'moment about the axle, which it follows from, got ' // &
                            number_text(state%pitch_rate))
        else if (demand%kind == demand_rest) then
            call set_status(status, st_bad_argument, 'a moment about the axle must not be given ' &
                            // 'at rest, where there are no friction forces')
        else if (.not. abs(state%speed) > 0.0_wp) then
            call set_status(status, st_bad_argument, 'a speed other than 0 must be given with a ' &
                            // 'moment about the axle, got ' // number_text(state%speed))
        end if
    end subroutine check_axle_moment

    ! By what the wheels' surface is faster than the wheelset, over its speed; 0 far from rolling.
    pure real(wp) function slip_of(state, radius)
        type(wheelset_state_t), intent(in) :: state ! of a solution
        real(wp), intent(in) :: radius              ! mean of the nominal ones, mm

        slip_of = 0.0_wp
        if (abs(state%speed) > 0.0_wp) slip_of = -state%pitch_rate*radius/state%speed - 1.0_wp
        if (abs(slip_of) >= 0.5_wp) slip_of = 0.0_wp
    end function slip_of

    pure type(axle_figures_t) function axle_figures(model, state, demand, result) result(figures)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(in) :: result

        type(wheelset_state_t) :: turned
        type(wheelset_axes_t) :: axes
        integer :: side, i

        turned = state
        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            turned%roll = result%wheel(side)%roll
            axes = wheelset_axes(turned, model%radius)
            figures%moment = figures%moment + dot_product(result%wheel(side)%moment, axes%axle)
            do i = 1, result%wheel(side)%n
                associate (contact => result%wheel(side)%contact(i), &
                           normal => result%wheel(side)%contact(i)%figures%normal)
                    figures%bound = figures%bound + contact%radius*normal%load &
                                    *friction_at_angle(model%case%friction, model%case%mu, &
                                                       contact%angle)
                    figures%fall = figures%fall + contact%radius*normal%area &
                                   *combined_shear_modulus(model%case%material)
                end associate
            end do
        end do
        if (figures%bound > 0.0_wp) figures%fall = max(figures%fall/figures%bound, least_fall)
    end function axle_figures

    ! A moment over its bound as it would be without saturation; linear beyond the bound.
    pure real(wp) function unsaturated_share(moment, bound) result(share)
        real(wp), intent(in) :: moment, bound ! N mm

        real(wp) :: f

        f = min(abs(moment/bound), 1.0_wp)
        share = sign(3.0_wp*(1.0_wp - (1.0_wp - f)**(1.0_wp/3.0_wp)) + abs(moment/bound) - f, &
                     moment)
    end function unsaturated_share

    ! The contacts at a pitch rate that is said.
    subroutine solve_motion(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(environment_t) :: environment
        type(wheelset_state_t) :: moving
        type(wheelset_demand_t) :: prescribed
        integer :: side

        result%wheel%n = 0
        result%wheel%solutions = 0
        call check_damping(model%damping, model%speed_floor, status)
        if (is_error(status)) return
        if (any(model%case%given%is_given)) then
            call set_status(status, st_bad_argument, 'Fx and Fy of contacts cannot be given ' // &
                            'of a wheelset, whose motion gives their creepages')
            return
        end if
        if (model%case%curved .and. associated(model%lookup)) then
            call set_status(status, st_bad_argument, 'a lookup table has no contacts on a ' // &
                            'curved surface')
            return
        end if
        call check_demand(state, demand, status)
        call check_on_rollers(model, state, status)
        if (is_error(status)) return
        call check_workspace(model, workspace, status)
        if (is_error(status)) return
        call hold_environment(environment)
        moving = rolling_state(state, model%radius)
        prescribed = demand
        if (demand%kind == demand_rest) then
            moving = resting_state(state)
            prescribed%kind = demand_axle_load
            prescribed%roll_is_free = .true.
        end if
        result%pitch_rate = moving%pitch_rate
        workspace%is_reversed = moving%speed < moving%pitch_rate*model%radius
        call predict_heights(model, workspace, moving, prescribed)
        if (workspace%is_reversed) then
            call solve_checked(model, workspace, reversed_state(moving), prescribed, result, status)
            do side = side_right, side_left
                if (demand%wants(side)) call reverse_wheel(result%wheel(side))
            end do
            workspace%last_state = reversed_state(workspace%last_state)
        else
            call solve_checked(model, workspace, moving, prescribed, result, status)
        end if
        if (workspace%has_last) call remember_heights(model, workspace, moving, prescribed)
        call restore_environment(environment)
    end subroutine solve_motion

    ! A workspace that was reserved for another model, or not at all, is refused.
    subroutine check_workspace(model, workspace, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(in) :: workspace
        type(status_t), intent(inout) :: status

        integer :: side
        logical :: fits

        do side = side_right, side_left
            associate (wheel => workspace%wheel(side), pair => model%pair(side))
                fits = allocated(wheel%outline%x) .and. allocated(pair%y)
                if (fits) fits = size(wheel%outline%x) == size(pair%y) &
                                 .and. wheel%outline%mark == pair%mark
            end associate
            if (.not. fits) &
                call set_status(status, st_workspace_too_small, &
                                'no workspace was reserved for this wheelset')
        end do
    end subroutine check_workspace

    subroutine solve_checked(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(wheelset_state_t) :: found

        found = state
        if (.not. workspace%has_last) call start_afresh(workspace)
        if (needs_guide(model%case) .and. demand%kind /= demand_position) then
            call solve_guided(model, workspace, found, demand, result, status)
        else
            call solve_demand(model, workspace, found, demand, result, status)
        end if
        if (is_error(status)) then
            workspace%has_last = .false.
            result%wheel%n = 0
            return
        end if
        call complete(model, workspace, found, demand, result, status)
    end subroutine solve_checked

    subroutine solve_demand(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        select case (demand%kind)
        case (demand_position)
            call solve_at_position(model, workspace, state, demand, result, status)
        case (demand_loads)
            if (demand%roll_is_free) then
                state%roll = 0.0_wp
                if (workspace%has_last) state%roll = workspace%last_state%roll
                call solve_for_roll(model, workspace, state, demand, result, status)
            else
                call solve_loads(model, workspace, state, demand, result, status)
            end if
        case default
            if (demand%roll_is_free) then
                call solve_for_balance(model, workspace, state, demand, result, status)
            else
                call solve_for_height(model, workspace, state, demand, result, status)
            end if
        end select
    end subroutine solve_demand

    ! Strips find the height, the methods that were asked for take it.
    subroutine solve_guided(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(wheelset_state_t) :: start
        type(wheelset_demand_t) :: guide
        real(wp) :: share(2)
        integer :: round, side

        start = state
        guide = demand
        do round = 1, most_tries
            state = start
            ! What the other methods left in the workspaces is no start for strips.
            workspace%wheel%n = 0
            workspace%wheel%is_guided = .true.
            call clear_status(status)
            call solve_demand(model, workspace, state, guide, result, status)
            workspace%wheel%is_guided = .false.
            if (is_error(status)) return
            share = 1.0_wp
            do side = side_right, side_left
                if (.not. demand%wants(side) .or. result%wheel(side)%n == 0) cycle
                call try_height(model, workspace, state, side, result%wheel(side)%z, &
                                result%wheel(side))
                if (is_error(result%wheel(side)%status)) then
                    status = result%wheel(side)%status
                    return
                end if
                if (demand%kind == demand_loads) &
                    share(side) = demand%load(side)/result%wheel(side)%force(3)
            end do
            if (demand%kind == demand_axle_load) &
                share = demand%axle_load/sum(result%wheel%force(3))
            if (all(abs(share - 1.0_wp) <= near_load)) exit
            guide%load = guide%load*share
            guide%axle_load = guide%axle_load*share(1)
        end do
        if (round > most_tries) call set_status(status, st_target_missed, &
            'the vertical force is not the one asked for: it differs by a share of ' // &
            number_text(maxval(abs(share - 1.0_wp))))
    end subroutine solve_guided

    subroutine check_demand(state, demand, status)
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(status_t), intent(out) :: status

        integer :: side

        call check_state(state, status)
        if (is_error(status)) return
        if (.not. any(demand%wants)) then
            call set_status(status, st_bad_argument, 'a wheel must be asked for')
        else if (all(demand%kind /= [demand_position, demand_loads, demand_axle_load, &
                                     demand_rest])) then
            call set_status(status, st_bad_argument, 'the demand must be one of the four kinds')
        else if (demand%roll_is_free .and. (demand%kind == demand_position &
                                            .or. .not. all(demand%wants))) then
            call set_status(status, st_bad_argument, &
                            'roll is found of both wheels and their loads only')
        else if (demand%kind >= demand_axle_load .and. .not. all(demand%wants)) then
            call set_status(status, st_bad_argument, 'an axle load is that of both wheels')
        end if
        if (is_error(status)) return
        if (demand%kind >= demand_axle_load) call check_load(demand%axle_load)
        do side = side_right, side_left
            if (demand%kind == demand_loads .and. demand%wants(side)) &
                call check_load(demand%load(side))
        end do
        if (.not. ieee_is_finite(demand%roll_moment)) &
            call set_status(status, st_bad_argument, 'the roll moment must be a finite number, ' &
                            // 'got ' // number_text(demand%roll_moment))

    contains

        subroutine check_load(load)
            real(wp), intent(in) :: load
            logical :: valid

            if (is_error(status)) return
            valid = ieee_is_finite(load)
            if (valid) valid = load > 0.0_wp
            if (.not. valid) &
                call set_status(status, st_bad_argument, 'the vertical force must be above 0, ' &
                                // 'got ' // trim(number_text(load)) // ' N')
        end subroutine check_load
    end subroutine check_demand

    subroutine solve_at_position(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: touch, share
        integer :: side

        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            call try_table(model, state, side, state%z, result%wheel(side), share)
            if (share >= 1.0_wp) then
                workspace%wheel(side)%n = 0
                cycle
            end if
            call set_outline(model, workspace, state, side, touch, status)
            if (is_error(status)) return
            call try_height(model, workspace, state, side, state%z, result%wheel(side))
            if (is_error(result%wheel(side)%status)) then
                status = result%wheel(side)%status
                return
            end if
        end do
    end subroutine solve_at_position

    ! The height at which both wheels carry the axle load together, at a given roll.
    subroutine solve_for_height(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(approach_search_t) :: search
        real(wp) :: touch(2), approach, force
        integer :: side

        do side = side_right, side_left
            call set_outline(model, workspace, state, side, touch(side), status)
            if (is_error(status)) return
        end do
        approach = usual_approach(0.5_wp*demand%axle_load)
        if (workspace%has_last) approach = max(approach, maxval(workspace%wheel%approach))
        call start_search(search, demand%axle_load, approach)
        do while (search%goes_on)
            force = 0.0_wp
            do side = side_right, side_left
                call try_height(model, workspace, state, side, minval(touch) + search%approach, &
                                result%wheel(side))
                if (is_error(result%wheel(side)%status)) then
                    status = result%wheel(side)%status
                    return
                end if
                force = force + result%wheel(side)%force(3)
            end do
            call take_force(search, force)
        end do
        if (.not. is_found(search)) call name_jump(search, status)
        if (is_error(status)) return
        do side = side_right, side_left
            if (search%approach /= search%best) &
                call try_height(model, workspace, state, side, minval(touch) + search%best, &
                                result%wheel(side))
            workspace%wheel(side)%approach = result%wheel(side)%z - touch(side)
        end do
    end subroutine solve_for_height

    ! Error estimates of all where the wheelset came to rest; left wheels out of the mirror.
    subroutine complete(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(status_t) :: jump
        integer :: side, i

        if (demand%kind == demand_axle_load .and. .not. demand%roll_is_free) then
            call estimate_loads(model, .true., workspace%wheel, result%wheel)
        else
            do side = side_right, side_left
                call estimate_loads(model, demand%kind /= demand_position, &
                                    workspace%wheel(side:side), result%wheel(side:side))
            end do
        end if
        ! A force that jumped over the load concerns every contact.
        jump = status
        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            associate (wheel => result%wheel(side))
                if (model%case%estimate .and. wheel%solutions > 0) &
                    call estimate_wheel(model, workspace%wheel(side), wheel)
                call add_load_errors(model%case%mu, wheel)
                if (.not. is_error(wheel%status)) call name_pressures(model%case%yield, wheel)
                wheel%roll = state%roll
                if (side == side_left) wheel%roll = -wheel%roll
                if (side == side_left) call mirror_wheel(wheel)
                state%z = wheel%z
                if (is_error(wheel%status)) then
                    status = wheel%status
                else if (jump%code /= 0) then
                    do i = 1, wheel%n
                        call join_limitations(wheel%contact(i)%status, jump)
                    end do
                    wheel%status = jump
                else if (status%code == 0) then
                    status = wheel%status
                end if
            end associate
        end do
        workspace%has_last = .not. is_error(status)
        workspace%last_state = state
    end subroutine complete
end module faststrip_wheelset_solve
