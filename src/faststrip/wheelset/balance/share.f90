!> Which wheel carries how much of an axle load: the share at which the roll moment is the one asked
!> for.
!>
!> The moment grows with the load that the right wheel carries, nearly in proportion: by the lever
!> of both wheels. Where it is too small with all of the load on one wheel, and the other just
!> touching, that other wheel would lift.
module faststrip_wheelset_balance_share
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_convergence, st_target_missed
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_approach, only: most_tries, telling
    use faststrip_wheelset_loads, only: start_afresh, solve_for_roll, equal_at_jump
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, side_right, side_left, demand_loads
    implicit none
    private

    public :: solve_for_share

    ! A bracket of the share that is closed: over it a moment that does not jump changes by less
    ! than telling.
    real(wp), parameter :: least_bracket = 0.25_wp*telling

contains

    !> Loads of both wheels at which they carry the axle load and its moment together, and the roll
    !> at which they are equally high, cold.
    subroutine solve_for_share(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(inout) :: state         !! gets z, mm, and roll, rad
        type(wheelset_demand_t), intent(in) :: demand          !! axle load, N, moment, N mm
        type(wheelset_result_t), intent(inout) :: result       !! of both wheels, left in a mirror
        type(status_t), intent(inout) :: status
            !! `st_no_convergence`: a wheel would lift; those of `solve_for_roll`

        type(wheelset_demand_t) :: loads
        real(wp) :: more, next, low, high, slope, left, more_before, left_before, lever
        logical :: has_low, has_high
        integer :: i

        loads%kind = demand_loads
        lever = 0.5_wp*sum(model%pair%y_line)
        ! By how much the right wheel carries more than half of the load.
        high = 0.5_wp*demand%axle_load
        low = -high
        has_low = .false.
        has_high = .false.
        slope = 2.0_wp*lever
        more = max(low, min(demand%roll_moment/slope, high))
        state%roll = 0.0_wp
        call start_afresh(workspace)
        do i = 1, most_steps
            loads%load = 0.5_wp*demand%axle_load + [more, -more]
            call clear_status(status)
            call solve_for_roll(model, workspace, state, loads, result, status)
            if (is_error(status)) return
            state%z = 0.5_wp*sum(result%wheel%z)
            left = result%wheel(side_right)%moment(1) - result%wheel(side_left)%moment(1) &
                   - demand%roll_moment
            if (abs(left) <= demand%axle_load*lever &
                *merge(equal_at_jump, telling, status%code == st_target_missed)) return
            if (left < 0.0_wp) then
                low = more
                has_low = .true.
            else
                high = more
                has_high = .true.
            end if
            if (.not. high - low > least_bracket*demand%axle_load) exit
            if (i > 1) then
                if ((left - left_before)*(more - more_before) > 0.0_wp) &
                    slope = (left - left_before)/(more - more_before)
            end if
            more_before = more
            left_before = left
            next = more - left/slope
            if (has_low .and. has_high .and. (next <= low .or. next >= high &
                                              .or. i > most_tries)) next = 0.5_wp*(low + high)
            ! The ends themselves, too, until they are known.
            more = max(low, min(next, high))
        end do
        if (abs(more) < 0.5_wp*demand%axle_load) return
        call set_status(status, st_no_convergence, 'the ' // &
                        trim(merge('left ', 'right', more > 0.0_wp)) // ' wheel would lift: with ' &
                        // 'the axle load of ' // trim(number_text(demand%axle_load)) // ' N on ' &
                        // 'the other one alone the roll moment is not reached')
    end subroutine solve_for_share
end module faststrip_wheelset_balance_share
