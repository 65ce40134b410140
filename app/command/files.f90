!> What a run reads and what it writes: no output may be an input or another output.
module faststrip_command_files
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: temporary_name, temporary_prefix, temporary_ending, &
                                   most_temporaries
    use faststrip_command_console, only: fail, usage_error, exit_bad_input, exit_usage
    use faststrip_command_system, only: identity_t, identify, is_fed, keep_in_mind, &
                                        remove_leftovers, kind_none, kind_file, kind_folder, &
                                        kind_pipe
    implicit none
    private

    public :: take_input, take_output, trouble_t, check_input

    !> Why a file cannot be read in this run.
    type :: trouble_t
        integer :: code = 0                    !! exit code; 0: it can
        character(len=:), allocatable :: words !! one line
    end type trouble_t

    ! A named pipe into which nobody writes would be waited for without end.
    integer, parameter :: patience = 5 ! s

    !> A file of this run.
    type :: used_t
        character(len=:), allocatable :: path   !! as it was given
        character(len=:), allocatable :: option !! that names it; empty: an argument or a file does
        type(identity_t) :: identity
    end type used_t

    type(used_t), allocatable :: outputs(:)

contains

    !> Look at a file, or a folder of files, that will be read, once the outputs are noted. Ends
    !> the program if it is an output as well, or a pipe that nobody feeds.
    subroutine take_input(path)
        character(len=*), intent(in) :: path !! as it was given

        type(trouble_t) :: trouble

        call check_input(path, trouble)
        if (trouble%code == exit_usage) call usage_error(trouble%words, '')
        if (trouble%code /= 0) call fail(trouble%code, trouble%words)
    end subroutine take_input

    !> The same without ending the program, for one of several threads.
    subroutine check_input(path, trouble)
        character(len=*), intent(in) :: path     !! as it was given
        type(trouble_t), intent(out) :: trouble  !! for who ends the program

        type(used_t) :: input
        integer :: i

        if (.not. allocated(outputs)) allocate (outputs(0))
        input%path = path
        input%option = ''
        input%identity = identify(path)
        if (input%identity%kind == kind_none) return ! whoever opens it says so
        do i = 1, size(outputs)
            call check_overwriting(outputs(i), input, trouble)
            if (trouble%code /= 0) return
        end do
        if (input%identity%kind == kind_pipe .and. index(path, '/dev/') /= 1 &
            .and. index(path, '/proc/') /= 1) then
            if (.not. is_fed(path, patience)) &
                trouble = trouble_t(exit_bad_input, 'nobody writes into the pipe for ' &
                                    // integer_text(patience) // ' s: ' // path)
        end if
    end subroutine check_input

    !> Note a file that will be written, before anything is read. Ends the program with a usage
    !> error if it is another output. What an earlier run that was killed left beside it is
    !> removed, and so is what this run leaves if it is.
    subroutine take_output(path, option)
        character(len=*), intent(in) :: path   !! as it was given
        character(len=*), intent(in) :: option !! that names it

        type(used_t) :: output
        character(len=:), allocatable :: folder
        integer :: i

        if (.not. allocated(outputs)) allocate (outputs(0))
        output%path = path
        output%option = option
        if (path == '-') output%path = '/dev/stdout'
        output%identity = identify(output%path)
        select case (output%identity%kind)
        case (kind_file)
        case (kind_none)
            if (len(output%identity%path) == 0) return ! whoever opens it says why
        case (kind_pipe)
            if (index(output%path, '/dev/') /= 1 .and. index(output%path, '/proc/') /= 1) &
                call usage_error(option // ' must be a file, got the pipe ' // path, '')
            return
        case default
            return
        end select
        do i = 1, size(outputs)
            if (.not. are_same(output%identity, outputs(i)%identity)) cycle
            if (index(output%path, '/dev/') == 1 .and. index(outputs(i)%path, '/dev/') == 1) cycle
            call usage_error(outputs(i)%option // ' and ' // option // &
                             ' must be different files, got ' // outputs(i)%path // ' and ' &
                             // path, '')
        end do
        call append_output(output)
        if (index(output%path, '/dev/') == 1) return
        folder = temporary_name(path, 1)
        folder = folder(:index(folder, '/', back=.true.))
        if (len(folder) == 0) folder = '.'
        call remove_leftovers(folder, temporary_prefix(), temporary_ending)
        do i = 1, most_temporaries
            call keep_in_mind(temporary_name(path, i))
        end do
    end subroutine take_output

    subroutine append_output(output)
        type(used_t), intent(in) :: output

        type(used_t), allocatable :: longer(:)
        integer :: n

        n = size(outputs)
        allocate (longer(n + 1))
        longer(:n) = outputs
        longer(n + 1) = output
        call move_alloc(longer, outputs)
    end subroutine append_output

    !> An output must neither be an input nor a file in a folder of inputs.
    subroutine check_overwriting(output, input, trouble)
        type(used_t), intent(in) :: output, input
        type(trouble_t), intent(inout) :: trouble

        character(len=:), allocatable :: folder

        if (input%identity%kind == kind_file) then
            if (.not. are_same(output%identity, input%identity)) return
            if (input%path == output%path) then
                trouble = trouble_t(exit_usage, output%option // ' must not be a file that is ' &
                                    // 'read, got ' // output%path)
            else
                trouble = trouble_t(exit_usage, output%option // ' must not be a file that is ' &
                                    // 'read, got ' // output%path // ', which is ' // input%path)
            end if
        else if (input%identity%kind == kind_folder .and. output%identity%kind == kind_file) then
            folder = input%identity%path // '/'
            if (index(output%identity%path, folder) == 1) &
                trouble = trouble_t(exit_usage, output%option // ' must not be a file that may ' &
                                    // 'be read, got ' // output%path // ' in the folder ' &
                                    // input%path)
        end if
    end subroutine check_overwriting

    logical function are_same(one, other)
        type(identity_t), intent(in) :: one, other

        if (one%kind == kind_none .or. other%kind == kind_none) then
            are_same = len(one%path) > 0 .and. one%path == other%path
        else
            are_same = all(one%numbers == other%numbers)
        end if
    end function are_same
end module faststrip_command_files
