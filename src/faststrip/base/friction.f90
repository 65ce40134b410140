!> Variable friction: it falls with slip speed, differs between tread and flange, and
!> contamination makes surfaces more compliant.
!>
!> Every method takes the coefficient of static friction in the contact, `mu`; what is here is
!> relative to it, and by default nothing is changed.
!>
!> - **Falling friction**: with the slip speed s, and s_h where half of the fall is done,
!>
!>         mu(s) = mu (k + (1 - k) f(s/s_h)),   k = kinetic over static value,
!>         linear       f(t) = max(0, 1 - t/2)
!>         rational     f(t) = 1/(1 + t)
!>         exponential  f(t) = 2^(-t)
!>
!>   the first terms of CONTACT's laws L = 2, 3 and 4 (E. A. H. Vollebregt, User guide for CONTACT,
!>   section "Slip velocity dependent friction", github.com/eve70a/CONTACT).
!> - **Initial slope**: Kalker's reduction factor, 0 to 1. All tangential compliances are divided by
!>   it, so that the creepage coefficients are multiplied by it: forces of constant friction are
!>   those of a creepage so many times smaller. Of modified FASTSIM (Spiryagin, Polach and Cole
!>   2013) this is k0; there the factor falls further with the slip area, here it does not.
!> - **Tread and flange**: mu of the contact angle, see `friction_at_angle`.
!> - **Across the rail**: mu at places, each strip its own, see `faststrip_base_friction_table`.
!> - **Hot friction**: with the temperature T of the surfaces there, along with the above, mu is
!>   multiplied by 1 up to one temperature, by `hot_share` from another one on, linearly between
!>   both: CONTACT's law L = 6 where it falls.
!>
!> A coefficient that falls with slip damps negatively: several states of slip may satisfy the law.
!> All methods give the one that is reached from adhesion: particles enter with the static
!> value, and slide once the traction has passed it.
module faststrip_base_friction
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_friction_table, only: friction_table_t, check_friction_table
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: material_t
    use faststrip_base_thermal, only: heating_t
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, count_text, &
                                     st_bad_argument, st_not_finite, st_out_of_range
    implicit none
    private

    public :: friction_t, check_friction, falls, falling_share, friction_at_angle, softened
    public :: falls_when_hot, hot_share
    public :: friction_constant, friction_linear, friction_rational, friction_exponential
    public :: friction_kind, friction_kind_names, largest_speed

    !> How friction falls with slip speed.
    !> Given: CONTACT's numbers, but for the first.
    integer, parameter :: friction_constant = 0
    integer, parameter :: friction_linear = 2
    integer, parameter :: friction_rational = 3
    integer, parameter :: friction_exponential = 4

    !> Names of the kinds, and their numbers in the same order.
    character(len=11), parameter :: friction_kind_names(*) = [character(len=11) :: &
        'constant', 'linear', 'rational', 'exponential']
    integer, parameter :: kinds(*) = [friction_constant, friction_linear, friction_rational, &
                                      friction_exponential]

    !> Speeds beyond this, or below its inverse, are refused.
    !> Tuned [mm/s]. Origin: safeguard.
    real(wp), parameter :: largest_speed = 1.0e12_wp
    ! Kinetic over static value below this is refused, so that a bound is left to divide by.
    ! Tuned [1]. Origin: safeguard.
    real(wp), parameter :: least_share = 1.0e-6_wp

    !> What friction does besides `mu`, relative to it.
    type :: friction_t
        integer :: kind = friction_constant     !! one of the `friction_` numbers
        real(wp) :: kinetic_share = 1.0_wp      !! kinetic over static value, 1e-6 to 1
        real(wp) :: half_slip_speed = 0.0_wp    !! slip speed of half of the fall, mm/s
        real(wp) :: speed = 0.0_wp              !! rolling speed, mm/s
        real(wp) :: slope_factor = 1.0_wp       !! of the initial slope, above 0 to 1
        real(wp) :: flange_share = 1.0_wp       !! mu on the flange over that on the tread
        real(wp) :: tread_angle = 0.0_wp        !! contact angle up to which the tread's mu counts
        real(wp) :: flange_angle = 0.0_wp       !! and from which the flange's, rad
        real(wp) :: hot_share = 1.0_wp          !! hot over cold value, 1e-6 to 1
        real(wp) :: cold_temperature = 0.0_wp   !! temperature up to which the cold value counts
        real(wp) :: hot_temperature = 0.0_wp    !! and from which the hot one, C
        type(heating_t) :: heat                 !! of the bodies, where that counts
        type(friction_table_t) :: table         !! static coefficient at places, in place of mu
    end type friction_t

