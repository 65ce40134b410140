!> What a measurement was made on.
module faststrip_command_program_machine
    use, intrinsic :: iso_fortran_env, only: compiler_version, compiler_options
    implicit none
    private

    public :: cpu_name, compiler_name, compiler_flags, machine_words

contains

    !> Model name of the first processor; `unknown` where /proc/cpuinfo does not tell.
    function cpu_name() result(text)
        character(len=:), allocatable :: text

        character(len=256) :: line
        integer :: unit, code

        text = 'unknown'
        open (newunit=unit, file='/proc/cpuinfo', status='old', action='read', iostat=code)
        if (code /= 0) return
        do
            read (unit, '(a)', iostat=code) line
            if (code /= 0) exit
            if (index(line, 'model name') /= 1 .or. index(line, ':') == 0) cycle
            text = trim(adjustl(line(index(line, ':') + 1:)))
            exit
        end do
        close (unit)
    end function cpu_name

    !> Name and version of the compiler.
    function compiler_name() result(text)
        character(len=:), allocatable :: text

        text = compiler_version()
    end function compiler_name

    !> The compiler options that matter for times: those that start with -O, -m or -f.
    function compiler_flags() result(text)
        character(len=:), allocatable :: text

        character(len=:), allocatable :: all_options
        integer :: from, to

        all_options = compiler_options() // ' '
        text = ''
        from = 1
        do while (from <= len(all_options))
            to = from + index(all_options(from:), ' ') - 2
            if (to > from + 1 .and. scan(all_options(from + 1:from + 1), 'Omf') == 1 &
                .and. all_options(from:from) == '-' &
                .and. index(all_options(from:to), '-fpre-include') == 0) &
                text = text // all_options(from:to) // ' '
            from = to + 2
        end do
        text = trim(text)
    end function compiler_flags

    !> All of that: flags, compiler and processor.
    function machine_words() result(words)
        character(len=:), allocatable :: words(:)

        integer :: longest

        longest = max(len(compiler_flags()), len(compiler_name()), len(cpu_name()))
        allocate (character(len=longest) :: words(3))
        words(1) = compiler_flags()
        words(2) = compiler_name()
        words(3) = cpu_name()
    end function machine_words
end module faststrip_command_program_machine
