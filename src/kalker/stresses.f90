!> Stresses below loads at the points of a grid: by FFT where the loads are equal rectangles of a
!> grid and the points lie on their middles, as of NORM and TANG; by the sum over the loads
!> elsewhere. Both are exact.
module faststrip_kalker_stresses
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits
    use faststrip_base_status, only: status_t, is_error
    use faststrip_kalker_convolution, only: convolution_t, reserve_convolution, &
                                            release_convolution, set_kernel, transform_source, &
                                            collect, even, odd
    use faststrip_stress_loads, only: loads_t, check_points, find_stress
    use faststrip_stress_rectangle, only: corner_stress, edge_core, n_stresses, n_tractions
    implicit none
    private

    public :: find_grid_stresses

    ! Tuned [1]: pairs of a point and a load per place of the doubled grid, from which on transforms
    ! are quicker than the sum. Origin: measured on a grid of 50 by 50: a place takes 0.22 us in
    ! each depth, a pair 0.14 us.
    real(wp), parameter :: worth_transforms = 2.0_wp
    ! Given: parity along x and y of each component, xx, yy, zz, xy, xz, yz, by p, qx and qy.
    integer, parameter :: parity_x(n_stresses, n_tractions) = reshape( &
        [even, even, even, odd, odd, even, odd, odd, odd, even, even, odd, &
         even, even, even, odd, odd, even], [n_stresses, n_tractions])
    integer, parameter :: parity_y(n_stresses, n_tractions) = reshape( &
        [even, even, even, odd, even, odd, even, even, even, odd, even, odd, &
         odd, odd, odd, even, odd, even], [n_stresses, n_tractions])

    !> Loads and points as places of one grid.
    type :: places_t
        integer :: n(2) = 0                       ! along x and y
        integer, allocatable :: load(:, :)        ! of each load
        integer, allocatable :: x(:), y(:)        ! of the points
    end type places_t

