!> `faststrip lookup`: tables of creep forces for vehicle codes.
module faststrip_command_lookup
    use faststrip_command_program_console, only: say, usage_error
    use faststrip_command_lookup_eval, only: run_lookup_eval
    use faststrip_command_lookup_export, only: run_lookup_export
    use faststrip_command_lookup_info, only: run_lookup_info
    use faststrip_command_lookup_join, only: run_lookup_join
    use faststrip_command_lookup_make, only: run_lookup_make, run_lookup_wheel
    use faststrip_command_lookup_test, only: run_lookup_test
    use faststrip_command_program_options, only: command_argument
    implicit none
    private

    public :: run_lookup

    character(len=*), parameter :: actions = 'make, wheel, join, info, test, eval or export'

contains

    !> Run the action that the command line names.
    subroutine run_lookup()
        character(len=:), allocatable :: action

        action = ''
        if (command_argument_count() > 1) action = command_argument(2)
        select case (action)
        case ('make'); call run_lookup_make()
        case ('wheel'); call run_lookup_wheel()
        case ('join'); call run_lookup_join()
        case ('info'); call run_lookup_info()
        case ('test'); call run_lookup_test()
        case ('eval'); call run_lookup_eval()
        case ('export'); call run_lookup_export()
        case ('--help', '-h'); call print_help()
        case (''); call usage_error('an action is needed: ' // actions, 'lookup')
        case default
            call usage_error('an action must be ' // actions // ', got ' // action, 'lookup')
        end select
    end subroutine run_lookup

    subroutine print_help()
        call say('usage: faststrip lookup ACTION [arguments] [options]')
        call say('')
        call say('Tables for vehicle codes that look forces up: creep forces on Hertz ellipses,')
        call say('over a/b and three normalised creepages; contacts of a wheel on a rail and their')
        call say('creep forces, over displacement, yaw, load, creepages. See docs/embedding.md.')
        call say('')
        call say('  make -o TABLE.fslt            a table of Hertz ellipses, and its errors')
        call say('  wheel CASE.nml -o TABLE.fslt  a table of a wheel on a rail, and its errors')
        call say('  join PART.fslt...             a table from parts that several processes made')
        call say('  info TABLE.fslt               what a table holds, and its errors')
        call say('  test TABLE.fslt               errors on fresh states, and look-ups per second')
        call say('  eval TABLE.fslt CSV           forces of the states of a CSV file')
        call say('  export TABLE.fslt -o FILE.nc  the table as NetCDF')
        call say('')
        call say('options:')
        call say('  --help                            this text')
        call say('  ACTION --help                     what an action takes')
    end subroutine print_help
end module faststrip_command_lookup
