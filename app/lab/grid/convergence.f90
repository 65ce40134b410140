!> `faststrip-lab bench convergence`: errors of the strip solver against the number of strips.
module faststrip_lab_grid_convergence
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, status_word
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                  put_empty_cells, end_row
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_grid_ellipse, only: make_ellipse
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_command_program_console, only: fail_on_error, note, progress, begin_table, &
                                                 end_table
    implicit none
    private

    public :: bench_convergence

    integer, parameter :: strip_counts(12) = [5, 7, 9, 11, 15, 21, 27, 31, 41, 51, 61, 81]
    integer, parameter :: true_strips = 301 ! taken for the truth where there is no closed one

    ! a/b of the ellipses, and what they all share.
    real(wp), parameter :: ratios(12) = [0.01_wp, 0.02_wp, 0.05_wp, 0.1_wp, 0.2_wp, 0.5_wp, &
                                         1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp, 20.0_wp, 50.0_wp]
    real(wp), parameter :: hertz_load = 1.0e5_wp ! N
    integer, parameter :: hertz_points = 801

contains

    !> Solve everything and write the CSV.
    subroutine bench_convergence(file, folder, most_strips)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_strips     !! no larger number of strips

        type(bench_case_t), allocatable :: cases(:)
        type(workspace_t) :: workspace
        type(csv_writer_t) :: writer
        type(normal_result_t) :: truth
        type(contact_case_t) :: ellipse
        type(status_t) :: status
        integer :: i

        call read_bench_cases(folder, cases, status)
        call fail_on_error(status)
        call begin_table(writer, file)
        call put_comment(writer, 'errors relative to the truth: 301 strips of the same solver ' &
                         // 'for the shifts, Hertz for the ellipses')
        call put_header(writer, [character(len=15) :: 'case', 'strips', 'status', &
                                 'penetration_err', 'pmax_err', 'area_err'])
        do i = 1, size(cases)
            call progress('contacts', i, size(cases) + size(ratios))
            call solve_by_strips(workspace, cases(i), true_strips, truth, status)
            if (status%code /= 0) then
                call note(cases(i)%name // ' has no truth: ' // trim(status%message))
                cycle
            end if
            call put_errors(workspace, cases(i), most_strips, cases(i)%name, truth, writer)
        end do
        ellipse%load = hertz_load
        do i = 1, size(ratios)
            call progress('contacts', size(cases) + i, size(cases) + size(ratios))
            call make_ellipse(ratios(i), hertz_points, ellipse, truth)
            call put_errors(workspace, ellipse, most_strips, 'hertz_' &
                            // trim(number_text(ratios(i))), truth, writer)
        end do
        call end_table(writer)
    end subroutine bench_convergence

    !> One row for each number of strips.
    subroutine put_errors(workspace, contact, most_strips, name, truth, writer)
        type(workspace_t), intent(inout) :: workspace
        class(contact_case_t), intent(in) :: contact
        integer, intent(in) :: most_strips
        character(len=*), intent(in) :: name
        type(normal_result_t), intent(in) :: truth
        type(csv_writer_t), intent(inout) :: writer

        type(normal_result_t) :: result
        type(status_t) :: status
        integer :: k

        do k = 1, size(strip_counts)
            if (strip_counts(k) > most_strips) exit
            call solve_by_strips(workspace, contact, strip_counts(k), result, status)
            call put_cell(writer, name)
            call put_cell(writer, strip_counts(k))
            call put_cell(writer, trim(status_word(status%code)))
            if (is_error(status)) then
                call put_empty_cells(writer, 3)
            else
                call put_cells(writer, [result%penetration/truth%penetration - 1.0_wp, &
                                        result%pmax/truth%pmax - 1.0_wp, &
                                        result%area/truth%area - 1.0_wp])
            end if
            call end_row(writer)
        end do
    end subroutine put_errors
end module faststrip_lab_grid_convergence
