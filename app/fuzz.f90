!> `faststrip fuzz`: the normal solution tried on many random gaps.
module faststrip_app_fuzz
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_get_flag, ieee_set_flag, &
                                             ieee_invalid, ieee_divide_by_zero, ieee_overflow
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, is_error, status_word, st_fallback_used, &
                                st_overlap_left, st_no_finite_patch
    use faststrip_text, only: integer_text
    use faststrip_csv, only: csv_writer_t, open_csv, put_comment, put_header, put_cell, end_row, &
                             close_csv, csv_table_t, read_csv, require_column, cell_text, &
                             cell_number
    use faststrip_material, only: material_t, normal_compliance
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_profile_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, gap_at
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, normal_result_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_lattice, only: lattice_workspace_t, reserve_lattice, lattice_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips, strips_load
    use faststrip_app_console, only: say, fail, fail_on_error, usage_error, progress, put_origin, &
                                     exit_bad_input
    use faststrip_app_options, only: command_t, option_t, parse_command, given, option_text, &
                                     option_integer
    use faststrip_app_fuzz_gaps, only: fuzz_case_t, make_fuzz_case, family_names
    implicit none
    private

    public :: run_fuzz

    real(wp), parameter :: load_tolerance = 1.0e-6_wp
    real(wp), parameter :: overlap_tolerance = 0.02_wp ! of the penetration

    !> What the solvers work in.
    type :: room_t
        character(len=:), allocatable :: solver !! 'strip' or 'lattice'
        type(strip_workspace_t) :: strip
        type(lattice_workspace_t) :: lattice
        type(gap_curve_t) :: curve
        type(contact_strips_t) :: strips
    end type room_t

    !> What came of one case.
    type :: verdict_t
        type(status_t) :: status
        type(normal_result_t) :: result
        integer :: strips = 0
        real(wp) :: load_error = 0.0_wp !! Q/Q0 - 1
        real(wp) :: overlap = 0.0_wp    !! largest outside the patches, over the penetration
        real(wp) :: overlap_y = 0.0_wp  !! where, mm
        real(wp) :: time_us = 0.0_wp
        character(len=24) :: violation = ''
    end type verdict_t

    !> One line of the table: how often a family ended with a status.
    type :: tally_t
        integer :: family = 0
        integer :: code = 0
        integer :: n = 0
    end type tally_t

