!> The approach at which a force is as large as a load: one step after the other, for a caller that
!> finds the forces.
!>
!> Steps are those of the secant over the force to 2/3, which Hertz' law makes linear, between
!> bounds. Near the end the force is the solver's to some ten digits only: there the slope is kept.
!> Likewise the roll at which two wheels stand equally high.
module faststrip_wheelset_approach
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    implicit none
    private

    public :: approach_search_t, start_search, take_force, is_found, is_near, usual_approach
    public :: spring_share, find_spring_step
    public :: largest_jump, near_enough, warm_enough, most_growth, equilibrium, most_tries
    public :: telling, hertz_power
    public :: roll_search_t, next_roll, most_roll_step

    ! Tuned [1]: equilibrium of one wheel, of the load. Origin: above the digits of a contact's
    ! solution; with 9e-11 forces change by as much.
    real(wp), parameter :: exact = 7.0e-11_wp
    !> What may be missing of two wheels' loads, over the load, and of their equal heights, over the
    !> radius.
    !> Tuned [1]. Origin: above the digits of two solutions, below 1e-10, which strips have.
    real(wp), parameter :: equilibrium = 9.0e-11_wp
    !> A force as near as this to its load is found, where no step comes nearer.
    !> Tuned [1]. Origin: chosen: a hundred times what solutions of a contact miss.
    real(wp), parameter :: near_enough = 1.0e-8_wp
    !> The same from the last solution, at a roll that is given.
    !> Tuned [1]. Origin: chosen: two solutions do over 10 um, where with 1e-8 it is three.
    real(wp), parameter :: warm_enough = 1.0e-7_wp
    ! A bracket that is closed, of its upper end: there the force jumps. That of a smooth contact
    ! changes by less than near_enough within it.
    real(wp), parameter :: least_bracket = 0.25_wp*near_enough
    !> Changes of forces and moments, of the load, that are less tell nothing of slopes.
    !> Tuned [1]. Origin: chosen: a hundred times near_enough.
    real(wp), parameter :: telling = 1.0e-6_wp
    !> Largest misfit of a force that jumps which still is an answer.
    !> Tuned [1]. Origin: chosen: as large as errors that are named.
    real(wp), parameter :: largest_jump = 0.1_wp
    ! Tuned [N/mm**1.5]: force over the approach to 3/2, for a first guess. Origin: a steel wheel of
    ! 460 mm on a rail of 300 mm.
    real(wp), parameter :: usual_stiffness = 2.0e6_wp
    !> Power of the approach that a force grows with.
    !> Given: Hertz' law of a point contact.
    real(wp), parameter :: hertz_power = 1.5_wp
    !> Most by which an approach grows or shrinks in a step.
    !> Tuned [1]. Origin: safeguard: the force does by eight times.
    real(wp), parameter :: most_growth = 4.0_wp
    !> Tries of one way before another is taken: secants before halvings, halvings of a step that
    !> gains nothing, strips for another method's load.
    !> Tuned [tries]. Origin: chosen: two or three do where forces do not jump.
    integer, parameter :: most_tries = 8

    !> Largest step of the roll.
    !> Tuned [rad]. Origin: safeguard: a wheel goes down by a flange's height, 15 mm.
    real(wp), parameter :: most_roll_step = 0.02_wp

    !> A search, and the approach that it wants to know the force of.
    type :: approach_search_t
        real(wp) :: approach = 0.0_wp      !! next one, mm
        logical :: goes_on = .true.        !! is another force wanted?
        real(wp) :: load = 0.0_wp          !! N
        ! Given: none so far.
        real(wp) :: misfit = huge(1.0_wp)  !! smallest so far, of the load
        real(wp) :: best = 0.0_wp          !! approach of it, mm
        real(wp) :: low = 0.0_wp           !! too small, mm
        ! Given: none so far.
        real(wp) :: high = huge(1.0_wp)    !! too large, mm
        real(wp) :: before = 0.0_wp        !! the last approach, mm
        real(wp) :: root_before = 0.0_wp   !! its force to 2/3
        real(wp) :: slope = 0.0_wp         !! the last one, of the force to 2/3
        real(wp) :: tolerance = 0.0_wp     !! misfit at which it ends, 0: as near as it comes
        real(wp) :: bracket = 0.0_wp       !! the same of the bracket, of its upper end
        integer :: steps = 0               !! so far
    end type approach_search_t

    !> A search of the roll at which two wheels stand equally high; as declared it has not begun.
    type :: roll_search_t
        logical :: has_begun = .false.   !! was there a step?
        real(wp) :: roll = 0.0_wp        !! the last one but one, rad
        real(wp) :: apart = 0.0_wp       !! how far apart the wheels were there, mm
    end type roll_search_t

