!> Normal contact by Kalker's variational method on a grid of rectangles: NORM.
!>
!> Pressures constant on each rectangle minimise the potential energy of two elastic half-spaces,
!> with the contact condition at the elements' middles (Kalker, Three-Dimensional Elastic Bodies in
!> Rolling Contact, 1990, section 4.3). The reference that the strips are judged by: the same
!> discretisation as CONTACT's NORM, whose values on the same grid it reproduces.
!>
!> Nothing of a contact is assumed beyond the gap: any number of patches, any form. A grid that
!> turns out to be too small is enlarged and the solution taken over.
!>
!> Needs FFTW, and is for program, tests and reports only (`faststrip_kalker_convolution`).
module faststrip_kalker_normal
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, add_limitation, is_error, number_text, &
                                     st_bad_argument, st_edge_of_data, st_no_contact, &
                                     st_not_finite, st_out_of_range, &
                                     st_overlap_left, st_workspace_too_small
    use faststrip_contact_methods, only: usual_side
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, &
                                            copy_gap_curve
    use faststrip_kalker_grid, only: contact_grid_t, size_grid, element_y, take_pressures
    use faststrip_kalker_normal_estimate, only: richardson_estimate, raise_estimates
    use faststrip_kalker_normal_grid, only: grid_solver_t, release_grid_solver, set_task, &
                                            solve_on_grid, guess_on_heights, take_figures
    use faststrip_kalker_normal_options, only: norm_options_t, check_options, check_numbers, &
                                               check_load, check_heights, fitting_side, &
                                               fewest_elements
    use faststrip_kalker_normal_position, only: extent_t, guess_extent, extent_of_strips, &
                                                extent_of_grid, position_grid, take_missing_rows, &
                                                columns_suffice, reaches_end_of_data, &
                                                guess_pressures, enlargement
    use faststrip_kalker_normal_rows, only: pressures_of_strips
    use faststrip_kalker_normal_solver, only: task_t, minimised_t
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_limitations, only: check_depth, check_lowest, name_step
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t, demand_t, above_lowest
    implicit none
    private

    public :: norm_options_t, norm_workspace_t, demand_t
    public :: reserve_norm, release_norm, set_norm_gap, set_norm_curve
    public :: norm_solve, norm_solve_penetration, norm_solve_demand, norm_solve_heights
    public :: norm_watch

    ! Tuned [1]: Tolerance of coarser levels. Origin: far below what the next level changes.
    real(wp), parameter :: coarse_tolerance = 1.0e-6_wp
    ! Height of the gap's lowest place below the elements' middles, over the penetration. A parabola
    ! has less with three rows of elements; what is more is a needle, as of a fill value.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: tolerated_miss = 0.1_wp

    !> Everything a solution needs besides its input, and the pressures it leaves; owned by the
    !> caller, one per thread. Arrays grow with the grid, before the iteration.
    type :: norm_workspace_t
        type(contact_grid_t) :: grid       !! heights and pressures of the last solution
        type(contact_grid_t) :: coarse     !! the same of the level before, sides twice as long; no
                                           !! elements if there was none
        type(normal_errors_t) :: normal_errors !! how well it fulfils the contact condition; errors
                                           !! are estimated where there were two levels, else 0
        logical :: is_estimated = .false.  !! are they?
        integer :: convolutions = 0        !! of the last solution, all grids
        integer :: plans = 0               !! how often plans and kernels were made since reserved
        type(gap_curve_t), private :: curve
        type(contact_grid_t), private :: last
        type(grid_solver_t), private :: solver
    end type norm_workspace_t

    !> What is to be solved, on however many grids.
    type :: problem_t
        real(wp) :: compliance = 0.0_wp !! H of eq. (4), 1/MPa
        type(demand_t) :: demand        !! load, or penetration above the lowest height
        type(norm_options_t) :: options !! as the user chose them
        type(extent_t) :: guess         !! of the contact, by the gap alone
    end type problem_t

    !> Grids of one spacing.
    type :: spacing_t
        integer :: level = 1             !! how many spacings there were, with this one
        real(wp) :: dx = 0.0_wp, dy = 0.0_wp !! sides of the elements, mm
        real(wp) :: tolerance = 0.0_wp   !! of the minimisation
        logical :: from_strips = .false. !! do strips give the first pressures?
    end type spacing_t

    abstract interface
        !> Called for each grid before it is solved, for those who have to wait.
        subroutine norm_watch(grid)
            import :: contact_grid_t
            type(contact_grid_t), intent(in) :: grid !! positioned
        end subroutine norm_watch
    end interface

