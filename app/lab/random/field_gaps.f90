!> Random gaps as the field hands them over: cliffs and fill values, noise, ripples, worn and
!> kinked surfaces, coarse, fine and uneven points, offsets and mistaken units.
!>
!> Each family adds its one trouble to a smooth gap, a parabola whose Hertz ellipse sets the lengths
!> of the case. The numbers are those of railways: loads of 100 N to 1 MN, radii of 50 mm to 2 m.
module faststrip_lab_random_field_gaps
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_lab_random_gaps, only: fuzz_case_t
    use faststrip_lab_random_numbers, only: random_t, start_random, uniform, log_uniform, chance, &
                                            pick, normal
    implicit none
    private

    public :: make_field_case, field_family_names

    !> What the families are called.
    character(len=12), parameter :: field_family_names(16) = [character(len=12) :: &
        'cliff', 'fill', 'noise', 'exponential', 'tanh', 'ripples', 'neck', 'slender', 'worn', &
        'contacts', 'corner', 'coarse', 'fine', 'uneven', 'offset', 'metres']

    ! Values that stand for "not measured" in files.
    real(wp), parameter :: fill_values(4) = [1.0e10_wp, 999.0_wp, -999.0_wp, 1.0e5_wp]

    integer, parameter :: most_points = 8000, most_bumps = 5

    !> The smooth gap below the trouble.
    type :: base_t
        real(wp) :: a0 = 0.0_wp    !! longitudinal term, 1/mm
        real(wp) :: b0 = 0.0_wp    !! lateral term, 1/mm
        real(wp) :: b = 0.0_wp     !! lateral semi-axis of the Hertz ellipse, mm
        real(wp) :: depth = 0.0_wp !! its penetration, mm
    end type base_t

