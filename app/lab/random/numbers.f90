!> Random numbers, the same for the same seed on every machine.
module faststrip_lab_random_numbers
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp, pi
    implicit none
    private

    public :: random_t, start_random, uniform, log_uniform, chance, pick, normal

    !> State: L'Ecuyer's MRG32k3a (Operations Research 47, 1999, 159-164),
    !> whose products stay below 2**53.
    type :: random_t
        integer(int64) :: s1(3) = 0
        integer(int64) :: s2(3) = 0
    end type random_t

contains

    !> Start the numbers of one case.
    subroutine start_random(seed, number, random)
        integer, intent(in) :: seed, number
        type(random_t), intent(out) :: random

        real(wp) :: unused
        integer :: i

        random%s1 = [12345_int64 + seed, 12345_int64 + number, 12345_int64]
        random%s2 = [12345_int64, 12345_int64 + number, 12345_int64 + seed]
        do i = 1, 30
            unused = uniform(random, 0.0_wp, 1.0_wp)
        end do
    end subroutine start_random

    !> Evenly between two bounds.
    real(wp) function uniform(random, low, high)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: low, high

        integer(int64), parameter :: m1 = 4294967087_int64, m2 = 4294944443_int64
        integer(int64) :: p1, p2

        p1 = modulo(1403580_int64*random%s1(2) - 810728_int64*random%s1(1), m1)
        p2 = modulo(527612_int64*random%s2(3) - 1370589_int64*random%s2(1), m2)
        random%s1 = [random%s1(2), random%s1(3), p1]
        random%s2 = [random%s2(2), random%s2(3), p2]
        uniform = low + (high - low)*real(modulo(p1 - p2, m1), wp)/real(m1, wp)
    end function uniform

    !> Evenly in the logarithm.
    real(wp) function log_uniform(random, low, high)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: low, high

        log_uniform = exp(uniform(random, log(low), log(high)))
    end function log_uniform

    !> A whole number from 1 to n.
    integer function pick(random, n)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: n

        pick = 1 + int(uniform(random, 0.0_wp, real(n, wp)))
    end function pick

    !> True with a probability.
    logical function chance(random, probability)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: probability

        chance = uniform(random, 0.0_wp, 1.0_wp) < probability
    end function chance

    !> Normally distributed with deviation one (Box and Muller).
    real(wp) function normal(random)
        type(random_t), intent(inout) :: random

        real(wp) :: u

        u = 1.0_wp - uniform(random, 0.0_wp, 1.0_wp)
        normal = sqrt(-2.0_wp*log(u))*cos(uniform(random, 0.0_wp, 2.0_wp*pi))
    end function normal
end module faststrip_lab_random_numbers
