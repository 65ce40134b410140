!> Room for the wear of a contact's strips behind a handle of the C and F77 faces, and the figures
!> of one contact: T gamma, the fatigue index, wear by a law.
module faststrip_interop_wear_room
    use, intrinsic :: iso_c_binding, only: c_double
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    use faststrip_contact_methods, only: tangential_none, tangential_faststrip, &
                                         tangential_faststrip_plain, tangential_method_name
    use faststrip_contact_method, only: contact_result_t
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: strip_forces_t
    use faststrip_tangential_wear_law, only: wear_law_t, wear_t, check_wear_law, most_regimes, &
                                             find_strip_wear
    use faststrip_tangential_wear_numbers, only: t_gamma, t_gamma_with_spin, surface_fatigue_index
    implicit none
    private

    public :: wear_room_t, reserve_wear_room, fill_law, check_forces, check_strip_forces
    public :: contact_figures, n_regime, n_wear

    !> Numbers of a regime, and of the figures.
    !> Given: lengths of the lists below.
    integer, parameter :: n_regime = 4, n_wear = 6

    !> Of each strip.
    type :: wear_room_t
        type(wear_law_t) :: law                !! of the last question; here, not on a stack
        real(wp), allocatable :: densities(:)  !! T gamma/A, N/mm^2
        real(wp), allocatable :: mass(:)       !! ug per metre rolled
        real(wp), allocatable :: pass_depth(:) !! depth when rolled over once, mm
    end type wear_room_t

contains

    !> Allocate for strips.
    subroutine reserve_wear_room(room, capacity)
        type(wear_room_t), intent(inout) :: room !! sized
        integer, intent(in) :: capacity          !! largest number of strips

        if (allocated(room%mass)) deallocate (room%densities, room%mass, room%pass_depth)
        allocate (room%densities(capacity), room%mass(capacity), room%pass_depth(capacity), &
                  source=0.0_wp)
    end subroutine reserve_wear_room

    !> A law of regimes; without regimes there is none.
    pure subroutine fill_law(regimes, density, law, status)
        real(c_double), intent(in) :: regimes(:, :) !! T gamma/A where each begins and ends,
                                                    !! N/mm^2; constant, ug/(m mm^2), and slope,
                                                    !! ug/(m N), of the wear rate
        real(c_double), intent(in) :: density       !! of what is worn, kg/m^3
        type(wear_law_t), intent(inout) :: law      !! checked
        type(status_t), intent(out) :: status       !! those of `check_wear_law`

        integer :: i, n

        call clear_status(status)
        n = size(regimes, 2)
        law%n = n
        law%density = density
        if (n == 0) return
        do i = 1, min(n, most_regimes)
            law%from(i) = regimes(1, i)
            law%to(i) = regimes(2, i)
            law%constant(i) = regimes(3, i)
            law%slope(i) = regimes(4, i)
        end do
        call check_wear_law(law, status)
    end subroutine fill_law

    !> Refuse what there is no wear of: no contact, or one without creep forces.
    pure subroutine check_forces(result, tangential, status)
        type(contact_result_t), intent(in) :: result !! of the last solution
        integer, intent(in) :: tangential            !! the method it is by
        type(status_t), intent(out) :: status        !! `st_bad_argument`

        call clear_status(status)
        if (.not. result%normal%area > 0.0_wp) then
            call set_status(status, st_bad_argument, 'there is no contact that was solved')
        else if (tangential == tangential_none) then
            call set_status(status, st_bad_argument, 'there is no wear without creep forces: ' // &
                            'the tangential method is none')
        end if
    end subroutine check_forces

    !> Refuse methods that do not sum forces over strips.
    pure subroutine check_strip_forces(tangential, status)
        integer, intent(in) :: tangential       !! the method
        type(status_t), intent(inout) :: status !! `st_bad_argument`

        if (all(tangential /= [tangential_faststrip, tangential_faststrip_plain])) &
            call set_status(status, st_bad_argument, 'forces of strips, and wear by a law, need ' &
                            // 'the tangential method faststrip or faststrip-plain, got ' &
                            // tangential_method_name(tangential))
    end subroutine check_strip_forces

    !> The figures of a contact; wear is 0 without a law.
    pure subroutine contact_figures(result, creepage, yield_shear, strips, forces, room, figures, &
                                    status)
        type(contact_result_t), intent(in) :: result !! with forces
        type(creepage_t), intent(in) :: creepage     !! about the same point
        real(c_double), intent(in) :: yield_shear    !! in cyclic shear, MPa; 0: not known
        type(contact_strips_t), intent(in) :: strips !! of the contact
        type(strip_forces_t), intent(in) :: forces   !! of the strips, where there is a law
        type(wear_room_t), intent(inout) :: room     !! with the law
        real(c_double), intent(out) :: figures(n_wear)
            !! T gamma, with spin, N; T gamma over the area, N/mm^2; fatigue index; wear, ug and
            !! mm^3 per metre rolled; zeros on an error
        type(status_t), intent(out) :: status
            !! `st_bad_argument`: the yield stress; those of `find_strip_wear`

        type(wear_t) :: wear

        figures = 0.0_c_double
        call clear_status(status)
        if (.not. (yield_shear >= 0.0_c_double .and. ieee_is_finite(yield_shear))) then
            call set_status(status, st_bad_argument, 'the yield stress in shear must not be ' // &
                            'negative, got ' // trim(number_text(yield_shear)) // ' MPa')
            return
        end if
        if (room%law%n > 0) then
            call find_strip_wear(room%law, strips, forces, room%densities, room%mass, &
                                 room%pass_depth, wear, status)
            if (is_error(status)) return
        end if
        associate (normal => result%normal, tangential => result%tangential)
            figures(1) = t_gamma(tangential, creepage)
            figures(2) = t_gamma_with_spin(tangential, creepage)
            figures(3) = figures(1)/normal%area
            if (yield_shear > 0.0_c_double) figures(4) = &
                surface_fatigue_index(tangential, normal%load, normal%area, yield_shear)
            figures(5:) = [wear%mass, wear%volume]
        end associate
    end subroutine contact_figures
end module faststrip_interop_wear_room
