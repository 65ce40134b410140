!> Interfaces to FFTW 3's real two-dimensional transforms, double precision.
!>
!> FFTW is GPL: only modules that the embeddable core does not need may use this one. Its planner
!> is not thread-safe: plans are made and destroyed by one thread at a time, executing them is free.
module faststrip_numerics_fftw
    use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, c_ptr, c_size_t
    implicit none
    private

    public :: fftw_estimate
    public :: fftw_alloc_real, fftw_alloc_complex, fftw_free
    public :: fftw_plan_dft_r2c_2d, fftw_plan_dft_c2r_2d, fftw_destroy_plan
    public :: fftw_execute_dft_r2c, fftw_execute_dft_c2r

    !> Choose the algorithm without timing.
    integer(c_int), parameter :: fftw_estimate = 64_c_int

    interface
        !> Aligned room for n reals; null if there is none.
        function fftw_alloc_real(n) result(room) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: room
        end function fftw_alloc_real

        !> Aligned room for n complex numbers; null if there is none.
        function fftw_alloc_complex(n) result(room) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: room
        end function fftw_alloc_complex

        !> Give room back; null does nothing.
        subroutine fftw_free(room) bind(c)
            import :: c_ptr
            type(c_ptr), value :: room
        end subroutine fftw_free

        !> Plan a forward transform of `in(n1, n0)` into `out(n1/2 + 1, n0)` (C counts the slow
        !> index first); null if there is none. With `fftw_estimate` the arrays are not touched.
        function fftw_plan_dft_r2c_2d(n0, n1, in, out, flags) result(plan) bind(c)
            import :: c_double, c_double_complex, c_int, c_ptr
            integer(c_int), value :: n0, n1
            real(c_double), intent(inout) :: in(*)
            complex(c_double_complex), intent(inout) :: out(*)
            integer(c_int), value :: flags
            type(c_ptr) :: plan
        end function fftw_plan_dft_r2c_2d

        !> The same backward, without the factor 1/(n0 n1); executing it destroys `in`.
        function fftw_plan_dft_c2r_2d(n0, n1, in, out, flags) result(plan) bind(c)
            import :: c_double, c_double_complex, c_int, c_ptr
            integer(c_int), value :: n0, n1
            complex(c_double_complex), intent(inout) :: in(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_int), value :: flags
            type(c_ptr) :: plan
        end function fftw_plan_dft_c2r_2d

        !> Give a plan back.
        subroutine fftw_destroy_plan(plan) bind(c)
            import :: c_ptr
            type(c_ptr), value :: plan
        end subroutine fftw_destroy_plan

        !> Execute a forward plan on arrays aligned as those it was made with.
        subroutine fftw_execute_dft_r2c(plan, in, out) bind(c)
            import :: c_double, c_double_complex, c_ptr
            type(c_ptr), value :: plan
            real(c_double), intent(inout) :: in(*)
            complex(c_double_complex), intent(inout) :: out(*)
        end subroutine fftw_execute_dft_r2c

        !> Execute a backward plan on arrays aligned as those it was made with.
        subroutine fftw_execute_dft_c2r(plan, in, out) bind(c)
            import :: c_double, c_double_complex, c_ptr
            type(c_ptr), value :: plan
            complex(c_double_complex), intent(inout) :: in(*)
            real(c_double), intent(inout) :: out(*)
        end subroutine fftw_execute_dft_c2r
    end interface
end module faststrip_numerics_fftw
