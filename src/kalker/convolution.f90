!> Convolution of fields on a grid with kernels that depend on the distance alone, by FFT (FFTW).
!>
!>     result(i, j) = sum over (k, l) of kernel(i - k, j - l) source(k, l)
!>
!> The grid is doubled and filled up with zeros, so that the transform's periodic images do not
!> reach the result; the transforms along x pass over the rows of zeros. Plans and kernels are made
!> once and kept in a workspace of the caller; applying
!> them allocates nothing (FFTW may take a buffer of its own for large grids).
!>
!> Plans are made with FFTW_ESTIMATE. A plan chosen by measuring is somewhat faster, but which one
!> wins depends on what else the machine does at that moment, and another algorithm sums in another
!> order: the last bits of a result would change from run to run.
module faststrip_kalker_convolution
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, &
                                           c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr, c_size_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: half_digits
    use faststrip_base_status, only: status_t, set_status, clear_status, st_bad_argument, &
                                     st_workspace_too_small
    use faststrip_kalker_fftw, only: fftw_estimate, fftw_forward, fftw_backward, fftw_alloc_real, &
                                     fftw_alloc_complex, fftw_free, fftw_plan_many_dft, &
                                     fftw_plan_many_dft_r2c, fftw_plan_many_dft_c2r, &
                                     fftw_destroy_plan, fftw_execute_dft, fftw_execute_dft_r2c, &
                                     fftw_execute_dft_c2r
    implicit none
    private

    public :: convolution_t, reserve_convolution, release_convolution, good_size
    public :: set_kernel, set_inverse_kernel, transform_source, collect, convolve
    public :: even, odd

    !> Parity of a kernel along one axis.
    !> Given: numbers of kinds.
    integer, parameter :: even = 1, odd = -1

    ! Points of a grid, so that integers count those of the doubled one, with good sizes.
    integer, parameter :: most_points = shiftr(huge(1), 3)

    !> Room, plans, kernels and transformed sources for one grid. Owned by the caller, one per
    !> thread, never copied by assignment; given back by `release_convolution` or when it goes out
    !> of scope. A single object, not an array: gfortran 12 finalises the first element of an array
    !> component for each of them.
    type :: convolution_t
        integer :: nx = 0        !! points of the grid along the first axis
        integer :: ny = 0        !! along the second
        integer :: mx = 0        !! of the doubled grid, at least 2 nx
        integer :: my = 0        !! at least 2 ny
        integer :: n_kernels = 0 !! kernels there is memory for
        integer :: n_sources = 0 !! transformed sources there is memory for
        real(c_double), pointer, contiguous, private :: field(:, :) => null()
        complex(c_double_complex), pointer, contiguous, private :: spectrum(:, :) => null()
        complex(c_double_complex), pointer, contiguous, private :: source(:, :, :) => null()
        real(c_double), pointer, contiguous, private :: kernel(:, :, :) => null()
        logical, allocatable, private :: is_imaginary(:) ! the transform of each kernel, else real
        type(c_ptr), private :: field_memory = c_null_ptr, spectrum_memory = c_null_ptr
        type(c_ptr), private :: source_memory = c_null_ptr, kernel_memory = c_null_ptr
        ! Along x forward and backward, along y forward and backward.
        type(c_ptr), private :: plans(4) = c_null_ptr
    contains
        final :: release_convolution
    end type convolution_t