contains

    !> Run the subcommand from the command line.
    subroutine run_fuzz()
        type(command_t) :: command
        integer :: seed, first, cases, number
        type(fuzz_case_t) :: fuzz_case
        type(verdict_t), allocatable :: verdicts(:)
        integer, allocatable :: family(:), numbers(:)
        type(room_t) :: room
        type(csv_writer_t) :: writer
        type(status_t) :: written

        command%name = 'fuzz'
        command%usage = ''
        command%about = &
            'For developers: solve the normal problem of many random gaps by strips and check the' &
            // new_line('a') // 'answers. A case is the same wherever the run starts. Exit code' &
            // ' 1 if one fails a check.' // new_line('a')
        command%options = [ &
            option_t('--cases', 'INTEGER', 'number of cases (default 1000)'), &
            option_t('--seed', 'INTEGER', 'which series of cases (default 1)'), &
            option_t('--first', 'INTEGER', 'number of the first case (default 1)'), &
            option_t('--case', 'INTEGER', 'this case only'), &
            option_t('--read', 'FILE', 'solve nothing, judge the rows that -o wrote there'), &
            option_t('--solver', 'NAME', 'strip (default) or lattice'), &
            option_t('--gap-of', 'INTEGER', 'write the gap of this case instead, to -o'), &
            option_t('-o', 'FILE', 'write one CSV row per case there')]
        call parse_command(command, 0)
        cases = option_integer(command, '--cases', 1000)
        seed = option_integer(command, '--seed', 1)
        first = option_integer(command, '--first', 1)
        if (cases < 1 .or. cases > huge(cases) - max(first, 1)) &
            call usage_error('--cases is below 1 or too large: ' // integer_text(cases), &
                             command%name)
        if (seed < 0) call usage_error('--seed is negative: ' // integer_text(seed), command%name)
        if (first < 1) call usage_error('--first is below 1: ' // integer_text(first), command%name)
        room%solver = option_text(command, '--solver', 'strip')
        if (room%solver /= 'strip' .and. room%solver /= 'lattice') &
            call usage_error('unknown solver: ' // room%solver, command%name)
        if (given(command, '--read')) then
            call read_verdicts(option_text(command, '--read', ''), numbers, family, verdicts)
            call print_verdicts(numbers, family, verdicts)
            return
        end if
        if (given(command, '--case')) then
            if (given(command, '--first') .or. given(command, '--cases')) &
                call usage_error('--case goes without --first and --cases', command%name)
            first = option_integer(command, '--case', 1)
            cases = 1
        end if
        if (given(command, '--gap-of')) then
            number = option_integer(command, '--gap-of', 1)
            if (number < 1) &
                call usage_error('--gap-of is below 1: ' // integer_text(number), command%name)
            call make_fuzz_case(seed, number, fuzz_case)
            call write_gap(option_text(command, '-o', '-'), seed, fuzz_case)
            return
        end if
        if (given(command, '-o')) then
            call open_csv(writer, option_text(command, '-o', ''), written)
            call fail_on_error(written)
            call put_origin(writer)
            call put_fuzz_header(writer)
        end if
        allocate (verdicts(cases), family(cases))
        numbers = [(number, number=first, first + cases - 1)]
        do number = first, first + cases - 1
            associate (verdict => verdicts(number - first + 1))
                call make_fuzz_case(seed, number, fuzz_case)
                family(number - first + 1) = fuzz_case%family
                call try_case(fuzz_case, room, verdict)
                if (given(command, '-o')) call put_fuzz_row(writer, fuzz_case, verdict)
            end associate
            call progress('case', number - first + 1, cases)
        end do
        if (given(command, '-o')) then
            call close_csv(writer, written)
            call fail_on_error(written)
        end if
        call print_verdicts(numbers, family, verdicts)
    end subroutine run_fuzz

    !> The tables of all verdicts; ends the program with an error if one is bad.
    subroutine print_verdicts(numbers, family, verdicts)
        integer, intent(in) :: numbers(:), family(:)
        type(verdict_t), intent(in) :: verdicts(:)

        integer :: i, n_violations

        do i = 1, size(verdicts)
            if (verdicts(i)%violation /= '') &
                call say('case ' // integer_text(numbers(i)) // ' (' &
                         // trim(family_names(family(i))) // '): ' &
                         // trim(verdicts(i)%violation) // ' ' // trim(verdicts(i)%status%message))
        end do
        call print_table(family, verdicts)
        call print_times(numbers, verdicts)
        call print_worst('slowest, ms', numbers, verdicts, 1.0e-3_wp*verdicts%time_us)
        call print_worst('largest load errors', numbers, verdicts, abs(verdicts%load_error))
        call print_worst('largest overlaps outside, over the penetration', numbers, verdicts, &
                         verdicts%overlap)
        n_violations = count(verdicts%violation /= '')
        if (n_violations > 0) &
            call fail(exit_bad_input, integer_text(n_violations) // ' of ' &
                      // integer_text(size(verdicts)) // ' cases failed a check; one alone with ' &
                      // 'faststrip fuzz --case CASE')
    end subroutine print_verdicts

    !> Take the verdicts from the rows of an earlier run.
    subroutine read_verdicts(path, numbers, family, verdicts)
        character(len=*), intent(in) :: path
        integer, allocatable, intent(out) :: numbers(:), family(:)
        type(verdict_t), allocatable, intent(out) :: verdicts(:)

        integer, parameter :: largest_code = 200
        character(len=*), parameter :: names(8) = [character(len=10) :: 'case', 'family', &
            'status', 'violation', 'message', 'load_error', 'overlap', 'time_us']
        type(csv_table_t) :: table
        type(status_t) :: status
        integer :: i, row, code, column(size(names))
        real(wp) :: value

        call read_csv(path, table, status)
        call fail_on_error(status)
        do i = 1, size(names)
            call require_column(table, trim(names(i)), column(i), status)
            call fail_on_error(status)
        end do
        if (table%n_rows == 0) call fail(exit_bad_input, 'no rows (' // path // ')')
        allocate (numbers(table%n_rows), family(table%n_rows), source=0)
        allocate (verdicts(table%n_rows))
        do row = 1, table%n_rows
            call cell_number(table, row, column(1), value, status)
            call fail_on_error(status)
            numbers(row) = nint(value)
            do i = 1, size(family_names)
                if (trim(family_names(i)) == cell_text(table, row, column(2))) family(row) = i
            end do
            do code = 0, largest_code
                if (trim(status_word(code)) == cell_text(table, row, column(3))) exit
            end do
            if (family(row) == 0 .or. code > largest_code) &
                call fail(exit_bad_input, 'no row of a fuzz run: ' // integer_text(row) // ' (' &
                          // path // ')')
            associate (verdict => verdicts(row))
                verdict%status%code = code
                verdict%violation = cell_text(table, row, column(4))
                verdict%status%message = cell_text(table, row, column(5))
                call cell_number(table, row, column(6), verdict%load_error, status)
                if (.not. is_error(status)) &
                    call cell_number(table, row, column(7), verdict%overlap, status)
                if (.not. is_error(status)) &
                    call cell_number(table, row, column(8), verdict%time_us, status)
            end associate
            call fail_on_error(status)
        end do
    end subroutine read_verdicts

    !> Solve a case and judge the answer.
    subroutine try_case(fuzz_case, room, verdict)
        type(fuzz_case_t), intent(in) :: fuzz_case
        type(room_t), intent(inout) :: room ! grown as needed
        type(verdict_t), intent(inout) :: verdict

        integer(int64) :: before, after, rate
        integer :: max_strips

        max_strips = 3*fuzz_case%strips + 150
        call reserve_strips(room%strips, max_strips, verdict%status)
        call reserve_gap_curve(room%curve, size(fuzz_case%gap%y), verdict%status)
        if (room%solver == 'lattice') then
            call reserve_lattice(room%lattice, max_strips, verdict%status)
        else
            call reserve_strip_workspace(room%strip, max_strips, size(fuzz_case%gap%y), &
                                         verdict%status)
        end if
        call ieee_set_flag([ieee_invalid, ieee_divide_by_zero, ieee_overflow], .false.)
        call system_clock(before, rate)
        if (room%solver == 'lattice') then
            call solve_by_lattice(fuzz_case, room, verdict)
        else
            call set_strip_gap(room%strip, fuzz_case%gap, verdict%status)
            if (.not. is_error(verdict%status)) &
                call strip_solve(room%strip, normal_compliance(material_t()), fuzz_case%load, &
                                 strip_options_t(strips_per_patch=fuzz_case%strips), &
                                 room%strips, verdict%result, verdict%status)
        end if
        call system_clock(after)
        verdict%time_us = 1.0e6_wp*real(after - before, wp)/real(rate, wp)
        if (exception_raised()) verdict%violation = 'floating exception'
        if (is_error(verdict%status)) then
            if (verdict%status%message == '') verdict%violation = 'no message'
            if (verdict%status%code /= st_no_finite_patch) verdict%violation = 'no answer'
        else
            call judge(fuzz_case, room%curve, room%strips, verdict)
        end if
    end subroutine try_case

    subroutine solve_by_lattice(fuzz_case, room, verdict)
        type(fuzz_case_t), intent(in) :: fuzz_case
        type(room_t), intent(inout) :: room
        type(verdict_t), intent(inout) :: verdict

        call set_gap_curve(room%curve, fuzz_case%gap, verdict%status)
        if (is_error(verdict%status)) return
        call lattice_solve(room%lattice, room%curve, normal_compliance(material_t()), &
                           fuzz_case%load, fuzz_case%strips, room%strips, &
                           verdict%result%penetration, verdict%status)
        if (is_error(verdict%status)) return
        associate (n => room%strips%n, strips => room%strips)
            verdict%result%area = 2.0_wp*sum(strips%half_length(:n) &
                                             *(strips%y_right(:n) - strips%y_left(:n)))
            verdict%result%pmax = maxval(strips%p0(:n))
            verdict%result%x_max = maxval(strips%half_length(:n))
            verdict%result%y_min = strips%y_left(1)
            verdict%result%y_max = strips%y_right(n)
            verdict%result%n_patches = strips%n_patches
        end associate
    end subroutine solve_by_lattice

    logical function exception_raised()
        logical :: invalid, by_zero, overflow

        call ieee_get_flag(ieee_invalid, invalid)
        call ieee_get_flag(ieee_divide_by_zero, by_zero)
        call ieee_get_flag(ieee_overflow, overflow)
        exception_raised = invalid .or. by_zero .or. overflow
    end function exception_raised

    !> Check the strips of an answer.
    subroutine judge(fuzz_case, curve, strips, verdict)
        type(fuzz_case_t), intent(in) :: fuzz_case
        type(gap_curve_t), intent(inout) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(verdict_t), intent(inout) :: verdict

        type(status_t) :: status
        integer :: n, i

        n = strips%n
        verdict%strips = n
        if (n < 1) then
            verdict%violation = 'no strips'
            return
        end if
        associate (left => strips%y_left(:n), right => strips%y_right(:n), p0 => strips%p0(:n), &
                   half_length => strips%half_length(:n), result => verdict%result)
            do i = 1, n
                if (.not. (ieee_is_finite(left(i)) .and. ieee_is_finite(right(i)) &
                           .and. ieee_is_finite(p0(i)) .and. ieee_is_finite(half_length(i)))) &
                    verdict%violation = 'strip not finite'
            end do
            if (.not. (ieee_is_finite(result%penetration) .and. ieee_is_finite(result%area) &
                       .and. ieee_is_finite(result%pmax) .and. ieee_is_finite(result%y_min) &
                       .and. ieee_is_finite(result%y_max) .and. ieee_is_finite(result%x_max))) &
                verdict%violation = 'result not finite'
            if (verdict%violation /= '') return
            if (any(p0 <= 0.0_wp)) verdict%violation = 'pressure not positive'
            if (any(half_length <= 0.0_wp)) verdict%violation = 'length not positive'
            if (any(right <= left) .or. any(left(2:) < right(:n - 1))) &
                verdict%violation = 'edges out of order'
            if (left(1) < fuzz_case%gap%y(1) &
                .or. right(n) > fuzz_case%gap%y(size(fuzz_case%gap%y))) &
                verdict%violation = 'edges outside the data'
            if (result%area <= 0.0_wp .or. result%pmax <= 0.0_wp) &
                verdict%violation = 'area or pmax'
            if (verdict%violation /= '') return
        end associate
        verdict%load_error = strips_load(strips)/fuzz_case%load - 1.0_wp
        if (abs(verdict%load_error) > load_tolerance) verdict%violation = 'wrong load'
        call set_gap_curve(curve, fuzz_case%gap, status)
        call scan_for_overlap(curve, strips, verdict)
        ! Two limitations say so themselves.
        if (verdict%overlap > overlap_tolerance &
            .and. all(verdict%status%code /= [st_fallback_used, st_overlap_left])) &
            verdict%violation = 'overlap outside'
    end subroutine judge

    !> Largest overlap of the deformed surfaces on the line x = 0, more than half an end strip
    !> away from the patches: what is nearer belongs to where the ends are.
    subroutine scan_for_overlap(curve, strips, verdict)
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(verdict_t), intent(inout) :: verdict

        integer, parameter :: n_places = 2000
        real(wp) :: y, h, inv2r, displacement, depth, compliance
        integer :: i, s, next

        compliance = normal_compliance(material_t())
        associate (n => strips%n, result => verdict%result, left => strips%y_left, &
                   right => strips%y_right)
            next = 1
            do i = 0, n_places
                y = curve%y(1) + (curve%y(curve%n) - curve%y(1))*real(i, wp)/n_places
                call gap_at(curve, y, h, inv2r)
                if (h >= result%penetration) cycle
                do while (next <= n)
                    if (right(next) + 0.5_wp*(right(next) - left(next)) >= y) exit
                    next = next + 1
                end do
                if (next <= n) then
                    if (left(next) - 0.5_wp*(right(next) - left(next)) <= y) cycle
                end if
                displacement = 0.0_wp
                do s = 1, n
                    displacement = displacement + compliance*strips%p0(s)*strips%half_length(s) &
                                   *strip_influence_edges((left(s) - y)/strips%half_length(s), &
                                                          (right(s) - y)/strips%half_length(s))
                end do
                depth = (result%penetration - h - displacement) &
                        /(result%penetration - curve%h_lowest)
                if (depth <= verdict%overlap) cycle
                verdict%overlap = depth
                verdict%overlap_y = y
            end do
        end associate
    end subroutine scan_for_overlap

    !> Family by family, how the cases ended.
    subroutine print_table(family, verdicts)
        integer, intent(in) :: family(:)
        type(verdict_t), intent(in) :: verdicts(:)

        type(tally_t), allocatable :: tally(:)
        integer :: i, j, f

        allocate (tally(0))
        do i = 1, size(verdicts)
            do j = 1, size(tally)
                if (tally(j)%family == family(i) &
                    .and. tally(j)%code == verdicts(i)%status%code) exit
            end do
            if (j > size(tally)) tally = [tally, tally_t(family(i), verdicts(i)%status%code, 0)]
            tally(j)%n = tally(j)%n + 1
        end do
        call say('family        status                    cases    share   failed checks')
        call print_rows('all', tally, verdicts, [(.true., i=1, size(verdicts))])
        do f = 1, size(family_names)
            call print_rows(family_names(f), pack(tally, tally%family == f), verdicts, family == f)
        end do
    end subroutine print_table

    !> The lines of one family, or of all.
    subroutine print_rows(name, tally, verdicts, counts)
        character(len=*), intent(in) :: name
        type(tally_t), intent(in) :: tally(:)
        type(verdict_t), intent(in) :: verdicts(:)
        logical, intent(in) :: counts(:) ! which cases are of the family

        character(len=80) :: line
        character(len=12) :: family_name
        integer :: code, n

        family_name = name
        do code = 0, maxval(tally%code)
            n = sum(tally%n, tally%code == code)
            if (n == 0) cycle
            write (line, '(a, 2x, a, i9, f8.2, a, i9)') family_name, status_word(code), n, &
                100.0_wp*n/count(counts), ' %', &
                count(counts .and. verdicts%status%code == code .and. verdicts%violation /= '')
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

    subroutine put_fuzz_header(writer)
        type(csv_writer_t), intent(inout) :: writer

        call put_header(writer, [character(len=16) :: 'case', 'family', 'load_N', &
                                 'strips_asked', 'points', 'status', 'violation', 'message', &
                                 'strips', 'patches', 'penetration_mm', 'area_mm2', 'pmax_MPa', &
                                 'ymin_mm', 'ymax_mm', 'load_error', 'overlap', 'overlap_y_mm', &
                                 'passes', 'iterations', 'time_us'])
    end subroutine put_fuzz_header

    subroutine put_fuzz_row(writer, fuzz_case, verdict)
        type(csv_writer_t), intent(inout) :: writer
        type(fuzz_case_t), intent(in) :: fuzz_case
        type(verdict_t), intent(in) :: verdict

        call put_cell(writer, fuzz_case%number)
        call put_cell(writer, trim(family_names(fuzz_case%family)))
        call put_cell(writer, fuzz_case%load)
        call put_cell(writer, fuzz_case%strips)
        call put_cell(writer, size(fuzz_case%gap%y))
        call put_cell(writer, trim(status_word(verdict%status%code)))
        call put_cell(writer, trim(verdict%violation))
        call put_cell(writer, trim(verdict%status%message))
        call put_cell(writer, verdict%strips)
        call put_cell(writer, verdict%result%n_patches)
        call put_cell(writer, verdict%result%penetration)
        call put_cell(writer, verdict%result%area)
        call put_cell(writer, verdict%result%pmax)
        call put_cell(writer, verdict%result%y_min)
        call put_cell(writer, verdict%result%y_max)
        call put_cell(writer, verdict%load_error)
        call put_cell(writer, verdict%overlap)
        call put_cell(writer, verdict%overlap_y)
        call put_cell(writer, verdict%result%passes)
        call put_cell(writer, verdict%result%iterations)
        call put_cell(writer, verdict%time_us)
        call end_row(writer)
    end subroutine put_fuzz_row

    !> Write a case's gap so that a case file can name it.
    subroutine write_gap(path, seed, fuzz_case)
        character(len=*), intent(in) :: path
        integer, intent(in) :: seed
        type(fuzz_case_t), intent(in) :: fuzz_case

        type(csv_writer_t) :: writer
        type(status_t) :: status
        character(len=24) :: load
        integer :: i

        call open_csv(writer, path, status)
        call fail_on_error(status)
        write (load, '(es23.16)') fuzz_case%load
        call put_comment(writer, 'random gap ' // integer_text(fuzz_case%number) // ' of seed ' &
                         // integer_text(seed) // ': ' // trim(family_names(fuzz_case%family)) &
                         // ', load ' // trim(adjustl(load)) // ' N, ' &
                         // integer_text(fuzz_case%strips) // ' strips')
        call put_header(writer, [character(len=12) :: 'y_mm', 'h_mm', 'inv2R_per_mm'])
        do i = 1, size(fuzz_case%gap%y)
            call put_cell(writer, fuzz_case%gap%y(i))
            call put_cell(writer, fuzz_case%gap%h(i))
            call put_cell(writer, fuzz_case%gap%inv2r(i))
            call end_row(writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine write_gap
end module faststrip_app_fuzz
