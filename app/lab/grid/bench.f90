!> `faststrip-lab bench`: what things cost and how accurate they are.
module faststrip_lab_grid_bench
    use faststrip_base_kinds, only: wp
    use faststrip_command_program_console, only: usage_error
    use faststrip_command_program_files, only: take_input
    use faststrip_command_program_options, only: command_t, option_t, parse_command, given, &
                                                 option_text, option_integer, option_number, &
                                                 option_word
    use faststrip_lab_studies_integral, only: bench_integral
    use faststrip_lab_grid_normal, only: bench_normal, bench_normal_most_strips
    use faststrip_lab_grid_steps, only: bench_steps
    use faststrip_lab_grid_speed, only: bench_speed
    use faststrip_lab_studies_reference, only: bench_reference, bench_reference_most_elements
    use faststrip_lab_grid_errors, only: bench_accuracy, bench_convergence, bench_robust
    use faststrip_lab_studies_kalker, only: bench_kalker
    use faststrip_lab_grid_tangential, only: bench_tangential
    use faststrip_lab_grid_tang, only: bench_tang, bench_tang_most_elements
    use faststrip_lab_extremes, only: bench_extremes, extreme_parts
    use faststrip_lab_studies_rolling, only: bench_rolling
    use faststrip_lab_studies_subsurface, only: bench_subsurface
    use faststrip_lab_grid_forces, only: bench_forces
    use faststrip_lab_studies_correction, only: bench_correction
    use faststrip_lab_grid_examples, only: bench_examples
    use faststrip_lab_grid_trade, only: bench_trade
    use faststrip_lab_studies_host, only: bench_host
    use faststrip_lab_studies_estimates, only: run_estimates_study
    use faststrip_lab_checkout, only: in_checkout
    implicit none
    private

    public :: run_bench

    character, parameter :: nl = new_line('a')

    !> A bench.
    type :: bench_t
        character(len=12) :: name = ''
        character(len=80) :: options = '' !! it takes, beside -o
        character(len=360) :: help = ''   !! what it does
    end type bench_t

    !> All of them.
    type(bench_t), parameter :: benches(*) = [ &
        bench_t('integral', '--rounds', &
                'nanoseconds an influence coefficient costs, its largest relative error, by ' &
                // 'the published polynomial (Horner, exp), fresh fits, the closed form and GSL; ' &
                // 'one by one (scalar) and for n = 0 to 20 at once (row). ns and ratio are ' &
                // 'medians; ratio: to the published polynomial in the same loop'), &
        bench_t('normal', '--contacts --most-strips --seconds', &
                'microseconds the strip solver takes with 5 to 400 strips, cold and from the ' &
                // 'previous step (load changed by 5 %, wheelset moved by 0.05 mm), beside ' &
                // 'FASTSIM on 50 x 50 elements'), &
        bench_t('steps', '--contacts --scenes --rounds --strips', &
                'microseconds of the next solution of a history by 15 strips: 2.5 % steps of ' &
                // 'the load, 0.1 mm steps of the wheelset, both with 5 % of load; beside each ' &
                // 'the cold solution and errors against one to all digits; then contacts and ' &
                // 'scenes by themselves. A row a solution, least of the rounds'), &
        bench_t('speed', '--contacts --methods --rounds --quick', &
                'microseconds of all methods of a list (default reference/speed_methods.csv) ' &
                // 'in one run: what ./run speed sets beside FASTSIM and CONTACT. A row a method ' &
                // 'and contact, least of the rounds; also influence coefficients of 15 strips, ' &
                // 'centre and tip, and the states of example/wheelset_states.csv'), &
        bench_t('host', '--case --rounds --quick', &
                'microseconds of a vehicle''s next call of both wheels, 1, 10 and 100 um on: ' &
                // 'straight, curve, two contacts, flange root, from -8 to 8 mm (all); z given, ' &
                // 'loads, free roll; forces alone, with estimates, with derivatives; S1002 on ' &
                // '60E1, then the wheelset of a case. ratio: to FASTSIM on 50 x 50 elements'), &
        bench_t('reference', '--contacts --most-elements --seconds', &
                'microseconds Kalker''s variational method takes with 500 to 200000 elements ' &
                // 'in contact: cold with new plans and with old ones, from a coarser grid, from ' &
                // '15 strips, and from the previous step; to 1e-9 and to 1e-4 of the approach. ' &
                // 'Then its rolling on the same grids, to 1e-7 of the slip'), &
        bench_t('tangential', '--contacts --rounds', &
                'microseconds and nanoseconds per element of all tangential methods on the ' &
                // 'strips of 5 to 61 by as many points, forces only and with the field; ratio: ' &
                // 'to FASTSIM with the same number of elements'), &
        bench_t('tang', '--contacts --most-elements --rounds --quick', &
                'Newton''s steps, iterations and times of TANG with about 3700, 15000 and ' &
                // '60000 elements in contact; each contact with its own creepages, without spin ' &
                // 'and with much of it, on pressures of the same grid, which are not counted; ' &
                // 'cold starts'), &
        bench_t('forces', '--contacts --scenes', &
                'errors of all tangential methods against CONTACT, on 161 Hertz contacts and ' &
                // 'the paper''s with either sign of the creepages, and against TANG on 240 ' &
                // 'others'), &
        bench_t('correction', '--quick', &
                'what the march misses of ellipses'' forces by TANG, and what is added'), &
        bench_t('accuracy', '--contacts', &
                'errors of 15 strips and auto against CONTACT'), &
        bench_t('convergence', '--contacts --most-strips', &
                'errors of 5 to 81 strips, against 301 strips, and against Hertz on ellipses'), &
        bench_t('robust', '--contacts', &
                'the fallback''s errors against CONTACT and Hertz; kinks and flat tops by 15, ' &
                // '31 and 201 strips and auto against 401'), &
        bench_t('rolling', '--contacts', &
                'errors and times of Kalker''s method in rolling against CONTACT, by its ' &
                // 'scheme and by the second-order one, on 0.4 and 0.2 mm: the paper''s contacts ' &
                // 'with either sign of the creepages, and 161 ellipses of 113 mm2'), &
        bench_t('subsurface', '--rounds', &
                'milliseconds of the stresses below a circle of up to 3000 elements, at 50 by ' &
                // '50 by 30 points by transforms, and of the largest; how far they are off'), &
        bench_t('kalker', '--contacts --quick', &
                'Kalker''s coefficients from TANG without sliding beside his table and ' &
                // 'CONTACT, 19 aspect ratios by 3 of Poisson''s (two minutes)'), &
        bench_t('estimates', '', &
                'how often estimated errors bound the true ones, by family of gaps: ellipses ' &
                // 'exactly, all others by NORM on two grids (minutes; with -o FILE the shares ' &
                // 'on stdout)'), &
        bench_t('examples', '--examples', &
                'the cases of example/cases by Hertz, strips, auto and Kalker''s methods'), &
        bench_t('trade', '--contacts --methods --scenes --quick', &
                'errors and microseconds of many methods and resolutions (default ' &
                // 'reference/trade_methods.csv, which tells the columns), one row per contact ' &
                // 'and method, on the contacts, Hertz ellipses and scenes'), &
        bench_t('extremes', '--contacts --quick --only --references --examples', &
                'the errors of everything at its extremes: strips, ellipses, loads, ' &
                // 'creepages, gaps beyond all use; noise of one unit in the last place; ' &
                // 'rounding up, down and to zero')]

contains

    !> Run the subcommand from the command line.
    subroutine run_bench()
        type(command_t) :: command
        character(len=:), allocatable :: file
        integer :: rounds
        logical :: quick

        call take_command(command)
        file = option_text(command, '-o', '-')
        quick = given(command, '--quick')
        rounds = option_integer(command, '--rounds', 21, least=1, most=1000)
        select case (command%arguments(1)%text)
        case ('integral')
            call bench_integral(file, rounds)
        case ('normal')
            call bench_normal(file, contacts(), most_strips(), seconds())
        case ('steps')
            call bench_steps(file, contacts(), scenes(), option_integer(command, '--strips', 15, &
                             least=3, most=bench_normal_most_strips), rounds)
        case ('speed')
            call bench_speed(file, input('--methods', 'reference/speed_methods.csv'), contacts(), &
                             rounds, quick)
        case ('host')
            call bench_host(file, input('--case', 'example/cases/worn_wheel.nml'), &
                            option_integer(command, '--rounds', 3, least=1, most=1000), quick)
        case ('reference')
            call bench_reference(file, contacts(), most_elements(bench_reference_most_elements), &
                                 seconds())
        case ('tangential')
            call bench_tangential(file, contacts(), rounds)
        case ('tang')
            call bench_tang(file, contacts(), most_elements(bench_tang_most_elements), &
                            option_integer(command, '--rounds', 3, least=1, most=1000), quick)
        case ('forces')
            call bench_forces(file, contacts(), scenes())
        case ('correction')
            call bench_correction(file, quick)
        case ('accuracy')
            call bench_accuracy(file, contacts())
        case ('convergence')
            call bench_convergence(file, contacts(), most_strips())
        case ('robust')
            call bench_robust(file, contacts())
        case ('rolling')
            call bench_rolling(file, contacts())
        case ('subsurface')
            call bench_subsurface(file, option_integer(command, '--rounds', 3, least=1, most=1000))
        case ('kalker')
            call bench_kalker(file, contacts(), quick)
        case ('estimates')
            call run_estimates_study(file)
        case ('examples')
            call bench_examples(file, examples())
        case ('trade')
            call bench_trade(file, input('--methods', 'reference/trade_methods.csv'), contacts(), &
                             scenes(), quick)
        case ('extremes')
            call bench_extremes(file, option_word(command, '--only', '', extreme_parts), quick, &
                                contacts(), input('--references', 'reference/influence'), &
                                examples())
        case default
            error stop 'faststrip-lab: a bench that nobody runs'
        end select

    contains

        !> A file or folder to read, by default one of the checkout.
        function input(option, default) result(path)
            character(len=*), intent(in) :: option, default
            character(len=:), allocatable :: path

            path = option_text(command, option, in_checkout(default))
            call take_input(path)
        end function input

        function contacts() result(path)
            character(len=:), allocatable :: path

            path = input('--contacts', 'reference/contact')
        end function contacts

        function scenes() result(path)
            character(len=:), allocatable :: path

            path = input('--scenes', 'reference/scenes/scenes.csv')
        end function scenes

        function examples() result(path)
            character(len=:), allocatable :: path

            path = input('--examples', 'example/cases')
        end function examples

        integer function most_strips()
            most_strips = option_integer(command, '--most-strips', bench_normal_most_strips, &
                                         least=1)
        end function most_strips

        integer function most_elements(default)
            integer, intent(in) :: default

            most_elements = option_integer(command, '--most-elements', default, least=1)
        end function most_elements

        real(wp) function seconds()
            seconds = option_number(command, '--seconds', 6.0_wp, least=0)
        end function seconds
    end subroutine run_bench

    !> Which benches and options there are, and what was given: nothing but what the bench takes.
    subroutine take_command(command)
        type(command_t), intent(inout) :: command

        integer :: i, row

        command%name = 'bench'
        command%usage = 'WHAT'
        command%about = 'Times and errors of the methods. WHAT is one of these, with its options:' &
                        // nl
        do i = 1, size(benches)
            command%about = command%about // nl // trim(trim(benches(i)%name) // ' ' &
                            // benches(i)%options) // nl // in_lines(trim(benches(i)%help))
        end do
        command%about = command%about // nl // 'Contacts are the paper''s 20. Times are those of ' &
                        // 'the processor, with the tail: median,' // nl // '95th percentile, ' &
                        // 'worst; OPENBLAS_NUM_THREADS=1 keeps them to one core.' // nl
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.), &
            option_t('--rounds', 'N', &
                     'how often all is timed, 1 to 1000' // nl &
                     // '(default 21; host, tang, subsurface 3)'), &
            option_t('--contacts', 'FOLDER', 'the contacts (default reference/contact)', &
                     reads=.true.), &
            option_t('--case', 'FILE', 'a wheelset (default example/cases/worn_wheel.nml)', &
                     reads=.true.), &
            option_t('--strips', 'N', 'strips of the widest patch (default 15)'), &
            option_t('--most-strips', 'N', 'no more strips than that'), &
            option_t('--most-elements', 'N', 'no more elements in contact'), &
            option_t('--seconds', 'S', 'for each number of strips or elements (default 6)'), &
            option_t('--methods', 'FILE', 'the list of methods', reads=.true.), &
            option_t('--quick', '', 'few methods, few contacts'), &
            option_t('--only', 'PART', 'influence, normal, tangential, noise or rounding'), &
            option_t('--references', 'FOLDER', 'influence coefficients (default' &
                     // ' reference/influence)', reads=.true.), &
            option_t('--scenes', 'FILE', 'contacts of many kinds' // nl &
                     // '(default reference/scenes/scenes.csv)', reads=.true.), &
            option_t('--examples', 'FOLDER', 'the cases (default example/cases)', reads=.true.)]
        command%reads = .false.
        call parse_command(command, 1)
        row = findloc(benches%name == command%arguments(1)%text, .true., dim=1)
        if (row == 0) call usage_error('WHAT must be a bench of the list, got ''' // &
                                       command%arguments(1)%text // '''', command%name)
        do i = 2, size(command%options)
            associate (option => command%options(i))
                if (option%is_given .and. index(' ' // benches(row)%options, ' ' &
                                                // trim(option%name) // ' ') == 0) &
                    call usage_error(trim(option%name) // ' must not be given with ' &
                                     // trim(benches(row)%name), command%name)
            end associate
        end do
    end subroutine take_command

    !> A text in lines that end with a line feed, as long as those of a help.
    pure function in_lines(text) result(lines)
        character(len=*), intent(in) :: text
        character(len=:), allocatable :: lines

        integer, parameter :: width = 84
        integer :: first, last

        lines = ''
        first = 1
        do while (first <= len(text))
            last = len(text)
            if (last - first >= width) last = first - 1 + index(text(first:first + width), ' ', &
                                                                back=.true.)
            lines = lines // '  ' // trim(text(first:last)) // nl
            first = last + 1
        end do
    end function in_lines
end module faststrip_lab_grid_bench
