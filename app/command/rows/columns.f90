!> `faststrip columns`: the catalogue of columns, one row a column.
module faststrip_command_rows_columns
    use faststrip_files_columns, only: columns, column_group, holds_text, holds_counts
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, end_row
    use faststrip_files_units, only: column_unit
    use faststrip_command_program_console, only: begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text
    implicit none
    private

    public :: run_columns

contains

    !> Run the subcommand from the command line.
    subroutine run_columns()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        character(len=10) :: unit
        integer :: i

        command%name = 'columns'
        command%usage = ''
        command%about = &
            'All columns of tables, group by group: name, unit (as UDUNITS has it), what it' &
            // new_line('a') // 'holds, the name in C and Python, what must be there for it to ' &
            // 'be known, and what' // new_line('a') // 'it means. CSV.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write the CSV there (default stdout)', &
                                    writes=.true.)]
        call parse_command(command, 0)
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_header(writer, [character(len=6) :: 'group', 'column', 'unit', 'holds', &
                                 'member', 'needs', 'what'])
        do i = 1, size(columns)
            associate (column => columns(i))
                call put_cell(writer, trim(column_group(i)))
                call put_cell(writer, trim(column%name))
                unit = column_unit(trim(column%name))
                if (len_trim(unit) == 0 .and. column%holds /= holds_text) unit = '1'
                call put_cell(writer, trim(unit))
                select case (column%holds)
                case (holds_text); call put_cell(writer, 'text')
                case (holds_counts); call put_cell(writer, 'count')
                case default; call put_cell(writer, 'number')
                end select
                call put_cell(writer, trim(column%member))
                call put_cell(writer, trim(column%needs))
                call put_cell(writer, trim(column%long_name))
                call end_row(writer)
            end associate
        end do
        call end_table(writer)
    end subroutine run_columns
end module faststrip_command_rows_columns
