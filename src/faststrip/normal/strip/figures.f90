!> What a strip solution hands over: the strips of a converged pass, and their figures.
module faststrip_normal_strip_figures
    use faststrip_base_kinds, only: wp
    use faststrip_normal_patch_curves, only: curve_integral, curve_peak
    use faststrip_normal_strip_patches, only: patches_t, pass_strips_t
    use faststrip_normal_strips, only: contact_strips_t, strips_load
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: hand_over, summarize, correction_of

    ! Tuned [1]: what strips miss of the penetration, over the mean square of their widths in that
    ! of their patch. Origin: medians of .085 to .1 with 7 to 31 strips on the contacts by which
    ! strips are graded and on others; .067 to .14 of Hertz ellipses with a/b from .2 to 4.5.
    real(wp), parameter :: missed = 0.09_wp

contains

    !> Hand a converged pass over as strips; patches that share an end are one there.
    pure subroutine hand_over(found, patches, strips)
        type(pass_strips_t), intent(in) :: found        !! the strips of the pass
        type(patches_t), intent(in) :: patches          !! that they fill
        type(contact_strips_t), intent(inout) :: strips !! with capacity enough

        integer :: p, n, last
        logical :: goes_on

        n = found%n
        strips%n = n
        strips%n_patches = 0
        goes_on = .false.
        strips%y_left(:n) = found%y_left(:n)
        strips%y_right(:n) = found%y_right(:n)
        strips%p0(:n) = found%p0(:n)
        strips%half_length(:n) = found%half_length(:n)
        last = 0
        do p = 1, patches%n
            if (.not. goes_on) strips%n_patches = strips%n_patches + 1
            goes_on = patches%at(p)%meets_next
            strips%patch(last + 1:last + patches%at(p)%n_strips) = strips%n_patches
            last = last + patches%at(p)%n_strips
        end do
    end subroutine hand_over

    !> The penetration above the lowest height, over that with which the strips close the gap.
    !>
    !> Strips miss a part that goes with the square of their widths, nearly the same in all contacts
    !> without edges. It depends on the edges alone, so that load and penetration given belong
    !> together. Strips that share an edge are in one patch.
    pure real(wp) function correction_of(y_left, y_right) result(correction)
        real(wp), intent(in) :: y_left(:)  !! left edges of all strips, in the order of y, mm
        real(wp), intent(in) :: y_right(:) !! right edges, mm

        real(wp) :: cubes, squares, width
        integer :: first, last

        squares = 0.0_wp
        width = 0.0_wp
        last = 0
        do while (last < size(y_left))
            first = last + 1
            last = first
            do while (last < size(y_left))
                if (y_left(last + 1) > y_right(last)) exit
                last = last + 1
            end do
            cubes = sum(((y_right(first:last) - y_left(first:last)) &
                         /(y_right(last) - y_left(first)))**3)
            squares = squares + (y_right(last) - y_left(first))*cubes
            width = width + (y_right(last) - y_left(first))
        end do
        correction = 1.0_wp + missed*squares/width
    end function correction_of

    !> The figures of a solution.
    pure subroutine summarize(strips, penetration, correction, result)
        type(contact_strips_t), intent(in) :: strips !! of the solution
        real(wp), intent(in) :: penetration !! from h = 0, mm
        real(wp), intent(in) :: correction  !! that is in it, see `correction_of`
        type(normal_result_t), intent(inout) :: result !! all but what it cost

        integer :: p, first, last

        result%load = strips_load(strips)
        result%penetration = penetration
        result%correction = correction
        result%area = 0.0_wp
        result%pmax = 0.0_wp
        result%x_max = 0.0_wp
        result%strips_across = 0
        last = 0
        do p = 1, strips%n_patches
            first = last + 1
            last = last + count(strips%patch(:strips%n) == p)
            result%strips_across = max(result%strips_across, last - first + 1)
            associate (left => strips%y_left(first:last), right => strips%y_right(first:last), &
                       half_length => strips%half_length(first:last))
                result%area = result%area + 2.0_wp*curve_integral(left, right, half_length)
                result%pmax = max(result%pmax, curve_peak(left, right, strips%p0(first:last)))
                result%x_max = max(result%x_max, curve_peak(left, right, half_length))
            end associate
        end do
        result%y_min = strips%y_left(1)
        result%y_max = strips%y_right(strips%n)
        result%n_patches = strips%n_patches
    end subroutine summarize
end module faststrip_normal_strip_figures
