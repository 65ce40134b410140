!> Derivatives of load and creep forces of a contact over penetration and creepages.
!>
!> Strips near a solution start from where they are, with its influence coefficients and factors:
!> a neighbour costs a few steps to the last digits. So derivatives are differences between such
!> neighbours, on one side: those of the strips and patches that were solved. Forces have kinks
!> where an element of the patch begins to slide, by some thousandths of their slope.
module faststrip_contact_derivatives
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_bad_argument
    use faststrip_contact_case, only: contact_case_t, given_forces_t
    use faststrip_contact_method, only: workspace_t, contact_result_t, normal_method_t, &
                                        tangential_method_t
    use faststrip_contact_methods, only: normal_auto, normal_table, tangential_table, &
                                         tangential_none, is_in_core
    use faststrip_contact_parts, only: check_methods, find_pressures, add_forces
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: find_contact_derivatives, stays_the_same, check_differentiable
    public :: creepage_step, difference_step, finest

    ! Tuned [1]: step over the penetration. Origin: forces bend by 1e-6 of their change over it, and
    ! rounding is 1e-12 of them.
    real(wp), parameter :: step_share = 4.0e-6_wp
    ! Tuned [mm]: smallest step. Origin: heights of a wheel have 1e-13 mm.
    real(wp), parameter :: least_step = 1.0e-8_wp
    !> Tuned [1]: step of a creepage. Origin: creep forces bend over a thousandth, else as above.
    real(wp), parameter :: creepage_step = 5.0e-9_wp
    !> Tuned [1]: of the strips' last step, for differences. Origin: rounding is some 1e-13.
    real(wp), parameter :: finest = 5.0e-12_wp

