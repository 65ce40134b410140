!> States of a wheelset: rows of a table, or one of a case file.
module faststrip_command_wheelset_states
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, number_text, &
                                     st_bad_argument
    use faststrip_base_text, only: lower_case
    use faststrip_files_csv, only: csv_table_t, require_column, column_index, cell_text, &
                                   cell_number, refuse_misspelt
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, rail_state_t
    use faststrip_wheelset_types, only: wheelset_demand_t, wheelset_model_t, demand_position, &
                                        demand_loads, demand_axle_load, side_right, side_left
    use faststrip_command_settings_table, only: n_state, state_names
    implicit none
    private

    public :: given_state_t, state_columns_t
    public :: find_state_columns, read_state_row, take_state

    ! Numbers of a rail; where they are.
    ! Given: of `state_names`.
    integer, parameter :: n_rail = 6
    integer, parameter :: at_y = 1, at_roll = 2, at_yaw = 3, at_speed = 4, at_pitch = 5, &
                          at_load = 6, at_z = 7, at_vy = 8, at_vz = 9, at_roll_rate = 10, &
                          at_yaw_rate = 11, at_curve = 12, at_moment = 13, at_rail(2) = [14, 20], &
                          at_difference = 26, at_axle = 27
    ! Whose columns a table must have.
    integer, parameter :: needed(*) = [at_y, at_roll, at_yaw, at_speed, at_load]

    !> A state as it was given.
    type :: given_state_t
        character(len=8) :: side = 'both'                !! left, right or both
        real(wp) :: number(n_state) = 0.0_wp           !! those that are given
        logical :: is_given(n_state) = .false.         !! which are
    end type given_state_t

    !> Where the columns of a table are.
    type :: state_columns_t
        integer :: case = 0                  !! name of the row
        integer :: side = 0                  !! left, right or both
        integer :: number(n_state) = 0     !! 0: there is none
    end type state_columns_t

