!> Strips and patch ends solved together, from nearby.
!>
!> The ends of the patches join the unknowns of `faststrip_normal_strip_equations`, each moving
!> outwards in units of its end strip's width, and their equations are those of
!> `faststrip_normal_strip_ends`: the squared strip length, carried on, vanishes at the end. The
!> Jacobian of all (`faststrip_normal_strip_coupled_equations`) is factored once and serves, with
!> Broyden's updates (C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995,
!> chapter 7), until steps shrink too slowly. In scaled unknowns it hardly changes from one load to
!> the next: a warm start takes over the last one.
!>
!> Which strips there are stays fixed: where strips leave or steps do not shrink, the caller goes
!> back to passes that alternate between strips and ends.
module faststrip_normal_strip_coupled
    use faststrip_base_kinds, only: wp, pi
    use faststrip_numerics_lu, only: lu_solve
    use faststrip_normal_strip_equations, only: add_cost, mark_leaving_strips
    use faststrip_normal_strip_carried, only: carry, carries, carried_change, length_changes
    use faststrip_normal_strip_coupled_equations, only: coupled_residual, coupled_factors
    use faststrip_normal_strip_drift, only: lead, learn
    use faststrip_normal_strip_patches, only: patches_t, max_patches
    use faststrip_normal_strip_newton, only: newton_workspace_t, most_updates
    use faststrip_normal_strip_end_unknowns, only: end_t, list_ends, shift_ends, in_order
    use faststrip_normal_strip_state, only: strip_workspace_t, position_edges, look_for_edges, &
                                            renew_edges
    use faststrip_normal_types, only: demand_t, cost_t
    implicit none
    private

    public :: settle_coupled, settle_carried, settle_at_once, settle_edges
    public :: max_factorings, few_factorings

    ! Tuned [iterations]: Most iterations. Origin: safeguard.
    integer, parameter :: max_iterations = 30
    !> Most factorings of a Jacobian.
    !> Tuned [Jacobians]. Origin: safeguard.
    integer, parameter :: max_factorings = 6
    !> The same where a last solution was not near for carried numbers.
    !> Tuned [Jacobians]. Origin: chosen for the time: starting anew costs as much.
    integer, parameter :: few_factorings = 2
    ! Tuned [1]. Origin: chosen for the time: a Jacobian costs some updates.
    real(wp), parameter :: slow = 0.5_wp       ! steps that shrink less ask for a new Jacobian
    ! Tuned [1]. Origin: chosen for the time.
    real(wp), parameter :: far = 0.5_wp        ! so does a first step this large with an old one
    ! Tuned [1]. Origin: chosen: Broyden's update divides by it.
    real(wp), parameter :: least_scale = 0.3_wp ! of an updated step; less: a new Jacobian
    ! Tuned [1; strip widths]: Largest steps of the logarithm of a length, the penetration over
    ! itself, and an end. Origin: shorter than in strip_newton, as ends move too.
    real(wp), parameter :: max_log_length_step = 0.5_wp, max_penetration_step = 0.3_wp, &
                           max_end_step = 1.0_wp
    ! Tuned [evaluations]: of carried numbers in one solution. Origin: safeguard: two do.
    integer, parameter :: max_evaluations = 6
    ! Tuned [1]: Error of carried numbers over the square of what has changed. Origin: measured.
    real(wp), parameter :: second_order = 10.0_wp
    ! Tuned [1]: Tolerance with carried numbers over the one asked for. Origin: chosen: trials with
    ! them cost little.
    real(wp), parameter :: carried_share = 0.01_wp
    ! Tuned [1]: The same over the square of what has changed, where that is more. Origin: errors of
    ! the numbers are .05 to .6 of it; chosen for the time: they are evaluated anew then.
    real(wp), parameter :: worth = 0.1_wp
    ! Tuned [evaluations]: most of carried numbers from the shape of a Hertz contact. Origin: chosen
    ! for the time: from then on exact residuals cost less.
    integer, parameter :: first_evaluations = 2
    ! Tuned [1]: What has changed, for the factors of carried numbers to serve exact residuals; the
    ! tolerance of the steps up to there. Origin: chosen for the time.
    real(wp), parameter :: near_change = 0.1_wp, near_enough = 0.1_wp

    ! Tuned [strip widths]: edges that belong elsewhere by less stay. Origin: figures change by less
    ! than some 1e-6.
    real(wp), parameter :: edge_tolerance = 3.0e-4_wp

    ! Tuned [1]: of the way of edges to where they belong, where all of it is too far. Origin:
    ! chosen.
    real(wp), parameter :: part = 0.25_wp
    ! Tuned [solutions]: most on that way. Origin: safeguard.
    integer, parameter :: most_parts = 8

    !> What one step hands to the next.
    type :: steps_t
        logical :: by_carried = .false. ! numbers, or exact ones
        integer :: most_factorings = max_factorings ! of a Jacobian
        integer :: factored = 0   ! how often the Jacobian was
        integer :: updates = 0    ! of the factors, by Broyden's formula
        logical :: exact = .false. ! are the factors those of this step?
        real(wp) :: size_now = 0.0_wp, size_before = 0.0_wp ! largest component
        real(wp) :: ratio = slow  ! of the two
        real(wp) :: norm2(most_updates) = 0.0_wp ! of the steps kept
    end type steps_t

