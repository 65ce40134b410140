!> `faststrip-lab bench kalker`: Kalker's coefficients of the linear theory from TANG.
!>
!> Where nothing slides the tractions grow beyond all bounds at the trailing edge, and forces err by
!> the first order of the elements' size, with a scatter by where the edge lies in them. Each grid
!> is positioned several times, shifted along x by parts of an element, which takes most of the
!> scatter away; the line through the means of grids of several sizes gives the value for size zero.
module faststrip_lab_studies_kalker
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, number_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, end_row, &
                                   put_cells
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t, combined_shear_modulus
    use faststrip_kalker_grid, only: contact_grid_t, size_grid, element_x, element_y
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_kalker_tangential, only: tang_options_t, tang_workspace_t, tang_solve, &
                                           release_tang
    use faststrip_lab_grid_cases, only: read_rows
    use faststrip_command_program_clock, only: cpu_microseconds
    use faststrip_command_program_console, only: fail_on_error, note, progress, begin_table, &
                                                 end_table
    implicit none
    private

    public :: bench_kalker

    ! The table's, and some of them.
    real(wp), parameter :: ratios(19) = [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, &
        0.8_wp, 0.9_wp, 1.0_wp, 1.0_wp/0.9_wp, 1.25_wp, 1.0_wp/0.7_wp, 1.0_wp/0.6_wp, 2.0_wp, &
        2.5_wp, 1.0_wp/0.3_wp, 5.0_wp, 10.0_wp]
    real(wp), parameter :: quick_ratios(3) = [0.2_wp, 1.0_wp, 5.0_wp]
    real(wp), parameter :: nus(3) = [0.0_wp, 0.25_wp, 0.5_wp]
    ! Rows of the grids, and how often each is positioned.
    integer, parameter :: rows(9) = [24, 26, 28, 30, 32, 34, 36, 38, 40]
    integer, parameter :: shifts = 4
    ! C23 by the force of spin, C32 by the moment of lateral creepage; C32 is -C23.
    character(len=*), parameter :: names(5) = [character(len=3) :: 'C11', 'C22', 'C23', 'C32', &
                                               'C33']
    ! Creepages and modulus do not count: nothing slides, all is linear.
    real(wp), parameter :: modulus = 2.0e5_wp, small = 1.0e-3_wp
    real(wp), parameter :: tolerance = 1.0e-6_wp

    !> CONTACT's coefficients, extrapolated in its grids.
    type :: contact_tables_t
        character(len=:), allocatable :: name(:)
        real(wp), allocatable :: figures(:, :) ! aspect ratio, Poisson's ratio, value
    end type contact_tables_t

