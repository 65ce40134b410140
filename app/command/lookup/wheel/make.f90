!> `faststrip lookup wheel`: the table of a wheel on a rail, refined until it is as good as asked
!> for.
module faststrip_command_lookup_wheel_make
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: fail, fail_on_error, note, usage_error, &
                                                 version_text, exit_bad_input, exit_no_convergence
    use faststrip_command_program_files, only: take_beside
    use faststrip_command_lookup_direct, only: direct_choice_t, direct_t, direct_fastsim, &
                                               make_workers, release_workers
    use faststrip_command_lookup_file, only: read_table, write_table
    use faststrip_command_lookup_grid, only: sampled_axis_t, start_axis, refine_axis, nodes_of, &
                                             axis_q, axis_ratio
    use faststrip_command_lookup_options, only: direct_options, take_direct_options, &
                                                take_threads, take_ends, choice_text
    use faststrip_command_lookup_parts, only: take_work, work_name
    use faststrip_command_lookup_wheel_case, only: read_wheel_case, wheel_text
    use faststrip_command_lookup_wheel_fill, only: set_source_t, begin_wheel_table, solve_sets
    use faststrip_command_lookup_wheel_grid, only: wheel_axis_t, wheel_limits_t, &
                                                   start_wheel_axis, refine_wheel_axis, &
                                                   wheel_nodes
    use faststrip_command_lookup_wheel_judge, only: judge_table
    use faststrip_command_lookup_wheel_solver, only: wheel_solver_t, make_wheel_solvers, &
                                                     release_wheel_solvers
    use faststrip_command_lookup_scatter, only: least_drawn
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number, option_integer, &
                                                 option_word, option_part, refuse_value
    use faststrip_command_program_system, only: set_progress
    use faststrip_files_bytes, only: remove_file
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis
    use faststrip_lookup_faces, only: n_faces
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_wheel_errors
    use faststrip_lookup_wheel, only: n_wheel_place
    use faststrip_wheelset_types, only: wheelset_model_t
    implicit none
    private

    public :: run_lookup_wheel

    ! Tuned [1]: Parts of the error asked for that each axis may make to begin with: those of the
    ! creepages, those of the place. Origin: measured on S1002 on 60E1.
    real(wp), parameter :: share_of_faces = 0.6_wp, share_of_places = 0.8_wp
    ! Tuned [1]: The least part of the creepages. Origin: cost: where contacts jump no nodes help.
    real(wp), parameter :: least_share = 0.25_wp
    ! Tuned [1]: The same axis is refined further by at least this. Origin: chosen.
    real(wp), parameter :: least_step = 0.85_wp, most_step = 0.5_wp
    ! Tuned [rounds]: tables made. Origin: safeguard.
    integer, parameter :: most_rounds = 6
    ! Tuned [nodes]: the most of an axis of creepages, and of places. Origin: capacity.
    integer, parameter :: most_of_faces = 60, most_of_places = 400
    ! Tuned [nodes]: the most of a table. Origin: capacity: 1.2 GB.
    real(wp), parameter :: most_nodes = 1.0e8_wp
    ! Tuned [1]: a/b, logarithms, of the ellipses that the axes of creepages are refined on. Origin:
    ! usual contacts.
    real(wp), parameter :: usual_shapes(2) = [-1.0_wp, 1.5_wp]
    ! Tuned [rad, 1]: least cell of yaw, and of the load over its end. Origin: chosen.
    real(wp), parameter :: least_yaw = 1.0e-4_wp, least_load = 0.02_wp
    ! The promise is judged by these, the next round's by others.
    ! Given: a number.
    integer, parameter :: first_seed = 100

    !> What was asked for.
    type :: wanted_t
        type(wheel_limits_t) :: limits
        type(direct_choice_t) :: choice
        real(wp) :: error = 0.0_wp
        integer :: order = 1      ! 1 linear, 2 cubic
        integer :: tests = 0
        integer :: part = 1, parts = 1
        character(len=:), allocatable :: words !! how it is made
    end type wanted_t