contains

    !> Refuse friction that is none.
    pure subroutine check_friction(friction, status)
        type(friction_t), intent(in) :: friction !! as the caller set it
        type(status_t), intent(out) :: status
            !! `st_not_finite`, `st_bad_argument`, `st_out_of_range` (speeds)

        call clear_status(status)
        if (all(kinds /= friction%kind)) then
            call set_status(status, st_bad_argument, 'no such kind of friction: ' // &
                            count_text(friction%kind))
        else if (.not. all(ieee_is_finite([friction%kinetic_share, friction%half_slip_speed, &
                                           friction%speed, friction%slope_factor, &
                                           friction%flange_share, friction%tread_angle, &
                                           friction%flange_angle, friction%hot_share, &
                                           friction%cold_temperature, &
                                           friction%hot_temperature]))) then
            call set_status(status, st_not_finite, 'a number of the friction is not finite')
        else if (friction%kinetic_share < least_share .or. friction%kinetic_share > 1.0_wp) then
            call set_status(status, st_bad_argument, 'kinetic friction over static friction ' // &
                            'must be 1e-6 to 1, got ' // number_text(friction%kinetic_share))
        else if (friction%slope_factor <= 0.0_wp .or. friction%slope_factor > 1.0_wp) then
            call set_status(status, st_bad_argument, 'the factor of the initial slope must be ' // &
                            'above 0 and at most 1, got ' // number_text(friction%slope_factor))
        else if (friction%flange_share < 0.0_wp) then
            call set_status(status, st_bad_argument, 'friction of the flange over that of the ' // &
                            'tread must not be negative, got ' // &
                            number_text(friction%flange_share))
        else if (friction%flange_share /= 1.0_wp .and. &
                 .not. (friction%tread_angle >= 0.0_wp .and. &
                        friction%flange_angle > friction%tread_angle)) then
            call set_status(status, st_bad_argument, 'the angle of the flange must be above ' // &
                            'that of the tread, which must not be negative, got ' // &
                            trim(number_text(friction%flange_angle)) // ' and ' // &
                            trim(number_text(friction%tread_angle)) // ' rad')
        else if (friction%kind /= friction_constant .and. &
                 min(friction%half_slip_speed, friction%speed) <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'falling friction needs a rolling speed ' // &
                            'and a half-value slip speed above 0, got ' // &
                            trim(number_text(friction%speed)) // ' and ' // &
                            trim(number_text(friction%half_slip_speed)) // ' mm/s')
        else if (friction%kind /= friction_constant .and. &
                 (max(friction%half_slip_speed, friction%speed) > largest_speed .or. &
                  min(friction%half_slip_speed, friction%speed) < 1.0_wp/largest_speed)) then
            call set_status(status, st_out_of_range, 'a speed is beyond 1e-12 to 1e12 mm/s')
        else if (friction%hot_share < least_share .or. friction%hot_share > 1.0_wp) then
            call set_status(status, st_bad_argument, 'hot friction over cold friction must be ' // &
                            '1e-6 to 1, got ' // number_text(friction%hot_share))
        else if (falls_when_hot(friction) .and. &
                 friction%hot_temperature <= friction%cold_temperature) then
            call set_status(status, st_bad_argument, 'the temperature of hot friction must be ' // &
                            'above that of cold friction, got ' // &
                            trim(number_text(friction%hot_temperature)) // ' and ' // &
                            trim(number_text(friction%cold_temperature)) // ' C')
        else if (friction%table%n /= 0 .and. friction%flange_share /= 1.0_wp) then
            call set_status(status, st_bad_argument, 'friction of the flange must not be given ' &
                            // 'with a table of friction')
        else if (friction%table%n /= 0) then
            call check_friction_table(friction%table, status)
        end if
    end subroutine check_friction

    !> The kind of a name; -1 if there is none.
    pure integer function friction_kind(name)
        character(len=*), intent(in) :: name !! lower case, trailing blanks do not matter

        integer :: i

        friction_kind = -1
        do i = 1, size(kinds)
            if (friction_kind_names(i) == name) friction_kind = kinds(i)
        end do
    end function friction_kind

    !> Does friction fall, with slip speed or temperature?
    elemental logical function falls(friction)
        type(friction_t), intent(in) :: friction !! checked

        falls = falls_with_slip(friction) .or. falls_when_hot(friction)
    end function falls

    elemental logical function falls_with_slip(friction) result(falls)
        type(friction_t), intent(in) :: friction

        falls = friction%kind /= friction_constant .and. friction%kinetic_share < 1.0_wp
    end function falls_with_slip

    !> Does friction fall with temperature?
    elemental logical function falls_when_hot(friction) result(falls)
        type(friction_t), intent(in) :: friction !! checked

        falls = friction%hot_share < 1.0_wp
    end function falls_when_hot

    !> The share of `mu` that is left at the temperature T which the friction itself makes, a root
    !> of `T = before + gain share(T)`: the only one, as share does not rise. In closed form, as
    !> share is linear between two temperatures.
    elemental real(wp) function hot_share(friction, before, gain) result(share)
        type(friction_t), intent(in) :: friction !! checked
        real(wp), intent(in) :: before           !! temperature without the heat, C
        real(wp), intent(in) :: gain             !! what the heat adds at the cold value, >= 0, K

        real(wp) :: slope

        share = 1.0_wp
        if (.not. falls_when_hot(friction)) return
        slope = (1.0_wp - friction%hot_share)/(friction%hot_temperature &
                                               - friction%cold_temperature)
        ! share = 1 - slope (before + gain share - cold), between its ends.
        share = (1.0_wp - slope*(before - friction%cold_temperature))/(1.0_wp + slope*gain)
        share = min(max(share, friction%hot_share), 1.0_wp)
    end function hot_share

    !> The share of `mu` that is left at a slip.
    elemental real(wp) function falling_share(friction, slip) result(share)
        type(friction_t), intent(in) :: friction !! checked
        real(wp), intent(in) :: slip             !! over the rolling speed, >= 0

        real(wp) :: t

        share = 1.0_wp
        if (.not. falls_with_slip(friction)) return
        t = slip*(friction%speed/friction%half_slip_speed)
        select case (friction%kind)
        case (friction_linear)
            share = max(0.0_wp, 1.0_wp - 0.5_wp*t)
        case (friction_rational)
            share = 1.0_wp/(1.0_wp + t)
        case (friction_exponential)
            share = exp(-log(2.0_wp)*t)
        end select
        share = friction%kinetic_share + (1.0_wp - friction%kinetic_share)*share
    end function falling_share

    !> The coefficient of a contact by its angle: that of the tread, of the flange, or linearly
    !> between both. The kinetic value goes with the static one.
    elemental real(wp) function friction_at_angle(friction, mu, gamma) result(mu_there)
        type(friction_t), intent(in) :: friction !! checked
        real(wp), intent(in) :: mu               !! on the tread
        real(wp), intent(in) :: gamma            !! contact angle, of either sign, rad

        real(wp) :: part

        mu_there = mu
        if (friction%flange_share == 1.0_wp) return
        part = (abs(gamma) - friction%tread_angle)/(friction%flange_angle - friction%tread_angle)
        part = min(max(part, 0.0_wp), 1.0_wp)
        mu_there = mu*(1.0_wp + part*(friction%flange_share - 1.0_wp))
    end function friction_at_angle

    !> The material whose tangential compliance is that of the surfaces with their contamination;
    !> not for the normal problem.
    elemental type(material_t) function softened(material, friction)
        type(material_t), intent(in) :: material !! moduli in MPa
        type(friction_t), intent(in) :: friction !! checked

        softened = material
        softened%e_wheel = friction%slope_factor*material%e_wheel
        softened%e_rail = friction%slope_factor*material%e_rail
    end function softened
end module faststrip_base_friction
