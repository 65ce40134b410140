!> Interfaces of the LAPACK routines in use. Arguments are checked by the callers: a LAPACK
!> routine that finds a bad one writes to the standard output and stops.
module faststrip_numerics_lapack
    use faststrip_kinds, only: wp
    implicit none
    private

    public :: dgtsv, dgetrf, dgetrs, dgecon

    interface
        !> Solve a tridiagonal system by elimination with partial pivoting; the three diagonals
        !> are destroyed, `b` receives the solution; `info` > 0: singular.
        pure subroutine dgtsv(n, nrhs, dl, d, du, b, ldb, info)
            import :: wp
            integer, intent(in) :: n, nrhs, ldb
            real(wp), intent(inout) :: dl(*), d(*), du(*)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(out) :: info
        end subroutine dgtsv

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
    end interface
end module faststrip_numerics_lapack
