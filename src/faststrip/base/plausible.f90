!> What the numbers of wheel/rail contacts are like in practice: one table of quantities, their
!> units, their ranges, and the mistake that a number outside of its range mostly is.
!>
!> A number outside of practice may still be meant; whoever takes it says so in one line, and no
!> result changes by it. What no contact can have is refused where it is taken
!> (`check_material`, `check_state`, ...); their bounds stand here, too.
module faststrip_base_plausible
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: message_length, number_text, add_words
    implicit none
    private

    public :: quantity_t, quantities, is_plausible, doubt_about, likely_mistake, stiffness
    public :: of_friction, of_stiff_modulus, of_soft_modulus, of_poisson_ratio, of_radius
    public :: of_gap_radius, of_load, of_penetration, of_creepage, of_spin, of_gap_width
    public :: of_gap_height, of_profile_width, of_inclination, of_contact_angle, of_turn
    public :: of_speed, of_slip_speed, of_pitch, of_shift, of_curve, of_gauge, of_tread_line
    public :: of_gauge_depth, of_yield, of_noise, of_pressure

    !> No bound.
    real(wp), parameter :: any_size = huge(1.0_wp)

    !> What a range is given over: a number, or a power of the rolling radius.
    integer, parameter :: over_one = 0, over_radius = 1, over_area = 2, over_curvature = -1

    !> A quantity. Its ranges are those of its size, whatever its sign; 0 is never too small.
    type :: quantity_t
        character(len=26) :: name = ''   !! in a few words
        character(len=10) :: unit = ''   !! of ranges, with the power of the radius
        integer :: power = 0             !! of the rolling radius that it is given over
        real(wp) :: possible = any_size  !! what no contact goes beyond
        real(wp) :: least = 0.0_wp       !! in practice
        real(wp) :: most = any_size      !! in practice
        character(len=44) :: below = ''  !! what a smaller number mostly is
        character(len=44) :: above = ''  !! what a larger one mostly is
    end type quantity_t

    ! Places in the table.
    integer, parameter :: of_friction = 1, of_stiff_modulus = 2, of_soft_modulus = 3, &
        of_poisson_ratio = 4, of_radius = 5, of_gap_radius = 6, of_load = 7, of_penetration = 8, &
        of_creepage = 9, of_spin = 10, of_gap_width = 11, of_gap_height = 12, &
        of_profile_width = 13, of_inclination = 14, of_contact_angle = 15, of_turn = 16, &
        of_speed = 17, of_slip_speed = 18, of_pitch = 19, of_shift = 20, of_curve = 21, &
        of_gauge = 22, of_tread_line = 23, of_gauge_depth = 24, of_yield = 25, of_noise = 26, &
        of_pressure = 27

    !> The table.
    !> Tuned [see unit]. Origin: chosen: dry rails and brake tests; aluminium to hard metal, and
    !> below Poisson's ratios of 0.4 nothing softer; discs of 2-disc machines to wheels of
    !> locomotives, flanges of 75 degrees; a wheel of 460 mm under 4 kN; sliding wheels in tests;
    !> 1 to 600 km/h; curves of works tracks; model tracks to cranes; ISO 76:2006 for the maximum
    !> pressure that hardened steel carries at rest.
    type(quantity_t), parameter :: quantities(*) = [ &
        quantity_t('coefficient of friction', '1', over_one, any_size, 0.0_wp, 1.0_wp, '', &
                   'percent'), &
        quantity_t("Young's modulus", 'MPa', over_one, any_size, 1.0e3_wp, 1.0e6_wp, 'GPa', &
                   'Pa or kPa'), &
        quantity_t("Young's modulus, nu > 0.4", 'MPa', over_one, any_size, 1.0_wp, 1.0e6_wp, &
                   'GPa', 'Pa or kPa'), &
        quantity_t("Poisson's ratio", '1', over_one, 0.5_wp, 0.0_wp, 0.5_wp, '', 'percent'), &
        quantity_t('rolling radius', 'mm', over_one, any_size, 5.0_wp, 700.0_wp, &
                   'metres or inches', 'the diameter'), &
        quantity_t('1/(2 inv2r)', 'mm', over_one, any_size, 5.0_wp, 2.7e3_wp, &
                   '1/m, or the radius itself', '1/(2 R) of the diameter'), &
        quantity_t('load', 'N/mm^2 R^2', over_area, any_size, 2.0e-3_wp, any_size, &
                   'kN or tonnes', ''), &
        quantity_t('penetration', 'R', over_radius, any_size, 1.0e-6_wp, 0.03_wp, 'metres', &
                   'micrometres'), &
        quantity_t('creepage', '1', over_one, any_size, 0.0_wp, 0.3_wp, '', 'percent'), &
        quantity_t('spin creepage', '1/R', over_curvature, any_size, 0.0_wp, 4.0_wp, '', &
                   '1/m'), &
        quantity_t('width of a gap', 'R', over_radius, any_size, 5.0e-3_wp, 3.0_wp, &
                   'metres or inches', 'micrometres'), &
        quantity_t('height of a gap over width', '1', over_one, any_size, 2.0e-5_wp, 2.0_wp, &
                   'heights in metres', 'heights in micrometres'), &
        quantity_t('width of a profile', 'R', over_radius, any_size, 0.03_wp, 3.0_wp, &
                   'metres or inches', 'micrometres, or the radius in inches'), &
        quantity_t('inclination of the rail', '1', over_one, any_size, 0.0_wp, 0.1_wp, '', &
                   'degrees, percent, or 40 for 1:40'), &
        quantity_t('contact angle', 'rad', over_one, any_size, 0.0_wp, 1.5_wp, '', 'degrees'), &
        quantity_t('yaw or roll', 'rad', over_one, 0.5_wp, 0.0_wp, 0.1_wp, '', &
                   'degrees or mrad'), &
        quantity_t('speed', 'mm/s', over_one, any_size, 250.0_wp, 1.7e5_wp, 'm/s or km/h', &
                   'um/s'), &
        quantity_t('slip speed', 'mm/s', over_one, any_size, 20.0_wp, 1.0e5_wp, 'm/s', 'um/s'), &
        quantity_t('rim speed over speed', '1', over_one, any_size, 0.0_wp, 3.0_wp, '', &
                   'degrees or turns a minute'), &
        quantity_t('lateral shift', 'mm', over_one, any_size, 0.0_wp, 50.0_wp, '', &
                   'micrometres'), &
        quantity_t('radius of a curve', 'mm', over_one, any_size, 8.0e3_wp, any_size, &
                   'metres', ''), &
        quantity_t('gauge, distance of backs', 'mm', over_one, any_size, 60.0_wp, 6.0e4_wp, &
                   'metres or inches', 'micrometres'), &
        quantity_t('nominal rolling circle', 'mm', over_one, any_size, 1.0_wp, 300.0_wp, 'metres', &
                   'micrometres'), &
        quantity_t('depth of the gauge', 'mm', over_one, any_size, 0.5_wp, 100.0_wp, 'metres', &
                   'micrometres'), &
        quantity_t('yield stress', 'MPa', over_one, any_size, 10.0_wp, 1.0e4_wp, 'GPa', &
                   'Pa or kPa'), &
        quantity_t('noise', 'um', over_one, any_size, 0.01_wp, 500.0_wp, 'mm', 'nm'), &
        quantity_t('maximum pressure', 'MPa', over_one, any_size, 0.0_wp, 4.2e3_wp, '', &
                   'a unit, or an edge that would yield')]

