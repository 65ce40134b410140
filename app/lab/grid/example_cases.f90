!> The cases of example/cases.
module faststrip_lab_grid_example_cases
    use faststrip_base_status, only: status_t
    use faststrip_command_settings_case_file, only: case_t, read_case
    use faststrip_command_program_console, only: fail_on_error
    use faststrip_command_contact_prepared_case, only: prepared_case_t, prepare_case
    implicit none
    private

    public :: example_names, read_example

    !> Names of their case files.
    character(len=*), parameter :: example_names(11) = [character(len=20) :: 'tread_straight', &
        'curve_flange_root', 'two_point_contact', 'worn_wheel', 'kink_r300_r80', 'freight_25t', &
        'tram_small_wheel', 'polymer_roller', 'near_conformal', 'locomotive_traction', &
        'twin_disc']

contains

    !> Read one; ends the program if that cannot be done.
    subroutine read_example(folder, i, case, prepared)
        character(len=*), intent(in) :: folder !! with the case files
        integer, intent(in) :: i               !! 1 to size(example_names)
        type(case_t), intent(out) :: case      !! as the file tells it
        type(prepared_case_t), intent(out) :: prepared    !! ready to be solved

        type(status_t) :: status

        call read_case(folder // '/' // trim(example_names(i)) // '.nml', case)
        call prepare_case(case, case%shift, 0, prepared, status)
        call fail_on_error(status, trim(example_names(i)))
    end subroutine read_example
end module faststrip_lab_grid_example_cases
