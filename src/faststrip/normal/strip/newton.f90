!> The linear system of Newton's method for strips and ends, and its last factors.
module faststrip_normal_strip_newton
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strip_patches, only: max_patches
    implicit none
    private

    public :: newton_workspace_t, reserve_newton

    !> The linear system of 2n + 1 equations and those of the ends.
    type :: newton_workspace_t
        ! Whether `jacobian` holds factors that may serve again, and what kind of system they are
        ! of.
        logical :: kept = .false.
        logical :: by_load = .true., fixed(2*max_patches) = .false.
        integer :: n_patches = 0, n_strips(max_patches) = 0
        real(wp), allocatable :: jacobian(:, :)
        real(wp), allocatable :: step(:)
        real(wp), allocatable :: other(:, :) !! (2) other vectors
        integer, allocatable :: pivot(:)
    end type newton_workspace_t

contains

    !> Allocate for systems of up to `max_strips` strips. Where there is room, what is kept stays.
    subroutine reserve_newton(workspace, max_strips)
        type(newton_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips                    !! >= 1

        integer :: n

        n = 2*max_strips + 1 + 2*max_patches
        if (allocated(workspace%pivot)) then
            if (size(workspace%pivot) >= n) return
            workspace%kept = .false.
            deallocate (workspace%jacobian, workspace%step, workspace%other, workspace%pivot)
        end if
        allocate (workspace%jacobian(n, n), workspace%step(n), workspace%other(n, 2), &
                  source=0.0_wp)
        allocate (workspace%pivot(n), source=0)
    end subroutine reserve_newton
end module faststrip_normal_strip_newton
