!> One axis of a lookup table: its nodes, where a value lies among them, and the weights of nodes
!> in linear and cubic interpolation.
!>
!> Cubic interpolation is Hermite's between two nodes, with slopes of the parabolas through three
!> nodes each: once continuously differentiable, exact for parabolas, on nodes of any spacing.
module faststrip_lookup_axis
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: lookup_axis_t, stencil_t, make_axis, make_point, find_cell, linear_stencil
    public :: cubic_stencil
    public :: least_nodes, most_nodes

    !> Least and most nodes of an axis: as many as a cubic stencil takes, and no slip.
    !> Tuned [nodes]. Origin: capacity.
    integer, parameter :: least_nodes = 4, most_nodes = 10000
    ! Tuned [1]: Buckets for each node, to find a cell without a search. Origin: chosen.
    integer, parameter :: buckets_per_node = 8
    ! Tuned [1]: Largest node, and least cell over the length of an axis. Origin: safeguard: nothing
    ! of an axis overflows or loses its digits.
    real(wp), parameter :: largest_node = 1.0e100_wp, least_cell = 1.0e-9_wp

    !> Nodes of an axis, with what finds a cell and the slopes at the nodes.
    type :: lookup_axis_t
        integer :: n = 0                        !! number of nodes
        real(wp), allocatable :: x(:)           !! nodes, strictly increasing
        real(wp), allocatable :: slope(:, :)    !! (3, n) weights of three nodes in the slope
        real(wp), allocatable :: per_length(:)  !! (n - 1) one over the length of each cell
        integer, allocatable :: bucket(:)       !! cell in which each of equal parts begins
        real(wp) :: buckets_per_unit = 0.0_wp   !! to number these parts
    end type lookup_axis_t

    !> Weights of neighbouring nodes in a value and in its derivative.
    type :: stencil_t
        integer :: first = 1         !! the first node
        real(wp) :: w(4) = 0.0_wp    !! weights in the value
        real(wp) :: dw(4) = 0.0_wp   !! weights in the derivative
    end type stencil_t

contains

    !> Make an axis; without nodes where they are none that an axis can have.
    pure subroutine make_axis(x, axis)
        real(wp), intent(in) :: x(:)             !! nodes
        type(lookup_axis_t), intent(out) :: axis !! `n` is 0 if there are too few or too many, or
                                                 !! if they are not finite or not increasing

        real(wp) :: left, right
        integer :: i, j, n

        n = size(x)
        if (n < least_nodes .or. n > most_nodes) return
        if (.not. all(ieee_is_finite(x))) return
        if (maxval(abs(x)) > largest_node) return
        if (.not. x(n) - x(1) > 0.0_wp) return
        if (minval(x(2:) - x(:n - 1)) < least_cell*(x(n) - x(1))) return
        axis%n = n
        axis%x = x
        axis%per_length = 1.0_wp/(x(2:) - x(:n - 1))
        allocate (axis%slope(3, n), axis%bucket(0:buckets_per_node*n))
        do i = 1, n
            j = min(max(i - 1, 1), n - 2)
            left = x(j + 1) - x(j)
            right = x(j + 2) - x(j + 1)
            ! Derivatives at x(i) of Lagrange's parabolas through nodes j, j + 1, j + 2.
            axis%slope(1, i) = (2.0_wp*x(i) - x(j + 1) - x(j + 2))/(left*(left + right))
            axis%slope(2, i) = -(2.0_wp*x(i) - x(j) - x(j + 2))/(left*right)
            axis%slope(3, i) = (2.0_wp*x(i) - x(j) - x(j + 1))/(right*(left + right))
        end do
        axis%buckets_per_unit = buckets_per_node*n/(x(n) - x(1))
        j = 1
        do i = 0, buckets_per_node*n
            do while (j < n - 1 .and. (x(j + 1) - x(1))*axis%buckets_per_unit <= i)
                j = j + 1
            end do
            axis%bucket(i) = j
        end do
    end subroutine make_axis

    !> An axis of one node, along which nothing varies.
    pure subroutine make_point(x, axis)
        real(wp), intent(in) :: x                !! the node
        type(lookup_axis_t), intent(out) :: axis !! without nodes where that is not finite

        if (.not. abs(x) <= largest_node) return
        axis%n = 1
        axis%x = [x]
    end subroutine make_point

    !> The cell, between nodes `cell` and `cell + 1`, of a value between the first and last node.
    pure integer function find_cell(axis, x) result(cell)
        type(lookup_axis_t), intent(in) :: axis !! with nodes
        real(wp), intent(in) :: x               !! within the axis

        cell = axis%bucket(int((x - axis%x(1))*axis%buckets_per_unit))
        do while (cell < axis%n - 1)
            if (x < axis%x(cell + 1)) exit
            cell = cell + 1
        end do
        ! By rounding the bucket may be one too far.
        if (x < axis%x(cell)) cell = max(cell - 1, 1)
    end function find_cell

    !> Weights of the two nodes about a value.
    pure subroutine linear_stencil(axis, x, stencil)
        type(lookup_axis_t), intent(in) :: axis   !! with nodes
        real(wp), intent(in) :: x                 !! within the axis
        type(stencil_t), intent(inout) :: stencil !! two weights

        stencil%first = find_cell(axis, x)
        stencil%dw(2) = axis%per_length(stencil%first)
        stencil%dw(1) = -stencil%dw(2)
        stencil%w(2) = (x - axis%x(stencil%first))*stencil%dw(2)
        stencil%w(1) = 1.0_wp - stencil%w(2)
    end subroutine linear_stencil

    !> Weights of the four nodes about a value.
    pure subroutine cubic_stencil(axis, x, stencil)
        type(lookup_axis_t), intent(in) :: axis   !! with nodes
        real(wp), intent(in) :: x                 !! within the axis
        type(stencil_t), intent(inout) :: stencil !! four weights

        real(wp) :: h, t
        integer :: cell, at

        cell = find_cell(axis, x)
        stencil%first = min(max(cell - 1, 1), axis%n - 3)
        h = axis%x(cell + 1) - axis%x(cell)
        t = (x - axis%x(cell))/h
        stencil%w = 0.0_wp
        stencil%dw = 0.0_wp
        at = cell - stencil%first + 1
        stencil%w(at) = (1.0_wp + 2.0_wp*t)*(1.0_wp - t)**2
        stencil%dw(at) = -6.0_wp*t*(1.0_wp - t)/h
        stencil%w(at + 1) = t*t*(3.0_wp - 2.0_wp*t)
        stencil%dw(at + 1) = -stencil%dw(at)
        call add_slope(axis, cell, h*t*(1.0_wp - t)**2, (1.0_wp - t)*(1.0_wp - 3.0_wp*t), stencil)
        call add_slope(axis, cell + 1, -h*t*t*(1.0_wp - t), t*(3.0_wp*t - 2.0_wp), stencil)
    end subroutine cubic_stencil

    !> Add what the slope at a node does, times factors in the value and in the derivative.
    pure subroutine add_slope(axis, node, factor, slope_factor, stencil)
        type(lookup_axis_t), intent(in) :: axis
        integer, intent(in) :: node
        real(wp), intent(in) :: factor, slope_factor
        type(stencil_t), intent(inout) :: stencil

        integer :: at

        at = min(max(node - 1, 1), axis%n - 2) - stencil%first + 1
        stencil%w(at:at + 2) = stencil%w(at:at + 2) + factor*axis%slope(:, node)
        stencil%dw(at:at + 2) = stencil%dw(at:at + 2) + slope_factor*axis%slope(:, node)
    end subroutine add_slope
end module faststrip_lookup_axis
