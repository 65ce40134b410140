!> `faststrip-lab bench host`: what the next call of a vehicle code takes.
!>
!> Wheelsets walk in small steps: about the middle of the track, in a curve, at the root of the
!> flange, where a wheel bears in two places, and from flange to flange. Each call starts from the
!> last one; the first of a walk is not counted. Its height and roll where they are given are those
!> that carry the loads. Times are those of the processor, of each call the least of the rounds:
!> the tail is the solver's own.
module faststrip_lab_studies_host
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, st_ok
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_derivatives, only: find_wheelset_derivatives
    use faststrip_wheelset_model, only: reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, side_right, &
                                        demand_position, demand_loads
    use faststrip_lab_checkout, only: in_checkout
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_grid_normal, only: fastsim_time
    use faststrip_command_program_clock, only: cpu_microseconds, spread_of, spread_text, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, note, progress, begin_table, &
                                                 end_table
    use faststrip_command_program_machine, only: cpu_name
    use faststrip_command_program_system, only: instructions
    use faststrip_command_wheelset_case, only: wheelset_case_t, read_wheelset_case, make_model
    implicit none
    private

    public :: bench_host

    !> A way there and back, with a yaw that changes along it.
    type :: walk_t
        character(len=12) :: name = ''
        real(wp) :: y(2) = 0.0_wp   !! its ends, mm
        real(wp) :: yaw(2) = 0.0_wp !! there, rad
    end type walk_t

    ! Tuned [mm; rad]: where wheelsets walk. Origin: chosen; two contacts and flange are those of
    ! S1002 on 60E1.
    type(walk_t), parameter :: walks(5) = [ &
        walk_t('straight', [-0.5_wp, 0.5_wp], [-0.4e-3_wp, 0.4e-3_wp]), &
        walk_t('curve', [3.0_wp, 4.0_wp], [1.0e-3_wp, 2.0e-3_wp]), &
        walk_t('two contacts', [5.0_wp, 6.0_wp], [2.0e-3_wp, 3.0e-3_wp]), &
        walk_t('flange root', [6.5_wp, 7.5_wp], [3.0e-3_wp, 4.0e-3_wp]), &
        walk_t('all', [-8.0_wp, 8.0_wp], [-6.4e-3_wp, 6.4e-3_wp])]
    ! Given: the last is walked from end to end, once, in steps of one length.
    integer, parameter :: all_of_it = size(walks)
    ! Tuned [mm]: steps. Origin: chosen: a millisecond's and those of integrators beside it.
    real(wp), parameter :: steps(3) = [1.0e-3_wp, 1.0e-2_wp, 1.0e-1_wp]
    ! Tuned [mm]: steps of all of it; in the quick bench. Origin: chosen.
    real(wp), parameter :: steps_of_all(2) = [1.0e-2_wp, 0.5_wp]
    ! Tuned [calls]: of a walk; in the quick bench. Origin: chosen.
    integer, parameter :: usual_calls = 100, few_calls = 5
    ! Tuned [N; mm/s]: of each wheel; along the track. Origin: as in example/wheelset_states.csv.
    real(wp), parameter :: load = 5.0e4_wp, speed = 2.0e4_wp

    ! What is prescribed, and what is asked for.
    integer, parameter :: height_given = 1, loads_given = 2, roll_free = 3
    character(len=*), parameter :: demands(3) = [character(len=9) :: 'z given', 'loads', &
                                                 'free roll']
    integer, parameter :: estimates = 2, derivatives = 3
    character(len=*), parameter :: wanted(3) = [character(len=11) :: 'forces', 'estimates', &
                                                'derivatives']

    !> A wheelset and its solution.
    type :: pair_t
        character(len=:), allocatable :: name
        type(wheelset_model_t) :: model
        type(wheelset_result_t) :: result
    end type pair_t

    !> What the calls of a walk took; the first is number 0.
    type :: calls_t
        type(wheelset_state_t), allocatable :: state(:)
        real(wp), allocatable :: us(:)           !! least of the rounds
        real(wp), allocatable :: instructions(:) !! thousands; so, too
        real(wp), allocatable :: solutions(:)    !! contact problems that were solved, both wheels
        logical, allocatable :: is_ok(:)
    end type calls_t

