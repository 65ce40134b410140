!> Random gaps to try the normal solution on: case `number` of a seed is always the same one.
!>
!> Shapes are drawn in units of the Hertz ellipse of the case's load and curvatures, so that at
!> every load the contact meets the kinks, humps and edges; one case in five has a shape drawn
!> without regard to the load, whose contact may be lost in one interval of points or run out of
!> them all.
module faststrip_lab_random_gaps
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_lab_random_numbers, only: random_t, start_random, uniform, log_uniform, chance, &
                                            pick, normal
    implicit none
    private

    public :: fuzz_case_t, make_fuzz_case, draw_family_gap, family_names

    !> What the families are called.
    character(len=12), parameter :: family_names(14) = [character(len=12) :: &
        'hertz', 'several', 'merging', 'small_second', 'kinks', 'flat_top', 'wavy', &
        'conformal', 'concave', 'varying_a', 'negative_a', 'measured', 'edge', 'mixed']

    integer, parameter :: most_terms = 8
    real(wp), parameter :: noise_height = 0.5e-3_wp ! of a measured profile, mm

    !> One case: the gap and the load of a contact. Material and creepages are the checks'.
    type, extends(contact_case_t) :: fuzz_case_t
        integer :: number = 0      !! from 1
        integer :: family = 0      !! index of `family_names`
    end type fuzz_case_t

    !> The shape of a gap over t: height and longitudinal curvature in units of the case.
    type :: shape_t
        integer :: family = 0
        integer :: n = 0
        real(wp) :: at(most_terms) = 0.0_wp
        real(wp) :: height(most_terms) = 0.0_wp
        real(wp) :: bend(most_terms) = 0.0_wp
        real(wp) :: tilt = 0.0_wp
        ! Longitudinal: 1 + wave sin(turns t + phase), times jump beyond edge, at least floor
        real(wp) :: wave = 0.0_wp, turns = 0.0_wp, phase = 0.0_wp
        real(wp) :: jump = 1.0_wp, edge = huge(1.0_wp), floor = 0.0_wp
    end type shape_t

