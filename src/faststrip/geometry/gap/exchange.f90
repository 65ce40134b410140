!> Two curves of gaps exchanged, without copying: a solution of a gap that counts as a mirror image
!> works on the image, which lies beside it in the workspace.
module faststrip_geometry_gap_exchange
    use faststrip_geometry_gap_blocks, only: swap_blocks, swap_reals
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_figures_t
    implicit none
    private

    public :: swap_gap_curves

contains

    !> Exchange two curves, without copying; their versions stay.
    pure subroutine swap_gap_curves(one, other)
        type(gap_curve_t), intent(inout) :: one, other !! with room for as many points

        type(gap_figures_t) :: kept
        integer, allocatable :: even_to(:)

        kept = one%gap_figures_t
        one%gap_figures_t = other%gap_figures_t
        other%gap_figures_t = kept
        call swap_reals(one%y, other%y)
        call swap_reals(one%h, other%h)
        call swap_reals(one%slope_from, other%slope_from)
        call swap_reals(one%slope_to, other%slope_to)
        call swap_reals(one%inv2r, other%inv2r)
        call swap_reals(one%inclination, other%inclination)
        call swap_reals(one%y_node, other%y_node)
        call swap_reals(one%h_node, other%h_node)
        call move_alloc(one%even_to, even_to)
        call move_alloc(other%even_to, one%even_to)
        call move_alloc(even_to, other%even_to)
        call swap_logicals(one%is_step, other%is_step)
        call swap_blocks(one%blocks, other%blocks)
        call swap_blocks(one%inclined, other%inclined)
    end subroutine swap_gap_curves

    pure subroutine swap_logicals(one, other)
        logical, allocatable, intent(inout) :: one(:), other(:)

        logical, allocatable :: kept(:)

        call move_alloc(one, kept)
        call move_alloc(other, one)
        call move_alloc(kept, other)
    end subroutine swap_logicals
end module faststrip_geometry_gap_exchange
