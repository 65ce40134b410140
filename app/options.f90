!> Options of a subcommand: one table serves for parsing and for the help text.
module faststrip_app_options
    use faststrip_kinds, only: wp
    use faststrip_text, only: parse_real, parse_integer
    use faststrip_app_console, only: usage_error, say
    implicit none
    private

    public :: command_t, option_t, argument_t
    public :: command_argument, parse_command, given, option_text, option_number, option_integer

    !> One option, `--name VALUE` or `--name=VALUE`; a flag has no value.
    type :: option_t
        character(len=20) :: name = ''        !! with its dashes
        character(len=16) :: value_name = ''  !! blank: a flag
        character(len=160) :: help = ''       !! one line, or two parted by a line feed
        logical :: is_given = .false.         !! was it on the command line?
        character(len=:), allocatable :: text !! its value
    end type option_t

    !> One argument that is no option.
    type :: argument_t
        character(len=:), allocatable :: text
    end type argument_t

    !> A subcommand: what it is called, what it takes.
    type :: command_t
        character(len=:), allocatable :: name           !! as typed
        character(len=:), allocatable :: usage          !! what follows the name
        character(len=:), allocatable :: about          !! what it does; lines end with a newline
        type(option_t), allocatable :: options(:)       !! what it knows
        type(argument_t), allocatable :: arguments(:)   !! what it was given besides
    end type command_t

contains

    !> Argument i of the command line, whole.
    function command_argument(i) result(text)
        integer, intent(in) :: i              !! 1 to command_argument_count()
        character(len=:), allocatable :: text

        integer :: length

        call get_command_argument(i, length=length)
        allocate (character(len=length) :: text)
        if (length > 0) call get_command_argument(i, text)
    end function command_argument

    !> Read the command line from its second word on. Prints the help and ends the program if
    !> asked for it; ends it with a usage error for an unknown option, a missing value or a wrong
    !> number of arguments.
    subroutine parse_command(command, n_arguments, n_optional)
        type(command_t), intent(inout) :: command   !! options and arguments are filled in
        integer, intent(in) :: n_arguments          !! how many arguments it takes
        integer, intent(in), optional :: n_optional !! how many more it may take

        character(len=:), allocatable :: word
        integer :: i, equals, at, n_most
        logical :: only_arguments

        allocate (command%arguments(0))
        only_arguments = .false.
        i = 2
        do while (i <= command_argument_count())
            word = command_argument(i)
            i = i + 1
            if (only_arguments .or. word == '-' .or. index(word, '-') /= 1) then
                call add_argument(command, word)
                cycle
            else if (word == '--') then
                only_arguments = .true.
                cycle
            else if (word == '--help' .or. word == '-h') then
                call print_help(command)
                stop 0, quiet=.true.
            end if
            equals = index(word, '=')
            if (equals == 0) equals = len(word) + 1
            do at = 1, size(command%options)
                if (command%options(at)%name == word(:equals - 1)) exit
            end do
            if (at > size(command%options)) &
                call usage_error('unknown option: ' // word, command%name)
            associate (option => command%options(at))
                if (option%is_given) &
                    call usage_error('option given twice: ' // trim(option%name), command%name)
                option%is_given = .true.
                if (option%value_name == '') then
                    if (equals <= len(word)) &
                        call usage_error('option takes no value: ' // word, command%name)
                else if (equals <= len(word)) then
                    option%text = word(equals + 1:)
                else
                    if (i > command_argument_count()) &
                        call usage_error('option needs a value: ' // word, command%name)
                    option%text = command_argument(i)
                    i = i + 1
                end if
            end associate
        end do
        if (size(command%arguments) < n_arguments) &
            call usage_error('missing ' // command%usage, command%name)
        n_most = n_arguments
        if (present(n_optional)) n_most = n_most + n_optional
        if (size(command%arguments) > n_most) &
            call usage_error('too many arguments: ' // command%arguments(n_most + 1)%text, &
                             command%name)
    end subroutine parse_command

    !> Done without a constructor, whose copy of the text the compiler does not give back.
    subroutine add_argument(command, word)
        type(command_t), intent(inout) :: command
        character(len=*), intent(in) :: word

        type(argument_t), allocatable :: arguments(:)
        integer :: n

        n = size(command%arguments)
        allocate (arguments(n + 1))
        arguments(:n) = command%arguments
        arguments(n + 1)%text = word
        call move_alloc(arguments, command%arguments)
    end subroutine add_argument

    subroutine print_help(command)
        type(command_t), intent(in) :: command

        character(len=38) :: left
        integer :: i, cut

        call say('usage: faststrip ' // trim(command%name // ' ' // command%usage) &
                 // ' [options]')
        call say('')
        call say(command%about)
        call say('options:')
        do i = 1, size(command%options)
            left = trim(command%options(i)%name) // ' ' // command%options(i)%value_name
            cut = index(command%options(i)%help, new_line('a'))
            if (cut > 0) then
                call say('  ' // left(:34) // command%options(i)%help(:cut - 1))
                left = ''
            end if
            call say('  ' // left(:34) // trim(command%options(i)%help(cut + 1:)))
        end do
        left = '--help'
        call say('  ' // left(:34) // 'this text')
    end subroutine print_help

    !> Was the option on the command line?
    logical function given(command, name)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes

        given = command%options(find(command, name))%is_given
    end function given

    !> The option's value, or a default if it was not given.
    function option_text(command, name, default) result(text)
        type(command_t), intent(in) :: command  !! a parsed command
        character(len=*), intent(in) :: name    !! with its dashes
        character(len=*), intent(in) :: default !! if it was not given
        character(len=:), allocatable :: text

        text = default
        if (given(command, name)) text = command%options(find(command, name))%text
    end function option_text

    !> The option's value as a finite real number; a usage error if it is none.
    real(wp) function option_number(command, name, default) result(value)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes
        real(wp), intent(in) :: default        !! if it was not given

        logical :: valid

        value = default
        if (.not. given(command, name)) return
        call parse_real(option_text(command, name, ''), value, valid)
        if (.not. valid) call usage_error('not a finite number: ' // name // ' ' &
                                          // option_text(command, name, ''), command%name)
    end function option_number

    !> The option's value as a whole number; a usage error if it is none.
    integer function option_integer(command, name, default) result(value)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes
        integer, intent(in) :: default         !! if it was not given

        logical :: valid

        value = default
        if (.not. given(command, name)) return
        call parse_integer(option_text(command, name, ''), value, valid)
        if (.not. valid) call usage_error('not a whole number: ' // name // ' ' &
                                          // option_text(command, name, ''), command%name)
    end function option_integer

    integer function find(command, name) result(at)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: name

        do at = 1, size(command%options)
            if (command%options(at)%name == name) return
        end do
        error stop 'faststrip: an option is asked for that is not in the table'
    end function find
end module faststrip_app_options
