!> What every tangential method asks of friction and creepages.
module faststrip_tangential_motion
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, set_status, clear_status, number_text, &
                                st_bad_argument, st_not_finite, st_out_of_range
    use faststrip_creepage, only: creepage_t
    implicit none
    private

    public :: check_motion

    !> Friction coefficients and creepages (spin in rad/mm) beyond this are refused.
    real(wp), parameter :: largest = 1.0e6_wp

contains

    !> Refuse friction below zero and anything not finite or beyond all proportion.
    pure subroutine check_motion(mu, creepage, status)
        real(wp), intent(in) :: mu               !! coefficient of friction
        type(creepage_t), intent(in) :: creepage !! rail relative to wheel
        type(status_t), intent(out) :: status    !! `st_not_finite`, `st_bad_argument`,
                                                 !! `st_out_of_range`

        call clear_status(status)
        if (.not. ieee_is_finite(mu)) then
            call set_status(status, st_not_finite, 'coefficient of friction is not finite')
        else if (mu < 0.0_wp) then
            call set_status(status, st_bad_argument, 'coefficient of friction is negative: ' // &
                            trim(number_text(mu)))
        else if (.not. (ieee_is_finite(creepage%cksi) .and. ieee_is_finite(creepage%ceta) &
                        .and. ieee_is_finite(creepage%cphi))) then
            call set_status(status, st_not_finite, 'creepages are not finite: ' // &
                            trim(number_text(creepage%cksi)) // ', ' // &
                            trim(number_text(creepage%ceta)) // ', ' // &
                            trim(number_text(creepage%cphi)) // ' rad/mm')
        else if (max(mu, abs(creepage%cksi), abs(creepage%ceta), abs(creepage%cphi)) &
                 > largest) then
            call set_status(status, st_out_of_range, 'friction or creepage above 1e6: ' // &
                            trim(number_text(mu)) // '; ' // &
                            trim(number_text(creepage%cksi)) // ', ' // &
                            trim(number_text(creepage%ceta)) // ', ' // &
                            trim(number_text(creepage%cphi)) // ' rad/mm')
        end if
    end subroutine check_motion
end module faststrip_tangential_motion
