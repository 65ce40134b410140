!> What is wanted of an automatic solution: which figure, how good, in which time; and the steps
!> that were taken for it.
module faststrip_contact_wanted
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, count_text, &
                                     st_ok, st_bad_argument
    use faststrip_normal_strip, only: strips_auto_most, fewest_strips
    use faststrip_contact_methods, only: contact_methods_t, tangential_none
    implicit none
    private

    public :: wanted_t, others_t, check_wanted, needs_forces, target_number, target_names
    public :: others_across, others_time
    public :: auto_step_t, auto_steps_t, clear_steps
    public :: margin, unknown_error, most_steps, usual_tolerance

    ! Given: numbers of kinds, in the order of `target_names`; they stay for ever.
    integer, parameter, public :: target_forces = 1
        !! Fx and Fy over mu N and Mz over mu N c, c = sqrt(area/pi), the worst of the three
    integer, parameter, public :: target_pmax = 2        !! maximum pressure, relative
    integer, parameter, public :: target_penetration = 3 !! of the depth below the lowest point
    integer, parameter, public :: target_area = 4        !! relative
    integer, parameter, public :: target_power = 5       !! friction power, relative

    !> What counts as the error of a figure that has no estimate.
    real(wp), parameter :: unknown_error = huge(1.0_wp)
    !> Most steps of one contact.
    !> Tuned [steps]. Origin: safeguard: the estimate leads there in three; grids of others follow.
    integer, parameter :: most_steps = 11
    !> Largest estimated error wanted where nobody says which.
    !> Tuned [1]. Origin: chosen.
    real(wp), parameter :: usual_tolerance = 0.02_wp

    !> Part of the tolerance that is aimed at.
    !> Tuned [1]. Origin: chosen for the time: 0.7 takes a tenth more.
    real(wp), parameter :: margin = 0.85_wp

    ! Tuned [1]: Estimated error above which a solution tells no more of what others need. Origin:
    ! measured on contacts with waves, kinks and corners; 0.2 moves one of 160 answers by 0.3 %.
    real(wp), parameter :: most_telling = 0.3_wp

    !> What people call them.
    character(len=*), parameter :: target_names(5) = [character(len=11) :: &
        'forces', 'pmax', 'penetration', 'area', 'power']

    !> Finer methods that a caller has, as Kalker's: what they are expected to cost.
    type :: others_t
        real(wp) :: one_us = 0.0_wp !! time with one element across, us; grows with the square of
                                    !! elements across; 0: there are none
        real(wp) :: one = 0.0_wp    !! estimated error with one element across
        real(wp) :: over_strips = 0.0_wp
            !! if above 0, `one` is not used: estimated error over that of as many strips
        ! Given: the default.
        real(wp) :: order = 2.0_wp  !! power of elements across by which it falls
    end type others_t

    !> What is wanted.
    type :: wanted_t
        integer :: target = target_forces !! one of the `target_` numbers
        real(wp) :: tolerance = usual_tolerance
            !! largest estimated error; 0: the least within the budget
        real(wp) :: budget_us = 0.0_wp    !! time for it, us; 0: as long as it takes
        integer :: most_strips = strips_auto_most !! across the largest patch, 3 to 81
        ! Tuned [strips]. Origin: fewer are hardly cheaper.
        integer :: first_strips = 7       !! of the first answer by strips
        logical :: ellipse = .true.       !! may a Hertz ellipse be the answer?
        type(others_t) :: others = others_t()
            !! finer methods of the caller: what strips are not expected to meet, or not sooner, is
            !! left to them at once, instead of coming as near as strips can
    end type wanted_t

    !> One solution on the way.
    type :: auto_step_t
        type(contact_methods_t) :: methods        !! with the resolutions that were used
        integer :: across = 0                     !! strips or elements across the widest patch
        real(wp) :: estimate = unknown_error      !! of the target's error; `unknown_error`
        real(wp) :: normal_us = 0.0_wp            !! time of the normal problem and its estimates
        real(wp) :: tangential_us = 0.0_wp        !! of the tangential problem and its estimates
        integer :: code = st_ok                   !! of its status, if it is an error
    end type auto_step_t

    !> What was tried, and what came of it.
    type :: auto_steps_t
        integer :: n = 0                         !! steps
        integer :: first = 0                     !! the first of them by strips, 0: none
        real(wp) :: first_across = 0.0_wp
            !! strips across the widest patch of it, if all were as narrow as those of the narrowest
        type(auto_step_t) :: steps(most_steps)   !! the first `n`, in their order
        integer :: best = 0                      !! the step whose solution is the result
        real(wp) :: estimate = unknown_error     !! of the target's error, of that step
        logical :: is_met = .false.              !! is it within the tolerance?
    end type auto_steps_t

