!> The lookup table of a wheel from its nodes: first the contacts of all places, then creep forces
!> of each contact.
module faststrip_command_lookup_wheel_fill
    use, intrinsic :: iso_fortran_env, only: int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, clear_status, number_text, &
                                     status_word, st_ok, first_error
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: progress
    use faststrip_command_lookup_direct, only: note_failure
    use faststrip_command_lookup_parts, only: forget_values, is_solved, write_work
    use faststrip_command_lookup_wheel_slots, only: find_slots, neighbour_of, n_directions
    use faststrip_command_lookup_wheel_solver, only: wheel_solver_t, found_contacts_t, &
                                                     solve_place, take_contact, solve_creep
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis, make_point
    use faststrip_lookup_faces, only: n_forces, n_faces, creepages_at
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers, at_load, &
                                      at_area, at_pmax, at_length, at_creep, at_spin
    use faststrip_lookup_wheel, only: n_wheel_place
    implicit none
    private

    public :: set_source_t, begin_wheel_table, solve_sets, place_of

    !> Where the faces of a table come from.
    type :: set_source_t
        integer :: node = 0     !! place
        integer :: contact = 0  !! of it
    end type set_source_t

    ! Friction of the contacts that are solved. It does not matter.
    ! Given: a usual one.
    real(wp), parameter :: node_mu = 0.3_wp
    ! Creepage of a node at which nothing slides, and all does, as for Hertz ellipses.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: least_creepage = 1.0e-5_wp, most_creepage = 1.0e4_wp
    ! Tuned [1]: how often work is kept. Origin: chosen: files are written in less time than solved.
    integer, parameter :: kept_times = 20

