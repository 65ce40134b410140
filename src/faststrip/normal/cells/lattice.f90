!> Normal contact by strips on a lattice: coarser at the ends of a patch than
!> `faststrip_normal_strip`, but with an answer for every gap.
!>
!> Ranges of y are divided into even cells, these along x into elements of constant pressure
!> whose pressures solve a convex problem (`faststrip_normal_cells_elements`). There is one
!> solution, whatever the unit of length, the side from which one looks, or the rounding. It
!> does not take the pressure along x for semi-elliptic; only what is handed over is: each cell
!> that presses becomes a strip with its load and, as far as a semi-ellipse can, its second moment
!> and its pressure in the middle.
!>
!> The first lattice, a coarse one, lies where the undeformed gap is below the penetration, the
!> next ones over the patches of the one before, and over places where the deformed surfaces
!> overlap. There are three to five lattices and none has more cells than half as many again as
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
module faststrip_normal_cells_lattice
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, add_words, st_bad_argument, st_bad_load, &
                                     st_not_finite, st_no_contact, st_out_of_range, &
                                     st_edge_of_data, st_overlap_left, st_linear_algebra, &
                                     st_workspace_too_small
    use faststrip_base_material, only: check_compliance
    use faststrip_normal_cells_elements, only: elements_t, reserve_elements, position_elements, &
                                               solve_elements, element_columns
    use faststrip_geometry_gap_curve, only: gap_curve_t, mirror_gap_curve
    use faststrip_normal_cells, only: lattice_cells_t, reserve_cells, position_cells, set_reach, &
                                      record_strips
    use faststrip_normal_cells_overlap, only: find_waves, overlap_tolerance, named_overlap
    use faststrip_normal_cells_ranges, only: start_depth, first_ranges, next_ranges
    use faststrip_normal_limitations, only: check_curvature, check_depth
    use faststrip_normal_cells_estimate, only: lattice_errors_t, lattice_figures_t, &
                                               lattice_figures, estimate_errors
    use faststrip_normal_strips, only: contact_strips_t, mirror_strips
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: lattice_workspace_t, reserve_lattice, lattice_solve, lattice_solve_penetration
    public :: lattice_errors, lattice_errors_t, forget_lattice_errors, lend_elements

    !> More strips across the largest patch are not used, however many are asked for.
    !> Tuned [strips]. Origin: capacity.
    integer, parameter :: most_lattice_strips = 101

    ! Tuned [cells]: Most cells. Origin: cost: it rises with its cube.
    integer, parameter :: most_cells = 110       ! all patches together
    ! Tuned [cells]: Cells. Origin: chosen: patches are narrower than the ranges they lie in.
    real(wp), parameter :: cells_per_strip = 1.5_wp ! all patches together, of the strips asked
    ! Tuned [cells]. Origin: chosen, for small further patches.
    integer, parameter :: spare_cells = 10       ! and so many more
    ! Tuned [cells]. Origin: cost of the first solution.
    integer, parameter :: coarse_cells = 15      ! at most across the widest range of the first
    ! Tuned [lattices]: How often cells are positioned. Origin: two for the error, one to find the
    ! ranges.
    integer, parameter :: fewest_lattices = 3
    ! Tuned [lattices]: The same, most. Origin: safeguard.
    integer, parameter :: max_lattices = 5
    ! Tuned [cells]. Origin: chosen: within what the first solution leaves open.
    real(wp), parameter :: first_growth = 1.0_wp, growth = 0.3_wp ! of a patch each way, cells

    !> Everything a solution needs besides its input; owned by the caller, one per thread.
    type :: lattice_workspace_t
        private
        type(lattice_errors_t) :: errors ! of the last solution
        type(lattice_cells_t) :: cells
        type(elements_t), allocatable :: elements ! nothing of them is kept; see `lend_elements`
    end type lattice_workspace_t

