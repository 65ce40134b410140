!> Numbers of lookup tables in their bytes: whole ones, doubles, single ones, axes, text.
module faststrip_lookup_words
    use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, st_workspace_too_small
    use faststrip_lookup_axis, only: lookup_axis_t, make_axis, make_point
    implicit none
    private

    public :: take_axis, take_doubles, take_values, take_text, word_at
    public :: put_word, put_doubles, put_values, put_text
    public :: of_double, of_word, of_header, n_counts, most_text

    !> Bytes of a double, and of a whole or single number.
    !> Given: by IEEE 754.
    integer, parameter :: of_double = 8, of_word = 4
    !> Whole numbers behind the first eight bytes, and the bytes of both.
    !> Given: by the file format.
    integer, parameter :: n_counts = 8, of_header = 8 + of_word*n_counts
    !> Tuned [bytes]: the longest text. Origin: capacity.
    integer, parameter :: most_text = 65536

contains

    !> An axis; without nodes where they are none that an axis can have.
    subroutine take_axis(bytes, at, n, axis)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table
        integer(int64), intent(inout) :: at      !! bytes before it; after it
        integer(int32), intent(in) :: n          !! nodes
        type(lookup_axis_t), intent(out) :: axis !! of `make_axis`

        real(wp) :: nodes(n)

        call take_doubles(bytes, at, nodes)
        if (n == 1) then
            call make_point(nodes(1), axis)
        else
            call make_axis(nodes, axis)
        end if
    end subroutine take_axis

    !> Doubles.
    subroutine take_doubles(bytes, at, numbers)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table
        integer(int64), intent(inout) :: at    !! bytes before them; after them
        real(wp), intent(out) :: numbers(:)    !! found

        integer :: i

        do i = 1, size(numbers)
            numbers(i) = transfer(bytes(at + 1:at + of_double), 0.0_wp)
            at = at + of_double
        end do
    end subroutine take_doubles

    !> Single numbers.
    subroutine take_values(bytes, at, n, values, status)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table
        integer(int64), intent(inout) :: at     !! bytes before them; after them
        integer(int64), intent(in) :: n         !! how many
        real(real32), allocatable, intent(out) :: values(:) !! found
        type(status_t), intent(inout) :: status !! `st_workspace_too_small`: not enough memory

        integer(int64) :: i
        integer :: failure

        allocate (values(n), stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a lookup table')
            return
        end if
        do i = 1, n
            values(i) = transfer(bytes(at + 1:at + of_word), 0.0_real32)
            at = at + of_word
        end do
    end subroutine take_values

    !> Text.
    subroutine take_text(bytes, at, n, text)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table
        integer(int64), intent(inout) :: at !! bytes before it; after it
        integer(int32), intent(in) :: n     !! characters
        character(len=:), allocatable, intent(out) :: text !! found

        integer :: i

        allocate (character(len=n) :: text)
        do i = 1, n
            text(i:i) = achar(iand(int(bytes(at + i)), 255))
        end do
        at = at + n
    end subroutine take_text

    !> A whole number.
    pure integer(int32) function word_at(bytes, at)
        integer(int8), intent(in), contiguous :: bytes(:) !! of a table
        integer(int64), intent(in) :: at                  !! bytes before it

        word_at = transfer(bytes(at + 1:at + of_word), 0_int32)
    end function word_at

    !> Write a whole number.
    pure subroutine put_word(word, at, bytes)
        integer(int32), intent(in) :: word       !! the number
        integer(int64), intent(inout) :: at      !! bytes before it; after it
        integer(int8), intent(inout) :: bytes(:) !! of a table

        bytes(at + 1:at + of_word) = transfer(word, bytes(:1), of_word)
        at = at + of_word
    end subroutine put_word

    !> Write doubles.
    pure subroutine put_doubles(numbers, at, bytes)
        real(wp), intent(in) :: numbers(:)       !! the numbers
        integer(int64), intent(inout) :: at      !! bytes before them; after them
        integer(int8), intent(inout) :: bytes(:) !! of a table

        integer :: i

        do i = 1, size(numbers)
            bytes(at + 1:at + of_double) = transfer(numbers(i), bytes(:1), of_double)
            at = at + of_double
        end do
    end subroutine put_doubles

    !> Write single numbers.
    pure subroutine put_values(values, at, bytes)
        real(real32), intent(in) :: values(:)    !! the numbers
        integer(int64), intent(inout) :: at      !! bytes before them; after them
        integer(int8), intent(inout) :: bytes(:) !! of a table

        integer(int64) :: i

        do i = 1, size(values, kind=int64)
            call put_word(transfer(values(i), 0_int32), at, bytes)
        end do
    end subroutine put_values

    !> Write text, with blanks up to a multiple of four.
    pure subroutine put_text(text, n, at, bytes)
        character(len=*), intent(in) :: text     !! ASCII
        integer, intent(in) :: n                 !! characters to write
        integer(int64), intent(inout) :: at      !! bytes before it; after it
        integer(int8), intent(inout) :: bytes(:) !! of a table

        integer :: i

        do i = 1, n
            at = at + 1
            bytes(at) = iachar(' ', int8)
            if (i <= len(text)) bytes(at) = iachar(text(i:i), int8)
        end do
    end subroutine put_text
end module faststrip_lookup_words
