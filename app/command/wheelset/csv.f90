!> The table of a wheelset's contacts.
module faststrip_command_wheelset_csv
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, limitation_words
    use faststrip_contact_figures, only: figure_area, figure_est_err_area, figure_est_err_fx, &
                                         figure_est_err_fy, figure_est_err_mz, &
                                         figure_est_err_penetration, figure_est_err_pmax, &
                                         figure_friction_power, figure_fx, figure_fy, figure_load, &
                                         figure_mz, figure_n_patches, figure_penetration, &
                                         figure_pmax, figure_stick_fraction, figure_strips_across, &
                                         figure_t_gamma, figure_t_gamma_per_area, figure_x_max, &
                                         figure_y_max, figure_y_min, figures, n_figures
    use faststrip_contact_figure_values, only: find_figures
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_tangential_types, only: tangential_field_t
    use faststrip_wheelset_strips, only: wheel_strips_t
    use faststrip_wheelset_types, only: wheel_result_t, wheel_contact_t
    use faststrip_command_program_console, only: put_origin, tell_held
    use faststrip_command_rows_result_csv, only: put_figures, wear_figures, put_wear_source, &
                                                 put_budget_note, put_strip, strip_columns, &
                                                 put_element, element_columns
    use faststrip_command_settings_methods, only: settings_t
    use faststrip_command_rows_wear_figures, only: strip_wear_t, make_strip_wear
    use faststrip_tangential_wear_law, only: wear_law_t
    implicit none
    private

    public :: put_wheelset_header, put_wheel, put_failed_state
    public :: put_strips_header, put_wheel_strips, put_fields_header, put_wheel_field

    ! Figures in the order of their columns: behind the creepages, and at the end.
    integer, parameter :: first_figures(7) = [ &
        figure_load, figure_fx, figure_fy, figure_mz, figure_penetration, figure_pmax, figure_area]
    integer, parameter :: last_figures(13) = [ &
        figure_friction_power, figure_stick_fraction, figure_y_min, figure_y_max, figure_x_max, &
        figure_n_patches, figure_strips_across, figure_est_err_penetration, figure_est_err_pmax, &
        figure_est_err_area, figure_est_err_fx, figure_est_err_fy, figure_est_err_mz]

    ! In the order of `put_contact`. A wheel's lateral force bears a name of its own.
    character(len=*), parameter :: names(49) = [character(len=26) :: &
        'case', 'side', 'contact', 'status', 'x_track_mm', 'y_track_mm', 'z_track_mm', &
        'contact_angle_rad', 'cksi', 'ceta', 'cphi_rad_per_mm', figures(first_figures(:2))%column, &
        'Fs_N', figures(first_figures(4:))%column, 'Fx_track_N', 'Fy_track_N', 'Fz_track_N', &
        'z_mm', 'roll_rad', 'y_rail_mm', 'z_rail_mm', 'x_wheel_mm', 'y_wheel_mm', 'z_wheel_mm', &
        'radius_mm', 'rolling_speed_mm_s', 'Fx_wheelset_N', 'Fy_wheelset_N', 'Fz_wheelset_N', &
        figures(last_figures)%column, 'est_err_load', 'message', 'limitations']

    ! Which solution it is, and where.
    character(len=*), parameter :: solution_columns(3) = [character(len=16) :: &
        'solution', 'y_mm', 'pitch_rate_rad_s']

