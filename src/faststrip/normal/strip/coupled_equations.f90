!> The equations of strips and patch ends together, and their Jacobian: those of
!> `faststrip_normal_strip_equations` and one for each end that is free.
!>
!> Ends move outwards in units of their end strip's width (`end_width`); the equation of each is
!> that of `end_step`: the squared strip length, extrapolated, vanishes at the end.
module faststrip_normal_strip_coupled_equations
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_lu, only: lu_factor
    use faststrip_normal_strip_linearised, only: linear_residual, linear_jacobian
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_ends, only: end_step, end_width
    use faststrip_normal_strip_state, only: strip_workspace_t, position_edges
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: end_t, list_ends, shift_ends, in_order, coupled_residual, coupled_factors

    ! Tuned [strip widths]. Origin: half the digits of what is below tolerance.
    real(wp), parameter :: difference = 1.0e-3_wp ! of the ends, in widths
    ! Tuned [1]: Of a length, for its derivative. Origin: half the digits.
    real(wp), parameter :: length_difference = 1.0e-6_wp

    !> An end of a patch.
    type :: end_t
        integer :: patch = 0, strip = 0
        integer :: inward = 1 ! 1 at a left end, -1 at a right end
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
            ends(2*p - 1) = end_t(p, last + 1, 1)
            last = last + patches%at(p)%n_strips
            ends(2*p) = end_t(p, last, -1)
            ends(2*p - 1)%fixed = patches%at(p)%y_from <= workspace%curve%y(1)
            ends(2*p)%fixed = patches%at(p)%y_to >= workspace%curve%y(workspace%curve%n)
        end do
        n_ends = 2*patches%n
        do p = 1, n_ends
            if (ends(p)%fixed) ends(p)%fixed = &
                end_step(workspace, ends(p)%strip, ends(p)%inward) >= 0.0_wp
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
        if (.not. one_end%fixed) wanted = end_step(workspace, one_end%strip, one_end%inward)
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
            outwards = scale*step(e)*end_width(workspace, ends(e)%strip)
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

    !> Residuals of all equations for the strips where they are.
    pure subroutine coupled_residual(workspace, compliance, demand, ends, residual)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance             !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand           !! load or penetration
        type(end_t), intent(in) :: ends(:)             !! of all patches
        real(wp), intent(inout), contiguous :: residual(:) !! (2n + 1 + size(ends))

        integer :: e

        call linear_residual(workspace%linear, workspace%strips, compliance, demand, residual)
        do e = 1, size(ends)
            residual(2*workspace%strips%n + 1 + e) = wanted(workspace, ends(e))
        end do
    end subroutine coupled_residual

    !> Residuals, into the step of the workspace, and the factored Jacobian, analytic for given
    !> edges; the columns of the ends are differences of residuals.
    pure subroutine coupled_factors(workspace, compliance, demand, patches, ends, p_scale, &
                                    singular)
        type(strip_workspace_t), intent(inout) :: workspace !! with strips, started
        real(wp), intent(in) :: compliance   !! H of eq. (4), 1/MPa
        type(demand_t), intent(in) :: demand !! load or penetration
        type(patches_t), intent(in) :: patches !! whose strips these are
        type(end_t), intent(in) :: ends(:)   !! of all patches
        real(wp), intent(in) :: p_scale      !! unit of the pressures' changes, MPa
        logical, intent(out) :: singular     !! is the Jacobian?

        type(patches_t) :: moved
        integer :: e, j, k, m, n
        real(wp) :: kept_length, away

        n = workspace%strips%n
        m = 2*n + 1 + size(ends)
        associate (jacobian => workspace%newton%jacobian, residual => workspace%newton%step, &
                   other => workspace%newton%other(:, 1))
            call linear_jacobian(workspace%linear, workspace%strips, compliance, demand, &
                                 p_scale, jacobian, residual)
            jacobian(2*n + 2:m, :m) = 0.0_wp
            do e = 1, size(ends)
                residual(2*n + 1 + e) = wanted(workspace, ends(e))
                jacobian(:m, 2*n + 1 + e) = 0.0_wp
                if (ends(e)%fixed) then
                    jacobian(2*n + 1 + e, 2*n + 1 + e) = 1.0_wp
                    cycle
                end if
                do j = 0, 2
                    k = ends(e)%strip + j*ends(e)%inward
                    kept_length = workspace%strips%half_length(k)
                    workspace%strips%half_length(k) = kept_length*(1.0_wp + length_difference)
                    jacobian(2*n + 1 + e, n + k) = &
                        (residual(2*n + 1 + e) - wanted(workspace, ends(e)))/length_difference
                    workspace%strips%half_length(k) = kept_length
                end do
            end do
            do e = 1, size(ends)
                if (ends(e)%fixed) cycle
                moved = patches
                ! Inwards, where the gap has points.
                away = difference*end_width(workspace, ends(e)%strip)
                if (ends(e)%inward == 1) then
                    moved%at(ends(e)%patch)%y_from = moved%at(ends(e)%patch)%y_from + away
                else
                    moved%at(ends(e)%patch)%y_to = moved%at(ends(e)%patch)%y_to - away
                end if
                call position_edges(workspace, moved)
                call linear_residual(workspace%linear, workspace%strips, compliance, demand, &
                                     other)
                jacobian(:2*n + 1, 2*n + 1 + e) = (other(:2*n + 1) - residual(:2*n + 1))/difference
                call position_edges(workspace, patches)
            end do
            call lu_factor(m, jacobian, workspace%newton%pivot, singular)
        end associate
    end subroutine coupled_factors
end module faststrip_normal_strip_coupled_equations
