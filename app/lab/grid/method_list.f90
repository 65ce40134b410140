!> Lists of methods and resolutions, CSV files of the reference folder: what benches compare.
module faststrip_lab_grid_method_list
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, read_csv, require_column, column_index, cell_text, &
                                   cell_integer
    use faststrip_command_program_console, only: fail, fail_on_error, exit_bad_input
    use faststrip_command_settings_methods, only: settings_t, put_setting, settle_wanted
    use faststrip_command_settings_table, only: settings, value_t, of_group, find_setting, &
                                                read_value, full_words, one_of, no_fault
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
        integer :: row

        call read_csv(file, table, status)
        call fail_on_error(status)
        allocate (entries(table%n_rows))
        do row = 1, table%n_rows
            entries(row)%stage = text('stage')
            entries(row)%name = text('method')
            entries(row)%when = text('when')
            if (all(stages /= entries(row)%stage)) &
                call refuse('stage', trim(one_of(stages)), entries(row)%stage)
            call take_settings(entries(row)%settings)
            call take_sides(entries(row)%settings)
            call take_across(entries(row)%across)
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

        !> A column that may be missing.
        function further(name)
            character(len=*), intent(in) :: name
            character(len=:), allocatable :: further

            further = cell_text(table, row, column_index(table, name))
        end function further

        !> The columns that are named as settings; an empty cell leaves the default.
        subroutine take_settings(case)
            class(settings_t), intent(inout) :: case

            type(value_t) :: value
            integer, allocatable :: rows(:)
            integer :: i

            rows = of_group('numerics')
            do i = 1, size(rows)
                if (further(trim(settings(rows(i))%key)) == '') cycle
                call read_cell(rows(i), trim(settings(rows(i))%key), value)
                call put_setting(case, trim(settings(rows(i))%key), value)
            end do
        end subroutine take_settings

        !> Elements are squares.
        subroutine take_sides(case)
            class(settings_t), intent(inout) :: case

            character(len=*), parameter :: sides(2) = ['element_dx_mm', 'element_dy_mm']
            type(value_t) :: value
            integer :: i

            if (further('element_mm') == '') return
            do i = 1, size(sides)
                call read_cell(find_setting('numerics', sides(i)), 'element_mm', value)
                call put_setting(case, sides(i), value)
            end do
        end subroutine take_sides

        subroutine read_cell(setting, name, value)
            integer, intent(in) :: setting
            character(len=*), intent(in) :: name
            type(value_t), intent(inout) :: value

            integer :: fault

            call read_value(settings(setting), further(name), value, fault)
            if (fault /= no_fault) &
                call refuse(name, trim(full_words(settings(setting))), further(name))
        end subroutine read_cell

        !> What belongs to contacts of many sizes.
        subroutine take_across(across)
            integer, intent(inout) :: across

            if (further('across') == '') return
            call cell_integer(table, row, column_index(table, 'across'), across, status)
            call fail_on_error(status)
            if (across < 2) call refuse('across', 'a whole number from 2 on', further('across'))
        end subroutine take_across

        subroutine refuse(name, must, wrong)
            character(len=*), intent(in) :: name, must, wrong

            call fail(exit_bad_input, trim(name) // ' must be ' // must // ', got ' // wrong &
                      // ' (' // file // ':' // integer_text(table%line(row)) // ')')
        end subroutine refuse
    end subroutine read_method_list
end module faststrip_lab_grid_method_list
