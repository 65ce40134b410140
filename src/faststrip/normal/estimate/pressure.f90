!> Pressures beyond those of a strip solution: of heights that a strip does not resolve, and where
!> the longitudinal term A = 1/(2R) varies along y.
!>
!> In strips that are short beside their width the contact is one of plane strain along x, whose
!> line load hardly changes along y. Its maximum pressure goes with sqrt(A), so that A at an edge
!> above the line through the middles on both sides means a pressure above theirs. In long strips A
!> moves the tips and leaves the pressure on the centre line alone: 1/(1 + xd/w).
!>
!> At x the gap differs from the centre line's by A(y) x^2. A strip whose A is much smaller than
!> that of its neighbours is long, and at x beyond their tips it stands out of the surface: it has
!> an edge there, with a pressure that may exceed that of the centre line by much. It is in plane
!> strain along y with
!>
!>     p(x) = 1/(pi^2 H) int min([A(y') - A(y)] x^2, u(x, y))/(y' - y)^2 dy'.
!>
!> Where A is larger the surface falls back behind the gap and is free, but never by more than it
!> was pressed in, u = D - h - A x^2: pressures press in all around them.
module faststrip_normal_estimate_pressure
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at
    use faststrip_normal_estimate_samples, only: usable, block
    use faststrip_normal_estimate_unresolved, only: unresolved_pressure, most_nodes
    use faststrip_normal_strips, only: contact_strips_t, starts_patch, ends_patch
    implicit none
    private

    public :: unresolved_in, longitudinal_pressure

    ! Strips on both sides that are looked at.
    ! Tuned [strips]. Origin: cost.
    integer, parameter :: reach = 4
    ! Where the pressure off the centre line is looked for, over the half-length.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: places(3) = [0.5_wp, 0.7_wp, 0.9_wp]
    ! Share of the pressure above that counts: u is an upper bound, as the free surface stays
    ! pressed in somewhat. With 0.5 to 0.7 random gaps whose A falls by steps are told from those
    ! whose maximum pressure stays on the centre line.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: off_centre_share = 0.6_wp

contains

    !> The pressure that heights in strip k ask for which it does not resolve, MPa, if it is not
    !> less than `least`. The smooth curve meets the gap in its middle, at its edges and in its
    !> neighbours' middles.
    pure real(wp) function unresolved_in(curve, compliance, strips, k, least) result(pressure)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        integer, intent(in) :: k                     !! the strip
        real(wp), intent(in) :: least                !! that counts, MPa

        real(wp) :: node(most_nodes)
        logical :: has_left, has_right
        integer :: n

        associate (left => strips%y_left(:strips%n), right => strips%y_right(:strips%n))
            has_left = .not. starts_patch(strips, k)
            has_right = .not. ends_patch(strips, k)
            n = 3
            node(:3) = [left(k), 0.5_wp*(left(k) + right(k)), right(k)]
            if (has_left .or. has_right) then
                ! At an end of the patch the neighbour's other edge serves instead.
                n = most_nodes
                if (has_left) node(4) = 0.5_wp*(left(k - 1) + right(k - 1))
                if (has_right) node(5) = 0.5_wp*(left(k + 1) + right(k + 1))
                if (.not. has_left) node(4) = right(k + 1)
                if (.not. has_right) node(5) = left(k - 1)
            end if
            pressure = unresolved_pressure(curve, compliance, left(k), right(k), node(:n), least)
        end associate
    end function unresolved_in

    !> The largest pressure of strips `from` to `to`, on the centre line or off it, MPa.
    pure real(wp) function longitudinal_pressure(curve, compliance, strips, depth, from, to) &
        result(pressure)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! at which the strips close it, mm
        integer, intent(in) :: from, to              !! strips of a block

        ! In the middle of a strip and at its right edge in turn, the first one left out.
        real(wp), dimension(2*(block + 2*reach)) :: y, inv2r, height
        real(wp), dimension(-2*reach:2*reach) :: weight, more
        real(wp) :: x_squared, free, length, width, ratio
        integer :: low, here, i, j, k

        pressure = 0.0_wp
        low = max(1, from - reach)
        do k = low, min(strips%n, to + reach)
            i = 2*(k - low) + 1
            y(i) = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            y(i + 1) = strips%y_right(k)
            call gap_at(curve, y(i), height(i), inv2r(i))
            call gap_at(curve, y(i + 1), height(i + 1), inv2r(i + 1))
        end do
        do k = from, to
            here = 2*(k - low) + 1
            weight = 0.0_wp
            more = 0.0_wp
            do j = -2*reach, 2*reach
                i = low + (here + j - 1)/2
                if (j == 0 .or. here + j < 1 .or. i > strips%n) cycle
                if (strips%patch(i) /= strips%patch(k)) cycle
                width = strips%y_right(i) - strips%y_left(i)
                if (modulo(j, 2) /= 0) then
                    ! The left end of a patch is not there; neither is the right one.
                    if (ends_patch(strips, i)) cycle
                    width = 0.5_wp*(width + (strips%y_right(i + 1) - strips%y_left(i + 1)))
                end if
                weight(j) = 0.5_wp*width*off_centre_share &
                            /(pi**2*compliance*(y(here + j) - y(here))**2)
                more(j) = usable(inv2r(here + j)) - usable(inv2r(here))
            end do
            length = strips%half_length(k)
            ratio = 1.0_wp
            do j = -1, 1, 2
                ! Beyond the edge lies a strip of the patch.
                if (weight(2*j) > 0.0_wp) ratio = max(ratio, usable(inv2r(here + j)) &
                    /(usable(inv2r(here)) + more(2*j)*((y(here + j) - y(here)) &
                                                       /(y(here + 2*j) - y(here)))))
            end do
            width = strips%y_right(k) - strips%y_left(k)
            pressure = max(pressure, strips%p0(k) &
                           *(1.0_wp + (sqrt(ratio) - 1.0_wp)/(1.0_wp + length/width)))
            ! Semi-ellipse and parabola together stay below p0 where the parabola ends below p0/2.
            if (sum(weight*more)*length**2 <= 0.5_wp*strips%p0(k)) cycle
            do j = 1, size(places)
                x_squared = (places(j)*length)**2
                free = max(depth - (height(here) - curve%h_lowest) &
                           - usable(inv2r(here))*x_squared, 0.0_wp)
                pressure = max(pressure, strips%p0(k)*sqrt(1.0_wp - places(j)**2) &
                               + sum(weight*min(more*x_squared, free)))
            end do
        end do
    end function longitudinal_pressure
end module faststrip_normal_estimate_pressure
