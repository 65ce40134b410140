!> What is kept of a contact for fitting corrections of the creep forces: what it is drawn from,
!> and forces of the reference for some creepages. One row of a CSV file; cells hold lists, parted
!> by blanks.
module faststrip_lab_forces_record
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, st_file_format
    use faststrip_base_text, only: integer_text, parse_real, trim_blanks
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t
    use faststrip_files_csv, only: csv_writer_t, csv_table_t, put_header, put_cell, end_row, &
                                   real_text, read_cell, put_cells
    use faststrip_files_profile_points, only: split_words
    use faststrip_tangential_types, only: tangential_result_t
    implicit none
    private

    public :: force_record_t, put_record_header, put_record, take_record
    public :: most_states

    !> Creepages of each contact.
    integer, parameter :: most_states = 6

    !> Creepages, and what they cause.
    type :: force_state_t
        type(creepage_t) :: creepage        !! about y = 0
        type(tangential_result_t) :: forces !! by the reference
        type(tangential_result_t) :: coarse !! by the reference with elements twice as long and wide
        integer :: steps = 0                !! of the reference
        real(wp) :: residual = 0.0_wp       !! of the reference
    end type force_state_t

    !> One contact.
    type :: force_record_t
        integer :: seed = 0                    !! of the series of contacts
        integer :: number = 0                  !! from 1
        character(len=:), allocatable :: family !! its gap's
        character(len=:), allocatable :: status !! `ok`, or why it was left out
        real(wp) :: load = 0.0_wp              !! N
        real(wp) :: mu = 0.0_wp                !! coefficient of friction
        type(material_t) :: material           !! like bodies
        integer :: elements = 0                !! of the reference, in contact
        integer :: n_states = 0                !! those that count
        type(force_state_t) :: states(most_states)
    end type force_record_t

    ! Columns with one value, with one a state.
    character(len=16), parameter :: heads(9) = [character(len=16) :: &
        'seed', 'number', 'family', 'status', 'load_N', 'mu', 'E_MPa', 'nu', 'elements']
    character(len=16), parameter :: state_lists(13) = [character(len=16) :: &
        'cksi', 'ceta', 'cphi_rad_per_mm', 'Fx_N', 'Fy_N', 'Mz_Nmm', 'friction_power_N', &
        'stick_fraction', 'Fx_coarse_N', 'Fy_coarse_N', 'Mz_coarse_Nmm', 'steps', 'residual']

