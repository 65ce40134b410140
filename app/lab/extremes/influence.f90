!> Extremes of the influence integral: strips 1e-12 to 1e12 times as wide as long, a million strips
!> away, seen from the centre line and from anywhere else.
!>
!> The widths b have seven bits, so that the edges (2n - 1)b, (2n + 1)b are doubles and every
!> method answers the same question.
module faststrip_lab_extremes_influence
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_out_of_range
    use faststrip_files_csv, only: csv_writer_t
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_polynomial, only: table_influence, table_last_distance
    use faststrip_tables_quadrature, only: quadrature_influence
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row
    use faststrip_influence_equal_column, only: influence_column
    use faststrip_influence_offcentre_column, only: influence_column_gradient
    use faststrip_tables_polynomials, only: basis_chebyshev, polynomial_value
    use faststrip_lab_grid_cases, only: read_rows
    use faststrip_lab_extremes_rows, only: row_t, put_row, status_of
    use faststrip_command_program_console, only: fail_on_error, progress
    use faststrip_lab_studies_exact_influence, only: exact_influence, reference_name, qp
    implicit none
    private

    public :: references_t, read_references, influence_extremes

    character(len=*), parameter :: chapter = 'influence'
    integer, parameter :: distances(10) = [0, 1, 2, 5, 10, 100, 1000, 10000, 100000, 1000000]
    real(wp), parameter :: places(9) = [0.3_wp, 0.9_wp, 0.999999_wp, 1.0_wp, 1.000001_wp, &
                                        1.1_wp, 3.0_wp, 1.0e3_wp, 1.0e6_wp]
    integer, parameter :: refit_degree = 16

    !> Committed influence coefficients.
    type :: references_t
        real(wp), allocatable :: figures(:, :) !! distance n, b, value; off the centre line X, too
    end type references_t

