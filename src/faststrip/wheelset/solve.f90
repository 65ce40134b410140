!> A wheelset on a track: from its state to the forces of every contact.
!>
!> All contacts of a wheel share its height: each has the overlap along its own normal that follows
!> from it. The height is given, or it is that at which the vertical force of the contacts, normal
!> and friction forces together, is the one that was asked for; with both wheels under one axle load
!> the roll may be free, too.
module faststrip_wheelset_solve
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_no_contact, st_no_convergence, &
                                     st_target_missed
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: reserve_workspace
    use faststrip_geometry_contact_frame, only: reserve_frame_gap
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_overlap, only: lowest_height
    use faststrip_geometry_profile, only: profile_t
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_geometry_wheel_on_rail, only: make_wheel_on_rail, reserve_outline, &
                                                find_outline
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, mirrored_state, check_state, &
                                                 wheelset_axes
    use faststrip_normal_limitations, only: add_limitation
    use faststrip_wheelset_approach, only: approach_search_t, start_search, take_force, &
                                           is_found, is_near, usual_approach
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheel_result_t, wheel_workspace_t, wheelset_workspace_t, &
                                        side_right, side_left, demand_position, demand_loads, &
                                        demand_axle_load, most_contacts
    use faststrip_wheelset_wheel, only: solve_wheel_at, estimate_wheel, mirror_wheel
    implicit none
    private

    public :: make_wheelset, reserve_wheelset, solve_wheelset

    ! Tuned [1]: equilibrium of two wheels, of the load; of heights, of the radius. Origin: above
    ! the digits of a contact's solution.
    real(wp), parameter :: exact = 9.0e-11_wp
    ! Tuned [steps]. Origin: capacity; five are usual.
    integer, parameter :: most_steps = 80
    ! Given: Hertz' law of a point contact.
    real(wp), parameter :: hertz_power = 1.5_wp
    ! Tuned [1]: most by which an approach grows or shrinks in a step. Origin: safeguard.
    real(wp), parameter :: most_growth = 4.0_wp
    ! Tuned [1]: where no step gains any more, this part of the load may be missing. Origin: chosen:
    ! some digits of a contact's solution.
    real(wp), parameter :: near_enough = 1.0e-8_wp
    ! Tuned [1]: slopes are measured anew where more than this is left of what was missing. Origin:
    ! chosen: Broyden's method gains a digit in a step.
    real(wp), parameter :: least_progress = 0.5_wp
    ! Tuned [1]: of the approach, for measured slopes. Origin: chosen: far above the digits of a
    ! solution, far below the approach.
    real(wp), parameter :: difference = 1.0e-4_wp
    ! Tuned [steps]: halvings of a step. Origin: capacity.
    integer, parameter :: most_halvings = 8
    ! Tuned [rad]: step of the roll. Origin: safeguard.
    real(wp), parameter :: most_roll_step = 0.02_wp

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

    !> Allocate for a model; the only allocation.
    subroutine reserve_wheelset(workspace, model, status)
        type(wheelset_workspace_t), intent(inout) :: workspace !! sized
        type(wheelset_model_t), intent(in) :: model            !! made
        type(status_t), intent(out) :: status                  !! those of `reserve_workspace`

        integer :: side, i

        call clear_status(status)
        workspace%has_last = .false.
        do side = side_right, side_left
            associate (wheel => workspace%wheel(side), pair => model%pair(side))
                if (.not. allocated(pair%y)) then
                    call set_status(status, st_bad_argument, 'the wheelset must be made first')
                    return
                end if
                wheel%n = 0
                wheel%approach = 0.0_wp
                call reserve_frame_gap(wheel%gap, pair)
                call reserve_outline(wheel%outline, pair)
                if (.not. allocated(wheel%contact)) allocate (wheel%contact(most_contacts))
                do i = 1, most_contacts
                    call reserve_workspace(wheel%contact(i), model%case%methods, size(pair%y), &
                                           status)
                    if (is_error(status)) return
                end do
            end associate
        end do
    end subroutine reserve_wheelset

    !> The contacts of a wheelset and their forces.
    subroutine solve_wheelset(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! z and roll count where the demand
                                                               !! leaves them
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status
            !! `st_bad_argument`, `st_no_contact`, `st_no_convergence`, those of contacts

        type(wheelset_state_t) :: found

        result%wheel%n = 0
        result%wheel%solutions = 0
        call check_demand(state, demand, status)
        if (is_error(status)) return
        found = state
        if (.not. workspace%has_last) then
            ! What an earlier solution left behind must not count.
            workspace%wheel%n = 0
            workspace%wheel%approach = 0.0_wp
        end if
        select case (demand%kind)
        case (demand_position)
            call solve_at_position(model, workspace, found, demand, result, status)
        case (demand_loads)
            if (demand%roll_is_free) then
                call solve_for_roll(model, workspace, found, demand, result, status)
            else
                call solve_loads(model, workspace, found, demand, result, status)
            end if
        case default
            if (demand%roll_is_free) then
                call solve_for_balance(model, workspace, found, demand, result, status)
            else
                call solve_for_height(model, workspace, found, demand, result, status)
            end if
        end select
        if (is_error(status)) then
            workspace%has_last = .false.
            result%wheel%n = 0
            return
        end if
        call complete(model, workspace, found, demand, result, status)
    end subroutine solve_wheelset

    subroutine check_demand(state, demand, status)
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(status_t), intent(out) :: status

        integer :: side

        call check_state(state, status)
        if (is_error(status)) return
        if (state%speed < 0.0_wp) then
            call set_status(status, st_bad_argument, 'the speed must not be below 0 (turn the ' // &
                            'track round), got ' // trim(number_text(state%speed)) // ' mm/s')
        else if (.not. any(demand%wants)) then
            call set_status(status, st_bad_argument, 'a wheel must be asked for')
        else if (all(demand%kind /= [demand_position, demand_loads, demand_axle_load])) then
            call set_status(status, st_bad_argument, 'the demand must be one of the three kinds')
        else if (demand%roll_is_free .and. (demand%kind == demand_position &
                                            .or. .not. all(demand%wants))) then
            call set_status(status, st_bad_argument, &
                            'roll is found of both wheels and their loads only')
        else if (demand%kind == demand_axle_load .and. .not. all(demand%wants)) then
            call set_status(status, st_bad_argument, 'an axle load is that of both wheels')
        end if
        if (is_error(status)) return
        if (demand%kind == demand_axle_load) call check_load(demand%axle_load)
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

    ! The outline of a wheel, with z = 0, and at which z it first touches.
    subroutine set_outline(model, workspace, state, side, touch, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        integer, intent(in) :: side
        real(wp), intent(out) :: touch
        type(status_t), intent(inout) :: status

        type(wheelset_state_t) :: at_zero

        at_zero = as_right(state, side)
        at_zero%z = 0.0_wp
        associate (wheel => workspace%wheel(side))
            wheel%axes = wheelset_axes(at_zero, model%radius)
            call find_outline(model%pair(side), wheel%axes, 0.0_wp, wheel%outline)
            touch = lowest_height(wheel%outline)
        end associate
        if (touch >= huge(touch)) &
            call set_status(status, st_no_contact, 'wheel and rail do not overlap at y ' // &
                            trim(number_text(state%y)) // ' mm of the wheelset')
    end subroutine set_outline

    ! The state as a right wheel has it.
    pure type(wheelset_state_t) function as_right(state, side)
        type(wheelset_state_t), intent(in) :: state
        integer, intent(in) :: side

        as_right = state
        if (side == side_left) as_right = mirrored_state(state)
    end function as_right

    ! One wheel at a height, without estimates.
    subroutine try_height(model, workspace, state, side, z, wheel)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        integer, intent(in) :: side
        real(wp), intent(in) :: z
        type(wheel_result_t), intent(inout) :: wheel

        call solve_wheel_at(model, model%pair(side), workspace%wheel(side), &
                            as_right(state, side), z, wheel)
        wheel%z = z
    end subroutine try_height

    subroutine solve_at_position(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: touch
        integer :: side

        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            call set_outline(model, workspace, state, side, touch, status)
            if (is_error(status)) return
            workspace%wheel(side)%n = 0
            call try_height(model, workspace, state, side, state%z, result%wheel(side))
            if (is_error(result%wheel(side)%status)) then
                status = result%wheel(side)%status
                return
            end if
        end do
    end subroutine solve_at_position

    ! Each wheel with a height of its own.
    subroutine solve_loads(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(status_t) :: jumped
        integer :: side

        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            call clear_status(jumped)
            call solve_load(model, workspace, state, side, demand%load(side), &
                            result%wheel(side), jumped)
            if (jumped%code /= 0) status = jumped
            if (is_error(status)) return
        end do
    end subroutine solve_loads

    ! The height at which one wheel carries its load.
    subroutine solve_load(model, workspace, state, side, load, wheel, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        integer, intent(in) :: side
        real(wp), intent(in) :: load
        type(wheel_result_t), intent(inout) :: wheel
        type(status_t), intent(inout) :: status

        type(approach_search_t) :: search
        real(wp) :: touch
        logical :: is_warm

        call set_outline(model, workspace, state, side, touch, status)
        if (is_error(status)) return
        is_warm = workspace%has_last .and. workspace%wheel(side)%approach > 0.0_wp
        do
            if (is_warm) then
                call start_search(search, load, workspace%wheel(side)%approach)
            else
                workspace%wheel(side)%n = 0
                call start_search(search, load, usual_approach(load))
            end if
            do while (search%goes_on)
                call try_height(model, workspace, state, side, touch + search%approach, wheel)
                if (is_error(wheel%status)) exit
                call take_force(search, wheel%force(3))
            end do
            if (is_found(search) .or. .not. is_warm) exit
            ! Afresh, where the last solution leads nowhere.
            is_warm = .false.
        end do
        if (is_error(wheel%status)) then
            status = wheel%status
            return
        end if
        if (.not. is_found(search)) call name_jump(search, status)
        if (is_error(status)) return
        if (search%approach /= search%best) &
            call try_height(model, workspace, state, side, touch + search%best, wheel)
        workspace%wheel(side)%approach = search%best
        wheel%z = touch + search%best
    end subroutine solve_load

    ! A force that jumps over the load, as where a rough profile is answered now by strips, now by
    ! the lattice.
    subroutine name_jump(search, status)
        type(approach_search_t), intent(in) :: search
        type(status_t), intent(out) :: status

        if (is_near(search)) then
            call set_status(status, st_target_missed, 'the force jumps over the load; its ' // &
                            'vertical part misses it by ' // &
                            trim(number_text(search%misfit)) // ' of it')
        else
            call set_status(status, st_no_convergence, 'no height of the wheelset carries the ' // &
                            trim(number_text(search%load)) // ' N: the force jumps')
        end if
    end subroutine name_jump

    ! Both wheels with loads of their own, and the roll at which they have the same height.
    subroutine solve_for_roll(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: before, apart, apart_before, step
        integer :: i

        if (workspace%has_last) then
            state%roll = workspace%last_state%roll
        else
            state%roll = 0.0_wp
        end if
        step = 0.0_wp
        before = 0.0_wp
        apart_before = 0.0_wp
        do i = 1, most_steps
            call clear_status(status)
            call solve_loads(model, workspace, state, demand, result, status)
            if (is_error(status)) return
            workspace%has_last = .true.
            apart = result%wheel(side_right)%z - result%wheel(side_left)%z
            if (abs(apart) <= exact*model%radius) return
            ! The right wheel goes down with the roll, its height up by as much.
            step = 0.5_wp*apart/model%pair(side_right)%y_line
            if (i > 1) then
                if (abs(apart - apart_before) > 0.0_wp) &
                    step = -apart*(state%roll - before)/(apart - apart_before)
            end if
            before = state%roll
            apart_before = apart
            state%roll = state%roll + max(-most_roll_step, min(step, most_roll_step))
        end do
        call set_status(status, st_no_convergence, 'no roll was found at which both wheels touch')
    end subroutine solve_for_roll

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

    ! Height and roll at which both wheels carry the axle load, and its moment: Broyden's method
    ! from the stiffness of each wheel.
    subroutine solve_for_balance(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: touch(2), now(2), left(2), before(2), step(2), change(2), jacobian(2, 2), &
            scale(2), part
        logical :: gains, ends, is_measured
        integer :: i, j

        call start_balance(model, workspace, state, demand, touch, status)
        if (is_error(status)) return
        now = [state%z, state%roll]
        scale = demand%axle_load*[1.0_wp, model%pair(side_right)%y_line]
        call misfit(left)
        if (is_error(status)) return
        call first_jacobian()
        is_measured = .false.
        do i = 1, most_steps
            if (all(abs(left) <= exact*scale)) exit
            step = newton_step()
            part = min(1.0_wp, most_roll_step/max(abs(step(2)), tiny(1.0_wp)))
            before = left
            gains = .false.
            ! A wheel may come to carry much less in a step, but not nothing; and what is missing
            ! must not grow.
            do j = 1, most_halvings
                state%z = now(1) + part*step(1)
                state%roll = now(2) + part*step(2)
                if (touches_enough()) then
                    call misfit(left)
                    gains = missing(left) < missing(before)
                end if
                if (gains .or. is_error(status)) exit
                part = 0.5_wp*part
            end do
            if (is_error(status)) return
            if (gains) then
                step = part*step
                now = now + step
            else
                ! Back to where it was.
                left = before
            end if
            ! Digits of the solutions end there.
            ends = missing(left) <= near_enough .and. missing(left) > least_progress*missing(before)
            if (missing(left) > least_progress*missing(before)) then
                if (ends .or. is_measured .and. .not. gains) then
                    call solve_here()
                    exit
                end if
                ! The slopes are not those of the wheels alone: friction on a flange rolls, too.
                call measure_jacobian()
                if (is_error(status)) return
                is_measured = .true.
                cycle
            end if
            is_measured = .false.
            change = left - before - matmul(jacobian, step)
            ! In units of the roll's lever, so that both unknowns are lengths.
            associate (weighted => step*[1.0_wp, model%pair(side_right)%y_line**2])
                if (norm2(step) > 0.0_wp) then
                    do j = 1, 2
                        jacobian(:, j) = jacobian(:, j) &
                                         + change*weighted(j)/dot_product(step, weighted)
                    end do
                end if
            end associate
        end do
        if (is_error(status)) return
        if (missing(left) > near_enough) then
            call set_status(status, st_no_convergence, 'no height and roll carry the axle load ' &
                            // 'of ' // trim(number_text(demand%axle_load)) // ' N and the roll ' &
                            // 'moment: a wheel would lift')
            return
        end if
        do i = side_right, side_left
            workspace%wheel(i)%approach = state%z - touch(i)
        end do

    contains

        subroutine misfit(left)
            real(wp), intent(out) :: left(2)

            integer :: side

            left = [-demand%axle_load, -demand%roll_moment]
            do side = side_right, side_left
                call try_height(model, workspace, state, side, state%z, result%wheel(side))
                if (is_error(result%wheel(side)%status)) then
                    status = result%wheel(side)%status
                    return
                end if
                left(1) = left(1) + result%wheel(side)%force(3)
                left(2) = left(2) + merge(1.0_wp, -1.0_wp, side == side_right) &
                          *result%wheel(side)%moment(1)
            end do
        end subroutine misfit

        subroutine first_jacobian()
            real(wp) :: stiffness, lever
            integer :: side

            jacobian = 0.0_wp
            do side = side_right, side_left
                lever = model%pair(side)%y_line
                if (side == side_left) lever = -lever
                stiffness = hertz_power*max(result%wheel(side)%force(3), &
                                            exact*demand%axle_load)/(state%z - touch(side))
                jacobian(1, 1) = jacobian(1, 1) + stiffness
                jacobian(1, 2) = jacobian(1, 2) + stiffness*lever
                jacobian(2, 1) = jacobian(2, 1) + stiffness*lever
                jacobian(2, 2) = jacobian(2, 2) + stiffness*lever**2
            end do
        end subroutine first_jacobian

        ! The larger of what is missing of load and moment, of what is asked for.
        real(wp) function missing(left)
            real(wp), intent(in) :: left(2)

            missing = maxval(abs(left)/scale)
        end function missing

        ! Both wheels where the unknowns are now.
        subroutine solve_here()
            integer :: side

            state%z = now(1)
            state%roll = now(2)
            do side = side_right, side_left
                call set_outline(model, workspace, state, side, touch(side), status)
                if (is_error(status)) return
            end do
            call misfit(left)
        end subroutine solve_here

        ! The slopes by differences, about the last state, which is solved once more.
        subroutine measure_jacobian()
            real(wp) :: moved(2), here(2), length
            integer :: unknown

            here = left
            length = difference*minval(now(1) - touch)
            do unknown = 1, 2
                moved = 0.0_wp
                moved(unknown) = length
                if (unknown == 2) moved(2) = length/model%pair(side_right)%y_line
                now = now + moved
                call solve_here()
                now = now - moved
                if (is_error(status)) return
                jacobian(:, unknown) = (left - here)/moved(unknown)
            end do
            call solve_here()
        end subroutine measure_jacobian

        function newton_step() result(step)
            real(wp) :: step(2)

            real(wp) :: determinant

            determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
            step = -[jacobian(2, 2)*left(1) - jacobian(1, 2)*left(2), &
                     jacobian(1, 1)*left(2) - jacobian(2, 1)*left(1)]/determinant
        end function newton_step

        logical function touches_enough()
            real(wp) :: approach
            integer :: side

            touches_enough = .true.
            do side = side_right, side_left
                approach = now(1) - touch(side)
                call set_outline(model, workspace, state, side, touch(side), status)
                if (is_error(status)) return
                touches_enough = touches_enough .and. state%z - touch(side) &
                                 > approach/most_growth .and. state%z - touch(side) &
                                 < approach*most_growth
                touch(side) = now(1) - approach
            end do
            if (.not. touches_enough) return
            do side = side_right, side_left
                touch(side) = lowest_height(workspace%wheel(side)%outline)
            end do
        end function touches_enough
    end subroutine solve_for_balance

    ! A height and a roll at which both wheels overlap about as much as they should: first touch of
    ! both, then the usual approach.
    subroutine start_balance(model, workspace, state, demand, touch, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        real(wp), intent(out) :: touch(2)
        type(status_t), intent(inout) :: status

        real(wp) :: approach(2), apart, apart_before, before, step
        integer :: i, side

        state%roll = 0.0_wp
        approach = usual_approach(0.5_wp*demand%axle_load)
        if (workspace%has_last) then
            state%roll = workspace%last_state%roll
            where (workspace%wheel%approach > 0.0_wp) approach = workspace%wheel%approach
        else
            workspace%wheel%n = 0
        end if
        apart_before = 0.0_wp
        before = 0.0_wp
        do i = 1, most_steps
            do side = side_right, side_left
                call set_outline(model, workspace, state, side, touch(side), status)
                if (is_error(status)) return
            end do
            apart = touch(side_right) + approach(side_right) - touch(side_left) &
                    - approach(side_left)
            state%z = 0.5_wp*(sum(touch) + sum(approach))
            ! As near as a tenth of the approach is a start.
            if (abs(apart) <= 0.1_wp*minval(approach)) return
            step = 0.5_wp*apart/model%pair(side_right)%y_line
            if (i > 1) then
                if (abs(apart - apart_before) > 0.0_wp) &
                    step = -apart*(state%roll - before)/(apart - apart_before)
            end if
            before = state%roll
            apart_before = apart
            state%roll = state%roll + max(-most_roll_step, min(step, most_roll_step))
        end do
        call set_status(status, st_no_convergence, 'no roll was found at which both wheels touch')
    end subroutine start_balance

    ! How wrong all is where the wheelset came to rest; left wheels out of the mirror.
    subroutine complete(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(wheelset_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(status_t) :: jump
        integer :: side, i

        ! A force that jumped over the load concerns every contact.
        jump = status
        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            associate (wheel => result%wheel(side))
                if (model%case%estimate) &
                    call estimate_wheel(model, workspace%wheel(side), wheel)
                wheel%roll = state%roll
                if (side == side_left) wheel%roll = -wheel%roll
                if (side == side_left) call mirror_wheel(wheel)
                state%z = wheel%z
                if (is_error(wheel%status)) then
                    status = wheel%status
                else if (jump%code /= 0) then
                    do i = 1, wheel%n
                        call add_limitation(wheel%contact(i)%status, jump%code, jump%message)
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
