!> TANG, the tangential problem by Kalker's variational method.
!>
!> Given pressures on a grid of rectangles, friction and creepages, tractions are sought that are
!> nowhere above mu times the pressure, oppose the slip where they reach it, and have no slip where
!> they do not (Kalker 1990): in steady rolling (T = 3) or in shifts (T = 1), each from what the one
!> before has left (`tangential_history`). How slip is discretised says `variational_problem`, how
!> the equations are solved `variational_newton`, where that starts `tangential_nested`.
!>
!> In steady rolling bodies store nothing: the friction power is what the forces do on the
!> creepages, and is taken from these. The sum of tractions on slips lacks more the less slides, for
!> the slip is then at the trailing edge, in less than an element: in the mean of 110 contacts 15 %
!> with 18 elements across, 9 % with 36. Between dissimilar materials tractions work on the slip by
!> pressures as well.
!>
!> Friction that falls with slip is found by repetition: a bound of each element's slip, tractions
!> under it, and so on, until the bound stays. The first slip is that of the static coefficient. The
!> half-space takes the slip as it is, other than FASTSIM (its F2), for its short waves are stiffer
!> than its long ones; where a fall is too steep the repetition does not end, and that is said.
!>
!> Needs FFTW, and is for program, tests and reports only (`faststrip_kalker_convolution`).
module faststrip_kalker_tangential
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps, smallest_size, equal_within
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument, st_no_convergence, st_not_finite
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, check_friction, falls, falling_share
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_tangential_motion, only: check_motion
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, empty_field, &
                                          add_element, state_adhesion, state_slip
    use faststrip_kalker_tangential_checks, only: check_bodies, check_grid
    use faststrip_kalker_tangential_history, only: tang_history_t, size_history, check_history, &
                                                   place_history
    use faststrip_kalker_tangential_nested, only: nested_t, choice_t, start_from_coarse, &
                                                  release_nested
    use faststrip_kalker_tangential_newton, only: newton_t, size_newton, solve_newton, &
                                                  free_steps
    use faststrip_kalker_tangential_problem, only: problem_t, make_problem, release_problem, &
                                                   scheme_second_order, scheme_first_order, &
                                                   edges_sampled, edges_of_norm, are_alike, &
                                                   converged, static_bound, find_bounds
    implicit none
    private

    public :: tang_options_t, tang_workspace_t, tang_solve, release_tang
    public :: take_tractions, are_alike, converged
    public :: tang_history_t, keep_history
    public :: scheme_second_order, scheme_first_order, edges_sampled, edges_of_norm
    public :: motion_rolling, motion_shift

    !> Steady rolling, or a shift: of bodies that were not displaced before, unless there is a
    !> history.
    !> Given: CONTACT's numbers.
    integer, parameter :: motion_rolling = 3, motion_shift = 1
    !> Most elements in contact unless the options say otherwise.
    !> Tuned [elements]. Origin: capacity.
    integer, parameter :: tang_most_elements = 300000

    ! r of `variational_newton` times the own compliance, tried one after the other.
    ! Tuned [1]. Origin: chosen for the number of Newton's steps.
    real(wp), parameter :: scalings(3) = [0.3_wp, 0.1_wp, 1.0_wp]

    !> What the user chooses.
    type :: tang_options_t
        integer :: motion = motion_rolling      !! `motion_rolling`, `motion_shift`
        integer :: scheme = scheme_second_order !! `scheme_second_order`, or `scheme_first_order`
                                                !! for CONTACT's numbers; rolling only
        integer :: edges = edges_sampled        !! `edges_sampled`: pressures are those at the
                                                !! middles; `edges_of_norm`: NORM's on this grid
        logical :: sticks_everywhere = .false.  !! friction without a bound, mu does not count
        ! Tuned [1]. Origin: far below the errors of any grid.
        real(wp) :: tolerance = 1.0e-7_wp       !! of the residual, between 0 and 1
        integer :: max_steps = most_steps       !! of Newton's method for each of three attempts
        logical :: warm_start = .false. !! from the last solution, if it had as many elements
        integer :: most_elements = tang_most_elements !! in contact
        type(creepage_t), allocatable :: own(:)
            !! on a curved surface, in rolling: what each row of the grid has of slip, at its
            !! middle, and of spin beside the creepage
    end type tang_options_t

    !> Everything a solution needs besides its input; owned by the caller, one per thread. Arrays
    !> grow with the grid, before the iteration.
    type :: tang_workspace_t
        integer :: elements = 0       !! in contact, of the last solution
        integer :: steps = 0          !! of Newton's method, on the grid itself
        integer :: products = 0       !! applications of the influence, on the grid itself
        integer :: iterations = 0     !! of GMRES in all Newton's steps, on the grid itself
        real(wp) :: residual = 0.0_wp !! of Coulomb's law over that without tractions
        integer :: passes = 0         !! solutions under a bound, more than one if friction falls
        type(problem_t), private :: problem
        type(newton_t), private :: newton
        type(nested_t), private :: nested
        real(wp), allocatable, private :: bound(:) ! of the tractions, MPa
        logical, private :: is_solved = .false.
    end type tang_workspace_t

