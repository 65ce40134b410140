!> Reading a wear law from a CSV file.
module faststrip_files_wear_law
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, st_file_format
    use faststrip_base_text, only: integer_text, lower_case, parse_real, set_place_status, &
                                   trim_blanks
    use faststrip_files_csv, only: csv_table_t, read_csv, require_column, cell_number, cell_text
    use faststrip_tangential_wear_law, only: wear_law_t, check_wear_law, most_regimes, &
                                             no_limit
    implicit none
    private

    public :: read_wear_law

    character(len=*), parameter :: columns(4) = [character(len=24) :: &
        'from_N_per_mm2', 'to_N_per_mm2', 'constant_ug_per_m_mm2', 'slope_ug_per_m_N']
    integer, parameter :: to_column = 2 ! of these

contains

    !> Read the comment lines `# source: ...` (where the numbers stand), `# body: wheel` or `rail`
    !> (which of them wears so) and `# density_kg_per_m3: ...`, each once, and one row a regime with
    !> the columns `from_N_per_mm2`, `to_N_per_mm2`, `constant_ug_per_m_mm2`, `slope_ug_per_m_N`, in
    !> any order. The last regime has no end where `inf` or nothing stands for it. Nothing is
    !> repaired: what `check_wear_law` would refuse is refused here with the file and the line.
    subroutine read_wear_law(path, law, source, status)
        character(len=*), intent(in) :: path       !! name of the file
        type(wear_law_t), intent(out) :: law       !! no regimes on an error
        character(len=:), allocatable, intent(out) :: source !! what the file names as its source
        type(status_t), intent(out) :: status      !! `st_file_missing`, `st_file_format`,
                                                   !! `st_not_increasing`, `st_bad_argument`
        type(csv_table_t) :: table
        type(wear_law_t) :: read

        source = ''
        call read_csv(path, table, status)
        if (is_error(status)) return
        call take_notes(table, read, source, status)
        if (is_error(status)) return
        call take_regimes(table, read, status)
        if (is_error(status)) return
        law = read
    end subroutine read_wear_law

    subroutine take_notes(table, law, source, status)
        type(csv_table_t), intent(in) :: table
        type(wear_law_t), intent(inout) :: law
        character(len=:), allocatable, intent(inout) :: source
        type(status_t), intent(out) :: status

        character(len=:), allocatable :: text
        integer :: line
        logical :: valid

        call take_note(table, 'source', text, line, status)
        if (is_error(status)) return
        source = text
        call take_note(table, 'body', text, line, status)
        if (is_error(status)) return
        if (text /= 'wheel' .and. text /= 'rail') then
            call set_place_status(status, st_file_format, 'body must be wheel or rail', &
                                  "'" // text // "'", table%file, line)
            return
        end if
        law%of_wheel = text == 'wheel'
        call take_note(table, 'density_kg_per_m3', text, line, status)
        if (is_error(status)) return
        call parse_real(text, law%density, valid)
        if (.not. (valid .and. law%density > 0.0_wp)) &
            call set_place_status(status, st_file_format, &
                                  'density_kg_per_m3 must be a number above 0', &
                                  "'" // text // "'", table%file, line)
    end subroutine take_notes

    ! What stands behind `NAME:` in a comment line; it must stand in one of them, and not be empty.
    subroutine take_note(table, name, text, line, status)
        type(csv_table_t), intent(in) :: table
        character(len=*), intent(in) :: name
        character(len=:), allocatable, intent(out) :: text
        integer, intent(out) :: line
        type(status_t), intent(out) :: status

        integer :: i, colon

        call clear_status(status)
        text = ''
        line = 0
        do i = 1, size(table%comments)
            associate (comment => table%comments(i)%text)
                colon = index(comment, ':')
                if (colon == 0) cycle
                if (lower_case(trim_blanks(comment(:colon - 1))) /= name) cycle
                if (line > 0) then
                    call set_place_status(status, st_file_format, name // ' must stand once', &
                                          comment, table%file, table%comment_line(i))
                    return
                end if
                text = trim_blanks(comment(colon + 1:))
                line = table%comment_line(i)
            end associate
        end do
        if (len(text) == 0) &
            call set_place_status(status, st_file_format, &
                                  'a line must tell # ' // name // ': ...', 'none', table%file, &
                                  line)
    end subroutine take_note

    subroutine take_regimes(table, law, status)
        type(csv_table_t), intent(in) :: table
        type(wear_law_t), intent(inout) :: law
        type(status_t), intent(out) :: status

        type(status_t) :: words
        real(wp) :: number(size(columns))
        integer :: column(size(columns)), row, i, regime

        do i = 1, size(columns)
            call require_column(table, trim(columns(i)), column(i), status)
            if (is_error(status)) return
        end do
        if (table%n_rows < 1 .or. table%n_rows > most_regimes) then
            call set_place_status(status, st_file_format, 'a wear law must have 1 to ' &
                                  // integer_text(most_regimes) // ' regimes', &
                                  integer_text(table%n_rows), table%file, 0)
            return
        end if
        law%n = table%n_rows
        do row = 1, table%n_rows
            do i = 1, size(columns)
                if (i == to_column .and. row == table%n_rows) then
                    number(i) = no_limit
                    if (has_no_end(cell_text(table, row, column(i)))) cycle
                end if
                call cell_number(table, row, column(i), number(i), status)
                if (is_error(status)) return
            end do
            law%from(row) = number(1)
            law%to(row) = number(2)
            law%constant(row) = number(3)
            law%slope(row) = number(4)
        end do
        call check_wear_law(law, words, regime)
        if (is_error(words)) then
            i = 0
            if (regime > 0) i = table%line(regime)
            call set_place_status(status, words%code, trim(words%message), '', table%file, i)
        end if
    end subroutine take_regimes

    ! Does a cell say that a regime goes on for ever?
    pure logical function has_no_end(text)
        character(len=*), intent(in) :: text

        select case (lower_case(text))
        case ('', 'inf', '+inf', 'infinity'); has_no_end = .true.
        case default; has_no_end = .false.
        end select
    end function has_no_end
end module faststrip_files_wear_law
