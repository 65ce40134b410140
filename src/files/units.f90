!> Units of table columns, which stand at the end of their names, in the words of UDUNITS.
module faststrip_files_units
    use faststrip_base_text, only: lower_case
    implicit none
    private

    public :: column_unit, without_unit

    type :: unit_t
        character(len=11) :: ending !! of a column's name, behind an underscore
        character(len=10) :: unit   !! in the words of UDUNITS
    end type unit_t

    ! Of two that fit the later one counts: an ending stands behind those that it ends with.
    type(unit_t), parameter :: units(*) = [ &
        unit_t('mm', 'mm'), unit_t('um', 'um'), unit_t('m', 'm'), unit_t('km', 'km'), &
        unit_t('mm2', 'mm2'), unit_t('mm3', 'mm3'), unit_t('per_mm', 'mm-1'), &
        unit_t('rad', 'rad'), unit_t('mrad', 'mrad'), unit_t('deg', 'degree'), &
        unit_t('rad_per_mm', 'rad mm-1'), &
        unit_t('N', 'N'), unit_t('kN', 'kN'), unit_t('Nmm', 'N mm'), unit_t('Nm', 'N m'), &
        unit_t('kNm', 'kN m'), &
        unit_t('Pa', 'Pa'), unit_t('MPa', 'MPa'), unit_t('GPa', 'GPa'), &
        unit_t('N_per_mm2', 'N mm-2'), &
        unit_t('s', 's'), unit_t('ms', 'ms'), unit_t('us', 'us'), unit_t('ns', 'ns'), &
        unit_t('mm_s', 'mm s-1'), unit_t('m_s', 'm s-1'), unit_t('km_h', 'km h-1'), &
        unit_t('rad_s', 'rad s-1'), unit_t('mrad_s', 'mrad s-1'), unit_t('deg_s', 'degree s-1'), &
        unit_t('ug_per_m', 'ug m-1'), unit_t('mm3_per_m', 'mm3 m-1'), &
        unit_t('mm_per_km', 'mm km-1'), &
        unit_t('K', 'K'), unit_t('C', 'degC'), unit_t('W_per_mK', 'W m-1 K-1'), &
        unit_t('J_per_kgK', 'J kg-1 K-1'), unit_t('kg_per_m3', 'kg m-3'), &
        ! A pass is counted.
        unit_t('mm_per_pass', 'mm')]

contains

    !> The unit of a column by the end of its name: `mm-1` of `inv2R_per_mm`. Empty where the name
    !> ends in no unit that is known here: it may have none.
    pure function column_unit(name) result(unit)
        character(len=*), intent(in) :: name  !! of a column
        character(len=len(units%unit)) :: unit
        integer :: i, from

        unit = ''
        do i = 1, size(units)
            ! Before the underscore stands what is measured.
            from = len(name) - len_trim(units(i)%ending)
            if (from < 2) cycle
            if (name(from:) == '_' // trim(units(i)%ending)) unit = units(i)%unit
        end do
    end function column_unit

    pure integer function length_without_unit(name) result(length)
        character(len=*), intent(in) :: name
        integer :: i, from

        length = len(name)
        do i = 1, size(units)
            from = len(name) - len_trim(units(i)%ending)
            if (from < 2) cycle
            if (name(from:) == '_' // lower_case(trim(units(i)%ending))) &
                length = min(length, from - 1)
        end do
    end function length_without_unit

    !> A column's name in small letters without its unit: `inv2r` of `inv2r_per_mm`.
    pure function without_unit(name) result(what)
        character(len=*), intent(in) :: name !! of a column, in small letters
        character(len=length_without_unit(name)) :: what

        what = name
    end function without_unit

end module faststrip_files_units
