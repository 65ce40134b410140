!> How steady the answers are: noise in the gap, from one unit in the last place up, and the four
!> rounding modes of IEEE arithmetic.
!>
!> Noise moves every height and every curvature of a gap up or down by the same share, at random.
!> A figure that depends on the gap continuously moves in proportion to the noise; one that does
!> not (a decision taken differently) moves by the same at any noise: a jump. Penetration, maximum
!> pressure and area are measured against themselves, forces against mu N, the moment against
!> mu N sqrt(area/pi).
!>
!> The rounding modes stand for Monte-Carlo arithmetic: one instruction stream, four results, and
!> the digits they share are those that rounding leaves.
module faststrip_lab_extremes_noise
    use, intrinsic :: ieee_arithmetic, only: ieee_round_type, ieee_nearest, ieee_up, ieee_down, &
                                             ieee_to_zero, ieee_get_rounding_mode, &
                                             ieee_set_rounding_mode
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_offcentre, only: strip_influence_at
    use faststrip_base_material, only: normal_compliance
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, &
                                      strip_solve_demand
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve, default_points
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_extremes_rows, only: row_t, put_value, status_of
    use faststrip_command_settings_case_file, only: case_t
    use faststrip_lab_grid_example_cases, only: example_names, read_example
    use faststrip_command_program_console, only: fail_on_error, progress
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_methods, only: contact_methods_t
    use faststrip_command_contact_prepared_case, only: prepared_case_t
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    implicit none
    private

    public :: named_case_t, find_contacts, noise_extremes, rounding_extremes

    ! The noise: the first stands for one unit in the last place.
    real(wp), parameter :: levels(5) = [epsilon(1.0_wp), 1.0e-13_wp, 1.0e-11_wp, 1.0e-9_wp, &
                                        1.0e-7_wp]
    integer, parameter :: draws(5) = [100, 20, 20, 20, 20], quick_draws = 4, quick_step = 5
    ! Loads: their number and the step from one to the next.
    integer, parameter :: loads = 200, quick_loads = 20
    real(wp), parameter :: load_step = 1.0e-3_wp
    ! A figure that jumps by more, relative, from one load to the next is said to.
    real(wp), parameter :: largest_jump = 1.0e-3_wp
    ! A change by more than this part per part of noise is no slope any more.
    real(wp), parameter :: steepest = 1.0e4_wp
    character(len=*), parameter :: figure_names(6) = [character(len=11) :: 'penetration', 'pmax', &
                                                      'area', 'Fx', 'Fy', 'Mz']

    !> A contact to be solved again and again.
    type, extends(contact_case_t) :: named_case_t
        character(len=24) :: name = ''
    end type named_case_t

