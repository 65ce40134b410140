!> `faststrip-lab bench normal`: times of the strip solver.
!>
!> All are times of the processor, of many runs the median (`us` is an older name of it), the 95th
!> percentile and the worst; parts are medians alone. So a machine that also does other
!> work gives nearly the same; a linear algebra library must not share a solution among threads
!> (OPENBLAS_NUM_THREADS=1), or the time of all of them counts.
module faststrip_lab_grid_normal
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_numerics_lu, only: lu_factor, lu_solve
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve_gap
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t, cost_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_fastsim, only: fastsim_solve
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases, scattered
    use faststrip_lab_grid_column_times, only: column_ns, centre, tip, centre_gradient, tip_gradient
    use faststrip_lab_grid_paper_gaps, only: paper_profiles_t, make_paper_profiles, gap_of_shift
    use faststrip_command_program_clock, only: microseconds, cpu_microseconds, median, spread_of, &
                                               spread_text, spread_names, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    use faststrip_command_program_machine, only: machine_words
    implicit none
    private

    public :: bench_normal, bench_normal_most_strips, fastsim_time

    !> The largest number of strips that is measured.
    integer, parameter :: bench_normal_most_strips = 400

    integer, parameter :: strip_counts(17) = [5, 7, 9, 11, 15, 21, 27, 31, 41, 61, 81, 101, 141, &
                                              201, 251, 301, bench_normal_most_strips]

    ! How a solution starts: cold, or from the step before, which had 5 % more or less
    ! load, or from which the wheelset has moved sideways.
    integer, parameter :: cold = 1, warm_load = 2, warm_shift = 3
    character(len=*), parameter :: starts(3) = [character(len=10) :: &
        'cold', 'warm_load', 'warm_shift']
    real(wp), parameter :: load_factor = 1.05_wp, shift_step = 0.05_wp

    integer, parameter :: fewest_runs = 3, most_runs = 400
    integer, parameter :: fastsim_elements = 50
    real(wp), parameter :: mu = 0.3_wp

    !> Two contacts that follow each other, and what solves them.
    type :: bench_t
        type(material_t) :: material
        type(bench_case_t), allocatable :: cases(:)
        type(gap_t), allocatable :: before(:), after(:) ! of each shift, and 0.05 mm further
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
    end type bench_t

    !> What was measured of one contact.
    type :: times_t
        real(wp) :: us(size(spread_names)) = 0.0_wp ! of a solution, see `spread_of`
        real(wp) :: gap_us = 0.0_wp     ! of handing over the gap
        real(wp) :: iterations = 0.0_wp ! steps
        real(wp) :: factorings = 0.0_wp ! those of them with a Jacobian
        real(wp) :: values = 0.0_wp, gradients = 0.0_wp ! influence coefficients computed
        real(wp) :: operations = 0.0_wp ! of the linear algebra
        integer :: runs = 0
    end type times_t

