!> One number of strips, from a start to a solution: strips and ends together, or ends in turn.
!>
!> Together (`faststrip_normal_strip_converge`) is the usual way. What then overlaps beside the
!> patches joins them, and what has met merges, until nothing changes. In turn, strips are solved
!> for between ends that are held, then the ends move; strips that leave are cut off and split their
!> patch. A pass whose ends move little more may stand.
module faststrip_normal_strip_level
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t, usual_strips, usual_strip_tolerance
    use faststrip_normal_strip_converge, only: converge, converged, strips_leave
    use faststrip_normal_strip_ends, only: move_ends, close_overlaps
    use faststrip_normal_strip_equations, only: cost_work, step_work
    use faststrip_normal_strip_figures, only: hand_over, summarize, correction_of
    use faststrip_normal_strip_patches, only: patches_t, share_strips, cut_leaving_strips, &
                                              free_ends, drop_slivers
    use faststrip_normal_strip_state, only: strip_workspace_t, position_strips, &
                                            remember, forget_edges
    use faststrip_normal_types, only: normal_result_t, demand_t, cost_t
    implicit none
    private

    public :: solve_near, level_t, attempt_t, solve_together, solve_in_turn

    ! Tuned [tries]. Origin: chosen; what fails four times does not converge.
    integer, parameter :: max_couplings = 4  ! so often strips and ends are tried together
    ! Tuned [passes]. Origin: safeguard.
    integer, parameter :: max_passes = 40    ! with ends in turn
    ! Tuned [passes]: from then on a pass is solved to the end, and may stand. Origin: chosen for
    ! the time: what converges has done so by then.
    integer, parameter :: max_coarse_passes = 10
    ! Tuned [passes]: after so many none of which was better the best stands, if it may. Origin:
    ! chosen for the time: ends that come and go do so without rest.
    integer, parameter :: max_idle_passes = 4
    ! Tuned [splits]. Origin: chosen; what splits more often ends in cells.
    integer, parameter :: max_splits_at_all = 8 ! more: this leads nowhere
    ! Work of all ways together: so much, and so many steps of all strips.
    ! Tuned [influence coefficients; steps]. Origin: chosen: bounds the time of gaps that do not
    ! converge.
    real(wp), parameter :: work_to_begin = 2.0e5_wp, most_steps = 100.0_wp
    ! Tuned [strip widths]. Origin: errors of the area well below those of 15 strips.
    real(wp), parameter :: end_tolerance = 0.03_wp ! in widths of the end strip
    ! Tuned [strip widths]. Origin: ten times end_tolerance.
    real(wp), parameter :: loose_end_tolerance = 0.3_wp ! the same, for the best pass to stand
    ! Tolerance while the ends still move by more than the loose tolerance, and by more than the
    ! other: what is left then is far below what the ends' moves change.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: far_tolerance = 0.1_wp, near_tolerance = 1.0e-2_wp

    !> What is asked for.
    type :: level_t
        integer :: strips_per_patch = usual_strips !! of the widest patch
        integer :: most_strips = usual_strips      !! of all levels, for the limit of the work
        real(wp) :: tolerance = usual_strip_tolerance !! relative size of the last step
        logical :: near = .false.         !! do the strips start near a solution?
    end type level_t

    !> Where the attempt of a level stands, and what it leaves.
    type :: attempt_t
        type(patches_t) :: patches        !! those the next pass starts with
        real(wp) :: penetration = 0.0_wp  !! last found, above the lowest height, mm
        integer :: splits = 0             !! patches split by strips that left
        logical :: in_doubt = .false.     !! do patches split and join, so that cells found them?
        logical :: converged = .false.    !! is there a pass that stands?
        logical :: is_remembered = .true. !! are its strips those that the workspace remembers?
    end type attempt_t

