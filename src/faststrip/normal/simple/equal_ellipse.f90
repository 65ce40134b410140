!> Nearest ellipses: every patch of a strip solution replaced by an ellipse of its area and load
!> under Hertz's pressure, what vehicle codes do with a patch that is none.
!>
!> Two choices of the proportions a/b, both with the patch's area, centroid and load:
!>
!> - `equal_area`: those of the Hertz contact at the patch's lowest point, from the curvatures
!>   there;
!> - `equal_moments`: those of the patch's second moments, `sqrt(Ix/Iy)`.
!>
!> The pressure is `1.5 Q/(pi a b) sqrt(1 - (x/a)^2 - (y/b)^2)`; the penetration stays that of the
!> strips. The ellipses of neighbouring patches may overlap. They are baselines to compare with:
!> the strips know the patch better.
module faststrip_normal_simple_equal_ellipse
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_geometry_gap_curve, only: gap_curve_t, gap_at, gap_inv2r, gap_curvature
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve, put_hertz_strips
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end, &
                                                     check_strips
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    implicit none
    private

    public :: equal_area, equal_moments, replace_by_ellipses

    ! Given: numbers of kinds.
    integer, parameter :: equal_area = 1    !! proportions of the Hertz contact
    integer, parameter :: equal_moments = 2 !! proportions of the patch's second moments

contains

    !> Replace the patches of a strip solution by ellipses, each cut into as many strips as the
    !> patch had.
    pure subroutine replace_by_ellipses(choice, curve, strips, result, status)
        integer, intent(in) :: choice                   !! `equal_area` or `equal_moments`
        type(gap_curve_t), intent(in) :: curve          !! the gap that was solved, mm
        type(contact_strips_t), intent(inout) :: strips !! a strip solution, then the ellipses
        type(normal_result_t), intent(inout) :: result  !! its figures; area, pmax, extent change
        type(status_t), intent(out) :: status
            !! `st_no_hertz_ellipse` (equal_area: no positive curvatures at a patch's lowest
            !! point), `st_bad_argument` (choice, a patch without load), `st_workspace_too_small`
            !! (no gap set), those of `check_strips`; strips and figures then stay as they were

        type(hertz_t) :: ellipse
        integer :: first, last, pass

        if (choice /= equal_area .and. choice /= equal_moments) then
            call set_status(status, st_bad_argument, 'no such choice of ellipses')
            return
        end if
        if (curve%n == 0) then
            call set_status(status, st_workspace_too_small, 'no gap was set')
            return
        end if
        call check_strips(strips, status)
        ! The first pass only looks whether every patch has its ellipse.
        do pass = 1, 2
            if (is_error(status)) return
            if (pass == 2) then
                result%area = 0.0_wp
                result%pmax = 0.0_wp
                result%x_max = 0.0_wp
            end if
            first = 1
            do while (first <= strips%n)
                last = patch_end(strips, first)
                call find_ellipse(choice, curve, strips, first, last, ellipse, status)
                if (is_error(status)) return
                if (pass == 2) call take_ellipse(ellipse, first, last, strips, result)
                first = last + 1
            end do
        end do
    end subroutine replace_by_ellipses

    !> The ellipse of the patch of strips `first` to `last`.
    pure subroutine find_ellipse(choice, curve, strips, first, last, ellipse, status)
        integer, intent(in) :: choice, first, last
        type(gap_curve_t), intent(in) :: curve
        type(contact_strips_t), intent(in) :: strips
        type(hertz_t), intent(out) :: ellipse
        type(status_t), intent(out) :: status

        type(patch_ellipse_t) :: patch
        type(hertz_t) :: hertz
        real(wp) :: y, ratio

        call clear_status(status)
        patch = patch_ellipse(strips, first, last)
        if (patch%load <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'a patch without load has no ellipse')
            return
        end if
        ratio = patch%a/patch%b
        ellipse%area = pi*patch%a*patch%b
        if (choice == equal_area) then
            y = lowest_point(curve, strips%y_left(first), strips%y_right(last))
            ! The proportions depend on neither compliance nor load.
            call hertz_solve(1.0_wp, gap_inv2r(curve, y), gap_curvature(curve, y), 1.0_wp, &
                             hertz, status)
            if (is_error(status)) return
            ratio = hertz%a/hertz%b
        end if
        ellipse%b = sqrt(ellipse%area/(pi*ratio))
        ellipse%a = ellipse%b*ratio
        ellipse%y = patch%y
        ellipse%load = patch%load
        ellipse%pmax = 1.5_wp*patch%load/ellipse%area ! Given: Hertz
    end subroutine find_ellipse

    pure subroutine take_ellipse(ellipse, first, last, strips, result)
        type(hertz_t), intent(in) :: ellipse
        integer, intent(in) :: first, last
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(inout) :: result

        call put_hertz_strips(ellipse, first, last, strips)
        result%area = result%area + ellipse%area
        result%pmax = max(result%pmax, ellipse%pmax)
        result%x_max = max(result%x_max, ellipse%a)
        if (first == 1) then
            result%y_min = ellipse%y - ellipse%b
            result%y_max = ellipse%y + ellipse%b
        else
            result%y_min = min(result%y_min, ellipse%y - ellipse%b)
            result%y_max = max(result%y_max, ellipse%y + ellipse%b)
        end if
    end subroutine take_ellipse

    !> Where the gap is lowest between two places: the lowest of its points there, or its lowest
    !> place of all.
    pure real(wp) function lowest_point(curve, y_from, y_to) result(y)
        type(gap_curve_t), intent(in) :: curve
        real(wp), intent(in) :: y_from, y_to

        real(wp) :: lowest, h, inv2r
        integer :: i

        y = curve%y_lowest
        if (y >= y_from .and. y <= y_to) return
        y = 0.5_wp*(y_from + y_to)
        call gap_at(curve, y, lowest, inv2r)
        do i = 1, curve%n_pieces + 1
            if (curve%y_node(i) < y_from .or. curve%y_node(i) > y_to) cycle
            h = curve%h_node(i)
            if (h >= lowest) cycle
            lowest = h
            y = curve%y_node(i)
        end do
    end function lowest_point
end module faststrip_normal_simple_equal_ellipse
