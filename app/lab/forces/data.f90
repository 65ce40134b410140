!> `faststrip-lab force-data`: reference creep forces of random contacts.
module faststrip_lab_forces_data
    use faststrip_base_text, only: integer_text
    use faststrip_files_csv, only: csv_writer_t, put_comment
    use faststrip_command_program_console, only: usage_error, progress, begin_table, end_table
    use faststrip_command_program_options, only: command_t, option_t, parse_command, option_text, &
                                                 option_integer
    use faststrip_lab_forces_contacts, only: force_contact_t, draw_force_contact
    use faststrip_lab_random_force_gaps, only: force_families
    use faststrip_lab_forces_record, only: force_record_t, put_record_header, put_record
    use faststrip_lab_forces_reference, only: reference_workspaces_t, solve_reference
    implicit none
    private

    public :: run_force_data

    ! Tuned [elements]. Origin: measured, the least error of the forces for the time.
    integer, parameter :: usual_across = 36

contains

    !> Run the subcommand from the command line.
    subroutine run_force_data()
        type(command_t) :: command
        type(csv_writer_t) :: writer
        type(reference_workspaces_t) :: work
        type(force_contact_t) :: contact
        type(force_record_t) :: record
        integer :: seed, first, contacts, across, number, family
        character(len=:), allocatable :: name

        command%name = 'force-data'
        command%usage = ''
        command%about = &
            'For developers: creep forces of random contacts with one patch by NORM and TANG for' &
            // new_line('a') // 'six creepages, on two grids. CSV, one row a contact; lists are' &
            // new_line('a') // 'parted by blanks. A contact is the same' &
            // ' wherever the run starts.' // new_line('a')
        command%options = [ &
            option_t('--cases', 'INTEGER', 'number of contacts (default 200)'), &
            option_t('--seed', 'INTEGER', 'which series of contacts (default 1)'), &
            option_t('--first', 'INTEGER', 'number of the first contact (default 1)'), &
            option_t('--family', 'NAME', &
                     'contacts of one family (default: of all but the last two)'), &
            option_t('--across', 'INTEGER', &
                     'elements across the patch, each way, 8 to 500 (default ' &
                     // integer_text(usual_across) // ')'), &
            option_t('-o', 'FILE', 'write the CSV there (default stdout)', writes=.true.)]
        call parse_command(command, 0)
        contacts = option_integer(command, '--cases', 200, least=1)
        seed = option_integer(command, '--seed', 1, least=0)
        first = option_integer(command, '--first', 1, least=1)
        across = option_integer(command, '--across', usual_across, least=8, most=500)
        name = option_text(command, '--family', '')
        family = findloc(force_families == name, .true., dim=1)
        if (family == 0 .and. name /= '') &
            call usage_error('--family must be a family of gaps, got ' // trim(name), command%name)
        if (contacts > huge(contacts) - first) &
            call usage_error('--cases must end before contact ' // integer_text(huge(contacts)) &
                             // ', got ' // integer_text(contacts), command%name)
        call begin_table(writer, option_text(command, '-o', '-'))
        call put_comment(writer, 'NORM and TANG, ' // integer_text(across) &
                         // ' elements across, *_coarse half as many; seed ' // integer_text(seed))
        call put_record_header(writer)
        do number = first, first + contacts - 1
            call draw_force_contact(seed, number, contact, family)
            call solve_reference(work, contact, across, record)
            call put_record(writer, record)
            call progress('contact', number - first + 1, contacts)
        end do
        call end_table(writer)
    end subroutine run_force_data
end module faststrip_lab_forces_data
