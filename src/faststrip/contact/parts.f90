!> The parts of a solution, in their order: check, gap, pressures, their errors, forces, their
!> errors. `solve_contact` and the search of auto are made of them, and nothing else is.
module faststrip_contact_parts
    use faststrip_base_friction, only: check_friction, falls, falls_when_hot, largest_speed
    use faststrip_base_kinds, only: wp
    use faststrip_base_material, only: check_material
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, &
                                     join_limitations, number_text, st_bad_argument, &
                                     st_workspace_too_small
    use faststrip_base_thermal, only: check_thermal
    use faststrip_geometry_gap, only: gap_t
    use faststrip_geometry_gap_curve, only: set_gap_curve
    use faststrip_geometry_gap_smoothing, only: smooth_gap
    use faststrip_normal_limitations, only: check_resolution
    use faststrip_tangential_types, only: tangential_result_t
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_contact_case, only: contact_case_t, keeps_elements
    use faststrip_contact_clock, only: lap_t, start_lap, add_lap
    use faststrip_contact_cut, only: solve_motion
    use faststrip_contact_given_forces, only: check_given_forces, solve_given_forces, &
                                              estimate_given_forces
    use faststrip_contact_method, only: contact_result_t, workspace_t, wear_figures_t, &
                                        normal_method_t, tangential_method_t, normal_method_of, &
                                        tangential_method_of
    use faststrip_contact_method_friction, only: take_friction
    use faststrip_contact_method_surface, only: lay_strips, flatten_load, turn_forces
    use faststrip_contact_methods, only: contact_methods_t, method_t, normal_auto, &
                                         tangential_none, check_normal_method, &
                                         check_tangential_method, check_resolutions
    implicit none
    private

    public :: find_normal_method, find_tangential_method, check_methods, refuse_elements
    public :: check_contact, check_contact_friction, set_case_gap
    public :: find_pressures, add_forces

