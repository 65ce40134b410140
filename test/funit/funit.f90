!> The part of pFUnit's interface that this project's tests use, under pFUnit's own names.
!>
!> A failed assertion throws an exception: a message and a source location, put on a list that the
!> runner empties after each test. Names, argument order and tolerances are those of pFUnit 4, so
!> the same `.pf` files also build against it. Stricter here: a relative comparison with an
!> expected value of zero, and a tolerance that is negative or no number, fail. NaN equals nothing.
!>
!> No assertion raises a floating-point exception, whatever it is given (also signalling NaN), so
!> tests may run with traps on.
module funit
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    implicit none
    private

    public :: SourceLocation
    public :: throw, catch, anyExceptions, getNumExceptions, clearAll, exception_text
    public :: assertTrue, assertFalse, assertEqual, assertRelativelyEqual
    public :: assertGreaterThan, assertGreaterThanOrEqual, assertLessThan, assertLessThanOrEqual
    public :: assertIsNaN, assertIsFinite, assertExceptionRaised

    !> Where an assertion stands.
    type :: SourceLocation
        character(len=255) :: fileName = '<unknown file>'
        integer :: lineNumber = -1
    end type SourceLocation

    type :: exception_t
        character(len=:), allocatable :: message
        type(SourceLocation) :: location
    end type exception_t

    !> What was thrown since the list was last emptied, oldest first.
    type(exception_t), allocatable, save :: exceptions(:)

    !> Text between the lines of one failure.
    character(len=*), parameter :: next_line = new_line('a') // '        '

    !> Is the last exception, or the one of this message, there? Then take it off the list.
    interface catch
        module procedure catch_any
        module procedure catch_message
    end interface catch

    interface assertTrue
        module procedure assert_true
        module procedure assert_true_all
    end interface assertTrue

    interface assertFalse
        module procedure assert_false
        module procedure assert_false_all
    end interface assertFalse

    !> Equal within an absolute tolerance (reals; zero if absent) or exactly. Reals and integers of
    !> ranks 0 to 2; a scalar expected value is compared with every element.
    interface assertEqual
        module procedure equal_real_within
        module procedure equal_real
        module procedure equal_int32
        module procedure equal_int64
        module procedure equal_int32_int64
        module procedure equal_string
    end interface assertEqual

    !> First argument greater than the second.
    interface assertGreaterThan
        module procedure greater_real
        module procedure greater_integer
    end interface assertGreaterThan

    interface assertGreaterThanOrEqual
        module procedure greater_or_equal_real
        module procedure greater_or_equal_integer
    end interface assertGreaterThanOrEqual

    !> First argument less than the second.
    interface assertLessThan
        module procedure less_real
        module procedure less_integer
    end interface assertLessThan

    interface assertLessThanOrEqual
        module procedure less_or_equal_real
        module procedure less_or_equal_integer
    end interface assertLessThanOrEqual

    interface assertExceptionRaised
        module procedure exception_raised
        module procedure exception_raised_message
    end interface assertExceptionRaised

