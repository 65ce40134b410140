!> Files that a subcommand writes: all of them, or none.
module faststrip_command_program_outputs
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t, open_csv, close_csv, abort_csv
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_program_options, only: command_t, given, option_text, has_option
    use faststrip_command_program_people, only: open_result, close_result
    use faststrip_command_program_plot, only: draw_plot
    implicit none
    private

    public :: open_outputs, close_outputs

contains

    !> Open all files before anything is written: if one cannot be, the others stay as they were.
    !> The first option's file is always written: to stdout, for people or as CSV, if nothing else
    !> is said.
    subroutine open_outputs(command, names, writer)
        type(command_t), intent(in) :: command         !! parsed
        character(len=*), intent(in) :: names(:)       !! options that name files to write
        type(csv_writer_t), intent(out) :: writer(:)   !! one each

        type(status_t) :: status
        integer :: i

        do i = 1, size(names)
            if (.not. is_wanted(command, names, i)) cycle
            if (i == 1) then
                call open_result(command, writer(i), status)
            else
                call open_csv(writer(i), option_text(command, trim(names(i)), '-'), status)
            end if
            call drop_on_error(writer, status)
        end do
    end subroutine open_outputs

    !> Finish all files, and draw what was asked for.
    subroutine close_outputs(command, names, writer, columns)
        type(command_t), intent(in) :: command          !! parsed
        character(len=*), intent(in) :: names(:)        !! as they were opened
        type(csv_writer_t), intent(inout) :: writer(:)  !! opened
        character(len=*), intent(in) :: columns(:)      !! of the first that people are shown

        type(status_t) :: status
        integer :: i

        do i = size(names), 1, -1
            if (.not. is_wanted(command, names, i)) cycle
            if (i == 1) then
                call close_result(command, writer(i), columns, status)
            else
                call close_csv(writer(i), status)
            end if
            call drop_on_error(writer, status)
        end do
        if (has_option(command, '--plot')) call draw_plot(command)
    end subroutine close_outputs

    logical function is_wanted(command, names, i)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: names(:)
        integer, intent(in) :: i

        is_wanted = i == 1
        if (i > 1) is_wanted = given(command, trim(names(i)))
    end function is_wanted

    subroutine drop_on_error(writer, status)
        type(csv_writer_t), intent(inout) :: writer(:)
        type(status_t), intent(in) :: status

        integer :: i

        if (.not. is_error(status)) return
        do i = 1, size(writer)
            call abort_csv(writer(i))
        end do
        call fail_on_error(status)
    end subroutine drop_on_error
end module faststrip_command_program_outputs
