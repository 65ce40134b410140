!> `faststrip-lab errata`: what the paper prints and what is right, side by side.
module faststrip_lab_studies_errata
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_header, put_cell, put_cells, end_row
    use faststrip_base_material, only: material_t, normal_compliance, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_offcentre, only: strip_influence_at
    use faststrip_influence_polynomial, only: table_influence
    use faststrip_tables_quadrature, only: quadrature_influence_2d
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve, hertz_strips
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips, strip_load, strips_load, &
                                       usual_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_fastsim, only: fastsim_solve
    use faststrip_tables_literal, only: literal_table_influence, literal_area_integral, &
                                        literal_offcentre_influence, center_pressures
    use faststrip_tangential_paper, only: march_reading_t, march_sum_t, printed_march
    use faststrip_tables_printed_integral, only: printed_influence, rule_qags, rule_cquad
    use faststrip_lab_grid_paper_gaps, only: paper_profiles_t, make_paper_profiles, gap_of_shift
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_command_program_console, only: fail_on_error, say, begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text
    implicit none
    private

    public :: run_errata

    real(wp), parameter :: mu = 0.3_wp
    real(wp), parameter :: load = 1.0e5_wp

    !> One figure, read both ways.
    type :: finding_t
        character(len=20) :: equation = ''  ! of the paper
        character(len=100) :: what = ''     ! the figure
        character(len=12) :: unit = ''
        real(wp) :: literal = 0.0_wp
        real(wp) :: right = 0.0_wp
        character(len=100) :: note = ''
    end type finding_t

    !> The findings so far.
    type :: findings_t
        type(finding_t), allocatable :: list(:)
    end type findings_t

    !> A Hertz contact and its strips.
    type :: ellipse_t
        type(hertz_t) :: hertz
        type(contact_strips_t) :: strips
    end type ellipse_t

    !> What makes the march Kalker's FASTSIM, and creepages of every kind.
    type(march_reading_t), parameter :: kalker = &
        march_reading_t(.false., .false., .false., .true., .true., 40)
    type(creepage_t), parameter :: some_creepage = creepage_t(1.5e-3_wp, -1.0e-3_wp, 1.0e-4_wp)

