!> `faststrip explore`: the page of the Python package, which has a command of its own.
module faststrip_command_program_explore
    use faststrip_command_program_console, only: say, fail, exit_bad_input
    use faststrip_command_program_options, only: command_argument
    use faststrip_command_program_system, only: become
    implicit none
    private

    public :: run_explore

    character(len=*), parameter :: page = 'faststrip-explore'

contains

    !> Hand over to the page's command; tell what to install where there is none.
    subroutine run_explore()
        if (command_argument_count() > 1) then
            if (any(command_argument(2) == [character(len=6) :: '--help', '-h'])) then
                call print_help()
                return
            end if
        end if
        call become(page)
        call fail(exit_bad_input, 'explore is a page of the Python package: pip install ' // &
                  "'faststrip[explore]' brings " // page)
    end subroutine run_explore

    subroutine print_help()
        call say('usage: faststrip explore [CASE.nml | WHEEL RAIL] [options]')
        call say('')
        call say('Serve the interactive explorer, on this machine only: one wheel on one rail, or')
        call say('a wheelset on its track, solved while sliders move. Runs ' // page // ' of')
        call say('the Python package, with the same options: ' // page // ' --help')
        call say('')
        call say('  --help                 this text')
    end subroutine print_help
end module faststrip_command_program_explore
