!> Doubles from decimal digits and decimal digits from doubles, correctly rounded, or not at all.
!>
!> The number is scaled by powers of ten in pairs of doubles, a sum of a double and of what is left
!> over (T.J. Dekker, Numer. Math. 18 (1971) 224-242), with some 100 bits. Where what is left over
!> lies so near to the middle between two results that these do not tell to which side, the answer
!> is "not sure", and the caller does it the long way. So the bits are those of the long way.
module faststrip_base_decimal
    use, intrinsic :: iso_fortran_env, only: int64, real64
    implicit none
    private

    public :: compose_decimal, decompose_decimal, most_digits

    ! Given: 10**18 fits into 63 bits.
    integer, parameter :: most_digits = 18 !! of a whole number that is composed

    ! Given: 5**22 fits into 53 bits: so far powers of ten are doubles.
    integer, parameter :: most_power = 22
    ! Given: whole numbers up to it are doubles.
    integer(int64), parameter :: exact_whole = 2_int64**53
    ! Tuned [1]: largest power of ten in use. Origin: safeguard: no product overflows or leaves less
    ! than a double holds.
    integer, parameter :: farthest = 66
    ! Tuned [1]: how near to the middle is not known, of the distance. Origin: safeguard: the errors
    ! of the pairs are below 2**(-45).
    real(real64), parameter :: doubt = 2.0_real64**(-36)

    integer :: k_
    real(real64), parameter :: ten(0:most_power) = &
        [(10.0_real64**k_, k_=0, most_power)]

    ! Given: the least and the first number beyond of 17 digits.
    real(real64), parameter :: least = 1.0e16_real64, beyond = 1.0e17_real64
    integer(int64), parameter :: least_whole = 10_int64**16, whole_beyond = 10_int64**17
    integer, parameter :: power_of_least = 16 ! Given: the same

contains

    !> The double nearest to `digits*10**power`.
    pure subroutine compose_decimal(digits, power, value, is_sure)
        integer(int64), intent(in) :: digits  !! 0 to below 10**most_digits
        integer, intent(in) :: power          !! any
        real(real64), intent(out) :: value    !! the number; 0 if not sure
        logical, intent(out) :: is_sure       !! is it?

        real(real64) :: high, low

        value = 0.0_real64
        is_sure = digits == 0
        if (is_sure .or. abs(power) > farthest) return
        high = real(digits, real64)
        if (digits <= exact_whole .and. abs(power) <= most_power) then
            ! Two doubles, and one operation that rounds.
            if (power < 0) then
                value = high/ten(-power)
            else
                value = high*ten(power)
            end if
            is_sure = .true.
            return
        end if
        low = real(digits - int(high, int64), real64)
        call scale_pair(high, low, power)
        ! `low` is at most half a unit in the last place of `high`: there the doubt is.
        is_sure = high + low*(1.0_real64 + doubt) == high
        if (is_sure) value = high
    end subroutine compose_decimal

    !> The 17 digits of a positive double, `digits*10**(power - 16)`.
    pure subroutine decompose_decimal(value, digits, power, is_sure)
        real(real64), intent(in) :: value      !! finite, above 0
        integer(int64), intent(out) :: digits  !! 10**16 to below 10**17; 0 if not sure
        integer, intent(out) :: power          !! power of ten of the first digit
        logical, intent(out) :: is_sure        !! are they the nearest?

        ! Given: a wrong first guess is off by one.
        integer, parameter :: tries = 3
        real(real64) :: high, low
        integer :: i

        digits = 0
        power = 0
        is_sure = .false.
        if (value < ten(most_power)**(-2) .or. value > ten(most_power)**2) return
        power = floor(log10(value))
        do i = 1, tries
            high = value
            low = 0.0_real64
            call scale_pair(high, low, power_of_least - power)
            if (high < least .or. (high <= least .and. low < 0.0_real64)) then
                power = power - 1
            else if (high > beyond .or. (high >= beyond .and. low >= 0.0_real64)) then
                power = power + 1
            else
                is_sure = abs(abs(low - anint(low)) - 0.5_real64) > doubt
                exit
            end if
        end do
        if (.not. is_sure) return
        digits = int(high, int64) + nint(low, int64)
        if (digits < whole_beyond) return
        digits = least_whole
        power = power + 1
    end subroutine decompose_decimal

    !> A pair times a power of ten.
    pure subroutine scale_pair(high, low, power)
        real(real64), intent(inout) :: high, low
        integer, intent(in) :: power

        real(real64) :: factor, product, error, whole, rest
        integer :: left, step

        left = abs(power)
        do while (left > 0)
            step = min(left, most_power)
            left = left - step
            factor = ten(step)
            if (power > 0) then
                call multiply(high, factor, product, error)
                error = error + low*factor
            else
                product = high/factor
                call multiply(product, factor, whole, rest)
                error = (((high - whole) - rest) + low)/factor
            end if
            high = product + error
            low = error - (high - product)
        end do
    end subroutine scale_pair

    !> A product and by how much it was rounded: `a*b = product + error`.
    pure subroutine multiply(a, b, product, error)
        real(real64), intent(in) :: a, b
        real(real64), intent(out) :: product, error

        ! Given: the lower 27 of 53 bits.
        integer(int64), parameter :: upper_bits = not(2_int64**27 - 1)
        real(real64) :: a_high, a_low, b_high, b_low

        product = a*b
        a_high = transfer(iand(transfer(a, upper_bits), upper_bits), a)
        a_low = a - a_high
        b_high = transfer(iand(transfer(b, upper_bits), upper_bits), b)
        b_low = b - b_high
        error = (((a_high*b_high - product) + a_high*b_low) + a_low*b_high) + a_low*b_low
    end subroutine multiply
end module faststrip_base_decimal
