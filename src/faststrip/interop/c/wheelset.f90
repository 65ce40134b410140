!> The wheelsets of the C face: what `include/faststrip.h` declares, and where it is documented.
!>
!> `size` of a setup says which header the caller was compiled with, for all structs of wheelsets:
!> so a new member of any of them comes last, in pieces of eight bytes, and where one grows the
!> setup has to grow too. A setup without `state_size` is that of a state without rails.
module faststrip_interop_c_wheelset
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_char, c_intptr_t, c_ptr, &
                                           c_null_char, c_associated, c_f_pointer
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_ok, st_bad_argument, st_workspace_too_small
    use faststrip_contact_case, only: contact_case_t
    use faststrip_interop_c, only: put_text, numbers_at
    use faststrip_interop_c_structs, only: c_case_t, read_case
    use faststrip_interop_flat, only: fill_case, fill_friction
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, n_setup, n_state, n_rails, &
                                                 n_choices, n_loads, n_counts, n_numbers, &
                                                 n_totals, n_sums, free_wheelset, find_wheelset, &
                                                 wheelset_solve, contact_count, read_contact, &
                                                 contact_limitations, read_totals
    use faststrip_interop_wheelset_new, only: profile_source_t, source_name_length, &
                                              default_setup, new_wheelset
    implicit none
    private

    public :: faststrip_default_wheelset, faststrip_wheelset_new, faststrip_wheelset_free
    public :: faststrip_wheelset_solve, faststrip_wheelset_last_message
    public :: c_setup_t, find_setup, read_sources, read_source_at

    !> `faststrip_wheelset_setup` of the header.
    type, bind(c) :: c_setup_t
        integer(c_size_t) :: size
        real(c_double) :: numbers(n_setup)
        integer(c_size_t) :: state_size ! not there in the first size
    end type c_setup_t

    !> `faststrip_profile` of the header.
    type, bind(c) :: c_profile_t
        type(c_ptr) :: name
        type(c_ptr) :: y
        type(c_ptr) :: z
        integer(c_int) :: n
    end type c_profile_t

    !> `faststrip_wheelset_demand` of the header.
    type, bind(c) :: c_demand_t
        integer(c_int) :: choices(n_choices)
        real(c_double) :: loads(n_loads)
    end type c_demand_t

    !> `faststrip_wheelset_contact` of the header.
    type, bind(c) :: c_contact_t
        integer(c_int) :: counts(n_counts)
        real(c_double) :: numbers(n_numbers)
        integer(c_int) :: limitations
    end type c_contact_t

    !> `faststrip_wheelset_result` of the header.
    type, bind(c) :: c_totals_t
        integer(c_int) :: sums(n_sums)
        real(c_double) :: totals(n_totals)
    end type c_totals_t

    ! Bytes of the setup: a size and its numbers; with the size of the state.
    integer(c_size_t), parameter :: first_size = 8*(1 + n_setup), setup_size = first_size + 8
    ! Bytes of the state with its rails.
    integer(c_size_t), parameter :: state_size = 8*(n_state + n_rails)

