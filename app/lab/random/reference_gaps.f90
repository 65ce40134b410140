!> The contacts on which the tangential methods are calibrated and judged beyond S1002 on UIC60:
!> contact `number` is always the same one, gaps and all, in eight families of gaps.
module faststrip_lab_random_reference_gaps
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t, combined_shear_modulus, combined_poisson_ratio
    use faststrip_normal_simple_patch_ellipse, only: patch_ellipse_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_pressures, only: largest_patch
    use faststrip_lab_random_numbers, only: random_t, start_random, uniform, log_uniform, chance
    implicit none
    private

    public :: reference_scene_t, make_reference_scene, draw_creepage, scene_families

    !> What the families are called; two contacts in a row are of the same one, so that contacts
    !> with odd and even numbers are alike.
    character(len=14), parameter :: scene_families(8) = [character(len=14) :: &
        'two_radius', 'quartic', 'wavy', 'near_conformal', 'worn', 'flange_root', 'two_lobes', &
        'varying_a']

    integer, parameter :: seed = 20140601
    integer, parameter :: points = 801
    real(wp), parameter :: half_width = 24.0_wp, highest = 2.0_wp ! mm

    !> One contact; its creepages are drawn when its strips are known. Both bodies are alike.
    type, extends(contact_case_t) :: reference_scene_t
        integer :: number = 0          !! from 1
        integer :: family = 0          !! index of `scene_families`
        type(random_t) :: random       !! for the creepages
    end type reference_scene_t

