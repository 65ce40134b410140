!> Lookup tables of any family: refined until one is as good as asked for, or on given nodes, whole
!> or in parts.
module faststrip_tabulate_make
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, set_status, number_text, &
                                     st_no_convergence, clear_status
    use faststrip_base_text, only: integer_text
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_faces, only: lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t
    use faststrip_tabulate_axis, only: start_axis, refine_axis, nodes_of
    use faststrip_tabulate_family, only: family_t, sampled_axis_t, note_failure, states_all, &
                                         states_changing
    use faststrip_tabulate_judge, only: judge_table
    use faststrip_tabulate_parts, only: is_solved, units_of, write_work
    implicit none
    private

    public :: begin_table, solve_units, make_refined

    !> The claim is judged by the states of this seed, the next round's by others.
    !> Given: a number.
    integer, parameter, public :: first_seed = 100

    ! Tuned [1]: The same axis is refined further by at least this. Origin: chosen.
    real(wp), parameter :: least_step = 0.85_wp, most_step = 0.5_wp
    ! Tuned [rounds]: tables made. Origin: safeguard.
    integer, parameter :: most_rounds = 8
    ! Tuned [nodes]: the most of a table. Origin: capacity: 1.2 GB.
    real(wp), parameter :: most_nodes = 1.0e8_wp
    ! Tuned [1]: how often work is kept. Origin: chosen: files are written in less time than solved.
    integer, parameter :: kept_times = 20

