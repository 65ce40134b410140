!> `faststrip-lab bench forces`: errors of all tangential methods against Kalker's exact theory.
!>
!> Four sets: Hertz contacts (`hertz_creep.csv`), the paper's 20 contacts with either sign of the
!> creepages (`s1002_uic60_B.csv`, `_A.csv`), and contacts of many kinds solved by NORM and TANG
!> (`reference/scenes`, in two groups by odd and even number); all but the first by strips.
!> Errors of forces in % of mu N, of the moment in % of mu N c, c = sqrt(area/pi), against the
!> extrapolated reference; of the friction power in % of what the reference's forces give,
!> `-(Fx cksi + Fy ceta + Mz cphi)`; of the stick fraction in points of the reference's share of
!> elements.
module faststrip_lab_grid_forces
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, &
                                  put_cell, put_cells, end_row
    use faststrip_base_text, only: integer_text
    use faststrip_normal_simple_hertz, only: hertz_strips
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, read_ellipse_cases, &
                                        read_scene_cases
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: normal_hertz, method_name_length
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_lab_force_laws, only: tangential_methods => force_laws
    use faststrip_lab_pressures, only: solve_pressures
    implicit none
    private

    public :: bench_forces

    !> Errors of one contact: Fx, Fy, force vector, Mz, power, stick fraction; in %.
    integer, parameter :: n_errors = 6
    ! The reference has the power of a contact that slides little with few digits.
    real(wp), parameter :: smallest_share = 0.05_wp

    !> Errors of one set, summed up by group and method.
    type :: tally_t
        integer :: n_groups = 0
        character(len=method_name_length) :: group(10) = ''
        real(wp) :: total(n_errors, 10, size(tangential_methods)) = 0.0_wp
        real(wp) :: largest(n_errors, 10, size(tangential_methods)) = 0.0_wp
        integer :: number(n_errors, 10, size(tangential_methods)) = 0
    end type tally_t

