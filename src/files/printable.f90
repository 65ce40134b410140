!> Words about files as they may be shown to people.
module faststrip_files_printable
    use faststrip_base_text, only: lower_case
    implicit none
    private

    public :: printable

    ! How a byte is shown that is no character.
    character(len=*), parameter :: escape = '\xNN'

contains

    pure integer function safe_length(text) result(length)
        character(len=*), intent(in) :: text

        integer :: i, n

        i = 1
        length = 0
        do while (i <= len(text))
            n = length_of_character(text(i:))
            length = length + merge(n, len(escape), n > 0)
            i = i + max(n, 1)
        end do
    end function safe_length

    !> A text in which control characters, and bytes that are no UTF-8, stand as `\xNN`: what was
    !> typed or read cannot steer the terminal or break the line.
    pure function printable(text) result(safe)
        character(len=*), intent(in) :: text       !! any bytes
        character(len=safe_length(text)) :: safe

        character(len=2) :: hexadecimal
        integer :: i, k, n

        i = 1
        k = 0
        do while (i <= len(text))
            n = length_of_character(text(i:))
            if (n > 0) then
                safe(k + 1:k + n) = text(i:i + n - 1)
                k = k + n
            else
                n = 1
                write (hexadecimal, '(z2.2)') ichar(text(i:i))
                safe(k + 1:k + len(escape)) = escape(:2) // lower_case(hexadecimal)
                k = k + len(escape)
            end if
            i = i + n
        end do
    end function printable

    !> Bytes of the first character of a text in UTF-8; 0 if it is a control character or none.
    pure integer function length_of_character(text) result(n)
        character(len=*), intent(in) :: text

        integer :: first, i

        first = ichar(text(1:1))
        n = 0
        select case (first)
        case (32:126); n = 1
        case (194:223); n = 2
        case (224:239); n = 3
        case (240:244); n = 4
        end select
        if (n > len(text)) n = 0
        do i = 2, n
            if (ichar(text(i:i)) < 128 .or. ichar(text(i:i)) > 191) then
                n = 0
                return
            end if
        end do
        if (n < 2) return
        associate (second => ichar(text(2:2)))
            ! Control characters beyond ASCII; longer than needed; surrogates; beyond Unicode.
            if (first == 194 .and. second < 160 .or. first == 224 .and. second < 160 .or. &
                first == 237 .and. second > 159 .or. first == 240 .and. second < 144 .or. &
                first == 244 .and. second > 143) n = 0
        end associate
        ! Line and paragraph separators, and marks that turn the direction of writing.
        if (n == 3 .and. first == 226) then
            if (ichar(text(2:2)) == 128 .and. ichar(text(3:3)) >= 168 .and. &
                ichar(text(3:3)) <= 174) n = 0
        end if
    end function length_of_character
end module faststrip_files_printable
