!> Temperatures of a contact that was solved with forces, from its elements.
module faststrip_contact_method_heat
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, add_limitation, number_text, &
                                     st_under_resolved
    use faststrip_base_thermal, only: diffusivity
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_tangential_heat_flash, only: find_temperatures
    implicit none
    private

    public :: find_heat

    ! Given: V a/(2 kappa) from which heat flows in depth only (Ertz and Knothe 2002): conduction
    ! along the surface takes off 0.13 % there, 6 % at 1.
    real(wp), parameter :: least_peclet = 10.0_wp

contains

    !> Find the temperatures of a contact.
    subroutine find_heat(workspace, case, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with the solution; its field gets them
        type(contact_case_t), intent(in) :: case        !! bodies and rolling speed, checked
        type(contact_result_t), intent(inout) :: result !! with forces; gets the figures
        type(status_t), intent(inout) :: status
            !! limitations so far; `st_under_resolved` at low speed; changed by an error of
            !! `find_temperatures`

        type(status_t) :: found
        real(wp) :: peclet

        if (.not. result%has_forces) return
        call find_temperatures(workspace%field, workspace%friction%heat, result%flash, found)
        if (is_error(found)) then
            status = found
            return
        end if
        workspace%field%has_temperature = .true.
        result%knows_temperatures = .true.
        peclet = 0.5_wp*case%friction%speed*result%normal%x_max/maxval(diffusivity(case%thermal))
        if (peclet < least_peclet) call add_limitation(status, st_under_resolved, &
            'temperatures leave out conduction along the surface: V a/(2 kappa) must be at ' // &
            'least 10 for that, is ' // number_text(peclet))
    end subroutine find_heat
end module faststrip_contact_method_heat
