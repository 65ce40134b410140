!> What every tangential method asks of friction, creepages and ellipse.
module faststrip_tangential_motion
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio, largest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_simple_hertz, only: hertz_t
    implicit none
    private

    public :: check_motion, cut_creepage, check_ellipse, over_force

contains

    !> Refuse friction below zero and anything not finite or beyond all proportion.
    pure subroutine check_motion(mu, creepage, status)
        real(wp), intent(in) :: mu               !! coefficient of friction
        type(creepage_t), intent(in) :: creepage !! rail relative to wheel
        type(status_t), intent(out) :: status    !! `st_not_finite`, `st_bad_argument`,
                                                 !! `st_out_of_range`

        call clear_status(status)
        if (.not. ieee_is_finite(mu)) then
            call set_status(status, st_not_finite, 'coefficient of friction must be a ' // &
                            'finite number, got ' // number_text(mu))
        else if (mu < 0.0_wp) then
            call set_status(status, st_bad_argument, &
                            'coefficient of friction must not be negative, got ' // &
                            trim(number_text(mu)))
        else if (.not. (ieee_is_finite(creepage%cksi) .and. ieee_is_finite(creepage%ceta) &
                        .and. ieee_is_finite(creepage%cphi))) then
            call set_status(status, st_not_finite, 'creepages must be finite numbers, got ' // &
                            trim(number_text(creepage%cksi)) // ', ' // &
                            trim(number_text(creepage%ceta)) // ', ' // &
                            trim(number_text(creepage%cphi)) // ' rad/mm')
        else if (max(mu, abs(creepage%cksi), abs(creepage%ceta), abs(creepage%cphi)) &
                 > largest_ratio) then
            call set_status(status, st_out_of_range, &
                            'friction and creepages must be at most 1e6, got ' // &
                            trim(number_text(mu)) // '; ' // &
                            trim(number_text(creepage%cksi)) // ', ' // &
                            trim(number_text(creepage%ceta)) // ', ' // &
                            trim(number_text(creepage%cphi)) // ' rad/mm')
        end if
    end subroutine check_motion

    !> Creepages that methods take: where a vehicle starts or stops they have no bound, but all
    !> slides long before, and forces hang on their proportions alone.
    pure subroutine cut_creepage(creepage, cut, share)
        type(creepage_t), intent(in) :: creepage !! rail relative to wheel
        type(creepage_t), intent(out) :: cut     !! of the same proportions, not beyond 1e6
        real(wp), intent(out) :: share           !! of it to the whole, 1 if nothing is cut

        cut = creepage
        share = 1.0_wp
        associate (most => max(abs(creepage%cksi), abs(creepage%ceta), abs(creepage%cphi)))
            if (.not. (most > largest_ratio .and. most <= huge(most))) return
            share = largest_ratio/most
            cut = creepage_t(largest_ratio*(creepage%cksi/most), &
                             largest_ratio*(creepage%ceta/most), &
                             largest_ratio*(creepage%cphi/most))
        end associate
    end subroutine cut_creepage

    !> Refuse what is no Hertz ellipse.
    pure subroutine check_ellipse(hertz, status)
        type(hertz_t), intent(in) :: hertz    !! any
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_bad_argument`

        call clear_status(status)
        if (.not. (ieee_is_finite(hertz%a) .and. ieee_is_finite(hertz%b) &
                   .and. ieee_is_finite(hertz%y) .and. ieee_is_finite(hertz%load))) then
            call set_status(status, st_not_finite, 'a Hertz ellipse that is not finite')
        else if (hertz%a <= 0.0_wp .or. hertz%b <= 0.0_wp .or. hertz%load < 0.0_wp) then
            call set_status(status, st_bad_argument, 'no Hertz ellipse')
        end if
    end subroutine check_ellipse

    !> A linear force over mu N, cut where it is beyond all slip.
    elemental real(wp) function over_force(linear, force) result(ratio)
        real(wp), intent(in) :: linear !! of either sign, N
        real(wp), intent(in) :: force  !! mu N, above 1e-60 N

        ratio = min(abs(linear)/force, largest_size)
    end function over_force
end module faststrip_tangential_motion
