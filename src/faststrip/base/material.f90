!> Elastic constants of the two bodies and their combinations.
module faststrip_base_material
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_plausible, only: likely_mistake, of_poisson_ratio
    use faststrip_base_status, only: status_t, set_status, clear_status, number_text, &
                                     st_bad_material, st_not_finite
    implicit none
    private

    public :: material_t, check_material, check_compliance, normal_compliance
    public :: combined_shear_modulus
    public :: combined_poisson_ratio

    !> Linear elastic, isotropic wheel and rail; steel on steel by default.
    type :: material_t
        real(wp) :: e_wheel = 209920.0_wp !! Young's modulus of the wheel, MPa
        real(wp) :: e_rail = 209920.0_wp  !! Young's modulus of the rail, MPa
        real(wp) :: nu_wheel = 0.28_wp    !! Poisson's ratio of the wheel
        real(wp) :: nu_rail = 0.28_wp     !! Poisson's ratio of the rail
    end type material_t

contains

    !> Refuse moduli that are not positive and Poisson's ratios outside [0, 0.5). Below zero the
    !> creep forces have no table and pass their bounds; at 0.5 nothing can be compressed.
    pure subroutine check_material(material, status)
        type(material_t), intent(in) :: material !! moduli in MPa
        type(status_t), intent(out) :: status    !! `st_not_finite`, `st_bad_material`

        call clear_status(status)
        call check_body('wheel', material%e_wheel, material%nu_wheel, status)
        if (status%code /= 0) return
        call check_body('rail', material%e_rail, material%nu_rail, status)
    end subroutine check_material

    pure subroutine check_body(name, e, nu, status)
        character(len=*), intent(in) :: name
        real(wp), intent(in) :: e, nu
        type(status_t), intent(inout) :: status

        if (.not. ieee_is_finite(e)) then
            call set_status(status, st_not_finite, "Young's modulus of the " // name // &
                            ' must be a finite number, got ' // trim(number_text(e)))
        else if (.not. ieee_is_finite(nu)) then
            call set_status(status, st_not_finite, "Poisson's ratio of the " // name // &
                            ' must be a finite number, got ' // trim(number_text(nu)))
        else if (e <= 0.0_wp) then
            call set_status(status, st_bad_material, "Young's modulus of the " // name // &
                            ' must be above 0, got ' // trim(number_text(e)) // ' MPa')
        else if (nu < 0.0_wp .or. nu >= 0.5_wp) then
            call set_status(status, st_bad_material, "Poisson's ratio of the " // name // &
                            ' must be at least 0 and below 0.5, got ' // &
                            trim(number_text(nu)) // likely_mistake(of_poisson_ratio, nu))
        end if
    end subroutine check_body

    !> Refuse a compliance no surface has.
    pure subroutine check_compliance(compliance, status)
        real(wp), intent(in) :: compliance    !! H of eq. (4), 1/MPa
        type(status_t), intent(out) :: status !! `st_not_finite`, `st_bad_material`

        call clear_status(status)
        if (.not. ieee_is_finite(compliance)) then
            call set_status(status, st_not_finite, &
                            'the compliance must be a finite number, got ' // &
                            number_text(compliance))
        else if (compliance <= 0.0_wp) then
            call set_status(status, st_bad_material, 'the compliance must be above 0, got ' // &
                            number_text(compliance))
        end if
    end subroutine check_compliance

    !> H of eq. (4): displacement per unit influence integral and pressure, 1/MPa.
    pure real(wp) function normal_compliance(material) result(h)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        h = ((1.0_wp - material%nu_wheel**2)/material%e_wheel &
             + (1.0_wp - material%nu_rail**2)/material%e_rail)/pi
    end function normal_compliance

    !> G12 of eq. (25): harmonic mean of the two shear moduli, MPa.
    pure real(wp) function combined_shear_modulus(material) result(g)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        g = 1.0_wp/((1.0_wp + material%nu_wheel)/material%e_wheel &
                    + (1.0_wp + material%nu_rail)/material%e_rail)
    end function combined_shear_modulus

    !> nu of the combined body, with nu/G the mean of the two bodies' (Kalker 1990).
    pure real(wp) function combined_poisson_ratio(material) result(nu)
        type(material_t), intent(in) :: material !! checked moduli, MPa

        nu = combined_shear_modulus(material) &
             *(material%nu_wheel*(1.0_wp + material%nu_wheel)/material%e_wheel &
               + material%nu_rail*(1.0_wp + material%nu_rail)/material%e_rail)
    end function combined_poisson_ratio
end module faststrip_base_material
