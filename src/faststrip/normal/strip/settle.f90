!> One level of the strip solver: passes with one number of strips until the ends of the patches
!> rest.
!>
!> A level goes from state to state. Each is a procedure that says which comes next:
!>
!>     position  cut the patches into strips              -> newton, couple, give_up
!>     newton    solve for the strips, ends given         -> move, position, give_up
!>     move      let ends move, overlaps join             -> position, couple, done
!>     couple    solve for strips and ends together       -> done, position
!>     done      the ends rest
!>     give_up   a limit was met; the best converged pass counts if its ends moved little
module faststrip_normal_strip_settle
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t, usual_strips, usual_strip_tolerance
    use faststrip_normal_strip_coupled, only: settle_coupled, settle_carried, settle_at_once, &
                                              settle_edges, max_factorings, few_factorings
    use faststrip_normal_strip_ends, only: move_ends, part_ends, close_overlaps
    use faststrip_normal_strip_equations, only: cost_work, step_work
    use faststrip_normal_strip_figures, only: hand_over, summarize, correction_of
    use faststrip_normal_strip_newton, only: solve_strips, newton_converged, newton_strips_leave
    use faststrip_normal_strip_patches, only: patches_t, share_strips, cut_leaving_strips, &
                                              free_ends, drop_slivers
    use faststrip_normal_strip_state, only: strip_workspace_t, position_strips, remember, &
                                            forget_edges
    use faststrip_normal_types, only: normal_result_t, demand_t, cost_t
    implicit none
    private

    public :: level_t, settling_t, settle
    public :: state_position, state_newton, state_move, state_couple, state_done, state_give_up

    ! Given: numbers of states.
    integer, parameter :: state_position = 1 !! cut the patches into strips
    integer, parameter :: state_newton = 2   !! solve for the strips, ends given
    integer, parameter :: state_move = 3     !! let ends move, overlaps join
    integer, parameter :: state_couple = 4   !! solve for strips and ends together
    integer, parameter :: state_done = 5     !! the ends rest
    integer, parameter :: state_give_up = 6  !! a limit was met

    ! Tuned [passes]. Origin: safeguard.
    integer, parameter :: max_passes = 40    ! in one level
    ! Tuned [passes]: the same of a level that only finds patches. Origin: chosen for the time: the
    ! next level can go on from any.
    integer, parameter :: max_scout_passes = 8
    ! Tuned [passes]: from then on a pass is solved to the end, and may stand. Origin: chosen for
    ! the time: what settles has done so by then.
    integer, parameter :: max_coarse_passes = 10
    ! Tuned [passes]: after so many none of which was better the best stands, if it may. Origin:
    ! chosen for the time: ends that come and go do so without rest.
    integer, parameter :: max_idle_passes = 4
    ! Tuned [passes]: the same from the last solution. Origin: chosen for the time: where it is not
    ! near, starting anew costs less.
    integer, parameter :: max_resumed_passes = 1
    ! Tuned [tries]. Origin: chosen; what fails four times does not converge.
    integer, parameter :: max_couplings = 4  ! so often strips and ends are tried together
    ! Tuned [tries]: the same in a level that only finds patches. Origin: chosen for the time.
    integer, parameter :: max_scout_couplings = 2
    ! Tuned [splits]. Origin: chosen against cycles of splitting and merging.
    integer, parameter :: max_splits = 3     ! after so many splits patches are not merged again
    ! Tuned [splits]: the same in a level that only finds patches. Origin: chosen for the time.
    integer, parameter :: max_scout_splits = 2
    ! Tuned [splits]. Origin: chosen; in starts from the last solution.
    integer, parameter :: max_splits_near = 1  ! more: the start was not that near
    ! Tuned [splits]: most of a level that only finds patches. Origin: chosen for the time: a row of
    ! cells finds them then.
    integer, parameter :: max_splits_scouting = 0
    ! Tuned [splits]. Origin: chosen; what splits more often ends in the lattice.
    integer, parameter :: max_splits_at_all = 8 ! more: this leads nowhere
    ! Work of all levels together: so much, and so many steps of all strips.
    ! Tuned [influence coefficients; steps]. Origin: chosen: bounds the time of gaps that do not
    ! settle.
    real(wp), parameter :: work_to_begin = 2.0e5_wp, most_steps = 100.0_wp
    ! Tuned [strip widths]. Origin: errors of the area well below those of 15 strips.
    real(wp), parameter :: end_tolerance = 0.03_wp ! in widths of the end strip
    ! Tuned [strip widths]. Origin: the coupled equations converge from there.
    real(wp), parameter :: coupling_move = 1.0_wp ! less: strips and ends are solved together
    ! Tuned [strip widths]. Origin: ten times end_tolerance.
    real(wp), parameter :: loose_end_tolerance = 0.3_wp ! the same, for the best pass to stand
    ! Newton's tolerance while the ends still move by more than the loose tolerance, and by more
    ! than the other: what is left then is far below what the ends' moves change.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: far_tolerance = 0.1_wp, near_tolerance = 1.0e-2_wp

    ! Tuned [1]. Origin: safeguard: above rounding.
    real(wp), parameter :: sliver = 1.0e-10_wp ! of the gap's range: too narrow for a patch

    !> What a level is asked for.
    type :: level_t
        integer :: strips_per_patch = usual_strips !! of the widest patch
        integer :: most_strips = usual_strips      !! of all levels, for the limit of the work
        real(wp) :: tolerance = usual_strip_tolerance !! relative size of Newton's last step
        logical :: near = .false.         !! do the strips start near a solution?
        logical :: at_once = .false.      !! are strips and ends tried together, or nothing?
        logical :: resumes = .false.      !! near the last one of the workspace?
        logical :: scouts = .false.       !! are patches to be found, and nothing else?
        logical :: in_doubt = .false.     !! do patches split and join, so that a row found them?
    end type level_t

    !> Where the settling of a level stands, and what it leaves.
    type :: settling_t
        integer :: state = state_position !! one of the `state_` numbers
        type(patches_t) :: patches        !! those the next pass starts with
        type(patches_t) :: solved         !! those of this pass
        real(wp) :: penetration = 0.0_wp  !! last found, above the lowest height, mm
        integer :: pass = 0               !! how often strips were positioned
        integer :: splits = 0             !! patches split by strips that left
        integer :: couplings = 0          !! how often strips and ends were tried together
        real(wp) :: tolerance = 0.0_wp    !! of Newton's method in this pass
        logical :: at_rest = .false.      !! did the ends rest in the last pass?
        logical :: appeared = .false.     !! is one of these patches new, beside a solution?
        ! Given: none yet.
        real(wp) :: best_move = huge(1.0_wp) !! of the ends, of the passes solved to the end
        integer :: best_pass = 0          !! whose it is
        logical :: settled = .false.      !! is there a pass that stands?
    end type settling_t

