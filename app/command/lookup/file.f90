!> Lookup tables in files.
module faststrip_command_lookup_file
    use, intrinsic :: iso_fortran_env, only: int8
    use faststrip_base_status, only: status_t
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_files_bytes, only: read_bytes, write_bytes
    use faststrip_lookup_bytes, only: open_lookup, pack_lookup
    use faststrip_lookup_table, only: lookup_t
    implicit none
    private

    public :: read_table, write_table

contains

    !> The table of a file; ends the program if there is none.
    subroutine read_table(path, lookup)
        character(len=*), intent(in) :: path  !! name of the file
        type(lookup_t), intent(out) :: lookup !! ready

        integer(int8), allocatable :: bytes(:)
        type(status_t) :: status

        call read_bytes(path, bytes, status)
        call fail_on_error(status)
        call open_lookup(bytes, lookup, status)
        call fail_on_error(status, path)
    end subroutine read_table

    !> Write a table; ends the program if that fails.
    subroutine write_table(path, lookup)
        character(len=*), intent(in) :: path !! name of the file
        type(lookup_t), intent(in) :: lookup !! filled

        integer(int8), allocatable :: bytes(:)
        type(status_t) :: status

        call pack_lookup(lookup, bytes)
        call write_bytes(path, bytes, status)
        call fail_on_error(status)
    end subroutine write_table
end module faststrip_command_lookup_file