contains

    !> Run the subcommand from the command line: compute all demonstrations, write them as CSV and,
    !> unless that goes to stdout, as lines to read on stdout.
    subroutine run_errata()
        type(command_t) :: command
        type(findings_t) :: found
        character(len=:), allocatable :: path

        command%name = 'errata'
        command%usage = ''
        command%about = &
            'What each erratum of the paper costs, literal and right reading: as CSV, and with -o' &
            // new_line('a') // 'as lines to read on stdout.' // new_line('a')
        command%options = [option_t('-o', 'FILE', 'write the CSV there (default stdout)', &
                                    writes=.true.)]
        call parse_command(command, 0)
        path = option_text(command, '-o', '-')
        allocate (found%list(0))
        call compare_matrix(found)
        call compare_jacobian(found)
        call compare_quadrature(found)
        call compare_table(found)
        call compare_offcentre(found)
        call compare_march(found)
        call compare_saturation(found)
        call write_findings(path, found%list)
        if (path /= '-') call print_findings(found%list)
    end subroutine run_errata

    subroutine add(found, equation, what, unit, literal, right, note)
        type(findings_t), intent(inout) :: found
        character(len=*), intent(in) :: equation, what, unit
        real(wp), intent(in) :: literal, right
        character(len=*), intent(in) :: note

        found%list = [found%list, finding_t(equation, what, unit, literal, right, note)]
    end subroutine add

    !> (6), (9), (17), (18), (20): source and field exchanged make the matrix its transpose.
    subroutine compare_matrix(found)
        type(findings_t), intent(inout) :: found

        type(contact_strips_t) :: strips
        type(status_t) :: status
        type(material_t) :: material
        real(wp), allocatable :: p0(:), w(:)
        real(wp) :: shift, right, literal, ends(2)
        character(len=30) :: place
        integer :: i, k, n

        do i = 1, 3
            shift = real(5*(i - 2), wp)
            call solve_contact(shift, strips)
            n = strips%n
            allocate (p0(n), w(n))
            ! The displacements of the right matrix, then the pressures of the printed one for them.
            call displacements(strips, normal_compliance(material), w)
            call center_pressures(strips, normal_compliance(material), w, .true., p0, status)
            call fail_on_error(status)
            write (place, '(a, f4.1, a)') ', S1002/UIC60 at ', shift, ' mm'
            right = strips_load(strips)
            literal = sum(strip_load(p0, strips%half_length(:n), &
                                     strips%y_right(:n) - strips%y_left(:n)))
            call add(found, '(6) (9) (17)-(20)', 'load' // place, 'N', literal, right, &
                     'the integral runs over strip k: the matrix is the transpose')
            k = merge(1, n, abs(p0(1)/strips%p0(1)) > abs(p0(n)/strips%p0(n)))
            ends = [p0(k), strips%p0(k)]
            call add(found, '(6) (9) (17)-(20)', 'pressure of an end strip' // place, 'MPa', &
                     ends(1), ends(2), 'the shorter the strip beside its neighbour, the worse')
            deallocate (p0, w)
        end do
    end subroutine compare_matrix

    !> Displacements of the centre lines under the strips' pressures.
    subroutine displacements(strips, compliance, w)
        type(contact_strips_t), intent(in) :: strips
        real(wp), intent(in) :: compliance
        real(wp), intent(out) :: w(:)

        real(wp) :: y, xd
        integer :: k, s

        do k = 1, strips%n
            y = 0.5_wp*(strips%y_left(k) + strips%y_right(k))
            w(k) = 0.0_wp
            do s = 1, strips%n
                xd = strips%half_length(s)
                w(k) = w(k) + compliance*strips%p0(s)*xd &
                       *strip_influence_at(0.0_wp, (strips%y_left(s) - y)/xd, &
                                           (strips%y_right(s) - y)/xd)
            end do
        end do
    end subroutine displacements

    subroutine compare_jacobian(found)
        type(findings_t), intent(inout) :: found

        real(wp), parameter :: b(3) = [0.01_wp, 0.1_wp, 5.0_wp]
        character(len=30) :: what
        integer :: i

        do i = 1, size(b)
            write (what, '(a, f4.2)') 'i for n = 1, b = ', b(i)
            call add(found, '(12)', what, '-', literal_area_integral(1, b(i)), &
                     strip_influence(1, b(i)), 'the Jacobian b of the substitution is missing')
        end do
    end subroutine compare_jacobian

    !> (9) in floating point, and the sentence that it has no analytical solution.
    subroutine compare_quadrature(found)
        type(findings_t), intent(inout) :: found

        integer, parameter :: n(4) = [1, 1000, 10000, 1]
        real(wp), parameter :: b(4) = [1.0e-8_wp, 1.0_wp, 1.0_wp, 1.0e8_wp]
        type(status_t) :: status
        real(wp) :: value, abs_error
        character(len=60) :: what
        integer :: i, rule, code

        do i = 1, size(n)
            do rule = rule_qags, rule_cquad
                call printed_influence(rule, n(i), b(i), 1.0e-10_wp, value, abs_error, code)
                write (what, '(a, a, i0, a, es7.1)') trim(merge('QAGS ', 'CQUAD', &
                    rule == rule_qags)), ': i for n = ', n(i), ', b = ', b(i)
                call add(found, '(9)', what, '-', value, strip_influence(n(i), b(i)), &
                         'the kernel as printed cancels; GSL ends with status ' &
                         // integer_text(code))
            end do
        end do
        call quadrature_influence_2d(3, 0.2_wp, 0.0_wp, value, abs_error, status)
        call fail_on_error(status)
        call add(found, '(9) (18)', 'i for n = 3, b = 0.2: double integral, closed form', '-', &
                 value, strip_influence(3, 0.2_wp), &
                 'it has an analytical solution, though not by elementary functions')
    end subroutine compare_quadrature

    subroutine compare_table(found)
        type(findings_t), intent(inout) :: found

        integer, parameter :: column(4) = [0, 2, 4, 20]
        type(status_t) :: status
        real(wp) :: literal, right
        character(len=40) :: what
        integer :: i

        do i = 1, size(column)
            call literal_table_influence(column(i), 0.1_wp, literal, status)
            call fail_on_error(status)
            write (what, '(a, i0, a)') 'i for |s - k| = ', column(i), ', b = 0.1'
            call add(found, 'Table 1', what, '-', literal, &
                     strip_influence(column(i), 0.1_wp), &
                     '10**E is i/2 and the column is twice the distance')
            call table_influence(column(i)/2, 0.1_wp, right, status)
            call fail_on_error(status)
            write (what, '(a, i0, a)') 'i for n = ', column(i)/2, ', b = 0.1'
            call add(found, 'Table 1', what, '-', right, strip_influence(column(i)/2, 0.1_wp), &
                     '2*10**E of column 2n: what is left is the error of the fit')
        end do
    end subroutine compare_table

    subroutine compare_offcentre(found)
        type(findings_t), intent(inout) :: found

        integer, parameter :: n(5) = [0, 0, 0, 1, 3]
        real(wp), parameter :: b(5) = [0.01_wp, 0.1_wp, 1.0_wp, 0.1_wp, 0.1_wp]
        real(wp), parameter :: u(5) = [0.95_wp, 1.0_wp, 0.9_wp, 1.0_wp, 1.0_wp]
        character(len=40) :: what
        integer :: i

        do i = 1, size(n)
            write (what, '(a, i0, a, f4.2, a, f4.2)') 'i for n = ', n(i), ', b = ', b(i), &
                ', u = ', u(i)
            call add(found, '(22)-(24)', what, '-', literal_offcentre_influence(n(i), b(i), u(i)), &
                     strip_influence_at(u(i), (2*n(i) - 1)*b(i), (2*n(i) + 1)*b(i)), &
                     'a quotient of integrals with 1 - u^2 for its square root')
        end do
    end subroutine compare_offcentre

    !> (30)-(45) on a Hertz ellipse, where Kalker's FASTSIM and linear theory are the measure.
    subroutine compare_march(found)
        type(findings_t), intent(inout) :: found

        type(ellipse_t) :: ellipse
        type(status_t) :: status

        call hertz_solve(normal_compliance(material_t()), 1.0e-3_wp, 1.0e-3_wp, load, &
                         ellipse%hertz, status)
        call fail_on_error(status)
        call reserve_strips(ellipse%strips, 40, status)
        call fail_on_error(status)
        call hertz_strips(ellipse%hertz, 40, ellipse%strips, status)
        call fail_on_error(status)
        call compare_forces(found, ellipse)
        call compare_stiffness(found, ellipse)
        call compare_moment(found, ellipse)
        call compare_points(found, ellipse)
        call compare_reference_point(found, ellipse)
    end subroutine compare_march

    !> The paper's march.
    subroutine march(strips, creepage, reading, total)
        type(contact_strips_t), intent(in) :: strips
        type(creepage_t), intent(in) :: creepage
        type(march_reading_t), intent(in) :: reading
        type(march_sum_t), intent(out) :: total

        type(status_t) :: status

        call printed_march(strips, material_t(), mu, creepage, reading, total, status)
        call fail_on_error(status)
    end subroutine march

    subroutine compare_forces(found, ellipse)
        type(findings_t), intent(inout) :: found
        type(ellipse_t), intent(in) :: ellipse

        type(tangential_result_t) :: fastsim
        type(march_sum_t) :: total
        type(status_t) :: status

        call march(ellipse%strips, some_creepage, kalker, total)
        call fastsim_solve(ellipse%hertz, material_t(), mu, some_creepage, 40, 40, fastsim, status)
        call fail_on_error(status)
        call add(found, '(30) (42) (46)', 'Tx by (25)-(48) corrected, by FASTSIM', 'N', total%tx, &
                 fastsim%fx, 'parabolic bound and one T0 make it Kalker''s FASTSIM')
        call add(found, '(30) (42) (46)', 'Ty by (25)-(48) corrected, by FASTSIM', 'N', total%ty, &
                 fastsim%fy, 'the same')
        call add(found, '(30) (42) (46)', 'Mz by (25)-(48) corrected, by FASTSIM', 'N mm', &
                 total%mz, fastsim%mz, 'the same')
    end subroutine compare_forces

    subroutine compare_stiffness(found, ellipse)
        type(findings_t), intent(inout) :: found
        type(ellipse_t), intent(in) :: ellipse

        type(kalker_coefficients_t) :: c
        type(status_t) :: status
        real(wp) :: linear

        associate (a => ellipse%hertz%a, b => ellipse%hertz%b)
            call kalker_coefficients(a/b, combined_poisson_ratio(material_t()), c, status)
            call fail_on_error(status)
            linear = c%c11*combined_shear_modulus(material_t())*a*b
        end associate
        call stiffness('(34)', 'C11 with T0 = mu p0 of each strip', &
                       march_reading_t(.true., .false., .false., .true., .true., 200), &
                       '3 pi/8 = 1.178 too stiff')
        call stiffness('(41)', 'C11 adding s (ae - xe), nx = 48', &
                       march_reading_t(.false., .true., .false., .true., .true., 48), &
                       'the distance from the edge is added at every point: nx/3 too stiff')
        call stiffness('(25)-(48)', 'C11 corrected', kalker, 'the last step, Ex/2 at first')

    contains

        subroutine stiffness(equation, what, reading, note)
            character(len=*), intent(in) :: equation, what, note
            type(march_reading_t), intent(in) :: reading

            type(creepage_t), parameter :: creepage = creepage_t(1.0e-9_wp, 0.0_wp, 0.0_wp)
            type(march_sum_t) :: total

            call march(ellipse%strips, creepage, reading, total)
            call add(found, equation, what, '-', -c%c11*total%tx/(linear*creepage%cksi), c%c11, &
                     note)
        end subroutine stiffness
    end subroutine compare_stiffness

    subroutine compare_moment(found, ellipse)
        type(findings_t), intent(inout) :: found
        type(ellipse_t), intent(in) :: ellipse

        type(march_sum_t) :: total, other

        call march(ellipse%strips, some_creepage, kalker, total)
        call march(ellipse%strips, some_creepage, &
                   march_reading_t(.false., .false., .true., .true., .true., 40), other)
        call add(found, '(44)', 'Mz', 'N mm', other%mz, total%mz, &
                 'coordinates of the ellipse, not mm; the sign is that of int(y px - x py)')
    end subroutine compare_moment

    subroutine compare_points(found, ellipse)
        type(findings_t), intent(inout) :: found
        type(ellipse_t), intent(in) :: ellipse

        integer, parameter :: points(3) = [10, 20, 0]
        type(march_reading_t) :: reading
        type(march_sum_t) :: total
        real(wp) :: force
        character(len=60) :: what
        integer :: i

        reading = kalker
        reading%points = 1000
        call march(ellipse%strips, some_creepage, reading, total)
        force = hypot(total%tx, total%ty)
        do i = 1, size(points)
            reading%points = points(i)
            call march(ellipse%strips, some_creepage, reading, total)
            write (what, '(a, i0, a)') 'force with ', total%points, &
                ' points along a strip, with 1000'
            call add(found, '(31)', what, 'N', hypot(total%tx, total%ty), force, &
                     'nx = Int(8a) with a in mm; 10 to 20 suffice')
        end do
    end subroutine compare_points

    !> The ellipse five millimetres beside the reference point, spinning about that.
    subroutine compare_reference_point(found, ellipse)
        type(findings_t), intent(inout) :: found
        type(ellipse_t), intent(in) :: ellipse

        type(creepage_t), parameter :: creepage = creepage_t(0.0_wp, 0.0_wp, 1.0e-9_wp)
        type(ellipse_t) :: beside
        type(march_reading_t) :: reading
        type(march_sum_t) :: total, other

        beside = ellipse
        beside%strips%y_left = beside%strips%y_left + 5.0_wp
        beside%strips%y_right = beside%strips%y_right + 5.0_wp
        call march(beside%strips, creepage, kalker, total)
        reading = kalker
        reading%from_reference = .false.
        call march(beside%strips, creepage, reading, other)
        call add(found, '(32)', 'Tx/cphi, patch 5 mm off the reference point', 'N mm', &
                 other%tx/creepage%cphi, total%tx/creepage%cphi, &
                 'right as printed, y/b: y - y0 of (28) would lose the creepage -y0 phi')
    end subroutine compare_reference_point

    !> (46)-(48): what is scaled is no force, and pi/2 is the sum of the bounds on an ellipse only.
    subroutine compare_saturation(found)
        type(findings_t), intent(inout) :: found

        type(contact_strips_t) :: strips
        type(march_sum_t) :: total
        real(wp) :: shift
        character(len=60) :: what
        integer :: i

        do i = 1, 3
            shift = real(5*(i - 2), wp)
            call solve_contact(shift, strips)
            if (strips%n_patches /= 1) cycle
            call march(strips, creepage_t(1.0_wp, 0.0_wp, 0.0_wp), &
                       march_reading_t(.false., .false., .false., .true., .true., 200), total)
            write (what, '(a, f4.1, a)') 'force sliding, S1002/UIC60 at ', shift, ' mm'
            call add(found, '(46)-(48)', what, 'N', -total%tx, mu*strips_load(strips), &
                     'pi/2 is the sum of the bounds of an ellipse; it is not mu N elsewhere')
        end do
    end subroutine compare_saturation

    !> The strips of the paper's contact: 15 of them for each patch.
    subroutine solve_contact(shift, strips)
        real(wp), intent(in) :: shift
        type(contact_strips_t), intent(inout) :: strips

        type(paper_profiles_t) :: profiles
        type(contact_case_t) :: contact
        type(workspace_t) :: workspace
        type(normal_result_t) :: result
        type(status_t) :: status

        call make_paper_profiles(profiles)
        call gap_of_shift(profiles, shift, contact%gap)
        contact%load = load
        call solve_by_strips(workspace, contact, usual_strips, result, status)
        call fail_on_error(status)
        strips = workspace%strips
    end subroutine solve_contact

    subroutine write_findings(path, list)
        character(len=*), intent(in) :: path
        type(finding_t), intent(in) :: list(:)

        type(csv_writer_t) :: writer
        integer :: i

        call begin_table(writer, path)
        call put_header(writer, [character(len=12) :: 'equation', 'what', 'literal', 'right', &
                                 'unit', 'deviation', 'note'])
        do i = 1, size(list)
            call put_cell(writer, trim(list(i)%equation))
            call put_cell(writer, trim(list(i)%what))
            call put_cells(writer, [list(i)%literal, list(i)%right])
            call put_cell(writer, trim(list(i)%unit))
            call put_cell(writer, list(i)%literal/list(i)%right - 1.0_wp)
            call put_cell(writer, trim(list(i)%note))
            call end_row(writer)
        end do
        call end_table(writer)
    end subroutine write_findings

    subroutine print_findings(list)
        type(finding_t), intent(in) :: list(:)

        character(len=16) :: literal
        character(len=120) :: line
        integer :: i

        do i = 1, size(list)
            write (line, '(2a, t21, a)') trim(list(i)%equation), ':', trim(list(i)%what)
            call say(trim(line))
            literal = 'no number'
            if (ieee_is_finite(list(i)%literal)) write (literal, '(es12.5)') list(i)%literal
            write (line, '(t21, 3a, es12.5, 2a)') 'literal ', trim(adjustl(literal)), ', right ', &
                list(i)%right, ' ', trim(list(i)%unit)
            call say(trim(line))
            call say('                    ' // trim(list(i)%note))
        end do
    end subroutine print_findings
end module faststrip_lab_studies_errata
