!> T gamma, wear and fatigue of one contact, as the CSV shows them.
module faststrip_command_wear_figures
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_base_creepage, only: creepage_t
    use faststrip_files_wear_law, only: read_wear_law
    use faststrip_normal_strips, only: contact_strips_t
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t, strip_forces_t
    use faststrip_tangential_wear_law, only: wear_law_t, wear_t, find_strip_wear, &
                                             wheel_depth_per_km
    use faststrip_tangential_wear_numbers, only: t_gamma, t_gamma_with_spin, &
                                                 surface_fatigue_index, strip_power_densities
    use faststrip_command_console, only: fail_on_error
    implicit none
    private

    public :: wear_choice_t, wear_figures_t, take_wear_law, find_wear_figures
    public :: strip_wear_t, make_strip_wear

    !> What the user gave of wear and fatigue.
    type :: wear_choice_t
        type(wear_law_t) :: law                      !! no regimes: none
        character(len=:), allocatable :: file        !! its file; or not allocated
        character(len=:), allocatable :: source      !! what the file names as its source
        real(wp) :: yield_shear_mpa = 0.0_wp         !! in cyclic shear, MPa; 0: not known
    end type wear_choice_t

    !> Figures of one contact.
    type :: wear_figures_t
        real(wp) :: t_gamma = 0.0_wp          !! N
        real(wp) :: t_gamma_spin = 0.0_wp     !! with spin, N
        real(wp) :: t_gamma_per_area = 0.0_wp !! without spin, N/mm2
        real(wp) :: fatigue_index = 0.0_wp    !! if `knows_fatigue`
        logical :: knows_fatigue = .false.    !! was the yield stress in shear given?
        type(wear_t) :: wear                  !! if `knows_wear`
        logical :: knows_wear = .false.       !! is there a law, and does it go as far?
        character(len=:), allocatable :: words !! why there is no wear in spite of a law; or empty
    end type wear_figures_t

    !> Wear of the strips of one contact.
    type :: strip_wear_t
        real(wp), allocatable :: t_gamma_per_area(:) !! N/mm2; not allocated: not known
        real(wp), allocatable :: mass(:)             !! ug/m; not allocated: no law, or not known
        real(wp), allocatable :: pass_depth(:)       !! mm; the same
        real(wp), allocatable :: depth_per_km(:)     !! of a wheel, mm/km; not allocated: no
                                                     !! rolling radius, or the law is of the rail
    end type strip_wear_t

contains

    !> Read a wear law; ends the program with one line at what is wrong.
    subroutine take_wear_law(path, choice)
        character(len=*), intent(in) :: path          !! name of the file
        type(wear_choice_t), intent(inout) :: choice !! gets law and source

        type(status_t) :: status

        call read_wear_law(path, choice%law, choice%source, status)
        call fail_on_error(status)
        choice%file = path
    end subroutine take_wear_law

    !> The figures of a contact that was solved, with forces.
    subroutine find_wear_figures(choice, normal, tangential, creepage, strips, forces, figures)
        type(wear_choice_t), intent(in) :: choice           !! law, yield stress
        type(normal_result_t), intent(in) :: normal         !! load, area
        type(tangential_result_t), intent(in) :: tangential !! forces
        type(creepage_t), intent(in) :: creepage            !! about the same point
        type(contact_strips_t), intent(in) :: strips        !! of the contact
        type(strip_forces_t), intent(in) :: forces          !! of the strips; empty: not known
        type(wear_figures_t), intent(out) :: figures        !! of the contact

        real(wp), dimension(strips%n) :: densities, mass, pass_depth
        type(status_t) :: status

        figures%words = ''
        figures%t_gamma = t_gamma(tangential, creepage)
        figures%t_gamma_spin = t_gamma_with_spin(tangential, creepage)
        figures%t_gamma_per_area = figures%t_gamma/normal%area
        figures%knows_fatigue = choice%yield_shear_mpa > 0.0_wp
        if (figures%knows_fatigue) figures%fatigue_index = &
            surface_fatigue_index(tangential, normal%load, normal%area, choice%yield_shear_mpa)
        if (choice%law%n == 0 .or. forces%n /= strips%n) return
        call find_strip_wear(choice%law, strips, forces, densities, mass, pass_depth, &
                             figures%wear, status)
        figures%knows_wear = .not. is_error(status)
        if (is_error(status)) figures%words = 'no wear: ' // trim(status%message)
    end subroutine find_wear_figures

    !> The same strip by strip.
    subroutine make_strip_wear(choice, strips, forces, radius, wear)
        type(wear_choice_t), intent(in) :: choice    !! law
        type(contact_strips_t), intent(in) :: strips !! of the contact
        type(strip_forces_t), intent(in) :: forces   !! of the strips; empty: not known
        real(wp), intent(in) :: radius               !! rolling radius, mm; 0: not known
        type(strip_wear_t), intent(out) :: wear      !! what is known

        type(status_t) :: status
        type(wear_t) :: total

        if (forces%n /= strips%n) return
        allocate (wear%t_gamma_per_area(strips%n), source=0.0_wp)
        call strip_power_densities(strips, forces, wear%t_gamma_per_area, status)
        if (choice%law%n == 0) return
        allocate (wear%mass(strips%n), wear%pass_depth(strips%n), source=0.0_wp)
        call find_strip_wear(choice%law, strips, forces, wear%t_gamma_per_area, wear%mass, &
                             wear%pass_depth, total, status)
        if (is_error(status)) then
            deallocate (wear%mass, wear%pass_depth)
        else if (choice%law%of_wheel .and. radius > 0.0_wp) then
            wear%depth_per_km = wheel_depth_per_km(wear%pass_depth, radius)
        end if
    end subroutine make_strip_wear
end module faststrip_command_wear_figures
