!> Random gaps of one contact patch each, from which corrections of the creep forces are fitted.
!>
!> Shapes are drawn in units of a Hertz ellipse: t = y/b, heights over B b^2. What a family does
!> to that ellipse's gap `t^2`, 1/(2R) = constant, says `draw_shape`.
module faststrip_lab_random_force_gaps
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_numerics_elliptic, only: complete_elliptic, complete_elliptic_d
    use faststrip_lab_random_numbers, only: random_t, uniform, log_uniform, chance, pick
    implicit none
    private

    public :: draw_force_gap, force_family, force_families, curvature_ratio

    !> What the families are called.
    character(len=9), parameter :: force_families(15) = [character(len=9) :: &
        'ellipse', 'quartic', 'unequal', 'wedge', 'waisted', 'tanh', 'exp', 'worn', 'hollow', &
        'power', 'flat', 'double', 'wheel', 'mixed', &
        'zones']
    ! Of 17 contacts in a row five are ellipses; the last two families come only when asked for.
    integer, parameter :: ellipses = 5, in_turn = 13
    ! The gap reaches from -reach to reach.
    real(wp), parameter :: reach = 6.0_wp
    integer, parameter :: fine_points = 961

contains

    !> The family of a contact, an index of `force_families`.
    pure integer function force_family(number) result(family)
        integer, intent(in) :: number !! of the contact, from 1

        family = max(1, 1 + modulo(number - 1, in_turn + ellipses - 1) &
                     - (ellipses - 1))
    end function force_family

    !> Draw a gap; one draw a statement, for the order within one is the compiler's.
    subroutine draw_force_gap(random, family, compliance, load, gap)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family       !! index of `force_families`
        real(wp), intent(in) :: compliance  !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load        !! N
        type(gap_t), intent(out) :: gap     !! its lowest height is 0

        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp), allocatable :: t(:)
        real(wp) :: a0, b0, proportion
        integer :: i, n

        a0 = 0.5_wp/log_uniform(random, 200.0_wp, 800.0_wp)
        if (force_families(family) == 'ellipse') then
            proportion = log_uniform(random, 0.05_wp, 20.0_wp)
        else
            proportion = log_uniform(random, 0.1_wp, 10.0_wp)
        end if
        b0 = a0*curvature_ratio(proportion)
        call hertz_solve(compliance, a0, b0, load, hertz, status)
        n = fine_points
        if (force_families(family) == 'wheel') &
            n = nint(2.0_wp*reach/log_uniform(random, 0.03_wp, 0.15_wp))
        t = [(reach*(2.0_wp*(i - 1)/real(n - 1, wp) - 1.0_wp), i=1, n)]
        allocate (gap%h(n), gap%inv2r(n), source=0.0_wp)
        call draw_shape(random, force_families(family), t, gap%h, gap%inv2r)
        gap%y = hertz%b*t
        gap%h = b0*hertz%b**2*(gap%h - minval(gap%h))
        gap%inv2r = a0*gap%inv2r
    end subroutine draw_force_gap

    !> B/A of the Hertz ellipse of a/b.
    pure real(wp) function curvature_ratio(a_over_b) result(ratio)
        real(wp), intent(in) :: a_over_b !! > 0

        real(wp) :: m1, k, e, d

        m1 = min(a_over_b, 1.0_wp/a_over_b)**2
        call complete_elliptic(m1, k, e)
        d = complete_elliptic_d(m1)
        ! Curvature across the long axis over that along it.
        ratio = (k - d)/(m1*d)
        if (a_over_b < 1.0_wp) ratio = 1.0_wp/ratio
    end function curvature_ratio

    !> Heights and longitudinal terms of a shape in its own units.
    subroutine draw_shape(random, family, t, h, a)
        type(random_t), intent(inout) :: random
        character(len=*), intent(in) :: family
        real(wp), intent(in) :: t(:)      ! places
        real(wp), intent(inout) :: h(:)   ! heights
        real(wp), intent(inout) :: a(:)   ! 1/(2R)

        real(wp) :: p, q, r, side

        side = merge(1.0_wp, -1.0_wp, chance(random, 0.5_wp))
        h = t**2
        a = 1.0_wp
        select case (family)
        case ('quartic')
            p = uniform(random, -0.4_wp, 0.4_wp)
            q = uniform(random, 0.0_wp, 0.5_wp)
            h = q*t**2 + log_uniform(random, 0.1_wp, 3.0_wp)*(t - p)**4
        case ('unequal')
            p = 10.0_wp**uniform(random, -1.5_wp, 1.5_wp)
            where (t > 0.0_wp) h = p*t**2
        case ('wedge')
            p = 10.0_wp**uniform(random, 0.0_wp, 1.6_wp)
            q = uniform(random, 1.2_wp, 3.0_wp)
            h = merge(p*t**2, abs(t)**q, side*t < 0.0_wp)
        case ('waisted')
            p = uniform(random, 1.0_wp, 5.0_wp)
            q = uniform(random, 0.2_wp, 6.0_wp)/p**2
            h = h + q*cos(p*t + uniform(random, 0.0_wp, 2.0_wp*pi))
        case ('tanh')
            p = uniform(random, -1.3_wp, 1.3_wp)
            q = uniform(random, -0.5_wp, 0.5_wp)
            a = exp(p*tanh((t - q)*log_uniform(random, 0.5_wp, 5.0_wp)))
        case ('exp')
            p = uniform(random, -1.2_wp, 1.2_wp)
            a = exp(max(-2.5_wp, min(2.5_wp, p*t)))
        case ('worn')
            p = uniform(random, 0.2_wp, 1.35_wp)
            if (chance(random, 0.3_wp)) p = -0.5_wp*p
            q = uniform(random, -1.2_wp, 1.2_wp)
            r = uniform(random, 0.3_wp, 1.2_wp)
            h = h + p*exp(-((t - q)/r)**2)
        case ('hollow')
            p = uniform(random, 0.18_wp, 1.1_wp)
            q = uniform(random, -0.9_wp, 0.9_wp)
            r = uniform(random, 0.45_wp, 1.5_wp)
            h = h + p*exp(-((t - q)/r)**2)
        case ('power')
            h = abs(t)**uniform(random, 1.4_wp, 3.5_wp)
        case ('flat')
            p = uniform(random, 0.05_wp, 1.0_wp)
            h = p*t**2
            call add_bend(random, side, t, p, h)
            if (chance(random, 0.7_wp)) call add_bend(random, -side, t, p, h)
        case ('double')
            p = uniform(random, 0.3_wp, 1.25_wp)
            h = ((t**2 - p**2)/(2.0_wp*p))**2
            if (chance(random, 0.7_wp)) h = h + uniform(random, -0.2_wp, 0.2_wp)*t
        case ('wheel')
            call draw_arcs(random, t, h)
        case ('mixed')
            call draw_arcs(random, t, h)
            if (chance(random, 0.5_wp)) then
                p = 10.0_wp**uniform(random, -0.8_wp, 0.8_wp)
                where (t > 0.0_wp) h = p*h
            end if
            if (chance(random, 0.5_wp)) then
                p = uniform(random, -0.3_wp, 0.6_wp)
                q = uniform(random, -1.0_wp, 1.0_wp)
                r = uniform(random, 0.3_wp, 1.2_wp)
                h = h + p*exp(-((t - q)/r)**2)
            end if
            if (chance(random, 0.3_wp)) then
                p = uniform(random, 0.0_wp, 0.4_wp)
                q = uniform(random, 1.0_wp, 4.0_wp)
                h = h + p*cos(q*t + uniform(random, 0.0_wp, 2.0_wp*pi))
            end if
            p = uniform(random, -1.0_wp, 1.0_wp)
            q = uniform(random, -0.8_wp, 0.8_wp)
            a = exp(p*tanh((t - q)*log_uniform(random, 0.5_wp, 5.0_wp)))
        case ('zones')
            ! A sharp place beside a flat one, as where a wheel runs from the rail's head to its
            ! corner; the lower of both counts, rounded.
            p = 10.0_wp**uniform(random, -1.6_wp, 0.0_wp)
            q = uniform(random, 0.3_wp, 2.5_wp)
            r = uniform(random, -0.4_wp, 0.4_wp)
            h = p*(side*t - q)**2 + r - t**2
            r = log_uniform(random, 0.01_wp, 0.3_wp)
            h = t**2 + 0.5_wp*(h - sqrt(h**2 + r**2))
            p = uniform(random, -0.6_wp, 0.6_wp)
            a = exp(p*tanh(side*t*log_uniform(random, 0.5_wp, 5.0_wp)))
        end select
        ! A wheel's radius varies across the patch.
        if (any(family == [character(len=9) :: 'ellipse', 'tanh', 'exp', 'mixed', 'zones'])) return
        if (.not. chance(random, 0.3_wp)) return
        p = uniform(random, -0.5_wp, 0.5_wp)
        a = exp(max(-1.5_wp, min(1.5_wp, p*t)))
    end subroutine draw_shape

    !> A smaller radius from a joint on, as of a rail's head.
    subroutine add_bend(random, side, t, bend, h)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: side, t(:), bend
        real(wp), intent(inout) :: h(:)

        real(wp) :: joint, more

        joint = uniform(random, 0.0_wp, 1.5_wp)
        more = bend*(log_uniform(random, 1.2_wp, 15.0_wp) - 1.0_wp)
        h = h + more*max(side*t - joint, 0.0_wp)**2
    end subroutine add_bend

    !> Arcs of any radii, joined without a kink; level in the middle.
    subroutine draw_arcs(random, t, h)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: t(:)
        real(wp), intent(out) :: h(:)

        real(wp) :: bend, next, joint, slope
        integer :: arc

        bend = log_uniform(random, 0.2_wp, 4.0_wp)
        h = bend*t**2
        slope = 0.0_wp
        do arc = 1, 2 + pick(random, 4)
            next = log_uniform(random, 0.2_wp, 4.0_wp)
            joint = uniform(random, -1.8_wp, 1.8_wp)
            h = h + (next - bend)*max(t - joint, 0.0_wp)**2
            slope = slope + 2.0_wp*(next - bend)*max(-joint, 0.0_wp)
            bend = next
        end do
        h = h - slope*t
    end subroutine draw_arcs
end module faststrip_lab_random_force_gaps
