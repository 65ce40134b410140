!> Interfaces of the BLAS and LAPACK routines in single precision that are in use: for what only
!> preconditions.
module faststrip_kalker_single
    use, intrinsic :: iso_fortran_env, only: real32
    implicit none
    private

    public :: sp, sgemv, sgetrf, sgetri

    !> Single precision.
    !> Given: the kind.
    integer, parameter :: sp = real32

    interface
        !> `y = alpha A x + beta y`, `trans` N; m rows, n columns.
        pure subroutine sgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
            import :: sp
            character(len=1), intent(in) :: trans
            integer, intent(in) :: m, n, lda, incx, incy
            real(sp), intent(in) :: alpha, beta
            real(sp), intent(in) :: a(lda, *), x(*)
            real(sp), intent(inout) :: y(*)
        end subroutine sgemv

        !> LU factors of a general matrix, in place; `info` > 0: singular.
        pure subroutine sgetrf(m, n, a, lda, ipiv, info)
            import :: sp
            integer, intent(in) :: m, n, lda
            real(sp), intent(inout) :: a(lda, *)
            integer, intent(out) :: ipiv(*)
            integer, intent(out) :: info
        end subroutine sgetrf

        !> Inverse from the factors of `sgetrf`, in place; `work` of length `lwork` >= n.
        pure subroutine sgetri(n, a, lda, ipiv, work, lwork, info)
            import :: sp
            integer, intent(in) :: n, lda, lwork
            real(sp), intent(inout) :: a(lda, *)
            integer, intent(in) :: ipiv(*)
            real(sp), intent(inout) :: work(*)
            integer, intent(out) :: info
        end subroutine sgetri
    end interface
end module faststrip_kalker_single