contains

    !> Go from state to state until the ends rest or a limit is met; keep the best converged pass.
    subroutine settle(workspace, compliance, demand, level, settling, strips, result)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance              !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand            !! load or penetration
        type(level_t), intent(in) :: level              !! what is asked for
        type(settling_t), intent(inout) :: settling
            !! starts from its patches and penetration; says how it ended
        type(contact_strips_t), intent(inout) :: strips !! of the best pass
        type(normal_result_t), intent(inout) :: result  !! of the best pass; costs are added

        call begin(workspace, level, settling)
        do
            select case (settling%state)
            case (state_position)
                call position(workspace, level, size(strips%p0), result%cost, settling)
            case (state_newton)
                call solve_pass(workspace, compliance, demand, level, settling, result)
            case (state_move)
                call move(workspace, compliance, level, settling, strips, result)
            case (state_couple)
                call couple(workspace, compliance, demand, level, settling, strips, result)
            case default
                exit
            end select
        end do
        settling%settled = settling%best_move <= loose_end_tolerance
    end subroutine settle

    !> Everything but patches and penetration as at the start; share the strips.
    pure subroutine begin(workspace, level, settling)
        type(strip_workspace_t), intent(inout) :: workspace
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling

        call free_ends(settling%patches)
        settling%state = state_position
        settling%solved = settling%patches
        settling%pass = 0
        settling%splits = 0
        settling%couplings = 0
        settling%tolerance = merge(near_tolerance, far_tolerance, level%near)
        settling%at_rest = .false.
        settling%appeared = .false.
        settling%best_move = huge(1.0_wp)
        settling%best_pass = 0
        call share_strips(level%strips_per_patch, settling%patches)
        if (.not. level%resumes) call forget_edges(workspace, .not. level%scouts)
        if (.not. level%near) return
        ! A small patch keeps its strips where one more or less would only cost a new Jacobian.
        associate (before => settling%solved%at(:settling%solved%n)%n_strips, &
                   shared => settling%patches%at(:settling%solved%n)%n_strips)
            if (maxval(before) == level%strips_per_patch .and. all(abs(before - shared) <= 1)) &
                settling%patches = settling%solved
        end associate
    end subroutine begin

    !> Position: cut the patches into strips, if passes, strips and work are left.
    pure subroutine position(workspace, level, capacity, cost, settling)
        type(strip_workspace_t), intent(inout) :: workspace
        type(level_t), intent(in) :: level
        integer, intent(in) :: capacity ! of the strips of the answer
        type(cost_t), intent(in) :: cost
        type(settling_t), intent(inout) :: settling

        real(wp) :: narrowest
        integer :: n
        logical :: couples

        settling%state = state_give_up
        if (settling%pass >= most_passes(level) .and. .not. settling%appeared) return
        if (settling%best_move <= loose_end_tolerance .and. &
            settling%pass > settling%best_pass + max_idle_passes) return
        settling%pass = settling%pass + 1
        narrowest = sliver*(workspace%curve%y(workspace%curve%n) - workspace%curve%y(1))
        call drop_slivers(narrowest, settling%patches)
        if (settling%patches%n == 0) return
        ! Ends that are moved in turn come and go with edges that follow the gap.
        couples = settling%appeared .or. &
                  settling%pass == 1 .and. (level%near .or. level%at_once)
        if (.not. couples .and. workspace%graded) call forget_edges(workspace, .false.)
        call position_strips(workspace, settling%patches, n)
        if (n > min(workspace%max_strips, capacity)) return
        if (cost_work(cost) > work_to_begin + most_steps*step_work(max(n, level%most_strips))) &
            return
        workspace%strips%penetration = settling%penetration
        settling%solved = settling%patches
        settling%state = merge(state_couple, state_newton, couples)
    end subroutine position

    !> How often strips may be positioned in a level.
    pure integer function most_passes(level)
        type(level_t), intent(in) :: level

        most_passes = max_passes
        if (level%scouts) most_passes = max_scout_passes
        if (level%resumes) most_passes = max_resumed_passes
    end function most_passes

    !> How often patches may split in a level.
    pure integer function most_splits(level)
        type(level_t), intent(in) :: level

        most_splits = max_splits_at_all
        if (level%scouts .and. .not. level%in_doubt) most_splits = max_splits_scouting
        if (level%near) most_splits = max_splits_near
    end function most_splits

    !> Newton: solve for the strips between ends that are given.
    subroutine solve_pass(workspace, compliance, demand, level, settling, result)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling
        type(normal_result_t), intent(inout) :: result

        integer :: outcome

        settling%tolerance = max(settling%tolerance, level%tolerance)
        call solve_strips(workspace%strips, compliance, demand, settling%tolerance, result%cost, &
                          outcome, workspace%newton)
        result%passes = result%passes + 1
        select case (outcome)
        case (newton_converged)
            settling%penetration = workspace%strips%penetration
            call remember(workspace, settling%patches)
            settling%state = state_move
        case (newton_strips_leave)
            call cut(workspace, level, settling)
        case default
            settling%state = state_give_up
        end select
    end subroutine solve_pass

    !> Strips leave: cut them off and position the others anew.
    pure subroutine cut(workspace, level, settling)
        type(strip_workspace_t), intent(in) :: workspace
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling

        associate (now => workspace%strips)
            call cut_leaving_strips(now%y_left(:now%n), now%y_right(:now%n), now%leaves(:now%n), &
                                    settling%patches, settling%splits)
        end associate
        if (settling%patches%n == 0 .or. &
            settling%splits > most_splits(level)) then
            settling%state = state_give_up
        else
            call share_strips(level%strips_per_patch, settling%patches)
            settling%state = state_position
        end if
    end subroutine cut

    !> Move: let the ends move to where the strips run out, and overlaps join.
    pure subroutine move(workspace, compliance, level, settling, strips, result)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        real(wp) :: moved ! in widths of the end strips
        logical :: changed

        call move_ends(workspace, settling%pass, settling%patches, moved)
        call join_overlaps(workspace, compliance, level, settling, changed)
        if (changed) return
        if (settling%tolerance <= level%tolerance) then
            if (moved < settling%best_move) call keep(workspace, moved, settling, strips, result)
            if (settling%at_rest .or. moved < end_tolerance) then
                settling%state = state_done
                return
            end if
        end if
        settling%at_rest = moved < end_tolerance
        if (moved > loose_end_tolerance) then
            settling%tolerance = far_tolerance
        else if (.not. settling%at_rest) then
            settling%tolerance = near_tolerance
        end if
        ! Later passes count, whatever they reach.
        if (settling%at_rest .or. settling%pass >= min(max_coarse_passes, most_passes(level)/2)) &
            settling%tolerance = level%tolerance
        settling%state = state_position
        if (.not. moved < coupling_move) return
        if (level%scouts .and. settling%couplings == max_scout_couplings) then
            settling%state = state_give_up
        else if (settling%couplings < max_couplings) then
            settling%state = state_couple
        end if
    end subroutine move

    !> Couple: solve for strips and ends together, from nearby.
    pure subroutine couple(workspace, compliance, demand, level, settling, strips, result)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        integer :: n
        logical :: found, changed, appeared

        settling%state = state_position
        settling%couplings = settling%couplings + 1
        appeared = settling%appeared
        settling%appeared = .false.
        if (appeared) then
            call settle_carried(workspace, compliance, demand, level%tolerance, settling%solved, &
                                result%cost, found)
        else if (level%near .and. settling%pass == 1) then
            call settle_carried(workspace, compliance, demand, level%tolerance, settling%solved, &
                                result%cost, found)
            if (.not. found .and. workspace%graded) then
                call start_plainly(workspace, settling)
                call settle_carried(workspace, compliance, demand, level%tolerance, &
                                    settling%solved, result%cost, found)
            end if
            if (.not. found) then
                call start_plainly(workspace, settling)
                call settle_coupled(workspace, compliance, demand, level%tolerance, &
                                    merge(few_factorings, max_factorings, level%resumes), &
                                    settling%solved, result%cost, found)
            end if
        else if (level%at_once .and. settling%pass == 1) then
            call settle_at_once(workspace, compliance, demand, level%tolerance, settling%solved, &
                                result%cost, found)
            if (.not. found .and. workspace%graded) then
                call start_plainly(workspace, settling)
                call settle_at_once(workspace, compliance, demand, level%tolerance, &
                                    settling%solved, result%cost, found)
            end if
        else
            call settle_coupled(workspace, compliance, demand, level%tolerance, max_factorings, &
                                settling%solved, result%cost, found)
        end if
        if (.not. found .and. level%at_once) call leave_try(workspace, settling)
        if (.not. found) return
        if (.not. level%scouts) call settle_edges(workspace, compliance, demand, level%tolerance, &
                                                  settling%solved, result%cost)
        settling%patches = settling%solved
        settling%penetration = workspace%strips%penetration
        call remember(workspace, settling%patches)
        call part_ends(workspace, loose_end_tolerance, settling%patches, changed)
        if (changed) return
        n = settling%patches%n
        call join_overlaps(workspace, compliance, level, settling, changed)
        settling%appeared = settling%patches%n > n .and. settling%couplings < max_couplings
        if (changed) return
        call keep(workspace, 0.0_wp, settling, strips, result)
        settling%state = state_done
    end subroutine couple

    !> Start anew from the patches of this pass, with edges that follow the ends alone: from far off
    !> they succeed more often.
    pure subroutine start_plainly(workspace, settling)
        type(strip_workspace_t), intent(inout) :: workspace
        type(settling_t), intent(inout) :: settling

        integer :: n

        call forget_edges(workspace, .false.)
        settling%solved = settling%patches
        call position_strips(workspace, settling%solved, n)
        workspace%strips%penetration = settling%penetration
        workspace%carried%known = .false.
        workspace%newton%kept = .false.
    end subroutine start_plainly

    !> Strips and ends were tried together and not found: nothing is left of that but its cost.
    pure subroutine leave_try(workspace, settling)
        type(strip_workspace_t), intent(inout) :: workspace
        type(settling_t), intent(inout) :: settling

        settling%state = state_give_up
        workspace%carried%known = .false.
        workspace%newton%kept = .false.
    end subroutine leave_try

    !> Let overlaps join the patches. If that changes them, they are positioned anew, far from a
    !> solution.
    pure subroutine join_overlaps(workspace, compliance, level, settling, changed)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(level_t), intent(in) :: level
        type(settling_t), intent(inout) :: settling
        logical, intent(out) :: changed

        call close_overlaps(workspace, compliance, settling%penetration, &
                            .not. level%in_doubt .and. settling%splits &
                            < merge(max_scout_splits, max_splits, level%scouts), &
                            settling%patches, changed)
        if (.not. changed) return
        settling%at_rest = .false.
        settling%tolerance = far_tolerance
        call share_strips(level%strips_per_patch, settling%patches)
        settling%state = state_position
    end subroutine join_overlaps

    !> Keep a converged pass as the best one.
    pure subroutine keep(workspace, moved, settling, strips, result)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: moved ! how far the ends still go
        type(settling_t), intent(inout) :: settling
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        real(wp) :: correction

        settling%best_move = moved
        settling%best_pass = settling%pass
        call hand_over(workspace%strips, settling%patches, strips)
        correction = correction_of(strips%y_left(:strips%n), strips%y_right(:strips%n))
        call summarize(strips, workspace%curve%h_lowest + correction*settling%penetration, &
                       correction, result)
    end subroutine keep
end module faststrip_normal_strip_settle
