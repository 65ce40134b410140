!> What forces on a Hertz ellipse are wrong by because the patch is another one.
!>
!> A method's own estimate (`faststrip_tangential_force_errors`) knows the ellipse it was given.
!> What Hertz does not see of the contact's shape comes on top, from what the gap differs from
!> Hertz's parabola by (`faststrip_normal_estimate_misfit`; e its rise): with
!>
!>     g = (|mean| + magnitude)/e + overlap,  o = |odd|/e,  q = aside,  s(u) = u/(u + 1/4)
!>
!> and linear forces u1, u2, u3 of the ellipse over mu N,
!>
!>     Fx   1.7 (o + 0.2 g + 0.5 q) sqrt(b/a) s(|u|)
!>     Fy   0.25 (g + 0.5 q) max(1, sqrt(b/a)) s(|u|)
!>     Mz   0.65 (g + q) (sqrt(b/a) + 0.3) s(|u|)     about the ellipse's middle
!>
!> A patch that lies beside its ellipse (o), or a second one beside it (q), turns spin into
!> longitudinal creepage, the more the wider it is. The factors bound 95 % of the differences of
!> FASTSTRIP's forces on the ellipse and on 31 strips, of the gaps of
!> `faststrip_normal_estimate_hertz_errors` with six creepages each.
module faststrip_tangential_hertz_errors
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_normal_estimate_misfit, only: misfit_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_patch_law, only: patch_law_t, find_law
    implicit none
    private

    public :: add_hertz_errors

    ! Tuned [1]: Factors of Fx in the module's head. Origin: calibrated, see the module's head.
    real(wp), parameter :: fx_factor = 1.7_wp, fx_any = 0.2_wp
    ! Tuned [1]: Factor of Fy. Origin: calibrated, see the module's head.
    real(wp), parameter :: fy_factor = 0.25_wp
    ! Tuned [1]: Part of q in both. Origin: calibrated, see the module's head.
    real(wp), parameter :: aside_part = 0.5_wp
    ! Tuned [1]: Factors of Mz. Origin: calibrated, see the module's head.
    real(wp), parameter :: mz_factor = 0.65_wp, mz_narrow = 0.3_wp
    ! Tuned [1]: Linear force over mu N at half of the errors. Origin: calibrated, see the module's
    ! head.
    real(wp), parameter :: half_force = 0.25_wp

contains

    !> Add to the errors of forces on a Hertz ellipse what its shape is wrong by.
    pure subroutine add_hertz_errors(hertz, misfit, material, mu, creepage, errors, status)
        type(hertz_t), intent(in) :: hertz       !! the ellipse
        type(misfit_t), intent(in) :: misfit     !! of its gap
        type(material_t), intent(in) :: material !! moduli in MPa
        real(wp), intent(in) :: mu               !! coefficient of friction
        type(creepage_t), intent(in) :: creepage !! about the reference point
        type(force_errors_t), intent(inout) :: errors !! of a method on the ellipse; grow
        type(status_t), intent(inout) :: status  !! that of `kalker_coefficients`

        type(patch_law_t) :: law
        real(wp) :: u(3), any_shape, beside, wide, share, fx, arm

        call find_law(patch_ellipse_t(a=hertz%a, b=hertz%b, y=hertz%y, load=hertz%load), &
                      material, mu, creepage, law, status, u)
        if (is_error(status)) return
        any_shape = (abs(misfit%mean) + misfit%magnitude)/misfit%rise + misfit%overlap
        beside = abs(misfit%odd)/misfit%rise
        wide = sqrt(hertz%b/hertz%a)
        share = norm2(u)/(norm2(u) + half_force)
        fx = fx_factor*(beside + fx_any*any_shape + aside_part*misfit%aside)*wide*share
        errors%fx = errors%fx + fx
        errors%fy = errors%fy + fy_factor*(any_shape + aside_part*misfit%aside) &
                    *max(1.0_wp, wide)*share
        arm = abs(hertz%y)/sqrt(hertz%a*hertz%b)*fx
        errors%arm = errors%arm + arm
        errors%mz = errors%mz + mz_factor*(any_shape + misfit%aside)*(wide + mz_narrow)*share + arm
    end subroutine add_hertz_errors
end module faststrip_tangential_hertz_errors
