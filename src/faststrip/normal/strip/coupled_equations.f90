!> The equations of strips and patch ends together, and their Jacobian: those of
!> `faststrip_normal_strip_equations` and, for each end that is free, that of
!> `faststrip_normal_strip_end_unknowns`.
module faststrip_normal_strip_coupled_equations
    use faststrip_base_kinds, only: wp
    use faststrip_numerics_lu, only: lu_factor
    use faststrip_normal_strip_linearised, only: linear_residual, linear_jacobian
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_ends, only: end_width
    use faststrip_normal_strip_end_unknowns, only: end_t, wanted
    use faststrip_normal_strip_state, only: strip_workspace_t, position_edges
    use faststrip_normal_types, only: demand_t
    implicit none
    private

    public :: coupled_residual, coupled_factors

    ! Tuned [strip widths]. Origin: half the digits of what is below tolerance.
    real(wp), parameter :: difference = 1.0e-3_wp ! of the ends, in widths
    ! Tuned [1]: Of a length, for its derivative. Origin: half the digits.
    real(wp), parameter :: length_difference = 1.0e-6_wp

contains

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
                    k = ends(e)%strip + j*ends(e)%stride*ends(e)%inward
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
                away = difference*end_width(workspace, ends(e)%strip, ends(e)%stride)
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