contains

    !> Stresses at all points of a grid, MPa.
    subroutine find_grid_stresses(loads, nu, x, y, z, stresses, status)
        type(loads_t), intent(in) :: loads      !! at least one
        real(wp), intent(in) :: nu              !! Poisson's ratio of the body
        real(wp), intent(in) :: x(:), y(:)      !! places, mm
        real(wp), intent(in) :: z(:)            !! depths, mm, >= 0
        real(wp), intent(out) :: stresses(:, :, :, :)
            !! xx, yy, zz, xy, xz, yz at each x, y, z: shape (6, size(x), size(y), size(z))
        type(status_t), intent(out) :: status   !! those of `check_points`

        type(places_t) :: places
        integer :: i, j, k
        logical :: is_grid

        call check_points(x, y, z, status)
        if (is_error(status)) return
        call find_places(loads, x, y, places, is_grid)
        if (is_grid) then
            call transform(loads, nu, z, places, stresses, status)
            return
        end if
        do k = 1, size(z)
            do j = 1, size(y)
                do i = 1, size(x)
                    call find_stress(loads, nu, x(i), y(j), z(k), stresses(:, i, j, k))
                end do
            end do
        end do
    end subroutine find_grid_stresses

    !> The grid that loads and points have in common, if they have one and it is worth it.
    subroutine find_places(loads, x, y, places, is_grid)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: x(:), y(:)
        type(places_t), intent(out) :: places
        logical, intent(out) :: is_grid

        integer :: first

        associate (n => loads%n)
            allocate (places%load(n, 2), places%x(size(x)), places%y(size(y)), source=0)
            is_grid = all(abs(loads%dx(:n) - loads%dx(1)) <= half_digits*loads%dx(1)) .and. &
                      all(abs(loads%dy(:n) - loads%dy(1)) <= half_digits*loads%dy(1))
            call count_sides(loads%x(:n), loads%x(1), loads%dx(1), places%load(:, 1), is_grid)
            call count_sides(loads%y(:n), loads%y(1), loads%dy(1), places%load(:, 2), is_grid)
            call count_sides(x, loads%x(1), loads%dx(1), places%x, is_grid)
            call count_sides(y, loads%y(1), loads%dy(1), places%y, is_grid)
        end associate
        if (.not. is_grid) return
        first = min(minval(places%load(:, 1)), minval(places%x)) - 1
        places%load(:, 1) = places%load(:, 1) - first
        places%x = places%x - first
        first = min(minval(places%load(:, 2)), minval(places%y)) - 1
        places%load(:, 2) = places%load(:, 2) - first
        places%y = places%y - first
        places%n = [max(maxval(places%load(:, 1)), maxval(places%x)), &
                    max(maxval(places%load(:, 2)), maxval(places%y))]
        is_grid = real(loads%n, wp)*size(x)*size(y) &
                  > worth_transforms*4.0_wp*real(places%n(1), wp)*places%n(2)
    end subroutine find_places

    !> Distances from a place in sides; no grid where one is no whole number.
    pure subroutine count_sides(values, from, side, sides, is_grid)
        real(wp), intent(in) :: values(:), from, side
        integer, intent(inout) :: sides(:)
        logical, intent(inout) :: is_grid

        real(wp) :: distance
        integer :: i

        if (.not. is_grid) return
        do i = 1, size(values)
            distance = (values(i) - from)/side
            is_grid = abs(distance) < 0.5_wp*huge(i)
            if (is_grid) is_grid = abs(distance - anint(distance)) <= half_digits*max(1.0_wp, &
                                                                                     abs(distance))
            if (.not. is_grid) return
            sides(i) = nint(distance)
        end do
    end subroutine count_sides

    !> By transforms: each depth is a convolution.
    subroutine transform(loads, nu, z, places, stresses, status)
        type(loads_t), intent(in) :: loads
        real(wp), intent(in) :: nu, z(:)
        type(places_t), intent(in) :: places
        real(wp), intent(inout) :: stresses(:, :, :, :)
        type(status_t), intent(out) :: status

        type(convolution_t) :: convolution
        real(wp), allocatable :: field(:, :), kernels(:, :, :, :)
        integer :: i, k, s

        associate (nx => places%n(1), ny => places%n(2))
            call reserve_convolution(convolution, nx, ny, n_stresses*n_tractions, n_tractions + 1, &
                                     status)
            if (is_error(status)) return
            allocate (field(nx, ny), kernels(n_stresses, n_tractions, 0:nx, 0:ny), source=0.0_wp)
        end associate
        do k = 1, size(z)
            call find_kernels(loads%dx(1), loads%dy(1), z(k), nu, kernels)
            do s = 1, n_tractions
                do i = 1, n_stresses
                    call set_kernel(convolution, n_stresses*(s - 1) + i, &
                                    kernels(i, s, :places%n(1) - 1, :places%n(2) - 1), &
                                    parity_x(i, s), parity_y(i, s), status)
                end do
            end do
            ! A kernel takes the place of the first source.
            do s = 1, n_tractions
                field = 0.0_wp
                do i = 1, loads%n
                    associate (at => field(places%load(i, 1), places%load(i, 2)))
                        at = at + loads%traction(s, i)
                    end associate
                end do
                call transform_source(convolution, 1 + s, field)
            end do
            do i = 1, n_stresses
                call collect(convolution, i + n_stresses*[(s, s=0, n_tractions - 1)], &
                             [(s, s=2, n_tractions + 1)], spread(1.0_wp, 1, n_tractions), field)
                stresses(i, :, :, k) = field(places%x, places%y)
            end do
        end do
        call release_convolution(convolution)
    end subroutine transform

    !> Stresses by a load of 1 at all distances, in sides: second differences of `corner_stress`.
    !> Those beyond the last distance do not count.
    pure subroutine find_kernels(dx, dy, z, nu, kernels)
        real(wp), intent(in) :: dx, dy, z, nu
        real(wp), intent(inout) :: kernels(:, :, 0:, 0:)

        integer :: i, j

        do j = 0, ubound(kernels, 4)
            do i = 0, ubound(kernels, 3)
                call corner_stress((i - 0.5_wp)*dx, (j - 0.5_wp)*dy, z, edge_core(dx, dy), nu, &
                                   kernels(:, :, i, j))
            end do
        end do
        do j = 0, ubound(kernels, 4) - 1
            do i = 0, ubound(kernels, 3) - 1
                kernels(:, :, i, j) = (kernels(:, :, i + 1, j + 1) - kernels(:, :, i, j + 1)) &
                                      - (kernels(:, :, i + 1, j) - kernels(:, :, i, j))
            end do
        end do
    end subroutine find_kernels
end module faststrip_kalker_stresses
