!> Lists of methods and resolutions, CSV files of the reference folder: what benches compare.
module faststrip_lab_grid_method_list
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, read_csv, require_column, column_index, cell_text, &
                                   cell_integer, cell_number
    use faststrip_command_program_console, only: fail, fail_on_error, exit_bad_input
    use faststrip_contact_wanted, only: target_number, target_names
    use faststrip_command_settings_methods, only: settings_t, check_settings, settle_wanted, one_of
    use faststrip_contact_methods, only: contact_methods_t, normal_method, tangential_method, &
                                         normal_table, tangential_table
    implicit none
    private

    public :: method_entry_t, read_method_list

    !> One method at one resolution.
    type :: method_entry_t
        character(len=:), allocatable :: stage !! normal, tangential or both
        character(len=:), allocatable :: name  !! what the CSV calls it
        character(len=:), allocatable :: when  !! always, or full: not in the quick bench
        integer :: across = 0                  !! elements across the patch, norm, tang; 0: elements
                                               !! of the sides in `settings`
        type(settings_t) :: settings           !! what the program would be asked for
    end type method_entry_t

    character(len=*), parameter :: stages(3) = [character(len=10) :: 'normal', 'tangential', 'both']

contains

    !> Read a list of methods; ends the program at the first thing that is wrong.
    subroutine read_method_list(file, entries)
        character(len=*), intent(in) :: file !! CSV
        type(method_entry_t), allocatable, intent(out) :: entries(:)

        type(csv_table_t) :: table
        type(status_t) :: status
        character(len=:), allocatable :: what, range, value
        integer :: row

        call read_csv(file, table, status)
        call fail_on_error(status)
        allocate (entries(table%n_rows))
        do row = 1, table%n_rows
            entries(row)%stage = text('stage')
            entries(row)%name = text('method')
            entries(row)%when = text('when')
            if (all(stages /= entries(row)%stage)) &
                call refuse('stage', one_of(stages), entries(row)%stage)
            entries(row)%settings%methods%normal = normal_method(text('normal'))
            if (entries(row)%settings%methods%normal < 0) &
                call refuse('normal', one_of(normal_table%name), text('normal'))
            entries(row)%settings%methods%tangential = tangential_method(text('tangential'))
            if (entries(row)%settings%methods%tangential < 0) &
                call refuse('tangential', one_of(tangential_table%name), text('tangential'))
            call take_number('strips_per_patch', entries(row)%settings%methods%strips_per_patch)
            call take_number('points_per_strip', entries(row)%settings%methods%points_per_strip)
            call take_number('fastsim_nx', entries(row)%settings%methods%fastsim_nx)
            call take_number('fastsim_ny', entries(row)%settings%methods%fastsim_ny)
            call take_side(entries(row)%settings%methods)
            call take_wanted(entries(row))
            call check_settings(entries(row)%settings, 0.0_wp, what, range, value)
            if (len(what) > 0) call refuse(what, range, value)
            call settle_wanted(entries(row)%settings)
        end do

    contains

        function text(name)
            character(len=*), intent(in) :: name
            character(len=:), allocatable :: text

            integer :: column

            call require_column(table, name, column, status)
            call fail_on_error(status)
            text = cell_text(table, row, column)
        end function text

        !> An empty cell leaves the default.
        subroutine take_number(name, number)
            character(len=*), intent(in) :: name
            integer, intent(inout) :: number

            integer :: column

            if (text(name) == '') return
            call require_column(table, name, column, status)
            call cell_integer(table, row, column, number, status)
            call fail_on_error(status)
        end subroutine take_number

        !> A column that may be missing.
        function further(name)
            character(len=*), intent(in) :: name
            character(len=:), allocatable :: further

            further = cell_text(table, row, column_index(table, name))
        end function further

        !> What belongs to contacts of many sizes, and to auto.
        subroutine take_wanted(entry)
            type(method_entry_t), intent(inout) :: entry

            integer :: column

            if (further('across') /= '') then
                column = column_index(table, 'across')
                call cell_integer(table, row, column, entry%across, status)
                call fail_on_error(status)
                if (entry%across < 2) &
                    call refuse('across', 'a whole number from 2 on', further('across'))
            end if
            if (further('target') /= '') then
                entry%settings%wanted%target = target_number(further('target'))
                entry%settings%target_is_given = .true.
            end if
            if (entry%settings%wanted%target == 0) &
                call refuse('target', one_of(target_names), further('target'))
            if (further('tolerance') == '') return
            column = column_index(table, 'tolerance')
            call cell_number(table, row, column, entry%settings%wanted%tolerance, status)
            call fail_on_error(status)
        end subroutine take_wanted

        !> Elements are squares.
        subroutine take_side(methods)
            type(contact_methods_t), intent(inout) :: methods

            integer :: column

            if (further('element_mm') == '') return
            column = column_index(table, 'element_mm')
            call cell_number(table, row, column, methods%element_dx, status)
            call fail_on_error(status)
            methods%element_dy = methods%element_dx
            methods%dx_is_given = .true.
            methods%dy_is_given = .true.
        end subroutine take_side

        subroutine refuse(name, must, wrong)
            character(len=*), intent(in) :: name, must, wrong

            call fail(exit_bad_input, trim(name) // ' must be ' // must // ', got ' // wrong &
                      // ' (' // file // ':' // integer_text(table%line(row)) // ')')
        end subroutine refuse
    end subroutine read_method_list
end module faststrip_lab_grid_method_list
