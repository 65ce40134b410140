!> What the next solution by strips depends on of those before, as bytes.
module faststrip_normal_strip_memory
    use faststrip_normal_strip_linearised, only: linearised_t
    use faststrip_normal_strip_patches, only: patch_t, max_patches
    use faststrip_normal_strip_state, only: strip_workspace_t, newton_workspace_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_numerics_byte_stream, only: byte_stream_t, exchange, exchange_count
    implicit none
    private

    public :: exchange_solver, exchange_strips

contains

    !> The memory of a solver: patches, strips, coefficients and factors that the next one may start
    !> from. Its gap is not: one is set before each solution.
    subroutine exchange_solver(stream, solver)
        type(byte_stream_t), intent(inout) :: stream     !! goes on
        type(strip_workspace_t), intent(inout) :: solver !! reserved

        integer :: p, n

        call exchange_count(stream, solver%old%n, max_patches)
        do p = 1, solver%old%n
            call exchange_patch(stream, solver%old%at(p))
        end do
        n = sum(solver%old%at(:solver%old%n)%n_strips)
        call exchange_count(stream, n, solver%max_strips)
        if (.not. stream%fits .or. solver%old%n == 0) return
        call exchange(stream, solver%old_load)
        call exchange(stream, solver%old_penetration)
        call exchange(stream, solver%old_correction)
        call exchange(stream, solver%old_is_mirrored)
        call exchange(stream, solver%old_is_even)
        call exchange(stream, solver%old_inv2r)
        call exchange(stream, solver%old_eta(:n))
        call exchange(stream, solver%old_p0(:n))
        call exchange(stream, solver%old_half_length(:n))
        call exchange(stream, solver%graded)
        call exchange(stream, solver%n_graded)
        call exchange(stream, solver%edge(:n))
        call exchange_factors(stream, solver%newton)
        call exchange_linearised(stream, solver%linear)
    end subroutine exchange_solver

    subroutine exchange_patch(stream, patch)
        type(byte_stream_t), intent(inout) :: stream
        type(patch_t), intent(inout) :: patch

        call exchange(stream, patch%y_from)
        call exchange(stream, patch%y_to)
        call exchange(stream, patch%n_strips)
        call exchange(stream, patch%seed_length)
        call exchange(stream, patch%seed_pressure)
        call exchange(stream, patch%seed_level)
        call exchange(stream, patch%too_far_from)
        call exchange(stream, patch%too_far_to)
        call exchange(stream, patch%meets_next)
    end subroutine exchange_patch

    subroutine exchange_factors(stream, newton)
        type(byte_stream_t), intent(inout) :: stream
        type(newton_workspace_t), intent(inout) :: newton

        integer :: n

        call exchange(stream, newton%kept)
        if (.not. newton%kept) return
        call exchange(stream, newton%by_load)
        call exchange_count(stream, newton%n_patches, max_patches)
        call exchange(stream, newton%fixed(:2*newton%n_patches))
        call exchange(stream, newton%n_strips(:newton%n_patches))
        n = 2*(sum(newton%n_strips(:newton%n_patches)) + newton%n_patches) + 1
        call exchange_count(stream, n, size(newton%pivot))
        call exchange(stream, newton%jacobian(:n, :n))
        call exchange(stream, newton%pivot(:n))
    end subroutine exchange_factors

    subroutine exchange_linearised(stream, linear)
        type(byte_stream_t), intent(inout) :: stream
        type(linearised_t), intent(inout) :: linear

        integer :: first, last, p

        call exchange(stream, linear%known)
        if (.not. linear%known) return
        call exchange_count(stream, linear%n, linear%most)
        call exchange_count(stream, linear%n_patches, max_patches)
        call exchange(stream, linear%n_strips(:linear%n_patches))
        call exchange(stream, linear%width(:linear%n_patches))
        associate (n => linear%n)
            call exchange(stream, linear%half_length(:n))
            call exchange(stream, linear%y(:n))
            call exchange(stream, linear%center(:n, :n))
            call exchange(stream, linear%center_l(:n, :n))
            call exchange(stream, linear%tip(:n, :n))
            call exchange(stream, linear%tip_l(:n, :n))
            call exchange(stream, linear%tip_x(:n, :n))
            ! Numbers of other patches.
            last = 0
            do p = 1, linear%n_patches
                first = last + 1
                last = min(last + max(linear%n_strips(p), 0), n)
                call exchange(stream, linear%center_y(:first - 1, first:last))
                call exchange(stream, linear%center_y(last + 1:n, first:last))
                call exchange(stream, linear%tip_y(:first - 1, first:last))
                call exchange(stream, linear%tip_y(last + 1:n, first:last))
            end do
        end associate
    end subroutine exchange_linearised

    !> Strips of a solution.
    subroutine exchange_strips(stream, strips)
        type(byte_stream_t), intent(inout) :: stream    !! goes on
        type(contact_strips_t), intent(inout) :: strips !! reserved, unless there are none

        if (.not. allocated(strips%p0)) return
        call exchange_count(stream, strips%n, size(strips%p0))
        call exchange(stream, strips%n_patches)
        call exchange(stream, strips%is_curved)
        call exchange(stream, strips%pitch)
        call exchange(stream, strips%follow_outline)
        call exchange(stream, strips%has_places)
        associate (n => strips%n)
            call exchange(stream, strips%y_left(:n))
            call exchange(stream, strips%y_right(:n))
            call exchange(stream, strips%half_length(:n))
            call exchange(stream, strips%p0(:n))
            call exchange(stream, strips%patch(:n))
            call exchange(stream, strips%inclination(:n))
            call exchange(stream, strips%depth(:n))
            call exchange(stream, strips%x0(:n))
        end associate
    end subroutine exchange_strips
end module faststrip_normal_strip_memory
