!> The rows of a batch: what a table of contacts has, and from one of its rows to a row of results.
module faststrip_command_batch_rows
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, is_error, set_status, st_bad_argument
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_plausible, only: doubts_t, case_names_t, gap_size, find_doubts, &
                                           doubt_pressure
    use faststrip_files_csv, only: csv_table_t, require_column, column_index, &
                                   cell_text, cell_number, put_cell, end_row, take_only_row, &
                                   refuse_misspelt
    use faststrip_command_settings_friction, only: read_row_friction, read_row_values, &
                                                   friction_columns
    use faststrip_command_settings_table, only: row_numerics, value_t
    use faststrip_command_settings_thermal, only: read_row_thermal, thermal_columns
    use faststrip_command_settings_group, only: beside
    use faststrip_command_program_console, only: concerns_gap
    use faststrip_command_settings_doubts, only: count_doubts
    use faststrip_command_program_files, only: trouble_t
    use faststrip_command_batch_gap_cache, only: gap_cache_t, find_gap
    use faststrip_command_rows_result_csv, only: result_columns, put_result, no_wear
    use faststrip_command_contact_solver, only: solve, ready_gap_t
    use faststrip_command_batch_worker, only: worker_t
    implicit none
    private

    public :: case_columns, penetration_column, given_columns, row_columns_t
    public :: find_columns, solve_row

    !> What a table of contacts must have.
    character(len=*), parameter :: case_columns(9) = [character(len=15) :: &
        'case', 'gap_file', 'E_MPa', 'nu', 'mu', 'N_N', 'cksi', 'ceta', 'cphi_rad_per_mm']
    integer, parameter :: gap_column = 2, load_column = 6 ! Given: of `case_columns`
    !> A column that it may have: penetrations instead of loads.
    character(len=*), parameter :: penetration_column = 'given_penetration_mm'
    !> Columns that it may have: forces instead of cksi and ceta.
    character(len=*), parameter :: given_columns(2) = ['given_Fx_N', 'given_Fy_N']
    integer, parameter :: creepage_columns(2) = [7, 8] ! Given: of `case_columns`

    !> Where the columns are.
    type :: row_columns_t
        private
        integer :: of(size(case_columns)) = 0
        integer :: penetration = 0 ! 0: there is none
        integer :: given(2) = 0    ! the same
        logical :: has_friction = .false. ! is there one of `friction_columns`?
        logical :: has_heat = .false.     ! and of `thermal_columns`?
        logical :: has_numerics = .false. ! and of `row_numerics`?
    end type row_columns_t

