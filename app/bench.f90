!> `faststrip bench`: what things cost.
module faststrip_app_bench
    use faststrip_app_console, only: usage_error
    use faststrip_app_options, only: command_t, option_t, parse_command, option_text, &
                                     option_integer
    use faststrip_app_bench_integral, only: bench_integral
    implicit none
    private

    public :: run_bench

contains

    !> Run the subcommand from the command line.
    subroutine run_bench()
        type(command_t) :: command
        integer :: rounds

        command%name = 'bench'
        command%usage = 'integral'
        command%about = &
            'integral: nanoseconds an influence number costs and its largest relative error, by' &
            // new_line('a') // 'the published polynomial (Horner, exp), fresh fits, the closed' &
            // new_line('a') // 'form and GSL; one by one (scalar) and for n = 0 to 20 at once' &
            // new_line('a') // '(row). CSV: method,n,b,loop,ns,ratio,rel_err,flags,compiler,cpu;' &
            // new_line('a') // 'medians; ratio: to the published polynomial in the same loop.' &
            // new_line('a')
        command%options = [ &
            option_t('--rounds', 'N', 'how often everything is timed, 1 to 1000 (default 21)'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)')]
        call parse_command(command, 1)
        rounds = option_integer(command, '--rounds', 21)
        if (rounds < 1 .or. rounds > 1000) &
            call usage_error('--rounds is not within 1 to 1000', command%name)
        if (command%arguments(1)%text /= 'integral') &
            call usage_error('nothing to time is called ' // command%arguments(1)%text, &
                             command%name)
        call bench_integral(option_text(command, '-o', '-'), rounds)
    end subroutine run_bench
end module faststrip_app_bench
