!> `faststrip-lab fuzz`: contacts of many random gaps, solved and checked.
module faststrip_lab_fuzz
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_comment, put_header, put_cells, &
                                   end_row
    use faststrip_command_program_console, only: fail_on_error, usage_error, progress, say, &
                                                 begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer, option_word
    use faststrip_lab_fuzz_cases, only: fuzz_case_t, draw_case, all_families
    use faststrip_lab_fuzz_faults, only: fault_names
    use faststrip_lab_fuzz_checks, only: verdict_t
    use faststrip_lab_fuzz_run, only: workspaces_t, try_case
    use faststrip_lab_fuzz_tables, only: print_verdicts, read_verdicts, put_fuzz_header, &
                                         put_fuzz_row
    implicit none
    private

    public :: run_fuzz

contains

    !> Run the subcommand from the command line.
    subroutine run_fuzz()
        type(command_t) :: command
        integer :: seed, first, cases, number
        type(fuzz_case_t) :: case
        type(verdict_t), allocatable :: verdicts(:)
        integer, allocatable :: family(:), numbers(:)
        type(workspaces_t) :: work

        call take_command(command)
        cases = option_integer(command, '--cases', 1000, least=1)
        seed = option_integer(command, '--seed', 1, least=0)
        first = option_integer(command, '--first', 1, least=1)
        if (cases > huge(cases) - first) &
            call usage_error('--cases must end before case ' // integer_text(huge(cases)) &
                             // ', got ' // integer_text(cases), command%name)
        work%thorough = given(command, '--thorough')
        work%by_cells = option_word(command, '--solver', 'strip', &
                                    [character(len=5) :: 'strip', 'cells']) == 'cells'
        work%fault = option_text(command, '--plant', '')
        if (work%fault == 'list') then
            do number = 1, size(fault_names)
                call say(trim(fault_names(number)))
            end do
            return
        end if
        if (work%fault /= '' .and. .not. any(fault_names == work%fault)) &
            call usage_error('unknown fault: ' // work%fault, command%name)
        if (given(command, '--read')) then
            if (given(command, '-o')) &
                call usage_error('--read must not be given with -o', command%name)
            call read_verdicts(option_text(command, '--read', ''), numbers, family, verdicts)
            call print_verdicts(numbers, family, verdicts)
            return
        end if
        if (given(command, '--case')) then
            if (given(command, '--first') .or. given(command, '--cases')) &
                call usage_error('--case must not be given with --first and --cases', command%name)
            first = option_integer(command, '--case', 1, least=1)
            cases = 1
        end if
        if (given(command, '--gap-of')) then
            number = option_integer(command, '--gap-of', 1, least=1)
            call draw_case(seed, number, case)
            call write_gap(option_text(command, '-o', '-'), seed, case)
            return
        end if
        call try_cases(command, seed, first, cases, work, numbers, family, verdicts)
        call print_verdicts(numbers, family, verdicts)
    end subroutine run_fuzz

    subroutine take_command(command)
        type(command_t), intent(inout) :: command

        command%name = 'fuzz'
        command%usage = ''
        command%about = &
            'For developers: solve the contacts of many random gaps by strips and check the' &
            // new_line('a') // 'answers. A case is the same wherever the run starts. Exit code' &
            // ' 1 if one fails a check.' // new_line('a')
        command%options = [ &
            option_t('--cases', 'INTEGER', 'number of cases (default 1000)'), &
            option_t('--seed', 'INTEGER', 'which series of cases (default 1)'), &
            option_t('--first', 'INTEGER', 'number of the first case (default 1)'), &
            option_t('--case', 'INTEGER', 'this case only'), &
            option_t('--family', 'NAME', 'only the cases of this family'), &
            option_t('--read', 'FILE', 'solve nothing, check the rows that -o wrote there', &
                     reads=.true.), &
            option_t('--solver', 'NAME', 'strip (default) or cells'), &
            option_t('--thorough', '', 'every check on every case, NORM too'), &
            option_t('--plant', 'FAULT', 'put an error into every answer; list: which there are'), &
            option_t('--gap-of', 'INTEGER', 'write the gap of this case instead, to -o'), &
            option_t('-o', 'FILE', 'write one CSV row per case there', writes=.true.)]
        call parse_command(command, 0)
    end subroutine take_command

    !> Solve and check the cases, and write their rows if asked for.
    subroutine try_cases(command, seed, first, cases, work, numbers, family, verdicts)
        type(command_t), intent(in) :: command
        integer, intent(in) :: seed, first, cases
        type(workspaces_t), intent(inout) :: work
        integer, allocatable, intent(out) :: numbers(:), family(:)
        type(verdict_t), allocatable, intent(out) :: verdicts(:)

        character(len=:), allocatable :: only
        type(csv_writer_t) :: writer
        type(fuzz_case_t) :: case
        integer :: number, n

        only = option_text(command, '--family', '')
        if (only /= '' .and. .not. any(all_families == only)) &
            call usage_error('unknown family: ' // only, command%name)
        if (given(command, '-o')) then
            call begin_table(writer, option_text(command, '-o', ''))
            call put_fuzz_header(writer)
        end if
        allocate (verdicts(cases), family(cases), numbers(cases))
        n = 0
        do number = first, first + cases - 1
            call draw_case(seed, number, case)
            if (only /= '' .and. all_families(case%family) /= only) cycle
            n = n + 1
            numbers(n) = number
            family(n) = case%family
            call try_case(seed, case, work, verdicts(n))
            if (given(command, '-o')) call put_fuzz_row(writer, case, verdicts(n))
            call progress('case', number - first + 1, cases)
        end do
        if (given(command, '-o')) then
            call end_table(writer)
        end if
        if (n == 0) call usage_error('no case of this family among those asked: ' // only, &
                                     command%name)
        numbers = numbers(:n)
        family = family(:n)
        verdicts = verdicts(:n)
    end subroutine try_cases

    !> Write a case's gap so that a case file can name it.
    subroutine write_gap(path, seed, case)
        character(len=*), intent(in) :: path
        integer, intent(in) :: seed
        type(fuzz_case_t), intent(in) :: case

        type(csv_writer_t) :: writer
        type(status_t) :: status
        character(len=24) :: load
        integer :: i

        call open_csv(writer, path, status)
        call fail_on_error(status)
        write (load, '(es23.16)') case%load
        call put_comment(writer, 'random gap ' // integer_text(case%number) // ' of seed ' &
                         // integer_text(seed) // ': ' // trim(all_families(case%family)) &
                         // ', load ' // trim(adjustl(load)) // ' N, ' &
                         // integer_text(case%methods%strips_per_patch) // ' strips')
        call put_header(writer, [character(len=12) :: 'y_mm', 'h_mm', 'inv2R_per_mm'])
        do i = 1, size(case%gap%y)
            call put_cells(writer, [case%gap%y(i), case%gap%h(i), case%gap%inv2r(i)])
            call end_row(writer)
        end do
        call end_table(writer)
    end subroutine write_gap
end module faststrip_lab_fuzz
