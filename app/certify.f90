!> The study behind the certificate of strip solutions: how often its estimates bound the true
!> errors, and by how much they are too large.
!>
!> Three sets of contacts: Hertz ellipses against the exact solution; the gaps of the reference
!> and random gaps against 201 strips; the gaps against CONTACT as well. Every second gap and the
!> ellipses served to calibrate the certificate.
module faststrip_app_certify
    use faststrip_kinds, only: wp
    use faststrip_status, only: status_t, is_error, st_ok, st_conformal
    use faststrip_text, only: integer_text
    use faststrip_csv, only: csv_table_t, csv_writer_t, read_csv, column_numbers, cell_text, &
                             open_csv, put_comment, put_header, put_cell, end_row, close_csv
    use faststrip_material, only: material_t, normal_compliance
    use faststrip_profile_gap, only: gap_t
    use faststrip_profile_gap_file, only: read_gap_file
    use faststrip_normal_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_strip, only: strip_workspace_t, strip_options_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_certificate, only: certificate_t, certify_strips, richardson_estimate
    use faststrip_normal_types, only: normal_result_t
    use faststrip_app_console, only: fail_on_error, put_origin, progress, say
    use faststrip_app_fuzz_gaps, only: fuzz_case_t, make_fuzz_case, family_names
    implicit none
    private

    public :: run_certificate_study

    integer, parameter :: strips_tried(5) = [5, 9, 15, 31, 41], fine_strips = 201
    integer, parameter :: n_tried = size(strips_tried)
    character(len=*), parameter :: quantities(3) = [character(len=11) :: 'penetration', 'pmax', &
                                                    'area']
    integer, parameter :: n_ellipses = 25, ellipse_points = 401
    integer, parameter :: n_random = 100, seed = 11
    !> Families of random gaps: no Hertz, no measured noise, no contact at the edge of the data.
    character(len=*), parameter :: families(9) = [character(len=12) :: 'several', 'merging', &
        'small_second', 'kinks', 'flat_top', 'wavy', 'conformal', 'concave', 'varying_a']
    integer, parameter :: most_random_points = 3000

    character(len=*), parameter :: sets(5) = [character(len=20) :: 'hertz', 'gaps_calibration', &
                                              'gaps_rest', 'random', 'gaps_contact']
    integer, parameter :: set_hertz = 1, set_calibration = 2, set_rest = 3, set_random = 4, &
                          set_contact = 5
    integer, parameter :: n_estimators = 2
    character(len=*), parameter :: estimators(n_estimators) = [character(len=11) :: &
                                                              'certificate', 'richardson']

    integer, parameter :: most_ratios = 400

    !> Estimated over true error of one set, estimator, number of strips and quantity.
    type :: ratios_t
        integer :: n = 0
        real(wp) :: values(most_ratios) = 0.0_wp
    end type ratios_t

    !> What the study has gathered.
    type :: study_t
        type(csv_writer_t) :: writer
        type(strip_workspace_t) :: workspace
        type(contact_strips_t) :: strips
        type(ratios_t) :: ratios(size(sets), n_estimators, n_tried, size(quantities))
    end type study_t