contains

    !> Measure and write the CSV.
    subroutine bench_normal(file, folder, most_strips, seconds)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_strips     !! no larger number of strips
        real(wp), intent(in) :: seconds        !! for each number of strips, >= 0

        type(bench_t) :: bench
        type(csv_writer_t) :: writer
        integer :: i

        call prepare(folder, bench)
        call begin_table(writer, file)
        call put_header(writer, [character(len=13) :: 'start', 'strips', 'us', 'iterations', &
                                 'ns_per_entry', 'fastsim_us', 'ratio', 'flags', 'compiler', &
                                 'cpu', 'gap_us', 'case', 'runs', &
                                 'factorings', 'ns_per_value', 'entries_us', 'algebra_us', &
                                 cpu_columns])
        do i = 1, size(strip_counts)
            if (strip_counts(i) > most_strips) exit
            call measure_strips(bench, strip_counts(i), 1.0e6_wp*seconds, writer)
        end do
        call end_table(writer)
    end subroutine bench_normal

    !> Read the contacts, and make the gaps of two steps from the profiles.
    subroutine prepare(folder, bench)
        character(len=*), intent(in) :: folder
        type(bench_t), intent(out) :: bench

        type(paper_profiles_t) :: profiles
        type(status_t) :: status
        integer :: i, points

        call read_bench_cases(folder, bench%cases)
        call make_paper_profiles(profiles)
        allocate (bench%before(size(bench%cases)), bench%after(size(bench%cases)))
        points = 0
        do i = 1, size(bench%cases)
            call gap_of_shift(profiles, bench%cases(i)%shift, bench%before(i))
            call gap_of_shift(profiles, bench%cases(i)%shift + shift_step, bench%after(i))
            points = max(points, size(bench%cases(i)%gap%y), size(bench%before(i)%y), &
                         size(bench%after(i)%y))
        end do
        i = 2*maxval(strip_counts) + 60
        call reserve_strips(bench%strips, i, status)
        call fail_on_error(status)
        call reserve_strip_workspace(bench%workspace, i, points, status)
        call fail_on_error(status)
    end subroutine prepare

    !> All contacts and starts with one number of strips, as far as the time goes.
    subroutine measure_strips(bench, n, budget_us, writer)
        type(bench_t), intent(inout) :: bench
        integer, intent(in) :: n
        real(wp), intent(in) :: budget_us
        type(csv_writer_t), intent(inout) :: writer

        type(times_t) :: times
        real(wp) :: entry_ns, value_ns, operation_ns, fastsim_us, share
        real(wp) :: us(size(bench%cases), size(starts))
        real(wp) :: fastsim(size(bench%cases))
        character(len=16) :: names(size(bench%cases), size(starts))
        integer(int64) :: begin, now
        integer :: i, k, start, counts(size(starts)), n_fastsim
        logical :: solved

        counts = 0
        n_fastsim = 0
        share = budget_us/(size(starts)*size(bench%cases))
        call system_clock(begin)
        do k = 1, size(bench%cases)
            i = scattered(k, size(bench%cases))
            fastsim_us = fastsim_time(bench%cases(i), bench%material)
            if (fastsim_us > 0.0_wp) then
                n_fastsim = n_fastsim + 1
                fastsim(n_fastsim) = fastsim_us
            end if
            entry_ns = 0.0_wp
            value_ns = 0.0_wp
            operation_ns = 0.0_wp
            do start = 1, size(starts)
                call measure_start(bench, i, start, n, share, times, solved)
                if (.not. solved) cycle
                counts(start) = counts(start) + 1
                us(counts(start), start) = times%us(1)
                names(counts(start), start) = bench%cases(i)%name
                if (entry_ns == 0.0_wp) then
                    entry_ns = entry_time(bench%strips, centre_gradient, tip_gradient)
                    value_ns = entry_time(bench%strips, centre, tip)
                    operation_ns = operation_time(2*bench%strips%n + 3)
                end if
                call put_cell(writer, trim(starts(start)))
                call put_cell(writer, n)
                call put_cell(writer, times%us(1))
                call put_cell(writer, times%iterations)
                call put_cells(writer, [entry_ns, fastsim_us, times%us(1)/fastsim_us])
                call put_cells(writer, machine_words())
                call put_cell(writer, times%gap_us)
                call put_cell(writer, bench%cases(i)%name)
                call put_cell(writer, times%runs)
                call put_cells(writer, [times%factorings, value_ns, 1.0e-3_wp*(value_ns &
                                        *times%values + entry_ns*times%gradients), &
                                        1.0e-3_wp*operation_ns*times%operations])
                call put_cells(writer, times%us)
                call end_row(writer)
            end do
            call system_clock(now)
            if (microseconds(begin, now) > budget_us) exit
        end do
        call tell(n, us, names, counts, median(fastsim(:n_fastsim)))
    end subroutine measure_strips

    !> Say median, 95th percentile and worst over the contacts, which also shows that the work goes
    !> on.
    subroutine tell(n, us, names, counts, fastsim_us)
        integer, intent(in) :: n, counts(:)
        real(wp), intent(in) :: us(:, :), fastsim_us
        character(len=*), intent(in) :: names(:, :)

        character(len=:), allocatable :: text
        integer :: start

        text = integer_text(n) // ' strips, ' // integer_text(counts(cold)) // &
               ' contacts, processor us, median/95th percentile/worst of them:'
        do start = 1, size(starts)
            text = text // ' ' // trim(starts(start)) // ' ' &
                   // spread_text(us(:counts(start), start), names(:counts(start), start)) // ','
        end do
        call note(text // ' FASTSIM ' // trim(number_text(fastsim_us)) // ' us')
    end subroutine tell

    !> Solve one contact again and again; `solved` is false if it cannot be.
    subroutine measure_start(bench, i, start, n, budget_us, times, solved)
        type(bench_t), intent(inout) :: bench
        integer, intent(in) :: i, start, n
        real(wp), intent(in) :: budget_us
        type(times_t), intent(out) :: times
        logical, intent(out) :: solved

        type(strip_options_t) :: options
        type(normal_result_t) :: result
        type(status_t) :: status
        real(wp) :: us(most_runs), gap_us(most_runs), load
        type(cost_t) :: costs(most_runs)
        real(wp) :: from, between, to
        integer(int64) :: begin, now
        integer :: run, first
        logical :: second_step

        options%strips_per_patch = n
        ! The first two warm runs make the two steps that the others alternate between.
        first = merge(1, -1, start == cold)
        call system_clock(begin)
        do run = first, most_runs
            second_step = modulo(run, 2) == 0 .and. start /= cold
            load = bench%cases(i)%load
            if (second_step .and. start == warm_load) load = load_factor*load
            options%warm_start = run > first .and. start /= cold
            from = cpu_microseconds()
            if (start /= warm_shift) then
                call set_strip_gap(bench%workspace, bench%cases(i)%gap, status)
            else if (second_step) then
                call set_strip_gap(bench%workspace, bench%after(i), status)
            else
                call set_strip_gap(bench%workspace, bench%before(i), status)
            end if
            between = cpu_microseconds()
            if (.not. is_error(status)) &
                call strip_solve(bench%workspace, normal_compliance(bench%material), load, &
                                 options, bench%strips, result, status)
            to = cpu_microseconds()
            solved = .not. is_error(status)
            if (.not. solved) then
                call note(bench%cases(i)%name // ', ' // integer_text(n) // ' strips, ' &
                          // trim(starts(start)) // ': ' // trim(status%message))
                return
            end if
            if (run < 1) cycle
            times%runs = run
            gap_us(run) = between - from
            us(run) = to - between
            costs(run) = result%cost
            call system_clock(now)
            if (microseconds(begin, now) > budget_us .and. &
                (run >= fewest_runs .or. us(run) > budget_us)) exit
        end do
        times%us = spread_of(us(:times%runs))
        times%gap_us = median(gap_us(:times%runs))
        times%iterations = median(real(costs(:times%runs)%iterations, wp))
        times%factorings = median(real(costs(:times%runs)%factorings, wp))
        times%values = median(real(costs(:times%runs)%values, wp))
        times%gradients = median(real(costs(:times%runs)%gradients, wp))
        times%operations = median(real(costs(:times%runs)%operations, wp))
    end subroutine measure_start

    !> Time of one influence coefficient of a solved contact, ns: on the centre lines and at the
    !> tips, as one iteration needs them.
    real(wp) function entry_time(strips, of_centre, of_tip)
        type(contact_strips_t), intent(in) :: strips
        integer, intent(in) :: of_centre, of_tip ! with derivatives or without

        integer, parameter :: runs = 7, fewest_entries = 2500
        real(wp) :: ns(runs)
        integer :: run

        do run = 1, runs
            ns(run) = 0.5_wp*(column_ns(of_centre, strips, fewest_entries) &
                              + column_ns(of_tip, strips, fewest_entries))
        end do
        entry_time = median(ns)
    end function entry_time

    !> Time of one operation in the factorisation and solution of m equations, ns.
    real(wp) function operation_time(m)
        integer, intent(in) :: m

        integer, parameter :: runs = 5
        real(wp), allocatable :: a(:, :), factors(:, :), b(:)
        integer, allocatable :: pivot(:)
        real(wp) :: us(runs), from
        integer :: run, i, k, repetitions
        logical :: singular

        allocate (a(m, m), factors(m, m), b(m), pivot(m))
        do k = 1, m
            do i = 1, m
                a(i, k) = 1.0_wp/(1.0_wp + abs(i - k))
            end do
        end do
        repetitions = 1 + 100000/m**3
        do run = 1, runs
            from = cpu_microseconds()
            do i = 1, repetitions
                factors = a
                b = 1.0_wp
                call lu_factor(m, factors, pivot, singular)
                if (.not. singular) call lu_solve(m, factors, pivot, b)
            end do
            us(run) = (cpu_microseconds() - from)/repetitions
        end do
        operation_time = 1.0e3_wp*median(us)/(2.0_wp/3.0_wp*real(m, wp)**3 + 2.0_wp*real(m, wp)**2)
    end function operation_time

    !> Time of FASTSIM on the Hertz ellipse of a contact, us; not a number if it has none.
    real(wp) function fastsim_time(case, material) result(time)
        type(bench_case_t), intent(in) :: case     !! its gap, load, creepages
        type(material_t), intent(in) :: material   !! MPa

        integer, parameter :: runs = 7, repetitions = 20
        type(gap_curve_t) :: curve
        type(hertz_t) :: hertz
        type(tangential_result_t) :: result
        type(status_t) :: status
        real(wp) :: us(runs), from
        integer :: run, k

        time = ieee_value(time, ieee_quiet_nan)
        call reserve_gap_curve(curve, size(case%gap%y), status)
        call fail_on_error(status)
        call set_gap_curve(curve, case%gap, status)
        call fail_on_error(status)
        call hertz_solve_gap(curve, normal_compliance(material), case%load, hertz, status)
        if (is_error(status)) return
        do run = 1, runs
            from = cpu_microseconds()
            do k = 1, repetitions
                call fastsim_solve(hertz, material, mu, case%creepage, fastsim_elements, &
                                   fastsim_elements, result, status)
            end do
            us(run) = (cpu_microseconds() - from)/repetitions
            if (is_error(status)) return
        end do
        time = median(us)
    end function fastsim_time
end module faststrip_lab_grid_normal
