!> Derivatives of the forces of a wheel over position and velocity of the wheelset.
!>
!> At a solution strips start from where they are, with influence coefficients and factors that
!> serve to all digits: a neighbouring state costs its gap and a few steps. So derivatives are
!> differences between neighbours that are solved to the last digits, on one side, with the strips,
!> patches and contacts that the solution has; where a neighbour has others the one on the other
!> side is taken. Edges of strips stay, too: where they would follow the gap that is up to 1.4e-3 of
!> the largest of a column, else derivatives are within 1e-5. Over the rates pressures stay, and
!> only the creep forces are found again. Derivatives of a wheel that a table answers for are those
!> of the table between its nodes: it is asked for each neighbour. Where it hands over to strips
!> both are, also over the rates. Rails on springs follow the forces, at once.
module faststrip_wheelset_derivatives
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_no_convergence
    use faststrip_contact_derivatives, only: check_differentiable, creepage_step, &
                                             difference_step, finest
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, is_at_rest
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_wheelset_approach, only: find_spring_step
    use faststrip_wheelset_height, only: set_outline, try_height, try_table, as_right
    use faststrip_wheelset_predict, only: yaw_lever
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_result_t, wheel_result_t, side_right, side_left
    use faststrip_wheelset_wheel, only: move_wheel
    use faststrip_wheelset_wheel_flip, only: flip_wheel, other_way, other_side
    implicit none
    private

    public :: find_wheelset_derivatives

    ! Given: columns of derivatives.
    integer, parameter :: n_coordinates = 4, n_columns = 2*n_coordinates + 1
    ! Given: in which order they are looked at: the outline for z is that of the solution.
    integer, parameter :: order(n_coordinates) = [1, 3, 4, 2]
    ! Given: the state itself among its neighbours.
    integer, parameter :: here = 0
    ! Given: signs of columns in a mirror, and of a wheelset that rolls back.
    real(wp), parameter :: mirrored(n_columns) = [-1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp, &
                                                  1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], &
                           reversed(n_columns) = [1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, &
                                                  1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp]

