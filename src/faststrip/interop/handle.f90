!> What stands behind the handles of the C and F77 interfaces: a workspace, a field and the words of
!> the last call, in one piece that the caller makes and frees, and names by a number of the
!> register.
module faststrip_interop_handle
    use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_intptr_t, c_loc, c_ptr
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_friction, only: check_friction, friction_at_angle
    use faststrip_base_friction_table, only: over_angle
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_not_finite, &
                                     st_workspace_too_small, st_ok
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: contact_methods_t, tangential_none
    use faststrip_contact_plausible, only: doubts_t, gap_size_t, case_names_t, gap_size, &
                                           find_doubts, doubt_pressure
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field, &
                                         reserve_contact_loads
    use faststrip_contact_derivatives, only: find_contact_derivatives
    use faststrip_contact_solve, only: solve_contact, set_contact_gap
    use faststrip_interop_register, only: enter_register, leave_register, look_up_register, &
                                          kind_contact
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: handle_t, new_handle, free_handle, find_handle, handle_gap, handle_solve, copy_handle
    public :: handle_derivatives

    !> One caller's workspace.
    type :: handle_t
        type(workspace_t) :: workspace
        type(contact_case_t) :: case      !! filled in anew for every call, without a gap; but that
                                          !! the F77 interface sets friction, how errors are
                                          !! estimated and what is wanted of auto once
        real(wp) :: contact_angle = 0.0_wp !! for friction of tread and flange, rad
        type(contact_result_t) :: result  !! figures of the last contact
        type(status_t) :: status          !! of the last call
        integer :: limitations = 0        !! of the last contact, as `status_t` has them
        type(gap_size_t) :: gap_size      !! of the gap
        type(doubts_t) :: doubts          !! what was outside of practice in the last contact
    end type handle_t

