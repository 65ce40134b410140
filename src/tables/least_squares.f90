!> Linear least squares with one matrix and many right-hand sides.
!>
!> The matrix is factored once, its columns scaled to length 1, `A = Q R D` by Householder
!> reflectors. The singular values of R D are those of A and give its condition number. Up to
!> condition `svd_condition` a solution is `D^-1 R^-1 Q^T y`; above, R^-1 is formed from the
!> singular values of R, those below rounding left out.
module faststrip_tables_least_squares
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_linear_algebra, &
                                     st_too_few_points
    use faststrip_base_text, only: integer_text
    use faststrip_numerics_lapack, only: dgeqrf, dormqr, dtrtrs, dgesvd
    implicit none
    private

    public :: least_squares_t, factor_least_squares, solve_least_squares

    !> From this condition number on solutions come from the singular values: there the relative
    !> error of R^-1 reaches the square root of rounding.
    real(wp), parameter :: svd_condition = 1.0e8_wp

    !> A factored matrix.
    type :: least_squares_t
        integer :: n_rows = 0                       !! number of equations
        integer :: n_columns = 0                    !! number of unknowns
        real(wp) :: condition = 0.0_wp              !! largest over smallest singular value; at
                                                    !! most 1e300
        logical :: by_svd = .false.                 !! do solutions come from singular values?
        real(wp), allocatable :: length(:)          !! of the columns
        real(wp), allocatable :: qr(:, :), tau(:)   !! QR factors of the scaled matrix
        real(wp), allocatable :: s(:), u(:, :), vt(:, :) !! and the singular values of its R
    end type least_squares_t

contains

    !> Factor a matrix and find its condition number.
    pure subroutine factor_least_squares(matrix, factors, status)
        real(wp), intent(in) :: matrix(:, :)          !! finite, at least as many rows as columns
        type(least_squares_t), intent(out) :: factors !! for `solve_least_squares`
        type(status_t), intent(out) :: status         !! `st_too_few_points`, `st_linear_algebra`

        real(wp), allocatable :: r(:, :), work(:)
        integer :: m, n, k, info

        call clear_status(status)
        m = size(matrix, 1)
        n = size(matrix, 2)
        if (m < n) then
            call set_status(status, st_too_few_points, &
                            'points must be as many as coefficients, got ' &
                            // integer_text(m) // ' for ' // integer_text(n))
            return
        end if
        factors%n_rows = m
        factors%n_columns = n
        allocate (factors%qr(m, n), factors%tau(n), factors%length(n))
        allocate (factors%s(n), factors%u(n, n), factors%vt(n, n), r(n, n), work(64*n))
        do k = 1, n
            factors%length(k) = norm2(matrix(:, k))
            if (.not. factors%length(k) > 0.0_wp) factors%length(k) = 1.0_wp
            factors%qr(:, k) = matrix(:, k)/factors%length(k)
        end do
        work = 0.0_wp
        call dgeqrf(m, n, factors%qr, m, factors%tau, work, size(work), info)
        r = 0.0_wp
        do k = 1, n
            r(:k, k) = factors%qr(:k, k)*factors%length(k)
        end do
        call dgesvd('S', 'S', n, n, r, n, factors%s, factors%u, n, factors%vt, n, work, &
                    size(work), info)
        if (info == 0) then
            associate (least => max(factors%s(n), 1.0e-300_wp*factors%s(1), tiny(1.0_wp)))
                factors%condition = factors%s(1)/least
            end associate
            factors%by_svd = factors%condition > svd_condition
            r = 0.0_wp
            do k = 1, n
                r(:k, k) = factors%qr(:k, k)
            end do
            call dgesvd('S', 'S', n, n, r, n, factors%s, factors%u, n, factors%vt, n, work, &
                        size(work), info)
        end if
        if (info /= 0) call set_status(status, st_linear_algebra, 'the singular values of a ' // &
                                       'matrix of ' // integer_text(n) // ' columns were not found')
    end subroutine factor_least_squares

    !> The vector that makes the sum of squares of `matrix c - y` least.
    pure subroutine solve_least_squares(factors, y, c, status)
        type(least_squares_t), intent(in) :: factors !! from `factor_least_squares`
        real(wp), intent(in) :: y(:)                 !! n_rows finite numbers
        real(wp), intent(out) :: c(:)                !! n_columns numbers; 0 on an error
        type(status_t), intent(out) :: status        !! `st_too_few_points`, `st_linear_algebra`

        real(wp) :: work(64*max(1, factors%n_columns)), qty(size(y), 1)
        integer :: n, k, info

        call clear_status(status)
        c = 0.0_wp
        n = factors%n_columns
        if (n == 0 .or. size(y) /= factors%n_rows .or. size(c) /= n) then
            call set_status(status, st_too_few_points, 'not as many values as the matrix has ' &
                            // 'rows: ' // integer_text(size(y)))
            return
        end if
        qty(:, 1) = y
        work = 0.0_wp
        call dormqr('L', 'T', size(y), 1, n, factors%qr, size(y), factors%tau, qty, size(y), &
                    work, size(work), info)
        if (factors%by_svd) then
            do k = 1, n
                if (factors%s(k) <= epsilon(1.0_wp)*n*factors%s(1)) exit
                c = c + dot_product(factors%u(:, k), qty(:n, 1))/factors%s(k)*factors%vt(k, :)
            end do
        else
            call dtrtrs('U', 'N', 'N', n, 1, factors%qr, size(y), qty, size(y), info)
            if (info /= 0) then
                call set_status(status, st_linear_algebra, 'a least-squares matrix is singular')
                return
            end if
            c = qty(:n, 1)
        end if
        c = c/factors%length
    end subroutine solve_least_squares
end module faststrip_tables_least_squares
