!> Results for people: on a terminal a short table with units stands for the CSV.
module faststrip_command_program_people
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_base_text, only: parse_real, integer_text
    use faststrip_files_csv, only: csv_text_t, csv_table_t, csv_writer_t, open_csv, close_csv, &
                                   collect_csv, collected, collected_length, put_text, cell_text
    use faststrip_files_csv_table, only: start_table, take_names, take_only_row
    use faststrip_files_units, only: column_unit
    use faststrip_command_program_console, only: say, printable
    use faststrip_command_program_options, only: command_t, given, option_text, has_option
    use faststrip_command_program_plot, only: keep_for_plot
    use faststrip_command_program_system, only: is_terminal
    implicit none
    private

    public :: open_result, close_result

    !> What a column is called where there is room for words.
    type :: label_t
        character(len=26) :: column
        character(len=36) :: words
        character(len=10) :: unit !! where the column's name does not end in one
    end type label_t

    type(label_t), parameter :: labels(*) = [ &
        label_t('yw_mm', 'lateral shift', ''), &
        label_t('normal', 'normal method', ''), &
        label_t('tangential', 'tangential method', ''), &
        label_t('N_N', 'normal force', ''), &
        label_t('gamma_rad', 'contact angle', ''), &
        label_t('contact_angle_rad', 'contact angle', ''), &
        label_t('cksi', 'longitudinal creepage', ''), &
        label_t('ceta', 'lateral creepage', ''), &
        label_t('cphi_rad_per_mm', 'spin creepage', 'rad/mm'), &
        label_t('penetration_mm', 'penetration', ''), &
        label_t('area_mm2', 'contact area', 'mm^2'), &
        label_t('pmax_MPa', 'maximum pressure', ''), &
        label_t('Fx_N', 'longitudinal force on the rail', ''), &
        label_t('Fy_N', 'lateral force on the rail', ''), &
        label_t('Fs_N', 'lateral force on the rail', ''), &
        label_t('Mz_Nmm', 'spin moment on the rail', ''), &
        label_t('stick_fraction', 'share of the patch that adheres', ''), &
        label_t('est_err_pmax', 'estimated error of the pressure', 'relative'), &
        label_t('est_err_Fx', 'estimated error of Fx', 'of mu N'), &
        label_t('est_err_Fy', 'estimated error of Fy', 'of mu N'), &
        label_t('amplitude_mm', 'amplitude', ''), &
        label_t('tan_gamma_e', 'equivalent conicity', '')]

    ! Given: significant digits that people read, and between which powers of ten without exponent.
    integer, parameter :: digits = 4
    ! Given: the same.
    real(wp), parameter :: least_plain = 1.0e-4_wp, most_plain = 1.0e7_wp
    ! Between two columns.
    character(len=*), parameter :: between = '  '

