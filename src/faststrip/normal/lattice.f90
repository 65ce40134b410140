!> Normal contact by strips on a lattice: coarser at the ends of a patch than
!> `faststrip_normal_strip`, but with an answer for every gap.
!>
!> Ranges of y are divided into even cells, these along x into elements of constant pressure
!> whose pressures solve a convex problem (`faststrip_normal_lattice_elements`). There is one
!> solution, whatever the unit of length, the side from which one looks, or the rounding. It
!> does not take the pressure along x for semi-elliptic; only what is handed over is: each cell
!> that presses becomes a strip with its load and, as far as a semi-ellipse can, its second moment
!> and its pressure in the middle.
!>
!> The first lattice, a coarse one, lies where the undeformed gap is below the penetration, the
!> next ones over the patches of the one before, and over places where the deformed surfaces
!> overlap. Three to five lattices are laid and none has more cells than half as many again as
!> strips are asked for, and ten: the work is bounded. Gaps that need it take 30 ms in the mean and
!> 0.15 s at most.
!>
!> Measured errors, mean/max, against CONTACT (0.1 mm) in the 20 contacts of the paper's section 5
!> and against 25 Hertz ellipses of a/b = 0.004 to 100 (`faststrip-lab bench robust`):
!>
!>     n    20 contacts: penetration   pmax          Hertz: penetration   pmax
!>     5      0.69 / 1.7 %             7.1 / 28 %       0.38 / 0.93 %      1.3 / 2.6 %
!>     9      0.17 / 0.61 %            2.4 / 23 %       0.12 / 0.34 %      0.39 / 0.75 %
!>     15     0.02 / 0.09 %            0.4 / 2.4 %      0.06 / 0.15 %      0.17 / 0.31 %
!>     31     0.01 / 0.02 %            0.2 / 1.8 %      0.04 / 0.19 %      0.08 / 0.42 %
!>
!> The largest are of a small second patch about to meet the first. Loads are exact to rounding.
module faststrip_normal_lattice
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     add_words, st_bad_argument, st_bad_load, st_bad_material, &
                                     st_not_finite, st_no_contact, st_out_of_range, &
                                     st_edge_of_data, st_overlap_left, st_linear_algebra, &
                                     st_workspace_too_small
    use faststrip_base_material, only: check_compliance
    use faststrip_influence_row, only: center_influence_column
    use faststrip_normal_lattice_elements, only: elements_t, reserve_elements, place_elements, &
                                                 solve_elements, element_columns
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, level_intervals, mirror_gap_curve
    use faststrip_normal_limitations, only: check_curvature
    use faststrip_normal_lattice_estimate, only: lattice_errors_t, lattice_figures_t, &
                                                 lattice_figures, estimate_errors
    use faststrip_normal_strips, only: contact_strips_t, mirror_strips
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: lattice_workspace_t, reserve_lattice, lattice_solve, lattice_solve_penetration
    public :: lattice_errors, lattice_errors_t, forget_lattice_errors, most_lattice_strips

    !> More strips across the largest patch are not used, however many are asked for.
    integer, parameter :: most_lattice_strips = 101

    integer, parameter :: most_cells = 110       ! all patches together
    real(wp), parameter :: cells_per_strip = 1.5_wp ! all patches together, of the strips asked
    integer, parameter :: spare_cells = 10       ! and so many more
    integer, parameter :: coarse_cells = 15      ! at most across the widest range of the first
    integer, parameter :: range_cells = 3        ! across a range, or neighbours are joined
    integer, parameter :: fewest_cells = 9       ! across a patch, if there is capacity
    integer, parameter :: max_ranges = 64
    integer, parameter :: fewest_layings = 3, max_layings = 5
    integer, parameter :: block = 64             ! points evaluated together
    ! Added before a number of cells is cut to an integer: widths of ranges often are as small
    ! integers to each other, and a half would leave the number to the rounding.
    real(wp), parameter :: cells_rounding = 0.5369_wp
    real(wp), parameter :: first_growth = 1.0_wp, growth = 0.3_wp ! of a patch each way, cells
    real(wp), parameter :: reach_margin = 1.3_wp ! of a cell, over the length found last
    real(wp), parameter :: depth_margin = 1.05_wp ! the penetration may still rise by
    real(wp), parameter :: least_reach = 0.02_wp ! penetration, of all, that gives a cell's length
    real(wp), parameter :: overlap_tolerance = 1.0e-3_wp ! of the penetration
    real(wp), parameter :: named_overlap = 0.01_wp ! the same, told to the caller
    real(wp), parameter :: start_level = 0.55_wp     ! of the penetration: virtual penetration
    real(wp), parameter :: start_factor = 0.6_wp     ! of the plane-strain pressure
    real(wp), parameter :: same = 1.0e-6_wp          ! lengths that differ by less, relatively
    real(wp), parameter :: smallest_penetration = 1.0e-60_wp, largest_penetration = 1.0e60_wp

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: lattice_workspace_t
        private
        integer :: max_strips = 0
        type(lattice_errors_t) :: errors ! of the last solution
        type(elements_t) :: elements
        integer :: n = 0           ! cells
        integer :: n_old = 0       ! that pressed on the lattice before
        integer :: n_ranges = 0    ! ranges of y, each divided into even cells
        real(wp) :: y_from(max_ranges) = 0.0_wp, y_to(max_ranges) = 0.0_wp ! mm
        integer :: cells(max_ranges) = 0
        real(wp), allocatable :: y_left(:), y_right(:), y(:), height(:), inv2r(:), p0(:)
        real(wp), allocatable :: half_length(:), reach(:), old_y(:), old_half_length(:)
        logical, allocatable :: presses(:)
    end type lattice_workspace_t

