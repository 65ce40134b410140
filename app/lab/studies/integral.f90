!> `faststrip-lab bench integral`: what an influence coefficient costs by each method, and its
!> error.
!>
!> All methods are timed in turn, again and again; a figure is the median over the rounds (beside
!> it their 95th percentile and worst), and a
!> ratio the median of the ratios within the rounds, so that what else the machine does falls out.
module faststrip_lab_studies_integral
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_tables_polynomials, only: basis_monomial
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_polynomial, only: published_coefficients, table_last_distance
    use faststrip_tables_quadrature, only: quadrature_influence, quadrature_influence_2d
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row, fit_lsq
    use faststrip_influence_equal_column, only: influence_column
    use faststrip_lab_studies_exact_influence, only: exact_influence, qp
    use faststrip_lab_studies_polynomials, only: power_of_ten_influence, power_of_ten_row
    use faststrip_command_program_clock, only: median, spread_of
    use faststrip_command_program_console, only: fail_on_error, begin_table, end_table
    use faststrip_command_program_machine, only: machine_words
    implicit none
    private

    public :: bench_integral

    ! Scalar cases: every n with every b, each b a little different at each call.
    integer, parameter :: n_list(3) = [0, 1, 10]
    real(wp), parameter :: b_list(3) = [0.02_wp, 0.3_wp, 5.0_wp]
    integer, parameter :: last = table_last_distance
    integer, parameter :: n_arguments = 64
    ! Every so many-th b is judged.
    integer, parameter :: judged_step = 8
    integer, parameter :: n_judged = n_arguments/judged_step
    ! GSL is so slow that fewer rounds say as much.
    integer, parameter :: slow_rounds = 3
    ! Degrees of the fits: as published, as good as single precision, the most a monomial carries.
    integer, parameter :: fit_degree(3) = [6, 9, 12]
    integer, parameter :: n_tables = 1 + size(fit_degree)

    ! Methods: the published table and the fits come first.
    integer, parameter :: closed = n_tables + 1
    integer, parameter :: line = n_tables + 2
    integer, parameter :: area = n_tables + 3
    integer, parameter :: n_methods = n_tables + 3
    character(len=12), parameter :: method_name(n_methods) = [character(len=12) :: 'published', &
        'refit 6', 'refit 9', 'refit 12', 'closed', 'gsl 1-D', 'gsl 2-D']

    !> The coefficients of one table, of L itself: (row n + 1, power).
    type :: coefficients_t
        real(wp), allocatable :: c(:, :)
    end type coefficients_t

    !> One line of the result.
    type :: cost_t
        integer :: method = 0
        character(len=8) :: n = ''
        real(wp) :: b = 0.0_wp
        character(len=6) :: loop = ''
        real(wp), allocatable :: seconds(:) ! one a round
        real(wp) :: rel_err = 0.0_wp
        integer :: baseline = 0             ! the line a ratio is taken to
    end type cost_t

