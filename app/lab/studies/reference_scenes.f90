!> `faststrip-lab scenes`: reference forces of the contacts of `reference_gaps`, by NORM and TANG on
!> two grids.
module faststrip_lab_studies_reference_scenes
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve
    use faststrip_command_program_console, only: note, begin_table, end_table
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_lab_pressures, only: solve_pressures, solve_by_norm
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer
    use faststrip_lab_random_reference_gaps, only: reference_scene_t, make_reference_scene, &
                                                   draw_creepage, scene_families
    implicit none
    private

    public :: run_scenes

    integer, parameter :: scenes_unless_told = 240
    ! Elements across the strips' patches on the finer grid, along either axis.
    integer, parameter :: elements = 60

    !> Figures of one grid.
    type :: figures_t
        type(normal_result_t) :: normal
        type(tangential_result_t) :: forces
    end type figures_t

contains

    !> Run the subcommand from the command line.
    subroutine run_scenes()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        integer :: number, last

        command%name = 'scenes'
        command%about = 'Reference forces of contacts of many kinds, by NORM and TANG on two' &
                        // new_line('a') // 'grids and extrapolated. CSV, one row a contact.' &
                        // new_line('a')
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.), &
            option_t('--scenes', 'N', 'number of contacts, 1 to 10000 (default 240)')]
        call parse_command(command, 0)
        last = option_integer(command, '--scenes', scenes_unless_told, least=1, most=10000)
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_comment(writer, 'NORM and TANG, second order, ' // integer_text(elements/2) &
                         // ' and ' // integer_text(elements) // ' elements across; *_extrap = ' &
                         // '(4 fine - coarse)/3; creepages about y = 0')
        call put_header(writer, [character(len=16) :: 'number', 'family', 'N_N', 'mu', 'E_MPa', &
                                 'nu', 'cksi', 'ceta', 'cphi_rad_per_mm', 'Fx_extrap_N', &
                                 'Fy_extrap_N', 'Mz_extrap_Nmm', 'Fx_N', 'Fy_N', 'Mz_Nmm', &
                                 'Fx_coarse_N', 'Fy_coarse_N', 'Mz_coarse_Nmm', 'stick_fraction', &
                                 'area_mm2', 'pmax_MPa', 'penetration_mm', 'n_patches'])
        do number = 1, last
            call solve_scene(number, writer)
        end do
        call end_table(writer)
    end subroutine run_scenes

    !> Solve one contact on both grids and write its row; one that cannot be solved is left out.
    subroutine solve_scene(number, writer)
        integer, intent(in) :: number
        type(csv_writer_t), intent(inout) :: writer

        type(reference_scene_t) :: scene
        type(workspace_t) :: workspace
        type(contact_result_t) :: result
        type(status_t) :: status
        type(figures_t) :: coarse, fine
        real(wp) :: dx, dy

        call make_reference_scene(number, scene)
        scene%estimate = .false.
        call solve_pressures(workspace, scene, result, status)
        if (.not. is_error(status)) call draw_creepage(scene, workspace%strips, status)
        if (.not. is_error(status)) then
            dx = 2.0_wp*result%normal%x_max/elements
            dy = (result%normal%y_max - result%normal%y_min)/elements
            call solve_grid(scene, workspace%strips, 2.0_wp*dx, 2.0_wp*dy, coarse, status)
            if (.not. is_error(status)) &
                call solve_grid(scene, workspace%strips, dx, dy, fine, status)
        end if
        if (is_error(status)) then
            call note(integer_text(number) // ' left out: ' // trim(status%message))
            return
        end if
        call put_cell(writer, number)
        call put_cell(writer, trim(scene_families(scene%family)))
        call put_cells(writer, [scene%load, scene%mu, scene%material%e_wheel, &
                                scene%material%nu_wheel, scene%creepage%cksi, scene%creepage%ceta, &
                                scene%creepage%cphi, &
                                extrapolated(coarse%forces%fx, fine%forces%fx), &
                                extrapolated(coarse%forces%fy, fine%forces%fy), &
                                extrapolated(coarse%forces%mz, fine%forces%mz), fine%forces%fx, &
                                fine%forces%fy, fine%forces%mz, coarse%forces%fx, &
                                coarse%forces%fy, coarse%forces%mz, fine%forces%stick_fraction, &
                                fine%normal%area, fine%normal%pmax, fine%normal%penetration])
        call put_cell(writer, fine%normal%n_patches)
        call end_row(writer)
    end subroutine solve_scene

    subroutine solve_grid(scene, strips, dx, dy, figures, status)
        type(reference_scene_t), intent(in) :: scene
        type(contact_strips_t), intent(in) :: strips !! to start from
        real(wp), intent(in) :: dx, dy             !! sides of the elements, mm
        type(figures_t), intent(out) :: figures
        type(status_t), intent(out) :: status

        type(norm_workspace_t) :: norm
        type(tang_workspace_t) :: tang

        call solve_by_norm(norm, scene, norm_options_t(dx=dx, dy=dy), figures%normal, status, &
                           strips)
        if (is_error(status)) return
        call tang_solve(tang, norm%grid, scene%material, scene%mu, scene%creepage, &
                        tang_options_t(), figures%forces, status)
    end subroutine solve_grid

    !> To no grid at all, with errors of second order.
    elemental real(wp) function extrapolated(coarse, fine)
        real(wp), intent(in) :: coarse, fine

        extrapolated = (4.0_wp*fine - coarse)/3.0_wp
    end function extrapolated
end module faststrip_lab_studies_reference_scenes
