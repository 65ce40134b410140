!> One contact from gap to forces: the call an embedding program makes.
!>
!> A workspace, one per thread, is reserved once; after that nothing is allocated, and every
!> call leaves the host's floating-point flags, traps and rounding as they were. The workspace
!> remembers the gap and, for warm starts, the last solution; copying it (by assignment) saves both,
!> for steps that are taken back.
module faststrip_contact_solve
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     message_length, st_bad_argument, st_under_resolved, &
                                     st_workspace_too_small
    use faststrip_base_friction, only: check_friction, falls, softened
    use faststrip_base_material, only: material_t, check_material, normal_compliance
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_influence_rectangle, only: coupling_constant
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve, &
                                            set_gap_curve_points, copy_gap_curve
    use faststrip_normal_analyn, only: analyn_solve
    use faststrip_normal_certificate, only: certificate_t
    use faststrip_normal_equal_ellipse, only: replace_by_ellipses, equal_area, equal_moments
    use faststrip_normal_hertz, only: hertz_t, hertz_solve_gap_demand, hertz_strips
    use faststrip_normal_hertz_certificate, only: certify_hertz
    use faststrip_normal_kpec, only: kpec_solve
    use faststrip_normal_kpec_strips, only: kpec_strips_solve
    use faststrip_normal_limitations, only: check_resolution, name_resolution, &
                                            name_force_resolution, add_limitation, &
                                            check_lowest, name_steps
    use faststrip_normal_misfit, only: misfit_t, find_misfit
    use faststrip_normal_strip, only: strip_options_t, strip_workspace_t, &
                                      reserve_strip_workspace, strip_solve_demand, &
                                      estimate_strips, strips_auto, strips_auto_most
    use faststrip_normal_strips, only: contact_strips_t, reserve_strips
    use faststrip_normal_types, only: normal_result_t
    use faststrip_tangential_types, only: tangential_result_t, tangential_field_t, reserve_field, &
                                          strip_forces_t
    use faststrip_tangential_force_errors, only: force_errors_t, estimate_force_errors, &
                                                 errors_of_march, errors_of_fitted, &
                                                 errors_of_fastsim
    use faststrip_tangential_hertz_errors, only: add_hertz_errors
    use faststrip_tangential_fastsim, only: fastsim_solve, fastsim_strips_solve, &
                                            fastsim_variant_t
    use faststrip_tangential_faststrip, only: faststrip_tangential_solve
    use faststrip_tangential_motion, only: cut_creepage
    use faststrip_tangential_laws, only: law_solve, law_strips_solve, law_linear, &
                                         law_shen_hedrick_elkins, law_polach
    use faststrip_tangential_paper, only: paper_solve, corrected_solve
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_methods, only: contact_methods_t, check_contact_methods, normal_hertz, &
                                         normal_strip, normal_auto, normal_equal_area, &
                                         normal_kpec, normal_kpec_strips, normal_analyn, &
                                         tangential_none, &
                                         tangential_faststrip, tangential_faststrip_plain, &
                                         tangential_faststrip_paper, &
                                         tangential_faststrip_corrected, tangential_fastsim, &
                                         tangential_fastsim_elliptic, &
                                         tangential_fastsim_weighted, tangential_linear, &
                                         tangential_she, tangential_polach, gives_elements, &
                                         takes_falling, tangential_method_name
    implicit none
    private

    public :: contact_case_t, contact_result_t, workspace_t
    public :: reserve_workspace, reserve_contact_field, set_contact_gap
    public :: solve_contact, solve_contact_normal, solve_contact_tangential
    public :: estimate_contact_errors, estimate_contact_forces, add_shape_errors
    public :: check_contact_friction, name_falling_friction
    public :: most_gap_points

    ! Strips of Hertz, KPEC and ANALYN where the number is left to the solver.
    ! Tuned [strips]. Origin: as strips_per_patch.
    integer, parameter :: auto_hertz_strips = 15
    ! Tuned [patches]. Origin: as max_patches of the strips.
    integer, parameter :: most_patches = 16 ! each with its own ellipse

    !> Most points of a gap.
    !> Tuned [points]. Origin: capacity.
    integer, parameter :: most_gap_points = 1000000
    ! Tuned [1]: Force by the coupling of unlike materials, over K N; at most over mu N. Origin: a
    ! line contact in free rolling (Bentall and Johnson 1967), linear.
    real(wp), parameter :: force_of_coupling = 3.0_wp, most_left_out = 2.0_wp
    ! Tuned [strips]: capacity for those of further patches. Origin: capacity.
    integer, parameter :: spare_strips = 60
    ! Tuned [numbers]: memory of a workspace, tried before it is taken: of a point, a strip, a pair
    ! of strips, and the lattice. Origin: counted from the components of the workspaces, with a
    ! margin.
    integer(int64), parameter :: per_point = 20, per_strip = 100, per_pair = 8, at_least = 400000

    !> Figures of one contact.
    type :: contact_result_t
        type(normal_result_t) :: normal = normal_result_t()
            !! load, penetration, area, largest pressure, ...
        type(certificate_t) :: certificate = certificate_t() !! how wrong they are
        logical :: is_estimated = .false.
            !! is that known? Not of ellipses in the strips' place
        type(tangential_result_t) :: tangential = tangential_result_t()
            !! forces on the rail, friction power, stick
        type(force_errors_t) :: force_errors = force_errors_t() !! how wrong the forces are
        logical :: forces_are_estimated = .false.
            !! is that known? Of FASTSTRIP and FASTSIM, where the normal errors are
    end type contact_result_t

    !> Everything a solution needs beside the case; owned by the caller, one per thread.
    type :: workspace_t
        type(strip_workspace_t) :: solver
            !! the gap (`solver%curve`) and the strip solver's workspace
        type(contact_strips_t) :: strips  !! of the last contact
        type(hertz_t) :: hertz            !! of the last contact, if by Hertz
        integer :: solved_by = 0          !! normal method of the last contact; 0: none was solved
        type(contact_strips_t) :: best_strips !! of the best step so far of `solve_contact_auto`
        integer :: first_strips = 0
            !! strips that the last contact of `solve_contact_auto` needed, 0: there was none
    end type workspace_t

