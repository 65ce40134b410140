!> A table as a NetCDF file, by a library that is loaded when there is one to be written: linked, it
!> would slow every start.
module faststrip_command_program_netcdf_file
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_procpointer, c_funloc, &
                                           c_funptr, c_int, c_null_char, c_null_funptr
    use faststrip_base_status, only: status_t, clear_status, message_length, is_error, &
                                     set_status, st_file_format, st_file_write
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_files_columns, only: is_variable_name
    use faststrip_files_csv, only: csv_text_t, failure_words, finish_tables, find_free_temporary
    use faststrip_files_stdio, only: c_remove, c_rename
    use faststrip_files_temporary, only: find_final_path
    use faststrip_command_program_console, only: note, progress, version_text
    use faststrip_command_program_system, only: set_progress
    implicit none
    private

    public :: is_netcdf, write_netcdf, write_netcdf_lookup, finish_as_asked, use_single_precision
    public :: check_names

    !> How the names of these files end.
    character(len=*), parameter :: ending = '.nc'

    character(len=*), parameter :: library = 'faststrip_netcdf.so'
    character(len=*), parameter :: table_procedure = 'faststrip_write_netcdf'
    character(len=*), parameter :: lookup_procedure = 'faststrip_write_netcdf_lookup'

    ! Numbers of tables that are finished as NetCDF.
    logical :: are_single = .false.

    abstract interface
        ! As `faststrip_write_netcdf` of `src/netcdf/plugin.f90`.
        function written(source, called, target, name, writer, is_single, told, message) &
            result(code) bind(c)
            import :: c_char, c_funptr, c_int, message_length
            character(kind=c_char), intent(in) :: source(*), called(*), target(*), name(*), &
                                                  writer(*)
            integer(c_int), value :: is_single
            type(c_funptr), value :: told
            character(kind=c_char), intent(out) :: message(message_length)
            integer(c_int) :: code
        end function written

        ! As `faststrip_write_netcdf_lookup` there.
        function lookup_written(source, target, name, writer, message) result(code) bind(c)
            import :: c_char, c_int, message_length
            character(kind=c_char), intent(in) :: source(*), target(*), name(*), writer(*)
            character(kind=c_char), intent(out) :: message(message_length)
            integer(c_int) :: code
        end function lookup_written
    end interface

    interface
        function c_load(file, name, why, capacity) bind(c, name='faststrip_load') result(found)
            import :: c_char, c_funptr, c_int
            character(kind=c_char), intent(in) :: file(*), name(*)
            character(kind=c_char), intent(out) :: why(*)
            integer(c_int), value :: capacity
            type(c_funptr) :: found
        end function c_load
    end interface