contains

    !> Allocate; the only allocation, to be done before the first solution.
    subroutine reserve_lattice(workspace, max_strips, status)
        type(lattice_workspace_t), intent(inout) :: workspace !! sized
        integer, intent(in) :: max_strips     !! strips of all patches together, >= 3
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        if (max_strips < 3) then
            call set_status(status, st_bad_argument, 'capacity for strips must be at least ' &
                            // '3, got ' // count_text(max_strips))
            return
        end if
        call reserve_cells(workspace%cells, min(max_strips, most_cells))
        if (.not. allocated(workspace%elements)) allocate (workspace%elements)
        call reserve_elements(workspace%elements, min(max_strips, most_cells))
    end subroutine reserve_lattice

    !> Lend the elements, which are most of the memory, from one workspace to another that was
    !> reserved alike: for contacts that are solved one after the other.
    pure subroutine lend_elements(from, to)
        type(lattice_workspace_t), intent(inout) :: from !! cannot solve until they are back
        type(lattice_workspace_t), intent(inout) :: to   !! gets them, if there are any

        if (allocated(from%elements)) call move_alloc(from%elements, to%elements)
    end subroutine lend_elements

    !> Strips that carry a load.
    !>
    !> The strips carry the load to rounding, whether the ends of the patches converged or not.
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
                            'the load must be above 0, got ' // trim(number_text(load)) // ' N')
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
                            'load or penetration must be a finite number, got ' // &
                            number_text(target))
        else if (n_strips < 3) then
            call set_status(status, st_bad_argument, 'strips per patch must be at least 3, ' &
                            // 'got ' // count_text(n_strips))
        else if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
        else if (curve%least_inv2r <= 0.0_wp) then
            call check_curvature(curve, status)
        else if (.not. allocated(strips%p0)) then
            call set_status(status, st_workspace_too_small, &
                            'no workspace was reserved for the strips')
        else if (min(workspace%cells%capacity, size(strips%p0)) &
                 < min(n_strips, most_lattice_strips)) then
            call set_status(status, st_workspace_too_small, &
                            'the patch needs more strips than there is capacity for')
        end if
    end subroutine check_input

    !> Position lattices until nothing overlaps outside the patches.
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
        integer :: lattice, most, wanted
        logical :: solved
        type(lattice_figures_t) :: before, last

        workspace%errors = lattice_errors_t()
        call check_depth(depth, status)
        if (is_error(status)) return
        wanted = min(n_strips, most_lattice_strips)
        associate (cells => workspace%cells)
            most = min(cells%capacity, size(strips%p0), nint(cells_per_strip*wanted) + spare_cells)
            call first_ranges(cells, curve, depth)
            if (cells%n_ranges == 0) then
                ! So little beside the heights that no number lies between.
                call set_status(status, st_out_of_range, 'a contact beyond all proportion: ' // &
                                'penetration ' // trim(number_text(depth)) // ' mm')
                return
            end if
            cells%n = 0
            do lattice = 1, max_lattices
                if (lattice == 1) then
                    call position_cells(cells, curve, min(wanted, coarse_cells), most)
                else
                    call position_cells(cells, curve, min(wanted + 1, most), most)
                end if
                call solve_cells(workspace, compliance, demand, depth, solved)
                if (.not. solved) then
                    call set_status(status, st_linear_algebra, &
                                    'the pressures of the lattice have no solution')
                    return
                end if
                call record_strips(cells, strips)
                before = last
                last = lattice_figures(strips, depth)
                call next_ranges(cells, curve, compliance, depth, &
                                 merge(first_growth, growth, lattice == 1), overlap)
                if (lattice >= fewest_lattices .and. overlap < overlap_tolerance &
                    .and. 2*count(cells%presses(:cells%n)) >= cells%n) exit
            end do
            call find_waves(cells, curve, compliance, depth, strips)
            workspace%errors = estimate_errors(before, last, strips, cells%reach)
        end associate
        if (overlap > named_overlap) then
            call set_status(status, st_overlap_left, 'surfaces overlap outside the patches by ' &
                            // number_text(100.0_wp*overlap)) ! Given: per cent
            call add_words(status%message, ' % of the penetration')
        else if (strips%y_left(1) <= curve%y(1) &
                 .or. strips%y_right(strips%n) >= curve%y(curve%n)) then
            call set_status(status, st_edge_of_data, &
                            'the contact runs to the end of the gap data')
        end if
    end subroutine solve

    !> The pressures of the cells, and the penetration if the load is given.
    subroutine solve_cells(workspace, compliance, demand, depth, solved)
        type(lattice_workspace_t), intent(inout) :: workspace
        real(wp), intent(in) :: compliance
        type(demand_t), intent(in) :: demand
        real(wp), intent(inout) :: depth
        logical, intent(out) :: solved

        call set_reach(workspace%cells, depth)
        associate (cells => workspace%cells, n => workspace%cells%n)
            call position_elements(workspace%elements, cells%y_left(:n), cells%y_right(:n), &
                                   cells%height(:n), cells%inv2r(:n), cells%reach(:n))
            call solve_elements(workspace%elements, compliance, demand, depth, solved)
            if (.not. solved) return
            call element_columns(workspace%elements, n, cells%p0(:n), cells%half_length(:n))
            cells%presses(:n) = cells%p0(:n) > 0.0_wp
        end associate
    end subroutine solve_cells
end module faststrip_normal_cells_lattice
