!> `faststrip lookup eval` with the table of a wheel: contacts and creep forces of states of a CSV
!> file.
module faststrip_command_lookup_wheel_eval
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_command_console, only: fail, fail_on_error, note, put_origin, exit_bad_input, &
                                         progress
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, csv_text_t, require_column, &
                                   column_index, cell_text, cell_number, open_csv, put_cell, &
                                   end_row, close_csv
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_table, only: lookup_t, n_contact_numbers, most_slots
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, n_wheel_place, n_wheel_state
    implicit none
    private

    public :: eval_wheel, wheel_columns, contact_columns, force_columns

    !> What a table of states must have; beside it, `slot`: which contact.
    character(len=15), parameter :: wheel_columns(n_wheel_state) = [character(len=15) :: &
        'y_mm', 'yaw_rad', 'load_N', 'mu', 'cksi', 'ceta', 'cphi_rad_per_mm']
    !> Numbers of a contact.
    character(len=17), parameter :: contact_columns(n_contact_numbers) = [character(len=17) :: &
        'N_N', 'contact_angle_rad', 'y_rail_mm', 'z_rail_mm', 'x_track_mm', 'y_wheel_mm', &
        'radius_mm', 'z_mm', 'area_mm2', 'pmax_MPa', 'c_mm', 'L1_mm2', 'L2_mm2', 'L3_mm3']
    !> Creep forces.
    character(len=6), parameter :: force_columns(n_forces) = [character(len=6) :: &
        'Fx_N', 'Fy_N', 'Mz_Nmm']
    character(len=4), parameter :: by(n_wheel_state) = [character(len=4) :: &
        'y', 'yaw', 'load', 'mu', 'cksi', 'ceta', 'cphi']
    integer, parameter :: name_length = 17

contains

    !> Look all rows of a table up.
    subroutine eval_wheel(lookup, states, order, with_jacobian, path)
        type(lookup_t), intent(in) :: lookup      !! of a wheel
        type(csv_table_t), intent(in) :: states   !! that was read
        integer, intent(in) :: order              !! of interpolation
        logical, intent(in) :: with_jacobian      !! are derivatives wanted?
        character(len=*), intent(in) :: path      !! of the file to be written

        character(len=name_length), allocatable :: new(:)
        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: column(n_wheel_state), slot_column, i, row, n_failed

        do i = 1, n_wheel_state
            call require_column(states, trim(wheel_columns(i)), column(i), status)
            call fail_on_error(status)
        end do
        call require_column(states, 'slot', slot_column, status)
        call fail_on_error(status)
        call find_new_names(states, with_jacobian, new)
        call open_csv(writer, path, status)
        call fail_on_error(status)
        call put_origin(writer)
        do i = 1, states%n_columns
            call put_cell(writer, states%names(i)%text)
        end do
        do i = 1, size(new)
            call put_cell(writer, trim(new(i)))
        end do
        call end_row(writer)
        n_failed = 0
        do row = 1, states%n_rows
            call eval_row(lookup, states, row, [column, slot_column], order, with_jacobian, &
                          writer, status)
            if (is_error(status)) then
                n_failed = n_failed + 1
                call note('row ' // integer_text(row) // ' (' // states%file // ':' &
                          // integer_text(states%line(row)) // '): ' // trim(status%message))
            end if
            call progress('states', row, states%n_rows)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(states%n_rows) // ' states failed')
    end subroutine eval_wheel

    ! One row: what it has, then what was found.
    subroutine eval_row(lookup, states, row, column, order, with_jacobian, writer, status)
        type(lookup_t), intent(in) :: lookup
        type(csv_table_t), intent(in) :: states
        integer, intent(in) :: row, column(:), order
        logical, intent(in) :: with_jacobian
        type(csv_writer_t), intent(inout) :: writer
        type(status_t), intent(out) :: status

        real(wp) :: numbers(n_wheel_state + 1), contacts(n_contact_numbers, most_slots)
        real(wp) :: forces(n_forces), jacobian(n_forces, n_wheel_state)
        integer :: i, k, slot
        logical :: is_good

        do i = 1, size(column)
            call cell_number(states, row, column(i), numbers(i), status)
            if (is_error(status)) exit
        end do
        slot = 0
        if (.not. is_error(status)) then
            if (abs(numbers(n_wheel_state + 1)) < 100.0_wp) slot = nint(numbers(n_wheel_state + 1))
            call look_up_wheel(lookup, order, slot, numbers(:n_wheel_state), forces, status, &
                               jacobian)
        end if
        if (.not. is_error(status)) &
            call look_up_contacts(lookup, order, numbers(:n_wheel_place), contacts, status)
        is_good = .not. is_error(status)
        if (.not. is_good) slot = 1
        do i = 1, states%n_columns
            call put_cell(writer, cell_text(states, row, i))
        end do
        do i = 1, n_contact_numbers
            call put_cell(writer, contacts(i, slot), is_good)
        end do
        do k = 1, n_forces
            call put_cell(writer, forces(k), is_good)
        end do
        call put_cell(writer, trim(status_word(status%code)))
        if (with_jacobian) then
            do i = 1, n_wheel_state
                do k = 1, n_forces
                    call put_cell(writer, jacobian(k, i), is_good)
                end do
            end do
        end if
        call end_row(writer)
    end subroutine eval_row

    ! The names of the columns that are added; ends the program if one is there already.
    subroutine find_new_names(states, with_jacobian, new)
        type(csv_table_t), intent(in) :: states
        logical, intent(in) :: with_jacobian
        character(len=name_length), allocatable, intent(out) :: new(:)

        integer :: i, k

        new = [character(len=name_length) :: contact_columns, force_columns, 'status']
        if (with_jacobian) &
            new = [character(len=name_length) :: new, &
                   (('d' // force_columns(k)(:2) // '_d' // by(i), k=1, n_forces), &
                    i=1, n_wheel_state)]
        do i = 1, size(new)
            if (column_index(states, trim(new(i))) > 0) &
                call fail(exit_bad_input, 'a column must not have the name of a result, got ' &
                          // trim(new(i)) // ' (' // states%file // ')')
        end do
    end subroutine find_new_names
end module faststrip_command_lookup_wheel_eval
