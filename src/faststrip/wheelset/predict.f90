!> Where the last two solutions for loads lead to: a start of the next one.
!>
!> A vehicle's states follow each other: what the heights did over the last motion they go on with
!> over the part of the next one that goes the same way. Approaches count over the load to 2/3,
!> which Hertz' law makes equal.
module faststrip_wheelset_predict
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_approach, only: hertz_power
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, wheelset_demand_t, &
                                        side_right, side_left, demand_position, demand_loads
    implicit none
    private

    public :: predict_heights, remember_heights, yaw_lever

    !> What a rad of yaw moves a contact by.
    !> Tuned [mm]. Origin: chosen: some millimetres on a tread, 20 on a flange; of steps of
    !> differences measured: with 40 rounding of heights counts.
    real(wp), parameter :: yaw_lever = 10.0_wp
    ! Tuned [1]: a motion that is longer, over the last one, tells nothing. Origin: chosen.
    real(wp), parameter :: longest = 4.0_wp

contains

    !> Start heights, and the roll if it is to be found, from where they are led to.
    pure subroutine predict_heights(model, workspace, state, demand)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! its approaches and last roll
        type(wheelset_state_t), intent(in) :: state            !! to be solved, mm, rad
        type(wheelset_demand_t), intent(in) :: demand          !! of loads, N

        real(wp) :: motion(4), ahead(3), roots(2), share
        integer :: side

        if (demand%kind == demand_position .or. .not. workspace%has_last) return
        associate (path => workspace%path)
            motion = place_of(model, state, demand) - path%place
            share = 0.0_wp
            if (norm2(path%motion) > 0.0_wp) &
                share = dot_product(motion, path%motion)/dot_product(path%motion, path%motion)
            if (abs(share) > longest) share = 0.0_wp
            ahead = path%found + share*path%change
            roots = load_roots(demand)
            do side = side_right, side_left
                ! By no more than half.
                if (roots(side) > 0.0_wp .and. path%found(side) > 0.0_wp &
                    .and. abs(ahead(side) - path%found(side)) < 0.5_wp*path%found(side)) &
                    workspace%wheel(side)%approach = ahead(side)*roots(side)
            end do
            if (demand%roll_is_free .and. path%found(side_right) > 0.0_wp) &
                workspace%last_state%roll = ahead(3)
        end associate
    end subroutine predict_heights

    !> Remember what was found, and over which motion it has changed.
    pure subroutine remember_heights(model, workspace, state, demand)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! solved
        type(wheelset_state_t), intent(in) :: state            !! as it was asked for, mm, rad
        type(wheelset_demand_t), intent(in) :: demand          !! N

        real(wp) :: found(3), motion(4), roots(2)
        integer :: side

        if (demand%kind == demand_position) return
        associate (path => workspace%path)
            roots = load_roots(demand)
            found = [0.0_wp, 0.0_wp, workspace%last_state%roll]
            do side = side_right, side_left
                if (roots(side) > 0.0_wp) found(side) = workspace%wheel(side)%approach/roots(side)
            end do
            motion = place_of(model, state, demand) - path%place
            ! The same state again tells nothing new.
            if (norm2(motion) > 0.0_wp) then
                path%motion = motion
                path%change = found - path%found
                if (.not. all(path%found(:2) > 0.0_wp)) path%change = 0.0_wp
            end if
            path%place = path%place + motion
            path%found = found
        end associate
    end subroutine remember_heights

    ! What moves contacts: y of each rail below the wheelset, yaw, and a roll that is given, as
    ! lengths.
    pure function place_of(model, state, demand) result(place)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        real(wp) :: place(4)

        place = [state%y - state%rail%y, yaw_lever*state%yaw, 0.0_wp]
        if (.not. demand%roll_is_free) place(4) = model%pair(side_right)%y_line*state%roll
    end function place_of

    ! Loads of both wheels to 2/3; 0 of one that is not asked for.
    pure function load_roots(demand) result(roots)
        type(wheelset_demand_t), intent(in) :: demand
        real(wp) :: roots(2)

        roots = 0.5_wp*demand%axle_load
        if (demand%kind == demand_loads) roots = demand%load
        roots = merge(max(roots, 0.0_wp)**(1.0_wp/hertz_power), 0.0_wp, demand%wants)
    end function load_roots
end module faststrip_wheelset_predict
