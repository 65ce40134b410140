!> The influence integral in twice the usual precision: the reference where GSL has no more digits.
!>
!> Where a compiler has no reals of 30 digits (flang on x86-64) it is in the usual precision: the
!> bound of its error says so, and so does `reference_name`.
!>
!> Each side of the field point X is an integral over tau (as in faststrip_tables_quadrature:
!> no difference of near numbers), taken by the double-exponential rule `tau = a/(1 + exp(-pi sinh
!> t))` with its step halved until nothing changes any more. The kernel is `2 atanh((cr - cl)/(s_r
!> + s_l))`, or `asinh(cr/delta)` for cl = 0.
module faststrip_lab_studies_exact_influence
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: exact_influence, reference_name, qp

    integer, parameter :: quad = selected_real_kind(30)
    !> The widest kind there is, of 30 digits or the usual one.
    integer, parameter :: qp = merge(quad, wp, quad > 0)
    !> Its name in the column of references.
    character(len=*), parameter :: reference_name = trim(merge('quad  ', 'double', quad > 0))

    real(qp), parameter :: pi_q = acos(-1.0_qp)
    real(qp), parameter :: last_t = 4.75_qp       ! tau from 1e-78 a on
    real(qp), parameter :: first_step = 0.25_qp
    integer, parameter :: most_halvings = 8
    real(qp), parameter :: enough = 1.0e-21_qp    ! relative change by the last halving
    ! What the sums round is not known to be less, relative.
    real(wp), parameter :: rounding = merge(0.0_wp, 64*epsilon(1.0_wp), quad > 0)

contains

    !> G(X, c_right) - G(X, c_left), edges and X as they are, and a bound of its relative error:
    !> what the last halving changed, or what the usual precision rounds.
    subroutine exact_influence(x, c_left, c_right, value, error)
        real(wp), intent(in) :: x        !! X, field point along the strip over the half-length
        real(qp), intent(in) :: c_left   !! left edge over the half-length, >= 0 or -c_right
        real(qp), intent(in) :: c_right  !! right edge over the half-length, > |c_left| or equal
        real(qp), intent(out) :: value   !! influence over the half-length
        real(wp), intent(out) :: error   !! relative

        real(qp) :: step, sum_, former, x_q
        integer :: halving

        x_q = abs(real(x, qp))
        step = first_step
        sum_ = nodes(x_q, c_left, c_right, 0.0_qp, step)
        value = step*sum_
        error = 1.0_wp
        do halving = 1, most_halvings
            former = value
            sum_ = sum_ + nodes(x_q, c_left, c_right, 0.5_qp*step, step)
            step = 0.5_qp*step
            value = step*sum_
            error = max(real(abs(value - former)/abs(value), wp), rounding)
            if (error <= enough) exit
        end do
        if (c_left < 0) value = 2*value
    end subroutine exact_influence

    !> Sum over the nodes `offset + k step` of both sides of the field point.
    real(qp) function nodes(x, c_left, c_right, offset, step)
        real(qp), intent(in) :: x, c_left, c_right, offset, step

        real(qp) :: cl, t, e, near, far, side(2), outside
        integer :: k, last, i, sides

        cl = max(c_left, 0.0_qp)
        outside = max(x - 1, 0.0_qp)
        sides = 1
        side = pi_q
        if (x < 1) then
            sides = 2
            side = [acos(x), pi_q - acos(x)]
        end if
        last = int(last_t/step)
        nodes = 0
        do k = -last, last
            t = offset + k*step
            e = exp(pi_q*sinh(t))
            near = e/(1 + e)
            far = 1/(1 + e)
            do i = 1, sides
                nodes = nodes + pi_q*cosh(t)*near*far*side(i)*weighted(side(i), near, far, outside)
            end do
        end do

    contains

        !> sin(a - tau)^2 times the kernel, tau = a near, a - tau = a far.
        real(qp) function weighted(a, near, far, outside)
            real(qp), intent(in) :: a, near, far, outside

            real(qp) :: delta

            delta = outside + 2*sin(0.5_qp*a*(1 + far))*sin(0.5_qp*a*near)
            if (cl > 0) then
                weighted = 2*atanh((c_right - cl)/(sqrt(delta**2 + cl**2) &
                                                   + sqrt(delta**2 + c_right**2)))
            else
                weighted = asinh(c_right/delta)
            end if
            weighted = sin(a*far)**2*weighted
        end function weighted
    end function nodes
end module faststrip_lab_studies_exact_influence
