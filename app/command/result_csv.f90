!> The columns every solved contact fills, in the same words for each subcommand.
module faststrip_command_result_csv
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, number_text
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, end_row
    use faststrip_normal_strips, only: contact_strips_t, strip_load
    use faststrip_tangential_types, only: tangential_field_t, strip_forces_t, field_power
    use faststrip_command_console, only: put_origin
    use faststrip_command_solver, only: outcome_t
    implicit none
    private

    public :: result_columns, put_result, put_strips, put_field, put_notes

    !> Names of the columns, in the order of `put_result`.
    character(len=*), parameter :: result_columns(26) = [character(len=19) :: &
        'status', 'penetration_mm', 'area_mm2', 'pmax_MPa', 'ymin_mm', 'ymax_mm', 'xmax_mm', &
        'n_patches', 'Fx_N', 'Fy_N', 'Mz_Nmm', 'friction_power_N', 'stick_fraction', &
        'normal_us', 'tangential_us', 'residual_inside', 'overlap_outside', &
        'est_err_penetration', 'est_err_pmax', 'est_err_area', 'est_err_Fx', 'est_err_Fy', &
        'est_err_Mz', 'gap_change_um', &
        'choice', 'strips_across']

contains

    !> The cells of one contact; all but the status word are empty if there is no result.
    subroutine put_result(writer, outcome, status)
        type(csv_writer_t), intent(inout) :: writer !! an open file, in the middle of a row
        type(outcome_t), intent(in) :: outcome      !! figures
        type(status_t), intent(in) :: status        !! how it ended

        integer :: i

        call put_cell(writer, trim(status_word(status%code)))
        if (is_error(status)) then
            do i = 2, size(result_columns)
                call put_cell(writer, '')
            end do
            return
        end if
        call put_cell(writer, outcome%normal%penetration)
        call put_cell(writer, outcome%normal%area)
        call put_cell(writer, outcome%normal%pmax)
        call put_cell(writer, outcome%normal%y_min)
        call put_cell(writer, outcome%normal%y_max)
        call put_cell(writer, outcome%normal%x_max)
        call put_cell(writer, outcome%normal%n_patches)
        associate (tangential => outcome%tangential)
            call put_cell(writer, tangential%fx, is_known=outcome%has_forces)
            call put_cell(writer, tangential%fy, is_known=outcome%has_forces)
            call put_cell(writer, tangential%mz, is_known=outcome%has_forces)
            call put_cell(writer, tangential%friction_power, is_known=outcome%has_forces)
            call put_cell(writer, tangential%stick_fraction, is_known=outcome%knows_stick)
        end associate
        call put_cell(writer, outcome%normal_us)
        call put_cell(writer, outcome%tangential_us)
        associate (certificate => outcome%certificate)
            call put_cell(writer, certificate%residual_inside, is_known=outcome%is_certified)
            call put_cell(writer, certificate%overlap_outside, is_known=outcome%is_certified)
            call put_cell(writer, certificate%est_err_penetration, is_known=outcome%is_estimated)
            call put_cell(writer, certificate%est_err_pmax, is_known=outcome%is_estimated)
            call put_cell(writer, certificate%est_err_area, is_known=outcome%is_estimated)
        end associate
        associate (errors => outcome%force_errors)
            call put_cell(writer, errors%fx, is_known=outcome%forces_are_estimated)
            call put_cell(writer, errors%fy, is_known=outcome%forces_are_estimated)
            call put_cell(writer, errors%mz, is_known=outcome%forces_are_estimated)
        end associate
        call put_cell(writer, outcome%gap_change_um, is_known=outcome%gap_change_um > 0.0_wp)
        call put_cell(writer, outcome%choice)
        if (outcome%normal%strips_across > 0) then
            call put_cell(writer, outcome%normal%strips_across)
        else
            call put_cell(writer, '')
        end if
    end subroutine put_result

    !> The comment lines on columns: what the friction power is, and that gaps are smoothed, if
    !> they are.
    subroutine put_notes(writer, smoothing_um)
        type(csv_writer_t), intent(inout) :: writer !! an open file, before its header
        real(wp), intent(in) :: smoothing_um        !! noise that was stated, um; 0: none

        call put_comment(writer, 'friction_power_N is the frictional work per distance rolled, ' &
                         // 'T gamma')
        if (smoothing_um <= 0.0_wp) return
        call put_comment(writer, 'gap smoothed for a noise of ' // trim(number_text(smoothing_um)) &
                         // ' um, rms; gap_change_um is by how much it changed, rms')
    end subroutine put_notes

    !> The strips of a contact, one row a strip.
    subroutine put_strips(writer, case_name, strips, forces)
        type(csv_writer_t), intent(inout) :: writer  !! an open file
        character(len=*), intent(in) :: case_name    !! for the column `case`
        type(contact_strips_t), intent(in) :: strips !! mm, MPa
        type(strip_forces_t), intent(in) :: forces   !! N; empty if the method has none

        integer :: k, j

        call put_origin(writer)
        call put_header(writer, [character(len=16) :: 'case', 'patch', 'strip', 'y_left_mm', &
                                 'y_right_mm', 'y_mm', 'half_length_mm', 'p0_MPa', 'load_N', &
                                 'Fx_N', 'Fy_N', 'friction_power_N'])
        do k = 1, strips%n
            associate (left => strips%y_left(k), right => strips%y_right(k), &
                       length => strips%half_length(k), p0 => strips%p0(k))
                call put_cell(writer, case_name)
                call put_cell(writer, strips%patch(k))
                call put_cell(writer, k)
                call put_cell(writer, left)
                call put_cell(writer, right)
                call put_cell(writer, 0.5_wp*(left + right))
                call put_cell(writer, length)
                call put_cell(writer, p0)
                call put_cell(writer, strip_load(p0, length, right - left))
                if (forces%n == strips%n) then
                    call put_cell(writer, forces%fx(k))
                    call put_cell(writer, forces%fy(k))
                    call put_cell(writer, forces%friction_power(k))
                else
                    do j = 1, 3
                        call put_cell(writer, '')
                    end do
                end if
                call end_row(writer)
            end associate
        end do
    end subroutine put_strips

    !> The elements of a contact, one row an element.
    subroutine put_field(writer, case_name, field)
        type(csv_writer_t), intent(inout) :: writer   !! an open file
        character(len=*), intent(in) :: case_name     !! for the column `case`
        type(tangential_field_t), intent(in) :: field !! mm, MPa

        integer :: i

        call put_origin(writer)
        call put_header(writer, [character(len=9) :: 'case', 'x_mm', 'y_mm', 'area_mm2', 'state', &
                                 'pn_MPa', 'px_MPa', 'py_MPa', 'sx', 'sy', 'power_MPa'])
        do i = 1, field%n
            call put_cell(writer, case_name)
            call put_cell(writer, field%x(i))
            call put_cell(writer, field%y(i))
            call put_cell(writer, field%area(i))
            call put_cell(writer, field%state(i))
            call put_cell(writer, field%pn(i))
            call put_cell(writer, field%px(i))
            call put_cell(writer, field%py(i))
            call put_cell(writer, field%sx(i))
            call put_cell(writer, field%sy(i))
            call put_cell(writer, field_power(field, i))
            call end_row(writer)
        end do
    end subroutine put_field
end module faststrip_command_result_csv
