!> Stresses of the rail below the last contact behind a handle of the C and F77 interfaces.
module faststrip_interop_stress
    use, intrinsic :: iso_c_binding, only: c_double
    use faststrip_base_status, only: clear_status, is_error
    use faststrip_contact_method_loads, only: take_loads, find_stress_peak
    use faststrip_interop_handle, only: handle_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_stress_invariants, only: von_mises, principal_stresses, tresca
    use faststrip_stress_loads, only: check_points, find_stress
    use faststrip_stress_rectangle, only: n_stresses
    implicit none
    private

    public :: n_values, n_peak, handle_stresses, handle_peak

    !> Numbers of a point: its stress, von Mises, Tresca, principal values; and of the peak.
    !> Given: lengths of the lists below.
    integer, parameter :: n_values = n_stresses + 5, n_peak = 5

contains

    !> Stresses at points.
    subroutine handle_stresses(handle, x, y, z, values)
        type(handle_t), intent(inout) :: handle          !! its status tells how it ended
        real(c_double), intent(in) :: x(:), y(:), z(:)   !! points, depth from 0 on, mm
        real(c_double), intent(inout) :: values(:, :)
            !! xx, yy, zz, xy, xz, yz, von Mises, Tresca, principal values from the largest on,
            !! MPa, a column each; as they were with an error

        type(environment_t) :: environment
        integer :: i

        call hold_environment(environment)
        call check_points(x, y, z, handle%status)
        if (.not. is_error(handle%status)) call take_loads(handle%workspace, handle%status)
        if (.not. is_error(handle%status)) then
            do i = 1, size(x)
                associate (stress => values(:n_stresses, i), sorted => values(n_stresses + 3:, i))
                    call find_stress(handle%workspace%loads, handle%case%material%nu_rail, x(i), &
                                     y(i), z(i), stress)
                    sorted = principal_stresses(stress)
                    values(n_stresses + 1, i) = von_mises(stress)
                    values(n_stresses + 2, i) = tresca(sorted)
                end associate
            end do
        end if
        call restore_environment(environment)
    end subroutine handle_stresses

    !> The largest von Mises stress.
    subroutine handle_peak(handle, figures)
        type(handle_t), intent(inout) :: handle          !! its status tells how it ended
        real(c_double), intent(out) :: figures(n_peak)
            !! MPa; x, y, z, mm; its estimated relative error; zeros with an error

        type(environment_t) :: environment

        figures = 0.0_c_double
        call hold_environment(environment)
        call clear_status(handle%status)
        call find_stress_peak(handle%workspace, handle%case, handle%result, handle%status)
        associate (peak => handle%result%stress_peak)
            if (.not. is_error(handle%status)) &
                figures = [peak%von_mises, peak%x, peak%y, peak%z, peak%est_err]
        end associate
        call restore_environment(environment)
    end subroutine handle_peak
end module faststrip_interop_stress
