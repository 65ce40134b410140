!> The one way in which the library says how a call ended.
!>
!> A code is zero (all is well), below `first_error` (the result stands, with a named limitation)
!> or from `first_error` on (there is no result). Every code has one short word, for a CSV column,
!> and the status carries a message of fixed length that names the offending value. Nothing is
!> allocated, printed or stopped.
!>
!> A result may have several limitations: the code is the first's, `limitations` is the set of all.
module faststrip_base_status
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: status_t, set_status, clear_status, is_error, status_word, number_text, count_text
    public :: add_limitation, join_limitations, limitation_words
    public :: add_words, message_length, first_error
    public :: st_ok
    public :: st_fallback_used, st_edge_of_data, st_fewer_strips, st_overlap_left
    public :: st_flat_along_x, st_conformal, st_target_missed, st_under_resolved, st_more_strips
    public :: st_beyond_yield, st_no_wave, st_not_unique
    public :: st_bad_argument, st_not_finite, st_not_increasing, st_too_few_points, st_bad_material
    public :: st_bad_load, st_no_contact, st_no_hertz_ellipse, st_no_convergence, st_out_of_range
    public :: st_workspace_too_small, st_linear_algebra, st_quadrature, st_no_finite_patch
    public :: st_beyond_adhesion, st_file_missing, st_file_format, st_file_write

    !> Length of a status message, characters.
    integer, parameter :: message_length = 256

    integer, parameter :: st_ok = 0

    ! Converged, with a named limitation.
    integer, parameter :: st_fallback_used = 1
    integer, parameter :: st_edge_of_data = 2
    integer, parameter :: st_fewer_strips = 3
    integer, parameter :: st_overlap_left = 4
    integer, parameter :: st_flat_along_x = 5
    integer, parameter :: st_conformal = 6
    integer, parameter :: st_target_missed = 7
    integer, parameter :: st_under_resolved = 8
    integer, parameter :: st_more_strips = 9
    integer, parameter :: st_beyond_yield = 10
    integer, parameter :: st_no_wave = 11
    integer, parameter :: st_not_unique = 12

    !> The lowest code that means "no result".
    integer, parameter :: first_error = 100
    integer, parameter :: st_bad_argument = 100
    integer, parameter :: st_not_finite = 101
    integer, parameter :: st_not_increasing = 102
    integer, parameter :: st_too_few_points = 103
    integer, parameter :: st_bad_material = 104
    integer, parameter :: st_bad_load = 105
    integer, parameter :: st_no_contact = 106
    integer, parameter :: st_no_hertz_ellipse = 107
    integer, parameter :: st_no_convergence = 108
    integer, parameter :: st_out_of_range = 109
    integer, parameter :: st_workspace_too_small = 110
    integer, parameter :: st_linear_algebra = 111
    integer, parameter :: st_quadrature = 112
    integer, parameter :: st_no_finite_patch = 113
    integer, parameter :: st_beyond_adhesion = 114
    integer, parameter :: st_file_missing = 120
    integer, parameter :: st_file_format = 121
    integer, parameter :: st_file_write = 122

    !> How a call ended: a code of the public list and words about it (blank when all is well).
    type :: status_t
        integer :: code = st_ok
        character(len=message_length) :: message = ''
        integer :: limitations = 0 !! the set of all: bit `code` for each, so 2 to the code added up
    end type status_t

