!> Which contacts of neighbouring nodes are the same one: each gets a slot of a lookup table.
!>
!> Contacts of nodes that lie next to each other along y, yaw or load are the same where each is the
!> nearest to the other and not far from it; the nearest are joined first, and never two of one
!> node. Where two contacts become one, one of both goes on. What is joined gets the first slot in
!> which it meets no other contact, at its nodes or next to them.
module faststrip_tabulate_slots
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, st_out_of_range
    use faststrip_base_text, only: integer_text
    use faststrip_tabulate_contacts, only: found_contacts_t
    use faststrip_lookup_table, only: at_load, at_rail_y, at_rail_z, most_slots
    use faststrip_wheelset_types, only: most_contacts
    implicit none
    private

    public :: find_slots, neighbour_of, n_directions

    !> Ways to a neighbouring node: along three axes, both ways.
    !> Given: three axes.
    integer, parameter :: n_directions = 6

    ! Tuned [mm]: how far a contact may move on the rail between two nodes; nearer ones are joined
    ! before. Origin: chosen: about half the width of a patch at most.
    real(wp), parameter :: reaches(6) = [0.1_wp, 0.3_wp, 0.7_wp, 1.5_wp, 3.0_wp, 5.0_wp]

    !> Contacts by number, each a member of a group; the groups' members are chained.
    type :: groups_t
        integer :: n = 0
        integer, allocatable :: first(:)      ! first member of the group of this number
        integer, allocatable :: next(:)       ! next member; 0: none
        integer, allocatable :: group(:)      ! of each contact
        integer, allocatable :: members(:)    ! how many
        real(wp), allocatable :: weight(:)    ! loads of the members
    end type groups_t

