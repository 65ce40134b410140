!> The normal problem of one contact by the core's methods: its workspace, and how wrong it is.
module faststrip_command_normal_stage
    use faststrip_base_status, only: status_t, is_error, st_under_resolved
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap, only: check_gap
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_limitations, only: name_resolution, add_limitation
    use faststrip_normal_strip, only: estimate_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_strip
    use faststrip_contact_solve, only: workspace_t, reserve_workspace
    implicit none
    private

    public :: make_room, certify

contains

    !> Grow the workspace to what a contact needs, outside the time that is measured.
    subroutine make_room(workspace, contact, status)
        type(workspace_t), intent(inout) :: workspace !! sized
        class(contact_case_t), intent(in) :: contact  !! its gap and methods
        type(status_t), intent(out) :: status         !! those of `check_gap`

        call check_gap(contact%gap, status)
        if (is_error(status)) return
        call reserve_workspace(workspace, contact%methods, size(contact%gap%y), status)
    end subroutine make_room

    !> How wrong the last solution is, where that can be told: of strips. Errors above the limit are
    !> named in the status. Outside the time that is measured.
    subroutine certify(workspace, contact, normal, certificate, is_certified, status)
        type(workspace_t), intent(in) :: workspace      !! with a solution
        class(contact_case_t), intent(in) :: contact    !! what was solved
        type(normal_result_t), intent(in) :: normal     !! its figures
        type(certificate_t), intent(out) :: certificate !! of them
        logical, intent(out) :: is_certified            !! does the certificate count?
        type(status_t), intent(inout) :: status         !! limitations so far

        type(status_t) :: estimate

        is_certified = .false.
        if (contact%methods%normal /= normal_strip) return
        call estimate_strips(workspace%solver, normal_compliance(contact%material), &
                             workspace%strips, normal, certificate, estimate)
        is_certified = .not. is_error(estimate)
        if (is_certified) then
            call name_resolution(certificate%est_err_penetration, certificate%est_err_pmax, &
                                 certificate%est_err_area, contact%resolution_limit, status)
        else
            call add_limitation(status, st_under_resolved, 'no error can be estimated: ' &
                                // trim(estimate%message))
        end if
    end subroutine certify
end module faststrip_command_normal_stage
