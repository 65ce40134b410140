!> The pressures of one contact, on which benches then judge and time forces.
module faststrip_lab_pressures
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: normal_compliance
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: normal_strip, tangential_none
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: solve_contact
    use faststrip_geometry_gap, only: check_gap
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       set_norm_gap, norm_solve_demand
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: solve_pressures, solve_by_strips, solve_by_norm, largest_patch

contains

    !> Solve the normal problem of a contact, whatever its tangential method.
    subroutine solve_pressures(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace !! grown as needed
        class(contact_case_t), intent(in) :: case     !! with its gap
        type(contact_result_t), intent(out) :: result !! without forces
        type(status_t), intent(out) :: status         !! those of `solve_contact`

        type(contact_case_t) :: normal

        call check_gap(case%gap, status)
        if (.not. is_error(status)) &
            call reserve_workspace(workspace, case%methods, size(case%gap%y), status)
        if (is_error(status)) return
        normal = case
        normal%methods%tangential = tangential_none
        call solve_contact(workspace, normal, result, status)
    end subroutine solve_pressures

    !> The same by so many strips, without estimates.
    subroutine solve_by_strips(workspace, case, strips_per_patch, result, status)
        type(workspace_t), intent(inout) :: workspace   !! grown as needed
        class(contact_case_t), intent(in) :: case       !! with its gap
        integer, intent(in) :: strips_per_patch         !! as of its methods
        type(normal_result_t), intent(out) :: result    !! figures
        type(status_t), intent(out) :: status           !! those of `solve_contact`

        type(contact_case_t) :: by_strips
        type(contact_result_t) :: whole

        by_strips = case
        by_strips%methods%normal = normal_strip
        by_strips%methods%strips_per_patch = strips_per_patch
        by_strips%estimate = .false.
        call solve_pressures(workspace, by_strips, whole, status)
        result = whole%normal
    end subroutine solve_by_strips

    !> The same by NORM, whose grid stays for TANG.
    subroutine solve_by_norm(norm, case, options, result, status, strips)
        type(norm_workspace_t), intent(inout) :: norm   !! grown as needed
        class(contact_case_t), intent(in) :: case       !! with its gap
        type(norm_options_t), intent(in) :: options     !! elements, tolerance
        type(normal_result_t), intent(out) :: result    !! figures
        type(status_t), intent(out) :: status           !! those of `norm_solve_demand`
        type(contact_strips_t), intent(in), optional :: strips !! to start from

        call reserve_norm(norm, size(case%gap%y), status)
        if (.not. is_error(status)) call set_norm_gap(norm, case%gap, status)
        if (.not. is_error(status)) &
            call norm_solve_demand(norm, normal_compliance(case%material), case%demand_t, options, &
                                   result, status, strips)
    end subroutine solve_by_norm

    !> The ellipse of the patch that bears most of the load.
    pure type(patch_ellipse_t) function largest_patch(strips) result(largest)
        type(contact_strips_t), intent(in) :: strips !! a solution

        type(patch_ellipse_t) :: ellipse
        integer :: first, last

        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            ellipse = patch_ellipse(strips, first, last)
            if (ellipse%load > largest%load) largest = ellipse
        end do
    end function largest_patch
end module faststrip_lab_pressures
