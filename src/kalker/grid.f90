!> The potential contact area: a grid of equal rectangles that holds the patches.
module faststrip_kalker_grid
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits
    implicit none
    private

    public :: contact_grid_t, size_grid, element_x, element_y, take_pressures, count_patches

    !> Elements in columns along x, rows along y; their middles are `x_first + (i - 1) dx`,
    !> `y_first + (j - 1) dy`. An element is in contact if its pressure is positive.
    type :: contact_grid_t
        integer :: nx = 0              !! elements along x
        integer :: ny = 0              !! elements along y
        real(wp) :: dx = 0.0_wp        !! side along x, mm
        real(wp) :: dy = 0.0_wp        !! side along y, mm
        real(wp) :: x_first = 0.0_wp   !! middle of the first element, mm
        real(wp) :: y_first = 0.0_wp   !! middle of the first element, mm
        real(wp), allocatable :: height(:, :)   !! undeformed gap, mm, shape (nx, ny)
        real(wp), allocatable :: pressure(:, :) !! MPa, shape (nx, ny), zero outside the contact
    end type contact_grid_t

contains

    !> Give the arrays their shape; what they hold is lost if that changes.
    subroutine size_grid(grid, nx, ny)
        type(contact_grid_t), intent(inout) :: grid !! arrays of zeros if the shape is new
        integer, intent(in) :: nx !! elements along x, >= 1
        integer, intent(in) :: ny !! elements along y, >= 1

        if (allocated(grid%height)) then
            if (grid%nx == nx .and. grid%ny == ny) return
            deallocate (grid%height, grid%pressure)
        end if
        grid%nx = nx
        grid%ny = ny
        allocate (grid%height(nx, ny), grid%pressure(nx, ny), source=0.0_wp)
    end subroutine size_grid

    !> Middle of column i, mm.
    elemental real(wp) function element_x(grid, i)
        type(contact_grid_t), intent(in) :: grid !! with its elements positioned
        integer, intent(in) :: i                 !! any integer

        element_x = grid%x_first + (i - 1)*grid%dx
    end function element_x

    !> Middle of row j, mm.
    elemental real(wp) function element_y(grid, j)
        type(contact_grid_t), intent(in) :: grid !! with its elements positioned
        integer, intent(in) :: j                 !! any integer

        element_y = grid%y_first + (j - 1)*grid%dy
    end function element_y

    !> Carry the pressures of another grid over: their squares, nearly a parabola across a patch,
    !> are interpolated linearly along x and along y.
    pure subroutine take_pressures(grid, other)
        type(contact_grid_t), intent(inout) :: grid !! positioned; `pressure` is written
        type(contact_grid_t), intent(in) :: other   !! with pressures

        integer :: i, j, k, l
        real(wp) :: x, y, square

        do j = 1, grid%ny
            y = place((element_y(grid, j) - other%y_first)/other%dy, other%ny)
            l = floor(y)
            y = y - l
            do i = 1, grid%nx
                x = place((element_x(grid, i) - other%x_first)/other%dx, other%nx)
                k = floor(x)
                x = x - k
                square = (1.0_wp - y)*((1.0_wp - x)*squared(k, l) + x*squared(k + 1, l)) &
                         + y*((1.0_wp - x)*squared(k, l + 1) + x*squared(k + 1, l + 1))
                grid%pressure(i, j) = sqrt(square)
            end do
        end do

    contains

        !> Index of a distance from the first middle, with a fraction. Middles that coincide do so
        !> exactly: else a trace of a neighbour would be in contact.
        pure real(wp) function place(distance, n)
            real(wp), intent(in) :: distance
            integer, intent(in) :: n

            place = min(max(distance + 1.0_wp, -1.0_wp), n + 2.0_wp)
            if (abs(place - anint(place)) < half_digits) place = anint(place)
        end function place

        pure real(wp) function squared(k, l)
            integer, intent(in) :: k, l

            squared = 0.0_wp
            if (min(k, l) < 1 .or. k > other%nx .or. l > other%ny) return
            squared = other%pressure(k, l)**2
        end function squared
    end subroutine take_pressures

    !> Number of patches: sets of elements in contact that touch by sides or corners.
    subroutine count_patches(pressure, stack, number)
        real(wp), intent(in) :: pressure(:, :)  !! positive in contact
        integer, intent(inout) :: stack(0:)     !! capacity for twice as many numbers as elements
        integer, intent(out) :: number          !! of patches

        integer :: nx, ny, n, first, element, i, j, k, l

        ! The second half of the capacity marks the elements that were seen.
        nx = size(pressure, 1)
        ny = size(pressure, 2)
        stack(nx*ny:2*nx*ny - 1) = 0
        number = 0
        do first = 0, nx*ny - 1
            if (.not. is_new(modulo(first, nx) + 1, first/nx + 1)) cycle
            number = number + 1
            n = 1
            stack(0) = first
            stack(nx*ny + first) = 1
            do while (n > 0)
                n = n - 1
                element = stack(n)
                i = modulo(element, nx) + 1
                j = element/nx + 1
                do l = max(j - 1, 1), min(j + 1, ny)
                    do k = max(i - 1, 1), min(i + 1, nx)
                        if (.not. is_new(k, l)) cycle
                        element = (l - 1)*nx + k - 1
                        stack(nx*ny + element) = 1
                        stack(n) = element
                        n = n + 1
                    end do
                end do
            end do
        end do

    contains

        logical function is_new(i, j)
            integer, intent(in) :: i, j

            is_new = pressure(i, j) > 0.0_wp
            if (is_new) is_new = stack(nx*ny + (j - 1)*nx + i - 1) == 0
        end function is_new
    end subroutine count_patches
end module faststrip_kalker_grid
