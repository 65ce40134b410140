!> What the program says to people: errors and notes on stderr, help and version on stdout.
module faststrip_app_console
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit, int64
    use faststrip_status, only: status_t, is_error, st_no_convergence
    use faststrip_csv, only: csv_writer_t, put_comment
    use faststrip_app_machine, only: compiler_name, compiler_flags
    use faststrip_app_revision, only: revision
    implicit none
    private

    public :: fail, fail_on_error, usage_error, note, say, progress
    public :: version_text, put_origin
    public :: exit_bad_input, exit_usage, exit_no_convergence

    integer, parameter :: exit_bad_input = 1
    integer, parameter :: exit_usage = 2
    integer, parameter :: exit_no_convergence = 3

    character(len=*), parameter :: version = '0.1.0'

contains

    !> End the program with one line on stderr.
    subroutine fail(code, text)
        integer, intent(in) :: code          !! exit code
        character(len=*), intent(in) :: text !! one line

        call note(text)
        stop code, quiet=.true.
    end subroutine fail

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

    !> End the program because it was called in a wrong way.
    subroutine usage_error(text, command)
        character(len=*), intent(in) :: text    !! what is wrong, with the offending value
        character(len=*), intent(in) :: command !! subcommand whose help serves; may be empty

        if (len(command) > 0) then
            call fail(exit_usage, text // '; see faststrip ' // command // ' --help')
        else
            call fail(exit_usage, text // '; see faststrip --help')
        end if
    end subroutine usage_error

    !> One line on stderr.
    subroutine note(text)
        character(len=*), intent(in) :: text !! one line

        write (error_unit, '(2a)') 'faststrip: ', text
    end subroutine note

    !> One line on stdout.
    subroutine say(text)
        character(len=*), intent(in) :: text !! one line

        write (output_unit, '(a)') text
    end subroutine say

    !> A running count on stderr for long work: at most one line a second, none in the first.
    subroutine progress(what, done, total)
        character(len=*), intent(in) :: what !! what is being counted
        integer, intent(in) :: done          !! how many are done
        integer, intent(in) :: total         !! how many there are

        integer(int64), save :: last = -1
        integer(int64) :: now, rate

        call system_clock(now, rate)
        if (last < 0) last = now
        if (now - last < rate) return
        last = now
        write (error_unit, '(3a,i0,a,i0)') 'faststrip: ', what, ' ', done, ' of ', total
    end subroutine progress

    !> Name, version and revision of the program.
    function version_text() result(text)
        character(len=:), allocatable :: text

        text = 'faststrip ' // version // ' rev ' // trim(revision)
    end function version_text

    !> The comment lines that say what made a CSV file.
    subroutine put_origin(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_comment(writer, version_text())
        call put_comment(writer, 'compiler ' // compiler_name() // ', ' // compiler_flags())
    end subroutine put_origin
end module faststrip_app_console