contains

    !> The normal method of a number in a workspace.
    subroutine find_normal_method(workspace, number, method, status)
        type(workspace_t), intent(in) :: workspace             !! reserved
        integer, intent(in) :: number                          !! of the method
        class(normal_method_t), pointer, intent(out) :: method !! null with an error
        type(status_t), intent(inout) :: status
            !! changed by an error: `st_bad_argument`: there is none; `st_workspace_too_small`: not
            !! reserved

        method => normal_method_of(workspace, number)
        if (associated(method)) return
        call check_normal_method(number, status)
        if (.not. is_error(status)) call refuse_workspace(status)
    end subroutine find_normal_method

    !> The tangential method of a number in a workspace.
    subroutine find_tangential_method(workspace, number, method, status)
        type(workspace_t), intent(in) :: workspace                 !! reserved
        integer, intent(in) :: number                              !! of the method
        class(tangential_method_t), pointer, intent(out) :: method !! null with an error
        type(status_t), intent(inout) :: status
            !! changed by an error: `st_bad_argument`: there is none; `st_workspace_too_small`: not
            !! reserved

        method => tangential_method_of(workspace, number)
        if (associated(method)) return
        call check_tangential_method(number, status)
        if (.not. is_error(status)) call refuse_workspace(status)
    end subroutine find_tangential_method

    subroutine refuse_workspace(status)
        type(status_t), intent(inout) :: status

        call set_status(status, st_workspace_too_small, 'the workspace was not reserved')
    end subroutine refuse_workspace

    !> Refuse methods that a workspace does not have and resolutions out of range.
    subroutine check_methods(workspace, methods, normal, tangential, status)
        type(workspace_t), intent(in) :: workspace     !! reserved
        type(contact_methods_t), intent(in) :: methods !! as the caller set them
        class(normal_method_t), pointer, intent(out) :: normal !! null if it is auto
        class(tangential_method_t), pointer, intent(out) :: tangential !! null with an error
        type(status_t), intent(out) :: status          !! those of `find_normal_method`

        normal => null()
        tangential => null()
        call clear_status(status)
        if (methods%normal /= normal_auto) &
            call find_normal_method(workspace, methods%normal, normal, status)
        if (is_error(status)) return
        call find_tangential_method(workspace, methods%tangential, tangential, status)
        if (.not. is_error(status)) call check_resolutions(methods, status)
    end subroutine check_methods

    !> Refuse a case that cannot be solved, its gap and friction aside.
    subroutine check_contact(workspace, case, normal, tangential, status)
        type(workspace_t), intent(in) :: workspace !! reserved
        type(contact_case_t), intent(in) :: case   !! as the caller set it
        class(normal_method_t), pointer, intent(out) :: normal !! null if it is auto
        class(tangential_method_t), pointer, intent(out) :: tangential !! null with an error
        type(status_t), intent(out) :: status
            !! those of `check_methods`, `check_resolution`, `check_material`,
            !! `check_given_forces`, `check_heat`

        call check_methods(workspace, case%methods, normal, tangential, status)
        if (.not. is_error(status)) &
            call check_resolution(case%resolution_limit, 'the resolution limit', status)
        if (.not. is_error(status)) &
            call check_resolution(case%force_limit, 'the limit of the errors of forces', status)
        if (.not. is_error(status)) call check_material(case%material, status)
        if (.not. is_error(status) .and. any(case%given%is_given)) &
            call check_given_forces(case%given, case%creepage, tangential%about, status)
        if (case%asked%temperatures .and. .not. is_error(status)) &
            call check_heat(case, tangential%about, status)
    end subroutine check_contact

    !> Refuse friction that is none, and friction that falls with slip where the method cannot do.
    pure subroutine check_contact_friction(case, about, status)
        type(contact_case_t), intent(in) :: case !! its friction counts
        type(method_t), intent(in) :: about      !! the tangential method
        type(status_t), intent(out) :: status    !! those of `check_friction`; `st_bad_argument`

        call check_friction(case%friction, status)
        if (is_error(status)) return
        if (falls(case%friction) .and. .not. about%takes_falling) &
            call set_status(status, st_bad_argument, trim(about%name) // &
                            ' takes no friction that falls with slip; faststrip, fastsim and ' // &
                            'tang do')
        if (falls_when_hot(case%friction) .and. .not. about%takes_hot) &
            call set_status(status, st_bad_argument, trim(about%name) // &
                            ' takes no friction that falls with temperature; faststrip and ' // &
                            'fastsim do')
        if (is_error(status)) return
        if (case%asked%temperatures .or. falls_when_hot(case%friction)) &
            call check_heat(case, about, status)
    end subroutine check_contact_friction

    !> Refuse bodies, speeds and methods without temperatures.
    pure subroutine check_heat(case, about, status)
        type(contact_case_t), intent(in) :: case !! asks for temperatures, or friction does
        type(method_t), intent(in) :: about      !! the tangential method
        type(status_t), intent(inout) :: status  !! those of `check_thermal`; `st_bad_argument`

        if (case%asked%temperatures .and. &
            (about%number == tangential_none .or. .not. about%gives_elements)) then
            call set_status(status, st_bad_argument, 'temperatures need tractions and slip ' // &
                            'element by element, which ' // trim(about%name) // ' does not give')
        else if (.not. (case%friction%speed >= 1.0_wp/largest_speed &
                        .and. case%friction%speed <= largest_speed)) then
            call set_status(status, st_bad_argument, 'temperatures need a rolling speed of ' // &
                            '1e-12 to 1e12 mm/s, got ' // number_text(case%friction%speed))
        else
            call check_thermal(case%thermal, status)
        end if
    end subroutine check_heat

    !> Put the case's gap into the workspace, smoothed if that is asked for; without one that of
    !> `set_contact_gap` stays.
    subroutine set_case_gap(workspace, case, change, status)
        type(workspace_t), intent(inout) :: workspace !! with capacity for it
        type(contact_case_t), intent(in) :: case      !! gap, noise
        real(wp), intent(inout) :: change             !! rms, by smoothing, if it is smoothed, mm
        type(status_t), intent(inout) :: status       !! those of `smooth_gap`, `check_gap`

        type(gap_t) :: smooth

        if (.not. allocated(case%gap%y)) return
        if (case%smoothing > 0.0_wp) then
            call smooth_gap(case%gap, case%smoothing, smooth, change, status)
            if (.not. is_error(status)) call set_gap_curve(workspace%solver%curve, smooth, status)
        else
            call set_gap_curve(workspace%solver%curve, case%gap, status)
        end if
    end subroutine set_case_gap

    !> Pressures on the workspace's gap, and their error estimates.
    subroutine find_pressures(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with a gap
        type(contact_case_t), intent(in) :: case        !! checked
        class(normal_method_t), intent(in) :: method    !! that of the case
        type(contact_result_t), intent(inout) :: result !! empty; gets its normal part
        type(status_t), intent(out) :: status           !! those of the method

        type(lap_t) :: lap

        workspace%solved_by = 0
        workspace%is_ellipse = .false.
        call start_lap(case%asked%times, lap)
        call method%solve(workspace, case, result%normal, status)
        if (is_error(status)) return
        workspace%strips%has_places = .false.
        call add_lap(case%asked%times, lap, result%times%normal_us, result%times%normal_cpu_us)
        call lay_strips(workspace%solver%curve, case, workspace%strips)
        workspace%strip_forces%n = 0
        result%tangential = tangential_result_t()
        call turn_forces(workspace, result)
        workspace%solved_by = case%methods%normal
        workspace%methods = case%methods
        if (case%estimate) call method%estimate(workspace, case, result, status)
    end subroutine find_pressures

    !> Forces on the workspace's pressures. Creepages beyond what methods take are cut; what goes
    !> with their size is told of them as they are.
    subroutine find_forces(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with a normal solution
        type(contact_case_t), intent(in) :: case        !! material, friction, creepages
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result !! gets its tangential part
        type(status_t), intent(out) :: status           !! those of the method

        type(lap_t) :: lap

        ! Nothing of the forces before stays, whatever happens.
        result%has_forces = .false.
        result%knows_stick = .false.
        result%wear = wear_figures_t()
        result%knows_temperatures = .false.
        result%tangential = tangential_result_t()
        result%force_errors = force_errors_t()
        result%creepage_errors = 0.0_wp
        result%forces_are_estimated = .false.
        workspace%field%n = 0
        workspace%field%has_temperature = .false.
        workspace%strip_forces%n = 0
        call check_forces(workspace, case, method%about, status)
        if (is_error(status)) return
        call start_lap(case%asked%times, lap)
        call flatten_load(result)
        call lay_strips(workspace%solver%curve, case, workspace%strips)
        call take_friction(workspace, case)
        result%mu = workspace%mu
        if (.not. (case%warm_start .or. case%stays)) workspace%found%is_known = .false.
        if (any(case%given%is_given)) then
            call solve_given_forces(workspace, case, method, result, status)
        else
            call solve_motion(workspace, case, method, result, status)
        end if
        if (is_error(status)) return
        call add_lap(case%asked%times, lap, result%times%tangential_us, &
                     result%times%tangential_cpu_us)
        workspace%methods%tangential = case%methods%tangential
        ! Tractions of dissimilar materials may have changed the pressures.
        call lay_strips(workspace%solver%curve, case, workspace%strips)
        call turn_forces(workspace, result)
        if (.not. method%gives_strip_forces) workspace%strip_forces%n = 0
        result%has_forces = case%methods%tangential /= tangential_none
        result%knows_stick = result%has_forces .and. method%about%gives_stick
    end subroutine find_forces

    !> Forces, and their error estimates where those of the pressures are known and wanted; an error
    !> becomes the contact's.
    subroutine add_forces(workspace, case, method, result, status)
        type(workspace_t), intent(inout) :: workspace   !! with a normal solution
        type(contact_case_t), intent(in) :: case        !! material, friction, creepages
        class(tangential_method_t), intent(in) :: method !! that of the case
        type(contact_result_t), intent(inout) :: result !! gets its tangential part
        type(status_t), intent(inout) :: status         !! limitations so far; changed by an error

        type(status_t) :: forces

        call find_forces(workspace, case, method, result, forces)
        if (is_error(forces)) then
            status = forces
        else if (any(case%given%is_given)) then
            call join_limitations(status, forces)
            if (case%estimate .and. result%is_estimated) &
                call estimate_given_forces(workspace, case, method, result, status)
        else if (case%estimate .and. result%is_estimated) then
            call method%estimate(workspace, case, result, status)
        end if
    end subroutine add_forces

    !> Refuse what a tangential method cannot do.
    pure subroutine check_forces(workspace, case, about, status)
        type(workspace_t), intent(in) :: workspace
        type(contact_case_t), intent(in) :: case
        type(method_t), intent(in) :: about ! the method
        type(status_t), intent(out) :: status

        call check_contact_friction(case, about, status)
        if (is_error(status)) return
        if (workspace%solved_by == 0) then
            call set_status(status, st_bad_argument, 'no normal solution in the workspace')
        else if (keeps_elements(case) .and. .not. about%gives_elements) then
            call refuse_elements(about, status)
        end if
    end subroutine check_forces

    !> Say that a method gives no elements.
    pure subroutine refuse_elements(about, status)
        type(method_t), intent(in) :: about   !! the method
        type(status_t), intent(inout) :: status !! gets `st_bad_argument`

        call set_status(status, st_bad_argument, trim(about%name) // &
                        ' gives forces only, no tractions element by element')
    end subroutine refuse_elements
end module faststrip_contact_parts
