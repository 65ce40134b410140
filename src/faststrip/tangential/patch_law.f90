!> What Kalker's coefficients of a patch's ellipse say of its strips: flexibilities, bound, stretch
!> of the arms. The steps S1 to S6 and S9 are those of `faststrip_tangential_faststrip`.
module faststrip_tangential_patch_law
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: nothing
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_motion, only: over_force
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t
    implicit none
    private

    public :: patch_law_t, find_law, add_law, mean_law, same_law, lateral_stiffness

    ! Tuned [1]. Origin: errors against CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: gamma_length = 0.375_wp  ! S1; roots of roots
    ! Tuned [1]. Origin: errors against CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: asymmetry = 0.15_wp      ! S2, alpha without spin
    ! Tuned [1]. Origin: errors against CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: flattening = 0.3_wp      ! S2, m = 1 - flattening at most
    ! Tuned [1]: Part of the spin's slope from the longitudinal flexibility. Origin: errors against
    ! CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: longitudinal_part = 0.5_wp ! S3
    ! Tuned [1]: Part of the flexibility moved with spin. Origin: errors against CONTACT, see the
    ! module's head.
    real(wp), parameter :: spin_part = 0.5_wp       ! S5
    ! Tuned [1]: The way to the flexibility of spin at full slip. Origin: errors against CONTACT,
    ! see `faststrip_tangential_faststrip`.
    real(wp), parameter :: stiffening = 0.5_wp      ! S5
    ! Tuned [1]. Origin: errors against CONTACT, see `faststrip_tangential_faststrip`.
    real(wp), parameter :: half_saturation = 2.0_wp ! linear force over mu N at saturation 1/2
    ! Tuned [1]: Linear force over mu N half way from the march's bound to that of sliding (S9).
    ! Origin: errors against CONTACT: 6 makes the lateral force of spin worse by 0.2 % of mu N, 30
    ! changes none by 0.03 %.
    real(wp), parameter :: half_sliding = 15.0_wp
    ! From where saturation takes over from the march (S9), of whose bound a 17th is left there.
    real(wp), parameter :: sliding_from = 2.0_wp*half_sliding
    ! Tuned [1]: To where it does. Origin: errors against CONTACT: from 8 on the lateral force of
    ! spin is worse by 0.3 % of mu N.
    real(wp), parameter :: sliding_to = 300.0_wp

    ! int_{-1}^{1} (1 - s^2)^e ds for e = (2 - gamma)/2 and (3 - gamma)/2; of s^2 (1 - s^2)^e1.
    real(wp), parameter :: e1 = 0.5_wp*(2.0_wp - gamma_length)
    real(wp), parameter :: e3 = 0.5_wp*(3.0_wp - gamma_length)
    ! Given: the root of pi, and integrals by the gamma function.
    real(wp), parameter :: root_pi = 1.772453850905516027298167483341145183_wp
    ! Given: an integral by the gamma function.
    real(wp), parameter :: i1 = root_pi*gamma(e1 + 1.0_wp)/gamma(e1 + 1.5_wp)
    ! Given: an integral by the gamma function.
    real(wp), parameter :: i3 = root_pi*gamma(e3 + 1.0_wp)/gamma(e3 + 1.5_wp)
    ! Given: an integral by the gamma function.
    real(wp), parameter :: j1 = 0.5_wp*root_pi*gamma(e1 + 1.0_wp)/gamma(e1 + 2.5_wp)

    !> What the strips of one patch, or of one sub-patch, share.
    type :: patch_law_t
        real(wp) :: a = 0.0_wp, b = 0.0_wp !! semi-axes of the virtual ellipse, mm
        real(wp) :: y = 0.0_wp   !! centroid, mm
        real(wp) :: l1 = 0.0_wp, l2 = 0.0_wp, l3 = 0.0_wp
            !! flexibilities of a strip of length 2a, mm/MPa
        real(wp) :: k1 = 0.0_wp, k2 = 0.0_wp !! the same in slip, mm/MPa
        real(wp) :: spin_slope = 0.0_wp
            !! slope of px in adhesion per y cphi, strip of length 2a, MPa/mm
        real(wp) :: stretch_x = 0.0_wp !! arms in x are longer by this part where nothing slides
        real(wp) :: stretch_y = 0.0_wp !! arms in y, from the centroid
        real(wp) :: exponent = 0.0_wp  !! m of the bound
        real(wp) :: alpha = 0.0_wp     !! of the bound
        real(wp) :: sliding = 0.0_wp   !! weight of saturation in the forces, 0 to 1
        real(wp) :: weight = 0.0_wp    !! sum of the weights of an average; zero: carries nothing
    end type patch_law_t

