!> What a state of a wheelset has that is outside of all practice: mostly a unit. Nothing is refused
!> here, and no figure changes.
module faststrip_wheelset_plausible
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: quantities, of_load, of_turn, of_speed, of_pitch, &
                                        of_shift, of_curve
    use faststrip_contact_plausible, only: doubts_t, add_doubt
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, pure_rolling
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, demand_loads, &
                                        demand_axle_load
    implicit none
    private

    public :: find_state_doubts, state_names_t

    !> What the caller calls the numbers of a state.
    type :: state_names_t
        character(len=24) :: y = 'y'
        character(len=24) :: roll = 'roll'
        character(len=24) :: yaw = 'yaw'
        character(len=24) :: speed = 'speed'
        character(len=24) :: pitch_rate = 'pitch_rate'
        character(len=24) :: curve = '1/curvature'
        character(len=24) :: load = 'load'
    end type state_names_t

contains

    !> All that is outside of practice in a state and in what is prescribed with it.
    pure subroutine find_state_doubts(model, state, demand, names, doubts)
        type(wheelset_model_t), intent(in) :: model   !! its mean radius counts
        type(wheelset_state_t), intent(in) :: state   !! checked or not
        type(wheelset_demand_t), intent(in) :: demand !! loads
        type(state_names_t), intent(in) :: names      !! what the caller calls the numbers
        type(doubts_t), intent(inout) :: doubts       !! more of them

        integer :: i

        call add_doubt(doubts, of_shift, names%y, state%y)
        call add_doubt(doubts, of_turn, names%roll, state%roll)
        call add_doubt(doubts, of_turn, names%yaw, state%yaw)
        call add_doubt(doubts, of_speed, names%speed, state%speed)
        ! Where a vehicle starts or stops wheels spin or stand.
        if (abs(state%speed) >= quantities(of_speed)%least .and. model%radius > 0.0_wp &
            .and. state%pitch_rate /= pure_rolling) &
            call add_doubt(doubts, of_pitch, names%pitch_rate, &
                           state%pitch_rate*model%radius/state%speed, &
                           behind=' times the radius over the speed')
        if (abs(state%curvature) > 0.0_wp) &
            call add_doubt(doubts, of_curve, names%curve, 1.0_wp/state%curvature)
        if (demand%kind >= demand_axle_load) then
            if (demand%axle_load > 0.0_wp) &
                call add_doubt(doubts, of_load, names%load, demand%axle_load, model%radius)
        else if (demand%kind == demand_loads) then
            do i = 1, size(demand%load)
                if (demand%wants(i) .and. demand%load(i) > 0.0_wp) &
                    call add_doubt(doubts, of_load, names%load, demand%load(i), model%radius)
            end do
        end if
    end subroutine find_state_doubts
end module faststrip_wheelset_plausible
