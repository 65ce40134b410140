!> A coefficient table as CSV, as an include file for Fortran or C, or as JSON.
module faststrip_command_table_files
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_text_t, csv_writer_t, open_csv, put_header, put_comment, &
                                   put_cell, put_line, end_row, real_text, put_cells
    use faststrip_tables_polynomials, only: basis_monomial, basis_chebyshev
    use faststrip_tables_refit, only: refit_plan_t, table_row_t, fit_minimax_error, fit_author, &
                                      error_points
    use faststrip_command_program_console, only: fail_on_error, put_origin, version_text, &
                                                 end_table
    implicit none
    private

    public :: write_table, basis_word, quantity_word, fit_word, most_array_rows

    !> The most rows a Fortran include can hold.
    !> Given: within the language's 255 continuation lines.
    integer, parameter :: most_array_rows = 500

contains

    !> Write a table.
    subroutine write_table(path, format, plan, rows)
        character(len=*), intent(in) :: path     !! file, or - for stdout
        character(len=*), intent(in) :: format   !! csv, fortran, c or json
        type(refit_plan_t), intent(in) :: plan   !! what was fitted
        type(table_row_t), intent(in) :: rows(:) !! all of one degree, at least one

        type(csv_writer_t) :: writer
        type(status_t) :: status

        call open_csv(writer, path, status)
        call fail_on_error(status)
        select case (format)
        case ('fortran'); call put_fortran(writer, plan, rows)
        case ('c'); call put_c(writer, plan, rows)
        case ('json'); call put_json(writer, plan, rows)
        case default; call put_csv(writer, plan, rows)
        end select
        call end_table(writer)
    end subroutine write_table

    subroutine put_csv(writer, plan, rows)
        type(csv_writer_t), intent(inout) :: writer
        type(refit_plan_t), intent(in) :: plan
        type(table_row_t), intent(in) :: rows(:)

        character(len=11), allocatable :: names(:)
        integer :: i, k

        call put_origin(writer)
        call put_comment(writer, 'fit ' // fit_word(plan%spec%fit) // ', ' &
                         // integer_text(size(plan%l)) // ' nodes, condition ' &
                         // short_text(plan%condition) // '; errors of 10**E on ' &
                         // integer_text(error_points) // ' points uniform in L, the largest ' &
                         // 'refined')
        allocate (names(9 + plan%spec%degree))
        names(:6) = [character(len=11) :: 'n', 'L_min', 'L_max', 'quantity', 'basis', 'degree']
        do k = 0, plan%spec%degree
            names(7 + k) = 'c' // integer_text(k)
        end do
        names(8 + plan%spec%degree:) = [character(len=11) :: 'max_rel_err', 'rms_rel_err']
        call put_header(writer, names)
        do i = 1, size(rows)
            call put_cell(writer, rows(i)%n)
            call put_cells(writer, [rows(i)%l_min, rows(i)%l_max])
            call put_cell(writer, quantity_word(rows(i)%half))
            call put_cell(writer, basis_word(rows(i)%basis))
            call put_cell(writer, rows(i)%degree)
            do k = 0, rows(i)%degree
                call put_cell(writer, rows(i)%c(k))
            end do
            call put_cells(writer, [rows(i)%max_rel_err, rows(i)%rms_rel_err])
            call end_row(writer)
        end do
    end subroutine put_csv

    ! What a reader of an include file has to know, each line after a mark.
    subroutine put_explanation(writer, mark, plan, rows)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: mark
        type(refit_plan_t), intent(in) :: plan
        type(table_row_t), intent(in) :: rows(:)

        character(len=40) :: line
        integer :: i

        associate (spec => plan%spec)
            call put_line(writer, mark // version_text())
            call put_line(writer, mark // 'Influence integral i_n(b) of a strip of half-width')
            call put_line(writer, mark // 'over half-length b, n strips away, center line:')
            call put_line(writer, mark // '  i_n(b) = ' // trim(merge('2 * 10**E', '10**E    ', &
                                                                     spec%half)) // ',')
            if (spec%basis == basis_monomial) then
                call put_line(writer, mark // '  E = sum over k of c(k) * L**k, L = log10(b)')
            else
                call put_line(writer, mark // '  E = sum over k of c(k) * T_k(t), L = log10(b),')
                call put_line(writer, mark // '  t = (2*L - L_min - L_max)/(L_max - L_min),')
                call put_line(writer, mark // '  T_0 = 1, T_1 = t, T_k+1 = 2*t*T_k - T_k-1')
            end if
            call put_line(writer, mark // 'Range: ' // short_text(spec%l_min) // ' <= L <= ' &
                          // short_text(spec%l_max) // '; useless outside.')
            call put_line(writer, mark // 'Fit: ' // fit_word(spec%fit) // ', degree ' &
                          // integer_text(spec%degree) // ', ' // basis_word(spec%basis) &
                          // ' basis, condition ' // short_text(plan%condition))
            call put_line(writer, mark // 'Relative error of i_n(b) on the range, measured on')
            call put_line(writer, mark // integer_text(error_points) &
                          // ' points uniform in L:')
            call put_line(writer, mark // '     n    largest        rms')
            do i = 1, size(rows)
                write (line, '(i6, 2es11.3)') rows(i)%n, rows(i)%max_rel_err, rows(i)%rms_rel_err
                call put_line(writer, mark // trim(line))
            end do
        end associate
    end subroutine put_explanation

    ! Constant arrays. Every line is right in free and in fixed form: text in columns 7 to 72,
    ! a continued line has & in column 73 and the next one & in column 6.
    subroutine put_fortran(writer, plan, rows)
        type(csv_writer_t), intent(inout) :: writer
        type(refit_plan_t), intent(in) :: plan
        type(table_row_t), intent(in) :: rows(:)

        character(len=*), parameter :: head_of_numbers = 'double precision, parameter :: '
        character(len=:), allocatable :: last_k, n_rows, name
        type(csv_text_t) :: items(size(rows)), coefficients(0:plan%spec%degree), ends(2)
        integer :: i

        call put_explanation(writer, '! ', plan, rows)
        last_k = integer_text(plan%spec%degree)
        n_rows = integer_text(size(rows))
        call put_line(writer, '! strip_table(k, row) is c(k) for the distance strip_table_n(row).')
        call put_line(writer, '      integer, parameter :: strip_table_rows = ' // n_rows)
        call put_line(writer, '      integer, parameter :: strip_table_degree = ' // last_k)
        call write_numbers([plan%spec%l_min, plan%spec%l_max], ends)
        call put_statement(writer, head_of_numbers // 'strip_table_range(2) = (/', ends, '/)')
        do i = 1, size(rows)
            items(i)%text = integer_text(rows(i)%n)
        end do
        call put_statement(writer, 'integer, parameter :: strip_table_n(' // n_rows // ') = (/', &
                           items, '/)')
        call write_numbers(rows%max_rel_err, items)
        call put_statement(writer, head_of_numbers // 'strip_table_max(' // n_rows // ') = (/', &
                           items, '/)')
        call write_numbers(rows%rms_rel_err, items)
        call put_statement(writer, head_of_numbers // 'strip_table_rms(' // n_rows // ') = (/', &
                           items, '/)')
        do i = 1, size(rows)
            name = 'strip_table_r' // integer_text(i)
            items(i)%text = name
            call write_numbers(rows(i)%c(:rows(i)%degree), coefficients)
            call put_statement(writer, head_of_numbers // name // '(0:' // last_k // ') = (/', &
                               coefficients, '/)')
        end do
        call put_statement(writer, head_of_numbers // 'strip_table(0:' // last_k // ',' // n_rows &
                           // ') = reshape((/', items, &
                           '/), (/ ' // integer_text(plan%spec%degree + 1) // ', ' // n_rows &
                           // ' /))')
    end subroutine put_fortran

    ! A statement `head item, item, ... tail`, head and tail on lines of their own.
    subroutine put_statement(writer, head, items, tail)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: head, tail
        type(csv_text_t), intent(in) :: items(:)

        character(len=72) :: line
        character(len=:), allocatable :: item
        integer :: i

        line = '      ' // head
        call put_line(writer, line // '&')
        line = '     &'
        do i = 1, size(items)
            item = ' ' // items(i)%text
            if (i < size(items)) item = item // ','
            if (len_trim(line) + len(item) > len(line)) then
                call put_line(writer, line // '&')
                line = '     &'
            end if
            line(len_trim(line) + 1:) = item
        end do
        call put_line(writer, line // '&')
        call put_line(writer, '     & ' // tail)
    end subroutine put_statement

    subroutine write_numbers(values, items)
        real(wp), intent(in) :: values(:)
        type(csv_text_t), intent(inout) :: items(:)

        integer :: i

        do i = 1, size(values)
            items(i)%text = fortran_number(values(i))
        end do
    end subroutine write_numbers

    ! 17 digits with the exponent letter of double precision.
    function fortran_number(value) result(text)
        real(wp), intent(in) :: value
        character(len=:), allocatable :: text

        integer :: at

        text = real_text(value)
        at = index(text, 'E')
        text = text(:at - 1) // 'D' // text(at + 1:)
    end function fortran_number

    subroutine put_c(writer, plan, rows)
        type(csv_writer_t), intent(inout) :: writer
        type(refit_plan_t), intent(in) :: plan
        type(table_row_t), intent(in) :: rows(:)

        character(len=:), allocatable :: comma
        integer :: i, k

        call put_line(writer, '/*')
        call put_explanation(writer, ' * ', plan, rows)
        call put_line(writer, ' * strip_table[row][k] is c(k) for the distance strip_table_n[row].')
        call put_line(writer, ' */')
        call put_line(writer, 'enum { strip_table_rows = ' // integer_text(size(rows)) &
                      // ', strip_table_degree = ' // integer_text(plan%spec%degree) // ' };')
        call put_line(writer, 'static const double strip_table_range[2] = { ' &
                      // real_text(plan%spec%l_min) // ', ' // real_text(plan%spec%l_max) // ' };')
        call put_line(writer, 'static const int strip_table_n[' // integer_text(size(rows)) &
                      // '] = {')
        do i = 1, size(rows)
            call put_line(writer, '  ' // integer_text(rows(i)%n) // comma_unless(i == size(rows)))
        end do
        call put_line(writer, '};')
        call put_line(writer, 'static const double strip_table[' // integer_text(size(rows)) &
                      // '][' // integer_text(plan%spec%degree + 1) // '] = {')
        do i = 1, size(rows)
            do k = 0, rows(i)%degree
                comma = comma_unless(k == rows(i)%degree)
                if (k == rows(i)%degree) comma = ' }' // comma_unless(i == size(rows))
                call put_line(writer, merge('  { ', '    ', k == 0) // real_text(rows(i)%c(k)) &
                              // comma)
            end do
        end do
        call put_line(writer, '};')
    end subroutine put_c

    subroutine put_json(writer, plan, rows)
        type(csv_writer_t), intent(inout) :: writer
        type(refit_plan_t), intent(in) :: plan
        type(table_row_t), intent(in) :: rows(:)

        character(len=:), allocatable :: line
        integer :: i, k

        call put_line(writer, '{')
        call put_line(writer, '  "generator": "' // version_text() // '",')
        call put_line(writer, '  "fit": "' // fit_word(plan%spec%fit) // '",')
        call put_line(writer, '  "condition": ' // real_text(plan%condition) // ',')
        call put_line(writer, '  "quantity": "' // quantity_word(plan%spec%half) // '",')
        call put_line(writer, '  "basis": "' // basis_word(plan%spec%basis) // '",')
        call put_line(writer, '  "degree": ' // integer_text(plan%spec%degree) // ',')
        call put_line(writer, '  "L_min": ' // real_text(plan%spec%l_min) // ',')
        call put_line(writer, '  "L_max": ' // real_text(plan%spec%l_max) // ',')
        call put_line(writer, '  "rows": [')
        do i = 1, size(rows)
            line = ''
            line = '    {"n": ' // integer_text(rows(i)%n) // ', "c": ['
            do k = 0, rows(i)%degree
                line = line // real_text(rows(i)%c(k)) // comma_unless(k == rows(i)%degree)
            end do
            line = line // '], "max_rel_err": ' // real_text(rows(i)%max_rel_err) &
                   // ', "rms_rel_err": ' // real_text(rows(i)%rms_rel_err) // '}'
            call put_line(writer, line // comma_unless(i == size(rows)))
        end do
        call put_line(writer, '  ]')
        call put_line(writer, '}')
    end subroutine put_json

    function comma_unless(last) result(text)
        logical, intent(in) :: last
        character(len=:), allocatable :: text

        text = ','
        if (last) text = ''
    end function comma_unless

    function short_text(value) result(text)
        real(wp), intent(in) :: value
        character(len=:), allocatable :: text

        character(len=20) :: buffer

        ! Given: people read larger numbers with exponent.
        if (abs(value) < 1.0e4_wp) then
            write (buffer, '(f12.4)') value
        else
            write (buffer, '(es12.2e3)') value
        end if
        text = trim(adjustl(buffer))
    end function short_text

    !> `monomial` or `chebyshev`.
    pure function basis_word(basis) result(word)
        integer, intent(in) :: basis !! one of the `basis_` numbers
        character(len=:), allocatable :: word

        word = 'monomial'
        if (basis == basis_chebyshev) word = 'chebyshev'
    end function basis_word

    !> `half` or `full`.
    pure function quantity_word(half) result(word)
        logical, intent(in) :: half !! is 10**E one half of the integral?
        character(len=:), allocatable :: word

        word = 'full'
        if (half) word = 'half'
    end function quantity_word

    !> `lsq`, `minimax` or `author`.
    pure function fit_word(fit) result(word)
        integer, intent(in) :: fit !! one of the `fit_` numbers
        character(len=:), allocatable :: word

        word = 'lsq'
        if (fit == fit_minimax_error) word = 'minimax'
        if (fit == fit_author) word = 'author'
    end function fit_word
end module faststrip_command_table_files