contains

    !> Run the study: one row per contact, number of strips, estimator and quantity into a CSV
    !> file, the coverage and median ratios to the standard output.
    subroutine run_certificate_study(path)
        character(len=*), intent(in) :: path !! CSV file to write, or `-`

        type(study_t), allocatable :: study
        type(status_t) :: status

        allocate (study)
        call reserve_strip_workspace(study%workspace, 1000, 5000, status)
        call fail_on_error(status)
        call reserve_strips(study%strips, 1000, status)
        call fail_on_error(status)
        call open_csv(study%writer, path, status)
        call fail_on_error(status)
        call put_origin(study%writer)
        call put_comment(study%writer, 'relative errors; penetration above the lowest gap')
        call put_comment(study%writer, 'truth: exact for hertz, ' // integer_text(fine_strips) &
                         // ' strips for gaps and random, CONTACT for gaps_contact')
        call put_header(study%writer, [character(len=12) :: 'set', 'case', 'strips', 'estimator', &
                                       'quantity', 'true_err', 'est_err', 'covered'])
        call try_ellipses(study)
        call try_gaps(study)
        call try_random(study)
        call close_csv(study%writer, status)
        call fail_on_error(status)
        if (path /= '-') call print_table(study)
    end subroutine run_certificate_study

    subroutine try_ellipses(study)
        type(study_t), intent(inout) :: study

        real(wp), parameter :: a = 1.0e-3_wp, loads(2) = [1.0e2_wp, 1.0e5_wp]
        type(gap_t) :: gap
        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp) :: b, half
        integer :: i, l, k

        allocate (gap%y(ellipse_points), gap%h(ellipse_points), gap%inv2r(ellipse_points))
        do i = 1, n_ellipses
            b = a*curvature_ratio(0.004_wp*25000.0_wp**((i - 1.0_wp)/(n_ellipses - 1)))
            do l = 1, size(loads)
                call hertz_solve(normal_compliance(material_t()), a, b, loads(l), hertz, status)
                call fail_on_error(status)
                half = (2*l)*hertz%b
                gap%y = [(half*(2.0_wp*(k - 1)/(ellipse_points - 1) - 1.0_wp) &
                          + 0.37_wp*(l - 1)*hertz%b, k=1, ellipse_points)]
                gap%h = b*gap%y**2
                gap%inv2r = a
                call try_contact(study, 'hertz_' // integer_text(i) // '_' // integer_text(l), &
                                 set_hertz, gap, loads(l), &
                                 [hertz%penetration, hertz%pmax, hertz%area])
            end do
        end do
    end subroutine try_ellipses

    !> B/A of the Hertz ellipse with a given a/b, by bisection.
    real(wp) function curvature_ratio(axes)
        real(wp), intent(in) :: axes

        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp) :: low, high, middle
        integer :: i

        low = log(1.0e-6_wp)
        high = log(1.0e6_wp)
        do i = 1, 60
            middle = 0.5_wp*(low + high)
            call hertz_solve(normal_compliance(material_t()), 1.0e-3_wp, 1.0e-3_wp*exp(middle), &
                             1.0e3_wp, hertz, status)
            if (hertz%a > axes*hertz%b) then
                high = middle
            else
                low = middle
            end if
        end do
        curvature_ratio = exp(0.5_wp*(low + high))
    end function curvature_ratio

    subroutine try_gaps(study)
        type(study_t), intent(inout) :: study

        character(len=*), parameter :: folder = 'reference/contact/'
        type(csv_table_t) :: table
        type(gap_t) :: gap
        type(status_t) :: status
        real(wp), allocatable :: load(:), penetration(:), pmax(:), area(:)
        character(len=:), allocatable :: name
        integer :: i

        call read_csv(folder // 's1002_uic60_B.csv', table, status)
        call fail_on_error(status)
        call column_numbers(table, 'Fn_N', load, status)
        call fail_on_error(status)
        call column_numbers(table, 'penetration_mm', penetration, status)
        call fail_on_error(status)
        call column_numbers(table, 'pmax_MPa', pmax, status)
        call fail_on_error(status)
        call column_numbers(table, 'area_extrap_mm2', area, status)
        call fail_on_error(status)
        do i = 1, table%n_rows
            name = 'shift_' // cell_text(table, i, 1)
            call read_gap_file(folder // 'gaps/' // name // '.csv', gap, status)
            call fail_on_error(status)
            call try_contact(study, name, merge(set_calibration, set_rest, modulo(i, 2) == 1), &
                             gap, load(i), [penetration(i), pmax(i), area(i)])
        end do
    end subroutine try_gaps

    subroutine try_random(study)
        type(study_t), intent(inout) :: study

        type(fuzz_case_t) :: random
        integer :: number, found

        number = 0
        found = 0
        do while (found < n_random)
            number = number + 1
            call make_fuzz_case(seed, number, random)
            if (size(random%gap%y) < 100 .or. size(random%gap%y) > most_random_points &
                .or. all(families /= family_names(random%family))) cycle
            call progress('random gaps', found, n_random)
            call try_contact(study, trim(family_names(random%family)) // '_' &
                             // integer_text(number), set_random, random%gap, random%load, &
                             [0.0_wp, 0.0_wp, 0.0_wp], found)
        end do
    end subroutine try_random

    !> Solve one contact with all numbers of strips, and enter what the estimates are worth.
    subroutine try_contact(study, name, set, gap, load, reference, found)
        type(study_t), intent(inout) :: study
        character(len=*), intent(in) :: name
        integer, intent(in) :: set
        type(gap_t), intent(in) :: gap
        real(wp), intent(in) :: load, reference(3) ! penetration, pmax, area; random: none
        integer, intent(inout), optional :: found  ! counts contacts solved without limitation

        type(normal_result_t) :: fine, coarse(n_tried), result(n_tried)
        type(certificate_t) :: certificate(n_estimators, n_tried)
        type(status_t) :: status
        real(wp) :: truth(3)
        logical :: halved(n_tried) ! is there a solution with half the strips?
        integer :: i

        call set_strip_gap(study%workspace, gap, status)
        call fail_on_error(status)
        call solve_with(study, load, fine_strips, fine, status)
        if (.not. is_smooth(status)) return
        do i = 1, n_tried
            call solve_with(study, load, half_of(strips_tried(i)), coarse(i), status)
            halved(i) = is_smooth(status)
            call solve_with(study, load, strips_tried(i), result(i), status)
            if (.not. is_smooth(status)) return
            call certify_strips(study%workspace%curve, normal_compliance(material_t()), &
                                study%strips, result(i), certificate(1, i), status)
            call fail_on_error(status)
            if (.not. halved(i)) cycle
            call richardson_estimate(coarse(i), result(i), &
                                     real(strips_tried(i), wp)/half_of(strips_tried(i)), &
                                     study%workspace%curve%h_lowest, certificate(2, i), status)
            call fail_on_error(status)
        end do
        if (present(found)) found = found + 1
        truth = [fine%penetration, fine%pmax, fine%area]
        if (set == set_hertz) truth = reference
        call enter(study, name, set, truth, result, certificate, halved)
        if (set == set_calibration .or. set == set_rest) &
            call enter(study, name, set_contact, reference, result, certificate, halved)
    end subroutine try_contact

    !> Did all strips settle? A half-space that is doubtful is a half-space.
    pure logical function is_smooth(status)
        type(status_t), intent(in) :: status

        is_smooth = status%code == st_ok .or. status%code == st_conformal
    end function is_smooth

    !> The coarser of the two solutions of Richardson's estimate.
    pure integer function half_of(n)
        integer, intent(in) :: n

        half_of = (n + 1)/2
    end function half_of

    subroutine solve_with(study, load, n, result, status)
        type(study_t), intent(inout) :: study
        real(wp), intent(in) :: load
        integer, intent(in) :: n
        type(normal_result_t), intent(out) :: result
        type(status_t), intent(out) :: status

        call strip_solve(study%workspace, normal_compliance(material_t()), load, &
                         strip_options_t(strips_per_patch=n), study%strips, result, status)
    end subroutine solve_with

    subroutine enter(study, name, set, truth, result, certificate, halved)
        type(study_t), intent(inout) :: study
        character(len=*), intent(in) :: name
        integer, intent(in) :: set
        real(wp), intent(in) :: truth(3)
        type(normal_result_t), intent(in) :: result(:)
        type(certificate_t), intent(in) :: certificate(:, :)
        logical, intent(in) :: halved(:)

        real(wp) :: lowest, error(3), estimate(3)
        integer :: i, e, q

        lowest = study%workspace%curve%h_lowest
        do i = 1, n_tried
            error = [(result(i)%penetration - truth(1))/(truth(1) - lowest), &
                     result(i)%pmax/truth(2) - 1.0_wp, result(i)%area/truth(3) - 1.0_wp]
            error = abs(error)
            do e = 1, merge(n_estimators, 1, halved(i))
                estimate = [certificate(e, i)%est_err_penetration, certificate(e, i)%est_err_pmax, &
                            certificate(e, i)%est_err_area]
                do q = 1, size(quantities)
                    call put_cell(study%writer, trim(sets(set)))
                    call put_cell(study%writer, name)
                    call put_cell(study%writer, strips_tried(i))
                    call put_cell(study%writer, trim(estimators(e)))
                    call put_cell(study%writer, trim(quantities(q)))
                    call put_cell(study%writer, error(q))
                    call put_cell(study%writer, estimate(q))
                    call put_cell(study%writer, merge(1, 0, estimate(q) >= error(q)))
                    call end_row(study%writer)
                    associate (ratios => study%ratios(set, e, i, q))
                        if (ratios%n == most_ratios) cycle
                        ratios%n = ratios%n + 1
                        ratios%values(ratios%n) = estimate(q)/max(error(q), epsilon(1.0_wp))
                    end associate
                end do
            end do
        end do
    end subroutine enter

    !> Coverage in percent and median ratio, of each number of strips and of all.
    subroutine print_table(study)
        type(study_t), intent(in) :: study

        character(len=200) :: line
        real(wp) :: all_ratios(n_tried*most_ratios)
        integer :: e, s, q, i, n

        line = ''
        write (line, '(a11,1x,a16,1x,a11,2x,5(a,i3,6x),a)') 'estimator', 'set', 'quantity', &
            ('N=', strips_tried(i), i=1, n_tried), 'all (coverage %, median est/true)'
        call say(trim(line))
        do e = 1, n_estimators
            do s = 1, size(sets)
                do q = 1, size(quantities)
                    write (line, '(a11,1x,a16,1x,a11)') estimators(e), sets(s), quantities(q)
                    n = 0
                    do i = 1, n_tried
                        associate (ratios => study%ratios(s, e, i, q))
                            line = line(:40 + 11*(i - 1)) // cell(ratios%values(:ratios%n))
                            all_ratios(n + 1:n + ratios%n) = ratios%values(:ratios%n)
                            n = n + ratios%n
                        end associate
                    end do
                    call say(trim(line(:40 + 11*n_tried)) // cell(all_ratios(:n)))
                end do
            end do
        end do
    end subroutine print_table

    !> Two numbers in eleven characters.
    function cell(ratios) result(text)
        real(wp), intent(in) :: ratios(:)
        character(len=11) :: text

        text = ''
        if (size(ratios) == 0) return
        write (text, '(i4,f6.1)') nint(100.0_wp*count(ratios >= 1.0_wp)/size(ratios)), &
            min(median(ratios), 999.0_wp)
    end function cell

    !> The middle one, the lower of two.
    pure real(wp) function median(values)
        real(wp), intent(in) :: values(:)

        integer :: i

        median = 0.0_wp
        do i = 1, size(values)
            if (count(values < values(i)) <= (size(values) - 1)/2 &
                .and. count(values <= values(i)) > (size(values) - 1)/2) median = values(i)
        end do
    end function median
end module faststrip_app_certify
