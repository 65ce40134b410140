!> What a strip solution works on: the gap, the strips of the pass, and what the last pass left.
module faststrip_normal_strip_state
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: smallest_size
    use faststrip_base_status, only: status_t, set_status, is_error, count_text, st_bad_argument
    use faststrip_numerics_reversal, only: reverse, reverse_negated
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, gap_at
    use faststrip_normal_cells, only: cells_t, reserve_cells
    use faststrip_normal_strip_linearised, only: linearised_t, reserve_linearised
    use faststrip_normal_strip_grading, only: grade, grade_plainly
    use faststrip_normal_strip_patches, only: patches_t, max_patches, fewest_strips, only_match, &
                                              nearest_patch, mirror_patches, pass_strips_t, &
                                              reserve_pass_strips
    implicit none
    private

    public :: strip_workspace_t, reserve_strip_workspace, set_strip_gap
    public :: position_edges, position_strips, remember, mirror_old, flattest
    public :: newton_workspace_t, most_past
    public :: forget_edges, forget_factors, look_for_edges, renew_edges

    !> Smallest A = 1/(2R) used, 1/mm: a cylinder along x has no finite patch.
    real(wp), parameter :: flattest = smallest_size
    ! Tuned [half-widths]: place in an old patch from which a strip beside it is started. Origin:
    ! chosen: pressures vanish at 1.
    real(wp), parameter :: outermost = 0.95_wp

    ! Tuned [steps]: most that correct a step by old factors. Origin: capacity: three to six do.
    integer, parameter :: most_past = 8

    !> The linear system of 2n + 1 equations and those of the ends.
    type :: newton_workspace_t
        ! Whether `jacobian` holds factors that may serve again, and what kind of system they are
        ! of.
        logical :: kept = .false.
        logical :: by_load = .true., fixed(2*max_patches) = .false.
        integer :: n_patches = 0, n_strips(max_patches) = 0
        real(wp), allocatable :: jacobian(:, :)
        real(wp), allocatable :: step(:)
        real(wp), allocatable :: other(:, :) !! (2) other vectors
        real(wp), allocatable :: past(:, :)  !! (most_past) steps by the same factors
        integer, allocatable :: pivot(:)
    end type newton_workspace_t

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: strip_workspace_t
        type(gap_curve_t) :: curve
        type(gap_curve_t) :: image  !! its mirror image, if the gap counts as one
        integer :: image_of = 0     !! the curve's version that this is the image of; 0: of none
        type(newton_workspace_t) :: newton
        type(linearised_t) :: linear  !! influence coefficients of the last warm solution
        type(cells_t) :: cells      !! nothing of them is kept
        type(patches_t) :: old      !! the last patches that were solved
        real(wp) :: old_load = 0.0_wp        !! the load they carried, N
        real(wp) :: old_penetration = 0.0_wp !! and their corrected penetration above the lowest
                                             !! height, mm
        real(wp) :: old_correction = 1.0_wp  !! of it
        logical :: old_is_mirrored = .false. !! was their gap solved as its mirror image?
        logical :: old_is_even = .false.     !! was it its own?
        integer :: max_strips = 0   !! capacity, all patches together
        type(pass_strips_t) :: strips !! of the pass, all patches together
        real(wp), allocatable :: old_eta(:), old_p0(:), old_half_length(:) ! over the ellipse factor
        logical :: graded = .true.           !! do edges follow the gap, or the ends alone?
        integer :: n_graded(max_patches) = 0 !! strips of patches whose `edge` is known
        real(wp), allocatable :: edge(:)     !! right edges of strips in half-widths of their patch
        real(wp), allocatable :: new_edge(:) !! those of the patches where they are
        real(wp), allocatable :: middle(:)   !! of strips before, the same unit
        real(wp) :: old_inv2r = 1.0_wp !! the unit of A in `old_half_length`, 1/mm: one of the
                                       !! strips', so that the unit of length does not matter
    end type strip_workspace_t

