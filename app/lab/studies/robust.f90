!> `faststrip-lab bench robust`: what the answers are worth where smooth contacts end: the fixed
!> lattice that is fallen back to, and gaps with kinks and flat tops.
!>
!> Lattice: against CONTACT in the 20 contacts and against Hertz on 25 ellipses. Kinks and flat
!> tops: 15 strips, 31 and `auto` against 401 strips, whose own error is that of 201 to 401.
module faststrip_lab_studies_robust
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_cells_lattice, only: lattice_workspace_t, reserve_lattice, lattice_solve
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_strips, only: reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_command_program_console, only: fail_on_error, note, begin_table, end_table
    implicit none
    private

    public :: bench_robust

    integer, parameter :: lattice_strips(4) = [5, 9, 15, 31]
    integer, parameter :: tried(4) = [15, 31, strips_auto, 201], reference_strips = 401
    character(len=*), parameter :: tried_names(4) = [character(len=4) :: '15', '31', 'auto', '201']
    integer, parameter :: capacity = 900, points = 2001
    integer, parameter :: n_ellipses = 25, n_shapes = 8
    real(wp), parameter :: inv2r = 1.0_wp/920.0_wp
    real(wp), parameter :: loads(2) = [2.0e4_wp, 1.0e5_wp]

    type :: bench_t
        type(csv_writer_t) :: writer
        type(lattice_workspace_t) :: lattice
        type(workspace_t) :: workspace
    end type bench_t

    !> A contact whose answer is known.
    type, extends(contact_case_t) :: known_t
        character(len=:), allocatable :: name
        type(gap_curve_t) :: curve !! of its gap
        type(normal_result_t) :: truth
    end type known_t

