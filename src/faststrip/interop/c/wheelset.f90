!> The wheelsets of the C interface: what `include/faststrip.h` declares, and where it is
!> documented.
!>
!> `size` of a setup says which header the caller was compiled with, for all structs of wheelsets.
module faststrip_interop_c_wheelset
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_size_t, c_char, c_intptr_t, c_ptr, &
                                           c_null_char, c_associated, c_f_pointer, c_sizeof
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_ok, st_bad_argument
    use faststrip_contact_case, only: contact_case_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t
    use faststrip_interop_c, only: put_text, numbers_at, write_strips, write_elements
    use faststrip_interop_c_structs, only: c_case_t, find_case, fill_case, check_size
    use faststrip_interop_solution, only: strip_count
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, free_wheelset, find_wheelset, &
                                                 take_wheels, wheelset_solve, contact_place, &
                                                 find_contact, contact_mirror, copy_wheelset, &
                                                 use_lookup, &
                                                 pitch_rate_of
    use faststrip_interop_wheelset_new, only: dimensions_t, profile_source_t, &
                                              source_name_length, default_dimensions, new_wheelset
    use faststrip_wheelset_types, only: wheelset_demand_t, side_right, side_left
    implicit none
    private

    public :: faststrip_default_wheelset, faststrip_wheelset_new, faststrip_wheelset_free
    public :: faststrip_wheelset_solve, faststrip_wheelset_copy, faststrip_wheelset_last_message
    public :: faststrip_wheelset_use_lookup
    public :: faststrip_wheelset_get_strips, faststrip_wheelset_get_elements
    public :: c_setup_t, find_setup, read_sources, read_source_at

    !> `faststrip_wheelset_setup` of the header.
    type, bind(c) :: c_setup_t
        integer(c_size_t) :: size
        type(dimensions_t) :: dimensions !! `radius_right` to `roller_radius`
        real(c_double) :: damping        !! s/mm
        real(c_double) :: speed_floor    !! mm/s
        real(c_double) :: rail_stiffness(2) !! y, z, N/mm
    end type c_setup_t

    !> `faststrip_rail_state` of the header.
    type, bind(c) :: c_rail_t
        real(c_double) :: y, z, roll, y_rate, z_rate, roll_rate
    end type c_rail_t

    !> `faststrip_wheelset_state` of the header.
    type, bind(c) :: c_state_t
        real(c_double) :: y, z, roll, yaw, speed, y_rate, z_rate, roll_rate, yaw_rate, pitch_rate, &
                          curvature
        type(c_rail_t) :: rail(2)
        real(c_double) :: pitch_rate_difference
    end type c_state_t

    !> `faststrip_profile` of the header.
    type, bind(c) :: c_profile_t
        type(c_ptr) :: name
        type(c_ptr) :: y
        type(c_ptr) :: z
        integer(c_int) :: n
    end type c_profile_t

    !> `faststrip_wheelset_demand` of the header.
    type, bind(c) :: c_demand_t
        integer(c_int) :: kind, wheels, roll_is_free, warm_start
        real(c_double) :: load_right, load_left, axle_load, roll_moment, axle_moment
        integer(c_int) :: axle_moment_is_given
    end type c_demand_t

    !> `faststrip_wheelset_contact` of the header.
    type, bind(c) :: c_contact_t
        integer(c_int) :: side, status, n_patches, strips_across, is_estimated, &
                          forces_are_estimated
        real(c_double) :: place(3), angle, rail(2), wheel(3), radius, speed, cksi, ceta, cphi, &
                          load, penetration, area, pmax, y_min, y_max, x_max, fx, fy, mz, &
                          friction_power, stick_fraction, force(3), force_wheelset(3), moment(3), &
                          est_err_penetration, est_err_pmax, est_err_area, est_err_fx, &
                          est_err_fy, est_err_mz, est_err_load
        integer(c_int) :: limitations, n_strips, n_elements
    end type c_contact_t

    !> `faststrip_wheelset_result` of the header; zeros of a wheel that was not solved.
    type, bind(c) :: c_totals_t
        integer(c_int) :: status(2) = 0, n_contacts(2) = 0, n_solutions(2) = 0
        real(c_double) :: z(2) = 0, roll = 0
        real(c_double), dimension(3, 2) :: force = 0, force_wheelset = 0, moment = 0
        real(c_double) :: pitch_rate = 0
    end type c_totals_t

