!> The command line of faststrip.
program faststrip_main
    use faststrip_command_program_console, only: say, usage_error, version_text
    use faststrip_command_program_options, only: command_argument, need_nothing_more, &
                                                 refuse_subcommand
    use faststrip_command_program_files, only: clear_leftovers
    use faststrip_command_table_integral, only: run_integral
    use faststrip_command_contact, only: run_contact
    use faststrip_command_batch, only: run_batch
    use faststrip_command_batch_merge, only: run_merge
    use faststrip_command_contact_sweep, only: run_sweep
    use faststrip_command_table, only: run_table
    use faststrip_command_profile, only: run_profile
    use faststrip_command_wheelset, only: run_wheelset
    use faststrip_command_wheelset_conicity, only: run_conicity
    use faststrip_command_program_netcdf, only: run_netcdf
    use faststrip_command_program_netcdf_file, only: finish_as_asked
    use faststrip_command_program_explore, only: run_explore
    use faststrip_command_lookup, only: run_lookup
    use faststrip_command_settings_list, only: run_settings
    use faststrip_command_rows_columns, only: run_columns
    implicit none

    if (command_argument_count() == 0) call usage_error('a subcommand is needed', '')
    call finish_as_asked()
    select case (command_argument(1))
    case ('integral'); call run_integral()
    case ('contact'); call run_contact()
    case ('batch'); call run_batch()
    case ('merge'); call run_merge()
    case ('sweep'); call run_sweep()
    case ('table'); call run_table()
    case ('profile'); call run_profile()
    case ('wheelset'); call run_wheelset()
    case ('conicity'); call run_conicity()
    case ('netcdf'); call run_netcdf()
    case ('explore'); call run_explore()
    case ('lookup'); call run_lookup()
    case ('settings'); call run_settings()
    case ('columns'); call run_columns()
    case ('--help', '-h', 'help')
        call need_nothing_more()
        call print_help()
    case ('--version', '-V')
        call need_nothing_more()
        call say(version_text())
    case default
        call refuse_subcommand()
    end select
    call clear_leftovers()

contains

    subroutine print_help()
        call say('usage: faststrip SUBCOMMAND [arguments] [options]')
        call say('')
        call say('Wheel/rail contact by the modified strip method of Lack and Gerlici (2014).')
        call say('')
        call say('  integral               influence integrals of strips')
        call say('  contact CASE.nml       one contact, from two profiles or a gap file')
        call say('  batch CASES.csv        one contact per row of a CSV file')
        call say('  merge PART.csv...      parts of a batch joined')
        call say('  sweep CASE.nml         a sweep over displacements, a row for each and method')
        call say('  wheelset CASE.nml      contacts of a wheelset on a track, one row a contact')
        call say('  profile FILE...        wheel and rail profiles: described, cleaned, drawn')
        call say('  conicity               contact geometry and equivalent conicity of a wheelset')
        call say('  lookup ACTION          tables of creep forces: made, checked, evaluated')
        call say('  table [FILE.csv]       coefficient tables of the integrals: made, audited')
        call say('  netcdf TABLE.csv       a table as NetCDF')
        call say('  settings               what case files can set: names, defaults, options')
        call say('  columns                what columns of tables hold: units, meanings, names')
        call say('  explore                the interactive explorer, of the Python package')
        call say('')
        call say('  SUBCOMMAND --help      what a subcommand takes')
        call say('  --version              name, version and revision')
        call say('')
        call say('Units are mm, N, MPa, rad. Exit codes: 1 bad input, 2 usage, 3 no convergence,')
        call say('128 + n ended by signal n.')
    end subroutine print_help
end program faststrip_main
