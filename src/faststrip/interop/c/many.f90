!> Many contacts in one call of the C interface: by several threads, each with a workspace of its
!> own.
!>
!> A result does not depend on the threads. A contact is solved by a cold start, or, within a chain,
!> from the contact before it; a chain is one thread's, and its first contact is a cold start.
!> So it does not matter which contacts a workspace was for before, and not which thread is faster.
module faststrip_interop_c_many
    use, intrinsic :: iso_c_binding, only: c_int, c_size_t, c_intptr_t, c_ptr, c_sizeof, &
                                           c_null_ptr, c_loc, c_associated, c_f_pointer
    use faststrip_base_limits, only: most_gap_points => most_points
    use faststrip_base_status, only: status_t, set_status, clear_status, is_error, count_text, &
                                     message_length, st_bad_argument
    use faststrip_geometry_gap, only: min_gap_points
    use faststrip_interop_c, only: put_text
    use faststrip_interop_c_solve, only: take_gap, solve_fields
    use faststrip_interop_c_structs, only: c_case_t, c_result_t, find_case, methods_of, &
                                           with_elements
    use faststrip_interop_handle, only: handle_t, new_handle, free_handle, find_handle
    use faststrip_interop_threads, only: mutex_t, lock_mutex, unlock_mutex, run_threads
    implicit none
    private

    public :: faststrip_solve_many

    !> `faststrip_gap` of the header.
    type, bind(c) :: c_gap_t
        integer(c_int) :: n
        type(c_ptr) :: y, h, inv2r, inclination
    end type c_gap_t

    !> What the threads of a call share.
    type :: many_t
        integer(c_size_t) :: n = 0           ! contacts
        integer(c_size_t) :: chain = 1       ! contacts of a chain
        integer(c_size_t) :: turn = 1        ! contacts that a thread takes at a time, whole chains
        type(c_case_t), pointer :: cases(:) => null()
        type(c_result_t), pointer :: results(:) => null()
        type(c_gap_t), pointer :: gaps(:) => null()
        integer(c_int), pointer :: gap_of(:) => null() ! from 0 on; null: in order, or one for all
        integer(c_int), pointer :: statuses(:) => null()
        integer :: max_points = 0
        type(mutex_t) :: mutex               ! of all that follows
        integer(c_size_t) :: taken = 0       ! contacts that a thread has taken
        integer :: at_work = 0               ! threads that have a workspace
        type(status_t) :: no_workspace       ! why another one has none
        integer(c_size_t) :: failed = huge(0_c_size_t) ! the first contact without a result
        type(status_t) :: failure            ! and what was wrong
    end type many_t

    !> One thread's part.
    type :: worker_t
        type(handle_t), pointer :: handle => null()
        integer(c_size_t) :: gap = 0         ! that the workspace has; 0: none
        type(status_t) :: gap_status         ! how that ended
        integer(c_size_t) :: solved = 0      ! the last contact with a result
        integer(c_size_t) :: failed = huge(0_c_size_t) ! the first one without
        type(status_t) :: failure
    end type worker_t

