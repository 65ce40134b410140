!> `faststrip table`: coefficient tables of the influence integral, made anew and audited.
module faststrip_command_table
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_tables_polynomials, only: basis_monomial, basis_chebyshev
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row, fit_lsq, fit_minimax_error, fit_author
    use faststrip_command_program_console, only: fail_on_error, usage_error, progress
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer, option_word, &
                                                 option_pair, refuse_value
    use faststrip_command_table_audit, only: write_audit
    use faststrip_command_table_curves, only: write_curves, write_degrees
    use faststrip_command_table_distances, only: parse_distances
    use faststrip_command_table_files, only: write_table, most_array_rows
    implicit none
    private

    public :: run_table

contains

    !> Run the subcommand from the command line.
    subroutine run_table()
        type(command_t) :: command
        type(refit_t) :: spec
        integer, allocatable :: n(:)

        call describe(command)
        call parse_command(command, 0, n_optional=1)
        if (given(command, '--audit')) then
            call run_audit(command)
            return
        end if
        if (given(command, '--errata')) &
            call usage_error('--errata is now a subcommand of its own: faststrip-lab errata', &
                             command%name)
        if (size(command%arguments) > 0) &
            call usage_error('a file goes with --audit only: ' // command%arguments(1)%text, &
                             command%name)
        call take_spec(command, spec)
        if (given(command, '--curves') .or. given(command, '--degrees')) then
            call write_pictures(command, spec)
        else
            call take_distances(command, '0:20', n)
            call make_table(command, spec, n)
        end if
    end subroutine run_table

    subroutine describe(command)
        type(command_t), intent(inout) :: command

        character(len=*), parameter :: line = new_line('a')

        command%name = 'table'
        command%usage = '[--audit [FILE.csv]]'
        command%about = &
            'Polynomials E(L), L = log10 b, whose 10**E is the influence integral i_n(b) or one' &
            // line // 'half of it. Without --audit a table is made: one row a strip distance n,' &
            // line // 'with its largest and rms relative error against the exact integral.' &
            // line // '  lsq       least squares of E at 3001 nodes uniform in L' &
            // line // '  minimax   least largest relative error, by Remez''s exchange' &
            // line // '  author    as Lack and Gerlici: b = 0.01(0.01)10, 500-panel trapezoids' &
            // line // '--audit checks a table made here, or one in the layout of the paper' &
            // line // '(index,a6,...,a0; index = 2n; the half), without FILE.csv the published' &
            // line // 'one: errors, residual against a fresh fit, the one coefficient whose' &
            // line // 'change explains it best, errors one decade outside. The summary goes to' &
            // line // 'stdout with -o, else to stderr.' // line
        command%options = [ &
            option_t('--degree', 'D', 'degree of the polynomials, 0 to 40 (default 6)'), &
            option_t('--n', 'LIST', 'strip distances: 0:20 (default), 3, 0,1,5, 0:3,10'), &
            option_t('--range', 'LOW:HIGH', 'range of log10 b, within -8:8 (default -2:1)'), &
            option_t('--fit', 'NAME', 'lsq (default), minimax or author'), &
            option_t('--basis', 'NAME', 'monomial (default; powers of L) or chebyshev'), &
            option_t('--quantity', 'NAME', '10**E is half (default) or full integral'), &
            option_t('--format', 'NAME', 'csv (default), fortran, c or json'), &
            option_t('-o', 'FILE', 'write the table or the audit there (default stdout)', &
                     writes=.true.), &
            option_t('--audit', '', 'check a table against the exact integral'), &
            option_t('--errata', '', 'now: faststrip-lab errata'), &
            option_t('--curves', 'FILE', 'exact and published curves, L from -4 to 3', &
                     writes=.true.), &
            option_t('--degrees', 'FILE', 'error of the fits for degrees 0 to 40', writes=.true.)]
    end subroutine describe

    subroutine run_audit(command)
        type(command_t), intent(in) :: command

        character(len=10), parameter :: foreign(9) = [character(len=10) :: '--degree', '--n', &
            '--range', '--basis', '--quantity', '--format', '--errata', '--curves', '--degrees']
        character(len=:), allocatable :: file
        integer :: fit, i

        do i = 1, size(foreign)
            if (given(command, trim(foreign(i)))) &
                call usage_error('--audit must not be given with ' // trim(foreign(i)), &
                                 command%name)
        end do
        fit = 0
        if (given(command, '--fit')) fit = take_fit(command)
        file = ''
        if (size(command%arguments) > 0) file = command%arguments(1)%text
        call write_audit(file, fit, option_text(command, '-o', '-'))
    end subroutine run_audit

    subroutine write_pictures(command, spec)
        type(command_t), intent(in) :: command
        type(refit_t), intent(in) :: spec

        integer, allocatable :: n(:)

        if (given(command, '-o') .or. given(command, '--format')) &
            call usage_error('--curves and --degrees must not be given with -o and --format', &
                             command%name)
        if (given(command, '--curves')) then
            call take_distances(command, '0:20', n)
            call write_curves(option_text(command, '--curves', '-'), n)
        end if
        if (given(command, '--degrees')) then
            call take_distances(command, '0,1,5,20', n)
            call write_degrees(option_text(command, '--degrees', '-'), n, spec%l_min, spec%l_max)
        end if
    end subroutine write_pictures

    subroutine make_table(command, spec, n)
        type(command_t), intent(in) :: command
        type(refit_t), intent(in) :: spec
        integer, intent(in) :: n(:)

        type(refit_plan_t) :: plan
        type(table_row_t), allocatable :: rows(:)
        type(status_t) :: status
        character(len=:), allocatable :: format
        integer :: i

        format = option_word(command, '--format', 'csv', &
                             [character(len=7) :: 'csv', 'fortran', 'c', 'json'])
        if (format == 'fortran' .and. size(n) > most_array_rows) &
            call usage_error('more than ' // integer_text(most_array_rows) // ' rows are too ' // &
                             'many for --format fortran: ' // integer_text(size(n)), command%name)
        call prepare_refit(spec, plan, status)
        call fail_on_error(status)
        allocate (rows(size(n)))
        do i = 1, size(n)
            call refit_row(plan, n(i), rows(i), status)
            call fail_on_error(status)
            call progress('row', i, size(n))
        end do
        call write_table(option_text(command, '-o', '-'), format, plan, rows)
    end subroutine make_table

    subroutine take_spec(command, spec)
        type(command_t), intent(in) :: command
        type(refit_t), intent(out) :: spec

        spec%degree = option_integer(command, '--degree', 6)
        spec%fit = take_fit(command)
        select case (option_word(command, '--basis', 'monomial', &
                                 [character(len=9) :: 'monomial', 'chebyshev']))
        case ('monomial'); spec%basis = basis_monomial
        case ('chebyshev'); spec%basis = basis_chebyshev
        end select
        spec%half = option_word(command, '--quantity', 'half', ['half', 'full']) == 'half'
        if (given(command, '--range')) call take_range(command, spec%l_min, spec%l_max)
    end subroutine take_spec

    integer function take_fit(command) result(fit)
        type(command_t), intent(in) :: command

        fit = fit_lsq
        select case (option_word(command, '--fit', 'lsq', &
                                 [character(len=7) :: 'lsq', 'minimax', 'author']))
        case ('lsq'); fit = fit_lsq
        case ('minimax'); fit = fit_minimax_error
        case ('author'); fit = fit_author
        end select
    end function take_fit

    subroutine take_range(command, l_min, l_max)
        type(command_t), intent(in) :: command
        real(wp), intent(out) :: l_min, l_max

        real(wp) :: ends(2)

        call option_pair(command, '--range', '', 'LOW:HIGH', ends)
        l_min = ends(1)
        l_max = ends(2)
    end subroutine take_range

    subroutine take_distances(command, default, n)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: default
        integer, allocatable, intent(out) :: n(:)

        character(len=:), allocatable :: problem

        call parse_distances(option_text(command, '--n', default), n, problem)
        if (len(problem) > 0) call refuse_value(command, '--n', problem)
    end subroutine take_distances
end module faststrip_command_table
