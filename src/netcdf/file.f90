!> NetCDF-4 files of one record dimension: a table, a variable a column.
!>
!> The classic model is kept, which every program reads. Text is an array of characters: strings
!> would be pointers into a heap, which is not compressed.
module faststrip_netcdf_file
    use, intrinsic :: iso_c_binding, only: c_associated, c_null_char, c_ptr, c_size_t
    use, intrinsic :: iso_fortran_env, only: real32
    use netcdf, only: nf90_create, nf90_def_dim, nf90_def_var, nf90_put_att, nf90_enddef, &
                      nf90_put_var, nf90_close, nf90_strerror, nf90_noerr, nf90_ebadname, &
                      nf90_netcdf4, nf90_classic_model, nf90_noclobber, nf90_unlimited, &
                      nf90_global, nf90_char, nf90_int, nf90_float, nf90_double
    use faststrip_base_status, only: status_t, clear_status, set_status, st_file_write, &
                                     st_file_format
    use faststrip_files_columns, only: holds_text, holds_counts
    use faststrip_files_csv_writer, only: failure_words
    use faststrip_files_stdio, only: c_fopen, c_fwrite, c_fclose
    use faststrip_netcdf_columns, only: table_column_t, fill_number, fill_count
    implicit none
    private

    public :: netcdf_file_t, create_netcdf, put_attribute, define_columns, put_rows, close_netcdf
    public :: deflate_level

    !> A file being written; its parts are its own business.
    type :: netcdf_file_t
        private
        character(len=:), allocatable :: path, name
        integer :: id = 0
        integer :: n_rows = 0
        logical :: is_open = .false.
        logical :: is_single = .false.
        type(status_t) :: status
    end type netcdf_file_t

    !> How hard to compress, of 9.
    !> Tuned [1]. Origin: measured: 6 saves one percent more, and takes a sixth more time.
    integer, parameter :: deflate_level = 1
    ! Tuned [MB]: memory for a variable's chunks. Origin: chosen: rows come a chunk at a time, and
    ! none comes again.
    integer, parameter :: chunk_cache = 1

