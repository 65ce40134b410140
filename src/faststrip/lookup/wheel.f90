!> Contacts of a wheel on a rail and their creep forces, looked up in a table: no allocation, and
!> any number of threads on one table.
!>
!> A table has nodes over the wheelset's lateral displacement y, its yaw, and the vertical part of
!> the normal forces. Each contact that there is anywhere has a slot; where it is not, its normal
!> force is 0, and its other numbers are those of the nearest node where it is. So a contact comes
!> and goes with its normal force. Its forces over mu N are those of its patch, on faces over x
!> (`faststrip_lookup_faces`), each once for the patch as it is and once for its mirror image: what
!> a patch that is not symmetric does with x1 < 0 < x3 is what its mirror image does with x1 > 0.
!>
!> Along y, yaw and load the contacts' numbers are interpolated by the order asked for, z over the
!> load to the power 2/3, Phi always linearly; along the creepages Phi by the order.
module faststrip_lookup_wheel
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_size, most_halvings
    use faststrip_base_status, only: status_t, set_status, number_text, st_ok, &
                                     st_bad_argument, st_not_finite, st_out_of_range
    use faststrip_lookup_axis, only: lookup_axis_t, stencil_t, linear_stencil, cubic_stencil
    use faststrip_lookup_faces, only: faces_cell_t, find_faces_cell, sum_faces, finish_faces, &
                                      n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers, at_load, &
                                      at_height, at_area, at_length, at_creep, at_spin, rise_power
    implicit none
    private

    public :: look_up_contacts, look_up_wheel, load_at_height, contacts_change, is_in_table
    public :: n_wheel_place, n_wheel_state

    !> Numbers of a place: y (mm), yaw (rad), load (N). Of a state: those, mu, cksi, ceta, cphi
    !> (rad/mm).
    !> Given: what contacts and forces depend on.
    integer, parameter :: n_wheel_place = 3, n_wheel_state = 7

    ! Tuned [N]: no contact below. Origin: safeguard: nothing is divided by less.
    real(wp), parameter :: least_load = 1.0e-6_wp
    ! Powers of N that numbers grow with, as the table's are over them: area, pmax, the lengths.
    ! Given: Hertz' law.
    real(wp), parameter :: powers(at_area:n_contact_numbers) = &
        [2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 3.0_wp]/3.0_wp

    ! Tuned [1]: of the load, how near a height is met. Origin: chosen: some hundred roundings.
    real(wp), parameter :: near_load = 1.0e-13_wp

    ! Nodes about a place: four along each axis.
    integer, parameter :: most_about = 4**n_wheel_place

    !> The nodes about a place.
    type :: place_cell_t
        integer :: n                             ! how many
        integer :: node(most_about)              ! which ones
        real(wp) :: w(0:n_wheel_place, most_about) ! weights in a value, in slopes by y, yaw, load
    end type place_cell_t

