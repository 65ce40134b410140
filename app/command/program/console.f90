!> What the program says to people: errors and notes on stderr, help and version on stdout.
module faststrip_command_program_console
    use, intrinsic :: iso_fortran_env, only: error_unit
    use faststrip_base_status, only: status_t, is_error, st_not_finite, st_not_increasing, &
                                     st_too_few_points, st_no_contact, st_no_hertz_ellipse, &
                                     st_no_convergence, st_out_of_range, st_no_finite_patch, &
                                     st_linear_algebra
    use faststrip_files_csv, only: csv_writer_t, open_csv, put_comment, close_csv
    use faststrip_files_printable, only: printable
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_machine, only: compiler_name, compiler_flags
    use faststrip_command_revision, only: revision, version
    use faststrip_command_program_system, only: set_progress, set_speaker, is_printed
    implicit none
    private

    public :: fail, fail_on_error, concerns_gap, usage_error, note, say, progress
    public :: hold, tell_held
    public :: name_program, program_name, version_text, printable
    public :: begin_table, end_table, put_origin
    public :: exit_bad_input, exit_usage

    !> Exit codes.
    !> Given: numbers that scripts know.
    integer, parameter :: exit_bad_input = 1, exit_usage = 2, exit_no_convergence = 3

    ! Which of the two programs speaks.
    character(len=16) :: speaker = 'faststrip'

    !> What seems wrong in the input, though it can be solved: reported with the result, in its
    !> comments too, or with the error that it may be the cause of.
    type :: held_t
        character(len=:), allocatable :: text
    end type held_t

    type(held_t), allocatable :: held(:)

contains

    !> Say which program this is; messages, help and stamps name it.
    subroutine name_program(name)
        character(len=*), intent(in) :: name !! as typed

        speaker = name
        call set_speaker(name)
    end subroutine name_program

    !> Name of the program.
    function program_name() result(name)
        character(len=:), allocatable :: name

        name = trim(speaker)
    end function program_name

    !> End the program with one line on stderr.
    subroutine fail(code, text)
        integer, intent(in) :: code          !! exit code
        character(len=*), intent(in) :: text !! one line

        character(len=:), allocatable :: line
        integer :: i

        line = text
        if (allocated(held)) then
            do i = 1, size(held)
                line = line // '; ' // held(i)%text
            end do
        end if
        call note(line)
        stop code, quiet=.true.
    end subroutine fail

    !> Keep a line for `tell_held`; one that is kept already is not kept twice.
    subroutine hold(text)
        character(len=*), intent(in) :: text !! one line

        type(held_t), allocatable :: longer(:)
        integer :: i, n

        n = 0
        if (allocated(held)) n = size(held)
        do i = 1, n
            if (held(i)%text == text) return
        end do
        allocate (longer(n + 1))
        if (n > 0) longer(:n) = held
        longer(n + 1)%text = text
        call move_alloc(longer, held)
    end subroutine hold

    !> Say what was kept: a line each on stderr, and in the comments of a file.
    subroutine tell_held(writer)
        type(csv_writer_t), intent(inout), optional :: writer !! an open file, before its header

        integer :: i

        if (.not. allocated(held)) return
        do i = 1, size(held)
            call note(held(i)%text)
            if (present(writer)) call put_comment(writer, printable(held(i)%text))
        end do
        deallocate (held)
    end subroutine tell_held

    !> End the program if a status is an error: exit code 3 for no convergence, else 1.
    subroutine fail_on_error(status, context)
        type(status_t), intent(in) :: status              !! of a call to the library
        character(len=*), intent(in), optional :: context !! file it is about; follows in brackets

        integer :: code

        if (.not. is_error(status)) return
        code = exit_bad_input
        if (status%code == st_no_convergence) code = exit_no_convergence
        if (present(context)) then
            call fail(code, trim(status%message) // ' (' // context // ')')
        else
            call fail(code, trim(status%message))
        end if
    end subroutine fail_on_error

    !> Is an error one of a gap, or of the contact in it? Errors of files name them themselves.
    pure logical function concerns_gap(status)
        type(status_t), intent(in) :: status !! of a call to the library

        concerns_gap = any(status%code == [st_not_finite, st_not_increasing, st_too_few_points, &
                                           st_no_contact, st_no_hertz_ellipse, &
                                           st_no_convergence, st_out_of_range, &
                                           st_no_finite_patch, st_linear_algebra])
    end function concerns_gap

    !> End the program because it was called in a wrong way.
    subroutine usage_error(text, command)
        character(len=*), intent(in) :: text    !! what is wrong, with the offending value
        character(len=*), intent(in) :: command !! subcommand whose help serves; may be empty

        if (len(command) > 0) then
            call fail(exit_usage, text // '; see ' // program_name() // ' ' // command // ' --help')
        else
            call fail(exit_usage, text // '; see ' // program_name() // ' --help')
        end if
    end subroutine usage_error

    !> One line on stderr, whatever the text holds.
    subroutine note(text)
        character(len=*), intent(in) :: text !! what to say

        ! Tuned [characters]: of a line to people. Origin: capacity.
        integer, parameter :: longest = 2000

        if (len(text) > longest) then
            write (error_unit, '(4a)') program_name(), ': ', printable(text(:longest)), '...'
        else
            write (error_unit, '(3a)') program_name(), ': ', printable(text)
        end if
    end subroutine note

    !> One line on stdout.
    subroutine say(text)
        character(len=*), intent(in) :: text !! one line

        if (.not. is_printed(text)) call fail(exit_bad_input, 'cannot write to the standard output')
    end subroutine say

    !> How far long work is, for the lines that `start_signals` sends to stderr.
    subroutine progress(what, done, total)
        character(len=*), intent(in) :: what !! what is being counted
        integer, intent(in) :: done          !! how many are done
        integer, intent(in) :: total         !! how many there are

        call set_progress(what // ' ' // integer_text(done) // ' of ' // integer_text(total))
    end subroutine progress

    !> Name, version and revision of the program.
    function version_text() result(text)
        character(len=:), allocatable :: text

        text = program_name() // ' ' // version // ' rev ' // trim(revision)
    end function version_text

    !> Begin a table: open its file and say what made it. Ends the program if that cannot be done.
    subroutine begin_table(writer, path)
        type(csv_writer_t), intent(out) :: writer !! to be closed by `end_table`
        character(len=*), intent(in) :: path      !! name of the file, or `-`

        type(status_t) :: status

        call open_csv(writer, path, status)
        call fail_on_error(status)
        call put_origin(writer)
    end subroutine begin_table

    !> Finish a file. Ends the program if it cannot be written; what was there before then stays.
    subroutine end_table(writer)
        type(csv_writer_t), intent(inout) :: writer !! closed afterwards

        type(status_t) :: status

        call close_csv(writer, status)
        call fail_on_error(status)
    end subroutine end_table

    !> The comment lines that say what made a CSV file.
    subroutine put_origin(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_comment(writer, 'faststrip ' // version // ' rev ' // trim(revision))
        call put_comment(writer, 'compiler ' // compiler_name() // ', ' // compiler_flags())
    end subroutine put_origin
end module faststrip_command_program_console
