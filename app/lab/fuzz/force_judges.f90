!> Judges of the creep forces on a normal solution.
!>
!> The creepages of a case are drawn in units of those at which the linear forces reach the bound,
!> from far below to far above.
module faststrip_lab_fuzz_force_judges
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_contact_methods, only: tangential_faststrip, tangential_fastsim, &
                                         tangential_fastsim_elliptic, &
                                         tangential_fastsim_weighted
    use faststrip_contact_solve, only: contact_case_t, workspace_t, solve_contact_tangential
    use faststrip_lab_fuzz_gaps, only: random_t, start_random, log_uniform, chance
    use faststrip_lab_fuzz_judges, only: verdict_t, report_badness, judge_answer, judge_bound, &
                                         judge_moment, judge_power, judge_saturation, &
                                         judge_force_mirror, judge_force_sign
    use faststrip_lab_fuzz_faults, only: plant_force_fault
    implicit none
    private

    public :: judge_forces

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

contains

    !> Judge the forces on the strips of a workspace.
    subroutine judge_forces(seed, number, fault, material, load, workspace, verdict)
        integer, intent(in) :: seed, number            !! of the case
        character(len=*), intent(in) :: fault          !! planted, or blank
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: load                   !! N
        type(workspace_t), intent(inout) :: workspace  !! with a solution; as it was afterwards
        type(verdict_t), intent(inout) :: verdict

        type(random_t) :: random
        type(contact_case_t) :: case
        type(tangential_result_t) :: forces, other
        type(contact_strips_t) :: kept
        real(wp) :: most, most_moment, unit, length, input

        call start_random(seed, number, random)
        associate (strips => workspace%strips)
            length = sqrt(2.0_wp*sum(strips%half_length(:strips%n) &
                                     *(strips%y_right(:strips%n) - strips%y_left(:strips%n))))
            most_moment = mu*sum(0.5_wp*pi*strips%p0(:strips%n)*strips%half_length(:strips%n) &
                                 *(strips%y_right(:strips%n) - strips%y_left(:strips%n)) &
                                 *hypot(strips%half_length(:strips%n), &
                                        max(abs(strips%y_left(:strips%n)), &
                                            abs(strips%y_right(:strips%n)))))
        end associate
        most = mu*load
        unit = most*(1.0_wp + material%nu_rail)/(material%e_rail*length**2)
        case%material = material
        case%mu = mu
        case%methods%tangential = methods(1 + modulo(number/2, size(methods)))
        case%methods%fastsim_nx = 20
        case%methods%fastsim_ny = 20
        case%creepage = creepage_t(draw(unit), draw(unit), draw(unit/length))

        if (.not. found(case, forces)) return
        call report_badness(verdict, judge_bound, hypot(forces%fx, forces%fy) &
                            /(most*(1.0_wp + rounding)))
        call report_badness(verdict, judge_moment, abs(forces%mz)/(arm_factor*most_moment))
        associate (c => case%creepage)
            input = -(forces%fx*c%cksi + forces%fy*c%ceta + forces%mz*c%cphi)
            unit = max(most*(abs(c%cksi) + abs(c%ceta)) + most_moment*abs(c%cphi), &
                       tiny(unit)/rounding)
        end associate
        call report_badness(verdict, judge_power, &
                            max(-input, -forces%friction_power)/(rounding*unit))
        if (case%methods%tangential == tangential_faststrip) &
            call report_badness(verdict, judge_power, abs(input - forces%friction_power) &
                                /(rounding*unit))

        case%creepage = creepage_t(-case%creepage%cksi, -case%creepage%ceta, -case%creepage%cphi)
        if (.not. found(case, other)) return
        call report_badness(verdict, judge_force_sign, max( &
            hypot(forces%fx + other%fx, forces%fy + other%fy)/most, &
            abs(forces%mz + other%mz)/most_moment)/same)

        ! Back to the first signs of ceta and cphi under y -> -y.
        case%creepage%cksi = -case%creepage%cksi
        kept = workspace%strips
        call mirror_strips(kept, workspace%strips)
        if (found(case, other)) &
            call report_badness(verdict, judge_force_mirror, max( &
                hypot(forces%fx - other%fx, forces%fy + other%fy)/most, &
                abs(forces%mz + other%mz)/most_moment)/same)
        workspace%strips = kept

        unit = most*(1.0_wp + material%nu_rail)/(material%e_rail*length**2)
        case%creepage = creepage_t(min(large*unit*slenderness(workspace%strips), &
                                       largest_creepage), 0.0_wp, 0.0_wp)
        if (.not. found(case, other)) return
        call report_badness(verdict, judge_saturation, abs(other%fx + most)/(saturated*most))

    contains

        !> The forces of a case, with what is planted.
        logical function found(asked, answer)
            type(contact_case_t), intent(in) :: asked
            type(tangential_result_t), intent(out) :: answer

            type(status_t) :: status

            call solve_contact_tangential(workspace, asked, answer, status)
            found = .not. is_error(status)
            if (.not. found) call report_badness(verdict, judge_answer, huge(1.0_wp))
            call plant_force_fault(fault, answer)
        end function found

        !> A creepage about its unit, or none.
        real(wp) function draw(about)
            real(wp), intent(in) :: about

            draw = about*log_uniform(random, 0.03_wp, 30.0_wp)
            if (chance(random, 0.5_wp)) draw = -draw
            if (chance(random, 0.25_wp)) draw = 0.0_wp
        end function draw
    end subroutine judge_forces

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
end module faststrip_lab_fuzz_force_judges
