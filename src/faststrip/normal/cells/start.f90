!> Where a lattice starts: the penetration that a load is likely to need.
module faststrip_normal_cells_start
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_geometry_gap_curve, only: gap_curve_t
    implicit none
    private

    public :: start_depth

    ! Tuned [1]. Origin: virtual penetration of a Hertz contact (Piotrowski and Kik).
    real(wp), parameter :: start_level = 0.55_wp     ! of the penetration: virtual penetration
    ! Tuned [1]. Origin: a round contact between plane strain and a needle.
    real(wp), parameter :: start_factor = 0.6_wp     ! of the plane-strain pressure

contains

    !> Penetration, above the lowest height, at which pressures of 0.6 of the plane-strain one
    !> where the gap is below 0.55 D carry the load.
    pure subroutine start_depth(curve, compliance, load, depth)
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load           !! N
        real(wp), intent(out) :: depth         !! mm

        ! Tuned [1]: Range of the search to either side. Origin: safeguard: all loads that can be
        ! solved.
        real(wp), parameter :: reach_of_search = 2.0_wp**200
        real(wp) :: low, high, unit
        integer :: i

        ! In a length of the case's own, with which the unit of length does not matter.
        unit = sqrt(compliance*load)
        low = unit/reach_of_search
        high = unit*reach_of_search
        do i = 1, most_steps
            depth = low*sqrt(high/low)
            if (start_load(curve, compliance, depth) < load) then
                low = depth
            else
                high = depth
            end if
            if (high - low <= 2.0_wp*epsilon(1.0_wp)*low) exit
        end do
    end subroutine start_depth

    !> That load; a gap straight between the ends of its monotone pieces lets it rise evenly, so
    !> that one penetration belongs to it.
    pure real(wp) function start_load(curve, compliance, depth) result(load)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth

        real(wp) :: level, low, high, width
        integer :: j

        level = start_level*depth
        load = 0.0_wp
        do j = 1, curve%n_pieces
            width = curve%y_node(j + 1) - curve%y_node(j)
            low = min(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            high = max(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            if (level >= high) then
                load = load + width*(level - 0.5_wp*(low + high))
            else if (level > low) then
                load = load + width*((level - low)*(0.5_wp*((level - low)/(high - low))))
            end if
        end do
        load = start_factor*(load/compliance)
    end function start_load
end module faststrip_normal_cells_start
