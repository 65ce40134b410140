!> T gamma, wear and fatigue of the last solution behind a handle of the C and F77 interfaces.
!>
!> They are figures of what was solved, with its creepages and its friction; a law of wear and the
!> yield stress come with each question.
module faststrip_interop_wear
    use, intrinsic :: iso_c_binding, only: c_double
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_methods, only: tangential_none, tangential_faststrip, &
                                         tangential_faststrip_plain, tangential_method_name
    use faststrip_contact_wear, only: find_wear
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_tangential_wear_law, only: wear_law_t, wear_t, check_wear_law, most_regimes, &
                                             find_strip_wear
    use faststrip_tangential_wear_numbers, only: strip_power_densities
    implicit none
    private

    public :: n_regime, n_wear, contact_wear, contact_strip_wear

    !> Numbers of a regime, and of the figures.
    !> Given: lengths of the lists below.
    integer, parameter :: n_regime = 4, n_wear = 6

contains

    !> The figures of a contact.
    subroutine contact_wear(workspace, result, creepage, regimes, density, yield_shear, figures, &
                            status)
        type(workspace_t), intent(inout) :: workspace   !! with the solution; gets wear of strips
        type(contact_result_t), intent(inout) :: result !! of the solution; gets its wear
        type(creepage_t), intent(in) :: creepage        !! that it was solved with
        real(c_double), intent(in) :: regimes(:, :)     !! of the law, as `fill_law`; none: no law
        real(c_double), intent(in) :: density           !! of what is worn, kg/m^3
        real(c_double), intent(in) :: yield_shear       !! in cyclic shear, MPa; 0: not known
        real(c_double), intent(out) :: figures(n_wear)
            !! T gamma, with spin, N; T gamma over the area, N/mm^2; fatigue index; wear, ug and
            !! mm^3 per metre rolled; 0 without a law; zeros on an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; those of `check_wear_law`, `find_strip_wear`

        type(environment_t) :: environment
        type(contact_case_t) :: case

        call hold_environment(environment)
        figures = 0.0_c_double
        result%creepage = creepage
        case%yield_shear = yield_shear
        call check_forces(workspace, result, status)
        if (.not. is_error(status)) call fill_law(regimes, density, case%wear_law, status)
        if (.not. is_error(status) .and. case%wear_law%n > 0) &
            call check_strip_forces(workspace, status)
        if (.not. is_error(status) .and. &
            .not. (yield_shear >= 0.0_c_double .and. ieee_is_finite(yield_shear))) &
            call set_status(status, st_bad_argument, 'the yield stress in shear must not be ' // &
                            'negative, got ' // trim(number_text(yield_shear)) // ' MPa')
        if (.not. is_error(status)) then
            call find_wear(workspace, case, result)
            status = workspace%wear_status
        end if
        if (.not. is_error(status)) then
            associate (found => result%wear)
                figures = [found%t_gamma, found%t_gamma_spin, found%t_gamma_per_area, &
                           merge(found%fatigue_index, 0.0_wp, found%knows_fatigue), &
                           merge(found%wear%mass, 0.0_wp, found%knows_wear), &
                           merge(found%wear%volume, 0.0_wp, found%knows_wear)]
            end associate
        end if
        call restore_environment(environment)
    end subroutine contact_wear

    !> Wear of a contact's strips; without a law their T gamma/A alone, and zeros.
    subroutine contact_strip_wear(workspace, result, regimes, density, status)
        type(workspace_t), intent(inout) :: workspace !! with the solution; gets wear of strips
        type(contact_result_t), intent(in) :: result  !! of the solution
        real(c_double), intent(in) :: regimes(:, :)   !! of the law, as `fill_law`; none: no law
        real(c_double), intent(in) :: density         !! of what is worn, kg/m^3
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; those of `check_wear_law`, `find_strip_wear`

        type(environment_t) :: environment
        type(wear_law_t) :: law
        type(wear_t) :: ignored

        call hold_environment(environment)
        call check_forces(workspace, result, status)
        if (.not. is_error(status)) call fill_law(regimes, density, law, status)
        if (.not. is_error(status)) call check_strip_forces(workspace, status)
        associate (strips => workspace%strips, forces => workspace%strip_forces, &
                   wear => workspace%strip_wear)
            if (is_error(status)) then
                continue
            else if (law%n > 0) then
                call find_strip_wear(law, strips, forces, wear%t_gamma_per_area, wear%mass, &
                                     wear%pass_depth, ignored, status)
            else
                wear%mass = 0.0_wp
                wear%pass_depth = 0.0_wp
                call strip_power_densities(strips, forces, wear%t_gamma_per_area, status)
            end if
        end associate
        call restore_environment(environment)
    end subroutine contact_strip_wear

    ! A law of regimes; without regimes there is none. A regime is T gamma/A where it begins and
    ! ends, N/mm^2; constant, ug/(m mm^2), and slope, ug/(m N), of the wear rate.
    pure subroutine fill_law(regimes, density, law, status)
        real(c_double), intent(in) :: regimes(:, :)
        real(c_double), intent(in) :: density
        type(wear_law_t), intent(inout) :: law
        type(status_t), intent(out) :: status

        integer :: i, n

        call clear_status(status)
        n = size(regimes, 2)
        law%n = n
        law%density = density
        if (n == 0) return
        do i = 1, min(n, most_regimes)
            law%from(i) = regimes(1, i)
            law%to(i) = regimes(2, i)
            law%constant(i) = regimes(3, i)
            law%slope(i) = regimes(4, i)
        end do
        call check_wear_law(law, status)
    end subroutine fill_law

    ! Refuse what there is no wear of: no contact, or one without creep forces.
    pure subroutine check_forces(workspace, result, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_result_t), intent(in) :: result
        type(status_t), intent(out) :: status

        call clear_status(status)
        if (.not. result%normal%area > 0.0_wp) then
            call set_status(status, st_bad_argument, 'there is no contact that was solved')
        else if (workspace%methods%tangential == tangential_none) then
            call set_status(status, st_bad_argument, 'there is no wear without creep forces: ' // &
                            'the tangential method is none')
        end if
    end subroutine check_forces

    ! Refuse methods that do not sum forces over strips.
    pure subroutine check_strip_forces(workspace, status)
        type(workspace_t), intent(in) :: workspace
        type(status_t), intent(inout) :: status

        associate (tangential => workspace%methods%tangential)
            if (all(tangential /= [tangential_faststrip, tangential_faststrip_plain])) &
                call set_status(status, st_bad_argument, 'forces of strips, and wear by a law, ' &
                                // 'need the tangential method faststrip or faststrip-plain, got ' &
                                // tangential_method_name(tangential))
        end associate
    end subroutine check_strip_forces
end module faststrip_interop_wear
