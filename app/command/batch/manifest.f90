!> What a long run has made and of what: names with values, in a file beside its output.
!>
!> While the run goes on it is a journal, rewritten after each piece;
!> `faststrip_command_batch_store` writes both. Of all names those of `identity` say which work it
!> is: two runs whose values agree make the same bytes.
module faststrip_command_batch_manifest
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_status, only: status_t, is_error, status_word, st_file_format
    use faststrip_base_text, only: set_place_status
    use faststrip_files_csv, only: csv_table_t, csv_text_t, csv_writer_t, read_csv, cell_text, &
                                   open_csv, put_comment, put_header, put_cell, end_row, close_csv
    implicit none
    private

    public :: manifest_t, set_value, value_of, number_of, number_text_of, write_manifest
    public :: read_manifest, unlike_value, names_with
    public :: status_counts_t, count_status, add_counts, put_counts, counted

    !> Names that say what a run makes, in the order in which they are compared.
    character(len=*), parameter :: identity(8) = [character(len=16) :: &
        'kind', 'items', 'input_sha256', 'options', 'revision', 'compiler', 'part', 'parts']

    character(len=*), parameter :: status_prefix = 'status '
    character(len=*), parameter :: first_line = 'faststrip manifest'

    !> Names and values in the order in which they were set.
    type :: manifest_t
        private
        type(csv_text_t), allocatable :: names(:), values(:)
        integer :: n = 0
    end type manifest_t

    !> How many items ended in each status.
    type :: status_counts_t
        private
        integer(int64) :: of(0:199) = 0 ! by code
    end type status_counts_t

    !> Give a name its value, or another one.
    interface set_value
        module procedure set_text_value, set_number_value
    end interface set_value

