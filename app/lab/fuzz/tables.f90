!> The tables and the CSV rows of `faststrip-lab fuzz`.
module faststrip_lab_fuzz_tables
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, end_row, csv_table_t, &
                                   read_csv, read_cell, put_cells
    use faststrip_command_program_console, only: say, fail, fail_on_error, exit_bad_input
    use faststrip_lab_fuzz_cases, only: fuzz_case_t, all_families
    use faststrip_lab_fuzz_checks, only: verdict_t, is_broken, broken_checks, n_checks, &
                                         check_names, check_demands
    implicit none
    private

    public :: print_verdicts, read_verdicts, put_fuzz_header, put_fuzz_row

contains

    !> The tables of all verdicts; ends the program with an error if one is bad.
    subroutine print_verdicts(numbers, family, verdicts)
        integer, intent(in) :: numbers(:), family(:) !! of the cases
        type(verdict_t), intent(in) :: verdicts(:)

        logical :: is_bad(size(verdicts))
        integer :: i

        do i = 1, size(verdicts)
            is_bad(i) = broken_checks(verdicts(i)) /= ''
            if (is_bad(i)) &
                call say('case ' // integer_text(numbers(i)) // ' (' &
                         // trim(all_families(family(i))) // ', ' &
                         // trim(status_word(verdicts(i)%status%code)) // '): ' &
                         // broken_checks(verdicts(i)) // '; ' &
                         // trim(verdicts(i)%status%message))
        end do
        call say('family        status                    cases    share   failed checks')
        call print_rows('all', verdicts, is_bad, family > 0)
        do i = 1, size(all_families)
            call print_rows(all_families(i), verdicts, is_bad, family == i)
        end do
        call print_checks(numbers, verdicts)
        call print_times(numbers, verdicts)
        call print_worst('slowest, ms', numbers, verdicts, 1.0e-3_wp*verdicts%time_us)
        if (any(is_bad)) &
            call fail(exit_bad_input, integer_text(count(is_bad)) // ' of ' &
                      // integer_text(size(verdicts)) // ' cases failed a check; one alone with ' &
                      // 'faststrip-lab fuzz --case CASE')
    end subroutine print_verdicts

    !> Check by check: how many cases it saw, how many broke its rule, how many of these were
    !> excused by a named limitation, and the worst of the others.
    subroutine print_checks(numbers, verdicts)
        integer, intent(in) :: numbers(:)
        type(verdict_t), intent(in) :: verdicts(:)

        character(len=140) :: line
        character(len=10) :: worst_case
        logical, dimension(size(verdicts)) :: over, broken
        real(wp) :: worst
        integer :: i, j

        call say('check         tried    broken   excused     worst      case  what it demands')
        do j = 1, n_checks
            do i = 1, size(verdicts)
                over(i) = verdicts(i)%badness(j) > 1.0_wp
                broken(i) = is_broken(verdicts(i)%badness(j), verdicts(i)%status%code, j)
            end do
            worst = 0.0_wp
            worst_case = '-'
            i = maxloc(verdicts%badness(j), mask=.not. (over .and. .not. broken), dim=1)
            if (i > 0) then
                worst = max(verdicts(i)%badness(j), 0.0_wp)
                if (verdicts(i)%badness(j) > 0.0_wp) worst_case = integer_text(numbers(i))
            end if
            write (line, '(a, i7, 2i10, es10.2, a10, 2x, a)') check_names(j), &
                count(verdicts%badness(j) >= 0.0_wp), count(broken), &
                count(over .and. .not. broken), worst, adjustr(worst_case), check_demands(j)
            call say(trim(line))
        end do
    end subroutine print_checks

    !> Take the verdicts from the rows of an earlier run.
    subroutine read_verdicts(path, numbers, family, verdicts)
        character(len=*), intent(in) :: path
        integer, allocatable, intent(out) :: numbers(:), family(:) !! of the cases
        type(verdict_t), allocatable, intent(out) :: verdicts(:)

        integer, parameter :: largest_code = 200
        type(csv_table_t) :: table
        type(status_t) :: status
        character(len=:), allocatable :: name, word, message
        integer :: i, row, code

        call read_csv(path, table, status)
        call fail_on_error(status)
        if (table%n_rows == 0) call fail(exit_bad_input, 'no rows (' // path // ')')
        allocate (numbers(table%n_rows), family(table%n_rows), source=0)
        allocate (verdicts(table%n_rows))
        do row = 1, table%n_rows
            call read_cell(table, row, 'case', numbers(row), status)
            call read_cell(table, row, 'family', name, status)
            call read_cell(table, row, 'status', word, status)
            call read_cell(table, row, 'message', message, status)
            call read_cell(table, row, 'time_us', verdicts(row)%time_us, status)
            do i = 1, n_checks
                call read_cell(table, row, trim(check_names(i)), verdicts(row)%badness(i), status)
            end do
            call fail_on_error(status)
            family(row) = findloc(all_families == name, .true., dim=1)
            do code = 0, largest_code
                if (status_word(code) == word) exit
            end do
            if (family(row) == 0 .or. code > largest_code) &
                call fail(exit_bad_input, 'no row of a fuzz run: ' // integer_text(row) // ' (' &
                          // path // ')')
            verdicts(row)%status%code = code
            verdicts(row)%status%message = message
        end do
    end subroutine read_verdicts

    !> How the cases of one family, or of all, ended.
    subroutine print_rows(name, verdicts, is_bad, counts)
        character(len=*), intent(in) :: name
        type(verdict_t), intent(in) :: verdicts(:)
        logical, intent(in) :: is_bad(:)
        logical, intent(in) :: counts(:) ! which cases are of the family

        character(len=80) :: line
        character(len=12) :: family_name
        integer :: code, n

        family_name = name
        do code = 0, maxval(verdicts%status%code)
            n = count(counts .and. verdicts%status%code == code)
            if (n == 0) cycle
            write (line, '(a, 2x, a, i9, f8.2, a, i9)') family_name, status_word(code), n, &
                100.0_wp*n/count(counts), ' %', &
                count(counts .and. verdicts%status%code == code .and. is_bad)
            call say(trim(line))
        end do
    end subroutine print_rows

    !> Times of all cases and of each status.
    subroutine print_times(numbers, verdicts)
        integer, intent(in) :: numbers(:)
        type(verdict_t), intent(in) :: verdicts(:)

        integer :: code

        call say('time per case, ms               median      99 %   longest    case')
        call print_time('all', numbers, verdicts%time_us)
        do code = 0, maxval(verdicts%status%code)
            if (.not. any(verdicts%status%code == code)) cycle
            call print_time(status_word(code), pack(numbers, verdicts%status%code == code), &
                            pack(verdicts%time_us, verdicts%status%code == code))
        end do
    end subroutine print_times

    subroutine print_time(name, numbers, time_us)
        character(len=*), intent(in) :: name
        integer, intent(in) :: numbers(:)
        real(wp), intent(in) :: time_us(:)

        character(len=80) :: line
        character(len=26) :: words

        words = name
        write (line, '(a, 3f10.2, i8)') words, 1.0e-3_wp*quantile(time_us, 0.5_wp), &
            1.0e-3_wp*quantile(time_us, 0.99_wp), 1.0e-3_wp*maxval(time_us), &
            numbers(maxloc(time_us, dim=1))
        call say(trim(line))
    end subroutine print_time

    !> The value below which a share of the others lies, by halving.
    pure real(wp) function quantile(values, share)
        real(wp), intent(in) :: values(:), share

        real(wp) :: low, middle
        integer :: i

        low = 0.0_wp
        quantile = maxval(values)
        do i = 1, 60
            middle = 0.5_wp*(low + quantile)
            if (count(values <= middle) < share*size(values)) then
                low = middle
            else
                quantile = middle
            end if
        end do
    end function quantile

    !> The ten cases with the largest values, to be run again by their numbers.
    subroutine print_worst(what, numbers, verdicts, values)
        character(len=*), intent(in) :: what
        integer, intent(in) :: numbers(:)
        type(verdict_t), intent(in) :: verdicts(:)
        real(wp), intent(in) :: values(:)

        integer, parameter :: most = 10
        logical :: told(size(values))
        character(len=80) :: line
        integer :: i, worst

        call say(what // ':')
        told = .false.
        do i = 1, min(most, size(values))
            worst = maxloc(values, mask=.not. told, dim=1)
            told(worst) = .true.
            write (line, '(a, i8, 2x, a, es10.2)') '  case', numbers(worst), &
                status_word(verdicts(worst)%status%code), values(worst)
            call say(trim(line))
        end do
    end subroutine print_worst

    !> The names of the columns.
    subroutine put_fuzz_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_header(writer, [character(len=16) :: 'case', 'family', 'load_N', &
                                 'strips_asked', 'points', 'status', 'violation', 'message', &
                                 'strips', 'patches', 'penetration_mm', 'area_mm2', 'pmax_MPa', &
                                 'ymin_mm', 'ymax_mm', 'load_error', 'overlap', 'overlap_y_mm', &
                                 'est_penetration', 'est_pmax', 'est_area', 'passes', &
                                 'iterations', 'time_us', check_names])
    end subroutine put_fuzz_header

    !> One case; of each check what it found over what it allows, -1 where it was not asked.
    subroutine put_fuzz_row(writer, case, verdict)
        type(csv_writer_t), intent(inout) :: writer !! an open file with its header
        type(fuzz_case_t), intent(in) :: case
        type(verdict_t), intent(in) :: verdict

        call put_cell(writer, case%number)
        call put_cell(writer, trim(all_families(case%family)))
        call put_cell(writer, case%load)
        call put_cell(writer, case%methods%strips_per_patch)
        call put_cell(writer, size(case%gap%y))
        call put_cell(writer, trim(status_word(verdict%status%code)))
        call put_cell(writer, broken_checks(verdict))
        call put_cell(writer, trim(verdict%status%message))
        call put_cells(writer, [verdict%strips, verdict%result%n_patches])
        call put_cells(writer, [verdict%result%penetration, verdict%result%area, &
                                verdict%result%pmax, verdict%result%y_min, verdict%result%y_max, &
                                verdict%load_error, verdict%overlap, verdict%overlap_y])
        call put_cells(writer, verdict%est_err)
        call put_cell(writer, verdict%result%passes)
        call put_cell(writer, verdict%result%iterations)
        call put_cell(writer, verdict%time_us)
        call put_cells(writer, verdict%badness)
        call end_row(writer)
    end subroutine put_fuzz_row
end module faststrip_lab_fuzz_tables
