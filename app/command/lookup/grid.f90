!> Nodes of a Hertz lookup table, placed where forces bend.
!>
!> Each cell of an axis is halved while linear interpolation along that axis alone is wrong by more
!> than a limit: at its middle, for a high percentile of scattered places of the other coordinates.
module faststrip_command_lookup_grid
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, clear_status
    use faststrip_command_lookup_direct, only: direct_t, note_failure
    use faststrip_command_lookup_points, only: scattered_point
    use faststrip_command_lookup_scatter, only: percentile
    use faststrip_command_lookup_states, only: phi_at, shape_scale
    use faststrip_lookup_faces, only: n_forces, n_faces
    implicit none
    private

    public :: sampled_axis_t, start_axis, refine_axis, nodes_of, axis_q, axis_ratio, axis_shape

    !> Axes, by their numbers.
    !> Given: their order in a table.
    integer, parameter :: axis_q = 1, axis_ratio = 2, axis_shape = 3

    ! Tuned [places]: of the other coordinates, for each cell. Origin: cost.
    integer, parameter :: n_samples = 200
    ! Tuned [1]: Percentile of the errors of a cell. Origin: chosen; kinks of the method leave worse
    ! ones anywhere.
    real(wp), parameter :: judged_at = 95.0_wp
    ! Tuned [nodes]: of an axis to begin with. Origin: chosen.
    integer, parameter :: first_nodes = 5

    !> An axis with what was solved along it: places 1, 3, 5, ... are nodes, those between them the
    !> middles of cells.
    type :: sampled_axis_t
        private
        integer :: kind = 0
        real(wp) :: ends(2) = 0.0_wp          ! least and largest ln(a/b), for all axes
        real(wp), allocatable :: x(:)         ! 2 n - 1 places
        real(wp), allocatable :: f(:, :, :)   ! forces, samples, places
    end type sampled_axis_t

