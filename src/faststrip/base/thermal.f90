!> How wheel and rail take up heat, and how warm they are away from the contact.
!>
!> Heat that flows into a half-space for the time t raises its surface by `q sqrt(t)/beta`, with the
!> effusivity `beta = sqrt(lambda rho c)`: all that conduction in depth needs to know of a body. Two
!> bodies that touch have the mean of their temperatures by effusivity, and share the heat alike.
module faststrip_base_thermal
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range
    implicit none
    private

    public :: thermal_t, heating_t, check_thermal, heating, diffusivity
    public :: of_wheel, of_rail, coldest

    !> Which body it is, in the arrays of `thermal_t`.
    !> Given: their order.
    integer, parameter :: of_wheel = 1, of_rail = 2

    ! Given: steel, of E. Ertz and K. Knothe, A comparison of analytical and numerical methods for
    ! the calculation of temperatures in wheel/rail contact, Wear 253 (2002) 498-508.
    real(wp), parameter :: of_steel(3) = [50.0_wp, 450.0_wp, 7850.0_wp]
    ! Tuned [C]. Origin: chosen: a room's.
    real(wp), parameter :: room = 20.0_wp
    !> Given: absolute zero, C.
    real(wp), parameter :: coldest = -273.15_wp
    ! Bodies beyond this, or below its inverse, are refused; so are temperatures.
    ! Tuned [W/(m K), J/(kg K), kg/m^3, C]. Origin: safeguard.
    real(wp), parameter :: largest = 1.0e6_wp
    ! Given: kg/m^3 J/(kg K) in N/(mm^2 K).
    real(wp), parameter :: per_mm2 = 1.0e-6_wp

    !> Both bodies, wheel and rail.
    type :: thermal_t
        real(wp) :: conductivity(2) = of_steel(1)  !! W/(m K), which is N/(s K)
        real(wp) :: heat_capacity(2) = of_steel(2) !! J/(kg K)
        real(wp) :: density(2) = of_steel(3)       !! kg/m^3
        real(wp) :: temperature(2) = room          !! away from the contact, C
    end type thermal_t

    !> What heat does to a contact that rolls.
    type :: heating_t
        real(wp) :: shared = 0.0_wp  !! temperature of both surfaces that touch, without heat, C
        real(wp) :: gain = 0.0_wp
            !! rise by 1 N/mm^2 of friction power over a way of 1 mm, over `int ds/sqrt(s)`,
            !! `sqrt(V/pi)/(beta_wheel + beta_rail)`, K sqrt(mm)/(N mm) mm^2
        real(wp) :: away(2) = 0.0_wp !! temperatures of wheel and rail away from the contact, C
    end type heating_t

contains

    !> Refuse bodies that are none.
    pure subroutine check_thermal(thermal, status)
        type(thermal_t), intent(in) :: thermal !! as the caller set it
        type(status_t), intent(out) :: status
            !! `st_not_finite`, `st_bad_argument`, `st_out_of_range`

        call clear_status(status)
        call check_body('conductivity', 'W/(m K)', thermal%conductivity, status)
        call check_body('heat capacity', 'J/(kg K)', thermal%heat_capacity, status)
        call check_body('density', 'kg/m^3', thermal%density, status)
        if (.not. all(ieee_is_finite(thermal%temperature))) then
            call set_status(status, st_not_finite, 'a temperature of wheel or rail is not finite')
        else if (any(thermal%temperature < coldest .or. thermal%temperature > largest)) then
            call set_status(status, st_bad_argument, 'temperatures of wheel and rail must be ' // &
                            '-273.15 to 1e6 C, got ' // &
                            trim(number_text(thermal%temperature(of_wheel))) // ' and ' // &
                            number_text(thermal%temperature(of_rail)))
        end if
    end subroutine check_thermal

    pure subroutine check_body(name, unit, values, status)
        character(len=*), intent(in) :: name, unit
        real(wp), intent(in) :: values(2)
        type(status_t), intent(inout) :: status

        if (.not. all(ieee_is_finite(values))) then
            call set_status(status, st_not_finite, 'a ' // name // ' is not finite')
        else if (any(values <= 0.0_wp)) then
            call set_status(status, st_bad_argument, 'the ' // name // ' must be above 0, got ' // &
                            trim(number_text(minval(values))) // ' ' // unit)
        else if (any(values > largest .or. values < 1.0_wp/largest)) then
            call set_status(status, st_out_of_range, 'a ' // name // ' is beyond 1e-6 to 1e6 ' // &
                            unit)
        end if
    end subroutine check_body

    !> What heat does to a contact of both bodies.
    pure type(heating_t) function heating(thermal, speed)
        type(thermal_t), intent(in) :: thermal !! checked
        real(wp), intent(in) :: speed          !! rolling speed, mm/s, > 0

        real(wp) :: effusivity(2)

        effusivity = sqrt(thermal%conductivity*thermal%heat_capacity*thermal%density*per_mm2)
        heating%shared = dot_product(effusivity, thermal%temperature)/sum(effusivity)
        heating%away = thermal%temperature
        heating%gain = sqrt(speed/pi)/sum(effusivity)
    end function heating

    !> How fast heat spreads in wheel and rail, lambda/(rho c), mm^2/s.
    pure function diffusivity(thermal)
        type(thermal_t), intent(in) :: thermal !! checked
        real(wp) :: diffusivity(2)

        diffusivity = thermal%conductivity/(thermal%heat_capacity*thermal%density*per_mm2)
    end function diffusivity
end module faststrip_base_thermal
