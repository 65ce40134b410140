!> The nonlinear solver of TANG: Newton's method on Coulomb's law, GMRES for its steps.
!>
!> With t = p - r s (r > 0) an element sticks if |t| <= g = mu pn, and Coulomb's law is F = 0,
!>
!>     F = r s  (adhesion),   F = p - g t/|t|  (slip).
!>
!> F is differentiable but for the switch of states (a semismooth function; Alart and Curnier 1991).
!> A sliding element's change of traction along t is known beforehand, so that it has one unknown,
!> across t. A step is solved with GMRES, rows of elements as its preconditioner, brought back to
!> the bounds, and halved while |F| grows.
!>
!> Which nodes' slip is extrapolated to the middles depends on the states (`variational_problem`);
!> after some steps it is kept as it is, or a few elements near the pole of spin might change for
!> ever.
module faststrip_kalker_tangential_newton
    use faststrip_base_kinds, only: wp
    use faststrip_kalker_tangential_problem, only: problem_t, apply_influence, node_slip
    use faststrip_kalker_tangential_rows, only: rows_t, size_rows, factor_rows, solve_rows
    implicit none
    private

    public :: newton_t, size_newton, solve_newton, free_steps

    !> Most vectors of GMRES; Newton's next step goes on from there.
    !> Tuned [vectors]. Origin: capacity: the tests and the outputs of ./run net take fewer.
    integer, parameter :: most_vectors = 60
    !> Steps before the extrapolated nodes are kept; passes of a falling bound that take all of the
    !> new one, later ones the mean with the last.
    !> Tuned [steps]. Origin: chosen against nodes, and elements, that swing.
    integer, parameter :: free_steps = 6
    ! Tuned [halvings]: Most halvings of a step. Origin: chosen.
    integer, parameter :: most_halvings = 5
    ! Tuned [1]. Origin: chosen for the time of all steps together.
    real(wp), parameter :: loosest = 5.0e-2_wp ! tolerance of GMRES
    ! Tuned [1]: of what is left to the tolerance, for the tolerance of GMRES. Origin: chosen.
    real(wp), parameter :: last_share = 0.3_wp

    !> State of the solver; arrays grow with the problem.
    type :: newton_t
        integer :: steps = 0           !! of Newton's method in the last solution
        integer :: products = 0        !! applications of the influence in the last solution
        integer :: iterations = 0      !! of GMRES in the last solution
        real(wp) :: residual = 0.0_wp  !! |F| over its value without tractions
        logical :: is_converged = .false.
        real(wp), allocatable :: p(:, :)    !! tractions, MPa, shape (2, n)
        real(wp), allocatable :: slip(:, :) !! slip at the elements, shape (2, n)
        logical, allocatable :: sticks(:)   !! states
        type(rows_t), private :: rows
        real(wp), allocatable, private :: bound(:), r(:), trial(:, :), node(:, :), along(:, :), &
                                          tangent(:, :), resistance(:), change(:, :), size_t(:), &
                                          best(:, :)
        logical, allocatable, private :: is_extrapolated(:)
        integer, allocatable, private :: unknown(:)
        real(wp), allocatable, private :: basis(:, :), work(:), step(:), right(:)
    end type newton_t

