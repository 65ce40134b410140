!> Random gaps of kinds that no correction or estimate was fitted to, on which claims are judged.
!>
!> Shapes are drawn in units of a Hertz ellipse: t = y/b, heights over B b^2. Kinds of
!> `faststrip_lab_random_gaps` are drawn there; what the others do to that ellipse's gap `t^2`,
!> 1/(2R) = constant, says `draw_shape`. Families from which is fitted are those of
!> `faststrip_lab_random_force_gaps`.
module faststrip_lab_random_claim_gaps
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, is_error
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_lab_random_force_gaps, only: curvature_ratio
    use faststrip_lab_random_gaps, only: draw_family_gap, family_names
    use faststrip_lab_random_numbers, only: random_t, uniform, log_uniform, chance, normal
    implicit none
    private

    public :: draw_claim_gap, gap_kinds

    !> What the kinds are called.
    character(len=12), parameter :: gap_kinds(12) = [character(len=12) :: &
        'several', 'small_second', 'flat_top', 'conformal', 'wavy', 'kinks', 'radius_wave', &
        'step', 'two_powers', 'noisy', 'three_places', 'corner']

    ! The gap reaches from -reach to reach.
    real(wp), parameter :: reach = 6.0_wp
    integer, parameter :: fine_points = 961

contains

    !> Draw a gap; one draw a statement, for the order within one is the compiler's.
    subroutine draw_claim_gap(random, kind, compliance, load, gap)
        type(random_t), intent(inout) :: random
        character(len=*), intent(in) :: kind !! one of `gap_kinds`
        real(wp), intent(in) :: compliance   !! H of eq. (4), 1/MPa
        real(wp), intent(in) :: load         !! N
        type(gap_t), intent(out) :: gap      !! its lowest height is 0

        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp), allocatable :: t(:)
        real(wp) :: a0, b0
        integer :: i, n, family

        a0 = 0.5_wp/log_uniform(random, 200.0_wp, 800.0_wp)
        b0 = a0*curvature_ratio(log_uniform(random, 0.2_wp, 5.0_wp))
        call hertz_solve(compliance, a0, b0, load, hertz, status)
        n = fine_points
        if (kind == 'noisy') n = nint(2.0_wp*reach*hertz%b/uniform(random, 0.1_wp, 0.3_wp))
        t = [(reach*(2.0_wp*(i - 1)/real(n - 1, wp) - 1.0_wp), i=1, n)]
        family = findloc(family_names == kind, .true., dim=1)
        if (family > 0) then
            call draw_family_gap(random, family, a0, b0, hertz, t, gap)
        else
            allocate (gap%h(n), gap%inv2r(n), source=0.0_wp)
            call draw_shape(random, kind, hertz%penetration/(b0*hertz%b**2), t, gap%h, gap%inv2r)
            gap%y = hertz%b*t
            gap%h = b0*hertz%b**2*gap%h
            gap%inv2r = a0*gap%inv2r
            if (kind == 'noisy') call measure(random, gap)
        end if
        gap%h = gap%h - minval(gap%h)
    end subroutine draw_claim_gap

    !> Heights and longitudinal terms of a shape in its own units.
    subroutine draw_shape(random, kind, penetration, t, h, a)
        type(random_t), intent(inout) :: random
        character(len=*), intent(in) :: kind
        real(wp), intent(in) :: penetration ! of the Hertz ellipse
        real(wp), intent(in) :: t(:)        ! places
        real(wp), intent(inout) :: h(:)     ! heights
        real(wp), intent(inout) :: a(:)     ! 1/(2R)

        real(wp) :: p, q, r, side

        side = merge(1.0_wp, -1.0_wp, chance(random, 0.5_wp))
        h = t**2
        a = 1.0_wp
        select case (kind)
        case ('radius_wave')
            p = uniform(random, 0.2_wp, 0.8_wp)
            q = log_uniform(random, 0.5_wp, 5.0_wp)
            a = 1.0_wp + p*sin(q*t + uniform(random, 0.0_wp, 2.0_wp*pi))
        case ('step')
            ! Another radius from about the edge of the patch on, longitudinally too.
            p = uniform(random, 0.5_wp, 1.05_wp)
            q = 10.0_wp**uniform(random, 0.4_wp, 1.6_wp)
            if (chance(random, 0.3_wp)) q = 1.0_wp/q
            h = h + (q - 1.0_wp)*max(side*t - p, 0.0_wp)**2
            r = log_uniform(random, 0.6_wp, 1.6_wp)
            a = r**(0.5_wp + 0.5_wp*tanh((side*t - p)/0.1_wp))
        case ('two_powers')
            p = uniform(random, 1.3_wp, 4.0_wp)
            q = uniform(random, 1.3_wp, 4.0_wp)
            r = log_uniform(random, 0.3_wp, 3.0_wp)
            h = merge(r*abs(t)**p, abs(t)**q, t < 0.0_wp)
        case ('noisy')
            p = 10.0_wp**uniform(random, -0.7_wp, 0.7_wp)
            where (t > 0.0_wp) h = p*t**2
            p = uniform(random, -0.3_wp, 0.3_wp)
            a = exp(max(-1.0_wp, min(1.0_wp, p*t)))
        case ('three_places')
            h = log_uniform(random, 1.0_wp, 6.0_wp)*t**2
            p = uniform(random, 0.8_wp, 2.5_wp)
            q = log_uniform(random, 1.0_wp, 10.0_wp)
            r = penetration*uniform(random, -0.2_wp, 0.5_wp)
            h = min(h, r + q*(t - p)**2)
            p = uniform(random, 0.8_wp, 2.5_wp)
            q = log_uniform(random, 1.0_wp, 10.0_wp)
            r = penetration*uniform(random, -0.2_wp, 0.5_wp)
            h = min(h, r + q*(t + p)**2)
        case ('corner')
            ! A rail's head that ends in a corner of some millimetres' radius, rounded, and a wheel
            ! whose radius grows towards its flange.
            p = uniform(random, 0.0_wp, 0.9_wp)
            q = log_uniform(random, 8.0_wp, 100.0_wp)
            r = log_uniform(random, 0.02_wp, 0.3_wp)
            h = log_uniform(random, 0.2_wp, 1.5_wp)*t**2 &
                + 0.25_wp*q*(side*t - p + sqrt((side*t - p)**2 + r**2))**2
            p = uniform(random, 0.0_wp, 0.25_wp)
            a = exp(-p*max(-4.0_wp, min(4.0_wp, side*t)))
        end select
    end subroutine draw_shape

    !> What a profile gauge makes of heights, smoothed as measured ones have to be.
    subroutine measure(random, gap)
        type(random_t), intent(inout) :: random
        type(gap_t), intent(inout) :: gap

        type(gap_t) :: smooth
        type(status_t) :: status
        real(wp) :: noise, change ! mm
        integer :: i

        noise = log_uniform(random, 1.0e-3_wp, 1.0e-2_wp)
        do i = 1, size(gap%h)
            gap%h(i) = gap%h(i) + noise*normal(random)
        end do
        call smooth_gap(gap, noise, smooth, change, status)
        if (.not. is_error(status)) gap = smooth
    end subroutine measure
end module faststrip_lab_random_claim_gaps
