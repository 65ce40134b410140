!> The discretised tangential problem of TANG: elements, influence, slip.
!>
!> Tractions are constant on the elements in contact, displacement differences u (rail less wheel)
!> follow by FFT. Elements stand row by row, in each row against x: the leading one first.
!>
!> **Rolling.** Slip over rolling speed is `s = w - du/dx`, w rigid. Between the middles of an
!> element and of the one ahead of it stands a node, and `[u(x) - u(x + dx)]/dx` is the mean of
!> -du/dx between the two: second order at the node, first order at the element.
!>
!> - **K1** *Sliding.* The traction opposes the slip of its element. The slip at the node is
!>   extrapolated to the middle with that of the node ahead, `1.5 s(node) - 0.5 s(node ahead)`,
!>   where both elements slide. In adhesion both vanish and the node's slip serves.
!> - **K2** *Leading edge.* Where nothing slides ahead, the traction is like the root of the
!>   distance from the edge. A lattice of tractions, and nodes half a step ahead of them, has this
!>   root begin `edge_position` = 0.826 dx ahead of the first middle, wherever the true edge is
!>   (the end of a plane problem's solution, fitted far inside; 0.5 is the mean of the true one, and
!>   the difference is the first-order error of the forces). A compliance c on the leading element,
!>   `u(first) + c p(first)`, moves it: in the plane problem with `u = -k int p ln|x|`, it lies at
!>   f dx for `c = k dx edge_strength [1/(f + edge_reach) - 1]`, a rational function because c
!>   changes one entry of the matrix. k = 2 (1 - nu)/(pi G) along, 2/(pi G) across. Where the
!>   element slides the compliance leaves its direction as it is.
!> - **K3** *True edge.* The square of the pressure falls linearly to zero at the edge: f from the
!>   first three elements of a row. Pressures that NORM found on the same grid are those of a
!>   lattice too, and f follows from the ratio of the first two (`lattice_edge`).
!>
!> **Curved surface.** Rows have slip of their own besides, that of their places; the influence
!> stays that of the half-space.
!>
!> `scheme_first_order` has neither and takes the rigid slip at `x + dx/6`: CONTACT's numbers.
!>
!> **Dissimilar materials.** Pressures move points along the surface too (K of
!> `faststrip_influence_rectangle`). With pressures given that is rigid slip: at the nodes the same
!> differences of u, in a shift u itself.
!>
!> **Shift.** s = w + u, the rigid shift and the displacement: symmetric, no nodes, no edges. Of
!> bodies that were displaced before (`faststrip_kalker_tangential_history`) s = w + u - u'; u', by
!> tractions and by pressures, is known and counts as rigid slip.
module faststrip_kalker_tangential_problem
    use faststrip_base_friction_table, only: friction_table_t, mean_mu_between
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits
    use faststrip_base_text, only: integer_text
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_no_contact, &
                                     st_out_of_range
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_influence_rectangle, only: rectangle_influence_t, rectangle_influence, &
                                             coupling_constant
    use faststrip_kalker_convolution, only: convolution_t, reserve_convolution, set_kernel, &
                                            release_convolution, transform_source, collect, even, &
                                            odd
    use faststrip_kalker_grid, only: contact_grid_t, element_x, element_y
    use faststrip_kalker_tangential_edges, only: treat_edges, edges_sampled, edges_of_norm
    use faststrip_kalker_tangential_history, only: tang_history_t, enclose_history
    implicit none
    private

    public :: problem_t, make_problem, release_problem, apply_influence, node_slip
    public :: scheme_second_order, scheme_first_order, edges_sampled, edges_of_norm, are_alike
    public :: converged, static_bound, find_bounds

    !> How slip is made of displacements.
    !> Given: numbers of kinds.
    integer, parameter :: scheme_second_order = 2, scheme_first_order = 1

    ! CONTACT's rigid slip is that of dx/6 ahead of the middle.
    ! Given: as CONTACT.
    real(wp), parameter :: contact_lead = 1.0_wp/6.0_wp
    ! Given: numbers of kinds.
    integer, parameter :: kernel_xx = 1, kernel_xy = 2, kernel_yy = 3, kernel_zx = 4, kernel_zy = 5
    !> Change of the pressures, or of the bounds of friction, over all of them, at which they stay;
    !> a coupling of pressures and slip below it is none.
    !> Tuned [1]. Origin: far below the errors of any grid; moduli given with five digits.
    real(wp), parameter :: converged = 1.0e-5_wp

    !> Elements, influence and rigid slip; arrays grow with the grid.
    type :: problem_t
        integer :: n = 0                   !! elements that carry traction
        integer :: n_rows = 0              !! rows that have some
        integer :: nx = 0                  !! columns of the convolution, one ahead of the contact
        integer :: ny = 0                  !! rows of the convolution; both hold the step before
        real(wp) :: dx = 0.0_wp            !! sides, mm
        real(wp) :: dy = 0.0_wp
        logical :: is_rolling = .true.     !! or a shift?
        logical :: is_second_order = .true. !! K1 of the header
        integer, allocatable :: column(:)  !! of an element, 1 to nx - 1
        integer, allocatable :: row(:)     !! of an element, 1 to ny
        integer, allocatable :: row_start(:) !! first element of a row; of row n_rows + 1: n + 1
        logical, allocatable :: is_leading(:) !! is nothing in contact ahead of the element?
        real(wp), allocatable :: x(:), y(:) !! middle of an element, mm
        real(wp), allocatable :: pn(:)     !! its pressure, MPa
        real(wp), allocatable :: rigid(:, :) !! its rigid slip, shape (2, n)
        real(wp), allocatable :: pressed(:, :) !! its part by the pressures of dissimilar materials
        real(wp), allocatable :: edge(:, :)  !! slip at its node by its own traction, the leading
                                             !! edge's part, 1/MPa, shape (2, n)
        real(wp), allocatable :: own_row(:, :)
            !! slip at the nodes of a row by unit traction in it, by columns from the element to the
            !! node, 1/MPa, shape (2, -nx:nx)
        type(convolution_t), private :: convolution
        real(wp), allocatable, private :: field_x(:, :), field_y(:, :) ! tractions, then u
        integer, private :: before(2) = 0  ! element of the convolution ahead of the history's
        ! What the kernels were made for.
        real(wp), private :: made_for(5) = 0.0_wp
        integer, private :: made_size(2) = 0
    end type problem_t

