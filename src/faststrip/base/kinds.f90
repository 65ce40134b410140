!> The real kind of the whole toolkit and the mathematical constants it shares.
module faststrip_base_kinds
    use, intrinsic :: iso_fortran_env, only: real64
    implicit none
    private

    public :: wp, pi, log_10

    !> Working precision: IEEE binary64.
    integer, parameter :: wp = real64

    !> Ratio of a circle's circumference to its diameter.
    real(wp), parameter :: pi = 3.141592653589793238462643383279502884_wp

    !> Natural logarithm of 10: a power of ten is `exp(log_10*exponent)`.
    real(wp), parameter :: log_10 = 2.302585092994045684017991454684364208_wp
end module faststrip_base_kinds
