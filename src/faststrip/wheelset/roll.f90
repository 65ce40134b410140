!> The roll at which two wheels stand equally high: secant steps.
module faststrip_wheelset_roll
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: roll_search_t, next_roll, most_roll_step

    !> Largest step of the roll.
    !> Tuned [rad]. Origin: safeguard: a wheel goes down by a flange's height, 15 mm.
    real(wp), parameter :: most_roll_step = 0.02_wp

    !> A search; as declared it has not begun.
    type :: roll_search_t
        logical :: has_begun = .false.   !! was there a step?
        real(wp) :: roll = 0.0_wp        !! the last one but one, rad
        real(wp) :: apart = 0.0_wp       !! how far apart the wheels were there, mm
    end type roll_search_t

contains

    !> The next roll. The first step is that of rigid wheels: the right one goes down with the roll,
    !> and its height up by as much.
    pure subroutine next_roll(search, apart, lever, roll)
        type(roll_search_t), intent(inout) :: search !! remembers this step
        real(wp), intent(in) :: apart                !! height of the right wheel less that of the
                                                     !! left one, mm
        real(wp), intent(in) :: lever                !! of a wheel about the middle, mm
        real(wp), intent(inout) :: roll              !! where that was, and where to go, rad

        real(wp) :: step

        step = 0.5_wp*apart/lever
        if (search%has_begun .and. abs(apart - search%apart) > 0.0_wp) &
            step = -apart*(roll - search%roll)/(apart - search%apart)
        search = roll_search_t(.true., roll, apart)
        roll = roll + max(-most_roll_step, min(step, most_roll_step))
    end subroutine next_roll
end module faststrip_wheelset_roll
