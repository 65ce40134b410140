!> What stands behind the handles of wheelsets in the C and F77 interfaces.
module faststrip_interop_wheelset_handle
    use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_ptr, c_f_pointer
    use, intrinsic :: iso_fortran_env, only: int8, int64
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_workspace_too_small, st_ok
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t, pure_rolling, &
                                                 is_same_state
    use faststrip_interop_lookup_handle, only: find_lookup
    use faststrip_interop_register, only: leave_register, look_up_register, kind_wheelset
    use faststrip_interop_solution, only: mirror_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_contact_case, only: keeps_elements
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_contact_plausible, only: doubts_t, case_names_t, add_doubt, doubt_material, &
                                           doubt_pressure
    use faststrip_base_plausible, only: of_radius
    use faststrip_wheelset_plausible, only: state_names_t, find_state_doubts
    use faststrip_lookup_table, only: lookup_t
    use faststrip_wheelset_derivatives, only: find_wheelset_derivatives
    use faststrip_wheelset_enter, only: enter_lookup
    use faststrip_wheelset_memory, only: save_wheelset, restore_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheel_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, is_same_demand, &
                                        side_right, side_left
    implicit none
    private

    public :: wheelset_handle_t
    public :: allocate_wheelset, allocate_workspace, free_wheelset, find_wheelset, take_wheels
    public :: wheelset_solve
    public :: contact_count, contact_place, find_contact, contact_mirror
    public :: copy_wheelset, save_memory, restore_memory
    public :: pitch_rate_of, wheelset_derivatives, use_lookup, forget_asked

    ! Given: `FASTSTRIP_LOCKED_WHEELS`, what stands for a pitch rate of 0.
    real(wp), parameter :: locked_wheels = 1.0e300_wp

    !> What was asked, as it was given, and how that ended.
    type :: asked_t
        logical :: counts = .false. !! would it end so again?
        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(status_t) :: status
    end type asked_t

    !> One caller's wheelset.
    type :: wheelset_handle_t
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t), allocatable :: workspace
        type(wheelset_result_t) :: result
        logical :: has(2) = .false. !! which wheels the result is of
        type(asked_t), allocatable :: asked !! what the result answers
        type(rail_state_t) :: rail(2) !! right, left: of the F77 interface, which sets them once
        real(wp) :: pitch_rate_difference = 0.0_wp !! left less right, rad/s; likewise
        logical :: axle_moment_is_given = .false. !! likewise
        real(wp) :: axle_moment = 0.0_wp !! of a drive or brake on the wheelset, N mm; likewise
        type(status_t) :: status      !! of the last call
        type(doubts_t) :: doubts      !! what was outside of practice in the last state
        integer(c_intptr_t) :: lookup = 0 !! handle of its lookup table; 0: none
    end type wheelset_handle_t

