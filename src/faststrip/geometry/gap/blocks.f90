!> The nodes of a curve in blocks, each with its lowest and its highest one: a search for a level
!> passes over the blocks that lie on one side of it, and over those without a valley.
module faststrip_geometry_gap_blocks
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: gap_blocks_t, reserve_blocks, set_blocks, copy_blocks, next_across, next_valley
    public :: swap_blocks, swap_reals, extent

    !> Nodes in a block.
    !> Tuned [nodes]. Origin: cost: a search goes through all blocks and through few of the nodes.
    integer, parameter :: block = 32

    !> Blocks of nodes; the arrays belong to the workspace of the curve.
    type :: gap_blocks_t
        real(wp), allocatable :: low(:), high(:) !! heights of the lowest and highest node, mm
        logical, allocatable :: has_valley(:)    !! is a node no higher than both its neighbours?
    end type gap_blocks_t

contains

    !> Allocate for so many nodes.
    subroutine reserve_blocks(blocks, most_nodes)
        type(gap_blocks_t), intent(inout) :: blocks !! emptied and sized
        integer, intent(in) :: most_nodes           !! >= 1

        integer :: n

        n = block_of(most_nodes)
        if (allocated(blocks%low)) deallocate (blocks%low, blocks%high, blocks%has_valley)
        allocate (blocks%low(n), blocks%high(n), source=0.0_wp)
        allocate (blocks%has_valley(n), source=.false.)
    end subroutine reserve_blocks

    !> Take over the heights of all nodes.
    pure subroutine set_blocks(blocks, h)
        type(gap_blocks_t), intent(inout) :: blocks !! reserved beforehand
        real(wp), intent(in) :: h(:)                !! heights of the nodes, mm

        real(wp) :: low, high
        integer :: b, i, first, last, n_valleys

        do b = 1, block_of(size(h))
            first = (b - 1)*block + 1
            last = min(b*block, size(h))
            low = h(first)
            high = low
            do i = first + 1, last
                low = min(low, h(i))
                high = max(high, h(i))
            end do
            blocks%low(b) = low
            blocks%high(b) = high
            n_valleys = 0
            do i = max(first, 2), min(last, size(h) - 1)
                if (h(i) <= min(h(i - 1), h(i + 1))) n_valleys = n_valleys + 1
            end do
            blocks%has_valley(b) = n_valleys > 0
        end do
    end subroutine set_blocks

    !> Take over the blocks of another curve.
    pure subroutine copy_blocks(from, to, n)
        type(gap_blocks_t), intent(in) :: from  !! that were set
        type(gap_blocks_t), intent(inout) :: to !! reserved beforehand
        integer, intent(in) :: n                !! number of nodes

        integer :: blocks

        blocks = block_of(n)
        to%low(:blocks) = from%low(:blocks)
        to%high(:blocks) = from%high(:blocks)
        to%has_valley(:blocks) = from%has_valley(:blocks)
    end subroutine copy_blocks

    !> Exchange two sets of blocks, without copying.
    pure subroutine swap_blocks(one, other)
        type(gap_blocks_t), intent(inout) :: one, other

        logical, allocatable :: kept(:)

        call swap_reals(one%low, other%low)
        call swap_reals(one%high, other%high)
        call move_alloc(one%has_valley, kept)
        call move_alloc(other%has_valley, one%has_valley)
        call move_alloc(kept, other%has_valley)
    end subroutine swap_blocks

    !> Exchange two arrays, without copying.
    pure subroutine swap_reals(one, other)
        real(wp), allocatable, intent(inout) :: one(:), other(:)

        real(wp), allocatable :: kept(:)

        call move_alloc(one, kept)
        call move_alloc(other, one)
        call move_alloc(kept, other)
    end subroutine swap_reals

    !> The largest less the smallest of some values side by side.
    pure real(wp) function extent(blocks, values, from, to)
        type(gap_blocks_t), intent(in) :: blocks !! of all the values
        real(wp), intent(in) :: values(:)        !! all
        integer, intent(in) :: from, to          !! those asked for; at least one

        real(wp) :: low, high
        integer :: b, i, last

        low = values(from)
        high = low
        i = from
        do while (i <= to)
            b = block_of(i)
            last = min(b*block, to)
            if (i == (b - 1)*block + 1 .and. last == min(b*block, size(values))) then
                low = min(low, blocks%low(b))
                high = max(high, blocks%high(b))
            else
                low = min(low, minval(values(i:last)))
                high = max(high, maxval(values(i:last)))
            end if
            i = last + 1
        end do
        extent = high - low
    end function extent

    !> The first node from one on that is on the other side of a level; beyond the last if none is.
    pure integer function next_across(blocks, h, from, level, is_below) result(i)
        type(gap_blocks_t), intent(in) :: blocks !! of the nodes
        real(wp), intent(in) :: h(:)             !! heights of the nodes, mm
        integer, intent(in) :: from              !! where to begin
        real(wp), intent(in) :: level            !! mm
        logical, intent(in) :: is_below          !! are those before below it?

        integer :: b

        do b = block_of(from), block_of(size(h))
            if (is_below) then
                if (blocks%high(b) < level) cycle
                do i = max(from, (b - 1)*block + 1), min(b*block, size(h))
                    if (h(i) >= level) return
                end do
            else
                if (blocks%low(b) >= level) cycle
                do i = max(from, (b - 1)*block + 1), min(b*block, size(h))
                    if (h(i) < level) return
                end do
            end if
        end do
        i = size(h) + 1
    end function next_across

    !> The first node from one on that is below a level and no higher than both its neighbours,
    !> which the first and the last one do not have; beyond the last if there is none.
    pure integer function next_valley(blocks, h, from, level) result(i)
        type(gap_blocks_t), intent(in) :: blocks !! of the nodes
        real(wp), intent(in) :: h(:)             !! heights of the nodes, mm
        integer, intent(in) :: from              !! where to begin
        real(wp), intent(in) :: level            !! mm

        integer :: b

        i = from
        do while (i <= size(h))
            b = block_of(i)
            if (blocks%has_valley(b) .and. blocks%low(b) < level) then
                do i = i, min(b*block, size(h))
                    if (h(i) >= level) cycle
                    if (is_valley(h, i)) return
                end do
            else
                i = b*block + 1
            end if
        end do
        i = size(h) + 1
    end function next_valley

    pure logical function is_valley(h, i)
        real(wp), intent(in) :: h(:)
        integer, intent(in) :: i

        is_valley = i > 1 .and. i < size(h)
        if (is_valley) is_valley = h(i) <= min(h(i - 1), h(i + 1))
    end function is_valley

    pure integer function block_of(node)
        integer, intent(in) :: node

        block_of = (node - 1)/block + 1
    end function block_of
end module faststrip_geometry_gap_blocks