contains

    !> Draw a case.
    subroutine make_fuzz_case(seed, number, fuzz_case)
        integer, intent(in) :: seed                   !! >= 0
        integer, intent(in) :: number                 !! which case, >= 1
        type(fuzz_case_t), intent(out) :: fuzz_case   !! the same for the same numbers

        type(random_t) :: random
        type(shape_t) :: shape
        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp) :: a0, b0, y_unit, h_unit, t_from, t_to, offset_y, offset_h
        integer :: points
        logical :: noisy

        call start_random(seed, number, random)
        fuzz_case%number = number
        fuzz_case%family = pick(random, size(family_names))
        fuzz_case%load = log_uniform(random, 1.0e-3_wp, 1.0e8_wp)
        fuzz_case%methods%strips_per_patch = draw_strips(random)
        ! Half of the wheel's radii are those of railways.
        a0 = log_uniform(random, 1.0e-5_wp, 1.0e-1_wp)
        if (chance(random, 0.5_wp)) a0 = log_uniform(random, 5.0e-4_wp, 2.0e-3_wp)
        ! A Hertz ellipse of about a/b = .004 to 100.
        b0 = a0*log_uniform(random, 0.004_wp, 100.0_wp)**1.6_wp
        noisy = .false.
        if (family_names(fuzz_case%family) == 'measured') then
            noisy = .true.
            a0 = 1.0_wp/920.0_wp
            b0 = 1.0_wp/log_uniform(random, 60.0_wp, 2000.0_wp)
            if (chance(random, 0.5_wp)) fuzz_case%load = log_uniform(random, 1.0e3_wp, 1.0e6_wp)
        end if
        call hertz_solve(normal_compliance(material_t()), a0, b0, fuzz_case%load, hertz, status)
        y_unit = hertz%b
        if (chance(random, 0.2_wp)) y_unit = log_uniform(random, 0.5_wp, 20.0_wp)
        if (family_names(fuzz_case%family) == 'measured') y_unit = uniform(random, 5.0_wp, 10.0_wp)
        h_unit = b0*y_unit**2
        call draw_shape(random, fuzz_case%family, hertz%penetration/(b0*hertz%b**2), shape)
        call draw_range(random, fuzz_case%family, t_from, t_to)
        if (family_names(fuzz_case%family) == 'measured') then
            points = nint(y_unit*(t_to - t_from)/uniform(random, 0.05_wp, 0.5_wp))
        else
            points = draw_number_of_points(random)
        end if
        call draw_points(random, points, t_from, t_to, fuzz_case%gap)
        offset_y = 0.0_wp
        offset_h = 0.0_wp
        if (chance(random, 0.3_wp)) then
            offset_y = y_unit*uniform(random, -3.0_wp, 3.0_wp)
            offset_h = h_unit*uniform(random, -3.0_wp, 3.0_wp)
        end if
        call fill_gap(random, shape, a0, y_unit, h_unit, offset_y, offset_h, noisy, fuzz_case%gap)
    end subroutine make_fuzz_case

    !> Draw a gap of one family at given places.
    subroutine draw_family_gap(random, family, a0, b0, hertz, t, gap)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family       !! index of `family_names`
        real(wp), intent(in) :: a0, b0      !! longitudinal and lateral term, 1/mm
        type(hertz_t), intent(in) :: hertz  !! the ellipse of these and the contact's load
        real(wp), intent(in) :: t(:)        !! places in units of its lateral semi-axis
        type(gap_t), intent(out) :: gap     !! mm, mm, 1/mm

        type(shape_t) :: shape

        call draw_shape(random, family, hertz%penetration/(b0*hertz%b**2), shape)
        gap%y = t
        allocate (gap%h, gap%inv2r, source=0.0_wp*t)
        call fill_gap(random, shape, a0, hertz%b, b0*hertz%b**2, 0.0_wp, 0.0_wp, .false., gap)
    end subroutine draw_family_gap

    !> Heights and curvatures at the points, which hold t so far.
    subroutine fill_gap(random, shape, a0, y_unit, h_unit, offset_y, offset_h, noisy, gap)
        type(random_t), intent(inout) :: random
        type(shape_t), intent(in) :: shape
        real(wp), intent(in) :: a0, y_unit, h_unit, offset_y, offset_h
        logical, intent(in) :: noisy
        type(gap_t), intent(inout) :: gap

        integer :: i

        do i = 1, size(gap%y)
            gap%h(i) = offset_h + h_unit*shape_height(shape, gap%y(i))
            if (noisy) gap%h(i) = gap%h(i) + noise_height*normal(random)
            gap%inv2r(i) = a0*shape_curvature(shape, gap%y(i))
            gap%y(i) = offset_y + y_unit*gap%y(i)
        end do
    end subroutine fill_gap

    !> Mostly 5 to 41 strips, some of the extremes.
    integer function draw_strips(random) result(n)
        type(random_t), intent(inout) :: random

        real(wp) :: dice

        dice = uniform(random, 0.0_wp, 1.0_wp)
        if (dice < 0.05_wp) then
            n = 2 + pick(random, 2)
        else if (dice < 0.995_wp) then
            n = 4 + pick(random, 37)
        else
            n = nint(log_uniform(random, 41.0_wp, 200.0_wp))
        end if
    end function draw_strips

    !> Mostly 100 to 2000 points, some of the extremes.
    integer function draw_number_of_points(random) result(n)
        type(random_t), intent(inout) :: random

        real(wp) :: dice

        dice = uniform(random, 0.0_wp, 1.0_wp)
        if (dice < 0.06_wp) then
            n = nint(log_uniform(random, 20.0_wp, 100.0_wp))
        else if (dice < 0.98_wp) then
            n = nint(log_uniform(random, 100.0_wp, 2000.0_wp))
        else
            n = nint(log_uniform(random, 2000.0_wp, 20000.0_wp))
        end if
    end function draw_number_of_points

    !> Between which t the points lie.
    subroutine draw_range(random, family, t_from, t_to)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family
        real(wp), intent(out) :: t_from, t_to

        t_from = -log_uniform(random, 2.0_wp, 8.0_wp)
        t_to = log_uniform(random, 2.0_wp, 8.0_wp)
        if (family_names(family) == 'several') then
            t_from = -6.0_wp
            t_to = 6.0_wp
        else if (family_names(family) == 'edge') then
            if (chance(random, 0.7_wp)) t_from = uniform(random, -1.5_wp, 0.5_wp)
            if (chance(random, 0.3_wp)) t_to = uniform(random, 0.6_wp, 1.5_wp)
        end if
    end subroutine draw_range

    !> Points in even distances, uneven ones, or closer together in the middle.
    subroutine draw_points(random, n, t_from, t_to, gap)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: n
        real(wp), intent(in) :: t_from, t_to
        type(gap_t), intent(inout) :: gap

        real(wp) :: s, jitter, grading
        integer :: i

        allocate (gap%y(n), gap%h(n), gap%inv2r(n))
        jitter = 0.0_wp
        grading = 0.0_wp
        if (chance(random, 0.15_wp)) jitter = uniform(random, 0.0_wp, 0.49_wp)
        if (chance(random, 0.15_wp)) grading = uniform(random, 0.0_wp, 0.9_wp)
        do i = 1, n
            s = real(i - 1, wp)
            if (jitter > 0.0_wp) s = s + uniform(random, -jitter, jitter)
            s = 2.0_wp*s/real(n - 1, wp) - 1.0_wp
            s = s*(1.0_wp - grading + grading*s*s)
            gap%y(i) = 0.5_wp*(t_from + t_to) + 0.5_wp*(t_to - t_from)*s
        end do
    end subroutine draw_points

    !> The numbers behind a shape.
    subroutine draw_shape(random, family, penetration, shape)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family
        real(wp), intent(in) :: penetration ! of the Hertz ellipse, in units of the height
        type(shape_t), intent(out) :: shape

        integer :: i

        shape%family = family
        select case (trim(family_names(family)))
        case ('several')
            shape%n = 2 + pick(random, most_terms - 3)
            do i = 1, shape%n
                shape%at(i) = uniform(random, -4.0_wp, 4.0_wp)
                shape%height(i) = uniform(random, 0.0_wp, min(1.0_wp, penetration))
                shape%bend(i) = log_uniform(random, 0.3_wp, 10.0_wp)
            end do
        case ('merging')
            shape%at(1) = log_uniform(random, 0.2_wp, 3.0_wp)
            if (chance(random, 0.5_wp)) shape%tilt = uniform(random, -0.2_wp, 0.2_wp)
        case ('small_second')
            shape%at(1) = uniform(random, 1.2_wp, 3.0_wp)
            if (chance(random, 0.5_wp)) shape%at(1) = -shape%at(1)
            shape%height(1) = penetration*uniform(random, 0.0_wp, 0.8_wp)
            shape%bend(1) = log_uniform(random, 3.0_wp, 300.0_wp)
        case ('kinks', 'measured')
            ! Bend of the middle, and what is added to it beyond each kink.
            shape%n = 1 + pick(random, most_terms - 1)
            shape%bend(1) = log_uniform(random, 0.05_wp, 2.0_wp)
            do i = 2, shape%n
                shape%at(i) = uniform(random, -1.5_wp, 1.5_wp)
                shape%bend(i) = uniform(random, -1.0_wp, 1.0_wp)*shape%bend(1)
                if (chance(random, 0.7_wp)) &
                    shape%bend(i) = shape%bend(1)*log_uniform(random, 0.1_wp, 10.0_wp)
            end do
        case ('flat_top')
            shape%at(1) = uniform(random, -0.5_wp, 0.5_wp)
            shape%height(1) = log_uniform(random, 0.05_wp, 2.0_wp)
            shape%bend(1) = log_uniform(random, 0.01_wp, 10.0_wp)
            if (chance(random, 0.5_wp)) shape%bend(2) = log_uniform(random, 0.01_wp, 10.0_wp)
            if (chance(random, 0.3_wp)) shape%tilt = uniform(random, -0.1_wp, 0.1_wp)
        case ('wavy', 'mixed')
            shape%n = pick(random, 4)
            do i = 1, shape%n
                shape%at(i) = uniform(random, 0.0_wp, 2.0_wp*pi)
                shape%height(i) = log_uniform(random, 1.0e-3_wp, 0.5_wp)
                shape%bend(i) = 2.0_wp*pi*log_uniform(random, 0.2_wp, 5.0_wp)
            end do
            if (family_names(family) == 'mixed') then
                shape%n = most_terms
                do i = 5, most_terms
                    shape%at(i) = uniform(random, -3.0_wp, 3.0_wp)
                    shape%bend(i) = uniform(random, -2.0_wp, 2.0_wp)
                end do
                shape%tilt = uniform(random, -0.5_wp, 0.5_wp)
            end if
        case ('conformal')
            shape%at(1) = 2.0_wp + 2.0_wp*pick(random, 5)
            if (chance(random, 0.5_wp)) shape%bend(1) = log_uniform(random, 1.0e-4_wp, 0.3_wp)
        case ('concave')
            shape%bend(1) = log_uniform(random, 0.1_wp, 10.0_wp)
            shape%bend(2) = log_uniform(random, 0.02_wp, 1.0_wp)
            if (chance(random, 0.7_wp)) shape%tilt = uniform(random, -1.0_wp, 1.0_wp)
        end select
        if (any(family_names(family) == [character(len=12) :: 'varying_a', 'negative_a', &
                                         'mixed'])) &
            call draw_curvature(random, family, shape)
    end subroutine draw_shape

    !> How the longitudinal curvature varies.
    subroutine draw_curvature(random, family, shape)
        type(random_t), intent(inout) :: random
        integer, intent(in) :: family
        type(shape_t), intent(inout) :: shape

        shape%wave = uniform(random, 0.0_wp, 1.2_wp)
        shape%turns = log_uniform(random, 0.1_wp, 6.0_wp)
        shape%phase = uniform(random, 0.0_wp, 2.0_wp*pi)
        if (chance(random, 0.5_wp)) shape%edge = uniform(random, -1.0_wp, 1.0_wp)
        if (chance(random, 0.5_wp)) shape%jump = log_uniform(random, 0.05_wp, 20.0_wp)
        if (chance(random, 0.2_wp)) shape%jump = 0.0_wp
        if (chance(random, 0.05_wp)) then
            shape%jump = 0.0_wp
            shape%edge = -huge(1.0_wp)
        end if
        if (family_names(family) == 'negative_a') then
            shape%wave = 1.0_wp + log_uniform(random, 1.0e-3_wp, 0.2_wp)
            shape%turns = uniform(random, 2.0_wp, 6.0_wp)
            shape%jump = 1.0_wp
            shape%floor = -1.0_wp
        end if
    end subroutine draw_curvature

    !> Height of a shape.
    pure real(wp) function shape_height(shape, t) result(h)
        type(shape_t), intent(in) :: shape
        real(wp), intent(in) :: t

        integer :: i

        h = t*t
        select case (trim(family_names(shape%family)))
        case ('several')
            h = minval(shape%height(:shape%n) + shape%bend(:shape%n)*(t - shape%at(:shape%n))**2)
        case ('merging')
            h = ((t*t - shape%at(1)**2)/(2.0_wp*shape%at(1)))**2
        case ('small_second')
            h = min(h, shape%height(1) + shape%bend(1)*(t - shape%at(1))**2)
        case ('kinks', 'measured')
            h = shape%bend(1)*t*t
            do i = 2, shape%n
                if (t*shape%at(i) > shape%at(i)**2) h = h + shape%bend(i)*(t - shape%at(i))**2
            end do
        case ('flat_top')
            h = max(abs(t - shape%at(1)) - shape%height(1), 0.0_wp)
            h = h*(shape%bend(2) + shape%bend(1)*h)
        case ('wavy')
            h = h + sum(shape%height(:shape%n)*sin(shape%bend(:shape%n)*t + shape%at(:shape%n)))
        case ('mixed')
            h = h + sum(shape%height(:4)*sin(shape%bend(:4)*t + shape%at(:4)))
            do i = 5, shape%n
                if (t*shape%at(i) > shape%at(i)**2) h = h + shape%bend(i)*(t - shape%at(i))**2
            end do
        case ('conformal')
            h = abs(t)**shape%at(1) + shape%bend(1)*t*t
        case ('concave')
            h = shape%bend(2)*t**4 - shape%bend(1)*t*t
        end select
        h = h + shape%tilt*t
    end function shape_height

    !> Longitudinal curvature of a shape.
    pure real(wp) function shape_curvature(shape, t) result(a)
        type(shape_t), intent(in) :: shape
        real(wp), intent(in) :: t

        a = 1.0_wp + shape%wave*sin(shape%turns*t + shape%phase)
        if (t > shape%edge) a = a*shape%jump
        a = max(a, shape%floor)
    end function shape_curvature
end module faststrip_lab_random_gaps