contains

    !> A table of which the contacts are there, and no creep force is.
    subroutine begin_wheel_table(solvers, axes, lookup, sources, limited, status)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! one for each thread
        type(lookup_axis_t), intent(in) :: axes(5)  !! q, ratio, y, yaw, load
        type(lookup_t), intent(out) :: lookup       !! to be filled
        type(set_source_t), allocatable, intent(out) :: sources(:) !! of the sets of faces
        character(len=:), allocatable, intent(out) :: limited
            !! what limits solutions of contacts, and of how many; empty: nothing
        type(status_t), intent(out) :: status
            !! of the first place that fails, which is named; too many contacts

        type(found_contacts_t), allocatable :: found(:)
        integer, allocatable :: slot_of(:, :)
        integer :: sizes(n_wheel_place)

        lookup%kind = lookup_kind_wheel
        lookup%q = axes(1)
        lookup%ratio = axes(2)
        lookup%nu = solvers(1)%nu
        associate (wheel => lookup%wheel)
            wheel%y = axes(3)
            wheel%yaw = axes(4)
            wheel%load = axes(5)
            wheel%shear = solvers(1)%shear
            sizes = [wheel%y%n, wheel%yaw%n, wheel%load%n]
        end associate
        allocate (found(product(sizes)))
        call solve_places(solvers, lookup, found, status)
        if (is_error(status)) return
        call find_slots(found, sizes, slot_of, lookup%wheel%slots, status)
        if (is_error(status)) return
        call name_limitations(found, limited)
        call put_contacts(found, slot_of, lookup, sources)
        call spread_contacts(sizes, lookup)
        allocate (lookup%values(2_int64*n_forces*n_faces*lookup%q%n*lookup%ratio%n**2 &
                                *lookup%wheel%sets))
        call forget_values(lookup)
    end subroutine begin_wheel_table

    ! Say how many contacts have a solution with a limitation.
    subroutine name_limitations(found, limited)
        type(found_contacts_t), intent(in) :: found(:)
        character(len=:), allocatable, intent(out) :: limited

        integer :: counts(st_ok + 1:first_error - 1), i, k

        counts = 0
        do i = 1, size(found)
            do k = 1, found(i)%n
                if (found(i)%code(k) > st_ok) counts(found(i)%code(k)) = counts(found(i)%code(k)) &
                    + 1
            end do
        end do
        limited = ''
        do i = lbound(counts, 1), ubound(counts, 1)
            if (counts(i) == 0) cycle
            if (len(limited) > 0) limited = limited // ', '
            limited = limited // trim(status_word(i)) // ' ' // integer_text(counts(i))
        end do
        if (len(limited) > 0) &
            limited = 'limitations of ' // integer_text(sum(counts)) // ' of ' &
                      // integer_text(sum(found%n)) // ' contacts: ' // limited
    end subroutine name_limitations

    !> The place of a node.
    pure function place_of(lookup, node) result(place)
        type(lookup_t), intent(in) :: lookup !! with axes
        integer, intent(in) :: node          !! y fastest, then yaw
        real(wp) :: place(n_wheel_place)     !! y, yaw, load

        associate (wheel => lookup%wheel)
            place(1) = wheel%y%x(1 + modulo(node - 1, wheel%y%n))
            place(2) = wheel%yaw%x(1 + modulo((node - 1)/wheel%y%n, wheel%yaw%n))
            place(3) = wheel%load%x(1 + (node - 1)/(wheel%y%n*wheel%yaw%n))
        end associate
    end function place_of

    ! The contacts of all nodes.
    subroutine solve_places(solvers, lookup, found, status)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(lookup_t), intent(in) :: lookup
        type(found_contacts_t), intent(inout) :: found(:)
        type(status_t), intent(out) :: status

        type(status_t) :: said
        real(wp) :: place(n_wheel_place)
        integer :: i, me, failed

        call clear_status(status)
        failed = size(found) + 1
        !$omp parallel do num_threads(size(solvers)) schedule(static, 1) default(none) &
        !$omp shared(solvers, lookup, found, status, failed) private(i, said)
        do me = 1, size(solvers)
            do i = me, size(found), size(solvers)
                if (me == 1) call progress('places', i - 1, size(found))
                call solve_place(solvers(me), place_of(lookup, i), found(i), said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
        if (.not. is_error(status)) return
        place = place_of(lookup, failed)
        status%message = trim(status%message) // ' (y ' // trim(number_text(place(1))) &
                         // ' mm, yaw ' // trim(number_text(place(2))) // ' rad, load ' &
                         // trim(number_text(place(3))) // ' N)'
    end subroutine solve_places

    ! Contacts into their slots; each gets faces of its own.
    subroutine put_contacts(found, slot_of, lookup, sources)
        type(found_contacts_t), intent(in) :: found(:)
        integer, intent(in) :: slot_of(:, :)
        type(lookup_t), intent(inout) :: lookup
        type(set_source_t), allocatable, intent(out) :: sources(:)

        real(wp) :: root
        integer :: i, node, slot

        allocate (sources(sum(found%n)))
        associate (wheel => lookup%wheel)
            allocate (wheel%contacts(n_contact_numbers, wheel%slots, size(found)), source=0.0_wp)
            allocate (wheel%set(wheel%slots, size(found)), source=0)
            wheel%sets = 0
            do node = 1, size(found)
                do i = 1, found(node)%n
                    slot = slot_of(i, node)
                    wheel%sets = wheel%sets + 1
                    wheel%set(slot, node) = wheel%sets
                    sources(wheel%sets) = set_source_t(node, i)
                    associate (numbers => wheel%contacts(:, slot, node))
                        numbers = found(node)%numbers(:, i)
                        root = numbers(at_load)**(1.0_wp/3.0_wp)
                        numbers(at_area) = numbers(at_area)/root**2
                        numbers(at_pmax:at_length) = numbers(at_pmax:at_length)/root
                        numbers(at_creep:at_spin - 1) = numbers(at_creep:at_spin - 1)/root**2
                        numbers(at_spin) = numbers(at_spin)/root**3
                    end associate
                end do
            end do
        end associate
    end subroutine put_contacts

    ! Where a contact is not, it has the numbers of the nearest node where it is, but no load.
    subroutine spread_contacts(sizes, lookup)
        integer, intent(in) :: sizes(n_wheel_place)
        type(lookup_t), intent(inout) :: lookup

        integer, allocatable :: before(:)
        integer :: slot, node, way, next, left

        associate (wheel => lookup%wheel)
            allocate (before(size(wheel%set, 2)))
            do slot = 1, wheel%slots
                do
                    before = wheel%set(slot, :)
                    left = 0
                    do node = 1, size(before)
                        if (before(node) > 0) cycle
                        left = left + 1
                        do way = 1, n_directions
                            next = neighbour_of(node, way, sizes)
                            if (next == 0) cycle
                            if (before(next) == 0) cycle
                            wheel%contacts(:, slot, node) = wheel%contacts(:, slot, next)
                            wheel%contacts(at_load, slot, node) = 0.0_wp
                            wheel%set(slot, node) = before(next)
                            exit
                        end do
                    end do
                    if (left == 0) exit
                end do
            end do
        end associate
    end subroutine spread_contacts

    !> Solve what is missing of a part: every so manyth set of faces.
    subroutine solve_sets(solvers, sources, part, parts, path, lookup, status)
        type(wheel_solver_t), intent(inout) :: solvers(:) !! one for each thread
        type(set_source_t), intent(in) :: sources(:)      !! of the sets
        integer, intent(in) :: part, parts                !! which one of how many
        character(len=*), intent(in) :: path              !! file of the work; empty: none is kept
        type(lookup_t), intent(inout) :: lookup           !! begun
        type(status_t), intent(out) :: status             !! of the method; of the file

        integer, allocatable :: sets(:)
        integer :: first, last, chunk, i

        call clear_status(status)
        sets = [(i, i=part, lookup%wheel%sets, parts)]
        sets = pack(sets, [(.not. is_solved(lookup, sets(i)), i=1, size(sets))])
        chunk = max(size(sets)/kept_times, 2*size(solvers))
        do first = 1, size(sets), chunk
            call progress('contacts', first - 1, size(sets))
            last = min(first + chunk - 1, size(sets))
            call fill_sets(solvers, sources, sets(first:last), lookup, status)
            if (.not. is_error(status)) call write_work(path, lookup, status)
            if (is_error(status)) return
        end do
    end subroutine solve_sets

    ! Sets of faces, shared by threads.
    subroutine fill_sets(solvers, sources, sets, lookup, status)
        type(wheel_solver_t), intent(inout) :: solvers(:)
        type(set_source_t), intent(in) :: sources(:)
        integer, intent(in) :: sets(:)
        type(lookup_t), intent(inout) :: lookup
        type(status_t), intent(out) :: status

        type(status_t) :: said
        integer :: i, me, failed

        call clear_status(status)
        failed = size(sets) + 1
        !$omp parallel do num_threads(size(solvers)) schedule(static, 1) default(none) &
        !$omp shared(solvers, sources, sets, lookup, status, failed) private(i, said)
        do me = 1, size(solvers)
            do i = me, size(sets), size(solvers)
                call fill_set(solvers(me), sources(sets(i)), sets(i), lookup, said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine fill_sets

    ! All creep forces of one contact, and of its mirror image.
    subroutine fill_set(solver, source, set, lookup, status)
        type(wheel_solver_t), intent(inout) :: solver
        type(set_source_t), intent(in) :: source
        integer, intent(in) :: set
        type(lookup_t), intent(inout) :: lookup
        type(status_t), intent(out) :: status

        type(found_contacts_t) :: found
        real(wp) :: phi(n_forces), mirror(3), linear(3), unit(3)
        integer(int64) :: at
        integer :: side, face, i, j, k

        call solve_place(solver, place_of(lookup, source%node), found, status)
        if (is_error(status)) return
        call take_contact(solver, source%contact)
        associate (numbers => found%numbers(:, source%contact))
            linear = numbers(at_creep:at_spin)*solver%shear/(node_mu*numbers(at_load))
            unit = node_mu*numbers(at_load)*[1.0_wp, 1.0_wp, numbers(at_length)]
        end associate
        at = (set - 1)*(size(lookup%values, kind=int64)/lookup%wheel%sets)
        do side = 1, 2
            mirror = [1, 3 - 2*side, 3 - 2*side]
            do face = 1, n_faces
                do k = 1, lookup%ratio%n
                    do j = 1, lookup%ratio%n
                        do i = 1, lookup%q%n
                            call solve_node(face, [lookup%q%x(i), lookup%ratio%x(j), &
                                                   lookup%ratio%x(k)])
                            if (is_error(status)) return
                            lookup%values(at + 1:at + n_forces) = real(phi, real32)
                            at = at + n_forces
                        end do
                    end do
                end do
            end do
        end do

    contains

        subroutine solve_node(face, node)
            integer, intent(in) :: face
            real(wp), intent(in) :: node(3)

            real(wp) :: part, x(3)

            part = max(node(1), least_creepage)
            x = mirror*creepages_at(face, part, node(2), node(3), most_creepage)
            call solve_creep(solver, node_mu, x/linear, phi, status)
            phi = mirror*phi/unit/part
        end subroutine solve_node
    end subroutine fill_set
end module faststrip_command_lookup_wheel_fill
