!> `faststrip-lab bench examples`: the cases of example/cases by several methods.
module faststrip_lab_grid_examples
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, end_row
    use faststrip_base_kinds, only: wp
    use faststrip_command_settings_case_file, only: case_t
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_lab_grid_example_cases, only: example_names, read_example
    use faststrip_contact_methods, only: contact_methods_t, normal_hertz, normal_auto, &
                                         normal_strip, tangential_linear, tangential_fastsim, &
                                         tangential_faststrip
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_wanted, only: wanted_t
    use faststrip_command_rows_result_csv, only: result_columns, put_result
    use faststrip_command_contact_prepared_case, only: prepared_case_t
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    implicit none
    private

    public :: bench_examples

    character(len=*), parameter :: labels(5) = [character(len=22) :: 'Kalker', &
        'Hertz + linear', 'Hertz + FASTSIM', 'strips 15 + FASTSTRIP', 'auto 2 %']
    real(wp), parameter :: never_met = 1.0e-9_wp
    integer, parameter :: normal_methods(5) = [normal_auto, normal_hertz, normal_hertz, &
                                               normal_strip, normal_auto]
    integer, parameter :: tangential_methods(5) = [tangential_faststrip, tangential_linear, &
        tangential_fastsim, tangential_faststrip, tangential_faststrip]

contains

    !> Solve every case by every method and write the CSV.
    subroutine bench_examples(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the case files

        type(csv_writer_t) :: writer
        type(case_t) :: case
        type(prepared_case_t) :: prepared
        type(solver_t), pointer :: solver
        type(contact_result_t) :: result
        type(status_t) :: status
        integer :: i, m, run

        call begin_table(writer, file)
        call put_comment(writer, 'Kalker: NORM and TANG on about 30 elements across')
        call put_header(writer, [[character(len=len(result_columns)) :: 'example', 'method', &
                                  'N_N', 'mu'], result_columns])
        do i = 1, size(example_names)
            call read_example(folder, i, case, prepared)
            do m = 1, size(labels)
                call new_solver(solver, status)
                call fail_on_error(status)
                prepared%methods = contact_methods_t(normal=normal_methods(m), &
                                                     tangential=tangential_methods(m))
                prepared%wanted = wanted_t()
                if (labels(m) == 'Kalker') prepared%wanted%tolerance = never_met
                prepared%asked%times = .true.
                ! The second time nothing has to be allocated or planned.
                do run = 1, 2
                    call solve(solver, prepared, result, status)
                end do
                call put_cell(writer, trim(example_names(i)))
                call put_cell(writer, trim(labels(m)))
                call put_cell(writer, merge(prepared%load, result%normal%load, prepared%by_load), &
                              is_known=prepared%by_load .or. .not. is_error(status))
                call put_cell(writer, case%mu)
                call put_result(writer, result, solver%workspace%steps, status)
                call end_row(writer)
                call free_solver(solver)
            end do
            call progress('examples', i, size(example_names))
        end do
        call end_table(writer)
    end subroutine bench_examples
end module faststrip_lab_grid_examples
