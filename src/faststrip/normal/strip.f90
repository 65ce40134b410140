!> Normal contact by strips along the rolling direction: NFASTSTRIP.
!>
!> The paper gives the influence of a strip and not the algorithm that finds the patch. Here the
!> strips of a patch always fill it: its two ends move until the squared strip length, carried on
!> by a quadratic through the last three strips, vanishes at them. Near the solution strips and
!> ends are solved for together (`faststrip_normal_strip_coupled`). Far from it, passes alternate
!> between Newton's method for given edges (`faststrip_normal_strip_newton`) and moving ends; strips
!> that leave cut or split a patch, and a scan outside the patches finds gaps that the deformed
!> surfaces have closed, which makes patches appear, grow or merge
!> (`faststrip_normal_strip_patches`, `faststrip_normal_strip_ends`).
!>
!> Many strips are reached by levels: 7 find the patches, 15 and more refine them. Where 20 or
!> fewer strips do not settle twice as many are tried; a gap whose ends do not settle with them
!> either, within a bounded work, gets the answer of `faststrip_normal_lattice`.
!>
!> Of a gap and its mirror image one is solved and mirrored (`is_mirror_image`): what is decided on
!> the way, rounding included, is the same on a left and on a right wheel.
module faststrip_normal_strip
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, add_words, message_length, st_bad_argument, &
                                     st_bad_load, st_bad_material, st_not_finite, st_no_contact, &
                                     st_fewer_strips, st_fallback_used, st_overlap_left, &
                                     st_more_strips, st_workspace_too_small
    use faststrip_base_material, only: check_compliance
    use faststrip_normal_certificate, only: certificate_t, certify_strips
    use faststrip_normal_lattice, only: lattice_solve, lattice_solve_penetration, &
                                        lattice_errors, lattice_errors_t, forget_lattice_errors
    use faststrip_normal_limitations, only: check_curvature, check_penetration, &
                                            name_limitations, name_steps, add_limitation, &
                                            default_resolution
    use faststrip_normal_strips, only: contact_strips_t, strips_load, mirror_strips
    use faststrip_normal_strip_equations, only: cost_work, step_work
    use faststrip_normal_strip_newton, only: solve_strips, newton_converged, newton_strips_leave
    use faststrip_normal_strip_coupled, only: settle_coupled
    use faststrip_normal_strip_patches, only: patches_t, fewest_strips, share_strips, &
                                              cut_leaving_strips, free_ends, &
                                              drop_slivers
    use faststrip_normal_patch_curves, only: curve_integral, curve_peak
    use faststrip_normal_strip_state, only: strip_workspace_t, reserve_strip_workspace, &
                                            set_strip_gap, place_strips, remember, mirror_old
    use faststrip_normal_strip_start, only: start_patches, resume_patches
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_geometry_gap_curve, only: mirror_gap_curve
    use faststrip_normal_strip_ends, only: move_ends, close_overlaps, overlap_left
    implicit none
    private

    public :: strip_options_t, strip_workspace_t
    public :: reserve_strip_workspace, set_strip_gap, strip_solve, strip_solve_penetration
    public :: strip_solve_demand, estimate_strips
    public :: fewest_strips, strips_auto, strips_auto_most

    !> As many strips as the largest pressure and the penetration need to settle, 15 to 41, or to be
    !> resolved, up to `strips_auto_most`.
    integer, parameter :: strips_auto = 0
    integer, parameter :: strips_auto_most = 81

    integer, parameter :: scout_strips = 7   ! strips that find the patches
    integer, parameter :: fewest_scouted = 10 ! fewer strips find the patches themselves
    integer, parameter :: first_level = 15   ! strips that refine them
    integer, parameter :: most_at_once = 20  ! more strips than these are reached by further levels,
    integer, parameter :: level_factor = 3   ! each with at most so many times the strips
    integer, parameter :: most_levels = 9
    real(wp), parameter :: coarse_tolerance = 1.0e-3_wp ! of the scouting strips
    integer, parameter :: auto_levels(5) = [15, 27, 41, 61, strips_auto_most]
    integer, parameter :: auto_enough = 41 ! for a solution that is resolved
    real(wp), parameter :: auto_pmax = 5.0e-3_wp, auto_penetration = 5.0e-4_wp ! relative change

    integer, parameter :: most_fallback_strips = 31 ! its cost rises steeply, its accuracy does not
    integer, parameter :: max_passes = 40    ! in one level
    integer, parameter :: max_couplings = 4  ! so often strips and ends are tried together
    integer, parameter :: max_splits = 3     ! after so many splits patches are not merged again
    integer, parameter :: max_splits_near = 1  ! more: the start was not that near
    integer, parameter :: max_splits_at_all = 8 ! more: this leads nowhere
    ! Work of all levels together: so much, and so many steps of all strips.
    real(wp), parameter :: work_to_begin = 2.0e5_wp, most_steps = 60.0_wp
    real(wp), parameter :: end_tolerance = 0.03_wp ! in widths of the end strip
    real(wp), parameter :: coupling_move = 1.0_wp ! less: strips and ends are solved together
    real(wp), parameter :: loose_end_tolerance = 0.3_wp ! the same, for the best pass to stand
    ! Newton's tolerance while the ends still move by more than the loose tolerance, and by more
    ! than the other: what is left then is far below what the ends' moves change.
    real(wp), parameter :: far_tolerance = 0.1_wp, near_tolerance = 1.0e-2_wp

    real(wp), parameter :: sliver = 1.0e-10_wp ! of the gap's range: too narrow for a patch
    real(wp), parameter :: tolerated_overlap = 0.01_wp ! of the penetration, in rough gaps

    !> What the user chooses.
    type :: strip_options_t
        integer :: strips_per_patch = 15  !! strips across the largest patch, or `strips_auto`
        real(wp) :: tolerance = 1.0e-6_wp !! relative size of Newton's last step
        logical :: warm_start = .false.   !! from the last solution of this workspace, if any
        real(wp) :: resolution_limit = default_resolution
            !! `strips_auto` goes on until no estimated error is above this
    end type strip_options_t

