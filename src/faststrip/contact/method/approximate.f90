!> KPEC, strips in its patch, and ANALYN as methods of a contact; of none an error is estimated.
module faststrip_contact_method_approximate
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_normal_simple_analyn, only: analyn_solve
    use faststrip_normal_simple_kpec, only: kpec_solve
    use faststrip_normal_simple_kpec_strips, only: kpec_strips_solve
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, demand_of
    use faststrip_contact_method_capacity, only: on_gap_t, on_strips_t, check_capacity, &
                                                 ellipse_strips
    use faststrip_contact_methods, only: normal_table, normal_kpec, normal_kpec_strips, &
                                         normal_analyn
    implicit none
    private

    public :: kpec_method, kpec_strips_method, analyn_method

    !> Kik and Piotrowski with the elliptic correction.
    type, extends(on_gap_t) :: kpec_method_t
    contains
        procedure :: solve => solve_by_kpec
    end type kpec_method_t

    !> Strips in the patch of KPEC.
    type, extends(on_strips_t) :: kpec_strips_method_t
    contains
        procedure :: solve => solve_by_kpec_strips
    end type kpec_strips_method_t

    !> Sichani, Enblom and Berg.
    type, extends(on_gap_t) :: analyn_method_t
    contains
        procedure :: solve => solve_by_analyn
    end type analyn_method_t

    type(kpec_method_t), target, save :: kpec_method = kpec_method_t( &
        about=normal_table(findloc(normal_table%number, normal_kpec, dim=1)))
        !! KPEC
    type(kpec_strips_method_t), target, save :: kpec_strips_method = kpec_strips_method_t( &
        about=normal_table(findloc(normal_table%number, normal_kpec_strips, dim=1)))
        !! strips in the patch of KPEC
    type(analyn_method_t), target, save :: analyn_method = analyn_method_t( &
        about=normal_table(findloc(normal_table%number, normal_analyn, dim=1)))
        !! ANALYN

contains

    !> Solve by KPEC.
    subroutine solve_by_kpec(self, workspace, case, normal, status)
        class(kpec_method_t), intent(in) :: self      !! KPEC
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `kpec_solve`

        call kpec_solve(workspace%solver%curve, normal_compliance(case%material), &
                        demand_of(workspace, case), ellipse_strips(case%methods), &
                        workspace%strips, normal, status)
    end subroutine solve_by_kpec

    !> Solve by strips in the patch of KPEC.
    subroutine solve_by_kpec_strips(self, workspace, case, normal, status)
        class(kpec_strips_method_t), intent(in) :: self !! strips in the patch of KPEC
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `kpec_strips_solve`

        call clear_status(status)
        call check_capacity(workspace, case%methods, status)
        if (is_error(status)) return
        call kpec_strips_solve(workspace%solver%curve, normal_compliance(case%material), &
                               demand_of(workspace, case), ellipse_strips(case%methods), &
                               workspace%solver%newton, workspace%strips, normal, status)
    end subroutine solve_by_kpec_strips

    !> Solve by ANALYN.
    subroutine solve_by_analyn(self, workspace, case, normal, status)
        class(analyn_method_t), intent(in) :: self    !! ANALYN
        type(workspace_t), intent(inout) :: workspace !! its strips are filled
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! of `analyn_solve`

        call analyn_solve(workspace%solver%curve, normal_compliance(case%material), &
                          demand_of(workspace, case), ellipse_strips(case%methods), &
                          workspace%strips, normal, status)
    end subroutine solve_by_analyn
end module faststrip_contact_method_approximate
