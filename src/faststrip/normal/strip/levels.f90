!> The ways to a solution by strips, in the order in which they are tried.
!>
!> Strips and ends together, from the last solution or from the level set of a Hertz ellipse; where
!> that does not converge, from the patches of coarse cells; then from those of fine cells, in turn.
!> More than 15 strips are reached by way of 15, 31 and so on. A gap whose ends do not converge,
!> within a bounded work, gets the answer of the fine cells.
module faststrip_normal_strip_levels
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, &
                                     st_fallback_used, st_linear_algebra, st_out_of_range
    use faststrip_normal_estimate_errors, only: normal_errors_t, estimate_strip_errors
    use faststrip_normal_cells, only: record_strips
    use faststrip_normal_limitations, only: check_depth, default_resolution
    use faststrip_normal_strips, only: contact_strips_t, usual_strips, usual_strip_tolerance
    use faststrip_normal_strip_figures, only: summarize, correction_of
    use faststrip_normal_strip_patches, only: fewest_strips
    use faststrip_normal_strip_find, only: find_patches
    use faststrip_normal_strip_level, only: level_t, attempt_t, solve_together, &
                                            solve_in_turn
    use faststrip_normal_strip_start, only: start_patches, resume_patches
    use faststrip_normal_strip_state, only: strip_workspace_t, forget_edges, forget_factors
    use faststrip_normal_types, only: normal_result_t, demand_t
    implicit none
    private

    public :: strip_options_t, strips_auto, strips_auto_most
    public :: solve_by_levels

    !> As many strips as estimated errors of maximum pressure and penetration ask for, 15 to 41, or
    !> as it takes to be resolved, up to `strips_auto_most`.
    !> Given: number of a kind.
    integer, parameter :: strips_auto = 0
    integer, parameter :: strips_auto_most = 81

    ! Tuned [1]: strips of a level, less one, over those of the one before, at most. Origin:
    ! convergence: 41 strips from 15 are too far where A jumps.
    integer, parameter :: level_factor = 2
    ! Tuned [levels]: Most levels. Origin: safeguard: more than level_factor needs for any number.
    integer, parameter :: most_levels = 12
    ! Tuned [strips]: Numbers of strips tried. Origin: chosen: each about 1.6 times the last. A
    ! solution that is resolved has enough by the middle one.
    integer, parameter :: auto_levels(5) = [usual_strips, 27, 41, 61, strips_auto_most]
    ! Tuned [1]. Origin: accuracy wanted: half a percent and a tenth.
    real(wp), parameter :: auto_pmax = 5.0e-3_wp, auto_penetration = 1.0e-3_wp ! estimated errors

    ! The ways to a solution, in the order in which they are tried. Given: numbers of kinds.
    integer, parameter :: from_last = 0   ! solution of the workspace
    integer, parameter :: from_level = 1  ! set of a Hertz ellipse
    integer, parameter :: from_coarse = 2 ! coarse cells
    integer, parameter :: from_fine = 3   ! fine cells, strips and ends in turn

    !> What the user chooses.
    type :: strip_options_t
        integer :: strips_per_patch = usual_strips
            !! strips across the largest patch, or `strips_auto`
        real(wp) :: tolerance = usual_strip_tolerance !! relative size of Newton's last step
        logical :: warm_start = .false.   !! from the last solution of this workspace, if any
        logical :: stays = .false.
            !! is this a neighbour of the last solution, with its patches and strips?
        logical :: by_cells = .false.
            !! is the answer to be that of cells, whether or not ends converge?
        real(wp) :: resolution_limit = default_resolution
            !! `strips_auto` goes on until no estimated error is above this
    end type strip_options_t

    !> The numbers of strips of all levels.
    type :: plan_t
        integer :: n = 0                !! how many levels
        integer :: strips(most_levels) = 0
        logical :: is_auto = .false.    !! is any of them enough?
    end type plan_t

