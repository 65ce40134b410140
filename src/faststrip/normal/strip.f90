!> NFASTSTRIP: normal contact by strips along the rolling direction.
!>
!> The paper gives the influence of a strip and not the algorithm that finds the patch. Here the
!> strips of a patch always fill it: its two ends move until the squared strip length, carried on
!> by a quadratic through the last three strips, vanishes at them. Passes alternate between
!> Newton's method for given edges (`faststrip_normal_strip_newton`) and moving the ends; strips
!> that leave cut or split a patch, and a scan outside the patches finds gaps that the deformed
!> surfaces have closed, which makes patches appear, grow or merge.
module faststrip_normal_strip
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp, pi
    use faststrip_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                st_bad_argument, st_bad_load, st_bad_material, st_not_finite, &
                                st_no_convergence, st_edge_of_data, st_workspace_too_small
    use faststrip_influence_closed, only: strip_influence_edges
    use faststrip_profile_gap, only: gap_t
    use faststrip_profile_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, gap_at, &
                                           level_intervals
    use faststrip_normal_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_strip_patches, only: patch_t, patches_t, max_patches, fewest_strips, &
                                              share_strips, only_match, nearest_patch, &
                                              take_in, sort_patches, join_met_patches, &
                                              cut_leaving_strips
    use faststrip_normal_strip_profile, only: profile_integral, profile_peak
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    use faststrip_normal_strip_newton, only: newton_workspace_t, reserve_newton, solve_strips, &
                                             newton_converged, newton_strips_leave
    implicit none
    private

    public :: strip_options_t, strip_workspace_t, normal_result_t
    public :: reserve_strip_workspace, set_strip_gap, strip_solve
    public :: fewest_strips

    integer, parameter :: max_scan = 64      ! points scanned in one stretch outside the patches
    integer, parameter :: max_passes = 60
    integer, parameter :: max_splits = 3     ! after so many splits patches are not merged again
    integer, parameter :: damped_pass = 6    ! from this pass on the ends move by damping only
    real(wp), parameter :: damping = 0.6_wp
    real(wp), parameter :: end_tolerance = 0.03_wp ! in widths of the end strip
    real(wp), parameter :: loose_end_tolerance = 0.3_wp ! the same, for the best pass to stand
    real(wp), parameter :: end_grading = 0.7_wp  ! 0: even strips; 1: as the sine
    real(wp), parameter :: forget = 0.05_wp ! how fast "too far" is forgotten, widths a pass
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp ! of the penetration
    real(wp), parameter :: plane_strain_share = 0.6_wp ! pressure of a new patch over a long one's
    real(wp), parameter :: flattest = 1.0e-9_wp    ! smallest A = 1/(2R) used, 1/mm

    !> What the user chooses.
    type :: strip_options_t
        integer :: strips_per_patch = 15      !! strips across the largest patch
        real(wp) :: tolerance = 1.0e-6_wp     !! relative size of Newton's last step
    end type strip_options_t

    !> The normal problem's figures.
    type :: normal_result_t
        real(wp) :: penetration = 0.0_wp !! approach D of the bodies, from h = 0, mm
        real(wp) :: area = 0.0_wp        !! contact area, mm2
        real(wp) :: pmax = 0.0_wp        !! largest pressure, MPa
        real(wp) :: y_min = 0.0_wp       !! left end of the contact, mm
        real(wp) :: y_max = 0.0_wp       !! right end of the contact, mm
        real(wp) :: x_max = 0.0_wp       !! largest half-length along x, mm
        integer :: n_patches = 0         !! number of contact patches
        integer :: passes = 0            !! how often the ends were moved
        integer :: iterations = 0        !! Newton iterations, all passes
    end type normal_result_t

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: strip_workspace_t
        private
        type(gap_curve_t) :: curve
        type(newton_workspace_t) :: newton
        type(patches_t) :: old
        integer :: max_strips = 0
        real(wp), allocatable :: y_left(:), y_right(:), height(:), inv2r(:)
        real(wp), allocatable :: p0(:), half_length(:)
        real(wp), allocatable :: old_eta(:), old_p0(:), old_half_length(:)
        logical, allocatable :: leaves(:)
    end type strip_workspace_t

