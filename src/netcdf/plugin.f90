!> What the program calls of this library, which it loads when it is to write NetCDF.
module faststrip_netcdf_plugin
    use, intrinsic :: iso_c_binding, only: c_char, c_f_procpointer, c_funptr, c_int, c_null_char
    use faststrip_base_status, only: status_t, message_length
    use faststrip_netcdf_lookup, only: write_lookup
    use faststrip_netcdf_table, only: conversion_t, progress_told, write_table
    implicit none
    private

    public :: faststrip_write_netcdf, faststrip_write_netcdf_lookup

contains

    !> Write a CSV file anew as NetCDF-4. Returns a status code; texts end with a zero byte.
    function faststrip_write_netcdf(source, called, target, name, writer, is_single, progress, &
                                    message) result(code) bind(c)
        character(kind=c_char), intent(in) :: source(*) !! the CSV file
        character(kind=c_char), intent(in) :: called(*) !! what messages call it
        character(kind=c_char), intent(in) :: target(*) !! the file to be made; must not be there
        character(kind=c_char), intent(in) :: name(*)   !! what messages call that
        character(kind=c_char), intent(in) :: writer(*) !! name, version, revision of the program
        integer(c_int), value :: is_single              !! not 0: numbers in single precision
        type(c_funptr), value :: progress               !! of a `progress_told`
        character(kind=c_char), intent(out) :: message(message_length) !! of an error, or what else
                                                        !! there is to say; filled up with blanks
        integer(c_int) :: code

        type(conversion_t) :: what
        type(status_t) :: status
        procedure(progress_told), pointer :: tell
        character(len=:), allocatable :: words

        what%source = fortran_text(source)
        what%called = fortran_text(called)
        what%target = fortran_text(target)
        what%name = fortran_text(name)
        what%writer = fortran_text(writer)
        what%is_single = is_single /= 0
        call c_f_procpointer(progress, tell)
        call write_table(what, tell, words, status)
        if (status%code == 0) status%message = words
        call put_message(status, message)
        code = int(status%code, c_int)
    end function faststrip_write_netcdf

    !> Write a lookup table as NetCDF-4. Returns a status code; texts end with a zero byte.
    function faststrip_write_netcdf_lookup(source, target, name, writer, message) result(code) &
        bind(c)
        character(kind=c_char), intent(in) :: source(*) !! the table's file
        character(kind=c_char), intent(in) :: target(*) !! the file to be made; must not be there
        character(kind=c_char), intent(in) :: name(*)   !! what messages call that
        character(kind=c_char), intent(in) :: writer(*) !! name, version, revision of the program
        character(kind=c_char), intent(out) :: message(message_length) !! of an error; filled up
                                                        !! with blanks
        integer(c_int) :: code

        type(status_t) :: status

        call write_lookup(fortran_text(source), fortran_text(target), fortran_text(name), &
                          fortran_text(writer), status)
        call put_message(status, message)
        code = int(status%code, c_int)
    end function faststrip_write_netcdf_lookup

    subroutine put_message(status, message)
        type(status_t), intent(in) :: status
        character(kind=c_char), intent(out) :: message(message_length)

        integer :: i

        do i = 1, message_length
            message(i) = status%message(i:i)
        end do
    end subroutine put_message

    function fortran_text(text) result(words)
        character(kind=c_char), intent(in) :: text(*)
        character(len=:), allocatable :: words

        integer :: i, n

        n = 0
        do while (text(n + 1) /= c_null_char)
            n = n + 1
        end do
        allocate (character(len=n) :: words)
        do i = 1, n
            words(i:i) = text(i)
        end do
    end function fortran_text
end module faststrip_netcdf_plugin
