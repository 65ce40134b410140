!> Whether a state of a wheelset is near a jump: whether contacts are elsewhere a little to its left
!> and to its right. Which of both solutions is the right one hangs there on micrometres of the
!> profiles, so both are listed.
module faststrip_command_wheelset_jump
    use faststrip_base_kinds, only: wp
    use faststrip_wheelset_types, only: wheelset_result_t, wheel_result_t
    implicit none
    private

    public :: is_jump

    ! Tuned [mm]: contacts that move farther on the rail are elsewhere. Origin: chosen: as near as
    ! places of contact are to be known.
    real(wp), parameter :: elsewhere = 0.1_wp

contains

    !> Do contacts jump between two states?
    pure logical function is_jump(left, right, wants)
        type(wheelset_result_t), intent(in) :: left  !! solved
        type(wheelset_result_t), intent(in) :: right !! solved
        logical, intent(in) :: wants(2)              !! which wheels count: right, left

        integer :: side

        is_jump = .false.
        do side = 1, size(wants)
            if (wants(side)) is_jump = is_jump .or. jumps(left%wheel(side), right%wheel(side))
        end do
    end function is_jump

    pure logical function jumps(left, right)
        type(wheel_result_t), intent(in) :: left, right

        integer :: i

        jumps = left%n /= right%n
        if (jumps) return
        do i = 1, left%n
            jumps = jumps .or. norm2(left%contact(i)%rail - right%contact(i)%rail) > elsewhere
        end do
    end function jumps
end module faststrip_command_wheelset_jump