contains

    !> Make an empty handle, without a workspace. First values are much for a stack: so nothing else
    !> happens here.
    subroutine allocate_wheelset(handle, status)
        type(wheelset_handle_t), pointer, intent(out) :: handle !! null when there is an error
        type(status_t), intent(out) :: status                   !! `st_workspace_too_small`

        integer :: failure

        call clear_status(status)
        allocate (handle, stat=failure)
        if (failure == 0) return
        handle => null()
        call refuse_memory(status)
    end subroutine allocate_wheelset

    !> Make an empty workspace of a handle; likewise.
    subroutine allocate_workspace(handle, status)
        type(wheelset_handle_t), intent(inout) :: handle !! gets it
        type(status_t), intent(out) :: status            !! `st_workspace_too_small`

        integer :: failure

        call clear_status(status)
        allocate (handle%workspace, stat=failure)
        if (failure == 0) allocate (handle%asked, stat=failure)
        if (failure /= 0) call refuse_memory(status)
    end subroutine allocate_workspace

    subroutine refuse_memory(status)
        type(status_t), intent(inout) :: status

        call set_status(status, st_workspace_too_small, 'not enough memory for a wheelset')
    end subroutine refuse_memory

    !> Free a wheelset; nothing happens to what is none.
    subroutine free_wheelset(number, status)
        integer(c_intptr_t), intent(in) :: number !! as the caller passed it
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no wheelset, or freed

        type(wheelset_handle_t), pointer :: handle
        type(c_ptr) :: address

        call leave_register(number, kind_wheelset, address, status)
        if (is_error(status)) return
        call c_f_pointer(address, handle)
        deallocate (handle)
    end subroutine free_wheelset

    !> The wheelset of a number.
    subroutine find_wheelset(number, handle, code)
        integer(c_intptr_t), intent(in) :: number               !! as the caller passed it
        type(wheelset_handle_t), pointer, intent(out) :: handle !! null if it is none
        integer(c_int), intent(out) :: code !! `st_bad_argument`: no wheelset, or freed

        type(c_ptr) :: address
        type(status_t) :: status

        handle => null()
        call look_up_register(number, kind_wheelset, address, status)
        code = status%code
        if (code == st_ok) call c_f_pointer(address, handle)
    end subroutine find_wheelset

    !> Which wheels a caller asks for.
    subroutine take_wheels(handle, number, wants)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells what is none
        integer(c_int), intent(in) :: number             !! 0 both, 1 right, 2 left
        logical, intent(out) :: wants(2)                 !! right, left

        call clear_status(handle%status)
        wants = number /= [2, 1]
        if (number >= 0 .and. number <= 2) return
        handle%has = .false.
        handle%doubts%n = 0
        call set_status(handle%status, st_bad_argument, 'the wheels must be 0, both, 1, right, ' &
                        // 'or 2, left, got ' // count_text(number))
    end subroutine take_wheels

    !> Copy a wheelset with its last solution into another, for a step that may be taken back.
    subroutine copy_wheelset(from, to)
        type(wheelset_handle_t), intent(inout) :: from !! stays as it is
        type(wheelset_handle_t), intent(inout) :: to   !! becomes equal

        integer :: side

        if (are_alike(from, to)) then
            do side = side_right, side_left
                call copy_memory(from%workspace%wheel(side), to%workspace%wheel(side))
            end do
            to%workspace%last_state = from%workspace%last_state
            to%workspace%has_last = from%workspace%has_last
            to%workspace%is_reversed = from%workspace%is_reversed
            to%workspace%stiffness = from%workspace%stiffness
            to%workspace%deflection = from%workspace%deflection
            to%workspace%path = from%workspace%path
        else
            to%workspace = from%workspace
        end if
        to%model = from%model
        to%result = from%result
        to%has = from%has
        to%asked = from%asked
        to%rail = from%rail
        to%pitch_rate_difference = from%pitch_rate_difference
        to%axle_moment_is_given = from%axle_moment_is_given
        to%axle_moment = from%axle_moment
        to%lookup = from%lookup
        to%doubts = from%doubts
        call clear_status(to%status)
    end subroutine copy_wheelset

    ! Were both made of the same profiles for the same methods?
    pure logical function are_alike(from, to)
        type(wheelset_handle_t), intent(in) :: from, to

        integer :: side

        are_alike = .true.
        do side = side_right, side_left
            associate (one => from%workspace%wheel(side), other => to%workspace%wheel(side))
                are_alike = are_alike .and. one%outline%mark == other%outline%mark &
                            .and. size(one%outline%x) == size(other%outline%x)
            end associate
        end do
        associate (one => from%model%case, other => to%model%case)
            are_alike = are_alike .and. all(numbers_of(one%methods) == numbers_of(other%methods)) &
                        .and. (keeps_elements(one) .eqv. keeps_elements(other))
        end associate
    end function are_alike

    ! What a workspace is reserved by.
    pure function numbers_of(methods) result(numbers)
        type(contact_methods_t), intent(in) :: methods
        integer :: numbers(6)

        numbers = [methods%normal, methods%tangential, methods%strips_per_patch, &
                   methods%points_per_strip, methods%fastsim_nx, methods%fastsim_ny]
    end function numbers_of

    ! What the next solution of a wheel may depend on, and what is asked of the last one: contacts
    ! that it does not have are most of the memory.
    pure subroutine copy_memory(from, to)
        type(wheel_workspace_t), intent(inout) :: from, to

        to%outline = from%outline
        to%gap = from%gap
        to%n = from%n
        to%approach = from%approach
        to%slope = from%slope
        to%region = from%region
        to%contact(:to%n) = from%contact(:to%n)
    end subroutine copy_memory

    !> A model that was changed answers anew what was asked the last time.
    pure subroutine forget_asked(handle)
        type(wheelset_handle_t), intent(inout) :: handle !! its result stays

        if (allocated(handle%asked)) handle%asked%counts = .false.
    end subroutine forget_asked

    !> What the next solution of a handle depends on, as bytes. What was asked is not among them:
    !> afterwards it is solved anew here as there.
    subroutine save_memory(handle, bytes, n)
        type(wheelset_handle_t), intent(inout) :: handle           !! its status tells how it ended
        integer(int8), intent(inout), target, contiguous :: bytes(:) !! the first n are written
        integer(int64), intent(out) :: n                           !! how many there are

        call save_wheelset(handle%model, handle%workspace, bytes, n, handle%status)
        call forget_asked(handle)
    end subroutine save_memory

    !> Take it over: of the last solution nothing can be asked afterwards.
    subroutine restore_memory(handle, bytes)
        type(wheelset_handle_t), intent(inout) :: handle          !! its status tells how it ended
        integer(int8), intent(in), target, contiguous :: bytes(:) !! of `save_memory`

        call restore_wheelset(handle%model, handle%workspace, bytes, handle%status)
        if (is_error(handle%status)) return
        handle%has = .false.
        handle%doubts%n = 0
    end subroutine restore_memory

    !> The pitch rate of a number in C and F77, where 0 is what nobody has said.
    elemental real(wp) function pitch_rate_of(number) result(rate)
        real(wp), intent(in) :: number !! rad/s; 0: pure rolling, `locked_wheels` or more: 0

        rate = number
        if (.not. abs(number) > 0.0_wp) rate = pure_rolling
        if (number >= locked_wheels) rate = 0.0_wp
    end function pitch_rate_of

    !> Let a lookup table answer for a wheelset where it reaches.
    subroutine use_lookup(handle, number, order)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells how it ended
        integer(c_intptr_t), intent(in) :: number        !! of the table's handle; 0: none any more
        integer(c_int), intent(in) :: order              !! of interpolation, 1 or 3

        type(lookup_t), pointer :: lookup
        type(environment_t) :: environment

        handle%has = .false.
        handle%doubts%n = 0
        lookup => null()
        if (number /= 0) call find_lookup(number, lookup, handle%status%code)
        if (number /= 0 .and. .not. associated(lookup)) then
            call set_status(handle%status, st_bad_argument, &
                            'no lookup table, or one that was freed')
            return
        end if
        call hold_environment(environment)
        call enter_lookup(handle%model, handle%workspace, lookup, int(order), handle%result, &
                          handle%status)
        call restore_environment(environment)
        if (.not. is_error(handle%status)) handle%lookup = number
    end subroutine use_lookup

    ! The table of a handle, which may have been freed.
    subroutine take_table(handle)
        type(wheelset_handle_t), intent(inout) :: handle

        integer(c_int) :: code

        handle%model%lookup => null()
        if (handle%lookup == 0) return
        call find_lookup(handle%lookup, handle%model%lookup, code)
        if (code /= st_ok) call set_status(handle%status, st_bad_argument, &
                                           'the wheelset''s lookup table was freed')
    end subroutine take_table

    !> Solve the contacts of a wheelset; its result has them, unless they are more than fit. A warm
    !> start that asks what was asked the last time has its result.
    subroutine wheelset_solve(handle, state, demand, warm_start, capacity, n)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells how it ended
        type(wheelset_state_t), intent(in) :: state      !! position and velocity
        type(wheelset_demand_t), intent(in) :: demand    !! what is prescribed
        logical, intent(in) :: warm_start                !! from the last solution?
        integer(c_int), intent(in) :: capacity           !! contacts that the caller has room for
        integer(c_int), intent(out) :: n                 !! number of contacts

        type(environment_t) :: environment
        integer :: side, i

        n = 0
        call clear_status(handle%status)
        call take_table(handle)
        if (is_error(handle%status)) then
            handle%has = .false.
            return
        else if (warm_start .and. any(handle%has) .and. handle%asked%counts &
                 .and. is_same_state(handle%asked%state, state) &
                 .and. is_same_demand(handle%asked%demand, demand)) then
            handle%status = handle%asked%status
            call tell_count(handle, capacity, n)
            return
        end if
        handle%has = .false.
        handle%doubts%n = 0
        ! As if it had never been solved.
        if (.not. warm_start) handle%workspace%has_last = .false.
        call hold_environment(environment)
        call doubt_material(handle%model%case, case_names_t(), handle%doubts)
        call add_doubt(handle%doubts, of_radius, 'radius', handle%model%radius)
        call find_state_doubts(handle%model, state, demand, state_names_t(), handle%doubts)
        call restore_environment(environment)
        call solve_wheelset(handle%model, handle%workspace, state, demand, handle%result, &
                            handle%status)
        if (is_error(handle%status)) return
        handle%has = demand%wants
        call hold_environment(environment)
        do side = side_right, side_left
            if (.not. handle%has(side)) cycle
            do i = 1, handle%result%wheel(side)%n
                associate (normal => handle%result%wheel(side)%contact(i)%figures%normal)
                    call doubt_pressure('pmax', normal%pmax, handle%doubts)
                end associate
            end do
        end do
        call restore_environment(environment)
        handle%asked%counts = .true.
        handle%asked%state = state
        handle%asked%demand = demand
        handle%asked%status = handle%status
        call tell_count(handle, capacity, n)
    end subroutine wheelset_solve

    ! How many contacts a result has, if the caller has room for them.
    subroutine tell_count(handle, capacity, n)
        type(wheelset_handle_t), intent(inout) :: handle
        integer(c_int), intent(in) :: capacity
        integer(c_int), intent(out) :: n

        n = contact_count(handle)
        if (n <= capacity) return
        call set_status(handle%status, st_workspace_too_small, &
                        'there are more contacts than fit: ' // count_text(n))
        handle%has = .false.
    end subroutine tell_count

    !> Derivatives at the last solution of a handle.
    subroutine wheelset_derivatives(handle, derivatives)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells how it ended
        real(wp), intent(out) :: derivatives(6, 9, 2)    !! as `find_wheelset_derivatives` has them

        derivatives = 0.0_wp
        if (.not. any(handle%has)) then
            call set_status(handle%status, st_bad_argument, 'there is no solution of the wheelset')
            return
        end if
        call find_wheelset_derivatives(handle%model, handle%workspace, handle%has, handle%result, &
                                       derivatives, handle%status)
    end subroutine wheelset_derivatives

    !> Contacts of the last solution.
    pure integer function contact_count(handle)
        type(wheelset_handle_t), intent(in) :: handle !! solved or not

        contact_count = sum(handle%result%wheel%n, mask=handle%has)
    end function contact_count

    !> Which contact of which wheel the i-th is; those of the right wheel come first.
    pure subroutine contact_place(handle, i, side, k)
        type(wheelset_handle_t), intent(in) :: handle !! with so many contacts
        integer, intent(in) :: i                      !! from 1 on
        integer, intent(out) :: side                  !! `side_right`, `side_left`
        integer, intent(out) :: k                     !! of its wheel

        k = merge(handle%result%wheel(side_right)%n, 0, handle%has(side_right))
        side = merge(side_right, side_left, i <= k)
        k = merge(i, i - k, i <= k)
    end subroutine contact_place

    !> The same of a number that may be none of a contact.
    subroutine find_contact(handle, i, side, k, first)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells: `st_bad_argument`
        integer, intent(in) :: i                         !! as the caller counts them
        integer, intent(out) :: side                     !! `side_right`, `side_left`
        integer, intent(out) :: k                        !! of its wheel
        integer, intent(in), optional :: first           !! the caller's first number; absent: 1

        integer :: at

        at = i
        if (present(first)) at = i - first + 1
        call clear_status(handle%status)
        side = side_right
        k = 0
        if (at < 1 .or. at > contact_count(handle)) then
            call set_status(handle%status, st_bad_argument, 'there is no such contact: ' &
                            // count_text(i))
        else
            call contact_place(handle, at, side, k)
            if (handle%result%wheel(side)%solutions == 0) &
                call set_status(handle%status, st_bad_argument, 'a contact by a lookup table has ' &
                                // 'no strips, elements or wear')
        end if
    end subroutine find_contact

    !> The mirror that the contacts of a side were solved in.
    pure type(mirror_t) function contact_mirror(handle, side)
        type(wheelset_handle_t), intent(in) :: handle !! solved
        integer, intent(in) :: side                   !! `side_right`, `side_left`

        contact_mirror = mirror_t(y=side == side_left, x=handle%workspace%is_reversed(side))
    end function contact_mirror
end module faststrip_interop_wheelset_handle
