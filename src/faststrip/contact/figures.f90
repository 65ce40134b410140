!> The figures of one contact, one row each: what interfaces and tables call it, what it is, what
!> must be there for it to be known. Tables, NetCDF, the F77 rows, Python and the documents have
!> names and meanings from here, by `faststrip columns` and `tools/generate/columns.py`.
module faststrip_contact_figures
    implicit none
    private

    public :: figure_t, figures, n_figures

    !> A figure.
    type :: figure_t
        character(len=19) :: name = ''    !! of the member in C, Fortran and Python
        character(len=26) :: column = ''  !! in tables; its unit stands at the end
        logical :: counts = .false.       !! is it a whole number?
        character(len=14) :: needs = ''   !! what must be there for it to be known; empty: nothing
        character(len=64) :: meaning = '' !! what it is, in a few words
    end type figure_t

    !> Which figure it is: its row.
    !> Given: the order of the rows.
    integer, parameter, public :: figure_load = 1, figure_penetration = 2, figure_area = 3, &
                                  figure_pmax = 4, figure_y_min = 5, figure_y_max = 6, &
                                  figure_x_max = 7, figure_fx = 8, figure_fy = 9, figure_mz = 10, &
                                  figure_friction_power = 11, figure_stick_fraction = 12, &
                                  figure_n_patches = 13, figure_iterations = 14, &
                                  figure_strips_across = 15, figure_est_err_penetration = 16, &
                                  figure_est_err_pmax = 17, figure_est_err_area = 18, &
                                  figure_residual_inside = 19, figure_overlap_outside = 20, &
                                  figure_est_err_fx = 21, figure_est_err_fy = 22, &
                                  figure_est_err_mz = 23, figure_gap_change = 24, &
                                  figure_normal_us = 25, figure_tangential_us = 26, &
                                  figure_t_gamma = 27, figure_t_gamma_spin = 28, &
                                  figure_t_gamma_per_area = 29, figure_fatigue_index = 30, &
                                  figure_wear_mass = 31, figure_wear_volume = 32, &
                                  figure_est_err_cksi = 33, figure_est_err_ceta = 34, &
                                  figure_flash_temperature = 35, figure_temperature_max = 36, &
                                  figure_temperature_x = 37, figure_temperature_y = 38, &
                                  figure_von_mises_max = 39, figure_von_mises_x = 40, &
                                  figure_von_mises_y = 41, figure_von_mises_z = 42, &
                                  figure_est_err_von_mises = 43

    !> All of them.
    type(figure_t), parameter :: figures(*) = [ &
        figure_t('load', 'N_N', meaning='normal load'), &
        figure_t('penetration', 'penetration_mm', meaning='penetration, the approach from h = 0'), &
        figure_t('area', 'area_mm2', meaning='contact area'), &
        figure_t('pmax', 'pmax_MPa', meaning='maximum pressure'), &
        figure_t('y_min', 'ymin_mm', meaning='least y of the contact'), &
        figure_t('y_max', 'ymax_mm', meaning='largest y of the contact'), &
        figure_t('x_max', 'xmax_mm', meaning='largest half-length of the contact, along x'), &
        figure_t('fx', 'Fx_N', needs='forces', meaning='longitudinal force on the rail'), &
        figure_t('fy', 'Fy_N', needs='forces', &
                 meaning='lateral force on the rail, in the contact plane'), &
        figure_t('mz', 'Mz_Nmm', needs='forces', &
                 meaning='moment on the rail about the reference point'), &
        figure_t('friction_power', 'friction_power_N', needs='forces', &
                 meaning='frictional work per distance rolled'), &
        figure_t('stick_fraction', 'stick_fraction', needs='stick', &
                 meaning='share of the area in adhesion'), &
        figure_t('n_patches', 'n_patches', counts=.true., meaning='number of contact patches'), &
        figure_t('iterations', 'iterations', counts=.true., &
                 meaning='steps of the normal solution'), &
        figure_t('strips_across', 'strips_across', counts=.true., needs='strips', &
                 meaning='strips across the patch that has most'), &
        figure_t('est_err_penetration', 'est_err_penetration', needs='errors', &
                 meaning='estimated error of the penetration over the depth'), &
        figure_t('est_err_pmax', 'est_err_pmax', needs='errors', &
                 meaning='estimated relative error of pmax'), &
        figure_t('est_err_area', 'est_err_area', needs='errors', &
                 meaning='estimated relative error of the area'), &
        figure_t('residual_inside', 'residual_inside', needs='residuals', &
                 meaning='largest gap left inside, over the depth'), &
        figure_t('overlap_outside', 'overlap_outside', needs='residuals', &
                 meaning='largest overlap outside, over the depth'), &
        figure_t('est_err_fx', 'est_err_Fx', needs='force errors', &
                 meaning='estimated error of Fx over mu N'), &
        figure_t('est_err_fy', 'est_err_Fy', needs='force errors', &
                 meaning='estimated error of Fy over mu N'), &
        figure_t('est_err_mz', 'est_err_Mz', needs='force errors', &
                 meaning='estimated error of Mz over mu N sqrt(area/pi)'), &
        figure_t('gap_change', 'gap_change_um', needs='smoothing', &
                 meaning='what smoothing changed of the gap, rms'), &
        figure_t('normal_us', 'normal_us', needs='times', &
                 meaning='wall time of the normal contact'), &
        figure_t('tangential_us', 'tangential_us', needs='times', &
                 meaning='wall time of the creep forces'), &
        figure_t('t_gamma', 't_gamma_N', needs='forces', meaning='T gamma without spin'), &
        figure_t('t_gamma_spin', 't_gamma_spin_N', needs='forces', &
                 meaning='T gamma with spin'), &
        figure_t('t_gamma_per_area', 't_gamma_per_area_N_per_mm2', needs='forces', &
                 meaning='T gamma without spin per area'), &
        figure_t('fatigue_index', 'fatigue_index', needs='yield in shear', &
                 meaning='surface-fatigue index'), &
        figure_t('mass', 'wear_ug_per_m', needs='wear law', &
                 meaning='wear, mass per distance rolled'), &
        figure_t('volume', 'wear_mm3_per_m', needs='wear law', &
                 meaning='wear, volume per distance rolled'), &
        figure_t('est_err_cksi', 'est_err_cksi', needs='force errors', &
                 meaning='estimated error of cksi, 0 where it is given'), &
        figure_t('est_err_ceta', 'est_err_ceta', needs='force errors', &
                 meaning='estimated error of ceta, 0 where it is given'), &
        figure_t('flash_temperature', 'flash_temperature_K', needs='temperatures', &
                 meaning='largest rise by the heat of friction'), &
        figure_t('temperature_max', 'temperature_max_C', needs='temperatures', &
                 meaning='largest temperature of the surfaces in contact'), &
        figure_t('temperature_x', 'temperature_x_mm', needs='temperatures', &
                 meaning='x of the largest temperature'), &
        figure_t('temperature_y', 'temperature_y_mm', needs='temperatures', &
                 meaning='y of the largest temperature'), &
        figure_t('von_mises_max', 'von_mises_max_MPa', needs='subsurface', &
                 meaning='largest von Mises stress of the rail'), &
        figure_t('von_mises_x', 'von_mises_x_mm', needs='subsurface', meaning='where it is, x'), &
        figure_t('von_mises_y', 'von_mises_y_mm', needs='subsurface', meaning='where it is, y'), &
        figure_t('von_mises_z', 'von_mises_z_mm', needs='subsurface', &
                 meaning='where it is, depth'), &
        figure_t('est_err_von_mises', 'est_err_von_mises', needs='subsurface', &
                 meaning='estimated relative error of it')]

    !> How many there are.
    integer, parameter :: n_figures = size(figures)
end module faststrip_contact_figures
