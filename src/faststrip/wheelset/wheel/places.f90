!> A contact whose strips do not stand side by side: in a yawed wheel's patch that is wide or has
!> two lobes, strips have places along x.
module faststrip_wheelset_wheel_places
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: most_steps
    use faststrip_base_material, only: normal_compliance
    use faststrip_base_status, only: status_t, set_status, is_error, add_limitation, &
                                     join_limitations, st_no_convergence, st_under_resolved
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: workspace_t
    use faststrip_contact_methods, only: contact_methods_t, normal_auto, normal_strip, &
                                         normal_hertz, tangential_none
    use faststrip_contact_solve, only: set_contact_gap, solve_contact, solve_contact_forces
    use faststrip_geometry_contact_frame, only: frame_gap_t
    use faststrip_normal_strip_places, only: find_displaced, value_between
    use faststrip_wheelset_types, only: wheel_contact_t
    implicit none
    private

    public :: solve_in_places, places_share

    !> How exact heights of strips are that do not stand side by side, over the overlap and the
    !> strips' last step.
    !> Tuned [1]. Origin: chosen: forces follow them by as much, far below what profiles leave open.
    real(wp), parameter :: places_share = 50.0_wp
    ! Tuned [1]: largest part of what is missed that a step takes. Origin: safeguard: most take 0.7
    ! to 1.3.
    real(wp), parameter :: most_part = 3.0_wp
    ! Tuned [passes]: in which nothing comes nearer, before it is left: patches of which two are
    ! about to meet swing. Origin: chosen: the swing goes on for ever, at 7 ms a pass.
    integer, parameter :: most_idle = 4

contains

    !> A contact whose strips have places along x: first pressures, then the forces where they are.
    !> Auto tells as how many strips it is solved; elements of Kalker's methods have no such places.
    subroutine solve_in_places(gap, workspace, case, contact, steps)
        type(frame_gap_t), intent(inout) :: gap         !! of the contact's frame
        type(workspace_t), intent(inout) :: workspace   !! that the gap is set in
        type(contact_case_t), intent(inout) :: case     !! its methods come back as they were
        type(wheel_contact_t), intent(inout) :: contact !! gets its figures and its status
        integer, intent(inout) :: steps                 !! of the solver, goes on

        type(contact_methods_t) :: asked
        type(status_t) :: forces, chosen
        integer :: tangential, k
        logical :: warm, is_auto

        warm = case%warm_start
        asked = case%methods
        is_auto = asked%normal == normal_auto
        if (is_auto) then
            call solve_contact(workspace, case, contact%figures, chosen)
            steps = steps + max(1, contact%figures%normal%iterations)
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
            call solve_apart(gap, workspace, case, contact, steps)
            ! Their pressures lean to where the others leave the gap lower.
            associate (n => gap%n)
                gap%ahead(:n) = gap%ahead(:n) - gap%apart*gap%skew(:n) &
                                /(4.0_wp*gap%reach(:n)*(gap%inv2r(:n) + gap%bend(:n, 1)))
            end associate
            if (is_auto .and. .not. is_error(contact%status)) contact%status = chosen
        else if (.not. is_auto) then
            call solve_contact(workspace, case, contact%figures, contact%status)
            steps = steps + max(1, contact%figures%normal%iterations)
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
    subroutine solve_apart(gap, workspace, case, contact, steps)
        type(frame_gap_t), intent(inout) :: gap
        type(workspace_t), intent(inout) :: workspace ! with strips, if it starts from them
        type(contact_case_t), intent(inout) :: case
        type(wheel_contact_t), intent(inout) :: contact
        integer, intent(inout) :: steps

        character(len=*), parameter :: not_found = &
            'heights of strips that do not stand side by side do not converge'
        real(wp) :: part, turn, tolerance, missed, least
        integer :: pass, idle

        associate (n => gap%n, lower => gap%lower)
            lower(:n, 1) = 0.0_wp
            gap%tilt(:n, 1) = 0.0_wp
            gap%bend(:n, 1) = 0.0_wp
            part = 1.0_wp
            least = huge(least)
            idle = 0
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
                steps = steps + max(1, contact%figures%normal%iterations)
                if (is_error(contact%status)) return
                lower(:n, 4) = lower(:n, 2)
                call find_miss()
                missed = maxval(abs(lower(:n, 2)))
                if (missed <= tolerance*gap%overlap) return
                idle = merge(0, idle + 1, missed < least)
                least = min(least, missed)
                if (idle > most_idle) exit
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
end module faststrip_wheelset_wheel_places