contains

    ! Exceptions

    !> Put an exception on the list.
    subroutine throw(message, location)
        character(len=*), intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        type(exception_t) :: new

        new%message = message
        if (present(location)) new%location = location
        if (.not. allocated(exceptions)) allocate (exceptions(0))
        exceptions = [exceptions, new]
    end subroutine throw

    logical function catch_any(preserve) result(found)
        logical, optional, intent(in) :: preserve

        found = anyExceptions()
        if (.not. found) return
        if (.not. wants(preserve)) exceptions = exceptions(:size(exceptions) - 1)
    end function catch_any

    logical function catch_message(message, preserve) result(found)
        character(len=*), intent(in) :: message
        logical, optional, intent(in) :: preserve

        integer :: i

        found = .false.
        do i = 1, getNumExceptions()
            if (exceptions(i)%message /= message) cycle
            found = .true.
            if (.not. wants(preserve)) exceptions = [exceptions(:i - 1), exceptions(i + 1:)]
            return
        end do
    end function catch_message

    logical function wants(option)
        logical, optional, intent(in) :: option

        wants = .false.
        if (present(option)) wants = option
    end function wants

    logical function anyExceptions()
        anyExceptions = getNumExceptions() > 0
    end function anyExceptions

    integer function getNumExceptions()
        getNumExceptions = 0
        if (allocated(exceptions)) getNumExceptions = size(exceptions)
    end function getNumExceptions

    subroutine clearAll()
        if (allocated(exceptions)) deallocate (exceptions)
    end subroutine clearAll

    !> One exception as text, `file:line: message`.
    function exception_text(i) result(text)
        integer, intent(in) :: i !! 1 to getNumExceptions()
        character(len=:), allocatable :: text

        text = trim(exceptions(i)%location%fileName) // ':' &
               // decimal(int(exceptions(i)%location%lineNumber, int64)) // ': ' &
               // exceptions(i)%message
    end function exception_text

    ! Truth

    subroutine assert_true(condition, message, location)
        logical, intent(in) :: condition
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. condition) call fail('assertTrue', '', message, location)
    end subroutine assert_true

    subroutine assert_true_all(condition, message, location)
        logical, intent(in) :: condition(:)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. all(condition)) then
            call fail('assertTrue', next_line // 'first false element: ' &
                      // decimal(int(findloc(condition, .false., dim=1), int64)), &
                      message, location)
        end if
    end subroutine assert_true_all

    subroutine assert_false(condition, message, location)
        logical, intent(in) :: condition
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (condition) call fail('assertFalse', '', message, location)
    end subroutine assert_false

    subroutine assert_false_all(condition, message, location)
        logical, intent(in) :: condition(:)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (any(condition)) then
            call fail('assertFalse', next_line // 'first true element: ' &
                      // decimal(int(findloc(condition, .true., dim=1), int64)), &
                      message, location)
        end if
    end subroutine assert_false_all

    ! Equality

    subroutine equal_real(expected, actual, message, location)
        real(real64), intent(in) :: expected(..), actual(..)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_reals('assertEqual', .false., flat_real(expected), flat_real(actual), &
                           shape(expected), shape(actual), 0.0_real64, message, location)
    end subroutine equal_real

    subroutine equal_real_within(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(..), actual(..)
        real(real64), intent(in) :: tolerance
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_reals('assertEqual', .false., flat_real(expected), flat_real(actual), &
                           shape(expected), shape(actual), tolerance, message, location)
    end subroutine equal_real_within

    !> Equal within `tolerance*abs(expected)`; no expected value may be zero.
    subroutine assertRelativelyEqual(expected, actual, tolerance, message, location)
        real(real64), intent(in) :: expected(..), actual(..)
        real(real64), intent(in) :: tolerance
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_reals('assertRelativelyEqual', .true., flat_real(expected), &
                           flat_real(actual), shape(expected), shape(actual), tolerance, &
                           message, location)
    end subroutine assertRelativelyEqual

    subroutine compare_reals(name, relative, expected, actual, shape_e, shape_a, tolerance, &
                             message, location)
        character(len=*), intent(in) :: name
        logical, intent(in) :: relative
        real(real64), intent(in) :: expected(:), actual(:)
        integer, intent(in) :: shape_e(:), shape_a(:)
        real(real64), intent(in) :: tolerance
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        logical :: equal
        integer :: i, ie, n_bad, first
        character(len=:), allocatable :: detail

        if (.not. is_finite(tolerance) .or. is_negative(tolerance)) then
            call fail(name, next_line // 'tolerance is not a number >= 0: ' &
                      // text_of(tolerance), message, location)
            return
        end if
        if (.not. conformable(name, shape_e, shape_a, message, location)) return

        n_bad = 0
        first = 0
        do i = 1, size(actual)
            ie = merge(1, i, size(shape_e) == 0)
            if (relative) then
                equal = equal_relatively(expected(ie), actual(i), tolerance)
            else
                equal = equal_within(expected(ie), actual(i), tolerance)
            end if
            if (equal) cycle
            n_bad = n_bad + 1
            if (first == 0) first = i
        end do
        if (n_bad == 0) return

        ie = merge(1, first, size(shape_e) == 0)
        detail = next_line // 'expected:   ' // text_of(expected(ie)) &
                 // next_line // 'actual:     ' // text_of(actual(first)) &
                 // difference_text(relative, expected(ie), actual(first), tolerance) &
                 // place_text(first, n_bad, shape_a)
        call fail(name, detail, message, location)
    end subroutine compare_reals

    pure logical function equal_within(expected, actual, tolerance) result(equal)
        real(real64), intent(in) :: expected, actual, tolerance

        equal = .false.
        if (is_nan(expected) .or. is_nan(actual)) return
        equal = expected == actual
        if (equal .or. .not. (is_finite(expected) .and. is_finite(actual))) return
        if (can_subtract(expected, actual)) equal = abs(actual - expected) <= tolerance
    end function equal_within

    pure logical function equal_relatively(expected, actual, tolerance) result(equal)
        real(real64), intent(in) :: expected, actual, tolerance

        equal = .false.
        if (is_nan(expected) .or. is_nan(actual)) return
        if (expected == 0.0_real64) return
        equal = expected == actual
        if (equal .or. .not. (is_finite(expected) .and. is_finite(actual))) return
        if (.not. can_subtract(expected, actual)) return
        if (tolerance > 1.0_real64) then
            equal = abs(actual - expected)/tolerance <= abs(expected)
        else
            equal = abs(actual - expected) <= tolerance*abs(expected)
        end if
    end function equal_relatively

    !> Is the difference of two finite numbers finite?
    pure logical function can_subtract(a, b)
        real(real64), intent(in) :: a, b

        can_subtract = abs(0.5_real64*a - 0.5_real64*b) <= 0.5_real64*huge(a)
    end function can_subtract

    function difference_text(relative, expected, actual, tolerance) result(text)
        logical, intent(in) :: relative
        real(real64), intent(in) :: expected, actual, tolerance
        character(len=:), allocatable :: text

        real(real64) :: d

        text = ''
        if (.not. (is_finite(expected) .and. is_finite(actual))) return
        if (.not. can_subtract(expected, actual)) return
        d = actual - expected
        if (relative) then
            text = next_line // 'expected is zero: compare with a tolerance of assertEqual'
            if (expected == 0.0_real64) return
            text = ''
            if (abs(expected) < 1.0_real64) then
                if (abs(d) > abs(expected)*huge(d)) return
            end if
            d = d/expected
            text = next_line // 'relative:   '
        else
            text = next_line // 'difference: '
        end if
        text = text // text_of(d) // ' (tolerance ' // text_of(tolerance) // ')'
    end function difference_text

    subroutine equal_int32(expected, actual, message, location)
        integer(int32), intent(in) :: expected(..), actual(..)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_integers(flat_int32(expected), flat_int32(actual), shape(expected), &
                              shape(actual), message, location)
    end subroutine equal_int32

    subroutine equal_int64(expected, actual, message, location)
        integer(int64), intent(in) :: expected(..), actual(..)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_integers(flat_int64(expected), flat_int64(actual), shape(expected), &
                              shape(actual), message, location)
    end subroutine equal_int64

    subroutine equal_int32_int64(expected, actual, message, location)
        integer(int32), intent(in) :: expected(..)
        integer(int64), intent(in) :: actual(..)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call compare_integers(flat_int32(expected), flat_int64(actual), shape(expected), &
                              shape(actual), message, location)
    end subroutine equal_int32_int64

    subroutine compare_integers(expected, actual, shape_e, shape_a, message, location)
        integer(int64), intent(in) :: expected(:), actual(:)
        integer, intent(in) :: shape_e(:), shape_a(:)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        integer :: i, ie, n_bad, first

        if (.not. conformable('assertEqual', shape_e, shape_a, message, location)) return
        n_bad = 0
        first = 0
        do i = 1, size(actual)
            ie = merge(1, i, size(shape_e) == 0)
            if (expected(ie) == actual(i)) cycle
            n_bad = n_bad + 1
            if (first == 0) first = i
        end do
        if (n_bad == 0) return
        ie = merge(1, first, size(shape_e) == 0)
        call fail('assertEqual', next_line // 'expected:   ' // decimal(expected(ie)) &
                  // next_line // 'actual:     ' // decimal(actual(first)) &
                  // place_text(first, n_bad, shape_a), message, location)
    end subroutine compare_integers

    !> Equal but for leading and trailing blanks, pFUnit's default.
    subroutine equal_string(expected, found, message, location)
        character(len=*), intent(in) :: expected, found
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (trim(adjustl(expected)) == trim(adjustl(found))) return
        call fail('assertEqual', next_line // 'expected:   <' // trim(expected) // '>' &
                  // next_line // 'actual:     <' // trim(found) // '>', message, location)
    end subroutine equal_string

    ! Order

    subroutine greater_real(lhs, rhs, message, location)
        real(real64), intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call order_reals('assertGreaterThan', '>', lhs, rhs, message, location)
    end subroutine greater_real

    subroutine greater_or_equal_real(lhs, rhs, message, location)
        real(real64), intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call order_reals('assertGreaterThanOrEqual', '>=', lhs, rhs, message, location)
    end subroutine greater_or_equal_real

    subroutine less_real(lhs, rhs, message, location)
        real(real64), intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call order_reals('assertLessThan', '<', lhs, rhs, message, location)
    end subroutine less_real

    subroutine less_or_equal_real(lhs, rhs, message, location)
        real(real64), intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call order_reals('assertLessThanOrEqual', '<=', lhs, rhs, message, location)
    end subroutine less_or_equal_real

    subroutine order_reals(name, operator, lhs, rhs, message, location)
        character(len=*), intent(in) :: name, operator
        real(real64), intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        logical :: holds

        holds = .false.
        if (.not. (is_nan(lhs) .or. is_nan(rhs))) then
            select case (operator)
            case ('>'); holds = lhs > rhs
            case ('>='); holds = lhs >= rhs
            case ('<'); holds = lhs < rhs
            case ('<='); holds = lhs <= rhs
            end select
        end if
        if (.not. holds) call fail(name, order_text(operator, text_of(lhs), text_of(rhs)), &
                                   message, location)
    end subroutine order_reals

    subroutine greater_integer(lhs, rhs, message, location)
        integer, intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. lhs > rhs) call fail_order('assertGreaterThan', '>', lhs, rhs, message, location)
    end subroutine greater_integer

    subroutine greater_or_equal_integer(lhs, rhs, message, location)
        integer, intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. lhs >= rhs) then
            call fail_order('assertGreaterThanOrEqual', '>=', lhs, rhs, message, location)
        end if
    end subroutine greater_or_equal_integer

    subroutine less_integer(lhs, rhs, message, location)
        integer, intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. lhs < rhs) call fail_order('assertLessThan', '<', lhs, rhs, message, location)
    end subroutine less_integer

    subroutine less_or_equal_integer(lhs, rhs, message, location)
        integer, intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. lhs <= rhs) then
            call fail_order('assertLessThanOrEqual', '<=', lhs, rhs, message, location)
        end if
    end subroutine less_or_equal_integer

    subroutine fail_order(name, operator, lhs, rhs, message, location)
        character(len=*), intent(in) :: name, operator
        integer, intent(in) :: lhs, rhs
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        call fail(name, order_text(operator, decimal(int(lhs, int64)), &
                                   decimal(int(rhs, int64))), message, location)
    end subroutine fail_order

    function order_text(operator, lhs, rhs) result(text)
        character(len=*), intent(in) :: operator, lhs, rhs
        character(len=:), allocatable :: text

        text = next_line // 'expected:   ' // lhs // ' ' // operator // ' ' // rhs
    end function order_text

    ! Kinds of numbers

    subroutine assertIsNaN(x, message, location)
        real(real64), intent(in) :: x
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. is_nan(x)) then
            call fail('assertIsNaN', next_line // 'actual:     ' // text_of(x), message, location)
        end if
    end subroutine assertIsNaN

    subroutine assertIsFinite(x, message, location)
        real(real64), intent(in) :: x
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. is_finite(x)) then
            call fail('assertIsFinite', next_line // 'actual:     ' // text_of(x), message, &
                      location)
        end if
    end subroutine assertIsFinite

    ! Exceptions raised on purpose

    subroutine exception_raised(location)
        type(SourceLocation), optional, intent(in) :: location

        if (.not. catch()) call throw('assertExceptionRaised: nothing was thrown', location)
    end subroutine exception_raised

    subroutine exception_raised_message(message, location)
        character(len=*), intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (.not. catch(message)) then
            call throw('assertExceptionRaised: not thrown: <' // message // '>', location)
        end if
    end subroutine exception_raised_message

    ! Common parts

    subroutine fail(name, detail, message, location)
        character(len=*), intent(in) :: name
        character(len=*), intent(in) :: detail !! further lines, each after `next_line`
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        if (present(message)) then
            call throw(name // ': ' // trim(message) // detail, location)
        else
            call throw(name // detail, location)
        end if
    end subroutine fail

    logical function conformable(name, shape_e, shape_a, message, location)
        character(len=*), intent(in) :: name
        integer, intent(in) :: shape_e(:), shape_a(:)
        character(len=*), optional, intent(in) :: message
        type(SourceLocation), optional, intent(in) :: location

        conformable = size(shape_a) <= 2
        if (.not. conformable) then
            call fail(name, next_line // 'arrays of more than two dimensions', message, location)
            return
        end if
        conformable = size(shape_e) == 0
        if (conformable) return
        conformable = size(shape_e) == size(shape_a)
        if (conformable) conformable = all(shape_e == shape_a)
        if (conformable) return
        call fail(name, next_line // 'expected shape: ' // list_text(shape_e) &
                  // next_line // 'actual shape:   ' // list_text(shape_a), message, location)
    end function conformable

    !> Where in an array the first difference is; blank for scalars.
    function place_text(first, n_bad, shape_a) result(text)
        integer, intent(in) :: first, n_bad, shape_a(:)
        character(len=:), allocatable :: text

        select case (size(shape_a))
        case (1)
            text = list_text([first])
        case (2)
            text = list_text([mod(first - 1, shape_a(1)) + 1, (first - 1)/shape_a(1) + 1])
        case default
            text = ''
            return
        end select
        text = next_line // 'at element: ' // text // ', the first of ' &
               // decimal(int(n_bad, int64)) // ' that differ (of ' &
               // decimal(int(product(shape_a), int64)) // ')'
    end function place_text

    function list_text(list) result(text)
        integer, intent(in) :: list(:)
        character(len=:), allocatable :: text

        integer :: i

        text = '('
        do i = 1, size(list)
            if (i > 1) text = text // ', '
            text = text // decimal(int(list(i), int64))
        end do
        text = text // ')'
    end function list_text

    function decimal(i) result(text)
        integer(int64), intent(in) :: i
        character(len=:), allocatable :: text

        character(len=20) :: buffer

        write (buffer, '(i0)') i
        text = trim(buffer)
    end function decimal

    function text_of(x) result(text)
        real(real64), intent(in) :: x
        character(len=:), allocatable :: text

        character(len=25) :: buffer

        if (is_nan(x)) then
            text = 'NaN'
        else if (.not. is_finite(x)) then
            text = merge('-Infinity', 'Infinity ', is_negative(x))
            text = trim(text)
        else
            write (buffer, '(es24.16e3)') x
            text = trim(adjustl(buffer))
        end if
    end function text_of

    ! Looking at the bits never raises an exception, not even for a signalling NaN.

    pure logical function is_finite(x)
        real(real64), intent(in) :: x

        is_finite = ibits(transfer(x, 0_int64), 52, 11) /= 2047_int64
    end function is_finite

    pure logical function is_nan(x)
        real(real64), intent(in) :: x

        is_nan = .not. is_finite(x) .and. ibits(transfer(x, 0_int64), 0, 52) /= 0_int64
    end function is_nan

    !> Less than zero, minus infinity or a NaN with its sign set.
    pure logical function is_negative(x)
        real(real64), intent(in) :: x

        is_negative = btest(transfer(x, 0_int64), 63)
        if (is_finite(x)) is_negative = x < 0.0_real64
    end function is_negative

    function flat_real(x) result(list)
        real(real64), intent(in) :: x(..)
        real(real64), allocatable :: list(:)

        allocate (list(0))
        select rank (x)
        rank (0); list = [x]
        rank (1); list = x
        rank (2); list = reshape(x, [size(x)])
        end select
    end function flat_real

    function flat_int32(x) result(list)
        integer(int32), intent(in) :: x(..)
        integer(int64), allocatable :: list(:)

        allocate (list(0))
        select rank (x)
        rank (0); list = [int(x, int64)]
        rank (1); list = int(x, int64)
        rank (2); list = int(reshape(x, [size(x)]), int64)
        end select
    end function flat_int32

    function flat_int64(x) result(list)
        integer(int64), intent(in) :: x(..)
        integer(int64), allocatable :: list(:)

        allocate (list(0))
        select rank (x)
        rank (0); list = [x]
        rank (1); list = x
        rank (2); list = reshape(x, [size(x)])
        end select
    end function flat_int64
end module funit
