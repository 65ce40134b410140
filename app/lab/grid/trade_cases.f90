!> The contacts on which accuracy is traded for time, with the figures of a reference.
module faststrip_lab_grid_trade_cases
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, read_csv
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_creepage, only: creepage_t
    use faststrip_numerics_elliptic, only: complete_elliptic, complete_elliptic_d
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, read_ellipse_cases, &
                                        read_columns
    use faststrip_lab_random_reference_gaps, only: reference_scene_t, make_reference_scene
    implicit none
    private

    public :: trade_case_t, read_wheelset_cases, read_hertz_cases, read_scene_cases

    !> Figures a contact is judged by.
    integer, parameter, public :: n_figures = 6
    character(len=*), parameter, public :: figure_names(n_figures) = [character(len=11) :: &
        'penetration', 'pmax', 'area', 'Fx', 'Fy', 'Mz']

    !> One contact and what a reference finds for it.
    type, extends(contact_case_t) :: trade_case_t
        character(len=:), allocatable :: set  !! where it comes from
        character(len=:), allocatable :: name !! its name there
        real(wp) :: truth(n_figures) = 0.0_wp !! as `figure_names`: mm, MPa, mm2, N, N, N mm
        logical :: area_counts = .true.       !! is the area known better than to an element?
    end type trade_case_t

    integer, parameter :: hertz_points = 401
    real(wp), parameter :: hertz_reach = 2.0_wp ! of the semi-axis

contains

    !> The contacts of a sweep that CONTACT has solved; see `reference/README.md`.
    subroutine read_wheelset_cases(folder, cases, status)
        character(len=*), intent(in) :: folder                   !! with the sweep and gaps/
        type(trade_case_t), allocatable, intent(out) :: cases(:) !! one a row
        type(status_t), intent(out) :: status                    !! of the readers

        type(bench_case_t), allocatable :: solved(:)
        integer :: i

        call read_bench_cases(folder, solved, status)
        allocate (cases(size(solved)))
        if (is_error(status)) return
        do i = 1, size(cases)
            cases(i)%contact_case_t = solved(i)%contact_case_t
            cases(i)%set = 's1002_uic60'
            cases(i)%name = solved(i)%name
            cases(i)%mu = 0.3_wp
            associate (truth => solved(i)%truth)
                cases(i)%truth = [truth%penetration, truth%pmax, truth%area, solved(i)%forces]
            end associate
        end do
    end subroutine read_wheelset_cases

    !> Hertz ellipses under many creepages, the forces by CONTACT, the rest exact.
    subroutine read_hertz_cases(folder, cases, status)
        character(len=*), intent(in) :: folder                   !! with `hertz_creep.csv`
        type(trade_case_t), allocatable, intent(out) :: cases(:) !! one a row
        type(status_t), intent(out) :: status                    !! of the reader

        type(bench_case_t), allocatable :: solved(:)
        real(wp) :: inv2r_x, inv2r_y
        integer :: i, k

        call read_ellipse_cases(folder, solved, status)
        allocate (cases(size(solved)))
        if (is_error(status)) return
        do i = 1, size(cases)
            associate (case => cases(i), b => solved(i)%b)
                case%contact_case_t = solved(i)%contact_case_t
                case%set = 'hertz'
                case%name = 'row_' // integer_text(i)
                call ellipse_gap(solved(i)%a, b, case%load*normal_compliance(case%material), &
                                 inv2r_x, inv2r_y, case%truth(1))
                case%truth(2:) = [solved(i)%truth%pmax, solved(i)%truth%area, solved(i)%forces]
                allocate (case%gap%y(hertz_points), case%gap%h(hertz_points), &
                          case%gap%inv2r(hertz_points))
                do k = 1, hertz_points
                    case%gap%y(k) = hertz_reach*b*(2*k - 1 - hertz_points)/(hertz_points - 1)
                    case%gap%h(k) = inv2r_y*case%gap%y(k)**2
                    case%gap%inv2r(k) = inv2r_x
                end do
            end associate
        end do
    end subroutine read_hertz_cases

    !> The contacts of many kinds, their figures by Kalker's method; see `reference/README.md`.
    subroutine read_scene_cases(file, cases, status)
        character(len=*), intent(in) :: file                     !! `scenes.csv`
        type(trade_case_t), allocatable, intent(out) :: cases(:) !! one a row
        type(status_t), intent(out) :: status                    !! of the reader

        character(len=*), parameter :: names(10) = [character(len=15) :: &
            'number', 'cksi', 'ceta', 'cphi_rad_per_mm', 'penetration_mm', 'pmax_MPa', &
            'area_mm2', 'Fx_extrap_N', 'Fy_extrap_N', 'Mz_extrap_Nmm']
        type(csv_table_t) :: table
        type(reference_scene_t) :: scene
        real(wp), allocatable :: values(:, :)
        integer :: i

        call read_csv(file, table, status)
        if (.not. is_error(status)) call read_columns(table, names, values, status)
        allocate (cases(table%n_rows))
        if (is_error(status)) return
        do i = 1, size(cases)
            call make_reference_scene(nint(values(i, 1)), scene)
            cases(i)%set = 'scenes'
            cases(i)%name = integer_text(scene%number)
            cases(i)%material = scene%material
            cases(i)%mu = scene%mu
            cases(i)%load = scene%load
            cases(i)%creepage = creepage_t(values(i, 2), values(i, 3), values(i, 4))
            cases(i)%truth = values(i, 5:10)
            cases(i)%area_counts = .false.
            cases(i)%gap = scene%gap
        end do
    end subroutine read_scene_cases

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
end module faststrip_lab_grid_trade_cases
