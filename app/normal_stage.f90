!> The normal problem of one contact, by the method asked for.
module faststrip_app_normal_stage
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, is_error
    use faststrip_material, only: material_t, normal_compliance
    use faststrip_profile_gap, only: gap_t, check_gap
    use faststrip_profile_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_certificate, only: certificate_t, certify_strips
    use faststrip_normal_equal_ellipse, only: replace_by_ellipses, equal_area, equal_moments
    use faststrip_normal_hertz, only: hertz_t, hertz_solve_gap, hertz_solve_gap_penetration, &
                                      hertz_strips
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, normal_result_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve, &
                                      strip_solve_penetration, strips_auto
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_app_methods, only: methods_t
    implicit none
    private

    public :: normal_stage_t, demand_t, make_normal_stage, make_room, solve_normal, certify

    ! Strips of a Hertz ellipse where the number is left to the solver, and the most it takes.
    integer, parameter :: auto_hertz_strips = 15, auto_most_strips = 41

    !> The normal method with the room it needs, and its last solution.
    type :: normal_stage_t
        type(methods_t) :: methods       !! what was asked for
        type(contact_strips_t) :: strips !! of the last contact
        type(hertz_t) :: hertz           !! of the last contact, if by Hertz
        type(strip_workspace_t), private :: workspace
        type(gap_curve_t), private :: curve
    end type normal_stage_t

    !> What presses the bodies together.
    type :: demand_t
        logical :: by_load = .true.      !! is the load given, or the penetration?
        real(wp) :: load = 0.0_wp        !! normal force, N
        real(wp) :: penetration = 0.0_wp !! approach from h = 0, mm
    end type demand_t

contains

    !> Make room for the strips of a normal method.
    subroutine make_normal_stage(methods, stage, status)
        type(methods_t), intent(in) :: methods     !! checked
        type(normal_stage_t), intent(out) :: stage !! ready
        type(status_t), intent(out) :: status      !! from the library

        integer :: room

        stage%methods = methods
        room = 2*methods%strips_per_patch + 60
        if (methods%strips_per_patch == strips_auto) room = 2*auto_most_strips + 60
        call reserve_strips(stage%strips, room, status)
    end subroutine make_normal_stage

    !> Grow the workspaces to what a gap needs, outside the time that is measured.
    subroutine make_room(stage, gap, status)
        type(normal_stage_t), intent(inout) :: stage !! made beforehand
        type(gap_t), intent(in) :: gap               !! undeformed gap, mm
        type(status_t), intent(out) :: status        !! those of `check_gap`

        call check_gap(gap, status)
        if (is_error(status)) return
        if (stage%methods%normal == 'hertz') then
            call reserve_gap_curve(stage%curve, size(gap%y), status)
        else
            call reserve_strip_workspace(stage%workspace, size(stage%strips%p0), size(gap%y), &
                                         status)
        end if
    end subroutine make_room

    !> Solve the normal problem; the strips are those of the patch, or of the Hertz ellipse.
    subroutine solve_normal(stage, gap, material, demand, normal, status)
        type(normal_stage_t), intent(inout) :: stage !! with room for the gap
        type(gap_t), intent(in) :: gap               !! undeformed gap, mm
        type(material_t), intent(in) :: material     !! moduli, MPa
        type(demand_t), intent(in) :: demand         !! load or penetration
        type(normal_result_t), intent(out) :: normal !! figures
        type(status_t), intent(out) :: status        !! an error, or a named limitation

        if (stage%methods%normal == 'hertz') then
            call solve_hertz(stage, gap, material, demand, normal, status)
        else
            call solve_by_strips(stage, gap, material, demand, normal, status)
        end if
    end subroutine solve_normal

    !> How wrong the last solution is, where that can be told: of strips.
    subroutine certify(stage, material, normal, certificate, is_certified)
        type(normal_stage_t), intent(in) :: stage       !! with a solution
        type(material_t), intent(in) :: material        !! moduli, MPa
        type(normal_result_t), intent(in) :: normal     !! its figures
        type(certificate_t), intent(out) :: certificate !! of them
        logical, intent(out) :: is_certified            !! does the certificate count?

        type(status_t) :: status

        is_certified = .false.
        if (stage%methods%normal /= 'strip') return
        call certify_strips(stage%workspace%curve, normal_compliance(material), stage%strips, &
                            normal, certificate, status)
        is_certified = .not. is_error(status)
    end subroutine certify

    subroutine solve_by_strips(stage, gap, material, demand, normal, status)
        type(normal_stage_t), intent(inout) :: stage
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        type(demand_t), intent(in) :: demand
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        type(strip_options_t) :: options
        type(status_t) :: ellipses

        call set_strip_gap(stage%workspace, gap, status)
        if (is_error(status)) return
        options%strips_per_patch = stage%methods%strips_per_patch
        if (demand%by_load) then
            call strip_solve(stage%workspace, normal_compliance(material), demand%load, options, &
                             stage%strips, normal, status)
        else
            call strip_solve_penetration(stage%workspace, normal_compliance(material), &
                                         demand%penetration, options, stage%strips, normal, &
                                         status)
        end if
        if (is_error(status) .or. stage%methods%normal == 'strip') return
        call replace_by_ellipses( &
            merge(equal_area, equal_moments, stage%methods%normal == 'equal_area'), &
            stage%workspace%curve, stage%strips, normal, ellipses)
        if (is_error(ellipses)) status = ellipses
    end subroutine solve_by_strips

    subroutine solve_hertz(stage, gap, material, demand, normal, status)
        type(normal_stage_t), intent(inout) :: stage
        type(gap_t), intent(in) :: gap
        type(material_t), intent(in) :: material
        type(demand_t), intent(in) :: demand
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        integer :: n

        call set_gap_curve(stage%curve, gap, status)
        if (is_error(status)) return
        if (demand%by_load) then
            call hertz_solve_gap(stage%curve, normal_compliance(material), demand%load, &
                                 stage%hertz, status)
        else
            call hertz_solve_gap_penetration(stage%curve, normal_compliance(material), &
                                             demand%penetration, stage%hertz, &
                                             status)
        end if
        if (is_error(status)) return
        normal%load = stage%hertz%load
        normal%penetration = stage%hertz%penetration + stage%curve%h_lowest
        normal%area = stage%hertz%area
        normal%pmax = stage%hertz%pmax
        normal%y_min = stage%hertz%y - stage%hertz%b
        normal%y_max = stage%hertz%y + stage%hertz%b
        normal%x_max = stage%hertz%a
        normal%n_patches = 1
        n = stage%methods%strips_per_patch
        if (n == strips_auto) n = auto_hertz_strips
        call hertz_strips(stage%hertz, n, stage%strips, status)
    end subroutine solve_hertz
end module faststrip_app_normal_stage