contains

    !> Draw a case.
    subroutine make_field_case(seed, number, case)
        integer, intent(in) :: seed              !! >= 0
        integer, intent(in) :: number            !! which case, >= 1
        type(fuzz_case_t), intent(out) :: case   !! the same for the same numbers; `family` is an
                                                 !! index of `field_family_names`

        ! Far from the numbers of the other families.
        integer, parameter :: own_series = 7654321
        type(random_t) :: random
        type(base_t) :: base

        call start_random(seed + own_series, number, random)
        case%number = number
        case%family = pick(random, size(field_family_names))
        case%methods%strips_per_patch = 4 + pick(random, 37)
        case%load = log_uniform(random, 1.0e2_wp, 1.0e6_wp)
        call draw_base(random, case%family, case%load, base)
        call draw_points(random, case%family, base, case%gap)
        case%gap%h = base%b0*case%gap%y**2
        case%gap%inv2r = base%a0 + 0.0_wp*case%gap%y
        call add_trouble(random, base, case)
    end subroutine make_field_case

    subroutine draw_base(random, family, load, base)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family
        real(wp), intent(in) :: load
        type(base_t), intent(out) :: base

        type(hertz_t) :: hertz
        type(status_t) :: status

        base%a0 = 0.5_wp/log_uniform(random, 50.0_wp, 2000.0_wp)
        base%b0 = base%a0*log_uniform(random, 0.1_wp, 20.0_wp)
        if (field_family_names(family) == 'slender') then
            base%b0 = base%a0*log_uniform(random, 1.0e-4_wp, 1.0e-2_wp)
            if (chance(random, 0.5_wp)) base%b0 = base%a0*log_uniform(random, 1.0e2_wp, 1.0e4_wp)
        end if
        call hertz_solve(normal_compliance(material_t()), base%a0, base%b0, load, hertz, status)
        base%b = hertz%b
        base%depth = hertz%penetration
    end subroutine draw_base

    !> Where the heights are known.
    subroutine draw_points(random, family, base, gap)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family
        type(base_t), intent(in) :: base
        type(gap_t), intent(inout) :: gap

        real(wp) :: from, to, step
        real(wp), allocatable :: width(:)
        integer :: i, n

        from = -base%b*uniform(random, 2.0_wp, 6.0_wp)
        to = base%b*uniform(random, 2.0_wp, 6.0_wp)
        if (chance(random, 0.3_wp)) to = -from
        select case (trim(field_family_names(family)))
        case ('cliff', 'fill')
            if (chance(random, 0.3_wp)) to = to + uniform(random, 5.0_wp, 100.0_wp)
            step = log_uniform(random, 0.01_wp, 1.0_wp)
            ! A contact that has points.
            step = max(min(step, base%b/5.0_wp), (to - from)/most_points)
            n = 1 + nint((to - from)/step)
        case ('coarse')
            n = 4 + pick(random, 26)
        case ('fine')
            n = nint(log_uniform(random, 5.0e3_wp, 5.0e4_wp))
        case default
            n = nint(log_uniform(random, 60.0_wp, 2000.0_wp))
        end select
        allocate (gap%y(n), gap%h(n), gap%inv2r(n), width(n))
        width = 1.0_wp
        if (field_family_names(family) == 'uneven') then
            do i = 1, n
                width(i) = log_uniform(random, 1.0e-3_wp, 1.0_wp)
            end do
        end if
        gap%y(1) = from
        do i = 2, n
            gap%y(i) = gap%y(i - 1) + width(i)
        end do
        gap%y = from + (to - from)*(gap%y - from)/(gap%y(n) - from)
    end subroutine draw_points

    !> What the family is about.
    subroutine add_trouble(random, base, case)
        type(random_t), intent(inout) :: random
        type(base_t), intent(in) :: base
        type(fuzz_case_t), intent(inout) :: case

        associate (y => case%gap%y, h => case%gap%h, inv2r => case%gap%inv2r)
            select case (trim(field_family_names(case%family)))
            case ('cliff', 'fill')
                call add_walls(random, base, field_family_names(case%family) == 'fill', case%gap)
            case ('noise')
                call add_noise(random, log_uniform(random, 3.0e-5_wp, 3.0e-3_wp), h)
            case ('exponential')
                inv2r = base%a0*exp(uniform(random, -1.5_wp, 1.5_wp)*y/base%b)
            case ('tanh')
                inv2r = base%a0*exp(0.5_wp*log(log_uniform(random, 0.05_wp, 20.0_wp)) &
                                    *(1.0_wp + tanh((y/base%b - uniform(random, -1.0_wp, 1.0_wp)) &
                                                    /log_uniform(random, 0.03_wp, 1.0_wp))))
            case ('ripples')
                h = h + log_uniform(random, 1.0e-5_wp, 5.0e-3_wp) &
                    *sin(2.0_wp*pi*y/log_uniform(random, 0.2_wp, 5.0_wp) &
                         + uniform(random, 0.0_wp, 2.0_wp*pi))
            case ('neck')
                ! A hump in the middle, up to twice as high as the contact is deep.
                h = h + base%depth*uniform(random, 0.0_wp, 2.0_wp) &
                    *exp(-((y/base%b - uniform(random, -0.5_wp, 0.5_wp)) &
                           /log_uniform(random, 0.05_wp, 0.5_wp))**2)
            case ('worn')
                call add_wear(random, base, case%gap)
            case ('contacts')
                call add_contacts(random, base, case%gap)
            case ('corner')
                call add_corners(random, base, case%gap)
            case ('offset')
                h = h + uniform(random, 0.0_wp, 10.0_wp)
                y = y + log_uniform(random, 10.0_wp, 1.0e4_wp)*merge(1.0_wp, -1.0_wp, &
                                                                    chance(random, 0.5_wp))
            case ('metres')
                call change_unit(random, case)
            end select
        end associate
    end subroutine add_trouble

    !> One wall or two, at the edge of the contact or far away, 1 um to 1 km high, or the points
    !> behind it filled with a value that stands for none.
    subroutine add_walls(random, base, fill, gap)
        type(random_t), intent(inout) :: random
        type(base_t), intent(in) :: base
        logical, intent(in) :: fill
        type(gap_t), intent(inout) :: gap

        real(wp) :: at, height
        integer :: side, sides

        sides = pick(random, 2)
        do side = 1, sides
            at = base%b*uniform(random, 0.6_wp, 1.3_wp)
            if (chance(random, 0.6_wp)) &
                at = base%b*1.3_wp + uniform(random, 0.0_wp, 0.8_wp) &
                     *max(maxval(abs(gap%y)) - 1.3_wp*base%b, 0.0_wp)
            height = log_uniform(random, 1.0e-3_wp, 1.0e6_wp)
            if (fill) height = fill_values(pick(random, size(fill_values)))
            where (merge(gap%y, -gap%y, side == 1) > at)
                gap%h = merge(height, gap%h + height, fill)
            end where
        end do
    end subroutine add_walls

    subroutine add_noise(random, deviation, h)
        type(random_t), intent(inout) :: random
        real(wp), intent(in) :: deviation ! mm
        real(wp), intent(inout) :: h(:)

        integer :: i

        do i = 1, size(h)
            h(i) = h(i) + deviation*normal(random)
        end do
    end subroutine add_noise

    !> Hollows and humps, and a longitudinal radius that goes with them.
    subroutine add_wear(random, base, gap)
        type(random_t), intent(inout) :: random
        type(base_t), intent(in) :: base
        type(gap_t), intent(inout) :: gap

        real(wp) :: hump(size(gap%y)), at, width
        integer :: i

        do i = 1, pick(random, most_bumps)
            at = uniform(random, -2.0_wp, 2.0_wp)
            width = log_uniform(random, 0.2_wp, 2.0_wp)
            hump = exp(-((gap%y/base%b - at)/width)**2)
            gap%h = gap%h + base%depth*uniform(random, -0.7_wp, 0.7_wp)*hump
            gap%inv2r = gap%inv2r*(1.0_wp + uniform(random, -0.15_wp, 0.15_wp)*hump)
        end do
    end subroutine add_wear

    !> Two to five parabolas of unlike bends, the lowest of which counts.
    subroutine add_contacts(random, base, gap)
        type(random_t), intent(inout) :: random
        type(base_t), intent(in) :: base
        type(gap_t), intent(inout) :: gap

        integer :: i

        gap%h = gap%h*log_uniform(random, 1.0_wp, 10.0_wp)
        do i = 1, pick(random, 4)
            gap%h = min(gap%h, base%depth*uniform(random, -0.5_wp, 0.9_wp) &
                        + base%b0*log_uniform(random, 1.0_wp, 30.0_wp) &
                        *(gap%y - base%b*uniform(random, -4.0_wp, 4.0_wp))**2)
        end do
    end subroutine add_contacts

    !> Slopes and bends that jump.
    subroutine add_corners(random, base, gap)
        type(random_t), intent(inout) :: random
        type(base_t), intent(in) :: base
        type(gap_t), intent(inout) :: gap

        real(wp) :: at
        integer :: i

        do i = 1, pick(random, 3)
            at = base%b*uniform(random, -1.5_wp, 1.5_wp)
            gap%h = gap%h + base%b0*base%b*log_uniform(random, 0.01_wp, 1.0_wp) &
                    *abs(gap%y - at)
            at = base%b*uniform(random, -1.5_wp, 1.5_wp)
            where (gap%y > at) gap%h = gap%h + base%b0*uniform(random, -0.3_wp, 3.0_wp) &
                                       *(gap%y - at)**2
        end do
    end subroutine add_corners

    !> All lengths a thousand times larger or smaller; the load with them or not.
    subroutine change_unit(random, case)
        type(random_t), intent(inout) :: random
        type(fuzz_case_t), intent(inout) :: case

        real(wp) :: unit

        unit = merge(1.0e3_wp, 1.0e-3_wp, chance(random, 0.5_wp))
        case%gap%y = unit*case%gap%y
        case%gap%h = unit*case%gap%h
        case%gap%inv2r = case%gap%inv2r/unit
        if (chance(random, 0.7_wp)) case%load = unit**2*case%load
    end subroutine change_unit
end module faststrip_lab_random_field_gaps
