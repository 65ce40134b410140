!> Newton's method for the pressures and lengths of strips whose lateral edges are given.
module faststrip_normal_strip_newton
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: beyond_all
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_normal_strip_equations, only: add_cost, strip_jacobian, mark_leaving_strips
    use faststrip_normal_strip_pass, only: pass_strips_t
    use faststrip_normal_strip_patches, only: max_patches
    use faststrip_normal_types, only: demand_t, cost_t
    implicit none
    private

    public :: most_updates, newton_workspace_t, reserve_newton, solve_strips
    public :: newton_converged, newton_strips_leave

    ! Given: numbers of kinds.
    integer, parameter :: newton_converged = 0    !! pressures, lengths and load agree
    integer, parameter :: newton_strips_leave = 1 !! strips to be cut off are marked
    integer, parameter :: newton_failed = 2       !! no convergence or a singular system

    ! Tuned [iterations]: Most iterations. Origin: safeguard.
    integer, parameter :: max_iterations = 40
    ! Tuned [steps]: Most steps taken back one after the other. Origin: chosen.
    integer, parameter :: max_backs = 4
    ! Tuned [1]: Growth of the residual from which a step is taken back, and the part of it that is
    ! tried. Origin: chosen; steps led too far.
    real(wp), parameter :: most_growth = 1.5_wp, part = 0.4_wp
    ! Tuned [iterations]: From here on strips may leave inside a patch. Origin: chosen; patches
    ! split too soon.
    integer, parameter :: sure_iteration = 10
    ! Tuned [1]: Step below which strips may leave inside a patch. Origin: chosen; patches split too
    ! soon.
    real(wp), parameter :: splitting_step = 0.3_wp
    ! Tuned [1]: Largest step of the logarithm of a length. Origin: convergence from afar: lengths
    ! at most double.
    real(wp), parameter :: max_log_length_step = 0.7_wp
    ! Tuned [1]: Largest step of the penetration over itself. Origin: convergence from afar.
    real(wp), parameter :: max_penetration_step = 0.5_wp

    !> Updates of one Jacobian at most, see `faststrip_normal_strip_coupled`.
    !> Tuned [updates]. Origin: chosen for the time: by then a new Jacobian is cheaper.
    integer, parameter :: most_updates = 8

    !> The linear system of 2n + 1 equations and those of the ends.
    type :: newton_workspace_t
        ! Whether `jacobian` holds factors that may serve again, and what kind of system they are
        ! of.
        logical :: kept = .false.
        logical :: by_load = .true., fixed(2*max_patches) = .false.
        integer :: n_patches = 0, n_strips(max_patches) = 0
        real(wp), allocatable :: history(:, :)   !! steps that update the factors
        real(wp), allocatable :: jacobian(:, :)
        real(wp), allocatable :: step(:)
        integer, allocatable :: pivot(:)
    end type newton_workspace_t

