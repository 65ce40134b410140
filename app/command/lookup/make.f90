!> `faststrip lookup make` and `faststrip lookup wheel`: a table of creep forces on ellipses, or of
!> a wheel on a rail, refined until it is as good as asked for, or on the nodes of another table.
module faststrip_command_lookup_make
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_base_status, only: status_t
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, version_text, &
                                                 note, progress, exit_bad_input
    use faststrip_command_program_files, only: take_beside
    use faststrip_command_lookup_case, only: read_wheel_case, wheel_text
    use faststrip_command_lookup_file, only: read_table, write_table, work_name, take_work
    use faststrip_command_lookup_options, only: method_options, take_choice, take_threads, &
                                                take_ends, choice_text, usual_tests, &
                                                usual_wheel_tests
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number, option_integer, &
                                                 option_word, option_pair, option_part, &
                                                 refuse_value
    use faststrip_files_bytes, only: remove_file
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz, lookup_kind_wheel
    use faststrip_tabulate_family, only: family_t
    use faststrip_tabulate_forces, only: choice_t, by_fastsim
    use faststrip_tabulate_hertz, only: hertz_family_t, make_hertz_family, release_hertz_family
    use faststrip_tabulate_judge, only: judge_table
    use faststrip_tabulate_make, only: begin_table, solve_units, make_refined, first_seed
    use faststrip_tabulate_scatter, only: least_drawn
    use faststrip_tabulate_states, only: most_slender
    use faststrip_tabulate_wheel, only: wheel_family_t, wheel_limits_t, make_wheel_family, &
                                        release_wheel_family
    use faststrip_wheelset_types, only: wheelset_model_t
    implicit none
    private

    public :: run_lookup_make, run_lookup_wheel

    ! Tuned [1]: 99th percentile of the errors where none is asked for, of ellipses and of wheels.
    ! Origin: chosen.
    real(wp), parameter :: usual_error = 0.01_wp, usual_wheel_error = 0.03_wp
    ! Tuned [1]: the largest that may be asked for. Origin: chosen: FASTSIM on Hertz' ellipse is
    ! nearer on the average; who says 0.5 or 1 means per cent.
    real(wp), parameter :: most_error = 0.2_wp
    ! Tuned [mm]: the shortest cell along y where none is asked for. Origin: chosen.
    real(wp), parameter :: usual_step = 0.02_wp
    ! Tuned [rad, 1]: least cell of yaw, and of the load over its end. Origin: chosen.
    real(wp), parameter :: least_yaw = 1.0e-4_wp, least_load = 0.02_wp

    !> Options of both actions.
    type(option_t), parameter :: part_options(2) = [ &
        option_t('--part', 'k/K', 'on given nodes: only every Kth a/b, or contact, from the kth' &
                 // ' on'), &
        option_t('--resume', '', 'on given nodes: go on with what an ended run has left in' &
                 // new_line('a') // 'FILE.unfinished')]

contains

    !> Run `lookup make` from the command line.
    subroutine run_lookup_make()
        type(command_t) :: command
        type(choice_t) :: choice
        type(hertz_family_t), target :: family
        type(lookup_t) :: other
        type(status_t) :: status
        real(wp) :: ends(2)

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
            option_t('--error', 'E', '99th percentile, a fraction of mu N and mu N c: 0.005 is' &
                     // new_line('a') // 'half a per cent (default 0.01)'), &
            option_t('--ab', 'LEAST:MOST', 'a/b, a along the rolling direction (default' &
                     // ' 0.1:10)'), &
            option_t('--order', 'NAME', 'of which interpolation: linear (default) or cubic'), &
            option_t('--nu', 'NUMBER', 'Poisson''s ratio of both bodies (default 0.28)'), &
            option_t('--tests', 'N', 'random contacts to check it on (default 10000)'), &
            option_t('--axes-of', 'TABLE', 'its nodes and nu, instead of refining: by a costly' &
                     // new_line('a') // 'method on the nodes of a cheap one', reads=.true.), &
            part_options, method_options]
        call parse_command(command, 0)
        call check_output(command)
        call take_choice(command, choice)
        choice%nu = option_number(command, '--nu', choice%nu, least=0)
        if (choice%nu >= 0.5_wp) &
            call refuse_value(command, '--nu', 'a number of at least 0 and below 0.5')
        call take_range(command, ends)
        call check_nodes(command, [character(len=7) :: '--ab', '--error', '--nu'])
        call read_nodes(command, lookup_kind_hertz, 'a table of ellipses', other)
        if (given(command, '--axes-of')) choice%nu = other%nu
        call make_hertz_family(choice, take_threads(command), ends, family, status)
        call fail_on_error(status)
        call make_table(command, family, choice_text(choice), usual_error, usual_tests, &
                        'linear', other)
        call release_hertz_family(family)
    end subroutine run_lookup_make

    !> Run `lookup wheel` from the command line.
    subroutine run_lookup_wheel()
        type(command_t) :: command
        type(choice_t) :: choice
        type(wheel_family_t), target :: family
        type(wheelset_model_t) :: model
        type(wheel_limits_t) :: limits
        type(lookup_t) :: other
        type(status_t) :: status

        command%name = 'lookup wheel'
        command%n_words = 2
        command%usage = 'CASE.nml -o TABLE.fslt'
        command%about = &
            'Make a table of the contacts of a wheel on a rail and of their creep forces: over y' &
            // ' of' // new_line('a') // 'the wheelset, yaw, and the vertical part of the normal' &
            // ' forces; three creepages of' // new_line('a') // 'each contact. Of the case the' &
            // ' groups &wheel, &rail, &material, &numerics; its right' // new_line('a') &
            // 'wheel; roll 0. Nodes are put where contacts and forces bend, until the 99th' &
            // new_line('a') // 'percentile of the errors on fresh states is at most --error (at' &
            // ' 95 %), and that on' // new_line('a') // 'states where a contact comes or goes,' &
            // ' too: or cells there are no longer than' // new_line('a') // '--least-step.' &
            // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the table there', writes=.true.), &
            option_t('--y', 'FIRST:LAST', 'lateral displacements of the wheelset, mm (default' &
                     // ' -6:6)'), &
            option_t('--load', 'FIRST:LAST', 'vertical part of the normal forces, N (default' &
                     // new_line('a') // '40000:120000)'), &
            option_t('--yaw', 'FIRST:LAST', 'rad (default 0:0, no axis)'), &
            option_t('--error', 'E', '99th percentile, a fraction of mu N, mu N c, N, and of the' &
                     // new_line('a') // 'load for z: 0.005 is half a per cent (default 0.03)'), &
            option_t('--order', 'NAME', 'of which interpolation: cubic (default) or linear'), &
            option_t('--least-step', 'MM', 'the shortest cell along y (default 0.02)'), &
            option_t('--tests', 'N', 'random states to check it on (default 2000)'), &
            option_t('--axes-of', 'TABLE', 'its nodes, instead of refining', reads=.true.), &
            part_options, method_options]
        call parse_command(command, 1)
        call check_output(command)
        call take_choice(command, choice)
        if (choice%method == by_fastsim) &
            call refuse_value(command, '--method', 'faststrip, tang or auto for a wheel')
        call take_ends(command, '--y', '-6:6', limits%ends(:, 1))
        call take_ends(command, '--yaw', '0:0', limits%ends(:, 2), may_be_one=.true.)
        call take_ends(command, '--load', '40000:120000', limits%ends(:, 3), above=0)
        limits%least = [option_number(command, '--least-step', usual_step, above=0), &
                        least_yaw, least_load*limits%ends(2, 3)]
        call check_nodes(command, [character(len=7) :: '--y', '--load', '--yaw', '--error'])
        call read_wheel_case(command%arguments(1)%text, model)
        call read_nodes(command, lookup_kind_wheel, 'a table of a wheel', other)
        call make_wheel_family(model, choice, take_threads(command), limits, family, status)
        call fail_on_error(status)
        call make_table(command, family, wheel_text(command%arguments(1)%text) &
                        // choice_text(choice), usual_wheel_error, usual_wheel_tests, &
                        'cubic', other)
        call release_wheel_family(family)
    end subroutine run_lookup_wheel

    ! A table is no text, and work on it is kept beside it.
    subroutine check_output(command)
        type(command_t), intent(in) :: command

        if (option_text(command, '-o', '-') == '-') &
            call usage_error('-o TABLE.fslt is needed: the table is no text', command%name)
        if (given(command, '--axes-of') .and. len(work_name(option_text(command, '-o', ''))) > 0) &
            call take_beside(work_name(option_text(command, '-o', '')), '-o')
    end subroutine check_output

    ! Options that do not go with the nodes of another table, or only with them.
    subroutine check_nodes(command, others)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: others(:)

        character(len=:), allocatable :: list
        integer :: i

        if (.not. given(command, '--axes-of')) then
            if (given(command, '--part') .or. given(command, '--resume')) &
                call usage_error('--part and --resume go with --axes-of', command%name)
            return
        end if
        list = trim(others(1))
        do i = 2, size(others)
            if (i < size(others)) list = list // ', ' // trim(others(i))
            if (i == size(others)) list = list // ' and ' // trim(others(i))
        end do
        do i = 1, size(others)
            if (given(command, trim(others(i)))) &
                call usage_error('--axes-of must not be given with ' // list, command%name)
        end do
    end subroutine check_nodes

    ! The table whose nodes are taken, if there is one.
    subroutine read_nodes(command, kind, what, other)
        type(command_t), intent(in) :: command
        integer, intent(in) :: kind
        character(len=*), intent(in) :: what
        type(lookup_t), intent(out) :: other

        if (.not. given(command, '--axes-of')) return
        call read_table(option_text(command, '--axes-of', ''), other)
        if (other%kind /= kind) &
            call fail(exit_bad_input, 'must be ' // what // ' (' &
                      // option_text(command, '--axes-of', '') // ')')
    end subroutine read_nodes

    ! Make the table and write it.
    subroutine make_table(command, family, words, default_error, usual, usual_order, other)
        type(command_t), intent(in) :: command
        class(family_t), intent(inout) :: family
        character(len=*), intent(in) :: words     ! how it is made
        real(wp), intent(in) :: default_error
        integer, intent(in) :: usual              ! fresh states
        character(len=*), intent(in) :: usual_order ! of interpolation
        type(lookup_t), intent(in) :: other       ! whose nodes are taken; or none

        type(lookup_t) :: lookup
        type(lookup_axis_t) :: axes(5)
        type(status_t) :: status
        character(len=:), allocatable :: work
        real(wp) :: error
        integer :: order, tests, part, parts

        family%words = version_text() // new_line('a') // words // new_line('a')
        family%progress => progress
        family%note => note
        error = option_number(command, '--error', default_error)
        if (.not. (error > 0.0_wp .and. error <= most_error)) &
            call refuse_value(command, '--error', 'a fraction of mu N above 0 to 0.2, 0.005 for ' &
                              // 'half a per cent')
        tests = option_integer(command, '--tests', usual, most=10000000, &
                               least=merge(100, least_drawn, given(command, '--axes-of')))
        order = 1
        if (option_word(command, '--order', usual_order, [character(len=6) :: 'linear', 'cubic']) &
            == 'cubic') order = 2
        call option_part(command, part, parts)
        work = work_name(option_text(command, '-o', ''))
        if (given(command, '--axes-of')) then
            axes(1) = other%q
            axes(2) = other%ratio
            if (other%kind == lookup_kind_hertz) then
                axes(3) = other%shape
            else
                axes(3) = other%wheel%y
                axes(4) = other%wheel%yaw
                axes(5) = other%wheel%load
            end if
            call begin_table(family, axes(:family%n_axes), lookup, status)
            call fail_on_error(status)
            call take_work(work, lookup, given(command, '--resume'), status)
            call fail_on_error(status)
            call solve_units(family, part, parts, work, lookup, status)
            call fail_on_error(status)
            if (parts == 1) call judge_table(family, tests, first_seed, lookup, status)
        else
            call make_refined(family, error, order, tests, lookup, status)
        end if
        call fail_on_error(status)
        call write_table(option_text(command, '-o', ''), lookup)
        if (given(command, '--axes-of')) call remove_file(work)
    end subroutine make_table

    !> The range of a/b, as logarithms.
    subroutine take_range(command, ends)
        type(command_t), intent(in) :: command
        real(wp), intent(out) :: ends(2)

        call option_pair(command, '--ab', '0.1:10', 'LEAST:MOST', ends)
        if (ends(1) < 1.0_wp/most_slender .or. ends(2) > most_slender .or. &
            ends(2) < (1.0_wp + rounding)*ends(1)) &
            call refuse_value(command, '--ab', 'two rising numbers from 0.001 to 1000')
        ends = log(ends)
    end subroutine take_range
end module faststrip_command_lookup_make
