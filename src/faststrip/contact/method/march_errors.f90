!> Error estimates of the forces of the core's methods: what those with a march in a patch share,
!> and what all of them leave out.
module faststrip_contact_method_march_errors
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, falls, falls_when_hot, softened
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: material_t
    use faststrip_base_status, only: status_t, is_error, add_limitation, st_under_resolved
    use faststrip_influence_rectangle, only: coupling_constant
    use faststrip_normal_estimate_errors, only: normal_errors_t
    use faststrip_normal_limitations, only: name_force_resolution
    use faststrip_tangential_force_errors, only: estimate_force_errors, errors_of_fastsim
    use faststrip_tangential_motion, only: cut_creepage
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: tangential_method_t, workspace_t, contact_result_t
    use faststrip_contact_method_hertz, only: add_shape_errors
    implicit none
    private

    public :: left_out_t, estimate_march, name_falling_friction

    ! Tuned [1]: Force by the coupling of dissimilar materials, over K N. Origin: a line contact in
    ! free rolling (Bentall and Johnson 1967), linear.
    real(wp), parameter :: force_of_coupling = 3.0_wp
    ! Tuned [1]: The same in full adhesion on ellipses, at most. Origin: TANG, a/b from .1 to 10.
    real(wp), parameter :: force_in_adhesion = 1.6_wp
    ! Tuned [1]: Part of it that a march with the slip by pressures errs by. Origin: TANG, eight
    ! pairs of materials.
    real(wp), parameter :: error_of_pressed = 0.06_wp
    ! Tuned [1]: Force over mu N by what tractions do to pressures, over K mu. Origin: likewise.
    real(wp), parameter :: force_of_goodman = 0.3_wp
    ! Tuned [1]: K/mu up to which the slip by pressures is that of a patch which sticks in part.
    ! Origin: TANG on a circle and an ellipse, mu from .005 to .1.
    real(wp), parameter :: partly_stuck = 0.5_wp
    ! Tuned [1]: Error over mu N by K/mu beyond. Origin: likewise.
    real(wp), parameter :: error_of_sliding = 0.2_wp

    ! Error of a force over mu N where friction varies across the contact, over the standard
    ! deviation of mu by load over its mean: what was fitted to one mu takes the mean.
    ! Tuned [1]. Origin: TANG with steps and ramps of mu on ellipses, a/b .5 to 2.
    real(wp), parameter :: force_of_spread = 0.12_wp

    !> A tangential method of the core: no error is known, unless it says so; what it leaves out is
    !> named.
    type, abstract, extends(tangential_method_t) :: left_out_t
    contains
        procedure :: estimate => name_limits
    end type left_out_t

contains

    !> Name what is left out.
    subroutine name_limits(self, workspace, case, result, status, finer)
        class(left_out_t), intent(in) :: self           !! a method without march
        type(workspace_t), intent(in) :: workspace      !! with its solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(contact_result_t), intent(inout) :: result !! stays as it is
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer         !! see `estimate_force_errors`

        call name_left_out(workspace, left_out(workspace, case), case, status)
    end subroutine name_limits

    !> Error estimates of the forces of a march.
    subroutine estimate_march(workspace, case, march, points, result, status, finer)
        type(workspace_t), intent(in) :: workspace      !! with a normal solution
        type(contact_case_t), intent(in) :: case        !! what was solved
        integer, intent(in) :: march                    !! one of the `errors_of_` numbers
        integer, intent(in) :: points                   !! along a strip or row
        type(contact_result_t), intent(inout) :: result !! its figures; gets their error estimates
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer         !! see `estimate_force_errors`

        type(status_t) :: estimate
        type(material_t) :: material
        type(creepage_t) :: creepage
        real(wp) :: share, left, rest

        left = left_out(workspace, case)
        if (march /= errors_of_fastsim) left = left_by_march(workspace, case)
        call name_left_out(workspace, left, case, status)
        if (falls(workspace%friction)) return
        material = softened(case%material, workspace%friction)
        call cut_creepage(case%creepage, creepage, share)
        associate (errors => result%force_errors)
            if (workspace%is_ellipse) then
                ! Strips of an ellipse are exact; what is wrong with the ellipse is added.
                call estimate_force_errors(workspace%strips, material, workspace%mu, creepage, &
                                           march, points, normal_errors_t(), errors, estimate, &
                                           finer)
                if (.not. is_error(estimate)) &
                    call add_shape_errors(workspace, case, errors, estimate)
            else
                call estimate_force_errors(workspace%strips, material, workspace%mu, creepage, &
                                           march, points, result%normal_errors, errors, &
                                           estimate, finer)
            end if
            result%forces_are_estimated = .not. is_error(estimate)
            if (.not. result%forces_are_estimated) return
            rest = left + force_of_spread*workspace%mu_spread
            errors%fx = errors%fx + rest
            errors%fy = errors%fy + rest
            errors%mz = errors%mz + rest
            call name_force_resolution(errors%fx, errors%fy, errors%mz - errors%arm, &
                                       case%force_limit, status)
        end associate
    end subroutine estimate_march

    !> Name what methods of the core know nothing of: friction that falls has no estimate,
    !> pressures of dissimilar materials do not count.
    pure subroutine name_left_out(workspace, left, case, status)
        type(workspace_t), intent(in) :: workspace !! with its friction
        real(wp), intent(in) :: left               !! by dissimilar materials, over mu N
        type(contact_case_t), intent(in) :: case   !! what was solved
        type(status_t), intent(inout) :: status    !! limitations so far; `st_under_resolved`

        if (falls(workspace%friction)) then
            call name_falling_friction(workspace%friction, status)
        else if (left > case%force_limit) then
            call add_limitation(status, st_under_resolved, 'between dissimilar materials ' &
                                // 'pressures cause slip that only tang takes into account in ' &
                                // 'full')
        end if
    end subroutine name_left_out

    !> What the march leaves out of forces over mu N where materials are dissimilar: a part of what
    !> the slip by pressures does, much of it where that alone makes the patch slide, and all that
    !> tractions do to pressures.
    pure real(wp) function left_by_march(workspace, case) result(error)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case

        associate (k => abs(coupling_constant(case%material)), mu => workspace%mu)
            error = error_of_pressed*min(force_in_adhesion*k, 2.0_wp*mu)/max(mu, tiny(mu)) &
                    + force_of_goodman*k*mu &
                    + error_of_sliding*max(k/max(mu, tiny(mu)) - partly_stuck, 0.0_wp)
            error = min(error, 2.0_wp)
        end associate
    end function left_by_march

    !> What other methods of the core leave out of forces over mu N where materials are dissimilar:
    !> pressures cause slip of a creepage of about 1.25 K p0/G, which makes three times K N of
    !> force; no two forces differ by more than twice mu N.
    pure real(wp) function left_out(workspace, case) result(error)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case

        error = min(force_of_coupling*abs(coupling_constant(case%material)), &
                    2.0_wp*workspace%mu)/max(workspace%mu, tiny(error))
    end function left_out

    !> Name that no error of forces is estimated where friction falls: what the estimates were
    !> calibrated on has constant friction.
    pure subroutine name_falling_friction(friction, status)
        type(friction_t), intent(in) :: friction !! falls
        type(status_t), intent(inout) :: status !! limitations so far; `st_under_resolved`

        call add_limitation(status, st_under_resolved, 'no error of the forces can be ' // &
                            'estimated: friction falls with ' // &
                            trim(merge('temperature', 'slip       ', falls_when_hot(friction))))
    end subroutine name_falling_friction
end module faststrip_contact_method_march_errors
