!> Creep force laws: forces of an ellipse from its creepages in closed form, nothing inside it.
!>
!> All start from Kalker's linear theory (J. J. Kalker 1967, 1990) at the middle of the ellipse,
!> semi-axes a along the rolling direction and b across, G and nu those of both bodies:
!>
!>     Fx = -C11 G ab cksi,   Fy = -C22 G ab ceta - C23 G (ab)^1.5 cphi,
!>     Mz =  C23 G (ab)^1.5 ceta - C33 G (ab)^2 cphi
!>
!> `law_linear`: that, without a bound: it is right where nothing slides and no further.
!>
!> `law_shen_hedrick_elkins` (Z. Y. Shen, J. K. Hedrick, J. A. Elkins, A comparison of alternative
!> creep force models for rail vehicle dynamic analysis, Proc. 8th IAVSD Symposium, 1983): the
!> linear force vector shortened by the cubic of Vermeulen and Johnson,
!>
!>     F/(mu N) = tau - tau^2/3 + tau^3/27 up to tau = 3, then 1,   tau = |linear force|/(mu N).
!>
!> It has no moment of its own.
!>
!> `law_polach` (O. Polach, A fast wheel-rail forces calculation computer code, Vehicle System
!> Dynamics Supplement 33 (1999) 728-739; Creep forces in simulations of traction vehicles running
!> on adhesion limit, Wear 258 (2005) 992-1000, here with k_A = k_S = 1 and constant friction):
!>
!>     s = |(cksi, ceta)|,  s_yc = ceta + a cphi if that is the larger, else ceta,
!>     s_c = |(cksi, s_yc)|,  C = |(C11 cksi, C22 ceta)|/s
!>     eps   = (pi/4) G ab C s_c/(mu N),   F = (2/pi) mu N [eps/(1 + eps^2) + atan eps]
!>     K     = 1 + 6.3 (1 - exp(-a/b)),   eps_s = (8/3) G b sqrt(ab) C23 |s_yc|/(K mu N)
!>     F_s   = (9/16) a mu N K [eps_s (-delta^3/3 + delta^2/2 - 1/6) + (1 - delta^2)^1.5/3]
!>           = (3/8) a mu N K eps_s/(1 + eps_s^2)^2,   delta = (eps_s^2 - 1)/(eps_s^2 + 1)
!>     Fx = -F cksi/s_c,   Fy = -(F ceta + F_s cphi)/s_c
!>
!> It has no moment of its own.
!>
!> Deviations from their authors:
!>
!> - **L1** (Polach) The sum of both parts, which may exceed mu N (by up to a third with strong
!>   spin), is shortened to mu N.
!> - **L2** (all) The moment about the reference point has the arm of the force, `-y0 Fx`, in
!>   addition to the law's own.
!> - **L3** (all) The friction power is what the creepages feed in, `-(Fx cksi + Fy ceta +
!>   Mz cphi)`, all of which turns into heat in steady rolling; below zero it counts as zero.
!>
!> None of them knows where a patch sticks; the stick fraction is 1 for the linear theory and 0,
!> without a meaning, for the others.
module faststrip_tangential_laws
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_limits, only: nothing
    use faststrip_base_status, only: status_t, set_status, is_error, st_bad_argument
    use faststrip_base_material, only: material_t, check_material, combined_shear_modulus, &
                                       combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_normal_simple_hertz, only: hertz_t
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t, patch_ellipse, patch_end, &
                                                     check_strips
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_motion, only: check_motion, check_ellipse, over_force
    use faststrip_tangential_strip_slip, only: curved_motion
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: law_solve, law_strips_solve, law_linear, law_shen_hedrick_elkins, law_polach

    ! Given: numbers of kinds.
    integer, parameter :: law_linear = 1              !! Kalker's linear theory
    integer, parameter :: law_shen_hedrick_elkins = 2 !! cubic saturation
    integer, parameter :: law_polach = 3              !! Polach's, with his spin