contains

    !> Allocate; the only allocation, to be done before the first solution.
    subroutine reserve_strip_workspace(workspace, max_strips, max_points, status)
        type(strip_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips     !! strips of all patches together, >= 3
        integer, intent(in) :: max_points     !! points of a gap, >= 5
        type(status_t), intent(out) :: status !! `st_bad_argument`

        if (max_strips < fewest_strips) then
            call set_status(status, st_bad_argument, 'capacity for strips must be at least ' &
                            // '3, got ' // count_text(max_strips))
            return
        end if
        call reserve_gap_curve(workspace%curve, max_points, status)
        if (is_error(status)) return
        call reserve_gap_curve(workspace%image, max_points, status)
        if (is_error(status)) return
        call reserve_cells(workspace%cells)
        call reserve_newton(workspace%newton, max_strips)
        call reserve_linearised(workspace%linear, max_strips)
        if (workspace%max_strips >= max_strips) return
        call reserve_pass_strips(workspace%strips, max_strips)
        if (allocated(workspace%old_p0)) &
            deallocate (workspace%old_eta, workspace%old_p0, workspace%old_half_length, &
                        workspace%edge, workspace%new_edge, workspace%middle)
        allocate (workspace%old_eta(max_strips), workspace%old_p0(max_strips), &
                  workspace%old_half_length(max_strips), workspace%edge(max_strips), &
                  workspace%new_edge(max_strips), workspace%middle(max_strips), source=0.0_wp)
        workspace%n_graded = 0
        workspace%max_strips = max_strips
    end subroutine reserve_strip_workspace

    !> Allocate for systems of up to `max_strips` strips. Where there is room, what is kept stays.
    subroutine reserve_newton(workspace, max_strips)
        type(newton_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips                    !! >= 1

        integer :: n

        n = 2*max_strips + 1 + 2*max_patches
        if (allocated(workspace%pivot)) then
            if (size(workspace%pivot) >= n) return
            workspace%kept = .false.
            deallocate (workspace%jacobian, workspace%step, workspace%other, &
                        workspace%past, workspace%pivot)
        end if
        allocate (workspace%jacobian(n, n), workspace%step(n), workspace%other(n, 2), &
                  workspace%past(n, most_past), source=0.0_wp)
        allocate (workspace%pivot(n), source=0)
    end subroutine reserve_newton

    !> Hand over the gap that the next solutions are for.
    subroutine set_strip_gap(workspace, gap, status)
        type(strip_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_t), intent(in) :: gap        !! undeformed gap, mm
        type(status_t), intent(out) :: status !! those of `check_gap`, `st_workspace_too_small`

        call set_gap_curve(workspace%curve, gap, status)
    end subroutine set_strip_gap

    !> Cut the patches into strips and start them from the previous pass.
    !>
    !> Their edges are those of `faststrip_normal_strip_grading`, or those that are known.
    pure subroutine position_strips(workspace, patches, n)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(in) :: patches
        integer, intent(out) :: n ! number of strips; if they are too many, none is positioned

        real(wp) :: middle, half, y, eta, ratio
        integer :: p, k, i, q

        n = sum(patches%at(:patches%n)%n_strips)
        if (n > workspace%max_strips) return
        workspace%strips%n = n
        call position_edges(workspace, patches)
        associate (strips => workspace%strips)
            i = 0
            do p = 1, patches%n
                middle = 0.5_wp*(patches%at(p)%y_from + patches%at(p)%y_to)
                half = 0.5_wp*(patches%at(p)%y_to - patches%at(p)%y_from)
                q = only_match(workspace%old, patches, p)
                do k = 1, patches%at(p)%n_strips
                    i = i + 1
                    y = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
                    eta = (y - middle)/half
                    if (patches%at(p)%seed_length > 0.0_wp) then
                        ratio = sqrt(1.0_wp - eta**2)
                        if (strips%height(i) < patches%at(p)%seed_level) &
                            ratio = sqrt(1.0_wp - strips%height(i)/patches%at(p)%seed_level)
                        strips%half_length(i) = patches%at(p)%seed_length*ratio
                        strips%p0(i) = patches%at(p)%seed_pressure*ratio
                    else if (q > 0) then
                        call start_from_old(workspace, q, eta, eta, i)
                    else
                        q = nearest_patch(workspace%old, y)
                        ratio = (2.0_wp*y - workspace%old%at(q)%y_from - workspace%old%at(q)%y_to) &
                                /(workspace%old%at(q)%y_to - workspace%old%at(q)%y_from)
                        ratio = max(-outermost, min(outermost, ratio))
                        call start_from_old(workspace, q, ratio, eta, i)
                        q = 0
                    end if
                end do
            end do
        end associate
    end subroutine position_strips

    !> Cut the patches into strips: their edges, and the gap on their centre lines.
    pure subroutine position_edges(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace !! with capacity enough
        type(patches_t), intent(in) :: patches

        real(wp) :: middle, half, h, a
        integer :: p, k, i, near

        call grade_edges(workspace, patches)
        near = 0
        associate (strips => workspace%strips)
            i = 0
            do p = 1, patches%n
                middle = 0.5_wp*(patches%at(p)%y_from + patches%at(p)%y_to)
                half = 0.5_wp*(patches%at(p)%y_to - patches%at(p)%y_from)
                do k = 1, patches%at(p)%n_strips
                    i = i + 1
                    if (k == 1) then
                        strips%y_left(i) = patches%at(p)%y_from
                    else
                        strips%y_left(i) = strips%y_right(i - 1)
                    end if
                    strips%y_right(i) = middle + half*workspace%edge(i)
                    if (k == patches%at(p)%n_strips) strips%y_right(i) = patches%at(p)%y_to
                    call gap_at(workspace%curve, 0.5_wp*(strips%y_left(i) + strips%y_right(i)), &
                                h, a, near)
                    strips%height(i) = h - workspace%curve%h_lowest
                    strips%inv2r(i) = max(a, flattest)
                end do
            end do
        end associate
    end subroutine position_edges

    !> Right edges of strips in half-widths of their patch, unless those of as many are known.
    pure subroutine grade_edges(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(in) :: patches

        integer :: p, n, last
        logical :: known

        known = .true.
        last = 0
        do p = 1, patches%n
            n = patches%at(p)%n_strips
            known = known .and. workspace%n_graded(p) == n
            if (.not. known) then
                workspace%n_graded(p:) = 0
                workspace%n_graded(p) = n
                if (workspace%graded) then
                    call grade(workspace%curve, patches%at(p)%y_from, patches%at(p)%y_to, n, &
                               workspace%edge(last + 1:last + n))
                else
                    call grade_plainly(n, workspace%edge(last + 1:last + n))
                end if
            end if
            last = last + n
        end do
        workspace%n_graded(patches%n + 1:) = 0
    end subroutine grade_edges

    !> Forget where edges are: the next strips are cut anew.
    pure subroutine forget_edges(workspace, graded)
        type(strip_workspace_t), intent(inout) :: workspace
        logical, intent(in) :: graded !! do they follow the gap, or the ends alone?

        workspace%graded = graded
        workspace%n_graded = 0
    end subroutine forget_edges

    !> Forget coefficients and factors: the next strips have none of the last ones.
    pure subroutine forget_factors(workspace)
        type(strip_workspace_t), intent(inout) :: workspace !! as before otherwise

        workspace%linear%known = .false.
        workspace%newton%kept = .false.
    end subroutine forget_factors

    !> Where the edges of patches belong that have moved, and how far that is from where they are.
    pure subroutine look_for_edges(workspace, patches, change)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips in these patches
        type(patches_t), intent(in) :: patches
        real(wp), intent(out) :: change !! largest of an edge, in widths of the strip

        integer :: p, n, k, last
        real(wp) :: before

        change = 0.0_wp
        last = 0
        do p = 1, patches%n
            n = patches%at(p)%n_strips
            associate (edge => workspace%edge(last + 1:last + n), &
                       new_edge => workspace%new_edge(last + 1:last + n))
                call grade(workspace%curve, patches%at(p)%y_from, patches%at(p)%y_to, n, new_edge)
                before = -1.0_wp
                do k = 1, n - 1
                    change = max(change, abs(new_edge(k) - edge(k))/(edge(k) - before))
                    before = edge(k)
                end do
            end associate
            last = last + n
        end do
    end subroutine look_for_edges

    !> Cut patches into strips where `look_for_edges` found that they belong; pressures and lengths
    !> are taken over.
    pure subroutine renew_edges(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips in these patches
        type(patches_t), intent(in) :: patches

        real(wp) :: before, eta, ellipse, inv2r
        integer :: p, k, first, last

        associate (strips => workspace%strips, edge => workspace%edge, middle => workspace%middle, &
                   new_edge => workspace%new_edge, pressure => workspace%newton%other(:, 1), &
                   length => workspace%newton%other(:, 2))
            ! The unit of the others, so that roots are of ratios.
            inv2r = strips%inv2r(1)
            last = 0
            do p = 1, patches%n
                before = -1.0_wp
                do k = last + 1, last + patches%at(p)%n_strips
                    middle(k) = 0.5_wp*(before + edge(k))
                    ellipse = sqrt(1.0_wp - middle(k)**2)
                    pressure(k) = strips%p0(k)/ellipse
                    length(k) = strips%half_length(k)*sqrt(strips%inv2r(k)/inv2r)/ellipse
                    before = edge(k)
                end do
                last = last + patches%at(p)%n_strips
            end do
            edge(:last) = new_edge(:last)
            call position_edges(workspace, patches)
            last = 0
            do p = 1, patches%n
                first = last + 1
                last = last + patches%at(p)%n_strips
                before = -1.0_wp
                do k = first, last
                    eta = 0.5_wp*(before + edge(k))
                    ellipse = sqrt(1.0_wp - eta**2)
                    strips%p0(k) = ellipse*extrapolated(middle, pressure, first, last, eta)
                    strips%half_length(k) = ellipse*extrapolated(middle, length, first, last, eta) &
                                            /sqrt(strips%inv2r(k)/inv2r)
                    before = edge(k)
                end do
            end do
        end associate
    end subroutine renew_edges

    !> Keep a solution as the start of the next pass: pressures and lengths over the ellipse
    !> factor sqrt(1 - eta^2), which makes them smooth up to the ends.
    pure subroutine remember(workspace, patches)
        type(strip_workspace_t), intent(inout) :: workspace
        type(patches_t), intent(inout) :: patches

        real(wp) :: middle, half, ellipse
        integer :: p, k, i

        associate (strips => workspace%strips)
            i = 0
            workspace%old_inv2r = strips%inv2r(1)
            do p = 1, patches%n
                middle = 0.5_wp*(patches%at(p)%y_from + patches%at(p)%y_to)
                half = 0.5_wp*(patches%at(p)%y_to - patches%at(p)%y_from)
                do k = 1, patches%at(p)%n_strips
                    i = i + 1
                    workspace%old_eta(i) = (0.5_wp*(strips%y_left(i) + strips%y_right(i)) &
                                            - middle)/half
                    ellipse = sqrt(1.0_wp - workspace%old_eta(i)**2)
                    workspace%old_p0(i) = strips%p0(i)/ellipse
                    workspace%old_half_length(i) = strips%half_length(i)/ellipse &
                                                   *sqrt(strips%inv2r(i)/workspace%old_inv2r)
                end do
            end do
            patches%at%seed_length = 0.0_wp
            workspace%old = patches
        end associate
    end subroutine remember

    !> Mirror the solution that was kept, y to -y: the next gap is solved the other way round.
    pure subroutine mirror_old(workspace)
        type(strip_workspace_t), intent(inout) :: workspace

        integer :: n

        n = sum(workspace%old%at(:workspace%old%n)%n_strips)
        call reverse_negated(workspace%old_eta(:n))
        call reverse(workspace%old_p0(:n))
        call reverse(workspace%old_half_length(:n))
        call mirror_patches(workspace%old)
        call forget_factors(workspace)
        call forget_edges(workspace, .true.)
    end subroutine mirror_old

    !> Start strip i, at `eta` of its patch, from old patch q at `eta_old`.
    pure subroutine start_from_old(workspace, q, eta_old, eta, i)
        type(strip_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: q, i
        real(wp), intent(in) :: eta_old, eta

        integer :: first, last
        real(wp) :: ellipse

        first = 1 + sum(workspace%old%at(:q - 1)%n_strips)
        last = first + workspace%old%at(q)%n_strips - 1
        ellipse = sqrt(1.0_wp - eta**2)
        associate (strips => workspace%strips, old_eta => workspace%old_eta)
            strips%p0(i) = ellipse*extrapolated(old_eta, workspace%old_p0, first, last, eta_old)
            strips%half_length(i) = ellipse*extrapolated(old_eta, workspace%old_half_length, &
                                                         first, last, eta_old) &
                                    /sqrt(strips%inv2r(i)/workspace%old_inv2r)
        end associate
    end subroutine start_from_old

    !> Values of the strips of a patch, at some place of it: by the strip with the one nearest the
    !> place in the middle.
    pure real(wp) function extrapolated(eta, values, first, last, at)
        real(wp), intent(in) :: eta(:), values(:) ! middles of strips, rising, and values there
        integer, intent(in) :: first, last        ! strips of the patch
        real(wp), intent(in) :: at                ! place

        integer :: k

        do k = first, last - 3
            if (eta(k + 1) + eta(k + 2) >= 2.0_wp*at) exit
        end do
        extrapolated = between(eta(k:k + 2), values(k:k + 2), at)
    end function extrapolated

    !> The parabola through three points, not beyond them by more than they differ.
    pure real(wp) function between(x, y, at)
        real(wp), intent(in) :: x(3), y(3), at

        real(wp) :: slope, bend, low, high

        slope = (y(2) - y(1))/(x(2) - x(1))
        bend = ((y(3) - y(2))/(x(3) - x(2)) - slope)/(x(3) - x(1))
        low = minval(y)
        high = maxval(y)
        between = y(1) + (at - x(1))*(slope + (at - x(2))*bend)
        between = max(low*low/high, min(high*high/low, between))
    end function between
end module faststrip_normal_strip_state
