!> The S1002 wheel profile of EN 13715 and UIC 510-2 (flange height 28, flange thickness 32.5,
!> tread 6.7 %), in its eight sections.
!>
!> `s` runs from the flange (negative) to the field side (positive) and is 0 at the nominal
!> rolling circle, 70 mm from the wheel back; `f(s)` points down, to the flange tip. The printed
!> coefficients are used as they are: f jumps by -3.7e-5 mm at s = -26 and by +1.2e-4 mm at
!> s = -35.
module faststrip_geometry_wheel_s1002
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: s1002_at, s1002_first, s1002_last, s1002_joints, s1002_tip

    !> First s of the profile, mm. The definition ends at -70, where the back of the flange is
    !> vertical; the last micrometre is left out so that slopes stay finite.
    real(wp), parameter :: s1002_first = -69.999_wp

    !> Last s of the profile, mm.
    real(wp), parameter :: s1002_last = 60.0_wp

    !> The flange tip, mm: f rises before it and falls beyond, but for the jumps.
    real(wp), parameter :: s1002_tip = -55.0_wp

    !> The joints of the sections A to H, from the field side to the flange, mm; a joint belongs
    !> to the section on its field side.
    real(wp), parameter :: s1002_joints(7) = &
        [32.15796_wp, -26.0_wp, -35.0_wp, -38.426669071_wp, -39.764473993_wp, &
         -49.662510381_wp, -62.764705882_wp]

    real(wp), parameter :: coefficients_b(0:8) = &
        [0.0_wp, -3.358537058e-2_wp, 1.565681624e-3_wp, -2.810427944e-5_wp, &
         5.844240864e-8_wp, -1.562379023e-8_wp, 5.309217349e-15_wp, -5.957839843e-12_wp, &
         2.646656573e-13_wp]
    real(wp), parameter :: coefficients_c(0:7) = &
        [-4.320221063e3_wp, -1.038384026e3_wp, -1.065501873e2_wp, -6.051367875_wp, &
         -2.054332446e-1_wp, -4.169739389e-3_wp, -4.687195829e-5_wp, -2.252755540e-7_wp]

contains

    !> The profile and its first two derivatives.
    pure subroutine s1002_at(s, f, df, d2f, is_there)
        real(wp), intent(in) :: s        !! lateral coordinate, mm
        real(wp), intent(out) :: f       !! profile, down, mm
        real(wp), intent(out) :: df      !! slope df/ds
        real(wp), intent(out) :: d2f     !! second derivative, 1/mm
        logical, intent(out) :: is_there !! is s from s1002_first to s1002_last? If not: all zero

        f = 0.0_wp
        df = 0.0_wp
        d2f = 0.0_wp
        is_there = ieee_is_finite(s)
        if (is_there) is_there = s >= s1002_first .and. s <= s1002_last
        if (.not. is_there) then
            return
        else if (s >= s1002_joints(1)) then
            f = 1.364323640_wp - 0.066666667_wp*s
            df = -0.066666667_wp
        else if (s >= s1002_joints(2)) then
            call polynomial(coefficients_b, s, f, df, d2f)
        else if (s >= s1002_joints(3)) then
            call polynomial(coefficients_c, s, f, df, d2f)
        else if (s >= s1002_joints(4)) then
            call arc(-26.210665_wp, 16.446_wp, -13.0_wp, s, f, df, d2f)
        else if (s >= s1002_joints(5)) then
            f = -93.576667419_wp - 2.747477419_wp*s
            df = -2.747477419_wp
        else if (s >= s1002_joints(6)) then
            call arc(-58.558326413_wp, 8.834924130_wp, 20.0_wp, s, f, df, d2f)
        else if (s >= s1002_joints(7)) then
            call arc(s1002_tip, 16.0_wp, 12.0_wp, s, f, df, d2f)
        else
            call arc(-49.5_wp, 9.519259302_wp, 20.5_wp, s, f, df, d2f)
        end if
    end subroutine s1002_at

    pure subroutine polynomial(coefficients, s, f, df, d2f)
        real(wp), intent(in) :: coefficients(0:), s
        real(wp), intent(out) :: f, df, d2f
        integer :: k

        f = 0.0_wp
        df = 0.0_wp
        d2f = 0.0_wp
        do k = ubound(coefficients, 1), 0, -1
            d2f = d2f*s + 2.0_wp*df
            df = df*s + f
            f = f*s + coefficients(k)
        end do
    end subroutine polynomial

    ! Half a circle about (s0, f0); below the centre for a positive radius, above for a negative.
    pure subroutine arc(s0, f0, radius, s, f, df, d2f)
        real(wp), intent(in) :: s0, f0, radius, s
        real(wp), intent(out) :: f, df, d2f
        real(wp) :: root

        root = sign(sqrt(radius**2 - (s - s0)**2), radius)
        f = f0 + root
        df = -(s - s0)/root
        d2f = -radius**2/root**3
    end subroutine arc
end module faststrip_geometry_wheel_s1002
