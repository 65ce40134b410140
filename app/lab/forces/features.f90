!> `faststrip-lab force-features`: what FASTSTRIP and FASTSIM make of the contacts of `force-data`.
module faststrip_lab_forces_features
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_ok
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, read_csv, csv_writer_t, put_comment, put_header, &
                                   put_cell, put_cells, end_row
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer
    use faststrip_contact_methods, only: most_strips
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_lab_pressures, only: solve_pressures
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse
    use faststrip_normal_sub_patches, only: has_neck
    use faststrip_tangential_fastsim, only: fastsim_strips_solve
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve, default_points
    use faststrip_tangential_patch_law, only: patch_law_t, find_law
    use faststrip_tangential_patch_shape, only: patch_shape_t, patch_shape
    use faststrip_tangential_types, only: tangential_result_t, most_points
    use faststrip_lab_forces_contacts, only: force_contact_t, draw_force_contact
    use faststrip_lab_random_force_gaps, only: force_families
    use faststrip_lab_forces_record, only: force_record_t, take_record
    implicit none
    private

    public :: run_force_features

    integer, parameter :: most_files = 100000
    ! As a user has them.
    integer, parameter :: usual_strips = 15, rows = 50
    !> The contacts of one file.
    type :: file_t
        type(force_record_t), allocatable :: records(:)
    end type file_t

    ! The error of TANG's forces falls with this power of the elements' sides.
    ! Tuned [1]. Origin: measured on 294 states of 49 contacts, 12 to 108 elements across.
    real(wp), parameter :: order = 1.5_wp

