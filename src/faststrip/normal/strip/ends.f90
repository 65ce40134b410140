!> Where the patches of a strip solution end: ends move to where the strips run out, and places
!> that the deformed surfaces have closed join in.
module faststrip_normal_strip_ends
    use faststrip_base_kinds, only: wp, pi
    use faststrip_geometry_gap_curve, only: gap_at
    use faststrip_normal_overlap, only: overlap_t, most_at_once, find_overlaps
    use faststrip_normal_strip_patches, only: patch_t, patches_t, max_patches, fewest_strips, &
                                              take_in, sort_patches, join_met_patches
    use faststrip_normal_strip_state, only: strip_workspace_t, flattest
    implicit none
    private

    public :: move_ends, close_overlaps, end_step, end_width

    !> How far an end may be extrapolated outwards.
    !> Tuned [strip widths]. Origin: safeguard: an end moves no farther in a pass.
    real(wp), parameter :: farthest_out = 2.0_wp

    ! Tuned [passes]. Origin: chosen against ends that swing.
    integer, parameter :: damped_pass = 12   ! from this pass on the ends move by damping only
    ! Tuned [1]: Part of a step that an end is moved from then on. Origin: chosen against ends that
    ! swing.
    real(wp), parameter :: damping = 0.6_wp

contains

    !> Move the ends of all patches to where the squared strip length vanishes.
    pure subroutine move_ends(workspace, pass, patches, move)
        type(strip_workspace_t), intent(in) :: workspace
        integer, intent(in) :: pass
        type(patches_t), intent(inout) :: patches
        real(wp), intent(out) :: move !! largest move, in units of `end_width`

        real(wp) :: factor, step, width, y_low, y_high
        integer :: p, first, last
        logical :: shares

        factor = 1.0_wp
        if (pass >= damped_pass) factor = damping
        y_low = workspace%curve%y(1)
        y_high = workspace%curve%y(workspace%curve%n)
        move = 0.0_wp
        last = 0
        shares = .false.
        do p = 1, patches%n
            first = last + 1
            last = last + patches%at(p)%n_strips
            associate (patch => patches%at(p))
                if (.not. shares) then
                    width = end_width(workspace, first)
                    step = factor*end_step(workspace, first, 1)*width
                    step = min(step, patch%y_from - y_low)
                    ! Half-way at most to a place that was too far out.
                    step = min(step, 0.5_wp*(patch%y_from - patch%too_far_from))
                    patch%y_from = patch%y_from - step
                    move = max(move, abs(step)/width)
                end if
                shares = patch%meets_next
                if (shares) then
                    call move_shared_end(workspace, factor, last, patch, patches%at(p + 1), move)
                    cycle
                end if
                width = end_width(workspace, last)
                step = factor*end_step(workspace, last, -1)*width
                step = min(step, y_high - patch%y_to)
                step = min(step, 0.5_wp*(patch%too_far_to - patch%y_to))
                patch%y_to = patch%y_to + step
                move = max(move, abs(step)/width)
            end associate
        end do
    end subroutine move_ends

    !> Move the end that two patches share to where both want to go on as far; or apart, where both
    !> together want to draw back.
    pure subroutine move_shared_end(workspace, factor, last, patch, next, move)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: factor        ! of the steps
        integer, intent(in) :: last           ! strip of the left patch
        type(patch_t), intent(inout) :: patch ! the left one
        type(patch_t), intent(inout) :: next  ! and that beside it
        real(wp), intent(inout) :: move       ! largest so far, in widths

        real(wp) :: to, from, width_to, width_from

        width_to = end_width(workspace, last)
        width_from = end_width(workspace, last + 1)
        to = factor*end_step(workspace, last, -1)*width_to
        from = factor*end_step(workspace, last + 1, 1)*width_from
        if (to + from >= 0.0_wp) then
            to = 0.5_wp*(to - from)
            from = -to
        end if
        patch%y_to = patch%y_to + to
        next%y_from = next%y_from - from
        if (to + from >= 0.0_wp) then
            next%y_from = patch%y_to
        else
            move = max(move, abs(to)/width_to, abs(from)/width_from)
        end if
    end subroutine move_shared_end

    !> The measure of an end's moves, mm: the width of the end strip.
    pure real(wp) function end_width(workspace, k) result(width)
        type(strip_workspace_t), intent(in) :: workspace
        integer, intent(in) :: k !! the end strip

        width = workspace%strips%y_right(k) - workspace%strips%y_left(k)
    end function end_width

    !> How far an end should move outwards, in units of `end_width`, at most by 2.
    pure real(wp) function end_step(workspace, k, inward) result(step)
        type(strip_workspace_t), intent(in) :: workspace
        integer, intent(in) :: k      !! the end strip
        integer, intent(in) :: inward !! 1 at a left end, -1 at a right end

        real(wp) :: y(3), q(3), width, d2, d3, slope, bend, b, discriminant, s
        integer :: j

        width = end_width(workspace, k)
        do j = 1, 3
            associate (i => k + (j - 1)*inward)
                y(j) = 0.5_wp*(workspace%strips%y_left(i) + workspace%strips%y_right(i))/width
                q(j) = (workspace%strips%half_length(i)/workspace%strips%half_length(k))**2 &
                       *(workspace%strips%inv2r(i)/workspace%strips%inv2r(k))
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
        step = min(farthest_out, s - 0.5_wp)
    end function end_step

    !> Find places outside the patches where the deformed surfaces would overlap, and patches that
    !> have met: add, extend or merge patches.
    pure subroutine close_overlaps(workspace, compliance, penetration, may_merge, patches, changed)
        type(strip_workspace_t), intent(in) :: workspace
        real(wp), intent(in) :: compliance, penetration
        logical, intent(in) :: may_merge
        type(patches_t), intent(inout) :: patches
        logical, intent(out) :: changed

        type(overlap_t) :: overlaps(most_at_once)
        type(patch_t) :: seed
        real(wp) :: from(max_patches), to(max_patches), h, inv2r, width
        integer :: i, n

        changed = .false.
        width = 0.0_wp
        do i = 1, patches%n
            from(i) = patches%at(i)%y_from
            to(i) = patches%at(i)%y_to
            width = max(width, (to(i) - from(i))/patches%at(i)%n_strips)
        end do
        n = sum(workspace%old%at(:workspace%old%n)%n_strips)
        associate (strips => workspace%strips)
            call find_overlaps(workspace%curve, compliance, penetration, strips%y_left(:n), &
                               strips%y_right(:n), strips%p0(:n), strips%half_length(:n), &
                               from(:patches%n), to(:patches%n), width, overlaps)
        end associate
        do i = 1, most_at_once
            associate (one => overlaps(i))
                if (one%deepest <= 0.0_wp) exit
                seed = patch_t(one%from, one%to, fewest_strips)
                call gap_at(workspace%curve, 0.5_wp*(seed%y_from + seed%y_to), h, inv2r)
                inv2r = max(inv2r, flattest)
                seed%seed_length = sqrt(one%deepest/inv2r)
                ! That of a wide strip.
                seed%seed_pressure = 2.0_wp*inv2r*seed%seed_length/(pi*compliance)
                call take_in(seed, one%low, one%high, one%step, patches, changed)
            end associate
        end do
        call sort_patches(patches)
        call join_met_patches(may_merge, patches, changed)
    end subroutine close_overlaps
end module faststrip_normal_strip_ends
