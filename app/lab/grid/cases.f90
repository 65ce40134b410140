!> The contacts that are measured: those of the paper's section 5, solved by CONTACT.
module faststrip_lab_grid_cases
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_file_format
    use faststrip_files_csv, only: csv_table_t, read_csv, column_numbers, require_column, cell_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_files_gap, only: read_gap_file
    use faststrip_base_text, only: set_place_status
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    implicit none
    private

    public :: bench_case_t, read_bench_cases, read_columns

    !> One contact and what CONTACT finds for it.
    type, extends(contact_case_t) :: bench_case_t
        character(len=:), allocatable :: name !! `shift_` and the lateral shift
        real(wp) :: shift = 0.0_wp            !! lateral shift of the wheelset, mm
        type(normal_result_t) :: truth        !! by CONTACT; the area extrapolated in the grid
        real(wp) :: forces(3) = 0.0_wp        !! Fx, Fy, N, and Mz, N mm, by CONTACT, extrapolated
    end type bench_case_t

contains

    !> Read `s1002_uic60_B.csv` of a folder, or that of the other sign set, and the gap files it
    !> stands for.
    subroutine read_bench_cases(folder, cases, status, signs)
        character(len=*), intent(in) :: folder                     !! name of the folder
        type(bench_case_t), allocatable, intent(out) :: cases(:)   !! one a row
        type(status_t), intent(out) :: status                      !! of the readers
        character(len=1), intent(in), optional :: signs            !! of the creepages, A or B

        character(len=*), parameter :: names(13) = [character(len=16) :: &
            'yw_mm', 'Fn_N', 'cksi', 'ceta', 'cphi_rad_per_mm', 'penetration_mm', 'pmax_MPa', &
            'area_extrap_mm2', 'ymin_mm', 'ymax_mm', 'Fx_extrap_N', 'Fy_extrap_N', &
            'Mz_extrap_Nmm']
        type(csv_table_t) :: table
        real(wp), allocatable :: values(:, :)
        character(len=1) :: letter
        integer :: i, shift_column

        letter = 'B'
        if (present(signs)) letter = signs
        allocate (cases(0))
        call read_csv(folder // '/s1002_uic60_' // letter // '.csv', table, status)
        if (is_error(status)) return
        call read_columns(table, names, values, status)
        if (is_error(status)) return
        if (table%n_rows == 0) then
            call set_place_status(status, st_file_format, 'no contacts', '', table%file, 0)
            return
        end if
        call require_column(table, 'yw_mm', shift_column, status)
        deallocate (cases)
        allocate (cases(table%n_rows))
        do i = 1, size(cases)
            cases(i)%name = 'shift_' // cell_text(table, i, shift_column)
            cases(i)%shift = values(i, 1)
            cases(i)%load = values(i, 2)
            cases(i)%creepage = creepage_t(values(i, 3), values(i, 4), values(i, 5))
            cases(i)%truth%penetration = values(i, 6)
            cases(i)%truth%pmax = values(i, 7)
            cases(i)%truth%area = values(i, 8)
            cases(i)%truth%y_min = values(i, 9)
            cases(i)%truth%y_max = values(i, 10)
            cases(i)%forces = values(i, 11:13)
            call read_gap_file(folder // '/gaps/' // cases(i)%name // '.csv', cases(i)%gap, status)
            if (is_error(status)) return
        end do
    end subroutine read_bench_cases

    !> The numbers of several columns.
    subroutine read_columns(table, names, values, status)
        type(csv_table_t), intent(in) :: table             !! a table that was read
        character(len=*), intent(in) :: names(:)           !! of the columns
        real(wp), allocatable, intent(out) :: values(:, :) !! rows by names
        type(status_t), intent(out) :: status              !! of `column_numbers`

        real(wp), allocatable :: column(:)
        integer :: i

        allocate (values(table%n_rows, size(names)), source=0.0_wp)
        do i = 1, size(names)
            call column_numbers(table, trim(names(i)), column, status)
            if (is_error(status)) return
            values(:, i) = column
        end do
    end subroutine read_columns
end module faststrip_lab_grid_cases
