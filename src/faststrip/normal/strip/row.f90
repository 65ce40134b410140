!> Where the patches of a contact are, by a row of cells that stay where they are.
!>
!> The shape of a Hertz contact is near the patches of most gaps. Where these are about to meet, or
!> one is much wider than the other, strips and ends do not converge from there. Here the
!> places where the gap lies below a level are cut into even cells; a cell with pressure is a
!> strip whose length is that of an ellipse like its patch, and cells without pressure leave or come
!> back until no pressure is negative and no cell overlaps. Only the gap on the centre line is
!> closed, so the row is a start for the strips and no answer.
module faststrip_normal_strip_row
    use faststrip_base_kinds, only: wp, pi
    use faststrip_numerics_elliptic, only: complete_elliptic, complete_elliptic_d
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_influence_center_column, only: center_influence_column
    use faststrip_influence_tip, only: tip_influence_column
    use faststrip_normal_strip_patches, only: patches_t, max_patches, fewest_strips
    use faststrip_normal_strip_state, only: strip_workspace_t, remember, flattest
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: find_patches

    ! Tuned [cells]: of a row; fewest of a place; room. Origin: chosen for the time: a neck of a
    ! tenth of the contact is seen.
    integer, parameter :: row_cells = 24, fewest_cells = 6, most_cells = 36
    ! Tuned [rows]: each over the patches of the one before. Origin: chosen for the time.
    integer, parameter :: most_rows = 3
    ! Tuned [steps]: of the cells' lengths in a row; of those that close the gap at the tips; of the
    ! cells that press. Origin: chosen for the time: lengths hardly change any more; with half of
    ! the steps at the tips twice as many cold solutions take more than 20 steps; safeguard.
    integer, parameter :: length_steps = 3, tip_steps = 6, most_changes = 12
    ! Tuned [1]: length of a cell over that of the undeformed overlap, to begin with. Origin: a
    ! round contact.
    real(wp), parameter :: first_share = 0.7_wp
    ! Tuned [1]: most that a length changes by in a step. Origin: safeguard.
    real(wp), parameter :: length_step = 2.0_wp
    ! Tuned [1]: shortest cell over the longest. Origin: safeguard.
    real(wp), parameter :: shortest = 0.05_wp
    ! Tuned [1]: of the penetration a row finds, the level of the next. Origin: chosen: the next row
    ! finds a little more or less.
    real(wp), parameter :: above = 1.1_wp
    ! Tuned [cells]: how far an end is extrapolated from the edge of its cell. Origin: chosen.
    real(wp), parameter :: farthest_in = 0.2_wp, farthest_out = 0.5_wp

    !> A row of cells; the first `n` count.
    type :: row_t
        integer :: n = 0
        real(wp), dimension(most_cells) :: left, right !! edges, mm
        real(wp), dimension(most_cells) :: y           !! middles, mm
        real(wp), dimension(most_cells) :: height      !! of the gap there, above the lowest, mm
        real(wp), dimension(most_cells) :: inv2r       !! A there, 1/mm
        real(wp), dimension(most_cells) :: p0          !! pressures, MPa
        real(wp), dimension(most_cells) :: half_length !! mm
        logical, dimension(most_cells) :: presses      !! is there pressure?
        real(wp) :: penetration = 0.0_wp               !! above the lowest height, mm
    end type row_t

