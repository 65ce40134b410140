!> `faststrip lookup eval` with the table of a wheel: the contact and the creep forces of a state.
module faststrip_command_lookup_wheel_eval
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, set_status, status_word, number_text, &
                                     st_bad_argument
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_cell
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: lookup_t, n_contact_numbers, most_slots
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, n_wheel_place, n_wheel_state
    implicit none
    private

    public :: wheel_names, put_wheel, wheel_columns, name_length

    !> What a table of states must have; beside it, `slot`: which contact.
    character(len=15), parameter :: wheel_columns(n_wheel_state) = [character(len=15) :: &
        'y_mm', 'yaw_rad', 'load_N', 'mu', 'cksi', 'ceta', 'cphi_rad_per_mm']
    ! Numbers of a contact.
    character(len=17), parameter :: contact_columns(n_contact_numbers) = [character(len=17) :: &
        'N_N', 'contact_angle_rad', 'y_rail_mm', 'z_rail_mm', 'x_track_mm', 'y_wheel_mm', &
        'radius_mm', 'z_mm', 'area_mm2', 'pmax_MPa', 'c_mm', 'L1_mm2', 'L2_mm2', 'L3_mm3']
    ! Creep forces.
    character(len=6), parameter :: force_columns(n_forces) = [character(len=6) :: &
        'Fx_N', 'Fy_N', 'Mz_Nmm']
    character(len=4), parameter :: by(n_wheel_state) = [character(len=4) :: &
        'y', 'yaw', 'load', 'mu', 'cksi', 'ceta', 'cphi']
    !> Characters of the name of a column, at most.
    !> Given: the longest.
    integer, parameter :: name_length = 17

contains

    !> Columns of a state, and of what is found for it.
    subroutine wheel_names(with_jacobian, needed, new)
        logical, intent(in) :: with_jacobian !! are derivatives wanted?
        character(len=name_length), allocatable, intent(out) :: needed(:) !! of a state
        character(len=name_length), allocatable, intent(out) :: new(:)    !! that are added

        integer :: i, k

        needed = [character(len=name_length) :: wheel_columns, 'slot']
        new = [character(len=name_length) :: contact_columns, force_columns, 'status']
        if (with_jacobian) &
            new = [character(len=name_length) :: new, &
                   (('d' // force_columns(k)(:2) // '_d' // by(i), k=1, n_forces), &
                    i=1, n_wheel_state)]
    end subroutine wheel_names

    !> Write what is found for a state; empty cells if there is an error, or was one before.
    subroutine put_wheel(lookup, order, numbers, with_jacobian, writer, status)
        type(lookup_t), intent(in) :: lookup             !! of a wheel
        integer, intent(in) :: order                     !! of interpolation
        real(wp), intent(in) :: numbers(n_wheel_state + 1) !! as `wheel_columns`, slot
        logical, intent(in) :: with_jacobian             !! are derivatives wanted?
        type(csv_writer_t), intent(inout) :: writer      !! gets cells
        type(status_t), intent(inout) :: status
            !! of reading the numbers; `st_bad_argument`: a slot that is not whole; those of
            !! `look_up_wheel`

        real(wp) :: contacts(n_contact_numbers, most_slots)
        real(wp) :: forces(n_forces), jacobian(n_forces, n_wheel_state)
        integer :: i, k, slot
        logical :: is_good

        slot = 1
        if (.not. is_error(status)) call take_slot(numbers(n_wheel_state + 1), slot, status)
        if (.not. is_error(status)) &
            call look_up_wheel(lookup, order, slot, numbers(:n_wheel_state), forces, status, &
                               jacobian)
        if (.not. is_error(status)) &
            call look_up_contacts(lookup, order, numbers(:n_wheel_place), contacts, status)
        is_good = .not. is_error(status)
        if (.not. is_good) slot = 1
        do i = 1, n_contact_numbers
            call put_cell(writer, contacts(i, slot), is_good)
        end do
        do k = 1, n_forces
            call put_cell(writer, forces(k), is_good)
        end do
        call put_cell(writer, trim(status_word(status%code)))
        if (.not. with_jacobian) return
        do i = 1, n_wheel_state
            do k = 1, n_forces
                call put_cell(writer, jacobian(k, i), is_good)
            end do
        end do
    end subroutine put_wheel

    ! A number as a slot.
    subroutine take_slot(number, slot, status)
        real(wp), intent(in) :: number
        integer, intent(inout) :: slot
        type(status_t), intent(inout) :: status

        if (number >= 1.0_wp .and. number <= most_slots) slot = nint(number)
        if (abs(number - slot) <= 0.0_wp) return
        call set_status(status, st_bad_argument, 'slot must be a whole number from 1 to ' &
                        // trim(integer_text(most_slots)) // ', got ' // number_text(number))
    end subroutine take_slot
end module faststrip_command_lookup_wheel_eval
