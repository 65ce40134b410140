!> The contacts of one wheel at a given height: from the overlap to the forces.
module faststrip_wheelset_wheel
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, add_limitation, &
                                     count_text, st_no_convergence, st_under_resolved, &
                                     st_target_missed
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: set_contact_gap, solve_contact, solve_contact_forces, &
                                       estimate_contact, name_yield
    use faststrip_contact_methods, only: normal_table, is_in_core, normal_auto
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: needs_forces
    use faststrip_geometry_gap, only: gap_t
    use faststrip_wheelset_guide, only: needs_guide, take_guide
    use faststrip_geometry_contact_frame, only: contact_frame_t
    use faststrip_normal_limitations, only: name_resolution, name_lean
    use faststrip_normal_strips, only: usual_strips
    use faststrip_geometry_contact_yawed, only: find_frame_gap
    use faststrip_geometry_overlap, only: region_t, find_regions, most_regions
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, on_rail_profile, unrolled
    use faststrip_geometry_wheel_outline, only: lowered_axes
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, rail_state_t
    use faststrip_wheelset_types, only: wheelset_model_t, wheel_contact_t, wheel_result_t, &
                                        wheel_workspace_t
    use faststrip_wheelset_wheel_blend, only: share_of_strips, hand_to_strips, mix_errors
    use faststrip_wheelset_wheel_motion, only: find_motion, take_motion, place_on_wheel, &
                                               find_contact_force
    use faststrip_wheelset_wheel_places, only: solve_in_places, places_share
    use faststrip_wheelset_wheel_neighbours, only: join_near, place_frames, press_gap
    implicit none
    private

    public :: solve_wheel_at, move_wheel, estimate_wheel, name_pressures, add_contacts

    ! Tuned [1]: of the strips' last step. Origin: measured: with 1e-10 a step of a wheelset costs a
    ! tenth more; with five strips forces from the last solution are those without it within 2e-7 of
    ! the load (3e-8 with 1e-10, 4e-7 with 5e-9).
    real(wp), parameter :: strip_tolerance = 2.0e-9_wp
    ! Tuned [steps]: of the solver for the contacts of one wheel in one call. Origin: measured: of
    ! 4,200 calls those that ended well took up to 15,000; one that does not end takes 0.1 ms
    ! a step.
    integer, parameter :: most_solver_steps = 40000
    ! Tuned [1]: how high gaps of neighbours are sampled, over the overlap. Origin: patches end
    ! below the overlap.
    real(wp), parameter :: near_height = 1.5_wp
    ! Tuned [1]: errors of pmax and penetration over what is left out of a yawed gap. Origin: 100
    ! contacts against their exact gaps: where a joint of the profile crosses strips pmax is up to
    ! 8 % too small, nine times what the gap bulges by.
    real(wp), parameter :: left_of_pmax = 10.0_wp, left_of_penetration = 1.5_wp

