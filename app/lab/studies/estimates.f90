!> The study behind the error estimates of strip solutions: how often they bound the true
!> errors, and by how much they are too large.
!>
!> Hertz ellipses are judged by the exact solution; the 20 gaps of the reference and random gaps by
!> Kalker's method on two grids, extrapolated (`faststrip_lab_studies_estimates_reference`). Many
!> strips are no reference: all strips share that their sections are taken for semi-ellipses. The
!> gaps are compared with CONTACT as well, on its grid.
!>
!> The factors of the error estimates were fitted to contacts of wheels on rails and to random gaps
!> of `faststrip-lab fuzz`, seeds 1 to 10; the gaps here are of another seed.
module faststrip_lab_studies_estimates
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_ok, st_conformal
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_strip, only: strips_auto
    use faststrip_normal_estimate_errors, only: normal_errors_t, estimate_strip_errors
    use faststrip_normal_types, only: normal_result_t
    use faststrip_kalker_normal, only: norm_workspace_t, release_norm
    use faststrip_kalker_normal_estimate, only: richardson_estimate
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_lab_grid_cases, only: bench_case_t, read_bench_cases
    use faststrip_lab_pressures, only: solve_by_strips
    use faststrip_lab_studies_estimates_tally, only: tally_t, start_tally, count_in, count_out, &
                                                     print_tally, figures, n_figures
    use faststrip_lab_studies_estimates_reference, only: reference_t, find_reference, is_certain, &
                                                         elements_along, elements_across
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_lab_fuzz_cases, only: fuzz_case_t, draw_case, all_families
    use faststrip_lab_checkout, only: in_checkout
    implicit none
    private

    public :: run_estimates_study

    integer, parameter :: strips_tried(7) = [5, 9, 15, 21, 31, 41, strips_auto]
    integer, parameter :: n_tried = size(strips_tried)
    character(len=*), parameter :: solutions(n_tried) = [character(len=22) :: '5', '9', '15', &
                                                         '21', '31', '41', 'auto']
    integer, parameter :: extent_strips = 41 ! whose solution is the size of the reference's grids
    integer, parameter :: n_ellipses = 25, ellipse_points = 401
    integer, parameter :: seed = 31 ! none of these, see above
    integer, parameter :: per_family = 24, most_drawn = 3000, most_random_points = 20000

    !> Families of random gaps whose solution is smooth, with pressures that are finite: no slopes
    !> that jump, no contact at the edge of the data, nothing flat or hollow along x.
    character(len=*), parameter :: random_families(24) = [character(len=12) :: &
        'hertz', 'several', 'merging', 'small_second', 'kinks', 'flat_top', 'wavy', 'conformal', &
        'concave', 'varying_a', 'measured', 'noise', 'exponential', 'tanh', 'ripples', 'neck', &
        'slender', 'worn', 'contacts', 'coarse', 'fine', 'uneven', 'offset', 'metres']

    !> All sets of contacts.
    character(len=*), parameter :: families(3 + size(random_families)) = &
        [character(len=12) :: 'ellipses', 'gaps', 'gaps_contact', random_families]
    integer, parameter :: set_ellipses = 1, set_gaps = 2, set_contact = 3

    integer, parameter :: residuals_ = 1, richardson_ = 2, norm_ = 3
    character(len=*), parameter :: estimators(3) = [character(len=11) :: 'residuals', &
                                                    'richardson', 'norm']

    !> A contact and what its strips give.
    type, extends(contact_case_t) :: studied_case_t
        character(len=:), allocatable :: name
        real(wp) :: h_lowest = 0.0_wp
        type(normal_result_t) :: result(n_tried)
        type(normal_errors_t) :: normal_errors(n_tried), halves(n_tried)
        logical :: is_smooth(n_tried) = .false. ! did all strips converge, no limitation?
        logical :: is_halved(n_tried) = .false. ! and is there a solution with half of them?
    end type studied_case_t

    !> What the study has gathered.
    type :: study_t
        type(csv_writer_t) :: writer
        type(workspace_t) :: workspace
        type(tally_t) :: tally(size(estimators))
    end type study_t

