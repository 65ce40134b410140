!> Normal and tangential problem of dissimilar materials, both ways: pressures move points along the
!> surface, tractions move them across it.
!>
!> NORM and TANG in turn (Panagiotopoulos' iteration, as CONTACT has it): tractions for the
!> pressures, with what these do as rigid slip; pressures for the gap, with what the tractions do as
!> heights; until the pressures stay. Each turn leaves about K mu of a change, K of
!> `faststrip_influence_rectangle`: a rigid body on rubber takes eight.
module faststrip_kalker_dissimilar
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, set_status, is_error, number_text, &
                                     st_no_convergence
    use faststrip_base_material, only: material_t, normal_compliance, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t
    use faststrip_influence_rectangle, only: rectangle_influence_t, rectangle_influence, &
                                             coupling_constant
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t
    use faststrip_kalker_convolution, only: convolution_t, reserve_convolution, &
                                            release_convolution, set_kernel, transform_source, &
                                            collect, even, odd
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_normal, only: norm_workspace_t, norm_options_t, norm_solve_heights, &
                                       release_norm
    use faststrip_kalker_tangential, only: tang_workspace_t, tang_options_t, tang_solve, &
                                           release_tang, take_tractions, tang_history_t, converged
    implicit none
    private

    public :: dissimilar_problem_t, dissimilar_workspace_t, solve_dissimilar, release_dissimilar

    ! Given: numbers of kinds.
    integer, parameter :: kernel_zx = 1, kernel_zy = 2

    !> What is to be solved on a grid.
    type :: dissimilar_problem_t
        type(material_t) :: material     !! moduli in MPa
        type(demand_t) :: demand         !! load, or penetration from zero height
        real(wp) :: mu = 0.0_wp          !! coefficient of friction
        type(creepage_t) :: creepage     !! as of `tang_solve`
        type(friction_t) :: friction     !! as of `tang_solve`
        type(tang_options_t) :: options  !! as of `tang_solve`
    end type dissimilar_problem_t

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: dissimilar_workspace_t
        integer :: turns = 0             !! of the last solution
        type(norm_workspace_t) :: norm   !! with the grid of pressures that stay
        type(tang_workspace_t) :: tang   !! with their tractions
        type(convolution_t), private :: convolution
        real(wp), allocatable, private :: px(:, :), py(:, :), height(:, :)
        real(wp), private :: made_for(5) = 0.0_wp ! the kernels
    end type dissimilar_workspace_t

contains

    !> Give back what the compiler does not: plans of workspaces in an array.
    subroutine release_dissimilar(workspace)
        type(dissimilar_workspace_t), intent(inout) :: workspace !! serves again

        call release_norm(workspace%norm)
        call release_tang(workspace%tang)
        call release_convolution(workspace%convolution)
        workspace%made_for = 0.0_wp
    end subroutine release_dissimilar

    !> Solve both problems on NORM's grid, from its solution.
    !>
    !> Errors: those of `tang_solve` and `norm_solve_heights`; `st_out_of_range` also where
    !> tractions widen the contact to the rim of the grid; `st_no_convergence`: the pressures do
    !> not stay.
    subroutine solve_dissimilar(workspace, grid, problem, normal, tangential, status, field, &
                                history)
        type(dissimilar_workspace_t), intent(inout) :: workspace !! needs no preparation
        type(contact_grid_t), intent(in) :: grid             !! heights, and NORM's pressures
        type(dissimilar_problem_t), intent(in) :: problem        !! materials, friction, ...
        type(normal_result_t), intent(out) :: normal         !! penetration, area, ...
        type(tangential_result_t), intent(out) :: tangential !! forces
        type(status_t), intent(out) :: status                !! how it ended
        type(tangential_field_t), intent(inout), optional :: field !! as of `tang_solve`
        type(tang_history_t), intent(in), optional :: history      !! as of `tang_solve`

        type(norm_options_t) :: options
        type(tang_options_t) :: tang_options
        real(wp) :: change

        options%warm_start = .true.
        tang_options = problem%options
        workspace%norm%grid = grid
        workspace%height = grid%height
        change = huge(change)
        workspace%turns = 0
        do
            call tang_solve(workspace%tang, workspace%norm%grid, problem%material, problem%mu, &
                            problem%creepage, tang_options, tangential, status, field, &
                            problem%friction, history)
            if (is_error(status) .or. change <= converged) return
            if (workspace%turns >= most_steps) then
                call set_status(status, st_no_convergence, 'pressures and tractions of ' // &
                                'dissimilar materials do not converge: the pressures change ' &
                                // 'by ' // number_text(change))
                return
            end if
            workspace%turns = workspace%turns + 1
            ! The tractions of the last turn are nearer than those of the step before.
            if (present(history)) tang_options%warm_start = .true.
            call lift(workspace, grid, problem%material, status)
            if (is_error(status)) return
            workspace%px = workspace%norm%grid%pressure
            call norm_solve_heights(workspace%norm, workspace%height, grid%dx, grid%dy, &
                                    grid%x_first, grid%y_first, &
                                    normal_compliance(problem%material), problem%demand, options, &
                                    normal, status)
            if (is_error(status)) return
            change = norm2(workspace%norm%grid%pressure - workspace%px)/norm2(workspace%px)
        end do
    end subroutine solve_dissimilar

    !> Heights of the gap with what the tractions do.
    subroutine lift(workspace, grid, material, status)
        type(dissimilar_workspace_t), intent(inout) :: workspace
        type(contact_grid_t), intent(in) :: grid
        type(material_t), intent(in) :: material
        type(status_t), intent(out) :: status

        call make_kernels(workspace, grid, material, status)
        if (is_error(status)) return
        if (allocated(workspace%px)) then
            if (any(shape(workspace%px) /= [grid%nx, grid%ny])) deallocate (workspace%px)
        end if
        if (.not. allocated(workspace%px)) &
            allocate (workspace%px(grid%nx, grid%ny), source=0.0_wp)
        workspace%py = workspace%px
        call take_tractions(workspace%tang, grid, workspace%px, workspace%py)
        call transform_source(workspace%convolution, 1, workspace%px)
        call transform_source(workspace%convolution, 2, workspace%py)
        call collect(workspace%convolution, [kernel_zx, kernel_zy], [1, 2], [1.0_wp, 1.0_wp], &
                     workspace%height)
        workspace%height = workspace%height + grid%height
    end subroutine lift

    !> What tractions do to heights, unless it is there already.
    subroutine make_kernels(workspace, grid, material, status)
        type(dissimilar_workspace_t), intent(inout) :: workspace
        type(contact_grid_t), intent(in) :: grid
        type(material_t), intent(in) :: material
        type(status_t), intent(out) :: status

        real(wp), allocatable :: kernels(:, :, :)
        type(rectangle_influence_t) :: influence
        real(wp) :: wanted(5)
        integer :: i, j, before(2)

        before = [workspace%convolution%nx, workspace%convolution%ny]
        call reserve_convolution(workspace%convolution, grid%nx, grid%ny, 2, 2, status)
        if (is_error(status)) return
        wanted = [grid%dx, grid%dy, combined_shear_modulus(material), &
                  combined_poisson_ratio(material), coupling_constant(material)]
        if (all(workspace%made_for == wanted) .and. all(before == [grid%nx, grid%ny])) return
        allocate (kernels(0:grid%nx, 0:grid%ny, kernel_zy))
        do j = 0, grid%ny
            do i = 0, grid%nx
                call rectangle_influence(i*grid%dx, j*grid%dy, grid%dx, grid%dy, material, &
                                         influence)
                kernels(i, j, kernel_zx) = influence%zx
                kernels(i, j, kernel_zy) = influence%zy
            end do
        end do
        call set_kernel(workspace%convolution, kernel_zx, kernels(:, :, kernel_zx), odd, even, &
                        status)
        call set_kernel(workspace%convolution, kernel_zy, kernels(:, :, kernel_zy), even, odd, &
                        status)
        workspace%made_for = wanted
    end subroutine make_kernels
end module faststrip_kalker_dissimilar
