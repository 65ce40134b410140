!> Columns of influence coefficients on the centre line of the strip with the pressure, any edges.
!>
!> The integrals are those of faststrip_influence_closed, by G(c) of both edges; points that are not
!> plain numbers go to the scalar procedures.
module faststrip_influence_center_column
    use faststrip_base_kinds, only: wp
    use faststrip_influence_closed_coefficients, only: a_small, b_small, r_large, r_centre
    use faststrip_influence_four_lanes, only: lanes_for, column_t, center_lanes
    use faststrip_influence_offcentre, only: strip_influence_gradient
    use faststrip_influence_plain_sizes, only: largest_plain
    implicit none
    private

    public :: center_influence_column, center_influence_column_gradient

    integer :: k_
    integer, parameter :: last_small = ubound(b_small, 1), last_large = ubound(r_large, 1)
    ! G = c (A - B ln c) and G - c G' = c (B - 2 x A' + 2 x B' ln c), powers of x = c^2.
    real(wp), parameter :: a(0:last_small) = [a_small, 0.0_wp]
    real(wp), parameter :: twice(0:last_small) = [(2.0_wp*k_, k_=0, last_small)]
    real(wp), parameter :: small(4, 0:last_small) = transpose(reshape( &
        [a, b_small, b_small - twice*a, -twice*b_small], [last_small + 1, 4]))
    ! G = (pi/2)(ln 4c + 1/2) + w R and G - c G' = G - pi/2 + 2 w (R + w R'), powers of
    ! w - r_centre, w = 1/c^2.
    real(wp), parameter :: large(2, 0:last_large) = transpose(reshape( &
        [r_large, [(2.0_wp*((k_ + 1)*r_large(k_) + r_centre*(k_ + 1)*r_large(k_ + 1)), &
                    k_=0, last_large - 1)], 2.0_wp*(last_large + 1)*r_large(last_large)], &
        [last_large + 1, 2]))

contains

    !> Influence of a strip on points of its centre line, any edges. Relative error below
    !> 2e-15 (1 + c/w), w the strip's width and c the distance of its farther edge: what rounding
    !> of the edges does, too.
    pure subroutine center_influence_column(half_length, y_left, y_right, y, value, portable)
        real(wp), intent(in) :: half_length !! xd of the strip that carries the pressure, mm, > 0
        real(wp), intent(in) :: y_left      !! its left edge, mm
        real(wp), intent(in) :: y_right     !! its right edge, mm
        real(wp), intent(in) :: y(:)        !! field points, (n), mm
        real(wp), intent(out) :: value(:)   !! influence I, (n), mm
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        integer :: by, found

        by = lanes_for(portable)
        found = -1
        if (by > 0) then
            call center_lanes(column_t(by, size(y), largest_plain, half_length, y_left, y_right), &
                              y, small, large, r_centre, value, found=found)
        end if
        if (found < 1) call find_missing(found, half_length, y_left, y_right, y, value)
    end subroutine center_influence_column

    !> Influence of a strip on points of its centre line, and its derivative with respect to the
    !> half-length at fixed edges; the derivative to 1e-14 (1 + c/w).
    pure subroutine center_influence_column_gradient(half_length, y_left, y_right, y, value, &
                                                     d_half_length, portable)
        real(wp), intent(in) :: half_length       !! xd of the strip with the pressure, mm, > 0
        real(wp), intent(in) :: y_left            !! its left edge, mm
        real(wp), intent(in) :: y_right           !! its right edge, mm
        real(wp), intent(in) :: y(:)              !! field points, (n), mm
        real(wp), intent(out) :: value(:)         !! influence I, (n), mm
        real(wp), intent(out) :: d_half_length(:) !! dI/dxd, (n)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        integer :: by, found

        by = lanes_for(portable)
        found = -1
        if (by > 0) then
            call center_lanes(column_t(by, size(y), largest_plain, half_length, y_left, y_right), &
                              y, small, large, r_centre, value, d_half_length, found)
        end if
        if (found < 1) call find_missing(found, half_length, y_left, y_right, y, value, &
                                         d_half_length)
    end subroutine center_influence_column_gradient

    !> What the lanes have not found, by the scalar procedure.
    pure subroutine find_missing(found, half_length, y_left, y_right, y, value, slope)
        integer, intent(in) :: found
        real(wp), intent(in) :: half_length, y_left, y_right, y(:)
        real(wp), intent(inout) :: value(:)
        real(wp), intent(inout), optional :: slope(:)

        real(wp) :: d_x, d_half_length
        integer :: k

        if (found < 0) value = 0.0_wp
        do k = 1, size(y)
            if (abs(value(k)) > 0.0_wp) cycle
            call strip_influence_gradient(0.0_wp, half_length, y_left - y(k), y_right - y(k), &
                                          value(k), d_x, d_half_length)
            if (present(slope)) slope(k) = d_half_length
        end do
    end subroutine find_missing
end module faststrip_influence_center_column
