!> Pressures, lengths and penetration of cells.
!>
!> The gap closes in the middle of a cell that presses and at its tips. For given lengths pressures
!> are those of an active set: cells that pull leave and cells that overlap join, all at once as
!> long as they become fewer, then one at a time. The tips then ask for other lengths.
module faststrip_normal_cells_balance
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: equal_within, most_steps
    use faststrip_influence_center_column, only: center_influence_column
    use faststrip_influence_tip, only: tip_influence_column
    use faststrip_normal_cells, only: cells_t, start_lengths
    use faststrip_normal_strip_figures, only: correction_of
    use faststrip_normal_types, only: demand_t
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    implicit none
    private

    public :: balance_cells

    ! Tuned [rounds]: of the active set at once without fewer infeasible cells. Origin: chosen
    ! against cycling.
    integer, parameter :: max_block_rounds = 3
    ! Tuned [1]: change of lengths that may be left. Origin: chosen: far below the errors of cells.
    real(wp), parameter :: length_tolerance = 1.0e-3_wp
    ! Tuned [1]: shortest cell over the longest. Origin: safeguard.
    real(wp), parameter :: shortest = 0.01_wp

contains

    !> Find them. Nothing is allocated.
    pure subroutine balance_cells(cells, compliance, demand, steps)
        type(cells_t), intent(inout) :: cells !! positioned, with a guess of their depth
        real(wp), intent(in) :: compliance    !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand  !! load, or penetration above the lowest height
        integer, intent(in) :: steps          !! of the lengths, at most

        integer :: step, j, n

        n = cells%n
        call start_lengths(cells)
        cells%presses(:n) = .true.
        do step = 1, steps
            associate (length => cells%half_length(:n))
                length = max(length, shortest*maxval(length, mask=cells%presses(:n)))
                do j = 1, n
                    call center_influence_column(length(j), cells%y_left(j), cells%y_right(j), &
                                                 cells%y(:n), cells%influence(:n, j))
                end do
                call find_pressing(cells, compliance, demand)
                if (.not. cells%solved .or. step == steps) exit
                call close_tips(cells, compliance)
                if (all(abs(cells%length(:n) - length) <= length_tolerance*length &
                        .or. .not. cells%presses(:n))) exit
                length = cells%length(:n)
            end associate
        end do
    end subroutine balance_cells

    !> Which cells press, and with what pressures.
    pure subroutine find_pressing(cells, compliance, demand)
        type(cells_t), intent(inout) :: cells
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand

        real(wp) :: carried
        integer :: rounds, tries, infeasible, fewest, first, i, k, n

        n = cells%n
        fewest = n + 1
        tries = 0
        do rounds = 1, most_steps
            if (.not. any(cells%presses(:n))) &
                cells%presses(minloc(cells%height(:n), dim=1)) = .true.
            call solve_pressing(cells, compliance, demand)
            if (.not. cells%solved) return
            call find_infeasible(cells, compliance, infeasible)
            if (infeasible == 0) exit
            tries = tries + 1
            if (infeasible < fewest) tries = 0
            fewest = min(fewest, infeasible)
            first = 1
            if (tries > max_block_rounds) first = infeasible
            do i = first, infeasible
                k = cells%at(i)
                cells%presses(k) = .not. cells%presses(k)
            end do
        end do
        ! Cells that come and go without end.
        cells%p0(:n) = max(cells%p0(:n), 0.0_wp)
        cells%presses(:n) = cells%p0(:n) > 0.0_wp
        cells%solved = any(cells%presses(:n))
        if (.not. (cells%solved .and. demand%by_load)) return
        carried = 0.0_wp
        do k = 1, n
            carried = carried + load_per_pressure(cells, k)*cells%p0(k)
        end do
        cells%p0(:n) = cells%p0(:n)*(demand%load/carried)
    end subroutine find_pressing

    !> Cells that pull and those that overlap without pressing, into `at`.
    pure subroutine find_infeasible(cells, compliance, infeasible)
        type(cells_t), intent(inout) :: cells
        real(wp), intent(in) :: compliance
        integer, intent(out) :: infeasible ! how many

        integer :: k

        infeasible = 0
        do k = 1, cells%n
            if (cells%presses(k)) then
                if (cells%p0(k) > 0.0_wp) cycle
            else if (cells%depth - cells%height(k) &
                     - compliance*dot_product(cells%influence(k, :cells%n), cells%p0(:cells%n)) &
                     <= equal_within*cells%depth) then
                cycle
            end if
            infeasible = infeasible + 1
            cells%at(infeasible) = k
        end do
    end subroutine find_infeasible

    !> What the cells that are said to press carry if they all do, of any sign.
    pure subroutine solve_pressing(cells, compliance, demand)
        type(cells_t), intent(inout) :: cells
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand

        real(wp) :: carried(2), scale
        integer :: m, j, k
        logical :: singular

        m = 0
        do j = 1, cells%n
            cells%p0(j) = 0.0_wp
            if (.not. cells%presses(j)) cycle
            m = m + 1
            cells%at(m) = j
            cells%edges(m, :) = [cells%y_left(j), cells%y_right(j)]
        end do
        scale = cells%influence(cells%at(1), cells%at(1))
        ! What a depth of one asks for, and what the heights take from it.
        do j = 1, m
            do k = 1, m
                cells%matrix(k, j) = cells%influence(cells%at(k), cells%at(j))/scale
            end do
            cells%column(j, :) = [1.0_wp, cells%height(cells%at(j))]/scale
        end do
        call lu_factor(m, cells%matrix, cells%pivot, singular)
        cells%solved = .not. singular
        if (singular) return
        call lu_solve(m, cells%matrix, cells%pivot, cells%column(:, 1))
        call lu_solve(m, cells%matrix, cells%pivot, cells%column(:, 2))
        if (demand%by_load) then
            carried = 0.0_wp
            do j = 1, m
                carried = carried + load_per_pressure(cells, cells%at(j))*cells%column(j, :)
            end do
            cells%depth = (compliance*demand%load + carried(2))/carried(1)
        else
            cells%depth = demand%penetration/correction_of(cells%edges(:m, 1), cells%edges(:m, 2))
        end if
        do j = 1, m
            cells%p0(cells%at(j)) = (cells%depth*cells%column(j, 1) - cells%column(j, 2)) &
                                    /compliance
        end do
    end subroutine solve_pressing

    !> Load of a cell over its pressure, mm2.
    pure real(wp) function load_per_pressure(cells, k)
        type(cells_t), intent(in) :: cells
        integer, intent(in) :: k

        load_per_pressure = 0.5_wp*pi*cells%half_length(k)*(cells%y_right(k) - cells%y_left(k))
    end function load_per_pressure

    !> The lengths with which the gap closes at the tips. Cells without pressure get the shortest,
    !> or they would come back as long as they were to begin with.
    pure subroutine close_tips(cells, compliance)
        type(cells_t), intent(inout) :: cells
        real(wp), intent(in) :: compliance

        real(wp) :: least
        integer :: j, k, n

        n = cells%n
        associate (displaced => cells%column(:n, 1), influence => cells%column(:n, 2), &
                   length => cells%half_length(:n))
            displaced = 0.0_wp
            do j = 1, n
                if (.not. cells%presses(j)) cycle
                call tip_influence_column(length(j), cells%y_left(j), cells%y_right(j), length, &
                                          cells%y(:n), influence)
                displaced = displaced + compliance*cells%p0(j)*influence
            end do
            least = minval(length, mask=cells%presses(:n))
            do k = 1, n
                if (cells%presses(k)) then
                    cells%length(k) = sqrt(max(cells%depth - cells%height(k) - displaced(k), &
                                               0.0_wp)/cells%inv2r(k))
                else
                    cells%length(k) = least
                end if
            end do
        end associate
    end subroutine close_tips
end module faststrip_normal_cells_balance
