!> Coefficient tables for the influence integral, made anew: a row is the polynomial
!> `E(L) = sum c_k phi_k(L)`, `L = log10 b`, whose `10**E` approximates i_n(b) or one half of it.
!>
!> Three fits:
!>
!> * least squares of E at 3001 nodes uniform in L,
!> * minimax: least largest relative error `|10**E/exact - 1|`. Remez's exchange on 4001
!>   Chebyshev points levels the error of E itself, at +-h; a polynomial may be shifted by a
!>   constant, so that the least relative error is `tanh(h ln 10)`, after a shift of
!>   `-log10(cosh(h ln 10))`,
!> * the author's, recovered from his coefficients: b = 0.01(0.01)10, unweighted least squares of
!>   E, the integral by a trapezoid rule. Rows n = 1 to 5 of Table 1 come out within 1e-5, rows 6
!>   to 20 within 2e-4; row 0 is not reproducible.
!>
!> Every row carries its error against the exact integral, measured on 6001 points uniform in L;
!> the largest is then refined by a golden-section search between the neighbours of its point.
module faststrip_tables_refit
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi, log_10
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_out_of_range, st_linear_algebra, &
                                     st_not_finite
    use faststrip_base_text, only: integer_text
    use faststrip_tables_polynomials, only: basis_monomial, basis_chebyshev, basis_matrix, &
                                            polynomial_value, chebyshev_to_monomial
    use faststrip_tables_least_squares, only: least_squares_t, factor_least_squares, &
                                              solve_least_squares
    use faststrip_tables_minimax, only: fit_minimax
    use faststrip_influence_closed, only: strip_influence
    use faststrip_tables_trapezoid, only: trapezoid_influence
    implicit none
    private

    public :: refit_t, table_row_t, refit_plan_t
    public :: prepare_refit, refit_row, measure_row, check_row, row_relative_error
    public :: fit_lsq, fit_minimax_error, fit_author
    public :: most_degree, most_distance, error_points

    integer, parameter :: fit_lsq = 1
    integer, parameter :: fit_minimax_error = 2
    integer, parameter :: fit_author = 3

    integer, parameter :: most_degree = 40        !! highest degree of a row
    integer, parameter :: most_distance = 10000   !! largest strip distance of a row
    real(wp), parameter :: most_l = 8.0_wp        !! rows end at |log10 b| = 8
    real(wp), parameter :: most_coefficient = 1.0e100_wp !! largest coefficient taken
    real(wp), parameter :: least_width = 0.01_wp  !! narrowest range of L

    !> Beyond this condition number a fit is refused: its coefficients would have no more than
    !> four digits that mean something.
    real(wp), parameter :: condition_limit = 1.0e12_wp

    integer, parameter :: lsq_nodes = 3001
    integer, parameter :: minimax_nodes = 4001
    integer, parameter :: author_nodes = 1000
    integer, parameter :: error_points = 6001     !! points on which the error of a row is measured

    real(wp), parameter :: log10_2 = 0.301029995663981195213738894724493027_wp

    !> What to fit.
    type :: refit_t
        real(wp) :: l_min = -2.0_wp         !! lower end of the range of L = log10 b
        real(wp) :: l_max = 1.0_wp          !! upper end
        integer :: degree = 6               !! 0 to 40
        integer :: basis = basis_monomial   !! of L, or Chebyshev polynomials on the range
        integer :: fit = fit_lsq            !! `fit_lsq`, `fit_minimax_error` or `fit_author`
        logical :: half = .true.            !! is one half of the integral approximated?
    end type refit_t

    !> One row of a table, with its error against the exact integral.
    type :: table_row_t
        integer :: n = 0                            !! distance of the strips in strips
        real(wp) :: l_min = -2.0_wp                 !! lower end of the range of L = log10 b
        real(wp) :: l_max = 1.0_wp                  !! upper end
        logical :: half = .true.                    !! is 10**E one half of the integral?
        integer :: basis = basis_monomial           !! of the coefficients
        integer :: degree = 0                       !! highest k
        real(wp) :: c(0:most_degree) = 0.0_wp       !! coefficients, 0 beyond the degree
        real(wp) :: max_rel_err = 0.0_wp            !! largest |10**E/exact - 1| on the range
        real(wp) :: max_at = 0.0_wp                 !! the L of it
        real(wp) :: rms_rel_err = 0.0_wp            !! root mean square of it
    end type table_row_t

    !> A fit made ready for any number of rows.
    type :: refit_plan_t
        type(refit_t) :: spec                       !! what is fitted
        real(wp) :: condition = 0.0_wp              !! of the basis on the nodes
        real(wp), allocatable :: l(:)               !! nodes
        type(least_squares_t) :: factors            !! of the basis on the nodes
    end type refit_plan_t