contains

    !> Record a code and a message; words beyond `message_length` are cut.
    pure subroutine set_status(status, code, message)
        type(status_t), intent(out) :: status  !! what the caller reads
        integer, intent(in) :: code            !! one of the `st_` codes
        character(len=*), intent(in) :: message !! what went wrong, with the offending value

        status%code = code
        status%message = message
        if (code > st_ok .and. code < first_error) status%limitations = ibset(0, code)
    end subroutine set_status

    !> Add a limitation to a status: the first one gives the code, the words are strung together.
    pure subroutine add_limitation(status, code, words)
        type(status_t), intent(inout) :: status !! limitations so far, no error
        integer, intent(in) :: code             !! of the further one
        character(len=*), intent(in) :: words   !! about it

        if (status%code == st_ok) then
            call set_status(status, code, words)
            return
        end if
        status%limitations = ibset(status%limitations, code)
        if (len_trim(status%message) + 2 + len_trim(words) > message_length) return
        call add_words(status%message, ';')
        status%message(len_trim(status%message) + 2:) = words
    end subroutine add_limitation

    !> Add all limitations of another status: its words as those of one.
    pure subroutine join_limitations(status, other)
        type(status_t), intent(inout) :: status !! limitations so far, no error
        type(status_t), intent(in) :: other     !! no error

        if (other%code == st_ok) return
        call add_limitation(status, other%code, other%message)
        status%limitations = ior(status%limitations, other%limitations)
    end subroutine join_limitations

    !> The words of a set of limitations with blanks between, in the order of their codes.
    pure function limitation_words(limitations) result(words)
        integer, intent(in) :: limitations      !! of a status
        character(len=message_length) :: words  !! empty if there is none

        integer :: code

        words = ''
        do code = 1, bit_size(limitations) - 2
            if (.not. btest(limitations, code)) cycle
            if (words == '') then
                words = status_word(code)
            else
                call add_words(words, ' ' // status_word(code))
            end if
        end do
    end function limitation_words

    !> Set a status to "all is well".
    pure subroutine clear_status(status)
        type(status_t), intent(inout) :: status !! what the caller reads

        status%code = st_ok
        status%message = ''
        status%limitations = 0
    end subroutine clear_status

    !> Is there no result? A named limitation is no error.
    pure logical function is_error(status)
        type(status_t), intent(in) :: status !! the status of a call

        is_error = status%code >= first_error
    end function is_error

    !> The short word of a code, for a CSV column; `unknown_status` for a code not in the list.
    pure function status_word(code) result(word)
        integer, intent(in) :: code   !! one of the `st_` codes
        character(len=20) :: word     !! lower case, underscores, no blanks inside

        select case (code)
        case (st_ok); word = 'ok'
        case (st_fallback_used); word = 'fallback_used'
        case (st_edge_of_data); word = 'edge_of_data'
        case (st_fewer_strips); word = 'fewer_strips'
        case (st_overlap_left); word = 'overlap_left'
        case (st_flat_along_x); word = 'flat_along_x'
        case (st_conformal); word = 'conformal'
        case (st_target_missed); word = 'target_missed'
        case (st_under_resolved); word = 'under_resolved'
        case (st_more_strips); word = 'more_strips'
        case (st_beyond_yield); word = 'beyond_yield'
        case (st_no_wave); word = 'no_wave'
        case (st_not_unique); word = 'not_unique'
        case (st_bad_argument); word = 'bad_argument'
        case (st_not_finite); word = 'not_finite'
        case (st_not_increasing); word = 'not_increasing'
        case (st_too_few_points); word = 'too_few_points'
        case (st_bad_material); word = 'bad_material'
        case (st_bad_load); word = 'bad_load'
        case (st_no_contact); word = 'no_contact'
        case (st_no_hertz_ellipse); word = 'no_hertz_ellipse'
        case (st_no_convergence); word = 'no_convergence'
        case (st_out_of_range); word = 'out_of_range'
        case (st_workspace_too_small); word = 'workspace_too_small'
        case (st_linear_algebra); word = 'linear_algebra'
        case (st_quadrature); word = 'quadrature'
        case (st_no_finite_patch); word = 'no_finite_patch'
        case (st_beyond_adhesion); word = 'beyond_adhesion'
        case (st_file_missing); word = 'file_missing'
        case (st_file_format); word = 'file_format'
        case (st_file_write); word = 'file_write'
        case default; word = 'unknown_status'
        end select
    end function status_word

    !> Add words to a text of fixed length; words beyond its end are cut.
    !>
    !> Unlike `//` with `trim` this takes no memory, which words of limitations may not.
    pure subroutine add_words(text, words)
        character(len=*), intent(inout) :: text !! blank-padded
        character(len=*), intent(in) :: words   !! begin with a blank where one is wanted

        text(len_trim(text) + 1:) = words
    end subroutine add_words

    !> A number as short text for a message: six significant digits, as by the format `g0.6`; NaN
    !> and Inf by name. Without `write`, which takes memory of the Fortran run-time library.
    pure function number_text(value) result(text)
        real(wp), intent(in) :: value  !! any double, also NaN or infinite
        character(len=14) :: text      !! left-adjusted, blank-padded

        character(len=6) :: digits
        real(wp) :: scaled
        integer :: exponent ! of ten, the digits taken as 0.123456

        text = ''
        if (ieee_is_nan(value)) then
            text = 'NaN'
            return
        end if
        if (sign(1.0_wp, value) < 0.0_wp) text = '-'
        if (.not. ieee_is_finite(value)) then
            call add_words(text, 'Inf')
            return
        end if
        scaled = abs(value)
        exponent = merge(6, 1, scaled > 0.0_wp)
        do while (scaled >= 999999.5_wp)
            scaled = scaled/10.0_wp
            exponent = exponent + 1
        end do
        do while (scaled > 0.0_wp .and. scaled < 99999.95_wp)
            scaled = scaled*10.0_wp
            exponent = exponent - 1
        end do
        digits = six_digits(nint(scaled))
        if (exponent < 0 .or. exponent > 6) then
            call add_words(text, '0.'//digits//'E')
            if (exponent > 0) call add_words(text, '+')
            call add_words(text, count_text(exponent))
        else if (exponent == 0) then
            call add_words(text, '0.'//digits)
        else
            call add_words(text, digits(:exponent))
            call add_words(text, '.')
            call add_words(text, digits(exponent + 1:))
        end if
    end function number_text

    !> A whole number as text for a message. Of fixed length: for the length of any other gfortran
    !> keeps a variable that all threads share.
    pure function count_text(n) result(text)
        integer, intent(in) :: n  !! any integer
        character(len=11) :: text !! left-adjusted, blank-padded

        character(len=11) :: backwards
        integer :: rest, i, length

        ! Below zero, where there is one more number than above.
        rest = n
        if (n > 0) rest = -n
        length = 0
        do
            length = length + 1
            backwards(length:length) = digit(-mod(rest, 10))
            rest = rest/10
            if (rest == 0) exit
        end do
        if (n < 0) then
            length = length + 1
            backwards(length:length) = '-'
        end if
        text = ''
        do i = 1, length
            text(i:i) = backwards(length + 1 - i:length + 1 - i)
        end do
    end function count_text

    !> A number from 0 to 999999 with leading zeros.
    pure function six_digits(n) result(text)
        integer, intent(in) :: n
        character(len=6) :: text

        integer :: rest, i

        rest = n
        do i = 6, 1, -1
            text(i:i) = digit(mod(rest, 10))
            rest = rest/10
        end do
    end function six_digits

    pure character(len=1) function digit(n)
        integer, intent(in) :: n ! 0 to 9

        digit = achar(iachar('0') + n)
    end function digit
end module faststrip_base_status