contains

    !> What an ellipse says of the strips of a patch.
    pure subroutine find_law(ellipse, material, mu, creepage, law, status, linear)
        type(patch_ellipse_t), intent(in) :: ellipse !! of the patch or sub-patch
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction
        type(creepage_t), intent(in) :: creepage     !! about the reference point
        type(patch_law_t), intent(out) :: law !! without weight if there is nothing to carry
        type(status_t), intent(inout) :: status      !! that of `kalker_coefficients`
        real(wp), intent(out), optional :: linear(3)
            !! linear forces of the ellipse over mu N: by the longitudinal and the lateral creepage
            !! of its centre, by spin

        type(kalker_coefficients_t) :: c
        real(wp) :: g, ab, force, along, across, turning, spin_share, saturation, slope, fading
        real(wp) :: march

        if (present(linear)) linear = 0.0_wp
        force = mu*ellipse%load
        if (force <= nothing) return
        call kalker_coefficients(ellipse%a/ellipse%b, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        g = combined_shear_modulus(material)
        ab = ellipse%a*ellipse%b
        law%weight = 1.0_wp
        law%a = ellipse%a
        law%b = ellipse%b
        law%y = ellipse%y

        ! Linear forces over mu N, and from them how far the patch slides and how far by spin.
        along = over_force(c%c11*g*ab*(creepage%cksi - ellipse%y*creepage%cphi), force)
        across = over_force(c%c22*g*ab*creepage%ceta, force)
        turning = over_force(c%c23*g*ab*sqrt(ab)*creepage%cphi, force)
        if (present(linear)) linear = sign([along, across, turning], &
                                           [creepage%cksi - ellipse%y*creepage%cphi, &
                                            creepage%ceta, creepage%cphi])
        saturation = along**2 + across**2 + turning**2
        spin_share = 0.0_wp
        if (saturation > 0.0_wp) spin_share = turning**2/saturation
        ! How much of the law of the march is left (S9); below one half all slides.
        march = 1.0_wp/(1.0_wp + (saturation/half_sliding**2)**2)
        saturation = sqrt(saturation)
        law%sliding = rise(saturation)
        saturation = saturation/(saturation + half_saturation)

        law%l1 = 2.0_wp*law%a*i1/(c%c11*g)
        law%l2 = 2.0_wp*law%a*i1/(c%c22*g)
        law%l3 = 2.0_wp/3.0_wp*law%a*sqrt(ellipse%a/ellipse%b)*i3/(c%c23*g)
        law%k1 = in_slip(law%l1, law%l3, spin_share, saturation)
        law%k2 = in_slip(law%l2, law%l3, spin_share, saturation)
        ! The slope that gives C33: int 2 y^2 xd^2 (a/xd)^gamma dy slope = C33 G (ab)^2.
        slope = c%c33*g/(2.0_wp*ellipse%b*j1)
        law%spin_slope = longitudinal_part/law%l1 + (1.0_wp - longitudinal_part)*slope
        fading = march*(1.0_wp - saturation**4)
        ! Given: the moment of a strip's bound.
        law%stretch_x = fading*(c%c23*sqrt(ellipse%b/ellipse%a)*g*law%l2*1.5_wp/(law%a*i3) &
                                - 1.0_wp)
        law%stretch_y = fading*(slope/law%spin_slope - 1.0_wp)
        law%exponent = 0.5_wp + march*(0.5_wp - flattening*saturation*spin_share)
        law%alpha = march*asymmetry*(1.0_wp - spin_share)
    end subroutine find_law

    !> Lateral force by a lateral creepage of one, linear, of the ellipse of a law, N.
    pure real(wp) function lateral_stiffness(law, ellipse) result(stiffness)
        type(patch_law_t), intent(in) :: law         !! of a patch with a load
        type(patch_ellipse_t), intent(in) :: ellipse !! its ellipse

        stiffness = 2.0_wp*i1*law%a/law%l2*ellipse%a*ellipse%b
    end function lateral_stiffness

    !> From 0 at `sliding_from` smoothly to 1 at `sliding_to`, by the logarithm.
    elemental real(wp) function rise(saturation)
        real(wp), intent(in) :: saturation

        real(wp) :: t

        rise = 0.0_wp
        if (saturation <= sliding_from) return
        t = min(log(saturation/sliding_from)/log(sliding_to/sliding_from), 1.0_wp)
        ! Given: the polynomial with two derivatives zero at both ends
        rise = t*t*t*(10.0_wp - t*(15.0_wp - 6.0_wp*t))
    end function rise

    !> Flexibility where the patch slides (S5).
    elemental real(wp) function in_slip(l, l3, spin_share, saturation)
        real(wp), intent(in) :: l, l3, spin_share, saturation

        in_slip = (l + (l3 - l)*spin_part*spin_share) &
                  /(1.0_wp + stiffening*saturation*spin_share)
    end function in_slip

    !> Add a law to a sum of laws.
    pure subroutine add_law(weight, law, total)
        real(wp), intent(in) :: weight            !! of the law
        type(patch_law_t), intent(in) :: law      !! one law
        type(patch_law_t), intent(inout) :: total !! the sum

        total%a = total%a + weight*law%a
        total%b = total%b + weight*law%b
        total%y = total%y + weight*law%y
        total%l1 = total%l1 + weight*law%l1
        total%l2 = total%l2 + weight*law%l2
        total%l3 = total%l3 + weight*law%l3
        total%k1 = total%k1 + weight*law%k1
        total%k2 = total%k2 + weight*law%k2
        total%spin_slope = total%spin_slope + weight*law%spin_slope
        total%stretch_x = total%stretch_x + weight*law%stretch_x
        total%stretch_y = total%stretch_y + weight*law%stretch_y
        total%exponent = total%exponent + weight*law%exponent
        total%alpha = total%alpha + weight*law%alpha
        total%sliding = total%sliding + weight*law%sliding
        total%weight = total%weight + weight
    end subroutine add_law

    !> The mean of the laws of a sum.
    pure type(patch_law_t) function mean_law(total) result(law)
        type(patch_law_t), intent(in) :: total !! a sum

        if (total%weight <= 0.0_wp) return
        call add_law(1.0_wp/total%weight, total, law)
        law%weight = 1.0_wp
    end function mean_law

    !> Are two sums of laws the same? Sums of the same laws with the same weights are, and those
    !> of other laws differ in their ellipses.
    pure logical function same_law(one, other)
        type(patch_law_t), intent(in) :: one, other !! sums

        same_law = one%weight == other%weight .and. one%a == other%a .and. one%y == other%y &
                   .and. one%l1 == other%l1
    end function same_law
end module faststrip_tangential_patch_law
