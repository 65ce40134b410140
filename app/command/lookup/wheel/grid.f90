!> Nodes of a wheel's lookup table over y, yaw and load, placed where contacts and forces bend.
!>
!> Each cell of an axis is halved while linear interpolation along that axis alone is wrong by more
!> than a limit in its middle, in the worst of some places of the other coordinates; and while it is
!> longer than the least cell. So nodes crowd where contacts come and go, up to that width.
module faststrip_command_lookup_wheel_grid
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, clear_status, number_text
    use faststrip_command_program_console, only: progress
    use faststrip_command_lookup_direct, only: note_failure
    use faststrip_command_lookup_points, only: scattered_point
    use faststrip_command_lookup_states, only: drawn_creepages
    use faststrip_command_lookup_wheel_judge, only: sums_of, n_sums
    use faststrip_command_lookup_wheel_solver, only: wheel_solver_t, found_contacts_t, &
                                                     solve_place, take_contact, solve_creep
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis, make_point
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: at_load, at_rail_y
    use faststrip_lookup_wheel, only: n_wheel_place
    use faststrip_wheelset_types, only: most_contacts
    implicit none
    private

    public :: wheel_axis_t, wheel_limits_t, start_wheel_axis, refine_wheel_axis, wheel_nodes
    public :: in_a_cell

    ! Tuned [places]: of the other coordinates, and creepages at each. Origin: cost.
    integer, parameter :: n_lines = 8, n_creepages = 6
    ! Tuned [nodes]: of y, yaw, load to begin with. Origin: chosen.
    integer, parameter :: first_nodes(n_wheel_place) = [13, 4, 4]
    ! Tuned [N/N]: friction. Origin: usual.
    real(wp), parameter :: sample_mu = 0.3_wp
    ! Tuned [mm/N**(1/3)]: length c of a usual contact. Origin: 5.5 mm under 80 kN.
    real(wp), parameter :: usual_length = 0.128_wp
    ! Tuned [1]: Kalker's coefficient of one. Origin: usual.
    real(wp), parameter :: usual_stiffness = 4.2_wp

    !> What is asked of the axes.
    type :: wheel_limits_t
        real(wp) :: ends(2, n_wheel_place) = 0.0_wp  !! first and last y (mm), yaw (rad), load (N)
        real(wp) :: least(n_wheel_place) = 0.0_wp    !! the least cells, in their units
        integer :: most_nodes = 0                    !! of an axis
    end type wheel_limits_t

    !> An axis with what was solved along it: places 1, 3, 5, ... are nodes, those between them the
    !> middles of cells.
    type :: wheel_axis_t
        private
        integer :: along = 0                     ! 1 y, 2 yaw, 3 load
        type(wheel_limits_t) :: limits
        real(wp), allocatable :: y(:)            ! nodes of y, whose cells lines are drawn from
        real(wp), allocatable :: x(:)            ! 2 n - 1 places; one where nothing varies
        real(wp), allocatable :: f(:, :, :)      ! sums, creepages and lines, places
        real(wp), allocatable :: middle(:, :)    ! mean place of contact over c, lines, places
    end type wheel_axis_t

