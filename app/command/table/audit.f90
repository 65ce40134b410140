!> The audit of a coefficient table: from a CSV file, or the published one.
module faststrip_command_table_audit
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: integer_text, set_place_status
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, column_index, read_cell, &
                                  put_header, put_comment, put_cell, end_row, put_cells, &
                                  put_empty_cells
    use faststrip_tables_polynomials, only: basis_monomial, basis_chebyshev
    use faststrip_influence_polynomial, only: table_last_distance
    use faststrip_tables_refit, only: table_row_t, check_row, fit_lsq, fit_author, most_degree
    use faststrip_tables_audit, only: audit_t, audit_row
    use faststrip_command_program_console, only: fail_on_error, fail, note, say, progress, &
                                                 exit_bad_input, begin_table, end_table
    use faststrip_command_table_curves, only: published_row
    use faststrip_command_table_files, only: basis_word, quantity_word, fit_word
    implicit none
    private

    public :: write_audit

    !> A table that was read, and where each row came from.
    type :: source_t
        type(table_row_t), allocatable :: rows(:)
        integer, allocatable :: line(:)           !! of the file; 0: built in
        character(len=:), allocatable :: name
        logical :: published_layout = .false.
    end type source_t

contains

    !> Audit a table: CSV to a file and summary to stdout, or CSV to stdout and summary to stderr.
    !> The fresh fit is the author's for the layout of the paper, least squares otherwise.
    subroutine write_audit(file, fit, path)
        character(len=*), intent(in) :: file !! CSV file; empty: the published table
        integer, intent(in) :: fit           !! kind of the fresh fit; 0: the default
        character(len=*), intent(in) :: path !! CSV output, - for stdout

        type(source_t) :: source
        type(audit_t), allocatable :: audits(:)
        type(status_t) :: status
        integer :: i, used_fit

        call read_source(file, source)
        used_fit = fit
        if (fit == 0) used_fit = merge(fit_author, fit_lsq, source%published_layout)
        allocate (audits(size(source%rows)))
        do i = 1, size(source%rows)
            call audit_row(source%rows(i), used_fit, audits(i), status)
            call fail_at(status, source, i)
            call progress('row', i, size(source%rows))
        end do
        call write_findings(path, source%name, used_fit, audits)
        call summarise(path == '-', source%name, used_fit, audits)
    end subroutine write_audit

    subroutine fail_at(status, source, i)
        type(status_t), intent(in) :: status
        type(source_t), intent(in) :: source
        integer, intent(in) :: i

        if (.not. is_error(status)) return
        if (source%line(i) > 0) then
            call fail(exit_bad_input, trim(status%message) // ' (' // source%name // ':' &
                      // integer_text(source%line(i)) // ')')
        end if
        call fail_on_error(status)
    end subroutine fail_at

    subroutine read_source(file, source)
        character(len=*), intent(in) :: file
        type(source_t), intent(out) :: source

        type(csv_table_t) :: table
        type(status_t) :: status
        integer :: n, i

        if (len(file) == 0) then
            source%name = 'Table 1 as published'
            source%rows = [(published_row(n), n=0, table_last_distance)]
            allocate (source%line(table_last_distance + 1), source=0)
            source%published_layout = .true.
            return
        end if
        call read_csv(file, table, status)
        call fail_on_error(status)
        source%name = file
        source%line = table%line
        source%published_layout = column_index(table, 'index') > 0
        if (table%n_rows == 0) call fail(exit_bad_input, 'no rows (' // file // ')')
        allocate (source%rows(table%n_rows))
        do i = 1, table%n_rows
            if (source%published_layout) then
                call take_published_row(table, i, source%rows(i), status)
            else
                call take_row(table, i, source%rows(i), status)
            end if
            call fail_on_error(status)
            call check_row(source%rows(i), status)
            call fail_at(status, source, i)
        end do
    end subroutine read_source

    ! Columns index, a0 and so on up to the last there is.
    subroutine take_published_row(table, i, row, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: i
        type(table_row_t), intent(out) :: row
        type(status_t), intent(out) :: status

        integer :: at, index

        call clear_status(status)
        index = 0
        call read_cell(table, i, 'index', index, status)
        if (is_error(status)) return
        if (modulo(index, 2) /= 0) then
            call set_place_status(status, st_file_format, 'the index must be even, twice the ' // &
                                  'strip distance', integer_text(index), table%file, &
                                  table%line(i))
            return
        end if
        row%n = index/2
        do while (column_index(table, 'a' // integer_text(row%degree + 1)) > 0)
            row%degree = row%degree + 1
        end do
        if (row%degree > most_degree) then
            call set_place_status(status, st_file_format, 'the degree must be at most ' // &
                                  integer_text(most_degree), &
                                  integer_text(row%degree), table%file, table%line(i))
            return
        end if
        do at = 0, row%degree
            call read_cell(table, i, 'a' // integer_text(at), row%c(at), status)
        end do
    end subroutine take_published_row

    ! Columns n, L_min, L_max, quantity, basis, degree, c0 and so on.
    subroutine take_row(table, i, row, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: i
        type(table_row_t), intent(out) :: row
        type(status_t), intent(out) :: status

        integer :: k

        call clear_status(status)
        call read_cell(table, i, 'n', row%n, status)
        call read_cell(table, i, 'L_min', row%l_min, status)
        call read_cell(table, i, 'L_max', row%l_max, status)
        call read_word(table, i, 'quantity', 'half', 'full', k, status)
        row%half = k == 1
        call read_word(table, i, 'basis', 'monomial', 'chebyshev', k, status)
        row%basis = merge(basis_monomial, basis_chebyshev, k == 1)
        call read_cell(table, i, 'degree', row%degree, status)
        if (is_error(status)) return
        if (row%degree < 0 .or. row%degree > most_degree) then
            call set_place_status(status, st_file_format, 'the degree must be 0 to ' // &
                                  integer_text(most_degree), integer_text(row%degree), &
                                  table%file, table%line(i))
            return
        end if
        do k = 0, row%degree
            call read_cell(table, i, 'c' // integer_text(k), row%c(k), status)
        end do
    end subroutine take_row

    ! One of two words: 1 or 2.
    subroutine read_word(table, i, name, first, second, which, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: i
        character(len=*), intent(in) :: name, first, second
        integer, intent(out) :: which
        type(status_t), intent(inout) :: status

        character(len=:), allocatable :: word

        which = 0
        call read_cell(table, i, name, word, status)
        if (is_error(status)) return
        if (word == first) which = 1
        if (word == second) which = 2
        if (which == 0) call set_place_status(status, st_file_format, 'column ' // name // &
            ' must be ' // first // ' or ' // second, "'" // word // "'", table%file, &
            table%line(i))
    end subroutine read_word

    subroutine write_findings(path, name, fit, audits)
        character(len=*), intent(in) :: path, name
        integer, intent(in) :: fit
        type(audit_t), intent(in) :: audits(:)

        type(csv_writer_t) :: writer
        integer :: i

        call begin_table(writer, path)
        call put_comment(writer, 'audit of ' // name // '; residual: E of the row less E of the ' &
                         // 'fresh fit')
        call put_header(writer, [character(len=17) :: 'n', 'L_min', 'L_max', 'quantity', 'basis', &
            'degree', 'max_rel_err', 'max_at_b', 'rms_rel_err', 'fit', 'fit_max_rel_err', &
            'fit_rms_rel_err', 'condition', 'residual_max', 'residual_rms', 'max_c_difference', &
            'suspect', 'value', 'change', 'share', 'corrected_max', 'misprint', &
            'rel_err_below', 'rel_err_above'])
        do i = 1, size(audits)
            associate (audit => audits(i), row => audits(i)%row)
                call put_cell(writer, row%n)
                call put_cells(writer, [row%l_min, row%l_max])
                call put_cell(writer, quantity_word(row%half))
                call put_cell(writer, basis_word(row%basis))
                call put_cell(writer, row%degree)
                call put_cell(writer, row%max_rel_err)
                call put_cell(writer, 10.0_wp**row%max_at) ! Given: a decimal logarithm
                call put_cell(writer, row%rms_rel_err)
                call put_cell(writer, fit_word(fit))
                call put_cells(writer, [audit%fresh%max_rel_err, audit%fresh%rms_rel_err, &
                                        audit%condition, audit%residual_max, audit%residual_rms, &
                                        audit%coefficient_max])
                if (audit%suspect >= 0) then
                    call put_cell(writer, 'c' // integer_text(audit%suspect))
                    call put_cells(writer, [row%c(audit%suspect), audit%change, audit%share])
                else
                    call put_empty_cells(writer, 4)
                end if
                call put_cell(writer, audit%corrected_max)
                call put_cell(writer, trim(merge('yes', 'no ', audit%misprint)))
                call put_cells(writer, [audit%below, audit%above])
                call end_row(writer)
            end associate
        end do
        call end_table(writer)
    end subroutine write_findings

    subroutine summarise(to_stderr, name, fit, audits)
        logical, intent(in) :: to_stderr
        character(len=*), intent(in) :: name
        integer, intent(in) :: fit
        type(audit_t), intent(in) :: audits(:)

        character(len=200) :: line
        integer :: i, n_misprints

        call tell(to_stderr, 'audit of ' // name // ', ' // integer_text(size(audits)) &
                  // ' rows, against the exact integral and a fresh fit (' // fit_word(fit) // ')')
        call tell(to_stderr, '    n  max err     at b  rms err  fit max   |dE|max  change    by' &
                  // '         share   /10      x10')
        n_misprints = 0
        do i = 1, size(audits)
            associate (audit => audits(i), row => audits(i)%row)
                ! Given: a decimal logarithm.
                write (line, '(i5, 3(1x, a), 1x, a, 1x, es9.1)') row%n, percent(row%max_rel_err), &
                    short(10.0_wp**row%max_at), percent(row%rms_rel_err), &
                    percent(audit%fresh%max_rel_err), audit%residual_max
                if (audit%suspect >= 0) then
                    write (line(len_trim(line) + 1:), '(2x, a4, es13.3, f8.4)') &
                        'c' // integer_text(audit%suspect), -audit%change, audit%share
                else
                    write (line(len_trim(line) + 1:), '(2x, a4, a13, a8)') '-', '-', '-'
                end if
                line(len_trim(line) + 1:) = ' ' // percent(audit%below) // ' ' &
                                            // percent(audit%above)
                if (audit%misprint) line(len_trim(line) + 1:) = '  MISPRINT'
                if (audit%misprint) n_misprints = n_misprints + 1
                call tell(to_stderr, trim(line))
            end associate
        end do
        i = maxloc(audits%row%max_rel_err, dim=1)
        ! Given: a decimal logarithm.
        call tell(to_stderr, 'worst: n = ' // integer_text(audits(i)%row%n) // ' with ' &
                  // trim(adjustl(percent(audits(i)%row%max_rel_err))) // ' at b = ' &
                  // trim(adjustl(short(10.0_wp**audits(i)%row%max_at))))
        if (n_misprints == 0) then
            call tell(to_stderr, 'no misprint is demonstrable: no single coefficient explains ' // &
                      '99.9 % of a row''s distance to the fit')
        else
            call tell(to_stderr, 'misprints demonstrable: ' // integer_text(n_misprints))
        end if
    end subroutine summarise

    subroutine tell(to_stderr, text)
        logical, intent(in) :: to_stderr
        character(len=*), intent(in) :: text

        if (to_stderr) then
            call note(text)
        else
            call say(text)
        end if
    end subroutine tell

    ! A relative error in percent, eight characters.
    function percent(value) result(text)
        real(wp), intent(in) :: value
        character(len=8) :: text

        ! Given: the unit, and between which numbers people read them without exponent.
        real(wp), parameter :: whole = 100.0_wp, most_plain = 100.0_wp, least_plain = 1.0e-4_wp

        if (abs(value) >= most_plain .or. (abs(value) < least_plain .and. abs(value) > 0.0_wp)) then
            write (text, '(es7.0, "%")') whole*value
        else if (abs(value) >= 1.0_wp) then
            write (text, '(f7.1, "%")') whole*value
        else
            write (text, '(f7.3, "%")') whole*value
        end if
    end function percent

    function short(value) result(text)
        real(wp), intent(in) :: value
        character(len=8) :: text

        write (text, '(es8.2)') value
    end function short
end module faststrip_command_table_audit
