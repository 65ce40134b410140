!> The contacts of a wheelset whose pitch rate is said, or is that at which they carry a moment
!> about the axle.
module faststrip_wheelset_solve_axle_moment
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_friction, only: friction_at_angle, falls
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: combined_shear_modulus
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, st_bad_argument, &
                                     st_beyond_adhesion
    use faststrip_contact_given_forces, only: jump_of_force
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, check_state, pure_rolling, &
                                                 wheelset_axes_t, wheelset_axes
    use faststrip_wheelset_solve_motion, only: solve_motion
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t, side_right, side_left, demand_rest
    implicit none
    private

    public :: solve_on_rails

    ! Tuned [1]: of a moment about the axle, over mu N r: it is found. Origin: chosen: the pitch
    ! rate to 1e-6 up to .999 of it.
    real(wp), parameter :: near_moment = 1.0e-6_wp
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

    !> What contacts carry about the axle.
    type :: axle_figures_t
        real(wp) :: moment = 0.0_wp ! N mm
        real(wp) :: bound = 0.0_wp  ! mu N r, N mm
        real(wp) :: fall = 0.0_wp   ! of the linear moment over the bound with slip, nearly
    end type axle_figures_t

contains

    !> The contacts on rails that stay where they are.
    subroutine solve_on_rails(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! pitch rate: without a moment
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status                  !! those of `solve_wheelset`

        if (demand%axle_moment_is_given) then
            call solve_for_axle_moment(model, workspace, state, demand, result, status)
        else
            call solve_motion(model, workspace, state, demand, result, status)
        end if
    end subroutine solve_on_rails

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
        if (abs(figures%moment - demand%axle_moment) <= jump_of_force*figures%bound) return
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
end module faststrip_wheelset_solve_axle_moment
