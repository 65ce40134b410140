!> T gamma, wear and fatigue of the last solution behind a handle of the C and F77 faces.
!>
!> They are figures of what was solved, with its creepages and its friction; a law of wear and the
!> yield stress come with each question.
module faststrip_interop_wear
    use, intrinsic :: iso_c_binding, only: c_double
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument
    use faststrip_interop_handle, only: handle_t
    use faststrip_interop_wear_room, only: fill_law, check_forces, check_strip_forces, &
                                           contact_figures, n_regime, n_wear
    use faststrip_interop_wheelset_handle, only: wheelset_handle_t, contact_count, contact_place
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_tangential_wear_law, only: wear_t, find_strip_wear
    use faststrip_tangential_wear_numbers, only: strip_power_densities
    use faststrip_wheelset_strips, only: find_wheel_strips
    implicit none
    private

    public :: n_regime, n_wear
    public :: contact_wear, contact_strip_wear, read_strip_wear, wheelset_wear

contains

    !> The figures of the last contact.
    subroutine contact_wear(handle, regimes, density, yield_shear, figures)
        type(handle_t), intent(inout) :: handle     !! its status tells how it ended
        real(c_double), intent(in) :: regimes(:, :) !! of the law, as `fill_law`; none: no law
        real(c_double), intent(in) :: density       !! of what is worn, kg/m^3
        real(c_double), intent(in) :: yield_shear   !! in cyclic shear, MPa; 0: not known
        real(c_double), intent(out) :: figures(n_wear) !! as `contact_figures`

        type(environment_t) :: environment

        call hold_environment(environment)
        figures = 0.0_c_double
        call check_forces(handle%result, handle%workspace%methods%tangential, handle%status)
        if (.not. is_error(handle%status)) &
            call fill_law(regimes, density, handle%wear%law, handle%status)
        if (.not. is_error(handle%status) .and. handle%wear%law%n > 0) &
            call check_strip_forces(handle%workspace%methods%tangential, handle%status)
        if (.not. is_error(handle%status)) &
            call contact_figures(handle%result, handle%case%creepage, yield_shear, &
                                 handle%workspace%strips, handle%workspace%strip_forces, &
                                 handle%wear, figures, handle%status)
        call restore_environment(environment)
    end subroutine contact_wear

    !> Forces and wear of the last contact's strips, to be read by `read_strip_wear`.
    subroutine contact_strip_wear(handle, regimes, density)
        type(handle_t), intent(inout) :: handle     !! its status tells how it ended
        real(c_double), intent(in) :: regimes(:, :) !! of the law, as `fill_law`; none: no law
        real(c_double), intent(in) :: density       !! of what is worn, kg/m^3

        type(environment_t) :: environment
        type(wear_t) :: ignored

        call hold_environment(environment)
        call check_forces(handle%result, handle%workspace%methods%tangential, handle%status)
        if (.not. is_error(handle%status)) &
            call fill_law(regimes, density, handle%wear%law, handle%status)
        if (.not. is_error(handle%status)) &
            call check_strip_forces(handle%workspace%methods%tangential, handle%status)
        associate (strips => handle%workspace%strips, forces => handle%workspace%strip_forces, &
                   room => handle%wear)
            if (is_error(handle%status)) then
                continue
            else if (handle%wear%law%n > 0) then
                call find_strip_wear(room%law, strips, forces, room%densities, room%mass, &
                                     room%pass_depth, ignored, handle%status)
            else
                room%mass = 0.0_c_double
                room%pass_depth = 0.0_c_double
                call strip_power_densities(strips, forces, room%densities, handle%status)
            end if
        end associate
        call restore_environment(environment)
    end subroutine contact_strip_wear

    !> Copy what was found, of as many strips as the arrays are long.
    pure subroutine read_strip_wear(handle, fx, fy, power, density, mass, pass_depth)
        type(handle_t), intent(in) :: handle           !! after `contact_strip_wear`
        real(c_double), intent(inout) :: fx(:), fy(:)  !! on the rail, N
        real(c_double), intent(inout) :: power(:)      !! friction power over rolling speed, N
        real(c_double), intent(inout) :: density(:)    !! T gamma/A, N/mm^2
        real(c_double), intent(inout) :: mass(:)       !! ug per metre rolled
        real(c_double), intent(inout) :: pass_depth(:) !! depth when rolled over once, mm

        associate (forces => handle%workspace%strip_forces, room => handle%wear, n => size(fx))
            fx = forces%fx(:n)
            fy = forces%fy(:n)
            power = forces%friction_power(:n)
            density = room%densities(:n)
            mass = room%mass(:n)
            pass_depth = room%pass_depth(:n)
        end associate
    end subroutine read_strip_wear

    !> The figures of a contact of a wheelset's last solution.
    subroutine wheelset_wear(handle, i, regimes, density, yield_shear, figures)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells how it ended
        integer, intent(in) :: i                         !! from 1 on, as `read_contact`
        real(c_double), intent(in) :: regimes(:, :)      !! of the law, as `fill_law`; none: no law
        real(c_double), intent(in) :: density            !! of what is worn, kg/m^3
        real(c_double), intent(in) :: yield_shear        !! in cyclic shear, MPa; 0: not known
        real(c_double), intent(out) :: figures(n_wear)   !! as `contact_figures`

        type(environment_t) :: environment
        integer :: side, k

        figures = 0.0_c_double
        call clear_status(handle%status)
        if (i < 1 .or. i > contact_count(handle)) then
            call set_status(handle%status, st_bad_argument, 'there is no such contact: ' &
                            // count_text(i))
            return
        end if
        call hold_environment(environment)
        call contact_place(handle, i, side, k)
        associate (contact => handle%result%wheel(side)%contact(k), found => handle%strips)
            call check_forces(contact%figures, handle%model%case%methods%tangential, handle%status)
            if (.not. is_error(handle%status)) &
                call fill_law(regimes, density, handle%wear%law, handle%status)
            if (.not. is_error(handle%status) .and. handle%wear%law%n > 0) &
                call check_strip_forces(handle%model%case%methods%tangential, handle%status)
            if (.not. is_error(handle%status) .and. handle%wear%law%n > 0) &
                call find_wheel_strips(handle%model, handle%workspace, handle%result, side, k, &
                                       found, handle%status)
            if (.not. is_error(handle%status)) &
                call contact_figures(contact%figures, contact%creepage, yield_shear, &
                                     found%strips, found%forces, handle%wear, figures, &
                                     handle%status)
        end associate
        call restore_environment(environment)
    end subroutine wheelset_wear
end module faststrip_interop_wear
