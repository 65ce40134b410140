!> `faststrip-lab bench trade`: what every method and resolution costs, and its errors.
!>
!> Methods come from a CSV file, contacts from the reference folder. One row per contact and
!> method, so that whoever reads them can take means, largest values and fronts as wanted. A
!> method of stage `normal` is judged by penetration, maximum pressure and area, one of stage
!> `tangential` or `both` by forces and moment, in units of mu N and mu N c, c = sqrt(area/pi).
!> Times are those of the processor: of some runs of a contact the median (`us` is an older name of
!> it), the 95th percentile and the worst; they begin with the curve through the gap's points. Of
!> the core's normal methods those of the solution alone stand besides.
module faststrip_lab_grid_trade
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                  end_row
    use faststrip_lab_studies_trade_influence, only: trade_influence
    use faststrip_lab_grid_trade_times, only: solution_columns, time_solution
    use faststrip_command_program_clock, only: spread_of, spread_names, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_contact_methods, only: normal_method_name, tangential_method_name, &
                                         normal_table, is_in_core, normal_norm, tangential_tang
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t, times_t
    use faststrip_lab_grid_method_list, only: method_entry_t, read_method_list
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, read_ellipse_cases, &
                                        read_scene_cases
    implicit none
    private

    public :: bench_trade

    ! Figures a contact is judged by.
    integer, parameter :: n_figures = 6
    character(len=*), parameter :: figure_names(n_figures) = [character(len=11) :: &
        'penetration', 'pmax', 'area', 'Fx', 'Fy', 'Mz']
    integer, parameter :: most_repeats = 25
    integer, parameter :: many_strips = 50
    ! A method has been timed enough after this, us.
    real(wp), parameter :: enough_us = 1.5e3_wp

