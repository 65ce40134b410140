!> Work on a lookup table that may end at any moment: after each a/b, or after some contacts of a
!> wheel, all that was solved is in a file, from which it is gone on with, and files of several
!> processes are joined.
!>
!> Such a file is a table whose other values are NaN: no host takes it for one.
module faststrip_tabulate_parts
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
    use, intrinsic :: iso_fortran_env, only: int8, int64, real32
    use faststrip_base_status, only: status_t, is_error, set_status, st_bad_argument
    use faststrip_base_text, only: integer_text
    use faststrip_files_bytes, only: read_bytes, write_bytes
    use faststrip_lookup_axis, only: lookup_axis_t
    use faststrip_lookup_bytes, only: open_lookup, pack_lookup
    use faststrip_lookup_table, only: lookup_t, lookup_kind_wheel
    implicit none
    private

    public :: forget_values, take_values, is_solved, units_of, write_work

contains

    !> A table of which nothing is solved.
    subroutine forget_values(lookup)
        type(lookup_t), intent(inout) :: lookup !! begun

        lookup%values = ieee_value(1.0_real32, ieee_quiet_nan)
    end subroutine forget_values

    !> What is solved at once: all nodes of an a/b, or of a contact of a wheel; how many there are.
    pure integer function units_of(lookup)
        type(lookup_t), intent(in) :: lookup !! begun

        units_of = lookup%shape%n
        if (lookup%kind == lookup_kind_wheel) units_of = lookup%wheel%sets
    end function units_of

    !> Is an a/b, or a contact of a wheel, solved?
    pure logical function is_solved(lookup, unit)
        type(lookup_t), intent(in) :: lookup
        integer, intent(in) :: unit !! which one

        integer(int64) :: n

        n = size(lookup%values, kind=int64)/units_of(lookup)
        is_solved = .not. any(ieee_is_nan(lookup%values((unit - 1)*n + 1:unit*n)))
    end function is_solved

    !> Keep what was solved so far.
    subroutine write_work(path, lookup, status)
        character(len=*), intent(in) :: path    !! file of the work; empty: none is kept
        type(lookup_t), intent(in) :: lookup    !! begun
        type(status_t), intent(inout) :: status !! of the file

        integer(int8), allocatable :: bytes(:)

        if (len(path) == 0) return
        call pack_lookup(lookup, bytes)
        call write_bytes(path, bytes, status)
    end subroutine write_work

    !> Take what a file has solved of the same table.
    subroutine take_values(path, lookup, status)
        character(len=*), intent(in) :: path    !! of a part, or of unfinished work
        type(lookup_t), intent(inout) :: lookup !! begun
        type(status_t), intent(out) :: status
            !! of the file; `st_bad_argument`: of another table, method or revision, or some of it
            !! is solved already

        type(lookup_t) :: other
        integer(int8), allocatable :: bytes(:)
        integer(int64) :: first, last
        integer :: i

        call read_bytes(path, bytes, status)
        if (is_error(status)) return
        call open_lookup(bytes, other, status, may_lack=.true.)
        if (is_error(status)) then
            status%message = trim(status%message) // ' (' // path // ')'
            return
        end if
        if (.not. are_alike(lookup, other)) then
            call set_status(status, st_bad_argument, 'a part must be of the same nodes, ' // &
                            'method and revision, got ' // path)
            return
        end if
        do i = 1, units_of(lookup)
            if (.not. is_solved(other, i)) cycle
            if (is_solved(lookup, i)) then
                call set_status(status, st_bad_argument, 'a part must have nothing that another ' &
                                // 'one has, got number ' // integer_text(i) // ' of ' &
                                // integer_text(units_of(lookup)) // ' again in ' // path)
                return
            end if
            last = i*(size(lookup%values, kind=int64)/units_of(lookup))
            first = last - size(lookup%values, kind=int64)/units_of(lookup) + 1
            lookup%values(first:last) = other%values(first:last)
        end do
    end subroutine take_values

    !> Are two tables of the same nodes, solved in the same way?
    pure logical function are_alike(one, other)
        type(lookup_t), intent(in) :: one, other

        are_alike = one%kind == other%kind
        if (are_alike) are_alike = one%text == other%text .and. are_same(one%q, other%q) .and. &
                                   are_same(one%ratio, other%ratio)
        if (.not. are_alike) return
        if (one%kind /= lookup_kind_wheel) then
            are_alike = are_same(one%shape, other%shape)
            if (are_alike) are_alike = all(one%scale == other%scale)
            return
        end if
        associate (here => one%wheel, there => other%wheel)
            are_alike = are_same(here%y, there%y) .and. are_same(here%yaw, there%yaw) .and. &
                        are_same(here%load, there%load) .and. here%slots == there%slots .and. &
                        here%sets == there%sets
            if (are_alike) are_alike = all(here%contacts == there%contacts) .and. &
                                       all(here%set == there%set)
        end associate
    end function are_alike

    pure logical function are_same(one, other)
        type(lookup_axis_t), intent(in) :: one, other

        are_same = one%n == other%n
        if (are_same) are_same = all(one%x == other%x)
    end function are_same
end module faststrip_tabulate_parts
