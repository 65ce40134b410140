!> Words and numbers of a text, read strictly; how an error in a file is reported.
!>
!> Lengths of function results are found by functions: where they are deferred (`len=:`), gfortran
!> 12 keeps the length of a result in memory that all threads share.
module faststrip_base_text
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_decimal, only: compose_decimal, most_digits
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, count_text, message_length
    implicit none
    private

    public :: trim_blanks, parse_real, parse_integer, integer_text, lower_case, set_place_status

    character(len=*), parameter :: digits = '0123456789'
    character(len=1), parameter :: tab = achar(9)

    ! The first 20 significant digits of half-way between the largest double and the next one
    ! that cannot be represented, and the power of ten of its first digit.
    character(len=*), parameter :: overflow_digits = '17976931348623158079'
    integer, parameter :: overflow_exponent = 308, underflow_exponent = -330

contains

    ! Length of a text without the blanks and tabulators at its two ends.
    pure integer function inner_length(text) result(length)
        character(len=*), intent(in) :: text

        length = verify(text, ' ' // tab, back=.true.)
        if (length > 0) length = length - verify(text, ' ' // tab) + 1
    end function inner_length

    ! Characters of a whole number.
    pure integer function number_length(value) result(length)
        integer, intent(in) :: value
        integer :: rest

        length = merge(2, 1, value < 0)
        rest = value/10
        do while (rest /= 0)
            length = length + 1
            rest = rest/10
        end do
    end function number_length

    !> Text without the blanks and tabulators at its two ends.
    pure function trim_blanks(text) result(inner)
        character(len=*), intent(in) :: text           !! any text
        character(len=inner_length(text)) :: inner     !! may be empty

        if (len(inner) > 0) inner = text(verify(text, ' ' // tab):)
    end function trim_blanks

    !> Text with the letters A to Z made small.
    pure function lower_case(text) result(lower)
        character(len=*), intent(in) :: text      !! any text
        character(len=len(text)) :: lower         !! the same with a to z
        integer :: i

        lower = text
        do i = 1, len(text)
            if (lge(text(i:i), 'A') .and. lle(text(i:i), 'Z')) then
                lower(i:i) = achar(iachar(text(i:i)) + 32)
            end if
        end do
    end function lower_case

    !> A real number that fills the whole text: sign, digits with at most one point, exponent
    !> with e or d. Nothing else passes: no blank inside, no comma, no unit, no NaN, no infinity,
    !> no number beyond the largest double. Numbers too small for a double become zero.
    pure subroutine parse_real(text, value, valid)
        character(len=*), intent(in) :: text !! blanks at the two ends are allowed
        real(wp), intent(out) :: value       !! the number; 0 if not valid
        logical, intent(out) :: valid        !! is it a number?
        integer :: first, last

        last = len(text)
        do while (last > 0)
            if (.not. is_blank(text(last:last))) exit
            last = last - 1
        end do
        first = 1
        do while (first < last)
            if (.not. is_blank(text(first:first))) exit
            first = first + 1
        end do
        call parse_usual_real(text(first:last), value, valid)
        if (.not. valid) call parse_any_real(text(first:last), value, valid)
    end subroutine parse_real

    pure logical function is_blank(letter)
        character(len=1), intent(in) :: letter

        is_blank = letter == ' ' .or. letter == tab
    end function is_blank

    ! A number of as few digits as are read at a glance.
    pure subroutine parse_usual_real(word, value, valid)
        character(len=*), intent(in) :: word
        real(wp), intent(out) :: value
        logical, intent(out) :: valid ! if not, it may be one nevertheless

        ! Tuned [1]: largest exponent of ten. Origin: safeguard: beyond all doubles.
        integer, parameter :: most_exponent = 1000
        integer(int64) :: mantissa
        integer :: i, start, digit, n_digits, exponent, power
        logical :: any_digit, point

        value = 0.0_wp
        valid = .false.
        start = 1
        if (len(word) > 0) then
            if (word(1:1) == '-' .or. word(1:1) == '+') start = 2
        end if
        mantissa = 0
        n_digits = 0
        power = 0
        any_digit = .false.
        point = .false.
        do i = start, len(word)
            digit = iachar(word(i:i)) - iachar('0')
            if (digit >= 0 .and. digit <= 9) then ! Given: digits
                any_digit = .true.
                if (n_digits == most_digits) return
                mantissa = 10*mantissa + digit
                if (mantissa > 0) n_digits = n_digits + 1
                if (point) power = power - 1
            else if (word(i:i) == '.' .and. .not. point) then
                point = .true.
            else
                exit
            end if
        end do
        if (.not. any_digit) return
        if (i <= len(word)) then
            select case (word(i:i))
            case ('e', 'E', 'd', 'D')
            case default
                return
            end select
            if (i == len(word)) return
            start = i + 1
            if (word(start:start) == '-' .or. word(start:start) == '+') start = start + 1
            if (start > len(word)) return
            exponent = 0
            do i = start, len(word)
                digit = iachar(word(i:i)) - iachar('0')
                if (digit < 0 .or. digit > 9) return ! Given: digits
                exponent = 10*exponent + digit
                if (exponent > most_exponent) return
            end do
            if (word(start - 1:start - 1) == '-') exponent = -exponent
            power = power + exponent
        end if
        call compose_decimal(mantissa, power, value, valid)
        if (word(1:1) == '-' .and. mantissa > 0) value = -value
    end subroutine parse_usual_real

    pure subroutine parse_any_real(word, value, valid)
        character(len=*), intent(in) :: word
        real(wp), intent(out) :: value
        logical, intent(out) :: valid
        character(len=20) :: leading
        integer :: i, code, power, n_leading, first_power
        logical :: exponent_valid

        value = 0.0_wp
        valid = .false.
        call scan_mantissa(word, i, leading, n_leading, first_power)
        if (i == 0) return
        power = 0
        if (i <= len(word)) then
            if (scan(word(i:i), 'eEdD') == 0) return
            call scan_exponent(word(i + 1:), power, exponent_valid)
            if (.not. exponent_valid) return
        end if
        if (n_leading == 0 .or. first_power + power < underflow_exponent) then
            valid = .true.
            return
        end if
        if (first_power + power > overflow_exponent) return
        if (first_power + power == overflow_exponent) then
            if (lge(leading, overflow_digits)) return
        end if
        read (word, *, iostat=code) value
        valid = code == 0
        if (.not. valid) value = 0.0_wp
    end subroutine parse_any_real

    ! The mantissa of a number: `next` is the place after it (0: there is none), `leading` its
    ! first 20 digits from the first that is not zero, `first_power` the power of ten of that.
    pure subroutine scan_mantissa(word, next, leading, n_leading, first_power)
        character(len=*), intent(in) :: word
        integer, intent(out) :: next, n_leading, first_power
        character(len=20), intent(out) :: leading
        integer :: i, start, n_digits, n_before_point
        logical :: point

        next = 0
        leading = repeat('0', 20)
        n_leading = 0
        first_power = 0
        n_digits = 0
        n_before_point = 0
        point = .false.
        start = 1
        if (len(word) > 0) then
            if (scan(word(1:1), '+-') == 1) start = 2
        end if
        do i = start, len(word)
            if (word(i:i) == '.') then
                if (point) return
                point = .true.
            else if (index(digits, word(i:i)) > 0) then
                n_digits = n_digits + 1
                if (.not. point) n_before_point = n_before_point + 1
                if (n_leading > 0 .or. word(i:i) /= '0') then
                    n_leading = n_leading + 1
                    if (n_leading == 1) first_power = n_digits
                    if (n_leading <= len(leading)) leading(n_leading:n_leading) = word(i:i)
                end if
            else
                exit
            end if
        end do
        first_power = n_before_point - first_power
        if (n_digits > 0) next = i
    end subroutine scan_mantissa

    ! The digits of an exponent with an optional sign, limited to +-100000.
    pure subroutine scan_exponent(word, power, valid)
        character(len=*), intent(in) :: word
        integer, intent(out) :: power
        logical, intent(out) :: valid
        integer :: i, start

        power = 0
        start = 1
        if (len(word) > 0) then
            if (scan(word(1:1), '+-') == 1) start = 2
        end if
        valid = len(word) >= start
        if (.not. valid) return
        valid = verify(word(start:), digits) == 0
        if (.not. valid) return
        do i = start, len(word)
            power = min(10*power + index(digits, word(i:i)) - 1, 100000)
        end do
        if (word(1:1) == '-') power = -power
    end subroutine scan_exponent

    !> A whole number that fills the whole text: sign and digits.
    pure subroutine parse_integer(text, value, valid)
        character(len=*), intent(in) :: text !! blanks at the two ends are allowed
        integer, intent(out) :: value        !! the number; 0 if not valid
        logical, intent(out) :: valid        !! is it a whole number that fits?
        character(len=:), allocatable :: word
        integer :: start, code

        value = 0
        valid = .false.
        word = trim_blanks(text)
        start = 1
        if (len(word) > 0) then
            if (scan(word(1:1), '+-') == 1) start = 2
        end if
        if (len(word) < start) return
        if (verify(word(start:), digits) /= 0) return
        read (word, *, iostat=code) value
        valid = code == 0
        if (.not. valid) value = 0
    end subroutine parse_integer

    !> A whole number as text without blanks.
    pure function integer_text(value) result(text)
        integer, intent(in) :: value           !! any
        character(len=number_length(value)) :: text !! sign and digits

        text = count_text(value)
    end function integer_text

    !> Record an error in a file as `<what>, got <value> (<file>:<line>)`.
    !>
    !> Where the message would not fit, first the value, then the beginning of the file's name
    !> is shortened: the line number stays readable.
    pure subroutine set_place_status(status, code, what, value, file, line)
        type(status_t), intent(out) :: status  !! what the caller reads
        integer, intent(in) :: code            !! one of the `st_` codes
        character(len=*), intent(in) :: what   !! what must be
        character(len=*), intent(in) :: value  !! the offending value; empty: left out
        character(len=*), intent(in) :: file   !! name of the file
        integer, intent(in) :: line            !! line number; below 1: left out
        character(len=:), allocatable :: words, place
        integer, parameter :: longest_value = 60
        integer :: capacity

        words = what
        if (len(value) > longest_value) then
            words = words // ', got ' // value(:longest_value) // '...'
        else if (len(value) > 0) then
            words = words // ', got ' // value
        end if
        place = ')'
        if (line > 0) place = ':' // integer_text(line) // ')'
        capacity = message_length - len(words) - len(place) - 2
        if (len(file) <= capacity) then
            place = ' (' // file // place
        else
            capacity = max(capacity - 3, 0)
            place = ' (...' // file(len(file) - capacity + 1:) // place
        end if
        call set_status(status, code, words // place)
    end subroutine set_place_status
end module faststrip_base_text
