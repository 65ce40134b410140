!> The contacts that are measured, solved by CONTACT: those of the paper's section 5, and Hertz
!> ellipses under many creepages.
module faststrip_lab_grid_cases
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error, st_file_format
    use faststrip_files_csv, only: csv_table_t, read_csv, column_numbers, require_column, cell_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t
    use faststrip_files_gap, only: read_gap_file
    use faststrip_base_text, only: set_place_status
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    implicit none
    private

    public :: bench_case_t, read_bench_cases, read_ellipse_cases, read_columns

    !> One contact and what CONTACT finds for it.
    type, extends(contact_case_t) :: bench_case_t
        character(len=:), allocatable :: name !! `shift_` and the lateral shift; of an ellipse, what
                                              !! its creepages are
        real(wp) :: shift = 0.0_wp            !! lateral shift of the wheelset, mm
        real(wp) :: a = 0.0_wp, b = 0.0_wp    !! semi-axes of an ellipse, mm
        type(normal_result_t) :: truth        !! by CONTACT; the area extrapolated in the grid
        real(wp) :: forces(3) = 0.0_wp        !! Fx, Fy, N, and Mz, N mm, by CONTACT, extrapolated
        real(wp) :: stick_fraction = 0.0_wp   !! of its elements
    end type bench_case_t

contains

    !> Read `s1002_uic60_B.csv` of a folder, or that of the other sign set, and the gap files it
    !> stands for. They are of like bodies.
    subroutine read_bench_cases(folder, cases, status, signs)
        character(len=*), intent(in) :: folder                     !! name of the folder
        type(bench_case_t), allocatable, intent(out) :: cases(:)   !! one a row
        type(status_t), intent(out) :: status                      !! of the readers
        character(len=1), intent(in), optional :: signs            !! of the creepages, A or B

        character(len=*), parameter :: names(15) = [character(len=16) :: &
            'yw_mm', 'Fn_N', 'cksi', 'ceta', 'cphi_rad_per_mm', 'penetration_mm', 'pmax_MPa', &
            'area_extrap_mm2', 'ymin_mm', 'ymax_mm', 'Fx_extrap_N', 'Fy_extrap_N', &
            'Mz_extrap_Nmm', 'n_adhesion', 'n_contact']
        character(len=:), allocatable :: words(:)
        real(wp), allocatable :: values(:, :)
        character(len=1) :: letter
        integer :: i

        letter = 'B'
        if (present(signs)) letter = signs
        call read_rows(folder // '/s1002_uic60_' // letter // '.csv', 'yw_mm', names, words, &
                       values, status)
        allocate (cases(size(words)))
        if (is_error(status)) return
        do i = 1, size(cases)
            cases(i)%name = 'shift_' // trim(words(i))
            cases(i)%shift = values(i, 1)
            cases(i)%load = values(i, 2)
            cases(i)%creepage = creepage_t(values(i, 3), values(i, 4), values(i, 5))
            cases(i)%truth%penetration = values(i, 6)
            cases(i)%truth%pmax = values(i, 7)
            cases(i)%truth%area = values(i, 8)
            cases(i)%truth%y_min = values(i, 9)
            cases(i)%truth%y_max = values(i, 10)
            cases(i)%forces = values(i, 11:13)
            cases(i)%stick_fraction = values(i, 14)/values(i, 15)
            call read_gap_file(folder // '/gaps/' // cases(i)%name // '.csv', cases(i)%gap, status)
            if (is_error(status)) return
        end do
    end subroutine read_bench_cases

    !> Read `hertz_creep.csv` of a folder; these cases have no gap.
    subroutine read_ellipse_cases(folder, cases, status)
        character(len=*), intent(in) :: folder                     !! name of the folder
        type(bench_case_t), allocatable, intent(out) :: cases(:)   !! one a row
        type(status_t), intent(out) :: status                      !! of the reader

        character(len=*), parameter :: names(14) = [character(len=9) :: &
            'a_mm', 'b_mm', 'G', 'nu', 'mu', 'N', 'cksi', 'ceta', 'cphi', 'Fx_extrap', &
            'Fy_extrap', 'Mz_extrap', 'n_adh', 'n_con']
        character(len=:), allocatable :: words(:)
        real(wp), allocatable :: values(:, :)
        real(wp) :: young
        integer :: i

        call read_rows(folder // '/hertz_creep.csv', 'case', names, words, values, status)
        allocate (cases(size(words)))
        if (is_error(status)) return
        do i = 1, size(cases)
            associate (row => values(i, :))
                cases(i)%name = trim(words(i))
                cases(i)%a = row(1)
                cases(i)%b = row(2)
                young = 2.0_wp*row(3)*(1.0_wp + row(4))
                cases(i)%material = material_t(young, young, row(4), row(4))
                cases(i)%mu = row(5)
                cases(i)%load = row(6)
                cases(i)%creepage = creepage_t(row(7), row(8), row(9))
                cases(i)%truth%area = pi*row(1)*row(2)
                cases(i)%truth%pmax = 1.5_wp*row(6)/(pi*row(1)*row(2))
                cases(i)%forces = row(10:12)
                cases(i)%stick_fraction = row(13)/row(14)
            end associate
        end do
    end subroutine read_ellipse_cases

    ! The words of one column and the numbers of others, at least one row.
    subroutine read_rows(file, name, names, words, values, status)
        character(len=*), intent(in) :: file, name, names(:)
        character(len=:), allocatable, intent(out) :: words(:)
        real(wp), allocatable, intent(out) :: values(:, :)
        type(status_t), intent(out) :: status

        ! Of a shift or of what creepages are.
        integer, parameter :: longest_word = 40
        type(csv_table_t) :: table
        integer :: i, column

        allocate (character(len=longest_word) :: words(0))
        call read_csv(file, table, status)
        if (is_error(status)) return
        call read_columns(table, names, values, status)
        if (is_error(status)) return
        if (table%n_rows == 0) then
            call set_place_status(status, st_file_format, 'no contacts', '', table%file, 0)
            return
        end if
        call require_column(table, name, column, status)
        if (is_error(status)) return
        deallocate (words)
        allocate (character(len=longest_word) :: words(table%n_rows))
        do i = 1, table%n_rows
            words(i) = cell_text(table, i, column)
        end do
    end subroutine read_rows

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
