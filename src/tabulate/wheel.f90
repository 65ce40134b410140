!> Lookup tables of a wheel on a rail: the contacts over y, yaw and load, and creep forces of each
!> over three normalised creepages.
!>
!> A fresh state has one set of creepages for all contacts of the wheel, as a vehicle would give
!> them. What is compared are sums over the contacts, so no contact of the table has to be told
!> which one of the solution it is: creep forces ahead, and across the normal, as a vector in the
!> track; their moment about the normals with that of the forces ahead about the mean place of
!> contact; and the lateral part of the normal forces, which shows how well contacts are placed.
!> With them the height z of the wheelset, from which a vehicle has the load: its error counts as
!> that of the load which it makes.
module faststrip_tabulate_wheel
    use, intrinsic :: iso_fortran_env, only: int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_status, only: status_t, is_error, clear_status, status_word, st_ok, &
                                     first_error
    use faststrip_base_text, only: integer_text
    use faststrip_contact_methods, only: tangential_none
    use faststrip_lookup_axis, only: lookup_axis_t, stencil_t, make_axis, linear_stencil, &
                                     cubic_stencil, least_nodes
    use faststrip_lookup_faces, only: n_forces, n_faces, creepages_at, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers, &
                                      n_wheel_errors, most_slots, at_load, at_angle, at_rail_y, &
                                      at_height, at_area, at_pmax, at_length, at_creep, at_spin, &
                                      rise_power, set_rise
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, contacts_change, &
                                      n_wheel_place, n_wheel_state
    use faststrip_tabulate_contacts, only: wheel_solver_t, found_contacts_t, make_wheel_solver, &
                                           release_wheel_solver, solve_place, solve_creep
    use faststrip_tabulate_family, only: family_t, sampled_axis_t, judged_t, note_failure, &
                                         keep_quiet, states_changing
    use faststrip_tabulate_forces, only: choice_t
    use faststrip_tabulate_hertz, only: hertz_family_t, make_hertz_family, release_hertz_family, &
                                        first_share, least_creepage, most_creepage
    use faststrip_tabulate_parts, only: forget_values
    use faststrip_tabulate_points, only: scattered_point
    use faststrip_tabulate_slots, only: find_slots, neighbour_of, n_directions
    use faststrip_tabulate_states, only: drawn_creepages
    use faststrip_wheelset_types, only: wheelset_model_t, most_contacts
    implicit none
    private

    public :: wheel_family_t, wheel_limits_t, make_wheel_family, release_wheel_family

    ! Axes: first those of creepages, as of ellipses, then those of places.
    ! Given: their order in a table.
    integer, parameter :: n_face_axes = 2, axis_y = 3, axis_load = 5, n_axes = 5
    ! Sums over the contacts of a wheel: ahead; across, along y and z of the track; moment; lateral
    ! part of the normal forces; and the height z.
    ! Given: what is compared.
    integer, parameter :: n_sums = 6
    ! Behind them in samples: the mean place of contact; the length over which errors of z count.
    ! Given: places in arrays.
    integer, parameter :: at_middle = n_sums + 1, at_stretch = n_sums + 2
    ! Tuned [places]: of the other coordinates, and creepages at each. Origin: cost.
    integer, parameter :: n_lines = 8, n_creepages = 6
    ! Tuned [nodes]: of y, yaw, load to begin with. Origin: chosen.
    integer, parameter :: first_nodes(n_wheel_place) = [13, 4, 4]
    ! Tuned [mm/N**(1/3)]: length c of a usual contact. Origin: 5.5 mm under 80 kN.
    real(wp), parameter :: usual_length = 0.128_wp
    ! Tuned [1]: Kalker's coefficient of one. Origin: usual.
    real(wp), parameter :: usual_stiffness = 4.2_wp
    ! Tuned [1]: a/b, logarithms, of the ellipses that the axes of creepages are refined on. Origin:
    ! usual contacts.
    real(wp), parameter :: usual_shapes(2) = [-1.0_wp, 1.5_wp]
    ! Tuned [1]: Part of the error asked for that each axis of a place may make to begin with.
    ! Origin: measured on S1002 on 60E1.
    real(wp), parameter :: share_of_places = 0.8_wp
    ! Tuned [1]: The least part of the creepages. Origin: cost: where contacts jump no nodes help.
    real(wp), parameter :: least_share = 0.25_wp
    ! Friction of the contacts that are solved. It does not matter.
    ! Given: a usual one.
    real(wp), parameter :: node_mu = 0.3_wp
    ! Tuned [points]: places drawn for one in a cell where contacts come or go. Origin: cost.
    integer, parameter :: most_draws = 400

    !> What is asked of the axes of places.
    type :: wheel_limits_t
        real(wp) :: ends(2, n_wheel_place) = 0.0_wp  !! first and last y (mm), yaw (rad), load (N)
        real(wp) :: least(n_wheel_place) = 0.0_wp    !! the least cells, in their units
    end type wheel_limits_t

    ! Where the faces of a table come from.
    type :: set_source_t
        integer :: node = 0     ! place
        integer :: contact = 0  ! of it
    end type set_source_t

    type :: solver_place_t
        type(wheel_solver_t), pointer :: at => null()
    end type solver_place_t

    !> The family.
    type, extends(family_t) :: wheel_family_t
        type(wheel_limits_t) :: limits
        type(wheelset_model_t), private :: model
        type(hertz_family_t), private :: ellipses !! on which axes of creepages are refined
        real(wp), private :: shear = 0.0_wp       !! combined modulus, MPa
        type(set_source_t), allocatable, private :: sources(:)
        type(solver_place_t), allocatable, private :: solver(:)
    contains
        procedure :: start => start_wheel
        procedure :: sample => sample_wheel
        procedure :: cell_error => error_of_cell
        procedure :: nodes => nodes_of_wheel
        procedure :: begin => begin_wheel
        procedure :: jobs => jobs_of_set
        procedure :: solve => solve_set
        procedure :: draw => draw_wheel
        procedure :: judge => judge_wheel
        procedure :: look_up => look_up_state
        procedure :: keep => keep_errors
        procedure :: describe => describe_wheel
    end type wheel_family_t

