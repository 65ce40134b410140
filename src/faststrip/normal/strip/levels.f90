!> Levels of the strip solver: the number of strips asked for is reached by way of smaller ones.
!>
!> 7 strips find the patches, 15 and more refine them. The first are solved for together with the
!> ends. Where that does not succeed a row of cells finds the patches, and passes of 7 strips where
!> 15 do not converge on these. Where 20 or fewer strips do not converge at all twice as many are
!> tried; a gap whose ends do not converge with them either, within a bounded work, gets the answer
!> of `faststrip_normal_cells_lattice`.
module faststrip_normal_strip_levels
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, st_fallback_used
    use faststrip_normal_estimate_errors, only: normal_errors_t, estimate_strip_errors
    use faststrip_normal_cells_lattice, only: lattice_solve, lattice_solve_penetration, &
                                              forget_lattice_errors
    use faststrip_normal_limitations, only: default_resolution
    use faststrip_normal_strips, only: contact_strips_t, usual_strips, usual_strip_tolerance
    use faststrip_normal_strip_figures, only: summarize
    use faststrip_normal_strip_patches, only: fewest_strips
    use faststrip_normal_strip_row, only: find_patches
    use faststrip_normal_strip_settle, only: level_t, settling_t, settle
    use faststrip_normal_strip_start, only: start_patches, resume_patches
    use faststrip_normal_strip_state, only: strip_workspace_t
    use faststrip_normal_types, only: normal_result_t, demand_t
    implicit none
    private

    public :: strip_options_t, strips_auto, strips_auto_most
    public :: solve_by_levels

    !> As many strips as the maximum pressure and the penetration need to settle, 15 to 41, or to be
    !> resolved, up to `strips_auto_most`.
    !> Given: number of a kind.
    integer, parameter :: strips_auto = 0
    integer, parameter :: strips_auto_most = 81

    ! Tuned [strips]. Origin: chosen for the time of a cold start.
    integer, parameter :: scout_strips = 7   ! strips that find the patches
    ! Tuned [strips]. Origin: chosen: scouting would cost as much.
    integer, parameter :: fewest_scouted = 10 ! fewer strips find the patches themselves
    ! Tuned [strips]. Origin: chosen for the time of a cold start.
    integer, parameter :: first_level = 15   ! strips that refine them
    ! Tuned [strips]. Origin: chosen for the time of a cold start.
    integer, parameter :: most_at_once = 20  ! more strips than these are reached by further levels,
    ! Tuned [1]. Origin: chosen for the time of a cold start.
    integer, parameter :: level_factor = 3   ! each with at most so many times the strips
    ! Tuned [levels]: Most levels. Origin: safeguard: more than level_factor needs for any number.
    integer, parameter :: most_levels = 9
    ! Tuned [1]. Origin: far below what the next level changes.
    real(wp), parameter :: coarse_tolerance = 1.0e-3_wp ! of the scouting strips
    ! Tuned [strips]: Numbers of strips tried. Origin: chosen: each about 1.6 times the last.
    integer, parameter :: auto_levels(5) = [15, 27, 41, 61, strips_auto_most]
    ! Tuned [strips]. Origin: chosen.
    integer, parameter :: auto_enough = 41 ! for a solution that is resolved
    ! Tuned [1]. Origin: accuracy wanted: half a percent and a twentieth.
    real(wp), parameter :: auto_pmax = 5.0e-3_wp, auto_penetration = 5.0e-4_wp ! relative change

    ! Tuned [strips]. Origin: chosen for time and errors of the lattice.
    integer, parameter :: most_fallback_strips = 31 ! its cost rises steeply, its accuracy does not

    ! What a level starts from. Given: numbers of kinds.
    integer, parameter :: from_nothing = 1
    integer, parameter :: from_last_solution = 2 ! of the workspace: a warm start
    integer, parameter :: from_coarser = 3       ! the level before
    integer, parameter :: from_row = 4           ! patches found by a row of fixed cells
    integer, parameter :: by_passes = 5          ! nothing, pass by pass

    !> What the user chooses.
    type :: strip_options_t
        integer :: strips_per_patch = usual_strips
            !! strips across the largest patch, or `strips_auto`
        real(wp) :: tolerance = usual_strip_tolerance !! relative size of Newton's last step
        logical :: warm_start = .false.   !! from the last solution of this workspace, if any
        real(wp) :: resolution_limit = default_resolution
            !! `strips_auto` goes on until no estimated error is above this
    end type strip_options_t

    !> The numbers of strips of all levels.
    type :: plan_t
        integer :: n = 0                !! how many levels
        integer :: strips(most_levels) = 0
        ! Given: the first level only finds the patches.
        integer :: first_counted = 2    !! the first whose solution may be the answer
        logical :: is_auto = .false.    !! is any of them enough?
    end type plan_t

    !> Where a solution stands among its levels.
    type :: way_t
        ! Given: the beginning.
        integer :: level = 1             !! of the plan
        integer :: start = from_nothing  !! what it starts from
        integer :: n_settled = 0         !! strips of the last level that counts and settled
        integer :: row_level = 0         !! the highest that started from a row
        integer :: passes_level = 1      !! that passes are to try
        integer :: passed_level = 0      !! the highest that was tried by passes
        logical :: ended = .false.       !! is nothing left to try?
    end type way_t

