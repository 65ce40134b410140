!> The checks of `faststrip-lab fuzz`, what each demands, and what a named limitation excuses.
!>
!> A check measures how far an answer is from what must hold, in units of what is allowed: up to
!> one is well. `ok` has to pass them all. A limitation is excused only from what it is about:
!> `allowance` is the whole list.
module faststrip_lab_fuzz_checks
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, status_word
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: verdict_t, report_badness, is_broken, broken_checks
    public :: n_checks, check_names, check_demands
    public :: check_answer, check_finite, check_order, check_load, check_pmax, check_area, &
              check_ends, check_depth, check_centre, check_tip, check_middle, check_outside, &
              check_curve, check_resolved, check_mirror, check_scale, check_stiffness, &
              check_monotone, check_wall, check_bound, check_moment, check_power, &
              check_saturation, check_force_mirror, check_force_sign, check_norm_depth, &
              check_norm_pmax, check_norm_area

    integer, parameter :: check_answer = 1, check_finite = 2, check_order = 3, check_load = 4, &
                          check_pmax = 5, check_area = 6, check_ends = 7, check_depth = 8, &
                          check_centre = 9, check_tip = 10, check_middle = 11, &
                          check_outside = 12, check_curve = 13, check_resolved = 14, &
                          check_mirror = 15, check_scale = 16, check_stiffness = 17, &
                          check_monotone = 18, check_wall = 19, check_bound = 20, &
                          check_moment = 21, check_power = 22, check_saturation = 23, &
                          check_force_mirror = 24, check_force_sign = 25, &
                          check_norm_depth = 26, check_norm_pmax = 27, check_norm_area = 28
    integer, parameter :: n_checks = 28

    character(len=12), parameter :: check_names(n_checks) = [character(len=12) :: &
        'answer', 'finite', 'order', 'load', 'pmax', 'area', 'ends', 'depth', 'centre', 'tip', &
        'middle', 'outside', 'curve', 'resolved', 'mirror', 'scale', 'stiffness', 'monotone', &
        'wall', 'bound', 'moment', 'power', 'saturation', 'force_mirror', 'force_sign', &
        'norm_depth', 'norm_pmax', 'norm_area']

    !> In words, for the table.
    character(len=56), parameter :: check_demands(n_checks) = [character(len=56) :: &
        'an answer, or an error with a reason that holds', &
        'finite numbers, no floating exception', &
        'positive pressures and lengths, edges in order', &
        'the pressures carry the load', &
        'pmax is the maximum pressure', &
        'area is that of the strips', &
        'ends, length and number of patches are the strips''', &
        'the bodies overlap, the penetration is above the gap', &
        'closed on the centre line of strips', &
        'closed at the tips of strips', &
        'closed at half the length of strips', &
        'open outside the patches', &
        'the curve makes no contact that its points do not', &
        'ok only with estimated errors up to 10 %', &
        'y -> -y', &
        'lengths x 8, load x 64', &
        'moduli and load x 2: the same patch', &
        'load x 1.02: deeper, by no more than 2 %', &
        'walls behind the contact change nothing', &
        'creep force at most mu N', &
        'moment at most that of mu p at the rim', &
        'creep forces dissipate, and that is the power', &
        'large creepage gives mu N', &
        'creep forces under y -> -y', &
        'creep forces change sign with the creepages', &
        'penetration by NORM on a grid', &
        'maximum pressure by NORM on a grid', &
        'area by NORM on a grid']

    !> What came of one case.
    type :: verdict_t
        type(status_t) :: status
        type(normal_result_t) :: result
        integer :: strips = 0
        real(wp) :: load_error = 0.0_wp !! Q/Q0 - 1
        real(wp) :: overlap = 0.0_wp    !! largest outside the patches, over the penetration
        real(wp) :: overlap_y = 0.0_wp  !! where, mm
        real(wp) :: est_err(3) = 0.0_wp !! estimates for penetration, pmax, area
        real(wp) :: time_us = 0.0_wp
        real(wp) :: badness(n_checks) = -1.0_wp !! over what is allowed; negative: not checked
    end type verdict_t

    integer, parameter :: of_norm(3) = [check_norm_depth, check_norm_pmax, check_norm_area]

