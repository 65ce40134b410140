!> One case of `faststrip-lab fuzz`: solved, spoiled if asked, checked.
module faststrip_lab_fuzz_run
    use, intrinsic :: ieee_arithmetic, only: ieee_get_flag, ieee_set_flag, &
                                             ieee_invalid, ieee_divide_by_zero, ieee_overflow
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_no_finite_patch, st_fallback_used, &
                                     st_out_of_range
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_estimate_errors, only: normal_errors_t, estimate_strip_errors
    use faststrip_normal_limitations, only: name_resolution, default_resolution
    use faststrip_normal_strip, only: strip_options_t, set_strip_gap, strip_solve_demand
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_contact_methods, only: normal_strip, tangential_none
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_reserve, only: reserve_workspace
    use faststrip_contact_solve, only: solve_contact
    use faststrip_lab_fuzz_cases, only: fuzz_case_t
    use faststrip_lab_fuzz_faults, only: plant_fault
    use faststrip_lab_fuzz_force_checks, only: check_forces
    use faststrip_lab_fuzz_checks, only: verdict_t, report_badness, check_answer, check_finite, &
                                         check_depth, check_resolved
    use faststrip_lab_fuzz_norm_check, only: check_by_norm
    use faststrip_lab_fuzz_relations, only: relations, related_case, check_relation
    use faststrip_lab_fuzz_solution_checks, only: check_figures, check_contact, check_gap_curve
    implicit none
    private

    public :: workspaces_t, try_case

    ! `ok` means that the solution's own estimates are at most this.
    real(wp), parameter :: largest_estimate = 0.1_wp

    !> What the solvers work in, and how they are asked.
    type :: workspaces_t
        logical :: by_cells = .false.           !! is every answer that of cells?
        character(len=:), allocatable :: fault  !! planted in every answer, or blank
        logical :: thorough = .false.           !! every check on every case?
        type(workspace_t) :: workspace          !! grown as needed
    end type workspaces_t

