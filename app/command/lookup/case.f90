!> The wheel and the rail of a lookup table, as a case file tells them.
module faststrip_command_lookup_case
    use faststrip_base_friction, only: falls
    use faststrip_base_kinds, only: wp
    use faststrip_command_settings_case_file, only: read_bodies_of
    use faststrip_command_settings_profiles, only: bodies_t
    use faststrip_command_program_console, only: fail, exit_bad_input
    use faststrip_command_wheelset_case, only: wheelset_case_t, read_wheelset_case, make_model
    use faststrip_wheelset_types, only: wheelset_model_t
    implicit none
    private

    public :: read_wheel_case, wheel_text

contains

    !> The wheel and the rail of a case; ends the program with a line where there is something that
    !> a table cannot hold.
    subroutine read_wheel_case(path, model)
        character(len=*), intent(in) :: path           !! name of the `.nml` file
        type(wheelset_model_t), intent(inout) :: model !! made

        type(wheelset_case_t) :: case

        call read_wheelset_case(path, case, for_table=.true.)
        call make_model(path, case, model)
        if (case%has_state) call fail(exit_bad_input, 'a lookup table is of all states: &state ' &
                                      // 'must not be given (' // path // ')')
        if (case%bodies%track%roller_radius > 0.0_wp) &
            call fail(exit_bad_input, 'a lookup table is for rails: &rail roller_radius_mm must ' &
                      // 'not be given (' // path // ')')
        if (case%curved) call fail(exit_bad_input, 'a lookup table has no contacts on a curved ' &
            // 'surface: curved must not be given (' // path // ')')
        if (case%asked%temperatures) call fail(exit_bad_input, 'a lookup table has no ' &
            // 'temperatures: &thermal must not be given (' // path // ')')
        if (falls(case%friction) .or. case%friction%slope_factor < 1.0_wp .or. &
            abs(case%friction%flange_share - 1.0_wp) > 0.0_wp .or. &
            case%friction%table%n > 0) &
            call fail(exit_bad_input, 'a lookup table is for Coulomb friction of one number (' &
                      // path // ')')
    end subroutine read_wheel_case

    !> Which wheel on which rail, in a line.
    function wheel_text(path) result(text)
        character(len=*), intent(in) :: path !! name of the `.nml` file
        character(len=:), allocatable :: text

        type(bodies_t) :: bodies

        call read_bodies_of(path, bodies)
        text = 'right wheel ' // bodies%wheel%name // ' on rail ' // bodies%rail%name &
               // new_line('a')
    end function wheel_text
end module faststrip_command_lookup_case