contains

    !> Allocate for gaps of up to `max_points` points. Not needed for `norm_solve_heights`.
    subroutine reserve_norm(workspace, max_points, status)
        type(norm_workspace_t), intent(inout) :: workspace !! sized; a last solution stays
        integer, intent(in) :: max_points     !! points of a gap, >= 5
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call reserve_gap_curve(workspace%curve, max_points, status)
    end subroutine reserve_norm

    !> Give plans and kernels back. This also happens when a workspace goes out of scope, unless it
    !> is an element of an array: gfortran 12 forgets all but the first.
    subroutine release_norm(workspace)
        type(norm_workspace_t), intent(inout) :: workspace !! serves again

        call release_grid_solver(workspace%solver)
    end subroutine release_norm

    !> Hand over the gap that the next solutions are for.
    subroutine set_norm_gap(workspace, gap, status)
        type(norm_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_t), intent(in) :: gap        !! undeformed gap, mm
        type(status_t), intent(out) :: status !! those of `check_gap`, `st_workspace_too_small`

        call set_gap_curve(workspace%curve, gap, status)
    end subroutine set_norm_gap

    !> The same for a gap that is a curve already.
    subroutine set_norm_curve(workspace, curve, status)
        type(norm_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_curve_t), intent(in) :: curve !! a gap that was set
        type(status_t), intent(out) :: status  !! `st_workspace_too_small`

        call copy_gap_curve(curve, workspace%curve, status)
    end subroutine set_norm_curve

    !> Solve the normal problem of the gap in the workspace under a load. It starts from the strips
    !> given, from the last solution, or from the ellipse that fits the gap's width; with two levels
    !> that is the start of the coarser one.
    !>
    !> Errors: `st_bad_argument` (options), `st_not_finite`, `st_bad_load`, `st_bad_material`,
    !> `st_workspace_too_small` (no gap set, no memory), `st_out_of_range` (more elements than
    !> allowed, a contact beyond all proportion, fill values below the gap),
    !> `st_no_convergence`.
    !> Named limitations: `st_edge_of_data`, the contact runs to the end of the gap's points;
    !> `st_overlap_left`, the gap is much lower somewhere between the elements' middles;
    !> `st_conformal`, a step of the gap in the contact, see `faststrip_normal_limitations`.
    subroutine norm_solve(workspace, compliance, load, options, result, status, strips, watch)
        type(norm_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load                !! normal force Q, N
        type(norm_options_t), intent(in) :: options !! sides, tolerance, start
        type(normal_result_t), intent(out) :: result !! penetration, area, ...; `passes` grids,
                                                    !! `iterations` on all of them
        type(status_t), intent(out) :: status       !! how it ended
        type(contact_strips_t), intent(in), optional :: strips !! a strip solution to start from
        procedure(norm_watch), optional :: watch    !! is called for each grid

        call check_input(workspace, compliance, options, status)
        if (.not. is_error(status)) call check_load(load, status)
        if (is_error(status)) return
        call solve_gap(workspace, compliance, demand_t(load=load), options, result, status, &
                       strips, watch)
    end subroutine norm_solve

    !> The same for a load or a penetration.
    subroutine norm_solve_demand(workspace, compliance, demand, options, result, status, strips, &
                                watch)
        type(norm_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand        !! load or penetration
        type(norm_options_t), intent(in) :: options !! sides, tolerance, start
        type(normal_result_t), intent(out) :: result !! load, penetration, area, ...
        type(status_t), intent(out) :: status       !! how it ended
        type(contact_strips_t), intent(in), optional :: strips !! a strip solution to start from
        procedure(norm_watch), optional :: watch    !! is called for each grid

        if (demand%by_load) then
            call norm_solve(workspace, compliance, demand%load, options, result, status, &
                                strips, watch)
        else
            call norm_solve_penetration(workspace, compliance, demand%penetration, options, &
                                        result, status, strips, watch)
        end if
    end subroutine norm_solve_demand

    !> Solve the normal problem of the gap in the workspace for a penetration; the load is in the
    !> result. Errors as `norm_solve`, and `st_no_contact`: the bodies do not reach each other, or
    !> not the middle of any element.
    subroutine norm_solve_penetration(workspace, compliance, penetration, options, result, status, &
                                      strips, watch)
        type(norm_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration         !! approach D of the bodies, from h = 0, mm
        type(norm_options_t), intent(in) :: options !! sides, tolerance, start
        type(normal_result_t), intent(out) :: result !! load, area, ...
        type(status_t), intent(out) :: status       !! how it ended
        type(contact_strips_t), intent(in), optional :: strips !! a strip solution to start from
        procedure(norm_watch), optional :: watch    !! is called for each grid

        call check_input(workspace, compliance, options, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(penetration)) then
            call set_status(status, st_not_finite, 'the penetration must be a finite number, got ' &
                            //number_text(penetration))
        else if (penetration <= workspace%curve%h_lowest) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(penetration))//' mm, lowest gap ' &
                            //trim(number_text(workspace%curve%h_lowest))//' mm')
        else
            call check_depth(penetration - workspace%curve%h_lowest, status)
            if (is_error(status)) return
            call solve_gap(workspace, compliance, &
                           above_lowest(demand_t(by_load=.false., penetration=penetration), &
                                        workspace%curve%h_lowest), &
                           options, result, status, strips, watch)
        end if
    end subroutine norm_solve_penetration

    !> Solve the normal problem of a gap that is given on a grid of rectangles, of any form.
    !>
    !> The grid has to hold the contact: if it reaches the outermost elements, that is an error. A
    !> body that ends has heights that are too large for contact. Sides of the options, an
    !> error target and an estimate do not count here.
    !>
    !> Errors: as `norm_solve_penetration`; `st_bad_argument`: sides, a grid without elements;
    !> `st_not_finite`: a height, a place; `st_out_of_range`: the contact runs to the grid's rim.
    subroutine norm_solve_heights(workspace, height, dx, dy, x_first, y_first, compliance, demand, &
                                  options, result, status)
        type(norm_workspace_t), intent(inout) :: workspace !! needs no preparation
        real(wp), intent(in) :: height(:, :)        !! undeformed gap at the elements' middles, mm
        real(wp), intent(in) :: dx, dy              !! sides of the elements, mm
        real(wp), intent(in) :: x_first, y_first    !! middle of the first element, mm
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand        !! load, or penetration from zero height
        type(norm_options_t), intent(in) :: options !! tolerance, start
        type(normal_result_t), intent(out) :: result !! penetration, area, ...
        type(status_t), intent(out) :: status       !! how it ended

        type(task_t) :: task
        type(minimised_t) :: found

        call check_numbers(compliance, options, status)
        if (is_error(status)) return
        if (.not. all(ieee_is_finite([dx, dy, x_first, y_first]))) then
            call set_status(status, st_not_finite, 'a side or a place of the grid is not finite')
        else if (min(dx, dy) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'the grid has no elements, or without sides')
        end if
        if (is_error(status)) return
        call check_heights(height, demand, options, status)
        if (is_error(status)) return
        call begin(workspace)
        if (options%warm_start) call keep(workspace)
        call size_grid(workspace%grid, size(height, 1), size(height, 2))
        workspace%grid%dx = dx
        workspace%grid%dy = dy
        workspace%grid%x_first = x_first
        workspace%grid%y_first = y_first
        workspace%grid%height = height
        if (options%warm_start .and. workspace%last%nx > 0) then
            call take_pressures(workspace%grid, workspace%last)
        else
            call guess_on_heights(demand, compliance, workspace%grid)
        end if
        call set_task(demand, 0.0_wp, compliance, dy, options, task, status)
        if (is_error(status)) return
        call solve_grid(workspace, 1, compliance, task, found, result, status)
        if (is_error(status)) return
        call finish(workspace, compliance, found, result)
        associate (p => workspace%grid%pressure, nx => workspace%grid%nx, ny => workspace%grid%ny)
            if (any(p(1, :) > 0.0_wp) .or. any(p(nx, :) > 0.0_wp) .or. any(p(:, 1) > 0.0_wp) &
                .or. any(p(:, ny) > 0.0_wp)) &
                call set_status(status, st_out_of_range, 'the contact runs to the rim of the grid')
        end associate
    end subroutine norm_solve_heights

    !> One spacing, two for an estimate, or as many as a target needs.
    subroutine solve_gap(workspace, compliance, demand, options, result, status, strips, watch)
        type(norm_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(norm_options_t), intent(in) :: options
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status
        type(contact_strips_t), intent(in), optional :: strips
        procedure(norm_watch), optional :: watch

        type(problem_t) :: problem
        type(spacing_t) :: spacing
        type(extent_t) :: extent
        type(normal_result_t) :: coarse
        integer :: level, levels

        call begin(workspace)
        problem%compliance = compliance
        problem%demand = demand
        problem%options = options
        call guess_extent(workspace%curve, compliance, demand, problem%guess, status)
        if (is_error(status)) return
        extent = problem%guess
        if (present(strips)) spacing%from_strips = strips%n > 0
        if (spacing%from_strips) then
            call extent_of_strips(strips, extent)
        else if (options%warm_start .and. workspace%last%nx > 0) then
            call extent_of_grid(workspace%last, extent)
        else
            workspace%last%nx = 0
        end if
        levels = merge(2, 1, options%two_levels)
        spacing%dx = options%dx
        spacing%dy = options%dy
        if (options%fits_dx) spacing%dx = fitting_side(spacing%dx, problem%guess%half_length)
        if (options%fits_dy) spacing%dy = fitting_side(spacing%dy, problem%guess%half_width)
        spacing%dx = levels*spacing%dx
        spacing%dy = levels*spacing%dy
        if (options%error_target > 0.0_wp) then
            levels = huge(levels) ! more elements than allowed come first
            ! Spacings are the usual ones by powers of 2.
            spacing%dx = usual_side*2.0_wp**floor( &
                log(min(extent%half_length, extent%half_width)/(fewest_elements*usual_side)) &
                /log(2.0_wp))
            spacing%dy = spacing%dx
        end if
        do level = 1, levels
            coarse = result
            spacing%level = level
            spacing%tolerance = options%tolerance
            ! A coarse grid is for a start and for estimates.
            if (level < levels .and. .not. options%error_target > 0.0_wp) &
                spacing%tolerance = max(spacing%tolerance, coarse_tolerance)
            call solve_spacing(workspace, problem, spacing, extent, result, status, strips, watch)
            spacing%from_strips = .false.
            if (is_error(status)) then
                workspace%last%nx = 0
                workspace%grid%nx = 0
                return
            end if
            if (level > 1) then
                workspace%is_estimated = result%penetration > workspace%curve%h_lowest
                if (workspace%is_estimated) then
                    call richardson_estimate(coarse, result, 2.0_wp, workspace%curve%h_lowest, &
                                             workspace%normal_errors)
                    call raise_estimates(workspace%curve, compliance, workspace%grid, &
                                         workspace%coarse, workspace%normal_errors)
                end if
                if (options%error_target > 0.0_wp .and. workspace%is_estimated .and. &
                    max(workspace%normal_errors%est_err_penetration, &
                        workspace%normal_errors%est_err_pmax) <= options%error_target) exit
            end if
            if (level == levels) exit
            call keep(workspace)
            workspace%coarse = workspace%grid
            call extent_of_grid(workspace%last, extent)
            spacing%dx = 0.5_wp*spacing%dx
            spacing%dy = 0.5_wp*spacing%dy
        end do
        call name_what_is_left(workspace%curve, workspace%grid, result%penetration, status)
        call check_lowest(workspace%curve, result%penetration - workspace%curve%h_lowest, status)
        if (is_error(status)) result = normal_result_t()
    end subroutine solve_gap

    !> Add to a status what the solution does not hold.
    pure subroutine name_what_is_left(curve, grid, approach, status)
        type(gap_curve_t), intent(in) :: curve
        type(contact_grid_t), intent(in) :: grid
        real(wp), intent(in) :: approach
        type(status_t), intent(inout) :: status

        real(wp) :: y, missed, half_width
        integer :: j
        logical :: is_named

        missed = minval(grid%height) - curve%h_lowest
        if (missed > tolerated_miss*(approach - minval(grid%height))) &
            call add_limitation(status, st_overlap_left, 'the gap is ' &
                                //trim(number_text(missed))//' mm lower at y = ' &
                                //trim(number_text(curve%y_lowest)) &
                                //' mm than at the middle of any element')
        if (reaches_end_of_data(curve, grid)) &
            call add_limitation(status, st_edge_of_data, &
                                'the contact runs to the end of the gap data')
        half_width = 0.5_wp*grid%dy*count(any(grid%pressure > 0.0_wp, dim=1))
        do j = 1, grid%ny
            if (.not. any(grid%pressure(:, j) > 0.0_wp)) cycle
            y = element_y(grid, j)
            call name_step(curve, approach - curve%h_lowest, half_width, y - 0.5_wp*grid%dy, &
                           y + 0.5_wp*grid%dy, status, is_named)
            if (is_named) exit
        end do
    end subroutine name_what_is_left

    !> Solve on grids of one spacing, each larger than the one before, until it holds the contact or
    !> would have more elements than allowed.
    subroutine solve_spacing(workspace, problem, spacing, extent, result, status, strips, watch)
        type(norm_workspace_t), intent(inout) :: workspace
        type(problem_t), intent(in) :: problem
        type(spacing_t), intent(in) :: spacing
        type(extent_t), intent(inout) :: extent
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status
        type(contact_strips_t), intent(in), optional :: strips
        procedure(norm_watch), optional :: watch

        type(task_t) :: task
        type(minimised_t) :: found
        logical :: is_first, is_missing

        call set_task(problem%demand, workspace%curve%h_lowest, problem%compliance, spacing%dy, &
                      problem%options, task, status)
        if (is_error(status)) return
        task%tolerance = spacing%tolerance
        is_first = .true.
        do
            call position_grid(workspace%curve, extent, spacing%dx, spacing%dy, &
                               problem%options%most_elements, workspace%grid, status)
            if (is_error(status)) return
            if (.not. task%by_load .and. task%penetration <= minval(workspace%grid%height)) then
                call set_status(status, st_no_contact, 'the elements are too large: none has its ' &
                                //'middle where the bodies overlap')
                return
            end if
            if (present(watch)) call watch(workspace%grid)
            if (is_first .and. spacing%from_strips) then
                call pressures_of_strips(strips, workspace%grid)
            else if (workspace%last%nx > 0) then
                call take_pressures(workspace%grid, workspace%last)
            else
                call guess_pressures(workspace%curve, problem%guess, workspace%grid)
            end if
            call solve_grid(workspace, 1 + modulo(spacing%level, 2), problem%compliance, task, &
                            found, result, status)
            if (is_error(status)) return
            call take_missing_rows(workspace%curve, problem%compliance, workspace%grid, &
                                   found%approach, extent, is_missing)
            if (.not. columns_suffice(workspace%grid)) then
                is_missing = .true.
                extent%half_length = enlargement*max(extent%half_length, spacing%dx)
            end if
            if (.not. is_missing) then
                call finish(workspace, problem%compliance, found, result)
                return
            end if
            call keep(workspace)
            is_first = .false.
        end do
    end subroutine solve_spacing

    !> Solve on the workspace's grid.
    subroutine solve_grid(workspace, which, compliance, task, found, result, status)
        type(norm_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: which ! of the two sets of kernels
        real(wp), intent(in) :: compliance
        type(task_t), intent(in) :: task
        type(minimised_t), intent(out) :: found
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        call solve_on_grid(workspace%solver, workspace%grid, which, compliance, task, found, &
                           result, status)
        workspace%plans = workspace%solver%plans
        workspace%convolutions = workspace%solver%convolutions
    end subroutine solve_grid

    !> Take the figures of the last grid.
    subroutine finish(workspace, compliance, found, result)
        type(norm_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(minimised_t), intent(in) :: found
        type(normal_result_t), intent(inout) :: result

        workspace%normal_errors%residual_inside = found%residual
        workspace%normal_errors%overlap_outside = found%overlap
        call take_figures(workspace%solver, workspace%grid, compliance, found, result)
    end subroutine finish

    !> Refuse options that cannot be, and a workspace without a gap.
    pure subroutine check_input(workspace, compliance, options, status)
        type(norm_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(norm_options_t), intent(in) :: options
        type(status_t), intent(out) :: status

        call check_options(compliance, options, status)
        if (.not. is_error(status) .and. workspace%curve%n == 0) &
            call set_status(status, st_workspace_too_small, 'no gap was set')
    end subroutine check_input

    !> Forget what was counted of the last solution, and keep its pressures for a warm start.
    subroutine begin(workspace)
        type(norm_workspace_t), intent(inout) :: workspace

        call keep(workspace)
        workspace%solver%convolutions = 0
        workspace%convolutions = 0
        workspace%normal_errors = normal_errors_t()
        workspace%is_estimated = .false.
        workspace%coarse%nx = 0
    end subroutine begin

    !> Remember the pressures.
    subroutine keep(workspace)
        type(norm_workspace_t), intent(inout) :: workspace

        if (workspace%grid%nx == 0) return
        workspace%last = workspace%grid
    end subroutine keep
end module faststrip_kalker_normal