contains

    !> Solve the tangential problem of a grid of pressures.
    !>
    !> Errors: `st_bad_argument` (options, a grid without elements or sides, negative pressures or
    !> mu; a history in rolling, or on another lattice), `st_not_finite`, `st_bad_material`,
    !> `st_no_contact`, `st_out_of_range` (more elements in contact than allowed; sizes beyond all
    !> proportion), `st_workspace_too_small` (the field, no memory), `st_no_convergence`.
    subroutine tang_solve(workspace, grid, material, mu, creepage, options, result, status, &
                          field, friction, history)
        type(tang_workspace_t), intent(inout) :: workspace !! needs no preparation
        type(contact_grid_t), intent(in) :: grid        !! pressures in MPa; heights do not count
        type(material_t), intent(in) :: material        !! moduli in MPa
        real(wp), intent(in) :: mu                      !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage        !! about the reference point; for a shift
                                                        !! the displacement in mm, its turn in rad
        type(tang_options_t), intent(in) :: options     !! scheme, tolerance, ...
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error; for a
                                                        !! shift the friction work, N mm
        type(status_t), intent(out) :: status           !! how it ended
        type(tangential_field_t), intent(inout), optional :: field
            !! filled when present; needs capacity for the elements in contact
        type(friction_t), intent(in), optional :: friction
            !! how mu falls with slip, in rolling, and a table over y in place of mu, which is then
            !! its mean; other parts do not count here
        type(tang_history_t), intent(in), optional :: history
            !! of a shift: the step before, of the same materials; creepage and friction work are
            !! those since then

        type(friction_t) :: law

        workspace%elements = 0
        workspace%steps = 0
        workspace%products = 0
        workspace%iterations = 0
        workspace%residual = 0.0_wp
        workspace%passes = 0
        if (present(friction)) law = friction
        call check_motion(mu, creepage, status)
        if (.not. is_error(status)) call check_friction(law, status)
        if (.not. is_error(status)) call check_options(options, status)
        if (.not. is_error(status) .and. falls(law) .and. options%motion /= motion_rolling) &
            call set_status(status, st_bad_argument, 'friction that falls with slip is for ' // &
                            'rolling, not for a shift')
        if (.not. is_error(status)) call check_bodies(material, status)
        if (.not. is_error(status)) call check_grid(grid, status)
        if (.not. is_error(status) .and. present(history)) then
            call check_history(history, grid, status)
            if (.not. is_error(status) .and. options%motion /= motion_shift) &
                call set_status(status, st_bad_argument, 'a step before is for a shift, not for ' &
                                // 'steady rolling')
        end if
        if (is_error(status)) return
        call make_problem(workspace%problem, grid, material, creepage, &
                          options%motion == motion_rolling, options%scheme, options%edges, &
                          options%most_elements, status, history, options%own)
        if (is_error(status)) return
        if (present(field)) then
            call empty_field(field, workspace%problem%n, status)
            if (is_error(status)) return
        end if
        workspace%elements = workspace%problem%n
        if (workspace%is_solved .and. options%warm_start) then
            workspace%is_solved = size(workspace%newton%p, 2) == workspace%problem%n
        else
            workspace%is_solved = .false.
        end if
        call size_newton(workspace%newton, workspace%problem)
        workspace%newton%products = 0
        workspace%newton%iterations = 0
        if (mu*maxval(workspace%problem%pn(:workspace%problem%n)) <= smallest_size &
            .and. .not. options%sticks_everywhere) then
            call slide_freely(workspace%newton, workspace%problem)
            workspace%is_solved = .false.
        else
            if (present(history) .and. .not. workspace%is_solved) &
                call start_from_history(workspace, grid, history)
            if (.not. (workspace%is_solved .or. options%sticks_everywhere)) &
                call start_from_coarse(workspace%nested, workspace%newton, workspace%problem, &
                                       grid, material, creepage, mu, law%table, &
                                       choice_t(options%motion == motion_rolling, options%scheme, &
                                                options%edges, scalings(1), options%max_steps), &
                                       workspace%is_solved)
            call find_tractions(workspace, mu, law, options, status)
            if (is_error(status)) return
        end if
        call add_up(workspace%newton, workspace%problem, result, field)
        if (options%motion == motion_rolling) result%friction_power = &
            max(-(result%fx*creepage%cksi + result%fy*creepage%ceta + result%mz*creepage%cphi) &
                - power_on_pressed(workspace%newton, workspace%problem) &
                - power_on_own(workspace%newton, workspace%problem, grid, options%own), 0.0_wp)
    end subroutine tang_solve

    !> Tractions under a bound that may fall with their slip.
    subroutine find_tractions(workspace, mu, friction, options, status)
        type(tang_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: mu
        type(friction_t), intent(in) :: friction
        type(tang_options_t), intent(in) :: options
        type(status_t), intent(inout) :: status

        real(wp) :: change

        associate (problem => workspace%problem, n => workspace%problem%n)
            if (allocated(workspace%bound)) then
                if (size(workspace%bound) < n) deallocate (workspace%bound)
            end if
            if (.not. allocated(workspace%bound)) allocate (workspace%bound(n), source=0.0_wp)
            call find_bounds(problem, mu, friction%table, workspace%bound)
        end associate
        do
            workspace%passes = workspace%passes + 1
            call find_tractions_under(workspace, options, status)
            if (is_error(status) .or. .not. falls(friction) .or. options%sticks_everywhere) return
            call follow_slip(workspace, mu, friction, change)
            if (change <= converged) return
            if (workspace%passes >= most_steps) then
                workspace%is_solved = .false.
                call set_status(status, st_no_convergence, 'friction falls so steeply with ' // &
                                'slip that none was found that stays: the bound changes by ' // &
                                number_text(change))
                return
            end if
        end do
    end subroutine find_tractions

    !> Tractions under a bound.
    subroutine find_tractions_under(workspace, options, status)
        type(tang_workspace_t), intent(inout) :: workspace
        type(tang_options_t), intent(in) :: options
        type(status_t), intent(inout) :: status

        integer :: attempt

        do attempt = 1, size(scalings)
            if (.not. workspace%is_solved) workspace%newton%p = 0.0_wp
            workspace%is_solved = .false.
            call solve_newton(workspace%newton, workspace%problem, workspace%bound, &
                              options%sticks_everywhere, scalings(attempt), &
                              options%tolerance, options%max_steps)
            workspace%steps = workspace%steps + workspace%newton%steps
            if (workspace%newton%is_converged) exit
        end do
        workspace%residual = workspace%newton%residual
        workspace%products = workspace%newton%products
        workspace%iterations = workspace%newton%iterations
        if (.not. workspace%newton%is_converged) then
            call set_status(status, st_no_convergence, 'the tractions did not converge: ' // &
                            'residual '//number_text(workspace%residual))
            return
        end if
        workspace%is_solved = .true.
    end subroutine find_tractions_under

    !> The bound of the slip that was found; the next pass has a part of it.
    subroutine follow_slip(workspace, mu, friction, change)
        type(tang_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: mu
        type(friction_t), intent(in) :: friction
        real(wp), intent(out) :: change ! over all bounds

        real(wp) :: difference, part, squares
        integer :: i

        part = merge(1.0_wp, 0.5_wp, workspace%passes <= free_steps)
        change = 0.0_wp
        squares = 0.0_wp
        do i = 1, workspace%problem%n
            difference = static_bound(workspace%problem, i, mu, friction%table) &
                         *falling_share(friction, norm2(workspace%newton%slip(:, i))) &
                         - workspace%bound(i)
            change = change + difference**2
            squares = squares + workspace%bound(i)**2
            workspace%bound(i) = workspace%bound(i) + part*difference
        end do
        change = sqrt(change/squares)
    end subroutine follow_slip

    !> The tractions of a solution on its grid.
    pure subroutine take_tractions(workspace, grid, px, py)
        type(tang_workspace_t), intent(in) :: workspace !! with a solution
        type(contact_grid_t), intent(in) :: grid        !! the places of its elements
        real(wp), intent(out) :: px(:, :), py(:, :)     !! MPa, as many as the grid's elements

        integer :: i, k(2)

        px = 0.0_wp
        py = 0.0_wp
        do i = 1, workspace%problem%n
            k = element_of(workspace%problem, grid, i)
            px(k(1), k(2)) = workspace%newton%p(1, i)
            py(k(1), k(2)) = workspace%newton%p(2, i)
        end do
    end subroutine take_tractions

    !> Keep pressures and tractions of a solution for the next step.
    subroutine keep_history(workspace, grid, history)
        type(tang_workspace_t), intent(in) :: workspace !! with a solution
        type(contact_grid_t), intent(in) :: grid        !! the places of its elements
        type(tang_history_t), intent(inout) :: history  !! needs no preparation

        integer :: i, k(2)

        call size_history(history, grid)
        call take_tractions(workspace, grid, history%px, history%py)
        do i = 1, workspace%problem%n
            k = element_of(workspace%problem, grid, i)
            history%pressure(k(1), k(2)) = workspace%problem%pn(i)
        end do
    end subroutine keep_history

    !> Start at the tractions of the step before.
    pure subroutine start_from_history(workspace, grid, history)
        type(tang_workspace_t), intent(inout) :: workspace
        type(contact_grid_t), intent(in) :: grid
        type(tang_history_t), intent(in) :: history

        integer :: i, k(2)

        if (.not. allocated(history%px)) return
        do i = 1, workspace%problem%n
            k = element_of(workspace%problem, grid, i) - place_history(history, grid)
            workspace%newton%p(:, i) = 0.0_wp
            if (any(k < 1) .or. any(k > [history%nx, history%ny])) cycle
            workspace%newton%p(:, i) = [history%px(k(1), k(2)), history%py(k(1), k(2))]
        end do
        workspace%is_solved = .true.
    end subroutine start_from_history

    !> Column and row of an element of the problem.
    pure function element_of(problem, grid, i) result(k)
        type(problem_t), intent(in) :: problem
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: i
        integer :: k(2)

        k = 1 + nint([(problem%x(i) - grid%x_first)/grid%dx, &
                      (problem%y(i) - grid%y_first)/grid%dy])
    end function element_of

    !> Give back what the compiler does not: plans of workspaces in an array.
    subroutine release_tang(workspace)
        type(tang_workspace_t), intent(inout) :: workspace !! serves again

        call release_problem(workspace%problem)
        call release_nested(workspace%nested)
    end subroutine release_tang

    subroutine check_options(options, status)
        type(tang_options_t), intent(in) :: options
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (options%motion /= motion_rolling .and. options%motion /= motion_shift) then
            call set_status(status, st_bad_argument, 'no such motion of TANG')
        else if (options%scheme /= scheme_second_order .and. &
                 options%scheme /= scheme_first_order) then
            call set_status(status, st_bad_argument, 'no such scheme of TANG')
        else if (options%edges /= edges_sampled .and. options%edges /= edges_of_norm) then
            call set_status(status, st_bad_argument, 'no such kind of pressures')
        else if (.not. ieee_is_finite(options%tolerance)) then
            call set_status(status, st_not_finite, 'the tolerance must be a finite number, ' &
                            // 'got ' // number_text(options%tolerance))
        else if (options%tolerance < equal_within .or. options%tolerance >= 1.0_wp) then
            call set_status(status, st_bad_argument, 'the tolerance must be at least ' // &
                            '1e-12 and below 1, got ' // number_text(options%tolerance))
        else if (options%max_steps < 1 .or. options%most_elements < 1) then
            call set_status(status, st_bad_argument, 'no steps or no elements are allowed')
        end if
    end subroutine check_options

    !> Without friction all elements slide, those without rigid slip stick.
    pure subroutine slide_freely(newton, problem)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(in) :: problem

        integer :: i

        newton%p = 0.0_wp
        newton%steps = 0
        do i = 1, problem%n
            newton%slip(:, i) = problem%rigid(:, i)
            newton%sticks(i) = all(problem%rigid(:, i) == 0.0_wp)
        end do
    end subroutine slide_freely

    !> What tractions do on the slip by pressures of dissimilar materials: the mean of the nodes
    !> about an element.
    pure real(wp) function power_on_pressed(newton, problem) result(power)
        type(newton_t), intent(in) :: newton
        type(problem_t), intent(in) :: problem

        real(wp) :: slip(2)
        integer :: i

        power = 0.0_wp
        do i = 1, problem%n
            slip = problem%pressed(:, i)
            if (i < problem%n) then
                if (.not. problem%is_leading(i + 1)) &
                    slip = 0.5_wp*(slip + problem%pressed(:, i + 1))
            end if
            power = power + problem%dx*problem%dy*dot_product(newton%p(:, i), slip)
        end do
    end function power_on_pressed

    !> What tractions do on the slip that rows have of their own.
    pure real(wp) function power_on_own(newton, problem, grid, own) result(power)
        type(newton_t), intent(in) :: newton
        type(problem_t), intent(in) :: problem
        type(contact_grid_t), intent(in) :: grid
        type(creepage_t), intent(in), optional :: own(:)

        integer :: i, k(2)

        power = 0.0_wp
        if (.not. present(own)) return
        do i = 1, problem%n
            k = element_of(problem, grid, i)
            associate (row => own(k(2)), p => newton%p(:, i))
                power = power + problem%dx*problem%dy &
                                *(p(1)*row%cksi + p(2)*(row%ceta + problem%x(i)*row%cphi))
            end associate
        end do
    end function power_on_own

    !> Sums, and the field.
    pure subroutine add_up(newton, problem, result, field)
        type(newton_t), intent(in) :: newton
        type(problem_t), intent(in) :: problem
        type(tangential_result_t), intent(inout) :: result
        type(tangential_field_t), intent(inout), optional :: field

        integer :: i, stuck
        real(wp) :: cell

        cell = problem%dx*problem%dy
        stuck = 0
        do i = 1, problem%n
            associate (p => newton%p(:, i), s => newton%slip(:, i), x => problem%x(i), &
                       y => problem%y(i))
                result%fx = result%fx + cell*p(1)
                result%fy = result%fy + cell*p(2)
                result%mz = result%mz + cell*(x*p(2) - y*p(1))
                result%friction_power = result%friction_power - cell*(p(1)*s(1) + p(2)*s(2))
                if (newton%sticks(i)) stuck = stuck + 1
                if (present(field)) call add_element(field, x, y, [problem%dx, cell], &
                    problem%pn(i), p(1), p(2), s(1), s(2), &
                    merge(state_adhesion, state_slip, newton%sticks(i)))
            end associate
        end do
        result%stick_fraction = real(stuck, wp)/problem%n
    end subroutine add_up
end module faststrip_kalker_tangential
