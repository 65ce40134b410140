!> `--normal auto`: the cheapest methods that are expected to meet the user's tolerance.
module faststrip_command_auto_stage
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, st_target_missed
    use faststrip_base_text, only: integer_text
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: contact_methods_t, normal_method_name, &
                                         tangential_method_name, normal_strip, normal_hertz, &
                                         normal_norm, tangential_fastsim, tangential_none, &
                                         tangential_tang, gives_elements
    use faststrip_contact_indicators, only: indicators_t, find_indicators
    use faststrip_contact_choice, only: choose_methods, target_forces, target_pmax, &
                                        target_penetration
    use faststrip_kalker_tangential, only: are_alike
    use faststrip_command_methods, only: numerics_t, targets
    implicit none
    private

    public :: choose

    ! Elements across the patch where only Kalker's method is good enough.
    real(wp), parameter :: elements_across = 30.0_wp

contains

    !> Choose; `words` say what and why.
    subroutine choose(numerics, case, curve, with_field, chosen, words, status)
        type(numerics_t), intent(in) :: numerics  !! normal method auto, target and tolerance
        type(contact_case_t), intent(in) :: case  !! checked
        type(gap_curve_t), intent(in) :: curve    !! its gap
        logical, intent(in) :: with_field         !! are elements wanted?
        type(numerics_t), intent(out) :: chosen    !! by name
        character(len=:), allocatable, intent(out) :: words !! for the CSV
        type(status_t), intent(out) :: status
            !! of the library; `st_target_missed` where even Kalker's methods cannot help

        integer, parameter :: numbers(3) = [target_forces, target_pmax, target_penetration]
        type(indicators_t) :: indicators
        type(contact_methods_t) :: core
        real(wp) :: expected
        integer :: target

        words = ''
        call find_indicators(curve, case, indicators, status)
        if (is_error(status)) return
        target = findloc(targets == numerics%target, .true., dim=1)
        call choose_methods(indicators, numbers(target), numerics%tolerance, core, expected, status)
        if (is_error(status)) return
        if (with_field .and. .not. gives_elements(core%tangential)) &
            core%tangential = tangential_fastsim
        chosen = numerics
        chosen%contact_methods_t = core
        if (status%code == st_target_missed .and. numerics%target == targets(1) .and. &
            .not. are_alike(case%material)) then
            words = 'the best there is for unlike materials, expected within ' // percent(expected)
        else if (status%code == st_target_missed) then
            status = status_t()
            call take_kalker(numerics, indicators, chosen)
            words = 'nothing cheaper is expected to be within ' // percent(numerics%tolerance)
        else
            words = 'expected within ' // percent(expected)
        end if
        words = what(chosen) // ': ' // words // ' (misfit ' // short(indicators%misfit) &
                // ', saturation ' // short(indicators%saturation) // ', share of spin ' &
                // short(indicators%spin_share) // ')'
    end subroutine choose

    !> Kalker's variational methods, as fine as the target asks.
    subroutine take_kalker(numerics, indicators, chosen)
        type(numerics_t), intent(in) :: numerics
        type(indicators_t), intent(in) :: indicators
        type(numerics_t), intent(inout) :: chosen

        chosen%normal = normal_norm
        if (numerics%target /= targets(1)) then
            chosen%error_target = numerics%tolerance
            return
        end if
        chosen%tangential = tangential_tang
        chosen%element_dx = 2.0_wp*indicators%a/elements_across
        chosen%element_dy = 2.0_wp*indicators%b/elements_across
    end subroutine take_kalker

    !> Methods and resolutions in words.
    function what(methods) result(text)
        class(contact_methods_t), intent(in) :: methods
        character(len=:), allocatable :: text, tangential

        text = trim(normal_method_name(methods%normal))
        if (methods%normal == normal_strip) &
            text = text // ' ' // integer_text(methods%strips_per_patch)
        if (methods%tangential == tangential_none) return
        tangential = trim(tangential_method_name(methods%tangential))
        text = text // ' + ' // tangential
        if (index(tangential, 'faststrip') == 1) then
            if (methods%normal == normal_hertz) &
                text = text // ' ' // integer_text(methods%strips_per_patch)
            text = text // ' x ' // integer_text(methods%points_per_strip)
        else if (index(tangential, 'fastsim') == 1) then
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
