!> What `use faststrip` gives: the embeddable core, from profiles to forces.
!>
!> Needs LAPACK and nothing else: no file is read or written, nothing is printed, nothing stops.
!> Readers (`src/files`), GSL's quadrature and the making of coefficient tables (`src/tables`) and
!> Kalker's variational methods with FFTW (`src/kalker`) are packages of their own.
!> Each name comes from the module that makes it: so an installed library shows it to the linker.
module faststrip
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, limitation_words, &
                                     message_length, st_ok, first_error, st_fallback_used, &
                                     st_edge_of_data, st_fewer_strips, st_overlap_left, &
                                     st_flat_along_x, st_conformal, st_target_missed, &
                                     st_under_resolved, st_more_strips, st_beyond_yield, &
                                     st_no_wave, st_no_finite_patch, st_bad_argument, &
                                     st_not_finite, st_not_increasing, st_too_few_points, &
                                     st_bad_material, st_bad_load, st_no_contact, &
                                     st_no_hertz_ellipse, st_no_convergence, st_out_of_range, &
                                     st_workspace_too_small, st_linear_algebra, st_file_missing, &
                                     st_file_format
    use faststrip_base_material, only: material_t, check_material, normal_compliance, &
                                       combined_shear_modulus, combined_poisson_ratio
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_friction, only: friction_t, check_friction, friction_at_angle, &
                                       falling_share, softened, friction_constant, &
                                       friction_linear, friction_rational, friction_exponential
    use faststrip_influence_closed, only: influence_primitive, influence_primitive_slope, &
                                          strip_influence, strip_influence_edges
    use faststrip_influence_offcentre, only: strip_influence_at, strip_influence_gradient
    use faststrip_influence_polynomial, only: table_influence
    use faststrip_geometry_profile, only: profile_t, make_wheel_profile, make_rail_profile, &
                                          make_points_profile, make_curve_profile, profile_at, &
                                          standard_inclination, unset_inclination, standard_cant
    use faststrip_geometry_touchable, only: touchable_t, body_wheel, body_rail
    use faststrip_geometry_arc_spline, only: standard_kink_angle
    use faststrip_geometry_flange, only: flange_t, measure_flange
    use faststrip_geometry_gauge_fit, only: find_back_spacing
    use faststrip_geometry_rigid_contact, only: wheelset_t, track_t, rigid_contact_t, &
                                                find_rigid_contact, find_rigid_contacts, &
                                                find_wheelset_contacts => find_rigid_contacts, &
                                                contact_force, shift_creepage, creepage_set_a, &
                                                creepage_set_b
    use faststrip_geometry_contact_functions, only: side_t, contact_functions_t, &
                                                    find_contact_functions
    use faststrip_geometry_conicity, only: conicity_t, find_conicity, find_equilibrium, &
                                           klingel_conicity, regression_conicity, largest_amplitude
    use faststrip_geometry_undeformed_gap, only: make_gap, standard_gap_step, standard_gap_height
    use faststrip_geometry_gap, only: gap_t, check_gap
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_normal_simple_hertz, only: hertz_t, hertz_solve, hertz_solve_gap, &
                                             hertz_solve_gap_penetration, hertz_solve_gap_demand, &
                                             hertz_strips
    use faststrip_normal_estimate_certificate, only: certificate_t
    use faststrip_normal_simple_equal_ellipse, only: replace_by_ellipses, equal_area, equal_moments
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips, strip_load, strips_load
    use faststrip_normal_strip, only: strip_options_t, strip_solve, strip_solve_penetration, &
                                      strip_solve_demand, strips_auto
    use faststrip_normal_strip_state, only: strip_workspace_t, reserve_strip_workspace, &
                                            set_strip_gap
    use faststrip_normal_types, only: normal_result_t, demand_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          field_power, strip_forces_t, &
                                          reserve_strip_forces, state_adhesion, state_slip
    use faststrip_tangential_wear_numbers, only: t_gamma, t_gamma_with_spin, &
                                                 surface_fatigue_index, strip_areas, &
                                                 strip_power_densities
    use faststrip_tangential_wear_law, only: wear_law_t, wear_t, check_wear_law, find_wear_rate, &
                                             find_strip_wear, wheel_depth_per_km, most_regimes
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_tangential_kalker, only: kalker_coefficients_t, kalker_coefficients
    use faststrip_tangential_fastsim, only: fastsim_solve, fastsim_strips_solve, &
                                            fastsim_coefficients_solve, fastsim_variant_t
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve, &
                                              faststrip_solve => faststrip_tangential_solve
    use faststrip_tangential_paper, only: paper_solve, corrected_solve
    use faststrip_tangential_laws, only: law_solve, law_strips_solve, law_linear, &
                                         law_shen_hedrick_elkins, law_polach
    use faststrip_contact_methods, only: contact_methods_t, check_contact_methods, method_t, &
                                         start_coarse, start_strips, start_last, &
                                         normal_method, &
                                         tangential_method, normal_method_name, &
                                         tangential_method_name, method_name_length, &
                                         gives_elements, gives_stick, takes_falling
    ! BEGIN methods, written by tools/methods.py
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
    use faststrip_contact_case, only: contact_case_t, asked_t
    use faststrip_contact_method, only: contact_result_t, workspace_t, times_t, normal_method_t, &
                                        tangential_method_t, enter_normal_method, &
                                        enter_tangential_method
    use faststrip_contact_method_capacity, only: on_gap_t, on_strips_t
    use faststrip_contact_reserve, only: reserve_workspace, reserve_contact_field, most_gap_points
    use faststrip_contact_solve, only: set_contact_gap, set_contact_curve, solve_contact, &
                                       solve_contact_forces, estimate_contact
    use faststrip_contact_plausible, only: doubts_t, gap_size_t, case_names_t, gap_size, &
                                           find_doubts, doubt_pressure
    use faststrip_contact_wanted, only: wanted_t, target_number, target_names, target_forces, &
                                        target_pmax, target_penetration, target_area, &
                                        target_power, unknown_error, auto_step_t, auto_steps_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t, mirrored_state
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t, wheel_contact_t, &
                                        wheel_result_t, wheelset_result_t, wheelset_workspace_t, &
                                        side_right, side_left, demand_position, demand_loads, &
                                        demand_axle_load
    use faststrip_wheelset_solve, only: make_wheelset, reserve_wheelset, solve_wheelset
    use faststrip_wheelset_plausible, only: state_names_t, find_state_doubts
    use faststrip_wheelset_field, only: find_wheel_field
    use faststrip_wheelset_strips, only: wheel_strips_t, find_wheel_strips
    use faststrip_lookup_table, only: lookup_t, lookup_kind_hertz, lookup_kind_wheel, &
                                      n_contact_numbers, most_slots
    use faststrip_lookup_bytes, only: open_lookup
    use faststrip_lookup_faces, only: lookup_linear, lookup_cubic
    use faststrip_lookup_hertz, only: look_up_hertz, n_lookup_state
    use faststrip_lookup_wheel, only: look_up_contacts, look_up_wheel, contacts_change, &
                                      n_wheel_place, n_wheel_state
    implicit none
    public
end module faststrip
