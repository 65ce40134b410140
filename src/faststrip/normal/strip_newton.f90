!> Newton's method for the pressures and lengths of strips whose lateral edges are given.
!>
!> Unknowns are the centre pressures p0_k, the half-lengths xd_k (as logarithms) and the
!> penetration D. The paper gives the influence numbers (eqs. (2)-(4)) and no algorithm; the
!> closure used is: the gap is closed on the centre line of every strip and at its exact tip,
!>
!>     H sum_s p0_s I_ks(0)    = D - h_k
!>     H sum_s p0_s I_ks(xd_k) = D - h_k - A_k xd_k^2,       sum_k (pi/2) p0_k xd_k w_k = Q
!>
!> Deviations from the paper:
!> 1. Source and field strip are exchanged in (6), (9), (17), (18), (20): the integral runs over
!>    the strip that carries the pressure.
!> 2. The displacement at the tip is the exact integral, not the quotient (22)-(24).
module faststrip_normal_strip_newton
    use faststrip_kinds, only: wp, pi
    use faststrip_influence_row, only: center_influence_column_gradient, influence_column_gradient
    use faststrip_numerics_lapack, only: dgetrf, dgetrs
    implicit none
    private

    public :: newton_workspace_t, reserve_newton, solve_strips
    public :: newton_converged, newton_strips_leave, newton_failed

    integer, parameter :: newton_converged = 0    !! pressures, lengths and load agree
    integer, parameter :: newton_strips_leave = 1 !! strips to be cut off are marked
    integer, parameter :: newton_failed = 2       !! no convergence or a singular system

    integer, parameter :: max_iterations = 40
    integer, parameter :: damped_iteration = 12
    real(wp), parameter :: max_log_length_step = 0.7_wp
    real(wp), parameter :: max_penetration_step = 0.5_wp
    !> A strip this much shorter than its longer neighbour is on its way out of the contact;
    !> its pressure can stay positive while its length tends to zero.
    real(wp), parameter :: leaving_length_ratio = 0.15_wp

    !> The linear system of 2n + 1 equations.
    type :: newton_workspace_t
        real(wp), allocatable :: jacobian(:, :)
        real(wp), allocatable :: step(:, :)
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

        n = 2*max_strips + 1
        if (allocated(workspace%pivot)) then
            if (size(workspace%pivot) >= n) return
            deallocate (workspace%jacobian, workspace%step, workspace%pivot, workspace%y, &
                        workspace%influence)
        end if
        allocate (workspace%jacobian(n, n), workspace%step(n, 1), source=0.0_wp)
        allocate (workspace%y(max_strips), workspace%influence(max_strips, 3), source=0.0_wp)
        allocate (workspace%pivot(n), source=0)
    end subroutine reserve_newton

    !> Pressures, half-lengths and penetration of strips with given edges under a given load.
    subroutine solve_strips(y_left, y_right, height, inv2r, compliance, by_load, load, &
                            tolerance, p0, half_length, penetration, leaves, iterations, outcome, workspace)
        real(wp), intent(in) :: y_left(:)        !! left edges, (n), mm
        real(wp), intent(in) :: y_right(:)       !! right edges, (n), mm
        real(wp), intent(in) :: height(:)        !! h on the centre lines, above the lowest, (n), mm
        real(wp), intent(in) :: inv2r(:)         !! A on the centre lines, positive, (n), 1/mm
        real(wp), intent(in) :: compliance       !! H of eq. (4), 1/MPa
        logical, intent(in) :: by_load           !! is the load given? else the penetration
        real(wp), intent(in) :: load             !! Q, N; without meaning for given penetration
        real(wp), intent(in) :: tolerance        !! relative size of the last step
        real(wp), intent(inout) :: p0(:)         !! start and result, (n), MPa
        real(wp), intent(inout) :: half_length(:) !! start and result, (n), mm
        real(wp), intent(inout) :: penetration   !! D above the lowest height, mm
        logical, intent(out) :: leaves(:)        !! strips that leave the contact, (n)
        integer, intent(inout) :: iterations     !! increased by the iterations taken
        integer, intent(out) :: outcome          !! one of the `newton_` codes
        type(newton_workspace_t), intent(inout) :: workspace !! reserved for n strips

        integer :: n, iteration, info
        real(wp) :: limit, p_scale, largest

        n = size(p0)
        outcome = newton_failed
        leaves = .false.
        do iteration = 1, max_iterations
            iterations = iterations + 1
            p_scale = maxval(abs(p0))
            call assemble(y_left, y_right, height, inv2r, compliance, by_load, load, p0, &
                          half_length, penetration, p_scale, workspace%jacobian, &
                          workspace%step(:, 1), workspace%y, workspace%influence)
            call dgetrf(2*n + 1, 2*n + 1, workspace%jacobian, size(workspace%jacobian, 1), &
                        workspace%pivot, info)
            if (info /= 0) return
            call dgetrs('N', 2*n + 1, 1, workspace%jacobian, size(workspace%jacobian, 1), &
                        workspace%pivot, workspace%step, size(workspace%step, 1), info)
            associate (step => workspace%step(:2*n + 1, 1))
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

    !> Negative residual and Jacobian in scaled unknowns (p0/p_scale, ln xd, D/penetration).
    subroutine assemble(y_left, y_right, height, inv2r, compliance, by_load, load, p0, &
                        half_length, penetration, p_scale, jacobian, rhs, y, influence)
        real(wp), intent(in) :: y_left(:), y_right(:), height(:), inv2r(:), compliance, load
        logical, intent(in) :: by_load
        real(wp), intent(in) :: p0(:), half_length(:), penetration, p_scale
        real(wp), intent(inout) :: jacobian(:, :), rhs(:), y(:), influence(:, :)

        integer :: n, k, s
        real(wp) :: scale, strip_force, centre, tip

        n = size(p0)
        y(:n) = 0.5_wp*(y_left + y_right)
        scale = compliance/penetration
        do k = 1, n
            centre = (penetration - height(k))/penetration
            tip = centre - inv2r(k)*half_length(k)**2/penetration
            rhs(k) = centre
            rhs(n + k) = tip
            jacobian(n + k, n + k) = 2.0_wp*inv2r(k)*half_length(k)**2/penetration
            jacobian(k, 2*n + 1) = -1.0_wp
            jacobian(n + k, 2*n + 1) = -1.0_wp
        end do
        do s = 1, n
            call center_influence_column_gradient(half_length(s), y_left(s), y_right(s), y(:n), &
                                                  influence(:n, 1), influence(:n, 3))
            do k = 1, n
                rhs(k) = rhs(k) - scale*p0(s)*influence(k, 1)
                jacobian(k, s) = scale*p_scale*influence(k, 1)
                jacobian(k, n + s) = scale*p0(s)*half_length(s)*influence(k, 3)
            end do
            call influence_column_gradient(half_length(s), y_left(s), y_right(s), half_length, &
                                           y(:n), influence(:n, 1), influence(:n, 2), &
                                           influence(:n, 3))
            tip = jacobian(n + s, n + s)
            do k = 1, n
                rhs(n + k) = rhs(n + k) - scale*p0(s)*influence(k, 1)
                jacobian(n + k, s) = scale*p_scale*influence(k, 1)
                jacobian(n + k, n + s) = scale*p0(s)*half_length(s)*influence(k, 3)
            end do
            jacobian(n + s, n + s) = jacobian(n + s, n + s) + tip
            ! The tip of the field strip moves with its own length, under every source.
            do k = 1, n
                jacobian(n + k, n + k) = jacobian(n + k, n + k) &
                                         + scale*p0(s)*half_length(k)*influence(k, 2)
            end do
        end do
        if (.not. by_load) then
            rhs(2*n + 1) = 0.0_wp
            jacobian(2*n + 1, :2*n) = 0.0_wp
            jacobian(2*n + 1, 2*n + 1) = 1.0_wp
            return
        end if
        rhs(2*n + 1) = 1.0_wp
        jacobian(2*n + 1, 2*n + 1) = 0.0_wp
        do s = 1, n
            strip_force = 0.5_wp*pi*half_length(s)*(y_right(s) - y_left(s))/load
            rhs(2*n + 1) = rhs(2*n + 1) - strip_force*p0(s)
            jacobian(2*n + 1, s) = strip_force*p_scale
            jacobian(2*n + 1, n + s) = strip_force*p0(s)
        end do
    end subroutine assemble

    !> Mark strips without pressure and strips that have become too short beside a neighbour.
    pure subroutine mark_leaving_strips(y_left, y_right, p0, half_length, leaves)
        real(wp), intent(in) :: y_left(:), y_right(:), p0(:), half_length(:)
        logical, intent(out) :: leaves(:)

        integer :: k

        leaves = p0 <= 0.0_wp
        do k = 1, size(p0) - 1
            if (y_right(k) < y_left(k + 1)) cycle ! two patches
            if (half_length(k) < leaving_length_ratio*half_length(k + 1)) leaves(k) = .true.
            if (half_length(k + 1) < leaving_length_ratio*half_length(k)) leaves(k + 1) = .true.
        end do
    end subroutine mark_leaving_strips
end module faststrip_normal_strip_newton
