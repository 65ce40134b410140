!> The rigid motion of a rolling contact.
module faststrip_base_creepage
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: creepage_t

    !> Creepages about the contact reference point (y = 0): velocity of the rail surface relative
    !> to the wheel surface over the rolling speed.
    type :: creepage_t
        real(wp) :: cksi = 0.0_wp !! longitudinal creepage, -
        real(wp) :: ceta = 0.0_wp !! lateral creepage, -
        real(wp) :: cphi = 0.0_wp !! spin creepage, rad/mm
    end type creepage_t
end module faststrip_base_creepage