contains

    !> Allocate for a problem; tractions of the last solution stay if it had as many elements.
    subroutine size_newton(newton, problem)
        type(newton_t), intent(inout) :: newton !! sized
        type(problem_t), intent(in) :: problem  !! made

        integer :: n

        n = problem%n
        if (allocated(newton%p)) then
            if (size(newton%p, 2) /= n) &
                deallocate (newton%p, newton%slip, newton%sticks, newton%bound, newton%r, &
                            newton%trial, newton%node, newton%along, newton%tangent, &
                            newton%resistance, &
                            newton%change, newton%size_t, newton%best, newton%is_extrapolated, &
                            newton%unknown, newton%basis, newton%work, newton%step, newton%right)
        end if
        if (.not. allocated(newton%p)) then
            allocate (newton%p(2, n), newton%slip(2, n), newton%trial(2, n), newton%node(2, n), &
                      newton%along(2, n), newton%tangent(2, n), newton%change(2, n), &
                      newton%best(2, n), source=0.0_wp)
            allocate (newton%bound(n), newton%r(n), newton%resistance(n), newton%size_t(n), &
                      source=0.0_wp)
            allocate (newton%sticks(n), newton%is_extrapolated(n), source=.false.)
            allocate (newton%unknown(n + 1), source=0)
            allocate (newton%basis(2*n, most_vectors + 1), newton%work(2*n), newton%step(2*n), &
                      newton%right(2*n), source=0.0_wp)
        end if
        call size_rows(newton%rows, problem)
    end subroutine size_newton

    !> Solve a problem, from the tractions in `newton%p`.
    subroutine solve_newton(newton, problem, bound, sticks_everywhere, scaling, tolerance, &
                            max_steps)
        type(newton_t), intent(inout) :: newton  !! sized; `is_converged` tells
        type(problem_t), intent(inout) :: problem !! made
        real(wp), intent(in) :: bound(:)         !! of the traction of each element, >= 0, MPa
        logical, intent(in) :: sticks_everywhere !! is friction without a bound?
        real(wp), intent(in) :: scaling          !! r times the own compliance of an element
        real(wp), intent(in) :: tolerance        !! of `residual`
        integer, intent(in) :: max_steps         !! of Newton's method, bounded

        real(wp) :: norm, last_norm, scale, fraction, demand
        integer :: n, halving, i, info

        n = problem%n
        do i = 1, n
            newton%r(i) = 2.0_wp*scaling/sum(problem%own_row(:, 0) + problem%edge(:, i))
        end do
        newton%bound = bound(:n)
        newton%is_converged = .false.
        newton%steps = 0
        newton%is_extrapolated = .false.
        ! |F| without tractions.
        newton%best = newton%p
        newton%p = 0.0_wp
        call evaluate(newton, problem, sticks_everywhere, .true., scale, without_elastic=.true.)
        if (scale <= 0.0_wp) then
            newton%residual = 0.0_wp
            newton%is_converged = .true.
            newton%slip = 0.0_wp
            return
        end if
        newton%p = newton%best
        call evaluate(newton, problem, sticks_everywhere, .true., norm)
        do
            newton%residual = norm/scale
            if (newton%residual <= tolerance) then
                newton%is_converged = .true.
                exit
            end if
            if (newton%steps >= max_steps) exit
            newton%steps = newton%steps + 1
            demand = min(loosest, max(newton%residual, last_share*tolerance/newton%residual))
            call find_step(newton, problem, demand, info)
            if (info /= 0) exit
            last_norm = norm
            newton%best = newton%p
            fraction = 1.0_wp
            do halving = 0, most_halvings
                newton%p = newton%best + fraction*newton%change
                if (.not. sticks_everywhere) then
                    do i = 1, n
                        call bring_back(newton%p(:, i), newton%bound(i))
                    end do
                end if
                call evaluate(newton, problem, sticks_everywhere, &
                              newton%steps <= free_steps, norm)
                if (norm < last_norm) exit
                fraction = 0.5_wp*fraction
            end do
        end do
        call finish(newton, problem, sticks_everywhere)
    end subroutine solve_newton

    pure subroutine bring_back(p, bound)
        real(wp), intent(inout) :: p(2)
        real(wp), intent(in) :: bound

        real(wp) :: size

        size = sqrt(p(1)**2 + p(2)**2)
        if (size > bound) p = p*(bound/size)
    end subroutine bring_back

    !> Slip, states and |F| of the tractions `newton%p`.
    subroutine evaluate(newton, problem, sticks_everywhere, may_extrapolate, norm, without_elastic)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(inout) :: problem
        logical, intent(in) :: sticks_everywhere, may_extrapolate
        real(wp), intent(out) :: norm
        logical, intent(in), optional :: without_elastic

        integer :: i
        real(wp) :: t(2), f(2)

        if (present(without_elastic)) then
            newton%node = problem%rigid(:, :problem%n)
        else
            call node_slip(problem, newton%p, newton%node)
            newton%products = newton%products + 1
        end if
        if (may_extrapolate .and. problem%is_second_order) then
            do i = 1, problem%n
                t = newton%p(:, i) - newton%r(i)*newton%node(:, i)
                newton%sticks(i) = t(1)**2 + t(2)**2 <= newton%bound(i)**2 .or. sticks_everywhere
            end do
            newton%is_extrapolated = .false.
            do i = 2, problem%n
                newton%is_extrapolated(i) = .not. (problem%is_leading(i) .or. newton%sticks(i) &
                                                   .or. newton%sticks(i - 1))
            end do
        end if
        call extrapolate(newton%is_extrapolated, newton%node, newton%slip)
        norm = 0.0_wp
        do i = 1, problem%n
            t = newton%p(:, i) - newton%r(i)*newton%slip(:, i)
            newton%size_t(i) = sqrt(t(1)**2 + t(2)**2)
            newton%sticks(i) = newton%size_t(i) <= newton%bound(i) .or. sticks_everywhere
            if (newton%sticks(i)) then
                f = newton%r(i)*newton%slip(:, i)
            else
                newton%along(:, i) = t/newton%size_t(i)
                f = newton%p(:, i) - newton%bound(i)*newton%along(:, i)
            end if
            norm = norm + f(1)**2 + f(2)**2
        end do
        norm = sqrt(norm)
    end subroutine evaluate

    !> Slip at the elements from that at their nodes.
    pure subroutine extrapolate(is_extrapolated, node, slip)
        logical, intent(in) :: is_extrapolated(:)
        real(wp), intent(in) :: node(:, :)
        real(wp), intent(inout) :: slip(:, :)

        integer :: i

        do i = 1, size(is_extrapolated)
            if (is_extrapolated(i)) then
                ! Given: second-order extrapolation
                slip(:, i) = 1.5_wp*node(:, i) - 0.5_wp*node(:, i - 1)
            else
                slip(:, i) = node(:, i)
            end if
        end do
    end subroutine extrapolate

    !> Newton's step into `newton%change`.
    subroutine find_step(newton, problem, demand, info)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(inout) :: problem
        real(wp), intent(in) :: demand
        integer, intent(out) :: info

        integer :: i, m
        real(wp) :: short

        m = 1
        do i = 1, problem%n
            newton%unknown(i) = m
            if (newton%sticks(i)) then
                newton%change(:, i) = 0.0_wp
                m = m + 2
            else
                newton%tangent(:, i) = [-newton%along(2, i), newton%along(1, i)]
                newton%resistance(i) = (newton%size_t(i) - newton%bound(i)) &
                                       /(newton%bound(i)*newton%r(i))
                short = newton%bound(i) - dot_product(newton%along(:, i), newton%p(:, i))
                newton%change(:, i) = short*newton%along(:, i)
                m = m + 1
            end if
        end do
        newton%unknown(problem%n + 1) = m
        m = m - 1
        call factor_rows(newton%rows, problem, newton%unknown, newton%tangent, newton%resistance, &
                         newton%is_extrapolated, info)
        if (info /= 0) return
        ! Slip as it will be by what is known already, and the bound's turning.
        call apply_influence(problem, newton%change, newton%node)
        newton%products = newton%products + 1
        call extrapolate(newton%is_extrapolated, newton%node, newton%trial)
        do i = 1, problem%n
            associate (k => newton%unknown(i))
                if (newton%sticks(i)) then
                    newton%right(k:k + 1) = -newton%slip(:, i) - newton%trial(:, i)
                else
                    newton%right(k) = -dot_product(newton%tangent(:, i), newton%p(:, i)) &
                                      *(newton%resistance(i) + 1.0_wp/newton%r(i)) &
                                      - dot_product(newton%tangent(:, i), newton%trial(:, i))
                end if
            end associate
        end do
        call gmres(newton, problem, m, demand)
        do i = 1, problem%n
            associate (k => newton%unknown(i))
                if (newton%sticks(i)) then
                    newton%change(:, i) = newton%step(k:k + 1)
                else
                    newton%change(:, i) = newton%change(:, i) + newton%step(k)*newton%tangent(:, i)
                end if
            end associate
        end do
    end subroutine find_step

    !> Product of the step's matrix with v.
    subroutine multiply(newton, problem, v, product)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(inout) :: problem
        real(wp), intent(in) :: v(:)
        real(wp), intent(inout) :: product(:)

        integer :: i

        do i = 1, problem%n
            associate (k => newton%unknown(i))
                if (newton%sticks(i)) then
                    newton%trial(:, i) = v(k:k + 1)
                else
                    newton%trial(:, i) = v(k)*newton%tangent(:, i)
                end if
            end associate
        end do
        call apply_influence(problem, newton%trial, newton%node)
        newton%products = newton%products + 1
        call extrapolate(newton%is_extrapolated, newton%node, newton%trial)
        do i = 1, problem%n
            associate (k => newton%unknown(i))
                if (newton%sticks(i)) then
                    product(k:k + 1) = newton%trial(:, i)
                else
                    product(k) = newton%resistance(i)*v(k) &
                                 + dot_product(newton%tangent(:, i), newton%trial(:, i))
                end if
            end associate
        end do
    end subroutine multiply

    !> Solve for `newton%step` by GMRES, preconditioned from the right.
    subroutine gmres(newton, problem, m, demand)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(inout) :: problem
        integer, intent(in) :: m           !! number of unknowns
        real(wp), intent(in) :: demand     !! residual over the right-hand side

        real(wp) :: h(most_vectors + 1, most_vectors), cosine(most_vectors), sine(most_vectors)
        real(wp) :: rest(most_vectors + 1), beta, t
        integer :: j, i, last

        newton%step(:m) = 0.0_wp
        beta = norm_of(newton%right(:m))
        if (beta <= 0.0_wp) return
        newton%basis(:m, 1) = newton%right(:m)/beta
        rest = 0.0_wp
        rest(1) = beta
        last = 0
        do j = 1, most_vectors
            newton%iterations = newton%iterations + 1
            newton%work(:m) = newton%basis(:m, j)
            call solve_rows(newton%rows, problem, newton%unknown, newton%tangent, &
                            newton%is_extrapolated, newton%work(:m))
            call multiply(newton, problem, newton%work(:m), newton%basis(:m, j + 1))
            do i = 1, j
                h(i, j) = product_of(newton%basis(:m, i), newton%basis(:m, j + 1))
                newton%basis(:m, j + 1) = newton%basis(:m, j + 1) - h(i, j)*newton%basis(:m, i)
            end do
            h(j + 1, j) = norm_of(newton%basis(:m, j + 1))
            if (h(j + 1, j) > 0.0_wp) &
                newton%basis(:m, j + 1) = newton%basis(:m, j + 1)/h(j + 1, j)
            do i = 1, j - 1
                t = cosine(i)*h(i, j) + sine(i)*h(i + 1, j)
                h(i + 1, j) = cosine(i)*h(i + 1, j) - sine(i)*h(i, j)
                h(i, j) = t
            end do
            t = hypot(h(j, j), h(j + 1, j))
            if (t <= 0.0_wp) exit
            last = j
            cosine(j) = h(j, j)/t
            sine(j) = h(j + 1, j)/t
            h(j, j) = t
            rest(j + 1) = -sine(j)*rest(j)
            rest(j) = cosine(j)*rest(j)
            if (abs(rest(j + 1)) <= demand*beta .or. sine(j) <= 0.0_wp) exit
        end do
        if (last == 0) return
        do i = last, 1, -1
            rest(i) = (rest(i) - dot_product(h(i, i + 1:last), rest(i + 1:last)))/h(i, i)
        end do
        newton%work(:m) = rest(1)*newton%basis(:m, 1)
        do i = 2, last
            newton%work(:m) = newton%work(:m) + rest(i)*newton%basis(:m, i)
        end do
        call solve_rows(newton%rows, problem, newton%unknown, newton%tangent, &
                        newton%is_extrapolated, newton%work(:m))
        newton%step(:m) = newton%work(:m)
    end subroutine gmres

    pure real(wp) function product_of(a, b)
        real(wp), intent(in), contiguous :: a(:), b(:)

        integer :: i

        product_of = 0.0_wp
        !$omp simd reduction(+:product_of)
        do i = 1, size(a)
            product_of = product_of + a(i)*b(i)
        end do
    end function product_of

    pure real(wp) function norm_of(a)
        real(wp), intent(in), contiguous :: a(:)

        norm_of = sqrt(product_of(a, a))
    end function norm_of

    !> Put tractions onto their bounds and slips to zero where the states say so.
    pure subroutine finish(newton, problem, sticks_everywhere)
        type(newton_t), intent(inout) :: newton
        type(problem_t), intent(in) :: problem
        logical, intent(in) :: sticks_everywhere

        integer :: i
        real(wp) :: size

        do i = 1, problem%n
            if (newton%sticks(i)) then
                newton%slip(:, i) = 0.0_wp
                if (.not. sticks_everywhere) call bring_back(newton%p(:, i), newton%bound(i))
            else
                ! Against the slip, unless there is as good as none.
                size = norm2(newton%slip(:, i))
                newton%p(:, i) = newton%bound(i)*newton%along(:, i)
                newton%slip(:, i) = -size*newton%along(:, i)
            end if
        end do
    end subroutine finish
end module faststrip_kalker_tangential_newton
