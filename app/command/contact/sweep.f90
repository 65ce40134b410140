!> `faststrip sweep`: a wheelset shifted sideways, each contact by several methods.
module faststrip_command_contact_sweep
    use faststrip_base_status, only: status_t, is_error, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t
    use faststrip_command_program_console, only: fail, fail_on_error, note, progress, tell_held, &
                                                 exit_bad_input
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given
    use faststrip_command_program_people, only: open_result, close_result
    use faststrip_command_program_plot, only: plot_option, prepare_plot, draw_plot
    use faststrip_contact_methods, only: normal_strip, normal_hertz, tangential_faststrip, &
                                         tangential_fastsim, normal_method_name, &
                                         tangential_method_name
    use faststrip_contact_method, only: contact_result_t
    use faststrip_command_settings_method_options, only: method_options, method_notes, &
                                                         take_method_options
    use faststrip_command_settings_case_doubts, only: hold_sweep_doubts, count_pressure
    use faststrip_command_batch_manifest, only: status_counts_t, count_status
    use faststrip_command_settings_doubts, only: tally_t, hold_tally, hold_limitations
    use faststrip_command_settings_case_file, only: case_t, read_case
    use faststrip_command_contact_prepared_case, only: prepared_case_t, prepare_case
    use faststrip_command_contact_point_spacing, only: point_spacing_t, judge_spacing, name_spacing
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    use faststrip_command_rows_result_csv, only: note_wear
    use faststrip_command_rows_sweep_csv, only: put_sweep_header, put_sweep_row
    implicit none
    private

    public :: run_sweep

    !> Normal and tangential method of each row of a shift.
    integer, parameter :: pairs(2, 3) = reshape( &
        [normal_strip, tangential_faststrip, normal_strip, tangential_fastsim, &
         normal_hertz, tangential_fastsim], [2, 3])

    !> What people are shown.
    character(len=*), parameter :: shown(*) = [character(len=15) :: &
        'yw_mm', 'normal', 'tangential', 'status', 'N_N', 'gamma_rad', 'pmax_MPa', 'area_mm2', &
        'Fx_N', 'Fy_N', 'Mz_Nmm']

contains

    !> Run the subcommand from the command line.
    subroutine run_sweep()
        type(command_t) :: command
        type(case_t) :: case
        type(prepared_case_t) :: prepared
        type(solver_t), pointer :: solver
        type(contact_result_t) :: result
        type(point_spacing_t) :: spacing
        type(csv_writer_t) :: writer
        type(status_t) :: status, placed, written
        type(tally_t) :: pressures
        type(status_counts_t) :: counts
        integer :: i, m, n_failed, n_pairs

        command%name = 'sweep'
        command%usage = 'CASE.nml'
        command%about = &
            'Solve the contact of a case at every displacement of its group &sweep, by strips' &
            // new_line('a') // 'with faststrip and fastsim and by hertz with fastsim. CSV,' &
            // ' one row per displacement' // new_line('a') // 'and method; one that fails gets' &
            // ' its status word and empty figures.' // new_line('a') // 'With --normal or' &
            // ' --tangential there is one row more, by these methods.' // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF to' &
                     // new_line('a') // 'FILE.nc', writes=.true.), &
            plot_option, method_options()]
        command%about = command%about // method_notes()
        call parse_command(command, 1)
        call prepare_plot(command)
        call read_case(command%arguments(1)%text, case)
        call take_method_options(command, case)
        case%asked%times = .true.
        if (size(case%shifts) == 0) &
            call fail(exit_bad_input, 'missing group: &sweep with shifts_mm (' &
                      // command%arguments(1)%text // ')')
        if (len(case%gap_file) > 0) &
            call fail(exit_bad_input, 'a sweep must have profiles, got the gap file ' &
                      // case%gap_file // ' (' // command%arguments(1)%text // ')')
        n_pairs = size(pairs, 2)
        if (given(command, '--normal') .or. given(command, '--tangential')) then
            ! Unless it is one of the three.
            if (.not. any(pairs(1, :) == case%methods%normal &
                          .and. pairs(2, :) == case%methods%tangential)) n_pairs = n_pairs + 1
        end if
        call new_solver(solver, status)
        call fail_on_error(status)
        call hold_sweep_doubts(case, command%arguments(1)%text)
        call open_result(command, writer, written)
        call fail_on_error(written)
        call put_sweep_header(writer, case)
        n_failed = 0
        do i = 1, size(case%shifts)
            call progress('shifts', i, size(case%shifts))
            call prepare_case(case, case%shifts(i), i, prepared, placed)
            spacing = point_spacing_t()
            if (.not. is_error(placed)) call judge_spacing(case, prepared, spacing)
            do m = 1, n_pairs
                status = placed
                prepared%methods = case%methods
                if (m <= size(pairs, 2)) then
                    prepared%methods%normal = pairs(1, m)
                    prepared%methods%tangential = pairs(2, m)
                end if
                if (.not. is_error(placed)) call solve(solver, prepared, result, status)
                if (.not. is_error(status)) call name_spacing(spacing, status)
                call put_sweep_row(writer, case, prepared, result, solver%workspace%steps, &
                                   status)
                if (m == 1) call count_status(counts, status%code)
                if (.not. is_error(status)) &
                    call count_pressure(pressures, result%normal%pmax, 0)
                if (.not. is_error(status)) &
                    call note_wear(solver%workspace%wear_status, 'shift ' &
                                   // trim(number_text(case%shifts(i))) // ' mm: ')
                if (.not. is_error(status)) cycle
                n_failed = n_failed + 1
                call note('shift ' // trim(number_text(case%shifts(i))) // ' mm, ' &
                          // trim(normal_method_name(prepared%methods%normal)) &
                          // ' and ' &
                          // trim(tangential_method_name(prepared%methods%tangential)) &
                          // ': ' &
                          // trim(status%message))
            end do
        end do
        call free_solver(solver)
        call close_result(command, writer, shown, written)
        call fail_on_error(written)
        call draw_plot(command)
        call hold_tally(pressures, command%arguments(1)%text)
        call hold_limitations(counts, command%arguments(1)%text)
        call tell_held()
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(size(case%shifts)*n_pairs) &
                                    // ' contacts failed')
    end subroutine run_sweep
end module faststrip_command_contact_sweep
