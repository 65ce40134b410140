!> Gaps, ellipses and strips that tests of several rooms look at.
module contacts
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_strips
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    implicit none
    private

    public :: even_gap, parabola, ellipse, elliptic_strips, pressed_ellipse, fixed_seed

contains

    !> A flat gap of even points under a wheel of radius 460 mm; its height is the caller's.
    pure function even_gap(n, first, last, a) result(gap)
        integer, intent(in) :: n              !! points
        real(wp), intent(in) :: first, last   !! places of the outermost, mm
        real(wp), intent(in), optional :: a   !! 1/(2R), 1/mm
        type(gap_t) :: gap
        integer :: i

        allocate (gap%y(n), gap%h(n), gap%inv2r(n))
        gap%y = [(first + (last - first)*(i - 1)/(n - 1), i=1, n)]
        gap%h = 0.0_wp
        gap%inv2r = 1.0_wp/920.0_wp
        if (present(a)) gap%inv2r = a
    end function even_gap

    !> A contact of Hertz: h = b (y - middle)**2.
    pure subroutine parabola(a, b, half_width, n, gap, middle)
        real(wp), intent(in) :: a, b              !! 1/(2R) along and across, 1/mm
        real(wp), intent(in) :: half_width        !! of the gap, mm
        integer, intent(in) :: n                  !! points
        type(gap_t), intent(out) :: gap
        real(wp), intent(in), optional :: middle  !! of the gap, mm; default 0
        integer :: i

        gap = even_gap(n, -half_width, half_width, a)
        gap%y = [(half_width*(2.0_wp*(i - 1)/(n - 1) - 1.0_wp), i=1, n)]
        if (present(middle)) gap%y = middle + gap%y
        gap%h = b*gap%y**2
        if (present(middle)) gap%h = b*(gap%y - middle)**2
    end subroutine parabola

    !> An ellipse of Hertz under a load.
    pure type(hertz_t) function pressed_ellipse(a, b, load, y) result(hertz)
        real(wp), intent(in) :: a, b           !! half axes, mm
        real(wp), intent(in) :: load           !! N
        real(wp), intent(in), optional :: y    !! its middle, mm; default 0

        hertz%a = a
        hertz%b = b
        if (present(y)) hertz%y = y
        hertz%load = load
        hertz%area = pi*a*b
        hertz%pmax = 1.5_wp*load/hertz%area
    end function pressed_ellipse

    !> One of 36 pi mm2 under 100 kN.
    pure type(hertz_t) function ellipse(a_over_b, y) result(hertz)
        real(wp), intent(in) :: a_over_b       !! ratio of the half axes
        real(wp), intent(in), optional :: y    !! its middle, mm; default 0

        hertz = pressed_ellipse(6.0_wp*sqrt(a_over_b), 6.0_wp/sqrt(a_over_b), 1.0e5_wp, y)
    end function ellipse

    !> The same cut into strips.
    type(contact_strips_t) function elliptic_strips(a_over_b, n, y) result(strips)
        real(wp), intent(in) :: a_over_b       !! ratio of the half axes
        integer, intent(in) :: n               !! strips
        real(wp), intent(in), optional :: y    !! its middle, mm; default 0
        type(status_t) :: status

        call reserve_strips(strips, n, status)
        call hertz_strips(ellipse(a_over_b, y), n, strips, status)
    end function elliptic_strips

    !> Let `random_number` give the same numbers in each run.
    subroutine fixed_seed(first)
        integer, intent(in) :: first  !! one of many sequences
        integer, allocatable :: seed(:)
        integer :: n, i

        call random_seed(size=n)
        allocate (seed(n), source=[(first + 41*i, i=1, n)])
        call random_seed(put=seed)
    end subroutine fixed_seed
end module contacts
