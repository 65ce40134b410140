!> Temperatures, of rows of a batch.
module faststrip_command_settings_thermal
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_case, only: contact_case_t
    use faststrip_files_csv, only: csv_table_t
    use faststrip_command_settings_friction, only: read_row_values
    use faststrip_command_settings_methods, only: settings_t, put_setting
    use faststrip_command_settings_table, only: thermal_settings, value_t
    implicit none
    private

    public :: read_row_thermal, thermal_columns

    !> The columns that a table may have for it.
    character(len=*), parameter :: thermal_columns(size(thermal_settings)) = thermal_settings%key

contains

    !> What makes the contact of a row warm; temperatures are asked for where any of it is given.
    subroutine read_row_thermal(table, row, case, status)
        type(csv_table_t), intent(in) :: table   !! a table that was read
        integer, intent(in) :: row               !! of it
        type(contact_case_t), intent(inout) :: case !! gets what is given
        type(status_t), intent(out) :: status    !! those of `read_row_values`

        type(settings_t) :: warm
        type(value_t) :: values(size(thermal_settings))
        integer :: i

        call read_row_values(table, row, thermal_columns, thermal_settings, values, status)
        if (is_error(status)) return
        warm%thermal = case%thermal
        do i = 1, size(values)
            if (.not. values(i)%is_given) cycle
            call put_setting(warm, trim(thermal_columns(i)), values(i))
            case%asked%temperatures = .true.
        end do
        case%thermal = warm%thermal
    end subroutine read_row_thermal
end module faststrip_command_settings_thermal
