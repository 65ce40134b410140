!> Forces of creepages beyond what methods take: of creepages in the same proportions; what goes
!> with the size of slip is told of them as they are. A copy of the case is apart from its caller
!> for the stack: a call needs it only where creepages are so large.
module faststrip_contact_cut
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t, workspace_t, tangential_method_t
    use faststrip_tangential_motion, only: cut_creepage
    implicit none
    private

    public :: solve_motion, solve_tried

contains

    !> Solve for the creepages of a case, cut if they are beyond what the method takes.
    subroutine solve_motion(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace    !! with a normal solution
        type(contact_case_t), intent(in) :: case         !! with its creepages as they are
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result  !! gets its tangential part
        type(status_t), intent(out) :: status            !! those of the method

        type(creepage_t) :: creepage
        real(wp) :: share

        result%creepage = case%creepage
        call cut_creepage(case%creepage, creepage, share)
        if (.not. share < 1.0_wp .or. .not. method%cuts_creepages) then
            call method%solve(workspace, case, result, status)
        else
            call solve_copy(workspace, case, method, result, status)
        end if
    end subroutine solve_motion

    subroutine solve_copy(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        class(tangential_method_t), intent(in) :: method
        type(contact_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        type(contact_case_t) :: tried

        tried%contact_terms_t = case%contact_terms_t
        call solve_tried(workspace, tried, method, result, status)
    end subroutine solve_copy

    !> The same of a case that may change on the way; it is what it was afterwards.
    subroutine solve_tried(workspace, tried, method, result, status)
        type(workspace_t), intent(inout) :: workspace    !! with a normal solution
        type(contact_case_t), intent(inout) :: tried     !! with its creepages as they are
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result  !! gets its tangential part
        type(status_t), intent(out) :: status            !! those of the method

        type(creepage_t) :: creepage
        real(wp) :: share, gain

        result%creepage = tried%creepage
        call cut_creepage(tried%creepage, creepage, share)
        if (.not. method%cuts_creepages) share = 1.0_wp
        if (.not. share < 1.0_wp) then
            call method%solve(workspace, tried, result, status)
            return
        end if
        ! As much heat of less slip.
        gain = workspace%friction%heat%gain
        workspace%friction%heat%gain = gain/share
        workspace%friction%speed = tried%friction%speed/share
        tried%creepage = creepage
        call method%solve(workspace, tried, result, status)
        tried%creepage = result%creepage
        workspace%friction%heat%gain = gain
        workspace%friction%speed = tried%friction%speed
        if (.not. is_error(status)) call scale_slip(workspace, result, 1.0_wp/share)
    end subroutine solve_tried

    pure subroutine scale_slip(workspace, result, factor)
        type(workspace_t), intent(inout) :: workspace
        type(contact_result_t), intent(inout) :: result
        real(wp), intent(in) :: factor

        result%tangential%friction_power = result%tangential%friction_power*factor
        associate (field => workspace%field, forces => workspace%strip_forces)
            if (field%n > 0) then
                field%sx(:field%n) = field%sx(:field%n)*factor
                field%sy(:field%n) = field%sy(:field%n)*factor
            end if
            if (forces%n > 0) forces%friction_power(:forces%n) = &
                forces%friction_power(:forces%n)*factor
        end associate
    end subroutine scale_slip
end module faststrip_contact_cut
