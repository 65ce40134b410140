!> `faststrip bench`: what things cost and how accurate they are.
module faststrip_app_bench
    use faststrip_kinds, only: wp
    use faststrip_status, only: number_text
    use faststrip_app_console, only: usage_error
    use faststrip_app_options, only: command_t, option_t, parse_command, given, option_text, &
                                     option_integer, option_number
    use faststrip_app_bench_integral, only: bench_integral
    use faststrip_app_bench_normal, only: bench_normal, bench_normal_most_strips
    use faststrip_app_bench_accuracy, only: bench_accuracy
    use faststrip_app_bench_robust, only: bench_robust
    use faststrip_app_bench_convergence, only: bench_convergence
    use faststrip_app_bench_trade, only: bench_trade
    use faststrip_app_certify, only: run_certificate_study
    implicit none
    private

    public :: run_bench

contains

    !> Run the subcommand from the command line.
    subroutine run_bench()
        type(command_t) :: command
        character(len=:), allocatable :: what, file, folder
        integer :: rounds, most_strips
        real(wp) :: seconds

        command%name = 'bench'
        command%usage = 'WHAT'
        command%about = about()
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)'), &
            option_t('--rounds', 'N', 'integral: how often everything is timed, 1 to 1000' &
                     // ' (default 21)'), &
            option_t('--contacts', 'FOLDER', 'others: the contacts (default reference/contact)'), &
            option_t('--most-strips', 'N', 'normal, convergence: no more strips than that'), &
            option_t('--seconds', 'S', 'normal: for each number of strips (default 6)'), &
            option_t('--methods', 'FILE', 'trade: the methods (default' &
                     // ' reference/trade_methods.csv)'), &
            option_t('--quick', '', 'trade: few methods, few contacts')]
        call parse_command(command, 1)
        what = command%arguments(1)%text
        file = option_text(command, '-o', '-')
        rounds = option_integer(command, '--rounds', 21)
        if (rounds < 1 .or. rounds > 1000) &
            call usage_error('--rounds is not within 1 to 1000', command%name)
        folder = option_text(command, '--contacts', 'reference/contact')
        most_strips = option_integer(command, '--most-strips', bench_normal_most_strips)
        seconds = option_number(command, '--seconds', 6.0_wp)
        if (seconds < 0.0_wp) call usage_error('--seconds is negative: ' &
            // trim(number_text(seconds)), command%name)
        if (what /= 'trade') call refuse_options(command, what, &
                                                 [character(len=9) :: '--methods', '--quick'])
        select case (what)
        case ('integral')
            call refuse_options(command, what, &
                                [character(len=13) :: '--contacts', '--most-strips', '--seconds'])
            call bench_integral(file, rounds)
        case ('normal')
            call refuse_options(command, what, ['--rounds'])
            call bench_normal(file, folder, most_strips, seconds)
        case ('certificate')
            call refuse_options(command, what, [character(len=14) :: '--rounds', '--contacts', &
                                                '--most-strips', '--seconds'])
            call run_certificate_study(file)
        case ('accuracy')
            call refuse_options(command, what, &
                                [character(len=13) :: '--rounds', '--most-strips', '--seconds'])
            call bench_accuracy(file, folder)
        case ('trade')
            call refuse_options(command, what, [character(len=13) :: '--rounds', '--most-strips', &
                                                '--seconds'])
            call bench_trade(file, option_text(command, '--methods', &
                                               'reference/trade_methods.csv'), folder, &
                             given(command, '--quick'))
        case ('robust')
            call refuse_options(command, what, &
                                [character(len=13) :: '--rounds', '--most-strips', '--seconds'])
            call bench_robust(file, folder)
        case ('convergence')
            call refuse_options(command, what, [character(len=9) :: '--rounds', '--seconds'])
            call bench_convergence(file, folder, most_strips)
        case default
            call usage_error('there is no bench called ' // what, command%name)
        end select
    end subroutine run_bench

    subroutine refuse_options(command, what, names)
        type(command_t), intent(in) :: command
        character(len=*), intent(in) :: what, names(:)

        integer :: i

        do i = 1, size(names)
            if (given(command, trim(names(i)))) &
                call usage_error(trim(names(i)) // ' goes without ' // what, command%name)
        end do
    end subroutine refuse_options

    function about() result(text)
        character(len=:), allocatable :: text

        character(len=*), parameter :: lines(20) = [character(len=81) :: &
            'integral: nanoseconds an influence number costs and its largest relative error,', &
            'by the published polynomial (Horner, exp), fresh fits, the closed form and GSL;', &
            'one by one (scalar) and for n = 0 to 20 at once (row). CSV:', &
            'method,n,b,loop,ns,ratio,rel_err,flags,compiler,cpu; medians; ratio: to the', &
            'published polynomial in the same loop.', &
            'normal: microseconds the strip solver takes with 5 to 400 strips, from nothing', &
            '(cold) and from the previous step (load changed by 5 %, wheelset moved by', &
            '0.05 mm), beside FASTSIM on 50 x 50 elements. Processor time, medians;', &
            'OPENBLAS_NUM_THREADS=1 keeps it to one core.', &
            'accuracy: its errors against CONTACT with 15 strips and auto.', &
            'convergence: its errors with 5 to 81 strips, against 301 strips, and against', &
            'Hertz on ellipses.', &
            'robust: the fallback''s errors against CONTACT and Hertz; kinks and flat tops with', &
            '15 and 31 strips and auto against 401.', &
            'certificate: how often estimated errors bound the true ones (minutes; with -o', &
            'the shares on stdout).', &
            'trade: errors and microseconds of many methods and resolutions, one row per', &
            'contact and method, on these contacts and 161 Hertz ellipses. Columns of', &
            'FILE: see reference/trade_methods.csv.', &
            'normal, accuracy, robust and convergence work on the paper''s 20 contacts.']
        integer :: i

        text = ''
        do i = 1, size(lines)
            text = text // trim(lines(i)) // new_line('a')
        end do
    end function about
end module faststrip_app_bench