contains

    !> Run the subcommand from the command line.
    subroutine run_force_features()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        type(file_t), allocatable :: files(:)
        type(csv_table_t) :: table
        type(workspace_t) :: workspace
        type(status_t) :: status
        integer :: file, row, strips, points

        command%name = 'force-features'
        command%usage = 'FILE...'
        command%about = 'For developers: creep forces of FASTSTRIP and FASTSIM beside those of' &
                        // ' the files of' // new_line('a') &
                        // 'force-data. CSV, one row for each creepage.' // new_line('a')
        command%options = [ &
            option_t('--strips', 'INTEGER', 'strips across a patch (default ' &
                     // integer_text(usual_strips) // ')'), &
            option_t('--points', 'INTEGER', 'points along a strip (default ' &
                     // integer_text(default_points) // ')'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 1, most_files)
        strips = option_integer(command, '--strips', usual_strips, least=1, most=most_strips)
        points = option_integer(command, '--points', default_points, least=1, most=most_points)
        allocate (files(size(command%arguments)))
        do file = 1, size(files)
            call read_csv(command%arguments(file)%text, table, status)
            call fail_on_error(status)
            allocate (files(file)%records(table%n_rows))
            do row = 1, table%n_rows
                call take_record(table, row, files(file)%records(row), status)
                call fail_on_error(status)
            end do
        end do
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_comment(writer, 'FASTSTRIP, ' // integer_text(strips) // ' x ' &
                         // integer_text(points) // ', and FASTSIM, ' // integer_text(rows) &
                         // ' x ' // integer_text(rows) // ', beside TANG on two grids, its ' &
                         // 'forces and moment extrapolated (*_tang) and on the finer grid ' &
                         // '(*_fine); creepages and moments about y = 0; a, b, yc of the ' &
                         // 'ellipse of the patch''s moments')
        call put_header(writer, [character(len=24) :: 'seed', 'number', 'family', 'state', &
                                 'load_N', 'mu', 'E_MPa', 'nu', 'strips', 'neck', &
                                 'est_err_penetration', 'est_err_pmax', 'est_err_area', 'a_mm', &
                                 'b_mm', 'yc_mm', 'cksi', 'ceta', 'cphi_rad_per_mm', &
                                 'Fx_N', 'Fy_N', 'Mz_Nmm', 'friction_power_N', 'stick_fraction', &
                                 'Fx_fastsim_N', 'Fy_fastsim_N', 'Mz_fastsim_Nmm', &
                                 'friction_power_fastsim_N', 'stick_fraction_fastsim', &
                                 'Fx_tang_N', 'Fy_tang_N', 'Mz_tang_Nmm', 'Fx_fine_N', &
                                 'Fy_fine_N', 'Mz_fine_Nmm', 'friction_power_fine_N', &
                                 'stick_fraction_fine', 'u1', 'u2', 'u3', 'even1', 'even2', &
                                 'even3', 'even4', 'even5', 'odd1', 'odd2', 'odd3', 'odd4', &
                                 'odd5', 'width', 'points'])
        do file = 1, size(files)
            do row = 1, size(files(file)%records)
                associate (record => files(file)%records(row))
                    if (record%status == 'ok') &
                        call put_contact(writer, workspace, record, strips, points)
                end associate
            end do
            call progress('file', file, size(files))
        end do
        call end_table(writer)
    end subroutine run_force_features

    !> The rows of one contact, unless its strips tell of several patches or of a limitation.
    subroutine put_contact(writer, workspace, record, strips, points)
        type(csv_writer_t), intent(inout) :: writer
        type(workspace_t), intent(inout) :: workspace ! grown as needed
        type(force_record_t), intent(in) :: record
        integer, intent(in) :: strips, points         ! across and along

        type(force_contact_t) :: contact
        type(contact_result_t) :: result
        type(status_t) :: status

        call draw_force_contact(record%seed, record%number, contact, &
                                findloc(force_families == record%family, .true., dim=1))
        contact%methods%strips_per_patch = strips
        contact%estimate = .true.
        contact%resolution_limit = huge(1.0_wp)
        call solve_pressures(workspace, contact, result, status)
        call fail_on_error(status, 'contact ' // integer_text(record%number))
        if (status%code /= st_ok .or. result%normal%n_patches > 1) return
        call put_states(writer, workspace%strips, result%normal_errors, record, points)
    end subroutine put_contact

    !> The rows of one contact with its strips.
    subroutine put_states(writer, strips, normal_errors, record, points)
        type(csv_writer_t), intent(inout) :: writer
        type(contact_strips_t), intent(in) :: strips
        type(normal_errors_t), intent(in) :: normal_errors
        type(force_record_t), intent(in) :: record
        integer, intent(in) :: points

        type(patch_ellipse_t) :: ellipse
        type(patch_shape_t) :: shape
        type(patch_law_t) :: law
        type(tangential_result_t) :: forces, fastsim
        type(status_t) :: status
        real(wp) :: u(3)
        integer :: i

        ellipse = patch_ellipse(strips, 1, strips%n)
        shape = patch_shape(strips, 1, strips%n, ellipse)
        do i = 1, record%n_states
            associate (state => record%states(i))
                call faststrip_tangential_solve(strips, record%material, record%mu, &
                                                state%creepage, points, forces, status, &
                                                with_fit=.false.)
                if (.not. is_error(status)) &
                    call fastsim_strips_solve(strips, record%material, record%mu, &
                                              state%creepage, rows, rows, fastsim, status)
                if (is_error(status)) &
                    call fail_on_error(status, 'contact ' // integer_text(record%number))
                call put_cells(writer, [record%seed, record%number])
                call put_cell(writer, record%family)
                call put_cell(writer, i)
                call put_cells(writer, [record%load, record%mu, record%material%e_wheel, &
                                        record%material%nu_wheel])
                call put_cell(writer, strips%n)
                call put_cell(writer, merge(1, 0, has_neck(strips%half_length(:strips%n))))
                call put_cells(writer, [normal_errors%est_err_penetration, &
                                        normal_errors%est_err_pmax, normal_errors%est_err_area, &
                                        ellipse%a, ellipse%b, ellipse%y, state%creepage%cksi, &
                                        state%creepage%ceta, state%creepage%cphi])
                call put_forces(writer, forces)
                call put_forces(writer, fastsim)
                call put_cells(writer, [extrapolated(state%coarse%fx, state%forces%fx), &
                                        extrapolated(state%coarse%fy, state%forces%fy), &
                                        extrapolated(state%coarse%mz, state%forces%mz)])
                call put_forces(writer, state%forces)
                call find_law(ellipse, record%material, record%mu, state%creepage, law, status, u)
                call put_cells(writer, u(:3))
                call put_cells(writer, shape%even)
                call put_cells(writer, shape%odd)
                call put_cell(writer, shape%width)
                call put_cell(writer, points)
                call end_row(writer)
            end associate
        end do
    end subroutine put_states

    !> Richardson's extrapolation to elements without sides.
    pure real(wp) function extrapolated(coarse, fine)
        real(wp), intent(in) :: coarse, fine ! sides of the elements in the proportion 2 to 1

        extrapolated = fine + (fine - coarse)/(2.0_wp**order - 1.0_wp)
    end function extrapolated

    subroutine put_forces(writer, forces)
        type(csv_writer_t), intent(inout) :: writer
        type(tangential_result_t), intent(in) :: forces

        call put_cells(writer, [forces%fx, forces%fy, forces%mz, forces%friction_power, &
                                forces%stick_fraction])
    end subroutine put_forces
end module faststrip_lab_forces_features
