!> `faststrip integral`: influence integrals of strips.
module faststrip_command_table_integral
    use faststrip_base_kinds, only: wp
    use faststrip_base_limits, only: beyond_all
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, number_text, &
                                     st_bad_argument, st_out_of_range
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, &
                                   column_index, cell_number, cell_integer, refuse_misspelt, &
                                   put_header, put_cell, end_row, put_cells
    use faststrip_influence_closed, only: strip_influence
    use faststrip_influence_offcentre, only: strip_influence_at
    use faststrip_influence_polynomial, only: table_influence
    use faststrip_tables_quadrature, only: quadrature_influence
    use faststrip_command_program_console, only: fail, fail_on_error, usage_error, put_origin, &
                                                 exit_bad_input
    use faststrip_command_program_people, only: open_result, close_result
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_number, option_integer, &
                                                 option_word
    implicit none
    private

    public :: run_integral

contains

    !> Run the subcommand from the command line.
    subroutine run_integral()
        type(command_t) :: command
        type(csv_table_t) :: table
        type(status_t) :: status
        character(len=:), allocatable :: method
        integer, allocatable :: n(:)
        real(wp), allocatable :: b(:), x(:), value(:)
        integer :: i

        command%name = 'integral'
        command%usage = ''
        command%about = &
            'The influence integral i_n(b) of a strip of half-length 1 and half-width b on a' &
            // new_line('a') // 'point n strips away and X half-lengths along the strip' &
            // new_line('a') // '(theory: influence of the pressure sqrt(1 - u^2)). CSV:' &
            // new_line('a') // 'n,b,X,method,value.' // new_line('a')
        command%options = [ &
            option_t('--n', 'INTEGER', 'distance in strips, >= 0'), &
            option_t('--b', 'NUMBER', 'half-width over half-length, > 0'), &
            option_t('--x', 'NUMBER', 'field point over half-length (default 0)'), &
            option_t('--input', 'FILE.csv', 'columns n,b, optionally X; no --n --b --x then', &
                     reads=.true.), &
            option_t('--method', 'NAME', 'closed (default), quadrature or table'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 0)
        method = option_word(command, '--method', 'closed', &
                             [character(len=10) :: 'closed', 'quadrature', 'table'])
        if (given(command, '--input')) then
            if (given(command, '--n') .or. given(command, '--b') .or. given(command, '--x')) &
                call usage_error('--input must not be given with --n, --b and --x', command%name)
            call read_csv(option_text(command, '--input', ''), table, status)
            call fail_on_error(status)
            call take_table(table, n, b, x)
        else
            if (.not. (given(command, '--n') .and. given(command, '--b'))) &
                call usage_error('--n and --b, or --input, are needed', command%name)
            n = [option_integer(command, '--n', 0)]
            b = [option_number(command, '--b', 0.0_wp)]
            x = [option_number(command, '--x', 0.0_wp)]
        end if
        allocate (value(size(n)))
        do i = 1, size(n)
            call evaluate(method, n(i), b(i), x(i), value(i), status)
            if (.not. is_error(status)) cycle
            if (given(command, '--input')) then
                call fail(exit_bad_input, trim(status%message) // ' (' // table%file // ':' &
                          // integer_text(table%line(i)) // ')')
            end if
            call fail_on_error(status)
        end do
        call write_values(command, n, b, x, method, value)
    end subroutine run_integral

    subroutine take_table(table, n, b, x)
        type(csv_table_t), intent(in) :: table
        integer, allocatable, intent(out) :: n(:)
        real(wp), allocatable, intent(out) :: b(:), x(:)

        type(status_t) :: status
        integer :: row, n_column, b_column, x_column

        call require_column(table, 'n', n_column, status)
        call fail_on_error(status)
        call require_column(table, 'b', b_column, status)
        call fail_on_error(status)
        x_column = column_index(table, 'X')
        call refuse_misspelt(table, 'X', ['n', 'b'], status)
        call fail_on_error(status)
        allocate (n(table%n_rows), b(table%n_rows), x(table%n_rows))
        do row = 1, table%n_rows
            call cell_integer(table, row, n_column, n(row), status)
            call fail_on_error(status)
            call cell_number(table, row, b_column, b(row), status)
            call fail_on_error(status)
            x(row) = 0.0_wp
            if (x_column > 0) call cell_number(table, row, x_column, x(row), status)
            call fail_on_error(status)
        end do
    end subroutine take_table

    subroutine evaluate(method, n, b, x, value, status)
        character(len=*), intent(in) :: method
        integer, intent(in) :: n
        real(wp), intent(in) :: b, x
        real(wp), intent(out) :: value
        type(status_t), intent(out) :: status

        real(wp) :: abs_error

        value = 0.0_wp
        call clear_status(status)
        if (n < 0) then
            call set_status(status, st_bad_argument, 'n must not be negative, got ' &
                            // integer_text(n))
        else if (b <= 0.0_wp) then
            call set_status(status, st_bad_argument, 'b must be above 0, got ' // number_text(b))
        else
            select case (method)
            case ('closed')
                if (x == 0.0_wp) then
                    value = strip_influence(n, b)
                else if (max(b, abs(x)) > beyond_all) then
                    call set_status(status, st_out_of_range, 'b and X must be at most 1e100, got ' &
                                    // trim(number_text(b)) // ', ' // number_text(x))
                else
                    value = strip_influence_at(x, (2.0_wp*n - 1.0_wp)*b, (2.0_wp*n + 1.0_wp)*b)
                end if
            case ('quadrature')
                call quadrature_influence(n, b, x, value, abs_error, status)
            case ('table')
                if (x /= 0.0_wp) then
                    call set_status(status, st_out_of_range, 'X must be 0 for the table of ' &
                                    // 'the centre line, got ' // number_text(x))
                else
                    call table_influence(n, b, value, status)
                end if
            end select
        end if
    end subroutine evaluate

    subroutine write_values(command, n, b, x, method, value)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: method
        integer, intent(in) :: n(:)
        real(wp), intent(in) :: b(:), x(:), value(:)

        character(len=*), parameter :: columns(*) = &
            [character(len=6) :: 'n', 'b', 'X', 'method', 'value']
        type(csv_writer_t) :: writer
        type(status_t) :: status
        integer :: i

        call open_result(command, writer, status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_header(writer, columns)
        do i = 1, size(n)
            call put_cell(writer, n(i))
            call put_cells(writer, [b(i), x(i)])
            call put_cell(writer, method)
            call put_cell(writer, value(i))
            call end_row(writer)
        end do
        call close_result(command, writer, columns, status)
        call fail_on_error(status)
    end subroutine write_values
end module faststrip_command_table_integral