contains

    !> Start a file, which must not be there.
    subroutine create_netcdf(file, path, name, single, status)
        type(netcdf_file_t), intent(out) :: file !! to be closed by `close_netcdf`
        character(len=*), intent(in) :: path     !! of the file
        character(len=*), intent(in) :: name     !! what messages call it
        logical, intent(in) :: single            !! numbers in single precision?
        type(status_t), intent(out) :: status    !! `st_file_write`

        file%path = path
        file%name = name
        file%is_single = single
        call note(file, nf90_create(path, ior(ior(nf90_netcdf4, nf90_classic_model), &
                                              nf90_noclobber), file%id))
        file%is_open = file%status%code == 0
        status = file%status
    end subroutine create_netcdf

    !> Say something about the whole file.
    subroutine put_attribute(file, name, text)
        type(netcdf_file_t), intent(inout) :: file !! before its columns are defined
        character(len=*), intent(in) :: name       !! of the attribute
        character(len=*), intent(in) :: text       !! any

        if (file%status%code /= 0) return
        call note(file, nf90_put_att(file%id, nf90_global, name, text))
    end subroutine put_attribute

    !> Define all variables.
    subroutine define_columns(file, columns, n_rows, status)
        type(netcdf_file_t), intent(inout) :: file           !! just created
        type(table_column_t), intent(inout) :: columns(:)    !! settled; `variable` is filled in
        integer, intent(in) :: n_rows                        !! written at a time, 1 or more
        type(status_t), intent(out) :: status                !! `st_file_write`; `st_file_format`:
                                                             !! a name that is none for a variable

        integer :: records, i

        if (file%status%code == 0) &
            call note(file, nf90_def_dim(file%id, free_name('record', columns), nf90_unlimited, &
                                         records))
        do i = 1, size(columns)
            if (file%status%code /= 0) exit
            call define(columns(i))
        end do
        if (file%status%code == 0) call note(file, nf90_enddef(file%id))
        status = file%status

    contains

        subroutine define(column)
            type(table_column_t), intent(inout) :: column

            integer :: code, letters

            select case (column%holds)
            case (holds_text)
                call note(file, nf90_def_dim(file%id, free_name('length_of_' // column%name, &
                                                                columns), column%longest, letters))
                if (file%status%code /= 0) return
                code = nf90_def_var(file%id, column%name, nf90_char, [letters, records], &
                                    column%variable, chunksizes=[column%longest, n_rows], &
                                    shuffle=.false., deflate_level=deflate_level, &
                                    cache_size=chunk_cache)
            case (holds_counts)
                code = nf90_def_var(file%id, column%name, nf90_int, [records], column%variable, &
                                    chunksizes=[n_rows], shuffle=.true., &
                                    deflate_level=deflate_level, cache_size=chunk_cache)
            case default
                code = nf90_def_var(file%id, column%name, &
                                    merge(nf90_float, nf90_double, file%is_single), [records], &
                                    column%variable, chunksizes=[n_rows], shuffle=.true., &
                                    deflate_level=deflate_level, cache_size=chunk_cache)
            end select
            if (code == nf90_ebadname) then
                call set_status(file%status, st_file_format, 'a column must have a name that ' &
                                // 'NetCDF takes, got ''' // column%name // '''')
                return
            end if
            call note(file, code)
            call describe(file, column)
        end subroutine define
    end subroutine define_columns

    ! A name that no column has.
    function free_name(wish, columns) result(name)
        character(len=*), intent(in) :: wish
        type(table_column_t), intent(in) :: columns(:)
        character(len=:), allocatable :: name

        integer :: i

        name = wish
        i = 1
        do while (i <= size(columns))
            i = i + 1
            if (columns(i - 1)%name /= name) cycle
            name = name // '_'
            i = 1
        end do
    end function free_name

    ! The attributes of a variable.
    subroutine describe(file, column)
        type(netcdf_file_t), intent(inout) :: file
        type(table_column_t), intent(in) :: column

        associate (id => file%id, variable => column%variable)
            if (file%status%code == 0) &
                call note(file, nf90_put_att(id, variable, 'long_name', column%long_name))
            if (file%status%code == 0 .and. len(column%unit) > 0) &
                call note(file, nf90_put_att(id, variable, 'units', column%unit))
            if (file%status%code /= 0) return
            select case (column%holds)
            case (holds_text)
                call note(file, nf90_put_att(id, variable, '_Encoding', 'utf-8'))
            case (holds_counts)
                ! Where there is one, readers make the numbers real.
                if (column%has_gaps) &
                    call note(file, nf90_put_att(id, variable, '_FillValue', fill_count))
            case default
                if (file%is_single) then
                    call note(file, nf90_put_att(id, variable, '_FillValue', &
                                                 real(fill_number, real32)))
                else
                    call note(file, nf90_put_att(id, variable, '_FillValue', fill_number))
                end if
            end select
        end associate
    end subroutine describe

    !> Write the first rows that the columns hold behind those that are written.
    subroutine put_rows(file, columns, n, status)
        type(netcdf_file_t), intent(inout) :: file        !! its columns defined
        type(table_column_t), intent(in) :: columns(:)    !! with their rows
        integer, intent(in) :: n                          !! rows
        type(status_t), intent(out) :: status             !! `st_file_write`

        integer :: i, start(1), count(1)

        start = file%n_rows + 1
        count = n
        do i = 1, size(columns)
            if (file%status%code /= 0 .or. n == 0) exit
            associate (column => columns(i))
                select case (column%holds)
                case (holds_text)
                    call note(file, nf90_put_var(file%id, column%variable, column%texts(:n), &
                                                 start=[1, start], count=[column%longest, count]))
                case (holds_counts)
                    call note(file, nf90_put_var(file%id, column%variable, column%counts(:n), &
                                                 start=start, count=count))
                case default
                    if (file%is_single) then
                        call note(file, nf90_put_var(file%id, column%variable, &
                                                     real(column%numbers(:n), real32), &
                                                     start=start, count=count))
                    else
                        call note(file, nf90_put_var(file%id, column%variable, &
                                                     column%numbers(:n), start=start, &
                                                     count=count))
                    end if
                end select
            end associate
        end do
        file%n_rows = file%n_rows + n
        status = file%status
    end subroutine put_rows

    !> Finish the file. If anything failed since it was created, or fails now, it is of no use.
    subroutine close_netcdf(file, status)
        type(netcdf_file_t), intent(inout) :: file !! closed afterwards
        type(status_t), intent(out) :: status      !! of the first failure: `st_file_write`,
                                                   !! `st_file_format`

        call clear_status(status)
        if (file%is_open) call note(file, nf90_close(file%id))
        file%is_open = .false.
        status = file%status
    end subroutine close_netcdf

    ! Keep the first failure. The library only says that HDF5 had one: the reason, a full disk
    ! most often, shows by trying to write on.
    subroutine note(file, code)
        type(netcdf_file_t), intent(inout) :: file
        integer, intent(in) :: code

        character(len=:), allocatable :: why

        if (code == nf90_noerr .or. file%status%code /= 0) return
        why = writing_trouble(file%path)
        if (len(why) == 0) why = trim(nf90_strerror(code))
        call set_status(file%status, st_file_write, 'cannot write the file: ' // file%name // ': ' &
                        // why)
    end subroutine note

    ! Why no more can be written to a file; empty if it can, which it then is.
    function writing_trouble(path) result(words)
        character(len=*), intent(in) :: path
        character(len=:), allocatable :: words

        ! Tuned [bytes]. Origin: chosen: more than what is left of any block of a file system.
        integer, parameter :: trial = 1048576
        type(c_ptr) :: stream

        words = ''
        stream = c_fopen(path // c_null_char, 'a' // c_null_char)
        if (.not. c_associated(stream)) then
            words = trim(failure_words())
            return
        end if
        if (c_fwrite(repeat(' ', trial), 1_c_size_t, int(trial, c_size_t), stream) < trial) &
            words = trim(failure_words())
        if (c_fclose(stream) /= 0 .and. len(words) == 0) words = trim(failure_words())
    end function writing_trouble
end module faststrip_netcdf_file
