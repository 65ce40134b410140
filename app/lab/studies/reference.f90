!> `faststrip-lab bench reference`: times of Kalker's variational method.
!>
!> All are times of the processor: of many runs the median (`us` is an older name of it), the 95th
!> percentile and the worst. What a start costs elsewhere, the strips'
!> solution, is not counted; a coarser grid is.
module faststrip_lab_studies_reference
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_base_material, only: normal_compliance
    use faststrip_contact_method, only: workspace_t
    use faststrip_normal_strips, only: usual_strips
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, reserve_norm, &
                                       release_norm, set_norm_gap, norm_solve
    use faststrip_normal_types, only: normal_result_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, scattered
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_lab_studies_reference_tang, only: measure_tang
    use faststrip_command_program_clock, only: microseconds, cpu_microseconds, median, spread_of, &
                                               spread_text, spread_names, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    use faststrip_command_program_machine, only: machine_words
    implicit none
    private

    public :: bench_reference, bench_reference_most_elements

    !> The largest number of elements in contact that is measured.
    integer, parameter :: bench_reference_most_elements = 200000

    !> Elements in contact, about.
    integer, parameter :: sizes(10) = [500, 1000, 2000, 3700, 7500, 15000, 30000, 60000, 120000, &
                                       bench_reference_most_elements]

    ! How a solution starts: cold, with new plans and with those of the time before; from a
    ! grid with sides twice as long; from 15 strips; from the solution for 5 % more or less load.
    integer, parameter :: new_plans = 1, cold = 2, coarse = 3, strips = 4, warm_load = 5
    character(len=*), parameter :: starts(5) = [character(len=9) :: &
        'new_plans', 'cold', 'coarse', 'strips', 'warm_load']
    real(wp), parameter :: load_factor = 1.05_wp
    ! The contact conditions met to the last digits that show, and as an engineer needs them.
    real(wp), parameter :: tolerances(2) = [1.0e-9_wp, 1.0e-4_wp]

    integer, parameter :: fewest_runs = 3, most_runs = 200

    !> The contacts, and what solves them.
    type :: bench_t
        type(bench_case_t), allocatable :: cases(:)
        type(workspace_t) :: workspace
    end type bench_t

    !> What was measured of one contact.
    type :: times_t
        real(wp) :: us(size(spread_names)) = 0.0_wp ! median, 95th percentile, worst
        real(wp) :: iterations = 0.0_wp   ! on all grids
        real(wp) :: convolutions = 0.0_wp ! on all grids
        integer :: elements = 0           ! in contact
        integer :: grid = 0               ! in contact or not
        integer :: runs = 0
    end type times_t

