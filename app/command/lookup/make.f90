!> `faststrip lookup make`: a table of creep forces, refined until it is as good as asked for.
module faststrip_command_lookup_make
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, version_text, &
                                                 exit_bad_input, exit_no_convergence
    use faststrip_command_program_files, only: take_beside
    use faststrip_command_lookup_direct, only: direct_choice_t, direct_t, make_workers, &
                                               release_workers
    use faststrip_command_lookup_file, only: read_table, write_table
    use faststrip_command_lookup_fill, only: begin_table, judge_table
    use faststrip_command_lookup_grid, only: sampled_axis_t, start_axis, refine_axis, nodes_of
    use faststrip_command_lookup_options, only: direct_options, take_direct_options, &
                                                take_threads, choice_text
    use faststrip_command_lookup_parts, only: forget_values, solve_part, take_work, work_name
    use faststrip_command_lookup_scatter, only: least_drawn
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number, option_integer, &
                                                 option_word, option_pair, option_part, &
                                                 refuse_value
    use faststrip_command_program_system, only: set_progress
    use faststrip_files_bytes, only: remove_file
    use faststrip_lookup_faces, only: n_faces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: run_lookup_make

    ! Tuned [1]: Part of the error asked for that each axis may make to begin with. Origin: measured
    ! on FASTSTRIP's tables.
    real(wp), parameter :: first_share = 0.6_wp
    ! Tuned [1]: The same axis is refined further by at least this. Origin: chosen.
    real(wp), parameter :: least_step = 0.85_wp, most_step = 0.5_wp
    ! Tuned [rounds]: tables made. Origin: safeguard.
    integer, parameter :: most_rounds = 8
    ! Tuned [nodes]: the most of one axis, and of a table. Origin: capacity.
    integer, parameter :: most_axis = 250
    integer(int64), parameter :: most_nodes = 60000000
    ! Tuned [contacts]: fresh ones that a table is judged by. Origin: the 99th percentile of as many
    ! moves by less than a tenth of itself with the seed.
    integer, parameter :: usual_tests = 10000
    ! The promise is judged by these, the next round's by others.
    ! Given: a number.
    integer, parameter :: first_seed = 100

