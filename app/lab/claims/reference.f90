!> The reference of a contact of `faststrip-lab references`: NORM and TANG on two grids, one with
!> elements twice as long and wide, extrapolated where that is justified.
!>
!> Measured on 108 states of 54 contacts, 36, 72 and 144 elements across. The differences of the
!> grids fall by 4.1 (penetration, pmax), 3.1 (Fx), 2.3 (Fy), 3.4 (Mz). Extrapolated with the order
!> 2 the penetration, with the order 1.5 Fy and Mz agree better from one pair of grids to the next
!> than the finer grids do; Fx and pmax do not, and stay as they are. NORM's area counts elements:
!> it jumps by half a percent from grid to grid. Rows and columns that end where the square of the
!> pressure vanishes have areas that agree to a tenth of a percent.
!>
!> In steady rolling the friction power is what the forces do on the creepages. The sum of
!> tractions on slips is that, too, but lacks 5 % and more where next to nothing slides, as the slip
!> is at the trailing edge, in less than an element.
module faststrip_lab_claims_reference
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error, st_ok
    use faststrip_base_creepage, only: creepage_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t
    use faststrip_lab_pressures, only: solve_by_norm
    use faststrip_kalker_normal_rows, only: rows_as_strips, count_rows
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           edges_of_norm
    use faststrip_normal_simple_patch_ellipse, only: patch_end
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_lab_claims_record, only: reference_record_t, n_figures, figure_units
    implicit none
    private

    public :: reference_workspace_t, find_patches, find_pressures, find_figures

    ! Residuals, far below the errors of any grid.
    real(wp), parameter :: norm_tolerance = 1.0e-8_wp, tang_tolerance = 1.0e-6_wp
    ! Elements of the first look, mm, and across the patches that creepages are drawn for.
    real(wp), parameter :: first_side = 0.4_wp
    integer, parameter :: first_across = 24
    ! Patches with less of the load than this do not set the elements' sides, and sides are at
    ! least those of all patches side by side with this many times as many elements.
    real(wp), parameter :: least_share = 0.02_wp, most_finer = 2.0_wp
    ! What is added of the difference of the grids, in the order of `figure_names`, and what of it
    ! is doubtful then: nine of ten figures of 36 and 72 elements are within that of those of 144.
    real(wp), parameter :: added(n_figures) = [1.0_wp/3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
        1.0_wp/(2.0_wp**1.5_wp - 1.0_wp), 1.0_wp/(2.0_wp**1.5_wp - 1.0_wp), 0.0_wp, 0.0_wp]
    real(wp), parameter :: doubtful(n_figures) = [0.5_wp, 1.0_wp, 1.0_wp, 1.0_wp, 0.7_wp, 0.7_wp, &
        1.0_wp, 1.0_wp]
    ! Grids may agree by chance.
    real(wp), parameter :: least_doubt(n_figures) = [1.0e-5_wp, 1.0e-4_wp, 5.0e-4_wp, 1.0e-4_wp, &
        1.0e-4_wp, 1.0e-4_wp, 2.0e-4_wp, 1.0e-3_wp]

    !> One grid.
    type :: level_t
        type(norm_workspace_t) :: norm
        type(tang_workspace_t) :: tang
        type(normal_result_t) :: normal
    end type level_t

    !> What the solvers work in.
    type :: reference_workspace_t
        type(contact_strips_t) :: strips !! the patches, as rows of elements
        type(level_t) :: first           !! the grid that found them
        type(level_t) :: coarse          !! the grids of the reference
        type(level_t) :: fine            !! the same
    end type reference_workspace_t

