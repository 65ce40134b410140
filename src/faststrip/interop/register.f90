!> Which workspaces are in use: the one thing the library remembers outside of them.
!>
!> A handle is a number, not an address: a place in this register, and how often that place was
!> given out. So a handle that was freed, or never made, is found without touching memory that is
!> no longer its own, and does not become another one's.
!>
!> Entering and leaving go one at a time, by a mutex that a fork waits for (in C beside this).
!> Looking up takes no lock: a place changes only when its own handle enters or leaves, and who
!> frees a workspace while another thread uses it breaks the rule of one thread at a time.
module faststrip_interop_register
    use, intrinsic :: iso_c_binding, only: c_intptr_t, c_ptr, c_null_ptr, c_loc, c_f_pointer, &
                                           c_associated
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_workspace_too_small
    implicit none
    private

    public :: enter_register, leave_register, look_up_register
    public :: kind_contact, kind_wheelset, kind_lookup

    !> What a handle can stand for: one of a kind is none of another.
    !> Given: numbers of kinds.
    integer, parameter :: kind_contact = 1, kind_wheelset = 2, kind_lookup = 3

    ! Bits of a handle for the place; the rest, but the sign, counts how often it was given out.
    integer, parameter :: place_bits = 20
    integer(c_intptr_t), parameter :: place_mask = 2_c_intptr_t**place_bits - 1
    integer(c_intptr_t), parameter :: count_mask = &
        ishft(not(0_c_intptr_t), -1 - place_bits)

    ! Places are made in blocks of doubling length, the first one here; none ever moves.
    integer, parameter :: first_bits = 6, first_length = 2**first_bits
    integer, parameter :: n_blocks = place_bits - first_bits

    !> Where a handle lives.
    type :: place_t
        integer(c_intptr_t) :: handle = 0 ! that is in use; 0: none
        integer(c_intptr_t) :: count = 0  ! how often the place was given out
        integer :: kind = 0               ! of what is at the address
        type(c_ptr) :: address = c_null_ptr
        integer :: next_free = 0
    end type place_t

    type(place_t), save, target :: first_block(0:first_length - 1)
    type(c_ptr), save :: blocks(n_blocks) = c_null_ptr
    integer, save :: n_places = 0   ! that were ever given out
    integer, save :: first_free = 0 ! of those given back; 0: none

    interface
        subroutine lock() bind(c, name='interop_lock_register')
        end subroutine lock

        subroutine unlock() bind(c, name='interop_unlock_register')
        end subroutine unlock
    end interface

contains

    !> Make a handle for what is at an address.
    subroutine enter_register(address, kind, handle, status)
        type(c_ptr), intent(in) :: address              !! of a workspace
        integer, intent(in) :: kind                     !! of it
        integer(c_intptr_t), intent(out) :: handle      !! never given out before; 0 when there is
                                                        !! an error
        type(status_t), intent(out) :: status           !! `st_workspace_too_small`

        type(place_t), pointer :: place
        integer :: number

        handle = 0
        call clear_status(status)
        call lock()
        number = first_free
        if (number == 0) number = n_places + 1
        call make_place(number, place)
        if (associated(place)) then
            if (number == first_free) first_free = place%next_free
            n_places = max(n_places, number)
            ! Counted from a number that differs between copies of the library in one process.
            if (place%count == 0) &
                place%count = ishft(transfer(c_loc(first_block), 0_c_intptr_t), -4)
            place%count = max(iand(place%count + 1, count_mask), 1_c_intptr_t)
            handle = ior(ishft(place%count, place_bits), int(number, c_intptr_t))
            place%address = address
            place%kind = kind
            place%handle = handle
        else
            call set_status(status, st_workspace_too_small, 'no capacity for another workspace')
        end if
        call unlock()
    end subroutine enter_register

    !> Take a handle out; from here on it is none.
    subroutine leave_register(handle, kind, address, status)
        integer(c_intptr_t), intent(in) :: handle !! as the caller passed it
        integer, intent(in) :: kind               !! that it has to be of
        type(c_ptr), intent(out) :: address       !! what it stood for; null if it is no handle
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no handle, or freed

        type(place_t), pointer :: place

        call lock()
        call look_up_register(handle, kind, address, status)
        if (c_associated(address)) then
            call find_place(int(iand(handle, place_mask)), place)
            place%handle = 0
            place%address = c_null_ptr
            place%next_free = first_free
            first_free = int(iand(handle, place_mask))
        end if
        call unlock()
    end subroutine leave_register

    !> What a handle stands for.
    subroutine look_up_register(handle, kind, address, status)
        integer(c_intptr_t), intent(in) :: handle !! as the caller passed it
        integer, intent(in) :: kind               !! that it has to be of
        type(c_ptr), intent(out) :: address       !! null if it is no handle
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no handle, or freed

        type(place_t), pointer :: place

        address = c_null_ptr
        call clear_status(status)
        place => null()
        if (handle > 0 .and. iand(handle, place_mask) > 0) &
            call find_place(int(iand(handle, place_mask)), place)
        if (associated(place)) then
            if (place%handle == handle .and. place%kind == kind) address = place%address
        end if
        if (.not. c_associated(address)) &
            call set_status(status, st_bad_argument, 'no workspace, or one that was freed')
    end subroutine look_up_register

    !> The place of a number from 1 on; null where none was made.
    subroutine find_place(number, place)
        integer, intent(in) :: number
        type(place_t), pointer, intent(out) :: place

        type(place_t), pointer :: block(:)
        integer :: k

        place => null()
        k = block_of(number)
        if (k == 0) then
            place => first_block(number)
        else if (c_associated(blocks(k))) then
            call c_f_pointer(blocks(k), block, [block_length(k)])
            place => block(number - block_length(k) + 1)
        end if
    end subroutine find_place

    !> The same, where no block is there yet with a new one; null if there is no more capacity.
    subroutine make_place(number, place)
        integer, intent(in) :: number
        type(place_t), pointer, intent(out) :: place

        type(place_t), pointer :: block(:)
        integer :: k, failure

        place => null()
        if (number > place_mask) return
        k = block_of(number)
        if (k > 0) then
            if (.not. c_associated(blocks(k))) then
                allocate (block(block_length(k)), stat=failure)
                if (failure /= 0) return
                blocks(k) = c_loc(block)
            end if
        end if
        call find_place(number, place)
    end subroutine make_place

    !> Block k > 0 holds as many places as all before it, from number `block_length(k)` on.
    pure integer function block_of(number)
        integer, intent(in) :: number

        block_of = max(bit_size(number) - leadz(number) - first_bits, 0)
    end function block_of

    pure integer function block_length(k)
        integer, intent(in) :: k

        block_length = ishft(first_length, k - 1)
    end function block_length
end module faststrip_interop_register