contains

    !> Allocate memory and plans for a grid; nothing happens if they are there already, in which
    !> case the kernels stay. Otherwise kernels are lost and have to be set.
    subroutine reserve_convolution(convolution, nx, ny, n_kernels, n_sources, status)
        type(convolution_t), intent(inout) :: convolution !! ready for `set_kernel`
        integer, intent(in) :: nx         !! points along the first axis, >= 1; 2^28 with the second
        integer, intent(in) :: ny         !! along the second
        integer, intent(in) :: n_kernels  !! kernels kept at a time, >= 1
        integer, intent(in) :: n_sources  !! sources transformed at a time, >= 1
        type(status_t), intent(out) :: status !! `st_bad_argument`; `st_workspace_too_small`, no
                                              !! memory
        integer :: half, i

        call clear_status(status)
        if (min(nx, ny, n_kernels, n_sources) < 1 .or. real(nx, wp)*ny > most_points) then
            call set_status(status, st_bad_argument, 'a convolution needs a point each way and ' &
                            //'at most 2^28 in all, a kernel, a source')
            return
        end if
        if (convolution%nx == nx .and. convolution%ny == ny .and. &
            convolution%n_kernels == n_kernels .and. convolution%n_sources == n_sources) return
        call release_convolution(convolution)
        convolution%mx = good_size(2*nx)
        convolution%my = good_size(2*ny)
        half = convolution%mx/2 + 1
        associate (mx => convolution%mx, my => convolution%my)
            convolution%field_memory = fftw_alloc_real(int(mx, c_size_t)*my)
            convolution%spectrum_memory = fftw_alloc_complex(int(half, c_size_t)*my)
            convolution%source_memory = fftw_alloc_complex(int(half, c_size_t)*my*n_sources)
            convolution%kernel_memory = fftw_alloc_real(int(half, c_size_t)*my*n_kernels)
            if (.not. (c_associated(convolution%field_memory) .and. &
                       c_associated(convolution%spectrum_memory) .and. &
                       c_associated(convolution%source_memory) .and. &
                       c_associated(convolution%kernel_memory))) then
                call refuse()
                return
            end if
            call c_f_pointer(convolution%field_memory, convolution%field, [mx, my])
            call c_f_pointer(convolution%spectrum_memory, convolution%spectrum, [half, my])
            call c_f_pointer(convolution%source_memory, convolution%source, [half, my, n_sources])
            call c_f_pointer(convolution%kernel_memory, convolution%kernel, [half, my, n_kernels])
            !$omp critical (fftw_planner)
            convolution%plans(1) = fftw_plan_many_dft_r2c( &
                1_c_int, [int(mx, c_int)], int(ny, c_int), convolution%field, c_null_ptr, 1_c_int, &
                int(mx, c_int), convolution%source, c_null_ptr, 1_c_int, int(half, c_int), &
                fftw_estimate)
            convolution%plans(2) = fftw_plan_many_dft_c2r( &
                1_c_int, [int(mx, c_int)], int(ny, c_int), convolution%spectrum, c_null_ptr, &
                1_c_int, int(half, c_int), convolution%field, c_null_ptr, 1_c_int, &
                int(mx, c_int), fftw_estimate)
            convolution%plans(3) = plan_along_y(convolution%source_memory, fftw_forward)
            convolution%plans(4) = plan_along_y(convolution%spectrum_memory, fftw_backward)
            !$omp end critical (fftw_planner)
        end associate
        do i = 1, size(convolution%plans)
            if (c_associated(convolution%plans(i))) cycle
            call refuse()
            return
        end do
        convolution%source = (0.0_wp, 0.0_wp)
        convolution%kernel = 0.0_wp
        allocate (convolution%is_imaginary(n_kernels), source=.false.)
        convolution%nx = nx
        convolution%ny = ny
        convolution%n_kernels = n_kernels
        convolution%n_sources = n_sources

    contains

        type(c_ptr) function plan_along_y(memory, sign)
            type(c_ptr), intent(in) :: memory
            integer(c_int), intent(in) :: sign

            plan_along_y = fftw_plan_many_dft( &
                1_c_int, [int(convolution%my, c_int)], int(half, c_int), memory, c_null_ptr, &
                int(half, c_int), 1_c_int, memory, c_null_ptr, int(half, c_int), 1_c_int, sign, &
                fftw_estimate)
        end function plan_along_y

        subroutine refuse()
            call release_convolution(convolution)
            call set_status(status, st_workspace_too_small, 'no memory for a convolution')
        end subroutine refuse
    end subroutine reserve_convolution

    !> Give everything back; harmless if there is nothing.
    subroutine release_convolution(convolution)
        type(convolution_t), intent(inout) :: convolution !! empty afterwards

        integer :: i

        !$omp critical (fftw_planner)
        do i = 1, size(convolution%plans)
            if (c_associated(convolution%plans(i))) call fftw_destroy_plan(convolution%plans(i))
            convolution%plans(i) = c_null_ptr
        end do
        !$omp end critical (fftw_planner)
        call fftw_free(convolution%field_memory)
        call fftw_free(convolution%spectrum_memory)
        call fftw_free(convolution%source_memory)
        call fftw_free(convolution%kernel_memory)
        convolution%field_memory = c_null_ptr
        convolution%spectrum_memory = c_null_ptr
        convolution%source_memory = c_null_ptr
        convolution%kernel_memory = c_null_ptr
        if (allocated(convolution%is_imaginary)) deallocate (convolution%is_imaginary)
        nullify (convolution%field, convolution%spectrum, convolution%source, convolution%kernel)
        convolution%nx = 0
        convolution%ny = 0
        convolution%mx = 0
        convolution%my = 0
        convolution%n_kernels = 0
        convolution%n_sources = 0
    end subroutine release_convolution

    !> The smallest size from n on that FFTW's unmeasured plans are quick with: a multiple of 4 that
    !> is a product of 2, 5 and 7, with one 3 at most. Sizes with 9 take up to twice as long.
    pure integer function good_size(n)
        integer, intent(in) :: n !! at least 1

        ! Given: the factors that transforms are fast for.
        integer, parameter :: primes(3) = [2, 5, 7]
        integer :: rest, i

        good_size = n + modulo(-n, 4)
        do
            rest = good_size
            if (modulo(rest, 3) == 0) rest = rest/3
            do i = 1, size(primes)
                do while (modulo(rest, primes(i)) == 0)
                    rest = rest/primes(i)
                end do
            end do
            if (rest == 1) return
            good_size = good_size + 4
        end do
    end function good_size

    !> Give kernel k its values at the distances from (0, 0) on; those at negative distances follow
    !> from its parity, and those further than the values given are zero. Transformed source 1 is
    !> overwritten.
    subroutine set_kernel(convolution, k, values, parity_x, parity_y, status)
        type(convolution_t), intent(inout) :: convolution !! reserved
        integer, intent(in) :: k             !! which kernel, 1 to `n_kernels`
        real(wp), intent(in) :: values(0:, 0:) !! at least (nx, ny) of them; beyond distance mx/2,
                                             !! my/2 they do not count
        integer, intent(in) :: parity_x      !! `even` or `odd`; values(0, :) of an odd one are 0
        integer, intent(in) :: parity_y      !! `even` or `odd`; values(:, 0) of an odd one are 0
        type(status_t), intent(out) :: status !! `st_bad_argument`

        real(wp) :: scale
        integer :: i, j, k_x, k_y, from

        call clear_status(status)
        if (k < 1 .or. k > convolution%n_kernels) then
            call set_status(status, st_bad_argument, 'no such kernel of a convolution')
            return
        else if (size(values, 1) < convolution%nx .or. size(values, 2) < convolution%ny) then
            call set_status(status, st_bad_argument, 'a kernel is smaller than its grid')
            return
        else if (abs(parity_x) /= 1 .or. abs(parity_y) /= 1) then
            call set_status(status, st_bad_argument, 'a kernel is even or odd')
            return
        end if
        associate (field => convolution%field, mx => convolution%mx, my => convolution%my)
            do j = 0, my - 1
                k_y = min(j, my - j)
                do i = 0, mx - 1
                    k_x = min(i, mx - i)
                    field(i + 1, j + 1) = 0.0_wp
                    if (k_x >= size(values, 1) .or. k_y >= size(values, 2)) cycle
                    ! At half the period a distance is its own negative.
                    if (parity_x == odd .and. (i == 0 .or. 2*i == mx)) cycle
                    if (parity_y == odd .and. (j == 0 .or. 2*j == my)) cycle
                    field(i + 1, j + 1) = values(k_x, k_y)
                    if (parity_x == odd .and. 2*i > mx) field(i + 1, j + 1) = -field(i + 1, j + 1)
                    if (parity_y == odd .and. 2*j > my) field(i + 1, j + 1) = -field(i + 1, j + 1)
                end do
            end do
        end associate
        ! The plan along x is for ny rows; it may go over some twice.
        do j = 1, convolution%my, convolution%ny
            from = min(j, convolution%my - convolution%ny + 1)
            call fftw_execute_dft_r2c(convolution%plans(1), convolution%field(:, from), &
                                      convolution%source(:, from, 1))
        end do
        call fftw_execute_dft(convolution%plans(3), convolution%source_memory, &
                              convolution%source_memory)
        ! Even and odd along both axes: the transform is real; mixed: it is imaginary. Backward
        ! transforms leave the factor out.
        scale = 1.0_wp/(real(convolution%mx, wp)*convolution%my)
        convolution%is_imaginary(k) = parity_x /= parity_y
        if (convolution%is_imaginary(k)) then
            convolution%kernel(:, :, k) = scale*aimag(convolution%source(:, :, 1))
        else
            convolution%kernel(:, :, k) = scale*real(convolution%source(:, :, 1), wp)
        end if
    end subroutine set_kernel

    !> Make kernel k the inverse of another one on the doubled, periodic grid: a preconditioner.
    !> Only for even kernels with a positive transform; where that is but rounding of the largest
    !> that much is taken instead.
    subroutine set_inverse_kernel(convolution, k, other, status)
        type(convolution_t), intent(inout) :: convolution !! reserved
        integer, intent(in) :: k              !! which kernel, 1 to `n_kernels`
        integer, intent(in) :: other          !! one that was set, with values up to distances
                                              !! mx/2 and my/2
        type(status_t), intent(out) :: status !! `st_bad_argument`

        real(wp) :: floor, scale

        call clear_status(status)
        if (min(k, other) < 1 .or. max(k, other) > convolution%n_kernels) then
            call set_status(status, st_bad_argument, 'no such kernel of a convolution')
            return
        end if
        scale = (real(convolution%mx, wp)*convolution%my)**2
        floor = half_digits*maxval(convolution%kernel(:, :, other))
        if (convolution%is_imaginary(other) .or. floor <= tiny(floor)*scale) then
            call set_status(status, st_bad_argument, 'a kernel without a positive transform')
            return
        end if
        convolution%is_imaginary(k) = .false.
        convolution%kernel(:, :, k) = 1.0_wp/(scale*max(convolution%kernel(:, :, other), floor))
    end subroutine set_inverse_kernel

    !> Transform a source, to be used by any number of `collect`s.
    subroutine transform_source(convolution, s, source)
        type(convolution_t), intent(inout) :: convolution !! reserved
        integer, intent(in) :: s             !! where to keep it, 1 to `n_sources`
        real(wp), intent(in) :: source(:, :) !! shape (nx, ny)

        type(c_ptr) :: memory
        integer :: j

        associate (nx => convolution%nx, ny => convolution%ny)
            do j = 1, ny
                convolution%field(:nx, j) = source(:nx, j)
                convolution%field(nx + 1:, j) = 0.0_wp
            end do
            call fftw_execute_dft_r2c(convolution%plans(1), convolution%field, &
                                      convolution%source(:, :, s))
            convolution%source(:, ny + 1:, s) = (0.0_wp, 0.0_wp)
        end associate
        memory = c_loc(convolution%source(1, 1, s))
        call fftw_execute_dft(convolution%plans(3), memory, memory)
    end subroutine transform_source

    !> The sum of convolutions of transformed sources, `sum factors(i) kernels(i) * sources(i)`.
    subroutine collect(convolution, kernels, sources, factors, result)
        type(convolution_t), intent(inout) :: convolution !! with kernels and sources set
        integer, intent(in) :: kernels(:)       !! numbers of the kernels
        integer, intent(in) :: sources(:)       !! numbers of the sources, one for each kernel
        real(wp), intent(in) :: factors(:)      !! one for each kernel
        real(wp), intent(inout) :: result(:, :) !! shape (nx, ny)

        integer :: i, j

        do i = 1, size(kernels)
            call multiply(convolution%kernel(:, :, kernels(i)), &
                          convolution%is_imaginary(kernels(i)), &
                          convolution%source(:, :, sources(i)), factors(i), i == 1, &
                          convolution%spectrum)
        end do
        call fftw_execute_dft(convolution%plans(4), convolution%spectrum_memory, &
                              convolution%spectrum_memory)
        call fftw_execute_dft_c2r(convolution%plans(2), convolution%spectrum, convolution%field)
        do j = 1, convolution%ny
            result(:convolution%nx, j) = convolution%field(:convolution%nx, j)
        end do
    end subroutine collect

    !> Put or add the product of a kernel, a source and a factor.
    pure subroutine multiply(kernel, is_imaginary, source, factor, is_first, spectrum)
        real(wp), intent(in), contiguous :: kernel(:, :)
        logical, intent(in) :: is_imaginary, is_first
        complex(wp), intent(in), contiguous :: source(:, :)
        real(wp), intent(in) :: factor
        complex(wp), intent(inout), contiguous :: spectrum(:, :)

        integer :: i, j

        do j = 1, size(kernel, 2)
            if (is_first) then
                if (is_imaginary) then
                    !$omp simd
                    do i = 1, size(kernel, 1)
                        spectrum(i, j) = cmplx(-factor*kernel(i, j)*aimag(source(i, j)), &
                                               factor*kernel(i, j)*real(source(i, j), wp), wp)
                    end do
                else
                    !$omp simd
                    do i = 1, size(kernel, 1)
                        spectrum(i, j) = (factor*kernel(i, j))*source(i, j)
                    end do
                end if
            else if (is_imaginary) then
                !$omp simd
                do i = 1, size(kernel, 1)
                    spectrum(i, j) = spectrum(i, j) &
                                     + cmplx(-factor*kernel(i, j)*aimag(source(i, j)), &
                                             factor*kernel(i, j)*real(source(i, j), wp), wp)
                end do
            else
                !$omp simd
                do i = 1, size(kernel, 1)
                    spectrum(i, j) = spectrum(i, j) + (factor*kernel(i, j))*source(i, j)
                end do
            end if
        end do
    end subroutine multiply

    !> The convolution of one source with one kernel; overwrites transformed source 1.
    subroutine convolve(convolution, k, source, result)
        type(convolution_t), intent(inout) :: convolution !! with kernel k set
        integer, intent(in) :: k                !! which kernel
        real(wp), intent(in) :: source(:, :)    !! shape (nx, ny)
        real(wp), intent(inout) :: result(:, :) !! shape (nx, ny)

        call transform_source(convolution, 1, source)
        call collect(convolution, [k], [1], [1.0_wp], result)
    end subroutine convolve
end module faststrip_kalker_convolution