contains

    !> Solve along a coarse axis.
    subroutine start_axis(workers, kind, ends, axis, status)
        type(direct_t), intent(inout) :: workers(:) !! one for each thread
        integer, intent(in) :: kind                !! `axis_q`, `axis_ratio` or `axis_shape`
        real(wp), intent(in) :: ends(2)            !! least and largest ln(a/b)
        type(sampled_axis_t), intent(out) :: axis  !! to be refined
        type(status_t), intent(out) :: status      !! of the method

        integer :: i, places

        places = 2*first_nodes - 1
        axis%kind = kind
        axis%ends = ends
        axis%x = [(real(i - 1, wp)/(places - 1), i=1, places)]
        if (kind == axis_shape) axis%x = ends(1) + (ends(2) - ends(1))*axis%x
        allocate (axis%f(n_forces, n_samples, places))
        do i = 1, places
            call solve_along(workers, axis, axis%x(i), axis%f(:, :, i), status)
            if (is_error(status)) return
        end do
    end subroutine start_axis

    !> Halve cells until none is wrong by more than a limit.
    subroutine refine_axis(workers, limit, most_nodes, axis, status)
        type(direct_t), intent(inout) :: workers(:) !! one for each thread
        real(wp), intent(in) :: limit               !! of the error along the axis alone, over mu N
        integer, intent(in) :: most_nodes           !! at which refining ends
        type(sampled_axis_t), intent(inout) :: axis !! started
        type(status_t), intent(out) :: status       !! of the method

        type(sampled_axis_t) :: finer
        integer, allocatable :: from(:) ! place of the coarser axis, 0: a new one
        integer :: i, cells

        call clear_status(status)
        do
            cells = (size(axis%x) - 1)/2
            from = [1]
            do i = 1, cells
                if (cell_error(axis, i) > limit) then
                    from = [from, 0, 2*i, 0, 2*i + 1]
                else
                    from = [from, 2*i, 2*i + 1]
                end if
            end do
            if (size(from) == size(axis%x) .or. (size(from) + 1)/2 > most_nodes) return
            finer%kind = axis%kind
            finer%ends = axis%ends
            if (allocated(finer%x)) deallocate (finer%x, finer%f)
            allocate (finer%x(size(from)), finer%f(n_forces, n_samples, size(from)))
            do i = 1, size(from)
                if (from(i) == 0) cycle
                finer%x(i) = axis%x(from(i))
                finer%f(:, :, i) = axis%f(:, :, from(i))
            end do
            do i = 1, size(from)
                if (from(i) > 0) cycle
                finer%x(i) = 0.5_wp*(finer%x(i - 1) + finer%x(i + 1))
                call solve_along(workers, finer, finer%x(i), finer%f(:, :, i), status)
                if (is_error(status)) return
            end do
            axis = finer
        end do
    end subroutine refine_axis

    !> The nodes of an axis.
    pure function nodes_of(axis) result(nodes)
        type(sampled_axis_t), intent(in) :: axis
        real(wp), allocatable :: nodes(:)

        nodes = axis%x(1::2)
    end function nodes_of

    !> What linear interpolation misses in the middle of a cell.
    pure real(wp) function cell_error(axis, cell) result(error)
        type(sampled_axis_t), intent(in) :: axis
        integer, intent(in) :: cell

        real(wp) :: errors(n_samples)
        integer :: i

        do i = 1, n_samples
            errors(i) = maxval(abs(axis%f(:, i, 2*cell) - 0.5_wp*(axis%f(:, i, 2*cell - 1) &
                                                                  + axis%f(:, i, 2*cell + 1))))
        end do
        error = percentile(errors, judged_at)
        if (axis%kind == axis_q) error = axis%x(2*cell)*error
    end function cell_error

    !> Forces over mu N for all samples at a place of the axis; along q Phi, which is what is
    !> interpolated there.
    subroutine solve_along(workers, axis, x, f, status)
        type(direct_t), intent(inout) :: workers(:)
        type(sampled_axis_t), intent(in) :: axis
        real(wp), intent(in) :: x
        real(wp), intent(out) :: f(n_forces, n_samples)
        type(status_t), intent(out) :: status

        type(status_t) :: found
        integer :: i, me, failed

        call clear_status(status)
        failed = n_samples + 1
        !$omp parallel do num_threads(size(workers)) schedule(static, 1) default(none) &
        !$omp shared(workers, axis, x, f, status, failed) private(i, found)
        do me = 1, size(workers)
            do i = me, n_samples, size(workers)
                call solve_sample(workers(me), axis, x, i, f(:, i), found)
                if (.not. is_error(found)) cycle
                call note_failure(i, found, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine solve_along

    !> The same for one sample.
    subroutine solve_sample(direct, axis, x, i, f, status)
        type(direct_t), intent(inout) :: direct
        type(sampled_axis_t), intent(in) :: axis
        real(wp), intent(in) :: x
        integer, intent(in) :: i
        real(wp), intent(out) :: f(n_forces)
        type(status_t), intent(out) :: status

        real(wp) :: u(5), q, s, t, log_ratio, scale(3)
        integer :: face

        u = scattered_point(i, axis%kind, 5)
        face = min(1 + int(n_faces*u(5)), n_faces)
        q = u(1)
        s = u(2)
        t = u(3)
        log_ratio = axis%ends(1) + u(4)*(axis%ends(2) - axis%ends(1))
        select case (axis%kind)
        case (axis_q)
            q = x
        case (axis_ratio)
            if (modulo(i, 2) == 0) s = x
            if (modulo(i, 2) == 1) t = x
        case (axis_shape)
            log_ratio = x
        end select
        f = 0.0_wp
        scale = shape_scale(log_ratio, direct%choice%nu, status)
        if (is_error(status)) return
        call phi_at(direct, log_ratio, scale, face, q, s, t, f, status)
        if (is_error(status)) return
        if (axis%kind /= axis_q) f = q*f
    end subroutine solve_sample
end module faststrip_command_lookup_grid
