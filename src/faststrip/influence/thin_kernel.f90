!> The kernel of a thin strip in powers of its half-width.
!>
!> With h the half-width of a strip, c its middle less the field point's y,
!> s = sqrt(delta^2 + c^2) and xi = (c/s)^2, the kernel of faststrip_influence_offcentre is
!>
!>     ker = (2h/s) sum_k (h/s)^(2k) P_2k(c/s)/(2k + 1) = (2h/s) sum_m C_m(h^2/c^2) xi^m:
!>
!> one square root and one division.
module faststrip_influence_thin_kernel
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: expand_kernel, last_power

    integer :: i_, k_

    !> The largest k: of form 4; form f ends with k = 2f.
    !> Given: the powers that are written out below.
    integer, parameter :: last_power = 8
    ! Coefficient of t^(2j) in P_2k(t), over 2k + 1.
    real(wp), parameter :: legendre(0:last_power, 0:last_power) = reshape( &
        [((merge((-1.0_wp)**(k_ - i_)*gamma(2.0_wp*(k_ + i_) + 1.0_wp) &
                 /(4.0_wp**k_*gamma(max(k_ - i_, 0) + 1.0_wp)*gamma(k_ + i_ + 1.0_wp) &
                   *gamma(2.0_wp*i_ + 1.0_wp)*(2*k_ + 1)), 0.0_wp, i_ <= k_), &
           i_=0, last_power), k_=0, last_power)], [last_power + 1, last_power + 1])

contains

    !> The C_m: C_m = sum_k legendre(m - k, k) t^k with t = (h/c)^2 and k up to 2 form.
    !>
    !> Written out, for it is called once for each field point.
    pure subroutine expand_kernel(form, cl, cr, c)
        integer, intent(in) :: form                  !! 1, 2, 3 or 4
        real(wp), intent(in) :: cl                   !! the nearer edge less the field point's y
        real(wp), intent(in) :: cr                   !! the farther edge less the field point's y
        real(wp), intent(out) :: c(0:2*last_power)   !! C_m, m = 0, ..., 4 form; others undefined

        real(wp), parameter :: l(0:last_power, 0:last_power) = legendre
        real(wp) :: t, t2, t3, t4, t5, t6, t7, t8

        t = ((cr - cl)/(cr + cl))**2
        t2 = t*t
        c(0) = 1.0_wp
        c(1) = t*l(0, 1)
        c(2) = t*(l(1, 1) + t*l(0, 2))
        c(3) = t2*l(1, 2)
        c(4) = t2*l(2, 2)
        if (form == 1) return
        t3 = t2*t
        t4 = t2*t2
        c(3) = c(3) + t3*l(0, 3)
        c(4) = c(4) + t3*(l(1, 3) + t*l(0, 4))
        c(5) = t3*(l(2, 3) + t*l(1, 4))
        c(6) = t3*(l(3, 3) + t*l(2, 4))
        c(7) = t4*l(3, 4)
        c(8) = t4*l(4, 4)
        if (form == 2) return
        t5 = t3*t2
        t6 = t3*t3
        c(5) = c(5) + t5*l(0, 5)
        c(6) = c(6) + t5*(l(1, 5) + t*l(0, 6))
        c(7) = c(7) + t5*(l(2, 5) + t*l(1, 6))
        c(8) = c(8) + t5*(l(3, 5) + t*l(2, 6))
        c(9) = t5*(l(4, 5) + t*l(3, 6))
        c(10) = t5*(l(5, 5) + t*l(4, 6))
        c(11) = t6*l(5, 6)
        c(12) = t6*l(6, 6)
        if (form == 3) return
        t7 = t4*t3
        t8 = t4*t4
        c(7) = c(7) + t7*l(0, 7)
        c(8) = c(8) + t7*(l(1, 7) + t*l(0, 8))
        c(9) = c(9) + t7*(l(2, 7) + t*l(1, 8))
        c(10) = c(10) + t7*(l(3, 7) + t*l(2, 8))
        c(11) = c(11) + t7*(l(4, 7) + t*l(3, 8))
        c(12) = c(12) + t7*(l(5, 7) + t*l(4, 8))
        c(13) = t7*(l(6, 7) + t*l(5, 8))
        c(14) = t7*(l(7, 7) + t*l(6, 8))
        c(15) = t8*l(7, 8)
        c(16) = t8*l(8, 8)
    end subroutine expand_kernel
end module faststrip_influence_thin_kernel