contains

    !> Forces by a law on a Hertz ellipse.
    pure subroutine law_solve(law, hertz, material, mu, creepage, result, status, strips)
        integer, intent(in) :: law                   !! one of the three
        type(hertz_t), intent(in) :: hertz           !! the ellipse, centred at y = hertz%y
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, rail relative to wheel
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument` (law, no ellipse, mu < 0), `st_not_finite`, `st_bad_material`,
            !! `st_out_of_range` (creepages, mu, a/b)
        type(contact_strips_t), intent(in), optional :: strips
            !! of the ellipse, laid: on a curved surface it rolls with their mean

        type(creepage_t) :: motion

        call check_input(law, material, mu, creepage, status)
        if (is_error(status)) return
        call check_ellipse(hertz, status)
        if (is_error(status)) return
        motion = creepage
        if (present(strips)) motion = curved_motion(strips, 1, strips%n, creepage)
        call add_ellipse(law, patch_ellipse_t(hertz%a, hertz%b, hertz%y, hertz%load), material, &
                         mu, motion, result, status)
        if (law == law_linear) result%stick_fraction = 1.0_wp
    end subroutine law_solve

    !> Forces by a law on the virtual ellipses of any contact patches (`patch_ellipse`).
    pure subroutine law_strips_solve(law, strips, material, mu, creepage, result, status)
        integer, intent(in) :: law                   !! one of the three
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(material_t), intent(in) :: material     !! moduli in MPa
        real(wp), intent(in) :: mu                   !! coefficient of friction, >= 0
        type(creepage_t), intent(in) :: creepage     !! about y = 0, rail relative to wheel
        type(tangential_result_t), intent(out) :: result !! sums; zero when there is an error
        type(status_t), intent(out) :: status
            !! those of `law_solve`, and of `check_strips`

        integer :: first, last

        call check_input(law, material, mu, creepage, status)
        if (is_error(status)) return
        call check_strips(strips, status)
        if (is_error(status)) return
        last = 0
        do while (last < strips%n)
            first = last + 1
            last = patch_end(strips, first)
            call add_ellipse(law, patch_ellipse(strips, first, last), material, mu, &
                             curved_motion(strips, first, last, creepage), result, status)
            if (is_error(status)) then
                result = tangential_result_t()
                return
            end if
        end do
        if (law == law_linear) result%stick_fraction = 1.0_wp
    end subroutine law_strips_solve

    pure subroutine check_input(law, material, mu, creepage, status)
        integer, intent(in) :: law
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(status_t), intent(out) :: status

        if (law < law_linear .or. law > law_polach) then
            call set_status(status, st_bad_argument, 'no such creep force law')
            return
        end if
        call check_motion(mu, creepage, status)
        if (is_error(status)) return
        call check_material(material, status)
    end subroutine check_input

    !> Add the forces of one ellipse; one without load adds nothing.
    pure subroutine add_ellipse(law, ellipse, material, mu, creepage, result, status)
        integer, intent(in) :: law
        type(patch_ellipse_t), intent(in) :: ellipse
        type(material_t), intent(in) :: material
        real(wp), intent(in) :: mu
        type(creepage_t), intent(in) :: creepage
        type(tangential_result_t), intent(inout) :: result
        type(status_t), intent(inout) :: status

        type(kalker_coefficients_t) :: c
        real(wp) :: g, ab, cksi, force, fx, fy, mz

        if (ellipse%load <= nothing) return
        call kalker_coefficients(ellipse%a/ellipse%b, combined_poisson_ratio(material), c, status)
        if (is_error(status)) return
        g = combined_shear_modulus(material)
        ab = ellipse%a*ellipse%b
        force = mu*ellipse%load
        if (force <= nothing .and. law /= law_linear) return
        ! Motion at the middle of the ellipse.
        cksi = creepage%cksi - ellipse%y*creepage%cphi
        fx = -c%c11*g*ab*cksi
        fy = -c%c22*g*ab*creepage%ceta - c%c23*g*ab*sqrt(ab)*creepage%cphi
        mz = 0.0_wp
        select case (law)
        case (law_linear)
            mz = c%c23*g*ab*sqrt(ab)*creepage%ceta - c%c33*g*ab**2*creepage%cphi
        case (law_shen_hedrick_elkins)
            call shorten(force, fx, fy)
        case (law_polach)
            call polach_force(ellipse, c, g, force, creepage_t(cksi, creepage%ceta, &
                                                               creepage%cphi), fx, fy)
        end select
        result%fx = result%fx + fx
        result%fy = result%fy + fy
        result%mz = result%mz + mz - ellipse%y*fx
        result%friction_power = result%friction_power &
                                - min(fx*cksi + fy*creepage%ceta + mz*creepage%cphi, 0.0_wp)
    end subroutine add_ellipse

    !> The cubic of Vermeulen and Johnson.
    pure subroutine shorten(force, fx, fy)
        real(wp), intent(in) :: force      !! mu N, N
        real(wp), intent(inout) :: fx, fy  !! linear, then saturated, N

        real(wp) :: linear, tau, factor

        linear = hypot(fx, fy)
        tau = over_force(linear, force)
        if (tau < 3.0_wp) then
            factor = 1.0_wp - tau/3.0_wp + tau*tau/27.0_wp ! Given: Johnson's cubic
        else
            factor = force/linear
        end if
        fx = fx*factor
        fy = fy*factor
    end subroutine shorten

    !> Polach's force.
    pure subroutine polach_force(ellipse, c, g, force, creepage, fx, fy)
        type(patch_ellipse_t), intent(in) :: ellipse
        type(kalker_coefficients_t), intent(in) :: c
        real(wp), intent(in) :: g                !! shear modulus, MPa
        real(wp), intent(in) :: force            !! mu N, N
        type(creepage_t), intent(in) :: creepage !! at the middle of the ellipse
        real(wp), intent(out) :: fx, fy          !! N

        real(wp) :: ab, s, s_yc, s_c, stiffness, eps, eps_s, k, pull, spin_pull, total

        fx = 0.0_wp
        fy = 0.0_wp
        ab = ellipse%a*ellipse%b
        s = hypot(creepage%cksi, creepage%ceta)
        s_yc = creepage%ceta + ellipse%a*creepage%cphi
        if (abs(s_yc) <= abs(creepage%ceta)) s_yc = creepage%ceta
        s_c = hypot(creepage%cksi, s_yc)
        if (s_c <= tiny(1.0_wp)) return
        stiffness = 0.0_wp
        if (s > 0.0_wp) stiffness = hypot(c%c11*(creepage%cksi/s), c%c22*(creepage%ceta/s))
        eps = over_force(0.25_wp*pi*g*ab*stiffness*s_c, force)
        pull = 2.0_wp/pi*force*(eps/(1.0_wp + eps*eps) + atan(eps))
        k = 1.0_wp + 6.3_wp*(1.0_wp - exp(-ellipse%a/ellipse%b)) ! Given: Polach
        ! Given: Polach
        eps_s = over_force(8.0_wp/3.0_wp*g*ellipse%b*sqrt(ab)*c%c23*abs(s_yc)/k, force)
        ! Given: Polach
        spin_pull = 3.0_wp/8.0_wp*ellipse%a*force*k*eps_s &
                    /(1.0_wp + eps_s*eps_s)**2
        fx = -pull*(creepage%cksi/s_c)
        fy = -pull*(creepage%ceta/s_c) - spin_pull*(creepage%cphi/s_c)
        total = hypot(fx, fy)
        if (total > force) then
            fx = fx*(force/total)
            fy = fy*(force/total)
        end if
    end subroutine polach_force
end module faststrip_tangential_laws
