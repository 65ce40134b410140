!> What seems wrong in the case and the states of a wheelset.
module faststrip_command_wheelset_doubts
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: quantities, of_speed
    use faststrip_base_status, only: status_t, is_error
    use faststrip_contact_plausible, only: doubts_t, doubt_material
    use faststrip_files_csv, only: csv_table_t
    use faststrip_geometry_wheelset_state, only: wheelset_state_t
    use faststrip_wheelset_plausible, only: state_names_t, find_state_doubts
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_demand_t
    use faststrip_command_settings_case_doubts, only: case_names
    use faststrip_command_settings_doubts, only: tally_t, count_doubts, hold_doubts, hold_tally
    use faststrip_command_wheelset_case, only: wheelset_case_t
    use faststrip_command_wheelset_states, only: given_state_t, state_columns_t, read_state_row, &
                                                 take_state
    implicit none
    private

    public :: hold_wheelset_doubts

contains

    !> Keep what is outside of practice: of the bodies, and of all states a line each kind.
    subroutine hold_wheelset_doubts(path, model, case, table, columns)
        character(len=*), intent(in) :: path           !! name of the case file
        type(wheelset_model_t), intent(in) :: model    !! made of it
        type(wheelset_case_t), intent(in) :: case      !! with a state, or without
        type(csv_table_t), intent(in) :: table         !! states, unless the case has one
        type(state_columns_t), intent(in) :: columns   !! of the table

        type(given_state_t) :: given
        type(doubts_t) :: doubts
        type(tally_t) :: tally
        type(status_t) :: status
        logical :: is_starting
        integer :: row

        call doubt_material(model%case, case_names(), doubts)
        if (case%has_state) then
            call find_given_doubts(model, case%state, .false., doubts)
            call hold_doubts(doubts, path)
            return
        end if
        call hold_doubts(doubts, path)
        is_starting = .false.
        do row = 1, table%n_rows
            call read_state_row(table, row, columns, given, status)
            if (is_error(status)) cycle
            is_starting = is_starting .or. stands_or_runs(model, given)
        end do
        do row = 1, table%n_rows
            call read_state_row(table, row, columns, given, status)
            if (is_error(status)) cycle
            doubts%n = 0
            call find_given_doubts(model, given, is_starting, doubts)
            call count_doubts(tally, doubts, int(row, int64), table%line(row))
        end do
        call hold_tally(tally, table%file)
    end subroutine hold_wheelset_doubts

    ! A vehicle that starts or stops somewhere in a table has all speeds below the usual ones.
    logical function stands_or_runs(model, given)
        type(wheelset_model_t), intent(in) :: model
        type(given_state_t), intent(in) :: given

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(status_t) :: status

        call take_state(given, model, state, demand, status)
        stands_or_runs = abs(state%speed) <= 0.0_wp .or. &
                         abs(state%speed) >= quantities(of_speed)%least
        if (is_error(status)) stands_or_runs = .false.
    end function stands_or_runs

    ! A state that is none has nothing to say here.
    subroutine find_given_doubts(model, given, is_starting, doubts)
        type(wheelset_model_t), intent(in) :: model
        type(given_state_t), intent(in) :: given
        logical, intent(in) :: is_starting !! is a low speed usual?
        type(doubts_t), intent(inout) :: doubts

        type(wheelset_state_t) :: state
        type(wheelset_demand_t) :: demand
        type(status_t) :: status
        integer :: i

        call take_state(given, model, state, demand, status)
        if (is_error(status)) return
        call find_state_doubts(model, state, demand, &
                               state_names_t(y='y_mm', roll='roll_rad', yaw='yaw_rad', &
                                             speed='speed_mm_s', pitch_rate='pitch_rate_rad_s', &
                                             curve='curve_radius_mm', load='Fz_N'), doubts)
        if (.not. is_starting .or. abs(state%speed) >= quantities(of_speed)%least) return
        do i = doubts%n, 1, -1
            if (doubts%quantity(i) /= of_speed) cycle
            doubts%quantity(i:doubts%n - 1) = doubts%quantity(i + 1:doubts%n)
            doubts%words(i:doubts%n - 1) = doubts%words(i + 1:doubts%n)
            doubts%n = doubts%n - 1
        end do
    end subroutine find_given_doubts
end module faststrip_command_wheelset_doubts