contains

    !> Solve a case and check the answer.
    !>
    !> Cheap checks see every case. Of the checks that need a second solution one sees it, by the
    !> case's number in turn, and NORM sees one case in a hundred.
    subroutine try_case(seed, case, work, verdict)
        integer, intent(in) :: seed             !! of the series
        type(fuzz_case_t), intent(in) :: case
        type(workspaces_t), intent(inout) :: work
        type(verdict_t), intent(out) :: verdict

        type(gap_curve_t) :: curve
        type(contact_strips_t) :: strips
        integer :: r

        call solve_case(case, .false., work, verdict)
        if (is_error(verdict%status) .or. verdict%badness(check_finite) > 1.0_wp) return
        associate (workspace => work%workspace)
            call check_figures(case, workspace%strips, verdict%result, verdict)
            if (any(verdict%badness > 1.0e8_wp)) return
            call check_gap_curve(case%gap, workspace%solver%curve, verdict%result%penetration, &
                                 verdict)
            call check_contact(case, workspace%solver%curve, workspace%strips, &
                               verdict%result, verdict)
            ! An answer to no contact says nothing further.
            if (verdict%badness(check_depth) > 1.0_wp) return
            call estimate(case, workspace, verdict)
            call report_badness(verdict, check_resolved, maxval(verdict%est_err)/largest_estimate)
            call check_forces(seed, case, work%fault, workspace, verdict)
            curve = workspace%solver%curve
            strips = workspace%strips
        end associate
        if (work%thorough .or. has_norm(case%number, verdict%status%code == st_fallback_used)) &
            call check_by_norm(case, curve, strips, verdict)
        do r = 1, size(relations)
            if (work%thorough .or. modulo(case%number/2, size(relations)) == r - 1) &
                call try_relation(relations(r), case, curve, work, verdict)
        end do
    end subroutine try_case

    !> Every hundredth case, odd and even ones in turn, and every fifth pair that fell back.
    pure logical function has_norm(number, fell_back)
        integer, intent(in) :: number
        logical, intent(in) :: fell_back

        has_norm = modulo(number, 200) == 51 .or. modulo(number, 200) == 100 &
                   .or. (fell_back .and. modulo(number/2, 5) == 0)
    end function has_norm

    !> Solve the related case and compare.
    subroutine try_relation(relation, case, curve, work, verdict)
        integer, intent(in) :: relation
        type(fuzz_case_t), intent(in) :: case
        type(gap_curve_t), intent(in) :: curve
        type(workspaces_t), intent(inout) :: work
        type(verdict_t), intent(inout) :: verdict

        type(fuzz_case_t) :: other_case
        type(verdict_t) :: other
        logical :: has_one

        call related_case(relation, case, curve, verdict%result, other_case, has_one)
        if (.not. has_one) return
        call solve_case(other_case, .true., work, other)
        if (.not. is_error(other%status)) call estimate(other_case, work%workspace, other)
        call check_relation(relation, verdict, curve, other, work%workspace%solver%curve)
    end subroutine try_relation

    !> Solve a case, note how long it took, and plant the fault. The call for embedding keeps the
    !> floating-point flags to itself; what it calls shows them.
    subroutine solve_case(case, embedded, work, verdict)
        type(fuzz_case_t), intent(in) :: case
        logical, intent(in) :: embedded ! by the call for embedding, or by what it calls?
        type(workspaces_t), intent(inout) :: work
        type(verdict_t), intent(inout) :: verdict

        type(contact_case_t) :: contact
        type(contact_result_t) :: result
        integer(int64) :: before, after, rate

        contact = case%contact_case_t
        contact%estimate = .false. ! `estimate` does
        contact%methods%tangential = tangential_none
        call reserve_workspace(work%workspace, case%methods, size(case%gap%y), verdict%status)
        call ieee_set_flag([ieee_invalid, ieee_divide_by_zero, ieee_overflow], .false.)
        call system_clock(before, rate)
        if (embedded .and. .not. work%by_cells) then
            call solve_contact(work%workspace, contact, result, verdict%status)
            verdict%result = result%normal
        else
            call set_strip_gap(work%workspace%solver, case%gap, verdict%status)
            if (.not. is_error(verdict%status)) &
                call strip_solve_demand( &
                    work%workspace%solver, normal_compliance(case%material), case%demand_t, &
                    strip_options_t(strips_per_patch=case%methods%strips_per_patch, &
                                    by_cells=work%by_cells), &
                    work%workspace%strips, verdict%result, verdict%status)
        end if
        call system_clock(after)
        verdict%time_us = 1.0e6_wp*real(after - before, wp)/real(rate, wp)
        call report_badness(verdict, check_finite, merge(huge(1.0_wp), 0.0_wp, exception_raised()))
        verdict%strips = work%workspace%strips%n
        if (is_error(verdict%status)) then
            call report_badness(verdict, check_answer, &
                                merge(0.0_wp, huge(1.0_wp), &
                                      may_be_refused(case, verdict%status)))
            return
        end if
        call report_badness(verdict, check_answer, 0.0_wp)
        ! The tangential methods ask for a solved workspace.
        work%workspace%solved_by = normal_strip
        call plant_fault(work%fault, work%workspace%solver%curve, work%workspace%strips, &
                         verdict%result)
    end subroutine solve_case

    !> Is there a reason for an error: a longitudinal term that is not positive somewhere, or
    !> heights below zero, which may leave no positive penetration?
    pure logical function may_be_refused(case, status)
        type(fuzz_case_t), intent(in) :: case
        type(status_t), intent(in) :: status

        may_be_refused = .false.
        if (status%message == '') return
        select case (status%code)
        case (st_no_finite_patch)
            may_be_refused = any(case%gap%inv2r <= 0.0_wp)
        case (st_out_of_range)
            may_be_refused = any(case%gap%h < 0.0_wp)
        end select
    end function may_be_refused

    !> What is estimated of the errors of the solution.
    subroutine estimate(case, workspace, verdict)
        class(contact_case_t), intent(in) :: case
        type(workspace_t), intent(in) :: workspace
        type(verdict_t), intent(inout) :: verdict

        type(normal_errors_t) :: normal_errors
        type(status_t) :: status

        call estimate_strip_errors(workspace%solver%curve, normal_compliance(case%material), &
                             workspace%strips, verdict%result, normal_errors, status)
        if (is_error(status)) return
        verdict%est_err = [normal_errors%est_err_penetration, normal_errors%est_err_pmax, &
                           normal_errors%est_err_area]
        call name_resolution(verdict%est_err(1), verdict%est_err(2), verdict%est_err(3), &
                             default_resolution, verdict%status)
    end subroutine estimate

    logical function exception_raised()
        logical :: invalid, by_zero, overflow

        call ieee_get_flag(ieee_invalid, invalid)
        call ieee_get_flag(ieee_divide_by_zero, by_zero)
        call ieee_get_flag(ieee_overflow, overflow)
        exception_raised = invalid .or. by_zero .or. overflow
    end function exception_raised
end module faststrip_lab_fuzz_run
