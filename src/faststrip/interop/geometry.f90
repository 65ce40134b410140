!> Contact geometry functions and equivalent conicity for the C and F77 interfaces, in rows of
!> numbers: nowhere else is it said which place is which component.
!>
!> ```
!> functions (of a shift) 1 delta r, mm     2, 3 rolling radius of the right and left wheel, mm
!>            4, 5 contact angle of both, rad       6 roll, rad
!>            7, 8 y of the contact on the right wheel and rail, mm      9, 10 on the left ones
!> conicity (of an amplitude) 1 tan gamma_e by Klingel's equation        2 by linear regression
!>            3, 4 turning points, mm       5, 6 nonlinearity of both, 1/mm
!> ```
module faststrip_interop_geometry
    use, intrinsic :: iso_c_binding, only: c_int, c_double
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, st_not_finite, &
                                     st_no_contact
    use faststrip_geometry_conicity, only: conicity_t, find_conicity, find_equilibrium, &
                                           largest_amplitude
    use faststrip_geometry_contact_functions, only: side_t, contact_functions_t, &
                                                    find_contact_functions
    use faststrip_geometry_profile, only: profile_t
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t
    use faststrip_geometry_touchable, only: body_wheel, body_rail
    use faststrip_interop_wheelset_new, only: dimensions_t, profile_source_t, make_profiles, &
                                              take_dimensions
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    implicit none
    private

    public :: table_functions, table_conicity, n_function, n_conicity

    !> Lengths of the rows.
    !> Given: by the interface.
    integer, parameter :: n_function = 10, n_conicity = 6

contains

    !> The contact of both wheels over the lateral shift.
    subroutine table_functions(wheels, rails, dimensions, with_roll, y, functions, states, status)
        type(profile_source_t), intent(in) :: wheels(2) !! right and left, both as a right wheel
        type(profile_source_t), intent(in) :: rails(2)  !! right and left, both as a right rail
        type(dimensions_t), intent(in) :: dimensions    !! of a wheelset, mm
        logical, intent(in) :: with_roll                !! until both wheels touch; else level
        real(c_double), intent(in) :: y(:)              !! shifts to the right, mm
        real(c_double), intent(inout) :: functions(:, :) !! as above; zeros without contact
        integer(c_int), intent(inout) :: states(:)      !! of each shift; `st_no_contact`
        type(status_t), intent(out) :: status
            !! those of profiles and of `find_contact_functions`; `st_no_contact`: at no shift

        type(environment_t) :: environment

        call hold_environment(environment)
        functions = 0.0_c_double
        states = 0
        if (all(ieee_is_finite(y))) then
            call tabulate(wheels, rails, dimensions, with_roll, y, functions, states, status)
        else
            call set_status(status, st_not_finite, 'the shifts must be finite')
        end if
        call restore_environment(environment)
    end subroutine table_functions

    subroutine tabulate(wheels, rails, dimensions, with_roll, y, functions, states, status)
        type(profile_source_t), intent(in) :: wheels(2), rails(2)
        type(dimensions_t), intent(in) :: dimensions
        real(c_double), intent(in) :: y(:)
        logical, intent(in) :: with_roll
        real(c_double), intent(inout) :: functions(:, :)
        integer(c_int), intent(inout) :: states(:)
        type(status_t), intent(out) :: status

        type(profile_t), allocatable :: wheel(:), rail(:)
        type(side_t), allocatable :: sides(:)
        type(contact_functions_t) :: found
        type(wheelset_t) :: wheelset
        type(track_t) :: track
        type(status_t) :: state
        integer :: i

        call take_dimensions(dimensions, wheelset, track, status)
        if (is_error(status)) return
        allocate (wheel(2), rail(2), sides(2))
        call make_profiles(wheels, body_wheel, 0.0_c_double, wheel, status)
        if (.not. is_error(status)) &
            call make_profiles(rails, body_rail, dimensions%inclination, rail, status)
        if (is_error(status)) return
        sides(1) = side_t(wheel(1), rail(1), dimensions%radius_right)
        sides(2) = side_t(wheel(2), rail(2), dimensions%radius_left)
        do i = 1, size(y)
            call find_contact_functions(sides(1), sides(2), wheelset, track, y(i), with_roll, &
                                        found, state)
            states(i) = state%code
            if (.not. is_error(state)) then
                associate (right => found%right, left => found%left)
                    functions(:, i) = [found%delta_r, right%radius, left%radius, right%gamma, &
                                       left%gamma, found%roll, right%y_wheel, right%y_rail, &
                                       left%y_wheel, left%y_rail]
                end associate
            else if (state%code /= st_no_contact .or. all(states(:i) == st_no_contact)) then
                status = state
                if (state%code /= st_no_contact) exit
            end if
        end do
        if (status%code == st_no_contact .and. any(states == 0)) call clear_status(status)
        if (is_error(status)) functions = 0.0_c_double
    end subroutine tabulate

    !> Equivalent conicity over the amplitude from a rolling radius difference.
    subroutine table_conicity(y, delta_r, amplitudes, equilibrium, conicities, states, status)
        real(c_double), intent(in) :: y(:)               !! lateral displacement, rising, mm
        real(c_double), intent(in) :: delta_r(:)         !! rolling radius difference, mm
        real(c_double), intent(in) :: amplitudes(:)      !! mm
        real(c_double), intent(inout) :: equilibrium(2)
            !! where the wheelset is in equilibrium and the largest amplitude of the table, mm
        real(c_double), intent(inout) :: conicities(:, :) !! as above; zeros on an error
        integer(c_int), intent(inout) :: states(:, :)
            !! of each amplitude: its status; is the nonlinearity known? (1: yes)
        type(status_t), intent(out) :: status            !! those of `find_equilibrium`

        type(environment_t) :: environment
        type(conicity_t) :: found
        type(status_t) :: state
        integer :: i

        call hold_environment(environment)
        equilibrium = 0.0_c_double
        conicities = 0.0_c_double
        states = 0
        call find_equilibrium(y, delta_r, equilibrium(1), status)
        if (.not. is_error(status)) then
            equilibrium(2) = largest_amplitude(y, delta_r, equilibrium(1))
            do i = 1, size(amplitudes)
                call find_conicity(y, delta_r, equilibrium(1), amplitudes(i), found, state)
                conicities(:, i) = [found%klingel, found%regression, found%y_min, found%y_max, &
                                    found%nonlinearity]
                states(:, i) = [state%code, merge(1, 0, found%has_nonlinearity)]
            end do
        end if
        call restore_environment(environment)
    end subroutine table_conicity
end module faststrip_interop_geometry