contains

    !> Does a file's name ask for NetCDF?
    pure logical function is_netcdf(path)
        character(len=*), intent(in) :: path !! as it was given

        is_netcdf = .false.
        if (len(path) > len(ending)) is_netcdf = path(len(path) - len(ending) + 1:) == ending
    end function is_netcdf

    !> From now on every table whose name asks for NetCDF is finished as such.
    subroutine finish_as_asked()
        call finish_tables(finish)
    end subroutine finish_as_asked

    !> Let numbers of these tables be in single precision.
    subroutine use_single_precision()
        are_single = .true.
    end subroutine use_single_precision

    !> Do all columns have names that NetCDF takes?
    subroutine check_names(names, file, status)
        type(csv_text_t), intent(in) :: names(:) !! of the columns
        character(len=*), intent(in) :: file     !! in which they stand
        type(status_t), intent(out) :: status    !! `st_file_format`

        integer :: i

        call clear_status(status)
        do i = 1, size(names)
            if (is_variable_name(names(i)%text)) cycle
            call set_place_status(status, st_file_format, 'a column must have a name that NetCDF ' &
                                  // 'takes', "'" // names(i)%text // "'", file, 0)
            return
        end do
    end subroutine check_names

    subroutine finish(table, path, is_finished, status)
        character(len=*), intent(in) :: table, path
        logical, intent(out) :: is_finished
        type(status_t), intent(out) :: status

        call clear_status(status)
        is_finished = is_netcdf(path)
        if (is_finished) call write_netcdf(table, path, status)
    end subroutine finish

    !> Write a CSV file anew as NetCDF: a whole new file is left, or the old one.
    subroutine write_netcdf(source, path, status, called)
        character(len=*), intent(in) :: source !! the CSV file
        character(len=*), intent(in) :: path   !! of the file to be made
        type(status_t), intent(out) :: status  !! errors of the CSV file; `st_file_write`
        character(len=*), intent(in), optional :: called !! what messages call the CSV file;
                                                         !! default: the path

        procedure(written), pointer :: write_table
        character(len=:), allocatable :: target, said
        character(kind=c_char) :: words(message_length)
        type(c_funptr) :: found

        call load_library(table_procedure, path, found, status)
        if (is_error(status)) return
        call c_f_procpointer(found, write_table)
        call find_free_temporary(path, target)
        said = path
        if (present(called)) said = called
        status%code = write_table(source // c_null_char, said // c_null_char, &
                                  target // c_null_char, path // c_null_char, &
                                  version_text() // c_null_char, &
                                  merge(1_c_int, 0_c_int, are_single), c_funloc(tell), words)
        status%message = transfer(words, status%message)
        if (.not. is_error(status) .and. len_trim(status%message) > 0) &
            call note(trim(status%message))
        call finish_file(target, path, status)
    end subroutine write_netcdf

    !> Write a lookup table as NetCDF: a whole new file is left, or the old one.
    subroutine write_netcdf_lookup(source, path, status)
        character(len=*), intent(in) :: source !! the table's file
        character(len=*), intent(in) :: path   !! of the file to be made
        type(status_t), intent(out) :: status  !! of the table; `st_file_write`

        procedure(lookup_written), pointer :: write_table
        character(len=:), allocatable :: target
        character(kind=c_char) :: words(message_length)
        type(c_funptr) :: found

        call load_library(lookup_procedure, path, found, status)
        if (is_error(status)) return
        call c_f_procpointer(found, write_table)
        call find_free_temporary(path, target)
        status%code = write_table(source // c_null_char, target // c_null_char, &
                                  path // c_null_char, version_text() // c_null_char, words)
        status%message = transfer(words, status%message)
        call finish_file(target, path, status)
    end subroutine write_netcdf_lookup

    ! A file that is whole gets its name, another one goes.
    subroutine finish_file(target, path, status)
        character(len=*), intent(in) :: target, path
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: final
        integer(c_int) :: code

        if (.not. is_error(status)) then
            call find_final_path(path, final)
            code = c_rename(target // c_null_char, final // c_null_char)
            if (code /= 0) call set_status(status, st_file_write, 'cannot write the file: ' &
                                           // path // ': ' // trim(failure_words()))
        end if
        if (is_error(status)) code = c_remove(target // c_null_char)
    end subroutine finish_file

    ! A procedure of the library that writes NetCDF to a path.
    subroutine load_library(procedure_name, path, found, status)
        character(len=*), intent(in) :: procedure_name, path
        type(c_funptr), intent(out) :: found
        type(status_t), intent(out) :: status

        character(kind=c_char) :: why(message_length)
        character(len=message_length) :: words
        character(len=:), allocatable :: final

        call clear_status(status)
        found = c_null_funptr
        call find_final_path(path, final)
        if (index(final, '/dev/') == 1) then
            call set_status(status, st_file_write, 'NetCDF must go to a file, got ' // path)
            return
        end if
        call set_progress('loading ' // library)
        found = c_load(library // c_null_char, procedure_name // c_null_char, why, &
                       int(size(why), c_int))
        if (c_associated(found)) return
        words = transfer(why, words)
        call set_status(status, st_file_write, 'cannot write NetCDF: ' &
                        // words(:index(words, c_null_char) - 1))
    end subroutine load_library

    subroutine tell(rows, total) bind(c)
        integer(c_int), value :: rows, total

        if (total > 0) then
            call progress('rows written', int(rows), int(total))
        else
            call set_progress('rows read ' // integer_text(int(rows)))
        end if
    end subroutine tell
end module faststrip_command_program_netcdf_file