contains

    !> Allocate for systems of up to `max_strips` strips. Where there is room, what is kept stays.
    subroutine reserve_newton(workspace, max_strips)
        type(newton_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips                    !! >= 1

        integer :: n

        n = 2*max_strips + 1 + 2*max_patches
        if (allocated(workspace%pivot)) then
            if (size(workspace%pivot) >= n) return
            workspace%kept = .false.
            deallocate (workspace%jacobian, workspace%step, workspace%pivot, workspace%history)
        end if
        allocate (workspace%jacobian(n, n), workspace%step(n), &
                  workspace%history(n, most_updates), source=0.0_wp)
        allocate (workspace%pivot(n), source=0)
    end subroutine reserve_newton

    !> Pressures, half-lengths and penetration of strips with given edges.
    subroutine solve_strips(strips, compliance, demand, tolerance, cost, outcome, workspace)
        type(pass_strips_t), intent(inout) :: strips !! start and result, `leaves`
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand     !! load or penetration
        real(wp), intent(in) :: tolerance        !! relative size of the last step
        type(cost_t), intent(inout) :: cost      !! increased
        integer, intent(out) :: outcome          !! one of the `newton_` codes
        type(newton_workspace_t), intent(inout) :: workspace !! reserved for n strips

        integer :: n, iteration, backs
        logical :: singular
        real(wp) :: limit, p_scale, largest, depth, residual, residual_before

        n = strips%n
        outcome = newton_failed
        workspace%kept = .false.
        strips%leaves(:n) = .false.
        backs = 0
        residual_before = beyond_all
        p_scale = 1.0_wp
        limit = 1.0_wp
        depth = strips%penetration
        associate (step => workspace%step(:2*n + 1), last => workspace%history(:2*n + 1, 1), &
                   before => workspace%history(:2*n, 2), p0 => strips%p0(:n), &
                   half_length => strips%half_length(:n))
            do iteration = 1, max_iterations
                largest = maxval(abs(p0))
                call strip_jacobian(strips, compliance, demand, largest, workspace%jacobian, &
                                    workspace%step)
                residual = norm2(step)
                if (residual > most_growth*residual_before .and. backs < max_backs) then
                    ! The step led too far: a part of it from where it began.
                    backs = backs + 1
                    call add_cost(cost, n, 0, .false., 1)
                    limit = part*limit
                else
                    backs = 0
                    call add_cost(cost, n, 2*n + 1, .true., 0)
                    residual_before = residual
                    p_scale = largest
                    call lu_factor(2*n + 1, workspace%jacobian, workspace%pivot, singular)
                    if (singular) return
                    call lu_solve(2*n + 1, workspace%jacobian, workspace%pivot, workspace%step)
                    if (.not. all(abs(step) < huge(1.0_wp))) return
                    limit = 1.0_wp
                    largest = maxval(abs(step(n + 1:2*n)))
                    if (largest > max_log_length_step) limit = max_log_length_step/largest
                    if (abs(step(2*n + 1)) > max_penetration_step) &
                        limit = min(limit, max_penetration_step/abs(step(2*n + 1)))
                    last = step
                    before(:n) = p0
                    before(n + 1:) = half_length
                    depth = strips%penetration
                end if
                p0 = before(:n) + limit*p_scale*last(:n)
                half_length = before(n + 1:)*exp(limit*last(n + 1:2*n))
                strips%penetration = depth*(1.0_wp + limit*last(2*n + 1))
                largest = maxval(abs(last))
                if (iteration >= 2 .or. largest <= tolerance) then
                    ! Far from the solution only ends are sure to leave.
                    call find_leaving(strips, .not. (largest > splitting_step &
                                                     .and. iteration < sure_iteration))
                    if (any(strips%leaves(:n))) then
                        outcome = newton_strips_leave
                        return
                    end if
                end if
                if (largest <= tolerance .and. backs == 0) then
                    outcome = newton_converged
                    return
                end if
            end do
        end associate
    end subroutine solve_strips

    !> Mark the strips that leave; those inside a patch only if that is `sure`.
    pure subroutine find_leaving(strips, sure)
        type(pass_strips_t), intent(inout) :: strips
        logical, intent(in) :: sure

        associate (n => strips%n)
            call mark_leaving_strips(strips%y_left(:n), strips%y_right(:n), strips%inv2r(:n), &
                                     strips%p0(:n), strips%half_length(:n), strips%leaves(:n))
            if (.not. sure) call keep_inner_strips(strips%y_left(:n), strips%y_right(:n), &
                                                   strips%leaves(:n))
        end associate
    end subroutine find_leaving

    !> Take back the marks of strips that no other marked ones join to an end of their patch.
    pure subroutine keep_inner_strips(y_left, y_right, leaves)
        real(wp), intent(in) :: y_left(:), y_right(:)
        logical, intent(inout) :: leaves(:)

        integer :: first, last, from, to

        first = 1
        do last = 1, size(leaves)
            if (last < size(leaves)) then
                if (y_right(last) >= y_left(last + 1)) cycle
            end if
            do from = first, last
                if (.not. leaves(from)) exit
            end do
            do to = last, from, -1
                if (.not. leaves(to)) exit
            end do
            leaves(from:to) = .false.
            first = last + 1
        end do
    end subroutine keep_inner_strips
end module faststrip_normal_strip_newton