contains

    !> Compare everything, write the CSV and say the mean and largest errors.
    subroutine bench_forces(file, folder, scenes)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with CONTACT's results
        character(len=*), intent(in) :: scenes !! CSV of the contacts of many kinds

        type(bench_case_t), allocatable :: cases(:)
        type(csv_writer_t) :: writer
        type(tally_t) :: tally

        ! Read before anything is written.
        call read_scene_cases(scenes, cases)
        call begin_table(writer, file)
        call put_comment(writer, 'errors against extrapolated references: forces in % of mu N, ' &
                         // 'moment in % of mu N c, power in %, stick fraction in points')
        call put_header(writer, [character(len=14) :: 'set', 'group', 'case', 'method', &
                                 'Fx_err', 'Fy_err', 'force_err', 'Mz_err', 'power_err', &
                                 'stick_err'])
        call compare_hertz(folder, writer, tally)
        call tell('Hertz contacts', tally)
        call compare_shifts(folder, 'B', writer, tally)
        call compare_shifts(folder, 'A', writer, tally)
        call compare_by_strips(cases, 'scenes', writer, tally)
        call total_group(tally)
        call tell('scenes', tally)
        call end_table(writer)
    end subroutine bench_forces

    !> Ellipses, all methods on the ellipse itself or on 15 strips of it.
    subroutine compare_hertz(folder, writer, tally)
        character(len=*), intent(in) :: folder
        type(csv_writer_t), intent(inout) :: writer
        type(tally_t), intent(out) :: tally

        type(bench_case_t), allocatable :: cases(:)
        type(contact_case_t) :: contact
        type(workspace_t) :: workspace
        type(status_t) :: status
        integer :: i

        tally = tally_t()
        call read_ellipse_cases(folder, cases)
        contact%methods%normal = normal_hertz
        call reserve_workspace(workspace, contact%methods, min_gap_points, status)
        call fail_on_error(status)
        workspace%solved_by = normal_hertz
        workspace%is_ellipse = .true.
        do i = 1, size(cases)
            associate (case => cases(i), hertz => workspace%hertz)
                hertz%a = case%a
                hertz%b = case%b
                hertz%load = case%load
                hertz%area = case%known%area
                hertz%pmax = 1.5_wp*hertz%load/hertz%area
                contact = case%contact_case_t
                contact%methods%normal = normal_hertz
                contact%estimate = .false.
                call hertz_strips(hertz, contact%methods%strips_per_patch, workspace%strips, status)
                call fail_on_error(status)
                call compare(workspace, contact, case, 'hertz', integer_text(i), writer, tally)
            end associate
        end do
        call total_group(tally)
    end subroutine compare_hertz

    !> The paper's contacts.
    subroutine compare_shifts(folder, signs, writer, tally)
        character(len=*), intent(in) :: folder
        character(len=1), intent(in) :: signs ! of the creepages
        type(csv_writer_t), intent(inout) :: writer
        type(tally_t), intent(out) :: tally

        type(bench_case_t), allocatable :: cases(:)

        call read_bench_cases(folder, cases, signs)
        call compare_by_strips(cases, 's1002_uic60_' // signs, writer, tally)
        call tell('s1002_uic60_' // signs, tally)
    end subroutine compare_shifts

    !> A set of contacts, the normal problem by strips.
    subroutine compare_by_strips(cases, set, writer, tally)
        type(bench_case_t), intent(inout) :: cases(:)
        character(len=*), intent(in) :: set
        type(csv_writer_t), intent(inout) :: writer
        type(tally_t), intent(out) :: tally

        type(workspace_t) :: workspace
        type(contact_result_t) :: figures
        type(status_t) :: status
        character(len=:), allocatable :: number
        integer :: i

        tally = tally_t()
        do i = 1, size(cases)
            cases(i)%estimate = .false.
            call solve_pressures(workspace, cases(i), figures, status)
            call fail_on_error(status)
            number = integer_text(i)
            ! Scenes are called by their numbers.
            if (set == 'scenes') number = cases(i)%name
            call compare(workspace, cases(i)%contact_case_t, cases(i), set, number, writer, tally)
        end do
    end subroutine compare_by_strips

    !> All methods on one contact.
    subroutine compare(workspace, contact, reference, set, number, writer, tally)
        type(workspace_t), intent(inout) :: workspace ! with a normal solution
        type(contact_case_t), intent(in) :: contact ! what was solved
        type(bench_case_t), intent(in) :: reference
        character(len=*), intent(in) :: set, number
        type(csv_writer_t), intent(inout) :: writer
        type(tally_t), intent(inout) :: tally

        type(contact_case_t) :: case
        type(contact_result_t) :: found
        type(status_t) :: status
        real(wp) :: error(n_errors), force, power, size_of
        logical :: counts(n_errors)
        integer :: m

        case = contact
        force = contact%mu*contact%load
        size_of = sqrt(reference%known%area/pi)
        if (reference%a > 0.0_wp) size_of = sqrt(reference%a*reference%b)
        associate (creepage => contact%creepage)
            power = -dot_product(reference%forces, [creepage%cksi, creepage%ceta, creepage%cphi])
        end associate
        do m = 1, size(tangential_methods)
            case%methods%tangential = tangential_methods(m)%number
            call solve_contact_forces(workspace, case, found, status)
            call fail_on_error(status)
            associate (result => found%tangential)
                error(:2) = ([result%fx, result%fy] - reference%forces(:2))/force
                error(3) = hypot(error(1), error(2))
                error(4) = (result%mz - reference%forces(3))/(force*size_of)
                error(5) = result%friction_power/power - 1.0_wp
                error(6) = result%stick_fraction - reference%stick_fraction
            end associate
            error = 100.0_wp*error
            counts = .true.
            counts(5) = norm2(reference%forces(:2)) > smallest_share*force
            counts(6) = tangential_methods(m)%gives_stick
            call put_cell(writer, set)
            call put_cell(writer, reference%group)
            call put_cell(writer, number)
            call put_cell(writer, trim(tangential_methods(m)%name))
            call put_cells(writer, error, counts)
            call end_row(writer)
            call add_errors(tally, reference%group, m, abs(error), counts)
        end do
    end subroutine compare

    subroutine add_errors(tally, group, m, error, counts)
        type(tally_t), intent(inout) :: tally
        character(len=*), intent(in) :: group
        integer, intent(in) :: m
        real(wp), intent(in) :: error(:)
        logical, intent(in) :: counts(:)

        integer :: g

        do g = 1, tally%n_groups
            if (tally%group(g) == group) exit
        end do
        if (g > tally%n_groups) then
            tally%n_groups = g
            tally%group(g) = group
        end if
        where (counts)
            tally%total(:, g, m) = tally%total(:, g, m) + error
            tally%largest(:, g, m) = max(tally%largest(:, g, m), error)
            tally%number(:, g, m) = tally%number(:, g, m) + 1
        end where
    end subroutine add_errors

    !> Add the group of all groups.
    subroutine total_group(tally)
        type(tally_t), intent(inout) :: tally

        integer :: g, n

        n = tally%n_groups
        g = n + 1
        tally%n_groups = g
        tally%group(g) = 'all'
        tally%total(:, g, :) = sum(tally%total(:, :n, :), 2)
        tally%largest(:, g, :) = maxval(tally%largest(:, :n, :), 2)
        tally%number(:, g, :) = sum(tally%number(:, :n, :), 2)
    end subroutine total_group

    subroutine tell(what, tally)
        character(len=*), intent(in) :: what
        type(tally_t), intent(in) :: tally

        character(len=140) :: line
        integer :: g, m, j

        do g = 1, tally%n_groups
            write (line, '(3a, i0, a)') what, ', ', trim(tally%group(g)) // ' (', &
                tally%number(1, g, 1), '): mean | max of'
            call note(trim(line))
            write (line, '(t26, 6a15)') 'Fx', 'Fy', 'force', 'Mz', 'power', 'stick'
            call note(trim(line))
            do m = 1, size(tangential_methods)
                line = '  ' // tangential_methods(m)%name
                do j = 1, n_errors
                    associate (n => tally%number(j, g, m), cell => line(12 + 15*j:26 + 15*j))
                        if (n > 0) write (cell, '(f8.2, f7.1)') tally%total(j, g, m)/n, &
                            min(tally%largest(j, g, m), 9999.9_wp)
                    end associate
                end do
                call note(trim(line))
            end do
        end do
    end subroutine tell
end module faststrip_lab_grid_forces
