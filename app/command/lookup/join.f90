!> `faststrip lookup join`: a table of creep forces from its parts.
module faststrip_command_lookup_join
    use, intrinsic :: iso_fortran_env, only: int8
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, exit_bad_input
    use faststrip_command_lookup_file, only: write_table
    use faststrip_command_lookup_options, only: method_options, take_choice, take_threads, &
                                                choice_text, usual_tests, usual_wheel_tests
    use faststrip_command_lookup_family, only: families_t, make_family, release_family
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer, any_number
    use faststrip_files_bytes, only: read_bytes
    use faststrip_lookup_bytes, only: open_lookup
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel
    use faststrip_tabulate_family, only: family_t
    use faststrip_tabulate_forces, only: choice_t
    use faststrip_tabulate_judge, only: judge_table
    use faststrip_tabulate_make, only: first_seed
    use faststrip_tabulate_parts, only: take_values, is_solved, units_of
    implicit none
    private

    public :: run_lookup_join

contains

    !> Run the action from the command line.
    subroutine run_lookup_join()
        type(command_t) :: command
        type(choice_t) :: choice
        type(families_t), target :: families
        class(family_t), pointer :: family
        type(lookup_t) :: lookup
        type(status_t) :: status
        integer(int8), allocatable :: bytes(:)
        integer :: i, tests, missing

        command%name = 'lookup join'
        command%n_words = 2
        command%usage = 'PART.fslt...'
        command%about = &
            'Join the parts that lookup make --part or lookup wheel --part made, and check the' &
            // new_line('a') // 'table: the same bytes as by one process. The method has to be' &
            // ' that of the parts.' // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the table there', writes=.true.), &
            option_t('--case', 'CASE.nml', 'wheel and rail of the table of a wheel', &
                     reads=.true.), &
            option_t('--tests', 'N', 'random contacts to check it on (default 10000; of a wheel' &
                     // new_line('a') // '2000 states)'), &
            method_options]
        call parse_command(command, 1, any_number)
        if (option_text(command, '-o', '-') == '-') &
            call usage_error('-o TABLE.fslt is needed: the table is no text', command%name)
        call take_choice(command, choice)
        tests = option_integer(command, '--tests', usual_tests, least=100, most=10000000)
        associate (first => command%arguments(1)%text)
            call read_bytes(first, bytes, status)
            call fail_on_error(status)
            call open_lookup(bytes, lookup, status, may_lack=.true.)
            call fail_on_error(status, first)
            choice%nu = lookup%nu
            if (index(lookup%text, choice_text(choice)) == 0) &
                call fail(exit_bad_input, 'parts must be of the ' // choice_text(choice) &
                          // ' (' // first // ')')
        end associate
        do i = 2, size(command%arguments)
            call take_values(command%arguments(i)%text, lookup, status)
            call fail_on_error(status)
        end do
        missing = 0
        do i = 1, units_of(lookup)
            if (.not. is_solved(lookup, i)) missing = missing + 1
        end do
        if (missing > 0) call fail(exit_bad_input, 'parts are missing: ' // integer_text(missing) &
                                   // ' of ' // integer_text(units_of(lookup)) // ' ' &
                                   // trim(merge('contacts', 'a/b     ', &
                                                 lookup%kind == lookup_kind_wheel)))
        if (lookup%kind == lookup_kind_wheel) then
            if (.not. given(command, '--case')) &
                call usage_error('parts of the table of a wheel need --case CASE.nml', command%name)
            tests = option_integer(command, '--tests', usual_wheel_tests, least=100, most=10000000)
        end if
        call make_family(command, choice, take_threads(command), lookup, families, family)
        call judge_table(family, tests, first_seed, lookup, status)
        call fail_on_error(status)
        call release_family(families)
        lookup%promised = 0.0
        call write_table(option_text(command, '-o', ''), lookup)
    end subroutine run_lookup_join
end module faststrip_command_lookup_join
