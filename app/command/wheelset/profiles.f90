!> Wheels and rails of one state in the track, for pictures.
module faststrip_command_wheelset_profiles
    use faststrip_base_kinds, only: wp
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   end_row
    use faststrip_geometry_wheel_on_rail, only: wheel_on_rail_t, outline_point, rail_origin, turned
    use faststrip_geometry_wheelset_state, only: wheelset_state_t, wheelset_axes_t, rail_state_t, &
                                                 wheelset_axes, mirrored_state
    use faststrip_wheelset_types, only: wheelset_model_t, wheelset_result_t, side_right, side_left
    use faststrip_command_program_console, only: put_origin
    implicit none
    private

    public :: put_profiles_header, put_wheelset_profiles

contains

    !> Names of the columns.
    subroutine put_profiles_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_origin(writer)
        call put_comment(writer, 'y_mm, z_mm in the track: wheels as they are seen along it; ' &
                         // 'y_profile_mm, z_profile_mm on the profile')
        call put_header(writer, [character(len=12) :: 'case', 'body', 'side', 'y_mm', 'z_mm', &
                                 'y_profile_mm', 'z_profile_mm'])
    end subroutine put_profiles_header

    !> The wheels of a state and their rails, one row a point.
    subroutine put_wheelset_profiles(writer, case, model, last_state, result, wants)
        type(csv_writer_t), intent(inout) :: writer         !! an open file
        character(len=*), intent(in) :: case                !! name of the state
        type(wheelset_model_t), intent(in) :: model         !! wheels and rails
        type(wheelset_state_t), intent(in) :: last_state    !! as it was found
        type(wheelset_result_t), intent(in) :: result       !! heights of the wheels
        logical, intent(in) :: wants(2)                     !! which wheels: right, left

        type(wheelset_state_t) :: state
        integer :: side

        do side = size(wants), 1, -1
            if (.not. wants(side)) cycle
            state = last_state
            if (side == side_left) state = mirrored_state(state)
            state%z = result%wheel(side)%z
            call put_wheel(writer, case, model%pair(side), state%rail(side_right), &
                           wheelset_axes(state, model%radius), side == side_left)
            call put_rail(writer, case, model%pair(side), state%rail(side_right), side == side_left)
        end do
    end subroutine put_wheelset_profiles

    ! The outline of a wheel.
    subroutine put_wheel(writer, case, pair, rail, axes, is_left)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: case
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail
        type(wheelset_axes_t), intent(in) :: axes
        logical, intent(in) :: is_left

        real(wp) :: point(3), slope
        logical :: is_there
        integer :: i

        do i = 1, size(pair%y)
            call outline_point(pair, rail, axes, pair%y(i), pair%z(i), pair%slope(i), point, &
                               slope, is_there)
            if (is_there) call put_point(writer, case, 'wheel', is_left, point(2:3), &
                                         [pair%y(i), pair%z(i)])
        end do
    end subroutine put_wheel

    subroutine put_rail(writer, case, pair, rail, is_left)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: case
        type(wheel_on_rail_t), intent(in) :: pair
        type(rail_state_t), intent(in) :: rail
        logical, intent(in) :: is_left

        real(wp) :: point(2)
        integer :: i

        do i = 0, ubound(pair%sample, 1)
            point = [pair%y_sample + i*pair%sample_step, pair%sample(i)] &
                    - [pair%y_rail, pair%z_rail]
            call put_point(writer, case, 'rail', is_left, &
                           rail_origin(pair, rail) + turned(point, rail%roll), point)
        end do
    end subroutine put_rail

    ! A point of a right pair; of a left one in a mirror.
    subroutine put_point(writer, case, body, is_left, in_track, on_profile)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: case, body
        logical, intent(in) :: is_left
        real(wp), intent(in) :: in_track(2), on_profile(2)

        real(wp) :: sign_of_side

        sign_of_side = merge(-1.0_wp, 1.0_wp, is_left)
        call put_cell(writer, case)
        call put_cell(writer, body)
        if (is_left) then
            call put_cell(writer, 'left')
        else
            call put_cell(writer, 'right')
        end if
        call put_cells(writer, [sign_of_side*in_track(1), in_track(2), sign_of_side*on_profile(1), &
                                on_profile(2)])
        call end_row(writer)
    end subroutine put_point
end module faststrip_command_wheelset_profiles
