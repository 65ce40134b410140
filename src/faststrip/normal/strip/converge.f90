!> Strips and patch ends solved for together, by linearised influence coefficients.
!>
!> The ends of the patches join the unknowns of `faststrip_normal_strip_equations`, each moving
!> outwards in units of its end strip's width (`faststrip_normal_strip_coupled_equations`): the
!> squared strip length, extrapolated, is 0 at the end.
!> Newton's method solves them with coefficients that are linearised at their last evaluation
!> (`faststrip_normal_strip_linearised`), and with factors that serve until steps shrink too slowly.
!> The coefficients err by the square of what has changed: they are evaluated anew until that is
!> below the tolerance, and where a change is too large to be trusted. In scaled unknowns the
!> factors hardly change from one load to the next: a warm start takes over coefficients and
!> factors. Edges of strips follow their patches (`faststrip_normal_strip_grading`) where
!> coefficients are evaluated near the solution.
!>
!> Which strips there are stays fixed: strips that leave are marked, and the caller decides.
module faststrip_normal_strip_converge
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: beyond_all, largest_ratio, most_steps
    use faststrip_numerics_lu, only: lu_solve
    use faststrip_normal_strip_equations, only: count_step, count_evaluation, mark_leaving_strips
    use faststrip_normal_strip_linearised, only: linearise_coefficients, is_linear_of, &
                                                 linear_change
    use faststrip_normal_strip_coupled_equations, only: end_t, list_ends, shift_ends, in_order, &
                                                        coupled_residual, coupled_factors
    use faststrip_normal_strip_ends, only: end_width
    use faststrip_normal_strip_patches, only: patches_t, max_patches, pass_strips_t
    use faststrip_normal_strip_state, only: strip_workspace_t, newton_workspace_t, most_past, &
                                            position_edges, look_for_edges, renew_edges
    use faststrip_normal_types, only: demand_t, cost_t
    implicit none
    private

    public :: converge, converged, strips_leave, not_converged

    ! Given: numbers of kinds.
    integer, parameter :: converged = 0     !! all equations hold
    integer, parameter :: strips_leave = 1  !! strips that leave the contact are marked
    integer, parameter :: not_converged = 2 !! a limit was met, or the system is singular

    ! Tuned [strip widths]: edges that belong elsewhere by less stay. Origin: the penetration
    ! changes by less than 1e-6.
    real(wp), parameter :: edge_tolerance = 2.0e-3_wp
    ! Tuned [1]: the same where they were looked at near the solution, over it. Origin: chosen for
    ! the time: mostly they move by less.
    real(wp), parameter :: after_look = 5.0_wp
    ! Tuned [evaluations; factors]: most of each. Origin: safeguards: some three and two do; three
    ! evaluations more than those with which edges follow the gap.
    integer, parameter :: max_evaluations = 11, max_factorings = 25
    ! Tuned [evaluations]: after so many edges follow the gap no longer. Origin: two or three do;
    ! with six pmax of shift 4.7 of the paper is uneven over the load by 3e-4.
    integer, parameter :: most_renewals = 8
    ! Tuned [1]: a step from which on edges follow the gap. Origin: chosen: from afar edges that
    ! follow the ends alone succeed more often.
    real(wp), parameter :: close = 0.1_wp
    ! Tuned [1]: Error of a solution by linearised coefficients over the square of what has
    ! changed, in one patch. Origin: measured: .01 in the median, .02 to .1 in 95 %. Of several,
    ! whose distances change, .7 was measured: 1.
    real(wp), parameter :: second_order = 0.05_wp
    ! Tuned [1]: length of a strip over its width from which on a change counts as one of the width,
    ! for near tips coefficients change over that. Origin: measured: tips of hostile gaps close to
    ! 1e-5 to 1e-4, from 10 to 40 as many gaps are `ok`.
    real(wp), parameter :: slender = 20.0_wp
    ! Tuned [1]: the steps' tolerance over that asked for, or over the square of what has changed:
    ! coefficients are evaluated anew then. Origin: chosen: steps cost little.
    real(wp), parameter :: finest = 0.3_wp
    ! Tuned [1]: what is left where coefficients are evaluated anew, over the change that they
    ! allow. Origin: chosen: they serve from there to the last digit; with .2 loads that are
    ! searched for miss by 1e-10.
    real(wp), parameter :: near = 0.05_wp
    ! Tuned [1]: change from which coefficients are not trusted with ends held. Origin: convergence
    ! of hostile gaps: with .2 14 of 888 fewer are `ok`.
    real(wp), parameter :: trusted_held = 0.06_wp
    ! Tuned [1]. Origin: chosen for the time: factors cost some steps; with .25 warm ones take less,
    ! cold ones more.
    real(wp), parameter :: slow = 0.35_wp ! steps that shrink less ask for new factors
    ! Tuned [1]: least part of a step that is taken. Origin: below strips want to leave.
    real(wp), parameter :: least_scale = 0.05_wp
    ! Tuned [1]: Largest steps of the logarithm of a length, of the penetration over itself, and,
    ! where ends move, of an end over half the width of its patch and of what a strip loses of its
    ! pressure; coefficients are not trusted for more. Origin: convergence from afar.
    real(wp), parameter :: most_change = 0.5_wp

    !> Where Newton's method stands.
    type :: course_t
        logical :: held = .false.      ! do the ends stay where they are?
        logical :: follows = .false.   ! do edges follow the gap?
        integer :: m = 0               ! equations
        integer :: evaluations = 0, factored = 0 ! so far
        logical :: again = .false.     ! are coefficients to be evaluated anew?
        real(wp) :: moved = 0.0_wp     ! edges that belong elsewhere, strip widths
        logical :: looked = .false.    ! were edges looked at near the solution?
        logical :: fresh = .false.     ! are factors those of this step?
        real(wp) :: size_now = 0.0_wp, size_before = beyond_all ! largest component of the steps
        real(wp) :: second = 1.0_wp    ! error of a solution over the square of what has changed
        integer :: past = 0            ! steps so far by the same factors and coefficients
        real(wp) :: scale = 1.0_wp     ! part of a step that is taken
        real(wp) :: p_scale = 1.0_wp   ! unit of the pressures' steps, MPa
    end type course_t

