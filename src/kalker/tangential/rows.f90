!> The preconditioner of TANG: rows of elements on their own, solved in blocks by their inverses.
!>
!> Within a row px acts on sx and py on sy alone; they are coupled where elements slide, for the
!> traction of such an element turns along its bound and has one unknown. A row is cut into blocks
!> of at most `block_elements`, two matrices if all its elements stick; a block sees those ahead of
!> it, not those behind, for rolling slip depends on what is ahead above all.
!>
!> Inverses are in single precision, of matrices over the element's own compliance: they only
!> precondition. A block is inverted again if states in it changed, tractions turned or resistances
!> changed noticeably. What blocks ahead cause is summed by columns, for the influence depends on
!> distances alone.
module faststrip_kalker_tangential_rows
    use faststrip_base_kinds, only: wp
    use faststrip_kalker_single, only: sp, sgemv, sgetrf, sgetri
    use faststrip_kalker_tangential_problem, only: problem_t
    implicit none
    private

    public :: rows_t, size_rows, factor_rows, solve_rows, block_elements

    !> Most elements of a block.
    !> Tuned [elements]. Origin: chosen for the time; larger ones take fewer iterations.
    integer, parameter :: block_elements = 40
    ! Largest change of a sliding element's direction, and of its resistance over the sum with the
    ! own compliance, by which an inverse serves on.
    ! Tuned [1]. Origin: chosen for the time.
    real(wp), parameter :: least_change = 0.3_wp

    !> Blocks, their inverses and what these were made for.
    type :: rows_t
        integer :: n_blocks = 0
        integer :: inversions = 0            !! of blocks, since `size_rows`
        integer, allocatable :: first(:)     !! first element of a block; of one beyond: n + 1
        integer, allocatable :: start(:)     !! where the inverse of a block starts
        logical, allocatable :: is_ready(:)  !! is there an inverse of the block?
        real(sp), allocatable :: inverse(:)  !! of all blocks
        real(wp), allocatable :: column_scale(:) !! of the unknowns' columns, by elements
        logical, allocatable :: stuck(:)     !! state of an element when its block was inverted
        logical, allocatable :: extrapolated(:) !! `is_extrapolated` then
        real(wp), allocatable :: turned(:, :) !! tangent then
        real(wp), allocatable :: resisted(:) !! resistance over the own compliance then
        real(sp), allocatable :: own_x(:)    !! `own_row` over the own compliance, -nx to nx
        real(sp), allocatable :: own_y(:)
        real(sp), allocatable :: px(:), py(:) !! tractions of a row, by columns
        real(sp), allocatable :: sx(:), sy(:) !! slips of a row, by columns
        real(sp), allocatable :: right(:), left(:) !! of a block
        real(sp), allocatable :: work(:)
        integer, allocatable :: pivots(:)
        real(wp) :: unit = 0.0_wp            !! own compliance, 1/MPa
    end type rows_t

