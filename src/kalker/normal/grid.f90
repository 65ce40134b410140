!> The normal problem on one grid of rectangles: task, plans and kernels, minimisation, figures.
module faststrip_kalker_normal_grid
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: most_halvings, too_large
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_no_convergence, st_out_of_range
    use faststrip_influence_rectangle, only: rectangle_potential
    use faststrip_kalker_convolution, only: convolution_t, reserve_convolution, &
                                            release_convolution, set_kernel, set_inverse_kernel, &
                                            even
    use faststrip_kalker_grid, only: contact_grid_t, element_x, element_y, count_patches
    use faststrip_kalker_normal_options, only: norm_options_t
    use faststrip_kalker_normal_solver, only: minimiser_t, size_minimiser, task_t, minimise, &
                                              minimised_t, kernel_influence, kernel_inverse
    use faststrip_normal_types, only: normal_result_t, demand_t
    implicit none
    private

    public :: grid_solver_t, release_grid_solver
    public :: set_task, solve_on_grid, guess_on_heights, take_figures

    !> Plans and kernels of one grid.
    type :: kernels_t
        type(convolution_t) :: convolution
        real(wp) :: aspect = 0.0_wp ! dy/dx of the elements
    end type kernels_t

    !> What the minimisation on a grid needs, and what it cost.
    type :: grid_solver_t
        integer :: convolutions = 0 !! since they were set to zero
        integer :: plans = 0        !! how often plans and kernels were made
        type(minimiser_t) :: minimiser
        ! Two, so that two levels keep theirs from one solution to the next.
        type(kernels_t) :: kernels, other_kernels
        integer, allocatable :: stack(:) !! to count patches with
    end type grid_solver_t

contains

    !> Give plans and kernels back.
    subroutine release_grid_solver(solver)
        type(grid_solver_t), intent(inout) :: solver !! serves again

        call release_convolution(solver%kernels%convolution)
        call release_convolution(solver%other_kernels%convolution)
    end subroutine release_grid_solver

    !> Load or approach in the minimiser's lengths.
    pure subroutine set_task(demand, h_lowest, compliance, dy, options, task, status)
        type(demand_t), intent(in) :: demand        !! load or penetration
        real(wp), intent(in) :: h_lowest !! from which the demand's penetration counts, mm
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: dy                  !! side of the elements, mm
        type(norm_options_t), intent(in) :: options !! tolerance, iterations
        type(task_t), intent(out) :: task           !! the same as lengths
        type(status_t), intent(out) :: status       !! `st_out_of_range`

        call clear_status(status)
        task%demand_t = demand
        task%tolerance = options%tolerance
        task%max_iterations = options%max_iterations
        task%preconditioned = options%preconditioned
        if (demand%by_load) then
            ! Logarithms, as the product may overflow.
            if (abs(log(demand%load) + log(compliance) - log(dy)) > log(too_large)) then
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
    subroutine solve_on_grid(solver, grid, which, compliance, task, found, result, status)
        type(grid_solver_t), intent(inout) :: solver
        type(contact_grid_t), intent(inout) :: grid    !! with pressures to start from; solved
        integer, intent(in) :: which                   !! of the two sets of kernels
        real(wp), intent(in) :: compliance             !! H of eq. (4), 1/MPa
        type(task_t), intent(in) :: task               !! load or approach
        type(minimised_t), intent(out) :: found        !! how it went
        type(normal_result_t), intent(inout) :: result !! passes and iterations are counted up
        type(status_t), intent(out) :: status          !! no memory, `st_no_convergence`

        call size_minimiser(solver%minimiser, grid%nx, grid%ny)
        solver%minimiser%s = grid%pressure
        if (which == 1) then
            call minimise_on(solver%kernels)
        else
            call minimise_on(solver%other_kernels)
        end if
        if (is_error(status)) return
        grid%pressure = solver%minimiser%s/(compliance*grid%dx)
        result%passes = result%passes + 1
        result%iterations = result%iterations + found%iterations
        solver%convolutions = solver%convolutions + found%convolutions
        if (found%converged) return
        if (ieee_is_finite(found%residual)) then
            call set_status(status, st_no_convergence, 'the pressures did not converge: the gap ' &
                            //'in contact is '//trim(number_text(found%residual)) &
                            //' of the approach')
        else
            call set_status(status, st_no_convergence, 'the pressures did not converge: load, ' &
                            //'compliance and elements are of sizes that do not go together')
        end if

    contains

        subroutine minimise_on(kernels)
            type(kernels_t), intent(inout) :: kernels

            call prepare_kernels(grid, kernels, solver%plans, status)
            if (is_error(status)) return
            call minimise(kernels%convolution, grid%height, task, solver%minimiser, found)
        end subroutine minimise_on
    end subroutine solve_on_grid

    !> Influence coefficients of the grid and their inverse, unless they are there.
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
        type(demand_t), intent(in) :: demand        !! load, or penetration from zero height
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(contact_grid_t), intent(inout) :: grid !! with its heights

        ! Share of the penetration at which heights overlap.
        ! Given: Kik and Piotrowski 1996.
        real(wp), parameter :: share = 0.55_wp
        real(wp) :: lowest, low, high, depth, radius
        integer :: i

        lowest = minval(grid%height)
        if (demand%by_load) then
            low = 0.0_wp
            ! As if one element carried it all.
            ! Given: a punch of that area.
            high = 0.75_wp*pi*compliance*(demand%load/sqrt(grid%dx*grid%dy/pi))
            do i = 1, most_halvings
                depth = 0.5_wp*(low + high)
                radius = sqrt(max(1, count(grid%height - lowest < share*depth)) &
                              *(grid%dx*grid%dy/pi))
                ! Given: a punch of that area.
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
    subroutine take_figures(solver, grid, compliance, found, result)
        type(grid_solver_t), intent(inout) :: solver   !! that solved on the grid
        type(contact_grid_t), intent(in) :: grid       !! with its pressures
        real(wp), intent(in) :: compliance             !! H of eq. (4), 1/MPa
        type(minimised_t), intent(in) :: found         !! how it went
        type(normal_result_t), intent(inout) :: result !! gets them

        integer :: i, j, first, last

        associate (p => grid%pressure)
            result%load = sum(solver%minimiser%s)*grid%dy/compliance
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
            if (allocated(solver%stack)) then
                if (size(solver%stack) < 2*size(p)) deallocate (solver%stack)
            end if
            if (.not. allocated(solver%stack)) allocate (solver%stack(2*size(p)))
            call count_patches(p, solver%stack, result%n_patches)
        end associate
    end subroutine take_figures
end module faststrip_kalker_normal_grid
