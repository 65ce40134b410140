!> The family of a table that is there, ready to solve what the table is judged by.
module faststrip_command_lookup_family
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_command_lookup_case, only: read_wheel_case
    use faststrip_command_program_console, only: fail_on_error, note, progress
    use faststrip_command_program_options, only: command_t, option_text
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel
    use faststrip_tabulate_family, only: family_t
    use faststrip_tabulate_forces, only: choice_t
    use faststrip_tabulate_hertz, only: hertz_family_t, make_hertz_family, release_hertz_family
    use faststrip_tabulate_wheel, only: wheel_family_t, wheel_limits_t, make_wheel_family, &
                                        release_wheel_family
    use faststrip_wheelset_types, only: wheelset_model_t
    implicit none
    private

    public :: families_t, make_family, release_family

    !> One of them is ready.
    type :: families_t
        type(hertz_family_t) :: hertz
        type(wheel_family_t) :: wheel
    end type families_t

contains

    !> Make the family of a table; ends the program if that fails.
    subroutine make_family(command, choice, threads, lookup, families, family)
        type(command_t), intent(in) :: command      !! parsed; with `--case` for a wheel
        type(choice_t), intent(in) :: choice        !! how forces are solved
        integer, intent(in) :: threads              !! that solve
        type(lookup_t), intent(in) :: lookup        !! the table
        type(families_t), intent(inout), target :: families  !! for `release_family`
        class(family_t), pointer, intent(out) :: family      !! the one of them

        type(wheelset_model_t) :: model
        type(status_t) :: status

        if (lookup%kind == lookup_kind_wheel) then
            call read_wheel_case(option_text(command, '--case', ''), model)
            call make_wheel_family(model, choice, threads, wheel_limits_t(), families%wheel, status)
            family => families%wheel
        else
            call make_hertz_family(choice, threads, [0.0_wp, 0.0_wp], families%hertz, status)
            family => families%hertz
        end if
        call fail_on_error(status)
        family%progress => progress
        family%note => note
    end subroutine make_family

    !> Give back what the families have.
    subroutine release_family(families)
        type(families_t), intent(inout) :: families !! serve no more

        call release_hertz_family(families%hertz)
        call release_wheel_family(families%wheel)
    end subroutine release_family
end module faststrip_command_lookup_family
