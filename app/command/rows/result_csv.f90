!> The columns every solved contact fills, in the same words for each subcommand.
module faststrip_command_rows_result_csv
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, limitation_words, number_text
    use faststrip_contact_figures, only: figure_area, figure_est_err_area, figure_est_err_ceta, &
                                         figure_est_err_cksi, figure_est_err_fx, &
                                         figure_est_err_fy, figure_est_err_mz, &
                                         figure_est_err_penetration, figure_est_err_pmax, &
                                         figure_est_err_von_mises, &
                                         figure_fatigue_index, figure_flash_temperature, &
                                         figure_friction_power, figure_fx, &
                                         figure_fy, figure_gap_change, figure_mz, &
                                         figure_n_patches, figure_normal_us, &
                                         figure_overlap_outside, figure_penetration, figure_pmax, &
                                         figure_residual_inside, figure_stick_fraction, &
                                         figure_strips_across, figure_t_gamma, &
                                         figure_t_gamma_per_area, figure_t_gamma_spin, &
                                         figure_tangential_us, figure_temperature_max, &
                                         figure_temperature_x, figure_temperature_y, &
                                         figure_von_mises_max, &
                                         figure_von_mises_x, figure_von_mises_y, &
                                         figure_von_mises_z, figure_wear_mass, &
                                         figure_wear_volume, figure_x_max, figure_y_max, &
                                         figure_y_min, figures, n_figures
    use faststrip_contact_figure_values, only: find_figures
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_methods, only: normal_auto
    use faststrip_contact_wanted, only: auto_steps_t
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, put_cells, &
                                   put_empty_cells, end_row
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    use faststrip_tangential_types, only: tangential_field_t, strip_forces_t, field_power
    use faststrip_command_program_console, only: note, put_origin
    use faststrip_command_rows_auto_words, only: words_of_steps
    use faststrip_command_settings_methods, only: settings_t
    use faststrip_command_rows_wear_figures, only: strip_wear_t, make_strip_wear
    implicit none
    private

    public :: result_columns, put_result, put_strips, put_field, put_notes, note_wear, no_wear
    public :: wear_figures, put_figures, put_wear_source, put_budget_note, strip_columns, put_strip
    public :: element_columns, put_element

    !> Names of the columns of an element, in the order of `put_element`.
    character(len=*), parameter :: element_columns(*) = [character(len=15) :: &
        'x_mm', 'y_mm', 'area_mm2', 'state', 'pn_MPa', 'px_MPa', 'py_MPa', 'sx', 'sy', &
        'power_MPa', 'surface_wheel_C', 'surface_rail_C']

    !> Begins what is said where there is no wear in spite of a law.
    character(len=*), parameter :: no_wear = 'no wear: '

    !> Figures in the order of their columns: of the pressures and forces, times, errors; of what
    !> friction does to the surfaces; of stresses.
    integer, parameter :: main_figures(*) = [ &
        figure_penetration, figure_area, figure_pmax, figure_y_min, figure_y_max, figure_x_max, &
        figure_n_patches, figure_fx, figure_fy, figure_mz, figure_friction_power, &
        figure_stick_fraction, figure_normal_us, figure_tangential_us, figure_residual_inside, &
        figure_overlap_outside, figure_est_err_penetration, figure_est_err_pmax, &
        figure_est_err_area, figure_est_err_fx, figure_est_err_fy, figure_est_err_mz, &
        figure_est_err_cksi, figure_est_err_ceta, figure_gap_change]
    integer, parameter :: wear_figures(*) = [ &
        figure_t_gamma, figure_t_gamma_spin, figure_t_gamma_per_area, figure_fatigue_index, &
        figure_wear_mass, figure_wear_volume, figure_flash_temperature, figure_temperature_max, &
        figure_temperature_x, figure_temperature_y]

    integer, parameter :: stress_figures(*) = [ &
        figure_von_mises_max, figure_von_mises_x, figure_von_mises_y, figure_von_mises_z, &
        figure_est_err_von_mises]

    !> Names of a strip's columns, in the order of `put_strip`.
    character(len=*), parameter :: strip_columns(*) = [character(len=26) :: &
        'patch', 'strip', 'y_left_mm', 'y_right_mm', 'y_mm', 'half_length_mm', 'p0_MPa', &
        'load_N', 'Fx_N', 'Fy_N', 'friction_power_N', 't_gamma_per_area_N_per_mm2', &
        'wear_ug_per_m', 'wear_depth_mm_per_pass', 'wear_depth_mm_per_km']

    !> Names of the columns, in the order of `put_result`.
    character(len=*), parameter :: result_columns(*) = [character(len=26) :: &
        'status', figures(main_figures)%column, 'choice', figures(figure_strips_across)%column, &
        'limitations', figures(wear_figures)%column, figures(stress_figures)%column]

