!> A Hertz lookup table from its nodes, and its errors.
module faststrip_command_lookup_fill
    use, intrinsic :: iso_fortran_env, only: int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, clear_status
    use faststrip_command_lookup_direct, only: direct_t, solve_direct, note_failure
    use faststrip_command_lookup_points, only: scattered_point
    use faststrip_command_lookup_scatter, only: scatter_of, percentile_bound
    use faststrip_command_lookup_states, only: phi_at, shape_scale, fresh_state, fresh_coordinates
    use faststrip_lookup_axis, only: make_axis
    use faststrip_lookup_faces, only: n_forces, n_faces, lookup_linear, lookup_cubic
    use faststrip_lookup_hertz, only: look_up_hertz, n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz
    implicit none
    private

    public :: begin_table, fill_shape, judge_table, judge_states, draw_states, nodes_in

contains

    !> A table without values.
    subroutine begin_table(q, ratio, shapes, nu, lookup, status)
        real(wp), intent(in) :: q(:), ratio(:), shapes(:) !! nodes
        real(wp), intent(in) :: nu             !! Poisson's ratio
        type(lookup_t), intent(out) :: lookup  !! to be filled
        type(status_t), intent(out) :: status  !! of Kalker's coefficients

        integer :: i

        call clear_status(status)
        lookup%kind = lookup_kind_hertz
        lookup%nu = nu
        call make_axis(q, lookup%q)
        call make_axis(ratio, lookup%ratio)
        call make_axis(shapes, lookup%shape)
        allocate (lookup%scale(n_forces, size(shapes)))
        do i = 1, size(shapes)
            lookup%scale(:, i) = shape_scale(shapes(i), nu, status)
            if (is_error(status)) return
        end do
        allocate (lookup%values(n_forces*nodes_in(lookup)), source=0.0_real32)
    end subroutine begin_table

    !> Nodes of a table.
    pure integer(int64) function nodes_in(lookup)
        type(lookup_t), intent(in) :: lookup

        nodes_in = int(lookup%q%n, int64)*lookup%ratio%n**2*n_faces*lookup%shape%n
    end function nodes_in

    !> Solve all nodes of one a/b. Each is a cold start: no bit depends on the threads.
    subroutine fill_shape(workers, i_shape, lookup, status)
        type(direct_t), intent(inout) :: workers(:) !! one for each thread
        integer, intent(in) :: i_shape          !! which a/b
        type(lookup_t), intent(inout) :: lookup !! begun
        type(status_t), intent(out) :: status   !! of the method, at the first node that fails

        type(status_t) :: found
        real(wp) :: phi(n_forces)
        integer(int64) :: first, at
        integer :: line, lines, failed, me, face, i, j, k

        call clear_status(status)
        lines = n_faces*lookup%ratio%n**2
        first = n_forces*(nodes_in(lookup)/lookup%shape%n)*(i_shape - 1)
        failed = lines
        !$omp parallel do num_threads(size(workers)) schedule(static, 1) default(none) &
        !$omp shared(workers, lookup, status, lines, first, failed, i_shape) &
        !$omp private(line, found, phi, at, face, i, j, k)
        do me = 1, size(workers)
            lines_of_worker: do line = me - 1, lines - 1, size(workers)
                face = 1 + line/lookup%ratio%n**2
                k = 1 + modulo(line/lookup%ratio%n, lookup%ratio%n)
                j = 1 + modulo(line, lookup%ratio%n)
                at = first + int(n_forces*lookup%q%n, int64)*line
                do i = 1, lookup%q%n
                    call phi_at(workers(me), lookup%shape%x(i_shape), lookup%scale(:, i_shape), &
                                face, lookup%q%x(i), lookup%ratio%x(j), lookup%ratio%x(k), phi, &
                                found)
                    if (is_error(found)) then
                        call note_failure(line, found, failed, status)
                        exit lines_of_worker
                    end if
                    lookup%values(at + 1:at + n_forces) = real(phi, real32)
                    at = at + n_forces
                end do
            end do lines_of_worker
        end do
        !$omp end parallel do
    end subroutine fill_shape

    !> Compare a table with direct solutions of fresh contacts.
    subroutine judge_table(workers, lookup, n, seed, errors, status, bounds)
        type(direct_t), intent(inout) :: workers(:) !! one for each thread
        type(lookup_t), intent(in) :: lookup     !! filled
        integer, intent(in) :: n                 !! contacts
        integer, intent(in) :: seed              !! which ones
        real(wp), intent(out) :: errors(3, 3, 2) !! as `lookup%errors`
        type(status_t), intent(out) :: status    !! of the method, at the first contact that fails
        real(wp), intent(out), optional :: bounds(3, 2) !! as of `judge_states`

        real(wp), allocatable :: states(:, :), forces(:, :, :)

        call draw_states(lookup, n, seed, states, status)
        if (.not. is_error(status)) &
            call judge_states(workers, lookup, states, forces, errors, status, bounds)
    end subroutine judge_table

    !> Fresh contacts.
    subroutine draw_states(lookup, n, seed, states, status)
        type(lookup_t), intent(in) :: lookup                !! begun
        integer, intent(in) :: n                            !! contacts
        integer, intent(in) :: seed                         !! which ones
        real(wp), allocatable, intent(out) :: states(:, :)  !! numbers, contacts
        type(status_t), intent(out) :: status               !! of Kalker's coefficients

        integer :: i

        call clear_status(status)
        allocate (states(n_lookup_state, n))
        do i = 1, n
            states(:, i) = fresh_state(scattered_point(i, seed, fresh_coordinates), &
                                       lookup%shape%x(1), lookup%shape%x(lookup%shape%n), &
                                       lookup%nu, status)
            if (is_error(status)) return
        end do
    end subroutine draw_states

    !> Compare a table with direct solutions of given contacts.
    subroutine judge_states(workers, lookup, states, forces, errors, status, bounds)
        type(direct_t), intent(inout) :: workers(:)      !! one for each thread
        type(lookup_t), intent(in) :: lookup             !! filled
        real(wp), intent(in) :: states(:, :)             !! numbers, contacts
        real(wp), allocatable, intent(out) :: forces(:, :, :)
            !! three forces; solved, linear, cubic; contacts
        real(wp), intent(out) :: errors(3, 3, 2)         !! as `lookup%errors`
        type(status_t), intent(out) :: status !! of the method, at the first contact that fails
        real(wp), intent(out), optional :: bounds(3, 2)
            !! `percentile_bound` of the errors of Fx, Fy, Mz; linear, cubic

        type(status_t) :: found
        real(wp) :: off(size(states, 2))
        integer :: i, k, order, me, failed

        call clear_status(status)
        errors = 0.0_wp
        if (present(bounds)) bounds = 0.0_wp
        allocate (forces(n_forces, 3, size(states, 2)), source=0.0_wp)
        failed = size(states, 2) + 1
        !$omp parallel do num_threads(size(workers)) schedule(static, 1) default(none) &
        !$omp shared(workers, lookup, status, states, forces, failed) private(i, found)
        do me = 1, size(workers)
            do i = me, size(states, 2), size(workers)
                call judge_contact(workers(me), lookup, states(:, i), forces(:, :, i), found)
                if (.not. is_error(found)) cycle
                call note_failure(i, found, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
        if (is_error(status)) return
        do order = 1, 2
            do k = 1, n_forces
                off = abs(forces(k, 1 + order, :) - forces(k, 1, :))/(states(3, :)*states(4, :))
                if (k == n_forces) off = off/sqrt(states(1, :)*states(2, :))
                errors(k, :, order) = scatter_of(off)
                if (present(bounds)) bounds(k, order) = percentile_bound(off)
            end do
        end do
    end subroutine judge_states

    !> Forces of a contact, solved and by both orders.
    subroutine judge_contact(direct, lookup, state, forces, status)
        type(direct_t), intent(inout) :: direct
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: state(n_lookup_state)
        real(wp), intent(out) :: forces(n_forces, 3)
        type(status_t), intent(out) :: status

        forces = 0.0_wp
        call look_up_hertz(lookup, lookup_linear, state, forces(:, 2), status)
        if (.not. is_error(status)) &
            call look_up_hertz(lookup, lookup_cubic, state, forces(:, 3), status)
        if (.not. is_error(status)) call solve_direct(direct, state, forces(:, 1), status)
    end subroutine judge_contact
end module faststrip_command_lookup_fill
