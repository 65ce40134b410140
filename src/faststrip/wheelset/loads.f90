!> Wheels that each carry a load of their own: the height of each, and the roll at which they have
!> the same.
module faststrip_wheelset_loads
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_convergence, st_target_missed
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_approach, only: approach_search_t, start_search, take_force, &
                                           is_found, is_near, usual_approach, equilibrium, &
                                           near_enough, warm_enough, hertz_power, roll_search_t, &
                                           next_roll
    use faststrip_wheelset_height, only: set_outline, try_height, as_right, wheel_sums_t, &
                                         sums_of, hand_over
    use faststrip_wheelset_lookup, only: look_up_at_load
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheel_result_t, wheel_workspace_t, wheelset_workspace_t, &
                                        path_t, side_right, side_left
    implicit none
    private

    public :: start_afresh, solve_loads, solve_for_roll, name_jump, equal_at_jump

    !> What may be missing of equal heights, in mm, and of moments, over the load at its lever,
    !> where the force of a wheel jumps over its load.
    !> Tuned [mm, 1]. Origin: chosen: a hundredth of a usual approach, less than most such jumps;
    !> the height at a jump hangs on how it was reached.
    real(wp), parameter :: equal_at_jump = 1.0e-3_wp

contains

    !> What an earlier solution left behind counts no more.
    pure subroutine start_afresh(workspace)
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved

        workspace%has_last = .false.
        call forget_strips(workspace%wheel)
        workspace%stiffness = 0.0_wp
        workspace%path = path_t()
    end subroutine start_afresh

    elemental subroutine forget_strips(workspace)
        type(wheel_workspace_t), intent(inout) :: workspace

        workspace%n = 0
        workspace%approach = 0.0_wp
        workspace%slope = 0.0_wp
    end subroutine forget_strips

    !> Each wheel with a height of its own.
    subroutine solve_loads(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! its z does not count, mm, rad
        type(wheelset_demand_t), intent(in) :: demand          !! loads; 0: just touch, N
        type(wheelset_result_t), intent(inout) :: result       !! left in a mirror
        type(status_t), intent(inout) :: status
            !! `st_no_contact`, `st_no_convergence`, `st_target_missed`, those of contacts

        type(status_t) :: jumped
        integer :: side

        do side = side_right, side_left
            if (.not. demand%wants(side)) cycle
            call clear_status(jumped)
            call solve_load(model, workspace, state, side, demand, result%wheel(side), jumped)
            if (jumped%code /= 0) status = jumped
            if (is_error(status)) return
        end do
    end subroutine solve_loads

    ! The height at which one wheel carries its load.
    subroutine solve_load(model, workspace, state, side, demand, wheel, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        integer, intent(in) :: side
        type(wheelset_demand_t), intent(in) :: demand
        type(wheel_result_t), intent(inout) :: wheel
        type(status_t), intent(inout) :: status

        type(approach_search_t) :: search
        type(wheel_sums_t) :: sums
        real(wp) :: touch, load, share, height, tolerance
        logical :: is_warm

        share = 0.0_wp
        load = demand%load(side)
        if (associated(model%lookup) .and. load > 0.0_wp) then
            call look_up_at_load(model, model%pair(side), as_right(workspace, state, side), load, &
                                 wheel, share)
            if (share >= 1.0_wp) then
                call forget_strips(workspace%wheel(side))
                return
            else if (share > 0.0_wp) then
                sums = sums_of(wheel)
                height = wheel%z
            end if
        end if
        call set_outline(model, workspace, state, side, touch, status)
        if (is_error(status)) return
        if (.not. load > 0.0_wp) then
            call lift_wheel(workspace%wheel(side), touch, wheel)
            return
        end if
        is_warm = workspace%has_last .and. workspace%wheel(side)%approach > 0.0_wp
        do
            if (is_warm) then
                ! A roll that is searched for asks for more digits, and rails on springs, which
                ! follow the forces.
                tolerance = warm_enough
                if (demand%roll_is_free .or. any(model%rail_stiffness > 0.0_wp)) &
                    tolerance = near_enough
                call start_search(search, load, workspace%wheel(side)%approach, &
                                  max(demand%tolerance, tolerance), demand%bracket, &
                                  workspace%wheel(side)%slope)
            else
                workspace%wheel(side)%n = 0
                call start_search(search, load, usual_approach(load), demand%tolerance, &
                                  demand%bracket)
            end if
            do while (search%goes_on)
                call try_height(model, workspace, state, side, touch + search%approach, wheel, &
                                by_strips=.true.)
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
            call try_height(model, workspace, state, side, touch + search%best, wheel, &
                            by_strips=.true.)
        ! What is left of the load is left of the height, too.
        if (is_found(search) .and. search%slope > 0.0_wp) search%best = search%best &
            + (1.0_wp - (wheel%force(3)/load)**(1.0_wp/hertz_power))/search%slope
        workspace%wheel(side)%approach = search%best
        workspace%wheel(side)%slope = search%slope
        wheel%z = touch + search%best
        if (.not. share > 0.0_wp) return
        wheel%z = wheel%z + share*(height - wheel%z)
        call hand_over(sums, share, wheel)
    end subroutine solve_load

    ! A wheel that just touches carries nothing.
    pure subroutine lift_wheel(workspace, touch, wheel)
        type(wheel_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: touch
        type(wheel_result_t), intent(inout) :: wheel

        call forget_strips(workspace)
        call clear_status(wheel%status)
        wheel%n = 0
        wheel%force = 0.0_wp
        wheel%force_wheelset = 0.0_wp
        wheel%moment = 0.0_wp
        wheel%z = touch
    end subroutine lift_wheel

    !> A force that jumps over the load, as where a rough profile is answered now by strips, now by
    !> fixed cells.
    subroutine name_jump(search, status)
        type(approach_search_t), intent(in) :: search !! that found no load
        type(status_t), intent(out) :: status         !! `st_target_missed`, `st_no_convergence`

        if (is_near(search)) then
            call set_status(status, st_target_missed, 'the force jumps over the load; its ' // &
                            'vertical part misses it by ' // &
                            trim(number_text(search%misfit)) // ' of it')
        else
            call set_status(status, st_no_convergence, 'no height of the wheelset carries the ' // &
                            trim(number_text(search%load)) // ' N: the force jumps')
        end if
    end subroutine name_jump

    !> Both wheels with loads of their own, and the roll at which they have the same height.
    subroutine solve_for_roll(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(inout) :: state         !! gets the roll; from its own, rad
        type(wheelset_demand_t), intent(in) :: demand          !! loads; 0: just touch, N
        type(wheelset_result_t), intent(inout) :: result       !! left in a mirror
        type(status_t), intent(inout) :: status                !! as `solve_loads`

        type(roll_search_t) :: search
        real(wp) :: apart
        integer :: i

        do i = 1, most_steps
            call clear_status(status)
            call solve_loads(model, workspace, state, demand, result, status)
            if (is_error(status)) return
            workspace%has_last = .true.
            workspace%last_state = state
            apart = result%wheel(side_right)%z - result%wheel(side_left)%z
            if (abs(apart) <= equilibrium*model%radius) return
            if (status%code == st_target_missed .and. abs(apart) <= equal_at_jump) return
            call next_roll(search, apart, model%pair(side_right)%y_line, state%roll)
        end do
        call set_status(status, st_no_convergence, 'no roll was found at which both wheels touch')
    end subroutine solve_for_roll
end module faststrip_wheelset_loads
