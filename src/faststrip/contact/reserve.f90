!> Memory of a contact's workspace: the only allocation.
module faststrip_contact_reserve
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_limits, only: most_gap_points => most_points
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_normal_strip, only: strips_auto_most
    use faststrip_normal_strip_patches, only: max_patches
    use faststrip_normal_strips, only: reserve_strips
    use faststrip_stress_loads, only: reserve_loads
    use faststrip_tangential_types, only: reserve_field
    use faststrip_contact_method, only: workspace_t, normal_method_t, tangential_method_t
    use faststrip_contact_method_capacity, only: strip_capacity, reserve_for_strips, &
                                                 try_memory, per_point, per_strip, per_element
    use faststrip_contact_method_core, only: enter_core_methods
    use faststrip_contact_methods, only: contact_methods_t, normal_auto, normal_strip
    use faststrip_contact_parts, only: find_normal_method, check_methods, refuse_elements
    implicit none
    private

    public :: reserve_workspace, reserve_contact_field, reserve_contact_loads

contains

    !> Allocate for the methods and for gaps of up to `max_points` points: the only allocation. The
    !> core's methods are entered; those of others are entered before or afterwards.
    !>
    !> A workspace with capacity for strips serves every normal method up to its number of strips;
    !> one for `normal_auto` has capacity for as many as it may take.
    subroutine reserve_workspace(workspace, methods, max_points, status)
        type(workspace_t), intent(inout) :: workspace  !! sized
        type(contact_methods_t), intent(in) :: methods !! what will be asked of it
        integer, intent(in) :: max_points              !! points of a gap, 5 to `most_gap_points`
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; `st_workspace_too_small`, not enough memory

        class(normal_method_t), pointer :: method
        class(tangential_method_t), pointer :: tangential
        integer :: capacity

        call enter_core_methods(workspace, status)
        if (.not. is_error(status)) &
            call check_methods(workspace, methods, method, tangential, status)
        if (is_error(status)) return
        if (max_points < min_gap_points .or. max_points > most_gap_points) then
            call set_status(status, st_bad_argument, 'capacity for gap points must be 5 to a ' // &
                            'million, got ' // count_text(max_points))
            return
        end if
        capacity = strip_capacity(methods)
        ! Tried as a whole first: what the parts find missing would stop the program.
        call try_memory(per_point*max_points + per_strip*capacity, 'workspace', status)
        if (is_error(status)) return
        workspace%solved_by = 0
        call reserve_for_strips(workspace, capacity, status)
        if (.not. is_error(status) .and. methods%normal == normal_auto) &
            call reserve_strips(workspace%best_strips, capacity, status)
        if (is_error(status)) return
        ! Auto works in what strips need.
        if (.not. associated(method)) &
            call find_normal_method(workspace, normal_strip, method, status)
        if (.not. is_error(status)) call method%reserve(workspace, methods, max_points, status)
    end subroutine reserve_workspace

    !> Allocate the workspace's field for the elements of a tangential method.
    subroutine reserve_contact_field(workspace, methods, status)
        type(workspace_t), intent(inout) :: workspace    !! its field is sized
        type(contact_methods_t), intent(in) :: methods   !! what will be asked for
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; `st_workspace_too_small`, not enough memory

        class(normal_method_t), pointer :: normal
        class(tangential_method_t), pointer :: method
        integer(int64) :: elements

        call check_methods(workspace, methods, normal, method, status)
        if (is_error(status)) return
        if (.not. method%about%gives_elements) then
            call refuse_elements(method%about, status)
            return
        end if
        elements = element_capacity(methods)
        call try_elements(elements, status)
        if (.not. is_error(status)) call reserve_field(workspace%field, int(elements), status)
    end subroutine reserve_contact_field

    !> Allocate for what stresses below the surface follow from: the loads of a contact. Where there
    !> is a tangential method they need the field too.
    subroutine reserve_contact_loads(workspace, methods, status)
        type(workspace_t), intent(inout) :: workspace    !! its loads are sized
        type(contact_methods_t), intent(in) :: methods   !! checked
        type(status_t), intent(out) :: status            !! `st_workspace_too_small`

        integer(int64) :: elements

        call clear_status(status)
        elements = element_capacity(methods)
        call try_elements(elements, status)
        if (.not. is_error(status)) call reserve_loads(workspace%loads, int(elements), status)
    end subroutine reserve_contact_loads

    !> Room for the elements of all patches.
    pure integer(int64) function element_capacity(methods)
        type(contact_methods_t), intent(in) :: methods ! checked

        integer :: points

        points = methods%points_per_strip
        if (methods%normal == normal_auto) points = max(points, strips_auto_most)
        element_capacity = max(int(strip_capacity(methods), int64)*points, &
                               int(methods%fastsim_nx, int64)*methods%fastsim_ny*max_patches)
    end function element_capacity

    !> Is there memory for elements?
    subroutine try_elements(elements, status)
        integer(int64), intent(in) :: elements
        type(status_t), intent(inout) :: status ! gets `st_workspace_too_small`

        if (elements < huge(0)) then
            call try_memory(per_element*elements, 'field', status)
        else
            call set_status(status, st_workspace_too_small, 'not enough memory for a field')
        end if
    end subroutine try_elements
end module faststrip_contact_reserve