contains

    !> Solve along a coarse axis.
    subroutine start_wheel_axis(solvers, along, limits, axis, status, y_axis)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! one for each thread
        integer, intent(in) :: along                !! 1 y, 2 yaw, 3 load
        type(wheel_limits_t), intent(in) :: limits  !! ends, least cells
        type(wheel_axis_t), intent(out) :: axis     !! to be refined
        type(status_t), intent(out) :: status       !! of the first place that fails, named
        type(wheel_axis_t), intent(in), optional :: y_axis
            !! of y, refined: places of another axis lie in any of its cells, so most of them where
            !! contacts come and go

        integer :: i, n

        call clear_status(status)
        axis%along = along
        if (present(y_axis)) axis%y = y_axis%x(1::2)
        axis%limits = limits
        associate (first => limits%ends(1, along), last => limits%ends(2, along))
            if (.not. last > first) then
                axis%x = [first]
                return
            end if
            n = first_nodes(along)
            allocate (axis%x(2*n - 1))
            do i = 1, n
                axis%x(2*i - 1) = first + (last - first)*real(i - 1, wp)/(n - 1)
                if (along == 3) axis%x(2*i - 1) = first*(last/first)**(real(i - 1, wp)/(n - 1))
            end do
            axis%x(2*n - 1) = last
        end associate
        axis%x(2::2) = 0.5_wp*(axis%x(1:2*n - 3:2) + axis%x(3::2))
        allocate (axis%f(n_sums, n_lines*n_creepages, size(axis%x)), source=0.0_wp)
        allocate (axis%middle(n_lines, size(axis%x)), source=0.0_wp)
        call solve_places_along(solvers, axis, [(i, i=1, size(axis%x))], status)
    end subroutine start_wheel_axis

    !> Halve cells until none is wrong by more than a limit, or longer than the least.
    subroutine refine_wheel_axis(solvers, limit, axis, status)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! one for each thread
        real(wp), intent(in) :: limit                !! of the error along the axis alone
        type(wheel_axis_t), intent(inout) :: axis    !! started
        type(status_t), intent(out) :: status        !! of the first place that fails, named

        type(wheel_axis_t) :: finer
        integer, allocatable :: from(:) ! place of the coarser axis, 0: a new one
        integer :: i, n

        call clear_status(status)
        if (size(axis%x) == 1) return
        do
            from = [1]
            do i = 2, size(axis%x), 2
                if (cell_error(axis, i) > limit .and. axis%x(i + 1) - axis%x(i - 1) &
                    > 1.999_wp*axis%limits%least(axis%along)) then
                    from = [from, 0, i, 0, i + 1]
                else
                    from = [from, i, i + 1]
                end if
            end do
            n = size(from)
            if (n == size(axis%x) .or. (n + 1)/2 > axis%limits%most_nodes) return
            finer%along = axis%along
            finer%limits = axis%limits
            if (allocated(axis%y)) finer%y = axis%y
            if (allocated(finer%x)) deallocate (finer%x, finer%f, finer%middle)
            allocate (finer%x(n))
            allocate (finer%f(n_sums, n_lines*n_creepages, n), source=0.0_wp)
            allocate (finer%middle(n_lines, n), source=0.0_wp)
            do i = 1, n
                if (from(i) == 0) cycle
                finer%x(i) = axis%x(from(i))
                finer%f(:, :, i) = axis%f(:, :, from(i))
                finer%middle(:, i) = axis%middle(:, from(i))
            end do
            do i = 2, n - 1
                if (from(i) == 0) finer%x(i) = 0.5_wp*(finer%x(i - 1) + finer%x(i + 1))
            end do
            call solve_places_along(solvers, finer, pack([(i, i=1, n)], from == 0), status)
            if (is_error(status)) return
            axis = finer
        end do
    end subroutine refine_wheel_axis

    !> The nodes of an axis.
    subroutine wheel_nodes(axis, nodes)
        type(wheel_axis_t), intent(in) :: axis    !! refined
        type(lookup_axis_t), intent(out) :: nodes !! for a table

        if (size(axis%x) == 1) then
            call make_point(axis%x(1), nodes)
        else
            call make_axis(axis%x(1::2), nodes)
        end if
    end subroutine wheel_nodes

    ! What linear interpolation misses in the middle of a cell, on the worst line.
    pure real(wp) function cell_error(axis, middle) result(error)
        type(wheel_axis_t), intent(in) :: axis
        integer, intent(in) :: middle

        real(wp) :: miss(n_sums, n_lines*n_creepages)
        integer :: line, k, first, last

        miss = axis%f(:, :, middle) - 0.5_wp*(axis%f(:, :, middle - 1) + axis%f(:, :, middle + 1))
        error = 0.0_wp
        do line = 1, n_lines
            first = 1 + n_creepages*(line - 1)
            last = first + n_creepages - 1
            ! Moments are about the rail's origin: those about the mean place of contact.
            miss(4, first:last) = miss(4, first:last) + axis%middle(line, middle) &
                                  *miss(1, first:last)
            do k = 1, n_sums
                error = max(error, sqrt(sum(miss(k, first:last)**2)/n_creepages))
            end do
        end do
    end function cell_error

    ! Sums at places of the axis.
    subroutine solve_places_along(solvers, axis, places, status)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(wheel_axis_t), intent(inout) :: axis
        integer, intent(in) :: places(:)
        type(status_t), intent(out) :: status

        type(status_t) :: said
        integer :: job, me, failed

        call clear_status(status)
        failed = n_lines*size(places) + 1
        !$omp parallel do num_threads(size(solvers)) schedule(static, 1) default(none) &
        !$omp shared(solvers, axis, places, status, failed) private(job, said)
        do me = 1, size(solvers)
            do job = me, n_lines*size(places), size(solvers)
                if (me == 1) call progress('places of an axis', job - 1, n_lines*size(places))
                call solve_line(solvers(me), axis, places(1 + (job - 1)/n_lines), &
                                1 + modulo(job - 1, n_lines), said)
                if (.not. is_error(said)) cycle
                call note_failure(job, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine solve_places_along

    ! Sums over mu times the load, and its length, for all creepages of a line, at a place.
    subroutine solve_line(solver, axis, i, line, status)
        type(wheel_solver_t), intent(inout) :: solver
        type(wheel_axis_t), intent(inout) :: axis
        integer, intent(in) :: i, line
        type(status_t), intent(out) :: status

        type(found_contacts_t) :: found
        real(wp) :: u(n_wheel_place), place(n_wheel_place), sums(n_sums), creepages(3), c, load
        real(wp) :: forces(n_forces, n_creepages, most_contacts)
        integer :: k, j

        u = scattered_point(line, axis%along, n_wheel_place)
        place = axis%limits%ends(1, :) + u*(axis%limits%ends(2, :) - axis%limits%ends(1, :))
        if (allocated(axis%y)) place(1) = in_a_cell(axis%y, u(1))
        place(axis%along) = axis%x(i)
        call solve_place(solver, place, found, status)
        if (is_error(status)) then
            status%message = trim(status%message) // ' (y ' // trim(number_text(place(1))) &
                             // ' mm, yaw ' // trim(number_text(place(2))) // ' rad, load ' &
                             // trim(number_text(place(3))) // ' N)'
            return
        end if
        ! Creepages as of a contact of usual size under the load in the middle of the axis.
        load = sqrt(product(axis%limits%ends(:, 3)))
        c = usual_length*load**(1.0_wp/3.0_wp)
        do k = 1, found%n
            call take_contact(solver, k)
            do j = 1, n_creepages
                creepages = drawn_creepages(scattered_point(n_creepages*line + j, axis%along, 4))
                creepages = creepages*sample_mu*load/(usual_stiffness*solver%shear*c**2) &
                            *[1.0_wp, 1.0_wp, 1.0_wp/c]
                call solve_creep(solver, sample_mu, creepages, forces(:, j, k), status)
                if (is_error(status)) return
            end do
        end do
        associate (numbers => found%numbers(:, :found%n))
            axis%middle(line, i) = sum(numbers(at_load, :)*numbers(at_rail_y, :)) &
                                   /(c*sum(numbers(at_load, :)))
        end associate
        do j = 1, n_creepages
            call sums_of(found%numbers(:, :found%n), forces(:, j, :found%n), 0.0_wp, sums)
            axis%f(:, n_creepages*(line - 1) + j, i) = &
                sums/(place(3)*[sample_mu, sample_mu, sample_mu, sample_mu*c, 1.0_wp])
        end do
    end subroutine solve_line

    !> A place in any cell of an axis, the cells all alike.
    pure real(wp) function in_a_cell(nodes, part) result(place)
        real(wp), intent(in) :: nodes(:) !! rising
        real(wp), intent(in) :: part     !! 0 to below 1

        integer :: cell

        associate (cells => size(nodes) - 1)
            cell = min(1 + int(part*cells), cells)
            place = nodes(cell) + (part*cells - (cell - 1))*(nodes(cell + 1) - nodes(cell))
        end associate
    end function in_a_cell
end module faststrip_command_lookup_wheel_grid
