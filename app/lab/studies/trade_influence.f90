!> The part of `faststrip-lab bench trade` on influence coefficients inside the strip method.
!>
!> The largest patch of each contact is cut into 21 strips of equal width, as the published table
!> needs it, with the lengths of the solved strips. Pressures and penetration then follow from
!> closing the gap on the centre lines under the load, a linear system whose matrix every method
!> fills in its own way; the errors are those against the closed evaluation.
module faststrip_lab_studies_trade_influence
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error, status_word, st_ok
    use faststrip_files_csv, only: csv_writer_t, put_cell, put_cells, put_empty_cells, end_row
    use faststrip_base_material, only: normal_compliance
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_polynomial, only: table_influence
    use faststrip_tables_quadrature, only: quadrature_influence
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row, fit_minimax_error
    use faststrip_tables_trapezoid, only: trapezoid_influence
    use faststrip_contact_method, only: workspace_t
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_geometry_gap_curve, only: gap_at
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_lab_studies_polynomials, only: power_of_ten_influence
    use faststrip_command_program_clock, only: cpu_microseconds, spread_of, spread_names
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_lab_grid_cases, only: bench_case_t
    implicit none
    private

    public :: trade_influence

    integer, parameter :: strips_across = 21
    integer, parameter :: refit_degrees(2) = [6, 12]
    integer, parameter :: closed = 1, published = 2, refit_low = 3, refit_high = 4, &
                          trapezoid = 5, quadrature = 6, n_methods = 6
    character(len=*), parameter :: names(n_methods) = [character(len=28) :: &
        'closed evaluation', 'published polynomial', 'refitted, degree 6', 'refitted, degree 12', &
        'trapezoids, as the author''s', 'quadrature by GSL']

    !> Strips of equal width and what loads them.
    type :: lattice_t
        real(wp) :: width = 0.0_wp                !! mm
        real(wp) :: load = 0.0_wp                 !! N, of this patch
        real(wp) :: compliance = 0.0_wp           !! H, 1/MPa
        real(wp) :: half_length(strips_across) = 0.0_wp !! mm
        real(wp) :: height(strips_across) = 0.0_wp      !! gap on the centre lines, mm
    end type lattice_t

