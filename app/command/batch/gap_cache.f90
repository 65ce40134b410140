!> Gaps of files that rows name again and again: read, smoothed and made curves once, for all
!> threads.
!>
!> A thread looks a name up; if it is not there, it makes the gap itself and leaves it, if there is
!> room. What is there stays in its place until `tidy_cache`, while no thread works, drops what was
!> not asked for longest. So a gap is the same to the last bit wherever a row has it from.
module faststrip_command_batch_gap_cache
    use, intrinsic :: iso_fortran_env, only: int64
    use faststrip_base_kinds, only: wp
    use faststrip_base_status, only: status_t, is_error
    use faststrip_files_digest, only: digest_length
    use faststrip_files_gap, only: read_gap_file
    use faststrip_geometry_gap, only: gap_t
    use faststrip_command_program_console, only: exit_bad_input
    use faststrip_command_program_files, only: trouble_t, check_input
    use faststrip_command_batch_gap_digests, only: gap_digests_t, wants_digest, add_digest, &
                                                   digest_of_gap, most_gaps
    use faststrip_command_contact_solver, only: ready_gap_t, make_ready
    implicit none
    private

    public :: gap_cache_t, start_cache, own_gap_t, find_gap, tidy_cache

    !> Most points of all gaps that are kept, 150 bytes each: 30 MB.
    !> Tuned [points]. Origin: chosen: a table of some profiles and shifts.
    integer, parameter :: most_points = 200000
    ! Lists of names, by a number made from the name.
    integer, parameter :: n_lists = 2*most_gaps

    !> A file and its gap.
    type :: kept_t
        character(len=:), allocatable :: path
        type(ready_gap_t), allocatable :: ready
        integer(int64) :: used = 0 ! when it was asked for last
        integer :: next = 0        ! of the same list; 0: none
    end type kept_t

    !> Gaps that are kept for all rows.
    type :: gap_cache_t
        type(gap_digests_t) :: digests      !! of files that were read
        type(kept_t), allocatable, private :: kept(:)
        integer, private :: n = 0
        integer, private :: first(0:n_lists - 1) = 0 ! of each list; 0: none
        integer, private :: points = 0               ! of all
        integer(int64), private :: asked = 0         ! how often
        integer(int64), private :: made = 0          ! how many were ever kept
    end type gap_cache_t

    !> A thread's own gap: the one it made last and could not leave.
    type :: own_gap_t
        private
        type(ready_gap_t), allocatable :: ready ! none: it was left
        integer(int64) :: made = 0
    end type own_gap_t

