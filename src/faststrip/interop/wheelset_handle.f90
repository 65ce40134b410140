!> What stands behind the handles of wheelsets in the C and F77 faces, and their rows of numbers:
!> nowhere else is it said which place is which component.
!>
!> ```
!> setup    1, 2 nominal radius of the right and left wheel, mm    3 distance of the flange backs,
!>          0: as belongs to the gauge      4 flange back to tape circle
!>          5 gauge   6 its depth below the crown
!>          7 distance of the rails' origins, 0: as the gauge says
!>          8 rail inclination, its tangent; 999: not said, 1:40 of names, an error of points
!> state    1 y, mm      2 z, mm        3 roll, rad     4 yaw, rad     5 speed, mm/s
!>          6, 7 rates of y and z, mm/s      8, 9, 10 rates of roll, yaw and pitch, rad/s
!>          11 curvature of the track, 1/mm
!> rails    1, 2 how far the right rail lies beside its place, y and z, mm    3 its roll, rad
!>          4, 5 rates of y and z, mm/s     6 of its roll, rad/s     7 to 12 of the left rail
!> choices  1 what is prescribed: 0 position, 1 loads, 2 axle load    2 wheels: 0 both, 1 right,
!>          2 left      3 is the roll free?      4 warm start? (0: no)
!> loads    1, 2 vertical force of the right and left wheel, N     3 axle load, N
!>          4 moment about the wheelset's centre along the track that the frame exerts, N mm
!> counts   (of a contact) 1 side, 1 right, 2 left    2 status    3 patches    4 strips across
!>          5 are errors estimated?     6 those of the forces? (1: yes)
!> numbers  (of a contact) 1, 2, 3 place in the track, mm    4 contact angle, rad
!>          5, 6 y, z on the rail's profile       7, 8, 9 x, y, z on the wheel's profile, mm
!>          10 rolling radius, mm   11 rolling speed, mm/s  12, 13, 14 creepages, -, -, rad/mm
!>          15 normal force, N      16 penetration, mm      17 area, mm^2   18 largest pressure, MPa
!>          19, 20 ends, mm         21 largest half-length  22, 23, 24 Fx, Fs, N, Mz, N mm
!>          25 friction power over rolling speed, N         26 share in adhesion
!>          27, 28, 29 force in the track, N    30, 31, 32 the same in the wheelset's frame
!>          33, 34, 35 moment about the wheelset's centre in the track, N mm
!>          36, 37, 38 estimated error of penetration, largest pressure and area
!>          39, 40, 41 those of Fx, Fs and Mz
!> totals   1, 2 z of the centre, right and left, mm        3 roll, rad
!>          4 to 9 force in the track of the right and left wheel, N
!>          10 to 15 the same in the wheelset's frame       16 to 21 moments in the track, N mm
!> sums     1, 2 status of the right and left wheel         3, 4 contacts
!>          5, 6 contact problems that were solved
!> ```
module faststrip_interop_wheelset_handle
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_intptr_t, c_ptr, c_f_pointer
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     st_bad_argument, st_workspace_too_small
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t
    use faststrip_interop_register, only: leave_register, look_up_register, kind_wheelset
    use faststrip_interop_wear_room, only: wear_room_t
    use faststrip_numerics_environment, only: environment_t, hold_environment, restore_environment
    use faststrip_contact_plausible, only: doubts_t, case_names_t, add_doubt, doubt_material, &
                                           doubt_pressure
    use faststrip_base_plausible, only: of_radius
    use faststrip_wheelset_plausible, only: state_names_t, find_state_doubts
    use faststrip_wheelset_solve, only: solve_wheelset
    use faststrip_wheelset_strips, only: wheel_strips_t
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_workspace_t, &
                                        wheelset_demand_t, wheelset_result_t, wheel_contact_t, &
                                        side_right, side_left
    implicit none
    private

    public :: wheelset_handle_t
    public :: n_setup, n_state, n_rails, n_choices, n_loads, n_counts, n_numbers, n_totals, n_sums
    public :: allocate_wheelset, free_wheelset, find_wheelset, wheelset_solve
    public :: contact_count, contact_place, read_contact, contact_limitations, read_totals

    !> Lengths of the rows.
    !> Given: by the faces.
    integer, parameter :: n_setup = 8, n_state = 11, n_rails = 12, n_choices = 4, &
                          n_loads = 4, n_counts = 6, n_numbers = 41, n_totals = 21, n_sums = 6

    !> One caller's wheelset.
    type :: wheelset_handle_t
        type(wheelset_model_t) :: model
        type(wheelset_workspace_t) :: workspace
        type(wheelset_result_t) :: result
        logical :: has(2) = .false. !! which wheels the result is of
        logical :: knows_rails = .true. !! has the caller's state them?
        real(c_double) :: rails(n_rails) = 0.0_c_double !! where and how they are, as above
        type(wheel_strips_t) :: strips !! of the contact whose wear was asked for
        type(wear_room_t) :: wear      !! the same
        type(status_t) :: status    !! of the last call
        type(doubts_t) :: doubts    !! what was outside of practice in the last state
    end type wheelset_handle_t

