!> Sums of the influence columns with four numbers side by side: what four_lanes.c has for
!> processors with AVX2 and FMA.
!>
!> A processor is asked by `are_lanes_wanted`; where it says no, nothing else of here may be called.
!> The loops in Fortran beside each call serve everywhere. Results agree with theirs to 1e-15, as
!> far as the arguments' own rounding lets them: off the centre line, at c half-lengths from an
!> edge, to 1e-15 (1 + 1/sqrt(c)), and derivatives to 1e-15 (1 + 1/c). They depend neither on how
!> many points are in a call nor on their order.
module faststrip_influence_four_lanes
    use, intrinsic :: iso_c_binding, only: c_double, c_int
    implicit none
    private

    public :: are_lanes_wanted, lanes
    public :: near_center_lanes, near_center_value_lanes, far_center_lanes, far_center_value_lanes
    public :: far_rule_lanes, near_rule_lanes

    !> Arrays of the centre lines are read and written up to the next multiple.
    !> Given: doubles in a register of 256 bits.
    integer, parameter :: lanes = 4

    interface
        ! 1 if this processor has AVX2 and FMA.
        pure integer(c_int) function ask_processor() bind(C, name='influence_has_four_lanes')
            import
        end function ask_processor

        !> As near_center of faststrip_influence_center_column.
        pure subroutine near_center_lanes(n, least_ratio, width, cl, cr, a, b, value, slope) &
            bind(C, name='influence_near_center')
            import
            integer(c_int), intent(in), value :: n           !! field points
            real(c_double), intent(in), value :: least_ratio !! of the edges' distances
            real(c_double), intent(in) :: width(*)           !! between the edges
            real(c_double), intent(in) :: cl(*)              !! distance of the nearer edge
            real(c_double), intent(in) :: cr(*)              !! distance of the farther edge
            real(c_double), intent(in) :: a(0:19)            !! coefficients
            real(c_double), intent(in) :: b(0:20)            !! the same
            real(c_double), intent(inout) :: value(*)        !! the form's value
            real(c_double), intent(inout) :: slope(*)        !! its derivative
        end subroutine near_center_lanes

        !> The value alone.
        pure subroutine near_center_value_lanes(n, least_ratio, width, cl, cr, a, b, value) &
            bind(C, name='influence_near_center_value')
            import
            integer(c_int), intent(in), value :: n           !! field points
            real(c_double), intent(in), value :: least_ratio !! of the edges' distances
            real(c_double), intent(in) :: width(*)           !! between the edges
            real(c_double), intent(in) :: cl(*)              !! distance of the nearer edge
            real(c_double), intent(in) :: cr(*)              !! distance of the farther edge
            real(c_double), intent(in) :: a(0:19)            !! coefficients
            real(c_double), intent(in) :: b(0:20)            !! the same
            real(c_double), intent(inout) :: value(*)        !! the form's value
        end subroutine near_center_value_lanes

        !> As far_center of faststrip_influence_center_column.
        pure subroutine far_center_lanes(n, half_pi, centre, width, cl, cr, r, value, slope) &
            bind(C, name='influence_far_center')
            import
            integer(c_int), intent(in), value :: n       !! field points
            real(c_double), intent(in), value :: half_pi !! pi/2
            real(c_double), intent(in), value :: centre  !! of the coefficients' powers
            real(c_double), intent(in) :: width(*)       !! between the edges
            real(c_double), intent(in) :: cl(*)          !! distance of the nearer edge
            real(c_double), intent(in) :: cr(*)          !! distance of the farther edge
            real(c_double), intent(in) :: r(0:26)        !! coefficients
            real(c_double), intent(inout) :: value(*)    !! the form's value
            real(c_double), intent(inout) :: slope(*)    !! its derivative
        end subroutine far_center_lanes

        !> The value alone.
        pure subroutine far_center_value_lanes(n, half_pi, centre, width, cl, cr, r, value) &
            bind(C, name='influence_far_center_value')
            import
            integer(c_int), intent(in), value :: n       !! field points
            real(c_double), intent(in), value :: half_pi !! pi/2
            real(c_double), intent(in), value :: centre  !! of the coefficients' powers
            real(c_double), intent(in) :: width(*)       !! between the edges
            real(c_double), intent(in) :: cl(*)          !! distance of the nearer edge
            real(c_double), intent(in) :: cr(*)          !! distance of the farther edge
            real(c_double), intent(in) :: r(0:26)        !! coefficients
            real(c_double), intent(inout) :: value(*)    !! the form's value
        end subroutine far_center_value_lanes

        !> As far_sums of faststrip_influence_angle_sums.
        pure subroutine far_rule_lanes(last, n, u, x, cl, cr, c, s) &
            bind(C, name='influence_far_rule')
            import
            integer(c_int), intent(in), value :: last  !! of the kernel's powers: 4, 8, 12, 15, 16
            integer(c_int), intent(in), value :: n     !! nodes, even
            real(c_double), intent(in) :: u(n)         !! the nodes
            real(c_double), intent(in), value :: x     !! field point along the strip
            real(c_double), intent(in), value :: cl    !! the nearer edge less the field point's y
            real(c_double), intent(in), value :: cr    !! the farther edge less the field point's y
            real(c_double), intent(in) :: c(0:last)    !! of the kernel; of any width if last = 15
            real(c_double), intent(inout) :: s(3)      !! the sums, before their factor
        end subroutine far_rule_lanes

        !> As near_sums of faststrip_influence_angle_sums.
        pure subroutine near_rule_lanes(last, n, p, q, dp, dq, x, cl, cr, c, s) &
            bind(C, name='influence_near_rule')
            import
            integer(c_int), intent(in), value :: last  !! of the kernel's powers: 4, 8, 12, 15, 16
            integer(c_int), intent(in), value :: n     !! nodes, even
            real(c_double), intent(in) :: p(n)         !! the nodes: one_cosh
            real(c_double), intent(in) :: q(n)         !! one_sinh
            real(c_double), intent(in) :: dp(n)        !! d_cosh
            real(c_double), intent(in) :: dq(n)        !! d_sinh
            real(c_double), intent(in), value :: x     !! field point along the strip
            real(c_double), intent(in), value :: cl    !! the nearer edge less the field point's y
            real(c_double), intent(in), value :: cr    !! the farther edge less the field point's y
            real(c_double), intent(in) :: c(0:last)    !! of the kernel; of any width if last = 15
            real(c_double), intent(inout) :: s(3)      !! the sums, before their factor
        end subroutine near_rule_lanes
    end interface

contains

    !> Has this processor what the others here need, and may it be used?
    pure logical function are_lanes_wanted(portable)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        are_lanes_wanted = .false.
        if (present(portable)) then
            if (portable) return
        end if
        are_lanes_wanted = ask_processor() /= 0
    end function are_lanes_wanted
end module faststrip_influence_four_lanes
