!> What the core needs of LAPACK, in the place of `src/faststrip/numerics/lapack.f90`, which has the
!> interfaces: a library built with this one needs neither LAPACK nor BLAS. CMake takes it where
!> FASTSTRIP_OWN_LAPACK is on, as of the Python wheel.
!>
!> The same eliminations in the same order as LAPACK's, but in plain loops, which do for systems of
!> few diagonals. Arguments are checked by the callers; a triangle but the upper one is told.
module faststrip_numerics_lapack
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: dpbtrf, dpbtrs

contains

    !> Cholesky factor of a positive definite band matrix, in place; with `uplo` U the upper
    !> diagonals stand in the rows of `ab`, the main one in row kd + 1; `info` > 0: it is not
    !> positive definite.
    pure subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
        character(len=1), intent(in) :: uplo
        integer, intent(in) :: n, kd, ldab
        real(wp), intent(inout) :: ab(ldab, *)
        integer, intent(out) :: info

        integer :: i, j, k, last

        info = merge(0, -1, uplo == 'U')
        if (info /= 0) return
        do j = 1, n
            ! So that a number that is none is told too.
            if (.not. ab(kd + 1, j) > 0.0_wp) then
                info = j
                return
            end if
            ab(kd + 1, j) = sqrt(ab(kd + 1, j))
            last = min(kd, n - j)
            do k = 1, last
                ab(kd + 1 - k, j + k) = ab(kd + 1 - k, j + k)/ab(kd + 1, j)
            end do
            do k = 1, last
                do i = 1, k
                    ab(kd + 1 + i - k, j + k) = ab(kd + 1 + i - k, j + k) &
                                                - ab(kd + 1 - i, j + i)*ab(kd + 1 - k, j + k)
                end do
            end do
        end do
    end subroutine dpbtrf

    !> Solve with the factor of `dpbtrf`.
    pure subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
        character(len=1), intent(in) :: uplo
        integer, intent(in) :: n, kd, nrhs, ldab, ldb
        real(wp), intent(in) :: ab(ldab, *)
        real(wp), intent(inout) :: b(ldb, *)
        integer, intent(out) :: info

        real(wp) :: rest
        integer :: i, j, k

        info = merge(0, -1, uplo == 'U')
        if (info /= 0) return
        do k = 1, nrhs
            do j = 1, n
                rest = b(j, k)
                do i = max(1, j - kd), j - 1
                    rest = rest - ab(kd + 1 + i - j, j)*b(i, k)
                end do
                b(j, k) = rest/ab(kd + 1, j)
            end do
            do j = n, 1, -1
                b(j, k) = b(j, k)/ab(kd + 1, j)
                do i = max(1, j - kd), j - 1
                    b(i, k) = b(i, k) - ab(kd + 1 + i - j, j)*b(j, k)
                end do
            end do
        end do
    end subroutine dpbtrs
end module faststrip_numerics_lapack
