!> The rows of `contact` and `sweep`: what was solved, by which methods, with what result.
module faststrip_command_rows_sweep_csv
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_csv, only: csv_writer_t, put_comment, put_header, put_cell, &
                                   end_row
    use faststrip_command_program_console, only: put_origin, note, tell_held
    use faststrip_command_settings_case_file, only: case_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_contact_methods, only: normal_method_name, tangential_method_name
    use faststrip_contact_wanted, only: auto_steps_t
    use faststrip_command_contact_prepared_case, only: prepared_case_t
    use faststrip_command_rows_result_csv, only: result_columns, put_result, put_notes
    implicit none
    private

    public :: put_sweep_header, put_sweep_row

    character(len=*), parameter :: case_columns(9) = [character(len=len(result_columns)) :: &
        'case', 'yw_mm', 'normal', 'tangential', 'N_N', 'gamma_rad', 'cksi', 'ceta', &
        'cphi_rad_per_mm']

contains

    !> Comments and column names.
    subroutine put_sweep_header(writer, case)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(case_t), intent(in) :: case            !! what is solved

        call put_origin(writer)
        call put_comment(writer, 'case ' // case%name)
        if (len(case%gap_file) > 0) then
            call put_comment(writer, 'gap ' // case%gap_file)
        else
            call put_comment(writer, 'wheel ' // case%bodies%wheel%name // ', rail ' &
                             // case%bodies%rail%name)
            call tell(case%bodies%wheel%words)
            call tell(case%bodies%rail%words)
        end if
        call put_notes(writer, case)
        call tell_held(writer)
        call put_header(writer, [case_columns, result_columns])

    contains

        !> What was noticed of a profile, to the reader of the CSV and to who sits there.
        subroutine tell(words)
            character(len=*), intent(in) :: words

            if (len(words) == 0) return
            call put_comment(writer, words)
            call note(words)
        end subroutine tell
    end subroutine put_sweep_header

    !> One contact by one choice of methods.
    subroutine put_sweep_row(writer, case, prepared, result, steps, status)
        type(csv_writer_t), intent(inout) :: writer !! an open file
        type(case_t), intent(in) :: case            !! its name is used
        type(prepared_case_t), intent(in) :: prepared !! shift, load, creepages, methods
        type(contact_result_t), intent(in) :: result !! figures
        type(auto_steps_t), intent(in) :: steps     !! of auto
        type(status_t), intent(in) :: status        !! how it ended

        logical :: given(2)

        given = prepared%given%is_given
        call put_cell(writer, case%name)
        call put_cell(writer, prepared%shift)
        call put_cell(writer, trim(normal_method_name(prepared%methods%normal)))
        call put_cell(writer, trim(tangential_method_name(prepared%methods%tangential)))
        call put_cell(writer, merge(prepared%load, result%normal%load, prepared%by_load), &
                      is_known=prepared%by_load .or. .not. is_error(status))
        call put_cell(writer, prepared%rigid_contact%gamma, is_known=len(case%gap_file) == 0)
        associate (c => prepared%creepage, found => result%creepage)
            call put_cell(writer, merge(found%cksi, c%cksi, given(1)), &
                          is_known=.not. (given(1) .and. is_error(status)))
            call put_cell(writer, merge(found%ceta, c%ceta, given(2)), &
                          is_known=.not. (given(2) .and. is_error(status)))
            call put_cell(writer, c%cphi)
        end associate
        call put_result(writer, result, steps, status)
        call end_row(writer)
    end subroutine put_sweep_row
end module faststrip_command_rows_sweep_csv
