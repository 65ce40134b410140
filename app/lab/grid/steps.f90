!> `faststrip-lab bench steps`: what the next solution of a history costs.
!>
!> From each of the paper's contacts a history goes on in steps of the load, of the wheelset's place
!> and of both at once; every step is solved warm, from the step before, and cold beside it. Times
!> are those of the processor, of each step the least of several rounds: so what another
!> program took is no part of the tail, and the tail is the solver's own.
module faststrip_lab_grid_steps
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_base_material, only: normal_compliance
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_contact_case, only: contact_case_t
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, read_scene_cases
    use faststrip_lab_grid_paper_gaps, only: paper_profiles_t, make_paper_profiles, gap_of_shift
    use faststrip_command_program_clock, only: cpu_microseconds, spread_text
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    implicit none
    private

    public :: bench_steps

    !> What changes from step to step; `cold` is no history: each contact and scene by itself.
    integer, parameter :: load_steps = 1, shift_steps = 2, steps_of_both = 3, cold = 4
    character(len=*), parameter :: kinds(4) = [character(len=5) :: 'load', 'shift', 'both', 'cold']

    ! Tuned [steps]: of a history, half of them before the contact. Origin: chosen: by 2.5 % the
    ! load goes from .78 to 1.28 of the contact's, the wheelset goes 2 mm.
    integer, parameter :: n_steps = 20
    ! Given: the steps that are promised: of the load alone, with the place, and of the place, mm.
    real(wp), parameter :: load_factor = 1.025_wp, larger_factor = 1.05_wp, shift_step = 0.1_wp
    ! Tuned [patches; points]: room for a solution and its gap. Origin: capacity.
    integer, parameter :: most_patches = 4, most_points = 4000
    ! Tuned [1]: tolerance of the solutions that errors are against. Origin: digits of a number.
    real(wp), parameter :: reference_tolerance = 1.0e-11_wp

    !> What solves.
    type :: bench_t
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
        integer :: rounds = 0
        integer :: asked = 0 !! strips
    end type bench_t

    !> One step: what is solved, and what came of it.
    type, extends(contact_case_t) :: step_t
        real(wp) :: shift = 0.0_wp ! mm
        real(wp) :: warm_us = 0.0_wp, cold_us = 0.0_wp, reference_us = 0.0_wp
        type(normal_result_t) :: warm, cold, reference
        type(status_t) :: status
    end type step_t

    !> Times of one kind of step, and whose was worst.
    type :: tally_t
        integer :: n = 0
        real(wp), allocatable :: us(:), cold_us(:)
        integer, allocatable :: iterations(:)
        real(wp) :: worst_us = 0.0_wp
        character(len=:), allocatable :: worst
    end type tally_t