contains

    !> Solve the normal problem of the gap in the workspace under a load.
    !>
    !> Errors: `st_bad_argument` (options), `st_not_finite`, `st_bad_load`, `st_bad_material`,
    !> `st_workspace_too_small` (no gap set, capacity for too few strips), `st_out_of_range` and
    !> `st_linear_algebra` (a contact beyond all proportion; a penetration that is not positive),
    !> `st_no_finite_patch` (a contact that is flat or hollow along x).
    !> Named limitations: `st_fallback_used`, the ends did not settle and
    !> `faststrip_normal_lattice` gave the answer; `st_more_strips`, more strips than asked were
    !> used,
    !> because those did not settle or are fewer than three;
    !> `st_overlap_left`, in a rough gap the surfaces overlap beside the strips;
    !> `st_edge_of_data`, the contact runs to the end of the gap's points; `st_flat_along_x` and
    !> `st_conformal`: see `faststrip_normal_limitations`;
    !> `st_fewer_strips`, the solution has fewer strips than asked, because more did not settle.
    subroutine strip_solve(workspace, compliance, load, options, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load               !! normal force Q, N
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance, start
        type(contact_strips_t), intent(inout) :: strips !! reserved; the strips of the solution
        type(normal_result_t), intent(out) :: result !! penetration, area, ...
        type(status_t), intent(out) :: status      !! how it ended

        call check_input(workspace, compliance, options, strips, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(load)) then
            call set_status(status, st_not_finite, &
                            'the load is not a finite number: '//number_text(load))
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load is not positive: '//trim(number_text(load))//' N')
        else
            call solve(workspace, compliance, demand_t(load=load), options, strips, result, status)
        end if
    end subroutine strip_solve

    !> The same for a load or a penetration.
    subroutine strip_solve_demand(workspace, compliance, demand, options, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand       !! load or penetration
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance, start
        type(contact_strips_t), intent(inout) :: strips !! reserved; the strips of the solution
        type(normal_result_t), intent(out) :: result !! load, penetration, area, ...
        type(status_t), intent(out) :: status      !! how it ended

        if (demand%by_load) then
            call strip_solve(workspace, compliance, demand%load, options, strips, result, status)
        else
            call strip_solve_penetration(workspace, compliance, demand%penetration, options, &
                                         strips, result, status)
        end if
    end subroutine strip_solve_demand

    !> Solve the normal problem of the gap in the workspace for a penetration; the load is in the
    !> result. Errors as `strip_solve`, and `st_no_contact`: the bodies do not reach each other.
    subroutine strip_solve_penetration(workspace, compliance, penetration, options, strips, &
                                       result, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap set
        real(wp), intent(in) :: compliance         !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration        !! approach D of the bodies, from h = 0, mm
        type(strip_options_t), intent(in) :: options !! number of strips, tolerance, start
        type(contact_strips_t), intent(inout) :: strips !! reserved; the strips of the solution
        type(normal_result_t), intent(out) :: result !! load, area, ...
        type(status_t), intent(out) :: status      !! how it ended

        real(wp) :: depth

        call check_input(workspace, compliance, options, strips, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(penetration)) then
            call set_status(status, st_not_finite, 'the penetration is not a finite number: ' &
                            //number_text(penetration))
            return
        end if
        depth = penetration - workspace%curve%h_lowest
        if (depth <= 0.0_wp) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(penetration))//' mm, lowest gap ' &
                            //trim(number_text(workspace%curve%h_lowest))//' mm')
        else
            call solve(workspace, compliance, demand_t(by_load=.false., penetration=depth), &
                       options, strips, result, status)
        end if
    end subroutine strip_solve_penetration

    subroutine solve(workspace, compliance, goal, options, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: goal
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        character(len=message_length) :: words
        real(wp) :: penetration ! above the lowest height
        integer :: n_settled    ! strips per patch that settled, 0: the lattice's answer
        logical :: all_settled, mirrored

        mirrored = workspace%curve%is_image
        if (workspace%old%n > 0 .and. (workspace%old_is_mirrored .neqv. mirrored)) &
            call mirror_old(workspace)
        workspace%old_is_mirrored = mirrored
        if (mirrored) call mirror_gap_curve(workspace%curve)
        call search(workspace, compliance, goal, options, strips, result, n_settled, &
                    all_settled, status)
        if (mirrored) then
            call mirror_gap_curve(workspace%curve)
            call mirror_strips(strips)
            if (.not. is_error(status)) call mirror_ends(result)
        end if
        if (is_error(status)) return
        penetration = result%penetration - workspace%curve%h_lowest
        if (n_settled > 0) then
            if (overlap_left(workspace%curve, compliance, penetration, strips) &
                > tolerated_overlap) &
                call add_limitation(status, st_overlap_left, 'surfaces overlap outside the ' &
                                    //'patches by more than 1 % of the penetration: a rough gap, ' &
                                    //'or one that is cut off')
        end if
        call name_limitations(workspace%curve, strips, status)
        if (.not. is_error(status)) &
            call name_steps(workspace%curve, penetration, strips, status)
        call check_penetration(workspace%curve, result%penetration, status)
        if (is_error(status)) then
            workspace%old%n = 0
            result = normal_result_t()
            return
        end if
        if (n_settled == 0) return
        if (options%strips_per_patch /= strips_auto .and. n_settled > options%strips_per_patch) then
            words = count_text(n_settled)
            call add_words(words, ' strips used where '//count_text(options%strips_per_patch))
            call add_words(words, ' were asked, which did not settle')
            call add_limitation(status, st_more_strips, words)
        end if
        ! Of itself, auto asks for as many as are resolved.
        if (.not. (all_settled .or. options%strips_per_patch == strips_auto)) &
            call add_limitation(status, st_fewer_strips, &
                                'fewer strips than asked: more did not settle')
    end subroutine solve

    !> The ends of a result under y -> -y.
    pure subroutine mirror_ends(result)
        type(normal_result_t), intent(inout) :: result

        real(wp) :: y_min

        y_min = result%y_min
        result%y_min = -result%y_max
        result%y_max = -y_min
    end subroutine mirror_ends

    !> Solve by levels of strips, or else by the lattice.
    subroutine search(workspace, compliance, goal, options, strips, result, n_settled, &
                      all_settled, status)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: goal
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        integer, intent(out) :: n_settled    ! strips per patch of the solution; 0: the lattice's
        logical, intent(out) :: all_settled  ! did as many as were asked settle?
        type(status_t), intent(inout) :: status

        type(patches_t) :: patches
        type(normal_result_t) :: coarser
        real(wp) :: penetration
        integer :: level, levels(most_levels), n_levels, first_counted
        logical :: near, resumed, scratch

        call forget_lattice_errors(workspace%lattice)
        call plan_levels(options%strips_per_patch, levels, n_levels, first_counted)
        near = options%warm_start .and. workspace%old%n > 0
        resumed = near
        scratch = .not. near
        level = 1
        if (near) then
            call resume_patches(workspace, goal, patches, penetration)
            level = merge(first_counted, n_levels, options%strips_per_patch == strips_auto)
        end if
        n_settled = 0
        do while (level <= n_levels)
            if (scratch) then
                call start_patches(workspace%curve, compliance, goal, patches, penetration)
                workspace%old%n = 0
            end if
            coarser = result
            call free_ends(patches)
            call settle(workspace, compliance, goal, &
                        merge(options%tolerance, max(options%tolerance, coarse_tolerance), &
                              level >= first_counted), &
                        levels(level), maxval(levels(:n_levels)), near, patches, penetration, &
                        strips, result, all_settled)
            if (all_settled) then
                if (level >= first_counted) n_settled = levels(level)
                near = .true.
                resumed = .false.
                scratch = .false.
                level = level + 1
                if (options%strips_per_patch /= strips_auto .or. level <= first_counted + 1) cycle
                if (.not. is_resolved(workspace, compliance, strips, result, &
                                      options%resolution_limit)) cycle
                if (result%strips_across >= auto_enough .or. &
                    abs(result%pmax - coarser%pmax) <= auto_pmax*result%pmax .and. &
                    abs(result%penetration - coarser%penetration) &
                    <= auto_penetration*result%penetration) exit
            else if (scratch) then
                if (n_settled > 0) exit
                ! Where a neck or an edge is too fine for few strips, more may settle.
                if (level == n_levels) then
                    if (levels(level) > min(most_at_once, max(options%strips_per_patch, &
                                                              fewest_strips)) &
                        .or. level == most_levels) exit
                    n_levels = level + 1
                    levels(n_levels) = 2*levels(level) + 1
                end if
                level = level + 1
            else
                if (resumed) level = 1
                if (levels(level) > most_at_once) exit
                near = .false.
                resumed = .false.
                scratch = .true.
            end if
        end do
        result%iterations = result%cost%iterations
        if (n_settled == 0) then
            workspace%old%n = 0
            call fall_back(workspace, compliance, goal, &
                           min(maxval(levels(:n_levels)), most_fallback_strips), strips, result, &
                           status)
            return
        end if
        workspace%old_load = result%load
        workspace%old_penetration = penetration
        ! What did not settle is no start for the next solution.
        if (.not. all_settled) workspace%old%n = 0
    end subroutine search

    !> How wrong the last solution of a workspace is: by its certificate, and by the estimate of the
    !> lattice that was fallen back to. Nothing is allocated. Errors: those of `certify_strips`.
    pure subroutine estimate_strips(workspace, compliance, strips, result, certificate, status)
        type(strip_workspace_t), intent(in) :: workspace !! with the gap that was solved
        real(wp), intent(in) :: compliance               !! H of eq. (4), 1/MPa
        type(contact_strips_t), intent(in) :: strips     !! the solution
        type(normal_result_t), intent(in) :: result      !! its figures
        type(certificate_t), intent(out) :: certificate  !! residuals and estimated errors
        type(status_t), intent(out) :: status            !! how it ended

        type(lattice_errors_t) :: errors

        call certify_strips(workspace%curve, compliance, strips, result, certificate, status)
        if (is_error(status)) return
        errors = lattice_errors(workspace%lattice)
        if (.not. errors%is_known) return
        certificate%est_err_penetration = errors%est_err_penetration
        certificate%est_err_pmax = errors%est_err_pmax
        certificate%est_err_area = errors%est_err_area
    end subroutine estimate_strips

    !> Are the estimated errors not above a limit?
    logical function is_resolved(workspace, compliance, strips, result, limit)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, limit
        type(contact_strips_t), intent(in) :: strips
        type(normal_result_t), intent(in) :: result

        type(certificate_t) :: certificate
        type(status_t) :: status

        call certify_strips(workspace%curve, compliance, strips, result, certificate, status)
        is_resolved = .not. is_error(status) &
                      .and. max(certificate%est_err_penetration, certificate%est_err_pmax, &
                                certificate%est_err_area) <= limit
    end function is_resolved

    !> By which numbers of strips the asked one is reached.
    pure subroutine plan_levels(strips_per_patch, levels, n_levels, first_counted)
        integer, intent(in) :: strips_per_patch
        integer, intent(out) :: levels(:), n_levels
        integer, intent(out) :: first_counted ! the first whose solution may be the answer

        levels = 0
        first_counted = 2
        if (strips_per_patch == strips_auto) then
            n_levels = 1 + size(auto_levels)
            levels(1) = scout_strips
            levels(2:n_levels) = auto_levels
            return
        end if
        n_levels = 1
        levels(1) = max(strips_per_patch, fewest_strips)
        if (strips_per_patch < fewest_scouted) then
            first_counted = 1
            return
        end if
        levels(1) = scout_strips
        do
            n_levels = n_levels + 1
            levels(n_levels) = strips_per_patch
            if (strips_per_patch <= most_at_once .or. n_levels == most_levels) exit
            levels(n_levels) = first_level
            if (n_levels > 2) levels(n_levels) = level_factor*levels(n_levels - 1)
            if (levels(n_levels)*level_factor >= strips_per_patch) then
                n_levels = n_levels + 1
                levels(n_levels) = strips_per_patch
                exit
            end if
        end do
    end subroutine plan_levels

    !> The answer of a fixed lattice, for a gap whose ends did not settle.
    subroutine fall_back(workspace, compliance, goal, strips_per_patch, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: goal
        integer, intent(in) :: strips_per_patch
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        real(wp) :: penetration

        if (goal%by_load) then
            call lattice_solve(workspace%lattice, workspace%curve, compliance, goal%load, &
                               strips_per_patch, strips, penetration, status)
        else
            penetration = goal%penetration + workspace%curve%h_lowest
            call lattice_solve_penetration(workspace%lattice, workspace%curve, compliance, &
                                           penetration, strips_per_patch, strips, status)
        end if
        if (is_error(status)) return
        call summarize(strips, penetration, result)
        call set_status(status, st_fallback_used, &
                        'the ends of the contact patches did not settle: fixed lattice used')
    end subroutine fall_back

    !> Passes with one number of strips until the ends rest; keeps the best converged pass.
    subroutine settle(workspace, compliance, goal, tolerance, strips_per_patch, wanted, &
                      near, patches, penetration, strips, result, settled)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance, tolerance
        type(demand_t), intent(in) :: goal
        integer, intent(in) :: strips_per_patch
        integer, intent(in) :: wanted ! strips per patch in the end
        logical, intent(in) :: near ! do the strips start near a solution?
        type(patches_t), intent(inout) :: patches
        real(wp), intent(inout) :: penetration
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        logical, intent(out) :: settled

        real(wp) :: trial, move, best_move, pass_tolerance, narrowest
        integer :: pass, outcome, n, splits, couplings
        logical :: changed, at_rest, coupled
        type(patches_t) :: solved

        settled = .false.
        best_move = huge(1.0_wp)
        splits = 0
        couplings = 0
        pass_tolerance = merge(near_tolerance, far_tolerance, near)
        at_rest = .false.
        narrowest = sliver*(workspace%curve%y(workspace%curve%n) - workspace%curve%y(1))
        solved = patches
        call share_strips(strips_per_patch, patches)
        ! A small patch keeps its strips where one more or less would only cost a new Jacobian.
        if (near .and. maxval(solved%at(:solved%n)%n_strips) == strips_per_patch &
            .and. all(abs(solved%at(:solved%n)%n_strips - patches%at(:solved%n)%n_strips) <= 1)) &
            patches = solved
        do pass = 1, max_passes
            call drop_slivers(narrowest, patches)
            if (patches%n == 0) exit
            call place_strips(workspace, patches, n)
            if (n > min(workspace%max_strips, size(strips%p0))) exit
            if (cost_work(result%cost) > work_to_begin &
                + most_steps*step_work(max(n, wanted))) exit
            trial = penetration
            solved = patches
            coupled = near .and. pass == 1
            if (.not. coupled) then
                pass_tolerance = max(pass_tolerance, tolerance)
                call solve_strips( &
                    workspace%y_left(:n), workspace%y_right(:n), workspace%height(:n), &
                    workspace%inv2r(:n), compliance, goal, pass_tolerance, &
                    workspace%p0(:n), workspace%half_length(:n), trial, workspace%leaves(:n), &
                    result%cost, outcome, workspace%newton)
                result%passes = result%passes + 1
                if (outcome == newton_strips_leave) then
                    call cut_leaving_strips(workspace%y_left(:n), workspace%y_right(:n), &
                                            workspace%leaves(:n), patches, splits)
                    if (patches%n == 0) exit
                    if (splits > merge(max_splits_near, max_splits_at_all, near)) exit
                    call share_strips(strips_per_patch, patches)
                    cycle
                else if (outcome /= newton_converged) then
                    exit
                end if
                penetration = trial
                call remember(workspace, patches)
                call move_ends(workspace, pass, patches, move)
                call close_overlaps(workspace, compliance, penetration, splits < max_splits, &
                                    patches, changed)
                if (changed) then
                    at_rest = .false.
                    pass_tolerance = far_tolerance
                    call share_strips(strips_per_patch, patches)
                    cycle
                end if
                if (pass_tolerance <= tolerance .and. move < best_move) then
                    best_move = move
                    call hand_over(workspace, patches, n, strips)
                    call summarize(strips, penetration + workspace%curve%h_lowest, result)
                end if
                if (pass_tolerance <= tolerance .and. (at_rest .or. move < end_tolerance)) exit
                at_rest = move < end_tolerance
                if (move > loose_end_tolerance) then
                    pass_tolerance = far_tolerance
                else if (.not. at_rest) then
                    pass_tolerance = near_tolerance
                end if
                ! The last passes count, whatever they reach.
                if (at_rest .or. pass >= max_passes/2) pass_tolerance = tolerance
                coupled = move < coupling_move .and. couplings < max_couplings
            end if
            if (.not. coupled) cycle
            couplings = couplings + 1
            call settle_coupled(workspace, compliance, goal, tolerance, solved, trial, &
                                result%cost, coupled)
            if (.not. coupled) cycle
            patches = solved
            penetration = trial
            call remember(workspace, patches)
            call close_overlaps(workspace, compliance, penetration, splits < max_splits, &
                                patches, changed)
            if (changed) then
                at_rest = .false.
                pass_tolerance = far_tolerance
                call share_strips(strips_per_patch, patches)
                cycle
            end if
            best_move = 0.0_wp
            call hand_over(workspace, patches, n, strips)
            call summarize(strips, penetration + workspace%curve%h_lowest, result)
            exit
        end do
        settled = best_move <= loose_end_tolerance
    end subroutine settle

    subroutine check_input(workspace, compliance, options, strips, status)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(in) :: strips
        type(status_t), intent(out) :: status

        call check_compliance(compliance, status)
        if (is_error(status)) return
        if (options%strips_per_patch < 1 .and. options%strips_per_patch /= strips_auto) then
            call set_status(status, st_bad_argument, 'fewer than one strip per patch asked')
        else if (.not. (options%tolerance > 0.0_wp .and. options%tolerance <= 1.0e-2_wp)) then
            call set_status(status, st_bad_argument, 'the tolerance is outside (0, 0.01]: ' &
                            //number_text(options%tolerance))
        else if (workspace%curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set in the workspace')
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the strips')
        else if (min(workspace%max_strips, size(strips%p0)) &
                 < max(options%strips_per_patch, fewest_strips)) then
            call set_status(status, st_workspace_too_small, &
                            'more strips per patch asked than there is capacity for')
        else
            call check_curvature(workspace%curve, status)
        end if
    end subroutine check_input

    !> Hand a converged pass over as strips.
    pure subroutine hand_over(workspace, patches, n, strips)
        type(strip_workspace_t), intent(in) :: workspace
        type(patches_t), intent(in) :: patches
        integer, intent(in) :: n
        type(contact_strips_t), intent(inout) :: strips

        integer :: p, last

        strips%n = n
        strips%n_patches = patches%n
        strips%y_left(:n) = workspace%y_left(:n)
        strips%y_right(:n) = workspace%y_right(:n)
        strips%p0(:n) = workspace%p0(:n)
        strips%half_length(:n) = workspace%half_length(:n)
        last = 0
        do p = 1, patches%n
            strips%patch(last + 1:last + patches%at(p)%n_strips) = p
            last = last + patches%at(p)%n_strips
        end do
    end subroutine hand_over

    !> The figures of a solution.
    pure subroutine summarize(strips, penetration, result)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: penetration ! from h = 0, mm
        type(normal_result_t), intent(inout) :: result

        integer :: p, first, last

        result%load = strips_load(strips)
        result%penetration = penetration
        result%area = 0.0_wp
        result%pmax = 0.0_wp
        result%x_max = 0.0_wp
        result%strips_across = 0
        last = 0
        do p = 1, strips%n_patches
            first = last + 1
            last = last + count(strips%patch(:strips%n) == p)
            result%strips_across = max(result%strips_across, last - first + 1)
            associate (left => strips%y_left(first:last), right => strips%y_right(first:last), &
                       half_length => strips%half_length(first:last))
                result%area = result%area + 2.0_wp*curve_integral(left, right, half_length)
                result%pmax = max(result%pmax, curve_peak(left, right, strips%p0(first:last)))
                result%x_max = max(result%x_max, curve_peak(left, right, half_length))
            end associate
        end do
        result%y_min = strips%y_left(1)
        result%y_max = strips%y_right(strips%n)
        result%n_patches = strips%n_patches
    end subroutine summarize

end module faststrip_normal_strip
