!> Eq. (9) as printed, handed to GSL: what its users meet.
!>
!>     2 int_0^1 sqrt(1 - u^2) ln{ [sqrt(u^2 + cr^2) + cr] [sqrt(u^2 + cl^2) - cl]/u^2 } du,
!>
!> source and field in their right places: `sqrt(u^2 + cl^2) - cl` loses its digits wherever u is
!> small beside cl, and at u = 0 nothing is left. Errata and tests use this; nothing computes with
!> it.
module faststrip_tables_printed_integral
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan, &
                                             ieee_status_type, ieee_get_status, &
                                             ieee_set_status, ieee_set_halting_mode, ieee_all
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, &
                                           c_funptr, c_int, c_loc, c_ptr, c_size_t
    use faststrip_base_kinds, only: wp
    use faststrip_tables_gsl, only: gsl_function_t, gsl_set_error_handler_off, &
                                    gsl_integration_qags, gsl_integration_workspace_alloc, &
                                    gsl_integration_workspace_free, gsl_integration_cquad, &
                                    gsl_integration_cquad_workspace_alloc, &
                                    gsl_integration_cquad_workspace_free
    implicit none
    private

    public :: printed_influence, rule_qags, rule_cquad

    integer, parameter :: rule_qags = 1
    integer, parameter :: rule_cquad = 2

    integer(c_size_t), parameter :: limit = 1000_c_size_t

    type, bind(c) :: edges_t
        real(c_double) :: left, right
    end type edges_t

contains

    !> i_n(b), n >= 1, by one of GSL's rules on the kernel as printed.
    subroutine printed_influence(rule, n, b, tolerance, value, abs_error, code)
        integer, intent(in) :: rule          !! `rule_qags` or `rule_cquad`
        integer, intent(in) :: n             !! distance of the strips in strips, >= 1
        real(wp), intent(in) :: b            !! half-width over half-length, > 0, below 1e150
        real(wp), intent(in) :: tolerance    !! relative, asked of GSL
        real(wp), intent(out) :: value       !! what GSL says; NaN if the kernel is not finite
        real(wp), intent(out) :: abs_error   !! what GSL says its error is
        integer, intent(out) :: code         !! what GSL returns, 0 for success; -1 without memory

        type(edges_t), target :: edges
        type(gsl_function_t) :: f
        type(c_funptr) :: former
        type(c_ptr) :: workspace
        type(ieee_status_type) :: arithmetic
        integer(c_size_t) :: evaluations

        value = ieee_value(value, ieee_quiet_nan)
        abs_error = 0.0_wp
        code = -1
        former = gsl_set_error_handler_off()
        ! GSL compares the NaN that the kernel gives; that must not stop a program that traps.
        call ieee_get_status(arithmetic)
        call ieee_set_halting_mode(ieee_all, .false.)
        edges%left = (2.0_wp*n - 1.0_wp)*b
        edges%right = (2.0_wp*n + 1.0_wp)*b
        f%function = c_funloc(printed_kernel)
        f%params = c_loc(edges)
        if (rule == rule_qags) then
            workspace = gsl_integration_workspace_alloc(limit)
            if (c_associated(workspace)) then
                code = gsl_integration_qags(f, 0.0_wp, 1.0_wp, 0.0_wp, tolerance, limit, &
                                            workspace, value, abs_error)
                call gsl_integration_workspace_free(workspace)
            end if
        else
            workspace = gsl_integration_cquad_workspace_alloc(limit)
            if (c_associated(workspace)) then
                code = gsl_integration_cquad(f, 0.0_wp, 1.0_wp, 0.0_wp, tolerance, workspace, &
                                             value, abs_error, evaluations)
                call gsl_integration_cquad_workspace_free(workspace)
            end if
        end if
        call ieee_set_status(arithmetic)
        value = 2.0_wp*value
        abs_error = 2.0_wp*abs_error
    end subroutine printed_influence

    !> A logarithm of zero is given as NaN without raising an exception, as a division by u = 0 is.
    function printed_kernel(u, params) result(f) bind(c)
        real(c_double), value :: u
        type(c_ptr), value :: params
        real(c_double) :: f

        type(edges_t), pointer :: edges
        real(wp) :: left, right

        call c_f_pointer(params, edges)
        f = ieee_value(f, ieee_quiet_nan)
        left = sqrt(u*u + edges%left**2) - edges%left
        right = sqrt(u*u + edges%right**2) + edges%right
        if (.not. (left > 0.0_wp .and. abs(u) > 1.0e-150_wp)) return
        if (.not. ieee_is_finite(right)) return
        f = sqrt((1.0_wp - u)*(1.0_wp + u))*log(left/u*(right/u))
    end function printed_kernel
end module faststrip_tables_printed_integral