contains

    !> Names of the columns.
    subroutine put_wheelset_header(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        class(settings_t), intent(in) :: case       !! wear law, for its source

        call put_origin(writer)
        call put_comment(writer, 't_gamma_N is |Fx cksi| + |Fs ceta|; t_gamma_spin_N adds ' &
                         // '|Mz cphi|')
        call put_wear_source(writer, case)
        call put_budget_note(writer, case)
        call tell_held(writer)
        call put_header(writer, [character(len=len(names)) :: names, &
                                 figures(wear_figures)%column, solution_columns])
    end subroutine put_wheelset_header

    !> One row a contact of a wheel; a wheel in the air has one row with contact 0.
    subroutine put_wheel(writer, case, side, wheel, has_forces, solution, motion)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: case        !! name of the state
        character(len=*), intent(in) :: side        !! left or right
        type(wheel_result_t), intent(in) :: wheel   !! solved
        logical, intent(in) :: has_forces           !! were creep forces asked for?
        integer, intent(in) :: solution             !! 1: of the state; 2, 3: to its left, right
        real(wp), intent(in) :: motion(2)           !! y of the wheelset, mm, its pitch rate, rad/s

        integer :: i

        do i = 1, wheel%n
            call put_cell(writer, case)
            call put_cell(writer, side)
            call put_cell(writer, i)
            call put_contact(writer, wheel, wheel%contact(i), has_forces)
            call put_cell(writer, solution)
            call put_cells(writer, motion)
            call end_row(writer)
        end do
        if (wheel%n > 0) return
        call put_empty(writer, case, side, 'ok', 'no contact')
        call put_cell(writer, solution)
        call put_cells(writer, motion)
        call end_row(writer)
    end subroutine put_wheel

    !> The row of a state that has no solution.
    subroutine put_failed_state(writer, case, side, status)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: case        !! name of the state
        character(len=*), intent(in) :: side        !! as it was given
        type(status_t), intent(in) :: status        !! why there is none

        call put_empty(writer, case, side, trim(status_word(status%code)), trim(status%message))
        call put_empty_cells(writer, size(solution_columns))
        call end_row(writer)
    end subroutine put_failed_state

    subroutine put_empty(writer, case, side, word, message)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: case, side, word, message

        call put_cell(writer, case)
        call put_cell(writer, side)
        call put_cell(writer, 0)
        call put_cell(writer, word)
        call put_empty_cells(writer, size(names) - 6) ! Given: behind four, before the last two
        call put_cell(writer, message)
        call put_empty_cells(writer, 1 + size(wear_figures))
    end subroutine put_empty

    subroutine put_contact(writer, wheel, contact, has_forces)
        type(csv_writer_t), intent(inout) :: writer
        type(wheel_result_t), intent(in) :: wheel
        type(wheel_contact_t), intent(in) :: contact
        logical, intent(in) :: has_forces

        real(wp) :: values(n_figures)
        logical :: known(n_figures)

        call find_figures(contact%figures, values, known)
        ! Forces that were not asked for are zeros here, as those of the wheel.
        known(:figure_strips_across) = .true.
        known(figure_t_gamma:figure_t_gamma_per_area) = has_forces
        call put_cell(writer, trim(status_word(contact%status%code)))
        call put_cells(writer, contact%place)
        call put_cell(writer, contact%angle)
        call put_cells(writer, [contact%creepage%cksi, contact%creepage%ceta, &
                                  contact%creepage%cphi])
        call put_figures(writer, first_figures, values, known)
        call put_cells(writer, contact%force)
        call put_cells(writer, [wheel%z, wheel%roll])
        call put_cells(writer, contact%rail)
        call put_cells(writer, contact%wheel)
        call put_cells(writer, [contact%radius, contact%speed])
        call put_cells(writer, contact%force_wheelset)
        call put_figures(writer, last_figures, values, known)
        call put_cell(writer, contact%est_err_load)
        if (contact%status%code == 0 .or. is_error(contact%status)) then
            call put_cell(writer, '')
        else
            call put_cell(writer, trim(contact%status%message))
        end if
        call put_cell(writer, trim(limitation_words(contact%status%limitations)))
        call put_figures(writer, wear_figures, values, known)
    end subroutine put_contact

    !> Names of the columns of strips: those of `contact`, and the places.
    subroutine put_strips_header(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        class(settings_t), intent(in) :: case       !! wear law, for its source

        call put_origin(writer)
        call put_wear_source(writer, case)
        call put_header(writer, [character(len=len(strip_columns)) :: 'case', 'side', 'contact', &
                                 strip_columns, 'y_rail_mm', 'z_rail_mm', 'y_wheel_mm', &
                                 'z_wheel_mm'])
    end subroutine put_strips_header

    !> One row a strip of a contact.
    subroutine put_wheel_strips(writer, case, side, i, radius, found, law)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        character(len=*), intent(in) :: case        !! name of the state
        character(len=*), intent(in) :: side        !! left or right
        integer, intent(in) :: i                    !! contact of the wheel
        real(wp), intent(in) :: radius              !! rolling radius, mm
        type(wheel_strips_t), intent(in) :: found   !! of the contact
        type(wear_law_t), intent(in) :: law         !! or none

        type(strip_wear_t) :: wear
        integer :: k

        call make_strip_wear(law, found%strips, found%forces, radius, wear)
        do k = 1, found%strips%n
            call put_cell(writer, case)
            call put_cell(writer, side)
            call put_cell(writer, i)
            call put_strip(writer, found%strips, found%forces, wear, k)
            call put_cells(writer, found%rail(:, k))
            call put_cells(writer, found%wheel(:, k))
            call end_row(writer)
        end do
    end subroutine put_wheel_strips

    !> Names of the columns of elements: those of `contact`.
    subroutine put_fields_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_origin(writer)
        call put_header(writer, [character(len=len(element_columns)) :: 'case', 'side', &
                                 'contact', element_columns])
    end subroutine put_fields_header

    !> One row an element of a contact.
    subroutine put_wheel_field(writer, case, side, i, field)
        type(csv_writer_t), intent(inout) :: writer   !! an open file
        character(len=*), intent(in) :: case          !! name of the state
        character(len=*), intent(in) :: side          !! left or right
        integer, intent(in) :: i                      !! contact of the wheel
        type(tangential_field_t), intent(in) :: field !! of the contact

        integer :: k

        do k = 1, field%n
            call put_cell(writer, case)
            call put_cell(writer, side)
            call put_cell(writer, i)
            call put_element(writer, field, k)
            call end_row(writer)
        end do
    end subroutine put_wheel_field
end module faststrip_command_wheelset_csv
