!> Long work in parts: which items a part has, what its output is called, and how any number of
!> processes share all of them. What the items are is the caller's business.
module faststrip_command_batch_parts
    use, intrinsic :: iso_c_binding, only: c_int
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_text, only: integer_text
    use faststrip_command_batch_store, only: most_lost
    use faststrip_command_program_options, only: command_t, option_t, given, option_integer, &
                                                 option_part, most_parts
    use faststrip_command_program_console, only: usage_error
    implicit none
    private

    public :: part_options, part_choice_t, take_part_options, share_of
    public :: part_beginning, part_name
    public :: parts_t, start_parts, next_part, mark_part, wait_for_others, least_time

    !> How long a piece of work shall take at least, s; so long parts are waited for that other
    !> processes have.
    real(wp), parameter :: least_time = 0.25_wp*most_lost

    !> For the table of a subcommand.
    type(option_t), parameter :: part_options(3) = [ &
        option_t('--part', 'k/K', 'only part k of K, with a manifest beside it; see merge:' &
                 // new_line('a') // 'for array jobs, whose tasks run at any time'), &
        option_t('--parts', 'K', 'K parts, shared with whatever other processes do the' &
                 // new_line('a') // 'same; the last process joins them: for processes' &
                 // new_line('a') // 'that run together, of shells, srun or mpirun'), &
        option_t('--resume', '', 'go on with what an ended run has left')]

    !> What was asked for.
    type :: part_choice_t
        integer :: part = 1              !! the part, of `parts`
        integer :: parts = 1             !! how many
        logical :: is_part = .false.     !! is it one part?
        logical :: is_shared = .false.   !! are all parts shared with other processes?
        logical :: resumes = .false.     !! is an ended run gone on with?
    end type part_choice_t

    !> Which parts are made.
    type :: parts_t
        private
        logical, allocatable :: is_made(:)
        integer :: last = 0                 ! tried last
        logical :: is_waiting = .false.     ! has another process one of them?
    end type parts_t

    interface
        subroutine c_nap(milliseconds) bind(c, name='faststrip_nap')
            import :: c_int
            integer(c_int), value :: milliseconds
        end subroutine c_nap
    end interface

contains

    !> What the options of `part_options` say; a usage error if they do not fit.
    type(part_choice_t) function take_part_options(command) result(choice)
        type(command_t), intent(in) :: command !! parsed, with `part_options` and `-o` in its table

        choice%is_part = given(command, '--part')
        choice%is_shared = given(command, '--parts')
        choice%resumes = given(command, '--resume') .or. choice%is_shared
        if (choice%is_part .and. choice%is_shared) &
            call usage_error('--part and --parts must not be given together', command%name)
        call option_part(command, choice%part, choice%parts)
        choice%parts = option_integer(command, '--parts', choice%parts, least=1, most=most_parts)
    end function take_part_options

    !> The items of a part: as many as those of any other, but for one unit.
    pure subroutine share_of(items, unit, part, parts, first, last)
        integer(int64), intent(in) :: items  !! of all parts
        integer, intent(in) :: unit          !! items that stay together, >= 1
        integer, intent(in) :: part, parts   !! which one of how many
        integer(int64), intent(out) :: first !! its first item
        integer(int64), intent(out) :: last  !! its last one; less than `first`: it has none

        integer(int64) :: units

        units = (items + unit - 1)/unit
        first = bound(part - 1) + 1
        last = bound(part)

    contains

        ! Without a product of two large numbers.
        pure integer(int64) function bound(k)
            integer, intent(in) :: k

            bound = min(items, unit*(k*(units/parts) + k*modulo(units, int(parts, int64))/parts))
        end function bound
    end subroutine share_of

    !> How the names of the outputs of shared parts, and of what is made beside them, begin; a digit
    !> follows.
    pure function part_beginning(path) result(name)
        character(len=*), intent(in) :: path !! of all of it
        character(len=:), allocatable :: name

        name = path // '.part'
    end function part_beginning

    !> What the output of a part is called where the parts are shared.
    pure function part_name(path, part, parts) result(name)
        character(len=*), intent(in) :: path !! of all of it
        integer, intent(in) :: part, parts   !! which one of how many
        character(len=:), allocatable :: name

        character(len=:), allocatable :: number, most

        number = integer_text(part)
        most = integer_text(parts)
        name = part_beginning(path) // repeat('0', len(most) - len(number)) // number // 'of' &
               // most
    end function part_name

    !> Begin with parts of which none is known to be made.
    subroutine start_parts(parts, n)
        type(parts_t), intent(out) :: parts !! serves one run
        integer, intent(in) :: n            !! how many

        allocate (parts%is_made(n), source=.false.)
    end subroutine start_parts

    !> The next part to try; 0 if all are made. Waits before it begins again with those that other
    !> processes have: they may be ended.
    integer function next_part(parts) result(part)
        type(parts_t), intent(inout) :: parts !! of `start_parts`

        do
            do part = parts%last + 1, size(parts%is_made)
                if (parts%is_made(part)) cycle
                parts%last = part
                return
            end do
            part = 0
            if (all(parts%is_made)) return
            if (parts%is_waiting) call wait_for_others()
            parts%is_waiting = .false.
            parts%last = 0
        end do
    end function next_part

    !> Let other processes do what they have in hand.
    subroutine wait_for_others()
        call c_nap(int(1.0e3_wp*least_time, c_int)) ! Given: ms
    end subroutine wait_for_others

    !> Say what became of the part that was tried.
    subroutine mark_part(parts, part, is_busy)
        type(parts_t), intent(inout) :: parts !! of `start_parts`
        integer, intent(in) :: part           !! of `next_part`
        logical, intent(in) :: is_busy        !! has another process it? Else it is made

        parts%is_made(part) = .not. is_busy
        if (is_busy) parts%is_waiting = .true.
    end subroutine mark_part
end module faststrip_command_batch_parts
