!> Kalker's variational method as the tangential method of one contact: outside the embeddable core.
module faststrip_command_tang_stage
    use faststrip_base_friction, only: falls, softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     message_length, st_bad_argument, st_under_resolved
    use faststrip_base_text, only: integer_text
    use faststrip_kalker_normal_options, only: fitting_side
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, edges_of_norm, edges_sampled, are_alike
    use faststrip_kalker_unlike, only: unlike_problem_t, unlike_workspace_t, solve_unlike, &
                                       release_unlike
    use faststrip_kalker_tangential_estimate, only: estimate_tang, shares_of_grid, &
                                                    shares_of_strips
    use faststrip_kalker_tangential_pressures, only: sample_strips, sample_ellipse
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_normal_limitations, only: add_limitation, name_force_resolution
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_command_system, only: set_detail
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_norm, normal_hertz
    use faststrip_contact_solve, only: workspace_t, add_shape_errors, name_falling_friction
    use faststrip_command_methods, only: numerics_t
    use faststrip_command_norm_stage, only: norm_stage_t
    implicit none
    private

    public :: tang_stage_t, release_tang_stage, solve_by_tang, settle_by_tang, estimate_by_tang

    !> The method with its workspace.
    type :: tang_stage_t
        type(tang_workspace_t), private :: workspace
        type(unlike_workspace_t), private :: unlike ! of unlike materials with NORM
        type(contact_grid_t), private :: grid ! pressures, unless they are NORM's
        ! The same for elements twice as long and wide.
        type(tang_workspace_t), private :: coarse_workspace
        type(contact_grid_t), private :: coarse_grid
    end type tang_stage_t

