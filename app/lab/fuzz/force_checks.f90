!> Checks of the creep forces on a normal solution.
!>
!> The creepages of a case are drawn in units of those at which the linear forces reach the bound,
!> from far below to far above.
module faststrip_lab_fuzz_force_checks
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_contact_methods, only: tangential_faststrip, tangential_fastsim, &
                                         tangential_fastsim_elliptic, &
                                         tangential_fastsim_weighted
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_lab_random_gaps, only: fuzz_case_t
    use faststrip_lab_random_numbers, only: random_t, start_random, log_uniform, chance
    use faststrip_lab_fuzz_checks, only: verdict_t, report_badness, check_answer, check_bound, &
                                         check_moment, check_power, check_saturation, &
                                         check_force_mirror, check_force_sign
    use faststrip_lab_fuzz_faults, only: plant_force_fault
    implicit none
    private

    public :: check_forces

    !> All that are bounded by mu N.
    integer, parameter :: methods(6) = [tangential_faststrip, tangential_fastsim, &
                                        tangential_faststrip, tangential_fastsim_elliptic, &
                                        tangential_faststrip, tangential_fastsim_weighted]

    real(wp), parameter :: mu = 0.3_wp
    real(wp), parameter :: rounding = 1.0e-9_wp
    real(wp), parameter :: same = 1.0e-12_wp         ! of mu N, and of mu N times the lengths
    real(wp), parameter :: saturated = 0.02_wp       ! less than mu N by so much
    real(wp), parameter :: large = 1.0e3_wp          ! of the creepage at which forces reach mu N
    real(wp), parameter :: largest_creepage = 1.0e5_wp
    real(wp), parameter :: arm_factor = 1.25_wp      ! virtual ellipses are longer than their strips

    !> What forces and creepages of a case are measured in.
    type :: scales_t
        real(wp) :: force = 0.0_wp    ! mu N, N
        real(wp) :: moment = 0.0_wp   ! of mu p at the rim, N mm
        real(wp) :: length = 0.0_wp   ! square root of the area, mm
        real(wp) :: creepage = 0.0_wp ! at which linear forces reach mu N
    end type scales_t