contains

    !> Refuse what cannot be wanted.
    pure subroutine check_wanted(wanted, tangential, status)
        type(wanted_t), intent(in) :: wanted  !! as the caller set it
        integer, intent(in) :: tangential     !! tangential method of the case
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        if (wanted%target < 1 .or. wanted%target > size(target_names)) then
            call set_status(status, st_bad_argument, 'the target must be 1 to 5, got ' &
                            // count_text(wanted%target))
        else if (.not. is_number(wanted%tolerance)) then
            call set_status(status, st_bad_argument, 'the tolerance must be a number from 0 on, ' &
                            // 'got ' // number_text(wanted%tolerance))
        else if (.not. is_number(wanted%budget_us)) then
            call set_status(status, st_bad_argument, 'the budget must be a number of ' &
                            // 'microseconds from 0 on, got ' // number_text(wanted%budget_us))
        else if (.not. (wanted%tolerance > 0.0_wp .or. wanted%budget_us > 0.0_wp)) then
            call set_status(status, st_bad_argument, &
                            'a tolerance or a budget must be given, both are 0')
        else if (wanted%most_strips < fewest_strips &
                 .or. wanted%most_strips > strips_auto_most) then
            call set_status(status, st_bad_argument, 'the most strips must be 3 to 81, got ' &
                            // count_text(wanted%most_strips))
        else if (needs_forces(wanted%target) .and. tangential == tangential_none) then
            call set_status(status, st_bad_argument, 'the target ' &
                            // trim(target_names(wanted%target)) &
                            // ' needs a tangential method, got none')
        end if
    end subroutine check_wanted

    elemental logical function is_number(value)
        real(wp), intent(in) :: value

        is_number = ieee_is_finite(value)
        if (is_number) is_number = value >= 0.0_wp
    end function is_number

    !> Is a target a figure of the tangential problem?
    elemental logical function needs_forces(target)
        integer, intent(in) :: target !! one of the `target_` numbers

        needs_forces = target == target_forces .or. target == target_power
    end function needs_forces

    !> Forget all steps.
    pure subroutine clear_steps(steps)
        type(auto_steps_t), intent(inout) :: steps !! empty afterwards

        steps%n = 0
        steps%first = 0
        steps%best = 0
        steps%estimate = unknown_error
        steps%is_met = .false.
    end subroutine clear_steps

    !> Elements across that others need for the tolerance.
    pure real(wp) function others_across(wanted, strips, estimate) result(across)
        type(wanted_t), intent(in) :: wanted !! tolerance above 0, others
        real(wp), intent(in) :: strips       !! across, of a solution
        real(wp), intent(in) :: estimate     !! of its error

        associate (others => wanted%others, aim => margin*wanted%tolerance)
            if (others%over_strips > 0.0_wp) then
                across = strips*(others%over_strips*min(estimate, most_telling)/aim) &
                         **(1.0_wp/others%order)
            else
                across = (others%one/aim)**(1.0_wp/others%order)
            end if
        end associate
    end function others_across

    !> Time of others, us.
    elemental real(wp) function others_time(others, across) result(time)
        type(others_t), intent(in) :: others !! what they cost
        real(wp), intent(in) :: across       !! elements across

        time = others%one_us*across**2
    end function others_time

    !> The number of the target of this name; 0 if there is none.
    pure integer function target_number(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        target_number = findloc(target_names == name, .true., dim=1)
    end function target_number
end module faststrip_contact_wanted
