!> The influence integral by adaptive quadrature (GSL): the independent check.
!>
!> With the field point at X = cos(a), |X| < 1, each side of it is an integral over
!> `tau in [0, a]` (and the same with `pi - a`):
!>
!>     sqrt(1 - u^2) du -> sin(a - tau)^2 dtau,  |u - X| = 2 sin(a - tau/2) sin(tau/2),
!>
!> for |X| >= 1 it is one with a = pi and |X| - 1 added to the distance: no difference of near
!> numbers, no square-root end and the only singular place at tau = 0.
!>
!> The kernel of eq. (9) as printed, `(sqrt(u^2 + c^2) - c)/u^2`, cancels; here the inner integral
!> is `ln(1 + d)`, `d = [2b + 8 n b^2/(s_r + s_l)]/(cl + s_l)`, `s = sqrt(delta^2 + c^2)`, and
!> `2 asinh(b/|delta|)` for n = 0.
!>
!> Results come with GSL's error estimate; whatever GSL doubts is an error here.
module faststrip_tables_quadrature
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, &
                                           c_funptr, c_int, c_loc, c_ptr, c_size_t
    use faststrip_base_kinds, only: wp, pi
    use faststrip_numerics_logarithm, only: log_1p
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     message_length, st_bad_argument, st_not_finite, &
                                     st_out_of_range, st_quadrature
    use faststrip_tables_gsl, only: gsl_function_t, gsl_set_error_handler_off, &
                                    gsl_integration_qags, gsl_integration_workspace_alloc, &
                                    gsl_integration_workspace_free
    implicit none
    private

    public :: quadrature_influence, quadrature_influence_2d

    ! Relative tolerances asked of GSL and the number of intervals it may use.
    real(wp), parameter :: tolerance = 1.0e-13_wp
    real(wp), parameter :: tolerance_outer = 1.0e-10_wp
    real(wp), parameter :: tolerance_inner = 1.0e-12_wp
    integer(c_size_t), parameter :: limit = 1000_c_size_t

    ! Squares of b and X and their reciprocals stay finite up to here.
    real(wp), parameter :: largest = 1.0e100_wp

    !> One side of the field point, and what the integrands need.
    type, bind(c) :: side_t
        real(c_double) :: a       ! length of the interval in tau
        real(c_double) :: outside ! |X| - 1, or 0
        real(c_double) :: cl      ! nearer edge over xd; 0 for n = 0
        real(c_double) :: cr      ! farther edge over xd
        real(c_double) :: width   ! cr - cl
        real(c_double) :: squares ! cr^2 - cl^2
        real(c_double) :: factor  ! 2 for n = 0, both halves of the strip; else 1
        real(c_double) :: delta   ! |u - X| of the inner integral
        type(c_ptr) :: workspace  ! of the inner integral
        integer(c_int) :: code    ! first failure of an inner integral, or 0
    end type side_t

