!> Newton's method for the pressures and lengths of strips whose lateral edges are given.
module faststrip_normal_strip_newton
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_normal_strip_equations, only: add_cost, strip_jacobian, mark_leaving_strips
    use faststrip_normal_strip_patches, only: max_patches
    use faststrip_normal_types, only: demand_t, cost_t
    implicit none
    private

    public :: most_updates, newton_workspace_t, reserve_newton, solve_strips
    public :: newton_converged, newton_strips_leave, newton_failed

    integer, parameter :: newton_converged = 0    !! pressures, lengths and load agree
    integer, parameter :: newton_strips_leave = 1 !! strips to be cut off are marked
    integer, parameter :: newton_failed = 2       !! no convergence or a singular system

    integer, parameter :: max_iterations = 40
    integer, parameter :: max_backs = 4
    real(wp), parameter :: most_growth = 1.5_wp, part = 0.4_wp
    integer, parameter :: sure_iteration = 10
    real(wp), parameter :: splitting_step = 0.3_wp
    real(wp), parameter :: max_log_length_step = 0.7_wp
    real(wp), parameter :: max_penetration_step = 0.5_wp

    !> Updates of one Jacobian at most, see `faststrip_normal_strip_coupled`.
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
        real(wp), allocatable :: y(:)            !! centre lines
        real(wp), allocatable :: influence(:, :) !! one column: values, d/dx, d/dxd
        integer, allocatable :: pivot(:)
    end type newton_workspace_t

contains

    !> Allocate for systems of up to `max_strips` strips.
    subroutine reserve_newton(workspace, max_strips)
        type(newton_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips                    !! >= 1

        integer :: n

        n = 2*max_strips + 1 + 2*max_patches
        workspace%kept = .false.
        if (allocated(workspace%pivot)) then
            if (size(workspace%pivot) >= n) return
            deallocate (workspace%jacobian, workspace%step, workspace%pivot, workspace%y, &
                        workspace%influence, workspace%history)
        end if
        allocate (workspace%jacobian(n, n), workspace%step(n), &
                  workspace%history(n, most_updates), source=0.0_wp)
        allocate (workspace%y(max_strips), workspace%influence(max_strips, 3), source=0.0_wp)
        allocate (workspace%pivot(n), source=0)
    end subroutine reserve_newton

    !> Pressures, half-lengths and penetration of strips with given edges under a given load.
    subroutine solve_strips(y_left, y_right, height, inv2r, compliance, goal, tolerance, p0, &
                            half_length, penetration, leaves, cost, outcome, workspace)
        real(wp), intent(in) :: y_left(:)        !! left edges, (n), mm
        real(wp), intent(in) :: y_right(:)       !! right edges, (n), mm
        real(wp), intent(in) :: height(:)        !! h on the centre lines, above the lowest, (n), mm
        real(wp), intent(in) :: inv2r(:)         !! A on the centre lines, positive, (n), 1/mm
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: goal       !! load or penetration
        real(wp), intent(in) :: tolerance        !! relative size of the last step
        real(wp), intent(inout) :: p0(:)         !! start and result, (n), MPa
        real(wp), intent(inout) :: half_length(:) !! start and result, (n), mm
        real(wp), intent(inout) :: penetration   !! D above the lowest height, mm
        logical, intent(out) :: leaves(:)        !! strips that leave the contact, (n)
        type(cost_t), intent(inout) :: cost      !! increased
        integer, intent(out) :: outcome          !! one of the `newton_` codes
        type(newton_workspace_t), intent(inout) :: workspace !! reserved for n strips

        integer :: n, iteration, backs
        logical :: singular
        real(wp) :: limit, p_scale, largest, depth, residual, residual_before

        n = size(p0)
        outcome = newton_failed
        workspace%kept = .false.
        leaves = .false.
        backs = 0
        residual_before = 1.0e100_wp
        p_scale = 1.0_wp
        limit = 1.0_wp
        depth = penetration
        associate (step => workspace%step(:2*n + 1), last => workspace%history(:2*n + 1, 1), &
                   before => workspace%history(:2*n, 2))
            do iteration = 1, max_iterations
                largest = maxval(abs(p0))
                call strip_jacobian(y_left, y_right, height, inv2r, compliance, goal, p0, &
                                    half_length, penetration, largest, workspace%jacobian, &
                                    workspace%step, workspace%y, workspace%influence)
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
                    depth = penetration
                end if
                p0 = before(:n) + limit*p_scale*last(:n)
                half_length = before(n + 1:)*exp(limit*last(n + 1:2*n))
                penetration = depth*(1.0_wp + limit*last(2*n + 1))
                largest = maxval(abs(last))
                if (iteration >= 2 .or. largest <= tolerance) then
                    call mark_leaving_strips(y_left, y_right, inv2r, p0, half_length, leaves)
                    ! Far from the solution only ends are sure to leave.
                    if (largest > splitting_step .and. iteration < sure_iteration) &
                        call keep_inner_strips(y_left, y_right, leaves)
                    if (any(leaves)) then
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
