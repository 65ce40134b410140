!> Kalker's variational method as the normal method of one contact: outside the embeddable core.
module faststrip_command_norm_stage
    use faststrip_base_status, only: status_t, is_error, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       release_norm, set_norm_curve, norm_solve_demand
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_normal_rows, only: rows_as_strips, count_rows
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_strip
    use faststrip_contact_solve, only: workspace_t, solve_contact_normal
    use faststrip_command_system, only: set_detail
    use faststrip_command_methods, only: numerics_t
    use faststrip_command_normal_stage, only: reserve_for_points
    implicit none
    private

    public :: norm_stage_t, reserve_norm_stage, release_norm_stage, solve_by_norm, take_rows

    ! Strips to start from where their number is left to the solver.
    integer, parameter :: start_strips = 15

    !> The method with its workspace.
    type :: norm_stage_t
        type(norm_workspace_t) :: workspace          !! with the grid of the last contact
        type(workspace_t), private :: start          ! strips to start from
    end type norm_stage_t

contains

    !> Grow the workspace to what a gap needs, outside the time that is measured.
    subroutine reserve_norm_stage(stage, points, status)
        type(norm_stage_t), intent(inout) :: stage !! sized
        integer, intent(in) :: points              !! of the gap
        type(status_t), intent(out) :: status      !! of `reserve_norm`

        call reserve_norm(stage%workspace, points, status)
    end subroutine reserve_norm_stage

    !> Give back what the compiler does not: plans of stages in an array.
    subroutine release_norm_stage(stage)
        type(norm_stage_t), intent(inout) :: stage !! serves again

        call release_norm(stage%workspace)
    end subroutine release_norm_stage

    !> Solve the normal problem, from a coarser grid or from strips; if these fail, from the
    !> coarser grid.
    subroutine solve_by_norm(stage, numerics, case, curve, normal, certificate, status, strips)
        type(norm_stage_t), intent(inout) :: stage   !! reserved for the gap
        type(numerics_t), intent(in) :: numerics     !! sides of the elements, what to start from
        type(contact_case_t), intent(in) :: case     !! material, load or penetration
        type(gap_curve_t), intent(in) :: curve       !! its gap
        type(normal_result_t), intent(out) :: normal !! figures
        type(certificate_t), intent(out) :: certificate !! residuals, and errors if estimated
        type(status_t), intent(out) :: status        !! of `norm_solve`
        type(contact_strips_t), intent(in), optional :: strips !! for the coarser grid to start from

        type(norm_options_t) :: options

        call set_norm_curve(stage%workspace, curve, status)
        if (is_error(status)) return
        options%dx = numerics%element_dx
        options%dy = numerics%element_dy
        options%fits_dx = .not. numerics%dx_is_given
        options%fits_dy = .not. numerics%dy_is_given
        options%error_target = numerics%error_target
        options%most_elements = numerics%max_elements
        if (present(strips)) then
            call norm_solve_demand(stage%workspace, normal_compliance(case%material), &
                                   case%demand_t, options, normal, status, strips, tell_of_grid)
        else
            if (numerics%norm_start == 'strips') then
                call solve_start(stage, case, curve)
                options%two_levels = stage%start%strips%n == 0
            else
                stage%start%strips%n = 0
            end if
            call norm_solve_demand(stage%workspace, normal_compliance(case%material), &
                                   case%demand_t, options, normal, status, stage%start%strips, &
                                   tell_of_grid)
        end if
        if (.not. is_error(status)) certificate = stage%workspace%certificate
    end subroutine solve_by_norm

    !> The strips to start from; none if they have no solution.
    subroutine solve_start(stage, case, curve)
        type(norm_stage_t), intent(inout) :: stage
        type(contact_case_t), intent(in) :: case
        type(gap_curve_t), intent(in) :: curve

        type(contact_case_t) :: strips
        type(normal_result_t) :: ignored
        type(status_t) :: status

        strips = case
        strips%estimate = .false.
        strips%methods%normal = normal_strip
        if (strips%methods%strips_per_patch == strips_auto) &
            strips%methods%strips_per_patch = start_strips
        call reserve_for_points(stage%start, strips, curve%n, status)
        if (.not. is_error(status)) &
            call solve_contact_normal(stage%start, strips, ignored, status, curve=curve)
        if (is_error(status)) stage%start%strips%n = 0
    end subroutine solve_start

    !> For who waits: which grid is being solved.
    subroutine tell_of_grid(grid)
        type(contact_grid_t), intent(in) :: grid

        call set_detail('norm: ' // integer_text(grid%nx) // ' by ' // integer_text(grid%ny) &
                  // ' elements of ' // trim(number_text(grid%dx)) // ' by ' &
                  // trim(number_text(grid%dy)) // ' mm')
    end subroutine tell_of_grid

    !> The rows of the grid as the strips of a contact, for the tangential methods and for who asks
    !> for strips.
    subroutine take_rows(stage, workspace, status)
        type(norm_stage_t), intent(in) :: stage       !! with a solution
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(status_t), intent(inout) :: status       !! changed by an error only

        type(status_t) :: rows
        integer :: n

        n = count_rows(stage%workspace%grid)
        rows = status_t()
        if (n > size(workspace%strips%p0)) &
            call reserve_strips(workspace%strips, n, rows)
        if (.not. is_error(rows)) &
            call rows_as_strips(stage%workspace%grid, workspace%strips, rows)
        if (is_error(rows)) status = rows
        workspace%solved_by = normal_strip
    end subroutine take_rows
end module faststrip_command_norm_stage
