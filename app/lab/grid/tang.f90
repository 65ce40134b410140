!> `faststrip-lab bench tang`: what TANG costs, and how its iterations grow with the grid.
!>
!> Each contact is solved with its own creepages, without spin and with much of it, all with
!> adhesion and slip areas. Pressures are NORM's on the same grid, which is not counted. Iterations
!> are those of GMRES in all Newton's steps together. Times are of the processor, cold, with
!> plans and influence coefficients there, the median of all rounds.
module faststrip_lab_grid_tang
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: combined_shear_modulus
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_kalker_normal, only: norm_options_t, norm_workspace_t, release_norm
    use faststrip_lab_pressures, only: solve_by_norm
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang, edges_of_norm
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_command_program_clock, only: cpu_microseconds, spread_of, spread_text, &
                                               spread_names, cpu_columns
    use faststrip_command_program_console, only: fail_on_error, note, progress, begin_table, &
                                                 end_table
    use faststrip_command_program_machine, only: machine_words
    implicit none
    private

    public :: bench_tang, bench_tang_most_elements

    !> The largest number of elements in contact unless another one is asked for.
    integer, parameter :: bench_tang_most_elements = 60000

    ! Elements in contact, about.
    integer, parameter :: sizes(3) = [3700, 15000, bench_tang_most_elements]
    real(wp), parameter :: mu = 0.3_wp
    ! The contact's; along and across; those with spin.
    character(len=*), parameter :: creepages(3) = [character(len=7) :: 'own', 'no_spin', 'spin']
    ! Creepages for linear forces below the traction bound, with coefficients of about 4.5 (1.5 for
    ! spin).
    real(wp), parameter :: along = 0.6_wp/4.5_wp, across = 0.5_wp/4.5_wp, turn = 0.5_wp/1.5_wp
    ! Every so many-th contact with --quick.
    integer, parameter :: quick_step = 5

    !> What was measured of one contact and its creepages.
    type :: run_t
        integer :: elements = 0   ! in contact
        integer :: grid = 0       ! in contact or not
        integer :: steps = 0      ! of Newton's method
        integer :: iterations = 0 ! of GMRES
        integer :: products = 0   ! applications of the influence
        real(wp) :: us(size(spread_names)) = 0.0_wp
        type(tangential_result_t) :: result
    end type run_t

contains

    !> Measure and write the CSV.
    subroutine bench_tang(file, folder, most_elements, rounds, quick)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_elements   !! no larger number of elements in contact
        integer, intent(in) :: rounds          !! how often everything is timed, >= 1
        logical, intent(in) :: quick           !! few contacts

        type(bench_case_t), allocatable :: cases(:)
        type(csv_writer_t) :: writer
        type(run_t), allocatable :: runs(:, :)
        integer :: k, i

        call read_bench_cases(folder, cases)
        if (quick) cases = cases(1::quick_step)
        allocate (runs(size(creepages), size(cases)))
        call begin_table(writer, file)
        call put_header(writer, [character(len=14) :: 'case', 'creepages', 'elements', 'grid', &
                                 'steps', 'iterations', 'products', cpu_columns, 'rounds', &
                                 'stick_fraction', 'Fx_N', 'Fy_N', 'Mz_Nmm', 'flags', 'compiler', &
                                 'cpu'])
        do k = 1, size(sizes)
            if (sizes(k) > most_elements) exit
            do i = 1, size(cases)
                call progress('contacts', i, size(cases))
                call measure_case(cases(i), sizes(k), rounds, runs(:, i))
                call put_runs(writer, cases(i)%name, rounds, runs(:, i))
            end do
            call tell(sizes(k), cases, runs)
        end do
        call end_table(writer)
    end subroutine bench_tang

    !> All creepages of one contact.
    subroutine measure_case(case, elements, rounds, runs)
        type(bench_case_t), intent(in) :: case
        integer, intent(in) :: elements, rounds
        type(run_t), intent(out) :: runs(:)

        type(norm_workspace_t) :: norm
        type(normal_result_t) :: normal
        type(tang_workspace_t) :: tang
        type(tang_options_t) :: options
        type(status_t) :: status
        real(wp) :: dx, from, us(0:rounds)
        integer :: k, round

        dx = sqrt(case%known%area/elements)
        call solve_by_norm(norm, case, norm_options_t(dx=dx, dy=dx), normal, status)
        call fail_on_error(status)
        options%edges = edges_of_norm
        do k = 1, size(creepages)
            ! Round 0 makes plans and influence coefficients.
            do round = merge(0, 1, k == 1), rounds
                from = cpu_microseconds()
                call tang_solve(tang, norm%grid, case%material, mu, creepage_of(case, k), options, &
                                runs(k)%result, status)
                us(round) = cpu_microseconds() - from
                call fail_on_error(status, case%name)
            end do
            runs(k)%elements = tang%elements
            runs(k)%grid = norm%grid%nx*norm%grid%ny
            runs(k)%steps = tang%steps
            runs(k)%iterations = tang%iterations
            runs(k)%products = tang%products
            runs(k)%us = spread_of(us(1:))
        end do
        call release_tang(tang)
        call release_norm(norm)
    end subroutine measure_case

    !> Creepages of kind k.
    type(creepage_t) function creepage_of(case, k) result(creepage)
        type(bench_case_t), intent(in) :: case
        integer, intent(in) :: k

        real(wp) :: unit, c

        creepage = case%creepage
        if (k == 1) return
        ! Where the linear theory's force, G c^2 times creepage, is the bound; c^2 = area/pi.
        c = sqrt(case%known%area/pi)
        unit = mu*case%load/(combined_shear_modulus(case%material)*c**2)
        creepage = creepage_t(along*unit, across*unit, 0.0_wp)
        if (k == 3) creepage%cphi = turn*unit/c
    end function creepage_of

    subroutine put_runs(writer, name, rounds, runs)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: name
        integer, intent(in) :: rounds
        type(run_t), intent(in) :: runs(:)

        integer :: k

        do k = 1, size(runs)
            call put_cell(writer, name)
            call put_cell(writer, trim(creepages(k)))
            call put_cells(writer, [runs(k)%elements, runs(k)%grid, runs(k)%steps, &
                                    runs(k)%iterations, runs(k)%products])
            call put_cells(writer, runs(k)%us)
            call put_cell(writer, rounds)
            call put_cells(writer, [runs(k)%result%stick_fraction, runs(k)%result%fx, &
                                    runs(k)%result%fy, runs(k)%result%mz])
            call put_cells(writer, machine_words())
            call end_row(writer)
        end do
    end subroutine put_runs

    !> Say median, 95th percentile and worst over the contacts.
    subroutine tell(elements, cases, runs)
        integer, intent(in) :: elements
        type(bench_case_t), intent(in) :: cases(:)
        type(run_t), intent(in) :: runs(:, :)

        character(len=16) :: names(size(cases))
        integer :: i, k

        do i = 1, size(cases)
            names(i) = cases(i)%name
        end do
        do k = 1, size(runs, 1)
            call note('tang, ' // integer_text(elements) // ' elements, creepages ' &
                      // trim(creepages(k)) // ', median/95th percentile/worst of ' &
                      // integer_text(size(runs, 2)) // ' contacts: Newton steps ' &
                      // spread_text(real(runs(k, :)%steps, wp)) // ', iterations ' &
                      // spread_text(real(runs(k, :)%iterations, wp)) // ', processor ms ' &
                      // spread_text(1.0e-3_wp*runs(k, :)%us(1), names))
        end do
    end subroutine tell
end module faststrip_lab_grid_tang