contains

    !> Begin with no gaps.
    subroutine start_cache(cache)
        type(gap_cache_t), intent(out) :: cache !! serves one run

        allocate (cache%kept(most_gaps))
    end subroutine start_cache

    !> The gap in a file. What cannot be read is tried anew for each row.
    subroutine find_gap(cache, own, smoothing, path, ready, status, trouble)
        type(gap_cache_t), intent(inout), target :: cache !! of all threads
        type(own_gap_t), intent(inout), target :: own     !! of this thread
        real(wp), intent(in) :: smoothing                 !! noise gaps are smoothed for, mm; or 0
        character(len=*), intent(in) :: path              !! name of the file
        type(ready_gap_t), pointer, intent(out) :: ready  !! until the next call; none on an error
        type(status_t), intent(out) :: status             !! those of `read_gap_file`, `make_ready`
        type(trouble_t), intent(out) :: trouble           !! why the run has to end, if it has to

        type(gap_t) :: gap
        character(len=digest_length) :: digest
        integer :: i
        logical :: is_wanted, is_like

        ready => null()
        !$omp critical (gap_cache)
        cache%asked = cache%asked + 1
        i = index_of(cache, path)
        if (i > 0) cache%kept(i)%used = cache%asked
        !$omp end critical (gap_cache)
        if (i > 0) then
            ready => cache%kept(i)%ready
            return
        end if
        call check_input(path, trouble)
        if (trouble%code /= 0) return
        !$omp critical (gap_cache)
        is_wanted = wants_digest(cache%digests, path)
        !$omp end critical (gap_cache)
        is_like = .true.
        if (is_wanted) then
            digest = digest_of_gap(path)
            !$omp critical (gap_cache)
            call add_digest(cache%digests, path, digest, is_like)
            !$omp end critical (gap_cache)
        end if
        if (.not. is_like) then
            trouble%code = exit_bad_input
            trouble%words = 'the gap file has changed since other rows were solved: ' // path
            return
        end if
        call read_gap_file(path, gap, status)
        if (is_error(status)) return
        if (.not. allocated(own%ready)) allocate (own%ready)
        call make_ready(smoothing, gap, own%ready, status)
        if (is_error(status)) return
        !$omp critical (gap_cache)
        i = index_of(cache, path)
        if (i == 0) call keep(cache, path, own%ready, i)
        !$omp end critical (gap_cache)
        if (i > 0) then
            ready => cache%kept(i)%ready
        else
            own%made = own%made + 1
            own%ready%id = -own%made
            ready => own%ready
        end if
    end subroutine find_gap

    !> Drop what was not asked for longest, if the room is nearly used up. No thread may hold a gap.
    subroutine tidy_cache(cache)
        type(gap_cache_t), intent(inout) :: cache !! of a run

        integer :: i, oldest

        if (2*cache%n < most_gaps .and. 2*cache%points < most_points) return
        do while (cache%n > 1 .and. &
                  (4*cache%n > most_gaps .or. 4*cache%points > most_points))
            oldest = minloc(cache%kept(:cache%n)%used, dim=1)
            cache%points = cache%points - cache%kept(oldest)%ready%curve%n
            if (oldest < cache%n) cache%kept(oldest) = cache%kept(cache%n)
            cache%kept(cache%n) = kept_t()
            cache%n = cache%n - 1
        end do
        cache%first = 0
        do i = 1, cache%n
            call enter(cache, i)
        end do
    end subroutine tidy_cache

    ! Keep one more gap, without copying, if there is room; the first one always.
    subroutine keep(cache, path, ready, i)
        type(gap_cache_t), intent(inout) :: cache
        character(len=*), intent(in) :: path
        type(ready_gap_t), allocatable, intent(inout) :: ready ! gone if it is kept
        integer, intent(out) :: i ! its place; 0: there is no room

        i = 0
        if (cache%n == most_gaps .or. cache%n > 0 .and. cache%points + ready%curve%n &
            > most_points) return
        i = cache%n + 1
        cache%n = i
        cache%made = cache%made + 1
        cache%points = cache%points + ready%curve%n
        cache%kept(i)%path = path
        call move_alloc(ready, cache%kept(i)%ready)
        cache%kept(i)%ready%id = cache%made
        cache%kept(i)%used = cache%asked
        call enter(cache, i)
    end subroutine keep

    subroutine enter(cache, i)
        type(gap_cache_t), intent(inout) :: cache
        integer, intent(in) :: i

        associate (first => cache%first(list_of(cache%kept(i)%path)))
            cache%kept(i)%next = first
            first = i
        end associate
    end subroutine enter

    ! The place of a name; 0: it is not there.
    integer function index_of(cache, path) result(i)
        type(gap_cache_t), intent(in) :: cache
        character(len=*), intent(in) :: path

        i = cache%first(list_of(path))
        do while (i > 0)
            if (cache%kept(i)%path == path) return
            i = cache%kept(i)%next
        end do
    end function index_of

    pure integer function list_of(path) result(number)
        character(len=*), intent(in) :: path

        integer(int64) :: sum
        integer :: i

        sum = 0
        do i = 1, len(path)
            ! Given: a usual hash of a text, below a prime.
            sum = modulo(31*sum + ichar(path(i:i)), 2147483647_int64)
        end do
        number = int(modulo(sum, int(n_lists, int64)))
    end function list_of
end module faststrip_command_batch_gap_cache
