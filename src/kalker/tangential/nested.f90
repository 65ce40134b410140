!> Where TANG starts: at the tractions of coarser grids, whose elements are two by two of the next
!> finer one (nested iteration).
!>
!> States and tractions of a coarse grid are those of a fine one but near the borders of adhesion
!> and slip, so that few Newton's steps are left on the fine grid. What is passed on is the
!> traction over the pressure, linearly between middles in contact. The fine grid's solution is
!> the same to its tolerance wherever it starts.
module faststrip_kalker_tangential_nested
    use faststrip_base_friction_table, only: friction_table_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_kalker_grid, only: contact_grid_t, size_grid
    use faststrip_kalker_normal_options, only: fewest_elements
    use faststrip_kalker_tangential_newton, only: newton_t, size_newton, solve_newton
    use faststrip_kalker_tangential_problem, only: problem_t, make_problem, release_problem, &
                                                   find_bounds
    implicit none
    private

    public :: nested_t, choice_t, start_from_coarse, release_nested

    !> Fewest elements in contact of a grid for which a coarser one is solved first.
    !> Tuned [elements]. Origin: chosen for the time.
    integer, parameter :: fewest_in_contact = 600
    !> Tolerance of the coarser grids.
    !> Tuned [1]. Origin: chosen for the time; two grids differ by more.
    real(wp), parameter :: coarse_tolerance = 3.0e-3_wp
    ! A coarse element is two by two fine ones.
    ! Given: halves of sides.
    real(wp), parameter :: quarter_part = 0.25_wp

    !> How the fine problem is made and solved.
    type :: choice_t
        logical :: is_rolling = .true. !! or a shift
        integer :: scheme = 0          !! of `make_problem`
        integer :: edges = 0           !! of `make_problem`
        real(wp) :: scaling = 0.0_wp   !! of `solve_newton`
        integer :: max_steps = 0       !! of `solve_newton`
    end type choice_t

    ! One coarser grid and its solution.
    type :: level_t
        type(contact_grid_t) :: grid
        type(problem_t) :: problem
        type(newton_t) :: newton
        real(wp), allocatable :: bound(:)        ! of the tractions, MPa
        real(wp), allocatable :: share(:, :, :)  ! tractions over pressures, and 1 in contact
    end type level_t

    !> Coarser grids, owned by the caller; three, and no array of them, for the reason told at
    !> `convolution_t`.
    type :: nested_t
        type(level_t), private :: half, quarter, eighth
    end type nested_t