contains

    subroutine set_text_value(manifest, name, value)
        type(manifest_t), intent(inout) :: manifest !! gets it
        character(len=*), intent(in) :: name        !! one line
        character(len=*), intent(in) :: value       !! one line

        type(csv_text_t), allocatable :: longer(:)
        integer :: i

        i = index_of(manifest, name)
        if (i == 0) then
            i = manifest%n + 1
            if (i == 1) allocate (manifest%names(16), manifest%values(16))
            if (i > size(manifest%names)) then
                allocate (longer(2*i))
                longer(:manifest%n) = manifest%names(:manifest%n)
                call move_alloc(longer, manifest%names)
                allocate (longer(2*i))
                longer(:manifest%n) = manifest%values(:manifest%n)
                call move_alloc(longer, manifest%values)
            end if
            manifest%n = i
            manifest%names(i)%text = name
        end if
        manifest%values(i)%text = value
    end subroutine set_text_value

    subroutine set_number_value(manifest, name, value)
        type(manifest_t), intent(inout) :: manifest !! gets it
        character(len=*), intent(in) :: name        !! one line
        integer(int64), intent(in) :: value         !! any

        call set_text_value(manifest, name, number_text_of(value))
    end subroutine set_number_value

    !> A whole number as text.
    pure function number_text_of(value) result(text)
        integer(int64), intent(in) :: value !! any
        character(len=:), allocatable :: text

        character(len=20) :: buffer

        write (buffer, '(i0)') value
        text = trim(buffer)
    end function number_text_of

    pure integer function index_of(manifest, name) result(i)
        type(manifest_t), intent(in) :: manifest
        character(len=*), intent(in) :: name

        do i = manifest%n, 1, -1
            if (manifest%names(i)%text == name) return
        end do
    end function index_of

    !> The value of a name; empty if it has none.
    pure function value_of(manifest, name) result(value)
        type(manifest_t), intent(in) :: manifest !! any
        character(len=*), intent(in) :: name     !! any
        character(len=:), allocatable :: value

        integer :: i

        value = ''
        i = index_of(manifest, name)
        if (i > 0) value = manifest%values(i)%text
    end function value_of

    !> The names that begin with some words, in the order in which they were set.
    pure function names_with(manifest, words) result(names)
        type(manifest_t), intent(in) :: manifest !! any
        character(len=*), intent(in) :: words    !! that they begin with
        type(csv_text_t), allocatable :: names(:)

        integer :: i, n

        allocate (names(manifest%n))
        n = 0
        do i = 1, manifest%n
            if (index(manifest%names(i)%text, words) /= 1) cycle
            n = n + 1
            names(n)%text = manifest%names(i)%text
        end do
        names = names(:n)
    end function names_with

    !> The value of a name as a whole number from 0 on; -1 if it is none.
    pure integer(int64) function number_of(manifest, name) result(number)
        type(manifest_t), intent(in) :: manifest !! any
        character(len=*), intent(in) :: name     !! any

        character(len=:), allocatable :: text
        integer :: code

        number = -1
        text = value_of(manifest, name)
        if (len(text) == 0 .or. len(text) > range(number)) return
        if (verify(text, '0123456789') > 0) return
        read (text, *, iostat=code) number
        if (code /= 0) number = -1
    end function number_of

    !> Write a manifest; the file is whole or as it was.
    subroutine write_manifest(path, manifest, status)
        character(len=*), intent(in) :: path     !! name of the file
        type(manifest_t), intent(in) :: manifest !! any
        type(status_t), intent(out) :: status    !! `st_file_write`

        type(csv_writer_t) :: writer
        integer :: i

        call open_csv(writer, path, status)
        if (is_error(status)) return
        call put_comment(writer, first_line)
        call put_header(writer, [character(len=5) :: 'name', 'value'])
        do i = 1, manifest%n
            call put_cell(writer, manifest%names(i)%text)
            call put_cell(writer, manifest%values(i)%text)
            call end_row(writer)
        end do
        call close_csv(writer, status)
    end subroutine write_manifest

    !> Read a manifest.
    subroutine read_manifest(path, manifest, status)
        character(len=*), intent(in) :: path      !! name of the file
        type(manifest_t), intent(out) :: manifest !! its names and values
        type(status_t), intent(out) :: status     !! `st_file_missing`; `st_file_format`: it is none

        type(csv_table_t) :: table
        logical :: is_one
        integer :: row

        call read_csv(path, table, status)
        if (is_error(status)) return
        is_one = table%n_columns == 2 .and. size(table%comments) > 0
        if (is_one) is_one = table%comments(1)%text == first_line
        if (.not. is_one) then
            call set_place_status(status, st_file_format, 'the file is no manifest', '', path, 0)
            return
        end if
        do row = 1, table%n_rows
            call set_value(manifest, cell_text(table, row, 1), cell_text(table, row, 2))
        end do
    end subroutine read_manifest

    !> The first name of the identity whose values differ; empty if it is the same work.
    pure function unlike_value(one, other, but_for) result(name)
        type(manifest_t), intent(in) :: one, other        !! of two runs
        character(len=*), intent(in), optional :: but_for !! a name that does not count
        character(len=:), allocatable :: name

        integer :: i

        do i = 1, size(identity)
            name = trim(identity(i))
            if (present(but_for)) then
                if (name == but_for) cycle
            end if
            if (value_of(one, name) /= value_of(other, name)) return
        end do
        name = ''
    end function unlike_value

    !> Count an item by how it ended.
    pure subroutine count_status(counts, code)
        type(status_counts_t), intent(inout) :: counts !! one more
        integer, intent(in) :: code                    !! one of the `st_` codes

        counts%of(code) = counts%of(code) + 1
    end subroutine count_status

    !> Put the counts into a manifest, one name for each status that occurred.
    subroutine put_counts(manifest, counts)
        type(manifest_t), intent(inout) :: manifest !! gets them
        type(status_counts_t), intent(in) :: counts !! of all items so far

        integer :: code

        do code = lbound(counts%of, 1), ubound(counts%of, 1)
            if (counts%of(code) > 0) &
                call set_value(manifest, status_prefix // trim(status_word(code)), counts%of(code))
        end do
    end subroutine put_counts

    !> Add the counts of a manifest.
    subroutine add_counts(counts, manifest)
        type(status_counts_t), intent(inout) :: counts !! gets them on top
        type(manifest_t), intent(in) :: manifest       !! with counts

        integer :: code

        do code = lbound(counts%of, 1), ubound(counts%of, 1)
            counts%of(code) = counts%of(code) &
                + max(0_int64, number_of(manifest, status_prefix // trim(status_word(code))))
        end do
    end subroutine add_counts

    !> How many items ended in a status from a code on.
    pure integer(int64) function counted(counts, from)
        type(status_counts_t), intent(in) :: counts !! of all items
        integer, intent(in) :: from                 !! lowest code that counts

        counted = sum(counts%of(from:))
    end function counted
end module faststrip_command_batch_manifest
