!> Which method a lookup table's forces are solved by, from the command line.
module faststrip_command_lookup_options
    use, intrinsic :: iso_c_binding, only: c_int
    use faststrip_base_kinds, only: wp
    use faststrip_base_text, only: integer_text
    use faststrip_command_program_console, only: usage_error
    use faststrip_command_program_options, only: command_t, option_t, option_word, option_integer, &
                                                 option_number, option_pair, refuse_value, given, &
                                                 most_threads
    use faststrip_command_program_system, only: use_one_thread_each
    use faststrip_files_csv, only: real_text
    use faststrip_contact_grids, only: least_across
    use faststrip_contact_methods, only: usual_rows, most_strips
    use faststrip_normal_strips, only: usual_strips
    use faststrip_tabulate_forces, only: choice_t, force_methods, most_across
    implicit none
    private

    public :: method_options, take_choice, take_threads, take_ends, choice_text
    public :: usual_tests, usual_wheel_tests

    !> For the tables of options.
    type(option_t), parameter :: method_options(6) = [ &
        option_t('--method', 'NAME', 'faststrip (default), fastsim, tang or auto'), &
        option_t('--strips', 'N', 'strips, or rows of fastsim (default 15; fastsim 50)'), &
        option_t('--points', 'N', 'points along each (default 15; fastsim 50)'), &
        option_t('--across', 'N', 'elements of tang along each axis (default 36)'), &
        option_t('--tolerance', 'E', 'auto: tang where faststrip''s estimated error is above,' &
                 // new_line('a') // 'over mu N and mu N c (default 0.02)'), &
        option_t('--threads', 'N', 'that solve contacts (default: all cores); the bits are the' &
                 // new_line('a') // 'same for any number')]

    !> Fresh states that a table is judged by, of ellipses and of wheels.
    !> Tuned [states]. Origin: the 99th percentile of as many moves by less than a tenth of itself
    !> with the seed; cost.
    integer, parameter :: usual_tests = 10000, usual_wheel_tests = 2000

    integer, parameter :: strips_of(4) = [usual_strips, usual_rows, usual_strips, usual_strips]

    interface
        ! Processors of the machine, of the C library.
        function c_get_nprocs() bind(c, name='get_nprocs') result(n)
            import :: c_int
            integer(c_int) :: n
        end function c_get_nprocs
    end interface

contains

    !> The method that the command line names.
    subroutine take_choice(command, choice)
        type(command_t), intent(in) :: command       !! parsed, with `method_options`
        type(choice_t), intent(inout) :: choice !! what is not named stays, but for sizes

        character(len=:), allocatable :: name
        integer :: i

        name = option_word(command, '--method', 'faststrip', force_methods)
        do i = 1, size(force_methods)
            if (force_methods(i) == name) choice%method = i
        end do
        choice%strips = option_integer(command, '--strips', strips_of(choice%method), least=3, &
                                       most=most_strips)
        choice%points = option_integer(command, '--points', strips_of(choice%method), least=3, &
                                       most=most_strips)
        choice%across = option_integer(command, '--across', choice%across, least=least_across, &
                                       most=most_across)
        choice%tolerance = option_number(command, '--tolerance', choice%tolerance, above=0)
        if (given(command, '--tolerance') .and. name /= 'auto') &
            call usage_error('--tolerance goes with --method auto', command%name)
    end subroutine take_choice

    !> How many threads solve contacts. Libraries get one each: more of them wait for each other.
    integer function take_threads(command) result(threads)
        type(command_t), intent(in) :: command !! parsed, with `method_options`

        threads = min(int(c_get_nprocs()), most_threads)
        threads = option_integer(command, '--threads', threads, least=1, most=most_threads)
        call use_one_thread_each()
    end function take_threads

    !> First and last number of an option, FIRST:LAST.
    subroutine take_ends(command, name, default, ends, may_be_one, above)
        type(command_t), intent(in) :: command      !! parsed, with the option
        character(len=*), intent(in) :: name        !! of the option
        character(len=*), intent(in) :: default     !! as the option's text
        real(wp), intent(out) :: ends(2)            !! rising
        logical, intent(in), optional :: may_be_one !! may both be the same?
        integer, intent(in), optional :: above      !! the first must be above it

        logical :: are_good

        call option_pair(command, name, default, 'FIRST:LAST', ends)
        are_good = ends(2) > ends(1)
        if (present(may_be_one)) are_good = are_good .or. (may_be_one .and. ends(2) >= ends(1))
        if (present(above)) are_good = are_good .and. ends(1) > above
        if (.not. are_good) call refuse_value(command, name, 'two rising numbers within its range')
    end subroutine take_ends

    !> The method in a line of words.
    function choice_text(choice) result(text)
        type(choice_t), intent(in) :: choice
        character(len=:), allocatable :: text

        text = 'method ' // trim(force_methods(choice%method))
        select case (force_methods(choice%method))
        case ('tang')
            text = text // ', ' // integer_text(choice%across) // ' elements along each axis'
        case ('auto')
            text = text // ', tolerance ' // real_text(choice%tolerance)
        case default
            text = text // ', ' // integer_text(choice%strips) // ' strips, ' &
                   // integer_text(choice%points) // ' points along each'
        end select
    end function choice_text
end module faststrip_command_lookup_options
