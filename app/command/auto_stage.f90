!> `--normal auto`: the cheapest methods that are expected to meet the user's tolerance.
module faststrip_command_auto_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_target_missed
    use faststrip_base_text, only: integer_text
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: contact_methods_t, normal_method_name, &
                                         tangential_method_name, tangential_fastsim, &
                                         gives_elements
    use faststrip_contact_indicators, only: indicators_t, find_indicators
    use faststrip_contact_choice, only: choose_methods, target_forces, target_pmax, &
                                        target_penetration
    use faststrip_kalker_tangential, only: are_alike
    use faststrip_command_methods, only: methods_t, targets
    use faststrip_command_normal_stage, only: demand_t
    implicit none
    private

    public :: choose

    ! Elements across the patch where only Kalker's method is good enough.
    real(wp), parameter :: elements_across = 30.0_wp

contains

    !> Choose; `words` say what and why.
    subroutine choose(methods, gap, material, mu, demand, creepage, with_field, chosen, words, &
                      status)
        type(methods_t), intent(in) :: methods    !! normal method auto, target and tolerance
        type(gap_t), intent(in) :: gap            !! undeformed gap, mm
        type(material_t), intent(in) :: material  !! moduli, MPa, checked
        real(wp), intent(in) :: mu                !! coefficient of friction
        type(demand_t), intent(in) :: demand      !! load or penetration
        type(creepage_t), intent(in) :: creepage  !! about y = 0
        logical, intent(in) :: with_field         !! are elements wanted?
        type(methods_t), intent(out) :: chosen    !! by name
        character(len=:), allocatable, intent(out) :: words !! for the CSV
        type(status_t), intent(out) :: status
            !! of the library; `st_target_missed` where even Kalker's methods cannot help

        integer, parameter :: numbers(3) = [target_forces, target_pmax, target_penetration]
        type(gap_curve_t) :: curve
        type(contact_case_t) :: case
        type(indicators_t) :: indicators
        type(contact_methods_t) :: core
        real(wp) :: expected
        integer :: target

        words = ''
        call reserve_gap_curve(curve, size(gap%y), status)
        if (is_error(status)) return
        call set_gap_curve(curve, gap, status)
        if (is_error(status)) return
        case%demand_t = demand
        case%material = material
        case%mu = mu
        case%creepage = creepage
        call find_indicators(curve, case, indicators, status)
        if (is_error(status)) return
        target = findloc(targets == methods%target, .true., dim=1)
        call choose_methods(indicators, numbers(target), methods%tolerance, core, expected, status)
        if (is_error(status)) return
        if (with_field .and. .not. gives_elements(core%tangential)) &
            core%tangential = tangential_fastsim
        chosen = methods
        chosen%normal = normal_method_name(core%normal)
        chosen%tangential = tangential_method_name(core%tangential)
        chosen%strips_per_patch = core%strips_per_patch
        chosen%points_per_strip = core%points_per_strip
        chosen%fastsim_nx = core%fastsim_nx
        chosen%fastsim_ny = core%fastsim_ny
        if (status%code == st_target_missed .and. methods%target == targets(1) .and. &
            .not. are_alike(material)) then
            words = 'the best there is for unlike materials, expected within ' // percent(expected)
        else if (status%code == st_target_missed) then
            status = status_t()
            call take_kalker(methods, indicators, chosen)
            words = 'nothing cheaper is expected to be within ' // percent(methods%tolerance)
        else
            words = 'expected within ' // percent(expected)
        end if
        words = what(chosen) // ': ' // words // ' (misfit ' // short(indicators%misfit) &
                // ', saturation ' // short(indicators%saturation) // ', share of spin ' &
                // short(indicators%spin_share) // ')'
    end subroutine choose

    !> Kalker's variational methods, as fine as the target asks.
    subroutine take_kalker(methods, indicators, chosen)
        type(methods_t), intent(in) :: methods
        type(indicators_t), intent(in) :: indicators
        type(methods_t), intent(inout) :: chosen

        chosen%normal = 'norm'
        if (methods%target /= targets(1)) then
            chosen%error_target = methods%tolerance
            return
        end if
        chosen%tangential = 'tang'
        chosen%element_dx = 2.0_wp*indicators%a/elements_across
        chosen%element_dy = 2.0_wp*indicators%b/elements_across
    end subroutine take_kalker

    !> Methods and resolutions in words.
    function what(methods) result(text)
        type(methods_t), intent(in) :: methods
        character(len=:), allocatable :: text

        text = trim(methods%normal)
        if (text == 'strip') text = text // ' ' // integer_text(methods%strips_per_patch)
        if (methods%tangential == 'none') return
        text = text // ' + ' // trim(methods%tangential)
        if (index(methods%tangential, 'faststrip') == 1) then
            if (methods%normal == 'hertz') &
                text = text // ' ' // integer_text(methods%strips_per_patch)
            text = text // ' x ' // integer_text(methods%points_per_strip)
        else if (index(methods%tangential, 'fastsim') == 1) then
            text = text // ' ' // integer_text(methods%fastsim_nx) // ' x ' &
                   // integer_text(methods%fastsim_ny)
        end if
    end function what

    function percent(value) result(text)
        real(wp), intent(in) :: value
        character(len=:), allocatable :: text

        text = short(100.0_wp*value) // ' %'
    end function percent

    function short(value) result(text)
        real(wp), intent(in) :: value
        character(len=:), allocatable :: text

        character(len=16) :: buffer

        write (buffer, '(g0.3)') value
        text = trim(adjustl(buffer))
    end function short
end module faststrip_command_auto_stage
