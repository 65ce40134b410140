!> A coefficient table checked row by row: the error of a row and its place, how far it is from a
!> fresh fit of its degree, and whether one wrong coefficient would explain that.
!>
!> With d(L) the row less the fresh fit, in E, the least-squares change of coefficient k alone is
!> `delta_k = <d, phi_k>/<phi_k, phi_k>` over the nodes of the fit, and it explains the share
!> `<d, phi_k>^2/(<phi_k, phi_k><d, d>)` of the sum of squares. The coefficient with the largest
!> share is named. A row made by the same kind of fit and then misprinted has a share of 1: from
!> 0.999 on a misprint is called demonstrable. It is not where d is below one hundredth of the
!> fit's own error (coefficients rounded to few digits), nor below degree 2 (one or two
!> coefficients explain anything).
module faststrip_tables_audit
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_tables_polynomials, only: basis_matrix
    use faststrip_tables_refit, only: refit_t, refit_plan_t, table_row_t, prepare_refit, &
                                      refit_row, measure_row, check_row, row_relative_error
    implicit none
    private

    public :: audit_t, audit_row

    !> Share of the difference that one coefficient has to explain.
    real(wp), parameter :: misprint_share = 0.999_wp

    !> Findings about one row; relative errors are of 10**E against the exact integral.
    type :: audit_t
        type(table_row_t) :: row                !! the row with its errors
        type(table_row_t) :: fresh              !! the fresh fit with its errors
        real(wp) :: condition = 0.0_wp          !! of the fresh fit
        real(wp) :: residual_max = 0.0_wp       !! largest |E - fresh E| over the nodes
        real(wp) :: residual_rms = 0.0_wp       !! root mean square of it
        real(wp) :: coefficient_max = 0.0_wp    !! largest |c_k - fresh c_k|
        integer :: suspect = -1                 !! the k whose change explains most; -1: no residual
        real(wp) :: change = 0.0_wp             !! c_k less what it should be
        real(wp) :: share = 0.0_wp              !! of the sum of squares, 0 to 1
        real(wp) :: corrected_max = 0.0_wp      !! largest relative error without the change
        logical :: misprint = .false.           !! is a misprint of c_k demonstrable?
        real(wp) :: below = 0.0_wp              !! relative error one decade of b below the range
        real(wp) :: above = 0.0_wp              !! relative error one decade above it
    end type audit_t

contains

    !> Audit one row against a fresh fit.
    pure subroutine audit_row(row, fit, audit, status)
        type(table_row_t), intent(in) :: row    !! its errors need not be filled in
        integer, intent(in) :: fit              !! kind of the fresh fit, `fit_lsq` and so on
        type(audit_t), intent(out) :: audit     !! findings
        type(status_t), intent(out) :: status   !! of `check_row`, `prepare_refit`, `refit_row`

        type(refit_plan_t) :: plan
        type(table_row_t) :: corrected

        call check_row(row, status)
        if (is_error(status)) return
        audit%row = row
        call measure_row(audit%row)
        audit%below = row_relative_error(row, row%l_min - 1.0_wp)
        audit%above = row_relative_error(row, row%l_max + 1.0_wp)
        call prepare_refit(refit_t(row%l_min, row%l_max, row%degree, row%basis, fit, row%half), &
                           plan, status)
        audit%condition = plan%condition
        if (is_error(status)) return
        call refit_row(plan, row%n, audit%fresh, status)
        if (is_error(status)) return
        call find_suspect(plan, audit)
        corrected = audit%row
        if (audit%suspect >= 0) &
            corrected%c(audit%suspect) = corrected%c(audit%suspect) - audit%change
        call measure_row(corrected)
        audit%corrected_max = corrected%max_rel_err
    end subroutine audit_row

    pure subroutine find_suspect(plan, audit)
        type(refit_plan_t), intent(in) :: plan
        type(audit_t), intent(inout) :: audit

        real(wp), parameter :: log10_e = 0.434294481903251827651128918916605082_wp
        real(wp), allocatable :: basis(:, :), d(:)
        real(wp) :: square, along, share
        integer :: k, degree

        degree = audit%row%degree
        allocate (basis(size(plan%l), 0:degree))
        call basis_matrix(audit%row%basis, audit%row%l_min, audit%row%l_max, plan%l, basis)
        d = matmul(basis, audit%row%c(:degree) - audit%fresh%c(:degree))
        audit%coefficient_max = maxval(abs(audit%row%c(:degree) - audit%fresh%c(:degree)))
        audit%residual_max = maxval(abs(d))
        audit%residual_rms = norm2(d)/sqrt(real(size(d), wp))
        if (audit%residual_max <= 1.0e3_wp*epsilon(1.0_wp)*maxval(abs(audit%row%c(:degree)))) return
        do k = 0, degree
            square = dot_product(basis(:, k), basis(:, k))
            along = dot_product(basis(:, k), d)
            if (.not. square > 0.0_wp) cycle
            share = min(1.0_wp, (along/square)*(along/dot_product(d, d)))
            if (share <= audit%share) cycle
            audit%share = share
            audit%suspect = k
            audit%change = along/square
        end do
        audit%misprint = degree >= 2 .and. audit%share >= misprint_share .and. &
                         audit%residual_max > 0.01_wp*log10_e*audit%fresh%max_rel_err
    end subroutine find_suspect
end module faststrip_tables_audit
