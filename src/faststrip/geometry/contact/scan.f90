!> Where a wheel is nearest to a rail, over the whole of both profiles.
!>
!> Their vertical distance is sampled at equal steps. Of a stretch of samples all are at least as
!> far apart as the bounds of the two profiles say: where that is farther than the nearest sample
!> none of them is looked at, and what is found is what all would tell.
module faststrip_geometry_contact_scan
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_halvings, equal_within
    use faststrip_base_status, only: status_t
    use faststrip_geometry_profile, only: profile_t, profile_at, profile_bounds
    implicit none
    private

    public :: placing_t, find_lowest_dip, find_lowest_sample, sample_place, sample_step, scan_step
    public :: rail_alone, wheel_level, wheel_rolled, stretch, slack

    !> The depth of the rail itself, over y of its profile.
    !> Given: numbers of kinds.
    integer, parameter :: rail_alone = 1
    !> The distance to a wheel that is displaced sideways, over y of the rail's profile.
    !> Given: numbers of kinds.
    integer, parameter :: wheel_level = 2
    !> The distance to a wheel that is turned about x, over y of the wheel's profile.
    !> Given: numbers of kinds.
    integer, parameter :: wheel_rolled = 3

    !> Spacing of the samples, mm.
    !> Tuned [mm]. Origin: well below the curvature of flange and rail corner.
    real(wp), parameter :: scan_step = 0.02_wp
    !> Samples of the shortest stretch.
    !> Tuned [samples]. Origin: measured: with half as many a scan costs a quarter more, with twice
    !> as many it costs the same.
    integer, parameter :: stretch = 16
    !> Stretches that are farther by no more may be as near, mm.
    !> Tuned [mm]. Origin: ten times the jumps of S1002, and far above rounding.
    real(wp), parameter :: slack = 1.0e-3_wp

    !> How a wheel lies over a rail.
    type :: placing_t
        integer :: kind = rail_alone     !! what is sampled: one of the kinds above
        real(wp) :: offset = 0.0_wp      !! of a level wheel: its y less the rail's, mm
        real(wp) :: sine = 0.0_wp        !! of the roll of a rolled wheel
        real(wp) :: cosine = 1.0_wp      !! the same
        real(wp) :: across = 0.0_wp      !! y of its profile's origin from where it rolls about, mm
        real(wp) :: below = 0.0_wp       !! z of the same, mm
        real(wp) :: origin = 0.0_wp      !! y of the rail's origin from there, mm
    end type placing_t

