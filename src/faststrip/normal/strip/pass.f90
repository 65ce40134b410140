!> The strips of one pass of the strip solver: where they lie, and what is sought for them.
module faststrip_normal_strip_pass
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: pass_strips_t, reserve_pass_strips

    !> Strips with given edges and their unknowns; the first `n` entries count. Owned by the caller.
    type :: pass_strips_t
        integer :: n = 0
        real(wp) :: penetration = 0.0_wp       !! D above the lowest height, mm
        real(wp), allocatable :: y_left(:)     !! left edges, mm
        real(wp), allocatable :: y_right(:)    !! right edges, mm
        real(wp), allocatable :: height(:)     !! h on the centre lines, above the lowest, mm
        real(wp), allocatable :: inv2r(:)      !! A on the centre lines, positive, 1/mm
        real(wp), allocatable :: p0(:)         !! pressures on the centre lines, MPa
        real(wp), allocatable :: half_length(:) !! xd, mm
        logical, allocatable :: leaves(:)      !! strips to be cut off
        ! Work of the equations.
        real(wp), allocatable :: y(:)          !! centre lines
    end type pass_strips_t

contains

    !> Allocate for up to `capacity` strips; the only allocation.
    subroutine reserve_pass_strips(strips, capacity)
        type(pass_strips_t), intent(inout) :: strips !! sized
        integer, intent(in) :: capacity              !! >= 1

        if (allocated(strips%p0)) then
            if (size(strips%p0) >= capacity) return
            deallocate (strips%y_left, strips%y_right, strips%height, strips%inv2r, strips%p0, &
                        strips%half_length, strips%leaves, strips%y)
        end if
        allocate (strips%y_left(capacity), strips%y_right(capacity), strips%height(capacity), &
                  strips%inv2r(capacity), strips%p0(capacity), strips%half_length(capacity), &
                  strips%y(capacity), source=0.0_wp)
        allocate (strips%leaves(capacity), source=.false.)
    end subroutine reserve_pass_strips
end module faststrip_normal_strip_pass
