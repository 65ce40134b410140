!> Polynomials for the influence integral as a fast program would evaluate them: Horner's rule,
!> `exp` for the power of ten, no checks. A file of its own, so that a call is a call.
module faststrip_lab_studies_polynomials
    use faststrip_base_kinds, only: wp, log_10
    implicit none
    private

    public :: power_of_ten_influence, power_of_ten_row

    real(wp), parameter :: log_2 = 0.693147180559945309417232121458176568_wp
    real(wp), parameter :: log10_e = 1.0_wp/log_10

contains

    !> `2*10**E(L)`, L = log10 b.
    pure real(wp) function power_of_ten_influence(degree, c, b) result(value)
        integer, intent(in) :: degree       !! of E
        real(wp), intent(in) :: c(0:degree) !! coefficients of the powers of L
        real(wp), intent(in) :: b           !! half-width over half-length

        real(wp) :: t, e
        integer :: k

        t = log(b)*log10_e
        e = c(degree)
        do k = degree - 1, 0, -1
            e = e*t + c(k)
        end do
        value = exp(log_10*e + log_2)
    end function power_of_ten_influence

    !> The same for the rows n = 0, 1, ... of a table: one logarithm, the rest side by side.
    pure subroutine power_of_ten_row(rows, degree, c, b, value)
        integer, intent(in) :: rows, degree
        real(wp), intent(in) :: c(rows, 0:degree) !! coefficients of the powers of L
        real(wp), intent(in) :: b                 !! half-width over half-length
        real(wp), intent(out) :: value(rows)      !! one a row

        real(wp) :: t
        integer :: i, k

        t = log(b)*log10_e
        value = c(:, degree)
        do k = degree - 1, 1, -1
            value = value*t + c(:, k)
        end do
        !$omp simd
        do i = 1, rows
            value(i) = exp(log_10*(value(i)*t + c(i, 0)) + log_2)
        end do
    end subroutine power_of_ten_row
end module faststrip_lab_studies_polynomials
