!> Gaps, ellipses and strips that tests of several rooms look at, and how they are solved.
module contacts
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_material, only: material_t, normal_compliance
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_contact_solve, only: solve_contact_forces
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_strips
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, set_strip_gap, strip_solve
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: even_gap, parabola, ellipse, elliptic_strips, pressed_ellipse, fixed_seed
    public :: prepare_strips, solve_strips, find_forces

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

    !> A gap in a workspace, and room for strips of its contact.
    subroutine prepare_strips(gap, most, workspace, strips, status)
        type(gap_t), intent(in) :: gap
        integer, intent(in) :: most               !! strips
        type(strip_workspace_t), intent(inout) :: workspace
        type(contact_strips_t), intent(inout) :: strips
        type(status_t), intent(out) :: status     !! errors of the gap

        call reserve_strips(strips, most, status)
        call reserve_strip_workspace(workspace, most, size(gap%y), status)
        call set_strip_gap(workspace, gap, status)
    end subroutine prepare_strips

    !> A contact of steel by strips, in a workspace of its own.
    subroutine solve_strips(gap, load, n_strips, strips, result, status)
        type(gap_t), intent(in) :: gap
        real(wp), intent(in) :: load              !! N
        integer, intent(in) :: n_strips           !! in a patch
        type(contact_strips_t), intent(inout) :: strips
        type(normal_result_t), intent(out) :: result
        type(status_t), intent(out) :: status     !! errors of the gap and of the solution
        type(strip_workspace_t) :: workspace

        call prepare_strips(gap, 400, workspace, strips, status)
        if (is_error(status)) return
        call strip_solve(workspace, normal_compliance(material_t()), load, &
                         strip_options_t(strips_per_patch=n_strips), strips, result, status)
    end subroutine solve_strips

    !> The forces alone, on the pressures that are there.
    subroutine find_forces(workspace, case, forces, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(tangential_result_t), intent(out) :: forces
        type(status_t), intent(out) :: status     !! of `solve_contact_forces`
        type(contact_result_t) :: result

        call solve_contact_forces(workspace, case, result, status)
        forces = result%tangential
    end subroutine find_forces

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
