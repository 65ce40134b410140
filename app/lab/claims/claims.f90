!> `faststrip-lab claims`: what the program makes of the contacts of `faststrip-lab references`
!> by each method of a list, automatic ones among them: errors, their estimates, status and time.
!>
!> Contacts are solved through the program's own solver, as a row of `faststrip batch` is. Kalker's
!> methods with elements across the patch take these from the reference, which a user would have to
!> find first: their times are the least they can be.
module faststrip_lab_claims
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, number_text
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_table_t, read_csv, csv_writer_t, open_csv, put_comment, &
                                   put_header, put_cell, put_cells, end_row
    use faststrip_command_program_clock, only: cpu_microseconds, median
    use faststrip_command_program_console, only: fail_on_error, progress, begin_table, end_table
    use faststrip_command_program_files, only: take_input, take_output, take_beside
    use faststrip_command_rows_auto_words, only: words_of_steps
    use faststrip_contact_case, only: contact_case_t
    use faststrip_contact_method, only: contact_result_t
    use faststrip_geometry_gap_curve, only: gap_curve_t, reserve_gap_curve, set_gap_curve
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer
    use faststrip_command_batch, only: case_columns
    use faststrip_command_contact_prepared_case, only: put_gap
    use faststrip_command_contact_solver, only: solver_t, new_solver, free_solver, solve
    use faststrip_lab_grid_method_list, only: method_entry_t, read_method_list
    use faststrip_lab_checkout, only: in_checkout
    use faststrip_lab_grid_cases, only: bench_case_t, read_ellipse_cases
    use faststrip_lab_claims_contacts, only: claim_contact_t, find_claim_contact, &
                                               claim_kinds
    use faststrip_lab_claims_record, only: reference_record_t, take_reference, n_figures, &
                                           figure_names, figure_units
    implicit none
    private

    public :: run_claims

    ! How often a method goes through all contacts, unless that takes longer than this, us.
    integer, parameter :: most_rounds = 5
    real(wp), parameter :: enough_us = 5.0e6_wp
    integer, parameter :: most_thinning = 10000
    integer, parameter :: n_estimates = 6

    !> What is true, and the gap it is true of.
    type :: judged_t
        type(reference_record_t) :: reference
        type(claim_contact_t) :: contact
    end type judged_t

