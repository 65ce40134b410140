!> `faststrip contact`: one contact of a case file.
module faststrip_app_contact
    use faststrip_status, only: status_t, st_ok
    use faststrip_csv, only: csv_writer_t, open_csv, close_csv
    use faststrip_app_console, only: fail_on_error, note, usage_error
    use faststrip_app_options, only: command_t, option_t, parse_command, given, option_text, &
                                     option_number
    use faststrip_app_method_options, only: method_options, take_method_options
    use faststrip_app_case_file, only: case_t, read_case
    use faststrip_app_scene, only: scene_t, make_scene, write_gap, write_profiles
    use faststrip_app_solver, only: solver_t, outcome_t, make_solver, solve
    use faststrip_app_result_csv, only: write_strips, write_field
    use faststrip_app_sweep_csv, only: put_sweep_header, put_sweep_row
    implicit none
    private

    public :: run_contact

contains

    !> Run the subcommand from the command line.
    subroutine run_contact()
        type(command_t) :: command
        type(case_t) :: case
        type(scene_t) :: scene
        type(solver_t) :: solver
        type(outcome_t) :: outcome
        type(csv_writer_t) :: writer
        type(status_t) :: status, written

        command%name = 'contact'
        command%usage = 'CASE.nml'
        command%about = &
            'Solve one contact: from two profiles and a lateral shift, or from a gap file with' &
            // new_line('a') // 'the columns y_mm,h_mm,inv2R_per_mm. CSV, one row.' &
            // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)'), &
            option_t('--strips', 'FILE', 'write the strips there'), &
            option_t('--fields', 'FILE', 'write pressure, tractions and slip per element there'), &
            option_t('--gap', 'FILE', 'write the undeformed gap there'), &
            option_t('--profiles', 'FILE', 'write wheel and rail in contact there'), &
            option_t('--shift', 'MM', 'lateral shift, instead of that of the case'), &
            method_options]
        call parse_command(command, 1)
        call read_case(command%arguments(1)%text, case)
        call take_method_options(command, case%methods)
        if (len(case%gap_file) > 0) then
            if (given(command, '--profiles')) &
                call usage_error('--profiles: the case has a gap file', command%name)
            if (given(command, '--shift')) &
                call usage_error('--shift: the case has a gap file', command%name)
        end if
        call make_scene(case, option_number(command, '--shift', case%shift), scene, status)
        call fail_on_error(status)
        call make_solver(case%methods, given(command, '--fields'), solver, status)
        call fail_on_error(status)
        call solve(solver, scene%gap, case%material, case%mu, scene%load, scene%creepage, &
                   outcome, status)
        call fail_on_error(status)
        if (status%code /= st_ok) call note(trim(status%message))
        if (given(command, '--gap')) &
            call write_gap(option_text(command, '--gap', ''), scene%gap)
        if (given(command, '--profiles')) &
            call write_profiles(option_text(command, '--profiles', ''), case, scene)
        if (given(command, '--strips')) &
            call write_strips(option_text(command, '--strips', ''), case%name, solver%strips)
        if (given(command, '--fields')) &
            call write_field(option_text(command, '--fields', ''), case%name, solver%field)
        call open_csv(writer, option_text(command, '-o', '-'), written)
        call fail_on_error(written)
        call put_sweep_header(writer, case)
        call put_sweep_row(writer, case, case%methods, scene, outcome, status)
        call close_csv(writer, written)
        call fail_on_error(written)
    end subroutine run_contact
end module faststrip_app_contact
