!> `faststrip-lab bench tangential`: what the tangential methods cost, side by side in one run.
!>
!> All are times of the processor: of many rounds the median (`us` is an older name of it), the 95th
!> percentile and the worst; `us_with_field` and `us_with_heat`, with temperatures, are medians.
module faststrip_lab_grid_tangential
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_command_program_clock, only: cpu_microseconds, median, spread_of, spread_text, &
                                               spread_names, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    use faststrip_command_program_machine, only: machine_words
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: method_name_length
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_reserve, only: reserve_contact_field
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_lab_force_laws, only: tangential_methods => force_laws
    use faststrip_lab_pressures, only: solve_pressures
    implicit none
    private

    public :: bench_tangential

    ! Strips across the largest patch and points along each.
    integer, parameter :: sizes(4) = [5, 15, 31, 61]
    ! What the others are measured by, at the same number of elements.
    character(len=*), parameter :: measure = 'fastsim'
    real(wp), parameter :: mu = 0.3_wp, speed = 3.0e4_wp

    !> Times of all methods on one contact, us.
    type :: times_t
        ! Forces only: median, 95th percentile, worst.
        real(wp) :: forces(size(spread_names), size(tangential_methods)) = 0.0_wp
        real(wp) :: field(size(tangential_methods)) = 0.0_wp  ! with the elements
        real(wp) :: heat(size(tangential_methods)) = 0.0_wp   ! and with temperatures
        integer :: elements = 0
    end type times_t