contains

    !> Make an empty handle. Its first values are much for a stack: so nothing else happens here.
    subroutine allocate_wheelset(handle, status)
        type(wheelset_handle_t), pointer, intent(out) :: handle !! null when there is an error
        type(status_t), intent(out) :: status                   !! `st_workspace_too_small`

        integer :: failure

        call clear_status(status)
        allocate (handle, stat=failure)
        if (failure == 0) return
        handle => null()
        call set_status(status, st_workspace_too_small, 'not enough memory for a wheelset')
    end subroutine allocate_wheelset

    !> Free a wheelset; nothing happens to what is none.
    subroutine free_wheelset(number, status)
        integer(c_intptr_t), intent(in) :: number !! as the caller passed it
        type(status_t), intent(out) :: status     !! `st_bad_argument`: no wheelset, or freed

        type(wheelset_handle_t), pointer :: handle
        type(c_ptr) :: address

        call leave_register(number, kind_wheelset, address, status)
        if (is_error(status)) return
        call c_f_pointer(address, handle)
        deallocate (handle)
    end subroutine free_wheelset

    !> The wheelset of a number.
    subroutine find_wheelset(number, handle, status)
        integer(c_intptr_t), intent(in) :: number               !! as the caller passed it
        type(wheelset_handle_t), pointer, intent(out) :: handle !! null if it is none
        type(status_t), intent(out) :: status !! `st_bad_argument`: no wheelset, or freed

        type(c_ptr) :: address

        handle => null()
        call look_up_register(number, kind_wheelset, address, status)
        if (.not. is_error(status)) call c_f_pointer(address, handle)
    end subroutine find_wheelset

    !> Solve the contacts of a wheelset on its rails as they are now; its result has them.
    subroutine wheelset_solve(handle, state, choices, loads)
        type(wheelset_handle_t), intent(inout) :: handle !! its status tells how it ended
        real(c_double), intent(in) :: state(n_state)     !! position and velocity
        integer(c_int), intent(in) :: choices(n_choices) !! what is prescribed
        real(c_double), intent(in) :: loads(n_loads)     !! the same

        type(wheelset_demand_t) :: demand
        type(rail_state_t) :: rail(2)
        type(wheelset_state_t) :: place
        type(environment_t) :: environment
        integer :: side, i

        handle%has = .false.
        handle%doubts%n = 0
        if (choices(2) < 0 .or. choices(2) > 2) then
            call set_status(handle%status, st_bad_argument, 'the wheels must be 0, both, 1, ' // &
                            'right, or 2, left, got ' // count_text(choices(2)))
            return
        end if
        associate (r => handle%rails)
            rail = [rail_state_t(r(1), r(2), r(3), r(4), r(5), r(6)), &
                    rail_state_t(r(7), r(8), r(9), r(10), r(11), r(12))]
        end associate
        demand = wheelset_demand_t(choices(1), choices(2) /= [2, 1], loads(:2), loads(3), &
                                   choices(3) /= 0, loads(4))
        ! As if it had never been solved.
        if (choices(4) == 0) handle%workspace%has_last = .false.
        place = wheelset_state_t(state(1), state(2), state(3), state(4), state(5), state(6), &
                                 state(7), state(8), state(9), state(10), state(11), rail)
        call hold_environment(environment)
        call doubt_material(handle%model%case, case_names_t(), handle%doubts)
        call add_doubt(handle%doubts, of_radius, 'radius', handle%model%radius)
        call find_state_doubts(handle%model, place, demand, state_names_t(), handle%doubts)
        call restore_environment(environment)
        call solve_wheelset(handle%model, handle%workspace, place, demand, handle%result, &
                            handle%status)
        if (is_error(handle%status)) return
        handle%has = demand%wants
        call hold_environment(environment)
        do side = side_right, side_left
            if (.not. handle%has(side)) cycle
            do i = 1, handle%result%wheel(side)%n
                associate (normal => handle%result%wheel(side)%contact(i)%figures%normal)
                    call doubt_pressure('pmax', normal%pmax, handle%doubts)
                end associate
            end do
        end do
        call restore_environment(environment)
    end subroutine wheelset_solve

    !> Contacts of the last solution.
    pure integer function contact_count(handle)
        type(wheelset_handle_t), intent(in) :: handle !! solved or not

        contact_count = sum(handle%result%wheel%n, mask=handle%has)
    end function contact_count

    !> Which contact of which wheel the i-th is; those of the right wheel come first.
    pure subroutine contact_place(handle, i, side, k)
        type(wheelset_handle_t), intent(in) :: handle !! with so many contacts
        integer, intent(in) :: i                      !! from 1 on
        integer, intent(out) :: side                  !! `side_right`, `side_left`
        integer, intent(out) :: k                     !! of its wheel

        k = merge(handle%result%wheel(side_right)%n, 0, handle%has(side_right))
        side = merge(side_right, side_left, i <= k)
        k = merge(i, i - k, i <= k)
    end subroutine contact_place

    !> One contact of the last solution.
    pure subroutine read_contact(handle, i, counts, numbers)
        type(wheelset_handle_t), intent(in) :: handle     !! with so many contacts
        integer, intent(in) :: i                          !! from 1 on
        integer(c_int), intent(out) :: counts(n_counts)   !! as above
        real(c_double), intent(out) :: numbers(n_numbers) !! as above

        integer :: side, k

        call contact_place(handle, i, side, k)
        call contact_row(handle%result%wheel(side)%contact(k), counts, numbers)
        counts(1) = side
    end subroutine read_contact

    !> All limitations of a contact of the last solution, as a set.
    pure integer(c_int) function contact_limitations(handle, i)
        type(wheelset_handle_t), intent(in) :: handle !! with so many contacts
        integer, intent(in) :: i                      !! from 1 on

        integer :: side, k

        call contact_place(handle, i, side, k)
        contact_limitations = handle%result%wheel(side)%contact(k)%status%limitations
    end function contact_limitations

    pure subroutine contact_row(contact, counts, numbers)
        type(wheel_contact_t), intent(in) :: contact
        integer(c_int), intent(out) :: counts(n_counts)
        real(c_double), intent(out) :: numbers(n_numbers)

        associate (normal => contact%figures%normal, forces => contact%figures%tangential, &
                   errors => contact%figures%certificate, creepage => contact%creepage, &
                   wrong => contact%figures%force_errors)
            counts = [0, contact%status%code, normal%n_patches, normal%strips_across, &
                      merge(1, 0, contact%figures%is_estimated), &
                      merge(1, 0, contact%figures%forces_are_estimated)]
            numbers = [contact%place, contact%angle, contact%rail, contact%wheel, contact%radius, &
                       contact%speed, creepage%cksi, creepage%ceta, creepage%cphi, normal%load, &
                       normal%penetration, normal%area, normal%pmax, normal%y_min, normal%y_max, &
                       normal%x_max, forces%fx, forces%fy, forces%mz, forces%friction_power, &
                       forces%stick_fraction, contact%force, contact%force_wheelset, &
                       contact%moment, &
                       errors%est_err_penetration, errors%est_err_pmax, errors%est_err_area, &
                       wrong%fx, wrong%fy, wrong%mz]
        end associate
    end subroutine contact_row

    !> What the wheels of the last solution came to; zeros where there was none.
    pure subroutine read_totals(handle, sums, totals)
        type(wheelset_handle_t), intent(in) :: handle   !! solved or not
        integer(c_int), intent(out) :: sums(n_sums)     !! as above
        real(c_double), intent(out) :: totals(n_totals) !! as above

        integer :: side, i

        sums = 0
        totals = 0.0_c_double
        do side = side_right, side_left
            if (.not. handle%has(side)) cycle
            associate (wheel => handle%result%wheel(side))
                sums(side::2) = [wheel%status%code, wheel%n, wheel%solutions]
                totals(side) = wheel%z
                totals(3) = wheel%roll
                i = 3*side
                totals(i + 1:i + 3) = wheel%force
                totals(i + 7:i + 9) = wheel%force_wheelset
                totals(i + 13:i + 15) = wheel%moment
            end associate
        end do
    end subroutine read_totals
end module faststrip_interop_wheelset_handle