contains

    !> Make the family ready to solve.
    subroutine make_wheel_family(model, choice, threads, limits, family, status)
        type(wheelset_model_t), intent(in) :: model       !! made; its right wheel counts
        type(choice_t), intent(in) :: choice              !! how forces are solved, checked
        integer, intent(in) :: threads                    !! that solve, >= 1
        type(wheel_limits_t), intent(in) :: limits        !! of the axes that are refined
        type(wheel_family_t), intent(inout) :: family     !! for `release_wheel_family`; quiet
        type(status_t), intent(out) :: status             !! of the library

        integer :: i

        call keep_quiet(family)
        family%choice = choice
        family%threads = threads
        family%limits = limits
        family%model = model
        family%model%case%methods%tangential = tangential_none
        family%model%case%estimate = .false.
        family%shear = combined_shear_modulus(model%case%material)
        family%choice%nu = combined_poisson_ratio(model%case%material)
        family%n_axes = n_axes
        family%n_face_axes = n_face_axes
        family%n_numbers = n_wheel_state
        family%n_sums = n_sums
        family%n_errors = n_wheel_errors
        family%n_kinds = 2
        family%shares = [first_share, share_of_places]
        family%least_share = least_share
        call make_hertz_family(family%choice, threads, usual_shapes, family%ellipses, status)
        if (is_error(status)) return
        allocate (family%solver(threads))
        do i = 1, threads
            allocate (family%solver(i)%at)
            call make_wheel_solver(family%model, family%solver(i)%at, status)
            if (is_error(status)) return
        end do
    end subroutine make_wheel_family

    !> Give back what the family has.
    subroutine release_wheel_family(family)
        type(wheel_family_t), intent(inout) :: family !! serves no more

        integer :: i

        call release_hertz_family(family%ellipses)
        if (.not. allocated(family%solver)) return
        do i = 1, size(family%solver)
            if (.not. associated(family%solver(i)%at)) cycle
            call release_wheel_solver(family%solver(i)%at)
            deallocate (family%solver(i)%at)
        end do
        deallocate (family%solver)
    end subroutine release_wheel_family

    !> Coarse axes. Samples of yaw and load lie in any of the cells of y, so most of them where
    !> contacts come and go.
    subroutine start_wheel(self, axis, axes)
        class(wheel_family_t), intent(in) :: self   !! its limits
        type(sampled_axis_t), intent(inout) :: axis !! with its number; gets places and layout
        type(sampled_axis_t), intent(in) :: axes(:) !! that of y is refined for the ones behind it

        integer :: along, i, n

        if (axis%kind <= n_face_axes) then
            call self%ellipses%start(axis, axes)
            return
        end if
        along = axis%kind - n_face_axes
        axis%values = at_stretch
        axis%samples = n_lines*n_creepages
        axis%jobs = n_lines
        axis%least = self%limits%least(along)
        if (axis%kind > axis_y) axis%cells = axes(axis_y)%x(1::2)
        associate (first => self%limits%ends(1, along), last => self%limits%ends(2, along))
            if (.not. last > first) then
                axis%x = [first]
                return
            end if
            n = first_nodes(along)
            allocate (axis%x(2*n - 1))
            do i = 1, n
                axis%x(2*i - 1) = first + (last - first)*real(i - 1, wp)/(n - 1)
                if (axis%kind == axis_load) &
                    axis%x(2*i - 1) = first*(last/first)**(real(i - 1, wp)/(n - 1))
            end do
            axis%x(2*n - 1) = last
        end associate
        axis%x(2::2) = 0.5_wp*(axis%x(1:2*n - 3:2) + axis%x(3::2))
    end subroutine start_wheel

    !> Sums over mu times the load, and its length, for all creepages of a line, at a place.
    subroutine sample_wheel(self, me, axis, place, job, status)
        class(wheel_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        type(sampled_axis_t), intent(inout) :: axis  !! gets the samples
        integer, intent(in) :: place                 !! of the axis
        integer, intent(in) :: job                   !! number of the line
        type(status_t), intent(out) :: status        !! of the place, which is named; of the method

        type(found_contacts_t) :: found
        real(wp) :: u(n_wheel_place), at(n_wheel_place), sums(n_sums), creepages(3), c, load, middle
        real(wp) :: forces(n_forces, n_creepages, most_contacts)
        integer :: k, j, along

        if (axis%kind <= n_face_axes) then
            call self%ellipses%sample(me, axis, place, job, status)
            return
        end if
        along = axis%kind - n_face_axes
        associate (ends => self%limits%ends)
            u = scattered_point(job, along, n_wheel_place)
            at = ends(1, :) + u*(ends(2, :) - ends(1, :))
            if (allocated(axis%cells)) at(1) = in_a_cell(axis%cells, u(1))
            at(along) = axis%x(place)
            ! Creepages as of a contact of usual size under the load in the middle of the axis.
            load = sqrt(product(ends(:, 3)))
        end associate
        call solve_place(self%model, self%solver(me)%at, self%choice%nu, at, found, status)
        if (is_error(status)) return
        c = usual_length*load**(1.0_wp/3.0_wp)
        do k = 1, found%n
            do j = 1, n_creepages
                creepages = drawn_creepages(scattered_point(n_creepages*job + j, along, 4))
                creepages = creepages*node_mu*load/(usual_stiffness*self%shear*c**2) &
                            *[1.0_wp, 1.0_wp, 1.0_wp/c]
                call solve_creep(self%choice, self%solver(me)%at, k, node_mu, creepages, &
                                 forces(:, j, k), status)
                if (is_error(status)) return
            end do
        end do
        associate (numbers => found%numbers(:, :found%n))
            middle = sum(numbers(at_load, :)*numbers(at_rail_y, :))/(c*sum(numbers(at_load, :)))
            do j = 1, n_creepages
                call sums_of(numbers, forces(:, j, :found%n), 0.0_wp, sums)
                sums(:n_sums - 1) = sums(:n_sums - 1) &
                                    /(at(3)*[node_mu, node_mu, node_mu, node_mu*c, 1.0_wp])
                axis%f(:, n_creepages*(job - 1) + j, place) = [sums, middle, found%length]
            end do
        end associate
    end subroutine sample_wheel

    !> What interpolation misses in the middle of a cell, on the worst line: linear one, but for z,
    !> which a look-up has by the order asked for.
    pure function error_of_cell(self, axis, middle) result(error)
        class(wheel_family_t), intent(in) :: self !! with its ellipses
        type(sampled_axis_t), intent(in) :: axis  !! sampled
        integer, intent(in) :: middle             !! place
        real(wp) :: error

        real(wp) :: miss(n_sums, n_lines*n_creepages), x(size(axis%x))
        integer :: line, k, first, last

        if (axis%kind <= n_face_axes) then
            error = self%ellipses%cell_error(axis, middle)
            return
        end if
        associate (f => axis%f(:n_sums, :, :), place => axis%f(at_middle, :, middle))
            miss = f(:, :, middle) - 0.5_wp*(f(:, :, middle - 1) + f(:, :, middle + 1))
            x = axis%x
            if (axis%kind == axis_load) x = x**rise_power
            miss(n_sums, :) = (f(n_sums, :, middle) - height_between(self%order, x, &
                               f(n_sums, :, :), middle))/axis%f(at_stretch, :, middle)
            error = 0.0_wp
            do line = 1, n_lines
                first = 1 + n_creepages*(line - 1)
                last = first + n_creepages - 1
                ! Moments are about the rail's origin: those about the mean place of contact.
                miss(4, first:last) = miss(4, first:last) + place(first)*miss(1, first:last)
                do k = 1, n_sums
                    error = max(error, sqrt(sum(miss(k, first:last)**2)/n_creepages))
                end do
            end do
        end associate
    end function error_of_cell

    ! z in a cell, by the four nodes about it.
    pure function height_between(order, x, z, middle) result(there)
        integer, intent(in) :: order    ! of interpolation
        real(wp), intent(in) :: x(:)    ! places: nodes are 1, 3, 5, ...
        real(wp), intent(in) :: z(:, :) ! samples, places
        integer, intent(in) :: middle   ! place in the cell
        real(wp) :: there(size(z, 1))

        type(lookup_axis_t) :: nodes
        type(stencil_t) :: stencil
        integer :: first, last

        first = min(max(middle - 3, 1), size(x) - 2*(least_nodes - 1))
        last = first + 2*(least_nodes - 1)
        call make_axis(x(first:last:2), nodes)
        if (order == lookup_cubic) then
            call cubic_stencil(nodes, x(middle), stencil)
        else
            call linear_stencil(nodes, x(middle), stencil)
            stencil%w = eoshift(stencil%w, 1 - stencil%first)
        end if
        there = matmul(z(:, first:last:2), stencil%w)
    end function height_between

    !> Nodes of a table, as if each place had one contact.
    pure function nodes_of_wheel(self, axes) result(nodes)
        class(wheel_family_t), intent(in) :: self  !! does not matter
        type(lookup_axis_t), intent(in) :: axes(:) !! of q, the ratios, y, yaw, load
        real(wp) :: nodes

        nodes = 2.0_wp*n_faces*axes(1)%n*real(axes(2)%n, wp)**2*product(real(axes(axis_y:)%n, wp))
    end function nodes_of_wheel

    !> A table of which the contacts are there.
    subroutine begin_wheel(self, axes, lookup, status)
        class(wheel_family_t), intent(inout) :: self !! with its solvers; knows where faces are from
        type(lookup_axis_t), intent(in) :: axes(:)   !! q, ratio, y, yaw, load
        type(lookup_t), intent(out) :: lookup        !! to be filled
        type(status_t), intent(out) :: status
            !! of the first place that fails, which is named; too many contacts

        type(found_contacts_t), allocatable :: found(:)
        character(len=:), allocatable :: limited
        integer, allocatable :: slot_of(:, :)
        integer :: sizes(n_wheel_place)

        lookup%kind = lookup_kind_wheel
        lookup%q = axes(1)
        lookup%ratio = axes(2)
        lookup%nu = self%choice%nu
        associate (wheel => lookup%wheel)
            wheel%y = axes(axis_y)
            wheel%yaw = axes(axis_y + 1)
            wheel%load = axes(axis_load)
            call set_rise(wheel)
            wheel%shear = self%shear
            sizes = [wheel%y%n, wheel%yaw%n, wheel%load%n]
        end associate
        allocate (found(product(sizes)))
        call solve_places(self, lookup, found, status)
        if (is_error(status)) return
        call find_slots(found, sizes, slot_of, lookup%wheel%slots, status)
        if (is_error(status)) return
        if (allocated(self%sources)) deallocate (self%sources)
        call put_contacts(found, slot_of, lookup, self%sources)
        call spread_contacts(sizes, lookup)
        allocate (lookup%values(2_int64*n_forces*n_faces*lookup%q%n*lookup%ratio%n**2 &
                                *lookup%wheel%sets))
        call forget_values(lookup)
        call name_limitations(found, limited)
        lookup%text = self%words
        if (len(limited) > 0) lookup%text = lookup%text // limited // new_line('a')
    end subroutine begin_wheel

    ! The contacts of all nodes.
    subroutine solve_places(self, lookup, found, status)
        class(wheel_family_t), intent(inout) :: self
        type(lookup_t), intent(in) :: lookup
        type(found_contacts_t), intent(inout) :: found(:)
        type(status_t), intent(out) :: status

        type(status_t) :: said
        integer :: i, me, failed

        call clear_status(status)
        failed = size(found) + 1
        !$omp parallel do num_threads(self%threads) schedule(static, 1) default(none) &
        !$omp shared(self, lookup, found, status, failed) private(i, said)
        do me = 1, self%threads
            do i = me, size(found), self%threads
                if (me == 1) call self%progress('places', i - 1, size(found))
                call solve_place(self%model, self%solver(me)%at, self%choice%nu, &
                                 place_of(lookup, i), found(i), said)
                if (.not. is_error(said)) cycle
                call note_failure(i, said, failed, status)
                exit
            end do
        end do
        !$omp end parallel do
    end subroutine solve_places

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

    ! The place of a node.
    pure function place_of(lookup, node) result(place)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: node ! y fastest, then yaw
        real(wp) :: place(n_wheel_place) ! y, yaw, load

        associate (wheel => lookup%wheel)
            place(1) = wheel%y%x(1 + modulo(node - 1, wheel%y%n))
            place(2) = wheel%yaw%x(1 + modulo((node - 1)/wheel%y%n, wheel%yaw%n))
            place(3) = wheel%load%x(1 + (node - 1)/(wheel%y%n*wheel%yaw%n))
        end associate
    end function place_of

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
                ! All contacts of a place have its height, also those that are not there.
                wheel%contacts(at_height, :, node) = found(node)%numbers(at_height, 1)
            end do
        end associate
    end subroutine put_contacts

    ! Where a contact is not, it has the numbers of the nearest node where it is, but no load, and
    ! the height of its own node.
    subroutine spread_contacts(sizes, lookup)
        integer, intent(in) :: sizes(n_wheel_place)
        type(lookup_t), intent(inout) :: lookup

        integer, allocatable :: before(:)
        real(wp) :: height
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
                            height = wheel%contacts(at_height, slot, node)
                            wheel%contacts(:, slot, node) = wheel%contacts(:, slot, next)
                            wheel%contacts(at_load, slot, node) = 0.0_wp
                            wheel%contacts(at_height, slot, node) = height
                            wheel%set(slot, node) = before(next)
                            exit
                        end do
                    end do
                    if (left == 0) exit
                end do
            end do
        end associate
    end subroutine spread_contacts

    !> A contact's faces are solved by one thread.
    pure integer function jobs_of_set(self, lookup) result(jobs)
        class(wheel_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! does not matter

        jobs = 1
    end function jobs_of_set

    !> All creep forces of one contact, and of its mirror image.
    subroutine solve_set(self, me, unit, job, lookup, status)
        class(wheel_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        integer, intent(in) :: unit                  !! set of faces
        integer, intent(in) :: job                   !! there is but one
        type(lookup_t), intent(inout) :: lookup      !! begun; gets the forces
        type(status_t), intent(out) :: status        !! of the place, of the method

        type(found_contacts_t) :: found
        real(wp) :: phi(n_forces), mirror(3), linear(3), length(3)
        integer(int64) :: at
        integer :: side, face, i, j, k

        associate (source => self%sources(unit))
            call solve_place(self%model, self%solver(me)%at, self%choice%nu, &
                             place_of(lookup, source%node), found, status)
            if (is_error(status)) return
            associate (numbers => found%numbers(:, source%contact))
                linear = numbers(at_creep:at_spin)*self%shear/(node_mu*numbers(at_load))
                length = node_mu*numbers(at_load)*[1.0_wp, 1.0_wp, numbers(at_length)]
            end associate
        end associate
        at = (unit - 1)*(size(lookup%values, kind=int64)/lookup%wheel%sets)
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
            call solve_creep(self%choice, self%solver(me)%at, self%sources(unit)%contact, node_mu, &
                             x/linear, phi, status)
            phi = mirror*phi/length/part
        end subroutine solve_node
    end subroutine solve_set

    !> Fresh states over the whole table; or only in cells where contacts come or go, fewer where
    !> there are no such cells.
    subroutine draw_wheel(self, lookup, n, seed, kind, states, status)
        class(wheel_family_t), intent(in) :: self  !! does not matter
        type(lookup_t), intent(in) :: lookup       !! filled
        integer, intent(in) :: n                   !! how many
        integer, intent(in) :: seed                !! which ones
        integer, intent(in) :: kind                !! `states_all` or `states_changing`
        type(judged_t), allocatable, intent(out) :: states(:)
        type(status_t), intent(out) :: status      !! ok

        type(judged_t) :: state
        real(wp) :: point(9)
        integer :: i, drawn
        logical :: where_they_change

        call clear_status(status)
        where_they_change = kind == states_changing
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
            state%state(4) = 1.0_wp - point(4)
            call take_creepages(lookup, point(5:9), state)
            drawn = drawn + 1
            states(drawn) = state
        end do
        states = states(:drawn)
    end subroutine draw_wheel

    ! A place along an axis, evenly along it; or each cell as often as any other one.
    pure real(wp) function place_on(axis, part, by_cells) result(place)
        type(lookup_axis_t), intent(in) :: axis
        real(wp), intent(in) :: part
        logical, intent(in) :: by_cells

        if (axis%n == 1) then
            place = axis%x(1)
        else if (by_cells) then
            place = in_a_cell(axis%x, part)
        else
            place = axis%x(1) + part*(axis%x(axis%n) - axis%x(1))
        end if
        place = min(max(place, axis%x(1)), axis%x(axis%n))
    end function place_on

    ! A place in any cell of an axis, the cells all alike.
    pure real(wp) function in_a_cell(nodes, part) result(place)
        real(wp), intent(in) :: nodes(:) ! rising
        real(wp), intent(in) :: part     ! 0 to below 1

        integer :: cell

        associate (cells => size(nodes) - 1)
            cell = min(1 + int(part*cells), cells)
            place = nodes(cell) + (part*cells - (cell - 1))*(nodes(cell + 1) - nodes(cell))
        end associate
    end function in_a_cell

    ! Creepages of a state, normalised by one of its contacts, which is drawn, too.
    subroutine take_creepages(lookup, point, state)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: point(5)
        type(judged_t), intent(inout) :: state

        type(status_t) :: status
        real(wp) :: contacts(n_contact_numbers, most_slots)
        integer :: slots(most_slots), n, i, slot

        call look_up_contacts(lookup, lookup_linear, state%state(:n_wheel_place), contacts, status)
        state%slot = maxloc(contacts(at_load, :), dim=1)
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

    !> One state, solved and looked up by both orders; it stays unsolved where that is not possible.
    subroutine judge_wheel(self, me, lookup, state, status)
        class(wheel_family_t), intent(inout) :: self !! with its solvers
        integer, intent(in) :: me                    !! number of the thread
        type(lookup_t), intent(in) :: lookup         !! filled
        type(judged_t), intent(inout) :: state       !! drawn; judged
        type(status_t), intent(out) :: status        !! ok

        type(status_t) :: said
        type(found_contacts_t) :: found
        real(wp) :: forces(n_forces, most_slots), contacts(n_contact_numbers, most_slots)
        real(wp) :: middle, loads, c
        integer, parameter :: orders(2) = [lookup_linear, lookup_cubic]
        integer :: order, slot

        call clear_status(status)
        associate (place => state%state(:n_wheel_place), numbers => state%state(:n_wheel_state), &
                   mu => state%state(4))
            call solve_place(self%model, self%solver(me)%at, self%choice%nu, place, found, said)
            if (is_error(said)) return
            call sums_of_found(self, me, found, mu, state%state(5:7), middle, state%sums(:, 0), &
                               said)
            if (is_error(said)) return
            state%n = found%n
            loads = sum(found%numbers(at_load, :found%n))
            c = sum(found%numbers(at_load, :found%n)*found%numbers(at_length, :found%n))/loads
            do order = 1, 2
                call look_up_contacts(lookup, orders(order), place, contacts, said)
                if (is_error(said)) return
                forces = 0.0_wp
                do slot = 1, lookup%wheel%slots
                    call look_up_wheel(lookup, orders(order), slot, numbers, forces(:, slot), said)
                    if (is_error(said)) return
                end do
                call sums_of(contacts, forces, middle, state%sums(:, order))
                associate (miss => state%sums(:, order) - state%sums(:, 0))
                    state%off(:, order) = [abs(miss(1))/(mu*loads), norm2(miss(2:3))/(mu*loads), &
                                           abs(miss(4))/(mu*loads*c), abs(miss(5))/loads, &
                                           abs(miss(6))/found%length]
                end associate
            end do
        end associate
        state%is_solved = .true.
    end subroutine judge_wheel

    ! Sums of a direct solution, about the mean place of its contacts.
    subroutine sums_of_found(self, me, found, mu, creepages, middle, sums, status)
        class(wheel_family_t), intent(inout) :: self
        integer, intent(in) :: me
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
            call solve_creep(self%choice, self%solver(me)%at, i, mu, creepages, forces(:, i), &
                             status)
            if (is_error(status)) return
        end do
        associate (numbers => found%numbers(:, :found%n))
            middle = sum(numbers(at_load, :)*numbers(at_rail_y, :))/sum(numbers(at_load, :))
            call sums_of(numbers, forces(:, :found%n), middle, sums)
        end associate
    end subroutine sums_of_found

    ! Sums over contacts.
    pure subroutine sums_of(contacts, forces, middle, sums)
        real(wp), intent(in) :: contacts(:, :) ! numbers, contacts
        real(wp), intent(in) :: forces(:, :)   ! Fx, Fy, Mz, contacts
        real(wp), intent(in) :: middle         ! y on the rail that the moment is about, mm
        real(wp), intent(out) :: sums(n_sums)  ! N; N mm; mm

        integer :: i

        sums = 0.0_wp
        do i = 1, size(contacts, 2)
            if (.not. contacts(at_load, i) > 0.0_wp) cycle
            associate (c => cos(contacts(at_angle, i)), s => sin(contacts(at_angle, i)), &
                       load => contacts(at_load, i), y => contacts(at_rail_y, i), &
                       fx => forces(1, i), fy => forces(2, i), mz => forces(3, i))
                sums = sums + [fx, fy*c, fy*s, mz*c - (y - middle)*fx, -load*s, 0.0_wp]
            end associate
        end do
        sums(n_sums) = contacts(at_height, maxloc(contacts(at_load, :), dim=1))
    end subroutine sums_of

    !> Look the contact of a state up that carries most, with derivatives.
    subroutine look_up_state(self, lookup, order, state, forces, status)
        class(wheel_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! filled
        integer, intent(in) :: order              !! of interpolation
        type(judged_t), intent(in) :: state       !! drawn
        real(wp), intent(out) :: forces(n_forces) !! N, N mm
        type(status_t), intent(out) :: status     !! of `look_up_wheel`

        real(wp) :: jacobian(n_forces, n_wheel_state)

        call look_up_wheel(lookup, order, state%slot, state%state(:n_wheel_state), forces, status, &
                           jacobian)
    end subroutine look_up_state

    !> Put errors into a table.
    pure subroutine keep_errors(self, errors, tested, lookup)
        class(wheel_family_t), intent(in) :: self  !! does not matter
        real(wp), intent(in) :: errors(:, :, :, :) !! of all states, of those where contacts change
        integer, intent(in) :: tested(:)           !! states
        type(lookup_t), intent(inout) :: lookup    !! filled

        lookup%wheel%errors = errors
        lookup%wheel%n_errors = n_wheel_errors
        lookup%wheel%tested = tested
    end subroutine keep_errors

    !> Nodes in a few words.
    subroutine describe_wheel(self, lookup, text)
        class(wheel_family_t), intent(in) :: self !! does not matter
        type(lookup_t), intent(in) :: lookup      !! begun
        character(len=:), allocatable, intent(out) :: text !! a few words

        text = integer_text(lookup%q%n) // ' x ' // integer_text(lookup%ratio%n) // '^2, y ' &
               // integer_text(lookup%wheel%y%n) // ', yaw ' // integer_text(lookup%wheel%yaw%n) &
               // ', load ' // integer_text(lookup%wheel%load%n) // ', ' &
               // integer_text(lookup%wheel%sets) // ' contacts'
    end subroutine describe_wheel
end module faststrip_tabulate_wheel
