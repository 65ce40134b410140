!> The logarithm of one and a small part.
module faststrip_numerics_logarithm
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: log_1p

contains

    !> ln(1 + d), d >= 0, with all its digits.
    !>
    !> What rounding takes from d in 1 + d is given back to first order. The directive makes forms
    !> for whole vectors, so that loops marked `!$omp simd` in other modules remain vector loops. It
    !> costs 1 to 2 % of a scalar influence coefficient off the centre line against the expression
    !> in place (gfortran 12); where it costs more a loop has its own.
    elemental real(wp) function log_1p(d)
        !$omp declare simd(log_1p) notinbranch
        real(wp), intent(in) :: d !! d, >= 0

        real(wp) :: one_d

        one_d = 1.0_wp + d
        log_1p = log(one_d) + (d - (one_d - 1.0_wp))/one_d
    end function log_1p
end module faststrip_numerics_logarithm