contains

    !> Compute, compare and write the CSV; say the largest deviations.
    subroutine bench_kalker(file, folder, quick)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with kalker_computed.csv
        logical, intent(in) :: quick           !! few aspect ratios

        type(csv_writer_t) :: writer
        type(contact_tables_t) :: contact
        type(tang_workspace_t) :: tang
        real(wp), allocatable :: chosen(:)
        real(wp) :: value(5), scatter(5), worst(5), from
        integer :: i, k, elements

        call read_rows(folder // '/kalker_computed.csv', [character(len=10) :: 'a_over_b', 'nu', &
                       'richardson'], contact%figures, 'coef', contact%name)
        chosen = ratios
        if (quick) chosen = quick_ratios
        call begin_table(writer, file)
        call put_comment(writer, 'coefficients by TANG without sliding, extrapolated to elements' &
                         // ' of size zero; C33 of the table has three digits, CONTACT as in ' &
                         // 'kalker_computed.csv; scatter: rms about the line')
        call put_header(writer, [character(len=15) :: 'coefficient', 'a_over_b', 'nu', 'value', &
                                 'scatter_pct', 'table', 'contact', 'to_table_pct', &
                                 'to_contact_pct', 'elements', 'cpu_s'])
        worst = 0.0_wp
        do i = 1, size(chosen)
            call progress('aspect ratios', i, size(chosen))
            do k = 1, size(nus)
                from = cpu_microseconds()
                call coefficients(chosen(i), nus(k), tang, value, scatter, elements)
                call put_coefficients(writer, contact, chosen(i), nus(k), value, scatter, &
                                      elements, 1.0e-6_wp*(cpu_microseconds() - from), worst)
            end do
        end do
        call release_tang(tang)
        call end_table(writer)
        do i = 1, size(names)
            call note(names(i) // ': at most ' // trim(number_text(worst(i))) &
                      // ' % from the table')
        end do
    end subroutine bench_kalker

    !> The coefficients of one ellipse, by the lines through those of all grids.
    subroutine coefficients(ratio, nu, tang, value, scatter, elements)
        real(wp), intent(in) :: ratio, nu
        type(tang_workspace_t), intent(inout) :: tang
        real(wp), intent(out) :: value(:)   !! in the order of `names`
        real(wp), intent(out) :: scatter(:) !! rms about the line, %
        integer, intent(out) :: elements    !! in contact, of the finest grid

        real(wp) :: found(size(value), size(rows)), h(size(rows)), slope
        integer :: n, shift, j

        found = 0.0_wp
        do n = 1, size(rows)
            do shift = 1, shifts
                call on_grid(ratio, nu, rows(n), (shift - 0.5_wp)/shifts - 0.5_wp, tang, &
                             found(:, n))
            end do
        end do
        elements = tang%elements
        found = found/shifts
        h = 1.0_wp/rows
        h = h - sum(h)/size(h)
        do j = 1, size(value)
            slope = sum(h*found(j, :))/sum(h**2)
            ! h is 1/rows less its mean.
            value(j) = sum(found(j, :))/size(h) - slope*(1.0_wp/rows(1) - h(1))
            scatter(j) = 100.0_wp*sqrt(sum((found(j, :) - value(j) - slope/rows)**2)/size(h)) &
                         /abs(value(j))
        end do
    end subroutine coefficients

    !> Add the coefficients of one grid.
    subroutine on_grid(ratio, nu, n_rows, shift, tang, found)
        real(wp), intent(in) :: ratio, nu
        integer, intent(in) :: n_rows
        real(wp), intent(in) :: shift !! along x, in elements
        type(tang_workspace_t), intent(inout) :: tang
        real(wp), intent(inout) :: found(:)

        type(contact_grid_t) :: grid
        type(material_t) :: material
        type(tang_options_t) :: options
        type(tangential_result_t) :: along, across, spin
        real(wp) :: a, b, below, unit
        integer :: columns, i, j

        ! The axes' product is 1; the longer ones have more elements, spin's slip varies along them.
        a = sqrt(ratio)
        b = 1.0_wp/a
        columns = nint(n_rows*max(1.0_wp, a))
        call size_grid(grid, columns + 1, n_rows)
        grid%dx = 2.0_wp*a/columns
        grid%dy = 2.0_wp*b/n_rows
        grid%x_first = -a + shift*grid%dx
        grid%y_first = -b + 0.5_wp*grid%dy
        do j = 1, grid%ny
            do i = 1, grid%nx
                grid%pressure(i, j) = sqrt(max(0.0_wp, 1.0_wp - (element_x(grid, i)/a)**2 &
                                               - (element_y(grid, j)/b)**2))
            end do
        end do
        below = min(nu, nearest(0.5_wp, -1.0_wp))
        material = material_t(modulus, modulus, below, below)
        options%sticks_everywhere = .true.
        options%tolerance = tolerance
        call roll(creepage_t(cksi=small), along)
        call roll(creepage_t(ceta=small), across)
        call roll(creepage_t(cphi=small), spin)
        unit = combined_shear_modulus(material)*small
        found = found - [along%fx, across%fy, spin%fy, across%mz, spin%mz]/unit

    contains

        subroutine roll(creepage, result)
            type(creepage_t), intent(in) :: creepage
            type(tangential_result_t), intent(out) :: result

            type(status_t) :: status

            call tang_solve(tang, grid, material, 1.0_wp, creepage, options, result, status)
            call fail_on_error(status)
        end subroutine roll
    end subroutine on_grid

    !> The rows of one ellipse.
    subroutine put_coefficients(writer, contact, ratio, nu, value, scatter, elements, seconds, &
                                worst)
        type(csv_writer_t), intent(inout) :: writer
        type(contact_tables_t), intent(in) :: contact
        real(wp), intent(in) :: ratio, nu, value(:), scatter(:), seconds
        integer, intent(in) :: elements
        real(wp), intent(inout) :: worst(:) !! deviations from the table, %

        type(kalker_coefficients_t) :: kalker
        type(status_t) :: status
        real(wp) :: table(size(names)), other
        integer :: j

        call kalker_coefficients(ratio, nu, kalker, status)
        call fail_on_error(status)
        table = [kalker%c11, kalker%c22, kalker%c23, -kalker%c23, kalker%c33]
        do j = 1, size(names)
            call put_cell(writer, names(j))
            call put_cells(writer, [ratio, nu, value(j), scatter(j), table(j)])
            other = by_contact(contact, names(j), ratio, nu)
            call put_cell(writer, other, is_known=other /= 0.0_wp)
            call put_cell(writer, 100.0_wp*(value(j)/table(j) - 1.0_wp))
            call put_cell(writer, 100.0_wp*(value(j)/other - 1.0_wp), is_known=other /= 0.0_wp)
            call put_cell(writer, elements)
            call put_cell(writer, seconds)
            call end_row(writer)
        end do
        worst = max(worst, abs(100.0_wp*(value/table - 1.0_wp)))
    end subroutine put_coefficients

    !> CONTACT's value; zero if it was not computed.
    pure real(wp) function by_contact(contact, name, ratio, nu) result(value)
        type(contact_tables_t), intent(in) :: contact
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: ratio, nu

        integer :: i

        value = 0.0_wp
        do i = 1, size(contact%name)
            if (abs(contact%figures(i, 1)/ratio - 1.0_wp) > 1.0e-6_wp) cycle
            if (abs(contact%figures(i, 2) - nu) > 1.0e-6_wp) cycle
            if (contact%name(i) == name) value = contact%figures(i, 3)
        end do
    end function by_contact
end module faststrip_lab_studies_kalker