contains

    !> Solve many contacts; see the header. With an error nothing was solved.
    integer(c_int) function faststrip_solve_many(n, cases, n_gaps, gaps, gap_of, chain, threads, &
                                                 results, statuses, text, length) &
        bind(c) result(code)
        integer(c_size_t), value :: n      !! number of contacts
        type(c_ptr), value :: cases        !! `n` of `faststrip_case`
        integer(c_int), value :: n_gaps    !! number of gaps
        type(c_ptr), value :: gaps         !! `n_gaps` of `faststrip_gap`
        type(c_ptr), value :: gap_of       !! `n` numbers from 0 on, or null
        integer(c_int), value :: chain     !! contacts of a chain, at least 1
        integer(c_int), value :: threads   !! at least 1
        type(c_ptr), value :: results      !! `n` of `faststrip_result`, written
        type(c_ptr), value :: statuses     !! `n` numbers, written
        type(c_ptr), value :: text         !! `length` characters, written; or null
        integer(c_size_t), value :: length !! with the closing zero

        type(many_t), target :: many
        type(status_t) :: status
        integer(c_size_t) :: turns
        integer(c_int) :: ignored

        call take_arguments(many, n, cases, n_gaps, gaps, gap_of, chain, threads, results, &
                            statuses, status)
        if (.not. is_error(status) .and. n > 0) then
            turns = (n + many%turn - 1)/many%turn
            call run_threads(int(min(int(threads, c_size_t), turns)), work, c_loc(many))
            if (many%at_work == 0) status = many%no_workspace
        end if
        code = status%code
        if (.not. c_associated(text)) return
        if (is_error(status)) then
            code = max(code, put_text(trim(status%message), text, length))
        else if (many%failed <= n) then
            call tell_failure(many, text, length)
        else
            ignored = put_text('', text, length)
        end if
    end function faststrip_solve_many

    !> Check what the call was given, and see what its workspaces need.
    subroutine take_arguments(many, n, cases, n_gaps, gaps, gap_of, chain, threads, results, &
                              statuses, status)
        type(many_t), intent(inout) :: many
        integer(c_size_t), intent(in) :: n
        integer(c_int), intent(in) :: n_gaps, chain, threads
        type(c_ptr), intent(in) :: cases, gaps, gap_of, results, statuses
        type(status_t), intent(out) :: status

        ! Tuned [turns]: of a thread. Origin: costs of contacts differ by 1000; a turn is a lock.
        integer, parameter :: turns_of_thread = 16
        ! Tuned [contacts]: of a turn at most. Origin: 1 ms of the fastest methods.
        integer, parameter :: longest_turn = 256

        type(c_case_t), pointer :: first

        call clear_status(status)
        if (n < 0 .or. n >= ishft(huge(n), -10)) then
            call set_status(status, st_bad_argument, 'the number of contacts is out of range')
        else if (threads < 1) then
            call refuse('threads', threads)
        else if (chain < 1) then
            call refuse('chain', chain)
        else if (n_gaps < 1) then
            call refuse('n_gaps', n_gaps)
        else if (n > 0 .and. .not. (c_associated(cases) .and. c_associated(gaps) .and. &
                                    c_associated(results) .and. c_associated(statuses))) then
            call set_status(status, st_bad_argument, 'contacts, gaps, results and statuses ' // &
                            'must be there')
        else if (.not. c_associated(gap_of) .and. n_gaps /= 1 .and. n_gaps /= n) then
            call set_status(status, st_bad_argument, 'without gap_of there must be one gap, ' // &
                            'or one of each contact, got '//count_text(n_gaps))
        end if
        if (is_error(status) .or. n == 0) return
        call find_case(cases, first, status)
        if (is_error(status)) return
        many%n = n
        call c_f_pointer(cases, many%cases, [n])
        call c_f_pointer(results, many%results, [n])
        call c_f_pointer(statuses, many%statuses, [n])
        call c_f_pointer(gaps, many%gaps, [n_gaps])
        if (c_associated(gap_of)) call c_f_pointer(gap_of, many%gap_of, [n])
        ! What cannot be a gap is an error of its contacts.
        many%max_points = max(min_gap_points, &
                              maxval(many%gaps%n, many%gaps%n <= most_gap_points))
        many%chain = min(int(chain, c_size_t), n)
        many%turn = max(1_c_size_t, min(int(longest_turn, c_size_t), &
                                        n/(turns_of_thread*int(threads, c_size_t))))
        many%turn = (many%turn + many%chain - 1)/many%chain*many%chain

    contains

        subroutine refuse(name, value)
            character(len=*), intent(in) :: name
            integer(c_int), intent(in) :: value

            call set_status(status, st_bad_argument, name//' must be at least 1, got ' // &
                            count_text(value))
        end subroutine refuse
    end subroutine take_arguments

    !> One thread: contacts until there are no more.
    type(c_ptr) function work(shared) bind(c, name='') result(nothing)
        type(c_ptr), value :: shared

        type(many_t), pointer :: many
        type(worker_t) :: worker
        type(status_t) :: status
        integer(c_int) :: code
        integer(c_intptr_t) :: number
        integer(c_size_t) :: first, last, i

        nothing = c_null_ptr
        call c_f_pointer(shared, many)
        call new_handle(methods_of(many%cases(1)), many%max_points, &
                        with_elements(many%cases(1)), number, status)
        call lock_mutex(many%mutex)
        if (is_error(status)) then
            many%no_workspace = status
        else
            many%at_work = many%at_work + 1
        end if
        call unlock_mutex(many%mutex)
        ! The others do what there is to do.
        if (is_error(status)) return
        call find_handle(number, worker%handle, code)
        do
            call lock_mutex(many%mutex)
            first = many%taken + 1
            last = min(many%taken + many%turn, many%n)
            many%taken = last
            call unlock_mutex(many%mutex)
            if (first > last) exit
            do i = first, last
                call solve_one(many, worker, i)
            end do
        end do
        call lock_mutex(many%mutex)
        if (worker%failed < many%failed) then
            many%failed = worker%failed
            many%failure = worker%failure
        end if
        call unlock_mutex(many%mutex)
        call free_handle(number, status)
    end function work

    !> One contact, with its gap; if there is no result, zeros.
    subroutine solve_one(many, worker, i)
        type(many_t), intent(in) :: many
        type(worker_t), intent(inout) :: worker
        integer(c_size_t), intent(in) :: i

        type(c_case_t), pointer :: ignored
        type(c_case_t) :: fields
        type(status_t) :: status
        logical :: follows

        call find_case(c_loc(many%cases(i)), ignored, status)
        if (.not. is_error(status)) call hand_gap_over(many, worker, i, status)
        if (.not. is_error(status)) then
            follows = mod(i - 1, many%chain) > 0 .and. worker%solved == i - 1
            fields = many%cases(i)
            if (.not. follows) fields%warm_start = 0
            call solve_fields(worker%handle, fields, many%results(i))
            status = worker%handle%status
        else
            many%results(i) = c_result_t(size=c_sizeof(many%results(i)))
        end if
        many%statuses(i) = status%code
        if (.not. is_error(status)) then
            worker%solved = i
        else if (i < worker%failed) then
            worker%failed = i
            worker%failure = status
        end if
    end subroutine solve_one

    !> Give the workspace the gap of a contact, unless it has it.
    subroutine hand_gap_over(many, worker, i, status)
        type(many_t), intent(in) :: many
        type(worker_t), intent(inout) :: worker
        integer(c_size_t), intent(in) :: i
        type(status_t), intent(out) :: status

        integer(c_size_t) :: k

        k = merge(1_c_size_t, i, size(many%gaps) == 1)
        if (associated(many%gap_of)) k = int(many%gap_of(i), c_size_t) + 1
        if (k < 1 .or. k > size(many%gaps)) then
            call set_status(status, st_bad_argument, 'gap_of must be from 0 to ' // &
                            trim(count_text(size(many%gaps) - 1))//', got ' // &
                            count_text(many%gap_of(i)))
            return
        end if
        if (k /= worker%gap) then
            associate (gap => many%gaps(k))
                call take_gap(worker%handle, gap%n, gap%y, gap%h, gap%inv2r, gap%inclination)
            end associate
            worker%gap = k
            worker%gap_status = worker%handle%status
        end if
        status = worker%gap_status
    end subroutine hand_gap_over

    !> The words of the first contact without a result; what does not fit is cut.
    subroutine tell_failure(many, text, length)
        type(many_t), intent(in) :: many
        type(c_ptr), intent(in) :: text
        integer(c_size_t), intent(in) :: length

        character(len=message_length + 40) :: words
        integer(c_int) :: ignored

        write (words, '(ss, a, i0, 2a)') 'contacts[', many%failed - 1, ']: ', many%failure%message
        ignored = put_text(trim(words), text, length)
    end subroutine tell_failure
end module faststrip_interop_c_many
