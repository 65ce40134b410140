!> Columns of tables about lookup tables: states, forces, errors.
module faststrip_command_lookup_columns
    use faststrip_lookup_faces, only: n_forces
    use faststrip_lookup_hertz, only: n_lookup_state
    use faststrip_lookup_table, only: n_contact_numbers, n_wheel_errors
    use faststrip_lookup_wheel, only: n_wheel_state
    implicit none
    private

    public :: hertz_columns, wheel_columns, contact_columns, force_columns, hertz_names, wheel_names
    public :: error_names, state_kinds, orders

    !> A state of an ellipse, and short names of its numbers.
    character(len=15), parameter :: hertz_columns(n_lookup_state) = [character(len=15) :: &
        'a_mm', 'b_mm', 'N_N', 'mu', 'G_MPa', 'cksi', 'ceta', 'cphi_rad_per_mm']
    character(len=4), parameter :: hertz_names(n_lookup_state) = [character(len=4) :: &
        'a', 'b', 'N', 'mu', 'G', 'cksi', 'ceta', 'cphi']
    !> The same of a wheel.
    character(len=15), parameter :: wheel_columns(n_wheel_state) = [character(len=15) :: &
        'y_mm', 'yaw_rad', 'load_N', 'mu', 'cksi', 'ceta', 'cphi_rad_per_mm']
    character(len=4), parameter :: wheel_names(n_wheel_state) = [character(len=4) :: &
        'y', 'yaw', 'load', 'mu', 'cksi', 'ceta', 'cphi']
    !> Numbers of a contact of a wheel.
    character(len=17), parameter :: contact_columns(n_contact_numbers) = [character(len=17) :: &
        'N_N', 'contact_angle_rad', 'y_rail_mm', 'z_rail_mm', 'x_track_mm', 'y_wheel_mm', &
        'radius_mm', 'z_mm', 'area_mm2', 'pmax_MPa', 'c_mm', 'L1_mm2', 'L2_mm2', 'L3_mm3']
    !> Creep forces.
    character(len=6), parameter :: force_columns(n_forces) = [character(len=6) :: &
        'Fx_N', 'Fy_N', 'Mz_Nmm']
    !> What a table is judged by: of ellipses the first three; of which states; of which order.
    !> Given: their order in a table.
    character(len=3), parameter :: error_names(n_wheel_errors) = [character(len=3) :: &
        'Fx', 'Fy', 'Mz', 'N_y', 'z']
    character(len=6), parameter :: state_kinds(2) = [character(len=6) :: 'all', 'change']
    character(len=6), parameter :: orders(2) = [character(len=6) :: 'linear', 'cubic']
end module faststrip_command_lookup_columns
