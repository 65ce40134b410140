!> What error to expect from which method. Written by tools/choice_table.py from
!> reference/choice.csv; change those, not this.
module faststrip_contact_choice_table
    use faststrip_base_kinds, only: wp
    use faststrip_contact_methods, only: contact_methods_t, &
        normal_hertz, &
        normal_strip, &
        tangential_fastsim, &
        tangential_faststrip, &
        tangential_linear, &
        tangential_none, &
        tangential_polach
    implicit none
    private

    public :: misfit_edges, saturation_edges, spin_edges
    public :: forces_methods, forces_base, forces_excess, pmax_methods, pmax_excess
    public :: penetration_methods, penetration_excess

    !> Upper edges of the bins but the last: misfit, saturation, share of spin.
    real(wp), parameter :: misfit_edges(4) = [0.01_wp, 0.05_wp, 0.2_wp, 0.6_wp]
    real(wp), parameter :: saturation_edges(4) = [0.2_wp, 0.6_wp, 1.2_wp, 2.5_wp]
    real(wp), parameter :: spin_edges(1) = [0.25_wp]

    !> To choose from for forces, by ascending time.
    type(contact_methods_t), parameter :: forces_methods(14) = [ &
        contact_methods_t(normal_hertz, tangential_linear, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_hertz, tangential_polach, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_hertz, tangential_fastsim, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=10, fastsim_ny=10), &
        contact_methods_t(normal_hertz, tangential_faststrip, &
            strips_per_patch=7, points_per_strip=8, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_hertz, tangential_faststrip, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_hertz, tangential_fastsim, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=20, fastsim_ny=20), &
        contact_methods_t(normal_strip, tangential_linear, &
            strips_per_patch=5, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=5, points_per_strip=8, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=7, points_per_strip=8, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=9, points_per_strip=10, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=11, points_per_strip=12, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=21, points_per_strip=20, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_faststrip, &
            strips_per_patch=31, points_per_strip=30, fastsim_nx=50, fastsim_ny=50)]
    !> Error over mu N by bin of saturation and spin, and method.
    real(wp), parameter :: forces_base(10, 14) = reshape([ &
        9.936e-03_wp, 1.048e-01_wp, 1.048e-01_wp, 2.808e-01_wp, 2.808e-01_wp, 2.397e-01_wp, &
        1.019e+00_wp, 1.959e+00_wp, 1.406e+01_wp, 1.495e+01_wp, 3.634e-02_wp, 3.634e-02_wp, &
        3.008e-02_wp, 1.707e-01_wp, 9.842e-02_wp, 1.707e-01_wp, 6.133e-02_wp, 4.195e-01_wp, &
        2.603e-02_wp, 2.958e-01_wp, 3.577e-03_wp, 5.654e-03_wp, 5.654e-03_wp, 7.432e-02_wp, &
        3.262e-02_wp, 7.432e-02_wp, 4.454e-02_wp, 1.190e-01_wp, 3.911e-04_wp, 1.500e-01_wp, &
        6.799e-03_wp, 1.262e-02_wp, 1.262e-02_wp, 2.632e-02_wp, 1.895e-02_wp, 2.632e-02_wp, &
        5.188e-03_wp, 4.808e-02_wp, 4.490e-04_wp, 4.534e-02_wp, 3.207e-03_wp, 1.061e-02_wp, &
        1.061e-02_wp, 2.714e-02_wp, 1.705e-02_wp, 2.714e-02_wp, 9.115e-03_wp, 2.976e-02_wp, &
        4.490e-04_wp, 9.900e-03_wp, 8.085e-04_wp, 7.376e-03_wp, 7.376e-03_wp, 7.228e-02_wp, &
        3.490e-02_wp, 7.228e-02_wp, 4.677e-02_wp, 9.598e-02_wp, 2.978e-04_wp, 1.152e-01_wp, &
        1.194e-02_wp, 2.062e-01_wp, 1.028e-01_wp, 2.062e-01_wp, 4.575e-01_wp, 4.441e-01_wp, &
        1.029e+00_wp, 2.266e+00_wp, 1.750e+01_wp, 1.485e+01_wp, 1.083e-02_wp, 1.559e-02_wp, &
        1.559e-02_wp, 1.460e-02_wp, 1.750e-02_wp, 2.782e-02_wp, 5.155e-02_wp, 7.880e-02_wp, &
        5.104e-02_wp, 1.085e-01_wp, 1.037e-02_wp, 1.519e-02_wp, 1.457e-02_wp, 1.519e-02_wp, &
        1.723e-02_wp, 2.826e-02_wp, 4.739e-02_wp, 3.933e-02_wp, 3.342e-02_wp, 6.847e-02_wp, &
        7.484e-03_wp, 1.543e-02_wp, 1.389e-02_wp, 1.543e-02_wp, 1.589e-02_wp, 2.723e-02_wp, &
        5.009e-02_wp, 3.476e-02_wp, 2.696e-02_wp, 3.920e-02_wp, 5.741e-03_wp, 1.539e-02_wp, &
        1.201e-02_wp, 1.539e-02_wp, 1.489e-02_wp, 2.735e-02_wp, 5.046e-02_wp, 3.166e-02_wp, &
        2.012e-02_wp, 3.425e-02_wp, 3.365e-03_wp, 1.518e-02_wp, 1.190e-02_wp, 1.518e-02_wp, &
        1.493e-02_wp, 2.928e-02_wp, 5.114e-02_wp, 2.891e-02_wp, 1.131e-02_wp, 1.932e-02_wp, &
        2.288e-03_wp, 1.492e-02_wp, 1.259e-02_wp, 1.492e-02_wp, 1.492e-02_wp, 2.971e-02_wp, &
        5.077e-02_wp, 2.801e-02_wp, 8.947e-03_wp, 1.602e-02_wp, 2.842e-03_wp, 1.454e-02_wp, &
        1.318e-02_wp, 1.454e-02_wp, 1.458e-02_wp, 3.043e-02_wp, 5.036e-02_wp, 2.597e-02_wp, &
        9.518e-03_wp, 1.561e-02_wp], [10, 14])
    !> Error by bin of misfit, and method.
    real(wp), parameter :: forces_excess(5, 14) = reshape([ &
        0.000e+00_wp, 8.500e-02_wp, 1.559e-01_wp, 9.460e-01_wp, 1.138e+00_wp, 0.000e+00_wp, &
        0.000e+00_wp, 2.674e-01_wp, 6.109e-01_wp, 6.109e-01_wp, 0.000e+00_wp, 2.738e-03_wp, &
        3.659e-01_wp, 6.394e-01_wp, 6.394e-01_wp, 0.000e+00_wp, 8.062e-03_wp, 4.108e-01_wp, &
        6.508e-01_wp, 6.508e-01_wp, 0.000e+00_wp, 1.034e-02_wp, 4.116e-01_wp, 6.483e-01_wp, &
        6.483e-01_wp, 0.000e+00_wp, 7.420e-03_wp, 3.671e-01_wp, 6.361e-01_wp, 6.361e-01_wp, &
        0.000e+00_wp, 0.000e+00_wp, 0.000e+00_wp, 2.024e-02_wp, 1.030e-01_wp, 0.000e+00_wp, &
        0.000e+00_wp, 0.000e+00_wp, 1.569e-02_wp, 1.569e-02_wp, 4.500e-04_wp, 4.500e-04_wp, &
        4.500e-04_wp, 1.369e-02_wp, 1.369e-02_wp, 3.300e-04_wp, 3.300e-04_wp, 3.300e-04_wp, &
        1.390e-03_wp, 1.390e-03_wp, 6.700e-04_wp, 6.700e-04_wp, 6.700e-04_wp, 4.030e-03_wp, &
        4.030e-03_wp, 0.000e+00_wp, 6.040e-03_wp, 6.040e-03_wp, 6.040e-03_wp, 6.040e-03_wp, &
        0.000e+00_wp, 9.240e-03_wp, 9.240e-03_wp, 9.240e-03_wp, 9.240e-03_wp, 0.000e+00_wp, &
        1.262e-02_wp, 1.262e-02_wp, 1.262e-02_wp, 1.262e-02_wp], [5, 14])

    !> To choose from for pmax, by ascending time.
    type(contact_methods_t), parameter :: pmax_methods(9) = [ &
        contact_methods_t(normal_hertz, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=5, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=7, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=9, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=11, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=21, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=31, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=41, points_per_strip=15, fastsim_nx=50, fastsim_ny=50)]
    !> Error by bin of misfit, and method.
    real(wp), parameter :: pmax_excess(5, 9) = reshape([ &
        1.086e-03_wp, 5.026e-03_wp, 1.891e-01_wp, 2.439e-01_wp, 5.728e-01_wp, 3.584e-03_wp, &
        3.584e-03_wp, 1.517e-02_wp, 2.009e-01_wp, 4.759e-01_wp, 2.810e-03_wp, 2.870e-03_wp, &
        1.191e-02_wp, 2.222e-02_wp, 4.303e-01_wp, 2.208e-03_wp, 2.301e-03_wp, 5.438e-03_wp, &
        2.673e-02_wp, 3.537e-01_wp, 1.722e-03_wp, 1.850e-03_wp, 4.199e-03_wp, 1.311e-02_wp, &
        2.956e-01_wp, 1.130e-03_wp, 1.291e-03_wp, 3.214e-03_wp, 8.315e-03_wp, 2.135e-01_wp, &
        7.158e-04_wp, 8.915e-04_wp, 2.796e-03_wp, 6.428e-03_wp, 1.158e-01_wp, 4.462e-04_wp, &
        6.268e-04_wp, 2.569e-03_wp, 3.300e-03_wp, 3.369e-02_wp, 3.579e-04_wp, 5.191e-04_wp, &
        2.489e-03_wp, 2.908e-03_wp, 6.031e-02_wp], [5, 9])

    !> To choose from for penetration, by ascending time.
    type(contact_methods_t), parameter :: penetration_methods(9) = [ &
        contact_methods_t(normal_hertz, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=5, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=7, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=9, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=11, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=15, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=21, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=31, points_per_strip=15, fastsim_nx=50, fastsim_ny=50), &
        contact_methods_t(normal_strip, tangential_none, &
            strips_per_patch=41, points_per_strip=15, fastsim_nx=50, fastsim_ny=50)]
    !> Error by bin of misfit, and method.
    real(wp), parameter :: penetration_excess(5, 9) = reshape([ &
        6.833e-04_wp, 2.888e-03_wp, 3.393e-01_wp, 4.360e-01_wp, 4.360e-01_wp, 7.005e-03_wp, &
        7.005e-03_wp, 7.005e-03_wp, 7.005e-03_wp, 2.256e-02_wp, 4.140e-03_wp, 4.140e-03_wp, &
        4.140e-03_wp, 4.140e-03_wp, 1.141e-02_wp, 2.765e-03_wp, 2.765e-03_wp, 2.765e-03_wp, &
        2.765e-03_wp, 5.886e-03_wp, 1.997e-03_wp, 1.997e-03_wp, 1.997e-03_wp, 1.997e-03_wp, &
        2.861e-03_wp, 1.206e-03_wp, 1.206e-03_wp, 1.206e-03_wp, 1.206e-03_wp, 1.654e-03_wp, &
        6.970e-04_wp, 6.970e-04_wp, 6.970e-04_wp, 7.128e-04_wp, 1.176e-03_wp, 3.706e-04_wp, &
        3.706e-04_wp, 3.706e-04_wp, 5.071e-04_wp, 9.172e-04_wp, 2.361e-04_wp, 2.361e-04_wp, &
        3.525e-04_wp, 5.661e-04_wp, 7.705e-04_wp], [5, 9])
end module faststrip_contact_choice_table
