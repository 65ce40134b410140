!> The reference that estimates of errors are judged by: Kalker's method on two grids, carried on.
!>
!> Penetration, maximum pressure and the area under the border (`faststrip_kalker_border`) are of
!> second order in the sides of the elements. Half the difference of the two grids is what the
!> reference itself may be wrong by: where that is no small part of an error, nothing can be said of
!> its estimate.
module faststrip_lab_studies_estimates_reference
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_ok
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       set_norm_curve, norm_solve_demand
    use faststrip_kalker_border, only: border_area
    use faststrip_contact_case, only: contact_case_t
    implicit none
    private

    public :: reference_t, find_reference, is_certain, elements_along, elements_across

    !> Elements of the coarser grid along and across the contact; the finer one has twice as many.
    integer, parameter :: elements_along = 60, elements_across = 120

    integer, parameter :: most_elements = 200000 ! of the finer grid

    ! What the reference may be wrong by: so much of the error, or so much of the figure. Estimates
    ! with 41 strips go down to 2e-4; five times as much would leave errors in that are those of the
    ! reference.
    real(wp), parameter :: share_of_error = 0.3_wp, least = 1.0e-4_wp

    !> Figures of a contact. Penetrations count from the lowest gap.
    type :: reference_t
        real(wp) :: figure(3) = 0.0_wp   !! penetration, mm, pmax, MPa, area, mm2
        real(wp) :: doubt(3) = 0.0_wp    !! what they may be wrong by, relative
        type(normal_result_t) :: coarse  !! of the coarser grid
        type(normal_errors_t) :: estimated !! its own estimates
    end type reference_t

contains

    !> Solve a contact on both grids. No reference is found where a grid does not hold the contact,
    !> or where it runs to the end of the gap data.
    subroutine find_reference(workspace, contact, curve, strips, reference, is_found)
        type(norm_workspace_t), intent(inout) :: workspace
        class(contact_case_t), intent(in) :: contact !! material, demand
        type(gap_curve_t), intent(in) :: curve       !! its gap
        type(contact_strips_t), intent(in) :: strips !! a solution, for the size of the grids
        type(reference_t), intent(out) :: reference
        logical, intent(out) :: is_found

        type(norm_options_t) :: options
        type(normal_result_t) :: fine
        type(status_t) :: status
        real(wp) :: compliance, coarse_figure(3), fine_figure(3), coarse_area

        is_found = .false.
        options%dx = 2.0_wp*maxval(strips%half_length(:strips%n))/elements_along
        options%dy = (strips%y_right(strips%n) - strips%y_left(1))/elements_across
        options%most_elements = most_elements
        compliance = normal_compliance(contact%material)
        call reserve_norm(workspace, curve%n, status)
        if (.not. is_error(status)) call set_norm_curve(workspace, curve, status)
        if (is_error(status)) return
        call norm_solve_demand(workspace, compliance, contact%demand_t, options, reference%coarse, &
                               status)
        if (status%code /= st_ok .or. .not. workspace%is_estimated) return
        reference%estimated = workspace%normal_errors
        coarse_area = border_area(workspace%grid)
        options%dx = 0.5_wp*options%dx
        options%dy = 0.5_wp*options%dy
        options%two_levels = .false.
        options%warm_start = .true.
        call norm_solve_demand(workspace, compliance, contact%demand_t, options, fine, status)
        if (status%code /= st_ok) return
        coarse_figure = [reference%coarse%penetration - curve%h_lowest, reference%coarse%pmax, &
                         coarse_area]
        fine_figure = [fine%penetration - curve%h_lowest, fine%pmax, &
                       border_area(workspace%grid)]
        reference%figure = fine_figure + (fine_figure - coarse_figure)/3.0_wp
        is_found = all(reference%figure > 0.0_wp)
        if (is_found) reference%doubt = 0.5_wp*abs(fine_figure - coarse_figure)/reference%figure
    end subroutine find_reference

    !> Is the reference better known than an error, or good enough?
    elemental logical function is_certain(doubt, error)
        real(wp), intent(in) :: doubt !! relative
        real(wp), intent(in) :: error !! relative, not negative

        is_certain = doubt <= max(share_of_error*error, least)
    end function is_certain
end module faststrip_lab_studies_estimates_reference
