!> What a run reads and what it writes: no file that is written, outputs and what is made beside
!> them on the way, may be an input or another one of these. All of them are known before anything
!> is opened; inputs that rows name are compared when they are read.
!>
!> What killed runs have left is removed when a run ends well: then all its inputs are known.
module faststrip_command_program_files
    use, intrinsic :: iso_c_binding, only: c_long_long
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: name_temporary, find_prefix, temporary_ending, &
                                   most_temporaries
    use faststrip_command_program_console, only: fail, usage_error, exit_bad_input, exit_usage
    use faststrip_command_program_system, only: identity_t, identify, is_fed, keep_in_mind, &
                                                name_kind, remove_leftovers, make_folders, &
                                                kind_none, kind_file, kind_folder, kind_pipe
    implicit none
    private

    public :: take_input, take_output, take_beside, check_beside, trouble_t, check_input
    public :: spare_input, clear_leftovers

    !> Why a file cannot be read in this run.
    type :: trouble_t
        integer :: code = 0                    !! exit code; 0: it can
        character(len=:), allocatable :: words !! one line
    end type trouble_t

    ! Tuned [s]: a named pipe into which nobody writes would be waited for without end. Origin:
    ! chosen.
    integer, parameter :: patience = 5

    !> A file of this run.
    type :: used_t
        character(len=:), allocatable :: path   !! as it was given
        character(len=:), allocatable :: option !! that names it; empty: an argument or a file does
        character(len=:), allocatable :: beside !! the option whose output needs it; empty: none
        logical :: is_beginning = .false.      !! do names begin so, with a digit behind?
        type(identity_t) :: identity
    end type used_t

    type :: used_list_t
        type(used_t), allocatable :: files(:)
        integer :: n = 0 ! that count
    end type used_list_t

    type(used_list_t) :: inputs, outputs ! what is made beside outputs is among these
    ! Inputs that have the names of temporary files, whosever they are.
    integer(c_long_long), allocatable :: spared(:, :)