contains

    !> Time everything and write the CSV.
    subroutine bench_integral(path, rounds)
        character(len=*), intent(in) :: path !! of the CSV, or `-`
        integer, intent(in) :: rounds        !! how often everything is timed, >= 1

        type(coefficients_t) :: tables(n_tables)
        type(cost_t), allocatable :: cost(:)
        type(csv_writer_t) :: writer
        real(wp), dimension(0:last, n_arguments) :: values
        real(qp) :: exact(0:last, n_judged)
        real(wp) :: b(n_arguments), check
        integer :: method, i, j, round, at, first

        call begin_table(writer, path)
        call make_tables(tables)
        allocate (cost(n_methods*size(n_list)*size(b_list) + closed*size(b_list)))
        check = 0.0_wp
        do round = 1, rounds
            at = 0
            do j = 1, size(b_list)
                b = [(b_list(j)*(1.0_wp + 0.2_wp*(i - 1)/n_arguments), i=1, n_arguments)]
                if (round == 1) exact = exact_influences(b)
                do i = 1, size(n_list)
                    first = at + 1
                    do method = 1, n_methods
                        at = at + 1
                        if (round == 1) call start_cost(integer_text(n_list(i)), 'scalar', &
                                                        merge(min(rounds, slow_rounds), rounds, &
                                                              method > closed))
                        if (round > size(cost(at)%seconds)) cycle
                        call time_scalar(method, tables, n_list(i), b, values(0, :), &
                                         cost(at)%seconds(round), check)
                        if (round == 1) cost(at)%rel_err = &
                            largest_error(values(0:0, :), exact(n_list(i):n_list(i), :))
                    end do
                end do
                first = at + 1
                do method = 1, closed
                    at = at + 1
                    if (round == 1) call start_cost('0:' // integer_text(last), 'row', rounds)
                    call time_row(method, tables, b, values, cost(at)%seconds(round), check)
                    if (round == 1) cost(at)%rel_err = largest_error(values, exact)
                end do
            end do
        end do
        call write_costs(writer, cost)

    contains

        subroutine start_cost(n, loop, timed)
            character(len=*), intent(in) :: n, loop
            integer, intent(in) :: timed ! rounds

            allocate (cost(at)%seconds(timed))
            cost(at)%method = method
            cost(at)%n = n
            cost(at)%b = b_list(j)
            cost(at)%loop = loop
            cost(at)%baseline = first
        end subroutine start_cost
    end subroutine bench_integral

    !> The published table and fresh fits of one half of the integral.
    subroutine make_tables(tables)
        type(coefficients_t), intent(out) :: tables(n_tables)

        type(refit_plan_t) :: plan
        type(table_row_t) :: row
        type(status_t) :: status
        integer :: i, n, k

        allocate (tables(1)%c(0:last, 0:6))
        do n = 0, last
            do k = 0, 6
                tables(1)%c(n, k) = published_coefficients(6 - k, n)
            end do
        end do
        do i = 1, size(fit_degree)
            allocate (tables(i + 1)%c(0:last, 0:fit_degree(i)))
            call prepare_refit(refit_t(degree=fit_degree(i), basis=basis_monomial, fit=fit_lsq), &
                               plan, status)
            call fail_on_error(status)
            do n = 0, last
                call refit_row(plan, n, row, status)
                call fail_on_error(status)
                tables(i + 1)%c(n, :) = row%c(:fit_degree(i))
            end do
        end do
    end subroutine make_tables

    !> Seconds a call for one strip distance.
    subroutine time_scalar(method, tables, n, b, values, seconds, check)
        integer, intent(in) :: method, n
        type(coefficients_t), intent(in) :: tables(n_tables)
        real(wp), intent(in) :: b(n_arguments)
        real(wp), intent(out) :: values(n_arguments), seconds
        real(wp), intent(inout) :: check

        type(status_t) :: status
        real(wp) :: c(0:maxval(fit_degree)), abs_error
        integer(int64) :: start
        integer :: i, pass, passes, used, degree

        degree = 0
        if (method <= n_tables) then
            degree = size(tables(method)%c, 2) - 1
            c(:degree) = tables(method)%c(n, :)
        end if
        passes = 40
        used = n_arguments
        if (method == line) passes = 1
        if (method == area) then
            passes = 1
            used = 2
        end if
        call system_clock(start)
        do pass = 1, passes
            if (method <= n_tables) then
                do i = 1, used
                    values(i) = power_of_ten_influence(degree, c, b(i))
                end do
            else if (method == closed) then
                do i = 1, used
                    values(i) = strip_influence(n, b(i))
                end do
            else
                do i = 1, used
                    if (method == line) then
                        call quadrature_influence(n, b(i), 0.0_wp, values(i), abs_error, status)
                    else
                        call quadrature_influence_2d(n, b(i), 0.0_wp, values(i), abs_error, status)
                    end if
                    call fail_on_error(status)
                end do
            end if
            check = check + values(1 + mod(pass, used))
        end do
        seconds = seconds_since(start)/(passes*used)
        if (used < n_arguments) values(used + 1:) = strip_influence(n, b(used + 1:))
    end subroutine time_scalar

    !> Seconds a number for the row n = 0 to 20.
    subroutine time_row(method, tables, b, values, seconds, check)
        integer, intent(in) :: method
        type(coefficients_t), intent(in) :: tables(n_tables)
        real(wp), intent(in) :: b(n_arguments)
        real(wp), intent(out) :: values(0:last, n_arguments), seconds
        real(wp), intent(inout) :: check

        integer, parameter :: passes = 5
        integer(int64) :: start
        integer :: i, pass, degree

        degree = 0
        if (method <= n_tables) degree = size(tables(method)%c, 2) - 1
        call system_clock(start)
        do pass = 1, passes
            do i = 1, n_arguments
                if (method == closed) then
                    call influence_column(b(i), values(:, i))
                else
                    call power_of_ten_row(last + 1, degree, tables(method)%c, b(i), values(:, i))
                end if
            end do
            check = check + values(pass, pass)
        end do
        seconds = seconds_since(start)/(passes*n_arguments*(last + 1))
    end subroutine time_row

    real(wp) function seconds_since(start)
        integer(int64), intent(in) :: start

        integer(int64) :: now, rate

        call system_clock(now, rate)
        seconds_since = real(now - start, wp)/real(rate, wp)
    end function seconds_since

    !> What the methods are judged by, of some b.
    function exact_influences(b) result(exact)
        real(wp), intent(in) :: b(n_arguments)
        real(qp) :: exact(0:last, n_judged)

        real(qp) :: half_width
        real(wp) :: uncertainty
        integer :: i, n

        do i = 1, n_judged
            half_width = b(1 + (i - 1)*judged_step)
            do n = 0, last
                call exact_influence(0.0_wp, (2*n - 1)*half_width, (2*n + 1)*half_width, &
                                     exact(n, i), uncertainty)
            end do
        end do
    end function exact_influences

    pure real(wp) function largest_error(values, exact)
        real(wp), intent(in) :: values(:, :) ! of all b
        real(qp), intent(in) :: exact(:, :)  ! of those that are judged

        largest_error = real(maxval(abs(values(:, ::judged_step)/exact - 1)), wp)
    end function largest_error

    subroutine write_costs(writer, cost)
        type(csv_writer_t), intent(inout) :: writer
        type(cost_t), intent(in) :: cost(:)

        character(len=:), allocatable :: machine(:)
        real(wp) :: ns(3)
        integer :: i

        machine = machine_words()
        call put_header(writer, [character(len=8) :: 'method', 'n', 'b', 'loop', 'ns', 'ratio', &
                                 'rel_err', 'flags', 'compiler', 'cpu', 'ns_p95', 'ns_worst'])
        do i = 1, size(cost)
            call put_cell(writer, trim(method_name(cost(i)%method)))
            call put_cell(writer, trim(cost(i)%n))
            call put_cell(writer, cost(i)%b)
            call put_cell(writer, trim(cost(i)%loop))
            ns = 1.0e9_wp*spread_of(cost(i)%seconds)
            call put_cell(writer, ns(1))
            associate (own => cost(i)%seconds, base => cost(cost(i)%baseline)%seconds)
                call put_cell(writer, median(own/base(:size(own))))
            end associate
            call put_cell(writer, cost(i)%rel_err)
            call put_cells(writer, machine)
            call put_cells(writer, ns(2:3))
            call end_row(writer)
        end do
        call end_table(writer)
    end subroutine write_costs
end module faststrip_lab_studies_integral