contains

    !> What the traction of an element may be at most, if friction does not fall, MPa.
    pure real(wp) function static_bound(problem, i, mu, table) result(bound)
        type(problem_t), intent(in) :: problem      !! set up
        integer, intent(in) :: i                    !! its element
        real(wp), intent(in) :: mu                  !! coefficient of friction
        type(friction_table_t), intent(in) :: table !! over y in its place, if it has places

        associate (y => problem%y(i), half => 0.5_wp*problem%dy)
            bound = mean_mu_between(table, mu, y - half, y + half)*problem%pn(i)
        end associate
    end function static_bound

    !> The same of all elements.
    pure subroutine find_bounds(problem, mu, table, bound)
        type(problem_t), intent(in) :: problem      !! set up
        real(wp), intent(in) :: mu                  !! coefficient of friction
        type(friction_table_t), intent(in) :: table !! over y in its place, if it has places
        real(wp), intent(inout) :: bound(:)         !! gets them, MPa, at least as many

        integer :: i

        do i = 1, problem%n
            bound(i) = static_bound(problem, i, mu, table)
        end do
    end subroutine find_bounds

    !> Set a problem up: everything that does not change in the iteration.
    subroutine make_problem(problem, grid, material, creepage, is_rolling, scheme, edges, &
                            most_elements, status, history, own)
        type(problem_t), intent(inout) :: problem    !! ready; arrays of its last use serve again
        type(contact_grid_t), intent(in) :: grid     !! with finite pressures >= 0
        type(material_t), intent(in) :: material     !! checked, MPa
        type(creepage_t), intent(in) :: creepage     !! checked; a shift in mm and rad
        logical, intent(in) :: is_rolling            !! or a shift?
        integer, intent(in) :: scheme                !! `scheme_second_order`, `scheme_first_order`
        integer, intent(in) :: edges                 !! `edges_sampled`, `edges_of_norm`
        integer, intent(in) :: most_elements         !! allowed
        type(status_t), intent(out) :: status        !! `st_no_contact`, `st_out_of_range`,
                                                     !! `st_workspace_too_small`
        type(tang_history_t), intent(in), optional :: history !! checked; for a shift
        type(creepage_t), intent(in), optional :: own(:) !! of each row of the grid, beside all

        integer :: first(2), last(2), corner(2), rim(2), i, j, n
        real(wp) :: floor

        call clear_status(status)
        ! What is but rounding beside the largest carries no traction.
        floor = half_digits*maxval(grid%pressure)
        n = count(grid%pressure > floor)
        if (n == 0) then
            call set_status(status, st_no_contact, 'no element is in contact')
            return
        else if (n > most_elements) then
            call set_status(status, st_out_of_range, 'at most ' // integer_text(most_elements) &
                            // ' elements may be in contact for rolling, got ' // integer_text(n))
            return
        end if
        first = [grid%nx, grid%ny]
        last = 1
        do j = 1, grid%ny
            do i = 1, grid%nx
                if (grid%pressure(i, j) <= floor) cycle
                first = min(first, [i, j])
                last = max(last, [i, j])
            end do
        end do
        corner = first
        rim = last
        if (present(history)) call enclose_history(history, grid, corner, rim, problem%before)
        problem%is_rolling = is_rolling
        problem%is_second_order = is_rolling .and. scheme == scheme_second_order
        problem%dx = grid%dx
        problem%dy = grid%dy
        problem%nx = rim(1) - corner(1) + 2
        problem%ny = rim(2) - corner(2) + 1
        problem%n = n
        call reserve_arrays(problem)
        call make_kernels(problem, material, status)
        if (is_error(status)) return
        call list_elements(problem, grid, creepage, floor, first, last, corner, own)
        problem%pressed(:, :n) = 0.0_wp
        if (.not. are_alike(material)) call add_pressures(problem, history)
        if (present(history)) call take_off_tractions(problem, history)
        problem%edge(:, :n) = 0.0_wp
        if (problem%is_second_order) &
            call treat_edges(problem%pn(:n), problem%is_leading(:n), material, edges, &
                             problem%edge(:, :n))
    end subroutine make_problem

    !> The elements in contact and their rigid slip.
    pure subroutine list_elements(problem, grid, creepage, floor, first, last, corner, own)
        type(problem_t), intent(inout) :: problem
        type(contact_grid_t), intent(in) :: grid
        type(creepage_t), intent(in) :: creepage
        real(wp), intent(in) :: floor             ! pressure in contact is above
        integer, intent(in) :: first(2), last(2)  ! of the grid's elements in contact
        integer, intent(in) :: corner(2)          ! of those in the convolution
        type(creepage_t), intent(in), optional :: own(:)

        integer :: i, j, n
        real(wp) :: lead

        lead = 0.0_wp
        if (problem%is_rolling) &
            lead = merge(0.5_wp, contact_lead, problem%is_second_order)*grid%dx
        n = 0
        problem%n_rows = 0
        do j = first(2), last(2)
            if (.not. any(grid%pressure(:, j) > floor)) cycle
            problem%n_rows = problem%n_rows + 1
            problem%row_start(problem%n_rows) = n + 1
            do i = last(1), first(1), -1
                if (grid%pressure(i, j) <= floor) cycle
                n = n + 1
                problem%column(n) = i - corner(1) + 1
                problem%row(n) = j - corner(2) + 1
                problem%x(n) = element_x(grid, i)
                problem%y(n) = element_y(grid, j)
                problem%pn(n) = grid%pressure(i, j)
                problem%is_leading(n) = .true.
                if (i < last(1)) problem%is_leading(n) = grid%pressure(i + 1, j) <= floor
                problem%rigid(1, n) = creepage%cksi - problem%y(n)*creepage%cphi
                problem%rigid(2, n) = creepage%ceta + (problem%x(n) + lead)*creepage%cphi
                if (.not. present(own)) cycle
                problem%rigid(1, n) = problem%rigid(1, n) + own(j)%cksi
                problem%rigid(2, n) = problem%rigid(2, n) &
                                      + own(j)%ceta + (problem%x(n) + lead)*own(j)%cphi
            end do
        end do
        problem%row_start(problem%n_rows + 1) = n + 1
    end subroutine list_elements

    !> Give plans and kernels back.
    subroutine release_problem(problem)
        type(problem_t), intent(inout) :: problem !! serves again

        call release_convolution(problem%convolution)
        problem%made_size = 0
    end subroutine release_problem

    subroutine reserve_arrays(problem)
        type(problem_t), intent(inout) :: problem

        integer :: n, nx, ny

        n = problem%n
        nx = problem%nx
        ny = problem%ny
        if (allocated(problem%x)) then
            if (size(problem%x) < n) &
                deallocate (problem%column, problem%row, problem%is_leading, problem%x, problem%y, &
                            problem%pn, problem%rigid, problem%pressed, problem%edge)
        end if
        if (.not. allocated(problem%x)) then
            allocate (problem%column(n), problem%row(n), source=0)
            allocate (problem%is_leading(n), source=.false.)
            allocate (problem%x(n), problem%y(n), problem%pn(n), source=0.0_wp)
            allocate (problem%rigid(2, n), problem%pressed(2, n), problem%edge(2, n), source=0.0_wp)
        end if
        if (allocated(problem%field_x)) then
            if (any(shape(problem%field_x) /= [nx, ny])) &
                deallocate (problem%field_x, problem%field_y, problem%own_row, problem%row_start)
        end if
        if (.not. allocated(problem%field_x)) then
            allocate (problem%field_x(nx, ny), problem%field_y(nx, ny), &
                      problem%own_row(2, -nx:nx), source=0.0_wp)
            allocate (problem%row_start(ny + 1), source=0)
        end if
    end subroutine reserve_arrays

    !> Influence coefficients, unless they are there already.
    subroutine make_kernels(problem, material, status)
        type(problem_t), intent(inout) :: problem
        type(material_t), intent(in) :: material
        type(status_t), intent(out) :: status

        real(wp), allocatable :: kernels(:, :, :)
        type(rectangle_influence_t) :: influence
        real(wp) :: wanted(5)
        integer :: i, j, n_kernels

        n_kernels = merge(kernel_yy, kernel_zy, are_alike(material))
        call reserve_convolution(problem%convolution, problem%nx, problem%ny, n_kernels, 2, status)
        if (is_error(status)) return
        wanted = [problem%dx, problem%dy, combined_shear_modulus(material), &
                  combined_poisson_ratio(material), coupling_constant(material)]
        if (any(problem%made_for /= wanted) .or. &
            any(problem%made_size /= [problem%nx, problem%ny])) then
            allocate (kernels(0:problem%nx, 0:problem%ny, kernel_zy))
            do j = 0, problem%ny
                do i = 0, problem%nx
                    call rectangle_influence(i*problem%dx, j*problem%dy, problem%dx, problem%dy, &
                                             material, influence)
                    kernels(i, j, kernel_xx) = influence%xx
                    kernels(i, j, kernel_xy) = influence%xy
                    kernels(i, j, kernel_yy) = influence%yy
                    kernels(i, j, kernel_zx) = influence%zx
                    kernels(i, j, kernel_zy) = influence%zy
                end do
            end do
            call set_kernel(problem%convolution, kernel_xx, kernels(:, :, kernel_xx), even, even, &
                            status)
            call set_kernel(problem%convolution, kernel_xy, kernels(:, :, kernel_xy), odd, odd, &
                            status)
            call set_kernel(problem%convolution, kernel_yy, kernels(:, :, kernel_yy), even, even, &
                            status)
            if (n_kernels == kernel_zy) then
                call set_kernel(problem%convolution, kernel_zx, kernels(:, :, kernel_zx), odd, &
                                even, status)
                call set_kernel(problem%convolution, kernel_zy, kernels(:, :, kernel_zy), even, &
                                odd, status)
            end if
            problem%made_for = wanted
            problem%made_size = [problem%nx, problem%ny]
        end if
        do i = -problem%nx, problem%nx
            call rectangle_influence(i*problem%dx, 0.0_wp, problem%dx, problem%dy, material, &
                                     influence)
            problem%own_row(:, i) = [influence%xx, influence%yy]
        end do
        if (problem%is_rolling) then
            do i = -problem%nx, problem%nx - 1
                problem%own_row(:, i) = (problem%own_row(:, i) - problem%own_row(:, i + 1)) &
                                        /problem%dx
            end do
        end if
    end subroutine make_kernels

    !> Do pressures cause no slip between bodies of these materials?
    pure logical function are_alike(material)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        are_alike = abs(coupling_constant(material)) <= converged
    end function are_alike

    !> Add to the rigid slip what the pressures of dissimilar materials do, less what they did
    !> before.
    subroutine add_pressures(problem, history)
        type(problem_t), intent(inout) :: problem ! with elements and kernels
        type(tang_history_t), intent(in), optional :: history

        integer :: i

        associate (fx => problem%field_x, fy => problem%field_y, c => problem%column, &
                   r => problem%row)
            fx = 0.0_wp
            do i = 1, problem%n
                fx(c(i), r(i)) = problem%pn(i)
            end do
            if (present(history)) then
                if (allocated(history%pressure)) &
                    call take_off(history%pressure, problem%before, fx)
            end if
            call transform_source(problem%convolution, 1, fx)
            ! Tractions move points down as pressures move them ahead, with the other sign.
            call collect(problem%convolution, [kernel_zx], [1], [-1.0_wp], fx)
            call collect(problem%convolution, [kernel_zy], [1], [-1.0_wp], fy)
            do i = 1, problem%n
                problem%pressed(:, i) = [fx(c(i), r(i)), fy(c(i), r(i))]
                if (problem%is_rolling) problem%pressed(:, i) = (problem%pressed(:, i) &
                    - [fx(c(i) + 1, r(i)), fy(c(i) + 1, r(i))])/problem%dx
            end do
        end associate
        problem%rigid(:, :problem%n) = problem%rigid(:, :problem%n) &
                                       + problem%pressed(:, :problem%n)
    end subroutine add_pressures

    !> Take off the rigid slip what the tractions of the step before do.
    subroutine take_off_tractions(problem, history)
        type(problem_t), intent(inout) :: problem ! with elements and kernels
        type(tang_history_t), intent(in) :: history

        integer :: i

        if (.not. allocated(history%px)) return
        associate (fx => problem%field_x, fy => problem%field_y, c => problem%column, &
                   r => problem%row)
            fx = 0.0_wp
            fy = 0.0_wp
            call take_off(history%px, problem%before, fx)
            call take_off(history%py, problem%before, fy)
            call move_by_tractions(problem)
            do i = 1, problem%n
                problem%rigid(:, i) = problem%rigid(:, i) + [fx(c(i), r(i)), fy(c(i), r(i))]
            end do
        end associate
    end subroutine take_off_tractions

    !> Take the loaded elements of the step before off a field.
    pure subroutine take_off(values, before, field)
        real(wp), intent(in) :: values(:, :)
        integer, intent(in) :: before(2)
        real(wp), intent(inout) :: field(:, :)

        integer :: i, j

        do j = max(1, 1 - before(2)), min(size(values, 2), size(field, 2) - before(2))
            do i = max(1, 1 - before(1)), min(size(values, 1), size(field, 1) - before(1))
                associate (f => field(i + before(1), j + before(2)))
                    f = f - values(i, j)
                end associate
            end do
        end do
    end subroutine take_off

    !> Displacement differences by tractions, in their fields.
    subroutine move_by_tractions(problem)
        type(problem_t), intent(inout) :: problem

        associate (fx => problem%field_x, fy => problem%field_y)
            call transform_source(problem%convolution, 1, fx)
            call transform_source(problem%convolution, 2, fy)
            call collect(problem%convolution, [kernel_xx, kernel_xy], [1, 2], [1.0_wp, 1.0_wp], fx)
            call collect(problem%convolution, [kernel_xy, kernel_yy], [1, 2], [1.0_wp, 1.0_wp], fy)
        end associate
    end subroutine move_by_tractions

    !> Elastic part of the slip at the nodes by tractions on the elements.
    subroutine apply_influence(problem, p, slip)
        type(problem_t), intent(inout) :: problem !! made; its fields are capacity to work in
        real(wp), intent(in) :: p(:, :)           !! tractions, MPa, shape (2, n)
        real(wp), intent(inout) :: slip(:, :)     !! shape (2, n)

        integer :: i

        associate (fx => problem%field_x, fy => problem%field_y, c => problem%column, &
                   r => problem%row)
            fx = 0.0_wp
            fy = 0.0_wp
            do i = 1, problem%n
                fx(c(i), r(i)) = p(1, i)
                fy(c(i), r(i)) = p(2, i)
            end do
            call move_by_tractions(problem)
            if (problem%is_rolling) then
                do i = 1, problem%n
                    slip(1, i) = (fx(c(i), r(i)) - fx(c(i) + 1, r(i)))/problem%dx
                    slip(2, i) = (fy(c(i), r(i)) - fy(c(i) + 1, r(i)))/problem%dx
                    slip(:, i) = slip(:, i) + problem%edge(:, i)*p(:, i)
                end do
            else
                do i = 1, problem%n
                    slip(1, i) = fx(c(i), r(i))
                    slip(2, i) = fy(c(i), r(i))
                end do
            end if
        end associate
    end subroutine apply_influence

    !> Slip at the nodes, rigid and elastic.
    subroutine node_slip(problem, p, slip)
        type(problem_t), intent(inout) :: problem !! made
        real(wp), intent(in) :: p(:, :)           !! tractions, MPa, shape (2, n)
        real(wp), intent(inout) :: slip(:, :)     !! shape (2, n)

        call apply_influence(problem, p, slip)
        slip(:, :problem%n) = slip(:, :problem%n) + problem%rigid(:, :problem%n)
    end subroutine node_slip
end module faststrip_kalker_tangential_problem