contains

    !> A table of which no creep force is solved.
    subroutine begin_table(family, axes, lookup, status)
        class(family_t), intent(inout) :: family   !! with its solvers
        type(lookup_axis_t), intent(in) :: axes(:) !! all of the family
        type(lookup_t), intent(out) :: lookup      !! to be filled
        type(status_t), intent(out) :: status      !! `st_no_convergence`: too many nodes; of places

        if (family%nodes(axes) > most_nodes) then
            call set_status(status, st_no_convergence, 'a table as good as asked for has more ' &
                            // 'than ' // trim(number_text(most_nodes)) // ' nodes')
            return
        end if
        call family%begin(axes, lookup, status)
    end subroutine begin_table

    !> Solve what is missing of a part: every so manyth unit.
    subroutine solve_units(family, part, parts, path, lookup, status)
        class(family_t), intent(inout) :: family !! with its solvers
        integer, intent(in) :: part, parts       !! which one of how many
        character(len=*), intent(in) :: path     !! file of the work; empty: none is kept
        type(lookup_t), intent(inout) :: lookup  !! begun
        type(status_t), intent(out) :: status    !! of the method; of the file

        integer, allocatable :: units(:)
        integer :: first, last, chunk, i

        call clear_status(status)
        units = [(i, i=part, units_of(lookup), parts)]
        units = pack(units, [(.not. is_solved(lookup, units(i)), i=1, size(units))])
        ! As many as keep all threads at work.
        chunk = max(size(units)/kept_times, 1 + (2*family%threads - 1)/family%jobs(lookup))
        do first = 1, size(units), chunk
            call family%progress('parts of the table', first - 1, size(units))
            last = min(first + chunk - 1, size(units))
            call solve_some(family, units(first:last), lookup, status)
            if (.not. is_error(status)) call write_work(path, lookup, status)
            if (is_error(status)) return
        end do
    end subroutine solve_units

    ! Units, whose jobs are shared by threads.
    subroutine solve_some(family, units, lookup, status)
        class(family_t), intent(inout) :: family
        integer, intent(in) :: units(:)
        type(lookup_t), intent(inout) :: lookup
        type(status_t), intent(out) :: status

        type(status_t) :: said
        integer :: i, me, failed, jobs

        call clear_status(status)
        jobs = family%jobs(lookup)
        failed = jobs*size(units) + 1
        !$omp parallel do num_threads(family%threads) schedule(static, 1) default(none) &
        !$omp shared(family, units, lookup, status, failed, jobs) private(i, said)
        do me = 1, family%threads
            do i = me, jobs*size(units), family%threads
                call family%solve(me, units(1 + (i - 1)/jobs), 1 + modulo(i - 1, jobs), lookup, &
                                  said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine solve_some

    !> Refine axes and make tables until one is good enough; the best of them is the answer. Where
    !> contacts come or go a table may be worse than was asked for: its claim says so.
    subroutine make_refined(family, error, order, tests, lookup, status)
        class(family_t), intent(inout) :: family !! with its solvers
        real(wp), intent(in) :: error            !! that is asked for
        integer, intent(in) :: order             !! of which interpolation: 1 linear, 2 cubic
        integer, intent(in) :: tests             !! fresh states of each kind
        type(lookup_t), intent(out) :: lookup    !! filled and judged
        type(status_t), intent(out) :: status
            !! of the method; `st_no_convergence`: not as good as asked for

        type(sampled_axis_t) :: axes(family%n_axes)
        type(lookup_axis_t) :: nodes(family%n_axes)
        type(lookup_t) :: begun
        real(wp) :: limits(2), found(2), best(2), step(2)
        real(wp) :: bounds(family%n_errors, 2, family%n_kinds)
        integer :: round, k, before(family%n_axes)
        character(len=:), allocatable :: shape
        logical :: are_same_places

        limits = error*family%shares
        family%order = merge(lookup_linear, lookup_cubic, order == 1)
        before = 0
        best = huge(1.0_wp)
        do round = 1, most_rounds
            do k = 1, family%n_axes
                if (round == 1) call start_axis(family, k, axes, status)
                if (is_error(status)) return
                call family%progress('axes', k - 1, family%n_axes)
                call refine_axis(family, limits(merge(1, 2, k <= family%n_face_axes)), axes(k), &
                                 status)
                if (is_error(status)) return
                call nodes_of(axes(k), nodes(k))
            end do
            if (all(nodes%n == before) .and. family%n_axes > family%n_face_axes) then
                ! The same table again: a limit that is below what its cells miss. One of creepages
                ! alone is soon solved and judged again, by other states.
                limits = [max(most_step*limits(1), family%least_share*error), most_step*limits(2)]
                cycle
            end if
            call begin_table(family, nodes, begun, status)
            if (.not. is_error(status)) call solve_units(family, 1, 1, '', begun, status)
            if (.not. is_error(status)) &
                call judge_table(family, tests, first_seed + round, begun, status, bounds)
            if (is_error(status)) return
            found = 0.0_wp
            found(:family%n_kinds) = maxval(bounds(:, order, :), dim=1)
            if (family%n_kinds > 1) then
                call family%describe(begun, shape)
                call family%note('round ' // integer_text(round) // ': ' // shape &
                                 // ', 99 % ' // trim(number_text(found(states_all))) &
                                 // ', where contacts come or go ' &
                                 // trim(number_text(found(states_changing))))
            end if
            if (is_better(found, best, error)) then
                lookup = begun
                best = found
            end if
            if (maxval(found) <= error) exit
            step = min(max(error/[found(states_all), maxval(found)], most_step), least_step)
            ! Where places are as near as they may be, creepages may be what is missing.
            are_same_places = all(nodes(family%n_face_axes + 1:)%n &
                                  == before(family%n_face_axes + 1:))
            if (are_same_places) step(1) = step(2)
            if (found(states_all) > error .or. are_same_places) &
                limits(1) = max(limits(1)*step(1), family%least_share*error)
            limits(2) = limits(2)*step(2)
            before = nodes%n
        end do
        if (best(states_all) > error) &
            call set_status(status, st_no_convergence, 'the error asked for was not met: ' &
                            // trim(number_text(error)) // ', got ' &
                            // trim(number_text(best(states_all))) &
                            // '; the method''s own kinks may leave more')
        if (best(states_changing) > error .and. .not. is_error(status)) &
            call family%note('where contacts come or go the error asked for was not met: ' &
                             // trim(number_text(error)) // ', got ' &
                             // trim(number_text(best(states_changing))) // '; cells of y are ' &
                             // 'down to ' // trim(number_text(shortest(lookup%wheel%y))) // ' mm')
        ! A claim holds everywhere, or it is none.
        lookup%promised = max(error, best(states_changing))
    end subroutine make_refined

    ! Are errors better than others? First all of them count, down to what was asked for.
    pure logical function is_better(found, than, error)
        real(wp), intent(in) :: found(2), than(2), error

        is_better = max(found(1), error) < max(than(1), error)
        if (.not. max(found(1), error) > max(than(1), error)) &
            is_better = is_better .or. found(2) < than(2)
    end function is_better

    ! The length of the shortest cell of an axis.
    pure real(wp) function shortest(axis)
        type(lookup_axis_t), intent(in) :: axis

        shortest = minval(axis%x(2:) - axis%x(:axis%n - 1))
    end function shortest
end module faststrip_tabulate_make
