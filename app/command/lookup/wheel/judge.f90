!> The lookup table of a wheel against direct solutions of fresh states.
!>
!> Each state has one set of creepages for all contacts of the wheel, as a vehicle would give them.
!> What is compared are sums over the contacts, so no contact of the table has to be told which one
!> of the solution it is: creep forces ahead, and across the normal, as a vector in the track; their
!> moment about the normals with that of the forces ahead about the mean place of contact; and the
!> lateral part of the normal forces, which shows how well contacts are placed.
module faststrip_command_lookup_wheel_judge
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: progress, note, fail_on_error
    use faststrip_command_lookup_points, only: scattered_point
    use faststrip_command_lookup_scatter, only: scatter_of, percentile_bound
    use faststrip_command_lookup_states, only: drawn_creepages
    use faststrip_command_lookup_wheel_solver, only: wheel_solver_t, found_contacts_t, &
                                                     solve_place, take_contact, solve_creep
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_faces, only: n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, n_contact_numbers, n_wheel_errors, most_slots, &
                                      at_load, at_angle, at_rail_y, at_length, at_creep, at_spin
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, contacts_change, &
                                      n_wheel_place, n_wheel_state
    implicit none
    private

    public :: judged_t, judge_table, judge_wheel, draw_wheel_states, sums_of, n_sums

    !> Sums over the contacts of a wheel: ahead; across, along y and z of the track; moment; lateral
    !> part of the normal forces.
    !> Given: what is compared.
    integer, parameter :: n_sums = 5

    ! Tuned [N/N]: friction of fresh states, least and range. Origin: chosen.
    real(wp), parameter :: least_mu = 0.1_wp, range_mu = 0.5_wp
    ! Tuned [points]: places drawn for one in a cell where contacts come or go. Origin: cost.
    integer, parameter :: most_draws = 400

    !> A fresh state and what came of it.
    type :: judged_t
        real(wp) :: state(n_wheel_state) = 0.0_wp      !! as of `look_up_wheel`
        logical :: changes = .false.                   !! do contacts come or go in its cell?
        logical :: is_solved = .false.                 !! has it a direct solution?
        integer :: n = 0                               !! contacts of that
        real(wp) :: sums(n_sums, 0:2) = 0.0_wp         !! solved, linear, cubic
        real(wp) :: off(n_wheel_errors, 2) = 0.0_wp    !! errors, linear, cubic
    end type judged_t