contains

    !> Read the committed numbers; ends the program if they cannot be read.
    subroutine read_references(folder, references)
        character(len=*), intent(in) :: folder           !! of the files
        type(references_t), intent(out) :: references(2) !! on the centre line and off it

        character(len=*), parameter :: names(4) = [character(len=5) :: 'n', 'b', 'value', 'X']

        call read_rows(folder // '/reference_center.csv', [character(len=3) :: 'n', 'b', 'i_n'], &
                       references(1)%figures)
        call read_rows(folder // '/reference_offcenter.csv', names, references(2)%figures)
    end subroutine read_references

    !> Measure and write.
    subroutine influence_extremes(quick, references, writer)
        logical, intent(in) :: quick                !! few points
        type(references_t), intent(in) :: references(2) !! from `read_references`
        type(csv_writer_t), intent(inout) :: writer !! an open file

        type(table_row_t) :: refits(0:table_last_distance)
        integer :: step, k

        call make_refits(refits)
        step = merge(6, 1, quick)
        do k = -24, 24, step
            call progress('strip widths', k + 25, 49)
            call centre_line(width(k), refits, quick, writer)
            if (mod(k, 2) == 0) call off_centre(width(k), quick, writer)
        end do
        call committed(references(1), .false., quick, writer)
        call committed(references(2), .true., quick, writer)
    end subroutine influence_extremes

    !> About 10**(k/2), with seven bits.
    pure real(wp) function width(k)
        integer, intent(in) :: k

        real(wp) :: wanted

        wanted = 10.0_wp**(0.5_wp*k)
        width = set_exponent(anint(64*set_exponent(wanted, 1))/64, exponent(wanted))
    end function width

    !> Fresh fits of the rows that are looked at, over the range of the published table.
    subroutine make_refits(refits)
        type(table_row_t), intent(out) :: refits(0:table_last_distance)

        type(refit_plan_t) :: plan
        type(status_t) :: status
        integer :: n

        call prepare_refit(refit_t(degree=refit_degree, basis=basis_chebyshev), plan, status)
        call fail_on_error(status)
        do n = 0, table_last_distance
            if (all(distances /= n)) cycle
            call refit_row(plan, n, refits(n), status)
            call fail_on_error(status)
        end do
    end subroutine make_refits

    !> 2 * 10**E(log10 b); a fit is not asked outside its range.
    subroutine refit_value(refits, n, b, value, status)
        type(table_row_t), intent(in) :: refits(0:table_last_distance)
        integer, intent(in) :: n
        real(wp), intent(in) :: b
        real(wp), intent(out) :: value
        type(status_t), intent(out) :: status

        real(wp) :: l

        value = 0.0_wp
        l = log10(b)
        if (n > table_last_distance) then
            call set_status(status, st_out_of_range, 'no row for this distance')
        else if (l < refits(n)%l_min .or. l > refits(n)%l_max) then
            call set_status(status, st_out_of_range, 'outside the range of the fit')
        else
            call clear_status(status)
            associate (row => refits(n))
                value = 2.0_wp*10.0_wp**polynomial_value(row%basis, row%c(:row%degree), &
                                                         row%l_min, row%l_max, l)
            end associate
        end if
    end subroutine refit_value

    !> The relative error, and what is not known of it.
    pure real(wp) function bound(value, exact, uncertainty)
        real(wp), intent(in) :: value, uncertainty
        real(qp), intent(in) :: exact

        bound = real(abs(value - exact)/abs(exact), wp) + uncertainty
    end function bound

    subroutine centre_line(b, refits, quick, writer)
        real(wp), intent(in) :: b
        type(table_row_t), intent(in) :: refits(0:table_last_distance)
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        real(wp) :: column(0:table_last_distance), value, abs_error, uncertainty
        real(qp) :: exact
        type(status_t) :: status
        type(row_t) :: row
        integer :: i, n

        call influence_column(b, column)
        do i = 1, size(distances), merge(3, 1, quick)
            n = distances(i)
            call exact_influence(0.0_wp, (2*n - 1)*real(b, qp), (2*n + 1)*real(b, qp), exact, &
                                 uncertainty)
            row = row_t(chapter=chapter, case='centre', x_name='b', x=b, y_name='n', &
                        y=real(n, wp), quantity='rel_err', reference=reference_name)
            call clear_status(status)
            call put('closed', strip_influence(n, b))
            if (n <= table_last_distance) call put('column', column(n))
            call quadrature_influence(n, b, 0.0_wp, value, abs_error, status)
            call put('gsl', value)
            call table_influence(n, b, value, status)
            call put('published', value)
            call refit_value(refits, n, b, value, status)
            call put('refit', value)
        end do

    contains

        subroutine put(method, computed)
            character(len=*), intent(in) :: method
            real(wp), intent(in) :: computed

            row%method = method
            call status_of(status, row)
            row%value = bound(computed, exact, uncertainty)
            call put_row(writer, row)
        end subroutine put
    end subroutine centre_line

    subroutine off_centre(b, quick, writer)
        real(wp), intent(in) :: b
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        integer, parameter :: own_distances(4) = [0, 1, 10, 1000000]
        real(wp) :: cl, cr, value, d_x, d_half_length, abs_error, uncertainty
        real(wp), dimension(1) :: column, d_xs, d_halfs
        real(qp) :: exact
        type(status_t) :: status
        type(row_t) :: row
        integer :: i, j, n

        do i = 1, size(own_distances), merge(3, 1, quick)
            n = own_distances(i)
            cl = (2*n - 1)*b
            cr = (2*n + 1)*b
            do j = 1, size(places), merge(2, 1, quick)
                row = row_t(chapter=chapter, x_name='b', x=b, y_name='X', y=places(j), &
                            quantity='rel_err', reference=reference_name)
                write (row%case, '(a, i0)') 'n = ', n
                call exact_influence(places(j), real(cl, qp), real(cr, qp), exact, uncertainty)
                call clear_status(status)
                call put('closed', strip_influence_at(places(j), cl, cr))
                call strip_influence_gradient(places(j), 1.0_wp, cl, cr, value, d_x, d_half_length)
                call put('gradient', value)
                call influence_column_gradient(1.0_wp, cl, cr, places(j:j), [0.0_wp], &
                                               column, d_xs, d_halfs)
                call put('column', column(1))
                call quadrature_influence(n, b, places(j), value, abs_error, status)
                call put('gsl', value)
            end do
        end do

    contains

        ! Again as on the centre line: what it writes is its host's.
        subroutine put(method, computed)
            character(len=*), intent(in) :: method
            real(wp), intent(in) :: computed

            row%method = method
            call status_of(status, row)
            row%value = bound(computed, exact, uncertainty)
            call put_row(writer, row)
        end subroutine put
    end subroutine off_centre

    !> The reference itself and the closed form, against committed numbers of 30 digits, of which a
    !> double keeps 16.
    subroutine committed(references, is_off_centre, quick, writer)
        type(references_t), intent(in) :: references
        logical, intent(in) :: is_off_centre, quick
        type(csv_writer_t), intent(inout) :: writer

        type(row_t) :: row
        real(wp) :: x, uncertainty
        real(qp) :: exact
        integer :: i

        x = 0.0_wp
        do i = 1, size(references%figures, 1), merge(30, 1, quick)
            if (is_off_centre) x = references%figures(i, 4)
            associate (n => references%figures(i, 1), b => references%figures(i, 2), &
                       known => references%figures(i, 3))
                row = row_t(chapter='references', x_name='b', x=b, y_name='X', y=x, &
                            quantity='rel_err', reference='committed')
                write (row%case, '(a, i0)') 'n = ', nint(n)
                call exact_influence(x, (2*n - 1)*real(b, qp), (2*n + 1)*real(b, qp), exact, &
                                     uncertainty)
                row%method = reference_name
                row%value = abs(real(exact/known - 1, wp)) + uncertainty
                call put_row(writer, row)
                row%method = 'closed'
                if (is_off_centre) then
                    row%value = strip_influence_at(x, (2*n - 1)*b, (2*n + 1)*b)
                else
                    row%value = strip_influence(nint(n), b)
                end if
                row%value = abs(row%value - known)/known
                call put_row(writer, row)
            end associate
        end do
    end subroutine committed
end module faststrip_lab_extremes_influence
