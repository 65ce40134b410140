!> Interfaces of the LAPACK routines in use. Arguments are checked by the callers: a LAPACK
!> routine that finds a bad one writes to the standard output and stops.
module faststrip_numerics_lapack
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: dgetrf, dgetrs, dgecon, dgeqrf, dormqr, dtrtrs, dgesvd, dpbtrf, dpbtrs

    interface
        !> LU factors of a general matrix, in place; `info` > 0: singular.
        pure subroutine dgetrf(m, n, a, lda, ipiv, info)
            import :: wp
            integer, intent(in) :: m, n, lda
            real(wp), intent(inout) :: a(lda, *)
            integer, intent(out) :: ipiv(*)
            integer, intent(out) :: info
        end subroutine dgetrf

        !> Solve with the factors of `dgetrf`.
        pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
            import :: wp
            character(len=1), intent(in) :: trans
            integer, intent(in) :: n, nrhs, lda, ldb
            real(wp), intent(in) :: a(lda, *)
            integer, intent(in) :: ipiv(*)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(out) :: info
        end subroutine dgetrs

        !> Reciprocal condition number from the factors of `dgetrf`;
        !> `work` of length 4 n, `iwork` of length n.
        pure subroutine dgecon(norm, n, a, lda, anorm, rcond, work, iwork, info)
            import :: wp
            character(len=1), intent(in) :: norm
            integer, intent(in) :: n, lda
            real(wp), intent(in) :: a(lda, *)
            real(wp), intent(in) :: anorm
            real(wp), intent(out) :: rcond
            real(wp), intent(inout) :: work(*)
            integer, intent(inout) :: iwork(*)
            integer, intent(out) :: info
        end subroutine dgecon

        !> QR factors of a general matrix with m >= n, in place: R in the upper triangle, the
        !> reflectors below with `tau` of length n; `work` of length `lwork` >= n.
        pure subroutine dgeqrf(m, n, a, lda, tau, work, lwork, info)
            import :: wp
            integer, intent(in) :: m, n, lda, lwork
            real(wp), intent(inout) :: a(lda, *)
            real(wp), intent(out) :: tau(*)
            real(wp), intent(inout) :: work(*)
            integer, intent(out) :: info
        end subroutine dgeqrf

        !> Multiply by the Q of `dgeqrf`, `k` reflectors; `side` L: from the left, `trans` T: with
        !> its transpose; `work` of length `lwork` >= n.
        pure subroutine dormqr(side, trans, m, n, k, a, lda, tau, c, ldc, work, lwork, info)
            import :: wp
            character(len=1), intent(in) :: side, trans
            integer, intent(in) :: m, n, k, lda, ldc, lwork
            real(wp), intent(in) :: a(lda, *)
            real(wp), intent(in) :: tau(*)
            real(wp), intent(inout) :: c(ldc, *)
            real(wp), intent(inout) :: work(*)
            integer, intent(out) :: info
        end subroutine dormqr

        !> Solve with a triangular matrix; `info` > 0: singular.
        pure subroutine dtrtrs(uplo, trans, diag, n, nrhs, a, lda, b, ldb, info)
            import :: wp
            character(len=1), intent(in) :: uplo, trans, diag
            integer, intent(in) :: n, nrhs, lda, ldb
            real(wp), intent(in) :: a(lda, *)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(out) :: info
        end subroutine dtrtrs

        !> Singular values, descending, and with `jobu` = `jobvt` = S the vectors; `a` is
        !> destroyed; `work` of length `lwork` >= 5 max(m, n); `info` > 0: no convergence.
        !> Without vectors (N) LAPACK divides by zero on purpose, to see whether it may.
        pure subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
            import :: wp
            character(len=1), intent(in) :: jobu, jobvt
            integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
            real(wp), intent(inout) :: a(lda, *)
            real(wp), intent(out) :: s(*)
            real(wp), intent(out) :: u(ldu, *), vt(ldvt, *)
            real(wp), intent(inout) :: work(*)
            integer, intent(out) :: info
        end subroutine dgesvd

        !> Cholesky factor of a positive definite band matrix, in place; with `uplo` U the upper
        !> diagonals stand in the rows of `ab`, the main one in row kd + 1; `info` > 0: it is not
        !> positive definite.
        pure subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
            import :: wp
            character(len=1), intent(in) :: uplo
            integer, intent(in) :: n, kd, ldab
            real(wp), intent(inout) :: ab(ldab, *)
            integer, intent(out) :: info
        end subroutine dpbtrf

        !> Solve with the factor of `dpbtrf`.
        pure subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
            import :: wp
            character(len=1), intent(in) :: uplo
            integer, intent(in) :: n, kd, nrhs, ldab, ldb
            real(wp), intent(in) :: ab(ldab, *)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(out) :: info
        end subroutine dpbtrs
    end interface
end module faststrip_numerics_lapack
