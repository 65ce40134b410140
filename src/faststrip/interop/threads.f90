!> POSIX threads that end with the call that made them, and the mutexes they need.
!>
!> OpenMP keeps its threads from call to call. A process that forks has lost them, and the child
!> waits for them for ever; here nothing is kept that a fork could lose.
module faststrip_interop_threads
    use, intrinsic :: iso_c_binding, only: c_int, c_long, c_ptr, c_funptr, c_null_ptr, c_funloc
    implicit none
    private

    public :: mutex_t, lock_mutex, unlock_mutex, run_threads, thread_work

    !> C's `pthread_mutex_t`, at most 48 bytes with the C libraries of Linux, where one of zeros is
    !> ready to be used (PTHREAD_MUTEX_INITIALIZER).
    type :: mutex_t
        private
        integer(c_long) :: content(16) = 0
    end type mutex_t

    ! C's `sigset_t` has 128 bytes on Linux.
    integer, parameter :: signal_words = 16
    ! Given: the C library's number on Linux, SIG_SETMASK.
    integer(c_int), parameter :: set_mask = 2

    abstract interface
        !> What a thread does; what it gives is not looked at.
        type(c_ptr) function thread_work(shared) bind(c)
            import :: c_ptr
            implicit none
            type(c_ptr), value :: shared !! the same of all threads
        end function thread_work
    end interface

    interface
        integer(c_int) function pthread_mutex_lock(mutex) bind(c)
            import :: c_int, c_long
            implicit none
            integer(c_long), intent(inout) :: mutex(*)
        end function pthread_mutex_lock

        integer(c_int) function pthread_mutex_unlock(mutex) bind(c)
            import :: c_int, c_long
            implicit none
            integer(c_long), intent(inout) :: mutex(*)
        end function pthread_mutex_unlock

        integer(c_int) function pthread_create(thread, attributes, work, shared) bind(c)
            import :: c_int, c_long, c_ptr, c_funptr
            implicit none
            integer(c_long), intent(out) :: thread
            type(c_ptr), value :: attributes, shared
            type(c_funptr), value :: work
        end function pthread_create

        integer(c_int) function pthread_join(thread, answer) bind(c)
            import :: c_int, c_long, c_ptr
            implicit none
            integer(c_long), value :: thread
            type(c_ptr), value :: answer
        end function pthread_join

        integer(c_int) function pthread_sigmask(how, new, old) bind(c)
            import :: c_int, c_long
            implicit none
            integer(c_int), value :: how
            integer(c_long), intent(in) :: new(*)
            integer(c_long), intent(out) :: old(*)
        end function pthread_sigmask

        integer(c_int) function sigfillset(signals) bind(c)
            import :: c_int, c_long
            implicit none
            integer(c_long), intent(out) :: signals(*)
        end function sigfillset
    end interface

contains

    !> Wait until no other thread holds the mutex, and hold it.
    subroutine lock_mutex(mutex)
        type(mutex_t), intent(inout) :: mutex !! not held by this thread

        integer(c_int) :: ignored

        ignored = pthread_mutex_lock(mutex%content)
    end subroutine lock_mutex

    !> Let the others have it.
    subroutine unlock_mutex(mutex)
        type(mutex_t), intent(inout) :: mutex !! held by this thread

        integer(c_int) :: ignored

        ignored = pthread_mutex_unlock(mutex%content)
    end subroutine unlock_mutex

    !> Let this thread and others do the same work, and wait until all have done it. Where the
    !> system has no more threads to give, fewer do it; this one does in any case. Signals go to the
    !> host's own threads.
    subroutine run_threads(n, work, shared)
        integer, intent(in) :: n          !! threads together, at least 1
        procedure(thread_work) :: work    !! finds what is left to do
        type(c_ptr), intent(in) :: shared !! for all of them

        integer(c_long), allocatable :: threads(:)
        integer(c_long) :: all_signals(signal_words), before(signal_words), no_matter(signal_words)
        type(c_ptr) :: ignored_answer
        integer(c_int) :: ignored
        integer :: i, made, failure

        made = 0
        allocate (threads(n - 1), stat=failure)
        if (failure == 0 .and. n > 1) then
            ignored = sigfillset(all_signals)
            ignored = pthread_sigmask(set_mask, all_signals, before)
            do i = 1, n - 1
                if (pthread_create(threads(i), c_null_ptr, c_funloc(work), shared) /= 0) exit
                made = i
            end do
            ignored = pthread_sigmask(set_mask, before, no_matter)
        end if
        ignored_answer = work(shared)
        do i = 1, made
            ignored = pthread_join(threads(i), c_null_ptr)
        end do
    end subroutine run_threads
end module faststrip_interop_threads