contains

    !> Look at a file, or a folder of files, that will be read, once the outputs are noted. Ends
    !> the program if it is an output as well, or a pipe that nobody feeds.
    subroutine take_input(path)
        character(len=*), intent(in) :: path !! as it was given

        type(trouble_t) :: trouble

        type(used_t) :: input

        call check_input(path, trouble)
        call end_on_trouble(trouble)
        input = used_of(path, '')
        if (input%identity%kind /= kind_none) call append(inputs, input)
    end subroutine take_input

    subroutine end_on_trouble(trouble)
        type(trouble_t), intent(in) :: trouble

        if (trouble%code == exit_usage) call usage_error(trouble%words, '')
        if (trouble%code /= 0) call fail(trouble%code, trouble%words)
    end subroutine end_on_trouble

    ! A file by its name.
    function used_of(path, option) result(used)
        character(len=*), intent(in) :: path, option
        type(used_t) :: used

        used%path = path
        used%option = option
        used%beside = ''
        used%identity = identify(path)
    end function used_of

    !> The same without ending the program, for one of several threads.
    subroutine check_input(path, trouble)
        character(len=*), intent(in) :: path     !! as it was given
        type(trouble_t), intent(out) :: trouble  !! for who ends the program

        type(used_t) :: input
        integer :: i

        input = used_of(path, '')
        if (input%identity%kind == kind_none) return ! whoever opens it says so
        do i = 1, outputs%n
            call check_overwriting(outputs%files(i), input, trouble)
            if (trouble%code /= 0) return
        end do
        call spare(input%identity)
        if (input%identity%kind == kind_pipe .and. index(path, '/dev/') /= 1 &
            .and. index(path, '/proc/') /= 1) then
            if (.not. is_fed(path, patience)) &
                trouble = trouble_t(exit_bad_input, 'nobody writes into the pipe for ' &
                                    // integer_text(patience) // ' s: ' // path)
        end if
    end subroutine check_input

    !> A file that is read stays, even if it has the name of a temporary file.
    subroutine spare_input(path)
        character(len=*), intent(in) :: path !! as it was given

        call spare(identify(path))
    end subroutine spare_input

    subroutine spare(identity)
        type(identity_t), intent(in) :: identity

        integer(c_long_long), allocatable :: longer(:, :)
        character(len=:), allocatable :: prefix
        integer :: n

        call find_prefix(prefix)
        if (index(identity%path, '/' // prefix) == 0) return
        !$omp critical (spared_inputs)
        n = 0
        if (allocated(spared)) n = size(spared, 2)
        allocate (longer(2, n + 1))
        if (n > 0) longer(:, :n) = spared
        longer(:, n + 1) = identity%numbers
        call move_alloc(longer, spared)
        !$omp end critical (spared_inputs)
    end subroutine spare

    !> Note a file that will be written, before anything is opened. Ends the program with a usage
    !> error if it is an input or another output. What this run leaves beside it if it is killed by
    !> a signal is removed.
    subroutine take_output(path, option)
        character(len=*), intent(in) :: path   !! as it was given
        character(len=*), intent(in) :: option !! that names it

        type(used_t) :: output
        type(trouble_t) :: trouble
        character(len=:), allocatable :: temporary
        integer :: i

        ! Before the name is looked up, so that two outputs in a new folder are distinguished.
        if (index(path, '/dev/') /= 1) call make_folders(path)
        output = used_of(path, option)
        if (path == '-') output = used_of('/dev/stdout', option)
        select case (output%identity%kind)
        case (kind_file)
        case (kind_none)
            if (len(output%identity%path) == 0) then
                if (name_kind(path) /= kind_none) call usage_error(option // ' must be a file, ' &
                    // 'got links without an end: ' // path, '')
                return ! whoever opens it says why
            end if
        case (kind_pipe)
            if (index(output%path, '/dev/') /= 1 .and. index(output%path, '/proc/') /= 1) &
                call usage_error(option // ' must be a file, got the pipe ' // path, '')
            return
        case default
            return
        end select
        do i = 1, outputs%n
            associate (other => outputs%files(i))
                if (.not. are_same(output%identity, other%identity)) cycle
                if (index(output%path, '/dev/') == 1 .and. index(other%path, '/dev/') == 1) cycle
                call usage_error(other%option // ' and ' // option // ' must be different files,' &
                                 // ' got ' // other%path // ' and ' // path, '')
            end associate
        end do
        do i = 1, inputs%n
            call check_overwriting(output, inputs%files(i), trouble)
            call end_on_trouble(trouble)
        end do
        call append(outputs, output)
        if (index(output%path, '/dev/') == 1) return
        do i = 1, most_temporaries
            ! What is there by such a name is no file of this run.
            call name_temporary(path, i, temporary)
            if (name_kind(temporary) == kind_none) call keep_in_mind(temporary)
        end do
    end subroutine take_output

    !> Note a file that may be made beside an output. Ends the program with a usage error if it is
    !> an input or an output.
    subroutine take_beside(path, option, is_beginning)
        character(len=*), intent(in) :: path   !! of the file, or how the names of some begin
        character(len=*), intent(in) :: option !! that names the output
        logical, intent(in), optional :: is_beginning !! is it a beginning? Digits follow

        type(used_t) :: file
        integer :: i

        call check_beside(path, option, is_beginning)
        file = used_of(path, option)
        file%beside = option
        if (present(is_beginning)) file%is_beginning = is_beginning
        do i = 1, outputs%n
            if (are_same(file%identity, outputs%files(i)%identity)) &
                call usage_error('files made beside ' // option // ' must be no outputs, got ' &
                                 // path // ' and ' // outputs%files(i)%path, '')
        end do
        call append(outputs, file)
    end subroutine take_beside

    !> End the program with a usage error if a file beside an output is an input.
    subroutine check_beside(path, option, is_beginning)
        character(len=*), intent(in) :: path, option  !! as for `take_beside`
        logical, intent(in), optional :: is_beginning !! the same

        type(used_t) :: file
        type(trouble_t) :: trouble
        integer :: i

        if (.not. present(is_beginning) .and. name_kind(path) == kind_none) return
        file = used_of(path, option)
        file%beside = option
        if (present(is_beginning)) file%is_beginning = is_beginning
        do i = 1, inputs%n
            call check_overwriting(file, inputs%files(i), trouble)
            call end_on_trouble(trouble)
        end do
    end subroutine check_beside

    !> Remove what killed runs have left beside the outputs. For a run that ends well: what it has
    !> read stays.
    subroutine clear_leftovers()
        character(len=:), allocatable :: folder, prefix
        integer :: i

        if (.not. allocated(spared)) allocate (spared(2, 0))
        call find_prefix(prefix)
        do i = 1, outputs%n
            associate (output => outputs%files(i))
                if (index(output%path, '/dev/') == 1 .or. len(output%beside) > 0) cycle
                call name_temporary(output%path, 1, folder)
            end associate
            folder = folder(:index(folder, '/', back=.true.))
            if (len(folder) == 0) folder = '.'
            call remove_leftovers(folder, prefix, temporary_ending, spared)
        end do
    end subroutine clear_leftovers

    subroutine append(list, used)
        type(used_list_t), intent(inout) :: list
        type(used_t), intent(in) :: used

        type(used_t), allocatable :: longer(:)

        if (.not. allocated(list%files)) allocate (list%files(8))
        if (list%n == size(list%files)) then
            allocate (longer(2*list%n))
            longer(:list%n) = list%files
            call move_alloc(longer, list%files)
        end if
        list%n = list%n + 1
        list%files(list%n) = used
    end subroutine append

    !> What is written must neither be an input nor a file in a folder of inputs.
    subroutine check_overwriting(output, input, trouble)
        type(used_t), intent(in) :: output, input
        type(trouble_t), intent(inout) :: trouble

        character(len=:), allocatable :: folder, what, got

        what = output%option // ' must not be a file'
        if (len(output%beside) > 0) what = 'files made beside ' // output%beside // ' must be none'
        got = output%path
        if (input%identity%kind == kind_file) then
            if (output%is_beginning) then
                if (.not. begins(input%identity%path, output%identity%path)) return
                got = input%path
            else if (.not. are_same(output%identity, input%identity)) then
                return
            end if
            if (input%path /= got) got = got // ', which is ' // input%path
            trouble = trouble_t(exit_usage, what // ' that is read, got ' // got)
        else if (input%identity%kind == kind_folder .and. output%identity%kind == kind_file) then
            folder = input%identity%path // '/'
            if (index(output%identity%path, folder) == 1) &
                trouble = trouble_t(exit_usage, what // ' that may be read, got ' // got &
                                    // ' in the folder ' // input%path)
        end if
    end subroutine check_overwriting

    ! Does a path begin with some words and a digit?
    pure logical function begins(path, words)
        character(len=*), intent(in) :: path, words

        begins = len(words) > 0 .and. len(path) > len(words)
        if (begins) begins = path(:len(words)) == words .and. &
                             scan(path(len(words) + 1:len(words) + 1), '0123456789') == 1
    end function begins

    logical function are_same(one, other)
        type(identity_t), intent(in) :: one, other

        if (one%kind == kind_none .or. other%kind == kind_none) then
            are_same = len(one%path) > 0 .and. one%path == other%path
        else
            are_same = all(one%numbers == other%numbers)
        end if
    end function are_same
end module faststrip_command_program_files
