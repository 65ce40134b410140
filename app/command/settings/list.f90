!> `faststrip settings`: what can be set, one row a setting.
module faststrip_command_settings_list
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, end_row
    use faststrip_command_program_console, only: begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text
    use faststrip_command_settings_table, only: settings, full_words
    implicit none
    private

    public :: run_settings

contains

    !> Run the subcommand from the command line.
    subroutine run_settings()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        integer :: i

        command%name = 'settings'
        command%usage = ''
        command%about = &
            'All settings of case files, group by group: name, permitted values, default, the' &
            // new_line('a') // 'option that overrides it, and its meaning. CSV.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write the CSV there (default stdout)', &
                                    writes=.true.)]
        call parse_command(command, 0)
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_header(writer, [character(len=7) :: 'group', 'name', 'may_be', 'default', &
                                 'option', 'what'])
        do i = 1, size(settings)
            associate (setting => settings(i))
                call put_cell(writer, trim(setting%group))
                call put_cell(writer, trim(setting%key))
                call put_cell(writer, trim(full_words(setting)))
                call put_cell(writer, trim(setting%default))
                call put_cell(writer, trim(setting%option))
                call put_cell(writer, in_a_line(trim(setting%help)))
                call end_row(writer)
            end associate
        end do
        call end_table(writer)
    end subroutine run_settings

    pure function in_a_line(text) result(line)
        character(len=*), intent(in) :: text
        character(len=len(text)) :: line

        integer :: i

        line = text
        do i = 1, len(line)
            if (line(i:i) == new_line('a')) line(i:i) = ' '
        end do
    end function in_a_line
end module faststrip_command_settings_list
