!> The columns of a table: what their cells hold, and the rows that wait to be written.
module faststrip_netcdf_columns
    use, intrinsic :: iso_fortran_env, only: real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_text, only: lower_case, parse_real
    use faststrip_files_columns, only: column_t, known_column, holds_anything, holds_text, &
                                       holds_counts, holds_numbers
    use faststrip_files_units, only: column_unit
    implicit none
    private

    public :: table_column_t, make_column, look_at, settle, reserve_rows, keep_cell
    public :: fill_number, fill_count

    !> What stands for an empty cell, in double precision and in single, and of whole numbers.
    !> Given: NF90_FILL_DOUBLE, NF90_FILL_FLOAT and NF90_FILL_INT.
    real(wp), parameter :: fill_number = 9.9692099683868690e36_wp
    integer, parameter :: fill_count = -2147483647

    !> A column, what was seen in it, and its cells in some rows.
    type :: table_column_t
        character(len=:), allocatable :: name
        character(len=:), allocatable :: long_name !! what it is, in a few words
        character(len=:), allocatable :: unit      !! in the words of UDUNITS; empty: not known
        integer :: holds = holds_anything          !! once settled: text, counts or numbers
        integer :: variable = 0                    !! of the file
        integer :: longest = 1                     !! text, bytes, at least 1
        logical :: has_gaps = .false.              !! are there cells without a number?
        integer :: n_refused = 0                   !! cells that are no number where one must be
        integer :: refused_line = 0                !! line of the first of them
        character(len=:), allocatable :: refused   !! its text
        integer :: large_line = 0                  !! line of the first number beyond single
                                                   !! precision; 0: there is none
        logical, private :: all_whole = .true., all_numbers = .true., any_number = .false.
        real(wp), allocatable :: numbers(:)        !! of the rows
        integer, allocatable :: counts(:)          !! of the rows
        character(len=:), allocatable :: texts(:)  !! of the rows, filled up with zero bytes
    end type table_column_t

contains

    !> A column of which the name is all that was seen.
    subroutine make_column(name, column)
        character(len=*), intent(in) :: name        !! of the column
        type(table_column_t), intent(out) :: column !! to be looked at

        type(column_t) :: known

        known = known_column(name)
        column%name = name
        column%long_name = trim(known%long_name)
        column%holds = known%holds
        column%unit = trim(column_unit(name))
        if (len(column%unit) == 0 .and. (known%holds == holds_counts .or. &
                                         known%holds == holds_numbers)) column%unit = '1'
    end subroutine make_column

    !> Look at a cell.
    subroutine look_at(column, cell, line)
        type(table_column_t), intent(inout) :: column !! not yet settled
        character(len=*), intent(in) :: cell          !! its text
        integer, intent(in) :: line                   !! of the file it is on

        real(wp) :: value
        logical :: valid

        column%longest = max(column%longest, len(cell))
        if (column%holds == holds_text) return
        if (is_empty(cell)) then
            column%has_gaps = .true.
            return
        end if
        call parse_real(cell, value, valid)
        if (valid) then
            column%any_number = .true.
            column%all_whole = column%all_whole .and. is_whole(cell, value)
            if (abs(value) > huge(1.0_real32) .and. column%large_line == 0) column%large_line = line
        else
            column%all_numbers = .false.
            column%has_gaps = .true.
            column%n_refused = column%n_refused + 1
            if (column%n_refused > 1) return
            column%refused_line = line
            column%refused = cell
        end if
    end subroutine look_at

    !> What the column holds, once all its cells were looked at.
    subroutine settle(column)
        type(table_column_t), intent(inout) :: column !! looked at

        select case (column%holds)
        case (holds_counts)
            if (.not. column%all_whole) column%holds = holds_numbers
        case (holds_anything)
            column%n_refused = 0
            if (.not. column%all_numbers) then
                column%holds = holds_text
                column%unit = ''
            else if (column%all_whole .and. column%any_number .and. len(column%unit) == 0) then
                column%holds = holds_counts
            else
                column%holds = holds_numbers
            end if
        end select
    end subroutine settle

    !> Make room for some rows.
    subroutine reserve_rows(column, n)
        type(table_column_t), intent(inout) :: column !! settled
        integer, intent(in) :: n                      !! how many

        select case (column%holds)
        case (holds_text); allocate (character(len=column%longest) :: column%texts(n))
        case (holds_counts); allocate (column%counts(n))
        case default; allocate (column%numbers(n))
        end select
    end subroutine reserve_rows

    !> Keep the cell of a row.
    subroutine keep_cell(column, i, cell)
        type(table_column_t), intent(inout) :: column !! with room
        integer, intent(in) :: i                      !! which of the rows there is room for
        character(len=*), intent(in) :: cell          !! as it was looked at

        real(wp) :: value
        logical :: valid

        if (column%holds == holds_text) then
            column%texts(i) = cell
            column%texts(i)(len(cell) + 1:) = repeat(achar(0), max(column%longest - len(cell), 0))
            return
        end if
        call parse_real(cell, value, valid)
        if (column%holds == holds_counts) then
            column%counts(i) = merge(int(value), fill_count, valid)
        else
            column%numbers(i) = merge(value, fill_number, valid)
        end if
    end subroutine keep_cell

    ! Some programs write NaN into a cell that is empty.
    pure logical function is_empty(cell)
        character(len=*), intent(in) :: cell

        is_empty = len(cell) == 0
        if (len(cell) == 3) is_empty = lower_case(cell) == 'nan'
    end function is_empty

    ! Is a number whole, and written so?
    pure logical function is_whole(cell, value)
        character(len=*), intent(in) :: cell
        real(wp), intent(in) :: value

        is_whole = abs(value) < abs(real(fill_count, wp)) .and. scan(cell, '.eEdD') == 0
    end function is_whole
end module faststrip_netcdf_columns
