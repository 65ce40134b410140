!> Sizes whose quotients stay far from the ends of the number range.
module faststrip_influence_plain_sizes
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: beyond_all
    implicit none
    private

    public :: is_plain, least_plain, largest_plain

    !> Lengths in mm between which columns divide without a second thought. Contacts
    !> have 1e-3 to 1e3; what lies outside goes to the scalar procedures, at their cost.
    real(wp), parameter :: least_plain = 1.0_wp/beyond_all
    !> The same, above.
    real(wp), parameter :: largest_plain = beyond_all

contains

    !> Are these sizes such that their quotients stay far from the ends of the number range?
    elemental logical function is_plain(half_length, place)
        real(wp), intent(in) :: half_length !! of a strip, mm
        real(wp), intent(in) :: place       !! the size of a coordinate, mm

        is_plain = .false.
        if (.not. (ieee_is_finite(half_length) .and. ieee_is_finite(place))) return
        is_plain = half_length >= least_plain .and. half_length <= largest_plain &
                   .and. place <= largest_plain
    end function is_plain
end module faststrip_influence_plain_sizes
