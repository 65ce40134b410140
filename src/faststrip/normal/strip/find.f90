!> Where the patches of a contact are, by cells (`faststrip_normal_cells`).
!>
!> The shape of a Hertz contact is near the patches of most gaps. Where these are about to meet, or
!> one is much wider than the other, strips and ends do not converge from there; from cells, which
!> need not know where patches end, they do.
module faststrip_normal_strip_find
    use faststrip_base_kinds, only: wp
    use faststrip_normal_cells, only: cells_t, next_run
    use faststrip_normal_cells_solve, only: solve_cells
    use faststrip_normal_strip_patches, only: patches_t, max_patches, fewest_strips
    use faststrip_normal_strip_state, only: strip_workspace_t, remember
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: find_patches

    ! Tuned [cells]: how far an end is extrapolated from the edge of its cell. Origin: chosen.
    real(wp), parameter :: farthest_in = 0.2_wp, farthest_out = 0.5_wp

contains

    !> Find the patches of the gap in the workspace; they are its last solution, from which a level
    !> of strips starts. Nothing is allocated.
    pure subroutine find_patches(workspace, compliance, demand, by_fine, room, patches, &
                                 penetration, found)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand       !! load or penetration
        logical, intent(in) :: by_fine             !! fine cells, or coarse ones?
        integer, intent(in) :: room                !! most cells
        type(patches_t), intent(inout) :: patches  !! those found, not yet shared into strips
        real(wp), intent(inout) :: penetration     !! above the lowest height: a guess; that found,
                                                   !! mm
        logical, intent(out) :: found              !! are there, and are they not too many?

        call solve_cells(workspace%cells, workspace%curve, compliance, demand, by_fine, &
                         room, penetration)
        penetration = workspace%cells%depth
        found = workspace%cells%solved
        if (found) call hand_to_strips(workspace, workspace%cells, patches, found)
    end subroutine find_patches

    !> The runs as patches, and their cells as the solution to start from.
    pure subroutine hand_to_strips(workspace, cells, patches, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        type(cells_t), intent(in) :: cells
        type(patches_t), intent(inout) :: patches
        logical, intent(out) :: possible ! is there room in the workspace?

        real(wp) :: width
        integer :: first, last, k, j, parts, n

        patches = patches_t()
        n = 0
        last = 0
        associate (strips => workspace%strips)
            do
                call next_run(cells, first, last)
                if (first > cells%n) exit
                parts = (fewest_strips + last - first)/(last - first + 1)
                possible = n + parts*(last - first + 1) <= workspace%max_strips &
                           .and. patches%n < max_patches
                if (.not. possible) return
                patches%n = patches%n + 1
                patches%at(patches%n)%n_strips = parts*(last - first + 1)
                do k = first, last
                    width = cells%y_right(k) - cells%y_left(k)
                    do j = 1, parts
                        n = n + 1
                        strips%y_left(n) = cells%y_left(k) + width*(j - 1)/parts
                        strips%y_right(n) = cells%y_left(k) + width*j/parts
                        strips%inv2r(n) = cells%inv2r(k)
                        strips%p0(n) = cells%p0(k)
                        strips%half_length(n) = cells%half_length(k)
                    end do
                end do
                patches%at(patches%n)%y_from = cells%y_left(first) &
                                               - end_move(cells, first, first + 1)
                patches%at(patches%n)%y_to = cells%y_right(last) + end_move(cells, last, last - 1)
            end do
            strips%n = n
        end associate
        call remember(workspace, patches)
        possible = patches%n > 0
    end subroutine hand_to_strips

    !> How far the contact goes on beyond a cell, mm: to where the squared length runs out; a cell
    !> that is longer than the one before it is at the end.
    pure real(wp) function end_move(cells, last, before) result(move)
        type(cells_t), intent(in) :: cells
        integer, intent(in) :: last   ! cell of the run
        integer, intent(in) :: before ! the one next to it, if it is of the run

        real(wp) :: width, here, there

        move = 0.0_wp
        if (before < 1 .or. before > cells%n) return
        if (.not. cells%presses(before)) return
        if (cells%y_left(max(before, last)) > cells%y_right(min(before, last))) return
        width = cells%y_right(last) - cells%y_left(last)
        here = cells%inv2r(last)*cells%half_length(last)**2
        there = cells%inv2r(before)*cells%half_length(before)**2
        move = -farthest_in*width
        if (there > here) move = min(farthest_out*width, width*(here/(there - here) - 0.5_wp))
        move = max(move, -farthest_in*width)
    end function end_move
end module faststrip_normal_strip_find