contains

    !> Solve for strips and ends together, or for strips between ends that are held.
    pure subroutine converge(workspace, compliance, demand, tolerance, held, patches, cost, outcome)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(in) :: tolerance            !! relative size of what is left
        logical, intent(in) :: held                  !! do the ends stay where they are?
        type(patches_t), intent(inout) :: patches    !! those of the strips; their ends move
        type(cost_t), intent(inout) :: cost          !! increased
        integer, intent(out) :: outcome              !! how it ended

        type(end_t) :: ends(2*max_patches)
        type(course_t) :: course
        integer :: n_ends, trial
        logical :: possible

        call list_ends(workspace, patches, ends, n_ends)
        if (held) ends(:n_ends)%fixed = .true.
        call check_kept(workspace%newton, demand, patches, ends(:n_ends))
        workspace%strips%leaves(:workspace%strips%n) = .false.
        course%held = held
        course%follows = workspace%graded .and. .not. held
        course%m = 2*workspace%strips%n + 1 + n_ends
        course%again = .not. is_linear_of(workspace%linear, patches)
        course%second = second_of(workspace%strips, patches%n)
        do trial = 1, most_steps
            outcome = not_converged
            call evaluate(workspace, trial, patches, course, cost, possible)
            if (.not. possible) return
            call linearise(workspace, compliance, demand, patches, ends(:n_ends), course, cost, &
                           possible)
            if (.not. possible) return
            call find_step(workspace, course, possible)
            if (.not. possible) return
            ! What does not shrink any more is rounding.
            if (.not. workspace%newton%kept .and. course%size_now > tolerance) cycle
            call take_step(workspace, ends(:n_ends), course, patches, outcome)
            if (outcome /= converged) return
            if (course%scale < least_scale .and. .not. held) then
                outcome = not_converged
                return
            end if
            call judge(workspace, tolerance, patches, course, outcome)
            if (outcome == converged) exit
        end do
        if (outcome == converged) call meet_load(workspace, demand)
    end subroutine converge

    !> Evaluate all coefficients anew, where they are not to be trusted, for edges that belong where
    !> the patches are.
    pure subroutine evaluate(workspace, trial, patches, course, cost, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: trial ! number of the step
        type(patches_t), intent(inout) :: patches
        type(course_t), intent(inout) :: course
        type(cost_t), intent(inout) :: cost
        logical, intent(out) :: possible ! false: too often

        possible = .true.
        if (.not. course%again) then
            course%again = linear_change(workspace%linear, workspace%strips) &
                           > merge(trusted_held, most_change, course%held)
            if (.not. course%again) return
            ! Factors of coefficients that have changed so much do not serve any more: steps by
            ! them go back and forth.
            workspace%newton%kept = .false.
        end if
        possible = course%evaluations < max_evaluations .or. course%held
        if (.not. possible) return
        course%evaluations = course%evaluations + 1
        if (course%follows .and. trial > 1 .and. course%size_now <= close) then
            if (course%moved <= edge_tolerance) &
                call look_for_edges(workspace, patches, course%moved)
            call renew_edges(workspace, patches)
            course%moved = 0.0_wp
            ! Edges that do not come to rest stay where they are.
            course%follows = course%evaluations < most_renewals
        end if
        call linearise_coefficients(workspace%linear, workspace%strips, patches)
        call count_evaluation(cost, workspace%strips%n)
        course%second = second_of(workspace%strips, patches%n)
        course%size_before = beyond_all
        course%again = .false.
    end subroutine evaluate

    !> Residuals, into the step, and factors of a Jacobian: the kept ones, or new ones.
    pure subroutine linearise(workspace, compliance, demand, patches, ends, course, cost, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(patches_t), intent(in) :: patches
        type(end_t), intent(in) :: ends(:)
        type(course_t), intent(inout) :: course
        type(cost_t), intent(inout) :: cost
        logical, intent(out) :: possible ! false: factored too often, or singular

        logical :: singular

        possible = .true.
        course%p_scale = maxval(workspace%strips%p0(:workspace%strips%n))
        course%fresh = .not. workspace%newton%kept
        if (course%fresh) then
            possible = course%factored < max_factorings
            if (.not. possible) return
            course%factored = course%factored + 1
            call coupled_factors(workspace, compliance, demand, patches, ends, course%p_scale, &
                                 singular)
            possible = .not. singular
            workspace%newton%kept = possible
        else
            call coupled_residual(workspace, compliance, demand, ends, workspace%newton%step)
        end if
        call count_step(cost, course%m, course%fresh)
    end subroutine linearise

    !> The step from the residuals. The factors are kept no longer if they are too old for it.
    pure subroutine find_step(workspace, course, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        type(course_t), intent(inout) :: course
        logical, intent(out) :: possible ! is it finite?

        associate (newton => workspace%newton)
            call lu_solve(course%m, newton%jacobian, newton%pivot, newton%step)
            call correct_step(newton, course)
            course%size_now = maxval(abs(newton%step(:course%m)))
            possible = course%size_now < huge(1.0_wp)
            if (.not. possible .or. course%fresh) return
            if (course%size_now > slow*course%size_before) newton%kept = .false.
        end associate
    end subroutine find_step

    !> A step by old factors, corrected by what the steps before it left (Broyden's method; C. T.
    !> Kelley, Solving Nonlinear Equations with Newton's Method, 2003, 4.1). Near a solution only:
    !> from afar more steps would lead elsewhere.
    pure subroutine correct_step(newton, course)
        type(newton_workspace_t), intent(inout) :: newton
        type(course_t), intent(inout) :: course

        real(wp) :: share
        integer :: i

        associate (step => newton%step(:course%m), past => newton%past(:course%m, :), &
                   n => course%past)
            if (course%fresh .or. course%size_before > close .or. n == most_past) n = 0
            share = 0.0_wp
            do i = 1, n
                share = dot_product(past(:, i), step)/max(norm2(past(:, i))**2, tiny(share))
                if (i < n) step = step + share*past(:, i + 1)
            end do
            if (abs(share) <= 0.5_wp) then
                step = step/(1.0_wp - share)
                n = n + 1
            else
                n = 1
            end if
            past(:, n) = step
        end associate
    end subroutine correct_step

    !> Is what is left below the tolerance? If not: are coefficients to be evaluated anew?
    pure subroutine judge(workspace, tolerance, patches, course, outcome)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: tolerance
        type(patches_t), intent(in) :: patches
        type(course_t), intent(inout) :: course
        integer, intent(out) :: outcome

        real(wp) :: left, change, error

        outcome = not_converged
        if (course%scale < 1.0_wp) then
            workspace%newton%kept = .false.
            course%size_before = beyond_all
            return
        end if
        ! What is left is about the next step.
        left = course%size_now*min(course%size_now/course%size_before, slow)/(1.0_wp - slow)
        if (.not. course%size_before < beyond_all) left = course%size_now*slow/(1.0_wp - slow)
        course%size_before = course%size_now
        change = linear_change(workspace%linear, workspace%strips)
        error = course%second*change**2
        if (left <= finest*tolerance .and. error <= tolerance) then
            if (course%follows) call look_for_edges(workspace, patches, course%moved)
            ! Where a jump of curvature enters the patch edges move on after a look.
            course%again = course%moved > merge(after_look, 1.0_wp, course%looked)*edge_tolerance
            if (.not. course%again) outcome = converged
            return
        end if
        course%again = error > tolerance &
                       .and. left <= max(finest*change**2, near*sqrt(tolerance/course%second))
        if (.not. course%follows .or. course%looked .or. course%again) return
        ! Near enough for edges that stay: do they belong elsewhere?
        if (left > 0.25_wp*edge_tolerance) return
        course%looked = .true.
        call look_for_edges(workspace, patches, course%moved)
        course%again = course%moved > edge_tolerance
    end subroutine judge

    !> The larger of both factors of what has changed.
    pure real(wp) function second_of(strips, n_patches)
        type(pass_strips_t), intent(in) :: strips
        integer, intent(in) :: n_patches

        real(wp) :: slimmest ! length over width; beyond the largest ratio changes are rounding

        associate (n => strips%n)
            slimmest = min(largest_ratio, maxval(strips%half_length(:n) &
                                                 /(strips%y_right(:n) - strips%y_left(:n))))
        end associate
        second_of = max(merge(second_order, 1.0_wp, n_patches == 1), &
                        second_order*(slimmest/slender)**2)
    end function second_of

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

    !> Move strips and ends by the step, or by a part of it where it is large.
    pure subroutine take_step(workspace, ends, course, patches, outcome)
        type(strip_workspace_t), intent(inout) :: workspace
        type(end_t), intent(in) :: ends(:)
        type(course_t), intent(inout) :: course
        type(patches_t), intent(inout) :: patches
        integer, intent(out) :: outcome  ! `converged`: the patches are in order, no strip leaves

        integer :: n

        n = workspace%strips%n
        outcome = not_converged
        call limit_step(workspace, ends, patches, course)
        associate (step => workspace%newton%step, strips => workspace%strips, scale => course%scale)
            strips%p0(:n) = strips%p0(:n) + scale*course%p_scale*step(:n)
            strips%half_length(:n) = strips%half_length(:n)*exp(scale*step(n + 1:2*n))
            strips%penetration = strips%penetration*(1.0_wp + scale*step(2*n + 1))
            if (.not. course%held) then
                call shift_ends(workspace, ends, scale, step(2*n + 2:course%m), patches)
                if (.not. in_order(workspace, patches)) return
                call position_edges(workspace, patches)
            end if
            call mark_leaving_strips(strips%y_left(:n), strips%y_right(:n), strips%inv2r(:n), &
                                     strips%p0(:n), strips%half_length(:n), strips%leaves(:n))
            outcome = merge(strips_leave, converged, any(strips%leaves(:n)))
        end associate
    end subroutine take_step

    !> The part of a step that is taken.
    pure subroutine limit_step(workspace, ends, patches, course)
        type(strip_workspace_t), intent(in) :: workspace
        type(end_t), intent(in) :: ends(:)
        type(patches_t), intent(in) :: patches
        type(course_t), intent(inout) :: course

        real(wp) :: change
        integer :: n, e

        n = workspace%strips%n
        associate (step => workspace%newton%step, scale => course%scale)
            change = maxval(abs(step(n + 1:2*n + 1)))
            do e = 1, size(ends)
                associate (patch => patches%at(ends(e)%patch))
                    change = max(change, 2.0_wp*abs(step(2*n + 1 + e)) &
                                         *(end_width(workspace, ends(e)%strip) &
                                           /(patch%y_to - patch%y_from)))
                end associate
            end do
            if (.not. course%held) &
                change = max(change, maxval(-course%p_scale*step(:n)/workspace%strips%p0(:n)))
            scale = most_change/max(most_change, change)
        end associate
    end subroutine limit_step

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
end module faststrip_normal_strip_converge
