!> What every normal method takes and gives: what is prescribed, the figures, what they took.
module faststrip_normal_types
    use faststrip_base_kinds, only: wp
    implicit none
    private

    public :: goal_t, normal_result_t, effort_t

    !> What is prescribed: the load, or the penetration.
    type :: goal_t
        logical :: by_load = .true.
        real(wp) :: load = 0.0_wp        !! N
        real(wp) :: penetration = 0.0_wp !! above the lowest height, mm
    end type goal_t

    !> What a solution took.
    type :: effort_t
        integer :: iterations = 0 !! steps
        integer :: factorings = 0 !! those of them for which a Jacobian was factored
        integer :: values = 0     !! influence numbers computed
        integer :: gradients = 0  !! influence numbers computed with their derivatives
        real(wp) :: operations = 0.0_wp !! of the linear algebra, multiplications and additions
    end type effort_t

    !> Figures of a solution.
    type :: normal_result_t
        real(wp) :: load = 0.0_wp        !! normal force, N
        real(wp) :: penetration = 0.0_wp !! approach D of the bodies, from h = 0, mm
        real(wp) :: area = 0.0_wp        !! contact area, mm2
        real(wp) :: pmax = 0.0_wp        !! largest pressure, MPa
        real(wp) :: y_min = 0.0_wp       !! left end of the contact, mm
        real(wp) :: y_max = 0.0_wp       !! right end of the contact, mm
        real(wp) :: x_max = 0.0_wp       !! largest half-length along x, mm
        integer :: n_patches = 0         !! number of contact patches
        integer :: strips_across = 0     !! strips across the patch that has most, 0: no strips
        integer :: passes = 0            !! how often the ends were moved
        integer :: iterations = 0        !! steps of all passes
        type(effort_t) :: effort         !! what it took
    end type normal_result_t
end module faststrip_normal_types