contains

    !> Start the file of `-o`. Where nobody has asked for one and people look, or where a picture
    !> is drawn of it, it is collected.
    subroutine open_result(command, writer, status)
        type(command_t), intent(in) :: command    !! parsed
        type(csv_writer_t), intent(out) :: writer !! for `close_result`
        type(status_t), intent(out) :: status     !! those of `open_csv`

        call clear_status(status)
        if (is_for_people(command) .or. is_drawn(command)) then
            call collect_csv(writer)
        else
            call open_csv(writer, option_text(command, '-o', '-'), status)
        end if
    end subroutine open_result

    !> Finish it: a table of some columns on the terminal, or the file.
    subroutine close_result(command, writer, columns, status)
        type(command_t), intent(in) :: command       !! as for `open_result`
        type(csv_writer_t), intent(inout) :: writer  !! written
        character(len=*), intent(in) :: columns(:)   !! that people are shown
        type(status_t), intent(out) :: status        !! those of `open_csv` and `close_csv`

        character(len=:), allocatable :: text

        if (.not. (is_for_people(command) .or. is_drawn(command))) then
            call close_csv(writer, status)
            return
        end if
        text = collected(writer, 1, collected_length(writer))
        if (is_drawn(command)) call keep_for_plot('result.csv', text)
        if (is_for_people(command)) then
            call show_table(text, columns, status)
            return
        end if
        call open_csv(writer, option_text(command, '-o', '-'), status)
        if (is_error(status)) return
        call put_text(writer, text)
        call close_csv(writer, status)
    end subroutine close_result

    logical function is_for_people(command)
        type(command_t), intent(in) :: command

        is_for_people = .not. given(command, '-o')
        if (is_for_people) is_for_people = is_terminal()
    end function is_for_people

    logical function is_drawn(command)
        type(command_t), intent(in) :: command

        is_drawn = has_option(command, '--plot')
        if (is_drawn) is_drawn = given(command, '--plot')
    end function is_drawn

    ! Print some columns of a table: one row as a list, several as they stand.
    subroutine show_table(text, columns, status)
        character(len=*), intent(in) :: text
        character(len=*), intent(in) :: columns(:)
        type(status_t), intent(out) :: status

        type(csv_table_t) :: table
        type(csv_text_t), allocatable :: cells(:, :), wider(:, :)
        integer :: from, to, n, i
        logical :: has_names

        call clear_status(status)
        call start_table('the result', table)
        allocate (cells(size(columns), 64))
        n = 0
        has_names = .false.
        from = 1
        do while (from <= len(text))
            to = from + index(text(from:), new_line('a')) - 2
            if (text(from:from) == '#') then
            else if (.not. has_names) then
                call take_names(table, text(from:to), 1, status)
                if (is_error(status)) return
                has_names = .true.
            else
                call take_only_row(table, text(from:to), 1, status)
                if (is_error(status)) return
                n = n + 1
                if (n > size(cells, 2)) then
                    allocate (wider(size(columns), 2*n))
                    wider(:, :n - 1) = cells
                    call move_alloc(wider, cells)
                end if
                do i = 1, size(columns)
                    cells(i, n)%text = shown(cell_text(table, 1, place(table, columns(i))))
                end do
            end if
            from = to + 2
        end do
        if (n == 1) then
            call show_list(columns, cells(:, 1))
        else
            call show_rows(columns, cells(:, :n))
        end if
        call say('')
        call say(integer_text(n) // trim(merge(' row ', ' rows', n == 1)) // '; all ' &
                 // integer_text(table%n_columns) // ' columns: -o FILE.csv')
    end subroutine show_table

    pure integer function place(table, name)
        type(csv_table_t), intent(in) :: table
        character(len=*), intent(in) :: name

        do place = table%n_columns, 1, -1
            if (table%names(place)%text == name) return
        end do
    end function place

    ! Name, value and unit, a line each; what is empty is left out.
    subroutine show_list(columns, cells)
        character(len=*), intent(in) :: columns(:)
        type(csv_text_t), intent(in) :: cells(:)

        type(csv_text_t) :: names(size(columns)), units(size(columns))
        integer :: i, k, name_width, cell_width

        name_width = 0
        cell_width = 0
        do i = 1, size(columns)
            names(i)%text = trim(columns(i))
            units(i)%text = trim(column_unit(trim(columns(i))))
            do k = 1, size(labels)
                if (labels(k)%column /= columns(i)) cycle
                names(i)%text = trim(labels(k)%words)
                if (labels(k)%unit /= '') units(i)%text = trim(labels(k)%unit)
            end do
            if (len(cells(i)%text) == 0) cycle
            name_width = max(name_width, len(names(i)%text))
            if (len(units(i)%text) > 0) cell_width = max(cell_width, len(cells(i)%text))
        end do
        do i = 1, size(columns)
            if (len(cells(i)%text) == 0) cycle
            if (len(units(i)%text) > 0) then
                call say(padded(names(i)%text, name_width) // between &
                         // padded(cells(i)%text, cell_width) // between // units(i)%text)
            else
                call say(padded(names(i)%text, name_width) // between // cells(i)%text)
            end if
        end do
    end subroutine show_list

    ! A header and a line for each row, numbers to the right.
    subroutine show_rows(columns, cells)
        character(len=*), intent(in) :: columns(:)
        type(csv_text_t), intent(in) :: cells(:, :)

        character(len=:), allocatable :: line
        integer :: width(size(columns)), i, k
        logical :: is_right(size(columns))

        do i = 1, size(columns)
            width(i) = len_trim(columns(i))
            is_right(i) = .true.
            do k = 1, size(cells, 2)
                width(i) = max(width(i), len(cells(i, k)%text))
                is_right(i) = is_right(i) .and. is_number(cells(i, k)%text)
            end do
        end do
        do k = 0, size(cells, 2)
            line = ''
            do i = 1, size(columns)
                if (i > 1) line = line // between
                if (k == 0) then
                    line = line // aligned(trim(columns(i)), width(i), is_right(i))
                else if (len(cells(i, k)%text) == 0) then
                    line = line // aligned('-', width(i), is_right(i))
                else
                    line = line // aligned(cells(i, k)%text, width(i), is_right(i))
                end if
            end do
            call say(trim(line))
        end do
    end subroutine show_rows

    pure function aligned(text, width, is_right) result(cell)
        character(len=*), intent(in) :: text
        integer, intent(in) :: width
        logical, intent(in) :: is_right
        character(len=:), allocatable :: cell

        if (is_right) then
            cell = repeat(' ', max(width - len(text), 0)) // text
        else
            cell = padded(text, width)
        end if
    end function aligned

    pure function padded(text, width) result(cell)
        character(len=*), intent(in) :: text
        integer, intent(in) :: width
        character(len=:), allocatable :: cell

        cell = text // repeat(' ', max(width - len(text), 0))
    end function padded

    pure logical function is_number(text)
        character(len=*), intent(in) :: text

        real(wp) :: value

        is_number = len(text) == 0
        if (.not. is_number) call parse_real(text, value, is_number)
    end function is_number

    ! A number with a point in few digits, all else as it stands.
    function shown(cell) result(text)
        character(len=*), intent(in) :: cell
        character(len=:), allocatable :: text

        character(len=40) :: buffer
        character(len=12) :: form
        real(wp) :: value
        logical :: is_real
        integer :: before

        text = printable(cell)
        if (scan(cell, '.eE') == 0) return
        call parse_real(cell, value, is_real)
        if (.not. is_real) return
        if (.not. abs(value) > 0.0_wp) then
            text = '0.'
        else if (abs(value) < least_plain .or. abs(value) >= most_plain) then
            write (buffer, '(es12.3e2)') value
            text = trim(adjustl(buffer))
        else
            before = floor(log10(abs(value))) + 1
            write (form, '("(f24.", i0, ")")') max(digits - before, 0)
            write (buffer, form) value
            text = trim(adjustl(buffer))
        end if
    end function shown
end module faststrip_command_program_people
