!> `faststrip-lab bench subsurface`: what stresses below the surface cost, and how far both ways to
!> them and the largest one are off.
module faststrip_lab_studies_subsurface
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_contact_clock, only: now, since
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_kalker_stresses, only: find_grid_stresses
    use faststrip_stress_loads, only: loads_t, reserve_loads, put_load, find_stress
    use faststrip_stress_peak, only: peak_t, find_peak
    use faststrip_stress_rectangle, only: n_stresses
    use faststrip_command_program_console, only: fail_on_error, begin_table, end_table
    implicit none
    private

    public :: bench_subsurface

    ! Given: Poisson's ratio, and the largest von Mises stress of a circle without friction over its
    ! largest pressure.
    real(wp), parameter :: nu = 0.3_wp, exact = 0.6200410_wp
    ! Elements across a circle of radius 1: the last has some 3000.
    integer, parameter :: across(3) = [15, 31, 62]
    ! Points along x, y and z.
    integer, parameter :: points(3) = [50, 50, 30]
    ! Given: microseconds of a millisecond.
    real(wp), parameter :: us_per_ms = 1.0e3_wp

contains

    !> Solve everything and write the CSV.
    subroutine bench_subsurface(file, rounds)
        character(len=*), intent(in) :: file !! to write, - for stdout
        integer, intent(in) :: rounds        !! the quickest of so many counts

        type(csv_writer_t) :: writer
        type(loads_t) :: loads
        type(peak_t) :: peak
        integer :: i, round
        integer(int64) :: before
        real(wp) :: us, difference

        call begin_table(writer, file)
        call put_comment(writer, 'a circle without friction in so many elements: 50 by 50 by 30 ' &
                         // 'points by transforms, difference: to the sum, over p0; the largest ' &
                         // 'von Mises stress, difference: to the exact one over it')
        call put_header(writer, [character(len=10) :: 'what', 'elements', 'points', 'ms', &
                                 'difference', 'est_err'])
        do i = 1, size(across)
            call make_circle(across(i), loads)
            call time_grid(loads, across(i), rounds, us, difference)
            call put_cell(writer, 'transforms')
            call put_cell(writer, loads%n)
            call put_cell(writer, product(points))
            call put_cells(writer, [us/us_per_ms, difference])
            call put_empty_cells(writer, 1)
            call end_row(writer)
            us = huge(us)
            do round = 1, rounds
                before = now()
                call find_peak(loads, nu, peak)
                us = min(us, since(before))
            end do
            call put_cell(writer, 'largest')
            call put_cell(writer, loads%n)
            call put_empty_cells(writer, 1)
            call put_cells(writer, [us/us_per_ms, abs(peak%von_mises/exact - 1.0_wp), peak%est_err])
            call end_row(writer)
        end do
        call end_table(writer)
    end subroutine bench_subsurface

    !> Hertz's pressures on a circle of radius 1, in their middles.
    subroutine make_circle(n, loads)
        integer, intent(in) :: n
        type(loads_t), intent(inout) :: loads

        type(status_t) :: status
        real(wp) :: side, square
        integer :: i, j

        call reserve_loads(loads, n*n, status)
        call fail_on_error(status)
        side = 2.0_wp/n
        do j = 1, n
            do i = 1, n
                square = 1.0_wp - place(i)**2 - place(j)**2
                if (square > 0.0_wp) call put_load(loads, place(i), place(j), side, side, &
                                                   [sqrt(square), 0.0_wp, 0.0_wp])
            end do
        end do

    contains

        pure real(wp) function place(k)
            integer, intent(in) :: k

            place = (k - 0.5_wp)*side - 1.0_wp
        end function place
    end subroutine make_circle

    !> Time of a grid of points by transforms, and its largest difference from the sum on one line.
    subroutine time_grid(loads, n, rounds, us, difference)
        type(loads_t), intent(in) :: loads
        integer, intent(in) :: n, rounds
        real(wp), intent(out) :: us, difference

        type(status_t) :: status
        real(wp), allocatable :: stresses(:, :, :, :)
        real(wp) :: x(points(1)), y(points(2)), z(points(3)), stress(n_stresses), side
        integer :: i, round
        integer(int64) :: before

        side = 2.0_wp/n
        x = [(side*(i + (n - size(x))/2 - 0.5_wp) - 1.0_wp, i=1, size(x))]
        y = [(side*(i + (n - size(y))/2 - 0.5_wp) - 1.0_wp, i=1, size(y))]
        z = [(2.0_wp*i/size(z), i=0, size(z) - 1)]
        allocate (stresses(n_stresses, size(x), size(y), size(z)))
        us = huge(us)
        do round = 1, rounds
            before = now()
            call find_grid_stresses(loads, nu, x, y, z, stresses, status)
            us = min(us, since(before))
            call fail_on_error(status)
        end do
        difference = 0.0_wp
        do i = 1, size(x)
            call find_stress(loads, nu, x(i), y(i), z(size(z)/4), stress)
            difference = max(difference, maxval(abs(stress - stresses(:, i, i, size(z)/4))))
        end do
    end subroutine time_grid
end module faststrip_lab_studies_subsurface