contains

    !> The contacts of the wheel at a place.
    pure subroutine look_up_contacts(lookup, order, place, contacts, status, slopes)
        type(lookup_t), intent(in) :: lookup           !! of `open_lookup`, of a wheel
        integer, intent(in) :: order                   !! `lookup_linear` or `lookup_cubic`
        real(wp), intent(in) :: place(n_wheel_place)   !! y, yaw, load
        real(wp), intent(out) :: contacts(:, :)
            !! numbers as `n_contact_numbers` says, slots (`lookup%wheel%slots` or more); all 0
            !! where there is no contact
        type(status_t), intent(inout) :: status
            !! `st_bad_argument` (no table of a wheel, order, too few slots), `st_not_finite`,
            !! `st_out_of_range` (y, yaw, load)
        real(wp), intent(out), optional :: slopes(:, :, :)
            !! derivatives, numbers, slots, by y, yaw, load

        type(place_cell_t) :: cell, rising
        real(wp) :: numbers(n_contact_numbers, 0:n_wheel_place)
        integer :: slot, k

        status%code = st_ok
        contacts = 0.0_wp
        if (present(slopes)) slopes = 0.0_wp
        call check_place(lookup, order, place, status)
        if (status%code /= st_ok) return
        if (size(contacts, 2) < lookup%wheel%slots .or. size(contacts, 1) /= n_contact_numbers) then
            call set_status(status, st_bad_argument, 'too little capacity for the contacts')
            return
        end if
        call find_place(lookup, order, place, cell)
        call find_place(lookup, order, place, rising, lookup%wheel%rise)
        do slot = 1, lookup%wheel%slots
            call sum_numbers(lookup, cell, slot, 1, n_contact_numbers, numbers)
            if (numbers(at_load, 0) < least_load) cycle
            call sum_numbers(lookup, rising, slot, at_height, at_height, numbers)
            call restore_powers(numbers)
            contacts(:, slot) = numbers(:, 0)
            if (.not. present(slopes)) cycle
            do k = 1, n_wheel_place
                slopes(:, slot, k) = numbers(:, k)
            end do
        end do
    end subroutine look_up_contacts

    !> Creep forces of one contact.
    pure subroutine look_up_wheel(lookup, order, slot, state, forces, status, jacobian)
        type(lookup_t), intent(in) :: lookup           !! of `open_lookup`, of a wheel
        integer, intent(in) :: order                   !! `lookup_linear` or `lookup_cubic`
        integer, intent(in) :: slot                    !! which contact
        real(wp), intent(in) :: state(n_wheel_state)   !! y, yaw, load, mu, cksi, ceta, cphi
        real(wp), intent(out) :: forces(n_forces)
            !! Fx, Fy on the rail in the contact's frame, N; Mz, N mm; 0 where there is no contact
        type(status_t), intent(inout) :: status
            !! as of `look_up_contacts`; `st_bad_argument`: mu not above 0, no such slot
        real(wp), intent(out), optional :: jacobian(n_forces, n_wheel_state)
            !! derivatives of the forces by the numbers of the state

        type(place_cell_t) :: place
        type(faces_cell_t) :: cell
        real(wp) :: numbers(n_contact_numbers, 0:n_wheel_place), linear(3), x(3), phi(3, 4), f(3)
        real(wp) :: by_creepage(3, 3), by_place(3, n_wheel_place), root

        status%code = st_ok
        forces = 0.0_wp
        if (present(jacobian)) jacobian = 0.0_wp
        call check_place(lookup, order, state(:n_wheel_place), status)
        if (status%code == st_ok) call check_motion(lookup, slot, state, status)
        if (status%code /= st_ok) return
        call find_place(lookup, order, state(:n_wheel_place), place)
        call sum_numbers(lookup, place, slot, at_load, at_load, numbers)
        if (numbers(at_load, 0) < least_load) return
        call sum_numbers(lookup, place, slot, at_length, n_contact_numbers, numbers)
        root = numbers(at_load, 0)**(1.0_wp/3.0_wp)
        linear = numbers(at_creep:at_spin, 0)*(lookup%wheel%shear/state(4))
        linear(:2) = linear(:2)/root
        x = min(max(linear*state(5:7), -largest_size), largest_size)
        call find_faces_cell(lookup%q, lookup%ratio, order, x, cell)
        if (order == lookup_cubic) call find_place(lookup, lookup_linear, state(:n_wheel_place), &
                                                   place)
        call sum_places(lookup, place, slot, cell, phi, by_place)
        call finish_faces(cell, phi, by_place, f, by_creepage)
        associate (force => state(4)*numbers(at_load, 0), &
                   c => numbers(at_length, 0)*root)
            forces = [force, force, force*c]*f
            if (.not. present(jacobian)) return
            call find_jacobian(state, numbers, linear, x, f, by_creepage, by_place, c, jacobian)
        end associate
    end subroutine look_up_wheel

    !> The vertical part of the normal forces of a wheel at a height.
    pure subroutine load_at_height(lookup, order, y, yaw, z, load, is_there)
        type(lookup_t), intent(in) :: lookup !! of `open_lookup`, of a wheel
        integer, intent(in) :: order         !! `lookup_linear` or `lookup_cubic`
        real(wp), intent(in) :: y, yaw       !! of the wheelset, mm, rad
        real(wp), intent(in) :: z            !! of its centre, mm
        real(wp), intent(out) :: load        !! N; 0 if it is not there
        logical, intent(out) :: is_there     !! are y, yaw and this load within the table?

        type(stencil_t) :: in_y, in_yaw, in_rise
        real(wp) :: low, high, miss, rise, heights(4)
        integer :: width(n_wheel_place), first, last, k, i

        load = 0.0_wp
        associate (wheel => lookup%wheel, axis => lookup%wheel%rise)
            is_there = is_within(wheel%y, y) .and. is_within(wheel%yaw, yaw)
            if (.not. is_there) return
            call find_along(wheel%y, order, y, in_y, width(1))
            call find_along(wheel%yaw, order, yaw, in_yaw, width(2))
            first = 1
            last = axis%n
            is_there = height_of(first) <= z .and. z <= height_of(last)
            if (.not. is_there) return
            do while (last - first > 1)
                k = (first + last)/2
                if (height_of(k) <= z) then
                    first = k
                else
                    last = k
                end if
            end do
            low = axis%x(first)
            high = axis%x(last)
            rise = 0.5_wp*(low + high)
            call find_along(axis, order, rise, in_rise, width(3))
            do k = 1, width(3)
                heights(k) = height_of(in_rise%first + k - 1)
            end do
            do i = 1, most_halvings
                miss = dot_product(in_rise%w(:width(3)), heights(:width(3))) - z
                if (miss > 0.0_wp) then
                    high = rise
                else
                    low = rise
                end if
                miss = miss/dot_product(in_rise%dw(:width(3)), heights(:width(3)))
                rise = rise - miss
                ! A step that leads out of the bracket, or nowhere.
                if (.not. (rise >= low .and. rise <= high)) rise = 0.5_wp*(low + high)
                if (abs(miss) <= near_load*rise .or. high - low <= near_load*rise) exit
                call find_along(axis, order, min(rise, axis%x(last)), in_rise, width(3))
            end do
            load = min(max(rise**(1.0_wp/rise_power), wheel%load%x(1)), wheel%load%x(wheel%load%n))
        end associate

    contains

        ! Height at a node of the load. All slots have it.
        pure real(wp) function height_of(k) result(height)
            integer, intent(in) :: k

            integer :: j, row

            height = 0.0_wp
            do j = 1, width(2)
                row = lookup%wheel%y%n*(in_yaw%first + j - 2 + lookup%wheel%yaw%n*(k - 1)) &
                      + in_y%first
                height = height + in_yaw%w(j)*dot_product(in_y%w(:width(1)), &
                         lookup%wheel%contacts(at_height, 1, row:row + width(1) - 1))
            end do
        end function height_of
    end subroutine load_at_height

    !> Does a contact come or go within the cell of the place?
    pure logical function contacts_change(lookup, place) result(change)
        type(lookup_t), intent(in) :: lookup         !! of a wheel
        real(wp), intent(in) :: place(n_wheel_place) !! y, yaw, load, within the table

        type(place_cell_t) :: cell
        integer :: slot, there

        call find_place(lookup, lookup_linear, place, cell)
        change = .false.
        do slot = 1, lookup%wheel%slots
            there = count(lookup%wheel%contacts(at_load, slot, cell%node(:cell%n)) > 0.0_wp)
            change = change .or. (there > 0 .and. there < cell%n)
        end do
    end function contacts_change

    !> Is a place within the ends of a table?
    pure logical function is_in_table(lookup, place)
        type(lookup_t), intent(in) :: lookup         !! of a wheel
        real(wp), intent(in) :: place(n_wheel_place) !! y, yaw, load

        is_in_table = is_within(lookup%wheel%y, place(1)) .and. &
                      is_within(lookup%wheel%yaw, place(2)) .and. &
                      is_within(lookup%wheel%load, place(3))
    end function is_in_table

    !> The nodes about a place, which is within the table.
    pure subroutine find_place(lookup, order, place, cell, rise)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        real(wp), intent(in) :: place(n_wheel_place)
        type(place_cell_t), intent(inout) :: cell
        type(lookup_axis_t), intent(in), optional :: rise ! in the place of that of the load

        type(stencil_t) :: in_y, in_yaw, in_load
        real(wp) :: both, by_yaw, by_load
        integer :: i, j, k, row, width(n_wheel_place)

        call find_along(lookup%wheel%y, order, place(1), in_y, width(1))
        call find_along(lookup%wheel%yaw, order, place(2), in_yaw, width(2))
        if (present(rise)) then
            call find_along(rise, order, rise_of(lookup, place(3)), in_load, width(3))
            in_load%dw = in_load%dw*rise_power*rise_of(lookup, place(3))/place(3)
        else
            call find_along(lookup%wheel%load, order, place(3), in_load, width(3))
        end if
        cell%n = 0
        do k = 1, width(3)
            do j = 1, width(2)
                row = lookup%wheel%y%n*((in_yaw%first + j - 2) &
                                        + lookup%wheel%yaw%n*(in_load%first + k - 2)) &
                      + in_y%first - 1
                both = in_yaw%w(j)*in_load%w(k)
                by_yaw = in_yaw%dw(j)*in_load%w(k)
                by_load = in_yaw%w(j)*in_load%dw(k)
                do i = 1, width(1)
                    cell%n = cell%n + 1
                    cell%node(cell%n) = row + i
                    cell%w(0, cell%n) = in_y%w(i)*both
                    cell%w(1, cell%n) = in_y%dw(i)*both
                    cell%w(2, cell%n) = in_y%w(i)*by_yaw
                    cell%w(3, cell%n) = in_y%w(i)*by_load
                end do
            end do
        end do
    end subroutine find_place

    !> The load to the power that z grows with, within its axis.
    pure real(wp) function rise_of(lookup, load)
        type(lookup_t), intent(in) :: lookup
        real(wp), intent(in) :: load

        associate (rise => lookup%wheel%rise)
            rise_of = min(max(load**rise_power, rise%x(1)), rise%x(rise%n))
        end associate
    end function rise_of

    !> Weights of nodes along one axis, and how many.
    pure subroutine find_along(axis, order, x, stencil, width)
        type(lookup_axis_t), intent(in) :: axis
        integer, intent(in) :: order
        real(wp), intent(in) :: x
        type(stencil_t), intent(inout) :: stencil
        integer, intent(out) :: width

        if (axis%n == 1) then
            width = 1
            stencil%first = 1
            stencil%w(1) = 1.0_wp
            stencil%dw(1) = 0.0_wp
        else if (order == lookup_linear) then
            width = 2
            call linear_stencil(axis, x, stencil)
        else
            width = 4
            call cubic_stencil(axis, x, stencil)
        end if
    end subroutine find_along

    !> Numbers of a contact, as the table has them, and their derivatives.
    pure subroutine sum_numbers(lookup, cell, slot, first, last, numbers)
        type(lookup_t), intent(in) :: lookup
        type(place_cell_t), intent(in) :: cell
        integer, intent(in) :: slot, first, last
        real(wp), intent(inout) :: numbers(n_contact_numbers, 0:n_wheel_place)

        real(wp) :: sums(0:n_wheel_place)
        integer :: i, j

        do j = first, last
            sums = 0.0_wp
            do i = 1, cell%n
                sums = sums + cell%w(:, i)*lookup%wheel%contacts(j, slot, cell%node(i))
            end do
            numbers(j, :) = sums
        end do
    end subroutine sum_numbers

    !> Phi with its derivatives by q, s, t, and Phi's by y, yaw, load.
    pure subroutine sum_places(lookup, place, slot, cell, phi, by_place)
        type(lookup_t), intent(in) :: lookup
        type(place_cell_t), intent(in) :: place ! of the linear order
        integer, intent(in) :: slot
        type(faces_cell_t), intent(in) :: cell
        real(wp), intent(out) :: phi(3, 4), by_place(3, n_wheel_place)

        integer :: sets(most_about), mirrored, i

        mirrored = 0
        if (cell%sign_of(1)*cell%sign_of(3) < 0.0_wp) mirrored = 1
        do i = 1, place%n
            sets(i) = 2*lookup%wheel%set(slot, place%node(i)) - 1 + mirrored
        end do
        call sum_faces(lookup%values, sets(:place%n), place%w(:, :place%n), lookup%q%n, &
                       lookup%ratio%n, cell, phi, by_place)
    end subroutine sum_places

    !> Numbers of a contact from those of a table: times their powers of N.
    pure subroutine restore_powers(numbers)
        real(wp), intent(inout) :: numbers(n_contact_numbers, 0:n_wheel_place)

        real(wp) :: root, grown
        integer :: i, k

        root = numbers(at_load, 0)**(1.0_wp/3.0_wp)
        do i = at_area, n_contact_numbers
            grown = root**nint(3.0_wp*powers(i))
            do k = 1, n_wheel_place
                numbers(i, k) = grown*(numbers(i, k) + powers(i)*numbers(i, 0) &
                                       *numbers(at_load, k)/numbers(at_load, 0))
            end do
            numbers(i, 0) = grown*numbers(i, 0)
        end do
    end subroutine restore_powers

    !> Derivatives of the forces by the state.
    pure subroutine find_jacobian(state, numbers, linear, x, f, by_creepage, by_place, c, jacobian)
        real(wp), intent(in) :: state(n_wheel_state)
        real(wp), intent(in) :: numbers(n_contact_numbers, 0:n_wheel_place) ! those of the table
        real(wp), intent(in) :: linear(3), x(3), f(3), by_creepage(3, 3)
        real(wp), intent(in) :: by_place(3, n_wheel_place), c
        real(wp), intent(out) :: jacobian(n_forces, n_wheel_state)

        ! Creepages over mu N go with N to this power.
        real(wp), parameter :: of_creepage(3) = [-1.0_wp, -1.0_wp, 0.0_wp]/3.0_wp
        real(wp) :: unit(3), load, load_slope, x_slope(3)
        integer :: k

        load = numbers(at_load, 0)
        unit = [1.0_wp, 1.0_wp, c]
        do k = 1, n_wheel_place
            load_slope = numbers(at_load, k)
            x_slope = x*(load*numbers(at_creep:at_spin, k)/numbers(at_creep:at_spin, 0) &
                         + of_creepage*load_slope)
            jacobian(:, k) = load_slope*f + times(by_creepage, x_slope) + load*by_place(:, k)
            jacobian(3, k) = jacobian(3, k) + f(3)*(load*numbers(at_length, k) &
                                                    /numbers(at_length, 0) + load_slope/3.0_wp)
            jacobian(:, k) = state(4)*unit*jacobian(:, k)
        end do
        jacobian(:, 4) = unit*load*(f - times(by_creepage, x))
        do k = 1, 3
            jacobian(:, 4 + k) = state(4)*load*unit*by_creepage(:, k)*linear(k)
        end do
    end subroutine find_jacobian

    !> Matrix times vector.
    pure function times(matrix, vector) result(product)
        real(wp), intent(in) :: matrix(3, 3), vector(3)
        real(wp) :: product(3)

        product = matrix(:, 1)*vector(1) + matrix(:, 2)*vector(2) + matrix(:, 3)*vector(3)
    end function times

    !> Refuse what is no table of a wheel, no order, and a place beyond the table.
    pure subroutine check_place(lookup, order, place, status)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        real(wp), intent(in) :: place(n_wheel_place)
        type(status_t), intent(inout) :: status

        if (lookup%kind /= lookup_kind_wheel) then
            call set_status(status, st_bad_argument, 'no lookup table of a wheel on a rail')
        else if (order /= lookup_linear .and. order /= lookup_cubic) then
            call set_status(status, st_bad_argument, 'the order of interpolation must be 1 or 3')
        else if (.not. all(ieee_is_finite(place))) then
            call set_status(status, st_not_finite, 'a number of the state is not finite')
        else
            call check_along(lookup%wheel%y, 'y', place(1), status)
            call check_along(lookup%wheel%yaw, 'yaw', place(2), status)
            call check_along(lookup%wheel%load, 'the load', place(3), status)
        end if
    end subroutine check_place

    pure subroutine check_along(axis, name, x, status)
        type(lookup_axis_t), intent(in) :: axis
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: x
        type(status_t), intent(inout) :: status

        if (status%code /= st_ok) return
        if (is_within(axis, x)) return
        call set_status(status, st_out_of_range, name // ' must be within the table, ' // &
                        trim(number_text(axis%x(1))) // ' to ' // &
                        trim(number_text(axis%x(axis%n))) // ', got ' // number_text(x))
    end subroutine check_along

    pure logical function is_within(axis, x)
        type(lookup_axis_t), intent(in) :: axis
        real(wp), intent(in) :: x

        is_within = x >= axis%x(1) .and. x <= axis%x(axis%n)
    end function is_within

    !> Refuse a slot, friction and creepages that are none.
    pure subroutine check_motion(lookup, slot, state, status)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: slot
        real(wp), intent(in) :: state(n_wheel_state)
        type(status_t), intent(inout) :: status

        if (slot < 1 .or. slot > lookup%wheel%slots) then
            call set_status(status, st_bad_argument, 'no such contact in the lookup table')
        else if (.not. all(ieee_is_finite(state(4:)))) then
            call set_status(status, st_not_finite, 'a number of the state is not finite')
        else if (.not. state(4) > 0.0_wp) then
            call set_status(status, st_bad_argument, 'mu must be above 0, got ' // &
                            number_text(state(4)))
        end if
    end subroutine check_motion
end module faststrip_lookup_wheel
