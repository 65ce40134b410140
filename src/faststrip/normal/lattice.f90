!> Normal contact by strips on a lattice with an active set: slower to settle and coarser at the
!> ends of a patch than `faststrip_normal_strip`, but with an answer for every gap.
!>
!> A patch is divided into even cells. For given strip lengths the pressures are the solution of
!> a linear complementarity problem on the centre lines: a strip either presses and its gap is
!> closed, or it carries nothing and its gap is open. It is solved by an active set that turns to
!> only dropping strips when it takes too long; the load makes sure that one is left. The lengths
!> of those that press move by Newton's method towards closing the gap at the exact tip,
!>
!>     A_k xd_k^2 = D - h_k - H sum_s p0_s I_ks(xd_k),
!>
!> and where that fails each by a step of its own that shrinks when it turns around. Whenever
!> this is stopped, the pressures are positive and carry the load. The lattice is then laid anew
!> over the patches found, whose ends the gap half a cell beyond brackets, and over places where
!> the deformed surfaces overlap between and beyond them.
!>
!> The work is bounded: 80 steps of the lengths on as many cells as strips are asked for, fewer on
!> more cells, which are at most half as many again and ten. With 31 strips that takes up to 20 ms,
!> mostly 3, on a core that does nothing else.
!>
!> Measured errors, mean/max, against CONTACT (0.1 mm) in the 20 contacts of the paper's section 5
!> and against 25 Hertz ellipses of a/b = 0.004 to 100 (`faststrip bench robust`):
!>
!>     n    20 contacts: penetration   pmax          Hertz: penetration   pmax
!>     5      0.57 / 1.3 %             9.2 / 34 %       0.81 / 1.3 %       0.40 / 1.0 %
!>     9      0.20 / 0.44 %            1.4 / 9.8 %      0.30 / 0.70 %      0.16 / 0.56 %
!>     15     0.09 / 0.19 %            0.4 / 3.0 %      0.12 / 0.28 %      0.07 / 0.24 %
!>     31     0.02 / 0.12 %            0.2 / 1.5 %      0.03 / 0.09 %      0.03 / 0.09 %
!>
!> The largest are of a small second patch about to meet the first. Loads are exact to rounding.
module faststrip_normal_lattice
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_kinds, only: wp, pi
    use faststrip_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                st_bad_argument, st_bad_load, st_bad_material, st_not_finite, &
                                st_no_contact, st_out_of_range, st_edge_of_data, st_overlap_left, &
                                st_linear_algebra, st_workspace_too_small
    use faststrip_material, only: check_compliance
    use faststrip_influence_row, only: center_influence_column, &
                                       center_influence_column_gradient, &
                                       influence_column_gradient
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_profile_gap_curve, only: gap_curve_t, gap_at, level_intervals
    use faststrip_normal_limitations, only: check_curvature
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    implicit none
    private

    public :: lattice_workspace_t, reserve_lattice, lattice_solve, lattice_solve_penetration
    public :: most_lattice_strips

    !> More strips across the largest patch are not used, however many are asked for.
    integer, parameter :: most_lattice_strips = 101

    integer, parameter :: most_cells = 162       ! all patches together
    real(wp), parameter :: cells_per_strip = 1.5_wp ! all patches together, of the strips asked
    integer, parameter :: spare_cells = 10       ! and so many more
    real(wp), parameter :: enough_cells = 0.7_wp ! that press, of the strips asked for
    integer, parameter :: range_cells = 3        ! across a range, or neighbours are joined
    integer, parameter :: fewest_cells = 9       ! across a patch, if there is room
    integer, parameter :: max_ranges = 64
    integer, parameter :: max_layings = 10
    integer, parameter :: max_length_steps = 40  ! of one lattice
    integer, parameter :: most_plain_steps = 80  ! of all lattices, on as many cells as strips
                                                 ! are asked for; fewer on more cells
    integer, parameter :: fewest_steps = 12      ! in any case
    integer, parameter :: max_block_rounds = 8   ! then strips are added one by one
    integer, parameter :: max_adding_rounds = 16 ! then they are only dropped
    integer, parameter :: max_failures = 2       ! of Newton's steps on one lattice
    integer, parameter :: block = 64             ! points evaluated together
    real(wp), parameter :: loose_tolerance = 1.0e-2_wp, tight_tolerance = 1.0e-5_wp ! of ln xd
    real(wp), parameter :: largest_length_step = 0.7_wp ! of ln xd
    real(wp), parameter :: shortest_ratio = 0.1_wp   ! of a strip to its longer neighbour
    real(wp), parameter :: end_tolerance = 0.02_wp   ! of a cell
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp ! of the penetration
    real(wp), parameter :: named_overlap = 0.01_wp ! the same, told to the caller
    real(wp), parameter :: start_level = 0.55_wp     ! of the penetration: virtual penetration
    real(wp), parameter :: start_factor = 0.6_wp     ! of the plane-strain pressure
    real(wp), parameter :: flattest = 1.0e-9_wp      ! smallest A = 1/(2R) used, 1/mm
    real(wp), parameter :: smallest_penetration = 1.0e-60_wp, largest_penetration = 1.0e60_wp

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: lattice_workspace_t
        private
        integer :: max_strips = 0
        integer :: n = 0           ! cells
        integer :: n_ranges = 0    ! ranges of y, each divided into even cells
        real(wp) :: y_from(max_ranges) = 0.0_wp, y_to(max_ranges) = 0.0_wp ! mm
        integer :: cells(max_ranges) = 0
        integer :: steps = 0       ! of the lengths, all lattices together
        real(wp) :: work = 0.0_wp  ! spent, and how much may be; see `step_work`
        real(wp) :: most_work = 0.0_wp
        real(wp), allocatable :: y_left(:), y_right(:), y(:), height(:), inv2r(:), p0(:)
        real(wp), allocatable :: half_length(:), factor(:), last_step(:), tip(:)
        real(wp), allocatable :: old_y(:), old_half_length(:)
        real(wp), allocatable :: at_x(:), at_y(:) ! tips of the strips that press
        ! Displacements on the centre lines and their derivatives in the sources' ln xd
        real(wp), allocatable :: influence(:, :), influence_slope(:, :)
        real(wp), allocatable :: matrix(:, :), column(:, :), tips(:, :) ! of a linear system
        integer, allocatable :: pivot(:), at(:)
        logical, allocatable :: presses(:)
    end type lattice_workspace_t

