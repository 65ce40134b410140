!> Where a strip solution starts when nothing is known yet.
module faststrip_normal_strip_start
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_strip_patches, only: patch_t, patches_t, max_patches
    use faststrip_normal_strip_state, only: strip_workspace_t, flattest
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: start_patches, resume_patches

contains

    !> First penetration and patches: those of the Hertz ellipse that fits the gap's width.
    !>
    !> Below a level c the gap is W wide, as is that of the parabola with B = 4 c/W^2. The level is
    !> the one at which the Hertz ellipse of A and B is W wide too; on a Hertzian gap this is the
    !> solution itself.
    pure subroutine start_patches(curve, compliance, demand, patches, penetration)
        type(gap_curve_t), intent(in) :: curve      !! a gap that was set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand          !! load or penetration
        type(patches_t), intent(out) :: patches     !! not yet shared into strips
        real(wp), intent(out) :: penetration        !! above the lowest height, mm

        ! Tuned [1]: Factor of the search, and ratio of the levels that ends it. Origin: chosen: the
        ! search takes some three steps.
        real(wp), parameter :: factor = 4.0_wp, close_enough = 1.05_wp
        ! The level tried first, in a length of the case's own: 0.01 mm at 100 kN on steel. Where
        ! the search starts decides which of the levels within 5 % it ends with.
        ! Tuned [1]. Origin: 0.01 mm at 100 kN on steel.
        real(wp), parameter :: first_level = 0.02_wp
        real(wp) :: low, high, level, y_from(max_patches), y_to(max_patches)
        type(hertz_t) :: hertz
        logical :: wider
        integer :: i

        high = demand%penetration
        if (demand%by_load) high = first_level*sqrt(compliance*demand%load)
        do i = 1, most_steps
            call fit_ellipse(curve, compliance, demand, high, y_from, y_to, patches%n, hertz, wider)
            if (.not. wider) exit
            high = factor*high
        end do
        low = high/factor
        do i = 1, most_steps
            call fit_ellipse(curve, compliance, demand, low, y_from, y_to, patches%n, hertz, wider)
            if (wider) exit
            high = low
            low = high/factor
        end do
        do while (high > close_enough*low)
            level = sqrt(low*high)
            call fit_ellipse(curve, compliance, demand, level, y_from, y_to, patches%n, hertz, &
                             wider)
            if (wider) then
                low = level
            else
                high = level
            end if
        end do
        level = sqrt(low*high)
        call fit_ellipse(curve, compliance, demand, level, y_from, y_to, patches%n, hertz, wider)
        penetration = hertz%penetration
        do i = 1, patches%n
            patches%at(i) = patch_t(y_from(i), y_to(i), seed_level=level, seed_length=hertz%a, &
                                    seed_pressure=hertz%pmax)
        end do
    end subroutine start_patches

    !> Take the last solution of the workspace, scaled to the new demand as Hertz contacts scale:
    !> lengths and pressures with load^(1/3), the penetration with load^(2/3).
    pure subroutine resume_patches(workspace, demand, patches, penetration)
        type(strip_workspace_t), intent(inout) :: workspace !! with a solution remembered
        type(demand_t), intent(in) :: demand                  !! load or penetration
        type(patches_t), intent(out) :: patches             !! not yet shared into strips
        real(wp), intent(out) :: penetration                !! above the lowest height, mm

        real(wp) :: factor, middle, half
        integer :: p, n

        if (demand%by_load) then
            factor = (demand%load/workspace%old_load)**(1.0_wp/3.0_wp)
        else
            factor = sqrt(demand%penetration/workspace%old_penetration)
        end if
        penetration = workspace%old_penetration/workspace%old_correction*factor**2
        n = sum(workspace%old%at(:workspace%old%n)%n_strips)
        workspace%old_p0(:n) = workspace%old_p0(:n)*factor
        workspace%old_half_length(:n) = workspace%old_half_length(:n)*factor
        do p = 1, workspace%old%n
            associate (patch => workspace%old%at(p))
                middle = 0.5_wp*(patch%y_from + patch%y_to)
                half = 0.5_wp*(patch%y_to - patch%y_from)*factor
                patch%y_from = max(middle - half, workspace%curve%y(1))
                patch%y_to = min(middle + half, workspace%curve%y(workspace%curve%n))
            end associate
        end do
        do p = 1, workspace%old%n - 1
            if (.not. workspace%old%at(p)%meets_next) cycle
            middle = 0.5_wp*(workspace%old%at(p)%y_to + workspace%old%at(p + 1)%y_from)
            workspace%old%at(p)%y_to = middle
            workspace%old%at(p + 1)%y_from = middle
        end do
        patches = workspace%old
    end subroutine resume_patches

    !> The parabola as wide as the gap at a level, and its Hertz ellipse: is that wider than both?
    pure subroutine fit_ellipse(curve, compliance, demand, level, y_from, y_to, n, hertz, wider)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        real(wp), intent(in) :: level ! from the lowest point
        real(wp), intent(inout) :: y_from(:), y_to(:)
        integer, intent(out) :: n
        type(hertz_t), intent(out) :: hertz
        logical, intent(out) :: wider

        type(status_t) :: status
        real(wp) :: h, inv2r, half_width, load

        call level_intervals(curve, curve%h_lowest + level, y_from, y_to, n)
        half_width = max(0.5_wp*sum(y_to(:n) - y_from(:n)), tiny(1.0_wp)**0.25_wp)
        call gap_at(curve, curve%y_lowest, h, inv2r)
        load = 1.0_wp
        if (demand%by_load) load = demand%load
        call hertz_solve(compliance, max(inv2r, flattest), level/half_width**2, load, hertz, status)
        if (.not. (demand%by_load .or. is_error(status))) then
            ! Penetration goes with load^(2/3).
            load = sqrt(demand%penetration/hertz%penetration)**3
            call hertz_solve(compliance, max(inv2r, flattest), level/half_width**2, load, hertz, &
                             status)
        end if
        wider = hertz%b > half_width
    end subroutine fit_ellipse
end module faststrip_normal_strip_start
