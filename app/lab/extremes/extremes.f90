!> `faststrip-lab bench extremes`: how accurate and how steady everything is where it is hardest.
module faststrip_lab_extremes
    use faststrip_files_csv, only: csv_writer_t, put_comment
    use faststrip_lab_extremes_influence, only: references_t, read_references, influence_extremes
    use faststrip_lab_extremes_noise, only: named_case_t, find_contacts, noise_extremes, &
                                            rounding_extremes
    use faststrip_lab_extremes_normal, only: normal_extremes
    use faststrip_lab_extremes_rows, only: put_row_header
    use faststrip_lab_extremes_tangential, only: tangential_extremes
    use faststrip_command_program_console, only: begin_table, end_table
    implicit none
    private

    public :: bench_extremes, extreme_parts

    !> What `only` may name.
    character(len=*), parameter :: extreme_parts(5) = [character(len=10) :: 'influence', &
        'normal', 'tangential', 'noise', 'rounding']

contains

    !> Measure everything and write the CSV.
    subroutine bench_extremes(file, only, quick, contacts, references, examples)
        character(len=*), intent(in) :: file       !! to write, - for stdout
        character(len=*), intent(in) :: only       !! one of `extreme_parts`; empty: all
        logical, intent(in) :: quick               !! few points of everything
        character(len=*), intent(in) :: contacts   !! folder of the paper's contacts
        character(len=*), intent(in) :: references !! folder of the influence coefficients
        character(len=*), intent(in) :: examples   !! folder of the examples

        type(references_t) :: influence_numbers(2)
        type(named_case_t), allocatable :: all_contacts(:)
        type(csv_writer_t) :: writer

        if (wanted('influence')) call read_references(references, influence_numbers)
        if (wanted('noise') .or. wanted('rounding')) &
            call find_contacts(contacts, examples, all_contacts)
        call begin_table(writer, file)
        call put_comment(writer, 'value: relative unless the quantity says otherwise, the ' &
                         // 'uncertainty of the reference added')
        call put_row_header(writer)
        if (wanted('influence')) call influence_extremes(quick, influence_numbers, writer)
        if (wanted('normal')) call normal_extremes(quick, writer)
        if (wanted('tangential')) call tangential_extremes(quick, writer)
        if (wanted('noise')) call noise_extremes(quick, all_contacts, writer)
        if (wanted('rounding')) call rounding_extremes(quick, all_contacts, writer)
        call end_table(writer)

    contains

        logical function wanted(part)
            character(len=*), intent(in) :: part

            wanted = only == '' .or. only == part
        end function wanted
    end subroutine bench_extremes
end module faststrip_lab_extremes
