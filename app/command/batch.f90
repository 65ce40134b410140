!> `faststrip batch`: one contact a row of a CSV file.
module faststrip_command_batch
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, set_status, st_bad_argument
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, &
                                   column_index, cell_text, cell_number, open_csv, put_cell, &
                                   end_row, close_csv, csv_text_t
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_command_batch_friction, only: read_row_friction
    use faststrip_command_console, only: fail, fail_on_error, note, progress, put_origin, &
                                         concerns_gap, exit_bad_input
    use faststrip_command_gap_cache, only: gap_cache_t, take_gap_name, read_gap_once
    use faststrip_command_options, only: command_t, option_t, parse_command, option_text
    use faststrip_contact_case, only: contact_case_t
    use faststrip_command_methods, only: numerics_t
    use faststrip_command_method_options, only: method_options, method_notes, take_method_options
    use faststrip_command_case_file, only: beside
    use faststrip_command_solver, only: solver_t, outcome_t, make_solver, release_solver, solve
    use faststrip_command_result_csv, only: result_columns, put_result, put_notes, note_wear
    implicit none
    private

    public :: run_batch, case_columns

    !> What a table of contacts must have.
    character(len=*), parameter :: case_columns(9) = [character(len=15) :: &
        'case', 'gap_file', 'E_MPa', 'nu', 'mu', 'N_N', 'cksi', 'ceta', 'cphi_rad_per_mm']
    integer, parameter :: load_column = 6 ! of `case_columns`
    character(len=*), parameter :: penetration_column = 'given_penetration_mm'

contains

    !> Run the subcommand from the command line.
    subroutine run_batch()
        type(command_t) :: command
        type(csv_table_t) :: table
        type(csv_writer_t) :: writer
        type(status_t) :: status
        type(numerics_t) :: numerics
        type(solver_t) :: solver
        type(contact_case_t) :: options, case
        type(outcome_t) :: outcome
        type(gap_cache_t), allocatable :: cache
        character(len=:), allocatable :: gap_name
        integer :: row, i, n_failed, column(size(case_columns))

        command%name = 'batch'
        command%usage = 'CASES.csv'
        command%about = &
            'Solve one contact per row of a CSV file with the columns' // new_line('a') &
            // 'case,gap_file,E_MPa,nu,mu,N_N,cksi,ceta,cphi_rad_per_mm (wheel and rail alike;' &
            // new_line('a') // 'gap_file relative to the CSV file). A row with a number in the' &
            // ' further column' // new_line('a') // penetration_column // ' is solved for it;' &
            // ' its N_N is then empty, and filled in.' // new_line('a') // 'Columns' &
            // ' friction_kind, mu_kinetic, half_slip_speed_mm_s, initial_slope_factor,' &
            // new_line('a') // 'speed_mm_s: as in &friction and &motion of a case file, mu being' &
            // ' the static value.' // new_line('a') // 'Other columns are carried through. A' &
            // ' row that fails gets its status word and' // new_line('a') // 'empty figures;' &
            // ' the others go on, and the exit code is 1.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write the CSV there (default stdout)', &
                                    writes=.true.), &
                           method_options]
        command%about = command%about // method_notes()
        call parse_command(command, 1)
        call take_method_options(command, numerics, options)
        call read_csv(command%arguments(1)%text, table, status)
        call fail_on_error(status)
        do i = 1, size(case_columns)
            call require_column(table, trim(case_columns(i)), column(i), status)
            call fail_on_error(status)
        end do
        call refuse_result_columns(table)
        do row = 1, table%n_rows
            call take_gap_name(beside(table%file, cell_text(table, row, column(2))), gap_name)
        end do
        allocate (cache)
        call make_solver(numerics, .false., solver, status)
        call fail_on_error(status)
        call open_csv(writer, option_text(command, '-o', '-'), status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_notes(writer, numerics)
        call put_names(writer, table%names)
        n_failed = 0
        do row = 1, table%n_rows
            case = options
            call read_row(table, row, column, cache, case, status)
            if (.not. is_error(status)) call solve(solver, case, outcome, status)
            do i = 1, table%n_columns
                if (i == column(load_column) .and. .not. (case%by_load .or. is_error(status))) &
                    then
                    call put_cell(writer, outcome%normal%load)
                else
                    call put_cell(writer, cell_text(table, row, i))
                end if
            end do
            call put_result(writer, outcome, status)
            call end_row(writer)
            if (is_error(status)) then
                n_failed = n_failed + 1
                call note('row ' // integer_text(row) // ' (' // table%file // ':' &
                          // integer_text(table%line(row)) // '): ' // trim(status%message) &
                          // about_gap(table, row, column, status))
            else
                call note_wear(outcome, 'row ' // integer_text(row) // ': ')
            end if
            call progress('contacts', row, table%n_rows)
        end do
        call release_solver(solver)
        call close_csv(writer, status)
        call fail_on_error(status)
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(table%n_rows) // ' contacts failed')
    end subroutine run_batch

    !> The gap file in brackets, where the message is about its gap and does not name it.
    function about_gap(table, row, column, status) result(text)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row, column(:)
        type(status_t), intent(in) :: status
        character(len=:), allocatable :: text

        text = ''
        if (concerns_gap(status)) text = ' (' // cell_text(table, row, column(2)) // ')'
    end function about_gap

    subroutine put_names(writer, names)
        type(csv_writer_t), intent(inout) :: writer
        type(csv_text_t), intent(in) :: names(:)

        integer :: i

        do i = 1, size(names)
            call put_cell(writer, names(i)%text)
        end do
        do i = 1, size(result_columns)
            call put_cell(writer, trim(result_columns(i)))
        end do
        call end_row(writer)
    end subroutine put_names

    !> A table that has a column the result would add cannot be carried through.
    subroutine refuse_result_columns(table)
        type(csv_table_t), intent(in) :: table

        integer :: i

        do i = 1, table%n_columns
            if (any(result_columns == table%names(i)%text)) &
                call fail(exit_bad_input, 'a column must not have the name of a result, got ' &
                          // table%names(i)%text // ' (' // table%file // ')')
        end do
    end subroutine refuse_result_columns

    !> The contact of a row.
    subroutine read_row(table, row, column, cache, case, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row, column(:)
        type(gap_cache_t), intent(inout) :: cache
        type(contact_case_t), intent(inout) :: case
        type(status_t), intent(out) :: status

        real(wp) :: number(3:9)
        integer :: i, penetration

        penetration = column_index(table, penetration_column)
        if (len(cell_text(table, row, penetration)) > 0) then
            case%by_load = .false.
            call cell_number(table, row, penetration, case%penetration, status)
            if (is_error(status)) return
            if (len(cell_text(table, row, column(load_column))) > 0) then
                call set_status(status, st_bad_argument, 'N_N must be empty with ' &
                                // penetration_column // ', got ' &
                                // cell_text(table, row, column(load_column)))
                return
            end if
        end if
        do i = lbound(number, 1), ubound(number, 1)
            if (i == load_column .and. .not. case%by_load) cycle
            call cell_number(table, row, column(i), number(i), status)
            if (is_error(status)) return
        end do
        if (case%by_load) case%load = number(load_column)
        case%material = material_t(number(3), number(3), number(4), number(4))
        case%mu = number(5)
        case%creepage = creepage_t(number(7), number(8), number(9))
        call read_row_friction(table, row, case%mu, case%friction, status)
        if (is_error(status)) return
        call read_gap_once(cache, beside(table%file, cell_text(table, row, column(2))), case%gap, &
                           status)
    end subroutine read_row
end module faststrip_command_batch