contains

    !> Run the subcommand from the command line.
    subroutine run_claims()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        type(method_entry_t), allocatable :: entries(:)
        type(judged_t), allocatable :: contacts(:)
        character(len=:), allocatable :: reference, methods, folder
        integer :: i, thinning

        command%name = 'claims'
        command%usage = ''
        command%about = &
            'For developers: errors, estimates, status and time of every method of a list, auto' &
            // new_line('a') // 'with its tolerances too, on contacts whose figures are known.' &
            // ' CSV, one row for each' // new_line('a') // 'contact and method.' // new_line('a')
        command%options = [ &
            option_t('--references', 'FILE', &
                     'the contacts (default reference/claims/references.csv)', reads=.true.), &
            option_t('--methods', 'FILE', &
                     'the methods (default reference/claims/methods.csv)', reads=.true.), &
            option_t('--every', 'INTEGER', 'take one of so many contacts (default 1)'), &
            option_t('--cases', 'FOLDER', &
                     'instead write the contacts there, as cases.csv of faststrip batch and its' &
                     // ' gap' // new_line('a') // 'files'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 0)
        reference = option_text(command, '--references', &
                                in_checkout('reference/claims/references.csv'))
        methods = option_text(command, '--methods', in_checkout('reference/claims/methods.csv'))
        thinning = option_integer(command, '--every', 1, least=1, most=most_thinning)
        call take_input(reference)
        call take_input(methods)
        folder = option_text(command, '--cases', '')
        call read_method_list(methods, entries)
        if (folder /= '') then
            call take_output(folder // '/cases.csv', '--cases')
            do i = 1, size(claim_kinds)
                call take_beside(folder // '/' // trim(claim_kinds(i)) // '_', '--cases', &
                                 is_beginning=.true.)
            end do
        end if
        call read_contacts(reference, thinning, contacts)
        if (folder /= '') then
            call put_cases(folder, contacts)
            return
        end if
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_comment(writer, 'err_*: relative, of Fx, Fy over mu N, of Mz over mu N c, c = ' &
                         // 'sqrt(area/pi), of the stick fraction as it is; est_* what the ' &
                         // 'program says of it; times: processor, whole_us with what the ' &
                         // 'program does besides')
        call put_header(writer, [[character(len=20) :: 'kind', 'number', 'state', 'method', &
                                  'status', 'normal_us', 'tangential_us', 'whole_us'], &
                                 [character(len=20) :: 'err_' // figure_names], &
                                 [character(len=20) :: 'est_' // figure_names(:n_estimates)], &
                                 [character(len=20) :: 'choice']])
        do i = 1, size(entries)
            call progress('methods', i, size(entries))
            call judge_method(writer, entries(i), contacts)
        end do
        call end_table(writer)
    end subroutine run_claims

    !> The contacts of a file of references; ends the program if it cannot be read.
    subroutine read_contacts(file, thinning, contacts)
        character(len=*), intent(in) :: file
        integer, intent(in) :: thinning
        type(judged_t), allocatable, intent(out) :: contacts(:)

        type(csv_table_t) :: table
        type(bench_case_t), allocatable :: ellipses(:)
        type(status_t) :: status
        integer :: i

        call read_csv(file, table, status)
        call fail_on_error(status)
        call read_ellipse_cases(in_checkout('reference/contact'), ellipses)
        allocate (contacts((table%n_rows + thinning - 1)/thinning))
        do i = 1, size(contacts)
            associate (reference => contacts(i)%reference, contact => contacts(i)%contact)
                call take_reference(table, 1 + (i - 1)*thinning, reference, status)
                call fail_on_error(status)
                call find_claim_contact(ellipses, reference%kind, reference%number, contact, status)
                call fail_on_error(status, file)
                contact%load = reference%load
                contact%mu = reference%mu
                contact%material = reference%material
                contact%creepage = reference%creepage
            end associate
        end do
    end subroutine read_contacts

    !> Write the contacts for the program.
    subroutine put_cases(folder, contacts)
        character(len=*), intent(in) :: folder
        type(judged_t), intent(in) :: contacts(:)

        type(csv_writer_t) :: writer, gap
        type(gap_curve_t) :: curve
        type(status_t) :: status
        character(len=:), allocatable :: name
        integer :: i

        call begin_table(writer, folder // '/cases.csv')
        call put_header(writer, case_columns)
        do i = 1, size(contacts)
            associate (reference => contacts(i)%reference)
                name = trim(claim_kinds(reference%kind)) // '_' // integer_text(reference%number)
                call put_cell(writer, name // '_' // integer_text(reference%state))
                call put_cell(writer, name // '.csv')
                associate (material => reference%material, creepage => reference%creepage)
                    call put_cells(writer, [material%e_rail, material%nu_rail, reference%mu, &
                                            reference%load, creepage%cksi, creepage%ceta, &
                                            creepage%cphi])
                end associate
                call end_row(writer)
            end associate
            call open_csv(gap, folder // '/' // name // '.csv', status)
            call fail_on_error(status)
            associate (points => contacts(i)%contact%gap)
                call reserve_gap_curve(curve, size(points%y), status)
                if (.not. is_error(status)) call set_gap_curve(curve, points, status)
            end associate
            call fail_on_error(status)
            call put_gap(gap, curve, 0.0_wp, .false.)
            call end_table(gap)
        end do
        call end_table(writer)
    end subroutine put_cases

    !> The rows of one method: several times through all contacts, unless that takes long.
    subroutine judge_method(writer, entry, contacts)
        type(csv_writer_t), intent(inout) :: writer
        type(method_entry_t), intent(in) :: entry
        type(judged_t), intent(in) :: contacts(:)

        type(solver_t), pointer :: solver
        type(contact_result_t), allocatable :: results(:)
        character(len=1000), allocatable :: choices(:)
        character(len=:), allocatable :: choice
        type(status_t), allocatable :: statuses(:)
        type(status_t) :: status
        real(wp), allocatable :: us(:, :, :) ! normal, tangential, whole; round, contact
        real(wp) :: spent, before
        integer :: i, k, round, rounds

        call new_solver(solver, status)
        call fail_on_error(status)
        allocate (results(size(contacts)), choices(size(contacts)), statuses(size(contacts)))
        allocate (us(3, most_rounds, size(contacts)), source=0.0_wp)
        spent = 0.0_wp
        do round = 1, most_rounds
            rounds = round
            do i = 1, size(contacts)
                before = cpu_microseconds()
                call judge_contact(solver, entry, contacts(i), results(i), statuses(i))
                us(:, round, i) = [results(i)%times%normal_cpu_us, &
                                   results(i)%times%tangential_cpu_us, cpu_microseconds() - before]
                call words_of_steps(solver%workspace%steps, .true., choice)
                choices(i) = choice
                spent = spent + us(3, round, i)
            end do
            if (spent*(round + 1)/round > enough_us) exit
        end do
        do i = 1, size(contacts)
            call put_row(writer, entry%name, contacts(i)%reference, results(i), trim(choices(i)), &
                         statuses(i), [(median(us(k, :rounds, i)), k=1, size(us, 1))])
        end do
        call free_solver(solver)
    end subroutine judge_method

    subroutine judge_contact(solver, entry, contact, result, status)
        type(solver_t), intent(inout) :: solver
        type(method_entry_t), intent(in) :: entry
        type(judged_t), intent(in) :: contact
        type(contact_result_t), intent(out) :: result
        type(status_t), intent(out) :: status

        type(contact_case_t) :: case

        case = contact%contact%contact_case_t
        case%methods = entry%settings%methods
        case%wanted = entry%settings%wanted
        case%asked%times = .true.
        if (entry%across > 0) then
            case%methods%element_dx = contact%reference%extents(1)/entry%across
            case%methods%element_dy = contact%reference%extents(2)/entry%across
            case%methods%dx_is_given = .true.
            case%methods%dy_is_given = .true.
        end if
        call solve(solver, case, result, status)
    end subroutine judge_contact

    !> One contact by one method; without a result its figures are empty.
    subroutine put_row(writer, method, reference, result, choice, status, us)
        type(csv_writer_t), intent(inout) :: writer
        character(len=*), intent(in) :: method
        type(reference_record_t), intent(in) :: reference
        type(contact_result_t), intent(in) :: result
        character(len=*), intent(in) :: choice ! steps of auto
        type(status_t), intent(in) :: status
        real(wp), intent(in) :: us(:) ! normal, tangential, whole

        real(wp) :: errors(n_figures), estimates(n_estimates)
        logical :: counts(n_figures), is_estimated(n_estimates)
        integer :: i

        call put_cell(writer, trim(claim_kinds(reference%kind)))
        call put_cell(writer, reference%number)
        call put_cell(writer, reference%state)
        call put_cell(writer, method)
        call put_cell(writer, trim(status_word(status%code)))
        if (is_error(status)) then
            errors = 0.0_wp
        else
            errors = errors_of(reference, result)
        end if
        counts(:3) = .true.
        counts(4:7) = result%has_forces
        counts(8) = result%knows_stick
        associate (normal_errors => result%normal_errors, forces => result%force_errors)
            estimates = [normal_errors%est_err_penetration, normal_errors%est_err_pmax, &
                         normal_errors%est_err_area, forces%fx, forces%fy, forces%mz]
        end associate
        is_estimated(:3) = result%is_estimated
        is_estimated(4:) = result%forces_are_estimated
        do i = 1, size(us)
            call put_known(.true., us(i))
        end do
        do i = 1, n_figures
            call put_known(counts(i), errors(i))
        end do
        do i = 1, n_estimates
            call put_known(is_estimated(i), estimates(i))
        end do
        call put_cell(writer, choice)
        call end_row(writer)

    contains

        subroutine put_known(is_known, value)
            logical, intent(in) :: is_known
            real(wp), intent(in) :: value

            if (is_known .and. .not. is_error(status)) then
                call put_cell(writer, trim(number_text(value)))
            else
                call put_cell(writer, '')
            end if
        end subroutine put_known
    end subroutine put_row

    !> Errors in the order of `figure_names`.
    pure function errors_of(reference, solution) result(errors)
        type(reference_record_t), intent(in) :: reference
        type(contact_result_t), intent(in) :: solution
        real(wp) :: errors(n_figures)

        real(wp) :: found(n_figures)

        associate (normal => solution%normal, forces => solution%tangential)
            found = [normal%penetration, normal%pmax, normal%area, forces%fx, forces%fy, &
                     forces%mz, forces%friction_power, forces%stick_fraction]
        end associate
        errors = (found - reference%figures)/figure_units(reference)
    end function errors_of
end module faststrip_lab_claims
