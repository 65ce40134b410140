!> Wear by coefficients: what is worn off in rolling, as a function of T gamma over the area.
!>
!> A law gives the wear rate K in ug per metre rolled and mm^2 of contact, piece by piece: in each
!> regime of T gamma/A, from one limit to the next, `K = constant + slope (T gamma/A)`. Where two
!> regimes meet the upper one counts. Above the last one the law says nothing, unless it is open:
!> then it has no end. Coefficients are printed rounded, so that rates and limits have to fit within
!> that only; a rate that comes out below 0 by it is 0.
!>
!> A strip of area A_k loses `m = K A_k` ug per metre rolled, which is the volume `m/rho` mm^3 per
!> metre, rho in kg/m^3. Rolled over once, wheel or rail loses across the strip the area
!> `1e-3 m/rho` mm^2 and over its width w the depth `1e-3 m/(rho w)` mm. A point of a wheel of
!> radius r is rolled over once in 2 pi r.
module faststrip_tangential_wear_law
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     count_text, st_bad_argument, st_not_increasing, &
                                     st_out_of_range, st_workspace_too_small
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: strip_forces_t
    use faststrip_tangential_wear_numbers, only: strip_power_densities
    implicit none
    private

    public :: wear_law_t, wear_t, check_wear_law, find_wear_rate, find_strip_wear, &
              wheel_depth_per_km
    public :: most_regimes, no_limit

    !> The most regimes of a law.
    !> Tuned [regimes]. Origin: capacity.
    integer, parameter :: most_regimes = 32
    !> Where a regime ends that has no end, N/mm^2.
    real(wp), parameter :: no_limit = huge(1.0_wp)
    !> By how much of its parts a rate may be below 0, and of itself a limit beside the one before.
    !> Tuned [1]. Origin: a coefficient of three figures is rounded by up to half a percent, one of
    !> four by less than this; the published ones have three to five.
    real(wp), parameter :: print_rounding = 1.0e-3_wp

    ! Given: units: mm in a metre and in a kilometre.
    real(wp), parameter :: mm_per_m = 1.0e3_wp
    real(wp), parameter :: mm_per_km = 1.0e6_wp ! Given: units.

    !> A law. The first `n` regimes count.
    type :: wear_law_t
        integer :: n = 0                             !! number of regimes; 0: no law
        real(wp) :: from(most_regimes) = 0.0_wp      !! T gamma/A where a regime begins, N/mm^2
        real(wp) :: to(most_regimes) = 0.0_wp        !! where it ends, N/mm^2; of the last one
                                                     !! `no_limit` or infinity: nowhere
        real(wp) :: constant(most_regimes) = 0.0_wp  !! of the wear rate, ug/(m mm^2)
        real(wp) :: slope(most_regimes) = 0.0_wp     !! the same over T gamma/A, ug/(m N)
        real(wp) :: density = 0.0_wp                 !! of what is worn, kg/m^3
        logical :: of_wheel = .true.                 !! is it of the wheel, or of the rail?
    end type wear_law_t

    !> Wear of a contact, of wheel or rail.
    type :: wear_t
        real(wp) :: mass = 0.0_wp   !! ug per metre rolled
        real(wp) :: volume = 0.0_wp !! mm^3 per metre rolled; 1e-3 of it, mm^2, is the area
                                    !! across that one passage removes
    end type wear_t

