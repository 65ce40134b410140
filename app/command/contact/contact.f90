!> `faststrip contact`: one contact of a case file.
module faststrip_command_contact
    use faststrip_base_status, only: status_t, st_ok
    use faststrip_files_csv, only: csv_writer_t, open_csv
    use faststrip_command_program_console, only: fail_on_error, concerns_gap, note, usage_error, &
                                                 end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_number
    use faststrip_command_program_outputs, only: open_outputs, close_outputs
    use faststrip_command_program_plot, only: plot_option, prepare_plot, plot_file
    use faststrip_command_settings_method_options, only: method_options, method_notes, &
                                                         take_method_options
    use faststrip_command_settings_case_file, only: case_t, read_case
    use faststrip_command_settings_case_doubts, only: hold_case_doubts, hold_pressure
    use faststrip_command_contact_below, only: below_options, points_t, take_points, find_below, &
                                               put_below
    use faststrip_command_contact_prepared_case, only: prepared_case_t, prepare_case, put_gap, &
                                                       put_profiles
    use faststrip_command_contact_point_spacing, only: point_spacing_t, judge_spacing, name_spacing
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    use faststrip_contact_method, only: contact_result_t
    use faststrip_command_rows_result_csv, only: put_strips, put_field, note_wear
    use faststrip_command_rows_sweep_csv, only: put_sweep_header, put_sweep_row
    implicit none
    private

    public :: run_contact

    !> The options that name files to write.
    character(len=*), parameter :: outputs(6) = [character(len=10) :: &
        '-o', '--strips', '--fields', '--gap', '--profiles', '--below']

    !> What people are shown.
    character(len=*), parameter :: shown(*) = [character(len=15) :: &
        'case', 'yw_mm', 'normal', 'tangential', 'status', 'N_N', 'gamma_rad', 'cksi', 'ceta', &
        'cphi_rad_per_mm', 'penetration_mm', 'area_mm2', 'pmax_MPa', 'Fx_N', 'Fy_N', 'Mz_Nmm', &
        'stick_fraction', 'est_err_pmax', 'est_err_Fx', 'est_err_Fy']

contains

    !> Run the subcommand from the command line.
    subroutine run_contact()
        type(command_t) :: command
        type(case_t) :: case
        type(prepared_case_t) :: prepared
        type(solver_t), pointer :: solver
        type(contact_result_t) :: result
        type(point_spacing_t) :: spacing
        type(points_t) :: points
        type(csv_writer_t) :: writer(size(outputs))
        type(status_t) :: status

        command%name = 'contact'
        command%usage = 'CASE.nml'
        command%about = &
            'Solve one contact: from two profiles and a displacement, or from a gap file with' &
            // new_line('a') // 'the columns y_mm,h_mm,inv2R_per_mm. CSV, one row.' &
            // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF to' &
                     // new_line('a') // 'FILE.nc', &
                     writes=.true.), &
            option_t('--strips', 'FILE', 'write the strips there, with the sums over each', &
                     writes=.true.), &
            option_t('--fields', 'FILE', 'write pressure, tractions and slip per element there', &
                     writes=.true.), &
            option_t('--gap', 'FILE', 'write the undeformed gap there', &
                     writes=.true.), &
            option_t('--profiles', 'FILE', 'write wheel and rail in contact there', &
                     writes=.true.), &
            below_options(), &
            plot_option, &
            option_t('--shift', 'MM', 'lateral displacement, instead of that of the case'), &
            method_options()]
        command%about = command%about // method_notes()
        call parse_command(command, 1)
        call prepare_plot(command)
        call read_case(command%arguments(1)%text, case)
        call take_method_options(command, case)
        case%asked%times = .true.
        case%asked%field = given(command, '--fields')
        case%asked%strip_forces = given(command, '--strips')
        call take_points(command, points)
        if (given(command, '--below')) case%asked%subsurface = .true.
        if (len(case%gap_file) > 0) then
            if (given(command, '--profiles')) &
                call usage_error('--profiles: the case has a gap file', command%name)
            if (given(command, '--shift')) &
                call usage_error('--shift: the case has a gap file', command%name)
        end if
        call prepare_case(case, option_number(command, '--shift', case%shift), 0, prepared, &
                          status)
        if (len(case%gap_file) > 0) call fail_on_error(status)
        call fail_on_error(status, command%arguments(1)%text)
        call hold_case_doubts(case, prepared, command%arguments(1)%text)
        call new_solver(solver, status)
        call fail_on_error(status)
        call solve(solver, prepared, result, status)
        if (concerns_gap(status) .and. len(case%gap_file) > 0) &
            call fail_on_error(status, case%gap_file // ', ' // command%arguments(1)%text)
        call fail_on_error(status, command%arguments(1)%text)
        call hold_pressure(result%normal%pmax, command%arguments(1)%text)
        call judge_spacing(case, prepared, spacing)
        call name_spacing(spacing, status)
        if (status%code /= st_ok) call note(trim(status%message))
        call note_wear(solver%workspace%wear_status, '')
        if (given(command, '--below')) &
            call find_below(solver%workspace%loads, case%material%nu_rail, points)
        call open_outputs(command, outputs, writer)
        call put_sweep_header(writer(1), case)
        call put_sweep_row(writer(1), case, prepared, result, solver%workspace%steps, status)
        if (given(command, '--strips')) &
            call put_strips(writer(2), case%name, solver%workspace%strips, &
                            solver%workspace%strip_forces, case, &
                            prepared%rigid_contact%radius)
        if (given(command, '--fields')) call put_field(writer(3), case%name, &
                                                       solver%workspace%field)
        if (given(command, '--gap')) call put_gap(writer(4), solver%workspace%solver%curve, &
                                                  case%smoothing, case%curved)
        if (given(command, '--profiles')) call put_profiles(writer(5), case, prepared)
        if (given(command, '--below')) call put_below(writer(6), points)
        if (given(command, '--plot')) &
            call keep_files(case, prepared, solver)
        call close_outputs(command, outputs, writer, shown)
        call free_solver(solver)
    end subroutine run_contact

    !> What a picture is drawn from, beside the result.
    subroutine keep_files(case, prepared, solver)
        type(case_t), intent(in) :: case
        type(prepared_case_t), intent(in) :: prepared
        type(solver_t), intent(in) :: solver

        type(csv_writer_t) :: writer
        type(status_t) :: status

        call open_csv(writer, plot_file('strips.csv'), status)
        call fail_on_error(status)
        call put_strips(writer, case%name, solver%workspace%strips, &
                        solver%workspace%strip_forces, case, prepared%rigid_contact%radius)
        call end_table(writer)
        call open_csv(writer, plot_file('gap.csv'), status)
        call fail_on_error(status)
        call put_gap(writer, solver%workspace%solver%curve, case%smoothing, case%curved)
        call end_table(writer)
    end subroutine keep_files
end module faststrip_command_contact
