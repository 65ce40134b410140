!> `faststrip wheelset`: the contacts of a wheelset on a track, state by state.
module faststrip_command_wheelset
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_contact_methods, only: tangential_none
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, cell_text, open_csv
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, is_at_rest
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, &
                                        side_right, side_left, most_contacts
    use faststrip_kalker_methods, only: kalker_methods_t, add_kalker
    use faststrip_wheelset_model, only: reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_tangential_types, only: tangential_field_t
    use faststrip_wheelset_field, only: find_wheel_field
    use faststrip_wheelset_strips, only: wheel_strips_t, find_wheel_strips
    use faststrip_command_program_console, only: fail, fail_on_error, note, progress, tell_held, &
                                                 usage_error, exit_bad_input, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number
    use faststrip_command_program_plot, only: plot_option, prepare_plot, plot_file
    use faststrip_command_program_outputs, only: open_outputs, close_outputs
    use faststrip_command_rows_result_csv, only: note_wear
    use faststrip_command_wheelset_case, only: wheelset_case_t, read_wheelset_case, make_model
    use faststrip_command_settings_method_options, only: method_options, method_notes, &
                                                         take_method_options
    use faststrip_command_settings_case_doubts, only: count_pressure
    use faststrip_command_batch_manifest, only: status_counts_t, count_status
    use faststrip_command_settings_doubts, only: tally_t, hold_tally, hold_limitations
    use faststrip_command_wheelset_doubts, only: hold_wheelset_doubts
    use faststrip_command_wheelset_jump, only: is_jump
    use faststrip_command_wheelset_point_spacing, only: wheelset_spacing_t, prepare_spacing, &
                                                        name_wheelset_spacing
    use faststrip_command_wheelset_csv, only: put_wheelset_header, put_wheel, put_failed_state, &
                                              put_strips_header, put_wheel_strips, &
                                              put_fields_header, put_wheel_field
    use faststrip_command_wheelset_profiles, only: put_profiles_header, put_wheelset_profiles
    use faststrip_command_wheelset_states, only: given_state_t, state_columns_t, &
                                                 find_state_columns, read_state_row, take_state
    implicit none
    private

    public :: run_wheelset

    !> The options that name files to write.
    character(len=*), parameter :: outputs(4) = [character(len=10) :: &
        '-o', '--strips', '--profiles', '--fields']
    character(len=*), parameter :: side_names(2) = [character(len=5) :: 'right', 'left']

    !> What people are shown.
    character(len=*), parameter :: shown(*) = [character(len=17) :: &
        'case', 'side', 'contact', 'status', 'contact_angle_rad', 'N_N', 'pmax_MPa', 'area_mm2', &
        'Fx_N', 'Fs_N', 'Mz_Nmm']

    !> Name of the state of a case file.
    character(len=*), parameter :: name_of_case = 'case'

    real(wp), parameter :: um = 1.0e-3_wp ! Given: mm.

    !> What a run has at hand.
    type :: run_t
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t), pointer :: workspaces(:) => null()
            !! one for each state beside; first: state. A pointer: code that copies and frees them
            !! would take the compiler many times as long as all else here
        type(wheel_strips_t) :: strips                   !! of the last contact
        logical :: wants_strips = .false.
        type(tangential_field_t) :: field                !! of the last contact
        logical :: wants_fields = .false.
        logical :: wants_profiles = .false.
        logical :: is_drawn = .false.                    !! is there to be a picture?
        type(csv_writer_t) :: drawn                      !! profiles that it is drawn from
        logical :: has_profiles = .false.                !! are there any?
        character(len=:), allocatable :: profiles_of     !! state they are of; empty: not known yet
        type(tally_t) :: pressures                       !! beyond all steel
        type(status_counts_t) :: counts                  !! of the contacts
        type(wheelset_spacing_t) :: spacing              !! with every second point of profiles
        real(wp) :: beside = 0.0_wp                      !! how far away jumps count, mm; 0: not
        type(csv_writer_t) :: writer(size(outputs))
    end type run_t