contains

    !> The cells of one contact; all but the status word are empty if there is no result.
    subroutine put_result(writer, result, steps, status, tells_times)
        type(csv_writer_t), intent(inout) :: writer !! an open file, in the middle of a row
        type(contact_result_t), intent(in) :: result !! figures
        type(auto_steps_t), intent(in) :: steps     !! of auto
        type(status_t), intent(in) :: status        !! how it ended
        logical, intent(in), optional :: tells_times !! else the cells of times are empty; default
                                                    !! true

        character(len=:), allocatable :: choice
        real(wp) :: values(n_figures)
        logical :: known(n_figures), with_times

        with_times = .true.
        if (present(tells_times)) with_times = tells_times
        call put_cell(writer, trim(status_word(status%code)))
        if (is_error(status)) then
            call put_empty_cells(writer, size(result_columns) - 1)
            return
        end if
        call find_figures(result, values, known)
        known([figure_normal_us, figure_tangential_us]) = with_times
        call put_figures(writer, main_figures, values, known)
        call words_of_steps(steps, with_times, choice)
        call put_cell(writer, choice)
        call put_figures(writer, [figure_strips_across], values, known)
        call put_cell(writer, trim(limitation_words(status%limitations)))
        call put_figures(writer, wear_figures, values, known)
        call put_figures(writer, stress_figures, values, known)
    end subroutine put_result

    !> The cells of some figures; of what is not known they are empty.
    subroutine put_figures(writer, which, values, known)
        type(csv_writer_t), intent(inout) :: writer !! an open file, in the middle of a row
        integer, intent(in) :: which(:)             !! figures, in the order of the columns
        real(wp), intent(in) :: values(n_figures)   !! of `find_figures`
        logical, intent(in) :: known(n_figures)     !! the same

        integer :: i

        do i = 1, size(which)
            associate (value => values(which(i)), is_known => known(which(i)))
                if (figures(which(i))%counts .and. is_known) then
                    call put_cell(writer, nint(value))
                else
                    call put_cell(writer, value, is_known=is_known)
                end if
            end associate
        end do
    end subroutine put_figures

    !> The comment lines on columns: what the friction power and T gamma are, where a wear law is
    !> from, and that gaps are smoothed, if they are.
    subroutine put_notes(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file, before its header
        class(settings_t), intent(in) :: case       !! smoothing, wear, a budget

        call put_comment(writer, 'friction_power_N is the frictional work per distance rolled, ' &
                         // 'T gamma')
        call put_comment(writer, 't_gamma_N is |Fx cksi| + |Fy ceta|; t_gamma_spin_N adds ' &
                         // '|Mz cphi|')
        call put_wear_source(writer, case)
        call put_budget_note(writer, case)
        if (case%smoothing <= 0.0_wp) return
        ! Given: um.
        call put_comment(writer, 'gap smoothed for a noise of ' &
                         // trim(number_text(1.0e3_wp*case%smoothing)) &
                         // ' um, rms; gap_change_um is by how much it changed, rms')
    end subroutine put_notes

    !> A comment line where time decides what is solved.
    subroutine put_budget_note(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file, before its header
        class(settings_t), intent(in) :: case       !! with a budget, or without

        if (case%methods%normal == normal_auto .and. case%wanted%budget_us > 0.0_wp) &
            call put_comment(writer, 'within a budget of time, which another run may spend ' &
                             // 'otherwise: its bytes may differ')
    end subroutine put_budget_note

    !> Say on stderr why there is no wear, where a law was given and does not go as far.
    subroutine note_wear(wear_status, place)
        type(status_t), intent(in) :: wear_status !! of the workspace
        character(len=*), intent(in) :: place  !! which one it is, with what parts it; or empty

        if (is_error(wear_status)) call note(place // no_wear // trim(wear_status%message))
    end subroutine note_wear

    !> Where a wear law is from, and whose wear it is, if there is one.
    subroutine put_wear_source(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file, before its header
        class(settings_t), intent(in) :: case       !! law, or none

        if (case%wear_law%n == 0) return
        if (case%wear_law%of_wheel) then
            call put_comment(writer, 'wear of the wheel by ' // case%wear_file)
        else
            call put_comment(writer, 'wear of the rail by ' // case%wear_file)
        end if
        call put_comment(writer, 'its source: ' // case%wear_source)
    end subroutine put_wear_source

    !> The strips of a contact, one row a strip.
    subroutine put_strips(writer, case_name, strips, forces, case, radius)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        character(len=*), intent(in) :: case_name    !! for the column `case`
        type(contact_strips_t), intent(in) :: strips !! mm, MPa
        type(strip_forces_t), intent(in) :: forces   !! N; empty if the method has none
        class(settings_t), intent(in) :: case        !! wear law
        real(wp), intent(in) :: radius               !! rolling radius, mm; 0: not known

        type(strip_wear_t) :: wear
        integer :: k

        call make_strip_wear(case%wear_law, strips, forces, radius, wear)
        call put_origin(writer)
        call put_wear_source(writer, case)
        call put_header(writer, [character(len=len(strip_columns)) :: 'case', strip_columns])
        do k = 1, strips%n
            call put_cell(writer, case_name)
            call put_strip(writer, strips, forces, wear, k)
            call end_row(writer)
        end do
    end subroutine put_strips

    !> The cells of one strip.
    subroutine put_strip(writer, strips, forces, wear, k)
        type(csv_writer_t), intent(inout) :: writer  !! an open file, in the middle of a row
        type(contact_strips_t), intent(in) :: strips !! mm, MPa
        type(strip_forces_t), intent(in) :: forces   !! N; empty if the method has none
        type(strip_wear_t), intent(in) :: wear       !! of the strips
        integer, intent(in) :: k                     !! which one

        associate (left => strips%y_left(k), right => strips%y_right(k), &
                   length => strips%half_length(k), p0 => strips%p0(k))
            call put_cells(writer, [strips%patch(k), k])
            call put_cells(writer, [left, right, 0.5_wp*(left + right), length, p0, &
                                    strip_load(p0, length, right - left)])
        end associate
        if (forces%n == strips%n) then
            call put_cells(writer, [forces%fx(k), forces%fy(k), forces%friction_power(k)])
        else
            call put_empty_cells(writer, 3)
        end if
        call put_known(writer, wear%t_gamma_per_area, k)
        call put_known(writer, wear%mass, k)
        call put_known(writer, wear%pass_depth, k)
        call put_known(writer, wear%depth_per_km, k)
    end subroutine put_strip

    ! One of some numbers, or an empty cell where there are none.
    subroutine put_known(writer, numbers, k)
        type(csv_writer_t), intent(inout) :: writer
        real(wp), allocatable, intent(in) :: numbers(:)
        integer, intent(in) :: k

        if (allocated(numbers)) then
            call put_cell(writer, numbers(k))
        else
            call put_cell(writer, '')
        end if
    end subroutine put_known

    !> Write the elements of a contact.
    subroutine put_field(writer, case_name, field)
        type(csv_writer_t), intent(inout) :: writer   !! an open file
        character(len=*), intent(in) :: case_name     !! for the column `case`
        type(tangential_field_t), intent(in) :: field !! mm, MPa

        integer :: i

        call put_origin(writer)
        call put_header(writer, [character(len=len(element_columns)) :: 'case', element_columns])
        do i = 1, field%n
            call put_cell(writer, case_name)
            call put_element(writer, field, i)
            call end_row(writer)
        end do
    end subroutine put_field

    !> The cells of an element, in the order of `element_columns`.
    subroutine put_element(writer, field, i)
        type(csv_writer_t), intent(inout) :: writer   !! an open file
        type(tangential_field_t), intent(in) :: field !! mm, MPa
        integer, intent(in) :: i                      !! one of its elements

        call put_cells(writer, [field%x(i), field%y(i), field%area(i)])
        call put_cell(writer, field%state(i))
        call put_cells(writer, [field%pn(i), field%px(i), field%py(i), field%sx(i), field%sy(i), &
                                field_power(field, i)])
        if (field%has_temperature) then
            ! Where they touch both have one temperature.
            call put_cells(writer, spread(field%temperature(i), 1, 2))
        else
            call put_empty_cells(writer, 2)
        end if
    end subroutine put_element
end module faststrip_command_rows_result_csv
