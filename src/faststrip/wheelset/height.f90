!> A wheel at a height: its outline, and the forces of all its contacts.
module faststrip_wheelset_height
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, number_text, st_no_contact
    use faststrip_geometry_wheel_outline, only: move_outline, lowest_height
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, mirrored_state
    use faststrip_wheelset_lookup, only: look_up_at_height
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, wheel_result_t, &
                                        side_right, side_left
    use faststrip_wheelset_wheel, only: solve_wheel_at
    implicit none
    private

    public :: set_outline, try_height, try_table, as_right

contains

    !> The outline of a wheel, with z = 0, and at which z it first touches.
    subroutine set_outline(model, workspace, state, side, touch, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! its z does not count, mm, rad
        integer, intent(in) :: side                            !! `side_right` or `side_left`
        real(wp), intent(out) :: touch                         !! z of first touch, mm
        type(status_t), intent(inout) :: status                !! `st_no_contact`

        associate (outline => workspace%wheel(side)%outline)
            call move_outline(outline, as_right(state, side), model%radius)
            call lowest_height(outline, model%pair(side), touch)
        end associate
        if (touch >= huge(touch)) &
            call set_status(status, st_no_contact, 'wheel and rail do not overlap at y ' // &
                            trim(number_text(state%y)) // ' mm of the wheelset')
    end subroutine set_outline

    !> The state as a right wheel has it.
    pure type(wheelset_state_t) function as_right(state, side)
        type(wheelset_state_t), intent(in) :: state !! mm, rad, s
        integer, intent(in) :: side                 !! `side_right` or `side_left`

        as_right = state
        if (side == side_left) as_right = mirrored_state(state)
    end function as_right

    !> One wheel at a height by its table.
    subroutine try_table(model, workspace, state, side, z, wheel, is_there)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! its z does not count, mm, rad
        integer, intent(in) :: side                            !! `side_right` or `side_left`
        real(wp), intent(in) :: z                              !! of the wheelset's centre, mm
        type(wheel_result_t), intent(inout) :: wheel           !! as of a right wheel
        logical, intent(out) :: is_there                       !! has it a table that reaches there?

        is_there = associated(model%lookup)
        if (is_there) call look_up_at_height(model, model%pair(side), as_right(state, side), z, &
                                             wheel, is_there)
        ! What strips left behind is of another state.
        if (is_there) workspace%wheel(side)%n = 0
    end subroutine try_table

    !> One wheel at a height, by its table where that reaches, without estimates.
    subroutine try_height(model, workspace, state, side, z, wheel, neighbour, by_strips)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! with the outline of the state
        type(wheelset_state_t), intent(in) :: state            !! its z does not count, mm, rad
        integer, intent(in) :: side                            !! `side_right` or `side_left`
        real(wp), intent(in) :: z                              !! of the wheelset's centre, mm
        type(wheel_result_t), intent(inout) :: wheel           !! as of a right wheel
        real(wp), intent(in), optional :: neighbour            !! as of `solve_wheel_at`
        logical, intent(in), optional :: by_strips             !! if present no table is asked

        logical :: is_there

        is_there = .false.
        if (.not. (present(neighbour) .or. present(by_strips))) &
            call try_table(model, workspace, state, side, z, wheel, is_there)
        if (is_there) return
        call solve_wheel_at(model, model%pair(side), workspace%wheel(side), &
                            as_right(state, side), z, wheel, neighbour)
        wheel%z = z
    end subroutine try_height
end module faststrip_wheelset_height
