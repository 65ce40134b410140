!> Kalker's NORM and TANG as methods of a contact, for who links FFTW: `add_kalker` enters them into
!> a workspace, which then solves by them like by those of the core.
!>
!> Both work on grids that grow with the contact, so they allocate. What they keep is the host's:
!> one `kalker_methods_t` a workspace, and a thread; a copy of the workspace shares it.
module faststrip_kalker_methods
    use faststrip_base_friction, only: falls, softened
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, add_limitation, &
                                     message_length, st_bad_argument, st_under_resolved, &
                                     st_workspace_too_small
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: reserve_gap_curve
    use faststrip_normal_limitations, only: name_resolution, name_conformal, name_force_resolution
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_strips, only: usual_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_stress_loads, only: reserve_loads
    use faststrip_tangential_strip_slip, only: slip_between, add_between
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          empty_strip_forces, add_element, state_adhesion
    use faststrip_contact_case, only: contact_case_t, asked_t, keeps_elements
    use faststrip_contact_method, only: normal_method_t, tangential_method_t, workspace_t, &
                                        contact_result_t, demand_of, enter_normal_method, &
                                        enter_tangential_method
    use faststrip_contact_method_asked, only: asked_field
    use faststrip_contact_method_capacity, only: reserve_for_strips
    use faststrip_contact_method_hertz, only: add_shape_errors
    use faststrip_contact_method_march_errors, only: name_falling_friction
    use faststrip_contact_methods, only: contact_methods_t, normal_table, tangential_table, &
                                         normal_norm, normal_strip, tangential_tang, &
                                         tangential_none, start_strips, start_last
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: solve_contact, set_contact_curve
    use faststrip_contact_wanted, only: others_t
    use faststrip_kalker_grid, only: contact_grid_t, element_x, element_y
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       release_norm, set_norm_curve, norm_solve_demand, norm_watch
    use faststrip_kalker_normal_options, only: fitting_side
    use faststrip_kalker_normal_rows, only: rows_as_strips, count_rows
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, take_tractions, edges_of_norm, &
                                           edges_sampled, are_alike
    use faststrip_kalker_tangential_estimate, only: estimate_tang, shares_of_grid, &
                                                    shares_of_strips
    use faststrip_kalker_tangential_pressures, only: sample_strips, sample_ellipse
    use faststrip_kalker_dissimilar, only: dissimilar_problem_t, dissimilar_workspace_t, &
                                           solve_dissimilar, release_dissimilar
    implicit none
    private

    public :: kalker_methods_t, add_kalker, release_kalker

    ! Tuned [us, 1]: Costs and error estimates of both, by target: forces, pmax, penetration, area,
    ! power. Origin: medians of 134 contacts of the families of `force-data`.
    type(others_t), parameter :: expectations(5) = [ &
        others_t(one_us=10.0_wp, one=1.3_wp, order=1.8_wp), &
        others_t(one_us=3.0_wp, over_strips=3.5_wp, order=2.0_wp), &
        others_t(one_us=3.0_wp, over_strips=2.9_wp, order=2.0_wp), &
        others_t(one_us=3.0_wp, over_strips=6.4_wp, order=1.3_wp), &
        others_t(one_us=10.0_wp, one=2.6_wp, order=1.8_wp)]

    abstract interface
        !> Gets the elements in contact before they are solved.
        subroutine tang_watch(elements, with_norm)
            integer, intent(in) :: elements  !! in contact
            logical, intent(in) :: with_norm !! both problems in turn?
        end subroutine tang_watch
    end interface

    !> What both keep.
    type :: kalker_memory_t
        type(norm_workspace_t) :: norm     ! with the grid of the last contact
        type(workspace_t) :: start         ! strips to start from
        type(tang_workspace_t) :: tang
        type(contact_grid_t) :: grid       ! pressures, unless they are NORM's
        type(tang_workspace_t) :: coarse   ! the same for elements twice as long and wide
        type(contact_grid_t) :: coarse_grid
        type(dissimilar_workspace_t) :: dissimilar ! of dissimilar materials with NORM
        procedure(norm_watch), pointer, nopass :: watch_norm => null()
        procedure(tang_watch), pointer, nopass :: watch_tang => null()
    end type kalker_memory_t

    !> NORM.
    type, extends(normal_method_t) :: norm_method_t
        type(kalker_memory_t), pointer :: memory => null()
    contains
        procedure :: reserve => reserve_norm_method
        procedure :: solve => solve_by_norm
        procedure :: estimate => estimate_by_norm
        procedure :: expected => expected_of_norm
    end type norm_method_t

    !> TANG.
    type, extends(tangential_method_t) :: tang_method_t
        type(kalker_memory_t), pointer :: memory => null()
    contains
        procedure :: solve => solve_by_tang
        procedure :: estimate => estimate_by_tang
    end type tang_method_t

    !> Both, with what they keep; not to be copied.
    type :: kalker_methods_t
        type(norm_method_t) :: norm
        type(tang_method_t) :: tang
        type(kalker_memory_t), pointer :: memory => null()
    end type kalker_methods_t

