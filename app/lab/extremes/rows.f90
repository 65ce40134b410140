!> The rows of `faststrip-lab bench extremes`: one measured error, or one word that says why not.
module faststrip_lab_extremes_rows
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, end_row
    implicit none
    private

    public :: row_t, put_row_header, put_row, put_value, status_of

    !> One row. Two numbers place it, a third is what was measured there.
    type :: row_t
        character(len=12) :: chapter = ''   !! which extreme
        character(len=24) :: case = ''      !! what is solved, where numbers do not say it
        character(len=20) :: method = ''    !! by what
        character(len=12) :: x_name = ''    !! what x is, with its unit
        real(wp) :: x = 0.0_wp
        character(len=16) :: y_name = ''    !! what y is, with its unit
        real(wp) :: y = 0.0_wp
        character(len=20) :: quantity = ''  !! what was measured
        real(wp) :: value = 0.0_wp          !! without meaning if the status is an error's
        character(len=12) :: reference = '' !! what it was measured against
        character(len=20) :: status = 'ok'  !! a word of the library, or `jump`
        logical :: has_value = .true.
    end type row_t

contains

    !> The names of the columns.
    subroutine put_row_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_header(writer, [character(len=9) :: 'chapter', 'case', 'method', 'x_name', 'x', &
                                 'y_name', 'y', 'quantity', 'value', 'reference', 'status'])
    end subroutine put_row_header

    !> Write a row. A value that is not finite has the status `not_finite` and an empty cell.
    subroutine put_row(writer, row)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(row_t), intent(in) :: row              !! what to write

        call put_cell(writer, trim(row%chapter))
        call put_cell(writer, trim(row%case))
        call put_cell(writer, trim(row%method))
        call put_cell(writer, trim(row%x_name))
        call put_cell(writer, row%x)
        call put_cell(writer, trim(row%y_name))
        call put_cell(writer, row%y)
        call put_cell(writer, trim(row%quantity))
        if (.not. row%has_value) then
            call put_cell(writer, '')
        else
            call put_cell(writer, row%value)
        end if
        call put_cell(writer, trim(row%reference))
        if (row%has_value .and. .not. ieee_is_finite(row%value)) then
            call put_cell(writer, 'not_finite')
        else
            call put_cell(writer, trim(row%status))
        end if
        call end_row(writer)
    end subroutine put_row

    !> Write a row about a quantity.
    subroutine put_value(writer, row, quantity, value)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        type(row_t), intent(inout) :: row            !! all else
        character(len=*), intent(in) :: quantity     !! what was measured
        real(wp), intent(in) :: value                !! without meaning if the row has none

        row%quantity = quantity
        row%value = value
        call put_row(writer, row)
    end subroutine put_value

    !> Take over how a call ended.
    subroutine status_of(status, row)
        type(status_t), intent(in) :: status !! of the call
        type(row_t), intent(inout) :: row    !! its status and whether it has a value

        row%status = status_word(status%code)
        row%has_value = .not. is_error(status)
    end subroutine status_of
end module faststrip_lab_extremes_rows