contains

    !> Add a badness to a check's; the largest counts.
    pure subroutine report_badness(verdict, check, badness)
        type(verdict_t), intent(inout) :: verdict
        integer, intent(in) :: check         !! one of the `check_` numbers
        real(wp), intent(in) :: badness      !! over what is allowed

        real(wp), parameter :: hopeless = 1.0e9_wp ! what is not finite

        verdict%badness(check) = max(verdict%badness(check), 0.0_wp, &
                                     merge(min(badness, hopeless), hopeless, &
                                           ieee_is_finite(badness)))
    end subroutine report_badness

    !> Does a check fail, and by more than the status allows?
    elemental logical function is_broken(badness, code, check)
        real(wp), intent(in) :: badness
        integer, intent(in) :: code, check

        is_broken = badness > 1.0_wp
        if (is_broken) is_broken = badness > allowance(status_word(code), check)
    end function is_broken

    !> Names of the checks that fail without excuse, parted by blanks.
    pure function broken_checks(verdict) result(names)
        type(verdict_t), intent(in) :: verdict
        character(len=:), allocatable :: names

        integer :: j

        names = ''
        do j = 1, n_checks
            if (is_broken(verdict%badness(j), verdict%status%code, j)) &
                names = names // ' ' // trim(check_names(j))
        end do
        names = trim(adjustl(names))
    end function broken_checks

    !> How many times what `ok` is allowed a named limitation may have. The whole list:
    !>
    !> - every limitation may come with estimates above 10 %, which it says itself where nothing
    !>   else is to be said (`under_resolved`);
    !> - `fallback_used`: cells end where they end, which may be far out, and their lengths are near
    !>   to what closes the tips (every fifth is compared with NORM);
    !> - `overlap_left`: says that the surfaces overlap outside;
    !> - `edge_of_data`: at the end of the data the pressure has no bound;
    !> - `flat_along_x`: a raised curvature bends the strips' sections;
    !> - `under_resolved`, `fewer_strips`: the gap has more detail than the strips, and with
    !>   another load or another grid other detail is met;
    !> - `conformal`: a step in the patch moves the gap in a strip's middle by as much as its end is
    !>   uncertain;
    !> - `more_strips`: nothing;
    !> - what lies behind the contact may change the name of any limitation, and an answer that
    !>   rests
    !>   on it.
    pure real(wp) function allowance(word, check)
        character(len=*), intent(in) :: word !! the status, `status_word`
        integer, intent(in) :: check

        real(wp), parameter :: free = huge(1.0_wp)

        allowance = 1.0_wp
        if (word == 'ok') return
        if (check == check_resolved) allowance = free
        if (check == check_wall .and. word /= 'more_strips') allowance = free
        select case (word)
        case ('fallback_used')
            if (check == check_tip) allowance = 1.0e3_wp
            if (check == check_centre) allowance = 10.0_wp
            if (check == check_middle .or. check == check_monotone) allowance = 3.0_wp
            if (any(check == of_norm)) allowance = 3.0_wp
            if (check == check_outside) allowance = 50.0_wp
        case ('conformal')
            if (check == check_centre .or. check == check_tip) allowance = 1.0e4_wp
            if (check == check_middle) allowance = 3.0_wp
        case ('overlap_left')
            if (check == check_outside) allowance = free
        case ('edge_of_data')
            if (check == check_norm_pmax) allowance = free
            if (check == check_middle .or. check == check_centre) allowance = 3.0_wp
        case ('flat_along_x', 'under_resolved', 'fewer_strips')
            if (check == check_middle .or. check == check_monotone) allowance = 3.0_wp
            if (any(check == of_norm)) allowance = 3.0_wp
        end select
    end function allowance
end module faststrip_lab_fuzz_checks
