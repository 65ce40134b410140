!> `faststrip-lab bench correction`: what the march misses of the forces of an ellipse, by TANG, and
!> what the correction adds, over its proportion and the creepage.
module faststrip_lab_studies_correction
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, edges_sampled
    use faststrip_kalker_tangential_pressures, only: sample_ellipse
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_strips
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve, default_points
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    implicit none
    private

    public :: bench_correction

    ! Proportions from 1/10 to 10, linear forces from 0.1 to 30 times mu N, by equal factors.
    integer, parameter :: proportions = 17, forces = 21
    real(wp), parameter :: least_force = 0.1_wp, most_force = 30.0_wp
    ! By the longitudinal, the lateral creepage and by spin.
    real(wp), parameter :: directions(3, 4) = reshape([1.0_wp, 0.0_wp, 0.0_wp, &
        0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.6_wp, 0.6_wp, sqrt(0.28_wp)], [3, 4])
    character(len=*), parameter :: names(4) = [character(len=12) :: 'longitudinal', 'lateral', &
                                               'spin', 'all']
    integer, parameter :: strips_across = 15, elements_across = 36
    real(wp), parameter :: area = 100.0_wp, load = 8.0e4_wp, mu = 0.3_wp ! mm^2, N

contains

    !> Compute and write the CSV.
    subroutine bench_correction(file, quick)
        character(len=*), intent(in) :: file !! to write, - for stdout
        logical, intent(in) :: quick         !! one in four proportions and forces

        type(csv_writer_t) :: writer
        type(tang_workspace_t) :: tang
        type(contact_strips_t) :: strips
        type(status_t) :: status
        integer :: i, k, step

        call begin_table(writer, file)
        call put_comment(writer, 'ellipses of 15 strips by 15 points, and TANG on 36 elements ' &
                         // 'each way; u: linear force over mu N; forces over mu N, moments over ' &
                         // 'mu N sqrt(ab)')
        call put_header(writer, [character(len=16) :: 'direction', 'a_over_b', 'u', 'Fx_plain', &
                                 'Fy_plain', 'Mz_plain', 'Fx', 'Fy', 'Mz', 'Fx_tang', 'Fy_tang', &
                                 'Mz_tang'])
        call reserve_strips(strips, strips_across, status)
        call fail_on_error(status)
        step = merge(4, 1, quick)
        do i = 1, proportions, step
            do k = 1, size(names)
                call put_ellipse(writer, tang, strips, 10.0_wp**(2.0_wp*(i - 1)/(proportions - 1) &
                                                                 - 1.0_wp), k, step)
            end do
            call progress('proportion', i, proportions)
        end do
        call release_tang(tang)
        call end_table(writer)
    end subroutine bench_correction

    !> All creepages of one direction.
    subroutine put_ellipse(writer, tang, strips, proportion, direction, step)
        type(csv_writer_t), intent(inout) :: writer
        type(tang_workspace_t), intent(inout) :: tang
        type(contact_strips_t), intent(inout) :: strips ! with capacity
        real(wp), intent(in) :: proportion              ! a/b
        integer, intent(in) :: direction
        integer, intent(in) :: step                     ! of the forces

        type(hertz_t) :: ellipse
        type(contact_grid_t) :: grid
        type(kalker_coefficients_t) :: c
        type(material_t) :: steel
        type(tang_options_t) :: options
        type(creepage_t) :: creepage
        type(tangential_result_t) :: plain, corrected, reference
        type(status_t) :: status
        real(wp) :: u(3), unit, force
        integer :: i

        ellipse%a = sqrt(area/pi*proportion)
        ellipse%b = ellipse%a/proportion
        ellipse%load = load
        ellipse%area = area
        ellipse%pmax = 1.5_wp*load/area
        call hertz_strips(ellipse, strips_across, strips, status)
        call fail_on_error(status)
        call sample_ellipse(ellipse%a, ellipse%b, 0.0_wp, load, 2.0_wp*ellipse%a/elements_across, &
                            2.0_wp*ellipse%b/elements_across, 4*elements_across**2, grid, status)
        call fail_on_error(status)
        call kalker_coefficients(proportion, combined_poisson_ratio(steel), c, status)
        call fail_on_error(status)
        unit = mu*load/(combined_shear_modulus(steel)*ellipse%a*ellipse%b)
        options%edges = edges_sampled
        do i = 1, forces, step
            force = least_force*(most_force/least_force)**(real(i - 1, wp)/(forces - 1))
            u = force*directions(:, direction)
            creepage = creepage_t(u(1)*unit/c%c11, u(2)*unit/c%c22, &
                                  u(3)*unit/(c%c23*sqrt(ellipse%a*ellipse%b)))
            call faststrip_tangential_solve(strips, steel, mu, creepage, default_points, plain, &
                                            status, with_fit=.false.)
            call fail_on_error(status)
            call faststrip_tangential_solve(strips, steel, mu, creepage, default_points, &
                                            corrected, status)
            call fail_on_error(status)
            call tang_solve(tang, grid, steel, mu, creepage, options, reference, status)
            call fail_on_error(status)
            call put_cell(writer, trim(names(direction)))
            call put_cells(writer, [proportion, force])
            call put_forces(writer, plain, ellipse)
            call put_forces(writer, corrected, ellipse)
            call put_forces(writer, reference, ellipse)
            call end_row(writer)
        end do
    end subroutine put_ellipse

    subroutine put_forces(writer, result, ellipse)
        type(csv_writer_t), intent(inout) :: writer
        type(tangential_result_t), intent(in) :: result
        type(hertz_t), intent(in) :: ellipse

        call put_cells(writer, [result%fx/(mu*load), result%fy/(mu*load), &
                                result%mz/(mu*load*sqrt(ellipse%a*ellipse%b))])
    end subroutine put_forces
end module faststrip_lab_studies_correction