contains

    !> Check the forces on the strips of a workspace.
    subroutine check_forces(seed, case, fault, workspace, verdict)
        integer, intent(in) :: seed                    !! of the series
        type(fuzz_case_t), intent(in) :: case          !! number, moduli, load
        character(len=*), intent(in) :: fault          !! planted, or blank
        type(workspace_t), intent(inout) :: workspace  !! with a solution; as it was afterwards
        type(verdict_t), intent(inout) :: verdict

        type(scales_t) :: scales
        type(contact_case_t) :: asked
        type(tangential_result_t) :: forces, other
        type(contact_strips_t) :: kept

        scales = scales_of(case, workspace%strips)
        asked = case%contact_case_t
        asked%mu = mu
        asked%estimate = .false.
        asked%methods%tangential = methods(1 + modulo(case%number/2, size(methods)))
        asked%methods%fastsim_nx = 20
        asked%methods%fastsim_ny = 20
        call draw_creepage(seed, case%number, scales, asked%creepage)
        if (.not. found(asked, forces)) return
        call report_badness(verdict, check_bound, hypot(forces%fx, forces%fy) &
                            /(scales%force*(1.0_wp + rounding)))
        call report_badness(verdict, check_moment, abs(forces%mz)/(arm_factor*scales%moment))
        call check_dissipation(asked, forces, scales, verdict)

        asked%creepage = creepage_t(-asked%creepage%cksi, -asked%creepage%ceta, &
                                    -asked%creepage%cphi)
        if (.not. found(asked, other)) return
        call report_badness(verdict, check_force_sign, max( &
            hypot(forces%fx + other%fx, forces%fy + other%fy)/scales%force, &
            abs(forces%mz + other%mz)/scales%moment)/same)

        ! Back to the first signs of ceta and cphi under y -> -y.
        asked%creepage%cksi = -asked%creepage%cksi
        kept = workspace%strips
        call mirror_strips(kept, workspace%strips)
        if (found(asked, other)) &
            call report_badness(verdict, check_force_mirror, max( &
                hypot(forces%fx - other%fx, forces%fy + other%fy)/scales%force, &
                abs(forces%mz + other%mz)/scales%moment)/same)
        workspace%strips = kept

        asked%creepage = creepage_t(min(large*scales%creepage*slenderness(workspace%strips), &
                                        largest_creepage), 0.0_wp, 0.0_wp)
        if (.not. found(asked, other)) return
        call report_badness(verdict, check_saturation, &
                            abs(other%fx + scales%force)/(saturated*scales%force))

    contains

        !> The forces of a case, with what is planted.
        logical function found(asked, answer)
            type(contact_case_t), intent(in) :: asked
            type(tangential_result_t), intent(out) :: answer

            type(contact_result_t) :: result
            type(status_t) :: status

            call solve_contact_forces(workspace, asked, result, status)
            answer = result%tangential
            found = .not. is_error(status)
            if (.not. found) call report_badness(verdict, check_answer, huge(1.0_wp))
            call plant_force_fault(fault, answer)
        end function found
    end subroutine check_forces

    !> The scales of a case on its strips.
    pure type(scales_t) function scales_of(case, strips) result(scales)
        class(contact_case_t), intent(in) :: case
        type(contact_strips_t), intent(in) :: strips

        associate (n => strips%n)
            scales%length = sqrt(2.0_wp*sum(strips%half_length(:n) &
                                            *(strips%y_right(:n) - strips%y_left(:n))))
            scales%moment = mu*sum(0.5_wp*pi*strips%p0(:n)*strips%half_length(:n) &
                                   *(strips%y_right(:n) - strips%y_left(:n)) &
                                   *hypot(strips%half_length(:n), &
                                          max(abs(strips%y_left(:n)), abs(strips%y_right(:n)))))
        end associate
        scales%force = mu*case%load
        scales%creepage = scales%force*(1.0_wp + case%material%nu_rail) &
                          /(case%material%e_rail*scales%length**2)
    end function scales_of

    !> Creepages about their scales, of either sign; a quarter of them vanish.
    subroutine draw_creepage(seed, number, scales, creepage)
        integer, intent(in) :: seed, number ! of the case
        type(scales_t), intent(in) :: scales
        type(creepage_t), intent(out) :: creepage

        type(random_t) :: random

        call start_random(seed, number, random)
        creepage = creepage_t(draw(scales%creepage), draw(scales%creepage), &
                              draw(scales%creepage/scales%length))

    contains

        real(wp) function draw(about)
            real(wp), intent(in) :: about

            draw = about*log_uniform(random, 0.03_wp, 30.0_wp)
            if (chance(random, 0.5_wp)) draw = -draw
            if (chance(random, 0.25_wp)) draw = 0.0_wp
        end function draw
    end subroutine draw_creepage

    !> The forces take power out, and FASTSTRIP's friction power is just that.
    pure subroutine check_dissipation(asked, forces, scales, verdict)
        type(contact_case_t), intent(in) :: asked
        type(tangential_result_t), intent(in) :: forces
        type(scales_t), intent(in) :: scales
        type(verdict_t), intent(inout) :: verdict

        real(wp) :: input, unit

        associate (c => asked%creepage)
            input = -(forces%fx*c%cksi + forces%fy*c%ceta + forces%mz*c%cphi)
            unit = max(scales%force*(abs(c%cksi) + abs(c%ceta)) + scales%moment*abs(c%cphi), &
                       tiny(unit)/rounding)
        end associate
        call report_badness(verdict, check_power, &
                            max(-input, -forces%friction_power)/(rounding*unit))
        if (asked%methods%tangential == tangential_faststrip) &
            call report_badness(verdict, check_power, abs(input - forces%friction_power) &
                                /(rounding*unit))
    end subroutine check_dissipation

    !> Length over width of the slimmest strip's patch or the reverse, at least one: slim patches
    !> are soft.
    pure real(wp) function slenderness(strips)
        type(contact_strips_t), intent(in) :: strips

        real(wp) :: ratio

        associate (n => strips%n)
            ratio = 2.0_wp*maxval(strips%half_length(:n))/(strips%y_right(n) - strips%y_left(1))
        end associate
        slenderness = max(ratio, 1.0_wp/ratio)
    end function slenderness

    !> Strips seen in a mirror.
    pure subroutine mirror_strips(strips, mirrored)
        type(contact_strips_t), intent(in) :: strips
        type(contact_strips_t), intent(inout) :: mirrored

        associate (n => strips%n)
            mirrored%y_left(:n) = -strips%y_right(n:1:-1)
            mirrored%y_right(:n) = -strips%y_left(n:1:-1)
            mirrored%p0(:n) = strips%p0(n:1:-1)
            mirrored%half_length(:n) = strips%half_length(n:1:-1)
            mirrored%patch(:n) = strips%n_patches + 1 - strips%patch(n:1:-1)
        end associate
    end subroutine mirror_strips
end module faststrip_lab_fuzz_force_checks
