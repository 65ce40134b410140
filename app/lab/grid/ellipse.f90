!> Contacts that are known exactly: Hertz's ellipses.
module faststrip_lab_grid_ellipse
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_material, only: normal_compliance
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_normal_types, only: normal_result_t
    use faststrip_contact_case, only: contact_case_t
    use faststrip_command_program_console, only: fail_on_error
    implicit none
    private

    public :: make_ellipse, make_parabola, parabolic_gap

    real(wp), parameter :: sharpest = 1.0e-3_wp ! the larger of A and B, 1/mm
    real(wp), parameter :: half_range = 2.0_wp  ! of the gap's points, in semi-axes

contains

    !> The gap whose contact is an ellipse of given proportions, and that contact.
    subroutine make_ellipse(ratio, points, contact, known)
        real(wp), intent(in) :: ratio               !! a/b
        integer, intent(in) :: points               !! of the gap, >= 5
        class(contact_case_t), intent(inout) :: contact
            !! with material and load; its gap becomes one over twice the ellipse, mm
        type(normal_result_t), intent(out) :: known !! penetration, pmax, area

        type(hertz_t) :: hertz
        type(status_t) :: status
        real(wp) :: compliance, low, high, middle
        integer :: i

        ! a/b grows with ln(B/A), by two thirds of it at the circle and by a half far from it.
        compliance = normal_compliance(contact%material)
        low = -20.0_wp
        high = 20.0_wp
        do i = 1, 60
            middle = 0.5_wp*(low + high)
            call hertz_solve(compliance, inv2r_x(middle), inv2r_y(middle), contact%load, hertz, &
                             status)
            call fail_on_error(status)
            if (hertz%a > ratio*hertz%b) then
                high = middle
            else
                low = middle
            end if
        end do
        call make_parabola(inv2r_x(middle), inv2r_y(middle), points, contact, known)

    contains

        pure real(wp) function inv2r_x(logarithm)
            real(wp), intent(in) :: logarithm

            inv2r_x = sharpest*exp(-max(logarithm, 0.0_wp))
        end function inv2r_x

        pure real(wp) function inv2r_y(logarithm)
            real(wp), intent(in) :: logarithm

            inv2r_y = sharpest*exp(min(logarithm, 0.0_wp))
        end function inv2r_y
    end subroutine make_ellipse

    !> The gap A x^2 + B y^2 and its Hertz contact.
    subroutine make_parabola(inv2r_x, inv2r_y, points, contact, known)
        real(wp), intent(in) :: inv2r_x             !! A, 1/mm
        real(wp), intent(in) :: inv2r_y             !! B, 1/mm
        integer, intent(in) :: points               !! of the gap, >= 5
        class(contact_case_t), intent(inout) :: contact !! as `make_ellipse`
        type(normal_result_t), intent(out) :: known !! penetration, pmax, area

        type(hertz_t) :: hertz
        type(status_t) :: status

        call hertz_solve(normal_compliance(contact%material), inv2r_x, inv2r_y, contact%load, &
                         hertz, status)
        call fail_on_error(status)
        known%load = hertz%load
        known%penetration = hertz%penetration
        known%pmax = hertz%pmax
        known%area = hertz%area
        known%y_min = -hertz%b
        known%y_max = hertz%b
        contact%gap = parabolic_gap(inv2r_x, inv2r_y, hertz%b, points)
    end subroutine make_parabola

    !> The gap A x^2 + B y^2 over twice the width of an ellipse.
    pure type(gap_t) function parabolic_gap(inv2r_x, inv2r_y, b, points) result(gap)
        real(wp), intent(in) :: inv2r_x, inv2r_y !! A, B, 1/mm
        real(wp), intent(in) :: b                !! lateral semi-axis, mm
        integer, intent(in) :: points            !! >= 5

        integer :: i

        gap%y = [(half_range*b*(2*i - 1 - points)/(points - 1), i=1, points)]
        gap%h = inv2r_y*gap%y**2
        allocate (gap%inv2r(points), source=inv2r_x)
    end function parabolic_gap
end module faststrip_lab_grid_ellipse
