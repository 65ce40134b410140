!> Lookup tables in files.
module faststrip_command_lookup_file
    use, intrinsic :: iso_fortran_env, only: int8
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, st_file_write
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_program_system, only: name_kind, kind_none, kind_file
    use faststrip_files_bytes, only: read_bytes, write_bytes
    use faststrip_lookup_bytes, only: open_lookup, pack_lookup
    use faststrip_lookup_table, only: lookup_t
    use faststrip_tabulate_parts, only: take_values
    implicit none
    private

    public :: read_table, write_table, work_name, take_work

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

    !> The file of work that goes on; empty where the table is no ordinary file.
    pure function work_name(path) result(name)
        character(len=*), intent(in) :: path !! of the table
        character(len=:), allocatable :: name

        name = ''
        if (index(path, '/dev/') /= 1) name = path // '.unfinished'
    end function work_name

    !> Look at the file of work that goes on. What is there must be unfinished work, which is taken
    !> if it is wanted.
    subroutine take_work(path, lookup, is_wanted, status)
        character(len=*), intent(in) :: path    !! file of the work; empty: none is kept
        type(lookup_t), intent(inout) :: lookup !! begun
        logical, intent(in) :: is_wanted        !! is it gone on with?
        type(status_t), intent(out) :: status
            !! of the file; `st_file_write`: something else; `st_bad_argument`: of other work

        type(lookup_t) :: other
        integer(int8), allocatable :: bytes(:)
        logical :: is_work

        call clear_status(status)
        if (len(path) == 0) return
        if (name_kind(path) == kind_none) return
        is_work = name_kind(path) == kind_file
        if (is_work) then
            call read_bytes(path, bytes, status)
            if (.not. is_error(status)) call open_lookup(bytes, other, status, may_lack=.true.)
            is_work = .not. is_error(status)
            ! Work that is done is judged, and is no work any more.
            if (is_work) is_work = other%tested == 0 .and. all(other%wheel%tested == 0)
        end if
        if (.not. is_work) then
            call set_status(status, st_file_write, 'what is unfinished must not be kept in the ' &
                            // 'place of another file, got ' // path)
        else if (is_wanted) then
            call take_values(path, lookup, status)
        end if
    end subroutine take_work
end module faststrip_command_lookup_file