contains

    !> Cut the rows into blocks and make capacity; no block is inverted yet.
    subroutine size_rows(rows, problem)
        type(rows_t), intent(inout) :: rows      !! blocks with their sizes
        type(problem_t), intent(in) :: problem   !! made

        integer :: row, first, n, parts, part, most, capacity, elements

        most = problem%n_rows + problem%n/block_elements + 1
        if (allocated(rows%first)) then
            if (size(rows%first) < most + 1) deallocate (rows%first, rows%start, rows%is_ready)
        end if
        if (.not. allocated(rows%first)) then
            allocate (rows%first(most + 1), rows%start(most + 1), source=0)
            allocate (rows%is_ready(most + 1), source=.false.)
        end if
        rows%n_blocks = 0
        rows%inversions = 0
        capacity = 0
        do row = 1, problem%n_rows
            first = problem%row_start(row)
            n = problem%row_start(row + 1) - first
            parts = (n + block_elements - 1)/block_elements
            do part = 1, parts
                rows%n_blocks = rows%n_blocks + 1
                elements = (n*part)/parts - (n*(part - 1))/parts
                rows%first(rows%n_blocks) = first + (n*(part - 1))/parts
                rows%start(rows%n_blocks) = capacity + 1
                capacity = capacity + (2*elements)**2
            end do
        end do
        rows%first(rows%n_blocks + 1) = problem%n + 1
        rows%is_ready = .false.
        if (allocated(rows%inverse)) then
            if (size(rows%inverse) < capacity) deallocate (rows%inverse)
        end if
        if (.not. allocated(rows%inverse)) allocate (rows%inverse(capacity), source=0.0_sp)
        if (allocated(rows%stuck)) then
            if (size(rows%stuck) < problem%n) &
                deallocate (rows%stuck, rows%extrapolated, rows%turned, rows%resisted, &
                            rows%column_scale)
        end if
        if (.not. allocated(rows%stuck)) then
            allocate (rows%stuck(problem%n), rows%extrapolated(problem%n), source=.false.)
            allocate (rows%turned(2, problem%n), rows%resisted(problem%n), &
                      rows%column_scale(problem%n), source=0.0_wp)
        end if
        if (allocated(rows%own_x)) then
            if (size(rows%own_x) /= 2*problem%nx + 1) &
                deallocate (rows%own_x, rows%own_y, rows%px, rows%py, rows%sx, rows%sy)
        end if
        if (.not. allocated(rows%own_x)) then
            allocate (rows%own_x(-problem%nx:problem%nx), rows%own_y(-problem%nx:problem%nx), &
                      rows%px(problem%nx), rows%py(problem%nx), rows%sx(problem%nx), &
                      rows%sy(problem%nx), source=0.0_sp)
        end if
        if (.not. allocated(rows%right)) then
            allocate (rows%right(2*block_elements), rows%left(2*block_elements), &
                      rows%work((2*block_elements)**2), source=0.0_sp)
            allocate (rows%pivots(2*block_elements), source=0)
        end if
        rows%unit = problem%own_row(1, 0)
        rows%own_x = real(problem%own_row(1, :)/rows%unit, sp)
        rows%own_y = real(problem%own_row(2, :)/rows%unit, sp)
    end subroutine size_rows

    !> Invert the blocks for the present states, as far as they changed.
    !>
    !> Unknowns stand in the order of the elements, `unknown(i)` the first of element i: two for one
    !> in adhesion, the tractions' changes; one for one that slides, the change along `tangent(:,
    !> i)`.
    subroutine factor_rows(rows, problem, unknown, tangent, resistance, is_extrapolated, info)
        type(rows_t), intent(inout) :: rows       !! inverted
        type(problem_t), intent(in) :: problem    !! made
        integer, intent(in) :: unknown(:)         !! of element n + 1: one beyond the last
        real(wp), intent(in) :: tangent(:, :)     !! direction along the bound, shape (2, n)
        real(wp), intent(in) :: resistance(:)     !! slip by turning the traction alone, 1/MPa
        logical, intent(in) :: is_extrapolated(:)      !! is slip extrapolated from node to middle?
        integer, intent(out) :: info              !! not 0: a singular block

        integer :: block, from, to, n, m, i

        info = 0
        do block = 1, rows%n_blocks
            from = rows%first(block)
            to = rows%first(block + 1) - 1
            if (rows%is_ready(block)) then
                if (serves_on()) cycle
            end if
            rows%is_ready(block) = .false.
            do i = from, to
                rows%stuck(i) = unknown(i + 1) - unknown(i) == 2
                rows%extrapolated(i) = is_extrapolated(i)
                rows%column_scale(i) = 1.0_wp
                if (rows%stuck(i)) cycle
                rows%turned(:, i) = tangent(:, i)
                rows%resisted(i) = resistance(i)/rows%unit
                rows%column_scale(i) = 1.0_wp/(1.0_wp + rows%resisted(i))
            end do
            n = to - from + 1
            m = unknown(to + 1) - unknown(from)
            associate (start => rows%start(block))
                if (m == 2*n) then
                    call fill_stuck(rows, problem, from, to, n, &
                                    rows%inverse(start:start + 2*n*n - 1))
                    call invert(rows, n, rows%inverse(start:start + n*n - 1), info)
                    if (info == 0) call invert(rows, n, rows%inverse(start + n*n: &
                                                                     start + 2*n*n - 1), info)
                else
                    call fill(rows, problem, unknown, from, to, m, &
                              rows%inverse(start:start + m*m - 1))
                    call invert(rows, m, rows%inverse(start:start + m*m - 1), info)
                end if
            end associate
            if (info /= 0) return
            rows%is_ready(block) = .true.
            rows%inversions = rows%inversions + 1
        end do

    contains

        !> Is the inverse that is there near enough?
        pure logical function serves_on()
            integer :: k

            serves_on = .false.
            do k = from, to
                if (rows%stuck(k) .neqv. unknown(k + 1) - unknown(k) == 2) return
                if (rows%extrapolated(k) .neqv. is_extrapolated(k)) return
                if (rows%stuck(k)) cycle
                if (sum((rows%turned(:, k) - tangent(:, k))**2) > least_change**2) return
                if (abs(resistance(k) - rows%resisted(k)*rows%unit) > &
                    least_change*(rows%unit + resistance(k))) return
            end do
            serves_on = .true.
        end function serves_on
    end subroutine factor_rows

    !> Inverse of a matrix in its place.
    subroutine invert(rows, m, a, info)
        type(rows_t), intent(inout) :: rows
        integer, intent(in) :: m
        real(sp), intent(inout) :: a(m, m)
        integer, intent(out) :: info

        call sgetrf(m, m, a, m, rows%pivots, info)
        if (info == 0) call sgetri(m, a, m, rows%pivots, rows%work, size(rows%work), info)
    end subroutine invert

    !> The matrices along x and along y of a block that sticks.
    pure subroutine fill_stuck(rows, problem, from, to, n, a)
        type(rows_t), intent(in) :: rows
        type(problem_t), intent(in) :: problem
        integer, intent(in) :: from, to, n
        real(sp), intent(inout) :: a(n, n, 2)

        integer :: i, k

        do i = from, to
            associate (c => problem%column)
                do k = from, to
                    a(k - from + 1, i - from + 1, 1) = rows%own_x(c(k) - c(i))
                    a(k - from + 1, i - from + 1, 2) = rows%own_y(c(k) - c(i))
                end do
            end associate
            associate (own => a(i - from + 1, i - from + 1, :))
                own = own + real(problem%edge(:, i)/rows%unit, sp)
            end associate
        end do
    end subroutine fill_stuck

    !> The matrix of elements `from` to `to`, column by column, as `rows` keeps them.
    pure subroutine fill(rows, problem, unknown, from, to, m, a)
        type(rows_t), intent(in) :: rows
        type(problem_t), intent(in) :: problem
        integer, intent(in) :: unknown(:), from, to, m
        real(sp), intent(inout) :: a(m, m)

        integer :: i, k, row, column
        real(sp) :: b(2), t(2)

        do i = from, to
            column = unknown(i) - unknown(from) + 1
            if (.not. rows%stuck(i)) t = real(rows%column_scale(i)*rows%turned(:, i), sp)
            do k = from, to
                row = unknown(k) - unknown(from) + 1
                b = between(i, k)
                if (rows%stuck(i)) then
                    if (rows%stuck(k)) then
                        a(row, column) = b(1)
                        a(row + 1, column) = 0.0_sp
                        a(row, column + 1) = 0.0_sp
                        a(row + 1, column + 1) = b(2)
                    else
                        a(row, column) = real(rows%turned(1, k), sp)*b(1)
                        a(row, column + 1) = real(rows%turned(2, k), sp)*b(2)
                    end if
                else if (rows%stuck(k)) then
                    a(row, column) = b(1)*t(1)
                    a(row + 1, column) = b(2)*t(2)
                else
                    a(row, column) = real(rows%turned(1, k), sp)*b(1)*t(1) &
                                     + real(rows%turned(2, k), sp)*b(2)*t(2)
                    if (k == i) a(row, column) = a(row, column) &
                                                 + real(rows%column_scale(i)*rows%resisted(i), sp)
                end if
            end do
        end do

    contains

        !> Slip of element k by unit traction on element i of the same row.
        pure function between(i, k) result(b)
            integer, intent(in) :: i, k
            real(sp) :: b(2)

            integer :: d

            d = problem%column(k) - problem%column(i)
            b = [rows%own_x(d), rows%own_y(d)]
            if (k == i) b = b + real(problem%edge(:, i)/rows%unit, sp)
            if (.not. rows%extrapolated(k)) return
            ! Given: second-order extrapolation
            b = 1.5_sp*b - 0.5_sp*[rows%own_x(d + 1), rows%own_y(d + 1)]
            if (i == k - 1) b = b - 0.5_sp*real(problem%edge(:, i)/rows%unit, sp)
        end function between
    end subroutine fill

    !> Solve with the inverted blocks, each with what the blocks ahead of it in its row cause.
    subroutine solve_rows(rows, problem, unknown, tangent, is_extrapolated, v)
        type(rows_t), intent(inout) :: rows       !! inverted; capacity to work in
        type(problem_t), intent(in) :: problem    !! made
        integer, intent(in) :: unknown(:)         !! as for `factor_rows`
        real(wp), intent(in) :: tangent(:, :)     !! as for `factor_rows`
        logical, intent(in) :: is_extrapolated(:)      !! as for `factor_rows`
        real(wp), intent(inout), contiguous :: v(:) !! right-hand side, then solution

        integer :: block, from, to, row_first, i
        real(wp) :: scale

        scale = 0.0_wp
        !$omp simd reduction(+:scale)
        do i = 1, size(v)
            scale = scale + v(i)**2
        end do
        scale = sqrt(scale)
        if (scale <= tiny(scale)) return
        row_first = 1
        do block = 1, rows%n_blocks
            from = rows%first(block)
            to = rows%first(block + 1) - 1
            if (problem%row(from) /= problem%row(row_first)) row_first = from
            if (from == row_first) then
                rows%px = 0.0_sp
                rows%py = 0.0_sp
            end if
            call solve_block(rows, problem, unknown, tangent, is_extrapolated, block, &
                             problem%column(row_first), scale, v)
        end do
    end subroutine solve_rows

    !> One block, with the tractions of those ahead in `rows%px`, `rows%py`.
    subroutine solve_block(rows, problem, unknown, tangent, is_extrapolated, block, ahead, scale, v)
        type(rows_t), intent(inout) :: rows
        type(problem_t), intent(in) :: problem
        integer, intent(in) :: unknown(:)
        real(wp), intent(in) :: tangent(:, :)
        logical, intent(in) :: is_extrapolated(:)
        integer, intent(in) :: block  ! which
        integer, intent(in) :: ahead  ! leading column of its row
        real(wp), intent(in) :: scale ! of v
        real(wp), intent(inout) :: v(:)

        integer :: from, to, n, m, k, c, u, row
        real(sp) :: s(2), p(2)
        real(wp) :: x, shrink, stretch

        shrink = 1.0_wp/scale
        stretch = scale/rows%unit
        from = rows%first(block)
        to = rows%first(block + 1) - 1
        n = to - from + 1
        m = unknown(to + 1) - unknown(from)
        associate (last => problem%column(to), leading => problem%column(from), &
                   right => rows%right, left => rows%left, start => rows%start(block))
            if (leading < ahead) call add_slips(rows, last, leading, ahead)
            s = 0.0_sp
            do k = from, to
                if (leading < ahead) then
                    c = problem%column(k)
                    s = [rows%sx(c), rows%sy(c)]
                    if (is_extrapolated(k)) then
                        ! Given: second-order extrapolation
                        s = 1.5_sp*s - 0.5_sp*[rows%sx(c + 1), rows%sy(c + 1)]
                        if (k == from) s = s - 0.5_sp*real(problem%edge(:, k - 1)/rows%unit, sp) &
                                               *[rows%px(c + 1), rows%py(c + 1)]
                    end if
                end if
                u = unknown(k)
                row = u - unknown(from) + 1
                if (m == 2*n) then
                    right(k - from + 1) = real(v(u)*shrink, sp) - s(1)
                    right(n + k - from + 1) = real(v(u + 1)*shrink, sp) - s(2)
                else if (unknown(k + 1) - u == 2) then
                    right(row) = real(v(u)*shrink, sp) - s(1)
                    right(row + 1) = real(v(u + 1)*shrink, sp) - s(2)
                else
                    right(row) = real(v(u)*shrink - tangent(1, k)*s(1) - tangent(2, k)*s(2), sp)
                end if
            end do
            if (m == 2*n) then
                call sgemv('N', n, n, 1.0_sp, rows%inverse(start:), n, right, 1, 0.0_sp, left, 1)
                call sgemv('N', n, n, 1.0_sp, rows%inverse(start + n*n:), n, right(n + 1:), 1, &
                           0.0_sp, left(n + 1:), 1)
            else
                call sgemv('N', m, m, 1.0_sp, rows%inverse(start:), m, right, 1, 0.0_sp, left, 1)
            end if
            do k = from, to
                u = unknown(k)
                row = u - unknown(from) + 1
                if (m == 2*n) then
                    p = [left(k - from + 1), left(n + k - from + 1)]
                else if (unknown(k + 1) - u == 2) then
                    p = left(row:row + 1)
                else
                    x = rows%column_scale(k)*left(row)
                    v(u) = stretch*x
                    p = real(x*tangent(:, k), sp)
                end if
                if (unknown(k + 1) - u == 2) v(u:u + 1) = stretch*p
                rows%px(problem%column(k)) = p(1)
                rows%py(problem%column(k)) = p(2)
            end do
        end associate
    end subroutine solve_block

    !> Slip of a block's nodes, and of that ahead of them, by what is in the row ahead.
    pure subroutine add_slips(rows, last, leading, ahead)
        type(rows_t), intent(inout) :: rows
        integer, intent(in) :: last, leading ! columns of the block
        integer, intent(in) :: ahead         ! leading column of the row

        integer :: c

        associate (sx => rows%sx(last:leading + 1), sy => rows%sy(last:leading + 1))
            sx = 0.0_sp
            sy = 0.0_sp
            do c = leading + 1, ahead
                sx = sx + rows%px(c)*rows%own_x(last - c:leading + 1 - c)
                sy = sy + rows%py(c)*rows%own_y(last - c:leading + 1 - c)
            end do
        end associate
    end subroutine add_slips
end module faststrip_kalker_tangential_rows