contains

    !> i_n(b) seen at X by one-dimensional quadrature of the logarithmic kernel.
    subroutine quadrature_influence(n, b, x, value, abs_error, status)
        integer, intent(in) :: n              !! distance of the strips in strips, sign ignored
        real(wp), intent(in) :: b             !! half-width over half-length, in [1e-100, 1e100]
        real(wp), intent(in) :: x             !! field point along the strip over the half-length
        real(wp), intent(out) :: value        !! influence over the half-length; 0 on error
        real(wp), intent(out) :: abs_error    !! GSL's estimate of its absolute error
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_bad_argument`,
                                              !! `st_out_of_range`, `st_quadrature`

        call integrate(1, n, b, x, value, abs_error, status)
    end subroutine quadrature_influence

    !> i_n(b) seen at X by two nested quadratures of the double integral of eq. (6) and (12) itself;
    !> slow, assumes nothing about the inner integral.
    subroutine quadrature_influence_2d(n, b, x, value, abs_error, status)
        integer, intent(in) :: n              !! distance of the strips in strips, sign ignored
        real(wp), intent(in) :: b             !! half-width over half-length, in [1e-100, 1e100]
        real(wp), intent(in) :: x             !! field point along the strip over the half-length
        real(wp), intent(out) :: value        !! influence over the half-length; 0 on error
        real(wp), intent(out) :: abs_error    !! GSL's estimate of the outer absolute error
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_bad_argument`,
                                              !! `st_out_of_range`, `st_quadrature`

        call integrate(2, n, b, x, value, abs_error, status)
    end subroutine quadrature_influence_2d

    !> Both sides of the field point, or the one there is.
    subroutine integrate(dimensions, n, b, x, value, abs_error, status)
        integer, intent(in) :: dimensions
        integer, intent(in) :: n
        real(wp), intent(in) :: b, x
        real(wp), intent(out) :: value, abs_error
        type(status_t), intent(out) :: status

        type(side_t), target :: side
        type(gsl_function_t) :: f
        type(c_funptr) :: former
        type(c_ptr) :: workspace
        real(wp) :: relative
        integer(c_int) :: code
        character(len=message_length) :: words

        value = 0.0_wp
        abs_error = 0.0_wp
        call check(b, x, status)
        if (status%code /= 0) return
        former = gsl_set_error_handler_off()
        workspace = gsl_integration_workspace_alloc(limit)
        side%workspace = gsl_integration_workspace_alloc(limit)
        if (c_associated(workspace) .and. c_associated(side%workspace)) then
            call set_strip(n, b, side)
            if (dimensions == 1) then
                f%function = c_funloc(line_integrand)
                relative = tolerance
            else
                f%function = c_funloc(area_integrand)
                relative = tolerance_outer
            end if
            f%params = c_loc(side)
            side%code = 0
            if (abs(x) < 1.0_wp) then
                side%outside = 0.0_wp
                side%a = acos(x)
                call integrate_side(f, relative, workspace, side, value, abs_error, code)
                side%a = acos(-x)
                if (code == 0) call integrate_side(f, relative, workspace, side, value, &
                                                   abs_error, code)
            else
                side%outside = abs(x) - 1.0_wp
                side%a = pi
                call integrate_side(f, relative, workspace, side, value, abs_error, code)
            end if
            if (code /= 0) then
                value = 0.0_wp
                abs_error = 0.0_wp
                write (words, '(a, i0, 4a, a, i0)') 'quadrature at strip distance ', n, ', b = ', &
                    trim(number_text(b)), ', X = ', trim(number_text(x)), &
                    ' ended with GSL status ', code
                call set_status(status, st_quadrature, words)
            end if
        else
            call set_status(status, st_quadrature, 'no memory for the quadrature')
        end if
        if (c_associated(workspace)) call gsl_integration_workspace_free(workspace)
        if (c_associated(side%workspace)) call gsl_integration_workspace_free(side%workspace)
    end subroutine integrate

    !> Add one side of the field point. The kernel changes over distances in proportion to the
    !> nearer edge, which may be any number of decades below one; the interval is cut in equal
    !> ratios from there on, or a rule that has not seen the change yet would report convergence.
    subroutine integrate_side(f, relative, workspace, side, value, abs_error, code)
        type(gsl_function_t) :: f
        real(wp), intent(in) :: relative
        type(c_ptr), intent(in) :: workspace
        type(side_t), target, intent(inout) :: side
        real(wp), intent(inout) :: value, abs_error
        integer(c_int), intent(out) :: code

        real(wp), parameter :: ratio = 8.0_wp
        real(wp) :: scale, left, right, part, part_error

        scale = max(merge(side%cl, side%cr, side%cl > 0.0_wp), side%outside)
        left = 0.0_wp
        right = min(scale/(abs(sin(side%a)) + sqrt(scale)), side%a)
        do
            if (right > side%a/ratio) right = side%a
            code = gsl_integration_qags(f, left, right, 0.0_wp, relative, limit, workspace, &
                                        part, part_error)
            if (code == 0) code = side%code
            if (code /= 0) return
            value = value + part
            abs_error = abs_error + part_error
            if (.not. right < side%a) return
            left = right
            right = ratio*right
        end do
    end subroutine integrate_side

    !> Refuse what has no influence integral or leaves the range of doubles on the way.
    subroutine check(b, x, status)
        real(wp), intent(in) :: b, x
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. ieee_is_finite(b)) then
            call set_status(status, st_not_finite, 'b = yd/xd must be a finite number, got ' // &
                            trim(number_text(b)))
        else if (.not. ieee_is_finite(x)) then
            call set_status(status, st_not_finite, 'X = x/xd must be a finite number, got ' // &
                            trim(number_text(x)))
        else if (b <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'b = yd/xd must be above 0, got ' // &
                            trim(number_text(b)))
        else if (b < 1.0_wp/largest .or. b > largest) then
            call set_status(status, st_out_of_range, 'b = yd/xd must be 1e-100 to 1e100, got ' // &
                            trim(number_text(b)))
        else if (abs(x) > largest) then
            call set_status(status, st_out_of_range, '|X| = |x/xd| must be at most 1e100, got ' // &
                            trim(number_text(x)))
        end if
    end subroutine check

    !> Edges of the strip; for n = 0 one half of it, counted twice.
    subroutine set_strip(n, b, side)
        integer, intent(in) :: n
        real(wp), intent(in) :: b
        type(side_t), intent(inout) :: side

        real(wp) :: distance

        distance = 2.0_wp*abs(real(n, wp))
        if (n == 0) then
            side%cl = 0.0_wp
            side%cr = b
            side%width = b
            side%squares = b*b
            side%factor = 2.0_wp
        else
            side%cl = (distance - 1.0_wp)*b
            side%cr = (distance + 1.0_wp)*b
            side%width = 2.0_wp*b
            side%squares = 4.0_wp*distance*b*b
            side%factor = 1.0_wp
        end if
    end subroutine set_strip

    !> |u - X| at tau.
    pure real(wp) function distance_at(tau, side)
        real(wp), intent(in) :: tau
        type(side_t), intent(in) :: side

        distance_at = side%outside + 2.0_wp*sin(side%a - 0.5_wp*tau)*sin(0.5_wp*tau)
    end function distance_at

    !> Weight times the logarithmic kernel.
    function line_integrand(tau, params) result(f) bind(c)
        real(c_double), value :: tau
        type(c_ptr), value :: params
        real(c_double) :: f

        type(side_t), pointer :: side
        real(wp) :: delta, sl, sr, d

        call c_f_pointer(params, side)
        delta = distance_at(tau, side)
        f = 0.0_wp
        if (.not. (delta + side%cl > 0.0_wp)) return
        sl = sqrt(delta*delta + side%cl*side%cl)
        sr = sqrt(delta*delta + side%cr*side%cr)
        if (side%cl > 0.0_wp) then
            d = (side%width + side%squares/(sr + sl))/(side%cl + sl)
            f = log_1p(d)
        else
            f = asinh(side%cr/delta)
        end if
        f = side%factor*sin(side%a - tau)**2*f
    end function line_integrand

    !> Weight times the inner integral over the strip's width, by quadrature.
    function area_integrand(tau, params) result(f) bind(c)
        real(c_double), value :: tau
        type(c_ptr), value :: params
        real(c_double) :: f

        type(side_t), pointer :: side
        type(gsl_function_t) :: inner
        real(c_double) :: error
        integer(c_int) :: code

        call c_f_pointer(params, side)
        side%delta = distance_at(tau, side)
        f = 0.0_wp
        if (.not. (side%delta + side%cl > 0.0_wp)) return
        inner%function = c_funloc(point_integrand)
        inner%params = params
        code = gsl_integration_qags(inner, side%cl, side%cr, 0.0_wp, tolerance_inner, limit, &
                                    side%workspace, f, error)
        if (code /= 0 .and. side%code == 0) side%code = code
        f = side%factor*sin(side%a - tau)**2*f
    end function area_integrand

    !> 1/sqrt((u - X)^2 + v^2).
    function point_integrand(v, params) result(f) bind(c)
        real(c_double), value :: v
        type(c_ptr), value :: params
        real(c_double) :: f

        type(side_t), pointer :: side

        call c_f_pointer(params, side)
        f = 1.0_wp/sqrt(side%delta*side%delta + v*v)
    end function point_integrand
end module faststrip_tables_quadrature
