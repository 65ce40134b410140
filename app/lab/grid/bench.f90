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
    use faststrip_lab_grid_accuracy, only: bench_accuracy
    use faststrip_lab_studies_kalker, only: bench_kalker
    use faststrip_lab_grid_tangential, only: bench_tangential
    use faststrip_lab_grid_tang, only: bench_tang, bench_tang_most_elements
    use faststrip_lab_studies_robust, only: bench_robust
    use faststrip_lab_grid_convergence, only: bench_convergence
    use faststrip_lab_extremes, only: bench_extremes, extreme_parts
    use faststrip_lab_studies_rolling, only: bench_rolling
    use faststrip_lab_grid_forces, only: bench_forces
    use faststrip_lab_studies_correction, only: bench_correction
    use faststrip_lab_grid_examples, only: bench_examples
    use faststrip_lab_grid_trade, only: bench_trade
    use faststrip_lab_studies_estimates, only: run_estimates_study
    use faststrip_lab_checkout, only: in_checkout
    implicit none
    private

    public :: run_bench

    integer, parameter :: name_length = 15

contains

    !> Run the subcommand from the command line.
    subroutine run_bench()
        type(command_t) :: command
        character(len=:), allocatable :: what, file, folder, methods, references, scenes, &
                                         examples
        integer :: rounds, most_strips, most_elements
        real(wp) :: seconds

        call take_command(command)
        what = command%arguments(1)%text
        file = option_text(command, '-o', '-')
        rounds = option_integer(command, '--rounds', 21, least=1, most=1000)
        folder = option_text(command, '--contacts', in_checkout('reference/contact'))
        call take_input(folder)
        most_strips = option_integer(command, '--most-strips', bench_normal_most_strips, &
                                     least=1)
        most_elements = option_integer(command, '--most-elements', bench_reference_most_elements, &
                                       least=1)
        seconds = option_number(command, '--seconds', 6.0_wp, least=0)
        select case (what)
        case ('integral')
            call allow([character(len=name_length) :: '--rounds'])
            call bench_integral(file, rounds)
        case ('normal')
            call allow([character(len=name_length) :: '--contacts', '--most-strips', '--seconds'])
            call bench_normal(file, folder, most_strips, seconds)
        case ('steps')
            call allow([character(len=name_length) :: '--contacts', '--scenes', '--rounds', &
                        '--strips'])
            scenes = option_text(command, '--scenes', in_checkout('reference/scenes/scenes.csv'))
            call take_input(scenes)
            call bench_steps(file, folder, scenes, option_integer(command, '--strips', 15, &
                             least=3, most=bench_normal_most_strips), rounds)
        case ('speed')
            call allow([character(len=name_length) :: '--contacts', '--methods', '--rounds', &
                        '--quick'])
            methods = option_text(command, '--methods', in_checkout('reference/speed_methods.csv'))
            call take_input(methods)
            call bench_speed(file, methods, folder, rounds, given(command, '--quick'))
        case ('reference')
            call allow([character(len=name_length) :: '--contacts', '--most-elements', '--seconds'])
            call bench_reference(file, folder, most_elements, seconds)
        case ('tangential')
            call allow([character(len=name_length) :: '--contacts', '--rounds'])
            call bench_tangential(file, folder, rounds)
        case ('tang')
            call allow([character(len=name_length) :: '--contacts', '--most-elements', &
                        '--rounds', '--quick'])
            call bench_tang(file, folder, option_integer(command, '--most-elements', &
                            bench_tang_most_elements, least=1), option_integer(command, &
                            '--rounds', 3, least=1, most=1000), given(command, '--quick'))
        case ('forces')
            call allow([character(len=name_length) :: '--contacts', '--scenes'])
            scenes = option_text(command, '--scenes', in_checkout('reference/scenes/scenes.csv'))
            call take_input(scenes)
            call bench_forces(file, folder, scenes)
        case ('correction')
            call allow([character(len=name_length) :: '--quick'])
            call bench_correction(file, given(command, '--quick'))
        case ('estimates')
            call allow([character(len=name_length) ::])
            call run_estimates_study(file)
        case ('accuracy')
            call allow([character(len=name_length) :: '--contacts'])
            call bench_accuracy(file, folder)
        case ('rolling')
            call allow([character(len=name_length) :: '--contacts'])
            call bench_rolling(file, folder)
        case ('kalker')
            call allow([character(len=name_length) :: '--contacts', '--quick'])
            call bench_kalker(file, folder, given(command, '--quick'))
        case ('robust')
            call allow([character(len=name_length) :: '--contacts'])
            call bench_robust(file, folder)
        case ('convergence')
            call allow([character(len=name_length) :: '--contacts', '--most-strips'])
            call bench_convergence(file, folder, most_strips)
        case ('extremes')
            call allow([character(len=name_length) :: '--contacts', '--quick', '--only', &
                        '--references', '--examples'])
            references = option_text(command, '--references', in_checkout('reference/influence'))
            examples = option_text(command, '--examples', in_checkout('example/cases'))
            call take_input(references)
            call take_input(examples)
            call bench_extremes(file, option_word(command, '--only', '', extreme_parts), &
                                given(command, '--quick'), folder, references, examples)
        case ('examples')
            call allow([character(len=name_length) :: '--examples'])
            examples = option_text(command, '--examples', in_checkout('example/cases'))
            call take_input(examples)
            call bench_examples(file, examples)
        case ('trade')
            call allow([character(len=name_length) :: '--contacts', '--methods', '--scenes', &
                        '--quick'])
            methods = option_text(command, '--methods', in_checkout('reference/trade_methods.csv'))
            scenes = option_text(command, '--scenes', in_checkout('reference/scenes/scenes.csv'))
            call take_input(methods)
            call take_input(scenes)
            call bench_trade(file, methods, folder, scenes, given(command, '--quick'))
        case default
            call usage_error('WHAT must be a bench of the list, got ''' // what // '''', &
                             command%name)
        end select

    contains

        !> Refuse every option that was given beside `-o` and those of the bench.
        subroutine allow(names)
            character(len=*), intent(in) :: names(:)

            integer :: i

            do i = 2, size(command%options)
                if (.not. command%options(i)%is_given) cycle
                if (any(names == command%options(i)%name)) cycle
                call usage_error(trim(command%options(i)%name) // ' must not be given with ' &
                                 // what, command%name)
            end do
        end subroutine allow
    end subroutine run_bench

    !> Which options there are, and what was given.
    subroutine take_command(command)
        type(command_t), intent(inout) :: command

        command%name = 'bench'
        command%usage = 'WHAT'
        command%about = about()
        command%options = [ &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.), &
            option_t('--rounds', 'N', 'integral, tangential, tang, steps, speed: how often' &
                     // new_line('a') // 'all is timed, 1 to 1000 (default 21; tang 3)'), &
            option_t('--contacts', 'FOLDER', 'the contacts (default reference/contact)', &
                     reads=.true.), &
            option_t('--strips', 'N', 'steps: strips of the widest patch (default 15)'), &
            option_t('--most-strips', 'N', 'normal, convergence: no more strips than that'), &
            option_t('--most-elements', 'N', 'reference, tang: no more elements in contact'), &
            option_t('--seconds', 'S', 'normal, reference: for each number of strips or' &
                     // new_line('a') // 'elements (default 6)'), &
            option_t('--methods', 'FILE', 'trade, speed: the methods (default' &
                     // ' reference/trade_methods.csv,' // new_line('a') &
                     // 'reference/speed_methods.csv)', reads=.true.), &
            option_t('--quick', '', 'trade, extremes, kalker, correction, tang, speed: few' // &
                     new_line('a') // 'methods, few contacts'), &
            option_t('--only', 'PART', 'extremes: influence, normal, tangential, noise or' &
                     // ' rounding'), &
            option_t('--references', 'FOLDER', 'extremes: influence coefficients' &
                     // ' (default reference/influence)', reads=.true.), &
            option_t('--scenes', 'FILE', 'forces, trade, steps: contacts of many kinds' &
                     // new_line('a') // '(default reference/scenes/scenes.csv)', reads=.true.), &
            option_t('--examples', 'FOLDER', 'extremes, examples: the cases' &
                     // ' (default example/cases)', reads=.true.)]
        command%reads = .false.
        call parse_command(command, 1)
    end subroutine take_command

    function about() result(text)
        character(len=:), allocatable :: text

        character(len=*), parameter :: lines(53) = [character(len=84) :: &
            'integral: nanoseconds an influence coefficient costs, its largest relative error,', &
            'by the published polynomial (Horner, exp), fresh fits, the closed form and GSL;', &
            'one by one (scalar) and for n = 0 to 20 at once (row). CSV:', &
            'method,n,b,loop,ns,ratio,rel_err,flags,compiler,cpu,ns_p95,ns_worst; ns and ratio', &
            'are medians; ratio: to the published polynomial in the same loop.', &
            'normal: microseconds the strip solver takes with 5 to 400 strips, cold', &
            '(cold) and from the previous step (load changed by 5 %, wheelset moved by', &
            '0.05 mm), beside FASTSIM on 50 x 50 elements. Processor time, with the tail;', &
            'OPENBLAS_NUM_THREADS=1 keeps it to one core.', &
            'steps: microseconds of the next solution of a history by 15 strips: 2.5 % steps of', &
            'the load, 0.1 mm steps of the wheelset, both with 5 % of load; beside each the cold', &
            'solution and errors against one to all digits; then contacts and scenes by', &
            'themselves. A row a solution, least of the rounds; median, 95th percentile, worst.', &
            'speed: microseconds of all methods of a list on the contacts, in one run: what', &
            './run speed sets beside FASTSIM and CONTACT. A row a method and contact, least of', &
            'the rounds; also influence coefficients of 15 strips, centre and tip, and the', &
            'states of example/wheelset_states.csv.', &
            'reference: microseconds Kalker''s variational method takes with 500 to 200000', &
            'elements in contact: cold with new plans and with old ones, from a', &
            'coarser grid, from 15 strips, and from the previous step; to 1e-9 and to 1e-4 of', &
            'the approach. Then its rolling on the same grids, to 1e-7 of the slip.', &
            'tangential: microseconds and nanoseconds per element of all tangential methods on', &
            'the strips of 5 to 61 by as many points, forces only and with the field; ratio:', &
            'to FASTSIM with the same number of elements. Processor time, with the tail.', &
            'tang: Newton''s steps, iterations and times of kalker_tangential with about 3700,', &
            '15000 and 60000 elements in contact; each contact with its own creepages, without', &
            'spin and with much of it, on pressures of the same grid, which are not counted.', &
            'Processor time of cold starts, a row a contact and its creepages; median, 95th', &
            'percentile, worst.', &
            'forces: errors of all tangential methods against CONTACT, on 161 Hertz contacts and', &
            'the paper''s with either sign of the creepages, and against TANG on 240 others.', &
            'correction: what the march misses of ellipses'' forces by TANG, and what is added.', &
            'accuracy: errors of the strips against CONTACT with 15 strips and auto.', &
            'rolling: errors and times of Kalker''s method in rolling against CONTACT, by', &
            'its scheme and by the second-order one, on 0.4 and 0.2 mm: the paper''s contacts', &
            'with either sign of the creepages, and 161 ellipses of 113 mm2.', &
            'kalker: Kalker''s coefficients from TANG without sliding beside his table and', &
            'CONTACT, 19 aspect ratios by 3 of Poisson''s (two minutes).', &
            'convergence: errors of 5 to 81 strips, against 301 strips, and against', &
            'Hertz on ellipses.', &
            'robust: the fallback''s errors against CONTACT and Hertz; kinks and flat tops with', &
            '15 and 31 strips and auto against 401.', &
            'estimates: how often estimated errors bound the true ones, by family of gaps:', &
            'ellipses exactly, all others by NORM on two grids (minutes; with -o FILE the', &
            'shares on stdout).', &
            'examples: the cases of example/cases by Hertz, strips, auto and Kalker''s methods.', &
            'trade: errors and microseconds of many methods and resolutions, one row per', &
            'contact and method. Columns of FILE: see reference/trade_methods.csv.', &
            'extremes: the errors of everything at its extremes: strips, ellipses, loads,', &
            'creepages, gaps beyond all use; noise of one unit in the last place; rounding', &
            'up, down and to zero. CSV: chapter,case,method,x_name,x,y_name,y,quantity,', &
            'value,judge,status.', &
            'The contacts are the paper''s 20; trade and forces add 161 Hertz ellipses.']
        integer :: i

        text = ''
        do i = 1, size(lines)
            text = text // trim(lines(i)) // new_line('a')
        end do
    end function about
end module faststrip_lab_grid_bench