contains

    !> Find the columns of a table.
    subroutine find_state_columns(table, columns, status)
        type(csv_table_t), intent(in) :: table        !! a table that was read
        type(state_columns_t), intent(out) :: columns   !! where they are
        type(status_t), intent(out) :: status         !! those of `require_column`

        integer :: i

        call require_column(table, 'case', columns%case, status)
        if (is_error(status)) return
        call require_column(table, 'side', columns%side, status)
        do i = 1, n_state
            if (is_error(status)) return
            if (any(i == needed)) then
                call require_column(table, trim(state_names(i)), columns%number(i), status)
            else
                columns%number(i) = column_index(table, trim(state_names(i)))
                call refuse_misspelt(table, trim(state_names(i)), state_names, status)
            end if
        end do
    end subroutine find_state_columns

    !> The state of a row; an empty cell is a number that is not given.
    subroutine read_state_row(table, row, columns, given, status)
        type(csv_table_t), intent(in) :: table      !! a table that was read
        integer, intent(in) :: row                  !! of it
        type(state_columns_t), intent(in) :: columns  !! found
        type(given_state_t), intent(out) :: given   !! as it stands there
        type(status_t), intent(out) :: status       !! those of `cell_number`

        integer :: i

        call clear_status(status)
        given%side = lower_case(cell_text(table, row, columns%side))
        do i = 1, n_state
            if (columns%number(i) == 0) cycle
            given%is_given(i) = len(cell_text(table, row, columns%number(i))) > 0
            if (.not. given%is_given(i)) cycle
            call cell_number(table, row, columns%number(i), given%number(i), status)
            if (is_error(status)) return
        end do
    end subroutine read_state_row

    !> What a state that was given means.
    subroutine take_state(given, model, state, demand, status)
        type(given_state_t), intent(in) :: given       !! a row or a group
        type(wheelset_model_t), intent(in) :: model    !! its mean radius counts
        type(wheelset_state_t), intent(out) :: state   !! mm, rad, s
        type(wheelset_demand_t), intent(out) :: demand !! N
        type(status_t), intent(out) :: status          !! `st_bad_argument`

        integer :: i

        call clear_status(status)
        if (all(given%side /= [character(len=8) :: 'left', 'right', 'both'])) then
            call set_status(status, st_bad_argument, "side must be left, right or both, got '" &
                            // trim(given%side) // "'")
            return
        end if
        do i = 1, n_state
            if (.not. given%is_given(i)) cycle
            if (.not. ieee_is_finite(given%number(i))) then
                call set_status(status, st_bad_argument, trim(state_names(i)) // ' must be a ' // &
                                'finite number, got ' // number_text(given%number(i)))
                return
            end if
        end do
        if (.not. given%is_given(at_y)) call refuse_absent(at_y)
        if (.not. given%is_given(at_yaw)) call refuse_absent(at_yaw)
        if (.not. given%is_given(at_speed)) call refuse_absent(at_speed)
        if (given%is_given(at_load) .eqv. given%is_given(at_z)) &
            call set_status(status, st_bad_argument, 'Fz_N or z_mm must be given, and not both')
        if (given%is_given(at_z) .and. .not. given%is_given(at_roll)) call refuse_absent(at_roll)
        if (given%is_given(at_curve) .and. .not. abs(given%number(at_curve)) > 0.0_wp) &
            call set_status(status, st_bad_argument, &
                            'curve_radius_mm must not be 0; a straight track has none')
        if (given%is_given(at_moment) .and. &
            (given%side /= 'both' .or. given%is_given(at_roll))) &
            call set_status(status, st_bad_argument, 'roll_moment_Nmm is for both wheels and a ' &
                            // 'roll that is found')
        if (given%is_given(at_axle) .and. given%side /= 'both') &
            call set_status(status, st_bad_argument, 'axle_moment_Nmm is for both wheels')
        if (is_error(status)) return
        state%y = number(at_y)
        state%z = number(at_z)
        state%roll = number(at_roll)
        state%yaw = number(at_yaw)
        state%speed = number(at_speed)
        state%y_rate = number(at_vy)
        state%z_rate = number(at_vz)
        state%roll_rate = number(at_roll_rate)
        state%yaw_rate = number(at_yaw_rate)
        state%pitch_rate_difference = number(at_difference)
        if (given%is_given(at_curve)) state%curvature = 1.0_wp/number(at_curve)
        do i = side_right, side_left
            state%rail(i) = rail(at_rail(i))
        end do
        if (given%is_given(at_pitch)) state%pitch_rate = number(at_pitch)
        demand%axle_moment_is_given = given%is_given(at_axle)
        demand%axle_moment = number(at_axle)
        demand%roll_is_free = .not. given%is_given(at_roll)
        if (given%is_given(at_z)) then
            demand%kind = demand_position
            demand%wants = [given%side /= 'left', given%side /= 'right']
        else if (given%side == 'both') then
            demand%kind = demand_axle_load
            demand%axle_load = number(at_load)
            demand%roll_moment = number(at_moment)
        else
            demand%kind = demand_loads
            demand%load = number(at_load)
            ! A roll is found of both wheels under the same load.
            demand%wants = demand%roll_is_free
            if (given%side == 'right') demand%wants(side_right) = .true.
            if (given%side == 'left') demand%wants(side_left) = .true.
        end if

    contains

        real(wp) function number(i)
            integer, intent(in) :: i

            number = 0.0_wp
            if (given%is_given(i)) number = given%number(i)
        end function number

        type(rail_state_t) function rail(first)
            integer, intent(in) :: first

            real(wp) :: values(n_rail)
            integer :: k

            values = [(number(first + k), k=0, n_rail - 1)]
            rail = rail_state_t(values(1), values(2), values(3), values(4), values(5), values(6))
        end function rail

        subroutine refuse_absent(i)
            integer, intent(in) :: i

            if (is_error(status)) return
            call set_status(status, st_bad_argument, trim(state_names(i)) // ' must be given')
        end subroutine refuse_absent
    end subroutine take_state
end module faststrip_command_wheelset_states
