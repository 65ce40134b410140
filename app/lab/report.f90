!> `faststrip-lab report`: everything that is measured, in one folder, with a verdict per row.
!>
!> The runs that make the figures stand in one CSV file, the comparisons they are judged by in
!> another; this subcommand does the runs, one after the other so that times are not disturbed,
!> and hands the folder to the Python command that compares, draws and writes.
module faststrip_lab_report
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, csv_writer_t, read_csv, require_column, cell_text, &
                                   open_csv, put_header, put_cell, end_row, close_csv
    use faststrip_command_clock, only: microseconds
    use faststrip_command_console, only: fail, fail_on_error, note, put_origin, usage_error, &
                                         exit_bad_input
    use faststrip_command_system, only: resolved
    use faststrip_lab_checkout, only: in_checkout
    use faststrip_command_options, only: command_t, option_t, parse_command, given, option_text, &
                                         command_argument
    implicit none
    private

    public :: run_report

    character(len=*), parameter :: run_columns(4) = [character(len=7) :: &
        'id', 'when', 'program', 'words']

contains

    !> Run the subcommand from the command line.
    subroutine run_report()
        type(command_t) :: command
        type(csv_table_t) :: runs
        type(status_t) :: status
        character(len=:), allocatable :: folder, python, manifest, words
        integer :: column(size(run_columns)), i, code
        logical :: quick

        command%name = 'report'
        command%usage = ''
        command%about = &
            'Do every run of a list, compare the figures with references as a manifest says and' &
            // new_line('a') // 'write report.md, report.html, verdicts.csv, pictures and all' &
            // ' CSV files into a folder.' // new_line('a') // 'Exit code 1 if a comparison' &
            // ' fails. Python with numpy and matplotlib does the comparing;' // new_line('a') &
            // './run report installs and names it.' // new_line('a')
        command%options = [ &
            option_t('-o', 'FOLDER', 'write there (default out/report)'), &
            option_t('--quick', '', 'only the runs that take a few seconds'), &
            option_t('--runs', 'FILE', 'the runs (default reference/report_runs.csv)', &
                     reads=.true.), &
            option_t('--manifest', 'FILE', 'the comparisons (default reference/comparisons.csv)', &
                     reads=.true.), &
            option_t('--python', 'PROGRAM', 'Python with numpy and matplotlib (default python3)')]
        call parse_command(command, 0)
        folder = option_text(command, '-o', 'out/report')
        python = option_text(command, '--python', 'python3')
        manifest = option_text(command, '--manifest', in_checkout('reference/comparisons.csv'))
        quick = given(command, '--quick')
        call read_csv(option_text(command, '--runs', in_checkout('reference/report_runs.csv')), &
                      runs, status)
        call fail_on_error(status)
        do i = 1, size(run_columns)
            call require_column(runs, trim(run_columns(i)), column(i), status)
            call fail_on_error(status)
        end do
        call refuse_inputs_inside(folder, option_text(command, '--runs', ''))
        call refuse_inputs_inside(folder, option_text(command, '--manifest', ''))
        ! An older report goes; a folder that is no report stays as it is.
        call shell('if [ -e ' // quoted(folder // '/data/runs.csv') // ' ]; then rm -rf ' &
                   // quoted(folder // '/data') // ' ' // quoted(folder // '/figures') &
                   // '; fi; mkdir -p ' // quoted(folder // '/data') // ' ' &
                   // quoted(folder // '/figures'), code)
        if (code /= 0) call fail(exit_bad_input, 'cannot make the folder: ' // folder)
        call do_runs(runs, column, folder, python, quick)
        words = 'plots/report.py --manifest ' // quoted(manifest) // ' --folder ' // quoted(folder)
        if (quick) words = words // ' --quick'
        call shell(quoted(python) // ' ' // words, code)
        if (code /= 0) call fail(exit_bad_input, 'the report has comparisons that fail, or could' &
                                 // ' not be written: ' // folder // '/report.md')
    end subroutine run_report

    !> A list that stands where the older report goes would go with it.
    subroutine refuse_inputs_inside(folder, path)
        character(len=*), intent(in) :: folder !! of the report
        character(len=*), intent(in) :: path   !! of the list; may be empty

        character(len=:), allocatable :: inside
        integer :: i
        character(len=7), parameter :: parts(2) = ['data   ', 'figures']

        inside = ''
        if (len(path) == 0) return
        do i = 1, size(parts)
            inside = resolved(folder // '/' // trim(parts(i))) // '/'
            if (len(inside) > 1 .and. index(resolved(path), inside) == 1) &
                call usage_error('-o must not be a folder whose files are read, got ' // folder &
                                 // ' with ' // path, 'report')
        end do
    end subroutine refuse_inputs_inside

    !> Do the runs that are wanted; how each ended and how long it took goes into runs.csv.
    subroutine do_runs(runs, column, folder, python, quick)
        type(csv_table_t), intent(in) :: runs
        integer, intent(in) :: column(:)
        character(len=*), intent(in) :: folder, python
        logical, intent(in) :: quick

        type(csv_writer_t) :: writer
        type(status_t) :: status
        character(len=:), allocatable :: id, line
        real(wp) :: seconds
        integer(int64) :: before, after
        integer :: row, code

        id = ''
        line = ''
        call open_csv(writer, folder // '/data/runs.csv', status)
        call fail_on_error(status)
        call put_origin(writer)
        call put_header(writer, [character(len=9) :: 'id', 'exit_code', 'seconds', 'words'])
        do row = 1, runs%n_rows
            if (.not. is_wanted(cell_text(runs, row, column(2)), quick, runs, row)) cycle
            id = cell_text(runs, row, column(1))
            call command_line(runs, row, column, folder, python, line)
            call note('run ' // integer_text(row) // ' of ' // integer_text(runs%n_rows) // ': ' &
                      // id)
            call system_clock(before)
            call shell(line // ' >' // quoted(folder // '/data/' // id // '.txt') // ' 2>&1', code)
            call system_clock(after)
            seconds = 1.0e-6_wp*microseconds(before, after)
            if (code /= 0) call note('run ' // id // ' ended with exit code ' &
                                     // integer_text(code) // ': see ' // folder // '/data/' &
                                     // id // '.txt')
            call put_cell(writer, id)
            call put_cell(writer, code)
            call put_cell(writer, seconds)
            call put_cell(writer, cell_text(runs, row, column(4)))
            call end_row(writer)
        end do
        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine do_runs

    !> Is a run wanted: `always`, `full` without --quick, or `quick` with it?
    logical function is_wanted(when, quick, runs, row)
        character(len=*), intent(in) :: when
        logical, intent(in) :: quick
        type(csv_table_t), intent(in) :: runs
        integer, intent(in) :: row

        is_wanted = when == 'always'
        select case (when)
        case ('always')
        case ('full'); is_wanted = .not. quick
        case ('quick'); is_wanted = quick
        case default
            call fail(exit_bad_input, 'neither always, full nor quick: ' // when // ' (' &
                      // runs%file // ':' // integer_text(runs%line(row)) // ')')
        end select
    end function is_wanted

    !> The shell's words of one run; `{data}` and `{figures}` stand for the report's folders.
    subroutine command_line(runs, row, column, folder, python, line)
        type(csv_table_t), intent(in) :: runs
        integer, intent(in) :: row, column(:)
        character(len=*), intent(in) :: folder, python
        character(len=:), allocatable, intent(out) :: line

        character(len=:), allocatable :: program

        program = cell_text(runs, row, column(3))
        line = replaced(replaced(cell_text(runs, row, column(4)), '{data}', &
                                 quoted(folder // '/data')), &
                        '{figures}', quoted(folder // '/figures'))
        select case (program)
        case ('faststrip-lab'); line = quoted(command_argument(0)) // ' ' // line
        case ('faststrip'); line = quoted(sibling()) // ' ' // line
        case ('python'); line = 'FASTSTRIP_SVG=1 ' // quoted(python) // ' ' // line
        case default
            call fail(exit_bad_input, 'neither faststrip, faststrip-lab nor python: ' // program &
                      // ' (' &
                      // runs%file // ':' // integer_text(runs%line(row)) // ')')
        end select
    end subroutine command_line

    !> The program `faststrip` beside this one.
    function sibling() result(path)
        character(len=:), allocatable :: path

        path = command_argument(0)
        path = path(:index(path, '/', back=.true.)) // 'faststrip'
    end function sibling

    !> A text with every occurrence of a part replaced.
    pure function replaced(text, part, by) result(new)
        character(len=*), intent(in) :: text, part, by
        character(len=:), allocatable :: new

        integer :: at, start

        new = ''
        start = 1
        do
            at = index(text(start:), part)
            if (at == 0) exit
            new = new // text(start:start + at - 2) // by
            start = start + at - 1 + len(part)
        end do
        new = new // text(start:)
    end function replaced

    !> One word for the shell, whatever it holds.
    pure function quoted(text) result(word)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: word

        word = "'" // replaced(text, "'", "'\''") // "'"
    end function quoted

    !> Let the shell run a line; a line that cannot be run counts as exit code 127.
    subroutine shell(line, code)
        character(len=*), intent(in) :: line
        integer, intent(out) :: code

        integer :: trouble

        call execute_command_line(line, exitstat=code, cmdstat=trouble)
        if (trouble /= 0) code = 127
    end subroutine shell
end module faststrip_lab_report
