!> Where `auto` goes over from a Hertz ellipse to strips: forces of both, in shares.
module faststrip_wheelset_wheel_blend
    use faststrip_base_kinds, only: wp
    use faststrip_contact_method, only: workspace_t
    use faststrip_contact_methods, only: normal_hertz
    use faststrip_contact_wanted, only: wanted_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_wheelset_types, only: wheel_contact_t
    implicit none
    private

    public :: share_of_strips, hand_to_strips, mix_errors

    ! Tuned [1]: part of the tolerance of auto up to which an ellipse alone answers. Origin: chosen:
    ! half of it is 0.2 to 0.7 mm of a wheel's way.
    real(wp), parameter :: blend_from = 0.5_wp

contains

    !> The share of strips, 0 to 1, where auto took a Hertz ellipse: forces of a motion go over from
    !> one to the other while the ellipse's estimate goes from a part of the tolerance to all of it.
    !> Within a budget of time there is none for both.
    pure real(wp) function share_of_strips(wanted, workspace) result(share)
        type(wanted_t), intent(in) :: wanted       !! what is asked of auto
        type(workspace_t), intent(in) :: workspace !! of the solution

        share = 0.0_wp
        if (workspace%solved_by /= normal_hertz .or. wanted%budget_us > 0.0_wp) return
        share = workspace%steps%estimate/wanted%tolerance
        share = max(0.0_wp, min((share - blend_from)/(1.0_wp - blend_from), 1.0_wp))
    end function share_of_strips

    !> Forces of both; patch and pressures are those of the strips.
    pure subroutine hand_to_strips(ellipse, share, contact)
        type(wheel_contact_t), intent(in) :: ellipse    !! the contact by a Hertz ellipse
        real(wp), intent(in) :: share                   !! of the strips, 0 to 1
        type(wheel_contact_t), intent(inout) :: contact !! by strips; gets the sums of both

        contact%force = mixed(ellipse%force, contact%force, share)
        contact%force_wheelset = mixed(ellipse%force_wheelset, contact%force_wheelset, share)
        contact%moment = mixed(ellipse%moment, contact%moment, share)
        associate (mine => contact%figures, its => ellipse%figures)
            mine%normal%load = mixed(its%normal%load, mine%normal%load, share)
            mine%moment = mixed(its%moment, mine%moment, share)
            associate (a => its%tangential, b => mine%tangential)
                b%fx = mixed(a%fx, b%fx, share)
                b%fy = mixed(a%fy, b%fy, share)
                b%mz = mixed(a%mz, b%mz, share)
                b%friction_power = mixed(a%friction_power, b%friction_power, share)
            end associate
            call mix_errors(its%force_errors, share, mine%force_errors)
        end associate
    end subroutine hand_to_strips

    !> Estimates of such forces.
    pure subroutine mix_errors(ellipse, share, errors)
        type(force_errors_t), intent(in) :: ellipse   !! by a Hertz ellipse
        real(wp), intent(in) :: share                 !! of the strips, 0 to 1
        type(force_errors_t), intent(inout) :: errors !! of the strips; get those of both

        errors%fx = mixed(ellipse%fx, errors%fx, share)
        errors%fy = mixed(ellipse%fy, errors%fy, share)
        errors%mz = mixed(ellipse%mz, errors%mz, share)
        errors%arm = mixed(ellipse%arm, errors%arm, share)
    end subroutine mix_errors

    elemental real(wp) function mixed(of_ellipse, of_strips, share)
        real(wp), intent(in) :: of_ellipse, of_strips, share

        mixed = of_ellipse + share*(of_strips - of_ellipse)
    end function mixed
end module faststrip_wheelset_wheel_blend