contains

    !> Make room; the only allocation, to be done before the first solution.
    subroutine reserve_lattice(workspace, max_strips, status)
        type(lattice_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips     !! strips of all patches together, >= 3
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        if (max_strips < 3) then
            call set_status(status, st_bad_argument, 'room for fewer than 3 strips asked')
            return
        end if
        if (workspace%max_strips >= min(max_strips, most_cells)) return
        if (allocated(workspace%p0)) deallocate ( &
            workspace%y_left, workspace%y_right, workspace%y, workspace%height, workspace%inv2r, &
            workspace%p0, workspace%half_length, workspace%factor, workspace%last_step, &
            workspace%tip, workspace%old_y, workspace%old_half_length, workspace%at_x, &
            workspace%at_y, workspace%influence, workspace%influence_slope, workspace%matrix, &
            workspace%column, workspace%tips, workspace%pivot, workspace%at, workspace%presses)
        associate (m => min(max_strips, most_cells))
            allocate (workspace%y_left(m), workspace%y_right(m), workspace%y(m), &
                      workspace%height(m), workspace%inv2r(m), workspace%p0(m), &
                      workspace%half_length(m), workspace%factor(m), workspace%last_step(m), &
                      workspace%tip(m), workspace%old_y(m), workspace%old_half_length(m), &
                      workspace%at_x(m), workspace%at_y(m), source=0.0_wp)
            allocate (workspace%influence(m, m), workspace%influence_slope(m, m), &
                      workspace%matrix(2*m + 1, 2*m + 1), workspace%column(2*m + 1, 2), &
                      workspace%tips(m, 3), source=0.0_wp)
            allocate (workspace%pivot(2*m + 1), workspace%at(m), source=0)
            allocate (workspace%presses(m), source=.false.)
        end associate
        workspace%max_strips = min(max_strips, most_cells)
    end subroutine reserve_lattice

    !> Strips that carry a load.
    !>
    !> The strips carry the load to rounding, whether the ends of the patches settled or not.
    subroutine lattice_solve(workspace, curve, compliance, load, n_strips, strips, penetration, &
                             status)
        type(lattice_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_curve_t), intent(in) :: curve      !! a gap that was set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load                !! normal force Q, N
        integer, intent(in) :: n_strips             !! across the largest patch, >= 3
        type(contact_strips_t), intent(inout) :: strips !! reserved; those that press
        real(wp), intent(out) :: penetration        !! approach D of the bodies, from h = 0, mm
        type(status_t), intent(out) :: status
            !! `st_not_finite`, `st_bad_load`, `st_bad_material`, `st_bad_argument` (n_strips),
            !! `st_workspace_too_small`, `st_out_of_range` (a contact beyond all proportion),
            !! `st_linear_algebra`, `st_no_finite_patch`; `st_edge_of_data`: the contact runs to
            !! the end of the points; `st_overlap_left`: surfaces overlap outside the patches by
            !! more than 1 % of the penetration

        real(wp) :: depth

        penetration = 0.0_wp
        strips%n = 0
        strips%n_patches = 0
        call check_input(workspace, curve, compliance, load, n_strips, strips, status)
        if (is_error(status)) return
        if (load <= 0.0_wp) then
            call set_status(status, st_bad_load, &
                            'the load is not positive: ' // trim(number_text(load)) // ' N')
            return
        end if
        call start_depth(curve, compliance, load, depth)
        call solve(workspace, curve, compliance, load, .true., n_strips, strips, depth, status)
        if (.not. is_error(status)) penetration = depth + curve%h_lowest
    end subroutine lattice_solve

    !> Strips at a given approach of the bodies; `strips_load` tells what they carry.
    subroutine lattice_solve_penetration(workspace, curve, compliance, penetration, n_strips, &
                                         strips, status)
        type(lattice_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_curve_t), intent(in) :: curve      !! a gap that was set
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration         !! approach D of the bodies, from h = 0, mm
        integer, intent(in) :: n_strips             !! across the largest patch, >= 3
        type(contact_strips_t), intent(inout) :: strips !! reserved; those that press
        type(status_t), intent(out) :: status       !! as `lattice_solve`; `st_no_contact`

        real(wp) :: depth

        strips%n = 0
        strips%n_patches = 0
        call check_input(workspace, curve, compliance, penetration, n_strips, strips, status)
        if (is_error(status)) return
        depth = penetration - curve%h_lowest
        if (depth <= 0.0_wp) then
            call set_status(status, st_no_contact, 'the bodies do not meet: penetration ' // &
                            trim(number_text(penetration)) // ' mm, lowest gap ' // &
                            trim(number_text(curve%h_lowest)) // ' mm')
            return
        end if
        call solve(workspace, curve, compliance, depth, .false., n_strips, strips, depth, status)
    end subroutine lattice_solve_penetration

    subroutine check_input(workspace, curve, compliance, target, n_strips, strips, status)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, target
        integer, intent(in) :: n_strips
        type(contact_strips_t), intent(in) :: strips
        type(status_t), intent(out) :: status

        call check_compliance(compliance, status)
        if (is_error(status)) return
        if (.not. ieee_is_finite(target)) then
            call set_status(status, st_not_finite, &
                            'load or penetration is not a finite number: ' // number_text(target))
        else if (n_strips < 3) then
            call set_status(status, st_bad_argument, 'fewer than 3 strips per patch asked')
        else if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        else if (curve%least_inv2r <= 0.0_wp) then
            call check_curvature(curve, status)
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, 'no room was reserved for the strips')
        else if (min(workspace%max_strips, size(strips%p0)) &
                 < min(n_strips, most_lattice_strips)) then
            call set_status(status, st_workspace_too_small, &
                            'the patch needs more strips than there is room for')
        end if
    end subroutine check_input

    !> Penetration, above the lowest height, at which pressures of 0.6 of the plane-strain one
    !> where the gap is below 0.55 D carry the load.
    pure subroutine start_depth(curve, compliance, load, depth)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, load
        real(wp), intent(out) :: depth

        real(wp) :: low, high
        integer :: i

        low = smallest_penetration
        high = largest_penetration
        do i = 1, 60
            depth = sqrt(low)*sqrt(high)
            if (start_load(curve, compliance, depth) < load) then
                low = depth
            else
                high = depth
            end if
            if (high < 1.2_wp*low) exit
        end do
    end subroutine start_depth

    pure real(wp) function start_load(curve, compliance, depth) result(load)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth

        integer, parameter :: n_points = 8
        real(wp) :: y_from(max_ranges), y_to(max_ranges), h, inv2r, level, width
        integer :: i, j, n

        level = curve%h_lowest + start_level*depth
        call level_intervals(curve, level, y_from, y_to, n)
        load = 0.0_wp
        do i = 1, n
            width = (y_to(i) - y_from(i))/n_points
            do j = 1, n_points
                call gap_at(curve, y_from(i) + (j - 0.5_wp)*width, h, inv2r)
                load = load + max(level - h, 0.0_wp)*width
            end do
        end do
        load = start_factor*(load/compliance)
    end function start_load

    !> Lay lattices until the ends of the patches settle; keep the best.
    subroutine solve(workspace, curve, compliance, target, by_load, n_strips, strips, depth, &
                     status)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        real(wp), intent(in) :: target  ! load, N, or penetration above the lowest height, mm
        logical, intent(in) :: by_load
        integer, intent(in) :: n_strips
        type(contact_strips_t), intent(inout) :: strips
        real(wp), intent(inout) :: depth ! penetration above the lowest height: first guess, result
        type(status_t), intent(out) :: status

        real(wp) :: move, overlap, worth, best_worth, best_depth, best_overlap, residual, tolerance
        integer :: laying, best_laying, room, wanted
        logical :: done

        call clear_status(status)
        if (depth <= 2.0_wp*smallest_penetration &
            .or. depth >= 0.5_wp*largest_penetration) then
            call set_status(status, st_out_of_range, 'a contact beyond all proportion: ' // &
                            'penetration ' // trim(number_text(depth)) // ' mm')
            return
        end if
        wanted = min(n_strips, most_lattice_strips)
        room = min(workspace%max_strips, size(strips%p0), &
                   nint(cells_per_strip*wanted) + spare_cells)
        call first_ranges(workspace, curve, depth)
        workspace%n = 0
        workspace%steps = 0
        workspace%work = 0.0_wp
        workspace%most_work = most_plain_steps*step_work(max(wanted, room/2), 2)
        best_worth = huge(1.0_wp)
        best_depth = depth
        best_overlap = 0.0_wp
        best_laying = 0
        tolerance = loose_tolerance
        do laying = 1, max_layings
            call lay(workspace, curve, wanted, room, depth)
            call settle_lengths(workspace, compliance, target, by_load, tolerance, depth, &
                                residual, done)
            if (.not. done) exit
            call next_ranges(workspace, curve, compliance, depth, move, overlap)
            worth = move + 10.0_wp*overlap + residual &
                    + max(0.0_wp, 1.0_wp - count(workspace%presses(:workspace%n)) &
                                           /(enough_cells*wanted)) &
                    + max(0.0_wp, 1.0_wp - smallest_patch(workspace) &
                                           /(enough_cells*min(fewest_cells, wanted)))
            if (worth < 0.9_wp*best_worth) then
                best_worth = worth
                best_depth = depth
                best_overlap = overlap
                best_laying = laying
                call record(workspace, strips)
            end if
            if (laying > best_laying + 3) exit
            if (move < end_tolerance .and. overlap < overlap_tolerance) then
                if (tolerance <= tight_tolerance) exit
                tolerance = tight_tolerance
            end if
            if (is_exhausted(workspace)) exit
        end do
        depth = best_depth
        if (strips%n == 0) then
            call set_status(status, st_linear_algebra, &
                            'the influence numbers of the lattice are singular')
        else if (best_overlap > named_overlap) then
            call set_status(status, st_overlap_left, 'surfaces overlap outside the patches by ' &
                            // trim(number_text(100.0_wp*best_overlap)) // ' % of the penetration')
        else if (strips%y_left(1) <= curve%y(1) &
                 .or. strips%y_right(strips%n) >= curve%y(curve%n)) then
            call set_status(status, st_edge_of_data, &
                            'the contact runs to the end of the gap data')
        end if
    end subroutine solve

    !> The first ranges are where the gap is below 0.55 D; one range from the first to the last
    !> if there are too many.
    pure subroutine first_ranges(workspace, curve, depth)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: depth

        real(wp) :: level
        integer :: n, j

        level = curve%h_lowest + start_level*depth
        call level_intervals(curve, level, workspace%y_from, workspace%y_to, n)
        if (n == max_ranges) then
            do j = curve%n_pieces + 1, 2, -1
                if (curve%h_node(j) < level) exit
            end do
            n = 1
            workspace%y_to(1) = curve%y_node(min(j + 1, curve%n_pieces + 1))
        end if
        workspace%n_ranges = n
    end subroutine first_ranges

    !> Divide the ranges into even cells, with lengths from the last lattice.
    pure subroutine lay(workspace, curve, wanted, room, depth)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: wanted, room
        real(wp), intent(in) :: depth

        real(wp) :: widest, width, h, a, y
        integer :: r, k, i, n_old, fewest, share, near

        n_old = 0
        do k = 1, workspace%n
            if (.not. workspace%presses(k)) cycle
            n_old = n_old + 1
            workspace%old_y(n_old) = 0.5_wp*(workspace%y_left(k) + workspace%y_right(k))
            workspace%old_half_length(n_old) = workspace%half_length(k)
        end do
        associate (from => workspace%y_from, to => workspace%y_to, cells => workspace%cells, &
                   m => workspace%n_ranges)
            do while (m > max(1, room/range_cells))
                r = minloc(from(2:m) - to(:m - 1), dim=1)
                to(r:m - 1) = to(r + 1:m)
                from(r + 1:m - 1) = from(r + 2:m)
                m = m - 1
            end do
            widest = maxval(to(:m) - from(:m))
            fewest = min(fewest_cells, wanted)
            do share = wanted, 1, -1
                fewest = min(fewest, share)
                do r = 1, m
                    cells(r) = max(fewest, nint(share*((to(r) - from(r))/widest)))
                end do
                if (sum(cells(:m)) <= room) exit
            end do
            i = 0
            do r = 1, m
                width = (to(r) - from(r))/cells(r)
                do k = 1, cells(r)
                    i = i + 1
                    workspace%y_left(i) = from(r) + (k - 1)*width
                    workspace%y_right(i) = from(r) + k*width
                    if (k == cells(r)) workspace%y_right(i) = to(r)
                    if (k > 1) workspace%y_right(i - 1) = workspace%y_left(i)
                    y = 0.5_wp*(workspace%y_left(i) + workspace%y_right(i))
                    call gap_at(curve, y, h, a)
                    workspace%y(i) = y
                    workspace%height(i) = h - curve%h_lowest
                    workspace%inv2r(i) = max(a, flattest)
                    if (n_old > 0) then
                        near = minloc(abs(workspace%old_y(:n_old) - y), dim=1)
                        workspace%half_length(i) = workspace%old_half_length(near)
                    else
                        h = max(start_level*depth - workspace%height(i), 0.01_wp*depth)
                        workspace%half_length(i) = sqrt(h/workspace%inv2r(i))
                    end if
                end do
            end do
        end associate
        workspace%n = i
        workspace%presses(:i) = .true.
    end subroutine lay

    !> Alternate between pressures for given lengths and steps of the lengths: those of Newton's
    !> method, and each strip's own after Newton has failed.
    subroutine settle_lengths(workspace, compliance, target, by_load, tolerance, depth, &
                              residual, done)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance, target
        logical, intent(in) :: by_load
        real(wp), intent(in) :: tolerance
        real(wp), intent(inout) :: depth
        real(wp), intent(out) :: residual ! last change of a length, relative
        logical, intent(out) :: done

        real(wp) :: before
        integer :: i, k, m, n, rounds, failures
        logical :: found

        n = workspace%n
        workspace%factor(:n) = 1.0_wp
        workspace%last_step(:n) = 0.0_wp
        residual = huge(1.0_wp)
        failures = 0
        do i = 1, max_length_steps
            call fill_centre_lines(workspace, compliance)
            call find_pressures(workspace, target, by_load, depth, rounds, done)
            if (.not. done) return
            m = 0
            do k = 1, n
                if (.not. workspace%presses(k)) cycle
                m = m + 1
                workspace%at(m) = k
                workspace%at_x(m) = workspace%half_length(k)
                workspace%at_y(m) = workspace%y(k)
            end do
            call fill_newton(workspace, compliance, by_load, depth, m)
            before = residual
            call own_steps(workspace, depth, m, residual)
            workspace%steps = workspace%steps + 1
            workspace%work = workspace%work + step_work(m, rounds)
            if (residual < tolerance .or. i == max_length_steps) exit
            if (is_exhausted(workspace)) exit
            if (residual > 0.9_wp*before) failures = failures + 1
            if (residual < 0.5_wp*before) failures = 0
            found = .false.
            if (failures < max_failures) call newton_steps(workspace, m, found)
            do k = 1, m
                associate (half_length => workspace%half_length(workspace%at(k)))
                    if (found) then
                        half_length = half_length*exp(workspace%tip(k))
                    else
                        half_length = half_length*exp(max(-largest_length_step, &
                            min(largest_length_step, workspace%factor(workspace%at(k)) &
                                                     *workspace%last_step(workspace%at(k)))))
                    end if
                end associate
            end do
            do k = 1, n
                workspace%half_length(k) = max(workspace%half_length(k), &
                                               shortest_length(workspace, k))
            end do
        end do
    end subroutine settle_lengths

    !> What a step of the lengths costs, in operations of linear algebra; an influence number off
    !> the centre line takes the time of about 400.
    pure real(wp) function step_work(m, rounds) result(work)
        integer, intent(in) :: m      ! strips that press
        integer, intent(in) :: rounds ! systems solved for the pressures

        work = 400.0_wp*real(m, wp)**2 + (16.0_wp + 2.0_wp*rounds)/3.0_wp*real(m, wp)**3
    end function step_work

    !> Is it time to take the lattice as it is?
    pure logical function is_exhausted(workspace)
        type(lattice_workspace_t), intent(in) :: workspace

        is_exhausted = workspace%steps >= fewest_steps .and. workspace%work > workspace%most_work
    end function is_exhausted

    !> Displacements on all centre lines by a unit of pressure on each strip.
    subroutine fill_centre_lines(workspace, compliance)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance

        integer :: n, s

        n = workspace%n
        do s = 1, n
            call center_influence_column_gradient( &
                workspace%half_length(s), workspace%y_left(s), workspace%y_right(s), &
                workspace%y(:n), workspace%influence(:n, s), workspace%influence_slope(:n, s))
            workspace%influence(:n, s) = compliance*workspace%influence(:n, s)
            workspace%influence_slope(:n, s) = compliance*workspace%half_length(s) &
                                               *workspace%influence_slope(:n, s)
        end do
    end subroutine fill_centre_lines

    !> Gaps at the tips of the strips that press, and the system of Newton's method: unknowns are
    !> the changes of p0 over the largest, of ln xd, and of the penetration over itself.
    subroutine fill_newton(workspace, compliance, by_load, depth, m)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance, depth
        logical, intent(in) :: by_load
        integer, intent(in) :: m ! strips that press, `at(:m)`

        real(wp) :: p_scale, p, force, largest
        integer :: i, j, k, s

        p_scale = maxval(workspace%p0(:workspace%n))
        do i = 1, m
            k = workspace%at(i)
            workspace%tip(i) = 1.0_wp - workspace%height(k)/depth
        end do
        associate (a => workspace%matrix, tips => workspace%tips)
            a(:2*m + 1, 2*m + 1) = -1.0_wp
            a(2*m + 1, :) = 0.0_wp
            do i = 1, m
                k = workspace%at(i)
                a(m + 1:2*m, m + i) = 0.0_wp
            end do
            do j = 1, m
                s = workspace%at(j)
                p = workspace%p0(s)
                call influence_column_gradient( &
                    workspace%half_length(s), workspace%y_left(s), workspace%y_right(s), &
                    workspace%at_x(:m), workspace%at_y(:m), tips(:m, 1), tips(:m, 2), tips(:m, 3))
                do i = 1, m
                    k = workspace%at(i)
                    a(i, j) = workspace%influence(k, s)*(p_scale/depth)
                    a(i, m + j) = workspace%influence_slope(k, s)*(p/depth)
                    a(m + i, j) = compliance*(p_scale/depth)*tips(i, 1)
                    a(m + i, m + j) = a(m + i, m + j) &
                        + compliance*(p/depth)*workspace%half_length(s)*tips(i, 3)
                    workspace%tip(i) = workspace%tip(i) - compliance*(p/depth)*tips(i, 1)
                end do
                do i = 1, m
                    k = workspace%at(i)
                    a(m + i, m + i) = a(m + i, m + i) &
                        + compliance*(p/depth)*workspace%half_length(k)*tips(i, 2)
                end do
            end do
            do i = 1, m
                k = workspace%at(i)
                a(m + i, m + i) = a(m + i, m + i) &
                    + 2.0_wp*workspace%inv2r(k)*(workspace%half_length(k)**2/depth)
            end do
            if (.not. by_load) then
                a(2*m + 1, 2*m + 1) = 1.0_wp
                return
            end if
            a(2*m + 1, 2*m + 1) = 0.0_wp
            largest = maxval(workspace%half_length(workspace%at(:m)) &
                             *(workspace%y_right(workspace%at(:m)) &
                               - workspace%y_left(workspace%at(:m))))
            do j = 1, m
                s = workspace%at(j)
                force = workspace%half_length(s) &
                        *((workspace%y_right(s) - workspace%y_left(s))/largest)
                a(2*m + 1, j) = force
                a(2*m + 1, m + j) = force*(workspace%p0(s)/p_scale)
            end do
        end associate
    end subroutine fill_newton

    !> The steps in ln xd that would close the gap at each tip if all else stayed, with factors
    !> that shrink where a step turns around.
    subroutine own_steps(workspace, depth, m, residual)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: depth
        integer, intent(in) :: m
        real(wp), intent(out) :: residual ! largest step

        real(wp) :: step, rise
        integer :: i, k

        residual = 0.0_wp
        do i = 1, m
            k = workspace%at(i)
            rise = workspace%inv2r(k)*(workspace%half_length(k)**2/depth)
            step = 0.5_wp*log(max(workspace%tip(i)/rise, 0.2_wp))
            workspace%tip(i) = workspace%tip(i) - rise
            if (step < 0.0_wp .and. workspace%half_length(k) &
                <= 1.001_wp*shortest_length(workspace, k)) then
                ! It stays as short as may be.
                workspace%last_step(k) = 0.0_wp
                workspace%tip(i) = 0.0_wp
                workspace%matrix(m + i, :2*m + 1) = 0.0_wp
                workspace%matrix(m + i, m + i) = 1.0_wp
                cycle
            end if
            residual = max(residual, abs(step))
            if (step*workspace%last_step(k) < 0.0_wp) then
                workspace%factor(k) = max(0.5_wp*workspace%factor(k), 0.05_wp)
            else
                workspace%factor(k) = min(1.2_wp*workspace%factor(k), 2.0_wp)
            end if
            workspace%last_step(k) = step
        end do
    end subroutine own_steps

    !> Newton's steps in ln xd, in the place of the gaps at the tips.
    subroutine newton_steps(workspace, m, found)
        type(lattice_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: m
        logical, intent(out) :: found

        real(wp) :: largest
        logical :: singular

        found = .false.
        workspace%column(:m, 1) = 0.0_wp
        workspace%column(m + 1:2*m, 1) = workspace%tip(:m)
        workspace%column(2*m + 1, 1) = 0.0_wp
        call lu_factor(2*m + 1, workspace%matrix, workspace%pivot, singular)
        if (singular) return
        call lu_solve(2*m + 1, workspace%matrix, workspace%pivot, workspace%column(:, 1))
        largest = maxval(abs(workspace%column(m + 1:2*m, 1)))
        if (.not. largest < huge(1.0_wp)) return
        workspace%tip(:m) = workspace%column(m + 1:2*m, 1) &
                            *min(1.0_wp, largest_length_step/max(largest, tiny(1.0_wp)))
        found = .true.
    end subroutine newton_steps

    !> Least length of a strip: one far shorter than a neighbour would find no way back.
    pure real(wp) function shortest_length(workspace, k) result(shortest)
        type(lattice_workspace_t), intent(in) :: workspace
        integer, intent(in) :: k

        shortest = 0.0_wp
        if (k > 1) then
            if (workspace%presses(k - 1)) shortest = workspace%half_length(k - 1) &
                                                     *sqrt(workspace%inv2r(k - 1))
        end if
        if (k < workspace%n) then
            if (workspace%presses(k + 1)) shortest = max(shortest, workspace%half_length(k + 1) &
                                                                   *sqrt(workspace%inv2r(k + 1)))
        end if
        shortest = shortest_ratio*shortest/sqrt(workspace%inv2r(k))
    end function shortest_length

    !> Pressures for given lengths: closed gap where a strip presses, open gap where not.
    subroutine find_pressures(workspace, target, by_load, depth, rounds, done)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: target
        logical, intent(in) :: by_load
        real(wp), intent(inout) :: depth
        integer, intent(out) :: rounds ! systems solved
        logical, intent(out) :: done

        real(wp) :: force, load_per_depth, load_of_heights, overlap, deepest
        integer :: n, m, i, j, k, add
        logical :: changed, singular

        n = workspace%n
        done = .false.
        do rounds = 1, max_adding_rounds + n + 1
            m = 0
            do k = 1, n
                if (.not. workspace%presses(k)) cycle
                m = m + 1
                workspace%at(m) = k
            end do
            do j = 1, m
                do i = 1, m
                    workspace%matrix(i, j) = workspace%influence(workspace%at(i), workspace%at(j))
                end do
                workspace%column(j, 1) = 1.0_wp
                workspace%column(j, 2) = workspace%height(workspace%at(j))/depth
            end do
            call lu_factor(m, workspace%matrix, workspace%pivot, singular)
            if (singular) return
            call lu_solve(m, workspace%matrix, workspace%pivot, workspace%column(:, 1))
            call lu_solve(m, workspace%matrix, workspace%pivot, workspace%column(:, 2))
            load_per_depth = 0.0_wp
            load_of_heights = 0.0_wp
            do i = 1, m
                k = workspace%at(i)
                force = strip_load(1.0_wp, workspace%half_length(k), &
                                   workspace%y_right(k) - workspace%y_left(k))
                load_per_depth = load_per_depth + force*workspace%column(i, 1)
                load_of_heights = load_of_heights + force*workspace%column(i, 2)*depth
            end do
            workspace%column(:m, 2) = workspace%column(:m, 2)*depth
            if (by_load) then
                if (load_per_depth <= 0.0_wp) return
                depth = (target + load_of_heights)/load_per_depth
            else
                depth = target
            end if
            workspace%p0(:n) = 0.0_wp
            do i = 1, m
                workspace%p0(workspace%at(i)) = depth*workspace%column(i, 1) &
                                                - workspace%column(i, 2)
            end do
            changed = .false.
            if (m > 1) then
                do i = 1, m
                    k = workspace%at(i)
                    if (workspace%p0(k) > 0.0_wp) cycle
                    workspace%presses(k) = .false.
                    changed = .true.
                end do
            else if (workspace%p0(workspace%at(1)) <= 0.0_wp) then
                return
            end if
            if (changed) then
                if (.not. any(workspace%presses(:n))) return
                cycle
            end if
            if (rounds > max_adding_rounds) exit
            ! Strips that carry nothing have to press where they overlap: all of them at first,
            ! later only the one that overlaps most.
            add = 0
            deepest = 1.0e-9_wp*depth
            do k = 1, n
                if (workspace%presses(k)) cycle
                overlap = depth - workspace%height(k) &
                          - dot_product(workspace%influence(k, :n), workspace%p0(:n))
                if (overlap <= deepest) cycle
                add = k
                if (rounds > max_block_rounds) then
                    deepest = overlap
                else
                    workspace%presses(k) = .true.
                end if
            end do
            if (add == 0) exit
            workspace%presses(add) = .true.
        end do
        done = all(workspace%p0(:n) > 0.0_wp .eqv. workspace%presses(:n))
    end subroutine find_pressures

    !> Strips across the patch that has the fewest.
    pure integer function smallest_patch(workspace) result(fewest)
        type(lattice_workspace_t), intent(in) :: workspace

        integer :: k, n

        fewest = workspace%n
        n = 0
        do k = 1, workspace%n
            if (.not. workspace%presses(k)) cycle
            n = n + 1
            if (k < workspace%n) then
                if (workspace%presses(k + 1) &
                    .and. workspace%y_left(k + 1) <= workspace%y_right(k)) cycle
            end if
            fewest = min(fewest, n)
            n = 0
        end do
    end function smallest_patch

    !> The ranges of the next lattice: the patches found, with their ends carried on, and places
    !> where the surfaces overlap.
    subroutine next_ranges(workspace, curve, compliance, depth, move, overlap)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        real(wp), intent(out) :: move    ! largest move of an end, in cells
        real(wp), intent(out) :: overlap ! deepest outside the patches, of the penetration

        real(wp) :: from(2*max_ranges), to(2*max_ranges), finest, widest
        integer :: first, last, k, m

        m = 0
        move = 0.0_wp
        overlap = 0.0_wp
        last = 0
        do
            first = last + 1
            do while (first <= workspace%n)
                if (workspace%presses(first)) exit
                first = first + 1
            end do
            if (first > workspace%n) exit
            last = first
            do while (last < workspace%n)
                if (.not. workspace%presses(last + 1) &
                    .or. workspace%y_left(last + 1) > workspace%y_right(last)) exit
                last = last + 1
            end do
            if (m == max_ranges) exit
            m = m + 1
            call carry_on(workspace, curve, compliance, depth, first, last, 1, from(m), move, &
                          overlap)
            call carry_on(workspace, curve, compliance, depth, last, first, -1, to(m), move, &
                          overlap)
        end do
        call add_overlaps(workspace, curve, compliance, depth, from, to, m, overlap)
        ! In the order of y, joined where they meet.
        do k = 2, m
            first = k
            do while (first > 1)
                if (from(first - 1) <= from(first)) exit
                from(first - 1:first) = from([first, first - 1])
                to(first - 1:first) = to([first, first - 1])
                first = first - 1
            end do
        end do
        widest = maxval(to(:m) - from(:m))
        finest = 1.0e-3_wp*widest
        workspace%n_ranges = 0
        do k = 1, m
            last = workspace%n_ranges
            if (last > 0) then
                if (from(k) - workspace%y_to(last) < finest .or. last == max_ranges) then
                    workspace%y_to(last) = max(workspace%y_to(last), to(k))
                    cycle
                end if
            end if
            workspace%n_ranges = last + 1
            workspace%y_from(last + 1) = from(k)
            workspace%y_to(last + 1) = to(k)
        end do
    end subroutine next_ranges

    !> Where the squared length, carried on from the strips at an end of a patch, vanishes.
    !>
    !> Half a cell beyond the last strip the gap tells more than the curve through the lengths:
    !> where it is open the end lies before, where the surfaces overlap it lies beyond.
    subroutine carry_on(workspace, curve, compliance, depth, outer, inner, inward, y_end, move, &
                        overlap)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        integer, intent(in) :: outer, inner ! the strips at this end and at the other
        integer, intent(in) :: inward       ! 1 at a left end, -1 at a right one
        real(wp), intent(out) :: y_end
        real(wp), intent(inout) :: move, overlap

        real(wp) :: width, middle, q2, q3, bend, slope, discriminant, s, reach, y(1), beyond(1)
        integer :: n

        n = abs(inner - outer) + 1
        width = workspace%y_right(outer) - workspace%y_left(outer)
        s = 0.5_wp
        if (n >= 2) then
            ! q = 1 + slope s + bend s^2, s in cells outwards from the middle of the outer strip
            q2 = (workspace%half_length(outer + inward)/workspace%half_length(outer))**2
            slope = 1.0_wp - q2
            bend = 0.0_wp
            if (n >= 3) then
                q3 = (workspace%half_length(outer + 2*inward)/workspace%half_length(outer))**2
                bend = 0.5_wp*(1.0_wp - 2.0_wp*q2 + q3)
                slope = slope + bend
            end if
            discriminant = slope**2 - 4.0_wp*bend
            s = 2.0_wp
            if (discriminant >= 0.0_wp .and. slope < 0.0_wp) then
                s = 2.0_wp/(sqrt(discriminant) - slope)
            else if (bend < 0.0_wp) then
                s = 2.0_wp/(sqrt(discriminant) - slope)
            end if
            s = max(0.0_wp, min(2.0_wp, s))
        end if
        middle = workspace%y(outer)
        y = max(curve%y(1), min(curve%y(curve%n), middle - inward*width))
        call find_overlaps(workspace, curve, compliance, depth, y, beyond)
        if (abs(y(1) - middle) > 0.75_wp*width) then
            overlap = max(overlap, beyond(1)/depth)
            if (beyond(1) <= 0.0_wp) then
                s = min(s, 1.0_wp)
            else
                reach = 1.0_wp
                do while (beyond(1) > overlap_tolerance*depth .and. reach < 100.0_wp)
                    s = max(s, reach)
                    reach = 1.5_wp*reach
                    y = max(curve%y(1), min(curve%y(curve%n), middle - inward*reach*width))
                    call find_overlaps(workspace, curve, compliance, depth, y, beyond)
                    overlap = max(overlap, beyond(1)/depth)
                end do
            end if
        end if
        s = min(s, 0.5_wp + farthest_out(workspace, outer, inward)/width)
        y_end = middle - inward*s*width
        y_end = max(curve%y(1), min(curve%y(curve%n), y_end))
        if (inward > 0) then
            move = max(move, abs(y_end - workspace%y_left(outer))/width)
        else
            move = max(move, abs(y_end - workspace%y_right(outer))/width)
        end if
        if (n < 3) move = max(move, 1.0_wp) ! such a patch needs a finer lattice
    end subroutine carry_on

    !> How far an end may move out, mm: not half-way to the next patch as long as more than a cell
    !> lies between them, so that patches about to meet stay apart.
    pure real(wp) function farthest_out(workspace, outer, inward) result(farthest)
        type(lattice_workspace_t), intent(in) :: workspace
        integer, intent(in) :: outer, inward ! as in `carry_on`

        real(wp), parameter :: share = 0.45_wp
        real(wp) :: between
        integer :: k

        farthest = 1.0e100_wp
        k = outer
        do
            k = k - inward
            if (k < 1 .or. k > workspace%n) return
            if (workspace%presses(k)) exit
        end do
        between = abs(workspace%y(k) - workspace%y(outer)) - 0.5_wp*( &
                  workspace%y_right(k) - workspace%y_left(k) &
                  + workspace%y_right(outer) - workspace%y_left(outer))
        if (between > workspace%y_right(outer) - workspace%y_left(outer)) farthest = share*between
    end function farthest_out

    !> Add a range around the deepest overlap of each stretch outside the strips that press.
    subroutine add_overlaps(workspace, curve, compliance, depth, from, to, m, overlap)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        real(wp), intent(inout) :: from(:), to(:)
        integer, intent(inout) :: m
        real(wp), intent(inout) :: overlap

        integer :: r, n_solved
        real(wp) :: low, high, solved_from(size(from)), solved_to(size(to))

        n_solved = m
        solved_from(:m) = from(:m)
        solved_to(:m) = to(:m)
        low = curve%y(1)
        do r = 1, n_solved + 1
            high = curve%y(curve%n)
            if (r <= n_solved) high = solved_from(r)
            if (high > low .and. m < size(from)) &
                call add_overlap(workspace, curve, compliance, depth, low, high, from, to, m, &
                                 overlap)
            if (r <= n_solved) low = max(low, solved_to(r))
        end do
    end subroutine add_overlaps

    subroutine add_overlap(workspace, curve, compliance, depth, low, high, from, to, m, &
                                overlap)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, low, high
        real(wp), intent(inout) :: from(:), to(:)
        integer, intent(inout) :: m
        real(wp), intent(inout) :: overlap

        integer, parameter :: n_places = 32
        real(wp) :: place(block), here(block), deepest, y_deepest, y_low, y_high
        integer :: j, n, first, last, middle

        deepest = overlap_tolerance*depth
        y_deepest = low
        ! Valleys of the curve in the stretch, and even places
        first = 1
        last = curve%n_pieces + 1
        do while (last - first > 1)
            middle = (first + last)/2
            if (curve%y_node(middle) <= low) then
                first = middle
            else
                last = middle
            end if
        end do
        n = 0
        do j = first + 1, curve%n_pieces
            if (curve%y_node(j) >= high) exit
            if (curve%h_node(j) - curve%h_lowest >= depth - deepest) cycle
            if (curve%h_node(j) > min(curve%h_node(j - 1), curve%h_node(j + 1))) cycle
            n = n + 1
            place(n) = curve%y_node(j)
            if (n == block) call look(place, n)
        end do
        do j = 1, n_places
            n = n + 1
            place(n) = low + (high - low)*(j - 0.5_wp)/n_places
            if (n == block) call look(place, n)
        end do
        call look(place, n)
        if (y_deepest <= low) return
        overlap = max(overlap, deepest/depth)
        y_low = edge_of_overlap(-1.0_wp)
        y_high = edge_of_overlap(1.0_wp)
        ! Patches on both sides close it by themselves, or meet.
        if (y_low <= low .and. y_high >= high .and. low > curve%y(1) &
            .and. high < curve%y(curve%n)) return
        m = m + 1
        from(m) = y_low
        to(m) = y_high

    contains

        !> Take the places that were gathered.
        subroutine look(places, number)
            real(wp), intent(in) :: places(:)
            integer, intent(inout) :: number

            integer :: deep

            if (number == 0) return
            call find_overlaps(workspace, curve, compliance, depth, places(:number), &
                               here(:number))
            deep = maxloc(here(:number), dim=1)
            if (here(deep) > deepest) then
                deepest = here(deep)
                y_deepest = places(deep)
            end if
            number = 0
        end subroutine look

        !> Where the overlap ends, found within a factor of two.
        real(wp) function edge_of_overlap(direction) result(y_edge)
            real(wp), intent(in) :: direction

            real(wp) :: reach
            integer :: i

            reach = max(high - y_deepest, y_deepest - low)
            do i = 1, 20
                place(1) = min(max(y_deepest + direction*reach, low), high)
                call find_overlaps(workspace, curve, compliance, depth, place(:1), here(:1))
                if (here(1) > 0.0_wp) exit
                reach = 0.5_wp*reach
            end do
            y_edge = place(1)
        end function edge_of_overlap
    end subroutine add_overlap

    !> By how much the deformed surfaces overlap, mm; less than zero: the gap.
    pure subroutine find_overlaps(workspace, curve, compliance, depth, y, overlap)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth, y(:)
        real(wp), intent(out) :: overlap(:)

        real(wp) :: h, inv2r, influence(block)
        integer :: i, s

        do i = 1, size(y)
            call gap_at(curve, y(i), h, inv2r)
            overlap(i) = depth - (h - curve%h_lowest)
        end do
        do s = 1, workspace%n
            if (.not. workspace%presses(s)) cycle
            call center_influence_column(workspace%half_length(s), workspace%y_left(s), &
                                         workspace%y_right(s), y, influence(:size(y)))
            overlap = overlap - compliance*workspace%p0(s)*influence(:size(y))
        end do
    end subroutine find_overlaps

    !> Hand over the strips that press.
    pure subroutine record(workspace, strips)
        type(lattice_workspace_t), intent(in) :: workspace
        type(contact_strips_t), intent(inout) :: strips

        integer :: k, n

        n = 0
        strips%n_patches = 0
        do k = 1, workspace%n
            if (.not. workspace%presses(k)) cycle
            n = n + 1
            strips%y_left(n) = workspace%y_left(k)
            strips%y_right(n) = workspace%y_right(k)
            strips%half_length(n) = workspace%half_length(k)
            strips%p0(n) = workspace%p0(k)
            if (n == 1) then
                strips%n_patches = 1
            else if (strips%y_left(n) > strips%y_right(n - 1)) then
                strips%n_patches = strips%n_patches + 1
            end if
            strips%patch(n) = strips%n_patches
        end do
        strips%n = n
    end subroutine record
end module faststrip_normal_lattice
