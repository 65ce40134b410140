!> A wheelset on a track, both sides of it, as a case file tells it.
module faststrip_command_settings_case_wheelset
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_command_settings_case_profiles, only: read_wheel_group, read_rail_group, &
                                                        complete_wheelset, shape_t, left_wheel_t, &
                                                        hold_width
    use faststrip_command_settings_case_values, only: case_groups
    use faststrip_command_program_files, only: take_input
    use faststrip_command_settings_namelist, only: namelist_file_t, read_namelist_file
    implicit none
    private

    public :: case_wheelset_t, read_case_wheelset

    !> The groups `wheel` and `rail` of a case file. What it says of one side only holds for both.
    type :: case_wheelset_t
        type(wheelset_t) :: wheelset        !! mm; the radius is the right wheel's
        type(track_t) :: track              !! mm
        type(shape_t) :: right_wheel        !! in the frame of a right wheel
        type(left_wheel_t) :: left_wheel    !! mirrored, in the frame of a right wheel; its radius
        type(shape_t) :: right_rail         !! inclined, in the frame of a right rail
        type(shape_t) :: left_rail          !! inclined and mirrored, in the frame of a right rail
    end type case_wheelset_t

contains

    !> Read these two groups of a case file; the others may stand there. Ends the program with one
    !> line at the first thing that is wrong.
    subroutine read_case_wheelset(path, case)
        character(len=*), intent(in) :: path      !! name of the `.nml` file
        type(case_wheelset_t), intent(out) :: case !! checked

        type(namelist_file_t) :: content

        call take_input(path)
        call read_namelist_file(path, case_groups, content)
        call read_wheel_group(content, .true., case%wheelset, case%right_wheel, case%left_wheel)
        call read_rail_group(content, .true., case%track, case%right_rail, case%left_rail)
        call complete_wheelset(content, case%track, case%wheelset)
        call hold_width(content, case%right_wheel, case%wheelset%radius)
        call hold_width(content, case%left_wheel%shape_t, case%wheelset%radius)
        call hold_width(content, case%right_rail, case%wheelset%radius)
        call hold_width(content, case%left_rail, case%wheelset%radius)
    end subroutine read_case_wheelset
end module faststrip_command_settings_case_wheelset