contains

    !> Allocate for the methods and for gaps of up to `max_points` points: the only allocation.
    !>
    !> A workspace with capacity for strips serves every normal method up to its number of strips;
    !> one for `normal_auto` has capacity for as many as `solve_contact_auto` may take.
    subroutine reserve_workspace(workspace, methods, max_points, status)
        type(workspace_t), intent(inout) :: workspace  !! sized
        type(contact_methods_t), intent(in) :: methods !! what will be asked of it
        integer, intent(in) :: max_points              !! points of a gap, 5 to `most_gap_points`
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; `st_workspace_too_small`, not enough memory

        real(wp), allocatable :: trial(:)
        integer(int64) :: numbers
        integer :: capacity, failure

        call check_contact_methods(methods, status)
        if (is_error(status)) return
        if (max_points < min_gap_points .or. max_points > most_gap_points) then
            call set_status(status, st_bad_argument, 'capacity for gap points must be 5 to a ' // &
                            'million, got ' // count_text(max_points))
            return
        end if
        capacity = strip_capacity(methods)
        ! Tried as a whole first: what the parts find missing would stop the program.
        numbers = per_point*max_points + per_strip*capacity
        if (needs_solver(methods%normal) .and. workspace%solver%max_strips < capacity) &
            numbers = numbers + per_pair*capacity*capacity + at_least
        allocate (trial(numbers), stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a workspace')
            return
        end if
        deallocate (trial)
        workspace%solved_by = 0
        call reserve_strips(workspace%strips, capacity, status)
        if (.not. is_error(status) .and. methods%normal == normal_auto) &
            call reserve_strips(workspace%best_strips, capacity, status)
        if (is_error(status)) return
        if (needs_solver(methods%normal)) then
            call reserve_strip_workspace(workspace%solver, capacity, max_points, status)
        else
            call reserve_gap_curve(workspace%solver%curve, max_points, status)
        end if
    end subroutine reserve_workspace

    !> Does a normal method need the strip solver's workspace, or the gap alone?
    pure logical function needs_solver(normal)
        integer, intent(in) :: normal

        needs_solver = all(normal /= [normal_hertz, normal_kpec, normal_analyn])
    end function needs_solver

    !> Allocate for the elements of a tangential method.
    subroutine reserve_contact_field(field, methods, status)
        type(tangential_field_t), intent(inout) :: field !! sized
        type(contact_methods_t), intent(in) :: methods   !! what will be asked for
        type(status_t), intent(out) :: status
            !! `st_bad_argument`; `st_workspace_too_small`, not enough memory

        real(wp), allocatable :: trial(:)
        integer(int64) :: elements
        integer :: failure, points

        call check_contact_methods(methods, status)
        if (is_error(status)) return
        if (.not. gives_elements(methods%tangential)) then
            call set_status(status, st_bad_argument, &
                            trim(tangential_method_name(methods%tangential)) // ' gives forces ' &
                            // 'only, no tractions element by element')
            return
        end if
        points = methods%points_per_strip
        if (methods%normal == normal_auto) points = max(points, strips_auto_most)
        elements = max(int(strip_capacity(methods), int64)*points, &
                       int(methods%fastsim_nx, int64)*methods%fastsim_ny*most_patches)
        failure = 1
        if (elements < huge(failure)) allocate (trial(9*elements), stat=failure)
        if (failure /= 0) then
            call set_status(status, st_workspace_too_small, 'not enough memory for a field')
            return
        end if
        deallocate (trial)
        call reserve_field(field, int(elements), status)
    end subroutine reserve_contact_field

    !> Hand over the gap that the next solutions are for.
    subroutine set_contact_gap(workspace, y, h, inv2r, status, inclination)
        type(workspace_t), intent(inout) :: workspace !! with capacity for as many points
        real(wp), intent(in) :: y(:)          !! lateral coordinate, strictly increasing, mm
        real(wp), intent(in) :: h(:)          !! gap on the line x = 0, mm
        real(wp), intent(in) :: inv2r(:)      !! 1/(2 R), R the local radius along x, 1/mm
        type(status_t), intent(out) :: status !! those of `check_gap`, `st_workspace_too_small`
        real(wp), intent(in), optional :: inclination(:)
            !! how far the surfaces have turned from the tangent plane at y = 0, finite, rad

        type(environment_t) :: environment

        call hold_environment(environment)
        workspace%solved_by = 0
        call set_gap_curve_points(workspace%solver%curve, y, h, inv2r, status, inclination)
        call restore_environment(environment)
    end subroutine set_contact_gap

    !> Solve a contact: the normal problem and, unless the method is `tangential_none`, the
    !> tangential one.
    !>
    !> A status below `first_error` is that of the normal solution: the result stands, with a named
    !> limitation. With an error there is no result.
    subroutine solve_contact(workspace, case, result, status, field)
        type(workspace_t), intent(inout) :: workspace !! with capacity for the methods
        type(contact_case_t), intent(in) :: case      !! what to solve
        type(contact_result_t), intent(out) :: result !! figures
        type(status_t), intent(out) :: status
            !! those of `strip_solve`, `hertz_solve_gap`, `replace_by_ellipses`,
            !! `faststrip_tangential_solve`, `fastsim_solve`, `check_material` and `check_gap`
        type(tangential_field_t), intent(inout), optional :: field
            !! elements, if wanted; see `reserve_contact_field`

        type(environment_t) :: environment
        type(status_t) :: forces

        call hold_environment(environment)
        call solve_normal(workspace, case, result%normal, result%certificate, &
                          result%is_estimated, status)
        if (.not. is_error(status) .and. case%methods%tangential /= tangential_none) then
            call solve_tangential(workspace, case, result%tangential, forces, field)
            if (is_error(forces)) then
                status = forces
                result = contact_result_t()
            else if (result%is_estimated) then
                call estimate_forces(workspace, case, result%certificate, result%force_errors, &
                                     result%forces_are_estimated, status)
            end if
        else if (present(field)) then
            field%n = 0
        end if
        call restore_environment(environment)
    end subroutine solve_contact

    !> The normal problem alone; the strips are in the workspace.
    subroutine solve_contact_normal(workspace, case, normal, status, certificate, is_estimated, &
                                    curve)
        type(workspace_t), intent(inout) :: workspace !! with capacity for the method
        type(contact_case_t), intent(in) :: case      !! gap, material, demand, method
        type(normal_result_t), intent(out) :: normal  !! figures
        type(status_t), intent(out) :: status         !! as `solve_contact`
        type(certificate_t), intent(out), optional :: certificate !! how wrong they are
        logical, intent(out), optional :: is_estimated !! is that known?
        type(gap_curve_t), intent(in), optional :: curve !! its gap, set already; not set again

        type(environment_t) :: environment
        type(certificate_t) :: found
        logical :: is_found

        call hold_environment(environment)
        call solve_normal(workspace, case, normal, found, is_found, status, curve)
        if (present(certificate)) certificate = found
        if (present(is_estimated)) is_estimated = is_found
        call restore_environment(environment)
    end subroutine solve_contact_normal

    !> The tangential problem on the workspace's normal solution: other creepages, friction or
    !> resolution without solving the normal problem again.
    subroutine solve_contact_tangential(workspace, case, tangential, status, field, per_strip)
        type(workspace_t), intent(in) :: workspace            !! with a normal solution
        type(contact_case_t), intent(in) :: case              !! material, mu, creepages, method
        type(tangential_result_t), intent(out) :: tangential  !! figures
        type(status_t), intent(out) :: status                 !! as `solve_contact`
        type(tangential_field_t), intent(inout), optional :: field !! elements, if wanted
        type(strip_forces_t), intent(inout), optional :: per_strip
            !! sums over each strip, if wanted and if the method is `tangential_faststrip`

        type(environment_t) :: environment

        call hold_environment(environment)
        call solve_tangential(workspace, case, tangential, status, field, per_strip)
        call restore_environment(environment)
    end subroutine solve_contact_tangential

    !> How wrong the workspace's normal solution is, for who solved with `case%estimate` off; more
    !> than the limit is named in the status.
    subroutine estimate_contact_errors(workspace, case, normal, certificate, is_estimated, status)
        type(workspace_t), intent(in) :: workspace      !! with a solution by strips or by Hertz
        type(contact_case_t), intent(in) :: case        !! what was solved
        type(normal_result_t), intent(in) :: normal     !! its figures
        type(certificate_t), intent(out) :: certificate !! how wrong they are
        logical, intent(out) :: is_estimated            !! is that known?
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`

        type(environment_t) :: environment

        call hold_environment(environment)
        if (workspace%solved_by == normal_hertz) then
            call estimate_hertz(workspace, case, certificate, is_estimated, status)
        else
            call estimate_errors(workspace, case, normal, certificate, is_estimated, status)
        end if
        call restore_environment(environment)
    end subroutine estimate_contact_errors

    !> How wrong forces on the workspace's normal solution are, for who asks for the parts of a
    !> solution.
    subroutine estimate_contact_forces(workspace, case, certificate, errors, is_estimated, status, &
                                       finer)
        type(workspace_t), intent(in) :: workspace      !! with a solution by strips or by Hertz
        type(contact_case_t), intent(in) :: case        !! what was solved, by which method
        type(certificate_t), intent(in) :: certificate  !! of the normal solution
        type(force_errors_t), intent(out) :: errors     !! of the forces
        logical, intent(out) :: is_estimated            !! is that known?
        type(status_t), intent(inout) :: status         !! limitations so far; `st_under_resolved`
        real(wp), intent(in), optional :: finer
            !! what would be estimated of so many times as many strips; see `estimate_force_errors`

        type(environment_t) :: environment

        call hold_environment(environment)
        call estimate_forces(workspace, case, certificate, errors, is_estimated, status, &
                             finer)
        call restore_environment(environment)
    end subroutine estimate_contact_forces

    !> How wrong the forces are; methods that are no march in a patch have no estimate.
    subroutine estimate_forces(workspace, case, certificate, errors, is_estimated, status, finer)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(certificate_t), intent(in) :: certificate
        type(force_errors_t), intent(out) :: errors
        logical, intent(out) :: is_estimated
        type(status_t), intent(inout) :: status
        real(wp), intent(in), optional :: finer

        type(status_t) :: estimate
        type(material_t) :: material
        type(creepage_t) :: creepage
        real(wp) :: share
        integer :: method, points

        is_estimated = .false.
        if (case%methods%tangential == tangential_none) return
        if (falls(case%friction)) then
            call name_falling_friction(status)
            return
        end if
        call name_unlike(case, status)
        points = case%methods%points_per_strip
        select case (case%methods%tangential)
        case (tangential_faststrip)
            method = errors_of_fitted
        case (tangential_faststrip_plain)
            method = errors_of_march
        case (tangential_fastsim)
            method = errors_of_fastsim
            points = case%methods%fastsim_nx
        case default
            return
        end select
        material = softened(case%material, case%friction)
        call cut_creepage(case%creepage, creepage, share)
        if (workspace%solved_by == normal_hertz) then
            ! Strips of an ellipse are exact; what is wrong with the ellipse is added.
            call estimate_force_errors(workspace%strips, material, case%mu, creepage, &
                                       method, points, certificate_t(), errors, estimate, finer)
            if (.not. is_error(estimate)) call add_shape_errors(workspace, case, errors, estimate)
        else
            call estimate_force_errors(workspace%strips, material, case%mu, creepage, &
                                       method, points, certificate, errors, estimate, finer)
        end if
        is_estimated = .not. is_error(estimate)
        if (is_estimated) then
            errors%fx = errors%fx + left_out(case)
            errors%fy = errors%fy + left_out(case)
            errors%mz = errors%mz + left_out(case)
        end if
        if (is_estimated) call name_force_resolution(errors%fx, errors%fy, errors%mz - errors%arm, &
                                                     case%force_limit, status)
    end subroutine estimate_forces

    !> What methods of the core leave out of forces over mu N where materials are unlike: pressures
    !> cause slip of a creepage of about 1.25 K p0/G, which makes three times K N of force.
    pure real(wp) function left_out(case) result(error)
        type(contact_case_t), intent(in) :: case

        error = min(force_of_coupling*abs(coupling_constant(case%material)), &
                    most_left_out*case%mu)/max(case%mu, tiny(error))
    end function left_out

    !> Name that a method leaves out what pressures of unlike materials do.
    pure subroutine name_unlike(case, status)
        type(contact_case_t), intent(in) :: case
        type(status_t), intent(inout) :: status

        if (left_out(case) <= case%force_limit) return
        call add_limitation(status, st_under_resolved, 'between unlike materials pressures ' // &
                            'cause slip, with which only tang reckons')
    end subroutine name_unlike

    !> Name that no error of forces is estimated where friction falls with slip: what the estimates
    !> were calibrated on has constant friction.
    pure subroutine name_falling_friction(status)
        type(status_t), intent(inout) :: status !! limitations so far; `st_under_resolved`

        call add_limitation(status, st_under_resolved, 'no error of the forces can be ' // &
                            'estimated: friction falls with slip')
    end subroutine name_falling_friction

    !> Refuse friction that is none, and friction that falls with slip where the method cannot do.
    pure subroutine check_contact_friction(case, method, status)
        type(contact_case_t), intent(in) :: case !! its friction counts
        integer, intent(in) :: method            !! one of the `tangential_` numbers
        type(status_t), intent(out) :: status    !! those of `check_friction`; `st_bad_argument`

        call check_friction(case%friction, status)
        if (is_error(status)) return
        if (falls(case%friction) .and. .not. takes_falling(method)) &
            call set_status(status, st_bad_argument, trim(tangential_method_name(method)) // &
                            ' takes no friction that falls with slip; faststrip, fastsim and ' // &
                            'tang do')
    end subroutine check_contact_friction

    !> Add to the errors of forces on the workspace's Hertz ellipse what its shape is wrong by.
    pure subroutine add_shape_errors(workspace, case, errors, status)
        type(workspace_t), intent(in) :: workspace    !! with a solution by Hertz
        type(contact_case_t), intent(in) :: case      !! what was solved
        type(force_errors_t), intent(inout) :: errors !! of a method on the ellipse
        type(status_t), intent(inout) :: status       !! that of `kalker_coefficients`

        type(creepage_t) :: creepage
        real(wp) :: share

        call cut_creepage(case%creepage, creepage, share)
        call add_hertz_errors(workspace%hertz, misfit_of(workspace, case), &
                              softened(case%material, case%friction), case%mu, creepage, &
                              errors, status)
    end subroutine add_shape_errors

    subroutine solve_normal(workspace, case, normal, certificate, is_estimated, status, curve)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(normal_result_t), intent(out) :: normal
        type(certificate_t), intent(out) :: certificate
        logical, intent(out) :: is_estimated
        type(status_t), intent(out) :: status
        type(gap_curve_t), intent(in), optional :: curve

        workspace%solved_by = 0
        is_estimated = .false.
        call check_contact_methods(case%methods, status)
        if (is_error(status)) return
        if (case%methods%normal == normal_auto) then
            call set_status(status, st_bad_argument, &
                            'normal method auto is for solve_contact_auto')
            return
        end if
        call check_resolution(case%resolution_limit, 'the resolution limit', status)
        if (is_error(status)) return
        call check_resolution(case%force_limit, 'the limit of the errors of forces', status)
        if (is_error(status)) return
        call check_material(case%material, status)
        if (is_error(status)) return
        if (present(curve)) then
            call copy_gap_curve(curve, workspace%solver%curve, status)
        else if (allocated(case%gap%y)) then
            call set_gap_curve(workspace%solver%curve, case%gap, status)
        end if
        if (is_error(status)) return
        if (any(case%methods%normal == [normal_kpec, normal_kpec_strips, normal_analyn])) then
            call solve_approximately(workspace, case, normal, status)
        else if (case%methods%normal == normal_hertz) then
            call solve_hertz(workspace, case, normal, status)
            if (case%estimate .and. .not. is_error(status)) &
                call estimate_hertz(workspace, case, certificate, is_estimated, status)
        else
            call solve_by_strips(workspace, case, normal, certificate, is_estimated, status)
        end if
        if (.not. is_error(status)) workspace%solved_by = case%methods%normal
    end subroutine solve_normal

    subroutine solve_by_strips(workspace, case, normal, certificate, is_estimated, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(normal_result_t), intent(out) :: normal
        type(certificate_t), intent(out) :: certificate
        logical, intent(inout) :: is_estimated
        type(status_t), intent(out) :: status

        type(strip_options_t) :: options
        type(status_t) :: ellipses

        options%strips_per_patch = case%methods%strips_per_patch
        options%tolerance = case%strip_tolerance
        options%warm_start = case%warm_start
        options%resolution_limit = case%resolution_limit
        if (workspace%solver%max_strips < strip_capacity(case%methods)) then
            call set_status(status, st_workspace_too_small, &
                            'the workspace has capacity for fewer strips than the method may need')
            return
        end if
        call strip_solve_demand(workspace%solver, normal_compliance(case%material), case%demand_t, &
                                options, workspace%strips, normal, status)
        if (is_error(status)) return
        if (case%estimate) &
            call estimate_errors(workspace, case, normal, certificate, is_estimated, status)
        if (case%methods%normal == normal_strip) return
        is_estimated = .false.
        certificate = certificate_t()
        call replace_by_ellipses( &
            merge(equal_area, equal_moments, case%methods%normal == normal_equal_area), &
            workspace%solver%curve, workspace%strips, normal, ellipses)
        if (is_error(ellipses)) status = ellipses
    end subroutine solve_by_strips

    !> How wrong the strips in the workspace are; more than the limit is named in the status.
    subroutine estimate_errors(workspace, case, normal, certificate, is_estimated, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(normal_result_t), intent(in) :: normal
        type(certificate_t), intent(out) :: certificate
        logical, intent(out) :: is_estimated
        type(status_t), intent(inout) :: status

        character(len=message_length) :: words
        type(status_t) :: estimate

        call estimate_strips(workspace%solver, normal_compliance(case%material), &
                             workspace%strips, normal, certificate, estimate)
        is_estimated = .not. is_error(estimate)
        if (is_estimated) then
            call name_resolution(certificate%est_err_penetration, certificate%est_err_pmax, &
                                 certificate%est_err_area, case%resolution_limit, status)
        else
            words = 'no error can be estimated:'
            words(len_trim(words) + 2:) = estimate%message
            call add_limitation(status, st_under_resolved, words)
        end if
    end subroutine estimate_errors

    !> How wrong the Hertz contact in the workspace is.
    subroutine estimate_hertz(workspace, case, certificate, is_estimated, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(certificate_t), intent(out) :: certificate
        logical, intent(out) :: is_estimated
        type(status_t), intent(inout) :: status

        certificate = certify_hertz(misfit_of(workspace, case))
        is_estimated = .true.
        call name_resolution(certificate%est_err_penetration, certificate%est_err_pmax, &
                             certificate%est_err_area, case%resolution_limit, status)
    end subroutine estimate_hertz

    !> What the gap in the workspace differs from the parabola of its Hertz contact by.
    pure type(misfit_t) function misfit_of(workspace, case) result(misfit)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case

        misfit = find_misfit(workspace%solver%curve, normal_compliance(case%material), &
                             workspace%hertz)
    end function misfit_of

    subroutine solve_hertz(workspace, case, normal, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        integer :: n

        associate (hertz => workspace%hertz, curve => workspace%solver%curve)
            call hertz_solve_gap_demand(curve, normal_compliance(case%material), case%demand_t, &
                                        hertz, status)
            if (is_error(status)) return
            normal%load = hertz%load
            normal%penetration = hertz%penetration + curve%h_lowest
            normal%area = hertz%area
            normal%pmax = hertz%pmax
            normal%y_min = hertz%y - hertz%b
            normal%y_max = hertz%y + hertz%b
            normal%x_max = hertz%a
            normal%n_patches = 1
            call check_lowest(curve, hertz%penetration, status)
            if (is_error(status)) then
                normal = normal_result_t()
                return
            end if
            n = case%methods%strips_per_patch
            if (n == strips_auto) n = auto_hertz_strips
            call hertz_strips(hertz, n, workspace%strips, status)
            if (is_error(status)) return
            call name_steps(curve, hertz%penetration, workspace%strips, status)
        end associate
    end subroutine solve_hertz

    !> By KPEC, strips in its patch, or ANALYN, of which no error is estimated.
    subroutine solve_approximately(workspace, case, normal, status)
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(in) :: case
        type(normal_result_t), intent(out) :: normal
        type(status_t), intent(out) :: status

        integer :: n

        n = case%methods%strips_per_patch
        if (n == strips_auto) n = auto_hertz_strips
        associate (curve => workspace%solver%curve, compliance => normal_compliance(case%material))
            select case (case%methods%normal)
            case (normal_kpec)
                call kpec_solve(curve, compliance, case%demand_t, n, workspace%strips, normal, &
                                status)
            case (normal_kpec_strips)
                if (workspace%solver%max_strips < strip_capacity(case%methods)) then
                    call set_status(status, st_workspace_too_small, 'the workspace has no ' // &
                                    'capacity for as many strips')
                    return
                end if
                call kpec_strips_solve(curve, compliance, case%demand_t, n, &
                                       workspace%solver%newton, workspace%strips, normal, status)
            case default
                call analyn_solve(curve, compliance, case%demand_t, n, workspace%strips, normal, &
                                  status)
            end select
        end associate
    end subroutine solve_approximately

    ! Creepages beyond what methods take are cut; what goes with their size is told of them as they
    ! are.
    subroutine solve_tangential(workspace, case, tangential, status, field, per_strip)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        type(contact_case_t) :: slower
        type(creepage_t) :: creepage
        real(wp) :: share

        call cut_creepage(case%creepage, creepage, share)
        ! Linear forces have no limit.
        if (.not. share < 1.0_wp .or. case%methods%tangential == tangential_linear) then
            call solve_by_method(workspace, case, tangential, status, field, per_strip)
            return
        end if
        slower%material = case%material
        slower%mu = case%mu
        slower%methods = case%methods
        slower%friction = case%friction
        slower%friction%speed = case%friction%speed/share
        slower%creepage = creepage
        call solve_by_method(workspace, slower, tangential, status, field, per_strip)
        if (is_error(status)) return
        tangential%friction_power = tangential%friction_power/share
        if (present(field)) then
            field%sx(:field%n) = field%sx(:field%n)/share
            field%sy(:field%n) = field%sy(:field%n)/share
        end if
        if (present(per_strip)) per_strip%friction_power(:per_strip%n) = &
            per_strip%friction_power(:per_strip%n)/share
    end subroutine solve_tangential

    subroutine solve_by_method(workspace, case, tangential, status, field, &
                               per_strip)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field
        type(strip_forces_t), intent(inout), optional :: per_strip

        call check_contact_methods(case%methods, status)
        if (is_error(status)) return
        call check_contact_friction(case, case%methods%tangential, status)
        if (is_error(status)) return
        if (workspace%solved_by == 0) then
            call set_status(status, st_bad_argument, 'no normal solution in the workspace')
            return
        end if
        if (present(per_strip)) per_strip%n = 0
        if (present(field)) then
            field%n = 0
            if (.not. gives_elements(case%methods%tangential)) then
                call set_status(status, st_bad_argument, 'the tangential method gives forces ' // &
                                'only, no tractions element by element')
                return
            end if
        end if
        associate (methods => case%methods, material => softened(case%material, case%friction))
            select case (methods%tangential)
            case (tangential_none)
                call clear_status(status)
            case (tangential_faststrip, tangential_faststrip_plain)
                call faststrip_tangential_solve( &
                    workspace%strips, material, case%mu, case%creepage, &
                    methods%points_per_strip, tangential, status, field, per_strip, &
                    methods%tangential == tangential_faststrip, case%friction)
            case (tangential_faststrip_paper)
                call paper_solve(workspace%strips, material, case%mu, case%creepage, &
                                 methods%points_per_strip, tangential, status, field)
            case (tangential_faststrip_corrected)
                call corrected_solve(workspace%strips, material, case%mu, case%creepage, &
                                     methods%points_per_strip, tangential, status, field)
            case (tangential_fastsim)
                call solve_fastsim(workspace, case, fastsim_variant_t(friction=case%friction), &
                                   tangential, status, field)
            case (tangential_fastsim_elliptic)
                call solve_fastsim(workspace, case, &
                                   fastsim_variant_t(elliptic_bound=.true., &
                                                     friction=case%friction), &
                                   tangential, status, field)
            case (tangential_fastsim_weighted)
                call solve_fastsim(workspace, case, &
                                   fastsim_variant_t(single_flexibility=.true., &
                                                     friction=case%friction), &
                                   tangential, status, field)
            case (tangential_linear)
                call solve_law(workspace, case, law_linear, tangential, status)
            case (tangential_she)
                call solve_law(workspace, case, law_shen_hedrick_elkins, tangential, status)
            case (tangential_polach)
                call solve_law(workspace, case, law_polach, tangential, status)
            end select
        end associate
    end subroutine solve_by_method

    !> FASTSIM on the Hertz ellipse, if there is one, or on the patches' ellipses.
    subroutine solve_fastsim(workspace, case, variant, tangential, status, field)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(fastsim_variant_t), intent(in) :: variant
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status
        type(tangential_field_t), intent(inout), optional :: field

        associate (nx => case%methods%fastsim_nx, ny => case%methods%fastsim_ny, &
                   material => softened(case%material, case%friction))
            if (workspace%solved_by == normal_hertz) then
                call fastsim_solve(workspace%hertz, material, case%mu, case%creepage, nx, ny, &
                                   tangential, status, field, variant)
            else
                call fastsim_strips_solve(workspace%strips, material, case%mu, case%creepage, nx, &
                                          ny, tangential, status, field, variant)
            end if
        end associate
    end subroutine solve_fastsim

    !> A creep force law on the Hertz ellipse, if there is one, or on the patches' ellipses.
    subroutine solve_law(workspace, case, law, tangential, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        integer, intent(in) :: law
        type(tangential_result_t), intent(out) :: tangential
        type(status_t), intent(out) :: status

        if (workspace%solved_by == normal_hertz) then
            call law_solve(law, workspace%hertz, softened(case%material, case%friction), case%mu, &
                           case%creepage, tangential, status)
        else
            call law_strips_solve(law, workspace%strips, softened(case%material, case%friction), &
                                  case%mu, case%creepage, tangential, status)
        end if
    end subroutine solve_law

    !> Room for the strips of all patches together.
    pure integer function strip_capacity(methods)
        type(contact_methods_t), intent(in) :: methods

        strip_capacity = 2*methods%strips_per_patch + spare_strips
        if (methods%strips_per_patch == strips_auto .or. methods%normal == normal_auto) &
            strip_capacity = 2*strips_auto_most + spare_strips
    end function strip_capacity
end module faststrip_contact_solve
