!> Numbers to bytes and back: one walk over data writes them or reads them.
module faststrip_numerics_byte_stream
    use, intrinsic :: iso_fortran_env, only: int8, int64, real64
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: byte_stream_t, exchange, exchange_count, of_word

    !> Bytes of a number, whatever its type is.
    !> Given: by IEEE 754.
    integer, parameter :: of_word = 8

    !> Bytes that belong to the caller, and where a walk is in them.
    type :: byte_stream_t
        integer(int8), pointer, contiguous :: bytes(:) => null()
            !! if null, numbers are counted only
        integer(int64) :: at = 0      !! bytes before the next number
        logical :: is_read = .false.  !! are numbers read, or written?
        logical :: fits = .true.      !! were there bytes enough, and counts that can be?
    end type byte_stream_t

    !> Write numbers, or read them: those in the arguments.
    interface exchange
        module procedure :: exchange_word, exchange_real, exchange_reals, exchange_table
        module procedure :: exchange_integer, exchange_integers, exchange_logical, exchange_logicals
    end interface exchange

contains

    !> One number of eight bytes.
    subroutine exchange_word(stream, word)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        integer(int64), intent(inout) :: word        !! any bits; as it was where bytes end

        associate (from => stream%at + 1)
            stream%at = stream%at + of_word
            if (.not. associated(stream%bytes)) return
            if (stream%at > size(stream%bytes, kind=int64)) then
                stream%fits = .false.
            else if (stream%is_read) then
                word = transfer(stream%bytes(from:stream%at), word)
            else
                stream%bytes(from:stream%at) = transfer(word, stream%bytes(1:of_word))
            end if
        end associate
    end subroutine exchange_word

    !> A real number.
    subroutine exchange_real(stream, number)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        real(wp), intent(inout) :: number            !! any

        integer(int64) :: word

        word = transfer(real(number, real64), word)
        call exchange_word(stream, word)
        number = real(transfer(word, 0.0_real64), wp)
    end subroutine exchange_real

    !> Real numbers.
    subroutine exchange_reals(stream, numbers)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        real(wp), intent(inout) :: numbers(:)        !! any

        integer :: i

        do i = 1, size(numbers)
            call exchange_real(stream, numbers(i))
        end do
    end subroutine exchange_reals

    !> A table of real numbers, column by column.
    subroutine exchange_table(stream, numbers)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        real(wp), intent(inout) :: numbers(:, :)     !! any

        integer :: i

        do i = 1, size(numbers, 2)
            call exchange_reals(stream, numbers(:, i))
        end do
    end subroutine exchange_table

    !> A whole number.
    subroutine exchange_integer(stream, number)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        integer, intent(inout) :: number             !! any

        integer(int64) :: word

        word = number
        call exchange_word(stream, word)
        number = int(max(-huge(number) + 0_int64, min(word, huge(number) + 0_int64)))
    end subroutine exchange_integer

    !> Whole numbers.
    subroutine exchange_integers(stream, numbers)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        integer, intent(inout) :: numbers(:)         !! any

        integer :: i

        do i = 1, size(numbers)
            call exchange_integer(stream, numbers(i))
        end do
    end subroutine exchange_integers

    !> How many of something follow: 0 where that is out of range.
    subroutine exchange_count(stream, n, most)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        integer, intent(inout) :: n                  !! 0 to most
        integer, intent(in) :: most                  !! that there is room for

        call exchange_integer(stream, n)
        if (n >= 0 .and. n <= most) return
        stream%fits = .false.
        n = 0
    end subroutine exchange_count

    !> A truth value.
    subroutine exchange_logical(stream, value)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        logical, intent(inout) :: value              !! any

        integer :: number

        number = merge(1, 0, value)
        call exchange_integer(stream, number)
        value = number == 1
    end subroutine exchange_logical

    !> Truth values.
    subroutine exchange_logicals(stream, values)
        type(byte_stream_t), intent(inout) :: stream !! goes on
        logical, intent(inout) :: values(:)          !! any

        integer :: i

        do i = 1, size(values)
            call exchange_logical(stream, values(i))
        end do
    end subroutine exchange_logicals
end module faststrip_numerics_byte_stream