contains

    !> Derivatives of the forces of each wheel on its rail, in the track, and of their moments about
    !> the wheelset's centre, at the last solution: rows Fx, Fy, Fz, N, Mx, My, Mz, N mm; columns y,
    !> z, mm, roll, yaw, rad, their rates, per s, and the pitch rate, rad/s. Strips are solved to
    !> the last digits on the way. Over the rates of a wheelset that is at rest, without a floor of
    !> the speed, derivatives are 0: it has no friction there; those of a wheel in the air are 0,
    !> too.
    subroutine find_wheelset_derivatives(model, workspace, wants, result, derivatives, status)
        type(wheelset_model_t), intent(in) :: model                !! made
        type(wheelset_workspace_t), intent(inout) :: workspace     !! of the solution
        logical, intent(in) :: wants(2)                            !! which wheels: right, left
        type(wheelset_result_t), intent(in) :: result              !! of the solution
        real(wp), intent(out) :: derivatives(6, 9, 2)
            !! of right and left wheel; 0 where not asked for, NaN where contacts come or go
        type(status_t), intent(out) :: status
            !! those of `check_differentiable`; `st_bad_argument`: no solution;
            !! `st_no_convergence`: contacts or patches of a wheel come or go at this state

        type(environment_t) :: environment
        type(status_t) :: ended
        type(wheel_result_t), allocatable :: near(:)
        integer :: side

        derivatives = 0.0_wp
        call check_differentiable(model%case, status)
        if (.not. workspace%has_last) &
            call set_status(status, st_bad_argument, 'there is no solution of the wheelset')
        if (is_error(status)) return
        call hold_environment(environment)
        ! Much for a stack; nothing is allocated.
        call move_alloc(workspace%near, near)
        do side = side_right, side_left
            if (.not. wants(side)) cycle
            if (result%wheel(side)%n == 0) cycle
            call clear_status(ended)
            call find_of_wheel(model, workspace, side, result%wheel(side), near(1), &
                               derivatives(:, :, side), ended)
            if (any(model%rail_stiffness > 0.0_wp) .and. .not. is_error(ended)) &
                call let_rail_follow(model%rail_stiffness, derivatives(:, :, side), ended)
            if (.not. is_error(ended)) cycle
            derivatives(:, :, side) = ieee_value(0.0_wp, ieee_quiet_nan)
            status = ended
        end do
        call move_alloc(near, workspace%near)
        call restore_environment(environment)
    end subroutine find_wheelset_derivatives

    ! A rail that goes with the force is for it a wheel that goes the other way.
    pure subroutine let_rail_follow(stiffness, derivatives, status)
        real(wp), intent(in) :: stiffness(2)
        real(wp), intent(inout) :: derivatives(:, :)
        type(status_t), intent(inout) :: status

        real(wp) :: over_place(6, 2), change(2)
        integer :: i
        logical :: singular

        over_place = derivatives(:, :2)
        do i = 1, n_columns
            call find_spring_step(over_place(2:3, :), stiffness, derivatives(2:3, i), change, &
                                  singular)
            if (singular) then
                call set_status(status, st_no_convergence, 'rails on springs have no balance here')
                return
            end if
            derivatives(:, i) = derivatives(:, i) - matmul(over_place, change)
        end do
    end subroutine let_rail_follow

    subroutine find_of_wheel(model, workspace, side, wheel, near, derivatives, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: side
        type(wheel_result_t), intent(in) :: wheel    ! of the solution
        type(wheel_result_t), intent(inout) :: near  ! of its neighbours
        real(wp), intent(inout) :: derivatives(:, :)
        type(status_t), intent(inout) :: status

        type(wheelset_state_t) :: state
        real(wp) :: step(n_columns), forces(6, n_coordinates), from(6), there(6), smallest
        integer :: i, j
        real(wp) :: share

        state = workspace%last_state
        state%z = wheel%z
        call try_table(model, workspace, neighbour(here), side, state%z, near, share)
        smallest = minval(wheel%contact(:wheel%n)%figures%normal%penetration)
        step(1:2) = difference_step(smallest)
        step(3) = step(1)/model%pair(side)%y_line
        step(4) = step(1)/yaw_lever
        step(5:6) = creepage_step*maxval(wheel%contact(:wheel%n)%speed)
        step(7:8) = step(5)/model%pair(side)%y_line
        step(9) = step(5)/model%radius
        ! To the side that is the same of a wheel in a mirror.
        if (side == side_left) step = step*mirrored
        if (workspace%is_reversed(side)) step = step*reversed
        do j = 1, n_coordinates
            i = order(j)
            call solve(i, .false., forces(:, i))
            if (.not. failed()) cycle
            ! What comes or goes there may not do so on the other side.
            call clear_status(status)
            step(i) = -step(i)
            call solve(i, .false., forces(:, i))
            if (failed()) exit
        end do
        ! The last outline was that for z.
        if (.not. failed()) call solve(here, .true., from)
        if (failed()) then
            if (share >= 1.0_wp) return
            ! The solution as it was.
            call solve(here, .false., from)
            call try_height(model, workspace, neighbour(here), side, state%z, near)
            return
        end if
        do i = 1, n_coordinates
            derivatives(:, i) = (forces(:, i) - from)/step(i)
        end do
        if (is_at_rest(state) .and. .not. model%speed_floor > 0.0_wp) return
        call turn_back(near)
        do i = n_coordinates + 1, n_columns
            call move_near(i, there)
            if (failed()) return
            derivatives(:, i) = (there - from)/step(i)
        end do
        ! What is asked of strips and elements is that of the solution.
        call move_near(here, there)

    contains

        ! A neighbour of the state, or the state, as it was solved.
        type(wheelset_state_t) function neighbour(i)
            integer, intent(in) :: i

            neighbour = state
            if (i /= here) call move(neighbour, i, step(i))
        end function neighbour

        ! A wheel between what was solved and what it is.
        subroutine turn_back(there)
            type(wheel_result_t), intent(inout) :: there

            if (workspace%is_reversed(side)) call flip_wheel(other_way, there)
            if (side == side_left) call flip_wheel(other_side, there)
        end subroutine turn_back

        subroutine solve(i, outlined, found)
            integer, intent(in) :: i        ! which neighbour
            logical, intent(in) :: outlined ! is the outline of the wheel that of the state?
            real(wp), intent(out) :: found(6)

            type(wheelset_state_t) :: there
            real(wp) :: touch
            real(wp) :: share_there

            there = neighbour(i)
            if (share >= 1.0_wp) then
                call try_table(model, workspace, there, side, there%z, near, share_there)
                if (share_there < 1.0_wp) &
                    call set_status(status, st_no_convergence, &
                                    'strips take over from the table at this state')
            else
                if (.not. outlined) call set_outline(model, workspace, there, side, touch, status)
                call try_height(model, workspace, there, side, there%z, near, finest)
            end if
            call turn_back(near)
            found = [near%force, near%moment]
        end subroutine solve

        ! The same pressures, moving otherwise; where a table has its share it is asked for the
        ! state.
        subroutine move_near(i, found)
            integer, intent(in) :: i
            real(wp), intent(out) :: found(6)

            if (share > 0.0_wp) then
                call solve(i, .true., found)
                return
            end if
            call move_wheel(model, model%pair(side), workspace%wheel(side), &
                            as_right(workspace, neighbour(i), side), state%z, near)
            call turn_back(near)
            found = [near%force, near%moment]
            call turn_back(near)
        end subroutine move_near

        logical function failed()
            failed = is_error(near%status) .or. is_error(status)
            if (is_error(near%status)) status = near%status
        end function failed
    end subroutine find_of_wheel

    ! Let the i-th coordinate or rate of a state be larger by a step.
    pure subroutine move(state, i, step)
        type(wheelset_state_t), intent(inout) :: state
        integer, intent(in) :: i
        real(wp), intent(in) :: step

        real(wp) :: change(n_columns)

        change = 0.0_wp
        change(i) = step
        associate (rate => change(n_coordinates + 1:))
            state%y = state%y + change(1)
            state%z = state%z + change(2)
            state%roll = state%roll + change(3)
            state%yaw = state%yaw + change(4)
            state%y_rate = state%y_rate + rate(1)
            state%z_rate = state%z_rate + rate(2)
            state%roll_rate = state%roll_rate + rate(3)
            state%yaw_rate = state%yaw_rate + rate(4)
            state%pitch_rate = state%pitch_rate + change(n_columns)
        end associate
    end subroutine move
end module faststrip_wheelset_derivatives