contains

    !> Choose nodes and factor the basis on them.
    !>
    !> A fit whose condition number is beyond 1e12 is refused, with the number and the remedy,
    !> unless `forced`: then it is made from the singular values above rounding.
    pure subroutine prepare_refit(spec, plan, status, forced)
        type(refit_t), intent(in) :: spec        !! what to fit
        type(refit_plan_t), intent(out) :: plan  !! for `refit_row`
        type(status_t), intent(out) :: status    !! `st_bad_argument`, `st_not_finite`,
                                                 !! `st_out_of_range`, `st_linear_algebra`
        logical, intent(in), optional :: forced  !! make it whatever its condition

        real(wp), allocatable :: matrix(:, :)
        logical :: refuse

        call check_spec(spec, status)
        if (is_error(status)) return
        plan%spec = spec
        call choose_nodes(spec, plan%l)
        allocate (matrix(size(plan%l), 0:spec%degree))
        call basis_matrix(spec%basis, spec%l_min, spec%l_max, plan%l, matrix)
        call factor_least_squares(matrix, plan%factors, status)
        plan%condition = plan%factors%condition
        if (is_error(status)) return
        refuse = plan%condition > condition_limit
        if (present(forced)) refuse = refuse .and. .not. forced
        if (refuse) call refuse_condition(plan, status)
    end subroutine prepare_refit

    pure subroutine refuse_condition(plan, status)
        type(refit_plan_t), intent(in) :: plan
        type(status_t), intent(out) :: status

        character(len=:), allocatable :: words

        words = 'degree ' // integer_text(plan%spec%degree) // ' on L = ' &
                // trim(number_text(plan%spec%l_min)) // ' to ' &
                // trim(number_text(plan%spec%l_max)) // ' has condition ' &
                // trim(number_text(plan%condition)) // ', beyond ' &
                // trim(number_text(condition_limit)) &
                // ': double precision does not carry its coefficients; '
        if (plan%spec%basis == basis_monomial) then
            words = 'monomials: ' // words // 'take --basis chebyshev'
        else
            words = 'nodes uniform in b: ' // words // 'take --fit lsq'
        end if
        call set_status(status, st_linear_algebra, words)
    end subroutine refuse_condition

    pure subroutine check_spec(spec, status)
        type(refit_t), intent(in) :: spec
        type(status_t), intent(out) :: status

        call check_range(spec%l_min, spec%l_max, status)
        if (is_error(status)) return
        if (spec%degree < 0 .or. spec%degree > most_degree) then
            call set_status(status, st_bad_argument, 'the degree must be 0 to ' &
                            // integer_text(most_degree) // ', got ' // integer_text(spec%degree))
        else if (spec%basis /= basis_monomial .and. spec%basis /= basis_chebyshev) then
            call set_status(status, st_bad_argument, 'no such basis: ' &
                            // integer_text(spec%basis))
        else if (all(spec%fit /= [fit_lsq, fit_minimax_error, fit_author])) then
            call set_status(status, st_bad_argument, 'no such fit: ' // integer_text(spec%fit))
        else if (spec%fit == fit_author .and. &
                 (spec%l_min /= -2.0_wp .or. spec%l_max /= 1.0_wp)) then
            call set_status(status, st_bad_argument, 'the author''s nodes b = 0.01(0.01)10 go ' &
                            // 'with the range -2:1 only, not ' // trim(number_text(spec%l_min)) &
                            // ':' // number_text(spec%l_max))
        end if
    end subroutine check_spec

    pure subroutine check_range(l_min, l_max, status)
        real(wp), intent(in) :: l_min, l_max
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. (ieee_is_finite(l_min) .and. ieee_is_finite(l_max))) then
            call set_status(status, st_not_finite, 'the range of log10 b must be finite, got ' &
                            // trim(number_text(l_min)) // ':' // number_text(l_max))
        else if (l_min < -most_l .or. l_max > most_l) then
            call set_status(status, st_out_of_range, 'the range of log10 b must be within +-' // &
                            trim(number_text(most_l)) // ', got ' // trim(number_text(l_min)) &
                            // ':' // number_text(l_max))
        else if (l_max - l_min < least_width) then
            call set_status(status, st_bad_argument, 'log10 b must have a range of at least ' // &
                            trim(number_text(least_width)) // ', got ' // trim(number_text(l_min)) &
                            // ':' // number_text(l_max))
        end if
    end subroutine check_range

    !> Is a row fit to be evaluated and measured?
    pure subroutine check_row(row, status)
        type(table_row_t), intent(in) :: row   !! from a file, say
        type(status_t), intent(out) :: status  !! `st_bad_argument`, `st_not_finite`,
                                               !! `st_out_of_range`

        type(refit_t) :: spec
        integer :: k

        spec%l_min = row%l_min
        spec%l_max = row%l_max
        spec%degree = row%degree
        spec%basis = row%basis
        call check_spec(spec, status)
        if (is_error(status)) return
        call check_distance(row%n, status)
        if (is_error(status)) return
        do k = 0, row%degree
            if (.not. ieee_is_finite(row%c(k))) then
                call set_status(status, st_not_finite, 'coefficient ' // integer_text(k) // &
                                ' is not finite')
                return
            else if (abs(row%c(k)) > most_coefficient) then
                call set_status(status, st_out_of_range, 'coefficient ' // integer_text(k) // &
                                ' must be within 1e100, got ' // number_text(row%c(k)))
                return
            end if
        end do
    end subroutine check_row

    pure subroutine check_distance(n, status)
        integer, intent(in) :: n
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (n < 0 .or. n > most_distance) call set_status(status, st_out_of_range, &
            'the strip distance must be 0 to ' // integer_text(most_distance) // ', got ' &
            // integer_text(n))
    end subroutine check_distance

    pure subroutine choose_nodes(spec, l)
        type(refit_t), intent(in) :: spec
        real(wp), allocatable, intent(out) :: l(:)

        integer :: j, last

        select case (spec%fit)
        case (fit_author)
            l = [(log10(0.01_wp*j), j=1, author_nodes)]
        case (fit_minimax_error)
            last = minimax_nodes - 1
            l = [(cos(pi*real(last - j, wp)/last), j=0, last)]
            l = 0.5_wp*(spec%l_min*(1.0_wp - l) + spec%l_max*(1.0_wp + l))
        case default
            l = [(uniform_point(spec%l_min, spec%l_max, j, lsq_nodes), j=1, lsq_nodes)]
        end select
    end subroutine choose_nodes

    elemental real(wp) function uniform_point(low, high, j, n) result(x)
        real(wp), intent(in) :: low, high
        integer, intent(in) :: j, n

        x = (low*(n - j) + high*(j - 1))/(n - 1)
    end function uniform_point

    !> E = log10 of i_n(b), or of one half of it, by the closed form.
    elemental real(wp) function log_influence(n, l, half) result(e)
        integer, intent(in) :: n     !! distance of the strips in strips
        real(wp), intent(in) :: l    !! log10 b, |l| <= 9
        logical, intent(in) :: half  !! of one half?

        e = log10(strip_influence(n, 10.0_wp**l))
        if (half) e = e - log10_2
    end function log_influence

    !> Fit one row and measure it.
    pure subroutine refit_row(plan, n, row, status)
        type(refit_plan_t), intent(in) :: plan  !! from `prepare_refit`
        integer, intent(in) :: n                !! distance of the strips in strips, 0 to 10000
        type(table_row_t), intent(out) :: row   !! coefficients and errors
        type(status_t), intent(out) :: status   !! `st_out_of_range`, `st_linear_algebra`,
                                                !! `st_no_convergence`

        real(wp), allocatable :: e(:)
        real(wp) :: deviation
        integer :: j

        call check_distance(n, status)
        if (is_error(status)) return
        associate (spec => plan%spec, degree => plan%spec%degree)
            row%n = n
            row%l_min = spec%l_min
            row%l_max = spec%l_max
            row%half = spec%half
            row%basis = spec%basis
            row%degree = degree
            if (spec%fit == fit_author) then
                e = [(log10(trapezoid_influence(n, 0.01_wp*j)), j=1, size(plan%l))]
                if (spec%half) e = e - log10_2
            else
                e = log_influence(n, plan%l, spec%half)
            end if
            if (spec%fit == fit_minimax_error) then
                call fit_minimax(spec%l_min, spec%l_max, plan%l, e, row%c(:degree), deviation, &
                                 status)
                row%c(0) = row%c(0) - log10(cosh(min(deviation, 100.0_wp)*log_10))
                if (spec%basis == basis_monomial) then
                    e = row%c(:degree)
                    call chebyshev_to_monomial(e, spec%l_min, spec%l_max, row%c(:degree))
                end if
            else
                call solve_least_squares(plan%factors, e, row%c(:degree), status)
            end if
        end associate
        if (is_error(status)) return
        call measure_row(row)
    end subroutine refit_row

    !> Relative error `10**E/exact - 1` of a row, inside its range or outside; at most 1e100.
    elemental real(wp) function row_relative_error(row, l) result(error)
        type(table_row_t), intent(in) :: row  !! as `check_row` lets pass
        real(wp), intent(in) :: l             !! log10 b, |l| <= 9

        real(wp) :: e, exponent

        e = polynomial_value(row%basis, row%c(:row%degree), row%l_min, row%l_max, l)
        exponent = log_10*max(-100.0_wp, min(100.0_wp, e - log_influence(row%n, l, row%half)))
        error = 2.0_wp*exp(0.5_wp*exponent)*sinh(0.5_wp*exponent)
    end function row_relative_error

    !> Fill in the errors of a row.
    pure subroutine measure_row(row)
        type(table_row_t), intent(inout) :: row !! as `check_row` lets pass

        real(wp), parameter :: golden = 0.618033988749894848204586834365638118_wp
        integer, parameter :: n_sections = 40
        real(wp), dimension(error_points) :: l, error
        real(wp) :: low, high, inner, outer, inner_error, outer_error
        integer :: i, worst

        l = uniform_point(row%l_min, row%l_max, [(i, i=1, error_points)], error_points)
        error = abs(row_relative_error(row, l))
        worst = maxloc(error, dim=1)
        row%rms_rel_err = norm2(error)/sqrt(real(error_points, wp))
        row%max_rel_err = error(worst)
        row%max_at = l(worst)
        low = l(max(worst - 1, 1))
        high = l(min(worst + 1, error_points))
        inner = high - golden*(high - low)
        outer = low + golden*(high - low)
        inner_error = abs(row_relative_error(row, inner))
        outer_error = abs(row_relative_error(row, outer))
        do i = 1, n_sections
            if (inner_error > outer_error) then
                high = outer
                outer = inner
                outer_error = inner_error
                inner = high - golden*(high - low)
                inner_error = abs(row_relative_error(row, inner))
            else
                low = inner
                inner = outer
                inner_error = outer_error
                outer = low + golden*(high - low)
                outer_error = abs(row_relative_error(row, outer))
            end if
        end do
        if (max(inner_error, outer_error) > row%max_rel_err) then
            row%max_rel_err = max(inner_error, outer_error)
            row%max_at = merge(inner, outer, inner_error > outer_error)
        end if
    end subroutine measure_row
end module faststrip_tables_refit
