!> `faststrip lookup export`: a lookup table as NetCDF.
module faststrip_command_lookup_export
    use faststrip_base_status, only: status_t
    use faststrip_command_program_console, only: fail_on_error, usage_error
    use faststrip_command_lookup_file, only: read_table
    use faststrip_command_program_netcdf_file, only: is_netcdf, write_netcdf_lookup
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, refuse_value
    use faststrip_lookup_table, only: lookup_t
    implicit none
    private

    public :: run_lookup_export

contains

    !> Run the action from the command line.
    subroutine run_lookup_export()
        type(command_t) :: command
        type(lookup_t) :: lookup
        type(status_t) :: status

        command%name = 'lookup export'
        command%n_words = 2
        command%usage = 'TABLE.fslt -o FILE.nc'
        command%about = &
            'Write a table as NetCDF-4, by the conventions for climate and forecast data (CF):' &
            // new_line('a') // 'axes as coordinates, forces, scales, contacts of a wheel in' &
            // ' their units, errors.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write there; ends with .nc', writes=.true.)]
        call parse_command(command, 1)
        if (.not. given(command, '-o')) call usage_error('missing -o FILE.nc', command%name)
        if (.not. is_netcdf(option_text(command, '-o', ''))) &
            call refuse_value(command, '-o', 'a file that ends with .nc')
        ! What is no table is refused before a library is loaded.
        call read_table(command%arguments(1)%text, lookup)
        call write_netcdf_lookup(command%arguments(1)%text, option_text(command, '-o', ''), status)
        call fail_on_error(status)
    end subroutine run_lookup_export
end module faststrip_command_lookup_export
