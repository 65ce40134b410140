!> Solve the contacts of wheelset.txt again by `use faststrip`, and count where a bit differs.
program replay
    use faststrip
    implicit none
    type(wheelset_model_t) :: model
    type(wheelset_workspace_t) :: workspace
    type(wheelset_result_t) :: result
    type(wheelset_demand_t) :: demand
    type(wheelset_state_t) :: state
    type(status_t) :: status
    real(wp) :: x, now(2, 4), was(2, 4), more(3)
    integer :: run, stage, last_run, unit, ended, rows, different

    call make()
    last_run = 0
    rows = 0
    different = 0
    open (newunit=unit, file='wheelset.txt', status='old', action='read')
    do
        read (unit, *, iostat=ended) run, stage, x, state%speed, state%y, state%yaw, &
            state%y_rate, state%yaw_rate, state%roll, demand%load, was(1, :3), was(2, :3), &
            was(:, 4), more
        if (ended /= 0) exit
        state%pitch_rate = -state%speed/460.0_wp
        ! A run starts from no solution.
        if (run /= last_run) workspace%has_last = .false.
        last_run = run
        call solve_wheelset(model, workspace, state, demand, result, status)
        associate (right => result%wheel(side_right), left => result%wheel(side_left))
            now(1, :) = [right%force, right%moment(3)]
            now(2, :) = [left%force, left%moment(3)]
        end associate
        rows = rows + 1
        if (is_error(status) .or. any(abs(now - was) > 0.0_wp)) different = different + 1
    end do
    close (unit)
    print '(a, 1x, i0)', 'rows', rows, 'different', different

contains

    subroutine make()
        type(profile_t) :: wheels(2), rails(2)
        type(contact_case_t) :: case

        case%methods%strips_per_patch = 7
        call make_wheel_profile('s1002', wheels(1), status)
        call make_rail_profile('60e1', 0.025_wp, rails(1), status)
        wheels(2) = wheels(1)
        rails(2) = rails(1)
        call make_wheelset(wheels, rails, wheelset_t(), 460.0_wp, track_t(), case, model, status)
        call reserve_wheelset(workspace, model, status)
    end subroutine make
end program replay
