!> Interfaces to FFTW 3's transforms along one axis of many, double precision.
!>
!> FFTW is GPL: only modules that the embeddable core does not need may use this one. Its planner
!> is not thread-safe: plans are made and destroyed by one thread at a time, which
!> `faststrip_kalker_convolution` sees to for threads of OpenMP; executing them is free.
module faststrip_kalker_fftw
    use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, c_ptr, c_size_t
    implicit none
    private

    public :: fftw_estimate
    public :: fftw_alloc_real, fftw_alloc_complex, fftw_free
    public :: fftw_forward, fftw_backward
    public :: fftw_plan_many_dft, fftw_plan_many_dft_r2c, fftw_plan_many_dft_c2r, fftw_destroy_plan
    public :: fftw_execute_dft, fftw_execute_dft_r2c, fftw_execute_dft_c2r

    !> Choose the algorithm without timing.
    !> Given: numbers of the FFTW library.
    integer(c_int), parameter :: fftw_estimate = 64_c_int
    !> Sign of the exponent of a complex transform.
    !> Given: numbers of the FFTW library.
    integer(c_int), parameter :: fftw_forward = -1_c_int, fftw_backward = 1_c_int

    interface
        !> Aligned memory for n reals; null if there is none.
        function fftw_alloc_real(n) result(memory) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: memory
        end function fftw_alloc_real

        !> Aligned memory for n complex numbers; null if there is none.
        function fftw_alloc_complex(n) result(memory) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: memory
        end function fftw_alloc_complex

        !> Free the memory; null does nothing.
        subroutine fftw_free(memory) bind(c)
            import :: c_ptr
            type(c_ptr), value :: memory
        end subroutine fftw_free

        !> Plan `howmany` forward transforms of n(1) reals into n(1)/2 + 1 complex numbers; element
        !> k of transform j is at `k*stride + j*dist`, k and j from 0. Null embed arrays stand
        !> for n.
        !> Null if there is no plan. With `fftw_estimate` the arrays are not touched.
        function fftw_plan_many_dft_r2c(rank, n, howmany, in, inembed, istride, idist, out, &
                                        onembed, ostride, odist, flags) result(plan) bind(c)
            import :: c_double, c_double_complex, c_int, c_ptr
            integer(c_int), value :: rank, howmany, istride, idist, ostride, odist, flags
            integer(c_int), intent(in) :: n(*)
            type(c_ptr), value :: inembed, onembed
            real(c_double), intent(inout) :: in(*)
            complex(c_double_complex), intent(inout) :: out(*)
            type(c_ptr) :: plan
        end function fftw_plan_many_dft_r2c

        !> The same backward, without the factor 1/n; executing it destroys `in`.
        function fftw_plan_many_dft_c2r(rank, n, howmany, in, inembed, istride, idist, out, &
                                        onembed, ostride, odist, flags) result(plan) bind(c)
            import :: c_double, c_double_complex, c_int, c_ptr
            integer(c_int), value :: rank, howmany, istride, idist, ostride, odist, flags
            integer(c_int), intent(in) :: n(*)
            type(c_ptr), value :: inembed, onembed
            complex(c_double_complex), intent(inout) :: in(*)
            real(c_double), intent(inout) :: out(*)
            type(c_ptr) :: plan
        end function fftw_plan_many_dft_c2r

        !> The same for complex transforms in place, `in` given twice; `sign` is `fftw_forward` or
        !> `fftw_backward`.
        function fftw_plan_many_dft(rank, n, howmany, in, inembed, istride, idist, out, onembed, &
                                    ostride, odist, sign, flags) result(plan) bind(c)
            import :: c_int, c_ptr
            integer(c_int), value :: rank, howmany, istride, idist, ostride, odist, sign, flags
            integer(c_int), intent(in) :: n(*)
            type(c_ptr), value :: inembed, onembed, in, out
            type(c_ptr) :: plan
        end function fftw_plan_many_dft

        !> Give a plan back.
        subroutine fftw_destroy_plan(plan) bind(c)
            import :: c_ptr
            type(c_ptr), value :: plan
        end subroutine fftw_destroy_plan

        !> Execute a forward plan of reals on arrays aligned as those it was made with.
        subroutine fftw_execute_dft_r2c(plan, in, out) bind(c)
            import :: c_double, c_double_complex, c_ptr
            type(c_ptr), value :: plan
            real(c_double), intent(inout) :: in(*)
            complex(c_double_complex), intent(inout) :: out(*)
        end subroutine fftw_execute_dft_r2c

        !> Execute a backward plan to reals on arrays aligned as those it was made with.
        subroutine fftw_execute_dft_c2r(plan, in, out) bind(c)
            import :: c_double, c_double_complex, c_ptr
            type(c_ptr), value :: plan
            complex(c_double_complex), intent(inout) :: in(*)
            real(c_double), intent(inout) :: out(*)
        end subroutine fftw_execute_dft_c2r

        !> Execute a complex plan in place, `in` given twice.
        subroutine fftw_execute_dft(plan, in, out) bind(c)
            import :: c_ptr
            type(c_ptr), value :: plan, in, out
        end subroutine fftw_execute_dft
    end interface
end module faststrip_kalker_fftw