contains

    !> Solve every contact by every method and write the CSV.
    subroutine bench_trade(file, methods_file, folder, scenes_file, quick)
        character(len=*), intent(in) :: file         !! to write, - for stdout
        character(len=*), intent(in) :: methods_file !! with the methods
        character(len=*), intent(in) :: folder       !! with the contacts
        character(len=*), intent(in) :: scenes_file  !! the contacts of many kinds
        logical, intent(in) :: quick                 !! fewer methods and contacts

        type(method_entry_t), allocatable :: entries(:)
        type(bench_case_t), allocatable :: wheelset(:), hertz(:), scenes(:)
        type(csv_writer_t) :: writer
        integer :: i

        call read_method_list(methods_file, entries)
        call read_bench_cases(folder, wheelset)
        call read_ellipse_cases(folder, hertz)
        call read_scene_cases(scenes_file, scenes)
        call begin_table(writer, file)
        call put_comment(writer, 'errors: relative, of forces over mu N, of the moment over ' &
                         // 'mu N c; times: of the stage, processor')
        call put_header(writer, [[character(len=22) :: 'set', 'case', 'stage', 'method', &
                                  'normal', 'tangential', 'status', 'us'], &
                                 [character(len=22) :: 'err_' // figure_names], &
                                 [character(len=22) :: cpu_columns], &
                                 [character(len=22) :: solution_columns]])
        call trade_influence(writer, wheelset(:: merge(5, 1, quick)), n_figures)
        do i = 1, size(entries)
            call progress('methods', i, size(entries))
            if (quick .and. entries(i)%when /= 'always') cycle
            call run_entry(writer, entries(i), wheelset(:: merge(5, 1, quick)))
            ! Kalker's methods and very many strips take too long for all; normal methods are
            ! exact, or nearly, on all ellipses of the same proportions.
            call run_entry(writer, entries(i), hertz(:: thinning(entries(i), 20)))
            call run_entry(writer, entries(i), scenes(:: thinning(entries(i), 48)))
        end do
        call end_table(writer)

    contains

        !> Of how many contacts one is taken.
        pure integer function thinning(entry, in_quick)
            type(method_entry_t), intent(in) :: entry
            integer, intent(in) :: in_quick

            thinning = 1
            associate (methods => entry%settings%methods)
                if (methods%normal == normal_norm .or. methods%tangential == tangential_tang &
                    .or. methods%strips_per_patch > many_strips) thinning = 7
            end associate
            if (in_quick == 20 .and. entry%stage == 'normal') thinning = 20
            if (quick) thinning = in_quick
        end function thinning
    end subroutine bench_trade

    !> One method on a list of contacts.
    subroutine run_entry(writer, entry, cases)
        type(csv_writer_t), intent(inout) :: writer
        type(method_entry_t), intent(in) :: entry
        type(bench_case_t), intent(in) :: cases(:)

        type(solver_t), pointer :: solver
        type(contact_case_t) :: contact
        type(contact_result_t) :: result
        type(status_t) :: status
        real(wp) :: us(most_repeats), spent, errors(n_figures), times(size(spread_names)), &
                    solution(size(solution_columns))
        integer :: i, run, runs, figure
        logical :: counts(n_figures), is_timed

        call new_solver(solver, status)
        call fail_on_error(status)
        do i = 1, size(cases)
            associate (case => cases(i))
                contact = case%contact_case_t
                contact%methods = entry%settings%methods
                contact%wanted = entry%settings%wanted
                contact%asked%times = .true.
                runs = 0
                spent = 0.0_wp
                do run = 1, most_repeats
                    call solve(solver, contact, result, status)
                    if (is_error(status)) exit
                    runs = run
                    us(run) = stage_time(entry%stage, result%times)
                    spent = spent + result%times%normal_cpu_us + result%times%tangential_cpu_us
                    if (spent > merge(1.0_wp, 10.0_wp, run >= 3)*enough_us) exit
                end do
                call put_cell(writer, case%set)
                call put_cell(writer, case%name)
                call put_cell(writer, entry%stage)
                call put_cell(writer, entry%name)
                associate (methods => entry%settings%methods)
                    call put_cell(writer, trim(normal_method_name(methods%normal)))
                    call put_cell(writer, trim(tangential_method_name(methods%tangential)))
                end associate
                call put_cell(writer, trim(status_word(status%code)))
                if (runs > 0) times = spread_of(us(:runs))
                call put_cell(writer, times(1), is_known=runs > 0)
                errors = relative_errors(case, result)
                counts = runs > 0 .and. ([(figure > 3, figure=1, n_figures)] .neqv. &
                                         entry%stage == 'normal') &
                         .and. (case%area_counts .or. figure_names /= 'area')
                call put_cells(writer, errors, counts)
                call put_cells(writer, times, is_known=runs > 0)
                is_timed = runs > 0 .and. entry%stage == 'normal' &
                           .and. is_in_core(normal_table, entry%settings%methods%normal)
                if (is_timed) call time_solution(solver%workspace, contact, solution, is_timed)
                call put_cells(writer, solution, is_known=is_timed)
                call end_row(writer)
            end associate
        end do
        call free_solver(solver)
    end subroutine run_entry

    pure real(wp) function stage_time(stage, times)
        character(len=*), intent(in) :: stage
        type(times_t), intent(in) :: times

        stage_time = times%normal_cpu_us + times%tangential_cpu_us
        if (stage == 'normal') stage_time = times%normal_cpu_us
        if (stage == 'tangential') stage_time = times%tangential_cpu_us
    end function stage_time

    !> Errors in the order of `figure_names`.
    pure function relative_errors(case, solution) result(errors)
        type(bench_case_t), intent(in) :: case
        type(contact_result_t), intent(in) :: solution
        real(wp) :: errors(n_figures)

        real(wp) :: bound

        errors(1:3) = [solution%normal%penetration, solution%normal%pmax, solution%normal%area] &
                      /[case%known%penetration, case%known%pmax, case%known%area] - 1.0_wp
        bound = case%mu*case%load
        errors(4:6) = ([solution%tangential%fx, solution%tangential%fy, solution%tangential%mz] &
                       - case%forces)/bound
        errors(6) = errors(6)/sqrt(case%known%area/pi)
    end function relative_errors
end module faststrip_lab_grid_trade
