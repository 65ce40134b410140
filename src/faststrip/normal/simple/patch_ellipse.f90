!> The virtual ellipse of a contact patch that is none.
module faststrip_normal_simple_patch_ellipse
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: largest_ratio, nothing
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    implicit none
    private

    public :: patch_ellipse_t, patch_ellipse, patch_end, check_strips

    !> The ellipse of a patch's area and second moments, about the patch's centroid.
    type :: patch_ellipse_t
        real(wp) :: a = 0.0_wp    !! semi-axis along x, mm
        real(wp) :: b = 0.0_wp    !! semi-axis along y, mm
        real(wp) :: y = 0.0_wp    !! centroid, mm from the contact reference point
        real(wp) :: load = 0.0_wp !! load of the patch, N; zero: nothing to solve
    end type patch_ellipse_t

    ! Strips are refused beyond this.
    ! Tuned [mm, MPa]. Origin: safeguard: loads and moduli in other units do not pass for a contact.
    real(wp), parameter :: largest = 1.0e9_wp

contains

    !> Refuse strips that no normal solution can have given.
    pure subroutine check_strips(strips, status)
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (no strips; negative width, length or pressure), `st_not_finite`,
            !! `st_out_of_range` (above 1e9 mm or MPa)

        integer :: i

        call clear_status(status)
        if (strips%n < 1 .or. .not. allocated(strips%p0)) then
            call set_status(status, st_bad_argument, 'a contact without strips')
            return
        end if
        do i = 1, strips%n
            if (.not. (ieee_is_finite(strips%y_left(i)) .and. ieee_is_finite(strips%y_right(i)) &
                       .and. ieee_is_finite(strips%half_length(i)) &
                       .and. ieee_is_finite(strips%p0(i)))) then
                call set_status(status, st_not_finite, 'a strip that is not finite')
                return
            end if
            if (max(abs(strips%y_left(i)), abs(strips%y_right(i)), strips%half_length(i), &
                    strips%p0(i)) > largest) then
                call set_status(status, st_out_of_range, 'a strip beyond all proportion at y = ' &
                                // trim(number_text(strips%y_left(i))) // ' mm')
                return
            end if
            if (strips%y_right(i) < strips%y_left(i) .or. strips%half_length(i) < 0.0_wp &
                .or. strips%p0(i) < 0.0_wp) then
                call set_status(status, st_bad_argument, 'a strip of negative width, length or ' &
                                // 'pressure at y = ' // trim(number_text(strips%y_left(i))) &
                                // ' mm')
                return
            end if
        end do
    end subroutine check_strips

    !> The last strip of the patch that begins with strip `first`.
    pure integer function patch_end(strips, first) result(last)
        type(contact_strips_t), intent(in) :: strips !! checked strips
        integer, intent(in) :: first                 !! 1 to n

        last = first
        do while (last < strips%n)
            if (strips%patch(last + 1) /= strips%patch(first)) exit
            last = last + 1
        end do
    end function patch_end

    !> The ellipse with the area `pi a b` of strips `first` to `last` and their proportion
    !> `a/b = sqrt(Ix/Iy)`, `Ix = int x^2 dA`, `Iy = int (y - yc)^2 dA`: exact on an
    !> ellipse. Strips may count in part.
    pure type(patch_ellipse_t) function patch_ellipse(strips, first, last, share) result(ellipse)
        type(contact_strips_t), intent(in) :: strips !! checked strips
        integer, intent(in) :: first                 !! first strip of the patch
        integer, intent(in) :: last                  !! last strip of the patch
        real(wp), intent(in), optional :: share(first:) !! what of each strip counts, 0 to 1

        real(wp) :: area, moment_x, moment_y, w, counted, y, ratio
        integer :: i

        area = 0.0_wp
        do i = first, last
            counted = strips%y_right(i) - strips%y_left(i)
            if (present(share)) counted = share(i)*counted
            y = 0.5_wp*(strips%y_left(i) + strips%y_right(i))
            area = area + 2.0_wp*strips%half_length(i)*counted
            ellipse%y = ellipse%y + 2.0_wp*strips%half_length(i)*counted*y
            ellipse%load = ellipse%load + strip_load(strips%p0(i), strips%half_length(i), counted)
        end do
        if (area <= nothing .or. ellipse%load <= nothing) then
            ellipse = patch_ellipse_t()
            return
        end if
        ellipse%y = ellipse%y/area
        moment_x = 0.0_wp
        moment_y = 0.0_wp
        do i = first, last
            w = strips%y_right(i) - strips%y_left(i)
            counted = w
            if (present(share)) counted = share(i)*w
            y = 0.5_wp*(strips%y_left(i) + strips%y_right(i)) - ellipse%y
            moment_x = moment_x + 2.0_wp/3.0_wp*strips%half_length(i)**3*counted
            ! Given: moment of a width
            moment_y = moment_y + 2.0_wp*strips%half_length(i)*counted*(y*y + w*w/12.0_wp)
        end do
        ! Not beyond needles; products instead of a quotient of moments, which may both be zero.
        if (moment_x >= largest_ratio**2*moment_y) then
            ratio = largest_ratio
        else if (moment_y >= largest_ratio**2*moment_x) then
            ratio = 1.0_wp/largest_ratio
        else
            ratio = sqrt(moment_x/moment_y)
        end if
        ellipse%b = sqrt(area/(pi*ratio))
        ellipse%a = ellipse%b*ratio
    end function patch_ellipse
end module faststrip_normal_simple_patch_ellipse