contains

    !> Allocate; the only allocation, to be done before the first solution.
    subroutine reserve_lattice(workspace, max_strips, status)
        type(lattice_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips     !! strips of all patches together, >= 3
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        if (max_strips < 3) then
            call set_status(status, st_bad_argument, 'capacity for fewer than 3 strips asked')
            return
        end if
        if (workspace%max_strips >= min(max_strips, most_cells)) return
        if (allocated(workspace%p0)) deallocate ( &
            workspace%y_left, workspace%y_right, workspace%y, workspace%height, workspace%inv2r, &
            workspace%p0, workspace%half_length, workspace%reach, workspace%old_y, &
            workspace%old_half_length, workspace%presses)
        associate (m => min(max_strips, most_cells))
            allocate (workspace%y_left(m), workspace%y_right(m), workspace%y(m), &
                      workspace%height(m), workspace%inv2r(m), workspace%p0(m), &
                      workspace%half_length(m), workspace%reach(m), workspace%old_y(m), &
                      workspace%old_half_length(m), source=0.0_wp)
            allocate (workspace%presses(m), source=.false.)
        end associate
        call reserve_elements(workspace%elements, min(max_strips, most_cells))
        workspace%max_strips = min(max_strips, most_cells)
    end subroutine reserve_lattice

    !> Strips that carry a load.
    !>
    !> The strips carry the load to rounding, whether the ends of the patches settled or not.
    subroutine lattice_solve(workspace, curve, compliance, load, n_strips, strips, penetration, &
                             status)
        type(lattice_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_curve_t), intent(inout) :: curve   !! a gap that was set; unchanged after it
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
        logical :: mirrored

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
        mirrored = curve%is_image
        if (mirrored) call mirror_gap_curve(curve)
        call start_depth(curve, compliance, load, depth)
        call solve(workspace, curve, compliance, demand_t(load=load), n_strips, strips, depth, &
                   status)
        if (mirrored) call mirror_back(curve, strips)
        if (.not. is_error(status)) penetration = depth + curve%h_lowest
    end subroutine lattice_solve

    !> Strips at a given approach of the bodies; `strips_load` tells what they carry.
    subroutine lattice_solve_penetration(workspace, curve, compliance, penetration, n_strips, &
                                         strips, status)
        type(lattice_workspace_t), intent(inout) :: workspace !! reserved beforehand
        type(gap_curve_t), intent(inout) :: curve   !! a gap that was set; unchanged after it
        real(wp), intent(in) :: compliance          !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: penetration         !! approach D of the bodies, from h = 0, mm
        integer, intent(in) :: n_strips             !! across the largest patch, >= 3
        type(contact_strips_t), intent(inout) :: strips !! reserved; those that press
        type(status_t), intent(out) :: status       !! as `lattice_solve`; `st_no_contact`

        real(wp) :: depth
        logical :: mirrored

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
        mirrored = curve%is_image
        if (mirrored) call mirror_gap_curve(curve)
        call solve(workspace, curve, compliance, demand_t(.false., penetration=depth), n_strips, &
                   strips, depth, status)
        if (mirrored) call mirror_back(curve, strips)
    end subroutine lattice_solve_penetration

    !> The gap as it was, and the strips of its mirror image as its own.
    pure subroutine mirror_back(curve, strips)
        type(gap_curve_t), intent(inout) :: curve
        type(contact_strips_t), intent(inout) :: strips

        call mirror_gap_curve(curve)
        call mirror_strips(strips)
    end subroutine mirror_back

    !> Forget them: the next answer is not of a lattice.
    pure subroutine forget_lattice_errors(workspace)
        type(lattice_workspace_t), intent(inout) :: workspace !! as before otherwise

        workspace%errors = lattice_errors_t()
    end subroutine forget_lattice_errors

    !> Estimated relative errors of the last solution.
    pure type(lattice_errors_t) function lattice_errors(workspace) result(errors)
        type(lattice_workspace_t), intent(in) :: workspace !! after a solution

        errors = workspace%errors
    end function lattice_errors

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
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the strips')
        else if (min(workspace%max_strips, size(strips%p0)) &
                 < min(n_strips, most_lattice_strips)) then
            call set_status(status, st_workspace_too_small, &
                            'the patch needs more strips than there is capacity for')
        end if
    end subroutine check_input

    !> Penetration, above the lowest height, at which pressures of 0.6 of the plane-strain one
    !> where the gap is below 0.55 D carry the load.
    pure subroutine start_depth(curve, compliance, load, depth)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, load
        real(wp), intent(out) :: depth

        real(wp), parameter :: reach_of_search = 2.0_wp**200
        real(wp) :: low, high, unit
        integer :: i

        ! In a length of the case's own, with which the unit of length does not matter.
        unit = sqrt(compliance*load)
        low = unit/reach_of_search
        high = unit*reach_of_search
        do i = 1, 70
            depth = low*sqrt(high/low)
            if (start_load(curve, compliance, depth) < load) then
                low = depth
            else
                high = depth
            end if
            if (high - low <= 2.0_wp*epsilon(1.0_wp)*low) exit
        end do
    end subroutine start_depth

    !> That load; a gap straight between the ends of its monotone pieces lets it rise evenly, so
    !> that one penetration belongs to it.
    pure real(wp) function start_load(curve, compliance, depth) result(load)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth

        real(wp) :: level, low, high, width
        integer :: j

        level = start_level*depth
        load = 0.0_wp
        do j = 1, curve%n_pieces
            width = curve%y_node(j + 1) - curve%y_node(j)
            low = min(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            high = max(curve%h_node(j), curve%h_node(j + 1)) - curve%h_lowest
            if (level >= high) then
                load = load + width*(level - 0.5_wp*(low + high))
            else if (level > low) then
                load = load + width*((level - low)*(0.5_wp*((level - low)/(high - low))))
            end if
        end do
        load = start_factor*(load/compliance)
    end function start_load

    !> Lay lattices until nothing overlaps outside the patches.
    subroutine solve(workspace, curve, compliance, demand, n_strips, strips, depth, status)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand ! the penetration above the lowest height
        integer, intent(in) :: n_strips
        type(contact_strips_t), intent(inout) :: strips
        real(wp), intent(inout) :: depth ! penetration above the lowest height: first guess, result
        type(status_t), intent(out) :: status

        real(wp) :: overlap
        integer :: laying, capacity, wanted
        logical :: solved
        type(lattice_figures_t) :: before, last

        call clear_status(status)
        workspace%errors = lattice_errors_t()
        if (depth <= 2.0_wp*smallest_penetration &
            .or. depth >= 0.5_wp*largest_penetration) then
            call set_status(status, st_out_of_range, 'a contact beyond all proportion: ' // &
                            'penetration ' // trim(number_text(depth)) // ' mm')
            return
        end if
        wanted = min(n_strips, most_lattice_strips)
        capacity = min(workspace%max_strips, size(strips%p0), &
                   nint(cells_per_strip*wanted) + spare_cells)
        call first_ranges(workspace, curve, depth)
        workspace%n = 0
        do laying = 1, max_layings
            if (laying == 1) then
                call lay(workspace, curve, min(wanted, coarse_cells), capacity)
            else
                call lay(workspace, curve, min(wanted + 1, capacity), capacity)
            end if
            call set_reach(workspace, depth)
            associate (n => workspace%n, elements => workspace%elements)
                call place_elements(elements, workspace%y_left(:n), workspace%y_right(:n), &
                                    workspace%height(:n), workspace%inv2r(:n), &
                                    workspace%reach(:n))
                call solve_elements(elements, compliance, demand, depth, solved)
                if (.not. solved) exit
                call element_columns(elements, n, workspace%p0(:n), workspace%half_length(:n))
                workspace%presses(:n) = workspace%p0(:n) > 0.0_wp
            end associate
            call record(workspace, strips)
            before = last
            last = lattice_figures(strips, depth)
            call next_ranges(workspace, curve, compliance, depth, &
                             merge(first_growth, growth, laying == 1), overlap)
            if (laying >= fewest_layings .and. overlap < overlap_tolerance &
                .and. 2*count(workspace%presses(:workspace%n)) >= workspace%n) exit
        end do
        if (solved) then
            call find_waves(workspace, curve, compliance, depth, strips)
            workspace%errors = estimate_errors(before, last, strips, workspace%reach)
        end if
        if (.not. solved) then
            call set_status(status, st_linear_algebra, &
                            'the pressures of the lattice have no solution')
        else if (overlap > named_overlap) then
            call set_status(status, st_overlap_left, 'surfaces overlap outside the patches by ' &
                            // number_text(100.0_wp*overlap))
            call add_words(status%message, ' % of the penetration')
        else if (strips%y_left(1) <= curve%y(1) &
                 .or. strips%y_right(strips%n) >= curve%y(curve%n)) then
            call set_status(status, st_edge_of_data, &
                            'the contact runs to the end of the gap data')
        end if
    end subroutine solve

    !> The first ranges are where the gap is below the penetration; one range from the first to the
    !> last if there are too many.
    pure subroutine first_ranges(workspace, curve, depth)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: depth

        real(wp) :: level
        integer :: n, j

        level = curve%h_lowest + depth
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

    !> Divide the ranges into even cells, and keep the lengths of the lattice before.
    pure subroutine lay(workspace, curve, wanted, capacity)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        integer, intent(in) :: wanted, capacity ! cells across the widest range, and of all

        real(wp) :: widest, width, nearest, h
        integer :: r, k, i, n, fewest, share

        n = 0
        do k = 1, workspace%n
            if (.not. workspace%presses(k)) cycle
            n = n + 1
            workspace%old_y(n) = workspace%y(k)
            workspace%old_half_length(n) = workspace%half_length(k)
        end do
        workspace%n_old = n
        associate (from => workspace%y_from, to => workspace%y_to, cells => workspace%cells, &
                   m => workspace%n_ranges)
            do while (m > max(1, capacity/range_cells))
                ! All that are as near to each other, or the order would count.
                nearest = (1.0_wp + same)*minval(from(2:m) - to(:m - 1))
                n = 1
                do r = 2, m
                    if (from(r) - to(r - 1) > nearest) then
                        n = n + 1
                        from(n) = from(r)
                    end if
                    to(n) = to(r)
                end do
                m = n
            end do
            widest = maxval(to(:m) - from(:m))
            fewest = min(fewest_cells, wanted)
            do share = wanted, 1, -1
                fewest = min(fewest, share)
                do r = 1, m
                    cells(r) = max(fewest, int(share*((to(r) - from(r))/widest) + cells_rounding))
                end do
                if (sum(cells(:m)) <= capacity) exit
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
                end do
            end do
        end associate
        workspace%n = i
        do k = 1, i
            workspace%y(k) = 0.5_wp*(workspace%y_left(k) + workspace%y_right(k))
            call gap_at(curve, workspace%y(k), h, workspace%inv2r(k))
            workspace%height(k) = h - curve%h_lowest
        end do
    end subroutine lay

    !> How far the cells go along x, mm: to where the undeformed gap is the penetration, but not
    !> far beyond the lengths of the lattice before.
    pure subroutine set_reach(workspace, depth)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: depth

        real(wp) :: length, share
        integer :: k, i

        do k = 1, workspace%n
            workspace%reach(k) = sqrt(max(depth_margin*depth - workspace%height(k), &
                                          least_reach*depth)/workspace%inv2r(k))
            if (workspace%n_old == 0) cycle
            i = count(workspace%old_y(:workspace%n_old) <= workspace%y(k))
            if (i == 0 .or. i == workspace%n_old) then
                length = workspace%old_half_length(max(i, 1))
            else
                share = (workspace%y(k) - workspace%old_y(i)) &
                        /(workspace%old_y(i + 1) - workspace%old_y(i))
                length = (1.0_wp - share)*workspace%old_half_length(i) &
                         + share*workspace%old_half_length(i + 1)
            end if
            workspace%reach(k) = min(workspace%reach(k), reach_margin*length)
        end do
    end subroutine set_reach

    !> The ranges of the next lattice: the patches found, somewhat wider, and places where the
    !> surfaces overlap.
    subroutine next_ranges(workspace, curve, compliance, depth, grow, overlap)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        real(wp), intent(in) :: grow     ! each way, in cells
        real(wp), intent(out) :: overlap ! deepest outside the patches, of the penetration

        real(wp) :: from(2*max_ranges), to(2*max_ranges), finest
        integer :: first, last, k, m

        m = 0
        overlap = 0.0_wp
        last = 0
        do
            first = last + 1
            do while (first <= workspace%n)
                if (workspace%presses(first)) exit
                first = first + 1
            end do
            if (first > workspace%n .or. m == max_ranges) exit
            last = first
            do while (last < workspace%n)
                if (.not. workspace%presses(last + 1) &
                    .or. workspace%y_left(last + 1) > workspace%y_right(last)) exit
                last = last + 1
            end do
            m = m + 1
            from(m) = max(curve%y(1), workspace%y_left(first) &
                          - grow*(workspace%y_right(first) - workspace%y_left(first)))
            to(m) = min(curve%y(curve%n), workspace%y_right(last) &
                        + grow*(workspace%y_right(last) - workspace%y_left(last)))
        end do
        call add_overlaps(workspace, curve, compliance, depth, from, to, m, overlap)
        ! In the order of y, joined where they meet.
        do k = 2, m
            first = k
            do while (first > 1)
                if (from(first - 1) <= from(first)) exit
                call exchange(from(first - 1), from(first))
                call exchange(to(first - 1), to(first))
                first = first - 1
            end do
        end do
        finest = 1.0e-3_wp*maxval(to(:m) - from(:m))
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

    !> Add a range around the deepest overlap of each stretch outside the strips that press.
    subroutine add_overlaps(workspace, curve, compliance, depth, from, to, m, overlap)
        type(lattice_workspace_t), intent(in) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        real(wp), intent(inout) :: from(:), to(:)
        integer, intent(inout) :: m
        real(wp), intent(inout) :: overlap

        integer :: r, n_solved
        real(wp) :: low, high, widest, solved_from(2*max_ranges), solved_to(2*max_ranges)

        n_solved = m
        solved_from(:m) = from(:m)
        solved_to(:m) = to(:m)
        widest = maxval(to(:m) - from(:m))
        low = curve%y(1)
        do r = 1, n_solved + 1
            high = curve%y(curve%n)
            if (r <= n_solved) high = solved_from(r)
            if (high - low > same*widest .and. m < size(from)) &
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

    !> The pressures that would close the gap at the edges of the strips, MPa, into `reach`.
    subroutine find_waves(workspace, curve, compliance, depth, strips)
        type(lattice_workspace_t), intent(inout) :: workspace
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: compliance, depth
        type(contact_strips_t), intent(in) :: strips

        real(wp) :: overlap(3), left, right
        integer :: k

        do k = 1, strips%n
            left = strips%y_left(k)
            right = strips%y_right(k)
            call find_overlaps(workspace, curve, compliance, depth, &
                               [left, 0.5_wp*(left + right), right], overlap)
            workspace%reach(k) = abs(0.5_wp*(overlap(1) + overlap(3)) - overlap(2)) &
                                 /(2.0_wp*compliance*(right - left))
        end do
    end subroutine find_waves

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

    pure subroutine exchange(a, b)
        real(wp), intent(inout) :: a, b

        real(wp) :: kept

        kept = a
        a = b
        b = kept
    end subroutine exchange
end module faststrip_normal_lattice
