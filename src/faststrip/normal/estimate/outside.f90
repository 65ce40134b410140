!> Overlap of the deformed surfaces outside the patches of a strip solution, for
!> `faststrip_normal_estimate_errors`.
module faststrip_normal_estimate_outside
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t, valley_below
    use faststrip_normal_estimate_samples, only: sample, most_samples
    use faststrip_normal_strips, only: contact_strips_t
    implicit none
    private

    public :: look_elsewhere, is_outside

contains

    !> The overlap in valleys of the undeformed gap that are below the penetration and in no patch.
    pure subroutine look_elsewhere(curve, compliance, strips, depth, overlap)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        real(wp), intent(in) :: compliance           !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: depth                !! at which the strips close it, mm
        real(wp), intent(inout) :: overlap           !! raised to the largest, over the depth

        real(wp) :: y(most_samples), gap(most_samples)
        integer :: i, n

        n = 0
        i = 1
        do
            i = valley_below(curve, curve%h_lowest + depth, i + 1)
            if (i <= curve%n_pieces) then
                if (.not. is_outside(curve, strips, curve%y_node(i))) cycle
                n = n + 1
                y(n) = curve%y_node(i)
            end if
            if (n == most_samples .or. (n > 0 .and. i > curve%n_pieces)) then
                call sample(curve, compliance, strips, depth, y(:n), gap(:n))
                overlap = max(overlap, -minval(gap(:n)))
                n = 0
            end if
            if (i > curve%n_pieces) exit
        end do
    end subroutine look_elsewhere

    !> Is a place among the gap's points and in no patch?
    pure logical function is_outside(curve, strips, y)
        type(gap_curve_t), intent(in) :: curve       !! the gap that was solved
        type(contact_strips_t), intent(in) :: strips !! the solution
        real(wp), intent(in) :: y                    !! mm

        is_outside = y >= curve%y(1) .and. y <= curve%y(curve%n) &
                     .and. .not. any(strips%y_left(:strips%n) <= y &
                                     .and. strips%y_right(:strips%n) >= y)
    end function is_outside
end module faststrip_normal_estimate_outside
