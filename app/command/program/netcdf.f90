!> `faststrip netcdf`: a table as a NetCDF file.
module faststrip_command_program_netcdf
    use faststrip_base_status, only: status_t
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, exit_bad_input
    use faststrip_command_program_netcdf_file, only: is_netcdf, use_single_precision, write_netcdf
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, refuse_value
    use faststrip_command_program_system, only: file_kind, kind_none, kind_file, kind_folder
    implicit none
    private

    public :: run_netcdf

contains

    !> Run the subcommand from the command line.
    subroutine run_netcdf()
        type(command_t) :: command
        type(status_t) :: status

        command%name = 'netcdf'
        command%usage = 'TABLE.csv'
        command%about = &
            'Convert a table to NetCDF-4, by the conventions for climate and forecast data' &
            // new_line('a') // '(CF): a variable a column, one record dimension, units, what' &
            // ' a column holds, the' // new_line('a') // 'comment lines as attributes. Empty' &
            // ' cells have the fill value, text is kept as arrays of' // new_line('a') &
            // 'characters. The table may have any number of rows.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write there; ends with .nc', writes=.true.), &
                           option_t('--single', '', 'numbers in single precision: 7 digits')]
        call parse_command(command, 1)
        if (.not. given(command, '-o')) call usage_error('missing -o FILE.nc', command%name)
        if (.not. is_netcdf(option_text(command, '-o', ''))) &
            call refuse_value(command, '-o', 'a file that ends with .nc')
        associate (source => command%arguments(1)%text)
            if (all(file_kind(source) /= [kind_none, kind_file, kind_folder])) &
                call fail(exit_bad_input, 'must be a file, which can be read twice, got ' // source)
            if (given(command, '--single')) call use_single_precision()
            call write_netcdf(source, option_text(command, '-o', ''), status, called=source)
        end associate
        call fail_on_error(status)
    end subroutine run_netcdf
end module faststrip_command_program_netcdf
