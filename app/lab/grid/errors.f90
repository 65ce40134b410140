!> `faststrip-lab bench accuracy`, `convergence` and `robust`: errors of pressures, as a grid of
!> sets of contacts, of choices that solve them, and of what each set is judged by.
!>
!> - accuracy: the 20 contacts by 15 strips and auto, against CONTACT.
!> - convergence: the 20 contacts by 5 to 81 strips, against 301; ellipses against Hertz.
!> - robust: the cells that are fallen back to on the 20 contacts and the ellipses, against CONTACT
!>   and Hertz; kinks and flat tops by 15, 31 and 201 strips and auto, against 401.
module faststrip_lab_grid_errors
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, number_text, status_word
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_base_material, only: normal_compliance
    use faststrip_normal_strip, only: strips_auto, strip_options_t, strip_solve, set_strip_gap, &
                                      reserve_strip_workspace
    use faststrip_normal_strips, only: usual_strips, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_grid_ellipse, only: make_ellipse
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_command_program_console, only: fail_on_error, note, progress, begin_table, &
                                                 end_table
    implicit none
    private

    public :: bench_accuracy, bench_convergence, bench_robust

    integer, parameter :: strip_counts(12) = [5, 7, 9, 11, 15, 21, 27, 31, 41, 51, 61, 81]
    ! Strips that others are judged by: of the contacts, of kinks and flat tops.
    integer, parameter :: finest = 301, finest_of_shapes = 401
    integer, parameter :: capacity = 900
    ! Errors of a contact: penetration, pmax, area, relative; ends of the contact, mm.
    integer, parameter :: n_errors = 5
    character(len=*), parameter :: error_columns(n_errors) = [character(len=15) :: &
        'penetration_err', 'pmax_err', 'area_err', 'ymin_err_mm', 'ymax_err_mm']

    !> What solves.
    type :: bench_t
        type(csv_writer_t) :: writer
        type(workspace_t) :: workspace
    end type bench_t

