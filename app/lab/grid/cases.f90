!> The sets of contacts that benches measure, with the figures of a reference: those of the paper's
!> section 5 and Hertz ellipses under many creepages, by CONTACT; contacts of many kinds, by NORM
!> and TANG. See `reference/README.md`.
module faststrip_lab_grid_cases
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, st_file_format
    use faststrip_files_csv, only: csv_table_t, read_csv, column_numbers, require_column, cell_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_numerics_elliptic, only: complete_elliptic, complete_elliptic_d
    use faststrip_files_gap, only: read_gap_file
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_grid_ellipse, only: parabolic_gap
    use faststrip_lab_random_reference_gaps, only: reference_scene_t, make_reference_scene
    implicit none
    private

    public :: bench_case_t, read_bench_cases, read_ellipse_cases, read_scene_cases, read_rows
    public :: scattered

    !> One contact and what a reference finds for it.
    type, extends(contact_case_t) :: bench_case_t
        character(len=:), allocatable :: set   !! where it comes from
        character(len=:), allocatable :: name  !! its name there
        character(len=:), allocatable :: group !! of the set, that it belongs to
        real(wp) :: shift = 0.0_wp             !! lateral shift of the wheelset, mm
        real(wp) :: a = 0.0_wp, b = 0.0_wp     !! semi-axes of an ellipse, mm
        type(normal_result_t) :: known         !! of CONTACT the area extrapolated in the grid
        logical :: area_counts = .true.        !! is the area known better than to an element?
        real(wp) :: forces(3) = 0.0_wp         !! Fx, Fy, N, and Mz, N mm, extrapolated
        real(wp) :: stick_fraction = 0.0_wp    !! of its elements
    end type bench_case_t

    integer, parameter :: ellipse_points = 401

