!> `faststrip wheelset`: the contacts of a wheelset on a track, state by state.
module faststrip_command_wheelset
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, cell_text, open_csv, &
                                   close_csv
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, side_right, side_left
    use faststrip_wheelset_solve, only: reserve_wheelset, solve_wheelset
    use faststrip_command_console, only: fail, fail_on_error, note, progress, usage_error, &
                                         exit_bad_input
    use faststrip_command_options, only: command_t, option_t, parse_command, given, option_text
    use faststrip_command_wheelset_case, only: wheelset_case_t, read_wheelset_case
    use faststrip_command_wheelset_csv, only: put_wheelset_header, put_wheel, put_failed_state
    use faststrip_command_wheelset_states, only: given_state_t, state_columns_t, &
                                                 find_state_columns, read_state_row, take_state
    implicit none
    private

    public :: run_wheelset

contains

    !> Run the subcommand from the command line.
    subroutine run_wheelset()
        type(command_t) :: command
        type(wheelset_case_t) :: case
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t) :: workspace
        type(csv_table_t) :: table
        type(state_columns_t) :: columns
        type(given_state_t) :: state
        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: row, n_failed

        command%name = 'wheelset'
        command%usage = 'CASE.nml'
        command%about = &
            'Contacts of a wheelset on a track and their forces: one row a contact. The case has' &
            // new_line('a') // 'the groups &wheel, &rail, &material, &numerics; the states are' &
            // ' rows of a CSV file with the' // new_line('a') // 'columns case,side,y_mm,' // &
            'roll_rad,yaw_rad,speed_mm_s,pitch_rate_rad_s,Fz_N (optional: z_mm,' // &
            new_line('a') // 'vy_mm_s,vz_mm_s,roll_rate_rad_s,yaw_rate_rad_s,curve_radius_mm,' // &
            'roll_moment_Nmm), or the one' // new_line('a') // 'of the group &state. side is' // &
            ' left, right (Fz_N: vertical force of that wheel) or both (of' // new_line('a') // &
            'the axle). An empty roll_rad is found, an empty pitch_rate_rad_s is that of pure' // &
            ' rolling;' // new_line('a') // 'z_mm instead of Fz_N gives the height. A state' // &
            ' that fails gets its status word; the others' // new_line('a') // 'go on, and the' // &
            ' exit code is 1.' // new_line('a')
        command%options = [ &
            option_t('--states', 'FILE.csv', 'the states', reads=.true.), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 1)
        call read_wheelset_case(command%arguments(1)%text, case, model)
        if (given(command, '--states') .eqv. case%has_state) &
            call usage_error('the states are needed, from --states or from the group &state of ' &
                             // 'the case, and not from both', command%name)
        call reserve_wheelset(workspace, model, status)
        call fail_on_error(status)
        if (case%has_state) then
            call open_csv(writer, option_text(command, '-o', '-'), status)
            call fail_on_error(status)
            call put_wheelset_header(writer)
            call put_state(writer, 'case', case%state, model, workspace, status)
            call close_output(writer, status)
            return
        end if
        call read_csv(option_text(command, '--states', ''), table, status)
        call fail_on_error(status)
        call find_state_columns(table, columns, status)
        call fail_on_error(status)
        call open_csv(writer, option_text(command, '-o', '-'), status)
        call fail_on_error(status)
        call put_wheelset_header(writer)
        n_failed = 0
        do row = 1, table%n_rows
            call read_state_row(table, row, columns, state, status)
            if (is_error(status)) then
                call put_failed_state(writer, cell_text(table, row, columns%case), &
                                      cell_text(table, row, columns%side), status)
            else
                call put_state(writer, cell_text(table, row, columns%case), state, model, &
                               workspace, status)
            end if
            if (is_error(status)) then
                n_failed = n_failed + 1
                call note('row ' // integer_text(row) // ' (' // table%file // ':' &
                          // integer_text(table%line(row)) // '): ' // trim(status%message))
            end if
            call progress('states', row, table%n_rows)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(table%n_rows) // ' states failed')
    end subroutine run_wheelset

    ! The file is whole also where its one state failed.
    subroutine close_output(writer, status)
        type(csv_writer_t), intent(inout) :: writer
        type(status_t), intent(in) :: status

        type(status_t) :: closed

        call close_csv(writer, closed)
        call fail_on_error(closed)
        call fail_on_error(status)
    end subroutine close_output

    !> Solve a state and write its contacts. Each state starts afresh: it does not hang on the one
    !> before.
    subroutine put_state(writer, name, given, model, workspace, status)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: name
        type(given_state_t), intent(in) :: given
        type(wheelset_model_t), intent(in) :: model
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(wheelset_result_t) :: result

        call take_state(given, model, state, demand, status)
        workspace%has_last = .false.
        if (.not. is_error(status)) &
            call solve_wheelset(model, workspace, state, demand, result, status)
        if (is_error(status)) then
            call put_failed_state(writer, name, trim(given%side), status)
            return
        end if
        if (given%side /= 'right') call put_wheel(writer, name, 'left', result%wheel(side_left))
        if (given%side /= 'left') call put_wheel(writer, name, 'right', result%wheel(side_right))
    end subroutine put_state
end module faststrip_command_wheelset
