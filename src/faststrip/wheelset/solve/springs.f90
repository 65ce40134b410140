!> A wheelset on rails without mass that give way on springs.
module faststrip_wheelset_solve_springs
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_no_convergence, &
                                     st_no_contact
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_approach, only: usual_approach, near_enough, spring_share, &
                                           find_spring_step, hertz_power
    use faststrip_wheelset_height, only: set_outline
    use faststrip_wheelset_model, only: check_workspace
    use faststrip_wheelset_solve_axle_moment, only: solve_on_rails
    use faststrip_wheelset_solve_motion, only: check_demand
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, side_right, side_left, &
                                        demand_position, demand_loads, demand_axle_load, &
                                        demand_rest
    implicit none
    private

    public :: solve_on_springs

    ! Given: y and z of both rails.
    integer, parameter :: n_directions = 4
    ! Tuned [solutions]: of a wheelset, until they are in balance; in a quarter of them steps that
    ! leave more than before are taken back. Origin: safeguard: three to six are taken, on rails
    ! that go to the side by millimetres up to 60; of 250 loads on springs at random 249 are found
    ! again by their height.
    integer, parameter :: most_deflections = 90
    ! Tuned [solutions]: the same from the last solution, before it is forgotten. Origin: chosen:
    ! twice what is taken; one that leads nowhere took 46 s, where afresh it is 0.1 s.
    integer, parameter :: most_warm = 12

contains

    !> Rails without mass on springs: each is displaced by u beside where the state has it, with
    !> K u = F, F the force of its wheel. Where the last solution leads nowhere, afresh; where rails
    !> that are not yet displaced carry no axle load, from where half of it on each puts them.
    subroutine solve_on_springs(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! rails where they are unloaded
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status                  !! those of `solve_wheelset`

        type(wheelset_demand_t) :: halves
        type(status_t) :: other
        integer :: solutions(2)
        logical :: was_warm

        was_warm = workspace%has_last
        call find_deflection(model, workspace, state, demand, &
                             merge(most_warm, most_deflections, was_warm), result, status)
        if (.not. is_lost(status)) return
        solutions = result%wheel%solutions
        if (was_warm) then
            workspace%has_last = .false.
            workspace%wheel%steps = 0
            call find_deflection(model, workspace, state, demand, most_deflections, result, status)
            solutions = solutions + result%wheel%solutions
        end if
        if (is_lost(status) .and. (demand%kind == demand_rest .or. demand%roll_is_free) &
            .and. demand%kind /= demand_loads) then
            halves = demand
            halves%kind = demand_loads
            halves%roll_is_free = .true.
            halves%load = 0.5_wp*demand%axle_load
            workspace%has_last = .false.
            call find_deflection(model, workspace, state, halves, most_deflections, result, other)
            solutions = solutions + result%wheel%solutions
            if (.not. is_error(other)) then
                call find_deflection(model, workspace, state, demand, most_deflections, result, &
                                     status)
                solutions = solutions + result%wheel%solutions
            end if
        end if
        result%wheel%solutions = solutions
    end subroutine solve_on_springs

    ! Might another start have led to a solution?
    pure logical function is_lost(status)
        type(status_t), intent(in) :: status

        is_lost = any(status%code == [st_no_contact, st_no_convergence])
    end function is_lost

    ! Steps of Newton's method for both rails, from the stiffness of Hertz' law along the normal of
    ! each contact, corrected by what steps find (Broyden).
    subroutine find_deflection(model, workspace, state, demand, tries, result, status)
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand
        integer, intent(in) :: tries ! solutions of the wheelset at most
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
        do i = 1, tries
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
            if (all(abs(left) <= near_enough*norm2(force))) return
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
    end subroutine find_deflection

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
end module faststrip_wheelset_solve_springs
