!> The leading edges of TANG: K2 and K3 of `faststrip_kalker_tangential_problem`.
module faststrip_kalker_tangential_edges
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_kalker_border, only: lattice_edge, lone_edge
    implicit none
    private

    public :: treat_edges, edges_sampled, edges_of_norm

    !> What the pressures are: values at the middles of the elements, or NORM's on this grid.
    !> Given: numbers of kinds.
    integer, parameter :: edges_sampled = 1, edges_of_norm = 2

    ! Given: fitted, the plane contact of cylinders.
    real(wp), parameter :: edge_strength = 2.7046_wp
    ! Given: fitted, the plane contact of cylinders.
    real(wp), parameter :: edge_reach = 0.174_wp
    ! Smallest position of an edge, just short of where the element carries nothing.
    ! Given: fitted, see lattice_edge.
    real(wp), parameter :: nearest_edge = -0.17_wp

contains

    !> The compliances of the leading elements.
    pure subroutine treat_edges(pn, is_leading, material, edges, edge)
        real(wp), intent(in) :: pn(:)            !! pressures, MPa, shape (n)
        logical, intent(in) :: is_leading(:)     !! is nothing in contact ahead of the element?
        type(material_t), intent(in) :: material !! checked, MPa
        integer, intent(in) :: edges             !! `edges_sampled`, `edges_of_norm`
        real(wp), intent(inout) :: edge(:, :)    !! 1/MPa, shape (2, n); leading ones are written

        real(wp) :: position, c, factor
        integer :: i, behind

        factor = 2.0_wp/(pi*combined_shear_modulus(material))
        do i = 1, size(pn)
            if (.not. is_leading(i)) cycle
            ! Elements behind the leading one without a gap.
            do behind = 0, 1
                if (i + behind >= size(pn)) exit
                if (is_leading(i + behind + 1)) exit
            end do
            position = edge_position(pn(i:i + behind), edges)
            c = edge_strength*(1.0_wp/(max(position, nearest_edge) + edge_reach) - 1.0_wp)
            ! A negative one might make the element's own compliance negative at oblique edges.
            edge(:, i) = max(c, 0.0_wp)*factor &
                         *[1.0_wp - combined_poisson_ratio(material), 1.0_wp]
        end do
    end subroutine treat_edges

    !> Way from the first middle to the edge over dx, from the pressures of the first elements.
    pure real(wp) function edge_position(p, edges) result(position)
        real(wp), intent(in) :: p(:)  !! up to three, leading one first
        integer, intent(in) :: edges

        real(wp) :: slope, bend, root, q(3)

        if (edges == edges_of_norm) then
            position = lone_edge
            if (size(p) > 1) position = lattice_edge(p(1), p(2))
            return
        end if
        position = 0.5_wp
        if (size(p) < 2) return
        if (p(2) <= p(1)) return
        q(:2) = (p(:2)/p(2))**2
        position = min(q(1)/(q(2) - q(1)), 1.0_wp)
        if (size(p) < 3) return
        q(3) = (p(3)/p(2))**2
        bend = 0.5_wp*(q(3) - 2.0_wp*q(2) + q(1))
        slope = q(2) - q(1) - bend
        root = slope**2 - 4.0_wp*bend*q(1)
        if (slope <= 0.0_wp .or. root <= 0.0_wp) return
        position = min(2.0_wp*q(1)/(slope + sqrt(root)), 1.0_wp)
    end function edge_position
end module faststrip_kalker_tangential_edges
