!> Kalker's variational method as the tangential method of one contact: outside the embeddable core.
module faststrip_command_tang_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, edges_of_norm, edges_sampled
    use faststrip_kalker_tangential_pressures, only: sample_strips, sample_ellipse
    use faststrip_command_system, only: set_detail
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_norm, normal_hertz
    use faststrip_contact_solve, only: workspace_t
    use faststrip_command_methods, only: numerics_t
    use faststrip_command_norm_stage, only: norm_stage_t
    implicit none
    private

    public :: tang_stage_t, release_tang_stage, solve_by_tang


    !> The method with its workspace.
    type :: tang_stage_t
        type(tang_workspace_t), private :: workspace
        type(contact_grid_t), private :: grid ! pressures, unless they are NORM's
    end type tang_stage_t

contains

    !> Give back what the compiler does not: plans of stages in an array.
    subroutine release_tang_stage(stage)
        type(tang_stage_t), intent(inout) :: stage !! serves again

        call release_tang(stage%workspace)
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
            call solve_on_grid(stage, norm%workspace%grid, edges_of_norm, case, with_field, &
                               tangential, field, status)
            return
        else if (numerics%normal == normal_hertz) then
            associate (hertz => workspace%hertz)
                call sample_ellipse(hertz%a, hertz%b, hertz%y, hertz%load, numerics%element_dx, &
                                    numerics%element_dy, numerics%max_elements, stage%grid, status)
            end associate
        else
            call sample_strips(workspace%strips, numerics%element_dx, numerics%element_dy, &
                               numerics%max_elements, stage%grid, status)
        end if
        if (is_error(status)) return
        call solve_on_grid(stage, stage%grid, edges_sampled, case, with_field, tangential, &
                           field, status)
    end subroutine solve_by_tang

    subroutine solve_on_grid(stage, grid, edges, case, with_field, tangential, field, status)
        type(tang_stage_t), intent(inout) :: stage
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: edges
        type(contact_case_t), intent(in) :: case
        logical, intent(in) :: with_field
        type(tangential_result_t), intent(out) :: tangential
        type(tangential_field_t), intent(inout) :: field
        type(status_t), intent(out) :: status

        type(tang_options_t) :: options
        integer :: elements

        options%edges = edges
        elements = count(grid%pressure > 0.0_wp)
        call set_detail('tang: ' // integer_text(elements) // ' elements in contact')
        if (with_field) then
            if (elements > size(field%x)) call reserve_field(field, elements, status)
            call tang_solve(stage%workspace, grid, case%material, case%mu, &
                            case%creepage, options, tangential, status, field)
        else
            call tang_solve(stage%workspace, grid, case%material, case%mu, &
                            case%creepage, options, tangential, status)
        end if
    end subroutine solve_on_grid
end module faststrip_command_tang_stage
