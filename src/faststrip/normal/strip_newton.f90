!> Newton's method for the pressures and lengths of strips whose lateral edges are given.
module faststrip_normal_strip_newton
    use faststrip_kinds, only: wp
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_normal_strip_equations, only: goal_t, strip_jacobian, mark_leaving_strips
    use faststrip_normal_strip_patches, only: max_patches
    implicit none
    private

    public :: most_updates, newton_workspace_t, reserve_newton, solve_strips
    public :: newton_converged, newton_strips_leave, newton_failed

    integer, parameter :: newton_converged = 0    !! pressures, lengths and load agree
    integer, parameter :: newton_strips_leave = 1 !! strips to be cut off are marked
    integer, parameter :: newton_failed = 2       !! no convergence or a singular system

    integer, parameter :: max_iterations = 40
    integer, parameter :: damped_iteration = 12
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

    !> Make room for systems of up to `max_strips` strips.
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
                            half_length, penetration, leaves, iterations, outcome, workspace)
        real(wp), intent(in) :: y_left(:)        !! left edges, (n), mm
        real(wp), intent(in) :: y_right(:)       !! right edges, (n), mm
        real(wp), intent(in) :: height(:)        !! h on the centre lines, above the lowest, (n), mm
        real(wp), intent(in) :: inv2r(:)         !! A on the centre lines, positive, (n), 1/mm
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        type(goal_t), intent(in) :: goal         !! load or penetration
        real(wp), intent(in) :: tolerance        !! relative size of the last step
        real(wp), intent(inout) :: p0(:)         !! start and result, (n), MPa
        real(wp), intent(inout) :: half_length(:) !! start and result, (n), mm
        real(wp), intent(inout) :: penetration   !! D above the lowest height, mm
        logical, intent(out) :: leaves(:)        !! strips that leave the contact, (n)
        integer, intent(inout) :: iterations     !! increased by the iterations taken
        integer, intent(out) :: outcome          !! one of the `newton_` codes
        type(newton_workspace_t), intent(inout) :: workspace !! reserved for n strips

        integer :: n, iteration
        logical :: singular
        real(wp) :: limit, p_scale, largest

        n = size(p0)
        outcome = newton_failed
        workspace%kept = .false.
        leaves = .false.
        do iteration = 1, max_iterations
            iterations = iterations + 1
            p_scale = maxval(abs(p0))
            call strip_jacobian(y_left, y_right, height, inv2r, compliance, goal, p0, half_length, &
                                penetration, p_scale, workspace%jacobian, workspace%step, &
                                workspace%y, workspace%influence)
            call lu_factor(2*n + 1, workspace%jacobian, workspace%pivot, singular)
            if (singular) return
            call lu_solve(2*n + 1, workspace%jacobian, workspace%pivot, workspace%step)
            associate (step => workspace%step(:2*n + 1))
                if (.not. all(abs(step) < huge(1.0_wp))) return
                limit = 1.0_wp
                largest = maxval(abs(step(n + 1:2*n)))
                if (largest > max_log_length_step) limit = max_log_length_step/largest
                if (abs(step(2*n + 1)) > max_penetration_step) &
                    limit = min(limit, max_penetration_step/abs(step(2*n + 1)))
                ! Steps that go back and forth between two states settle at half the length.
                if (iteration > damped_iteration) limit = 0.5_wp*limit
                p0 = p0 + limit*p_scale*step(:n)
                half_length = half_length*exp(limit*step(n + 1:2*n))
                penetration = penetration*(1.0_wp + limit*step(2*n + 1))
                if (iteration >= 2 .or. maxval(abs(step)) <= tolerance) then
                    call mark_leaving_strips(y_left, y_right, p0, half_length, leaves)
                    if (any(leaves)) then
                        outcome = newton_strips_leave
                        return
                    end if
                end if
                if (maxval(abs(step)) <= tolerance) then
                    outcome = newton_converged
                    return
                end if
            end associate
        end do
    end subroutine solve_strips
end module faststrip_normal_strip_newton
