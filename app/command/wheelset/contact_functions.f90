!> The contact geometry of the wheelset of a case over its lateral shift.
module faststrip_command_wheelset_contact_functions
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, number_text, st_no_contact
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cells, end_row
    use faststrip_geometry_contact_functions, only: side_t, contact_functions_t, &
                                                    find_contact_functions
    use faststrip_geometry_rigid_contact, only: rigid_contact_t
    use faststrip_command_settings_profiles, only: bodies_t
    use faststrip_command_program_console, only: fail_on_error, begin_table, end_table
    implicit none
    private

    public :: tabulate_functions, write_functions, put_wheelset

    character(len=*), parameter :: function_columns(*) = [character(len=18) :: &
        'y_mm', 'delta_r_mm', 'radius_right_mm', 'radius_left_mm', 'gamma_right_rad', &
        'gamma_left_rad', 'roll_rad', 'y_wheel_right_mm', 'y_rail_right_mm', &
        'y_wheel_left_mm', 'y_rail_left_mm']

contains

    !> The shifts from the middle outwards, to where a wheel leaves its rail or touches the end of
    !> a profile; ends the program if it does in the middle.
    subroutine tabulate_functions(path, case, y_step, n_steps, with_roll, functions)
        character(len=*), intent(in) :: path        !! of the case, for the message
        type(bodies_t), intent(in) :: case   !! both sides
        real(wp), intent(in) :: y_step              !! of the shift, mm
        integer, intent(in) :: n_steps              !! from the middle to there
        logical, intent(in) :: with_roll            !! else the wheelset stays level
        type(contact_functions_t), allocatable, intent(out) :: functions(:) !! by rising shift

        type(contact_functions_t), allocatable :: found(:)
        type(side_t) :: right, left
        type(status_t) :: status
        integer :: i, direction, ends(-1:1)

        right = side_t(case%wheel%profile, case%rail%profile, case%wheelset%radius)
        left = side_t(case%left_wheel%profile, case%left_rail%profile, case%left_wheel%radius)
        allocate (found(-n_steps:n_steps))
        call find(0)
        call fail_on_error(status, path)
        ends = 0
        do direction = -1, 1, 2
            do i = direction, direction*n_steps, direction
                call find(i)
                if (status%code == st_no_contact) exit
                call fail_on_error(status, path)
                ends(direction) = i
            end do
        end do
        functions = found(ends(-1):ends(1))

    contains

        subroutine find(i)
            integer, intent(in) :: i

            call find_contact_functions(right, left, case%wheelset, case%track, &
                                        y_step*real(i, wp), with_roll, found(i), status)
        end subroutine find
    end subroutine tabulate_functions

    !> One row a shift.
    subroutine write_functions(output, case, functions)
        character(len=*), intent(in) :: output               !! file, or `-`
        type(bodies_t), intent(in) :: case            !! both sides
        type(contact_functions_t), intent(in) :: functions(:) !! to be written

        type(csv_writer_t) :: writer
        integer :: i

        call begin_table(writer, output)
        call put_wheelset(writer, case)
        call put_header(writer, function_columns)
        do i = 1, size(functions)
            call put_cells(writer, [functions(i)%shift, functions(i)%delta_r, &
                                    functions(i)%right%radius, functions(i)%left%radius, &
                                    functions(i)%right%gamma, functions(i)%left%gamma, &
                                    functions(i)%roll])
            call put_place(functions(i)%right)
            call put_place(functions(i)%left)
            call end_row(writer)
        end do
        call end_table(writer)

    contains

        subroutine put_place(contact)
            type(rigid_contact_t), intent(in) :: contact

            call put_cells(writer, [contact%y_wheel, contact%y_rail])
        end subroutine put_place
    end subroutine write_functions

    !> What the wheelset of a case is, as comments.
    subroutine put_wheelset(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(bodies_t), intent(in) :: case   !! both sides

        call put_comment(writer, 'right wheel ' // case%wheel%name // ', rail ' &
                         // case%rail%name // ', radius ' &
                         // trim(number_text(case%wheelset%radius)) // ' mm')
        call put_comment(writer, 'left wheel ' // case%left_wheel%name // ', rail ' &
                         // case%left_rail%name // ', radius ' &
                         // trim(number_text(case%left_wheel%radius)) // ' mm')
        call put_comment(writer, 'gauge ' // track_text() // ', flange backs ' // &
                         trim(number_text(case%wheelset%back_spacing)) // ' mm apart')
        call tell(case%wheel%words)
        call tell(case%rail%words)
        if (case%left_wheel%name /= case%wheel%name) call tell(case%left_wheel%words)
        if (case%left_rail%name /= case%rail%name) call tell(case%left_rail%words)

    contains

        function track_text() result(text)
            character(len=:), allocatable :: text

            if (abs(case%track%rail_distance) > 0.0_wp) then
                text = 'as of rails ' // trim(number_text(case%track%rail_distance)) // ' mm apart'
            else
                text = trim(number_text(case%track%gauge)) // ' mm'
            end if
        end function track_text

        subroutine tell(words)
            character(len=*), intent(in) :: words

            if (len(words) > 0) call put_comment(writer, words)
        end subroutine tell
    end subroutine put_wheelset
end module faststrip_command_wheelset_contact_functions