contains

    !> Measure and write the CSV.
    subroutine bench_reference(file, folder, most_elements, seconds)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_elements   !! no larger number of elements in contact
        real(wp), intent(in) :: seconds        !! for each number of elements, >= 0

        type(bench_t) :: bench
        type(csv_writer_t) :: writer
        integer :: i

        call read_bench_cases(folder, bench%cases)
        call begin_table(writer, file)
        call put_header(writer, [character(len=13) :: 'method', 'start', 'tolerance', 'elements', &
                                 'us', 'iterations', 'convolutions', 'dx_mm', 'grid', 'flags', &
                                 'compiler', 'cpu', 'case', 'runs', cpu_columns])
        do i = 1, size(sizes)
            if (sizes(i) > most_elements) exit
            call measure_size(bench, sizes(i), 1.0e6_wp*seconds, writer)
            call measure_tang(bench%cases, sizes(i), 1.0e6_wp*seconds, writer)
        end do
        call end_table(writer)
    end subroutine bench_reference

    !> All starts with one number of elements, and as many contacts as the time allows.
    subroutine measure_size(bench, elements, budget_us, writer)
        type(bench_t), intent(inout) :: bench
        integer, intent(in) :: elements
        real(wp), intent(in) :: budget_us
        type(csv_writer_t), intent(inout) :: writer

        type(times_t) :: times
        real(wp) :: us(size(bench%cases), size(starts)), share, dx
        character(len=16) :: names(size(bench%cases), size(starts))
        integer(int64) :: begin, now
        integer :: i, k, start, t, counts(size(starts))
        logical :: solved

        counts = 0
        share = budget_us/(size(starts)*size(tolerances)*size(bench%cases))
        call system_clock(begin)
        do k = 1, size(bench%cases)
            i = scattered(k, size(bench%cases))
            dx = sqrt(bench%cases(i)%known%area/elements)
            do t = 1, size(tolerances)
                do start = 1, size(starts)
                    call measure_start(bench, i, start, tolerances(t), dx, share, times, solved)
                    if (.not. solved) cycle
                    if (t == 1) then
                        counts(start) = counts(start) + 1
                        us(counts(start), start) = times%us(1)
                        names(counts(start), start) = bench%cases(i)%name
                    end if
                    call put_cell(writer, 'norm')
                    call put_cell(writer, trim(starts(start)))
                    call put_cell(writer, tolerances(t))
                    call put_cell(writer, times%elements)
                    call put_cell(writer, times%us(1))
                    call put_cells(writer, [times%iterations, times%convolutions])
                    call put_cell(writer, dx)
                    call put_cell(writer, times%grid)
                    call put_cells(writer, machine_words())
                    call put_cell(writer, bench%cases(i)%name)
                    call put_cell(writer, times%runs)
                    call put_cells(writer, times%us)
                    call end_row(writer)
                end do
            end do
            call system_clock(now)
            if (microseconds(begin, now) > budget_us) exit
        end do
        call tell(elements, us, names, counts)
    end subroutine measure_size

    !> Say median, 95th percentile and worst over the contacts, which also shows that the work goes
    !> on.
    subroutine tell(elements, us, names, counts)
        integer, intent(in) :: elements, counts(:)
        real(wp), intent(in) :: us(:, :)
        character(len=*), intent(in) :: names(:, :)

        character(len=:), allocatable :: text
        integer :: start

        text = 'norm, ' // integer_text(elements) // ' elements, ' // integer_text(counts(cold)) &
               // ' contacts, processor ms, median/95th percentile/worst of them:'
        do start = 1, size(starts)
            text = text // ' ' // trim(starts(start)) // ' ' &
                   // spread_text(1.0e-3_wp*us(:counts(start), start), &
                                  names(:counts(start), start))
        end do
        call note(text)
    end subroutine tell

    !> Solve one contact again and again; `solved` is false if it cannot be.
    subroutine measure_start(bench, i, start, tolerance, dx, budget_us, times, solved)
        type(bench_t), intent(inout) :: bench
        integer, intent(in) :: i, start
        real(wp), intent(in) :: tolerance, dx, budget_us
        type(times_t), intent(out) :: times
        logical, intent(out) :: solved

        type(norm_workspace_t) :: workspace
        type(norm_options_t) :: options
        type(normal_result_t) :: result
        type(status_t) :: status
        real(wp), dimension(most_runs) :: us, iterations, convolutions
        real(wp) :: from, load
        integer(int64) :: begin, now
        integer :: round, run

        bench%workspace%strips%n = 0
        if (start == strips) then
            call solve_by_strips(bench%workspace, bench%cases(i), usual_strips, result, status)
            call fail_on_error(status)
        end if
        options = norm_options_t(dx=dx, dy=dx, tolerance=tolerance, two_levels=start == coarse)
        call system_clock(begin)
        ! Runs before the first make the plans, and the steps that the others alternate between.
        do round = -1, most_runs
            run = round
            load = bench%cases(i)%load
            if (start == warm_load .and. modulo(run, 2) == 0) load = load_factor*load
            options%warm_start = start == warm_load .and. run > -1
            if (start == new_plans .or. run == -1) then
                call release_norm(workspace)
                call reserve_norm(workspace, size(bench%cases(i)%gap%y), status)
                call fail_on_error(status)
                call set_norm_gap(workspace, bench%cases(i)%gap, status)
                call fail_on_error(status)
            end if
            from = cpu_microseconds()
            call norm_solve(workspace, normal_compliance(bench%cases(i)%material), load, options, &
                            result, status, bench%workspace%strips)
            if (run >= 1) us(run) = cpu_microseconds() - from
            solved = .not. is_error(status)
            if (.not. solved) then
                call note(bench%cases(i)%name // ', ' // trim(starts(start)) // ': ' &
                          // trim(status%message))
                return
            end if
            if (run < 1) cycle
            times%runs = run
            iterations(run) = result%iterations
            convolutions(run) = workspace%convolutions
            call system_clock(now)
            if (microseconds(begin, now) > budget_us .and. run >= fewest_runs) exit
        end do
        times%us = spread_of(us(:times%runs))
        times%iterations = median(iterations(:times%runs))
        times%convolutions = median(convolutions(:times%runs))
        times%elements = nint(result%area/dx**2)
        times%grid = workspace%grid%nx*workspace%grid%ny
    end subroutine measure_start
end module faststrip_lab_studies_reference