contains

    !> An approach at which a usual contact carries a load, mm.
    elemental real(wp) function usual_approach(load)
        real(wp), intent(in) :: load !! N

        usual_approach = (load/usual_stiffness)**(1.0_wp/hertz_power)
    end function usual_approach

    !> How much of an approach a spring takes below a usual contact, mm.
    elemental real(wp) function spring_share(approach, stiffness) result(share)
        real(wp), intent(in) :: approach  !! of both together, mm
        real(wp), intent(in) :: stiffness !! of the spring, N/mm

        real(wp) :: left, slope
        integer :: i

        ! From a contact that takes all of it Newton's method falls towards what it takes.
        share = 0.0_wp
        do i = 1, most_tries
            left = usual_stiffness*max(approach - share, 0.0_wp)**hertz_power - stiffness*share
            slope = hertz_power*usual_stiffness*sqrt(max(approach - share, 0.0_wp)) + stiffness
            share = share + left/slope
        end do
    end function spring_share

    !> How far rails on springs go until forces and springs are in balance, mm: along each direction
    !> that has a spring.
    pure subroutine find_spring_step(slope, stiffness, left, step, singular)
        real(wp), intent(in) :: slope(:, :)  !! by which forces fall with the step, N/mm
        real(wp), intent(in) :: stiffness(:) !! of the springs, N/mm; 0: rigid
        real(wp), intent(in) :: left(:)      !! forces less those of the springs, N
        real(wp), intent(out), contiguous :: step(:) !! 0 where there is none
        logical, intent(out) :: singular     !! do forces not tell it?

        real(wp) :: both(size(left), size(left))
        integer :: i, pivot(size(left))

        both = slope
        step = left
        do i = 1, size(left)
            both(i, i) = both(i, i) + stiffness(i)
            if (stiffness(i) > 0.0_wp) cycle
            both(i, :) = 0.0_wp
            both(:, i) = 0.0_wp
            both(i, i) = 1.0_wp
            step(i) = 0.0_wp
        end do
        call lu_factor(size(left), both, pivot, singular)
        if (singular) then
            step = 0.0_wp
        else
            call lu_solve(size(left), both, pivot, step)
        end if
    end subroutine find_spring_step

    !> Start a search.
    pure subroutine start_search(search, load, approach, tolerance, bracket, slope)
        type(approach_search_t), intent(out) :: search !! to be continued by `take_force`
        real(wp), intent(in) :: load                   !! > 0, N
        real(wp), intent(in) :: approach               !! a first guess, > 0, mm
        real(wp), intent(in), optional :: tolerance    !! misfit of the load that is near enough
        real(wp), intent(in), optional :: bracket      !! the same of the bracket, of its upper end
        real(wp), intent(in), optional :: slope        !! of an earlier search, 0: none, 1/mm

        search%load = load
        search%approach = approach
        if (present(tolerance)) search%tolerance = tolerance
        if (present(bracket)) search%bracket = bracket
        if (present(slope)) search%slope = slope
    end subroutine start_search

    !> Tell the force at `search%approach`: the next approach is there, or the search has ended.
    pure subroutine take_force(search, force)
        type(approach_search_t), intent(inout) :: search !! that goes on
        real(wp), intent(in) :: force                    !! N

        real(wp) :: misfit, root, next, change

        search%steps = search%steps + 1
        misfit = abs(force/search%load - 1.0_wp)
        if (misfit < search%misfit) then
            search%misfit = misfit
            search%best = search%approach
        end if
        if (misfit <= exact .or. search%steps == most_steps &
            .or. misfit > near_enough &
            .and. search%high - search%low <= least_bracket*search%high) then
            search%goes_on = .false.
            return
        end if
        if (force < search%load) then
            search%low = max(search%low, search%approach)
        else
            search%high = min(search%high, search%approach)
        end if
        if (search%misfit <= search%tolerance .or. &
            search%high - search%low <= search%bracket*search%high) then
            search%goes_on = .false.
            return
        end if
        root = sign((abs(force)/search%load)**(1.0_wp/hertz_power), force)
        change = root - search%root_before
        ! The first secant is that through first touch.
        if (abs(change) > telling .and. (search%steps > 1 .or. .not. search%slope > 0.0_wp)) &
            search%slope = change/(search%approach - search%before)
        search%before = search%approach
        search%root_before = root
        next = most_growth*search%approach
        if (search%slope > 0.0_wp) next = search%approach + (1.0_wp - root)/search%slope
        ! The bounds are as good as the digits of the force.
        if (misfit > near_enough .and. .not. (next > search%low .and. next < search%high)) then
            if (search%high < huge(1.0_wp)) then
                next = 0.5_wp*(search%low + search%high)
            else
                next = most_growth*search%approach
            end if
        end if
        search%approach = min(max(next, search%approach/most_growth), &
                              search%approach*most_growth)
    end subroutine take_force

    !> Was the load found?
    pure logical function is_found(search)
        type(approach_search_t), intent(in) :: search !! that has ended

        is_found = search%misfit <= max(near_enough, search%tolerance)
    end function is_found

    !> Did the force jump over the load, by so little that the height nearest to it is an answer?
    pure logical function is_near(search)
        type(approach_search_t), intent(in) :: search !! that has ended

        is_near = search%misfit <= largest_jump
    end function is_near

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
end module faststrip_wheelset_approach
