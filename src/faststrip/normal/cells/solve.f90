!> Normal contact by cells: strips whose edges stay where they are. Coarse ones find the patches of
!> gaps whose strips and ends do not converge; fine ones do so again, or are the answer.
!>
!> The first cells lie where the undeformed gap is below a penetration, the next ones over the
!> patches of those before and over places where the deformed surfaces overlap: three sets, and up
!> to two more of fine ones. An end lies in its cell, and what is narrower than a cell is not seen.
module faststrip_normal_cells_solve
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_cells, only: cells_t, most_cells, position_cells
    use faststrip_normal_cells_balance, only: balance_cells
    use faststrip_normal_cells_ranges, only: first_ranges, next_ranges
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: solve_cells

    ! Tuned [cells]: across the widest range of coarse ones. Origin: chosen for the time: a neck of
    ! a tenth of the contact is seen.
    integer, parameter :: coarse_cells = 15
    ! Tuned [cells]: across the widest range of fine ones. Origin: of 4,000 random gaps most are
    ! solved by strips from as many, with 20 or 31 half a percent fewer.
    integer, parameter :: fine_cells = 26
    ! Tuned [steps]: of the lengths, in the last sets and in those before. Origin: safeguard; chosen
    ! for the time: what comes next begins with them.
    integer, parameter :: length_steps = 12, first_steps = 4
    ! Tuned [sets]: How often cells are positioned. Origin: chosen; safeguard.
    integer, parameter :: fewest_sets = 3, max_sets = 5
    ! Tuned [cells]. Origin: chosen: within what the first solution leaves open.
    real(wp), parameter :: first_growth = 1.0_wp, growth = 0.3_wp ! of a patch each way, cells

contains

    !> Cells that carry a load, or lie at a given penetration. Nothing is allocated.
    pure subroutine solve_cells(cells, curve, compliance, demand, are_fine, room, depth)
        type(cells_t), intent(inout) :: cells
            !! reserved beforehand; those that press are found, unless there is no range below the
            !! depth, or a system is singular: not `solved`
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        real(wp), intent(in) :: compliance     !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand   !! load, or penetration above the lowest height
        logical, intent(in) :: are_fine        !! fine enough for an answer, or coarse?
        integer, intent(in) :: room            !! most cells
        real(wp), intent(in) :: depth          !! a guess of the depth, mm

        integer :: set, most, across
        logical :: is_last, at_rest

        most = min(most_cells, room)
        cells%n = 0
        cells%depth = depth
        call first_ranges(cells, curve, depth)
        cells%solved = cells%n_ranges > 0
        if (.not. cells%solved) return
        do set = 1, max_sets
            across = merge(fine_cells, coarse_cells, are_fine .and. set > 1)
            call position_cells(cells, curve, min(most, across), most)
            is_last = set >= fewest_sets
            call balance_cells(cells, compliance, demand, &
                               merge(length_steps, first_steps, is_last))
            if (.not. cells%solved .or. is_last .and. .not. are_fine) return
            call next_ranges(cells, curve, compliance, merge(first_growth, growth, set == 1), &
                             at_rest)
            if (is_last .and. at_rest) return
        end do
    end subroutine solve_cells
end module faststrip_normal_cells_solve
