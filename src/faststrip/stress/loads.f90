!> Loads on the surface of a half-space, rectangle by rectangle, and the stresses below them.
module faststrip_stress_loads
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits
    use faststrip_base_status, only: status_t, set_status, clear_status, count_text, &
                                     number_text, st_bad_argument
    use faststrip_stress_rectangle, only: corner_stress, edge_core, n_stresses, n_tractions
    implicit none
    private

    public :: loads_t, reserve_loads, put_load, check_points, find_stress, same_row

    !> Rectangles with uniform loads; the caller owns them and their size (`reserve_loads`). The
    !> first `n` count. Rows along x whose elements follow one another are quickest.
    type :: loads_t
        integer :: n = 0                          !! rectangles
        real(wp), allocatable :: x(:), y(:)       !! their middles, mm
        real(wp), allocatable :: dx(:), dy(:)     !! their sides, mm
        real(wp), allocatable :: traction(:, :)
            !! p into the body, qx and qy on it, MPa, a column each
    end type loads_t

contains

    !> Allocate for loads; the only allocation.
    subroutine reserve_loads(loads, capacity, status)
        type(loads_t), intent(inout) :: loads !! emptied and sized
        integer, intent(in) :: capacity       !! largest number of rectangles, >= 1
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        loads%n = 0
        if (capacity < 1) then
            call set_status(status, st_bad_argument, 'capacity for loads must be at least 1, ' &
                            // 'got ' // count_text(capacity))
            return
        end if
        if (allocated(loads%x)) then
            if (size(loads%x) >= capacity) return
            deallocate (loads%x, loads%y, loads%dx, loads%dy, loads%traction)
        end if
        allocate (loads%x(capacity), loads%y(capacity), loads%dx(capacity), loads%dy(capacity), &
                  source=0.0_wp)
        allocate (loads%traction(n_tractions, capacity), source=0.0_wp)
    end subroutine reserve_loads

    !> One more rectangle, for which there is capacity.
    pure subroutine put_load(loads, x, y, dx, dy, traction)
        type(loads_t), intent(inout) :: loads !! gets it
        real(wp), intent(in) :: x, y          !! middle, mm
        real(wp), intent(in) :: dx, dy        !! sides, mm, > 0
        real(wp), intent(in) :: traction(n_tractions) !! p, qx, qy, MPa

        associate (i => loads%n)
            i = i + 1
            loads%x(i) = x
            loads%y(i) = y
            loads%dx(i) = dx
            loads%dy(i) = dy
            loads%traction(:, i) = traction
        end associate
    end subroutine put_load

    !> Refuse places that are no numbers and depths above the surface.
    pure subroutine check_points(x, y, z, status)
        real(wp), intent(in) :: x(:), y(:)    !! places, mm, as many of each as there are
        real(wp), intent(in) :: z(:)          !! depths, mm
        type(status_t), intent(out) :: status !! `st_bad_argument`

        call clear_status(status)
        if (.not. (all(ieee_is_finite(x)) .and. all(ieee_is_finite(y)) &
                   .and. all(ieee_is_finite(z)))) then
            call set_status(status, st_bad_argument, 'x, y and z of points must be finite numbers')
        else if (any(z < 0.0_wp)) then
            call set_status(status, st_bad_argument, 'depths must be 0 or more, got ' // &
                            number_text(minval(z)))
        end if
    end subroutine check_points

    !> Stress at a point, MPa: the sum over the corners of all rectangles. An edge that two of a
    !> row share counts once, with the difference of their loads.
    pure subroutine find_stress(loads, nu, x, y, z, stress, share)
        type(loads_t), intent(in) :: loads   !! any number
        real(wp), intent(in) :: nu           !! Poisson's ratio of the body
        real(wp), intent(in) :: x, y         !! place, mm
        real(wp), intent(in) :: z            !! depth, mm, >= 0
        real(wp), intent(out) :: stress(n_stresses) !! xx, yy, zz, xy, xz, yz, MPa
        real(wp), intent(in), optional :: share(n_tractions) !! of p, qx and qy; default 1

        real(wp), dimension(n_tractions) :: before, part
        real(wp) :: along
        integer :: i
        logical :: goes_on

        part = 1.0_wp
        if (present(share)) part = share
        stress = 0.0_wp
        along = direction(loads)
        goes_on = .false.
        do i = 1, loads%n
            associate (here => loads%x(i), half => 0.5_wp*along*loads%dx(i), &
                       load => loads%traction(:, i))
                before = 0.0_wp
                if (goes_on) before = loads%traction(:, i - 1)
                call add_edge(loads, i, nu, here - half - x, along*part*(load - before), &
                              y, z, stress)
                goes_on = .false.
                if (i < loads%n) goes_on = same_row(loads, i, along)
                if (.not. goes_on) call add_edge(loads, i, nu, here + half - x, &
                                                  -along*part*load, y, z, stress)
            end associate
        end do
    end subroutine find_stress

    !> Add the stress by loads on the quarter planes that begin at an edge of a rectangle: that at
    !> its lower end less that at the upper one.
    pure subroutine add_edge(loads, i, nu, ahead, load, y, z, stress)
        type(loads_t), intent(in) :: loads
        integer, intent(in) :: i            ! the rectangle
        real(wp), intent(in) :: nu, ahead   ! edge less point along x, mm
        real(wp), intent(in) :: load(n_tractions), y, z
        real(wp), intent(inout) :: stress(n_stresses)

        real(wp), dimension(n_stresses, n_tractions) :: lower, upper
        real(wp) :: core, half
        integer :: k

        core = edge_core(loads%dx(i), loads%dy(i))
        half = 0.5_wp*loads%dy(i)
        call corner_stress(-ahead, y - loads%y(i) + half, z, core, nu, lower)
        call corner_stress(-ahead, y - loads%y(i) - half, z, core, nu, upper)
        do k = 1, n_tractions
            stress = stress + load(k)*(lower(:, k) - upper(:, k))
        end do
    end subroutine add_edge

    !> Does the next rectangle go on where one ends?
    pure logical function same_row(loads, i, along)
        type(loads_t), intent(in) :: loads !! more than `i`
        integer, intent(in) :: i           !! the one
        real(wp), intent(in) :: along      !! 1 or -1: which way along x

        associate (dx => loads%dx, dy => loads%dy, y => loads%y)
            same_row = abs(loads%x(i + 1) - loads%x(i) - 0.5_wp*along*(dx(i) + dx(i + 1))) &
                       <= half_digits*dx(i) &
                       .and. abs(y(i + 1) - y(i)) + abs(dy(i + 1) - dy(i)) <= half_digits*dy(i)
        end associate
    end function same_row

    !> Which way along x the elements of the rows follow one another.
    pure real(wp) function direction(loads)
        type(loads_t), intent(in) :: loads

        integer :: i

        direction = 1.0_wp
        do i = 1, loads%n - 1
            if (same_row(loads, i, 1.0_wp)) return
            if (.not. same_row(loads, i, -1.0_wp)) cycle
            direction = -1.0_wp
            return
        end do
    end function direction
end module faststrip_stress_loads
