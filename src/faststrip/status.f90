!> The one way in which the library says how a call ended.
!>
!> A code is zero (all is well), below `first_error` (the result stands, with a named limitation)
!> or from `first_error` on (there is no result). Every code has one short word, for a CSV column,
!> and the status carries a message of fixed length that names the offending value. Nothing is
!> allocated, printed or stopped.
module faststrip_status
    use faststrip_kinds, only: wp
    implicit none
    private

    public :: status_t, set_status, clear_status, is_error, status_word, number_text, count_text
    public :: message_length, first_error
    public :: st_ok
    public :: st_fallback_used, st_edge_of_data, st_fewer_strips, st_overlap_left
    public :: st_flat_along_x, st_conformal, st_target_missed, st_under_resolved, st_more_strips
    public :: st_bad_argument, st_not_finite, st_not_increasing, st_too_few_points, st_bad_material
    public :: st_bad_load, st_no_contact, st_no_hertz_ellipse, st_no_convergence, st_out_of_range
    public :: st_workspace_too_small, st_linear_algebra, st_quadrature, st_no_finite_patch
    public :: st_file_missing, st_file_format, st_file_write

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
    integer, parameter :: st_file_missing = 120
    integer, parameter :: st_file_format = 121
    integer, parameter :: st_file_write = 122

    !> How a call ended: a code of the public list and words about it (blank when all is well).
    type :: status_t
        integer :: code = st_ok
        character(len=message_length) :: message = ''
    end type status_t

contains

    !> Record a code and a message; words beyond `message_length` are cut.
    pure subroutine set_status(status, code, message)
        type(status_t), intent(out) :: status  !! what the caller reads
        integer, intent(in) :: code            !! one of the `st_` codes
        character(len=*), intent(in) :: message !! what went wrong, with the offending value

        status%code = code
        status%message = message
    end subroutine set_status

    !> Set a status to "all is well".
    pure subroutine clear_status(status)
        type(status_t), intent(out) :: status !! what the caller reads

        status%code = st_ok
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
        case (st_file_missing); word = 'file_missing'
        case (st_file_format); word = 'file_format'
        case (st_file_write); word = 'file_write'
        case default; word = 'unknown_status'
        end select
    end function status_word

    !> A number as short text for a message: six significant digits; NaN and Inf by name.
    pure function number_text(value) result(text)
        real(wp), intent(in) :: value  !! any double, also NaN or infinite
        character(len=14) :: text      !! left-adjusted, blank-padded

        write (text, '(g0.6)') value
        text = adjustl(text)
    end function number_text

    !> A whole number as text for a message. Of fixed length: for the length of any other gfortran
    !> keeps a variable that all threads share.
    pure function count_text(n) result(text)
        integer, intent(in) :: n  !! any integer
        character(len=11) :: text !! left-adjusted, blank-padded

        write (text, '(i0)') n
    end function count_text
end module faststrip_status
