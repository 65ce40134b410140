!> LU factors of a general matrix, with the same bits for any number of threads.
!>
!> A threaded linear algebra library splits a factorisation among the threads it finds and rounds
!> accordingly. Here the order of all operations is fixed, and small matrices cost less: panels of
!> `panel` columns with partial pivoting, then the rest; two columns at a time in both.
module faststrip_numerics_lu
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: lu_factor, lu_solve

    ! Tuned [columns]: Columns factored together. Origin: chosen for the time: with 16 of them 33
    ! unknowns take 1.4 times as long; 400 take the same with any.
    integer, parameter :: panel = 64 ! a multiple of four
    ! Pivots outside are singular: so products of two, or of one and the reciprocal of another, stay
    ! within the numbers.
    real(wp), parameter :: least_pivot = sqrt(tiny(1.0_wp)), largest_pivot = 1.0_wp/least_pivot

contains

    !> Factors P A = L U in place.
    pure subroutine lu_factor(n, a, pivot, singular)
        integer, intent(in) :: n           !! order
        real(wp), intent(inout), contiguous :: a(:, :) !! the matrix, in the first n rows and
                                           !! columns; then U, and below it L, whose diagonal is 1
        integer, intent(inout) :: pivot(:) !! row exchanged with row k in step k, (n)
        logical, intent(out) :: singular   !! a pivot is below 1e-154 or above 1e154: not factored

        integer :: first, last, j, k, i
        real(wp) :: largest, other, factor

        singular = .true.
        do first = 1, n, panel
            last = min(first + panel - 1, n)
            do k = first, last
                pivot(k) = k
                largest = abs(a(k, k))
                do i = k + 1, n
                    if (abs(a(i, k)) > largest) then
                        largest = abs(a(i, k))
                        pivot(k) = i
                    end if
                end do
                if (.not. (largest > least_pivot .and. largest < largest_pivot)) return
                if (pivot(k) /= k) then
                    do j = 1, last
                        other = a(k, j)
                        a(k, j) = a(pivot(k), j)
                        a(pivot(k), j) = other
                    end do
                end if
                factor = 1.0_wp/a(k, k)
                a(k + 1:n, k) = a(k + 1:n, k)*factor
                do j = k + 1, last - 1, 2
                    factor = a(k, j)
                    other = a(k, j + 1)
                    !$omp simd
                    do i = k + 1, n
                        a(i, j) = a(i, j) - a(i, k)*factor
                        a(i, j + 1) = a(i, j + 1) - a(i, k)*other
                    end do
                end do
                if (mod(last - k, 2) == 0) cycle
                factor = a(k, last)
                !$omp simd
                do i = k + 1, n
                    a(i, last) = a(i, last) - a(i, k)*factor
                end do
            end do
            do j = last + 1, n, 2
                call subtract_panel(n, first, last, j, min(j + 1, n), a, pivot)
            end do
        end do
        singular = .false.
    end subroutine lu_factor

    !> Subtract what the columns of a panel take from two columns on their right.
    pure subroutine subtract_panel(n, first, last, j1, j2, a, pivot)
        integer, intent(in) :: n, first, last, j1, j2 ! j2 = j1: one column
        real(wp), intent(inout), contiguous :: a(:, :)
        integer, intent(in) :: pivot(:)

        integer :: i, j, k
        real(wp) :: other, f11, f21, f31, f41, f12, f22, f32, f42

        do j = j1, j2
            do k = first, last
                other = a(k, j)
                a(k, j) = a(pivot(k), j)
                a(pivot(k), j) = other
            end do
            do k = first, last - 1
                other = a(k, j)
                !$omp simd
                do i = k + 1, last
                    a(i, j) = a(i, j) - a(i, k)*other
                end do
            end do
        end do
        ! Every panel that has columns on its right is full.
        do k = first, last, 4
            f11 = a(k, j1)
            f21 = a(k + 1, j1)
            f31 = a(k + 2, j1)
            f41 = a(k + 3, j1)
            f12 = a(k, j2)
            f22 = a(k + 1, j2)
            f32 = a(k + 2, j2)
            f42 = a(k + 3, j2)
            if (j1 == j2) then
                !$omp simd
                do i = last + 1, n
                    a(i, j1) = a(i, j1) - ((a(i, k)*f11 + a(i, k + 1)*f21) &
                                           + (a(i, k + 2)*f31 + a(i, k + 3)*f41))
                end do
            else
                !$omp simd
                do i = last + 1, n
                    a(i, j1) = a(i, j1) - ((a(i, k)*f11 + a(i, k + 1)*f21) &
                                           + (a(i, k + 2)*f31 + a(i, k + 3)*f41))
                    a(i, j2) = a(i, j2) - ((a(i, k)*f12 + a(i, k + 1)*f22) &
                                           + (a(i, k + 2)*f32 + a(i, k + 3)*f42))
                end do
            end if
        end do
    end subroutine subtract_panel

    !> Solve with the factors.
    pure subroutine lu_solve(n, a, pivot, b)
        integer, intent(in) :: n         !! order
        real(wp), intent(in), contiguous :: a(:, :) !! factors of `lu_factor`
        integer, intent(in) :: pivot(:)  !! its exchanges
        real(wp), intent(inout), contiguous :: b(:) !! right-hand side, then solution, (n)

        integer :: i, k, rest
        real(wp) :: other, f1, f2, f3, f4

        do k = 1, n
            other = b(pivot(k))
            b(pivot(k)) = b(k)
            b(k) = other
        end do
        ! Four columns at a time, and before them those that are left over.
        rest = mod(n, 4)
        do k = 1, rest
            other = b(k)
            !$omp simd
            do i = k + 1, n
                b(i) = b(i) - a(i, k)*other
            end do
        end do
        do k = rest + 1, n, 4
            f1 = b(k)
            f2 = b(k + 1) - a(k + 1, k)*f1
            f3 = b(k + 2) - a(k + 2, k)*f1 - a(k + 2, k + 1)*f2
            f4 = b(k + 3) - a(k + 3, k)*f1 - a(k + 3, k + 1)*f2 - a(k + 3, k + 2)*f3
            b(k + 1) = f2
            b(k + 2) = f3
            b(k + 3) = f4
            !$omp simd
            do i = k + 4, n
                b(i) = b(i) - ((a(i, k)*f1 + a(i, k + 1)*f2) + (a(i, k + 2)*f3 + a(i, k + 3)*f4))
            end do
        end do
        do k = n - 3, rest + 1, -4
            f4 = b(k + 3)/a(k + 3, k + 3)
            f3 = (b(k + 2) - a(k + 2, k + 3)*f4)/a(k + 2, k + 2)
            f2 = (b(k + 1) - a(k + 1, k + 3)*f4 - a(k + 1, k + 2)*f3)/a(k + 1, k + 1)
            f1 = (b(k) - a(k, k + 3)*f4 - a(k, k + 2)*f3 - a(k, k + 1)*f2)/a(k, k)
            b(k) = f1
            b(k + 1) = f2
            b(k + 2) = f3
            b(k + 3) = f4
            !$omp simd
            do i = 1, k - 1
                b(i) = b(i) - ((a(i, k)*f1 + a(i, k + 1)*f2) + (a(i, k + 2)*f3 + a(i, k + 3)*f4))
            end do
        end do
        do k = rest, 1, -1
            other = b(k)/a(k, k)
            b(k) = other
            b(:k - 1) = b(:k - 1) - a(:k - 1, k)*other
        end do
    end subroutine lu_solve
end module faststrip_numerics_lu