contains

    !> Make a handle with capacity for methods, gaps of up to `max_points` points and, if wanted,
    !> the elements, from which stresses follow; without tractions these need none. The one
    !> allocation.
    subroutine new_handle(methods, max_points, with_field, number, status)
        type(contact_methods_t), intent(in) :: methods !! what will be asked of it
        integer, intent(in) :: max_points              !! points of a gap
        logical, intent(in) :: with_field              !! are the elements wanted?
        integer(c_intptr_t), intent(out) :: number     !! of the handle; 0 when there is an error
        type(status_t), intent(out) :: status
            !! those of `reserve_workspace`, `reserve_contact_field`

        type(handle_t), pointer :: handle
        integer :: failure

        number = 0
        allocate (handle, stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a workspace')
            return
        end if
        call reserve_workspace(handle%workspace, methods, max_points, status)
        if (with_field .and. .not. is_error(status)) &
            call reserve_contact_field(handle%workspace, methods, status)
        if ((with_field .or. methods%tangential == tangential_none) .and. .not. is_error(status)) &
            call reserve_contact_loads(handle%workspace, methods, status)
        if (.not. is_error(status)) &
            call enter_register(c_loc(handle), kind_contact, number, status)
        if (is_error(status)) deallocate (handle)
    end subroutine new_handle

    !> Free a handle; nothing happens to what is none.
    subroutine free_handle(number, status)
        integer(c_intptr_t), intent(in) :: number !! as the caller passed it
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no handle, or freed

        type(handle_t), pointer :: handle
        type(c_ptr) :: address

        call leave_register(number, kind_contact, address, status)
        if (is_error(status)) return
        call c_f_pointer(address, handle)
        deallocate (handle)
    end subroutine free_handle

    !> The handle of a number.
    subroutine find_handle(number, handle, code)
        integer(c_intptr_t), intent(in) :: number      !! as the caller passed it
        type(handle_t), pointer, intent(out) :: handle !! null if it is none
        integer(c_int), intent(out) :: code !! `st_bad_argument`: no handle, or freed

        type(c_ptr) :: address
        type(status_t) :: status

        handle => null()
        call look_up_register(number, kind_contact, address, status)
        code = status%code
        if (code == st_ok) call c_f_pointer(address, handle)
    end subroutine find_handle

    !> Hand a gap over.
    subroutine handle_gap(handle, y, h, inv2r, inclination)
        type(handle_t), intent(inout) :: handle         !! its status tells how it ended
        real(wp), intent(in) :: y(:), h(:), inv2r(:)    !! mm, mm, 1/mm
        real(wp), intent(in), optional :: inclination(:)       !! rad

        type(environment_t) :: environment

        handle%result = contact_result_t()
        handle%limitations = 0
        handle%doubts%n = 0
        handle%gap_size = gap_size_t()
        call set_contact_gap(handle%workspace, y, h, inv2r, handle%status, inclination)
        if (is_error(handle%status)) return
        call hold_environment(environment)
        handle%gap_size = gap_size(y, h, inv2r)
        call restore_environment(environment)
    end subroutine handle_gap

    !> Solve the handle's case on the gap that was handed over; its result has the figures.
    subroutine handle_solve(handle)
        type(handle_t), intent(inout) :: handle !! its status tells how it ended

        type(environment_t) :: environment

        handle%workspace%field%n = 0
        handle%limitations = 0
        handle%doubts%n = 0
        call hold_environment(environment)
        call find_doubts(handle%case, handle%gap_size, case_names_t(), handle%doubts)
        call restore_environment(environment)
        call take_angle(handle)
        if (is_error(handle%status)) return
        handle%case%asked%strip_forces = .true.
        call solve_contact(handle%workspace, handle%case, handle%result, handle%status)
        if (is_error(handle%status)) return
        handle%limitations = handle%status%limitations
        call hold_environment(environment)
        call doubt_pressure('pmax', handle%result%normal%pmax, handle%doubts)
        call restore_environment(environment)
    end subroutine handle_solve

    !> Derivatives at the last contact of a handle.
    subroutine handle_derivatives(handle, derivatives)
        type(handle_t), intent(inout) :: handle    !! its status tells how it ended
        real(wp), intent(out) :: derivatives(4, 4) !! as `find_contact_derivatives` has them

        call find_contact_derivatives(handle%workspace, handle%case, handle%result, derivatives, &
                                      handle%status)
    end subroutine handle_derivatives

    !> The coefficient of friction of the contact's angle.
    subroutine take_angle(handle)
        type(handle_t), intent(inout) :: handle

        type(environment_t) :: environment

        call clear_status(handle%status)
        if (handle%case%friction%table%n /= 0) &
            handle%case%friction%table%angle = handle%contact_angle
        if (.not. (handle%case%friction%flange_share /= 1.0_wp .or. &
                   handle%case%friction%table%over == over_angle)) return
        call hold_environment(environment)
        call check_friction(handle%case%friction, handle%status)
        if (.not. is_error(handle%status)) then
            if (ieee_is_finite(handle%contact_angle)) then
                handle%case%mu = friction_at_angle(handle%case%friction, handle%case%mu, &
                                                   handle%contact_angle)
            else
                call set_status(handle%status, st_not_finite, 'the contact angle is not finite')
            end if
        end if
        call restore_environment(environment)
        if (.not. is_error(handle%status)) return
        handle%result = contact_result_t()
        handle%workspace%solved_by = 0
    end subroutine take_angle

    !> Copy gap, solution and elements of one handle into another; the other's capacity becomes the
    !> same.
    subroutine copy_handle(from, to)
        type(handle_t), intent(in) :: from  !! stays as it is
        type(handle_t), intent(inout) :: to !! becomes equal

        to%workspace = from%workspace
        to%case = from%case
        to%contact_angle = from%contact_angle
        to%result = from%result
        to%limitations = from%limitations
        to%gap_size = from%gap_size
        to%doubts = from%doubts
        call clear_status(to%status)
    end subroutine copy_handle
end module faststrip_interop_handle
