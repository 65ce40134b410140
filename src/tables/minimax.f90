!> Minimax polynomials by Remez's exchange on a fine grid.
!>
!> The polynomial of a degree whose largest error over given points is least errs by the same
!> amount, with alternating sign, at degree + 2 of them (Chebyshev). The exchange starts from
!> spread points, levels the error there, moves to the extremes of each run of one sign (where
!> there are too few runs: moves one point to the largest error) and ends when none exceeds the
!> levelled error.
module faststrip_tables_minimax
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_linear_algebra, st_no_convergence, st_too_few_points
    use faststrip_base_text, only: integer_text
    use faststrip_numerics_lapack, only: dgetrf, dgetrs
    use faststrip_tables_polynomials, only: basis_chebyshev, basis_matrix
    implicit none
    private

    public :: fit_minimax

    integer, parameter :: most_exchanges = 60
    real(wp), parameter :: levelled = 1.0e-6_wp

contains

    !> Minimax polynomial through points.
    !>
    !> It ends when the largest error exceeds the levelled one by less than 1e-6 of it and 16
    !> units of rounding of the largest value.
    pure subroutine fit_minimax(low, high, x, y, c, deviation, status)
        real(wp), intent(in) :: low             !! lower end of the interval of the T_k
        real(wp), intent(in) :: high            !! upper end, > low
        real(wp), intent(in) :: x(:)            !! increasing points in it, best as dense near the
                                                !! ends as Chebyshev points; many per coefficient
        real(wp), intent(in) :: y(:)            !! finite values there
        real(wp), intent(out) :: c(0:)          !! coefficients of T_k; their number sets the degree
        real(wp), intent(out) :: deviation      !! largest error over the points
        type(status_t), intent(out) :: status   !! `st_too_few_points`, `st_linear_algebra`,
                                                !! `st_no_convergence`

        real(wp), allocatable :: matrix(:, :), error(:), trial(:)
        integer, allocatable :: reference(:)
        real(wp) :: level, worst, rounding
        integer :: exchange, n
        logical :: alternates

        call clear_status(status)
        c = 0.0_wp
        deviation = huge(1.0_wp)
        n = size(c)
        if (size(x) < n + 1 .or. size(y) /= size(x)) then
            call set_status(status, st_too_few_points, 'too few points for a minimax fit: ' &
                            // integer_text(size(x)))
            return
        end if
        allocate (matrix(size(x), 0:n - 1), error(size(x)), trial(0:n - 1), reference(n + 1))
        call basis_matrix(basis_chebyshev, low, high, x, matrix)
        rounding = 16.0_wp*epsilon(1.0_wp)*max(maxval(abs(y)), tiny(1.0_wp))
        call spread_points(size(x), reference)
        do exchange = 1, most_exchanges
            call level_errors(matrix, y, reference, trial, level, status)
            if (status%code /= 0) return
            error = y - matmul(matrix, trial)
            worst = maxval(abs(error))
            if (worst < deviation) then
                deviation = worst
                c = trial
            end if
            if (worst <= abs(level)*(1.0_wp + levelled) + rounding) return
            call exchange_points(error, reference, alternates)
            if (.not. alternates) call exchange_one_point(error, level, reference)
        end do
        if (deviation > rounding) call set_status(status, st_no_convergence, &
            'the exchange for a minimax polynomial of degree ' // integer_text(n - 1) // &
            ' did not level the errors: ' // trim(number_text(worst)) // ' against ' &
            // number_text(abs(level)))
    end subroutine fit_minimax

    ! Numbers of points that are spread evenly from the first to the last.
    pure subroutine spread_points(n_points, reference)
        integer, intent(in) :: n_points
        integer, intent(out) :: reference(:)
        integer :: k

        do k = 1, size(reference)
            reference(k) = 1 + nint(real(n_points - 1, wp)*(k - 1)/(size(reference) - 1))
        end do
    end subroutine spread_points

    ! The polynomial whose errors at the reference are level, -level, level, ...
    pure subroutine level_errors(matrix, y, reference, c, level, status)
        real(wp), intent(in) :: matrix(:, 0:), y(:)
        integer, intent(in) :: reference(:)
        real(wp), intent(out) :: c(0:), level
        type(status_t), intent(out) :: status

        real(wp) :: a(size(reference), size(reference)), right(size(reference), 1)
        integer :: pivot(size(reference)), n, k, info

        call clear_status(status)
        n = size(reference)
        do k = 1, n
            a(k, :n - 1) = matrix(reference(k), :)
            a(k, n) = real(2*modulo(k, 2) - 1, wp)
            right(k, 1) = y(reference(k))
        end do
        c = 0.0_wp
        level = 0.0_wp
        call dgetrf(n, n, a, n, pivot, info)
        if (info /= 0) then
            call set_status(status, st_linear_algebra, 'the equations of a minimax fit are ' // &
                            'singular')
            return
        end if
        call dgetrs('N', n, 1, a, n, pivot, right, n, info)
        c = right(:n - 1, 1)
        level = right(n, 1)
    end subroutine level_errors

    ! The extreme of each run of errors of one sign; of too many, the smaller end goes first.
    pure subroutine exchange_points(error, reference, alternates)
        real(wp), intent(in) :: error(:)
        integer, intent(inout) :: reference(:)
        logical, intent(out) :: alternates

        integer :: extreme(size(error)), n, first, i

        n = 0
        do i = 1, size(error)
            if (n > 0) then
                if ((error(i) < 0.0_wp) .eqv. (error(extreme(n)) < 0.0_wp)) then
                    if (abs(error(i)) > abs(error(extreme(n)))) extreme(n) = i
                    cycle
                end if
            end if
            n = n + 1
            extreme(n) = i
        end do
        first = 1
        alternates = n >= size(reference)
        if (.not. alternates) return
        do while (n - first + 1 > size(reference))
            if (abs(error(extreme(first))) < abs(error(extreme(n)))) then
                first = first + 1
            else
                n = n - 1
            end if
        end do
        reference = extreme(first:n)
    end subroutine exchange_points

    ! The point of the largest error takes the place of the neighbour in the reference whose
    ! levelled error has the same sign; beyond an end without one, of the point at the other end.
    pure subroutine exchange_one_point(error, level, reference)
        real(wp), intent(in) :: error(:), level
        integer, intent(inout) :: reference(:)

        integer :: worst, n, k
        logical :: odd

        n = size(reference)
        worst = maxloc(abs(error), dim=1)
        k = count(reference <= worst)
        ! Do the points with odd numbers have an error of the sign of the worst?
        odd = (level < 0.0_wp) .eqv. (error(worst) < 0.0_wp)
        if (k == 0) then
            if (.not. odd) reference = [0, reference(:n - 1)]
            reference(1) = worst
        else if (odd .eqv. modulo(k, 2) == 1) then
            reference(k) = worst
        else if (k < n) then
            reference(k + 1) = worst
        else
            reference = [reference(2:), worst]
        end if
    end subroutine exchange_one_point
end module faststrip_tables_minimax