contains

    !> Find the patches of the gap in the workspace; they are its last solution, from which a level
    !> of strips starts. Nothing is allocated.
    pure subroutine find_patches(workspace, compliance, demand, patches, penetration, found)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand       !! load or penetration
        type(patches_t), intent(inout) :: patches  !! those found, not yet shared into strips
        real(wp), intent(inout) :: penetration     !! above the lowest height: a guess, which it
                                                   !! should not be far above; that found, mm
        logical, intent(out) :: found              !! are there, and are they not too many?

        type(row_t) :: row
        real(wp) :: from(max_patches), to(max_patches), level
        integer :: i, n

        found = .false.
        level = penetration
        if (.not. demand%by_load) level = demand%penetration
        call level_intervals(workspace%curve, workspace%curve%h_lowest + level, from, to, n)
        do i = 1, most_rows
            call lay_cells(workspace%curve, n, from, to, row, found)
            if (.not. found) return
            row%penetration = level
            call balance_row(compliance, demand, .false., row, found)
            if (.not. found) return
            if (row%penetration > level) then
                level = above*row%penetration
                call level_intervals(workspace%curve, workspace%curve%h_lowest + level, from, to, n)
            else if (i < most_rows) then
                call narrow_places(row, n, from, to)
            end if
        end do
        call balance_row(compliance, demand, .true., row, found)
        if (.not. found) return
        call hand_to_strips(workspace, row, patches, found)
        penetration = row%penetration
    end subroutine find_patches

    !> Cut the places into cells, about as wide in all of them.
    pure subroutine lay_cells(curve, n, from, to, row, possible)
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: n                ! places
        real(wp), intent(in) :: from(:), to(:)  ! their ends, mm
        type(row_t), intent(inout) :: row
        logical, intent(out) :: possible        ! is there room?

        real(wp) :: width, h, inv2r
        integer :: i, k, cells

        width = sum(to(:n) - from(:n))/row_cells
        row%n = 0
        possible = n > 0 .and. width > 0.0_wp
        if (.not. possible) return
        do i = 1, n
            cells = max(fewest_cells, nint((to(i) - from(i))/width))
            possible = row%n + cells <= most_cells
            if (.not. possible) return
            do k = 1, cells
                row%n = row%n + 1
                row%left(row%n) = from(i) + (to(i) - from(i))*(k - 1)/cells
                row%right(row%n) = from(i) + (to(i) - from(i))*k/cells
                if (k > 1) row%left(row%n) = row%right(row%n - 1)
                if (k == cells) row%right(row%n) = to(i)
                row%y(row%n) = 0.5_wp*(row%left(row%n) + row%right(row%n))
                call gap_at(curve, row%y(row%n), h, inv2r)
                row%height(row%n) = h - curve%h_lowest
                row%inv2r(row%n) = max(inv2r, flattest)
            end do
        end do
    end subroutine lay_cells

    !> Pressures and lengths of the cells, and the penetration.
    pure subroutine balance_row(compliance, demand, by_tips, row, found)
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        logical, intent(in) :: by_tips  ! are lengths to close the gap at their tips, too?
        type(row_t), intent(inout) :: row ! with the level as its penetration
        logical, intent(out) :: found

        real(wp) :: influence(most_cells, most_cells)
        integer :: step, j, n

        n = row%n
        if (.not. by_tips) then
            row%presses(:n) = .true.
            row%half_length(:n) = first_share*sqrt(max(row%penetration - row%height(:n), 0.0_wp) &
                                                   /row%inv2r(:n))
        end if
        do step = 1, merge(tip_steps, length_steps, by_tips)
            if (by_tips) call shorten_idle(row)
            row%half_length(:n) = max(row%half_length(:n), shortest*maxval(row%half_length(:n)))
            do j = 1, n
                call center_influence_column(row%half_length(j), row%left(j), row%right(j), &
                                             row%y(:n), influence(:n, j))
            end do
            influence(:n, :n) = compliance*influence(:n, :n)
            call find_pressing(influence, demand, row, found)
            if (.not. found) return
            if (by_tips) then
                call close_tips(compliance, row)
            else
                call set_lengths(compliance, row)
            end if
        end do
    end subroutine balance_row

    !> Cells without pressure get the shortest length, or they would come back as long as they were
    !> to begin with.
    pure subroutine shorten_idle(row)
        type(row_t), intent(inout) :: row

        real(wp) :: length
        integer :: k

        length = minval(row%half_length(:row%n), mask=row%presses(:row%n))
        do k = 1, row%n
            if (.not. row%presses(k)) row%half_length(k) = length
        end do
    end subroutine shorten_idle

    !> Which cells press: those without pressure leave, those that overlap come back.
    pure subroutine find_pressing(influence, demand, row, found)
        real(wp), intent(in) :: influence(:, :) ! of a cell's p0 on the middles, mm/MPa
        type(demand_t), intent(in) :: demand
        type(row_t), intent(inout) :: row
        logical, intent(out) :: found ! is a balance found, or nearly?

        integer :: change, k
        logical :: changed

        do change = 1, most_changes
            call solve_pressing(influence, demand, row, found)
            if (.not. found) return
            changed = .false.
            do k = 1, row%n
                if (.not. row%presses(k) .or. row%p0(k) > 0.0_wp) cycle
                row%presses(k) = .false.
                row%p0(k) = 0.0_wp
                changed = .true.
            end do
            if (changed) then
                found = any(row%presses(:row%n))
                if (.not. found) return
                cycle
            end if
            do k = 1, row%n
                if (row%presses(k)) cycle
                if (row%penetration - row%height(k) &
                    <= dot_product(influence(k, :row%n), row%p0(:row%n))) cycle
                row%presses(k) = .true.
                changed = .true.
            end do
            if (.not. changed) return
        end do
        ! Cells come and go: those without pressure leave.
        row%presses(:row%n) = row%presses(:row%n) .and. row%p0(:row%n) > 0.0_wp
    end subroutine find_pressing

    !> Pressures of the cells that press, and the penetration.
    pure subroutine solve_pressing(influence, demand, row, found)
        real(wp), intent(in) :: influence(:, :)
        type(demand_t), intent(in) :: demand
        type(row_t), intent(inout) :: row
        logical, intent(out) :: found

        real(wp) :: matrix(most_cells + 1, most_cells + 1), right(most_cells + 1)
        integer :: pivot(most_cells + 1), at(most_cells), j, k, m
        logical :: singular

        m = 0
        do k = 1, row%n
            row%p0(k) = 0.0_wp
            if (.not. row%presses(k)) cycle
            m = m + 1
            at(m) = k
        end do
        ! Heights over the level and pressures over what the level asks for, as the unit of length.
        associate (unit => row%penetration, p_unit => row%penetration/influence(at(1), at(1)))
            do j = 1, m
                do k = 1, m
                    matrix(k, j) = influence(at(k), at(j))/influence(at(1), at(1))
                end do
            end do
            if (demand%by_load) then
                do j = 1, m
                    matrix(j, m + 1) = -1.0_wp
                    matrix(m + 1, j) = 0.5_wp*pi*row%half_length(at(j)) &
                                       *(row%right(at(j)) - row%left(at(j)))*p_unit/demand%load
                    right(j) = -row%height(at(j))/unit
                end do
                matrix(m + 1, m + 1) = 0.0_wp
                right(m + 1) = 1.0_wp
                m = m + 1
            else
                right(:m) = (demand%penetration - row%height(at(:m)))/unit
            end if
            call lu_factor(m, matrix, pivot, singular)
            found = .not. singular
            if (singular) return
            call lu_solve(m, matrix, pivot, right)
            if (demand%by_load) then
                m = m - 1
                found = right(m + 1) > 0.0_wp
            end if
            row%p0(at(:m)) = p_unit*right(:m)
            if (demand%by_load) row%penetration = unit*right(m + 1)
        end associate
    end subroutine solve_pressing

    !> Lengths of the cells for their loads: those of the ellipse that is as wide and as long as
    !> their patch, by the ratio of pressure and length along x of Hertz's theory.
    pure subroutine set_lengths(compliance, row)
        real(wp), intent(in) :: compliance
        type(row_t), intent(inout) :: row

        real(wp) :: ratio, longest
        integer :: first, last, k

        last = 0
        do
            call next_run(row, first, last)
            if (first > row%n) exit
            longest = maxval(row%half_length(first:last))
            ratio = pressure_ratio(longest, 0.5_wp*(row%right(last) - row%left(first)))
            do k = first, last
                associate (load => row%p0(k)*row%half_length(k))
                    row%half_length(k) = sqrt(load*pi*compliance/(ratio*row%inv2r(k)))
                    row%p0(k) = ratio*row%inv2r(k)*row%half_length(k)/(pi*compliance)
                end associate
            end do
        end do
    end subroutine set_lengths

    !> Lengths of the cells for their loads: with them the gap closes at the tips.
    pure subroutine close_tips(compliance, row)
        real(wp), intent(in) :: compliance
        type(row_t), intent(inout) :: row

        real(wp) :: influence(most_cells), displacement(most_cells), length
        integer :: j, k, n

        n = row%n
        displacement(:n) = 0.0_wp
        do j = 1, n
            if (.not. row%presses(j)) cycle
            call tip_influence_column(row%half_length(j), row%left(j), row%right(j), &
                                      row%half_length(:n), row%y(:n), influence(:n))
            displacement(:n) = displacement(:n) + compliance*row%p0(j)*influence(:n)
        end do
        do k = 1, n
            if (.not. row%presses(k)) cycle
            length = sqrt(max(row%penetration - row%height(k) - displacement(k), 0.0_wp) &
                          /row%inv2r(k))
            length = min(max(length, row%half_length(k)/length_step), &
                         row%half_length(k)*length_step)
            row%p0(k) = row%p0(k)*row%half_length(k)/length
            row%half_length(k) = length
        end do
    end subroutine close_tips

    !> Maximum pressure of an elliptic contact times pi H/(A a); 1 in plane strain.
    pure real(wp) function pressure_ratio(a, b)
        real(wp), intent(in) :: a, b ! half axes along x and y, mm

        real(wp) :: k, e

        if (a > b) then
            pressure_ratio = a/(b*complete_elliptic_d((b/a)**2))
        else
            call complete_elliptic((a/b)**2, k, e)
            pressure_ratio = 1.0_wp/(k - complete_elliptic_d((a/b)**2))
        end if
    end function pressure_ratio

    !> The next cells side by side that press.
    pure subroutine next_run(row, first, last)
        type(row_t), intent(in) :: row
        integer, intent(out) :: first   !! of the run, n + 1 if there is none
        integer, intent(inout) :: last  !! of the run before, 0 to begin with; of this one

        do first = last + 1, row%n
            if (row%presses(first)) exit
        end do
        do last = first, row%n - 1
            if (.not. row%presses(last + 1) .or. row%left(last + 1) > row%right(last)) exit
        end do
    end subroutine next_run

    !> The places of the next row: the runs of this one, and a cell on either side.
    pure subroutine narrow_places(row, n, from, to)
        type(row_t), intent(in) :: row
        integer, intent(inout) :: n
        real(wp), intent(inout) :: from(:), to(:)

        real(wp) :: left, right
        integer :: first, last

        n = 0
        last = 0
        do
            call next_run(row, first, last)
            if (first > row%n) exit
            left = row%left(first)
            if (first > 1) then
                if (row%right(first - 1) >= left) left = row%left(first - 1)
            end if
            right = row%right(last)
            if (last < row%n) then
                if (row%left(last + 1) <= right) right = row%right(last + 1)
            end if
            if (n > 0) then
                if (left <= to(n)) then
                    to(n) = right
                    cycle
                end if
            end if
            n = n + 1
            from(n) = left
            to(n) = right
        end do
    end subroutine narrow_places

    !> The runs as patches, and their cells as the solution to start from.
    pure subroutine hand_to_strips(workspace, row, patches, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        type(row_t), intent(in) :: row
        type(patches_t), intent(inout) :: patches
        logical, intent(out) :: possible ! is there room in the workspace?

        real(wp) :: width
        integer :: first, last, k, j, parts, n

        patches = patches_t()
        n = 0
        last = 0
        associate (strips => workspace%strips)
            do
                call next_run(row, first, last)
                if (first > row%n) exit
                parts = (fewest_strips + last - first)/(last - first + 1)
                possible = n + parts*(last - first + 1) <= workspace%max_strips &
                           .and. patches%n < max_patches
                if (.not. possible) return
                patches%n = patches%n + 1
                patches%at(patches%n)%n_strips = parts*(last - first + 1)
                do k = first, last
                    width = row%right(k) - row%left(k)
                    do j = 1, parts
                        n = n + 1
                        strips%y_left(n) = row%left(k) + width*(j - 1)/parts
                        strips%y_right(n) = row%left(k) + width*j/parts
                        strips%inv2r(n) = row%inv2r(k)
                        strips%p0(n) = row%p0(k)
                        strips%half_length(n) = row%half_length(k)
                    end do
                end do
                patches%at(patches%n)%y_from = row%left(first) - end_move(row, first, first + 1)
                patches%at(patches%n)%y_to = row%right(last) + end_move(row, last, last - 1)
            end do
            strips%n = n
        end associate
        call remember(workspace, patches)
        possible = patches%n > 0
    end subroutine hand_to_strips

    !> How far the contact goes on beyond a cell, mm: to where the squared length runs out; a cell
    !> that is longer than the one before it is at the end.
    pure real(wp) function end_move(row, last, before) result(move)
        type(row_t), intent(in) :: row
        integer, intent(in) :: last   ! cell of the run
        integer, intent(in) :: before ! the one next to it, if it is of the run

        real(wp) :: width, here, there

        move = 0.0_wp
        if (before < 1 .or. before > row%n) return
        if (.not. row%presses(before)) return
        if (row%left(max(before, last)) > row%right(min(before, last))) return
        width = row%right(last) - row%left(last)
        here = row%inv2r(last)*row%half_length(last)**2
        there = row%inv2r(before)*row%half_length(before)**2
        move = -farthest_in*width
        if (there > here) move = min(farthest_out*width, width*(here/(there - here) - 0.5_wp))
        move = max(move, -farthest_in*width)
    end function end_move
end module faststrip_normal_strip_row