contains

    !> Find the columns of a table.
    subroutine find_columns(table, columns, status)
        type(csv_table_t), intent(in) :: table      !! with names
        type(row_columns_t), intent(out) :: columns !! where they are
        type(status_t), intent(out) :: status       !! `st_file_format`: one is missing, or has the
                                                    !! name of a result

        integer :: i

        do i = 1, size(case_columns)
            call require_column(table, trim(case_columns(i)), columns%of(i), status)
            if (is_error(status)) return
        end do
        columns%penetration = column_index(table, penetration_column)
        call refuse_misspelt(table, penetration_column, case_columns, status)
        do i = 1, size(given_columns)
            columns%given(i) = column_index(table, given_columns(i))
            call refuse_misspelt(table, given_columns(i), &
                                 [character(len=16) :: case_columns, given_columns], status)
        end do
        do i = 1, size(friction_columns)
            ! Without a kind of friction the others are carried through.
            if (i > 1 .and. column_index(table, friction_columns(1)) == 0) exit
            call refuse_misspelt(table, trim(friction_columns(i)), friction_columns, status)
        end do
        if (is_error(status)) return
        columns%has_friction = has_any(friction_columns)
        columns%has_heat = has_any(thermal_columns)
        columns%has_numerics = has_any(row_numerics%key)
        do i = 1, table%n_columns
            if (.not. any(result_columns == table%names(i)%text)) cycle
            ! A table that has a column the result would add cannot be carried through.
            call set_status(status, st_bad_argument, 'a column must not have the name of a ' &
                            // 'result, got ' // table%names(i)%text // ' (' // table%file // ')')
            return
        end do

    contains

        pure logical function has_any(names)
            character(len=*), intent(in) :: names(:)

            has_any = any([(column_index(table, trim(names(i))), i=1, size(names))] > 0)
        end function has_any
    end subroutine find_columns

    !> Solve the contact of a line and add its row to what the worker has collected.
    subroutine solve_row(worker, columns, cache, options, line, number, status, words, trouble)
        type(worker_t), intent(inout) :: worker       !! of this thread
        type(row_columns_t), intent(in) :: columns    !! of the table
        type(gap_cache_t), intent(inout) :: cache     !! of all threads
        type(contact_case_t), intent(in) :: options   !! what counts for all rows
        character(len=*), intent(in) :: line          !! the row
        integer, intent(in) :: number                 !! of the line
        type(status_t), intent(out) :: status         !! how it ended
        character(len=:), allocatable, intent(out) :: words !! what there is to say; or none
        type(trouble_t), intent(out) :: trouble       !! why the run has to end, if it has to

        type(contact_case_t) :: case
        type(ready_gap_t), pointer :: ready
        type(doubts_t) :: doubts
        integer :: i
        logical :: is_found(2)

        call take_only_row(worker%table, line, number, status)
        if (is_error(status)) then
            ! All rows were checked before: somebody writes the file.
            trouble%code = 1
            trouble%words = trim(status%message)
            return
        end if
        case = options
        associate (table => worker%table, writer => worker%writer, result => worker%result)
            call read_row(table, columns, case, status)
            if (.not. is_error(status)) then
                call find_gap(cache, worker%gap, case%smoothing, &
                              beside(table%file, cell_text(table, 1, columns%of(gap_column))), &
                              ready, status, trouble)
                if (trouble%code /= 0) return
            end if
            if (.not. is_error(status)) then
                call find_row_doubts(worker, case, ready, doubts)
                case%warm_start = worker%can_go_on
                case%asked%times = worker%tells_times
                call solve(worker%solver, case, result, status, ready)
                worker%can_go_on = .not. is_error(status)
                if (.not. is_error(status)) &
                    call doubt_pressure('pmax_MPa', result%normal%pmax, doubts)
            end if
            call count_doubts(worker%tally, doubts, int(number, int64), number)
            is_found = case%given%is_given .and. .not. is_error(status)
            do i = 1, table%n_columns
                if (i == columns%of(load_column) .and. .not. (case%by_load .or. is_error(status))) &
                    then
                    call put_cell(writer, result%normal%load)
                else if (i == columns%of(creepage_columns(1)) .and. is_found(1)) then
                    call put_cell(writer, result%creepage%cksi)
                else if (i == columns%of(creepage_columns(2)) .and. is_found(2)) then
                    call put_cell(writer, result%creepage%ceta)
                else
                    call put_cell(writer, cell_text(table, 1, i))
                end if
            end do
            call put_result(writer, result, worker%solver%workspace%steps, status, &
                            worker%tells_times)
            call end_row(writer)
            if (is_error(status)) then
                words = trim(status%message)
                if (concerns_gap(status)) &
                    words = words // ' (' // cell_text(table, 1, columns%of(gap_column)) // ')'
            else if (is_error(worker%solver%workspace%wear_status)) then
                words = no_wear // trim(worker%solver%workspace%wear_status%message)
            end if
        end associate
    end subroutine solve_row

    !> What is outside of practice in a row; a gap is looked at when it changes.
    subroutine find_row_doubts(worker, case, ready, doubts)
        type(worker_t), intent(inout) :: worker
        type(contact_case_t), intent(in) :: case
        type(ready_gap_t), intent(in) :: ready
        type(doubts_t), intent(inout) :: doubts

        type(case_names_t) :: names

        if (worker%size_of_gap /= ready%id) then
            associate (curve => ready%curve, n => ready%curve%n)
                worker%gap_size = gap_size(curve%y(:n), curve%h(:n), curve%inv2r(:n))
            end associate
            worker%size_of_gap = ready%id
        end if
        names%e = [character(len=24) :: 'E_MPa', '']
        names%load = 'N_N'
        names%penetration = penetration_column
        names%creepage(3) = case_columns(9)
        names%speed = 'speed_mm_s'
        names%half_slip_speed = 'half_slip_speed_mm_s'
        names%gap = [character(len=24) :: 'y_mm', 'h_mm', 'inv2R_per_mm']
        call find_doubts(case, worker%gap_size, names, doubts)
    end subroutine find_row_doubts

    !> The contact of a row without its gap.
    subroutine read_row(table, columns, case, status)
        type(csv_table_t), intent(in) :: table
        type(row_columns_t), intent(in) :: columns
        type(contact_case_t), intent(inout) :: case
        type(status_t), intent(out) :: status

        type(value_t) :: values(size(row_numerics))
        real(wp) :: number(3:9)
        integer :: i

        associate (load => columns%of(load_column))
            if (len(cell_text(table, 1, columns%penetration)) > 0) then
                case%by_load = .false.
                call cell_number(table, 1, columns%penetration, case%penetration, status)
                if (is_error(status)) return
                if (len(cell_text(table, 1, load)) > 0) then
                    call set_status(status, st_bad_argument, 'N_N must be empty with ' &
                                    // penetration_column // ', got ' // cell_text(table, 1, load))
                    return
                end if
            end if
        end associate
        number = 0.0_wp
        do i = 1, size(given_columns)
            associate (given => case%given, creepage => columns%of(creepage_columns(i)))
                if (len(cell_text(table, 1, columns%given(i))) == 0) cycle
                given%is_given(i) = .true.
                call cell_number(table, 1, columns%given(i), given%force(i), status)
                if (is_error(status)) return
                if (len(cell_text(table, 1, creepage)) == 0) cycle
                call set_status(status, st_bad_argument, &
                                trim(case_columns(creepage_columns(i))) // ' must be empty with ' &
                                // given_columns(i) // ', got ' // cell_text(table, 1, creepage))
                return
            end associate
        end do
        do i = lbound(number, 1), ubound(number, 1)
            if (i == load_column .and. .not. case%by_load) cycle
            if (any(i == creepage_columns .and. case%given%is_given)) cycle
            call cell_number(table, 1, columns%of(i), number(i), status)
            if (is_error(status)) return
        end do
        if (case%by_load) case%load = number(load_column)
        case%material = material_t(number(3), number(3), number(4), number(4))
        case%mu = number(5)
        case%creepage = creepage_t(number(7), number(8), number(9))
        if (columns%has_friction) &
            call read_row_friction(table, 1, case%mu, case%friction, status)
        if (columns%has_heat .and. .not. is_error(status)) &
            call read_row_thermal(table, 1, case, status)
        if (columns%has_numerics .and. .not. is_error(status)) then
            call read_row_values(table, 1, row_numerics%key, row_numerics, values, status)
            if (values(1)%is_given) case%curved = values(1)%flag
        end if
    end subroutine read_row
end module faststrip_command_batch_rows
