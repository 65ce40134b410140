!> Whole columns of influence coefficients: one strip that carries pressure, many field points.
!>
!> A column is what the matrix of the strip method is filled by: the source strip has half-length
!> xd and edges y_left, y_right; field point k lies at (x_k, y_k). All lengths are in mm. This
!> module gathers what stands in one module for each kind of column:
!>
!> - faststrip_influence_equal_column: equal strips, the classic table;
!> - faststrip_influence_center_column: any edges, field points on the centre line;
!> - faststrip_influence_offcentre_column: any edges, field points anywhere.
!>
!> What fits no vector form (edges on both sides of the field point, strips wide for their distance,
!> extreme sizes, arguments that are not finite) goes to the scalar procedures, so that every
!> argument has its answer. Nothing here allocates or raises a floating-point exception.
module faststrip_influence_row
    use faststrip_influence_equal_column, only: influence_column
    use faststrip_influence_center_column, only: center_influence_column, &
                                                 center_influence_column_gradient
    use faststrip_influence_offcentre_column, only: influence_column_at, influence_column_gradient
    implicit none
    private

    public :: influence_column, center_influence_column, center_influence_column_gradient
    public :: influence_column_at, influence_column_gradient
end module faststrip_influence_row