contains

    !> Draw a contact.
    subroutine make_reference_scene(number, scene)
        integer, intent(in) :: number                !! from 1
        type(reference_scene_t), intent(out) :: scene !! drawn

        real(wp) :: youngs, poisson ! MPa, -

        scene%number = number
        scene%family = 1 + modulo((number - 1)/2, size(scene_families))
        call start_random(seed, number, scene%random)
        scene%load = log_uniform(scene%random, 1.5e4_wp, 1.5e5_wp)
        scene%mu = log_uniform(scene%random, 0.05_wp, 0.6_wp)
        ! Steel on steel, now and then something softer.
        youngs = 2.1e5_wp
        poisson = 0.28_wp
        if (chance(scene%random, 0.3_wp)) then
            youngs = log_uniform(scene%random, 5.0e4_wp, 2.1e5_wp)
            poisson = uniform(scene%random, 0.0_wp, 0.45_wp)
        end if
        scene%material = material_t(youngs, youngs, poisson, poisson)
        call draw_gap(scene)
    end subroutine make_reference_scene

    !> Draw creepages: slip that would take 0.1 to 2 times mu N by the linear theory of the
    !> largest patch, in any direction, and spin up to 0.01 over the patch's size, half of them
    !> less than a third of that. The reference point stays that of the gap, y = 0.
    subroutine draw_creepage(scene, strips, status)
        type(reference_scene_t), intent(inout) :: scene !! drawn
        type(contact_strips_t), intent(in) :: strips    !! its normal solution
        type(status_t), intent(out) :: status           !! from the library

        type(patch_ellipse_t) :: ellipse
        type(kalker_coefficients_t) :: c
        real(wp) :: share, direction, g_ab, spin

        ellipse = largest_patch(strips)
        call kalker_coefficients(ellipse%a/ellipse%b, &
                                 combined_poisson_ratio(scene%material), c, status)
        if (is_error(status)) return
        g_ab = combined_shear_modulus(scene%material)*ellipse%a*ellipse%b
        share = log_uniform(scene%random, 0.1_wp, 2.0_wp)*scene%mu*ellipse%load
        direction = uniform(scene%random, -pi, pi)
        spin = uniform(scene%random, -1.0_wp, 1.0_wp)*0.01_wp
        if (chance(scene%random, 0.5_wp)) spin = spin*uniform(scene%random, 0.0_wp, 1.0_wp)/3.0_wp
        scene%creepage%cphi = spin/sqrt(ellipse%a*ellipse%b)
        ! What the spin makes of longitudinal creepage at the patch is no part of the draw.
        scene%creepage%cksi = share*cos(direction)/(c%c11*g_ab) + ellipse%y*scene%creepage%cphi
        scene%creepage%ceta = share*sin(direction)/(c%c22*g_ab)
    end subroutine draw_creepage

    !> The gap: curvature of the family integrated twice, lowest point at zero.
    subroutine draw_gap(scene)
        type(reference_scene_t), intent(inout) :: scene

        real(wp), dimension(points) :: y, h, inv2r, slope
        real(wp) :: a0, r1, r2, p1, p2, p3, step
        integer :: i, n

        step = 2.0_wp*half_width/(points - 1)
        y = [(-half_width + (i - 1)*step, i=1, points)]
        a0 = 0.5_wp/uniform(scene%random, 250.0_wp, 600.0_wp)
        inv2r = a0
        select case (trim(scene_families(scene%family)))
        case ('two_radius')
            r1 = log_uniform(scene%random, 30.0_wp, 800.0_wp)
            r2 = log_uniform(scene%random, 30.0_wp, 800.0_wp)
            p1 = uniform(scene%random, -1.5_wp, 1.5_wp)
            h = 0.5_wp*(y - p1)**2/merge(r1, r2, y < p1)
        case ('quartic')
            r1 = log_uniform(scene%random, 100.0_wp, 2000.0_wp)
            p1 = log_uniform(scene%random, 1.0e-7_wp, 1.0e-5_wp)
            p2 = uniform(scene%random, -2.0_wp, 2.0_wp)
            h = 0.5_wp*y**2/r1 + p1*(y - p2)**4
        case ('wavy')
            r1 = log_uniform(scene%random, 80.0_wp, 400.0_wp)
            p1 = uniform(scene%random, 1.0e-3_wp, 6.0e-3_wp)
            p2 = uniform(scene%random, 4.0_wp, 12.0_wp)
            p3 = uniform(scene%random, 0.0_wp, 2.0_wp*pi)
            h = 0.5_wp*y**2/r1 + p1*cos(2.0_wp*pi*y/p2 + p3)
        case ('near_conformal')
            r1 = log_uniform(scene%random, 800.0_wp, 5000.0_wp)
            p1 = uniform(scene%random, 4.0_wp, 9.0_wp)
            p2 = uniform(scene%random, 4.0_wp, 9.0_wp)
            r2 = log_uniform(scene%random, 15.0_wp, 60.0_wp)
            h = 0.5_wp*y**2/r1 + 0.5_wp*(max(y - p1, 0.0_wp)**2 + max(-p2 - y, 0.0_wp)**2)/r2
        case ('worn', 'flange_root')
            if (scene_families(scene%family) == 'worn') then
                r1 = log_uniform(scene%random, 60.0_wp, 300.0_wp)
                r2 = log_uniform(scene%random, 300.0_wp, 3000.0_wp)
                p1 = uniform(scene%random, -3.0_wp, 3.0_wp)
                p2 = uniform(scene%random, 1.0_wp, 4.0_wp)
            else
                r1 = log_uniform(scene%random, 12.0_wp, 40.0_wp)
                r2 = log_uniform(scene%random, 100.0_wp, 600.0_wp)
                p1 = uniform(scene%random, 0.0_wp, 5.0_wp)
                p2 = uniform(scene%random, 0.5_wp, 3.0_wp)
                inv2r = a0*(1.0_wp + 0.02_wp*(y + half_width))
            end if
            if (chance(scene%random, 0.5_wp)) y = -y
            slope = 0.5_wp*(1.0_wp/r1 + 1.0_wp/r2) + 0.5_wp*(1.0_wp/r1 - 1.0_wp/r2) &
                    *tanh((y - p1)/p2)
            y = [(-half_width + (i - 1)*step, i=1, points)]
            call integrate(slope, step)
            slope = slope - slope((points + 1)/2)
            h = slope
            call integrate(h, step)
        case ('two_lobes')
            p1 = uniform(scene%random, 3.0_wp, 8.0_wp)
            p2 = log_uniform(scene%random, 5.0e-3_wp, 0.1_wp)
            p3 = uniform(scene%random, -1.0_wp, 1.0_wp)*1.0e-3_wp
            h = p2*((y/p1)**2 - 1.0_wp)**2 + p3*y
        case ('varying_a')
            r1 = log_uniform(scene%random, 60.0_wp, 800.0_wp)
            p1 = uniform(scene%random, -0.05_wp, 0.05_wp)
            h = 0.5_wp*y**2/r1
            inv2r = a0*exp(p1*y)
        end select
        h = h - minval(h)
        n = count(h <= highest)
        allocate (scene%gap%y(n), scene%gap%h(n), scene%gap%inv2r(n), source=0.0_wp)
        scene%gap%y = pack(y, h <= highest)
        scene%gap%inv2r = pack(inv2r, h <= highest)
        scene%gap%h = pack(h, h <= highest)
    end subroutine draw_gap

    !> Replace values by their integral from the first on, trapezoidal rule.
    pure subroutine integrate(values, step)
        real(wp), intent(inout) :: values(:)
        real(wp), intent(in) :: step

        real(wp) :: last, total
        integer :: i

        total = 0.0_wp
        last = values(1)
        values(1) = 0.0_wp
        do i = 2, size(values)
            total = total + 0.5_wp*step*(last + values(i))
            last = values(i)
            values(i) = total
        end do
    end subroutine integrate
end module faststrip_lab_random_reference_gaps
