!> A wheelset on a track: from its state to the forces of every contact.
!>
!> All contacts of a wheel share its height: each has the overlap along its own normal that follows
!> from it.
module faststrip_wheelset_solve
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_wheelset_model, only: check_rail_stiffness
    use faststrip_wheelset_solve_axle_moment, only: solve_on_rails
    use faststrip_wheelset_solve_springs, only: solve_on_springs
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheelset_result_t, &
                                        wheelset_workspace_t
    implicit none
    private

    public :: solve_wheelset

contains

    !> The contacts of a wheelset and their forces. One that rolls backwards, by the mean of its
    !> speed and that of its wheels' surfaces, is solved as its image that rolls ahead: x of the
    !> figures is that of the track either way.
    subroutine solve_wheelset(model, workspace, state, demand, result, status)
        type(wheelset_model_t), intent(in) :: model            !! made
        type(wheelset_workspace_t), intent(inout) :: workspace !! reserved for it
        type(wheelset_state_t), intent(in) :: state            !! z, roll and pitch rate count where
                                                               !! the demand leaves them
        type(wheelset_demand_t), intent(in) :: demand          !! what is prescribed
        type(wheelset_result_t), intent(inout) :: result       !! of the wheels asked for
        type(status_t), intent(out) :: status
            !! `st_bad_argument`, `st_workspace_too_small`, `st_no_contact`, `st_no_convergence`,
            !! `st_beyond_adhesion`, those of contacts; `st_target_missed`: the force jumps over
            !! the load

        type(environment_t) :: environment

        workspace%wheel%steps = 0
        if (all(model%rail_stiffness == 0.0_wp)) then
            call solve_on_rails(model, workspace, state, demand, result, status)
            return
        end if
        call hold_environment(environment)
        call check_rail_stiffness(model%rail_stiffness, status)
        if (.not. is_error(status)) &
            call solve_on_springs(model, workspace, state, demand, result, status)
        call restore_environment(environment)
    end subroutine solve_wheelset
end module faststrip_wheelset_solve