contains

    !> Fill a setup in with standard gauge, wheels of 460 mm, no word of the rails' inclination.
    integer(c_int) function faststrip_default_wheelset(setup, length) bind(c) result(code)
        type(c_ptr), value :: setup        !! a `faststrip_wheelset_setup`, written
        integer(c_size_t), value :: length !! its size as the caller knows it

        type(c_setup_t), pointer :: fields
        type(status_t) :: status

        call check_setup(setup, length, status)
        code = status%code
        if (is_error(status)) return
        call c_f_pointer(setup, fields)
        fields%size = length
        call default_setup(fields%numbers)
        if (length > first_size) fields%state_size = state_size
    end function faststrip_default_wheelset

    !> Make a wheelset on its track.
    integer(c_int) function faststrip_wheelset_new(setup, wheels, rails, case, wheelset, text, &
                                                   length) bind(c) result(code)
        type(c_ptr), value :: setup        !! a `faststrip_wheelset_setup`
        type(c_ptr), value :: wheels       !! two of `faststrip_profile`, right and left
        type(c_ptr), value :: rails        !! two of `faststrip_profile`, right and left
        type(c_ptr), value :: case         !! a `faststrip_case`
        type(c_ptr), value :: wheelset     !! where the handle goes
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        integer(c_intptr_t), pointer :: number
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(wheelset)) return
        call c_f_pointer(wheelset, number)
        number = 0
        call make_handle(setup, wheels, rails, case, number, status)
        code = status%code
        if (c_associated(text)) code = max(code, put_text(trim(status%message), text, length))
    end function faststrip_wheelset_new

    !> Free a wheelset and set the caller's pointer to null; a null one is left alone.
    integer(c_int) function faststrip_wheelset_free(wheelset) bind(c) result(code)
        type(c_ptr), value :: wheelset !! where the handle is

        integer(c_intptr_t), pointer :: number
        type(status_t) :: status

        code = st_bad_argument
        if (.not. c_associated(wheelset)) return
        call c_f_pointer(wheelset, number)
        code = st_ok
        if (number == 0) return
        call free_wheelset(number, status)
        code = status%code
        number = 0
    end function faststrip_wheelset_free

    !> The words of a wheelset's last call, with the offending value; empty when all was well.
    integer(c_int) function faststrip_wheelset_last_message(wheelset, text, length) bind(c) &
        result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        type(c_ptr), value :: text             !! `length` characters, written
        integer(c_size_t), value :: length     !! with the closing zero

        type(wheelset_handle_t), pointer :: handle
        type(status_t) :: status

        call find_wheelset(wheelset, handle, status)
        code = status%code
        if (is_error(status)) return
        code = put_text(trim(handle%status%message), text, length)
    end function faststrip_wheelset_last_message

    !> Solve the contacts of both wheels, or of one.
    integer(c_int) function faststrip_wheelset_solve(wheelset, state, demand, capacity, n, &
                                                     contacts, result) bind(c) result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        type(c_ptr), value :: state            !! a `faststrip_wheelset_state`
        type(c_ptr), value :: demand           !! a `faststrip_wheelset_demand`
        integer(c_int), value :: capacity      !! length of `contacts`
        type(c_ptr), value :: n                !! number of contacts, written
        type(c_ptr), value :: contacts         !! `faststrip_wheelset_contact`, written
        type(c_ptr), value :: result           !! a `faststrip_wheelset_result`, written

        type(wheelset_handle_t), pointer :: handle
        real(c_double), pointer :: position(:)
        type(c_demand_t), pointer :: wanted
        type(c_contact_t), pointer :: contact(:)
        type(c_totals_t), pointer :: wheels
        integer(c_int), pointer :: number
        type(status_t) :: status
        integer :: i

        call find_wheelset(wheelset, handle, status)
        code = status%code
        if (is_error(status)) return
        call clear_status(handle%status)
        if (.not. (c_associated(state) .and. c_associated(demand) .and. c_associated(n) &
                   .and. c_associated(contacts) .and. c_associated(result))) then
            call set_status(handle%status, st_bad_argument, &
                            'state, demand, number, contacts or result is missing')
        else if (capacity < 0) then
            call set_status(handle%status, st_bad_argument, 'the capacity must not be ' // &
                            'negative, got ' // count_text(capacity))
        end if
        code = handle%status%code
        if (is_error(handle%status)) return
        call c_f_pointer(state, position, [n_state + merge(n_rails, 0, handle%knows_rails)])
        if (handle%knows_rails) handle%rails = position(n_state + 1:)
        call c_f_pointer(demand, wanted)
        call c_f_pointer(n, number)
        call c_f_pointer(contacts, contact, [capacity])
        call c_f_pointer(result, wheels)
        call wheelset_solve(handle, position(:n_state), wanted%choices, wanted%loads)
        number = contact_count(handle)
        if (number > capacity) then
            call set_status(handle%status, st_workspace_too_small, &
                            'there are more contacts than fit: ' // count_text(number))
            handle%has = .false.
        else
            do i = 1, number
                call read_contact(handle, i, contact(i)%counts, contact(i)%numbers)
                contact(i)%limitations = contact_limitations(handle, i)
            end do
        end if
        call read_totals(handle, wheels%sums, wheels%totals)
        code = handle%status%code
    end function faststrip_wheelset_solve

    ! A wheelset of what is behind the pointers; 0, and an error, if there cannot be one.
    subroutine make_handle(setup, wheels, rails, case, number, status)
        type(c_ptr), intent(in) :: setup, wheels, rails, case
        integer(c_intptr_t), intent(out) :: number
        type(status_t), intent(out) :: status

        type(c_setup_t), pointer :: fields
        type(c_case_t) :: of_case
        type(profile_source_t) :: sources(2, 2)
        type(contact_case_t) :: contact
        type(wheelset_handle_t), pointer :: handle
        real(c_double) :: angle

        number = 0
        call find_setup(setup, fields, status)
        if (.not. is_error(status)) call read_sources(wheels, 'wheel', sources(:, 1), status)
        if (.not. is_error(status)) call read_sources(rails, 'rail', sources(:, 2), status)
        if (.not. is_error(status)) call read_case(case, of_case, status)
        if (is_error(status)) return
        call fill_case(of_case%choices, of_case%numbers, contact)
        contact%estimate = of_case%estimate /= 0
        contact%resolution_limit = of_case%resolution_limit
        contact%force_limit = of_case%force_limit
        call fill_friction(of_case%friction_kind, of_case%friction, contact%friction, angle)
        call new_wheelset(sources(:, 1), sources(:, 2), fields%numbers, contact, number, status)
        if (is_error(status)) return
        call find_wheelset(number, handle, status)
        handle%knows_rails = fields%size > first_size
    end subroutine make_handle

    !> A caller's setup, if it is one.
    subroutine find_setup(setup, fields, status)
        type(c_ptr), intent(in) :: setup                !! a `faststrip_wheelset_setup`, or null
        type(c_setup_t), pointer, intent(out) :: fields !! where it is; null if there is none
        type(status_t), intent(out) :: status           !! `st_bad_argument`

        fields => null()
        call check_setup(setup, first_size, status)
        if (is_error(status)) return
        call c_f_pointer(setup, fields)
        call check_setup(setup, fields%size, status)
        if (is_error(status) .or. fields%size == first_size) return
        if (fields%state_size /= state_size) &
            call set_status(status, st_bad_argument, 'state_size of the setup must be the ' // &
                            trim(count_text(int(state_size))) // ' bytes of the state, as ' // &
                            'faststrip_default_wheelset set it')
    end subroutine find_setup

    ! Is there a setup, of the size that this library knows?
    subroutine check_setup(setup, length, status)
        type(c_ptr), intent(in) :: setup
        integer(c_size_t), intent(in) :: length
        type(status_t), intent(out) :: status

        character(len=20) :: got

        call clear_status(status)
        write (got, '(ss, i0)') length
        if (.not. c_associated(setup)) then
            call set_status(status, st_bad_argument, 'the setup of the wheelset is missing')
        else if (length > setup_size) then
            call set_status(status, st_bad_argument, 'the setup must have the ' // &
                            trim(count_text(int(setup_size))) // ' bytes that this library ' // &
                            'knows, got ' // trim(got) // ': the header is newer')
        else if (length /= setup_size .and. length /= first_size) then
            call set_status(status, st_bad_argument, 'the setup must have the size that ' // &
                            'faststrip_default_wheelset set, got ' // got)
        end if
    end subroutine check_setup

    !> Where the right and the left profile of a body come from.
    subroutine read_sources(address, body, sources, status)
        type(c_ptr), intent(in) :: address                !! of two of `faststrip_profile`
        character(len=*), intent(in) :: body              !! its word
        type(profile_source_t), intent(out) :: sources(2) !! right and left
        type(status_t), intent(out) :: status             !! `st_bad_argument`

        type(c_profile_t), pointer :: profiles(:)
        character(len=5), parameter :: sides(2) = ['right', 'left ']
        integer :: side

        call clear_status(status)
        if (.not. c_associated(address)) then
            call set_status(status, st_bad_argument, 'the ' // body // ' profiles are missing')
            return
        end if
        call c_f_pointer(address, profiles, [2])
        do side = 1, 2
            ! A left profile of neither is as the right one.
            if (side == 2 .and. .not. c_associated(profiles(side)%name) &
                .and. profiles(side)%n == 0) cycle
            call read_source(profiles(side), trim(sides(side)) // ' ' // body, sources(side), &
                             status)
            if (is_error(status)) return
        end do
    end subroutine read_sources

    ! Where one profile comes from.
    subroutine read_source(profile, words, source, status)
        type(c_profile_t), intent(in) :: profile
        character(len=*), intent(in) :: words
        type(profile_source_t), intent(out) :: source
        type(status_t), intent(inout) :: status

        if (c_associated(profile%name)) then
            source%name = text_at(profile%name)
        else if (profile%n > 0 .and. c_associated(profile%y) .and. c_associated(profile%z)) then
            source%y => numbers_at(profile%y, profile%n)
            source%z => numbers_at(profile%z, profile%n)
        else
            call set_status(status, st_bad_argument, 'the ' // words // ' profile must have a ' // &
                            'name, or y and z of its points')
        end if
    end subroutine read_source

    !> Where one profile that a caller points to comes from.
    subroutine read_source_at(address, body, source, status)
        type(c_ptr), intent(in) :: address             !! of a `faststrip_profile`
        character(len=*), intent(in) :: body           !! its word
        type(profile_source_t), intent(out) :: source  !! name or points
        type(status_t), intent(out) :: status          !! `st_bad_argument`

        type(c_profile_t), pointer :: profile

        call clear_status(status)
        if (c_associated(address)) then
            call c_f_pointer(address, profile)
            call read_source(profile, body, source, status)
        else
            call set_status(status, st_bad_argument, 'the ' // body // ' profile is missing')
        end if
    end subroutine read_source_at

    ! The first letters of a name.
    function text_at(address) result(text)
        type(c_ptr), intent(in) :: address
        character(len=source_name_length) :: text

        character(kind=c_char), pointer :: letters(:)
        integer :: i

        call c_f_pointer(address, letters, [source_name_length])
        text = ''
        do i = 1, source_name_length
            if (letters(i) == c_null_char) exit
            text(i:i) = letters(i)
        end do
        ! An empty name is no profile either.
        if (text == '') text = '?'
    end function text_at
end module faststrip_interop_c_wheelset
