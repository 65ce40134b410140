!> Where the border of a contact lies between the elements of a grid.
!>
!> NORM counts elements, and an element is in contact up to 0.17 of its side beyond the true
!> border: areas that are counted are too large by about that, times the border's length. Along a
!> row the pressures of the first two elements tell where a lattice's border is (`lattice_edge`);
!> the same across. The area under the border that is found so is of second order: a tenth of
!> the error with 20 elements across an ellipse. It serves estimates; the figure of a solution stays
!> the count, which is CONTACT's.
module faststrip_kalker_border
    use faststrip_base_kinds, only: wp
    use faststrip_kalker_grid, only: contact_grid_t
    implicit none
    private

    public :: lattice_edge, lone_edge, border_area

    ! Given: how far beyond the border a middle may be and its element still be in contact, over
    ! the side: the plane contact of cylinders.
    real(wp), parameter :: edge_reach = 0.174_wp
    !> Way from an element's middle to the border where nothing tells it, over the side: its mean.
    !> Given: half the range.
    real(wp), parameter :: lone_edge = 0.5_wp - edge_reach
    ! Of the plane contact of cylinders, 60 positions of its edge in the grid.
    ! Given: coefficients of a fit.
    real(wp), parameter :: edge_fit(0:4) = [-0.17462861_wp, 0.99658564_wp, 0.43443832_wp, &
                                            0.13650724_wp, 0.15087991_wp]
    ! Tuned [1]: Largest proportion of neighbouring pressures. Origin: safeguard of the fit, whose
    ! border lies .92 of a side out there; with .83, beyond which another element would be in
    ! contact, estimates of the area change by up to 9 %.
    real(wp), parameter :: largest_ratio = 0.75_wp

contains

    !> Way from the middle of the first element in contact to the border over the side, from the
    !> pressures that NORM found for it and the one behind it.
    elemental real(wp) function lattice_edge(first, second) result(position)
        real(wp), intent(in) :: first  !! pressure of the first element, > 0
        real(wp), intent(in) :: second !! of the one behind it, not below 0

        real(wp) :: t

        position = lone_edge
        if (second <= first) return
        t = min(first/second, largest_ratio)
        position = edge_fit(0) + t*(edge_fit(1) + t*(edge_fit(2) + t*(edge_fit(3) &
                                                                   + t*edge_fit(4))))
    end function lattice_edge

    !> The area under the border, mm2: elements in contact, each side without a neighbour moved to
    !> the border. Steps of a slanting border are seen along rows and along columns; each counts as
    !> much as the pressure's square falls that way.
    pure real(wp) function border_area(grid) result(area)
        type(contact_grid_t), intent(in) :: grid !! with NORM's pressures

        real(wp) :: p, x(2), y(2), largest, steep(2)
        integer :: i, j

        area = 0.0_wp
        do j = 1, grid%ny
            do i = 1, grid%nx
                p = grid%pressure(i, j)
                if (p <= 0.0_wp) cycle
                x = [pressure_at(grid, i - 1, j), pressure_at(grid, i + 1, j)]
                y = [pressure_at(grid, i, j - 1), pressure_at(grid, i, j + 1)]
                area = area + 1.0_wp
                if (all(x > 0.0_wp) .and. all(y > 0.0_wp)) cycle
                largest = max(p, maxval(x), maxval(y))
                steep = [fall(p/largest, x/largest), fall(p/largest, y/largest)]**2
                if (sum(steep) <= 0.0_wp) steep = 1.0_wp
                area = area + sum(steep*[moved(p, x), moved(p, y)])/sum(steep)
            end do
        end do
        area = area*(grid%dx*grid%dy)
    end function border_area

    !> By how much the sides of an element move outwards in one direction, over its length.
    pure real(wp) function moved(p, beside)
        real(wp), intent(in) :: p         ! pressure of the element
        real(wp), intent(in) :: beside(2) ! of its neighbours

        integer :: k

        moved = 0.0_wp
        do k = 1, 2
            if (beside(k) <= 0.0_wp) moved = moved + lattice_edge(p, beside(3 - k)) - 0.5_wp
        end do
    end function moved

    !> Fall of the pressure's square over an element.
    pure real(wp) function fall(p, beside)
        real(wp), intent(in) :: p         ! pressure of the element
        real(wp), intent(in) :: beside(2) ! of its neighbours

        if (all(beside > 0.0_wp)) then
            fall = 0.5_wp*(beside(2)**2 - beside(1)**2)
        else if (any(beside > 0.0_wp)) then
            fall = sum(beside**2) - p**2
        else
            fall = 2.0_wp*p**2
        end if
    end function fall

    !> A pressure; zero beyond the grid.
    pure real(wp) function pressure_at(grid, i, j) result(p)
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: i, j

        p = 0.0_wp
        if (min(i, j) < 1 .or. i > grid%nx .or. j > grid%ny) return
        p = grid%pressure(i, j)
    end function pressure_at
end module faststrip_kalker_border