contains

    !> Read `s1002_uic60_B.csv` of a folder, or that of the other sign set, and the gap files it
    !> stands for. They are of like bodies. Like all readers here it ends the program if a file
    !> cannot be read.
    subroutine read_bench_cases(folder, cases, signs)
        character(len=*), intent(in) :: folder                     !! name of the folder
        type(bench_case_t), allocatable, intent(out) :: cases(:)   !! one a row
        character(len=1), intent(in), optional :: signs            !! of the creepages, A or B

        character(len=*), parameter :: names(15) = [character(len=16) :: &
            'yw_mm', 'Fn_N', 'cksi', 'ceta', 'cphi_rad_per_mm', 'penetration_mm', 'pmax_MPa', &
            'area_extrap_mm2', 'ymin_mm', 'ymax_mm', 'Fx_extrap_N', 'Fy_extrap_N', &
            'Mz_extrap_Nmm', 'n_adhesion', 'n_contact']
        character(len=:), allocatable :: words(:)
        real(wp), allocatable :: values(:, :)
        type(status_t) :: status
        character(len=1) :: letter
        integer :: i

        letter = 'B'
        if (present(signs)) letter = signs
        call read_rows(folder // '/s1002_uic60_' // letter // '.csv', names, values, 'yw_mm', words)
        allocate (cases(size(words)))
        do i = 1, size(cases)
            cases(i)%set = 's1002_uic60'
            cases(i)%name = 'shift_' // trim(words(i))
            cases(i)%group = 'all'
            cases(i)%shift = values(i, 1)
            cases(i)%load = values(i, 2)
            cases(i)%creepage = creepage_t(values(i, 3), values(i, 4), values(i, 5))
            cases(i)%known%penetration = values(i, 6)
            cases(i)%known%pmax = values(i, 7)
            cases(i)%known%area = values(i, 8)
            cases(i)%known%y_min = values(i, 9)
            cases(i)%known%y_max = values(i, 10)
            cases(i)%forces = values(i, 11:13)
            cases(i)%stick_fraction = values(i, 14)/values(i, 15)
            call read_gap_file(folder // '/gaps/' // cases(i)%name // '.csv', cases(i)%gap, status)
            call fail_on_error(status)
        end do
    end subroutine read_bench_cases

    !> Read `hertz_creep.csv` of a folder: forces by CONTACT, the rest exact.
    subroutine read_ellipse_cases(folder, cases)
        character(len=*), intent(in) :: folder                     !! name of the folder
        type(bench_case_t), allocatable, intent(out) :: cases(:)   !! one a row

        character(len=*), parameter :: names(14) = [character(len=9) :: &
            'a_mm', 'b_mm', 'G', 'nu', 'mu', 'N', 'cksi', 'ceta', 'cphi', 'Fx_extrap', &
            'Fy_extrap', 'Mz_extrap', 'n_adh', 'n_con']
        character(len=:), allocatable :: words(:)
        real(wp), allocatable :: values(:, :)
        real(wp) :: young, inv2r_x, inv2r_y
        integer :: i

        call read_rows(folder // '/hertz_creep.csv', names, values, 'case', words)
        allocate (cases(size(words)))
        do i = 1, size(cases)
            associate (row => values(i, :))
                cases(i)%set = 'hertz'
                cases(i)%name = 'row_' // integer_text(i)
                cases(i)%group = trim(words(i))
                cases(i)%a = row(1)
                cases(i)%b = row(2)
                young = 2.0_wp*row(3)*(1.0_wp + row(4))
                cases(i)%material = material_t(young, young, row(4), row(4))
                cases(i)%mu = row(5)
                cases(i)%load = row(6)
                cases(i)%creepage = creepage_t(row(7), row(8), row(9))
                cases(i)%known%area = pi*row(1)*row(2)
                cases(i)%known%pmax = 1.5_wp*row(6)/(pi*row(1)*row(2))
                cases(i)%forces = row(10:12)
                cases(i)%stick_fraction = row(13)/row(14)
                call ellipse_gap(row(1), row(2), row(6)*normal_compliance(cases(i)%material), &
                                 inv2r_x, inv2r_y, cases(i)%known%penetration)
                cases(i)%gap = parabolic_gap(inv2r_x, inv2r_y, row(2), ellipse_points)
            end associate
        end do
    end subroutine read_ellipse_cases

    !> Read the contacts of many kinds, their figures by Kalker's method.
    subroutine read_scene_cases(file, cases)
        character(len=*), intent(in) :: file                     !! `scenes.csv`
        type(bench_case_t), allocatable, intent(out) :: cases(:) !! one a row

        character(len=*), parameter :: names(11) = [character(len=15) :: &
            'number', 'cksi', 'ceta', 'cphi_rad_per_mm', 'penetration_mm', 'pmax_MPa', &
            'area_mm2', 'Fx_extrap_N', 'Fy_extrap_N', 'Mz_extrap_Nmm', 'stick_fraction']
        type(reference_scene_t) :: scene
        real(wp), allocatable :: values(:, :)
        integer :: i

        call read_rows(file, names, values)
        allocate (cases(size(values, 1)))
        do i = 1, size(cases)
            associate (row => values(i, :))
                call make_reference_scene(nint(row(1)), scene)
                cases(i)%contact_case_t = scene%contact_case_t
                cases(i)%set = 'scenes'
                cases(i)%name = integer_text(scene%number)
                cases(i)%group = trim(merge('even', 'odd ', modulo(scene%number, 2) == 0))
                cases(i)%creepage = creepage_t(row(2), row(3), row(4))
                cases(i)%known%penetration = row(5)
                cases(i)%known%pmax = row(6)
                cases(i)%known%area = row(7)
                cases(i)%area_counts = .false.
                cases(i)%forces = row(8:10)
                cases(i)%stick_fraction = row(11)
            end associate
        end do
    end subroutine read_scene_cases

    !> Which of n contacts is the k-th where time may run out: scattered, so that what is left out
    !> is no end of a sweep.
    pure integer function scattered(k, n)
        integer, intent(in) :: k, n !! 1 to n; contacts

        scattered = k
        if (modulo(n, 7) /= 0) scattered = 1 + modulo(7*(k - 1), n)
    end function scattered

    !> The curvatures under which a load makes a given ellipse, and the penetration
    !> (`faststrip_normal_simple_hertz`, read backwards).
    pure subroutine ellipse_gap(a, b, load_compliance, inv2r_x, inv2r_y, penetration)
        real(wp), intent(in) :: a, b            ! semi-axes, mm
        real(wp), intent(in) :: load_compliance ! Q H, mm2
        real(wp), intent(out) :: inv2r_x, inv2r_y, penetration

        real(wp) :: k, e, d, along, across, long

        long = max(a, b)
        call complete_elliptic((min(a, b)/long)**2, k, e)
        d = complete_elliptic_d((min(a, b)/long)**2)
        along = 1.5_wp*load_compliance*d/long**3
        across = 1.5_wp*load_compliance*(k - d)/(long*min(a, b)**2)
        inv2r_x = merge(along, across, a >= b)
        inv2r_y = merge(across, along, a >= b)
        penetration = 1.5_wp*load_compliance*k/long
    end subroutine ellipse_gap

    !> Read numbers, and words beside them, at least one row.
    subroutine read_rows(file, names, values, name, words)
        character(len=*), intent(in) :: file                !! CSV
        character(len=*), intent(in) :: names(:)            !! of the columns of numbers
        real(wp), allocatable, intent(out) :: values(:, :)  !! rows by names
        character(len=*), intent(in), optional :: name      !! of the column of words
        character(len=:), allocatable, intent(out), optional :: words(:)

        ! Of a shift or of what creepages are.
        integer, parameter :: longest_word = 40
        type(csv_table_t) :: table
        type(status_t) :: status
        real(wp), allocatable :: numbers(:)
        integer :: i, column

        call read_csv(file, table, status)
        call fail_on_error(status)
        allocate (values(table%n_rows, size(names)))
        do i = 1, size(names)
            call column_numbers(table, trim(names(i)), numbers, status)
            call fail_on_error(status)
            values(:, i) = numbers
        end do
        if (table%n_rows == 0) &
            call set_place_status(status, st_file_format, 'no contacts', '', table%file, 0)
        call fail_on_error(status)
        if (.not. present(words)) return
        call require_column(table, name, column, status)
        call fail_on_error(status)
        allocate (character(len=longest_word) :: words(table%n_rows))
        do i = 1, table%n_rows
            words(i) = cell_text(table, i, column)
        end do
    end subroutine read_rows
end module faststrip_lab_grid_cases