contains

    !> Solve by levels of strips, or else by the lattice.
    subroutine solve_by_levels(workspace, compliance, demand, options, strips, result, n_settled, &
                               all_settled, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand       !! load or penetration above the lowest height
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance, start
        type(contact_strips_t), intent(inout) :: strips !! of the solution
        type(normal_result_t), intent(inout) :: result !! its figures
        integer, intent(out) :: n_settled    !! strips per patch of the solution; 0: the lattice's
        logical, intent(out) :: all_settled  !! did as many as were asked settle?
        type(status_t), intent(inout) :: status !! those of the lattice

        type(plan_t) :: plan
        type(way_t) :: way
        type(settling_t) :: settling
        type(normal_result_t) :: coarser
        logical :: found, in_doubt

        call forget_lattice_errors(workspace%lattice)
        plan = level_plan(options%strips_per_patch)
        in_doubt = .false.
        if (options%warm_start .and. workspace%old%n > 0) then
            way%start = from_last_solution
            call resume_patches(workspace, demand, settling%patches, settling%penetration)
            in_doubt = any(workspace%old%at(:workspace%old%n)%meets_next)
            way%level = warm_level(plan, maxval(workspace%old%at(:workspace%old%n)%n_strips))
        end if
        do while (way%level <= plan%n)
            call begin(workspace, compliance, demand, way%start, settling, in_doubt, found)
            coarser = result
            if (found) call settle(workspace, compliance, demand, &
                                   level_of(plan, way, in_doubt, options%tolerance), settling, &
                                   strips, result)
            settling%settled = found .and. settling%settled
            if (.not. settling%settled) then
                call try_else(options%strips_per_patch, plan, way)
                if (way%ended) exit
                cycle
            end if
            if (way%level >= plan%first_counted) way%n_settled = plan%strips(way%level)
            way%start = from_coarser
            way%level = way%level + 1
            if (.not. plan%is_auto .or. way%level <= plan%first_counted + 1) cycle
            if (.not. is_resolved(workspace, compliance, strips, result, &
                                  options%resolution_limit)) cycle
            if (is_enough(coarser, result)) exit
        end do
        n_settled = way%n_settled
        all_settled = settling%settled
        result%iterations = result%cost%iterations
        if (n_settled == 0) then
            workspace%old%n = 0
            call fall_back(workspace, compliance, demand, &
                           min(maxval(plan%strips(:plan%n)), most_fallback_strips), strips, &
                           result, status)
            return
        end if
        workspace%old_load = result%load
        workspace%old_penetration = settling%penetration*result%correction
        workspace%old_correction = result%correction
        ! What did not converge is no start for the next solution.
        if (.not. all_settled) workspace%old%n = 0
    end subroutine solve_by_levels

    !> What is tried after a level that did not converge.
    pure subroutine try_else(strips_per_patch, plan, way)
        integer, intent(in) :: strips_per_patch ! asked
        type(plan_t), intent(inout) :: plan
        type(way_t), intent(inout) :: way

        integer :: row_level

        if (way%start == from_last_solution) then
            way%start = from_nothing
            way%level = 1
            return
        end if
        if (way%start == from_coarser) then
            way%ended = plan%strips(way%level) > most_at_once
            way%passes_level = way%level
        end if
        row_level = max(way%level, plan%first_counted)
        if (way%start /= by_passes .and. way%row_level < row_level) then
            way%start = from_row
            way%level = row_level
            way%row_level = row_level
        else if (way%start /= by_passes .and. way%passed_level < way%passes_level) then
            way%start = by_passes
            way%level = way%passes_level
            way%passed_level = way%passes_level
        else
            way%level = plan%n
            if (way%n_settled == 0) call add_level(strips_per_patch, plan)
            way%ended = way%level == plan%n
            way%start = from_row
            way%level = plan%n
            way%row_level = plan%n
        end if
    end subroutine try_else

    !> Patches for a level that does not start from strips.
    subroutine begin(workspace, compliance, demand, start, settling, in_doubt, found)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        integer, intent(in) :: start             ! what the level starts from
        type(settling_t), intent(inout) :: settling
        logical, intent(inout) :: in_doubt       ! do patches split and join?
        logical, intent(out) :: found            ! are there patches?

        found = .true.
        if (start == from_nothing .or. start == by_passes) then
            call start_patches(workspace%curve, compliance, demand, settling%patches, &
                               settling%penetration)
            workspace%old%n = 0
            workspace%carried%known = .false.
            in_doubt = .false.
        else if (start == from_row) then
            call find_patches(workspace, compliance, demand, settling%patches, &
                              settling%penetration, found)
            in_doubt = .true.
        end if
    end subroutine begin

    !> The level that a solution is near enough to be the start of.
    pure integer function warm_level(plan, strips)
        type(plan_t), intent(in) :: plan
        integer, intent(in) :: strips ! across the patch of the solution that has most

        warm_level = plan%first_counted
        if (plan%is_auto) return
        warm_level = max(1, findloc(plan%strips(:plan%n) <= level_factor*strips, .true., dim=1, &
                                    back=.true.))
    end function warm_level

    !> What a level of the plan asks for.
    pure type(level_t) function level_of(plan, way, in_doubt, tolerance)
        type(plan_t), intent(in) :: plan
        type(way_t), intent(in) :: way    ! its level and start
        logical, intent(in) :: in_doubt   ! do patches split and join?
        real(wp), intent(in) :: tolerance ! of the levels that count

        level_of%strips_per_patch = plan%strips(way%level)
        level_of%most_strips = maxval(plan%strips(:plan%n))
        level_of%tolerance = tolerance
        if (way%level < plan%first_counted) level_of%tolerance = max(tolerance, coarse_tolerance)
        level_of%near = any(way%start == [from_last_solution, from_coarser, from_row])
        level_of%at_once = way%start == from_nothing
        level_of%resumes = way%start == from_last_solution
        level_of%scouts = way%level < plan%first_counted
        level_of%in_doubt = in_doubt
    end function level_of

    !> Are so many strips enough that have changed so little?
    pure logical function is_enough(coarser, result)
        type(normal_result_t), intent(in) :: coarser, result ! of the last two levels

        is_enough = result%strips_across >= auto_enough .or. &
                    abs(result%pmax - coarser%pmax) <= auto_pmax*result%pmax .and. &
                    abs(result%penetration - coarser%penetration) &
                    <= auto_penetration*result%penetration
    end function is_enough

    !> Twice the strips after the last level, if those are few: where a neck or an edge is too fine
    !> for few strips, more may settle.
    pure subroutine add_level(strips_per_patch, plan)
        integer, intent(in) :: strips_per_patch ! asked
        type(plan_t), intent(inout) :: plan

        if (plan%strips(plan%n) > min(most_at_once, max(strips_per_patch, fewest_strips)) &
            .or. plan%n == most_levels) return
        plan%n = plan%n + 1
        plan%strips(plan%n) = 2*plan%strips(plan%n - 1) + 1
    end subroutine add_level

    !> Are the estimated errors not above a limit?
    pure logical function is_resolved(workspace, compliance, strips, result, limit)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, limit
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result

        type(normal_errors_t) :: normal_errors
        type(status_t) :: status

        call estimate_strip_errors(workspace%curve, compliance, strips, result, normal_errors, &
                                   status)
        is_resolved = .not. is_error(status) &
                      .and. max(normal_errors%est_err_penetration, normal_errors%est_err_pmax, &
                                normal_errors%est_err_area) <= limit
    end function is_resolved

    !> By which numbers of strips the asked one is reached.
    pure type(plan_t) function level_plan(strips_per_patch) result(plan)
        integer, intent(in) :: strips_per_patch

        plan%is_auto = strips_per_patch == strips_auto
        if (plan%is_auto) then
            plan%n = 1 + size(auto_levels)
            plan%strips(1) = scout_strips
            plan%strips(2:plan%n) = auto_levels
            return
        end if
        plan%n = 1
        plan%strips(1) = max(strips_per_patch, fewest_strips)
        if (strips_per_patch < fewest_scouted) then
            plan%first_counted = 1
            return
        end if
        plan%strips(1) = scout_strips
        do
            plan%n = plan%n + 1
            plan%strips(plan%n) = strips_per_patch
            if (strips_per_patch <= most_at_once .or. plan%n == most_levels) exit
            plan%strips(plan%n) = first_level
            if (plan%n > 2) plan%strips(plan%n) = level_factor*plan%strips(plan%n - 1)
            if (plan%strips(plan%n)*level_factor >= strips_per_patch) then
                plan%n = plan%n + 1
                plan%strips(plan%n) = strips_per_patch
                exit
            end if
        end do
    end function level_plan

    !> The answer of a fixed lattice, for a gap whose ends did not converge.
    subroutine fall_back(workspace, compliance, demand, strips_per_patch, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        integer, intent(in) :: strips_per_patch
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: penetration

        if (demand%by_load) then
            call lattice_solve(workspace%lattice, workspace%curve, compliance, demand%load, &
                               strips_per_patch, strips, penetration, status)
        else
            penetration = demand%penetration + workspace%curve%h_lowest
            call lattice_solve_penetration(workspace%lattice, workspace%curve, compliance, &
                                           penetration, strips_per_patch, strips, status)
        end if
        if (is_error(status)) return
        call summarize(strips, penetration, 1.0_wp, result)
        call set_status(status, st_fallback_used, &
                        'the ends of the contact patches did not converge: fixed lattice used')
    end subroutine fall_back
end module faststrip_normal_strip_levels
