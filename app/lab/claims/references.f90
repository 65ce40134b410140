!> `faststrip-lab references`: contacts of kinds that nothing was fitted to, and their figures.
module faststrip_lab_claims_references
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error, status_word, st_ok
    use faststrip_base_text, only: integer_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_files_csv, only: csv_writer_t, put_comment
    use faststrip_command_program_console, only: note, progress, usage_error, begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer
    use faststrip_lab_checkout, only: in_checkout
    use faststrip_lab_grid_cases, only: bench_case_t, read_ellipse_cases
    use faststrip_lab_claims_contacts, only: claim_contact_t, find_claim_contact, &
                                               draw_claim_creepages, claim_kinds, states_drawn
    use faststrip_lab_claims_record, only: reference_record_t, put_reference_header, &
                                           put_reference, figure_units
    use faststrip_lab_claims_reference, only: reference_workspace_t, find_patches, &
                                             find_pressures, find_figures
    implicit none
    private

    public :: run_references

    integer, parameter :: usual_each = 28, usual_across = 108
    ! Of so many ellipses one is taken.
    integer, parameter :: ellipse_stride = 5

contains

    !> Run the subcommand from the command line.
    subroutine run_references()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        type(reference_workspace_t) :: work
        type(bench_case_t), allocatable :: ellipses(:)
        character(len=:), allocatable :: name
        integer :: each, across, kind, only, i, number

        command%name = 'references'
        command%usage = ''
        command%about = &
            'For developers: figures by NORM and TANG of contacts of kinds that nothing was' &
            // new_line('a') // 'fitted to, and how far they may be off; of ellipses by Hertz' &
            // ' and CONTACT. CSV,' // new_line('a') // 'one row for each creepage.' &
            // new_line('a')
        command%options = [ &
            option_t('--each', 'INTEGER', 'contacts of each kind (default ' &
                     // integer_text(usual_each) // ')'), &
            option_t('--kind', 'NAME', 'contacts of one kind (default: of all)'), &
            option_t('--across', 'INTEGER', &
                     'elements across the patch, each way, 8 to 500 (default ' &
                     // integer_text(usual_across) // ')'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 0)
        each = option_integer(command, '--each', usual_each, least=1)
        across = option_integer(command, '--across', usual_across, least=8, most=500)
        name = option_text(command, '--kind', '')
        only = findloc(claim_kinds == name, .true., dim=1)
        if (only == 0 .and. name /= '') &
            call usage_error('--kind must be a kind of contacts, got ' // name, command%name)
        call read_ellipse_cases(in_checkout('reference/contact'), ellipses)
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_comment(writer, 'NORM and TANG, ' // integer_text(across/2) // ' and ' &
                         // integer_text(across) // ' elements across length_mm and width_mm; ' &
                         // 'penetration, Fy and Mz extrapolated; ellipses by Hertz and CONTACT')
        call put_comment(writer, 'doubt_*: how far that may be off, relative, of Fx, Fy over mu' &
                         // ' N, of Mz over mu N c, c = sqrt(area/pi); creepages and Mz about' &
                         // ' y = 0')
        call put_reference_header(writer)
        do kind = 1, size(claim_kinds)
            if (only > 0 .and. kind /= only) cycle
            do i = 1, each
                call progress(trim(claim_kinds(kind)), i, each)
                number = i
                if (claim_kinds(kind) == 'ellipse') then
                    number = 1 + ellipse_stride*(i - 1)
                    if (number > size(ellipses)) exit
                end if
                call put_contact(writer, work, ellipses, kind, number, across)
            end do
        end do
        call end_table(writer)
    end subroutine run_references

    !> The rows of one contact; one that NORM cannot solve without a limitation is left out.
    subroutine put_contact(writer, work, ellipses, kind, number, across)
        type(csv_writer_t), intent(inout) :: writer
        type(reference_workspace_t), intent(inout) :: work
        type(bench_case_t), intent(in) :: ellipses(:)
        integer, intent(in) :: kind, number, across

        type(claim_contact_t) :: contact
        type(creepage_t) :: creepages(states_drawn)
        type(reference_record_t) :: record
        type(status_t) :: status
        integer :: states

        call find_claim_contact(ellipses, kind, number, contact, status)
        if (.not. is_error(status)) call find_patches(work, contact, status)
        if (.not. is_error(status)) then
            states = 1
            creepages(1) = contact%creepage
            if (claim_kinds(kind) /= 'ellipse') then
                states = states_drawn
                call draw_claim_creepages(contact, work%strips, creepages, status)
            end if
        end if
        if (.not. is_error(status)) &
            call find_pressures(work, contact, across, record%extents, status)
        if (status%code /= st_ok) then
            call leave_out('')
            return
        end if
        record%kind = kind
        record%number = number
        record%patches = work%fine%normal%n_patches
        record%load = contact%load
        record%mu = contact%mu
        record%material = contact%material
        do while (record%state < states)
            record%state = record%state + 1
            contact%creepage = creepages(record%state)
            record%creepage = contact%creepage
            call find_figures(work, contact, record, status)
            if (is_error(status)) then
                call leave_out(', state ' // integer_text(record%state))
                cycle
            end if
            if (claim_kinds(kind) == 'ellipse') call take_ellipse(ellipses, record)
            call put_reference(writer, record)
        end do

    contains

        subroutine leave_out(which)
            character(len=*), intent(in) :: which

            call note(trim(claim_kinds(kind)) // ' ' // integer_text(number) // which &
                      // ' is left out: ' // trim(status_word(status%code)))
        end subroutine leave_out
    end subroutine put_contact

    !> What Hertz and CONTACT say of an ellipse; its forces are as doubtful as TANG's differ.
    subroutine take_ellipse(ellipses, record)
        type(bench_case_t), intent(in) :: ellipses(:)
        type(reference_record_t), intent(inout) :: record

        type(reference_record_t) :: own

        own = record
        associate (case => ellipses(record%number))
            record%figures(:6) = [case%known%penetration, case%known%pmax, case%known%area, &
                                  case%forces]
        end associate
        record%doubts(:3) = 0.0_wp
        associate (units => figure_units(record))
            record%doubts(4:6) = abs(record%figures(4:6) - own%figures(4:6))/units(4:6)
        end associate
    end subroutine take_ellipse
end module faststrip_lab_claims_references
