!> Polynomials on an interval, in powers of the variable or in Chebyshev polynomials.
!>
!> `p(x) = sum c_k phi_k(x)`, k = 0 to the degree, with `phi_k = x^k` (monomial: the interval does
!> not matter) or `phi_k = T_k((2x - low - high)/(high - low))` (Chebyshev). Evaluation is by
!> Horner's or Clenshaw's rule and good outside the interval too.
module faststrip_tables_polynomials
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: basis_monomial, basis_chebyshev
    public :: polynomial_value, basis_matrix, chebyshev_to_monomial

    integer, parameter :: basis_monomial = 1
    integer, parameter :: basis_chebyshev = 2

contains

    !> p(x).
    pure real(wp) function polynomial_value(basis, c, low, high, x) result(value)
        integer, intent(in) :: basis     !! `basis_monomial` or `basis_chebyshev`
        real(wp), intent(in) :: c(0:)    !! coefficients
        real(wp), intent(in) :: low      !! lower end of the interval
        real(wp), intent(in) :: high     !! upper end, > low
        real(wp), intent(in) :: x        !! anywhere

        real(wp) :: t, next, after
        integer :: k

        if (basis == basis_monomial) then
            value = 0.0_wp
            do k = ubound(c, 1), 0, -1
                value = value*x + c(k)
            end do
        else
            t = on_unit_interval(low, high, x)
            next = 0.0_wp
            after = 0.0_wp
            do k = ubound(c, 1), 1, -1
                value = 2.0_wp*t*next - after + c(k)
                after = next
                next = value
            end do
            value = t*next - after + c(0)
        end if
    end function polynomial_value

    !> The matrix phi_k(x_i), i down, k = 0 to the degree across.
    pure subroutine basis_matrix(basis, low, high, x, matrix)
        integer, intent(in) :: basis             !! `basis_monomial` or `basis_chebyshev`
        real(wp), intent(in) :: low              !! lower end of the interval
        real(wp), intent(in) :: high             !! upper end, > low
        real(wp), intent(in) :: x(:)             !! points
        real(wp), intent(out) :: matrix(:, 0:)   !! size(x) rows, degree + 1 columns

        real(wp) :: t(size(x))
        integer :: k

        t = x
        if (basis == basis_chebyshev) t = on_unit_interval(low, high, x)
        matrix(:, 0) = 1.0_wp
        if (ubound(matrix, 2) >= 1) matrix(:, 1) = t
        do k = 2, ubound(matrix, 2)
            matrix(:, k) = t*matrix(:, k - 1)
            if (basis == basis_chebyshev) matrix(:, k) = 2.0_wp*matrix(:, k) - matrix(:, k - 2)
        end do
    end subroutine basis_matrix

    !> The coefficients of the powers of x of a sum of Chebyshev polynomials.
    pure subroutine chebyshev_to_monomial(c, low, high, a)
        real(wp), intent(in) :: c(0:)            !! coefficients of T_k
        real(wp), intent(in) :: low              !! lower end of the interval
        real(wp), intent(in) :: high             !! upper end, > low
        real(wp), intent(out) :: a(0:)           !! coefficients of x^k, as many

        real(wp), dimension(0:size(c) - 1) :: before, now, next
        real(wp) :: slope, offset
        integer :: k, degree

        degree = size(c) - 1
        slope = 2.0_wp/(high - low)
        offset = -(low + high)/(high - low)
        before = 0.0_wp
        now = 0.0_wp
        now(0) = 1.0_wp
        a = c(0)*now
        do k = 1, degree
            next = offset*now
            next(1:) = next(1:) + slope*now(:degree - 1)
            if (k > 1) next = 2.0_wp*next - before
            before = now
            now = next
            a = a + c(k)*now
        end do
    end subroutine chebyshev_to_monomial

    elemental real(wp) function on_unit_interval(low, high, x) result(t)
        real(wp), intent(in) :: low, high, x

        t = ((x - low) - (high - x))/(high - low)
    end function on_unit_interval
end module faststrip_tables_polynomials
