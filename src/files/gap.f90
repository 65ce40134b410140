!> Reading an undeformed gap from a CSV file.
module faststrip_files_gap
    use faststrip_files_csv, only: csv_table_t, read_csv, require_column, cell_number, cell_text
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap, only: gap_t, min_gap_points
    use faststrip_base_status, only: status_t, is_error, st_not_increasing, st_too_few_points
    use faststrip_base_text, only: integer_text, set_place_status
    implicit none
    private

    public :: read_gap_file

contains

    !> Read the columns `y_mm`, `h_mm` and `inv2R_per_mm`, in any order; other columns are passed
    !> over. Nothing is repaired: what `check_gap` would refuse is refused here with the file,
    !> the line and the value.
    subroutine read_gap_file(path, gap, status)
        character(len=*), intent(in) :: path   !! name of the file
        type(gap_t), intent(out) :: gap        !! the gap, mm, mm, 1/mm; nothing allocated on an
                                               !! error
        type(status_t), intent(out) :: status  !! `st_file_missing`; `st_file_format`: a column is
                                               !! missing or a cell holds no finite number;
                                               !! `st_not_increasing`; `st_too_few_points`
        type(csv_table_t) :: table
        integer :: y_column, h_column, inv2r_column, row
        real(wp), allocatable :: y(:), h(:), inv2r(:)

        call read_csv(path, table, status)
        if (is_error(status)) return
        call require_column(table, 'y_mm', y_column, status)
        if (is_error(status)) return
        call require_column(table, 'h_mm', h_column, status)
        if (is_error(status)) return
        call require_column(table, 'inv2R_per_mm', inv2r_column, status)
        if (is_error(status)) return
        allocate (y(table%n_rows), h(table%n_rows), inv2r(table%n_rows), source=0.0_wp)
        do row = 1, table%n_rows
            call cell_number(table, row, y_column, y(row), status)
            if (is_error(status)) return
            call cell_number(table, row, h_column, h(row), status)
            if (is_error(status)) return
            call cell_number(table, row, inv2r_column, inv2r(row), status)
            if (is_error(status)) return
            if (row == 1) cycle
            if (y(row) <= y(max(row - 1, 1))) then
                call set_place_status(status, st_not_increasing, &
                                      'y_mm must be above that of the row before', &
                                      cell_text(table, row, y_column), path, table%line(row))
                return
            end if
        end do
        if (table%n_rows < min_gap_points) then
            call set_place_status(status, st_too_few_points, 'a gap must have at least ' // &
                                  integer_text(min_gap_points) // ' points', &
                                  integer_text(table%n_rows), path, 0)
            return
        end if
        call move_alloc(y, gap%y)
        call move_alloc(h, gap%h)
        call move_alloc(inv2r, gap%inv2r)
    end subroutine read_gap_file
end module faststrip_files_gap
