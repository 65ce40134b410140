!> Extremes of the normal problem, against Hertz's exact solution: strips from 3 to 1000, ellipses
!> of all proportions under all loads, gaps that are all but conformal and given by few or by
!> many points.
module faststrip_lab_extremes_normal
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_files_csv, only: csv_writer_t
    use faststrip_influence_center_column, only: center_influence_column
    use faststrip_numerics_lapack, only: dgetrf, dgecon
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_lab_grid_ellipse, only: make_ellipse, make_parabola
    use faststrip_lab_extremes_rows, only: row_t, put_value, status_of
    use faststrip_command_program_console, only: progress
    implicit none
    private

    public :: normal_extremes

    integer, parameter :: strip_counts(13) = [3, 5, 9, 15, 21, 31, 61, 101, 201, 301, 401, 701, &
                                              1000]
    real(wp), parameter :: few_ratios(5) = [1.0e-2_wp, 0.1_wp, 1.0_wp, 10.0_wp, 100.0_wp]
    integer, parameter :: most_at_every_ratio = 201, most_quick = 31
    integer, parameter :: point_counts(10) = [5, 6, 7, 10, 20, 50, 200, 1000, 5000, 20000]
    integer, parameter :: usual_strips = 15, usual_points = 401
    real(wp), parameter :: usual_load = 1.0e5_wp                   ! N
    real(wp), parameter :: wheel_inv2r = 0.5_wp/460.0_wp           ! 1/mm

contains

    !> Measure and write.
    subroutine normal_extremes(quick, writer)
        logical, intent(in) :: quick                !! few points
        type(csv_writer_t), intent(inout) :: writer !! an open file

        type(workspace_t) :: work

        call many_strips(work, quick, writer)
        call all_ellipses(work, quick, writer)
        call flat_gaps(work, quick, writer)
    end subroutine normal_extremes

    !> Few and many strips on ellipses, with the condition of the matrix that gives pressures.
    subroutine many_strips(work, quick, writer)
        type(workspace_t), intent(inout) :: work
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(contact_case_t) :: contact
        type(normal_result_t) :: known
        type(row_t) :: row
        integer :: i, j

        contact%load = usual_load
        do i = 1, size(few_ratios), merge(2, 1, quick)
            call progress('ellipses with many strips', i, size(few_ratios))
            call make_ellipse(few_ratios(i), usual_points, contact, known)
            do j = 1, size(strip_counts)
                if (quick .and. strip_counts(j) > most_quick) exit
                if (strip_counts(j) > most_at_every_ratio .and. 2*i - 1 /= size(few_ratios)) exit
                row = row_t(chapter='strips', method='strip', x_name='a/b', x=few_ratios(i), &
                            y_name='N', y=real(strip_counts(j), wp), reference='hertz')
                contact%methods%strips_per_patch = strip_counts(j)
                call put_solution(work, contact, known, row, writer)
                if (.not. row%has_value) cycle
                row%reference = 'dgecon'
                call put_value(writer, row, 'condition', condition(work%strips))
            end do
        end do
    end subroutine many_strips

    !> Ellipses of all proportions under all loads.
    subroutine all_ellipses(work, quick, writer)
        type(workspace_t), intent(inout) :: work
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(contact_case_t) :: contact
        type(normal_result_t) :: known
        type(row_t) :: row
        real(wp) :: ratio
        integer :: i, j, step

        contact%methods%strips_per_patch = usual_strips
        step = merge(6, 1, quick)
        do i = -6, 6, step
            call progress('ellipses', i + 7, 13)
            ratio = 10.0_wp**(0.5_wp*i)
            do j = -6, 9, merge(5, 1, quick)
                contact%load = 10.0_wp**j
                call make_ellipse(ratio, usual_points, contact, known)
                row = row_t(chapter='ellipses', method='strip', x_name='a/b', x=ratio, &
                            y_name='load_N', y=contact%load, reference='hertz')
                call put_solution(work, contact, known, row, writer)
            end do
        end do
    end subroutine all_ellipses

    !> Gaps of hardly any curvature across, by few and by many points.
    subroutine flat_gaps(work, quick, writer)
        type(workspace_t), intent(inout) :: work
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(contact_case_t) :: contact
        type(normal_result_t) :: known
        type(row_t) :: row
        real(wp) :: curvature
        integer :: i, j

        contact%load = usual_load
        contact%methods%strips_per_patch = usual_strips
        do i = -14, -4, merge(5, 1, quick)
            call progress('flat gaps', i + 15, 11)
            curvature = 10.0_wp**(0.5_wp*i)
            do j = 1, size(point_counts), merge(4, 1, quick)
                call make_parabola(wheel_inv2r, 0.5_wp*curvature, point_counts(j), contact, known)
                row = row_t(chapter='flat_gaps', method='strip', x_name='1/R_per_mm', &
                            x=curvature, y_name='points', y=real(point_counts(j), wp), &
                            reference='hertz')
                call put_solution(work, contact, known, row, writer)
            end do
        end do
    end subroutine flat_gaps

    !> Solve, and write the errors of three figures.
    subroutine put_solution(work, contact, known, row, writer)
        type(workspace_t), intent(inout) :: work
        type(contact_case_t), intent(in) :: contact
        type(normal_result_t), intent(in) :: known
        type(row_t), intent(inout) :: row
        type(csv_writer_t), intent(inout) :: writer

        type(normal_result_t) :: result
        type(status_t) :: status

        call solve_by_strips(work, contact, contact%methods%strips_per_patch, result, status)
        call status_of(status, row)
        call put_value(writer, row, 'penetration_err', &
                       abs(result%penetration/known%penetration - 1.0_wp))
        call put_value(writer, row, 'pmax_err', abs(result%pmax/known%pmax - 1.0_wp))
        call put_value(writer, row, 'area_err', abs(result%area/known%area - 1.0_wp))
    end subroutine put_solution

    !> Condition number (1-norm) of the influence coefficients between the strips of a solution, on
    !> their centre lines; huge for a singular matrix.
    real(wp) function condition(strips)
        type(contact_strips_t), intent(in) :: strips

        real(wp), allocatable :: matrix(:, :), work(:)
        integer, allocatable :: iwork(:), pivot(:)
        real(wp) :: norm, reciprocal
        integer :: s, info

        associate (n => strips%n)
            allocate (matrix(n, n), work(4*n), iwork(n), pivot(n))
            norm = 0.0_wp
            do s = 1, n
                call center_influence_column(strips%half_length(s), strips%y_left(s), &
                                             strips%y_right(s), &
                                             0.5_wp*(strips%y_left(:n) + strips%y_right(:n)), &
                                             matrix(:, s))
                norm = max(norm, sum(abs(matrix(:, s))))
            end do
            condition = huge(1.0_wp)
            call dgetrf(n, n, matrix, n, pivot, info)
            if (info /= 0) return
            call dgecon('1', n, matrix, n, norm, reciprocal, work, iwork, info)
            if (info == 0 .and. reciprocal > 0.0_wp) condition = 1.0_wp/reciprocal
        end associate
    end function condition
end module faststrip_lab_extremes_normal
