!> Axes of a lookup table, with nodes where contacts and forces bend.
!>
!> Each cell of an axis is halved while linear interpolation along that axis alone is wrong by more
!> than a limit in its middle, as the family has it of scattered places of the other coordinates;
!> and while it is longer than the least cell.
module faststrip_tabulate_axis
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: rounding
    use faststrip_base_status, only: status_t, is_error, clear_status
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis, make_point
    use faststrip_tabulate_family, only: family_t, sampled_axis_t, note_failure
    implicit none
    private

    public :: start_axis, refine_axis, nodes_of

contains

    !> Solve along a coarse axis.
    subroutine start_axis(family, kind, axes, status)
        class(family_t), intent(inout) :: family        !! with its solvers
        integer, intent(in) :: kind                     !! number of the axis
        type(sampled_axis_t), intent(inout) :: axes(:)  !! of the family; this one is started
        type(status_t), intent(out) :: status           !! of the first place that fails

        type(sampled_axis_t) :: axis
        integer :: i

        axis%kind = kind
        call family%start(axis, axes)
        allocate (axis%f(axis%values, axis%samples, size(axis%x)), source=0.0_wp)
        call clear_status(status)
        if (size(axis%x) > 1) &
            call solve_places(family, axis, [(i, i=1, size(axis%x))], status)
        axes(kind) = axis
    end subroutine start_axis

    !> Halve cells until none is wrong by more than a limit, or longer than the least.
    subroutine refine_axis(family, limit, axis, status)
        class(family_t), intent(inout) :: family    !! with its solvers
        real(wp), intent(in) :: limit               !! of the error along the axis alone
        type(sampled_axis_t), intent(inout) :: axis !! started
        type(status_t), intent(out) :: status       !! of the first place that fails

        type(sampled_axis_t) :: finer
        integer, allocatable :: from(:) ! place of the coarser axis, 0: a new one
        integer :: i, n

        call clear_status(status)
        if (size(axis%x) == 1) return
        do
            from = [1]
            do i = 2, size(axis%x), 2
                if (family%cell_error(axis, i) > limit .and. &
                    axis%x(i + 1) - axis%x(i - 1) > 2.0_wp*axis%least*(1.0_wp - rounding)) then
                    from = [from, 0, i, 0, i + 1]
                else
                    from = [from, i, i + 1]
                end if
            end do
            n = size(from)
            if (n == size(axis%x) .or. (n + 1)/2 > axis%most_nodes) return
            finer = axis
            deallocate (finer%x, finer%f)
            allocate (finer%x(n))
            allocate (finer%f(axis%values, axis%samples, n), source=0.0_wp)
            do i = 1, n
                if (from(i) == 0) cycle
                finer%x(i) = axis%x(from(i))
                finer%f(:, :, i) = axis%f(:, :, from(i))
            end do
            do i = 2, n - 1
                if (from(i) == 0) finer%x(i) = 0.5_wp*(finer%x(i - 1) + finer%x(i + 1))
            end do
            call solve_places(family, finer, pack([(i, i=1, n)], from == 0), status)
            if (is_error(status)) return
            axis = finer
        end do
    end subroutine refine_axis

    !> The nodes of an axis.
    subroutine nodes_of(axis, nodes)
        type(sampled_axis_t), intent(in) :: axis  !! started
        type(lookup_axis_t), intent(out) :: nodes !! for a table

        if (size(axis%x) == 1) then
            call make_point(axis%x(1), nodes)
        else
            call make_axis(axis%x(1::2), nodes)
        end if
    end subroutine nodes_of

    ! All samples at some places, shared by threads.
    subroutine solve_places(family, axis, places, status)
        class(family_t), intent(inout) :: family
        type(sampled_axis_t), intent(inout) :: axis
        integer, intent(in) :: places(:)
        type(status_t), intent(out) :: status

        type(status_t) :: said
        integer :: i, me, failed, n

        call clear_status(status)
        n = axis%jobs*size(places)
        failed = n + 1
        !$omp parallel do num_threads(family%threads) schedule(static, 1) default(none) &
        !$omp shared(family, axis, places, status, failed, n) private(i, said)
        do me = 1, family%threads
            do i = me, n, family%threads
                if (me == 1) call family%progress('places of an axis', i - 1, n)
                call family%sample(me, axis, places(1 + (i - 1)/axis%jobs), &
                                   1 + modulo(i - 1, axis%jobs), said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine solve_places
end module faststrip_tabulate_axis
