!> Kalker's variational method as the normal method of one contact: outside the embeddable core.
module faststrip_command_norm_stage
    use faststrip_base_status, only: status_t, is_error, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_strips, only: reserve_strips
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       release_norm, set_norm_gap, norm_solve_demand
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_normal_rows, only: rows_as_strips, count_rows
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_methods, only: normal_strip
    use faststrip_command_system, only: set_detail
    use faststrip_command_methods, only: methods_t
    use faststrip_command_normal_stage, only: normal_stage_t, demand_t, make_normal_stage, &
                                              make_room, solve_normal
    implicit none
    private

    public :: norm_stage_t, make_norm_room, release_norm_stage, solve_by_norm, take_rows

    ! Strips to start from where their number is left to the solver.
    integer, parameter :: start_strips = 15

    !> The method with the room it needs.
    type :: norm_stage_t
        type(norm_workspace_t) :: workspace          !! with the grid of the last contact
        type(normal_stage_t), private :: start       ! strips to start from
    end type norm_stage_t

contains

    !> Grow the workspace to what a gap needs, outside the time that is measured.
    subroutine make_norm_room(stage, gap, status)
        type(norm_stage_t), intent(inout) :: stage !! sized
        type(gap_t), intent(in) :: gap             !! undeformed gap, mm, checked
        type(status_t), intent(out) :: status      !! of `reserve_norm`

        call reserve_norm(stage%workspace, size(gap%y), status)
    end subroutine make_norm_room

    !> Give back what the compiler does not: plans of stages in an array.
    subroutine release_norm_stage(stage)
        type(norm_stage_t), intent(inout) :: stage !! serves again

        call release_norm(stage%workspace)
    end subroutine release_norm_stage

    !> Solve the normal problem, from a coarser grid or from strips; if these fail, from the
    !> coarser grid.
    subroutine solve_by_norm(stage, methods, gap, material, demand, normal, certificate, status)
        type(norm_stage_t), intent(inout) :: stage  !! with room for the gap
        type(methods_t), intent(in) :: methods      !! sides of the elements, what to start from
        type(gap_t), intent(in) :: gap              !! undeformed gap, mm
        type(material_t), intent(in) :: material    !! moduli, MPa
        type(demand_t), intent(in) :: demand        !! load or penetration
        type(normal_result_t), intent(out) :: normal !! figures
        type(certificate_t), intent(out) :: certificate !! residuals, and errors if estimated
        type(status_t), intent(out) :: status       !! of `norm_solve`

        type(norm_options_t) :: options

        call set_norm_gap(stage%workspace, gap, status)
        if (is_error(status)) return
        options%dx = methods%element_dx
        options%dy = methods%element_dy
        options%error_target = methods%error_target
        options%most_elements = methods%max_elements
        if (methods%norm_start == 'strips') then
            call solve_start(stage, methods, gap, material, demand)
        else
            stage%start%workspace%strips%n = 0
        end if
        if (methods%norm_start == 'strips') &
            options%two_levels = stage%start%workspace%strips%n == 0
        call norm_solve_demand(stage%workspace, normal_compliance(material), demand, options, &
                               normal, status, stage%start%workspace%strips, tell_of_grid)
        if (.not. is_error(status)) certificate = stage%workspace%certificate
    end subroutine solve_by_norm

    !> The strips to start from; none if they have no solution.
    subroutine solve_start(stage, methods, gap, material, demand)
        type(norm_stage_t), intent(inout) :: stage
        type(methods_t), intent(in) :: methods
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        type(demand_t), intent(in) :: demand

        type(methods_t) :: strips
        type(normal_result_t) :: ignored
        type(status_t) :: status

        strips = methods
        strips%normal = 'strip'
        if (strips%strips_per_patch == strips_auto) strips%strips_per_patch = start_strips
        call make_normal_stage(strips, stage%start)
        call make_room(stage%start, gap, status)
        if (.not. is_error(status)) &
            call solve_normal(stage%start, gap, material, demand, ignored, status)
        if (is_error(status)) stage%start%workspace%strips%n = 0
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
    subroutine take_rows(stage, normal, status)
        type(norm_stage_t), intent(in) :: stage       !! with a solution
        type(normal_stage_t), intent(inout) :: normal !! its strips are filled
        type(status_t), intent(inout) :: status       !! changed by an error only

        type(status_t) :: rows
        integer :: n

        n = count_rows(stage%workspace%grid)
        rows = status_t()
        if (n > size(normal%workspace%strips%p0)) &
            call reserve_strips(normal%workspace%strips, n, rows)
        if (.not. is_error(rows)) &
            call rows_as_strips(stage%workspace%grid, normal%workspace%strips, rows)
        if (is_error(rows)) status = rows
        normal%workspace%solved_by = normal_strip
    end subroutine take_rows
end module faststrip_command_norm_stage