contains

    !> Rows of stage `influence` for a list of contacts.
    subroutine trade_influence(writer, cases, n_figures)
        type(csv_writer_t), intent(inout) :: writer !! an open file, at the start of a row
        type(bench_case_t), intent(in) :: cases(:)  !! contacts
        integer, intent(in) :: n_figures            !! columns of errors, >= 2

        type(table_row_t) :: rows(0:strips_across - 1, size(refit_degrees))
        type(lattice_t) :: lattice
        real(wp) :: p0(strips_across, n_methods), depth(n_methods)
        real(wp) :: us(size(spread_names), n_methods)
        type(status_t) :: status(n_methods)
        integer :: i, m

        call make_refits(rows)
        do i = 1, size(cases)
            call make_lattice(cases(i), lattice)
            do m = 1, n_methods
                call solve_lattice(lattice, m, rows, p0(:, m), depth(m), us(:, m), status(m))
            end do
            do m = 1, n_methods
                call put_cell(writer, cases(i)%set)
                call put_cell(writer, cases(i)%name)
                call put_cell(writer, 'influence')
                call put_cell(writer, trim(names(m)))
                call put_cell(writer, 'strip')
                call put_cell(writer, 'none')
                call put_cell(writer, trim(status_word(status(m)%code)))
                if (is_error(status(m))) then
                    call put_empty_cells(writer, n_figures + 1)
                else
                    call put_cells(writer, [us(1, m), depth(m)/depth(closed) - 1.0_wp, &
                                            maxval(abs(p0(:, m) - p0(:, closed))) &
                                            /maxval(p0(:, closed))])
                    call put_empty_cells(writer, n_figures - 2)
                end if
                call put_cells(writer, us(:, m), is_known=.not. is_error(status(m)))
                ! No time of a normal solution alone.
                call put_empty_cells(writer, size(us, 1))
                call end_row(writer)
            end do
        end do
    end subroutine trade_influence

    subroutine make_refits(rows)
        type(table_row_t), intent(out) :: rows(0:, :)

        type(refit_plan_t) :: plan
        type(status_t) :: status
        integer :: d, n

        do d = 1, size(refit_degrees)
            call prepare_refit(refit_t(degree=refit_degrees(d), fit=fit_minimax_error), plan, &
                               status)
            call fail_on_error(status)
            do n = 0, ubound(rows, 1)
                call refit_row(plan, n, rows(n, d), status)
                call fail_on_error(status)
            end do
        end do
    end subroutine make_refits

    !> Equal strips over the largest patch; squared lengths between those of the solution.
    subroutine make_lattice(case, lattice)
        type(bench_case_t), intent(in) :: case
        type(lattice_t), intent(out) :: lattice

        type(workspace_t) :: workspace
        type(normal_result_t) :: result
        type(status_t) :: status
        real(wp), allocatable :: y(:), square(:)
        real(wp) :: from, to, place, inv2r, t
        integer :: k, j, n, largest

        call solve_by_strips(workspace, case, strips_across, result, status)
        call fail_on_error(status, case%name)
        associate (strips => workspace%strips)
            largest = 1
            do k = 2, strips%n_patches
                if (count(strips%patch(:strips%n) == k) &
                    > count(strips%patch(:strips%n) == largest)) largest = k
            end do
            n = count(strips%patch(:strips%n) == largest)
            j = findloc(strips%patch(:strips%n), largest, dim=1)
            from = strips%y_left(j)
            to = strips%y_right(j + n - 1)
            y = [from, 0.5_wp*(strips%y_left(j:j + n - 1) + strips%y_right(j:j + n - 1)), to]
            square = [0.0_wp, strips%half_length(j:j + n - 1)**2, 0.0_wp]
            lattice%width = (to - from)/strips_across
            lattice%compliance = normal_compliance(case%material)
            lattice%load = sum(0.5_wp*pi*strips%p0(j:j + n - 1)*strips%half_length(j:j + n - 1) &
                               *(strips%y_right(j:j + n - 1) - strips%y_left(j:j + n - 1)))
            do k = 1, strips_across
                place = from + (k - 0.5_wp)*lattice%width
                j = count(y(2:size(y) - 1) <= place) + 1
                t = (place - y(j))/(y(j + 1) - y(j))
                lattice%half_length(k) = sqrt((1.0_wp - t)*square(j) + t*square(j + 1))
                call gap_at(workspace%solver%curve, place, lattice%height(k), inv2r)
            end do
            lattice%height = lattice%height - workspace%solver%curve%h_lowest
        end associate
    end subroutine make_lattice

    !> Fill the matrix by one method and solve for pressures and penetration; the time is that of
    !> filling it.
    subroutine solve_lattice(lattice, method, rows, p0, depth, us, status)
        type(lattice_t), intent(in) :: lattice
        integer, intent(in) :: method
        type(table_row_t), intent(in) :: rows(0:, :)
        real(wp), intent(out) :: p0(:), depth
        real(wp), intent(out) :: us(:) !! of some runs, as `spread_of` has them
        type(status_t), intent(out) :: status

        integer, parameter :: n = strips_across, runs = 5
        real(wp) :: matrix(n + 1, n + 1), right(n + 1), times(runs), before
        integer :: pivot(n + 1), run
        logical :: singular

        p0 = 0.0_wp
        depth = 0.0_wp
        do run = 1, merge(1, runs, method == quadrature)
            before = cpu_microseconds()
            call fill(lattice, method, rows, matrix, status)
            times(run) = cpu_microseconds() - before
            us = spread_of(times(:run))
        end do
        if (is_error(status)) return
        matrix(:n, n + 1) = -1.0_wp
        matrix(n + 1, :n) = 0.5_wp*pi*lattice%half_length*lattice%width/lattice%load
        matrix(n + 1, n + 1) = 0.0_wp
        right(:n) = -lattice%height
        right(n + 1) = 1.0_wp
        call lu_factor(n + 1, matrix, pivot, singular)
        call lu_solve(n + 1, matrix, pivot, right)
        p0 = right(:n)
        depth = right(n + 1)
    end subroutine solve_lattice

    subroutine fill(lattice, method, rows, matrix, status)
        type(lattice_t), intent(in) :: lattice
        integer, intent(in) :: method
        type(table_row_t), intent(in) :: rows(0:, :)
        real(wp), intent(inout) :: matrix(:, :)
        type(status_t), intent(out) :: status

        real(wp) :: b, value, ignored
        integer :: s, k, distance, degree

        status%code = st_ok
        do s = 1, strips_across
            b = 0.5_wp*lattice%width/lattice%half_length(s)
            do k = 1, strips_across
                distance = abs(k - s)
                select case (method)
                case (closed); value = strip_influence(distance, b)
                case (published); call table_influence(distance, b, value, status)
                case (refit_low, refit_high)
                    degree = refit_degrees(method - refit_low + 1)
                    value = power_of_ten_influence(degree, &
                                                   rows(distance, method - refit_low + 1)%c, b)
                case (trapezoid); value = trapezoid_influence(distance, b)
                case (quadrature)
                    call quadrature_influence(distance, b, 0.0_wp, value, ignored, status)
                end select
                if (is_error(status)) return
                matrix(k, s) = lattice%compliance*lattice%half_length(s)*value
            end do
        end do
    end subroutine fill
end module faststrip_lab_studies_trade_influence
