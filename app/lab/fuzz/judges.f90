!> The judges of `faststrip-lab fuzz`, what each demands, and what a named limitation excuses.
!>
!> A judge measures how far an answer is from what must hold, in units of what is allowed: up to
!> one is well. `ok` has to please them all. A limitation is excused only from what it is about:
!> `allowance` is the whole list.
module faststrip_lab_fuzz_judges
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, status_word
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: verdict_t, report_badness, is_broken, broken_judges
    public :: n_judges, judge_names, judge_demands
    public :: judge_answer, judge_finite, judge_order, judge_load, judge_pmax, judge_area, &
              judge_ends, judge_depth, judge_centre, judge_tip, judge_middle, judge_outside, &
              judge_curve, judge_resolved, judge_mirror, judge_scale, judge_stiffness, &
              judge_monotone, judge_wall, judge_bound, judge_moment, judge_power, &
              judge_saturation, judge_force_mirror, judge_force_sign, judge_norm_depth, &
              judge_norm_pmax, judge_norm_area

    integer, parameter :: judge_answer = 1, judge_finite = 2, judge_order = 3, judge_load = 4, &
                          judge_pmax = 5, judge_area = 6, judge_ends = 7, judge_depth = 8, &
                          judge_centre = 9, judge_tip = 10, judge_middle = 11, &
                          judge_outside = 12, judge_curve = 13, judge_resolved = 14, &
                          judge_mirror = 15, judge_scale = 16, judge_stiffness = 17, &
                          judge_monotone = 18, judge_wall = 19, judge_bound = 20, &
                          judge_moment = 21, judge_power = 22, judge_saturation = 23, &
                          judge_force_mirror = 24, judge_force_sign = 25, &
                          judge_norm_depth = 26, judge_norm_pmax = 27, judge_norm_area = 28
    integer, parameter :: n_judges = 28

    character(len=12), parameter :: judge_names(n_judges) = [character(len=12) :: &
        'answer', 'finite', 'order', 'load', 'pmax', 'area', 'ends', 'depth', 'centre', 'tip', &
        'middle', 'outside', 'curve', 'resolved', 'mirror', 'scale', 'stiffness', 'monotone', &
        'wall', 'bound', 'moment', 'power', 'saturation', 'force_mirror', 'force_sign', &
        'norm_depth', 'norm_pmax', 'norm_area']

    !> In words, for the table.
    character(len=56), parameter :: judge_demands(n_judges) = [character(len=56) :: &
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
        real(wp) :: badness(n_judges) = -1.0_wp !! over what is allowed; negative: not judged
    end type verdict_t

    integer, parameter :: of_norm(3) = [judge_norm_depth, judge_norm_pmax, judge_norm_area]

contains

    !> Add a badness to a judge's; the largest counts.
    pure subroutine report_badness(verdict, judge, badness)
        type(verdict_t), intent(inout) :: verdict
        integer, intent(in) :: judge         !! one of the `judge_` numbers
        real(wp), intent(in) :: badness      !! over what is allowed

        real(wp), parameter :: hopeless = 1.0e9_wp ! what is not finite

        verdict%badness(judge) = max(verdict%badness(judge), 0.0_wp, &
                                     merge(min(badness, hopeless), hopeless, &
                                           ieee_is_finite(badness)))
    end subroutine report_badness

    !> Is a judge displeased, and by more than the status allows?
    elemental logical function is_broken(badness, code, judge)
        real(wp), intent(in) :: badness
        integer, intent(in) :: code, judge

        is_broken = badness > 1.0_wp
        if (is_broken) is_broken = badness > allowance(status_word(code), judge)
    end function is_broken

    !> Names of the judges that are displeased without excuse, parted by blanks.
    pure function broken_judges(verdict) result(names)
        type(verdict_t), intent(in) :: verdict
        character(len=:), allocatable :: names

        integer :: j

        names = ''
        do j = 1, n_judges
            if (is_broken(verdict%badness(j), verdict%status%code, j)) &
                names = names // ' ' // trim(judge_names(j))
        end do
        names = trim(adjustl(names))
    end function broken_judges

    !> How many times what `ok` is allowed a named limitation may have. The whole list:
    !>
    !> - every limitation may come with estimates above 10 %, which it says itself where nothing
    !>   else is to be said (`under_resolved`);
    !> - `fallback_used`: the strips stand for the lattice's elements, whose pressures along x
    !>   are no
    !>   semi-ellipses, so that centres and tips say nothing of it (every fifth is compared with
    !>   NORM
    !>   instead), and its cells end where they end;
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
    pure real(wp) function allowance(word, judge)
        character(len=*), intent(in) :: word !! the status, `status_word`
        integer, intent(in) :: judge

        real(wp), parameter :: free = huge(1.0_wp)

        allowance = 1.0_wp
        if (word == 'ok') return
        if (judge == judge_resolved) allowance = free
        if (judge == judge_wall .and. word /= 'more_strips') allowance = free
        select case (word)
        case ('fallback_used')
            if (judge == judge_centre .or. judge == judge_tip) allowance = free
            if (judge == judge_middle .or. judge == judge_monotone) allowance = 3.0_wp
            if (any(judge == of_norm)) allowance = 3.0_wp
            if (judge == judge_outside) allowance = 50.0_wp
        case ('conformal')
            if (judge == judge_centre .or. judge == judge_tip) allowance = 1.0e4_wp
            if (judge == judge_middle) allowance = 3.0_wp
        case ('overlap_left')
            if (judge == judge_outside) allowance = free
        case ('edge_of_data')
            if (judge == judge_norm_pmax) allowance = free
            if (judge == judge_middle .or. judge == judge_centre) allowance = 3.0_wp
        case ('flat_along_x', 'under_resolved', 'fewer_strips')
            if (judge == judge_middle .or. judge == judge_monotone) allowance = 3.0_wp
            if (any(judge == of_norm)) allowance = 3.0_wp
        end select
    end function allowance
end module faststrip_lab_fuzz_judges
