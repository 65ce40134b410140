!> `faststrip-lab bench accuracy`: errors of the strip solver against CONTACT.
module faststrip_lab_grid_accuracy
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, status_word
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_contact_method, only: workspace_t
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    implicit none
    private

    public :: bench_accuracy

    integer, parameter :: choices(2) = [15, strips_auto]
    character(len=*), parameter :: choice_names(2) = [character(len=4) :: '15', 'auto']

contains

    !> Solve everything, write the CSV and say the mean and the largest errors.
    subroutine bench_accuracy(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts

        type(bench_case_t), allocatable :: cases(:)
        type(workspace_t) :: workspace
        type(normal_result_t) :: result
        type(csv_writer_t) :: writer
        type(status_t) :: status
        real(wp), allocatable :: errors(:, :)
        integer :: i, k, j, n

        call read_bench_cases(folder, cases, status)
        call fail_on_error(status)
        call begin_table(writer, file)
        call put_comment(writer, 'errors against CONTACT on 0.1 mm, area extrapolated; ' &
                         // 'relative, patch ends in mm')
        call put_header(writer, [character(len=15) :: 'case', 'strips', 'status', &
                                 'penetration_err', 'pmax_err', 'area_err', 'ymin_err_mm', &
                                 'ymax_err_mm', 'strips_used', 'iterations'])
        allocate (errors(5, size(cases)))
        do k = 1, size(choices)
            n = 0
            do i = 1, size(cases)
                call solve_by_strips(workspace, cases(i), choices(k), result, status)
                call put_cell(writer, cases(i)%name)
                call put_cell(writer, trim(choice_names(k)))
                call put_cell(writer, trim(status_word(status%code)))
                if (is_error(status)) then
                    call put_empty_cells(writer, 7)
                else
                    n = n + 1
                    errors(:, n) = [result%penetration/cases(i)%truth%penetration - 1.0_wp, &
                                    result%pmax/cases(i)%truth%pmax - 1.0_wp, &
                                    result%area/cases(i)%truth%area - 1.0_wp, &
                                    result%y_min - cases(i)%truth%y_min, &
                                    result%y_max - cases(i)%truth%y_max]
                    do j = 1, 5
                        call put_cell(writer, errors(j, n))
                    end do
                    call put_cells(writer, [workspace%strips%n, result%iterations])
                end if
                call end_row(writer)
            end do
            if (n > 0) call tell(trim(choice_names(k)), abs(errors(:, :n)))
        end do
        call end_table(writer)
    end subroutine bench_accuracy

    subroutine tell(name, errors)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: errors(:, :)

        call note(name // ' strips, mean/max: penetration ' // pair(100.0_wp*errors(1, :)) &
                  // ' %, pmax ' // pair(100.0_wp*errors(2, :)) // ' %, area ' &
                  // pair(100.0_wp*errors(3, :)) // ' %, ends ' // pair([errors(4, :), &
                                                                     errors(5, :)]) // ' mm')
    end subroutine tell

    function pair(values) result(text)
        real(wp), intent(in) :: values(:)
        character(len=:), allocatable :: text

        character(len=24) :: buffer

        write (buffer, '(f0.3, a, f0.3)') sum(values)/size(values), '/', maxval(values)
        text = trim(buffer)
    end function pair
end module faststrip_lab_grid_accuracy
