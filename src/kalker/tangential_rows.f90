!> The preconditioner of TANG: rows of elements on their own, solved by LU in blocks.
!>
!> Within a row px acts on sx and py on sy alone; they are coupled where elements slide, for the
!> traction of such an element turns along its bound and has one unknown. A row is cut into blocks
!> of at most `block_elements`, two matrices if all its elements stick; a block sees those ahead of
!> it, not those behind, for rolling slip depends on what is ahead above all.
module faststrip_kalker_tangential_rows
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_lapack, only: dgetrf, dgetrs
    use faststrip_kalker_tangential_problem, only: problem_t
    implicit none
    private

    public :: rows_t, size_rows, factor_rows, solve_rows

    !> Most elements of a block.
    !> Tuned [elements]. Origin: chosen for the time: what fits the cache.
    integer, parameter :: block_elements = 48

    !> Blocks, their factors and the place of their unknowns.
    type :: rows_t
        integer :: n_blocks = 0
        integer, allocatable :: first(:)    !! first element of a block; of one beyond: n + 1
        integer, allocatable :: start(:)    !! where the factors of a block start
        integer, allocatable :: pivots(:)   !! of all blocks, by unknowns
        real(wp), allocatable :: factors(:) !! of all blocks
    end type rows_t

contains

    !> Cut the rows into blocks and make capacity.
    subroutine size_rows(rows, problem)
        type(rows_t), intent(inout) :: rows      !! blocks with their sizes
        type(problem_t), intent(in) :: problem   !! made

        integer :: row, first, n, parts, part, most, capacity

        most = problem%n_rows + problem%n/block_elements + 1
        if (allocated(rows%first)) then
            if (size(rows%first) < most + 1) deallocate (rows%first, rows%start)
        end if
        if (.not. allocated(rows%first)) allocate (rows%first(most + 1), rows%start(most + 1), &
                                                   source=0)
        rows%n_blocks = 0
        capacity = 0
        do row = 1, problem%n_rows
            first = problem%row_start(row)
            n = problem%row_start(row + 1) - first
            parts = (n + block_elements - 1)/block_elements
            do part = 1, parts
                rows%n_blocks = rows%n_blocks + 1
                rows%first(rows%n_blocks) = first + (n*(part - 1))/parts
                rows%start(rows%n_blocks) = capacity + 1
                capacity = capacity + (2*((n*part)/parts - (n*(part - 1))/parts))**2
            end do
        end do
        rows%first(rows%n_blocks + 1) = problem%n + 1
        if (allocated(rows%factors)) then
            if (size(rows%factors) < capacity) deallocate (rows%factors)
        end if
        if (.not. allocated(rows%factors)) allocate (rows%factors(capacity), source=0.0_wp)
        if (allocated(rows%pivots)) then
            if (size(rows%pivots) < 2*problem%n) deallocate (rows%pivots)
        end if
        if (.not. allocated(rows%pivots)) allocate (rows%pivots(2*problem%n), source=0)
    end subroutine size_rows

    !> Factor all blocks for the present states.
    !>
    !> Unknowns stand in the order of the elements, `unknown(i)` the first of element i: two for one
    !> in adhesion, the tractions' changes; one for one that slides, the change along `tangent(:,
    !> i)`.
    subroutine factor_rows(rows, problem, unknown, tangent, resistance, is_carried, info)
        type(rows_t), intent(inout) :: rows       !! factored
        type(problem_t), intent(in) :: problem    !! made
        integer, intent(in) :: unknown(:)         !! of element n + 1: one beyond the last
        real(wp), intent(in) :: tangent(:, :)        !! direction along the bound, shape (2, n)
        real(wp), intent(in) :: resistance(:)     !! slip by turning the traction alone, 1/MPa
        logical, intent(in) :: is_carried(:)      !! is slip carried from node to middle?
        integer, intent(out) :: info              !! not 0: a singular block

        integer :: block, from, to, m

        info = 0
        do block = 1, rows%n_blocks
            from = rows%first(block)
            to = rows%first(block + 1) - 1
            m = unknown(to + 1) - unknown(from)
            if (m == 2*(to - from + 1)) then
                call factor_stuck(problem, is_carried, from, to, m/2, &
                                  rows%factors(rows%start(block):rows%start(block) + m*m/2 - 1), &
                                  rows%pivots(unknown(from):unknown(from) + m - 1), info)
                if (info /= 0) return
                cycle
            end if
            associate (a => rows%factors(rows%start(block):rows%start(block) + m*m - 1))
                call fill(problem, unknown, tangent, resistance, is_carried, from, to, m, a)
                call dgetrf(m, m, a, m, rows%pivots(unknown(from):unknown(from) + m - 1), info)
            end associate
            if (info /= 0) return
        end do
    end subroutine factor_rows

    !> Factor a block that sticks: one matrix along x, one along y.
    pure subroutine factor_stuck(problem, is_carried, from, to, n, a, pivots, info)
        type(problem_t), intent(in) :: problem
        logical, intent(in) :: is_carried(:)
        integer, intent(in) :: from, to, n
        real(wp), intent(inout) :: a(n, n, 2)
        integer, intent(inout) :: pivots(n, 2)
        integer, intent(out) :: info

        integer :: i, k

        do i = from, to
            do k = from, to
                a(k - from + 1, i - from + 1, :) = between(problem, is_carried, i, k)
            end do
        end do
        call dgetrf(n, n, a(:, :, 1), n, pivots(:, 1), info)
        if (info == 0) call dgetrf(n, n, a(:, :, 2), n, pivots(:, 2), info)
    end subroutine factor_stuck

    !> The matrix of elements `from` to `to`, column by column.
    pure subroutine fill(problem, unknown, tangent, resistance, is_carried, from, to, m, a)
        type(problem_t), intent(in) :: problem
        integer, intent(in) :: unknown(:), from, to, m
        real(wp), intent(in) :: tangent(:, :), resistance(:)
        logical, intent(in) :: is_carried(:)
        real(wp), intent(inout) :: a(m, m)

        integer :: i, k, row, column, axis
        real(wp) :: b(2)

        do i = from, to
            column = unknown(i) - unknown(from) + 1
            if (unknown(i + 1) - unknown(i) == 2) then
                do k = from, to
                    row = unknown(k) - unknown(from) + 1
                    b = between(problem, is_carried, i, k)
                    if (unknown(k + 1) - unknown(k) == 2) then
                        a(row, column) = b(1)
                        a(row + 1, column) = 0.0_wp
                        a(row, column + 1) = 0.0_wp
                        a(row + 1, column + 1) = b(2)
                    else
                        do axis = 1, 2
                            a(row, column + axis - 1) = tangent(axis, k)*b(axis)
                        end do
                    end if
                end do
            else
                do k = from, to
                    row = unknown(k) - unknown(from) + 1
                    b = between(problem, is_carried, i, k)*tangent(:, i)
                    if (unknown(k + 1) - unknown(k) == 2) then
                        a(row:row + 1, column) = b
                    else
                        a(row, column) = tangent(1, k)*b(1) + tangent(2, k)*b(2)
                        if (k == i) a(row, column) = a(row, column) + resistance(k)
                    end if
                end do
            end if
        end do
    end subroutine fill

    !> Slip of element k by unit traction on element i of the same row.
    pure function between(problem, is_carried, i, k) result(b)
        type(problem_t), intent(in) :: problem
        logical, intent(in) :: is_carried(:)
        integer, intent(in) :: i, k
        real(wp) :: b(2)

        integer :: d

        d = problem%column(k) - problem%column(i)
        b = problem%own_row(:, d)
        if (k == i) b = b + problem%edge(:, i)
        if (.not. is_carried(k)) return
        b = 1.5_wp*b - 0.5_wp*problem%own_row(:, d + 1) ! Given: second-order extrapolation
        if (i == k - 1) b = b - 0.5_wp*problem%edge(:, i)
    end function between

    !> Solve with the factored blocks, each with what the blocks ahead of it in its row cause.
    subroutine solve_rows(rows, problem, unknown, tangent, is_carried, v)
        type(rows_t), intent(in) :: rows          !! factored
        type(problem_t), intent(in) :: problem    !! made
        integer, intent(in) :: unknown(:)         !! as for `factor_rows`
        real(wp), intent(in) :: tangent(:, :)        !! as for `factor_rows`
        logical, intent(in) :: is_carried(:)      !! as for `factor_rows`
        real(wp), intent(inout), contiguous :: v(:) !! right-hand side, then solution

        integer :: block, from, to, m, i, k, row_first
        real(wp) :: b(2), p(2)

        row_first = 1
        do block = 1, rows%n_blocks
            from = rows%first(block)
            to = rows%first(block + 1) - 1
            if (problem%row(from) /= problem%row(row_first)) row_first = from
            do i = row_first, from - 1
                if (unknown(i + 1) - unknown(i) == 2) then
                    p = v(unknown(i):unknown(i) + 1)
                else
                    p = v(unknown(i))*tangent(:, i)
                end if
                do k = from, to
                    b = between(problem, is_carried, i, k)*p
                    if (unknown(k + 1) - unknown(k) == 2) then
                        v(unknown(k):unknown(k) + 1) = v(unknown(k):unknown(k) + 1) - b
                    else
                        v(unknown(k)) = v(unknown(k)) - tangent(1, k)*b(1) - tangent(2, k)*b(2)
                    end if
                end do
            end do
            m = unknown(to + 1) - unknown(from)
            if (m == 2*(to - from + 1)) then
                call solve_stuck(m/2, &
                                 rows%factors(rows%start(block):rows%start(block) + m*m/2 - 1), &
                                 rows%pivots(unknown(from):unknown(from) + m - 1), &
                                 v(unknown(from):unknown(from) + m - 1))
                cycle
            end if
            associate (a => rows%factors(rows%start(block):rows%start(block) + m*m - 1), &
                       pivots => rows%pivots(unknown(from):unknown(from) + m - 1))
                call solve_block(m, a, pivots, v(unknown(from):unknown(from) + m - 1))
            end associate
        end do
    end subroutine solve_rows

    pure subroutine solve_stuck(n, a, pivots, v)
        integer, intent(in) :: n
        real(wp), intent(in) :: a(n, n, 2)
        integer, intent(in) :: pivots(n, 2)
        real(wp), intent(inout) :: v(2, n)

        real(wp) :: part(n, 1)
        integer :: axis, info

        do axis = 1, 2
            part(:, 1) = v(axis, :)
            call dgetrs('N', n, 1, a(:, :, axis), n, pivots(:, axis), part, n, info)
            v(axis, :) = part(:, 1)
        end do
    end subroutine solve_stuck

    pure subroutine solve_block(m, a, pivots, v)
        integer, intent(in) :: m
        real(wp), intent(in) :: a(m, m)
        integer, intent(in) :: pivots(m)
        real(wp), intent(inout) :: v(m, 1)

        integer :: info

        call dgetrs('N', m, 1, a, m, pivots, v, m, info)
    end subroutine solve_block
end module faststrip_kalker_tangential_rows