contains

    !> Measure and write the CSV.
    subroutine bench_host(file, measured, rounds, quick)
        character(len=*), intent(in) :: file     !! to write, - for stdout
        character(len=*), intent(in) :: measured !! case file of a wheelset with measured profiles
        integer, intent(in) :: rounds            !! how often all is timed, >= 1
        logical, intent(in) :: quick             !! few calls

        type(bench_case_t), allocatable :: cases(:)
        type(pair_t) :: pairs(2)
        type(wheelset_workspace_t) :: workspaces(2)
        type(calls_t) :: calls
        type(csv_writer_t) :: writer
        real(wp) :: length, fastsim_us
        integer :: i, walk, step, demand, want
        logical :: counts

        call make_pair(in_checkout('example/wheelset_states.nml'), pairs(1), workspaces(1))
        call make_pair(measured, pairs(2), workspaces(2))
        call read_bench_cases(in_checkout('reference/contact'), cases)
        counts = instructions() >= 0
        if (.not. counts) call note('instructions cannot be counted on this machine: their ' &
                                    // 'columns are empty')
        call begin_table(writer, file)
        call put_header(writer, [character(len=20) :: 'pair', 'walk', 'step_um', 'demand', 'with', &
                                 'calls', 'ok_share', cpu_columns, 'worst_y_mm', 'fastsim_us', &
                                 'ratio', 'solutions_median', 'solutions_worst', &
                                 'kinstructions_median', 'kinstructions_worst', 'cpu'])
        do i = 1, size(pairs)
            do walk = 1, size(walks)
                do step = 1, merge(1, size(steps), walk == all_of_it)
                    length = steps(step)
                    if (walk == all_of_it) length = steps_of_all(merge(2, 1, quick))
                    call progress(pairs(i)%name // ', walks', walk, size(walks))
                    call make_walk(pairs(i), workspaces(i), walks(walk), length, &
                                   walk == all_of_it, quick, calls)
                    fastsim_us = fastsim_time(cases(1), cases(1)%material)
                    do demand = 1, size(demands)
                        do want = 1, size(wanted)
                            call time_walk(pairs(i), workspaces(i), calls, demand, want, rounds)
                            call put_walk()
                        end do
                    end do
                end do
            end do
        end do
        call end_table(writer)

    contains

        subroutine put_walk()
            real(wp) :: us(3), solutions(3), thousands(3)
            integer :: n

            n = size(calls%us)
            us = spread_of(calls%us)
            solutions = spread_of(calls%solutions)
            thousands = spread_of(calls%instructions)
            call put_cell(writer, pairs(i)%name)
            call put_cell(writer, trim(walks(walk)%name))
            call put_cell(writer, length/steps(1))
            call put_cell(writer, trim(demands(demand)))
            call put_cell(writer, trim(wanted(want)))
            call put_cell(writer, n)
            call put_cells(writer, [real(count(calls%is_ok), wp)/n, us, &
                                    calls%state(maxloc(calls%us, 1))%y, fastsim_us, &
                                    us(1)/fastsim_us, solutions(1), solutions(3)])
            call put_cell(writer, thousands(1), is_known=counts)
            call put_cell(writer, thousands(3), is_known=counts)
            call put_cell(writer, cpu_name())
            call end_row(writer)
            if (walk /= all_of_it) return
            call note(pairs(i)%name // ', ' // trim(demands(demand)) // ', ' // trim(wanted(want)) &
                      // ': ' // spread_text(calls%us) // ' us, the worst ' &
                      // trim(number_text(us(3)/us(1))) // ' times the median, at y = ' &
                      // trim(number_text(calls%state(maxloc(calls%us, 1))%y)) // ' mm')
        end subroutine put_walk
    end subroutine bench_host

    !> The wheelset of a case file.
    subroutine make_pair(path, pair, workspace)
        character(len=*), intent(in) :: path
        type(pair_t), intent(out) :: pair
        type(wheelset_workspace_t), intent(inout) :: workspace

        type(wheelset_case_t) :: case
        type(status_t) :: status

        call read_wheelset_case(path, case)
        call make_model(path, case, pair%model)
        call reserve_wheelset(workspace, pair%model, status)
        call fail_on_error(status, path)
        pair%name = case%bodies%wheel%name // ' on ' // case%bodies%rail%name
    end subroutine make_pair

    !> The states of a walk, there and back, or all of it once from end to end. Heights and rolls
    !> are those of both wheels under their loads; where there are none, the last ones.
    subroutine make_walk(pair, workspace, walk, step, is_whole, quick, calls)
        type(pair_t), intent(inout) :: pair
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(walk_t), intent(in) :: walk
        real(wp), intent(in) :: step
        logical, intent(in) :: is_whole, quick
        type(calls_t), intent(out) :: calls

        type(wheelset_state_t) :: state
        type(status_t) :: status
        real(wp) :: width, share
        integer :: i, n

        width = walk%y(2) - walk%y(1)
        n = merge(few_calls, usual_calls, quick)
        if (is_whole) n = nint(width/step)
        allocate (calls%state(0:n), calls%us(n), calls%instructions(n), &
                  calls%solutions(n), calls%is_ok(n))
        state%speed = speed
        workspace%has_last = .false.
        do i = 0, n
            share = 1.0_wp - abs(1.0_wp - modulo(i*step/width, 2.0_wp))
            state%y = walk%y(1) + share*width
            state%yaw = walk%yaw(1) + share*(walk%yaw(2) - walk%yaw(1))
            call solve_wheelset(pair%model, workspace, state, demand_of(roll_free), &
                                pair%result, status)
            if (.not. is_error(status)) then
                state%z = pair%result%wheel(side_right)%z
                state%roll = pair%result%wheel(side_right)%roll
            end if
            calls%state(i) = state
        end do
    end subroutine make_walk

    type(wheelset_demand_t) function demand_of(demand)
        integer, intent(in) :: demand !! one of `demands`

        demand_of%kind = merge(demand_position, demand_loads, demand == height_given)
        demand_of%load = load
        demand_of%roll_is_free = demand == roll_free
    end function demand_of

    !> Time all calls of a walk.
    subroutine time_walk(pair, workspace, calls, demand, want, rounds)
        type(pair_t), intent(inout) :: pair
        type(wheelset_workspace_t), intent(inout) :: workspace
        type(calls_t), intent(inout) :: calls
        integer, intent(in) :: demand, want, rounds

        type(wheelset_demand_t) :: prescribed
        type(status_t) :: status, last
        real(wp) :: from, counted, slopes(6, 9, 2)
        integer :: round, i

        prescribed = demand_of(demand)
        pair%model%case%estimate = want == estimates
        calls%us = huge(1.0_wp)
        calls%instructions = huge(1.0_wp)
        do round = 1, rounds
            workspace%has_last = .false.
            do i = 0, size(calls%us)
                last%code = st_ok
                counted = real(instructions(), wp)
                from = cpu_microseconds()
                call solve_wheelset(pair%model, workspace, calls%state(i), prescribed, &
                                    pair%result, status)
                if (want == derivatives .and. .not. is_error(status)) &
                    call find_wheelset_derivatives(pair%model, workspace, prescribed%wants, &
                                                   pair%result, slopes, last)
                from = cpu_microseconds() - from
                counted = (real(instructions(), wp) - counted)/1.0e3_wp ! Given: thousands
                if (i == 0) cycle
                calls%us(i) = min(calls%us(i), from)
                calls%instructions(i) = min(calls%instructions(i), counted)
                calls%solutions(i) = sum(pair%result%wheel%solutions)
                calls%is_ok(i) = status%code == st_ok .and. last%code == st_ok
            end do
        end do
        pair%model%case%estimate = .true.
    end subroutine time_walk
end module faststrip_lab_studies_host
