!> The columns of a batch file for friction that is not one number.
module faststrip_command_batch_friction
    use faststrip_base_friction, only: friction_t, friction_constant, friction_kind, &
                                       friction_kind_names
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_bad_argument
    use faststrip_base_text, only: lower_case
    use faststrip_command_settings_methods, only: one_of
    use faststrip_files_csv, only: csv_table_t, column_index, cell_text, cell_number
    implicit none
    private

    public :: read_row_friction, friction_columns

    character(len=*), parameter :: kind_column = 'friction_kind'
    character(len=*), parameter :: number_columns(4) = [character(len=20) :: &
        'mu_kinetic', 'half_slip_speed_mm_s', 'initial_slope_factor', 'speed_mm_s']
    !> The columns that a table may have for it.
    character(len=*), parameter :: friction_columns(5) = [character(len=20) :: &
        kind_column, number_columns]
    ! Where they are.
    integer, parameter :: at_kinetic = 1, at_half = 2, at_slope = 3, at_speed = 4

contains

    !> The friction of a row; an empty cell, or a column that is not there, is not given.
    subroutine read_row_friction(table, row, mu, law, status)
        type(csv_table_t), intent(in) :: table !! a table that was read
        integer, intent(in) :: row             !! of it
        real(wp), intent(in) :: mu             !! the static value
        type(friction_t), intent(inout) :: law !! gets what is given
        type(status_t), intent(out) :: status  !! `st_bad_argument`, those of `cell_number`

        character(len=:), allocatable :: kind
        real(wp) :: number(size(number_columns))
        logical :: given(size(number_columns))
        integer :: i, column

        call clear_status(status)
        kind = lower_case(cell_text(table, row, column_index(table, kind_column)))
        if (len(kind) > 0) then
            law%kind = friction_kind(kind)
            if (law%kind < 0) then
                call set_status(status, st_bad_argument, kind_column // ' must be ' // &
                                one_of(friction_kind_names) // ", got '" // kind // "'")
                return
            end if
        end if
        do i = 1, size(number_columns)
            column = column_index(table, trim(number_columns(i)))
            given(i) = len(cell_text(table, row, column)) > 0
            if (.not. given(i)) cycle
            call cell_number(table, row, column, number(i), status)
            if (.not. is_error(status) .and. number(i) <= 0.0_wp) call refuse(i, 'must be above 0')
            if (is_error(status)) return
        end do
        do i = 1, size(number_columns)
            if (i == at_slope) cycle
            if (law%kind == friction_constant) then
                if (given(i) .and. i /= at_speed) &
                    call refuse(i, 'must be empty with constant friction')
            else if (.not. given(i)) then
                call refuse(i, 'must be given with falling friction')
            end if
            if (is_error(status)) return
        end do
        if (given(at_kinetic)) then
            if (number(at_kinetic) > mu) then
                call refuse(at_kinetic, 'must be at most mu, the static value')
                return
            end if
            law%kinetic_share = number(at_kinetic)/mu
            law%half_slip_speed = number(at_half)
        end if
        if (given(at_slope)) then
            if (number(at_slope) > 1.0_wp) call refuse(at_slope, 'must be at most 1')
            law%slope_factor = number(at_slope)
        end if
        if (given(at_speed)) law%speed = number(at_speed)

    contains

        subroutine refuse(i, what)
            integer, intent(in) :: i
            character(len=*), intent(in) :: what

            call set_status(status, st_bad_argument, trim(number_columns(i)) // ' ' // what &
                            // ", got '" // cell_text(table, row, column_index( &
                            table, trim(number_columns(i)))) // "'")
        end subroutine refuse
    end subroutine read_row_friction
end module faststrip_command_batch_friction