contains

    !> The strips as users have them, on the paper's contacts.
    subroutine bench_accuracy(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts

        type(bench_t), allocatable :: bench
        type(bench_case_t), allocatable :: contacts(:)

        call read_bench_cases(folder, contacts)
        call begin(bench, file, 'CONTACT on 0.1 mm, area extrapolated')
        call try_strips(bench, contacts, [usual_strips, strips_auto])
        call end_table(bench%writer)
    end subroutine bench_accuracy

    !> Errors against the number of strips.
    subroutine bench_convergence(file, folder, most_strips)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the contacts
        integer, intent(in) :: most_strips     !! no larger number of strips

        type(bench_t), allocatable :: bench
        type(bench_case_t), allocatable :: contacts(:)

        call read_bench_cases(folder, contacts)
        call begin(bench, file, integer_text(finest) // ' strips for the shifts, Hertz for the ' &
                   // 'ellipses')
        call judge_by_strips(bench, contacts, finest)
        call try_strips(bench, contacts, pack(strip_counts, strip_counts <= most_strips))
        call make_ellipses(contacts)
        call try_strips(bench, contacts, pack(strip_counts, strip_counts <= most_strips))
        call end_table(bench%writer)
    end subroutine bench_convergence

    !> What the answers are worth where smooth contacts end.
    subroutine bench_robust(file, folder)
        character(len=*), intent(in) :: file   !! to write, - for stdout
        character(len=*), intent(in) :: folder !! with the 20 contacts

        type(bench_t), allocatable :: bench
        type(bench_case_t), allocatable :: contacts(:)
        type(status_t) :: status
        integer :: kind

        call read_bench_cases(folder, contacts)
        call begin(bench, file, 'CONTACT, Hertz, ' // integer_text(finest_of_shapes) // ' strips')
        call fail_on_error(status)
        call reserve_strips(bench%workspace%strips, capacity, status)
        call fail_on_error(status)
        call try_cells(bench, contacts)
        call make_ellipses(contacts)
        call try_cells(bench, contacts)
        do kind = 1, 2
            call make_shapes(kind, contacts)
            call judge_by_strips(bench, contacts, finest_of_shapes)
            call try_strips(bench, contacts, [usual_strips, 31, strips_auto, 201])
        end do
        call end_table(bench%writer)
    end subroutine bench_robust

    subroutine begin(bench, file, judges)
        type(bench_t), allocatable, intent(out) :: bench
        character(len=*), intent(in) :: file, judges

        allocate (bench)
        call begin_table(bench%writer, file)
        call put_comment(bench%writer, 'errors, relative or in mm, against ' // judges)
        call put_header(bench%writer, [character(len=len(error_columns)) :: 'set', 'case', &
                                       'method', 'strips', 'status', 'strips_used', 'iterations', &
                                       error_columns])
    end subroutine begin

    !> Ellipses of many proportions under one load, judged by Hertz.
    subroutine make_ellipses(contacts)
        type(bench_case_t), allocatable, intent(out) :: contacts(:)

        real(wp), parameter :: ratios(12) = [0.01_wp, 0.02_wp, 0.05_wp, 0.1_wp, 0.2_wp, 0.5_wp, &
                                             1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp, 20.0_wp, 50.0_wp]
        real(wp), parameter :: load = 1.0e5_wp ! N
        integer, parameter :: points = 801
        integer :: i

        allocate (contacts(size(ratios)))
        do i = 1, size(ratios)
            contacts(i)%load = load
            contacts(i)%set = 'ellipses'
            contacts(i)%name = 'hertz_' // trim(number_text(ratios(i)))
            call make_ellipse(ratios(i), points, contacts(i), contacts(i)%known)
        end do
    end subroutine make_ellipses

    !> Kind 1, kinks: a radius of 300 mm turns into one of 80 mm at some place; kind 2: flat tops,
    !> 2 or 6 mm wide, with edges rounded by 80 or 20 mm. Each under two loads.
    subroutine make_shapes(kind, contacts)
        integer, intent(in) :: kind
        type(bench_case_t), allocatable, intent(out) :: contacts(:)

        character(len=*), parameter :: sets(2) = [character(len=9) :: 'kinks', 'flat_tops']
        real(wp), parameter :: loads(2) = [2.0e4_wp, 1.0e5_wp]
        real(wp), parameter :: place(5) = [0.0_wp, 1.0_wp, 2.0_wp, 4.0_wp, 6.0_wp]
        real(wp), parameter :: half(3) = [1.0_wp, 3.0_wp, 3.0_wp]
        real(wp), parameter :: radius(3) = [80.0_wp, 80.0_wp, 20.0_wp]
        integer, parameter :: points = 2001
        real(wp), parameter :: half_width = 20.0_wp, inv2r = 1.0_wp/920.0_wp
        integer :: i, k, l, n

        n = merge(size(place), size(half), kind == 1)
        allocate (contacts(size(loads)*n))
        do i = 1, n
            do l = 1, size(loads)
                associate (one => contacts(size(loads)*(i - 1) + l))
                    one%load = loads(l)
                    one%set = trim(sets(kind))
                    one%name = integer_text(i) // '_' // integer_text(l)
                    one%gap%y = [(half_width*(2.0_wp*(k - 1)/(points - 1) - 1.0_wp), k=1, points)]
                    allocate (one%gap%h(points), one%gap%inv2r(points), source=inv2r)
                    associate (y => one%gap%y, h => one%gap%h)
                        if (kind == 1) then
                            h = y**2/600.0_wp
                            where (y > place(i)) h = h + (y - place(i))**2 &
                                                     *(1.0_wp/160.0_wp - 1.0_wp/600.0_wp)
                        else
                            h = max(abs(y) - half(i), 0.0_wp)**2/(2.0_wp*radius(i))
                        end if
                    end associate
                end associate
            end do
        end do
    end subroutine make_shapes

    !> Judge contacts by many strips; those that cannot be solved so are left out, and named.
    subroutine judge_by_strips(bench, contacts, strips)
        type(bench_t), intent(inout) :: bench
        type(bench_case_t), allocatable, intent(inout) :: contacts(:)
        integer, intent(in) :: strips

        type(status_t) :: status
        logical :: is_known(size(contacts))
        integer :: i

        do i = 1, size(contacts)
            call progress('contacts', i, size(contacts))
            call solve_by_strips(bench%workspace, contacts(i), strips, contacts(i)%known, status)
            is_known(i) = status%code == 0
            if (.not. is_known(i)) call note(contacts(i)%name // ' has no reference: ' &
                                             // trim(status%message))
        end do
        contacts = pack(contacts, is_known)
    end subroutine judge_by_strips

    !> All contacts by all numbers of strips.
    subroutine try_strips(bench, contacts, strip_counts)
        type(bench_t), intent(inout) :: bench
        type(bench_case_t), intent(in) :: contacts(:)
        integer, intent(in) :: strip_counts(:)

        type(normal_result_t) :: result
        type(status_t) :: status
        real(wp) :: errors(n_errors, size(contacts))
        character(len=:), allocatable :: strips
        integer :: i, k, n

        do k = 1, size(strip_counts)
            strips = integer_text(strip_counts(k))
            if (strip_counts(k) == strips_auto) strips = 'auto'
            n = 0
            do i = 1, size(contacts)
                call progress('contacts', i + (k - 1)*size(contacts), &
                              size(strip_counts)*size(contacts))
                call solve_by_strips(bench%workspace, contacts(i), strip_counts(k), result, status)
                if (.not. is_error(status)) n = n + 1
                call put_errors(bench, contacts(i), 'strip', strips, result, status, &
                                errors(:, max(n, 1)))
            end do
            if (n > 0) call tell(contacts(1)%set // ' by ' // strips // ' strips', errors(:, :n))
        end do
    end subroutine try_strips

    !> The same by cells.
    subroutine try_cells(bench, contacts)
        type(bench_t), intent(inout) :: bench
        type(bench_case_t), intent(in) :: contacts(:)

        type(normal_result_t) :: result
        type(status_t) :: status
        real(wp) :: errors(n_errors, size(contacts))
        integer :: i

        do i = 1, size(contacts)
            associate (one => contacts(i), work => bench%workspace)
                call reserve_strip_workspace(work%solver, capacity, size(one%gap%y), status)
                if (.not. is_error(status)) call set_strip_gap(work%solver, one%gap, status)
                if (.not. is_error(status)) &
                    call strip_solve(work%solver, normal_compliance(one%material), one%load, &
                                     strip_options_t(by_cells=.true.), work%strips, result, status)
                call fail_on_error(status)
                call put_errors(bench, one, 'cells', '', result, status, errors(:, i))
            end associate
        end do
        call tell(contacts(1)%set // ' by cells', errors)
    end subroutine try_cells

    !> The row of a solution, and its errors.
    subroutine put_errors(bench, contact, method, strips, result, status, errors)
        type(bench_t), intent(inout) :: bench
        type(bench_case_t), intent(in) :: contact
        character(len=*), intent(in) :: method, strips
        type(normal_result_t), intent(in) :: result
        type(status_t), intent(in) :: status
        real(wp), intent(inout) :: errors(n_errors)

        call put_cell(bench%writer, contact%set)
        call put_cell(bench%writer, contact%name)
        call put_cell(bench%writer, method)
        call put_cell(bench%writer, strips)
        call put_cell(bench%writer, trim(status_word(status%code)))
        if (is_error(status)) then
            call put_empty_cells(bench%writer, 2 + n_errors)
        else
            errors = [result%penetration/contact%known%penetration - 1.0_wp, &
                      result%pmax/contact%known%pmax - 1.0_wp, &
                      result%area/contact%known%area - 1.0_wp, &
                      result%y_min - contact%known%y_min, result%y_max - contact%known%y_max]
            call put_cells(bench%writer, [bench%workspace%strips%n, result%iterations])
            call put_cells(bench%writer, errors)
        end if
        call end_row(bench%writer)
    end subroutine put_errors

    !> Say the mean and the largest errors.
    subroutine tell(what, errors)
        character(len=*), intent(in) :: what
        real(wp), intent(in) :: errors(:, :)

        call note(what // ', mean/max: penetration ' // pair(100.0_wp*errors(1, :)) &
                  // ' %, pmax ' // pair(100.0_wp*errors(2, :)) // ' %, area ' &
                  // pair(100.0_wp*errors(3, :)) // ' %, ends ' // pair([errors(4, :), &
                                                                     errors(5, :)]) // ' mm')
    end subroutine tell

    function pair(values) result(text)
        real(wp), intent(in) :: values(:)
        character(len=:), allocatable :: text

        character(len=24) :: buffer

        write (buffer, '(f0.3, a, f0.3)') sum(abs(values))/size(values), '/', maxval(abs(values))
        text = trim(buffer)
    end function pair
end module faststrip_lab_grid_errors