contains

    !> Make room; the only allocation, to be done before the first solution.
    subroutine reserve_strip_workspace(workspace, max_strips, max_points, status)
        type(strip_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips     !! strips of all patches together, >= 3
        integer, intent(in) :: max_points     !! points of a gap, >= 5
        type(status_t), intent(out) :: status !! `st_bad_argument`

        if (max_strips < fewest_strips) then
            call set_status(status, st_bad_argument, 'room for fewer than 3 strips asked')
            return
        end if
        call reserve_gap_curve(workspace%curve, max_points, status)
        if (is_error(status)) return
        call reserve_newton(workspace%newton, max_strips)
        if (workspace%max_strips >= max_strips) return
        if (allocated(workspace%p0)) deallocate ( &
            workspace%y_left, workspace%y_right, workspace%height, workspace%inv2r, workspace%p0, &
            workspace%half_length, workspace%old_eta, workspace%old_p0, workspace%old_half_length, &
            workspace%leaves)
        allocate (workspace%y_left(max_strips), workspace%y_right(max_strips), &
                  workspace%height(max_strips), workspace%inv2r(max_strips), &
                  workspace%p0(max_strips), workspace%half_length(max_strips), &
                  workspace%old_eta(max_strips), workspace%old_p0(max_strips), &
                  workspace%old_half_length(max_strips), source=0.0_wp)
        allocate (workspace%leaves(max_strips), source=.false.)
        workspace%max_strips = max_strips
    end subroutine reserve_strip_workspace

    !> Hand over the gap that the next solutions are for.
    subroutine set_strip_gap(workspace, gap, status)
        type(strip_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_t), intent(in) :: gap        !! undeformed gap, mm
        type(status_t), intent(out) :: status !! those of `check_gap`, `st_workspace_too_small`

        call set_gap_curve(workspace%curve, gap, status)
    end subroutine set_strip_gap

    !> Solve the normal problem of the gap in the workspace.
    !>
    !> Errors: `st_bad_argument` (options), `st_not_finite`, `st_bad_load`, `st_bad_material`,
    !> `st_workspace_too_small` (no gap set, room for too few strips), `st_no_convergence`.
    !> Named limitation: `st_edge_of_data`, the contact runs to the end of the gap's points.
    subroutine strip_solve(workspace, compliance, load, options, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load               !! normal force Q, N
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance
        type(contact_strips_t), intent(inout) :: strips !! reserved; the strips of the solution
        type(normal_result_t), intent(out) :: result !! penetration, area, ...
        type(status_t), intent(out) :: status      !! how it ended

        type(patches_t) :: patches
        real(wp) :: penetration, last_penetration, move, best_move
        integer :: pass, outcome, n, splits
        logical :: changed

        call check_input(workspace, compliance, load, options, strips, status)
        if (is_error(status)) return
        call start(workspace%curve, compliance, load, options, patches, last_penetration)
        best_move = huge(1.0_wp)
        splits = 0
        workspace%old%n = 0
        do pass = 1, max_passes
            call place_strips(workspace, patches, n)
            if (n > workspace%max_strips .or. n > size(strips%p0)) then
                call set_status(status, st_workspace_too_small, &
                                'the patches need more strips than there is room for')
                return
            end if
            penetration = last_penetration
            call solve_strips( &
                workspace%y_left(:n), workspace%y_right(:n), workspace%height(:n), &
                workspace%inv2r(:n), compliance, load, options%tolerance, workspace%p0(:n), &
                workspace%half_length(:n), penetration, workspace%leaves(:n), &
                result%iterations, outcome, workspace%newton)
            result%passes = pass
            select case (outcome)
            case (newton_converged)
                last_penetration = penetration
                call remember(workspace, patches)
                call move_ends(workspace, pass, patches, move)
                call close_overlaps(workspace, compliance, penetration, splits < max_splits, &
                                    patches, changed)
                if (move < best_move .and. .not. changed) then
                    best_move = move
                    call record(workspace, patches, penetration, n, strips, result)
                end if
                if (changed) call share_strips(options%strips_per_patch, patches)
                if (move < end_tolerance .and. .not. changed) exit
            case (newton_strips_leave)
                call cut_leaving_strips(workspace%y_left(:n), workspace%y_right(:n), &
                                        workspace%leaves(:n), patches, splits)
                if (patches%n == 0) exit
                call share_strips(options%strips_per_patch, patches)
            case default
                exit
            end select
        end do
        if (best_move > loose_end_tolerance) then
            call set_status(status, st_no_convergence, &
                            'the ends of the contact patches did not settle')
        else if (reaches_edge(workspace%curve, result)) then
            call set_status(status, st_edge_of_data, &
                            'the contact runs to the end of the gap data')
        end if
    end subroutine strip_solve

    subroutine check_input(workspace, compliance, load, options, strips, status)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, load
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(in) :: strips
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. ieee_is_finite(load)) then
            call set_status(status, st_not_finite, &
                            'the load is not a finite number: '//number_text(load))
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load is not positive: '//trim(number_text(load))//' N')
        else if (.not. ieee_is_finite(compliance)) then
            call set_status(status, st_not_finite, &
                            'the compliance is not a finite number: '//number_text(compliance))
        else if (compliance <= 0.0_wp) then
            call set_status(status, st_bad_material, &
                            'the compliance is not positive: '//number_text(compliance))
        else if (options%strips_per_patch < fewest_strips) then
            call set_status(status, st_bad_argument, 'fewer than 3 strips per patch asked')
        else if (.not. (options%tolerance > 0.0_wp .and. options%tolerance <= 1.0e-2_wp)) then
            call set_status(status, st_bad_argument, 'the tolerance is outside (0, 0.01]: ' &
                            //number_text(options%tolerance))
        else if (workspace%curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set in the workspace')
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no room was reserved for the strips')
        end if
    end subroutine check_input

    !> First penetration and patches: those of the Hertz ellipse that fits the gap's width.
    !>
    !> Below a level c the gap is W wide, as is that of the parabola with B = 4 c/W^2. The level is
    !> the one at which the Hertz ellipse of A and B is W wide too; on a Hertzian gap this is the
    !> solution itself.
    pure subroutine start(curve, compliance, load, options, patches, penetration)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, load
        type(strip_options_t), intent(in) :: options
        type(patches_t), intent(out) :: patches
        real(wp), intent(out) :: penetration

        real(wp), parameter :: factor = 4.0_wp, close_enough = 1.05_wp
        real(wp) :: low, high, level, y_from(max_patches), y_to(max_patches)
        type(hertz_t) :: hertz
        logical :: wider
        integer :: i

        high = 1.0e-2_wp
        do i = 1, 100
            call fit_ellipse(curve, compliance, load, high, y_from, y_to, patches%n, hertz, wider)
            if (.not. wider) exit
            high = factor*high
        end do
        low = high/factor
        do i = 1, 100
            call fit_ellipse(curve, compliance, load, low, y_from, y_to, patches%n, hertz, wider)
            if (wider) exit
            high = low
            low = high/factor
        end do
        do while (high > close_enough*low)
            level = sqrt(low*high)
            call fit_ellipse(curve, compliance, load, level, y_from, y_to, patches%n, hertz, wider)
            if (wider) then
                low = level
            else
                high = level
            end if
        end do
        level = sqrt(low*high)
        call fit_ellipse(curve, compliance, load, level, y_from, y_to, patches%n, hertz, wider)
        penetration = hertz%penetration
        do i = 1, patches%n
            patches%at(i) = patch_t(y_from(i), y_to(i), seed_level=level, seed_length=hertz%a, &
                                    seed_pressure=hertz%pmax)
        end do
        call share_strips(options%strips_per_patch, patches)
    end subroutine start

    !> The parabola as wide as the gap at a level, and its Hertz ellipse: is that wider than both?
    pure subroutine fit_ellipse(curve, compliance, load, level, y_from, y_to, n, hertz, wider)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, load, level ! the level from the lowest point
        real(wp), intent(inout) :: y_from(:), y_to(:)
        integer, intent(out) :: n
        type(hertz_t), intent(out) :: hertz
        logical, intent(out) :: wider

        type(status_t) :: status
        real(wp) :: h, inv2r, half_width

        call level_intervals(curve, curve%h_lowest + level, y_from, y_to, n)
        half_width = max(0.5_wp*sum(y_to(:n) - y_from(:n)), tiny(1.0_wp)**0.25_wp)
        call gap_at(curve, curve%y_lowest, h, inv2r)
        call hertz_solve(compliance, max(inv2r, flattest), level/half_width**2, load, hertz, status)
        wider = hertz%b > half_width
    end subroutine fit_ellipse

    !> Cut the patches into strips and start them from the previous pass.
    !>
    !> The edges are graded towards the ends, where the strip lengths change fastest: with 0.7 the
    !> ends, the largest pressure and the penetration of the 20 contacts of the paper's section 5
    !> come out best.
    pure subroutine place_strips(workspace, patches, n)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(in) :: patches
        integer, intent(out) :: n ! number of strips; beyond the room there is, nothing is placed

        real(wp) :: middle, half, y, eta, h, a, ratio
        integer :: p, k, i, q

        n = sum(patches%at(:patches%n)%n_strips)
        if (n > workspace%max_strips) return
        i = 0
        do p = 1, patches%n
            middle = 0.5_wp*(patches%at(p)%y_from + patches%at(p)%y_to)
            half = 0.5_wp*(patches%at(p)%y_to - patches%at(p)%y_from)
            q = only_match(workspace%old, patches, p)
            do k = 1, patches%at(p)%n_strips
                i = i + 1
                if (k == 1) then
                    workspace%y_left(i) = patches%at(p)%y_from
                else
                    workspace%y_left(i) = workspace%y_right(i - 1)
                end if
                workspace%y_right(i) = middle &
                                       + half*graded(2.0_wp*k/patches%at(p)%n_strips - 1.0_wp)
                y = 0.5_wp*(workspace%y_left(i) + workspace%y_right(i))
                call gap_at(workspace%curve, y, h, a)
                workspace%height(i) = h - workspace%curve%h_lowest
                workspace%inv2r(i) = max(a, flattest)
                eta = (y - middle)/half
                if (patches%at(p)%seed_length > 0.0_wp) then
                    ratio = sqrt(1.0_wp - eta**2)
                    if (workspace%height(i) < patches%at(p)%seed_level) &
                        ratio = sqrt(1.0_wp - workspace%height(i)/patches%at(p)%seed_level)
                    workspace%half_length(i) = patches%at(p)%seed_length*ratio
                    workspace%p0(i) = patches%at(p)%seed_pressure*ratio
                else if (q > 0) then
                    call start_from_old(workspace, q, eta, eta, i)
                else
                    q = nearest_patch(workspace%old, y)
                    ratio = (2.0_wp*y - workspace%old%at(q)%y_from - workspace%old%at(q)%y_to) &
                            /(workspace%old%at(q)%y_to - workspace%old%at(q)%y_from)
                    call start_from_old(workspace, q, max(-0.95_wp, min(0.95_wp, ratio)), eta, i)
                    q = 0
                end if
            end do
        end do
    end subroutine place_strips

    !> Grading of a patch's edges: strips grow narrower towards its ends; -1, 0, 1 stay in place.
    pure real(wp) function graded(t)
        real(wp), intent(in) :: t

        graded = (1.0_wp - end_grading)*t + end_grading*sin(0.5_wp*pi*t)
    end function graded

    !> Keep a solution as the start of the next pass: pressures and lengths over the ellipse
    !> factor sqrt(1 - eta^2), which makes them smooth up to the ends.
    pure subroutine remember(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(inout) :: patches

        real(wp) :: middle, half, ellipse
        integer :: p, k, i

        i = 0
        do p = 1, patches%n
            middle = 0.5_wp*(patches%at(p)%y_from + patches%at(p)%y_to)
            half = 0.5_wp*(patches%at(p)%y_to - patches%at(p)%y_from)
            do k = 1, patches%at(p)%n_strips
                i = i + 1
                workspace%old_eta(i) = (0.5_wp*(workspace%y_left(i) + workspace%y_right(i)) &
                                        - middle)/half
                ellipse = sqrt(1.0_wp - workspace%old_eta(i)**2)
                workspace%old_p0(i) = workspace%p0(i)/ellipse
                workspace%old_half_length(i) = workspace%half_length(i)/ellipse
            end do
        end do
        patches%at%seed_length = 0.0_wp
        workspace%old = patches
    end subroutine remember

    !> Start strip i, at `eta` of its patch, from old patch q at `eta_old`.
    pure subroutine start_from_old(workspace, q, eta_old, eta, i)
        type(strip_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: q, i
        real(wp), intent(in) :: eta_old, eta

        integer :: first, last, k
        real(wp) :: t, ellipse

        first = 1 + sum(workspace%old%at(:q - 1)%n_strips)
        last = first + workspace%old%at(q)%n_strips - 1
        do k = first, last - 2
            if (workspace%old_eta(k + 1) >= eta_old) exit
        end do
        t = (eta_old - workspace%old_eta(k))/(workspace%old_eta(k + 1) - workspace%old_eta(k))
        t = max(0.0_wp, min(1.0_wp, t))
        ellipse = sqrt(1.0_wp - eta**2)
        workspace%p0(i) = ellipse*((1.0_wp - t)*workspace%old_p0(k) + t*workspace%old_p0(k + 1))
        workspace%half_length(i) = ellipse*((1.0_wp - t)*workspace%old_half_length(k) &
                                            + t*workspace%old_half_length(k + 1))
    end subroutine start_from_old

    !> Move the ends of all patches to where the squared strip length vanishes.
    pure subroutine move_ends(workspace, pass, patches, move)
        type(strip_workspace_t), intent(in) :: workspace
        integer, intent(in) :: pass
        type(patches_t), intent(inout) :: patches
        real(wp), intent(out) :: move ! largest move, in widths of the end strip

        real(wp) :: factor, step, width, y_low, y_high
        integer :: p, first, last

        factor = 1.0_wp
        if (pass >= damped_pass) factor = damping
        y_low = workspace%curve%y(1)
        y_high = workspace%curve%y(workspace%curve%n)
        move = 0.0_wp
        last = 0
        do p = 1, patches%n
            first = last + 1
            last = last + patches%at(p)%n_strips
            associate (patch => patches%at(p))
                width = workspace%y_right(first) - workspace%y_left(first)
                step = min(factor*end_step(workspace, first, 1)*width, patch%y_from - y_low)
                if (patch%y_from - step <= patch%too_far_from) &
                    step = 0.5_wp*(patch%y_from - patch%too_far_from)
                patch%y_from = patch%y_from - step
                patch%too_far_from = min(patch%too_far_from, patch%y_from) - forget*width
                move = max(move, abs(step)/width)
                width = workspace%y_right(last) - workspace%y_left(last)
                step = min(factor*end_step(workspace, last, -1)*width, y_high - patch%y_to)
                if (patch%y_to + step >= patch%too_far_to) &
                    step = 0.5_wp*(patch%too_far_to - patch%y_to)
                patch%y_to = patch%y_to + step
                patch%too_far_to = max(patch%too_far_to, patch%y_to) + forget*width
                move = max(move, abs(step)/width)
            end associate
        end do
    end subroutine move_ends

    !> How far an end should move outwards, in widths of its end strip, between -1 and 2.
    pure real(wp) function end_step(workspace, k, inward) result(step)
        type(strip_workspace_t), intent(in) :: workspace
        integer, intent(in) :: k      ! the end strip
        integer, intent(in) :: inward ! 1 at a left end, -1 at a right end

        real(wp), parameter :: farthest_in = -1.0_wp, farthest_out = 2.0_wp
        real(wp) :: y(3), q(3), width, d2, d3, slope, bend, b, discriminant, s
        integer :: j

        width = workspace%y_right(k) - workspace%y_left(k)
        do j = 1, 3
            associate (i => k + (j - 1)*inward)
                y(j) = 0.5_wp*(workspace%y_left(i) + workspace%y_right(i))/width
                q(j) = (workspace%half_length(i)/workspace%half_length(k))**2
            end associate
        end do
        ! q(s) = 1 + b s + bend s^2 with s from the end strip's middle outwards.
        d2 = abs(y(2) - y(1))
        d3 = abs(y(3) - y(1))
        slope = (q(1) - q(2))/d2
        bend = (slope - (q(2) - q(3))/(d3 - d2))/d3
        b = slope + bend*d2
        discriminant = b*b - 4.0_wp*bend
        s = 0.5_wp + farthest_out
        if (discriminant >= 0.0_wp .and. b < 0.0_wp) then
            s = 2.0_wp/(sqrt(discriminant) - b)
        else if (bend < 0.0_wp) then
            s = -(b + sqrt(discriminant))/(2.0_wp*bend)
        else if (q(2) > 1.0_wp) then
            ! A long tail, as between two patches about to meet: xd itself runs out evenly. Both
            ! rules agree where the quadratic has a double root.
            s = d2/(sqrt(q(2)) - 1.0_wp)
        end if
        step = max(farthest_in, min(farthest_out, s - 0.5_wp))
    end function end_step

    !> Find places outside the patches where the deformed surfaces would overlap, and patches that
    !> have met: add, extend or merge patches.
    pure subroutine close_overlaps(workspace, compliance, penetration, may_merge, patches, changed)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, penetration
        logical, intent(in) :: may_merge
        type(patches_t), intent(inout) :: patches
        logical, intent(out) :: changed

        real(wp) :: y_from(4*max_patches), y_to(4*max_patches), low, high, width
        integer :: i, n, p
        type(patches_t) :: solved

        changed = .false.
        solved = patches
        width = maxval((patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from) &
                       /patches%at(:patches%n)%n_strips)
        call level_intervals(workspace%curve, workspace%curve%h_lowest + penetration, y_from, &
                             y_to, n)
        do i = 1, n
            low = y_from(i)
            do p = 1, solved%n
                if (solved%at(p)%y_to <= low .or. solved%at(p)%y_from >= y_to(i)) cycle
                high = solved%at(p)%y_from
                if (high > low) call scan(workspace, compliance, penetration, low, high, width, &
                                          patches, changed)
                low = max(low, solved%at(p)%y_to)
            end do
            if (y_to(i) > low) call scan(workspace, compliance, penetration, low, y_to(i), &
                                         width, patches, changed)
        end do
        call sort_patches(patches)
        call join_met_patches(may_merge, patches, changed)
    end subroutine close_overlaps

    !> Scan one stretch outside the patches for overlap.
    pure subroutine scan(workspace, compliance, penetration, low, high, width, patches, changed)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, penetration, low, high, width
        type(patches_t), intent(inout) :: patches
        logical, intent(inout) :: changed

        real(wp) :: y, dy, depth, deepest, h, inv2r
        integer :: j, m, from
        type(patch_t) :: seed

        m = max(2, min(max_scan, ceiling(2.0_wp*(high - low)/width)))
        dy = (high - low)/m
        from = 0
        deepest = 0.0_wp
        do j = 1, m + 1
            depth = 0.0_wp
            if (j <= m) then
                y = low + (j - 0.5_wp)*dy
                depth = overlap_depth(workspace, compliance, penetration, y)
            end if
            if (depth > overlap_tolerance*penetration) then
                if (from == 0) from = j
                deepest = max(deepest, depth)
            else if (from > 0) then
                call gap_at(workspace%curve, low + 0.5_wp*(from + j - 2)*dy, h, inv2r)
                inv2r = max(inv2r, flattest)
                seed = patch_t(low + (from - 1)*dy, low + (j - 1)*dy, fewest_strips)
                seed%seed_length = sqrt(deepest/inv2r)
                seed%seed_pressure = plane_strain_share*2.0_wp*inv2r*seed%seed_length &
                                     /(pi*compliance)
                call take_in(seed, low, high, dy, patches, changed)
                from = 0
                deepest = 0.0_wp
            end if
        end do
    end subroutine scan

    !> By how much the deformed surfaces overlap at a point outside the patches, mm.
    pure real(wp) function overlap_depth(workspace, compliance, penetration, y) result(depth)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, penetration, y

        real(wp) :: h, inv2r, displacement
        integer :: s

        call gap_at(workspace%curve, y, h, inv2r)
        displacement = 0.0_wp
        do s = 1, sum(workspace%old%at(:workspace%old%n)%n_strips)
            displacement = displacement + compliance*workspace%p0(s)*workspace%half_length(s) &
                           *strip_influence_edges( &
                           (workspace%y_left(s) - y)/workspace%half_length(s), &
                           (workspace%y_right(s) - y)/workspace%half_length(s))
        end do
        depth = penetration - (h - workspace%curve%h_lowest) - displacement
    end function overlap_depth

    !> Write a converged pass into the result.
    pure subroutine record(workspace, patches, penetration, n, strips, result)
        type(strip_workspace_t), intent(in) :: workspace
        type(patches_t), intent(in) :: patches
        real(wp), intent(in) :: penetration
        integer, intent(in) :: n
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        integer :: p, first, last

        strips%n = n
        strips%n_patches = patches%n
        strips%y_left(:n) = workspace%y_left(:n)
        strips%y_right(:n) = workspace%y_right(:n)
        strips%p0(:n) = workspace%p0(:n)
        strips%half_length(:n) = workspace%half_length(:n)
        result%area = 0.0_wp
        result%pmax = 0.0_wp
        result%x_max = 0.0_wp
        last = 0
        do p = 1, patches%n
            first = last + 1
            last = last + patches%at(p)%n_strips
            strips%patch(first:last) = p
            associate (left => workspace%y_left(first:last), right => workspace%y_right(first:last))
                result%area = result%area + 2.0_wp*profile_integral( &
                    left, right, workspace%half_length(first:last))
                result%pmax = max(result%pmax, profile_peak(left, right, workspace%p0(first:last)))
                result%x_max = max(result%x_max, &
                                   profile_peak(left, right, workspace%half_length(first:last)))
            end associate
        end do
        result%penetration = penetration + workspace%curve%h_lowest
        result%y_min = patches%at(1)%y_from
        result%y_max = patches%at(patches%n)%y_to
        result%n_patches = patches%n
    end subroutine record

    !> Does the contact run to an end of the gap's points?
    pure logical function reaches_edge(curve, result)
        type(gap_curve_t), intent(in) :: curve
        type(normal_result_t), intent(in) :: result

        reaches_edge = result%y_min <= curve%y(1) .or. result%y_max >= curve%y(curve%n)
    end function reaches_edge
end module faststrip_normal_strip
