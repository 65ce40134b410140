!> One contact to be solved: what case files, rows of a batch, benches and the interfaces fill, and
!> what every method takes. What only one of them needs extends it.
module faststrip_contact_case
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t
    use faststrip_base_thermal, only: thermal_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_normal_limitations, only: default_resolution
    use faststrip_normal_strips, only: usual_strip_tolerance
    use faststrip_normal_types, only: demand_t
    use faststrip_tangential_wear_law, only: wear_law_t
    use faststrip_contact_methods, only: contact_methods_t, tangential_none
    use faststrip_contact_wanted, only: wanted_t
    implicit none
    private

    public :: contact_case_t, contact_terms_t, asked_t, given_forces_t, keeps_elements
    public :: wants_strip_forces

    !> What a solution shall hold besides its figures.
    type :: asked_t
        logical :: field = .false.        !! pressure, tractions, slip of each element, in the
                                          !! workspace's `field`; see `reserve_contact_field`
        logical :: strip_forces = .false. !! sums over each strip, in the workspace's
                                          !! `strip_forces`; only the march along strips has them
        logical :: times = .false.        !! time of either problem, in the result's `times`
        logical :: temperatures = .false. !! of both surfaces, in the result's `flash` and the field
        logical :: subsurface = .false.   !! the largest von Mises stress of the rail, in the
                                          !! result's `stress_peak`, and what stresses follow from,
                                          !! in the workspace's `loads`; see
                                          !! `reserve_contact_loads`
    end type asked_t

    !> Forces that a contact has to carry, in place of creepages, which are found.
    type :: given_forces_t
        logical :: is_given(2) = .false. !! longitudinal, lateral; where it is, cksi or ceta of the
                                         !! case must be 0
        real(wp) :: force(2) = 0.0_wp    !! on the rail, N; of those that are given
    end type given_forces_t

    !> What counts of one contact besides its gap: it is copied without an allocation. What is
    !> prescribed, `by_load`, `load` or `penetration`, is its `demand_t`.
    type, extends(demand_t) :: contact_terms_t
        type(material_t) :: material       !! moduli in MPa
        ! Tuned [1]. Origin: usual for dry rails.
        real(wp) :: mu = 0.3_wp            !! coefficient of friction, the static one
        type(friction_t) :: friction       !! how it falls with slip, factor of the initial slope
        type(creepage_t) :: creepage       !! about y = 0
        type(given_forces_t) :: given      !! forces in place of creepages
        type(thermal_t) :: thermal         !! how the bodies take up heat, how warm they are
        type(contact_methods_t) :: methods !! methods and resolutions
        type(wanted_t) :: wanted           !! of normal method auto: target, tolerance, budget
        type(asked_t) :: asked             !! what the solution shall hold besides its figures
        logical :: curved = .false.
            !! has each strip its own plane? The load given is then the force along the normal of
            !! the contact, of pressures and tractions together
        real(wp) :: pitch = 0.0_wp
            !! of a curved surface on the outline of a wheelset: how rail and wheel turn against
            !! each other about y, over the rolling speed, rad/mm; 0: as `inv2r` of the gap at
            !! y = 0 says, the middles of all strips at x = 0
        real(wp) :: smoothing = 0.0_wp
            !! noise that the gap is smoothed for, mm; 0: not at all. Allocates; not of the gap of
            !! `set_contact_gap`
        type(wear_law_t) :: wear_law       !! no regimes: none
        real(wp) :: yield_shear = 0.0_wp
            !! yield stress in cyclic shear, for the fatigue index, MPa; 0: not known
        real(wp) :: yield = 0.0_wp
            !! `st_beyond_yield` names a maximum pressure above this, MPa; 0: no limit
        logical :: warm_start = .false.    !! from the workspace's last solution, if it has one
        logical :: stays = .false.
            !! is it a neighbour of that solution, for derivatives, with its patches and strips?
        real(wp) :: strip_tolerance = usual_strip_tolerance
            !! relative size of the strips' last step
        logical :: estimate = .true.       !! are errors estimated? Of strips it costs about a step
        real(wp) :: resolution_limit = default_resolution
            !! `st_under_resolved` names an estimated relative error above this, > 0
        real(wp) :: force_limit = default_resolution
            !! the same of the forces, over mu N, and of the moment, over mu N c
    end type contact_terms_t

    !> One contact to be solved.
    type, extends(contact_terms_t) :: contact_case_t
        type(gap_t) :: gap !! undeformed gap; without it that of `set_contact_gap`
    end type contact_case_t

contains

    !> Shall the solution keep its elements? Stresses need them too, where there are tractions.
    pure logical function keeps_elements(case)
        class(contact_terms_t), intent(in) :: case !! as the caller set it

        keeps_elements = case%asked%field .or. case%asked%temperatures .or. &
                         case%asked%subsurface .and. case%methods%tangential /= tangential_none
    end function keeps_elements

    !> Are sums over strips wanted, for themselves, for wear or for a curved surface?
    pure logical function wants_strip_forces(case)
        class(contact_terms_t), intent(in) :: case !! as the caller set it

        wants_strip_forces = case%asked%strip_forces .or. case%wear_law%n > 0 .or. case%curved
    end function wants_strip_forces
end module faststrip_contact_case
