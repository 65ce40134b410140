!> The normal problem of one contact, by the method asked for.
module faststrip_command_normal_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_under_resolved
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_limitations, only: name_resolution, add_limitation, default_resolution
    use faststrip_normal_strip, only: estimate_strips
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_contact_methods, only: contact_methods_t, normal_method, tangential_method, &
                                         normal_strip, tangential_faststrip
    use faststrip_contact_solve, only: contact_case_t, workspace_t, reserve_workspace, &
                                       set_contact_gap, solve_contact_normal
    use faststrip_command_methods, only: methods_t
    implicit none
    private

    public :: normal_stage_t, demand_t, make_normal_stage, make_room, solve_normal, certify

    !> The normal method with the room it needs, and its last solution.
    type :: normal_stage_t
        type(contact_methods_t) :: methods !! what was asked for
        type(workspace_t) :: workspace     !! with the strips of the last contact
        real(wp) :: resolution_limit = default_resolution
            !! largest estimated error of a resolved one
    end type normal_stage_t

contains

    !> Take over the methods.
    subroutine make_normal_stage(methods, stage)
        type(methods_t), intent(in) :: methods     !! checked
        type(normal_stage_t), intent(out) :: stage !! ready for `make_room`

        integer :: normal, tangential

        normal = normal_method(methods%normal)
        if (methods%normal == 'norm') normal = normal_strip ! for the strips that stand for its rows
        tangential = tangential_method(methods%tangential)
        if (methods%tangential == 'tang') tangential = tangential_faststrip ! does not count
        stage%resolution_limit = methods%resolution_limit
        stage%methods = contact_methods_t( &
            normal, tangential, &
            methods%strips_per_patch, methods%points_per_strip, methods%fastsim_nx, &
            methods%fastsim_ny)
    end subroutine make_normal_stage

    !> Grow the workspace to what a gap needs, outside the time that is measured.
    subroutine make_room(stage, gap, status)
        type(normal_stage_t), intent(inout) :: stage !! made beforehand
        type(gap_t), intent(in) :: gap               !! undeformed gap, mm
        type(status_t), intent(out) :: status        !! those of `check_gap`

        call check_gap(gap, status)
        if (is_error(status)) return
        call reserve_workspace(stage%workspace, stage%methods, size(gap%y), status)
    end subroutine make_room

    !> Solve the normal problem; the strips are those of the patch, or of the Hertz ellipse.
    subroutine solve_normal(stage, gap, material, demand, normal, status)
        type(normal_stage_t), intent(inout) :: stage !! with room for the gap
        type(gap_t), intent(in) :: gap               !! undeformed gap, mm
        type(material_t), intent(in) :: material     !! moduli, MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        type(normal_result_t), intent(out) :: normal !! figures
        type(status_t), intent(out) :: status        !! an error, or a named limitation

        type(contact_case_t) :: case

        if (allocated(gap%turn)) then
            call set_contact_gap(stage%workspace, gap%y, gap%h, gap%inv2r, status, gap%turn)
        else
            call set_contact_gap(stage%workspace, gap%y, gap%h, gap%inv2r, status)
        end if
        if (is_error(status)) return
        case%material = material
        case%demand_t = demand
        case%methods = stage%methods
        case%estimate = stage%methods%normal /= normal_strip ! of which `certify` does
        case%resolution_limit = stage%resolution_limit
        call solve_contact_normal(stage%workspace, case, normal, status)
    end subroutine solve_normal

    !> How wrong the last solution is, where that can be told: of strips. Errors above the limit are
    !> named in the status. Outside the time that is measured.
    subroutine certify(stage, material, normal, certificate, is_certified, status)
        type(normal_stage_t), intent(in) :: stage       !! with a solution
        type(material_t), intent(in) :: material        !! moduli, MPa
        type(normal_result_t), intent(in) :: normal     !! its figures
        type(certificate_t), intent(out) :: certificate !! of them
        logical, intent(out) :: is_certified            !! does the certificate count?
        type(status_t), intent(inout) :: status         !! limitations so far

        type(status_t) :: estimate

        is_certified = .false.
        if (stage%methods%normal /= normal_strip) return
        call estimate_strips(stage%workspace%solver, normal_compliance(material), &
                             stage%workspace%strips, normal, certificate, estimate)
        is_certified = .not. is_error(estimate)
        if (is_certified) then
            call name_resolution(certificate%est_err_penetration, certificate%est_err_pmax, &
                                 certificate%est_err_area, stage%resolution_limit, status)
        else
            call add_limitation(status, st_under_resolved, 'no error can be estimated: ' &
                                // trim(estimate%message))
        end if
    end subroutine certify
end module faststrip_command_normal_stage
