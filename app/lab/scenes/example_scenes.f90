!> The scenes of example/scenes.
module faststrip_lab_scenes_example_scenes
    use faststrip_base_status, only: status_t
    use faststrip_command_case_file, only: case_t, read_case
    use faststrip_command_console, only: fail_on_error
    use faststrip_command_prepared_case, only: prepared_case_t, prepare_case
    implicit none
    private

    public :: scene_names, read_example_scene

    !> Names of their case files.
    character(len=*), parameter :: scene_names(10) = [character(len=20) :: 'tread_straight', &
        'curve_flange_root', 'two_point_contact', 'worn_wheel', 'kink_r300_r80', 'freight_25t', &
        'tram_small_wheel', 'polymer_roller', 'near_conformal', 'locomotive_traction']

contains

    !> Read one; ends the program if that cannot be done.
    subroutine read_example_scene(folder, i, case, prepared)
        character(len=*), intent(in) :: folder !! with the case files
        integer, intent(in) :: i               !! 1 to size(scene_names)
        type(case_t), intent(out) :: case      !! as the file tells it
        type(prepared_case_t), intent(out) :: prepared    !! ready to be solved

        type(status_t) :: status

        call read_case(folder // '/' // trim(scene_names(i)) // '.nml', case)
        call prepare_case(case, case%shift, prepared, status)
        call fail_on_error(status, trim(scene_names(i)))
    end subroutine read_example_scene
end module faststrip_lab_scenes_example_scenes
