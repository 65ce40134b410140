!> Options of a subcommand: one table serves for parsing and for the help text.
module faststrip_command_program_options
    use faststrip_base_kinds, only: wp
    use faststrip_base_text, only: parse_real, parse_integer, integer_text
    use faststrip_files_digest, only: digest_of_file
    use faststrip_command_program_console, only: usage_error, say, printable, program_name
    use faststrip_command_program_files, only: take_input, take_output
    use faststrip_command_program_system, only: start_signals
    implicit none
    private

    public :: command_t, option_t
    public :: command_argument, need_nothing_more, refuse_subcommand, parse_command, given, &
        option_text, option_number, option_integer, option_word, option_pair, option_part, &
        refuse_value, given_options, has_option, any_number, most_parts, most_threads

    !> As many arguments more as the system lets a command line have.
    integer, parameter :: any_number = huge(1)
    !> Most parts of a work.
    ! Tuned [parts]. Origin: capacity: a name of each is kept, 100 bytes.
    integer, parameter :: most_parts = 100000
    !> Most threads.
    !> Tuned [threads]. Origin: capacity: more than any machine has cores, each with memory of its
    !> own.
    integer, parameter :: most_threads = 1024

    !> One option, `--name VALUE` or `--name=VALUE`; a flag has no value.
    type :: option_t
        character(len=20) :: name = ''        !! with its dashes
        character(len=16) :: value_name = ''  !! blank: a flag
        character(len=200) :: help = ''       !! lines, parted by line feeds
        logical :: reads = .false.            !! is its value a file, or folder, to read?
        logical :: writes = .false.           !! is it a file to write?
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
        logical :: reads = .true.                       !! are these files to read?
        integer :: n_words = 1                          !! words of the name on the command line
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

    !> End the program with a usage error if the command line has a second word.
    subroutine need_nothing_more()
        if (command_argument_count() > 1) &
            call usage_error('too many arguments: ' // command_argument(2), '')
    end subroutine need_nothing_more

    !> End the program with a usage error: its first word is neither a subcommand nor an option.
    subroutine refuse_subcommand()
        if (index(command_argument(1), '-') == 1) &
            call usage_error('unknown option: ' // command_argument(1), '')
        call usage_error('unknown subcommand: ' // command_argument(1), '')
    end subroutine refuse_subcommand

    !> Read the command line from behind the name on. Prints the help and ends the program if
    !> asked for it; ends it with a usage error for an unknown option, a missing value, a wrong
    !> number of arguments, or an output that is an input or another output.
    subroutine parse_command(command, n_arguments, n_optional)
        type(command_t), intent(inout) :: command   !! options and arguments are filled in
        integer, intent(in) :: n_arguments          !! how many arguments it takes
        integer, intent(in), optional :: n_optional !! how many more it may take

        character(len=:), allocatable :: word
        integer :: i, equals, at, n_more
        logical :: only_arguments

        allocate (command%arguments(0))
        only_arguments = .false.
        i = 1 + command%n_words
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
        n_more = 0
        if (present(n_optional)) n_more = n_optional
        if (size(command%arguments) - n_arguments > n_more) &
            call usage_error('too many arguments: ' &
                             // command%arguments(n_arguments + n_more + 1)%text, command%name)
        call start_signals(printable(working_on(command)))
        call take_files(command)
    end subroutine parse_command

    !> For the lines that tell of long work.
    function working_on(command) result(text)
        type(command_t), intent(in) :: command
        character(len=:), allocatable :: text

        integer :: i

        text = command%name
        do i = 1, size(command%arguments)
            text = text // ' ' // command%arguments(i)%text
        end do
    end function working_on

    !> Note what is read and written, and refuse to write what is read or written already.
    subroutine take_files(command)
        type(command_t), intent(in) :: command

        integer :: i

        do i = 1, size(command%options)
            associate (option => command%options(i))
                if (option%is_given .and. option%writes) &
                    call take_output(option%text, trim(option%name))
            end associate
        end do
        do i = 1, size(command%options)
            associate (option => command%options(i))
                if (option%is_given .and. option%reads) call take_input(option%text)
            end associate
        end do
        if (.not. command%reads) return
        do i = 1, size(command%arguments)
            call take_input(command%arguments(i)%text)
        end do
    end subroutine take_files

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
        integer :: i, from, cut

        call say('usage: ' // program_name() // ' ' // trim(command%name // ' ' // command%usage) &
                 // ' [options]')
        call say('')
        call say(command%about)
        call say('options:')
        do i = 1, size(command%options)
            associate (help => command%options(i)%help)
                left = trim(command%options(i)%name) // ' ' // command%options(i)%value_name
                from = 1
                do
                    cut = index(help(from:), new_line('a'))
                    if (cut == 0) exit
                    call say('  ' // left(:34) // help(from:from + cut - 2))
                    left = ''
                    from = from + cut
                end do
                call say('  ' // left(:34) // trim(help(from:)))
            end associate
        end do
        left = '--help'
        call say('  ' // left(:34) // 'this text')
    end subroutine print_help

    !> Does the subcommand know an option?
    pure logical function has_option(command, name)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes

        has_option = any(command%options%name == name)
    end function has_option

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

    !> The options that were given, with their values and, of files that are read, what is in them:
    !> two runs whose options agree do the same with the same arguments.
    function given_options(command, but_for) result(text)
        type(command_t), intent(in) :: command     !! parsed
        character(len=*), intent(in) :: but_for(:) !! options that do not count
        character(len=:), allocatable :: text      !! in the order of the table

        integer :: i

        text = ''
        do i = 1, size(command%options)
            associate (option => command%options(i))
                if (.not. option%is_given .or. any(but_for == option%name)) cycle
                if (len(text) > 0) text = text // ' '
                text = text // trim(option%name)
                if (option%value_name /= '') text = text // '=' // printable(option%text)
                if (option%reads) text = text // ' (SHA-256 ' &
                    // trim(digest_of_file(option%text)) // ')'
            end associate
        end do
    end function given_options

    !> The option's value as a finite real number; a usage error if it is none, or too small.
    real(wp) function option_number(command, name, default, above, least) result(value)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes
        real(wp), intent(in) :: default        !! if it was not given
        integer, intent(in), optional :: above !! it has to be larger
        integer, intent(in), optional :: least !! it has to be at least that

        character(len=:), allocatable :: what
        logical :: valid

        value = default
        if (.not. given(command, name)) return
        call parse_real(option_text(command, name, ''), value, valid)
        what = 'a finite number'
        if (present(above)) then
            what = 'a number above ' // integer_text(above)
            valid = valid .and. value > above
        else if (present(least)) then
            what = 'a number from ' // integer_text(least) // ' on'
            valid = valid .and. value >= least
        end if
        if (.not. valid) call refuse_value(command, name, what)
    end function option_number

    !> The option's value as a whole number; a usage error if it is none or out of range.
    integer function option_integer(command, name, default, least, most) result(value)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! with its dashes
        integer, intent(in) :: default         !! if it was not given
        integer, intent(in), optional :: least !! smallest allowed
        integer, intent(in), optional :: most  !! largest allowed

        character(len=:), allocatable :: what
        logical :: valid

        value = default
        if (.not. given(command, name)) return
        call parse_integer(option_text(command, name, ''), value, valid)
        what = 'a whole number'
        if (present(least)) then
            what = what // ' from ' // integer_text(least)
            if (.not. present(most)) what = what // ' on'
            valid = valid .and. value >= least
        end if
        if (present(most)) then
            what = what // ' to ' // integer_text(most)
            valid = valid .and. value <= most
        end if
        if (.not. valid) call refuse_value(command, name, what)
    end function option_integer

    !> Two numbers in the option's value; a usage error if they are none.
    subroutine option_pair(command, name, default, names, pair)
        type(command_t), intent(in) :: command  !! a parsed command
        character(len=*), intent(in) :: name    !! with its dashes
        character(len=*), intent(in) :: default !! if it was not given
        character(len=*), intent(in) :: names   !! of the two, with what parts them, as `LOW:HIGH`
        real(wp), intent(out) :: pair(2)        !! finite

        character(len=:), allocatable :: text
        integer :: mark, at
        logical :: valid(2)

        text = option_text(command, name, default)
        mark = scan(names, ':,')
        at = index(text, names(mark:mark))
        call parse_real(text(:max(at - 1, 0)), pair(1), valid(1))
        call parse_real(text(at + 1:), pair(2), valid(2))
        if (at == 0 .or. .not. all(valid)) &
            call refuse_value(command, name, names // ', two numbers')
    end subroutine option_pair

    !> Which part of how many `--part` names; a usage error if it is no part.
    subroutine option_part(command, part, parts)
        type(command_t), intent(in) :: command !! a parsed command
        integer, intent(out) :: part           !! from 1 on; 1 if the option was not given
        integer, intent(out) :: parts          !! how many

        character(len=:), allocatable :: text
        integer :: slash
        logical :: valid(2)

        part = 1
        parts = 1
        if (.not. given(command, '--part')) return
        text = option_text(command, '--part', '')
        slash = index(text, '/')
        call parse_integer(text(:max(slash - 1, 0)), part, valid(1))
        call parse_integer(text(slash + 1:), parts, valid(2))
        if (slash == 0 .or. .not. all(valid) .or. part < 1 .or. part > parts .or. &
            parts > most_parts) call refuse_value(command, '--part', 'k/K, a part and how many ' &
                // 'there are, k from 1 to K, K up to ' // integer_text(most_parts))
    end subroutine option_part

    !> The option's value, which has to be one of some words; a usage error if it is none.
    function option_word(command, name, default, words) result(word)
        type(command_t), intent(in) :: command   !! a parsed command
        character(len=*), intent(in) :: name     !! with its dashes
        character(len=*), intent(in) :: default  !! if it was not given
        character(len=*), intent(in) :: words(:) !! the words
        character(len=:), allocatable :: word

        character(len=:), allocatable :: what
        integer :: i

        word = option_text(command, name, default)
        if (.not. given(command, name) .or. any(words == word) .and. len_trim(word) > 0) return
        what = trim(words(1))
        do i = 2, size(words)
            if (i == size(words)) then
                what = what // ' or ' // trim(words(i))
            else
                what = what // ', ' // trim(words(i))
            end if
        end do
        call refuse_value(command, name, what)
    end function option_word

    !> End the program because the value of an option is none that it takes.
    subroutine refuse_value(command, name, what)
        type(command_t), intent(in) :: command !! a parsed command
        character(len=*), intent(in) :: name   !! of the option, with its dashes
        character(len=*), intent(in) :: what   !! its value must be that

        call usage_error(name // ' must be ' // what // ', got ''' &
                         // option_text(command, name, '') // '''', command%name)
    end subroutine refuse_value

    integer function find(command, name) result(at)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: name

        do at = 1, size(command%options)
            if (command%options(at)%name == name) return
        end do
        error stop 'faststrip: an option is asked for that is not in the table'
    end function find
end module faststrip_command_program_options
