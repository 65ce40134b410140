!> The command line of the laboratory: what measures and tries faststrip inside its own checkout.
program faststrip_lab
    use faststrip_command_program_console, only: say, usage_error, version_text, name_program
    use faststrip_command_program_options, only: command_argument, need_nothing_more, &
                                                 refuse_subcommand
    use faststrip_command_program_files, only: clear_leftovers
    use faststrip_lab_fuzz, only: run_fuzz
    use faststrip_lab_studies_errata, only: run_errata
    use faststrip_lab_forces_data, only: run_force_data
    use faststrip_lab_forces_features, only: run_force_features
    use faststrip_lab_grid_bench, only: run_bench
    use faststrip_lab_studies_reference_scenes, only: run_scenes
    use faststrip_lab_claims, only: run_claims
    use faststrip_lab_claims_references, only: run_references
    implicit none
    ! Alike the other program on purpose: two short lists of subcommands, nothing to share.

    call name_program('faststrip-lab')
    if (command_argument_count() == 0) call usage_error('a subcommand is needed', '')
    select case (command_argument(1))
    case ('bench'); call run_bench()
    case ('fuzz'); call run_fuzz()
    case ('scenes'); call run_scenes()
    case ('claims'); call run_claims()
    case ('references'); call run_references()
    case ('errata'); call run_errata()
    case ('force-data'); call run_force_data()
    case ('force-features'); call run_force_features()
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
        call say('usage: faststrip-lab SUBCOMMAND [arguments] [options]')
        call say('')
        call say('Times, errors and trials of faststrip, for its developers; needs the checkout.')
        call say('')
        call say('  bench WHAT             times and errors of the methods')
        call say('  errata                 the paper as printed and as it should be')
        call say('  force-data             reference forces of random contacts')
        call say('  force-features FILE... forces of FASTSTRIP beside these')
        call say('  fuzz                   random gaps, checked')
        call say('  claims                 what the methods make of contacts that are known')
        call say('  scenes                 reference forces of many contacts')
        call say('  references             figures of contacts that nothing was fitted to')
        call say('')
        call say('  SUBCOMMAND --help      what a subcommand takes')
        call say('  --version              name, version and revision')
        call say('')
        call say('Units are mm, N, MPa, rad. Exit codes: 1 bad input, 2 usage, 3 no convergence,')
        call say('128 + n ended by signal n.')
    end subroutine print_help
end program faststrip_lab
