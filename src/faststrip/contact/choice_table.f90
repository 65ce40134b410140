!> What error to expect from which method. Written by tools/choice_table.py from
!> reference/choice.csv; change those, not this.
module faststrip_contact_choice_table
    use faststrip_kinds, only: wp
    use faststrip_contact_methods, only: contact_methods_t, &
        normal_hertz, &
        normal_strip, &
        tangential_fastsim, &
        tangential_faststrip, &
        tangential_none
    implicit none
    public

    !> Upper edges of the bins but the last: misfit, saturation, share of spin.
    real(wp), parameter :: misfit_edges(4) = [0.01_wp, 0.05_wp, 0.2_wp, 0.6_wp]
    real(wp), parameter :: saturation_edges(4) = [0.2_wp, 0.6_wp, 1.2_wp, 2.5_wp]
    real(wp), parameter :: spin_edges(1) = [0.25_wp]

    !> To choose from for forces, by ascending time.
    integer, parameter :: n_forces = 7
    type(contact_methods_t), parameter :: forces_methods(7) = [ &
        contact_methods_t(normal_hertz, tangential_fastsim, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=20, fastsim_ny=20), &
        contact_methods_t(normal_hertz, tangential_fastsim, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=5, points_per_strip=8, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=9, points_per_strip=10, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=21, points_per_strip=20, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=31, points_per_strip=30, fastsim_nx=50, fastsim_ny=50)]
    !> Error over mu N by bin of saturation and spin, and method.
    real(wp), parameter :: forces_base(10, 7) = reshape([ &
        7.364e-04_wp, 1.866e-03_wp, 3.926e-02_wp, 3.926e-02_wp, 3.490e-02_wp, 7.219e-02_wp, &
        4.677e-02_wp, 9.231e-02_wp, 5.601e-04_wp, 1.651e-01_wp, 8.034e-04_wp, 1.350e-03_wp, &
        3.593e-02_wp, 3.593e-02_wp, 3.527e-02_wp, 6.621e-02_wp, 4.709e-02_wp, 8.405e-02_wp, &
        5.377e-04_wp, 1.488e-01_wp, 3.955e-03_wp, 7.284e-03_wp, 1.773e-02_wp, 1.773e-02_wp, &
        1.610e-02_wp, 1.583e-01_wp, 1.310e-02_wp, 1.542e-01_wp, 6.440e-04_wp, 1.865e-01_wp, &
        3.324e-03_wp, 6.513e-03_wp, 2.067e-02_wp, 2.067e-02_wp, 1.060e-02_wp, 2.897e-02_wp, &
        1.317e-02_wp, 3.879e-02_wp, 6.440e-04_wp, 1.109e-01_wp, 3.049e-03_wp, 6.047e-03_wp, &
        2.178e-02_wp, 2.178e-02_wp, 1.122e-02_wp, 1.694e-02_wp, 1.302e-02_wp, 2.951e-02_wp, &
        6.440e-04_wp, 5.494e-02_wp, 1.724e-03_wp, 5.863e-03_wp, 2.117e-02_wp, 2.117e-02_wp, &
        1.022e-02_wp, 1.837e-02_wp, 1.337e-02_wp, 2.923e-02_wp, 6.440e-04_wp, 3.016e-02_wp, &
        4.155e-04_wp, 5.709e-03_wp, 2.138e-02_wp, 2.138e-02_wp, 1.018e-02_wp, 2.048e-02_wp, &
        1.322e-02_wp, 2.911e-02_wp, 6.440e-04_wp, 1.791e-02_wp], [10, 7])
    !> Error by bin of misfit, and method.
    real(wp), parameter :: forces_excess(5, 7) = reshape([ &
        0.000e+00_wp, 0.000e+00_wp, 2.356e-01_wp, 2.356e-01_wp, 2.356e-01_wp, 0.000e+00_wp, &
        0.000e+00_wp, 2.383e-01_wp, 2.383e-01_wp, 2.383e-01_wp, 0.000e+00_wp, 0.000e+00_wp, &
        0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, &
        0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, &
        0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, &
        0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp], [5, 7])

    !> To choose from for pmax, by ascending time.
    integer, parameter :: n_pmax = 11
    type(contact_methods_t), parameter :: pmax_methods(11) = [ &
        contact_methods_t(normal_hertz, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=7, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=9, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=5, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=11, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=21, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=31, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=41, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=61, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=81, points_per_strip=15, fastsim_nx=50, fastsim_ny=50)]
    !> Error by bin of misfit, and method.
    real(wp), parameter :: pmax_excess(5, 11) = reshape([ &
        2.712e-01_wp, 2.712e-01_wp, 2.712e-01_wp, 2.712e-01_wp, 2.712e-01_wp, 8.436e-03_wp, &
        8.436e-03_wp, 8.436e-03_wp, 8.436e-03_wp, 8.436e-03_wp, 2.414e-02_wp, 2.414e-02_wp, &
        2.414e-02_wp, 2.414e-02_wp, 2.414e-02_wp, 2.276e-01_wp, 2.276e-01_wp, 2.276e-01_wp, &
        2.276e-01_wp, 2.276e-01_wp, 1.280e-02_wp, 1.280e-02_wp, 1.280e-02_wp, 1.280e-02_wp, &
        1.280e-02_wp, 1.516e-02_wp, 1.516e-02_wp, 1.516e-02_wp, 1.516e-02_wp, 1.516e-02_wp, &
        1.227e-02_wp, 1.227e-02_wp, 1.227e-02_wp, 1.227e-02_wp, 1.227e-02_wp, 3.029e-03_wp, &
        3.029e-03_wp, 3.029e-03_wp, 3.029e-03_wp, 3.029e-03_wp, 2.268e-03_wp, 2.268e-03_wp, &
        2.268e-03_wp, 2.268e-03_wp, 2.268e-03_wp, 1.646e-03_wp, 1.646e-03_wp, 1.646e-03_wp, &
        1.646e-03_wp, 1.646e-03_wp, 1.502e-03_wp, 1.502e-03_wp, 1.502e-03_wp, 1.502e-03_wp, &
        1.502e-03_wp], [5, 11])

    !> To choose from for penetration, by ascending time.
    integer, parameter :: n_penetration = 11
    type(contact_methods_t), parameter :: penetration_methods(11) = [ &
        contact_methods_t(normal_hertz, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=7, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=9, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=5, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=11, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=21, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=31, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=41, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=61, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=81, points_per_strip=15, fastsim_nx=50, fastsim_ny=50)]
    !> Error by bin of misfit, and method.
    real(wp), parameter :: penetration_excess(5, 11) = reshape([ &
        2.878e-01_wp, 2.878e-01_wp, 2.878e-01_wp, 2.878e-01_wp, 2.878e-01_wp, 3.648e-03_wp, &
        3.648e-03_wp, 3.648e-03_wp, 3.648e-03_wp, 3.648e-03_wp, 1.276e-03_wp, 1.276e-03_wp, &
        1.276e-03_wp, 1.276e-03_wp, 1.276e-03_wp, 8.362e-03_wp, 8.362e-03_wp, 8.362e-03_wp, &
        8.362e-03_wp, 8.362e-03_wp, 1.238e-03_wp, 1.238e-03_wp, 1.238e-03_wp, 1.238e-03_wp, &
        1.238e-03_wp, 5.156e-04_wp, 5.156e-04_wp, 5.156e-04_wp, 5.156e-04_wp, 5.156e-04_wp, &
        2.268e-04_wp, 2.268e-04_wp, 2.268e-04_wp, 2.268e-04_wp, 2.268e-04_wp, 1.553e-04_wp, &
        1.553e-04_wp, 1.553e-04_wp, 1.553e-04_wp, 1.553e-04_wp, 2.277e-04_wp, 2.277e-04_wp, &
        2.277e-04_wp, 2.277e-04_wp, 2.277e-04_wp, 2.810e-04_wp, 2.810e-04_wp, 2.810e-04_wp, &
        2.810e-04_wp, 2.810e-04_wp, 2.992e-04_wp, 2.992e-04_wp, 2.992e-04_wp, 2.992e-04_wp, &
        2.992e-04_wp], [5, 11])
end module faststrip_contact_choice_table
