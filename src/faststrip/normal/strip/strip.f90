!> Normal contact by strips along the rolling direction: NFASTSTRIP.
!>
!> The paper gives the influence of a strip and not the algorithm that finds the patch. Here the
!> strips of a patch always fill it: its two ends move until the squared strip length, extrapolated
!> by a quadratic through the last three strips, vanishes at them. Strips and ends are solved for
!> together (`faststrip_normal_strip_converge`), from the last solution or the shape of a Hertz
!> contact; where that does not succeed, from the patches of coarse cells, or of fine ones in turn
!> (`faststrip_normal_strip_levels`, `faststrip_normal_strip_level`). A scan outside the patches
!> finds gaps that the deformed surfaces have closed, which makes patches appear, grow or merge
!> (`faststrip_normal_strip_patches`, `faststrip_normal_strip_ends`). A gap whose ends do not
!> converge, within a bounded work, gets the answer of `faststrip_normal_cells_solve`.
!>
!> Of a gap and its mirror image one is solved and mirrored (in a history of warm starts the first
!> gap decides): what is decided on the way, rounding included, is the same on a left and on a right
!> wheel.
module faststrip_normal_strip
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, is_error, add_limitation, number_text, &
                                     count_text, add_words, message_length, st_bad_argument, &
                                     st_bad_load, st_not_finite, st_no_contact, st_fewer_strips, &
                                     st_overlap_left, st_more_strips, st_workspace_too_small, &
                                     st_no_convergence
    use faststrip_base_material, only: check_compliance
    use faststrip_normal_overlap, only: named_overlap, overlap_outside
    use faststrip_normal_limitations, only: check_curvature, check_depth, check_lowest, &
                                            name_limitations, name_steps
    use faststrip_normal_strips, only: contact_strips_t, mirror_strips
    use faststrip_normal_strip_level, only: solve_near
    use faststrip_normal_strip_levels, only: strip_options_t, strips_auto, strips_auto_most, &
                                             solve_by_levels
    use faststrip_normal_strip_patches, only: fewest_strips
    use faststrip_normal_strip_state, only: strip_workspace_t, reserve_strip_workspace, &
                                            set_strip_gap, mirror_old, forget_factors
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_geometry_gap_curve, only: copy_gap_curve, mirror_gap_curve
    use faststrip_geometry_gap_exchange, only: swap_gap_curves
    implicit none
    private

    public :: strip_options_t, strip_workspace_t
    public :: reserve_strip_workspace, set_strip_gap, strip_solve, strip_solve_penetration
    public :: strip_solve_demand
    public :: fewest_strips, strips_auto, strips_auto_most

    ! Tuned [1]: larger tolerances are refused. Origin: chosen.
    real(wp), parameter :: largest_tolerance = 1.0e-2_wp

