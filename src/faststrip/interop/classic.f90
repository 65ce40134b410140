!> The calls without a workspace, guarded for a host: FASTSIM on an ellipse the caller has, Hertz's
!> ellipse, Kalker's coefficients.
module faststrip_interop_classic
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_material, only: material_t, check_material, normal_compliance
    use faststrip_base_creepage, only: creepage_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve
    use faststrip_tangential_fastsim, only: fastsim_coefficients_solve
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: classic_fastsim, classic_hertz, classic_kalker

contains

    !> FASTSIM with the caller's ellipse and creepage coefficients.
    subroutine classic_fastsim(numbers, nx, ny, forces, status)
        real(wp), intent(in) :: numbers(11)
            !! semi-axes along x and y, mm; combined shear modulus, MPa; c11, c22, c23; creepages,
            !! -, -, rad/mm; coefficient of friction; normal force, N
        integer, intent(in) :: nx, ny          !! points along a row, rows
        real(wp), intent(inout) :: forces(3)   !! Fx, Fy, Mz on the rail, N, N, N mm
        type(status_t), intent(out) :: status  !! those of `fastsim_coefficients_solve`

        type(environment_t) :: environment
        type(tangential_result_t) :: result

        call hold_environment(environment)
        call fastsim_coefficients_solve(hertz_t(a=numbers(1), b=numbers(2), load=numbers(11)), &
                                        numbers(3), kalker_coefficients_t(numbers(4), &
                                        numbers(5), numbers(6), 0.0_wp), numbers(10), &
                                        creepage_t(numbers(7), numbers(8), numbers(9)), nx, ny, &
                                        result, status)
        forces = [result%fx, result%fy, result%mz]
        call restore_environment(environment)
    end subroutine classic_fastsim

    !> Hertz's ellipse of two curvatures.
    subroutine classic_hertz(numbers, inv2r_x, inv2r_y, load, figures, status)
        real(wp), intent(in) :: numbers(4)        !! moduli, MPa, and Poisson's ratios
        real(wp), intent(in) :: inv2r_x, inv2r_y  !! gap per x^2 and per y^2, 1/mm
        real(wp), intent(in) :: load              !! normal force, N
        real(wp), intent(inout) :: figures(4)     !! a, b, penetration, pmax: mm, mm, mm, MPa
        type(status_t), intent(out) :: status     !! those of `check_material`, `hertz_solve`

        type(environment_t) :: environment
        type(material_t) :: material
        type(hertz_t) :: hertz

        call hold_environment(environment)
        material = material_t(numbers(1), numbers(2), numbers(3), numbers(4))
        call check_material(material, status)
        if (.not. is_error(status)) call hertz_solve(normal_compliance(material), inv2r_x, &
                                                     inv2r_y, load, hertz, status)
        figures = [hertz%a, hertz%b, hertz%penetration, hertz%pmax]
        call restore_environment(environment)
    end subroutine classic_hertz

    !> Kalker's coefficients of an ellipse.
    subroutine classic_kalker(a_over_b, nu, coefficients, status)
        real(wp), intent(in) :: a_over_b           !! semi-axis along x over that along y
        real(wp), intent(in) :: nu                 !! combined Poisson's ratio
        real(wp), intent(inout) :: coefficients(4) !! c11, c22, c23, c33; zero after an error
        type(status_t), intent(out) :: status      !! those of `kalker_coefficients`

        type(environment_t) :: environment
        type(kalker_coefficients_t) :: c

        call hold_environment(environment)
        call kalker_coefficients(a_over_b, nu, c, status)
        coefficients = [c%c11, c%c22, c%c23, c%c33]
        call restore_environment(environment)
    end subroutine classic_kalker
end module faststrip_interop_classic
