!> Gap files that were read, for tables that name one more than once.
module faststrip_command_gap_cache
    use faststrip_base_status, only: status_t, clear_status, is_error
    use faststrip_files_gap, only: read_gap_file
    use faststrip_geometry_gap, only: gap_t
    use faststrip_command_files, only: take_input
    implicit none
    private

    public :: gap_cache_t, take_gap_name, read_gap_once

    !> Most gaps that are kept, and most points of them all, 24 bytes each: 24 MB.
    !> Tuned [gaps, points]. Origin: chosen: a table of some profiles and shifts.
    integer, parameter :: most_gaps = 256, most_points = 1000000

    !> A file and its gap.
    type :: kept_t
        character(len=:), allocatable :: path
        type(gap_t) :: gap
        integer :: used = 0 ! when it was asked for last
    end type kept_t

    !> Gaps in the order in which they were first asked for; of too many the one goes that was not
    !> asked for longest.
    type :: gap_cache_t
        private
        type(kept_t) :: kept(most_gaps)
        integer :: n = 0
        integer :: found = 0  ! the one asked for last
        integer :: asked = 0  ! how often there was something to find
        integer :: points = 0 ! of all
    end type gap_cache_t

contains

    !> Look at a gap file that will be read, as `take_input` does; of neighbours in a table once.
    subroutine take_gap_name(path, before)
        character(len=*), intent(in) :: path                   !! of a row
        character(len=:), allocatable, intent(inout) :: before !! of the row before; gets this one

        if (allocated(before)) then
            if (before == path) return
        end if
        call take_input(path)
        before = path
    end subroutine take_gap_name

    !> The gap in a file, read once if it is still kept. What cannot be read is tried anew.
    subroutine read_gap_once(cache, path, gap, status)
        type(gap_cache_t), intent(inout) :: cache !! serves one run
        character(len=*), intent(in) :: path      !! name of the file
        type(gap_t), intent(out) :: gap           !! as of `read_gap_file`
        type(status_t), intent(out) :: status     !! as of `read_gap_file`

        integer :: i

        call clear_status(status)
        cache%asked = cache%asked + 1
        do i = 1, cache%n
            ! Tables repeat their gaps in the same order.
            cache%found = modulo(cache%found, cache%n) + 1
            if (cache%kept(cache%found)%path /= path) cycle
            gap = cache%kept(cache%found)%gap
            cache%kept(cache%found)%used = cache%asked
            return
        end do
        call read_gap_file(path, gap, status)
        if (.not. is_error(status)) call keep(cache, path, gap)
    end subroutine read_gap_once

    ! Keep one more gap, if need be instead of others.
    subroutine keep(cache, path, gap)
        type(gap_cache_t), intent(inout) :: cache
        character(len=*), intent(in) :: path
        type(gap_t), intent(in) :: gap

        integer :: oldest

        if (size(gap%y) > most_points) return
        do while (cache%n == most_gaps .or. cache%points + size(gap%y) > most_points)
            oldest = minloc(cache%kept(:cache%n)%used, dim=1)
            cache%points = cache%points - size(cache%kept(oldest)%gap%y)
            cache%kept(oldest) = cache%kept(cache%n)
            cache%n = cache%n - 1
        end do
        cache%n = cache%n + 1
        cache%found = cache%n
        cache%points = cache%points + size(gap%y)
        cache%kept(cache%n) = kept_t(path, gap, cache%asked)
    end subroutine keep
end module faststrip_command_gap_cache