contains

    !> Solve the normal problem of the gap in the workspace under a load.
    !>
    !> Errors: `st_bad_argument` (options), `st_not_finite`, `st_bad_load`, `st_bad_material`,
    !> `st_workspace_too_small` (no gap set, capacity for too few strips), `st_out_of_range` and
    !> `st_linear_algebra` (a contact beyond all proportion; fill values below the gap),
    !> `st_no_finite_patch` (a contact that is flat or hollow along x).
    !> Named limitations: `st_fallback_used`, the ends did not converge and
    !> cells gave the answer; `st_more_strips`, three strips were used
    !> where fewer were asked;
    !> `st_overlap_left`, in a rough gap the surfaces overlap beside the strips;
    !> `st_edge_of_data`, the contact runs to the end of the gap's points; `st_flat_along_x` and
    !> `st_conformal`: see `faststrip_normal_limitations`;
    !> `st_fewer_strips`, the solution has fewer strips than asked, because more did not converge.
    !> A neighbour of the last solution has no limitation of its own; `st_no_convergence`: there is
    !> none with its patches and strips.
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
                            'the load must be a finite number, got '//number_text(load))
        else if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load must be above 0, got '//trim(number_text(load))//' N')
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
            call set_status(status, st_not_finite, 'the penetration must be a finite number, got ' &
                            //number_text(penetration))
            return
        end if
        depth = penetration - workspace%curve%h_lowest
        if (depth <= 0.0_wp) then
            call set_status(status, st_no_contact, 'the bodies do not touch: penetration ' &
                            //trim(number_text(penetration))//' mm, lowest gap ' &
                            //trim(number_text(workspace%curve%h_lowest))//' mm')
            return
        end if
        call check_depth(depth, status)
        if (.not. is_error(status)) &
            call solve(workspace, compliance, demand_t(by_load=.false., penetration=depth), &
                       options, strips, result, status)
    end subroutine strip_solve_penetration

    subroutine solve(workspace, compliance, demand, options, strips, result, status)
        type(strip_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        character(len=message_length) :: words
        real(wp) :: penetration ! above the lowest height
        integer :: n_converged    ! strips per patch that converged, 0: the answer of cells
        logical :: all_converged, mirrored, found

        mirrored = workspace%curve%is_image
        if ((options%warm_start .or. options%stays) .and. workspace%old%n > 0) then
            ! A history goes on as it began: its mirror image does so the other way round. Where it
            ! began with a gap that has no sides this one decides.
            if (.not. workspace%old_is_even) mirrored = workspace%old_is_mirrored
            if (workspace%old_is_mirrored .neqv. mirrored) call mirror_old(workspace)
        else
            ! No bit of what follows depends on a history before.
            call forget_factors(workspace)
        end if
        workspace%old_is_mirrored = mirrored
        workspace%old_is_even = workspace%curve%is_even
        if (mirrored) then
            call take_image(workspace, status)
            if (is_error(status)) return
        end if
        if (options%stays) then
            call solve_near(workspace, compliance, demand, options%tolerance, strips, result, found)
            if (.not. found) call set_status(status, st_no_convergence, &
                                             'there is no neighbour of the last solution that ' // &
                                             'has its patches and strips')
        else
            call solve_by_levels(workspace, compliance, demand, options, strips, result, &
                                 n_converged, all_converged, status)
        end if
        if (mirrored) then
            call swap_gap_curves(workspace%curve, workspace%image)
            call mirror_strips(strips)
            if (.not. is_error(status)) call mirror_ends(result)
        end if
        if (is_error(status) .or. options%stays) return
        penetration = result%penetration - workspace%curve%h_lowest
        if (overlap_outside(workspace%curve, compliance, penetration/result%correction, strips) &
            > named_overlap) &
            call add_limitation(status, st_overlap_left, 'surfaces overlap outside the patches ' &
                                //'by more than 1 % of the penetration: a rough gap, or one ' &
                                //'that is cut off')
        call name_limitations(workspace%curve, strips, status)
        if (.not. is_error(status)) &
            call name_steps(workspace%curve, penetration, strips, status)
        call check_lowest(workspace%curve, penetration, status)
        if (is_error(status)) then
            workspace%old%n = 0
            result = normal_result_t()
            return
        end if
        if (n_converged == 0) return
        if (options%strips_per_patch /= strips_auto &
            .and. n_converged > options%strips_per_patch) then
            words = count_text(n_converged)
            call add_words(words, ' strips used where '//count_text(options%strips_per_patch))
            call add_words(words, ' were asked, which are too few')
            call add_limitation(status, st_more_strips, words)
        end if
        ! Of itself, auto asks for as many as are resolved.
        if (.not. (all_converged .or. options%strips_per_patch == strips_auto)) &
            call add_limitation(status, st_fewer_strips, &
                                'fewer strips than asked: more did not converge')
    end subroutine solve

    !> Put the image of the gap in its place, made once for all solutions of that gap.
    subroutine take_image(workspace, status)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap that is a mirror image
        type(status_t), intent(inout) :: status

        if (workspace%image_of /= workspace%curve%version) then
            workspace%image_of = 0
            call copy_gap_curve(workspace%curve, workspace%image, status)
            if (is_error(status)) return
            call mirror_gap_curve(workspace%image)
            workspace%image_of = workspace%curve%version
        end if
        call swap_gap_curves(workspace%curve, workspace%image)
    end subroutine take_image

    !> The ends of a result under y -> -y.
    pure subroutine mirror_ends(result)
        type(normal_result_t), intent(inout) :: result

        real(wp) :: y_min

        y_min = result%y_min
        result%y_min = -result%y_max
        result%y_max = -y_min
    end subroutine mirror_ends

    subroutine check_input(workspace, compliance, options, strips, status)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance
        type(strip_options_t), intent(in) :: options
        type(contact_strips_t), intent(in) :: strips
        type(status_t), intent(out) :: status

        call check_compliance(compliance, status)
        if (is_error(status)) return
        if (options%strips_per_patch < 1 .and. options%strips_per_patch /= strips_auto) then
            call set_status(status, st_bad_argument, 'strips per patch must be at least 1, ' &
                            // 'got ' // count_text(options%strips_per_patch))
        else if (.not. (options%tolerance > 0.0_wp &
                        .and. options%tolerance <= largest_tolerance)) then
            call set_status(status, st_bad_argument, 'the tolerance must be above 0 and at ' &
                            // 'most 0.01, got ' &
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
end module faststrip_normal_strip