contains

    !> Solve everything, write the CSV and say the mean and the largest errors.
    subroutine bench_robust(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the 20 contacts

        type(bench_t), allocatable :: bench
        type(status_t) :: status

        allocate (bench)
        call reserve_strips(bench%workspace%strips, capacity, status)
        call fail_on_error(status)
        call reserve_lattice(bench%lattice, capacity, status)
        call fail_on_error(status)
        call begin_table(bench%writer, file)
        call put_comment(bench%writer, 'relative errors; lattice: against CONTACT and Hertz; ' &
                         // 'kinks and flat tops: against ' // integer_text(reference_strips) &
                         // ' strips')
        call put_header(bench%writer, [character(len=15) :: 'family', 'case', 'method', &
                                       'strips', 'status', 'strips_used', 'penetration_err', &
                                       'pmax_err'])
        call try_contacts(bench, folder)
        call try_ellipses(bench)
        call try_shapes(bench)
        call end_table(bench%writer)
    end subroutine bench_robust

    !> The lattice on the 20 contacts.
    subroutine try_contacts(bench, folder)
        type(bench_t), intent(inout) :: bench
        character(len=*), intent(in) :: folder

        type(bench_case_t), allocatable :: cases(:)
        type(known_t), allocatable :: contacts(:)
        type(status_t) :: status
        integer :: i

        call read_bench_cases(folder, cases, status)
        call fail_on_error(status)
        allocate (contacts(size(cases)))
        do i = 1, size(cases)
            contacts(i)%contact_case_t = cases(i)%contact_case_t
            contacts(i)%name = cases(i)%name
            contacts(i)%truth = cases(i)%truth
        end do
        call try_lattice(bench, 'contact', 'contacts', contacts)
    end subroutine try_contacts

    !> The lattice on Hertz ellipses of a/b = 0.004 to 100.
    subroutine try_ellipses(bench)
        type(bench_t), intent(inout) :: bench

        type(known_t), allocatable :: contacts(:)
        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp) :: b
        integer :: i

        allocate (contacts(n_ellipses))
        do i = 1, n_ellipses
            associate (contact => contacts(i))
                contact%load = 1.0e4_wp
                ! a/b goes nearly as (B/A)**(2/3), less steeply far from the circle.
                b = 1.0e-3_wp*1.0e-4_wp*1.5e7_wp**(real(i - 1, wp)/(n_ellipses - 1))
                call hertz_solve(normal_compliance(contact%material), 1.0e-3_wp, b, contact%load, &
                                 hertz, status)
                call fail_on_error(status)
                call make_gap(1.0e-3_wp, 3.0_wp*hertz%b, contact%gap)
                contact%gap%h = b*contact%gap%y**2
                contact%name = 'b_' // integer_text(i)
                contact%truth%penetration = hertz%penetration
                contact%truth%pmax = hertz%pmax
            end associate
        end do
        call try_lattice(bench, 'hertz', 'ellipses', contacts)
    end subroutine try_ellipses

    !> The lattice by all numbers of strips.
    subroutine try_lattice(bench, family, what, contacts)
        type(bench_t), intent(inout) :: bench
        character(len=*), intent(in) :: family, what ! for the CSV, for people
        type(known_t), intent(inout) :: contacts(:)

        type(status_t) :: status
        real(wp) :: depth, errors(2, size(contacts))
        integer :: i, k

        do i = 1, size(contacts)
            call reserve_gap_curve(contacts(i)%curve, size(contacts(i)%gap%y), status)
            call fail_on_error(status)
            call set_gap_curve(contacts(i)%curve, contacts(i)%gap, status)
            call fail_on_error(status)
        end do
        do k = 1, size(lattice_strips)
            do i = 1, size(contacts)
                associate (contact => contacts(i))
                    call lattice_solve(bench%lattice, contact%curve, &
                                       normal_compliance(contact%material), contact%load, &
                                       lattice_strips(k), bench%workspace%strips, depth, &
                                       status)
                    call fail_on_error(status)
                    associate (strips => bench%workspace%strips)
                        errors(:, i) = [depth/contact%truth%penetration, &
                                        maxval(strips%p0(:strips%n))/contact%truth%pmax] - 1.0_wp
                    end associate
                    call put_row(bench, family, contact%name, 'lattice', &
                                 integer_text(lattice_strips(k)), status, errors(:, i))
                end associate
            end do
            call tell('lattice, ' // what, integer_text(lattice_strips(k)), errors)
        end do
    end subroutine try_lattice

    !> Kinks of the curvature, as between R300 and R80 of a rail, and flat tops.
    subroutine try_shapes(bench)
        type(bench_t), intent(inout) :: bench

        type(contact_case_t) :: contact
        type(status_t) :: status
        type(normal_result_t) :: fine, result
        character(len=:), allocatable :: family, name
        real(wp) :: errors(2, size(loads)*n_shapes, size(tried))
        integer :: i, l, k, n, m

        n = 0
        m = 0
        do i = 1, n_shapes
            call make_shape(i, contact%gap)
            family = 'kink'
            if (i > 5) family = 'flat_top'
            if (i == 6) m = n
            do l = 1, size(loads)
                contact%load = loads(l)
                name = integer_text(i) // '_' // integer_text(l)
                n = n + 1
                call solve_by_strips(bench%workspace, contact, reference_strips, fine, status)
                call fail_on_error(status)
                call put_row(bench, family, name, 'strip', integer_text(reference_strips), status, &
                             [0.0_wp, 0.0_wp])
                do k = 1, size(tried)
                    call solve_by_strips(bench%workspace, contact, tried(k), result, status)
                    call fail_on_error(status)
                    errors(:, n, k) = [result%penetration/fine%penetration, result%pmax/fine%pmax] &
                                      - 1.0_wp
                    call put_row(bench, family, name, 'strip', trim(tried_names(k)), status, &
                                 errors(:, n, k))
                end do
            end do
        end do
        do k = 1, size(tried)
            call tell('kinks', trim(tried_names(k)), errors(:, :m, k))
            call tell('flat tops', trim(tried_names(k)), errors(:, m + 1:n, k))
        end do
    end subroutine try_shapes

    !> Shape 1 to 5: a radius of 300 mm turns into one of 80 mm at some place; 6 to 8: a flat top,
    !> 2 or 6 mm wide, with edges rounded by 80 or 20 mm.
    subroutine make_shape(i, gap)
        integer, intent(in) :: i
        type(gap_t), intent(inout) :: gap

        real(wp), parameter :: place(5) = [0.0_wp, 1.0_wp, 2.0_wp, 4.0_wp, 6.0_wp]
        real(wp), parameter :: half(6:8) = [1.0_wp, 3.0_wp, 3.0_wp]
        real(wp), parameter :: radius(6:8) = [80.0_wp, 80.0_wp, 20.0_wp]

        call make_gap(inv2r, 20.0_wp, gap)
        if (i <= 5) then
            gap%h = gap%y**2/600.0_wp
            where (gap%y > place(i)) gap%h = gap%h + (gap%y - place(i))**2 &
                                             *(1.0_wp/160.0_wp - 1.0_wp/600.0_wp)
        else
            gap%h = max(abs(gap%y) - half(i), 0.0_wp)**2/(2.0_wp*radius(i))
        end if
    end subroutine make_shape

    subroutine make_gap(a, half, gap)
        real(wp), intent(in) :: a, half
        type(gap_t), intent(out) :: gap

        integer :: i

        allocate (gap%y(points), gap%h(points), gap%inv2r(points), source=0.0_wp)
        gap%y = [(half*(2.0_wp*(i - 1)/(points - 1) - 1.0_wp), i=1, points)]
        gap%inv2r = a
    end subroutine make_gap

    subroutine put_row(bench, family, name, method, strips, status, error)
        type(bench_t), intent(inout) :: bench
        character(len=*), intent(in) :: family, name, method, strips
        type(status_t), intent(in) :: status
        real(wp), intent(in) :: error(2)

        call put_cell(bench%writer, family)
        call put_cell(bench%writer, name)
        call put_cell(bench%writer, method)
        call put_cell(bench%writer, strips)
        call put_cell(bench%writer, trim(status_word(status%code)))
        call put_cell(bench%writer, bench%workspace%strips%n)
        call put_cells(bench%writer, error)
        call end_row(bench%writer)
    end subroutine put_row

    subroutine tell(what, strips, errors)
        character(len=*), intent(in) :: what, strips
        real(wp), intent(in) :: errors(:, :)

        character(len=120) :: line

        write (line, '(4a, 2(a, f0.3, a, f0.3))') what, ', ', strips, ' strips, mean/max %:', &
            ' penetration ', mean(errors(1, :)), '/', 100.0_wp*maxval(abs(errors(1, :))), &
            ', pmax ', mean(errors(2, :)), '/', 100.0_wp*maxval(abs(errors(2, :)))
        call note(trim(line))
    end subroutine tell

    pure real(wp) function mean(values)
        real(wp), intent(in) :: values(:)

        mean = 100.0_wp*sum(abs(values))/size(values)
    end function mean
end module faststrip_lab_studies_robust
