!> Workspaces of wheelsets. In tests they are `save`: to free all of one at the end of each test
!> takes the compiler ten times as long as the test.
module wheelsets
    use faststrip_wheelset_types, only: wheelset_workspace_t
    implicit none
    private

    public :: release

contains

    !> Free what takes most memory of a workspace that serves no more.
    subroutine release(workspace)
        type(wheelset_workspace_t), intent(inout) :: workspace

        integer :: i

        do i = 1, size(workspace%wheel)
            if (allocated(workspace%wheel(i)%contact)) deallocate (workspace%wheel(i)%contact)
        end do
    end subroutine release
end module wheelsets
