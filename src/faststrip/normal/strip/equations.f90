!> The equations of strips with given lateral edges: residuals and Jacobian.
!>
!> Unknowns are the centre pressures p0_k, the half-lengths xd_k (as logarithms) and the
!> penetration D. The paper gives the influence coefficients (eqs. (2)-(4)) and no algorithm; the
!> closure used is: the gap is closed on the centre line of every strip and at its exact tip,
!>
!>     H sum_s p0_s I_ks(0)    = D - h_k
!>     H sum_s p0_s I_ks(xd_k) = D - h_k - A_k xd_k^2,       sum_k (pi/2) p0_k xd_k w_k = Q
!>
!> Deviations from the paper:
!> - **N1** Source and field strip are exchanged in (6), (9), (17), (18), (20): the integral runs
!>   over the strip that carries the pressure.
!> - **N2** The displacement at the tip is the exact integral, not the quotient (22)-(24).
module faststrip_normal_strip_equations
    use faststrip_base_kinds, only: wp, pi
    use faststrip_normal_strip_figures, only: correction_of
    use faststrip_normal_strip_patches, only: pass_strips_t
    use faststrip_normal_types, only: demand_t, cost_t
    implicit none
    private

    public :: count_step, count_evaluation, cost_work, step_work, mark_leaving_strips
    public :: start_residual, start_jacobian, add_column, end_jacobian

    !> A strip this much shorter than its longer neighbour is on its way out of the contact;
    !> its pressure can stay positive while its length tends to zero.
    !> Tuned [1]: Length over that of its neighbour. Origin: chosen.
    real(wp), parameter :: leaving_length_ratio = 0.15_wp
    ! Tuned [influence coefficients]: time of one operation of linear algebra. Origin: chosen for
    ! the time.
    real(wp), parameter :: operation_cost = 0.01_wp