contains

    !> The slot of each contact.
    subroutine find_slots(found, sizes, slot_of, n_slots, status)
        type(found_contacts_t), intent(in) :: found(:)      !! of the nodes, y fastest, then yaw
        integer, intent(in) :: sizes(3)                     !! nodes along y, yaw, load
        integer, allocatable, intent(out) :: slot_of(:, :)  !! contacts, nodes; 0: no contact
        integer, intent(out) :: n_slots                     !! that are needed
        type(status_t), intent(out) :: status               !! `st_out_of_range`: too many

        type(groups_t) :: groups
        integer, allocatable :: owner(:, :)
        integer :: left, best, node, i, slot
        logical, allocatable :: is_done(:)

        call clear_status(status)
        call join_contacts(found, sizes, groups)
        allocate (slot_of(most_contacts, size(found)), source=0)
        allocate (owner(most_slots, size(found)), source=0)
        allocate (is_done(size(groups%group)), source=.false.)
        n_slots = 0
        do node = 1, size(found)
            do i = found(node)%n + 1, most_contacts
                is_done(number_of(i, node)) = .true.
            end do
        end do
        do i = 1, size(is_done)
            if (groups%group(i) /= i) is_done(i) = .true.
        end do
        do left = 1, count(.not. is_done)
            best = maxloc(groups%weight, dim=1, mask=.not. is_done)
            is_done(best) = .true.
            do slot = 1, most_slots
                if (is_free(groups, best, sizes, owner(slot, :))) exit
            end do
            if (slot > most_slots) then
                call set_status(status, st_out_of_range, 'a wheel must have at most ' // &
                                integer_text(most_slots) // ' different contacts in a lookup table')
                return
            end if
            n_slots = max(n_slots, slot)
            i = groups%first(best)
            do while (i > 0)
                owner(slot, node_of(i)) = best
                slot_of(1 + modulo(i - 1, most_contacts), node_of(i)) = slot
                i = groups%next(i)
            end do
        end do
    end subroutine find_slots

    ! No other contact at the nodes of a group, nor next to them?
    logical function is_free(groups, group, sizes, owner)
        type(groups_t), intent(in) :: groups
        integer, intent(in) :: group, sizes(3), owner(:)

        integer :: i, way, next

        is_free = .false.
        i = groups%first(group)
        do while (i > 0)
            if (owner(node_of(i)) /= 0) return
            do way = 1, n_directions
                next = neighbour_of(node_of(i), way, sizes)
                if (next == 0) cycle
                if (owner(next) /= 0) return
            end do
            i = groups%next(i)
        end do
        is_free = .true.
    end function is_free

    ! Groups of contacts that are the same.
    subroutine join_contacts(found, sizes, groups)
        type(found_contacts_t), intent(in) :: found(:)
        integer, intent(in) :: sizes(3)
        type(groups_t), intent(out) :: groups

        integer :: node, next, way, i, j, k, reach, n
        real(wp) :: apart

        n = most_contacts*size(found)
        groups%group = [(i, i=1, n)]
        groups%first = groups%group
        allocate (groups%next(n), source=0)
        allocate (groups%members(n), source=1)
        allocate (groups%weight(n), source=0.0_wp)
        do node = 1, size(found)
            do i = 1, found(node)%n
                groups%weight(number_of(i, node)) = found(node)%numbers(at_load, i)
            end do
        end do
        do reach = 1, size(reaches)
            do node = 1, size(found)
                do way = 1, n_directions, 2
                    next = neighbour_of(node, way, sizes)
                    if (next == 0) cycle
                    do i = 1, found(node)%n
                        j = nearest(found(node)%numbers(:, i), found(next), apart)
                        if (j == 0 .or. apart > reaches(reach)) cycle
                        k = nearest(found(next)%numbers(:, j), found(node), apart)
                        if (k == i) call join(groups, number_of(i, node), number_of(j, next))
                    end do
                end do
            end do
        end do
    end subroutine join_contacts

    ! The contact of a node that is nearest to another one on the rail.
    integer function nearest(numbers, found, apart) result(best)
        real(wp), intent(in) :: numbers(:)
        type(found_contacts_t), intent(in) :: found
        real(wp), intent(out) :: apart

        real(wp) :: distance
        integer :: i

        best = 0
        apart = huge(apart)
        do i = 1, found%n
            distance = norm2(numbers(at_rail_y:at_rail_z) - found%numbers(at_rail_y:at_rail_z, i))
            if (distance >= apart) cycle
            apart = distance
            best = i
        end do
    end function nearest

    ! Make two groups one, unless they have contacts of the same node.
    subroutine join(groups, one, other)
        type(groups_t), intent(inout) :: groups
        integer, intent(in) :: one, other

        integer :: large, small, i, j, last

        large = groups%group(one)
        small = groups%group(other)
        if (large == small) return
        if (groups%members(large) < groups%members(small)) then
            large = groups%group(other)
            small = groups%group(one)
        end if
        i = groups%first(small)
        do while (i > 0)
            do j = 1, most_contacts
                if (groups%group(number_of(j, node_of(i))) == large) return
            end do
            i = groups%next(i)
        end do
        i = groups%first(small)
        last = i
        do while (i > 0)
            groups%group(i) = large
            last = i
            i = groups%next(i)
        end do
        groups%next(last) = groups%first(large)
        groups%first(large) = groups%first(small)
        groups%members(large) = groups%members(large) + groups%members(small)
        groups%weight(large) = groups%weight(large) + groups%weight(small)
    end subroutine join

    pure integer function number_of(contact, node)
        integer, intent(in) :: contact, node

        number_of = most_contacts*(node - 1) + contact
    end function number_of

    pure integer function node_of(number)
        integer, intent(in) :: number

        node_of = 1 + (number - 1)/most_contacts
    end function node_of

    !> The next node along an axis; 0 where there is none.
    pure integer function neighbour_of(node, way, sizes) result(next)
        integer, intent(in) :: node      !! from 1
        integer, intent(in) :: way       !! 1 and 2: up and down along y; then yaw; then load
        integer, intent(in) :: sizes(3)  !! nodes along y, yaw, load

        integer :: axis, stride, place, step

        axis = (way + 1)/2
        stride = product(sizes(:axis - 1))
        place = modulo((node - 1)/stride, sizes(axis))
        step = merge(1, -1, modulo(way, 2) == 1)
        next = 0
        if (place + step >= 0 .and. place + step < sizes(axis)) next = node + step*stride
    end function neighbour_of
end module faststrip_tabulate_slots
