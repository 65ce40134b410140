!> What every normal method takes and gives: what is prescribed, the figures, what they cost.
module faststrip_normal_types
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: demand_t, above_lowest, normal_result_t, cost_t

    !> What is prescribed: the load, or the penetration. Nothing else says so: a contact
    !> (`faststrip_contact_case`) extends it.
    type :: demand_t
        logical :: by_load = .true.      !! is the load given, or the penetration?
        real(wp) :: load = 0.0_wp        !! normal force, N
        real(wp) :: penetration = 0.0_wp !! approach from h = 0, mm
    end type demand_t

    !> What a solution cost.
    type :: cost_t
        integer :: iterations = 0 !! steps
        integer :: factorings = 0 !! those of them for which a Jacobian was factored
        integer :: values = 0     !! influence coefficients computed
        integer :: gradients = 0  !! influence coefficients computed with their derivatives
        real(wp) :: operations = 0.0_wp !! of the linear algebra, multiplications and additions
    end type cost_t

    !> Figures of a solution.
    type :: normal_result_t
        real(wp) :: load = 0.0_wp        !! normal force, N
        real(wp) :: penetration = 0.0_wp !! approach D of the bodies, from h = 0, mm
        ! Given: none.
        real(wp) :: correction = 1.0_wp  !! depth D - h_lowest over that at which strips close the
                                         !! gap; 1 but for NFASTSTRIP
        real(wp) :: area = 0.0_wp        !! contact area, mm2
        real(wp) :: pmax = 0.0_wp        !! maximum pressure, MPa
        real(wp) :: y_min = 0.0_wp       !! left end of the contact, mm
        real(wp) :: y_max = 0.0_wp       !! right end of the contact, mm
        real(wp) :: x_max = 0.0_wp       !! largest half-length along x, mm
        integer :: n_patches = 0         !! number of contact patches
        integer :: strips_across = 0     !! strips across the patch that has most, 0: no strips
        integer :: passes = 0            !! how often the ends were moved
        integer :: iterations = 0        !! steps of all passes
        logical :: ends_are_held = .false. !! are ends edges of cells, which did not move?
        type(cost_t) :: cost = cost_t()  !! what it took
    end type normal_result_t

contains

    !> The same demand where h = 0 is the lowest point of the gap: strips count from there.
    pure type(demand_t) function above_lowest(demand, h_lowest)
        type(demand_t), intent(in) :: demand !! from the h = 0 of the gap
        real(wp), intent(in) :: h_lowest     !! lowest height of the gap, mm

        above_lowest = demand_t(demand%by_load, demand%load, demand%penetration)
        if (.not. demand%by_load) above_lowest%penetration = demand%penetration - h_lowest
    end function above_lowest
end module faststrip_normal_types
