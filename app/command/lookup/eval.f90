!> `faststrip lookup eval`: forces of a table at the states of a CSV file.
module faststrip_command_lookup_eval
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, set_status, status_word, number_text, &
                                     st_bad_argument
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: fail, fail_on_error, note, exit_bad_input, &
                                                 progress, begin_table, end_table
    use faststrip_command_lookup_file, only: read_table
    use faststrip_command_lookup_columns, only: hertz_columns, wheel_columns, contact_columns, &
                                                force_columns, hertz_names, wheel_names
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_word
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, &
                                   column_index, cell_text, cell_number, put_cell, end_row
    use faststrip_lookup_faces, only: n_forces, lookup_linear, lookup_cubic
    use faststrip_lookup_hertz, only: look_up_hertz, n_lookup_state
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel, n_contact_numbers, most_slots
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, n_wheel_place, n_wheel_state
    implicit none
    private

    public :: run_lookup_eval

    ! Characters of the name of a column, at most.
    ! Given: the longest.
    integer, parameter :: name_length = 17

contains

    !> Run the action from the command line.
    subroutine run_lookup_eval()
        type(command_t) :: command
        type(csv_table_t) :: states
        type(csv_writer_t) :: writer
        type(lookup_t) :: lookup
        type(status_t) :: status
        ! As many as a state of either kind has.
        real(wp) :: numbers(n_lookup_state)
        integer, allocatable :: column(:)
        character(len=name_length), allocatable :: needed(:), new(:)
        integer :: i, row, order, n_failed
        logical :: with_jacobian, is_wheel

        command%name = 'lookup eval'
        command%n_words = 2
        command%usage = 'TABLE.fslt STATES.csv'
        command%about = &
            'Forces on the rail at the states of a CSV file with the columns' // new_line('a') &
            // 'a_mm,b_mm,N_N,mu,G_MPa,cksi,ceta,cphi_rad_per_mm; others are carried through.' &
            // new_line('a') // 'Adds Fx_N,Fy_N,Mz_Nmm,status. A row that fails gets its status' &
            // ' word and empty' // new_line('a') // 'figures; the exit code is then 1.' &
            // ' With the table of a wheel: y_mm,yaw_rad,' // new_line('a') &
            // 'load_N,mu,cksi,ceta,cphi_rad_per_mm,slot; the numbers of the contact are added,' &
            // ' too.' // new_line('a')
        command%options = [ &
            option_t('--order', 'NAME', 'interpolation: linear or cubic (default linear; of the' &
                     // new_line('a') // 'table of a wheel cubic)'), &
            option_t('--jacobian', '', 'add the derivatives, as dFx_dcksi, in units of both'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 2)
        with_jacobian = given(command, '--jacobian')
        call read_table(command%arguments(1)%text, lookup)
        call read_csv(command%arguments(2)%text, states, status)
        call fail_on_error(status)
        is_wheel = lookup%kind == lookup_kind_wheel
        order = lookup_linear
        if (option_word(command, '--order', trim(merge('cubic ', 'linear', is_wheel)), &
                        [character(len=6) :: 'linear', 'cubic']) == 'cubic') order = lookup_cubic
        if (is_wheel) then
            needed = [character(len=name_length) :: wheel_columns, 'slot']
            new = [character(len=name_length) :: contact_columns, force_columns, 'status']
            if (with_jacobian) new = [new, derivatives(wheel_names)]
        else
            needed = [character(len=name_length) :: hertz_columns]
            new = [character(len=name_length) :: force_columns, 'status']
            if (with_jacobian) new = [new, derivatives(hertz_names)]
        end if
        call find_columns(states, needed, new, column)
        call begin_table(writer, option_text(command, '-o', '-'))
        do i = 1, states%n_columns
            call put_cell(writer, states%names(i)%text)
        end do
        do i = 1, size(new)
            call put_cell(writer, trim(new(i)))
        end do
        call end_row(writer)
        n_failed = 0
        do row = 1, states%n_rows
            do i = 1, states%n_columns
                call put_cell(writer, cell_text(states, row, i))
            end do
            do i = 1, size(column)
                call cell_number(states, row, column(i), numbers(i), status)
                if (is_error(status)) exit
            end do
            if (is_wheel) then
                call put_wheel(lookup, order, numbers, with_jacobian, writer, status)
            else
                call put_hertz(lookup, order, numbers, with_jacobian, writer, status)
            end if
            call end_row(writer)
            if (is_error(status)) then
                n_failed = n_failed + 1
                call note('row ' // integer_text(row) // ' (' // states%file // ':' &
                          // integer_text(states%line(row)) // '): ' // trim(status%message))
            end if
            call progress('states', row, states%n_rows)
        end do
        call end_table(writer)
        if (n_failed > 0) call fail(exit_bad_input, integer_text(n_failed) // ' of ' &
                                    // integer_text(states%n_rows) // ' states failed')
    end subroutine run_lookup_eval

    !> The columns that are needed; ends the program if one is missing, or if one that will be added
    !> is there already.
    subroutine find_columns(states, needed, new, column)
        type(csv_table_t), intent(in) :: states
        character(len=*), intent(in) :: needed(:), new(:)
        integer, allocatable, intent(out) :: column(:)

        type(status_t) :: status
        integer :: i

        allocate (column(size(needed)), source=0)
        do i = 1, size(needed)
            call require_column(states, trim(needed(i)), column(i), status)
            call fail_on_error(status)
        end do
        do i = 1, size(new)
            if (column_index(states, trim(new(i))) > 0) &
                call fail(exit_bad_input, 'a column must not have the name of a result, got ' &
                          // trim(new(i)) // ' (' // states%file // ')')
        end do
    end subroutine find_columns

    ! Names of the derivatives of forces.
    pure function derivatives(by) result(names)
        character(len=*), intent(in) :: by(:)
        character(len=name_length) :: names(n_forces*size(by))

        integer :: i, k

        names = [character(len=name_length) :: &
                 (('d' // force_columns(k)(:2) // '_d' // by(i), k=1, n_forces), i=1, size(by))]
    end function derivatives

    ! Forces of a state of an ellipse; empty cells if there is an error, or was one before.
    subroutine put_hertz(lookup, order, state, with_jacobian, writer, status)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: order
        real(wp), intent(in) :: state(n_lookup_state)
        logical, intent(in) :: with_jacobian
        type(csv_writer_t), intent(inout) :: writer
        type(status_t), intent(inout) :: status

        real(wp) :: forces(n_forces), jacobian(n_forces, n_lookup_state)
        integer :: i, k

        if (.not. is_error(status)) &
            call look_up_hertz(lookup, order, state, forces, status, jacobian)
        do k = 1, n_forces
            call put_cell(writer, forces(k), .not. is_error(status))
        end do
        call put_cell(writer, trim(status_word(status%code)))
        if (.not. with_jacobian) return
        do i = 1, n_lookup_state
            do k = 1, n_forces
                call put_cell(writer, jacobian(k, i), .not. is_error(status))
            end do
        end do
    end subroutine put_hertz

    ! The contact and the creep forces of a state of a wheel; empty cells if there is an error, or
    ! was one before.
    subroutine put_wheel(lookup, order, numbers, with_jacobian, writer, status)
        type(lookup_t), intent(in) :: lookup             ! of a wheel
        integer, intent(in) :: order                     ! of interpolation
        real(wp), intent(in) :: numbers(n_wheel_state + 1) ! as `wheel_columns`, slot
        logical, intent(in) :: with_jacobian             ! are derivatives wanted?
        type(csv_writer_t), intent(inout) :: writer      ! gets cells
        type(status_t), intent(inout) :: status
            ! of reading the numbers; `st_bad_argument`: a slot that is not whole; those of
            ! `look_up_wheel`

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
end module faststrip_command_lookup_eval