contains

    !> Run the study: one row per contact, solution, estimator and figure into a CSV file, the
    !> coverage and the ratios to the standard output.
    subroutine run_estimates_study(path)
        character(len=*), intent(in) :: path !! CSV file to write, or `-`

        type(study_t), allocatable :: study
        integer :: e

        allocate (study)
        do e = 1, size(estimators)
            call start_tally(study%tally(e), size(families), n_tried)
        end do
        call begin_table(study%writer, path)
        call put_comment(study%writer, 'relative errors; penetration above the lowest gap')
        call put_comment(study%writer, 'reference: exact for ellipses, CONTACT for gaps_contact, ' &
                         // 'for all others NORM on ' // integer_text(elements_along) // ' by ' &
                         // integer_text(elements_across) // ' and twice as many elements, ' &
                         // 'carried on')
        call put_comment(study%writer, 'doubt: what the reference may be wrong by; blank in ' &
                         // 'covered where that is too much')
        call put_header(study%writer, [character(len=12) :: 'family', 'case', 'strips', &
                                       'estimator', 'quantity', 'true_err', 'est_err', 'doubt', &
                                       'covered'])
        call try_ellipses(study)
        call try_gaps(study)
        call try_random(study)
        call end_table(study%writer)
        if (path == '-') return
        call print_tally(study%tally(residuals_), estimators(residuals_), families, solutions)
        call print_tally(study%tally(richardson_), estimators(richardson_), families, solutions)
        call print_tally(study%tally(norm_), estimators(norm_), families, &
                         [character(len=22) :: 'coarser grid'])
    end subroutine run_estimates_study

    subroutine try_ellipses(study)
        type(study_t), intent(inout) :: study

        real(wp), parameter :: a = 1.0e-3_wp, loads(2) = [1.0e2_wp, 1.0e5_wp]
        type(studied_case_t) :: contact
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
                contact = named('hertz_' // integer_text(i) // '_' // integer_text(l), loads(l))
                contact%gap = gap
                call solve_all(study, contact)
                call enter(study, contact, set_ellipses, &
                           figures_alone([hertz%penetration, hertz%pmax, hertz%area]))
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

        type(bench_case_t), allocatable :: cases(:)
        type(norm_workspace_t) :: norm
        type(studied_case_t) :: contact
        type(reference_t) :: reference
        logical :: is_found
        integer :: i

        call read_bench_cases(in_checkout('reference/contact'), cases)
        do i = 1, size(cases)
            contact = named(cases(i)%name, cases(i)%load)
            contact%gap = cases(i)%gap
            call solve_all(study, contact)
            call find(study, norm, contact, reference, is_found)
            if (is_found) call enter(study, contact, set_gaps, reference)
            associate (known => cases(i)%known)
                reference = figures_alone([known%penetration - contact%h_lowest, known%pmax, &
                                           known%area])
            end associate
            call enter(study, contact, set_contact, reference)
        end do
        call release_norm(norm)
    end subroutine try_gaps

    !> A contact of which all but name and load is the default.
    type(studied_case_t) function named(name, load) result(contact)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: load

        contact%name = name
        contact%load = load
    end function named

    !> A reference without doubts.
    type(reference_t) function figures_alone(figure) result(reference)
        real(wp), intent(in) :: figure(3)

        reference%figure = figure
    end function figures_alone

    !> So many of each family as there is a reference for, out of so many that are drawn.
    subroutine try_random(study)
        type(study_t), intent(inout) :: study

        type(fuzz_case_t) :: random
        type(norm_workspace_t) :: norm
        type(studied_case_t) :: contact
        type(reference_t) :: reference
        logical :: is_found
        integer :: found(size(random_families)), number, f

        found = 0
        do number = 1, most_drawn
            if (all(found >= per_family)) exit
            call progress('random gaps', sum(found), per_family*size(found))
            call draw_case(seed, number, random)
            f = findloc(random_families == all_families(random%family), .true., dim=1)
            if (f == 0) cycle
            if (found(f) >= per_family .or. size(random%gap%y) > most_random_points) cycle
            contact = named('fuzz_' // integer_text(number), random%load)
            contact%gap = random%gap
            call solve_all(study, contact)
            if (.not. any(contact%is_smooth)) cycle
            call find(study, norm, contact, reference, is_found)
            if (.not. is_found) cycle
            found(f) = found(f) + 1
            call enter(study, contact, set_contact + f, reference)
        end do
        call release_norm(norm)
    end subroutine try_random

    !> Solve one contact with all numbers of strips, and with half of them.
    subroutine solve_all(study, contact)
        type(study_t), intent(inout) :: study
        type(studied_case_t), intent(inout) :: contact

        type(normal_result_t) :: coarse
        type(status_t) :: status
        integer :: i, n

        do i = 1, n_tried
            n = strips_tried(i)
            if (n /= strips_auto) then
                call solve_by_strips(study%workspace, contact, half_of(n), coarse, status)
                contact%is_halved(i) = is_smooth(status)
            end if
            call solve_by_strips(study%workspace, contact, n, contact%result(i), status)
            contact%h_lowest = study%workspace%solver%curve%h_lowest
            contact%is_smooth(i) = is_smooth(status)
            if (.not. is_smooth(status)) cycle
            call estimate_strip_errors(study%workspace%solver%curve, &
                                normal_compliance(contact%material), study%workspace%strips, &
                                contact%result(i), contact%normal_errors(i), status)
            call fail_on_error(status)
            if (.not. contact%is_halved(i)) cycle
            call richardson_estimate(coarse, contact%result(i), real(n, wp)/half_of(n), &
                                     contact%h_lowest, contact%halves(i))
        end do
    end subroutine solve_all

    !> The reference of a contact that was just solved, on grids of the size of its strips.
    subroutine find(study, norm, contact, reference, is_found)
        type(study_t), intent(inout) :: study
        type(norm_workspace_t), intent(inout) :: norm
        type(studied_case_t), intent(in) :: contact
        type(reference_t), intent(out) :: reference
        logical, intent(out) :: is_found

        type(normal_result_t) :: ignored
        type(status_t) :: status

        is_found = .false.
        call solve_by_strips(study%workspace, contact, extent_strips, ignored, status)
        if (.not. is_error(status)) &
            call find_reference(norm, contact, study%workspace%solver%curve, &
                                study%workspace%strips, reference, is_found)
    end subroutine find

    !> Did all strips converge? A half-space that is doubtful is a half-space.
    pure logical function is_smooth(status)
        type(status_t), intent(in) :: status

        is_smooth = status%code == st_ok .or. status%code == st_conformal
    end function is_smooth

    !> The coarser of the two solutions of Richardson's estimate.
    pure integer function half_of(n)
        integer, intent(in) :: n

        half_of = (n + 1)/2
    end function half_of

    !> Enter what the estimates of a contact are worth.
    subroutine enter(study, contact, family, reference)
        type(study_t), intent(inout) :: study
        type(studied_case_t), intent(in) :: contact
        integer, intent(in) :: family
        type(reference_t), intent(in) :: reference

        integer :: i

        do i = 1, n_tried
            if (.not. contact%is_smooth(i)) cycle
            call enter_one(residuals_, i, contact%result(i), contact%normal_errors(i))
            if (contact%is_halved(i)) &
                call enter_one(richardson_, i, contact%result(i), contact%halves(i))
        end do
        if (reference%coarse%pmax > 0.0_wp) &
            call enter_one(norm_, 1, reference%coarse, reference%estimated)

    contains

        subroutine enter_one(estimator, solution, result, normal_errors)
            integer, intent(in) :: estimator, solution
            type(normal_result_t), intent(in) :: result
            type(normal_errors_t), intent(in) :: normal_errors

            real(wp), dimension(n_figures) :: error, estimate
            integer :: q

            error = abs([result%penetration - contact%h_lowest, result%pmax, result%area] &
                        /reference%figure - 1.0_wp)
            estimate = [normal_errors%est_err_penetration, normal_errors%est_err_pmax, &
                        normal_errors%est_err_area]
            do q = 1, n_figures
                call put_cell(study%writer, trim(families(family)))
                call put_cell(study%writer, contact%name)
                if (estimator == norm_) then
                    call put_cell(study%writer, 'grid')
                else
                    call put_cell(study%writer, trim(solutions(solution)))
                end if
                call put_cell(study%writer, trim(estimators(estimator)))
                call put_cell(study%writer, trim(figures(q)))
                call put_cells(study%writer, [error(q), estimate(q), reference%doubt(q)])
                if (is_certain(reference%doubt(q), error(q))) then
                    call put_cell(study%writer, merge(1, 0, estimate(q) >= error(q)))
                    call count_in(study%tally(estimator), family, solution, q, estimate(q), &
                                  error(q))
                else
                    call put_cell(study%writer, '')
                    call count_out(study%tally(estimator), family, solution, q)
                end if
                call end_row(study%writer)
            end do
        end subroutine enter_one
    end subroutine enter
end module faststrip_lab_studies_estimates
