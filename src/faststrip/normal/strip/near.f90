!> A neighbour of the last solution: the same patches, strips and edges, solved to the last digits.
!>
!> What is found near a solution, for derivatives, differs from it smoothly: nothing is looked for,
!> and no edge follows the gap.
module faststrip_normal_strip_near
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strip_converge, only: converge, converged
    use faststrip_normal_strip_figures, only: hand_over, summarize, correction_of
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_state, only: strip_workspace_t, position_strips, remember
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: demand_t, normal_result_t
    implicit none
    private

    public :: solve_near

contains

    !> Solve for strips and ends from those of the last solution.
    pure subroutine solve_near(workspace, compliance, demand, tolerance, strips, result, found)
        type(strip_workspace_t), intent(inout) :: workspace !! with a gap near that of the last
                                                            !! solution
        real(wp), intent(in) :: compliance              !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand            !! load or penetration
        real(wp), intent(in) :: tolerance               !! relative size of the last step
        type(contact_strips_t), intent(inout) :: strips !! reserved; those of the solution
        type(normal_result_t), intent(inout) :: result  !! its figures
        logical, intent(out) :: found                   !! is there one like the last one?

        type(patches_t) :: patches
        real(wp) :: correction
        integer :: n, outcome
        logical :: graded

        found = workspace%old%n > 0
        if (.not. found) return
        patches = workspace%old
        graded = workspace%graded
        workspace%graded = .false.
        call position_strips(workspace, patches, n)
        workspace%strips%penetration = workspace%old_penetration/workspace%old_correction
        call converge(workspace, compliance, demand, tolerance, .false., patches, result%cost, &
                      outcome)
        workspace%graded = graded
        found = outcome == converged
        if (.not. found) return
        call remember(workspace, patches)
        call hand_over(workspace%strips, patches, strips)
        correction = correction_of(strips%y_left(:n), strips%y_right(:n))
        associate (penetration => workspace%strips%penetration)
            call summarize(strips, workspace%curve%h_lowest + correction*penetration, correction, &
                           result)
            workspace%old_load = result%load
            workspace%old_penetration = penetration*correction
            workspace%old_correction = correction
        end associate
    end subroutine solve_near
end module faststrip_normal_strip_near