contains

    !> Measure and write the CSV.
    subroutine bench_tangential(file, folder, rounds)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: rounds          !! how often everything is timed, >= 1

        type(bench_case_t), allocatable :: cases(:)
        type(times_t), allocatable :: times(:)
        type(csv_writer_t) :: writer
        integer :: i, k

        call read_bench_cases(folder, cases)
        allocate (times(size(cases)))
        call begin_table(writer, file)
        call put_header(writer, [character(len=16) :: 'method', 'strips', 'points', 'case', &
                                 'elements', 'us', 'ns_per_element', 'ratio', 'us_with_field', &
                                 'flags', 'compiler', 'cpu', cpu_columns, 'us_with_heat'])
        do k = 1, size(sizes)
            do i = 1, size(cases)
                call measure_case(cases(i), sizes(k), rounds, times(i))
                call put_times(writer, cases(i)%name, sizes(k), times(i))
            end do
            call tell(sizes(k), cases, times)
        end do
        call end_table(writer)
    end subroutine bench_tangential

    !> Solve a contact once and time all methods on it, turn about, so that what else happens on
    !> the machine falls on all of them.
    subroutine measure_case(case, n, rounds, times)
        type(bench_case_t), intent(in) :: case
        integer, intent(in) :: n, rounds
        type(times_t), intent(out) :: times

        real(wp), parameter :: shortest_us = 50.0_wp
        type(contact_case_t) :: contact
        type(workspace_t) :: workspace
        type(contact_result_t) :: result
        type(status_t) :: status
        real(wp), dimension(rounds, size(tangential_methods)) :: forces, with_field, with_heat
        integer, dimension(size(tangential_methods)) :: repetitions
        integer :: m, round

        contact = case%contact_case_t
        contact%mu = mu
        contact%estimate = .false.
        contact%methods%strips_per_patch = n
        contact%methods%points_per_strip = n
        contact%friction%speed = speed
        call solve_pressures(workspace, contact, result, status)
        call fail_on_error(status)
        ! The same number of elements for FASTSIM on one patch.
        contact%methods%fastsim_nx = n
        contact%methods%fastsim_ny = workspace%strips%n
        times%elements = n*workspace%strips%n
        call reserve_contact_field(workspace, contact%methods, status)
        call fail_on_error(status)
        repetitions = 1
        do m = 1, size(tangential_methods)
            do
                if (time_of(m, .false., .false.)*repetitions(m) > shortest_us) exit
                repetitions(m) = 2*repetitions(m)
            end do
        end do
        with_field = 0.0_wp
        with_heat = 0.0_wp
        do round = 1, rounds
            do m = 1, size(tangential_methods)
                forces(round, m) = time_of(m, .false., .false.)
                if (.not. tangential_methods(m)%gives_elements) cycle
                with_field(round, m) = time_of(m, .true., .false.)
                with_heat(round, m) = time_of(m, .true., .true.)
            end do
        end do
        do m = 1, size(tangential_methods)
            times%forces(:, m) = spread_of(forces(:, m))
            times%field(m) = median(with_field(:, m))
            times%heat(m) = median(with_heat(:, m))
        end do

    contains

        real(wp) function time_of(method, wants_field, wants_heat) result(us)
            integer, intent(in) :: method
            logical, intent(in) :: wants_field, wants_heat

            real(wp) :: from
            integer :: i

            contact%methods%tangential = tangential_methods(method)%number
            from = cpu_microseconds()
            contact%asked%field = wants_field
            contact%asked%temperatures = wants_heat
            do i = 1, repetitions(method)
                call solve_contact_forces(workspace, contact, result, status)
            end do
            us = (cpu_microseconds() - from)/repetitions(method)
            call fail_on_error(status)
        end function time_of
    end subroutine measure_case

    subroutine put_times(writer, name, n, times)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: name
        integer, intent(in) :: n
        type(times_t), intent(in) :: times

        integer :: m, elements

        do m = 1, size(tangential_methods)
            elements = merge(times%elements, 1, tangential_methods(m)%gives_elements)
            call put_cell(writer, trim(tangential_methods(m)%name))
            call put_cells(writer, [n, n])
            call put_cell(writer, name)
            call put_cell(writer, elements)
            call put_cells(writer, times%forces(1, m)/[1.0_wp, 1.0e-3_wp*elements, &
                                                       times%forces(1, measured())])
            call put_cell(writer, times%field(m), is_known=tangential_methods(m)%gives_elements)
            call put_cells(writer, machine_words())
            call put_cells(writer, times%forces(:, m))
            call put_cell(writer, times%heat(m), is_known=tangential_methods(m)%gives_elements)
            call end_row(writer)
        end do
    end subroutine put_times

    !> Say median, 95th percentile and worst over the contacts, of the rest the medians.
    subroutine tell(n, cases, times)
        integer, intent(in) :: n
        type(bench_case_t), intent(in) :: cases(:)
        type(times_t), intent(in) :: times(:)

        real(wp), dimension(size(times)) :: us, ns, ratio, field
        character(len=16) :: names(size(times))
        character(len=method_name_length) :: name
        integer :: m, i

        call note(integer_text(n) // ' strips of ' // integer_text(n) // ' points; processor us, ' &
                  // 'median/95th percentile/worst, ns per element, ratio to ' // measure &
                  // ', us with the field:')
        do m = 1, size(tangential_methods)
            do i = 1, size(times)
                names(i) = cases(i)%name
                us(i) = times(i)%forces(1, m)
                ns(i) = 1.0e3_wp*us(i)/times(i)%elements
                ratio(i) = us(i)/times(i)%forces(1, measured())
                field(i) = times(i)%field(m)
            end do
            name = tangential_methods(m)%name
            if (.not. tangential_methods(m)%gives_elements) then
                call note('  ' // name // spread_text(us, names))
            else
                call note('  ' // name // spread_text(us, names) // '  ' &
                          // trim(number_text(median(ns))) // '  ' &
                          // trim(number_text(median(ratio))) // '  ' &
                          // trim(number_text(median(field))))
            end if
        end do
    end subroutine tell

    !> Number of the method the others are measured by.
    pure integer function measured()
        measured = findloc(tangential_methods%name == measure, .true., 1)
    end function measured
end module faststrip_lab_grid_tangential