contains

    !> Find the errors of a table: on fresh states, and on as many in cells where contacts come or
    !> go.
    subroutine judge_table(solvers, tests, seed, lookup, bounds)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! one for each thread
        integer, intent(in) :: tests            !! fresh states of each kind
        integer, intent(in) :: seed             !! which ones
        type(lookup_t), intent(inout) :: lookup !! filled; gets its errors
        real(wp), intent(out), optional :: bounds(n_wheel_errors, 2, 2)
            !! `percentile_bound` of each error; linear, cubic; all, where contacts come or go

        type(judged_t), allocatable :: states(:)
        real(wp) :: found(n_wheel_errors, 2)
        type(status_t) :: status
        integer :: k

        do k = 1, 2
            call draw_wheel_states(lookup, tests, seed, k == 2, states)
            call judge_wheel(solvers, lookup, states, lookup%wheel%errors(:, :, :, k), &
                             lookup%wheel%tested(k), status, found)
            if (present(bounds)) bounds(:, :, k) = found
            call fail_on_error(status)
            if (lookup%wheel%tested(k) < size(states)) &
                call note(integer_text(size(states) - lookup%wheel%tested(k)) // ' of ' &
                          // integer_text(size(states)) // ' fresh states have no direct solution')
        end do
    end subroutine judge_table

    !> Fresh states over the whole table; or only in cells where contacts come or go.
    subroutine draw_wheel_states(lookup, n, seed, where_they_change, states)
        type(lookup_t), intent(in) :: lookup       !! filled
        integer, intent(in) :: n                   !! how many; fewer where there are no such cells
        integer, intent(in) :: seed                !! which ones
        logical, intent(in) :: where_they_change   !! only in such cells?
        type(judged_t), allocatable, intent(out) :: states(:)

        type(judged_t) :: state
        real(wp) :: point(9)
        integer :: i, drawn

        allocate (states(n))
        drawn = 0
        do i = 1, merge(most_draws, 1, where_they_change)*n
            if (drawn == n) exit
            point = scattered_point(i, seed, size(point))
            state = judged_t()
            state%state(1) = place_on(lookup%wheel%y, point(1), where_they_change)
            state%state(2) = place_on(lookup%wheel%yaw, point(2), .false.)
            state%state(3) = place_on(lookup%wheel%load, point(3), .false.)
            state%changes = contacts_change(lookup, state%state(:n_wheel_place))
            if (where_they_change .and. .not. state%changes) cycle
            state%state(4) = least_mu + range_mu*point(4)
            call take_creepages(lookup, point(5:9), state)
            drawn = drawn + 1
            states(drawn) = state
        end do
        states = states(:drawn)
    end subroutine draw_wheel_states

    ! A place along an axis, evenly along it; or each cell as often as any other one.
    pure real(wp) function place_on(axis, part, by_cells) result(place)
        type(lookup_axis_t), intent(in) :: axis
        real(wp), intent(in) :: part
        logical, intent(in) :: by_cells

        integer :: cell

        if (axis%n == 1) then
            place = axis%x(1)
        else if (by_cells) then
            cell = min(1 + int(part*(axis%n - 1)), axis%n - 1)
            place = axis%x(cell) + (part*(axis%n - 1) - (cell - 1))*(axis%x(cell + 1) &
                                                                     - axis%x(cell))
        else
            place = axis%x(1) + part*(axis%x(axis%n) - axis%x(1))
        end if
        place = min(max(place, axis%x(1)), axis%x(axis%n))
    end function place_on

    ! Creepages of a state, normalised by one of its contacts, which is drawn, too.
    subroutine take_creepages(lookup, point, state)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: point(5)
        type(judged_t), intent(inout) :: state

        type(status_t) :: status
        real(wp) :: contacts(n_contact_numbers, most_slots)
        integer :: slots(most_slots), n, i, slot

        call look_up_contacts(lookup, lookup_linear, state%state(:n_wheel_place), contacts, status)
        n = 0
        do i = 1, most_slots
            if (.not. contacts(at_load, i) > 0.0_wp) cycle
            n = n + 1
            slots(n) = i
        end do
        if (n == 0) return
        slot = slots(min(1 + int(n*point(5)), n))
        state%state(5:7) = drawn_creepages(point(:4))*state%state(4)*contacts(at_load, slot) &
                           /(lookup%wheel%shear*contacts(at_creep:at_spin, slot))
    end subroutine take_creepages

    !> Compare a table with direct solutions of states.
    subroutine judge_wheel(solvers, lookup, states, errors, n_solved, status, bounds)
        type(wheel_solver_t), intent(inout) :: solvers(:)  !! one for each thread
        type(lookup_t), intent(in) :: lookup               !! filled
        type(judged_t), intent(inout) :: states(:)         !! drawn or given; judged
        real(wp), intent(out) :: errors(n_wheel_errors, 3, 2) !! as of `lookup%wheel%errors`
        integer, intent(out) :: n_solved                   !! states with a direct solution
        type(status_t), intent(out) :: status              !! of looking up
        real(wp), intent(out), optional :: bounds(n_wheel_errors, 2)
            !! `percentile_bound` of each error; linear, cubic

        real(wp), allocatable :: off(:)
        integer :: i, k, order, me

        call clear_status(status)
        !$omp parallel do num_threads(size(solvers)) schedule(static, 1) default(none) &
        !$omp shared(solvers, lookup, states) private(i)
        do me = 1, size(solvers)
            do i = me, size(states), size(solvers)
                if (me == 1) call progress('fresh states', i - 1, size(states))
                call judge_state(solvers(me), lookup, states(i))
            end do
        end do
        !$omp end parallel do
        errors = 0.0_wp
        if (present(bounds)) bounds = 0.0_wp
        n_solved = count(states%is_solved)
        if (n_solved == 0) return
        do order = 1, 2
            do k = 1, n_wheel_errors
                off = pack(states%off(k, order), states%is_solved)
                errors(k, :, order) = scatter_of(off)
                if (present(bounds)) bounds(k, order) = percentile_bound(off)
            end do
        end do
    end subroutine judge_wheel

    ! One state, solved and looked up by both orders.
    subroutine judge_state(solver, lookup, state)
        type(wheel_solver_t), intent(inout) :: solver
        type(lookup_t), intent(in) :: lookup
        type(judged_t), intent(inout) :: state

        type(status_t) :: status
        type(found_contacts_t) :: found
        real(wp) :: forces(n_forces, most_slots), contacts(n_contact_numbers, most_slots)
        real(wp) :: middle, loads, c
        integer, parameter :: orders(2) = [lookup_linear, lookup_cubic]
        integer :: order, slot

        associate (place => state%state(:n_wheel_place), mu => state%state(4))
            call solve_place(solver, place, found, status)
            if (is_error(status)) return
            call sums_of_found(solver, found, mu, state%state(5:7), middle, state%sums(:, 0), &
                               status)
            if (is_error(status)) return
            state%n = found%n
            loads = sum(found%numbers(at_load, :found%n))
            c = sum(found%numbers(at_load, :found%n)*found%numbers(at_length, :found%n))/loads
            do order = 1, 2
                call look_up_contacts(lookup, orders(order), place, contacts, status)
                if (is_error(status)) return
                forces = 0.0_wp
                do slot = 1, lookup%wheel%slots
                    call look_up_wheel(lookup, orders(order), slot, state%state, forces(:, slot), &
                                       status)
                    if (is_error(status)) return
                end do
                call sums_of(contacts, forces, middle, state%sums(:, order))
                associate (miss => state%sums(:, order) - state%sums(:, 0))
                    state%off(:, order) = [abs(miss(1))/(mu*loads), norm2(miss(2:3))/(mu*loads), &
                                           abs(miss(4))/(mu*loads*c), abs(miss(5))/loads]
                end associate
            end do
        end associate
        state%is_solved = .true.
    end subroutine judge_state

    ! Sums of a direct solution, about the mean place of its contacts.
    subroutine sums_of_found(solver, found, mu, creepages, middle, sums, status)
        type(wheel_solver_t), intent(inout) :: solver
        type(found_contacts_t), intent(in) :: found
        real(wp), intent(in) :: mu, creepages(3)
        real(wp), intent(out) :: middle, sums(n_sums)
        type(status_t), intent(out) :: status

        real(wp) :: forces(n_forces, size(found%numbers, 2))
        integer :: i

        call clear_status(status)
        forces = 0.0_wp
        middle = 0.0_wp
        sums = 0.0_wp
        do i = 1, found%n
            call take_contact(solver, i)
            call solve_creep(solver, mu, creepages, forces(:, i), status)
            if (is_error(status)) return
        end do
        associate (numbers => found%numbers(:, :found%n))
            middle = sum(numbers(at_load, :)*numbers(at_rail_y, :))/sum(numbers(at_load, :))
            call sums_of(numbers, forces(:, :found%n), middle, sums)
        end associate
    end subroutine sums_of_found

    !> Sums over contacts.
    pure subroutine sums_of(contacts, forces, middle, sums)
        real(wp), intent(in) :: contacts(:, :) !! numbers, contacts
        real(wp), intent(in) :: forces(:, :)   !! Fx, Fy, Mz, contacts
        real(wp), intent(in) :: middle         !! y on the rail that the moment is about, mm
        real(wp), intent(out) :: sums(n_sums)  !! N; N mm

        integer :: i

        sums = 0.0_wp
        do i = 1, size(contacts, 2)
            if (.not. contacts(at_load, i) > 0.0_wp) cycle
            associate (c => cos(contacts(at_angle, i)), s => sin(contacts(at_angle, i)), &
                       load => contacts(at_load, i), y => contacts(at_rail_y, i), &
                       fx => forces(1, i), fy => forces(2, i), mz => forces(3, i))
                sums = sums + [fx, fy*c, fy*s, mz*c - (y - middle)*fx, -load*s]
            end associate
        end do
    end subroutine sums_of
end module faststrip_command_lookup_wheel_judge