contains

    !> The names of the columns.
    subroutine put_record_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_header(writer, [heads, state_lists])
    end subroutine put_record_header

    !> One contact.
    subroutine put_record(writer, record)
        type(csv_writer_t), intent(inout) :: writer !! an open file with its header
        type(force_record_t), intent(in) :: record

        call put_cells(writer, [record%seed, record%number])
        call put_cell(writer, record%family)
        call put_cell(writer, record%status)
        call put_cells(writer, [record%load, record%mu, record%material%e_wheel, &
                                record%material%nu_wheel])
        call put_cell(writer, record%elements)
        associate (states => record%states, n => record%n_states)
            call put_list(writer, states%creepage%cksi, n)
            call put_list(writer, states%creepage%ceta, n)
            call put_list(writer, states%creepage%cphi, n)
            call put_list(writer, states%forces%fx, n)
            call put_list(writer, states%forces%fy, n)
            call put_list(writer, states%forces%mz, n)
            call put_list(writer, states%forces%friction_power, n)
            call put_list(writer, states%forces%stick_fraction, n)
            call put_list(writer, states%coarse%fx, n)
            call put_list(writer, states%coarse%fy, n)
            call put_list(writer, states%coarse%mz, n)
            call put_list(writer, real(states%steps, wp), n)
            call put_list(writer, states%residual, n)
        end associate
        call end_row(writer)
    end subroutine put_record

    subroutine put_list(writer, values, n)
        type(csv_writer_t), intent(inout) :: writer
        real(wp), intent(in) :: values(:)
        integer, intent(in) :: n ! those that count

        character(len=:), allocatable :: text
        integer :: i

        text = ''
        do i = 1, n
            text = text // ' ' // real_text(values(i))
        end do
        call put_cell(writer, trim_blanks(text))
    end subroutine put_list

    !> Read a row.
    subroutine take_record(table, row, record, status)
        type(csv_table_t), intent(in) :: table       !! a file of contacts
        integer, intent(in) :: row                   !! 1 to n_rows
        type(force_record_t), intent(out) :: record  !! as it was written
        type(status_t), intent(out) :: status
            !! `st_file_format`: a column that is missing, a cell that is no number, lists of
            !! different lengths, more than `most_states` states

        real(wp), allocatable :: values(:, :)
        real(wp) :: e, nu
        integer :: n

        call clear_status(status)
        e = 0.0_wp
        nu = 0.0_wp
        call read_cell(table, row, 'seed', record%seed, status)
        call read_cell(table, row, 'number', record%number, status)
        call read_cell(table, row, 'family', record%family, status)
        call read_cell(table, row, 'status', record%status, status)
        call read_cell(table, row, 'load_N', record%load, status)
        call read_cell(table, row, 'mu', record%mu, status)
        call read_cell(table, row, 'E_MPa', e, status)
        call read_cell(table, row, 'nu', nu, status)
        if (is_error(status)) return
        record%material = material_t(e, e, nu, nu)
        call take_lists(table, row, state_lists, values, status)
        if (is_error(status)) return
        n = size(values, 1)
        if (n > most_states) then
            call set_status(status, st_file_format, 'at most ' // integer_text(most_states) &
                            // ' states, got ' // integer_text(n) // place(table, row))
            return
        end if
        record%n_states = n
        associate (states => record%states)
            states(:n)%creepage%cksi = values(:, 1)
            states(:n)%creepage%ceta = values(:, 2)
            states(:n)%creepage%cphi = values(:, 3)
            states(:n)%forces%fx = values(:, 4)
            states(:n)%forces%fy = values(:, 5)
            states(:n)%forces%mz = values(:, 6)
            states(:n)%forces%friction_power = values(:, 7)
            states(:n)%forces%stick_fraction = values(:, 8)
            states(:n)%coarse%fx = values(:, 9)
            states(:n)%coarse%fy = values(:, 10)
            states(:n)%coarse%mz = values(:, 11)
            states(:n)%steps = nint(values(:, 12))
            states(:n)%residual = values(:, 13)
        end associate
    end subroutine take_record

    !> Lists of one length from several columns.
    subroutine take_lists(table, row, names, values, status)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row
        character(len=*), intent(in) :: names(:)
        real(wp), allocatable, intent(out) :: values(:, :) ! shape (length, columns)
        type(status_t), intent(out) :: status

        ! More words than a contact has states, so that too many are told by their number.
        integer, parameter :: most_words = 1000
        character(len=:), allocatable :: text
        integer :: i, k, n, first(most_words), last(most_words)
        logical :: is_valid

        call clear_status(status)
        do i = 1, size(names)
            call read_cell(table, row, trim(names(i)), text, status)
            if (is_error(status)) return
            n = 0
            if (text /= '') call split_words(text, first, last, n)
            if (i == 1) allocate (values(n, size(names)))
            is_valid = n == size(values, 1)
            do k = 1, n
                if (is_valid .and. k <= size(first)) &
                    call parse_real(text(first(k):last(k)), values(k, i), is_valid)
            end do
            if (.not. is_valid) then
                call set_status(status, st_file_format, 'not ' // integer_text(size(values, 1)) &
                                // ' numbers in column ' // trim(names(i)) // place(table, row))
                return
            end if
        end do
    end subroutine take_lists

    function place(table, row) result(text)
        type(csv_table_t), intent(in) :: table
        integer, intent(in) :: row
        character(len=:), allocatable :: text

        text = ' (' // table%file // ', line ' // integer_text(table%line(row)) // ')'
    end function place
end module faststrip_lab_forces_record
