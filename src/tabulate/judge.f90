!> Lookup tables against direct solutions of fresh states.
module faststrip_tabulate_judge
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_lookup_table, only: lookup_t
    use faststrip_tabulate_family, only: family_t, judged_t, note_failure
    use faststrip_tabulate_scatter, only: scatter_of, percentile_bound
    implicit none
    private

    public :: judge_table, judge_states

contains

    !> Find the errors of a table, on fresh states of each kind.
    subroutine judge_table(family, tests, seed, lookup, status, bounds)
        class(family_t), intent(inout) :: family !! with its solvers
        integer, intent(in) :: tests             !! fresh states of each kind
        integer, intent(in) :: seed              !! which ones
        type(lookup_t), intent(inout) :: lookup  !! filled; gets its errors
        type(status_t), intent(out) :: status    !! of the first state that fails
        real(wp), intent(out), optional :: bounds(family%n_errors, 2, family%n_kinds)
            !! `percentile_bound` of each error; linear, cubic; kinds of states

        type(judged_t), allocatable :: states(:)
        real(wp) :: errors(family%n_errors, 3, 2, family%n_kinds), found(family%n_errors, 2)
        integer :: tested(family%n_kinds), kind

        do kind = 1, family%n_kinds
            call family%draw(lookup, tests, seed, kind, states, status)
            if (.not. is_error(status)) &
                call judge_states(family, lookup, states, errors(:, :, :, kind), tested(kind), &
                                  status, found)
            if (is_error(status)) return
            if (present(bounds)) bounds(:, :, kind) = found
            if (tested(kind) < size(states)) &
                call family%note(integer_text(size(states) - tested(kind)) // ' of ' &
                                 // integer_text(size(states)) &
                                 // ' fresh states have no direct solution')
        end do
        call family%keep(errors, tested, lookup)
    end subroutine judge_table

    !> Compare a table with direct solutions of states.
    subroutine judge_states(family, lookup, states, errors, n_solved, status, bounds)
        class(family_t), intent(inout) :: family    !! with its solvers
        type(lookup_t), intent(in) :: lookup        !! filled
        type(judged_t), intent(inout) :: states(:)  !! drawn or given; judged
        real(wp), intent(out) :: errors(family%n_errors, 3, 2)
            !! of each; mean, 99th percentile, worst; linear, cubic
        integer, intent(out) :: n_solved            !! states with a direct solution
        type(status_t), intent(out) :: status       !! of the first state that fails
        real(wp), intent(out), optional :: bounds(family%n_errors, 2)
            !! `percentile_bound` of each error; linear, cubic

        type(status_t) :: said
        real(wp), allocatable :: off(:)
        integer :: i, k, order, me, failed

        call clear_status(status)
        errors = 0.0_wp
        if (present(bounds)) bounds = 0.0_wp
        n_solved = 0
        failed = size(states) + 1
        !$omp parallel do num_threads(family%threads) schedule(static, 1) default(none) &
        !$omp shared(family, lookup, states, status, failed) private(i, said)
        do me = 1, family%threads
            do i = me, size(states), family%threads
                if (me == 1) call family%progress('fresh states', i - 1, size(states))
                call family%judge(me, lookup, states(i), said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
        if (is_error(status)) return
        n_solved = count(states%is_solved)
        if (n_solved == 0) return
        do order = 1, 2
            do k = 1, family%n_errors
                off = pack(states%off(k, order), states%is_solved)
                errors(k, :, order) = scatter_of(off)
                if (present(bounds)) bounds(k, order) = percentile_bound(off)
            end do
        end do
    end subroutine judge_states
end module faststrip_tabulate_judge