contains

    !> Which modulus is meant: rubber and plastics, with a Poisson's ratio near 0.5, are softer than
    !> any other body that rolls.
    pure integer function stiffness(nu)
        real(wp), intent(in) :: nu !! Poisson's ratio

        real(wp), parameter :: of_plastics = 0.4_wp ! Given: nu from which the table tells another

        stiffness = merge(of_soft_modulus, of_stiff_modulus, nu >= of_plastics)
    end function stiffness

    !> Words about a number that is outside of practice: what it should be, what was got, the likely
    !> mistake. Blank where there is nothing to say, also of what is given over a radius that is not
    !> known, or itself in doubt.
    pure function doubt_about(quantity, name, value, radius) result(words)
        integer, intent(in) :: quantity          !! place in the table
        character(len=*), intent(in) :: name     !! as the caller knows it
        real(wp), intent(in) :: value            !! of it, in the unit of the table
        real(wp), intent(in), optional :: radius !! rolling radius, mm; 0: not known
        character(len=message_length) :: words   !! of fixed length: nothing is allocated

        real(wp) :: least, most

        words = ''
        if (is_plausible(quantity, value, radius)) return
        call range_of(quantity, radius, least, most)
        words = name
        if (abs(value) > most) then
            call add_words(words, ' should be at most ' // number_text(most))
            call add_words(words, ', got ' // number_text(value))
            call add_words(words, ': ' // quantities(quantity)%above)
        else
            call add_words(words, ' should be at least ' // number_text(least))
            call add_words(words, ', got ' // number_text(value))
            call add_words(words, ': ' // quantities(quantity)%below)
        end if
        call add_words(words, '?')
    end function doubt_about

    !> What a number beyond the possible mostly is, as `, percent?`; blank where it is possible.
    pure function likely_mistake(quantity, value) result(words)
        integer, intent(in) :: quantity !! place in the table
        real(wp), intent(in) :: value   !! in the unit of the table
        character(len=48) :: words

        words = ''
        if (.not. ieee_is_finite(value)) return
        if (.not. abs(value) > quantities(quantity)%possible) return
        words = ': ' // quantities(quantity)%above
        call add_words(words, '?')
    end function likely_mistake

    !> Is a number within practice? It counts as such where it is given over a radius that is not
    !> known, or itself in doubt, and where it is not finite, which others refuse.
    pure logical function is_plausible(quantity, value, radius)
        integer, intent(in) :: quantity          !! place in the table
        real(wp), intent(in) :: value            !! in the unit of the table
        real(wp), intent(in), optional :: radius !! rolling radius, mm; 0: not known

        real(wp) :: least, most

        is_plausible = .true.
        if (quantities(quantity)%power /= over_one) then
            if (.not. present(radius)) return
            if (.not. (radius >= quantities(of_gap_radius)%least .and. &
                       radius <= quantities(of_gap_radius)%most)) return
        end if
        if (.not. ieee_is_finite(value)) return
        call range_of(quantity, radius, least, most)
        is_plausible = .not. (abs(value) > most .or. &
                              (abs(value) < least .and. abs(value) > 0.0_wp))
    end function is_plausible

    !> The range of a quantity in practice.
    pure subroutine range_of(quantity, radius, least, most)
        integer, intent(in) :: quantity
        real(wp), intent(in), optional :: radius
        real(wp), intent(out) :: least, most

        real(wp) :: scale

        least = quantities(quantity)%least
        most = quantities(quantity)%most
        if (quantities(quantity)%power == over_one) return
        scale = radius**quantities(quantity)%power
        least = least*scale
        if (most < any_size) most = most*scale
    end subroutine range_of
end module faststrip_base_plausible
