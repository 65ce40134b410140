!> The values of the figures of a contact: which component of a result is which figure.
module faststrip_contact_figure_values
    use faststrip_base_kinds, only: wp
    use faststrip_contact_figures, only: figure_est_err_area, figure_est_err_ceta, &
                                         figure_est_err_cksi, figure_est_err_fx, &
                                         figure_est_err_mz, figure_est_err_penetration, &
                                         figure_est_err_von_mises, &
                                         figure_fatigue_index, figure_flash_temperature, &
                                         figure_friction_power, figure_fx, &
                                         figure_gap_change, figure_overlap_outside, &
                                         figure_residual_inside, figure_stick_fraction, &
                                         figure_strips_across, figure_t_gamma, &
                                         figure_t_gamma_per_area, figure_temperature_y, &
                                         figure_von_mises_max, &
                                         figure_wear_mass, figure_wear_volume, n_figures
    use faststrip_contact_method, only: contact_result_t
    implicit none
    private

    public :: find_figures

contains

    !> The figures of a result, in the units of their columns.
    pure subroutine find_figures(result, values, known)
        type(contact_result_t), intent(in) :: result !! of a contact that was solved
        real(wp), intent(out) :: values(n_figures)   !! by row
        logical, intent(out) :: known(n_figures)     !! by row; of what is not known nothing counts

        ! Given: the units.
        real(wp), parameter :: um_per_mm = 1.0e3_wp

        associate (normal => result%normal, forces => result%tangential, &
                   errors => result%normal_errors, force_errors => result%force_errors, &
                   wear => result%wear, flash => result%flash, peak => result%stress_peak)
            values = [normal%load, normal%penetration, normal%area, normal%pmax, normal%y_min, &
                      normal%y_max, normal%x_max, forces%fx, forces%fy, forces%mz, &
                      forces%friction_power, forces%stick_fraction, real(normal%n_patches, wp), &
                      real(normal%iterations, wp), real(normal%strips_across, wp), &
                      errors%est_err_penetration, errors%est_err_pmax, errors%est_err_area, &
                      errors%residual_inside, errors%overlap_outside, force_errors%fx, &
                      force_errors%fy, force_errors%mz, um_per_mm*result%gap_change, &
                      result%times%normal_us, result%times%tangential_us, wear%t_gamma, &
                      wear%t_gamma_spin, wear%t_gamma_per_area, wear%fatigue_index, &
                      wear%wear%mass, wear%wear%volume, result%creepage_errors, flash%rise, &
                      flash%temperature, flash%x, flash%y, peak%von_mises, peak%x, peak%y, &
                      peak%z, peak%est_err]
            known = .true.
            known(figure_fx:figure_friction_power) = result%has_forces
            known(figure_stick_fraction) = result%knows_stick
            known(figure_strips_across) = normal%strips_across > 0
            known(figure_est_err_penetration:figure_est_err_area) = result%is_estimated
            known(figure_residual_inside:figure_overlap_outside) = result%has_residuals
            known(figure_est_err_fx:figure_est_err_mz) = result%forces_are_estimated
            known(figure_est_err_cksi:figure_est_err_ceta) = result%forces_are_estimated
            known(figure_gap_change) = result%gap_change > 0.0_wp
            known(figure_t_gamma:figure_t_gamma_per_area) = result%has_forces
            known(figure_fatigue_index) = wear%knows_fatigue
            known(figure_wear_mass:figure_wear_volume) = wear%knows_wear
            known(figure_flash_temperature:figure_temperature_y) = result%knows_temperatures
            known(figure_von_mises_max:figure_est_err_von_mises) = peak%is_known
        end associate
    end subroutine find_figures
end module faststrip_contact_figure_values
