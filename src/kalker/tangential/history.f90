!> What TANG takes over from the step before: the pressures and tractions the bodies were under.
!>
!> Bodies that are loaded and shifted step by step keep tractions where nothing slides. The slip of
!> a step is `s = w + u - u'`: the shift, and what the displacement difference changes by. u' is
!> made of the pressures and tractions before, wherever it is wanted: an element that comes into
!> contact was displaced already, by those beside it.
!>
!> A step is taken at once. Where the contact grows its borders should not pass more than an element
!> or two: in Spence's contact the error falls as the square of the step, down to about an element,
!> where that of the grid is larger.
!>
!> Steps stand on one lattice of elements, but may each have a part of it of their own.
module faststrip_kalker_tangential_history
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio, largest_size
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_not_finite, st_out_of_range
    use faststrip_kalker_grid, only: contact_grid_t
    implicit none
    private

    public :: tang_history_t, size_history, check_history, enclose_history, place_history

    !> Pressures and tractions at the end of a step; owned by the caller. Without arrays there was
    !> no step before: bodies that touch for the first time.
    type :: tang_history_t
        integer :: nx = 0              !! elements along x
        integer :: ny = 0              !! elements along y
        real(wp) :: dx = 0.0_wp        !! side along x, mm
        real(wp) :: dy = 0.0_wp        !! side along y, mm
        real(wp) :: x_first = 0.0_wp   !! middle of the first element, mm
        real(wp) :: y_first = 0.0_wp   !! middle of the first element, mm
        real(wp), allocatable :: pressure(:, :) !! MPa, shape (nx, ny)
        real(wp), allocatable :: px(:, :), py(:, :) !! tractions on the rail, MPa, shape (nx, ny)
    end type tang_history_t

    ! Tuned [elements]: How far from a middle of the grid a middle of the step before may be.
    ! Origin: safeguard: places of seven digits pass.
    real(wp), parameter :: off_lattice = 1.0e-6_wp

contains

    !> Put a history where a grid is; what it held is lost.
    subroutine size_history(history, grid)
        type(tang_history_t), intent(inout) :: history !! arrays of zeros
        type(contact_grid_t), intent(in) :: grid       !! with its elements positioned

        if (allocated(history%pressure)) then
            if (any(shape(history%pressure) /= [grid%nx, grid%ny])) &
                deallocate (history%pressure, history%px, history%py)
        end if
        if (.not. allocated(history%pressure)) &
            allocate (history%pressure(grid%nx, grid%ny), history%px(grid%nx, grid%ny), &
                      history%py(grid%nx, grid%ny))
        history%nx = grid%nx
        history%ny = grid%ny
        history%dx = grid%dx
        history%dy = grid%dy
        history%x_first = grid%x_first
        history%y_first = grid%y_first
        history%pressure = 0.0_wp
        history%px = 0.0_wp
        history%py = 0.0_wp
    end subroutine size_history

    !> Is a history one of this grid's lattice?
    subroutine check_history(history, grid, status)
        type(tang_history_t), intent(in) :: history !! any
        type(contact_grid_t), intent(in) :: grid    !! checked
        type(status_t), intent(out) :: status       !! `st_bad_argument`, `st_not_finite`,
                                                    !! `st_out_of_range`
        real(wp) :: ends(4)

        call clear_status(status)
        if (.not. allocated(history%pressure) .and. history%nx == 0) return
        if (.not. (allocated(history%pressure) .and. allocated(history%px) &
                   .and. allocated(history%py))) then
            call set_status(status, st_bad_argument, 'a step before without pressures or tractions')
            return
        else if (any([shape(history%pressure), shape(history%px), shape(history%py)] &
                     /= [history%nx, history%ny, history%nx, history%ny, history%nx, history%ny])) &
            then
            call set_status(status, st_bad_argument, &
                            'pressures or tractions of another shape than the step before')
            return
        end if
        ends = [history%x_first - grid%x_first, history%y_first - grid%y_first, &
                history%x_first - grid%x_first + (history%nx - 1)*history%dx, &
                history%y_first - grid%y_first + (history%ny - 1)*history%dy]
        ends(1::2) = ends(1::2)/grid%dx
        ends(2::2) = ends(2::2)/grid%dy
        if (.not. (all(ieee_is_finite(ends)) .and. all(ieee_is_finite(history%pressure)) .and. &
                   all(ieee_is_finite(history%px)) .and. all(ieee_is_finite(history%py)))) then
            call set_status(status, st_not_finite, &
                            'a place, a pressure or a traction of the step before is not finite')
        else if (any(abs(ends) > largest_ratio)) then
            call set_status(status, st_out_of_range, 'the step before is beyond all proportion')
        else if (any(abs(ends - anint(ends)) > off_lattice) .or. &
                 any(nint(ends(3:) - ends(:2)) /= [history%nx, history%ny] - 1)) then
            call set_status(status, st_bad_argument, &
                            'the step before must have its elements on the lattice of the grid')
        else if (any(history%pressure < 0.0_wp)) then
            call set_status(status, st_bad_argument, 'a pressure of the step before is negative')
        else if (max(maxval(history%pressure), maxval(abs(history%px)), &
                     maxval(abs(history%py))) > largest_size) then
            call set_status(status, st_out_of_range, &
                            'a pressure or a traction of the step before is above 1e30 MPa')
        end if
    end subroutine check_history

    !> Where the history's first element would be in the grid, less one.
    pure function place_history(history, grid) result(place)
        type(tang_history_t), intent(in) :: history !! checked
        type(contact_grid_t), intent(in) :: grid    !! checked
        integer :: place(2)

        place = nint([(history%x_first - grid%x_first)/grid%dx, &
                      (history%y_first - grid%y_first)/grid%dy])
    end function place_history

    !> Widen a box of the grid's elements, so that all loaded ones of the history are in it.
    pure subroutine enclose_history(history, grid, first, last, before)
        type(tang_history_t), intent(in) :: history !! checked
        type(contact_grid_t), intent(in) :: grid    !! checked
        integer, intent(inout) :: first(2), last(2) !! column and row; beyond the grid's, if so
        integer, intent(out) :: before(2)           !! where the history's first would be in the
                                                    !! box, less one
        integer :: place(2), i, j

        before = 0
        if (.not. allocated(history%pressure)) return
        place = place_history(history, grid)
        do j = 1, history%ny
            do i = 1, history%nx
                if (all(abs([history%pressure(i, j), history%px(i, j), history%py(i, j)]) &
                        <= 0.0_wp)) cycle
                first = min(first, place + [i, j])
                last = max(last, place + [i, j])
            end do
        end do
        before = place - first + 1
    end subroutine enclose_history
end module faststrip_kalker_tangential_history