contains

    !> Run the action from the command line.
    subroutine run_lookup_wheel()
        type(command_t) :: command
        type(wheelset_model_t) :: model
        type(wanted_t) :: wanted
        type(wheel_solver_t), allocatable :: solvers(:)
        type(lookup_t) :: lookup
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
            option_t('--error', 'E', '99th percentile, over mu N, mu N c and N (default 0.03)'), &
            option_t('--order', 'NAME', 'of which interpolation: linear (default) or cubic'), &
            option_t('--least-step', 'MM', 'the shortest cell along y (default 0.02)'), &
            option_t('--tests', 'N', 'fresh states to judge it by (default 2000)'), &
            option_t('--axes-of', 'TABLE', 'its nodes, instead of refining', reads=.true.), &
            option_t('--part', 'k/K', 'on given nodes: only every Kth contact, from the kth on'), &
            option_t('--resume', '', 'on given nodes: go on with what an ended run has left in' &
                     // new_line('a') // 'FILE.unfinished'), &
            direct_options]
        call parse_command(command, 1)
        if (option_text(command, '-o', '-') == '-') &
            call usage_error('-o TABLE.fslt is needed: the table is no text', command%name)
        if (given(command, '--axes-of') .and. len(work_name(option_text(command, '-o', ''))) > 0) &
            call take_beside(work_name(option_text(command, '-o', '')), '-o')
        call take_wanted(command, wanted)
        call read_wheel_case(command%arguments(1)%text, model)
        wanted%words = wheel_text(command%arguments(1)%text) // choice_text(wanted%choice)
        call make_wheel_solvers(model, wanted%choice, take_threads(command), solvers, status)
        call fail_on_error(status)
        if (given(command, '--axes-of')) then
            call make_on_axes(solvers, command, wanted, lookup)
        else
            call make_refined(solvers, wanted, lookup)
        end if
        call release_wheel_solvers(solvers)
        call write_table(option_text(command, '-o', ''), lookup)
        if (given(command, '--axes-of')) call remove_file(work_name(option_text(command, '-o', '')))
    end subroutine run_lookup_wheel

    ! The options.
    subroutine take_wanted(command, wanted)
        type(command_t), intent(in) :: command
        type(wanted_t), intent(out) :: wanted

        call take_direct_options(command, wanted%choice)
        if (wanted%choice%method == direct_fastsim) &
            call refuse_value(command, '--method', 'faststrip, tang or auto for a wheel')
        call take_ends(command, '--y', '-6:6', wanted%limits%ends(:, 1))
        call take_ends(command, '--yaw', '0:0', wanted%limits%ends(:, 2), may_be_one=.true.)
        call take_ends(command, '--load', '40000:120000', wanted%limits%ends(:, 3), above=0)
        wanted%limits%least = [option_number(command, '--least-step', 0.02_wp, above=0), &
                               least_yaw, least_load*wanted%limits%ends(2, 3)]
        wanted%limits%most_nodes = most_of_places
        wanted%error = option_number(command, '--error', 0.03_wp, above=0)
        wanted%tests = option_integer(command, '--tests', 2000, most=10000000, &
                                      least=merge(100, least_drawn, given(command, '--axes-of')))
        if (option_word(command, '--order', 'linear', [character(len=6) :: 'linear', 'cubic']) &
            == 'cubic') wanted%order = 2
        call option_part(command, wanted%part, wanted%parts)
        if (.not. given(command, '--axes-of')) then
            if (given(command, '--part') .or. given(command, '--resume')) &
                call usage_error('--part and --resume go with --axes-of', command%name)
        else if (given(command, '--y') .or. given(command, '--load') .or. &
                 given(command, '--yaw') .or. given(command, '--error')) then
            call usage_error('--axes-of must not be given with --y, --load, --yaw and --error', &
                             command%name)
        end if
    end subroutine take_wanted

    ! A table, or a part of it, on the nodes of another one.
    subroutine make_on_axes(solvers, command, wanted, lookup)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(command_t), intent(in) :: command
        type(wanted_t), intent(in) :: wanted
        type(lookup_t), intent(inout) :: lookup

        type(lookup_t) :: other
        type(set_source_t), allocatable :: sources(:)
        type(status_t) :: status
        character(len=:), allocatable :: work

        call read_table(option_text(command, '--axes-of', ''), other)
        if (other%kind /= lookup_kind_wheel) &
            call fail(exit_bad_input, 'must be a table of a wheel (' &
                      // option_text(command, '--axes-of', '') // ')')
        work = work_name(option_text(command, '-o', ''))
        call begin(solvers, [other%q, other%ratio, other%wheel%y, other%wheel%yaw, &
                             other%wheel%load], wanted, lookup, sources)
        call take_work(work, lookup, given(command, '--resume'), status)
        call fail_on_error(status)
        call solve_sets(solvers, sources, wanted%part, wanted%parts, work, lookup, status)
        call fail_on_error(status)
        if (wanted%parts == 1) call judge_table(solvers, wanted%tests, first_seed, lookup)
    end subroutine make_on_axes

    ! Refine the axes and make tables until one is good enough.
    subroutine make_refined(solvers, wanted, lookup)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(wanted_t), intent(in) :: wanted
        type(lookup_t), intent(inout) :: lookup

        type(wheel_axis_t) :: places(n_wheel_place)
        type(sampled_axis_t) :: faces(2)
        type(lookup_axis_t) :: axes(5)
        type(set_source_t), allocatable :: sources(:)
        type(direct_t), allocatable :: workers(:)
        type(status_t) :: status
        type(lookup_t) :: best
        real(wp) :: limits(2), found(2), best_found(2), step(2), bounds(n_wheel_errors, 2, 2)
        integer :: round, k, before(5)

        call make_workers(choice_of(wanted%choice, solvers(1)%nu), size(solvers), workers, status)
        call fail_on_error(status)
        call start_wheel_axis(solvers, 1, wanted%limits, places(1), status)
        call fail_on_error(status)
        call start_axis(workers, axis_q, usual_shapes, faces(1), status)
        call fail_on_error(status)
        call start_axis(workers, axis_ratio, usual_shapes, faces(2), status)
        call fail_on_error(status)
        limits = wanted%error*[share_of_faces, share_of_places]
        before = 0
        best_found = huge(1.0_wp)
        do round = 1, most_rounds
            do k = 1, size(faces)
                call set_progress('nodes of creepages, round ' // integer_text(round))
                call refine_axis(workers, limits(1), most_of_faces, faces(k), status)
                call fail_on_error(status)
                call make_axis(nodes_of(faces(k)), axes(k))
            end do
            do k = 1, n_wheel_place
                if (round == 1 .and. k > 1) then
                    call start_wheel_axis(solvers, k, wanted%limits, places(k), status, places(1))
                    call fail_on_error(status)
                end if
                call refine_wheel_axis(solvers, limits(2), places(k), status)
                call fail_on_error(status)
                call wheel_nodes(places(k), axes(2 + k))
            end do
            if (all(axes%n == before)) then
                ! The same table again: a limit that is below what its cells miss.
                limits = [max(most_step*limits(1), least_share*wanted%error), most_step*limits(2)]
                cycle
            end if
            call begin(solvers, axes, wanted, lookup, sources)
            call solve_sets(solvers, sources, 1, 1, '', lookup, status)
            call fail_on_error(status)
            call judge_table(solvers, wanted%tests, first_seed + round, lookup, bounds)
            found = maxval(bounds(:, wanted%order, :), dim=1)
            call note('round ' // integer_text(round) // ': ' // shape_text(lookup) // ', 99 % ' &
                      // trim(number_text(found(1))) // ', where contacts come or go ' &
                      // trim(number_text(found(2))))
            if (is_better(found, best_found, wanted%error)) then
                best = lookup
                best_found = found
            end if
            if (maxval(found) <= wanted%error) exit
            step = min(max(wanted%error/[found(1), maxval(found)], most_step), least_step)
            ! Where places are as near as they may be, creepages may be what is missing.
            if (all(axes(3:)%n == before(3:))) step(1) = step(2)
            if (found(1) > wanted%error .or. all(axes(3:)%n == before(3:))) &
                limits(1) = max(limits(1)*step(1), least_share*wanted%error)
            limits(2) = limits(2)*step(2)
            before = axes%n
        end do
        call release_workers(workers)
        lookup = best
        found = best_found
        if (found(1) > wanted%error) &
            call fail(exit_no_convergence, 'the error asked for was not met: ' &
                      // trim(number_text(wanted%error)) // ', got ' &
                      // trim(number_text(found(1))))
        if (found(2) > wanted%error) &
            call note('where contacts come or go the error asked for was not met: ' &
                      // trim(number_text(wanted%error)) // ', got ' &
                      // trim(number_text(found(2))) // '; cells of y are down to ' &
                      // trim(number_text(shortest(lookup%wheel%y))) // ' mm')
        ! A promise holds everywhere, or it is none.
        lookup%promised = max(wanted%error, found(2))
    end subroutine make_refined

    ! Are errors better than others? First all of them count, down to what was asked for.
    pure logical function is_better(found, than, error)
        real(wp), intent(in) :: found(2), than(2), error

        is_better = max(found(1), error) < max(than(1), error)
        if (.not. max(found(1), error) > max(than(1), error)) &
            is_better = is_better .or. found(2) < than(2)
    end function is_better

    ! The method with the wheel's Poisson's ratio.
    pure type(direct_choice_t) function choice_of(choice, nu)
        type(direct_choice_t), intent(in) :: choice
        real(wp), intent(in) :: nu

        choice_of = choice
        choice_of%nu = nu
    end function choice_of

    ! The length of the shortest cell of an axis.
    pure real(wp) function shortest(axis)
        type(lookup_axis_t), intent(in) :: axis

        shortest = minval(axis%x(2:) - axis%x(:axis%n - 1))
    end function shortest

    ! The nodes in a few words.
    function shape_text(lookup) result(text)
        type(lookup_t), intent(in) :: lookup
        character(len=:), allocatable :: text

        text = integer_text(lookup%q%n) // ' x ' // integer_text(lookup%ratio%n) // '^2, y ' &
               // integer_text(lookup%wheel%y%n) // ', yaw ' // integer_text(lookup%wheel%yaw%n) &
               // ', load ' // integer_text(lookup%wheel%load%n) // ', ' &
               // integer_text(lookup%wheel%sets) // ' contacts'
    end function shape_text

    ! A table of which the contacts are there.
    subroutine begin(solvers, axes, wanted, lookup, sources)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(lookup_axis_t), intent(in) :: axes(5)
        type(wanted_t), intent(in) :: wanted
        type(lookup_t), intent(out) :: lookup
        type(set_source_t), allocatable, intent(out) :: sources(:)

        type(status_t) :: status
        character(len=:), allocatable :: limited

        if (2.0_wp*n_faces*axes(1)%n*real(axes(2)%n, wp)**2*product(real(axes(3:)%n, wp)) &
            > most_nodes) &
            call fail(exit_no_convergence, 'a table as good as asked for has more than ' // &
                      trim(number_text(most_nodes)) // ' nodes')
        call begin_wheel_table(solvers, axes, lookup, sources, limited, status)
        call fail_on_error(status)
        lookup%text = version_text() // new_line('a') // wanted%words // new_line('a')
        if (len(limited) > 0) lookup%text = lookup%text // limited // new_line('a')
    end subroutine begin
end module faststrip_command_lookup_wheel_make