contains

    !> Strips and ends together, until nothing overlaps beside the patches.
    subroutine solve_together(workspace, compliance, demand, level, attempt, strips, result)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance              !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand            !! load or penetration
        type(level_t), intent(in) :: level              !! what is asked for
        type(attempt_t), intent(inout) :: attempt
            !! starts from its patches and penetration; says how it ended
        type(contact_strips_t), intent(inout) :: strips !! of the solution, if it converged
        type(normal_result_t), intent(inout) :: result  !! of the solution; costs are added

        integer :: coupling
        logical :: changed

        call begin(level, attempt)
        workspace%graded = .true.
        do coupling = 1, max_couplings
            call couple(workspace, compliance, demand, level, attempt, strips, result, changed)
            if (.not. changed) exit
        end do
    end subroutine solve_together

    !> Strips between ends that are held, and the ends, in turn.
    subroutine solve_in_turn(workspace, compliance, demand, level, attempt, strips, result)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance              !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand            !! load or penetration
        type(level_t), intent(in) :: level              !! what is asked for
        type(attempt_t), intent(inout) :: attempt
            !! starts from its patches and penetration; says how it ended
        type(contact_strips_t), intent(inout) :: strips !! of the best pass, if it converged
        type(normal_result_t), intent(inout) :: result  !! of the best pass; costs are added

        type(attempt_t) :: best
        type(patches_t) :: solved
        real(wp) :: tolerance, moved, best_move
        integer :: pass, best_pass, outcome
        logical :: possible, changed

        call begin(level, attempt)
        ! Ends that are moved in turn come and go with edges that follow the gap.
        call forget_edges(workspace, .false.)
        tolerance = max(merge(near_tolerance, far_tolerance, level%near), level%tolerance)
        best_move = loose_end_tolerance
        best_pass = 0
        do pass = 1, max_passes
            if (best_pass > 0 .and. pass > best_pass + max_idle_passes) exit
            call position(workspace, level, size(strips%p0), result%cost, attempt, possible)
            if (.not. possible) exit
            call converge(workspace, compliance, demand, tolerance, .true., attempt%patches, &
                          result%cost, outcome)
            result%passes = result%passes + 1
            if (outcome == strips_leave) then
                call cut(workspace, level, attempt, possible)
                if (.not. possible) exit
                cycle
            end if
            if (outcome /= converged) exit
            attempt%penetration = workspace%strips%penetration
            call remember(workspace, attempt%patches)
            solved = attempt%patches
            call move_ends(workspace, pass, attempt%patches, moved)
            call join_overlaps(workspace, compliance, level, attempt, changed)
            if (changed) then
                tolerance = max(far_tolerance, level%tolerance)
                cycle
            end if
            if (tolerance <= level%tolerance) then
                if (moved < best_move) then
                    best_move = moved
                    best_pass = pass
                    best = attempt
                    best%patches = solved
                    call keep(workspace, best, strips, result)
                end if
                if (moved < end_tolerance) exit
            end if
            tolerance = next_tolerance(level%tolerance, pass, moved)
        end do
        attempt%converged = best_pass > 0
        ! More strips start from where the ends were going.
        if (.not. attempt%converged .or. level%strips_per_patch < level%most_strips) return
        ! Passes after the best have left other patches.
        attempt = best
        attempt%converged = .true.
    end subroutine solve_in_turn

    !> The tolerance of the next pass, by how far the ends have moved in this one.
    pure real(wp) function next_tolerance(tolerance, pass, moved)
        real(wp), intent(in) :: tolerance ! of a pass that may stand
        integer, intent(in) :: pass
        real(wp), intent(in) :: moved     ! strip widths

        next_tolerance = far_tolerance
        if (moved <= loose_end_tolerance) next_tolerance = near_tolerance
        ! Later passes count, whatever they reach.
        if (moved < end_tolerance .or. pass >= max_coarse_passes) next_tolerance = tolerance
        next_tolerance = max(next_tolerance, tolerance)
    end function next_tolerance

    !> A neighbour of the last solution, for derivatives: the same patches, strips and edges, solved
    !> to the last digits. So it differs smoothly from it: nothing is looked for, and no edge
    !> follows the gap.
    pure subroutine solve_near(workspace, compliance, demand, tolerance, strips, result, found)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap near that of the last
                                                            !! solution
        real(wp), intent(in) :: compliance              !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand            !! load or penetration
        real(wp), intent(in) :: tolerance               !! relative size of the last step
        type(contact_strips_t), intent(inout) :: strips !! reserved; those of the solution
        type(normal_result_t), intent(inout) :: result  !! its figures
        logical, intent(out) :: found                   !! is there one like the last one?

        type(patches_t) :: patches
        real(wp) :: correction
        integer :: n, outcome
        logical :: graded

        found = workspace%old%n > 0
        if (.not. found) return
        patches = workspace%old
        graded = workspace%graded
        workspace%graded = .false.
        call position_strips(workspace, patches, n)
        workspace%strips%penetration = workspace%old_penetration/workspace%old_correction
        call converge(workspace, compliance, demand, tolerance, .false., patches, result%cost, &
                      outcome)
        workspace%graded = graded
        found = outcome == converged
        if (.not. found) return
        call remember(workspace, patches)
        call hand_over(workspace%strips, patches, strips)
        correction = correction_of(strips%y_left(:n), strips%y_right(:n))
        associate (penetration => workspace%strips%penetration)
            call summarize(strips, workspace%curve%h_lowest + correction*penetration, correction, &
                           result)
            workspace%old_load = result%load
            workspace%old_penetration = penetration*correction
            workspace%old_correction = correction
        end associate
    end subroutine solve_near

    !> Everything but patches and penetration as at the start; share the strips.
    pure subroutine begin(level, attempt)
        type(level_t), intent(in) :: level
        type(attempt_t), intent(inout) :: attempt

        call free_ends(attempt%patches)
        attempt%splits = 0
        attempt%converged = .false.
        attempt%is_remembered = .true.
        call share_strips(level%strips_per_patch, attempt%patches)
    end subroutine begin

    !> Cut the patches into strips, if strips and work are left.
    pure subroutine position(workspace, level, capacity, cost, attempt, possible)
        type(strip_workspace_t), intent(inout) :: workspace
        type(level_t), intent(in) :: level
        integer, intent(in) :: capacity ! of the strips of the answer
        type(cost_t), intent(in) :: cost
        type(attempt_t), intent(inout) :: attempt
        logical, intent(out) :: possible

        integer :: n

        call drop_slivers(attempt%patches)
        possible = attempt%patches%n > 0
        if (.not. possible) return
        call position_strips(workspace, attempt%patches, n)
        possible = n <= min(workspace%max_strips, capacity) &
                   .and. cost_work(cost) <= work_to_begin &
                   + most_steps*step_work(max(n, level%most_strips))
        workspace%strips%penetration = attempt%penetration
    end subroutine position

    !> Solve for strips and ends together, and let overlaps join. Where there is no solution the
    !> patches are as before.
    subroutine couple(workspace, compliance, demand, level, attempt, strips, result, changed)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(level_t), intent(in) :: level
        type(attempt_t), intent(inout) :: attempt
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        logical, intent(out) :: changed ! are there other patches now, to be solved for?

        type(patches_t) :: solved
        integer :: outcome
        logical :: possible

        attempt%converged = .false.
        changed = .false.
        call position(workspace, level, size(strips%p0), result%cost, attempt, possible)
        if (.not. possible) return
        solved = attempt%patches
        call converge(workspace, compliance, demand, level%tolerance, .false., solved, &
                      result%cost, outcome)
        result%passes = result%passes + 1
        if (outcome /= converged) return
        attempt%patches = solved
        attempt%penetration = workspace%strips%penetration
        call remember(workspace, attempt%patches)
        call join_overlaps(workspace, compliance, level, attempt, changed)
        if (changed) return
        if (.not. level%near) then
            ! From afar patches were shared by what their widths seemed to be.
            solved = attempt%patches
            call share_strips(level%strips_per_patch, attempt%patches)
            changed = any(solved%at%n_strips /= attempt%patches%at%n_strips)
            if (changed) return
        end if
        call keep(workspace, attempt, strips, result)
        attempt%converged = .true.
    end subroutine couple

    !> Strips leave: cut them off and share the others anew.
    pure subroutine cut(workspace, level, attempt, possible)
        type(strip_workspace_t), intent(in) :: workspace
        type(level_t), intent(in) :: level
        type(attempt_t), intent(inout) :: attempt
        logical, intent(out) :: possible ! is anything left, and has it not split too often?

        associate (now => workspace%strips)
            call cut_leaving_strips(now%y_left(:now%n), now%y_right(:now%n), now%leaves(:now%n), &
                                    attempt%patches, attempt%splits)
        end associate
        possible = attempt%patches%n > 0 .and. attempt%splits <= max_splits_at_all
        if (possible) call share_strips(level%strips_per_patch, attempt%patches)
    end subroutine cut

    !> Let overlaps join the patches, which are shared anew if that changes them.
    pure subroutine join_overlaps(workspace, compliance, level, attempt, changed)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(level_t), intent(in) :: level
        type(attempt_t), intent(inout) :: attempt
        logical, intent(out) :: changed

        call close_overlaps(workspace, compliance, attempt%penetration, &
                            .not. attempt%in_doubt, attempt%patches, changed)
        if (changed) call share_strips(level%strips_per_patch, attempt%patches)
    end subroutine join_overlaps

    !> Keep a converged pass as the best one.
    pure subroutine keep(workspace, attempt, strips, result)
        type(strip_workspace_t), intent(in) :: workspace
        type(attempt_t), intent(in) :: attempt
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        real(wp) :: correction

        call hand_over(workspace%strips, attempt%patches, strips)
        correction = correction_of(strips%y_left(:strips%n), strips%y_right(:strips%n))
        call summarize(strips, workspace%curve%h_lowest + correction*attempt%penetration, &
                       correction, result)
    end subroutine keep
end module faststrip_normal_strip_level
