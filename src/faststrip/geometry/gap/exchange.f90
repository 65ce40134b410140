!> Two curves of gaps exchanged, without copying: a solution of a gap that counts as a mirror image
!> works on the image, which lies beside it in the workspace.
module faststrip_geometry_gap_exchange
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap_blocks, only: swap_blocks, swap_reals
    use faststrip_geometry_gap_curve, only: gap_curve_t
    implicit none
    private

    public :: swap_gap_curves

contains

    !> Exchange two curves, without copying; their versions stay.
    pure subroutine swap_gap_curves(one, other)
        type(gap_curve_t), intent(inout) :: one, other !! with room for as many points

        call swap_numbers(one, other)
        call swap_reals(one%y, other%y)
        call swap_reals(one%h, other%h)
        call swap_reals(one%slope_from, other%slope_from)
        call swap_reals(one%slope_to, other%slope_to)
        call swap_reals(one%inv2r, other%inv2r)
        call swap_reals(one%inclination, other%inclination)
        call swap_reals(one%y_node, other%y_node)
        call swap_reals(one%h_node, other%h_node)
        call swap_logicals(one%is_step, other%is_step)
        call swap_blocks(one%blocks, other%blocks)
        call swap_blocks(one%inclined, other%inclined)
    end subroutine swap_gap_curves

    !> Exchange what of two curves is no array of reals.
    pure subroutine swap_numbers(one, other)
        type(gap_curve_t), intent(inout) :: one, other

        integer, allocatable :: even_to(:)

        call swap_integer(one%n, other%n)
        call swap_integer(one%n_pieces, other%n_pieces)
        call swap_real(one%y_lowest, other%y_lowest)
        call swap_real(one%h_lowest, other%h_lowest)
        call swap_real(one%least_inv2r, other%least_inv2r)
        call swap_logical(one%is_image, other%is_image)
        call swap_logical(one%is_even, other%is_even)
        call swap_logical(one%has_steps, other%has_steps)
        call swap_logical(one%inclination_is_known, other%inclination_is_known)
        call move_alloc(one%even_to, even_to)
        call move_alloc(other%even_to, one%even_to)
        call move_alloc(even_to, other%even_to)
    end subroutine swap_numbers

    pure subroutine swap_logicals(one, other)
        logical, allocatable, intent(inout) :: one(:), other(:)

        logical, allocatable :: kept(:)

        call move_alloc(one, kept)
        call move_alloc(other, one)
        call move_alloc(kept, other)
    end subroutine swap_logicals

    pure subroutine swap_integer(one, other)
        integer, intent(inout) :: one, other

        integer :: kept

        kept = one
        one = other
        other = kept
    end subroutine swap_integer

    pure subroutine swap_real(one, other)
        real(wp), intent(inout) :: one, other

        real(wp) :: kept

        kept = one
        one = other
        other = kept
    end subroutine swap_real

    pure subroutine swap_logical(one, other)
        logical, intent(inout) :: one, other

        logical :: kept

        kept = one
        one = other
        other = kept
    end subroutine swap_logical
end module faststrip_geometry_gap_exchange
