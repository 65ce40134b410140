!> What seems wrong in what was read though it can be solved: kept until the result is reported; of
!> many rows one line for each kind.
module faststrip_command_settings_doubts
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_plausible, only: quantities, doubt_about
    use faststrip_base_status, only: message_length, status_word, first_error
    use faststrip_contact_plausible, only: doubts_t
    use faststrip_command_program_console, only: hold
    use faststrip_command_batch_manifest, only: number_text_of, status_counts_t, counted
    implicit none
    private

    public :: hold_doubts, hold_value, tally_t, count_doubts, add_tally, hold_tally
    public :: hold_limitations

    !> How many rows have each kind of doubt, and the first of them.
    type :: tally_t
        integer(int64) :: rows(size(quantities)) = 0
        integer(int64) :: first(size(quantities)) = 0
        integer(int64) :: line(size(quantities)) = 0
        character(len=message_length) :: words(size(quantities)) = ''
    end type tally_t

contains

    !> Keep all words about one contact.
    subroutine hold_doubts(doubts, place)
        type(doubts_t), intent(in) :: doubts  !! found
        character(len=*), intent(in) :: place !! where they stand

        integer :: i

        do i = 1, doubts%n
            call hold(trim(doubts%words(i)) // ' (' // place // ')')
        end do
    end subroutine hold_doubts

    !> Keep words about a number that is outside of practice.
    subroutine hold_value(quantity, name, value, place)
        integer, intent(in) :: quantity       !! place in the table of quantities
        character(len=*), intent(in) :: name  !! of the number
        real(wp), intent(in) :: value         !! in the unit of that table
        character(len=*), intent(in) :: place !! where it stands

        character(len=message_length) :: words

        words = doubt_about(quantity, name, value)
        if (words /= '') call hold(trim(words) // ' (' // place // ')')
    end subroutine hold_value

    !> Count what is doubtful in a row.
    subroutine count_doubts(tally, doubts, row, line)
        type(tally_t), intent(inout) :: tally  !! of the rows so far, in rising order
        type(doubts_t), intent(in) :: doubts   !! found in the row
        integer(int64), intent(in) :: row      !! number of the row
        integer, intent(in) :: line            !! of the file; 0: not known

        integer :: i
        logical :: is_counted(size(quantities))

        is_counted = .false.
        do i = 1, doubts%n
            associate (kind => doubts%quantity(i))
                if (is_counted(kind)) cycle
                is_counted(kind) = .true.
                tally%rows(kind) = tally%rows(kind) + 1
                if (tally%rows(kind) > 1) cycle
                tally%first(kind) = row
                tally%line(kind) = line
                tally%words(kind) = doubts%words(i)
            end associate
        end do
    end subroutine count_doubts

    !> Add what another one has counted.
    subroutine add_tally(tally, other)
        type(tally_t), intent(inout) :: tally !! of all
        type(tally_t), intent(in) :: other    !! of other rows

        integer :: kind

        do kind = 1, size(quantities)
            if (other%rows(kind) == 0) cycle
            if (tally%rows(kind) == 0 .or. other%first(kind) < tally%first(kind)) then
                tally%first(kind) = other%first(kind)
                tally%line(kind) = other%line(kind)
                tally%words(kind) = other%words(kind)
            end if
            tally%rows(kind) = tally%rows(kind) + other%rows(kind)
        end do
    end subroutine add_tally

    !> Keep one line for each kind: the first row that has it, and how many do.
    subroutine hold_tally(tally, file)
        type(tally_t), intent(in) :: tally   !! of all rows
        character(len=*), intent(in) :: file !! that they stand in

        character(len=:), allocatable :: text
        integer :: kind

        do kind = 1, size(quantities)
            if (tally%rows(kind) == 0) cycle
            text = trim(tally%words(kind)) // ' (' // file
            if (tally%line(kind) > 0) text = text // ':' // number_text_of(tally%line(kind))
            if (tally%rows(kind) > 1) text = text // ', the first of ' &
                // number_text_of(tally%rows(kind))
            call hold(text // ')')
        end do
    end subroutine hold_tally

    !> Keep a line about results with a named limitation: how many there are of each. Errors have
    !> lines of their own.
    subroutine hold_limitations(counts, file)
        type(status_counts_t), intent(in) :: counts !! of all results
        character(len=*), intent(in) :: file        !! that they stand in

        character(len=:), allocatable :: text
        integer(int64) :: n
        integer :: code

        text = ''
        do code = 1, first_error - 1
            n = counted(counts, code) - counted(counts, code + 1)
            if (n > 0) text = text // ', ' // trim(status_word(code)) // ' ' // number_text_of(n)
        end do
        if (len(text) == 0) return
        call hold(number_text_of(counted(counts, 1) - counted(counts, first_error)) // ' of ' // &
                  number_text_of(counted(counts, 0)) // ' results have a limitation: ' // &
                  text(3:) // ' (' // file // ')')
    end subroutine hold_limitations
end module faststrip_command_settings_doubts
