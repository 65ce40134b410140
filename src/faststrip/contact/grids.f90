!> Which grid Kalker's methods take where auto finds that strips cannot do, and the next ones.
module faststrip_contact_grids
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strips, only: contact_strips_t, last_of_patch
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_method, only: normal_method_t
    use faststrip_contact_wanted, only: wanted_t, others_t, others_across, others_time, margin, &
                                        auto_step_t, auto_steps_t, unknown_error, target_area
    implicit none
    private

    public :: grid_step_t, plan_of_finer, first_grid, next_grid

    ! Tuned [grids]: that are tried for one contact. Origin: chosen for the time.
    integer, parameter :: most_grids = 3
    ! Tuned [strips]: across where grids follow, unless the area is wanted: their own estimate of
    ! the area falls slowly. Origin: measured, 134 contacts of the families of `force-data`.
    integer, parameter :: most_strips = 41
    ! Tuned [elements]: across the patch at least. Origin: as NORM's coarser grid.
    real(wp), parameter :: least_across = 8.0_wp
    ! Tuned [1]: how many more the next try has at least and at most. Origin: chosen for the time.
    real(wp), parameter :: least_growth = 1.4_wp, largest_growth = 3.0_wp
    ! Tuned [elements]: across where the largest grid is not expected to do: their estimate tells.
    ! Origin: chosen for the time.
    real(wp), parameter :: telling_across = 30.0_wp
    ! Tuned [1]: a finer grid is not tried where the finest would be expected to miss by more than
    ! this factor. Origin: chosen for the time.
    real(wp), parameter :: largest_miss = 10.0_wp
    ! Tuned [1]: of what is left of a budget, planned for a grid of which no time is known. Origin:
    ! chosen.
    real(wp), parameter :: share_of_budget = 0.6_wp
    ! Tuned [1]: Elements of a grid over those in its patches. Origin: measured.
    real(wp), parameter :: surplus = 1.7_wp

    !> A try.
    type :: grid_step_t
        real(wp) :: across = 0.0_wp     !! elements across the widest patch, either way; 0: no try
        real(wp) :: dx = 0.0_wp         !! sides of the elements, mm
        real(wp) :: dy = 0.0_wp         !! the other
        integer, private :: number = 1  ! of this contact
        real(wp), private :: most_across = 0.0_wp
    end type grid_step_t

contains

    !> What is expected of finer methods, if they are there and the budget allows for the coarsest
    !> grid; then fewer strips are tried.
    subroutine plan_of_finer(method, wanted, is_there)
        class(normal_method_t), pointer, intent(in) :: method !! or null
        type(wanted_t), intent(inout) :: wanted               !! gets it
        logical, intent(inout) :: is_there                    !! are they? true then

        type(others_t) :: others

        if (.not. associated(method)) return
        others = method%expected(wanted%target)
        if (.not. others%one_us > 0.0_wp) return
        if (wanted%budget_us > 0.0_wp .and. others_time(others, least_across) &
            > share_of_budget*wanted%budget_us) return
        is_there = .true.
        wanted%others = others
        if (wanted%target /= target_area) wanted%most_strips = min(wanted%most_strips, most_strips)
    end subroutine plan_of_finer

    !> The first try for a contact that strips cannot do.
    pure type(grid_step_t) function first_grid(wanted, taken, max_elements, normal, strips, &
                                               spent_us) result(grid)
        type(wanted_t), intent(in) :: wanted         !! target, tolerance and budget
        type(auto_steps_t), intent(in) :: taken      !! what the core did
        integer, intent(in) :: max_elements          !! most elements
        type(normal_result_t), intent(in) :: normal  !! the core's figures
        type(contact_strips_t), intent(in) :: strips !! and strips
        real(wp), intent(in) :: spent_us             !! its time, us

        real(wp) :: width, across
        integer :: first, last

        width = 0.0_wp
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = last_of_patch(strips, first)
            width = max(width, strips%y_right(last) - strips%y_left(first))
        end do
        grid%most_across = sqrt(max_elements/surplus*width/(normal%y_max - normal%y_min))
        across = least_across
        associate (coarse => taken%steps(max(taken%first, 1)))
            if (wanted%tolerance > 0.0_wp .and. coarse%estimate < unknown_error) &
                across = max(across, others_across(wanted, &
                                                   real(coarse%methods%strips_per_patch, wp), &
                                                   coarse%estimate))
        end associate
        if (across > grid%most_across) across = min(telling_across, grid%most_across)
        if (wanted%budget_us > 0.0_wp) then
            across = min(across, sqrt(share_of_budget*max(wanted%budget_us - spent_us, 0.0_wp) &
                                      /wanted%others%one_us))
            if (across < least_across) return
        end if
        across = real(ceiling(across), wp)
        grid%across = across
        grid%dx = 2.0_wp*normal%x_max/across
        grid%dy = width/across
    end function first_grid

    !> The next try, on a finer grid; none if it would not help, or not fit.
    pure type(grid_step_t) function next_grid(wanted, last, step, spent_us) result(grid)
        type(wanted_t), intent(in) :: wanted  !! target, tolerance and budget
        type(grid_step_t), intent(in) :: last !! the last try
        type(auto_step_t), intent(in) :: step !! what came of it
        real(wp), intent(in) :: spent_us      !! all time so far, us

        real(wp) :: growth, reach

        if (step%estimate >= unknown_error .or. last%number >= most_grids) return
        reach = min(last%most_across/last%across, largest_growth**(most_grids - last%number))
        if (wanted%tolerance > 0.0_wp .and. wanted%budget_us <= 0.0_wp .and. &
            step%estimate > largest_miss*wanted%tolerance*reach**wanted%others%order) return
        growth = min(last%most_across/last%across, largest_growth)
        if (wanted%tolerance > 0.0_wp) &
            growth = min(growth, max(least_growth, (step%estimate/(margin*wanted%tolerance)) &
                                                   **(1.0_wp/wanted%others%order)))
        if (wanted%budget_us > 0.0_wp) &
            growth = min(growth, sqrt(max(wanted%budget_us - spent_us, 0.0_wp) &
                                      /(step%normal_us + step%tangential_us)))
        if (growth < least_growth) return
        growth = real(ceiling(growth*last%across), wp)/last%across
        grid = last
        grid%number = last%number + 1
        grid%across = growth*last%across
        grid%dx = last%dx/growth
        grid%dy = last%dy/growth
    end function next_grid
end module faststrip_contact_grids