contains

    !> Solve by strips, or else by cells.
    subroutine solve_by_levels(workspace, compliance, demand, options, strips, result, &
                               n_converged, all_converged, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand       !! load or penetration above the lowest height
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance, start
        type(contact_strips_t), intent(inout) :: strips !! of the solution
        type(normal_result_t), intent(inout) :: result !! its figures
        integer, intent(out) :: n_converged    !! strips per patch of the solution; 0: cells'
        logical, intent(out) :: all_converged  !! did as many as were asked converge?
        type(status_t), intent(inout) :: status !! those of cells

        type(plan_t) :: plan
        type(attempt_t) :: attempt
        integer :: way, first_way, level
        logical :: found

        plan = level_plan(options%strips_per_patch)
        level = 1
        n_converged = 0
        attempt%converged = .false.
        first_way = merge(from_last, from_level, options%warm_start .and. workspace%old%n > 0)
        if (options%by_cells) first_way = from_fine
        do way = first_way, from_fine
            call begin(workspace, compliance, demand, way, size(strips%p0), attempt, found)
            if (.not. found .or. options%by_cells) cycle
            if (way == from_last) then
                level = warm_level(plan, maxval(workspace%old%at(:workspace%old%n)%n_strips))
            else if (way == from_level) then
                level = 1
            end if
            ! Cells start where the level before has failed.
            call climb(workspace, compliance, demand, options, plan, way, level, attempt, &
                       strips, result, n_converged)
            if (attempt%converged .or. (plan%is_auto .and. n_converged > 0)) exit
        end do
        all_converged = attempt%converged
        result%iterations = result%cost%iterations
        if (n_converged == 0) then
            workspace%old%n = 0
            call take_cells(workspace, strips, result, status)
            return
        end if
        workspace%old_load = result%load
        workspace%old_penetration = attempt%penetration*result%correction
        workspace%old_correction = result%correction
        ! What did not converge is no start for the next solution.
        if (.not. (all_converged .and. attempt%is_remembered)) workspace%old%n = 0
    end subroutine solve_by_levels

    !> What a way starts from; but for the last solution, no bit of one before is left.
    subroutine begin(workspace, compliance, demand, way, room, attempt, found)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        integer, intent(in) :: way
        integer, intent(in) :: room   ! most cells
        type(attempt_t), intent(inout) :: attempt
        logical, intent(out) :: found ! are there patches?

        found = .true.
        if (way == from_last) then
            attempt%in_doubt = any(workspace%old%at(:workspace%old%n)%meets_next)
            call resume_patches(workspace, demand, attempt%patches, attempt%penetration)
            return
        end if
        call start_patches(workspace%curve, compliance, demand, attempt%patches, &
                           attempt%penetration)
        workspace%old%n = 0
        call forget_factors(workspace)
        call forget_edges(workspace, .true.)
        attempt%in_doubt = way > from_level
        if (attempt%in_doubt) call find_patches(workspace, compliance, demand, way == from_fine, &
                                                room, attempt%patches, attempt%penetration, found)
    end subroutine begin

    !> Solve with the numbers of strips of a plan, each from the one before.
    subroutine climb(workspace, compliance, demand, options, plan, way, level, attempt, strips, &
                     result, n_converged)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(strip_options_t), intent(in) :: options
        type(plan_t), intent(in) :: plan
        integer, intent(in) :: way        ! what it starts from
        integer, intent(inout) :: level   ! of the plan: the first, then the last
        type(attempt_t), intent(inout) :: attempt ! with the patches to start from
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        integer, intent(inout) :: n_converged ! strips of the last level that converged

        type(level_t) :: asked
        type(attempt_t) :: in_turn
        integer :: first, passes

        first = level
        do level = first, plan%n
            asked = level_t(plan%strips(level), maxval(plan%strips(:plan%n)), options%tolerance, &
                            way == from_last .or. level > first)
            attempt%converged = .false.
            if (level > first .or. way < from_fine) &
                call solve_together(workspace, compliance, demand, asked, attempt, strips, result)
            if (.not. attempt%converged .and. (level > first .or. way == from_fine)) then
                call solve_in_turn(workspace, compliance, demand, asked, attempt, strips, result)
                if (.not. attempt%converged) return
                ! From there edges may follow the gap.
                in_turn = attempt
                passes = result%passes
                call solve_together(workspace, compliance, demand, asked, attempt, strips, result)
                if (.not. attempt%converged) then
                    attempt = in_turn
                    call forget_edges(workspace, .false.)
                    attempt%is_remembered = result%passes == passes + 1
                end if
            end if
            if (.not. attempt%converged) return
            n_converged = plan%strips(level)
            if (.not. plan%is_auto) cycle
            if (is_enough(workspace, compliance, strips, result, options%resolution_limit)) return
        end do
    end subroutine climb

    !> The level that a solution is near enough to be the start of.
    pure integer function warm_level(plan, strips)
        type(plan_t), intent(in) :: plan
        integer, intent(in) :: strips ! across the patch of the solution that has most

        warm_level = 1
        if (plan%is_auto) return
        warm_level = max(1, findloc(plan%strips(:plan%n) <= level_factor*strips + 1, .true., &
                                    dim=1, back=.true.))
    end function warm_level

    !> Are so many strips enough, by their estimated errors?
    pure logical function is_enough(workspace, compliance, strips, result, limit)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, limit
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result

        type(normal_errors_t) :: errors
        type(status_t) :: status

        call estimate_strip_errors(workspace%curve, compliance, strips, result, errors, status)
        is_enough = .not. is_error(status) &
                    .and. max(errors%est_err_penetration, errors%est_err_pmax, &
                              errors%est_err_area) <= limit
        if (result%strips_across >= auto_levels(3)) return
        is_enough = is_enough .and. errors%est_err_pmax <= auto_pmax &
                    .and. errors%est_err_penetration <= auto_penetration
    end function is_enough

    !> By which numbers of strips the asked one is reached.
    pure type(plan_t) function level_plan(strips_per_patch) result(plan)
        integer, intent(in) :: strips_per_patch

        integer :: strips

        plan%is_auto = strips_per_patch == strips_auto
        if (plan%is_auto) then
            plan%n = size(auto_levels)
            plan%strips(:plan%n) = auto_levels
            return
        end if
        strips = max(strips_per_patch, fewest_strips)
        plan%n = 1
        ! More at once take longer from nothing, and converge in fewer rough gaps.
        plan%strips(1) = min(strips, usual_strips)
        do while (plan%strips(plan%n) < strips .and. plan%n < most_levels)
            plan%n = plan%n + 1
            plan%strips(plan%n) = min(strips, level_factor*plan%strips(plan%n - 1) + 1)
        end do
        plan%strips(plan%n) = strips
    end function level_plan

    !> The answer of the fine cells, for a gap whose ends did not converge.
    subroutine take_cells(workspace, strips, result, status)
        type(strip_workspace_t), intent(in) :: workspace
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: correction

        associate (cells => workspace%cells)
            call check_depth(cells%depth, status)
            if (is_error(status)) return
            if (cells%n_ranges == 0) then
                ! So little beside the heights that no number lies between.
                call set_status(status, st_out_of_range, 'a contact beyond all proportion: ' // &
                                'penetration ' // trim(number_text(cells%depth)) // ' mm')
            else if (.not. cells%solved) then
                call set_status(status, st_linear_algebra, &
                                'the pressures of fixed cells have no solution')
            end if
            if (is_error(status)) return
            call record_strips(cells, strips)
            correction = correction_of(strips%y_left(:strips%n), strips%y_right(:strips%n))
            call summarize(strips, workspace%curve%h_lowest + correction*cells%depth, correction, &
                           result)
        end associate
        result%ends_are_held = .true.
        call set_status(status, st_fallback_used, &
                        'the ends of the contact patches did not converge: fixed cells used')
    end subroutine take_cells
end module faststrip_normal_strip_levels
