!> A wheel at a height: its outline, and the forces of all its contacts, by strips, by its table,
!> or by both where the one hands over to the other.
module faststrip_wheelset_height
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, number_text, st_no_contact
    use faststrip_geometry_wheel_outline, only: move_outline, lowest_height
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, mirrored_state, reversed_state
    use faststrip_wheelset_lookup, only: look_up_at_height
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, wheel_result_t, &
                                        side_right, side_left
    use faststrip_wheelset_wheel, only: solve_wheel_at, add_contacts
    implicit none
    private

    public :: set_outline, try_height, try_table, as_right
    public :: wheel_sums_t, sums_of, hand_over

    !> The sums of a wheel.
    type :: wheel_sums_t
        real(wp) :: force(3) = 0.0_wp           !! as of `wheel_result_t`, N
        real(wp) :: force_wheelset(3) = 0.0_wp  !! the same, N
        real(wp) :: moment(3) = 0.0_wp          !! the same, N mm
    end type wheel_sums_t

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
            call move_outline(outline, as_right(workspace, state, side), model%radius)
            call lowest_height(outline, model%pair(side), touch)
        end associate
        if (touch >= huge(touch)) &
            call set_status(status, st_no_contact, 'wheel and rail do not overlap at y ' // &
                            trim(number_text(state%y)) // ' mm of the wheelset')
    end subroutine set_outline

    !> The state as a right wheel has it that rolls ahead.
    pure type(wheelset_state_t) function as_right(workspace, state, side)
        type(wheelset_workspace_t), intent(in) :: workspace !! knows which wheel rolls backwards
        type(wheelset_state_t), intent(in) :: state         !! mm, rad, s
        integer, intent(in) :: side                         !! `side_right` or `side_left`

        as_right = state
        if (side == side_left) as_right = mirrored_state(as_right)
        if (workspace%is_reversed(side)) as_right = reversed_state(as_right)
    end function as_right

    !> One wheel at a height by its table.
    subroutine try_table(model, workspace, state, side, z, wheel, share)
        type(wheelset_model_t), intent(in) :: model         !! made
        type(wheelset_workspace_t), intent(in) :: workspace !! of the wheelset
        type(wheelset_state_t), intent(in) :: state         !! its z does not count, mm, rad
        integer, intent(in) :: side                         !! `side_right` or `side_left`
        real(wp), intent(in) :: z                           !! of the wheelset's centre, mm
        type(wheel_result_t), intent(inout) :: wheel        !! as of a right wheel
        real(wp), intent(out) :: share                      !! that the table has there, 0: none

        share = 0.0_wp
        if (associated(model%lookup)) &
            call look_up_at_height(model, model%pair(side), as_right(workspace, state, side), z, &
                                   wheel, share)
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

        type(wheel_sums_t) :: sums
        real(wp) :: share

        share = 0.0_wp
        if (.not. present(by_strips)) call try_table(model, workspace, state, side, z, wheel, share)
        if (share >= 1.0_wp .and. .not. present(neighbour)) then
            ! What strips left behind is of another state.
            workspace%wheel(side)%n = 0
            return
        end if
        if (share > 0.0_wp) sums = sums_of(wheel)
        call solve_wheel_at(model, model%pair(side), workspace%wheel(side), &
                            as_right(workspace, state, side), z, wheel, neighbour)
        wheel%z = z
        if (share > 0.0_wp) call hand_over(sums, share, wheel)
    end subroutine try_height

    !> The sums of a wheel.
    pure type(wheel_sums_t) function sums_of(wheel)
        type(wheel_result_t), intent(in) :: wheel !! solved

        sums_of = wheel_sums_t(wheel%force, wheel%force_wheelset, wheel%moment)
    end function sums_of

    !> Strips and a table share the forces of a wheel. What the table adds is of the contact that
    !> carries most.
    pure subroutine hand_over(sums, share, wheel)
        type(wheel_sums_t), intent(in) :: sums       !! of the table
        real(wp), intent(in) :: share                !! that it has, 0 to 1
        type(wheel_result_t), intent(inout) :: wheel !! by strips; gets the sums of both

        if (wheel%n == 0) return
        associate (contact => wheel%contact(maxloc(wheel%contact(:wheel%n)%force(3), dim=1)))
            contact%force = contact%force + share*(sums%force - wheel%force)
            contact%force_wheelset = contact%force_wheelset &
                                     + share*(sums%force_wheelset - wheel%force_wheelset)
            contact%moment = contact%moment + share*(sums%moment - wheel%moment)
        end associate
        call add_contacts(wheel)
    end subroutine hand_over
end module faststrip_wheelset_height
