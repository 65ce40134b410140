!> Interfaces to the GNU Scientific Library's adaptive quadrature.
!>
!> GSL is GPL: only modules that the embeddable core does not need may use this one. GSL's error
!> handler must be switched off by whoever calls an integrator (`gsl_set_error_handler_off`), as it
!> would end the program; failures then come back as codes, 0 for success.
module faststrip_tables_gsl
    use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int, c_null_funptr, c_null_ptr, &
                                           c_ptr, c_size_t
    implicit none
    private

    public :: gsl_function_t
    public :: gsl_set_error_handler_off, gsl_integration_workspace_alloc
    public :: gsl_integration_workspace_free, gsl_integration_qags
    public :: gsl_integration_cquad_workspace_alloc, gsl_integration_cquad_workspace_free
    public :: gsl_integration_cquad

    !> `gsl_function`: an integrand `real(c_double) function f(x, params) bind(c)` with both
    !> arguments by value, and what it is handed.
    type, bind(c) :: gsl_function_t
        type(c_funptr) :: function = c_null_funptr
        type(c_ptr) :: params = c_null_ptr
    end type gsl_function_t

    interface
        !> Make GSL return codes instead of ending the program; gives the former handler.
        function gsl_set_error_handler_off() result(former) bind(c)
            import :: c_funptr
            type(c_funptr) :: former
        end function gsl_set_error_handler_off

        !> Room for n intervals; null if there is none.
        function gsl_integration_workspace_alloc(n) result(workspace) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: workspace
        end function gsl_integration_workspace_alloc

        !> Give the memory back.
        subroutine gsl_integration_workspace_free(workspace) bind(c)
            import :: c_ptr
            type(c_ptr), value :: workspace
        end subroutine gsl_integration_workspace_free

        !> Adaptive 21-point Gauss-Kronrod rule with epsilon extrapolation on [a, b], for integrands
        !> with singularities. The first argument has no intent on purpose: with intent(in) the
        !> compiler may not see that the callee reads it.
        function gsl_integration_qags(f, a, b, epsabs, epsrel, limit, workspace, result_, abserr) &
            result(code) bind(c)
            import :: c_double, c_int, c_ptr, c_size_t, gsl_function_t
            type(gsl_function_t) :: f
            real(c_double), value :: a, b, epsabs, epsrel
            integer(c_size_t), value :: limit
            type(c_ptr), value :: workspace
            real(c_double), intent(out) :: result_, abserr
            integer(c_int) :: code
        end function gsl_integration_qags

        !> Room for n intervals of the doubly adaptive rule; null if there is none.
        function gsl_integration_cquad_workspace_alloc(n) result(workspace) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: n
            type(c_ptr) :: workspace
        end function gsl_integration_cquad_workspace_alloc

        !> Give the memory back.
        subroutine gsl_integration_cquad_workspace_free(workspace) bind(c)
            import :: c_ptr
            type(c_ptr), value :: workspace
        end subroutine gsl_integration_cquad_workspace_free

        !> Doubly adaptive Clenshaw-Curtis rule on [a, b]. The first argument as in
        !> `gsl_integration_qags`.
        function gsl_integration_cquad(f, a, b, epsabs, epsrel, workspace, result_, abserr, &
                                       evaluations) result(code) bind(c)
            import :: c_double, c_int, c_ptr, c_size_t, gsl_function_t
            type(gsl_function_t) :: f
            real(c_double), value :: a, b, epsabs, epsrel
            type(c_ptr), value :: workspace
            real(c_double), intent(out) :: result_, abserr
            integer(c_size_t), intent(out) :: evaluations
            integer(c_int) :: code
        end function gsl_integration_cquad
    end interface
end module faststrip_tables_gsl
