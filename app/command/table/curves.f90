!> CSV files for the pictures about coefficient tables.
module faststrip_command_table_curves
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t, put_header, put_comment, put_cell, end_row, &
                                  abort_csv, put_cells, put_empty_cells
    use faststrip_tables_polynomials, only: basis_monomial, basis_chebyshev, polynomial_value
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_polynomial, only: published_coefficients, table_last_distance
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row, row_relative_error, fit_lsq, fit_minimax_error, &
                                      most_degree
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    implicit none
    private

    public :: write_curves, write_degrees, published_row

contains

    !> A row of Table 1 as published, not measured.
    type(table_row_t) function published_row(n) result(row)
        integer, intent(in) :: n !! distance of the strips in strips, 0 to 20

        row%n = n
        row%degree = 6 ! Given: of Table 1
        row%c(:6) = published_coefficients(6:0:-1, n)
    end function published_row

    !> Exact integral and published polynomial for L from -4 to 3 in steps of 0.01.
    subroutine write_curves(path, n)
        character(len=*), intent(in) :: path !! file, or - for stdout
        integer, intent(in) :: n(:)          !! strip distances; from 21 on nothing is published

        ! Given: L from -4 to 3.
        integer, parameter :: first = -400, last = 300
        type(csv_writer_t) :: writer
        type(table_row_t) :: row
        real(wp) :: l, b
        integer :: i, j

        call begin_table(writer, path)
        call put_comment(writer, 'exact: i_n(b), b = 10**L; published: 2*10**E(L) of Table 1, ' &
                         // 'made for L from -2 to 1; rel_err: published/exact - 1')
        call put_header(writer, [character(len=9) :: 'n', 'L', 'b', 'exact', 'published', &
                                 'rel_err'])
        do i = 1, size(n)
            if (n(i) <= table_last_distance) row = published_row(n(i))
            do j = first, last
                l = 0.01_wp*j ! Given: steps of L
                b = 10.0_wp**l ! Given: a decimal logarithm
                call put_cell(writer, n(i))
                call put_cells(writer, [l, b, strip_influence(n(i), b)])
                if (n(i) <= table_last_distance) then
                    ! Given: as published.
                    call put_cells(writer, [2.0_wp*10.0_wp**polynomial_value( &
                                            row%basis, row%c(:6), -2.0_wp, 1.0_wp, l), &
                                            row_relative_error(row, l)])
                else
                    call put_empty_cells(writer, 2)
                end if
                call end_row(writer)
            end do
        end do
        call end_table(writer)
    end subroutine write_curves

    !> Errors of fits of degree 0 to 40 in both bases. Fits too ill-conditioned for `faststrip
    !> table` are made all the same, from the singular values: the picture shows why they are
    !> refused. A fit that fails leaves its errors empty.
    subroutine write_degrees(path, n, l_min, l_max)
        character(len=*), intent(in) :: path !! file, or - for stdout
        integer, intent(in) :: n(:)          !! strip distances
        real(wp), intent(in) :: l_min, l_max !! range of log10 b

        character(len=9), parameter :: basis_words(2) = ['monomial ', 'chebyshev']
        integer, parameter :: bases(2) = [basis_monomial, basis_chebyshev]
        character(len=7), parameter :: fit_words(2) = ['lsq    ', 'minimax']
        integer, parameter :: fits(2) = [fit_lsq, fit_minimax_error]
        type(csv_writer_t) :: writer
        type(status_t) :: status
        type(refit_plan_t) :: plan
        type(table_row_t) :: row
        integer :: basis, fit, degree, i

        ! What is wrong with the range shows before the file is opened.
        call prepare_refit(refit_t(l_min=l_min, l_max=l_max, degree=0), plan, status)
        call fail_on_error(status)
        call begin_table(writer, path)
        call put_header(writer, [character(len=11) :: 'basis', 'fit', 'n', 'degree', &
                                 'max_rel_err', 'rms_rel_err', 'condition'])
        do basis = 1, size(bases)
            do fit = 1, size(fits)
                do degree = 0, most_degree
                    call prepare_refit(refit_t(l_min, l_max, degree, bases(basis), fits(fit)), &
                                       plan, status, forced=.true.)
                    if (is_error(status)) call abort_csv(writer)
                    call fail_on_error(status)
                    do i = 1, size(n)
                        call refit_row(plan, n(i), row, status)
                        call put_cell(writer, trim(basis_words(basis)))
                        call put_cell(writer, trim(fit_words(fit)))
                        call put_cell(writer, n(i))
                        call put_cell(writer, degree)
                        if (is_error(status)) then
                            call put_empty_cells(writer, 2)
                        else
                            call put_cells(writer, [row%max_rel_err, row%rms_rel_err])
                        end if
                        call put_cell(writer, plan%condition)
                        call end_row(writer)
                    end do
                    call progress('degree', degree, most_degree)
                end do
            end do
        end do
        call end_table(writer)
    end subroutine write_degrees
end module faststrip_command_table_curves