contains

    !> Is it a law? Its regimes have to begin at 0, to follow each other without a hole, and no
    !> wear rate may be negative, both as far as rounded figures tell.
    pure subroutine check_wear_law(law, status, regime)
        type(wear_law_t), intent(in) :: law   !! to be checked
        type(status_t), intent(out) :: status !! `st_bad_argument`, `st_not_increasing`
        integer, intent(out), optional :: regime !! the one at fault, 0: none of them

        real(wp) :: last
        integer :: i
        logical :: is_open

        call clear_status(status)
        if (present(regime)) regime = 0
        if (law%n < 1 .or. law%n > most_regimes) then
            call set_status(status, st_bad_argument, 'a wear law must have 1 to ' // &
                            trim(count_text(most_regimes)) // ' regimes, got ' // &
                            count_text(law%n))
            return
        end if
        if (.not. (law%density > 0.0_wp .and. ieee_is_finite(law%density))) then
            call set_status(status, st_bad_argument, 'the density must be above 0, got ' &
                            // trim(number_text(law%density)) // ' kg/m3')
            return
        end if
        last = 0.0_wp
        do i = 1, law%n
            if (present(regime)) regime = i
            is_open = i == law%n .and. law%to(i) >= no_limit
            if (.not. abs(law%from(i) - last) <= print_rounding*last) then
                call set_status(status, st_not_increasing, 'a regime must begin where the one ' &
                                // 'before ends, the first at 0, got ' &
                                // trim(number_text(law%from(i))) // ' after ' &
                                // trim(number_text(last)))
            else if (.not. (law%to(i) > law%from(i) .and. (law%to(i) < no_limit .or. is_open))) then
                call set_status(status, st_not_increasing, 'a regime must end above its ' &
                                // 'beginning, got ' // trim(number_text(law%to(i))) &
                                // ' after ' // trim(number_text(law%from(i))))
            else if (.not. is_rate(law%constant(i), law%slope(i)*law%from(i))) then
                call refuse_rate(law%constant(i) + law%slope(i)*law%from(i), law%from(i), status)
            else if (is_open) then
                if (.not. law%slope(i) >= 0.0_wp) &
                    call set_status(status, st_bad_argument, 'the wear rate of a regime without ' &
                                    // 'an end must not fall, got a slope of ' &
                                    // number_text(law%slope(i)))
            else if (.not. is_rate(law%constant(i), law%slope(i)*law%to(i))) then
                call refuse_rate(law%constant(i) + law%slope(i)*law%to(i), law%to(i), status)
            end if
            if (is_error(status)) return
            last = law%to(i)
        end do
        if (present(regime)) regime = 0

    contains

        pure logical function is_rate(constant, rise)
            real(wp), intent(in) :: constant, rise ! its two parts

            is_rate = ieee_is_finite(constant + rise) .and. &
                constant + rise >= -print_rounding*(abs(constant) + abs(rise))
        end function is_rate

        pure subroutine refuse_rate(rate, density, status)
            real(wp), intent(in) :: rate, density
            type(status_t), intent(inout) :: status

            call set_status(status, st_bad_argument, 'a wear rate must not be negative within ' &
                            // 'its regime, got ' // trim(number_text(rate)) // ' ug/(m mm2) at ' &
                            // trim(number_text(density)) // ' N/mm2')
        end subroutine refuse_rate
    end subroutine check_wear_law

    !> Wear rate at a T gamma/A.
    pure subroutine find_wear_rate(law, density, rate, is_known)
        type(wear_law_t), intent(in) :: law  !! checked
        real(wp), intent(in) :: density      !! T gamma/A, N/mm^2, >= 0
        real(wp), intent(out) :: rate        !! ug/(m mm^2); 0 where it is not known
        logical, intent(out) :: is_known     !! does the law go as far?

        integer :: i

        rate = 0.0_wp
        is_known = law%n > 0 .and. ieee_is_finite(density)
        if (is_known) is_known = density >= 0.0_wp .and. density <= law%to(law%n)
        if (.not. is_known) return
        do i = law%n, 1, -1
            if (density >= law%from(i)) exit
        end do
        rate = max(law%constant(i) + law%slope(i)*density, 0.0_wp)
    end subroutine find_wear_rate

    !> Wear of each strip and of the contact, which is their sum. The arrays are the caller's; their
    !> first `strips%n` entries count, the others are 0. A strip without friction power is not worn,
    !> whatever the law says of 0.
    pure subroutine find_strip_wear(law, strips, forces, densities, mass, pass_depth, wear, status)
        type(wear_law_t), intent(in) :: law          !! checked
        type(contact_strips_t), intent(in) :: strips !! a normal solution
        type(strip_forces_t), intent(in) :: forces   !! of the same strips
        real(wp), intent(out) :: densities(:)  !! T gamma/A, N/mm^2
        real(wp), intent(out) :: mass(:)       !! ug per metre rolled
        real(wp), intent(out) :: pass_depth(:) !! depth when rolled over once, mm
        type(wear_t), intent(out) :: wear      !! of the contact
        type(status_t), intent(out) :: status
            !! `st_workspace_too_small`; `st_bad_argument`: forces of other strips;
            !! `st_out_of_range`: a T gamma/A beyond the law, no wear is given

        real(wp) :: width, rate
        logical :: is_known
        integer :: k

        mass = 0.0_wp
        pass_depth = 0.0_wp
        call strip_power_densities(strips, forces, densities, status)
        if (is_error(status)) return
        if (min(size(mass), size(pass_depth)) < strips%n) then
            call set_status(status, st_workspace_too_small, 'too little capacity for the strips')
            return
        end if
        do k = 1, strips%n
            if (densities(k) <= 0.0_wp) cycle
            call find_wear_rate(law, densities(k), rate, is_known)
            if (.not. is_known) then
                call set_status(status, st_out_of_range, 'the wear law ends at a T gamma/A of ' &
                                // trim(number_text(law%to(max(law%n, 1)))) // ' N/mm2, got ' &
                                // trim(number_text(densities(k))))
                mass = 0.0_wp
                pass_depth = 0.0_wp
                return
            end if
            width = strips%y_right(k) - strips%y_left(k)
            mass(k) = rate*2.0_wp*strips%half_length(k)*width
            pass_depth(k) = mass(k)/(mm_per_m*law%density*width)
        end do
        wear%mass = sum(mass(:strips%n))
        wear%volume = wear%mass/law%density
    end subroutine find_strip_wear

    !> Depth of wear of a wheel per kilometre it rolls, mm.
    elemental real(wp) function wheel_depth_per_km(pass_depth, radius)
        real(wp), intent(in) :: pass_depth !! when rolled over once, mm
        real(wp), intent(in) :: radius     !! rolling radius, mm, > 0

        wheel_depth_per_km = pass_depth*mm_per_km/(2.0_wp*pi*radius)
    end function wheel_depth_per_km
end module faststrip_tangential_wear_law
