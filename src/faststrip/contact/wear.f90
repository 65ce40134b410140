!> T gamma, fatigue and wear of a contact that was solved with forces.
module faststrip_contact_wear
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: clear_status, is_error
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_wear_law, only: find_strip_wear
    use faststrip_tangential_wear_numbers, only: t_gamma, t_gamma_with_spin, surface_fatigue_index
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    implicit none
    private

    public :: find_wear

contains

    !> Find what a contact's forces do to the surfaces.
    subroutine find_wear(workspace, case, result)
        type(workspace_t), intent(inout) :: workspace   !! with the solution; gets wear of strips
        type(contact_case_t), intent(in) :: case        !! law, yield stress in shear
        type(contact_result_t), intent(inout) :: result !! with forces; gets the figures

        type(tangential_result_t) :: tangential
        real(wp) :: load

        if (is_error(workspace%wear_status)) call clear_status(workspace%wear_status)
        if (.not. result%has_forces) return
        ! Tractions rub along the surface, whatever the frame of the contact.
        tangential = result%tangential
        load = result%normal%load
        if (result%is_curved) then
            tangential = result%along
            load = result%along_load
        end if
        associate (figures => result%wear, area => result%normal%area, &
                   n => workspace%strips%n, found => workspace%strip_wear)
            figures%t_gamma = t_gamma(tangential, result%creepage)
            figures%t_gamma_spin = t_gamma_with_spin(tangential, result%creepage)
            figures%t_gamma_per_area = figures%t_gamma/area
            figures%knows_fatigue = case%yield_shear > 0.0_wp
            if (figures%knows_fatigue) figures%fatigue_index = surface_fatigue_index( &
                tangential, load, area, case%yield_shear)
            if (case%wear_law%n == 0 .or. workspace%strip_forces%n /= n) return
            call find_strip_wear(case%wear_law, workspace%strips, workspace%strip_forces, &
                                 found%t_gamma_per_area(:n), found%mass(:n), &
                                 found%pass_depth(:n), figures%wear, workspace%wear_status)
            figures%knows_wear = .not. is_error(workspace%wear_status)
        end associate
    end subroutine find_wear
end module faststrip_contact_wear