contains

    !> Derivatives at the last solution of a workspace: rows load, Fx, Fy, N, Mz, N mm; columns
    !> penetration, mm, cksi, ceta, cphi, rad/mm. Its strips are solved to the last digits on the
    !> way.
    subroutine find_contact_derivatives(workspace, case, result, derivatives, status)
        type(workspace_t), intent(inout) :: workspace   !! with a solution
        type(contact_case_t), intent(inout) :: case     !! that was solved; it is put back
        type(contact_result_t), intent(in) :: result    !! its figures
        real(wp), intent(out) :: derivatives(4, 4)      !! N, N mm over mm, -, -, rad/mm
        type(status_t), intent(out) :: status
            !! those of `check_differentiable`; `st_bad_argument`: no solution;
            !! `st_no_convergence`: patches or strips come or go at this penetration

        class(normal_method_t), pointer :: normal
        class(tangential_method_t), pointer :: tangential
        type(environment_t) :: environment
        type(contact_result_t) :: near
        type(demand_t) :: demand
        type(status_t) :: again
        type(creepage_t) :: creepage, solved
        type(given_forces_t) :: given
        real(wp) :: tolerance
        logical :: estimate

        derivatives = 0.0_wp
        call check_differentiable(case, status)
        if (is_error(status)) return
        if (workspace%solved_by == 0) then
            call set_status(status, st_bad_argument, 'there is no solution in the workspace')
            return
        end if
        call check_methods(workspace, case%methods, normal, tangential, status)
        if (is_error(status)) return
        call hold_environment(environment)
        demand = case%demand_t
        creepage = case%creepage
        given = case%given
        solved = creepage
        if (any(given%is_given)) solved = result%creepage
        case%creepage = solved
        case%given = given_forces_t()
        tolerance = case%strip_tolerance
        estimate = case%estimate
        case%estimate = .false.
        case%by_load = .false.
        case%stays = .true.
        case%strip_tolerance = finest
        call find_near(workspace, normal, tangential, result%normal%penetration, case, near, &
                       derivatives, status)
        if (is_error(status)) then
            ! The solution as it was.
            derivatives = 0.0_wp
            case%stays = .false.
            case%creepage = solved
            case%penetration = result%normal%penetration
            call find_pressures(workspace, case, normal, near, again)
            if (.not. is_error(again) .and. case%methods%tangential /= tangential_none) &
                call add_forces(workspace, case, tangential, near, again)
        end if
        case%demand_t = demand
        case%creepage = creepage
        case%given = given
        case%strip_tolerance = tolerance
        case%estimate = estimate
        case%stays = .false.
        call restore_environment(environment)
    end subroutine find_contact_derivatives

    subroutine find_near(workspace, normal, tangential, penetration, case, near, derivatives, &
                         status)
        type(workspace_t), intent(inout) :: workspace
        class(normal_method_t), intent(in) :: normal
        class(tangential_method_t), intent(in) :: tangential
        real(wp), intent(in) :: penetration ! of the solution, mm
        type(contact_case_t), intent(inout) :: case ! its demand and creepages change
        type(contact_result_t), intent(inout) :: near
        real(wp), intent(inout) :: derivatives(4, 4)
        type(status_t), intent(inout) :: status

        type(creepage_t) :: creepage
        real(wp) :: step, here(4), there(4)
        integer :: j, try

        creepage = case%creepage
        step = difference_step(penetration - workspace%solver%curve%h_lowest)
        do try = 1, 2
            call solve_at(penetration + step, there)
            if (.not. is_error(status)) exit
            ! What comes or goes there may not do so on the other side.
            if (try == 1) step = -step
        end do
        if (is_error(status)) return
        call solve_at(penetration, here)
        if (is_error(status)) return
        derivatives(:, 1) = (there - here)/step
        if (case%methods%tangential == tangential_none) return
        do j = 2, 4
            step = creepage_step
            case%creepage = creepage
            if (j == 4) step = step/sqrt(near%normal%area/pi)
            associate (now => case%creepage)
                if (j == 2) now%cksi = creepage%cksi + step
                if (j == 3) now%ceta = creepage%ceta + step
                if (j == 4) now%cphi = creepage%cphi + step
            end associate
            call add_forces(workspace, case, tangential, near, status)
            if (is_error(status)) return
            derivatives(:, j) = (forces_of(near) - here)/step
        end do
        ! What is asked of strips and elements is that of the solution.
        case%creepage = creepage
        call add_forces(workspace, case, tangential, near, status)

    contains

        subroutine solve_at(depth, forces)
            real(wp), intent(in) :: depth
            real(wp), intent(out) :: forces(4)

            case%penetration = depth
            call find_pressures(workspace, case, normal, near, status)
            if (.not. is_error(status) .and. case%methods%tangential /= tangential_none) &
                call add_forces(workspace, case, tangential, near, status)
            forces = forces_of(near)
        end subroutine solve_at
    end subroutine find_near

    pure function forces_of(result) result(forces)
        type(contact_result_t), intent(in) :: result
        real(wp) :: forces(4)

        forces = [result%normal%load, result%tangential%fx, result%tangential%fy, &
                  result%tangential%mz]
    end function forces_of

    !> The step of heights for differences, mm.
    pure real(wp) function difference_step(penetration) result(step)
        real(wp), intent(in) :: penetration !! above the lowest height, mm

        step = max(step_share*penetration, least_step)
    end function difference_step

    !> Are a contact's methods the same from state to state, and as exact as strips? Not auto, those
    !> outside the core, or a gap that is smoothed.
    pure logical function stays_the_same(case)
        type(contact_case_t), intent(in) :: case !! methods, smoothing

        stays_the_same = case%methods%normal /= normal_auto .and. .not. case%smoothing > 0.0_wp &
                         .and. is_in_core(normal_table, case%methods%normal) &
                         .and. is_in_core(tangential_table, case%methods%tangential)
    end function stays_the_same

    !> Refuse derivatives of methods that change from state to state.
    pure subroutine check_differentiable(case, status)
        type(contact_case_t), intent(in) :: case !! methods, smoothing
        type(status_t), intent(out) :: status    !! `st_bad_argument`

        call clear_status(status)
        if (.not. stays_the_same(case)) &
            call set_status(status, st_bad_argument, 'derivatives need methods that stay the ' // &
                            'same: not auto, references or a gap that is smoothed')
    end subroutine check_differentiable
end module faststrip_contact_derivatives