contains

    !> Put tractions of coarser grids into `newton%p`, unless the grid is coarse itself.
    subroutine start_from_coarse(nested, newton, problem, grid, material, creepage, mu, &
                                 table, choice, is_started)
        type(nested_t), intent(inout) :: nested     !! needs no preparation
        type(newton_t), intent(inout) :: newton     !! sized for the fine problem
        type(problem_t), intent(in) :: problem      !! the fine one
        type(contact_grid_t), intent(in) :: grid    !! its pressures
        type(material_t), intent(in) :: material    !! checked
        type(creepage_t), intent(in) :: creepage    !! checked
        real(wp), intent(in) :: mu                  !! > 0
        type(friction_table_t), intent(in) :: table !! over y in its place, if it has places
        type(choice_t), intent(in) :: choice        !! as for the fine problem
        logical, intent(out) :: is_started          !! does `newton%p` hold a start?

        integer :: depth

        depth = 0
        if (is_fine(problem)) then
            call make_level(nested%half, grid)
            if (is_fine(nested%half%problem)) then
                call make_level(nested%quarter, nested%half%grid)
                if (is_fine(nested%quarter%problem)) &
                    call make_level(nested%eighth, nested%quarter%grid)
            end if
        end if
        is_started = .false.
        if (depth >= 3) call solve_level(nested%eighth)
        if (depth >= 2) then
            if (is_started) call start_finer(nested%eighth, nested%quarter%problem, &
                                             nested%quarter%newton)
            call solve_level(nested%quarter)
        end if
        if (depth >= 1) then
            if (is_started) call start_finer(nested%quarter, nested%half%problem, &
                                             nested%half%newton)
            call solve_level(nested%half)
        end if
        if (is_started) call start_finer(nested%half, problem, newton)

    contains

        !> Is a coarser grid worth it?
        pure logical function is_fine(finer)
            type(problem_t), intent(in) :: finer

            is_fine = finer%n >= fewest_in_contact .and. &
                      min(finer%nx, finer%ny) >= 2*fewest_elements
        end function is_fine

        !> The next grid and its problem; `depth` counts those that were made.
        subroutine make_level(level, finer)
            type(level_t), intent(inout) :: level
            type(contact_grid_t), intent(in) :: finer

            type(status_t) :: status

            call coarsen(finer, level%grid)
            call make_problem(level%problem, level%grid, material, creepage, choice%is_rolling, &
                              choice%scheme, choice%edges, size(level%grid%pressure), status)
            if (is_error(status)) return
            depth = depth + 1
        end subroutine make_level

        !> Solve a grid, from what is in its tractions if the coarser one was solved.
        subroutine solve_level(level)
            type(level_t), intent(inout) :: level

            associate (n => level%problem%n)
                if (.not. is_started) then
                    call size_newton(level%newton, level%problem)
                    level%newton%p = 0.0_wp
                end if
                if (allocated(level%bound)) then
                    if (size(level%bound) < n) deallocate (level%bound)
                end if
                if (.not. allocated(level%bound)) allocate (level%bound(n), source=0.0_wp)
                call find_bounds(level%problem, mu, table, level%bound)
                call solve_newton(level%newton, level%problem, level%bound, .false., &
                                  choice%scaling, coarse_tolerance, choice%max_steps)
            end associate
            is_started = level%newton%is_converged
        end subroutine solve_level
    end subroutine start_from_coarse

    !> The grid of elements twice as long and wide, with the same load.
    subroutine coarsen(grid, coarse)
        type(contact_grid_t), intent(in) :: grid
        type(contact_grid_t), intent(inout) :: coarse

        integer :: i, j

        call size_grid(coarse, (grid%nx + 1)/2, (grid%ny + 1)/2)
        coarse%dx = 2.0_wp*grid%dx
        coarse%dy = 2.0_wp*grid%dy
        coarse%x_first = grid%x_first + 0.5_wp*grid%dx
        coarse%y_first = grid%y_first + 0.5_wp*grid%dy
        coarse%pressure = 0.0_wp
        do j = 1, grid%ny
            do i = 1, grid%nx
                associate (p => coarse%pressure((i + 1)/2, (j + 1)/2))
                    p = p + quarter_part*grid%pressure(i, j)
                end associate
            end do
        end do
    end subroutine coarsen

    !> Start a finer problem at the tractions of a coarser one.
    subroutine start_finer(level, problem, newton)
        type(level_t), intent(inout) :: level     !! solved
        type(problem_t), intent(in) :: problem    !! the finer one
        type(newton_t), intent(inout) :: newton   !! its tractions are written

        integer :: i, k, l
        real(wp) :: x, y, sum(3)

        associate (grid => level%grid)
            if (allocated(level%share)) then
                if (ubound(level%share, 2) /= grid%nx + 1 .or. &
                    ubound(level%share, 3) /= grid%ny + 1) deallocate (level%share)
            end if
            if (.not. allocated(level%share)) &
                allocate (level%share(3, 0:grid%nx + 1, 0:grid%ny + 1))
            level%share = 0.0_wp
            do i = 1, level%problem%n
                level%share(:, nint(place(level%problem%x(i), grid%x_first, grid%dx)), &
                            nint(place(level%problem%y(i), grid%y_first, grid%dy))) = &
                    [level%newton%p(:, i)/level%problem%pn(i), 1.0_wp]
            end do
            call size_newton(newton, problem)
            do i = 1, problem%n
                x = place(problem%x(i), grid%x_first, grid%dx)
                y = place(problem%y(i), grid%y_first, grid%dy)
                k = min(max(floor(x), 0), grid%nx)
                l = min(max(floor(y), 0), grid%ny)
                x = x - k
                y = y - l
                associate (s => level%share(:, k:k + 1, l:l + 1))
                    sum = (1.0_wp - y)*((1.0_wp - x)*s(:, 1, 1) + x*s(:, 2, 1)) &
                          + y*((1.0_wp - x)*s(:, 1, 2) + x*s(:, 2, 2))
                end associate
                newton%p(:, i) = 0.0_wp
                if (sum(3) > 0.0_wp) newton%p(:, i) = problem%pn(i)*sum(:2)/sum(3)
            end do
        end associate

    contains

        !> Number of the middle at a place, with a fraction.
        pure real(wp) function place(at, first, side)
            real(wp), intent(in) :: at, first, side

            place = 1.0_wp + (at - first)/side
        end function place
    end subroutine start_finer

    !> Give plans and kernels back.
    subroutine release_nested(nested)
        type(nested_t), intent(inout) :: nested !! serves again

        call release_problem(nested%half%problem)
        call release_problem(nested%quarter%problem)
        call release_problem(nested%eighth%problem)
    end subroutine release_nested
end module faststrip_kalker_tangential_nested