contains

    !> Enter NORM and TANG into a workspace.
    subroutine add_kalker(workspace, kalker, status, watch_norm, watch_tang)
        type(workspace_t), intent(inout) :: workspace          !! knows them afterwards
        type(kalker_methods_t), intent(inout), target :: kalker !! lives longer than the workspace;
                                                               !! for `release_kalker`
        type(status_t), intent(out) :: status
            !! those of `enter_normal_method`; `st_workspace_too_small`, not enough memory
        procedure(norm_watch), optional :: watch_norm          !! is called for each grid of NORM
        procedure(tang_watch), optional :: watch_tang          !! is called for each grid of TANG

        integer :: failure

        call clear_status(status)
        if (.not. associated(kalker%memory)) then
            allocate (kalker%memory, stat=failure)
            if (failure /= 0) then
                call set_status(status, st_workspace_too_small, 'not enough memory for norm')
                return
            end if
        end if
        kalker%memory%watch_norm => pass_over_grid
        kalker%memory%watch_tang => pass_over_elements
        if (present(watch_norm)) kalker%memory%watch_norm => watch_norm
        if (present(watch_tang)) kalker%memory%watch_tang => watch_tang
        kalker%norm%about = normal_table(findloc(normal_table%number, normal_norm, dim=1))
        kalker%norm%memory => kalker%memory
        kalker%tang%about = tangential_table(findloc(tangential_table%number, tangential_tang, &
                                                     dim=1))
        kalker%tang%cuts_creepages = .false.
        kalker%tang%gives_strip_forces = .false.
        kalker%tang%memory => kalker%memory
        call enter_normal_method(workspace, kalker%norm, status)
        if (.not. is_error(status)) call enter_tangential_method(workspace, kalker%tang, status)
    end subroutine add_kalker

    ! Nobody watches.
    subroutine pass_over_grid(grid)
        type(contact_grid_t), intent(in) :: grid
    end subroutine pass_over_grid

    subroutine pass_over_elements(elements, with_norm)
        integer, intent(in) :: elements
        logical, intent(in) :: with_norm
    end subroutine pass_over_elements

    !> Give back all that they keep, when the workspace is not used any more.
    subroutine release_kalker(kalker)
        type(kalker_methods_t), intent(inout) :: kalker !! to be added again

        if (.not. associated(kalker%memory)) return
        call release_norm(kalker%memory%norm)
        call release_tang(kalker%memory%tang)
        call release_tang(kalker%memory%coarse)
        call release_dissimilar(kalker%memory%dissimilar)
        deallocate (kalker%memory)
        kalker%norm%memory => null()
        kalker%tang%memory => null()
    end subroutine release_kalker

    !> Allocate for a gap; grids grow with the contact.
    subroutine reserve_norm_method(self, workspace, methods, max_points, status)
        class(norm_method_t), intent(in) :: self       !! NORM
        type(workspace_t), intent(inout) :: workspace  !! sized
        type(contact_methods_t), intent(in) :: methods !! resolutions
        integer, intent(in) :: max_points              !! of the gap
        type(status_t), intent(inout) :: status        !! those of `reserve_norm`

        call reserve_gap_curve(workspace%solver%curve, max_points, status)
        if (.not. is_error(status)) call reserve_norm(self%memory%norm, max_points, status)
    end subroutine reserve_norm_method

    !> Solve by NORM, from a coarser grid or from strips; if these fail, from the coarser grid. Its
    !> rows become the strips of the contact, for the tangential methods and callers.
    subroutine solve_by_norm(self, workspace, case, normal, status)
        class(norm_method_t), intent(in) :: self      !! NORM
        type(workspace_t), intent(inout) :: workspace !! its strips are filled, and grow
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `norm_solve`

        type(norm_options_t) :: options

        associate (memory => self%memory, methods => case%methods, curve => workspace%solver%curve)
            call reserve_norm(memory%norm, curve%n, status)
            if (.not. is_error(status)) call set_norm_curve(memory%norm, curve, status)
            if (is_error(status)) return
            options%dx = methods%element_dx
            options%dy = methods%element_dy
            options%fits_dx = .not. methods%dx_is_given
            options%fits_dy = .not. methods%dy_is_given
            options%error_target = methods%error_target
            options%most_elements = methods%max_elements
            if (methods%norm_start == start_last) then
                call norm_solve_demand(memory%norm, normal_compliance(case%material), &
                                       demand_of(workspace, case), options, normal, status, &
                                       workspace%strips, memory%watch_norm)
            else
                memory%start%strips%n = 0
                if (methods%norm_start == start_strips) then
                    call solve_start(memory%start, workspace, case)
                    options%two_levels = memory%start%strips%n == 0
                end if
                call norm_solve_demand(memory%norm, normal_compliance(case%material), &
                                       demand_of(workspace, case), options, normal, status, &
                                       memory%start%strips, memory%watch_norm)
            end if
            if (.not. is_error(status)) call take_rows(memory, workspace, status)
            if (is_error(status)) return
            call name_conformal(curve, workspace%strips, status)
            if (keeps_elements(case)) then
                ! For methods that march along the rows.
                call grow_field(workspace, case, workspace%strips%n*methods%points_per_strip, &
                                status)
            else if (case%asked%subsurface) then
                call keep_pressures(memory%norm%grid, workspace, case, status)
            end if
        end associate
    end subroutine solve_by_norm

    !> The strips to start from; none if they have no solution.
    subroutine solve_start(start, workspace, case)
        type(workspace_t), intent(inout) :: start
        type(workspace_t), intent(in) :: workspace ! with the gap
        type(contact_case_t), intent(in) :: case

        type(contact_case_t) :: strips
        type(contact_result_t) :: ignored
        type(status_t) :: status

        strips = case
        strips%gap = gap_t()
        strips%estimate = .false.
        strips%curved = .false.
        strips%asked = asked_t()
        strips%methods%normal = normal_strip
        strips%methods%tangential = tangential_none
        if (strips%methods%strips_per_patch == strips_auto) &
            strips%methods%strips_per_patch = usual_strips
        associate (curve => workspace%solver%curve)
            call reserve_workspace(start, strips%methods, curve%n, status)
            if (.not. is_error(status)) call set_contact_curve(start, curve, status)
        end associate
        if (.not. is_error(status)) call solve_contact(start, strips, ignored, status)
        if (is_error(status)) start%strips%n = 0
    end subroutine solve_start

    !> The rows of the grid as the strips of the contact, with room for what goes with them.
    subroutine take_rows(memory, workspace, status)
        type(kalker_memory_t), intent(in) :: memory   ! with a solution
        type(workspace_t), intent(inout) :: workspace ! its strips are filled
        type(status_t), intent(inout) :: status       ! changed by an error only

        type(status_t) :: rows
        integer :: n

        n = count_rows(memory%norm%grid)
        rows = status_t()
        if (n > size(workspace%strips%p0)) call reserve_for_strips(workspace, n, rows)
        if (.not. is_error(rows)) call rows_as_strips(memory%norm%grid, workspace%strips, rows)
        if (is_error(rows)) status = rows
    end subroutine take_rows

    !> Error estimates of NORM: known where there were two grids.
    subroutine estimate_by_norm(self, workspace, case, result, status)
        class(norm_method_t), intent(in) :: self        !! NORM
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        result%normal_errors = self%memory%norm%normal_errors
        result%has_residuals = .true.
        result%is_estimated = self%memory%norm%is_estimated
        if (result%is_estimated) &
            call name_resolution(result%normal_errors%est_err_penetration, &
                                 result%normal_errors%est_err_pmax, &
                                 result%normal_errors%est_err_area, case%resolution_limit, status)
    end subroutine estimate_by_norm

    !> Costs and error estimates of NORM, and of TANG where forces are the target.
    pure type(others_t) function expected_of_norm(self, target) result(others)
        class(norm_method_t), intent(in) :: self !! NORM
        integer, intent(in) :: target            !! one of the `target_` numbers

        others = others_t()
        if (target >= 1 .and. target <= size(expectations)) others = expectations(target)
    end function expected_of_norm

    !> Solve by TANG: on NORM's grid, or on one under the ellipse or the strips; on NORM's grid with
    !> dissimilar materials both problems in turn, until the pressures stay.
    subroutine solve_by_tang(self, workspace, case, result, status)
        class(tang_method_t), intent(in) :: self               !! TANG
        type(workspace_t), intent(inout), target :: workspace  !! with a normal solution
        type(contact_case_t), intent(in) :: case               !! what to solve
        type(contact_result_t), intent(inout) :: result        !! gets the forces
        type(status_t), intent(out) :: status                  !! of `tang_solve`, of the grid

        associate (memory => self%memory)
            if (workspace%solved_by == normal_norm .and. .not. are_alike(case%material)) then
                call converge_by_tang(memory, workspace, case, result, status)
                if (.not. is_error(status)) call take_rows(memory, workspace, status)
                if (.not. is_error(status)) &
                    call share_rows(memory%dissimilar%tang, memory%norm%grid, workspace, case)
            else if (workspace%solved_by == normal_norm) then
                call prepare_grid(memory, memory%norm%grid, workspace, case, status)
                if (is_error(status)) return
                call solve_on_grid(memory%tang, memory%norm%grid, edges_of_norm, workspace, case, &
                                   result%tangential, status, asked_field(workspace, case))
                if (.not. is_error(status)) &
                    call share_rows(memory%tang, memory%norm%grid, workspace, case)
            else
                call sample_pressures(workspace, case%methods, 1.0_wp, memory%grid, status)
                if (is_error(status)) return
                call prepare_grid(memory, memory%grid, workspace, case, status)
                if (is_error(status)) return
                call solve_on_grid(memory%tang, memory%grid, edges_sampled, workspace, case, &
                                   result%tangential, status, asked_field(workspace, case))
                if (.not. is_error(status)) &
                    call share_rows(memory%tang, memory%grid, workspace, case)
            end if
        end associate
    end subroutine solve_by_tang

    !> What each row of a grid has of slip of its own; without a curved surface nothing.
    pure subroutine find_own(grid, workspace, case, own)
        type(contact_grid_t), intent(in) :: grid
        type(workspace_t), intent(in) :: workspace ! with strips that are laid
        type(contact_case_t), intent(in) :: case
        type(creepage_t), allocatable, intent(out) :: own(:)

        integer :: j

        if (.not. workspace%strips%is_curved) return
        allocate (own(grid%ny))
        do j = 1, grid%ny
            own(j) = slip_between(workspace%strips, 1, workspace%strips%n, element_y(grid, j), &
                                  case%creepage)
        end do
    end subroutine find_own

    !> Share the forces of the rows of a curved surface between the strips about them.
    subroutine share_rows(tang, grid, workspace, case)
        type(tang_workspace_t), intent(in) :: tang    ! with tractions
        type(contact_grid_t), intent(in) :: grid      ! that they stand on
        type(workspace_t), intent(inout) :: workspace ! its strips' forces are filled
        type(contact_case_t), intent(in) :: case

        type(status_t) :: status
        real(wp), allocatable :: px(:, :), py(:, :)
        integer :: j

        if (.not. case%curved) return
        call empty_strip_forces(workspace%strip_forces, workspace%strips%n, status)
        if (is_error(status)) return
        allocate (px(grid%nx, grid%ny), py(grid%nx, grid%ny))
        call take_tractions(tang, grid, px, py)
        do j = 1, grid%ny
            if (.not. any(grid%pressure(:, j) > 0.0_wp)) cycle
            call add_between(workspace%strips, 1, workspace%strips%n, element_y(grid, j), &
                             grid%dx*grid%dy*[sum(px(:, j)), sum(py(:, j))], &
                             workspace%strip_forces%fx, workspace%strip_forces%fy)
        end do
    end subroutine share_rows

    !> Solve both problems of dissimilar materials in turn on NORM's grid, until its pressures stay.
    subroutine converge_by_tang(memory, workspace, case, result, status)
        type(kalker_memory_t), intent(inout) :: memory
        type(workspace_t), intent(inout), target :: workspace
        type(contact_case_t), intent(in) :: case
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(dissimilar_problem_t) :: problem
        type(normal_result_t) :: converged

        problem%material = case%material
        problem%demand = demand_of(workspace, case)
        problem%mu = workspace%mu
        problem%creepage = case%creepage
        problem%friction = workspace%friction
        problem%options%edges = edges_of_norm
        call check_flexibility(workspace, case, status)
        if (is_error(status)) return
        call find_own(memory%norm%grid, workspace, case, problem%options%own)
        associate (grid => memory%norm%grid)
            call memory%watch_tang(count(grid%pressure > 0.0_wp), .true.)
            if (keeps_elements(case)) &
                call grow_field(workspace, case, size(grid%pressure), status)
            if (is_error(status)) return
            call solve_dissimilar(memory%dissimilar, grid, problem, converged, result%tangential, &
                                  status, asked_field(workspace, case))
            if (is_error(status)) return
            converged%passes = result%normal%passes + converged%passes
            converged%iterations = result%normal%iterations + converged%iterations
            result%normal = converged
            grid%pressure = memory%dissimilar%norm%grid%pressure
        end associate
    end subroutine converge_by_tang

    !> Refuse dissimilar materials with a smaller initial slope: moduli that are lowered for it
    !> would let pressures do more.
    pure subroutine check_flexibility(workspace, case, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (are_alike(case%material) .or. workspace%friction%slope_factor >= 1.0_wp) return
        call set_status(status, st_bad_argument, 'tang takes no initial_slope_factor for bodies ' &
                        // 'of dissimilar materials')
    end subroutine check_flexibility

    !> Error estimates of TANG's forces, from elements twice as long and wide: a sixth of its time.
    !> More than the limit is named in the status.
    subroutine estimate_by_tang(self, workspace, case, result, status, finer)
        class(tang_method_t), intent(in) :: self        !! TANG
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer         !! of no use here

        type(tangential_result_t) :: fine, coarse
        type(status_t) :: estimate
        character(len=message_length) :: words
        logical :: is_norm

        if (falls(workspace%friction)) then
            call name_falling_friction(workspace%friction, status)
            return
        end if
        is_norm = workspace%solved_by == normal_norm
        associate (memory => self%memory, errors => result%force_errors)
            if (is_norm) then
                call solve_on_grid(memory%coarse, memory%norm%coarse, edges_of_norm, workspace, &
                                   case, coarse, estimate)
            else
                call sample_pressures(workspace, case%methods, 2.0_wp, memory%coarse_grid, estimate)
                if (.not. is_error(estimate)) &
                    call solve_on_grid(memory%coarse, memory%coarse_grid, edges_sampled, &
                                       workspace, case, coarse, estimate)
            end if
            if (is_error(estimate)) then
                words = 'no error of the forces can be estimated:'
                words(len_trim(words) + 2:) = estimate%message
                call add_limitation(status, st_under_resolved, words)
                return
            end if
            fine = result%tangential
            if (result%is_curved) fine = result%along
            if (is_norm) then
                errors = estimate_tang(memory%norm%grid, workspace%mu, fine, &
                                       coarse, shares_of_grid(result%normal_errors))
            else if (workspace%is_ellipse) then
                errors = estimate_tang(memory%grid, workspace%mu, fine, &
                                       coarse, spread(0.0_wp, 1, 3))
                call add_shape_errors(workspace, case, errors, estimate)
                if (is_error(estimate)) return
            else
                errors = estimate_tang(memory%grid, workspace%mu, fine, &
                                       coarse, shares_of_strips(result%normal_errors))
            end if
            result%forces_are_estimated = .true.
            call name_force_resolution(errors%fx, errors%fy, errors%mz - errors%arm, &
                                       case%force_limit, status)
        end associate
    end subroutine estimate_by_tang

    !> The pressures of the ellipse or of the strips on a grid.
    subroutine sample_pressures(workspace, methods, times, grid, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_methods_t), intent(in) :: methods
        real(wp), intent(in) :: times ! the user's sides
        type(contact_grid_t), intent(inout) :: grid
        type(status_t), intent(out) :: status

        real(wp) :: dx, dy

        dx = methods%element_dx
        dy = methods%element_dy
        associate (hertz => workspace%hertz, strips => workspace%strips, n => workspace%strips%n)
            if (workspace%is_ellipse) then
                if (.not. methods%dx_is_given) dx = fitting_side(dx, hertz%a)
                if (.not. methods%dy_is_given) dy = fitting_side(dy, hertz%b)
                call sample_ellipse(hertz%a, hertz%b, hertz%y, hertz%load, times*dx, times*dy, &
                                    methods%max_elements, grid, status)
            else
                if (.not. methods%dx_is_given .and. n > 0) &
                    dx = fitting_side(dx, maxval(strips%half_length(:n)))
                if (.not. methods%dy_is_given .and. n > 0) &
                    dy = fitting_side(dy, 0.5_wp*sum(strips%y_right(:n) - strips%y_left(:n)))
                call sample_strips(strips, times*dx, times*dy, methods%max_elements, grid, status)
            end if
        end associate
    end subroutine sample_pressures

    !> Tell who watches of a grid, and make room for its elements if they are asked for.
    subroutine prepare_grid(memory, grid, workspace, case, status)
        type(kalker_memory_t), intent(in) :: memory
        type(contact_grid_t), intent(in) :: grid
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(out) :: status

        integer :: elements

        call clear_status(status)
        elements = count(grid%pressure > 0.0_wp)
        call memory%watch_tang(elements, .false.)
        if (keeps_elements(case)) call grow_field(workspace, case, elements, status)
    end subroutine prepare_grid

    subroutine solve_on_grid(tang, grid, edges, workspace, case, tangential, status, field)
        type(tang_workspace_t), intent(inout) :: tang
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: edges
        type(workspace_t), intent(in) :: workspace      ! its friction counts
        type(contact_case_t), intent(in) :: case
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field ! with room for the elements

        type(tang_options_t) :: options

        call check_flexibility(workspace, case, status)
        if (is_error(status)) return
        options%edges = edges
        call find_own(grid, workspace, case, options%own)
        call tang_solve(tang, grid, softened(case%material, workspace%friction), workspace%mu, &
                        case%creepage, options, tangential, status, field, workspace%friction)
    end subroutine solve_on_grid

    !> The elements of a grid without tractions, for stresses below them.
    subroutine keep_pressures(grid, workspace, case, status)
        type(contact_grid_t), intent(in) :: grid
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(inout) :: status

        integer :: i, j

        call grow_field(workspace, case, count(grid%pressure > 0.0_wp), status)
        if (is_error(status)) return
        workspace%field%n = 0
        do j = 1, grid%ny
            do i = 1, grid%nx
                if (grid%pressure(i, j) > 0.0_wp) call add_element( &
                    workspace%field, element_x(grid, i), element_y(grid, j), &
                    [grid%dx, grid%dx*grid%dy], grid%pressure(i, j), 0.0_wp, 0.0_wp, 0.0_wp, &
                    0.0_wp, state_adhesion)
            end do
        end do
    end subroutine keep_pressures

    !> Room for elements in the field and for their loads, if there is too little.
    subroutine grow_field(workspace, case, elements, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        integer, intent(in) :: elements
        type(status_t), intent(inout) :: status

        type(status_t) :: grown
        integer :: capacity

        capacity = 0
        if (allocated(workspace%field%x)) capacity = size(workspace%field%x)
        grown = status_t()
        if (elements > capacity) call reserve_field(workspace%field, elements, grown)
        if (.not. is_error(grown) .and. case%asked%subsurface) &
            call reserve_loads(workspace%loads, elements, grown)
        if (is_error(grown)) status = grown
    end subroutine grow_field
end module faststrip_kalker_methods
