!> The contacts of one wheel at a given height: from the overlap to the forces.
module faststrip_wheelset_wheel
    use faststrip_base_friction, only: friction_at_angle, largest_speed
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: largest_ratio, most_steps
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, add_limitation, &
                                     join_limitations, st_out_of_range, st_no_convergence, &
                                     st_under_resolved, st_target_missed
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_solve, only: set_contact_gap, solve_contact, solve_contact_forces, &
                                       estimate_contact, name_yield
    use faststrip_contact_method, only: workspace_t
    use faststrip_contact_methods, only: contact_methods_t, normal_table, is_in_core, &
                                         normal_auto, normal_strip, normal_hertz, &
                                         tangential_linear, tangential_none
    use faststrip_contact_target, only: target_error, name_target
    use faststrip_contact_wanted, only: wanted_t, needs_forces
    use faststrip_tangential_force_errors, only: force_errors_t
    use faststrip_geometry_gap, only: gap_t
    use faststrip_wheelset_guide, only: needs_guide, take_guide
    use faststrip_geometry_contact_frame, only: contact_frame_t, frame_gap_t, in_track, along_normal
    use faststrip_normal_limitations, only: name_resolution, name_lean
    use faststrip_normal_strips, only: usual_strips
    use faststrip_normal_strip_places, only: find_displaced, value_between
    use faststrip_geometry_contact_yawed, only: find_frame_gap
    use faststrip_geometry_overlap, only: region_t, find_regions, most_regions
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, rail_origin, on_rail_profile, &
                                                unrolled
    use faststrip_geometry_wheel_outline, only: lowered_axes
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, &
                                                 rail_state_t, on_roller_t, rigid_creepage, &
                                                 approach_rate, rail_velocity, cross
    use faststrip_wheelset_types, only: wheelset_model_t, wheel_contact_t, wheel_result_t, &
                                        wheel_workspace_t
    use faststrip_wheelset_wheel_neighbours, only: join_near, place_frames, press_gap
    implicit none
    private

    public :: solve_wheel_at, estimate_wheel
    public :: name_pressures, mirror_wheel, reverse_wheel
    public :: take_motion, move_wheel, find_motion, find_contact_force, place_on_wheel
    public :: add_contacts

    ! Tuned [1]: of the strips' last step. Origin: measured: with 1e-10 a step of a wheelset costs a
    ! tenth more; with five strips forces from the last solution are those without it within 2e-7 of
    ! the load (3e-8 with 1e-10, 4e-7 with 5e-9).
    real(wp), parameter :: strip_tolerance = 2.0e-9_wp
    ! Tuned [1]: how high gaps of neighbours are sampled, over the overlap. Origin: patches end
    ! below the overlap.
    real(wp), parameter :: near_height = 1.5_wp
    ! Tuned [1]: how exact heights of strips are that do not stand side by side, over the overlap
    ! and the strips' last step. Origin: chosen: forces follow them by as much, far below what
    ! profiles leave open.
    real(wp), parameter :: places_share = 50.0_wp
    ! Tuned [1]: errors of pmax and penetration over what is left out of a yawed gap. Origin: 100
    ! contacts against their exact gaps: where a joint of the profile crosses strips pmax is up to
    ! 8 % too small, nine times what the gap bulges by.
    real(wp), parameter :: left_of_pmax = 10.0_wp, left_of_penetration = 1.5_wp
    ! Tuned [1]: part of the tolerance of auto up to which an ellipse alone answers. Origin: chosen:
    ! half of it is 0.2 to 0.7 mm of a wheel's way.
    real(wp), parameter :: blend_from = 0.5_wp
    ! Tuned [1]: largest part of what is missed that a step takes. Origin: safeguard: most take 0.7
    ! to 1.3.
    real(wp), parameter :: most_part = 3.0_wp
    ! Falling friction takes a wheelset that rolls slower than this, in mm/s, as one that rolls so:
    ! slip is nothing there.
    real(wp), parameter :: least_speed = 1.0_wp/largest_speed

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
                call solve_in_places(workspace%gap, workspace%contact(i), case, contact)
            else
                call solve_contact(workspace%contact(i), case, contact%figures, contact%status)
            end if
            if (is_error(contact%status)) return
            call find_contact_force(model, axes, contact)
            associate (solved => workspace%contact(i))
                if (.not. case%curved) &
                    call name_lean(solved%solver%curve, solved%strips, contact%status)
            end associate
        end subroutine solve_and_sum
    end subroutine solve_one

    ! The share of strips where auto took a Hertz ellipse: forces of a motion go over from one to
    ! the other while the ellipse's estimate goes from a part of the tolerance to all of it. Within
    ! a budget of time there is none for both.
    pure real(wp) function share_of_strips(wanted, workspace) result(share)
        type(wanted_t), intent(in) :: wanted
        type(workspace_t), intent(in) :: workspace ! solved

        share = 0.0_wp
        if (workspace%solved_by /= normal_hertz .or. wanted%budget_us > 0.0_wp) return
        share = workspace%steps%estimate/wanted%tolerance
        share = max(0.0_wp, min((share - blend_from)/(1.0_wp - blend_from), 1.0_wp))
    end function share_of_strips

    ! Forces of both; patch and pressures are those of the strips.
    pure subroutine hand_to_strips(ellipse, share, contact)
        type(wheel_contact_t), intent(in) :: ellipse
        real(wp), intent(in) :: share                   ! of the strips, 0 to 1
        type(wheel_contact_t), intent(inout) :: contact ! by strips; gets the sums of both

        contact%force = mixed(ellipse%force, contact%force, share)
        contact%force_wheelset = mixed(ellipse%force_wheelset, contact%force_wheelset, share)
        contact%moment = mixed(ellipse%moment, contact%moment, share)
        associate (mine => contact%figures, its => ellipse%figures)
            mine%normal%load = mixed(its%normal%load, mine%normal%load, share)
            mine%moment = mixed(its%moment, mine%moment, share)
            associate (a => its%tangential, b => mine%tangential)
                b%fx = mixed(a%fx, b%fx, share)
                b%fy = mixed(a%fy, b%fy, share)
                b%mz = mixed(a%mz, b%mz, share)
                b%friction_power = mixed(a%friction_power, b%friction_power, share)
            end associate
            call mix_errors(its%force_errors, share, mine%force_errors)
        end associate
    end subroutine hand_to_strips

    ! Estimates of such forces.
    pure subroutine mix_errors(ellipse, share, errors)
        type(force_errors_t), intent(in) :: ellipse
        real(wp), intent(in) :: share                 ! of the strips, 0 to 1
        type(force_errors_t), intent(inout) :: errors ! of the strips

        errors%fx = mixed(ellipse%fx, errors%fx, share)
        errors%fy = mixed(ellipse%fy, errors%fy, share)
        errors%mz = mixed(ellipse%mz, errors%mz, share)
        errors%arm = mixed(ellipse%arm, errors%arm, share)
    end subroutine mix_errors

    elemental real(wp) function mixed(of_ellipse, of_strips, share)
        real(wp), intent(in) :: of_ellipse, of_strips, share

        mixed = of_ellipse + share*(of_strips - of_ellipse)
    end function mixed

    ! A contact whose strips have places along x: first pressures, then the forces where they are.
    ! Auto tells as how many strips it is solved; elements of Kalker's methods have no such places.
    subroutine solve_in_places(gap, workspace, case, contact)
        type(frame_gap_t), intent(inout) :: gap
        type(workspace_t), intent(inout) :: workspace
        type(contact_case_t), intent(inout) :: case
        type(wheel_contact_t), intent(inout) :: contact

        type(contact_methods_t) :: asked
        type(status_t) :: forces, chosen
        integer :: tangential, k
        logical :: warm, is_auto

        warm = case%warm_start
        asked = case%methods
        is_auto = asked%normal == normal_auto
        if (is_auto) then
            call solve_contact(workspace, case, contact%figures, chosen)
            contact%status = chosen
            if (is_error(chosen) .or. .not. any(workspace%solved_by == [normal_strip, &
                                                                       normal_hertz])) return
            case%methods = workspace%methods
            case%warm_start = .true.
        end if
        tangential = case%methods%tangential
        case%methods%tangential = tangential_none
        if (gap%apart > 0.0_wp .and. case%methods%normal == normal_strip &
            .and. .not. case%smoothing > 0.0_wp) then
            call solve_apart(gap, workspace, case, contact)
            ! Their pressures lean to where the others leave the gap lower.
            associate (n => gap%n)
                gap%ahead(:n) = gap%ahead(:n) - gap%apart*gap%skew(:n) &
                                /(4.0_wp*gap%reach(:n)*(gap%inv2r(:n) + gap%bend(:n, 1)))
            end associate
            if (is_auto .and. .not. is_error(contact%status)) contact%status = chosen
        else if (.not. is_auto) then
            call solve_contact(workspace, case, contact%figures, contact%status)
        end if
        case%warm_start = warm
        if (is_error(contact%status)) then
            case%methods = asked
            return
        end if
        case%methods%tangential = tangential
        associate (strips => workspace%strips, n => gap%n)
            do k = 1, strips%n
                strips%x0(k) = value_between(gap%y(:n), gap%ahead(:n), 0.5_wp &
                                             *(strips%y_left(k) + strips%y_right(k)))
            end do
            strips%has_places = .true.
        end associate
        call solve_contact_forces(workspace, case, contact%figures, forces)
        case%methods = asked
        if (is_error(forces)) then
            contact%status = forces
        else
            call join_limitations(contact%status, forces)
        end if
    end subroutine solve_in_places

    ! The pressures of strips that do not stand side by side: on a gap that follows of them, by
    ! steps of which each goes as far as the last two tell (Aitken).
    subroutine solve_apart(gap, workspace, case, contact)
        type(frame_gap_t), intent(inout) :: gap
        type(workspace_t), intent(inout) :: workspace ! with strips, if it starts from them
        type(contact_case_t), intent(inout) :: case
        type(wheel_contact_t), intent(inout) :: contact

        character(len=*), parameter :: not_found = &
            'heights of strips that do not stand side by side do not converge'
        real(wp) :: part, turn, tolerance
        integer :: pass

        associate (n => gap%n, lower => gap%lower)
            lower(:n, 1) = 0.0_wp
            gap%tilt(:n, 1) = 0.0_wp
            gap%bend(:n, 1) = 0.0_wp
            part = 1.0_wp
            tolerance = case%strip_tolerance
            if (.not. case%stays) tolerance = places_share*tolerance
            if (case%warm_start .or. case%stays) then
                call find_miss()
                call add_miss()
            end if
            do pass = 1, most_steps
                lower(:n, 3) = gap%h(:n) + lower(:n, 1)
                gap%tilt(:n, 3) = gap%slope(:n) + gap%tilt(:n, 1)
                gap%bend(:n, 3) = gap%inv2r(:n) + gap%bend(:n, 1)
                call set_contact_gap(workspace, gap%y(:n), lower(:n, 3), gap%bend(:n, 3), &
                                     contact%status, gap%inclination(:n), gap%tilt(:n, 3))
                if (is_error(contact%status)) return
                call solve_contact(workspace, case, contact%figures, contact%status)
                if (is_error(contact%status)) return
                lower(:n, 4) = lower(:n, 2)
                call find_miss()
                if (maxval(abs(lower(:n, 2))) <= tolerance*gap%overlap) return
                if (pass > 1) then
                    turn = sum((lower(:n, 2) - lower(:n, 4))**2)
                    if (turn > 0.0_wp) &
                        part = -part*sum(lower(:n, 4)*(lower(:n, 2) - lower(:n, 4)))/turn
                    part = max(1.0_wp/most_part, min(part, most_part))
                end if
                call add_miss()
                ! From where they are.
                case%warm_start = .true.
            end do
        end associate
        if (case%stays) then
            call set_status(contact%status, st_no_convergence, not_found)
        else
            call add_limitation(contact%status, st_under_resolved, not_found)
        end if

    contains

        ! What the present strips ask for beyond what is added.
        subroutine find_miss()
            associate (n => gap%n)
                call find_displaced(workspace%strips, normal_compliance(case%material), &
                                    gap%overlap, gap%y(:n), gap%h(:n), gap%x0(:n), gap%reach(:n), &
                                    gap%lower(:n, 2), gap%tilt(:n, 2), gap%bend(:n, 2), &
                                    gap%skew(:n))
                gap%lower(:n, 2) = gap%apart*gap%lower(:n, 2) - gap%lower(:n, 1)
                gap%tilt(:n, 2) = gap%apart*gap%tilt(:n, 2) - gap%tilt(:n, 1)
                gap%bend(:n, 2) = gap%apart*gap%bend(:n, 2) - gap%bend(:n, 1)
            end associate
        end subroutine find_miss

        subroutine add_miss()
            associate (n => gap%n)
                gap%lower(:n, 1) = gap%lower(:n, 1) + part*gap%lower(:n, 2)
                gap%tilt(:n, 1) = gap%tilt(:n, 1) + part*gap%tilt(:n, 2)
                gap%bend(:n, 1) = gap%bend(:n, 1) + part*gap%bend(:n, 2)
            end associate
        end subroutine add_miss
    end subroutine solve_apart

    !> Creepages, speed and approach rate of a contact.
    subroutine find_motion(model, pair, state, axes, frame, case, contact)
        type(wheelset_model_t), intent(in) :: model      !! made
        type(wheel_on_rail_t), intent(in) :: pair        !! of this side
        type(wheelset_state_t), intent(in) :: state      !! as of a right wheel
        type(wheelset_axes_t), intent(in) :: axes        !! where the wheelset is
        type(contact_frame_t), intent(in) :: frame       !! of the contact
        type(contact_case_t), intent(in) :: case         !! its penetration is known
        type(wheel_contact_t), intent(inout) :: contact  !! gets them

        type(on_roller_t) :: roller
        real(wp) :: point(3), moving(3)

        ! Velocities are those of the wheel's surface before it is deformed.
        point = along_normal(frame, case%penetration + frame%lift)
        associate (rail => state%rail(1), c => contact%creepage)
            moving = rail_velocity(rail, frame%origin(2:3) - rail_origin(pair, rail))
            if (pair%roller_radius > 0.0_wp) then
                roller = on_roller_t(norm2(frame%origin([1, 3]) &
                                           - [0.0_wp, pair%roller_radius + rail%z]), &
                                     frame%turn, state%speed/pair%roller_radius)
            end if
            call rigid_creepage(state, axes, point, frame%angle, c, contact%speed, moving, &
                                model%speed_floor, roller)
            contact%approach_rate = approach_rate(state, axes, point, frame%angle, moving, roller)
            if (max(abs(c%cksi), abs(c%ceta), abs(c%cphi)) >= largest_ratio &
                .and. case%methods%tangential == tangential_linear) &
                call set_status(contact%status, st_out_of_range, 'linear forces have no limit ' // &
                                'where a wheelset slides but hardly rolls: take another method')
        end associate
    end subroutine find_motion

    !> Force and moment of a solved contact on its rail. Damping is that of Hunt and Crossley,
    !> N (1 + 3/2 alpha v), never below 0: it vanishes where bodies touch first. Friction is in
    !> proportion, which is exact where all slides.
    pure subroutine find_contact_force(model, axes, contact)
        type(wheelset_model_t), intent(in) :: model     !! made
        type(wheelset_axes_t), intent(in) :: axes       !! where the wheelset is
        type(wheel_contact_t), intent(inout) :: contact !! solved; gets them

        type(contact_frame_t) :: frame
        real(wp) :: damped

        frame = contact_frame_t(contact%place, contact%angle, contact%turn)
        associate (normal => contact%figures%normal, forces => contact%figures%tangential)
            damped = max(0.0_wp, 1.0_wp + model%damping*contact%approach_rate)
            contact%force = damped*in_track(frame, [forces%fx, forces%fy, normal%load])
            contact%force_wheelset = [dot_product(contact%force, axes%ahead), &
                                      dot_product(contact%force, axes%axle), &
                                      dot_product(contact%force, axes%down)]
            contact%moment = cross(frame%origin - axes%centre, contact%force) &
                             + damped*in_track(frame, [contact%figures%moment, forces%mz])
        end associate
    end subroutine find_contact_force

    !> Creepages of a contact, and the friction of its angle and speed.
    pure subroutine take_motion(model, contact, case)
        type(wheelset_model_t), intent(in) :: model  !! made
        type(wheel_contact_t), intent(in) :: contact !! its creepages, angle and speed are known
        type(contact_case_t), intent(inout) :: case  !! gets what follows of them

        case%creepage = contact%creepage
        case%mu = friction_at_angle(model%case%friction, model%case%mu, contact%angle)
        case%friction%speed = max(contact%speed, least_speed)
        case%friction%table%y_rail = contact%rail(1)
        case%friction%table%angle = contact%angle
        if (case%curved) then
            case%pitch = cos(contact%angle)/contact%radius
            if (model%pair(1)%roller_radius > 0.0_wp) &
                case%pitch = case%pitch + cos(contact%angle)/model%pair(1)%roller_radius
        end if
    end subroutine take_motion

    !> Where a point of the track is in the frame of the wheel's profile.
    pure subroutine place_on_wheel(pair, axes, point, contact)
        type(wheel_on_rail_t), intent(in) :: pair       !! of this side
        type(wheelset_axes_t), intent(in) :: axes       !! where the wheelset is
        real(wp), intent(in) :: point(3)                !! in the track, mm
        type(wheel_contact_t), intent(inout) :: contact !! gets the place and the rolling radius

        real(wp) :: arm(3), down

        arm = point - axes%centre
        down = dot_product(arm, axes%down)
        contact%wheel(1) = dot_product(arm, axes%ahead)
        contact%wheel(2) = dot_product(arm, axes%axle) - pair%y_line
        contact%wheel(3) = down - pair%radius + pair%z_line
        contact%radius = hypot(down, contact%wheel(1))
    end subroutine place_on_wheel

    !> A wheel that was solved in a mirror, as it is.
    pure subroutine mirror_wheel(wheel)
        type(wheel_result_t), intent(inout) :: wheel !! of the left wheel

        real(wp) :: ends(2)
        integer :: i

        wheel%roll = -wheel%roll
        wheel%force(2) = -wheel%force(2)
        wheel%force_wheelset(2) = -wheel%force_wheelset(2)
        wheel%moment([1, 3]) = -wheel%moment([1, 3])
        do i = 1, wheel%n
            associate (contact => wheel%contact(i))
                contact%place(2) = -contact%place(2)
                contact%angle = -contact%angle
                contact%rail(1) = -contact%rail(1)
                contact%wheel(2) = -contact%wheel(2)
                contact%creepage%ceta = -contact%creepage%ceta
                contact%creepage%cphi = -contact%creepage%cphi
                contact%force(2) = -contact%force(2)
                contact%force_wheelset(2) = -contact%force_wheelset(2)
                contact%moment([1, 3]) = -contact%moment([1, 3])
                contact%figures%tangential%fy = -contact%figures%tangential%fy
                contact%figures%tangential%mz = -contact%figures%tangential%mz
                contact%figures%along%fy = -contact%figures%along%fy
                contact%figures%along%mz = -contact%figures%along%mz
                contact%figures%moment(1) = -contact%figures%moment(1)
                associate (normal => contact%figures%normal)
                    ends = [normal%y_min, normal%y_max]
                    normal%y_min = -ends(2)
                    normal%y_max = -ends(1)
                end associate
                contact%figures%flash%y = -contact%figures%flash%y
            end associate
        end do
    end subroutine mirror_wheel

    !> A wheel that was solved as if it rolled ahead, as it is: it rolls backwards.
    pure subroutine reverse_wheel(wheel)
        type(wheel_result_t), intent(inout) :: wheel !! of a reversed state

        integer :: i

        wheel%force(1) = -wheel%force(1)
        wheel%force_wheelset(1) = -wheel%force_wheelset(1)
        wheel%moment(2:3) = -wheel%moment(2:3)
        do i = 1, wheel%n
            associate (contact => wheel%contact(i))
                contact%place(1) = -contact%place(1)
                contact%turn = -contact%turn
                contact%wheel(1) = -contact%wheel(1)
                contact%creepage%cksi = -contact%creepage%cksi
                contact%creepage%cphi = -contact%creepage%cphi
                contact%force(1) = -contact%force(1)
                contact%force_wheelset(1) = -contact%force_wheelset(1)
                contact%moment(2:3) = -contact%moment(2:3)
                contact%figures%tangential%fx = -contact%figures%tangential%fx
                contact%figures%tangential%mz = -contact%figures%tangential%mz
                contact%figures%along%fx = -contact%figures%along%fx
                contact%figures%along%mz = -contact%figures%along%mz
                contact%figures%moment(2) = -contact%figures%moment(2)
                contact%figures%flash%x = -contact%figures%flash%x
            end associate
        end do
    end subroutine reverse_wheel
end module faststrip_wheelset_wheel
