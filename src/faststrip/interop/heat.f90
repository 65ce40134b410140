!> Temperatures for the C and F77 interfaces: of a contact that was solved, at any places.
module faststrip_interop_heat
    use, intrinsic :: iso_c_binding, only: c_double
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_bad_argument
    use faststrip_contact_method, only: workspace_t, contact_result_t
    use faststrip_interop_solution, only: mirror_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_tangential_heat_flash, only: surface_temperatures
    implicit none
    private

    public :: n_flash, contact_flash, contact_temperatures

    !> Figures of `contact_flash`.
    !> Given: the interfaces'.
    integer, parameter :: n_flash = 4

contains

    !> Largest rise, K, largest temperature, C, and its place, mm.
    pure subroutine contact_flash(result, figures, status)
        type(contact_result_t), intent(in) :: result   !! of the solution
        real(c_double), intent(out) :: figures(n_flash) !! zeros with an error
        type(status_t), intent(out) :: status          !! `st_bad_argument`: not asked for

        figures = 0.0_c_double
        call clear_status(status)
        if (result%knows_temperatures) then
            associate (flash => result%flash)
                figures = [flash%rise, flash%temperature, flash%x, flash%y]
            end associate
        else
            call set_status(status, st_bad_argument, 'there are no temperatures: no contact was ' &
                            // 'solved that asks for them')
        end if
    end subroutine contact_flash

    !> Temperatures of both surfaces at places: in the contact, behind it, beside it.
    subroutine contact_temperatures(workspace, result, mirror, x, y, wheel, rail, status)
        type(workspace_t), intent(in) :: workspace         !! of the solution
        type(contact_result_t), intent(in) :: result       !! its figures
        type(mirror_t), intent(in) :: mirror               !! that it was solved in
        real(c_double), intent(in) :: x(:), y(:)           !! places, mm
        real(c_double), intent(inout) :: wheel(:), rail(:) !! C
        type(status_t), intent(out) :: status              !! of `contact_flash`

        type(environment_t) :: environment
        real(c_double) :: ignored(n_flash), surfaces(2)
        integer :: i

        call contact_flash(result, ignored, status)
        if (is_error(status)) return
        call hold_environment(environment)
        do i = 1, size(x)
            surfaces = surface_temperatures(workspace%field, workspace%friction%heat, &
                                            merge(-x(i), x(i), mirror%x), &
                                            merge(-y(i), y(i), mirror%y))
            wheel(i) = surfaces(1)
            rail(i) = surfaces(2)
        end do
        call restore_environment(environment)
    end subroutine contact_temperatures
end module faststrip_interop_heat
