!> `faststrip-lab bench convergence`: errors of the strip solver against the number of strips.
module faststrip_lab_grid_convergence
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, status_word
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_comment, put_header, put_cell, &
                                   end_row, close_csv
    use faststrip_base_material, only: normal_compliance
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve_demand
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_grid_ellipse, only: make_ellipse
    use faststrip_command_program_console, only: fail_on_error, note, progress, put_origin
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

    !> Room for the solutions.
    type :: workspaces_t
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
    end type workspaces_t

contains

    !> Solve everything and write the CSV.
    subroutine bench_convergence(file, folder, most_strips)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_strips     !! no larger number of strips

        type(bench_case_t), allocatable :: cases(:)
        type(workspaces_t) :: work
        type(csv_writer_t) :: writer
        type(normal_result_t) :: truth
        type(contact_case_t) :: ellipse
        type(status_t) :: status
        integer :: i, points

        call read_bench_cases(folder, cases, status)
        call fail_on_error(status)
        points = hertz_points
        do i = 1, size(cases)
            points = max(points, size(cases(i)%gap%y))
        end do
        call reserve_strips(work%strips, 2*true_strips + 60, status)
        call fail_on_error(status)
        call reserve_strip_workspace(work%workspace, 2*true_strips + 60, points, status)
        call fail_on_error(status)
        call open_csv(writer, file, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_comment(writer, 'errors relative to the truth: 301 strips of the same solver ' &
                         // 'for the shifts, Hertz for the ellipses')
        call put_header(writer, [character(len=15) :: 'case', 'strips', 'status', &
                                 'penetration_err', 'pmax_err', 'area_err'])
        do i = 1, size(cases)
            call progress('contacts', i, size(cases) + size(ratios))
            call set_strip_gap(work%workspace, cases(i)%gap, status)
            call fail_on_error(status, cases(i)%name)
            call solve_with(work, cases(i), true_strips, truth, status)
            if (status%code /= 0) then
                call note(cases(i)%name // ' has no truth: ' // trim(status%message))
                cycle
            end if
            call put_errors(work, cases(i), most_strips, cases(i)%name, truth, writer)
        end do
        ellipse%load = hertz_load
        do i = 1, size(ratios)
            call progress('contacts', size(cases) + i, size(cases) + size(ratios))
            call make_ellipse(ratios(i), hertz_points, ellipse, truth)
            call set_strip_gap(work%workspace, ellipse%gap, status)
            call fail_on_error(status)
            call put_errors(work, ellipse, most_strips, 'hertz_' &
                            // trim(number_text(ratios(i))), truth, writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine bench_convergence

    !> By a number of strips, on the gap that was set.
    subroutine solve_with(work, contact, n, result, status)
        type(workspaces_t), intent(inout) :: work
        class(contact_case_t), intent(in) :: contact
        integer, intent(in) :: n
        type(normal_result_t), intent(out) :: result
        type(status_t), intent(out) :: status

        call strip_solve_demand(work%workspace, normal_compliance(contact%material), &
                                contact%demand_t, strip_options_t(strips_per_patch=n), &
                                work%strips, result, status)
    end subroutine solve_with

    !> One row for each number of strips on the gap that was set.
    subroutine put_errors(work, contact, most_strips, name, truth, writer)
        type(workspaces_t), intent(inout) :: work
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
            call solve_with(work, contact, strip_counts(k), result, status)
            call put_cell(writer, name)
            call put_cell(writer, strip_counts(k))
            call put_cell(writer, trim(status_word(status%code)))
            if (is_error(status)) then
                call put_cell(writer, '')
                call put_cell(writer, '')
                call put_cell(writer, '')
            else
                call put_cell(writer, result%penetration/truth%penetration - 1.0_wp)
                call put_cell(writer, result%pmax/truth%pmax - 1.0_wp)
                call put_cell(writer, result%area/truth%area - 1.0_wp)
            end if
            call end_row(writer)
        end do
    end subroutine put_errors
end module faststrip_lab_grid_convergence
