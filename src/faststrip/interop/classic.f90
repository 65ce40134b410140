!> The calls without a workspace, guarded for a host: FASTSIM on an ellipse the caller has, Hertz's
!> ellipse, Kalker's coefficients.
module faststrip_interop_classic
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t, check_material, normal_compliance
    use faststrip_base_creepage, only: creepage_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_normal_hertz, only: hertz_t, hertz_solve
    use faststrip_tangential_fastsim, only: fastsim_coefficients_solve
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: classic_fastsim, classic_hertz, classic_kalker

contains

    !> FASTSIM with the caller's ellipse and creepage coefficients.
    subroutine classic_fastsim(a, b, g, c, creepage, mu, load, nx, ny, result, status)
        real(wp), intent(in) :: a, b                 !! semi-axes along x and y, mm
        real(wp), intent(in) :: g                    !! combined shear modulus, MPa
        type(kalker_coefficients_t), intent(in) :: c !! c11, c22, c23
        type(creepage_t), intent(in) :: creepage     !! rail relative to wheel
        real(wp), intent(in) :: mu                   !! coefficient of friction
        real(wp), intent(in) :: load                 !! normal force, N
        integer, intent(in) :: nx, ny                !! points along a row, rows
        type(tangential_result_t), intent(out) :: result !! forces on the rail
        type(status_t), intent(out) :: status        !! those of `fastsim_coefficients_solve`

        type(environment_t) :: environment

        call hold_environment(environment)
        call fastsim_coefficients_solve(a, b, load, g, c, mu, creepage, nx, ny, result, status)
        call restore_environment(environment)
    end subroutine classic_fastsim

    !> Hertz's ellipse of two curvatures.
    subroutine classic_hertz(material, inv2r_x, inv2r_y, load, hertz, status)
        type(material_t), intent(in) :: material  !! moduli in MPa
        real(wp), intent(in) :: inv2r_x, inv2r_y  !! gap per x^2 and per y^2, 1/mm
        real(wp), intent(in) :: load              !! normal force, N
        type(hertz_t), intent(out) :: hertz       !! the contact
        type(status_t), intent(out) :: status     !! those of `check_material`, `hertz_solve`

        type(environment_t) :: environment

        call hold_environment(environment)
        call check_material(material, status)
        if (.not. is_error(status)) call hertz_solve(normal_compliance(material), inv2r_x, &
                                                     inv2r_y, load, hertz, status)
        call restore_environment(environment)
    end subroutine classic_hertz

    !> Kalker's coefficients of an ellipse.
    subroutine classic_kalker(a_over_b, nu, c, status)
        real(wp), intent(in) :: a_over_b              !! semi-axis along x over that along y
        real(wp), intent(in) :: nu                    !! combined Poisson's ratio
        type(kalker_coefficients_t), intent(out) :: c !! zero when there is an error
        type(status_t), intent(out) :: status         !! those of `kalker_coefficients`

        type(environment_t) :: environment

        call hold_environment(environment)
        call kalker_coefficients(a_over_b, nu, c, status)
        call restore_environment(environment)
    end subroutine classic_kalker
end module faststrip_interop_classic
