!> The normal contact of a lattice of rectangles: a convex problem with one solution.
!>
!> Each cell of a lattice, a piece of the patch along y, is divided along x into even rectangles
!> of constant pressure, as long as the cell needs; what is left of x = 0 mirrors what is right.
!> The pressures minimise
!>
!>     1/2 p' S p + p' (a h) - D a' p,   p >= 0,
!>
!> a the areas, h the undeformed gap at the middles, S_ij = H int_i int_j 1/r. S is symmetric and
!> positive definite, so that there is one solution, that of any order of the cells, of the mirror
!> image and of any unit of length; it depends on the input without jumps. S is the mean of 1/r
!> with the second moments of both rectangles, and for neighbours the mean of the exact
!> potentials in each other's middles.
!>
!> An active set finds the solution in some five steps, see `solve_elements`.
module faststrip_normal_cells_elements
    use faststrip_base_kinds, only: wp, pi
    use faststrip_influence_rectangle, only: rectangle_potential
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: elements_t, reserve_elements, position_elements, solve_elements, element_columns

    ! Tuned [elements]: Most and fewest rows. Origin: capacity, and cost: it rises with its cube.
    integer, parameter :: most_rows = 10, fewest_rows = 4 ! on one side of x = 0
    ! Tuned [elements]: Most elements. Origin: most_cells by the rows that are mostly needed.
    integer, parameter :: most_elements = 440
    ! Tuned [rounds]: Rounds of the active set by blocks. Origin: chosen against cycling.
    integer, parameter :: max_block_rounds = 3  ! without fewer infeasible elements
    ! Tuned [rounds]: Most rounds. Origin: safeguard.
    integer, parameter :: max_rounds = 120
    ! Centre distance, in largest sides, from which moments serve; no ratio of even cells.
    ! Tuned [sides]: Distance from which an element's influence is by few points. Origin: chosen for
    ! the quadrature's error.
    real(wp), parameter :: far = 3.37_wp
    ! Tuned [1]: Proportion from which an element is divided. Origin: as `far`.
    real(wp), parameter :: long = 3.13_wp ! side over side
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: start_level = 0.5_wp ! of the penetration: elements that may press
    ! Tuned [1]. Origin: safeguard: above rounding.
    real(wp), parameter :: nothing = 1.0e-12_wp ! of a pressure
    ! Tuned [1]. Origin: safeguard: above rounding.
    real(wp), parameter :: open_gap = 1.0e-13_wp ! of the penetration: not an overlap
    ! Tuned [1]. Origin: chosen: pressures are trusted to that.
    real(wp), parameter :: most_corrected = 0.05_wp ! of p0, see `element_columns`

    !> The elements of one lattice and what their solution needs; owned by the caller.
    type :: elements_t
        integer :: n = 0, rows = 0
        real(wp), allocatable :: x(:), y(:), dx(:), dy(:), area(:), height(:), pressure(:)
        real(wp), allocatable :: trial(:)
        real(wp), allocatable :: s(:, :), matrix(:, :), column(:, :)
        integer, allocatable :: pivot(:), at(:)
        logical, allocatable :: presses(:)
    end type elements_t