contains

    !> Find the patches, as strips.
    subroutine find_patches(work, case, status)
        type(reference_workspace_t), intent(inout) :: work !! its strips are filled
        class(contact_case_t), intent(in) :: case      !! gap, material, load
        type(status_t), intent(out) :: status          !! of NORM

        real(wp) :: sides(2) ! mm
        integer :: look

        sides = first_side
        do look = 1, 2
            call solve_normal(work%first, case, sides, status)
            if (is_error(status)) return
            call reserve_strips(work%strips, count_rows(work%first%norm%grid), status)
            if (.not. is_error(status)) &
                call rows_as_strips(work%first%norm%grid, work%strips, status)
            if (is_error(status)) return
            sides = extents_of(work%strips)/first_across
        end do
    end subroutine find_patches

    !> Solve the normal problem on both grids.
    subroutine find_pressures(work, case, across, extents, status)
        type(reference_workspace_t), intent(inout) :: work !! with the patches
        class(contact_case_t), intent(in) :: case      !! gap, material, load
        integer, intent(in) :: across                  !! elements of the finer grid, each way
        real(wp), intent(out) :: extents(2)            !! that they are across, mm
        type(status_t), intent(out) :: status          !! of NORM, also a limitation

        extents = extents_of(work%strips)
        call solve_normal(work%coarse, case, 2.0_wp*extents/across, status)
        if (status%code == st_ok) call solve_normal(work%fine, case, extents/across, status)
    end subroutine find_pressures

    !> Length and width of the patches that the elements are to be fine enough for.
    pure function extents_of(strips) result(extents)
        type(contact_strips_t), intent(in) :: strips
        real(wp) :: extents(2)

        real(wp) :: load, total(2), own(2)
        integer :: first, last

        extents = huge(extents)
        total = 0.0_wp
        load = load_of(strips, 1, strips%n)
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            own = [2.0_wp*maxval(strips%half_length(first:last)), &
                   strips%y_right(last) - strips%y_left(first)]
            total = [max(total(1), own(1)), total(2) + own(2)]
            if (load_of(strips, first, last) >= least_share*load) extents = min(extents, own)
        end do
        extents = max(extents, total/most_finer)
    end function extents_of

    pure real(wp) function load_of(strips, first, last)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: first, last

        load_of = 0.5_wp*pi*sum(strips%p0(first:last)*strips%half_length(first:last) &
                                *(strips%y_right(first:last) - strips%y_left(first:last)))
    end function load_of

    subroutine solve_normal(level, case, sides, status)
        type(level_t), intent(inout) :: level
        class(contact_case_t), intent(in) :: case
        real(wp), intent(in) :: sides(2) ! of the elements, mm
        type(status_t), intent(out) :: status

        type(norm_options_t) :: options

        options%two_levels = .false.
        options%tolerance = norm_tolerance
        options%dx = sides(1)
        options%dy = sides(2)
        call solve_by_norm(level%norm, case, options, level%normal, status)
    end subroutine solve_normal

    !> All figures for the creepages of a contact.
    subroutine find_figures(work, case, record, status)
        type(reference_workspace_t), intent(inout) :: work !! with pressures
        class(contact_case_t), intent(in) :: case      !! material, friction, creepages
        type(reference_record_t), intent(inout) :: record  !! its figures and doubts are set
        type(status_t), intent(out) :: status          !! of TANG

        real(wp) :: coarse(n_figures), fine(n_figures)

        call solve_tangential(work%coarse, case, coarse, status)
        if (.not. is_error(status)) call solve_tangential(work%fine, case, fine, status)
        if (is_error(status)) return
        record%figures = fine + added*(fine - coarse)
        record%figures(7) = power_of(case%creepage, record%figures(4:6))
        record%doubts = max(least_doubt, doubtful*abs(fine - coarse)/figure_units(record))
    end subroutine find_figures

    subroutine solve_tangential(level, case, figures, status)
        type(level_t), intent(inout) :: level
        class(contact_case_t), intent(in) :: case
        real(wp), intent(out) :: figures(n_figures)
        type(status_t), intent(out) :: status

        type(tang_options_t) :: options
        type(tangential_result_t) :: forces

        options%edges = edges_of_norm
        options%tolerance = tang_tolerance
        call tang_solve(level%tang, level%norm%grid, case%material, case%mu, case%creepage, &
                        options, forces, status)
        figures = [level%normal%penetration, level%normal%pmax, smooth_area(level%norm%grid), &
                   forces%fx, forces%fy, forces%mz, &
                   power_of(case%creepage, [forces%fx, forces%fy, forces%mz]), &
                   forces%stick_fraction]
    end subroutine solve_tangential

    !> Friction power of steady rolling: forces on the rail oppose the creepages.
    pure real(wp) function power_of(creepage, forces)
        type(creepage_t), intent(in) :: creepage
        real(wp), intent(in) :: forces(3)

        power_of = -(creepage%cksi*forces(1) + creepage%ceta*forces(2) + creepage%cphi*forces(3))
    end function power_of

    !> Area of the contact, from the extents of rows and of columns.
    pure real(wp) function smooth_area(grid) result(area)
        type(contact_grid_t), intent(in) :: grid !! with pressures

        integer :: i, j

        area = 0.0_wp
        do j = 1, grid%ny
            area = area + extent(grid%pressure(:, j))
        end do
        do i = 1, grid%nx
            area = area + extent(grid%pressure(i, :))
        end do
        area = 0.5_wp*area*grid%dx*grid%dy
    end function smooth_area

    !> Extent of the pressures in a row or column, in elements.
    pure real(wp) function extent(pressure)
        real(wp), intent(in) :: pressure(:) ! zero outside the contact

        integer :: first, last

        extent = 0.0_wp
        last = 0
        do
            first = findloc(pressure(last + 1:) > 0.0_wp, .true., dim=1)
            if (first == 0) return
            first = last + first
            last = findloc(pressure(first:) > 0.0_wp, .false., dim=1)
            last = merge(first + last - 2, size(pressure), last > 0)
            if (last - first < 2) then
                extent = extent + (last - first + 1)
            else
                extent = extent + (last - first) + tip(pressure(first), pressure(first + 1)) &
                         + tip(pressure(last), pressure(last - 1))
            end if
        end do
    end function extent

    !> How far the contact reaches beyond the middle of its last element, in elements: the square
    !> of the pressure falls linearly.
    pure real(wp) function tip(last, before)
        real(wp), intent(in) :: last, before

        tip = 1.0_wp
        if (before > last) tip = min(1.0_wp, last**2/(before**2 - last**2))
    end function tip
end module faststrip_lab_claims_reference