contains

    !> Run the subcommand from the command line.
    subroutine run_wheelset()
        type(command_t) :: command
        type(wheelset_case_t) :: case
        type(run_t) :: run
        type(kalker_methods_t), allocatable, target :: kalker(:, :, :)
        type(csv_table_t) :: table
        type(state_columns_t) :: columns
        type(given_state_t) :: state
        type(status_t) :: status
        integer :: i, row, n_failed

        command%name = 'wheelset'
        command%usage = 'CASE.nml'
        command%about = &
            'Contacts of a wheelset on a track and their forces: one row a contact. The case has' &
            // new_line('a') // 'the groups &wheel, &rail, &material, &numerics; the states are' &
            // ' rows of a CSV file with the' // new_line('a') // 'columns case,side,y_mm,' // &
            'roll_rad,yaw_rad,speed_mm_s,Fz_N (optional: pitch_rate_rad_s,' // new_line('a') // &
            'axle_moment_Nmm,z_mm,vy_mm_s,vz_mm_s,roll_rate_rad_s,yaw_rate_rad_s,' // &
            'curve_radius_mm,roll_moment_Nmm;' // new_line('a') // 'of each rail beside its ' // &
            'place rail_right_y_mm,rail_right_z_mm,rail_right_roll_rad,' // new_line('a') // &
            'rail_right_vy_mm_s,rail_right_vz_mm_s,rail_right_roll_rate_rad_s, the same with ' // &
            'left; of' // new_line('a') // 'independent wheels pitch_rate_difference_rad_s, ' // &
            'left less right), or the one of the group' // new_line('a') // '&state. side is ' // &
            'left, right (Fz_N: vertical force of that wheel) or both (of the axle). An' // &
            new_line('a') // 'empty roll_rad is found, a pitch_rate_rad_s not given is ' // &
            'that of pure rolling, or found with an' // new_line('a') // 'axle_moment_Nmm; z_mm ' &
            // 'instead of Fz_N gives the height. A state that fails gets its status' // &
            new_line('a') // 'word; the others go on, and the exit code is 1.' // new_line('a')
        command%options = [ &
            option_t('--states', 'FILE.csv', 'the states', reads=.true.), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout), NetCDF to' &
                     // new_line('a') // 'FILE.nc', writes=.true.), &
            option_t('--strips', 'FILE', 'write the strips of all contacts there, with their ' // &
                     'places', writes=.true.), &
            option_t('--fields', 'FILE', 'write pressure, tractions and slip per element ' // &
                     'there', writes=.true.), &
            option_t('--profiles', 'FILE', 'write wheels and rails in the track there, of one ' // &
                     'state', writes=.true.), &
            plot_option, &
            option_t('--profiles-of', 'CASE', 'of the rows of this name (default: the first ' // &
                     'with a result)'), &
            option_t('--near-jumps', 'UM', 'list solutions UM to the left and right where ' // &
                     'contacts jump'), &
            method_options()]
        command%about = command%about // method_notes()
        call parse_command(command, 1)
        call prepare_plot(command)
        call read_wheelset_case(command%arguments(1)%text, case)
        call take_method_options(command, case)
        call make_model(command%arguments(1)%text, case, run%model)
        if (given(command, '--states') .eqv. case%has_state) &
            call usage_error('the states are needed, from --states or from the group &state of ' &
                             // 'the case, and not from both', command%name)
        if (given(command, '--profiles-of') .and. .not. (given(command, '--profiles') .or. &
                                                         given(command, '--plot'))) &
            call usage_error('--profiles-of: it needs --profiles', command%name)
        run%beside = um*option_number(command, '--near-jumps', 0.0_wp, least=0)
        run%wants_strips = given(command, '--strips')
        run%wants_fields = given(command, '--fields')
        run%model%case%asked%field = run%wants_fields
        run%wants_profiles = given(command, '--profiles')
        run%is_drawn = given(command, '--plot')
        run%profiles_of = option_text(command, '--profiles-of', '')
        allocate (run%workspaces(2))
        allocate (kalker(most_contacts, 2, size(run%workspaces)))
        do i = 1, merge(2, 1, run%beside > 0.0_wp)
            call enter_kalker(run%workspaces(i), kalker(:, :, i), status)
            if (.not. is_error(status)) &
                call reserve_wheelset(run%workspaces(i), run%model, status)
            call fail_on_error(status)
        end do
        call prepare_spacing(case, run%spacing)
        if (.not. case%has_state) then
            call read_csv(option_text(command, '--states', ''), table, status)
            call fail_on_error(status)
            call find_state_columns(table, columns, status)
            call fail_on_error(status)
        end if
        call refuse_unknown_state(run, case%has_state, table, columns)
        call hold_wheelset_doubts(command%arguments(1)%text, run%model, case, table, columns)
        call open_outputs(command, outputs, run%writer)
        call put_wheelset_header(run%writer(1), case)
        if (run%wants_strips) call put_strips_header(run%writer(2), case)
        if (run%wants_profiles) call put_profiles_header(run%writer(3))
        if (run%wants_fields) call put_fields_header(run%writer(4))
        if (run%is_drawn) then
            call open_csv(run%drawn, plot_file('profiles.csv'), status)
            call fail_on_error(status)
            call put_profiles_header(run%drawn)
        end if
        if (case%has_state) then
            call put_state(run, name_of_case, case%state, 0, status)
            call refuse_absent_profiles(run)
            call hold_tally(run%pressures, command%arguments(1)%text)
            call hold_limitations(run%counts, command%arguments(1)%text)
            call close_drawn(run)
            call close_outputs(command, outputs, run%writer, shown)
            ! The files are whole also where the one state failed.
            call fail_on_error(status)
            call tell_held()
            return
        end if
        n_failed = 0
        do row = 1, table%n_rows
            call read_state_row(table, row, columns, state, status)
            if (is_error(status)) then
                call put_failed_state(run%writer(1), cell_text(table, row, columns%case), &
                                      cell_text(table, row, columns%side), status)
            else
                call put_state(run, cell_text(table, row, columns%case), state, &
                               table%line(row), status)
            end if
            if (is_error(status)) then
                n_failed = n_failed + 1
                call note('row ' // integer_text(row) // ' (' // table%file // ':' &
                          // integer_text(table%line(row)) // '): ' // trim(status%message))
            end if
            call progress('states', row, table%n_rows)
        end do
        call refuse_absent_profiles(run)
        call close_drawn(run)
        if (run%is_drawn .and. run%has_profiles .and. table%n_rows > 1 &
            .and. .not. given(command, '--profiles-of')) &
            call note('the picture is of the state ' // run%profiles_of // &
                      '; --profiles-of names another one')
        call close_outputs(command, outputs, run%writer, shown)
        call hold_tally(run%pressures, table%file)
        call hold_limitations(run%counts, table%file)
        call tell_held()
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(table%n_rows) // ' states failed')
    end subroutine run_wheelset

    ! NORM and TANG for each contact that a wheel may have.
    subroutine enter_kalker(workspace, kalker, status)
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(kalker_methods_t), intent(inout), target :: kalker(:, :) ! contact, side
        type(status_t), intent(out) :: status

        integer :: side, i

        do side = side_right, side_left
            allocate (workspace%wheel(side)%contact(size(kalker, 1)))
            do i = 1, size(kalker, 1)
                call add_kalker(workspace%wheel(side)%contact(i), kalker(i, side), status)
                if (is_error(status)) return
            end do
        end do
    end subroutine enter_kalker

    subroutine close_drawn(run)
        type(run_t), intent(inout) :: run

        if (.not. run%is_drawn) return
        call end_table(run%drawn)
    end subroutine close_drawn

    ! A state that was named for its profiles has to be one of those to solve.
    subroutine refuse_unknown_state(run, is_of_case, table, columns)
        type(run_t), intent(in) :: run
        logical, intent(in) :: is_of_case
        type(csv_table_t), intent(in) :: table
        type(state_columns_t), intent(in) :: columns

        integer :: row

        if (len(run%profiles_of) == 0) return
        if (is_of_case) then
            if (run%profiles_of == name_of_case) return
        else
            do row = 1, table%n_rows
                if (cell_text(table, row, columns%case) == run%profiles_of) return
            end do
        end if
        call fail(exit_bad_input, '--profiles-of: there is no state of that name, got ' &
                  // run%profiles_of)
    end subroutine refuse_unknown_state

    ! A state that was named for its profiles must have a result.
    subroutine refuse_absent_profiles(run)
        type(run_t), intent(in) :: run

        if ((run%wants_profiles .or. run%is_drawn) .and. .not. run%has_profiles &
            .and. len(run%profiles_of) > 0) &
            call fail(exit_bad_input, '--profiles-of: no state of that name has a result, got ' &
                      // run%profiles_of)
    end subroutine refuse_absent_profiles

    !> Solve a state and write its contacts. Each state starts afresh: it does not hang on the one
    !> before.
    subroutine put_state(run, name, given, line, status)
        type(run_t), intent(inout) :: run
        character(len=*), intent(in) :: name
        type(given_state_t), intent(in) :: given
        integer, intent(in) :: line ! of the table, 0 of a case file
        type(status_t), intent(out) :: status

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(wheelset_result_t) :: result
        logical :: wants(2)

        call take_state(given, run%model, state, demand, status)
        run%workspaces(1)%has_last = .false.
        if (.not. is_error(status)) &
            call solve_wheelset(run%model, run%workspaces(1), state, demand, result, status)
        if (is_error(status)) then
            call put_failed_state(run%writer(1), name, trim(given%side), status)
            return
        end if
        call name_wheelset_spacing(run%spacing, state, demand, result)
        wants = given%side == 'both' .or. given%side == side_names
        call put_sides(run, name, wants, result, 1)
        call count_pressure(run%pressures, largest_pressure(result, wants), line)
        if (run%wants_profiles .or. run%is_drawn) then
            if (len(run%profiles_of) == 0) run%profiles_of = name
            if (run%profiles_of == name) then
                if (run%wants_profiles) &
                    call put_wheelset_profiles(run%writer(3), name, run%model, &
                                               run%workspaces(1)%last_state, result, wants)
                if (run%is_drawn) &
                    call put_wheelset_profiles(run%drawn, name, run%model, &
                                               run%workspaces(1)%last_state, result, wants)
                run%has_profiles = .true.
            end if
        end if
        if (run%beside > 0.0_wp) call put_beside(run, name, wants, state, demand)
        if (is_at_rest(state)) call note(name // ': nothing moves: without slip there are no ' // &
                                         'friction forces')
    end subroutine put_state

    ! MPa; 0 without contacts.
    real(wp) function largest_pressure(result, wants) result(pmax)
        type(wheelset_result_t), intent(in) :: result
        logical, intent(in) :: wants(2)

        integer :: side, i

        pmax = 0.0_wp
        do side = 1, size(wants)
            if (.not. wants(side)) cycle
            do i = 1, result%wheel(side)%n
                pmax = max(pmax, result%wheel(side)%contact(i)%figures%normal%pmax)
            end do
        end do
    end function largest_pressure

    ! The solutions beside a state, if contacts jump between them.
    subroutine put_beside(run, name, wants, state, demand)
        type(run_t), intent(inout) :: run
        character(len=*), intent(in) :: name
        logical, intent(in) :: wants(2)
        type(wheelset_state_t), intent(in) :: state
        type(wheelset_demand_t), intent(in) :: demand

        type(wheelset_result_t) :: result(2)
        logical :: has_result(2)
        integer :: i

        do i = 1, 2
            call solve_beside(i)
        end do
        if (all(has_result)) then
            if (.not. is_jump(result(1), result(2), wants)) return
        end if
        do i = 1, 2
            if (has_result(i)) call put_sides(run, name, wants, result(i), i + 1)
        end do

    contains

        subroutine solve_beside(i)
            integer, intent(in) :: i

            type(wheelset_state_t) :: there
            type(status_t) :: status

            there = state
            there%y = state%y + merge(-run%beside, run%beside, i == 1)
            run%workspaces(i)%has_last = .false.
            call solve_wheelset(run%model, run%workspaces(i), there, demand, result(i), status)
            has_result(i) = .not. is_error(status)
        end subroutine solve_beside
    end subroutine put_beside

    ! One solution of a state: 1, or 2 and 3 beside it.
    subroutine put_sides(run, name, wants, result, solution)
        type(run_t), intent(inout) :: run
        character(len=*), intent(in) :: name
        logical, intent(in) :: wants(2)
        type(wheelset_result_t), intent(in) :: result
        integer, intent(in) :: solution

        if (wants(side_left)) call put_side(run, name, side_left, result, solution)
        if (wants(side_right)) call put_side(run, name, side_right, result, solution)
    end subroutine put_sides

    ! The contacts of one wheel, and strips and elements of the state itself if they are wanted.
    subroutine put_side(run, name, side, result, solution)
        type(run_t), intent(inout) :: run
        character(len=*), intent(in) :: name
        integer, intent(in) :: side
        type(wheelset_result_t), intent(in) :: result
        integer, intent(in) :: solution

        type(status_t) :: status
        logical :: has_forces
        integer :: i, w

        has_forces = run%model%case%methods%tangential /= tangential_none
        w = max(1, solution - 1)
        do i = 1, result%wheel(side)%n
            associate (contact => result%wheel(side)%contact(i))
                call note_wear(run%workspaces(w)%wheel(side)%contact(i)%wear_status, name // ', ' &
                               // trim(side_names(side)) // ', contact ' // integer_text(i) &
                               // ': ')
                if (solution /= 1) cycle
                call count_status(run%counts, contact%status%code)
                if (run%wants_strips) then
                    call find_wheel_strips(run%model, run%workspaces(w), result, side, i, &
                                           run%strips, status)
                    call fail_on_error(status)
                    call put_wheel_strips(run%writer(2), name, trim(side_names(side)), i, &
                                          contact%radius, run%strips, run%model%case%wear_law)
                end if
                if (run%wants_fields) then
                    call find_wheel_field(run%workspaces(w), result, side, i, run%field, status)
                    call fail_on_error(status)
                    call put_wheel_field(run%writer(4), name, trim(side_names(side)), i, run%field)
                end if
            end associate
        end do
        call put_wheel(run%writer(1), name, trim(side_names(side)), result%wheel(side), &
                       has_forces, solution, [run%workspaces(w)%last_state%y, result%pitch_rate])
    end subroutine put_side
end module faststrip_command_wheelset
