!> Ends of patches as unknowns: where they are, how far they should move, and moving them.
!>
!> Each moves outwards in units of its end strip's width (`end_width`); its equation is that of
!> `end_step`: the squared strip length, extrapolated, vanishes at the end.
module faststrip_normal_strip_end_unknowns
    use faststrip_base_kinds, only: wp
    use faststrip_normal_strip_ends, only: end_step, end_width, end_stride
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_state, only: strip_workspace_t
    implicit none
    private

    public :: end_t, list_ends, wanted, shift_ends, in_order

    !> An end of a patch.
    type :: end_t
        integer :: patch = 0, strip = 0
        integer :: inward = 1 ! 1 at a left end, -1 at a right end
        integer :: stride = 1
        logical :: fixed = .false. ! at the end of the gap's points, or shared by two patches
    end type end_t

contains

    !> The ends of all patches, left and right in turn.
    pure subroutine list_ends(workspace, patches, ends, n_ends)
        type(strip_workspace_t), intent(in) :: workspace !! with strips
        type(patches_t), intent(in) :: patches           !! those of the strips
        type(end_t), intent(inout) :: ends(:)            !! at least two a patch
        integer, intent(out) :: n_ends                   !! how many

        integer :: p, last

        last = 0
        do p = 1, patches%n
            ends(2*p - 1) = end_t(p, last + 1, 1, end_stride(patches%at(p)%n_strips))
            last = last + patches%at(p)%n_strips
            ends(2*p) = end_t(p, last, -1, end_stride(patches%at(p)%n_strips))
            ends(2*p - 1)%fixed = patches%at(p)%y_from <= workspace%curve%y(1)
            ends(2*p)%fixed = patches%at(p)%y_to >= workspace%curve%y(workspace%curve%n)
        end do
        n_ends = 2*patches%n
        do p = 1, n_ends
            if (ends(p)%fixed) ends(p)%fixed = &
                end_step(workspace, ends(p)%strip, ends(p)%inward, ends(p)%stride) >= 0.0_wp
        end do
        do p = 1, patches%n - 1
            if (patches%at(p)%meets_next) ends(2*p:2*p + 1)%fixed = .true.
        end do
    end subroutine list_ends

    !> How far an end should move outwards, in units of `end_width`.
    pure real(wp) function wanted(workspace, one_end)
        type(strip_workspace_t), intent(in) :: workspace !! with strips
        type(end_t), intent(in) :: one_end               !! of one of their patches

        wanted = 0.0_wp
        if (.not. one_end%fixed) &
            wanted = end_step(workspace, one_end%strip, one_end%inward, one_end%stride)
    end function wanted

    !> Move the ends by steps in units of their widths, not beyond the gap's points.
    pure subroutine shift_ends(workspace, ends, scale, step, patches)
        type(strip_workspace_t), intent(in) :: workspace !! with strips
        type(end_t), intent(in) :: ends(:)               !! of all patches
        real(wp), intent(in) :: scale                    !! part of the steps, at most 1
        real(wp), intent(in) :: step(:)                  !! outwards, one an end
        type(patches_t), intent(inout) :: patches        !! moved

        integer :: e
        real(wp) :: outwards

        do e = 1, size(ends)
            if (ends(e)%fixed) cycle
            outwards = scale*step(e)*end_width(workspace, ends(e)%strip, ends(e)%stride)
            associate (patch => patches%at(ends(e)%patch))
                if (ends(e)%inward == 1) then
                    patch%y_from = patch%y_from - outwards
                else
                    patch%y_to = patch%y_to + outwards
                end if
            end associate
        end do
    end subroutine shift_ends

    !> Are the patches apart, of some width and within the gap's points, as they have to be?
    pure logical function in_order(workspace, patches)
        type(strip_workspace_t), intent(in) :: workspace !! with a gap
        type(patches_t), intent(in) :: patches           !! in the order of y

        integer :: p

        in_order = patches%at(1)%y_from >= workspace%curve%y(1) &
                   .and. patches%at(patches%n)%y_to <= workspace%curve%y(workspace%curve%n)
        do p = 1, patches%n
            in_order = in_order .and. patches%at(p)%y_to > patches%at(p)%y_from
        end do
        do p = 2, patches%n
            in_order = in_order .and. (patches%at(p - 1)%meets_next .or. &
                                       patches%at(p)%y_from > patches%at(p - 1)%y_to)
        end do
    end function in_order
end module faststrip_normal_strip_end_unknowns