contains

    !> Measure and write the CSV.
    subroutine bench_steps(file, folder, scenes, strips, rounds)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        character(len=*), intent(in) :: scenes !! CSV of the contacts of many kinds
        integer, intent(in) :: strips          !! strips of the widest patch, >= 3
        integer, intent(in) :: rounds          !! how often every step is timed, >= 1

        type(bench_t) :: bench
        type(bench_case_t), allocatable :: cases(:)
        type(bench_case_t), allocatable :: others(:)
        type(step_t), allocatable :: history(:)
        type(paper_profiles_t) :: profiles
        type(csv_writer_t) :: writer
        type(tally_t) :: tally
        type(status_t) :: status
        integer :: i, kind

        call read_bench_cases(folder, cases)
        call read_scene_cases(scenes, others)
        call make_paper_profiles(profiles)
        bench%rounds = rounds
        bench%asked = strips
        call reserve_strips(bench%strips, most_patches*(2*strips + 1), status)
        call fail_on_error(status)
        i = max(most_points, maxval([(size(cases(i)%gap%y), i=1, size(cases))]), &
                maxval([(size(others(i)%gap%y), i=1, size(others))]))
        call reserve_strip_workspace(bench%workspace, most_patches*(2*strips + 1), i, status)
        call fail_on_error(status)
        call begin_table(writer, file)
        call put_header(writer, [character(len=15) :: 'kind', 'case', 'step', 'load_N', &
                                 'shift_mm', 'strips', 'n_patches', 'strips_across', 'cpu_us', &
                                 'cold_us', 'iterations', 'factorings', 'values', 'gradients', &
                                 'cold_iterations', 'err_penetration', 'err_pmax', 'err_area', &
                                 'status'])
        do kind = load_steps, steps_of_both
            call start_tally(size(cases)*(n_steps + 1), tally)
            do i = 1, size(cases)
                call make_steps(cases(i), kind, profiles, history)
                call run_history(bench, history)
                call put_history(cases(i)%name, kind, strips, history, writer, tally)
            end do
            call tell(kind, tally)
        end do
        call start_tally(size(cases) + size(others), tally)
        do i = 1, size(cases)
            call make_history(cases(i), history)
            history%shift = cases(i)%shift
            call run_history(bench, history)
            call put_history(cases(i)%name, cold, strips, history, writer, tally)
        end do
        do i = 1, size(others)
            if (.not. others(i)%by_load) cycle
            call make_history(others(i), history)
            call run_history(bench, history)
            call put_history(others(i)%name, cold, strips, history, writer, tally)
        end do
        call tell(cold, tally)
        call end_table(writer)
    end subroutine bench_steps

    !> A history of one solution.
    subroutine make_history(one, history)
        class(contact_case_t), intent(in) :: one
        type(step_t), allocatable, intent(out) :: history(:)

        allocate (history(1))
        history(1)%gap = one%gap
        history(1)%load = one%load
        history(1)%material = one%material
    end subroutine make_history

    !> The steps of a history, with the contact itself in their middle.
    subroutine make_steps(one, kind, profiles, history)
        type(bench_case_t), intent(in) :: one
        integer, intent(in) :: kind
        type(paper_profiles_t), intent(in) :: profiles
        type(step_t), allocatable, intent(out) :: history(:)

        real(wp) :: factor
        integer :: k

        allocate (history(0:n_steps))
        factor = merge(larger_factor, load_factor, kind == steps_of_both)
        do k = 0, n_steps
            history(k)%material = one%material
            history(k)%load = one%load
            if (kind /= shift_steps) history(k)%load = one%load*factor**(k - n_steps/2)
            history(k)%shift = one%shift
            if (kind == load_steps) then
                history(k)%gap = one%gap
            else
                history(k)%shift = one%shift + shift_step*(k - n_steps/2)
                call gap_of_shift(profiles, history(k)%shift, history(k)%gap)
            end if
        end do
    end subroutine make_steps

    !> Solve a history, each step warm (the first one cold), cold, and cold to all digits.
    subroutine run_history(bench, history)
        type(bench_t), intent(inout) :: bench
        type(step_t), intent(inout) :: history(:)

        type(strip_options_t) :: options
        type(status_t) :: status
        integer :: round, k

        options%strips_per_patch = bench%asked
        history%warm_us = huge(1.0_wp)
        history%cold_us = huge(1.0_wp)
        do round = 1, bench%rounds
            do k = 1, size(history)
                options%warm_start = k > 1
                call time_solution(bench, history(k), options, history(k)%warm_us, &
                                   history(k)%warm, history(k)%status)
            end do
        end do
        options%warm_start = .false.
        do k = 1, size(history)
            do round = 1, bench%rounds
                call time_solution(bench, history(k), options, history(k)%cold_us, &
                                   history(k)%cold, status)
            end do
        end do
        options%tolerance = reference_tolerance
        do k = 1, size(history)
            history(k)%reference_us = huge(1.0_wp)
            call time_solution(bench, history(k), options, history(k)%reference_us, &
                               history(k)%reference, status)
        end do
    end subroutine run_history

    !> Solve one step; the time is kept if it is less than that of the rounds before.
    subroutine time_solution(bench, step, options, us, result, status)
        type(bench_t), intent(inout) :: bench
        type(step_t), intent(in) :: step
        type(strip_options_t), intent(in) :: options
        real(wp), intent(inout) :: us
        type(normal_result_t), intent(inout) :: result
        type(status_t), intent(out) :: status

        real(wp) :: from

        call set_strip_gap(bench%workspace, step%gap, status)
        if (is_error(status)) return
        from = cpu_microseconds()
        call strip_solve(bench%workspace, normal_compliance(step%material), step%load, options, &
                         bench%strips, result, status)
        us = min(us, cpu_microseconds() - from)
    end subroutine time_solution

    !> Write the rows of a history and count its times; a first step is no warm one.
    subroutine put_history(name, kind, strips, history, writer, tally)
        character(len=*), intent(in) :: name
        integer, intent(in) :: kind, strips
        type(step_t), intent(in) :: history(:)
        type(csv_writer_t), intent(inout) :: writer
        type(tally_t), intent(inout) :: tally

        integer :: k

        do k = merge(1, 2, kind == cold), size(history)
            associate (step => history(k))
                call put_cell(writer, trim(kinds(kind)))
                call put_cell(writer, name)
                call put_cell(writer, k - 1)
                call put_cells(writer, [step%load, step%shift])
                call put_cells(writer, [strips, step%warm%n_patches, step%warm%strips_across])
                call put_cells(writer, [step%warm_us, step%cold_us])
                call put_cells(writer, [step%warm%cost%iterations, step%warm%cost%factorings, &
                                        step%warm%cost%values, step%warm%cost%gradients, &
                                        step%cold%cost%iterations])
                call put_cells(writer, [step%warm%penetration/step%reference%penetration - 1.0_wp, &
                                        step%warm%pmax/step%reference%pmax - 1.0_wp, &
                                        step%warm%area/step%reference%area - 1.0_wp])
                call put_cell(writer, trim(status_word(step%status%code)))
                call end_row(writer)
                tally%n = tally%n + 1
                tally%us(tally%n) = step%warm_us
                tally%cold_us(tally%n) = step%cold_us
                tally%iterations(tally%n) = step%warm%cost%iterations
                if (step%warm_us < tally%worst_us) cycle
                tally%worst_us = step%warm_us
                tally%worst = name // ', step ' // integer_text(k - 1)
            end associate
        end do
    end subroutine put_history

    subroutine start_tally(most, tally)
        integer, intent(in) :: most
        type(tally_t), intent(out) :: tally

        allocate (tally%us(most), tally%cold_us(most), source=0.0_wp)
        allocate (tally%iterations(most), source=0)
        tally%worst = ''
    end subroutine start_tally

    !> Say median, 95th percentile and worst of one kind.
    subroutine tell(kind, tally)
        integer, intent(in) :: kind
        type(tally_t), intent(in) :: tally

        call note(trim(kinds(kind)) // ': ' // integer_text(tally%n) &
                  // ' solutions, processor us, median/95th percentile/worst: ' &
                  // spread_text(tally%us(:tally%n)) // ' (' // tally%worst // '), over cold: ' &
                  // spread_text(tally%us(:tally%n)/tally%cold_us(:tally%n)) // ', steps: ' &
                  // spread_text(real(tally%iterations(:tally%n), wp)))
    end subroutine tell
end module faststrip_lab_grid_steps
