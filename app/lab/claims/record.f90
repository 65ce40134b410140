!> What is kept of a contact on which claims are judged: what it is, and what is true of it. One
!> row of `reference/claims/references.csv`.
module faststrip_lab_claims_record
    use faststrip_base_kinds, only: wp, pi
    use faststrip_base_status, only: status_t, clear_status, is_error, set_status, number_text, &
                                     st_file_format
    use faststrip_base_text, only: integer_text
    use faststrip_base_creepage, only: creepage_t
    use faststrip_base_material, only: material_t
    use faststrip_files_csv, only: csv_writer_t, csv_table_t, put_header, put_cell, end_row, &
                                   read_cell, put_cells
    use faststrip_lab_claims_contacts, only: claim_kinds
    implicit none
    private

    public :: reference_record_t, put_reference_header, put_reference, take_reference
    public :: n_figures, figure_names, figure_units

    !> Figures of a contact.
    integer, parameter :: n_figures = 8
    !> What they are called.
    character(len=14), parameter :: figure_names(n_figures) = [character(len=14) :: &
        'penetration', 'pmax', 'area', 'Fx', 'Fy', 'Mz', 'friction_power', 'stick_fraction']
    character(len=20), parameter :: figure_columns(n_figures) = [character(len=20) :: &
        'penetration_mm', 'pmax_MPa', 'area_mm2', 'Fx_N', 'Fy_N', 'Mz_Nmm', 'friction_power_N', &
        'stick_fraction']
    character(len=20), parameter :: doubt_columns(n_figures) = 'doubt_' // figure_names
    character(len=20), parameter :: heads(4) = [character(len=20) :: &
        'kind', 'number', 'state', 'patches']
    character(len=20), parameter :: case_columns(7) = [character(len=20) :: &
        'N_N', 'mu', 'E_MPa', 'nu', 'cksi', 'ceta', 'cphi_rad_per_mm']
    character(len=20), parameter :: extent_columns(2) = [character(len=20) :: &
        'length_mm', 'width_mm']

    !> One contact with one set of creepages.
    type :: reference_record_t
        integer :: kind = 0            !! index of `claim_kinds`
        integer :: number = 0          !! of the kind, from 1
        integer :: state = 0           !! which creepages, from 1
        integer :: patches = 0         !! number of contact patches
        real(wp) :: load = 0.0_wp      !! N
        real(wp) :: mu = 0.0_wp        !! coefficient of friction
        type(material_t) :: material   !! like bodies
        type(creepage_t) :: creepage   !! about y = 0
        real(wp) :: figures(n_figures) = 0.0_wp !! in the order of `figure_names`
        real(wp) :: doubts(n_figures) = 0.0_wp
            !! how far these may be off, over their units
        real(wp) :: extents(2) = 0.0_wp !! of the patches along x and y, for the elements, mm
    end type reference_record_t

contains

    !> What errors of the figures are counted in: of the first three and the power themselves, of
    !> forces mu N, of the moment mu N c, c the root of area over pi, of the stick fraction one.
    pure function figure_units(record) result(units)
        type(reference_record_t), intent(in) :: record !! load, friction and figures
        real(wp) :: units(n_figures)

        real(wp) :: bound

        bound = record%mu*record%load
        units = [record%figures(:3), bound, bound, bound*sqrt(record%figures(3)/pi), &
                 record%figures(7), 1.0_wp]
    end function figure_units

    !> The names of the columns.
    subroutine put_reference_header(writer)
        type(csv_writer_t), intent(inout) :: writer !! an open file

        call put_header(writer, [heads, case_columns, figure_columns, doubt_columns, &
                                 extent_columns])
    end subroutine put_reference_header

    !> One row, six digits of each number, two of each doubt.
    subroutine put_reference(writer, record)
        type(csv_writer_t), intent(inout) :: writer !! an open file with its header
        type(reference_record_t), intent(in) :: record

        real(wp) :: numbers(17)
        character(len=8) :: doubt
        integer :: i

        call put_cell(writer, trim(claim_kinds(record%kind)))
        call put_cell(writer, record%number)
        call put_cells(writer, [record%state, record%patches])
        associate (material => record%material, creepage => record%creepage)
            numbers(:15) = [record%load, record%mu, material%e_wheel, material%nu_wheel, &
                            creepage%cksi, creepage%ceta, creepage%cphi, record%figures]
        end associate
        do i = 1, 15
            call put_cell(writer, trim(number_text(numbers(i))))
        end do
        do i = 1, n_figures
            write (doubt, '(es8.1)') record%doubts(i)
            call put_cell(writer, trim(adjustl(doubt)))
        end do
        do i = 1, 2
            call put_cell(writer, trim(number_text(record%extents(i))))
        end do
        call end_row(writer)
    end subroutine put_reference

    !> Read a row.
    subroutine take_reference(table, row, record, status)
        type(csv_table_t), intent(in) :: table      !! a file of references
        integer, intent(in) :: row                  !! 1 to n_rows
        type(reference_record_t), intent(out) :: record !! as it was written
        type(status_t), intent(out) :: status
            !! `st_file_format`: a column that is missing, a cell that is no number, a kind that is
            !! none

        character(len=:), allocatable :: kind
        real(wp) :: numbers(7)

        call clear_status(status)
        call read_cell(table, row, 'kind', kind, status)
        if (is_error(status)) return
        record%kind = findloc(claim_kinds == kind, .true., dim=1)
        if (record%kind == 0) then
            call set_status(status, st_file_format, 'no such kind of contact: ' &
                            // kind // ' (' // table%file // ', line ' &
                            // integer_text(table%line(row)) // ')')
            return
        end if
        call read_cell(table, row, 'number', record%number, status)
        call read_cell(table, row, 'state', record%state, status)
        call read_cell(table, row, 'patches', record%patches, status)
        call take_numbers(case_columns, numbers)
        record%load = numbers(1)
        record%mu = numbers(2)
        record%material = material_t(numbers(3), numbers(3), numbers(4), numbers(4))
        record%creepage = creepage_t(numbers(5), numbers(6), numbers(7))
        call take_numbers(figure_columns, record%figures)
        call take_numbers(doubt_columns, record%doubts)
        call take_numbers(extent_columns, record%extents)

    contains

        subroutine take_numbers(names, values)
            character(len=*), intent(in) :: names(:)
            real(wp), intent(out) :: values(:)

            integer :: i

            values = 0.0_wp
            do i = 1, size(names)
                call read_cell(table, row, trim(names(i)), values(i), status)
            end do
        end subroutine take_numbers
    end subroutine take_reference
end module faststrip_lab_claims_record
