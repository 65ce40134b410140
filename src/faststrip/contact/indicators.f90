!> What can be told of a contact before it is solved: how far from an ellipse, how far from linear.
!>
!> A few evaluations of the gap and one Hertz contact: microseconds, against which the choice of a
!> method (`faststrip_contact_choice`) has to pay.
module faststrip_contact_indicators
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, clear_status
    use faststrip_base_material, only: normal_compliance, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_geometry_gap_curve, only: gap_curve_t
    use faststrip_normal_hertz, only: hertz_t, hertz_solve_gap_demand
    use faststrip_normal_misfit, only: misfit_t, find_misfit, most_misfit
    use faststrip_normal_strip_patches, only: patches_t
    use faststrip_normal_strip_start, only: start_patches
    use faststrip_normal_types, only: demand_t, above_lowest
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_contact_case, only: contact_case_t
    implicit none
    private

    public :: indicators_t, find_indicators, no_ellipse, no_friction

    !> Numbers that errors are predicted from.
    type :: indicators_t
        real(wp) :: misfit = 0.0_wp
            !! largest distance of the gap from the Hertz parabola on and just beyond the Hertz
            !! ellipse, over the penetration; `no_ellipse` if there is no ellipse
        real(wp) :: saturation = 0.0_wp !! linear force over mu N; `no_friction` without friction
        real(wp) :: spin_share = 0.0_wp !! squared share of the linear force that comes from spin
        real(wp) :: a = 0.0_wp          !! half-length of the patch as it is estimated, mm
        real(wp) :: b = 0.0_wp          !! and half-width, mm
    end type indicators_t

    real(wp), parameter :: no_ellipse = most_misfit !! misfit without an ellipse, and the most told
    ! Tuned [1]. Origin: chosen: beyond any that is told apart.
    real(wp), parameter :: no_friction = 1.0e3_wp !! saturation without friction, and the most told

    ! Beyond this misfit the size of the patch is taken from the width of the gap.
    ! Tuned [1]. Origin: chosen.
    real(wp), parameter :: large_misfit = 0.2_wp

contains

    !> Indicators of a contact under a load or a penetration.
    pure subroutine find_indicators(curve, case, indicators, status)
        type(gap_curve_t), intent(in) :: curve   !! its gap, that was set
        type(contact_case_t), intent(in) :: case !! demand, material, checked, mu and creepages
        type(indicators_t), intent(out) :: indicators !! of this contact
        type(status_t), intent(out) :: status
            !! `st_no_contact`, `st_out_of_range`, `st_not_finite`: there is no contact to tell of

        type(hertz_t) :: hertz
        type(misfit_t) :: misfit
        type(patches_t) :: patches
        type(status_t) :: ellipse
        type(demand_t) :: demand

        call clear_status(status)
        call hertz_solve_gap_demand(curve, normal_compliance(case%material), case%demand_t, hertz, &
                                    ellipse)
        indicators%misfit = no_ellipse
        if (.not. is_error(ellipse)) then
            misfit = find_misfit(curve, normal_compliance(case%material), hertz)
            indicators%misfit = misfit%largest
        end if
        if (indicators%misfit > large_misfit) then
            demand = above_lowest(case%demand_t, curve%h_lowest)
            if (.not. demand%by_load .and. demand%penetration <= 0.0_wp) then
                status = ellipse
                return
            end if
            call start_patches(curve, normal_compliance(case%material), demand, patches, &
                               hertz%penetration)
            hertz%a = patches%at(1)%seed_length
            hertz%b = 0.5_wp*sum(patches%at(:patches%n)%y_to - patches%at(:patches%n)%y_from)
            hertz%y = 0.5_wp*(patches%at(1)%y_from + patches%at(patches%n)%y_to)
            hertz%load = demand%load
            if (.not. demand%by_load) hertz%load = 2.0_wp/3.0_wp*patches%at(1)%seed_pressure &
                                            *acos(-1.0_wp)*hertz%a*hertz%b
        end if
        call set_saturation(hertz, case, indicators, status)
    end subroutine find_indicators

    !> Kalker's linear forces of the estimated ellipse over mu N.
    pure subroutine set_saturation(size, case, indicators, status)
        type(hertz_t), intent(in) :: size
        type(contact_case_t), intent(in) :: case
        type(indicators_t), intent(inout) :: indicators
        type(status_t), intent(out) :: status

        type(kalker_coefficients_t) :: c
        real(wp) :: scale, ab, along, across, turning

        indicators%a = size%a
        indicators%b = size%b
        call kalker_coefficients(size%a/size%b, combined_poisson_ratio(case%material), c, status)
        if (is_error(status)) return
        indicators%saturation = no_friction
        ab = size%a*size%b
        scale = combined_shear_modulus(case%material)*ab
        along = c%c11*abs(case%creepage%cksi - size%y*case%creepage%cphi)
        across = c%c22*abs(case%creepage%ceta)
        turning = c%c23*sqrt(ab)*abs(case%creepage%cphi)
        if (max(along, across, turning) <= 0.0_wp) then
            indicators%saturation = 0.0_wp
            return
        end if
        indicators%spin_share = turning**2/(along**2 + across**2 + turning**2)
        if (case%mu*size%load > scale*sqrt(along**2 + across**2 + turning**2)/no_friction) &
            indicators%saturation = scale*sqrt(along**2 + across**2 + turning**2) &
                                    /(case%mu*size%load)
    end subroutine set_saturation
end module faststrip_contact_indicators
