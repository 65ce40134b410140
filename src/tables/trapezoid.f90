!> The influence integral as the author of Table 1 computed it, recovered from his coefficients.
!>
!> The trapezoid rule with 500 panels on 0 <= u <= 1 of
!> `sqrt(1 - u^2) [asinh((2n+1) b/u) - asinh((2n-1) b/u)]`, at u = 0 its limit
!> `ln((2n+1)/(2n-1))`: one half of i_n(b), low by 3.0e-5 to 3.4e-5 because of the root at
!> u = 1. For n = 0 the integrand has no limit; there the first node is moved to u = 1.5e-4, the
!> choice that comes closest to the printed row 0 (7.6e-4 per coefficient, 1e-3 in E); none
!> reproduces it.
module faststrip_tables_trapezoid
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: trapezoid_influence

    integer, parameter :: n_panels = 500
    real(wp), parameter :: first_node = 1.5e-4_wp

contains

    !> i_n(b), both halves, to three to four digits; 0 for b <= 0.
    pure real(wp) function trapezoid_influence(n, b) result(value)
        integer, intent(in) :: n  !! distance of the strips in strips, its sign ignored
        real(wp), intent(in) :: b !! half-width over half-length, in [1e-10, 1e10]

        real(wp) :: u, outer, inner
        integer :: j

        value = 0.0_wp
        if (.not. b > 0.0_wp) return
        outer = (2.0_wp*abs(real(n, wp)) + 1.0_wp)*b
        inner = (2.0_wp*abs(real(n, wp)) - 1.0_wp)*b
        if (n == 0) then
            value = 0.5_wp*(asinh(outer/first_node) - asinh(inner/first_node))
        else
            value = 0.5_wp*log(outer/inner)
        end if
        do j = 1, n_panels - 1
            u = real(j, wp)/n_panels
            value = value + sqrt((1.0_wp - u)*(1.0_wp + u))*(asinh(outer/u) - asinh(inner/u))
        end do
        value = 2.0_wp*value/n_panels
    end function trapezoid_influence
end module faststrip_tables_trapezoid
