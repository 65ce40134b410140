!> The seams of a vehicle code in Fortran: rates of its state, with the contacts of both wheelsets,
!> and their Jacobian, along a sequence of steps. The vehicle is numbers, which test and tutorial
!> write from bogie.py; the contacts are the library's. Reads standard input:
!>
!>     number of coordinates, steps, time step, speed, pitch rate of pure rolling
!>     masses, the matrix of all but the contacts, the state
!>     for each step: forces of the track, and of each wheelset curvature, y, z of the right and of
!>     the left rail, rates of their z
!>
!> and writes state, rates and Jacobian at each step. mm, N, s, t, rad.
program vehicle
    use, intrinsic :: iso_fortran_env, only: error_unit
    use faststrip
    implicit none

    !> Of a wheelset: y, z, roll, pitch, yaw; which of them the library has derivatives over.
    integer, parameter :: own = 5, pitch = 4, places(4) = [1, 2, 3, 5]
    real(wp), parameter :: radius = 460.0_wp, tread = 750.0_wp

    interface
        !> Of LAPACK.
        subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
            import :: wp
            integer, intent(in) :: n, nrhs, lda, ldb
            real(wp), intent(inout) :: a(lda, *), b(ldb, *)
            integer, intent(out) :: ipiv(*), info
        end subroutine dgesv
    end interface

    type(wheelset_model_t) :: model
    type(wheelset_workspace_t) :: workspace(2)
    type(status_t) :: status
    real(wp), allocatable :: masses(:), fixed(:, :), state(:), rates(:), jacobian(:, :), track(:), &
                             matrix(:, :), change(:)
    real(wp) :: rails(7, 2), time_step, speed, rolling
    integer, allocatable :: pivots(:)
    integer :: n, steps, i, k, info

    read *, n, steps, time_step, speed, rolling
    allocate (masses(n), fixed(2*n, 2*n), state(2*n), rates(2*n), jacobian(2*n, 2*n), track(n))
    allocate (pivots(2*n))
    read *, masses
    read *, fixed
    read *, state
    call make()
    do k = 1, steps
        read *, track, rails
        call find_rates()
        print '(*(es24.16))', state
        print '(*(es24.16))', rates
        print '(*(es24.16))', jacobian
        ! An implicit step by one Newton iteration, as plain as can be: any integrator that takes a
        ! right-hand side and its Jacobian does here.
        matrix = -time_step*jacobian
        do i = 1, 2*n
            matrix(i, i) = matrix(i, i) + 1.0_wp
        end do
        change = time_step*rates
        call dgesv(2*n, 1, matrix, 2*n, pivots, change, 2*n, info)
        if (info /= 0) error stop 'vehicle: the step has no solution'
        state = state + change
    end do

contains

    !> One model serves both wheelsets; each has a workspace with its own last solution.
    subroutine make()
        type(profile_t) :: wheels(2), rails(2)
        type(contact_case_t) :: case

        case%mu = 0.3_wp
        case%estimate = .false.
        call make_wheel_profile('s1002', wheels(1), status)
        call make_rail_profile('60e1', 0.025_wp, rails(1), status)
        wheels(2) = wheels(1)
        rails(2) = rails(1)
        call make_wheelset(wheels, rails, wheelset_t(), radius, track_t(), case, model, status)
        do i = 1, 2
            if (.not. is_error(status)) call reserve_wheelset(workspace(i), model, status)
        end do
        call check()
    end subroutine make

    !> Rates of the state, and their Jacobian. z and roll are states: the position is given, and
    !> nothing has to be found.
    subroutine find_rates()
        type(wheelset_state_t) :: motion
        type(wheelset_demand_t) :: demand
        type(wheelset_result_t) :: result
        real(wp) :: slopes(6, 9, 2), wheelset(6, 2*own), parts(own, 6)
        integer :: w, first, last

        rates = matmul(fixed, state)
        rates(n + 1:) = rates(n + 1:) + track/masses
        jacobian = fixed
        demand%kind = demand_position
        do w = 1, 2
            first = own*(w - 1) + 1
            last = own*w
            motion = motion_of(state(first:last), state(n + first:n + last), rails(:, w))
            call solve_wheelset(model, workspace(w), motion, demand, result, status)
            call check()
            ! What acts on the rails acts on the wheels the other way; the axle has its own axis.
            parts = 0.0_wp
            parts(1, 2) = -1.0_wp
            parts(2, 3) = -1.0_wp
            parts(3, 4) = -1.0_wp
            parts(4, 4:6) = [motion%yaw, -1.0_wp, -motion%roll]
            parts(5, 6) = -1.0_wp
            rates(n + first:n + last) = rates(n + first:n + last) + matmul(parts, &
                [result%wheel(1)%force + result%wheel(2)%force, &
                 result%wheel(1)%moment + result%wheel(2)%moment])/masses(first:last)

            call find_wheelset_derivatives(model, workspace(w), demand%wants, result, slopes, &
                                           status)
            call check()
            wheelset = 0.0_wp
            wheelset(:, places) = sum(slopes(:, :4, :), dim=3)
            wheelset(:, own + places) = sum(slopes(:, 5:8, :), dim=3)
            wheelset(:, own + pitch) = sum(slopes(:, 9, :), dim=2)
            wheelset(:own, :) = matmul(parts, wheelset)
            do i = 1, own
                associate (row => jacobian(n + first + i - 1, :), mass => masses(first + i - 1))
                    row(first:last) = row(first:last) + wheelset(i, :own)/mass
                    row(n + first:n + last) = row(n + first:n + last) + wheelset(i, own + 1:)/mass
                end associate
            end do
        end do
    end subroutine find_rates

    !> As the library takes it.
    type(wheelset_state_t) function motion_of(q, v, under) result(motion)
        real(wp), intent(in) :: q(own), v(own) ! coordinates, rates
        real(wp), intent(in) :: under(7)       ! curvature, rails

        motion%y = q(1)
        motion%z = q(2)
        motion%roll = q(3)
        motion%yaw = q(5)
        motion%speed = speed
        motion%y_rate = v(1)
        motion%z_rate = v(2)
        motion%roll_rate = v(3)
        motion%pitch_rate = rolling + v(pitch)
        motion%yaw_rate = v(5)
        motion%curvature = under(1)
        ! Rails roll with their sleepers.
        motion%rail = rail_state_t(roll=(under(3) - under(5))/(2*tread), &
                                   roll_rate=(under(6) - under(7))/(2*tread))
        motion%rail%y = under([2, 4])
        motion%rail%z = under([3, 5])
        motion%rail%z_rate = under([6, 7])
    end function motion_of

    !> Limitations are below 100 and count; an error ends this program, where an integrator would
    !> halve its step.
    subroutine check()
        if (.not. is_error(status)) return
        write (error_unit, '(2a)') 'vehicle: ', trim(status%message)
        error stop
    end subroutine check
end program vehicle
