!> Influence columns with numbers side by side: what four_lanes.c has, four for processors with AVX2
!> and FMA, two for any.
!>
!> Results of both agree as far as the arguments' own rounding lets them: on the centre line to
!> 1e-15 (1 + c/w), w the strip's width and c the distance of its farther edge; off it, at c
!> half-lengths from an edge, to 1e-15 (1 + 1/sqrt(c)), and derivatives to 1e-15 (1 + 1/c). They
!> depend neither on how many points are in a call nor on their order.
!>
!> Columns say how far they got: 1, all points; 0, without some that have the value 0; -1, without
!> all, and nothing is set: the strip is larger than `largest` or no number.
module faststrip_influence_four_lanes
    use, intrinsic :: iso_c_binding, only: c_double, c_int
    implicit none
    private

    public :: lanes_for, column_t, center_lanes, off_center_lanes

    !> A strip and how many field points see it.
    type, bind(C) :: column_t
        integer(c_int) :: by           !! lanes, 4 or 2
        integer(c_int) :: n            !! field points
        real(c_double) :: largest      !! place, mm
        real(c_double) :: half_length  !! of the strip, mm
        real(c_double) :: y_left       !! its left edge, mm
        real(c_double) :: y_right      !! its right edge, mm
    end type column_t

    interface
        ! 4 if this processor has AVX2 and FMA, else 2; 0 if the compiler has no vectors.
        pure integer(c_int) function ask_processor() bind(C, name='influence_lanes')
            import
        end function ask_processor

        !> Points of a centre line, by G(c) on both sides of c = 1.
        pure subroutine center_lanes(column, y, small, large, middle, value, slope, found) &
            bind(C, name='influence_center')
            import
            type(column_t), intent(in) :: column         !! the strip
            real(c_double), intent(in) :: y(*)           !! the field points, mm
            real(c_double), intent(in) :: small(4, 0:20) !! powers of c^2: A, B of G, of G - c G'
            real(c_double), intent(in) :: large(2, 0:26) !! of 1/c^2 - middle: R of the same
            real(c_double), intent(in) :: middle         !! of these powers
            real(c_double), intent(inout) :: value(*)    !! influence, mm
            real(c_double), intent(inout), optional :: slope(*) !! its derivative in the half-length
            integer(c_int), intent(inout) :: found       !! how far it got
        end subroutine center_lanes

        !> Points off a centre line, by the rules of faststrip_influence_angle_rules; those that no
        !> rule serves have the value 0.
        pure subroutine off_center_lanes(column, x, y, size, table, node, value, d_x, &
                                         d_half_length, found) &
            bind(C, name='influence_off_center')
            import
            type(column_t), intent(in) :: column      !! the strip
            real(c_double), intent(in) :: x(*)        !! the field points along, mm
            real(c_double), intent(in) :: y(*)        !! the field points across, mm
            integer(c_int), intent(in) :: size(9, 2)  !! column_size
            real(c_double), intent(in) :: table(105)  !! limits and series of the accuracy
            real(c_double), intent(in) :: node(*)     !! column_node from the accuracy on
            real(c_double), intent(inout) :: value(*) !! influence, mm
            real(c_double), intent(inout) :: d_x(*)   !! its derivative in x
            real(c_double), intent(inout) :: d_half_length(*) !! and in the half-length
            integer(c_int), intent(inout) :: found    !! how far it got
        end subroutine off_center_lanes
    end interface

contains

    !> So many numbers side by side: 4, 2, or 0 for none; then no other procedure of here may be
    !> called.
    pure integer(c_int) function lanes_for(portable)
        logical, intent(in), optional :: portable !! by what any processor has; default: if need be

        lanes_for = ask_processor()
        if (present(portable)) then
            if (portable) lanes_for = min(2_c_int, lanes_for)
        end if
    end function lanes_for
end module faststrip_influence_four_lanes
