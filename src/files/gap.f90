!> Reading an undeformed gap from a CSV file.
module faststrip_files_gap
    use faststrip_files_csv, only: csv_table_t, read_csv, require_column, column_index, &
                                   several_columns, cell_text
    use faststrip_base_kinds, only: wp
    use faststrip_geometry_gap, only: gap_t, min_gap_points
    use faststrip_base_status, only: status_t, is_error, st_not_increasing, st_too_few_points
    use faststrip_base_text, only: integer_text, set_place_status
    implicit none
    private

    public :: read_gap_file

contains

    !> Read the columns `y_mm`, `h_mm` and `inv2R_per_mm`, and `inclination_rad` if it is there, in
    !> any order; other columns are passed over, and so is a row that was written twice. Nothing is
    !> repaired: what `check_gap` would refuse is refused here with the file, the line, the value.
    subroutine read_gap_file(path, gap, status)
        character(len=*), intent(in) :: path   !! name of the file
        type(gap_t), intent(out) :: gap        !! the gap, mm, mm, 1/mm, rad; nothing allocated on
                                               !! an error
        type(status_t), intent(out) :: status  !! `st_file_missing`; `st_file_format`: a column is
                                               !! missing or a cell holds no finite number;
                                               !! `st_not_increasing`; `st_too_few_points`
        type(csv_table_t) :: table
        character(len=*), parameter :: names(3) = [character(len=12) :: &
            'y_mm', 'h_mm', 'inv2R_per_mm']
        type(status_t) :: read
        integer :: column(size(names) + 1), m, i, n, row, kept
        real(wp), allocatable :: values(:, :)

        call read_csv(path, table, status)
        if (is_error(status)) return
        do i = 1, size(names)
            call require_column(table, trim(names(i)), column(i), status)
            if (is_error(status)) return
        end do
        m = size(names)
        column(m + 1) = column_index(table, 'inclination_rad')
        if (column(m + 1) > 0) m = m + 1
        call several_columns(table, column(:m), values, n, read)
        kept = min(n, 1)
        do row = 2, n
            ! A row that was written twice is one.
            if (all(values(row, :) == values(kept, :))) cycle
            kept = kept + 1
            values(kept, :) = values(row, :)
            if (values(kept, 1) > values(kept - 1, 1)) cycle
            call set_place_status(status, st_not_increasing, &
                                  'y_mm must be above that of the row before', &
                                  cell_text(table, row, column(1)), path, table%line(row))
            return
        end do
        status = read
        if (is_error(status)) return
        n = kept
        if (n < min_gap_points) then
            call set_place_status(status, st_too_few_points, 'a gap must have at least ' // &
                                  integer_text(min_gap_points) // ' points', &
                                  integer_text(n), path, 0)
            return
        end if
        gap%y = values(:n, 1)
        gap%h = values(:n, 2)
        gap%inv2r = values(:n, 3)
        if (m > size(names)) gap%inclination = values(:n, m)
    end subroutine read_gap_file
end module faststrip_files_gap