contains

    !> Count one step of m equations.
    pure subroutine count_step(cost, m, factored)
        type(cost_t), intent(inout) :: cost !! added to
        integer, intent(in) :: m            !! equations
        logical, intent(in) :: factored     !! was a Jacobian factored?

        cost%iterations = cost%iterations + 1
        cost%operations = cost%operations + 2.0_wp*real(m, wp)**2
        if (.not. factored) return
        cost%factorings = cost%factorings + 1
        cost%operations = cost%operations + 2.0_wp/3.0_wp*real(m, wp)**3
    end subroutine count_step

    !> Count an evaluation of all influence coefficients of n strips, with their derivatives.
    pure subroutine count_evaluation(cost, n)
        type(cost_t), intent(inout) :: cost !! added to
        integer, intent(in) :: n            !! strips

        cost%gradients = cost%gradients + 2*n*n
    end subroutine count_evaluation

    !> What was spent, in influence coefficients: as many could have been computed in that time. One
    !> with its derivatives counts three, and 100 operations of the linear algebra count one.
    pure real(wp) function cost_work(cost) result(work)
        type(cost_t), intent(in) :: cost !! of a solution

        work = real(cost%values, wp) + 3.0_wp*real(cost%gradients, wp) &
               + operation_cost*cost%operations
    end function cost_work

    !> The same for an evaluation and one step of n strips with a Jacobian.
    pure real(wp) function step_work(n) result(work)
        integer, intent(in) :: n !! strips

        type(cost_t) :: cost

        call count_evaluation(cost, n)
        call count_step(cost, 2*n + 1, .true.)
        work = cost_work(cost)
    end function step_work

    !> The part of the Jacobian that no strip's influence has: what a tip's own height adds, and the
    !> penetration's column.
    pure subroutine start_jacobian(strips, jacobian)
        type(pass_strips_t), intent(in) :: strips !! strips and their penetration
        real(wp), intent(inout), contiguous :: jacobian(:, :) !! (2n + 1, 2n + 1) of it

        integer :: n, k

        n = strips%n
        do k = 1, n
            jacobian(n + k, n + k) = 2.0_wp*strips%inv2r(k)*strips%half_length(k)**2 &
                                     /strips%penetration
        end do
        jacobian(:2*n, 2*n + 1) = -1.0_wp
    end subroutine start_jacobian

    !> The displacements under one strip's pressure in residual and Jacobian.
    pure subroutine add_column(strips, s, influence, scale, p_scale, jacobian, residual)
        type(pass_strips_t), intent(in) :: strips !! pressures and lengths
        integer, intent(in) :: s                  !! the strip
        real(wp), intent(in), contiguous :: influence(:, :)
            !! (at least n, 5): numbers on the centre lines and dI/dxd; at the tips I, dI/dxd, dI/dx
        real(wp), intent(in) :: scale             !! compliance over penetration
        real(wp), intent(in) :: p_scale           !! unit of the pressures' changes, MPa
        real(wp), intent(inout), contiguous :: jacobian(:, :), residual(:) !! added to

        real(wp) :: tip, pressure, length
        integer :: n, k

        n = strips%n
        pressure = scale*strips%p0(s)
        length = strips%half_length(s)
        do k = 1, n
            residual(k) = residual(k) - pressure*influence(k, 1)
            jacobian(k, s) = scale*p_scale*influence(k, 1)
            jacobian(k, n + s) = pressure*length*influence(k, 2)
        end do
        tip = jacobian(n + s, n + s)
        do k = 1, n
            residual(n + k) = residual(n + k) - pressure*influence(k, 3)
            jacobian(n + k, s) = scale*p_scale*influence(k, 3)
            jacobian(n + k, n + s) = pressure*length*influence(k, 4)
        end do
        jacobian(n + s, n + s) = jacobian(n + s, n + s) + tip
        ! The tip of the field strip moves with its own length, under every source.
        do k = 1, n
            jacobian(n + k, n + k) = jacobian(n + k, n + k) &
                                     + pressure*strips%half_length(k)*influence(k, 5)
        end do
    end subroutine add_column

    !> The last row of the Jacobian: the load's, or the penetration's own.
    pure subroutine end_jacobian(strips, demand, p_scale, jacobian)
        type(pass_strips_t), intent(in) :: strips !! pressures, lengths and edges
        type(demand_t), intent(in) :: demand      !! load or penetration
        real(wp), intent(in) :: p_scale           !! unit of the pressures' changes, MPa
        real(wp), intent(inout), contiguous :: jacobian(:, :) !! (2n + 1, 2n + 1) of it

        integer :: n

        n = strips%n
        jacobian(2*n + 1, :2*n) = 0.0_wp
        jacobian(2*n + 1, 2*n + 1) = merge(0.0_wp, 1.0_wp, demand%by_load)
        if (demand%by_load) call differentiate_load(strips, demand%load, p_scale, jacobian)
    end subroutine end_jacobian

    !> The load's row of the Jacobian.
    pure subroutine differentiate_load(strips, load, p_scale, jacobian)
        type(pass_strips_t), intent(in) :: strips
        real(wp), intent(in) :: load, p_scale
        real(wp), intent(inout), contiguous :: jacobian(:, :)

        integer :: n, s
        real(wp) :: strip_force

        n = strips%n
        do s = 1, n
            strip_force = 0.5_wp*pi*strips%half_length(s) &
                          *(strips%y_right(s) - strips%y_left(s))/load
            jacobian(2*n + 1, s) = strip_force*p_scale
            jacobian(2*n + 1, n + s) = strip_force*strips%p0(s)
        end do
    end subroutine differentiate_load

    !> The residuals before the displacements are subtracted, and the load's whole.
    pure subroutine start_residual(strips, demand, residual)
        type(pass_strips_t), intent(inout) :: strips !! its centre lines are set
        type(demand_t), intent(in) :: demand         !! load or penetration
        real(wp), intent(inout), contiguous :: residual(:)       !! (2n + 1)

        integer :: n

        n = strips%n
        associate (y_left => strips%y_left(:n), y_right => strips%y_right(:n), &
                   p0 => strips%p0(:n), half_length => strips%half_length(:n), &
                   penetration => strips%penetration)
            strips%y(:n) = 0.5_wp*(y_left + y_right)
            residual(:n) = (penetration - strips%height(:n))/penetration
            residual(n + 1:2*n) = residual(:n) - strips%inv2r(:n)*half_length**2/penetration
            if (demand%by_load) then
                residual(2*n + 1) = 1.0_wp - sum(0.5_wp*pi*p0*half_length*(y_right - y_left)) &
                                    /demand%load
            else
                residual(2*n + 1) = demand%penetration/(correction_of(y_left, y_right) &
                                                        *penetration) - 1.0_wp
            end if
        end associate
    end subroutine start_residual

    !> Mark strips without pressure and strips that have become too short beside a neighbour.
    !> Lengths are compared over 1/sqrt(A): where the bodies are flat along x strips are long.
    pure subroutine mark_leaving_strips(y_left, y_right, inv2r, p0, half_length, leaves)
        real(wp), intent(in) :: y_left(:), y_right(:) !! edges, (n), mm
        real(wp), intent(in) :: inv2r(:)              !! A on the centre lines, (n), 1/mm
        real(wp), intent(in) :: p0(:), half_length(:) !! pressures, MPa, and lengths, mm, (n)
        logical, intent(out) :: leaves(:)             !! strips that leave the contact, (n)

        real(wp) :: ratio
        integer :: k

        leaves = p0 <= 0.0_wp
        do k = 1, size(p0) - 1
            if (y_right(k) < y_left(k + 1)) cycle ! two patches
            ratio = half_length(k)/half_length(k + 1)*sqrt(inv2r(k)/inv2r(k + 1))
            if (ratio < leaving_length_ratio) leaves(k) = .true.
            if (1.0_wp < leaving_length_ratio*ratio) leaves(k + 1) = .true.
        end do
    end subroutine mark_leaving_strips
end module faststrip_normal_strip_equations
