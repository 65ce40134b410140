!> The contacts of a wheelset whose motion is said.
!>
!> Its height is given, or it is that at which the vertical force of the contacts, normal and
!> friction forces together, is the one that was asked for; with both wheels under one axle load the
!> roll may be free, too.
module faststrip_wheelset_solve_motion
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     join_limitations, number_text, st_bad_argument, &
                                     st_target_missed
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, check_state, rolls_back, &
                                                 rolling_state, resting_state
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_wheelset_approach, only: approach_search_t, start_search, take_force, is_found, &
                                           usual_approach, most_tries
    use faststrip_wheelset_balance, only: solve_for_balance
    use faststrip_wheelset_guide, only: needs_guide
    use faststrip_wheelset_height, only: set_outline, try_height, try_table, as_right
    use faststrip_wheelset_loads, only: start_afresh, solve_loads, solve_for_roll, name_jump
    use faststrip_wheelset_model, only: check_workspace, check_on_rollers, check_damping
    use faststrip_wheelset_predict, only: predict_heights, remember_heights
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, side_right, side_left, &
                                        demand_position, demand_loads, demand_axle_load, &
                                        demand_rest
    use faststrip_wheelset_wheel, only: estimate_wheel, name_pressures
    use faststrip_wheelset_wheel_flip, only: flip_wheel, other_way, other_side
    use faststrip_wheelset_wheel_neighbours, only: estimate_loads, add_load_errors
    implicit none
    private

    public :: solve_motion, check_demand

    ! Tuned [1]: of the load, how near a method comes whose height strips find. Origin: chosen: far
    ! below what methods differ by.
    real(wp), parameter :: near_load = 1.0e-4_wp

contains

    !> The contacts at a pitch rate that is said.
    subroutine solve_motion(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! motion of wheels and rails
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status                  !! those of `solve_wheelset`

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
        workspace%is_reversed = .false.
        do side = side_right, side_left
            workspace%is_reversed(side) = rolls_back(as_right(workspace, moving, side), &
                                                     model%pair(side)%y_line, &
                                                     model%pair(side)%radius)
        end do
        call predict_heights(model, workspace, moving, prescribed)
        call solve_checked(model, workspace, moving, prescribed, result, status)
        do side = side_right, side_left
            if (workspace%is_reversed(side) .and. demand%wants(side)) &
                call flip_wheel(other_way, result%wheel(side))
        end do
        if (workspace%has_last) call remember_heights(model, workspace, moving, prescribed)
        call restore_environment(environment)
    end subroutine solve_motion

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

    !> Refuse a state and a demand that have no answer.
    subroutine check_demand(state, demand, status)
        type(wheelset_state_t), intent(in) :: state   !! that is asked
        type(wheelset_demand_t), intent(in) :: demand !! what is prescribed of it
        type(status_t), intent(out) :: status         !! `st_bad_argument`

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
            call try_table(model, workspace, state, side, state%z, result%wheel(side), share)
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
                if (side == side_left) call flip_wheel(other_side, wheel)
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
end module faststrip_wheelset_solve_motion
