!> A wheel that was solved in a mirror, as it is: left wheels as right ones, those that roll
!> backwards as if they rolled ahead.
module faststrip_wheelset_wheel_flip
    use faststrip_base_kinds, only: wp
    use faststrip_wheelset_types, only: wheel_result_t
    implicit none
    private

    public :: flip_wheel, other_way, other_side

    !> The axis whose direction changes: the other way to roll, the other side of the track.
    !> Given: axes x and y of the track.
    integer, parameter :: other_way = 1, other_side = 2

contains

    !> A wheel with the other direction of one axis.
    pure subroutine flip_wheel(axis, wheel)
        integer, intent(in) :: axis                  !! `other_way` or `other_side`
        type(wheel_result_t), intent(inout) :: wheel !! solved

        ! Of components along axes, and of turns and moments about them.
        real(wp) :: along(3), about(3), ends(2)
        integer :: i

        along = 1.0_wp
        along(axis) = -1.0_wp
        about = -along
        wheel%roll = about(1)*wheel%roll
        wheel%force = along*wheel%force
        wheel%force_wheelset = along*wheel%force_wheelset
        wheel%moment = about*wheel%moment
        do i = 1, wheel%n
            associate (contact => wheel%contact(i), figures => wheel%contact(i)%figures)
                contact%place = along*contact%place
                contact%angle = about(1)*contact%angle
                contact%turn = about(2)*contact%turn
                contact%rail(1) = along(2)*contact%rail(1)
                contact%wheel = along*contact%wheel
                contact%creepage%cksi = along(1)*contact%creepage%cksi
                contact%creepage%ceta = along(2)*contact%creepage%ceta
                contact%creepage%cphi = about(3)*contact%creepage%cphi
                contact%force = along*contact%force
                contact%force_wheelset = along*contact%force_wheelset
                contact%moment = about*contact%moment
                figures%tangential%fx = along(1)*figures%tangential%fx
                figures%tangential%fy = along(2)*figures%tangential%fy
                figures%tangential%mz = about(3)*figures%tangential%mz
                figures%along%fx = along(1)*figures%along%fx
                figures%along%fy = along(2)*figures%along%fy
                figures%along%mz = about(3)*figures%along%mz
                figures%moment = about(1:2)*figures%moment
                if (axis == other_side) then
                    ends = [figures%normal%y_min, figures%normal%y_max]
                    figures%normal%y_min = -ends(2)
                    figures%normal%y_max = -ends(1)
                end if
                figures%flash%x = along(1)*figures%flash%x
                figures%flash%y = along(2)*figures%flash%y
            end associate
        end do
    end subroutine flip_wheel
end module faststrip_wheelset_wheel_flip