contains

    !> Measure and write.
    subroutine noise_extremes(quick, contacts, writer)
        logical, intent(in) :: quick                !! few contacts, few draws
        type(named_case_t), intent(in) :: contacts(:)  !! from `find_contacts`
        type(csv_writer_t), intent(inout) :: writer !! an open file

        type(solver_t), pointer :: solver
        type(status_t) :: status
        integer :: i

        call new_solver(solver, status)
        call fail_on_error(status)
        do i = 1, size(contacts), merge(quick_step, 1, quick)
            call progress('contacts with noise', i, size(contacts))
            call disturb(solver, contacts(i), quick, writer)
            call step_load(solver, contacts(i), quick, writer)
        end do
        call free_solver(solver)
    end subroutine noise_extremes

    !> Measure and write what the rounding mode changes.
    subroutine rounding_extremes(quick, contacts, writer)
        logical, intent(in) :: quick                !! few contacts
        type(named_case_t), intent(in) :: contacts(:)  !! from `find_contacts`
        type(csv_writer_t), intent(inout) :: writer !! an open file

        type(solver_t), pointer :: solver
        type(status_t) :: status
        integer :: i

        call new_solver(solver, status)
        call fail_on_error(status)
        call round_influence(writer)
        do i = 1, size(contacts), merge(quick_step, 1, quick)
            call round_contact(solver, .true., contacts(i), writer)
            call round_contact(solver, .false., contacts(i), writer)
        end do
        call free_solver(solver)
    end subroutine rounding_extremes

    !> The paper's contacts and the examples; ends the program if one cannot be read.
    subroutine find_contacts(folder, examples, contacts)
        character(len=*), intent(in) :: folder !! of the paper's contacts
        character(len=*), intent(in) :: examples !! folder of the examples
        type(named_case_t), allocatable, intent(out) :: contacts(:) !! all of them

        type(bench_case_t), allocatable :: cases(:)
        type(case_t) :: case
        type(prepared_case_t) :: prepared
        integer :: i

        call read_bench_cases(folder, cases)
        allocate (contacts(size(cases) + size(example_names)))
        do i = 1, size(cases)
            contacts(i)%name = cases(i)%name
            contacts(i)%contact_case_t = cases(i)%contact_case_t
        end do
        do i = 1, size(example_names)
            call read_example(examples, i, case, prepared)
            associate (contact => contacts(size(cases) + i))
                contact%name = example_names(i)
                contact%contact_case_t = prepared%contact_case_t
                contact%methods = contact_methods_t()
            end associate
        end do
    end subroutine find_contacts

    !> The figures of a contact, and the units their changes are measured in; zero and one if there
    !> is an error.
    subroutine figures_of(solver, contact, figures, units, status)
        type(solver_t), intent(inout) :: solver
        type(named_case_t), intent(in) :: contact
        real(wp), dimension(size(figure_names)), intent(out) :: figures, units
        type(status_t), intent(out) :: status

        type(contact_result_t) :: result

        call solve(solver, contact, result, status)
        figures = 0.0_wp
        units = 1.0_wp
        if (is_error(status)) return
        figures = [result%normal%penetration, result%normal%pmax, result%normal%area, &
                   result%tangential%fx, result%tangential%fy, result%tangential%mz]
        units(:3) = figures(:3)
        units(4:5) = result%normal%load
        if (contact%mu > 0.0_wp) units(4:5) = contact%mu*result%normal%load
        units(6) = units(4)*sqrt(figures(3)/pi)
    end subroutine figures_of

    !> The largest change of each figure by noise of each level.
    subroutine disturb(solver, contact, quick, writer)
        type(solver_t), intent(inout) :: solver
        type(named_case_t), intent(in) :: contact
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(named_case_t) :: noisy
        type(status_t) :: base_status, status
        type(row_t) :: row
        real(wp), dimension(size(figure_names)) :: base, unit, figures, units, change
        integer(int64) :: state
        integer :: level, draw, n_draws, k, other_status

        call figures_of(solver, contact, base, unit, base_status)
        state = 20141
        do level = 1, size(levels)
            n_draws = draws(level)
            if (quick) n_draws = quick_draws
            change = 0.0_wp
            other_status = 0
            do draw = 1, n_draws
                noisy = contact
                call add_noise(levels(level), level == 1, state, noisy%gap%h)
                call add_noise(levels(level), level == 1, state, noisy%gap%inv2r)
                call figures_of(solver, noisy, figures, units, status)
                if (status%code /= base_status%code) other_status = other_status + 1
                if (is_error(status) .or. is_error(base_status)) cycle
                change = max(change, abs(figures - base)/unit)
            end do
            row = row_t(chapter='noise', case=contact%name, method='strip+faststrip', &
                        x_name='noise', x=levels(level), y_name='draws', y=real(n_draws, wp), &
                        reference='no noise')
            call status_of(base_status, row)
            call put_value(writer, row, 'other_status', real(other_status, wp))
            if (.not. row%has_value) cycle
            do k = 1, size(figure_names)
                call status_of(base_status, row)
                if (change(k) > steepest*levels(level)) row%status = 'jump'
                call put_value(writer, row, figure_names(k), change(k))
            end do
        end do
    end subroutine disturb

    !> The load grows in small equal steps; a smooth figure has third differences near zero, half
    !> the largest of them is the size of a jump.
    subroutine step_load(solver, contact, quick, writer)
        type(solver_t), intent(inout) :: solver
        type(named_case_t), intent(in) :: contact
        logical, intent(in) :: quick
        type(csv_writer_t), intent(inout) :: writer

        type(named_case_t) :: loaded
        type(status_t) :: status, worst
        type(row_t) :: row
        real(wp), dimension(size(figure_names)) :: jump
        real(wp), dimension(size(figure_names), loads) :: figures, units
        real(wp) :: factor
        integer :: i, k, n

        n = merge(quick_loads, loads, quick)
        loaded = contact
        do i = 1, n
            factor = exp(load_step*(i - 1 - n/2))
            loaded%load = factor*contact%load
            loaded%penetration = factor*contact%penetration
            call figures_of(solver, loaded, figures(:, i), units(:, i), status)
            if (i == 1 .or. status%code > worst%code) worst = status
        end do
        jump = 0.0_wp
        do i = 2, n - 2
            jump = max(jump, 0.5_wp*abs(figures(:, i + 2) - 3.0_wp*figures(:, i + 1) &
                                        + 3.0_wp*figures(:, i) - figures(:, i - 1)) &
                       /units(:, n/2))
        end do
        row = row_t(chapter='load_steps', case=contact%name, method='strip+faststrip', &
                    x_name='step', x=load_step, y_name='loads', y=real(n, wp), &
                    reference='neighbours')
        do k = 1, size(figure_names)
            call status_of(worst, row)
            if (jump(k) > largest_jump .and. row%status == 'ok') row%status = 'jump'
            call put_value(writer, row, figure_names(k), jump(k))
        end do
    end subroutine step_load

    !> Move every value up or down by a share of it, or by one unit in the last place.
    subroutine add_noise(share, by_last_place, state, values)
        real(wp), intent(in) :: share
        logical, intent(in) :: by_last_place
        integer(int64), intent(inout) :: state
        real(wp), intent(inout) :: values(:)

        real(wp) :: direction
        integer :: i

        do i = 1, size(values)
            ! Park and Miller's generator.
            state = mod(48271_int64*state, 2147483647_int64)
            direction = merge(1.0_wp, -1.0_wp, state > 1073741823_int64)
            if (by_last_place) then
                values(i) = nearest(values(i), direction)
            else
                values(i) = values(i)*(1.0_wp + share*direction)
            end if
        end do
    end subroutine add_noise

    !> Influence coefficients in the four rounding modes.
    subroutine round_influence(writer)
        type(csv_writer_t), intent(inout) :: writer

        integer, parameter :: distances(4) = [0, 1, 10, 1000]
        real(wp), parameter :: places(4) = [0.0_wp, 0.9_wp, 1.0_wp, 3.0_wp]
        type(ieee_round_type) :: modes(4), before
        type(row_t) :: row
        real(wp) :: values(4), b
        integer :: i, j, k, mode

        modes = [ieee_nearest, ieee_up, ieee_down, ieee_to_zero]
        call ieee_get_rounding_mode(before)
        do k = -8, 8, 2
            b = 10.0_wp**k
            do i = 1, size(distances)
                do j = 1, size(places)
                    do mode = 1, size(modes)
                        call ieee_set_rounding_mode(modes(mode))
                        if (j == 1) then
                            values(mode) = strip_influence(distances(i), b)
                        else
                            values(mode) = strip_influence_at(places(j), &
                                                              (2*distances(i) - 1)*b, &
                                                              (2*distances(i) + 1)*b)
                        end if
                    end do
                    call ieee_set_rounding_mode(before)
                    row = row_t(chapter='rounding', method='closed', x_name='b', x=b, &
                                y_name='X', y=places(j), reference='4 modes')
                    write (row%case, '(a, i0)') 'n = ', distances(i)
                    call put_value(writer, row, 'influence', &
                                   (maxval(values) - minval(values))/abs(values(1)))
                end do
            end do
        end do
    end subroutine round_influence

    !> A contact in the four rounding modes: by the whole library, which rounds to nearest whatever
    !> its host does, or by its solvers called directly, which do as they are asked.
    subroutine round_contact(solver, whole, contact, writer)
        type(solver_t), intent(inout) :: solver
        logical, intent(in) :: whole
        type(named_case_t), intent(in) :: contact
        type(csv_writer_t), intent(inout) :: writer

        type(ieee_round_type) :: modes(4), before
        type(row_t) :: row
        type(status_t) :: status, worst
        real(wp), dimension(size(figure_names), 4) :: figures, units
        integer :: mode, k

        modes = [ieee_nearest, ieee_up, ieee_down, ieee_to_zero]
        call ieee_get_rounding_mode(before)
        do mode = 1, size(modes)
            call ieee_set_rounding_mode(modes(mode))
            if (whole) then
                call figures_of(solver, contact, figures(:, mode), units(:, mode), &
                                status)
            else
                call solve_directly(contact, figures(:, mode), status)
            end if
            call ieee_set_rounding_mode(before)
            if (mode == 1 .or. status%code > worst%code) worst = status
        end do
        if (.not. whole) call figures_of(solver, contact, units(:, 2), units(:, 1), &
                                         status)
        row = row_t(chapter='rounding', case=contact%name, method='strip+faststrip', &
                    reference='4 modes')
        if (.not. whole) row%method = 'solvers alone'
        call status_of(worst, row)
        do k = 1, size(figure_names)
            call put_value(writer, row, figure_names(k), &
                           (maxval(figures(k, :)) - minval(figures(k, :)))/units(k, 1))
        end do
    end subroutine round_contact

    !> The same figures without the part of the library that looks after its host.
    subroutine solve_directly(contact, figures, status)
        type(named_case_t), intent(in) :: contact
        real(wp), intent(out) :: figures(size(figure_names))
        type(status_t), intent(out) :: status

        integer, parameter :: capacity = 100
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
        type(normal_result_t) :: normal
        type(tangential_result_t) :: forces
        type(status_t) :: tangential_status

        figures = 0.0_wp
        call reserve_strips(strips, capacity, status)
        call reserve_strip_workspace(workspace, capacity, size(contact%gap%y), status)
        if (is_error(status)) return
        call set_strip_gap(workspace, contact%gap, status)
        if (is_error(status)) return
        call strip_solve_demand(workspace, normal_compliance(contact%material), contact%demand_t, &
                                strip_options_t(), strips, normal, status)
        if (is_error(status)) return
        call faststrip_tangential_solve(strips, contact%material, contact%mu, contact%creepage, &
                             default_points, forces, tangential_status)
        if (is_error(tangential_status)) status = tangential_status
        figures = [normal%penetration, normal%pmax, normal%area, forces%fx, forces%fy, forces%mz]
    end subroutine solve_directly
end module faststrip_lab_extremes_noise
