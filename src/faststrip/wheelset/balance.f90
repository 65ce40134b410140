!> Height and roll at which both wheels carry the axle load together, and the moment of the frame.
module faststrip_wheelset_balance
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_convergence, st_target_missed
    use faststrip_geometry_wheel_outline, only: lowest_height
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_approach, only: usual_approach, largest_jump, near_enough, &
                                           most_growth, equilibrium, most_tries, hertz_power, &
                                           roll_search_t, next_roll, most_roll_step
    use faststrip_wheelset_height, only: set_outline, try_height
    use faststrip_wheelset_loads, only: start_afresh
    use faststrip_wheelset_balance_share, only: solve_for_share
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, side_right, side_left
    implicit none
    private

    public :: solve_for_balance, name_missing

    ! Tuned [1]: slopes are measured anew where more than this is left of what was missing. Origin:
    ! chosen: Broyden's method gains a digit in a step.
    real(wp), parameter :: least_progress = 0.5_wp
    ! Of the approach, for measured slopes: half of the digits that forces have.
    real(wp), parameter :: difference = sqrt(near_enough)
    ! Tuned [1]: how far apart, of the approach, the wheels' heights may be at the start. Origin:
    ! chosen: loads differ by 15 %, and the steps that follow find the rest.
    real(wp), parameter :: start_apart = 0.1_wp

contains

    !> Height and roll at which both wheels carry the axle load, and its moment: from the last
    !> solution or from usual approaches; where that leads nowhere, from the share of each wheel.
    subroutine solve_for_balance(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(inout) :: state         !! gets z, mm, and roll, rad
        type(wheelset_demand_t), intent(in) :: demand          !! axle load, N, moment, N mm
        type(wheelset_result_t), intent(inout) :: result       !! of both wheels, left in a mirror
        type(status_t), intent(inout) :: status
            !! `st_no_contact`, `st_no_convergence`, those of contacts; `st_target_missed`: forces
            !! jump over the load

        type(wheelset_state_t) :: shared
        real(wp) :: missing
        logical :: was_warm

        do
            was_warm = workspace%has_last
            missing = huge(1.0_wp)
            call start_balance(model, workspace, state, demand, status)
            if (.not. is_error(status)) &
                call improve_balance(model, workspace, state, demand, most_steps, result, &
                                     missing, status)
            if (.not. is_error(status) .and. missing <= near_enough) return
            if (.not. was_warm) exit
            ! Afresh, where the last solution leads nowhere.
            call start_afresh(workspace)
            call clear_status(status)
        end do
        call clear_status(status)
        call solve_for_share(model, workspace, state, demand, result, status)
        if (is_error(status)) return
        call clear_status(status)
        shared = state
        call improve_balance(model, workspace, state, demand, most_steps, result, missing, status)
        if (.not. is_error(status) .and. missing <= near_enough) return
        ! Nothing is nearer than the shares.
        call clear_status(status)
        state = shared
        call improve_balance(model, workspace, state, demand, 0, result, missing, status)
        if (is_error(status)) return
        call name_missing(demand, missing, status)
    end subroutine solve_for_balance

    !> Where forces jump over the load, something of it is missing.
    subroutine name_missing(demand, missing, status)
        type(wheelset_demand_t), intent(in) :: demand !! axle load, N
        real(wp), intent(in) :: missing               !! of the load
        type(status_t), intent(inout) :: status       !! `st_target_missed`, `st_no_convergence`

        if (missing <= largest_jump) then
            call set_status(status, st_target_missed, 'the forces jump over the axle load and ' // &
                            'its moment; they miss them by ' // trim(number_text(missing)) // &
                            ' of the load')
        else
            call set_status(status, st_no_convergence, 'no height and roll carry the axle load ' &
                            // 'of ' // trim(number_text(demand%axle_load)) // ' N and the roll ' &
                            // 'moment: the forces jump')
        end if
    end subroutine name_missing

    ! From a state to one at which both wheels carry the load and its moment: Broyden's method from
    ! the stiffness of each wheel.
    subroutine improve_balance(model, workspace, state, demand, steps, result, still_missing, &
                               status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        integer, intent(in) :: steps
        type(wheelset_result_t), intent(inout) :: result
        real(wp), intent(out) :: still_missing ! of the load
        type(status_t), intent(inout) :: status

        real(wp) :: touch(2), now(2), left(2), before(2), step(2), change(2), jacobian(2, 2), &
            scale(2), part
        logical :: gains, ends, is_measured
        integer :: i, j

        still_missing = huge(1.0_wp)
        do i = side_right, side_left
            call set_outline(model, workspace, state, i, touch(i), status)
            if (is_error(status)) return
        end do
        now = [state%z, state%roll]
        scale = demand%axle_load*[1.0_wp, model%pair(side_right)%y_line]
        call misfit(left)
        if (is_error(status)) return
        jacobian = workspace%stiffness
        if (.not. jacobian(1, 1) > 0.0_wp) call first_jacobian()
        is_measured = .false.
        do i = 1, steps
            if (all(abs(left) <= merge(near_enough, equilibrium, workspace%has_last)*scale)) exit
            step = newton_step()
            part = min(1.0_wp, most_roll_step/max(abs(step(2)), tiny(1.0_wp)))
            before = left
            gains = .false.
            ! A wheel may come to carry much less in a step, but not nothing; and what is missing
            ! must not grow.
            do j = 1, most_tries
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
        still_missing = missing(left)
        workspace%stiffness = jacobian
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
                                            equilibrium*demand%axle_load)/(state%z - touch(side))
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
                call lowest_height(workspace%wheel(side)%outline, model%pair(side), touch(side))
            end do
        end function touches_enough
    end subroutine improve_balance

    ! A height and a roll at which both wheels overlap about as much as they should: first touch of
    ! both, then the usual approach.
    subroutine start_balance(model, workspace, state, demand, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(inout) :: state
        type(wheelset_demand_t), intent(in) :: demand
        type(status_t), intent(inout) :: status

        type(roll_search_t) :: search
        real(wp) :: touch(2), approach(2), apart
        integer :: i, side

        state%roll = 0.0_wp
        approach = usual_approach(0.5_wp*demand%axle_load)
        if (workspace%has_last) then
            state%roll = workspace%last_state%roll
            where (workspace%wheel%approach > 0.0_wp) approach = workspace%wheel%approach
        end if
        do i = 1, most_steps
            do side = side_right, side_left
                call set_outline(model, workspace, state, side, touch(side), status)
                if (is_error(status)) return
            end do
            apart = touch(side_right) + approach(side_right) - touch(side_left) &
                    - approach(side_left)
            state%z = 0.5_wp*(sum(touch) + sum(approach))
            if (abs(apart) <= start_apart*minval(approach)) return
            call next_roll(search, apart, model%pair(side_right)%y_line, state%roll)
        end do
        call set_status(status, st_no_convergence, 'no roll was found at which both wheels touch')
    end subroutine start_balance
end module faststrip_wheelset_balance
