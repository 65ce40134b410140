!> The part of `faststrip-lab bench reference` that times TANG.
!>
!> Pressures are NORM's on the same grid, which is not counted. Iterations are those inside Newton's
!> steps, each applies the influence once.
module faststrip_lab_studies_reference_tang
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_cell, put_cells, end_row
    use faststrip_base_creepage, only: creepage_t
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t
    use faststrip_lab_pressures, only: solve_by_norm
    use faststrip_kalker_grid, only: contact_grid_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           edges_of_norm
    use faststrip_lab_grid_cases, only: bench_case_t, scattered
    use faststrip_command_program_clock, only: microseconds, cpu_microseconds, median, spread_of, &
                                               spread_text, spread_names
    use faststrip_command_program_console, only: fail_on_error, note
    use faststrip_command_program_machine, only: machine_words
    implicit none
    private

    public :: measure_tang

    real(wp), parameter :: mu = 0.3_wp
    ! From nothing with new plans and influences, and with those of the time before; from the
    ! solution for 5 % more or less creepage.
    integer, parameter :: new_plans = 1, cold = 2, warm = 3
    character(len=*), parameter :: starts(3) = [character(len=13) :: &
        'new_plans', 'cold', 'warm_creepage']
    real(wp), parameter :: creepage_factor = 1.05_wp
    integer, parameter :: most_runs = 50

    !> The runs of one start.
    type :: runs_t
        integer :: n = 0                              !! without run 0
        real(wp) :: times(0:most_runs) = 0.0_wp       !! us
        real(wp) :: products(0:most_runs) = 0.0_wp    !! applications of the influence
        integer :: elements = 0                       !! in contact
    end type runs_t

contains

    !> All starts with one number of elements, and as many contacts as the time allows.
    subroutine measure_tang(cases, elements, budget_us, writer)
        type(bench_case_t), intent(in) :: cases(:)    !! the contacts
        integer, intent(in) :: elements               !! in contact, about
        real(wp), intent(in) :: budget_us             !! for all, us
        type(csv_writer_t), intent(inout) :: writer   !! an open file

        real(wp) :: us(size(cases), size(starts))
        character(len=16) :: names(size(cases))
        integer(int64) :: begin, now
        integer :: i, k, start, solved

        solved = 0
        call system_clock(begin)
        do k = 1, size(cases)
            i = scattered(k, size(cases))
            solved = solved + 1
            names(solved) = cases(i)%name
            call measure_case(cases(i), sqrt(cases(i)%known%area/elements), &
                              budget_us/(size(starts)*size(cases)), writer, us(solved, :))
            call system_clock(now)
            if (microseconds(begin, now) > budget_us) exit
        end do
        call note('tang, ' // integer_text(elements) // ' elements, ' // integer_text(solved) &
                  // ' contacts, processor ms, median/95th percentile/worst of them:' &
                  // times_text())

    contains

        function times_text() result(text)
            character(len=:), allocatable :: text

            text = ''
            do start = 1, size(starts)
                text = text // ' ' // trim(starts(start)) // ' ' &
                       // spread_text(1.0e-3_wp*us(:solved, start), names(:solved))
            end do
        end function times_text
    end subroutine measure_tang

    !> All starts of one contact.
    subroutine measure_case(case, dx, budget_us, writer, us)
        type(bench_case_t), intent(in) :: case
        real(wp), intent(in) :: dx, budget_us
        type(csv_writer_t), intent(inout) :: writer
        real(wp), intent(out) :: us(:) !! medians

        type(norm_workspace_t) :: norm
        type(normal_result_t) :: normal
        type(runs_t) :: runs
        type(status_t) :: status
        integer :: start

        call solve_by_norm(norm, case, norm_options_t(dx=dx, dy=dx), normal, status)
        call fail_on_error(status)
        do start = 1, size(starts)
            call run_again(case, norm%grid, start, budget_us, runs)
            us(start) = median(runs%times(1:runs%n))
            call put_runs(writer, case%name, norm%grid, start, runs)
        end do
    end subroutine measure_case

    !> As often as the time allows. The first run, number 0, makes plans and what the others start
    !> from.
    subroutine run_again(case, grid, start, budget_us, runs)
        type(bench_case_t), intent(in) :: case
        type(contact_grid_t), intent(in) :: grid !! with pressures
        integer, intent(in) :: start
        real(wp), intent(in) :: budget_us
        type(runs_t), intent(out) :: runs

        type(tang_workspace_t) :: kept
        integer(int64) :: begin, now
        integer :: run

        call system_clock(begin)
        do run = merge(1, 0, start == new_plans), most_runs
            if (start == new_plans) then
                call run_with_new_plans()
            else
                call run_once(case, grid, start, run, kept, runs)
            end if
            runs%n = run
            call system_clock(now)
            if (microseconds(begin, now) > budget_us .and. run >= 1) exit
        end do

    contains

        subroutine run_with_new_plans()
            type(tang_workspace_t) :: tang

            call run_once(case, grid, start, run, tang, runs)
        end subroutine run_with_new_plans
    end subroutine run_again

    subroutine run_once(case, grid, start, run, tang, runs)
        type(bench_case_t), intent(in) :: case
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: start, run
        type(tang_workspace_t), intent(inout) :: tang
        type(runs_t), intent(inout) :: runs

        type(tang_options_t) :: options
        type(tangential_result_t) :: result
        type(creepage_t) :: creepage
        type(status_t) :: status
        real(wp) :: from, factor

        options%edges = edges_of_norm
        options%warm_start = start == warm .and. run > 0
        factor = merge(creepage_factor, 1.0_wp, start == warm .and. modulo(run, 2) == 0)
        associate (c => case%creepage)
            creepage = creepage_t(factor*c%cksi, factor*c%ceta, factor*c%cphi)
        end associate
        from = cpu_microseconds()
        call tang_solve(tang, grid, case%material, mu, creepage, options, result, status)
        runs%times(run) = cpu_microseconds() - from
        call fail_on_error(status, case%name)
        runs%products(run) = tang%products
        runs%elements = tang%elements
    end subroutine run_once

    !> The row of one start.
    subroutine put_runs(writer, name, grid, start, runs)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: name !! of the contact
        type(contact_grid_t), intent(in) :: grid
        integer, intent(in) :: start
        type(runs_t), intent(in) :: runs

        type(tang_options_t) :: options
        real(wp) :: figures(size(spread_names))

        figures = spread_of(runs%times(1:runs%n))
        call put_cell(writer, 'tang')
        call put_cell(writer, trim(starts(start)))
        call put_cell(writer, options%tolerance)
        call put_cell(writer, runs%elements)
        call put_cells(writer, [figures(1), median(runs%products(1:runs%n)), &
                                median(runs%products(1:runs%n)), grid%dx])
        call put_cell(writer, grid%nx*grid%ny)
        call put_cells(writer, machine_words())
        call put_cell(writer, name)
        call put_cell(writer, runs%n)
        call put_cells(writer, figures)
        call end_row(writer)
    end subroutine put_runs
end module faststrip_lab_studies_reference_tang