contains

    !> Give back what the compiler does not: plans of stages in an array.
    subroutine release_tang_stage(stage)
        type(tang_stage_t), intent(inout) :: stage !! serves again

        call release_tang(stage%workspace)
        call release_tang(stage%coarse_workspace)
        call release_unlike(stage%unlike)
    end subroutine release_tang_stage

    !> Solve the tangential problem on NORM's grid, or on one under the ellipse or the strips.
    subroutine solve_by_tang(stage, numerics, case, workspace, norm, with_field, tangential, &
                             field, status)
        type(tang_stage_t), intent(inout) :: stage   !! grows
        type(numerics_t), intent(in) :: numerics     !! normal method, sides of the elements
        type(contact_case_t), intent(in) :: case     !! material, friction, creepages
        type(workspace_t), intent(in) :: workspace   !! with a solution, unless it is NORM's
        type(norm_stage_t), intent(in) :: norm       !! with a solution, if it is NORM's
        logical, intent(in) :: with_field            !! are the elements wanted?
        type(tangential_result_t), intent(out) :: tangential !! figures
        type(tangential_field_t), intent(inout) :: field !! grows and is filled, if wanted
        type(status_t), intent(out) :: status        !! of `tang_solve`, of the grid

        if (numerics%normal == normal_norm) then
            call solve_on_grid(stage%workspace, norm%workspace%grid, edges_of_norm, case, &
                               with_field, tangential, field, status)
            return
        end if
        call sample_pressures(numerics, workspace, 1.0_wp, stage%grid, status)
        if (is_error(status)) return
        call solve_on_grid(stage%workspace, stage%grid, edges_sampled, case, with_field, &
                           tangential, field, status)
    end subroutine solve_by_tang

    !> Solve both problems of unlike materials in turn on NORM's grid, until its pressures stay.
    subroutine settle_by_tang(stage, case, norm, with_field, normal, tangential, field, status)
        type(tang_stage_t), intent(inout) :: stage   !! grows
        type(contact_case_t), intent(in) :: case     !! material, friction, creepages
        type(norm_stage_t), intent(inout) :: norm    !! with a solution; its pressures change
        logical, intent(in) :: with_field            !! are the elements wanted?
        type(normal_result_t), intent(inout) :: normal !! of that solution, and of the new one
        type(tangential_result_t), intent(out) :: tangential !! figures
        type(tangential_field_t), intent(inout) :: field !! grows and is filled, if wanted
        type(status_t), intent(out) :: status        !! of `solve_unlike`

        type(unlike_problem_t) :: problem
        type(normal_result_t) :: settled

        problem%material = case%material
        problem%demand = case%demand_t
        problem%mu = case%mu
        problem%creepage = case%creepage
        problem%friction = case%friction
        problem%options%edges = edges_of_norm
        call check_softness(case, status)
        if (is_error(status)) return
        call set_detail('norm and tang: ' // integer_text(count(norm%workspace%grid%pressure &
                        > 0.0_wp)) // ' elements in contact')
        if (with_field) then
            if (size(norm%workspace%grid%pressure) > size(field%x)) &
                call reserve_field(field, size(norm%workspace%grid%pressure), status)
            call solve_unlike(stage%unlike, norm%workspace%grid, problem, settled, tangential, &
                              status, field)
        else
            call solve_unlike(stage%unlike, norm%workspace%grid, problem, settled, tangential, &
                              status)
        end if
        if (is_error(status)) return
        settled%passes = normal%passes + settled%passes
        settled%iterations = normal%iterations + settled%iterations
        normal = settled
        norm%workspace%grid%pressure = stage%unlike%norm%grid%pressure
    end subroutine settle_by_tang

    !> Refuse unlike materials with a smaller initial slope: moduli that are lowered for it would
    !> let pressures do more.
    pure subroutine check_softness(case, status)
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (are_alike(case%material) .or. case%friction%slope_factor >= 1.0_wp) return
        call set_status(status, st_bad_argument, 'tang takes no initial_slope_factor for bodies ' &
                        // 'of unlike materials')
    end subroutine check_softness

    !> How wrong the forces are that `solve_by_tang` gave, from elements twice as long and wide: a
    !> sixth of its time. More than the limit is named in the status.
    subroutine estimate_by_tang(stage, numerics, case, workspace, norm, certificate, tangential, &
                                errors, is_estimated, status)
        type(tang_stage_t), intent(inout) :: stage   !! with a solution
        type(numerics_t), intent(in) :: numerics     !! what it is of
        type(contact_case_t), intent(in) :: case     !! what it is of
        type(workspace_t), intent(in) :: workspace   !! what it is of
        type(norm_stage_t), intent(in) :: norm       !! what it is of, if that is NORM's
        type(certificate_t), intent(in) :: certificate !! of the normal solution
        type(tangential_result_t), intent(in) :: tangential !! the forces
        type(force_errors_t), intent(out) :: errors  !! of them
        logical, intent(out) :: is_estimated         !! are they known?
        type(status_t), intent(inout) :: status      !! limitations so far; `st_under_resolved`

        type(tangential_result_t) :: coarse
        type(tangential_field_t) :: no_field
        type(status_t) :: estimate
        character(len=message_length) :: words

        is_estimated = .false.
        if (falls(case%friction)) then
            call name_falling_friction(status)
            return
        end if
        if (numerics%normal == normal_norm) then
            call solve_on_grid(stage%coarse_workspace, norm%workspace%coarse, edges_of_norm, &
                               case, .false., coarse, no_field, estimate)
        else
            call sample_pressures(numerics, workspace, 2.0_wp, stage%coarse_grid, estimate)
            if (.not. is_error(estimate)) &
                call solve_on_grid(stage%coarse_workspace, stage%coarse_grid, edges_sampled, &
                                   case, .false., coarse, no_field, estimate)
        end if
        if (is_error(estimate)) then
            words = 'no error of the forces can be estimated:'
            words(len_trim(words) + 2:) = estimate%message
            call add_limitation(status, st_under_resolved, words)
            return
        end if
        if (numerics%normal == normal_norm) then
            errors = estimate_tang(norm%workspace%grid, case%mu, tangential, coarse, &
                                   shares_of_grid(certificate))
        else if (numerics%normal == normal_hertz) then
            errors = estimate_tang(stage%grid, case%mu, tangential, coarse, spread(0.0_wp, 1, 3))
            call add_shape_errors(workspace, case, errors, estimate)
            if (is_error(estimate)) return
        else
            errors = estimate_tang(stage%grid, case%mu, tangential, coarse, &
                                   shares_of_strips(certificate))
        end if
        is_estimated = .true.
        call name_force_resolution(errors%fx, errors%fy, errors%mz - errors%arm, &
                                   case%force_limit, status)
    end subroutine estimate_by_tang

    !> The pressures of the ellipse or of the strips on a grid.
    subroutine sample_pressures(numerics, workspace, times, grid, status)
        type(numerics_t), intent(in) :: numerics
        type(workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: times ! the user's sides
        type(contact_grid_t), intent(inout) :: grid
        type(status_t), intent(out) :: status

        real(wp) :: dx, dy

        dx = numerics%element_dx
        dy = numerics%element_dy
        associate (hertz => workspace%hertz, strips => workspace%strips, n => workspace%strips%n)
            if (numerics%normal == normal_hertz) then
                if (.not. numerics%dx_is_given) dx = fitting_side(dx, hertz%a)
                if (.not. numerics%dy_is_given) dy = fitting_side(dy, hertz%b)
                call sample_ellipse(hertz%a, hertz%b, hertz%y, hertz%load, times*dx, times*dy, &
                                    numerics%max_elements, grid, status)
            else
                if (.not. numerics%dx_is_given .and. n > 0) &
                    dx = fitting_side(dx, maxval(strips%half_length(:n)))
                if (.not. numerics%dy_is_given .and. n > 0) &
                    dy = fitting_side(dy, 0.5_wp*sum(strips%y_right(:n) - strips%y_left(:n)))
                call sample_strips(strips, times*dx, times*dy, numerics%max_elements, grid, status)
            end if
        end associate
    end subroutine sample_pressures

    subroutine solve_on_grid(workspace, grid, edges, case, with_field, tangential, field, status)
        type(tang_workspace_t), intent(inout) :: workspace
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: edges
        type(contact_case_t), intent(in) :: case
        logical, intent(in) :: with_field
        type(tangential_result_t), intent(out) :: tangential
        type(tangential_field_t), intent(inout) :: field
        type(status_t), intent(out) :: status

        type(tang_options_t) :: options
        integer :: elements

        call check_softness(case, status)
        if (is_error(status)) return
        options%edges = edges
        elements = count(grid%pressure > 0.0_wp)
        call set_detail('tang: ' // integer_text(elements) // ' elements in contact')
        if (with_field) then
            if (elements > size(field%x)) call reserve_field(field, elements, status)
            call tang_solve(workspace, grid, softened(case%material, case%friction), case%mu, &
                            case%creepage, options, tangential, status, field, case%friction)
        else
            call tang_solve(workspace, grid, softened(case%material, case%friction), case%mu, &
                            case%creepage, options, tangential, status, friction=case%friction)
        end if
    end subroutine solve_on_grid
end module faststrip_command_tang_stage