contains

    !> Where the distance of wheel and rail is smallest between two places; none is found if that is
    !> at one of them. Every dip that could be the lowest is refined on the difference of the
    !> slopes, so that of two nearly equal dips the lower wins.
    pure subroutine find_lowest_dip(wheel, rail, placing, first, last, y, distance, found)
        type(profile_t), intent(in) :: wheel   !! profile of the wheel
        type(profile_t), intent(in) :: rail    !! profile of the rail
        type(placing_t), intent(in) :: placing !! how they lie
        real(wp), intent(in) :: first          !! on the profile that is sampled, mm
        real(wp), intent(in) :: last           !! the same, beyond the first, mm
        real(wp), intent(out) :: y             !! where, mm; 0 where there is none
        real(wp), intent(out) :: distance      !! there, mm; `huge` where there is none
        logical, intent(out) :: found          !! is there one?

        real(wp) :: left, middle, right, refined, lowest, at
        integer :: i, j, n, width

        call find_lowest_sample(wheel, rail, placing, first, last, lowest, i)
        n = sample_count(first, last)
        y = 0.0_wp
        distance = huge(distance)
        j = 1
        width = stretch
        do
            call skip_stretches(wheel, rail, placing, first, last, lowest + slack, j, width)
            if (j >= n) exit
            middle = distance_at(wheel, rail, placing, sample_place(first, last, j - 1))
            right = distance_at(wheel, rail, placing, sample_place(first, last, j))
            do i = j, min(j + stretch, n) - 1
                left = middle
                middle = right
                right = distance_at(wheel, rail, placing, sample_place(first, last, i + 1))
                ! A dip can lie below its lowest sample by no more than the samples differ.
                if (.not. (middle <= left .and. middle <= right &
                           .and. max(left, right) < huge(left) &
                           .and. middle - max(left - middle, right - middle) <= lowest)) cycle
                at = dip(wheel, rail, placing, sample_place(first, last, i - 1), &
                         sample_place(first, last, i + 1))
                refined = distance_at(wheel, rail, placing, at)
                if (refined < distance) then
                    distance = refined
                    y = at
                end if
            end do
            j = j + stretch
        end do
        ! Samples of two arcs may lie lower by rounding.
        found = lowest < huge(lowest) .and. .not. distance - equal_within > lowest
    end subroutine find_lowest_dip

    !> The sample at which wheel and rail are nearest, the first of several.
    pure subroutine find_lowest_sample(wheel, rail, placing, first, last, lowest, number)
        type(profile_t), intent(in) :: wheel   !! profile of the wheel
        type(profile_t), intent(in) :: rail    !! profile of the rail
        type(placing_t), intent(in) :: placing !! how they lie
        real(wp), intent(in) :: first          !! on the profile that is sampled, mm
        real(wp), intent(in) :: last           !! the same, beyond the first, mm
        real(wp), intent(out) :: lowest        !! distance there, mm; `huge`: nowhere one over the
                                               !! other
        integer, intent(out) :: number         !! of the sample, from 0 on

        real(wp) :: value
        integer :: i, j, n, width

        n = sample_count(first, last)
        ! Some of the samples tell already where not to look.
        lowest = huge(lowest)
        do i = 0, n, 4*stretch
            lowest = min(lowest, distance_at(wheel, rail, placing, sample_place(first, last, i)))
        end do
        number = n
        j = 0
        width = stretch
        do
            call skip_stretches(wheel, rail, placing, first, last, lowest + slack, j, width)
            if (j > n) exit
            do i = j, min(j + stretch - 1, n)
                value = distance_at(wheel, rail, placing, sample_place(first, last, i))
                if (value < lowest .or. number == n .and. value <= lowest) then
                    lowest = value
                    number = i
                end if
            end do
            j = j + stretch
        end do
    end subroutine find_lowest_sample

    ! On to the next stretch in which wheel and rail may be nearer than a distance.
    pure subroutine skip_stretches(wheel, rail, placing, first, last, distance, from, width)
        type(profile_t), intent(in) :: wheel, rail
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: first, last
        real(wp), intent(in) :: distance  ! mm
        integer, intent(inout) :: from    ! its first sample; beyond the last one: there is none
        integer, intent(inout) :: width   ! samples that are tried at once

        integer :: n

        n = sample_count(first, last)
        do while (from <= n)
            if (least_distance(wheel, rail, placing, &
                               sample_place(first, last, max(from - 1, 0)), &
                               sample_place(first, last, min(from + width, n))) >= distance) then
                from = from + width
                width = 2*width
            else
                if (width == stretch) exit
                width = width/2
            end if
        end do
    end subroutine skip_stretches

    ! The number of the last sample between two places; the first has the number 0.
    pure integer function sample_count(first, last)
        real(wp), intent(in) :: first, last

        sample_count = max(ceiling((last - first)/scan_step), 2)
    end function sample_count

    !> From one sample between two places to the next, mm.
    pure real(wp) function sample_step(first, last)
        real(wp), intent(in) :: first  !! mm
        real(wp), intent(in) :: last   !! mm

        sample_step = (last - first)/real(sample_count(first, last), wp)
    end function sample_step

    !> Where a sample between two places is, mm.
    pure real(wp) function sample_place(first, last, number)
        real(wp), intent(in) :: first  !! mm
        real(wp), intent(in) :: last   !! mm
        integer, intent(in) :: number  !! of the sample, from 0 on

        sample_place = min(first + real(number, wp)*sample_step(first, last), last)
    end function sample_place

    ! Where the slope of the distance changes sign between two places.
    pure real(wp) function dip(wheel, rail, placing, from, to) result(at)
        type(profile_t), intent(in) :: wheel, rail
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: from, to

        real(wp) :: low, high, value, slope
        integer :: k

        low = from
        high = to
        do k = 1, most_halvings
            at = 0.5_wp*(low + high)
            call distance_and_slope(wheel, rail, placing, at, value, slope)
            if (slope < 0.0_wp) then
                low = at
            else
                high = at
            end if
        end do
    end function dip

    ! Vertical distance of wheel and rail but for a constant; `huge` where they are not one over the
    ! other.
    pure real(wp) function distance_at(wheel, rail, placing, at) result(value)
        type(profile_t), intent(in) :: wheel, rail
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: at

        real(wp) :: slope

        call distance_and_slope(wheel, rail, placing, at, value, slope)
    end function distance_at

    pure subroutine distance_and_slope(wheel, rail, placing, at, value, slope)
        type(profile_t), intent(in) :: wheel, rail
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: at
        real(wp), intent(out) :: value, slope

        real(wp) :: z_rail, z_wheel, dz_rail, dz_wheel, d2z, y_rail
        type(status_t) :: inside

        associate (p => placing)
            select case (p%kind)
            case (wheel_level)
                call profile_at(rail, at, z_rail, dz_rail, d2z, inside)
                call profile_at(wheel, level_place(wheel, p, at), z_wheel, dz_wheel, d2z, inside)
                value = z_rail - z_wheel
                slope = dz_rail - dz_wheel
            case (wheel_rolled)
                call profile_at(wheel, at, z_wheel, dz_wheel, d2z, inside)
                y_rail = (p%across + at)*p%cosine - (p%below + z_wheel)*p%sine - p%origin
                value = huge(value)
                slope = 0.0_wp
                if (y_rail < rail%y_first .or. y_rail > rail%y_last) return
                call profile_at(rail, y_rail, z_rail, dz_rail, d2z, inside)
                value = z_rail - (p%across + at)*p%sine - (p%below + z_wheel)*p%cosine
                slope = dz_rail*(p%cosine - dz_wheel*p%sine) - p%sine - dz_wheel*p%cosine
            case default
                call profile_at(rail, at, value, slope, d2z, inside)
            end select
        end associate
    end subroutine distance_and_slope

    ! Where a level wheel stands over a place of the rail.
    pure real(wp) function level_place(wheel, placing, at)
        type(profile_t), intent(in) :: wheel
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: at

        level_place = max(wheel%y_first, min(at + placing%offset, wheel%y_last))
    end function level_place

    ! Nowhere between two places are wheel and rail nearer.
    pure real(wp) function least_distance(wheel, rail, placing, from, to) result(least)
        type(profile_t), intent(in) :: wheel, rail
        type(placing_t), intent(in) :: placing
        real(wp), intent(in) :: from, to

        real(wp) :: of_wheel(2), of_rail(2), y(2), z(2), left, right

        associate (p => placing)
            select case (p%kind)
            case (wheel_level)
                of_rail = profile_bounds(rail, from, to)
                of_wheel = profile_bounds(wheel, level_place(wheel, p, from), &
                                          level_place(wheel, p, to))
                least = of_rail(1) - of_wheel(2)
            case (wheel_rolled)
                y = p%across + [from, to]
                z = p%below + profile_bounds(wheel, from, to)
                left = max(minval(y*p%cosine) - maxval(z*p%sine) - p%origin, rail%y_first)
                right = min(maxval(y*p%cosine) - minval(z*p%sine) - p%origin, rail%y_last)
                least = huge(least)
                if (left > right) return
                of_rail = profile_bounds(rail, left, right)
                least = of_rail(1) - maxval(y*p%sine) - maxval(z*p%cosine)
            case default
                of_rail = profile_bounds(rail, from, to)
                least = of_rail(1)
            end select
        end associate
    end function least_distance
end module faststrip_geometry_contact_scan