contains

    !> Allocate for the elements of lattices of up to `max_cells` cells.
    subroutine reserve_elements(elements, max_cells)
        type(elements_t), intent(inout) :: elements !! sized
        integer, intent(in) :: max_cells            !! >= 1

        integer :: m

        m = max(max_cells*most_rows, 1)
        m = min(m, max(most_elements, fewest_rows*max_cells))
        if (allocated(elements%x)) then
            if (size(elements%x) >= m) return
            deallocate (elements%x, elements%y, elements%dx, elements%dy, elements%area, &
                        elements%height, elements%pressure, elements%s, elements%matrix, &
                        elements%column, elements%trial, elements%pivot, elements%at, &
                        elements%presses)
        end if
        allocate (elements%x(m), elements%y(m), elements%dx(m), elements%dy(m), &
                  elements%area(m), elements%height(m), elements%pressure(m), &
                  elements%trial(m), source=0.0_wp)
        allocate (elements%s(m, m), elements%matrix(m, m), elements%column(m, 2), source=0.0_wp)
        allocate (elements%pivot(m), elements%at(m), source=0)
        allocate (elements%presses(m), source=.false.)
    end subroutine reserve_elements

    !> Divide the cells into elements and find their influence upon each other.
    pure subroutine position_elements(elements, y_left, y_right, height, inv2r, reach)
        type(elements_t), intent(inout) :: elements !! reserved
        real(wp), intent(in) :: y_left(:), y_right(:) !! of the cells, (n), mm
        real(wp), intent(in) :: height(:)             !! gap in their middles, (n), mm
        real(wp), intent(in) :: inv2r(:)              !! A in their middles, (n), 1/mm
        real(wp), intent(in) :: reach(:)              !! how far they go along x, (n), mm

        integer :: i, j, k

        associate (e => elements)
            e%rows = max(1, min(most_rows, size(e%x)/size(reach), &
                                max(fewest_rows, most_elements/size(reach))))
            i = 0
            do k = 1, size(reach)
                do j = 1, e%rows
                    i = i + 1
                    e%dx(i) = reach(k)/e%rows
                    e%dy(i) = y_right(k) - y_left(k)
                    e%x(i) = (j - 0.5_wp)*e%dx(i)
                    e%y(i) = 0.5_wp*(y_left(k) + y_right(k))
                    e%area(i) = e%dx(i)*e%dy(i)
                    ! Given: moment of a side
                    e%height(i) = height(k) + inv2r(k)*(e%x(i)**2 + e%dx(i)**2/12.0_wp)
                end do
            end do
            e%n = i
            do j = 1, e%n
                do i = 1, j
                    e%s(i, j) = e%area(i)*e%area(j) &
                                *(mean_inverse(e, i, j, e%x(i) - e%x(j)) &
                                  + mean_inverse(e, i, j, e%x(i) + e%x(j)))
                end do
            end do
            do j = 1, e%n
                do i = j + 1, e%n
                    e%s(i, j) = e%s(j, i)
                end do
            end do
        end associate
    end subroutine position_elements

    !> Mean of 1/r between two elements whose middles are x apart along x, 1/mm.
    pure real(wp) function mean_inverse(e, i, j, x) result(mean)
        type(elements_t), intent(in) :: e
        integer, intent(in) :: i, j
        real(wp), intent(in) :: x

        real(wp) :: y, r2, side, along, across

        y = e%y(i) - e%y(j)
        r2 = x*x + y*y
        side = max(e%dx(i), e%dy(i), e%dx(j), e%dy(j))
        if (r2 > (far*side)**2) then
            along = (e%dx(i)**2 + e%dx(j)**2)/24.0_wp ! Given: moment of a side
            across = (e%dy(i)**2 + e%dy(j)**2)/24.0_wp ! Given: moment of a side
            mean = (1.0_wp + (along*(3.0_wp*x*x/r2 - 1.0_wp) + across*(3.0_wp*y*y/r2 - 1.0_wp)) &
                    /r2)/sqrt(r2)
        else
            mean = 0.5_wp*(mean_potential(x, y, e%dx(j), e%dy(j), e%dx(i), e%dy(i))/e%area(j) &
                           + mean_potential(x, y, e%dx(i), e%dy(i), e%dx(j), e%dy(j))/e%area(i))
        end if
    end function mean_inverse

    !> Potential of one rectangle in another, mm: in its middle, or at two Gauss points along it if
    !> it is long.
    pure real(wp) function mean_potential(x, y, dx, dy, target_dx, target_dy) result(mean)
        real(wp), intent(in) :: x, y, dx, dy, target_dx, target_dy

        ! Given: Gauss-Legendre with two points.
        real(wp), parameter :: gauss = 0.5_wp/sqrt(3.0_wp)
        real(wp) :: s, t

        s = 0.0_wp
        t = 0.0_wp
        if (target_dx > long*target_dy) s = gauss*target_dx
        if (target_dy > long*target_dx) t = gauss*target_dy
        if (s + t > 0.0_wp) then
            mean = 0.5_wp*(rectangle_potential(x - s, y - t, dx, dy) &
                           + rectangle_potential(x + s, y + t, dx, dy))
        else
            mean = rectangle_potential(x, y, dx, dy)
        end if
    end function mean_potential

    !> Pressures under a load or for a penetration.
    !>
    !> Elements that pull leave and elements that overlap join, all at once, as long as they become
    !> fewer. If not, pressures stay positive from then on and carry the load: they go towards the
    !> solution for the elements that press as far as none is left without pressure, which lowers
    !> the energy, and elements join when that is reached.
    subroutine solve_elements(elements, compliance, demand, depth, solved)
        type(elements_t), intent(inout) :: elements !! positioned
        real(wp), intent(in) :: compliance          !! H, 1/MPa
        type(demand_t), intent(in) :: demand        !! load, or penetration above the lowest height
        real(wp), intent(inout) :: depth            !! penetration above the lowest height, mm
        logical, intent(out) :: solved              !! or was a system singular? No pressures then

        integer :: rounds, n, i, infeasible, fewest, tries, worst
        real(wp) :: unit
        logical :: singular, feasible, arrived, stuck

        associate (e => elements, p => elements%pressure, q => elements%trial)
            solved = .false.
            n = e%n
            unit = depth
            fewest = n + 1
            tries = 0
            feasible = .false.
            stuck = .false.
            e%presses(:n) = e%height(:n) < start_level*unit
            if (.not. any(e%presses(:n))) e%presses(minloc(e%height(:n), dim=1)) = .true.
            do rounds = 1, max_rounds
                call solve_pressing(e, 0.5_wp*demand%load*compliance, demand%by_load, unit, depth, &
                                    singular)
                if (singular) return
                if (.not. demand%by_load) depth = demand%penetration
                if (feasible) then
                    call approach_trial(e, arrived, stuck)
                    if (.not. arrived) cycle
                else
                    p(:n) = q(:n)
                end if
                call find_infeasible(e, depth, infeasible, worst)
                if (infeasible == 0) exit
                if (infeasible < fewest) then
                    fewest = infeasible
                    tries = 0
                else
                    tries = tries + 1
                end if
                if (feasible .and. (stuck .or. tries > max_block_rounds)) then
                    e%presses(worst) = .true.
                else if (tries <= max_block_rounds) then
                    do i = 1, infeasible
                        e%presses(e%at(i)) = .not. e%presses(e%at(i))
                    end do
                    if (.not. any(e%presses(:n))) &
                        e%presses(minloc(e%height(:n), dim=1)) = .true.
                else
                    feasible = .true.
                    fewest = n + 1
                    tries = 0
                    p(:n) = max(p(:n), 0.0_wp)
                    if (demand%by_load) p(:n) = p(:n)*(0.5_wp*demand%load*compliance &
                                                       /dot_product(e%area(:n), p(:n)))
                    e%presses(:n) = p(:n) > 0.0_wp
                end if
            end do
            p(:n) = max(p(:n), 0.0_wp)
            if (demand%by_load) &
                p(:n) = p(:n)*(0.5_wp*demand%load*compliance/dot_product(e%area(:n), p(:n)))
            p(:n) = p(:n)/compliance
            solved = any(p(:n) > 0.0_wp)
        end associate
    end subroutine solve_elements

    !> From pressures towards those tried, as far as none is below zero; those at zero leave.
    pure subroutine approach_trial(e, arrived, stuck)
        type(elements_t), intent(inout) :: e
        logical, intent(out) :: arrived !! all the way?
        logical, intent(out) :: stuck   !! or not at all?

        real(wp) :: step
        integer :: i

        associate (p => e%pressure, q => e%trial)
            step = 1.0_wp
            do i = 1, e%n
                if (e%presses(i) .and. q(i) <= 0.0_wp) step = min(step, p(i)/(p(i) - q(i)))
            end do
            arrived = .not. step < 1.0_wp
            stuck = step <= 0.0_wp
            do i = 1, e%n
                if (.not. e%presses(i)) cycle
                if (q(i) <= 0.0_wp .and. p(i) <= step*(p(i) - q(i))*(1.0_wp + nothing)) then
                    p(i) = 0.0_wp
                    e%presses(i) = .false.
                else
                    p(i) = p(i) + step*(q(i) - p(i))
                end if
            end do
        end associate
    end subroutine approach_trial

    !> The elements that pull and those that overlap without pressing, into `at`.
    pure subroutine find_infeasible(e, depth, infeasible, worst)
        type(elements_t), intent(inout) :: e
        real(wp), intent(in) :: depth
        integer, intent(out) :: infeasible !! how many
        integer, intent(out) :: worst      !! which of all; 0: none

        real(wp) :: violation, largest
        integer :: i

        infeasible = 0
        worst = 0
        largest = 0.0_wp
        associate (p => e%pressure, n => e%n)
            do i = 1, n
                if (e%presses(i)) then
                    violation = -p(i)/maxval(abs(p(:n)))
                    if (violation < 0.0_wp) cycle
                else
                    violation = -(dot_product(e%s(:n, i), p(:n))/e%area(i) + e%height(i) &
                                  - depth)/depth
                    if (violation <= open_gap) cycle
                end if
                infeasible = infeasible + 1
                e%at(infeasible) = i
                if (violation < largest) cycle
                largest = violation
                worst = i
            end do
        end associate
    end subroutine find_infeasible

    !> What the elements that are said to press carry if they all do, of any sign, into `trial`, in
    !> units of 1/H.
    subroutine solve_pressing(e, half_load, by_load, unit, depth, singular)
        type(elements_t), intent(inout) :: e
        real(wp), intent(in) :: half_load ! times H
        logical, intent(in) :: by_load
        real(wp), intent(in) :: unit      ! of the heights, mm
        real(wp), intent(inout) :: depth
        logical, intent(out) :: singular

        real(wp) :: carried(2) ! by unit pressures and by unit heights
        integer :: m, i, j, k

        m = 0
        do i = 1, e%n
            if (.not. e%presses(i)) cycle
            m = m + 1
            e%at(m) = i
        end do
        do j = 1, m
            k = e%at(j)
            do i = 1, m
                ! For the pressure times the root of the area: an even diagonal
                e%matrix(i, j) = e%s(e%at(i), k)/sqrt(e%area(e%at(i))*e%area(k))
            end do
            e%column(j, 1) = sqrt(e%area(k))
            e%column(j, 2) = sqrt(e%area(k))*(e%height(k)/unit)
        end do
        call lu_factor(m, e%matrix, e%pivot, singular)
        if (singular) return
        call lu_solve(m, e%matrix, e%pivot, e%column(:, 1))
        call lu_solve(m, e%matrix, e%pivot, e%column(:, 2))
        do j = 1, m
            e%column(j, :) = e%column(j, :)/sqrt(e%area(e%at(j)))
        end do
        if (by_load) then
            carried = 0.0_wp
            do j = 1, m
                carried = carried + e%area(e%at(j))*e%column(j, :)
            end do
            depth = (half_load + unit*carried(2))/carried(1)
        end if
        e%trial(:e%n) = 0.0_wp
        do j = 1, m
            e%trial(e%at(j)) = depth*e%column(j, 1) - unit*e%column(j, 2)
        end do
    end subroutine solve_pressing

    !> Semi-ellipses with the loads of the cells. The second moment of the pressures gives a length
    !> and a pressure in the middle; where that of the innermost element differs, which is that of
    !> a semi-ellipse in a smooth contact, the other follows by 5 % at most.
    pure subroutine element_columns(elements, n, p0, half_length)
        type(elements_t), intent(in) :: elements !! solved
        integer, intent(in) :: n                 !! cells
        real(wp), intent(out) :: p0(:)           !! MPa, zero where nothing presses
        real(wp), intent(out) :: half_length(:)  !! mm

        real(wp) :: force, innermost
        integer :: k, first, last

        do k = 1, n
            first = (k - 1)*elements%rows + 1
            last = k*elements%rows
            associate (p => elements%pressure(first:last), x => elements%x(first:last), &
                       dx => elements%dx(first))
                p0(k) = 0.0_wp
                half_length(k) = x(1)
                force = 2.0_wp*sum(p)*dx
                if (force <= 0.0_wp) cycle
                half_length(k) = 2.0_wp*sqrt(sum(p*x**2)/sum(p))
                p0(k) = force/(0.5_wp*pi*half_length(k))
                innermost = p(1)/sqrt(1.0_wp - (x(1)/half_length(k))**2)
                p0(k) = min(max(innermost, (1.0_wp - most_corrected)*p0(k)), &
                            (1.0_wp + most_corrected)*p0(k))
                half_length(k) = force/(0.5_wp*pi*p0(k))
            end associate
        end do
    end subroutine element_columns
end module faststrip_normal_cells_elements