contains

    !> Solve for strips and ends together by exact influence coefficients; `settled` is false if
    !> that does not succeed, and then nothing of the patches and the workspace's strips counts.
    pure subroutine settle_coupled(workspace, compliance, demand, tolerance, most_factorings, &
                                   patches, cost, settled)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: tolerance            !! relative size of the residuals left
        integer, intent(in) :: most_factorings       !! of a Jacobian
        type(patches_t), intent(inout) :: patches    !! their ends move
        type(cost_t), intent(inout) :: cost          !! increased
        logical, intent(out) :: settled              !! converged

        call converge(workspace, compliance, demand, tolerance, .false., most_factorings, patches, &
                      cost, settled)
        if (settled) call meet_load(workspace, demand)
    end subroutine settle_coupled

    !> Solve once more where the edges of the strips belong elsewhere by now: at once, or part by
    !> part. Where that does not succeed either the solution stays as it was.
    pure subroutine settle_edges(workspace, compliance, demand, tolerance, patches, cost)
        type(strip_workspace_t), intent(inout) :: workspace !! with a solution
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: tolerance            !! relative size of the residuals left
        type(patches_t), intent(inout) :: patches    !! their ends move
        type(cost_t), intent(inout) :: cost          !! increased

        type(patches_t) :: solved
        real(wp) :: change, penetration, share
        integer :: i, n
        logical :: settled

        n = workspace%strips%n
        share = 1.0_wp
        do i = 1, most_parts
            call look_for_edges(workspace, patches, change)
            if (change <= edge_tolerance) exit
            solved = patches
            penetration = workspace%strips%penetration
            workspace%kept(:n, 1) = workspace%edge(:n)
            workspace%kept(:n, 2) = workspace%strips%p0(:n)
            workspace%kept(:n, 3) = workspace%strips%half_length(:n)
            workspace%new_edge(:n) = workspace%edge(:n) &
                                     + share*(workspace%new_edge(:n) - workspace%edge(:n))
            call renew_edges(workspace, patches, share >= 1.0_wp)
            workspace%carried%known = .false.
            call settle_carried(workspace, compliance, demand, tolerance, patches, cost, settled)
            if (settled) then
                if (share >= 1.0_wp) exit
                share = min(1.0_wp, 2.0_wp*share)
            else
                share = part*share
                patches = solved
                workspace%graded = .false.
                workspace%edge(:n) = workspace%kept(:n, 1)
                call position_edges(workspace, patches)
                workspace%strips%p0(:n) = workspace%kept(:n, 2)
                workspace%strips%half_length(:n) = workspace%kept(:n, 3)
                workspace%strips%penetration = penetration
                workspace%carried%known = .false.
                workspace%newton%kept = .false.
            end if
        end do
    end subroutine settle_edges

    !> The same from the last solution, by influence coefficients that are carried on from the last
    !> exact evaluation (`faststrip_normal_strip_carried`), and evaluated anew where strips have
    !> moved so far that this would be seen.
    pure subroutine settle_carried(workspace, compliance, demand, tolerance, patches, cost, settled)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: tolerance            !! relative size of the residuals left
        type(patches_t), intent(inout) :: patches    !! their ends move
        type(cost_t), intent(inout) :: cost          !! increased
        logical, intent(out) :: settled              !! converged

        real(wp) :: change
        integer :: evaluation
        logical :: leads

        settled = .false.
        if (.not. carries(workspace%carried, patches)) then
            workspace%drift%known = .false.
            call evaluate(workspace, patches, cost)
            if (.not. workspace%carried%known) then
                call converge(workspace, compliance, demand, tolerance, .false., max_factorings, &
                              patches, cost, settled)
                if (settled) call meet_load(workspace, demand)
                return
            end if
        end if
        leads = .false.
        do evaluation = 1, max_evaluations
            call converge(workspace, compliance, demand, tolerance, .true., max_factorings, &
                          patches, cost, settled)
            if (.not. settled) exit
            settled = second_order*carried_change(workspace%carried, workspace%strips)**2 &
                      <= tolerance
            ! Edges that the gap asks for follow the patches.
            change = 0.0_wp
            if (workspace%graded) call look_for_edges(workspace, patches, change)
            settled = settled .and. change <= edge_tolerance
            if (settled) exit
            if (.not. leads) call length_changes(workspace%carried, workspace%strips, &
                                                 workspace%newton%history(:, 1))
            if (workspace%graded) call renew_edges(workspace, patches, .true.)
            if (.not. leads) call lead_on(workspace, patches)
            leads = .true.
            call evaluate(workspace, patches, cost)
        end do
        ! What the carried numbers cannot follow is near the solution by now.
        if (.not. settled .and. evaluation > max_evaluations) &
            call converge(workspace, compliance, demand, tolerance, .false., max_factorings, &
                          patches, cost, settled)
        if (.not. settled) then
            workspace%drift%known = .false.
            return
        end if
        if (leads) call learn(workspace%drift, workspace%strips%half_length, patches)
        call meet_load(workspace, demand)
    end subroutine settle_carried

    !> Lead the strips to where the solution will be, by what the step before has missed.
    pure subroutine lead_on(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace !! solved by carried numbers
        type(patches_t), intent(inout) :: patches           !! of its strips

        type(patches_t) :: led

        associate (strips => workspace%strips, change => workspace%newton%history(:, 1))
            led = patches
            call lead(workspace%drift, strips%n, change, strips%half_length, led)
            if (in_order(workspace, led)) patches = led
            call position_edges(workspace, patches)
        end associate
    end subroutine lead_on

    !> The same of few strips from the shape of a Hertz contact: the first steps by numbers carried
    !> on from there, the last ones by exact residuals and the factors of carried numbers.
    pure subroutine settle_at_once(workspace, compliance, demand, tolerance, patches, cost, settled)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: tolerance            !! relative size of the residuals left
        type(patches_t), intent(inout) :: patches    !! their ends move
        type(cost_t), intent(inout) :: cost          !! increased
        logical, intent(out) :: settled              !! converged

        real(wp) :: change
        integer :: evaluation

        settled = .false.
        workspace%newton%kept = .false.
        workspace%drift%known = .false.
        do evaluation = 1, first_evaluations
            if (evaluation > 1 .and. workspace%graded) then
                call look_for_edges(workspace, patches, change)
                call renew_edges(workspace, patches, .true.)
            end if
            call evaluate(workspace, patches, cost)
            if (.not. workspace%carried%known) return
            call converge(workspace, compliance, demand, near_enough, .true., max_factorings, &
                          patches, cost, settled)
            if (.not. settled) return
            if (carried_change(workspace%carried, workspace%strips) <= near_change) exit
        end do
        call converge(workspace, compliance, demand, tolerance, .false., few_factorings, patches, &
                      cost, settled)
        if (settled) call meet_load(workspace, demand)
    end subroutine settle_at_once

    !> Evaluate the carried numbers anew, where the strips are.
    pure subroutine evaluate(workspace, patches, cost)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(in) :: patches
        type(cost_t), intent(inout) :: cost

        call carry(workspace%carried, workspace%strips, patches)
        if (workspace%carried%known) call add_cost(cost, workspace%strips%n, 0, .false., 1)
    end subroutine evaluate

    !> Steps until they are small: with carried numbers, which cost little, smaller than that, but
    !> not below rounding.
    pure subroutine converge(workspace, compliance, demand, tolerance, by_carried, &
                             most_factorings, patches, cost, settled)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance, tolerance
        type(demand_t), intent(in) :: demand
        logical, intent(in) :: by_carried ! numbers, or exact ones
        integer, intent(in) :: most_factorings
        type(patches_t), intent(inout) :: patches
        type(cost_t), intent(inout) :: cost
        logical, intent(out) :: settled

        type(end_t) :: ends(2*max_patches)
        type(steps_t) :: steps
        integer :: m, n_ends, trial
        real(wp) :: scale, p_scale, goal
        logical :: possible

        settled = .false.
        goal = tolerance
        steps%by_carried = by_carried
        steps%most_factorings = most_factorings
        call list_ends(workspace, patches, ends, n_ends)
        m = 2*workspace%strips%n + 1 + n_ends
        call check_kept(workspace%newton, demand, patches, ends(:n_ends))
        do trial = 1, max_iterations
            p_scale = maxval(workspace%strips%p0(:workspace%strips%n))
            call linearise(workspace, compliance, demand, patches, ends(:n_ends), p_scale, cost, &
                           steps, possible)
            if (.not. possible) return
            call find_step(workspace%newton, m, steps, possible)
            if (.not. possible) return
            ! What does not shrink any more is rounding.
            settled = steps%ratio > slow .and. steps%size_now <= tolerance
            if (settled) exit
            if (.not. workspace%newton%kept) cycle
            call take_step(workspace, ends(:n_ends), p_scale, patches, scale, possible)
            if (.not. possible) return
            if (scale < 1.0_wp .or. steps%updates == most_updates) then
                workspace%newton%kept = .false.
            else
                if (by_carried) goal = max(carried_share*tolerance, worth &
                                           *carried_change(workspace%carried, workspace%strips)**2)
                ! The residuals left are about the next step.
                settled = steps%size_now*min(steps%ratio, slow)/(1.0_wp - slow) <= goal
                if (settled) exit
                call keep_step(workspace%newton, m, steps, settled)
                if (settled) exit
            end if
            steps%size_before = steps%size_now
        end do
    end subroutine converge

    !> The load to the last digit.
    pure subroutine meet_load(workspace, demand)
        type(strip_workspace_t), intent(inout) :: workspace
        type(demand_t), intent(in) :: demand

        associate (strips => workspace%strips, n => workspace%strips%n)
            if (demand%by_load) strips%p0(:n) = strips%p0(:n)*demand%load &
                /sum(0.5_wp*pi*strips%p0(:n)*strips%half_length(:n) &
                     *(strips%y_right(:n) - strips%y_left(:n)))
        end associate
    end subroutine meet_load

    !> Residuals, into the step, and factors of a Jacobian: the kept ones, or new ones.
    pure subroutine linearise(workspace, compliance, demand, patches, ends, p_scale, cost, steps, &
                              possible)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance, p_scale
        type(demand_t), intent(in) :: demand
        type(patches_t), intent(in) :: patches
        type(end_t), intent(in) :: ends(:)
        type(cost_t), intent(inout) :: cost
        type(steps_t), intent(inout) :: steps
        logical, intent(out) :: possible ! false: factored too often, or singular

        integer :: n, m
        logical :: singular

        n = workspace%strips%n
        m = 2*n + 1 + size(ends)
        steps%exact = .not. workspace%newton%kept
        possible = .true.
        if (.not. steps%exact) then
            if (steps%by_carried) then
                call add_cost(cost, n, m, .false., 0, .true.)
            else
                call add_cost(cost, n, m, .false., 1)
            end if
            call coupled_residual(workspace, compliance, demand, ends, steps%by_carried, &
                                  workspace%newton%step)
            return
        end if
        possible = steps%factored < steps%most_factorings
        if (.not. possible) return
        steps%factored = steps%factored + 1
        if (steps%by_carried) then
            call add_cost(cost, n, m, .true., 0, .true.)
        else
            call add_cost(cost, n, m, .true., count(.not. ends%fixed))
        end if
        call coupled_factors(workspace, compliance, demand, patches, ends, p_scale, &
                             steps%by_carried, singular)
        possible = .not. singular
        if (singular) return
        workspace%newton%kept = .true.
        steps%updates = 0
    end subroutine linearise

    !> The step from the residuals, by the factors and their updates. The factors are kept no longer
    !> if they are too old for it.
    pure subroutine find_step(newton, m, steps, possible)
        type(newton_workspace_t), intent(inout) :: newton
        integer, intent(in) :: m ! equations
        type(steps_t), intent(inout) :: steps
        logical, intent(out) :: possible ! is the step finite, or to be sought anew?

        real(wp) :: scale
        integer :: j

        possible = .true.
        associate (step => newton%step, history => newton%history, updates => steps%updates)
            call lu_solve(m, newton%jacobian, newton%pivot, step)
            do j = 1, updates - 1
                step(:m) = step(:m) + history(:m, j + 1) &
                           *(dot_product(history(:m, j), step(:m))/steps%norm2(j))
            end do
            if (updates > 0) then
                scale = 1.0_wp - dot_product(history(:m, updates), step(:m))/steps%norm2(updates)
                if (scale < least_scale) then
                    newton%kept = .false.
                    return
                end if
                step(:m) = step(:m)/scale
            end if
            steps%size_now = maxval(abs(step(:m)))
            possible = steps%size_now < huge(1.0_wp)
            if (.not. possible) return
            steps%ratio = slow
            if (updates > 0) then
                steps%ratio = steps%size_now/steps%size_before
                if (steps%ratio > slow) newton%kept = .false.
            else if (.not. steps%exact .and. steps%size_now > far) then
                newton%kept = .false.
            end if
        end associate
    end subroutine find_step

    !> Move strips and ends by the step, or by a part of it where it is large.
    pure subroutine take_step(workspace, ends, p_scale, patches, scale, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        type(end_t), intent(in) :: ends(:)
        real(wp), intent(in) :: p_scale
        type(patches_t), intent(inout) :: patches
        real(wp), intent(out) :: scale   ! part of the step, at most 1
        logical, intent(out) :: possible ! are the patches in order, and does no strip leave?

        integer :: n, m

        n = workspace%strips%n
        m = 2*n + 1 + size(ends)
        associate (step => workspace%newton%step, strips => workspace%strips)
            scale = min(1.0_wp, limit_of(step(n + 1:2*n), max_log_length_step), &
                        limit_of(step(2*n + 1:2*n + 1), max_penetration_step), &
                        limit_of(step(2*n + 2:m), max_end_step))
            strips%p0(:n) = strips%p0(:n) + scale*p_scale*step(:n)
            strips%half_length(:n) = strips%half_length(:n)*exp(scale*step(n + 1:2*n))
            strips%penetration = strips%penetration*(1.0_wp + scale*step(2*n + 1))
            call shift_ends(workspace, ends, scale, step(2*n + 2:m), patches)
            possible = in_order(workspace, patches)
            if (.not. possible) return
            call position_edges(workspace, patches)
            call mark_leaving_strips(strips%y_left(:n), strips%y_right(:n), strips%inv2r(:n), &
                                     strips%p0(:n), strips%half_length(:n), strips%leaves(:n))
            possible = .not. any(strips%leaves(:n))
        end associate
    end subroutine take_step

    !> Keep a whole step for the next update of the factors; one of no size has settled.
    pure subroutine keep_step(newton, m, steps, settled)
        type(newton_workspace_t), intent(inout) :: newton
        integer, intent(in) :: m
        type(steps_t), intent(inout) :: steps
        logical, intent(out) :: settled

        steps%updates = steps%updates + 1
        newton%history(:m, steps%updates) = newton%step(:m)
        steps%norm2(steps%updates) = sum(newton%step(:m)**2)
        settled = .not. steps%norm2(steps%updates) > tiny(1.0_wp)
    end subroutine keep_step

    !> The factor that keeps steps within a limit.
    pure real(wp) function limit_of(step, largest)
        real(wp), intent(in) :: step(:), largest

        limit_of = largest/max(largest, maxval(abs(step)))
    end function limit_of

    !> Keep the last factors only if they are of a system of the same kind.
    pure subroutine check_kept(newton, demand, patches, ends)
        type(newton_workspace_t), intent(inout) :: newton
        type(demand_t), intent(in) :: demand
        type(patches_t), intent(in) :: patches
        type(end_t), intent(in) :: ends(:)

        integer :: n

        n = patches%n
        if (newton%kept) newton%kept = newton%by_load .eqv. demand%by_load
        if (newton%kept) newton%kept = newton%n_patches == n
        if (newton%kept) newton%kept = all(newton%n_strips(:n) == patches%at(:n)%n_strips) &
                                       .and. all(newton%fixed(:2*n) .eqv. ends%fixed)
        newton%by_load = demand%by_load
        newton%n_patches = n
        newton%n_strips(:n) = patches%at(:n)%n_strips
        newton%fixed(:2*n) = ends%fixed
    end subroutine check_kept
end module faststrip_normal_strip_coupled
