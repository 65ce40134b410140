!> What `use faststrip` gives: what a host needs, from profiles to forces, in at most 100 names.
!>
!> Needs LAPACK and nothing else: no file is read or written, nothing is printed, nothing stops.
!> Readers (`src/files`), GSL's quadrature and the making of coefficient tables (`src/tables`) and
!> Kalker's variational methods with FFTW (`src/kalker`) are packages of their own.
!>
!> ```
!> status        every call has one: its number, its word, its limitations
!> bodies        material, friction, creepages
!> profiles      of wheel and rail; where they touch; the gap between them
!> geometry      contact functions over the lateral displacement, equivalent conicity
!> contact       a case, a workspace, a result: reserve, set the gap, solve, solve forces again
!> methods       numbers of normal and tangential methods; a method of your own
!> auto          what it is to know
!> wheelset      its model, workspace, state, demand, result; strips and elements of a contact
!> ```
!>
!> All else that a host may use comes by its module:
!>
!> ```
!> faststrip_base_status                every status by name
!> faststrip_base_material              moduli that two bodies share
!> faststrip_base_friction              how friction falls
!> faststrip_base_thermal               how bodies take up heat
!> faststrip_influence_closed           influence coefficients of a strip, exact
!> faststrip_influence_offcentre        the same at any point
!> faststrip_influence_polynomial       the same by the published table
!> faststrip_geometry_profile           profiles of points and of formulas
!> faststrip_geometry_flange            measures of a flange
!> faststrip_geometry_gauge_fit         the flange backs that belong to a gauge
!> faststrip_geometry_rigid_contact     the paper's creepages; forces in the track
!> faststrip_geometry_contact_functions faststrip_geometry_conicity
!> faststrip_geometry_gap               faststrip_geometry_gap_curve
!> faststrip_geometry_wheelset_state    a state in a mirror
!> faststrip_normal_simple_hertz        faststrip_normal_simple_equal_ellipse
!> faststrip_normal_strips              faststrip_normal_strip
!> faststrip_normal_strip_state         faststrip_normal_types
!> faststrip_tangential_types           faststrip_tangential_kalker
!> faststrip_tangential_fastsim         faststrip_tangential_faststrip
!> faststrip_tangential_paper           faststrip_tangential_laws
!> faststrip_tangential_wear_numbers    faststrip_tangential_wear_law
!> faststrip_tangential_heat_sources    faststrip_tangential_heat_flash: temperatures anywhere
!> faststrip_stress_loads               faststrip_stress_invariants
!> faststrip_stress_peak                stresses below loads, their largest
!> faststrip_contact_methods            the list of methods, names and what each gives
!> faststrip_contact_method             faststrip_contact_method_capacity: what a method extends
!> faststrip_contact_reserve            faststrip_contact_solve
!> faststrip_contact_plausible          faststrip_wheelset_plausible: what is out of practice
!> faststrip_contact_wanted             steps of auto
!> faststrip_lookup_table               faststrip_lookup_bytes
!> faststrip_lookup_faces               faststrip_lookup_hertz
!> faststrip_lookup_wheel               tables of creep forces
!> faststrip_wheelset_enter             a table that answers for a wheelset
!> faststrip_wheelset_memory            a wheelset's memory as bytes
!> ```
!>
!> Each name comes from the module that makes it: so an installed library shows it to the linker.
module faststrip
    ! Status.
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, limitation_words, st_ok
    ! Bodies.
    use faststrip_base_material, only: material_t
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, friction_at_angle, friction_linear, &
                                       friction_rational, friction_exponential
    ! Profiles.
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_curve_profile, standard_inclination, &
                                          unset_inclination
    use faststrip_geometry_touchable, only: touchable_t, body_wheel, body_rail
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contacts
    use faststrip_geometry_undeformed_gap, only: make_gap, standard_gap_step, standard_gap_height
    use faststrip_geometry_gap, only: gap_t
    ! Geometry.
    use faststrip_geometry_contact_functions, only: side_t, contact_functions_t, &
                                                    find_contact_functions
    use faststrip_geometry_conicity, only: conicity_t, find_conicity, find_equilibrium
    ! Contact.
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t, workspace_t, tangential_method_t, &
                                        enter_normal_method, enter_tangential_method
    use faststrip_contact_method_capacity, only: on_gap_t
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field
    use faststrip_contact_solve, only: set_contact_gap, solve_contact, solve_contact_forces
    use faststrip_contact_derivatives, only: find_contact_derivatives
    use faststrip_tangential_wear_law, only: wear_law_t
    use faststrip_tangential_types, only: tangential_field_t
    ! Methods.
    use faststrip_contact_methods, only: contact_methods_t
    ! BEGIN methods, written by tools/generate/methods.py
    use faststrip_contact_methods, only: normal_strip, normal_hertz, normal_equal_area, &
                                         normal_equal_moments, normal_norm, normal_auto, &
                                         normal_kpec, normal_analyn, normal_kpec_strips, &
                                         tangential_none, tangential_faststrip, &
                                         tangential_fastsim, tangential_faststrip_paper, &
                                         tangential_faststrip_corrected, &
                                         tangential_fastsim_elliptic, tangential_fastsim_weighted, &
                                         tangential_linear, tangential_she, tangential_polach, &
                                         tangential_tang, tangential_faststrip_plain
    ! END methods
    ! Auto.
    use faststrip_contact_wanted, only: wanted_t, target_forces, target_pmax, &
                                        target_penetration, target_area, target_power
    ! Wheelset.
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, wheel_contact_t, &
                                        side_right, side_left, demand_position, demand_loads, &
                                        demand_axle_load, demand_rest
    use faststrip_wheelset_model, only: make_wheelset, reserve_wheelset
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_derivatives, only: find_wheelset_derivatives
    use faststrip_wheelset_field, only: find_wheel_field
    use faststrip_wheelset_strips, only: wheel_strips_t, find_wheel_strips
    implicit none
    public
end module faststrip