contains

    !> Fill a setup in with standard gauge, wheels of 460 mm, no word of the rails' inclination.
    integer(c_int) function faststrip_default_wheelset(setup, length) bind(c) result(code)
        type(c_ptr), value :: setup        !! a `faststrip_wheelset_setup`, written
        integer(c_size_t), value :: length !! its size as the caller knows it

        type(c_setup_t), pointer :: fields
        type(status_t) :: status

        call check_size('the setup of the wheelset', 'faststrip_default_wheelset', setup, &
                        c_sizeof(fields), status, length)
        code = status%code
        if (is_error(status)) return
        call c_f_pointer(setup, fields)
        fields = c_setup_t(c_sizeof(fields), default_dimensions(), 0.0_c_double, 0.0_c_double, &
                           0.0_c_double)
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

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        code = put_text(trim(handle%status%message), text, length)
    end function faststrip_wheelset_last_message

    !> Copy a wheelset with its last solution, for a step that may be taken back.
    integer(c_int) function faststrip_wheelset_copy(from, to) bind(c) result(code)
        integer(c_intptr_t), value :: from !! a handle
        integer(c_intptr_t), value :: to   !! another one

        type(wheelset_handle_t), pointer :: source, target

        call find_wheelset(from, source, code)
        if (code /= st_ok) return
        call find_wheelset(to, target, code)
        if (code /= st_ok .or. from == to) return
        call copy_wheelset(source, target)
    end function faststrip_wheelset_copy

    !> Let a lookup table answer for a wheelset where it reaches.
    integer(c_int) function faststrip_wheelset_use_lookup(wheelset, lookup, order) bind(c) &
        result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_intptr_t), value :: lookup   !! a handle; null: none any more
        integer(c_int), value :: order         !! of interpolation, 1 or 3

        type(wheelset_handle_t), pointer :: handle

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call use_lookup(handle, lookup, order)
        code = handle%status%code
    end function faststrip_wheelset_use_lookup

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
        type(c_state_t), pointer :: place
        type(c_demand_t), pointer :: wanted
        type(c_contact_t), pointer :: contact(:)
        type(c_totals_t), pointer :: wheels
        integer(c_int), pointer :: number
        type(wheelset_demand_t) :: prescribed
        integer :: i, side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
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
        call c_f_pointer(state, place)
        call c_f_pointer(demand, wanted)
        call c_f_pointer(n, number)
        call c_f_pointer(contacts, contact, [capacity])
        call c_f_pointer(result, wheels)
        number = 0
        call take_wheels(handle, wanted%wheels, prescribed%wants)
        if (.not. is_error(handle%status)) then
            prescribed%kind = wanted%kind
            prescribed%load = [wanted%load_right, wanted%load_left]
            prescribed%axle_load = wanted%axle_load
            prescribed%roll_is_free = wanted%roll_is_free /= 0
            prescribed%roll_moment = wanted%roll_moment
            prescribed%axle_moment_is_given = wanted%axle_moment_is_given /= 0
            prescribed%axle_moment = wanted%axle_moment
            call wheelset_solve(handle, state_of(place), prescribed, wanted%warm_start /= 0, &
                                capacity, number)
        end if
        if (.not. is_error(handle%status)) then
            do i = 1, number
                call contact_place(handle, i, side, k)
                call fill_contact(handle, side, k, contact(i))
            end do
        end if
        call fill_totals(handle, wheels)
        code = handle%status%code
    end function faststrip_wheelset_solve

    !> The strips of a contact of the last solution.
    integer(c_int) function faststrip_wheelset_get_strips(wheelset, i, capacity, n, y_left, &
                                                          y_right, half_length, p0, patch) &
        bind(c) result(code)
        integer(c_intptr_t), value :: wheelset                 !! a handle
        integer(c_int), value :: i                             !! contact, from 0 on
        integer(c_int), value :: capacity                      !! length of the arrays
        type(c_ptr), value :: n                                !! number of strips, written
        type(c_ptr), value :: y_left, y_right, half_length, p0 !! mm, mm, mm, MPa, written
        type(c_ptr), value :: patch                            !! number of the patch, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) &
            call write_strips(handle%workspace%wheel(side)%contact(k), &
                              contact_mirror(handle, side), capacity, n, &
                              [y_left, y_right, half_length, p0, patch], handle%status)
        code = handle%status%code
    end function faststrip_wheelset_get_strips

    !> The elements of a contact of the last solution, if they were asked for.
    integer(c_int) function faststrip_wheelset_get_elements(wheelset, i, capacity, n, x, y, area, &
                                                            pn, px, py, sx, sy, state) bind(c) &
        result(code)
        integer(c_intptr_t), value :: wheelset !! a handle
        integer(c_int), value :: i             !! contact, from 0 on
        integer(c_int), value :: capacity      !! length of the arrays
        type(c_ptr), value :: n                !! number of elements, written
        type(c_ptr), value :: x, y             !! middle of the element, mm, written
        type(c_ptr), value :: area             !! mm^2, written
        type(c_ptr), value :: pn               !! pressure, MPa, written
        type(c_ptr), value :: px, py           !! traction on the rail, MPa, written
        type(c_ptr), value :: sx, sy           !! slip over rolling speed, written
        type(c_ptr), value :: state            !! 1 adhesion, 2 slip, written

        type(wheelset_handle_t), pointer :: handle
        integer :: side, k

        call find_wheelset(wheelset, handle, code)
        if (code /= st_ok) return
        call find_contact(handle, i, side, k, first=0)
        if (.not. is_error(handle%status)) &
            call write_elements(handle%workspace%wheel(side)%contact(k), &
                                contact_mirror(handle, side), capacity, n, &
                                [x, y, area, pn, px, py, sx, sy, state], handle%status)
        code = handle%status%code
    end function faststrip_wheelset_get_elements

    ! Position and velocity as the core has them.
    pure type(wheelset_state_t) function state_of(place) result(state)
        type(c_state_t), intent(in) :: place

        integer :: side

        state%y = place%y
        state%z = place%z
        state%roll = place%roll
        state%yaw = place%yaw
        state%speed = place%speed
        state%y_rate = place%y_rate
        state%z_rate = place%z_rate
        state%roll_rate = place%roll_rate
        state%yaw_rate = place%yaw_rate
        state%pitch_rate = pitch_rate_of(place%pitch_rate)
        state%pitch_rate_difference = place%pitch_rate_difference
        state%curvature = place%curvature
        do side = side_right, side_left
            associate (rail => place%rail(side))
                state%rail(side) = rail_state_t(rail%y, rail%z, rail%roll, rail%y_rate, &
                                                rail%z_rate, rail%roll_rate)
            end associate
        end do
    end function state_of

    ! One contact of the last solution.
    pure subroutine fill_contact(handle, side, k, fields)
        type(wheelset_handle_t), intent(in) :: handle
        integer, intent(in) :: side, k
        type(c_contact_t), intent(out) :: fields

        associate (contact => handle%result%wheel(side)%contact(k), &
                   figures => handle%result%wheel(side)%contact(k)%figures, &
                   workspace => handle%workspace%wheel(side)%contact(k))
            fields%side = side
            fields%status = contact%status%code
            fields%limitations = contact%status%limitations
            fields%place = contact%place
            fields%angle = contact%angle
            fields%rail = contact%rail
            fields%wheel = contact%wheel
            fields%radius = contact%radius
            fields%speed = contact%speed
            fields%cksi = contact%creepage%cksi
            fields%ceta = contact%creepage%ceta
            fields%cphi = contact%creepage%cphi
            fields%n_patches = figures%normal%n_patches
            fields%strips_across = figures%normal%strips_across
            fields%load = figures%normal%load
            fields%penetration = figures%normal%penetration
            fields%area = figures%normal%area
            fields%pmax = figures%normal%pmax
            fields%y_min = figures%normal%y_min
            fields%y_max = figures%normal%y_max
            fields%x_max = figures%normal%x_max
            fields%fx = figures%tangential%fx
            fields%fy = figures%tangential%fy
            fields%mz = figures%tangential%mz
            fields%friction_power = figures%tangential%friction_power
            fields%stick_fraction = figures%tangential%stick_fraction
            fields%force = contact%force
            fields%force_wheelset = contact%force_wheelset
            fields%moment = contact%moment
            fields%is_estimated = merge(1, 0, figures%is_estimated)
            fields%est_err_penetration = figures%normal_errors%est_err_penetration
            fields%est_err_pmax = figures%normal_errors%est_err_pmax
            fields%est_err_area = figures%normal_errors%est_err_area
            fields%forces_are_estimated = merge(1, 0, figures%forces_are_estimated)
            fields%est_err_fx = figures%force_errors%fx
            fields%est_err_fy = figures%force_errors%fy
            fields%est_err_mz = figures%force_errors%mz
            fields%est_err_load = contact%est_err_load
            fields%n_strips = strip_count(workspace)
            fields%n_elements = workspace%field%n
        end associate
    end subroutine fill_contact

    ! What the wheels of the last solution came to.
    pure subroutine fill_totals(handle, fields)
        type(wheelset_handle_t), intent(in) :: handle
        type(c_totals_t), intent(out) :: fields

        integer :: side

        do side = side_right, side_left
            if (.not. handle%has(side)) cycle
            fields%pitch_rate = handle%result%pitch_rate
            associate (wheel => handle%result%wheel(side))
                fields%status(side) = wheel%status%code
                fields%n_contacts(side) = wheel%n
                fields%n_solutions(side) = wheel%solutions
                fields%z(side) = wheel%z
                fields%roll = wheel%roll
                fields%force(:, side) = wheel%force
                fields%force_wheelset(:, side) = wheel%force_wheelset
                fields%moment(:, side) = wheel%moment
            end associate
        end do
    end subroutine fill_totals

    ! A wheelset of what is behind the pointers; 0, and an error, if there cannot be one.
    subroutine make_handle(setup, wheels, rails, case, number, status)
        type(c_ptr), intent(in) :: setup, wheels, rails, case
        integer(c_intptr_t), intent(out) :: number
        type(status_t), intent(out) :: status

        type(c_setup_t), pointer :: fields
        type(c_case_t), pointer :: of_case
        type(profile_source_t) :: sources(2, 2)
        type(contact_case_t) :: contact
        real(c_double) :: ignored

        number = 0
        call find_setup(setup, fields, status)
        if (.not. is_error(status)) call read_sources(wheels, 'wheel', sources(:, 1), status)
        if (.not. is_error(status)) call read_sources(rails, 'rail', sources(:, 2), status)
        if (.not. is_error(status)) call find_case(case, of_case, status)
        if (is_error(status)) return
        ! The angle is that of each contact.
        call fill_case(of_case, contact, ignored)
        call new_wheelset(sources(:, 1), sources(:, 2), fields%dimensions, contact, number, &
                          status, fields%damping, fields%speed_floor, fields%rail_stiffness)
    end subroutine make_handle

    !> A caller's setup, if it is one.
    subroutine find_setup(setup, fields, status)
        type(c_ptr), intent(in) :: setup                !! a `faststrip_wheelset_setup`, or null
        type(c_setup_t), pointer, intent(out) :: fields !! where it is; null if there is none
        type(status_t), intent(out) :: status           !! `st_bad_argument`

        fields => null()
        call check_size('the setup of the wheelset', 'faststrip_default_wheelset', setup, &
                        c_sizeof(fields), status)
        if (.not. is_error(status)) call c_f_pointer(setup, fields)
    end subroutine find_setup

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
