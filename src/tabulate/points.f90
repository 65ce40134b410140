!> Points that fill a box evenly without a pattern: Halton's, shifted by a seed. Each is found from
!> its number alone, so that what is done at them may be shared out in any way.
module faststrip_tabulate_points
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: scattered_point

    ! The most coordinates of a point.
    ! Given: as many bases.
    integer, parameter :: most_coordinates = 9
    ! Given: the first primes.
    integer, parameter :: bases(most_coordinates) = [2, 3, 5, 7, 11, 13, 17, 19, 23]
    ! Points of Halton's that are left out, which lie on lines in the large bases.
    ! Tuned [points]. Origin: chosen.
    integer, parameter :: left_out = 409

contains

    !> Point number i of a seed, each coordinate from 0 to below 1.
    pure function scattered_point(i, seed, n) result(point)
        integer, intent(in) :: i       !! from 1 on
        integer, intent(in) :: seed    !! from 0 on
        integer, intent(in) :: n       !! number of coordinates, at most `most_coordinates`
        real(wp) :: point(n)

        integer :: k

        do k = 1, n
            ! The seed moves each coordinate by a multiple of an irrational number.
            point(k) = modulo(mirrored(i + left_out, bases(k)) &
                              + modulo(seed*sqrt(real(bases(k), wp)), 1.0_wp), 1.0_wp)
        end do
    end function scattered_point

    !> The digits of a number behind the point in the opposite order.
    pure real(wp) function mirrored(i, base)
        integer, intent(in) :: i, base

        real(wp) :: place
        integer :: rest

        mirrored = 0.0_wp
        place = 1.0_wp
        rest = i
        do while (rest > 0)
            place = place/base
            mirrored = mirrored + place*modulo(rest, base)
            rest = rest/base
        end do
    end function mirrored
end module faststrip_tabulate_points
