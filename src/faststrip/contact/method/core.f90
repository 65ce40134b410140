!> The methods of the core: a line for each.
module faststrip_contact_method_core
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_contact_method, only: workspace_t, normal_method_t, tangential_method_t, &
                                        normal_method_of, tangential_method_of, &
                                        enter_normal_method, enter_tangential_method
    use faststrip_contact_method_approximate, only: kpec_method, kpec_strips_method, analyn_method
    use faststrip_contact_method_fastsim, only: fastsim_method, elliptic_fastsim_method, &
                                                weighted_fastsim_method
    use faststrip_contact_method_faststrip, only: faststrip_method, plain_faststrip_method
    use faststrip_contact_method_hertz, only: hertz_method
    use faststrip_contact_method_laws, only: no_forces, linear_method, she_method, polach_method
    use faststrip_contact_method_paper, only: printed_method, corrected_method
    use faststrip_contact_method_strip, only: strip_method, equal_area_method, equal_moments_method
    implicit none
    private

    public :: enter_core_methods

contains

    !> Enter the methods of the core; one that the host has entered in the place of one of them
    !> stays.
    subroutine enter_core_methods(workspace, status)
        type(workspace_t), intent(inout) :: workspace !! knows them afterwards
        type(status_t), intent(out) :: status         !! of `enter_normal_method`

        call clear_status(status)
        call add_normal(strip_method)
        call add_normal(hertz_method)
        call add_normal(equal_area_method)
        call add_normal(equal_moments_method)
        call add_normal(kpec_method)
        call add_normal(kpec_strips_method)
        call add_normal(analyn_method)
        call add_tangential(no_forces)
        call add_tangential(faststrip_method)
        call add_tangential(plain_faststrip_method)
        call add_tangential(printed_method)
        call add_tangential(corrected_method)
        call add_tangential(fastsim_method)
        call add_tangential(elliptic_fastsim_method)
        call add_tangential(weighted_fastsim_method)
        call add_tangential(linear_method)
        call add_tangential(she_method)
        call add_tangential(polach_method)

    contains

        subroutine add_normal(method)
            class(normal_method_t), intent(in), target :: method

            if (is_error(status)) return
            if (.not. associated(normal_method_of(workspace, method%about%number))) &
                call enter_normal_method(workspace, method, status)
        end subroutine add_normal

        subroutine add_tangential(method)
            class(tangential_method_t), intent(in), target :: method

            if (is_error(status)) return
            if (.not. associated(tangential_method_of(workspace, method%about%number))) &
                call enter_tangential_method(workspace, method, status)
        end subroutine add_tangential
    end subroutine enter_core_methods
end module faststrip_contact_method_core
