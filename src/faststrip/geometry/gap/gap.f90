!> The undeformed gap of a contact: what the profiles hand to the normal solution.
module faststrip_geometry_gap
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, count_text, &
                                     st_bad_argument, st_not_finite, st_not_increasing, &
                                     st_too_few_points
    implicit none
    private

    public :: gap_t, check_gap, check_gap_points, min_gap_points

    !> Fewest points that describe a gap.
    !> Given: cubic splines without knots at the second and last but one need four; a parabola in
    !> between one more.
    integer, parameter :: min_gap_points = 5

    !> Distance of wheel and rail along the common normal before any load,
    !> `h(x, y) = h(y) + x**2 inv2r(y)`; y = 0 is the rigid contact point.
    type :: gap_t
        real(wp), allocatable :: y(:)     !! lateral coordinate, strictly increasing, mm
        real(wp), allocatable :: h(:)     !! gap on the line x = 0, mm
        real(wp), allocatable :: inv2r(:) !! 1/(2 R), R the local radius along x, 1/mm
        real(wp), allocatable :: inclination(:) !! how far the surfaces have turned from the tangent
                                          !! plane at y = 0, rad; not allocated: not known
    end type gap_t

contains

    !> Refuse a gap no solver can work on: missing or unequal arrays, fewer than
    !> `min_gap_points` points, numbers that are not finite, y that does not increase strictly.
    !> The message names the index and the value. `h` may have any sign, and `inv2r` too: what is
    !> not positive matters only where the bodies touch, and the solvers say so there.
    pure subroutine check_gap(gap, status)
        type(gap_t), intent(in) :: gap        !! mm, mm, 1/mm
        type(status_t), intent(out) :: status !! `st_bad_argument`, `st_too_few_points`,
                                              !! `st_not_finite`, `st_not_increasing`

        call clear_status(status)
        if (.not. (allocated(gap%y) .and. allocated(gap%h) .and. allocated(gap%inv2r))) then
            call set_status(status, st_bad_argument, 'the gap must have y, h and inv2r')
            return
        end if
        ! What is not allocated counts as an argument that is not present.
        call check_gap_points(gap%y, gap%h, gap%inv2r, status, gap%inclination)
    end subroutine check_gap

    !> The same for a gap in plain arrays.
    pure subroutine check_gap_points(y, h, inv2r, status, inclination)
        real(wp), intent(in) :: y(:)          !! lateral coordinate, mm
        real(wp), intent(in) :: h(:)          !! gap on the line x = 0, mm
        real(wp), intent(in) :: inv2r(:)      !! 1/(2 R), 1/mm
        type(status_t), intent(out) :: status !! as `check_gap`
        real(wp), intent(in), optional :: inclination(:) !! of the surfaces from y = 0 on, rad

        integer :: i, n
        logical :: is_good

        call clear_status(status)
        n = size(y)
        if (present(inclination)) then
            if (size(inclination) /= n) then
                call set_status(status, st_bad_argument, &
                                'y and inclination of the gap must have one length, got ' // &
                                trim(count_text(n)) // ', ' // trim(count_text(size(inclination))))
                return
            end if
        end if
        if (size(h) /= n .or. size(inv2r) /= n) then
            call set_status(status, st_bad_argument, &
                            'y, h and inv2r of the gap must have one length, got ' // &
                            trim(count_text(n)) // ', ' // trim(count_text(size(h))) // ', ' // &
                            trim(count_text(size(inv2r))))
            return
        end if
        if (n < min_gap_points) then
            call set_status(status, st_too_few_points, 'the gap must have at least ' // &
                            trim(count_text(min_gap_points)) // ' points, got ' // &
                            trim(count_text(n)))
            return
        end if
        is_good = are_finite(y) .and. are_finite(h) .and. are_finite(inv2r)
        if (is_good) is_good = count(y(2:) <= y(:n - 1)) == 0
        do i = 1, merge(0, n, is_good)
            call check_finite('y', i, y(i), status)
            if (status%code == 0) call check_finite('h', i, h(i), status)
            if (status%code == 0) call check_finite('inv2r', i, inv2r(i), status)
            if (status%code == 0) call check_order(y, i, status)
            if (status%code /= 0) return
        end do
        if (.not. present(inclination)) return
        if (are_finite(inclination)) return
        do i = 1, n
            call check_finite('inclination', i, inclination(i), status)
            if (status%code /= 0) return
        end do
    end subroutine check_gap_points

    !> Are all of them numbers? Without a stop at the first that is none, several at a time.
    pure logical function are_finite(values)
        real(wp), intent(in) :: values(:)

        are_finite = count(.not. ieee_is_finite(values)) == 0
    end function are_finite

    pure subroutine check_order(y, i, status)
        real(wp), intent(in) :: y(:)
        integer, intent(in) :: i
        type(status_t), intent(inout) :: status

        if (i == 1) return
        if (y(i) <= y(i - 1)) &
            call set_status(status, st_not_increasing, 'y(' // trim(count_text(i)) // &
                            ') of the gap must be above the one before, got ' // &
                            trim(number_text(y(i))))
    end subroutine check_order

    pure subroutine check_finite(name, i, value, status)
        character(len=*), intent(in) :: name
        integer, intent(in) :: i
        real(wp), intent(in) :: value
        type(status_t), intent(inout) :: status

        if (.not. ieee_is_finite(value)) then
            call set_status(status, st_not_finite, name // '(' // trim(count_text(i)) // &
                            ') of the gap must be a finite number, got ' // &
                            trim(number_text(value)))
        end if
    end subroutine check_finite
end module faststrip_geometry_gap
