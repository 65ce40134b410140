!> `faststrip-lab bench rolling`: errors and times of TANG against CONTACT.
module faststrip_lab_studies_rolling
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error, status_word, number_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_base_material, only: material_t
    use faststrip_kalker_normal, only: norm_workspace_t, norm_options_t
    use faststrip_lab_pressures, only: solve_by_norm
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           scheme_first_order, scheme_second_order, edges_of_norm, &
                                           edges_sampled
    use faststrip_kalker_tangential_pressures, only: sample_ellipse
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, read_ellipse_cases
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    implicit none
    private

    public :: bench_rolling

    real(wp), parameter :: mu = 0.3_wp
    real(wp), parameter :: sides(2) = [0.4_wp, 0.2_wp] ! of elements, mm
    integer, parameter :: schemes(2) = [scheme_first_order, scheme_second_order]
    character(len=*), parameter :: scheme_names(2) = [character(len=6) :: 'first', 'second']
    integer, parameter :: most_elements = 1000000

    !> Sums of one group of cases.
    type :: group_t
        integer :: n = 0
        integer :: failed = 0
        real(wp) :: total(3) = 0.0_wp, largest(3) = 0.0_wp, seconds = 0.0_wp
    end type group_t

contains

    !> Solve everything, write the CSV and say the mean and the largest errors.
    subroutine bench_rolling(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts and hertz_creep.csv

        type(csv_writer_t) :: writer

        call begin_table(writer, file)
        call put_comment(writer, 'forces of TANG less those of CONTACT, extrapolated, in % of ' &
                         // 'mu N (fx, fy) and mu N c (mz), pi c^2 the area; processor time')
        call put_header(writer, [character(len=13) :: 'group', 'case', 'scheme', 'dx_mm', 'dy_mm', &
                                 'status', 'elements', 'fx_err_pct', 'fy_err_pct', 'mz_err_pct', &
                                 'steps', 'products', 'tang_s'])
        call paper_contacts(folder, 'A', writer)
        call paper_contacts(folder, 'B', writer)
        call ellipses(folder, writer)
        call end_table(writer)
    end subroutine bench_rolling

    !> The paper's contacts, pressures by NORM.
    subroutine paper_contacts(folder, signs, writer)
        character(len=*), intent(in) :: folder
        character(len=1), intent(in) :: signs !! of the creepages, A or B
        type(csv_writer_t), intent(inout) :: writer

        type(bench_case_t), allocatable :: cases(:)
        type(norm_workspace_t) :: norm
        type(norm_options_t) :: norm_options
        type(normal_result_t) :: normal
        type(tang_workspace_t) :: tang
        type(group_t) :: groups(size(schemes))
        type(status_t) :: status
        integer :: i, k, side

        call read_bench_cases(folder, cases, signs)
        do side = 1, size(sides)
            groups = group_t()
            norm_options%dx = sides(side)
            norm_options%dy = sides(side)
            do i = 1, size(cases)
                call solve_by_norm(norm, cases(i), norm_options, normal, status)
                call fail_on_error(status)
                do k = 1, size(schemes)
                    call compare('paper_' // signs, cases(i), cases(i)%name, edges_of_norm, k, &
                                 norm%grid, tang, groups(k), writer)
                end do
            end do
            do k = 1, size(schemes)
                call tell('paper''s contacts, signs ' // signs // ', ' // &
                          trim(number_text(sides(side))) // ' mm', k, groups(k))
            end do
        end do
    end subroutine paper_contacts

    !> Ellipses with Hertz's pressures.
    subroutine ellipses(folder, writer)
        character(len=*), intent(in) :: folder
        type(csv_writer_t), intent(inout) :: writer

        type(bench_case_t), allocatable :: cases(:)
        type(contact_grid_t) :: grid
        type(tang_workspace_t) :: tang
        type(group_t) :: groups(size(schemes))
        type(status_t) :: status
        integer :: i, k, n

        call read_ellipse_cases(folder, cases)
        do n = 1, size(sides)
            groups = group_t()
            do i = 1, size(cases)
                associate (case => cases(i))
                    call sample_ellipse(case%a, case%b, 0.0_wp, case%load, sides(n), sides(n), &
                                        most_elements, grid, status)
                    call fail_on_error(status)
                    do k = 1, size(schemes)
                        call compare('hertz', case, case%group // ' a/b ' // &
                                     trim(number_text(case%a/case%b)), edges_sampled, k, grid, &
                                     tang, groups(k), writer)
                    end do
                end associate
            end do
            do k = 1, size(schemes)
                call tell('ellipses, '//trim(number_text(sides(n)))//' mm', k, &
                          groups(k))
            end do
        end do
    end subroutine ellipses

    !> Solve one contact and write its row.
    subroutine compare(set, contact, name, edges, k, grid, tang, group, writer)
        character(len=*), intent(in) :: set, name
        type(bench_case_t), intent(in) :: contact
        integer, intent(in) :: edges !! of the patch, how they are known
        integer, intent(in) :: k     !! of the schemes
        type(contact_grid_t), intent(in) :: grid
        type(tang_workspace_t), intent(inout) :: tang
        type(group_t), intent(inout) :: group
        type(csv_writer_t), intent(inout) :: writer

        type(tang_options_t) :: options
        type(tangential_result_t) :: result
        type(status_t) :: status
        real(wp) :: before, after, errors(3)

        options%scheme = schemes(k)
        options%edges = edges
        call cpu_time(before)
        call tang_solve(tang, grid, material_t(), mu, contact%creepage, options, result, status)
        call cpu_time(after)
        call put_cell(writer, set)
        call put_cell(writer, name)
        call put_cell(writer, trim(scheme_names(k)))
        call put_cells(writer, [grid%dx, grid%dy])
        call put_cell(writer, trim(status_word(status%code)))
        call put_cell(writer, tang%elements)
        if (is_error(status)) then
            group%failed = group%failed + 1
            call put_empty_cells(writer, 3)
        else
            errors = 100.0_wp*([result%fx, result%fy, result%mz] - contact%forces) &
                     /(mu*contact%load*[1.0_wp, 1.0_wp, sqrt(contact%known%area/pi)])
            call put_cells(writer, errors(:3))
            group%n = group%n + 1
            group%total = group%total + abs(errors)
            group%largest = max(group%largest, abs(errors))
            group%seconds = group%seconds + (after - before)
        end if
        call put_cells(writer, [tang%steps, tang%products])
        call put_cell(writer, after - before)
        call end_row(writer)
    end subroutine compare

    subroutine tell(name, k, group)
        character(len=*), intent(in) :: name
        integer, intent(in) :: k
        type(group_t), intent(in) :: group

        character(len=150) :: line

        if (group%n == 0) return
        write (line, '(4a, 3(f0.3, a, f0.3, a), f0.4, a, i0, a)') name, ', ', &
            trim(scheme_names(k)), ' order, mean/max % of mu N: fx ', &
            group%total(1)/group%n, '/', group%largest(1), ', fy ', &
            group%total(2)/group%n, '/', group%largest(2), ', mz ', &
            group%total(3)/group%n, '/', group%largest(3), '; ', group%seconds/group%n, ' s, ', &
            group%failed, ' failed'
        call note(trim(line))
    end subroutine tell
end module faststrip_lab_studies_rolling
