!> T gamma, wear and fatigue of one contact, as the CSV shows them.
module faststrip_command_rows_wear_figures
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_tangential_types, only: strip_forces_t
    use faststrip_tangential_wear_law, only: wear_law_t, wear_t, find_strip_wear, &
                                             wheel_depth_per_km
    use faststrip_tangential_wear_numbers, only: strip_power_densities
    implicit none
    private

    public :: strip_wear_t, make_strip_wear

    !> Wear of the strips of one contact.
    type :: strip_wear_t
        real(wp), allocatable :: t_gamma_per_area(:) !! N/mm2; not allocated: not known
        real(wp), allocatable :: mass(:)             !! ug/m; not allocated: no law, or not known
        real(wp), allocatable :: pass_depth(:)       !! mm; the same
        real(wp), allocatable :: depth_per_km(:)     !! of a wheel, mm/km; not allocated: no
                                                     !! rolling radius, or the law is of the rail
    end type strip_wear_t

contains

    !> Wear of a contact that was solved with forces, strip by strip.
    subroutine make_strip_wear(law, strips, forces, radius, wear)
        type(wear_law_t), intent(in) :: law          !! no regimes: none
        type(contact_strips_t), intent(in) :: strips !! of the contact
        type(strip_forces_t), intent(in) :: forces   !! of the strips; empty: not known
        real(wp), intent(in) :: radius               !! rolling radius, mm; 0: not known
        type(strip_wear_t), intent(out) :: wear      !! what is known

        type(status_t) :: status
        type(wear_t) :: total

        if (forces%n /= strips%n) return
        allocate (wear%t_gamma_per_area(strips%n), source=0.0_wp)
        call strip_power_densities(strips, forces, wear%t_gamma_per_area, status)
        if (law%n == 0) return
        allocate (wear%mass(strips%n), wear%pass_depth(strips%n), source=0.0_wp)
        call find_strip_wear(law, strips, forces, wear%t_gamma_per_area, wear%mass, &
                             wear%pass_depth, total, status)
        if (is_error(status)) then
            deallocate (wear%mass, wear%pass_depth)
        else if (law%of_wheel .and. radius > 0.0_wp) then
            wear%depth_per_km = wheel_depth_per_km(wear%pass_depth, radius)
        end if
    end subroutine make_strip_wear
end module faststrip_command_rows_wear_figures