contains

    !> All contacts of a wheel that is lowered beyond the state of its outline, without estimates.
    subroutine solve_wheel_at(model, pair, workspace, state, lowered, wheel, neighbour)
        type(wheelset_model_t), intent(in) :: model          !! made
        type(wheel_on_rail_t), intent(in) :: pair            !! of this side
        type(wheel_workspace_t), intent(inout) :: workspace  !! with the outline of the state
        type(wheelset_state_t), intent(in) :: state          !! as of a right wheel
        real(wp), intent(in) :: lowered                      !! mm
        type(wheel_result_t), intent(inout) :: wheel         !! as of a right wheel; z not set
        real(wp), intent(in), optional :: neighbour
            !! is the state one of that of the last solution, whose contacts and strips stay? Then
            !! this is the tolerance of the strips' last step

        type(region_t) :: regions(most_regions)
        type(contact_case_t) :: case
        type(contact_frame_t) :: frames(most_regions)
        real(wp) :: near(most_regions), load, left, before
        integer :: i, n, pass
        logical :: are_near, is_at_rest

        if (workspace%steps > most_solver_steps .and. .not. present(neighbour)) then
            call set_status(wheel%status, st_no_convergence, 'no answer after ' // &
                            trim(count_text(workspace%steps)) // ' steps of the solver')
            return
        end if
        call find_regions(pair, workspace%outline, lowered, regions, n)
        call join_near(model, regions, n, near)
        wheel%n = n
        case = model%case
        case%by_load = .false.
        case%estimate = .false.
        case%wanted%first_strips = usual_strips
        case%asked%strip_forces = .true.
        if (workspace%is_guided) call take_guide(case)
        ! Named where the wheelset came to rest.
        case%yield = 0.0_wp
        case%strip_tolerance = min(case%strip_tolerance, strip_tolerance)
        case%warm_start = workspace%n == n .and. (workspace%is_guided .or. .not. needs_guide(case))
        if (present(neighbour)) then
            case%stays = .true.
            case%strip_tolerance = neighbour
            if (workspace%n /= n) then
                call set_status(wheel%status, st_no_convergence, 'contacts come or go')
                return
            end if
        end if
        workspace%n = n
        workspace%region(:n) = regions(:n)
        call place_frames(pair, workspace%outline%state%rail(1), regions(:n), near(:n), &
                          case%curved, frames(:n))
        ! Kalker's methods leave no strips.
        are_near = any(near(:n - 1) > 0.0_wp) .and. &
                   is_in_core(normal_table, case%methods%normal)
        if (.not. are_near) near = 0.0_wp
        if (are_near .and. .not. case%warm_start) workspace%contact(:n)%strips%n = 0
        do pass = 1, most_steps
            left = 0.0_wp
            call clear_status(wheel%status)
            do i = 1, n
                associate (contact => wheel%contact(i))
                    load = contact%figures%normal%load
                    contact = wheel_contact_t()
                    call solve_one(model, pair, workspace, i, regions(i), frames(:n), near(:n), &
                                   state, lowered, case, contact)
                    wheel%solutions = wheel%solutions + 1
                    if (worse(contact%status, wheel%status)) wheel%status = contact%status
                    if (is_error(contact%status)) then
                        if (.not. case%stays) workspace%n = 0
                        return
                    end if
                    left = max(left, abs(contact%figures%normal%load - load))
                end associate
            end do
            left = left/max(maxval(wheel%contact(:n)%figures%normal%load), tiny(left))
            if (pass <= 2) before = 1.0_wp
            ! The next pass will leave the same part of it as this one did of what was left before.
            is_at_rest = .not. are_near .or. pass > 1 .and. left*min(left/before, 1.0_wp) &
                         <= merge(1.0_wp, places_share, case%stays)*case%strip_tolerance
            if (is_at_rest) exit
            before = left
            case%warm_start = .not. needs_guide(case)
        end do
        if (.not. is_at_rest) call add_limitation(wheel%status, st_under_resolved, &
                                                  'contacts that press each other do not converge')
        call add_contacts(wheel)
    end subroutine solve_wheel_at

    !> The forces of a solved wheel that moves otherwise: on the pressures that it has.
    subroutine move_wheel(model, pair, workspace, state, lowered, wheel)
        type(wheelset_model_t), intent(in) :: model          !! made
        type(wheel_on_rail_t), intent(in) :: pair            !! of this side
        type(wheel_workspace_t), intent(inout) :: workspace  !! of the solution
        type(wheelset_state_t), intent(in) :: state          !! as of a right wheel: other rates
        real(wp), intent(in) :: lowered                      !! mm, that of the solution
        type(wheel_result_t), intent(inout) :: wheel         !! solved, as of a right wheel

        type(contact_case_t) :: case
        type(wheelset_axes_t) :: axes
        integer :: i

        axes = lowered_axes(workspace%outline, lowered)
        case = model%case
        case%estimate = .false.
        do i = 1, wheel%n
            associate (contact => wheel%contact(i))
                case%penetration = contact%figures%normal%penetration
                call find_motion(model, pair, state, axes, &
                                 contact_frame_t(contact%place, contact%angle, contact%turn, &
                                                 contact%lift), &
                                 case, contact)
                if (.not. is_error(contact%status)) then
                    call take_motion(model, contact, case)
                    call solve_contact_forces(workspace%contact(i), case, contact%figures, &
                                              contact%status)
                end if
                if (worse(contact%status, wheel%status)) wheel%status = contact%status
                if (is_error(contact%status)) return
                call find_contact_force(model, axes, contact)
            end associate
        end do
        call add_contacts(wheel)
    end subroutine move_wheel

    !> The sums of a wheel's contacts.
    pure subroutine add_contacts(wheel)
        type(wheel_result_t), intent(inout) :: wheel !! with solved contacts; gets the sums

        integer :: i

        wheel%force = 0.0_wp
        wheel%force_wheelset = 0.0_wp
        wheel%moment = 0.0_wp
        do i = 1, wheel%n
            wheel%force = wheel%force + wheel%contact(i)%force
            wheel%force_wheelset = wheel%force_wheelset + wheel%contact(i)%force_wheelset
            wheel%moment = wheel%moment + wheel%contact(i)%moment
        end do
    end subroutine add_contacts

    !> Error estimates of the last solution of a wheel; too large ones are named in the statuses of
    !> its contacts, and by `name_pressures` in its own.
    subroutine estimate_wheel(model, workspace, wheel)
        type(wheelset_model_t), intent(in) :: model         !! made
        type(wheel_workspace_t), intent(in) :: workspace    !! of the solution
        type(wheel_result_t), intent(inout) :: wheel        !! solved, as of a right wheel

        type(contact_case_t) :: case
        integer :: i
        logical :: is_auto

        is_auto = model%case%methods%normal == normal_auto
        case = model%case
        case%by_load = .false.
        if (is_auto) then
            ! What is under resolved for the target is named, nothing else.
            case%resolution_limit = huge(1.0_wp)
            case%force_limit = huge(1.0_wp)
        end if
        do i = 1, wheel%n
            ! Auto knows them already but where strips have places.
            if (is_auto .and. .not. workspace%contact(i)%strips%has_places) cycle
            if (is_auto) case%methods = workspace%contact(i)%methods
            associate (contact => wheel%contact(i), figures => wheel%contact(i)%figures)
                case%penetration = figures%normal%penetration
                call take_motion(model, contact, case)
                call estimate_contact(workspace%contact(i), case, figures, contact%status)
                if (is_error(contact%status) .or. .not. figures%is_estimated) cycle
                call mix_errors(workspace%ellipse_errors(i), workspace%strips_share(i), &
                                figures%force_errors)
                associate (errors => figures%normal_errors, left => workspace%left_out(i))
                    errors%est_err_pmax = errors%est_err_pmax + left_of_pmax*left
                    errors%est_err_penetration = errors%est_err_penetration &
                                                 + left_of_penetration*left
                    if (left > 0.0_wp .and. &
                        .not. btest(contact%status%limitations, st_under_resolved)) &
                        call name_resolution(errors%est_err_penetration, errors%est_err_pmax, &
                                             errors%est_err_area, case%resolution_limit, &
                                             contact%status)
                end associate
                if (is_auto .and. .not. btest(contact%status%limitations, st_target_missed)) &
                    call name_target(case%wanted, target_error(case%wanted%target, case, figures), &
                                     merge(model%case%force_limit, model%case%resolution_limit, &
                                           needs_forces(case%wanted%target)), contact%status)
            end associate
        end do
    end subroutine estimate_wheel

    !> Name pressures of a wheel above the limit that the user has set; its status becomes the worst
    !> of its contacts'.
    pure subroutine name_pressures(limit, wheel)
        real(wp), intent(in) :: limit                !! MPa; 0: none
        type(wheel_result_t), intent(inout) :: wheel !! solved; its statuses get `st_beyond_yield`

        integer :: i

        do i = 1, wheel%n
            associate (contact => wheel%contact(i))
                call name_yield(limit, contact%figures%normal%pmax, contact%status)
                if (worse(contact%status, wheel%status)) wheel%status = contact%status
            end associate
        end do
    end subroutine name_pressures

    ! An error is worse than a limitation, that is worse than none.
    pure logical function worse(status, than)
        type(status_t), intent(in) :: status, than

        worse = is_error(status) .and. .not. is_error(than) .or. than%code == 0
    end function worse

    subroutine solve_one(model, pair, workspace, i, region, frames, near, state, lowered, case, &
                         contact)
        type(wheelset_model_t), intent(in) :: model
        type(wheel_on_rail_t), intent(in) :: pair
        type(wheel_workspace_t), intent(inout) :: workspace
        integer, intent(in) :: i
        type(region_t), intent(in) :: region
        type(contact_frame_t), intent(in) :: frames(:) ! of all contacts
        real(wp), intent(in) :: near(:)
        type(wheelset_state_t), intent(in) :: state
        real(wp), intent(in) :: lowered
        type(contact_case_t), intent(inout) :: case
        type(wheel_contact_t), intent(inout) :: contact

        type(wheel_contact_t) :: ellipse
        type(contact_frame_t) :: frame
        type(wheelset_axes_t) :: axes
        type(rail_state_t) :: rail
        real(wp) :: height, place(3), share

        axes = lowered_axes(workspace%outline, lowered)
        height = model%gap_height
        if (case%stays) height = min(height, near_height*region%depth)
        rail = workspace%outline%state%rail(1)
        frame = frames(i)
        call find_gap()
        if (is_error(contact%status)) return
        workspace%left_out(i) = workspace%gap%left_out
        contact%place = frame%origin
        contact%angle = frame%angle
        contact%turn = frame%turn
        contact%lift = frame%lift
        place = unrolled(pair, rail, frame%origin)
        contact%rail = on_rail_profile(pair, rail, place(2:3))
        call find_motion(model, pair, state, axes, frame, case, contact)
        if (is_error(contact%status)) return
        call place_on_wheel(pair, axes, frame%origin, contact)
        call take_motion(model, contact, case)
        call solve_and_sum()
        workspace%strips_share(i) = 1.0_wp
        if (is_error(contact%status) .or. case%methods%normal /= normal_auto) return
        share = share_of_strips(case%wanted, workspace%contact(i))
        if (.not. share > 0.0_wp) return
        ellipse = contact
        case%wanted%ellipse = .false.
        call solve_and_sum()
        case%wanted%ellipse = .true.
        if (is_error(contact%status)) then
            ! As where strips that the tolerance asks for are not found.
            contact = ellipse
            call find_gap()
            call solve_and_sum()
        else
            call hand_to_strips(ellipse, share, contact)
            workspace%strips_share(i) = share
            workspace%ellipse_errors(i) = ellipse%figures%force_errors
        end if

    contains

        ! The gap as the contacts beside leave it, and how deep bodies overlap.
        subroutine find_gap()
            call find_frame_gap(pair, workspace%outline, region, lowered, frame, height, &
                                case%smoothing > 0.0_wp, workspace%gap, contact%status)
            if (is_error(contact%status)) return
            call press_gap(workspace, i, frames, near, normal_compliance(case%material))
            associate (gap => workspace%gap, n => workspace%gap%n)
                case%penetration = gap%overlap
                if (case%smoothing > 0.0_wp) then
                    case%gap = gap_t(gap%y(:n), gap%h(:n), gap%inv2r(:n), gap%inclination(:n))
                else
                    call set_contact_gap(workspace%contact(i), gap%y(:n), gap%h(:n), &
                                         gap%inv2r(:n), contact%status, gap%inclination(:n), &
                                         gap%slope(:n))
                end if
            end associate
        end subroutine find_gap

        subroutine solve_and_sum()
            if (workspace%gap%runs) then
                call solve_in_places(workspace%gap, workspace%contact(i), case, contact, &
                                     workspace%steps)
            else
                call solve_contact(workspace%contact(i), case, contact%figures, contact%status)
                workspace%steps = workspace%steps &
                                  + max(1, contact%figures%normal%iterations)
            end if
            if (is_error(contact%status)) return
            call find_contact_force(model, axes, contact)
            associate (solved => workspace%contact(i))
                if (.not. case%curved) &
                    call name_lean(solved%solver%curve, solved%strips, contact%status)
            end associate
        end subroutine solve_and_sum
    end subroutine solve_one
end module faststrip_wheelset_wheel