contains

    !> Run the action from the command line.
    subroutine run_lookup_make()
        type(command_t) :: command
        type(direct_choice_t) :: choice
        type(direct_t), allocatable :: workers(:)
        type(lookup_t) :: lookup
        type(status_t) :: status
        real(wp) :: ends(2), error
        integer :: order, tests, part, parts

        command%name = 'lookup make'
        command%n_words = 2
        command%usage = '-o TABLE.fslt'
        command%about = &
            'Make a table of creep forces on Hertz ellipses for Coulomb friction and like' &
            // new_line('a') // 'materials. Nodes are put where forces bend, until the 99th' &
            // ' percentile of the' // new_line('a') // 'interpolation''s error in Fx, Fy (over' &
            // ' mu N) and Mz (over mu N c, c = sqrt(ab))' // new_line('a') &
            // 'is at most --error: fresh contacts tell it at 95 %. Mean, percentile and worst' &
            // new_line('a') // 'go into the table: lookup info. On given nodes work can be' &
            // ' shared by' // new_line('a') // 'processes: --part, then lookup join.' &
            // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the table there', writes=.true.), &
            option_t('--error', 'E', '99th percentile, over mu N and mu N c (default 0.01)'), &
            option_t('--order', 'NAME', 'of which interpolation: linear (default) or cubic'), &
            option_t('--ab', 'LEAST:MOST', 'a/b, a along the rolling direction (default' &
                     // ' 0.1:10)'), &
            option_t('--nu', 'NUMBER', 'Poisson''s ratio of both bodies (default 0.28)'), &
            option_t('--tests', 'N', 'fresh contacts to judge it by (default 10000)'), &
            option_t('--axes-of', 'TABLE', 'its nodes and nu, instead of refining: by a costly' &
                     // new_line('a') // 'method on the nodes of a cheap one', reads=.true.), &
            option_t('--part', 'k/K', 'on given nodes: only every Kth a/b, from the kth on'), &
            option_t('--resume', '', 'on given nodes: go on with what an ended run has left in' &
                     // new_line('a') // 'FILE.unfinished'), &
            direct_options]
        call parse_command(command, 0)
        if (option_text(command, '-o', '-') == '-') &
            call usage_error('-o TABLE.fslt is needed: the table is no text', command%name)
        if (given(command, '--axes-of') .and. len(work_name(option_text(command, '-o', ''))) > 0) &
            call take_beside(work_name(option_text(command, '-o', '')), '-o')
        call take_direct_options(command, choice)
        choice%nu = option_number(command, '--nu', choice%nu, least=0)
        if (choice%nu >= 0.5_wp) &
            call refuse_value(command, '--nu', 'a number of at least 0 and below 0.5')
        error = option_number(command, '--error', 0.01_wp, above=0)
        tests = option_integer(command, '--tests', usual_tests, most=10000000, &
                               least=merge(100, least_drawn, given(command, '--axes-of')))
        order = 1
        if (option_word(command, '--order', 'linear', [character(len=6) :: 'linear', 'cubic']) &
            == 'cubic') order = 2
        call take_range(command, ends)
        call option_part(command, part, parts)
        if (given(command, '--axes-of')) then
            if (given(command, '--ab') .or. given(command, '--error') .or. given(command, '--nu')) &
                call usage_error('--axes-of must not be given with --ab, --error and --nu', &
                                 command%name)
            call read_table(option_text(command, '--axes-of', ''), lookup)
            if (lookup%kind /= lookup_kind_hertz) &
                call fail(exit_bad_input, 'must be a table of ellipses (' &
                          // option_text(command, '--axes-of', '') // ')')
            choice%nu = lookup%nu
        else if (given(command, '--part') .or. given(command, '--resume')) then
            call usage_error('--part and --resume go with --axes-of', command%name)
        end if
        call make_workers(choice, take_threads(command), workers, status)
        call fail_on_error(status)
        if (given(command, '--axes-of')) then
            call make_on_axes(workers, command, part, parts, lookup)
            if (parts == 1) call judge(workers, tests, first_seed, lookup)
        else
            call make_refined(workers, ends, error, order, tests, lookup)
        end if
        call release_workers(workers)
        call write_table(option_text(command, '-o', ''), lookup)
        if (given(command, '--axes-of')) call remove_file(work_name(option_text(command, '-o', '')))
    end subroutine run_lookup_make

    !> A table, or a part of it, on the nodes of another one.
    subroutine make_on_axes(workers, command, part, parts, lookup)
        type(direct_t), intent(inout) :: workers(:)
        type(command_t), intent(in) :: command
        integer, intent(in) :: part, parts
        type(lookup_t), intent(inout) :: lookup ! its axes count

        type(lookup_t) :: begun
        type(status_t) :: status
        character(len=:), allocatable :: work

        work = work_name(option_text(command, '-o', ''))
        call begin(workers(1), lookup%q%x, lookup%ratio%x, lookup%shape%x, begun)
        call take_work(work, begun, given(command, '--resume'), status)
        call fail_on_error(status)
        call solve_part(workers, part, parts, work, begun, status)
        call fail_on_error(status)
        lookup = begun
    end subroutine make_on_axes

    !> Refine the axes and make tables until one is good enough.
    subroutine make_refined(workers, ends, error, order, tests, lookup)
        type(direct_t), intent(inout) :: workers(:)
        real(wp), intent(in) :: ends(2), error
        integer, intent(in) :: order, tests
        type(lookup_t), intent(inout) :: lookup

        type(lookup_t) :: begun
        type(sampled_axis_t) :: axes(3)
        type(status_t) :: status
        real(wp) :: limit, found, bounds(3, 2)
        integer :: round, k

        limit = first_share*error
        do k = 1, size(axes)
            call set_progress('nodes of axis ' // integer_text(k))
            call start_axis(workers, k, ends, axes(k), status)
            call fail_on_error(status)
        end do
        do round = 1, most_rounds
            do k = 1, size(axes)
                call set_progress('nodes of axis ' // integer_text(k) // ', round ' &
                                  // integer_text(round))
                call refine_axis(workers, limit, most_axis, axes(k), status)
                call fail_on_error(status)
            end do
            call begin(workers(1), nodes_of(axes(1)), nodes_of(axes(2)), nodes_of(axes(3)), begun)
            call solve_part(workers, 1, 1, '', begun, status)
            call fail_on_error(status)
            lookup = begun
            call judge(workers, tests, first_seed + round, lookup, bounds)
            found = maxval(bounds(:, order))
            if (found <= error) exit
            limit = limit*min(max(error/found, most_step), least_step)
        end do
        if (found > error) &
            call fail(exit_no_convergence, 'the error asked for was not met: ' &
                      // trim(number_text(error)) // ', got ' // trim(number_text(found)) &
                      // '; the method''s own kinks may leave more')
        lookup%promised = error
    end subroutine make_refined

    !> A table of which no node is solved.
    subroutine begin(worker, q, ratio, shapes, lookup)
        type(direct_t), intent(in) :: worker
        real(wp), intent(in) :: q(:), ratio(:), shapes(:)
        type(lookup_t), intent(out) :: lookup

        type(status_t) :: status

        if (n_faces*size(q)*int(size(ratio), int64)**2*size(shapes) > most_nodes) &
            call fail(exit_no_convergence, 'a table as good as asked for has more than ' // &
                      trim(number_text(real(most_nodes, wp))) // ' nodes')
        call begin_table(q, ratio, shapes, worker%choice%nu, lookup, status)
        call fail_on_error(status)
        call forget_values(lookup)
        lookup%text = version_text() // new_line('a') // choice_text(worker%choice) &
                      // new_line('a')
    end subroutine begin

    !> Find the errors of a table.
    subroutine judge(workers, tests, seed, lookup, bounds)
        type(direct_t), intent(inout) :: workers(:)
        integer, intent(in) :: tests, seed
        type(lookup_t), intent(inout) :: lookup
        real(wp), intent(out), optional :: bounds(3, 2)

        type(status_t) :: status

        call set_progress('fresh contacts')
        call judge_table(workers, lookup, tests, seed, lookup%errors, status, bounds)
        call fail_on_error(status)
        lookup%tested = tests
    end subroutine judge

    !> The range of a/b, as logarithms.
    subroutine take_range(command, ends)
        type(command_t), intent(in) :: command
        real(wp), intent(out) :: ends(2)

        ! Tuned [1]: the most slender ellipses. Origin: capacity.
        real(wp), parameter :: most_slender = 1.0e3_wp

        call option_pair(command, '--ab', '0.1:10', 'LEAST:MOST', ends)
        if (ends(1) < 1.0_wp/most_slender .or. ends(2) > most_slender .or. &
            ends(2) < 1.01_wp*ends(1)) &
            call refuse_value(command, '--ab', 'two rising numbers from 0.001 to 1000')
        ends = log(ends)
    end subroutine take_range
end module faststrip_command_lookup_make
