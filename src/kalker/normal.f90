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
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_bad_load, st_bad_material, &
                                     st_edge_of_data, st_no_contact, st_no_convergence, &
                                     st_not_finite, st_out_of_range, st_overlap_left, &
                                     st_workspace_too_small
    use faststrip_base_material, only: check_compliance
    use faststrip_influence_rectangle, only: rectangle_potential
    use faststrip_kalker_convolution, only: convolution_t, reserve_convolution, &
                                            release_convolution, set_kernel, set_inverse_kernel, &
                                            even
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, &
                                            copy_gap_curve
    use faststrip_normal_certificate, only: certificate_t, richardson_estimate
    use faststrip_normal_limitations, only: check_penetration, name_step, add_limitation
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_kalker_normal_estimate, only: raise_estimates
    use faststrip_kalker_grid, only: contact_grid_t, size_grid, element_x, element_y, &
                                     take_pressures, count_patches
    use faststrip_kalker_normal_place, only: extent_t, guess_extent, extent_of_strips, &
                                             extent_of_grid, place_grid, take_missing_rows, &
                                             columns_suffice, reaches_end_of_data, &
                                             guess_pressures
    use faststrip_kalker_normal_rows, only: pressures_of_strips
    use faststrip_kalker_normal_solver, only: minimiser_t, size_minimiser, task_t, minimise, &
                                              minimised_t, kernel_influence, kernel_inverse
    use faststrip_normal_types, only: normal_result_t, demand_t, above_lowest
    implicit none
    private

    public :: norm_options_t, norm_workspace_t, demand_t
    public :: reserve_norm, release_norm, set_norm_gap, set_norm_curve
    public :: norm_solve, norm_solve_penetration, norm_solve_demand, norm_solve_heights
    public :: norm_most_elements, norm_watch

    !> Most elements of a grid, in contact or not, unless the options say otherwise.
    !> Tuned [elements]. Origin: capacity.
    integer, parameter :: norm_most_elements = 4000000

    ! Tuned [placings]. Origin: safeguard.
    integer, parameter :: max_placings = 12       ! of the grid, for one spacing
    ! Of the half-length, when columns are missing, at first and in the end.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: enlargement = 1.3_wp, late_enlargement = 2.0_wp
    ! Tuned [levels]. Origin: safeguard.
    integer, parameter :: max_levels = 12         ! of spacing, for a target
    ! Tuned [elements]. Origin: chosen: as few as show a patch.
    integer, parameter :: first_elements = 6      ! across the shorter half of the first level
    ! Tuned [1]: Tolerance of coarser levels. Origin: far below what the next level changes.
    real(wp), parameter :: coarse_tolerance = 1.0e-6_wp
    ! Height of the gap's lowest place below the elements' middles, over the penetration. A parabola
    ! has less with three rows of elements; what is more is a needle, as of a fill value.
    ! Tuned [1]. Origin: as said with it.
    real(wp), parameter :: tolerated_miss = 0.1_wp
    ! Tuned [mm]. Origin: the reference's grid.
    real(wp), parameter :: spacing_unit = 0.1_wp  ! mm; with a target, spacings are this by 2^k

    ! Sizes beyond which nothing is promised.
    ! Tuned [mm, MPa]. Origin: safeguard.
    real(wp), parameter :: smallest = 1.0e-60_wp, largest = 1.0e60_wp

    !> What the user chooses.
    type :: norm_options_t
        ! Tuned [mm]. Origin: chosen for the S1002/UIC60 contacts.
        real(wp) :: dx = 0.2_wp           !! side of the elements along x, mm
        real(wp) :: dy = 0.2_wp           !! side of the elements along y, mm
        real(wp) :: error_target = 0.0_wp !! estimated relative error of penetration and largest
                                          !! pressure; the sides are chosen if it is positive
        logical :: two_levels = .true.    !! solve with sides twice as long before: a better start
                                          !! and an estimate of the errors
        ! Tuned [1]. Origin: far below the errors of any grid.
        real(wp) :: tolerance = 1.0e-9_wp !! largest |gap| in contact over the approach
        ! Tuned [iterations]. Origin: safeguard.
        integer :: max_iterations = 300   !! of conjugate gradients on one grid
        logical :: warm_start = .false.   !! from the last solution of this workspace, if any
        logical :: preconditioned = .true. !! or plain conjugate gradients?
        integer :: most_elements = norm_most_elements !! of a grid
    end type norm_options_t

    !> Plans and kernels of one grid.
    type :: kernels_t
        type(convolution_t) :: convolution
        real(wp) :: aspect = 0.0_wp ! dy/dx of the elements
    end type kernels_t

    !> Everything a solution needs besides its input, and the pressures it leaves; owned by the
    !> caller, one per thread. Arrays grow with the grid, before the iteration.
    type :: norm_workspace_t
        type(contact_grid_t) :: grid       !! heights and pressures of the last solution
        type(certificate_t) :: certificate !! how well it fulfils the contact condition; errors
                                           !! are estimated where there were two levels, else 0
        logical :: is_estimated = .false.  !! are they?
        integer :: convolutions = 0        !! of the last solution, all grids
        integer :: plans = 0               !! how often plans and kernels were made since reserved
        type(gap_curve_t), private :: curve
        type(contact_grid_t), private :: last
        type(minimiser_t), private :: minimiser
        ! Plans and kernels; two, so that two levels keep theirs from one solution to the next.
        type(kernels_t), private :: kernels, other_kernels
        integer, allocatable, private :: stack(:)
    end type norm_workspace_t

    abstract interface
        !> Told of each grid before it is solved, for those who have to wait.
        subroutine norm_watch(grid)
            import :: contact_grid_t
            type(contact_grid_t), intent(in) :: grid !! placed
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

        call release_convolution(workspace%kernels%convolution)
        call release_convolution(workspace%other_kernels%convolution)
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
    !> allowed, a contact beyond all proportion, a penetration that is not positive),
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
        procedure(norm_watch), optional :: watch    !! is told of each grid

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
        procedure(norm_watch), optional :: watch    !! is told of each grid

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
        procedure(norm_watch), optional :: watch    !! is told of each grid

        call check_input(workspace, compliance, options, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(penetration)) then
            call set_status(status, st_not_finite, 'the penetration is not a finite number: ' &
                            //number_text(penetration))
        else if (penetration <= workspace%curve%h_lowest) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(penetration))//' mm, lowest gap ' &
                            //trim(number_text(workspace%curve%h_lowest))//' mm')
        else
            call solve_gap(workspace, compliance, &
                           above_lowest(demand_t(by_load=.false., penetration=penetration), &
                                        workspace%curve%h_lowest), &
                           options, result, status, strips, watch)
        end if
    end subroutine norm_solve_penetration

    !> Solve the normal problem of a gap that is given on a grid of rectangles, of any form.
    !>
    !> The grid has to hold the contact: if it reaches the outermost elements, that is an error. A
    !> body that ends is told by heights that are too large for contact. Sides of the options, an
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
        integer :: j

        call check_numbers(compliance, options, status)
        if (is_error(status)) return
        if (.not. all(ieee_is_finite([dx, dy, x_first, y_first]))) then
            call set_status(status, st_not_finite, 'a side or a place of the grid is not finite')
        else if (min(dx, dy) <= 0.0_wp .or. min(size(height, 1), size(height, 2)) < 1) then
            call set_status(status, st_bad_argument, 'the grid has no elements, or without sides')
        else if (size(height, 1)*real(size(height, 2), wp) > options%most_elements) then
            call set_status(status, st_out_of_range, 'the grid has more elements than allowed')
        end if
        if (is_error(status)) return
        do j = 1, size(height, 2)
            if (all(ieee_is_finite(height(:, j)))) cycle
            call set_status(status, st_not_finite, 'a height of the grid is not a finite number')
            return
        end do
        if (demand%by_load) then
            call check_load(demand%load, status)
            if (is_error(status)) return
        else if (.not. ieee_is_finite(demand%penetration)) then
            call set_status(status, st_not_finite, 'the penetration is not a finite number: ' &
                            //number_text(demand%penetration))
            return
        else if (demand%penetration <= minval(height)) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(demand%penetration))//' mm, lowest gap ' &
                            //trim(number_text(minval(height)))//' mm')
            return
        end if
        if (maxval(abs(height)) > largest) then
            call set_status(status, st_out_of_range, 'a height of the grid is beyond 1e60 mm')
            return
        end if
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
        call solve_on_grid(workspace, 1, compliance, task, found, result, status)
        if (is_error(status)) return
        call take_figures(workspace, compliance, found, result)
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

        type(extent_t) :: extent, guess
        type(normal_result_t) :: coarse
        type(status_t) :: estimate
        real(wp) :: dx, dy, tolerance
        integer :: level, levels
        logical :: from_strips

        call begin(workspace)
        call guess_extent(workspace%curve, compliance, demand, guess, status)
        if (is_error(status)) return
        extent = guess
        from_strips = .false.
        if (present(strips)) from_strips = strips%n > 0
        if (from_strips) then
            call extent_of_strips(strips, extent)
        else if (options%warm_start .and. workspace%last%nx > 0) then
            call extent_of_grid(workspace%last, extent)
        else
            workspace%last%nx = 0
        end if
        levels = merge(2, 1, options%two_levels)
        dx = levels*options%dx
        dy = levels*options%dy
        if (options%error_target > 0.0_wp) then
            levels = max_levels
            dx = spacing_unit*2.0_wp**floor(log(min(extent%half_length, extent%half_width) &
                                                /(first_elements*spacing_unit))/log(2.0_wp))
            dy = dx
        end if
        do level = 1, levels
            coarse = result
            tolerance = options%tolerance
            ! A coarse grid is for a start and for estimates.
            if (level < levels .and. .not. options%error_target > 0.0_wp) &
                tolerance = max(tolerance, coarse_tolerance)
            call solve_spacing(workspace, compliance, demand, options, level, tolerance, dx, dy, &
                               extent, guess, result, status, from_strips .and. level == 1, &
                               strips, watch)
            if (is_error(status)) then
                workspace%last%nx = 0
                workspace%grid%nx = 0
                return
            end if
            if (level > 1) then
                call richardson_estimate(coarse, result, 2.0_wp, workspace%curve%h_lowest, &
                                         workspace%certificate, estimate)
                workspace%is_estimated = .not. is_error(estimate)
                if (workspace%is_estimated) &
                    call raise_estimates(workspace%curve, compliance, workspace%grid, &
                                         workspace%certificate)
                if (options%error_target > 0.0_wp .and. workspace%is_estimated .and. &
                    max(workspace%certificate%est_err_penetration, &
                        workspace%certificate%est_err_pmax) <= options%error_target) exit
            end if
            if (level == levels) exit
            call keep(workspace)
            call extent_of_grid(workspace%last, extent)
            dx = 0.5_wp*dx
            dy = 0.5_wp*dy
        end do
        call name_what_is_left(workspace%curve, workspace%grid, result%penetration, status)
        call check_penetration(workspace%curve, result%penetration, status)
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

    !> Solve on grids of one spacing, each larger than the one before, until it holds the contact.
    subroutine solve_spacing(workspace, compliance, demand, options, level, tolerance, dx, dy, &
                             extent, guess, result, status, from_strips, strips, watch)
        type(norm_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(norm_options_t), intent(in) :: options
        integer, intent(in) :: level
        real(wp), intent(in) :: tolerance, dx, dy
        type(extent_t), intent(inout) :: extent
        type(extent_t), intent(in) :: guess
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status
        logical, intent(in) :: from_strips
        type(contact_strips_t), intent(in), optional :: strips
        procedure(norm_watch), optional :: watch

        type(task_t) :: task
        type(minimised_t) :: found
        integer :: placing
        logical :: is_missing

        call set_task(demand, workspace%curve%h_lowest, compliance, dy, options, task, status)
        if (is_error(status)) return
        task%tolerance = tolerance
        do placing = 1, max_placings
            call place_grid(workspace%curve, extent, dx, dy, options%most_elements, &
                            workspace%grid, status)
            if (is_error(status)) return
            if (.not. task%by_load .and. task%penetration <= minval(workspace%grid%height)) then
                call set_status(status, st_no_contact, 'the elements are too large: none has its ' &
                                //'middle where the bodies overlap')
                return
            end if
            if (present(watch)) call watch(workspace%grid)
            if (placing == 1 .and. from_strips) then
                call pressures_of_strips(strips, workspace%grid)
            else if (workspace%last%nx > 0) then
                call take_pressures(workspace%grid, workspace%last)
            else
                call guess_pressures(workspace%curve, guess, workspace%grid)
            end if
            call solve_on_grid(workspace, 1 + modulo(level, 2), compliance, task, found, result, &
                               status)
            if (is_error(status)) return
            call take_missing_rows(workspace%curve, compliance, workspace%grid, found%approach, &
                                   extent, is_missing)
            if (.not. columns_suffice(workspace%grid)) then
                is_missing = .true.
                extent%half_length = max(extent%half_length, dx) &
                                     *merge(enlargement, late_enlargement, placing <= 3)
            end if
            if (.not. is_missing) exit
            call keep(workspace)
        end do
        if (is_missing) then
            call set_status(status, st_no_convergence, 'no grid was found that holds the contact')
            return
        end if
        call take_figures(workspace, compliance, found, result)
    end subroutine solve_spacing

    !> Forget what was counted of the last solution, and keep its pressures for a warm start.
    subroutine begin(workspace)
        type(norm_workspace_t), intent(inout) :: workspace

        call keep(workspace)
        workspace%convolutions = 0
        workspace%certificate = certificate_t()
        workspace%is_estimated = .false.
    end subroutine begin

    !> Remember the pressures.
    subroutine keep(workspace)
        type(norm_workspace_t), intent(inout) :: workspace

        if (workspace%grid%nx == 0) return
        workspace%last = workspace%grid
    end subroutine keep

    !> Load or approach in the minimiser's lengths.
    pure subroutine set_task(demand, h_lowest, compliance, dy, options, task, status)
        type(demand_t), intent(in) :: demand
        real(wp), intent(in) :: h_lowest ! from which the demand's penetration counts, mm
        real(wp), intent(in) :: compliance, dy
        type(norm_options_t), intent(in) :: options
        type(task_t), intent(out) :: task
        type(status_t), intent(out) :: status

        call clear_status(status)
        task%demand_t = demand
        task%tolerance = options%tolerance
        task%max_iterations = options%max_iterations
        task%preconditioned = options%preconditioned
        if (demand%by_load) then
            ! Logarithms, as the product may overflow.
            if (abs(log(demand%load) + log(compliance) - log(dy)) > log(largest)) then
                call set_status(status, st_out_of_range, 'a contact beyond all proportion: load ' &
                                //trim(number_text(demand%load))//' N')
                return
            end if
            task%total = compliance*demand%load/dy
        else
            task%penetration = demand%penetration + h_lowest
        end if
    end subroutine set_task

    !> Plans and kernels for the grid, then the minimisation.
    subroutine solve_on_grid(workspace, which, compliance, task, found, result, status)
        type(norm_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: which ! of the two sets of kernels
        real(wp), intent(in) :: compliance
        type(task_t), intent(in) :: task
        type(minimised_t), intent(out) :: found
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        associate (grid => workspace%grid)
            call size_minimiser(workspace%minimiser, grid%nx, grid%ny)
            workspace%minimiser%s = grid%pressure
            if (which == 1) then
                call minimise_on(workspace%kernels)
            else
                call minimise_on(workspace%other_kernels)
            end if
            if (is_error(status)) return
            grid%pressure = workspace%minimiser%s/(compliance*grid%dx)
        end associate
        result%passes = result%passes + 1
        result%iterations = result%iterations + found%iterations
        workspace%convolutions = workspace%convolutions + found%convolutions
        if (.not. found%converged) &
            call set_status(status, st_no_convergence, 'the pressures did not converge: the gap ' &
                            //'in contact is '//trim(number_text(found%residual)) &
                            //' of the approach')

    contains

        subroutine minimise_on(kernels)
            type(kernels_t), intent(inout) :: kernels

            call prepare_kernels(workspace%grid, kernels, workspace%plans, status)
            if (is_error(status)) return
            call minimise(kernels%convolution, workspace%grid%height, task, workspace%minimiser, &
                          found)
        end subroutine minimise_on
    end subroutine solve_on_grid

    !> Influence numbers of the grid and their inverse, unless they are there.
    subroutine prepare_kernels(grid, kernels, plans, status)
        type(contact_grid_t), intent(in) :: grid
        type(kernels_t), intent(inout) :: kernels
        integer, intent(inout) :: plans ! is counted up if they had to be made
        type(status_t), intent(out) :: status

        real(wp), allocatable :: influence(:, :)
        real(wp) :: aspect
        integer :: i, j, half_x, half_y, before(2)

        aspect = grid%dy/grid%dx
        associate (convolution => kernels%convolution)
            before = [convolution%nx, convolution%ny]
            call reserve_convolution(convolution, grid%nx, grid%ny, 2, 1, status)
            if (is_error(status)) return
            if (all(before == [grid%nx, grid%ny]) .and. kernels%aspect == aspect) return
            half_x = convolution%mx/2
            half_y = convolution%my/2
            allocate (influence(0:half_x, 0:half_y))
            do j = 0, half_y
                do i = 0, half_x
                    influence(i, j) = rectangle_potential(real(i, wp), j*aspect, 1.0_wp, aspect)
                end do
            end do
            call set_kernel(convolution, kernel_influence, influence, even, even, status)
            if (is_error(status)) return
            call set_inverse_kernel(convolution, kernel_inverse, kernel_influence, status)
        end associate
        kernels%aspect = aspect
        plans = plans + 1
    end subroutine prepare_kernels

    !> Proportions of pressures to start from on given heights: the overlap of the undeformed
    !> bodies at half the approach of a round contact as large as it.
    pure subroutine guess_on_heights(demand, compliance, grid)
        type(demand_t), intent(in) :: demand
        real(wp), intent(in) :: compliance
        type(contact_grid_t), intent(inout) :: grid

        ! Tuned [1]: Share of the penetration at which heights overlap. Origin: virtual penetration
        ! of a Hertz contact (Piotrowski and Kik).
        real(wp), parameter :: share = 0.55_wp
        ! Tuned [halvings]: most of the range of a first penetration. Origin: more than a guess
        ! needs.
        integer, parameter :: max_halvings = 40
        real(wp) :: lowest, low, high, depth, radius
        integer :: i

        lowest = minval(grid%height)
        if (demand%by_load) then
            low = 0.0_wp
            ! As if one element carried it all.
            ! Given: Hertz, a round contact
            high = 0.75_wp*pi*compliance*(demand%load/sqrt(grid%dx*grid%dy/pi))
            do i = 1, max_halvings
                depth = 0.5_wp*(low + high)
                radius = sqrt(max(1, count(grid%height - lowest < share*depth)) &
                              *(grid%dx*grid%dy/pi))
                ! Given: Hertz, a round contact
                if (depth < 0.75_wp*pi*compliance*demand%load/radius) then
                    low = depth
                else
                    high = depth
                end if
            end do
        else
            depth = demand%penetration - lowest
        end if
        grid%pressure = sqrt(max(share*depth - (grid%height - lowest), 0.0_wp))
    end subroutine guess_on_heights

    !> Load, area, ... of the pressures.
    subroutine take_figures(workspace, compliance, found, result)
        type(norm_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(minimised_t), intent(in) :: found
        type(normal_result_t), intent(inout) :: result

        integer :: i, j, first, last

        workspace%certificate%residual_inside = found%residual
        workspace%certificate%overlap_outside = found%overlap
        associate (grid => workspace%grid, p => workspace%grid%pressure)
            result%load = sum(workspace%minimiser%s)*grid%dy/compliance
            result%penetration = found%approach
            result%area = count(p > 0.0_wp)*(grid%dx*grid%dy)
            result%pmax = maxval(p)
            first = grid%ny
            last = 1
            result%x_max = 0.0_wp
            do j = 1, grid%ny
                if (.not. any(p(:, j) > 0.0_wp)) cycle
                first = min(first, j)
                last = j
                do i = 1, grid%nx
                    if (p(i, j) > 0.0_wp) &
                        result%x_max = max(result%x_max, abs(element_x(grid, i)) + 0.5_wp*grid%dx)
                end do
            end do
            result%y_min = element_y(grid, first) - 0.5_wp*grid%dy
            result%y_max = element_y(grid, last) + 0.5_wp*grid%dy
            if (allocated(workspace%stack)) then
                if (size(workspace%stack) < 2*size(p)) deallocate (workspace%stack)
            end if
            if (.not. allocated(workspace%stack)) allocate (workspace%stack(2*size(p)))
            call count_patches(p, workspace%stack, result%n_patches)
        end associate
    end subroutine take_figures

    pure subroutine check_input(workspace, compliance, options, status)
        type(norm_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(norm_options_t), intent(in) :: options
        type(status_t), intent(out) :: status

        call check_numbers(compliance, options, status)
        if (is_error(status)) return
        if (.not. all(ieee_is_finite([options%dx, options%dy, options%error_target]))) then
            call set_status(status, st_not_finite, 'a side of the elements or the error target ' &
                            //'is not a finite number')
        else if (min(options%dx, options%dy) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'a side of the elements is not positive: ' &
                            //trim(number_text(options%dx))//' by ' &
                            //trim(number_text(options%dy))//' mm')
        else if (min(options%dx, options%dy) < smallest &
                 .or. max(options%dx, options%dy) > largest) then
            call set_status(status, st_out_of_range, 'a side of the elements is beyond 1e60')
        else if (options%error_target < 0.0_wp) then
            call set_status(status, st_bad_argument, 'the error target is negative: ' &
                            //number_text(options%error_target))
        else if (workspace%curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        end if
    end subroutine check_input

    pure subroutine check_numbers(compliance, options, status)
        real(wp), intent(in) :: compliance
        type(norm_options_t), intent(in) :: options
        type(status_t), intent(out) :: status

        call check_compliance(compliance, status)
        if (is_error(status)) return
        if (compliance < smallest .or. compliance > largest) then
            call set_status(status, st_out_of_range, 'the compliance is beyond all proportion: ' &
                            //number_text(compliance))
        else if (.not. ieee_is_finite(options%tolerance)) then
            call set_status(status, st_not_finite, &
                            'the tolerance is not a finite number: ' &
                            //number_text(options%tolerance))
        else if (options%tolerance <= 0.0_wp .or. options%tolerance >= 1.0_wp) then
            call set_status(status, st_bad_argument, &
                            'the tolerance is not in (0, 1): '//number_text(options%tolerance))
        else if (options%max_iterations < 1 .or. options%most_elements < 1) then
            call set_status(status, st_bad_argument, 'no iterations or no elements allowed')
        end if
    end subroutine check_numbers

    pure subroutine check_load(load, status)
        real(wp), intent(in) :: load
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. ieee_is_finite(load)) then
            call set_status(status, st_not_finite, &
                            'the load is not a finite number: '//number_text(load))
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load is not positive: '//trim(number_text(load))//' N')
        else if (load < smallest .or. load > largest) then
            call set_status(status, st_out_of_range, 'the load is beyond all proportion: ' &
                            //trim(number_text(load))//' N')
        end if
    end subroutine check_load
end module faststrip_kalker_normal
